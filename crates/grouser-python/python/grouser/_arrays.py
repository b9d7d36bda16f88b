"""Numbers and arrays of callers, checked: every argument passes through here."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import ParameterError

Floats = NDArray[np.float64]


def number(name: str, value: Any) -> float:
    """One real number."""
    array = numbers(name, value)
    if array.ndim:
        raise ParameterError(f"{name} has shape {array.shape}, it must be one number", name)
    return float(array)


def whole_number(name: str, value: Any, *, most: int = 2**64 - 1) -> int:
    """One whole number that is not negative."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        given = type(value).__name__
        raise ParameterError(f"{name} is of type {given}, it must be a whole number", name)
    if not 0 <= value <= most:
        raise ParameterError(
            f"{name} is {value}, it must be from 0 to {most}", name, None, f"from 0 to {most}"
        )
    return int(value)


def numbers(name: str, values: ArrayLike) -> Floats:
    """Real numbers as an array whose axes have the order that the call documents."""
    dims = _dims(values)
    if len(dims) > 1:
        raise ParameterError(
            f"{name} is a DataArray over {_listed(dims)}, whose names do not count here: give its "
            ".values, with the axes in the documented order",
            name,
            None,
            "an array without names of dimensions",
        )
    return real(name, values)


def line(name: str, values: ArrayLike) -> Floats:
    """Numbers in a row; one number is a row of one."""
    array = numbers(name, values)
    if array.ndim > 1:
        raise ParameterError(f"{name} has shape {array.shape}, it must be one row", name)
    return np.ascontiguousarray(np.atleast_1d(array))


def varied(
    vary: Any, taken: Iterable[str] = (), also: Mapping[str, ArrayLike] | None = None
) -> dict[str, ArrayLike]:
    """Arrays by the keys of documents: without masked entries, and with labels that agree.

    Parameters
    ----------
    vary
        The caller's argument ``vary``.
    taken
        Keys that other arguments give.
    also
        Arrays of other arguments, which are with them.
    """
    vary = {} if vary is None else vary
    if not isinstance(vary, Mapping):
        raise ParameterError(
            f"vary is of type {type(vary).__name__}, it must be a mapping of keys to arrays", "vary"
        )
    for name in vary:
        if not isinstance(name, str):
            given = type(name).__name__
            raise ParameterError(f"vary has a key of type {given}, it must be text", "vary")
        if name in taken:
            raise ParameterError(f"{name} is given twice: once of them in vary", name)
    arrays = {**vary, **(also or {})}
    for name, values in arrays.items():
        _refuse_masked(name, values)
    refuse_other_labels(arrays)
    return arrays


def mask(name: str, values: ArrayLike, count: int) -> NDArray[np.bool_]:
    """A truth value for each of ``count`` items."""
    _refuse_masked(name, values)
    array = np.asarray(values)
    if array.dtype != np.bool_ or array.shape != (count,):
        raise ParameterError(
            f"{name} is of dtype {array.dtype} and shape {array.shape}, it must be bool and "
            f"({count},)",
            name,
        )
    return np.ascontiguousarray(array)


class Broadcast(NamedTuple):
    """Arguments of a call, and their entries at the common shape."""

    given: dict[str, Floats]
    """Real numbers as they were given."""
    flat: dict[str, Floats]
    """Their entries, in the order of the flattened shape."""
    places: list[NDArray[np.int64]]
    """The same of indices."""
    shape: tuple[int, ...]
    """The common shape."""


def broadcast(
    inputs: Mapping[str, ArrayLike], places: Mapping[str, NDArray[np.int64]]
) -> Broadcast:
    """Real numbers and indices at their common shape.

    Axes are matched by their order. So DataArrays of xarray, whose axes are matched by name, must
    have the same dimensions in the same order, and the same coordinates.

    Parameters
    ----------
    inputs
        Real numbers by the names of arguments.
    places
        Indices by the names of arguments.
    """
    refuse_other_labels(inputs)
    given = {name: real(name, values) for name, values in inputs.items()}
    arrays: dict[str, Any] = {**given, **places}
    whole = together(arrays)
    shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    flat = [np.ascontiguousarray(array).ravel() for array in whole]
    return Broadcast(given, dict(zip(given, flat)), flat[len(given) :], shape)


