"""A process that is forked computes as its parent does. The parent's threads are not in it.

Each test is a script in a process of its own, because forking a process with threads, as pytest's may
be, is warned of since Python 3.12.
"""

from __future__ import annotations

import multiprocessing
import subprocess
import sys
import textwrap

import pytest

pytestmark = pytest.mark.skipif(
    "fork" not in multiprocessing.get_all_start_methods(), reason="this system cannot fork"
)

#: How long a script may take [s]: some seconds, on a machine that may have other work.
PATIENCE = 120.0

#: What is computed, as an expression that ends with bytes or text: with work enough to be shared
#: among threads.
CALLS = {
    "settle": "gr.settle('toyoura', 'hakuto', load_n=np.linspace(5, 30, 2000), slip_ratio=0.2)"
    ".sinkage_mm.tobytes()",
    "rollout": "gr.rollout(slope_deg=np.linspace(0, 15, 12), duration_s=1.0).y_m.tobytes()",
    "step by step": "gr.RunBatch([gr.Scenario()] * 70).step(0.6, 0.2).tobytes()",
    "heading map": "gr.heading_map(course_deg=[0, 15], slope_deg=[5, 10]).yaw_deg.tobytes()",
    "campaign": "campaign()",
}

BEGINNING = """
import multiprocessing, os, signal, sys, tempfile, threading, time
import numpy as np
import grouser as gr

def campaign():
    study = gr.Campaign({
        "study": "wheel-test", "runs": 400, "shard_runs": 100,
        "wheel_test": {"soil": "toyoura", "wheel": "hakuto", "load_n": 17.0, "slip_ratio": 0.2},
        "parameter": [{"key": "load_n", "distribution": "normal", "standard_deviation": 1.0}],
    })
    with tempfile.TemporaryDirectory() as folder:
        return gr.campaign.run(study, out=folder + "/out").digest
"""


def run_script(script: str) -> str:
    """What a script prints, within some time."""
    command = [sys.executable, "-W", "ignore::DeprecationWarning", "-c", script]
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("name", CALLS)
def test_a_forked_child_computes_what_its_parent_did(name: str) -> None:
    """Twice in a row and two at once, and in the parent again afterwards."""
    script = f"""
    def compute(_=None):
        return {CALLS[name]}

    first = compute()
    with multiprocessing.get_context("fork").Pool(2) as pool:
        for _ in range(2):
            assert pool.map(compute, range(2)) == [first] * 2
    assert compute() == first
    print("alike")
    """
    assert run_script(BEGINNING + textwrap.dedent(script)) == "alike\n"


def test_a_grandchild_computes_too() -> None:
    script = f"""
    def compute():
        return {CALLS["settle"]}

    first = compute()

    def child(depth):
        assert compute() == first
        if depth > 0:
            process = multiprocessing.get_context("fork").Process(target=child, args=(depth - 1,))
            process.start()
            process.join()
            assert process.exitcode == 0

    child(2)
    print("alike")
    """
    assert run_script(BEGINNING + textwrap.dedent(script)) == "alike\n"


def test_ctrl_c_is_heard_in_a_forked_child() -> None:
    script = """
    gr.rollout(slope_deg=np.linspace(0, 15, 12), duration_s=1.0)
    signal.signal(signal.SIGINT, signal.default_int_handler)

    def child(ready):
        ready.set()
        try:
            gr.rollout(duration_s=np.full(20_000, 2000.0))
        except KeyboardInterrupt:
            # The work goes on in threads that the interpreter would not wait for either.
            os._exit(3)

    fork = multiprocessing.get_context("fork")
    ready = fork.Event()
    process = fork.Process(target=child, args=(ready,))
    process.start()
    ready.wait()
    time.sleep(0.5)
    os.kill(process.pid, signal.SIGINT)
    process.join()
    print(process.exitcode)
    """
    assert run_script(BEGINNING + textwrap.dedent(script)) == "3\n"
