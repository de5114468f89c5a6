"""The environments for learning, as Gymnasium checks them."""

import random
from collections.abc import Callable
from typing import Any

import homebody as hb
import numpy
import pytest
from gymnasium.utils.env_checker import check_env
from homebody.env import DecideVisits, PlaceSensors

BATHROOM = [DecideVisits.MEASURES.index(name) for name in ("bathroom_night", "bathroom_day")]


def test_they_pass_the_check_of_gymnasium() -> None:
    check_env(PlaceSensors("studio", sensors=3), skip_render_check=True)
    check_env(DecideVisits("studio", days=21, lives=1), skip_render_check=True)


def test_the_reward_is_what_more_is_seen() -> None:
    env = PlaceSensors("studio", sensors=3)
    env.reset(seed=1)
    rewards = [env.step(action)[1] for action in (0, 0, 4)]
    assert rewards[0] > 0 and rewards[1] == 0 and rewards[2] > 0, "a place is taken once"
    assert sum(rewards) == pytest.approx(1 - env.scenario().coverage().data["whole"]["seen_by"]["none"])
    with pytest.raises(ValueError, match="sensors"):
        PlaceSensors("studio", sensors=0)


@pytest.fixture(scope="module")
def visits() -> DecideVisits:
    return DecideVisits(days=30, lives=6)


def episode(env: DecideVisits, policy: Callable[[Any], int], seed: int) -> tuple[list[Any], list[float], dict[str, Any]]:
    """What is observed, what comes of it by day, and what is told at the end."""
    observed, told = env.reset(seed=seed)
    seen, rewards, is_over = [observed], [], False
    while not is_over:
        assert "onset" not in told and "found" not in told, "the truth is for who has decided"
        observed, reward, found, cut, told = env.step(policy(observed))
        seen.append(observed)
        rewards.append(reward)
        is_over = found or cut
    return seen, rewards, told


def test_who_looks_at_the_measures_does_better_than_chance(visits: DecideVisits) -> None:
    chance = random.Random(1)
    policies: dict[str, Callable[[Any], int]] = {
        "chance": lambda observed: chance.randrange(2),
        "threshold": lambda observed: int(observed[-3:, BATHROOM].mean() > 1),
        "never": lambda observed: 0,
    }
    mean = {name: numpy.mean([sum(episode(visits, policy, n)[1]) for n in range(24)]) for name, policy in policies.items()}
    assert mean["never"] == 0
    assert mean["threshold"] > mean["chance"] + 0.2 and mean["threshold"] > 0


def test_an_episode_is_that_of_its_seed(visits: DecideVisits) -> None:
    def lived(env: DecideVisits, seed: int) -> tuple[Any, list[float], dict[str, Any]]:
        seen, rewards, told = episode(env, lambda observed: 0, seed)
        return numpy.array(seen), rewards, told

    one, again = lived(visits, 3), lived(DecideVisits(days=30, lives=6), 3)
    assert (one[0] == again[0]).all() and one[1:] == again[1:]
    assert any(not (one[0] == lived(visits, other)[0]).all() for other in range(4, 8))
    others = lived(DecideVisits(days=30, lives=6, seed=2), 3)
    assert not (one[0] == others[0]).all(), "these are other people"


def test_an_early_visit_is_worth_more_and_a_needless_one_costs(visits: DecideVisits) -> None:
    ill = next(seed for seed in range(100) if episode(visits, lambda observed: 0, seed)[2]["onset"] is not None)
    onset = episode(visits, lambda observed: 0, ill)[2]["onset"]

    def on_days(*days: int) -> list[float]:
        mornings = iter(range(DecideVisits.FIRST, 30))
        return episode(visits, lambda observed: int(next(mornings) in days), ill)[1]

    assert on_days(onset)[-1] == 0 and sum(on_days(onset)) == pytest.approx(-0.1), "nobody is ill yet"
    assert sum(on_days(onset + 1)) == 1 > sum(on_days(onset + 3)) > 0
    assert sum(on_days(onset, onset + 1)) == pytest.approx(0.9)


def test_onsets_are_those_of_the_truth_and_no_day_knows_later_ones(visits: DecideVisits) -> None:
    home, day = visits._with_onset(20), 20
    run = home.run(days=24, seed=5)
    at = run.truth("condition").to_pandas()["at"].iloc[0]
    dates = [day["date"] for day in run.measures().data["days"]]
    assert dates[day] == str(at.date()), "counted from 0"
    short = home.run(days=18, seed=5).measures().data["days"]
    for before, after in zip(short[:-1], run.measures().data["days"]):
        for name in DecideVisits.MEASURES:
            assert before["values"].get(name) == pytest.approx(after["values"].get(name)), (before["date"], name)


def test_what_is_wrong_is_told_before_an_episode() -> None:
    wrong: list[tuple[dict[str, Any], str]] = [({"days": 20}, "days"), ({"last": 0}, "last"), ({"lives": 0}, "lives")]
    for keys, argument in wrong:
        with pytest.raises(ValueError, match=argument):
            DecideVisits(**keys)
    with pytest.raises(hb.ScenarioError, match="depression"):
        DecideVisits(condition="depresion")
    with pytest.raises(RuntimeError, match="reset"):
        DecideVisits("studio").step(0)


def test_an_action_that_is_none_is_told(visits: DecideVisits) -> None:
    place = PlaceSensors("studio")
    place.reset(seed=1)
    visits.reset(seed=1)
    for env, action in ((place, 10**6), (place, -1), (visits, 7)):
        with pytest.raises(ValueError, match=f"action is {action}; expected a number from 0 to"):
            env.step(action)
    with pytest.raises(TypeError, match="action is 0.5"):
        visits.step(0.5)
