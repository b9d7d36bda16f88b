"""The cheapest way for a rover over a map of heights, and what a given way takes."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np

from . import _core, _tables
from ._arrays import number, numbers, whole_number
from ._descriptions import Scenario, Source
from ._errors import ParameterError
from ._studies import scenario_of
from ._terrain import Terrain, carried, native_of
from ._verdicts import ADVICE

if TYPE_CHECKING:
    import xarray
    from numpy.typing import ArrayLike

#: What a way can have least of.
Objective = Literal["time", "energy", "risk"]

_OBJECTIVES = ("time", "energy", "risk")
#: Numbers at each waypoint, and what they are.
_ARRIVALS = {
    "length_m": "Length over the ground from the start",
    "time_s": "Time from the start, before the turn at the waypoint",
    "energy_j": "Work of the wheels from the start, before the turn at the waypoint",
}
#: Numbers of each piece of a way, and what they are.
_PROFILE = {name: doc for name, _, doc in _core.result_columns()["profile"]}
#: Of each stretch that is not safe: what it is, and where.
_HAZARDS = {
    "danger": "What is not safe",
    "from_m": "Where it begins, as length on the map from the start",
    "to_m": "Where it ends, as length on the map from the start",
    "x_m": "x where it begins",
    "y_m": "y where it begins",
}
_SENTENCE = {"sentence": "What is not safe, where, and by how much"}


@overload
def route(
    terrain: Terrain,
    scenario: Scenario | Source | None = None,
    /,
    *,
    from_m: Sequence[float] | None = None,
    to_m: Sequence[float] | None = None,
    along: ArrayLike | str | os.PathLike[str] | None = None,
    minimise: Objective = "time",
    yaw_deg: float | None = None,
    keep_out: str | os.PathLike[str] | None = None,
    most_slope_deg: float | None = None,
    most_slip_ratio: float | None = None,
    most_no_go: float | None = None,
    alternatives: Literal[False] = False,
    drive: bool = True,
    rim_speed_m_s: float | None = None,
    samples: int = 50,
    seed: int = 1,
    **changes: Any,
) -> xarray.Dataset: ...
@overload
def route(
    terrain: Terrain,
    scenario: Scenario | Source | None = None,
    /,
    *,
    from_m: Sequence[float] | None = None,
    to_m: Sequence[float] | None = None,
    along: ArrayLike | str | os.PathLike[str] | None = None,
    minimise: Objective = "time",
    yaw_deg: float | None = None,
    keep_out: str | os.PathLike[str] | None = None,
    most_slope_deg: float | None = None,
    most_slip_ratio: float | None = None,
    most_no_go: float | None = None,
    alternatives: Literal[True],
    drive: bool = True,
    rim_speed_m_s: float | None = None,
    samples: int = 50,
    seed: int = 1,
    **changes: Any,
) -> dict[Objective, xarray.Dataset]: ...
def route(
    terrain: Terrain,
    scenario: Scenario | Source | None = None,
    /,
    *,
    from_m: Sequence[float] | None = None,
    to_m: Sequence[float] | None = None,
    along: ArrayLike | str | os.PathLike[str] | None = None,
    minimise: Objective = "time",
    yaw_deg: float | None = None,
    keep_out: str | os.PathLike[str] | None = None,
    most_slope_deg: float | None = None,
    most_slip_ratio: float | None = None,
    most_no_go: float | None = None,
    alternatives: bool = False,
    drive: bool = True,
    rim_speed_m_s: float | None = None,
    samples: int = 50,
    seed: int = 1,
    **changes: Any,
) -> xarray.Dataset | dict[Objective, xarray.Dataset]:
    """The cheapest way over a map of heights, or what a given way takes, and its simulation.

    Parameters
    ----------
    terrain : Terrain
        The heights.
    scenario : Scenario, name, path or mapping, optional
        Rover, soil, gravity and model, as for `heading`.
    from_m, to_m : (float, float)
        x and y where the way begins and ends [m].
    along : (N, 2) array or path, optional
        Instead of both, a way that is not sought but checked: x and y of its places [m], or a file
        of GeoJSON with a LineString in metres of the map, such as a ``route.geojson``. The result
        is one dataset then, whatever ``minimise`` is.
    minimise : "time", "energy" or "risk"
        What the way has least of: time, energy, or time in the worst tenth of the samples of soil
        and model. Energy is what the motors draw, ``battery_energy_j``; where none is known, the
        work of the wheels, ``energy_j``.
    yaw_deg : float, optional
        Yaw at the start [°], from the map's x axis to the left; by default the first turn is free.
    keep_out : path, optional
        A file of GeoJSON with polygons, in metres of the map, into which the way may not lead.
    most_slope_deg : float, optional
        The steepest slope of the way [°].
    most_slip_ratio : float, optional
        The largest slip ratio of the way; by default that of a no-go.
    most_no_go : float, optional
        In which share of the samples a place of the way may be a no-go; by default as many as a
        no-go allows.
    alternatives : bool
        Whether to seek the ways that have least of the other two as well.
    drive : bool
        Whether to drive the way by simulation, too.
    rim_speed_m_s : float, optional
        Rim speed [m/s]; by default the scenario's.
    samples, seed : int
        How many samples of soil and model there are, and their seed.
    **changes
        Keys of the scenario with other values.

    Returns
    -------
    xarray.Dataset or dict of xarray.Dataset
        The places where the way turns, with the first and the last, as coordinates ``x`` and ``y``
        over ``waypoint`` [m], and the length, time and work up to each of them. Its ``attrs`` have
        the ``status``, ``"found"`` or ``"no-safe-route"``, and of the whole way what
        ``grouser route`` writes: ``sentence``, ``probability_completed`` with its interval, the
        commonest end of the other samples, the worst ``verdict`` of the legs, ``length_m``, ``time_s``, ``energy_j``, ``turned_deg``, slip, slope
        and ``probability_no_go``, and ``simulated_…`` of the simulation. If no way is safe there
        are no waypoints, and a ``reason`` instead of the numbers. What to do on each leg between
        waypoints is over ``leg``. It is the advice for the worst place of the leg, to a whole
        degree, with the slope and course ``leg_slope_deg`` and ``leg_course_deg``: whether to drive
        there and why (``leg_verdict``, ``leg_reason``), ``leg_probability_stuck``, and the heading
        to set, ``leg_yaw_deg``, from the contour, with its band (``…_p2_5``, ``…_p97_5``). Where the
        turn on the spot before a leg is worse it is that of the turn, without course and heading. What
        is met along the way is over ``piece``: ``piece_leg``, ``piece_along_m`` from the start on the
        map to its middle, its place and height ``piece_x_m``, ``piece_y_m``, ``piece_z_m``,
        ``piece_slope_deg``, ``piece_course_deg``, ``piece_slip_ratio`` in the median of the samples,
        and ``piece_probability_no_go``; NaN where the ground is not known. With
        ``alternatives`` a dataset for each objective, the chosen one first. Of a way given by
        ``along`` the status is
        ``"safe"`` or ``"not-safe"``, and each stretch that is not safe is a ``hazard``: what it is
        (``danger``, and ``hazard_sentence``), from which length on the map to which (``from_m``,
        ``to_m``), and where it begins (``x_m``, ``y_m``). Where the ground is not known or no
        heading holds the course, there are no numbers of the whole way.

    Raises
    ------
    ParameterError
        Also for ends or a line that are not on the map.
    DocumentError, DocumentNotFoundError
        As `heading`, for a file of ``keep_out`` that has no polygons on the map, and for one of
        ``along`` that has no line.

    Examples
    --------
    Around a hill, or over it?

    >>> import numpy as np
    >>> import grouser as gr
    >>> x = y = np.linspace(-20.0, 20.0, 41)
    >>> hill = gr.Terrain(
    ...     9.0 * np.exp(-(x**2 + y[:, None] ** 2) / 40.0),
    ...     cell_size_m=1.0,
    ...     south_west_m=(-20.0, -20.0),
    ... )
    >>> way = gr.route(hill, from_m=(-15.0, 0.0), to_m=(15.0, 0.0), samples=4, drive=False)
    >>> way.attrs["status"], bool(way.attrs["length_m"] > 32.0)
    ('found', True)
    >>> way.time_s.dims, way.time_s.attrs["units"], bool(abs(way.y).max() > 5.0)
    (('waypoint',), 's', True)

    Is the straight line safe?

    >>> straight = gr.route(hill, along=[(-15.0, 0.0), (15.0, 0.0)], samples=4, drive=False)
    >>> straight.attrs["status"], str(straight.danger[0].values)
    ('not-safe', 'too-much-slip')
    """
    ground = native_of(terrain)
    run = scenario_of(scenario, changes)
    chosen = [minimise, *(it for it in _OBJECTIVES if alternatives and it != minimise)]
    limits = {
        "yaw_deg": yaw_deg,
        "most_slope_deg": most_slope_deg,
        "most_slip_ratio": most_slip_ratio,
        "most_no_go": most_no_go,
        "rim_speed_m_s": rim_speed_m_s,
    }
    task = {
        **_asked(from_m, to_m, along),
        "minimise": [str(it) for it in chosen],
        "keep_out": None if keep_out is None else os.fspath(keep_out),
        "drive": bool(drive),
        "samples": whole_number("samples", samples, most=2**32 - 1),
        "seed": whole_number("seed", seed),
    }
    task |= {name: None if value is None else number(name, value) for name, value in limits.items()}
    found = _core.routes(run._document, ground, task)
    notes = {"samples": samples, "seed": seed}
    if along is not None:
        return carried(_line_dataset(found[0], notes), terrain)
    ways = {way["minimise"]: carried(_dataset(way, notes), terrain) for way in found}
    return ways if alternatives else ways[minimise]


def _asked(from_m: Any, to_m: Any, along: Any) -> dict[str, Any]:
    """Ends of a way, or a line."""
    ends = {"from_m": from_m, "to_m": to_m}
    none = {"from_m": None, "to_m": None, "along": None, "along_file": None}
    if along is None:
        for name, end in ends.items():
            if end is None:
                raise ParameterError(f"{name} is missing: a way needs it, or `along`", name)
        return none | {name: _place(name, end) for name, end in ends.items()}
    for name, end in ends.items():
        if end is not None:
            raise ParameterError(f"{name} has no place beside `along`, which is a whole way", name)
    if isinstance(along, (str, os.PathLike)):
        return none | {"along_file": os.fspath(along)}
    given = numbers("along", along)
    if given.ndim != 2 or given.shape[1] != 2:
        raise ParameterError(
            f"along has shape {given.shape}, it must be x and y of each place, (N, 2)", "along"
        )
    return none | {"along": given.tolist()}


def _place(name: str, value: Any) -> list[float]:
    """x and y."""
    given = numbers(name, value)
    if given.shape != (2,):
        raise ParameterError(f"{name} has shape {given.shape}, it must be x and y", name)
    if not np.isfinite(given).all():
        raise ParameterError(f"{name} is {given.tolist()}, it must be x and y in metres", name)
    return [float(it) for it in given]


def _dataset(way: Mapping[str, Any], notes: Mapping[str, int]) -> xarray.Dataset:
    import xarray

    places = np.array(way["waypoints"], dtype=np.float64).reshape(-1, 2)
    over = ("waypoint",)
    coordinates = {
        axis: (
            over,
            places[:, column],
            {"units": "m", "standard_name": f"projection_{axis}_coordinate"},
        )
        for column, axis in enumerate("xy")
    }
    # Of a line that has no numbers there are places all the same.
    arrivals = way["arrivals"] or [dict.fromkeys(_ARRIVALS, np.nan)] * len(places)
    legs = [{**leg, **leg["advice"]} for leg in way["legs"]]
    variables = _variables("waypoint", _ARRIVALS, arrivals)
    variables |= _variables("leg", ADVICE, legs, "leg_")
    variables |= _variables("piece", _PROFILE, way["profile"], "piece_")
    apart = ("waypoints", "arrivals", "hazards", "legs", "profile")
    whole = {name: it for name, it in way.items() if name not in apart}
    simulated = whole.pop("simulated") or {}
    attributes = {**whole, **{f"simulated_{name}": it for name, it in simulated.items()}, **notes}
    # Files have no attributes without a value.
    attributes = {name: it for name, it in attributes.items() if it is not None}
    return xarray.Dataset(variables, coords=coordinates, attrs=attributes)


def _line_dataset(way: Mapping[str, Any], notes: Mapping[str, int]) -> xarray.Dataset:
    """Of a way that was given: with its hazards."""
    hazards = _variables("hazard", _HAZARDS, way["hazards"])
    sentences = _variables("hazard", _SENTENCE, way["hazards"], "hazard_")
    return _dataset(way, notes).assign(hazards | sentences)


def _variables(
    dim: str, docs: Mapping[str, str], rows: Sequence[Mapping[str, Any]], prefix: str = ""
) -> dict[str, Any]:
    columns = {name: [row[name] for row in rows] for name in docs}
    return _tables.described(dim, docs, columns, prefix)
