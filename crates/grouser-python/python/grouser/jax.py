"""Settled wheels and control steps as functions that JAX differentiates: forward and in reverse,
batched, and under ``jit`` by calling back into the library.

JAX computes with 32 bits unless ``jax.config.update("jax_enable_x64", True)`` was called; the
library always computes with 64, so that derivatives keep their digits, and results are rounded to
what JAX has. There are first derivatives only.

It needs JAX: ``pip install grouser[jax]``. How much harder does a wheel pull the more it
slips?

>>> import jax
>>> import grouser.jax as gj
>>> def pull(slip_ratio):
...     return gj.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=slip_ratio)["drawbar_pull_n"]
>>> round(float(jax.grad(pull)(0.2)), 1)
10.5
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from . import _core
from ._descriptions import Soil, Source, Wheel
from ._runs import Run
from ._stands import RESULTS, Stand, Step, numbers_of

__all__ = ["settle", "step"]


def settle(
    soil: Soil | Source,
    wheel: Wheel | Source,
    *,
    load_n: Any,
    slip_ratio: Any,
    slip_angle_deg: Any = 0.0,
    gravity_m_s2: Any = _core.EARTH_GRAVITY,
    model: str | None = None,
    vary: Mapping[str, Any] | None = None,
) -> dict[str, jax.Array]:
    """Finds the sinkages at which the soil carries wheels, and the forces there, as
    `grouser.settle` does.

    Parameters
    ----------
    soil, wheel, load_n, slip_ratio, slip_angle_deg, gravity_m_s2, model, vary
        As for `grouser.settle`; the numbers may be JAX's, and what is computed of them is
        differentiable by all of them.

    Returns
    -------
    dict of str to jax.Array
        The results by their names, of the shape to which the numbers broadcast; NaN where the soil
        does not carry the wheel. At a kink the derivative is the mean of both sides.

    Raises
    ------
    ParameterError
        For an argument among the keys of ``vary``.
    DocumentNotFoundError
        If a name is neither a preset nor a file.

    Notes
    -----
    Numbers and keys that `grouser.settle` refuses end in JAX's own error of a callback, which has
    the refusal's sentence.

    Examples
    --------
    By how many millimetres does a wheel sink less for each millimetre that it is wider?

    >>> import jax
    >>> import grouser.jax as gj
    >>> def sinkage(width):
    ...     numbers = {"wheel.width_m": width}
    ...     return gj.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=0.2, vary=numbers)["sinkage_mm"]
    >>> round(float(jax.grad(sinkage)(0.08)) / 1e3, 3)
    -0.022
    """
    values = numbers_of(load_n, slip_ratio, slip_angle_deg, gravity_m_s2, vary)
    numbers = jnp.broadcast_arrays(*(jnp.asarray(it, dtype=float) for it in values.values()))
    found = _computed(Stand(soil, wheel, model, tuple(values)), jnp.stack(numbers, axis=-1))
    return {name: found[..., place] for place, name in enumerate(RESULTS)}


def step(run: Run, commands: Any, dt_s: float, *, state: Any = None) -> jax.Array:
    """The state of a rover after a control step, as `grouser.Run.step` makes it.

    The step is integrated within 1e-10, as `grouser.Run.linearise` does it: its derivatives are
    differences of whole steps, and good to 1e-4 of them.

    Parameters
    ----------
    run : Run
        The rover: where it is now counts, and stays as it is. Batteries, windings and what else is
        no number of the state are its own.
    commands : array_like, shape (), (wheels,) or (..., wheels)
        Speeds in the quantity of the run's ``commands`` [rad/s or m/s].
    dt_s : float
        Duration of the step [s], from 1e-6 to 86400.
    state : array_like, shape (states,) or (..., states), optional
        The state before the step, with the numbers that ``states`` of a `grouser.LinearStep` names:
        pose and velocities in the order of `grouser.Run.STATE`; for a rover whose motors' speed
        depends on their load, those of the wheels. By default the run's own. Leading axes broadcast
        with those of the commands.

    Returns
    -------
    jax.Array, shape (states,) or (..., states)
        The state afterwards; differentiable by the state before and by the commands. NaN where the
        run ends within the step, or falls back from quasi-steady to dynamic; its derivatives are
        where it does so within a step beside it.

    Raises
    ------
    ParameterError
        For shapes that do not go together, and a duration out of its range.
    SimulationError
        If the run has ended.

    Notes
    -----
    Commands out of range end in JAX's own error of a callback, which has the refusal's sentence.

    Examples
    --------
    How far does a rover turn in a second for each cm/s by which its right rims turn faster?

    >>> import jax
    >>> import jax.numpy as jnp
    >>> import grouser.jax as gj
    >>> import grouser as gr
    >>> rover = gr.Run(slope_deg=10.0, commands="rim_speed_m_s")
    >>> moved = rover.step(0.06, 2.0)
    >>> def yaw(faster):
    ...     commands = 0.06 + 0.01 * faster * jnp.array([0.0, 0.0, 1.0, 1.0])
    ...     return gj.step(rover, commands, 1.0)[rover.STATE.index("yaw_deg")]
    >>> 0.2 < float(jax.grad(yaw)(0.0)) < 2.0
    True
    """
    of = Step(run, dt_s)
    before, commands = of.state if state is None else state, jnp.asarray(commands, dtype=float)
    before = jnp.asarray(before, dtype=float)
    shapes = of.shapes(before, commands)
    parts = (jnp.broadcast_to(it, shape) for it, shape in zip((before, commands), shapes))
    found: jax.Array = _computed(of, jnp.concatenate(list(parts), axis=-1))
    return found


@partial(jax.custom_jvp, nondiff_argnums=(0,))
def _computed(of: Stand | Step, numbers: Any) -> Any:
    return _call(of.results, numbers, (of.results_count,))


@_computed.defjvp
def _computed_jvp(of: Stand | Step, primals: Any, tangents: Any) -> Any:
    (numbers,), (change,) = primals, tangents
    jacobian = _call(of.jacobians, numbers, (of.results_count, of.numbers_count))
    return _computed(of, numbers), jnp.einsum("...rk,...k->...r", jacobian, change)


def _call(native: Any, numbers: Any, shape: tuple[int, ...]) -> Any:
    """What the library computes of numbers, for any leading axes."""
    described: Any = jax.ShapeDtypeStruct
    result = described((*numbers.shape[:-1], *shape), numbers.dtype)

    def called(cells: Any) -> Any:
        return np.asarray(native(cells), dtype=result.dtype)

    return jax.pure_callback(called, result, numbers, vmap_method="expand_dims")
