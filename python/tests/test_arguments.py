"""Wrong arguments: the error names the argument and the expected value."""

from pathlib import Path
from typing import Any

import homebody as hb
import pytest

AT = (2.0, 2.0)


class Still:
    """Returns the same step every time."""

    answer: Any = None

    def __init__(self, seed: int) -> None:
        pass

    def next(self, around: hb.Surroundings) -> Any:
        return self.answer


class Silent:
    def __init__(self, seed: int) -> None:
        pass


@pytest.fixture(scope="module")
def home() -> hb.Scenario:
    return hb.scenario("studio")


@pytest.fixture(scope="module")
def run(home: hb.Scenario) -> hb.Run:
    return home.run(days=0.2, seed=7)


@pytest.mark.parametrize(
    ("code", "told"),
    [
        ("home.run(days='10')", "days is '10'; expected a number"),
        ("home.run(seed=True)", "seed is True; expected a whole number"),
        ("home.run(start=5)", "start is 5; expected now, today, a date"),
        ("home.run(without=[3])", r"without\[0\] is 3; expected a text"),
        ("home.run(numbers={'life.day_spread': 'much'})", r"numbers\['life.day_spread'\] is 'much'; expected a number"),
        ("home.run(drivers=[Still])", "drivers is .*; expected a mapping"),
        ("home.run(drivers={'walter': lambda: Still(1)})", r"a driver is .*; expected a class or a function that takes only the seed"),
        ("home.run(days=1, drivers={'walter': Silent})", r"a driver needs a method next\(around\)"),
        ("home.run(into=5)", "into is 5; expected a path"),
        ("home.run(one_of_many='no')", "one_of_many is 'no'; expected True or False"),
        ("home.run(progress='yes')", "progress is 'yes'; expected True or False"),
        ("hb.cohort('studio', 1, 'never', progress='yes')", "progress is 'yes'; expected True or False"),
        ("hb.scenario({5: 'x'})", "a key of files is 5"),
        ("hb.scenario({'scenario.json': object()})", "the file 'scenario.json' is neither a text nor data for JSON"),
        ("home.with_routine('walter', 5)", "text is 5; expected a routine"),
        ("hb.read(run)", "place is .*; expected the folder of a run, or a file with a log"),
        ("hb.read(run.folder, time_zone=5)", "time_zone is 5"),
        ("hb.compare(run, 5)", "b is 5; expected a log"),
        ("hb.translate(run, 5)", "home is 5; expected a scenario"),
        ("run.day(1.5)", "day is 1.5"),
        ("run.truth(3)", "table is 3"),
        ("run.windows(None)", "span is None"),
        ("home.plan.plot().png('x')", "width is 'x'"),
        ("hb.cohort(5, 1, 'never')", "home is 5"),
        ("hb.cohort('studio', 2.5, 'never')", "profiles is 2.5; expected a number of people, a file, or rows"),
        ("hb.cohort('studio', [1], 'never')", r"profiles\[0\] is 1; expected a mapping"),
        ("hb.cohort('studio', 1, None)", "folder is None"),
        ("hb.cohort('studio', 1, 'never', without='flu')", "without is 'flu'; expected a list"),
        ("hb.cohort('studio', 1, 'never', form=5)", "form is 5; expected parquet"),
        ("hb.cohort('studio', 1, 'never', cluster=5)", "cluster is 5; expected local"),
        ("hb.draw({}, '3')", "count is '3'; expected a whole number"),
        ("hb.draw([1], 3)", r"people is \[1\]; expected a mapping"),
    ],
)
def test_a_wrong_type_says_which_argument(home: hb.Scenario, run: hb.Run, code: str, told: str) -> None:
    with pytest.raises(TypeError, match=told):
        eval(code, {"hb": hb, "home": home, "run": run, "Still": Still, "Silent": Silent})  # noqa: S307
    assert not Path("never").exists()


@pytest.mark.parametrize(
    ("answer", "told"),
    [
        (hb.Rest("long", at=AT), "Rest.seconds is 'long'"),  # type: ignore[arg-type]
        (hb.Rest(60, at=5), "Rest.at is 5; expected a point"),  # type: ignore[arg-type]
        (hb.Stride(("a", 2), 3), "Stride.to is 'a'"),  # type: ignore[arg-type]
        (hb.Stir(60, "far", at=AT), "Stir.amplitude_m is 'far'"),  # type: ignore[arg-type]
        (hb.Away("x"), "Away.seconds is 'x'"),  # type: ignore[arg-type]
        (hb.Use(3, True), "Use.thing is 3"),  # type: ignore[arg-type]
        (hb.Use("fridge", "off"), "Use.on is 'off'"),  # type: ignore[arg-type]
        (hb.Doing(5), "Doing.activity is 5"),  # type: ignore[arg-type]
    ],
)
def test_a_wrong_answer_of_a_driver_says_what_of_it(home: hb.Scenario, answer: object, told: str) -> None:
    driver = type("Wrong", (Still,), {"answer": answer})
    with pytest.raises(TypeError, match=told):
        home.run(days=0.1, seed=1, drivers={"walter": driver})


