"""Routes over heights in memory."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import grouser as gr

xarray = pytest.importorskip("xarray")


def ground(height: object = None) -> gr.Terrain:
    """30 × 24 points, 0.5 m apart; level, or of a height over x and y."""
    x, y = np.arange(30) * 0.5, np.arange(24)[:, None] * 0.5
    heights = height(x, y) if callable(height) else 0.0 * x * y
    return gr.Terrain(heights, cell_size_m=0.5, south_west_m=(300.0, -40.0), rows="south-first")


def wall(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """6 m high, from side to side."""
    return 6.0 * np.clip((x - 6.0) / 2.0, 0.0, 1.0) + 0.0 * y


def test_over_level_ground_the_way_is_straight() -> None:
    way = gr.route(ground(), from_m=(302.0, -36.0), to_m=(310.0, -36.0), drive=False, samples=2)
    assert isinstance(way, xarray.Dataset)
    assert way.sizes == {"waypoint": 2, "leg": 1, "piece": 16}
    assert way.attrs["sentence"].startswith("Completed on ")
    assert way.attrs["probability_completed"] == 1.0 and "battery_energy_j" not in way.attrs
    np.testing.assert_allclose(way.piece_along_m, 0.25 + 0.5 * np.arange(16), atol=1e-12)
    assert (way.piece_z_m == 0.0).all() and way.piece_z_m.attrs["units"] == "m"
    assert way.x.values.tolist() == [302.0, 310.0] and way.y.values.tolist() == [-36.0, -36.0]
    assert way.x.attrs["units"] == "m" and way.energy_j.attrs["units"] == "J"
    assert way.attrs["status"] == "found" and "reason" not in way.attrs
    np.testing.assert_allclose(way.attrs["length_m"], 8.0, rtol=1e-12)
    level = gr.heading(slope_deg=[0.0], nominal=True)
    np.testing.assert_allclose(way.attrs["most_slip_ratio"], level.slip_ratio[0], atol=2e-3)
    for name in ("length_m", "time_s", "energy_j"):
        assert way[name].values.tolist() == [0.0, way.attrs[name]]


def test_each_leg_has_advice() -> None:
    """Across a slope of 8° and then up it: each leg has the slope and course of its worst place, or
    no course where the turn on the spot before it is worse."""
    slope = ground(lambda x, y: np.tan(np.radians(8.0)) * y + 0.0 * x)
    across_and_up = [[302.0, -38.0], [308.0, -38.0], [308.0, -34.0]]
    settings = {"soil": "toyoura-uncertain", "along": across_and_up, "samples": 4}
    way = gr.route(slope, drive=False, **settings)
    assert way.sizes["leg"] == way.sizes["waypoint"] - 1 == 2
    # A place is judged as one on the whole degree above its slope.
    assert ((way.leg_slope_deg > 7.9) & (way.leg_slope_deg < 9.1)).all()
    np.testing.assert_allclose(way.leg_course_deg, [0.0, np.nan], atol=1e-6)
    assert set(way.leg_verdict.values) <= {"go", "caution", "cannot_tell", "no_go"}
    assert way.leg_reason.dims == ("leg",) and all(way.leg_reason.values)
    assert way.leg_yaw_deg.attrs["units"] == "°" and "legs" not in way.attrs
    level = gr.heading(soil="toyoura-uncertain", slope_deg=way.leg_slope_deg[:1], samples=4)
    assert level.verdict is not None and level.verdict[0] == way.leg_verdict[0]
    np.testing.assert_allclose(way.leg_yaw_deg[0], level.yaw_deg[0], rtol=1e-6)


def test_a_way_is_driven_and_takes_what_it_says() -> None:
    way = gr.route(ground(), from_m=(302.0, -36.0), to_m=(304.0, -35.0), samples=2)
    assert way.attrs["simulated_outcome"] == "completed"
    assert abs(way.attrs["simulated_time_error"]) < 0.1
    ratio = way.attrs["energy_j"] / way.attrs["simulated_energy_j"]
    assert ratio == pytest.approx(1.0 + way.attrs["simulated_energy_error"])


def test_alternatives_are_best_at_their_own() -> None:
    bumps = ground(lambda x, y: 0.5 * np.sin(0.9 * x) * np.cos(0.7 * y))
    ends = {"from_m": (302.0, -37.0), "to_m": (311.0, -31.0)}
    ways = gr.route(bumps, minimise="energy", alternatives=True, drive=False, samples=3, **ends)
    assert list(ways) == ["energy", "time", "risk"]
    assert ways["time"].attrs["time_s"] <= 1.001 * ways["energy"].attrs["time_s"]
    assert ways["energy"].attrs["energy_j"] <= 1.001 * ways["time"].attrs["energy_j"]
    for way in ways.values():
        assert np.all(np.diff(way.time_s) > 0.0) and np.all(np.diff(way.length_m) > 0.0)
        assert way.attrs["samples"] == 3
    alone = gr.route(bumps, minimise="time", drive=False, samples=3, **ends)
    xarray.testing.assert_identical(alone, ways["time"])


def test_a_way_keeps_out_of_areas(tmp_path: Path) -> None:
    ring = [[305, -41], [308, -41], [308, -33], [305, -33], [305, -41]]
    area = {"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [ring]}}
    file = tmp_path / "keep.geojson"
    file.write_text(json.dumps(area))
    ends = {"from_m": (302.0, -36.0), "to_m": (310.0, -36.0), "drive": False, "samples": 2}
    way = gr.route(ground(), keep_out=file, **ends)
    assert float(way.y.max()) > -33.5 and way.attrs["length_m"] > 9.0
    inside = gr.route(ground(), keep_out=file, **{**ends, "to_m": (306.0, -36.0)})
    assert "lies where nobody may go" in inside.attrs["reason"]
    file.write_text(json.dumps({"type": "FeatureCollection", "features": []}))
    with pytest.raises(gr.DocumentError, match=r"keep\.geojson"):
        gr.route(ground(), keep_out=file, **ends)
    with pytest.raises(gr.DocumentNotFoundError, match=r"nowhere\.geojson"):
        gr.route(ground(), keep_out=tmp_path / "nowhere.geojson", **ends)


def test_a_way_that_was_found_takes_the_same_when_it_is_given() -> None:
    bumps = ground(lambda x, y: 0.5 * np.sin(0.9 * x) * np.cos(0.7 * y))
    found = gr.route(bumps, from_m=(302.0, -37.0), to_m=(311.0, -31.0), drive=False, samples=3)
    places = np.column_stack([found.x, found.y])
    given = gr.route(bumps, along=places, drive=False, samples=3)
    assert given.attrs["status"] == "safe" and "minimise" not in given.attrs
    assert given.sizes == {**found.sizes, "hazard": 0}
    for name in ("length_m", "time_s", "energy_j"):
        np.testing.assert_allclose(given[name], found[name], rtol=1e-9)
        np.testing.assert_allclose(given.attrs[name], found.attrs[name], rtol=1e-9)


def test_a_given_way_is_not_safe_where_it_says(tmp_path: Path) -> None:
    across = [[302.0, -36.0], [311.0, -36.0]]
    way = gr.route(ground(wall), along=across, samples=2)
    assert way.attrs["status"] == "not-safe" and "length_m" not in way.attrs
    assert "no-heading" in way.danger and np.isnan(way.time_s).all()
    begins = float(way.from_m[list(way.danger).index("no-heading")])
    assert abs(begins - 4.0) <= 0.5
    line = tmp_path / "line.geojson"
    line.write_text(json.dumps({"type": "LineString", "coordinates": across}))
    xarray.testing.assert_identical(way, gr.route(ground(wall), along=line, samples=2))
    with pytest.raises(gr.ParameterError, match="along has shape"):
        gr.route(ground(), along=[1.0, 2.0])
    with pytest.raises(gr.ParameterError, match="the line has no length"):
        gr.route(ground(), along=[[302.0, -36.0], [302.0, -36.0]])
    with pytest.raises(gr.ParameterError, match="the line is not on the map"):
        gr.route(ground(), along=[[2.0, 3.0], [4.0, 5.0]])
    with pytest.raises(gr.ParameterError, match="to_m has no place beside"):
        gr.route(ground(), along=across, to_m=(302.0, -36.0))
    with pytest.raises(gr.ParameterError, match="from_m is missing"):
        gr.route(ground(), to_m=(302.0, -36.0))
    with pytest.raises(gr.DocumentNotFoundError, match=r"nowhere\.geojson"):
        gr.route(ground(), along=tmp_path / "nowhere.geojson")


def test_without_a_safe_route_there_is_a_reason(tmp_path: Path) -> None:
    way = gr.route(ground(wall), from_m=(302.0, -36.0), to_m=(311.0, -36.0), samples=2)
    assert way.attrs["status"] == "no-safe-route" and way.sizes == {"waypoint": 0, "leg": 0, "piece": 0}
    assert "cannot be crossed within the limits" in way.attrs["reason"]
    assert "length_m" not in way.attrs and way.time_s.attrs["units"] == "s"
    gentle = {"from_m": (302.0, -36.0), "to_m": (304.0, -36.0), "drive": False, "samples": 2}
    slope = ground(lambda x, y: 0.1 * x + 0.0 * y)
    assert gr.route(slope, **gentle).attrs["status"] == "found"
    assert gr.route(slope, most_slope_deg=3.0, **gentle).attrs["status"] == "no-safe-route"


def test_what_is_no_route_is_said() -> None:
    level, ends = ground(), {"from_m": (302.0, -36.0), "to_m": (310.0, -36.0)}
    with pytest.raises(gr.ParameterError, match="terrain is ndarray, it must be a Terrain"):
        gr.route(np.zeros((4, 4)), **ends)  # type: ignore[call-overload]
    with pytest.raises(gr.ParameterError, match="'time', 'energy' or 'risk'"):
        gr.route(level, minimise="way", **ends)  # type: ignore[call-overload]
    with pytest.raises(gr.ParameterError, match=r"the target at x 399\.00 m.*not on the map"):
        gr.route(level, from_m=(302.0, -36.0), to_m=(399.0, -36.0))
    bad: dict[str, object]
    for bad in (
        {"from_m": (302.0,)},
        {"to_m": (float("nan"), -36.0)},
        {"yaw_deg": float("nan")},
        {"most_slope_deg": 61.0},
        {"most_slip_ratio": -0.1},
        {"most_no_go": 1.1},
        {"rim_speed_m_s": 0.0},
        {"samples": 1},
        {"seed": -1},
    ):
        with pytest.raises(gr.ParameterError, match=next(iter(bad))):
            gr.route(level, **{**ends, **bad})  # type: ignore[call-overload]
