"""The heading offset that holds the contour line or another course, over slope, course and soil."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _shown, _tables
from ._arrays import Floats, line, number, whole_number
from ._heading_band import HeadingBand, HeadingMapBand
from ._descriptions import Scenario, Soil, Source
from ._errors import ParameterError
from ._gradients import Gradient, Keys, keys_of, of_columns
from ._models import MODELS, ByModel, each_model
from ._studies import columns_of, scenario_of, soil_of
from ._sweeps import Sweep, Vary, entered, of_each, sweep_of
from ._verdicts import limits_of
from ._wheels import Outside, Soils

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes

#: Slopes of a heading [°].
_SLOPES = (5.0, 10.0, 15.0, 20.0)
#: Those of a map.
_MAP_SLOPES = tuple(range(0, 25, 2))
#: Fields of a `HeadingMap`; `Headings` have all but the power.
_HELD = tuple(name for name in _tables.COLUMNS["heading"] if name != "power_w")


@dataclass(frozen=True, eq=False)
class _Held:
    """What rovers have that hold a course."""

    status: NDArray[np.object_]
    """``ok``, or why no yaw holds the course; of an entry without a result, why."""
    flags: NDArray[np.object_]
    """Why each entry is an extrapolation: names of `FLAGS`, joined by ``;``."""
    yaw_deg: Floats
    """Yaw that holds the course [°], positive uphill."""
    slip_ratio: Floats
    """Slip ratio of every wheel; with wheels steered, of these [-]."""
    sinkage_mm: Floats
    """Mean sinkage of the wheels [mm]."""
    torque_nm: Floats
    """Torque of all wheels together [N·m]."""
    energy_j_per_m: Floats
    """Work of the wheels per metre along the course [J/m]."""
    yaw_moment_nm: Floats
    """Yaw moment left over [N·m]; negative turns the nose downhill."""


@dataclass(frozen=True, eq=False)
class Headings(_Held, _tables.Tabular):
    """Heading offsets that hold the contour line, and whether to drive by them: arrays of shape
    (slopes,), NaN where there is no number.

    The heading to set, its verdict and the `band` are over samples of soil and model. Slip,
    sinkage, torque, energy and yaw moment, and the steepest slope, are those of the soil as its
    document has it, with one model and its own heading, `yaw_deg_as_written`. With
    ``nominal=True`` there is nothing else.

    Examples
    --------
    >>> import grouser as gr
    >>> level = gr.heading(slope_deg=[5, 10, 15], nominal=True)
    >>> bool((level.yaw_deg[1:] > level.yaw_deg[:-1]).all())        # steeper: turn further uphill
    True
    >>> bool(level.to_pandas()["slip_ratio"].max() == level.slip_ratio[2])
    True
    >>> believed = gr.heading(soil="toyoura-uncertain", slope_deg=[5, 10])
    >>> bool((believed.yaw_deg == believed.band.yaw_deg_p50).all())
    True
    """

    limit_slope_deg: float | None
    """The steepest slope on which the contour can be held, on the soil as written [°]; None where
    the rover cannot move."""
    limit_message: str
    """What ends the curve there."""
    limited_by: str | None
    """The same in a word: ``wheels``; ``ground-strength``, where the ground itself would slide;
    ``range``, of the slopes; or ``not-found``, where the search gave up and nothing is known of
    steeper slopes; None where the rover cannot move."""
    slope_deg: Floats
    """Slopes [°]."""
    yaw_deg: Floats
    """Yaw that holds the course [°], positive uphill: the heading to set, which is the median over
    all samples. NaN where no heading holds the course in half of them."""
    columns: Mapping[str, NDArray[Any]]
    """All columns, by the names of the program's table."""
    steering_deg: Floats | Any = None
    """Steering angle of every wheel that is steered [°], positive uphill; None without
    ``steering="crab"``."""
    verdict: NDArray[np.object_] | Any = None
    """Whether to drive there, as on the operator's card: ``go``, ``caution``, ``cannot_tell`` or
    ``no_go``; None with ``nominal=True``, as all that follows."""
    reason: NDArray[np.object_] | Any = None
    """What decides the verdict, in a word, as in `Card`."""
    probability_stuck: Floats | Any = None
    """Share of ways of 10 m on which a rover that is driven so gets stuck, although its slip is
    looked at as often as the card says [-]; NaN where it is not driven."""
    yaw_deg_as_written: Floats | Any = None
    """Yaw that holds the contour on the soil as written [°]."""
    of_models: Mapping[str, Floats] | Any = None
    """The same by each wheel–soil model that knows the forces across a wheel [°]."""
    band: HeadingBand | Any = None
    """Quantiles over the samples, and the probability that a heading holds the contour."""

    gradient: Gradient | Any = None
    """The derivatives of the results over the slopes, and of the steepest slope, with
    ``gradients``; else None."""

    def _table(self) -> Mapping[str, Any]:
        return self.columns

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each slope."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``slope_deg`` with units in the attributes."""
        columns = dict(self.columns)
        coords = {"slope_deg": columns.pop("slope_deg")}
        return _tables.dataset(("slope_deg",), columns, coords)

    def plot(self, axes: Axes | None = None, **style: Any) -> Axes:
        """Plots the heading to set over the slope, with the band of the samples if there is one.
        The band ends where its upper end is above every number.

        Dots are the slopes that were asked for. The lines between them are straight: near the steepest
        slope, where the curve rises fast, ask for more slopes.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        **style
            Arguments of the drawing functions of matplotlib.
        """
        axes = _tables.axes_or_new(axes)
        if self.band is not None:
            ends = (self.band.yaw_deg_p2_5, self.band.yaw_deg_p97_5)
            label = None if "label" in style else "95 % of the samples"
            axes.fill_between(self.slope_deg, *ends, alpha=0.25, label=label)
        turned, what = self.yaw_deg, "yaw"
        if self.steering_deg is not None:
            turned, what = self.steering_deg, "steering angle"
        axes.plot(self.slope_deg, turned, **{"marker": "o", "markersize": 4.0, **style})
        axes.set_xlabel("slope [°]")
        axes.set_ylabel(f"{what}, positive uphill [°]")
        return axes

    def __repr__(self) -> str:
        limit = self.limit_slope_deg
        steepest = "the rover cannot move" if limit is None else f"the steepest is {limit:.2f}°"
        if self.band is None or self.verdict is None or len(self.status) != 1:
            return f"<Headings on {len(self.status)} slopes, {steepest}>"
        ends = (self.yaw_deg, self.band.yaw_deg_p2_5, self.band.yaw_deg_p97_5)
        yaw, low, high = (_shown.cell(it[0]) for it in ends)
        band = f"{yaw}° ({low}° to {high}°), {self.verdict[0]}"
        return f"<Headings on {self.slope_deg[0]:g}°: {band}; as written {steepest}>"


