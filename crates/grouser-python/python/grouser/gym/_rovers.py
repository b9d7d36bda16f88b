"""Any number of rovers on slopes of unknown soil, and what all environments have in common: what a
reset samples, what an action turns, what is observed."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import gymnasium
import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._arrays import Floats, number, numbers
from .._descriptions import Scenario, Soil, Source
from .._errors import ParameterError
from .._runs import RunBatch, RunState
from ._options import OPTIONS, given
from ._start import start_of

#: The range of the sampled yaw at the start [°].
START_YAW_DEG = (-10.0, 10.0)
#: Names of the observations of the rover, with units.
_ROVER = ("y_m", "yaw_deg", "forward_speed_m_s", "lateral_speed_m_s", "yaw_rate_deg_s")
#: Bounds of the same; values beyond are clipped, far outside the range of an episode that
#: continues.
_ROVER_BOUNDS = (1.0, 180.0, 1.0, 1.0, 180.0)
#: Names of the observations of each wheel, with units, and their bounds.
_WHEEL = ("wheel_speed_rad_s", "torque_nm", "power_w")
_WHEEL_BOUNDS = (20.0, 50.0, 100.0)


@dataclass(frozen=True, eq=False)
class EnvState:
    """All that changes in an environment, as a value: ``env.restore(state)`` sets one with the same
    scenario to it. It can be pickled.

    Made by `RoverEnv.save` and that of the other environments.

    Attributes
    ----------
    rovers : tuple of RunState
        That of each rover.
    memory : mapping
        What the environment keeps beside them: random generators, slopes, counts of steps, paths
        of pictures.
    """

    rovers: tuple[RunState, ...]
    memory: Mapping[str, Any]


class Rovers:
    """Any number of rovers: the common part of all environments."""

    #: Attributes that steps and resets change, beside the rovers themselves.
    _changing: ClassVar[tuple[str, ...]] = ("slope_deg",)

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
        run, slopes = start_of(scenario, soil, slope_deg)
        self.slopes = slopes
        self.fastest = number("max_speed_m_s", max_speed_m_s)
        if not 0.0 < self.fastest <= 10.0:
            raise ParameterError(
                f"max_speed_m_s is {self.fastest}, it must be above 0, at most 10",
                "max_speed_m_s",
                self.fastest,
            )
        self.dt_s = number("dt_s", dt_s)
        self.batch = self._batch([run] * count)
        # Wheels on the left side are those with y > 0 in the body frame.
        left = [mount["position_m"][1] > 0.0 for mount in run.rover.mount]
        self.side = np.where(left, -1.0, 1.0)
        bounds = np.array([*_ROVER_BOUNDS, *np.repeat(_WHEEL_BOUNDS, len(left))])
        self.observation_space = gymnasium.spaces.Box(-bounds, bounds, dtype=np.float64)
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (2,), dtype=np.float64)
        self.slope_deg = np.full(count, slopes[1])
        #: Where a rover sets out, without what is sampled of it [°].
        self.start_heading_deg = 0.0
        #: Points of what it should follow, drawn in pictures [m]; without them the contour line.
        self.route: Floats | None = None

    def _batch(self, scenarios: Sequence[Scenario]) -> RunBatch:
        """What simulates the rovers."""
        return RunBatch(scenarios, commands="rim_speed_m_s")

    def reset(
        self,
        which: NDArray[np.bool_],
        randoms: Sequence[np.random.Generator],
        options: Mapping[str, Any],
    ) -> None:
        """Samples slope, yaw and soil of each rover, in this order, from its own generator; options
        replace sampled values."""
        count = len(randoms)
        given_slopes, given_yaws, given_seeds = (given(name, options, count) for name in OPTIONS)
        slopes, yaws = self.slope_deg.copy(), np.zeros(count)
        seeds: list[int | None] = [0] * count
        for k in places(which):
            slopes[k] = randoms[k].uniform(*self.slopes)
            yaws[k] = _turned(self.start_heading_deg + randoms[k].uniform(*START_YAW_DEG))
            seeds[k] = int(randoms[k].integers(2**63))
            slopes[k] = slopes[k] if given_slopes is None else given_slopes[k]
            yaws[k] = yaws[k] if given_yaws is None else given_yaws[k]
            seeds[k] = seeds[k] if given_seeds is None else given_seeds[k]
        self.batch.reset(seed=seeds, slope_deg=slopes, yaw_deg=yaws, mask=which)
        self.slope_deg = slopes

    def save(self, memory: Mapping[str, Any]) -> EnvState:
        """The state of an environment that keeps so much beside the rovers."""
        own = {name: getattr(self, name) for name in self._changing}
        return EnvState(self.batch.save(), copy.deepcopy({"own": own, **memory}))

    def restore(self, state: EnvState, *names: str) -> dict[str, Any]:
        """Sets the rovers to a state, and returns what the environment keeps beside them, by these
        names."""
        if not isinstance(state, EnvState):
            kind = type(state).__name__
            raise ParameterError(f"state is of type {kind}, it must be an EnvState", "state")
        memory: dict[str, Any] = copy.deepcopy(dict(state.memory))
        own = memory.pop("own", {})
        if own.keys() != set(self._changing) or memory.keys() != set(names):
            raise ParameterError("the state is of another kind of environment", "state")
        self.batch.restore(state.rovers)
        for name, value in own.items():
            setattr(self, name, value)
        return memory

    def step(
        self, actions: ArrayLike, which: NDArray[np.bool_]
    ) -> tuple[Floats, NDArray[np.bool_], NDArray[np.bool_]]:
        """Rewards, which episodes ended by what the rover did, and which are cut off here: those of
        a task."""
        raise NotImplementedError

    def shares(self, actions: ArrayLike) -> Floats:
        """Actions of all rovers, checked, each number limited to −1 to 1."""
        shares = np.clip(numbers("action", actions), -1.0, 1.0)
        size = self.action_space.shape[0]
        if shares.shape != (len(self.batch), size) or np.isnan(shares).any():
            count = "two" if size == 2 else str(size)
            raise ParameterError(
                f"the action is {actions!r}, it must be {count} numbers for each rover, from -1 to "
                "1",
                "action",
            )
        return shares

    def rim_speeds(self, shares: Floats) -> Floats:
        """Rim speeds [m/s] of drive and turn, a row for each rover."""
        drive, turn = shares[:, :1], shares[:, 1:]
        rims: Floats = self.fastest * np.clip(drive + turn * self.side, -1.0, 1.0)
        return rims

    def observations(self) -> Floats:
        state, wheel = self.batch.state, self.batch.wheel
        rover = [state[:, [self.batch.STATE.index(name)]] for name in _ROVER]
        # A rover that has just tipped over or sunk has no torque: NaN.
        wheels = [np.nan_to_num(wheel[name]) for name in _WHEEL]
        high = self.observation_space.high
        observations: Floats = np.clip(np.concatenate([*rover, *wheels], axis=1), -high, high)
        return observations

    def outcome(self, k: int) -> str | None:
        """What became of a rover; None during its episode."""
        outcome: str | None = self.batch.outcome[k]
        return outcome

    def columns(self) -> dict[str, NDArray[Any]]:
        """What `info` has of each rover, as arrays."""
        fallback = ~np.isin(self.batch.simulation.astype(str), ("dynamic", "quasi-steady"))
        return {
            "x_m": self.batch.state[:, 0],
            "slope_deg": self.slope_deg,
            "energy_j": self.batch.energy_j,
            "outcome": self.outcomes(),
            "fallback_to_dynamic": fallback,
        }

    def outcomes(self) -> NDArray[np.object_]:
        """What became of each rover."""
        return self.batch.outcome

    def info(self, k: int) -> dict[str, Any]:
        return {
            "x_m": float(self.batch.state[k, 0]),
            "slope_deg": float(self.slope_deg[k]),
            "energy_j": float(self.batch.energy_j[k]),
            "outcome": self.outcome(k),
            "fallback_to_dynamic": self.batch.simulation[k] not in ("dynamic", "quasi-steady"),
        }


def _turned(yaw_deg: float) -> float:
    """A yaw from −180 to 180°; one that is, is not touched."""
    return yaw_deg if abs(yaw_deg) <= 180.0 else (yaw_deg + 180.0) % 360.0 - 180.0


def places(which: NDArray[np.bool_]) -> list[int]:
    chosen: list[int] = np.flatnonzero(which).tolist()
    return chosen
