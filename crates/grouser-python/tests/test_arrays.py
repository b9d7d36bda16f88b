"""What is masked or named in the arrays that are given counts, or is refused: never dropped."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray

import grouser as gr

#: Ten in the middle is masked.
MASKED = np.ma.masked_values([5.0, 10.0, 15.0], 10.0)


def settle(**inputs: Any) -> gr.Settled:
    return gr.settle("toyoura", "hakuto", **{"load_n": 17.0, "slip_ratio": 0.2, **inputs})


def command(values: Any) -> Any:
    return gr.RunBatch([gr.Scenario()] * 3).step(values, 0.1)


#: Where arrays enter, each with the argument that has one.
ENTRIES: dict[str, Callable[[Any], Any]] = {
    "load_n": lambda it: settle(load_n=it),
    "sinkage_mm": lambda it: gr.wheel_forces("toyoura", "hakuto", sinkage_mm=it, slip_ratio=0.1),
    "slope_deg": lambda it: gr.rollout(slope_deg=it, duration_s=0.1),
    "yaw_deg": lambda it: gr.RunBatch([gr.Scenario()] * 3).reset(yaw_deg=it),
    "commands": lambda it: command(it / 100.0),
    "slope_deg of heading": lambda it: gr.heading(slope_deg=it),
    "slope_deg of wheel_speeds": lambda it: gr.wheel_speeds(slope_deg=it),
    "course_deg": lambda it: gr.heading_map(course_deg=it, slope_deg=[5.0]),
    "slip_angle_deg": lambda it: gr.wheel_test(load_n=17, slip_ratio=0.1, slip_angle_deg=it),
    "candidate_slip_ratio": lambda it: gr.calibrate(
        "none.csv", "toyoura", "hakuto", fit="cohesion_kpa", candidate_slip_ratio=it
    ),
}


@pytest.mark.parametrize("name", ENTRIES)
def test_masked_entries_are_refused(name: str) -> None:
    with pytest.raises(gr.ParameterError, match=r"has 1 masked entry, .*\.compressed\(\)") as error:
        ENTRIES[name](MASKED)
    assert error.value.name == name.split()[0]


def test_what_is_masked_is_found_in_lists_too() -> None:
    for values in ([MASKED, MASKED], [[5.0, np.ma.masked]], np.ma.masked):
        with pytest.raises(gr.ParameterError, match="masked"):
            settle(load_n=values)
    with pytest.raises(gr.ParameterError, match="masked"):
        settle(gravity_m_s2=np.ma.masked)
    batch = gr.RunBatch([gr.Scenario()] * 3)
    with pytest.raises(gr.ParameterError, match="mask has 1 masked entry"):
        batch.reset(mask=np.ma.array([True, True, False], mask=[False, True, False]))


def test_a_mask_that_hides_nothing_is_none() -> None:
    loads = np.array([5.0, 10.0])
    found = settle(load_n=np.ma.array(loads))
    assert found.sinkage_mm.tobytes() == settle(load_n=loads).sinkage_mm.tobytes()


LOADS = xarray.DataArray([5.0, 10.0, 15.0], dims="load", coords={"load": [1, 2, 3]})


def test_data_arrays_over_one_dimension_are_their_values() -> None:
    ratios = xarray.DataArray([0.1, 0.2, 0.3], dims="load", coords={"load": [1, 2, 3]})
    found = settle(load_n=LOADS, slip_ratio=ratios)
    plain = settle(load_n=LOADS.values, slip_ratio=ratios.values)
    assert found.drawbar_pull_n.tobytes() == plain.drawbar_pull_n.tobytes()
    assert gr.heading(slope_deg=LOADS, nominal=True).yaw_deg.shape == (3,)
    both = xarray.broadcast(LOADS, xarray.DataArray([0.1, 0.2], dims="ratio"))
    assert settle(load_n=both[0], slip_ratio=both[1]).shape == (3, 2)


@pytest.mark.parametrize("shape", [(3,), (1, 3)])
def test_data_arrays_over_other_dimensions_are_refused(shape: tuple[int, ...]) -> None:
    """Three by three or three by one at their names' word; NumPy would make it three."""
    ratios = xarray.DataArray(np.full(shape, 0.2), dims=["stand", "ratio"][-len(shape) :])
    for call in (
        lambda: settle(load_n=LOADS, slip_ratio=ratios),
        lambda: gr.rollout(slope_deg=LOADS, yaw_deg=ratios, duration_s=0.1),
    ):
        with pytest.raises(gr.ParameterError, match=r"over load, .*ratio: .*\.values"):
            call()


