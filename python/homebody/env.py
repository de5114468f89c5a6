"""Gymnasium environments: ``pip install homebody[gym]``.

>>> from homebody.env import PlaceSensors
>>> env = PlaceSensors("studio", sensors=2)
>>> observed, info = env.reset(seed=1)
>>> observed, reward, over, cut, info = env.step(int(env.action_space.sample()))
>>> over, cut
(False, False)
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Any

from homebody import _homebody, arguments
from homebody.errors import needs
from homebody.picture import Picture
from homebody.scenario import Scenario, opened

needs("numpy", "homebody.env", "gym")
needs("gymnasium", "homebody.env", "gym")

import gymnasium  # noqa: E402
import numpy  # noqa: E402
from gymnasium import spaces  # noqa: E402


class PlaceSensors(gymnasium.Env[Any, Any]):
    """Places ceiling sensors in a home, one per step, so that they see as much of the floor as possible.

    An action is a place for a sensor: a point of a grid in the rooms. The observation is, for each place, 1 if a sensor is there. The
    reward is the increase in the share of the floor that sensors see, from 0 to 1. An episode ends when all sensors are placed. The
    environment first removes the home's own motion sensors. It is deterministic.
    """

    metadata = {"render_modes": []}

    def __init__(self, home: Scenario | str = "tigerplace", sensors: int = 4, step_m: float = 1.0) -> None:
        sensors, step_m = arguments.whole("sensors", sensors, 1, 1000), arguments.number("step_m", step_m)
        if not step_m > 0:
            raise ValueError(f"step_m is {step_m}; expected a length in metres above 0")
        self._home = _without_motion(opened("home", home))
        self._count = sensors
        left, bottom, right, top = self._home.plan.bounds
        grid = (
            (round(left + step_m * (x + 0.5), 3), round(bottom + step_m * (y + 0.5), 3))
            for y in range(int((top - bottom) / step_m))
            for x in range(int((right - left) / step_m))
        )
        #: Half the side of the square that a sensor sees, in metres.
        self.half_m = step_m / 2
        #: The places for sensors, in metres: points with their whole square in one room.
        self.places = [place for place in grid if len({self._home.plan.room_at(*at) for at in self._corners(place)}) == 1]
        self.places = [place for place in self.places if self._home.plan.room_at(*place) is not None]
        if not self.places:
            raise ValueError(f"step_m is {step_m}: no square of this grid is inside a room")
        self.action_space = spaces.Discrete(len(self.places))
        self.observation_space = spaces.MultiBinary(len(self.places))
        self._seen_alone: dict[tuple[int, ...], float] = {}
        self._placed: list[int] = []

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Removes all sensors."""
        super().reset(seed=seed)
        self._placed = []
        return self._observed(), {"seen": 0.0}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Places a sensor."""
        place = arguments.whole("action", action, 0, len(self.places) - 1, "one of the places: a whole number")
        before = self._seen()
        self._placed.append(place)
        seen = self._seen()
        return self._observed(), seen - before, len(self._placed) >= self._count, False, {"seen": seen}

    def scenario(self) -> Scenario:
        """The home with the placed sensors."""
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
        """The area that the sensors see."""
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
    """The home without its motion sensors."""
    sensors = home.data(home.data("scenario.json")["home"])["sensors"]
    return home.without_sensor(*(sensor["name"] for sensor in sensors if str(sensor["kind"]).endswith("motion")))


@dataclass(frozen=True)
class _Life:
    """A simulated person: the measures of each day, the observations, and the day of the onset, counted from 0."""

    values: list[dict[str, float | None]]
    seen: Any
    onset: int | None


class DecideVisits(gymnasium.Env[Any, Any]):
    """Decides each morning to visit a person who may fall ill, or not.

    An action is 0 to wait, or 1 to visit. The observation has the measures of the last complete days, from the log alone. Each is in
    standard deviations from the mean of the first :attr:`FIRST` days, which are free of illness and visits; 0 means not known. A visit
    that finds the illness ends the episode. Its reward is 1 on the morning after the onset, and falls each day, to 0 after
    :attr:`LATE` days. A needless visit costs ``cost``. Otherwise an episode ends after its last day.

    The ground truth decides the result of a visit. It is not part of the observation; ``info`` contains it at the end. Three of four
    people fall ill, on different days. A visit does not change the simulation, so each person is simulated once and reused. ``seed``
    selects the people, and ``lives`` is their number; another seed gives other people.
    """

    metadata = {"render_modes": []}

    #: The observed measures of a day. Measures that need the whole log are left out: they would look into the future.
    MEASURES = tuple(_homebody.OBSERVED_MEASURES)
    #: Days before the first decision.
    FIRST = 14
    #: A visit this number of days after the onset, or later, is worth nothing.
    LATE = 21
    #: The share of people who fall ill.
    ILL = 0.75
    #: The largest observed distance from the mean, in standard deviations.
    MOST = 8.0

    def __init__(
        self,
        home: Scenario | str = "tigerplace",
        condition: str = "urinary tract infection",
        *,
        days: int = 49,
        last: int = 7,
        cost: float = 0.1,
        lives: int = 16,
        seed: int = 1,
    ) -> None:
        self._home = opened("home", home)
        self._resident = self._home.residents[0]
        self._condition = arguments.text("condition", condition, "the name of a condition")
        # The first days set the baseline; the others have decisions.
        self._days = arguments.whole("days", days, self.FIRST + 7, 36_500)
        self._last = arguments.whole("last", last, 1, self.FIRST)
        self._cost = arguments.number("cost", cost)
        self._lives = arguments.whole("lives", lives, 1, 1_000_000)
        self._seed = arguments.whole("seed", seed, 0, 2**64 - 1)
        # Reports an unknown condition now, before an episode.
        self._with_onset(self.FIRST)
        self.action_space = spaces.Discrete(2)
        shape = (self._last, len(self.MEASURES))
        self.observation_space = spaces.Box(-self.MOST, self.MOST, shape, dtype=numpy.float32)
        self._kept: dict[int, _Life] = {}
        self._life: _Life | None = None
        self._over = 0

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begins with one of the people, on the morning after the first days."""
        super().reset(seed=seed)
        number = int(self.np_random.integers(self._lives))
        if number not in self._kept:
            self._kept[number] = self._lived(number)
        self._life, self._over = self._kept[number], self.FIRST
        return self._observed(self._life), self._told(self._life)

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Visits, or waits."""
        life = self._life
        if life is None:
            raise RuntimeError("call reset to begin an episode")
        visits = arguments.whole("action", action, 0, 1, "0 to wait, or 1 to visit") == 1
        is_ill = life.onset is not None and life.onset < self._over
        found, reward = False, 0.0
        if visits and is_ill and life.onset is not None:
            found, reward = True, max(0.0, 1.0 - (self._over - 1 - life.onset) / self.LATE)
        elif visits:
            reward = -self._cost
        self._over = min(self._over + 1, self._days)
        is_last = self._over == self._days
        told = self._told(life)
        if found or is_last:
            told |= {"onset": life.onset, "found": found}
        return self._observed(life), reward, found, is_last and not found, told

    def _with_onset(self, day: int) -> Scenario:
        text = self._home.routine(self._resident)
        sentence = f"From day {day + 1}, over 3 days, {self._resident} shows {self._condition}."
        return self._home.with_routine(self._resident, f"{text.rstrip()}\n{sentence}\n")

    def _lived(self, number: int) -> _Life:
        chance = random.Random(f"{self._seed}/{number}")
        onset = chance.randrange(self.FIRST, self._days - 3) if chance.random() < self.ILL else None
        home = self._home if onset is None else self._with_onset(onset)
        run = home.run(days=self._days, seed=chance.randrange(2**63), one_of_many=True, progress=False)
        values: list[dict[str, float | None]] = [
            {name: day["values"].get(name) for name in self.MEASURES} for day in run.measures().data["days"]
        ]
        table = numpy.array([[numpy.nan if day[name] is None else day[name] for name in self.MEASURES] for day in values])
        return _Life(values, self._beside_usual(table), onset)

    def _beside_usual(self, table: Any) -> Any:
        """Standard deviations from the mean of the first days; 0 if these are all equal or unknown."""
        first = numpy.ma.masked_invalid(table[: self.FIRST])
        mean, deviation = first.mean(axis=0).filled(numpy.nan), first.std(axis=0).filled(0.0)
        away = (table - mean) / numpy.where(deviation > 0, deviation, numpy.nan)
        return numpy.clip(numpy.nan_to_num(away), -self.MOST, self.MOST).astype(numpy.float32)

    def _observed(self, life: _Life) -> Any:
        return life.seen[self._over - self._last : self._over].copy()

    def _told(self, life: _Life) -> dict[str, Any]:
        return {"day": self._over, "values": dict(life.values[self._over - 1])}
