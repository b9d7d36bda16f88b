"""Settled wheels as functions of an array of numbers, for what differentiates through the library."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from . import settle
from ._descriptions import Soil, Source, Wheel
from ._errors import ParameterError
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

    def __init__(
        self, soil: Soil | Source, wheel: Wheel | Source, model: str | None, names: tuple[str, ...]
    ) -> None:
        self.soil = soil if isinstance(soil, Soil) else Soil(soil)
        self.wheel = wheel if isinstance(wheel, Wheel) else Wheel(wheel)
        self.model, self.names = model, names

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
