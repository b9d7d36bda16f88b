"""Verdicts on slopes: their limits, and what datasets have of advice."""

from __future__ import annotations

from collections.abc import Mapping

from . import _core
from ._arrays import number
from ._errors import ParameterError

#: The limits of a rule, as the program has them without flags.
_RULE: dict[str, float] = _core.card_rule()
#: What a dataset has of advice, with what it is.
ADVICE = {
    "slope_deg": "Slope that the advice is for, a whole degree",
    "course_deg": "Course there, from the contour, positive uphill",
    "verdict": "Whether to drive there: go, caution, cannot_tell or no_go",
    "reason": "What decides the verdict, in a word",
    "probability_stuck": "Share of ways of 10 m on which the rover gets stuck, with looks at the slip",
    "yaw_deg": "Heading to set, positive uphill: the median over all samples",
    "yaw_deg_p2_5": "Lower end of the headings that hold the course, over all samples",
    "yaw_deg_p97_5": "Their upper end; missing where it is above every number",
}


def limits_of(rule: Mapping[str, float] | None) -> list[float]:
    """The limits of a caller's rule, in the order of the native half."""
    given = {} if rule is None else rule
    if not isinstance(given, Mapping):
        raise ParameterError(f"rule is of type {type(rule).__name__}, it must be a mapping", "rule")
    unknown = [name for name in given if name not in _RULE]
    if unknown:
        raise ParameterError(f"rule: {unknown[0]!r} is none of {', '.join(_RULE)}", "rule")
    return [number(name, value) for name, value in {**_RULE, **given}.items()]
