"""Many runs in one call."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._arrays import Floats, broadcast, varied
from ._cells import cells_of, documents_of, labels_of
from ._descriptions import Scenario, Source
from ._errors import ParameterError
from ._gradients import Gradient, Keys, keys_of, of_rows
from ._studies import SAMPLE, columns_of, scenario_of, standing_of
from ._sweeps import Vary
from ._wheels import Outside, outside_is_nan, Soils, names_of, soils_of

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False)
class Rollout(_tables.Entries):
    """Final states of many runs: arrays of the shape to which the arguments broadcast, (runs,) for
    a sequence of scenarios; NaN where a run could not be computed. Frames are those of a
    `Trajectory`.

    Examples
    --------
    >>> import grouser as gr
    >>> ends = gr.rollout(gr.Scenario(simulation="quasi-steady"), slope_deg=[5.0, 10.0, 15.0])
    >>> ends.shape, ends.outcome.tolist()
    ((3,), ['completed', 'completed', 'completed'])
    >>> uphill = ends.to_xarray(dims=["slope_deg"]).y_m
    >>> bool(uphill.sel(slope_deg=15.0) == ends.y_m[2])
    True
    """

    outcome: NDArray[np.str_]
    """Each run's outcome; ``failed`` where it could not be computed, and where an input is NaN."""
    message: NDArray[np.object_]
    """The outcome explained; None for a completed run."""
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
    """Height of the body's centre of mass [m];
    None where all runs are on planes."""
    roll_deg: Floats | Any = None
    """Roll, positive with the right side down [°];
    None where all runs are on planes."""
    pitch_deg: Floats | Any = None
    """Pitch, positive with the nose up [°];
    None where all runs are on planes."""
    stability_margin_deg: Floats | Any = None
    """Force-angle margin: by how much the weight's direction may turn before the rover tips over [°];
    None where all runs are on planes."""
    belly_clearance_m: Floats | Any = None
    """Least height of the body's underside over the ground, where its belly clearance is given [m];
    NaN elsewhere, None where all runs are on planes."""

    records: Mapping[str, Floats] | Any = None
    """With ``trajectories=True``, the records over time of each run by name (``time_s`` and the
    fields after it): arrays with one dimension more, NaN after a run's end."""
    gradient: Gradient | Any = None
    """Derivatives of the final states, with a last axis of keys, where ``rollout`` was asked for
    ``gradients``; else None. They are differences of whole runs."""
    inputs: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    """What was asked, by name: arrays as given, which broadcast to `shape`. ``scenario`` counts the
    scenarios, if there were several; soils have their names; the yaw at the start is
    ``start.yaw_deg``."""

    _DIM: ClassVar[str] = "run"

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of every field."""
        return self.outcome.shape

    def _docs(self) -> Mapping[str, str]:
        return _tables.DOCS["sample"]

    def _results(self) -> dict[str, Any]:
        ends = {**columns_of(self, SAMPLE), **standing_of(self)}
        return {"outcome": self.outcome, "message": self.message, **ends}

    def to_xarray(self, dims: Sequence[str] | None = None) -> xarray.Dataset:
        """A dataset with units in the attributes; records have names that start with ``sample_``.
        Inputs are coordinates, each over the dimensions along which it was given: with
        ``dims=["slope_deg", "start.yaw_deg"]`` slopes and yaws index the dimensions of their names.

        Parameters
        ----------
        dims : sequence of str, optional
            Names of the dimensions; by default ``run``, or ``dim_0``, ``dim_1`` … for several.
        """
        data = super().to_xarray(dims)
        names = tuple(map(str, data["outcome"].dims))
        for name, values in (self.records or {}).items():
            data[f"sample_{name}"] = _tables.variable((*names, "sample"), name, values)
        return data

    def plot(self, axes: Axes | None = None, **style: Any) -> Axes:
        """Plots the final positions, seen from above, and the paths with ``trajectories=True``.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        **style
            Arguments of the drawing functions of matplotlib.
        """
        axes = _tables.axes_or_new(axes)
        if self.records is not None:
            count = self.records["x_m"].shape[-1]
            paths = (self.records[name].reshape(-1, count).T for name in ("x_m", "y_m"))
            axes.plot(*paths, color="grey", lw=0.5)
        axes.plot(self.x_m.ravel(), self.y_m.ravel(), **{"ls": "", "marker": ".", **style})
        axes.set_xlabel("along the contour, x [m]")
        axes.set_ylabel("uphill, y [m]")
        return axes

    def __repr__(self) -> str:
        names, counts = np.unique(self.outcome, return_counts=True)
        ended = ", ".join(f"{count} {name}" for name, count in zip(names, counts))
        return f"<Rollout of {len(self)} runs: {ended}>"


def rollout(
    scenarios: Scenario | Source | Iterable[Scenario | Source] | None = None,
    /,
    *,
    soil: Soils | None = None,
    slope_deg: ArrayLike | None = None,
    yaw_deg: ArrayLike | None = None,
    rim_speed_m_s: ArrayLike | None = None,
    gravity_m_s2: ArrayLike | None = None,
    duration_s: ArrayLike | None = None,
    vary: Vary | None = None,
    trajectories: bool = False,
    gradients: Keys | None = None,
    outside: Outside = "raise",
) -> Rollout:
    """Runs many scenarios at once, on all cores, without Python's lock.

    The arguments broadcast against each other as those of `settle` do; a value that is not given is
    the scenario's own. Runs that differ in these keys alone need no description each, which is far
    cheaper. They keep their order, and each has the same results as alone, for any number of cores.

    Parameters
    ----------
    scenarios : Scenario, name, path, mapping, or a sequence of them, optional
        The scenarios; by default the source paper's traverse. A sequence broadcasts as an array of
        shape (runs,).
    soil : Soil, name, path, mapping, or a sequence of them, optional
        Instead of the scenarios' own, with its own wheel–soil model where they do not name one.
    slope_deg : array_like, optional
        Slopes [°], 0 to 60.
    yaw_deg : array_like, optional
        Yaws at the start [°], −180 to 180, positive where the nose points uphill.
    rim_speed_m_s : array_like, optional
        Speeds of all rims [m/s], −10 to 10; under Eq. 18 the desired speeds over the ground.
    gravity_m_s2 : array_like, optional
        Gravities [m/s²], 0.01 to 30.
    duration_s : array_like, optional
        Durations of the runs [s], above 0, to 86400.
    vary : mapping of str to array_like, optional
        Other numbers of the scenario by their keys, as ``soil.cohesion_kpa`` or
        ``rover.body.mass_kg``, words such as ``model``, and rovers: they broadcast with the other
        arguments.
    trajectories : bool
        Whether to keep the records over time, as `Rollout.records`.
    gradients : str or sequence of str, optional
        Keys of scenarios by whose numbers the final states are differentiated, or ``"all"``: as
        `Rollout.gradient`, by two to four more runs for each key.
    outside : {"raise", "nan"}
        With ``"nan"`` a run with a number out of its range (`range_of`), or with numbers that do
        not go together, has the outcome ``failed`` and a `Rollout.message`; by default it is an
        error.

    Returns
    -------
    Rollout
        A run with an input that is NaN has the outcome ``failed``, and NaN for all results.

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `Scenario`, and for shapes that do not broadcast. A run that cannot be computed has the
        outcome ``failed``, and the others continue.

    Examples
    --------
    >>> import numpy as np
    >>> import grouser as gr
    >>> ends = gr.rollout(slope_deg=[[5.0], [15.0]], yaw_deg=np.linspace(0, 10, 3), duration_s=5.0)
    >>> ends.y_m.shape, set(ends.outcome.ravel().tolist())
    ((2, 3), {'completed'})
    """
    runs, places = _scenarios(scenarios)
    soils, soil_places = ([], np.zeros((), dtype=np.int64)) if soil is None else soils_of(soil)
    own = {
        "slope_deg": slope_deg,
        "yaw_deg": yaw_deg,
        "rim_speed_m_s": rim_speed_m_s,
        "gravity_m_s2": gravity_m_s2,
        "duration_s": duration_s,
    }
    arguments = {name: it for name, it in own.items() if it is not None}
    both = [*arguments, *(_KEYS[name] for name in arguments if name in _KEYS)]
    given = varied(vary, both if soil is None else [*both, "soil"], arguments)
    cells = {name: cells_of(it, runs[0], name) for name, it in given.items()}
    things = {name: it for name, it in cells.items() if it is not None}
    problems: dict[int, str] = {}
    made, made_places, is_nan = runs, places, outside_is_nan(outside)
    if things:
        made, made_places, problems = documents_of(runs, places, things, is_nan)
    asked = broadcast(
        {name: it for name, it in given.items() if name not in things},
        {"scenarios": made_places, "soil": soil_places},
    )
    index, soil_index = asked.places
    entries = (
        [run._document for run in made],
        index if len(made) > 1 else None,
        [one._document for one in soils],
        soil_index if len(soils) > 1 else None,
        asked.flat,
        index.size,
        is_nan,
        [(k, problems[it]) for k, it in enumerate(index.tolist()) if it in problems],
    )
    found = _core.rollout(entries, trajectories, keys_of(gradients))
    shape = asked.shape
    rows = found.pop("gradient", None)
    gradient = None
    if rows is not None:
        cells, sides, keys, results = rows
        gradient = of_rows(cells, sides, keys, results, shape)
    outcome = np.array(found.pop("outcome"), dtype=np.str_).reshape(shape)
    message = np.array(found.pop("reason"), dtype=object).reshape(shape)
    records = found.pop("samples", None)
    if records is not None:
        records = {name: it.reshape(*shape, it.shape[-1]) for name, it in records.items()}
    ends = {name: values.reshape(shape) for name, values in found.items()}
    inputs: dict[str, NDArray[Any]] = {} if places.ndim == 0 else {"scenario": places}
    inputs |= {**names_of(soils, soil_places), **{k: labels_of(it) for k, it in things.items()}}
    inputs |= {_COLUMNS.get(name, name): values for name, values in asked.given.items()}
    return Rollout(
        outcome=outcome, message=message, **ends, records=records, gradient=gradient, inputs=inputs
    )


#: The keys of documents that arguments set, where they have other names.
_KEYS = {"yaw_deg": "start.yaw_deg", "rim_speed_m_s": "drive.rim_speed_m_s"}
#: The columns of arguments, where a result has the argument's name.
_COLUMNS = {"yaw_deg": "start.yaw_deg"}


def _scenarios(scenarios: Any) -> tuple[list[Scenario], NDArray[np.int64]]:
    """The scenarios, and which of them each run has."""
    kinds = (Scenario, str, os.PathLike, Mapping, type(None))
    if isinstance(scenarios, kinds):
        return [scenario_of(scenarios, {})], np.zeros((), dtype=np.int64)
    try:
        several = list(scenarios)
    except TypeError:
        raise ParameterError(
            f"scenarios is of type {type(scenarios).__name__}, it must be a scenario or several",
            "scenarios",
        ) from None
    made = [scenario_of(one, {}) for one in several]
    # An empty sequence has no runs, but an array of no runs needs a scenario.
    return made or [Scenario()], np.arange(len(made), dtype=np.int64)
