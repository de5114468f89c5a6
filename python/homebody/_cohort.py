"""Cohorts: many lives side by side, on this machine or on a cluster."""

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
from homebody.scenario import Scenario, opened, temporary_folder, wanted_life

#: The file that says what a cohort is, and who was lived.
LIST = "cohort.json"

Profiles = int | str | PathLike[str] | Iterable[Mapping[str, object]]


class Cohort:
    """A cohort in its folder, or below the URL of an object store.

    Logs are ``log/member=0001/log.parquet`` and so on, truths lie apart in ``truth/member=0001/``; both are read as sets that are
    parted by member. ``cohort.json`` is the manifest: what was asked, by which version, whose seeds, and a digest for each member.
    """

    def __init__(self, folder: str | PathLike[str]) -> None:
        #: Where it lies: a path, or a URL such as ``s3://bucket/cohort``.
        self.folder = place(arguments.path("folder", folder, "the folder of a cohort"))
        told = _homebody.list_of_cohort(self.folder)
        try:
            #: The manifest.
            self.manifest: dict[str, Any] = json.loads(told)
        except ValueError as error:
            raise LogError(f"{self.folder}/{LIST} is no JSON: {error}") from None

    @property
    def members(self) -> list[str]:
        """The names of those who were lived; nobody until the cohort is over."""
        return [member["name"] for member in self.manifest["members"]]

    def member(self, name: str) -> Log:
        """The log of a member, with its truth. What lies in an object store is brought here for as long as the program runs."""
        if name not in self.members:
            raise ValueError(f"name {name!r}: nobody who was lived is called so; members lists them")
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
            raise LogError(f"{self.folder} is no set: each member has a folder\n  hint: member(name) reads one")
        return str(self.manifest["form"])

    def logs(self) -> list[str]:
        """The files of all logs, in the order of members: paths, or URLs."""
        form = self._form
        return [f"{self.folder}/log/member={name}/{_LOGS.get(form, f'log.{form}')}" for name in self.members]

    def truths(self, name: str = "activity") -> list[str]:
        """The files of a table of all truths, in the order of members: paths, or URLs. A truth in a database is one file."""
        form = self._form
        file = "truth.db" if form in _LOGS else f"truth.{name}.{form}"
        return [f"{self.folder}/truth/member={member}/{file}" for member in self.members]

    def __len__(self) -> int:
        return len(self.manifest["members"])

    def __repr__(self) -> str:
        return f"<homebody.Cohort {self.folder}: {len(self)} lives of {self.manifest['scenario']}>"


#: What a log is called in forms whose files do not end as the form is called; their truths are databases.
_LOGS = {"sqlite": "log.db", "casas": "log.txt"}


def place(folder: str) -> str:
    """Where a cohort lies, so that it is found from everywhere: a whole path, or a URL as it is."""
    return folder.rstrip("/") if "://" in folder else str(Path(folder).absolute())


def cohort(
    home: Scenario | str | PathLike[str],
    profiles: Profiles,
    folder: str | PathLike[str],
    *,
    days: float | None = None,
    seed: int | None = None,
    without: Sequence[str] = (),
    form: str = "parquet",
    truth: str | None = None,
    cluster: str | None = None,
    workers: int | None = None,
    progress: bool | None = None,
) -> Cohort:
    """Lives many people in a home into a folder, all side by side: with the same bytes wherever that is done.

    ``profiles`` is how many people, of whom each differs as people do; or a list of them: a file of CSV, or rows such as
    :func:`homebody.draw` makes. Without ``cluster`` threads of this program live them. ``local`` is a cluster of processes on this
    machine, and ``tcp://...`` the scheduler of one of Dask, whose workers see the folder under the same path.

    ``folder`` is new, or empty; in a build with object stores it may be a URL, ``s3://bucket/cohort``. ``truth`` is ``all`` tables of each
    truth, or ``brief``, without those that have a row for each firing or movement: unless it is said, that is what large cohorts keep,
    of more than 10,000 days in all.

    A cohort that was stopped, by Ctrl-C too, or killed is gone on with by the same call. It warns of what is right and hardly meant,
    such as a condition that begins after the last day.

    >>> import tempfile
    >>> import homebody as hb
    >>> folder = tempfile.mkdtemp()
    >>> lived = hb.cohort("studio", 2, folder, days=0.2, seed=7)
    >>> lived.members, len(lived.logs())
    (['0001', '0002'], 2)
    """
    wanted: dict[str, Any] = {
        **wanted_life(days, seed, without),
        "residents": None,
        "profiles": None,
        "form": arguments.text("form", form, "parquet, csv, jsonl, sqlite or arrow"),
        "truth": None if truth is None else arguments.one_of("truth", truth, ("all", "brief")),
    }
    folder = place(arguments.path("folder", folder))
    if hasattr(profiles, "__index__"):
        wanted["residents"] = arguments.whole("profiles", profiles, 1, MOST, "a number of people, a file, or rows")
    elif isinstance(profiles, (str, PathLike)):
        try:
            wanted["profiles"] = (fspath(profiles), Path(profiles).read_text(encoding="utf-8"))
        except OSError as error:
            raise LogError(f"{fspath(profiles)}: {error.strerror}\n  hint: it is a CSV file with a row for each member") from None
    elif isinstance(profiles, Iterable) and not isinstance(profiles, Mapping):
        wanted["profiles"] = ("profiles", table(profiles))
    else:
        raise arguments.wrong("profiles", profiles, "a number of people, a file, or rows")
    if cluster is not None:
        arguments.text("cluster", cluster, "local, or the address of a scheduler such as tcp://10.0.0.1:8786")
    if workers is not None:
        arguments.whole("workers", workers, 1, 10_000)
        if cluster != "local":
            raise ValueError(f"workers is {workers}: only of a local cluster it is asked how many it has\n  hint: cluster=\"local\"")
    if progress is not None:
        arguments.flag("progress", progress)
    inner = _homebody.Cohort(opened("home", home)._scenario, wanted)
    inner.begin(folder)
    for remark in inner.remarks:
        warnings.warn(remark, stacklevel=2)
    if cluster is None:
        with Progress(f"living {inner.count} lives", progress) as told:
            inner.go_on(folder, told)
    else:
        from homebody.cluster import live

        live(inner, folder, cluster, workers, progress)
    return Cohort(folder)