@overload
def heading(
    scenario: Scenario | Source | None = None, /, *, vary: Vary, model: Literal["all"], **asked: Any
) -> ByModel[Sweep]: ...


@overload
def heading(
    scenario: Scenario | Source | None = None, /, *, vary: Vary, **asked: Any
) -> Sweep: ...


@overload
def heading(
    scenario: Scenario | Source | None = None, /, *, model: Literal["all"], **asked: Any
) -> ByModel[Headings]: ...


@overload
def heading(
    scenario: Scenario | Source | None = None,
    /,
    *,
    model: str | None = ...,
    slope_deg: ArrayLike = ...,
    steering: Literal["none", "crab"] = ...,
    nominal: bool = ...,
    samples: int = ...,
    seed: int = ...,
    rule: Mapping[str, float] | None = ...,
    gradients: Keys | None = ...,
    uncertainty: bool | None = ...,
    **changes: Any,
) -> Headings: ...


def heading(
    scenario: Scenario | Source | None = None,
    /,
    *,
    model: str | None = None,
    slope_deg: ArrayLike = _SLOPES,
    steering: Literal["none", "crab"] = "none",
    nominal: bool = False,
    samples: int = 40,
    seed: int = 1,
    rule: Mapping[str, float] | None = None,
    gradients: Keys | None = None,
    uncertainty: bool | None = None,
    vary: Vary | None = None,
    outside: Outside = "raise",
    **changes: Any,
) -> Headings | Sweep | ByModel[Headings] | ByModel[Sweep]:
    """The heading offset that holds the contour line, on each slope ([FourWheel], Fig. 10), and
    whether to drive there.

    A rover that drives straight across a slope drifts downhill. With its nose turned uphill by the
    heading offset (the paper says *attitude*, others crab angle) it holds the contour line.

    The answer is by what is believed of soil and model: the heading to set is the median over
    samples of both, and the verdict is that of the operator's `card`. With ``nominal=True`` it is
    that of the soil as its document has it, and of one model.

    Parameters
    ----------
    scenario : Scenario, name, path or mapping, optional
        Its rover, soil, gravity, model, load transfer and wheel moments are used; its slope, drive
        and start are not.
    model : str, optional
        The wheel–soil model, or ``"all"`` for the results of each; by default that of the scenario
        or of its soil.
    slope_deg : array_like, shape (slopes,)
        Slopes [°], 0 to 60.
    steering : "none" or "crab"
        What holds the contour: the body's yaw, or with ``"crab"`` the wheels that are steered, with
        the body along the contour. That is answered without samples.
    nominal : bool
        Whether to take the soil as its document has it, and one model, without samples.
    samples : int
        Number of samples, 2 to 100000: of the soil, where its document is uncertain, and of the
        wheel–soil model, where none is asked for by ``model``. So few as 40 give rough bands.
    seed : int
        Seed of the samples: the same seed gives the same soils and models.
    rule : mapping, optional
        Limits of the verdicts, as for `card`.
    gradients : str or sequence of str, optional
        Keys of numbers of rover and soil by which the results and the steepest slope are
        differentiated, such as ``soil.friction_angle_deg``, ``rover.wheel_unit.wheel.radius_m``,
        ``slope_deg``, or ``"all"``. They are of the soil as its document has it, with one model; an
        uncertain soil needs ``nominal=True``.
    uncertainty : bool, optional
        Samples are the usual answer: it changes nothing.
    vary : mapping of str to array_like, optional
        What differs from entry to entry, by the keys of the scenario: numbers, as
        ``soil.cohesion_kpa`` or ``gravity_m_s2``, whole numbers, words, soils and rovers. They broadcast
        with each other, and with ``soil`` and ``rover`` where those are sequences. With ``nominal=True``
        no scenario is read for an entry, and ``slope_deg`` may vary, too: entries that differ in their
        slopes alone share a curve, which is the dear part. Else each entry is computed by itself. Not
        with ``gradients``.
    outside : {"raise", "nan"}
        With ``"nan"`` an entry of ``vary`` with a number out of its range (`range_of`), or with what
        does not go together, is NaN with a ``status``; by default it is an error.
    **changes
        Keys of the scenario with other values.

    Returns
    -------
    Headings
        With ``vary`` a `Sweep`; for all models `ByModel` of either.

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `Scenario`. A slope on which no heading offset holds the contour is a result, not an
        error.

    Examples
    --------
    >>> import grouser as gr
    >>> round(float(gr.heading(slope_deg=[10.0], nominal=True).yaw_deg[0]), 1)
    5.0
    >>> crab = gr.heading(rover="hakuto-steered", slope_deg=[10.0], steering="crab")
    >>> bool(crab.steering_deg[0] > 0.0 and crab.yaw_deg[0] == 0.0)
    True

    May one drive, and with which heading, in sand that is not known well?

    >>> level = gr.heading(soil="toyoura-uncertain", slope_deg=[5.0, 28.0])
    >>> level.verdict.tolist()
    ['go', 'no_go']
    >>> bool(level.band.yaw_deg_p2_5[0] < level.yaw_deg[0] < level.band.yaw_deg_p97_5[0])
    True
    """
    if steering not in ("none", "crab"):
        raise ParameterError(f'steering is {steering!r}, it must be "none" or "crab"', "steering")
    if uncertainty and steering == "crab":
        raise ParameterError('uncertainty goes with steering="none"', "uncertainty")
    if vary is not None and gradients is not None:
        raise ParameterError("vary does not go with gradients: leave one of them out", "vary")
    if model == "all":
        settings: dict[str, Any] = {"slope_deg": slope_deg, "steering": steering}
        settings |= {"nominal": nominal, "samples": samples, "seed": seed, "rule": rule}
        settings |= {"gradients": gradients, "vary": vary, "outside": outside}
        return each_model(lambda name: heading(scenario, model=name, **settings, **changes))
    if vary is not None:
        changes = changes if model is None else {**changes, "model": model}
        is_native = nominal or steering == "crab"
        taken = ("slope_deg",) if slope_deg is not _SLOPES or not is_native else ()
        asked = entered(
            Scenario, scenario, changes, vary, outside, taken, by_document=not is_native
        )
        slopes = line("slope_deg", slope_deg)
        axes = {} if "slope_deg" in asked.inputs else {"slope_deg": slopes}
        if is_native:
            swept = _core.heading_sweep(asked.native, slopes, steering)
        else:
            settings = {"slope_deg": slopes, "samples": samples, "seed": seed, "rule": rule}
            swept = of_each(asked, axes, lambda run: _rows_of(heading(run, **settings)))
        return sweep_of(asked, swept, "heading", (*_HELD, "limit_slope_deg"), axes)
    changes = changes if model is None else {**changes, "model": model}
    slopes, run = line("slope_deg", slope_deg), scenario_of(scenario, changes)
    sampling = None
    if not nominal and steering == "none":
        count = whole_number("samples", samples, most=2**32 - 1)
        sampling = count, whole_number("seed", seed)
    keys = keys_of(gradients)
    rows, limit, belief = _core.heading(
        run._document, slopes, steering, sampling, limits_of(rule), keys
    )
    columns = _tables.arrays_of(rows)
    gradient = None if keys is None else of_columns(columns, limit)
    names = [one.name for one in fields(Headings)]
    own: dict[str, Any] = {name: columns[name] for name in names if name in columns}
    if belief is not None:
        yaws = {name: f"yaw_deg_{name.replace('-', '_')}" for name in MODELS}
        own["of_models"] = {name: columns[it] for name, it in yaws.items() if it in columns}
        own["band"] = HeadingBand._of(columns, limit, belief)
    return Headings(
        limit_slope_deg=limit["limit_slope_deg"],
        limit_message=limit["limit_reason"],
        limited_by=limit["limited_by"],
        columns=columns,
        gradient=gradient,
        **own,
    )


