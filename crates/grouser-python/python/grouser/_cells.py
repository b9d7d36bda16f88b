"""What differs from entry to entry and is no number: documents, words, whole numbers. Each combination
that occurs is read once."""

from __future__ import annotations

import os
from collections.abc import Hashable, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from ._arrays import real, together
from ._descriptions import _Description
from ._errors import DocumentError, DocumentNotFoundError, ParameterError

_Document = TypeVar("_Document", bound=_Description)

#: The end of the sentence about an entry without a number.
IS_NAN = " is NaN"

#: Things without a number, as an array.
Cells = NDArray[np.object_]


def cells_of(values: Any, description: _Description, key: str, prefix: str = "") -> Cells | None:
    """Things as an array, and whole numbers where the document has one under a key, but for its
    prefix; None for other numbers."""
    found: Any = description._items
    for part in key.removeprefix(prefix).split("."):
        found = found.get(part) if isinstance(found, dict) else None
    if isinstance(found, float):
        return None
    array = as_array(key, values)
    if array.dtype == object:
        return array
    is_whole = isinstance(found, int) and not isinstance(found, bool)
    if array.size == 0 and not is_whole and (found is not None or key == "model"):
        raise ParameterError(f"{key} is empty, it must be at least one", key, None, "at least one")
    return number_cells(key, values) if is_whole else None


def as_array(name: str, values: Any) -> NDArray[Any]:
    """Numbers, or things as they are."""
    try:
        array = np.asarray(values, dtype=object if _is_thing(values) else None)
    except ValueError:
        array = np.array([values, None], dtype=object)
    if array.dtype == object and any(isinstance(it, (list, tuple)) for it in array.flat):
        raise ParameterError(f"{name} is ragged, it must be an array", name)
    return array.astype(object) if array.dtype.kind in "USb" else array


def _is_thing(values: Any) -> bool:
    if isinstance(values, (list, tuple)):
        return any(_is_thing(it) for it in values)
    return isinstance(values, (str, bool, Mapping, os.PathLike, _Description))


def number_cells(name: str, values: Any) -> Cells:
    """Numbers as things: each by itself, whole ones as such."""
    real(name, values)
    cells = np.empty(np.shape(values), dtype=object)
    for place, it in np.ndenumerate(np.asarray(values)):
        cells[place] = int(it) if float(it).is_integer() else float(it)
    return cells


def labels_of(cells: Cells) -> NDArray[Any]:
    """Things as a column: descriptions by their names, of which equal ones are numbered."""
    different, places = _different(cells)
    names = [getattr(it, "name") if isinstance(it, _Description) else it for it in different]
    if all(isinstance(it, (int, float)) and not isinstance(it, bool) for it in names):
        return np.array(names or [0.0])[places]
    return np.array(numbered([str(it) for it in names]), dtype=object)[places]


def numbered(names: Sequence[str]) -> list[str]:
    """Names, those that occur twice with their places."""
    twice = {name for name in names if names.count(name) > 1}
    return [f"{name} ({k})" if name in twice else name for k, name in enumerate(names)]


def _different(cells: Cells) -> tuple[list[Any], NDArray[np.int64]]:
    """Different things, and which of them each entry has."""
    known: dict[Hashable, int] = {}
    different: list[Any] = []
    places = np.empty(cells.shape, dtype=np.int64)
    for place, it in np.ndenumerate(cells):
        key = id(it) if isinstance(it, Mapping) else (type(it), it)
        places[place] = known.setdefault(key, len(known))
        if len(known) > len(different):
            different.append(it)
    return different, places


def documents_of(
    bases: Sequence[_Document],
    base_of: NDArray[np.int64],
    cells: Mapping[str, Cells],
    outside_is_nan: bool,
) -> tuple[list[_Document], NDArray[np.int64], dict[int, str]]:
    """The different documents of some entries, and which of them each has; and why some are none.

    Parameters
    ----------
    bases, base_of
        Documents whose keys are exchanged, and which of them each entry has.
    cells
        What stands under keys, at shapes that broadcast with that.
    outside_is_nan
        Whether what is out of range, or does not go together, is no error; keys and documents that
        are not there always are.
    """
    each = [(list(bases), base_of), *(_different(it) for it in cells.values())]
    whole = together(dict(zip((bases[0]._kind, *cells), (places for _, places in each))))
    rows = np.stack([it.ravel() for it in whole], axis=-1)
    different, index = np.unique(rows, axis=0, return_inverse=True)
    made: list[_Document] = []
    problems: dict[int, str] = {}
    for number, row in enumerate(different):
        things = [things[place] for (things, _), place in zip(each, row)]
        keys = dict(zip(cells, things[1:]))
        missing = [name for name, it in keys.items() if isinstance(it, float) and np.isnan(it)]
        made.append(things[0])
        if missing:
            problems[number] = missing[0] + IS_NAN
            continue
        try:
            made[-1] = _with(things[0], keys)
        except (ParameterError, DocumentError) as error:
            # What is not there at all is a mistake, whatever the number.
            is_unknown = isinstance(error, DocumentNotFoundError) or "unknown key `" in str(error)
            if is_unknown or not outside_is_nan:
                raise
            problems[number] = str(error)
    return made or list(bases), index.reshape(whole[0].shape).astype(np.int64), problems


def _with(document: _Document, keys: Mapping[str, Any]) -> _Document:
    """A document with other things under some keys: parts as a whole first, then what is in them."""
    steps: dict[int, dict[str, Any]] = {}
    for name, it in keys.items():
        *tables, key = name.split(".")
        # How many of the other keys are of parts that this one is in.
        depth = sum(name.startswith(f"{other}.") for other in keys)
        table = steps.setdefault(depth, {})
        for part in tables:
            table = table.setdefault(part, {})
        table[key] = it
    for _, changes in sorted(steps.items()):
        document = type(document)(document, **changes)
    return document
