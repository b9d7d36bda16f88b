"""A run of a rover from its start to its end."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import NDArray

from . import _core, _tables
from ._animations import Animation
from ._arrays import Floats, whole_number
from ._descriptions import Mission, Scenario, Soil, Source
from ._errors import ParameterError
from ._gradients import Gradient, Keys, keys_of, of_rows
from ._models import ByModel, each_model

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes


def columns_of(result: Any, names: Iterable[str]) -> dict[str, Any]:
    return {name: getattr(result, name) for name in names}


#: Fields of a `Trajectory` over time, and of a `Rollout` over runs.
SAMPLE = _tables.COLUMNS["sample"]
#: Those beside them on ground with heights.
_STANDING = _tables.COLUMNS["standing"]


def standing_of(result: Any) -> dict[str, Any]:
    """How a rover stands on ground with heights; empty on a plane."""
    return {} if result.z_m is None else columns_of(result, _STANDING)


@dataclass(frozen=True, eq=False)
class TraverseBand(_tables.Band):
    """A run over samples of soil and model: arrays of shape (times,).

    ``…_p2_5``, ``…_p50`` and ``…_p97_5`` are quantiles over the samples: 95 % of the values lie
    between the first and the last. From the time at which its rover gets stuck a sample counts as
    slip 1, sunk to the axles, at the place where it ended; one whose run ends early otherwise leaves
    the band then, as `grouser.OUTCOMES` says.

    Examples
    --------
    >>> import grouser as gr
    >>> band = gr.simulate(duration_s=2.0, uncertainty=True, samples=10).band
    >>> width_m = band.y_m_p97_5 - band.y_m_p2_5                    # how uncertain the drift is
    >>> bool(width_m[-1] > width_m[0])
    True
    """

    run: Mapping[str, Any]
    """The same of the end of the run and of its means, the probability that it is completed, and
    how many samples end early, by their names in the program's ``band``."""
    time_s: Floats
    """Time [s]."""
    x_m_p2_5: Floats
    """Along the contour [m]."""
    x_m_p50: Floats
    """Its median [m]."""
    x_m_p97_5: Floats
    """Its upper end [m]."""
    y_m_p2_5: Floats
    """Uphill [m]."""
    y_m_p50: Floats
    """Its median [m]."""
    y_m_p97_5: Floats
    """Its upper end [m]."""
    yaw_deg_p2_5: Floats
    """Yaw [°], positive where the nose points uphill."""
    yaw_deg_p50: Floats
    """Its median [°]."""
    yaw_deg_p97_5: Floats
    """Its upper end [°]."""
    slip_ratio_p2_5: Floats
    """Mean slip ratio of the wheels [-]."""
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
    energy_j_p2_5: Floats
    """Work of the motors so far [J]."""
    energy_j_p50: Floats
    """Its median [J]."""
    energy_j_p97_5: Floats
    """Its upper end [J]."""
    draws_in_band: Floats
    """Samples that are in the band."""
    share_ended_early: Floats
    """Share of all samples that ended early [-]."""
    ended_early: NDArray[np.object_]
    """How these ended, with the share of each way; None where none did."""
    model_weights: Mapping[str, float]
    """The share of the samples that each wheel–soil model computes [-]."""
    z_m_p2_5: Floats | Any = None
    """Height of the body's centre of mass [m]; None on a plane."""
    z_m_p50: Floats | Any = None
    """Its median [m]."""
    z_m_p97_5: Floats | Any = None
    """Its upper end [m]."""
    roll_deg_p2_5: Floats | Any = None
    """Roll [°], positive with the right side down; None on a plane."""
    roll_deg_p50: Floats | Any = None
    """Its median [°]."""
    roll_deg_p97_5: Floats | Any = None
    """Its upper end [°]."""
    pitch_deg_p2_5: Floats | Any = None
    """Pitch [°], positive with the nose up; None on a plane."""
    pitch_deg_p50: Floats | Any = None
    """Its median [°]."""
    pitch_deg_p97_5: Floats | Any = None
    """Its upper end [°]."""

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each time."""
        return _tables.frame(self._table())

    def __repr__(self) -> str:
        return f"<TraverseBand over {self.run['draws']} samples, {len(self.time_s)} times>"


@dataclass(frozen=True, eq=False)
class Trajectory(_tables.Tabular):
    """Outcome and records over time of a run: arrays of shape (records,). Positions are in the
    slope frame (x along the contour, y uphill), on ground with heights in that of the map (x east,
    y north, z up); speeds are in the body frame (x forward, y left).

    ``wheel`` has arrays of shape (records, wheels) by name: ``slip_ratio``, ``slip_angle_deg``,
    ``load_n``, ``wheel_speed_rad_s``, ``power_w`` and the fields of `WheelForces`; NaN where the
    rover has just tipped over or sunk. Of a rover with motors it has ``current_a``, ``voltage_v``,
    ``electrical_power_w`` and ``winding_temperature_degc``, too (NaN where no winding is known), of
    one whose wheels are steered ``steering_deg``.

    Examples
    --------
    >>> import grouser as gr
    >>> run = gr.simulate(slope_deg=10.0, duration_s=5.0)
    >>> run.wheel["slip_ratio"].shape == (len(run.time_s), len(run.wheel_names))
    True
    >>> end = run.to_xarray().isel(time_s=-1)
    >>> bool(end.y_m < 0.0), end.y_m.units                          # drifted downhill
    (True, 'm')
    >>> slip = end.wheel_slip_ratio.sel(wheel="front-left")
    >>> bool(slip == run.wheel["slip_ratio"][-1, run.wheel_names.index("front-left")])
    True
    """

    scenario: Scenario
    """The scenario of the run; of a `mission` its rover, ground, model and start."""
    outcome: str
    """What became of the rover: a name of `grouser.OUTCOMES`; a mission that a limit ended counts as
    completed here."""
    message: str | None
    """The outcome explained; None for a completed run."""
    simulation: str
    """``dynamic``, ``quasi-steady``, or ``fell-back`` from the second to the first."""
    simulation_message: str | None
    """Time and reason of the fallback."""
    flags: NDArray[np.object_]
    """Why each record is an extrapolation: names of `FLAGS`, joined by ``;``; shape (records,)."""
    flags_raised: Mapping[str, float]
    """Each flag of the run, with the time at which it was raised first [s]."""
    energy_error_j: float
    """Error of the energy balance [J]."""
    wheel_names: tuple[str, ...]
    """The wheels, in the order of their mounts."""
    wheel: Mapping[str, Floats]
    """Arrays of shape (records, wheels), by name."""
    time_s: Floats
    """Time [s]."""
    x_m: Floats
    """Of the body's centre of mass: along the contour, or on a map [m]."""
    y_m: Floats
    """Uphill, or on a map [m]."""
    yaw_deg: Floats
    """Yaw [°], positive where the nose points uphill; on a map from its x axis, to the left."""
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
    z_m: Floats | Any = None
    """Height of the body's centre of mass [m]; None on a plane."""
    roll_deg: Floats | Any = None
    """Roll, positive with the right side down [°]; None on a plane."""
    pitch_deg: Floats | Any = None
    """Pitch, positive with the nose up [°]; None on a plane."""
    stability_margin_deg: Floats | Any = None
    """Force-angle margin: by how much the weight's direction may turn before the rover tips over [°];
    None on a plane."""
    belly_clearance_m: Floats | Any = None
    """Least height of the body's underside over the ground, where its belly clearance is given [m];
    NaN elsewhere, None on a plane."""
    electrical: Mapping[str, Floats] = field(default_factory=dict)
    """``electrical_power_w`` [W] of all motors, ``battery_energy_j`` [J] of motors and electronics,
    and of the battery ``battery_voltage_v`` [V], ``battery_current_a`` [A] and
    ``state_of_charge`` [-], NaN where it is not known: arrays of shape (records,); empty where no
    motor is known."""
    band: TraverseBand | Any = None
    """The same over samples of soil and model, with ``uncertainty=True``; else None."""
    gradient: Gradient | Any = None
    """Derivatives of the records, with a last axis of keys, where `simulate` was asked for
    ``gradients``; else None. They are differences of whole runs."""
    mission: Mission | Any = None
    """The mission that was driven; None for a run of `simulate`."""
    alternative: str = ""
    """The alternative of the mission; empty where there are none."""

    def _table(self) -> dict[str, Any]:
        columns: dict[str, Any] = {
            **columns_of(self, SAMPLE),
            **standing_of(self),
            **self.electrical,
            "flags": self.flags,
        }
        for k, name in enumerate(self.wheel_names):
            columns |= {f"{name}.{key}": values[:, k] for key, values in self.wheel.items()}
        return columns

    def _notes(self) -> dict[str, str]:
        notes = {"outcome": self.outcome}
        if self.mission is None:
            notes["scenario"] = self.scenario.to_toml()
        else:
            notes |= {"mission": self.mission.to_toml(), "alternative": self.alternative}
        return notes if self.message is None else {**notes, "message": self.message}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each record; columns of a wheel start with its name, as in
        ``front-left.slip_ratio``, as the program's CSV has them."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``time_s``, and over ``time_s`` and ``wheel`` for the wheels, whose
        names start with ``wheel_``. Units are in the attributes."""
        rover = {**columns_of(self, SAMPLE[1:]), **standing_of(self), **self.electrical}
        data = _tables.dataset(("time_s",), rover, {"time_s": self.time_s})
        for name, values in self.wheel.items():
            longer = name if name.startswith("wheel_") else f"wheel_{name}"
            data[longer] = _tables.variable(("time_s", "wheel"), name, values)
        data = data.assign_coords(wheel=list(self.wheel_names))
        return data.assign_attrs(self._notes())

    def plot(self, axes: Axes | None = None, **style: Any) -> Axes:
        """Plots the path on the slope, or on the map, seen from above.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        **style
            Arguments of ``Axes.plot``.
        """
        axes = _tables.axes_or_new(axes)
        axes.plot(self.x_m, self.y_m, **{"label": self.outcome, **style})
        on_plane = self.z_m is None
        axes.set_xlabel("along the contour, x [m]" if on_plane else "east, x [m]")
        axes.set_ylabel("uphill, y [m]" if on_plane else "north, y [m]")
        return axes

    def animate(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        beside: Sequence[Trajectory] = (),
        names: Sequence[str] | None = None,
    ) -> Animation:
        """Draws the run: the rover on its slope, with turning wheels, tracks, forces and numbers; over
        ground with heights from above, obliquely and cut along its way.

        Parameters
        ----------
        path : path, optional
            A file to write: ``.gif``, ``.mp4`` (by an installed ffmpeg), ``.html`` (with a player)
            or ``.glb`` (glTF 2.0) for the run, ``.svg`` or ``.png`` for its end. A file that is
            there already is replaced.
        beside : sequence of Trajectory, optional
            Other runs, each on a lane of its own, or over ground with heights in a view of its own.
        names : sequence of str, optional
            What the runs are called; by default their outcomes.

        Returns
        -------
        Animation
            In a notebook, a player.

        Examples
        --------
        >>> import grouser as gr
        >>> straight, turned = (
        ...     gr.simulate(slope_deg=15.0, duration_s=1.0, start={"yaw_deg": yaw})
        ...     for yaw in (0.0, 9.56)
        ... )
        >>> straight.animate(beside=[turned], names=["straight", "turned uphill"])
        <Animation of straight, turned uphill>
        """
        runs = (self, *beside)
        called = [run.outcome for run in runs] if names is None else names
        sources = [(run.mission or run.scenario, run.alternative) for run in runs]
        animation = Animation(sources, called)
        if path is not None:
            animation.save(path)
        return animation

    def __repr__(self) -> str:
        end = {name: float(getattr(self, name)[-1]) for name in ("time_s", "x_m", "y_m", "yaw_deg")}
        state = ", ".join(f"{name}={value:.4g}" for name, value in end.items())
        return f"<Trajectory {self.outcome}: {state}>"


@overload
def simulate(
    scenario: Scenario | Source | None = None,
    /,
    *,
    model: Literal["all"],
    uncertainty: bool = ...,
    samples: int = ...,
    seed: int = ...,
    gradients: Keys | None = ...,
    **changes: Any,
) -> ByModel[Trajectory]: ...


@overload
def simulate(
    scenario: Scenario | Source | None = None,
    /,
    *,
    model: str | None = ...,
    uncertainty: bool = ...,
    samples: int = ...,
    seed: int = ...,
    gradients: Keys | None = ...,
    **changes: Any,
) -> Trajectory: ...


def simulate(
    scenario: Scenario | Source | None = None,
    /,
    *,
    model: str | None = None,
    uncertainty: bool = False,
    samples: int = 200,
    seed: int = 1,
    gradients: Keys | None = None,
    **changes: Any,
) -> Trajectory | ByModel[Trajectory]:
    """Simulates a rover from its start to its end.

    Results are reproducible bit for bit, here and in the program's ``grouser traverse``.

    Parameters
    ----------
    scenario : Scenario, name, path or mapping, optional
        The scenario; by default the source paper's traverse.
    model : str, optional
        The wheel–soil model, or ``"all"`` for the results of each; by default that of the scenario
        or of its soil.
    uncertainty : bool
        Whether to sample what is uncertain, for `Trajectory.band`: the soil, where its document
        says so, and the wheel–soil model, where none is asked for by ``model``.
    samples : int
        Number of samples, 2 to 100000.
    seed : int
        Seed of the samples: the same seed gives the same soils and models.
    gradients : str or sequence of str, optional
        Keys of scenarios by whose numbers the records are differentiated, or ``"all"``: as
        `Trajectory.gradient`, by two to four more runs for each key. They are those of the run as
        its documents are written.
    **changes
        Keys of the scenario with other values: ``slope_deg=15.0``, ``soil="toyoura"``.

    Returns
    -------
    Trajectory
        Or `ByModel` of them, for all models.

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `Scenario`.
    SimulationError
        If the run cannot be computed. A rover that gets stuck is an outcome, not an error.

    Examples
    --------
    >>> import grouser as gr
    >>> run = gr.simulate(slope_deg=10.0, duration_s=5.0)
    >>> run.outcome, bool(run.y_m[-1] < 0.0)
    ('completed', True)
    >>> run = gr.simulate(slope_deg=10.0, duration_s=5.0, gradients=["slope_deg"])
    >>> by_slope = run.gradient.to_xarray(["time_s"]).y_m.sel(key="slope_deg")
    >>> by_slope.dims, bool(by_slope[-1] < 0.0)                     # the steeper, the lower
    (('time_s',), True)
    """
    if uncertainty and gradients is not None:
        raise ParameterError(
            "gradients are of the run as its documents are written, uncertainty=True asks for "
            "samples: leave one of them out",
            "gradients",
        )
    if model == "all":
        settings: dict[str, Any] = {
            "uncertainty": uncertainty, "samples": samples, "seed": seed, "gradients": gradients
        }
        return each_model(lambda name: simulate(scenario, model=name, **settings, **changes))
    changes = changes if model is None else {**changes, "model": model}
    run = scenario_of(scenario, changes)
    found = _core.simulate(run._document, keys_of(gradients))
    band = None
    if uncertainty:
        drawn = whole_number("seed", seed), whole_number("samples", samples, most=2**32 - 1)
        times, means = _core.simulate_band(run._document, *drawn)
        times["ended_early"] = np.array(times["ended_early"], dtype=object)
        band = TraverseBand(run=means, **times)
    rows: Any = found.get("gradient")
    gradient = None
    if rows is not None:
        values, one_sided, keys, names = rows
        gradient = of_rows(values, one_sided, keys, names, (len(found["flags"]),))
    return trajectory_of(found, scenario=run, band=band, gradient=gradient)


def trajectory_of(found: Mapping[str, Any], **inputs: Any) -> Trajectory:
    """What the native half has found.

    Parameters
    ----------
    **inputs
        The other fields.
    """
    return Trajectory(
        outcome=found["outcome"],
        message=found["reason"],
        simulation=found["simulation"],
        simulation_message=found["simulation_reason"],
        flags=np.array(found["flags"], dtype=object),
        flags_raised=dict(found["flags_raised"]),
        energy_error_j=found["energy_error_j"],
        wheel_names=tuple(found["wheels"]),
        wheel=found["each_wheel"],
        electrical=found["electrical"],
        **found["rover"],
        **inputs,
    )


def scenario_of(scenario: Any, changes: dict[str, Any]) -> Scenario:
    if isinstance(scenario, Scenario) and not changes:
        return scenario
    return Scenario(scenario, **changes)


def soil_of(soil: Any) -> Soil:
    return soil if isinstance(soil, Soil) else Soil(soil)
