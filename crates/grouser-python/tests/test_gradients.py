"""Derivatives of settled wheels and headings, from Python and through JAX and PyTorch."""

from __future__ import annotations

from typing import Any

import grouser as gr
import numpy as np
import pytest

KEYS = ["wheel.radius_m", "soil.friction_angle_deg", "load_n", "slip_ratio"]


def test_gradients_of_wheels_have_a_last_axis_of_keys() -> None:
    loads = [[10.0], [20.0]]
    wheels = gr.settle("toyoura", "hakuto", load_n=loads, slip_ratio=[0.1, 0.2, 0.3], gradients=KEYS)
    found = wheels.gradient
    assert found is not None and found.names == tuple(KEYS)
    assert found["sinkage_mm"].shape == (2, 3, 4)
    step = 1e-4
    for place, key in enumerate(KEYS[2:], start=2):
        def changed(by: float, key: str = key) -> Any:
            numbers = {"load_n": np.array(loads), "slip_ratio": np.array([0.1, 0.2, 0.3])}
            numbers[key] = numbers[key] + by
            return gr.settle("toyoura", "hakuto", **numbers).drawbar_pull_n

        reference = (changed(step) - changed(-step)) / (2 * step)
        np.testing.assert_allclose(found["drawbar_pull_n"][..., place], reference, rtol=1e-6)
    assert not any(it.any() for it in found.one_sided.values())
    data = found.to_xarray(["load_n", "slip_ratio"])
    assert data["torque_nm"].sel(key="load_n").shape == (2, 3)


def test_gradients_are_taken_where_numbers_are_varied() -> None:
    vary = {"soil.friction_angle_deg": [30.0, 35.0]}
    setting: dict[str, Any] = {"load_n": 17.0, "slip_ratio": 0.2}
    both = gr.settle("toyoura", "hakuto", vary=vary, gradients=KEYS[1], **setting).gradient
    assert both is not None
    for place, angle in enumerate(vary["soil.friction_angle_deg"]):
        alone = gr.Soil("toyoura", friction_angle_deg=angle)
        one = gr.settle(alone, "hakuto", gradients=KEYS[1], **setting).gradient
        assert one is not None
        np.testing.assert_allclose(
            both["drawbar_pull_n"][place], one["drawbar_pull_n"], rtol=1e-9
        )


def test_each_soil_of_several_has_its_own_gradients() -> None:
    setting: dict[str, Any] = {"load_n": 17.0, "slip_ratio": 0.2, "gradients": KEYS[1]}
    both = gr.settle(["toyoura", "lunar-nominal"], "hakuto", **setting).gradient
    one = gr.settle("lunar-nominal", "hakuto", **setting).gradient
    assert both is not None and one is not None
    np.testing.assert_array_equal(both["torque_nm"][1], one["torque_nm"])


def test_a_wheel_without_a_result_has_no_gradient() -> None:
    sunk = gr.settle("toyoura", "hakuto", load_n=[17.0, 1e4], slip_ratio=0.2, gradients="load_n")
    assert sunk.gradient is not None
    assert np.isnan(sunk.gradient["sinkage_mm"][1, 0]) and sunk.gradient["sinkage_mm"][0, 0] > 0
    assert sunk.to_pandas().shape[0] == 2


def test_a_kink_is_said() -> None:
    rolling = gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=0.0, gradients="slip_ratio")
    assert rolling.gradient is not None and rolling.gradient.one_sided["sinkage_mm"].all()


@pytest.mark.parametrize("keys", [["soil.frction_angle_deg"], [], [1], ["speed"]])
def test_keys_that_no_document_has_are_refused(keys: Any) -> None:
    with pytest.raises(gr.ParameterError, match="gradients|friction_angle_deg|load_n"):
        gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=0.2, gradients=keys)


