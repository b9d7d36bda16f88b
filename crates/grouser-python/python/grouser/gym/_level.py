"""Holding the contour line: one rover, and many at once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import ArrayLike, NDArray

from .._arrays import Floats
from ._rover import RoverEnv
from ._rovers import Rovers
from ._single import ONE
from ._vector import ManyRoversEnv

#: The environment's name for ``gymnasium.make``.
ENV_ID = "grouser/LevelTraverse-v0"
#: Steps after which ``gymnasium.make`` truncates an episode: a minute at the usual period.
MAX_EPISODE_STEPS = 120
#: The offset from the line whose penalty equals the reward of the fastest progress [m]: about a
#: wheel's radius.
LINE_M = 0.1
#: The offset at which the line is lost and the episode ends [m]: about the rover's length.
LOST_M = 0.5
#: The reward of a step that terminates the episode.
PENALTY = -50.0


class LevelTraverses(Rovers):
    """Any number of rovers that should hold their lines."""

    def step(
        self, actions: ArrayLike, which: NDArray[np.bool_]
    ) -> tuple[Floats, NDArray[np.bool_], NDArray[np.bool_]]:
        rims = self.rim_speeds(self.shares(actions))
        before = self.batch.state[:, 0]
        state = self.batch.step(rims, self.dt_s, mask=which)
        progress = (state[:, 0] - before) / (self.fastest * self.dt_s)
        offset = state[:, 1] / LINE_M
        lost = np.abs(state[:, 1]) > LOST_M
        ended = lost | np.array([outcome is not None for outcome in self.batch.outcome])
        rewards = progress - offset * offset + PENALTY * ended
        return np.where(which, rewards, 0.0), ended & which, np.zeros_like(ended)


class LevelTraverseEnv(RoverEnv):
    """Hold the contour line on a slope of unknown soil, with a rover that cannot steer its wheels.

    The line is the contour through the start, y = 0. Each reset samples the slope, the yaw at the
    start (−10 to 10°) and the soil, from its ``[uncertainty]``; only the yaw is observed. A rover
    that drives straight on drifts downhill: it has to find the heading offset that compensates for
    it, by different speeds of its left and right wheels.

    **Action**, two numbers from −1 to 1: drive, and turn to the left (uphill, while the rover goes
    along +x). Rims on the left turn at ``max_speed_m_s`` (drive − turn), those on the right at
    ``max_speed_m_s`` (drive + turn), each limited to ``max_speed_m_s``, for ``dt_s``.

    **Observation**, float64: offset from the line y [m], positive uphill; yaw [°]; forward and
    lateral speed of the body [m/s]; yaw rate [°/s]; then of every wheel, in the mounts' order,
    wheel speed [rad/s], motor torque [N·m], motor power [W]. Values are clipped to the space's
    bounds.

    **Reward** of a step: distance along the line over the longest possible, Δx/(max_speed dt), less
    (y/0.1 m)²; less 50 where the episode terminates.

    **Termination**: the rover gets stuck, slides, tips over, or is more than 0.5 m off the line.
    ``gymnasium.make`` truncates after 120 steps, a minute.

    **Info**: ``x_m`` [m], ``slope_deg`` [°], ``energy_j`` [J], ``outcome`` (None during the run),
    ``fallback_to_dynamic``: whether a quasi-steady episode had no steady state at some time, and
    was computed dynamically until the next action. Turns on the spot at full speed have that
    effect.

    **Options** of a reset, each in place of a sampled value: ``slope_deg`` [°], ``yaw_deg`` [°] and
    ``soil_seed``, a whole number that determines the soil, or None for the values of its document.
    All other values are sampled as without options.

    Parameters
    ----------
    scenario : Scenario, name, path or mapping, optional
        Rover, gravity, model, and ``simulation``, whose ``"quasi-steady"`` is faster to compute as
        long as there is a steady state. A mapping gives single keys, and its ``soil`` and
        ``slope_deg`` are used like arguments; all other sources have every key, and their soil and
        slope are used if there is no argument for them. Drive, duration, record interval and yaw at
        the start are not used, and a mapping must not have them.
    soil : Soil, name, path or mapping, optional
        The soil; by default ``toyoura-uncertain``. Without ``[uncertainty]`` it is the same
        in every episode.
    slope_deg : (float, float), optional
        Least and steepest slope [°]; by default 5 to 15.
    max_speed_m_s : float
        The largest rim speed [m/s].
    dt_s : float
        Duration of an action [s].
    render_mode : {"rgb_array", "human"}, optional
        Whether there are pictures, as of `RoverEnv`.

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `grouser.Scenario`; for a scenario with a terrain; and for a key that both the scenario's
        mapping and an argument give, or that is not used.

    Examples
    --------
    A rover that drives straight on drifts downhill, y < 0, and loses a little reward by it:

    >>> import numpy as np
    >>> from grouser.gym import LevelTraverseEnv
    >>> env = LevelTraverseEnv(soil="toyoura", slope_deg=(15.0, 15.0))
    >>> observation, info = env.reset(seed=1, options={"yaw_deg": 0.0})
    >>> for _ in range(10):
    ...     observation, reward, terminated, truncated, info = env.step(np.array([0.6, 0.0]))
    >>> bool(observation[0] < 0.0), info["x_m"] > 0.0, terminated
    (True, True, False)
    """

    _rovers_class = LevelTraverses

    def reward(self, before: Mapping[str, float], ended: bool) -> float:
        """Progress along the line, less the offset's square, and a penalty at the end.

        Parameters
        ----------
        before, ended
            As for `RoverEnv.reward`.
        """
        progress = (self.state["x_m"] - before["x_m"]) / (self._rovers.fastest * self._rovers.dt_s)
        offset = self.state["y_m"] / LINE_M
        return progress - offset * offset + PENALTY * ended

    def is_ended(self) -> bool:
        """Whether the line is lost."""
        return abs(self.state["y_m"]) > LOST_M

    def _advance(self, action: Floats) -> tuple[float, bool, bool]:
        # With the arithmetic of the vector form, bit for bit.
        rewards, ended, truncated = self._rovers.step(np.asanyarray(action)[None], ONE)
        return float(rewards[0]), bool(ended[0]), bool(truncated[0])


class LevelTraverseVectorEnv(ManyRoversEnv):
    """Many `LevelTraverseEnv` at once, on all cores; the same seeds give the same results, bit for
    bit.

    Seeds, masks of ``options["reset_mask"]``, infos and resets at an episode's end are those of
    ``gymnasium.vector.SyncVectorEnv``.

    Parameters
    ----------
    num_envs : int
        Number of sub-environments.
    max_episode_steps : int or None
        Steps after which an episode is truncated.
    autoreset_mode : AutoresetMode or str
        When a sub-environment whose episode has ended is reset: with the next step (the default,
        whose action it ignores), in the same step (the end is in ``infos["final_obs"]`` and
        ``infos["final_info"]``), or only by a call.
    render_mode : {"rgb_array"}, optional
        Whether `render` returns pictures. There are no windows: those are for one rover.
    **settings
        As for `LevelTraverseEnv`, except for ``render_mode``.

    Examples
    --------
    Sixteen rovers drive straight on, on slopes from 5 to 15°; how far do they drift downhill?

    >>> import numpy as np
    >>> from grouser.gym import LevelTraverseVectorEnv
    >>> envs = LevelTraverseVectorEnv(16)
    >>> observations, infos = envs.reset(seed=1, options={"yaw_deg": 0.0})
    >>> straight_on = np.tile([0.6, 0.0], (16, 1))
    >>> for _ in range(10):
    ...     observations, rewards, terminated, truncated, infos = envs.step(straight_on)
    >>> bool((observations[:, 0] < 0.0).all())
    True
    """

    def __init__(
        self,
        num_envs: int = 1,
        *,
        max_episode_steps: int | None = MAX_EPISODE_STEPS,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        render_mode: str | None = None,
        **settings: Any,
    ) -> None:
        rovers = LevelTraverses(num_envs, **settings)
        super().__init__(rovers, max_episode_steps, autoreset_mode, render_mode)
