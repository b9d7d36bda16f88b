"""A rover with rockers, a differential and steered wheels climbs a slope of uneven sand and crosses it.

    pip install "grouser[mujoco,plot]"
    MUJOCO_GL=egl python mujoco_rocker.py --out pictures

Two rockers carry two wheels each and turn against each other on the body, which keeps all four
wheels on uneven ground; the body takes the mean of their angles. The soil acts through
`grouser.mujoco.SoilContact` on a height field. Pictures need a display, or MUJOCO_GL=egl
or osmesa.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

import grouser as gr
from grouser.mujoco import SoilContact

Floats = NDArray[np.float64]

#: The ground: half its length and width, and the largest rise [m]; points along each side.
HALF, RISE, POINTS = 3.0, 1.6, 301
SLOPE_DEG = 10.0
#: The wheel: HAKUTO's, with its grousers.
WHEEL = gr.Wheel("hakuto")
RADIUS = WHEEL.radius_m + WHEEL.grousers["height_m"]
SPEED_M_S = 0.08
#: The start, and the contour on which it crosses the slope [m].
START, LEVEL_Y = (-1.6, -1.9), -0.1
#: The four wheels: side (1 is left), end (1 is front).
CORNERS = {
    "front-left": (1, 1),
    "front-right": (-1, 1),
    "rear-left": (1, -1),
    "rear-right": (-1, -1),
}
HALF_BASE, HALF_TRACK = 0.30, 0.29


def height(x: Floats, y: Floats) -> Floats:
    """Height of the ground [m]: a slope with dunes, hollows and ripples."""
    slope = np.tan(np.radians(SLOPE_DEG)) * (y + HALF)
    dunes = 0.045 * np.sin(2.0 * np.pi * (x + 0.35 * y) / 1.5) + 0.03 * np.cos(
        2.0 * np.pi * (0.4 * x - y) / 1.1
    )
    ripples = 0.004 * np.sin(2.0 * np.pi * (y + 0.1 * np.sin(3.0 * x)) / 0.16)
    heights: Floats = slope + dunes + ripples + 0.12
    return heights


def sand() -> Floats:
    """Heights over the ground's grid [m]."""
    return height(*np.meshgrid(*2 * [np.linspace(-HALF, HALF, POINTS)]))


def corner(name: str) -> str:
    """A steered wheel at the end of a rocker."""
    side, end = CORNERS[name]
    spokes = "".join(
        f'<geom type="box" size="{0.92 * RADIUS} 0.012 0.006" euler="0 {angle} 0" '
        f'pos="0 {0.036 * side} 0" rgba="0.75 0.76 0.78 1" class="shown"/>'
        for angle in (0, 60, 120)
    )
    grousers = "".join(
        f'<geom type="box" size="{WHEEL.grousers["height_m"] / 2} {WHEEL.width_m / 2} 0.002" '
        f'pos="{(RADIUS - 0.005) * np.cos(a)} 0 {(RADIUS - 0.005) * np.sin(a)}" '
        f'euler="0 {-np.degrees(a)} 0" rgba="0.16 0.16 0.18 1" class="shown"/>'
        for a in np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    )
    return f"""
      <body name="{name}-fork" pos="{end * HALF_BASE} {0.10 * side} -0.10">
        <joint name="{name}-steer" axis="0 0 1" damping="0.5"/>
        <inertial pos="0 0 -0.05" mass="0.3" diaginertia="0.001 0.001 0.0005"/>
        <geom type="capsule" size="0.014" fromto="0 0 0.03 0 {-0.06 * side} -0.03" class="metal"/>
        <geom type="capsule" size="0.014" fromto="0 {-0.06 * side} -0.03 0 {-0.06 * side} -0.13" class="metal"/>
        <body name="{name}" pos="0 0 -0.13">
          <joint name="{name}" axis="0 1 0"/>
          <inertial pos="0 0 0" mass="0.6" diaginertia="0.002 0.0035 0.002"/>
          <geom type="cylinder" size="{WHEEL.radius_m} {WHEEL.width_m / 2}" euler="90 0 0"
                rgba="0.30 0.31 0.33 1" class="shown"/>
          {spokes}{grousers}
        </body>
      </body>"""


