"""The base class of environments of one's own, with one rover."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from .._arrays import Floats, numbers
from .._descriptions import Scenario, Soil, Source
from .._errors import ParameterError
from ._rovers import Rovers
from ._single import OneRoverEnv


class RoverEnv(OneRoverEnv):
    """Base class of environments with one rover on a slope of unknown soil: a subclass says what is
    rewarded, and may say what is observed, what ends an episode, and what an action does.

    Each reset samples the slope, the yaw at the start (−10 to 10°) and the soil, from its
    ``[uncertainty]``. A subclass defines `reward`; it may override `is_ended`, `observation` and
    `rim_speeds`, and then sets ``observation_space`` or ``action_space`` after
    ``super().__init__(…)``. Those methods read `state`, `wheel`, `outcome`, `energy_j` and
    `slope_deg`. An episode ends in any case where the rover gets stuck, slides or tips over.

    ``render_mode="rgb_array"`` makes `render` return a picture of the rover and its path from
    above, ``"human"`` shows it in a window after each reset and step. Both need matplotlib.

    Parameters
    ----------
    scenario, soil, slope_deg, max_speed_m_s, dt_s
        As for `LevelTraverseEnv`.
    render_mode : {"rgb_array", "human"}, optional
        Whether there are pictures.

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `LevelTraverseEnv`.

    Examples
    --------
    >>> import numpy as np
    >>> from grouser.gym import RoverEnv
    >>> class Climb(RoverEnv):
    ...     def reward(self, before, ended):
    ...         return self.state["y_m"] - before["y_m"] - 10.0 * ended
    ...
    ...     def is_ended(self):
    ...         return self.state["y_m"] > 2.0
    >>> env = Climb(slope_deg=(5.0, 8.0))
    >>> observation, info = env.reset(seed=1, options={"yaw_deg": 60.0})
    >>> observation, reward, terminated, truncated, info = env.step(np.array([0.6, 0.0]))
    >>> reward > 0.0, terminated
    (True, False)
    """

    #: What drives the rover.
    _rovers_class: ClassVar[type[Rovers]] = Rovers

    def __init__(
        self,
        *,
        scenario: Scenario | Source | None = None,
        soil: Soil | Source | None = None,
        slope_deg: Sequence[float] | None = None,
        max_speed_m_s: float = 0.1,
        dt_s: float = 0.5,
        render_mode: str | None = None,
    ) -> None:
        rovers = self._rovers_class(
            1,
            scenario=scenario,
            soil=soil,
            slope_deg=slope_deg,
            max_speed_m_s=max_speed_m_s,
            dt_s=dt_s,
        )
        super().__init__(rovers, render_mode)

    @abstractmethod
    def reward(self, before: Mapping[str, float], ended: bool) -> float:
        """The reward of a step.

        Parameters
        ----------
        before : mapping of str to float
            `state` before the step.
        ended : bool
            Whether the step ended the episode, by `is_ended` or by the rover's `outcome`.
        """
        raise NotImplementedError("an environment says what is rewarded: def reward(self, before, ended)")

    def is_ended(self) -> bool:
        """Whether the episode ends here though the rover could go on; by default never."""
        return False

    def observation(self) -> Floats:
        """What is observed; by default as by `LevelTraverseEnv`."""
        return super()._observed()

    def rim_speeds(self, action: Floats) -> ArrayLike:
        """Rim speeds of the wheels that an action sets [m/s]; by default of drive and turn, as by
        `LevelTraverseEnv`.

        Parameters
        ----------
        action : array
            One of ``action_space``.
        """
        shares = np.clip(numbers("action", action), -1.0, 1.0)
        if shares.shape != (2,) or np.isnan(shares).any():
            raise ParameterError(
                f"the action is {action!r}, it must be two numbers, from -1 to 1", "action"
            )
        rims: Floats = self._rovers.rim_speeds(shares[None])[0]
        return rims

    def _advance(self, action: Floats) -> tuple[float, bool, bool]:
        before = self.state
        rims = numbers("rim_speeds", self.rim_speeds(action))
        self._rovers.batch.step(rims[None], self._rovers.dt_s)
        ended = bool(self.is_ended()) or self.outcome is not None
        return float(self.reward(before, ended)), ended, False

    def _observed(self) -> Floats:
        return self.observation()
