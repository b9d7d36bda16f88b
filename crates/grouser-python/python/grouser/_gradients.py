"""Derivatives of results by numbers of documents."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import NDArray

from ._arrays import Floats
from ._errors import ParameterError

if TYPE_CHECKING:
    import xarray

#: Keys by which results are differentiated; ``"all"`` is every number.
Keys = Union[str, Sequence[str]]

#: The name of the axis of keys.
_AXIS = "key"
#: The result that has no slope of its own.
_LIMIT = "limit_slope_deg"


@dataclass(frozen=True, eq=False)
class Gradient(Mapping[str, Floats]):
    """Derivatives of results, by the results' names: arrays of the results' shape with a last axis
    of keys, each in the result's unit for one unit of the key. NaN by a key that the documents
    lack, and where there is no result.

    Those of settled wheels are exact to about 1e-9: partial derivatives at what was found are taken
    by differences, and what follows them is solved for. Those of runs are differences of whole runs.

    Examples
    --------
    How much less does a wheel sink for each metre of radius, and how much more does it pull?

    >>> import grouser as gr
    >>> wheel = gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=0.2, gradients=["wheel.radius_m"])
    >>> wheel.gradient.names
    ('wheel.radius_m',)
    >>> [round(float(wheel.gradient[name][0]), 1) for name in ("sinkage_mm", "drawbar_pull_n")]
    [-28.2, 13.0]
    """

    names: tuple[str, ...]
    """The keys of the last axis."""
    values_of: Mapping[str, Floats]
    """The derivatives, by the results' names."""
    one_sided: Mapping[str, NDArray[np.bool_]]
    """Whether a derivative differs from side to side, or within the step of a difference: the
    result has a kink there, and its derivative is the mean of both sides."""

    def __getitem__(self, name: str) -> Floats:
        return self.values_of[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.values_of)

    def __len__(self) -> int:
        return len(self.values_of)

    def to_xarray(self, dims: Sequence[str]) -> xarray.Dataset:
        """A dataset over these dimensions of the results and ``key``.

        Parameters
        ----------
        dims : sequence of str
            Names of the results' dimensions.
        """
        import xarray

        axes = (*dims, _AXIS)
        data = {name: (axes[-it.ndim :], it) for name, it in self.values_of.items()}
        return xarray.Dataset(data, coords={_AXIS: list(self.names)})

    def __repr__(self) -> str:
        return f"<Gradient of {len(self)} results by {', '.join(self.names) or 'nothing'}>"


def keys_of(keys: Keys | None) -> list[str] | None:
    """The keys as a list.

    Raises
    ------
    ParameterError
        For what is no text or sequence of texts, and for none at all.
    """
    if keys is None:
        return None
    names = [keys] if isinstance(keys, str) else list(keys)
    if not names or not all(isinstance(name, str) for name in names):
        raise ParameterError('gradients must be keys of numbers, or "all"', "gradients")
    return names


def of_columns(columns: dict[str, Any], limit: Mapping[str, Any]) -> Gradient:
    """Those of a table, whose columns ``d_<result>_d_<key>`` are taken from it; and of the steepest
    slope's row."""
    one_sided = columns.pop("one_sided")
    start = f"d_{_LIMIT}_d_"
    keys = [name[len(start) :] for name in limit if name.startswith(start)]
    names = [name for name in columns if name.startswith("d_")]
    values: dict[str, list[Any]] = {}
    sides: dict[str, list[Any]] = {}
    for key in keys:
        end = f"_d_{key}"
        for name in [it for it in names if it.endswith(end)]:
            result = name[len("d_") : -len(end)]
            values.setdefault(result, []).append(columns.pop(name))
            sides.setdefault(result, []).append([name in it.split(";") for it in one_sided])
        of_limit = limit[f"d_{_LIMIT}{end}"]
        values.setdefault(_LIMIT, []).append(np.nan if of_limit is None else of_limit)
        sides.setdefault(_LIMIT, []).append(f"d_{_LIMIT}{end}" in limit["one_sided"])
    return Gradient(
        tuple(keys),
        {name: np.stack(it, axis=-1).astype(np.float64) for name, it in values.items()},
        {name: np.stack([np.asarray(one) for one in it], axis=-1) for name, it in sides.items()},
    )


def of_rows(
    rows: Any, one_sided: Any, keys: Sequence[str], names: Sequence[str], shape: tuple[int, ...]
) -> Gradient:
    """Derivatives from rows of all results by the first key, then by the next."""
    cells = rows.reshape(len(keys), len(names), *shape)
    sides = one_sided.reshape(cells.shape)
    last = range(1, len(shape) + 1)
    order = (*last, 0)
    return Gradient(
        tuple(keys),
        {name: cells[:, place].transpose(order) for place, name in enumerate(names)},
        {name: sides[:, place].transpose(order) for place, name in enumerate(names)},
    )
