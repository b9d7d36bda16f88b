"""Wheels at speeds of their own, at which a rover crosses a slope straight along the contour."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._arrays import Floats, line, number
from ._descriptions import Scenario, Source
from ._errors import ParameterError
from ._models import ByModel, each_model
from ._studies import columns_of, scenario_of
from ._sweeps import Sweep, Vary, entered, sweep_of
from ._wheels import Outside

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes

_RESULTS = _tables.COLUMNS["wheel_speeds"]
(_OF_WHEEL,) = _tables.COLUMNS["wheel_speeds_of_wheel"]
#: Slopes [°].
_SLOPES = (5.0, 10.0, 15.0, 20.0)
#: Which wheels have a speed in common, on each slope and at the limit: rows of the program's tables.
_ON_SLOPES = ("alike", "by-side", "by-wheel")


@dataclass(frozen=True, eq=False)
class WheelSpeedLimits(_tables.Tabular):
    """The steepest slopes on which a rover holds the contour, and what is driven there: arrays of
    shape (freedoms,), NaN where nothing was found.

    Made by `wheel_speeds`, as `WheelSpeeds.limits`.
    """

    wheel_names: tuple[str, ...]
    """The wheels, in the order of their mounts."""
    wheels: tuple[str, ...]
    """Which wheels have a speed in common: ``alike``, ``by-side`` and ``by-wheel`` as in
    `WheelSpeeds`; ``uphill-reversed``: none, and those of the uphill side turn backward or stand."""
    limit_slope_deg: Floats
    """The steepest slope on which the contour is held [°]."""
    yaw_deg: Floats
    """Yaw that holds the contour [°], positive uphill."""
    slip_ratio: Floats
    """Mean slip ratio of the wheels [-]."""
    sinkage_mm: Floats
    """Mean sinkage of the wheels [mm]."""
    torque_nm: Floats
    """Torque of all wheels together [N·m]."""
    energy_j_per_m: Floats
    """Work of the motors per metre along the contour [J/m]; a wheel that is dragged gives nothing
    back."""
    yaw_moment_nm: Floats
    """Yaw moment left over [N·m]; negative turns the nose downhill. Wheels at speeds of their own
    leave none."""
    yaw_growth_per_m: Floats
    """How fast a small error of the yaw grows over the way [1/m], of a motion that is steady;
    negative where it fades."""
    speed_ratio: Floats
    """Rim speed over the rover's speed [-]; negative backward; shape (freedoms, wheels)."""
    limit_reason: NDArray[np.object_]
    """What ends the slopes there."""
    limited_by: NDArray[np.object_]
    """The same in a word, of wheels that turn alike, as in `Headings`; else None."""

    def _table(self) -> dict[str, Any]:
        wheels = np.array(self.wheels, dtype=object)
        reasons = columns_of(self, ("limit_reason", "limited_by"))
        numbers = columns_of(self, ("limit_slope_deg", *_RESULTS))
        return {"wheels": wheels, **numbers, **_each_wheel(self), **reasons}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each freedom, as the program has it."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``wheels``, and over ``wheels`` and ``wheel`` for ``speed_ratio``."""
        columns = columns_of(self, ("limit_slope_deg", *_RESULTS, "limit_reason", "limited_by"))
        return _with_wheels(self, _tables.dataset(("wheels",), columns, {"wheels": self.wheels}))

    def __repr__(self) -> str:
        each = zip(self.wheels, self.limit_slope_deg)
        limits = (f"{name} {'none' if np.isnan(it) else f'{it:.2f}°'}" for name, it in each)
        return f"<WheelSpeedLimits: {', '.join(limits)}>"


