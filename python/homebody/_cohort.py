"""Cohorts: many lives side by side, on this machine or on a cluster."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from homebody import _homebody, arguments
from homebody.errors import LogError
from homebody.log import Log
from homebody.profiles import MOST, table
from homebody.progress import Progress
from homebody.scenario import Scenario, opened, wanted_life

#: The file that says what a cohort is, and who was lived.
LIST = "cohort.json"

Profiles = int | str | PathLike[str] | Iterable[Mapping[str, object]]


class Cohort:
    """A cohort in its folder.

    Logs are ``log/member=0001/log.parquet`` and so on, truths lie apart in ``truth/member=0001/``; both are read as sets that are
    parted by member. ``cohort.json`` is the manifest: what was asked, by which version, whose seeds, and a digest for each member.
    """

    def __init__(self, folder: str | PathLike[str]) -> None:
        self.folder = Path(arguments.path("folder", folder, "the folder of a cohort"))
        try:
            told = (self.folder / LIST).read_text(encoding="utf-8")
        except OSError as error:
            raise LogError(f"{self.folder} is no cohort: {error.strerror}") from None
        try:
            #: The manifest.
            self.manifest: dict[str, Any] = json.loads(told)
        except ValueError as error:
            raise LogError(f"{self.folder / LIST} is no JSON: {error}") from None

    @property
    def members(self) -> list[str]:
        """The names of those who were lived; nobody until the cohort is over."""
        return [member["name"] for member in self.manifest["members"]]

    def member(self, name: str) -> Log:
        """The log of a member, with its truth."""
        if name not in self.members:
            raise ValueError(f"name {name!r}: nobody who was lived is called so; members lists them")
        return Log(self.folder / "members" / name)

    def logs(self) -> list[Path]:
        """The files of all logs, in the order of members."""
        return sorted((self.folder / "log").glob("member=*/log.*"))

    def truths(self, name: str = "activity") -> list[Path]:
        """The files of a table of all truths, in the order of members."""
        return sorted((self.folder / "truth").glob(f"member=*/truth.{name}.*"))

    def __len__(self) -> int:
        return len(self.manifest["members"])

    def __repr__(self) -> str:
        return f"<homebody.Cohort {self.folder}: {len(self)} lives of {self.manifest['scenario']}>"


def cohort(
    home: Scenario | str | PathLike[str],
    profiles: Profiles,
    folder: str | PathLike[str],
    *,
    days: float | None = None,
    seed: int | None = None,
    without: Sequence[str] = (),
    form: str = "parquet",
    cluster: str | None = None,
    workers: int | None = None,
    progress: bool | None = None,
) -> Cohort:
    """Lives many people in a home into a folder, all side by side: with the same bytes wherever that is done.

    ``profiles`` is how many people, of whom each differs as people do; or a list of them: a file of CSV, or rows such as
    :func:`homebody.draw` makes. Without ``cluster`` threads of this program live them. ``local`` is a cluster of processes on this
    machine, and ``tcp://...`` the scheduler of one of Dask, whose workers see the folder under the same path.

    A cohort that was stopped or killed is gone on with by the same call.

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
    }
    folder = Path(arguments.path("folder", folder)).absolute()
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
        workers = None if workers is None else arguments.whole("workers", workers, 1, 10_000)
    inner = _homebody.Cohort(opened("home", home)._scenario, wanted)
    inner.begin(folder)
    if cluster is None:
        with Progress(f"living {inner.count} lives", progress) as told:
            inner.go_on(folder, told)
    else:
        from homebody.cluster import live

        live(inner, folder, cluster, workers, progress)
    return Cohort(folder)
