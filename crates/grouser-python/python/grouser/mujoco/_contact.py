"""Forces of the soil on the wheels of a MuJoCo model."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from .. import _core
from .._arrays import number
from .._descriptions import Soil, Source, Wheel
from .._errors import ParameterError
from .._terrain import Terrain
from .._wheels import WheelForces, setting
from ._ground import Ground, HeightFunction, ground_geom, ground_of
from ._inertia import StepInertia
from ._sizes import check_sizes as check_sizes_of

Floats = NDArray[np.float64]


class SoilContact:
    """Applies the forces of the soil to the wheels of a MuJoCo model.

    It replaces MuJoCo's contact between wheels and ground, which has to be off. Before a step it
    writes the forces of the soil into the wheels' rows of ``data.xfrc_applied``: call `apply`
    before each ``mujoco.mj_step``, or `step`, which does both.

    A wheel is a body that turns on one hinge, with the hub at the hinge's anchor. The ground under
    it is the plane that fits the surface over its footprint; the wheel frame has z along that
    plane's normal and y along it, to the side of the axle. Sinkage is the depth of the shearing
    circle's lowest point below the plane, and there are no ruts: every wheel meets
    undisturbed soil.

    The forces are those at the end of the step (backward Euler, for all wheels together), which
    keeps MuJoCo's usual steps stable where a wheel starts, stops or stands: see
    ``docs/guide/mujoco.md``. To know the end of the step, `apply` makes a preliminary step with the
    forces that ``data.xfrc_applied`` holds from the step before, in a copy of the data.

    Parameters
    ----------
    mj_model : mujoco.MjModel
        The model. Its integrator must not be RK4; gravity is the size of its gravity at each step.
    soil : Soil, name, path, mapping, or a sequence of them
        The soil, or one for each wheel.
    wheels : mapping
        Names of the wheels' bodies, each with its `Wheel` or a source of one.
    ground : str, Terrain or callable
        Name of the geom that is the ground, a plane or a height field of the world; or a map, whose
        coordinates are the world's, with the ground between its points as `grouser.simulate` has
        it; or a function that gives heights [m] over arrays of world x and y [m].
    model : str, optional
        The wheel–soil model; by default each soil's own.
    wheel_moments : str
        Whether the wheels' overturning and aligning moments act: ``included`` or ``neglected``.
    sinkage_damping_s_m : float
        Relative increase of all stresses per speed of sinking [s/m].
    rest_speed_m_s : float
        Speed of rim and hub [m/s] below which the stresses fade to zero. A rover that stands on a
        slope creeps at a fraction of it.
    check_sizes : bool
        Whether the geoms of a wheel's body must have its radius (the rim's, the grousers' tips', or
        between) and its width, to 2 %. The soil acts on the wheel, whatever the geoms look like.

    Raises
    ------
    ParameterError
        For invalid bodies, geoms or values; if a wheel has another size than
        the geoms of its body; if MuJoCo's own contact between a wheel and the ground is on; if
        there is no gravity.

    Notes
    -----
    A `SoilContact` has working memory, so that threads must not share one: ``copy.copy`` makes
    another for the same model. ``copy.deepcopy`` and ``pickle`` make one with a model of its own,
    `mj_model`, for which ``mujoco.MjData(contact.mj_model)`` makes data and ``mujoco.mj_setState``
    sets them. What a contact knows of the last step is in the data.

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
        ground: str | Terrain | HeightFunction,
        model: str | None = None,
        wheel_moments: str = "included",
        sinkage_damping_s_m: float = _core.SINKAGE_DAMPING_S_M,
        rest_speed_m_s: float = _core.REST_SPEED_M_S,
        check_sizes: bool = True,
    ) -> None:
        if int(mj_model.opt.integrator) == _RK4:
            raise ParameterError(
                "the model's integrator is RK4, it must be Euler, implicit or implicitfast",
                "mj_model",
            )
        if wheel_moments not in ("included", "neglected"):
            raise ParameterError(
                f"wheel_moments is {wheel_moments!r}, it must be 'included' or 'neglected'",
                "wheel_moments",
            )
        if not wheels:
            raise ParameterError("there are no wheels", "wheels")
        self._model = mj_model
        self._settings: dict[str, Any] = {
            "ground": ground,
            "model": model,
            "wheel_moments": wheel_moments,
            "sinkage_damping_s_m": sinkage_damping_s_m,
            "rest_speed_m_s": rest_speed_m_s,
        }
        self._names = tuple(wheels)
        hinges = [_hinge(mj_model, name) for name in wheels]
        self._hinges = np.array(hinges)
        self._bodies = mj_model.jnt_bodyid[self._hinges]
        if isinstance(ground, str):
            ground_geom(mj_model, ground)
            _check_contact_is_off(mj_model, self._bodies, ground)
        made = [wheel if isinstance(wheel, Wheel) else Wheel(wheel) for wheel in wheels.values()]
        if check_sizes:
            check_sizes_of(mj_model, self._names, hinges, made)
        soils = _one_each(soil, len(made))
        self._settings.update(soil=soils, wheels=dict(zip(wheels, made)))
        self._reaction = _core.SteppingWheels(
            [one._document for one in soils],
            [one._document for one in made],
            setting(float(np.linalg.norm(mj_model.opt.gravity)), model)._document,
            number("sinkage_damping_s_m", sinkage_damping_s_m),
            number("rest_speed_m_s", rest_speed_m_s),
        )
        self._radii = self._reaction.shearing_radius_m
        widths = np.array([float(wheel.width_m) for wheel in made])
        self._ground: Ground = ground_of(mj_model, ground, self._radii, widths)
        self._moments = wheel_moments == "included"
        self._inertia = StepInertia(mj_model)
        self._found = np.zeros((len(self._reaction.names), len(made)))
        self._residual = 0.0
        self._take_memory()

    def _take_memory(self) -> None:
        """Working memory, which no other contact has."""
        self._ahead = mujoco.MjData(self._model)
        self._state = np.zeros(mujoco.mj_stateSize(self._model, _STATE))
        self._jacobians = np.zeros((len(self._names), 6, self._model.nv))
        # Views, by which MuJoCo writes each wheel's rows.
        self._rows = [(one[:3], one[3:]) for one in self._jacobians]

    def __copy__(self) -> SoilContact:
        twin = object.__new__(type(self))
        twin.__dict__.update(self.__dict__)
        twin._take_memory()
        return twin

    def __deepcopy__(self, memo: dict[int, Any]) -> SoilContact:
        settings = {**self._settings, "ground": copy.deepcopy(self._settings["ground"], memo)}
        own = copy.deepcopy(self._model, memo)
        return _remade(type(self), own, settings, self._found.copy(), self._residual)

    def __reduce__(self) -> Any:
        ground = self._settings["ground"]
        if "<" in getattr(ground, "__qualname__", ""):
            raise TypeError(
                f"a SoilContact on the ground {ground.__qualname__} cannot be pickled: give a "
                "function of a module as ground"
            )
        return _remade, (type(self), self._model, self._settings, self._found, self._residual)

    @property
    def mj_model(self) -> mujoco.MjModel:
        """The model that its data must have."""
        return self._model

    @property
    def names(self) -> tuple[str, ...]:
        """The wheels' names, in the order of `forces`."""
        return self._names

    @property
    def forces(self) -> WheelForces:
        """Forces that the last `apply` wrote, with an entry for each wheel; sinkage and slip
        are those at the end of the step."""
        found: dict[str, Any] = dict(zip(self._reaction.names, self._found))
        return WheelForces(**found)

    @property
    def residual_m_s(self) -> float:
        """Largest residual of the wheels' velocities at the end of the step [m/s]: a millionth of
        the rest speed if the solution has converged."""
        return self._residual

    def step(self, data: mujoco.MjData, count: int = 1) -> None:
        """Calls `apply` and ``mujoco.mj_step``, ``count`` times.

        Parameters
        ----------
        data : mujoco.MjData
            The state of the model.
        count : int
            Number of steps.
        """
        for _ in range(count):
            self.apply(data)
            mujoco.mj_step(self._model, data)

    def apply(self, data: mujoco.MjData) -> None:
        """Writes the forces of the soil over the coming step into ``data.xfrc_applied``.

        Parameters
        ----------
        data : mujoco.MjData
            The state of the model.

        Raises
        ------
        ParameterError
            If the data are of another model, if the motion is not finite, or if there is no gravity
            any more.
        """
        model, ahead = self._model, self._ahead
        if data.model is not model:
            message = (
                "the data are of another model: a SoilContact is made for each model, and "
                "mujoco.MjData(contact.mj_model) makes its data"
            )
            raise ParameterError(message, "data")
        mujoco.mj_getState(model, data, self._state, _STATE)
        mujoco.mj_setState(model, ahead, self._state, _STATE)
        mujoco.mj_step(model, ahead)
        # Takes a third of the time of indexing.
        hubs, axles = ahead.xanchor.take(self._hinges, 0), ahead.xaxis.take(self._hinges, 0)
        normals, distances = self._ground.under(ahead, hubs, axles)
        for (along, about), hub, body in zip(self._rows, hubs, self._bodies):
            mujoco.mj_jac(model, ahead, along, about, hub, body)
        wrenches, self._found, self._residual = self._reaction.apply(
            model.opt.timestep,
            (hubs, axles, ahead.xipos.take(self._bodies, 0), normals),
            distances,
            self._jacobians,
            self._inertia.after(ahead),
            ahead.qvel,
            ahead.xfrc_applied.take(self._bodies, 0),
            self._moments,
            mujoco.mju_norm3(model.opt.gravity),
        )
        data.xfrc_applied[self._bodies] = wrenches