@dataclass(frozen=True, eq=False)
class WheelSpeeds(_tables.Tabular):
    """Speeds of sides and of wheels at which a rover crosses slopes straight along the contour:
    arrays of shape (slopes, freedoms), NaN where none were found.

    Examples
    --------
    >>> import grouser as gr
    >>> found = gr.wheel_speeds(slope_deg=[10.0])
    >>> found.wheels
    ('alike', 'by-side', 'by-wheel')
    >>> bool((found.yaw_moment_nm[0, 1:] == 0.0).all())             # the nose does not fall
    True
    >>> data = found.to_xarray().sel(slope_deg=10.0, wheels="by-side").speed_ratio
    >>> bool(data.sel(wheel="front-right") > data.sel(wheel="front-left"))     # downhill is right
    True
    """

    wheel_names: tuple[str, ...]
    """The wheels, in the order of their mounts."""
    wheels: tuple[str, ...]
    """Which wheels have a speed in common: ``alike``, all, as in `Headings`; ``by-side``, those of
    a side; ``by-wheel``, none."""
    slope_deg: Floats
    """Slopes [°]; shape (slopes,)."""
    yaw_deg: Floats
    """Yaw that holds the contour [°], positive uphill."""
    slip_ratio: Floats
    """Mean slip ratio of the wheels [-]."""
    sinkage_mm: Floats
    """Mean sinkage of the wheels [mm]."""
    torque_nm: Floats
    """Torque of all wheels together [N·m]."""
    energy_j_per_m: Floats
    """Work of the motors per metre along the contour [J/m]; a wheel that is dragged gives nothing
    back."""
    yaw_moment_nm: Floats
    """Yaw moment left over [N·m]; negative turns the nose downhill. Wheels at speeds of their own
    leave none."""
    yaw_growth_per_m: Floats
    """How fast a small error of the yaw grows over the way [1/m], of a motion that is steady;
    negative where it fades."""
    speed_ratio: Floats
    """Rim speed over the rover's speed [-]; negative backward; shape (slopes, freedoms, wheels)."""
    status: NDArray[np.object_]
    """``ok``, or why the contour is not held."""
    flags: NDArray[np.object_]
    """Why each row is an extrapolation: names of `FLAGS`, joined by ``;``."""
    limits: WheelSpeedLimits
    """The steepest slopes."""

    def _table(self) -> dict[str, Any]:
        wheels = np.array(self.wheels, dtype=object)
        slope, wheels = np.meshgrid(self.slope_deg, wheels, indexing="ij")
        ends = columns_of(self, ("status", "flags"))
        numbers = columns_of(self, _RESULTS)
        return {"slope_deg": slope, "wheels": wheels, **numbers, **_each_wheel(self), **ends}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each slope and freedom; columns of a wheel start with its name, as
        in ``front-left.speed_ratio``, as the program's CSV has them."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``slope_deg`` and ``wheels``, and ``wheel`` for ``speed_ratio``, with units
        in the attributes."""
        columns = columns_of(self, (*_RESULTS, "status", "flags"))
        coords = {"slope_deg": self.slope_deg, "wheels": self.wheels}
        return _with_wheels(self, _tables.dataset(tuple(coords), columns, coords))

    def plot(
        self, axes: Axes | None = None, *, wheels: str = "by-side", **style: Any
    ) -> Axes:
        """Plots the speed of each wheel over the slope.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        wheels : {"alike", "by-side", "by-wheel"}
            Which wheels have a speed in common.
        **style
            Arguments of ``Axes.plot``; a ``label`` stands before the wheels' names.
        """
        if wheels not in self.wheels:
            known = ", ".join(self.wheels)
            raise ParameterError(f"wheels is {wheels!r}, it must be of {known}", "wheels")
        axes = _tables.axes_or_new(axes)
        before = style.pop("label", None)
        speeds = self.speed_ratio[:, self.wheels.index(wheels)]
        for name, speed in zip(self.wheel_names, speeds.T):
            label = name if before is None else f"{before}, {name}"
            look = {"marker": "o", "markersize": 4.0, "label": label, **style}
            axes.plot(self.slope_deg, speed, **look)
        axes.set_xlabel("slope [°]")
        axes.set_ylabel("rim speed over the rover's speed")
        return axes

    def __repr__(self) -> str:
        held, all_of_them = np.count_nonzero(self.status == "ok"), self.status.size
        return f"<WheelSpeeds on {len(self.slope_deg)} slopes, {held} of {all_of_them} hold the contour>"


def _each_wheel(found: WheelSpeeds | WheelSpeedLimits) -> dict[str, Floats]:
    """The speeds as columns of the program's table."""
    names = enumerate(found.wheel_names)
    return {f"{name}.{_OF_WHEEL}": found.speed_ratio[..., k] for k, name in names}


def _with_wheels(
    found: WheelSpeeds | WheelSpeedLimits, data: xarray.Dataset
) -> xarray.Dataset:
    """A dataset with the speeds of the wheels."""
    dims = (*data.yaw_deg.dims, "wheel")
    data[_OF_WHEEL] = _tables.variable(dims, _OF_WHEEL, found.speed_ratio)
    return data.assign_coords(wheel=list(found.wheel_names))


@overload
def wheel_speeds(
    scenario: Scenario | Source | None = None, /, *, vary: Vary, model: Literal["all"], **asked: Any
) -> ByModel[Sweep]: ...


@overload
def wheel_speeds(
    scenario: Scenario | Source | None = None, /, *, vary: Vary, **asked: Any
) -> Sweep: ...


@overload
def wheel_speeds(
    scenario: Scenario | Source | None = None, /, *, model: Literal["all"], **asked: Any
) -> ByModel[WheelSpeeds]: ...


@overload
def wheel_speeds(
    scenario: Scenario | Source | None = None,
    /,
    *,
    model: str | None = ...,
    slope_deg: ArrayLike = ...,
    most_speed_ratio: float = ...,
    **changes: Any,
) -> WheelSpeeds: ...


