"""Statistics over the runs of a campaign, computed by the library."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from .. import _core, _shown
from .._errors import ParameterError

if TYPE_CHECKING:
    import pandas

    from ._results import Results


@dataclass(frozen=True)
class Share:
    """The share of runs with some status or outcome, with its 95 % interval (Wilson).

    Made by `Results.summarise`, as a value of `Summary.status` and `Summary.outcome`.
    """

    count: int
    """Number of independent runs with it."""
    share: float
    """Share of all independent runs [-]."""
    low: float
    """Lower end of the interval [-]."""
    high: float
    """Upper end [-]."""


@dataclass(frozen=True)
class Quantity:
    """Statistics of one result over the runs, in the unit of its name. Intervals are 95 %
    intervals.

    Made by `Results.summarise`, as a value of `Summary.quantities`.
    """

    name: str
    """The column."""
    count: int
    """Number of independent runs that have a value."""
    missing: int
    """Number of independent runs that have none."""
    mean: float
    """Mean; NaN, as the statistics below, if fewer than two runs have a value."""
    mean_low: float
    """Lower end of the mean's interval."""
    mean_high: float
    """Upper end."""
    standard_deviation: float
    """Standard deviation."""
    least: float
    """The smallest."""
    most: float
    """The largest."""
    quantiles: Mapping[float, tuple[float, float | None, float | None]]
    """For each probability: the quantile, and the ends of its confidence interval; None where too
    few runs bound it."""
    convergence: tuple[Mapping[str, Any], ...]
    """The same after the first 16, 32 … runs, and after all: ``runs``, ``mean`` and so on."""
    sensitivity: Mapping[str, Mapping[str, float]]
    """Sobol indices of each input: ``first`` and ``total`` with ``_low`` and ``_high``, over
    ``points`` points, without ``points_missing`` others; empty for a campaign without
    ``sensitivity``."""


@dataclass(frozen=True)
class Summary:
    """Statistics over the runs of a campaign.

    Made by `Results.summarise`. `run` has an example.
    """

    runs: int
    """Number of independent runs: all runs; in a campaign with ``sensitivity``, without those with
    one input exchanged, which serve the Sobol indices alone."""
    status: Mapping[str, Share]
    """Share of each status."""
    outcome: Mapping[str, Share]
    """Share of each outcome, for traverses and missions."""
    quantities: Mapping[str, Quantity]
    """Statistics of each result."""
    legs: Mapping[str, Mapping[str, Share]]
    """For missions, what became of each leg: the share of each word in the columns
    ``leg_1.outcome``, ``leg_1.stopped_by`` and so on, of all independent runs."""

    def to_pandas(
        self, table: Literal["results", "sensitivity", "convergence"] = "results"
    ) -> pandas.DataFrame:
        """One of the tables of the summary.

        Parameters
        ----------
        table : {"results", "sensitivity", "convergence"}
            ``results`` has a row for each result; quantiles are columns such as ``0.975``, with
            ``0.975_low`` and ``0.975_high``. ``sensitivity`` has the Sobol indices: a row for each
            result and input, with ``first`` and ``total`` and the ends of their intervals; no rows
            for a campaign without ``sensitivity``. ``convergence`` has a row for each result and
            number of runs.

        Raises
        ------
        ParameterError
            For another name.
        """
        import pandas

        rows, names = self._rows(table)
        return pandas.DataFrame(rows, columns=names if not rows else None)

    def _rows(self, table: str) -> tuple[list[dict[str, Any]], tuple[str, ...]]:
        """Rows of a table, and the columns that it has at least."""
        all_of_them = self.quantities.values()
        if table == "results":
            return [_row(quantity) for quantity in all_of_them], ("name",)
        if table == "sensitivity":
            indices = [
                {"name": it.name, "input": name, **index}
                for it in all_of_them
                for name, index in it.sensitivity.items()
            ]
            return indices, ("name", "input", "first", "total")
        if table == "convergence":
            found = [{"name": it.name, **row} for it in all_of_them for row in it.convergence]
            return found, ("name", "runs")
        known = "results, sensitivity or convergence"
        raise ParameterError(f"table is {table!r}, it must be {known}", "table", None, known)

    def _repr_html_(self) -> str:
        """Tables for notebooks: of the results, and of the Sobol indices if there are some."""
        titles = {"results": f"Summary of {self.runs} runs", "sensitivity": "Sobol indices"}
        shown = []
        for table, title in titles.items():
            rows, _ = self._rows(table)
            if rows:
                columns = {
                    name: np.array([row.get(name) for row in rows], dtype=object) for name in rows[0]
                }
                shown.append(_shown.html_table(title, columns, lambda name: None))
        return "".join(shown)

    def __repr__(self) -> str:
        lines = [f"{self.runs} runs"]
        shares = {**self.status, **{f"outcome {name}": it for name, it in self.outcome.items()}}
        for column, words in self.legs.items():
            shares |= {f"{column} {word}": it for word, it in words.items()}
        for name, it in shares.items():
            lines.append(f"  {name}: {it.share:.2%} ({it.low:.2%} to {it.high:.2%})")
        for name, quantity in self.quantities.items():
            spread = ", ".join(f"{q:g}: {at[0]:.4g}" for q, at in quantity.quantiles.items())
            lines.append(f"  {name}: mean {quantity.mean:.4g}; quantiles {spread}")
        return "\n".join(lines)


