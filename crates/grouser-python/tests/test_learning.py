"""Learning from telemetry: the program's numbers, in whatever way the telemetry is given."""

from __future__ import annotations

import csv
import json
import pickle
from pathlib import Path

import numpy as np
import pytest
from conftest import Program

import grouser as gr

PRIOR = {"prior": "toyoura-uncertain", "rover": "hakuto", "model": "ishigami"}


@pytest.fixture(scope="module")
def log(program: Program, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The telemetry of a drive along 8° of a sand that is softer than the prior says."""
    folder = tmp_path_factory.mktemp("drive")
    program(
        *"traverse --rover hakuto --soil toyoura --set soil.shear.lateral_m=0.022 --slope-deg 8 "
        "--set soil.shear.longitudinal_m=0.05 --set scenario.start.yaw_deg=4 --duration-s 20 "
        "--simulation quasi-steady --sensor outliers=0.02 --telemetry".split(),
        str(folder / "log.csv"),
    )
    return folder / "log.csv"


def columns(log: Path) -> dict[str, list[float]]:
    with log.open() as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name] or "nan") for row in rows] for name in rows[0]}


def test_the_numbers_are_the_programs(program: Program, log: Path, tmp_path: Path) -> None:
    out = tmp_path / "today"
    program(
        *"learn --prior toyoura-uncertain --rover hakuto --model ishigami --samples 12 --seed 3 "
        "--predict-slope-deg 6,10 --out".split(),
        str(out),
        str(log),
    )
    learner = gr.learn(log, **PRIOR)
    answer = json.loads((out / "learn.json").read_text())
    found = learner.predict([6.0, 10.0], samples=12, seed=3)
    for place, row in enumerate(answer["predictions"]):
        assert row.pop("slope_deg") == found["slope_deg"][place]
        assert row.pop("advice")["yaw_deg"] == row["yaw_deg"]
        for name, value in row.items():
            assert value == found[name].values[place], name
    assert learner.learnt == answer["learnt"]
    assert learner.models == answer["models"]
    assert list(learner.notes) == answer["notes"]
    with (out / "lessons.csv").open() as file:
        lessons = list(csv.DictReader(file))
    for name, values in learner.lessons.items():
        assert [float(row[name]) for row in lessons] == values.tolist(), name
    learner.save(tmp_path / "soil.toml", samples=12, seed=3, name=str(log))
    assert (tmp_path / "soil.toml").read_text() == (out / "soil.toml").read_text()
    samples = "soil-samples.csv"
    assert (tmp_path / samples).read_text() == (out / samples).read_text()
    # The program's state is one to go on from.
    again = gr.Learner.load_state(out / "learn-state.json").finished()
    assert again.lessons["slip_ratio"].tolist() == learner.lessons["slip_ratio"].tolist()


def test_telemetry_may_come_in_any_form(log: Path) -> None:
    pandas, xarray = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    whole = columns(log)
    records = [dict(zip(whole, row)) for row in zip(*whole.values())]
    data = xarray.Dataset({name: ("row", values) for name, values in whole.items()})
    expected = gr.learn(log, **PRIOR).lessons
    for telemetry in [whole, records, pandas.DataFrame(whole), data]:
        found = gr.learn(telemetry, **PRIOR).lessons
        for name, values in expected.items():
            np.testing.assert_array_equal(found[name], values)
    learner = gr.Learner(**PRIOR)
    streamed = [lesson["way_m"] for lesson in learner.stream(records)]
    assert streamed == expected["way_m"][: len(streamed)].tolist()
    assert len(expected["way_m"]) - len(streamed) <= 1


def test_a_kept_learner_goes_on_with_the_same_bits(log: Path, tmp_path: Path) -> None:
    whole = columns(log)
    half = len(whole["time_s"]) // 2 + 3
    first, second = ({k: v[cut] for k, v in whole.items()} for cut in (slice(half), slice(half, None)))
    learner = gr.Learner(**PRIOR)
    learner.update(first)
    learner.save_state(tmp_path / "state.json")
    others = [pickle.loads(pickle.dumps(learner)), gr.Learner.load_state(tmp_path / "state.json")]
    for one in [learner, *others]:
        one.update(second)
    for other in others:
        assert other._native.state() == learner._native.state()
    text = (tmp_path / "state.json").read_text()
    (tmp_path / "state.json").write_text(text[: len(text) // 2])
    with pytest.raises(gr.ParameterError, match="damaged"):
        gr.Learner.load_state(tmp_path / "state.json")
    for damaged in [text.encode().replace(b"mass_kg = ", b"mass_kg = 1", 1), b"\xff" + text.encode()]:
        (tmp_path / "state.json").write_bytes(damaged)
        with pytest.raises(gr.ParameterError, match="damaged"):
            gr.Learner.load_state(tmp_path / "state.json")
    (tmp_path / "state.json").write_text(text)
    with pytest.raises(gr.ParameterError, match="another rover"):
        other_rover = gr.Learner(**{**PRIOR, "rover": "hakuto-flight"}).scenario
        gr.Learner.load_state(tmp_path / "state.json", other_rover)


def test_what_was_learnt_is_a_soil_and_a_prior(log: Path) -> None:
    learner = gr.learn(log, **PRIOR)
    soil = learner.soil(samples=30)
    assert "learnt" in soil.name
    level = gr.heading(soil=soil, rover="hakuto", model="ishigami", slope_deg=[10.0], samples=10)
    assert level.band is not None and np.isfinite(level.band.yaw_deg_p50).all()
    tomorrow = gr.Learner(**{**PRIOR, "prior": soil})
    assert tomorrow.learnt["records"] == 0
    card = learner.card(samples=4, slope_deg=[5.0])
    assert card.slope_deg.tolist() == [5.0]


def test_the_prior_and_the_posterior_are_groups_of_arviz(log: Path) -> None:
    pytest.importorskip("arviz")
    data = gr.learn(log, **PRIOR).to_arviz(samples=200)
    lateral = [data[group]["soil.shear.lateral_m"].values for group in ("prior", "posterior")]
    assert lateral[0].shape == lateral[1].shape == (1, 200)
    assert lateral[1].std() < 0.9 * lateral[0].std()


def test_what_cannot_be_learnt_from_is_refused() -> None:
    with pytest.raises(gr.ParameterError, match="taken as exact"):
        gr.Learner(prior=gr.Soil("toyoura", priors="none"))
    learner = gr.Learner(**PRIOR)
    with pytest.raises(gr.ParameterError, match="different lengths"):
        learner.update({"time_s": [1.0, 2.0], "roll_deg": [1.0]})
    with pytest.raises(gr.ParameterError, match="is no wheel"):
        learner.update({"time_s": 1.0, "wheel_torque_nm_middle": 1.0})
    with pytest.raises(gr.ParameterError, match="the time is missing"):
        learner.update({"roll_deg": 1.0})
    assert learner.update({"time_s": [2.0, 1.0], "roll_deg": [400.0, np.nan], "name": ["a", "b"]}) == []
    assert len(learner.notes) == 2
