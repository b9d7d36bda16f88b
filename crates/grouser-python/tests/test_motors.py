"""What motors take, beside a run that is the same without them."""

from __future__ import annotations

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


def test_a_run_has_what_its_motors_take() -> None:
    motors = gr.simulate(rover=gr.Rover("hakuto", motor=MOTOR), duration_s=2.0)
    plain = gr.simulate(rover="hakuto", duration_s=2.0)
    assert np.array_equal(motors.y_m, plain.y_m) and np.array_equal(motors.power_w, plain.power_w)
    assert not plain.electrical and "current_a" not in plain.wheel
    power = motors.wheel["electrical_power_w"]
    assert np.allclose(power.sum(axis=1), motors.electrical["electrical_power_w"], rtol=1e-14)
    torque, speed = motors.wheel["torque_nm"], motors.wheel["wheel_speed_rad_s"]
    current = (torque / 150.0 + 0.001) / 0.01
    assert np.allclose(motors.wheel["current_a"], current, rtol=1e-12)
    assert np.allclose(motors.wheel["voltage_v"], 10.0 * current + 2.5 * speed, rtol=1e-12)
    energy = motors.electrical["battery_energy_j"]
    assert energy[-1] > 3.0 * motors.energy_j[-1]
    data = motors.to_xarray()
    assert data.battery_energy_j.units == "J" and data.wheel_current_a.units == "A"
    assert "front-left.current_a" in motors.to_pandas().columns


def test_a_motor_that_is_none_is_refused() -> None:
    with pytest.raises(gr.ParameterError, match="gear_efficiency"):
        gr.Rover("hakuto", motor={**MOTOR, "gear_efficiency": 60.0})
