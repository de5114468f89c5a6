"""Scenarios: open, make, change, inspect and run them."""

from __future__ import annotations

import atexit
import json
import shutil
import warnings
from collections.abc import Mapping, Sequence
from functools import cached_property
from os import PathLike
from pathlib import Path, PurePosixPath
from typing import Any

from homebody import _homebody, arguments
from homebody.driver import Driver, MakeDriver, wrapped
from homebody.errors import LogError, Problem, ScenarioError, new_folder
from homebody.live import Live
from homebody.log import Log
from homebody.picture import Answer, Picture
from homebody.progress import Progress

#: The name of a scenario's main file.
ENTRY = "scenario.json"


def temporary_folder() -> Path:
    """A new folder that the program deletes when it ends."""
    import tempfile

    folder = Path(tempfile.mkdtemp(prefix="homebody-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


class Run(Log):
    """A complete run: its log, with the ground truth.

    >>> import homebody as hb
    >>> run = hb.scenario("studio").run(days=1, seed=7)
    >>> run.seed, run.stopped
    (7, False)
    """

    def __init__(self, scenario: Scenario, summary: dict[str, Any], remarks: Sequence[str] = ()) -> None:
        #: Its folder, which the program deletes when it ends, unless the caller chose the folder.
        self.folder = Path(summary["folder"])
        super().__init__(self.folder)
        self.scenario = scenario
        #: The summary: rows by sensor, sentences of routines whose simulation differs, a digest of the firings.
        self.summary = summary
        self._remarks_of_run = list(remarks)

    @property
    def remarks(self) -> list[str]:
        """The warnings of this run about settings that are probably not intended, and sentences about lines of the log that were left
        out."""
        return self._remarks_of_run + super().remarks

    @property
    def seed(self) -> int:
        """The seed of all its random numbers."""
        return int(self.summary["seed"])

    @property
    def stopped(self) -> bool:
        """Whether it was stopped early."""
        return bool(self.summary["stopped"])

    def save(self, folder: str | PathLike[str]) -> Path:
        """Copies it to a new folder, which the command and the browser page can open."""
        return new_folder(arguments.path("folder", folder), lambda to: shutil.copytree(self.folder, to))


class Plan:
    """The floor plan of a home."""

    def __init__(self, scenario: _homebody.Scenario) -> None:
        self._scenario = scenario

    def plot(self) -> Picture:
        """A picture of the plan."""
        return Picture(self._scenario.plan_svg())

    @property
    def rooms(self) -> list[str]:
        """The names of its rooms."""
        return self._scenario.rooms

    @property
    def places(self) -> dict[str, tuple[float, float]]:
        """Named points, in metres: rooms, furniture, places."""
        return self._scenario.places

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Left, bottom, right and top, in metres."""
        return self._scenario.bounds

    def room_at(self, x: float, y: float) -> str | None:
        """The room of a point."""
        return self._scenario.room_at(*arguments.point("a place", (x, y)))

    def _repr_svg_(self) -> str:
        return self._scenario.plan_svg()


class Scenario:
    """A checked scenario: a home, its sensors and its residents. :func:`scenario` opens one.

    >>> import homebody as hb
    >>> home = hb.scenario("tigerplace")
    >>> home.residents
    ['margaret']
    """

    def __init__(self, inner: _homebody.Scenario) -> None:
        self._scenario = inner

    @property
    def name(self) -> str:
        """Its name."""
        return self._scenario.name

    @property
    def residents(self) -> list[str]:
        """The names of its residents."""
        return self._scenario.residents

    @property
    def rooms(self) -> list[str]:
        """The names of its rooms."""
        return self._scenario.rooms

    @property
    def sensors(self) -> list[str]:
        """The names of its sensors."""
        return self._scenario.sensors

    @property
    def things(self) -> list[str]:
        """The things that residents can use: doors, furniture, lamps."""
        return self._scenario.things

    @property
    def texts(self) -> dict[str, str]:
        """Its files, by their names."""
        return self._scenario.texts

    @cached_property
    def plan(self) -> Plan:
        """The floor plan."""
        return Plan(self._scenario)

    def coverage(self) -> Answer:
        """The parts of the home that sensors see."""
        return Answer("Coverage", *self._scenario.coverage())

    def remarks(self, days: float | None = None) -> list[Problem]:
        """Settings that are valid but probably not intended."""
        return self._remarks(arguments.run_options({"days": days}))

    def _remarks(self, options: str) -> list[Problem]:
        remarks = json.loads(self._scenario.remarks(options))
        return [Problem(r["file"], r["line"], r["column"], r["what"], r.get("hint"), fix=r.get("fix")) for r in remarks]

    def data(self, name: str = "home.json") -> Any:
        """A JSON file as Python data, to change and pass to :meth:`change`.

        >>> import homebody as hb
        >>> sorted(hb.scenario("studio").data("scenario.json"))[:2]
        ['$schema', 'about']
        """
        try:
            return json.loads(self._scenario.text(arguments.text("name", name, "the name of a file")))
        except ValueError as error:
            raise ScenarioError(f"{name} is not valid JSON: {error}\n  hint: texts has the file as text") from None

    def change(self, files: Mapping[str, object]) -> Scenario:
        """A copy of the scenario with some files replaced or added, and checked. A file is a text, or data for JSON.

        >>> import homebody as hb
        >>> home = hb.scenario("studio")
        >>> data = home.data("home.json")
        >>> data["sensors"][0]["name"]
        'hall motion'
        >>> data["sensors"].append({**data["sensors"][0], "name": "another"})
        >>> "another" in home.change({"home.json": data}).sensors
        True
        """
        changed = arguments.mapping("files", files, "a mapping of file names to files")
        texts = self.texts | {name: _text(name, file) for name, file in changed.items()}
        return Scenario(_homebody.Scenario.from_texts(texts, self._scenario.entry))

    def add_sensor(self, **sensor: object) -> Scenario:
        """A copy of the scenario with one more sensor, with the keys of ``home.json``.

        >>> import homebody as hb
        >>> home = hb.scenario("studio")
        >>> area = [[1.7, 0.2], [3.4, 0.2], [3.4, 1.8], [1.7, 1.8]]
        >>> home = home.add_sensor(kind="ceiling_motion", name="bathroom ceiling", area=area)
        >>> "bathroom ceiling" in home.sensors
        True
        """
        return self._with("sensors", sensor)

    def add_room(self, **room: object) -> Scenario:
        """A copy of the scenario with one more room, with the keys of ``home.json``."""
        return self._with("rooms", room)

    def _with(self, key: str, value: object) -> Scenario:
        name = self.data(self._scenario.entry)["home"]
        home = self.data(name)
        home.setdefault(key, []).append(value)
        return self.change({name: home})

    def without_sensor(self, *names: str) -> Scenario:
        """A copy of the scenario without these sensors and their names in the log.

        >>> import homebody as hb
        >>> home = hb.scenario("studio")
        >>> fewer = home.without_sensor("bed motion", "table motion")
        >>> len(home.sensors) - len(fewer.sensors)
        2
        """
        for name in names:
            if name not in self.sensors:
                raise ValueError(f"name is {name!r}; expected a sensor of the home: {', '.join(self.sensors)}")
        own = self.data(self._scenario.entry)
        home = self.data(own["home"])
        home["sensors"] = [sensor for sensor in home["sensors"] if sensor["name"] not in names]
        files: dict[str, object] = {own["home"]: home}
        if own.get("logger") is not None:
            logger = self.data(own["logger"])
            logger["ids"] = {name: known for name, known in logger.get("ids", {}).items() if name not in names}
            files[own["logger"]] = logger
        return self.change(files)

    def routine(self, resident: str) -> str:
        """The routine of a resident, as text."""
        return self._scenario.text(self._routine_file(resident))

    def with_routine(self, resident: str, text: str) -> Scenario:
        """A copy of the scenario with another routine for a resident."""
        return self.change({self._routine_file(resident): arguments.text("text", text, "a routine: sentences in one text")})

    def _routine_file(self, resident: str) -> str:
        for file in self.data(self._scenario.entry)["residents"]:
            data = self.data(file)
            if data["name"] == resident:
                routine = data["driver"].get("routine")
                if routine is None:
                    raise ValueError(f"resident is {resident!r}, who has no routine")
                return str(routine)
        raise ValueError(f"resident is {resident!r}; expected one of {', '.join(self.residents)}")

    def save(self, folder: str | PathLike[str]) -> Path:
        """Writes its files to a new folder, which the command and the browser page can open."""
        folder = new_folder(arguments.path("folder", folder), lambda to: to.mkdir(parents=True))
        for name, written in self.texts.items():
            file = folder / _inside(name)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(written, encoding="utf-8")
        return folder

    def run(
        self,
        days: float | None = None,
        seed: int | None = None,
        *,
        into: str | PathLike[str] | None = None,
        # The options of a run, made from RunOptions in crates/homebody-simulation/src/run_options.rs.
        start: str | None = None,
        without: Sequence[str] = (),
        numbers: Mapping[str, float] | None = None,
        one_of_many: bool = False,
        # The end of the options.
        drivers: Mapping[str, MakeDriver] | None = None,
        progress: bool | None = None,
    ) -> Run:
        """Simulates the scenario and writes its sensor log and its ground truth.

        Other threads of Python continue meanwhile; Ctrl-C stops it. It warns about settings that are probably not intended, such as a
        condition that begins after the end; ``remarks`` of the run has the warnings, too. The run gets a new folder in ``into``, such as
        ``runs``; without ``into``, the program deletes the run when it ends. ``without`` leaves conditions out, ``numbers`` sets parameters
        of the models, ``one_of_many`` varies the residents as people vary, and ``drivers`` gives residents drivers in Python.

        >>> import homebody as hb
        >>> hb.scenario("tigerplace").run(days=0.5, seed=7).events
        <homebody.Table: ... rows of time, device, value>
        """
        options, own = arguments.run_options(locals()), self._drivers(drivers)
        runs = temporary_folder() if into is None else Path(arguments.path("into", into))
        shown = Progress(f"simulating {self.name}", progress)
        remarks = [str(remark) for remark in self._remarks(options)]
        for remark in remarks:
            warnings.warn(remark, stacklevel=2)
        with shown as tell:
            summary = self._scenario.run(runs, options, own, tell)
        return Run(self, json.loads(summary), remarks)

    def live(
        self,
        days: float | None = None,
        seed: int | None = None,
        *,
        # The options of a run, made from RunOptions in crates/homebody-simulation/src/run_options.rs.
        start: str | None = None,
        without: Sequence[str] = (),
        numbers: Mapping[str, float] | None = None,
        # The end of the options.
        drivers: Mapping[str, MakeDriver] | None = None,
    ) -> Live:
        """Begins a run that you step through.

        >>> import homebody as hb
        >>> live = hb.scenario("studio").live(days=1, seed=7)
        >>> events = live.step("8h")
        >>> live.now[-8:]
        '08:00:00'
        """
        return Live(self._scenario.live(arguments.run_options(locals()), self._drivers(drivers)))

    def _drivers(self, drivers: Mapping[str, MakeDriver] | None) -> dict[str, Any]:
        moved = arguments.mapping("drivers", drivers or {}, "a mapping of residents, such as {'margaret': Pacing}")
        return {name: wrapped(make, self.residents) for name, make in moved.items()}

    def __repr__(self) -> str:
        return f"<homebody.Scenario {self.name}: {', '.join(self.residents)}; {len(self.sensors)} sensors>"


def of_files(files: Mapping[str, object], entry: str = ENTRY) -> Scenario:
    """A scenario from files in memory, by their names. A file is a text, or data for JSON."""
    known = arguments.mapping("files", files, "a mapping of file names to files")
    return Scenario(_homebody.Scenario.from_texts({name: _text(name, file) for name, file in known.items()}, entry))


def _inside(name: str) -> str:
    """Checks that a file name stays inside the scenario's folder."""
    place = PurePosixPath(name)
    if place.is_absolute() or ".." in place.parts or "\\" in name:
        raise ValueError(f"the file {name!r} leads out of the scenario's folder")
    return name


def _text(name: str, file: object) -> str:
    _inside(name)
    if isinstance(file, str):
        return file
    try:
        return json.dumps(file, indent=2)
    except (TypeError, ValueError) as error:
        raise TypeError(f"the file {name!r} is neither a text nor data for JSON: {error}") from None


def scenario(what: str | PathLike[str] | Mapping[str, object], *, trusted: bool = False) -> Scenario:
    """Opens a scenario: a folder, the name of a template, or files in memory, by their names.

    A folder takes precedence over a template of the same name. One :class:`ScenarioError` contains all errors.

    >>> import homebody as hb
    >>> hb.scenario("tigerplace")
    <homebody.Scenario tigerplace: margaret; ...
    >>> hb.scenario("tigerplce")
    Traceback (most recent call last):
    homebody.errors.ScenarioError: no template is called "tigerplce"
    ...
    """
    if isinstance(what, Mapping):
        return of_files(what)
    if not isinstance(what, (str, PathLike)):
        raise arguments.wrong("what", what, "a folder, the name of a template, or a mapping of files")
    place = arguments.path("what", what)
    if not place:
        raise ValueError("what is empty; expected a folder, the name of a template, or a mapping of files")
    is_path = not isinstance(what, str) or "/" in place or Path(place).exists()
    if not is_path:
        return Scenario(_homebody.Scenario.template(place))
    try:
        return Scenario(_homebody.Scenario.at(place, trusted))
    except LogError as error:
        raise ScenarioError(str(error)) from None


def opened(name: str, home: Scenario | str | PathLike[str]) -> Scenario:
    """The given scenario, or the one that a path or a name opens."""
    if isinstance(home, Scenario):
        return home
    return scenario(arguments.path(name, home, "a scenario, its folder, or the name of a template"))


def templates() -> list[str]:
    """The names of the scenarios in the package.

    >>> "tigerplace" in templates()
    True
    """
    return _homebody.templates()


__all__ = ["Driver", "Plan", "Run", "Scenario", "scenario", "templates"]
