"""Measured rows as tables are those of files, with the same checks and messages; imports and checks
are the program's."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import pyarrow
import pytest

import grouser as gr

from conftest import Program


@pytest.fixture(scope="module")
def test() -> gr.SimulatedWheelTest:
    return gr.wheel_test(load_n=[15, 25], slip_ratio=[0.0, 0.2, 0.4], slip_angle_deg=[0, 15], trials=2)


def tables(frame: pandas.DataFrame) -> dict[str, Any]:
    """One table in every shape that is taken."""
    return {
        "DataFrame": frame,
        "Table": pyarrow.Table.from_pandas(frame),
        "dict": {name: frame[name].to_numpy() for name in frame.columns},
    }


class Stream:
    """Whatever has Arrow's C interface and nothing else."""

    def __init__(self, table: pyarrow.Table) -> None:
        self.table = table

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        return self.table.__arrow_c_stream__(requested_schema)


def test_a_table_is_validated_as_its_file(test: gr.SimulatedWheelTest, tmp_path: Path) -> None:
    frame = test.to_pandas()
    file = tmp_path / "test.csv"
    frame.to_csv(file, index=False)
    there = gr.validate(file, "toyoura", "hakuto", model="bekker")
    shapes = {**tables(frame), "stream": Stream(pyarrow.table(test)), "result": test}
    for name, table in shapes.items():
        here = gr.validate(table, "toyoura", "hakuto", model="bekker")
        assert here.overall == there.overall and here.notes == there.notes, name
        assert here.to_pandas().equals(there.to_pandas()), name


def test_a_table_is_calibrated_as_its_file(test: gr.SimulatedWheelTest, tmp_path: Path) -> None:
    frame = test.to_pandas()
    file = tmp_path / "DataFrame"
    frame.to_csv(file, index=False)
    start = gr.Soil("toyoura", shear={"longitudinal_m": 0.1})
    there, here = (
        gr.calibrate(data, start, "hakuto", fit="shear.longitudinal_m", point_fit=True)
        for data in (file, frame)
    )
    assert here.fit.tobytes() == there.fit.tobytes() and here.soil == there.soil
    plates = {"plate_width_mm": [50.0] * 4 + [100.0] * 4, "sinkage_mm": [5.0, 10.0, 15.0, 20.0] * 2}
    plates["pressure_kpa"] = [2.0, 6.5, 13.0, 21.0, 2.1, 6.8, 13.5, 22.0]
    file = tmp_path / "plates.csv"
    pandas.DataFrame(plates).to_csv(file, index=False)
    there, here = (gr.calibrate_plates(data, "toyoura", point_fit=True) for data in (file, plates))
    assert here.fit.tobytes() == there.fit.tobytes() and len(here.fit) >= 1


def test_slopes_are_validated_from_a_table(tmp_path: Path) -> None:
    slopes = pandas.DataFrame({"slope_deg": [5.0, 10.0], "course_deg": [0.0, 0.0], "yaw_deg": [1.9, 4.3]})
    file = tmp_path / "slopes.csv"
    slopes.to_csv(file, index=False)
    there, here = (gr.validate_slopes(data, "toyoura", "hakuto") for data in (file, slopes))
    assert here.overall == there.overall and here.overall["yaw_deg"] is not None


@pytest.mark.parametrize(
    "change",
    [
        lambda frame: frame.drop(columns="load_n"),
        lambda frame: frame.assign(load_n=-1.0),
        lambda frame: frame.assign(slip_ratio="much"),
        lambda frame: frame.assign(slip_ratio=[np.nan] + [0.1] * (len(frame) - 1)),
        lambda frame: frame.drop(columns=["drawbar_pull_n", "side_force_n", "sinkage_mm", "torque_nm"]),
        lambda frame: frame.iloc[:0],
        lambda frame: frame.assign(status="stuck"),
    ],
)
def test_faults_of_a_table_have_the_messages_of_a_file(
    test: gr.SimulatedWheelTest, tmp_path: Path, change: Any
) -> None:
    frame = change(test.to_pandas())
    file = tmp_path / "test.csv"
    frame.to_csv(file, index=False)
    with pytest.raises(gr.DocumentError) as there:
        gr.validate(file, "toyoura", "hakuto")
    with pytest.raises(gr.DocumentError) as here:
        gr.validate(frame, "toyoura", "hakuto")
    assert str(here.value) == str(there.value).replace(str(file), "DataFrame")
    assert (here.value.line, here.value.key) == (there.value.line, there.value.key)


