"""Ctrl-C ends every long call: each runs in a process of its own, which would go on for minutes."""

from __future__ import annotations

import signal
import subprocess
import sys
import time

import pytest

#: What is done before a call, and the call.
CALLS = {
    "simulate": ("", "gr.simulate(duration_s=86400, drive={'law': 'eq18'}, sample_interval_s=0.1)"),
    "rollout": ("", "gr.rollout(duration_s=np.full(20_000, 2000.0))"),
    "heading": ("", "gr.heading(slope_deg=np.linspace(0, 20, 5_000_000), nominal=True)"),
    "heading, uncertain": (
        "",
        "gr.heading(soil='toyoura-uncertain', slope_deg=10, samples=100_000)",
    ),
    "design": (
        "",
        "gr.design('design-climbing-wheels', trade=('energy_j_per_m', 'wheel_mass_kg'))",
    ),
    "wheel_speeds": ("", "gr.wheel_speeds(slope_deg=np.linspace(0, 20, 5_000_000))"),
    "heading_map": ("", "gr.heading_map(course_deg=np.linspace(-60, 60, 200_000))"),
    "heading, vary": (
        "",
        "gr.heading(vary={'soil.cohesion_kpa': np.linspace(0, 1, 200_000)}, nominal=True)",
    ),
    "mission, vary": ("", "gr.mission('slip-check', vary={'slope_deg': np.linspace(0, 9, 20_000)})"),
    "card, vary": ("", "gr.card(slope_deg=[5.0], vary={'gravity_m_s2': np.linspace(2, 9, 2000)})"),
    "settle": ("", "gr.settle('toyoura', 'hakuto', load_n=np.full(4_000_000, 17.0), slip_ratio=0.2, model='rft')"),
    "settle, gradients": ("", "gr.settle('toyoura', 'hakuto', load_n=np.full(2_000_000, 17.0), slip_ratio=0.2, gradients='all')"),
    "simulate, gradients": ("", "gr.simulate(duration_s=2000, gradients='all')"),
    "heading, gradients": ("", "gr.heading(slope_deg=np.linspace(1, 15, 1_000_000), gradients='all')"),
    "calibrate": (
        "gr.wheel_test(load_n=20, slip_ratio=[0.1, 0.3, 0.5], trials=3).to_pandas()"
        ".to_csv('test.csv', index=False)",
        "gr.calibrate('test.csv', 'toyoura', 'hakuto', fit='shear.longitudinal_m', steps=999_999)",
    ),
}  # fmt: skip

#: How long a call may go on after Ctrl-C before it counts as not heard [s]; it is heard at once, but
#: the machine may have other work.
PATIENCE = 20.0


@pytest.mark.parametrize("name", CALLS)
def test_ctrl_c_ends(name: str, tmp_path: object) -> None:
    before, call = CALLS[name]
    script = (
        "import numpy as np, grouser as gr\n"
        f"{before}\n"
        "print('ready', flush=True)\n"
        f"{call}\n"
        "print('it came to its end')\n"
    )
    child = subprocess.Popen(
        [sys.executable, "-c", script],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=str(tmp_path),
    )
    assert child.stdout is not None
    try:
        assert child.stdout.readline() == "ready\n"
        # Long enough to be in the middle of the call.
        time.sleep(1.0)
        assert child.poll() is None
        start = time.monotonic()
        child.send_signal(signal.SIGINT)
        out, err = child.communicate(timeout=PATIENCE)
        print(f"{name}: {time.monotonic() - start:.2f} s from Ctrl-C to the end of the process")
    finally:
        child.kill()
    assert "KeyboardInterrupt" in err and out == "", err
