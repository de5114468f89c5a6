"""Cohorts on a cluster of Dask: a member is a task.

A task writes the files of its member, which have their names once they are whole, and answers with a few hundred bytes. So a worker that
is killed loses no more than the members that it was at, and doubles none: whoever does a task again finds what is there.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from itertools import islice
from queue import Empty, SimpleQueue
from typing import Any
from uuid import uuid4

from homebody import _homebody
from homebody.errors import ClusterError, HomebodyError, LogError, needs
from homebody.progress import Progress

#: So many tasks are with the scheduler at once: neither it nor this program has to hold all of a large cohort.
AT_ONCE = 2000

#: What a worker does, as a text: read as a function of this package, it would end a worker that lacks the package before anybody is told.
TASK = "__import__('homebody.cluster', fromlist=['live_member']).live_member(folder, index, call)"

#: Of a local cluster: its processes look into themselves less than Dask has them do, and keep the memory that the next life needs
#: again, up to 64 MiB, where Dask has them give back all but 64 KiB.
LOCAL = {
    "distributed.worker.profile.enabled": False,
    "distributed.admin.tick.interval": "500ms",
    "distributed.nanny.pre-spawn-environ.MALLOC_TRIM_THRESHOLD_": 64 * 1024 * 1024,
}

#: So long a scheduler may take to answer.
TIMEOUT_S = 10

#: So often a member is tried again whose worker could not live it, such as one whose disk was full.
RETRIES = 2


#: So often it is looked whether those are still there who may live a member, once somebody was found who may not.
LOOKS_S = 5


@lru_cache(maxsize=2)
def _begun(folder: str, call: str) -> _homebody.Cohort:
    """The cohort in a folder: each process of a worker opens it once for each call of :func:`live`."""
    try:
        return _homebody.Cohort.left_in(folder)
    except LogError as error:
        raise ClusterError(
            f"a worker does not see the cohort in {folder}: {error}\n"
            "  hint: it is on a file system that all workers have under the same path, or in an object store"
        ) from None


def live_member(folder: str, index: int, call: str = "") -> str:
    """Lives one member; what became of them, as JSON. This is what a task does."""
    return _begun(folder, call).live_one(folder, index)


@contextmanager
def _client(cluster: str, workers: int | None) -> Iterator[Any]:
    needs("distributed", "a cluster", "cluster")
    import dask
    from distributed import Client, LocalCluster

    if cluster == "local":
        # Processes, each of which lives one at a time: so one that dies takes one member with it.
        try:
            with dask.config.set(LOCAL):
                local = LocalCluster(
                    n_workers=workers, threads_per_worker=1, processes=True, host="127.0.0.1", dashboard_address=None
                )
        except RuntimeError as error:
            # Each process of it imports the program that began it.
            raise ClusterError(
                f"a local cluster does not begin: {error}\n"
                '  hint: in a script, what begins it stands below if __name__ == "__main__":'
            ) from None
        with local, Client(local) as client:
            yield client
        return
    if "://" not in cluster:
        raise ValueError(f"cluster {cluster!r}: it is local, or the address of a scheduler such as tcp://10.0.0.1:8786")
    try:
        client = Client(cluster, timeout=TIMEOUT_S)
    except (OSError, TimeoutError, ValueError) as error:
        raise ClusterError(f"no cluster answers at {cluster}: {error}") from None
    with client:
        _look_at_workers(client, cluster)
        yield client


def _look_at_workers(client: Any, cluster: str) -> None:
    """Tells what would have a cohort wait for ever: no worker is there, or one cannot do what it is to do."""
    if not client.nthreads():
        # It may get them as soon as there is something to do.
        hint = f"nobody is lived until it has\n  hint: dask worker {cluster}"
        warnings.warn(f"the cluster at {cluster} has no workers yet: {hint}", stacklevel=5)
    for error in _lacking(client).values():
        raise _lacks(cluster, error)


def _lacking(client: Any) -> dict[str, BaseException]:
    """The workers that cannot import the package, by their addresses, and why."""
    told = client.run(exec, "import homebody", on_error="return")
    return {worker: why for worker, why in told.items() if isinstance(why, BaseException)}


def _lacks(cluster: str, error: BaseException) -> ClusterError:
    hint = f"all workers have the wheel of homebody {_homebody.VERSION}"
    return ClusterError(f"a worker of the cluster at {cluster} lacks what it needs: {error}\n  hint: {hint}")


class _Tasks:
    """The members who are with a scheduler, each as a task."""

    def __init__(self, client: Any, cluster: str, folder: str) -> None:
        self.client = client
        self.cluster = cluster
        self.folder = folder
        #: What tells this call from others: workers open the cohort anew for it.
        self.call = uuid4().hex
        #: By the key of a task: whose it is, and the workers that may do it; ``None`` for all.
        self.running: dict[str, tuple[int, Any, list[str] | None]] = {}
        self.done: SimpleQueue[Any] = SimpleQueue()
        #: Workers that joined without the package.
        self.lacking: set[str] = set()
        self.submitted = 0

    def submit(self, index: int) -> None:
        able = [worker for worker in self.client.nthreads() if worker not in self.lacking] if self.lacking else None
        self.submitted += 1
        key = f"homebody-{self.call}-{self.submitted}"
        names = {"folder": self.folder, "index": index, "call": self.call}
        task = self.client.submit(eval, TASK, names, key=key, retries=RETRIES, workers=able)
        self.running[key] = (index, task, able)
        task.add_done_callback(self.done.put)

    def next(self) -> tuple[int, Any]:
        """Whose task has ended next, and the task."""
        while True:
            try:
                task = self.done.get(timeout=LOOKS_S)
            except Empty:
                self._bring_back_to_life()
                continue
            if task.key in self.running:
                return self.running.pop(task.key)[0], task

    def leave_out_who_lacks(self, index: int, error: ImportError) -> None:
        """A worker that joined late lacks the package: others live the member."""
        found = _lacking(self.client)
        new = set(found) - self.lacking
        self.lacking |= set(found)
        if not new and not found or len(found) == len(self.client.nthreads()):
            raise _lacks(self.cluster, error) from None
        for worker in sorted(new):
            warnings.warn(f"{worker} is left out: {_lacks(self.cluster, found[worker])}", stacklevel=4)
        self.submit(index)

    def _bring_back_to_life(self) -> None:
        """Those who wait for workers that are gone may be lived by others who have come."""
        there = set(self.client.nthreads()) if self.lacking else set()
        for key, (index, task, able) in list(self.running.items()):
            if able is not None and not there.intersection(able) and there - self.lacking:
                del self.running[key]
                task.cancel()
                self.submit(index)


def live(
    cohort: _homebody.Cohort, folder: str, cluster: str, workers: int | None = None, progress: bool | None = None
) -> None:
    """Lives all members of a cohort that was begun in a folder, on a cluster."""
    count = cohort.count
    lived: list[str | None] = [None] * count
    with _client(cluster, workers) as client, Progress(f"living {count} lives", progress) as told:
        from distributed import CancelledError, KilledWorker

        tasks = _Tasks(client, cluster, folder)
        waiting = iter(range(count))
        for index in islice(waiting, AT_ONCE):
            tasks.submit(index)
        done = 0
        while tasks.running:
            index, task = tasks.next()
            try:
                lived[index] = task.result()
            except HomebodyError:
                raise
            except ImportError as error:
                tasks.leave_out_who_lacks(index, error)
                continue
            except KilledWorker as error:
                raise ClusterError(
                    f"workers have died over and over, at {cohort.name_of(index)} at last: {error}\n"
                    "  hint: what was lived stays; the same call goes on"
                ) from None
            except CancelledError as error:
                raise ClusterError(
                    f"the cluster at {cluster} has lost its tasks, as where its scheduler has ended: {error}\n"
                    "  hint: what was lived stays; once the cluster is there again, the same call goes on"
                ) from None
            done += 1
            if told is not None:
                told(done, count)
            following = next(waiting, None)
            if following is not None:
                tasks.submit(following)
    cohort.end(folder, [answer for answer in lived if answer is not None])
