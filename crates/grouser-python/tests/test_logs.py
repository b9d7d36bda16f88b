"""Logs of the program, read by the readers of others: mcap, Foxglove's schemas, Rerun."""

from __future__ import annotations

import csv
import itertools
import math
import os
import re
import subprocess
import sys
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from conftest import Program
from numpy.typing import NDArray

pytest.importorskip("mcap")
pytest.importorskip("mcap_protobuf")

from google.protobuf.descriptor_pb2 import FileDescriptorSet
from google.protobuf.message import DecodeError
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

Floats = NDArray[np.float64]
#: Rovers with four wheels, with six, and one with four whose wheels are steered; and missions.
RUNS = {
    "hakuto": ["traverse", "--slope-deg", "15", "--yaw-deg", "9.56", "--duration-s", "3"],
    "six wheels": ["traverse", "--rover", "curiosity", "--duration-s", "2"],
    "steered": [
        "traverse",
        *(part for k in range(4) for part in ("--set", f"rover.mount.{k}.steering_deg={10 - 5 * k}")),
        *("--duration-s", "2"),
    ],
    "backward": ["traverse", "reverse", "--duration-s", "2"],
    "no time": ["traverse", "--duration-s", "0.001"],
    "sliding": ["traverse", "--slope-deg", "36", "--duration-s", "10"],
    "mission": ["mission", "there-and-back", "--nominal"],
    "mission of six wheels": [
        *("mission", "arc", "--rover", "curiosity", "--soil", "mars-sand", "--gravity-m-s2", "mars"),
        *("--simulation", "quasi-steady", "--nominal"),
    ],
    "stopped mission": ["mission", "slip-check", "--slope-deg", "14", "--nominal"],
    "mission that backs out": ["mission", "back-out", "--nominal"],
    "mission that slides": ["mission", "there-and-back", "--slope-deg", "36", "--nominal"],
}
MISSIONS = [name for name, (command, *_) in RUNS.items() if command == "mission"]
#: Levels of events.
INFO, WARNING, ERROR = 2, 3, 4


class Log:
    """A log with the program's own answer about the same run or mission."""

    def __init__(
        self, path: Path, answer: dict[str, Any], records: list[dict[str, Any]], flags: set[str]
    ) -> None:
        self.path, self.answer, self.records, self.flags = path, answer, records, flags
        #: What was driven: the scenario of a run, or the mission.
        (self.document,) = answer["inputs"].values()
        self.messages: dict[str, list[tuple[int, Any]]] = {}
        self.schemas: dict[str, bytes] = {}
        self.attached: dict[str, bytes] = {}
        #: Topics and times of all messages, in the order in which they were written.
        self.written: list[tuple[str, int]] = []
        with path.open("rb") as file:
            reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
            for schema, channel, message in reader.iter_messages(log_time_order=False):
                assert schema is not None
                self.schemas[schema.name] = schema.data
                data: Any = message.data
                if channel.message_encoding == "protobuf":
                    decoder = DecoderFactory().decoder_for("protobuf", schema)
                    assert decoder is not None
                    data = decoder(message.data)
                self.messages.setdefault(channel.topic, []).append((message.log_time, data))
                self.written.append((channel.topic, message.log_time))
            self.summary = reader.get_summary()
            self.attached = {it.name: it.data for it in reader.iter_attachments()}

    def of(self, topic: str) -> list[Any]:
        return [message for _, message in self.messages[topic]]


def cell_of(text: str) -> Any:
    """A cell of the program's CSV: a number, and a text where it is none."""
    try:
        return float(text)
    except ValueError:
        return text