def _rows_of(found: Headings) -> dict[str, Any]:
    """All columns, with the steepest slope in each row."""
    limit = np.nan if found.limit_slope_deg is None else found.limit_slope_deg
    ends = {"limit_slope_deg": limit, "limited_by": found.limited_by}
    shape = found.slope_deg.shape
    return {**found.columns, **{name: np.full(shape, it) for name, it in ends.items()}}


@dataclass(frozen=True, eq=False)
class HeadingMap(_Held, _tables.Tabular):
    """Heading offsets over soil, course and slope: arrays of shape (soils, courses, slopes), NaN
    where no yaw holds the course.

    Examples
    --------
    >>> import grouser as gr
    >>> found = gr.heading_map(soil=["toyoura", "lunar-nominal"], slope_deg=[5, 10], course_deg=[0, 30])
    >>> on_sand = found.to_xarray().slip_ratio.isel(soil=0)
    >>> bool(on_sand.sel(slope_deg=10, course_deg=30) > on_sand.sel(slope_deg=10, course_deg=0))
    True
    """

    limit_slope_deg: Floats
    """The steepest slope on which the course can be held [°], the same for all slopes; NaN where the
    rover cannot move."""
    limited_by: NDArray[np.object_]
    """What ends the curve there: ``wheels``, ``ground-strength``, ``range`` or ``not-found``, as in
    `Headings`; None where the rover cannot move."""
    soil: tuple[str, ...]
    """The soils' names."""
    course_deg: Floats
    """Directions of travel from the contour [°], positive uphill; shape (courses,)."""
    slope_deg: Floats
    """Slopes [°]; shape (slopes,)."""
    power_w: Floats
    """Power of the motors at the rim speed of the map [W]."""
    band: HeadingMapBand | Any = None
    """The same over samples of soil and model, with ``uncertainty=True``; else None."""

    def _columns(self) -> dict[str, Any]:
        names = (*_HELD, "power_w", "limit_slope_deg", "status", "flags", "limited_by")
        band = {} if self.band is None else self.band._table()
        return {**columns_of(self, names), **band}

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
        """Plots a quantity over slope and course, for one of the soils by its index.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        soil : int
            The soil's index.
        name : str
            The quantity.
        **style
            Arguments of the drawing functions of matplotlib.
        """
        axes = _tables.axes_or_new(axes)
        mesh = axes.pcolormesh(self.slope_deg, self.course_deg, getattr(self, name)[soil], **style)
        axes.figure.colorbar(mesh, ax=axes, label=_tables.label(name))
        axes.set_xlabel("slope [°]")
        axes.set_ylabel("course, positive uphill [°]")
        axes.set_title(self.soil[soil])
        return axes

    def __repr__(self) -> str:
        return f"<HeadingMap of {' × '.join(map(str, self.status.shape))} soils, courses, slopes>"


