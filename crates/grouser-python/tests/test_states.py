"""States as values: what was saved, copied or pickled goes on bit for bit, and shares nothing."""

from __future__ import annotations

import copy
import multiprocessing
import pickle
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from typing import Any

import numpy as np
import pytest

import grouser as gr

#: Left wheels first, as the mounts of the preset have them: left, left, right, right.
ARC = [0.04, 0.04, 0.08, 0.08]
RIMS = "rim_speed_m_s"
MOTOR = {
    "resistance_ohm": 10.0,
    "torque_constant_nm_a": 0.01,
    "gear_ratio": 250.0,
    "gear_efficiency": 0.6,
    "control": {"gain_v_s_rad": 0.5, "integral_v_rad": 5.0, "voltage_limit_v": 8.0},
    "winding": {"thermal_resistance_k_w": 20.0, "heat_capacity_j_k": 2.0, "highest_degc": 125.0},
}
BATTERY = {
    "capacity_wh": 20.0,
    "full_voltage_v": 8.4,
    "empty_voltage_v": 6.4,
    "internal_resistance_ohm": 0.3,
    "electronics_w": 3.0,
}
MAP = gr.Terrain(0.1 * np.arange(5.0) * np.ones((5, 1)), cell_size_m=2.0)

#: Scenarios with all that a state has.
SCENARIOS: dict[str, dict[str, Any]] = {
    "plane": {"slope_deg": 12.0},
    "quasi-steady": {"slope_deg": 12.0, "simulation": "quasi-steady"},
    "hills": {"terrain": {"surface": "ripple", "amplitude_m": 0.02, "wavelength_m": 3.0}},
    "map": {"terrain": MAP},
    "sampled": {"slope_deg": 8.0, "soil": "toyoura-uncertain"},
    "motors": {"slope_deg": 5.0, "rover": gr.Rover("hakuto", motor=MOTOR, battery=BATTERY)},
}

#: Ways to another run that goes on as the first one.
Way = Callable[[Any], Any]


def from_state(run: gr.Run) -> gr.Run:
    other = gr.Run(run.scenario, commands=RIMS)
    other.restore(gr.RunState(bytes(run.save())))
    return other


def unpickled(thing: Any) -> Any:
    return pickle.loads(pickle.dumps(thing))


WAYS: dict[str, Way] = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    "pickle": unpickled,
    "state": from_state,
}


def begun(scenario: str) -> gr.Run:
    """A run on its way, with a sampled soil where there is one."""
    run = gr.Run(commands=RIMS, **SCENARIOS[scenario])
    run.reset(seed=3, yaw_deg=10.1)
    for _ in range(3):
        run.step(0.06, 0.17)
    return run


def assert_same(one: gr.Run, other: gr.Run) -> None:
    for name in ("state", "time_s", "energy_j", "power_w", "outcome", "message", "simulation"):
        first, second = getattr(one, name), getattr(other, name)
        assert np.array_equal(first, second), name
    for name, values in one.wheel.items():
        assert np.array_equal(values, other.wheel[name], equal_nan=True), name


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("scenario", SCENARIOS)
def test_a_run_goes_on_bit_for_bit_and_alone(scenario: str, way: str) -> None:
    run = begun(scenario)
    other = WAYS[way](run)
    assert_same(run, other)
    here = run.state.tolist()
    other.step(ARC, 0.4)
    # Nothing is shared: the first one has not moved.
    assert run.state.tolist() == here != other.state.tolist()
    run.step(ARC, 0.4)
    for _ in range(2):
        assert_same(run, other)
        run.step(0.05, 0.3)
        other.step(0.05, 0.3)
    assert run.save() == other.save()


def test_a_state_is_a_value() -> None:
    run = begun("plane")
    state, again = run.save(), run.save()
    assert state == again == unpickled(state) == copy.deepcopy(state)
    assert hash(state) == hash(again) and len({state, again}) == 1
    before = run.state
    later = run.step(ARC, 0.5)
    assert run.save() != state
    assert run.restore(state).tolist() == before.tolist()
    assert run.step(ARC, 0.5).tolist() == later.tolist()
    with pytest.raises(AttributeError, match="does not change"):
        state._content = b""


def test_an_ended_run_and_its_reset_are_in_the_state() -> None:
    run = gr.Run(slope_deg=10.0, commands=RIMS)
    run.reset(slope_deg=35.0)
    run.step(0.06, 60.0)
    assert run.outcome == "sliding"
    other = from_state(run)
    assert_same(run, other)
    # Where it started is in it, too: the slope is that of the reset, not of the document.
    assert other.step(0.06, 1.0).tolist() == run.state.tolist()


