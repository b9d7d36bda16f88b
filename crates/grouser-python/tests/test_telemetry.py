"""Telemetry of logs that the libraries of others write: mcap, rosbags, pyarrow."""

from __future__ import annotations

import csv
import gzip
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import grouser as gr
from conftest import Program

SECOND = 1_000_000_000
#: A wheel of the rover that all logs are of.
WHEEL = "wheel_speed_rad_s_front-left"


def rows_of(path: Path) -> list[dict[str, float | None]]:
    with path.open(newline="") as file:
        rows = csv.DictReader(file)
        return [
            {name: float(cell) if cell else None for name, cell in row.items()} for row in rows
        ]


def check_drive(rows: list[dict[str, Any]]) -> None:
    """Nose up by 10°, right side down by 5°, a metre ahead and a turn of 20° to the left."""
    assert [row["time_s"] for row in rows] == [1.0, 2.0, 3.0]
    first, second, third = rows
    assert first["pitch_deg"] == pytest.approx(10.0)
    assert first["roll_deg"] == pytest.approx(0.0)
    assert second["roll_deg"] == pytest.approx(5.0)
    assert second["pitch_deg"] == pytest.approx(0.0)
    assert first["vo_dx_m"] is None
    assert second["vo_dx_m"] == pytest.approx(1.0)
    assert second["vo_dy_m"] == pytest.approx(0.0, abs=1e-12)
    assert third["vo_dyaw_deg"] == pytest.approx(20.0)
    assert second[WHEEL] == pytest.approx(0.5)
    assert second["wheel_torque_nm_front-left"] == pytest.approx(0.2)


def about(axis: str, degrees: float) -> dict[str, float]:
    """A rotation by the right-hand rule, as ROS writes it."""
    half = math.radians(degrees) / 2
    return {"x": 0.0, "y": 0.0, "z": 0.0, "w": math.cos(half), axis: math.sin(half)}


#: Attitudes, and places with yaws, of the three times.
ATTITUDES = [about("y", -10.0), about("x", 5.0), about("x", 5.0)]
POSES = [(0.0, 90.0), (1.0, 90.0), (1.0, 110.0)]


def write_bag(writer: Any, store: Any, is_first: bool) -> None:
    """The drive, as messages of ROS."""
    types = store.types

    def of(name: str) -> Any:
        return types[name]

    def header(seconds: int) -> Any:
        stamp = of("builtin_interfaces/msg/Time")(sec=seconds, nanosec=0)
        counted = {"seq": seconds} if is_first else {}
        return of("std_msgs/msg/Header")(stamp=stamp, frame_id="odom", **counted)

    def connection(topic: str, name: str) -> Any:
        return writer.add_connection(topic, name, typestore=store)

    def write(to: Any, name: str, message: Any) -> None:
        serialize = store.serialize_ros1 if is_first else store.serialize_cdr
        # The recorder's clock is five seconds ahead.
        recorded = (message.header.stamp.sec + 5) * SECOND
        writer.write(to, recorded, serialize(message, name))

    vector, quaternion = of("geometry_msgs/msg/Vector3"), of("geometry_msgs/msg/Quaternion")
    zero, nine, many = vector(x=0.0, y=0.0, z=0.0), np.zeros(9), np.zeros(36)
    imu, odometry, joints = (
        "sensor_msgs/msg/Imu",
        "nav_msgs/msg/Odometry",
        "sensor_msgs/msg/JointState",
    )
    to = connection("/imu/data", imu)
    for second, attitude in enumerate(ATTITUDES, start=1):
        message = of(imu)(header(second), quaternion(**attitude), nine, zero, nine, zero, nine)
        write(to, imu, message)
    to = connection("/odom", odometry)
    for second, (y, yaw) in enumerate(POSES, start=1):
        point = of("geometry_msgs/msg/Point")(x=2.0, y=y, z=0.0)
        pose = of("geometry_msgs/msg/Pose")(point, quaternion(**about("z", yaw)))
        covered = of("geometry_msgs/msg/PoseWithCovariance")(pose, many)
        twist = of("geometry_msgs/msg/Twist")(zero, zero)
        twisted = of("geometry_msgs/msg/TwistWithCovariance")(twist, many)
        write(to, odometry, of(odometry)(header(second), "base_link", covered, twisted))
    to = connection("/joint_states", joints)
    names = ["front_left_wheel", "arm"]
    message = of(joints)(
        header(2), names, np.array([1.0, 0.0]), np.array([0.5, np.nan]), np.array([0.2, 0.0])
    )
    write(to, joints, message)
    # A message that is cut off is counted.
    writer.write(to, 9 * SECOND, b"\x00\x01\x00\x00\x01")


