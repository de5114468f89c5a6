"""Cohorts on a cluster of Dask: a member is a task.

A task writes the files of its member, which have their names once they are whole, and answers with a few hundred bytes. So a worker that
is killed loses no more than the members that it was at, and doubles none: whoever does a task again finds what is there.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import Any

from homebody import _homebody
from homebody._cohort import LIST
from homebody.errors import ClusterError, HomebodyError, needs
from homebody.progress import Progress

#: So many tasks are with the scheduler at once: neither it nor this program has to hold all of a large cohort.
AT_ONCE = 2000

#: So long a scheduler may take to answer.
TIMEOUT_S = 10

#: So often a member is tried again whose worker could not live it, such as one whose disk was full.
RETRIES = 2


@lru_cache(maxsize=2)
def _begun(folder: str, changed: int) -> _homebody.Cohort:
    """The cohort in a folder: each process of a worker opens it once."""
    return _homebody.Cohort.left_in(folder)


def live_member(folder: str, index: int) -> str:
    """Lives one member; what became of them, as JSON. This is the task."""
    try:
        changed = (Path(folder) / LIST).stat().st_mtime_ns
    except OSError as error:
        raise ClusterError(
            f"a worker does not see {folder}: {error.strerror}\n"
            "  hint: the folder is on a file system that all workers have under the same path"
        ) from None
    return _begun(folder, changed).live_one(folder, index)


@contextmanager
def _client(cluster: str, workers: int | None) -> Iterator[Any]:
    needs("distributed", "a cluster", "cluster")
    from distributed import Client, LocalCluster

    if cluster == "local":
        # Processes, each of which lives one at a time: so one that dies takes one member with it.
        try:
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
    """Tells what would have a cohort wait for ever: no worker is there, or one dies of what it is to do."""
    if not client.scheduler_info()["workers"]:
        # It may get them as soon as there is something to do.
        hint = f"nobody is lived until it has\n  hint: dask worker {cluster}"
        warnings.warn(f"the cluster at {cluster} has no workers yet: {hint}", stacklevel=5)
    try:
        client.run(exec, "import homebody")
    except ImportError as error:
        hint = f"all workers have the wheel of homebody {_homebody.VERSION}"
        raise ClusterError(f"a worker of the cluster at {cluster} lacks what it needs: {error}\n  hint: {hint}") from None


def live(
    cohort: _homebody.Cohort, folder: Path, cluster: str, workers: int | None = None, progress: bool | None = None
) -> None:
    """Lives all members of a cohort that was begun in a folder, on a cluster."""
    count = cohort.count
    lived: list[str | None] = [None] * count
    with _client(cluster, workers) as client, Progress(f"living {count} lives", progress) as told:
        from distributed import KilledWorker, as_completed

        waiting = iter(range(count))

        def submit(index: int) -> Any:
            return client.submit(live_member, str(folder), index, key=f"homebody-{folder}-{index}", retries=RETRIES)

        tasks = {}
        running = as_completed()
        for index in waiting:
            task = submit(index)
            tasks[task.key] = index
            running.add(task)
            if len(tasks) >= AT_ONCE:
                break
        done = 0
        for task in running:
            try:
                answer = task.result()
            except HomebodyError:
                raise
            except KilledWorker as error:
                raise ClusterError(
                    f"workers have died over and over, at {cohort.name_of(tasks[task.key])} at last: {error}\n"
                    "  hint: what was lived stays; the same call goes on"
                ) from None
            lived[tasks.pop(task.key)] = answer
            done += 1
            if told is not None:
                told(done, count)
            following = next(waiting, None)
            if following is not None:
                task = submit(following)
                tasks[task.key] = following
                running.add(task)
    cohort.end(folder, [answer for answer in lived if answer is not None])
