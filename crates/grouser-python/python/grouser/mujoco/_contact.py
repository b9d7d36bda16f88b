"""The soil's reaction as forces on the wheels of a MuJoCo model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from .. import _core
from .._descriptions import Soil, Source, Wheel
from .._errors import ParameterError
from .._wheels import WheelForces, number, setting
from ._ground import Ground, HeightFunction, ground_of, under_wheels
from ._inertia import inertia_of_step

Floats = NDArray[np.float64]


class SoilContact:
    """The soil under the wheels of a MuJoCo model.

    It takes the place of MuJoCo's contact between wheels and ground, which has to be off. Before a
    step it writes the soil's reaction into the wheels' rows of ``data.xfrc_applied``: call `apply`
    before each ``mujoco.mj_step``, or `step`, which does both.

    A wheel is a body that turns on one hinge, with the hub at the hinge's anchor. The ground under
    it is the plane that fits the surface over its footprint; the wheel frame has z along that
    plane's normal and y along it, to the side of the axle. Sinkage is the depth of the shearing
    circle's lowest point below the plane, and the soil knows no ruts: every wheel meets it
    undisturbed.

    The reaction is the one at the end of the step (backward Euler, for all wheels together), which
    keeps MuJoCo's usual steps stable where a wheel starts, stops or stands: see
    ``docs/guide/mujoco.md``. To know the end of the step, `apply` takes a trial step with the
    reaction that ``data.xfrc_applied`` holds from the step before, in a copy of the data.

    Parameters
    ----------
    mj_model : mujoco.MjModel
        The model. Its integrator must not be RK4; gravity is the size of its gravity.
    soil : Soil, name, path, mapping, or a sequence of them
        The soil, or one for each wheel.
    wheels : mapping
        Names of the wheels' bodies, each with its `Wheel` or what one is made from.
    ground : str or callable
        Name of the geom that is the ground, a plane or a height field of the world; or a function
        that gives heights [m] over arrays of world x and y [m].
    model : str, optional
        The theory; without it each soil's own.
    moments : str
        Whether the wheels' overturning and aligning moments act: ``included`` or ``neglected``.
    sinkage_damping_s_m : float
        All stresses grow by this share for each m/s of sinking [s/m].
    rest_speed_m_s : float
        Speed of rim and hub [m/s] below which the stresses fade to none. A rover that stands on a
        slope creeps at a part of it.

    Raises
    ------
    ParameterError
        For bodies, geoms or values that are not what they must be; if MuJoCo's own contact
        between a wheel and the ground is on; if there is no gravity.

    Examples
    --------
    >>> import mujoco
    >>> import grouser as gr
    >>> from grouser.mujoco import SoilContact, rover_xml
    >>> rover = gr.Rover("hakuto")
    >>> model = mujoco.MjModel.from_xml_string(rover_xml(rover))
    >>> data = mujoco.MjData(model)
    >>> names = [mount["name"] for mount in rover.mount]
    >>> soil = SoilContact(
    ...     model, soil="toyoura", wheels={name: rover.wheel for name in names}, ground="ground"
    ... )
    >>> soil.step(data, 500)
    >>> round(float(soil.forces.normal_force_n.sum() / 67.94), 2)
    1.0
    """

    def __init__(
        self,
        mj_model: mujoco.MjModel,
        /,
        *,
        soil: Soil | Source | Sequence[Soil | Source],
        wheels: Mapping[str, Wheel | Source],
        ground: str | HeightFunction,
        model: str | None = None,
        moments: str = "included",
        sinkage_damping_s_m: float = _core.SINKAGE_DAMPING_S_M,
        rest_speed_m_s: float = _core.REST_SPEED_M_S,
    ) -> None:
        if mj_model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4:
            raise ParameterError(
                "the model's integrator is RK4, it must be Euler, implicit or implicitfast",
                "mj_model",
            )
        if moments not in ("included", "neglected"):
            raise ParameterError(
                f"moments is {moments!r}, it must be 'included' or 'neglected'", "moments"
            )
        if not wheels:
            raise ParameterError("there are no wheels", "wheels")
        self._model = mj_model
        self._trial = mujoco.MjData(mj_model)
        self._ground: Ground = ground_of(mj_model, ground)
        self._names = tuple(wheels)
        hinges = [_hinge(mj_model, name) for name in wheels]
        self._hinges = np.array(hinges)
        self._bodies = mj_model.jnt_bodyid[self._hinges]
        if isinstance(ground, str):
            _check_contact_is_off(mj_model, self._bodies, ground)
        made = [wheel if isinstance(wheel, Wheel) else Wheel(wheel) for wheel in wheels.values()]
        soils = _one_each(soil, len(made))
        self._reaction = _core.SteppingWheels(
            [one._document for one in soils],
            [one._document for one in made],
            setting(float(np.linalg.norm(mj_model.opt.gravity)), model)._document,
            number("sinkage_damping_s_m", sinkage_damping_s_m),
            number("rest_speed_m_s", rest_speed_m_s),
        )
        self._radii = self._reaction.shearing_radius_m
        self._widths = np.array([float(wheel.width_m) for wheel in made])
        self._moments = float(moments == "included")
        self._found = np.zeros((len(self._reaction.names), len(made)))
        self._residual = 0.0
        self._state = np.zeros(mujoco.mj_stateSize(mj_model, _STATE))
        self._jacobians = np.zeros((len(made), 6, mj_model.nv))

    @property
    def names(self) -> tuple[str, ...]:
        """The wheels' names, in the order of `forces`."""
        return self._names

    @property
    def forces(self) -> WheelForces:
        """The reaction that the last `apply` wrote, with an entry for each wheel; sinkage and slip
        are those at the end of the step."""
        found = dict(zip(self._reaction.names, self._found))
        return WheelForces(**found)

    @property
    def residual_m_s(self) -> float:
        """How far the wheels' motion at the end of the step is from the one that the reaction leads
        to, at worst [m/s]; a millionth of the rest speed where the search for it succeeded."""
        return self._residual

    def step(self, data: mujoco.MjData, count: int = 1) -> None:
        """`apply` and ``mujoco.mj_step``, so many times."""
        for _ in range(count):
            self.apply(data)
            mujoco.mj_step(self._model, data)

    def apply(self, data: mujoco.MjData) -> None:
        """Writes the soil's reaction over the coming step into ``data.xfrc_applied``.

        Raises
        ------
        ParameterError
            If the model's motion is not finite.
        """
        model, trial = self._model, self._trial
        mujoco.mj_getState(model, data, self._state, _STATE)
        mujoco.mj_setState(model, trial, self._state, _STATE)
        mujoco.mj_step(model, trial)
        hubs, axles = trial.xanchor[self._hinges], trial.xaxis[self._hinges]
        normals, distances = under_wheels(
            self._ground, trial, hubs, axles, self._radii, self._widths
        )
        axes = _axes(axles, normals)
        # The lowest point of a circle that leans.
        leaning = np.einsum("ni,ni->n", axles, normals)
        sinkage = self._radii * np.sqrt(1.0 - np.minimum(leaning**2, 1.0)) - distances
        motions, forces = self._maps(hubs, axles, axes)
        held = self._held(hubs)
        mobility_of = np.linalg.solve(inertia_of_step(model, trial), np.c_[forces.T, held])
        duration = float(model.opt.timestep)
        response = motions @ mobility_of
        free = motions @ trial.qvel - duration * response[:, -1]
        mobility = np.ascontiguousarray(response[:, :-1])
        self._found, self._residual = self._reaction.reaction(duration, sinkage, free, mobility)
        data.xfrc_applied[self._bodies] = self._wrenches(hubs, axles, axes)

    def _maps(self, hubs: Floats, axles: Floats, axes: Floats) -> tuple[Floats, Floats]:
        """Jacobians of the wheels' velocities (v_x, v_y, v_z, ω r_s), and of what their forces
        (F_x, F_y, F_z, −T/r_s, M_x, M_z) work on."""
        jacobians = self._jacobians
        for jacobian, hub, body in zip(jacobians, hubs, self._bodies):
            mujoco.mj_jac(self._model, self._trial, jacobian[:3], jacobian[3:], hub, body)
        travel = axes @ jacobians[:, :3]
        rim = self._radii[:, None] * np.einsum("ni,nij->nj", axles, jacobians[:, 3:])
        turning = self._moments * (axes[:, ::2] @ jacobians[:, 3:])
        motions = np.concatenate([travel, rim[:, None]], axis=1)
        forces = np.concatenate([motions, turning], axis=1)
        count = self._model.nv
        return motions.reshape(-1, count), forces.reshape(-1, count)

    def _held(self, hubs: Floats) -> Floats:
        """Generalised forces of what acted on the wheels in the trial step."""
        trial = self._trial
        applied = trial.xfrc_applied[self._bodies]
        force, moment = applied[:, :3], applied[:, 3:]
        about_hub = moment + np.cross(trial.xipos[self._bodies] - hubs, force)
        held: Floats = np.einsum("nij,ni->j", self._jacobians, np.c_[force, about_hub])
        return held

    def _wrenches(self, hubs: Floats, axles: Floats, axes: Floats) -> Floats:
        """Forces and moments about the bodies' centres of mass, in the world."""
        found = dict(zip(self._reaction.names, self._found))
        along = np.stack([found[key] for key in _FORCES], axis=1)
        force = np.einsum("nk,nki->ni", along, axes)
        moments = self._moments * np.stack([found[key] for key in _MOMENTS], axis=1)
        about_hub = (
            np.einsum("nk,nki->ni", moments, axes[:, ::2]) - found["torque_nm"][:, None] * axles
        )
        arm = hubs - self._trial.xipos[self._bodies]
        return np.c_[force, about_hub + np.cross(arm, force)]


