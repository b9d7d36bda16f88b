"""Settled wheels and control steps as functions of an array of numbers, for what differentiates
through the library."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import Any

import numpy as np

from . import settle
from ._arrays import number
from ._descriptions import Soil, Source, Wheel
from ._errors import ParameterError, SimulationError
from ._runs import Run
from ._tables import COLUMNS

#: What a settled wheel has.
RESULTS = COLUMNS["wheel"]
#: Arguments that are no keys of documents.
_SETTINGS = ("load_n", "slip_ratio", "slip_angle_deg", "gravity_m_s2")


def numbers_of(
    load_n: Any,
    slip_ratio: Any,
    slip_angle_deg: Any,
    gravity_m_s2: Any,
    vary: Mapping[str, Any] | None,
) -> dict[str, Any]:
    """All numbers of a call by their names."""
    own = set(_SETTINGS).intersection(vary or {})
    if own:
        name = min(own)
        raise ParameterError(f"vary has the key {name!r}, which is an argument of its own", "vary")
    settings = zip(_SETTINGS, (load_n, slip_ratio, slip_angle_deg, gravity_m_s2), strict=True)
    return {**dict(settings), **(vary or {})}


class Stand:
    """What of a call is no number: documents, model, and the names of the numbers."""

    results_count = len(RESULTS)

    def __init__(
        self, soil: Soil | Source, wheel: Wheel | Source, model: str | None, names: tuple[str, ...]
    ) -> None:
        self.soil = soil if isinstance(soil, Soil) else Soil(soil)
        self.wheel = wheel if isinstance(wheel, Wheel) else Wheel(wheel)
        self.model, self.names = model, names
        self.numbers_count = len(names)

    def call(self, numbers: Any, gradients: bool) -> Any:
        """Settled wheels, whose numbers are in the last axis."""
        cells = np.asarray(numbers, dtype=np.float64)
        named = {name: cells[..., place] for place, name in enumerate(self.names)}
        settings: dict[str, Any] = {name: named.pop(name) for name in _SETTINGS}
        keys = list(self.names) if gradients else None
        return settle(
            self.soil, self.wheel, model=self.model, vary=named, gradients=keys, **settings
        )

    def results(self, numbers: Any) -> Any:
        """Results in the last axis."""
        found = self.call(numbers, gradients=False)
        return np.stack([getattr(found, name) for name in RESULTS], axis=-1)

    def jacobians(self, numbers: Any) -> Any:
        """Results in the axis before the last, numbers in the last."""
        found = self.call(numbers, gradients=True).gradient
        assert found is not None
        return np.stack([found[name] for name in RESULTS], axis=-2)


class Step:
    """A control step of a run as it is now: its numbers are those of the state before it, then the
    commands."""

    def __init__(self, run: Run, dt_s: Any) -> None:
        if not isinstance(run, Run):
            kind = type(run).__name__
            raise ParameterError(f"run is of type {kind}, it must be a Run", "run")
        if run.outcome is not None:
            raise SimulationError(f"the run has ended: {run.message or run.outcome}")
        # Steps of the run itself change nothing here.
        batch = copy.copy(run)._batch
        self._native, self._are_rims = batch._native, batch._commands == "rim_speed_m_s"
        self._dt_s = number("dt_s", dt_s)
        self.state, self.states = self._native.state_numbers()
        self.wheels_count = len(run.wheel_names)
        self.results_count = len(self.states)
        self.numbers_count = self.results_count + self.wheels_count

    def shapes(self, state: Any, commands: Any) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """The shapes to which a state and its commands broadcast, whose leading axes are alike.

        Raises
        ------
        ParameterError
            For shapes that do not.
        """
        lead: tuple[int, ...] = ()
        sizes = {"state": self.results_count, "commands": self.wheels_count}
        for (name, size), shape in zip(sizes.items(), (np.shape(state), np.shape(commands))):
            is_one = name == "commands" and shape[-1:] in ((), (1,))
            if not is_one and shape[-1:] != (size,):
                raise ParameterError(
                    f"{name} has shape {shape}, its last axis must be of {size} numbers", name
                )
            try:
                lead = np.broadcast_shapes(lead, shape[:-1])
            except ValueError:
                raise ParameterError(
                    f"{name} has shape {shape}, its first axes must broadcast with the others", name
                ) from None
        return (*lead, self.results_count), (*lead, self.wheels_count)

    def results(self, numbers: Any) -> Any:
        """States after the step in the last axis."""
        return self._found(numbers, False, (self.results_count,))

    def jacobians(self, numbers: Any) -> Any:
        """States after the step in the axis before the last, numbers in the last."""
        return self._found(numbers, True, (self.results_count, self.numbers_count))

    def _found(self, numbers: Any, slopes: bool, shape: tuple[int, ...]) -> Any:
        cells = np.asarray(numbers, dtype=np.float64)
        rows = np.ascontiguousarray(cells.reshape(-1, self.numbers_count))
        found = self._native.precise_steps(rows, self._are_rims, self._dt_s, slopes)
        return found.reshape(*cells.shape[:-1], *shape)
