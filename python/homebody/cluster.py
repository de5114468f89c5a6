"""Cohorts on a cluster of Dask: a member is a task.

A task writes the files of its member and returns a few hundred bytes. Files get their names when they are complete. So a killed worker
loses only its present members, and no member comes twice: a repeated task finds the files that exist.
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

#: The number of tasks at the scheduler at once, so that neither it nor this program holds all of a large cohort.
AT_ONCE = 2000

#: The code of a task, as text. As a function of this package it would end a worker without the package before Homebody could report it.
TASK = "__import__('homebody.cluster', fromlist=['live_member']).live_member(folder, index, call)"

#: Settings of a local cluster: its processes profile themselves less than Dask's default, and keep up to 64 MiB of free memory for the
#: next member, where Dask's default keeps 64 KiB.
LOCAL = {
    "distributed.worker.profile.enabled": False,
    "distributed.admin.tick.interval": "500ms",
    "distributed.nanny.pre-spawn-environ.MALLOC_TRIM_THRESHOLD_": 64 * 1024 * 1024,
}

#: The time that a scheduler may take to answer.
TIMEOUT_S = 10

#: The number of further attempts for a member after a failure of its worker, such as a full disk.
RETRIES = 2


#: The time between checks that suitable workers are still present, once an unsuitable one was found.
LOOKS_S = 5


@lru_cache(maxsize=2)
def _begun(folder: str, call: str) -> _homebody.Cohort:
    """The cohort in a folder. Each process of a worker opens it once for each call of :func:`live`."""
    try:
        return _homebody.Cohort.open(folder)
    except LogError as error:
        raise ClusterError(
            f"a worker does not see the cohort in {folder}: {error}\n"
            "  hint: use a file system that all workers have under the same path, or an object store"
        ) from None


def live_member(folder: str, index: int, call: str = "") -> str:
    """Simulates one member and returns its result as JSON. Each task calls this."""
    return _begun(folder, call).run_member(folder, index)


@contextmanager
def _client(cluster: str, workers: int | None) -> Iterator[Any]:
    needs("distributed", "a cluster", "cluster")
    import dask
    from distributed import Client, LocalCluster

    if cluster == "local":
        # Processes with one member at a time, so a process that dies loses one member.
        try:
            with dask.config.set(LOCAL):
                local = LocalCluster(
                    n_workers=workers, threads_per_worker=1, processes=True, host="127.0.0.1", dashboard_address=None
                )
        except RuntimeError as error:
            # Each process of the cluster imports the program that started it.
            raise ClusterError(
                f"a local cluster cannot start: {error}\n"
                '  hint: in a script, put the call below if __name__ == "__main__":'
            ) from None
        with local, Client(local) as client:
            yield client
        return
    if "://" not in cluster:
        raise ValueError(f"cluster is {cluster!r}; expected local, or the address of a scheduler such as tcp://10.0.0.1:8786")
    try:
        client = Client(cluster, timeout=TIMEOUT_S)
    except (OSError, TimeoutError, ValueError) as error:
        raise ClusterError(f"no cluster answers at {cluster}: {error}") from None
    with client:
        _look_at_workers(client, cluster)
        yield client


def _look_at_workers(client: Any, cluster: str) -> None:
    """Reports reasons for endless waiting: no workers, or a worker without the package."""
    if not client.nthreads():
        # Workers may join when there are tasks.
        hint = f"the cohort waits for workers\n  hint: dask worker {cluster}"
        warnings.warn(f"the cluster at {cluster} has no workers yet: {hint}", stacklevel=5)
    for error in _lacking(client).values():
        raise _lacks(cluster, error)


def _lacking(client: Any) -> dict[str, BaseException]:
    """The addresses of workers that cannot import the package, with the reasons."""
    told = client.run(exec, "import homebody", on_error="return")
    return {worker: why for worker, why in told.items() if isinstance(why, BaseException)}


def _lacks(cluster: str, error: BaseException) -> ClusterError:
    hint = f"install the wheel of homebody {_homebody.VERSION} on all workers"
    return ClusterError(f"a worker of the cluster at {cluster} lacks the package: {error}\n  hint: {hint}")


class _Tasks:
    """The tasks at a scheduler, one for each member."""

    def __init__(self, client: Any, cluster: str, folder: str) -> None:
        self.client = client
        self.cluster = cluster
        self.folder = folder
        #: The id of this call: workers open the cohort again for each call.
        self.call = uuid4().hex
        #: By the key of a task: the member, the task, and the workers that may do it; ``None`` for all.
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
        """The member of the next completed task, and the task."""
        while True:
            try:
                task = self.done.get(timeout=LOOKS_S)
            except Empty:
                self._bring_back_to_life()
                continue
            if task.key in self.running:
                return self.running.pop(task.key)[0], task

    def leave_out_who_lacks(self, index: int, error: ImportError) -> None:
        """Leaves out a worker that joined late without the package; others simulate the member."""
        found = _lacking(self.client)
        new = set(found) - self.lacking
        self.lacking |= set(found)
        if not new and not found or len(found) == len(self.client.nthreads()):
            raise _lacks(self.cluster, error) from None
        for worker in sorted(new):
            warnings.warn(f"{worker} is left out: {_lacks(self.cluster, found[worker])}", stacklevel=4)
        self.submit(index)

    def _bring_back_to_life(self) -> None:
        """Gives tasks that wait for workers that left to workers that joined."""
        there = set(self.client.nthreads()) if self.lacking else set()
        for key, (index, task, able) in list(self.running.items()):
            if able is not None and not there.intersection(able) and there - self.lacking:
                del self.running[key]
                task.cancel()
                self.submit(index)


def live(
    cohort: _homebody.Cohort, folder: str, cluster: str, workers: int | None = None, progress: bool | None = None
) -> None:
    """Simulates all members of a cohort in its folder, on a cluster."""
    count = cohort.count
    lived: list[str | None] = [None] * count
    with _client(cluster, workers) as client, Progress(f"simulating {count} members", progress) as told:
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
                    f"workers died repeatedly, most recently at member {cohort.name_of(index)}: {error}\n"
                    "  hint: completed members are kept; repeat the call to resume"
                ) from None
            except CancelledError as error:
                raise ClusterError(
                    f"the cluster at {cluster} lost its tasks, for example because its scheduler stopped: {error}\n"
                    "  hint: completed members are kept; once the cluster runs again, repeat the call to resume"
                ) from None
            done += 1
            if told is not None:
                told(done, count)
            following = next(waiting, None)
            if following is not None:
                tasks.submit(following)
    cohort.finish(folder, [answer for answer in lived if answer is not None])
