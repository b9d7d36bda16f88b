"""The scenario from which an environment's episodes start, and the range of its slopes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from .._arrays import numbers
from .._descriptions import Scenario, Soil, Source
from .._errors import ParameterError

#: The soil and the least and steepest slope [°] where neither an argument nor the scenario names
#: one.
USUAL_SOIL, USUAL_SLOPE_DEG = "toyoura-uncertain", (5.0, 15.0)
#: Keys of a scenario that an environment does not use, and why.
_UNUSED = {
    "drive": "actions turn the wheels",
    "duration_s": "max_episode_steps ends an episode",
    "sample_interval_s": "dt_s is the interval",
}


def start_of(
    scenario: Scenario | Source | None,
    soil: Soil | Source | None,
    slope_deg: Sequence[float] | None,
) -> tuple[Scenario, tuple[float, float]]:
    """The run on the steepest slope, and the least and steepest slope [°]."""
    if isinstance(scenario, Mapping):
        _check_keys(scenario, {"soil": soil, "slope_deg": slope_deg})
    run = Scenario(scenario)
    if "terrain" in run.to_dict():
        message = "the scenario has a terrain: environments are on planes, grouser.Run is on any ground"
        raise ParameterError(message, "terrain")
    # A mapping or no scenario at all leaves its missing keys to the environment.
    named = {} if scenario is None else scenario if isinstance(scenario, Mapping) else run.to_dict()
    if soil is None and "soil" not in named:
        soil = USUAL_SOIL
    if slope_deg is None:
        only = float(run.slope_deg)
        slope_deg = (only, only) if "slope_deg" in named else USUAL_SLOPE_DEG
    low, high = _pair("slope_deg", slope_deg)
    whole = soil if isinstance(soil, Soil) or soil is None else Soil(soil)
    changes: dict[str, Any] = {} if whole is None else {"soil": whole}
    # The scenario must be valid at both ends of the range of slopes: checked here.
    run.replace(**changes, slope_deg=low)
    return run.replace(**changes, slope_deg=high), (low, high)


def _check_keys(scenario: Mapping[str, Any], arguments: Mapping[str, Any]) -> None:
    """Checks that a mapping has no key that is also an argument, and no key that is not used."""
    for name, value in arguments.items():
        if value is not None and name in scenario:
            raise ParameterError(
                f"{name} is given twice: {_shown(value)} as an argument, {_shown(scenario[name])} "
                "by the scenario; give it once",
                name,
            )
    for name, why in _UNUSED.items():
        if name in scenario:
            raise ParameterError(f"the scenario has {name}, which is not used: {why}", name)
    start = scenario.get("start")
    if isinstance(start, Mapping) and "yaw_deg" in start:
        raise ParameterError(
            "the scenario has start.yaw_deg, which is not used: every reset samples the yaw, or "
            "takes it from its option yaw_deg",
            "start.yaw_deg",
        )


def _shown(value: Any) -> str:
    return f"the soil {value.name!r}" if isinstance(value, Soil) else repr(value)


def _pair(name: str, values: Sequence[float]) -> tuple[float, float]:
    array = numbers(name, values)
    if array.shape != (2,) or not array[0] <= array[1]:
        raise ParameterError(f"{name} is {values!r}, it must be the least and the largest", name)
    return float(array[0]), float(array[1])
