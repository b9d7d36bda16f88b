"""Step-by-step simulation of rovers, for controllers and for learning."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import Floats, mask as mask_of, number, numbers
from ._descriptions import Scenario, Source
from ._errors import ParameterError, SimulationError
from ._linear import LinearStep

#: The quantity of the commands: speeds of wheels or of their rims.
Commands = Literal["wheel_speed_rad_s", "rim_speed_m_s"]

_SAMPLES, _WHEELS = _core.simulator_columns()
#: Pose and velocities stand between the time and the power.
_STATE_PLACES = range(1, _SAMPLES.index("power_w"))
_STATE = tuple(_SAMPLES[place] for place in _STATE_PLACES)


class RunState:
    """All that changes in a run, as a value: `Run.restore` sets a run of the same scenario to it.

    Made by `Run.save` and `RunBatch.save`. It has the rover's pose and velocities, its energies,
    battery and windings, what a reset sampled, and what the solver knows of the motion so far: a
    run goes on from it bit for bit. It does not change, compares by value, can be hashed and pickled, and ``bytes(state)`` are for
    files; the same version of Grouser reads them.

    Parameters
    ----------
    content : bytes
        Those of another state.

    Examples
    --------
    Two ways to go on from one place:

    >>> import grouser as gr
    >>> rover = gr.Run(slope_deg=10.0, commands="rim_speed_m_s")
    >>> state = rover.step(0.06, 1.0)
    >>> here = rover.save()
    >>> left = rover.step([0.03, 0.03, 0.09, 0.09], 0.5)
    >>> rover.restore(here).tolist() == state.tolist()
    True
    >>> right = rover.step([0.09, 0.09, 0.03, 0.03], 0.5)
    >>> gr.RunState(bytes(here)) == here
    True
    """

    __slots__ = ("_content",)
    _content: bytes

    def __init__(self, content: bytes) -> None:
        if not isinstance(content, bytes):
            kind = type(content).__name__
            raise ParameterError(f"content is of type {kind}, it must be bytes", "content")
        object.__setattr__(self, "_content", content)

    def __bytes__(self) -> bytes:
        return self._content

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("a RunState does not change")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, RunState):
            return NotImplemented
        return self._content == other._content

    def __hash__(self) -> int:
        return hash(self._content)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._content,)

    def __copy__(self) -> RunState:
        return self

    def __deepcopy__(self, memo: object) -> RunState:
        return self

    def __repr__(self) -> str:
        return f"<RunState of {len(self._content)} bytes>"


class RunBatch:
    """Step-by-step simulation of many rovers at once, on all cores and without Python's lock.

    Each rover has the same results as a `Run` of its own, bit for bit, for any number of cores. A
    rover whose run has ended stays as it is until it is reset. Like a `Run` it keeps the present
    states and no records.

    Parameters
    ----------
    scenarios : sequence of Scenario, names, paths or mappings
        The scenario of each rover; all rovers have the same number of wheels.
    commands : {"wheel_speed_rad_s", "rim_speed_m_s"}
        The quantity that `step` takes: speeds of the wheels [rad/s], or of their rims,
        ω (r + h_g) [m/s].

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `Scenario`.
    SimulationError
        If the initial state of a rover cannot be computed.

    Examples
    --------
    >>> import grouser as gr
    >>> slopes = [5.0, 10.0, 15.0]
    >>> rovers = gr.RunBatch([gr.Scenario(slope_deg=it) for it in slopes], commands="rim_speed_m_s")
    >>> state = rovers.step(0.06, 1.0)
    >>> uphill = state[:, rovers.STATE.index("y_m")].tolist()
    >>> state.shape, uphill[0] > uphill[1] > uphill[2]      # steeper slopes, more drift downhill
    ((3, 6), True)
    """

    STATE: ClassVar[tuple[str, ...]] = _STATE
    """Names of the columns of `state`, with units: position in the slope frame [m], yaw [°],
    speeds in the body frame [m/s], yaw rate [°/s]."""

    def __init__(
        self,
        scenarios: Sequence[Scenario | Source],
        *,
        commands: Commands = "wheel_speed_rad_s",
    ) -> None:
        if isinstance(scenarios, (str, Scenario)):
            raise ParameterError("scenarios is one scenario, it must be several", "scenarios")
        if commands not in ("wheel_speed_rad_s", "rim_speed_m_s"):
            raise ParameterError(
                f"commands is {commands!r}, it must be 'wheel_speed_rad_s' or 'rim_speed_m_s'",
                "commands",
            )
        runs = [one if isinstance(one, Scenario) else Scenario(one) for one in scenarios]
        if not runs:
            raise ParameterError("scenarios is empty, it must be at least one", "scenarios")
        self._scenarios = tuple(runs)
        self._commands: Commands = commands
        self._native = self._simulators([run._document for run in runs])
        self._read_states()

    def _simulators(self, documents: Sequence[_core.Document]) -> _core.Simulators:
        """What simulates the rovers."""
        return _core.Simulators(documents)

    def _read_states(self) -> None:
        """Reads the states of the rovers."""
        self._rows: Floats = self._native.samples()
        self._of_wheels: Floats | None = None
        self._statuses: list[tuple[str | None, str | None, str]] | None = None

    def __len__(self) -> int:
        return len(self._native)

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        slope_deg: ArrayLike | None = None,
        yaw_deg: ArrayLike | None = None,
        mask: ArrayLike | None = None,
    ) -> Floats:
        """Returns rovers to their start.

        Parameters
        ----------
        seed : int or sequence of int, optional
            Samples each soil from its ``[uncertainty]``, if it has one; rover k of a single seed
            has ``seed + k``. By default soils have the values of their documents.
        slope_deg, yaw_deg : array_like, shape () or (rovers,), optional
            Another slope [°] and yaw at the start [°] than the scenario's.
        mask : array_like of bool, shape (rovers,), optional
            Which rovers; by default all.

        Returns
        -------
        ndarray, shape (rovers, 6)
            The `state`.

        Raises
        ------
        ParameterError
            For values out of range; nothing changes then.
        """
        count = len(self)
        chosen = np.flatnonzero(self._mask(mask))
        seeds = _seeds(seed, count)
        slopes, yaws = (
            _each(name, values, count)
            for name, values in (("slope_deg", slope_deg), ("yaw_deg", yaw_deg))
        )
        self._native.reset(
            chosen.tolist(),
            [seeds[k] for k in chosen],
            [slopes[k] for k in chosen],
            [yaws[k] for k in chosen],
        )
        self._read_states()
        return self.state

    def step(self, commands: ArrayLike, dt_s: float, *, mask: ArrayLike | None = None) -> Floats:
        """Simulates a step with the given speeds of the wheels. Every wheel takes its speed at
        once and keeps it.

        Parameters
        ----------
        commands : array_like, shape (), (wheels,) or (rovers, wheels)
            Speeds in the quantity of the constructor's ``commands`` [rad/s or m/s]; rims at most
            10 m/s.
        dt_s : float
            Duration of the step [s], from 1e-6 to 86400.
        mask : array_like of bool, shape (rovers,), optional
            Which rovers take the step; by default all.

        Returns
        -------
        ndarray, shape (rovers, 6)
            The `state` afterwards.

        Raises
        ------
        ParameterError
            For invalid commands and times; nothing changes then. A rover whose motion cannot be
            computed has the `outcome` ``failed``, and the others continue.
        """
        shape = (len(self), len(self.wheel_names))
        array = numbers("commands", commands)
        try:
            whole = np.ascontiguousarray(np.broadcast_to(array, shape))
        except ValueError:
            raise ParameterError(
                f"commands has shape {array.shape}, it must broadcast to {shape}, rovers and wheels",
                "commands",
            ) from None
        span = number("dt_s", dt_s)
        try:
            are_rims = self._commands == "rim_speed_m_s"
            self._native.step(whole, are_rims, span, self._mask(mask))
        finally:
            # Ctrl-C may come after the step of some rovers.
            self._read_states()
        return self.state

    def save(self) -> tuple[RunState, ...]:
        """All that changes in each rover, as values from which `restore` goes on."""
        return tuple(RunState(content) for content in self._native.states())

    def restore(
        self, state: RunState | Sequence[RunState], *, mask: ArrayLike | None = None
    ) -> Floats:
        """Sets rovers to states, from which they go on as those did that were saved, bit for bit.

        Parameters
        ----------
        state : RunState or sequence of RunState
            One for all rovers, or one for each rover; of `save`, or of a `Run`.
        mask : array_like of bool, shape (rovers,), optional
            Which rovers; by default all.

        Returns
        -------
        ndarray, shape (rovers, 6)
            The `state` afterwards.

        Raises
        ------
        ParameterError
            For a state of another scenario, of another path, or of another version of Grouser;
            nothing changes then.
        """
        count = len(self)
        states = [state] * count if isinstance(state, RunState) else list(state)
        if len(states) != count:
            raise ParameterError(f"there are {len(states)} states for {count} rovers", "state")
        for one in states:
            if not isinstance(one, RunState):
                kind = type(one).__name__
                raise ParameterError(f"state is of type {kind}, it must be a RunState", "state")
        chosen = np.flatnonzero(self._mask(mask)).tolist()
        self._native.restore(chosen, [bytes(states[k]) for k in chosen])
        self._read_states()
        return self.state

    def _mask(self, mask: ArrayLike | None) -> NDArray[np.bool_]:
        if mask is None:
            return np.ones(len(self), dtype=np.bool_)
        return mask_of("mask", mask, len(self))

    def _column(self, name: str) -> Floats:
        return self._rows[:, _SAMPLES.index(name)].copy()

    @property
    def state(self) -> Floats:
        """Pose and velocities in the order of `STATE`; a copy of shape (rovers, 6)."""
        return np.ascontiguousarray(self._rows[:, _STATE_PLACES])

    @property
    def time_s(self) -> Floats:
        """Time since the start [s], shape (rovers,)."""
        return self._column("time_s")

    @property
    def power_w(self) -> Floats:
        """Power of all motors now [W], shape (rovers,)."""
        return self._column("power_w")

    @property
    def energy_j(self) -> Floats:
        """Work of the motors so far [J], shape (rovers,)."""
        return self._column("energy_j")

    @property
    def wheel_names(self) -> tuple[str, ...]:
        """The wheels of the first rover, in the order of their mounts."""
        return tuple(self._native.wheel_names)

    @property
    def wheel(self) -> Mapping[str, Floats]:
        """Forces and motion of each wheel by name, with the names of `Trajectory.wheel`: arrays of
        shape (rovers, wheels); NaN where a rover has just tipped over or sunk."""
        if self._of_wheels is None:
            self._of_wheels = self._native.wheel_samples()
        return MappingProxyType(dict(zip(_WHEELS, self._of_wheels.copy())))

    def _status(self) -> list[tuple[str | None, str | None, str]]:
        if self._statuses is None:
            self._statuses = self._native.statuses()
        return self._statuses

    @property
    def outcome(self) -> NDArray[np.object_]:
        """Outcome of each rover: None during its run, then a name of `grouser.OUTCOMES`, or
        ``failed`` where the motion cannot be computed."""
        return objects(status[0] for status in self._status())

    @property
    def message(self) -> NDArray[np.object_]:
        """The outcome explained, or None."""
        return objects(status[1] for status in self._status())

    @property
    def simulation(self) -> NDArray[np.object_]:
        """Method of each run: ``dynamic``; ``quasi-steady`` if its scenario asks for it;
        ``fell-back`` after a fallback from quasi-steady to dynamic, which holds until the wheels
        are to turn otherwise."""
        return objects(status[2] for status in self._status())

    @property
    def scenarios(self) -> tuple[Scenario, ...]:
        """The scenarios of the rovers."""
        return self._scenarios

    def __copy__(self) -> RunBatch:
        twin = object.__new__(type(self))
        twin.__dict__.update(self.__dict__)
        twin._native = self._native.copy()
        return twin

    def __deepcopy__(self, memo: dict[int, Any]) -> RunBatch:
        twin = object.__new__(type(self))
        memo[id(self)] = twin
        twin.__dict__.update(copy.deepcopy(self.__dict__, memo))
        return twin

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_native": self._native.states()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._native = self._simulators([run._document for run in self._scenarios])
        self._native.restore(list(range(len(self._native))), state["_native"])

    def __repr__(self) -> str:
        ended = sum(outcome is not None for outcome in self.outcome)
        return f"<RunBatch of {len(self)} rovers, {ended} ended>"


class Run:
    """Step-by-step simulation of a rover: each step takes commands and returns the state after it.

    The motion is that of `simulate`, with the same equations and the same integrator; with the
    commands of the scenario's drive it follows the same path. The scenario's duration and record
    interval are not used; its drive turns the wheels until the first step.

    Copies (``copy.copy``, ``copy.deepcopy``), a run that was pickled, also in another process, and
    a run that is set to a state (`save`, `restore`) continue as this one would, bit for bit, and
    share nothing with it.

    A run keeps its present state and no records, so that there is nothing to animate or to plot:
    keep what each step returns, as below. `Trajectory.animate` draws what a scenario's own drive
    does, from `simulate`.

    Parameters
    ----------
    scenario : Scenario, name, path or mapping, optional
        The scenario; by default the source paper's traverse.
    commands : {"wheel_speed_rad_s", "rim_speed_m_s"}
        The quantity that `step` takes: speeds of the wheels [rad/s], or of their rims,
        ω (r + h_g) [m/s].
    **changes
        Keys of the scenario with other values: ``slope_deg=15.0``. With
        ``simulation="quasi-steady"`` velocities are those of the steady state, which is faster to
        compute and differs a little: ``docs/guide/simulator.md`` has the differences.

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `Scenario`.
    SimulationError
        If the initial state cannot be computed.

    Examples
    --------
    Turning the nose uphill for two seconds, then straight on:

    >>> import grouser as gr
    >>> rover = gr.Run(slope_deg=10.0, commands="rim_speed_m_s")
    >>> rover.wheel_names
    ('front-left', 'rear-left', 'rear-right', 'front-right')
    >>> for _ in range(20):
    ...     state = rover.step([0.03, 0.03, 0.09, 0.09], 0.1)
    >>> state = rover.step(0.06, 3.0)
    >>> float(dict(zip(rover.STATE, state))["yaw_deg"]) > 0.0
    True
    >>> rover.wheel["slip_ratio"].shape, rover.outcome
    ((4,), None)

    The path of the next 5 s, a row for each state:

    >>> import numpy as np
    >>> path = np.array([rover.step(0.06, 0.1) for _ in range(50)])
    >>> x_m, y_m = path[:, rover.STATE.index("x_m")], path[:, rover.STATE.index("y_m")]
    >>> x_m.shape, bool(x_m[-1] > x_m[0])
    ((50,), True)
    """

    STATE: ClassVar[tuple[str, ...]] = _STATE
    """Names of the entries of `state`, with units: position in the slope frame [m], yaw [°], speeds
    in the body frame [m/s], yaw rate [°/s]."""

    def __init__(
        self,
        scenario: Scenario | Source | None = None,
        /,
        *,
        commands: Commands = "wheel_speed_rad_s",
        **changes: Any,
    ) -> None:
        unchanged = isinstance(scenario, Scenario) and not changes
        run: Any = scenario if unchanged else Scenario(scenario, **changes)
        self._batch = RunBatch([run], commands=commands)

    def reset(
        self,
        *,
        seed: int | None = None,
        slope_deg: float | None = None,
        yaw_deg: float | None = None,
    ) -> Floats:
        """Returns the rover to its start.

        Parameters
        ----------
        seed : int, optional
            Samples the soil from its ``[uncertainty]``, if it has one: the same seed gives the same
            soil. By default the soil has the values of its document.
        slope_deg, yaw_deg : float, optional
            Another slope [°] and yaw at the start [°] than the scenario's.

        Returns
        -------
        ndarray, shape (6,)
            The `state`.

        Raises
        ------
        ParameterError
            For values out of range.
        """
        slope = None if slope_deg is None else number("slope_deg", slope_deg)
        yaw = None if yaw_deg is None else number("yaw_deg", yaw_deg)
        state: Floats = self._batch.reset(seed=seed, slope_deg=slope, yaw_deg=yaw)[0]
        return state

    def step(self, commands: ArrayLike, dt_s: float) -> Floats:
        """Simulates a step with the given speeds of the wheels. Every wheel takes its speed at
        once and keeps it. A rover whose run has ended stays as it is.

        Parameters
        ----------
        commands : array_like, shape () or (wheels,)
            Speeds in the quantity of the constructor's ``commands`` [rad/s or m/s]; rims at most
            10 m/s.
        dt_s : float
            Duration of the step [s], from 1e-6 to 86400.

        Returns
        -------
        ndarray, shape (6,)
            The `state` afterwards.

        Raises
        ------
        ParameterError
            For invalid commands and times; nothing changes then.
        SimulationError
            If the motion cannot be computed.
        """
        array = self._commands(commands)
        failed_before = self.outcome == "failed"
        state: Floats = self._batch.step(array, dt_s)[0]
        if self.outcome == "failed" and not failed_before:
            raise SimulationError(str(self.message), self.time_s)
        return state

    def _commands(self, commands: ArrayLike) -> Floats:
        """Commands of one rover, checked."""
        wheels = len(self.wheel_names)
        array = numbers("commands", commands)
        if array.shape not in ((), (wheels,)):
            raise ParameterError(
                f"commands has shape {array.shape}, it must be one speed or ({wheels},), one for "
                "each wheel",
                "commands",
            )
        return array

    def save(self) -> RunState:
        """All that changes in the run, as a value from which `restore` goes on."""
        return self._batch.save()[0]

    def restore(self, state: RunState) -> Floats:
        """Sets the run to a state, from which it goes on as the saved one did, bit for bit.

        Parameters
        ----------
        state : RunState
            Of `save`, of this run or another one of the same scenario.

        Returns
        -------
        ndarray, shape (6,)
            The `state` afterwards.

        Raises
        ------
        ParameterError
            For a state of another scenario or another version of Grouser; nothing changes then.
        """
        restored: Floats = self._batch.restore([state])[0]
        return restored

    def linearise(self, commands: ArrayLike, dt_s: float) -> LinearStep:
        """The slopes of a step from here: of the state after it by the state before it, and by the
        commands. The run stays where it is.

        They are central differences of whole steps, by a thousandth of each number's scale: of the
        fastest rim's speed, a shearing radius, a radian. Slopes by a tenth of that show where a
        number has a kink. A dynamic motion is integrated within 1e-10 for them.

        Parameters
        ----------
        commands, dt_s
            As for `step`.

        Returns
        -------
        LinearStep
            The matrices, with names and units.

        Raises
        ------
        ParameterError
            As `step`.
        SimulationError
            If the run has ended; if it ends, or falls back from quasi-steady to dynamic, within the
            step or within one with a number moved; if the motion cannot be computed; and for a
            scenario that prescribes the yaw.
        """
        array = self._commands(commands)
        rows = np.ascontiguousarray(np.broadcast_to(array, (1, len(self.wheel_names))))
        quantity = self._batch._commands
        are_rims = quantity == "rim_speed_m_s"
        before, after, slopes, kinks, names = self._batch._native.linear_step(
            rows, are_rims, number("dt_s", dt_s)
        )
        return LinearStep(
            states=tuple(names),
            commands=tuple(f"{wheel}.{quantity}" for wheel in self.wheel_names),
            state=before,
            next_state=after,
            slopes=np.ascontiguousarray(slopes.T),
            one_sided=np.ascontiguousarray(kinks.T),
        )

    @property
    def state(self) -> Floats:
        """Pose and velocities in the order of `STATE`; a copy of shape (6,)."""
        state: Floats = self._batch.state[0]
        return state

    @property
    def time_s(self) -> float:
        """Time since the start [s]."""
        return float(self._batch.time_s[0])

    @property
    def power_w(self) -> float:
        """Power of all motors now [W]."""
        return float(self._batch.power_w[0])

    @property
    def energy_j(self) -> float:
        """Work of the motors so far [J]."""
        return float(self._batch.energy_j[0])

    @property
    def wheel_names(self) -> tuple[str, ...]:
        """The wheels, in the order of their mounts."""
        return self._batch.wheel_names

    @property
    def wheel(self) -> Mapping[str, Floats]:
        """Forces and motion of each wheel by name, with the names of `Trajectory.wheel`: arrays of
        shape (wheels,); NaN where the rover has just tipped over or sunk."""
        rows = self._batch.wheel
        return MappingProxyType({name: values[0] for name, values in rows.items()})

    @property
    def outcome(self) -> str | None:
        """Outcome: None during the run, then a name of `grouser.OUTCOMES`, or ``failed`` where the
        motion could not be computed."""
        outcome: str | None = self._batch.outcome[0]
        return outcome

    @property
    def message(self) -> str | None:
        """The outcome explained, or None."""
        message: str | None = self._batch.message[0]
        return message

    @property
    def simulation(self) -> str:
        """Method of the run: ``dynamic``, ``quasi-steady``, or ``fell-back`` from the second to the
        first."""
        return str(self._batch.simulation[0])

    @property
    def scenario(self) -> Scenario:
        """The scenario of the run."""
        return self._batch.scenarios[0]

    def __copy__(self) -> Run:
        twin = object.__new__(type(self))
        twin.__dict__.update(self.__dict__)
        twin._batch = copy.copy(self._batch)
        return twin

    def __repr__(self) -> str:
        state = ", ".join(f"{name}={value:.4g}" for name, value in zip(_STATE, self.state))
        return f"<Run at {self.time_s:.4g} s, {self.outcome or 'running'}: {state}>"


def objects(items: Any) -> NDArray[np.object_]:
    """Anything as an array."""
    listed = list(items)
    array: NDArray[np.object_] = np.empty(len(listed), dtype=object)
    array[:] = listed
    return array


def _seeds(seed: int | Sequence[int | None] | None, count: int) -> list[int | None]:
    """A seed for each rover."""
    if seed is None:
        return [None] * count
    if isinstance(seed, (int, np.integer)):
        given: list[int | None] = [int(seed) + k for k in range(count)]
    elif isinstance(seed, (str, bytes)) or not hasattr(seed, "__len__"):
        raise ParameterError(f"seed is {seed!r}, it must be a whole number", "seed")
    else:
        given = list(seed)
    if len(given) != count:
        raise ParameterError(f"there are {len(given)} seeds for {count} rovers", "seed")
    for one in given:
        whole = isinstance(one, (int, np.integer))
        if one is not None and not (whole and 0 <= one < 2**64):
            raise ParameterError(
                f"seed is {one!r}, it must be a whole number from 0 to below 2**64", "seed"
            )
    return [None if one is None else int(one) for one in given]


def _each(name: str, values: ArrayLike | None, count: int) -> list[float | None]:
    """A number for each rover, or None for all of them."""
    if values is None:
        return [None] * count
    array = numbers(name, values)
    if array.shape not in ((), (count,)):
        raise ParameterError(
            f"{name} has shape {array.shape}, it must be one number or ({count},)", name
        )
    return [float(value) for value in np.broadcast_to(array, (count,))]
