"""Following a path under stop conditions: one rover, and many at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import ArrayLike, NDArray

from .. import _core
from .._arrays import Floats, line, number, numbers
from .._descriptions import Scenario, Soil, Source
from .._errors import ParameterError
from .._runs import RunBatch, objects
from ._rovers import Rovers
from ._single import ONE, OneRoverEnv
from ._vector import ManyRoversEnv

#: The environment's name for ``gymnasium.make``.
PATH_ENV_ID = "grouser/PathFollowing-v0"
#: Steps after which ``gymnasium.make`` truncates an episode: two minutes at the usual period.
MAX_PATH_STEPS = 240

#: What an action sets: drive and turn, the speeds of the sides, or that of each wheel.
Actions = Literal["drive-turn", "sides", "wheels"]

#: The path where no argument names one [m]: two bends, and in the end a contour again.
USUAL_PATH = ((0.0, 0.0), (1.5, 0.0), (2.5, 0.5), (4.0, 0.5))
#: The limits where no argument names some: about the rover's length off the path.
USUAL_STOP = {"off_path_m": {"above": 0.5}}
#: The weights of the parts of the reward where no argument names them.
WEIGHTS = {
    "progress": 1.0,
    "cross_track": 1.0,
    "energy": 0.1,
    "completed": 50.0,
    "stopped": 50.0,
}
#: The cross-track error whose part of the reward has the size of that of the fastest progress [m]:
#: about a wheel's radius.
ERROR_M = 0.1
#: The largest observed cross-track error where no limit says how far a rover gets off its path [m].
FURTHEST_M = 10.0
#: Distance between the points of a path that is drawn [m]: far below a pixel.
DRAWN_M = 0.01

_BESIDE = tuple(_core.path_columns())
#: What is observed of the rover besides, in this order, and the largest of each; yaw and slope have
#: no others, speeds at least these.
_ROVER = ("yaw_deg", "slope_deg", "forward_speed_m_s", "lateral_speed_m_s", "yaw_rate_deg_s")
#: What is observed of each wheel, with the least and the largest.
_WHEEL = {"slip_ratio": (-2.0, 2.0), "sinkage_mm": (0.0, 500.0), "torque_nm": (-50.0, 50.0)}


class PathBatch(RunBatch):
    """Many rovers on one path."""

    def __init__(self, scenarios: Sequence[Scenario], task: _core.PathTask) -> None:
        self._task = task
        super().__init__(scenarios, commands="rim_speed_m_s")

    def _simulators(self, documents: Sequence[_core.Document]) -> _core.Simulators:
        return _core.Simulators(documents, self._task)

    def beside(self, ways_m: Sequence[float]) -> Floats:
        """Where each rover is beside its path, and the places ahead on it in its body frame."""
        return self._native.path_samples(ways_m)

    def ends(self) -> list[tuple[str | None, str | None, float | None, str | None]]:
        """What became of each: outcome, limit that stopped it, value, and a sentence."""
        ends = self._native.path_outcomes()
        failed = [(name, None, None, message) for name, message, _ in self._status()]
        return [mine if theirs[0] is None else theirs for theirs, mine in zip(ends, failed)]


class Paths(Rovers):
    """Any number of rovers that should follow a path."""

    batch: PathBatch
    _changing = ("slope_deg", "parts", "beside", "ends")

    def __init__(
        self,
        count: int,
        *,
        path: ArrayLike | Mapping[str, Any] | None = None,
        stop: Mapping[str, Any] | None = None,
        within_m: float = 0.1,
        actions: Actions = "drive-turn",
        weights: Mapping[str, float] | None = None,
        preview_m: Sequence[float] = (0.25, 0.5, 1.0),
        **settings: Any,
    ) -> None:
        self.task = _task(path, stop, number("within_m", within_m))
        self.weights = _weights(weights)
        self.ways: list[float] = line("preview_m", preview_m).tolist()
        if not all(0.0 < way < np.inf for way in self.ways):
            message = f"preview_m is {preview_m!r}, each way must be above 0"
            raise ParameterError(message, "preview_m", None, "above 0")
        if actions not in ("drive-turn", "sides", "wheels"):
            known = "'drive-turn', 'sides' or 'wheels'"
            message = f"actions is {actions!r}, it must be {known}"
            raise ParameterError(message, "actions", None, known)
        self.actions = actions
        super().__init__(count, **settings)
        self.start_heading_deg = float(self.task.at(np.zeros(1))[0, 2])
        self.route = self.task.at(np.arange(0.0, self.task.length_m + DRAWN_M, DRAWN_M))[:, :2]
        wheels = len(self.side)
        size = wheels if actions == "wheels" else 2
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (size,), dtype=np.float64)
        self.names, low, high = self._observed(self.batch.wheel_names)
        self.observation_space = gymnasium.spaces.Box(low, high, dtype=np.float64)
        self.parts = {name: np.zeros(count) for name in WEIGHTS}
        self._look()

    def _batch(self, scenarios: Sequence[Scenario]) -> RunBatch:
        return PathBatch(scenarios, self.task)

    def _observed(self, wheels: Sequence[str]) -> tuple[tuple[str, ...], Floats, Floats]:
        """Names of what is observed, and its bounds."""
        length, fastest = self.task.length_m, max(1.0, 2.0 * self.fastest)
        off = 2.0 * dict(self.task.limits).get("off_path_m", 0.5 * FURTHEST_M)
        rows = [("along_track_m", 0.0, length), ("cross_track_m", -off, off)]
        rows.append(("heading_error_deg", -180.0, 180.0))
        bounds = [(-180.0, 180.0), (0.0, 60.0), *[(-fastest, fastest)] * 2, (-180.0, 180.0)]
        rows += [(name, *bound) for name, bound in zip(_ROVER, bounds)]
        for way in self.ways:
            rows += [(f"ahead_{way:g}_m.{axis}_m", -way - off, way + off) for axis in "xy"]
        for name, bound in _WHEEL.items():
            rows += [(f"{wheel}.{name}", *bound) for wheel in wheels]
        names, low, high = zip(*rows)
        return tuple(names), np.array(low), np.array(high)

    def _look(self) -> None:
        self.beside = self.batch.beside(self.ways)
        self.ends = self.batch.ends()

    def reset(
        self,
        which: NDArray[np.bool_],
        randoms: Sequence[np.random.Generator],
        options: Mapping[str, Any],
    ) -> None:
        super().reset(which, randoms, options)
        for part in self.parts.values():
            part[which] = 0.0
        self._look()

    def step(
        self, actions: ArrayLike, which: NDArray[np.bool_]
    ) -> tuple[Floats, NDArray[np.bool_], NDArray[np.bool_]]:
        rims = self.rim_speeds(self.shares(actions))
        along, energy = self.beside[:, 0], self.batch.energy_j
        self.batch.step(rims, self.dt_s, mask=which)
        self._look()
        outcomes = [outcome for outcome, *_ in self.ends]
        completed = np.array([outcome == "completed" for outcome in outcomes])
        late = np.array([limit == "time_s" for _, limit, *_ in self.ends])
        ended = np.array([outcome is not None for outcome in outcomes]) & ~late
        error = self.beside[:, 1] / ERROR_M
        parts = {
            "progress": (self.beside[:, 0] - along) / (self.fastest * self.dt_s),
            "cross_track": -error * error,
            "energy": energy - self.batch.energy_j,
            "completed": completed.astype(np.float64),
            "stopped": np.where(ended & ~completed, -1.0, 0.0),
        }
        rewards = np.zeros(len(which))
        for name, part in parts.items():
            self.parts[name] = np.where(which, self.weights[name] * part, 0.0)
            rewards = rewards + self.parts[name]
        return rewards, ended & which, late & which

    def rim_speeds(self, shares: Floats) -> Floats:
        if self.actions == "drive-turn":
            return super().rim_speeds(shares)
        if self.actions == "sides":
            shares = np.where(self.side < 0.0, shares[:, :1], shares[:, 1:])
        rims: Floats = self.fastest * shares
        return rims

    def observations(self) -> Floats:
        state, wheel, count = self.batch.state, self.batch.wheel, len(_BESIDE)
        columns = {name: state[:, k] for k, name in enumerate(self.batch.STATE)}
        columns["yaw_deg"] = (columns["yaw_deg"] + 180.0) % 360.0 - 180.0
        columns["slope_deg"] = self.slope_deg
        rover = np.stack([columns[name] for name in _ROVER], axis=1)
        # A rover that has just tipped over or sunk has no torque: NaN.
        wheels = [np.nan_to_num(wheel[name]) for name in _WHEEL]
        all_of_it = [self.beside[:, :count], rover, self.beside[:, count:], *wheels]
        space = self.observation_space
        observations: Floats = np.clip(np.concatenate(all_of_it, axis=1), space.low, space.high)
        return observations

    def outcome(self, k: int) -> str | None:
        return self.ends[k][0]

    def outcomes(self) -> NDArray[np.object_]:
        return objects(outcome for outcome, *_ in self.ends)

    def columns(self) -> dict[str, NDArray[Any]]:
        columns: dict[str, NDArray[Any]] = {
            **super().columns(),
            "y_m": self.batch.state[:, 1],
            "time_s": self.batch.time_s,
            **{name: self.beside[:, place] for place, name in enumerate(_BESIDE)},
            "stopped_by": objects(limit for _, limit, *_ in self.ends),
            "reason": objects(reason for *_, reason in self.ends),
            **{f"reward_{name}": part for name, part in self.parts.items()},
        }
        values = np.array([np.nan if value is None else value for _, _, value, _ in self.ends])
        if not np.isnan(values).all():
            # Numbers of those rovers alone that have one.
            columns["stopped_value"] = np.ma.masked_invalid(values)
        return columns

    def info(self, k: int) -> dict[str, Any]:
        _, stopped_by, value, reason = self.ends[k]
        info = {
            **super().info(k),
            "y_m": float(self.batch.state[k, 1]),
            "time_s": float(self.batch.time_s[k]),
            **{name: float(self.beside[k, place]) for place, name in enumerate(_BESIDE)},
            "stopped_by": stopped_by,
            "reason": reason,
            **{f"reward_{name}": float(part[k]) for name, part in self.parts.items()},
        }
        # Numbers beside None would not make an array of numbers in a vector environment.
        return info if value is None else {**info, "stopped_value": value}


class PathFollowingEnv(OneRoverEnv):
    """Follow a path on a slope of unknown soil, with a rover that cannot steer its wheels, and stay
    within limits on slip, drift, sinkage and others.

    The rover starts at x = y = 0, at the heading of the path plus −10 to 10°. Each reset samples
    the slope, that yaw and the soil, from its ``[uncertainty]``.

    **Action**, numbers from −1 to 1 in ``max_speed_m_s``, for ``dt_s``: with
    ``actions="drive-turn"`` drive and turn to the left, as of `LevelTraverseEnv`; with ``"sides"``
    the rim speeds on the left and on the right; with ``"wheels"`` that of every wheel, in the
    mounts' order.

    **Observation**, float64, clipped to the space's bounds, in the order of `observation_names`:
    length of the path so far (along-track) [m]; distance to the left of the path (cross-track) [m];
    yaw less the heading of the path there [°]; yaw [°]; slope [°]; forward and lateral speed of the
    body [m/s]; yaw rate [°/s]; the places on the path ``preview_m`` ahead, x forward and y to the
    left of the body [m]; then slip ratio of every wheel, sinkage [mm] of every wheel, motor torque
    [N·m] of every wheel.

    **Reward** of a step, the sum of these parts by their ``weights``: ``progress``, length of the
    path gained over the longest possible, Δs/(max_speed dt); ``cross_track``, −(cross-track
    error/0.1 m)²; ``energy``, less the work of the motors [J]; ``completed``, 1 where the end of
    the path is reached; ``stopped``, −1 where the episode terminates otherwise. The usual weights
    are 1, 1, 0.1, 50 and 50.

    **Stop conditions**, in ``stop``, are the limits of a mission under the same keys, looked at
    each tenth of a second as there: the episode ends at the time at which one was passed, also
    within a step.

    **Termination**: the end of the path is within ``within_m`` (``completed``); a limit is passed
    (``stopped``); the rover goes past the end further off, as if by a limit ``off_path_m``; it gets
    stuck, slides or tips over. A limit on ``time_s`` truncates, as does ``gymnasium.make`` after
    240 steps, two minutes.

    **Info**: ``outcome`` (None until the end), ``stopped_by``, the limit that was passed, by its
    key, ``stopped_value``, the number in the key's unit (only with ``stopped_by``), ``reason``, the
    same as a sentence; ``x_m``, ``y_m``, ``time_s``, ``along_track_m``, ``cross_track_m``,
    ``heading_error_deg``, ``slope_deg``, ``energy_j``, ``fallback_to_dynamic``; and each weighted
    part of the reward: ``reward_progress`` and so on.

    **Options** of a reset are those of `LevelTraverseEnv`.

    Parameters
    ----------
    path : array_like of shape (waypoints, 2), or mapping, optional
        Waypoints in the slope frame [m], x along the contour and y uphill from where the rover
        starts; or ``{"arc": {"radius_m": 2.0, "angle_deg": 90.0}}``, an arc that begins at the
        rover, to the left for angles above 0, with ``heading_deg`` at its start (by default 0); or
        ``{"contour_m": 5.0}``, so far along the contour, backward below 0. By default two bends.
    stop : mapping, optional
        Limits by the keys of ``[stop]`` in a mission: ``{"slip_ratio": {"above": 0.4, "over_m":
        1.0}}``; by default ``{"off_path_m": {"above": 0.5}}``.
    within_m : float
        How near to the end of the path is near enough [m].
    actions : {"drive-turn", "sides", "wheels"}
        What an action sets.
    weights : mapping of str to float, optional
        Weights of parts of the reward, in place of the usual ones.
    preview_m : sequence of float
        How far ahead the path is observed [m].
    scenario, soil, slope_deg, max_speed_m_s, dt_s, render_mode
        As for `LevelTraverseEnv`; pictures show the path.

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `LevelTraverseEnv`; and for a path, a limit or a weight that is none.

    Examples
    --------
    A rover with one speed for all wheels, on a contour at 15°: a limit on drift stops it.

    >>> import numpy as np
    >>> from grouser.gym import PathFollowingEnv
    >>> env = PathFollowingEnv(
    ...     path={"contour_m": 5.0},
    ...     stop={"drift_m": {"above": 0.05, "over_m": 0.5}},
    ...     soil="toyoura",
    ...     slope_deg=(15.0, 15.0),
    ... )
    >>> observation, info = env.reset(seed=1, options={"yaw_deg": 0.0})
    >>> while info["outcome"] is None:
    ...     observation, reward, terminated, truncated, info = env.step(np.array([0.6, 0.0]))
    >>> terminated, info["stopped_by"], info["stopped_value"] > 0.05
    (True, 'drift_m', True)
    """

    _rovers: Paths

    def __init__(
        self,
        *,
        path: ArrayLike | Mapping[str, Any] | None = None,
        stop: Mapping[str, Any] | None = None,
        within_m: float = 0.1,
        actions: Actions = "drive-turn",
        weights: Mapping[str, float] | None = None,
        preview_m: Sequence[float] = (0.25, 0.5, 1.0),
        scenario: Scenario | Source | None = None,
        soil: Soil | Source | None = None,
        slope_deg: Sequence[float] | None = None,
        max_speed_m_s: float = 0.1,
        dt_s: float = 0.5,
        render_mode: str | None = None,
    ) -> None:
        rovers = Paths(
            1,
            path=path,
            stop=stop,
            within_m=within_m,
            actions=actions,
            weights=weights,
            preview_m=preview_m,
            scenario=scenario,
            soil=soil,
            slope_deg=slope_deg,
            max_speed_m_s=max_speed_m_s,
            dt_s=dt_s,
        )
        super().__init__(rovers, render_mode)

    @property
    def observation_names(self) -> tuple[str, ...]:
        """What the numbers of an observation are, with units."""
        return self._rovers.names

    @property
    def path_length_m(self) -> float:
        """Length of the path [m]."""
        return self._rovers.task.length_m

    def _advance(self, action: Floats) -> tuple[float, bool, bool]:
        # With the arithmetic of the vector form, bit for bit.
        rewards, ended, late = self._rovers.step(np.asanyarray(action)[None], ONE)
        return float(rewards[0]), bool(ended[0]), bool(late[0])


class PathFollowingVectorEnv(ManyRoversEnv):
    """Many `PathFollowingEnv` at once, on all cores; the same seeds give the same results, bit for
    bit. All rovers follow the same path.

    Parameters
    ----------
    num_envs, max_episode_steps, autoreset_mode, render_mode
        As for `LevelTraverseVectorEnv`.
    **settings
        As for `PathFollowingEnv`, except for ``render_mode``.

    Examples
    --------
    Eight rovers turn towards the place half a metre ahead on the path: do they stay on it?

    >>> import numpy as np
    >>> from grouser.gym import PathFollowingVectorEnv
    >>> envs = PathFollowingVectorEnv(8, slope_deg=(5.0, 10.0))
    >>> names = list(envs.observation_names)
    >>> x, y = (names.index(f"ahead_0.5_m.{axis}_m") for axis in "xy")
    >>> observations, infos = envs.reset(seed=1)
    >>> for _ in range(20):
    ...     turn = np.arctan2(observations[:, y], observations[:, x])
    ...     actions = np.stack([np.full(8, 0.6), turn.clip(-1.0, 1.0)], axis=1)
    ...     observations, rewards, terminated, truncated, infos = envs.step(actions)
    >>> bool((np.abs(infos["cross_track_m"]) < 0.2).all()), bool(terminated.any())
    (True, False)
    """

    _rovers: Paths

    def __init__(
        self,
        num_envs: int = 1,
        *,
        max_episode_steps: int | None = MAX_PATH_STEPS,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        render_mode: str | None = None,
        **settings: Any,
    ) -> None:
        rovers = Paths(num_envs, **settings)
        super().__init__(rovers, max_episode_steps, autoreset_mode, render_mode)

    @property
    def observation_names(self) -> tuple[str, ...]:
        """What the numbers of an observation are, with units."""
        return self._rovers.names


def _task(
    path: ArrayLike | Mapping[str, Any] | None, stop: Mapping[str, Any] | None, within_m: float
) -> _core.PathTask:
    """The path, and the limits on the way."""
    limits = USUAL_STOP if stop is None else stop
    if not isinstance(limits, Mapping):
        kind = type(limits).__name__
        raise ParameterError(f"stop is of type {kind}, it must be a mapping of limits", "stop")
    stops = dict(limits)
    if isinstance(path, Mapping):
        if list(path) == ["arc"]:
            return _core.PathTask.arc(*_arc(path["arc"]), within_m, stops)
        if list(path) == ["contour_m"]:
            length = number("path.contour_m", path["contour_m"])
            return _core.PathTask.through(np.array([[0.0, 0.0], [length, 0.0]]), within_m, stops)
        known = "waypoints, {'arc': …} or {'contour_m': …}"
        message = f"path has the keys {list(path)}, it must be {known}"
        raise ParameterError(message, "path", None, known)
    places = numbers("path", USUAL_PATH if path is None else path)
    if places.ndim != 2 or places.shape[1] != 2 or len(places) < 2:
        raise ParameterError(
            f"path has shape {places.shape}, it must be (waypoints, 2), with two waypoints or more",
            "path",
        )
    return _core.PathTask.through(np.ascontiguousarray(places), within_m, stops)


def _arc(arc: Any) -> tuple[float, float, float]:
    """Radius [m], heading at the start [°] and angle [°]."""
    known = {"radius_m": None, "heading_deg": 0.0, "angle_deg": None}
    if not isinstance(arc, Mapping):
        message = "path.arc must be a mapping: radius_m, angle_deg, heading_deg"
        raise ParameterError(message, "path.arc")
    for name in arc:
        if name not in known:
            raise ParameterError(
                f"path.arc has no key {name!r}; it has {', '.join(known)}", f"path.arc.{name}"
            )
    values = {**known, **arc}
    for name, value in values.items():
        if value is None:
            raise ParameterError(f"path.arc lacks {name}", f"path.arc.{name}")
    radius, heading, angle = (number(f"path.arc.{name}", values[name]) for name in known)
    return radius, heading, angle


def _weights(given: Mapping[str, float] | None) -> dict[str, float]:
    """The weights of all parts of the reward."""
    if given is not None and not isinstance(given, Mapping):
        kind = type(given).__name__
        raise ParameterError(f"weights is of type {kind}, it must be a mapping", "weights")
    weights = dict(WEIGHTS)
    for name, value in (given or {}).items():
        if name not in weights:
            listed = ", ".join(weights)
            raise ParameterError(
                f"the reward has no part {name!r}; it has {listed}", f"weights.{name}", None, listed
            )
        weights[name] = number(f"weights.{name}", value)
        if not np.isfinite(weights[name]):
            raise ParameterError(
                f"weights.{name} is {weights[name]}, it must be finite", f"weights.{name}"
            )
    return weights
