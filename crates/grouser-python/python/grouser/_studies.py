"""Studies: what a rover does, which yaw keeps it level, what a test stand shows."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._descriptions import Scenario, Soil, Source, Wheel
from ._errors import ParameterError
from ._wheels import Floats, Settled, number, numbers, settle

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes


def _columns(result: Any, names: Iterable[str]) -> dict[str, Any]:
    return {name: getattr(result, name) for name in names}


#: Fields of a `Trajectory` over time, and of a `Rollout` over runs.
_SAMPLE = (
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
        columns = _columns(self, _SAMPLE)
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
        rover = _columns(self, _SAMPLE[1:])
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
    run = _scenario(scenario, changes)
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
class Rollout(_tables.Tabular):
    """The ends of many runs: arrays of shape (runs,), in the scenarios' order; NaN where a run could
    not be computed. Frames are those of a `Trajectory`."""

    outcome: NDArray[np.str_]
    """Each run's outcome; ``failed`` where it could not be computed."""
    message: NDArray[np.object_]
    """What that means; None for a completed run."""
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

    def __len__(self) -> int:
        return len(self.outcome)

    def _table(self) -> dict[str, Any]:
        return {"outcome": self.outcome, "message": self.message, **_columns(self, _SAMPLE)}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each run."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``run`` with units in the attributes."""
        return _tables.dataset(("run",), self._table(), {"run": np.arange(len(self))})

    def plot(self, axes: Axes | None = None, **style: Any) -> Axes:
        """Draws where the runs ended, seen from above."""
        axes = _tables.axes_or_new(axes)
        axes.plot(self.x_m, self.y_m, **{"ls": "", "marker": ".", **style})
        axes.set_xlabel("along the contour, x [m]")
        axes.set_ylabel("uphill, y [m]")
        return axes

    def __repr__(self) -> str:
        words, counts = np.unique(self.outcome, return_counts=True)
        told = ", ".join(f"{count} {word}" for word, count in zip(words, counts))
        return f"<Rollout of {len(self)} runs: {told}>"


def rollout(scenarios: Iterable[Scenario | Source]) -> Rollout:
    """Runs many scenarios at once, on all cores, without Python's lock.

    Results keep the order of the scenarios and have the same bits for any number of cores.

    Parameters
    ----------
    scenarios : iterable of Scenario, names, paths or mappings
        What to run.

    Returns
    -------
    Rollout

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `Scenario`. A run that cannot be computed is told as ``failed``, and the others go on.
    """
    if isinstance(scenarios, (str, Scenario)):
        raise ParameterError("scenarios is one scenario, it must be several", "scenarios")
    runs = [_scenario(one, {}) for one in scenarios]
    found = _core.rollout([run._document for run in runs])
    outcome = np.array(found.pop("outcome"), dtype=np.str_)
    message = np.array(found.pop("reason"), dtype=object)
    return Rollout(outcome=outcome, message=message, **found)


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

    def _table(self) -> dict[str, Any]:
        return {**_columns(self, ("slope_deg", *_ATTITUDE)), "status": self.status}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each slope."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``slope_deg`` with units in the attributes."""
        columns = self._table()
        coords = {"slope_deg": columns.pop("slope_deg")}
        return _tables.dataset(("slope_deg",), columns, coords)

    def plot(self, axes: Axes | None = None, **style: Any) -> Axes:
        """Draws the yaw over the slope."""
        axes = _tables.axes_or_new(axes)
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
    **changes: Any,
) -> Attitudes:
    """The yaw that keeps a traverse level, on each slope ([FourWheel], Fig. 10).

    Parameters
    ----------
    scenario : Scenario, name, path or mapping, optional
        Its rover, soil, gravity, model, loads and moments count; not its slope, drive or start.
    slope_deg : array_like, shape (slopes,)
        Slopes [°], 0 to 60.
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
    """
    slopes, run = _line("slope_deg", slope_deg), _scenario(scenario, changes)
    found, limit, reason = _core.attitude(run._document, slopes)
    status = np.array(found.pop("status", []), dtype=object)
    # Without slopes there are no rows to tell the columns.
    columns = {name: found.get(name, np.empty(0)) for name in ("slope_deg", *_ATTITUDE)}
    return Attitudes(limit_slope_deg=limit, limit_message=reason, status=status, **columns)


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
        return {**_columns(self, names), "status": self.status}

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
    one = _scenario(scenario, changes)
    several = isinstance(soil, Sequence) and not isinstance(soil, str)
    soils: list[Any] = list(soil) if several else [soil]  # type: ignore[arg-type]
    if not soils:
        raise ParameterError("soil is empty, it must be at least one", "soil")
    runs = [one if it is None else one.replace(soil=_soil(it)) for it in soils]
    slopes, courses = _line("slope_deg", slope_deg), _line("course_deg", course_deg)
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