def rocker(side_name: str, side: int) -> str:
    """One side: a beam on the body's pivot, with a wheel at each end."""
    wheels = "".join(corner(name) for name, (s, _) in CORNERS.items() if s == side)
    return f"""
    <body name="{side_name}-rocker" pos="0 {side * (HALF_TRACK - 0.10)} 0.02">
      <joint name="{side_name}-rocker" axis="0 1 0" range="-30 30" limited="true" damping="0.2"/>
      <inertial pos="0 0 -0.03" mass="0.7" diaginertia="0.002 0.03 0.03"/>
      <geom type="capsule" size="0.018" fromto="0 0 0 {HALF_BASE} {0.10 * side} -0.07" class="metal"/>
      <geom type="capsule" size="0.018" fromto="0 0 0 {-HALF_BASE} {0.10 * side} -0.07" class="metal"/>
      <geom type="cylinder" size="0.03 0.02" euler="90 0 0" class="metal"/>
      {wheels}
    </body>"""


def model_xml() -> str:
    """The rover and the ground."""
    motors = "".join(
        f'<velocity name="{n}-motor" joint="{n}" kv="200"/>'
        f'<position name="{n}-steering" joint="{n}-steer" kp="200" kv="10"/>'
        for n in CORNERS
    )
    return f"""
<mujoco model="rocker rover">
  <compiler angle="degree"/>
  <option timestep="0.002" integrator="implicitfast" gravity="0 0 -{gr.EARTH_GRAVITY}"/>
  <visual>
    <global offwidth="1600" offheight="1000" fovy="38"/>
    <quality shadowsize="8192" offsamples="8"/>
    <headlight ambient="0.30 0.29 0.28" diffuse="0.15 0.15 0.15" specular="0 0 0"/>
    <map zfar="60" shadowclip="1"/>
  </visual>
  <default>
    <default class="shown"><geom contype="0" conaffinity="0" mass="0"/></default>
    <default class="metal"><geom contype="0" conaffinity="0" mass="0" rgba="0.62 0.64 0.67 1"/></default>
  </default>
  <asset>
    <texture name="sky" type="skybox" builtin="gradient" rgb1="0.72 0.78 0.86" rgb2="0.93 0.91 0.86" width="256" height="256"/>
    <texture name="sand" type="2d" builtin="flat" mark="random" random="0.35" rgb1="0.79 0.68 0.50" markrgb="0.70 0.59 0.42" width="600" height="600"/>
    <material name="sand" texture="sand" texrepeat="1 1" specular="0.05" shininess="0.05" reflectance="0"/>
    <hfield name="sand" nrow="{POINTS}" ncol="{POINTS}" size="{HALF} {HALF} {RISE} 0.2"/>
  </asset>
  <worldbody>
    <light name="sun" directional="true" castshadow="true" pos="-2 -3 6" dir="0.45 0.55 -0.75" diffuse="0.85 0.80 0.72" specular="0.1 0.1 0.1"/>
    <geom name="sand" type="hfield" hfield="sand" material="sand"/>
    <body name="rover" pos="0 0 0">
      <freejoint/>
      <inertial pos="0 0 0.05" mass="7" diaginertia="0.10 0.14 0.18"/>
      <geom type="box" size="0.22 0.15 0.06" pos="0 0 0.07" rgba="0.90 0.90 0.88 1" class="shown"/>
      <geom type="box" size="0.24 0.17 0.008" pos="0 0 0.14" rgba="0.10 0.16 0.32 1" class="shown"/>
      <geom type="cylinder" size="0.014 0.13" pos="0.17 0 0.27" class="metal"/>
      <geom type="box" size="0.025 0.06 0.025" pos="0.18 0 0.41" rgba="0.20 0.20 0.22 1" class="shown"/>
      {rocker("left", 1)}
      {rocker("right", -1)}
    </body>
  </worldbody>
  <equality>
    <joint name="differential" joint1="left-rocker" joint2="right-rocker" polycoef="0 -1 0 0 0"/>
  </equality>
  <actuator>{motors}</actuator>
</mujoco>"""


