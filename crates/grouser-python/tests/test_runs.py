"""Step-by-step simulation follows `simulate`; a batch has the results of each rover alone."""

from __future__ import annotations

import copy
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest

import grouser as gr

#: Left wheels first, as the mounts of the preset have them: left, left, right, right.
ARC = [0.04, 0.04, 0.08, 0.08]


def test_constant_commands_lead_where_the_run_leads() -> None:
    """Within the integrator's tolerance, 1e-6 of a way of half a metre."""
    run = gr.simulate(slope_deg=10.0, duration_s=8.0)
    rover = gr.Run(slope_deg=10.0, commands="rim_speed_m_s")
    for _ in range(80):
        state = rover.step(0.06, 0.1)
    names = gr.Run.STATE
    assert rover.time_s == pytest.approx(8.0, abs=1e-12)
    assert state == pytest.approx([getattr(run, name)[-1] for name in names], abs=1e-6)
    assert rover.energy_j == pytest.approx(run.energy_j[-1], rel=1e-6)
    assert rover.power_w == pytest.approx(run.power_w[-1], rel=1e-6)
    assert list(rover.wheel) == list(run.wheel)
    for name, values in rover.wheel.items():
        assert values == pytest.approx(run.wheel[name][-1], rel=1e-5, abs=1e-6), name


def test_the_start_is_that_of_the_run() -> None:
    rover, run = gr.Run(slope_deg=10.0), gr.simulate(slope_deg=10.0, duration_s=0.1)
    assert rover.state.tolist() == [getattr(run, name)[0] for name in rover.STATE]
    assert rover.wheel["sinkage_mm"].tolist() == run.wheel["sinkage_mm"][0].tolist()
    assert (rover.time_s, rover.outcome, rover.message) == (0.0, None, None)
    assert rover.simulation == "dynamic" and rover.scenario.slope_deg == 10.0


def test_wheel_speeds_and_rim_speeds_are_two_words_for_one_command() -> None:
    """The shearing radius of the preset is 0.11 m."""
    rims, wheels = gr.Run(commands="rim_speed_m_s"), gr.Run()
    one, other = rims.step(ARC, 0.5), wheels.step(np.array(ARC) / 0.11, 0.5)
    assert one == pytest.approx(other, rel=1e-12, abs=1e-12)
    assert rims.wheel["wheel_speed_rad_s"] == pytest.approx(np.array(ARC) / 0.11)


def test_equal_commands_have_equal_bits_whatever_the_company() -> None:
    slopes = np.linspace(0.0, 18.0, 7)
    random = np.random.default_rng(5)
    commands = random.uniform(-0.1, 0.1, (6, 7, 4))
    batch = gr.RunBatch([gr.Scenario(slope_deg=it) for it in slopes], commands="rim_speed_m_s")
    states = [batch.step(each, 0.2) for each in commands]
    for k, slope in enumerate(slopes):
        alone = gr.Run(slope_deg=slope, commands="rim_speed_m_s")
        for each, together in zip(commands, states):
            assert alone.step(each[k], 0.2).tolist() == together[k].tolist()
        for name, values in alone.wheel.items():
            assert values.tolist() == batch.wheel[name][k].tolist()


def test_a_copy_goes_on_as_the_original_does() -> None:
    rover = gr.Run(slope_deg=12.0, commands="rim_speed_m_s")
    for _ in range(3):
        rover.step(0.06, 0.1)
    twin, before = copy.deepcopy(rover), rover.state
    assert rover.step(ARC, 0.3).tolist() == twin.step(ARC, 0.3).tolist()
    assert copy.copy(twin).state.tolist() != before.tolist()


def test_a_reset_leads_back_to_the_start() -> None:
    rover = gr.Run(slope_deg=12.0, commands="rim_speed_m_s")
    start, first = rover.state, rover.step(ARC, 0.5)
    assert rover.reset().tolist() == start.tolist() and rover.time_s == 0.0
    assert rover.step(ARC, 0.5).tolist() == first.tolist()
    turned = rover.reset(slope_deg=3.0, yaw_deg=20.0)
    assert turned[2] == pytest.approx(20.0)
    other = gr.Run(slope_deg=3.0, start={"yaw_deg": 20.0}, commands="rim_speed_m_s")
    assert rover.step(ARC, 0.5).tolist() == other.step(ARC, 0.5).tolist()
    assert rover.reset().tolist() == start.tolist()