def test_gradients_of_headings_lead_to_the_next_heading() -> None:
    key = "rover.wheel_unit.wheel.radius_m"
    level = gr.heading(slope_deg=[5, 10], gradients=[key, "slope_deg"])
    assert level.gradient is not None and level.band is None
    assert "one_sided" not in level.columns and not any(n.startswith("d_") for n in level.columns)
    rover = gr.Rover("hakuto")
    radius = rover.to_dict()["wheel_unit"]["wheel"]["radius_m"]
    step = 1e-4

    def at(value: float) -> Any:
        wide = rover.replace(wheel_unit={"wheel": {"radius_m": value}})
        return gr.heading(slope_deg=[5, 10], rover=wide, nominal=True)

    more, less = at(radius + step), at(radius - step)
    reference = (more.yaw_deg - less.yaw_deg) / (2 * step)
    np.testing.assert_allclose(level.gradient["yaw_deg"][:, 0], reference, rtol=1e-4)
    assert more.limit_slope_deg is not None and less.limit_slope_deg is not None
    limit = (more.limit_slope_deg - less.limit_slope_deg) / (2 * step)
    np.testing.assert_allclose(level.gradient["limit_slope_deg"], [limit, 0.0], rtol=1e-4)


def test_an_uncertain_soil_has_gradients_as_it_is_written_alone() -> None:
    key = "soil.friction_angle_deg"
    with pytest.raises(gr.ParameterError, match="nominal=True"):
        gr.heading(soil="toyoura-uncertain", gradients=key)
    found = gr.heading(soil="toyoura-uncertain", slope_deg=5, gradients=key, nominal=True)
    assert found.gradient is not None and found.gradient["yaw_deg"][0, 0] < 0


def test_jax_differentiates_forward_and_in_reverse_batched_and_compiled() -> None:
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    import grouser.jax as gj

    def pull(radius: Any, slip: Any) -> Any:
        vary = {"wheel.radius_m": radius}
        found = gj.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=slip, vary=vary)
        return found["drawbar_pull_n"]

    slips = np.array([0.1, 0.2, 0.4])
    own = gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=slips, gradients=[KEYS[0], KEYS[3]])
    assert own.gradient is not None
    in_reverse = jax.jit(jax.vmap(jax.grad(pull, argnums=(0, 1)), in_axes=(None, 0)))(0.1, slips)
    forward = jax.vmap(jax.jacfwd(pull, argnums=(0, 1)), in_axes=(None, 0))(0.1, slips)
    for place in range(2):
        expected = own.gradient["drawbar_pull_n"][:, place]
        np.testing.assert_allclose(in_reverse[place], expected, rtol=1e-12)
        np.testing.assert_allclose(forward[place], expected, rtol=1e-12)
    np.testing.assert_array_equal(pull(0.1, slips), own.drawbar_pull_n)
    with pytest.raises(gr.ParameterError, match="load_n"):
        gj.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=0.2, vary={"load_n": 20.0})


@pytest.mark.filterwarnings("ignore:.torch.jit.*is deprecated")  # PyTorch's own, of itself
def test_torch_differentiates_forward_and_in_reverse_batched_and_by_functions() -> None:
    torch = pytest.importorskip("torch")
    import grouser.torch as gt

    def pull(radius: Any, slip: Any) -> Any:
        vary = {"wheel.radius_m": radius}
        found = gt.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=slip, vary=vary)
        return found["drawbar_pull_n"]

    slips = np.array([0.1, 0.2, 0.4])
    own = gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=slips, gradients=[KEYS[0], KEYS[3]])
    assert own.gradient is not None
    numbers = (torch.full((3,), 0.1, dtype=torch.float64), torch.from_numpy(slips))
    leaves = [it.clone().requires_grad_() for it in numbers]
    found = pull(*leaves)
    np.testing.assert_array_equal(found.detach().numpy(), own.drawbar_pull_n)
    in_reverse = torch.autograd.grad(found.sum(), leaves, create_graph=True)
    with pytest.raises(NotImplementedError, match="first derivatives"):
        torch.autograd.grad(in_reverse[1].sum(), leaves)
    by_functions = torch.func.vmap(torch.func.grad(pull, argnums=(0, 1)))(*numbers)
    for place in range(2):
        expected = own.gradient["drawbar_pull_n"][:, place]
        change = tuple(torch.full((3,), float(it == place), dtype=torch.float64) for it in range(2))
        _, forward = torch.func.jvp(pull, numbers, change)
        for derivatives in (in_reverse[place].detach(), by_functions[place], forward):
            np.testing.assert_allclose(derivatives.numpy(), expected, rtol=1e-12)
    # Wheels settle to a share of 1e-11: differences over 1e-4 err by 1e-7.
    torch.autograd.gradcheck(pull, leaves, eps=1e-4, rtol=1e-4, check_forward_ad=True)
    single = torch.tensor(0.2, requires_grad=True)
    pull(0.1, single).backward()
    assert single.grad is not None and single.grad.dtype == torch.float32
    with pytest.raises(gr.ParameterError, match="load_n"):
        gt.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=0.2, vary={"load_n": 20.0})


