"""Studies over what varies: those of one document after the other, in the shape that was asked for."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import grouser as gr

NAN = float("nan")
SLOPES = [5.0, 12.0, 25.0]
MOTOR = {
    "resistance_ohm": 10.0,
    "torque_constant_nm_a": 0.01,
    "gear_ratio": 250.0,
    "gear_efficiency": 0.6,
}
LEGS = [{"drive_m": 0.3, "yaw_deg": 5.0}, {"turn_deg": 10.0}]
WAYS = [{"name": "short", "leg": LEGS[:1]}, {"name": "long", "leg": LEGS}]


def check_equal(found: Any, entry: Any, one: Mapping[str, Any], names: tuple[str, ...] = ()) -> None:
    """An entry of a sweep has the bits of a table that a study of it alone has."""
    names = names or tuple(name for name in found.columns if name in one)
    assert len(names) > 5
    for name in names:
        cells, own = np.ravel(found[name][entry]), np.ravel(np.asarray(one[name]))
        if own.dtype.kind in "fiu":
            np.testing.assert_array_equal(cells, own.astype(float), name)
        else:
            assert cells.tolist() == own.tolist(), name


def test_headings_are_those_of_each_scenario() -> None:
    angles, masses = [34.0, 38.0], [5.24, 6.0]
    vary = {"soil.friction_angle_deg": np.reshape(angles, (2, 1)), "rover.body.mass_kg": masses}
    found = gr.heading(rover="hakuto", slope_deg=SLOPES, vary=vary, nominal=True)
    assert found.shape == (2, 2, 3) and found.entries == (2, 2)
    for i, angle in enumerate(angles):
        for j, mass in enumerate(masses):
            soil = gr.Soil("toyoura", friction_angle_deg=angle)
            rover = gr.Rover("hakuto", body={"mass_kg": mass})
            one = gr.heading(rover=rover, soil=soil, slope_deg=SLOPES, nominal=True)
            check_equal(found, (i, j), one.columns)
            assert set(found.limit_slope_deg[i, j]) == {one.limit_slope_deg}
            assert set(found.limited_by[i, j]) == {one.limited_by}
    # A slope for each entry.
    own = gr.heading(vary={**vary, "slope_deg": [5.0, 25.0]}, rover="hakuto", nominal=True)
    np.testing.assert_array_equal(own.yaw_deg[:, 0], found.yaw_deg[:, 0, 0])
    np.testing.assert_array_equal(own.yaw_deg[:, 1], found.yaw_deg[:, 1, 2])


def test_soils_rovers_words_and_whole_numbers() -> None:
    soils, rovers = ["toyoura", "lunar-nominal"], ["hakuto-steered", gr.Rover("hakuto-rockers")]
    found = gr.heading(
        rover=np.array(rovers, dtype=object)[:, None],
        soil=soils,
        slope_deg=[10.0],
        vary={"model": np.array(["ishigami", "bekker"])[:, None, None]},
        nominal=True,
    )
    assert found.shape == (2, 2, 2, 1)
    for i, model in enumerate(["ishigami", "bekker"]):
        for j, rover in enumerate(rovers):
            for k, soil in enumerate(soils):
                keys: dict[str, Any] = {"rover": rover, "soil": soil, "model": model}
                one = gr.heading(slope_deg=[10.0], nominal=True, **keys)
                check_equal(found, (i, j, k), one.columns)
    assert found.inputs["rover"][:, 0].tolist() == ["hakuto-steered", gr.Rover(rovers[1]).name]
    assert found.inputs["soil"].tolist() == [gr.Soil(it).name for it in soils]
    steered: dict[str, Any] = {"rover": "hakuto-steered", "steering": "crab", "slope_deg": [10.0]}
    crab = gr.heading(soil=soils, vary={}, **steered)
    for k, soil in enumerate(soils):
        check_equal(crab, k, gr.heading(soil=soil, **steered).columns)
    # A whole number and a word of a wheel and a soil.
    stand: dict[str, Any] = {"load_n": [10.0, 20.0], "slip_ratio": [0.1, 0.3], "slip_angle_deg": [9.0]}
    words = {"wheel.grousers.count": [8, 24], "soil.bulldozing.law": [["sine"], ["none"]]}
    test = gr.wheel_test(vary=words, **stand)
    assert test.shape == (2, 2, 2, 1, 2)
    for i, law in enumerate(["sine", "none"]):
        for k, count in enumerate([8, 24]):
            soil = gr.Soil("toyoura", bulldozing={"law": law})
            wheel = gr.Wheel("hakuto", grousers={"count": count})
            check_equal(test, (i, k), gr.wheel_test(soil, wheel, **stand)._table())
    assert (test.side_force_n[0] != test.side_force_n[1]).any()
    counts = {"rover.wheel_unit.wheel.grousers.count": [8, 24]}
    few = gr.heading(slope_deg=[10.0], vary=counts, nominal=True)
    wheel_unit = {"wheel": {"grousers": {"count": 8}}}
    check_equal(few, 0, gr.heading(
        rover=gr.Rover("hakuto", wheel_unit=wheel_unit), slope_deg=[10.0], nominal=True
    ).columns)
    assert few.inputs["rover.wheel_unit.wheel.grousers.count"].dtype.kind == "i"


def test_runs_of_words_and_rovers() -> None:
    vary = {"model": [["ishigami"], ["bekker"]], "rover": ["hakuto", "hakuto-rockers"]}
    ends = gr.rollout(gr.Scenario(duration_s=0.5), slope_deg=8.0, vary=vary)
    for i, model in enumerate(["ishigami", "bekker"]):
        for j, rover in enumerate(["hakuto", "hakuto-rockers"]):
            one = gr.simulate(duration_s=0.5, slope_deg=8.0, model=model, rover=rover)
            assert ends.y_m[i, j] == one.y_m[-1] and ends.energy_j[i, j] == one.energy_j[-1]
    assert ends.inputs["rover"].tolist() == ["hakuto", "hakuto-rockers"]
    odd = gr.rollout(duration_s=0.5, vary={"model": ["ishigami", "none"]}, outside="nan")
    assert odd.outcome.tolist() == ["completed", "failed"] and "model" in odd.message[1]


def test_maps_of_headings() -> None:
    asked: dict[str, Any] = {"slope_deg": [5.0, 30.0], "course_deg": [-30.0, 0.0, 30.0]}
    vary = {"soil.cohesion_kpa": [0.2, 0.9], "gravity_m_s2": [[9.81], [1.62]]}
    found = gr.heading_map(vary=vary, **asked)
    assert found.shape == (2, 2, 3, 2) and tuple(found.axes) == ("course_deg", "slope_deg")
    for i, gravity in enumerate([9.81, 1.62]):
        for j, cohesion in enumerate([0.2, 0.9]):
            soil = gr.Soil("toyoura", cohesion_kpa=cohesion)
            one = gr.heading_map(soil=soil, gravity_m_s2=gravity, **asked)
            check_equal(found, (i, j), one._table())
    on_soils = gr.heading_map(soil=["toyoura", "dry-sand"], vary={}, **asked)
    together = gr.heading_map(soil=["toyoura", "dry-sand"], **asked)
    np.testing.assert_array_equal(on_soils.slip_ratio, together.slip_ratio)
    sampled: dict[str, Any] = {**asked, "uncertainty": True, "samples": 4}
    believed = gr.heading_map(soil="toyoura-uncertain", vary={"gravity_m_s2": [9.81, 1.62]}, **sampled)
    one = gr.heading_map(soil="toyoura-uncertain", gravity_m_s2=1.62, **sampled)
    check_equal(believed, 1, one._table())


def test_speeds_of_wheels() -> None:
    motored = gr.Rover("hakuto", motor=MOTOR)
    asked: dict[str, Any] = {"slope_deg": [5.0, 40.0], "most_speed_ratio": 1.3}
    found = gr.wheel_speeds(rover=[motored, "hakuto-steered"], vary={}, **asked)
    for k, rover in enumerate([motored, "hakuto-steered"]):
        one = gr.wheel_speeds(rover=rover, **asked)
        check_equal(found, k, one._table())
        check_equal(found.limits, k, one.limits._table())
    assert found.shape == (2, 2, 3) and found.limits.shape == (2, 4)
    data = found.to_xarray(["rover"]).sel(slope_deg=5.0, wheels="by-side")
    assert data["front-left.speed_ratio"].dims == ("rover",)


@pytest.mark.parametrize("alternatives", [False, True])
def test_missions_and_their_legs(alternatives: bool) -> None:
    legs: dict[str, Any] = {"alternative": WAYS} if alternatives else {"leg": LEGS}
    plan = gr.Mission(slope_deg=4.0, simulation="quasi-steady", **legs)
    vary = {"soil.cohesion_kpa": [0.2, 0.9], "slope_deg": [[4.0], [45.0]]}
    found = gr.mission(plan, vary=vary)
    for i, slope in enumerate([4.0, 45.0]):
        for j, cohesion in enumerate([0.2, 0.9]):
            one = gr.mission(plan, slope_deg=slope, soil={"cohesion_kpa": cohesion})
            ways = list(one.alternatives.values()) or [one]
            rows = [way._row() for way in ways]
            check_equal(found, (i, j), {name: [row[name] for row in rows] for name in rows[0]})
            for k, way in enumerate(ways):
                entry = (i, j, k) if alternatives else (i, j)
                begun = (*entry, slice(len(way.legs)))
                check_equal(found.legs, begun, way.legs._table())
                assert np.isnan(found.legs.distance_m[entry][len(way.legs) :]).all()
    assert found.shape == ((2, 2, 2) if alternatives else (2, 2))
    assert found.legs.axes["leg"].tolist() == [1, 2]
    if not alternatives:
        far = gr.mission(plan, vary={"leg.0.drive_m": [0.1, 0.4]}, soil=["toyoura", "dry-sand"])
        one = gr.mission(plan, leg=[{"drive_m": 0.4, "yaw_deg": 5.0}, LEGS[1]], soil="dry-sand")
        check_equal(far, 1, one._row())
        risky = gr.mission(plan, vary={"slope_deg": [4.0, 8.0]}, samples=4)
        alone = gr.mission(plan, slope_deg=8.0, samples=4)
        check_equal(risky, 1, {**alone._row(), **alone.risk})


def test_answers_over_samples_are_those_of_each_document() -> None:
    soils, slopes = ["toyoura", "toyoura-uncertain"], [5.0, 15.0]
    vary = {"rover.body.mass_kg": [[5.0], [6.0]]}
    asked: dict[str, Any] = {"slope_deg": slopes, "samples": 4}
    for study in (gr.heading, gr.card):
        call: Callable[..., Any] = study
        found = call(soil=soils, vary=vary, **asked)
        assert found.shape == (2, 2, 2) and set(found.verdict.ravel()) <= {
            *("go", "caution", "cannot_tell", "no_go")
        }
        for i, mass in enumerate([5.0, 6.0]):
            for j, soil in enumerate(soils):
                one = call(soil=soil, rover=gr.Rover("hakuto", body={"mass_kg": mass}), **asked)
                check_equal(found, (i, j), one.columns)


def test_wheel_tests() -> None:
    wheels = ["hakuto", gr.Wheel("hakuto", radius_m=0.12)]
    stand: dict[str, Any] = {"load_n": [10.0, 1e5], "slip_ratio": [0.1, 0.3], "slip_angle_deg": [0, 9]}
    vary = {"soil.cohesion_kpa": [[[0.0]], [[0.7]]], "gravity_m_s2": [[9.81], [1.62]]}
    found = gr.wheel_test("toyoura", wheels, vary=vary, **stand)
    assert found.shape == (2, 2, 2, 2, 2, 2)
    for i, cohesion in enumerate([0.0, 0.7]):
        for j, gravity in enumerate([9.81, 1.62]):
            for k, wheel in enumerate(wheels):
                soil = gr.Soil("toyoura", cohesion_kpa=cohesion)
                one = gr.wheel_test(soil, wheel, gravity_m_s2=gravity, **stand)
                check_equal(found, (i, j, k), one._table())
    assert set(found.status.ravel()) > {"ok"}
    models = gr.wheel_test(vary={"soil.cohesion_kpa": [0.1, 0.2]}, model="all", **stand)
    check_equal(models["rft"], 1, gr.wheel_test(
        gr.Soil("toyoura", cohesion_kpa=0.2), model="rft", **stand
    )._table())
    both = gr.settle(["toyoura", "dry-sand"], np.array([wheels]).T, load_n=17.0, slip_ratio=0.2)
    deep = gr.wheel_forces("toyoura", wheels, sinkage_mm=10.0, slip_ratio=0.2)
    for k, wheel in enumerate(wheels):
        one = gr.settle("dry-sand", wheel, load_n=17.0, slip_ratio=0.2)
        assert both.drawbar_pull_n[k, 1] == one.drawbar_pull_n
        one = gr.wheel_forces("toyoura", wheel, sinkage_mm=10.0, slip_ratio=0.2)
        assert deep.drawbar_pull_n[k] == one.drawbar_pull_n
    with pytest.raises(gr.ParameterError, match="one wheel"):
        gr.settle("toyoura", wheels, load_n=17.0, slip_ratio=0.2, gradients="load_n")


def test_results_are_tables_datasets_and_files(tmp_path: Path) -> None:
    xarray = pytest.importorskip("xarray")
    vary = {"soil.friction_angle_deg": [34.0, 120.0], "rover": [["hakuto"], ["hakuto-steered"]]}
    found = gr.heading(slope_deg=[5.0, 25.0], vary=vary, nominal=True, outside="nan")
    table = found.to_pandas()
    assert len(table) == len(found) == 8
    assert table["slope_deg"].tolist() == [5.0, 25.0] * 4
    assert table["rover"].iloc[-1] == "hakuto-steered"
    assert found.to_arrow().num_rows == 8
    over = found.to_xarray(dims=["rover", "soil.friction_angle_deg"])
    assert over.yaw_deg.dims == ("rover", "soil.friction_angle_deg", "slope_deg")
    assert over.yaw_deg.attrs["units"] == "°" and "holds the course" in over.yaw_deg.attrs["long_name"]
    assert over["soil.friction_angle_deg"].attrs["units"] == "°"
    limited = over.limited_by.sel({"soil.friction_angle_deg": 120.0})
    assert set(limited.values.ravel()) == {""}
    over.to_netcdf(tmp_path / "sweep.nc")
    with xarray.open_dataset(tmp_path / "sweep.nc") as read:
        xarray.testing.assert_identical(read.load(), over)
    again = pickle.loads(pickle.dumps(found))
    np.testing.assert_array_equal(again.yaw_deg, found.yaw_deg)
    assert repr(found) == f"<Sweep of shape (2, 2, 2): {(table.status == 'ok').sum()} of 8 ok>"
    with pytest.raises(AttributeError, match="has no attribute 'yaw'; it has .*yaw_deg"):
        found.yaw


#: Studies with what they need beside `vary`.
STUDIES: dict[str, tuple[Callable[..., gr.Sweep], dict[str, Any]]] = {
    "heading": (gr.heading, {"slope_deg": [5.0], "nominal": True}),
    "heading[samples]": (gr.heading, {"slope_deg": [5.0], "samples": 2}),
    "heading_map": (gr.heading_map, {"slope_deg": [5.0], "course_deg": [0.0]}),
    "wheel_speeds": (gr.wheel_speeds, {"slope_deg": [5.0]}),
    "wheel_test": (gr.wheel_test, {"load_n": 17.0, "slip_ratio": 0.2}),
    "card": (gr.card, {"slope_deg": [5.0], "samples": 2}),
    "mission": (
        lambda **keys: gr.mission({"leg": LEGS[:1], "simulation": "quasi-steady"}, **keys),
        {},
    ),
}


@pytest.mark.parametrize("name", STUDIES)
def test_what_is_out_of_range_is_an_error_or_left_out(name: str) -> None:
    call, keys = STUDIES[name]
    vary = {"soil.friction_angle_deg": [38.0, 120.0, NAN]}
    with pytest.raises((gr.ParameterError, gr.DocumentError), match="friction_angle_deg.* 120"):
        call(vary=vary, **keys)
    found = call(vary=vary, outside="nan", **keys)
    status = found.status.reshape(3, -1)[:, 0]
    assert status[0] == "ok" and found.shape[0] == 3
    assert "range" in status[1] or "120" in status[1]
    assert "NaN" in status[2]
    column = found[{"mission": "energy_j", "wheel_test": "sinkage_mm"}.get(name, "yaw_deg")]
    assert np.isfinite(column.reshape(3, -1)[:, 0]).tolist() == [True, False, False]
    nothing = call(vary={"soil.friction_angle_deg": [120.0]}, outside="nan", **keys)
    assert nothing.status.ravel()[0] != "ok" and len(nothing.to_pandas()) == len(nothing)
    assert call(vary={"soil.friction_angle_deg": []}, **keys).shape[0] == 0
    assert call(vary={}, **keys).entries == ()
    with pytest.raises((gr.ParameterError, gr.DocumentError), match="frictn"):
        call(vary={"soil.frictn": [1.0]}, **keys)
    with pytest.raises(gr.ParameterError, match="outside is"):
        call(vary=vary, outside="both", **keys)
    if "slope_deg" in keys:
        with pytest.raises(gr.ParameterError, match="slope_deg is given twice"):
            call(vary={"slope_deg": [5.0, 6.0]}, **keys)


def test_what_does_not_go_with_varying_is_refused_by_name() -> None:
    vary = {"gravity_m_s2": [1.62, 9.81]}
    stand: dict[str, Any] = {"load_n": 17.0, "slip_ratio": 0.2, "vary": vary}
    for call in (
        lambda: gr.heading(vary=vary, nominal=True, gradients="gravity_m_s2"),
        lambda: gr.wheel_test(**stand, trials=3),
        lambda: gr.wheel_test(**stand, uncertainty=True),
    ):
        with pytest.raises(gr.ParameterError, match="vary does not go with") as found:
            call()
        assert found.value.name == "vary"
    with pytest.raises(gr.ParameterError, match="steer"):
        gr.heading(rover="hakuto", steering="crab", vary={}, nominal=True)


#: A wheel on sand.
TOYOURA = {"soil": "toyoura", "wheel": "hakuto"}


@pytest.mark.parametrize("outside", ["raise", "nan"])
def test_wheels_without_a_whole_number_or_a_word_have_no_results(outside: Any) -> None:
    counts = {"wheel.grousers.count": [8, 24, NAN]}
    stand: dict[str, Any] = {"slip_ratio": 0.2, "outside": outside}
    wheels = gr.settle("toyoura", "hakuto", load_n=17.0, vary=counts, **stand)
    assert wheels.status.tolist() == [0, 0, 2] and np.isnan(wheels.torque_nm[2])
    assert wheels.load_n.tolist() == [17.0] * 3
    forces = gr.wheel_forces("toyoura", "hakuto", sinkage_mm=9.0, vary=counts, **stand)
    assert np.isfinite(forces.torque_nm).tolist() == [True, True, False]
    test = gr.wheel_test(load_n=17.0, vary=counts, **stand)
    assert test.status.ravel().tolist() == ["ok", "ok", "an input is NaN"]
    laws = {"soil.bulldozing.law": np.array([["sine"], [NAN]], dtype=object), **counts}
    both = gr.settle("toyoura", "hakuto", load_n=17.0, vary=laws, **stand)
    assert both.status.tolist() == [[0, 0, 2], [2, 2, 2]]
    none = gr.settle("toyoura", "hakuto", load_n=17.0, vary={"wheel.grousers.count": []}, **stand)
    assert none.shape == (0,)


def test_whole_numbers_and_words_of_wheels_out_of_range_are_left_out() -> None:
    counts = {"wheel.grousers.count": [-1, 16, NAN]}
    stand: dict[str, Any] = {**TOYOURA, "load_n": 17.0, "slip_ratio": 0.2}
    with pytest.raises(gr.ParameterError, match="count` is -1"):
        gr.settle(**stand, vary=counts)
    wheels = gr.settle(**stand, vary=counts, outside="nan")
    assert wheels.status.tolist() == [3, 0, 2]
    wheel = gr.Wheel("hakuto", grousers={"count": 16})
    assert wheels.torque_nm[1] == gr.settle(**{**stand, "wheel": wheel}).torque_nm
    test = gr.wheel_test(load_n=17.0, slip_ratio=0.2, vary=counts, outside="nan")
    assert test.status.ravel()[0] == "a number is out of its range"
    laws = {"soil.bulldozing.law": ["sine", "cosine"]}
    steep = gr.settle(**stand, vary=laws, gradients="load_n", outside="nan").gradient
    assert steep is not None and np.isfinite(steep["torque_nm"][:, 0]).tolist() == [True, False]
    odd = {"soil.bulldozing.law": ["sine", "cosine"], "soil.cohesion_kpa": [-1.0, 0.5]}
    assert gr.settle(**stand, vary=odd, outside="nan").status.tolist() == [3, 3]


#: Values that are no arrays of one shape without masks and of one order of axes, and what is said.
UNFIT: dict[str, tuple[dict[str, Any], str]] = {
    "masked": (
        {"soil.cohesion_kpa": np.ma.array([0.1, 0.2], mask=[False, True])},
        "1 masked entry",
    ),
    "masked words": (
        {"soil.model": np.ma.array(["rft", "bekker"], mask=[False, True])},
        "1 masked entry",
    ),
    "ragged": ({"soil.cohesion_kpa": [[0.1], [0.1, 0.2]]}, "cohesion_kpa is ragged"),
    "ragged words": ({"soil.model": [["rft"], ["rft", "bekker"]]}, "soil.model is ragged"),
    "complex": ({"soil.cohesion_kpa": [1j]}, "must be real numbers"),
    "shapes": (
        {"soil.cohesion_kpa": [0.1, 0.2], "soil.friction_angle_deg": [30.0, 35.0, 38.0]},
        r"shapes do not broadcast: .*cohesion_kpa \(2,\), .*friction_angle_deg \(3,\)",
    ),
    "shapes of words": (
        {"soil.model": ["rft", "bekker"], "soil.bulldozing.law": ["sine", "none", "sign"]},
        r"shapes do not broadcast: .*model \(2,\), .*law \(3,\)",
    ),
}


@pytest.mark.parametrize("name", [*STUDIES, "settle", "rollout"])
def test_what_varies_is_checked_before_it_is_an_array(name: str) -> None:
    stand: dict[str, Any] = {"load_n": 17.0, "slip_ratio": 0.2}
    others: dict[str, Any] = {
        "settle": lambda **keys: gr.settle("toyoura", "hakuto", **stand, **keys),
        "rollout": lambda **keys: gr.rollout(duration_s=0.1, **keys),
    }
    call, keys = STUDIES[name] if name in STUDIES else (others[name], {})
    for vary, said in UNFIT.values():
        with pytest.raises(gr.ParameterError, match=said):
            call(vary=vary, **keys)
    xarray = pytest.importorskip("xarray")
    across = {
        "soil.cohesion_kpa": xarray.DataArray([0.1, 0.2], dims="a"),
        "soil.model": xarray.DataArray(["rft", "bekker"], dims="b"),
    }
    with pytest.raises(gr.ParameterError, match="is a DataArray over a, soil.model one over b"):
        call(vary=across, **keys)


@pytest.mark.parametrize("study", [gr.heading, gr.card])
def test_without_a_result_there_are_rows_and_a_status(study: Callable[..., Any]) -> None:
    asked: dict[str, Any] = {"slope_deg": [5.0, 6.0], "samples": 3, "outside": "nan"}
    none = study(**asked, vary={"soil.cohesion_kpa": [-1.0, NAN]})
    assert none.shape == none.yaw_deg.shape == (2, 2) and np.isnan(none.yaw_deg).all()
    assert "-1" in none.status[0, 1] and "NaN" in none.status[1, 0]
    empty = study(**asked, vary={"soil.cohesion_kpa": []})
    assert repr(empty) == "<Sweep of shape (0, 2): 0 of 0 ok>" and empty.status.shape == (0, 2)


@pytest.mark.parametrize("name", STUDIES)
def test_keys_and_names_that_are_not_there_are_errors_always(name: str) -> None:
    call, keys = STUDIES[name]
    wrong: dict[str, list[Any]] = {"soil.frictn": [1.0], "soil.law": ["sine"], "soil": ["sandd"]}
    if name != "wheel_test":
        wrong |= {"modell": ["rft"], "rover": ["hakutoo"], "rover.boddy": [{"mass_kg": 1.0}]}
    for key, values in wrong.items():
        with pytest.raises((gr.ParameterError, gr.DocumentNotFoundError), match="unknown key|is no"):
            call(vary={key: values}, outside="nan", **keys)
    if "samples" in keys:
        with pytest.raises(gr.ParameterError, match="samples is 1"):
            call(vary={"gravity_m_s2": [9.81]}, outside="nan", **{**keys, "samples": 1})


@pytest.mark.parametrize("name", [it for it in STUDIES if it != "wheel_test"])
def test_what_is_given_twice_or_empty_is_refused(name: str) -> None:
    call, keys = STUDIES[name]
    both = {"model": "bekker", "rover": "hakuto", "soil": "toyoura", "gravity_m_s2": 1.62}
    for key, value in both.items():
        with pytest.raises(gr.ParameterError, match=f"^{key} is given twice") as found:
            call(vary={key: [value]}, **{key: value}, **keys)
        assert found.value.name == key
    for key in ("model", "rover", "soil"):
        with pytest.raises(gr.ParameterError, match=f"^{key} is empty, it must be at least one"):
            call(vary={key: []}, **keys)
    with pytest.raises(gr.ParameterError, match="soil is given twice"):
        gr.rollout(duration_s=0.1, soil="toyoura", vary={"soil": ["dry-sand"]})


@pytest.mark.parametrize("nominal", [True, False])
def test_a_part_and_what_is_in_it_vary_together(nominal: bool) -> None:
    wheel = "rover.wheel_unit.wheel"
    wheels = ["hakuto", gr.Wheel("hakuto", radius_m=0.12)]
    vary = {wheel: wheels, f"{wheel}.grousers.count": [[8], [16]]}
    asked: dict[str, Any] = {"slope_deg": [10.0], "nominal": nominal, "samples": 2}
    found = gr.heading(vary={**vary, f"{wheel}.width_m": 0.07}, **asked)
    last = gr.Wheel("hakuto", radius_m=0.12, width_m=0.07, grousers={"count": 16})
    rover = gr.Rover("hakuto", wheel_unit={"wheel": last})
    check_equal(found, (1, 1), gr.heading(rover=rover, **asked).columns)


def test_soils_and_wheels_of_wheel_tests_vary() -> None:
    stand: dict[str, Any] = {"load_n": [10.0, 20.0], "slip_ratio": [0.2, 0.3]}
    wide = gr.Wheel("hakuto", width_m=0.12)
    kinds = {"soil": [["toyoura"], ["dry-sand"]], "wheel": ["hakuto", wide]}
    found = gr.wheel_test(vary={**kinds, "soil.cohesion_kpa": 0.3}, **stand)
    assert found.shape == (2, 2, 2, 1, 2) and found.inputs["soil"].shape == (2, 1)
    one = gr.wheel_test(gr.Soil("dry-sand", cohesion_kpa=0.3), wide, **stand)
    check_equal(found, (1, 1), one._table())
    for key, values in {"soil": ["dry-sand"], "wheel": [wide], "gravity_m_s2": [1.62]}.items():
        with pytest.raises(gr.ParameterError, match=f"^{key} is given twice"):
            gr.wheel_test(vary={key: values}, **{key: values[0]}, **stand)
    laid: dict[str, Any] = {**TOYOURA, "load_n": 17.0, "slip_ratio": 0.2}
    refused = {"soil": "given twice", "wheel": "given twice", "model": "vary soil.model"}
    for key, said in refused.items():
        with pytest.raises(gr.ParameterError, match=said):
            gr.settle(vary={key: ["rft"]}, **laid)
    with pytest.raises(gr.ParameterError, match=r"broadcast: soil \(2,\), model \(3,\)"):
        soils = {**laid, "soil": ["toyoura", "dry-sand"]}
        gr.settle(vary={"soil.model": ["rft", "rft", "bekker"]}, **soils)
    with pytest.raises(gr.ParameterError, match="soil.model is given twice"):
        gr.settle(vary={"soil.model": ["rft"]}, model="bekker", **laid)


#: Calls that take one description at a time, with what they need.
OTHERS: dict[str, tuple[Any, ...]] = {
    "simulate": (),
    "design": ("lightest-wheel",),
    "map": (gr.Terrain([[0.0, 0.0], [0.0, 0.0]], cell_size_m=1.0),),
    "forecast": (),
    "learn": ({"time_s": [0.0, 1.0]},),
    "replay": ({"time_s": [0.0, 1.0]},),
    "validate": ("data.csv", "toyoura", "hakuto"),
    "validate_slopes": ("hakuto-slope", "toyoura", "hakuto"),
    "calibrate": ("data.csv", "toyoura", "hakuto"),
    "calibrate_plates": ("cullinan-plates", "toyoura"),
    "calibrate_shear": ("cullinan-shear", "toyoura"),
    "Scenario": (),
    "Learner": (),
}


@pytest.mark.parametrize("name", OTHERS)
def test_other_calls_say_what_takes_vary(name: str) -> None:
    with pytest.raises(gr.ParameterError, match="heading_map.*rollout is for runs.*Campaign") as found:
        needed = {"forecast": {"site": "moon"}, "calibrate": {"fit": "cohesion_kpa"}}.get(name, {})
        getattr(gr, name)(*OTHERS[name], **needed, vary={"soil.cohesion_kpa": [0.1]})
    assert found.value.name == "vary"
