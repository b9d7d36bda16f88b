"""Twins of public data sets, whose soil is known, through the examples that read the real ones."""

from __future__ import annotations

import csv
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

import grouser as gr

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
SIX = {"LF": "front-left", "LM": "middle-left", "LR": "rear-left"}
SIX |= {it.replace("L", "R", 1): name.replace("left", "right") for it, name in SIX.items()}
#: The columns of PLACES.
PLACES = (
    "frame,site,drive,pose,landing_x,landing_y,landing_z,northing,easting,planetocentric_latitude,"
    "planetodetic_latitude,longitude,elevation,map_pixel_line,map_pixel_sample,dem_pixel_line,"
    "dem_pixel_sample,roll,pitch,yaw,quat_s,quat_v1,quat_v2,quat_v3,sclk,sol"
).split(",")


def converted(name: str, *arguments: Path) -> None:
    subprocess.run([sys.executable, EXAMPLES / name, *map(str, arguments)], check=True)


def write(path: Path, names: list[str], rows: list[dict[str, Any]]) -> None:
    with path.open("w", newline="") as file:
        table = csv.DictWriter(file, names, restval="0")
        table.writeheader()
        table.writerows(rows)


def driven(rover: str, soil: str, slope_deg: float, yaw_deg: float, **changes: Any) -> gr.Trajectory:
    start = {"yaw_deg": yaw_deg}
    settings = {"rover": rover, "soil": soil, "model": "ishigami", "slope_deg": slope_deg}
    run = gr.simulate(**settings, start=start, **changes)
    assert isinstance(run, gr.Trajectory)
    return run


def standing(slope_deg: float, yaw_deg: float) -> tuple[float, float]:
    """Roll with the right side down, and pitch with the nose up [rad]."""
    slope, yaw = math.radians(slope_deg), math.radians(yaw_deg)
    pitch = math.asin(math.sin(yaw) * math.sin(slope))
    return math.asin(math.cos(yaw) * math.sin(slope) / math.cos(pitch)), pitch


def traverse(folder: Path, slope_deg: float, yaw_deg: float) -> None:
    """The sensors of BASEPROD over a run: uphill is north, y of the run."""
    run = driven("sojourner", "toyoura", slope_deg, yaw_deg, duration_s=60.0)
    stamps = [int((1.7e9 + time) * 1e9) for time in run.time_s]
    tilt = math.radians(slope_deg)
    fixes, imu, fog, frames = [], [], [], []
    for k, stamp in enumerate(stamps):
        at = {"Timestamp": stamp}
        yaw = math.radians(run.yaw_deg[k])
        roll, pitch = standing(slope_deg, run.yaw_deg[k])
        north, up = run.y_m[k] * math.cos(tilt), run.y_m[k] * math.sin(tilt)
        # Headings are those over the map: of the body's x, seen from above.
        heading = math.atan2(math.sin(yaw) * math.cos(tilt), math.cos(yaw))
        fixes.append({**at, "UTM_Easting": run.x_m[k], "UTM_Northing": north, "Altitude": up})
        # The IMU stands half a turn from the body, and its positive rotation about y lowers the nose.
        imu.append({**at, "Angle_X": -roll, "Angle_Y": pitch})
        fog.append({**at, "Angle_Z": heading})
        for wheel, name in SIX.items():
            place = list(run.wheel_names).index(name)
            speed = run.wheel["wheel_speed_rad_s"][k, place]
            angle = speed * run.time_s[k] * (-1.0 if wheel.startswith("R") else 1.0)
            for link, turn in (("DRV", angle), ("STR", 0.0)):
                half = {"QZ": math.sin(turn / 2), "QW": math.cos(turn / 2)}
                frames.append({**at, "Child_Frame_ID": f"link_{link}_{wheel}", **half})
    folder.mkdir()
    for name, rows in (("GNSS", fixes), ("IMU", imu), ("FOG_CORRECTED", fog), ("TF", frames)):
        write(folder / f"{name}.csv", list(rows[0]), rows)


def test_a_twin_of_baseprod_ranks_the_model_that_made_it_first(tmp_path: Path) -> None:
    rover = tmp_path / "rover.toml"
    text = gr.Rover("sojourner").to_toml()
    for wheel, name in SIX.items():
        text = text.replace(f'name = "{name}"', f'name = "{wheel}"')
    rover.write_text(text)
    drives = tmp_path / "drives"
    drives.mkdir()
    for k, (slope, yaw) in enumerate([(0, 0), (5, 90), (8, 90), (8, -90), (5, 0), (10, 0), (8, 45)]):
        traverse(tmp_path / f"{k}", slope, yaw)
        converted("baseprod.py", tmp_path / f"{k}", drives / f"{k}.csv")
    found = gr.validate_drives(drives, "toyoura", rover, mapping="baseprod")
    assert found.models[0] == "ishigami", found.sentences
    best = np.asarray(found.rows["prediction"]) == "ishigami"
    assert np.nanmax(np.asarray(found.rows["score"], dtype=float)[best]) < 0.2
    assert found.plot().get_ylabel() and len(found.to_pandas()) == len(found.cells["model"])
    assert repr(found).startswith("<DriveValidation of 7 drives")


def test_a_twin_of_the_positions_on_mars_ranks_the_model_that_made_it_first(tmp_path: Path) -> None:
    steps: tuple[list[dict[str, Any]], list[dict[str, Any]]] = ([], [])
    for site, (slope_deg, yaw_deg) in enumerate(
        [(5.0, 90.0), (10.0, 90.0), (15.0, 90.0), (10.0, -90.0), (15.0, -90.0)]
    ):
        mars = {"gravity_m_s2": gr.MARS_GRAVITY, "duration_s": 60.0}
        run = driven("curiosity", "mars-regolith", slope_deg, yaw_deg, **mars)
        slip = float(np.mean(run.wheel["slip_ratio"][-1]))
        roll, pitch = standing(slope_deg, yaw_deg)
        slope, yaw = math.radians(slope_deg), math.radians(yaw_deg)
        north, east = math.sin(yaw) * math.cos(slope), math.cos(yaw)
        compass = math.degrees(math.atan2(east, north))
        at = {"frame": "ROVER", "site": site + 1, "pose": 0, "sol": site, "yaw": compass}
        at |= {"roll": math.degrees(roll), "pitch": math.degrees(pitch)}
        for step in range(12):
            for rows, way in zip(steps, (1.0, 1.0 - slip if slip > 0.0 else 1.0 / (1.0 + slip))):
                here = [round(step * way * it, 3) for it in (north, east, -math.sin(pitch))]
                place = dict(zip(("landing_x", "landing_y", "landing_z"), here))
                rows.append({**at, **place, "drive": 2 * step, "sclk": 4e8 + 1e4 * site + 40 * step})
        for rows in steps:
            rows.append({**at, "frame": "SITE", "drive": -1, "pose": -1})
    names = [tmp_path / name for name in ("telemetry.csv", "localized_interp.csv")]
    for name, rows in zip(names, steps):
        write(name, PLACES, rows)
    converted("places.py", *names, tmp_path / "steps.csv")
    errors = {}
    for model in ("ishigami", "bekker", "rft"):
        mars = {"gravity_m_s2": gr.MARS_GRAVITY, "model": model}
        found = gr.validate_slopes(tmp_path / "steps.csv", "mars-regolith", "curiosity", **mars)
        errors[model] = found.overall["slip_ratio"]["rmse"]
    assert errors["ishigami"] < 1e-3 < min(errors["bekker"], errors["rft"]), errors
