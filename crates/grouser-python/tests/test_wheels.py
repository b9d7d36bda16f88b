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
        ({"load_n": [1.0, np.nan]}, r"load_n is NaN \(entry 1\)"),
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
