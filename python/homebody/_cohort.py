"""Cohorts: many lives side by side, on this machine or on a cluster."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from homebody import _homebody
from homebody.errors import LogError
from homebody.log import Log
from homebody.profiles import table
from homebody.progress import Progress
from homebody.scenario import Scenario, scenario

#: The file that says what a cohort is, and who was lived.
LIST = "cohort.json"

Profiles = int | str | PathLike[str] | Iterable[Mapping[str, object]]


class Cohort:
    """A cohort in its folder.

    Logs are ``log/member=0001/log.parquet`` and so on, truths lie apart in ``truth/member=0001/``; both are read as sets that are
    parted by member. ``cohort.json`` is the manifest: what was asked, by which version, whose seeds, and a digest for each member.
    """

    def __init__(self, folder: str | PathLike[str]) -> None:
        self.folder = Path(folder)
        try:
            text = (self.folder / LIST).read_text(encoding="utf-8")
        except OSError as error:
            raise LogError(f"{self.folder} is no cohort: {error.strerror}") from None
        #: The manifest.
        self.manifest: dict[str, Any] = json.loads(text)

    @property
    def members(self) -> list[str]:
        """The names of those who were lived; nobody until the cohort is over."""
        return [member["name"] for member in self.manifest["members"]]

    def member(self, name: str) -> Log:
        """The log of a member, with its truth."""
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
    opened = home if isinstance(home, Scenario) else scenario(home)
    wanted: dict[str, Any] = {
        "residents": None,
        "profiles": None,
        "days": None if days is None else float(days),
        "seed": seed,
        "without": list(without),
        "form": form,
    }
    if isinstance(profiles, bool):
        raise TypeError(f"profiles is {profiles!r}: it is a number of people, a file, or rows")
    if isinstance(profiles, int):
        if not 1 <= profiles <= 100_000:
            raise ValueError(f"profiles is {profiles}: a cohort has 1 to 100,000 members")
        wanted["residents"] = profiles
    elif isinstance(profiles, (str, PathLike)):
        try:
            wanted["profiles"] = (fspath(profiles), Path(profiles).read_text(encoding="utf-8"))
        except OSError as error:
            raise LogError(f"{fspath(profiles)}: {error.strerror}\n  hint: it is a CSV file with a row for each member") from None
    else:
        wanted["profiles"] = ("profiles", table(profiles))
    inner = _homebody.Cohort(opened._scenario, wanted)
    folder = Path(folder).absolute()
    inner.begin(folder)
    if cluster is None:
        with Progress(f"living {inner.count} lives", progress) as told:
            inner.go_on(folder, told)
    else:
        from homebody.cluster import live

        live(inner, folder, cluster, workers, progress)
    return Cohort(folder)
