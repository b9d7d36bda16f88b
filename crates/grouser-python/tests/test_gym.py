"""The environment keeps Gymnasium's promises, and its vector form keeps those of single ones."""

from __future__ import annotations

import importlib.util
import re
import subprocess
import sys
import textwrap
import warnings
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode, SyncVectorEnv

import grouser as gr
import grouser.gym

LEVEL = "grouser/LevelTraverse-v0"


def make_single(limit: int, slope_deg: tuple[float, float]) -> gymnasium.Env[Any, Any]:
    return gymnasium.make(LEVEL, max_episode_steps=limit, slope_deg=slope_deg)


def test_the_checker_has_nothing_to_say() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(gymnasium.make(LEVEL).unwrapped)


def alike(one: Any, other: Any, what: str) -> None:
    assert type(one) is type(other), what
    if isinstance(one, dict):
        assert one.keys() == other.keys(), what
        for key in one:
            alike(one[key], other[key], f"{what}.{key}")
    elif isinstance(one, tuple):
        for left, right in zip(one, other):
            alike(left, right, what)
    elif isinstance(one, np.ndarray):
        assert one.dtype == other.dtype and one.shape == other.shape, what
        if one.dtype == object:
            for left, right in zip(one, other):
                alike(left, right, what)
        else:
            assert one.tobytes() == other.tobytes(), what
    else:
        assert one == other, what


@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
def test_the_vector_form_has_the_bits_of_single_ones(mode: AutoresetMode) -> None:
    """Beside Gymnasium's own vector of single environments, over ends of episodes of both kinds."""
    slopes, count, limit = (10.0, 38.0), 6, 7
    singles = SyncVectorEnv([lambda: make_single(limit, slopes)] * count, autoreset_mode=mode)
    together = gymnasium.make_vec(
        LEVEL, num_envs=count, max_episode_steps=limit, slope_deg=slopes, autoreset_mode=mode
    )
    assert together.metadata["autoreset_mode"] is mode
    for space in ("observation_space", "action_space", "single_observation_space"):
        assert getattr(together, space) == getattr(singles, space)
    alike(together.reset(seed=11), singles.reset(seed=11), "reset")
    random, ends = np.random.default_rng(3), {"terminated": 0, "truncated": 0}
    for k in range(20):
        actions = random.uniform(-1.0, 1.0, (count, 2))
        one, other = together.step(actions), singles.step(actions)
        for name, left, right in zip(
            ("observations", "rewards", "terminated", "truncated", "infos"), one, other
        ):
            alike(left, right, f"step {k}: {name}")
        ends["terminated"] += int(one[2].sum())
        ends["truncated"] += int(one[3].sum())
    assert min(ends.values()) > 0, f"an end that was not tried: {ends}"


def test_without_autoreset_a_mask_resets() -> None:
    envs: Any = gymnasium.make_vec(
        LEVEL, num_envs=3, max_episode_steps=2, autoreset_mode=AutoresetMode.DISABLED
    )
    with pytest.raises(gymnasium.error.ResetNeeded):
        envs.step(np.zeros((3, 2)))
    envs.reset(seed=1)
    for _ in range(2):
        truncated = envs.step(np.tile([0.6, 0.0], (3, 1)))[3]
    assert truncated.all()
    with pytest.raises(gymnasium.error.ResetNeeded):
        envs.step(np.zeros((3, 2)))
    before = envs.reset(seed=[5, None, 7], options={"reset_mask": np.array([True, False, True])})[0]
    assert before[0].tobytes() == gymnasium.make(LEVEL).reset(seed=5)[0].tobytes()
    with pytest.raises(gymnasium.error.ResetNeeded):
        envs.step(np.zeros((3, 2)))


def test_an_episode_is_decided_by_its_seed() -> None:
    env = gymnasium.make(LEVEL)
    slopes = set()
    for seed in (1, 2, 1):
        observation, info = env.reset(seed=seed)
        assert 5.0 <= info["slope_deg"] <= 15.0 and abs(observation[1]) <= 10.0
        slopes.add((info["slope_deg"], observation[1]))
    assert len(slopes) == 2