def records_of(path: Path, mounts: list[dict[str, Any]]) -> tuple[list[dict[str, Any]], set[str]]:
    """The records of the program's CSV in the shape of its JSON: a list for the wheels, which is
    empty where a rover has none any more. And the flags of all."""
    records: list[dict[str, Any]] = []
    flags: set[str] = set()
    for row in csv.DictReader(path.read_text("utf-8").splitlines()):
        record: dict[str, Any] = {name: cell_of(cell) for name, cell in row.items() if "." not in name}
        flags |= {flag for flag in row["flags"].split(";") if flag}
        record["wheels"] = []
        for mount in mounts:
            start = f"{mount['name']}."
            cells = {name: cell for name, cell in row.items() if name.startswith(start)}
            if any(cells.values()):
                values = {name.removeprefix(start): float(cell) for name, cell in cells.items()}
                record["wheels"].append({"wheel": mount["name"], **values})
        records.append(record)
    return records, flags


#: Logs by their names: each is made once.
_MADE: dict[str, Log] = {}


def made(name: str, program: Program, tmp_path_factory: Any) -> Log:
    if name in _MADE:
        return _MADE[name]
    folder = tmp_path_factory.mktemp("log")
    path, results = folder / "run.mcap", folder / "results"
    answer = program(*RUNS[name], "--mcap", str(path), "--out", str(results))
    if name in MISSIONS:
        rover = answer["inputs"]["mission"]["rover"]
        records, flags = records_of(results / "records.csv", rover["mount"])
    else:
        records, flags = answer["samples"], set(answer["flags"])
    return _MADE.setdefault(name, Log(path, answer, records, flags))


@pytest.fixture(scope="module", params=RUNS)
def log(request: pytest.FixtureRequest, program: Program, tmp_path_factory: Any) -> Log:
    return made(request.param, program, tmp_path_factory)


@pytest.fixture(scope="module", params=MISSIONS)
def mission(request: pytest.FixtureRequest, program: Program, tmp_path_factory: Any) -> Log:
    return made(request.param, program, tmp_path_factory)


@pytest.fixture(scope="module")
def there_and_back(program: Program, tmp_path_factory: Any) -> Log:
    return made("mission", program, tmp_path_factory)


def mounts(log: Log) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = log.document["rover"]["mount"]
    return found


def matrix(rotation: Any) -> Floats:
    """The matrix of a quaternion, by its definition."""
    x, y, z, w = rotation.x, rotation.y, rotation.z, rotation.w
    assert abs(x * x + y * y + z * z + w * w - 1.0) < 1e-12
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def about(axis: int, angle: float) -> Floats:
    """The rotation about an axis of the coordinates [rad]."""
    sin, cos = math.sin(angle), math.cos(angle)
    j, k = (axis + 1) % 3, (axis + 2) % 3
    result = np.eye(3)
    result[j, j] = result[k, k] = cos
    result[j, k], result[k, j] = -sin, sin
    return result


def vector(message: Any) -> Floats:
    return np.array([message.x, message.y, message.z])


def same(a: Floats, b: Floats) -> bool:
    return bool(np.max(np.abs(a - b)) < 1e-9)


def test_there_is_a_message_for_every_record(log: Log) -> None:
    counts = Counter({topic: len(messages) for topic, messages in log.messages.items()})
    with_wheels = sum(bool(record["wheels"]) for record in log.records)
    for topic in ("/rover", "/tf", "/scene/forces"):
        assert counts[topic] == len(log.records), topic
    wheels = [topic for topic in counts if topic.startswith("/wheels/")]
    assert len(wheels) == len(mounts(log))
    assert all(counts[topic] == with_wheels for topic in wheels)
    for topic in ("/tf_static", "/robot_description", "/scene/rover"):
        assert counts[topic] == 1, topic
    assert log.summary is not None and log.summary.statistics is not None
    assert log.summary.statistics.message_count == counts.total()
    times = [time for time, _ in log.messages["/rover"]]
    assert times == [round(1e9 * record["time_s"]) for record in log.records]