@pytest.mark.parametrize("kind", ["ros1", "sqlite", "mcap", "mcap file"])
def test_bags_of_ros_are_telemetry(kind: str, tmp_path: Path) -> None:
    pytest.importorskip("rosbags")
    from rosbags.rosbag1 import Writer as FirstWriter
    from rosbags.rosbag2 import StoragePlugin
    from rosbags.rosbag2 import Writer as SecondWriter
    from rosbags.typesys import Stores, get_typestore

    is_first = kind == "ros1"
    bag = tmp_path / ("drive.bag" if is_first else "drive")
    store = get_typestore(Stores.ROS1_NOETIC if is_first else Stores.ROS2_HUMBLE)
    if is_first:
        with FirstWriter(bag) as writer:
            write_bag(writer, store, is_first)
    else:
        plugin = StoragePlugin.SQLITE3 if kind == "sqlite" else StoragePlugin.MCAP
        with SecondWriter(bag, version=9, storage_plugin=plugin) as writer:
            write_bag(writer, store, is_first)
        if kind == "mcap file":
            (bag,) = bag.glob("*.mcap")
    out = tmp_path / "drive.csv"
    with pytest.raises(gr.DocumentError, match="hint: odometry=KIND"):
        gr.import_telemetry(bag, out, rover="hakuto")
    found = gr.import_telemetry(bag, out, rover="hakuto", odometry="visual")
    check_drive(rows_of(out))
    assert found.records == 3
    assert any("1 messages cannot be decoded" in note for note in found.notes)
    if kind != "mcap file":
        return
    # A recorder that lost its power leaves no end: what was written is read.
    cut = tmp_path / "cut.mcap"
    whole = bag.read_bytes()
    cut.write_bytes(whole[: whole.index(b"left_wheel") + 40])
    found = gr.import_telemetry(cut, tmp_path / "cut.csv", rover="hakuto", odometry="visual")
    assert any("without its end" in note for note in found.notes)


def write_mcap(path: Path, compression: Any) -> None:
    """The drive, in Foxglove's messages of Protocol Buffers and JSON."""
    from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
    from mcap.writer import Writer

    files = descriptor_pb2.FileDescriptorSet()
    file = files.file.add(name="test.proto", package="test", syntax="proto3")
    kind = file.message_type.add(name="Attitude")
    stamp = kind.nested_type.add(name="Stamp")
    stamp.field.add(name="seconds", number=1, type=3, label=1)
    stamp.field.add(name="nanos", number=2, type=5, label=1)
    kind.field.add(
        name="timestamp", number=1, type=11, label=1, type_name=".test.Attitude.Stamp"
    )
    kind.field.add(name="quaternion", number=2, type=1, label=3)
    kind.field.add(name="q", number=3, type=11, label=1, type_name=".test.Attitude.Q")
    for number, name in enumerate("xyzw", start=1):
        if number == 1:
            inner = kind.nested_type.add(name="Q")
        inner.field.add(name=name, number=number, type=2, label=1)
    pool = descriptor_pool.DescriptorPool()
    pool.Add(file)
    attitude = message_factory.GetMessageClass(pool.FindMessageTypeByName("test.Attitude"))
    import json

    with path.open("wb") as stream:
        writer = Writer(stream, chunk_size=200, compression=compression)
        writer.start()
        schema = writer.register_schema("test.Attitude", "protobuf", files.SerializeToString())
        binary = writer.register_channel("/attitude", "protobuf", schema)
        poses = writer.register_schema("foxglove.PoseInFrame", "jsonschema", b"{}")
        text = writer.register_channel("/pose", "json", poses)
        joints = writer.register_channel(
            "/joints", "json", writer.register_schema("foxglove.JointStates", "jsonschema", b"{}")
        )

        def add(channel: int, data: bytes) -> None:
            writer.add_message(channel, log_time=5 * SECOND, data=data, publish_time=5 * SECOND)

        for second, (rotation, (y, yaw)) in enumerate(zip(ATTITUDES, POSES), start=1):
            message = attitude(timestamp={"seconds": second}, q=rotation)
            add(binary, message.SerializeToString())
            pose = {"position": {"x": 2, "y": y, "z": 0}, "orientation": about("z", yaw)}
            time = {"sec": second, "nsec": 0}
            add(text, json.dumps({"timestamp": time, "pose": pose}).encode())
        states = [{"name": "front-left", "velocity": 0.5, "effort": 0.2}]
        add(joints, json.dumps({"timestamp": {"sec": 2, "nsec": 0}, "joints": states}).encode())
        writer.finish()


