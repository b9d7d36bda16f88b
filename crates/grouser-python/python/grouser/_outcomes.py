"""The table of outcomes: how runs, and legs of missions, end."""

from __future__ import annotations

from typing import NamedTuple

from . import _core


class OutcomeRow(NamedTuple):
    """What is known of all ends of one kind."""

    meaning: str
    """What it means."""
    severity: str
    """``good``; ``stopped``, the rover can drive on; ``stuck``, it cannot by itself; ``lost``, it is
    out of control."""
    in_band: str
    """What a sample that ends so does in a band: it ``counts`` to its end, is ``stuck`` and counts
    from then on as slip 1, sunk to the axles, or ``leaves`` the band then."""
    ends_runs: bool
    """Whether a run can end so; otherwise only a leg of a mission can."""


#: Every outcome of runs and of legs of missions, by its name.
OUTCOMES: dict[str, OutcomeRow] = {row[0]: OutcomeRow(*row[1:]) for row in _core.outcomes()}
