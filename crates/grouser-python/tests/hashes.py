"""Prints the digests of `hashes tables` in crates/grouser-c/examples, as another interface has them.

``hashes.py package`` asks the Python package, ``hashes.py program GROUSER`` the program, by its JSON,
and ``hashes.py fmu GROUSER`` an FMU of the program, by FMPy. `cargo xtask hashes` compares them.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

LOADS_N = [2.5 * k for k in range(1, 11)]
SLIP_ANGLES_DEG = [2.5 * k for k in range(-12, 13)]
SLIP_RATIOS = [0.03125 * k for k in range(-20, 20)]
#: Rows of the card up to 20°, on samples of an uncertain soil.
STEEPEST_DEG, SOIL, SAMPLES, SEED = 20, "toyoura-uncertain", 12, 4


def digest(column: np.ndarray) -> int:
    """FNV-1a over the bytes of doubles, with the one NaN where there is no number."""
    found = 0xCBF29CE484222325
    for byte in np.where(np.isnan(column), np.nan, column).astype("<f8").tobytes():
        found = (found ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return found


def show(answer: str, columns: Mapping[str, Any]) -> None:
    """A line for each column that has a number."""
    for name, column in columns.items():
        values = np.asarray(column, dtype=object).ravel()
        if any(isinstance(value, str | list | dict) for value in values):
            continue
        numbers = np.array([np.nan if it is None else it for it in values], dtype=np.float64)
        if not np.isnan(numbers).all():
            print(f"{answer}.{name} {digest(numbers):016x}")


def columns_of(rows: Iterable[Mapping[str, Any]]) -> dict[str, list[Any]]:
    """Rows of the program as columns: those of a wheel start with its name."""
    columns: dict[str, list[Any]] = {}
    for row in rows:
        named = dict(row)
        for wheel in named.pop("wheels", []):
            named |= {f"{wheel['wheel']}.{name}": it for name, it in wheel.items() if name != "wheel"}
        for name, value in named.items():
            columns.setdefault(name, []).append(value)
    return columns


def to_steepest(columns: Mapping[str, Any]) -> dict[str, Any]:
    """The rows of slopes that all interfaces are asked for."""
    kept = np.asarray(columns["slope_deg"], dtype=np.float64) <= STEEPEST_DEG
    return {name: np.asarray(column, dtype=object)[kept] for name, column in columns.items()}


def package(_: str) -> None:
    """The arrays of the Python package."""
    import grouser as gr

    test = gr.wheel_test(
        "toyoura", "hakuto", load_n=LOADS_N, slip_angle_deg=SLIP_ANGLES_DEG, slip_ratio=SLIP_RATIOS
    )
    show("wheel-test", test.to_pandas())
    show("traverse", gr.simulate(name="traverse").to_pandas())
    show("mission", gr.mission("there-and-back").legs.to_pandas())
    card = gr.card(soil=SOIL, samples=SAMPLES, seed=SEED, slope_deg=range(STEEPEST_DEG + 1))
    show("card", card.columns)
    show("courses", card.courses.columns)


def program(path: str) -> None:
    """The JSON of the program."""

    def asked(*arguments: str) -> Any:
        done = subprocess.run([path, *arguments, "--format", "json"], capture_output=True, check=True)
        return json.loads(done.stdout)

    def values(numbers: list[float]) -> str:
        return ",".join(map(repr, numbers))

    test = asked(
        "wheel-test", "--soil", "toyoura", "--wheel", "hakuto", f"--load-n={values(LOADS_N)}",
        f"--slip-angle-deg={values(SLIP_ANGLES_DEG)}", f"--slip-ratio={values(SLIP_RATIOS)}",
    )  # fmt: skip
    show("wheel-test", columns_of(test["rows"]))
    show("traverse", columns_of(asked("traverse")["samples"]))
    show("mission", columns_of(asked("mission", "there-and-back", "--nominal")["legs"]))
    card = asked("card", "--soil", SOIL, "--samples", str(SAMPLES), "--seed", str(SEED))
    for name, rows in [("card", "rows"), ("courses", "courses")]:
        show(name, to_steepest(columns_of(card[rows])))


def fmu(path: str) -> None:
    """The outputs of an FMU of the default scenario, which drives itself, at each tenth of a second."""
    import fmpy

    with tempfile.TemporaryDirectory() as folder:
        scenario, made = Path(folder, "scenario.toml"), Path(folder, "rover.fmu")
        scenario.write_text('schema = "scenario/1"\nname = "traverse"\n')
        command = [path, "export-fmu", str(scenario), "--driven-by", "document", "--out", str(made)]
        subprocess.run(command, capture_output=True, check=True)
        variables = fmpy.read_model_description(str(made)).modelVariables
        numbers = [it for it in variables if it.type == "Float64"]
        outputs = [it.name for it in numbers if it.causality == "output"]
        found = fmpy.simulate_fmu(
            str(made), stop_time=20.0, step_size=0.1, output_interval=0.1, output=outputs
        )
    show("traverse", {"time_s": found["time"]} | {name: found[name] for name in outputs})


if __name__ == "__main__":
    {"package": package, "program": program, "fmu": fmu}[sys.argv[1]](*sys.argv[2:])
