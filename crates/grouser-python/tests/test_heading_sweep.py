"""Headings over numbers that vary: those of one heading after the other, in the shape that was asked for."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import grouser as gr

FIELDS = ("yaw_deg", "slip_ratio", "sinkage_mm", "torque_nm", "energy_j_per_m", "yaw_moment_nm")


def alone(**changes: Any) -> gr.Headings:
    return gr.heading(nominal=True, **changes)


def test_each_entry_is_the_heading_of_its_numbers() -> None:
    angles, slopes, masses = [34.0, 38.0], [5.0, 12.0, 25.0], [5.24, 6.0]
    found = gr.heading(
        rover="hakuto",
        slope_deg=slopes,
        vary={
            "soil.friction_angle_deg": np.reshape(angles, (2, 1, 1)),
            "rover.body.mass_kg": np.reshape(masses, (2, 1)),
        },
        nominal=True,
    )
    assert found.shape == (2, 2, 3)
    for i, angle in enumerate(angles):
        for j, mass in enumerate(masses):
            soil = gr.Soil("toyoura", friction_angle_deg=angle)
            rover = gr.Rover("hakuto", body={"mass_kg": mass})
            one = alone(rover=rover, soil=soil, slope_deg=slopes)
            for name in FIELDS:
                np.testing.assert_array_equal(getattr(found, name)[i, j], getattr(one, name), name)
            assert found.status[i, j].tolist() == one.status.tolist()
            assert found.flags[i, j].tolist() == one.flags.tolist()
            assert set(found.limit_slope_deg[i, j]) == {one.limit_slope_deg}
            assert set(found.limited_by[i, j]) == {one.limited_by}
    table = found.to_pandas()
    assert len(table) == 12 and {"slope_deg", "rover.body.mass_kg", "status"} <= set(table)
    over = found.to_xarray(dims=["soil.friction_angle_deg", "rover.body.mass_kg", "slope_deg"])
    assert over.yaw_deg.sel({"slope_deg": 5.0}).shape == (2, 2)
    assert over.yaw_deg.attrs["units"] == "°"


def test_soils_and_steered_wheels_and_gravities() -> None:
    soils = ["toyoura", "lunar-nominal"]
    found = gr.heading(
        rover="hakuto-steered", soil=soils, slope_deg=10.0, steering="crab", vary={}, nominal=True
    )
    for k, soil in enumerate(soils):
        one = alone(rover="hakuto-steered", soil=soil, slope_deg=[10.0], steering="crab")
        assert found.steering_deg[k] == one.steering_deg[0]
    assert found.inputs["soil"].tolist() == [gr.Soil(it).name for it in soils]
    found = gr.heading(slope_deg=8.0, vary={"gravity_m_s2": [1.62, 9.81]}, nominal=True)
    assert found.yaw_deg[1] == alone(slope_deg=[8.0], gravity_m_s2=9.81).yaw_deg[0]
    assert gr.heading(slope_deg=[], vary={}, nominal=True).shape == (0,)


def test_what_is_out_of_range_is_an_error_or_left_out() -> None:
    vary = {"soil.friction_angle_deg": [38.0, 120.0, float("nan")]}
    with pytest.raises(gr.ParameterError, match="friction_angle_deg is 120"):
        gr.heading(slope_deg=5.0, vary=vary, nominal=True)
    found = gr.heading(slope_deg=5.0, vary=vary, nominal=True, outside="nan")
    assert found.status[0] == "ok" and np.isfinite(found.yaw_deg).tolist() == [True, False, False]
    assert "120" in found.status[1] and "NaN" in found.status[2]
    with pytest.raises(gr.ParameterError, match="key"):
        gr.heading(slope_deg=5.0, vary={"soil.frictn": [1.0]}, nominal=True)
    asked: dict[str, Any] = {"vary": {"gravity_m_s2": 1.62}}
    for other in ({}, {"nominal": True, "gradients": "gravity_m_s2"}, {"nominal": True, "model": "all"}):
        with pytest.raises(gr.ParameterError, match="vary does not go with"):
            gr.heading(**asked, **other)
    with pytest.raises(gr.ParameterError, match="steer"):
        gr.heading(rover="hakuto", steering="crab", vary={}, nominal=True)