@pytest.mark.parametrize(
    ("other", "message"),
    [
        ({"slope_deg": 12.5}, "another scenario"),
        ({"slope_deg": 12.0, "rover": "spirit"}, "another scenario"),
        ({"slope_deg": 12.0, "soil": "toyoura-uncertain"}, "another scenario"),
    ],
)
def test_a_state_of_another_scenario_is_refused(other: dict[str, Any], message: str) -> None:
    state, run = begun("plane").save(), gr.Run(commands=RIMS, **other)
    before = run.state.tolist()
    with pytest.raises(gr.ParameterError, match=message) as refused:
        run.restore(state)
    assert refused.value.name == "state" and run.state.tolist() == before


def test_maps_tell_scenarios_apart() -> None:
    heights = MAP.heights_m.copy()
    heights[2, 2] += 0.01
    other = gr.Run(terrain=gr.Terrain(heights, cell_size_m=2.0), commands=RIMS)
    with pytest.raises(gr.ParameterError, match="another scenario"):
        other.restore(begun("map").save())


def test_damaged_states_are_refused() -> None:
    run = begun("plane")
    content = bytes(run.save())
    for place in (0, len(content) // 2, len(content) - 1):
        damaged = bytearray(content)
        damaged[place] ^= 4
        with pytest.raises(gr.ParameterError):
            run.restore(gr.RunState(bytes(damaged)))
    with pytest.raises(gr.ParameterError, match="must be a RunState"):
        run.restore(content)  # type: ignore[arg-type]
    with pytest.raises(gr.ParameterError, match="must be bytes"):
        gr.RunState("text")  # type: ignore[arg-type]
    assert run.save() == gr.RunState(content)


def test_a_batch_takes_one_state_for_all_or_one_for_each() -> None:
    run = begun("plane")
    batch = gr.RunBatch([run.scenario] * 3, commands=RIMS)
    batch.restore(run.save(), mask=[True, False, True])
    assert batch.time_s.tolist() == [run.time_s, 0.0, run.time_s]
    together = batch.step([ARC, ARC, [0.06] * 4], 0.4)
    assert together[0].tolist() == run.step(ARC, 0.4).tolist()
    others = gr.RunBatch([run.scenario] * 3, commands=RIMS)
    assert others.restore(batch.save()).tolist() == batch.state.tolist()
    assert others.step(0.05, 0.4).tolist() == batch.step(0.05, 0.4).tolist()
    with pytest.raises(gr.ParameterError, match="2 states for 3 rovers"):
        batch.restore(batch.save()[:2])


def test_what_a_subclass_keeps_is_copied_too() -> None:
    class Noted(gr.Run):
        notes: list[str]

    run = Noted(slope_deg=5.0)
    run.notes = ["first"]
    deep, shallow = copy.deepcopy(run), copy.copy(run)
    run.notes.append("second")
    assert (deep.notes, shallow.notes) == (["first"], ["first", "second"])


#: What is kept and sent besides, each as small as it can be.
THINGS: dict[str, Callable[[], Any]] = {
    "animation": lambda: gr.simulate(duration_s=0.2).animate(),
    "card": lambda: gr.card(slope_deg=[5.0], samples=3),
    "flagged wheel": lambda: gr.settle("toyoura", "hakuto", load_n=10.0, slip_ratio=0.1),
    "heading by models": lambda: gr.heading(slope_deg=[5.0], model="all"),
    "heading map": lambda: gr.heading_map(course_deg=[0.0], slope_deg=[5.0]),
    "headings": lambda: gr.heading(slope_deg=[5.0], soil="toyoura-uncertain", samples=3),
    "learner": lambda: gr.Learner(prior="toyoura-uncertain"),
    "linear step": lambda: gr.Run().linearise(0.5, 0.5),
    "map": lambda: MAP,
    "mission": lambda: gr.mission(gr.Mission(leg=[{"drive_m": 0.1}])),
    "rollout": lambda: gr.rollout(slope_deg=[5.0], duration_s=0.2, trajectories=True),
    "slip estimator": lambda: gr.SlipEstimator(gr.Scenario(SCENARIOS["motors"])),
    "state": lambda: begun("plane").save(),
    "wheel speeds": lambda: gr.wheel_speeds(slope_deg=[5.0]),
}


def there_and_back(thing: Any) -> Any:
    return copy.deepcopy(thing)


def test_what_was_computed_goes_to_other_processes_and_back() -> None:
    things = [make() for make in THINGS.values()]
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(1, mp_context=context) as pool:
        back = list(pool.map(there_and_back, things))
    for name, thing, other in zip(THINGS, things, back):
        assert type(other) is type(thing), name
        assert pickle.dumps(other) == pickle.dumps(copy.deepcopy(other)), name
        assert repr(other).split(" at 0x")[0] == repr(thing).split(" at 0x")[0], name


def step_there(thing: Any) -> Any:
    """What a run or an environment does in another process."""
    if isinstance(thing, gr.Run):
        return thing.step(ARC, 0.4).tolist(), thing.save()
    return thing.step(thing.action_space.low * 0.0 + 0.4)[0].tolist(), None


def test_processes_go_on_with_runs() -> None:
    runs = [begun(name) for name in SCENARIOS]
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(2, mp_context=context) as pool:
        there = list(pool.map(step_there, runs))
    for run, (state, saved) in zip(runs, there):
        assert run.step(ARC, 0.4).tolist() == state
        assert run.save() == saved


# ---- environments ----

gym = pytest.importorskip("grouser.gym")

ENVIRONMENTS: dict[str, Callable[[], Any]] = {
    "level": lambda: gym.LevelTraverseEnv(),
    "path": lambda: gym.PathFollowingEnv(stop={"drift_m": {"above": 0.3, "over_m": 0.5}}),
    "arc": lambda: gym.PathFollowingEnv(path={"arc": {"radius_m": 2.0, "angle_deg": 90.0}}),
    "levels": lambda: gym.LevelTraverseVectorEnv(3),
    "paths": lambda: gym.PathFollowingVectorEnv(3),
}


def env_begun(name: str) -> Any:
    env = ENVIRONMENTS[name]()
    env.reset(seed=5)
    for _ in range(3):
        env.step(np.full(env.action_space.shape, 0.5))
    return env


def env_from_state(env: Any, name: str) -> Any:
    other = ENVIRONMENTS[name]()
    other.restore(unpickled(env.save()))
    return other


def assert_equal(one: Any, other: Any) -> None:
    if isinstance(one, dict):
        assert list(one) == list(other)
        for key in one:
            assert_equal(one[key], other[key])
    elif isinstance(one, tuple):
        assert len(one) == len(other)
        for first, second in zip(one, other):
            assert_equal(first, second)
    elif isinstance(one, np.ndarray) and one.dtype == object:
        assert one.tolist() == other.tolist()
    else:
        assert np.array_equal(one, other, equal_nan=isinstance(one, (float, np.ndarray)))


@pytest.mark.parametrize("way", ["copy", "deepcopy", "pickle", "state"])
@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_an_environment_goes_on_bit_for_bit_and_alone(name: str, way: str) -> None:
    env = env_begun(name)
    other = env_from_state(env, name) if way == "state" else WAYS[way](env)
    action = np.full(env.action_space.shape, 0.3)
    twice = [other.step(action) for _ in range(2)]
    for found in twice:
        assert_equal(env.step(action), found)
    # What is sampled at the next reset goes on, too; and a state is taken again as it was.
    saved = env.save()
    first = env.reset()
    assert_equal(first, other.reset())
    env.restore(saved)
    assert_equal(first, env.reset())


def test_an_environment_of_another_scenario_refuses_a_state() -> None:
    state = env_begun("level").save()
    for other, message in [
        (gym.LevelTraverseEnv(slope_deg=(3.0, 4.0)), "another scenario"),
        (gym.PathFollowingEnv(), "another kind of environment"),
        (gym.LevelTraverseVectorEnv(1), "another kind of environment"),
    ]:
        other.reset(seed=5)
        before = other.save()
        with pytest.raises(gr.ParameterError, match=message):
            other.restore(state)
        assert other.save().rovers == before.rovers, "no rover has moved"
    levels = env_begun("levels").save()
    with pytest.raises(gr.ParameterError, match="3 states for 2 rovers"):
        gym.LevelTraverseVectorEnv(2).restore(levels)
    with pytest.raises(gr.ParameterError, match="must be an EnvState"):
        gym.LevelTraverseEnv().restore(b"")
    path = env_begun("path").save()
    with pytest.raises(gr.ParameterError, match="another path, or under other limits"):
        ENVIRONMENTS["arc"]().restore(path)


def test_processes_go_on_with_environments() -> None:
    envs = [env_begun(name) for name in ENVIRONMENTS]
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(1, mp_context=context) as pool:
        there = list(pool.map(step_there, envs))
    for env, (observed, _) in zip(envs, there):
        assert env.step(env.action_space.low * 0.0 + 0.4)[0].tolist() == observed


def test_a_wrapped_environment_is_copied_with_its_wrappers() -> None:
    gymnasium = pytest.importorskip("gymnasium")
    env = gymnasium.make("grouser/LevelTraverse-v0", max_episode_steps=3)
    env.reset(seed=1)
    action = np.array([0.5, 0.0])
    env.step(action)
    twin = unpickled(copy.deepcopy(env))
    for truncated in (False, True):
        one, other = env.step(action), twin.step(action)
        assert_equal(one, other)
        assert one[3] is truncated