@dataclass
class Run:
    """Records of the drive, a row for each time."""

    time_s: list[float] = field(default_factory=list)
    position_m: list[Floats] = field(default_factory=list)
    sinkage_mm: list[Floats] = field(default_factory=list)
    slip_ratio: list[Floats] = field(default_factory=list)
    load_n: list[Floats] = field(default_factory=list)
    tracks_m: list[Floats] = field(default_factory=list)


class Traverse:
    """The model, its soil, and the driver."""

    def __init__(self, soil: str = "toyoura", timestep_s: float = 0.002) -> None:
        self.model = mujoco.MjModel.from_xml_string(model_xml())
        self.model.opt.timestep = timestep_s
        self.model.hfield_data[:] = (sand() / RISE).ravel()
        self.data = mujoco.MjData(self.model)
        self.soil = SoilContact(
            self.model, soil=soil, wheels={name: WHEEL for name in CORNERS}, ground="sand"
        )
        self._place()

    def _place(self) -> None:
        """Places the rover on the ground, nose uphill, and lets it sink in."""
        up = np.radians(SLOPE_DEG)
        turned = np.zeros(4)
        mujoco.mju_mulQuat(turned, _turn([0, 0, 1], np.pi / 2), _turn([0, 1, 0], -up))
        z = float(height(*map(np.asarray, START))) + (RADIUS + 0.21) / np.cos(up) + 0.03
        self.data.qpos[:7] = [*START, z, *turned]
        self.soil.step(self.data, round(1.0 / self.model.opt.timestep))

    @property
    def yaw(self) -> float:
        """Heading of the body in the horizontal plane [rad]; π/2 is uphill."""
        forward = self.data.body("rover").xmat.reshape(3, 3)[:, 0]
        return float(np.arctan2(forward[1], forward[0]))

    def drive(self) -> None:
        """Steers up the slope and then along a contour; each wheel has the speed of its position."""
        x, y = self.data.body("rover").xpos[:2]
        # A point ahead: first up the slope, then along the contour.
        reach = 0.6
        ahead = (
            np.array([x + reach, LEVEL_Y])
            if y > LEVEL_Y - reach
            else np.array([START[0], y + reach])
        )
        bearing = np.arctan2(ahead[1] - y, ahead[0] - x) - self.yaw
        bearing = (bearing + np.pi) % (2.0 * np.pi) - np.pi
        curvature = np.clip(2.0 * np.sin(bearing) / np.hypot(*(ahead - [x, y])), -1.4, 1.4)
        for name, (side, end) in CORNERS.items():
            along = 1.0 - curvature * side * HALF_TRACK
            across = curvature * end * HALF_BASE
            self.data.actuator(f"{name}-steering").ctrl[0] = np.arctan2(across, along)
            speed = SPEED_M_S * np.hypot(along, across)
            self.data.actuator(f"{name}-motor").ctrl[0] = speed / RADIUS

    def run(self, duration_s: float, seen: Any = None) -> Run:
        """Drives; `seen` is called with the time and the run at every record, ten a second."""
        run = Run()
        every = round(0.1 / self.model.opt.timestep)
        for sample in range(round(duration_s * 10)):
            self.drive()
            self.soil.step(self.data, every)
            forces = self.soil.forces
            run.time_s.append((sample + 1) / 10)
            run.position_m.append(self.data.body("rover").xpos.copy())
            run.sinkage_mm.append(forces.sinkage_mm.copy())
            run.slip_ratio.append(forces.slip_ratio.copy())
            run.load_n.append(forces.normal_force_n.copy())
            run.tracks_m.append(np.array([self.data.body(name).xpos for name in CORNERS]))
            if seen is not None:
                seen(run.time_s[-1], run)
        return run


def _turn(axis: list[float], angle: float) -> Floats:
    quat = np.zeros(4)
    mujoco.mju_axisAngle2Quat(quat, np.array(axis, dtype=float), angle)
    return quat


