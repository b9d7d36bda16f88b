"""Results as tables for pandas, xarray and Arrow. Columns and units are the library's."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from . import _core, _shown
from ._errors import ParameterError, present_name

if TYPE_CHECKING:
    import pandas
    import pyarrow
    import xarray
    from matplotlib.axes import Axes

#: Names of the library's columns of numbers, by result.
COLUMNS = {
    kind: tuple(name for name, _, _ in columns) for kind, columns in _core.result_columns().items()
}
#: What each of them is.
DOCS = {
    kind: {name: doc for name, _, doc in columns}
    for kind, columns in _core.result_columns().items()
}
#: Columns of words in datasets.
_WORDS = ("danger", "reason", "sentence", "verdict")


def unit_of(name: str) -> str:
    """The unit in a name, by the library's table; 1 for ratios."""
    # `yaw_deg_as_written` and `yaw_deg_rft` say behind the unit whose yaw it is.
    return _core.unit_of(name) or ("°" if "_deg_" in name else "1")


def arrays_of(table: Mapping[str, Any]) -> dict[str, NDArray[Any]]:
    """Columns as arrays, of objects where they are texts."""
    return {
        name: values if isinstance(values, np.ndarray) else np.array(values, dtype=object)
        for name, values in table.items()
    }


def variable(dims: tuple[str, ...], name: str, values: Any) -> tuple[Any, ...]:
    """A variable for xarray, with its unit where it is a number."""
    array = np.asarray(values)
    if array.dtype == object:
        # No format of files has None.
        array = np.array(["" if it is None else it for it in array.flat], object).reshape(array.shape)
    if array.dtype.kind != "f":
        return dims, array
    return dims, array, {"units": unit_of(name)}


def described(
    dim: str, docs: Mapping[str, str], columns: Mapping[str, Any], prefix: str = ""
) -> dict[str, Any]:
    """Columns as variables for xarray over one dimension, each with its unit and what it is.

    Parameters
    ----------
    dim
        The dimension.
    docs
        What the columns are, by their names.
    columns
        The columns, among others.
    prefix
        What stands before the name of each variable.
    """
    found = {}
    for name, doc in docs.items():
        cells = [it or "" for it in columns[name]] if name in _WORDS else columns[name]
        values = np.array(cells, dtype=np.str_ if name in _WORDS else np.float64)
        notes = {"units": _core.unit_of(name) or "-", "long_name": doc}
        found[prefix + name] = ((dim,), values, notes)
    return found


def with_inputs(
    data: xarray.Dataset, dims: tuple[str, ...], inputs: Mapping[str, NDArray[Any]]
) -> xarray.Dataset:
    """A dataset with inputs as coordinates, each over the dimensions along which it was given."""
    for name, values in inputs.items():
        own = dims[len(dims) - values.ndim :]
        kept = [k for k, size in enumerate(values.shape) if size > 1 or data.sizes[own[k]] == 1]
        cells = values.reshape([values.shape[k] for k in kept])
        data = data.assign_coords({name: variable(tuple(own[k] for k in kept), name, cells)})
    return data


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


class Tabular:
    """A result that is a table, for whatever reads Arrow's C interface: ``pyarrow.table(result)``,
    ``polars.DataFrame(result)``, DuckDB."""

    __slots__ = ()

    def _table(self) -> Mapping[str, Any]:
        """Columns of the table that ``to_pandas`` gives."""
        raise NotImplementedError

    def _notes(self) -> Mapping[str, str]:
        """Metadata of the whole table."""
        return {}

    def _unit_of(self, name: str) -> str | None:
        """The unit of a column of numbers; None where it differs from row to row."""
        return unit_of(name)

    def _shown(self) -> Mapping[str, Any]:
        """The columns that a notebook shows, most important first."""
        return self._table()

    def _repr_html_(self) -> str:
        """A table for notebooks: the first and last rows."""
        shape = getattr(self, "shape", ())
        title = repr(self).partition("\n")[0].strip("<>")
        return _shown.html_table(title, self._shown(), self._unit_of, shape)

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object:
        """The table as an Arrow stream of one batch, by the Arrow PyCapsule interface: what a
        consumer calls. The schema is always the table's own. Each number's unit is in its field's
        metadata as ``units``; a missing result is null."""
        columns = [
            (name, *_arrow_column(self._unit_of(name), np.ravel(np.asarray(values))))
            for name, values in self._table().items()
        ]
        return _core.arrow_stream(columns, dict(self._notes()))

    def to_arrow(self) -> pyarrow.Table:
        """The rows of ``to_pandas`` as a table of Arrow, with units in the fields' metadata and
        null for a missing result."""
        import pyarrow

        return pyarrow.table(self)

    # Type checkers see the present names only, and so find misspelt ones.
    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> object:
            """Refuses a name, with the present one where it is withdrawn."""
            # With slots there is no dictionary, and asking for it comes here again.
            known = () if name == "__dict__" else getattr(self, "__dict__", ())
            meant = present_name(name, known)
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}{meant}")