def test_gradients_of_rollouts_are_those_of_whole_runs() -> None:
    key, slopes = "soil.friction_angle_deg", [5.0, 15.0]
    for simulation, tolerance in (("quasi-steady", 1e-6), ("dynamic", 1e-3)):
        scenario = gr.Scenario(simulation=simulation, duration_s=10.0)
        ends = gr.rollout(scenario, slope_deg=slopes, gradients=[key, "slope_deg"])
        found = ends.gradient
        assert found is not None and found.names == (key, "slope_deg")
        assert found["y_m"].shape == (2, 2) and "time_s" not in found
        step = 0.05
        angles = [38.0 - step, 38.0 + step]
        pair = gr.rollout(scenario, slope_deg=[[5.0], [15.0]], vary={key: angles})
        for name in ("y_m", "yaw_deg", "energy_j"):
            ends_of = np.asarray(getattr(pair, name))
            reference = (ends_of[:, 1] - ends_of[:, 0]) / (2.0 * step)
            np.testing.assert_allclose(found[name][:, 0], reference, rtol=tolerance, atol=1e-5)
        assert found.to_xarray(["slope_deg"])["y_m"].sel(key=key).shape == (2,)


def test_gradients_of_rollouts_are_taken_where_numbers_are_varied_and_soils_exchanged() -> None:
    key = "soil.friction_angle_deg"
    scenario = gr.Scenario(simulation="quasi-steady", slope_deg=8.0, duration_s=10.0)
    soils = ["toyoura", "lunar-nominal"]
    both = gr.rollout(scenario, soil=soils, gradients=[key]).gradient
    varied = gr.rollout(scenario, vary={key: [30.0, 36.0]}, gradients=[key]).gradient
    assert both is not None and varied is not None
    for place, name in enumerate(soils):
        alone = gr.rollout(gr.Scenario(scenario, soil=name), gradients=[key]).gradient
        assert alone is not None
        assert both["y_m"][place] == alone["y_m"]
    for place, angle in enumerate((30.0, 36.0)):
        soil = gr.Soil("toyoura", friction_angle_deg=angle)
        alone = gr.rollout(gr.Scenario(scenario, soil=soil), gradients=[key]).gradient
        assert alone is not None
        np.testing.assert_allclose(varied["y_m"][place], alone["y_m"], rtol=1e-9)


def test_runs_without_an_end_and_keys_that_are_none_have_no_derivatives() -> None:
    key = "soil.friction_angle_deg"
    ends = gr.rollout(slope_deg=[5.0, np.nan], duration_s=2.0, gradients=[key, "soil.domain.width_m"])
    assert ends.gradient is not None
    found = ends.gradient["y_m"]
    assert np.isfinite(found[0, 0]) and np.isnan(found[1]).all() and np.isnan(found[0, 1])
    for wrong, said in (("wheel.radius_m", "did you mean"), ("duration_s", "records")):
        with pytest.raises(gr.ParameterError, match=said):
            gr.rollout(slope_deg=5.0, gradients=wrong)


def test_all_numbers_of_soils_that_state_their_uncertainty_are_keys() -> None:
    scenario = gr.Scenario(simulation="quasi-steady", slope_deg=8.0, duration_s=2.0)
    for soils in (["toyoura-uncertain"], ["toyoura-uncertain", "lunar-nominal"]):
        found = gr.rollout(scenario, soil=soils, gradients="all").gradient
        assert found is not None and "soil.friction_angle_deg" in found.names
        assert not any(name.startswith("soil.uncertainty") for name in found.names)
