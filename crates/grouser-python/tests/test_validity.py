"""Flags of validity in results, and how to accept none."""

from __future__ import annotations

import numpy as np
import pytest

import grouser as gr


def test_settled_wheels_have_flags() -> None:
    wheels = gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=[[0.2], [0.99]])
    assert wheels.flags.shape == (2, 1)
    assert wheels.flags.ravel().tolist() == ["", "slip-outside"]
    assert wheels.to_pandas()["flags"].tolist() == ["", "slip-outside"]


def test_names_are_those_of_the_list() -> None:
    wheel = gr.settle("toyoura", "hakuto", load_n=60.0, slip_ratio=0.99, slip_angle_deg=50.0)
    names = str(wheel.flags[()]).split(";")
    assert {"load-outside", "slip-outside", "slip-angle-outside"} <= set(names)
    assert names == [name for name in gr.FLAGS if name in names]


def test_a_wheel_test_and_headings_have_the_flags_of_the_program() -> None:
    test = gr.wheel_test(load_n=[17.0], slip_ratio=[0.2, 0.95])
    assert test.flags.ravel().tolist() == ["", "slip-outside"]
    headings = gr.heading(slope_deg=[5.0, 35.0], nominal=True)
    assert headings.flags.tolist() == ["", "slope-beyond-strength"]
    chart = gr.heading_map(slope_deg=[5.0], course_deg=[0.0], gravity_m_s2=gr.MOON_GRAVITY)
    assert chart.flags.shape == (1, 1, 1) and "gravity-outside" in chart.flags[0, 0, 0]


def test_a_run_has_its_flags_with_their_times() -> None:
    run = gr.simulate(duration_s=0.2, gravity_m_s2=gr.MOON_GRAVITY)
    assert run.flags_raised["gravity-outside"] == 0.0
    assert all("gravity-outside" in flags.split(";") for flags in run.flags)
    assert len(run.flags) == len(run.time_s)


def test_what_is_inside_is_accepted_and_what_is_not_raises() -> None:
    inside = gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=0.2)
    assert gr.require_inside(inside) is inside
    outside = gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=np.array([0.2, 0.99]))
    with pytest.raises(gr.OutsideDomainError, match=r"slip-outside at \(1,\)") as raised:
        gr.require_inside(outside)
    assert raised.value.flags == ("slip-outside",)
    assert isinstance(raised.value, ValueError)
