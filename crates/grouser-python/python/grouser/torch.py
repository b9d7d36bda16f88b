"""Settled wheels and control steps as functions that PyTorch differentiates: forward and in reverse,
batched, and under ``torch.func``.

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
    numbers = torch.stack(torch.broadcast_tensors(*_tensors(*values.values())), dim=-1)
    found = _Computed.apply(Stand(soil, wheel, model, tuple(values)), numbers)
    return {name: found[..., place] for place, name in enumerate(RESULTS)}


def step(run: Run, commands: Any, dt_s: float, *, state: Any = None) -> Any:
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
    torch.Tensor, shape (states,) or (..., states)
        The state afterwards; differentiable by the state before and by the commands. NaN where the
        run ends within the step, or falls back from quasi-steady to dynamic; its derivatives are
        where it does so within a step beside it.

    Raises
    ------
    ParameterError
        For shapes that do not go together, and a duration out of its range.
    SimulationError
        If the run has ended.

    Examples
    --------
    How far does a rover turn in a second for each cm/s by which its right rims turn faster?

    >>> import torch
    >>> import grouser.torch as gt
    >>> import grouser as gr
    >>> rover = gr.Run(slope_deg=10.0, commands="rim_speed_m_s")
    >>> moved = rover.step(0.06, 2.0)
    >>> def yaw(faster):
    ...     commands = 0.06 + 0.01 * faster * torch.tensor([0.0, 0.0, 1.0, 1.0])
    ...     return gt.step(rover, commands, 1.0)[rover.STATE.index("yaw_deg")]
    >>> 0.2 < float(torch.func.grad(yaw)(torch.tensor(0.0))) < 2.0
    True
    """
    of = Step(run, dt_s)
    before, commands = _tensors(of.state if state is None else state, commands)
    shapes = of.shapes(before, commands)
    parts = [torch.broadcast_to(it, shape) for it, shape in zip((before, commands), shapes)]
    return _Computed.apply(of, torch.cat(parts, dim=-1))


def _tensors(*values: Any) -> list[Any]:
    """Numbers as tensors of 64 bits, on the device of those that are some."""
    tensors = (it for it in values if isinstance(it, torch.Tensor))
    device = next((it.device for it in tensors), None)
    return [torch.as_tensor(it, dtype=torch.float64, device=device) for it in values]


class _Computed(torch.autograd.Function):
    """Results in the last axis, of numbers in the last axis."""

    @staticmethod
    def forward(of: Stand | Step, numbers: Any) -> Any:
        return _call(of.results, numbers)

    @staticmethod
    def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
        ctx.of, numbers = inputs
        ctx.save_for_backward(numbers)
        ctx.save_for_forward(numbers)

    @staticmethod
    def backward(ctx: Any, change: Any) -> Any:
        jacobian = _Jacobian.apply(ctx.of, *ctx.saved_tensors)
        return None, torch.einsum("...rk,...r->...k", jacobian, change)

    @staticmethod
    def jvp(ctx: Any, _: Any, change: Any) -> Any:
        jacobian = _Jacobian.apply(ctx.of, *ctx.saved_tensors)
        return torch.einsum("...rk,...k->...r", jacobian, change)

    @staticmethod
    def vmap(_: Any, dims: Any, of: Stand | Step, numbers: Any) -> Any:
        return _Computed.apply(of, numbers.movedim(dims[1], 0)), 0


class _Jacobian(torch.autograd.Function):
    """Results in the axis before the last, numbers in the last."""

    @staticmethod
    def forward(of: Stand | Step, numbers: Any) -> Any:
        return _call(of.jacobians, numbers)

    @staticmethod
    def setup_context(ctx: Any, inputs: Any, output: Any) -> None:
        pass

    @staticmethod
    def backward(ctx: Any, change: Any) -> Any:
        raise NotImplementedError("settled wheels and steps have first derivatives only")

    @staticmethod
    def vmap(_: Any, dims: Any, of: Stand | Step, numbers: Any) -> Any:
        return _Jacobian.apply(of, numbers.movedim(dims[1], 0)), 0


def _call(native: Callable[[Any], Any], numbers: Any) -> Any:
    """What the library computes of numbers, on their device."""
    found = native(numbers.detach().cpu().numpy())
    return torch.from_numpy(np.ascontiguousarray(found)).to(numbers.device)