@overload
def heading_map(
    scenario: Scenario | Source | None = None, /, *, vary: Vary, **asked: Any
) -> Sweep: ...


@overload
def heading_map(
    scenario: Scenario | Source | None = None,
    /,
    *,
    soil: Soil | Source | Sequence[Soil | Source] | None = ...,
    slope_deg: ArrayLike = ...,
    course_deg: ArrayLike = ...,
    rim_speed_m_s: float = ...,
    uncertainty: bool = ...,
    samples: int = ...,
    seed: int = ...,
    **changes: Any,
) -> HeadingMap: ...


def heading_map(
    scenario: Scenario | Source | None = None,
    /,
    *,
    soil: Soils | None = None,
    slope_deg: ArrayLike = _MAP_SLOPES,
    course_deg: ArrayLike = tuple(range(-60, 61, 15)),
    rim_speed_m_s: float = 0.06,
    uncertainty: bool = False,
    samples: int = 200,
    seed: int = 1,
    vary: Vary | None = None,
    outside: Outside = "raise",
    **changes: Any,
) -> HeadingMap | Sweep:
    """The heading offset that holds a course, over soil, course and slope.

    Parameters
    ----------
    scenario : Scenario, name, path or mapping, optional
        As for `heading`.
    soil : Soil, name, path, mapping, or a sequence of them, optional
        The soils; by default the scenario's own.
    slope_deg : array_like, shape (slopes,)
        Slopes [°], 0 to 60.
    course_deg : array_like, shape (courses,)
        Directions of travel from the contour [°], −90 to 90, positive uphill.
    rim_speed_m_s : float
        Rim speed [m/s], for the power.
    uncertainty : bool
        Whether to sample soil and model, for `HeadingMap.band`.
    samples, seed : int
        Number of samples, 2 to 100000, and their seed.
    vary, outside
        As for `heading`; ``soil`` broadcasts then, and courses and slopes are the axes of the `Sweep`.
        With ``uncertainty`` each entry is computed by itself.
    **changes
        Keys of the scenario with other values.

    Returns
    -------
    HeadingMap
        With ``vary`` a `Sweep`.

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `heading`.

    Examples
    --------
    On 10°, how much more slip does a course uphill cost?

    >>> import grouser as gr
    >>> found = gr.heading_map(slope_deg=[5, 10], course_deg=[-30, 0, 30])
    >>> found.slip_ratio.shape                                      # soils, courses, slopes
    (1, 3, 2)
    >>> down, along, up = found.slip_ratio[0, :, 1]
    >>> bool(down < along < up)
    True
    """
    slopes, courses = line("slope_deg", slope_deg), line("course_deg", course_deg)
    speed = number("rim_speed_m_s", rim_speed_m_s)
    if vary is not None:
        keys = changes if soil is None else {**changes, "soil": soil}
        own = ("slope_deg",) if slope_deg is not _MAP_SLOPES or uncertainty else ()
        taken = ("course_deg", *own)
        asked = entered(
            Scenario, scenario, keys, vary, outside, taken, by_document=uncertainty
        )
        axes = {"course_deg": courses, "slope_deg": slopes}
        axes = {name: it for name, it in axes.items() if name not in asked.inputs}
        settings: dict[str, Any] = {"slope_deg": slopes, "course_deg": courses, "seed": seed}
        settings |= {"rim_speed_m_s": speed, "uncertainty": True, "samples": samples}
        if uncertainty:
            swept = of_each(asked, axes, lambda run: heading_map(run, **settings)._table())
        else:
            swept = _core.heading_map_sweep(asked.native, slopes, courses, speed)[:1]
        names = (*_tables.COLUMNS["heading"], "limit_slope_deg")
        return sweep_of(asked, swept, "heading", names, axes)
    one = scenario_of(scenario, changes)
    several = isinstance(soil, Sequence) and not isinstance(soil, str)
    soils: list[Any] = list(soil) if several else [soil]  # type: ignore[arg-type]
    if not soils:
        raise ParameterError("soil is empty, it must be at least one", "soil")
    runs = [one if it is None else one.replace(soil=soil_of(it)) for it in soils]
    found = _core.heading_map([run._document for run in runs], slopes, courses, speed)
    shape = (len(runs), len(courses), len(slopes))
    cells: dict[str, Any] = _tables.arrays_of(found)
    cells = {name: it.reshape(shape) for name, it in cells.items()}
    cells |= {"soil": tuple(run.soil.name for run in runs)}
    cells |= {"course_deg": courses, "slope_deg": slopes}
    band = None
    if uncertainty:
        drawn = whole_number("seed", seed), whole_number("samples", samples, most=2**32 - 1)
        documents = [run._document for run in runs]
        bands, weights = _core.heading_map_band(documents, slopes, courses, *drawn)
        columns = {name: values.reshape(shape) for name, values in bands.items()}
        band = HeadingMapBand(**columns, model_weights=tuple(weights))
    return HeadingMap(**cells, band=band)
