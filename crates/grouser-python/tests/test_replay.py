"""A drive beside its prediction: of a file, of a data frame and of arrays, and in a log that others read."""

from __future__ import annotations

import csv
from pathlib import Path

import grouser as gr
import numpy as np
import pytest
from conftest import Program

RUN = ["--slope-deg", "8", "--model", "ishigami", "--duration-s", "40"]


@pytest.fixture(scope="module")
def drive(program: Program, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The telemetry of a drive, with the usual noise and gaps."""
    path = tmp_path_factory.mktemp("drive") / "drive.csv"
    program("traverse", *RUN, "--simulation", "quasi-steady", "--telemetry", str(path))
    return path


def test_it_is_what_the_program_has(drive: Path, program: Program) -> None:
    answer = program("replay", str(drive), "--model", "ishigami")
    found = gr.replay(drive, model="ishigami")
    assert found.attrs["points_to"] == answer["points_to"]
    for name in ("measured_forward_speed_m_s", "forward_speed_m_s", "residual_yaw_deg"):
        stretches = [stretch[name] for stretch in answer["stretches"]]
        expected = [np.nan if value is None else value for value in stretches]
        np.testing.assert_array_equal(found[name], expected)
    torque = found.torque_nm.sel(wheel="rear-left")
    assert float(torque[2]) == answer["stretches"][2]["rear-left.torque_nm"]
    assert found.torque_nm.dims == ("time_s", "wheel")
    assert found.forward_speed_m_s.attrs["units"] == "m/s"
    assert [row["cause"] for row in found.attrs["findings"]][:3] == ["soil"] * 3


def test_a_part_is_replayed_alone(drive: Path, program: Program) -> None:
    answer = program("replay", str(drive), "--model", "ishigami", "--from-s", "10", "--to-s", "30")
    found = gr.replay(drive, from_s=10.0, to_s=30.0, model="ishigami")
    assert found.attrs["points_to"] == answer["points_to"]
    assert [float(time) for time in found.time_s] == [it["time_s"] for it in answer["stretches"]]
    assert 10.0 < float(found.time_s[0]) and float(found.time_s[-1]) <= 30.0
    for ends, says in (({"from_s": 5.0, "to_s": 5.0}, "not after 5 s"), ({"to_s": 0.01}, "from 1 record")):
        with pytest.raises(gr.ParameterError, match=says):
            gr.replay(drive, model="ishigami", **ends)


def test_columns_are_as_good_as_a_file(drive: Path) -> None:
    pandas = pytest.importorskip("pandas")
    with drive.open(newline="") as file:
        rows = list(csv.DictReader(file))
    # Every digit of the file, which not all versions of pandas read.
    columns = {name: [float(row[name] or "nan") for row in rows] for name in rows[0]}
    table = pandas.DataFrame(columns)
    of_file = gr.replay(drive, model="ishigami")
    of_table = gr.replay(table, model="ishigami")
    of_arrays = gr.replay({name: table[name].to_numpy() for name in table}, model="ishigami")
    for other in (of_table, of_arrays):
        assert of_file.equals(other)
        # Numbers that are missing are NaN, which equals nothing.
        assert str({**of_file.attrs, "files": []}) == str(other.attrs)


def test_bands_are_of_the_seed(drive: Path) -> None:
    settings = {"soil": "toyoura-uncertain", "model": "ishigami", "uncertainty": True, "samples": 4}
    one, again = (gr.replay(drive, seed=3, **settings) for _ in range(2))
    assert one.identical(again)
    assert bool((one.slip_ratio_p2_5 <= one.slip_ratio_p97_5).all())


def test_logs_that_are_none_are_refused(tmp_path: Path) -> None:
    with pytest.raises(gr.DocumentNotFoundError, match="no such file"):
        gr.replay(tmp_path / "missing.csv")
    with pytest.raises(gr.ParameterError, match="wheel speeds"):
        gr.replay({"time_s": [0.0, 1.0], "roll_deg": [1.0, 1.0]})
    with pytest.raises(gr.ParameterError, match="one length"):
        gr.replay({"time_s": [0.0, 1.0], "roll_deg": [1.0]})
    with pytest.raises(gr.ParameterError, match="samples"):
        gr.replay({"time_s": [0.0]}, samples=1)


def test_the_log_is_read_by_others(drive: Path, program: Program, tmp_path: Path) -> None:
    pytest.importorskip("mcap_protobuf")
    from mcap.reader import make_reader
    from mcap_protobuf.decoder import DecoderFactory

    path = tmp_path / "drive.mcap"
    answer = program("replay", str(drive), "--model", "ishigami", "--mcap", str(path))
    found: dict[str, list[float]] = {}
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        for _, channel, _, message in reader.iter_decoded_messages():
            if channel.topic.endswith("/motion"):
                found.setdefault(channel.topic, []).append(message.forward_speed_m_s)
    for topic, name in (
        ("/measured/motion", "measured_forward_speed_m_s"),
        ("/predicted/motion", "forward_speed_m_s"),
    ):
        expected = [stretch[name] for stretch in answer["stretches"]]
        assert found[topic] == [value for value in expected if value is not None]