class Entries(Tabular):
    """A result with an entry for each combination of what was asked: arrays of the shape to which the
    arguments broadcast."""

    __slots__ = ()

    #: The name of the dimension, where there is one.
    _DIM: ClassVar[str] = "dim_0"
    inputs: Mapping[str, NDArray[Any]]

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of every field."""
        raise NotImplementedError

    def _results(self) -> dict[str, Any]:
        """Fields by name; what was asked may be among them."""
        raise NotImplementedError

    def __len__(self) -> int:
        return int(np.prod(self.shape))

    def _docs(self) -> Mapping[str, str]:
        """What each column is."""
        return DOCS["wheel"]

    def _axes(self) -> Mapping[str, NDArray[Any]]:
        """The last dimensions, where a study has some by itself, with their coordinates."""
        return {}

    def _table(self) -> dict[str, Any]:
        axes = self._axes()
        last, mesh = (1,) * len(axes), np.meshgrid(*axes.values(), indexing="ij")
        whole = {name: it.reshape(it.shape + last) for name, it in self.inputs.items()}
        whole |= dict(zip(axes, mesh))
        return {name: np.broadcast_to(it, self.shape) for name, it in whole.items()} | self._results()

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each entry, in the order of the flattened fields: inputs first,
        then results."""
        return frame(self._table())

    def to_xarray(self, dims: Sequence[str] | None = None) -> xarray.Dataset:
        """A dataset with units and what each column is in the attributes, as CF has them; netCDF keeps
        it. Inputs are coordinates, each over the dimensions along which it was given: with
        ``dims=["load_n", "slip_ratio"]`` loads and slip ratios index the dimensions of their names.

        Parameters
        ----------
        dims : sequence of str, optional
            Names of the dimensions; by default ``dim_0``, ``dim_1`` …, and ``run`` for runs in a row.
            The axes that a study has by itself follow under their own names.
        """
        axes = self._axes()
        count = len(self.shape) - len(axes)
        usual = (self._DIM,) if count == 1 else tuple(f"dim_{k}" for k in range(count))
        names = usual if dims is None else tuple(dims)
        if len(names) != count:
            raise ParameterError(
                f"dims has {len(names)} names, the fields have {count} dimensions", "dims"
            )
        results = {name: it for name, it in self._results().items() if name not in self.inputs}
        data = dataset((*names, *axes), results, axes, {"Conventions": "CF-1.11"})
        data = with_inputs(data, names, self.inputs)
        for name, one in data.variables.items():
            one.attrs["long_name"] = self._docs().get(str(name), name)
        return data


class Band(Tabular):
    """A dataclass of quantiles over samples. Its columns are the fields that are arrays."""

    def _table(self) -> dict[str, Any]:
        return {name: it for name, it in vars(self).items() if isinstance(it, np.ndarray)}


def _arrow_column(unit: str | None, cells: Any) -> tuple[str | None, Any]:
    """The unit of a column and its cells, as the native half takes them."""
    if cells.dtype.kind == "f":
        return unit, np.ascontiguousarray(cells, dtype=np.float64)
    if cells.dtype.kind in "iu":
        return None, np.ascontiguousarray(cells, dtype=np.int64)
    if cells.dtype.kind == "b":
        return None, np.ascontiguousarray(cells)
    return None, [None if cell is None else str(cell) for cell in cells]


def axes_or_new(axes: Axes | None) -> Axes:
    """The given axes, or those of a new figure in the package's style."""
    if axes is not None:
        return axes
    import matplotlib.pyplot as plt

    from . import style

    paper = style.colours(dark=True)["paper"][0]
    with style.context(dark=plt.rcParams["figure.facecolor"] == paper):
        return plt.subplots()[1]


def label(name: str) -> str:
    """A name for an axis: ``drawbar_pull_n`` is "drawbar pull [N]"."""
    unit, words = unit_of(name), name.split("_")
    if unit == "1":
        return " ".join(words)
    # The shortest end with this unit is the unit's own.
    count = next(k for k in range(1, len(words)) if unit_of("_".join(["", *words[-k:]])) == unit)
    return f"{' '.join(words[:-count])} [{unit}]"
