"""Slip over slope, of a Mars rover's own positions beside those that its images were matched to.

python places.py telemetry.csv localized_interp.csv OUT.csv, of the PLACES archive of a rover:
docs/guide/telemetry.md, Public data sets.
"""

import csv
import math
import sys

Row = dict[str, str]
raw, corrected, out = sys.argv[1:]


def read(name: str) -> dict[tuple[int, int, int], Row]:
    with open(name) as file:
        rows = [row for row in csv.DictReader(file) if row["frame"] == "ROVER"]
    return {(int(row["site"]), int(row["drive"]), int(row["pose"])): row for row in rows}


def place(row: Row) -> list[float]:
    return [float(row[f"landing_{axis}"]) for axis in "xyz"]


def angles(row: Row) -> list[float]:
    return [math.radians(float(row[name])) for name in ("roll", "pitch", "yaw")]


raw, corrected = read(raw), read(corrected)
known = sorted(raw.keys() & corrected.keys())
with open(out, "w") as file:
    print("slope_deg,course_deg,slip_ratio", file=file)
    for one, other in zip(known, known[1:]):
        ways = [math.dist(place(of[one]), place(of[other])) for of in (raw, corrected)]
        (_, _, before), (roll, pitch, yaw) = angles(corrected[one]), angles(corrected[other])
        slope = math.acos(math.cos(roll) * math.cos(pitch))
        turn = abs((yaw - before + math.pi) % math.tau - math.pi)
        # A step long enough to be measured, straight on, on a slope.
        if one[0] != other[0] or ways[0] < 0.3 or turn > 0.1 or slope < math.radians(2.5):
            continue
        north, east, _ = (a - b for a, b in zip(place(raw[other]), place(raw[one])))
        ahead = 1.0 if north * math.cos(yaw) + east * math.sin(yaw) > 0.0 else -1.0
        course = math.asin(max(-1.0, min(1.0, ahead * math.sin(pitch) / math.sin(slope))))
        # Rows of one slope and one course repeat each other.
        slope, course = (s * round(math.degrees(it) / s) for it, s in ((slope, 2.5), (course, 15)))
        print(slope, course, round((ways[0] - ways[1]) / max(ways), 5), sep=",", file=file)