def test_a_seed_draws_the_soil_from_its_uncertainty() -> None:
    rover = gr.Run(soil="toyoura-uncertain", slope_deg=12.0)
    ends = []
    for seed in (1, 2, 1, None):
        rover.reset(seed=seed)
        ends.append(rover.step(0.5, 2.0).tolist())
    assert ends[0] == ends[2] and ends[0] != ends[1] and ends[3] not in ends[:3]
    certain = gr.Run(soil="toyoura", slope_deg=12.0)
    assert certain.reset(seed=1).tolist() == certain.reset().tolist()
    assert certain.step(0.5, 2.0).tolist() == ends[3]
    batch = gr.RunBatch([gr.Scenario(soil="toyoura-uncertain", slope_deg=12.0)] * 3)
    batch.reset(seed=1)
    together = batch.step(0.5, 2.0).tolist()
    assert together[:2] == ends[:2] and together[2] not in ends


def test_a_mask_chooses_rovers() -> None:
    batch = gr.RunBatch([gr.Scenario(slope_deg=8.0)] * 3)
    start = batch.state
    batch.step(0.5, 0.5, mask=[True, False, True])
    assert batch.time_s.tolist() == [0.5, 0.0, 0.5]
    assert batch.state[1].tolist() == start[1].tolist()
    batch.reset(mask=[True, False, False])
    assert batch.time_s.tolist() == [0.0, 0.0, 0.5]
    assert repr(batch) == "<RunBatch of 3 rovers, 0 ended>"


def test_what_becomes_of_a_rover_is_a_value() -> None:
    rover = gr.Run(slope_deg=38.0, commands="rim_speed_m_s")
    for _ in range(30):
        state = rover.step(0.06, 0.1)
    assert rover.outcome == "sliding" == gr.simulate(slope_deg=38.0).outcome and rover.message
    ended = rover.time_s
    assert rover.step(0.06, 0.1).tolist() == state.tolist() and rover.time_s == ended < 3.0
    assert "sliding" in repr(rover)
    rover.reset(slope_deg=5.0)
    assert rover.outcome is None and rover.message is None


def test_quasi_steady_is_asked_for_and_told() -> None:
    """Without the accelerations at the start the rover gets ahead by less than a millimetre more."""
    dynamic = gr.Run(slope_deg=10.0, commands="rim_speed_m_s")
    steady = gr.Run(slope_deg=10.0, commands="rim_speed_m_s", simulation="quasi-steady")
    ends = [rover.step(0.06, 5.0) for rover in (dynamic, steady)]
    assert (dynamic.simulation, steady.simulation) == ("dynamic", "quasi-steady")
    assert 0.0 < np.hypot(*(ends[0] - ends[1])[:2]) < 1e-3


@pytest.mark.parametrize(
    ("commands", "dt_s", "name"),
    [
        ([0.06] * 3, 0.1, "commands"),
        ([[0.06] * 4], 0.1, "commands"),
        ([0.06, 0.06, 0.06, np.nan], 0.1, "commands"),
        (1e6, 0.1, "commands"),
        ("fast", 0.1, "commands"),
        (0.06, 0.0, "dt_s"),
        (0.06, -1.0, "dt_s"),
        (0.06, np.nan, "dt_s"),
        (0.06, [0.1, 0.2], "dt_s"),
    ],
)
def test_what_nothing_can_do_changes_nothing(commands: Any, dt_s: Any, name: str) -> None:
    rover = gr.Run(slope_deg=10.0)
    before = rover.state
    with pytest.raises(gr.ParameterError) as caught:
        rover.step(commands, dt_s)
    assert caught.value.name == name
    assert rover.state.tolist() == before.tolist() and rover.time_s == 0.0


def test_what_cannot_be_asked_says_what_can() -> None:
    one: Any = gr.Scenario()
    wrong: Any = "power"
    rover = gr.RunBatch([one, one])
    for call in (
        lambda: gr.RunBatch(one),
        lambda: gr.RunBatch([]),
        lambda: gr.Run(commands=wrong),
        lambda: rover.reset(seed=-1),
        lambda: rover.reset(seed=2**64),
        lambda: rover.reset(seed=[1]),
        lambda: rover.reset(seed=wrong),
        lambda: rover.reset(slope_deg=61.0),
        lambda: rover.reset(yaw_deg=[0.0, np.nan]),
        lambda: rover.reset(mask=[1, 0]),
        lambda: gr.Run(slop_deg=1.0),
    ):
        with pytest.raises(gr.ParameterError):
            call()
    assert rover.time_s.tolist() == [0.0, 0.0]


def test_threads_share_a_run_safely() -> None:
    """Steps of equal commands may come in any order: all of them are made, none is torn."""
    shared = gr.RunBatch([gr.Scenario(slope_deg=8.0)] * 2, commands="rim_speed_m_s")
    with ThreadPoolExecutor(4) as pool:
        for done in [pool.submit(shared.step, 0.06, 0.05) for _ in range(16)]:
            done.result()
    alone = gr.Run(slope_deg=8.0, commands="rim_speed_m_s")
    for _ in range(16):
        alone.step(0.06, 0.05)
    shared.step(0.06, 0.05)
    assert shared.state[1].tolist() == alone.step(0.06, 0.05).tolist()
