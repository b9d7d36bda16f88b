"""What a rover does, and which yaw keeps it level."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._attitude_band import AttitudeBand
from ._descriptions import Scenario, Soil, Source
from ._errors import ParameterError
from ._wheels import Floats, number, numbers, whole_number

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes


def columns_of(result: Any, names: Iterable[str]) -> dict[str, Any]:
    return {name: getattr(result, name) for name in names}


#: Fields of a `Trajectory` over time, and of a `Rollout` over runs.
SAMPLE = (
    "time_s",
    "x_m",
    "y_m",
    "yaw_deg",
    "forward_speed_m_s",
    "lateral_speed_m_s",
    "yaw_rate_deg_s",
    "power_w",
    "energy_j",
    "soil_energy_j",
    "kinetic_energy_j",
    "potential_energy_j",
)
#: Fields of `Attitudes`, and of an `AttitudeMap`.
_ATTITUDE = ("yaw_deg", "slip_ratio", "sinkage_mm", "torque_nm", "energy_j_per_m", "yaw_moment_nm")


@dataclass(frozen=True, eq=False)
class Trajectory(_tables.Tabular):
    """A run: what became of the rover, and its samples: arrays of shape (samples,). Positions are in
    the slope frame (x along the contour, y uphill), speeds in the body frame (x forward, y left).

    ``wheel`` has arrays of shape (samples, wheels) by name: ``slip_ratio``, ``slip_angle_deg``,
    ``load_n``, ``wheel_speed_rad_s``, ``power_w`` and the fields of `WheelForces`; NaN where the
    rover has just tipped over or sunk.
    """

    scenario: Scenario
    """What was run."""
    outcome: str
    """``completed``, ``immobilised``, ``sliding`` or ``tipped_over``."""
    message: str | None
    """What that means here; None for a completed run."""
    simulation: str
    """``dynamic``, ``quasi-steady``, or ``fell-back`` from the second to the first."""
    simulation_message: str | None
    """Since when and why it fell back."""
    energy_error_j: float
    """What the energy books cannot account for [J]."""
    wheel_names: tuple[str, ...]
    """The wheels, in the order of their mounts."""
    wheel: Mapping[str, Floats]
    """Arrays of shape (samples, wheels), by name."""
    time_s: Floats
    """Time [s]."""
    x_m: Floats
    """Along the contour [m], of the body's centre of mass."""
    y_m: Floats
    """Uphill [m]."""
    yaw_deg: Floats
    """Yaw [°], positive where the nose points uphill."""
    forward_speed_m_s: Floats
    """Speed along the body [m/s]."""
    lateral_speed_m_s: Floats
    """Speed across the body [m/s], positive to the left."""
    yaw_rate_deg_s: Floats
    """Yaw rate [°/s]."""
    power_w: Floats
    """Power of all motors [W]."""
    energy_j: Floats
    """Work of the motors so far [J]."""
    soil_energy_j: Floats
    """Work done on the soil so far [J]."""
    kinetic_energy_j: Floats
    """Kinetic energy [J]."""
    potential_energy_j: Floats
    """Potential energy, zero at the start's height [J]."""

    def _table(self) -> dict[str, Any]:
        columns = columns_of(self, SAMPLE)
        for k, name in enumerate(self.wheel_names):
            columns |= {f"{name}.{key}": values[:, k] for key, values in self.wheel.items()}
        return columns

    def _notes(self) -> dict[str, str]:
        notes = {"outcome": self.outcome, "scenario": self.scenario.to_toml()}
        return notes if self.message is None else {**notes, "message": self.message}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each sample; columns of a wheel start with its name, as in
        ``front-left.slip_ratio``, as the program's CSV has them."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``time_s``, and over ``time_s`` and ``wheel`` for what each wheel has; the
        latter's names start with ``wheel_``. Units stand in the attributes."""
        rover = columns_of(self, SAMPLE[1:])
        data = _tables.dataset(("time_s",), rover, {"time_s": self.time_s})
        for name, values in self.wheel.items():
            longer = name if name.startswith("wheel_") else f"wheel_{name}"
            data[longer] = _tables.variable(("time_s", "wheel"), name, values)
        data = data.assign_coords(wheel=list(self.wheel_names))
        return data.assign_attrs(self._notes())

    def plot(self, axes: Axes | None = None, **style: Any) -> Axes:
        """Draws the path on the slope, seen from above.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Where; a new figure without.
        **style
            For ``Axes.plot``.
        """
        axes = _tables.axes_or_new(axes)
        axes.plot(self.x_m, self.y_m, **{"label": self.outcome, **style})
        axes.set_xlabel("along the contour, x [m]")
        axes.set_ylabel("uphill, y [m]")
        return axes

    def __repr__(self) -> str:
        end = {name: float(getattr(self, name)[-1]) for name in ("time_s", "x_m", "y_m", "yaw_deg")}
        words = ", ".join(f"{name}={value:.4g}" for name, value in end.items())
        return f"<Trajectory {self.outcome}: {words}>"