def test_what_is_no_table_is_refused() -> None:
    for data, message in [
        (3, "data is of type int"),
        ({"load_n": [1.0, 2.0], "slip_ratio": [0.1]}, "load_n 2, slip_ratio 1"),
    ]:
        with pytest.raises(gr.ParameterError, match=message):
            gr.validate(data, "toyoura", "hakuto")


# ---- imports ----

THEIRS = "a header line\nFz;Fy;Fx;s;note\n0,017;-1,5;1,9;20;ok\n0,017;;4,2;-50;=1+1\n"
COLUMNS = {"load_n": "Fz:kN", "side_force_n": "-Fy", "drawbar_pull_n": "Fx", "slip_ratio": "s:%"}


def test_an_import_is_the_programs(program: Program, tmp_path: Path) -> None:
    file = tmp_path / "theirs.csv"
    file.write_text(THEIRS)
    layout = {"delimiter": ";", "decimal_comma": True, "skip_lines": 1, "slip_definition": "rim"}
    found = gr.import_wheel_tests(file, COLUMNS, **layout)  # type: ignore[arg-type]
    columns = [part for ours, theirs in COLUMNS.items() for part in ("--column", f"{ours}={theirs}")]
    flags = ["--delimiter", ";", "--decimal-comma", "--skip-lines", "1", "--slip-definition", "rim"]
    finished = subprocess.run(
        [*program.command, "import", str(file), *columns, *flags],
        capture_output=True,
        text=True,
        check=True,
    )
    assert finished.stdout == found.text
    assert found.left_out == ("note",) and "note" in finished.stderr
    assert found.columns["side_force_n"][0] == 1.5 and np.isnan(found.columns["side_force_n"][1])
    assert found.columns["slip_ratio"].tolist() == [0.2, -0.5 / 1.5]
    assert gr.validate(found, "toyoura", "hakuto").overall["trials"] == 2
    assert found.to_arrow().num_rows == 2 and "2 rows" in repr(found)


@pytest.mark.parametrize(
    ("columns", "layout", "message"),
    [
        ({"load": "Fz"}, {}, "did you mean `load_n`|is not a column"),
        ({"load_n": "Fz:mm"}, {}, "'mm' is not a unit for `load_n`"),
        ({"load_n": "F"}, {"delimiter": ";"}, "F"),
        (["load_n"], {}, "mapping of our columns"),
        (COLUMNS, {"delimiter": "tab"}, "one character"),
        (COLUMNS, {"delimiter": "°"}, "one ASCII character"),
        (COLUMNS, {"slip_definition": "none"}, "larger, rim or hub"),
        (COLUMNS, {"skip_lines": -1}, "skip_lines is -1"),
    ],
)
def test_what_cannot_be_imported_is_named(
    columns: Any, layout: dict[str, Any], message: str, tmp_path: Path
) -> None:
    file = tmp_path / "theirs.csv"
    file.write_text(THEIRS)
    with pytest.raises((gr.ParameterError, gr.DocumentError), match=message):
        gr.import_wheel_tests(file, columns, **layout)
    with pytest.raises(gr.DocumentNotFoundError):
        gr.import_wheel_tests(tmp_path / "nowhere.csv", COLUMNS)


# ---- checks ----


def test_a_check_is_the_programs(program: Program, tmp_path: Path) -> None:
    file = tmp_path / "sand.toml"
    file.write_text(
        'schema = "soil/1"\nname = "mine"\nsource = "mine"\nfriction_angle_deg = 30.0\n'
        '[pressure_sinkage]\nlaw = "bekker"\nk_c = 1.4\nk_phi = 820.0\nn = 1.0\n'
        '[shear]\nlaw = "isotropic"\nlongitudinal_m = 0.02\n'
    )
    found = gr.check(file)
    lines = subprocess.run(
        [*program.command, "check", str(file)], capture_output=True, text=True, check=True
    ).stdout.splitlines()
    assert lines[0].endswith(f"a valid {found.kind} document")
    assert len(found.not_stated) == sum("not stated:" in line for line in lines) > 0
    for (key, value, prior), line in zip(found.not_stated, lines[1:]):
        assert f"not stated: {key}" in line and prior in line
        # The program prints four digits.
        assert value is None or float(line.split(" = ")[1].split(",")[0]) == pytest.approx(value, rel=1e-3)
    assert len(found.notes) == sum("note:" in line for line in lines) > 0
    assert gr.check(file.read_text()) == found
    assert gr.check(gr.Scenario().to_toml()).kind == "scenario"