def together(arrays: Mapping[str, NDArray[Any]]) -> Sequence[NDArray[Any]]:
    """Arrays at their common shape."""
    try:
        return np.broadcast_arrays(*arrays.values())
    except ValueError:
        shapes = ", ".join(f"{name} {it.shape}" for name, it in arrays.items() if it.ndim)
        raise ParameterError(f"shapes do not broadcast: {shapes}") from None


def real(name: str, values: ArrayLike) -> Floats:
    """Real numbers; the error for anything else names the expected type."""
    _refuse_masked(name, values)
    try:
        array = np.asarray(values)
    except ValueError:
        raise ParameterError(f"{name} is ragged, it must be an array of numbers", name) from None
    # NumPy gives an empty list of no type the type of a number.
    if array.dtype.kind not in "fiu":
        raise ParameterError(
            f"{name} has dtype {array.dtype}, it must be real numbers", name, None, "real numbers"
        )
    return array.astype(np.float64)


def _refuse_masked(name: str, values: Any) -> None:
    """A masked entry has no value; NumPy's own conversion would take the one under the mask."""
    count = _masked(values)
    if count:
        entries = "1 masked entry" if count == 1 else f"{count} masked entries"
        raise ParameterError(
            f"{name} has {entries}, it must be numbers throughout: leave them out with "
            ".compressed(), or set their values with .filled(value)",
            name,
            None,
            "an array without masked entries",
        )


def _masked(values: Any) -> int:
    """How many entries are masked, also of masked arrays in lists."""
    if isinstance(values, np.ma.MaskedArray):
        return int(np.ma.getmaskarray(values).sum())
    if isinstance(values, (list, tuple)):
        return sum(_masked(it) for it in values if isinstance(it, (list, tuple, np.ndarray)))
    return 0


def _data_array(values: Any) -> Any:
    """A DataArray of xarray, or None. Without xarray imported, a value cannot be one."""
    xarray = sys.modules.get("xarray")
    return values if xarray is not None and isinstance(values, xarray.DataArray) else None


def _dims(values: Any) -> tuple[str, ...]:
    """The dimensions of a DataArray; empty for anything else."""
    array = _data_array(values)
    return () if array is None else tuple(str(dim) for dim in array.dims)


def _listed(dims: tuple[str, ...]) -> str:
    return " × ".join(dims)


def _refuse_other_index(inputs: Mapping[str, Any]) -> None:
    """Checks that all Series of pandas have the index of the first one."""
    series = {name: it for name, it in inputs.items() if hasattr(it, "iloc") and hasattr(it, "index")}
    for name, other in series.items():
        first_name, first = next(iter(series.items()))
        if not first.index.equals(other.index):
            raise ParameterError(
                f"{first_name} and {name} are Series with different indexes: entries are matched by "
                "their order. Give what pandas' align makes of them, or their .to_numpy()",
                name,
                None,
                "Series with the same index",
            )


def refuse_other_labels(inputs: Mapping[str, Any]) -> None:
    """Checks that labels agree: dimensions and coordinates of DataArrays, the index of Series."""
    _refuse_other_index(inputs)
    labelled = {name: it for name, it in inputs.items() if _dims(it)}
    if not labelled:
        return
    first_name, first = next(iter(labelled.items()))
    for name, other in labelled.items():
        if _dims(other) != _dims(first):
            raise ParameterError(
                f"{first_name} is a DataArray over {_listed(_dims(first))}, {name} one over "
                f"{_listed(_dims(other))}: axes are matched by their order, not by name. Give what "
                "xarray.broadcast makes of them, or their .values at shapes that broadcast",
                name,
                None,
                "DataArrays over the same dimensions in the same order",
            )
        for dim in first.dims:
            ours, theirs = first.indexes.get(dim), other.indexes.get(dim)
            if ours is not None and theirs is not None and not ours.equals(theirs):
                raise ParameterError(
                    f"{first_name} and {name} have different coordinates along {dim}: axes are "
                    "matched by their order. Give what xarray.align makes of them, or their .values",
                    name,
                    None,
                    "DataArrays with the same coordinates",
                )
