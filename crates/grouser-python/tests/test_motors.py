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


WINDING = {"thermal_resistance_k_w": 20.0, "heat_capacity_j_k": 2.0, "highest_degc": 125.0}
BATTERY = {
    "capacity_wh": 20.0,
    "full_voltage_v": 8.4,
    "empty_voltage_v": 6.4,
    "internal_resistance_ohm": 0.3,
    "electronics_w": 3.0,
}


def test_a_run_has_what_battery_and_windings_do() -> None:
    rover = gr.Rover("hakuto", motor={**MOTOR, "winding": WINDING}, battery=BATTERY)
    run = gr.simulate(rover=rover, duration_s=5.0)
    taken = run.electrical
    power = taken["battery_voltage_v"] * taken["battery_current_a"]
    assert np.allclose(power, taken["electrical_power_w"] + 3.0, rtol=1e-9)
    assert taken["state_of_charge"][0] == 1.0 and np.all(np.diff(taken["state_of_charge"]) < 0.0)
    warm = run.wheel["winding_temperature_degc"]
    assert np.all(warm[0] == 20.0) and np.all(np.diff(warm, axis=0) > 0.0)
    assert run.to_xarray().battery_voltage_v.units == "V"


def test_legs_of_a_mission_have_what_motors_and_battery_take() -> None:
    rover = gr.Rover("hakuto", motor={**MOTOR, "winding": WINDING}, battery=BATTERY)
    plan = {"leg": [{"drive_m": 0.3}, {"wait_s": 1.0}]}
    driven = gr.mission(gr.Mission("arc", rover=rover, **plan))
    legs, whole = driven.legs.electrical, driven.electrical
    names = ["battery_energy_j", "current_a", "winding_temperature_degc", "state_of_charge"]
    assert list(legs) == list(whole) == names
    assert legs["battery_energy_j"].sum() == pytest.approx(whole["battery_energy_j"], rel=1e-12)
    energy = driven.trajectory.electrical["battery_energy_j"][-1]
    assert energy == pytest.approx(whole["battery_energy_j"], rel=1e-12)
    assert legs["current_a"].max() == whole["current_a"]
    assert legs["state_of_charge"][-1] == whole["state_of_charge"] < 1.0
    assert "battery_energy_j" in driven.to_pandas().columns
    assert driven.to_xarray().current_a.units == "A"
    stopped = gr.mission(
        gr.Mission("arc", rover=rover, stop={"depth_of_discharge": {"above": 1e-4}}, **plan)
    )
    assert stopped.legs.stopped_by[-1] == "depth_of_discharge"
    plain = gr.mission(gr.Mission("arc", **plan))
    assert not plain.electrical and not plain.legs.electrical
    with pytest.raises(gr.ParameterError, match=r"no \[motor\]"):
        gr.Mission("arc", stop={"current_a": {"above": 1.0}}, **plan)


def test_a_motor_that_is_none_is_refused() -> None:
    with pytest.raises(gr.ParameterError, match="gear_efficiency"):
        gr.Rover("hakuto", motor={**MOTOR, "gear_efficiency": 60.0})