def test_every_number_is_that_of_the_program(log: Log) -> None:
    columns = {name for name, value in log.records[0].items() if isinstance(value, float | int)}
    for record, message in zip(log.records, log.of("/rover"), strict=True):
        written = {field.name: getattr(message, field.name) for field in message.DESCRIPTOR.fields}
        assert written.keys() == columns
        assert all(written[name] == record[name] for name in columns)
    for index, mount in enumerate(mounts(log)):
        recorded = [record["wheels"][index] for record in log.records if record["wheels"]]
        for wheel, message in zip(recorded, log.of(f"/wheels/{mount['name']}"), strict=True):
            written = {field.name: getattr(message, field.name) for field in message.DESCRIPTOR.fields}
            # A log says of every wheel how it is steered, once some wheel is.
            if "steering_deg" not in wheel:
                assert written.pop("steering_deg", 0.0) == 0.0
            assert {"wheel": mount["name"], **written} == wheel
            assert all(math.isfinite(value) for value in written.values())


def test_transforms_are_the_poses_of_the_records(log: Log) -> None:
    (static,) = log.of("/tf_static")
    (ground,) = static.transforms
    assert (ground.parent_frame_id, ground.child_frame_id) == ("world", "slope")
    assert same(matrix(ground.rotation), about(0, math.radians(log.document["slope_deg"])))
    common = log.document["rover"]["wheel_unit"]["wheel"]
    turned = [0.0] * len(mounts(log))
    before: dict[str, Any] | None = None
    for record, message in zip(log.records, log.of("/tf"), strict=True):
        body, *wheels = message.transforms
        seconds = body.timestamp.seconds + 1e-9 * body.timestamp.nanos
        assert abs(seconds - record["time_s"]) < 1e-9
        assert (body.parent_frame_id, body.child_frame_id) == ("slope", "body")
        assert same(vector(body.translation)[:2], np.array([record["x_m"], record["y_m"]]))
        assert same(matrix(body.rotation), about(2, math.radians(record["yaw_deg"])))
        assert len(wheels) == 2 * len(mounts(log))
        # The record of a rover that has just tipped over, or sunk, has no wheels.
        for index, wheel in enumerate(record["wheels"]):
            mount, (hub, rim) = mounts(log)[index], wheels[2 * index : 2 * index + 2]
            own = {**common, **mount.get("wheel", {})}
            radius = own["radius_m"] + own.get("grousers", {}).get("height_m", 0.0)
            assert (hub.parent_frame_id, hub.child_frame_id) == ("body", mount["name"])
            # The hub is as high over the ground as the wheel's radius, less what is in the soil.
            height = body.translation.z + hub.translation.z
            assert abs(height - (radius - 1e-3 * wheel["sinkage_mm"])) < 1e-9
            assert same(vector(hub.translation)[:2], np.array(mount["position_m"][:2]))
            steering = math.radians(mount.get("steering_deg", 0.0))
            assert same(matrix(hub.rotation), about(2, steering))
            if before is not None:
                speeds = wheel["wheel_speed_rad_s"] + before["wheels"][index]["wheel_speed_rad_s"]
                turned[index] += 0.5 * speeds * (record["time_s"] - before["time_s"])
            assert rim.parent_frame_id == hub.child_frame_id
            assert same(matrix(rim.rotation), about(1, turned[index]))
        before = record


