"""Settled wheels as a function that JAX differentiates: forward and in reverse, batched, and under
``jit`` by calling back into the library.

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
from ._stands import RESULTS, Stand, numbers_of

__all__ = ["settle"]


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
) -> dict[str, Any]:
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
    found = _settled(Stand(soil, wheel, model, tuple(values)), jnp.stack(numbers, axis=-1))
    return {name: found[..., place] for place, name in enumerate(RESULTS)}


@partial(jax.custom_jvp, nondiff_argnums=(0,))
def _settled(stand: Stand, numbers: Any) -> Any:
    return _call(stand.results, numbers, (len(RESULTS),))


@_settled.defjvp
def _settled_jvp(stand: Stand, primals: Any, tangents: Any) -> Any:
    (numbers,), (change,) = primals, tangents
    jacobian = _call(stand.jacobians, numbers, (len(RESULTS), len(stand.names)))
    return _settled(stand, numbers), jnp.einsum("...rk,...k->...r", jacobian, change)


def _call(native: Any, numbers: Any, shape: tuple[int, ...]) -> Any:
    """What the library computes of numbers, for any leading axes."""
    described: Any = jax.ShapeDtypeStruct
    result = described((*numbers.shape[:-1], *shape), numbers.dtype)

    def called(cells: Any) -> Any:
        return np.asarray(native(cells), dtype=result.dtype)

    return jax.pure_callback(called, result, numbers, vmap_method="expand_dims")
