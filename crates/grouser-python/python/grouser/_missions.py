"""Missions: legs that a rover drives one after the other, with limits at which it stops."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from . import _core, _tables
from ._animations import Animation
from ._arrays import Floats, whole_number
from ._descriptions import Mission, Source
from ._errors import ParameterError
from ._studies import Trajectory, columns_of, trajectory_of
from ._sweeps import Sweep, Vary, entered, of_each, sweep_of
from ._wheels import Outside

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False)
class Legs(_tables.Tabular):
    """What became of the legs of a mission: arrays of shape (legs,), of those that were begun; NaN
    and None where there is nothing to say.

    Made by `mission`, as `DrivenMission.legs`.
    """

    leg: Floats
    """Number of the leg, from 1."""
    manoeuvre: NDArray[np.object_]
    """What the leg says, in a few words."""
    outcome: NDArray[np.object_]
    """What became of it: a name of `grouser.OUTCOMES`."""
    distance_m: Floats
    """Way over the ground; a turn to the yaw of the leg before it does not count [m]."""
    time_s: Floats
    """How long it took, with the turn before it [s]."""
    energy_j: Floats
    """Work of the motors, with the turn before it [J]."""
    slip_ratio: Floats
    """1 less the way over the ground by that of the rims; of drives, arcs and ways to places [-]."""
    yaw_turned_deg: Floats
    """Yaw that an arc or a turn on the spot really turned, positive to the left [°]."""
    radius_m: Floats
    """Radius of an arc as driven: the way over the ground by the turn [m]."""
    stopped_by: NDArray[np.object_]
    """The limit that stopped it, by its key, or what would have become of it."""
    stopped_kind: NDArray[np.object_]
    """``command``, ``reactive``, or ``predictive`` for what was simulated ahead."""
    reason: NDArray[np.object_]
    """Why it did not end as it says."""
    x_m: Floats
    """Along the contour, where it ended, of the body's centre of mass [m]."""
    y_m: Floats
    """Uphill, where it ended [m]."""
    yaw_deg: Floats
    """Yaw where it ended, positive where the nose points uphill [°]."""
    back_out_m: Floats
    """How far it drove back out of the leg [m]."""
    back_out: NDArray[np.object_]
    """What became of that."""
    electrical: Mapping[str, Floats] = field(default_factory=dict)
    """``battery_energy_j`` [J] of motors and electronics, and ``current_a`` [A], the largest of a
    motor, of a rover whose motors are known; ``winding_temperature_degc`` [°C], the highest, where
    their windings are, and ``state_of_charge`` [-] where it ended, where the battery is. Empty
    without motors."""

    def _table(self) -> dict[str, Any]:
        names = [one.name for one in fields(self) if one.name != "electrical"]
        return {**columns_of(self, names), **self.electrical}

    def __len__(self) -> int:
        return len(self.leg)

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each leg that was begun."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``leg`` with units in the attributes."""
        columns = self._table()
        return _tables.dataset(("leg",), columns, {"leg": columns.pop("leg")})

    def __repr__(self) -> str:
        return f"<Legs: {', '.join(self.outcome)}>"