@pytest.mark.parametrize(
    ("code", "told"),
    [
        ("home.run(seed=-1)", "seed is -1; expected a number from 0 to"),
        ("home.run(days=-1)", "days is -1.0; expected more than 0"),
        ("home.run(days=0)", "days is 0.0; expected more than 0"),
        ("home.run(days=float('nan'))", "days is nan; expected more than 0"),
        ("home.run(numbers={'life.day_spread': float('nan')})", r"numbers\['life.day_spread'\] is nan; expected a finite number"),
        ("home.run(days=1e9)", "days is 1000000000.0; .* at most 36,525"),
        ("home.remarks(float('inf'))", "days is inf"),
        ("home.run(days=1, start='yesterday')", 'start is "yesterday": '),
        ("home.live(days=1, start='2009-02-30')", 'start is "2009-02-30": '),
        ("hb.cohort('studio', 1, 'never', days=-1)", "days is -1.0"),
        ("hb.cohort('studio', 1, 'never', workers=3)", "workers is 3: only a local cluster"),
        ("hb.cohort('studio', 1, 'never', cluster='tcp://127.0.0.1:1', workers=3)", "workers is 3: only a local cluster"),
        ("run.windows(-1)", "span is -1; expected more than 0"),
        ("run.windows(1e-9)", "span is 1e-09; expected at least a microsecond"),
        ("run.windows('0.00001s')", "span is 0.00001 s: the log has"),
        ("run.windows('1.2.3s')", "span is '1.2.3s'"),
        ("hb.read(run.folder, time_zone='Mars')", 'time_zone is "Mars": no time zone has this name'),
        ("hb.cohort('studio', 1, 'never', truth='some')", "truth is 'some'; expected all or brief"),
        ("hb.scenario('')", "what is empty"),
        ("home.plan.plot().png(0)", "width is 0"),
        ("hb.cohort('studio', 0, 'never')", "profiles is 0; expected a number from 1 to 100,000"),
        ("hb.cohort('studio', 1, 'never', cluster='local', workers=0)", "workers is 0"),
        ("hb.draw({}, -3)", "count is -3"),
        ("home.change({'../other.json': '{}'})", "leads out of the scenario's folder"),
        ("hb.scenario({'/other.json': '{}'})", "leads out of the scenario's folder"),
    ],
)
def test_a_wrong_value_says_which_argument(home: hb.Scenario, run: hb.Run, code: str, told: str) -> None:
    with pytest.raises(ValueError, match=told):
        eval(code, {"hb": hb, "home": home, "run": run})  # noqa: S307
    assert not Path("never").exists()


@pytest.mark.parametrize("seconds", [float("nan"), 0, -1, 1e-9, float("-inf")])
def test_how_long_a_driver_does_something_is_longer_than_nothing(home: hb.Scenario, seconds: float) -> None:
    for answer in (hb.Rest(seconds, at=AT), hb.Stride(AT, seconds), hb.Stir(seconds, at=AT), hb.Away(seconds)):
        driver = type("Wrong", (Still,), {"answer": answer})
        told = f"{type(answer).__name__}.seconds is {float(seconds)}; expected a number of seconds above 0"
        with pytest.raises(ValueError, match=told):
            home.run(days=0.1, seed=1, drivers={"walter": driver})


def test_what_is_saved_replaces_nothing(home: hb.Scenario, run: hb.Run, tmp_path: Path) -> None:
    for what in (home, run):
        (tmp_path / "mine").write_text("mine")
        with pytest.raises(hb.Exists, match="mine: the folder exists already\n  hint: name a new folder"):
            what.save(tmp_path / "mine")
        assert (tmp_path / "mine").read_text() == "mine"
        with pytest.raises(hb.LogError, match="beneath"):
            what.save(tmp_path / "mine" / "beneath")
        with pytest.raises(TypeError, match="folder is 5"):
            what.save(5)  # type: ignore[arg-type]
    assert len(hb.read(run.save(tmp_path / "copy")).events) == len(run.events)


def test_what_is_no_scenario_is_one_kind_of_error(home: hb.Scenario) -> None:
    for place in ("tigerplce", "no/such", Path("nowhere")):
        with pytest.raises(hb.ScenarioError, match="hint"):
            hb.scenario(place)
    with pytest.raises(hb.ScenarioError, match="walter.routine is not valid JSON"):
        home.data("walter.routine")


def test_all_that_is_wrong_with_a_distribution_is_told() -> None:
    people = {
        "age": {"normal": [82, -6], "least": 90, "most": 60, "digits": -1.5},
        "pace_mps": {"normal": [1, 1], "uniform": [2, 1], "least": "x"},
        "severity": {"mild": float("nan")},
    }
    with pytest.raises(hb.ScenarioError) as told:
        hb.draw(people, 3)
    said = "\n".join(problem.what for problem in told.value.problems)
    for what in ("deviation is -6", "least is 90, and most is 60", "digits is -1.5", "at once", "least is 'x'", "weight of mild"):
        assert what in said


def test_numbers_of_other_packages_are_numbers(home: hb.Scenario) -> None:
    numpy = pytest.importorskip("numpy")
    one = home.run(days=numpy.float32(0.1), seed=numpy.int64(3))
    assert one.summary["sha256"] == home.run(days=float(numpy.float32(0.1)), seed=3).summary["sha256"]
