"""Python and the program give the same bits for the same documents."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from conftest import Program

import grouser as gr

DATA = Path(__file__).resolve().parents[3] / "data" / "experiments"


def same(column: Any, rows: list[dict[str, Any]], name: str) -> bool:
    """Bit for bit, with null where Python has NaN."""
    told = np.array([np.nan if row[name] is None else row[name] for row in rows], dtype=np.float64)
    return np.asarray(column, dtype=np.float64).tobytes() == told.tobytes()


def test_wheel_test(program: Program) -> None:
    for soil, wheel in [("toyoura", "hakuto"), ("cmu-direct90-smooth", "cmu-smooth")]:
        rows = program(
            "wheel-test", "--soil", soil, "--wheel", wheel, "--load-n", "10,17,60000",
            "--slip-angle-deg", "0,15,30", "--slip-ratio", "0:0.9:0.1",
        )["rows"]  # fmt: skip
        ratios = [row["slip_ratio"] for row in rows[:10]]
        test = gr.wheel_test(
            soil, wheel, load_n=[10, 17, 60000], slip_angle_deg=[0, 15, 30], slip_ratio=ratios
        )
        table = test.to_pandas()
        assert table.status.tolist() == [row["status"] for row in rows]
        for name in rows[0].keys() - {"status"}:
            assert same(table[name], rows, name), name


def test_traverse(program: Program) -> None:
    told = program("traverse", "--slope-deg", "12", "--yaw-deg", "3.5", "--duration-s", "5")
    run = gr.simulate(name="traverse", slope_deg=12, start={"yaw_deg": 3.5}, duration_s=5)
    assert run.outcome == told["outcome"] and run.energy_error_j == told["energy_error_j"]
    samples = told["samples"]
    for name in samples[0].keys() - {"wheels"}:
        assert same(getattr(run, name), samples, name), name
    for k, wheel in enumerate(run.wheel_names):
        rows = [sample["wheels"][k] for sample in samples]
        assert rows[0].pop("wheel") == wheel
        for name in rows[0]:
            assert same(run.wheel[name][:, k], rows, name), name


def test_traverse_of_a_file(program: Program, tmp_path: Any) -> None:
    path = tmp_path / "scenario.toml"
    run = gr.Scenario(soil=gr.Soil("lunar-nominal", cohesion_kpa=0.3), duration_s=3, slope_deg=7)
    path.write_text(run.to_toml())
    told = program("traverse", str(path))
    assert same(gr.simulate(run).y_m, told["samples"], "y_m")


def test_attitude(program: Program) -> None:
    told = program("attitude", "--slope-deg", "0:24:3")
    level = gr.attitude(slope_deg=np.arange(0, 25, 3))
    assert level.limit_slope_deg == told["limit_slope_deg"]
    assert level.status.tolist() == [row["status"] for row in told["rows"]]
    for name in told["rows"][0].keys() - {"status"}:
        assert same(getattr(level, name), told["rows"], name), name


def test_attitude_map(program: Program) -> None:
    rows = program("attitude-map", "--slope-deg", "0,10,30", "--course-deg", "-30,0,30")["rows"]
    table = gr.attitude_map(slope_deg=[0, 10, 30], course_deg=[-30, 0, 30]).to_pandas()
    assert table.status.tolist() == [row["status"] for row in rows]
    assert table.soil.tolist() == [row["soil"] for row in rows]
    for name in rows[0].keys() - {"status", "soil"}:
        assert same(table[name], rows, name), name


def test_validate(program: Program) -> None:
    data = str(DATA / "simulated-wheel-test" / "toyoura-20n.csv")
    told = program("validate", "--data", data, "--soil", "toyoura", "--wheel", "hakuto")
    found = gr.validate(data, "toyoura", "hakuto")
    assert found.overall == told["overall"] and found.driven == told["driven"]
    assert list(found.groups) == told["rows"]
    for name in told["cells"][0].keys() - {"motion"}:
        assert same(found.cells[name], told["cells"], name), name
