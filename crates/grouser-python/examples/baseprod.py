"""Joins the sensors of a traverse of BASEPROD at the times of its position fixes.

python baseprod.py FOLDER OUT.csv, where FOLDER has the traverse's CSV files. The table is read with
the mapping baseprod: docs/guide/telemetry.md, Public data sets.
"""

import csv
import math
import sys
from bisect import bisect
from collections.abc import Callable, Iterable, Iterator

Row = dict[str, str]
#: Times [s], each with a number.
Track = list[tuple[float, float]]
folder, out = sys.argv[1:]
WHEELS = ["LF", "LM", "LR", "RF", "RM", "RR"]


def read(name: str, numbers: Callable[[Row], Iterable[tuple[str, float]]]) -> dict[str, Track]:
    """Numbers over time [s], each with its name; angles go on over the end of a turn."""
    tracks: dict[str, Track] = {}
    with open(f"{folder}/{name}.csv") as file:
        for row in csv.DictReader(file):
            for key, value in numbers(row):
                track = tracks.setdefault(key, [])
                if track and not key.startswith("pos"):
                    value -= math.tau * round((value - track[-1][1]) / math.tau)
                track.append((int(row["Timestamp"]) / 1e9, value))
    return tracks


def turned(row: Row) -> Iterator[tuple[str, float]]:
    """The angle of a joint, and its name: frames of wheels have their axes to the outside."""
    kind, _, wheel = row["Child_Frame_ID"].removeprefix("link_").partition("_")
    if wheel in WHEELS and kind in ("DRV", "STR"):
        sign = -1.0 if kind == "DRV" and wheel.startswith("R") else 1.0
        angle = 2.0 * math.atan2(float(row["QZ"]), float(row["QW"]))
        yield ("drive/" if kind == "DRV" else "steer/") + wheel, sign * angle


def at(track: Track, time: float) -> float | None:
    """What a track has between its readings, which are less than a second apart."""
    place = bisect(track, (time,))
    if not 0 < place < len(track) or track[place][0] - track[place - 1][0] > 1.0:
        return None
    (t0, v0), (t1, v1) = track[place - 1 : place + 1]
    return v0 + (v1 - v0) * (time - t0) / (t1 - t0)


def quaternion(roll: float, pitch: float, yaw: float) -> list[float]:
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(a / 2), math.cos(a / 2)) for a in (roll, pitch, yaw))
    x, y = sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy
    return [x, y, cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy]


places = {"pos_x": "UTM_Easting", "pos_y": "UTM_Northing", "pos_z": "Altitude"}
fixes = read("GNSS", lambda row: ((key, float(row[name])) for key, name in places.items()))
# The IMU stands half a turn about the vertical from the body.
tracks = read("IMU", lambda row: (("roll", -float(row["Angle_X"])), ("pitch", -float(row["Angle_Y"]))))
tracks |= read("FOG_CORRECTED", lambda row: [("yaw", float(row["Angle_Z"]))])
tracks |= read("TF", turned)
turns = [f"{kind}/{wheel}" for kind in ("drive", "steer") for wheel in WHEELS]
with open(out, "w") as file:
    print(*["time_s", *places, *(f"quat_{it}" for it in "xyzw"), *turns], sep=",", file=file)
    for (time, x), (_, y), (_, z) in zip(*fixes.values()):
        found = (at(tracks[it], time) for it in ("roll", "pitch", "yaw"))
        attitude = [it for it in found if it is not None]
        if len(attitude) == 3:
            angles = [at(tracks.get(it, []), time) for it in turns]
            cells = [time, x, y, z, *quaternion(*attitude), *angles]
            print(*("" if it is None else it for it in cells), sep=",", file=file)
