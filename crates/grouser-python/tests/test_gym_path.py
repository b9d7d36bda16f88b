"""Following a path: what ends an episode, and that it is what missions say."""

from __future__ import annotations

import importlib.util
import math
import warnings
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode, SyncVectorEnv

import grouser as gr
from grouser.gym import PathFollowingEnv, PathFollowingVectorEnv

from test_gym import alike

PATH = "grouser/PathFollowing-v0"
#: The source paper's rim speed in shares of the fastest.
STRAIGHT_ON = np.array([0.6, 0.0])


def pursuit(env: Any, way: str = "0.5") -> Any:
    """Pure pursuit: turn towards the place on the path half a metre ahead."""
    names = list(env.unwrapped.observation_names)
    x, y = (names.index(f"ahead_{way}_m.{axis}_m") for axis in "xy")

    def policy(observation: Any) -> Any:
        bearing = math.atan2(observation[y], observation[x])
        return np.array([0.6, float(np.clip(bearing, -1.0, 1.0))])

    return policy


def episode(env: Any, policy: Any, **reset: Any) -> tuple[list[Any], bool, bool, dict[str, Any]]:
    """Observations and rewards, how the episode ended, and the last info."""
    observation, info = env.reset(**reset)
    seen: list[Any] = [observation]
    while True:
        observation, reward, terminated, truncated, info = env.step(policy(observation))
        seen.append((observation, reward))
        assert observation in env.observation_space
        if terminated or truncated:
            return seen, terminated, truncated, info


