"""Settled wheels as a function that PyTorch differentiates: forward and in reverse, batched, and
under ``torch.func``.

What is computed is of 64 bits, whatever numbers come in; their gradients come back in their own
precision, on their own device. There are first derivatives only.

It needs PyTorch: ``pip install grouser[torch]``. How much harder does a wheel pull the more it
slips?

>>> import torch
>>> import grouser.torch as gt
>>> slip = torch.tensor(0.2, dtype=torch.float64, requires_grad=True)
>>> gt.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=slip)["drawbar_pull_n"].backward()
>>> round(float(slip.grad), 1)
10.5
"""

# PyTorch's functions are subclassed and called alike where it is not installed.
# mypy: allow-subclassing-any, allow-untyped-calls

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import torch

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
        As for `grouser.settle`; the numbers may be tensors, and what is computed of them is
        differentiable by all of them.

    Returns
    -------
    dict of str to torch.Tensor
        The results by their names, of the shape to which the numbers broadcast; NaN where the soil
        does not carry the wheel. At a kink the derivative is the mean of both sides.

    Raises
    ------
    ParameterError
        For an argument among the keys of ``vary``, and for what `grouser.settle` refuses.
    DocumentNotFoundError
        If a name is neither a preset nor a file.

    Examples
    --------
    By how many millimetres does a wheel sink less for each millimetre that it is wider?

    >>> import torch
    >>> import grouser.torch as gt
    >>> def sinkage(width):
    ...     numbers = {"wheel.width_m": width}
    ...     return gt.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=0.2, vary=numbers)["sinkage_mm"]
    >>> round(float(torch.func.grad(sinkage)(torch.tensor(0.08))) / 1e3, 3)
    -0.022
    """
    values = numbers_of(load_n, slip_ratio, slip_angle_deg, gravity_m_s2, vary)
    tensors = (it for it in values.values() if isinstance(it, torch.Tensor))
    device = next((it.device for it in tensors), None)
    cells = (torch.as_tensor(it, dtype=torch.float64, device=device) for it in values.values())
    numbers = torch.stack(torch.broadcast_tensors(*cells), dim=-1)
    found = _Settled.apply(Stand(soil, wheel, model, tuple(values)), numbers)
    return {name: found[..., place] for place, name in enumerate(RESULTS)}


class _Settled(torch.autograd.Function):
    """Results in the last axis, of numbers in the last axis."""

    @staticmethod
    def forward(stand: Stand, numbers: Any) -> Any:
        return _call(stand.results, numbers)

    @staticmethod
    def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
        ctx.stand, numbers = inputs
        ctx.save_for_backward(numbers)
        ctx.save_for_forward(numbers)

    @staticmethod
    def backward(ctx: Any, change: Any) -> Any:
        jacobian = _Jacobian.apply(ctx.stand, *ctx.saved_tensors)
        return None, torch.einsum("...rk,...r->...k", jacobian, change)

    @staticmethod
    def jvp(ctx: Any, _: Any, change: Any) -> Any:
        jacobian = _Jacobian.apply(ctx.stand, *ctx.saved_tensors)
        return torch.einsum("...rk,...k->...r", jacobian, change)

    @staticmethod
    def vmap(_: Any, dims: Any, stand: Stand, numbers: Any) -> Any:
        return _Settled.apply(stand, numbers.movedim(dims[1], 0)), 0


class _Jacobian(torch.autograd.Function):
    """Results in the axis before the last, numbers in the last."""

    @staticmethod
    def forward(stand: Stand, numbers: Any) -> Any:
        return _call(stand.jacobians, numbers)

    @staticmethod
    def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
        pass

    @staticmethod
    def backward(ctx: Any, change: Any) -> Any:
        raise NotImplementedError("settled wheels have first derivatives only")

    @staticmethod
    def vmap(_: Any, dims: Any, stand: Stand, numbers: Any) -> Any:
        return _Jacobian.apply(stand, numbers.movedim(dims[1], 0)), 0


def _call(native: Callable[[Any], Any], numbers: Any) -> Any:
    """What the library computes of numbers, on their device."""
    found = native(numbers.detach().cpu().numpy())
    return torch.from_numpy(np.ascontiguousarray(found)).to(numbers.device)
