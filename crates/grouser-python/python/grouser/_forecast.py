"""A rover under another gravity than the one its soil was measured under."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Union

from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._arrays import Floats, line, number, whole_number
from ._descriptions import Scenario, Soil, Source
from ._errors import ParameterError
from ._studies import scenario_of, soil_of

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

#: Whose strength and density the ground has: soils, or ``as-measured``.
Grounds = Union[str, Soil, Mapping[str, Any], Sequence[Any]]
#: Ways in which moduli scale.
_SCALINGS = ("reece", "bekker", "granular-scaling")


@dataclass(frozen=True, eq=False)
class Forecast(_tables.Tabular):
    """Slip, drift, heading, power and the steepest slope under the gravity of a site, and the error
    budget, on each ground: arrays with a row for each ground and slope, quantiles over the cases of
    the ground as ``…_p2_5``, ``…_p50`` and ``…_p97_5``. Nothing is averaged over grounds.

    Made by `forecast`, which has an example.
    """

    slope_deg: Floats
    """Slope of each row [°]."""
    columns: Mapping[str, NDArray[Any]]
    """All columns, by the names of the program's table: ``ground``, ``scaling``, ``support`` (what
    the row rests on), ``slip_ratio_p50``, ``yaw_deg_p50``, ``probability_slip_above_limit``,
    ``probability_no_heading``, ``share_model`` …"""
    steepest: Mapping[str, NDArray[Any]]
    """The steepest slope on which a heading holds the contour, with its band, as columns: a row for
    each ground."""
    budget: Mapping[str, NDArray[Any]]
    """The error budget, as columns: for each ground, quantity and slope the part of the variance
    that each factor has."""
    choices: Mapping[str, NDArray[Any]]
    """The means at each level of each factor on each ground, as columns."""
    tests: Mapping[str, NDArray[Any]]
    """What a test of a rover would show where the soil was measured, as columns."""
    notes: tuple[str, ...]
    """What to know beside the numbers."""

    def _table(self) -> Mapping[str, Any]:
        return self.columns

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each ground and slope. `budget`, `choices` and `tests` are tables too:
        ``pandas.DataFrame(forecast.budget)``."""
        return _tables.frame(self.columns)

    def plot(self, axes: Axes | None = None, *, name: str = "slip_ratio", **style: Any) -> Axes:
        """Plots the median of a quantity over the slope and the band of 95 % of the cases, for each
        ground; of rows that no measurement supports the median alone, dashed.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        name : str
            The quantity, such as ``slip_ratio`` or ``power_w``.
        **style
            Arguments of the drawing functions of matplotlib.
        """
        axes = _tables.axes_or_new(axes)
        low, median, high = (self.columns[f"{name}_{end}"] for end in ("p2_5", "p50", "p97_5"))
        grounds, scalings, support = (self.columns[it] for it in ("ground", "scaling", "support"))
        for ground, scaling in dict.fromkeys(zip(grounds.tolist(), scalings.tolist())):
            rows = (grounds == ground) & (scalings == scaling)
            is_supported = support[rows][0] != "none"
            label = ground if is_supported else f"{ground} ({scaling})"
            own = {"linestyle": "-" if is_supported else "--", "label": label, **style}
            (curve,) = axes.plot(self.slope_deg[rows], median[rows], **own)
            if is_supported:
                colour = curve.get_color()
                axes.fill_between(
                    self.slope_deg[rows], low[rows], high[rows],
                    alpha=0.25, color=colour, label=f"95 %, {label}",
                )
        axes.set_xlabel(_tables.label("slope_deg"))
        axes.set_ylabel(_tables.label(name))
        return axes

    def __repr__(self) -> str:
        limits = zip(self.steepest["ground"], self.steepest["limit_slope_deg_p50"])
        steepest = ", ".join(f"{limit:.2f}° on {ground}" for ground, limit in limits)
        return f"<Forecast of {len(self.slope_deg)} rows, steepest slopes (median) {steepest}>"


