"""Mobility maps of heights in memory."""

from __future__ import annotations

import numpy as np
import pytest

import grouser as gr

xarray = pytest.importorskip("xarray")


def plane(slope_deg: float, rises_deg: float, gap: bool = False) -> gr.Terrain:
    x, y = np.arange(12) * 0.5, np.arange(9)[:, None] * 0.5
    toward = np.radians(rises_deg)
    heights = np.tan(np.radians(slope_deg)) * (x * np.cos(toward) + y * np.sin(toward))
    if gap:
        heights[2, 3] = np.nan
    return gr.Terrain(heights, cell_size_m=0.5, south_west_m=(300.0, -40.0), rows="south-first")


@pytest.mark.parametrize("rises_deg", [0.0, 90.0, 215.0])
def test_a_plane_has_the_numbers_of_the_heading_map(rises_deg: float) -> None:
    found = gr.map(plane(9.0, rises_deg), course_deg=20.0, model="ishigami", samples=3)
    row = gr.heading_map(slope_deg=[9.0], course_deg=[20.0], model="ishigami")
    for name in ("slip_ratio", "power_w", "sinkage_mm"):
        expected = getattr(row, name)[0, 0, 0]
        error = found.attrs[f"interpolation_error_{name}"] + 1e-5 * abs(expected) + 1e-6
        np.testing.assert_allclose(found[name], expected, rtol=0, atol=error)
    yaw = np.radians(row.yaw_deg[0, 0, 0])
    on_map = np.degrees(np.arctan2(np.sin(yaw) * np.cos(np.radians(9.0)), np.cos(yaw)))
    apart = (found.heading_deg - (on_map + rises_deg - 90.0) + 180.0) % 360.0 - 180.0
    assert float(abs(apart).max()) < found.attrs["interpolation_error_heading_deg"] + 0.01


def test_each_whole_degree_of_a_map_has_advice() -> None:
    asked = {"soil": "toyoura-uncertain", "samples": 4}
    found = gr.map(plane(5.5, 30.0), **asked)
    slopes = found.advice_slope_deg.values
    np.testing.assert_allclose(slopes, np.arange(len(slopes)), atol=1e-9)
    # A place has the advice for the whole degree above its slope: all of a plane the last.
    assert 0.0 <= slopes[-1] - float(found.slope_deg.max()) < 1.0
    numbers = {1: "go", 2: "caution", 3: "no_go", 4: "cannot_tell"}
    verdicts = {numbers[int(it)] for it in found.verdict.values.flat}
    assert verdicts == {found.advice_verdict.values[-1]}
    texts, yaws = ("verdict", "reason"), ("yaw_deg", "yaw_deg_p2_5", "yaw_deg_p97_5")
    for name in (*texts, *yaws, "probability_stuck", "course_deg"):
        variable = found[f"advice_{name}"]
        assert variable.dims == ("advice_slope_deg",)
        assert variable.attrs["long_name"] and variable.attrs["units"]
    assert found.advice_yaw_deg.attrs["units"] == found.advice_slope_deg.attrs["units"] == "°"
    assert "advice" not in found.attrs and not found.advice_course_deg.values.any()
    level = gr.heading(slope_deg=[5.0], **asked)
    assert level.verdict is not None and level.reason is not None
    assert found.advice_verdict.values[5] == level.verdict[0]
    assert found.advice_reason.values[5] == level.reason[0]
    np.testing.assert_allclose(found.advice_yaw_deg[5], level.yaw_deg[0], rtol=1e-6)


def test_a_soil_without_stated_uncertainty_leaves_a_map_open() -> None:
    found = gr.map(plane(5.0, 30.0), soil="toyoura", samples=4)
    assert set(found.advice_verdict.values) == {"cannot_tell"} and (found.verdict == 4.0).all()
    assert set(found.advice_reason.values) == {"no_stated_uncertainty"}


def test_a_map_has_coordinates_units_and_gaps() -> None:
    found = gr.map(plane(5.0, 30.0, gap=True), soil="toyoura-uncertain", samples=4)
    assert isinstance(found, xarray.Dataset) and found.slip_ratio.sizes == {"y": 9, "x": 12}
    assert found.x.values[[0, -1]].tolist() == [300.0, 305.5]
    assert found.y.values[[0, -1]].tolist() == [-36.0, -40.0]
    assert found.heading_deg.attrs["units"] == "°" and found.power_w.attrs["long_name"]
    gone = found.slope_deg.isnull()
    assert int(gone.sum()) == 1 and bool(gone.sel(x=301.5, y=-39.0))
    assert int(found.verdict.isnull().sum()) == 1 and float(found.verdict.min()) == 1.0
    assert found.attrs["samples"] == 4 and found.attrs["limit_slope_deg"] > 10.0


def test_the_best_course_slips_no_more_than_another() -> None:
    ground = plane(12.0, 75.0)
    best = gr.map(ground, course_deg="best", model="ishigami", samples=2)
    uphill = gr.map(ground, course_deg=45.0, model="ishigami", samples=2)
    assert float(abs(best.slip_ratio).max()) < float(uphill.slip_ratio.min())
    assert "course_deg" in best and "course_deg" not in uphill


def test_what_is_no_map_is_said() -> None:
    ground = plane(5.0, 0.0)
    with pytest.raises(gr.ParameterError, match="terrain is ndarray, it must be a Terrain"):
        gr.map(np.zeros((4, 4)))  # type: ignore[arg-type]
    with pytest.raises(gr.ParameterError, match="an angle, 'best' or 'worst'"):
        gr.map(ground, course_deg="up")  # type: ignore[arg-type]
    for bad in ({"course_deg": 91.0}, {"samples": 1}, {"rim_speed_m_s": 0.0}, {"seed": -1}):
        with pytest.raises(gr.ParameterError, match=next(iter(bad))):
            gr.map(ground, **bad)  # type: ignore[arg-type]
