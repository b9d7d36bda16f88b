"""Which yaw keeps a rover level, over slope, course and soil."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._arrays import Floats, line, number, whole_number
from ._attitude_band import AttitudeBand
from ._descriptions import Scenario, Soil, Source
from ._errors import ParameterError
from ._studies import columns_of, scenario_of, soil_of

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes

#: Fields of an `AttitudeMap`; `Attitudes` have all but the power.
_ATTITUDE = _tables.COLUMNS["attitude"]
#: In the order of the program's tables.
_LEVEL = tuple(name for name in _ATTITUDE if name != "power_w")


@dataclass(frozen=True, eq=False)
class Attitudes(_tables.Tabular):
    """Level attitudes: arrays of shape (slopes,), NaN where there is none."""

    limit_slope_deg: float | None
    """The steepest slope with a level attitude [°]; None where the rover cannot move."""
    limit_message: str
    """What ends the curve there."""
    status: NDArray[np.object_]
    """Of each slope: ``ok``, or why there is no attitude."""
    slope_deg: Floats
    """Slopes [°]."""
    yaw_deg: Floats
    """Yaw that keeps the course [°], positive uphill."""
    slip_ratio: Floats
    """Slip ratio of every wheel [-]."""
    sinkage_mm: Floats
    """Mean sinkage of the wheels [mm]."""
    torque_nm: Floats
    """Torque of all wheels together [N·m]."""
    energy_j_per_m: Floats
    """Work of the wheels per metre along the course [J/m]."""
    yaw_moment_nm: Floats
    """Yaw moment left over [N·m]; negative turns the nose downhill."""
    band: AttitudeBand | None = None
    """What the draws of an uncertain soil say, where they were asked for."""

    def _table(self) -> dict[str, Any]:
        band = {} if self.band is None else self.band._table()
        return {**columns_of(self, ("slope_deg", *_LEVEL)), "status": self.status, **band}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each slope."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``slope_deg`` with units in the attributes."""
        columns = self._table()
        coords = {"slope_deg": columns.pop("slope_deg")}
        return _tables.dataset(("slope_deg",), columns, coords)

    def plot(self, axes: Axes | None = None, **style: Any) -> Axes:
        """Draws the yaw over the slope, and the band of an uncertain soil where there is one."""
        axes = _tables.axes_or_new(axes)
        if self.band is not None:
            ends = (self.band.yaw_deg_p2_5, self.band.yaw_deg_p97_5)
            axes.fill_between(self.slope_deg, *ends, alpha=0.25, label="95 % of the draws")
        axes.plot(self.slope_deg, self.yaw_deg, **style)
        axes.set_xlabel("slope [°]")
        axes.set_ylabel("yaw, positive uphill [°]")
        return axes

    def __repr__(self) -> str:
        return f"<Attitudes on {len(self.status)} slopes, the steepest is {self.limit_slope_deg}°>"


def attitude(
    scenario: Scenario | Source | None = None,
    /,
    *,
    slope_deg: ArrayLike = (5.0, 10.0, 15.0, 20.0),
    uncertainty: bool = False,
    samples: int = 500,
    seed: int = 1,
    **changes: Any,
) -> Attitudes:
    """The yaw that keeps a traverse level, on each slope ([FourWheel], Fig. 10).

    Parameters
    ----------
    scenario : Scenario, name, path or mapping, optional
        Its rover, soil, gravity, model, loads and moments count; not its slope, drive or start.
    slope_deg : array_like, shape (slopes,)
        Slopes [°], 0 to 60.
    uncertainty : bool
        Whether to draw soils as the soil's ``uncertainty`` says, and add `Attitudes.band`.
    samples : int
        Number of draws, 2 to 100000.
    seed : int
        Of the draws: the same seed, the same soils.
    **changes
        Keys of the scenario with other values.

    Returns
    -------
    Attitudes

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `Scenario`. That no yaw keeps a traverse level is a result.

    Examples
    --------
    >>> import grouser as gr
    >>> round(float(gr.attitude(slope_deg=[10.0]).yaw_deg[0]), 1)
    5.0
    >>> level = gr.attitude(soil="toyoura-uncertain", slope_deg=10.0, uncertainty=True, samples=20)
    >>> bool(level.band.yaw_deg_p2_5[0] < level.band.yaw_deg_p97_5[0])
    True
    """
    slopes, run = line("slope_deg", slope_deg), scenario_of(scenario, changes)
    found, limit, reason = _core.attitude(run._document, slopes)
    band = None
    if uncertainty:
        draws = whole_number("samples", samples, most=2**32 - 1)
        band = AttitudeBand._of(run, slopes, whole_number("seed", seed), draws)
    status = np.array(found.pop("status"), dtype=object)
    return Attitudes(limit_slope_deg=limit, limit_message=reason, status=status, band=band, **found)


