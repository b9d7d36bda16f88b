"""Gymnasium environments: hold the contour line on a slope of unknown soil.

Importing this module registers ``grouser/LevelTraverse-v0``, with a vector form that simulates all
its rovers at once on all cores. It needs Gymnasium: ``pip install gymnasium``.

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
from ._runs import RunBatch

__all__ = ["LevelTraverseEnv", "LevelTraverseVectorEnv"]

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
    """Any number of rovers that should hold their lines: the common part of both environments."""

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
        drive, turn = shares[:, :1], shares[:, 1:]
        rims = self.fastest * np.clip(drive + turn * self.side, -1.0, 1.0)
        before = self.rovers.state[:, 0]
        state = self.rovers.step(rims, self.dt_s, mask=which)
        progress = (state[:, 0] - before) / (self.fastest * self.dt_s)
        offset = state[:, 1] / LINE_M
        lost = np.abs(state[:, 1]) > LOST_M
        ended = lost | np.array([outcome is not None for outcome in self.rovers.outcome])
        rewards = progress - offset * offset + PENALTY * ended
        return np.where(which, rewards, 0.0), ended & which

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


class LevelTraverseEnv(gymnasium.Env[Floats, Floats]):
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
    render_mode : None
        Rendering is not supported.

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `grouser.Scenario`; and for a key that both the scenario's mapping and an argument give,
        or that is not used.
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": []}  # type: ignore[misc]

    def __init__(
        self,
        *,
        scenario: Scenario | Source | None = None,
        soil: Soil | Source | None = None,
        slope_deg: Sequence[float] | None = None,
        max_speed_m_s: float = 0.1,
        dt_s: float = 0.5,
        render_mode: None = None,
    ) -> None:
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

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Floats, dict[str, Any]]:
        """Starts an episode; the seed determines slope, yaw and soil, except for those in
        ``options``."""
        given = _options_of(options, _OPTIONS)
        super().reset(seed=seed)
        self._traverses.reset(np.ones(1, dtype=np.bool_), [self.np_random], given)
        return self._traverses.observations()[0], self._traverses.info(0)

    def step(self, action: Floats) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """Applies an action for ``dt_s``."""
        all_of_one = np.ones(1, dtype=np.bool_)
        rewards, ended = self._traverses.step(np.asanyarray(action)[None], all_of_one)
        observation = self._traverses.observations()[0]
        return observation, float(rewards[0]), bool(ended[0]), False, self._traverses.info(0)


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
    **settings
        As for `LevelTraverseEnv`.
    """

    def __init__(
        self,
        num_envs: int = 1,
        *,
        max_episode_steps: int | None = MAX_EPISODE_STEPS,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        render_mode: None = None,
        **settings: Any,
    ) -> None:
        self.num_envs = num_envs
        self.render_mode = render_mode
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.metadata = {**LevelTraverseEnv.metadata, "autoreset_mode": self.autoreset_mode}
        self._traverses = _Traverses(num_envs, **settings)
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

    def step(
        self, actions: Floats
    ) -> tuple[Floats, Floats, NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """Applies an action to each for ``dt_s``; those whose episode has ended are reset according
        to ``autoreset_mode``."""
        if not self._randoms:
            raise gymnasium.error.ResetNeeded("reset the environments before the first step")
        again = self._ended.copy()
        if self.autoreset_mode is AutoresetMode.DISABLED and again.any():
            raise gymnasium.error.ResetNeeded(
                f"environments {_places(again)} have ended: reset them"
            )
        rewards, terminated = self._traverses.step(actions, ~again)
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

    def _infos(self, infos: dict[str, Any], which: NDArray[np.bool_]) -> dict[str, Any]:
        for k in _places(which):
            infos = self._add_info(infos, self._traverses.info(k), k)
        return infos


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
