"""The slip of wheels from the currents of their motors."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import Floats, broadcast, number, numbers, whole_number
from ._descriptions import Scenario, Source
from ._errors import ParameterError
from ._studies import scenario_of

#: Columns with words.
_WORDS = ("status", "reason")


class SlipEstimator:
    """Estimates each wheel's slip ratio from the current of its motor and its speed.

    The current gives the torque on the wheel, and in the soil a torque belongs to a slip ratio.
    It is made once, and asked for each reading, or for arrays of them. Each reading stands alone:
    the estimator remembers torques that it computed, which changes the time that an answer takes
    and no answer.

    Parameters
    ----------
    scenario : Scenario, name, path or mapping, optional
        Its rover, soil, gravity, model, load transfer and slope are used; its drive and start are
        not. Without it the default scenario on level ground.
    relative_noise : float
        Standard deviation of the torque that a current gives, as a share of it [-].
    noise_nm : float
        Its part that does not depend on the torque [N·m].
    slip_ratio : (float, float)
        The lowest and the highest slip ratio that are possible [-], -1 to 1.
    uncertainty : bool
        Whether the soil is uncertain, as its document says, and the wheel–soil model, where none is
        asked for by ``model``.
    samples : int
        Number of samples of them, 2 to 100000.
    seed : int
        Seed of the samples.
    **changes
        Keys of the scenario with other values: ``rover``, ``soil``, ``gravity_m_s2``, ``model``, …

    Raises
    ------
    ParameterError
        For a rover none of whose wheels has a motor, and values out of their ranges.

    Examples
    --------
    >>> import grouser as gr
    >>> motor = {"resistance_ohm": 10.0, "torque_constant_nm_a": 0.01, "gear_ratio": 250.0,
    ...          "gear_efficiency": 0.6, "friction_torque_nm": 0.001}
    >>> rover = gr.Rover("hakuto", motor=motor)
    >>> slip = gr.SlipEstimator(rover=rover, soil="toyoura")
    >>> found = slip.estimate(0.31, 0.545, wheel="front-left", load_n=13.1)
    >>> round(float(found["slip_ratio_p50"]), 2), found["status"].item()
    (0.26, 'ok')
    >>> run = gr.simulate(rover=rover, slope_deg=8.0, start={"yaw_deg": 90.0}, duration_s=2.0)
    >>> all_wheels = slip.estimate(run.wheel["current_a"], run.wheel["wheel_speed_rad_s"],
    ...                            slope_deg=8.0, yaw_deg=run.yaw_deg)
    >>> error = all_wheels["slip_ratio_p50"] - run.wheel["slip_ratio"]
    >>> bool(abs(error[-1]).max() < 0.01)
    True
    """

    def __init__(
        self,
        scenario: Scenario | Source | None = None,
        /,
        *,
        relative_noise: float = 0.05,
        noise_nm: float = 0.005,
        slip_ratio: Sequence[float] = (-0.2, 1.0),
        uncertainty: bool = False,
        samples: int = 200,
        seed: int = 1,
        **changes: Any,
    ) -> None:
        if scenario is None:
            changes.setdefault("slope_deg", 0.0)
        slips = numbers("slip_ratio", slip_ratio)
        if slips.shape != (2,):
            raise ParameterError(f"slip_ratio has shape {slips.shape}, it must be two numbers", "slip_ratio")
        count = whole_number("samples", samples, most=100_000)
        if count < 2:
            raise ParameterError(f"samples is {count}, it must be from 2 to 100000", "samples")
        self._scenario = scenario_of(scenario, changes)
        self._settings = (
            [number("relative_noise", relative_noise), number("noise_nm", noise_nm)],
            slips.tolist(),
            count if uncertainty else 0,
            whole_number("seed", seed),
        )
        self._prepare()

    def _prepare(self) -> None:
        self._native = _core.SlipFromCurrent(self._scenario._document, *self._settings)

    def __getstate__(self) -> dict[str, Any]:
        return {"_scenario": self._scenario, "_settings": self._settings}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._prepare()

    @property
    def scenario(self) -> Scenario:
        """The scenario."""
        return self._scenario

    @property
    def wheel_names(self) -> tuple[str, ...]:
        """The wheels, in the order of their mounts."""
        return tuple(self._native.wheel_names)

    def estimate(
        self,
        current_a: ArrayLike,
        wheel_speed_rad_s: ArrayLike,
        *,
        wheel: str | None = None,
        load_n: ArrayLike | None = None,
        slip_angle_deg: ArrayLike | None = None,
        steering_deg: ArrayLike | None = None,
        slope_deg: ArrayLike | None = None,
        yaw_deg: ArrayLike | None = None,
        course_deg: ArrayLike | None = None,
    ) -> dict[str, NDArray[Any]]:
        """The slip ratio of one reading, or of arrays of them.

        Parameters
        ----------
        current_a : array_like, shape (…, wheels), or of any shape for one wheel
            Current of the motors [A], negative where they brake; NaN where it was not read.
        wheel_speed_rad_s : array_like
            Angular speed of the wheels [rad/s]; broadcasts with the currents.
        wheel : str, optional
            The wheel whose readings these are. Without it the last axis is over all wheels of the
            rover, in the order of ``wheel_names``.
        load_n : array_like, optional
            Loads on the wheels [N]. Without them they follow from slope, yaw and the torques of all
            wheels that were read, in steady motion.
        slip_angle_deg : array_like, optional
            Slip angles [°], positive where the hub moves to the left; without them those of yaw,
            steering and course.
        steering_deg : array_like, optional
            Steering angles [°], positive to the left; without them those of the rover.
        slope_deg : array_like, optional
            Slope [°]; by default the scenario's. This and the next two broadcast with the currents,
            but for the axis of the wheels.
        yaw_deg : array_like, optional
            Yaw [°], positive uphill; 0 without it.
        course_deg : array_like, optional
            Direction of travel from the contour [°], positive uphill. Without it the rover goes
            where it points.

        Returns
        -------
        dict of arrays
            ``slip_ratio_p50``, the median, and the ends ``slip_ratio_p2_5`` and
            ``slip_ratio_p97_5`` of the 95 % interval, with its ``slip_ratio_width``;
            ``torque_nm``, ``load_n`` and ``slip_angle_deg``, which they rest on; ``status``
            (``ok``, ``ill-posed`` where the interval is wider than 0.2, or why there is none) and
            ``reason``, a sentence on it or None. Numbers are NaN where the status says why, and
            where nothing was read; there the status is None.
        """
        wheels = {
            "current_a": current_a,
            "wheel_speed_rad_s": wheel_speed_rad_s,
            "load_n": np.nan if load_n is None else load_n,
            "slip_angle_deg": np.nan if slip_angle_deg is None else slip_angle_deg,
            "steering_deg": np.nan if steering_deg is None else steering_deg,
        }
        rovers = {
            "slope_deg": np.nan if slope_deg is None else slope_deg,
            "yaw_deg": np.nan if yaw_deg is None else yaw_deg,
            "course_deg": np.nan if course_deg is None else course_deg,
        }
        names = self.wheel_names
        if wheel is None:
            given = broadcast(wheels, {})
            if given.shape[-1:] != (len(names),):
                raise ParameterError(
                    f"current_a and wheel_speed_rad_s have shape {given.shape}, the last axis must be over the "
                    f"{len(names)} wheels {', '.join(names)}; or name one by wheel",
                    "current_a",
                )
            shape, records = given.shape, given.shape[:-1]
            columns = [values.reshape(-1, len(names)) for values in given.flat.values()]
        else:
            if wheel not in names:
                known = ", ".join(names)
                raise ParameterError(f"wheel is {wheel!r}, it must be of {known}", "wheel")
            given = broadcast({**wheels, **rovers}, {})
            shape = records = given.shape
            columns = [self._only(wheel, given.flat[name]) for name in wheels]
        of_records = [_spread(name, values, records) for name, values in rovers.items()]
        found = self._native.estimate(columns, of_records)
        place = slice(None) if wheel is None else slice(names.index(wheel), None, len(names))
        result: dict[str, NDArray[Any]] = {}
        for name, values in found.items():
            array = np.array(values, dtype=object) if name in _WORDS else values
            result[name] = array[place].reshape(shape)
        return result

    def _only(self, wheel: str, values: Floats) -> Floats:
        """Readings of one wheel among none of the others."""
        names = self.wheel_names
        columns = np.full((values.size, len(names)), np.nan)
        columns[:, names.index(wheel)] = values
        return columns

    def __repr__(self) -> str:
        return f"<SlipEstimator of {len(self.wheel_names)} wheels: {', '.join(self.wheel_names)}>"


def _spread(name: str, values: ArrayLike, shape: tuple[int, ...]) -> Floats:
    """Numbers of a rover for each of its records."""
    array = numbers(name, values)
    try:
        return np.ascontiguousarray(np.broadcast_to(array, shape)).ravel()
    except ValueError:
        raise ParameterError(
            f"{name} has shape {array.shape}, it must broadcast to {shape}", name
        ) from None
