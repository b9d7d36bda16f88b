"""The same map of heights under MuJoCo's rover and under our own."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import grouser as gr

mujoco = pytest.importorskip("mujoco")
from grouser.mujoco import SoilContact, rover_xml  # noqa: E402

Floats = NDArray[np.float64]
#: Speed of the rims [m/s], the default of scenarios.
SPEED = 0.06
#: Way that MuJoCo's rover takes to roll as ours does from the start [m].
START = 0.03


def ripples(amplitude_m: float, wavelength_m: float, direction_deg: float) -> gr.Terrain:
    """Straight waves, at points 2 cm apart."""
    x, y = np.arange(-1.0, 2.5, 0.02), np.arange(-1.5, 1.5, 0.02)[:, None]
    direction = np.radians(direction_deg)
    along = x * np.cos(direction) + y * np.sin(direction)
    heights = amplitude_m * np.sin(2.0 * np.pi * along / wavelength_m)
    return gr.Terrain(heights, cell_size_m=0.02, south_west_m=(-1.0, -1.5), rows="south-first")


class OnMap:
    """A rover in MuJoCo on a map, where and as our own rover starts there."""

    def __init__(self, ground: gr.Terrain, own: gr.Trajectory) -> None:
        rover = own.scenario.rover
        self.model = mujoco.MjModel.from_xml_string(rover_xml(rover))
        self.data = mujoco.MjData(self.model)
        wheels = {mount["name"]: rover.wheel for mount in rover.mount}
        self.soil = SoilContact(self.model, soil="toyoura", wheels=wheels, ground=ground)
        assert own.z_m is not None and own.roll_deg is not None and own.pitch_deg is not None
        half_pitch, half_roll = np.radians([-0.5 * own.pitch_deg[0], 0.5 * own.roll_deg[0]])
        turned = np.empty(4)
        pitched = np.array([np.cos(half_pitch), 0.0, np.sin(half_pitch), 0.0])
        rolled = np.array([np.cos(half_roll), np.sin(half_roll), 0.0, 0.0])
        mujoco.mju_mulQuat(turned, pitched, rolled)
        self.data.qpos[:7] = [own.x_m[0], own.y_m[0], own.z_m[0], *turned]
        # Its wheels sink until they carry it; meanwhile it creeps a little.
        self.soil.step(self.data, 300)
        self.start = self.data.qpos[:2] - [own.x_m[0], own.y_m[0]]
        self.data.qvel[0] = 0.95 * SPEED
        self.data.ctrl[:] = SPEED / float(self.soil._radii[0])
        self.data.qvel[[self.model.joint(name).dofadr[0] for name in wheels]] = self.data.ctrl

    def drive(self, duration_s: float) -> Floats:
        """Place [m], roll, pitch and yaw [°], then slip ratios and normal forces [N] of the wheels: a row for every
        tenth of a second."""
        rows = []
        for _ in range(round(10 * duration_s)):
            self.soil.step(self.data, 50)
            body, forces = self.data.body("body"), self.soil.forces
            axes = body.xmat.reshape(3, 3)
            angles = (
                np.arctan2(axes[2, 1], axes[2, 2]),
                np.arcsin(axes[2, 0]),
                np.arctan2(axes[1, 0], axes[0, 0]),
            )
            place = [*(body.xpos[:2] - self.start), body.xpos[2]]
            rows.append([*place, *np.degrees(angles), *forces.slip_ratio, *forces.normal_force_n])
        return np.array(rows)


def compared(rover: gr.Rover, ground: gr.Terrain, duration_s: float) -> tuple[Floats, Floats]:
    """Rows of our own rover, quasi-steady, at the places of MuJoCo's, and MuJoCo's."""
    own = gr.simulate(
        rover=rover,
        terrain={"file": ground, "start_m": (0.0, 0.0)},
        duration_s=duration_s,
        simulation="quasi-steady",
        load_transfer="quasi-static-torque",
        wheel_moments="included",
    )
    ours = np.column_stack(
        [own.x_m, own.y_m, own.z_m, own.roll_deg, own.pitch_deg, own.yaw_deg]
        + [own.wheel["slip_ratio"], own.wheel["normal_force_n"]]
    )
    theirs = OnMap(ground, own).drive(duration_s)
    # Both are as far after the same time.
    assert theirs[-1, 0] == pytest.approx(ours[-1, 0], rel=2e-3)
    theirs = theirs[theirs[:, 0] > START]
    there = np.column_stack([np.interp(theirs[:, 0], ours[:, 0], one) for one in ours.T])
    return there, theirs


def test_a_rigid_rover_agrees_with_our_own_over_ripples() -> None:
    """15 s over waves 1.2 m long and 2 cm high that run at 30° to the way, all wheels loaded
    throughout: rolls by 2°, pitches by 4°, loads from 4 to 30 N. The tolerances are about twice
    what is measured: height 0.05 mm, roll and pitch 0.01°, yaw 0.01°, mean slip 0.2 %, loads 2.3 %
    of their mean, drift 0.0002 of the way. DIFFERENCE: ours is quasi-steady, and has no inertia in
    heave, pitch and roll."""
    ours, theirs = compared(gr.Rover("hakuto"), ripples(0.01, 1.2, 30.0), 15.0)
    differences = np.abs(theirs - ours)
    assert np.ptp(ours[:, 4]) > 3.0 and np.ptp(ours[:, 3]) > 1.5
    assert differences[:, 2].max() < 1e-4
    assert differences[:, 3:5].max() < 0.02 and differences[:, 5].max() < 0.03
    assert theirs[:, 6:10].mean() == pytest.approx(ours[:, 6:10].mean(), rel=0.005)
    assert differences[:, 10:].max() < 0.05 * ours[:, 10:].mean()
    assert differences[-1, 1] < 5e-4 * theirs[-1, 0]


def test_a_rover_on_rockers_agrees_with_our_own_over_ripples() -> None:
    """16 s over waves 0.8 m long and 4 cm high at 30° to the way, where a rigid rover lifts its
    wheels: pitches by 7°. Measured: height 0.04 mm, roll and pitch 0.03°, yaw 0.21°, mean slip
    0.5 %, loads 0.6 % of their mean, drift 0.002 of the way."""
    rover = gr.Rover("hakuto", suspension={"pivot_m": (0.0, 0.0)})
    ours, theirs = compared(rover, ripples(0.02, 0.8, 30.0), 16.0)
    differences = np.abs(theirs - ours)
    assert np.ptp(ours[:, 4]) > 6.0 and ours[:, 10:].min() > 10.0
    assert differences[:, 2].max() < 1e-4
    assert differences[:, 3:5].max() < 0.06 and differences[:, 5].max() < 0.4
    assert theirs[:, 6:10].mean() == pytest.approx(ours[:, 6:10].mean(), rel=0.01)
    assert differences[:, 10:].max() < 0.015 * ours[:, 10:].mean()
    assert differences[-1, 1] < 4e-3 * theirs[-1, 0]


def test_a_rocker_bogie_has_the_links_of_its_description() -> None:
    """Three joints and the differential; standing, every wheel of Curiosity carries a sixth."""
    rover = gr.Rover("curiosity-rocker-bogie")
    model = mujoco.MjModel.from_xml_string(rover_xml(rover))
    data = mujoco.MjData(model)
    hubs = [model.body(mount["name"]).id for mount in rover.mount]
    mujoco.mj_forward(model, data)
    described = [mount["position_m"] for mount in rover.mount]
    np.testing.assert_allclose(data.xpos[hubs] - data.body("body").xpos, described, atol=1e-12)
    assert model.body("rear-left").parentid == model.body("left-bogie").id
    assert model.body("front-left").parentid == model.body("left-rocker").id
    wheels = {mount["name"]: rover.wheel for mount in rover.mount}
    soil = SoilContact(model, soil="toyoura", wheels=wheels, ground="ground")
    soil.step(data, 1500)
    loads = soil.forces.normal_force_n
    np.testing.assert_allclose(loads, loads.mean(), rtol=0.02)


def test_a_map_is_the_ground_of_a_function_with_its_heights() -> None:
    ground = ripples(0.01, 1.2, 30.0)
    own = gr.simulate(terrain={"file": ground, "start_m": (0.0, 0.0)}, duration_s=0.2)
    by_map, by_function = OnMap(ground, own), OnMap(ground, own)
    wheels = {mount["name"]: "hakuto" for mount in gr.Rover("hakuto").mount}
    by_function.soil = SoilContact(
        by_function.model, soil="toyoura", wheels=wheels, ground=ground.height_m
    )
    np.testing.assert_array_equal(by_map.drive(0.2), by_function.drive(0.2))
