"""An environment with one rover: what Gymnasium asks of it, and its state for those who read it."""

from __future__ import annotations

import copy
from typing import Any, ClassVar

import gymnasium
import numpy as np

from .._arrays import Floats
from ._options import OPTIONS, options_of
from ._pictures import Pictures, check_render_mode
from ._rovers import EnvState, Rovers

#: Which rovers a single environment means: its one.
ONE = np.ones(1, dtype=np.bool_)


class OneRoverEnv(gymnasium.Env[Floats, Floats]):
    """One rover. What an action does, and what it is worth, is for the environment to say."""

    metadata: ClassVar[dict[str, Any]] = {  # type: ignore[misc]
        "render_modes": ["rgb_array", "human"],
        "render_fps": 10,
    }

    def __init__(self, rovers: Rovers, render_mode: str | None) -> None:
        check_render_mode(render_mode, self.metadata["render_modes"])
        self._rovers = rovers
        self.render_mode = render_mode
        self.observation_space = rovers.observation_space
        self.action_space = rovers.action_space
        self._pictures = Pictures(rovers, render_mode)

    @property
    def state(self) -> dict[str, float]:
        """Pose and velocities: ``x_m``, ``y_m``, ``yaw_deg``, ``forward_speed_m_s``,
        ``lateral_speed_m_s``, ``yaw_rate_deg_s``."""
        batch = self._rovers.batch
        return dict(zip(batch.STATE, batch.state[0].tolist()))

    @property
    def wheel(self) -> dict[str, Floats]:
        """Arrays of shape (wheels,) by name, as those of `grouser.Run.wheel`."""
        return {name: values[0] for name, values in self._rovers.batch.wheel.items()}

    @property
    def outcome(self) -> str | None:
        """A name of `grouser.OUTCOMES`: ``completed`` and ``stopped`` of a path alone; None during the
        run."""
        return self._rovers.outcome(0)

    @property
    def energy_j(self) -> float:
        """Work of the motors so far [J]."""
        return float(self._rovers.batch.energy_j[0])

    @property
    def slope_deg(self) -> float:
        """The slope of the episode [°]."""
        return float(self._rovers.slope_deg[0])

    def save(self) -> EnvState:
        """All that changes in the environment, its random values included, as a value from which
        `restore` goes on. What a subclass or a wrapper keeps is not in it; ``copy.deepcopy`` copies
        that, too."""
        return self._rovers.save({"random": self.np_random, "paths": self._pictures.paths})

    def restore(self, state: EnvState) -> tuple[Floats, dict[str, Any]]:
        """Sets the environment to a state, from which it goes on as the saved one did, bit for bit.

        Parameters
        ----------
        state : EnvState
            Of `save`, of this environment or another one with the same scenario.

        Returns
        -------
        observation, info
            As of `reset`.

        Raises
        ------
        ParameterError
            For a state of another kind of environment, another scenario, another path, or another
            version of Grouser; nothing changes then.
        """
        memory = self._rovers.restore(state, "random", "paths")
        self.np_random, self._pictures.paths = memory["random"], memory["paths"]
        return self._observed(), self._rovers.info(0)

    def __copy__(self) -> Any:
        return copy.deepcopy(self)

    # ---- Gymnasium's ----

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Floats, dict[str, Any]]:
        """Starts an episode; the seed determines slope, yaw and soil, except for those in
        ``options``.

        Parameters
        ----------
        seed : int, optional
            Seed of the random values; without it they go on from those before.
        options : dict, optional
            ``slope_deg``, ``yaw_deg`` or ``soil_seed``, each in place of a sampled value.
        """
        given = options_of(options, OPTIONS)
        super().reset(seed=seed)
        self._rovers.reset(ONE, [self.np_random], given)
        self._pictures.start(ONE)
        self._was_moved()
        return self._observed(), self._rovers.info(0)

    def step(self, action: Floats) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """Applies an action for ``dt_s``.

        Parameters
        ----------
        action : array
            One of ``action_space``.
        """
        reward, terminated, truncated = self._advance(action)
        self._was_moved()
        return self._observed(), reward, terminated, truncated, self._rovers.info(0)

    def _advance(self, action: Floats) -> tuple[float, bool, bool]:
        """The reward of an action, whether it ended the episode, and whether that is cut off."""
        raise NotImplementedError

    def _observed(self) -> Floats:
        """What is observed."""
        observed: Floats = self._rovers.observations()[0]
        return observed

    def render(self) -> Any:
        """The rover from above: an array of shape (400, 600, 3) of ``uint8`` for
        ``render_mode="rgb_array"``; None else."""
        if self.render_mode != "rgb_array":
            return None
        return self._pictures.drawn(0).pixels()

    def close(self) -> None:
        """Closes the window of ``render_mode="human"``."""
        self._pictures.close()

    def _was_moved(self) -> None:
        self._pictures.add(ONE)
        if self.render_mode == "human":
            self._pictures.drawn(0).show()
