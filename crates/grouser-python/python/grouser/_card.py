"""The operator's card: for each slope whether to go, which heading to set, and where to stop."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._arrays import Floats, line, number, whole_number
from ._descriptions import Scenario, Source
from ._errors import ParameterError
from ._studies import scenario_of
from ._sweeps import Sweep, Vary, entered, of_each, sweep_of
from ._verdicts import limits_of
from ._wheels import Outside

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True, eq=False)
class CardCourses(_tables.Tabular):
    """The second page of a card: other courses, a row for each course and slope that may be
    driven along the contour.

    Made by `card`, which has an example.
    """

    slope_deg: Floats
    """Slopes [°]."""
    course: NDArray[np.object_]
    """``up``, ``back-down``, ``down``, ``back-up``, ``back-across``, ``turn`` or
    ``turn-on-the-spot``."""
    verdict: NDArray[np.object_]
    """``go``, ``caution``, ``cannot_tell`` or ``no_go``."""
    columns: Mapping[str, NDArray[Any]]
    """All columns, by the names of the program's table; ``reason`` is what decides the verdict."""

    def _table(self) -> Mapping[str, Any]:
        return self.columns

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each course and slope."""
        return _tables.frame(self.columns)

    def __repr__(self) -> str:
        return f"<CardCourses with {len(self.course)} rows>"


@dataclass(frozen=True, eq=False)
class Card(_tables.Tabular):
    """The numbers of an operator's card: arrays of shape (slopes,), NaN where there is no number.

    The attributes are what a driver sets and reads first; `columns` has all that the program's
    table has, with bands over the samples.

    Made by `card`, which has an example.
    """

    slope_deg: Floats
    """Slopes [°]."""
    verdict: NDArray[np.object_]
    """``go``, ``caution``, ``cannot_tell`` or ``no_go``. Where the soil's document states no
    uncertainty nobody can tell a go."""
    reason: NDArray[np.object_]
    """What decides the verdict, in a word: ``all_met``, ``share_that_holds``, ``stuck``, ``drift``,
    ``friction_margin``, ``no_stated_uncertainty`` …"""
    probability_stuck: Floats
    """Share of ways of 10 m on which a rover that is driven so gets stuck, although its slip is
    looked at as often as the card says [-]; NaN where it is not driven. Without these looks it is
    ``probability_stuck_without_checks`` among the `columns`."""
    yaw_deg: Floats
    """Heading to set [°], positive uphill: the median over all samples; NaN where no heading holds
    the contour in half of them."""
    roll_deg: Floats
    """Roll that instruments show then [°]."""
    pitch_deg: Floats
    """Pitch that they show [°]."""
    correct_every_m: Floats
    """Way after which the heading is to be set again [m]; NaN on no-go slopes, and where the rover
    holds it by itself."""
    slip_limit: Floats
    """Slip ratio above which to turn back [-]."""
    slip_check_every_m: Floats
    """Way between two looks at the slip [m]; NaN where the shortest that is tried is too long."""
    flags: NDArray[np.object_]
    """Why each row is an extrapolation: names of `FLAGS`, joined by ``;``."""
    columns: Mapping[str, NDArray[Any]]
    """All columns, by the names of the program's table."""
    courses: CardCourses
    """The second page: other courses, to get there and to get out."""
    steepest: Mapping[str, Any]
    """Number of samples (``draws``), and the steepest slope on which a heading holds the contour,
    with its band; and ``d_limit_slope_deg_d_<key>``, what the friction angle, the cohesion and the
    body's mass are worth there on the soil as written."""

    def _table(self) -> Mapping[str, Any]:
        return self.columns

    def _shown(self) -> Mapping[str, Any]:
        return {name: self.columns[name] for name in _SHOWN}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each slope."""
        return _tables.frame(self.columns)

    def __repr__(self) -> str:
        goes = self.slope_deg[self.verdict == "go"]
        upto = f"up to {goes.max():g}°" if goes.size else "on no slope"
        return f"<Card of {len(self.slope_deg)} slopes, go {upto}>"


#: What a driver sets and reads first: all but the tables.
_SHOWN = tuple(one.name for one in fields(Card)[:-3])


@overload
def card(
    scenario: Scenario | Source | None = None, /, *, vary: Vary, **asked: Any
) -> Sweep: ...


@overload
def card(
    scenario: Scenario | Source | None = None,
    /,
    *,
    slope_deg: ArrayLike | None = ...,
    samples: int = ...,
    seed: int = ...,
    rim_speed_m_s: float | None = ...,
    uphill: Literal["left", "right"] = ...,
    rule: Mapping[str, float] | None = ...,
    holds_heading: bool = ...,
    accept_contradiction: bool = ...,
    **changes: Any,
) -> Card: ...


def card(
    scenario: Scenario | Source | None = None,
    /,
    *,
    slope_deg: ArrayLike | None = None,
    samples: int = 200,
    seed: int = 1,
    rim_speed_m_s: float | None = None,
    uphill: Literal["left", "right"] = "left",
    rule: Mapping[str, float] | None = None,
    holds_heading: bool = False,
    accept_contradiction: bool = False,
    vary: Vary | None = None,
    outside: Outside = "raise",
    **changes: Any,
) -> Card | Sweep:
    """The operator's card: on each slope whether to go, which heading to set, how often to set it
    again, and where to stop.

    The numbers are those of the program's ``grouser card``, bit for bit. The printed page is
    the program's: write ``scenario.to_toml()`` into a file and run ``grouser card FILE --out
    card.pdf``.

    Parameters
    ----------
    scenario : Scenario, name, path or mapping, optional
        Its rover, soil, gravity, model, load transfer and rim speed are used.
    slope_deg : array_like, shape (slopes,), optional
        Slopes [°], 0 to 60, rising; without them each whole degree, as the program takes them. A
        verdict depends on its slope alone. The heading is to be set again, and the slip to be
        looked at, no less often than on the gentler slopes.
    samples : int
        Number of samples of soil and model, 2 to 100000.
    seed : int
        Seed of the samples: the same seed gives the same soils and models.
    rim_speed_m_s : float, optional
        Rim speed [m/s]; without it the scenario's.
    uphill : {"left", "right"}
        The side of the rover that is uphill.
    rule : mapping, optional
        Limits of the verdicts, any of these. Go: a heading holds the contour and slips at most
        ``go_slip_ratio`` (0.3) in at least the share ``go_probability`` (0.95) of the samples, and
        in 97.5 % of them the rover drifts at most ``go_drift_m_per_m`` (0.1). No-go: no heading
        holds the contour, or it slips more than ``no_go_slip_ratio`` (0.6), in the share
        ``no_go_probability`` (0.2) of the samples or more, or the rover gets stuck as often.
    holds_heading : bool
        Whether the rover holds its heading by itself. Then its nose does not fall, and nobody sets
        it again.
    accept_contradiction : bool
        Whether a soil is taken whose document says that what was learnt contradicts itself.
    vary, outside
        As for `heading`: each entry is a card of its own, and slopes are the axis of the `Sweep`.
    **changes
        Keys of the scenario with other values.

    Returns
    -------
    Card
        With ``vary`` a `Sweep` of its rows.

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `Scenario`; and for slopes that do not rise, or a rule in which a go asks for less than
        a no-go, or a soil that contradicts itself.

    Examples
    --------
    >>> import grouser as gr
    >>> card = gr.card(soil="toyoura-uncertain", slope_deg=[5.0, 40.0], samples=12)
    >>> card.verdict.tolist()
    ['go', 'no_go']
    >>> bool(card.roll_deg[0] <= 5.0 and card.correct_every_m[0] >= 0.1)
    True
    >>> card.courses.to_pandas().query("course == 'back-across'")["verdict"].tolist()
    ['go']
    """
    slopes = np.arange(61.0) if slope_deg is None else line("slope_deg", slope_deg)
    if vary is not None:
        asked = entered(
            Scenario, scenario, changes, vary, outside, ("slope_deg",), by_document=True
        )
        settings: dict[str, Any] = {"slope_deg": slopes, "samples": samples, "seed": seed}
        settings |= {"rim_speed_m_s": rim_speed_m_s, "uphill": uphill, "rule": rule}
        settings |= {"holds_heading": holds_heading, "accept_contradiction": accept_contradiction}
        axes = {"slope_deg": slopes}
        cards = of_each(asked, axes, lambda run: card(run, **settings).columns)
        return sweep_of(asked, cards, "card", ("yaw_deg",), axes)
    run = scenario_of(scenario, changes)
    if uphill not in ("left", "right"):
        raise ParameterError(f"uphill {uphill!r}: it must be 'left' or 'right'", "uphill")
    speed = None if rim_speed_m_s is None else number("rim_speed_m_s", rim_speed_m_s)
    draws = (whole_number("seed", seed), whole_number("samples", samples, most=2**32 - 1))
    rows, courses, steepest = _core.card(
        run._document, slopes, draws, speed, (uphill == "right", holds_heading, accept_contradiction), limits_of(rule)
    )
    rows, courses = _tables.arrays_of(rows), _tables.arrays_of(courses)
    of_course = ("slope_deg", "course", "verdict")
    second = CardCourses(**{name: courses[name] for name in of_course}, columns=courses)
    first = {name: rows[name] for name in _SHOWN}
    return Card(**first, columns=rows, courses=second, steepest=steepest)
