"""The surface under wheels: a plane, a height field, or a function of position."""

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

_PLANE, _FIELD = int(mujoco.mjtGeom.mjGEOM_PLANE), int(mujoco.mjtGeom.mjGEOM_HFIELD)

#: A wheel's footprint reaches so far along it, as a share of its shearing radius: a wheel sunk by
#: 15 % of its radius touches the soil over this length ahead of its lowest point.
_REACH = 0.5


class Ground(Protocol):
    """A surface that wheels stand on."""

    def under(self, data: Any, hubs: Floats, axles: Floats) -> tuple[Floats, Floats]:
        """The plane under each wheel: its normal in the world, and the hub's distance from it [m].

        Parameters
        ----------
        hubs, axles : (n, 3) arrays
            Hubs [m] and directions of the axles, in the world.
        """


class _Plane:
    """A geom that is a plane."""

    def __init__(self, geom: int) -> None:
        self._geom = geom

    def under(self, data: Any, hubs: Floats, axles: Floats) -> tuple[Floats, Floats]:
        normal = data.geom_xmat[self._geom][2::3]
        distances: Floats = (hubs - data.geom_xpos[self._geom]) @ normal
        return np.broadcast_to(normal, hubs.shape), distances


class _Uneven:
    """A surface that is a height over x and y of a frame: the plane under a wheel is the
    least-squares one through nine points.

    They are those of a rectangle about the point below the hub, as long as the wheel's contact and
    as wide as the wheel. The wheel–soil models assume a plane; features smaller than a wheel's
    footprint are averaged out.
    """

    #: The nine points, in halves of the rectangle's length and width.
    _A, _B = (grid.ravel() for grid in np.meshgrid([-1.0, 0.0, 1.0], [-1.0, 0.0, 1.0]))

    def __init__(self, geom: int | None, heights: HeightFunction, radii: Floats, widths: Floats):
        self._geom, self._heights = geom, heights
        self._along, self._aside = _REACH * radii[:, None], 0.5 * widths[:, None]

    def under(self, data: Any, hubs: Floats, axles: Floats) -> tuple[Floats, Floats]:
        if self._geom is not None:
            axes = data.geom_xmat[self._geom].reshape(3, 3)
            place, across = (hubs - data.geom_xpos[self._geom]) @ axes, axles @ axes
        else:
            axes, place, across = np.eye(3), hubs, axles
        length = np.sqrt((across[:, :2] ** 2).sum(axis=1, keepdims=True))
        # A wheel that lies flat has no side: any direction serves.
        left = np.where(length > 1e-9, across[:, :2] / np.maximum(length, 1e-9), [0.0, 1.0])
        forward = left[:, ::-1] * [1.0, -1.0]
        along, aside = self._along * self._A, self._aside * self._B
        x = place[:, :1] + along * forward[:, :1] + aside * left[:, :1]
        y = place[:, 1:2] + along * forward[:, 1:] + aside * left[:, 1:]
        z = self._heights(x, y)
        # On this grid least squares are means: Σa² = Σb² = 6 over nine points.
        uphill = (z @ self._A)[:, None] / (6.0 * self._along) * forward
        uphill += (z @ self._B)[:, None] / (6.0 * self._aside) * left
        steepness = 1.0 / np.sqrt(1.0 + (uphill**2).sum(axis=1))
        normals = np.concatenate([-uphill, np.ones((len(hubs), 1))], axis=1) * steepness[:, None]
        distances: Floats = (place[:, 2] - z.mean(axis=1)) * steepness
        return normals @ axes.T, distances


class _HeightField:
    """A height field's heights, bilinear between its points; beyond its edges it keeps the height
    of the edge."""

    def __init__(self, model: Any, geom: int) -> None:
        field = int(model.geom_dataid[geom])
        rows, columns = int(model.hfield_nrow[field]), int(model.hfield_ncol[field])
        start = int(model.hfield_adr[field])
        # A view: a change of the model's field changes the ground.
        self._data = model.hfield_data[start : start + rows * columns].reshape(rows, columns)
        self._half_x, self._half_y, self._height = (float(s) for s in model.hfield_size[field][:3])

    def __call__(self, x: Floats, y: Floats) -> Floats:
        rows, columns = self._data.shape
        u, column = _cell((x / self._half_x + 1.0) * (0.5 * (columns - 1)), columns)
        v, row = _cell((y / self._half_y + 1.0) * (0.5 * (rows - 1)), rows)
        near = self._data[row, column] * (1.0 - u) + self._data[row, column + 1] * u
        far = self._data[row + 1, column] * (1.0 - u) + self._data[row + 1, column + 1] * u
        heights: Floats = self._height * (near * (1.0 - v) + far * v)
        return heights


def _cell(place: Floats, count: int) -> tuple[Floats, NDArray[np.int64]]:
    """The position within a cell, and the cell."""
    inside = np.minimum(np.maximum(place, 0.0), count - 1.0)
    cell = np.minimum(inside.astype(np.int64), count - 2)
    return inside - cell, cell


def ground_of(model: Any, ground: str | HeightFunction, radii: Floats, widths: Floats) -> Ground:
    """The ground of a geom's name or a function, under wheels of these shearing radii and widths
    [m]."""
    if isinstance(ground, str):
        geom = ground_geom(model, ground)
        if int(model.geom_type[geom]) == _PLANE:
            return _Plane(geom)
        return _Uneven(geom, _HeightField(model, geom), radii, widths)
    if not callable(ground):
        given = type(ground).__name__
        raise ParameterError(
            f"ground is a {given}, it must be a geom's name or a function", "ground"
        )
    return _Uneven(None, ground, radii, widths)


def ground_geom(model: Any, name: str) -> int:
    """The geom of the world that is a plane or a height field, by its name."""
    geom: int = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, name)
    if geom < 0:
        raise ParameterError(f"the model has no geom {name!r} for a ground", "ground")
    if int(model.geom_type[geom]) not in (_PLANE, _FIELD):
        raise ParameterError(f"the ground {name!r} is neither a plane nor a height field", "ground")
    if model.body_weldid[model.geom_bodyid[geom]] != 0:
        raise ParameterError(f"the ground {name!r} moves: it must be part of the world", "ground")
    return geom
