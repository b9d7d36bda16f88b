"""Linearised steps: units and names, differences of whole steps, and what has no slopes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import grouser as gr

#: Left wheels first, as the mounts of the preset have them: left, left, right, right.
ARC = np.array([0.05, 0.05, 0.07, 0.07])
MOTOR = {
    "resistance_ohm": 10.0,
    "torque_constant_nm_a": 0.01,
    "gear_ratio": 250.0,
    "gear_efficiency": 0.6,
    "control": {"gain_v_s_rad": 0.5, "integral_v_rad": 5.0, "voltage_limit_v": 8.0},
}


def begun(**changes: Any) -> gr.Run:
    run = gr.Run(commands="rim_speed_m_s", **{"slope_deg": 10.0, **changes})
    run.step(ARC, 2.0)
    return run


@pytest.mark.parametrize("simulation", ["dynamic", "quasi-steady"])
def test_slopes_by_commands_are_those_of_whole_steps(simulation: str) -> None:
    """Tolerance: slopes bend by 2e-4 over 0.3 mm/s, and a step has errors of 3e-7 of its way."""
    run = begun(simulation=simulation)
    here, linear = run.save(), run.linearise(ARC, 0.5)
    assert run.save() == here and linear.kinks == []
    assert linear.state == pytest.approx(run.state, rel=1e-12)
    assert linear.next_state == pytest.approx(run.step(ARC, 0.5), rel=1e-4, abs=1e-5)

    def moved(wheel: int, by: float) -> Any:
        run.restore(here)
        return run.step(ARC + by * np.eye(4)[wheel], 0.5)

    for length in (1e-4, 3e-4):
        for wheel in range(4):
            own = (moved(wheel, length) - moved(wheel, -length)) / (2.0 * length)
            assert linear.B[:3, wheel] == pytest.approx(own[:3], rel=1e-3, abs=1e-3), wheel


def test_on_level_ground_the_pose_is_carried_along() -> None:
    """A rover that is turned ends as much turned: by an angle a, its way is turned by a."""
    linear = begun(slope_deg=0.0).linearise(ARC, 0.5)
    x, y = (linear.next_state - linear.state)[:2]
    turned = np.radians([-y, x])
    assert linear.A[:2, 2] == pytest.approx(turned, abs=1e-7)
    assert linear.A[:3, :2] == pytest.approx(np.eye(3)[:, :2], abs=1e-6)
    assert linear.A[2, 2] == pytest.approx(1.0, abs=1e-6)


def test_names_have_the_units_of_the_commands() -> None:
    """The shearing radius of the preset is 0.11 m."""
    rims, wheels = begun(), gr.Run(slope_deg=10.0)
    wheels.step(ARC / 0.11, 2.0)
    one, other = rims.linearise(ARC, 0.5), wheels.linearise(ARC / 0.11, 0.5)
    assert one.states == other.states == gr.Run.STATE
    assert one.commands[0] == "front-left.rim_speed_m_s"
    assert other.commands[3] == "front-right.wheel_speed_rad_s"
    assert other.B == pytest.approx(0.11 * one.B, rel=1e-4, abs=1e-6)
    assert other.A == pytest.approx(one.A, rel=1e-4, abs=1e-6)


def test_wheels_that_follow_their_motors_are_states() -> None:
    run = begun(rover=gr.Rover("hakuto", motor=MOTOR))
    linear = run.linearise(ARC, 0.1)
    names = [f"{wheel}.{name}" for name in ("wheel_speed_rad_s", "control_voltage_v") for wheel in run.wheel_names]
    assert linear.states == (*gr.Run.STATE, *names)
    assert linear.A.shape == (14, 14) and linear.B.shape == (14, 4)
    assert np.allclose(linear.state[6:10], run.wheel["wheel_speed_rad_s"])
    # A controller that has added more voltage turns its wheel faster.
    assert (np.diag(linear.A[6:10, 10:14]) > 0.0).all()


def test_a_wheel_that_begins_to_turn_has_a_kink() -> None:
    run = gr.Run(slope_deg=5.0, commands="rim_speed_m_s")
    run.step(0.0, 2.0)
    kinks = run.linearise(0.0, 0.5).kinks
    assert any(by.endswith("rim_speed_m_s") for _, by in kinks)


def test_what_has_no_slopes_says_why() -> None:
    steep = gr.Run(slope_deg=35.0, commands="rim_speed_m_s")
    with pytest.raises(gr.SimulationError, match="ends within the step.*slides downhill"):
        steep.linearise(0.06, 60.0)
    steep.step(0.06, 60.0)
    with pytest.raises(gr.SimulationError, match="slides downhill"):
        steep.linearise(0.06, 0.5)
    with pytest.raises(gr.ParameterError, match=r"commands has shape \(3,\)"):
        begun().linearise([0.06] * 3, 0.5)
    with pytest.raises(gr.ParameterError, match="dt_s"):
        begun().linearise(0.06, 0.0)
    turning = begun(simulation="quasi-steady", slope_deg=20.0)
    with pytest.raises(gr.SimulationError, match="falls back to the dynamic one"):
        turning.linearise([-0.09, -0.09, 0.09, 0.09], 2.0)
