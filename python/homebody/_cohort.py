"""Cohorts: many simulated people at once, on this machine or on a cluster."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from homebody import _homebody, arguments
from homebody.errors import LogError
from homebody.log import Log
from homebody.profiles import MOST, table
from homebody.progress import Progress
from homebody.scenario import Scenario, opened, temporary_folder

#: The manifest of a cohort, with its members.
LIST = "cohort.json"

Profiles = int | str | PathLike[str] | Iterable[Mapping[str, object]]


class Cohort:
    """A cohort in its folder, or below the URL of an object store.

    Logs are ``log/member=0001/log.parquet`` and so on; the ground truth is in ``truth/member=0001/``. Both are data sets partitioned by
    member. ``cohort.json`` is the manifest: the request, the version, the seeds, and a digest for each member.
    """

    def __init__(self, folder: str | PathLike[str]) -> None:
        #: Its location: a path, or a URL such as ``s3://bucket/cohort``.
        self.folder = place(arguments.path("folder", folder, "the folder of a cohort"))
        text = _homebody.list_of_cohort(self.folder)
        try:
            #: The manifest.
            self.manifest: dict[str, Any] = json.loads(text)
        except ValueError as error:
            raise LogError(f"{self.folder}/{LIST} is not valid JSON: {error}") from None

    @property
    def members(self) -> list[str]:
        """The names of the members; empty until the cohort is complete."""
        return [member["name"] for member in self.manifest["members"]]

    def member(self, name: str) -> Log:
        """The log of a member, with its truth. From an object store, a copy is made for the time of the program."""
        if name not in self.members:
            raise ValueError(f"name {name!r}: the cohort has no such member; see members")
        if "form" not in self.manifest:
            return Log(Path(self.folder) / name)
        folder = Path(self.folder)
        if "://" in self.folder:
            folder = temporary_folder()
            _homebody.bring_member(self.folder, self._form, name, folder)
        return Log(folder / "members" / name)

    @property
    def _form(self) -> str:
        if "form" not in self.manifest:
            raise LogError(f"{self.folder} is not a partitioned data set: each member has its own folder\n  hint: read one with member(name)")
        return str(self.manifest["form"])

    def logs(self) -> list[str]:
        """The files of all logs, in the order of members: paths, or URLs."""
        form = self._form
        return [f"{self.folder}/log/member={name}/{_LOGS.get(form, f'log.{form}')}" for name in self.members]

    def truths(self, name: str = "activity") -> list[str]:
        """The files of a table of the truth of all members, in their order: paths, or URLs. A truth in a database is one file."""
        form = self._form
        file = "truth.db" if form in _LOGS else f"truth.{name}.{form}"
        return [f"{self.folder}/truth/member={member}/{file}" for member in self.members]

    def __len__(self) -> int:
        return len(self.manifest["members"])

    def __repr__(self) -> str:
        return f"<homebody.Cohort {self.folder}: {len(self)} members of {self.manifest['scenario']}>"


#: The names of logs in forms with another file extension; their truths are databases.
_LOGS = {"sqlite": "log.db", "casas": "log.txt"}


def place(folder: str) -> str:
    """The location of a cohort, independent of the working folder: an absolute path, or the given URL."""
    return folder.rstrip("/") if "://" in folder else str(Path(folder).absolute())


def cohort(
    home: Scenario | str | PathLike[str],
    profiles: Profiles,
    folder: str | PathLike[str],
    *,
    days: float | None = None,
    seed: int | None = None,
    # The options of a run, made from RunOptions in crates/homebody-simulation/src/run_options.rs.
    without: Sequence[str] = (),
    # The end of the options.
    form: str = "parquet",
    truth: str | None = None,
    cluster: str | None = None,
    workers: int | None = None,
    progress: bool | None = None,
) -> Cohort:
    """Simulates many people in a home and writes their logs to a folder. The bytes are the same on every machine and cluster.

    ``profiles`` is the number of people, who differ as people do; or a list of them: a CSV file, or rows such as
    :func:`homebody.draw` makes. Without ``cluster``, threads of this program simulate them. ``local`` is a cluster of processes on this
    machine; ``tcp://...`` is the scheduler of a Dask cluster whose workers see the folder under the same path.

    ``folder`` is new or empty; in a build with object stores it may be a URL, ``s3://bucket/cohort``. ``truth`` is ``all`` for all tables
    of the ground truth, or ``brief`` without those that have a row for each event or movement. The default is ``brief`` for cohorts of
    more than 10,000 days in all.

    The same call resumes a cohort that was stopped (also by Ctrl-C) or killed. It warns about settings that are valid but probably not
    intended, such as a condition that begins after the last day.

    >>> import tempfile
    >>> import homebody as hb
    >>> folder = tempfile.mkdtemp()
    >>> cohort = hb.cohort("studio", 2, folder, days=0.2, seed=7)
    >>> cohort.members, len(cohort.logs())
    (['0001', '0002'], 2)
    """
    options = arguments.run_options(locals())
    request: dict[str, Any] = {
        "residents": None,
        "profiles": None,
        "form": arguments.text("form", form, "parquet, csv, jsonl, sqlite or arrow"),
        "truth": None if truth is None else arguments.one_of("truth", truth, ("all", "brief")),
    }
    folder = place(arguments.path("folder", folder))
    if hasattr(profiles, "__index__"):
        request["residents"] = arguments.whole("profiles", profiles, 1, MOST, "a number of people, a file, or rows")
    elif isinstance(profiles, (str, PathLike)):
        try:
            request["profiles"] = (fspath(profiles), Path(profiles).read_text(encoding="utf-8"))
        except OSError as error:
            raise LogError(f"{fspath(profiles)}: {error.strerror}\n  hint: name a CSV file with a row for each member") from None
    elif isinstance(profiles, Iterable) and not isinstance(profiles, Mapping):
        request["profiles"] = ("profiles", table(profiles))
    else:
        raise arguments.wrong("profiles", profiles, "a number of people, a file, or rows")
    if cluster is not None:
        arguments.text("cluster", cluster, "local, or the address of a scheduler such as tcp://10.0.0.1:8786")
    if workers is not None:
        arguments.whole("workers", workers, 1, 10_000)
        if cluster != "local":
            raise ValueError(f"workers is {workers}: only a local cluster takes a number of workers\n  hint: cluster=\"local\"")
    if progress is not None:
        arguments.flag("progress", progress)
    inner = _homebody.Cohort(opened("home", home)._scenario, options, request)
    inner.create(folder)
    for remark in inner.remarks:
        warnings.warn(remark, stacklevel=2)
    if cluster is None:
        with Progress(f"simulating {inner.count} members", progress) as tell:
            inner.resume(folder, tell)
    else:
        from homebody.cluster import live

        live(inner, folder, cluster, workers, progress)
    return Cohort(folder)
