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


def test_gradients_of_runs_are_those_of_the_programs_records() -> None:
    key, step = "soil.friction_angle_deg", 0.05
    keys: dict[str, Any] = {"simulation": "quasi-steady", "slope_deg": 12.0, "duration_s": 10.0}
    run = gr.simulate(gradients=[key, "slope_deg"], **keys)
    found = run.gradient
    assert found is not None and found.names == (key, "slope_deg")
    assert found["y_m"].shape == (len(run.time_s), 2)
    less, more = (
        gr.simulate(soil=gr.Soil("toyoura", friction_angle_deg=38.0 + by), **keys)
        for by in (-step, step)
    )
    for name in ("y_m", "yaw_deg", "energy_j"):
        reference = (getattr(more, name) - getattr(less, name)) / (2.0 * step)
        np.testing.assert_allclose(found[name][:, 0], reference, rtol=1e-5, atol=1e-6)
    data = found.to_xarray(["time_s"])
    assert data["y_m"].dims == ("time_s", "key")
    each = gr.simulate(model="all", gradients=key, **keys)
    assert all(it.gradient is not None for it in each.values())
    with pytest.raises(gr.ParameterError, match="as its documents are written"):
        gr.simulate(gradients=key, uncertainty=True, **keys)
    with pytest.raises(gr.ParameterError, match="did you mean"):
        gr.simulate(gradients="soil.frction_angle_deg", **keys)


def begun(**changes: Any) -> gr.Run:
    rover = gr.Run(commands="rim_speed_m_s", **{"slope_deg": 10.0, **changes})
    rover.step(ARC, 2.0)
    return rover


#: Left wheels first: an arc to the left.
ARC = np.array([0.05, 0.05, 0.07, 0.07])


@pytest.mark.parametrize("simulation", ["dynamic", "quasi-steady"])
def test_jax_differentiates_control_steps(simulation: str) -> None:
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    from jax.test_util import check_grads

    import grouser.jax as gj

    rover = begun(simulation=simulation)
    here, linear = rover.save(), rover.linearise(ARC, 0.5)

    def after(state: Any, commands: Any) -> Any:
        return gj.step(rover, commands, 0.5, state=state)

    np.testing.assert_allclose(after(rover.state, ARC), linear.next_state, rtol=1e-9)
    for jacobian in (jax.jacfwd, jax.jit(jax.jacrev(after, argnums=(0, 1)))):
        found = jacobian(after, argnums=(0, 1)) if jacobian is jax.jacfwd else jacobian
        by_state, by_commands = found(rover.state, ARC)
        np.testing.assert_allclose(by_state, linear.A, rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(by_commands, linear.B, rtol=1e-9, atol=1e-12)
    # Steps are integrated within 1e-10, slopes of 0.1 mm/s within 1e-4 of what they are.
    check_grads(lambda u: after(rover.state, u)[:3], (ARC,), order=1, eps=1e-5, rtol=1e-3)
    commands = ARC * np.array([[1.0], [0.9], [1.1]])
    batched = jax.vmap(lambda u: jax.grad(lambda v: after(rover.state, v)[0])(u))(commands)
    assert batched.shape == (3, 4)
    np.testing.assert_allclose(batched[0], linear.B[0], rtol=1e-9)
    np.testing.assert_array_equal(gj.step(rover, commands, 0.5)[0], after(rover.state, ARC))
    assert rover.save() == here

    # Two steps, one after the other: the chain rule.
    def twice(commands: Any) -> Any:
        return gj.step(rover, commands, 0.5, state=after(rover.state, commands))[0]

    step = 1e-5 * np.eye(4)[0]
    reference = (twice(ARC + step) - twice(ARC - step)) / 2e-5
    np.testing.assert_allclose(jax.grad(twice)(ARC)[0], reference, rtol=1e-3)


def test_steps_have_the_numbers_of_wheels_that_follow_their_motors() -> None:
    pytest.importorskip("jax")
    import grouser.jax as gj

    motor = {
        "resistance_ohm": 10.0,
        "torque_constant_nm_a": 0.01,
        "gear_ratio": 250.0,
        "gear_efficiency": 0.6,
        "control": {"gain_v_s_rad": 0.5, "integral_v_rad": 5.0, "voltage_limit_v": 8.0},
    }
    rover = begun(rover=gr.Rover("hakuto", motor=motor))
    linear = rover.linearise(ARC, 0.1)
    np.testing.assert_allclose(gj.step(rover, ARC, 0.1), linear.next_state, rtol=1e-6)


def test_steps_refuse_by_name_and_are_nan_where_the_run_ends() -> None:
    pytest.importorskip("jax")
    import grouser.jax as gj

    rover = begun()
    for state, commands, said in (
        (np.zeros(5), ARC, r"state has shape \(5,\)"),
        (np.zeros((3, 6)), np.zeros((2, 4)), "commands has shape"),
        (None, np.zeros(3), r"commands has shape \(3,\)"),
    ):
        with pytest.raises(gr.ParameterError, match=said):
            gj.step(rover, commands, 0.5, state=state)
    with pytest.raises(gr.ParameterError, match="run"):
        gj.step(gr.Scenario(), ARC, 0.5)  # type: ignore[arg-type]
    steep = gr.Run(slope_deg=35.0, commands="rim_speed_m_s")
    assert np.isnan(gj.step(steep, 0.06, 60.0)).all()
    steep.step(0.06, 60.0)
    with pytest.raises(gr.SimulationError, match="has ended"):
        gj.step(steep, 0.06, 0.5)


@pytest.mark.filterwarnings("ignore:.torch.jit.*is deprecated")  # PyTorch's own, of itself
def test_torch_differentiates_control_steps() -> None:
    torch = pytest.importorskip("torch")
    import grouser.torch as gt

    rover = begun()
    linear = rover.linearise(ARC, 0.5)
    state, commands = (torch.tensor(it, requires_grad=True) for it in (rover.state, ARC))
    found = gt.step(rover, commands, 0.5, state=state)
    np.testing.assert_allclose(found.detach().numpy(), linear.next_state, rtol=1e-9)
    for row in range(6):
        by_state, by_commands = torch.autograd.grad(found[row], (state, commands), retain_graph=True)
        np.testing.assert_allclose(by_state.numpy(), linear.A[row], rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(by_commands.numpy(), linear.B[row], rtol=1e-9, atol=1e-12)

    def place(u: Any) -> Any:
        return gt.step(rover, u, 0.5)[:3]

    torch.autograd.gradcheck(place, (commands,), eps=1e-5, atol=1e-3, rtol=1e-3)
    forward = torch.func.jacfwd(place)(commands.detach())
    np.testing.assert_allclose(forward.numpy(), linear.B[:3], rtol=1e-9)


def test_the_card_says_what_friction_is_worth() -> None:
    key = "d_limit_slope_deg_d_soil.friction_angle_deg"
    card = gr.card(slope_deg=[5.0], samples=2)
    level = gr.heading(slope_deg=[5.0], gradients="soil.friction_angle_deg", nominal=True)
    assert level.gradient is not None
    assert card.steepest[key] == pytest.approx(level.gradient["limit_slope_deg"][0], rel=1e-9)
