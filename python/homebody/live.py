"""A run that is lived step by step."""

from __future__ import annotations

import json
from dataclasses import dataclass

from homebody import _homebody
from homebody.log import seconds
from homebody.table import Table


@dataclass(frozen=True)
class Body:
    """Where somebody is at home, in metres, and how they hold themselves."""

    x: float
    y: float
    posture: str
    room: str | None


@dataclass(frozen=True)
class Scene:
    """What a run looks like at an instant."""

    #: By resident and visitor; ``None`` for who is out.
    bodies: dict[str, Body | None]
    #: The things that are on, or open.
    on: list[str]


class Live:
    """A run under way. Steps change nothing of what is lived: cut as one likes, it is the same."""

    def __init__(self, run: _homebody.LiveRun) -> None:
        self._run = run

    def step(self, span: str | float = "1h") -> Table:
        """Lives on for a span, and returns what the sensors said: ``time``, ``device``, ``value``."""
        return Table(self._run.step(seconds(span)))

    @property
    def now(self) -> str:
        """What the clock on the wall says."""
        return self._run.progress[2]

    @property
    def done(self) -> bool:
        """Whether it has come to its end."""
        lived, length, _ = self._run.progress
        return lived >= length

    @property
    def lived_s(self) -> float:
        """How many seconds were lived."""
        return self._run.progress[0]

    def scene(self) -> Scene:
        """Who is where, and what is on. Looking changes nothing."""
        told = json.loads(self._run.scene())
        bodies = {name: body and Body(**body) for name, body in told["bodies"].items()}
        return Scene(bodies, told["on"])
