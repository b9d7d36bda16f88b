"""Studies: their results have shapes, units, tables and pictures; outcomes are values."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

import grouser as gr

DATA = Path(__file__).resolve().parents[2] / "grouser" / "data" / "experiments"


def test_a_run_has_its_samples_and_its_wheels() -> None:
    run = gr.simulate(duration_s=2.0, slope_deg=10.0)
    assert run.outcome == "completed" and run.message is None
    assert run.time_s.shape == (21,) and run.wheel["slip_ratio"].shape == (21, 4)
    assert run.wheel_names == tuple(mount["name"] for mount in run.scenario.rover.mount)
    table = run.to_pandas()
    assert table["front-left.slip_ratio"][20] == run.wheel["slip_ratio"][20, 0]
    data = run.to_xarray()
    assert data.y_m.attrs["units"] == "m" and data.wheel_load_n.dims == ("time_s", "wheel")
    assert gr.Scenario.from_toml(data.attrs["scenario"]) == run.scenario


def test_a_rover_that_was_found_is_a_rover() -> None:
    """What a design says of it is what other studies measure, and the design itself is read again."""
    found = gr.design("design-lighter-wheels", trade=("energy_j_per_m", "wheel_mass_kg"))
    heading = gr.heading(rover=found.rover, slope_deg=10.0, nominal=True)
    assert heading.limit_slope_deg == pytest.approx(found.designs["limit_slope_deg"][1], abs=1e-9)
    assert found.trade is not None and found.trade["wheel_mass_kg"].shape == (9,)
    assert found.designs["flags"][1] == [] or "radius-outside" not in found.designs["flags"][1]
    again = gr.design(gr.Design.from_toml(gr.Design("design-lighter-wheels").to_toml()))
    assert again.design == found.design and again.objective == found.objective


def test_what_a_rover_does_is_an_outcome() -> None:
    run = gr.simulate(slope_deg=40.0)
    assert run.outcome == "sliding" and run.message


def test_a_rollout_ends_where_its_runs_end() -> None:
    scenarios = [gr.Scenario(duration_s=2.0, slope_deg=slope) for slope in (0.0, 10.0, 40.0)]
    ends = gr.rollout(scenarios)
    runs = [gr.simulate(scenario) for scenario in scenarios]
    assert ends.outcome.tolist() == [run.outcome for run in runs]
    for name in ("time_s", "x_m", "y_m", "yaw_deg", "energy_j"):
        assert getattr(ends, name).tolist() == [getattr(run, name)[-1] for run in runs]
    assert ends.to_pandas().shape[0] == 3 and ends.to_xarray().x_m.attrs["units"] == "m"
    assert len(gr.rollout([])) == 0


def test_what_varies_needs_no_scenario_of_its_own() -> None:
    """Numbers in arrays and soils in a list give the bits of a scenario for each."""
    slopes, yaws = np.array([[0.0], [12.0]]), np.array([-5.0, 3.5])
    soils = np.array(["toyoura", "cmu-direct90-smooth"], dtype=object)
    start = gr.Scenario(duration_s=2.0, drive={"law": "eq18"})
    ends = gr.rollout(
        start, soil=soils, slope_deg=slopes, yaw_deg=yaws, rim_speed_m_s=0.05,
        gravity_m_s2=gr.MOON_GRAVITY, duration_s=[1.0, 1.5], trajectories=True,
    )  # fmt: skip
    assert ends.shape == (2, 2) and len(ends) == 4 and ends.records is not None
    assert ends.records["y_m"].shape == (2, 2, 16)
    for i, j in np.ndindex(2, 2):
        alone = gr.simulate(
            start, soil=soils[j], slope_deg=slopes[i, 0], start={"yaw_deg": yaws[j]},
            drive={"ground_speed_m_s": 0.05}, gravity_m_s2=gr.MOON_GRAVITY, duration_s=[1.0, 1.5][j],
        )  # fmt: skip
        count = len(alone.y_m)
        assert ends.outcome[i, j] == alone.outcome
        assert ends.y_m[i, j] == alone.y_m[-1] and ends.energy_j[i, j] == alone.energy_j[-1]
        assert ends.records["y_m"][i, j, :count].tolist() == alone.y_m.tolist()
        assert np.isnan(ends.records["y_m"][i, j, count:]).all()
    data = ends.to_xarray(dims=["slope", "yaw"])
    assert data.sample_x_m.dims == ("slope", "yaw", "sample")
    assert gr.rollout().shape == () and gr.rollout(slope_deg=[]).shape == (0,)
    named = gr.rollout([start.replace(model="bekker")], soil="cmu-direct90-smooth", slope_deg=5.0)
    alone = gr.simulate(start, model="bekker", soil="cmu-direct90-smooth", slope_deg=5.0)
    assert named.y_m[0] == alone.y_m[-1]


def test_threads_share_a_scenario() -> None:
    run, soil = gr.Scenario(duration_s=1.0), gr.Soil("lunar-nominal")

    def bits(_: int) -> bytes:
        path = gr.simulate(run, soil=soil).y_m.tobytes()
        return path + gr.rollout(run, soil=soil, slope_deg=[3.0, 9.0]).y_m.tobytes()

    with ThreadPoolExecutor(8) as pool:
        assert len(set(pool.map(bits, range(16)))) == 1


def test_an_uncertain_soil_has_a_band() -> None:
    slopes = [5.0, 15.0, 40.0]
    level = gr.heading(soil="toyoura-uncertain", slope_deg=slopes, seed=3)
    band = level.band
    assert band is not None and band.draws == 40
    assert band.yaw_deg_p2_5[0] <= band.yaw_deg_p50[0] <= band.yaw_deg_p97_5[0]
    assert band.probability_level.tolist()[::2] == [1.0, 0.0]
    # Over all samples: the median is a number where more than half of them hold the contour.
    assert not np.isnan(band.yaw_deg_p50[band.probability_level > 0.55]).any()
    assert np.isnan(band.yaw_deg_p50[band.probability_level < 0.45]).all()
    assert np.isnan(band.yaw_deg_p97_5[band.probability_level < 0.9]).all()
    assert band.slip_ratio_p2_5[2] == 1.0 and np.isnan(band.energy_j_per_m_p2_5[2])
    assert band.limit_slope_deg_p2_5 is not None and band.limit_slope_deg_p97_5 is not None
    assert band.limit_slope_deg_p2_5 < band.limit_slope_deg_p97_5
    data = level.to_xarray()
    assert data.yaw_deg_p97_5.attrs["units"] == "°" and data.probability_level.attrs["units"] == "1"
    assert level.to_pandas().shape[0] == 3 and level.plot().get_legend_handles_labels()[1]
    empty = gr.heading(soil="toyoura-uncertain", slope_deg=[], samples=2)
    assert empty.band is not None and empty.band.yaw_deg_p50.shape == (0,)


def test_the_heading_to_set_is_the_median_and_has_the_verdict_of_the_card() -> None:
    """By one engine: heading and card give the same bits for the same samples."""
    settings: dict[str, Any] = {"soil": "toyoura-uncertain", "slope_deg": [5.0, 13.0, 40.0]}
    settings |= {"samples": 16}
    level, card = gr.heading(**settings), gr.card(**settings)
    assert level.band is not None and level.yaw_deg.tobytes() == level.band.yaw_deg_p50.tobytes()
    for name in ("verdict", "reason", "probability_stuck", "yaw_deg", "yaw_deg_as_written"):
        np.testing.assert_array_equal(getattr(level, name), card.columns[name], name)
    written = gr.heading(**settings, nominal=True)
    assert level.yaw_deg_as_written is not None and level.of_models is not None
    assert written.yaw_deg.tobytes() == level.yaw_deg_as_written.tobytes()
    for name in ("slip_ratio", "sinkage_mm", "torque_nm", "energy_j_per_m", "yaw_moment_nm"):
        assert getattr(written, name).tobytes() == getattr(level, name).tobytes(), name
    assert written.limit_slope_deg == level.limit_slope_deg
    for model, yaws in level.of_models.items():
        alone = gr.heading(**settings, nominal=True, model=model)
        np.testing.assert_allclose(yaws, alone.yaw_deg, rtol=1e-9, err_msg=model)
    optional = ("verdict", "reason", "probability_stuck", "yaw_deg_as_written", "of_models", "band")
    assert all(getattr(written, name) is None for name in optional)


def test_without_stated_uncertainty_nobody_can_tell_a_go() -> None:
    level = gr.heading(soil="toyoura", slope_deg=[5.0, 40.0], samples=4)
    assert level.verdict is not None and level.verdict.tolist() == ["cannot_tell", "no_go"]
    assert level.reason is not None and level.reason[0] == "no_stated_uncertainty"


def test_a_heading_says_in_a_line_what_to_set() -> None:
    one = gr.heading(soil="toyoura-uncertain", slope_deg=5.0, samples=4)
    assert one.verdict is not None
    assert f"), {one.verdict[0]}; as written the steepest is " in repr(one)
    assert repr(one).startswith("<Headings on 5°: ") and "\n" not in repr(one)
    several = gr.heading(slope_deg=[5.0, 10.0], samples=2)
    assert repr(several).startswith("<Headings on 2 slopes, the steepest is ")
    # Samples are the usual answer, so that asking for them changes nothing.
    asked = gr.heading(soil="toyoura-uncertain", slope_deg=5.0, samples=4, uncertainty=True)
    assert asked.to_pandas().equals(one.to_pandas())


def test_models_alone_have_a_band_and_one_of_them_has_none() -> None:
    exact = gr.Soil("toyoura", priors="none")
    settings = {"load_n": 17, "slip_ratio": [0.1, 0.4], "uncertainty": True, "samples": 12}
    settings |= {"soil": exact}
    spread, alone = gr.wheel_test(**settings), gr.wheel_test(**settings, model="rft")  # type: ignore[call-overload]
    assert spread.band is not None and alone.band is not None
    assert (spread.band.drawbar_pull_n_p2_5 < spread.band.drawbar_pull_n_p97_5).all()
    assert (alone.band.drawbar_pull_n_p2_5 == alone.wheels.drawbar_pull_n).all()
    assert (alone.band.drawbar_pull_n_p97_5 == alone.wheels.drawbar_pull_n).all()
    assert spread.to_xarray().torque_nm_p97_5.attrs["units"] == "N·m" and spread.plot()
    run = gr.simulate(soil=exact, duration_s=1.0, uncertainty=True, samples=12)
    assert run.band is not None and run.band.run["probability_completed"] == 1.0
    assert run.band.y_m_p2_5[-1] <= run.y_m[-1] <= run.band.y_m_p97_5[-1]
    assert run.band.to_pandas().shape[0] == run.time_s.size


def test_a_simulated_stand_scatters_about_the_theory() -> None:
    """The mean of 400 readings is within five standard errors of the model."""
    settings = {"load_n": [10, 20], "slip_ratio": [0.2, 0.4], "slip_angle_deg": [0, 15]}
    exact = gr.wheel_test(**settings)  # type: ignore[call-overload]
    test = gr.wheel_test(**settings, trials=400)  # type: ignore[call-overload]
    assert test.drawbar_pull_n.shape == (2, 2, 2, 400)
    mean = test.drawbar_pull_n.mean(axis=-1)
    assert np.abs(mean - exact.wheels.drawbar_pull_n).max() < 5 * 0.3 / np.sqrt(400)
    assert test.to_xarray().sinkage_mm.sel(trial=1, load_n=10).shape == (2, 2)
    assert test.to_pandas().shape[0] == 3200
    sunk = gr.wheel_test(load_n=60000, slip_ratio=0.1, trials=2)
    assert np.isnan(sunk.sinkage_mm).all() and "down to axle depth" in sunk.status[0, 0, 0, 0]


def test_the_heading_offset_holds_the_contour() -> None:
    """The heading offset neglects the remaining yaw moment: held at its yaw the rover stays, left to
    itself it turns downhill and leaves the contour."""
    level = gr.heading(slope_deg=[10.0, 30.0], nominal=True)
    assert level.status[0] == "ok" and "steepest slope" in level.status[1]
    assert np.isnan(level.yaw_deg).tolist() == [False, True]
    assert level.limit_slope_deg is not None and 20.0 < level.limit_slope_deg < 21.0
    assert level.limited_by == "wheels"
    held = gr.simulate(slope_deg=10.0, drive={"yaw_deg": [[0.0, level.yaw_deg[0]]]})
    assert abs(held.y_m[-1]) < 1e-3 and np.ptp(held.yaw_deg) < 1e-9
    free = gr.simulate(slope_deg=10.0, start={"yaw_deg": level.yaw_deg[0]})
    assert free.yaw_deg[-1] < level.yaw_deg[0] - 1.0 and free.y_m[-1] < -1e-3


def test_a_yaw_over_time_is_followed() -> None:
    course = [[0.0, 5.51], [20.0, 3.1]]
    run = gr.simulate(slope_deg=10.0, load_transfer="quasi-static", drive={"yaw_deg": course})
    assert [list(pair) for pair in run.scenario.drive["yaw_deg"]] == course
    assert np.allclose(run.yaw_deg, np.interp(run.time_s, *np.transpose(course)), atol=1e-6)
    # [FourWheel], Table 4, measured 13 mm, without a sign.
    assert run.y_m[-1] == pytest.approx(-0.014, abs=1e-3)
    with pytest.raises(gr.ParameterError, match="later than the one before it"):
        gr.Scenario(drive={"yaw_deg": [[1.0, 2.0], [0.0, 3.0]]})


def test_the_ground_ends_what_its_strength_does_not_hold() -> None:
    downhill = gr.heading_map(slope_deg=[10.0, 33.0], course_deg=[-90.0])
    assert set(downhill.limited_by.ravel()) == {"ground-strength"}
    assert downhill.status[0, 0, 1].startswith("ground-strength")
    assert downhill.limit_slope_deg[0, 0, 0] == pytest.approx(31.0, abs=0.05)
    firmer = gr.heading_map(
        slope_deg=[33.0], course_deg=[-90.0], slope_stability={"factor_of_safety": 1.0}
    )
    assert firmer.status[0, 0, 0] == "ok"


def test_a_heading_map_has_the_heading_offsets_on_course_0() -> None:
    slopes = [0.0, 10.0, 15.0]
    maps = gr.heading_map(
        soil=["toyoura", "lunar-nominal"], slope_deg=slopes, course_deg=[-20, 0, 20]
    )
    assert maps.yaw_deg.shape == (2, 3, 3) and maps.soil == ("Toyoura sand", "Lunar soil, nominal")
    for k, soil in enumerate(["toyoura", "lunar-nominal"]):
        level = gr.heading(soil=soil, slope_deg=slopes, nominal=True)
        assert maps.yaw_deg[k, 1].tolist() == level.yaw_deg.tolist()
    data = maps.to_xarray()
    assert data.power_w.sel(course_deg=0.0, slope_deg=10.0).dims == ("soil",)
    assert maps.to_pandas().shape[0] == 18


@pytest.fixture(scope="module")
def own_speeds() -> gr.WheelSpeeds:
    return gr.wheel_speeds(slope_deg=[0.0, 10.0, 30.0])


def test_wheels_at_speeds_of_their_own_hold_the_contour(own_speeds: gr.WheelSpeeds) -> None:
    """A mission drives 3 m with each set of speeds, and nothing corrects its heading: 0.04 mm beside
    the contour. One speed for all wheels, whose yaw moment is left over, turns the nose downhill:
    90 mm."""
    found, on_10 = own_speeds, 1
    assert found.status[on_10].tolist() == ["ok"] * 3

    def driven(wheels: str) -> gr.DrivenMission:
        way = found.wheels.index(wheels)
        leg = {
            "drive_m": 3.0,
            "yaw_deg": found.yaw_deg[on_10, way],
            "speed_m_s": 0.06 * found.speed_ratio[on_10, way],
        }
        return gr.mission(gr.Mission(slope_deg=10.0, leg=[leg]))

    for wheels in ("by-side", "by-wheel"):
        held = driven(wheels)
        assert held.outcome == "completed" and held.x_m > 2.9
        assert np.abs(held.trajectory.y_m).max() < 0.5e-3
        assert np.ptp(held.trajectory.yaw_deg) < 0.01
    alike = driven("alike").trajectory
    assert alike.y_m[-1] < -50e-3 and alike.yaw_deg[-1] < alike.yaw_deg[0] - 1.0


def test_wheels_at_speeds_of_their_own_are_tables(own_speeds: gr.WheelSpeeds) -> None:
    found = own_speeds
    level, steep = 0, 2
    assert found.speed_ratio.shape == (3, 3, 4) and found.yaw_moment_nm.shape == (3, 3)
    # Level ground asks for no difference between left and right: mounts go round the rover.
    assert np.abs(found.speed_ratio[level] - found.speed_ratio[level, :, ::-1]).max() < 1e-6
    assert np.isnan(found.yaw_deg[steep]).all() and np.isnan(found.speed_ratio[steep]).all()
    assert (found.yaw_moment_nm[:steep, 1:] == 0.0).all() and found.yaw_moment_nm[1, 0] < 0.0
    alike = gr.heading(slope_deg=found.slope_deg, nominal=True)
    for name in ("yaw_deg", "slip_ratio", "energy_j_per_m", "yaw_moment_nm"):
        held = getattr(found, name)[:, found.wheels.index("alike")]
        assert held.tobytes() == getattr(alike, name).tobytes(), name
    limits = found.limits
    assert limits.wheels == ("alike", "by-side", "by-wheel", "uphill-reversed")
    assert limits.limit_slope_deg[0] == alike.limit_slope_deg
    assert limits.limit_reason[0] == alike.limit_message and limits.limited_by[0] == alike.limited_by
    assert limits.speed_ratio.shape == (4, 4) and np.isnan(limits.speed_ratio[3]).all()
    data = found.to_xarray()
    assert data.speed_ratio.dims == ("slope_deg", "wheels", "wheel")
    assert data.yaw_growth_per_m.attrs["units"] == "1/m"
    one = data.speed_ratio.sel(slope_deg=10.0, wheels="by-wheel", wheel="rear-left")
    row = found.to_pandas().query("slope_deg == 10 and wheels == 'by-wheel'")
    assert one == row["rear-left.speed_ratio"].item() == found.speed_ratio[1, 2, 1]
    at_limit = limits.to_xarray().sel(wheels="by-side")
    assert at_limit.limit_slope_deg == limits.limit_slope_deg[1]
    assert at_limit.speed_ratio.sel(wheel="front-left") == limits.speed_ratio[1, 0]
    (*_, last) = found.plot(wheels="by-wheel").lines
    assert last.get_label() == "front-right"
    assert last.get_ydata()[1] == found.speed_ratio[1, 2, 3]
    assert repr(found) == "<WheelSpeeds on 3 slopes, 6 of 9 hold the contour>"
    assert "uphill-reversed none" in repr(limits)


def test_wheel_speeds_without_slopes_are_the_limits_alone(own_speeds: gr.WheelSpeeds) -> None:
    none = gr.wheel_speeds(slope_deg=[])
    assert none.speed_ratio.shape == (0, 3, 4) and none.status.shape == (0, 3)
    assert none.limits.to_pandas().equals(own_speeds.limits.to_pandas())


@pytest.mark.parametrize("ratio", [1.0, 0.5, np.nan, np.inf])
def test_the_fastest_wheel_is_faster_than_the_mean(ratio: float) -> None:
    with pytest.raises(gr.ParameterError, match="most_speed_ratio is .* above 1") as error:
        gr.wheel_speeds(slope_deg=[5.0], most_speed_ratio=ratio)
    assert error.value.name == "most_speed_ratio"
    assert error.value.value == ratio or np.isnan(ratio)


def test_wheel_speeds_are_asked_of_what_is_there(own_speeds: gr.WheelSpeeds) -> None:
    with pytest.raises(gr.ParameterError, match="slope_deg is 61"):
        gr.wheel_speeds(slope_deg=[61.0])
    with pytest.raises(gr.ParameterError, match="of alike, by-side, by-wheel"):
        own_speeds.plot(wheels="by-sides")


def test_no_slopes_no_heading_offsets() -> None:
    assert gr.heading(slope_deg=[], nominal=True).yaw_deg.shape == (0,)
    assert gr.heading_map(slope_deg=[], course_deg=[0.0]).power_w.shape == (1, 1, 0)


def test_a_wheel_test_is_every_load_with_every_angle_and_ratio() -> None:
    test = gr.wheel_test(load_n=[10, 20], slip_ratio=[0, 0.2, 0.4], slip_angle_deg=[0, 15])
    assert test.wheels.shape == (2, 2, 3)
    alone = gr.settle("toyoura", "hakuto", load_n=20, slip_ratio=0.4, slip_angle_deg=15)
    assert test.wheels.side_force_n[1, 1, 2] == alone.side_force_n
    assert test.to_xarray().drawbar_pull_n.sel(load_n=20.0, slip_angle_deg=15.0).shape == (3,)


def test_a_varied_key_is_the_scenario_with_that_value() -> None:
    vary = {"soil.cohesion_kpa": [0.0, 0.6], "rover.body.mass_kg": 4.5}
    ends = gr.rollout(slope_deg=[[5.0], [9.0]], duration_s=1.0, vary=vary)
    for (i, j), y in np.ndenumerate(ends.y_m):
        soil = gr.Soil("toyoura", cohesion_kpa=vary["soil.cohesion_kpa"][j])  # type: ignore[index]
        rover = gr.Rover("hakuto", body={"mass_kg": 4.5})
        slope = [5.0, 9.0][i]
        alone = gr.simulate(soil=soil, rover=rover, slope_deg=slope, duration_s=1.0)
        assert alone.y_m[-1] == y
    both = gr.rollout(soil=["toyoura", "dry-sand"], duration_s=1.0, vary={"soil.cohesion_kpa": 0.6})
    other = gr.simulate(soil=gr.Soil("dry-sand", cohesion_kpa=0.6), duration_s=1.0)
    assert both.y_m[1] == other.y_m[-1]
    for wrong, message in [
        ({"soil.cohesion_kap": 1.0}, "did you mean `soil.cohesion_kpa`"),
        ({"soil.cohesion_kpa": [0.1, -2.0]}, r"soil.cohesion_kpa is -2 \(entry 1\)"),
        ({"start.yaw_deg": 1.0}, "start.yaw_deg is given twice"),
    ]:
        with pytest.raises(gr.ParameterError, match=message):
            gr.rollout(yaw_deg=0.0, vary=wrong)


def test_a_run_with_nan_fails_and_leaves_the_others() -> None:
    nan = np.nan
    ends = gr.rollout(slope_deg=[5.0, nan], vary={"soil.cohesion_kpa": [[0.1], [nan]]}, duration_s=0.5)
    assert ends.outcome.tolist() == [["completed", "failed"], ["failed", "failed"]]
    assert ends.message[0, 1] == "slope_deg is NaN" and ends.message[1, 0] == "soil.cohesion_kpa is NaN"
    assert np.isnan(ends.y_m).tolist() == [[False, True], [True, True]]
    with pytest.raises(gr.ParameterError, match="slope_deg is 70"):
        gr.rollout(slope_deg=[nan, 70.0])


def test_inputs_of_a_rollout_are_columns_and_coordinates() -> None:
    ends = gr.rollout(
        soil=["toyoura", "dry-sand"], yaw_deg=[[0.0], [4.0], [8.0]], slope_deg=5.0, duration_s=0.5
    )
    table = ends.to_pandas()
    assert table.columns[:4].tolist() == ["soil", "slope_deg", "start.yaw_deg", "duration_s"]
    assert table["start.yaw_deg"].tolist() == [0.0, 0.0, 4.0, 4.0, 8.0, 8.0]
    data = ends.to_xarray(dims=["start.yaw_deg", "soil"])
    assert data.y_m.sel({"start.yaw_deg": 8.0, "soil": "Dry sand"}) == ends.y_m[2, 1]
    several = gr.rollout([gr.Scenario(duration_s=0.5), gr.Scenario(duration_s=1.0)])
    assert several.to_pandas().scenario.tolist() == [0, 1]


def test_samples_of_a_soil_are_exact_soils_in_an_order_of_their_own() -> None:
    """The document states 1.5° about 38°, within 30 to 50°. Standard errors of 400 samples are 0.075
    and 0.053°."""
    soil = gr.Soil("toyoura-uncertain")
    soils = soil.sample(400, seed=3)
    angles = np.array([one.friction_angle_deg for one in soils])
    assert angles.mean() == pytest.approx(38.0, abs=0.3) and angles.std() == pytest.approx(1.5, abs=0.2)
    assert soil.sample(3, seed=3) == soils[:3] and soil.sample(1, seed=4)[0] not in soils
    assert soils[0].cohesion_kpa == soil.cohesion_kpa
    with pytest.raises(gr.ParameterError, match="exact"):
        soils[0].sample(1)
    with pytest.raises(gr.ParameterError, match="n is -1"):
        soil.sample(-1)


@pytest.mark.parametrize(
    "result",
    [
        lambda: gr.simulate(duration_s=1.0),
        lambda: gr.heading(slope_deg=[5.0, 30.0], samples=4),
        lambda: gr.heading(slope_deg=[5.0, 30.0], nominal=True),
        lambda: gr.heading_map(slope_deg=[0, 10], course_deg=[0, 20]),
        lambda: gr.wheel_speeds(slope_deg=[5.0, 30.0]),
        lambda: gr.wheel_test(load_n=10, slip_ratio=[0.0, 0.2], trials=3),
        lambda: gr.card(soil="toyoura-uncertain", slope_deg=[5.0, 40.0], samples=4),
        lambda: gr.rollout(slope_deg=[3.0, 5.0], duration_s=0.5),
    ],
)
def test_results_are_tables_in_notebooks(result: Any) -> None:
    from xml.etree import ElementTree

    shown = result()
    tree = ElementTree.fromstring(shown._repr_html_())
    heads = [cell.text for cell in tree.iter("th")]
    assert heads[0] in shown.to_pandas().columns
    assert len(list(tree.iter("tr"))) >= 3


def test_every_model_at_once() -> None:
    from grouser import _core

    assert gr.MODELS == tuple(_core.MODELS) and "bekker" in gr.MODELS
    for study in (
        lambda **model: gr.heading(slope_deg=[5.0, 10.0], samples=2, **model),
        lambda **model: gr.heading(slope_deg=[5.0, 10.0], nominal=True, **model),
        lambda **model: gr.simulate(duration_s=1.0, **model),
        lambda **model: gr.wheel_test(load_n=17, slip_ratio=[0.1, 0.4], **model),
        lambda **model: gr.wheel_test(load_n=17, slip_ratio=[0.1, 0.4], trials=2, **model),
    ):
        found = study(model="all")
        assert tuple(found) == gr.MODELS and len(found) == len(gr.MODELS)
        table = found.to_pandas()
        for name, alone in found.items():
            same = study(model=name).to_pandas()
            assert same.equals(alone.to_pandas())
            own = table[table["model"] == name].drop(columns="model").reset_index(drop=True)
            assert own.equals(same.astype(own.dtypes.to_dict()))
        assert pyarrow_rows(found) == len(table) and "bekker" in repr(found)
        labels = found.plot().get_legend_handles_labels()[1]
        assert set(labels) == set(gr.MODELS)


def test_every_model_is_a_dataset_over_models() -> None:
    xarray = pytest.importorskip("xarray")
    for study, dims in (
        (lambda **model: gr.heading(slope_deg=[5.0, 10.0], samples=2, **model), {"slope_deg": 2}),
        (lambda **model: gr.wheel_test(load_n=17, slip_ratio=[0.1, 0.4], **model), {"slip_ratio": 2}),
        (lambda **model: gr.wheel_test(load_n=17, slip_ratio=[0.1], trials=2, **model), {"trial": 2}),
        (lambda **model: gr.simulate(duration_s=1.0, **model), {"time_s": 11, "wheel": 4}),
    ):
        found = study(model="all")
        data = found.to_xarray()
        assert data.model.values.tolist() == list(gr.MODELS)
        assert {name: data.sizes[name] for name in dims} == dims
        for name, alone in found.items():
            one = alone.to_xarray()
            own = data.sel(model=name)
            assert list(own.data_vars) == list(one.data_vars)
            for key in one.data_vars:
                xarray.testing.assert_identical(
                    own[key].drop_vars("model").reset_coords(drop=True),
                    one[key].reset_coords(drop=True),
                )


def test_runs_of_models_that_end_earlier_have_no_number_after_their_end() -> None:
    pytest.importorskip("xarray")
    found = gr.simulate("too-steep", model="all")
    assert len({run.time_s[-1] for run in found.values()}) > 1, "all end together"
    data = found.to_xarray()
    for name, run in found.items():
        own = data.sel(model=name)
        assert own.outcome.item() == run.outcome
        assert own.message.item() == (run.message or "")
        after = own.y_m.sel(time_s=own.time_s > run.time_s[-1])
        assert np.isnan(after).all()
        assert own.y_m.sel(time_s=run.time_s).values.tolist() == run.y_m.tolist()
    assert data.y_m.units == "m"


def pyarrow_rows(result: Any) -> int:
    rows: int = result.to_arrow().num_rows
    return rows


def test_pictures_take_axes_and_return_them() -> None:
    import matplotlib.pyplot as plt

    results = [
        gr.simulate(duration_s=1.0),
        gr.rollout([gr.Scenario(duration_s=1.0)]),
        gr.heading(slope_deg=[5.0, 10.0], samples=4),
        gr.heading(slope_deg=[5.0, 10.0], nominal=True),
        gr.heading_map(slope_deg=[0, 10], course_deg=[0, 20]),
        gr.wheel_test(load_n=10, slip_ratio=[0.0, 0.2]),
        gr.wheel_test(load_n=10, slip_ratio=[0.0, 0.2], trials=3),
        gr.rollout(slope_deg=[3.0, 5.0], duration_s=1.0, trajectories=True),
    ]
    for result in results:
        axes = plt.subplots()[1]
        assert result.plot(axes) is axes and axes.get_xlabel()
        assert result.plot() is not axes
        assert repr(result).startswith("<")
        plt.close("all")


def test_what_cannot_be_asked_says_what_can() -> None:
    with pytest.raises(gr.ParameterError, match="slope_deg is 70"):
        gr.heading(slope_deg=[70.0])
    with pytest.raises(gr.ParameterError, match="one row"):
        gr.heading(slope_deg=[[1.0]])
    with pytest.raises(gr.ParameterError, match="course_deg"):
        gr.heading_map(course_deg=[91.0])
    with pytest.raises(gr.ParameterError, match="scenario or several"):
        gr.rollout(3)  # type: ignore[arg-type]
    with pytest.raises(gr.ParameterError, match=r"slope_deg is 70 \(entry 1\)"):
        gr.rollout(slope_deg=[10.0, 70.0])
    with pytest.raises(gr.ParameterError, match="duration"):
        gr.rollout(duration_s=0.0)
    with pytest.raises(gr.ParameterError, match=r"do not broadcast: slope_deg \(2,\)"):
        gr.rollout(slope_deg=[1.0, 2.0], yaw_deg=[1.0, 2.0, 3.0])
    with pytest.raises(gr.ParameterError, match="readings with noise"):
        gr.wheel_test(load_n=10, slip_ratio=0.1, trials=2, uncertainty=True)  # type: ignore[call-overload]
    with pytest.raises(gr.ParameterError, match="samples is 1, it must be"):
        gr.heading(soil="toyoura-uncertain", samples=1)
    for rule in ({"slip": 0.3}, {"go_slip_ratio": 0.9}, {"no_go_probability": 0.0}, 0.3):
        with pytest.raises(gr.ParameterError):
            gr.heading(slope_deg=5.0, rule=rule, nominal=True)  # type: ignore[call-overload]
    with pytest.raises(gr.ParameterError, match="trials is 0"):
        gr.wheel_test(load_n=10, slip_ratio=0.1, trials=0)
    with pytest.raises(gr.ParameterError, match="noise_mm"):
        gr.wheel_test(load_n=10, slip_ratio=0.1, trials=2, noise_mm=-1.0)
    with pytest.raises(gr.ParameterError, match="unknown key"):
        gr.simulate(slop_deg=10.0)


def test_a_theory_agrees_with_readings_that_it_made(tmp_path: Path) -> None:
    """The noise of the simulated stand is 0.3 N, three trials a cell: errors of cell means are
    below that."""
    data = DATA / "simulated-wheel-test" / "toyoura-20n.csv"
    found = gr.validate(data, "toyoura", "hakuto", where="slip_angle_deg=0")
    assert found.overall["drawbar_pull_n"]["rmse"] < 0.3
    assert found.to_pandas().shape[0] == found.overall["trials"]
    assert found.plot() is not None
    with pytest.raises(FileNotFoundError):
        gr.validate(tmp_path / "none.csv", "toyoura", "hakuto")
    broken = tmp_path / "broken.csv"
    lines = data.read_text().splitlines()
    broken.write_text("\n".join([*lines[:3], lines[3].replace("20", "heavy", 1)]))
    with pytest.raises(gr.DocumentError, match="it must be a number") as caught:
        gr.validate(broken, "toyoura", "hakuto")
    assert caught.value.file == str(broken) and caught.value.line == 4
    with pytest.raises(gr.ParameterError):
        gr.validate(data, "toyoura", "hakuto", where="nothing")


def interrupted_after(seconds: float) -> threading.Timer:
    timer = threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    return timer


def test_ctrl_c_is_heard_in_the_middle_of_a_long_call() -> None:
    """All of them would take minutes; what is waited for is an exception, not a time."""
    scenarios = [gr.Scenario(duration_s=2000.0, slope_deg=5.0)] * 4000
    loads = np.full(4_000_000, 17.0)
    calls: list[Callable[[], object]] = [
        lambda: gr.rollout(scenarios),
        lambda: gr.settle("toyoura", "hakuto", load_n=loads, slip_ratio=0.2, model="rft"),
    ]
    for call in calls:
        timer = interrupted_after(0.5)
        try:
            with pytest.raises(KeyboardInterrupt):
                call()
        finally:
            timer.cancel()


def test_a_card_has_what_a_driver_needs() -> None:
    card = gr.card(soil="toyoura-uncertain", slope_deg=[5.0, 13.0, 40.0], samples=16)
    assert card.verdict.tolist()[0] == "go" and card.verdict.tolist()[2] == "no_go"
    assert card.reason[0] == "all_met" and card.probability_stuck[0] <= 0.005
    unstated = gr.card(soil="toyoura", slope_deg=[5.0], samples=4)
    assert unstated.verdict[0] == "cannot_tell" and unstated.reason[0] == "no_stated_uncertainty"
    assert np.isnan(card.correct_every_m).tolist()[::2] == [False, True]
    assert len(card.to_pandas()) == 3 and card.steepest["draws"] == 16
    assert "probability_stuck_without_checks" in card.columns
    # The second page has the slopes that are driven.
    assert set(card.courses.slope_deg) == set(card.slope_deg[card.verdict != "no_go"])
    assert set(card.courses.verdict) <= {"go", "caution", "cannot_tell", "no_go"}
    assert "reason" in card.courses.columns
    assert {"up", "back-across", "turn-on-the-spot"} < set(card.courses.course)


def test_a_card_has_a_side_and_a_rule() -> None:
    def verdicts(**settings: Any) -> list[str]:
        slopes = [6.0, 10.0, 14.0]
        card = gr.card(soil="toyoura-uncertain", slope_deg=slopes, samples=16, **settings)
        return card.verdict.tolist()

    def yaws(rover: gr.Rover, uphill: Literal["left", "right"]) -> list[float]:
        card = gr.card(rover=rover, soil="toyoura", model="ishigami", slope_deg=[10.0], samples=2, uphill=uphill)
        return card.yaw_deg.tolist()

    # A rover whose wheels on the right stand closer together than those on the left, and its mirror
    # image.
    hakuto = gr.Rover("hakuto")
    mounts = [dict(mount) for mount in hakuto.mount]
    for mount in mounts:
        x, y, z = mount["position_m"]  # type: ignore[misc]
        mount["position_m"] = [0.8 * x if y < 0.0 else x, y, z]
    lame = hakuto.replace(mount=mounts)
    for mount in mounts:
        x, y, z = mount["position_m"]  # type: ignore[misc]
        mount["position_m"] = [x, -y, z]
    mirrored = hakuto.replace(mount=mounts)
    assert yaws(lame, "left") != yaws(lame, "right")
    assert yaws(lame, "right") == yaws(mirrored, "left")
    assert verdicts(rule={"go_slip_ratio": 0.01}) != verdicts()
    # A verdict depends on its slope alone.
    for slope, verdict in zip([6.0, 14.0], verdicts()[::2]):
        alone = gr.card(soil="toyoura-uncertain", slope_deg=slope, samples=16)
        assert alone.verdict.tolist() == [verdict]
    assert verdicts(rule={"go_drift_m_per_m": 1e-6}) != verdicts()
    bad = {"slip": 1.0, "go_slip_ratio": 0.9, "no_go_probability": 0.0, "go_drift_m_per_m": 0.0}
    for settings in ({"uphill": "up"}, *({"rule": {name: limit}} for name, limit in bad.items())):
        with pytest.raises(gr.ParameterError):
            verdicts(**settings)
    with pytest.raises(gr.ParameterError):
        gr.card(slope_deg=[3.0, 2.0], samples=2)
