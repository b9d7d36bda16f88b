"""Results are Arrow tables: the rows of their pandas tables, with units."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pandas
import pyarrow
import pytest

import grouser as gr

DATA = Path(__file__).resolve().parents[2] / "grouser" / "data" / "experiments"
READINGS = DATA / "simulated-wheel-test" / "toyoura-20n.csv"


def results() -> list[Any]:
    """One of each, with what can be missing: a wheel that sinks, a slope without a heading offset, a run
    that ends before its time."""
    return [
        gr.simulate(duration_s=1.0),
        gr.simulate(slope_deg=40.0),
        gr.rollout([gr.Scenario(duration_s=0.5), gr.Scenario(slope_deg=40.0)]),
        gr.rollout(slope_deg=[[5.0], [6.0]], yaw_deg=[0.0, 1.0], duration_s=0.5),
        gr.heading(slope_deg=[5.0, 30.0], nominal=True),
        gr.heading_map(soil=["toyoura", "lunar-nominal"], slope_deg=[0, 30], course_deg=[0, 20]),
        gr.wheel_speeds(slope_deg=[5.0, 30.0]),
        gr.wheel_speeds(slope_deg=[]).limits,
        gr.wheel_test(load_n=[10, 1e5], slip_ratio=[0.0, 0.2]),
        gr.wheel_test(load_n=[10, 1e5], slip_ratio=[0.0, 0.2], trials=2),
        gr.heading(soil="toyoura-uncertain", slope_deg=[5.0, 40.0], samples=5),
        gr.calibrate(READINGS, "toyoura", "hakuto", fit="shear.longitudinal_m", point_fit=True),
        gr.settle("toyoura", "hakuto", load_n=[[10.0], [1e5]], slip_ratio=[0.1, 0.2, 0.3]),
        gr.wheel_forces("toyoura", "hakuto", sinkage_mm=10.0, slip_ratio=0.2),
        gr.validate(READINGS, "toyoura", "hakuto", where="slip_angle_deg=0"),
    ]


@pytest.mark.parametrize("result", results(), ids=lambda result: type(result).__name__)
def test_the_arrow_table_is_the_pandas_table(result: Any) -> None:
    table, frame = pyarrow.table(result), result.to_pandas()
    assert table.column_names == list(frame.columns) and table.num_rows == len(frame)
    for name in table.column_names:
        expected = [None if pandas.isna(cell) else cell for cell in frame[name]]
        assert table[name].to_pylist() == expected, name
    assert result.to_arrow().equals(table, check_metadata=True)


def test_units_stand_in_the_fields_metadata() -> None:
    run = gr.simulate(duration_s=0.5)
    schema = run.to_arrow().schema
    units = {name: (schema.field(name).metadata or {}).get(b"units") for name in schema.names}
    assert units["yaw_deg"] == "°".encode() and units["front-left.sinkage_mm"] == b"mm"
    assert units["rear-left.slip_ratio"] == b"1"
    assert [name for name, unit in units.items() if unit is None] == ["flags"], "texts have none"
    assert schema.metadata[b"outcome"] == b"completed"
    assert gr.Scenario.from_toml(schema.metadata[b"scenario"].decode()) == run.scenario
    fit = gr.calibrate(READINGS, "toyoura", "hakuto", fit="cohesion_kpa", point_fit=True).to_arrow()
    assert fit.schema.field("fit").metadata is None, "its unit is the key's"
    assert fit.schema.field("posterior_contraction").metadata == {b"units": b"1"}
    level = gr.heading(slope_deg=[5.0], samples=2).to_arrow().schema
    for name in ("status", "verdict"):
        texts = level.field(name)
        assert texts.type == pyarrow.string() and texts.metadata is None
    for name in ("yaw_deg_p97_5", "yaw_deg_as_written", "yaw_deg_rft"):
        assert level.field(name).metadata == {b"units": "°".encode()}


def test_a_stream_can_be_left_unread() -> None:
    """A capsule that is never read frees its content; one that was read is empty."""
    result = gr.settle("toyoura", "hakuto", load_n=np.full(1000, 10.0), slip_ratio=0.1)
    for _ in range(50):
        result.__arrow_c_stream__()
    reader = pyarrow.RecordBatchReader.from_stream(result)
    assert reader.read_all().num_rows == 1000


def test_an_empty_result_is_an_empty_table() -> None:
    assert gr.rollout([]).to_arrow().num_rows == 0
    assert gr.wheel_speeds(slope_deg=[]).to_arrow().num_rows == 0
    assert gr.heading(slope_deg=[]).to_arrow().column_names[0] == "slope_deg"
