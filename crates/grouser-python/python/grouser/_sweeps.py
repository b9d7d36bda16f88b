"""Studies of many entries: documents, soils and numbers that vary from entry to entry."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _tables
from ._arrays import Floats, broadcast, varied
from ._cells import cells_of, documents_of, labels_of, number_cells, whole_cells
from ._descriptions import Mission, Scenario
from ._errors import ParameterError, SimulationError
from ._wheels import Outside, names_of, outside_is_nan, soils_of

if TYPE_CHECKING:
    import xarray

#: What differs from entry to entry: arrays by the keys of documents.
Vary = Mapping[str, Any]


@dataclass(frozen=True, eq=False)
class Sweep(_tables.Entries):
    """A study of many entries: what a study gives with ``vary``.

    Each column is an array of `shape`: that to which all that varies broadcasts, and after it the axes
    that the study has by itself, such as ``slope_deg``. Entry ``k`` of a column has what the study
    of entry ``k`` alone has, bit for bit, NaN or None where there is nothing. A column is an attribute,
    ``found.yaw_deg``, and an item, ``found["yaw_deg"]``.

    Examples
    --------
    >>> import grouser as gr
    >>> friction = {"soil.friction_angle_deg": [34.0, 38.0]}
    >>> found = gr.heading(slope_deg=[5.0, 10.0, 15.0], vary=friction, nominal=True)
    >>> found.shape, bool((found.yaw_deg[0] > found.yaw_deg[1]).all())
    ((2, 3), True)
    >>> on_sand = found.to_xarray(dims=["soil.friction_angle_deg"])
    >>> on_sand.yaw_deg.dims
    ('soil.friction_angle_deg', 'slope_deg')
    >>> bool(on_sand.yaw_deg.sel({"soil.friction_angle_deg": 34.0, "slope_deg": 5.0}) > 2.0)
    True
    """

    columns: Mapping[str, NDArray[Any]]
    """All columns, by the names that the study's table has."""
    axes: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    """The axes that the study has by itself, in their order, each with its coordinates."""
    inputs: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    """What was asked, by name: arrays as given, which broadcast to `entries`; soils and rovers by
    their names."""
    entries: tuple[int, ...] = ()
    """The shape to which what varies broadcasts."""
    tables: Mapping[str, Sweep] = field(default_factory=dict)
    """Other tables of the study, which are attributes, too: ``limits`` of `wheel_speeds`, ``legs`` of
    `mission`."""
    _docs: Mapping[str, str] = field(default_factory=dict)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of every column."""
        return self.entries + tuple(len(it) for it in self.axes.values())

    @property
    def status(self) -> NDArray[np.object_]:
        """``ok``, or why there is no result: of the study, or because a number is out of its
        range."""
        return self.columns["status"]

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self.columns[name]

    def __getattr__(self, name: str) -> Any:
        known = self.__dict__ if name[:1] != "_" else {}
        for one in (known.get("columns", {}), known.get("tables", {})):
            if name in one:
                return one[name]
        raise AttributeError(
            f"{type(self).__name__!r} object has no attribute {name!r}; it has "
            + ", ".join([*known.get("columns", ()), *known.get("tables", ())])
        )

    def _results(self) -> dict[str, Any]:
        return dict(self.columns)

    def _table(self) -> dict[str, Any]:
        last = (1,) * len(self.axes)
        inputs = {name: it.reshape(it.shape + last) for name, it in self.inputs.items()}
        mesh = np.meshgrid(*self.axes.values(), indexing="ij")
        whole = {**inputs, **dict(zip(self.axes, mesh))}
        return {
            **{name: np.broadcast_to(it, self.shape) for name, it in whole.items()},
            **self.columns,
        }

    def to_xarray(self, dims: Sequence[str] | None = None) -> xarray.Dataset:
        """A dataset with units and what each column is in the attributes, as CF has them, which
        netCDF keeps. Inputs are coordinates, each over the dimensions along which it was given.

        Parameters
        ----------
        dims : sequence of str, optional
            Names of the dimensions of `entries`; by default ``dim_0``, ``dim_1`` …. The axes of the
            study follow under their own names.
        """
        names = self._dims(len(self.entries), dims)
        columns = {name: _tables.without_none(it) for name, it in self.columns.items()}
        notes = {"Conventions": "CF-1.11"}
        data = _tables.dataset((*names, *self.axes), columns, self.axes, notes)
        data = _tables.with_inputs(data, names, self.inputs)
        for name, it in data.variables.items():
            it.attrs["long_name"] = self._docs.get(str(name), str(name).replace("_", " "))
        return data

    def __repr__(self) -> str:
        done = int(np.count_nonzero(self.status == "ok"))
        return f"<Sweep of shape {self.shape}: {done} of {len(self)} ok>"


class Entered(NamedTuple):
    """What is asked of a study for many entries."""

    documents: list[Any]
    """Scenarios or missions."""
    places: NDArray[np.int64]
    """Which of them each entry has."""
    problems: dict[int, str]
    """Why some documents are none."""
    soils: tuple[list[Any], NDArray[np.int64]]
    """Soils in the place of their own, and which of them each entry has."""
    flat: dict[str, Floats]
    """A number of each entry under each key."""
    shape: tuple[int, ...]
    """The shape of all entries."""
    inputs: dict[str, NDArray[Any]]
    """What was asked."""
    outside_is_nan: bool
    """Whether what is out of its range is no error."""

    def native(self, kept: NDArray[np.int64]) -> tuple[Any, ...]:
        """Some entries, as the native half takes them."""
        soils, soil_places = self.soils
        return (
            [one._document for one in self.documents],
            self.places[kept] if len(self.documents) > 1 else None,
            [one._document for one in soils],
            soil_places[kept] if len(soils) > 1 else None,
            {name: it[kept] for name, it in self.flat.items()},
            kept.size,
            self.outside_is_nan,
        )


def entered(
    base: type[Scenario] | type[Mission],
    source: Any,
    changes: Mapping[str, Any],
    vary: Vary,
    outside: Outside,
    *,
    taken: tuple[str, ...] = (),
    by_document: bool = False,
) -> Entered:
    """What is asked: numbers as arrays, and a document for each combination of all else.

    Parameters
    ----------
    base, source, changes
        The document whose keys vary; ``soil`` and ``rover`` among its changes may be several.
    taken
        Keys that other arguments give.
    by_document
        Whether a document is needed for each combination of numbers, too.
    """
    is_nan = outside_is_nan(outside)
    parts = {name: changes[name] for name in ("soil", "rover") if name in changes}
    several = {name: it for name, it in parts.items() if isinstance(it, (list, tuple, np.ndarray))}
    for name in several:
        if name in vary:
            taken = (*taken, name)
    given = {**varied(vary, taken=taken), **several}
    own = {name: it for name, it in changes.items() if name not in several}
    document = source if isinstance(source, base) and not own else base(source, **own)
    cells = {}
    for name, values in given.items():
        found = cells_of(values)
        if found is None:
            found = number_cells(values) if by_document else whole_cells(document, name, values)
        if found is not None:
            cells[name] = found
    soils: tuple[list[Any], NDArray[np.int64]] = ([], np.zeros((), dtype=np.int64))
    is_soil_alone = not any(name.startswith("soil.") for name in cells)
    if "soil" in cells and is_soil_alone and not by_document:
        soils = soils_of(cells.pop("soil"))
    numbers = {name: it for name, it in given.items() if name not in cells and name != "soil"}
    documents, places, problems = documents_of(
        [document], np.zeros((), dtype=np.int64), cells, is_nan
    )
    asked = broadcast(numbers, {"documents": places, "soil": soils[1]})
    flat, soil_flat = asked.places
    labels = {name: labels_of(it) for name, it in cells.items()}
    inputs = {**names_of(*soils), **labels, **asked.given}
    found_soils = (soils[0], soil_flat)
    return Entered(documents, flat, problems, found_soils, asked.flat, asked.shape, inputs, is_nan)


#: Tables of columns with so many rows for each entry, of which entries, and why others have none.
_Found = tuple[list[tuple[dict[str, Any], int]], NDArray[np.int64], list[tuple[int, str]]]


def of_all(asked: Entered, native: Callable[..., Any], *settings: Any) -> _Found:
    """The tables of all entries, by a native study of many."""
    bad = np.isin(asked.places, list(asked.problems))
    kept = np.flatnonzero(~bad)
    tables, order, missing = native(asked.native(kept), *settings)
    why = [(int(place), asked.problems[int(asked.places[place])]) for place in np.flatnonzero(bad)]
    return tables, kept[np.asarray(order, dtype=np.int64)], [*((int(kept[k]), it) for k, it in missing), *why]


def of_each(asked: Entered, study: Callable[[Any], Mapping[str, Any]]) -> _Found:
    """The tables of all entries, by a study of one document after the other."""
    problems, tables = dict(asked.problems), {}
    for number in np.unique(asked.places):
        try:
            if number not in problems:
                table = study(asked.documents[number])
                tables[int(number)] = {name: _column(it) for name, it in table.items()}
        except SimulationError as error:
            problems[number] = str(error)
        except ParameterError as error:
            if not asked.outside_is_nan:
                raise
            problems[number] = str(error)
    rows = max((it.size for table in tables.values() for it in table.values()), default=0)
    order = np.flatnonzero(~np.isin(asked.places, list(problems)))
    names = dict.fromkeys(name for table in tables.values() for name in table)
    columns = {}
    for name in names:
        dtype = next(table[name].dtype for table in tables.values() if name in table)
        nothing = np.full(rows, None if dtype == object else np.nan, dtype=dtype)
        each = {number: table.get(name, nothing) for number, table in tables.items()}
        columns[name] = np.concatenate([each[int(it)] for it in asked.places[order]])
    missing = [(k, problems[it]) for k, it in enumerate(asked.places.tolist()) if it in problems]
    return [(columns, rows)], order, missing


def _column(values: Any) -> NDArray[Any]:
    """A column of numbers, or of anything else."""
    cells = np.ravel(np.asarray(values))
    return cells.astype(np.float64 if cells.dtype.kind in "fiu" else object)


def sweep_of(
    asked: Entered,
    found: _Found,
    axes: Mapping[str, Any],
    kind: str,
    names: Sequence[str],
    more: tuple[str, Mapping[str, Any]] | None = None,
) -> Sweep:
    """The tables of all entries as arrays.

    Parameters
    ----------
    axes
        The axes that the first table has by itself.
    kind
        What the columns are of, as `_tables.DOCS` has it.
    names
        Columns of numbers that are there also where no entry has a table.
    more
        The name of the second table, and its axes; without it the second has what all rows of the
        first have.
    """
    tables, order, missing = found
    count = asked.places.size

    def columns_of(place: int, names: Sequence[str], shape: tuple[int, ...]) -> dict[str, Any]:
        columns, rows = tables[place]
        size = rows if columns else int(np.prod(shape[len(asked.shape) :]))
        cells: dict[str, Any] = {}
        for name, values in _tables.arrays_of(columns).items():
            # What is missing is None in a column of texts.
            nothing: Any = None if values.dtype == object else np.nan
            cells[name] = np.full((count, size), nothing, dtype=values.dtype)
            cells[name][order] = values.reshape(len(order), size)
        for name in names:
            cells.setdefault(name, np.full((count, size), np.nan))
        status = cells.setdefault("status", np.full((count, size), "ok", dtype=object))
        for entry, why in missing:
            status[entry] = why
            if "flags" in cells:
                cells["flags"][entry] = ""
        return {name: it.reshape(shape) for name, it in cells.items()}

    whole = asked.shape + tuple(len(it) for it in axes.values())
    columns = columns_of(0, names, whole)
    beside: dict[str, Sweep] = {}
    if more is not None:
        name, own = more
        shape = asked.shape + tuple(len(it) for it in own.values())
        beside[name] = _sweep(asked, columns_of(1, (), shape), own, kind, {})
    elif len(tables) > 1 and tables[1][0]:
        ends = columns_of(1, (), (*asked.shape, *(1 for _ in axes)))
        del ends["status"]
        columns |= {name: np.broadcast_to(it, whole) for name, it in ends.items()}
    return _sweep(asked, columns, axes, kind, beside)


def _sweep(
    asked: Entered,
    columns: Mapping[str, Any],
    axes: Mapping[str, Any],
    kind: str,
    tables: Mapping[str, Sweep],
) -> Sweep:
    known = {*axes, *asked.inputs, "soil"}
    own = {name: it for name, it in columns.items() if name not in known}
    axes = {name: np.asarray(it) for name, it in axes.items()}
    return Sweep(own, axes, asked.inputs, asked.shape, tables, _tables.DOCS.get(kind, {}))
