"""Results for pandas and xarray: units come from names, and stand nowhere else."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes

#: Endings of names and the units that they stand for, longer ones first.
_UNITS = {
    "_j_per_m": "J/m",
    "_rad_s": "rad/s",
    "_deg_s": "°/s",
    "_m_s2": "m/s²",
    "_m_s": "m/s",
    "_deg": "°",
    "_kpa": "kPa",
    "_nm": "N·m",
    "_mm": "mm",
    "_n": "N",
    "_m": "m",
    "_s": "s",
    "_w": "W",
    "_j": "J",
}


#: What a quantile of a quantity ends with: ``yaw_deg_p2_5``.
_QUANTILE = re.compile(r"_p\d+(_\d)?$")


def unit_of(name: str) -> str:
    """The unit in a name; 1 for ratios."""
    name = _QUANTILE.sub("", name)
    for ending, unit in _UNITS.items():
        if name.endswith(ending):
            return unit
    return "1"


def variable(dims: tuple[str, ...], name: str, values: Any) -> tuple[Any, ...]:
    """A variable for xarray, with its unit where it is a number."""
    array = np.asarray(values)
    if array.dtype.kind != "f":
        return dims, array
    return dims, array, {"units": unit_of(name)}


def dataset(
    dims: tuple[str, ...],
    columns: Mapping[str, Any],
    coords: Mapping[str, Any] | None = None,
    attrs: Mapping[str, Any] | None = None,
) -> xarray.Dataset:
    """Arrays of one shape as a dataset."""
    import xarray

    return xarray.Dataset(
        {name: variable(dims, name, values) for name, values in columns.items()},
        coords={name: variable((name,), name, values) for name, values in (coords or {}).items()},
        attrs=dict(attrs or {}),
    )


def frame(columns: Mapping[str, Any]) -> pandas.DataFrame:
    """Arrays of one shape as a table with a row for each entry."""
    import pandas

    return pandas.DataFrame(
        {name: np.ravel(np.asarray(values)) for name, values in columns.items()}
    )


def axes_or_new(axes: Axes | None) -> Axes:
    """The axes that were given, or those of a new figure."""
    if axes is not None:
        return axes
    import matplotlib.pyplot as plt

    return plt.subplots()[1]


def label(name: str) -> str:
    """A name for an axis: ``drawbar_pull_n`` is "drawbar pull [N]"."""
    unit = unit_of(name)
    ending = next((ending for ending in _UNITS if name.endswith(ending)), "")
    words = name.removesuffix(ending).replace("_", " ")
    return words if unit == "1" else f"{words} [{unit}]"
