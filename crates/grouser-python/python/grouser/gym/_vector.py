"""Many rovers at once, as Gymnasium's vector environments have them: seeds, masks, resets at an
episode's end."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from .._arrays import Floats, mask as mask_of
from .._errors import ParameterError
from ._options import OPTIONS, options_of
from ._pictures import Pictures, check_render_mode
from ._rovers import EnvState, Rovers, places


class ManyRoversEnv(VectorEnv[Floats, Floats, NDArray[Any]]):
    """Many rovers at once, on all cores."""

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 10}

    def __init__(
        self,
        rovers: Rovers,
        max_episode_steps: int | None,
        autoreset_mode: AutoresetMode | str,
        render_mode: str | None,
    ) -> None:
        check_render_mode(render_mode, self.metadata["render_modes"])
        self.num_envs = len(rovers.batch)
        self.render_mode = render_mode
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.metadata = {**self.metadata, "autoreset_mode": self.autoreset_mode}
        self._rovers = rovers
        self._pictures = Pictures(rovers, render_mode)
        self._longest = max_episode_steps
        self.single_observation_space = rovers.observation_space
        self.single_action_space = rovers.action_space
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self._randoms: list[np.random.Generator] = []
        self._steps = np.zeros(self.num_envs, dtype=np.int64)
        self._ended = np.zeros(self.num_envs, dtype=np.bool_)

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Floats, dict[str, Any]]:
        """Starts episodes; sub-environment k of a single seed has ``seed + k``.

        ``options["reset_mask"]``, an array of bool, selects some of them; by default all. The
        other options are those of `LevelTraverseEnv`: one value, or one for each sub-environment.

        Parameters
        ----------
        seed : int or sequence of int or None, optional
            Seeds of the random values.
        options : dict, optional
            As above.
        """
        given = options_of(options, (*OPTIONS, "reset_mask"))
        seeds = [seed + k for k in range(self.num_envs)] if isinstance(seed, int) else seed
        if seeds is not None and len(seeds) != self.num_envs:
            raise ParameterError(f"{len(seeds)} seeds for {self.num_envs} environments", "seed")
        which = np.ones(self.num_envs, dtype=np.bool_)
        if "reset_mask" in given:
            which = mask_of("reset_mask", given["reset_mask"], self.num_envs)
            if not which.any():
                raise ParameterError("reset_mask has no True, it must have one", "reset_mask")
        if not self._randoms:
            self._randoms = [seeding.np_random()[0] for _ in range(self.num_envs)]
        for k in places(which):
            if seeds is not None and seeds[k] is not None:
                self._randoms[k] = seeding.np_random(seeds[k])[0]
        self._start(which, given)
        return self._rovers.observations(), self._infos({}, which)

    def _start(self, which: NDArray[np.bool_], options: Mapping[str, Any]) -> None:
        self._rovers.reset(which, self._randoms, options)
        self._steps[which] = 0
        self._ended[which] = False
        self._pictures.start(which)
        self._pictures.add(which)

    def step(
        self, actions: Floats
    ) -> tuple[Floats, Floats, NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """Applies an action to each for ``dt_s``; those whose episode has ended are reset according
        to ``autoreset_mode``.

        Parameters
        ----------
        actions : array
            A row for each sub-environment.
        """
        if not self._randoms:
            raise gymnasium.error.ResetNeeded("reset the environments before the first step")
        again = self._ended.copy()
        if self.autoreset_mode is AutoresetMode.DISABLED and again.any():
            raise gymnasium.error.ResetNeeded(
                f"environments {places(again)} have ended: reset them"
            )
        rewards, terminated, truncated = self._rovers.step(actions, ~again)
        self._pictures.add(~again)
        self._steps[~again] += 1
        if self._longest is not None:
            truncated = truncated | ((self._steps >= self._longest) & ~again)
        if again.any():
            self._start(again, {})
        infos: dict[str, Any] = {}
        self._ended = terminated | truncated
        if self.autoreset_mode is AutoresetMode.SAME_STEP and self._ended.any():
            last = self._rovers.observations()
            for k in places(self._ended):
                final = {"final_obs": last[k], "final_info": self._rovers.info(k)}
                infos = self._add_info(infos, final, k)
            self._start(self._ended.copy(), {})
        everyone = np.ones(self.num_envs, dtype=np.bool_)
        infos = self._infos(infos, everyone)
        return self._rovers.observations(), rewards, terminated, truncated, infos

    def save(self) -> EnvState:
        """All that changes in the environments, their random values included, as a value from which
        `restore` goes on."""
        memory = {"random": self._randoms, "steps": self._steps, "ended": self._ended}
        return self._rovers.save({**memory, "paths": self._pictures.paths})

    def restore(self, state: EnvState) -> tuple[Floats, dict[str, Any]]:
        """Sets the environments to a state, from which they go on as the saved ones did, bit for
        bit.

        Parameters
        ----------
        state : EnvState
            Of `save`, of as many environments with the same scenario.

        Returns
        -------
        observations, infos
            As of `reset`.

        Raises
        ------
        ParameterError
            For a state of another kind of environment, another scenario, another path, another
            number of rovers, or another version of Grouser; nothing changes then.
        """
        memory = self._rovers.restore(state, "random", "steps", "ended", "paths")
        self._randoms, self._pictures.paths = memory["random"], memory["paths"]
        self._steps, self._ended = memory["steps"], memory["ended"]
        everyone = np.ones(self.num_envs, dtype=np.bool_)
        return self._rovers.observations(), self._infos({}, everyone)

    def __copy__(self) -> Any:
        return copy.deepcopy(self)

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """Each rover from above, with its path: an array as that of `LevelTraverseEnv.render` for
        each sub-environment with ``render_mode="rgb_array"``; None else."""
        if self.render_mode != "rgb_array":
            return None
        return tuple(self._pictures.drawn(k).pixels() for k in range(self.num_envs))

    def close_extras(self, **kwargs: Any) -> None:
        """Frees what drew the pictures; ``close()`` calls it.

        Parameters
        ----------
        **kwargs
            Of ``close``; not used.
        """
        self._pictures.close()

    def _infos(self, infos: dict[str, Any], which: NDArray[np.bool_]) -> dict[str, Any]:
        """Adds what is known of some rovers, in the form of Gymnasium's own vector environments."""
        for name, values in self._rovers.columns().items():
            known = which & ~np.ma.getmaskarray(values)
            nothing: NDArray[Any] = np.full(self.num_envs, None)
            if values.dtype != np.object_:
                nothing = np.zeros(self.num_envs, dtype=values.dtype)
            infos[name] = np.where(known, np.ma.getdata(values), nothing)
            infos[f"_{name}"] = known
        return infos
