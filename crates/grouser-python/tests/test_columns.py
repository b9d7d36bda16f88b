"""The attributes of results are the library's columns: the same names, units and sentences."""

from __future__ import annotations

import ast
import dataclasses
import re
from pathlib import Path

import pytest

import grouser as gr
from grouser import _core, _tables

COLUMNS = _core.result_columns()
#: On ground with heights alone.
STANDING = {name for name, _, _ in COLUMNS["standing"]}

#: Results with the columns of their numbers, and what they have besides.
RESULTS = [
    (gr.WheelForces, "wheel", {"slip_ratio", "slip_angle_deg"}),
    (gr.Trajectory, "sample", {"energy_error_j", *STANDING}),
    (gr.Rollout, "sample", STANDING),
    (gr.Headings, "heading", {"slope_deg", "limit_slope_deg", "steering_deg"}),
    (gr.HeadingMap, "heading", {"course_deg", "slope_deg", "limit_slope_deg"}),
    (gr.WheelSpeeds, "wheel_speeds", {"slope_deg"}),
    (gr.WheelSpeedLimits, "wheel_speeds", {"limit_slope_deg"}),
    (gr.HeadingBand, "heading_band", {name for name, _, _ in COLUMNS["heading_band_limit"]}),
    (
        gr.HeadingMapBand,
        "heading_band",
        {name for name, _, _ in COLUMNS["heading_band_limit"]},
    ),
    (gr.WheelTestBand, "wheel_test_band", set()),
    (
        gr.TraverseBand,
        "traverse_band_over_time",
        {name for name, _, _ in COLUMNS["traverse_band_standing"]},
    ),
    (gr.SimulatedWheelTest, "stand", set()),
    (gr.Legs, "leg", set()),
    (gr.DrivenMission, "mission", set()),
]

#: Columns that are no attributes: of a wheel's rim speed there is none, runs are a dimension.
LEFT_OUT = {(gr.Headings, "power_w"), (gr.SimulatedWheelTest, "trial")}


#: Attributes whose sentence says more than that of their column.
SAYS_MORE = {(gr.Headings, "yaw_deg")}


def docs_of(result: type) -> dict[str, str]:
    """The sentence below each attribute of a class, with those that it inherits."""
    # Classes say that they are of the package, so that `inspect` does not find their files.
    files = sorted(Path(gr.__file__).parent.glob("_*.py"))
    nodes = (node for file in files for node in ast.parse(file.read_text("utf-8")).body)
    names = {base.__name__ for base in result.__mro__}
    docs = {}
    for tree in (node for node in nodes if isinstance(node, ast.ClassDef) and node.name in names):
        for field, below in zip(tree.body, tree.body[1:]):
            if isinstance(field, ast.AnnAssign) and isinstance(below, ast.Expr):
                assert isinstance(field.target, ast.Name) and isinstance(below.value, ast.Constant)
                docs[field.target.id] = " ".join(str(below.value.value).split())
    return docs


def parts_of(doc: str) -> tuple[str, str | None]:
    """A sentence without its unit, and the unit in its brackets."""
    found = re.search(r" \[([^\]]+)\]", doc)
    if found is None:
        return doc.rstrip("."), None
    return doc.replace(found.group(), "", 1).rstrip("."), found.group(1)


@pytest.mark.parametrize("result, kind, others", RESULTS, ids=lambda it: getattr(it, "__name__", ""))
def test_attributes_are_the_columns(result: type, kind: str, others: set[str]) -> None:
    names = [field.name for field in dataclasses.fields(result)]
    left_out = {name for owner, name in LEFT_OUT if owner is result}
    columns = [name for name, _, _ in COLUMNS[kind]]
    assert {name for name in columns if name not in names} == left_out
    unknown = set(names) - set(columns) - others
    assert not {name for name in unknown if _core.unit_of(name) is not None}


@pytest.mark.parametrize("result, kind, others", RESULTS, ids=lambda it: getattr(it, "__name__", ""))
def test_docs_have_the_sentence_and_the_unit_of_the_column(
    result: type, kind: str, others: set[str]
) -> None:
    docs, compared = docs_of(result), 0
    for name, unit, sentence in COLUMNS[kind]:
        if name not in docs:
            continue
        text, stated = parts_of(docs[name])
        assert (stated if stated != "-" else None) == unit, (name, docs[name])
        # Upper ends and the like speak of "its" quantity; what is set names its shape.
        if text.startswith(("Its ", "Lower end of its", "Upper end of")) or "shape (" in text:
            continue
        is_same = text.startswith(sentence) if (result, name) in SAYS_MORE else text == sentence
        assert is_same, name
        compared += 1
    assert compared >= 4


@pytest.mark.parametrize(
    "result, kind",
    [
        (gr.Trajectory, "standing"),
        (gr.Rollout, "standing"),
        (gr.TraverseBand, "traverse_band_standing"),
    ],
)
def test_how_a_rover_stands_has_the_sentences_of_its_columns(result: type, kind: str) -> None:
    docs = docs_of(result)
    for name, unit, sentence in COLUMNS[kind]:
        text, stated = parts_of(docs[name])
        # Medians and upper ends speak of "its" quantity.
        if text.startswith("Its "):
            continue
        assert (text.split(";")[0], stated) == (sentence, unit)


@pytest.mark.parametrize("result", [gr.WheelSpeeds, gr.WheelSpeedLimits])
def test_the_speed_of_each_wheel_is_a_column(result: type) -> None:
    ((name, unit, sentence),) = COLUMNS["wheel_speeds_of_wheel"]
    text, stated = parts_of(docs_of(result)[name])
    assert text.startswith(sentence) and (stated, unit) == ("-", None)


def test_what_each_wheel_has_is_named() -> None:
    """A trajectory's arrays for each wheel are a dictionary, whose names its docstring lists."""
    doc = gr.Trajectory.__doc__ or ""
    assert all(f"``{name}``" in doc for name in _tables.COLUMNS["wheel_sample"])
    run = gr.simulate(duration_s=0.2)
    expected = (*_tables.COLUMNS["wheel_sample"], *_tables.COLUMNS["wheel"])
    assert tuple(run.wheel) == expected
