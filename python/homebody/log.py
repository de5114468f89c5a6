"""Logs of runs and of real homes."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from homebody import _homebody, arguments
from homebody.errors import needs
from homebody.picture import Answer
from homebody.progress import Progress
from homebody.table import Table

if TYPE_CHECKING:
    import pandas

    from homebody.scenario import Scenario

#: The resolution of times, in seconds.
INSTANT_S = 1e-6

_SECONDS = {"s": 1.0, "m": 60.0, "min": 60.0, "h": 3600.0, "d": 86400.0}


def seconds(span: str | float) -> float:
    """A span of time in seconds: a number, or a text such as ``60s``, ``15m`` or ``1h``.

    >>> seconds("1.5h")
    5400.0
    """
    if not isinstance(span, str):
        try:
            lasts = arguments.number("span", span)
        except TypeError:
            raise arguments.wrong("span", span, "a number of seconds, or a text such as '60s'") from None
    else:
        match = re.fullmatch(r"\s*([0-9]+(?:\.[0-9]*)?|\.[0-9]+)\s*(s|min|m|h|d)\s*", span)
        if match is None:
            raise ValueError(f"span is {span!r}; expected a number with its unit, such as 60s, 15m, 1h")
        lasts = float(match[1]) * _SECONDS[match[2]]
    if not lasts > 0:
        raise ValueError(f"span is {span!r}; expected more than 0")
    if lasts < INSTANT_S:
        raise ValueError(f"span is {span!r}; expected at least a microsecond, the resolution of times")
    return lasts


@dataclass(frozen=True)
class Pyadlml:
    """A log in the form of pyadlml: events of devices, and activities, in wall-clock time."""

    #: ``time``, ``device``, ``value``; on and off are true and false.
    devices: pandas.DataFrame
    #: ``start_time``, ``end_time``, ``activity``.
    activities: pandas.DataFrame


class Log:
    """A log, with its ground truth if it has one. :func:`homebody.read` reads one; a run has one.

    >>> import homebody as hb
    >>> run = hb.scenario("studio").run(days=1, seed=7)
    >>> log = hb.read(run.folder)
    >>> len(log.events) == len(run.events)
    True
    """

    def __init__(self, place: str | PathLike[str], time_zone: str | None = None) -> None:
        #: Its location.
        self.place = arguments.path("place", place, "the folder of a run, or a file with a log")
        if time_zone is not None:
            arguments.text("time_zone", time_zone, "the name of a zone, such as 'Europe/Berlin'")
        self._log = _homebody.Log(self.place, time_zone)
        self._asked_zone = time_zone

    @property
    def time_zone(self) -> str | None:
        """The time zone of its home; ``None`` if unknown: then its times are wall-clock times without a zone."""
        return self._log.time_zone

    @property
    def sensors(self) -> list[str]:
        """The names of its sensors."""
        return self._log.sensors

    @property
    def residents(self) -> list[str]:
        """The people in its ground truth, visitors included."""
        return [name for name in self._log.residents if name]

    @property
    def remarks(self) -> list[str]:
        """Sentences about lines that Homebody left out, and about times in UTC if the zone is unknown."""
        return self._log.remarks

    @cached_property
    def events(self) -> Table:
        """The events: ``time``, ``device``, ``value``."""
        return Table(self._log.events())

    @cached_property
    def activities(self) -> Table:
        """The activities of the ground truth: ``start_time``, ``end_time``, ``activity``, ``resident``."""
        return Table(self._log.spans(False))

    @cached_property
    def rooms(self) -> Table:
        """The rooms of people, from the ground truth: ``start_time``, ``end_time``, ``room``, ``resident``."""
        return Table(self._log.spans(True))

    @cached_property
    def movement(self) -> Table:
        """The movements of bodies, from the ground truth."""
        return self.truth("movement")

    def truth(self, table: str) -> Table:
        """A table of the ground truth by its name, such as ``act``, ``need`` or ``condition``."""
        return Table(self._log.truth(arguments.text("table", table, "the name of a table of the truth")))

    def windows(self, span: str | float = "60s") -> Table:
        """Windows of equal length, with a row for each resident: ``time``, ``resident``, ``label`` (the activity of most of the window),
        ``room``, and the features ``hour``, ``weekday``, ``last`` (the last sensor to report), and the number of reports of each sensor.

        Windows follow the wall clock of the home: ``1d`` runs from midnight to midnight, ``1h`` begins at full hours, ``6h`` at 0, 6, 12
        and 18. When clocks change, a window is shorter or longer: a day has 23 or 25 hours. An hour that comes twice gives two windows.
        If ``time_zone`` is ``None``, the wall clock is that of the log's own times.

        >>> import homebody as hb
        >>> windows = hb.scenario("studio").run(days=1, seed=7).windows("5m")
        >>> windows.columns[:4]
        ['time', 'resident', 'label', 'room']
        """
        return Table(self._log.windows(seconds(span)))

    def labelled(self) -> Table:
        """Each event with its resident, room, activity and cause, as ``homebody label`` writes them. The columns
        are ``time``, ``device``, ``value``, ``resident``, ``room``, ``activity``, ``cause``, ``thing``."""
        import tempfile

        with tempfile.TemporaryDirectory(prefix="homebody-") as folder:
            return Table(self._log.labelled(Path(folder) / "labelled.arrow"))

    def day(self, day: int | str = "first") -> Answer:
        """One day: by its number from 0, by its date, or ``first`` or ``last``. The picture has 24 hours of the wall clock. When
        clocks go forward, one of them is empty; when they go back, one holds two."""
        if not isinstance(day, str):
            day = str(arguments.whole("day", day, -(10**9), 10**9, "a number from 0, a date, or first or last"))
        return Answer("Day", *self._log.day(day))

    def density(self) -> Answer:
        """The amount of movement in each hour of each day. An hour that clocks skip has no data, and one that comes twice has two
        recorded hours."""
        return Answer("Density", *self._log.density())

    def measures(self) -> Answer:
        """The measures of each day: bed, bathroom, meals, outings, pace."""
        return Answer("Measures", *self._log.measures())

    @property
    def dates(self) -> tuple[str, str] | None:
        """The first and the last day."""
        return self._log.dates

    def to_pyadlml(self, resident: str | None = None) -> Pyadlml:
        """The log in the form of pyadlml, with the activities of one resident."""
        needs("pandas", "to_pyadlml", "pandas")
        import pandas

        devices = self.events.to_pandas()
        meant = {"ON": True, "OFF": False, "OPEN": True, "CLOSE": False}
        devices["device"] = devices["device"].astype(str)
        devices["value"] = devices["value"].astype(object).map(lambda value: meant.get(value, value))
        activities = self.activities.to_pandas()
        known = self.residents
        if resident is None and known:
            resident = known[0]
        if resident is not None and known:
            if resident not in known:
                raise ValueError(f"resident is {resident!r}; expected one of {', '.join(known)}")
            activities = activities[activities["resident"] == resident]
        activities = activities[["start_time", "end_time", "activity"]].reset_index(drop=True)
        activities["activity"] = activities["activity"].astype(str)
        for frame in (devices, activities):
            for column in frame.columns:
                if isinstance(frame[column].dtype, pandas.DatetimeTZDtype):
                    frame[column] = frame[column].dt.tz_localize(None)
        return Pyadlml(devices, activities)

    def __repr__(self) -> str:
        return f"<homebody.{type(self).__name__} {self.place}>"


def read(place: str | PathLike[str], time_zone: str | None = None) -> Log:
    """Reads a log: the folder of a run, a file of any form that Homebody knows, or ``FORM:FILE``. Pass ``time_zone``, the zone of its
    home, if the log does not contain it."""
    return Log(place, time_zone)


class Comparison:
    """The agreement of two logs."""

    def __init__(self, figures: str, words: str) -> None:
        #: The figures, as in the command's ``--json``.
        self.data: dict[str, Any] = json.loads(figures)
        self._words = words

    def __str__(self) -> str:
        return self._words

    __repr__ = __str__


def _place(name: str, log: Log | str | PathLike[str]) -> tuple[str, str | None]:
    """The location of a log, and the zone that the caller gave."""
    return (log.place, log._asked_zone) if isinstance(log, Log) else (arguments.path(name, log, "a log, or its path"), None)


def compare(a: Log | str | PathLike[str], b: Log | str | PathLike[str]) -> Comparison:
    """Compares two logs; the second is the reference.

    >>> import homebody as hb
    >>> home = hb.scenario("studio")
    >>> result = hb.compare(home.run(days=1, seed=1), home.run(days=1, seed=2))
    >>> 0.3 < result.data["agreement_by_sensor"] < 1
    True
    """
    return Comparison(*_homebody.compare(_place("a", a), _place("b", b)))


class Translated(Log):
    """A log with the located positions of its residents, and the simulation of them."""

    def __init__(self, folder: Path, report: str) -> None:
        super().__init__(folder / "run")
        #: The folder of results: ``where.csv``, ``rooms.csv``, ``report.json``, and a scenario.
        self.folder = folder
        #: Events that did not fit, sensors that are not credible, and how well the path explains the log.
        self.report: dict[str, Any] = json.loads(report)


def translate(
    log: Log | str | PathLike[str],
    home: Scenario | str | PathLike[str],
    to: str | PathLike[str] | None = None,
    *,
    progress: bool | None = None,
) -> Translated:
    """Locates the residents in the plan of the home at each moment of a log. ``to`` is a new folder for the results; the default is a
    temporary folder, which the program deletes when it ends."""
    from homebody.scenario import opened, temporary_folder

    inner = opened("home", home)._scenario
    folder = Path(arguments.path("to", to)) if to is not None else temporary_folder() / "walked"
    place, zone = _place("log", log)
    with Progress("locating", progress) as told:
        report = _homebody.translate(place, zone, inner, folder, told)
    return Translated(folder, report)
