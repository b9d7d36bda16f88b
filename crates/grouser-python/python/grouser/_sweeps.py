"""Studies of many entries: documents, soils and numbers that vary from entry to entry."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _tables
from ._arrays import broadcast, varied
from ._cells import cells_of, documents_of, labels_of, number_cells
from ._descriptions import Mission, Scenario
from ._errors import ParameterError, SimulationError
from ._wheels import Outside, names_of, outside_is_nan, soils_of

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
    """All columns, by the names that the study's table has. ``status`` is ``ok``, or why there is no
    result: of the study, or because a number is out of its range."""
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
    study: str = ""
    """What its columns are of."""

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of every column."""
        return self.entries + tuple(len(it) for it in self.axes.values())

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self.columns[name]

    def __getattr__(self, name: str) -> Any:
        own = {} if name.startswith("_") else vars(self)
        known = {**own.get("columns", {}), **own.get("tables", {})}
        if name not in known:
            has = f"; it has {', '.join(known)}" if known else ""
            raise AttributeError(f"'Sweep' object has no attribute {name!r}{has}")
        return known[name]

    def _docs(self) -> Mapping[str, str]:
        return _tables.DOCS.get(self.study, {})

    def _axes(self) -> Mapping[str, NDArray[Any]]:
        return self.axes

    def _results(self) -> dict[str, Any]:
        return dict(self.columns)

    def __repr__(self) -> str:
        done = int(np.count_nonzero(self["status"] == "ok"))
        return f"<Sweep of shape {self.shape}: {done} of {len(self)} ok>"


class Entered(NamedTuple):
    """What is asked of a study for many entries."""

    documents: list[Any]
    """Scenarios or missions."""
    problems: dict[int, str]
    """Why some documents are none."""
    native: tuple[Any, ...]
    """All of it, as the native half takes it: second, which document each entry has."""
    shape: tuple[int, ...]
    """The shape of all entries."""
    inputs: dict[str, NDArray[Any]]
    """What was asked."""


def entered(
    base: type[Scenario] | type[Mission],
    source: Any,
    changes: Mapping[str, Any],
    vary: Vary,
    outside: Outside,
    taken: Sequence[str] = (),
    *,
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
    is_nan, own = outside_is_nan(outside), dict(changes)
    is_several = {name: isinstance(it, (list, tuple, np.ndarray)) for name, it in own.items()}
    several = {name: own.pop(name) for name in ("soil", "rover") if is_several.get(name)}
    given = varied(vary, (*taken, *changes), several)
    document = source if isinstance(source, base) and not own else base(source, **own)
    cells = {}
    for name, values in given.items():
        found = cells_of(values, document, name)
        if found is None and by_document:
            found = number_cells(name, values)
        if found is not None:
            cells[name] = found
    labels = {name: labels_of(it) for name, it in cells.items()}
    numbers = {name: it for name, it in given.items() if name not in cells}
    soils: list[Any] = []
    soil_places = nowhere = np.zeros((), dtype=np.int64)
    # Soils need no scenario each, unless their words vary.
    if not by_document and "soil" in cells and not any(it.startswith("soil.") for it in cells):
        soils, soil_places = soils_of(cells.pop("soil"))
        labels |= names_of(soils, soil_places)
    documents, places, problems = documents_of([document], nowhere, cells, is_nan)
    asked = broadcast(numbers, {"documents": places, "soil": soil_places})
    places, soil_places = asked.places
    native = (
        [one._document for one in documents],
        places,
        [one._document for one in soils],
        soil_places if soils else None,
        asked.flat,
        places.size,
        is_nan,
        [(k, problems[it]) for k, it in enumerate(places.tolist()) if it in problems],
    )
    return Entered(documents, problems, native, asked.shape, {**labels, **asked.given})


#: Arguments of studies: what is wrong with them is wrong with no entry.
_ARGUMENTS = ("slope_deg", "course_deg", "samples", "seed", "rule", "uphill", "rim_speed_m_s")


def of_each(
    asked: Entered, axes: Mapping[str, Any], study: Callable[[Any], Mapping[str, Any]]
) -> list[dict[str, Any]]:
    """The table of all entries, by a study of one document after the other, with its own axes."""
    why, tables = dict(asked.problems), {}
    rows = int(np.prod([len(it) for it in axes.values()]))
    places = asked.native[1].tolist()
    for number in sorted({*places} - {*why}):
        try:
            table = study(asked.documents[number])
            tables[number] = {name: np.ravel(np.asarray(it)) for name, it in table.items()}
            tables[number].setdefault("status", np.full(rows, "ok", object))
        except ParameterError as error:
            if error.name in _ARGUMENTS or not asked.native[-2]:
                raise
            why[number] = str(error)
        except SimulationError as error:
            why[number] = str(error)
    tables |= {number: {"status": np.full(rows, it, object)} for number, it in why.items()}
    names = dict.fromkeys(["status", *(name for table in tables.values() for name in table)])
    columns = {}
    for name in names:
        is_number = any(table[name].dtype.kind in "fiu" for table in tables.values() if name in table)
        nothing = np.full(rows, np.nan if is_number else None)
        each = {number: table.get(name, nothing) for number, table in tables.items()}
        cells = [each[number] for number in places] or [nothing[:0]]
        columns[name] = np.concatenate(cells).astype(float if is_number else object)
    return [columns]


def sweep_of(
    asked: Entered,
    tables: Sequence[Mapping[str, Any]],
    kind: str,
    names: Sequence[str],
    axes: Mapping[str, Any],
    **more: Mapping[str, Any],
) -> Sweep:
    """The tables of all entries as arrays.

    Parameters
    ----------
    kind
        What the columns are of, as `_tables.DOCS` has it.
    names
        Columns of numbers that are there also where no entry has a table.
    axes
        The axes that the first table has by itself.
    more
        The axes of the second table, under its name; without it the second has what all rows of an
        entry have.
    """

    def shaped(table: Mapping[str, Any], axes: Mapping[str, Any]) -> dict[str, NDArray[Any]]:
        shape = asked.shape + tuple(len(it) for it in axes.values())
        known = {*axes, *asked.inputs, "soil"}
        return {
            name: it.reshape(shape)
            for name, it in _tables.arrays_of(table).items()
            if name not in known
        }

    sizes = [len(it) for it in axes.values()]
    nothing = {name: np.full((*asked.shape, *sizes), np.nan) for name in names}
    columns = shaped(tables[0], axes)
    if not more and len(tables) > 1:
        ends = shaped(tables[1], {name: [0] for name in axes})
        nothing |= {name: np.broadcast_to(it, columns["status"].shape) for name, it in ends.items()}
    columns = {**columns, **{name: it for name, it in nothing.items() if name not in columns}}
    beside = {
        name: Sweep(shaped(tables[1], own), _arrays(own), asked.inputs, asked.shape, {}, kind)
        for name, own in more.items()
    }
    return Sweep(columns, _arrays(axes), asked.inputs, asked.shape, beside, kind)


def _arrays(axes: Mapping[str, Any]) -> dict[str, NDArray[Any]]:
    return {name: np.asarray(it) for name, it in axes.items()}
