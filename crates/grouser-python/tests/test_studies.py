"""Studies: their results have shapes, units, tables and pictures; outcomes are values."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import grouser as gr

DATA = Path(__file__).resolve().parents[3] / "data" / "experiments"


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


def test_the_level_attitude_is_level() -> None:
    """The attitude neglects the yaw moment left over, so the run turns a little: 1 mm in 20 s, as
    the library's own example has it."""
    level = gr.attitude(slope_deg=[10.0, 30.0])
    assert level.status[0] == "ok" and "steepest slope" in level.status[1]
    assert np.isnan(level.yaw_deg).tolist() == [False, True]
    assert level.limit_slope_deg is not None and 20.0 < level.limit_slope_deg < 21.0
    run = gr.simulate(slope_deg=10.0, start={"yaw_deg": level.yaw_deg[0]})
    assert abs(run.y_m[-1]) < 1e-3


def test_an_attitude_map_has_the_level_attitudes_on_course_0() -> None:
    slopes = [0.0, 10.0, 15.0]
    maps = gr.attitude_map(
        soil=["toyoura", "lunar-nominal"], slope_deg=slopes, course_deg=[-20, 0, 20]
    )
    assert maps.yaw_deg.shape == (2, 3, 3) and maps.soil == ("Toyoura sand", "Lunar soil, nominal")
    for k, soil in enumerate(["toyoura", "lunar-nominal"]):
        level = gr.attitude(soil=soil, slope_deg=slopes)
        assert maps.yaw_deg[k, 1].tolist() == level.yaw_deg.tolist()
    data = maps.to_xarray()
    assert data.power_w.sel(course_deg=0.0, slope_deg=10.0).dims == ("soil",)
    assert maps.to_pandas().shape[0] == 18


def test_no_slopes_no_attitudes() -> None:
    assert gr.attitude(slope_deg=[]).yaw_deg.shape == (0,)
    assert gr.attitude_map(slope_deg=[], course_deg=[0.0]).power_w.shape == (1, 1, 0)


def test_a_wheel_test_is_every_load_with_every_angle_and_ratio() -> None:
    test = gr.wheel_test(load_n=[10, 20], slip_ratio=[0, 0.2, 0.4], slip_angle_deg=[0, 15])
    assert test.wheels.shape == (2, 2, 3)
    alone = gr.settle("toyoura", "hakuto", load_n=20, slip_ratio=0.4, slip_angle_deg=15)
    assert test.wheels.side_force_n[1, 1, 2] == alone.side_force_n
    assert test.to_xarray().drawbar_pull_n.sel(load_n=20.0, slip_angle_deg=15.0).shape == (3,)


def test_pictures_take_axes_and_return_them() -> None:
    import matplotlib.pyplot as plt

    results = [
        gr.simulate(duration_s=1.0),
        gr.rollout([gr.Scenario(duration_s=1.0)]),
        gr.attitude(slope_deg=[5.0, 10.0]),
        gr.attitude_map(slope_deg=[0, 10], course_deg=[0, 20]),
        gr.wheel_test(load_n=10, slip_ratio=[0.0, 0.2]),
    ]
    for result in results:
        axes = plt.subplots()[1]
        assert result.plot(axes) is axes and axes.get_xlabel()
        assert result.plot() is not axes
        assert repr(result).startswith("<")
        plt.close("all")


def test_what_cannot_be_asked_says_what_can() -> None:
    with pytest.raises(gr.ParameterError, match="slope_deg is 70"):
        gr.attitude(slope_deg=[70.0])
    with pytest.raises(gr.ParameterError, match="one row"):
        gr.attitude(slope_deg=[[1.0]])
    with pytest.raises(gr.ParameterError, match="course_deg"):
        gr.attitude_map(course_deg=[91.0])
    with pytest.raises(gr.ParameterError, match="several"):
        gr.rollout(gr.Scenario())  # type: ignore[arg-type]
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
