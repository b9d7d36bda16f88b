"""Missions: legs as the program has them, alternatives by name, and faults that name their leg."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Program
from test_same_bits import same

import grouser as gr

#: Legs of some centimetres, each of another kind.
SHORT: dict[str, Any] = {
    "name": "short",
    "slope_deg": 8.0,
    "stop": {"slip_ratio": {"above": 0.9, "over_m": 0.1}},
    "leg": [
        {"drive_m": 0.1, "yaw_deg": 4.0},
        {"turn_deg": 10.0},
        {"arc": {"radius_m": 1.0, "angle_deg": 5.0}},
        {"wait_s": 1.0},
        {"drive_m": -0.1},
    ],
}


@pytest.fixture(scope="module")
def short() -> gr.DrivenMission:
    return gr.mission(SHORT)


def check_same(found: gr.DrivenMission, answer: dict[str, Any]) -> None:
    """Bit for bit what the program says of a mission, or of an alternative."""
    assert (found.outcome, found.energy_j) == (answer["outcome"], answer["energy_j"])
    assert found.final == answer["final"]
    assert found.trajectory.simulation == answer["simulation"]
    assert found.trajectory.simulation_message == answer["simulation_reason"]
    table, rows = found.legs._table(), answer["legs"]
    assert list(table) == list(found.to_pandas()) == list(rows[0])
    for name, column in table.items():
        if column.dtype == object:
            assert list(column) == [row[name] for row in rows], name
        else:
            assert same(column, rows, name), name


@pytest.mark.parametrize("settings", [{}, {"simulation": "quasi-steady"}], ids=["dynamic", "quasi"])
def test_legs_are_the_programs(program: Program, settings: dict[str, Any], tmp_path: Path) -> None:
    mission = gr.Mission(SHORT, **settings)
    (tmp_path / "mission.toml").write_text(mission.to_toml())
    file = str(tmp_path / "mission.toml")
    check_same(gr.mission(mission), program("mission", file, "--nominal"))


def test_what_a_mission_risks_is_the_programs(program: Program, tmp_path: Path) -> None:
    mission = gr.Mission(SHORT, soil="toyoura-uncertain", simulation="quasi-steady")
    (tmp_path / "mission.toml").write_text(mission.to_toml())
    file = str(tmp_path / "mission.toml")
    answer = program("mission", file, "--samples", "6", "--seed", "3")
    found = gr.mission(mission, samples=6, seed=3)
    assert found.risk is not None and found.advice is not None
    assert found.risk == {name: answer[name] for name in found.risk}
    assert 0.0 <= found.risk["probability_completed"] <= 1.0
    advice = [leg.pop("advice") for leg in answer["legs"]]
    check_same(found, answer)
    assert list(found.advice) == list(advice[0])
    for name in found.advice:
        assert same(found.advice[name], advice, name), name
    # Only what leads somewhere with the nose in front, or turns on the spot, has advice.
    has_advice = [verdict is not None for verdict in found.advice["verdict"]]
    assert has_advice == [True, True, True, False, False][: len(found.legs)]


def test_without_samples_nothing_is_risked(short: gr.DrivenMission) -> None:
    assert short.risk is None and short.advice is None
    for bad in ({"samples": 1}, {"samples": 2.5}, {"samples": 2, "seed": -1}):
        with pytest.raises(gr.ParameterError, match=list(bad)[-1]):
            gr.mission(SHORT, **bad)


def test_what_was_driven_can_be_pickled() -> None:
    """Alternatives and results by model are mappings with slots, without a dictionary of names."""
    legs = {"a": {"drive_m": 0.1}, "b": {"drive_m": 0.1, "yaw_deg": 9.0}}
    ways = [{"name": name, "leg": [leg]} for name, leg in legs.items()]
    found = gr.mission({"name": "ways", "slope_deg": 8.0, "alternative": ways}, samples=2)
    for again in (pickle.loads(pickle.dumps(found)), copy.deepcopy(found)):
        assert again.mission == found.mission and list(again.alternatives) == ["a", "b"]
        assert again.legs.to_pandas().equals(found.legs.to_pandas())
        assert again.alternatives.to_pandas().equals(found.alternatives.to_pandas())
        assert again.trajectory.y_m.tolist() == found.trajectory.y_m.tolist()
        assert again.risk == found.risk and list(again.advice) == list(found.advice)
    level = gr.heading(slope_deg=5.0, model="all", nominal=True)
    assert list(pickle.loads(pickle.dumps(level))) == list(level)
    with pytest.raises(AttributeError, match="'Alternatives' object has no attribute 'ways'"):
        found.alternatives.ways  # type: ignore[attr-defined]


def test_a_mission_that_is_stopped_is_the_programs(program: Program) -> None:
    found = gr.mission("slip-check", slope_deg=14.0, simulation="quasi-steady")
    settings = ("--slope-deg", "14", "--simulation", "quasi-steady", "--nominal")
    check_same(found, program("mission", "slip-check", *settings))
    assert found.outcome == found.legs.outcome[-1] == "stopped"
    assert found.legs.stopped_by[-1] == "slip_ratio" and found.legs.stopped_kind[-1] == "reactive"
    assert found.legs_completed == len(found.legs) - 1 < found.legs_planned
    assert found.trajectory.outcome == "completed"


def test_alternatives_are_the_programs(program: Program) -> None:
    found = gr.mission("two-steps-forward", simulation="quasi-steady")
    settings = ("--simulation", "quasi-steady", "--nominal")
    answers = program("mission", "two-steps-forward", *settings)["alternatives"]
    assert list(found.alternatives) == [answer["alternative"] for answer in answers]
    for way, answer in zip(found.alternatives.values(), answers):
        assert way.alternative == answer["alternative"] and not way.alternatives
        check_same(way, answer)
    check_same(found, answers[0])
    table = found.alternatives.to_pandas()
    assert list(table["energy_j"]) == [answer["energy_j"] for answer in answers]
    data = found.alternatives.to_xarray()
    assert data.slip_ratio.sel(alternative="switchback") == found.alternatives["switchback"].slip_ratio
    assert data.energy_j.units == "J"
    assert len(found.alternatives.plot().lines) == 4


def test_legs_join_to_the_whole(short: gr.DrivenMission) -> None:
    assert short.outcome == "completed" and list(short.legs.outcome) == ["completed"] * 5
    # Five numbers of one run, added in another order than the run's.
    assert short.legs.time_s.sum() == pytest.approx(short.final["time_s"], rel=1e-12)
    assert short.legs.energy_j.sum() == pytest.approx(short.energy_j, rel=1e-12)
    assert short.legs.distance_m[[0, 4]] == pytest.approx(0.1, abs=1e-6)
    assert short.legs.time_s[3] == pytest.approx(1.0, abs=1e-6)
    # Only what leads somewhere has a slip ratio.
    assert list(np.isnan(short.legs.slip_ratio)) == [False, True, False, True, False]
    run, end = short.trajectory, short.final
    for name in ("time_s", "x_m", "y_m", "yaw_deg"):
        assert getattr(run, name)[-1] == end[name]
    assert run.yaw_deg[0] == 4.0


def test_results_are_tables(short: gr.DrivenMission) -> None:
    data = short.to_xarray()
    assert data.distance_m.units == "m" and data.attrs["outcome"] == "completed"
    assert gr.Mission.from_toml(data.attrs["mission"]) == short.mission
    assert short.to_arrow().num_rows == len(short.legs) == 5
    run = short.trajectory.to_xarray()
    assert run.sizes["time_s"] == len(short.trajectory.time_s)
    assert gr.Mission.from_toml(run.attrs["mission"]) == short.mission
    assert "5 of 5 legs" in repr(short) and "<table" in short._repr_html_()
    texts = [text.get_text() for text in short.plot().texts]
    assert texts == ["1", "2", "3", "4", "5"]


def test_a_mission_is_drawn_as_it_was_driven(short: gr.DrivenMission, program: Program, tmp_path: Path) -> None:
    (tmp_path / "mission.toml").write_text(short.mission.to_toml())
    picture = tmp_path / "program.svg"
    file = str(tmp_path / "mission.toml")
    program("mission", file, "--nominal", "--animate", str(picture))
    animation = short.trajectory.animate(tmp_path / "python.svg", names=["short"])
    assert (tmp_path / "python.svg").read_bytes() == picture.read_bytes()
    assert animation.to_bytes("glb")[:4] == b"glTF"
    # Beside a run that is no mission.
    run = gr.simulate(duration_s=0.5)
    assert b"<svg" in run.animate(beside=[short.trajectory]).to_bytes("svg")


def test_alternatives_are_drawn_beside_each_other() -> None:
    ways = [
        {"name": name, "leg": [{"drive_m": 0.1, "yaw_deg": yaw}]}
        for name, yaw in (("level", 0.0), ("uphill", 10.0))
    ]
    found = gr.mission({"name": "ways", "slope_deg": 8.0, "alternative": ways})
    drawn = found.alternatives.animate().to_bytes("svg").decode()
    assert "uphill" in drawn and "level" in drawn
    other = found.alternatives["uphill"].trajectory.animate(names=["way"]).to_bytes("svg")
    assert other != found.trajectory.animate(names=["way"]).to_bytes("svg")


def test_a_mission_is_a_description(short: gr.DrivenMission) -> None:
    mission = short.mission
    for name in gr.Mission.presets():
        one = gr.Mission(name)
        assert gr.Mission.from_toml(one.to_toml(), one.files) == one
        assert one.scenario.slope_deg == one.slope_deg and one.scenario.rover == one.rover
    assert pickle.loads(pickle.dumps(mission)) == copy.deepcopy(mission) == mission
    assert mission.leg[1]["turn_deg"] == 10.0
    assert mission.replace(slope_deg=9.0).site.slope_deg == 9.0
    moon = gr.Site("lunar-nominal", slope_deg=3.0, gravity_m_s2=gr.MOON_GRAVITY)
    assert gr.Mission("arc", site=moon).site == moon
    assert mission.scenario.start["yaw_deg"] == 0.0


def test_legs_from_a_file(tmp_path: Path) -> None:
    (tmp_path / "legs.csv").write_text("drive_m,yaw_deg\n0.1,3.0\n0.05,\n")
    (tmp_path / "mission.toml").write_text(
        'schema = "mission/1"\nname = "of a file"\nrover = "hakuto"\nsoil = "toyoura"\n'
        'slope_deg = 5.0\nlegs_from = "legs.csv"\n'
    )
    mission = gr.Mission(tmp_path / "mission.toml")
    assert [leg["drive_m"] for leg in mission.leg] == [0.1, 0.05]
    assert gr.Mission.from_toml(mission.to_toml()) == mission


@pytest.mark.parametrize(
    "legs, expected",
    [
        ([{"drive_m": 1.0}, {"drive_m": 1.0, "turn_deg": 5.0}], "leg 2 has both"),
        ([{"drive_m": 1.0}, {"speed_m_s": 0.1}], "leg 2 says nothing to do"),
        ([{"drive_m": 1.0, "reverse": True}], "leg 1 has `reverse`"),
        ([{"drive_m": 1.0}, {"drive_m": 1e6}], "this is leg 2"),
        ([{"arc": {"radius_m": 1.0, "angel_deg": 5.0}}], "this is leg 1"),
    ],
)
def test_faults_name_their_leg(legs: list[dict[str, Any]], expected: str) -> None:
    with pytest.raises(gr.ParameterError, match=expected):
        gr.Mission(leg=legs)
    text = gr.Mission(leg=[{"drive_m": 0.5}]).to_toml().replace("drive_m = 0.5", "drive_m = 0.5\nwait_s = 1.0")
    with pytest.raises(gr.DocumentError, match="leg 1 has both") as caught:
        gr.Mission.from_toml(text)
    assert caught.value.line is not None


def test_a_mission_needs_legs() -> None:
    with pytest.raises(gr.ParameterError, match="the mission has no legs"):
        gr.Mission(leg=[])
    with pytest.raises(gr.DocumentNotFoundError):
        gr.mission("there-and-bakc")
    with pytest.raises(TypeError, match="Mission is made from"):
        gr.mission(gr.Scenario())  # type: ignore[arg-type]
