"""Checks that a wheel is as large as the geoms of its body."""

from __future__ import annotations

from itertools import product
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from .._descriptions import Wheel
from .._errors import ParameterError

Floats = NDArray[np.float64]

#: Allowed relative error of radius and width, for polygons and rounded numbers (the sides of a
#: polygon with sixteen corners are 1.9 % nearer to its centre).
TOLERANCE = 0.02

_GEOM = mujoco.mjtGeom
_CYLINDER, _BOX, _MESH = int(_GEOM.mjGEOM_CYLINDER), int(_GEOM.mjGEOM_BOX), int(_GEOM.mjGEOM_MESH)
_ROUND = (int(_GEOM.mjGEOM_SPHERE), int(_GEOM.mjGEOM_CAPSULE), int(_GEOM.mjGEOM_ELLIPSOID))


def check_sizes(model: Any, names: tuple[str, ...], hinges: list[int], wheels: list[Wheel]) -> None:
    """Checks the geom of each wheel's body that reaches furthest from the axle: its radius is
    between those of the rim and of the grousers' tips, and its width is the wheel's.

    A body without geoms has no size; a geom with rounded sides has no width.

    Raises
    ------
    ParameterError
        With both numbers.
    """
    for name, hinge, wheel in zip(names, hinges, wheels):
        extents = [
            _extent(model, int(geom), hinge)
            for geom in np.flatnonzero(model.geom_bodyid == model.jnt_bodyid[hinge])
        ]
        if not extents:
            continue
        reach, width = max(extents, key=lambda extent: extent[0])
        rim, height = float(wheel.radius_m), _grouser_height(wheel)
        if not rim * (1.0 - TOLERANCE) <= reach <= (rim + height) * (1.0 + TOLERANCE):
            tips = f" ({rim + height:.4g} m with its grousers)" if height > 0.0 else ""
            _refuse(name, "radius", f"{reach:.4g} m", f"{rim:.4g} m{tips}")
        own = float(wheel.width_m)
        if width is not None and abs(width - own) > TOLERANCE * own:
            _refuse(name, "width", f"{width:.4g} m", f"{own:.4g} m")


def _refuse(name: str, quantity: str, found: str, wanted: str) -> None:
    raise ParameterError(
        f"the geoms of {name!r} have a {quantity} of {found}, the wheel one of {wanted}: they may "
        f"differ by {TOLERANCE:.0%}. Give the model's wheel, or check_sizes=False if the "
        "geoms are not to scale",
        "wheels",
    )


def _grouser_height(wheel: Wheel) -> float:
    grousers = wheel.to_dict().get("grousers")
    return float(grousers["height_m"]) if grousers else 0.0


def _extent(model: Any, geom: int, hinge: int) -> tuple[float, float | None]:
    """The reach of a geom from the axle, and its width along the axle [m]; None for a rounded
    geom."""
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.geom_quat[geom])
    points = _points(model, geom) @ turn.reshape(3, 3).T + model.geom_pos[geom]
    points = points - model.jnt_pos[hinge]
    axle = model.jnt_axis[hinge]
    along = points @ axle
    reach = np.sqrt(((points - along[:, None] * axle) ** 2).sum(axis=1)).max()
    is_round = int(model.geom_type[geom]) in _ROUND
    return float(reach), None if is_round else float(np.ptp(along))


def _points(model: Any, geom: int) -> Floats:
    """Points on the surface of a geom, in its frame, whose convex hull contains the geom."""
    kind, size = int(model.geom_type[geom]), model.geom_size[geom]
    if kind == _MESH:
        mesh = int(model.geom_dataid[geom])
        first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
        vertices: Floats = np.asarray(model.mesh_vert[first : first + count], dtype=np.float64)
        return vertices
    if kind == _BOX:
        corners: Floats = np.array(list(product((-1.0, 1.0), repeat=3))) * size
        return corners
    angles = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
    ring = np.stack([np.cos(angles), np.sin(angles), np.zeros(64)], axis=1)
    if kind == _CYLINDER:
        ends = [size[0] * ring + [0.0, 0.0, side * size[1]] for side in (-1.0, 1.0)]
        return np.concatenate(ends)
    # Spheres and capsules have their radius first; of ellipsoids all three are half axes.
    is_ellipsoid = kind == int(_GEOM.mjGEOM_ELLIPSOID)
    axes = size if is_ellipsoid else np.full(3, size[0])
    body: Floats = np.concatenate([ring, ring[:, [2, 0, 1]], ring[:, [1, 2, 0]]]) * axes
    if kind == int(_GEOM.mjGEOM_CAPSULE):
        shift = np.array([0.0, 0.0, size[1]])
        return np.concatenate([body - shift, body + shift])
    return body
