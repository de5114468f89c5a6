"""Environments for learning, as Gymnasium has them: ``pip install homebody[gym]``.

>>> from homebody.env import PlaceSensors
>>> env = PlaceSensors("studio", sensors=2)
>>> observed, told = env.reset(seed=1)
>>> observed, reward, over, cut, told = env.step(int(env.action_space.sample()))
>>> over, cut
(False, False)
"""

from __future__ import annotations

from typing import Any

from homebody.errors import needs
from homebody.picture import Picture
from homebody.scenario import Scenario, scenario

try:
    import gymnasium
    import numpy
    from gymnasium import spaces
except ImportError:
    raise needs("gymnasium", "homebody.env", "gym") from None


class PlaceSensors(gymnasium.Env[Any, Any]):
    """Places ceiling sensors in a home, one at a step, so that as much of the floor as possible is seen.

    An action is one of the places that sensors may have: points of a grid in rooms. What is observed is by place whether a sensor is
    there. The reward is by how much the share of the floor that is seen has grown, from 0 to 1. An episode is over when all sensors are
    placed. Sensors of the home that look for movement are taken away first; nothing is left to chance but the actions.
    """

    metadata = {"render_modes": []}

    def __init__(self, home: Scenario | str = "tigerplace", sensors: int = 4, step_m: float = 1.0) -> None:
        if sensors < 1:
            raise ValueError(f"sensors is {sensors}: at least one is placed")
        if not step_m > 0:
            raise ValueError(f"step_m is {step_m}: it is a length in metres")
        self._home = _without_motion(home if isinstance(home, Scenario) else scenario(home))
        self._count = sensors
        left, bottom, right, top = self._home.plan.bounds
        grid = (
            (round(left + step_m * (x + 0.5), 3), round(bottom + step_m * (y + 0.5), 3))
            for y in range(int((top - bottom) / step_m))
            for x in range(int((right - left) / step_m))
        )
        #: Half the side of the square that a sensor sees, in metres.
        self.half_m = step_m / 2
        #: Where sensors may be, in metres: where all of their square is in one room.
        self.places = [place for place in grid if len({self._home.plan.room_at(*at) for at in self._corners(place)}) == 1]
        self.places = [place for place in self.places if self._home.plan.room_at(*place) is not None]
        if not self.places:
            raise ValueError(f"step_m is {step_m}: no square of such a grid is in a room")
        self.action_space = spaces.Discrete(len(self.places))
        self.observation_space = spaces.MultiBinary(len(self.places))
        self._seen_alone: dict[tuple[int, ...], float] = {}
        self._placed: list[int] = []

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Takes all sensors away."""
        super().reset(seed=seed)
        self._placed = []
        return self._observed(), {"seen": 0.0}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Places a sensor."""
        before = self._seen()
        self._placed.append(int(action))
        seen = self._seen()
        return self._observed(), seen - before, len(self._placed) >= self._count, False, {"seen": seen}

    def scenario(self) -> Scenario:
        """The home with the sensors that were placed."""
        home = self._home
        for number, place in enumerate(sorted(set(self._placed)), 1):
            home = home.add_sensor(
                kind="ceiling_motion", name=f"placed {number}", area=self._corners(self.places[place])
            )
        return home

    def _corners(self, place: tuple[float, float]) -> list[list[float]]:
        (x, y), half = place, self.half_m * 0.9
        return [[round(x + dx * half, 3), round(y + dy * half, 3)] for dx, dy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]

    def plot(self) -> Picture:
        """What they see."""
        return self.scenario().coverage().plot()

    def _observed(self) -> Any:
        observed = numpy.zeros(len(self.places), dtype=numpy.int8)
        observed[self._placed] = 1
        return observed

    def _seen(self) -> float:
        placed = tuple(sorted(set(self._placed)))
        if not placed:
            return 0.0
        if placed not in self._seen_alone:
            seen = self.scenario().coverage().data["whole"]["seen_by"]
            self._seen_alone[placed] = 1.0 - float(seen["none"])
        return self._seen_alone[placed]


def _without_motion(home: Scenario) -> Scenario:
    """The home without the sensors that see."""
    sensors = home.data(home.data("scenario.json")["home"])["sensors"]
    return home.without_sensor(*(sensor["name"] for sensor in sensors if str(sensor["kind"]).endswith("motion")))