def test_rewards_are_what_is_written() -> None:
    """Way over the longest way, less the square of the offset in tenths of a metre."""
    env = gymnasium.make(LEVEL)
    _, info = env.reset(seed=4)
    before = info["x_m"]
    for _ in range(5):
        observation, reward, terminated, _, info = env.step(np.array([0.6, 0.1]))
        expected = (info["x_m"] - before) / (0.1 * 0.5) - (observation[0] / 0.1) ** 2
        assert not terminated and reward == pytest.approx(expected, rel=1e-12)
        before = info["x_m"]


def test_a_turn_to_the_left_turns_to_the_left() -> None:
    env = gymnasium.make(LEVEL, soil="toyoura", slope_deg=(0.0, 0.0))
    for turn in (0.4, -0.4):
        start = env.reset(seed=1)[0]
        for _ in range(6):
            observation = env.step(np.array([0.5, turn]))[0]
        assert np.sign(observation[1] - start[1]) == np.sign(turn)
        left, right = observation[[5, 6]], observation[[7, 8]]
        assert (np.sign(right - left) == np.sign(turn)).all()


def test_losing_the_line_ends_an_episode_at_a_price() -> None:
    env = gymnasium.make(LEVEL, soil="toyoura", slope_deg=(5.0, 5.0))
    env.reset(seed=1)
    for _ in range(120):
        observation, reward, terminated, truncated, info = env.step(np.array([1.0, -0.2]))
        if terminated:
            break
    assert terminated and abs(observation[0]) > 0.5 and float(reward) < -50.0
    assert info["outcome"] is None


def test_what_cannot_be_asked_says_what_can() -> None:
    wrong: list[dict[str, Any]] = [
        {"slope_deg": (10.0, 5.0)},
        {"slope_deg": (0.0, 70.0)},
        {"max_speed_m_s": 0.0},
        {"soil": {"cohesion_kpa": 1.0}},
    ]
    for settings in wrong:
        with pytest.raises(gr.GrouserError):
            gymnasium.make(LEVEL, **settings)
    env = gymnasium.make(LEVEL).unwrapped
    env.reset(seed=1)
    for action in ([np.nan, 0.0], [0.1], "go"):
        with pytest.raises(gr.ParameterError):
            env.step(action)


@pytest.mark.parametrize(
    "scenario",
    [{"soil": "dry-sand", "slope_deg": 7.0}, gr.Scenario(soil="dry-sand", slope_deg=7.0)],
)
def test_soil_and_slope_of_a_scenario_count(scenario: Any) -> None:
    """As if they had been given as arguments."""
    env = gymnasium.make(LEVEL, scenario=scenario).unwrapped
    asked = gymnasium.make(LEVEL, soil="dry-sand", slope_deg=(7.0, 7.0)).unwrapped
    usual = gymnasium.make(LEVEL, slope_deg=(7.0, 7.0)).unwrapped
    action = np.array([0.6, 0.1])
    for one in (env, asked, usual):
        assert one.reset(seed=3)[1]["slope_deg"] == 7.0
    seen = [one.step(action)[0].tobytes() for one in (env, asked, usual)]
    assert seen[0] == seen[1] != seen[2]


def test_what_a_scenario_leaves_open_is_as_usual() -> None:
    """A mapping gives single keys; beside a whole scenario arguments give another soil or slope."""
    one = gymnasium.make(LEVEL, scenario={"gravity_m_s2": gr.EARTH_GRAVITY})
    assert one.reset(seed=5)[0].tobytes() == gymnasium.make(LEVEL).reset(seed=5)[0].tobytes()
    run = gr.Scenario(soil="dry-sand")
    two = gymnasium.make(LEVEL, scenario=run, soil="toyoura-uncertain", slope_deg=(5.0, 15.0))
    assert two.reset(seed=5)[0].tobytes() == one.reset(seed=5)[0].tobytes()


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (
            {"scenario": {"soil": "dry-sand"}, "soil": "toyoura"},
            "soil is given twice: 'toyoura' as an argument, 'dry-sand' by the scenario",
        ),
        (
            {"scenario": {"slope_deg": 8.0}, "slope_deg": (5.0, 6.0)},
            r"slope_deg is given twice: \(5.0, 6.0\) as an argument, 8.0 by",
        ),
        ({"scenario": {"drive": {"law": "eq18"}}}, "has drive, which is not used"),
        ({"scenario": {"duration_s": 5.0}}, "has duration_s, which is not used"),
        ({"scenario": {"start": {"yaw_deg": 5.0}}}, "has start.yaw_deg, which is not used"),
    ],
)
def test_what_a_scenario_contradicts_is_refused(settings: dict[str, Any], message: str) -> None:
    for make in (gymnasium.make, gymnasium.make_vec):
        with pytest.raises(gr.ParameterError, match=message):
            make(LEVEL, **settings)