@pytest.mark.parametrize("actions", ["drive-turn", "sides", "wheels"])
def test_the_checker_has_nothing_to_say(actions: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(gymnasium.make(PATH, actions=actions).unwrapped, skip_render_check=True)


def test_a_scripted_policy_completes_two_bends() -> None:
    env = gymnasium.make(PATH, slope_deg=(10.0, 10.0))
    for seed in range(4):
        _, terminated, truncated, info = episode(env, pursuit(env), seed=seed)
        assert (terminated, truncated, info["outcome"]) == (True, False, "completed")
        assert info["stopped_by"] is None and info["reason"] is None and "stopped_value" not in info
        length = env.unwrapped.path_length_m  # type: ignore[attr-defined]
        assert length - 0.1 <= info["along_track_m"] and abs(info["cross_track_m"]) < 0.1


@pytest.mark.parametrize(
    ("limit", "above", "over"), [("off_path_m", 0.15, None), ("drift_m", 0.07, 0.5)]
)
def test_a_naive_policy_is_stopped(limit: str, above: float, over: float | None) -> None:
    stop = {limit: {"above": above} | ({} if over is None else {"over_m": over})}
    path = {"contour_m": 5.0}
    env = PathFollowingEnv(path=path, stop=stop, slope_deg=(15.0, 15.0), soil="toyoura")
    options = {"yaw_deg": 0.0}
    _, terminated, _, info = episode(env, lambda _: STRAIGHT_ON, seed=1, options=options)
    assert terminated and info["outcome"] == env.outcome == "stopped"
    assert info["stopped_by"] == limit and above < info["stopped_value"] < above + 0.01
    if limit == "off_path_m":
        assert info["stopped_value"] == pytest.approx(-info["cross_track_m"], rel=1e-12)
    # With the pursuit the rover stays on the same path.
    _, _, _, info = episode(env, pursuit(env), seed=1, options=options)
    assert info["outcome"] == "completed"


def test_a_limit_on_slip_ends_an_episode_beyond_the_limit_of_the_rover() -> None:
    up = [(0.0, 0.0), (0.0, 5.0)]
    stop = {"slip_ratio": {"above": 0.6, "over_m": 0.3}}
    env = PathFollowingEnv(path=up, stop=stop, slope_deg=(20.0, 20.0), soil="toyoura")
    options = {"yaw_deg": 90.0}
    _, terminated, _, info = episode(env, lambda _: STRAIGHT_ON, seed=1, options=options)
    assert terminated and info["stopped_by"] == "slip_ratio" and info["stopped_value"] > 0.6
    assert info["reason"].startswith("slip ratio 0.") and "over 0.3 m after" in info["reason"]
    gentle = PathFollowingEnv(path=up, stop=stop, slope_deg=(5.0, 5.0), soil="toyoura")
    _, _, _, info = episode(gentle, lambda _: STRAIGHT_ON, seed=1, options=options)
    assert info["outcome"] == "completed"


@pytest.mark.parametrize(
    ("slope", "yaw", "key", "limit"),
    [
        (12.0, 0.0, "off_path_m", {"above": 0.05}),
        (12.0, 0.0, "drift_m", {"above": 0.02, "over_m": 0.3}),
        (14.0, 60.0, "slip_ratio", {"above": 0.3, "over_m": 0.5}),
        (10.0, 30.0, "energy_j", {"above": 3.0}),
        (10.0, 30.0, "time_s", {"above": 6.25}),
        (14.0, 60.0, "sinkage_over_radius", {"above": 0.05}),
    ],
)
def test_a_straight_drive_stops_where_a_mission_does(
    slope: float, yaw: float, key: str, limit: dict[str, float]
) -> None:
    stop = {key: limit}
    start, drive = {"yaw_deg": yaw}, {"law": "constant", "rim_speed_m_s": 0.06}
    mission = gr.mission(
        {
            "name": "one leg",
            "slope_deg": slope,
            "start": start,
            "leg": [{"drive_m": 5.0, "speed_m_s": 0.06}],
            "stop": stop,
        }
    )
    assert mission.legs.stopped_by[0] == key
    heading = np.radians(yaw)
    env = PathFollowingEnv(
        path=[(0.0, 0.0), (5.0 * np.cos(heading), 5.0 * np.sin(heading))],
        stop=stop,
        scenario=gr.Scenario(slope_deg=slope, drive=drive),
    )
    options = {"yaw_deg": yaw, "soil_seed": None}
    _, terminated, truncated, info = episode(env, lambda _: STRAIGHT_ON, seed=1, options=options)
    assert (terminated, truncated) == (key != "time_s", key == "time_s")
    assert info["stopped_by"] == key and info["reason"] == mission.legs.reason[0]
    assert info["time_s"] == pytest.approx(float(mission.legs.time_s[0]), abs=1e-9)
    for name in ("x_m", "y_m", "energy_j"):
        assert info[name] == pytest.approx(float(getattr(mission.legs, name)[0]), abs=1e-9), name


@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
def test_the_vector_form_has_the_bits_of_single_ones(mode: AutoresetMode) -> None:
    """Over ends of all kinds: completed, stopped, late, and cut off by the number of steps."""
    stop = {"off_path_m": {"above": 0.2}, "time_s": {"above": 6.6}}
    settings: dict[str, Any] = {
        "path": [(0.0, 0.0), (0.18, 0.0), (0.24, 0.02)],
        "slope_deg": (5.0, 30.0),
        "stop": stop,
        "within_m": 0.05,
        "max_episode_steps": 14,
    }
    count = 6
    make = [lambda: gymnasium.make(PATH, **settings)] * count
    singles = SyncVectorEnv(make, autoreset_mode=mode)  # type: ignore[arg-type]
    together: Any = gymnasium.make_vec(PATH, num_envs=count, autoreset_mode=mode, **settings)
    assert isinstance(together, PathFollowingVectorEnv)
    for space in ("observation_space", "action_space", "single_observation_space"):
        assert getattr(together, space) == getattr(singles, space)
    one, other = together.reset(seed=11), singles.reset(seed=11)
    alike(one, other, "reset")
    random, ends = np.random.default_rng(3), set()
    for k in range(30):
        actions = random.uniform((0.4, -0.4), (1.0, 0.4), (count, 2))
        ours, theirs = together.step(actions), singles.step(actions)
        names = ("observations", "rewards", "ended", "late", "infos")
        for name, left, right in zip(names, ours, theirs):
            alike(left, right, f"step {k}: {name}")
        infos = ours[4]["final_info"] if "final_info" in ours[4] else ours[4]
        for place in np.flatnonzero(ours[2] | ours[3]):
            stopped = infos["stopped_by"][place]
            ends.add(stopped if stopped else infos["outcome"][place])
    assert {"completed", "off_path_m"} <= ends, ends


def test_an_episode_is_decided_by_its_seed_and_its_actions() -> None:
    env = gymnasium.make(PATH)
    random = np.random.default_rng(5)
    actions = random.uniform((0.4, -0.2), (1.0, 0.2), (40, 2))
    found = []
    for seed in (1, 1, 2):
        env.reset(seed=seed)
        found.append([env.step(action)[:2] for action in actions])
    bits = [[(seen.tobytes(), reward) for seen, reward in one] for one in found]
    assert bits[0] == bits[1] != bits[2]


def test_rewards_are_the_sum_of_their_parts() -> None:
    weights = {"progress": 2.0, "cross_track": 0.5, "energy": 0.3, "stopped": 7.0}
    stop = {"off_path_m": {"above": 0.1}}
    env = PathFollowingEnv(weights=weights, stop=stop, slope_deg=(12.0, 12.0))
    _, before = env.reset(seed=4)
    terminated = False
    while not terminated:
        _, reward, terminated, _, info = env.step(np.array([0.6, -0.1]))
        parts = {name: it for name, it in info.items() if name.startswith("reward_")}
        progress = (info["along_track_m"] - before["along_track_m"]) / (0.1 * 0.5)
        expected = {
            "reward_progress": 2.0 * progress,
            "reward_cross_track": -0.5 * (info["cross_track_m"] / 0.1) ** 2,
            "reward_energy": -0.3 * (info["energy_j"] - before["energy_j"]),
            "reward_completed": 0.0,
            "reward_stopped": -7.0 * terminated,
        }
        assert parts == pytest.approx(expected, rel=1e-12, abs=1e-12)
        assert reward == pytest.approx(sum(parts.values()), rel=1e-12)
        before = info
    assert info["stopped_by"] == "off_path_m"


def test_what_is_observed_is_what_its_names_say() -> None:
    path = [(0.0, 0.0), (0.5, 0.0), (0.5, 2.0)]
    env = PathFollowingEnv(path=path, preview_m=(0.3, 0.8))
    names, space = env.observation_names, env.observation_space
    assert space.shape == (len(names),) and len(set(names)) == len(names)
    observation, info = env.reset(seed=2, options={"yaw_deg": 30.0})
    seen = dict(zip(names, observation.tolist()))
    assert seen["heading_error_deg"] == pytest.approx(30.0) == pytest.approx(seen["yaw_deg"])
    assert seen["slope_deg"] == info["slope_deg"] == env.slope_deg
    # The path turns half a metre ahead; the body's axes are turned by 30°.
    cos, sin = np.cos(np.pi / 6.0), np.sin(np.pi / 6.0)
    turned = np.array([[cos, sin], [-sin, cos]])
    for way, place in ((0.3, (0.3, 0.0)), (0.8, (0.5, 0.3))):
        ahead = [seen[f"ahead_{way}_m.{axis}_m"] for axis in "xy"]
        np.testing.assert_allclose(ahead, turned @ place, atol=1e-12)
    observation, *_, info = env.step(STRAIGHT_ON)
    seen = dict(zip(names, observation.tolist()))
    for name in ("along_track_m", "cross_track_m", "heading_error_deg"):
        assert seen[name] == info[name]
    for name in ("slip_ratio", "sinkage_mm", "torque_nm"):
        wheels = [seen[f"{wheel}.{name}"] for wheel in ("front-left", "rear-left", "rear-right")]
        assert wheels == env.wheel[name][:3].tolist()


def test_actions_turn_the_wheels_that_they_name() -> None:
    shares = {"drive-turn": [0.5, 0.2], "sides": [0.3, 0.7], "wheels": [0.3, 0.3, 0.7, 0.7]}
    for actions, action in shares.items():
        env = PathFollowingEnv(actions=actions)  # type: ignore[arg-type]
        env.reset(seed=1)
        env.step(np.array(action))
        rims = env.wheel["wheel_speed_rad_s"] * 0.11
        np.testing.assert_allclose(rims, 0.1 * np.array(shares["wheels"]))


def test_paths_are_waypoints_arcs_and_contours() -> None:
    quarter = {"radius_m": 2.0, "angle_deg": -90.0, "heading_deg": 120.0}
    arc = PathFollowingEnv(path={"arc": quarter})
    assert arc.path_length_m == pytest.approx(np.pi)
    observation, info = arc.reset(seed=3)
    assert abs(info["heading_error_deg"]) <= 10.0 and abs(arc.state["yaw_deg"] - 120.0) <= 10.0
    back = PathFollowingEnv(path={"contour_m": -3.0})
    assert back.path_length_m == 3.0
    for seed in range(6):
        _, info = back.reset(seed=seed)
        assert abs(info["heading_error_deg"]) <= 10.0 and abs(back.state["yaw_deg"]) >= 170.0


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"path": []}, r"path has shape \(0,\), it must be \(waypoints, 2\)"),
        ({"path": [(0.0, 0.0)]}, "with two waypoints or more"),
        ({"path": [(0.0, 0.0), (0.0, 0.0)]}, "way from a waypoint to the next"),
        ({"path": [(0.0, 0.0), (1.0, np.nan)]}, "y of a waypoint"),
        ({"path": {"circle": 1.0}}, r"path has the keys \['circle'\], it must be waypoints"),
        ({"path": {"contour_m": 0.0}}, "way from a waypoint to the next"),
        ({"path": {"arc": {"radius_m": -1.0, "angle_deg": 90.0}}}, "radius of an arc"),
        ({"path": {"arc": {"radius_m": 1.0}}}, "path.arc lacks angle_deg"),
        ({"path": {"arc": {"radius_m": 1.0, "angle_deg": 90.0, "yaw": 0}}}, "no key 'yaw'"),
        ({"stop": {"slip": {"above": 0.4}}}, "unknown key `stop.slip`"),
        ({"stop": {"slip_ratio": {"above": 4.0}}}, "`stop.slip_ratio.above` is 4, it must be 0 to"),
        ({"stop": {"slip_ratio": "much"}}, "`stop.slip_ratio`"),
        ({"stop": {"time_s": {"above": np.nan}}}, "`stop.time_s.above`"),
        ({"stop": {"time_s": {"above": 4.0, "then": "next-leg"}}}, "time_s.then must be left out"),
        ({"stop": 3.0}, "stop is of type float"),
        ({"within_m": 0.0}, "within_m is 0, it must be above 0"),
        ({"weights": {"speed": 1.0}}, "no part 'speed'; it has progress, cross_track"),
        ({"weights": {"energy": np.inf}}, "weights.energy is inf"),
        ({"actions": "steer"}, "actions is 'steer', it must be 'drive-turn'"),
        ({"preview_m": (0.0,)}, "each way must be above 0"),
    ],
)
def test_what_cannot_be_asked_says_what_can(settings: dict[str, Any], message: str) -> None:
    for make in (gymnasium.make, gymnasium.make_vec):
        with pytest.raises(gr.ParameterError, match=message):
            make(PATH, **settings)


