"""Drivers in Python: who decides what somebody does next.

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
    """To walk straight to a point, in metres, in so many seconds."""

    to: Point
    seconds: float
    posture: str = "standing"


@dataclass(frozen=True)
class Rest:
    """To keep still for so many seconds; ``float("inf")`` for ever. ``at`` says where, of who has no body yet or comes home."""

    seconds: float
    at: Point | None = None
    posture: str = "standing"


@dataclass(frozen=True)
class Stir:
    """To move on the spot for so many seconds; ``amplitude_m`` is how far what moves moves."""

    seconds: float
    amplitude_m: float = 0.3
    at: Point | None = None
    posture: str = "standing"


@dataclass(frozen=True)
class Away:
    """To be out of the home for so many seconds."""

    seconds: float


@dataclass(frozen=True)
class Use:
    """To turn a thing on or off, to open or close it. It takes no time."""

    thing: str
    on: bool


@dataclass(frozen=True)
class Doing:
    """From now on the activity has this label, for the truth; ``None`` for nothing that has a name. It takes no time."""

    activity: str | None


Answer = Stride | Rest | Stir | Away | Use | Doing


@dataclass(frozen=True)
class Body:
    """A body in the home."""

    resident: int
    #: Where it is, in metres.
    at: Point
    #: Where its present movement leads.
    to: Point
    posture: str
    name: str | None = None


@dataclass(frozen=True)
class Surroundings:
    """What a driver is asked with."""

    #: Seconds since the start of the run.
    now: float
    #: Its own body; ``None`` while it is away, and before its first answer.
    body: Body | None
    #: The room that it is in.
    room: str | None
    #: The bodies of the others who are at home.
    others: list[Body] = field(default_factory=list)
    #: The things that are on, or open.
    on: frozenset[str] = frozenset()


class Driver(Protocol):
    """Who decides. It is asked whenever its last answer has ended, and again after each that took no time.

    Its life is as reproducible as its own randomness is: draw it from the seed that it is made with. What it remembers must be such
    that :func:`copy.deepcopy` copies it.
    """

    def next(self, around: Surroundings) -> Answer:
        """What to do now."""
        ...


#: What makes a driver of the run's seed: a class, or a function.
MakeDriver = Callable[[int], Driver]


def _lasting(name: str, value: object) -> float:
    """How long an answer is to last: a microsecond at least, as instants are whole ones."""
    lasts = arguments.number(name, value)
    if not lasts >= 1e-6:
        raise ValueError(f"{name} is {lasts}: it is a number of seconds, longer than nothing")
    return lasts


class _Asked:
    """Asks a driver in the tuples that the other side has."""

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
            f"{type(self.driver).__name__}.next answered {answer!r}: it answers with Stride, Rest, Stir, Away, Use or Doing"
        )


def wrapped(make: MakeDriver, residents: Sequence[str]) -> Callable[[int], _Asked]:
    """What the other side calls with a seed, and then with surroundings."""
    if not callable(make):
        raise TypeError(f"a driver is a class or a function that is called with the seed, and not {make!r}")
    _takes_a_seed(make)

    def made(seed: int) -> _Asked:
        driver = make(seed)
        if not callable(getattr(driver, "next", None)):
            raise TypeError(f"a driver has a method next(around), and {driver!r} has none")
        return _Asked(driver, residents)

    return made


def _takes_a_seed(make: Callable[..., object]) -> None:
    from inspect import signature

    try:
        known = signature(make)
    except (TypeError, ValueError):
        # What is not written in Python does not tell.
        return
    try:
        known.bind(0)
    except TypeError as error:
        name = getattr(make, "__qualname__", repr(make))
        raise arguments.wrong("a driver", make, f"made with the seed alone, as {name}(seed), which it does not take: {error}") from None
