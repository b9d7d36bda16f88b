"""Logs of the program, read by the readers of others: mcap, Foxglove's schemas, Rerun."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from collections import Counter
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
#: Rovers with four wheels, with six, and one with four whose wheels are steered.
RUNS = {
    "hakuto": ["--slope-deg", "15", "--yaw-deg", "9.56", "--duration-s", "3"],
    "six wheels": ["--rover", "curiosity", "--duration-s", "2"],
    "steered": [
        *(part for k in range(4) for part in ("--set", f"rover.mount.{k}.steering_deg={10 - 5 * k}")),
        *("--duration-s", "2"),
    ],
    "backward": ["reverse", "--duration-s", "2"],
    "no time": ["--duration-s", "0.001"],
    "sliding": ["--slope-deg", "36", "--duration-s", "10"],
}


class Log:
    """A log with the program's own answer about the same run."""

    def __init__(self, path: Path, answer: dict[str, Any]) -> None:
        self.path, self.answer = path, answer
        self.records: list[dict[str, Any]] = answer["samples"]
        self.messages: dict[str, list[tuple[int, Any]]] = {}
        self.schemas: dict[str, bytes] = {}
        self.attached: dict[str, bytes] = {}
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
            self.summary = reader.get_summary()
            self.attached = {it.name: it.data for it in reader.iter_attachments()}

    def of(self, topic: str) -> list[Any]:
        return [message for _, message in self.messages[topic]]


@pytest.fixture(scope="module", params=RUNS)
def log(request: pytest.FixtureRequest, program: Program, tmp_path_factory: Any) -> Log:
    path = tmp_path_factory.mktemp("log") / "run.mcap"
    answer = program("traverse", *RUNS[request.param], "--mcap", str(path))
    return Log(path, answer)


def mounts(log: Log) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = log.answer["inputs"]["scenario"]["rover"]["mount"]
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
            assert {"wheel": mount["name"], **written} == wheel
            assert all(math.isfinite(value) for value in written.values())


def test_transforms_are_the_poses_of_the_records(log: Log) -> None:
    scenario = log.answer["inputs"]["scenario"]
    (static,) = log.of("/tf_static")
    (ground,) = static.transforms
    assert (ground.parent_frame_id, ground.child_frame_id) == ("world", "slope")
    assert same(matrix(ground.rotation), about(0, math.radians(scenario["slope_deg"])))
    common = scenario["rover"]["wheel_unit"]["wheel"]
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
    common = log.answer["inputs"]["scenario"]["rover"]["wheel_unit"]["wheel"]
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
    results = log.answer
    (end,) = [event for event in log.of("/events") if event.name == "run"]
    assert end.message.startswith(results["outcome"].replace("_", " "))
    assert (end.level == 2) == (results["outcome"] == "completed")
    flags = {it.message.split(":")[0] for it in log.of("/events") if it.name == "validity"}
    assert flags == set(results["flags"])
    assert b"[rover]" in log.attached["scenario.toml"]


def test_the_model_of_the_rover_has_the_frames_of_the_transforms(log: Log) -> None:
    (data,) = log.of("/robot_description")
    text = data[8 : 8 + int.from_bytes(data[4:8], "little") - 1].decode()
    model = ElementTree.fromstring(text)
    links = {link.get("name") for link in model.iter("link")}
    frames = {it.child_frame_id for it in log.of("/tf")[0].transforms}
    assert links == frames
    masses = [float(mass.get("value", "nan")) for mass in model.iter("mass")]
    rover = log.answer["inputs"]["scenario"]["rover"]
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
        wanted = "" if rows is None else f" with {rows} rows "
        return any(f" - {entity} - " in line and column in line and wanted in line for line in chunks)

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
