"""Slip from the currents of motors: one reading, arrays, and what a current says nothing of."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import grouser as gr

MOTOR = {
    "resistance_ohm": 10.0,
    "torque_constant_nm_a": 0.01,
    "gear_ratio": 250.0,
    "gear_efficiency": 0.6,
    "friction_torque_nm": 0.001,
}


@pytest.fixture(scope="module")
def rover() -> gr.Rover:
    return gr.Rover("hakuto", motor=MOTOR)


@pytest.fixture(scope="module")
def slip(rover: gr.Rover) -> gr.SlipEstimator:
    return gr.SlipEstimator(rover=rover, soil="toyoura")


@pytest.fixture(scope="module")
def run(rover: gr.Rover) -> gr.Trajectory:
    uphill = {"slope_deg": 8.0, "start": {"yaw_deg": 90.0}, "simulation": "quasi-steady"}
    return gr.simulate(rover=rover, soil="toyoura", duration_s=2.0, **uphill)


def test_the_currents_of_a_run_give_its_slip(slip: gr.SlipEstimator, run: gr.Trajectory) -> None:
    readings = run.wheel["current_a"], run.wheel["wheel_speed_rad_s"]
    found = slip.estimate(*readings, slope_deg=8.0, yaw_deg=run.yaw_deg)
    true = run.wheel["slip_ratio"]
    assert found["slip_ratio_p50"].shape == true.shape == (21, 4)
    assert np.abs(found["slip_ratio_p50"] - true).max() < 0.005
    assert np.all((found["slip_ratio_p2_5"] < true) & (true < found["slip_ratio_p97_5"]))
    assert np.allclose(found["load_n"], run.wheel["load_n"], atol=0.05)
    assert np.allclose(found["torque_nm"], run.wheel["torque_nm"], rtol=1e-12)
    assert set(found["status"].ravel()) == {"ok"} and set(found["reason"].ravel()) == {None}
    width = found["slip_ratio_p97_5"] - found["slip_ratio_p2_5"]
    assert np.array_equal(width, found["slip_ratio_width"])


def test_one_wheel_is_as_among_all(slip: gr.SlipEstimator, run: gr.Trajectory) -> None:
    readings = {name: run.wheel[name] for name in ("current_a", "wheel_speed_rad_s", "load_n")}
    together = slip.estimate(**readings)
    for place, wheel in enumerate(slip.wheel_names):
        alone = slip.estimate(**{name: it[:, place] for name, it in readings.items()}, wheel=wheel)
        for name, values in alone.items():
            expected = together[name][:, place]
            assert values.shape == (21,) and all(a is b or a == b for a, b in zip(values, expected))
    one = slip.estimate(0.31, 0.545, wheel="front-left", load_n=13.1)
    assert one["slip_ratio_p50"].shape == () and one["status"].item() == "ok"
    again = pickle.loads(pickle.dumps(slip)).estimate(0.31, 0.545, wheel="front-left", load_n=13.1)
    assert again == one


def test_what_a_current_says_nothing_of_has_a_status(slip: gr.SlipEstimator) -> None:
    found = slip.estimate([0.2, 9.0, np.nan, 0.3], [0.0, 0.5, 0.5, 0.5], load_n=17.0)
    assert found["status"].tolist() == ["standing", "torque-too-high", None, "ok"]
    assert np.isnan(found["slip_ratio_p50"]).tolist() == [True, True, True, False]
    assert "stands" in found["reason"][0]
    turned = slip.estimate(0.3, 0.5, wheel="rear-left", yaw_deg=5.0, course_deg=0.0)
    assert abs(float(turned["slip_angle_deg"]) + 5.0) < 1e-9


def test_an_uncertain_soil_is_ill_posed(rover: gr.Rover, slip: gr.SlipEstimator) -> None:
    unknown = gr.SlipEstimator(rover=rover, soil="toyoura", uncertainty=True, samples=20)
    wide, narrow = (it.estimate(0.4, 0.5, wheel="rear-left", load_n=17.0) for it in (unknown, slip))
    assert wide["slip_ratio_width"] > 0.2 > narrow["slip_ratio_width"]
    assert (wide["status"].item(), narrow["status"].item()) == ("ill-posed", "ok")


def test_bad_input_is_refused(rover: gr.Rover, slip: gr.SlipEstimator) -> None:
    with pytest.raises(gr.ParameterError, match=r"no wheel of the rover has a \[motor\]"):
        gr.SlipEstimator(rover="hakuto")
    with pytest.raises(gr.ParameterError, match="above the lowest"):
        gr.SlipEstimator(rover=rover, slip_ratio=(0.5, 0.1))
    with pytest.raises(gr.ParameterError, match="noise"):
        gr.SlipEstimator(rover=rover, relative_noise=-1.0)
    with pytest.raises(gr.ParameterError, match="over the 4 wheels"):
        slip.estimate([0.2, 0.3], [0.5, 0.5])
    with pytest.raises(gr.ParameterError, match="nose"):
        slip.estimate(0.2, 0.5, wheel="nose")
    with pytest.raises(gr.ParameterError, match="load_n"):
        slip.estimate(0.2, 0.5, wheel="front-left", load_n=-1.0)
    with pytest.raises(gr.ParameterError, match="slope_deg has shape"):
        slip.estimate(np.ones((3, 4)), np.ones((3, 4)), slope_deg=np.ones(5))