def forecast(
    scenario: Scenario | Source | None = None,
    /,
    *,
    site: str | float,
    slope_deg: ArrayLike = (5.0, 10.0, 15.0, 20.0),
    scaling: str | Sequence[str] = _SCALINGS,
    ground: Grounds | None = None,
    mass: str | Sequence[str] | Mapping[str, float] = "equal-mass",
    measured_gravity_m_s2: str | float | None = None,
    rim_speed_m_s: float | None = None,
    no_go_slip_ratio: float = 0.6,
    samples: int = 12,
    discrepancies: int = 4,
    seed: int = 1,
    **changes: Any,
) -> Forecast:
    """Slip, drift, heading, steepest slope and mechanical power under another gravity than the one
    the soil was measured under, on each ground by itself, with an error budget for each. The numbers
    are those of the program's ``grouser forecast``, bit for bit.

    Within a ground every choice meets every other, every wheel–soil model, every sample of the soil
    and every sample of the model's error; ``docs/guide/forecast.md`` explains them. Moduli that are
    kept under another gravity (``bekker``) have rows of their own.

    Parameters
    ----------
    scenario : Scenario, name, path or mapping, optional
        Its rover, soil, model, load transfer and rim speed are used.
    site : str or float
        ``earth``, ``moon``, ``mars``, or the site's gravity [m/s²].
    slope_deg : array_like, shape (slopes,)
        Slopes [°], 0 to 60.
    scaling : str or sequence of str
        How moduli scale with gravity: ``reece``, ``bekker``, ``granular-scaling``.
    ground : Soil, name, path, mapping, or a sequence of them, optional
        Whose cohesion, friction angle and density the ground of the site has; ``"as-measured"`` for
        the soil's own. Without it that, and on the Moon ``lunar-nominal`` and ``lunar-0-15-cm``.
    mass : str, sequence of str, or mapping of str to float
        The rover's mass: ``equal-mass``, ``equal-weight``, or names with factors on the mass of its
        document: ``{"flight": 0.65}``.
    measured_gravity_m_s2 : str or float, optional
        Gravity under which the soil was measured; without it that of the soil's domain, or else the
        Earth's.
    rim_speed_m_s : float, optional
        Rim speed [m/s], for the power; without it the scenario's.
    no_go_slip_ratio : float
        Slip ratio of which to say how probably it is exceeded, 0 to 1.
    samples, discrepancies : int
        Number of samples of the soil, 2 to 10000, and of the model's error, 2 to 1000.
    seed : int
        Seed of the samples.
    **changes
        Keys of the scenario with other values: ``soil="toyoura"``, ``rover="hakuto"``.

    Returns
    -------
    Forecast

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `heading`, and for choices that do not exist or are named twice.

    Examples
    --------
    >>> import grouser as gr
    >>> moon = gr.forecast(site="moon", slope_deg=[10.0], samples=2, discrepancies=2, model="ishigami")
    >>> moon.columns["ground"].tolist()[:3]
    ['as-measured', 'lunar-nominal', 'lunar-0-15-cm']
    >>> bool(moon.columns["slip_ratio_p50"][0] > moon.columns["slip_ratio_p50"][2])
    True
    >>> sorted(set(moon.budget["quantity"].tolist()))
    ['downhill_m_per_m', 'limit_slope_deg', 'slip_ratio']
    """
    if "gravity_m_s2" in changes:
        raise ParameterError("gravity_m_s2 is that of the site: give site", "gravity_m_s2")
    gravity = _gravity("site", site)
    run = scenario_of(scenario, {**changes, "gravity_m_s2": gravity})
    measured = measured_gravity_m_s2
    masses = mass
    if isinstance(mass, Mapping):
        masses = [f"{name}={number(f'mass of {name}', factor)!r}" for name, factor in mass.items()]
    choices = (
        None if ground is None else _once("ground", _grounds(ground)),
        _once("scaling", _names("scaling", scaling)),
        _once("mass", _names("mass", masses)),
    )
    found = _core.forecast(
        run._document,
        line("slope_deg", slope_deg),
        None if measured is None else _gravity("measured_gravity_m_s2", measured),
        choices,
        None if rim_speed_m_s is None else number("rim_speed_m_s", rim_speed_m_s),
        number("no_go_slip_ratio", no_go_slip_ratio),
        [
            whole_number("samples", samples, most=2**32 - 1),
            whole_number("discrepancies", discrepancies, most=2**32 - 1),
        ],
        whole_number("seed", seed),
    )
    names = ("rows", "steepest", "budget", "choices", "tests")
    tables = {name: _tables.arrays_of(found[name]) for name in names}
    rows = tables.pop("rows")
    return Forecast(
        slope_deg=rows["slope_deg"],
        columns=rows,
        notes=tuple(found["notes"]),
        **tables,
    )


def _gravity(name: str, value: str | float) -> float:
    if not isinstance(value, str):
        return number(name, value)
    gravity = _core.gravity_of(value)
    if gravity is None:
        known = "earth, moon, mars or a number"
        raise ParameterError(f"{name} is {value!r}, it must be {known}", name, None, known)
    return gravity


def _grounds(ground: Any) -> list[tuple[str, _core.Document | None]]:
    """Names of grounds, each with its soil where it is not the one that was measured."""
    is_several = isinstance(ground, Sequence) and not isinstance(ground, str)
    found: list[tuple[str, _core.Document | None]] = []
    for one in ground if is_several else [ground]:
        if isinstance(one, str) and one == "as-measured":
            found.append((one, None))
        else:
            soil = soil_of(one)
            found.append((one if isinstance(one, str) else str(soil.name), soil._document))
    return found


def _names(name: str, given: Any) -> list[str]:
    several = [given] if isinstance(given, str) else list(given)
    for one in several:
        if not isinstance(one, str):
            kind = type(one).__name__
            raise ParameterError(f"{name} has a name of type {kind}, it must be text", name)
    return several


def _once(name: str, items: list[Any]) -> list[Any]:
    """A list in which no name stands twice: it would count twice."""
    names = [item[0] if isinstance(item, tuple) else item.partition("=")[0] for item in items]
    for place, one in enumerate(names):
        if one in names[:place]:
            raise ParameterError(f"{name}: {one} is named twice", name)
    return items
