"""Python and the program give the same bits for the same documents."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Program

import grouser as gr

DATA = Path(__file__).resolve().parents[2] / "grouser" / "data" / "experiments"


def same(column: Any, rows: list[dict[str, Any]], name: str) -> bool:
    """Bit for bit, with null where Python has NaN, and lists of flags joined by semicolons."""
    if all(row[name] is None or isinstance(row[name], str | list) for row in rows) and any(
        row[name] is not None for row in rows
    ):
        texts = [";".join(row[name]) if name == "flags" else row[name] for row in rows]
        # In tables of pandas a missing text is NaN.
        return [None if it != it else it for it in column] == texts
    answer = np.array([np.nan if row[name] is None else row[name] for row in rows], dtype=np.float64)
    return np.asarray(column, dtype=np.float64).tobytes() == answer.tobytes()


def check_rows(columns: Any, rows: list[dict[str, Any]], kept: slice = slice(None)) -> None:
    """Bit for bit, each column of rows with advice, and the same columns in their advice, which is
    the last of each."""
    assert all(list(row)[-1] == "advice" for row in rows)
    advice = [row["advice"] for row in rows]
    for own in (rows, advice):
        for name in own[0].keys() - {"advice"}:
            assert same(columns[name][kept], own, name), name
    assert {"verdict", "reason", "probability_stuck", "yaw_deg"} < advice[0].keys()


def test_wheel_test(program: Program) -> None:
    for soil, wheel in [("toyoura", "hakuto"), ("cmu-direct90-smooth", "cmu-smooth")]:
        rows = program(
            "wheel-test", "--soil", soil, "--wheel", wheel, "--load-n", "10,17,60000",
            "--slip-angle-deg", "0,15,30", "--slip-ratio", "0:0.9:0.1",
        )["rows"]  # fmt: skip
        ratios = [row["slip_ratio"] for row in rows[:10]]
        test = gr.wheel_test(
            soil, wheel, load_n=[10, 17, 60000], slip_angle_deg=[0, 15, 30], slip_ratio=ratios
        )
        table = test.to_pandas()
        for name in rows[0]:
            assert same(table[name], rows, name), name


def test_traverse(program: Program) -> None:
    answer = program("traverse", "--slope-deg", "12", "--yaw-deg", "3.5", "--duration-s", "5")
    run = gr.simulate(name="traverse", slope_deg=12, start={"yaw_deg": 3.5}, duration_s=5)
    assert run.outcome == answer["outcome"] and run.energy_error_j == answer["energy_error_j"]
    samples = answer["samples"]
    for name in samples[0].keys() - {"wheels"}:
        assert same(getattr(run, name), samples, name), name
    for k, wheel in enumerate(run.wheel_names):
        rows = [sample["wheels"][k] for sample in samples]
        assert rows[0].pop("wheel") == wheel
        for name in rows[0]:
            assert same(run.wheel[name][:, k], rows, name), name


def test_traverse_of_a_file(program: Program, tmp_path: Any) -> None:
    path = tmp_path / "scenario.toml"
    run = gr.Scenario(soil=gr.Soil("lunar-nominal", cohesion_kpa=0.3), duration_s=3, slope_deg=7)
    path.write_text(run.to_toml())
    answer = program("traverse", str(path))
    assert same(gr.simulate(run).y_m, answer["samples"], "y_m")


def test_heading(program: Program) -> None:
    answer = program("heading", "--slope-deg", "0:24:3")
    level = gr.heading(slope_deg=np.arange(0, 25, 3))
    check_rows(level.columns, answer["rows"])
    assert list(level.to_pandas()) == list(answer["rows"][0])[:-1]
    assert answer["belief"]["samples"] == 40
    check_limits(level, answer)


def check_limits(level: gr.Headings, answer: dict[str, Any]) -> None:
    """The steepest slope, and what is believed."""
    assert level.band is not None
    assert level.band.model_weights == answer["belief"]["model_weights"]
    assert level.limit_slope_deg == answer["limit_slope_deg"]
    assert (level.limit_message, level.limited_by) == (answer["limit_reason"], answer["limited_by"])
    for name in ("limit_slope_deg_p2_5", "limit_slope_deg_p97_5", "draws_mobile", "draws"):
        assert getattr(level.band, name) == answer[name]


def test_heading_on_the_soil_as_written(program: Program) -> None:
    answer = program("heading", "--slope-deg", "0:24:3", "--nominal")
    level = gr.heading(slope_deg=np.arange(0, 25, 3), nominal=True)
    assert level.limit_slope_deg == answer["limit_slope_deg"]
    for name in answer["rows"][0]:
        assert same(getattr(level, name), answer["rows"], name), name
    assert list(level.to_pandas()) == list(answer["rows"][0])


@pytest.mark.parametrize(
    "arguments, settings",
    [
        (["--slope-deg", "0,10,20,30"], {"slope_deg": [0, 10, 20, 30]}),
        (
            ["--slope-deg", "12", "--most-speed-ratio", "1.2", "--rover", "curiosity", "--soil", "mars-sand"],
            {"slope_deg": 12, "most_speed_ratio": 1.2, "rover": "curiosity", "soil": "mars-sand"},
        ),
    ],
    ids=["four wheels", "six wheels"],
)
def test_wheel_speeds(program: Program, arguments: list[str], settings: dict[str, Any]) -> None:
    answer = program("heading", "--wheel-speeds", *arguments)
    found = gr.wheel_speeds(**settings)
    for part, rows in [(found, answer["rows"]), (found.limits, answer["limits"])]:
        table = part.to_pandas()
        assert list(table) == list(rows[0])
        for name in rows[0]:
            assert same(table[name], rows, name), name
    assert len(answer["limits"]) == 4


def test_wheel_speeds_with_several_models(program: Program, monkeypatch: pytest.MonkeyPatch) -> None:
    """All of them take a minute: two show that each has the rows of its own."""
    monkeypatch.setattr("grouser._models.MODELS", ("ishigami", "bekker"))
    found = gr.wheel_speeds(slope_deg=8, model="all")
    table = found.to_pandas()
    assert list(found) == ["ishigami", "bekker"]
    for model, own in table.groupby("model"):
        rows = program("heading", "--wheel-speeds", "--slope-deg", "8", "--model", str(model))["rows"]
        for name in rows[0]:
            assert same(own[name], rows, name), name


def test_heading_map(program: Program) -> None:
    rows = program("heading-map", "--slope-deg", "0,10,30", "--course-deg", "-30,0,30")["rows"]
    table = gr.heading_map(slope_deg=[0, 10, 30], course_deg=[-30, 0, 30]).to_pandas()
    for name in rows[0]:
        assert same(table[name], rows, name), name


def test_validate(program: Program) -> None:
    data = str(DATA / "simulated-wheel-test" / "toyoura-20n.csv")
    answer = program("validate", "--data", data, "--soil", "toyoura", "--wheel", "hakuto")
    found = gr.validate(data, "toyoura", "hakuto")
    assert found.overall == answer["overall"] and found.driven == answer["driven"]
    assert list(found.groups) == answer["rows"]
    for name in answer["cells"][0].keys() - {"motion"}:
        assert same(found.cells[name], answer["cells"], name), name


def test_bands_of_a_wheel_test(program: Program) -> None:
    answer = program(
        "wheel-test", "--soil", "toyoura-uncertain", "--load-n", "10,17", "--slip-angle-deg", "0,15",
        "--slip-ratio", "0:0.4:0.2", "--uncertainty", "--samples", "30", "--seed", "9",
    )  # fmt: skip
    rows = answer["rows"]
    ratios = [row["slip_ratio"] for row in rows[:3]]
    test = gr.wheel_test(
        "toyoura-uncertain", load_n=[10, 17], slip_angle_deg=[0, 15], slip_ratio=ratios,
        uncertainty=True, samples=30, seed=9,
    )  # fmt: skip
    assert test.band is not None and test.band.model_weights == answer["model_weights"]
    table = test.to_pandas()
    for name in rows[0]:
        assert same(table[name], rows, name), name


def test_bands_of_a_map(program: Program) -> None:
    answer = program(
        "heading-map", "--soil", "toyoura,toyoura-uncertain", "--course-deg", "0,90",
        "--slope-deg", "5,21.5", "--uncertainty", "--samples", "20",
    )  # fmt: skip
    rows = answer["rows"]
    found = gr.heading_map(
        soil=["toyoura", "toyoura-uncertain"], course_deg=[0, 90], slope_deg=[5, 21.5],
        uncertainty=True, samples=20,
    )  # fmt: skip
    weights = answer["model_weights"]
    each = weights if isinstance(weights, list) else 2 * [weights]
    assert found.band is not None and list(found.band.model_weights) == each
    table = found.to_pandas()
    for name in rows[0]:
        assert same(table[name], rows, name), name


def test_bands_of_a_traverse(program: Program) -> None:
    answer = program(
        "traverse", "--soil", "toyoura-uncertain", "--slope-deg", "12", "--duration-s", "2",
        "--uncertainty", "--samples", "9", "--seed", "3",
    )  # fmt: skip
    run = gr.simulate(
        name="traverse", soil="toyoura-uncertain", slope_deg=12, duration_s=2,
        uncertainty=True, samples=9, seed=3,
    )  # fmt: skip
    assert run.band is not None and run.band.run == answer["band"]
    assert run.band.model_weights == answer["model_weights"]
    for name in answer["bands"][0]:
        assert same(getattr(run.band, name), answer["bands"], name), name


def test_heading_on_an_uncertain_soil(program: Program) -> None:
    answer = program(
        "heading", "--soil", "toyoura-uncertain", "--slope-deg", "5,15,40", "--uncertainty",
        "--samples", "30", "--seed", "9",
    )  # fmt: skip
    level = gr.heading(
        soil="toyoura-uncertain", slope_deg=[5, 15, 40], uncertainty=True, samples=30, seed=9
    )
    check_rows(level.columns, answer["rows"])
    check_limits(level, answer)


def test_heading_by_a_rule(program: Program) -> None:
    answer = program(
        "heading", "--soil", "toyoura-uncertain", "--slope-deg", "5,12", "--samples", "12",
        "--go-slip-ratio", "0.01",
    )  # fmt: skip
    settings: dict[str, Any] = {"soil": "toyoura-uncertain", "slope_deg": [5, 12], "samples": 12}
    level = gr.heading(**settings, rule={"go_slip_ratio": 0.01})
    check_rows(level.columns, answer["rows"])
    usual = gr.heading(**settings)
    assert level.verdict is not None and usual.verdict is not None
    assert level.verdict.tolist() != usual.verdict.tolist()
    assert level.yaw_deg.tolist() == usual.yaw_deg.tolist()


def test_card(program: Program) -> None:
    answer = program("card", "--soil", "toyoura-uncertain", "--samples", "12", "--seed", "4")
    card = gr.card(soil="toyoura-uncertain", samples=12, seed=4)
    rows = answer["rows"]
    check_rows(card.columns, rows, slice(len(rows)))
    for name in answer["courses"][0]:
        assert same(card.courses.columns[name], answer["courses"], name), name
    for name in ("draws", "limit_slope_deg", "limit_slope_deg_p97_5"):
        assert card.steepest[name] == answer[name]


def test_simulated_stand(program: Program) -> None:
    rows = program(
        "wheel-test", "--soil", "toyoura", "--wheel", "hakuto", "--load-n", "10,60000",
        "--slip-ratio", "0:0.4:0.2", "--slip-angle-deg", "0,15", "--trials", "3", "--seed", "5",
        "--noise-mm", "0.1",
    )["rows"]  # fmt: skip
    ratios = [row["slip_ratio"] for row in rows[:9:3]]
    test = gr.wheel_test(
        load_n=[10, 60000],
        slip_ratio=ratios,
        slip_angle_deg=[0, 15],
        trials=3,
        seed=5,
        noise_mm=0.1,
    )
    table = test.to_pandas()
    assert table.status.tolist() == [row["status"] for row in rows]
    for name in rows[0].keys() - {"status"}:
        assert same(table[name], rows, name), name


def test_ranking_of_all_theories(program: Program, tmp_path: Path) -> None:
    data = (DATA / "simulated-wheel-test" / "toyoura-20n.csv").read_text()
    (tmp_path / "stand.csv").write_text(data)
    case = 'name = "all"\nwheel = "hakuto"\nsoils = ["toyoura", "lunar-nominal"]\n'
    head = 'schema = "data-set/1"\nname = "A stand"\nsource = "simulated"\nfile = "stand.csv"\n'
    (tmp_path / "stand.toml").write_text(f"{head}[[case]]\n{case}")
    rows = program("validate", "--all", "--data-dir", str(tmp_path))["rows"]
    ranking = gr.validate_all(tmp_path)
    assert list(ranking.rows) == rows and len(ranking) == len(rows) > 2
    assert [row["rank"] for row in ranking.rows] == list(range(1, len(rows) + 1))
    assert ranking.to_pandas().drawbar_pull_n_rmse.tolist() == [
        row["overall"]["drawbar_pull_n"]["rmse"] for row in rows
    ]
    assert ranking.plot().get_xlabel() and repr(ranking).startswith("<Ranking")


def test_ranking_on_the_data_sets_of_the_program(program: Program) -> None:
    answer = program("validate", "--all")
    ranking = gr.validate_all()
    for name in ("rows", "yardsticks", "models", "sets"):
        assert list(getattr(ranking, name)) == answer[name], name
    assert {row["data_set"] for row in ranking.rows} == {
        "CMU single wheel",
        "Published wheel tests",
        "VIPER rover up slopes, simulated",
        "HAKUTO across slopes",
    }
    assert len(ranking.to_pandas()) == len(ranking.plot().patches) == len(answer["rows"])


def test_a_rover_on_slopes(program: Program) -> None:
    answer = program(
        "validate", "--data", "viper-slip-slope", "--soil", "grc-1", "--rover", "mgru3",
        "--model", "bekker", "--where", "slope_deg!=0",
    )  # fmt: skip
    found = gr.validate_slopes(
        "viper-slip-slope", "grc-1", "mgru3", model="bekker", where="slope_deg!=0"
    )
    assert found.overall == answer["overall"] and list(found.yardsticks) == answer["yardsticks"]
    table = found.to_pandas()
    for name in ("slope_deg", "measured_slip_ratio", "slip_ratio"):
        assert same(table[name], answer["rows"], name), name
    assert found.plot().get_ylabel() and repr(found) == "<SlopeValidation on 6 slopes>"
    with pytest.raises(gr.DocumentError, match="the slope"):
        gr.validate_slopes("cmu-single-wheel", "grc-1", "mgru3")


def test_a_data_set_of_the_program_by_its_name(program: Program) -> None:
    wheel, where = "cmu-smooth", "slip_angle_deg=15"
    answer = program(
        "validate", "--data", "cmu-single-wheel", "--soil", "direct-90", "--wheel", wheel,
        "--where", where,
    )  # fmt: skip
    found = gr.validate("cmu-single-wheel", "direct-90", wheel, where=where)
    assert found.overall == answer["overall"] and list(found.yardsticks) == answer["yardsticks"]
    with pytest.raises(gr.DocumentNotFoundError, match="did you mean `cmu-single-wheel`"):
        gr.validate("cmu-single-whel", "direct-90", wheel)


def test_folders_without_data_sets(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="no such folder"):
        gr.validate_all(tmp_path / "none")
    with pytest.raises(gr.DocumentNotFoundError, match="no known data set"):
        gr.validate_all(tmp_path)


def test_every_model_of_the_program(program: Program) -> None:
    asked = ("heading", "--slope-deg", "5,12", "--model", "all")
    rows = program(*asked, "--nominal")["rows"]
    found = gr.heading(slope_deg=[5, 12], model="all", nominal=True).to_pandas()
    for name in rows[0]:
        assert same(found[name], rows, name), name
    rows = program(*asked, "--samples", "3")["rows"]
    check_rows(gr.heading(slope_deg=[5, 12], model="all", samples=3).to_pandas(), rows)
