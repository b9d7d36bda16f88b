"""Numbers out of their ranges: refused by name, or left out and said so; and the ranges."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import grouser as gr

NAN = float("nan")


def test_wheels_out_of_range_are_left_out_and_others_have_their_bits() -> None:
    loads = np.array([17.0, -1.0, 2e5, NAN, 1e5])
    wheels = gr.settle("toyoura", "hakuto", load_n=loads, slip_ratio=0.2, outside="nan")
    assert wheels.status.tolist() == [0, 3, 3, 2, 1]
    assert wheels.messages[1] == "a number is out of its range"
    alone = gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=0.2)
    assert wheels.sinkage_mm[0] == alone.sinkage_mm
    assert np.isnan(wheels.sinkage_mm[1:]).all()
    assert wheels.load_n.tolist()[:3] == [17.0, -1.0, 2e5]
    assert "2 with a number out of its range" in repr(wheels)
    with pytest.raises(gr.ParameterError, match=r"load_n is -1 \(entry 1\)"):
        gr.settle("toyoura", "hakuto", load_n=loads, slip_ratio=0.2)


@pytest.mark.parametrize(
    ("changes", "status"),
    [
        ({"slip_ratio": [0.2, 2.5]}, [0, 3]),
        ({"slip_angle_deg": [0.0, 91.0]}, [0, 3]),
        ({"gravity_m_s2": [9.81, 0.0]}, [0, 3]),
        ({"gravity_m_s2": -1.0}, 3),
        ({"vary": {"soil.cohesion_kpa": [0.0, -0.1]}}, [0, 3]),
        ({"vary": {"wheel.radius_m": [0.1, NAN, 0.0]}}, [0, 2, 3]),
    ],
)
def test_every_number_may_step_out_of_its_range(changes: dict[str, Any], status: Any) -> None:
    given: dict[str, Any] = {"load_n": 17.0, "slip_ratio": 0.2, **changes}
    found = gr.settle("toyoura", "hakuto", **given, outside="nan")
    assert found.status.tolist() == status
    assert np.isnan(found.torque_nm).tolist() == (found.status > 0).tolist()
    with pytest.raises(gr.ParameterError):
        gr.settle("toyoura", "hakuto", **given)


def test_derivatives_are_left_out_too() -> None:
    keys = ["load_n"]
    both = gr.settle(
        "toyoura", "hakuto", load_n=[17.0, -1.0], slip_ratio=0.2, gradients=keys, outside="nan"
    )
    alone = gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=0.2, gradients=keys)
    assert both.gradient is not None and alone.gradient is not None
    for name, values in both.gradient.values_of.items():
        assert values[0] == alone.gradient.values_of[name] and np.isnan(values[1]), name


def test_forces_deeper_than_the_axle_are_left_out() -> None:
    """The shearing radius of the preset is 110 mm."""
    given: dict[str, Any] = {"slip_ratio": 0.2, "outside": "nan"}
    found = gr.wheel_forces("toyoura", "hakuto", sinkage_mm=[110.0, 110.1, -1.0], **given)
    assert np.isnan(found.torque_nm).tolist() == [False, True, True]
    radii = {"wheel.radius_m": [0.1, 0.2]}
    found = gr.wheel_forces("toyoura", "hakuto", sinkage_mm=150.0, vary=radii, **given)
    assert np.isnan(found.torque_nm).tolist() == [True, False]


def test_runs_out_of_range_fail_with_a_sentence_and_others_go_on() -> None:
    given: dict[str, Any] = {"slope_deg": [5.0, 61.0, NAN], "duration_s": 0.5}
    ends = gr.rollout(**given, vary={"soil.cohesion_kpa": [[0.0], [-1.0]]}, outside="nan")
    assert ends.outcome.tolist() == [["completed", "failed", "failed"], ["failed"] * 3]
    assert ends.message[0].tolist()[1:] == [
        "slope_deg is 61, it must be from 0 to 60",
        "slope_deg is NaN",
    ]
    assert ends.message[1, 0].startswith("soil.cohesion_kpa is -1, it must be from 0 to")
    alone = gr.rollout(slope_deg=5.0, duration_s=0.5)
    assert ends.y_m[0, 0] == alone.y_m and np.isnan(ends.y_m[1]).all()
    with pytest.raises(gr.ParameterError, match="slope_deg is 61"):
        gr.rollout(**given)


def test_rules_between_keys_are_met_by_each_run() -> None:
    """Over a terrain there is no slope but 0."""
    terrain = gr.Scenario(terrain={"surface": "incline", "slope_deg": 4.0}, duration_s=0.5)
    ends = gr.rollout(terrain, slope_deg=[0.0, 8.0], outside="nan")
    assert ends.outcome.tolist() == ["completed", "failed"] and "slope" in ends.message[1]
    with pytest.raises(gr.ParameterError, match="slope"):
        gr.rollout(terrain, slope_deg=[0.0, 8.0])


def test_outside_is_one_of_two_words() -> None:
    with pytest.raises(gr.ParameterError, match="outside is 'skip', it must be 'raise' or 'nan'"):
        gr.rollout(outside="skip")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("key", "of", "expected"),
    [
        ("slope_deg", None, (0.0, 60.0)),
        ("rim_speed_m_s", None, (-10.0, 10.0)),
        ("load_n", None, (0.0, 1e5)),
        ("slip_ratio", None, (-2.0, 2.0)),
        ("soil.friction_angle_deg", None, gr.range_of("friction_angle_deg", gr.Soil("toyoura"))),
        ("body.mass_kg", gr.Rover("hakuto"), gr.range_of("rover.body.mass_kg")),
    ],
)
def test_ranges_are_those_of_the_documents(key: str, of: Any, expected: Any) -> None:
    assert gr.range_of(key, of) == expected


@pytest.mark.parametrize("key", ["slope_deg", "soil.cohesion_kpa", "gravity_m_s2"])
def test_what_is_beyond_a_range_is_refused_and_its_ends_are_not(key: str) -> None:
    low, high = gr.range_of(key)
    values = np.array([low, high, high * 1.001, low - 1e-3])
    ends = gr.rollout(duration_s=1e-3, vary={key: values}, outside="nan")
    refused = [text is not None and "it must be" in text for text in ends.message]
    assert refused[2:] == [True, True] and refused[:2] == [False, False]


def test_keys_without_a_range_say_why() -> None:
    with pytest.raises(gr.ParameterError, match="cohesion"):
        gr.range_of("soil.cohesion_pa")
    with pytest.raises(gr.ParameterError, match="of is of type str"):
        gr.range_of("slope_deg", "toyoura")  # type: ignore[arg-type]