def test_the_scene_is_the_rover_on_its_ground(log: Log) -> None:
    (scene,) = log.of("/scene/rover")
    body, *wheels = scene.entities
    common = log.document["rover"]["wheel_unit"]["wheel"]
    assert (body.frame_id, len(wheels)) == ("body", len(mounts(log)))
    for entity, mount in zip(wheels, mounts(log), strict=True):
        own = {**common, **mount.get("wheel", {})}
        (rim,) = entity.cylinders
        diameter = 2.0 * own["radius_m"]
        assert same(vector(rim.size), np.array([diameter, diameter, own["width_m"]]))
        # Its axle is the wheel's y.
        assert same(np.abs(matrix(rim.pose.orientation)[:, 2]), np.array([0.0, 1.0, 0.0]))
        outer = [math.hypot(it.pose.position.x, it.pose.position.z) + 0.5 * it.size.z for it in entity.cubes]
        assert abs(max(outer) - (own["radius_m"] + own.get("grousers", {}).get("height_m", 0.0))) < 1e-9
        assert entity.frame_locked and entity.lifetime.ToNanoseconds() == 0
        (last,) = log.of("/tf")[-1:]
        assert entity.frame_id in {it.child_frame_id for it in last.transforms}
    (plane,) = log.of("/scene/ground")[-1].entities[0].triangles
    corners = np.array([vector(point) for point in plane.points])
    ways = np.array([[record["x_m"], record["y_m"]] for record in log.records])
    assert np.all(corners[:, :2].min(axis=0) < ways.min(axis=0))
    assert np.all(corners[:, :2].max(axis=0) > ways.max(axis=0))
    assert np.all(corners[:, 2] == 0.0)
    for message in log.of("/scene/path") if "/scene/path" in log.messages else []:
        points = [vector(point)[:2] for point in message.entities[0].lines[0].points]
        assert len(points) > 1
        assert all(np.min(np.linalg.norm(ways - point, axis=1)) < 1e-9 for point in points)


def test_arrows_are_the_forces_of_the_soil(log: Log) -> None:
    for record, message in zip(log.records, log.of("/scene/forces"), strict=True):
        for index, wheel in enumerate(record["wheels"]):
            entity = message.entities[index]
            (arrow,) = entity.arrows
            (scale,) = (float(it.value) for it in entity.metadata if it.key == "n_per_m")
            along = matrix(arrow.pose.orientation)[:, 0]
            force = scale * (arrow.shaft_length + arrow.head_length) * along
            names = ("drawbar_pull_n", "side_force_n", "normal_force_n")
            assert same(force, np.array([wheel[name] for name in names]))
    end = log.of("/scene/forces")[-1].entities
    assert len(end) == len(mounts(log))


def test_the_end_is_an_event_and_the_document_is_attached(log: Log) -> None:
    (kind,), results = log.answer["inputs"], log.answer
    name = {"scenario": "run", "mission": "mission"}[kind]
    (end,) = [event for event in log.of("/events") if event.name == name]
    assert end.message.startswith(results["outcome"].replace("_", " "))
    if kind == "scenario":
        assert (end.level == INFO) == (results["outcome"] == "completed")
    flags = [it.message.split(":")[0] for it in log.of("/events") if it.name == "validity"]
    assert sorted(flags) == sorted(log.flags)
    assert b"[rover]" in log.attached[f"{kind}.toml"]


@dataclass
class LoggedLeg:
    """What a log says of a leg [s]."""

    began: float
    ended: float
    backed_out: float | None


def legs_of(log: Log) -> list[LoggedLeg]:
    """The legs of a mission by their events, each checked against the program's answer."""
    level = {"completed": INFO, "stopped": WARNING}
    events = [(time * 1e-9, it) for time, it in log.messages["/events"] if it.name.startswith("leg ")]
    found = []
    for leg in log.answer["legs"]:
        name = f"leg {leg['leg']}"
        own = [(time, event) for time, event in events if event.name == name]
        backed_out = leg["back_out"] is not None
        assert len(own) == 2 + backed_out
        (began, first), (ended, second) = own[:2]
        assert (first.level, first.message) == (INFO, f"began: {leg['manoeuvre']}")
        became = leg["outcome"] + ("" if leg["reason"] is None else f": {leg['reason']}")
        way = f"{leg['distance_m']:.3f} m in {leg['time_s']:.1f} s with {leg['energy_j']:.1f} J"
        assert second.message == f"{became}; {way}"
        assert second.level == level.get(leg["outcome"], ERROR)
        if backed_out:
            _, third = own[2]
            assert third.message.startswith(f"backed out by {leg['back_out_m']:.3f} m in ")
            assert third.level == level.get(leg["back_out"], ERROR)
        found.append(LoggedLeg(began, ended, own[2][0] if backed_out else None))
    assert len(events) == sum(3 if leg.backed_out else 2 for leg in found), "others were not begun"
    return found


