"""What Python costs: the same work asked from NumPy, and done by a program that has it at hand.

Both use all cores, in turns, so that other work on the machine slows both; the best time of each
counts. The program is the one argument.
"""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable

import numpy as np

import grouser as gr

ROUNDS = 5


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


def main() -> None:
    rng = np.random.default_rng(1)
    count = 1_000_000
    load, ratio, angle = (
        rng.uniform(low, high, count) for low, high in [(5.0, 40.0), (0.0, 0.9), (-20.0, 20.0)]
    )
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


main()
