"""Names of version 0.1 that are still accepted: one table of them, and what makes them work.

Documentation, completion and type checkers show the new names only. The use of a former name is a
``DeprecationWarning``.
"""

from __future__ import annotations

import functools
import os
import sys
import warnings
from collections.abc import Callable, Mapping
from types import FrameType
from typing import Any, TypeVar, cast

from ._errors import ParameterError

#: Names in the package `grouser`, each with its present one.
NAMES = {
    "attitude": "heading",
    "attitude_map": "heading_map",
    "Attitudes": "Headings",
    "AttitudeMap": "HeadingMap",
    "AttitudeBand": "HeadingBand",
    "Simulator": "Run",
    "SimulatorBatch": "RunBatch",
}

#: Arguments of `heading_map` and `rollout` (the first) and of `grouser.mujoco.SoilContact`.
ARGUMENTS = {"speed_m_s": "rim_speed_m_s", "moments": "wheel_moments"}

#: Values of the argument ``commands`` of `Run` and `RunBatch`.
COMMANDS = {"speed_m_s": "rim_speed_m_s"}

#: Attributes of results, by class.
ATTRIBUTES = {
    "Calibration": {
        "cannot_tell_apart": "unidentifiable",
        "narrowing": "posterior_contraction",
    },
    "Rollout": {"samples": "records"},
}

#: Keys of descriptions, where they are read. (The library reads documents and keywords with former
#: keys.) One of several new keys is meant where laws had the same former one.
KEYS = {
    "loads": ("load_transfer",),
    "moments": ("wheel_moments",),
    "extended": ("small_wheel",),
    "rim": ("interface",),
    "flank": ("side_wall",),
    "heap": ("mounds",),
    "front": ("bow_wave",),
    "behind": ("rear_mound",),
    "speed_m_s": ("rim_speed_m_s", "ground_speed_m_s"),
}

_Function = TypeVar("_Function", bound=Callable[..., Any])
_FOLDER = os.path.dirname(__file__) + os.sep


def in_package(name: str, members: Mapping[str, Any]) -> Any:
    """The member of `grouser` that had a name.

    Raises
    ------
    AttributeError
        If no member had it.
    """
    if name not in NAMES:
        raise AttributeError(f"module 'grouser' has no attribute {name!r}")
    _warn(f"grouser.{name}", f"grouser.{NAMES[name]}")
    return members[NAMES[name]]


def attribute_of(result: object, name: str) -> Any:
    """The attribute of a result that had a name.

    Raises
    ------
    AttributeError
        If no attribute had it.
    """
    owner = type(result).__name__
    now = ATTRIBUTES.get(owner, {}).get(name)
    if now is None:
        raise AttributeError(f"{owner!r} object has no attribute {name!r}")
    _warn(f"{owner}.{name}", f"{owner}.{now}")
    return getattr(result, now)


def key_of(keys: Mapping[str, Any], name: object) -> str | None:
    """The present key of a table that had a name; None if no key had it."""
    candidates = KEYS.get(name, ()) if isinstance(name, str) else ()
    now = next((key for key in candidates if key in keys), None)
    if now is not None:
        _warn(f"the key {name}", now)
    return now


def commands(value: Any) -> Any:
    """The present value of the argument ``commands``."""
    now = COMMANDS.get(value) if isinstance(value, str) else None
    if now is None:
        return value
    _warn(f"commands={value!r}", repr(now))
    return now


def takes(*former: str) -> Callable[[_Function], _Function]:
    """A decorator of functions that had arguments with these names."""

    def decorated(function: _Function) -> _Function:
        @functools.wraps(function)
        def call(*arguments: Any, **keywords: Any) -> Any:
            for name in former:
                if name not in keywords:
                    continue
                now = ARGUMENTS[name]
                if now in keywords:
                    raise ParameterError(
                        f"{name} is the former name of {now}: give one of them", name
                    )
                _warn(f"the argument {name}", now)
                keywords[now] = keywords.pop(name)
            return function(*arguments, **keywords)

        return cast(_Function, call)

    return decorated


def _warn(former: str, now: str) -> None:
    """Warns at the line outside of this package that used a former name."""
    frame: FrameType | None = sys._getframe()
    level = 1
    while frame is not None and frame.f_code.co_filename.startswith(_FOLDER):
        frame, level = frame.f_back, level + 1
    warnings.warn(f"{former} is now {now}", DeprecationWarning, stacklevel=level)