def test_options_of_a_reset_take_the_place_of_draws() -> None:
    env = gymnasium.make(LEVEL)
    sampled, sampled_info = env.reset(seed=9)
    found, info = env.reset(seed=9, options={"yaw_deg": 4.0})
    assert found[1] == pytest.approx(4.0, abs=1e-12) != sampled[1]
    assert info["slope_deg"] == sampled_info["slope_deg"]
    found, info = env.reset(seed=9, options={"slope_deg": 12.5})
    assert info["slope_deg"] == 12.5 and found[1] == sampled[1]
    # Wheels start with the slip that their soil gives them.
    action, seen = np.array([0.6, 0.0]), {}
    for seed, soil_seed in ((1, 7), (2, 7), (1, 8), (1, None)):
        where = {"slope_deg": 10.0, "yaw_deg": 0.0, "soil_seed": soil_seed}
        env.reset(seed=seed, options=where)
        seen[seed, soil_seed] = env.step(action)[0].tobytes()
    assert seen[1, 7] == seen[2, 7] and len(set(seen.values())) == 3
    nominal = gymnasium.make(LEVEL, soil="toyoura", slope_deg=(10.0, 10.0))
    nominal.reset(seed=1, options={"yaw_deg": 0.0})
    assert nominal.step(action)[0].tobytes() == seen[1, None]


def test_options_of_many_are_one_value_or_one_each() -> None:
    envs = gymnasium.make_vec(LEVEL, num_envs=2)
    for yaw in (3.0, [3.0, -3.0]):
        found = envs.reset(seed=1, options={"yaw_deg": yaw, "soil_seed": [1, None]})[0]
        np.testing.assert_allclose(found[:, 1], yaw, atol=1e-12)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"slop_deg": 5.0}, "no option 'slop_deg'; it has slope_deg, yaw_deg, soil_seed"),
        ({"slope_deg": 70.0}, "slope_deg is 70.*, it must be from 0 to 60"),
        ({"yaw_deg": [1.0, 2.0, 3.0]}, "option yaw_deg must be one value"),
        ({"soil_seed": 1.5}, "soil_seed is of type float"),
    ],
)
def test_unknown_options_are_refused(options: dict[str, Any], message: str) -> None:
    single, several = gymnasium.make(LEVEL), gymnasium.make_vec(LEVEL, num_envs=2)
    for env in (single, several):
        with pytest.raises(gr.ParameterError, match=message):
            env.reset(seed=1, options=options)


def test_a_fallback_to_dynamic_is_reported() -> None:
    """Sharp turns have no steady state; the level line does, and a dynamic run has no need of one."""
    steady: Any = gymnasium.make(LEVEL, scenario={"simulation": "quasi-steady"})
    dynamic: Any = gymnasium.make(LEVEL)
    for env, action, falls in (
        (steady, [0.0, 1.0], True),
        (steady, [0.6, 0.0], False),
        (dynamic, [0.0, 1.0], False),
    ):
        _, info = env.reset(seed=1)
        assert info["fallback_to_dynamic"] is False
        for _ in range(10):
            info = env.step(np.array(action))[4]
        assert info["fallback_to_dynamic"] is falls
        # A new episode begins as it was asked to.
        assert env.reset(seed=1)[1]["fallback_to_dynamic"] is False


