"""Withdrawn names are refused, with the present one as a hint."""

from __future__ import annotations

from typing import Any

import pytest

import grouser as gr

#: The package without its types, which do not have withdrawn names.
UNTYPED: Any = gr


@pytest.mark.parametrize(
    "name, hint",
    [
        ("Attitudes", "; did you mean Headings?"),
        ("Simulator", "; did you mean Run?"),
        ("attitude", "; did you mean heading?"),
        ("atitude", ""),
    ],
)
def test_a_member(name: str, hint: str) -> None:
    with pytest.raises(AttributeError) as found:
        getattr(UNTYPED, name)
    assert str(found.value) == f"module 'grouser' has no attribute {name!r}{hint}"
    assert name not in dir(gr)


def test_an_attribute_of_a_result() -> None:
    ends: Any = gr.rollout([], duration_s=1.0)
    with pytest.raises(AttributeError, match="no attribute 'samples'; did you mean records?"):
        ends.samples
    with pytest.raises(AttributeError, match="no attribute 'narrowing'$"):
        ends.narrowing


def test_a_key_of_a_description() -> None:
    with pytest.raises(AttributeError, match="did you mean scenario.load_transfer?"):
        UNTYPED.Scenario().loads


@pytest.mark.parametrize(
    "keywords, hint",
    [
        ({"loads": "uniform"}, "load_transfer="),
        ({"moments": "included"}, "wheel_moments="),
        ({"drive": {"speed_m_s": 0.03}}, "rim_speed_m_s"),
        ({"model": "extended"}, "\"small-wheel\""),
    ],
)
def test_a_keyword_of_a_scenario(keywords: dict[str, Any], hint: str) -> None:
    with pytest.raises((gr.ParameterError, gr.DocumentError), match=hint):
        gr.Scenario(**keywords)