_RK4, _HINGE = int(mujoco.mjtIntegrator.mjINT_RK4), int(mujoco.mjtJoint.mjJNT_HINGE)
#: The state that a step depends on.
_STATE = int(mujoco.mjtState.mjSTATE_INTEGRATION)


def _remade(
    kind: type[SoilContact], model: Any, settings: Any, found: Floats, residual: float
) -> SoilContact:
    """A contact that was pickled."""
    contact = kind(model, **settings, check_sizes=False)
    contact._found, contact._residual = found, residual
    return contact


def _one_each(soil: Any, count: int) -> list[Soil]:
    """A soil for each wheel."""
    several = isinstance(soil, Sequence) and not isinstance(soil, str)
    given = list(soil) if several else [soil] * count
    if len(given) != count:
        raise ParameterError(f"there are {len(given)} soils for {count} wheels", "soil")
    return [one if isinstance(one, Soil) else Soil(one) for one in given]


def _hinge(model: Any, name: str) -> int:
    """The joint on which the body of a wheel turns."""
    body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name)
    if body < 0:
        raise ParameterError(f"the model has no body {name!r} for a wheel", "wheels")
    first, count = int(model.body_jntadr[body]), int(model.body_jntnum[body])
    if count != 1 or int(model.jnt_type[first]) != _HINGE:
        raise ParameterError(f"the wheel {name!r} must turn on one hinge and no other", "wheels")
    return first


def _check_contact_is_off(model: Any, bodies: NDArray[np.int64], ground: str) -> None:
    """Checks that MuJoCo's own contact between wheels and ground is off."""
    surface = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, ground)
    excluded = set(model.exclude_signature.tolist())
    for geom in np.flatnonzero(np.isin(model.geom_bodyid, bodies)):
        one, other = sorted((int(model.geom_bodyid[geom]), int(model.geom_bodyid[surface])))
        touching = (
            model.geom_contype[geom] & model.geom_conaffinity[surface]
            or model.geom_contype[surface] & model.geom_conaffinity[geom]
        )
        paired = any(
            {geom, surface} == {first, second}
            for first, second in zip(model.pair_geom1, model.pair_geom2)
        )
        if paired or (touching and (one << 16) + other not in excluded):
            wheel = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_BODY, int(model.geom_bodyid[geom]))
            raise ParameterError(
                f"MuJoCo's own contact between the wheel {wheel!r} and the ground {ground!r} is on: "
                f'give the geoms of the wheel contype="0" conaffinity="0", or exclude the pair',
                "wheels",
            )
