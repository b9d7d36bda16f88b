"""Wheels that are steered: the crab angle, and the steering angle of each wheel over time."""

from __future__ import annotations

import numpy as np
import pytest

import grouser as gr

from conftest import Program


def test_crab_angles_are_the_programs(program: Program) -> None:
    crab = gr.heading(rover="hakuto-steered", slope_deg=[5, 10, 30], steering="crab")
    answer = program(
        "heading", "--rover", "hakuto-steered", "--slope-deg", "5,10,30", "--steering", "crab"
    )
    assert crab.steering_deg is not None
    for row, found in zip(answer["rows"], crab.steering_deg):
        expected = row["steering_deg"]
        assert np.isnan(found) if expected is None else found == expected
    assert crab.limit_slope_deg == answer["limit_slope_deg"]
    assert not crab.yaw_deg[:2].any() and "steering_deg" in crab.to_pandas()
    assert crab.to_xarray().steering_deg.units == "°"
    assert crab.band is None and crab.verdict is None
    level = gr.heading(rover="hakuto-steered", slope_deg=[5, 10, 30], nominal=True)
    assert level.steering_deg is None and "steering_deg" not in level.to_pandas()
    assert np.allclose(level.yaw_deg[:2], crab.steering_deg[:2], atol=0.01)


def test_what_cannot_be_steered_is_refused() -> None:
    with pytest.raises(gr.ParameterError, match="steering_limit_deg"):
        gr.heading(rover="hakuto", slope_deg=5.0, steering="crab")
    with pytest.raises(gr.ParameterError, match="steering is 'ackermann'"):
        gr.heading(slope_deg=5.0, steering="ackermann")  # type: ignore[call-overload]
    with pytest.raises(gr.ParameterError, match="uncertainty"):
        gr.heading(slope_deg=5.0, steering="crab", uncertainty=True)


def test_steering_angles_are_columns_of_the_wheels_that_are_steered() -> None:
    found = gr.mission("crab-or-yaw", simulation="quasi-steady")
    crab, yaw = (found.alternatives[name].trajectory for name in ("crab", "yaw"))
    assert crab.wheel["steering_deg"].shape == crab.wheel["load_n"].shape
    assert (crab.wheel["steering_deg"][-1] > 9.0).all() and not yaw.wheel["steering_deg"].any()
    assert "front-left.steering_deg" in crab.to_pandas()
    assert crab.to_xarray().wheel_steering_deg.units == "°"
    assert "steering_deg" not in gr.simulate(duration_s=1.0).wheel
