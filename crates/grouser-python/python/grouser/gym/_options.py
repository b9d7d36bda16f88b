"""Options of a reset: values that replace sampled ones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .._arrays import numbers, whole_number
from .._errors import ParameterError

#: Options of a reset, each in place of a sampled value.
OPTIONS = ("slope_deg", "yaw_deg", "soil_seed")


def options_of(options: Mapping[str, Any] | None, known: Sequence[str]) -> Mapping[str, Any]:
    """Options of a reset, all of them known."""
    for name in options or {}:
        if name not in known:
            listed = ", ".join(known)
            raise ParameterError(
                f"a reset has no option {name!r}; it has {listed}", str(name), None, listed
            )
    return options or {}


def given(name: str, options: Mapping[str, Any], count: int) -> list[Any] | None:
    """An option's value for each rover; None where it is not given."""
    if name not in options:
        return None
    value = options[name]
    if name == "soil_seed":
        several = isinstance(value, Sequence) or isinstance(value, np.ndarray)
        seeds = list(value) if several else [value] * count
        _check_count(name, len(seeds), count)
        return [None if it is None else whole_number(name, it, most=2**63 - 1) for it in seeds]
    array = numbers(name, value)
    if array.ndim:
        _check_count(name, len(array) if array.ndim == 1 else -1, count)
    values: list[Any] = np.broadcast_to(array, (count,)).tolist()
    return values


def _check_count(name: str, found: int, count: int) -> None:
    if found != count:
        each = "one value" if count == 1 else f"one value, or {count} in a row"
        raise ParameterError(f"the option {name} must be {each}", name, None, each)