_FORCES = ("drawbar_pull_n", "side_force_n", "normal_force_n")
_MOMENTS = ("overturning_moment_nm", "aligning_moment_nm")
#: All that a step depends on.
_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)


def _axes(axles: Floats, normals: Floats) -> Floats:
    """The wheel frames: rows x, y, z of each, in the world."""
    forward = np.cross(axles, normals)
    length = np.linalg.norm(forward, axis=1, keepdims=True)
    forward = np.divide(forward, length, out=np.zeros_like(forward), where=length > 1e-9)
    return np.stack([forward, np.cross(normals, forward), normals], axis=1)


def _one_each(soil: Any, count: int) -> list[Soil]:
    """A soil for each wheel."""
    several = isinstance(soil, Sequence) and not isinstance(soil, str)
    given = list(soil) if several else [soil] * count
    if len(given) != count:
        raise ParameterError(f"there are {len(given)} soils for {count} wheels", "soil")
    return [one if isinstance(one, Soil) else Soil(one) for one in given]


def _hinge(model: Any, name: str) -> int:
    """The joint on which a wheel's body turns."""
    body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name)
    if body < 0:
        raise ParameterError(f"the model has no body {name!r} for a wheel", "wheels")
    first, count = int(model.body_jntadr[body]), int(model.body_jntnum[body])
    if count != 1 or model.jnt_type[first] != mujoco.mjtJoint.mjJNT_HINGE:
        raise ParameterError(f"the wheel {name!r} must turn on one hinge, and on that alone", "wheels")
    return first


def _check_contact_is_off(model: Any, bodies: NDArray[np.int64], ground: str) -> None:
    """That MuJoCo itself does not press wheels onto the ground."""
    floor = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, ground)
    excluded = set(model.exclude_signature.tolist())
    for geom in np.flatnonzero(np.isin(model.geom_bodyid, bodies)):
        one, other = sorted((int(model.geom_bodyid[geom]), int(model.geom_bodyid[floor])))
        touching = (
            model.geom_contype[geom] & model.geom_conaffinity[floor]
            or model.geom_contype[floor] & model.geom_conaffinity[geom]
        )
        paired = any(
            {geom, floor} == {first, second}
            for first, second in zip(model.pair_geom1, model.pair_geom2)
        )
        if paired or (touching and (one << 16) + other not in excluded):
            wheel = mujoco.mj_id2name(
                model, mujoco.mjtObj.mjOBJ_BODY, int(model.geom_bodyid[geom])
            )
            raise ParameterError(
                f"MuJoCo's own contact between the wheel {wheel!r} and the ground {ground!r} is on: "
                f'give the geoms of the wheel contype="0" conaffinity="0", or exclude the pair',
                "wheels",
            )
