"""Sinkage and forces of wheels on soil, for whole arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._arrays import Floats, broadcast, number
from ._descriptions import Scenario, Soil, Source, Wheel
from ._errors import ParameterError
from ._validity import flags_of

if TYPE_CHECKING:
    import pandas
    import xarray

#: One soil, or a sequence that broadcasts with the other arguments.
Soils = Union[Soil, Source, Sequence[Any], NDArray[np.object_]]

#: `Settled.status` of a wheel that the soil carries.
CARRIED = 0
#: `Settled.status` of a wheel that sinks to its axle.
SUNK_TO_AXLE = 1


@dataclass(frozen=True, eq=False)
class WheelForces(_tables.Tabular):
    """Forces and moments of the soil on wheels, about the hub, in the wheel frame (x forward, y
    left, z up).

    Every field is an array of the shape to which the arguments broadcast; of no dimensions if all
    were single values. Angles are from straight down, positive towards the side that enters the
    soil.
    """

    slip_ratio: Floats
    """Slip ratio [-], as asked."""
    slip_angle_deg: Floats
    """Slip angle [°], as asked; positive where the hub moves to the left."""
    sinkage_mm: Floats
    """Sinkage of the grouser tips [mm]."""
    entry_angle_deg: Floats
    """Entry angle [°]."""
    exit_angle_deg: Floats
    """Exit angle [°], not positive."""
    max_stress_angle_deg: Floats
    """Angle of the largest normal stress [°]."""
    drawbar_pull_n: Floats
    """Force along the wheel [N]: thrust less motion resistance."""
    side_force_n: Floats
    """Force across the wheel [N], positive to the left."""
    side_force_from_shear_n: Floats
    """Part of the side force from shear [N]."""
    bulldozing_load_n: Floats
    """Full load of the soil that the side wall pushes aside [N], before the slip angle's share."""
    normal_force_n: Floats
    """Force out of the ground [N]."""
    torque_nm: Floats
    """Torque of the drive [N·m], positive while it drives the wheel forward."""
    overturning_moment_nm: Floats
    """Moment about the wheel's long axis [N·m]."""
    aligning_moment_nm: Floats
    """Moment about the wheel's upright axis [N·m]."""
    thrust_n: Floats
    """Part of the drawbar pull from shear [N]."""
    motion_resistance_n: Floats
    """Part of the drawbar pull from normal stress and bulldozing [N]; it counts negative."""
    max_normal_stress_kpa: Floats
    """Largest normal stress on the rim [kPa]."""

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of every field."""
        return self.slip_ratio.shape

    def _table(self) -> dict[str, Any]:
        return {field.name: getattr(self, field.name) for field in fields(self)}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each wheel, in the order of the flattened fields."""
        return _tables.frame(self._table())

    def to_xarray(self, dims: Sequence[str] | None = None) -> xarray.Dataset:
        """A dataset with units in the attributes.

        Parameters
        ----------
        dims : sequence of str, optional
            Names of the dimensions; by default ``dim_0``, ``dim_1`` …
        """
        names = (
            tuple(dims) if dims is not None else tuple(f"dim_{k}" for k in range(len(self.shape)))
        )
        if len(names) != len(self.shape):
            raise ParameterError(
                f"dims has {len(names)} names, the fields have {len(self.shape)} dimensions", "dims"
            )
        return _tables.dataset(names, self._table())

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of shape {self.shape}>"


@dataclass(frozen=True, eq=False, repr=False)
class Settled(WheelForces):
    """Wheels at the sinkage at which the soil carries their load. A wheel that it cannot carry has
    ``status`` 1 and NaN for all results."""

    load_n: Floats
    """Load [N], as asked."""
    status: NDArray[np.int8]
    """0 for a wheel that is carried, 1 for one that sinks to its axle."""
    capacity_n: Floats
    """The most that the soil carries down to axle depth [N], where that is less than the load; else
    NaN."""
    flags: NDArray[np.object_]
    """Why each wheel is an extrapolation: names of `FLAGS`, joined by ``;``; empty inside the
    domain."""

    @property
    def messages(self) -> NDArray[np.object_]:
        """Each wheel's status as text, as in the program's tables: ``ok``, or the reason."""
        messages = np.full(self.shape, "ok", dtype=object)
        sunk = self.status == SUNK_TO_AXLE
        messages[sunk] = _core.not_carried(self.load_n[sunk], self.capacity_n[sunk])
        return messages