class Painter:
    """Pictures of a traverse."""

    def __init__(self, traverse: Traverse, width: int = 1600, tall: int = 1000) -> None:
        self._traverse = traverse
        self._renderer = mujoco.Renderer(traverse.model, tall, width, max_geom=20_000)

    def picture(
        self,
        run: Run,
        lookat: tuple[float, float, float],
        distance: float,
        azimuth: float,
        elevation: float,
    ) -> NDArray[np.uint8]:
        """The rover and its track, seen from a point."""
        camera = mujoco.MjvCamera()
        camera.lookat[:], camera.distance = lookat, distance
        camera.azimuth, camera.elevation = azimuth, elevation
        self._renderer.update_scene(self._traverse.data, camera)
        self._tracks(run)
        image: NDArray[np.uint8] = self._renderer.render().copy()
        return image

    def _tracks(self, run: Run) -> None:
        """Flat dark boxes in the tracks of the wheels; the soil itself has no ruts."""
        scene = self._renderer.scene
        tracks = np.array(run.tracks_m)
        for wheel in range(tracks.shape[1]):
            path = tracks[::3, wheel]
            path[:, 2] = height(path[:, 0], path[:, 1])
            for before, after in zip(path, path[1:]):
                if scene.ngeom >= scene.maxgeom:
                    return
                way = after - before
                length = float(np.linalg.norm(way))
                if length < 1e-6:
                    continue
                middle = 0.5 * (before + after)
                # Flat on the ground: across the track, and parallel to the ground.
                aside = 0.02 * np.array([-way[1], way[0], 0.0]) / length
                left, right = middle + aside, middle - aside
                aside[2] = 0.5 * float(height(left[0], left[1]) - height(right[0], right[1]))
                up = np.cross(way, aside)
                axes = np.stack([way, np.cross(up, way), up], axis=1)
                axes /= np.linalg.norm(axes, axis=0)
                size = np.array([0.52 * length, 0.42 * WHEEL.width_m, 0.003])
                geom = scene.geoms[scene.ngeom]
                color = np.array([0.50, 0.41, 0.29, 1.0], dtype=np.float32)
                mujoco.mjv_initGeom(
                    geom, mujoco.mjtGeom.mjGEOM_BOX, size, middle, axes.ravel(), color
                )
                scene.ngeom += 1


def charts(run: Run, path: Path) -> None:
    """Slip, sinkage and load of every wheel over time."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(3, 1, figsize=(9, 8), sharex=True, layout="constrained")
    rows = (
        ("slip ratio", run.slip_ratio),
        ("sinkage [mm]", run.sinkage_mm),
        ("load [N]", run.load_n),
    )
    for axis, (label, values) in zip(axes, rows):
        axis.plot(run.time_s, np.array(values), label=list(CORNERS))
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
    axes[0].legend(ncols=4, loc="upper right", fontsize="small")
    axes[-1].set_xlabel("time [s]")
    figure.savefig(path, dpi=130)
    plt.close(figure)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("pictures"), help="folder of the pictures")
    parser.add_argument("--duration-s", type=float, default=62.0)
    parser.add_argument("--timestep-s", type=float, default=0.002)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)

    import matplotlib.pyplot as plt

    traverse = Traverse(timestep_s=arguments.timestep_s)
    painter = Painter(traverse)
    shown = {
        "climb.png": (13.0, 1.9, 128.0, -16.0),
        "turn.png": (30.0, 2.2, 155.0, -22.0),
        "cross.png": (52.0, 1.9, 115.0, -14.0),
    }

    def seen(time_s: float, run: Run) -> None:
        for name, (when, distance, azimuth, elevation) in shown.items():
            if abs(time_s - when) < 0.01:
                lookat = tuple(traverse.data.body("rover").xpos - [0.0, 0.0, 0.08])
                image = painter.picture(run, lookat, distance, azimuth, elevation)
                plt.imsave(arguments.out / name, image)

    run = traverse.run(arguments.duration_s, seen)
    whole = painter.picture(run, (-0.2, -0.7, 0.45), 6.2, 110.0, -32.0)
    plt.imsave(arguments.out / "whole.png", whole)
    charts(run, arguments.out / "wheels.png")
    way = np.array(run.position_m)
    climbed = way[-1] - way[0]
    print(f"climbed {climbed[2]:.2f} m, crossed {climbed[0]:.2f} m")
    late = way[np.array(run.time_s) > arguments.duration_s - 15.0]
    print(f"held its contour within {100 * np.ptp(late[:, 1]):.1f} cm over the last 15 s")
    print(f"mean slip {np.mean(run.slip_ratio):.3f}, sinkage {np.mean(run.sinkage_mm):.1f} mm")


if __name__ == "__main__":
    main()