MAPPING = """
schema = "telemetry-mapping/1"
name = "a test"
time = "timestamp"
odometry = "visual"
[[reading]]
topic = "/attitude"
attitude = "q"
[[reading]]
message = "foxglove.PoseInFrame"
pose = "pose"
[[reading]]
topic = "/joints"
field = "joints[name={wheel}].velocity"
column = "wheel_speed_rad_s_{wheel}"
optional = true
[[reading]]
topic = "/joints"
field = "joints[name={wheel}].effort"
column = "wheel_torque_nm_{wheel}"
optional = true
"""


@pytest.mark.parametrize("compression", ["NONE", "LZ4", "ZSTD"])
def test_mcap_of_its_own_writer_is_telemetry(
    compression: str, tmp_path: Path, program: Program
) -> None:
    pytest.importorskip("mcap")
    pytest.importorskip("google.protobuf")
    from mcap.writer import CompressionType

    log, mapping, out = (tmp_path / name for name in ("a.mcap", "m.toml", "drive.csv"))
    write_mcap(log, CompressionType[compression])
    mapping.write_text(MAPPING)
    found = gr.import_telemetry(log, out, mapping, rover="hakuto")
    # A float's rounding.
    rows = rows_of(out)
    for row in rows:
        row.update({name: round(row[name] or 0.0, 5) for name in ("roll_deg", "pitch_deg")})
    check_drive(rows)
    assert not any("left out" in note for note in found.notes), found.notes
    # The program reads the same.
    command = [*program.command, "import-telemetry", str(log), "--mapping", str(mapping)]
    printed = subprocess.run([*command, "--rover", "hakuto"], capture_output=True, check=True)
    assert printed.stdout.decode() == out.read_text()


def imported(log: Path, out: Path, milliseconds: Any) -> list[dict[str, float | None]]:
    """The rows of a log with these times, no roll in every seventh row, and a remark."""
    found = gr.import_telemetry(log, out, rover="hakuto")
    assert found.records == len(milliseconds)
    assert found.notes == ("columns not used: remark",)
    rows = rows_of(out)
    assert [row["time_s"] for row in rows] == pytest.approx(milliseconds / 1000)
    assert rows[7]["roll_deg"] is None and rows[8]["roll_deg"] == pytest.approx(1.5)
    return rows


@pytest.mark.parametrize("compression", ["none", "snappy", "gzip", "zstd"])
@pytest.mark.parametrize("version", ["1.0", "2.0"])
def test_parquet_of_pyarrow_is_telemetry(compression: str, version: str, tmp_path: Path) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    from pyarrow import parquet

    count = 5000
    milliseconds = np.arange(count) * 100
    roll = np.where(np.arange(count) % 7 == 0, np.nan, 1.5)
    table = pyarrow.table(
        {
            "time_s": pyarrow.array(milliseconds, pyarrow.timestamp("ms")),
            "roll_deg": pyarrow.array(roll, from_pandas=True),
            "pitch_deg": pyarrow.array(np.arange(count) % 5, pyarrow.int32()),
            WHEEL: pyarrow.array(np.full(count, 0.5), pyarrow.float32()),
            "x_m": pyarrow.array([f"{k / 8}" for k in range(count)]),
            "remark": pyarrow.array(["one"] * count),
        }
    )
    log, out = tmp_path / "log.parquet", tmp_path / "out.csv"
    parquet.write_table(
        table, log, compression=compression, data_page_version=version, row_group_size=1500
    )
    rows = imported(log, out, milliseconds)
    assert [row["x_m"] for row in rows[:3]] == [0.0, 0.125, 0.25]
    assert rows[13]["pitch_deg"] == pytest.approx(3.0) and rows[13][WHEEL] == 0.5
    # What is written as Parquet is read by others.
    again = tmp_path / "again.parquet"
    gr.import_telemetry(out, again, rover="hakuto")
    columns = parquet.read_table(again).to_pydict()
    assert columns["x_m"] == [row["x_m"] for row in rows]
    assert columns["roll_deg"] == [row["roll_deg"] for row in rows]


@pytest.mark.parametrize("compression", ["uncompressed", "lz4", "zstd", "stream"])
def test_arrow_of_pyarrow_is_telemetry(compression: str, tmp_path: Path) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    from pyarrow import feather, ipc

    count = 5000
    milliseconds = np.arange(count) * 100
    table = pyarrow.table(
        {
            "time_s": pyarrow.array(milliseconds, pyarrow.timestamp("ms")),
            "roll_deg": pyarrow.array(np.where(np.arange(count) % 7 == 0, np.nan, 1.5)),
            "remark": pyarrow.array(["one, two"] * count),
        }
    )
    log, out = tmp_path / "log.arrow", tmp_path / "out.csv"
    if compression == "stream":
        with ipc.new_stream(log, table.schema) as writer:
            writer.write_table(table, max_chunksize=700)
    else:
        feather.write_feather(table, log, compression, chunksize=1500)
    imported(log, out, milliseconds)


