"""What the tests of campaigns share: small studies, and the digest that everybody must find."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import grouser as gr

#: Twelve shards, the last of them shorter.
SHARDS = 12


def study(**changes: Any) -> gr.Campaign:
    """Traverses of a few seconds over soil and start that are known roughly."""
    keys: dict[str, Any] = {
        "name": "short traverses",
        "study": "traverse",
        "runs": 45,
        "shard_runs": 4,
        "sampling": "latin-hypercube",
        "scenario": {"soil": "toyoura", "slope_deg": 8.0, "duration_s": 2.0},
        "parameter": [
            {"key": "slope_deg", "distribution": "normal", "standard_deviation": 1.0},
            {
                "key": "soil.friction_angle_deg",
                "distribution": "uniform",
                "low": 35.0,
                "high": 40.0,
            },
        ],
    }
    return gr.Campaign({**keys, **changes})


def long_study() -> gr.Campaign:
    """The same over minutes: a shard takes so long that a worker can be killed in one."""
    return study(scenario={"soil": "toyoura", "slope_deg": 8.0, "duration_s": 120.0})


def wheel_study(**changes: Any) -> gr.Campaign:
    """Wheels on a test stand: thousands in a moment."""
    keys: dict[str, Any] = {
        "study": "wheel-test",
        "runs": 100,
        "shard_runs": 10,
        "wheel_test": {"soil": "toyoura", "wheel": "hakuto", "load_n": 17.0, "slip_ratio": 0.2},
        "parameter": [{"key": "load_n", "distribution": "normal", "standard_deviation": 1.0}],
    }
    return gr.Campaign({**keys, **changes})


class Killer:
    """Kills a worker with SIGKILL once some shards are there, while others are computed."""

    def __init__(self, pids: Callable[[], Iterable[int]], after: int = 2) -> None:
        self._pids, self._after = pids, after
        self.killed: list[int] = []
        self.lost = 0

    def __call__(self, now: gr.campaign.Progress) -> None:
        self.lost = now.lost
        if self.killed or now.shards_done < self._after:
            return
        # None while no worker computes: then after the next shard.
        for pid in self._pids():
            os.kill(pid, signal.SIGKILL)
            self.killed.append(pid)
            return


def files_of(folder: Path) -> dict[str, bytes]:
    """The shards in a folder."""
    return {path.name: path.read_bytes() for path in sorted((folder / "runs").iterdir())}
