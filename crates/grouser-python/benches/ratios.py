"""What Python costs: the same work asked from NumPy, and done by a program that has it at hand.

Both use all cores, in turns, so that other work on the machine slows both; the best time of each
counts. The program is the one argument. A second table has calls that do little each.
"""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np

import grouser as gr
from grouser.gym import LevelTraverseVectorEnv

ROUNDS = 5
#: Length of a step of a run [s].
PERIOD_S = 0.02
#: Rovers of the vector environment, how long an action lasts [s], and how many there are.
ENVIRONMENTS, ACTION_S, STEPS = 64, 0.5, 20


def alone(work: str, *columns: np.ndarray) -> float:
    """Seconds that the program takes for the rows of some columns."""
    rows = np.column_stack(columns).astype("<f8").tobytes()
    done = subprocess.run([sys.argv[1], work], input=rows, stdout=subprocess.PIPE, check=True)
    return float(done.stdout)


def measure(name: str, native: Callable[[], float], python: Callable[[], object]) -> str:
    """A line of the table."""
    ours, theirs = [], []
    for _ in range(ROUNDS):
        theirs.append(native())
        start = time.perf_counter()
        result = python()
        ours.append(time.perf_counter() - start)
        del result
    (rust, numpy) = (min(theirs), min(ours))
    return f"{name:<44}{rust:8.3f} s  {numpy:8.3f} s  {100 * (numpy / rust - 1):+6.1f} %"


def call(name: str, work: Callable[[], object], calls: int = 200) -> str:
    """A line of the table of single calls."""
    best = float("inf")
    for _ in range(ROUNDS):
        start = time.perf_counter()
        for _ in range(calls):
            work()
        best = min(best, (time.perf_counter() - start) / calls)
    return f"{name:<58}{1e6 * best:8.1f} µs"


def steps_of_mujoco() -> list[str]:
    """Lines for a four-wheel rover in MuJoCo; none where it is not installed."""
    try:
        import mujoco
        from grouser.mujoco import SoilContact, rover_xml
    except ImportError:
        return []
    rover = gr.Rover("hakuto")
    model = mujoco.MjModel.from_xml_string(rover_xml(rover))
    data = mujoco.MjData(model)
    wheels = {mount["name"]: rover.wheel for mount in rover.mount}
    soil = SoilContact(model, soil="toyoura", wheels=wheels, ground="ground")
    soil.step(data, 500)
    # MuJoCo alone steps the rover as the soil holds it: with the forces of the last step.
    return [
        call("MuJoCo: a step of a rover on soil, in SoilContact.step", lambda: soil.step(data)),
        call("MuJoCo: mj_step of the same model", lambda: mujoco.mj_step(model, data)),
    ]


def main() -> None:
    rng = np.random.default_rng(1)
    count = 1_000_000
    load, ratio, angle = (
        rng.uniform(low, high, count) for low, high in [(5.0, 40.0), (0.0, 0.9), (-20.0, 20.0)]
    )
    depth = rng.uniform(1.0, 30.0, count)
    soil, wheel = gr.Soil("toyoura"), gr.Wheel("hakuto")

    slopes, yaws = rng.uniform(0.0, 18.0, 10_000), rng.uniform(-10.0, 10.0, 10_000)
    steady = gr.Scenario(simulation="quasi-steady")
    some = slice(0, 1000)
    dynamic = gr.Scenario()

    print(f"{'work':<44}{'Rust':>8}    {'Python':>8}    {'more':>6}")
    lines = [
        (
            "1,000,000 wheels settle",
            lambda: alone("wheels", load, ratio, angle),
            lambda: gr.settle(soil, wheel, load_n=load, slip_ratio=ratio, slip_angle_deg=angle),
        ),
        (
            "forces of 1,000,000 wheels",
            lambda: alone("forces", depth, ratio, angle),
            lambda: gr.wheel_forces(
                soil, wheel, sinkage_mm=depth, slip_ratio=ratio, slip_angle_deg=angle
            ),
        ),
        (
            "10,000 quasi-steady traverses of 20 s",
            lambda: alone("quasi-steady", slopes, yaws),
            lambda: gr.rollout(steady, slope_deg=slopes, yaw_deg=yaws),
        ),
        (
            "the same, keeping all records",
            lambda: alone("quasi-steady", slopes, yaws),
            lambda: gr.rollout(steady, slope_deg=slopes, yaw_deg=yaws, trajectories=True),
        ),
        (
            "1,000 dynamic traverses of 20 s",
            lambda: alone("dynamic", slopes[some], yaws[some]),
            lambda: gr.rollout(dynamic, slope_deg=slopes[some], yaw_deg=yaws[some]),
        ),
    ]
    for line in lines:
        print(measure(*line), flush=True)
    print()
    print(f"{'Run.step of 20 ms, new speeds at each':<44}{1e6 * step_seconds():8.0f} µs")
    title = f"steps a second of {ENVIRONMENTS} environments, {ACTION_S} s"
    print(f"\n{title:<44}{'quasi-steady':>14}{'dynamic':>14}")
    for row in steps_of_environments():
        print(row, flush=True)

    print(f"\n{'call':<58}{'time':>11}")
    print(call("a preset of a soil", lambda: gr.Soil("toyoura")))
    print(call("a soil with another cohesion", lambda: soil.replace(cohesion_kpa=0.5)))
    print(call("a wheel settles", lambda: gr.settle(soil, wheel, load_n=17.0, slip_ratio=0.2)))
    for step in steps_of_mujoco():
        print(step)