#: How far a rover can be from the straight way between two records: its speed changes by less than
#: 0.1 m/s, or 5°/s, within the tenth of a second between them.
NEAR_M, NEAR_DEG = 0.25 * 0.1 * 0.1, 0.25 * 0.1 * 5.0


def pose_at(log: Log, time: float) -> tuple[float, float, float]:
    """Place [m] and yaw [°] at a time [s] by the transforms: a leg ends between two of them."""
    times = np.array([1e-9 * at for at, _ in log.messages["/tf"]])
    bodies = [message.transforms[0] for message in log.of("/tf")]
    turns = [matrix(body.rotation) for body in bodies]
    yaws = np.degrees(np.unwrap([math.atan2(it[1, 0], it[0, 0]) for it in turns]))
    x, y = (np.array([getattr(body.translation, axis) for body in bodies]) for axis in "xy")
    first = math.radians(log.records[0]["yaw_deg"])
    assert same(turns[0], about(2, first))
    yaws += math.degrees(first) - yaws[0]
    return tuple(float(np.interp(time, times, values)) for values in (x, y, yaws))  # type: ignore[return-value]


def test_legs_are_events_in_the_order_in_which_they_were_driven(mission: Log) -> None:
    legs = legs_of(mission)
    assert legs[0].began == 0.0
    for before, leg in itertools.pairwise(legs):
        assert leg.began == (before.backed_out or before.ended)
    for leg, answer in zip(legs, mission.answer["legs"], strict=True):
        assert abs(leg.ended - leg.began - answer["time_s"]) < 2e-9
        x, y, yaw = pose_at(mission, leg.ended)
        assert math.hypot(x - answer["x_m"], y - answer["y_m"]) < NEAR_M
        assert abs(yaw - answer["yaw_deg"]) < NEAR_DEG
    last, final = legs[-1], mission.answer["final"]
    assert abs((last.backed_out or last.ended) - final["time_s"]) < 1e-9
    (end,) = [time for time, event in mission.messages["/events"] if event.name == "mission"]
    assert end == mission.messages["/rover"][-1][0] == round(1e9 * final["time_s"])


def test_a_mission_is_written_as_time_goes_on(mission: Log) -> None:
    """So that a log that breaks off has all that was before."""
    times = [time for topic, time in mission.written if topic != "/tf"]
    assert times == sorted(times)
    frames = [time for topic, time in mission.written if topic == "/tf"]
    assert frames == sorted(frames)
    (*_, last) = mission.messages["/events"]
    assert last[1].name == "mission"


def test_the_path_of_a_mission_is_that_of_its_records(mission: Log) -> None:
    """Each record is near the line; how far its points are apart is for the log to say."""
    if "/scene/path" not in mission.messages:
        assert mission.answer["outcome"] == "sliding"
        return
    (entity,) = mission.of("/scene/path")[-1].entities
    assert entity.frame_id == "slope"
    (line,) = entity.lines
    points = np.array([vector(point)[:2] for point in line.points])
    ways = np.array([[record["x_m"], record["y_m"]] for record in mission.records])
    assert same(points[0], ways[0]) and len(points) <= 256
    apart = np.linalg.norm(np.diff(points, axis=0), axis=1)
    # Every record is on the way from one point to the next, or on to one that is not yet drawn.
    nearest = np.linalg.norm(ways[:, None] - points[None], axis=2).min(axis=1)
    assert nearest.max() <= apart.max()
    # Each message is the line up to its time: the one before with one point more, or every other one.
    drawn = [len(it.entities[0].lines[0].points) for it in mission.of("/scene/path")]
    assert all(after == before + 1 or after < before for before, after in itertools.pairwise(drawn))
    (time, _) = mission.messages["/scene/path"][-1]
    assert same(points[-1], vector(body_at(mission, time * 1e-9).translation)[:2])