def simulate(scenario: Scenario | Source | None = None, /, **changes: Any) -> Trajectory:
    """Runs a rover from its start to its end.

    The same scenario gives the same bits, here and in the program's ``grouser traverse``.

    Parameters
    ----------
    scenario : Scenario, name, path or mapping, optional
        What to run; the source paper's traverse without.
    **changes
        Keys of the scenario with other values: ``slope_deg=15.0``, ``soil="toyoura"``.

    Returns
    -------
    Trajectory

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `Scenario`.
    SimulationError
        If the run cannot be computed. What a rover does, such as getting stuck, is an outcome.

    Examples
    --------
    >>> import grouser as gr
    >>> run = gr.simulate(slope_deg=10.0, duration_s=5.0)
    >>> run.outcome, bool(run.y_m[-1] < 0.0)
    ('completed', True)
    """
    run = scenario_of(scenario, changes)
    found = _core.simulate(run._document)
    return Trajectory(
        scenario=run,
        outcome=found["outcome"],
        message=found["reason"],
        simulation=found["simulation"],
        simulation_message=found["simulation_reason"],
        energy_error_j=found["energy_error_j"],
        wheel_names=tuple(found["wheels"]),
        wheel=found["each_wheel"],
        **found["rover"],
    )


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
        band = {} if self.band is None else self.band._columns()
        return {**columns_of(self, ("slope_deg", *_ATTITUDE)), "status": self.status, **band}

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
    status = np.array(found.pop("status", []), dtype=object)
    # Without slopes there are no rows to tell the columns.
    columns = {name: found.get(name, np.empty(0)) for name in ("slope_deg", *_ATTITUDE)}
    return Attitudes(
        limit_slope_deg=limit, limit_message=reason, status=status, band=band, **columns
    )


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
        names = (*_ATTITUDE, "power_w", "limit_slope_deg")
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
    # Without slopes or courses there are no rows to tell the columns.
    numbers = {
        name: np.asarray(found.get(name, np.empty(0)), dtype=np.float64).reshape(shape)
        for name in (*_ATTITUDE, "power_w", "limit_slope_deg")
    }
    status = np.array(found.get("status", []), dtype=object).reshape(shape)
    names = tuple(run.soil.name for run in runs)
    return AttitudeMap(soil=names, course_deg=courses, slope_deg=slopes, status=status, **numbers)


def scenario_of(scenario: Any, changes: dict[str, Any]) -> Scenario:
    if isinstance(scenario, Scenario) and not changes:
        return scenario
    return Scenario(scenario, **changes)


def soil_of(soil: Any) -> Soil:
    return soil if isinstance(soil, Soil) else Soil(soil)


def line(name: str, values: ArrayLike) -> Floats:
    """Numbers in a row; one number is a row of one."""
    array = numbers(name, values)
    if array.ndim > 1:
        raise ParameterError(f"{name} has shape {array.shape}, it must be one row", name)
    return np.ascontiguousarray(np.atleast_1d(array))
