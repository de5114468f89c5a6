"""The environment for learning, as Gymnasium checks it."""

import pytest
from gymnasium.utils.env_checker import check_env
from homebody.env import PlaceSensors


def test_it_passes_the_check_of_gymnasium() -> None:
    check_env(PlaceSensors("studio", sensors=3), skip_render_check=True)


def test_the_reward_is_what_more_is_seen() -> None:
    env = PlaceSensors("studio", sensors=3)
    env.reset(seed=1)
    rewards = [env.step(action)[1] for action in (0, 0, 4)]
    assert rewards[0] > 0 and rewards[1] == 0 and rewards[2] > 0, "a place is taken once"
    assert sum(rewards) == pytest.approx(1 - env.scenario().coverage().data["whole"]["seen_by"]["none"])
    with pytest.raises(ValueError, match="sensors"):
        PlaceSensors("studio", sensors=0)