def wheel_speeds(
    scenario: Scenario | Source | None = None,
    /,
    *,
    model: str | None = None,
    slope_deg: ArrayLike = _SLOPES,
    most_speed_ratio: float = 2.0,
    vary: Vary | None = None,
    outside: Outside = "raise",
    **changes: Any,
) -> WheelSpeeds | Sweep | ByModel[WheelSpeeds] | ByModel[Sweep]:
    """Speeds of wheels at which a rover crosses slopes straight along the contour, with its yaw
    moment balanced.

    With one speed for all wheels the forces are balanced and the yaw moment is left over: it turns
    the nose, unless something holds it. With a speed for each side, or for each wheel, nothing is
    left over. Of all such motions the one with the least work per metre is found on each slope, and
    the one on the steepest slope. The numbers are those of the program's
    ``grouser heading --wheel-speeds``, bit for bit.

    Parameters
    ----------
    scenario : Scenario, name, path or mapping, optional
        As for `heading`.
    model : str, optional
        The wheel–soil model, or ``"all"`` for the results of each; by default that of the scenario
        or of its soil.
    slope_deg : array_like, shape (slopes,)
        Slopes [°], 0 to 60.
    most_speed_ratio : float
        The fastest wheel's speed over the mean of all, at most [-]; above 1.
    vary, outside
        As for a nominal `heading`: the axes of the `Sweep` are ``slope_deg`` and ``wheels``, and its
        ``limits`` has those of `WheelSpeeds.limits`.
    **changes
        Keys of the scenario with other values.

    Returns
    -------
    WheelSpeeds
        With ``vary`` a `Sweep`; for all models `ByModel` of either.

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `heading`. A slope on which no speeds hold the contour is a result, not an error.

    Examples
    --------
    By how much must the downhill wheels turn faster on 10° such that the nose does not fall, and how
    much steeper a slope can be crossed?

    >>> import grouser as gr
    >>> found = gr.wheel_speeds(slope_deg=[10.0])
    >>> by_side = found.wheels.index("by-side")
    >>> left, right = found.speed_ratio[0, by_side, [0, 2]]
    >>> f"{100 * (right / left - 1):.1f} %"
    '2.4 %'
    >>> {name: round(float(it), 2) for name, it in zip(found.limits.wheels, found.limits.limit_slope_deg)}
    {'alike': 20.24, 'by-side': 20.19, 'by-wheel': 20.21, 'uphill-reversed': nan}

    In a leg of a mission they hold the contour, without anything that corrects the heading:

    >>> leg = {
    ...     "drive_m": 2.0,
    ...     "yaw_deg": float(found.yaw_deg[0, by_side]),
    ...     "speed_m_s": (0.06 * found.speed_ratio[0, by_side]).tolist(),
    ... }
    >>> driven = gr.mission({"name": "crossing", "slope_deg": 10.0, "leg": [leg]})
    >>> driven.outcome, bool(abs(driven.y_m) < 1e-3)
    ('completed', True)
    """
    if model == "all":
        settings: dict[str, Any] = {"slope_deg": slope_deg, "most_speed_ratio": most_speed_ratio}
        settings |= {"vary": vary, "outside": outside}
        return each_model(lambda name: wheel_speeds(scenario, model=name, **settings, **changes))
    changes = changes if model is None else {**changes, "model": model}
    slopes, most = line("slope_deg", slope_deg), number("most_speed_ratio", most_speed_ratio)
    if vary is not None:
        taken = ("slope_deg",) if slope_deg is not _SLOPES else ()
        asked = entered(Scenario, scenario, changes, vary, outside, taken)
        swept = _core.wheel_speeds_sweep(asked.native, slopes, most)
        axes = {"slope_deg": slopes, "wheels": _ON_SLOPES}
        axes = {name: it for name, it in axes.items() if name not in asked.inputs}
        ends = {"wheels": (*_ON_SLOPES, "uphill-reversed")}
        return sweep_of(asked, swept, "wheel_speeds", _RESULTS, axes, limits=ends)
    run = scenario_of(scenario, changes)
    found, limits, names = _core.wheel_speeds(run._document, slopes, most)
    shape = (len(slopes), len(_ON_SLOPES))
    of_wheel = _speeds_of(limits, names)
    texts = ("limit_reason", "limited_by")
    return WheelSpeeds(
        wheel_names=tuple(names),
        wheels=_ON_SLOPES,
        slope_deg=slopes,
        **{name: found[name].reshape(shape) for name in _RESULTS},
        speed_ratio=_speeds_of(found, names).reshape(*shape, len(names)),
        status=np.array(found["status"], dtype=object).reshape(shape),
        flags=np.array(found["flags"], dtype=object).reshape(shape),
        limits=WheelSpeedLimits(
            wheel_names=tuple(names),
            wheels=tuple(limits["wheels"]),
            **{name: limits[name] for name in ("limit_slope_deg", *_RESULTS)},
            speed_ratio=of_wheel,
            **{name: np.array(limits[name], dtype=object) for name in texts},
        ),
    )


def _speeds_of(table: dict[str, Any], names: list[str]) -> Floats:
    """The wheels' columns as one array of shape (rows, wheels); without rows there are none."""
    columns = [table.get(f"{name}.{_OF_WHEEL}", np.zeros(0)) for name in names]
    return np.stack(columns, axis=-1)
