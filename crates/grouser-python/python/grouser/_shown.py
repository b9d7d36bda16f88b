"""Results as text, and as HTML tables for notebooks: four digits, the middle of long tables left
out."""

from __future__ import annotations

import html
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

#: Rows and columns of an HTML table, at most.
MOST_ROWS = 12
MOST_COLUMNS = 16
#: Rows of a table as text, at most.
MOST_LINES = 8


def cell(value: Any) -> str:
    """A value with four digits; a dash where there is none."""
    if value is None:
        return "–"
    if isinstance(value, (float, np.floating)):
        return "–" if np.isnan(value) else f"{value:.4g}"
    return str(value)


def text_table(columns: Mapping[str, Any]) -> str:
    """Columns of few rows as text, numbers to the right."""
    cells = {name: [cell(it) for it in np.ravel(values)] for name, values in columns.items()}
    widths = {name: max(map(len, (name, *texts))) for name, texts in cells.items()}
    are_texts = {name for name, values in columns.items() if np.asarray(values).dtype.kind in "OU"}

    def line(of: Callable[[str], str]) -> str:
        sides = ("<" if name in are_texts else ">" for name in widths)
        parts = (f"{of(name):{side}{widths[name]}}" for name, side in zip(widths, sides))
        return "  ".join(parts).rstrip()

    rows = range(max(map(len, cells.values()), default=0))
    return "\n".join([line(str), *(line(lambda name: cells[name][row]) for row in rows)])


def spread(columns: Mapping[str, Any]) -> str:
    """The least, median and largest number of each column as text."""
    of: dict[str, Callable[[Any], Any]] = {"least": np.min, "median": np.median, "largest": np.max}
    found = {name: np.ravel(values) for name, values in columns.items()}
    kept = {name: values[~np.isnan(values)] for name, values in found.items()}
    kept = {name: values for name, values in kept.items() if values.size}
    numbers: dict[str, Any] = {"": np.array(list(kept), dtype=object)}
    for word, take in of.items():
        numbers[word] = np.array([float(take(values)) for values in kept.values()])
    return text_table(numbers)


def html_table(
    title: str,
    columns: Mapping[str, Any],
    unit_of: Callable[[str], str | None],
    shape: Sequence[int] = (),
) -> str:
    """Columns as an HTML table with a title.

    Parameters
    ----------
    title
        A line of text above the table.
    columns
        Arrays of one size.
    unit_of
        The unit of a column of numbers.
    shape
        The arrays' shape; with several dimensions each row starts with its index.
    """
    flat = {name: np.ravel(np.asarray(values)) for name, values in columns.items()}
    count = max((len(values) for values in flat.values()), default=0)
    rows, is_cut = list(range(count)), count > MOST_ROWS
    if is_cut:
        half = MOST_ROWS // 2
        rows = [*rows[:half], *rows[-half:]]
    names = list(flat)[:MOST_COLUMNS]
    is_indexed = len(shape) > 1
    sides = ["left" if flat[name].dtype.kind in "OU" else "right" for name in names]
    sides = ["left", *sides] if is_indexed else sides

    def line(tag: str, index: str, cells: Sequence[str], weight: str = "normal") -> str:
        style = f"white-space:nowrap;font-weight:{weight}"
        whole = zip(sides, [index, *cells] if is_indexed else cells)
        cells = [f"<{tag} style='{style};text-align:{side}'>{it}</{tag}>" for side, it in whole]
        return f"<tr>{''.join(cells)}</tr>"

    lines = [line("th", "", [html.escape(name) for name in names], "bold")]
    units = [_unit(flat[name], unit_of(name)) for name in names]
    if any(units):
        lines.append(line("th", "", units))
    for place, row in enumerate(rows):
        if is_cut and place == MOST_ROWS // 2:
            lines.append(line("td", "⋮", ["⋮"] * len(names)))
        own = [html.escape(cell(flat[name][row])) for name in names]
        lines.append(line("td", _index(row, shape), own))
    notes = [f"{count} rows"] if is_cut else []
    if len(flat) > len(names):
        notes.append(f"{len(flat) - len(names)} more columns")
    note = f"<div>{', '.join(notes)}: <code>to_pandas()</code> has all</div>" if notes else ""
    return (
        f"<div style='overflow-x:auto'><div>{html.escape(title)}</div>"
        f"<table>{''.join(lines)}</table>{note}</div>"
    )


def _index(row: int, shape: Sequence[int]) -> str:
    return ", ".join(str(place) for place in np.unravel_index(row, tuple(shape))) if shape else ""


def _unit(values: Any, unit: str | None) -> str:
    return f"[{html.escape(unit)}]" if values.dtype.kind == "f" and unit not in (None, "1") else ""
