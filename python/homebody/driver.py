"""Drivers in Python: classes that control a resident.

>>> import random
>>> import homebody as hb
>>> class Pacing:
...     def __init__(self, seed):
...         self.random = random.Random(seed)
...         self.ends = [(5.0, 3.6), (8.4, 3.6)]
...     def next(self, around):
...         if around.body is None:
...             return hb.Rest(60, at=self.ends[0])
...         if around.body.at == self.ends[0]:
...             return hb.Stride(self.ends[1], 5)
...         if around.body.at == self.ends[1] and self.random.random() < 0.5:
...             return hb.Rest(60)
...         return hb.Stride(self.ends[0], 5)
>>> run = hb.scenario("tigerplace").run(days=0.1, seed=7, drivers={"margaret": Pacing})
>>> len(run.events) > 0
True
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

from homebody import arguments

Point = tuple[float, float]


@dataclass(frozen=True)
class Stride:
    """Walk straight to a point, in metres, in this number of seconds."""

    to: Point
    seconds: float
    posture: str = "standing"


@dataclass(frozen=True)
class Rest:
    """Keep still for this number of seconds; ``float("inf")`` means for ever. ``at`` is the place at the start and on coming home."""

    seconds: float
    at: Point | None = None
    posture: str = "standing"


@dataclass(frozen=True)
class Stir:
    """Move on the spot for this number of seconds; ``amplitude_m`` is the reach of the movements."""

    seconds: float
    amplitude_m: float = 0.3
    at: Point | None = None
    posture: str = "standing"


@dataclass(frozen=True)
class Away:
    """Be out of the home for this number of seconds."""

    seconds: float


@dataclass(frozen=True)
class Use:
    """Turn a thing on or off, or open or close it. Takes no time."""

    thing: str
    on: bool


@dataclass(frozen=True)
class Doing:
    """Label the following steps in the ground truth; ``None`` ends the label. Takes no time."""

    activity: str | None


Answer = Stride | Rest | Stir | Away | Use | Doing


@dataclass(frozen=True)
class Body:
    """A body in the home."""

    resident: int
    #: Its position, in metres.
    at: Point
    #: The end of its present movement.
    to: Point
    posture: str
    name: str | None = None


@dataclass(frozen=True)
class Surroundings:
    """The input of a driver."""

    #: Seconds since the start of the run.
    now: float
    #: Its own body; ``None`` while it is away, and before its first answer.
    body: Body | None
    #: Its room.
    room: str | None
    #: The bodies of the other people at home.
    others: list[Body] = field(default_factory=list)
    #: The things that are on or open.
    on: frozenset[str] = frozenset()


class Driver(Protocol):
    """Controls a resident. Homebody calls it when its last step has ended, and again after each step that takes no time.

    A run is as reproducible as the random numbers of its driver: draw them from the seed that the driver gets. :func:`copy.deepcopy`
    must be able to copy its state.
    """

    def next(self, around: Surroundings) -> Answer:
        """Returns the next step."""
        ...


#: Makes a driver from the run's seed: a class, or a function.
MakeDriver = Callable[[int], Driver]


def _lasting(name: str, value: object) -> float:
    """The duration of a step: a microsecond at least, because times are whole microseconds."""
    lasts = arguments.number(name, value)
    if not lasts >= 1e-6:
        raise ValueError(f"{name} is {lasts}; expected a number of seconds above 0")
    return lasts


class _Asked:
    """Calls a driver with the tuples of the part in Rust."""

    def __init__(self, driver: Driver, residents: Sequence[str]) -> None:
        self.driver = driver
        self.residents = list(residents)

    def _body(self, told: tuple[int, Point, Point, str]) -> Body:
        resident = told[0]
        return Body(*told, name=self.residents[resident] if resident < len(self.residents) else None)

    def __call__(
        self, now: int, body: Any, room: str | None, others: list[Any], on: list[str]
    ) -> tuple[str, object]:
        own = None if body is None else self._body(body)
        around = Surroundings(now / 1e6, own, room, [self._body(other) for other in others], frozenset(on))
        answer = self.driver.next(around)
        match answer:
            case Stride(to, lasts, posture):
                place = arguments.point("Stride.to", to)
                return "stride", (place, _lasting("Stride.seconds", lasts), arguments.text("Stride.posture", posture))
            case Rest(lasts, at, posture):
                where = None if at is None else arguments.point("Rest.at", at)
                return "rest", (where, _lasting("Rest.seconds", lasts), arguments.text("Rest.posture", posture))
            case Stir(lasts, amplitude_m, at, posture):
                where = None if at is None else arguments.point("Stir.at", at)
                seconds, amplitude_m = _lasting("Stir.seconds", lasts), arguments.number("Stir.amplitude_m", amplitude_m)
                return "stir", (where, seconds, arguments.text("Stir.posture", posture), amplitude_m)
            case Away(lasts):
                return "out", _lasting("Away.seconds", lasts)
            case Use(thing, is_on):
                return "use", (arguments.text("Use.thing", thing, "the name of a thing"), arguments.flag("Use.on", is_on))
            case Doing(activity):
                return "doing", activity if activity is None else arguments.text("Doing.activity", activity)
        raise TypeError(
            f"{type(self.driver).__name__}.next returned {answer!r}; expected Stride, Rest, Stir, Away, Use or Doing"
        )


def wrapped(make: MakeDriver, residents: Sequence[str]) -> Callable[[int], _Asked]:
    """The function that the part in Rust calls with a seed, and then with surroundings."""
    if not callable(make):
        raise TypeError(f"a driver is {make!r}; expected a class or a function that takes the seed")
    _takes_a_seed(make)

    def made(seed: int) -> _Asked:
        driver = make(seed)
        if not callable(getattr(driver, "next", None)):
            raise TypeError(f"a driver needs a method next(around); {driver!r} does not have it")
        return _Asked(driver, residents)

    return made


def _takes_a_seed(make: Callable[..., object]) -> None:
    from inspect import signature

    try:
        known = signature(make)
    except (TypeError, ValueError):
        # Code outside Python has no signature.
        return
    try:
        known.bind(0)
    except TypeError as error:
        name = getattr(make, "__qualname__", repr(make))
        raise arguments.wrong("a driver", make, f"a class or a function that takes only the seed, as {name}(seed): {error}") from None
