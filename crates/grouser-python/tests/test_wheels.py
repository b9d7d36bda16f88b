"""Arrays of wheels: they broadcast as ufuncs do, and each has the bits that it has alone."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest

import grouser as gr


def test_arguments_broadcast_as_those_of_ufuncs() -> None:
    loads, ratios = np.array([[10.0], [20.0]]), np.array([0.1, 0.2, 0.4])
    many = gr.settle("toyoura", "hakuto", load_n=loads, slip_ratio=ratios, slip_angle_deg=5)
    assert many.shape == (2, 3) and many.load_n.shape == (2, 3)
    for (i, j), sinkage in np.ndenumerate(many.sinkage_mm):
        one = gr.settle(
            "toyoura", "hakuto", load_n=loads[i, 0], slip_ratio=ratios[j], slip_angle_deg=5.0
        )
        assert one.shape == () and one.sinkage_mm == sinkage
        assert one.side_force_n == many.side_force_n[i, j]


def test_soils_broadcast_too() -> None:
    soils = [gr.Soil("toyoura"), "lunar-nominal", gr.Soil("toyoura")]
    column = np.array(soils, dtype=object)[:, None]
    many = gr.settle(column, "hakuto", load_n=[10.0, 17.0], slip_ratio=0.2)
    assert many.shape == (3, 2)
    assert (many.sinkage_mm[0] == many.sinkage_mm[2]).all()
    assert (
        many.sinkage_mm[1, 1]
        == gr.settle("lunar-nominal", "hakuto", load_n=17, slip_ratio=0.2).sinkage_mm
    )
    assert gr.settle(soils, "hakuto", load_n=17.0, slip_ratio=0.2).shape == (3,)


def test_nothing_in_nothing_out() -> None:
    assert gr.settle("toyoura", "hakuto", load_n=[], slip_ratio=0.2).shape == (0,)
    assert gr.settle([], "hakuto", load_n=17.0, slip_ratio=0.2).shape == (0,)
    assert gr.settle("toyoura", "hakuto", load_n=np.zeros((2, 0)), slip_ratio=0.2).shape == (2, 0)


def test_forces_at_the_settled_sinkage_carry_the_load() -> None:
    """F_z = W to 1e-12, as the library says; a sinkage in millimetres rounds its last digit, and
    F_z grows with its power of 2.2."""
    wheel = gr.settle(
        "toyoura", "hakuto", load_n=[5.0, 17.0, 80.0], slip_ratio=0.3, slip_angle_deg=10
    )
    forces = gr.wheel_forces(
        "toyoura", "hakuto", sinkage_mm=wheel.sinkage_mm, slip_ratio=0.3, slip_angle_deg=10
    )
    np.testing.assert_allclose(forces.normal_force_n, wheel.load_n, rtol=1e-11)
    np.testing.assert_allclose(forces.drawbar_pull_n, wheel.drawbar_pull_n, rtol=1e-11)


def test_a_wheel_that_sinks_is_a_result() -> None:
    wheels = gr.settle("toyoura", "hakuto", load_n=[17.0, 5e4], slip_ratio=0.2)
    assert wheels.status.tolist() == [0, 1] and wheels.status.dtype == np.int8
    assert np.isnan(wheels.sinkage_mm).tolist() == [False, True]
    assert np.isnan(wheels.capacity_n[0]) and wheels.capacity_n[1] < 5e4
    assert wheels.messages[0] == "ok" and "down to axle depth" in wheels.messages[1]


def test_a_soil_brings_its_theory_and_the_caller_may_choose_another() -> None:
    def pull(**model: Any) -> float:
        return float(
            gr.settle(
                "cmu-direct90-smooth", "cmu-smooth", load_n=40.0, slip_ratio=0.2, **model
            ).drawbar_pull_n
        )

    own = gr.Soil("cmu-direct90-smooth").model
    assert pull() == pull(model=own) != pull(model="bekker")
    with pytest.raises(gr.ParameterError, match="model"):
        pull(model="none")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"load_n": -1.0}, "load_n is -1, it must be from 0 to 100000"),
        ({"load_n": [1.0, np.inf]}, r"load_n is inf \(entry 1\)"),
        ({"slip_ratio": 2.5}, "slip_ratio is 2.5"),
        ({"slip_angle_deg": [0.0, 91.0]}, "slip_angle_deg is 91"),
        ({"load_n": "17"}, "load_n has dtype <U2, it must be real numbers"),
        ({"load_n": 1j}, "real numbers"),
        ({"load_n": [[1.0], [1.0, 2.0]]}, "ragged"),
        ({"load_n": None}, "real numbers"),
        ({"load_n": [1.0, 2.0], "slip_ratio": [0.1, 0.2, 0.3]}, r"do not broadcast: load_n \(2,\)"),
        ({"gravity_m_s2": -1.0}, "gravity_m_s2"),
    ],
)
def test_errors_name_the_allowed_values(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(gr.ParameterError, match=message):
        gr.settle("toyoura", "hakuto", **{"load_n": 17.0, "slip_ratio": 0.2, **arguments})


def test_a_sinkage_ends_at_the_axle() -> None:
    with pytest.raises(gr.ParameterError, match="it must be from 0 to 110"):
        gr.wheel_forces("toyoura", "hakuto", sinkage_mm=120.0, slip_ratio=0.2)


def test_threads_share_objects() -> None:
    soil, wheel = gr.Soil("toyoura"), gr.Wheel("hakuto")
    ratios = np.linspace(0.0, 0.9, 200)

    def pulls(_: int) -> bytes:
        return gr.settle(soil, wheel, load_n=17.0, slip_ratio=ratios).drawbar_pull_n.tobytes()

    with ThreadPoolExecutor(8) as pool:
        assert len(set(pool.map(pulls, range(32)))) == 1


def test_tables_have_units() -> None:
    wheels = gr.settle("toyoura", "hakuto", load_n=[10.0, 5e4], slip_ratio=0.2)
    data = wheels.to_xarray(dims=["load"])
    assert data.sinkage_mm.attrs["units"] == "mm" and data.sinkage_mm.dims == ("load",)
    assert data.slip_ratio.attrs["units"] == "1" and data.torque_nm.attrs["units"] == "N·m"
    assert wheels.to_pandas().status.tolist() == [0, 1]
    with pytest.raises(gr.ParameterError, match="dims"):
        wheels.to_xarray(dims=["a", "b"])


# ---- numbers that are NaN ----


def test_nan_in_is_nan_out_and_leaves_the_others() -> None:
    nan = np.nan
    wheels = gr.settle("toyoura", "hakuto", load_n=[17.0, nan, 5e4], slip_ratio=[[0.2], [nan]])
    assert wheels.status.tolist() == [[0, 2, 1], [2, 2, 2]]
    assert np.isnan(wheels.sinkage_mm).tolist() == [[False, True, True], [True] * 3]
    assert wheels.messages[0, 1] == "an input is NaN" and wheels.flags[1, 0] == ""
    alone = gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=0.2)
    assert wheels.drawbar_pull_n[0, 0] == alone.drawbar_pull_n
    forces = gr.wheel_forces("toyoura", "hakuto", sinkage_mm=[10.0, nan], slip_ratio=0.2)
    assert np.isnan(forces.torque_nm).tolist() == [False, True]


def test_other_invalid_numbers_are_errors_beside_nan() -> None:
    for inputs in ({"load_n": [np.nan, -1.0]}, {"load_n": 17.0, "slip_ratio": [np.nan, 3.0]}):
        with pytest.raises(gr.ParameterError, match=r"\(entry 1\)"):
            gr.settle("toyoura", "hakuto", **{"slip_ratio": 0.2, **inputs})
    with pytest.raises(gr.ParameterError, match="gravity_m_s2"):
        gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=0.2, gravity_m_s2=np.nan)


# ---- keys of documents as arrays ----


def test_a_varied_key_is_the_soil_or_wheel_with_that_value() -> None:
    vary = {"soil.cohesion_kpa": [[0.0], [0.7]], "wheel.radius_m": [0.1, 0.12]}
    many = gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=0.2, vary=vary)
    assert many.shape == (2, 2)
    for (i, j), pull in np.ndenumerate(many.drawbar_pull_n):
        soil = gr.Soil("toyoura", cohesion_kpa=vary["soil.cohesion_kpa"][i][0])
        wheel = gr.Wheel("hakuto", radius_m=vary["wheel.radius_m"][j])
        alone = gr.settle(soil, wheel, load_n=17.0, slip_ratio=0.2)
        assert alone.drawbar_pull_n == pull and alone.flags == many.flags[i, j]
        forces = gr.wheel_forces(
            "toyoura", "hakuto", sinkage_mm=alone.sinkage_mm, slip_ratio=0.2,
            vary={"soil.cohesion_kpa": soil.cohesion_kpa, "wheel.radius_m": wheel.radius_m},
        )
        np.testing.assert_allclose(forces.drawbar_pull_n, pull, rtol=1e-11)


def test_gravities_broadcast_and_soils_are_varied_one_by_one() -> None:
    moon = gr.settle("toyoura", "hakuto", load_n=5.0, slip_ratio=0.2, slip_angle_deg=20.0,
                     gravity_m_s2=gr.MOON_GRAVITY)
    both = gr.settle("toyoura", "hakuto", load_n=5.0, slip_ratio=0.2, slip_angle_deg=20.0,
                     gravity_m_s2=[gr.EARTH_GRAVITY, gr.MOON_GRAVITY])
    assert both.side_force_n[1] == moon.side_force_n != both.side_force_n[0]
    soils = gr.settle(["toyoura", "dry-sand"], "hakuto", load_n=17.0, slip_ratio=0.2,
                      vary={"soil.friction_angle_deg": [30.0, 35.0]})
    other = gr.Soil("dry-sand", friction_angle_deg=35.0)
    assert soils.drawbar_pull_n[1] == gr.settle(other, "hakuto", load_n=17, slip_ratio=0.2).drawbar_pull_n


@pytest.mark.parametrize(
    ("vary", "message"),
    [
        ({"soil.cohesion_kap": 1.0}, "did you mean `cohesion_kpa`"),
        ({"cohesion_kpa": 1.0}, "a key such as soil.cohesion_kpa"),
        ({"soil.name": 1.0}, "not a number"),
        ({"soil.cohesion_kpa": [0.5, -1.0]}, r"soil.cohesion_kpa is -1 \(entry 1\), it must be from 0 to"),
        ({"wheel.radius_m": 1e9}, "wheel.radius_m is 1000000000, it must be"),
        ({"gravity_m_s2": 1.0}, "gravity_m_s2 is given twice"),
        ({"soil.cohesion_kpa": "much"}, "real numbers"),
        ({"soil.cohesion_kpa": [0.1, 0.2], "wheel.radius_m": [0.1, 0.1, 0.1]}, "do not broadcast"),
        (["soil.cohesion_kpa"], "mapping of keys"),
        ({3: 1.0}, "key of type int"),
    ],
)
def test_keys_that_cannot_vary_are_named(vary: Any, message: str) -> None:
    for call, pressed in ((gr.settle, "load_n"), (gr.wheel_forces, "sinkage_mm")):
        with pytest.raises(gr.ParameterError, match=message):
            call("toyoura", "hakuto", **{pressed: 17.0}, slip_ratio=0.2, vary=vary)


# ---- what was asked ----


def test_inputs_are_columns_and_coordinates() -> None:
    soils = np.array([["toyoura"], ["dry-sand"]], dtype=object)
    wheels = gr.settle(
        soils,
        "hakuto",
        load_n=17.0,
        slip_ratio=[0.1, 0.2, 0.4],
        vary={"soil.cohesion_kpa": [[0.0], [0.5]]},
    )
    table = wheels.to_pandas()
    assert table.soil.tolist() == ["Toyoura sand"] * 3 + ["Dry sand"] * 3
    assert table["soil.cohesion_kpa"].tolist() == [0.0] * 3 + [0.5] * 3
    data = wheels.to_xarray(dims=["soil", "slip_ratio"])
    assert data.sinkage_mm.sel(soil="Dry sand", slip_ratio=0.2) == wheels.sinkage_mm[1, 1]
    assert data["soil.cohesion_kpa"].dims == ("soil",) and data.load_n.dims == ()
    assert data["soil.cohesion_kpa"].attrs["units"] == "kPa"
    assert wheels.to_arrow().column_names[:3] == ["soil", "soil.cohesion_kpa", "load_n"]
    anonymous = gr.settle(["toyoura", gr.Soil("toyoura", cohesion_kpa=1.0)], "hakuto", load_n=1, slip_ratio=0)
    assert anonymous.inputs["soil"].tolist() == ["Toyoura sand (0)", "Toyoura sand (1)"]


def test_few_wheels_are_shown_whole_and_many_as_their_spread() -> None:
    few = repr(gr.settle("toyoura", "hakuto", load_n=[17.0, 5e4], slip_ratio=0.2)).splitlines()
    assert few[0].startswith("<Settled of shape (2,): 1 sunk") and len(few) == 4
    assert few[1].split()[:2] == ["load_n", "slip_ratio"] and "down to axle depth" in few[3]
    many = gr.settle("toyoura", "hakuto", load_n=np.linspace(1.0, 20.0, 21), slip_ratio=0.2)
    spread = {line.split()[0]: line.split()[1:] for line in repr(many).splitlines()[1:]}
    assert spread["load_n"] == ["1", "10.5", "20"]
    assert float(spread["sinkage_mm"][1]) == pytest.approx(np.median(many.sinkage_mm), rel=1e-3)
    assert repr(gr.settle("toyoura", "hakuto", load_n=[], slip_ratio=0.2)) == "<Settled of shape (0,)>"


def test_notebooks_show_tables_that_are_cut() -> None:
    loads = np.linspace(1.0, 20.0, 40)
    shown = gr.settle("toyoura", "hakuto", load_n=loads, slip_ratio=0.2)._repr_html_()
    assert shown.count("<tr>") == 2 + 12 + 1 and "40 rows" in shown and "[mm]" in shown
    assert ">20<" in shown and ">10.26<" not in shown
    square = gr.settle("toyoura", "hakuto", load_n=[[1.0], [2.0]], slip_ratio=[0.1, 0.2])
    assert ">1, 0<" in square._repr_html_() and "more columns" in square._repr_html_()
    # A text in a table cannot end it.
    soils = [gr.Soil("toyoura", name="<b>"), gr.Soil("dry-sand")]
    assert "<b>" not in gr.settle(soils, "hakuto", load_n=1.0, slip_ratio=0.2)._repr_html_()
