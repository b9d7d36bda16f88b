"""The surface under wheels: a plane, a height field, a map of heights, or a function of position."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

from .. import _core
from .._errors import ParameterError
from .._terrain import Terrain

Floats = NDArray[np.float64]
#: Heights [m] over places x and y [m], all arrays of one shape.
HeightFunction = Callable[[Floats, Floats], Floats]

_PLANE, _FIELD = int(mujoco.mjtGeom.mjGEOM_PLANE), int(mujoco.mjtGeom.mjGEOM_HFIELD)


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
        normals = np.empty(hubs.shape)
        normals[:] = data.geom_xmat[self._geom, 2::3]
        # Added up in this order, as the engine's plugin does.
        x, y, z = ((hubs - data.geom_xpos[self._geom]) * normals).T
        distances: Floats = x + y + z
        return normals, distances


class _Uneven:
    """A surface that is a height over x and y: the plane under a wheel is the least-squares one
    through nine points.

    They are those of a rectangle about the point below the hub, as long as the wheel's contact and
    as wide as the wheel. The wheel–soil models assume a plane; features smaller than a wheel's
    footprint are averaged out.
    """

    def __init__(self, heights: HeightFunction, footprints: _core.Footprints) -> None:
        self._heights, self._footprints = heights, footprints

    def under(self, data: Any, hubs: Floats, axles: Floats) -> tuple[Floats, Floats]:
        world = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
        x, y = self._footprints.points(*world, hubs, axles)
        heights = np.asarray(self._heights(x, y), dtype=np.float64)
        return self._footprints.planes(*world, hubs, axles, np.broadcast_to(heights, x.shape))


class _HeightField:
    """The same of a height field, which is bilinear between its points; beyond its edges it keeps
    the height of the edge."""

    def __init__(self, model: Any, geom: int, footprints: _core.Footprints) -> None:
        field = int(model.geom_dataid[geom])
        rows, columns = int(model.hfield_nrow[field]), int(model.hfield_ncol[field])
        start = int(model.hfield_adr[field])
        # A view: a change of the model's field changes the ground.
        self._data = model.hfield_data[start : start + rows * columns].reshape(rows, columns)
        half_x, half_y, self._height = (float(s) for s in model.hfield_size[field][:3])
        self._half = half_x, half_y
        self._geom, self._footprints = geom, footprints

    def under(self, data: Any, hubs: Floats, axles: Floats) -> tuple[Floats, Floats]:
        frame = data.geom_xpos[self._geom], data.geom_xmat[self._geom]
        return self._footprints.planes_on_field(
            *frame, hubs, axles, self._data, self._half, self._height
        )


def ground_of(
    model: Any, ground: str | Terrain | HeightFunction, radii: Floats, widths: Floats
) -> Ground:
    """The ground of a geom's name, a map or a function, under wheels of these shearing radii and
    widths [m]."""
    footprints = _core.Footprints(radii, widths)
    if isinstance(ground, str):
        geom = ground_geom(model, ground)
        if int(model.geom_type[geom]) == _PLANE:
            return _Plane(geom)
        return _HeightField(model, geom, footprints)
    if isinstance(ground, Terrain):
        return _Uneven(ground._native.ground, footprints)
    if not callable(ground):
        given = type(ground).__name__
        raise ParameterError(
            f"ground is a {given}, it must be a geom's name, a Terrain or a function", "ground"
        )
    return _Uneven(ground, footprints)


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
