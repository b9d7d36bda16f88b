"""Measured rows: files, tables of pandas, polars and Arrow, and other laboratories' files."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Union

import numpy as np
from numpy.typing import NDArray

from . import _core, _tables
from ._arrays import whole_number
from ._errors import ParameterError

if TYPE_CHECKING:
    import pandas

#: Measured rows: the name of a data set, a path, or a table.
Data = Union[str, "os.PathLike[str]", Mapping[str, Any], Any]


def rows_of(data: Any) -> str | tuple[str, str]:
    """Measured rows for the native half: a name or path as it is, a table as a CSV text with the
    label that messages have. Line 1 of the text is the header, as in a file."""
    if isinstance(data, (str, os.PathLike)):
        return os.fspath(data)
    columns = _columns_of(data)
    lengths = {name: len(values) for name, values in columns.items()}
    if len(set(lengths.values())) > 1:
        shown = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise ParameterError(f"the columns of data differ in length: {shown}", "data")
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([_cell(value) for value in row] for row in zip(*columns.values()))
    return type(data).__name__, text.getvalue()


def _columns_of(data: Any) -> dict[str, Any]:
    """The columns of a table: a mapping, a result of grouser, a DataFrame, or a table of Arrow."""
    if isinstance(data, ImportedWheelTests):
        return dict(data._table())
    if isinstance(data, _tables.Tabular):
        return {name: np.ravel(np.asarray(it)) for name, it in data._table().items()}
    if isinstance(data, Mapping):
        return {str(name): np.atleast_1d(np.asarray(it)) for name, it in data.items()}
    if hasattr(data, "to_pydict"):
        return dict(data.to_pydict())
    if hasattr(data, "iloc") and hasattr(data, "items"):
        return {str(name): column.tolist() for name, column in data.items()}
    if hasattr(data, "__arrow_c_stream__"):
        try:
            import pyarrow
        except ImportError as error:
            kind = type(data).__name__
            raise ImportError(f"a {kind} is read by pyarrow: pip install pyarrow") from error
        return dict(pyarrow.table(data).to_pydict())
    given = type(data).__name__
    raise ParameterError(
        f"data is of type {given}, it must be a data set's name, a path, a DataFrame, a table of "
        "Arrow, or a mapping of columns",
        "data",
    )


def _cell(value: Any) -> str:
    """A value as a CSV file has it: every digit of a number, and nothing for a missing one."""
    if isinstance(value, (float, np.floating)):
        return "" if np.isnan(value) else repr(float(value))
    # None, and what pandas has for a missing text or number.
    return "" if value is None or type(value).__name__ in ("NAType", "NaTType") else str(value)


@dataclass(frozen=True, eq=False)
class ImportedWheelTests(_tables.Tabular):
    """Wheel tests of another laboratory, in Grouser's columns, units and signs: `calibrate` and
    `validate` take it as data.

    Made by `import_wheel_tests`, which has an example.
    """

    text: str
    """The table as CSV, as the program's ``import`` writes it."""
    columns: Mapping[str, NDArray[Any]]
    """Columns by name: numbers with NaN where there is none, or texts."""
    left_out: tuple[str, ...]
    """Columns of the file that were not taken."""
    notes: tuple[str, ...]
    """Remarks on the rows."""

    def _table(self) -> Mapping[str, Any]:
        return self.columns

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each trial."""
        return _tables.frame(self.columns)

    def __repr__(self) -> str:
        count = max((len(column) for column in self.columns.values()), default=0)
        return f"<ImportedWheelTests with {count} rows: {', '.join(self.columns)}>"


def import_wheel_tests(
    file: str | os.PathLike[str],
    columns: Mapping[str, str],
    *,
    delimiter: str = ",",
    decimal_comma: bool = False,
    skip_lines: int = 0,
    slip_definition: Literal["larger", "rim", "hub"] = "larger",
) -> ImportedWheelTests:
    """Converts wheel tests from a CSV file of another laboratory: columns, units, signs and the
    definition of slip. Results equal those of the program's ``import``.

    Parameters
    ----------
    file : str or path
        The file.
    columns : mapping of str to str
        For each of Grouser's columns (``docs/guide/data.md`` lists them) the file's column, with
        its unit behind a colon and a minus where its sign is the other one:
        ``{"load_n": "Fz:kN", "side_force_n": "-Fy", "sinkage_mm": "z:m"}``. Columns that have
        Grouser's names are taken as they are.
    delimiter : str
        What separates two fields; ``"\\t"`` for a tab.
    decimal_comma : bool
        Whether decimals are written with a comma.
    skip_lines : int
        Lines before the header.
    slip_definition : {"larger", "rim", "hub"}
        The speed by which the file divides: the larger one, as Grouser does; the rim's,
        1 − v/(ω r); or the hub's, ω r/v − 1.

    Returns
    -------
    ImportedWheelTests

    Raises
    ------
    ParameterError
        For a column that measurements do not have, or a unit of something else.
    DocumentError, DocumentNotFoundError
        For a file that cannot be used, with its line.

    Examples
    --------
    >>> import os, tempfile
    >>> import grouser as gr
    >>> folder = tempfile.TemporaryDirectory()
    >>> file = os.path.join(folder.name, "theirs.csv")
    >>> with open(file, "w") as theirs:
    ...     _ = theirs.write("Fz;s;Fx\\n0,017;20;1,9\\n0,017;40;4,2\\n")
    >>> test = gr.import_wheel_tests(
    ...     file,
    ...     {"load_n": "Fz:kN", "slip_ratio": "s:%", "drawbar_pull_n": "Fx"},
    ...     delimiter=";",
    ...     decimal_comma=True,
    ... )
    >>> test.columns["load_n"].tolist(), test.columns["slip_ratio"].tolist()
    ([17.0, 17.0], [0.2, 0.4])
    >>> gr.validate(test, "toyoura", "hakuto").overall["trials"]
    2
    >>> folder.cleanup()
    """
    if not isinstance(columns, Mapping):
        raise ParameterError(
            f"columns is of type {type(columns).__name__}, it must be a mapping of our columns to theirs",
            "columns",
        )
    if not isinstance(delimiter, str) or len(delimiter) != 1:
        raise ParameterError(
            f"delimiter is {delimiter!r}, it must be one character", "delimiter", None, "one character"
        )
    text, left_out, notes = _core.import_wheel_tests(
        os.fspath(file),
        [f"{ours}={theirs}" for ours, theirs in columns.items()],
        delimiter,
        bool(decimal_comma),
        whole_number("skip_lines", skip_lines),
        slip_definition,
    )
    return ImportedWheelTests(text, _parsed(text), tuple(left_out), tuple(notes))


def _parsed(text: str) -> dict[str, NDArray[Any]]:
    """The columns of a CSV text: numbers where all cells are, with NaN for empty ones."""
    header, *rows = csv.reader(io.StringIO(text))
    cells: Sequence[Sequence[str]] = list(zip(*rows)) if rows else [()] * len(header)
    return {name: _numbers(values) for name, values in zip(header, cells)}


def _numbers(cells: Sequence[str]) -> NDArray[Any]:
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array([cell or None for cell in cells], dtype=object)