def body_at(log: Log, time: float) -> Any:
    """The transform of the body at a time [s]."""
    _, message = min(log.messages["/tf"], key=lambda it: abs(1e-9 * it[0] - time))
    return message.transforms[0]


def test_transforms_lead_through_the_legs(mission: Log) -> None:
    """From leg to leg nothing jumps: no rover here is faster than 0.2 m/s, and its yaw rate is below
    10°/s, unless it slides."""
    if mission.answer["outcome"] == "sliding":
        assert [it["outcome"] for it in mission.answer["legs"]] == ["sliding"]
        return
    for (before, one), (after, other) in itertools.pairwise(mission.messages["/tf"]):
        seconds = 1e-9 * (after - before)
        assert seconds > 0.0
        way = vector(other.transforms[0].translation) - vector(one.transforms[0].translation)
        assert np.linalg.norm(way[:2]) <= 0.2 * seconds
        turn = matrix(one.transforms[0].rotation).T @ matrix(other.transforms[0].rotation)
        assert abs(math.degrees(math.atan2(turn[1, 0], turn[0, 0]))) <= 10.0 * seconds


def test_a_turn_on_the_spot_is_seen_in_the_transforms(there_and_back: Log) -> None:
    log = there_and_back
    _, turn, back = legs_of(log)
    assert log.document["leg"][1]["turn_deg"] == 90.0

    def during(leg: LoggedLeg) -> list[Any]:
        times = (leg.began - 1e-9, leg.ended + 1e-9)
        return [it.transforms for time, it in log.messages["/tf"] if times[0] <= 1e-9 * time <= times[1]]

    def turned(frames: list[Any], frame: str) -> Floats:
        """Angles of a frame [°]: of the body about z, of a rim about y, without jumps."""
        (place,) = (k for k, it in enumerate(frames[0]) if it.child_frame_id == frame)
        all_of_them = [matrix(it[place].rotation) for it in frames]
        i, j = (1, 0) if frame == "body" else (0, 2)
        return np.degrees(np.unwrap([math.atan2(it[i, j], it[j, j]) for it in all_of_them]))

    frames = during(turn)
    yaws = turned(frames, "body")
    # The first and the last of them are up to a tenth of a second within the turn.
    began, ended = (leg["yaw_deg"] for leg in log.answer["legs"][:2])
    # A manoeuvre ends within 1e-7 rad of where it should.
    assert abs(ended - began - 90.0) <= math.degrees(1e-7)
    assert began < yaws[0] < began + 1.0 and ended - 1.0 < yaws[-1] < ended
    # To the left all the time, but for hundredths of a degree where the turn keeps its place.
    assert np.diff(yaws).min() > -0.05
    places = places_of(frames)
    assert np.linalg.norm(places - places[0], axis=1).max() < 0.2, "a third of its length"
    # Uphill wheels, on the left, turn backward and those on the right forward; then all go back.
    names = [(mount["name"], math.copysign(1.0, -mount["position_m"][1])) for mount in mounts(log)]
    assert sorted(side for _, side in names) == [-1.0, -1.0, 1.0, 1.0]
    for name, side in names:
        rim = turned(frames, f"{name}_rim")
        assert side * (rim[-1] - rim[0]) > 90.0, name
        rim = turned(during(back), f"{name}_rim")
        assert rim[-1] - rim[0] < -90.0, name
    heading = np.diff(places_of(during(back))[[0, -1]], axis=0)[0]
    nose = np.array([math.cos(math.radians(yaws[-1])), math.sin(math.radians(yaws[-1]))])
    assert heading @ nose < -0.95, "a metre back, of which some is drift"


def places_of(frames: list[Any]) -> Floats:
    return np.array([vector(it[0].translation)[:2] for it in frames])


