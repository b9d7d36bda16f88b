"""The effective inertia in a step of MuJoCo's integrators."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
_EULER = int(mujoco.mjtIntegrator.mjINT_EULER)
_EULER_DAMPING_OFF = int(mujoco.mjtDisableBit.mjDSBL_EULERDAMP)


def inertia_of_step(model: Any, stepped: Any) -> Floats:
    """M − Δt ∂f/∂v [kg, kg·m, kg·m²], with the forces that the integrator takes at the end of the
    step: joint damping for Euler, and those of actuators too for the implicit ones.

    Parameters
    ----------
    stepped : mujoco.MjData
        After a step.
    """
    inertia = _inertia(model, stepped)
    duration = model.opt.timestep
    if model.opt.integrator != _EULER:
        rows = np.repeat(np.arange(model.nv), model.D_rownnz)
        inertia[rows, model.D_colind] -= duration * stepped.qDeriv
    elif not model.opt.disableflags & _EULER_DAMPING_OFF:
        # A view of the diagonal.
        inertia.reshape(-1)[:: model.nv + 1] += duration * model.dof_damping
    return inertia


def _inertia(model: Any, data: Any) -> Floats:
    """The mass matrix."""
    inertia = np.zeros((model.nv, model.nv))
    if hasattr(data, "qM"):  # MuJoCo 3
        mujoco.mj_fullM(model, inertia, data.qM)
    else:
        mujoco.mj_fullM(model, data, inertia)
    return inertia