def settle(
    soil: Soils,
    wheel: Wheel | Source,
    *,
    load_n: ArrayLike,
    slip_ratio: ArrayLike,
    slip_angle_deg: ArrayLike = 0.0,
    gravity_m_s2: float = _core.EARTH_GRAVITY,
    model: str | None = None,
) -> Settled:
    """Finds the smallest sinkages at which the soil carries wheels (F_z = load), and the forces
    there.

    The arguments broadcast against each other as those of NumPy's ufuncs do, by the order of their
    axes: DataArrays of xarray must all have the same dimensions and coordinates. Wheels are
    distributed over all cores, without Python's lock, and each has the same results as alone, bit
    for bit.

    Parameters
    ----------
    soil : Soil, name, path, mapping, or a sequence of them
        A sequence broadcasts as an array of its shape does.
    wheel : Wheel, name, path or mapping
        The wheel.
    load_n : array_like
        Load on the wheel [N], 0 to 1e5.
    slip_ratio : array_like
        Slip ratio [-], −2 to 2, positive where the wheel drives.
    slip_angle_deg : array_like
        Slip angle [°], −90 to 90, positive where the hub moves to the left.
    gravity_m_s2 : float
        Gravity [m/s²]; it gives the soil its weight.
    model : str, optional
        The wheel–soil model: ``ishigami``, ``bekker``, ``small-wheel`` or ``rft``; by default each
        soil's own.

    Returns
    -------
    Settled

    Raises
    ------
    ParameterError
        For a value that is not a number, masked or out of its range, for shapes that do not
        broadcast, and for DataArrays over different dimensions.
    DocumentNotFoundError
        If a name is neither a preset nor a file.

    Examples
    --------
    >>> import grouser as gr
    >>> wheels = gr.settle("toyoura", "hakuto", load_n=[[10.0], [20.0]], slip_ratio=[0.1, 0.2, 0.3])
    >>> wheels.drawbar_pull_n.shape
    (2, 3)
    """
    stand = _Stand(soil, wheel, gravity_m_s2, model)
    inputs = {"load_n": load_n, "slip_ratio": slip_ratio, "slip_angle_deg": slip_angle_deg}
    arrays, shape = stand.broadcast(inputs)
    loads, ratios, angles = arrays
    rows, names = _core.settle(*stand.documents, loads, ratios, angles, stand.index)
    found = dict(zip(names, rows.reshape(len(names), *shape)))
    found |= zip(inputs, (array.reshape(shape) for array in arrays))
    status = np.isnan(found["normal_force_n"]).astype(np.int8)
    flags = flags_of(found.pop("flag_bits"))
    return Settled(**found, status=status, flags=flags)


def wheel_forces(
    soil: Soils,
    wheel: Wheel | Source,
    *,
    sinkage_mm: ArrayLike,
    slip_ratio: ArrayLike,
    slip_angle_deg: ArrayLike = 0.0,
    gravity_m_s2: float = _core.EARTH_GRAVITY,
    model: str | None = None,
) -> WheelForces:
    """Computes the forces of the soil on wheels at given sinkages.

    Broadcasts as `settle` does.

    Parameters
    ----------
    sinkage_mm : array_like
        Sinkage of the grouser tips [mm], from 0 to the axle's depth.
    soil, wheel, slip_ratio, slip_angle_deg, gravity_m_s2, model
        As for `settle`.

    Returns
    -------
    WheelForces

    Raises
    ------
    ParameterError, DocumentNotFoundError
        As `settle`.
    """
    stand = _Stand(soil, wheel, gravity_m_s2, model)
    inputs = {"sinkage_mm": sinkage_mm, "slip_ratio": slip_ratio, "slip_angle_deg": slip_angle_deg}
    arrays, shape = stand.broadcast(inputs)
    depths, ratios, angles = arrays
    rows, names = _core.wheel_forces(*stand.documents, depths, ratios, angles, stand.index)
    found = dict(zip(names, rows.reshape(len(names), *shape)))
    del found["given_sinkage_mm"], found["flag_bits"]
    found |= zip(inputs, (array.reshape(shape) for array in arrays))
    return WheelForces(**found)


class _Stand:
    """Wheel, gravity and model of a call, and the soil of each wheel."""

    def __init__(
        self, soil: Soils, wheel: Wheel | Source, gravity_m_s2: float, model: str | None
    ) -> None:
        wheel = wheel if isinstance(wheel, Wheel) else Wheel(wheel)
        stand = setting(gravity_m_s2, model)
        self._soils, places = soils_of(soil)
        self._places = places
        self.index: NDArray[np.int64] | None = None
        self.documents = (
            [one._document for one in self._soils],
            wheel._document,
            stand._document,
        )

    def broadcast(self, inputs: dict[str, ArrayLike]) -> tuple[list[Floats], tuple[int, ...]]:
        """The arguments at their common shape, flat."""
        arrays, (index,), shape = broadcast(inputs, {"soil": self._places})
        if len(self._soils) > 1:
            self.index = index
        return arrays, shape


def setting(gravity_m_s2: float, model: str | None) -> Scenario:
    """Gravity and wheel–soil model, checked as those of a scenario are. They are cached, because
    computing one wheel is faster than reading a document."""
    if not isinstance(model, (str, type(None))):
        given = type(model).__name__
        raise ParameterError(f"model is of type {given}, it must be a name", "model")
    return _setting(number("gravity_m_s2", gravity_m_s2), model)


@lru_cache(maxsize=64)
def _setting(gravity_m_s2: float, model: str | None) -> Scenario:
    named: dict[str, Any] = {} if model is None else {"model": model}
    return Scenario(gravity_m_s2=gravity_m_s2, **named)


def soils_of(soil: Soils) -> tuple[list[Soil], NDArray[np.int64]]:
    """The different soils, and which of them each wheel has."""
    is_one = isinstance(soil, (Soil, str)) or hasattr(soil, "__fspath__") or hasattr(soil, "keys")
    cells: NDArray[np.object_] = np.empty((), dtype=object)
    if is_one:
        cells[()] = soil
    elif isinstance(soil, np.ndarray):
        cells = soil.astype(object)
    elif isinstance(soil, Sequence):
        cells = np.empty(len(soil), dtype=object)
        cells[:] = soil
    else:
        cells[()] = soil
    different: dict[Soil, int] = {}
    made: dict[Any, Soil] = {}
    places = np.empty(cells.shape, dtype=np.int64)
    for place, cell in np.ndenumerate(cells):
        if isinstance(cell, Soil):
            one = cell
        elif isinstance(cell, str):
            one = made.setdefault(cell, made.get(cell) or Soil(cell))
        else:
            one = Soil(cell)
        places[place] = different.setdefault(one, len(different))
    if not different:
        # An empty sequence is for no wheels, but an array of no wheels needs a soil.
        return [Soil("toyoura")], places
    return list(different), places