def test_faults_have_their_place() -> None:
    with pytest.raises(gr.DocumentError, match="cohesion_kpa") as error:
        gr.check('schema = "soil/1"\ncohesion_kap = 1.0\n')
    assert error.value.line == 2 and error.value.file == "TOML"
    with pytest.raises(gr.DocumentNotFoundError):
        gr.check("nowhere.toml")


# ---- forecasts ----


def test_a_forecast_is_the_programs(program: Program) -> None:
    flags = ["--site", "moon", "--slope-deg", "5,15", "--samples", "2", "--discrepancies", "2"]
    masses = ["--mass", "equal-mass,flight=0.65", "--scaling", "reece,bekker"]
    answer = program("forecast", *flags, *masses, "--soil", "toyoura", "--model", "ishigami")
    found = gr.forecast(
        site="moon", slope_deg=[5, 15], samples=2, discrepancies=2, soil="toyoura", model="ishigami",
        mass=["equal-mass", "flight=0.65"], scaling=["reece", "bekker"],
    )  # fmt: skip
    for table, theirs in [(found.columns, answer["rows"]), (found.steepest, answer["steepest"]),
                          (found.budget, answer["budget"]), (found.choices, answer["choices"]), (found.tests, answer["tests"])]:
        assert len(theirs) > 0
        for place, row in enumerate(theirs):
            for name, value in row.items():
                ours = table[name][place]
                if isinstance(value, list):
                    assert ours == ";".join(value)
                else:
                    assert ours == value or value is None and (ours is None or np.isnan(ours)), name
    assert list(found.notes) == answer["notes"]
    axes, bands = found.plot(), ["as-measured", "lunar-nominal", "lunar-0-15-cm"]
    assert len(found.to_pandas()) == 2 * 2 * len(bands) and axes.get_xlabel() == "slope [°]"
    labels = axes.get_legend_handles_labels()[1]
    assert [f"95 %, {name}" in labels for name in bands] == [True] * len(bands)
    assert "lunar-nominal (bekker)" in labels
    named = gr.forecast(
        site=gr.MOON_GRAVITY, slope_deg=[5, 15], samples=2, discrepancies=2, soil="toyoura",
        model="ishigami", mass={"equal": 1.0}, scaling="reece", ground=[gr.Soil("lunar-nominal")],
    )  # fmt: skip
    assert set(named.choices["factor"].tolist()) <= set(found.choices["factor"].tolist())


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        ({"site": "pluto"}, "site"),
        ({"site": "moon", "gravity_m_s2": 1.0}, "gravity_m_s2"),
        ({"site": "moon", "scaling": "none"}, "scaling"),
        ({"site": "moon", "scaling": ["reece", "reece"]}, "scaling"),
        ({"site": "moon", "mass": "heavy"}, "mass"),
        ({"site": "moon", "mass": {"flight": -1.0}}, "mass"),
        ({"site": "moon", "samples": 1}, "samples"),
        ({"site": "moon", "discrepancies": 5000}, "discrepancies"),
        ({"site": "moon", "measured_gravity_m_s2": 0.0}, "measured_gravity_m_s2"),
        ({"site": "moon", "rim_speed_m_s": -1.0}, "rim_speed_m_s"),
        ({"site": "moon", "no_go_slip_ratio": 1.5}, "no_go_slip_ratio"),
        ({"site": "moon", "ground": ["as-measured", "as-measured"]}, "ground"),
    ],
)
def test_what_cannot_be_forecast_is_named(arguments: dict[str, Any], name: str) -> None:
    with pytest.raises(gr.ParameterError) as error:
        gr.forecast(**arguments)
    assert error.value.name == name
