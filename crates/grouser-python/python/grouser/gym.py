"""Gymnasium environments: rovers on slopes of unknown soil.

Importing this module registers ``grouser/LevelTraverse-v0``, with a vector form that simulates all
its rovers at once on all cores. `RoverEnv` is the base class of your own environments. It needs
Gymnasium: ``pip install gymnasium``; and matplotlib for pictures.

Examples
--------
>>> import gymnasium
>>> import grouser.gym
>>> env = gymnasium.make("grouser/LevelTraverse-v0")
>>> observation, info = env.reset(seed=1)
>>> observation, reward, terminated, truncated, info = env.step([0.6, 0.0])
>>> observation.shape, terminated
((17,), False)
>>> envs = gymnasium.make_vec("grouser/LevelTraverse-v0", num_envs=8)
>>> observations, infos = envs.reset(seed=1)
>>> bool((observations[0] == env.reset(seed=1)[0]).all())
True
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

try:
    import gymnasium
    from gymnasium.utils import seeding
    from gymnasium.vector import AutoresetMode, VectorEnv
    from gymnasium.vector.utils import batch_space
except ImportError as error:
    raise ImportError(
        "grouser.gym needs Gymnasium: pip install gymnasium", name="gymnasium"
    ) from error

from ._arrays import Floats, mask as mask_of, number, numbers, whole_number
from ._descriptions import Scenario, Soil, Source
from ._errors import ParameterError
from ._rendering import Camera
from ._runs import RunBatch

__all__ = ["LevelTraverseEnv", "LevelTraverseVectorEnv", "RoverEnv"]

#: The environment's name for ``gymnasium.make``.
ENV_ID = "grouser/LevelTraverse-v0"
#: Steps after which ``gymnasium.make`` truncates an episode: a minute at the usual period.
MAX_EPISODE_STEPS = 120

#: The range of the sampled yaw at the start [°].
START_YAW_DEG = (-10.0, 10.0)
#: The soil and the least and steepest slope [°] where neither an argument nor the scenario names
#: one.
USUAL_SOIL, USUAL_SLOPE_DEG = "toyoura-uncertain", (5.0, 15.0)
#: Keys of a scenario that an environment does not use, and why.
_UNUSED = {
    "drive": "actions turn the wheels",
    "duration_s": "max_episode_steps ends an episode",
    "sample_interval_s": "dt_s is the interval",
}
#: Options of a reset, each in place of a sampled value.
_OPTIONS = ("slope_deg", "yaw_deg", "soil_seed")
#: The offset from the line whose penalty equals the reward of the fastest progress [m]: about a
#: wheel's radius.
LINE_M = 0.1
#: The offset at which the line is lost and the episode ends [m]: about the rover's length.
LOST_M = 0.5
#: The reward of a step that terminates the episode.
PENALTY = -50.0

#: Names of the observations of the rover, with units.
_ROVER = ("y_m", "yaw_deg", "forward_speed_m_s", "lateral_speed_m_s", "yaw_rate_deg_s")
#: Bounds of the same; values beyond are clipped, far outside the range of an episode that
#: continues.
_ROVER_BOUNDS = (1.0, 180.0, 1.0, 1.0, 180.0)
#: Names of the observations of each wheel, with units, and their bounds.
_WHEEL = ("wheel_speed_rad_s", "torque_nm", "power_w")
_WHEEL_BOUNDS = (20.0, 50.0, 100.0)


class _Traverses:
    """Any number of rovers that should hold their lines: the common part of all environments."""

    def __init__(
        self,
        count: int,
        *,
        scenario: Scenario | Source | None = None,
        soil: Soil | Source | None = None,
        slope_deg: Sequence[float] | None = None,
        max_speed_m_s: float = 0.1,
        dt_s: float = 0.5,
    ) -> None:
        run, slopes = _start_of(scenario, soil, slope_deg)
        self.slopes = slopes
        self.fastest = number("max_speed_m_s", max_speed_m_s)
        if not 0.0 < self.fastest <= 10.0:
            raise ParameterError(
                f"max_speed_m_s is {self.fastest}, it must be above 0, at most 10",
                "max_speed_m_s",
                self.fastest,
            )
        self.dt_s = number("dt_s", dt_s)
        self.rovers = RunBatch([run] * count, commands="rim_speed_m_s")
        # Wheels on the left side are those with y > 0 in the body frame.
        left = [mount["position_m"][1] > 0.0 for mount in run.rover.mount]
        self.side = np.where(left, -1.0, 1.0)
        bounds = np.array([*_ROVER_BOUNDS, *np.repeat(_WHEEL_BOUNDS, len(left))])
        self.observation_space = gymnasium.spaces.Box(-bounds, bounds, dtype=np.float64)
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (2,), dtype=np.float64)
        self.slope_deg = np.full(count, slopes[1])

    def reset(
        self,
        which: NDArray[np.bool_],
        randoms: Sequence[np.random.Generator],
        options: Mapping[str, Any],
    ) -> None:
        """Samples slope, yaw and soil of each rover, in this order, from its own generator; options
        replace sampled values."""
        count = len(randoms)
        given_slopes, given_yaws, given_seeds = (_given(name, options, count) for name in _OPTIONS)
        slopes, yaws = self.slope_deg.copy(), np.zeros(count)
        seeds: list[int | None] = [0] * count
        for k in _places(which):
            slopes[k] = randoms[k].uniform(*self.slopes)
            yaws[k] = randoms[k].uniform(*START_YAW_DEG)
            seeds[k] = int(randoms[k].integers(2**63))
            slopes[k] = slopes[k] if given_slopes is None else given_slopes[k]
            yaws[k] = yaws[k] if given_yaws is None else given_yaws[k]
            seeds[k] = seeds[k] if given_seeds is None else given_seeds[k]
        self.rovers.reset(seed=seeds, slope_deg=slopes, yaw_deg=yaws, mask=which)
        self.slope_deg = slopes

    def step(
        self, actions: ArrayLike, which: NDArray[np.bool_]
    ) -> tuple[Floats, NDArray[np.bool_]]:
        """Rewards, and which episodes ended by what the rover did."""
        shares = np.clip(numbers("action", actions), -1.0, 1.0)
        if shares.shape != (len(self.rovers), 2) or np.isnan(shares).any():
            raise ParameterError(
                f"the action is {actions!r}, it must be two numbers for each rover, from -1 to 1",
                "action",
            )
        rims = self.rim_speeds(shares)
        before = self.rovers.state[:, 0]
        state = self.rovers.step(rims, self.dt_s, mask=which)
        progress = (state[:, 0] - before) / (self.fastest * self.dt_s)
        offset = state[:, 1] / LINE_M
        lost = np.abs(state[:, 1]) > LOST_M
        ended = lost | np.array([outcome is not None for outcome in self.rovers.outcome])
        rewards = progress - offset * offset + PENALTY * ended
        return np.where(which, rewards, 0.0), ended & which

    def rim_speeds(self, shares: Floats) -> Floats:
        """Rim speeds [m/s] of drive and turn, a row for each rover."""
        drive, turn = shares[:, :1], shares[:, 1:]
        rims: Floats = self.fastest * np.clip(drive + turn * self.side, -1.0, 1.0)
        return rims

    def observations(self) -> Floats:
        state, wheel = self.rovers.state, self.rovers.wheel
        rover = [state[:, [self.rovers.STATE.index(name)]] for name in _ROVER]
        # A rover that has just tipped over or sunk has no torque: NaN.
        wheels = [np.nan_to_num(wheel[name]) for name in _WHEEL]
        high = self.observation_space.high
        observations: Floats = np.clip(np.concatenate([*rover, *wheels], axis=1), -high, high)
        return observations

    def info(self, k: int) -> dict[str, Any]:
        return {
            "x_m": float(self.rovers.state[k, 0]),
            "slope_deg": float(self.slope_deg[k]),
            "energy_j": float(self.rovers.energy_j[k]),
            "outcome": self.rovers.outcome[k],
            "fallback_to_dynamic": self.rovers.simulation[k] not in ("dynamic", "quasi-steady"),
        }


#: Which rovers a single environment means: its one.
_ONE = np.ones(1, dtype=np.bool_)


class _Pictures:
    """Pictures of rovers from above, with the path of each since its episode started."""

    def __init__(self, traverses: _Traverses, mode: str | None) -> None:
        self._traverses = traverses
        self._mode = mode
        self._camera: Camera | None = None
        self._paths: list[list[tuple[float, float]]] = [[] for _ in range(len(traverses.rovers))]

    def start(self, which: NDArray[np.bool_]) -> None:
        """Forgets the paths of some rovers."""
        for k in _places(which):
            self._paths[k] = []

    def add(self, which: NDArray[np.bool_]) -> None:
        """Adds the places of some rovers to their paths, if there are pictures."""
        if self._mode is None:
            return
        state = self._traverses.rovers.state
        for k in _places(which):
            self._paths[k].append((float(state[k, 0]), float(state[k, 1])))

    def drawn(self, k: int) -> Camera:
        """The camera, with rover k before it."""
        if not self._paths[k]:
            raise gymnasium.error.ResetNeeded("reset the environment before it is rendered")
        rovers = self._traverses.rovers
        if self._camera is None:
            try:
                self._camera = Camera(rovers.scenarios[0].rover, str(self._mode))
            except ImportError as error:
                raise gymnasium.error.DependencyNotInstalled(
                    "rendering needs matplotlib: pip install matplotlib"
                ) from error
        outcome = rovers.outcome[k]
        title = f"slope {self._traverses.slope_deg[k]:.1f}°, {rovers.time_s[k]:.1f} s"
        title += f", {outcome}" if outcome else ""
        yaw_deg = float(rovers.state[k, rovers.STATE.index("yaw_deg")])
        self._camera.draw(np.array(self._paths[k]), yaw_deg, title)
        return self._camera

    def close(self) -> None:
        if self._camera is not None:
            self._camera.close()
            self._camera = None


class RoverEnv(gymnasium.Env[Floats, Floats]):
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

    metadata: ClassVar[dict[str, Any]] = {  # type: ignore[misc]
        "render_modes": ["rgb_array", "human"],
        "render_fps": 10,
    }

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
        _check_render_mode(render_mode, self.metadata["render_modes"])
        self._traverses = _Traverses(
            1,
            scenario=scenario,
            soil=soil,
            slope_deg=slope_deg,
            max_speed_m_s=max_speed_m_s,
            dt_s=dt_s,
        )
        self.render_mode = render_mode
        self.observation_space = self._traverses.observation_space
        self.action_space = self._traverses.action_space
        self._pictures = _Pictures(self._traverses, render_mode)

    # ---- what a subclass reads ----

    @property
    def state(self) -> dict[str, float]:
        """Pose and velocities: ``x_m``, ``y_m``, ``yaw_deg``, ``forward_speed_m_s``,
        ``lateral_speed_m_s``, ``yaw_rate_deg_s``."""
        rovers = self._traverses.rovers
        return dict(zip(rovers.STATE, rovers.state[0].tolist()))

    @property
    def wheel(self) -> dict[str, Floats]:
        """Arrays of shape (wheels,) by name, as those of `grouser.Run.wheel`."""
        return {name: values[0] for name, values in self._traverses.rovers.wheel.items()}

    @property
    def outcome(self) -> str | None:
        """``immobilised``, ``sliding`` or ``tipped_over``; None during the run."""
        outcome: str | None = self._traverses.rovers.outcome[0]
        return outcome

    @property
    def energy_j(self) -> float:
        """Work of the motors so far [J]."""
        return float(self._traverses.rovers.energy_j[0])

    @property
    def slope_deg(self) -> float:
        """The slope of the episode [°]."""
        return float(self._traverses.slope_deg[0])

    # ---- what a subclass says ----

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
        observation: Floats = self._traverses.observations()[0]
        return observation

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
        rims: Floats = self._traverses.rim_speeds(shares[None])[0]
        return rims

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
        given = _options_of(options, _OPTIONS)
        super().reset(seed=seed)
        self._traverses.reset(_ONE, [self.np_random], given)
        self._pictures.start(_ONE)
        self._was_moved()
        return self.observation(), self._traverses.info(0)

    def step(self, action: Floats) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """Applies an action for ``dt_s``.

        Parameters
        ----------
        action : array
            One of ``action_space``.
        """
        before = self.state
        reward, ended = self._advance(action, before)
        self._was_moved()
        return self.observation(), reward, ended, False, self._traverses.info(0)

    def _advance(self, action: Floats, before: Mapping[str, float]) -> tuple[float, bool]:
        """The reward of an action, and whether it ended the episode."""
        rims = numbers("rim_speeds", self.rim_speeds(action))
        self._traverses.rovers.step(rims[None], self._traverses.dt_s)
        ended = bool(self.is_ended()) or self.outcome is not None
        return float(self.reward(before, ended)), ended

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
        self._pictures.add(_ONE)
        if self.render_mode == "human":
            self._pictures.drawn(0).show()


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
    has been computed dynamically since. Sharp turns have that effect in most episodes.

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
        As `grouser.Scenario`; and for a key that both the scenario's mapping and an argument give,
        or that is not used.

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

    def reward(self, before: Mapping[str, float], ended: bool) -> float:
        """Progress along the line, less the offset's square, and a penalty at the end.

        Parameters
        ----------
        before, ended
            As for `RoverEnv.reward`.
        """
        progress = (self.state["x_m"] - before["x_m"]) / (
            self._traverses.fastest * self._traverses.dt_s
        )
        offset = self.state["y_m"] / LINE_M
        return progress - offset * offset + PENALTY * ended

    def is_ended(self) -> bool:
        """Whether the line is lost."""
        return abs(self.state["y_m"]) > LOST_M

    def _advance(self, action: Floats, before: Mapping[str, float]) -> tuple[float, bool]:
        # With the arithmetic of the vector form, bit for bit.
        rewards, ended = self._traverses.step(np.asanyarray(action)[None], _ONE)
        return float(rewards[0]), bool(ended[0])


class LevelTraverseVectorEnv(VectorEnv[Floats, Floats, NDArray[Any]]):
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

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 10}

    def __init__(
        self,
        num_envs: int = 1,
        *,
        max_episode_steps: int | None = MAX_EPISODE_STEPS,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        render_mode: str | None = None,
        **settings: Any,
    ) -> None:
        _check_render_mode(render_mode, self.metadata["render_modes"])
        self.num_envs = num_envs
        self.render_mode = render_mode
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.metadata = {**self.metadata, "autoreset_mode": self.autoreset_mode}
        self._traverses = _Traverses(num_envs, **settings)
        self._pictures = _Pictures(self._traverses, render_mode)
        self._longest = max_episode_steps
        self.single_observation_space = self._traverses.observation_space
        self.single_action_space = self._traverses.action_space
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._randoms: list[np.random.Generator] = []
        self._steps = np.zeros(num_envs, dtype=np.int64)
        self._ended = np.zeros(num_envs, dtype=np.bool_)

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
        given = _options_of(options, (*_OPTIONS, "reset_mask"))
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
        for k in _places(which):
            if seeds is not None and seeds[k] is not None:
                self._randoms[k] = seeding.np_random(seeds[k])[0]
        self._start(which, given)
        return self._traverses.observations(), self._infos({}, which)

    def _start(self, which: NDArray[np.bool_], options: Mapping[str, Any]) -> None:
        self._traverses.reset(which, self._randoms, options)
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
                f"environments {_places(again)} have ended: reset them"
            )
        rewards, terminated = self._traverses.step(actions, ~again)
        self._pictures.add(~again)
        self._steps[~again] += 1
        truncated = np.zeros(self.num_envs, dtype=np.bool_)
        if self._longest is not None:
            truncated = (self._steps >= self._longest) & ~again
        if again.any():
            self._start(again, {})
        infos: dict[str, Any] = {}
        self._ended = terminated | truncated
        if self.autoreset_mode is AutoresetMode.SAME_STEP and self._ended.any():
            last = self._traverses.observations()
            for k in _places(self._ended):
                final = {"final_obs": last[k], "final_info": self._traverses.info(k)}
                infos = self._add_info(infos, final, k)
            self._start(self._ended.copy(), {})
        everyone = np.ones(self.num_envs, dtype=np.bool_)
        infos = self._infos(infos, everyone)
        return self._traverses.observations(), rewards, terminated, truncated, infos

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
        for k in _places(which):
            infos = self._add_info(infos, self._traverses.info(k), k)
        return infos


def _check_render_mode(mode: str | None, modes: Sequence[str]) -> None:
    if mode not in (None, *modes):
        known = f"{', '.join(map(repr, modes))} or None"
        raise ParameterError(
            f"render_mode is {mode!r}, it must be {known}", "render_mode", None, known
        )


def _places(which: NDArray[np.bool_]) -> list[int]:
    places: list[int] = np.flatnonzero(which).tolist()
    return places


def _start_of(
    scenario: Scenario | Source | None,
    soil: Soil | Source | None,
    slope_deg: Sequence[float] | None,
) -> tuple[Scenario, tuple[float, float]]:
    """The run on the steepest slope, and the least and steepest slope [°]."""
    if isinstance(scenario, Mapping):
        _check_keys(scenario, {"soil": soil, "slope_deg": slope_deg})
    run = Scenario(scenario)
    # A mapping or no scenario at all leaves its missing keys to the environment.
    named = {} if scenario is None else scenario if isinstance(scenario, Mapping) else run.to_dict()
    if soil is None and "soil" not in named:
        soil = USUAL_SOIL
    if slope_deg is None:
        only = float(run.slope_deg)
        slope_deg = (only, only) if "slope_deg" in named else USUAL_SLOPE_DEG
    low, high = _pair("slope_deg", slope_deg)
    whole = soil if isinstance(soil, Soil) or soil is None else Soil(soil)
    changes: dict[str, Any] = {} if whole is None else {"soil": whole}
    # The scenario must be valid at both ends of the range of slopes: checked here.
    run.replace(**changes, slope_deg=low)
    return run.replace(**changes, slope_deg=high), (low, high)


def _check_keys(scenario: Mapping[str, Any], arguments: Mapping[str, Any]) -> None:
    """Checks that a mapping has no key that is also an argument, and no key that is not used."""
    for name, value in arguments.items():
        if value is not None and name in scenario:
            raise ParameterError(
                f"{name} is given twice: {_shown(value)} as an argument, {_shown(scenario[name])} "
                "by the scenario; give it once",
                name,
            )
    for name, why in _UNUSED.items():
        if name in scenario:
            raise ParameterError(f"the scenario has {name}, which is not used: {why}", name)
    start = scenario.get("start")
    if isinstance(start, Mapping) and "yaw_deg" in start:
        raise ParameterError(
            "the scenario has start.yaw_deg, which is not used: every reset samples the yaw, or "
            "takes it from its option yaw_deg",
            "start.yaw_deg",
        )


def _shown(value: Any) -> str:
    return f"the soil {value.name!r}" if isinstance(value, Soil) else repr(value)


def _options_of(options: Mapping[str, Any] | None, known: Sequence[str]) -> Mapping[str, Any]:
    """Options of a reset, all of them known."""
    for name in options or {}:
        if name not in known:
            listed = ", ".join(known)
            raise ParameterError(
                f"a reset has no option {name!r}; it has {listed}", str(name), None, listed
            )
    return options or {}


def _given(name: str, options: Mapping[str, Any], count: int) -> list[Any] | None:
    """An option's value for each rover; None where it is not given."""
    if name not in options:
        return None
    value = options[name]
    if name == "soil_seed":
        several = isinstance(value, Sequence) or isinstance(value, np.ndarray)
        seeds = list(value) if several else [value] * count
        _check_count(name, len(seeds), count)
        return [None if it is None else whole_number(name, it, most=2**63 - 1) for it in seeds]
    array = numbers(name, value)
    if array.ndim:
        _check_count(name, len(array) if array.ndim == 1 else -1, count)
    values: list[Any] = np.broadcast_to(array, (count,)).tolist()
    return values


def _check_count(name: str, found: int, count: int) -> None:
    if found != count:
        each = "one value" if count == 1 else f"one value, or {count} in a row"
        raise ParameterError(f"the option {name} must be {each}", name, None, each)


def _pair(name: str, values: Sequence[float]) -> tuple[float, float]:
    array = numbers(name, values)
    if array.shape != (2,) or not array[0] <= array[1]:
        raise ParameterError(f"{name} is {values!r}, it must be the least and the largest", name)
    return float(array[0]), float(array[1])


gymnasium.register(
    id=ENV_ID,
    entry_point="grouser.gym:LevelTraverseEnv",
    vector_entry_point="grouser.gym:LevelTraverseVectorEnv",
    max_episode_steps=MAX_EPISODE_STEPS,
)
