"""Environments for learning, as Gymnasium has them: ``pip install homebody[gym]``.

>>> from homebody.env import PlaceSensors
>>> env = PlaceSensors("studio", sensors=2)
>>> observed, told = env.reset(seed=1)
>>> observed, reward, over, cut, told = env.step(int(env.action_space.sample()))
>>> over, cut
(False, False)
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Any

from homebody import arguments
from homebody.errors import needs
from homebody.picture import Picture
from homebody.scenario import Scenario, opened

needs("numpy", "homebody.env", "gym")
needs("gymnasium", "homebody.env", "gym")

import gymnasium  # noqa: E402
import numpy  # noqa: E402
from gymnasium import spaces  # noqa: E402


class PlaceSensors(gymnasium.Env[Any, Any]):
    """Places ceiling sensors in a home, one at a step, so that as much of the floor as possible is seen.

    An action is one of the places that sensors may have: points of a grid in rooms. What is observed is by place whether a sensor is
    there. The reward is by how much the share of the floor that is seen has grown, from 0 to 1. An episode is over when all sensors are
    placed. Sensors of the home that look for movement are taken away first; nothing is left to chance but the actions.
    """

    metadata = {"render_modes": []}

    def __init__(self, home: Scenario | str = "tigerplace", sensors: int = 4, step_m: float = 1.0) -> None:
        sensors, step_m = arguments.whole("sensors", sensors, 1, 1000), arguments.number("step_m", step_m)
        if not step_m > 0:
            raise ValueError(f"step_m is {step_m}: it is a length in metres")
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
        place = arguments.whole("action", action, 0, len(self.places) - 1, "one of the places: a whole number")
        before = self._seen()
        self._placed.append(place)
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


@dataclass(frozen=True)
class _Life:
    """What is kept of a life: by day the measures, as they are and as they are observed; and the day of the onset, counted from 0."""

    values: list[dict[str, float | None]]
    seen: Any
    onset: int | None


class DecideVisits(gymnasium.Env[Any, Any]):
    """Decides each morning whether to visit somebody who may fall ill.

    An action is 0, to let the day go by, or 1, to visit. What is observed are the measures of the last days that are over, by the log
    alone: each as so many standard deviations from the mean of the first :attr:`FIRST` days, on which nobody is ill or visited; 0 where it
    is not known. A visit that finds the illness ends the episode, with a reward of 1 on the morning after the onset and less with each
    day after it, down to 0 after :attr:`LATE` days. A needless visit costs ``cost``. An episode ends otherwise when its days are over.

    The truth decides which visit is which, and is nowhere in what is observed; it is in what is told at the end. Somebody falls ill
    in three lives of four, from a day on that differs from life to life. A visit changes nothing of what is lived: so lives are
    lived once and kept. ``seed`` says which they are, ``lives`` how many there are to draw from; another seed has other people.
    """

    metadata = {"render_modes": []}

    #: What is observed of a day. What is judged by the whole log, such as the pace, would know of days to come.
    MEASURES = (
        "time_in_bed",
        "bedtime",
        "rising",
        "restlessness",
        "bathroom_night",
        "bathroom_day",
        "meals",
        "time_out",
        "outings",
        "room_changes",
        "density_night",
        "density_morning",
        "density_afternoon",
        "density_evening",
    )
    #: Days before the first decision.
    FIRST = 14
    #: So many days after the onset a visit is too late to be worth anything.
    LATE = 21
    #: How often somebody falls ill.
    ILL = 0.75
    #: Further from what is usual is not told apart, in standard deviations.
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
        # The first days say what is usual; some more are decided on.
        self._days = arguments.whole("days", days, self.FIRST + 7, 36_500)
        self._last = arguments.whole("last", last, 1, self.FIRST)
        self._cost = arguments.number("cost", cost)
        self._lives = arguments.whole("lives", lives, 1, 1_000_000)
        self._seed = arguments.whole("seed", seed, 0, 2**64 - 1)
        # What is wrong with the condition is told here, and not by an episode.
        self._with_onset(self.FIRST)
        self.action_space = spaces.Discrete(2)
        shape = (self._last, len(self.MEASURES))
        self.observation_space = spaces.Box(-self.MOST, self.MOST, shape, dtype=numpy.float32)
        self._kept: dict[int, _Life] = {}
        self._life: _Life | None = None
        self._over = 0

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begins with one of the lives, on the morning after the first days."""
        super().reset(seed=seed)
        number = int(self.np_random.integers(self._lives))
        if number not in self._kept:
            self._kept[number] = self._lived(number)
        self._life, self._over = self._kept[number], self.FIRST
        return self._observed(self._life), self._told(self._life)

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Visits, or lets the day go by."""
        life = self._life
        if life is None:
            raise RuntimeError("reset begins an episode")
        visits = arguments.whole("action", action, 0, 1, "0, to let the day go by, or 1, to visit") == 1
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
        """Standard deviations from the mean of the first days; where all of these are alike or none is known, there are none."""
        first = numpy.ma.masked_invalid(table[: self.FIRST])
        mean, deviation = first.mean(axis=0).filled(numpy.nan), first.std(axis=0).filled(0.0)
        away = (table - mean) / numpy.where(deviation > 0, deviation, numpy.nan)
        return numpy.clip(numpy.nan_to_num(away), -self.MOST, self.MOST).astype(numpy.float32)

    def _observed(self, life: _Life) -> Any:
        return life.seen[self._over - self._last : self._over].copy()

    def _told(self, life: _Life) -> dict[str, Any]:
        return {"day": self._over, "values": dict(life.values[self._over - 1])}
