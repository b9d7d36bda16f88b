"""The effective inertia in a step of MuJoCo's integrators."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
_EULER = int(mujoco.mjtIntegrator.mjINT_EULER)
_EULER_DAMPING_OFF = int(mujoco.mjtDisableBit.mjDSBL_EULERDAMP)


class StepInertia:
    """M − Δt ∂f/∂v [kg, kg·m, kg·m²] of a model, with the forces that its integrator takes at the end
    of the step: joint damping for Euler, and those of actuators too for the implicit ones."""

    def __init__(self, model: Any) -> None:
        self._model = model
        # Where the derivatives of the forces stand in the matrix, row by row.
        rows = np.repeat(np.arange(model.nv), model.D_rownnz)
        self._places = rows * model.nv + model.D_colind

    def after(self, stepped: Any) -> Floats:
        """The inertia in a step.

        Parameters
        ----------
        stepped : mujoco.MjData
            After a step.
        """
        model = self._model
        inertia = _inertia(model, stepped)
        options, entries = model.opt, inertia.reshape(-1)
        if options.integrator != _EULER:
            entries[self._places] -= options.timestep * stepped.qDeriv
        elif not options.disableflags & _EULER_DAMPING_OFF:
            entries[:: model.nv + 1] += options.timestep * model.dof_damping
        return inertia


def _inertia(model: Any, data: Any) -> Floats:
    """The mass matrix."""
    inertia = np.zeros((model.nv, model.nv))
    if hasattr(data, "qM"):  # MuJoCo 3
        mujoco.mj_fullM(model, inertia, data.qM)
    else:
        mujoco.mj_fullM(model, data, inertia)
    return inertia
