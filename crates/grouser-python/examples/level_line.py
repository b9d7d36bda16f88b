"""Holds the contour line on slopes of unknown soil: a baseline, compared with a constant command.

    python level_line.py [EPISODES]

A rover that drives straight on drifts downhill. The heading offset that compensates for it depends
on the slope and the soil, and the controller observes neither: the integral of its offset finds it.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

import grouser.gym  # noqa: F401  (it registers the environment)

Floats = NDArray[np.float64]
#: From observations, a row for each rover, to actions.
Controller = Callable[[Floats], Floats]

#: Rim speed as a share of the fastest: 6 cm/s, as in the source paper's experiments.
DRIVE = 0.6
#: Desired yaw per offset [°/m], and per integral of the offset [°/(m s)].
YAW_PER_OFFSET = 120.0
YAW_PER_INTEGRAL = 6.0
#: Limit of the desired yaw and of its integral part [°]: beyond any heading offset on these slopes.
MOST_YAW = 25.0
#: Turn per error of the yaw [1/°].
TURN_PER_YAW = 0.04


def straight_on(observations: Floats) -> Floats:
    """The constant command: drive, and do not turn."""
    return np.tile([DRIVE, 0.0], (len(observations), 1))


class LevelLine:
    """A PI controller of the offset sets the desired yaw, a P controller turns the rover to it."""

    def __init__(self, dt_s: float = 0.5) -> None:
        self.dt_s = dt_s
        self.integral: Floats = np.zeros(0)

    def __call__(self, observations: Floats) -> Floats:
        y_m, yaw_deg = observations[:, 0], observations[:, 1]
        if len(self.integral) != len(y_m):
            self.integral = np.zeros(len(y_m))
        # The integral must not grow while the desired yaw is at its limit.
        most = MOST_YAW / YAW_PER_INTEGRAL
        self.integral = np.clip(self.integral + y_m * self.dt_s, -most, most)
        desired = -(YAW_PER_OFFSET * y_m + YAW_PER_INTEGRAL * self.integral)
        error = np.clip(desired, -MOST_YAW, MOST_YAW) - yaw_deg
        return np.stack([np.full(len(y_m), DRIVE), TURN_PER_YAW * error], axis=1).clip(-1.0, 1.0)


def rms_offsets(
    controller: Controller, episodes: int, *, seed: int = 0, **settings: Any
) -> tuple[Floats, NDArray[np.bool_]]:
    """Root mean square offset from the line [m] of each episode, and which episodes ended early."""
    envs = gymnasium.make_vec("grouser/LevelTraverse-v0", num_envs=episodes, **settings)
    observations, _ = envs.reset(seed=seed)
    squares, steps = np.zeros(episodes), np.zeros(episodes)
    going, lost = np.ones(episodes, dtype=np.bool_), np.zeros(episodes, dtype=np.bool_)
    while going.any():
        observations, _, terminated, truncated, _ = envs.step(controller(observations))
        squares[going] += observations[going, 0] ** 2
        steps[going] += 1.0
        lost |= going & terminated
        going &= ~(terminated | truncated)
    envs.close()
    return np.sqrt(squares / steps), lost


def main() -> None:
    episodes = int(sys.argv[1]) if len(sys.argv) > 1 else 32
    straight, straight_lost = rms_offsets(straight_on, episodes)
    level, level_lost = rms_offsets(LevelLine(), episodes)
    print(f"{episodes} slopes of 5 to 15° on uncertain Toyoura sand, a minute each")
    print("command        rms offset: median      worst   line lost")
    for name, offsets, lost in (
        ("straight on", straight, straight_lost),
        ("level line", level, level_lost),
    ):
        median, worst = np.median(offsets) * 1e3, offsets.max() * 1e3
        print(f"{name:12} {median:20.0f} mm {worst:7.0f} mm {lost.sum():5} of {episodes}")
    print(f"the level line is nearer in {(level < straight).sum()} of {episodes} episodes")


if __name__ == "__main__":
    main()