@dataclass(frozen=True, eq=False)
class AttitudeMap(_tables.Tabular):
    """Attitudes over soil, course and slope: arrays of shape (soils, courses, slopes), NaN where
    there is none."""

    soil: tuple[str, ...]
    """The soils' names."""
    course_deg: Floats
    """Directions of travel from the contour [°], positive uphill; shape (courses,)."""
    slope_deg: Floats
    """Slopes [°]; shape (slopes,)."""
    status: NDArray[np.object_]
    """``ok``, or why there is no attitude; shape (soils, courses, slopes)."""
    yaw_deg: Floats
    """Yaw that keeps the course [°], positive uphill."""
    slip_ratio: Floats
    """Slip ratio of every wheel [-]."""
    sinkage_mm: Floats
    """Mean sinkage of the wheels [mm]."""
    torque_nm: Floats
    """Torque of all wheels together [N·m]."""
    energy_j_per_m: Floats
    """Work of the wheels per metre along the course [J/m]."""
    yaw_moment_nm: Floats
    """Yaw moment left over [N·m]; negative turns the nose downhill."""
    power_w: Floats
    """Power of the motors at the rim speed of the map [W]."""
    limit_slope_deg: Floats
    """The steepest slope of the soil and course [°], the same on every slope."""

    def _columns(self) -> dict[str, Any]:
        names = (*_LEVEL, "power_w", "limit_slope_deg")
        return {**columns_of(self, names), "status": self.status}

    def _table(self) -> dict[str, Any]:
        soil, course, slope = np.meshgrid(
            np.array(self.soil, dtype=object), self.course_deg, self.slope_deg, indexing="ij"
        )
        return {"soil": soil, "course_deg": course, "slope_deg": slope, **self._columns()}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each soil, course and slope, as the program has it."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``soil``, ``course_deg`` and ``slope_deg``, units in the attributes."""
        coords = {"soil": self.soil, "course_deg": self.course_deg, "slope_deg": self.slope_deg}
        return _tables.dataset(tuple(coords), self._columns(), coords)

    def plot(
        self, axes: Axes | None = None, *, soil: int = 0, name: str = "slip_ratio", **style: Any
    ) -> Axes:
        """Draws a quantity over slope and course, for one of the soils by its place."""
        axes = _tables.axes_or_new(axes)
        mesh = axes.pcolormesh(self.slope_deg, self.course_deg, getattr(self, name)[soil], **style)
        axes.figure.colorbar(mesh, ax=axes, label=_tables.label(name))
        axes.set_xlabel("slope [°]")
        axes.set_ylabel("course, positive uphill [°]")
        axes.set_title(self.soil[soil])
        return axes

    def __repr__(self) -> str:
        return f"<AttitudeMap of {' × '.join(map(str, self.status.shape))} soils, courses, slopes>"


def attitude_map(
    scenario: Scenario | Source | None = None,
    /,
    *,
    soil: Soil | Source | Sequence[Soil | Source] | None = None,
    slope_deg: ArrayLike = tuple(range(0, 25, 2)),
    course_deg: ArrayLike = tuple(range(-60, 61, 15)),
    speed_m_s: float = 0.06,
    **changes: Any,
) -> AttitudeMap:
    """Attitudes over soil, course and slope.

    Parameters
    ----------
    scenario : Scenario, name, path or mapping, optional
        As for `attitude`.
    soil : Soil, name, path, mapping, or a sequence of them, optional
        The soils; the scenario's own without.
    slope_deg : array_like, shape (slopes,)
        Slopes [°], 0 to 60.
    course_deg : array_like, shape (courses,)
        Directions of travel from the contour [°], −90 to 90, positive uphill.
    speed_m_s : float
        Rim speed [m/s], for the power.
    **changes
        Keys of the scenario with other values.

    Returns
    -------
    AttitudeMap

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `attitude`.
    """
    one = scenario_of(scenario, changes)
    several = isinstance(soil, Sequence) and not isinstance(soil, str)
    soils: list[Any] = list(soil) if several else [soil]  # type: ignore[arg-type]
    if not soils:
        raise ParameterError("soil is empty, it must be at least one", "soil")
    runs = [one if it is None else one.replace(soil=soil_of(it)) for it in soils]
    slopes, courses = line("slope_deg", slope_deg), line("course_deg", course_deg)
    speed = number("speed_m_s", speed_m_s)
    found = _core.attitude_map([run._document for run in runs], slopes, courses, speed)
    shape = (len(runs), len(courses), len(slopes))
    numbers = {name: found[name].reshape(shape) for name in (*_ATTITUDE, "limit_slope_deg")}
    status = np.array(found["status"], dtype=object).reshape(shape)
    names = tuple(run.soil.name for run in runs)
    return AttitudeMap(soil=names, course_deg=courses, slope_deg=slopes, status=status, **numbers)
