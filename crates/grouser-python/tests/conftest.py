"""What the tests share. They run against the installed package, as its users have it."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib
import pytest

matplotlib.use("Agg")

Program = Callable[..., dict[str, Any]]


@pytest.fixture(scope="session")
def program() -> Program:
    """The program `grouser`: arguments in, its JSON out."""
    target = Path(__file__).resolve().parents[3] / "target"
    built = [target / profile / "grouser" for profile in ("release", "debug")]
    named = os.environ.get("GROUSER_PROGRAM")
    path = Path(named) if named else next((path for path in built if path.exists()), built[0])

    def run(*arguments: str) -> dict[str, Any]:
        command = [str(path), *arguments, "--format", "json"]
        told = subprocess.run(command, capture_output=True, text=True, check=True)
        answer: dict[str, Any] = json.loads(told.stdout)
        return answer

    return run
