"""A run that you step through."""

from __future__ import annotations

import json
from dataclasses import dataclass

from homebody import _homebody
from homebody.log import seconds
from homebody.table import Table


@dataclass(frozen=True)
class Body:
    """The position of a person at home, in metres, and the posture."""

    x: float
    y: float
    posture: str
    room: str | None


@dataclass(frozen=True)
class Scene:
    """The state of a run at a moment."""

    #: By resident and visitor; ``None`` for a person who is out.
    bodies: dict[str, Body | None]
    #: The things that are on or open.
    on: list[str]


class Live:
    """A run in progress. The length of the steps does not change it."""

    def __init__(self, run: _homebody.SteppedRun) -> None:
        self._run = run

    def step(self, span: str | float = "1h") -> Table:
        """Simulates a span and returns its events: ``time``, ``device``, ``value``."""
        return Table(self._run.step(seconds(span)))

    @property
    def now(self) -> str:
        """The wall-clock time of the home."""
        return self._run.progress[2]

    @property
    def done(self) -> bool:
        """Whether the run has ended."""
        simulated, length, _ = self._run.progress
        return simulated >= length

    @property
    def lived_s(self) -> float:
        """The simulated time, in seconds."""
        return self._run.progress[0]

    def scene(self) -> Scene:
        """The positions of people, and the things that are on. Reading it does not change the run."""
        scene = json.loads(self._run.scene())
        bodies = {name: body and Body(**body) for name, body in scene["bodies"].items()}
        return Scene(bodies, scene["on"])