@dataclass(frozen=True, eq=False)
class WheelTest(_tables.Tabular):
    """A wheel test: every load with every slip angle and every slip ratio."""

    load_n: Floats
    """Loads [N], shape (loads,)."""
    slip_angle_deg: Floats
    """Slip angles [°], shape (angles,)."""
    slip_ratio: Floats
    """Slip ratios [-], shape (ratios,)."""
    wheels: Settled
    """What the wheel did; fields of shape (loads, angles, ratios)."""

    def _table(self) -> dict[str, Any]:
        return {**self.wheels._table(), "status": self.wheels.messages}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each setting, slip ratios fastest, as the program has it."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``load_n``, ``slip_angle_deg`` and ``slip_ratio``; units in the attributes."""
        coords = {name: getattr(self, name) for name in ("load_n", "slip_angle_deg", "slip_ratio")}
        columns = {k: v for k, v in self.wheels._table().items() if k not in coords}
        return _tables.dataset(tuple(coords), columns, coords)

    def plot(self, axes: Axes | None = None, *, name: str = "drawbar_pull_n", **style: Any) -> Axes:
        """Draws a quantity over the slip ratio, a line for each load and slip angle."""
        axes = _tables.axes_or_new(axes)
        values = getattr(self.wheels, name)
        for i, load in enumerate(self.load_n):
            for j, angle in enumerate(self.slip_angle_deg):
                axes.plot(
                    self.slip_ratio, values[i, j], **{"label": f"{load:g} N, {angle:g}°", **style}
                )
        axes.set_xlabel("slip ratio")
        axes.set_ylabel(_tables.label(name))
        axes.legend()
        return axes

    def __repr__(self) -> str:
        return f"<WheelTest of {' × '.join(map(str, self.wheels.shape))} loads, angles, ratios>"


def wheel_test(
    soil: Soil | Source = "toyoura",
    wheel: Wheel | Source = "hakuto",
    *,
    load_n: ArrayLike,
    slip_ratio: ArrayLike,
    slip_angle_deg: ArrayLike = 0.0,
    gravity_m_s2: float = _core.EARTH_GRAVITY,
    model: str | None = None,
) -> WheelTest:
    """A wheel on a test stand: every load with every slip angle and every slip ratio
    ([FourWheel], section 4 and Fig. 7).

    Parameters
    ----------
    soil, wheel, gravity_m_s2, model
        As for `settle`; one soil.
    load_n : array_like, shape (loads,)
        Loads [N], 0 to 1e5.
    slip_ratio : array_like, shape (ratios,)
        Slip ratios [-], −2 to 2.
    slip_angle_deg : array_like, shape (angles,)
        Slip angles [°], −90 to 90.

    Returns
    -------
    WheelTest

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `settle`.
    """
    loads, angles = _line("load_n", load_n), _line("slip_angle_deg", slip_angle_deg)
    ratios = _line("slip_ratio", slip_ratio)
    wheels = settle(
        _soil(soil),
        wheel,
        load_n=loads[:, None, None],
        slip_angle_deg=angles[:, None],
        slip_ratio=ratios,
        gravity_m_s2=gravity_m_s2,
        model=model,
    )
    return WheelTest(load_n=loads, slip_angle_deg=angles, slip_ratio=ratios, wheels=wheels)


def _scenario(scenario: Any, changes: dict[str, Any]) -> Scenario:
    if isinstance(scenario, Scenario) and not changes:
        return scenario
    return Scenario(scenario, **changes)


def _soil(soil: Any) -> Soil:
    return soil if isinstance(soil, Soil) else Soil(soil)


def _line(name: str, values: ArrayLike) -> Floats:
    """Numbers in a row; one number is a row of one."""
    array = numbers(name, values)
    if array.ndim > 1:
        raise ParameterError(f"{name} has shape {array.shape}, it must be one row", name)
    return np.ascontiguousarray(np.atleast_1d(array))