def test_actions_that_are_none_are_refused() -> None:
    for actions, wrong in (
        ("drive-turn", ([np.nan, 0.0], [0.1], "go", [[0.1, 0.1]])),
        ("wheels", ([0.1, 0.1], [0.1, 0.1, np.nan, 0.1])),
    ):
        env = PathFollowingEnv(actions=actions)  # type: ignore[arg-type]
        env.reset(seed=1)
        before = env.state
        for action in wrong:
            with pytest.raises(gr.ParameterError, match="action"):
                env.step(action)  # type: ignore[arg-type]
        assert env.state == before


def test_a_rover_that_has_ended_stays_where_it_is() -> None:
    env = PathFollowingEnv(stop={"time_s": {"above": 0.75}})
    env.reset(seed=1)
    env.step(STRAIGHT_ON)
    info = env.step(STRAIGHT_ON)[4]
    assert info["time_s"] == pytest.approx(0.8) and info["stopped_by"] == "time_s"
    again = env.step(STRAIGHT_ON)[4]
    assert again["time_s"] == info["time_s"] and again["x_m"] == info["x_m"]


def test_pictures_show_the_path() -> None:
    pytest.importorskip("matplotlib")
    pictures = []
    for path in ([(0.0, 0.0), (2.0, 0.0)], [(0.0, 0.0), (1.0, 1.0)]):
        env: Any = gymnasium.make(PATH, path=path, render_mode="rgb_array")
        env.reset(seed=1, options={"yaw_deg": 0.0})
        pictures.append(env.render())
        env.close()
    assert pictures[0].shape == (400, 600, 3) and (pictures[0] != pictures[1]).any()


def test_the_example_completes_what_straight_on_does_not() -> None:
    """On slopes and soils that it does not know. Quasi-steady runs, the quicker ones."""
    path = Path(__file__).resolve().parents[1] / "examples" / "follow_path.py"
    spec = importlib.util.spec_from_file_location("follow_path", path)
    assert spec is not None and spec.loader is not None
    example: Any = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    steady = {"scenario": {"simulation": "quasi-steady"}, "slope_deg": (5.0, 12.0)}
    straight, _, straight_errors = example.ends(example.straight_on, 16, seed=100, **steady)
    pursuit, times, errors = example.ends(None, 16, seed=100, **steady)
    assert pursuit.count("completed") >= 14 and straight.count("off_path_m") >= 12
    assert np.median(errors) < 0.5 * np.median(straight_errors)
    # Four metres at 6 cm/s take more than a minute.
    assert (times[np.array(pursuit) == "completed"] > 60.0).all()
