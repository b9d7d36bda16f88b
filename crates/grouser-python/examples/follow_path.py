"""Follows a path of two bends on slopes of unknown soil: pure pursuit, compared with driving
straight on.

    python follow_path.py [EPISODES]

The pursuit turns towards the place on the path that is half a metre ahead. It observes neither the
soil nor the drift that comes of it, and corrects the error that the drift leaves.
"""

from __future__ import annotations

import sys
from collections import Counter
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
#: How far ahead the place is that the rover turns to [m]: one of ``preview_m``.
AHEAD_M = 0.5
#: Turn per angle to that place [1/rad].
TURN_PER_ANGLE = 1.0


def straight_on(observations: Floats) -> Floats:
    """The constant command: drive, and do not turn."""
    return np.tile([DRIVE, 0.0], (len(observations), 1))


class Pursuit:
    """A P controller of the angle to a place on the path ahead."""

    def __init__(self, observation_names: tuple[str, ...]) -> None:
        x, y = (f"ahead_{AHEAD_M:g}_m.{axis}_m" for axis in "xy")
        self.x, self.y = observation_names.index(x), observation_names.index(y)

    def __call__(self, observations: Floats) -> Floats:
        angle = np.arctan2(observations[:, self.y], observations[:, self.x])
        drive = np.full(len(observations), DRIVE)
        return np.stack([drive, TURN_PER_ANGLE * angle], axis=1).clip(-1.0, 1.0)


def ends(
    controller: Controller | None, episodes: int, *, seed: int = 0, **settings: Any
) -> tuple[list[str], Floats, Floats]:
    """What ended each episode, its time [s], and its root mean square cross-track error [m].

    Parameters
    ----------
    controller
        By default the pursuit.
    """
    envs: Any = gymnasium.make_vec("grouser/PathFollowing-v0", num_envs=episodes, **settings)
    controller = controller or Pursuit(envs.observation_names)
    error = envs.observation_names.index("cross_track_m")
    observations, _ = envs.reset(seed=seed)
    squares, steps, times = np.zeros(episodes), np.zeros(episodes), np.zeros(episodes)
    going, found = np.ones(episodes, dtype=np.bool_), [""] * episodes
    while going.any():
        observations, _, terminated, truncated, infos = envs.step(controller(observations))
        squares[going] += observations[going, error] ** 2
        steps[going] += 1.0
        for k in np.flatnonzero(going & (terminated | truncated)):
            times[k] = infos["time_s"][k]
            found[k] = infos["stopped_by"][k] or infos["outcome"][k] or "out of time"
        going &= ~(terminated | truncated)
    envs.close()
    return found, times, np.sqrt(squares / steps)


def main() -> None:
    episodes = int(sys.argv[1]) if len(sys.argv) > 1 else 32
    print(f"{episodes} slopes of 5 to 15° on uncertain Toyoura sand")
    for name, controller in (("straight on", straight_on), ("pursuit", None)):
        found, times, errors = ends(controller, episodes)
        print(f"{name}: {dict(Counter(found))}")
        print(f"    rms cross-track error: median {np.median(errors) * 1e3:.0f} mm,", end=" ")
        print(f"worst {errors.max() * 1e3:.0f} mm; time: median {np.median(times):.1f} s")


if __name__ == "__main__":
    main()