class Alternatives(_tables.Tabular, Mapping[str, "DrivenMission"]):
    """The ways to drive a mission by their names, each from the same start: a mapping, empty for a
    mission without alternatives.

    Made by `mission`, as `DrivenMission.alternatives`.
    """

    __slots__ = ("_ways",)

    def __init__(self, ways: Mapping[str, DrivenMission]) -> None:
        self._ways = dict(ways)

    def __getitem__(self, name: str) -> DrivenMission:
        return self._ways[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._ways)

    def __len__(self) -> int:
        return len(self._ways)

    def _table(self) -> dict[str, Any]:
        rows = [way._row() for way in self._ways.values()]
        names = list(rows[0]) if rows else []
        return {name: np.array([row[name] for row in rows]) for name in names}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each alternative."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``alternative`` with units in the attributes."""
        columns = self._table()
        coords = {"alternative": columns.pop("alternative", np.array([], dtype=str))}
        return _tables.dataset(("alternative",), columns, coords)

    def plot(self, axes: Axes | None = None, **style: Any) -> Axes:
        """Plots the path of each alternative on the same axes, labelled with its name.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        **style
            Arguments of ``Axes.plot``.
        """
        axes = _tables.axes_or_new(axes)
        for name, way in self._ways.items():
            way.trajectory.plot(axes, **{"label": name, **style})
        axes.legend()
        return axes

    def animate(self, path: str | os.PathLike[str] | None = None) -> Animation:
        """Draws the alternatives beside each other, as `Trajectory.animate` does.

        Parameters
        ----------
        path : path, optional
            A file to write, in one of the forms of `Trajectory.animate`.

        Returns
        -------
        Animation
            In a notebook, a player.
        """
        first, *others = (way.trajectory for way in self._ways.values())
        return first.animate(path, beside=others, names=list(self._ways))

    def __repr__(self) -> str:
        ways = (f"{name}: {way.outcome}" for name, way in self._ways.items())
        return f"<Alternatives {', '.join(ways)}>"


@dataclass(frozen=True, eq=False)
class DrivenMission(_tables.Tabular):
    """What became of a mission: of the whole, of each leg, and the rover over time.

    Made by `mission`.
    """

    mission: Mission
    """The mission that was driven."""
    legs: Legs
    """What became of each leg that was begun."""
    final: Mapping[str, float]
    """Where and when it ended: ``time_s``, ``x_m``, ``y_m``, ``yaw_deg``."""
    trajectory: Trajectory
    """The rover over time, from the start of the first leg to the end of the last."""
    alternatives: Alternatives
    """All ways by their names, of which this is the first; empty for a mission without any."""
    alternative: str
    """The way that was driven."""
    outcome: str
    """That of the last leg that was begun: ``completed``, ``stopped`` or what became of the rover."""
    legs_completed: int
    """Legs that ended as they say."""
    legs_planned: int
    """Legs of the plan."""
    distance_m: float
    """Way over the ground of drives, arcs and ways to places [m]."""
    slip_ratio: float
    """Largest slip ratio of a leg [-]."""
    time_s: float
    """Time at the end [s]."""
    x_m: float
    """Along the contour, at the end [m]."""
    y_m: float
    """Uphill, at the end [m]."""
    energy_j: float
    """Work of the motors [J]."""
    electrical: Mapping[str, float] = field(default_factory=dict)
    """``battery_energy_j`` [J] of motors and electronics, and ``current_a`` [A], the largest of a
    motor, of a rover whose motors are known; ``winding_temperature_degc`` [°C], the highest, where
    their windings are, and ``state_of_charge`` [-] at the end, where the battery is. Empty without
    motors."""
    risk: Mapping[str, Any] | Any = None
    """What the mission risks on samples of soil and model: the share that completes all legs,
    ``probability_completed``, with its 95 % confidence interval (``…_low``, ``…_high``); how the
    others end most often, ``commonest_end``, at which limit if one stopped it, in which leg and in
    how many samples (``commonest_end_limit``, ``commonest_end_leg``, ``commonest_end_draws``); and
    ``draws_not_computed``. None without ``samples``."""
    advice: Mapping[str, NDArray[Any]] | Any = None
    """What to do on each leg that was begun, as columns, with NaN and None for one that leads
    nowhere: ``verdict`` and ``reason`` as in `Card`, ``probability_stuck``, and the heading to set,
    ``yaw_deg``, from the contour, with its band (``yaw_deg_p2_5`` …). None without ``samples``."""

    def _table(self) -> dict[str, Any]:
        return self.legs._table()

    def _row(self) -> dict[str, Any]:
        return {**columns_of(self, _ROW), **self.electrical}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each leg that was begun."""
        return self.legs.to_pandas()

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``leg`` with units in the attributes; that over time is
        ``trajectory.to_xarray()``."""
        return self.legs.to_xarray().assign_attrs(self._notes())

    def _notes(self) -> dict[str, str]:
        return {
            "outcome": self.outcome,
            "mission": self.mission.to_toml(),
            "alternative": self.alternative,
        }

    def plot(self, axes: Axes | None = None, **style: Any) -> Axes:
        """Plots the path on the slope, seen from above, with a dot and a number where each leg
        ended.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        **style
            Arguments of ``Axes.plot``.
        """
        axes = self.trajectory.plot(axes, **{"label": self.alternative or self.outcome, **style})
        colour = axes.lines[-1].get_color()
        axes.plot(self.legs.x_m, self.legs.y_m, "o", color=colour, markersize=4.0)
        for number, x, y in zip(self.legs.leg, self.legs.x_m, self.legs.y_m):
            axes.annotate(f"{number:.0f}", (x, y), xytext=(4, 4), textcoords="offset points")
        return axes

    def __repr__(self) -> str:
        name = f" {self.alternative}" if self.alternative else ""
        state = ", ".join(f"{key}={value:.4g}" for key, value in self.final.items())
        legs = f"{self.legs_completed} of {self.legs_planned} legs"
        return f"<DrivenMission{name} {self.outcome}, {legs}: {state}>"


