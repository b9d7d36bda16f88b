"""What the runs of a campaign say together. The statistics are the library's."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _core
from .._errors import ParameterError

if TYPE_CHECKING:
    import pandas

    from ._results import Results


@dataclass(frozen=True)
class Share:
    """How often something happened, with its 95 % interval (Wilson)."""

    count: int
    """Independent runs in which it did."""
    share: float
    """Of all independent runs [-]."""
    low: float
    """Lower end of the interval [-]."""
    high: float
    """Upper end [-]."""


@dataclass(frozen=True)
class Quantity:
    """What the runs say of one result, in the unit of its name. Intervals are of 95 %."""

    name: str
    """The column."""
    count: int
    """Independent runs that have it."""
    missing: int
    """Independent runs that do not."""
    mean: float
    """Mean; NaN, as all of these, if fewer than two runs have it."""
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
    """For each share: the quantile, and the two runs between which it lies; None where so few runs do
    not bound it."""
    convergence: tuple[Mapping[str, Any], ...]
    """The same after the first 16, 32 … runs, and after all: ``runs``, ``mean`` and so on."""
    sensitivity: Mapping[str, Mapping[str, float]]
    """Sobol indices for each input: ``first`` and ``total`` with ``_low`` and ``_high``, over ``points`` points,
    ``points_missing`` being left out; empty unless the campaign was laid out for them."""


@dataclass(frozen=True)
class Summary:
    """What the runs of a campaign say together."""

    runs: int
    """How many there are that are independent: all, but for a campaign with ``sensitivity``, where those with one
    input exchanged only tell the Sobol indices."""
    status: Mapping[str, Share]
    """How often each status is."""
    outcome: Mapping[str, Share]
    """What became of the rover, for traverses."""
    quantities: Mapping[str, Quantity]
    """Each result."""

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each result; quantiles are columns such as ``0.975``, with
        ``0.975_low`` and ``0.975_high``."""
        import pandas

        return pandas.DataFrame([_row(quantity) for quantity in self.quantities.values()])

    def __repr__(self) -> str:
        lines = [f"{self.runs} runs"]
        shares = {**self.status, **{f"outcome {name}": it for name, it in self.outcome.items()}}
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
                f"{share} is no quantile's share", "quantiles", share, "between 0 and 1"
            )
    campaign = results.campaign
    names = list(campaign.outputs if columns is None else columns)
    for name in names:
        if name not in campaign.outputs:
            known = ", ".join(campaign.outputs)
            raise ParameterError(f"{name!r} is no result", "columns", None, known)
    runs = results._runs()
    texts = results._columns([name for name in ("status", "outcome") if name in results.columns])
    outcomes = texts.get("outcome", ())
    said = _core.campaign_frequencies(
        campaign._document, runs, list(texts["status"]), list(outcomes)
    )
    quantities = {}
    at_once = max(1, _BYTES // (8 * max(1, len(results))))
    for start in range(0, len(names), at_once):
        columns = results._columns(names[start : start + at_once])
        values = [(name, np.ascontiguousarray(column)) for name, column in columns.items()]
        for told in _core.campaign_summary(campaign._document, runs, values, shares):
            quantities[told["quantity"]] = _quantity(told)
    return Summary(said["samples"], _shares(said["status"]), _shares(said["outcome"]), quantities)


#: How much of the columns is in memory at once: each pass over the files brings that many, and checks them.
_BYTES = 1 << 28


def _shares(counts: Mapping[str, tuple[int, float, float, float]]) -> dict[str, Share]:
    """How often each word is, most often first; runs without one do not count."""
    most = sorted(counts.items(), key=lambda pair: (-pair[1][0], pair[0]))
    return {word: Share(*of) for word, of in most}


def _quantity(told: dict[str, Any]) -> Quantity:
    nan = float("nan")
    sensitivity = {it.pop("input"): it for it in told["sensitivity"]}
    return Quantity(
        name=told["quantity"],
        count=told.get("count", 0),
        missing=told["missing"],
        mean=told.get("mean", nan),
        mean_low=told.get("mean_low", nan),
        mean_high=told.get("mean_high", nan),
        standard_deviation=told.get("standard_deviation", nan),
        least=told.get("least", nan),
        most=told.get("most", nan),
        quantiles={
            share: (value, low, high) for share, value, low, high in told.get("quantiles", ())
        },
        convergence=tuple(told["convergence"]),
        sensitivity=sensitivity,
    )