def test_the_model_of_the_rover_has_the_frames_of_the_transforms(log: Log) -> None:
    (data,) = log.of("/robot_description")
    text = data[8 : 8 + int.from_bytes(data[4:8], "little") - 1].decode()
    model = ElementTree.fromstring(text)
    links = {link.get("name") for link in model.iter("link")}
    frames = {it.child_frame_id for it in log.of("/tf")[0].transforms}
    assert links == frames
    masses = [float(mass.get("value", "nan")) for mass in model.iter("mass")]
    rover = log.document["rover"]
    own = [mount.get("mass_kg", rover["wheel_unit"]["mass_kg"]) for mount in mounts(log)]
    assert abs(sum(masses) - rover["body"]["mass_kg"] - sum(own)) < 1e-9


def test_the_schemas_are_those_of_foxglove(log: Log) -> None:
    """Names, numbers, types and labels of all fields, of all types that a schema needs."""
    messages = pytest.importorskip("foxglove.messages")

    def described(data: bytes) -> dict[str, Any]:
        types = {}
        for file in FileDescriptorSet.FromString(data).file:
            for message in file.message_type:
                fields = [(it.name, it.number, it.type, it.label, it.type_name) for it in message.field]
                words = [(it.name, [(v.name, v.number) for v in it.value]) for it in message.enum_type]
                types[f"{file.package}.{message.name}"] = (file.name, file.syntax, fields, words)
        return types

    for name in ("FrameTransforms", "SceneUpdate", "Log"):
        theirs = described(getattr(messages, name).get_schema().data)
        ours = described(log.schemas[f"foxglove.{name}"])
        assert ours == theirs


def test_a_damaged_message_is_noticed(log: Log) -> None:
    """The check of this file's reader: what it takes must be whole."""
    schema = log.schemas["foxglove.FrameTransforms"]
    assert len(FileDescriptorSet.FromString(schema).file) == 5
    with pytest.raises(DecodeError):
        FileDescriptorSet.FromString(schema[:-3])


@pytest.fixture(scope="module")
def rerun() -> Path:
    """The program of Rerun, beside this Python."""
    pytest.importorskip("rerun")
    return Path(sys.executable).with_name("rerun.exe" if os.name == "nt" else "rerun")


def test_rerun_imports_it(log: Log, rerun: Path, tmp_path: Path) -> None:
    # Rerun keeps settings, and sends nothing of its use where it has none yet.
    home = {**os.environ, "HOME": str(tmp_path), "XDG_CONFIG_HOME": str(tmp_path)}

    def run(*arguments: str) -> str:
        command = [str(rerun), *arguments]
        done = subprocess.run(command, capture_output=True, text=True, check=True, env=home)
        said = done.stdout + done.stderr
        assert " WARN" not in said and "ERROR" not in said, said
        return said

    recording = str(tmp_path / "run.rrd")
    run("mcap", "check", str(log.path))
    run("mcap", "convert", str(log.path), "--application-id", "run", "--output", recording)
    run("rrd", "verify", recording)
    chunks = [line for line in run("rrd", "print", recording).splitlines() if "data columns" in line]

    def has(entity: str, column: str, rows: int | None = None) -> bool:
        """Whether it has the column, in all chunks together with so many rows."""
        own = [line for line in chunks if f" - {entity} - " in line and column in line]
        counts = [int(found[1]) for line in own if (found := re.search(r" with (\d+) rows ", line))]
        return bool(own) and (rows is None or sum(counts) == rows)

    transforms = sum(len(message.transforms) for message in log.of("/tf"))
    assert has("/tf", "Transform3D:quaternion", transforms)
    assert has("/tf_static", "Transform3D:child_frame", 1)
    assert has("/rover", "grouser.Rover:message", len(log.records))
    for mount in mounts(log):
        assert has(f"/wheels/{mount['name']}", "grouser.Wheel:message")
    assert has("/events", "TextLog:text")
    # The model of the rover: a solid for each wheel, in the frame of its rim.
    wheels = [line for line in chunks if "_rim/visual_0" in line and "Cylinders3D:" in line]
    assert len(wheels) == len(mounts(log))
    assert any("body/visual_0" in line and "Boxes3D:" in line for line in chunks)