def _row(quantity: Quantity) -> dict[str, Any]:
    names = ("name", "count", "missing", "mean", "mean_low", "mean_high", "standard_deviation")
    row = {name: getattr(quantity, name) for name in (*names, "least", "most")}
    for share, (value, low, high) in quantity.quantiles.items():
        row |= {f"{share:g}": value, f"{share:g}_low": low, f"{share:g}_high": high}
    return row


def summary_of(
    results: Results, columns: Iterable[str] | None, quantiles: Sequence[float]
) -> Summary:
    """The summary of finished results."""
    shares = [float(share) for share in quantiles]
    for share in shares:
        if not 0.0 < share < 1.0:
            raise ParameterError(
                f"{share} is not the probability of a quantile",
                "quantiles",
                share,
                "between 0 and 1",
            )
    campaign = results.campaign
    names = list(campaign.outputs if columns is None else columns)
    for name in names:
        if name not in campaign.outputs:
            known = ", ".join(campaign.outputs)
            raise ParameterError(f"{name!r} is not a result", "columns", None, known)
    runs = results._runs()
    words_of_legs = campaign._facts["words_of_legs"]
    has = [name for name in ("status", "outcome") if name in results.columns]
    texts = results._columns([*has, *words_of_legs])
    outcomes = texts.get("outcome", ())
    statuses = list(texts["status"])
    of_legs = [(name, list(texts[name])) for name in words_of_legs]
    found = _core.campaign_frequencies(campaign._document, runs, statuses, list(outcomes), of_legs)
    quantities = {}
    at_once = max(1, _BYTES // (8 * max(1, len(results))))
    for start in range(0, len(names), at_once):
        columns = results._columns(names[start : start + at_once])
        values = [(name, np.ascontiguousarray(column)) for name, column in columns.items()]
        for one in _core.campaign_summary(campaign._document, runs, values, statuses, shares):
            quantities[one["quantity"]] = _quantity(one)
    status, outcome = _shares(found["status"]), _shares(found["outcome"])
    legs = {column: _shares(words) for column, words in found["legs"].items()}
    return Summary(found["samples"], status, outcome, quantities, legs)


#: Bytes of columns that are in memory at once: each pass over the files reads and checks that many.
_BYTES = 1 << 28


def _shares(counts: Mapping[str, tuple[int, float, float, float]]) -> dict[str, Share]:
    """The share of each text, most frequent first; runs without a text are left out."""
    most = sorted(counts.items(), key=lambda pair: (-pair[1][0], pair[0]))
    return {name: Share(*of) for name, of in most}


def _quantity(found: dict[str, Any]) -> Quantity:
    nan = float("nan")
    sensitivity = {it.pop("input"): it for it in found["sensitivity"]}
    return Quantity(
        name=found["quantity"],
        count=found.get("count", 0),
        missing=found["missing"],
        mean=found.get("mean", nan),
        mean_low=found.get("mean_low", nan),
        mean_high=found.get("mean_high", nan),
        standard_deviation=found.get("standard_deviation", nan),
        least=found.get("least", nan),
        most=found.get("most", nan),
        quantiles={
            share: (value, low, high) for share, value, low, high in found.get("quantiles", ())
        },
        convergence=tuple(found["convergence"]),
        sensitivity=sensitivity,
    )
