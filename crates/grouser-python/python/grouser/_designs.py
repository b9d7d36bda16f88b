"""Designs: which numbers of a rover are the best, under limits."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _core, _tables
from ._arrays import whole_number
from ._descriptions import Design, Rover, Source

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True, eq=False)
class BestDesign(_tables.Tabular):
    """The numbers that were found, and what shows that they are the best.

    Made by `design`, which has an example.
    """

    design: Mapping[str, Any]
    """What was chosen and found, by its keys, in their units."""
    objective: float
    """The least of what was to be least, in its unit."""
    rover: Rover
    """The rover with these numbers."""
    constraints: Mapping[str, Any]
    """The limits, columns of shape (limits,): ``ground``, ``name``, ``side``, ``bound``, ``value``, in
    the units of their names, ``price`` (by how much the aim falls if the limit is loosened by one),
    and ``share`` of fresh samples that keeps it, where the soil is uncertain."""
    designs: Mapping[str, Any]
    """What the rover as given and as found measures by each model: columns of shape (rows,)."""
    trade: Mapping[str, Any] | Any
    """The same of designs between the least of two measures, if these were asked for."""
    certificate: Mapping[str, int]
    """``probes``: designs within 1 % of the bounds that were looked at; ``better``: those of them
    that are better."""
    starts: Mapping[str, int]
    """``searches`` that were started, and those that ``agreed``."""

    def _table(self) -> Mapping[str, Any]:
        return self.constraints

    def to_pandas(self) -> pandas.DataFrame:
        """The limits as a table, a row for each."""
        return _tables.frame(self.constraints)

    def __repr__(self) -> str:
        numbers = ", ".join(f"{key}={value:.4g}" if isinstance(value, float) else f"{key}={value}"
                            for key, value in self.design.items())
        return f"<BestDesign {self.objective:.4g} with {numbers}>"


def design(
    design: Design | Source,
    /,
    *,
    nominal: bool = False,
    seed: int = 1,
    trade: tuple[str, str] | Any = None,
    **changes: Any,
) -> BestDesign:
    """The free numbers of a rover that make something the least, under limits. The numbers are those
    of the program's ``grouser design``, bit for bit.

    Parameters
    ----------
    design : Design, name, path or mapping
        What is free, what is to be least, and what is limited.
    nominal : bool
        Take soils as their documents have them, and one model. Without it limits are kept with the
        document's ``probability`` where the soil is uncertain.
    seed : int
        Seed of the samples.
    trade : tuple of two str, optional
        Two measures, such as ``("energy_j_per_m", "wheel_mass_kg")``: also the designs between the
        best of one and the best of the other: the least, or the steepest slope.
    **changes
        Keys of the design with other values: ``soil="toyoura-uncertain"``.

    Returns
    -------
    BestDesign

    Raises
    ------
    DocumentError
        If the document is not valid.
    ParameterError
        If no design keeps every limit; the message says which one the nearest misses.

    Examples
    --------
    The lightest wheels with which HAKUTO sinks by no more than a tenth of their radius:

    >>> import grouser as gr
    >>> found = gr.design("design-lighter-wheels")
    >>> round(found.design["rover.wheel_unit.wheel.radius_m"], 4), round(found.objective, 3)
    (0.1291, 1.022)
    >>> list(found.constraints["name"]), found.constraints["price"].round(2).tolist()
    (['limit_slope_deg', 'sinkage_ratio'], [0.0, 7.44])
    """
    task = Design(design, **changes)
    seed = whole_number("seed", seed)
    record, tables, rover = _core.design(task._document, nominal, seed, trade)
    return BestDesign(
        design=record["design"],
        objective=record["objective"],
        rover=Rover.from_toml(rover),
        constraints=tables["constraints"],
        designs=tables["designs"],
        trade=tables.get("trade"),
        certificate=record["certificate"],
        starts=record["starts"],
    )