def step_seconds() -> float:
    """Seconds that a step takes under speeds that rise and fall."""
    run, count = gr.Run(gr.Scenario(), commands="rim_speed_m_s"), 200
    speeds = 0.06 * (1.0 + 0.2 * np.sin(0.025 * np.arange(ROUNDS * count)))
    times = []
    for part in speeds.reshape(ROUNDS, count):
        start = time.perf_counter()
        for speed in part:
            run.step(speed, PERIOD_S)
        times.append((time.perf_counter() - start) / count)
    return min(times)


def steps_of_environments() -> list[str]:
    """Lines for a vector environment, and for rovers over hills, by how actions change."""
    rng = np.random.default_rng(1)
    shape = (STEPS, ENVIRONMENTS, 2)
    straight = np.tile([0.6, 0.0], (STEPS, ENVIRONMENTS, 1))
    nearly = straight + rng.uniform(-0.18, 0.18, shape)
    rests = straight * (np.arange(STEPS) % 4 < 2)[:, None, None]
    anyhow = rng.uniform(-1.0, 1.0, shape)
    actions = {
        "constant": straight,
        "drive 0.6 ± 30 %, turn from −0.18 to 0.18": nearly,
        "a second at 0.6, a second at rest": rests,
        "any drive and turn from −1 to 1": anyhow,
        "any, at rest in every fifth step": anyhow * (np.arange(STEPS) % 5 < 4)[:, None, None],
    }
    lines = []
    for name, given in actions.items():
        both = [steps_per_second(simulation, given) for simulation in ("quasi-steady", "dynamic")]
        lines.append(f"{name:<44}" + "".join(f"{rate:14,.0f}" for rate in both))
    hills = [over_hills(simulation, nearly) for simulation in ("quasi-steady", "dynamic")]
    lines.append(f"{'over hills, within 30 %':<44}" + "".join(f"{rate:14,.0f}" for rate in hills))
    return lines


def steps_per_second(simulation: str, actions: np.ndarray) -> float:
    """Steps a second of a vector environment under actions, one set for each step."""
    settings = {"dt_s": ACTION_S, "scenario": {"simulation": simulation}}
    envs = LevelTraverseVectorEnv(ENVIRONMENTS, max_episode_steps=None, **settings)
    envs.reset(seed=1)
    start = time.perf_counter()
    for action in actions:
        envs.step(action)
    return actions.shape[0] * ENVIRONMENTS / (time.perf_counter() - start)


def over_hills(simulation: str, actions: np.ndarray) -> float:
    """The same of rovers on a site with craters, each from a place of its own."""
    site = gr.Terrain.lunar(size_m=60.0, cell_size_m=0.2, seed=1)
    starts = np.random.default_rng(2).uniform(-15.0, 15.0, (ENVIRONMENTS, 2))
    base = gr.Scenario(simulation=simulation, terrain=site)
    scenarios = [base.replace(terrain={"start_m": place}) for place in starts.tolist()]
    batch = gr.RunBatch(scenarios, commands="rim_speed_m_s")
    sides = np.array([-1.0 if it["position_m"][1] > 0.0 else 1.0 for it in base.rover.mount])
    start = time.perf_counter()
    for action in actions:
        batch.step(0.1 * (action[:, :1] + action[:, 1:] * sides), ACTION_S)
    return actions.shape[0] * ENVIRONMENTS / (time.perf_counter() - start)


main()
