"""A step of a run, linearised."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ._arrays import Floats


@dataclass(frozen=True, eq=False)
class LinearStep:
    """The slopes of a control step: next_state ≈ next_state₀ + A (state − state₀) + B (commands −
    commands₀), by `Run.linearise`.

    The state has pose and velocities, in the order and units of `Run.STATE`. For a rover whose
    motors' speed depends on their load, each wheel's speed and the voltage that the integral of its
    controller adds follow. Batteries and windings are not in it.

    Attributes
    ----------
    states : tuple of str
        Names of the numbers of the state, with units.
    commands : tuple of str
        Names of the commands, with units: one for each wheel.
    state, next_state : ndarray, shape (states,)
        The state before the step and after it.
    slopes : ndarray, shape (states, states + commands)
        `A` and `B`, side by side.
    one_sided : ndarray of bool, shape (states, states + commands)
        Where the slopes below and above differ: the step has a kink there, or bends within a
        difference's step.

    Examples
    --------
    How much further does a rover get in half a second if its right rims turn 1 cm/s faster, and how
    far does it turn meanwhile?

    >>> import grouser as gr
    >>> rover = gr.Run(slope_deg=10.0, commands="rim_speed_m_s")
    >>> state = rover.step(0.06, 1.0)
    >>> linear = rover.linearise(0.06, 0.5)
    >>> linear.A.shape, linear.B.shape
    ((6, 6), (6, 4))
    >>> change = linear.B @ [0.0, 0.0, 0.01, 0.01]
    >>> moved = dict(zip(linear.states, change.round(3).tolist()))
    >>> 0.001 < moved["x_m"] < 0.005, 0.1 < moved["yaw_deg"] < 1.0
    (True, True)
    """

    states: tuple[str, ...]
    commands: tuple[str, ...]
    state: Floats
    next_state: Floats
    slopes: Floats
    one_sided: NDArray[np.bool_]

    @property
    def A(self) -> Floats:
        """Slopes of the next state by the state: a row for each number of the next state, in its
        unit over that of the state's number."""
        return self.slopes[:, : len(self.states)]

    @property
    def B(self) -> Floats:
        """Slopes of the next state by the commands: a row for each number of the next state."""
        return self.slopes[:, len(self.states) :]

    @property
    def kinks(self) -> list[tuple[str, str]]:
        """Where ``one_sided`` is True: names of a number of the next state, and of the number of the
        state or the command."""
        by = (*self.states, *self.commands)
        return [(self.states[row], by[column]) for row, column in np.argwhere(self.one_sided)]

    def __repr__(self) -> str:
        kinks = f", {len(self.kinks)} kinks" if self.kinks else ""
        return f"<LinearStep: {len(self.states)} states, {len(self.commands)} commands{kinks}>"