def test_data_arrays_with_other_coordinates_are_refused() -> None:
    other = LOADS.assign_coords(load=[3, 2, 1])
    with pytest.raises(gr.ParameterError, match="different coordinates along load"):
        settle(load_n=LOADS, slip_ratio=other / 100)


def test_axes_with_a_documented_order_take_no_names() -> None:
    speeds = xarray.DataArray(np.full((4, 3), 0.5), dims=["wheel", "rover"])
    with pytest.raises(gr.ParameterError, match=r"DataArray over wheel × rover, .* \.values"):
        command(speeds)
    assert command(speeds.values.T).shape == (3, 6)


# ---- units ----

#: Names that once had another unit or none beside the library's.
UNITS = {
    "yaw_rate_deg_s": "°/s",
    "drift_m_per_m": "m/m",
    "longitudinal_per_rad_m": "m/rad",
    "density_kg_m3": "kg/m³",
    "energy_j_per_m": "J/m",
    "yaw_deg_p97_5": "°",
    "slip_ratio": "1",
}


def test_a_name_has_one_unit() -> None:
    """In xarray and Arrow that of a campaign's columns, which is the library's."""
    from grouser import _tables

    assert {name: _tables.unit_of(name) for name in UNITS} == UNITS
    run = gr.simulate(duration_s=0.2)
    data, table = run.to_xarray(), run.to_arrow()
    assert data["yaw_rate_deg_s"].units == "°/s"
    assert table.field("yaw_rate_deg_s").metadata[b"units"].decode() == "°/s"
    study = gr.Campaign(
        {
            "study": "traverse",
            "runs": 10,
            "scenario": {"soil": "toyoura"},
            "parameter": [
                {"key": f"soil.{key}", "distribution": "normal", "standard_deviation": 1e-6}
                for key in ("density_kg_m3", "shear.longitudinal_per_rad_m")
            ],
        }
    )
    assert {"drift_m_per_m", "soil.density_kg_m3"} <= study.units.keys()
    for name, unit in study.units.items():
        assert unit is None or _tables.unit_of(name) == unit, name


def test_labels_have_the_words_and_the_unit() -> None:
    from grouser._tables import label

    assert label("drawbar_pull_n") == "drawbar pull [N]"
    assert label("energy_j_per_m") == "energy [J/m]"
    assert label("yaw_rate_deg_s") == "yaw rate [°/s]"
    assert label("slip_ratio") == "slip ratio"


# ---- messages ----


def test_messages_name_no_flags_of_the_program() -> None:
    """No text of the package has a flag but docstrings, and the package's own command."""
    package = Path(gr.__file__).parent
    for path in package.rglob("*.py"):
        if path.name == "__main__.py":
            continue
        tree = ast.parse(path.read_text(encoding="utf-8"))
        docstrings = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
        for node in ast.walk(tree):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                flags = re.findall(r"(?<!-)--[a-z][a-z-]*", node.value)
                assert not flags or id(node) in docstrings, f"{path.name}:{node.lineno}: {flags}"


def test_series_with_other_indexes_are_refused() -> None:
    pandas = pytest.importorskip("pandas")
    loads = pandas.Series([17.0, 10.0], index=[1, 0])
    slips = pandas.Series([0.1, 0.2], index=[0, 1])
    with pytest.raises(gr.ParameterError, match="Series with different indexes"):
        settle(load_n=loads, slip_ratio=slips)
    same = settle(load_n=loads.sort_index(), slip_ratio=slips)
    assert np.array_equal(same.sinkage_mm, settle(load_n=[10.0, 17.0], slip_ratio=[0.1, 0.2]).sinkage_mm)


def test_a_masked_action_is_refused() -> None:
    gymnasium = pytest.importorskip("gymnasium")
    pytest.importorskip("grouser.gym")
    environment = gymnasium.make("grouser/LevelTraverse-v0")
    environment.reset(seed=1)
    action = np.ma.masked_array([0.1, 0.2], [False, True])
    with pytest.raises(gr.ParameterError, match="masked"):
        environment.unwrapped.step(action)