#: Fields of the row of a mission, in the order of the program's table.
_ROW = tuple(one.name for one in fields(DrivenMission)[5:-3])


@overload
def mission(mission: Mission | Source, /, *, vary: Vary, **asked: Any) -> Sweep: ...


@overload
def mission(
    mission: Mission | Source, /, *, samples: int | None = ..., seed: int = ..., **changes: Any
) -> DrivenMission: ...


def mission(
    mission: Mission | Source,
    /,
    *,
    samples: int | None = None,
    seed: int = 1,
    vary: Vary | None = None,
    outside: Outside = "raise",
    **changes: Any,
) -> DrivenMission | Sweep:
    """Drives a rover through the legs of a mission, to its end or to the limit that stops it.

    Results are reproducible bit for bit, here and in the program's ``grouser mission``.

    Parameters
    ----------
    mission : Mission, name, path or mapping
        The mission.
    samples : int, optional
        Number of samples of soil and model, 2 to 100000, on which the mission is driven as well,
        quasi-steadily, for `DrivenMission.risk` and `DrivenMission.advice`. Without it the mission
        is driven as it is written, and no more.
    seed : int
        Seed of the samples: the same seed gives the same soils and models.
    vary, outside
        As for `heading`, by the keys of the mission, such as ``leg.0.drive_m``: only the ends of
        missions and, as ``legs``, of their legs are kept. One that cannot be computed has a
        ``status``, and the others continue. With ``samples`` each entry is computed by itself, with
        its risk.
    **changes
        Keys of the mission with other values: ``slope_deg=15.0``, ``stop={…}``.

    Returns
    -------
    DrivenMission
        The mission; of several alternatives the first, with all of them as its ``alternatives``.
        With ``vary`` a `Sweep`, with an axis of alternatives if there are some.

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `Mission`.
    SimulationError
        If the motion cannot be computed. A rover that gets stuck, and one that a limit stopped, is an
        outcome, not an error.

    Examples
    --------
    How much slip does a climb of 2 m cost, forward, backward, by a switchback and crabbing?

    >>> import grouser as gr
    >>> found = gr.mission("two-steps-forward", simulation="quasi-steady")
    >>> tuple(found.alternatives)
    ('forward', 'backward', 'switchback', 'crab')
    >>> slip = {name: way.slip_ratio for name, way in found.alternatives.items()}
    >>> slip["switchback"] < slip["forward"]
    True

    A drive that is stopped, and where:

    >>> check = gr.mission("slip-check", simulation="quasi-steady", slope_deg=14.0)
    >>> check.outcome, check.legs.stopped_by[-1]
    ('stopped', 'slip_ratio')

    How likely is it that a short drive is completed, if sand and model are not known well?

    >>> leg = {"drive_m": 1.0, "yaw_deg": 3.0}
    >>> plan = gr.Mission(soil="toyoura-uncertain", slope_deg=5.0, leg=[leg])
    >>> drive = gr.mission(plan, samples=10)
    >>> bool(0.5 < drive.risk["probability_completed"] <= 1.0), len(drive.advice["verdict"])
    (True, 1)
    """
    if vary is not None:
        return _sweep(mission, changes, vary, outside, samples, seed)
    if isinstance(mission, Mission) and not changes:
        plan = mission
    else:
        plan = Mission(mission, **changes)
    sampling = None
    if samples is not None:
        count = whole_number("samples", samples, most=2**32 - 1)
        sampling = count, whole_number("seed", seed)
    found = _core.drive_mission(plan._document, sampling)
    ways = [_driven(plan, way, Alternatives({})) for way in found]
    named = {way.alternative: way for way in ways if way.alternative}
    return _driven(plan, found[0], Alternatives(named)) if named else ways[0]


