"""Where a rover can go on a map of heights."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from . import _core, _tables
from ._arrays import number, whole_number
from ._descriptions import Scenario, Source
from ._studies import scenario_of
from ._terrain import Terrain, carried, native_of
from ._verdicts import ADVICE

if TYPE_CHECKING:
    import xarray


def map(
    terrain: Terrain,
    scenario: Scenario | Source | None = None,
    /,
    *,
    course_deg: float | Literal["best", "worst"] = 0.0,
    rim_speed_m_s: float | None = None,
    samples: int = 200,
    seed: int = 1,
    **changes: Any,
) -> xarray.Dataset:
    """What a rover does at every point of a map of heights, as if it drove steadily on a plane as
    steep.

    Parameters
    ----------
    terrain : Terrain
        The heights.
    scenario : Scenario, name, path or mapping, optional
        Rover, soil, gravity and model, as for `heading`.
    course_deg : float, "best" or "worst"
        Direction of travel [°], −90 to 90: 0 along the contour with the hill on the left, positive
        uphill. ``"best"`` takes at each point the course that is least often a no-go, and of
        several the one with the least slip, ``"worst"`` the opposite.
    rim_speed_m_s : float, optional
        Rim speed [m/s], for the power; by default the scenario's.
    samples, seed : int
        How many samples of soil and model the probability of a no-go and the advice are over, and
        their seed.
    **changes
        Keys of the scenario with other values.

    Returns
    -------
    xarray.Dataset
        A variable for each number, with its unit and what it is in ``attrs``, over ``y`` from north
        to south and ``x`` from west to east [m]; NaN where the height is missing, and but for the
        slope, the verdict and the probability where no heading holds the course. ``verdict`` is 1
        go, 2 caution, 3 no-go, 4 cannot tell: the advice for the whole degree above the slope of
        the place. That advice is over ``advice_slope_deg``, up to the steepest slope of the map:
        ``advice_verdict``, ``advice_reason`` (what decides it), ``advice_probability_stuck``, the
        heading to set, ``advice_yaw_deg``, with its band (``…_p2_5``, ``…_p97_5``), and the course
        that it is for, ``advice_course_deg``. The dataset's ``attrs`` say how far numbers are at
        most from those of `heading_map` for the same slope.

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `heading`.

    Examples
    --------
    Where on a hill does the rover slip most, along the contour?

    >>> import numpy as np
    >>> import grouser as gr
    >>> x = y = np.linspace(-20.0, 20.0, 41)
    >>> hill = gr.Terrain(
    ...     3.0 * np.exp(-(x**2 + y[:, None] ** 2) / 100.0),
    ...     cell_size_m=1.0,
    ...     south_west_m=(-20.0, -20.0),
    ... )
    >>> found = gr.map(hill, model="ishigami", samples=10)
    >>> found.slip_ratio.dims, found.slip_ratio.attrs["units"]
    (('y', 'x'), '-')
    >>> steepest = found.slope_deg.where(found.slip_ratio == found.slip_ratio.max())
    >>> bool(steepest.max() == found.slope_deg.max())
    True
    >>> str(found.advice_reason.isel(advice_slope_deg=5).values)
    'no_stated_uncertainty'
    """
    import xarray

    ground = native_of(terrain)
    run = scenario_of(scenario, changes)
    course = course_deg if isinstance(course_deg, str) else number("course_deg", course_deg)
    speed = None if rim_speed_m_s is None else number("rim_speed_m_s", rim_speed_m_s)
    drawn = whole_number("samples", samples, most=2**32 - 1), whole_number("seed", seed)
    bands, x, y, about = _core.mobility_map(run._document, ground, course, speed, *drawn)
    variables = {
        name: (("y", "x"), values, {"units": unit, "long_name": doc})
        for name, unit, doc, values in bands
    }
    places = {"units": "m", "standard_name": "projection_{}_coordinate"}
    coordinates = {
        name: ((name,), values, {**places, "standard_name": places["standard_name"].format(name)})
        for name, values in (("y", y), ("x", x))
    }
    variables |= _tables.described("advice_slope_deg", ADVICE, about.pop("advice"), "advice_")
    notes = {"course_deg": course_deg, "samples": samples, "seed": seed, **about}
    return carried(xarray.Dataset(variables, coords=coordinates, attrs=notes), terrain)
