"""Whatever the arguments: an exception that says so, or a result; never a crash."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

import grouser as gr

#: What this package raises; a TypeError is for what is no value of a document at all.
OURS = (gr.GrouserError, TypeError, RecursionError)

numbers = st.floats() | st.integers() | st.sampled_from([0.2, 17.0, 1e300, -0.0, 5e-324])
dtypes = st.sampled_from(
    ["f4", "f8", "i1", "i8", "u8", "c16", "U3", "O", "?", "M8[s]", ">f8", "f2"]
)
shapes = st.lists(st.integers(0, 3), max_size=3).map(tuple)
arrays = st.builds(lambda shape, dtype: np.zeros(shape, dtype), shapes, dtypes)
ragged = st.recursive(numbers, lambda inner: st.lists(inner, max_size=3), max_leaves=6)
anything = numbers | arrays | ragged | st.none() | st.text() | st.binary() | st.booleans()
keys = st.sampled_from([*gr.Soil("toyoura").to_dict(), "n", "", "a.b", "shear.law"]) | st.text()
tables = st.recursive(
    anything, lambda inner: st.dictionaries(keys, inner, max_size=3), max_leaves=8
)


@settings(max_examples=300, deadline=None)
@given(load=anything, ratio=anything, angle=anything, gravity=anything)
def test_settle(load: Any, ratio: Any, angle: Any, gravity: Any) -> None:
    try:
        wheels = gr.settle(
            "toyoura", "hakuto", load_n=load, slip_ratio=ratio, slip_angle_deg=angle,
            gravity_m_s2=gravity,
        )  # fmt: skip
    except OURS:
        return
    carried = wheels.status == 0
    assert np.isfinite(wheels.drawbar_pull_n[carried]).all()


@settings(max_examples=300, deadline=None)
@given(load=st.floats(0, 1e5), ratio=st.floats(-2, 2), angle=st.floats(-90, 90))
def test_settle_in_its_ranges(load: float, ratio: float, angle: float) -> None:
    wheel = gr.settle("toyoura", "hakuto", load_n=load, slip_ratio=ratio, slip_angle_deg=angle)
    assert wheel.status in (0, 1)
    assert np.isfinite(wheel.drawbar_pull_n) == (wheel.status == 0)


@settings(max_examples=300, deadline=None)
@given(sinkage=anything, soil=anything)
def test_wheel_forces(sinkage: Any, soil: Any) -> None:
    for one in ("toyoura", soil):
        try:
            gr.wheel_forces(one, "hakuto", sinkage_mm=sinkage, slip_ratio=0.1)
        except OURS:
            pass


@settings(max_examples=300, deadline=None)
@given(source=tables, changes=st.dictionaries(keys, tables, max_size=3))
def test_descriptions(source: Any, changes: dict[str, Any]) -> None:
    for kind in (gr.Soil, gr.Scenario):
        for start in (source, "toyoura" if kind is gr.Soil else None):
            try:
                one = kind(start, **changes)
            except OURS:
                continue
            assert kind.from_toml(one.to_toml()) == one


@settings(max_examples=100, deadline=None)
@given(slope=anything, course=anything, speed=anything)
def test_attitude_map(slope: Any, course: Any, speed: Any) -> None:
    try:
        gr.attitude_map(slope_deg=slope, course_deg=course, speed_m_s=speed)
    except OURS:
        pass