def test_a_missing_gymnasium_is_told_with_what_to_install() -> None:
    script = """
        import sys
        sys.modules["gymnasium"] = None
        import grouser
        try:
            import grouser.gym
        except ImportError as error:
            print(error)
    """
    command = [sys.executable, "-c", textwrap.dedent(script)]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert "pip install gymnasium" in printed
    script = "import sys, grouser; print('gymnasium' in sys.modules)"
    printed = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True).stdout
    assert printed.strip() == "False"


def example() -> Any:
    path = Path(__file__).resolve().parents[1] / "examples" / "level_line.py"
    spec = importlib.util.spec_from_file_location("level_line", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_baseline_holds_the_line_better_than_driving_straight_on() -> None:
    """On slopes and soils that neither knows. Quasi-steady runs, the quicker ones."""
    lines = example()
    steady = {"scenario": {"simulation": "quasi-steady"}}
    straight, straight_lost = lines.rms_offsets(lines.straight_on, 24, seed=100, **steady)
    level, level_lost = lines.rms_offsets(lines.LevelLine(), 24, seed=100, **steady)
    assert (level < straight).mean() > 0.8
    assert np.median(level) < 0.5 * np.median(straight)
    assert level_lost.sum() < straight_lost.sum()


# ---- your own environment ----


class Climb(grouser.gym.RoverEnv):
    """Uphill is rewarded; four metres are enough."""

    def reward(self, before: Any, ended: bool) -> float:
        return self.state["y_m"] - before["y_m"] - 10.0 * ended

    def is_ended(self) -> bool:
        return self.state["y_m"] > 0.05


class Rims(Climb):
    """Observes the slip of its wheels, and commands each rim."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        self.observation_space = gymnasium.spaces.Box(-1.0, 1.0, (4,), dtype=np.float64)
        self.action_space = gymnasium.spaces.Box(0.0, 0.1, (4,), dtype=np.float64)

    def observation(self) -> Any:
        return np.clip(np.nan_to_num(self.wheel["slip_ratio"]), -1.0, 1.0)

    def rim_speeds(self, action: Any) -> Any:
        return action


def test_a_subclass_says_what_is_rewarded_and_what_ends() -> None:
    env = Climb(slope_deg=(5.0, 6.0))
    env.reset(seed=2, options={"yaw_deg": 60.0})
    rewards, climbed, terminated = [], [env.state["y_m"]], False
    while not terminated and len(rewards) < 10:
        observation, reward, terminated, truncated, info = env.step(np.array([0.6, 0.0]))
        rewards.append(reward)
        climbed.append(env.state["y_m"])
        assert observation in env.observation_space and not truncated
    assert terminated and env.outcome is None and climbed[-1] > 0.05
    steps = np.diff(climbed)
    assert rewards == [*steps[:-1].tolist(), float(steps[-1]) - 10.0]
    assert info["energy_j"] == env.energy_j > 0.0 and 5.0 <= env.slope_deg <= 6.0


def test_a_subclass_has_its_own_spaces() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(Rims(), skip_render_check=True)
    env = Rims()
    env.reset(seed=1)
    left = np.array(env._rovers.side) < 0.0
    env.step(np.where(left, 0.02, 0.08))
    assert env.wheel["wheel_speed_rad_s"][left].max() < env.wheel["wheel_speed_rad_s"][~left].min()
    with pytest.raises(NotImplementedError, match="def reward"):
        plain = grouser.gym.RoverEnv()
        plain.reset(seed=1)
        plain.step(np.array([0.5, 0.0]))


def test_the_level_environment_is_what_its_hooks_say() -> None:
    env = grouser.gym.LevelTraverseEnv()
    env.reset(seed=3)
    before = env.state
    reward, ended = env.step(np.array([0.6, 0.1]))[1:3]
    assert ended == env.is_ended() and reward == pytest.approx(env.reward(before, ended), rel=1e-12)


def test_pictures_show_the_rover_where_it_is() -> None:
    pytest.importorskip("matplotlib")
    env = gymnasium.make(LEVEL, render_mode="rgb_array")
    env.reset(seed=1)
    first: Any = env.render()
    assert first.shape == (400, 600, 3) and first.dtype == np.uint8 and first.std() > 0.0
    env.step(np.array([1.0, 1.0]))
    assert (np.asarray(env.render()) != first).any()
    env.close()
    assert gymnasium.make(LEVEL).unwrapped.render() is None
    with pytest.raises(gymnasium.error.ResetNeeded):
        grouser.gym.LevelTraverseEnv(render_mode="rgb_array").render()
    with pytest.raises(gr.ParameterError, match="render_mode is 'ansi'"):
        grouser.gym.LevelTraverseEnv(render_mode="ansi")


def test_a_vector_environment_has_the_pictures_of_single_ones() -> None:
    pytest.importorskip("matplotlib")
    envs: Any = gymnasium.make_vec(LEVEL, num_envs=2, render_mode="rgb_array")
    with pytest.raises(gymnasium.error.ResetNeeded):
        envs.render()
    single: Any = gymnasium.make(LEVEL, render_mode="rgb_array")
    envs.reset(seed=1)
    single.reset(seed=2)
    for _ in range(3):
        envs.step(np.full((2, 2), 0.4))
        single.step(np.full(2, 0.4))
    pictures = envs.render()
    assert isinstance(pictures, tuple) and [it.shape for it in pictures] == [(400, 600, 3)] * 2
    assert (pictures[1] == single.render()).all() and (pictures[0] != pictures[1]).any()
    # The path starts anew with an episode.
    envs.reset(seed=1)
    single.reset(seed=2)
    assert (envs.render()[1] == single.render()).all()
    envs.close()
    single.close()
    plain = gymnasium.make_vec(LEVEL, num_envs=2)
    plain.reset(seed=1)
    assert plain.render() is None
    with pytest.raises(gr.ParameterError, match="render_mode is 'human', it must be 'rgb_array'"):
        grouser.gym.LevelTraverseVectorEnv(2, render_mode="human")


def test_a_window_is_drawn_after_each_step(monkeypatch: pytest.MonkeyPatch) -> None:
    plt = pytest.importorskip("matplotlib.pyplot")
    plt.close("all")
    pauses: list[float] = []
    monkeypatch.setattr(plt, "pause", pauses.append)
    env = grouser.gym.LevelTraverseEnv(render_mode="human")
    env.reset(seed=1)
    env.step(np.array([0.6, 0.0]))
    assert len(pauses) == 2 and len(plt.get_fignums()) == 1 and env.render() is None
    env.close()
    assert plt.get_fignums() == []


def test_the_learning_example_learns_to_turn() -> None:
    path = Path(__file__).resolve().parents[1] / "examples" / "learn_level_line.py"
    spec = importlib.util.spec_from_file_location("learn_level_line", path)
    assert spec is not None and spec.loader is not None
    example: Any = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    means = example.learn(generations=2, policies=16, steps=24)
    # Below the line it turns uphill, to the left.
    below = np.array([-0.1]), np.array([-0.1]), np.array([0.0])
    assert example.turns(means[-1][None], *below)[0] > example.turns(means[0][None], *below)[0] == 0.0
    learned, straight_on = (example.judged(policy, episodes=6, steps=24) for policy in (means[-1], means[0]))
    assert learned > straight_on


def test_proximal_policy_optimisation_learns_to_hold_the_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """In ten updates, on slopes and soils that it was not trained on. Seeds 1 to 6 gained 420 to 468; the
    sum of a minute's rewards is 120 at most, and about -400 straight on."""
    pytest.importorskip("jax", reason="the example needs JAX: pip install jax")
    monkeypatch.syspath_prepend(Path(__file__).resolve().parents[1] / "examples")
    monkeypatch.setattr(sys, "argv", ["ppo_level_line.py", "--updates", "10", "--seed", "1"])
    example: Any = importlib.import_module("ppo_level_line")
    example.main()
    printed = re.findall(r"^(\w+) *: mean return +([-\d.]+)", capsys.readouterr().out, re.MULTILINE)
    found = {name: float(total) for name, total in printed}
    assert found["trained"] > found["untrained"] + 200.0
    # The same seed learns the same policy, bit for bit.
    one, other = (example.learn(1, seed=2)[1].parameters for _ in range(2))
    leaves = example.jax.tree.leaves
    assert [it.tobytes() for it in leaves(one)] == [it.tobytes() for it in leaves(other)]
