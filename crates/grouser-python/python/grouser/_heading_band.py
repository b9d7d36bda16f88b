"""The uncertainty of the heading offset where soil and model are uncertain."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

from . import _tables
from ._arrays import Floats


@dataclass(frozen=True, eq=False)
class _OnSlopes(_tables.Band):
    """What bands of the heading offset have on each slope."""

    yaw_deg_p2_5: Floats
    """Yaw [°], positive uphill; an end is missing where no heading holds it."""
    yaw_deg_p50: Floats
    """Its median [°]."""
    yaw_deg_p97_5: Floats
    """Its upper end [°]."""
    slip_ratio_p2_5: Floats
    """Slip ratio [-]."""
    slip_ratio_p50: Floats
    """Its median [-]."""
    slip_ratio_p97_5: Floats
    """Its upper end [-]."""
    sinkage_mm_p2_5: Floats
    """Mean sinkage of the wheels [mm]."""
    sinkage_mm_p50: Floats
    """Its median [mm]."""
    sinkage_mm_p97_5: Floats
    """Its upper end [mm]."""
    energy_j_per_m_p2_5: Floats
    """Work of the wheels per metre along the course [J/m]."""
    energy_j_per_m_p50: Floats
    """Its median [J/m]."""
    energy_j_per_m_p97_5: Floats
    """Its upper end [J/m]."""
    probability_level: Floats
    """Probability that a heading holds the course [-]: the share of the samples that have one."""
    probability_level_low: Floats
    """Lower end of its 95 % confidence interval, for the number of samples [-]."""
    probability_level_high: Floats
    """Upper end of that interval [-]."""
    draws_level: Floats
    """Samples with a heading that holds the course."""


@dataclass(frozen=True, eq=False)
class HeadingBand(_OnSlopes):
    """Heading offset over samples of soil and model: arrays of shape (slopes,).

    ``…_p2_5``, ``…_p50`` and ``…_p97_5`` are quantiles over all samples: 95 % of the values lie
    between the first and the last. A sample in which no heading holds the course counts as slip 1,
    sunk to the axles, and with a yaw and a work above every number. An end that no number reaches
    is NaN: the upper end of the yaw where no heading holds the course in more than 2.5 % of the
    samples, and its median where that is so in half of them. Where neither soil nor model is
    uncertain there is one sample, and no band of the yaw. (Names of columns are those of version
    0.1, in which samples are *draws*.)

    Examples
    --------
    >>> import grouser as gr
    >>> band = gr.heading(slope_deg=[5, 10], samples=10).band
    >>> bool((band.yaw_deg_p2_5 <= band.yaw_deg_p97_5).all()), band.probability_level.tolist()
    (True, [1.0, 1.0])
    """

    draws: int
    """Samples for which it is known whether one does."""
    draws_mobile: int
    """Samples on which the rover can move on level ground."""
    limit_slope_deg_p2_5: float | None
    """The steepest slope [°]; 0 in a sample in which the rover cannot move."""
    limit_slope_deg_p50: float | None
    """Its median [°]."""
    limit_slope_deg_p97_5: float | None
    """Its upper end [°]."""
    model_weights: Mapping[str, float]
    """The share of the samples that each wheel–soil model computes [-]."""

    @classmethod
    def _of(
        cls, rows: Mapping[str, Any], limit: Mapping[str, Any], belief: Mapping[str, Any]
    ) -> HeadingBand:
        found = {**rows, **limit, **belief}
        return cls(**{one.name: found[one.name] for one in fields(cls)})

    def __repr__(self) -> str:
        ends = f"{self.limit_slope_deg_p2_5}° to {self.limit_slope_deg_p97_5}°"
        return f"<HeadingBand over {self.draws} samples, the steepest slope is {ends}>"


@dataclass(frozen=True, eq=False)
class HeadingMapBand(_OnSlopes):
    """Heading offset over samples of soil and model: arrays of shape (soils, courses, slopes), with
    quantiles as those of a `HeadingBand`.

    Made by `heading_map`, which has an example.
    """

    draws: Floats
    """Samples for which it is known whether one does."""
    draws_mobile: Floats
    """Samples on which the rover can move on level ground."""
    limit_slope_deg_p2_5: Floats
    """The steepest slope [°]; 0 in a sample in which the rover cannot move."""
    limit_slope_deg_p50: Floats
    """Its median [°]."""
    limit_slope_deg_p97_5: Floats
    """Its upper end [°]."""
    model_weights: tuple[Mapping[str, float], ...]
    """The share of the samples that each wheel–soil model computes [-], for each soil."""

    def __repr__(self) -> str:
        shape = " × ".join(map(str, self.draws.shape))
        return f"<HeadingMapBand of {shape} soils, courses, slopes>"
