"""Drivers in Python."""

import json
import random
import subprocess
import sys

import homebody as hb
import pytest

ENDS = [(5.0, 3.6), (8.4, 3.6)]


class Pacing:
    """Paces up and down, and rests as chance has it."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.at = 0

    def next(self, around: hb.Surroundings) -> object:
        if around.body is None:
            return hb.Rest(10, at=ENDS[0])
        if self.random.random() < 0.5:
            return hb.Rest(60)
        self.at = 1 - self.at
        return hb.Stride(ENDS[self.at], 5)


def lived(make: object, seed: int = 7, days: float = 0.2) -> hb.Run:
    return hb.scenario("tigerplace").run(days=days, seed=seed, drivers={"margaret": make})  # type: ignore[dict-item]


def test_a_driver_is_as_reproducible_as_its_own_randomness() -> None:
    one, again, other = lived(Pacing), lived(Pacing), lived(Pacing, seed=8)
    assert one.summary["sha256"] == again.summary["sha256"] != other.summary["sha256"]
    assert one.summary["rows"] > 10


def test_a_run_with_a_driver_has_the_tables_of_any_run() -> None:
    run, other = lived(Pacing), hb.scenario("tigerplace").run(days=0.2, seed=7)
    assert run.time_zone == "America/Chicago" and set(run.sensors) <= set(run.scenario.sensors)
    for name in ("events", "activities", "movement", "rooms"):
        one, another = getattr(run, name), getattr(other, name)
        assert (one.columns, one.types) == (another.columns, another.types), name
    assert run.windows("1h").columns[:7] == other.windows("1h").columns[:7] and run.labelled().types == other.labelled().types
    assert hb.read(run.folder).time_zone == "America/Chicago"
    recording = run.folder / "recording.json"
    assert json.loads(recording.read_text())["own_drivers"] == ["margaret"]
    assert refused("replay", str(recording))


def refused(*words: str) -> bool:
    """Whether the command says that it cannot live a run again, as somebody was moved by a driver."""
    told = subprocess.run([sys.executable, "-m", "homebody", *words], capture_output=True, text=True)
    return told.returncode == 2 and "margaret was moved by a driver of another program" in told.stderr


def test_a_driver_sees_and_says_what_is_so() -> None:
    seen: list[hb.Surroundings] = []

    class Opening:
        def __init__(self, seed: int) -> None:
            self.steps: list[object] = []

        def next(self, around: hb.Surroundings) -> object:
            seen.append(around)
            match len(seen):
                case 1:
                    return hb.Rest(60, at=ENDS[0])
                case 2:
                    return hb.Doing("pottering")
                case 3:
                    return hb.Use("fridge", True)
                case 4:
                    return hb.Use("fridge", False)
                case 5:
                    return hb.Stride(ENDS[1], 5)
            return hb.Rest(float("inf"))

    run = lived(Opening)
    assert seen[1].now == 60 and seen[1].body is not None and seen[1].body.at == ENDS[0]
    assert "fridge" in seen[3].on and "fridge" not in seen[4].on
    assert "pottering" in set(run.activities.to_pandas()["activity"])


def test_a_driver_that_raises_ends_the_run_with_its_traceback(tmp_path: object) -> None:
    class Wrong(Pacing):
        def next(self, around: hb.Surroundings) -> object:
            if around.now > 3600:
                raise RuntimeError("I cannot go on")
            return super().next(around)

    with pytest.raises(RuntimeError, match="I cannot go on") as told:
        hb.scenario("tigerplace").run(days=1, seed=7, into=tmp_path, drivers={"margaret": Wrong})  # type: ignore
    assert any(entry.name == "next" and "test_drivers" in str(entry.path) for entry in told.traceback)
    (folder,) = tmp_path.iterdir()  # type: ignore[attr-defined]
    assert len(hb.read(folder).events) > 0, "what happened before is stored"
    assert hb.read(folder).time_zone == "America/Chicago" and refused("run", "--resume", str(folder))


def test_what_no_body_can_do_and_no_answer_is_are_told() -> None:
    class Through:
        def __init__(self, seed: int) -> None:
            pass

        def next(self, around: hb.Surroundings) -> object:
            return hb.Rest(60, at=(5.0, 3.6)) if around.body is None else hb.Rest(60, at=(500.0, 3.6))

    class Silent(Through):
        def next(self, around: hb.Surroundings) -> object:
            return None

    with pytest.raises(hb.DriverError):
        lived(Through)
    with pytest.raises(TypeError, match="Silent.next"):
        lived(Silent)
    with pytest.raises(TypeError, match="driver"):
        lived(7)
    with pytest.raises(hb.ScenarioError, match="no resident is called"):
        hb.scenario("tigerplace").run(days=1, drivers={"nobody": Pacing})  # type: ignore[dict-item]