def _sweep(
    source: Mission | Source,
    changes: dict[str, Any],
    vary: Vary,
    outside: Outside,
    samples: int | None,
    seed: int,
) -> Sweep:
    """Missions over what varies: with samples one after the other, with the risk of each."""
    asked = entered(Mission, source, changes, vary, outside, by_document=samples is not None)
    plans = [it.to_dict() for it in asked.documents]
    ways = {tuple(way["name"] for way in plan.get("alternative", ())) for plan in plans}
    if len(ways) > 1:
        raise ParameterError("vary: the missions differ in their alternatives", "vary")
    names = next(iter(ways), ())
    axes: dict[str, Any] = {"alternative": names} if names else {}

    def ends(plan: Mission) -> dict[str, Any]:
        found = mission(plan, samples=samples, seed=seed)
        rows = [{**way._row(), **way.risk} for way in found.alternatives.values() or [found]]
        return {name: [row.get(name) for row in rows] for name in rows[0]}

    if samples is not None:
        swept = of_each(asked, axes, ends)
        return sweep_of(asked, swept, "mission", _tables.COLUMNS["mission"], axes)
    each = (it for plan in plans for it in (plan, *plan.get("alternative", ())))
    most = max((len(it.get("leg", ())) for it in each), default=0)
    swept = _core.mission_sweep(asked.native, max(len(names), 1), most)
    legs = {**axes, "leg": np.arange(1, most + 1)}
    return sweep_of(asked, swept, "mission", _tables.COLUMNS["mission"], axes, legs=legs)


def _driven(plan: Mission, found: Mapping[str, Any], alternatives: Alternatives) -> DrivenMission:
    row, electrical = _split(found["row"], _ROW)
    whole = found["whole"]
    row["alternative"] = row["alternative"] or ""
    row["slip_ratio"] = np.nan if row["slip_ratio"] is None else row["slip_ratio"]
    run = trajectory_of(
        found["trajectory"],
        scenario=plan.scenario,
        mission=plan,
        alternative=row["alternative"],
    )
    advice = _tables.arrays_of(found["advice"]) if "advice" in found else None
    legs, of_legs = _split(_tables.arrays_of(found["legs"]), [one.name for one in fields(Legs)])
    return DrivenMission(
        mission=plan,
        legs=Legs(**legs, electrical=of_legs),
        final=whole["final"],
        trajectory=run,
        alternatives=alternatives,
        electrical=electrical,
        risk=found.get("risk"),
        advice=advice,
        **row,
    )


def _split(
    columns: Mapping[str, Any], names: Sequence[str]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Columns of these names, and the others: those of motors and battery."""
    known = {name: column for name, column in columns.items() if name in names}
    return known, {name: column for name, column in columns.items() if name not in names}