def test_what_cannot_be_imported_is_an_error_of_ours(tmp_path: Path) -> None:
    log, out = tmp_path / "log.csv", tmp_path / "out.csv"
    log.write_text("time_s,roll_deg\n1,2\n")
    with pytest.raises(gr.DocumentNotFoundError, match="no such file"):
        gr.import_telemetry(tmp_path / "none.mcap", out)
    with pytest.raises(gr.DocumentError, match="reads none of its columns, which are time_s, roll_deg"):
        gr.import_telemetry(log, out, "ros")
    assert not out.exists()
    gr.import_telemetry(log, out)
    with pytest.raises(gr.ParameterError, match="force=True"):
        gr.import_telemetry(log, out)
    gr.import_telemetry(log, out, force=True)


def test_the_module_is_a_command(tmp_path: Path) -> None:
    log, out = tmp_path / "log.csv", tmp_path / "out.csv"
    log.write_text("time_s,roll_deg\n1,2\n2,oops\n")
    command = [sys.executable, "-m", "grouser", "import-telemetry", str(log), "--out", str(out)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "")
    assert "1 cell of `roll_deg`" in done.stderr and "2 records of telemetry" in done.stderr
    again = subprocess.run(command, capture_output=True, text=True, check=False)
    assert again.returncode == 2 and again.stderr.startswith("error: ")


def test_files_of_one_drive_are_a_log(tmp_path: Path) -> None:
    run = gr.simulate(rover="hakuto", slope_deg=8.0, duration_s=20.0, simulation="quasi-steady")
    header, *rows = run.to_pandas().to_csv(index=False).splitlines()
    half = len(rows) // 2
    parts = [tmp_path / "first.csv", tmp_path / "second.csv"]
    for path, part in zip(parts, (rows[:half], rows[half:])):
        path.write_text("\n".join([header, *part]) + "\n")
    settings = {"rover": "hakuto", "slope_deg": 8.0, "model": "ishigami"}
    learner = gr.learn(parts[::-1], prior="toyoura-uncertain", **settings)
    replayed = gr.replay(parts[::-1], **settings)
    imported = gr.import_telemetry(parts[::-1], tmp_path / "out.csv", rover="hakuto")
    for files in (learner.files, replayed.attrs["files"], imported.files):
        gave = [(it["file"], it["used"]) for it in files]
        assert gave == [(str(parts[0]), half), (str(parts[1]), len(rows) - half)]
    with pytest.raises(gr.DocumentError, match=r"first.csv: goes on to .*second.csv begins"):
        (tmp_path / "second.csv").write_text("\n".join([header, *rows[half - 2 :]]) + "\n")
        gr.learn(parts, prior="toyoura-uncertain", **settings)
    with pytest.raises(gr.DocumentError, match="no file's name ends with .mcap"):
        gr.replay(tmp_path)


def test_logs_say_what_they_gave_and_have_a_budget(tmp_path: Path) -> None:
    run = gr.simulate(rover="hakuto", slope_deg=8.0, duration_s=20.0, simulation="quasi-steady")
    text = run.to_pandas().to_csv(index=False)
    rows = len(text.splitlines()) - 1
    log = tmp_path / "drive.csv.gz"
    with gzip.open(log, "wt") as file:
        file.write(text + "x,\n")
    of_log = {"content": "telemetry", "counted": "rows", "there": rows + 1, "used": rows}
    prior = {"prior": "toyoura-uncertain", "rover": "hakuto", "model": "ishigami"}
    learner = gr.learn(log, slope_deg=8.0, **prior)
    replayed = gr.replay(log, rover="hakuto", slope_deg=8.0, model="ishigami")
    imported = gr.import_telemetry(log, tmp_path / "out.csv", rover="hakuto")
    for files in (learner.files, replayed.attrs["files"], imported.files):
        [found] = files
        assert found == {"file": str(log), **of_log}
    # Zeros are packed to a thousandth of their size.
    large = tmp_path / "large.csv.gz"
    with gzip.open(large, "wt") as file:
        file.write(text)
        file.write(("0" * 9_999 + "\n") * 200)
    with pytest.raises(gr.GrouserError, match="`max_unpacked_mib` reads more"):
        gr.learn(large, max_unpacked_mib=1, slope_deg=8.0, **prior)
    assert gr.learn(large, max_unpacked_mib=8, slope_deg=8.0, **prior).learnt["records"] > 0
    with pytest.raises(gr.ParameterError, match="max_unpacked_mib"):
        gr.learn(log, max_unpacked_mib=-1, **prior)
