"""What the tests share. They run against the installed package, as its users have it."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from ctypes.util import find_library
from pathlib import Path
from typing import Any

import matplotlib
import pytest

# A shell may start this in the background with Ctrl-C ignored, and children would inherit that.
signal.signal(signal.SIGINT, signal.default_int_handler)

matplotlib.use("Agg")

# Without a display MuJoCo renders through EGL; it chooses once, when whichever test imports it first.
if sys.platform == "linux" and not os.environ.get("DISPLAY"):
    os.environ.setdefault("MUJOCO_GL", "egl" if find_library("EGL") else "disable")


class Program:
    """The program `grouser`: arguments in, its JSON out."""

    def __init__(self, path: Path) -> None:
        self.command = [str(path)]

    def __call__(self, *arguments: str) -> dict[str, Any]:
        command = [*self.command, *arguments, "--format", "json"]
        finished = subprocess.run(command, capture_output=True, text=True, check=True)
        answer: dict[str, Any] = json.loads(finished.stdout)
        return answer


@pytest.fixture(scope="session")
def program() -> Program:
    """The program that was built with the package."""
    target = Path(__file__).resolve().parents[3] / "target"
    built = [target / profile / "grouser" for profile in ("release", "debug")]
    named = os.environ.get("GROUSER_PROGRAM")
    path = Path(named) if named else next((path for path in built if path.exists()), built[0])
    return Program(path)
