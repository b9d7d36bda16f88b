"""The surface under wheels: a plane, a height field, or a function of place."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

from .._errors import ParameterError

Floats = NDArray[np.float64]
#: Heights [m] over places x and y [m], all arrays of one shape.
HeightFunction = Callable[[Floats, Floats], Floats]

#: A wheel's footprint reaches so far along it, as a share of its shearing radius: a wheel sunk by
#: 15 % of its radius touches the soil over this length ahead of its lowest point.
_REACH = 0.5


class Ground(Protocol):
    """A surface with a frame of its own, in which it is a height over x and y."""

    def frame(self, data: Any) -> tuple[Floats, Floats]:
        """Its origin [m] and its axes, as columns, in the world."""

    def heights(self, x: Floats, y: Floats) -> Floats:
        """Heights [m] in its frame."""


class _Geom:
    """A plane or a height field that does not move."""

    def __init__(self, model: Any, name: str) -> None:
        self._id = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, name)
        if self._id < 0:
            raise ParameterError(f"the model has no geom {name!r} for a ground", "ground")
        if model.body_weldid[model.geom_bodyid[self._id]] != 0:
            raise ParameterError(f"the ground {name!r} moves: it must be part of the world", "ground")

    def frame(self, data: Any) -> tuple[Floats, Floats]:
        return data.geom_xpos[self._id], data.geom_xmat[self._id].reshape(3, 3)


class _Plane(_Geom):
    def heights(self, x: Floats, y: Floats) -> Floats:
        return np.zeros_like(x)


class _HeightField(_Geom):
    """A height field, bilinear between its points; beyond its edges it goes on as high as there."""

    def __init__(self, model: Any, name: str) -> None:
        super().__init__(model, name)
        field = int(model.geom_dataid[self._id])
        rows, columns = int(model.hfield_nrow[field]), int(model.hfield_ncol[field])
        start = int(model.hfield_adr[field])
        # A view: who changes the model's field changes the ground.
        self._data = model.hfield_data[start : start + rows * columns].reshape(rows, columns)
        self._half_x, self._half_y, self._height = (float(s) for s in model.hfield_size[field][:3])

    def heights(self, x: Floats, y: Floats) -> Floats:
        rows, columns = self._data.shape
        u, column = _cell((x / self._half_x + 1.0) / 2.0 * (columns - 1), columns)
        v, row = _cell((y / self._half_y + 1.0) / 2.0 * (rows - 1), rows)
        near = self._data[row, column] * (1.0 - u) + self._data[row, column + 1] * u
        far = self._data[row + 1, column] * (1.0 - u) + self._data[row + 1, column + 1] * u
        heights: Floats = self._height * (near * (1.0 - v) + far * v)
        return heights


def _cell(place: Floats, count: int) -> tuple[Floats, NDArray[np.int64]]:
    """How far into which cell a place is."""
    inside = np.clip(place, 0.0, count - 1.0)
    cell = np.minimum(inside.astype(np.int64), count - 2)
    return inside - cell, cell


class _Function:
    """Heights over the world's x and y."""

    def __init__(self, function: HeightFunction) -> None:
        self._function = function

    def frame(self, data: Any) -> tuple[Floats, Floats]:
        return np.zeros(3), np.eye(3)

    def heights(self, x: Floats, y: Floats) -> Floats:
        return np.broadcast_to(np.asarray(self._function(x, y), dtype=np.float64), x.shape)


def ground_of(model: Any, ground: str | HeightFunction) -> Ground:
    """The ground that a geom's name or a function stands for."""
    if callable(ground):
        return _Function(ground)
    if not isinstance(ground, str):
        given = type(ground).__name__
        raise ParameterError(f"ground is a {given}, it must be a geom's name or a function", "ground")
    geom = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, ground)
    kind = model.geom_type[geom] if geom >= 0 else mujoco.mjtGeom.mjGEOM_PLANE
    if kind == mujoco.mjtGeom.mjGEOM_HFIELD:
        return _HeightField(model, ground)
    if kind == mujoco.mjtGeom.mjGEOM_PLANE:
        return _Plane(model, ground)
    raise ParameterError(f"the ground {ground!r} is neither a plane nor a height field", "ground")


def under_wheels(
    ground: Ground, data: Any, hubs: Floats, axles: Floats, radii: Floats, widths: Floats
) -> tuple[Floats, Floats]:
    """The plane under each wheel: its normal in the world, and the hub's distance from it [m].

    It is the least-squares plane through nine points of the surface, a rectangle about the point
    below the hub as long as the wheel's contact and as wide as the wheel. The theories know no
    ground but a plane; what is smaller than a wheel's footprint is evened out.

    Parameters
    ----------
    hubs, axles : (n, 3) arrays
        Hubs [m] and directions of the axles, in the world.
    radii, widths : (n,) arrays
        Shearing radii and widths [m].
    """
    origin, axes = ground.frame(data)
    place, across = (hubs - origin) @ axes, axles @ axes
    across_xy = across[:, :2]
    length = np.hypot(across_xy[:, 0], across_xy[:, 1])
    # A wheel that lies flat has no across: any will do.
    left = np.where(length[:, None] > 1e-9, across_xy / np.maximum(length, 1e-9)[:, None], [0.0, 1.0])
    forward = np.stack([left[:, 1], -left[:, 0]], axis=1)
    along, aside = _REACH * radii, 0.5 * widths
    a, b = (grid.ravel() for grid in np.meshgrid([-1.0, 0.0, 1.0], [-1.0, 0.0, 1.0]))
    points = (
        place[:, None, :2]
        + (along[:, None] * a)[:, :, None] * forward[:, None, :]
        + (aside[:, None] * b)[:, :, None] * left[:, None, :]
    )
    z = ground.heights(points[..., 0], points[..., 1])
    # On this grid a plane's least squares are means: Σa² = Σb² = 6 over nine points.
    slope_along, slope_aside = (z @ a) / (6.0 * along), (z @ b) / (6.0 * aside)
    gradient = slope_along[:, None] * forward + slope_aside[:, None] * left
    normals = np.concatenate([-gradient, np.ones((len(hubs), 1))], axis=1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    distances = (place[:, 2] - z.mean(axis=1)) * normals[:, 2]
    return normals @ axes.T, distances
