"""Sinkage and forces of wheels on soil, for whole arrays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import lru_cache
from typing import Any, Literal, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _shown, _tables
from ._arrays import Broadcast, Floats, broadcast, number, refuse_other_labels, varied
from ._cells import IS_NAN, cells_of, documents_of, labels_of, numbered
from ._descriptions import Rover, Scenario, Soil, Source, Wheel
from ._errors import ParameterError
from ._gradients import Gradient, Keys, keys_of, of_rows
from ._validity import flags_of

#: One soil, or a sequence that broadcasts with the other arguments.
Soils = Union[Soil, Source, Sequence[Any], NDArray[np.object_]]

#: One wheel, or a sequence that does.
Wheels = Union[Wheel, Source, Sequence[Any], NDArray[np.object_]]
_Thing = TypeVar("_Thing", Soil, Wheel)

#: `Settled.status` of a wheel that the soil carries.
CARRIED = 0
#: `Settled.status` of a wheel that sinks to its axle.
SUNK_TO_AXLE = 1
#: `Settled.status` of a wheel with an input that is NaN.
INPUT_IS_NAN = 2
#: `Settled.status` of a wheel with a number out of its range, with ``outside="nan"``.
OUTSIDE = 3

#: What becomes of an entry with a number out of its range.
Outside = Literal["raise", "nan"]

#: What the text of many wheels has.
_BRIEF = ("sinkage_mm", "drawbar_pull_n", "side_force_n", "torque_nm")


@dataclass(frozen=True, eq=False)
class WheelForces(_tables.Entries):
    """Forces and moments of the soil on wheels, about the hub, in the wheel frame (x forward, y
    left, z up).

    Every field is an array of the shape to which the arguments broadcast; of no dimensions if all
    were single values. Angles are from straight down, positive towards the side that enters the
    soil.

    Examples
    --------
    >>> import grouser as gr
    >>> turned = gr.wheel_forces("toyoura", "hakuto", sinkage_mm=10.0, slip_ratio=0.2, slip_angle_deg=[0, 10])
    >>> turned.shape, bool(abs(turned.side_force_n[1]) > abs(turned.side_force_n[0]))
    ((2,), True)
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
    inputs: Mapping[str, NDArray[Any]] = field(default_factory=dict, kw_only=True)
    """What was asked, by name: arrays as given, which broadcast to `shape`; soils by their names, if
    there were several."""

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of every field."""
        return self.slip_ratio.shape

    def _results(self) -> dict[str, Any]:
        own = (one.name for one in fields(self) if one.name not in ("inputs", "gradient"))
        return {name: getattr(self, name) for name in own}

    def _shown(self) -> dict[str, Any]:
        table = self._table()
        first = {name: table[name] for name in (*self.inputs, *_BRIEF)}
        return {**first, **self._states(), **table}

    def _counts(self) -> str:
        """How many wheels are in which state."""
        return ""

    def __repr__(self) -> str:
        head = f"<{type(self).__name__} of shape {self.shape}{self._counts()}>"
        table = self._table()
        names = [*self.inputs, *(name for name in _BRIEF if name not in self.inputs)]
        if 0 < self.slip_ratio.size <= _shown.MOST_LINES:
            shown = {name: table[name] for name in names}
            return f"{head}\n{_shown.text_table({**shown, **self._states()})}"
        numbers = {name: table[name] for name in names if table[name].dtype.kind == "f"}
        return f"{head}\n{_shown.spread(numbers)}" if self.slip_ratio.size else head

    def _states(self) -> dict[str, Any]:
        """Columns with the state of each wheel."""
        return {}


@dataclass(frozen=True, eq=False, repr=False)
class Settled(WheelForces):
    """Wheels at the sinkage at which the soil carries their load. A wheel that it cannot carry has
    ``status`` 1 and NaN for all results; one with an input that is NaN has ``status`` 2 and NaN, and
    with ``outside="nan"`` one with a number out of its range ``status`` 3 and NaN.

    Examples
    --------
    >>> import grouser as gr
    >>> wheels = gr.settle("toyoura", "hakuto", load_n=[17.0, 1e4], slip_ratio=0.2)
    >>> wheels.status.tolist()                                      # the second sinks to its axle
    [0, 1]
    >>> wheels.to_pandas()["sinkage_mm"].isna().tolist()
    [False, True]
    """

    load_n: Floats
    """Load [N], as asked."""
    status: NDArray[np.int8]
    """0 for a wheel that is carried, 1 for one that sinks to its axle, 2 for one with an input that
    is NaN, 3 for one with a number out of its range."""
    capacity_n: Floats
    """The most that the soil carries down to axle depth [N], where that is less than the load; else
    NaN."""
    flags: NDArray[np.object_]
    """Why each wheel is an extrapolation: names of `FLAGS`, joined by ``;``; empty inside the
    domain."""
    gradient: Gradient | Any = field(default=None, kw_only=True)
    """The derivatives of the results, with ``gradients``; else None."""

    @property
    def messages(self) -> NDArray[np.object_]:
        """Each wheel's status as text, as in the program's tables: ``ok``, or the reason."""
        messages = np.full(self.shape, "ok", dtype=object)
        sunk = self.status == SUNK_TO_AXLE
        messages[sunk] = _core.not_carried(self.load_n[sunk], self.capacity_n[sunk])
        messages[self.status == INPUT_IS_NAN] = "an input is NaN"
        messages[self.status == OUTSIDE] = "a number is out of its range"
        return messages

    def _counts(self) -> str:
        states = (SUNK_TO_AXLE, INPUT_IS_NAN, OUTSIDE)
        sunk, missing, outside = (int((self.status == it).sum()) for it in states)
        flagged = int((self.flags != "").sum())
        counts = {"sunk to the axle": sunk, "with an input that is NaN": missing}
        counts["with a number out of its range"] = outside
        counts["with flags"] = flagged
        found = [f"{count} {state}" for state, count in counts.items() if count]
        return f": {', '.join(found)}" if found else ""

    def _states(self) -> dict[str, Any]:
        states = {"status": self.messages, "flags": self.flags}
        plain = {"status": "ok", "flags": ""}
        return {name: it for name, it in states.items() if (it != plain[name]).any()}


def settle(
    soil: Soils,
    wheel: Wheels,
    *,
    load_n: ArrayLike,
    slip_ratio: ArrayLike,
    slip_angle_deg: ArrayLike = 0.0,
    gravity_m_s2: ArrayLike = _core.EARTH_GRAVITY,
    model: str | None = None,
    vary: Mapping[str, Any] | None = None,
    gradients: Keys | None = None,
    outside: Outside = "raise",
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
    wheel : Wheel, name, path, mapping, or a sequence of them
        The wheel, or as many.
    load_n : array_like
        Load on the wheel [N], 0 to 1e5.
    slip_ratio : array_like
        Slip ratio [-], −2 to 2, positive where the wheel drives.
    slip_angle_deg : array_like
        Slip angle [°], −90 to 90, positive where the hub moves to the left.
    gravity_m_s2 : array_like
        Gravity [m/s²], 0.01 to 30; it gives the soil its weight.
    model : str, optional
        The wheel–soil model: ``ishigami``, ``bekker``, ``small-wheel`` or ``rft``; by default each
        soil's own.
    vary : mapping of str to array_like, optional
        Numbers and words of the soil or the wheel, by their keys, as ``soil.cohesion_kpa``,
        ``wheel.radius_m`` or ``wheel.grousers.count``: they broadcast with the other arguments.
    gradients : str or sequence of str, optional
        Keys of numbers by which all results are differentiated, such as ``soil.cohesion_kpa``,
        ``wheel.radius_m``, ``gravity_m_s2``, ``load_n``, ``slip_ratio`` and ``slip_angle_deg``, or
        ``"all"``: the result then has a `Gradient`.
    outside : {"raise", "nan"}
        With ``"nan"`` a wheel with a number out of its range (`range_of`), or with numbers that do
        not go together, has ``status`` 3 and NaN for all results; by default it is an error.

    Returns
    -------
    Settled
        A wheel with an input that is NaN has NaN for all results.

    Raises
    ------
    ParameterError
        For a value that is not a number, masked or out of its range, for shapes that do not
        broadcast, for DataArrays over different dimensions, and for keys that the soil or the wheel
        does not have.
    DocumentNotFoundError
        If a name is neither a preset nor a file.

    Examples
    --------
    >>> import grouser as gr
    >>> wheels = gr.settle("toyoura", "hakuto", load_n=[[10.0], [20.0]], slip_ratio=[0.1, 0.2, 0.3])
    >>> wheels.drawbar_pull_n.shape
    (2, 3)
    >>> cohesion = {"soil.cohesion_kpa": [0.0, 0.5, 1.0]}
    >>> stiff = gr.settle("toyoura", "hakuto", load_n=17.0, slip_ratio=0.2, vary=cohesion)
    >>> stiff.drawbar_pull_n.round(2).tolist()
    [1.82, 3.01, 4.22]
    >>> gr.settle("toyoura", "hakuto", load_n=[10.0, 20.0], slip_ratio=0.2)
    <Settled of shape (2,)>
    load_n  slip_ratio  slip_angle_deg  sinkage_mm  drawbar_pull_n  side_force_n  torque_nm
        10         0.2               0        10.2          0.9266             0     0.1888
        20         0.2               0          14           2.233             0     0.4527
    """
    stand = _Stand(soil, wheel, gravity_m_s2, model, vary, outside)
    inputs = {"load_n": load_n, "slip_ratio": slip_ratio, "slip_angle_deg": slip_angle_deg}
    found = stand.found(_core.settle, inputs)
    keys = keys_of(gradients)
    if keys is not None:
        found["gradient"] = stand.gradient(inputs, keys)
    sunk, missing = np.isnan(found["normal_force_n"]), np.isnan(found["capacity_n"])
    status = np.where(sunk, np.where(missing, OUTSIDE, SUNK_TO_AXLE), CARRIED)
    status[stand.missing(inputs)] = INPUT_IS_NAN
    flags = flags_of(found.pop("flag_bits"))
    return Settled(**found, status=status.astype(np.int8), flags=flags)


def wheel_forces(
    soil: Soils,
    wheel: Wheels,
    *,
    sinkage_mm: ArrayLike,
    slip_ratio: ArrayLike,
    slip_angle_deg: ArrayLike = 0.0,
    gravity_m_s2: ArrayLike = _core.EARTH_GRAVITY,
    model: str | None = None,
    vary: Mapping[str, Any] | None = None,
    outside: Outside = "raise",
) -> WheelForces:
    """Computes the forces of the soil on wheels at given sinkages.

    Broadcasts as `settle` does.

    Parameters
    ----------
    sinkage_mm : array_like
        Sinkage of the grouser tips [mm], from 0 to the axle's depth.
    soil, wheel, slip_ratio, slip_angle_deg, gravity_m_s2, model, vary, outside
        As for `settle`.

    Returns
    -------
    WheelForces
        A wheel with an input that is NaN has NaN for all results, and with ``outside="nan"`` one
        with a number out of its range.

    Raises
    ------
    ParameterError, DocumentNotFoundError
        As `settle`.

    Examples
    --------
    The soil carries more of a wheel that is deeper:

    >>> import grouser as gr
    >>> sunk = gr.wheel_forces("toyoura", "hakuto", sinkage_mm=[5.0, 10.0, 20.0], slip_ratio=0.2)
    >>> bool((sunk.normal_force_n[1:] > sunk.normal_force_n[:-1]).all())
    True
    """
    stand = _Stand(soil, wheel, gravity_m_s2, model, vary, outside)
    inputs = {"sinkage_mm": sinkage_mm, "slip_ratio": slip_ratio, "slip_angle_deg": slip_angle_deg}
    found = stand.found(_core.wheel_forces, inputs)
    del found["given_sinkage_mm"], found["flag_bits"]
    return WheelForces(**found)


class _Stand:
    """Wheel, gravity and model of a call, the soil of each wheel, and the keys that are varied."""

    def __init__(
        self,
        soil: Soils,
        wheel: Wheels,
        gravity_m_s2: ArrayLike,
        model: str | None,
        vary: Mapping[str, Any] | None,
        outside: Outside,
    ) -> None:
        self._outside_is_nan = outside_is_nan(outside)
        taken = () if model is None else ("soil.model",)
        self._vary = varied(vary, ("soil", "wheel", "gravity_m_s2", *taken))
        if "model" in self._vary:
            raise ParameterError("model does not vary here: vary soil.model", "model")
        self._given = dict(self._vary)
        #: The status of entries whose soil or wheel is invalid.
        self._none: dict[str, NDArray[np.int8]] = {}
        gravity = gravity_m_s2
        if np.ndim(gravity_m_s2) > 0 or self._outside_is_nan:
            self._vary["gravity_m_s2"], gravity = gravity_m_s2, _core.EARTH_GRAVITY
        soils, wheels = soils_of(soil), _things_of(Wheel, "hakuto", wheel)
        self._names = {**names_of(*soils), **names_of(*wheels, "wheel")}
        self._soils, soil_places = self._with_words("soil.", *soils)
        self._wheels, wheel_places = self._with_words("wheel.", *wheels)
        self._places = {"soil": soil_places, "wheel": wheel_places}
        self._setting = setting(gravity, model)._document

    def _with_words(
        self, prefix: str, things: list[_Thing], places: NDArray[np.int64]
    ) -> tuple[list[_Thing], NDArray[np.int64]]:
        """Soils or wheels with what varies of them that is no number, taken from ``vary``."""
        cells = {}
        for name in [name for name in self._vary if name.startswith(prefix)]:
            found = cells_of(self._vary[name], things[0], name, prefix)
            if found is not None:
                cells[name.removeprefix(prefix)] = found
                self._names[name] = labels_of(found)
                del self._vary[name]
        if not cells:
            return things, places
        made, places, problems = documents_of(things, places, cells, self._outside_is_nan)
        if problems:
            self._none[prefix] = np.full(len(made), CARRIED, dtype=np.int8)
        for number, why in problems.items():
            self._none[prefix][number] = INPUT_IS_NAN if why.endswith(IS_NAN) else OUTSIDE
        return made, places

    def found(self, native: Any, inputs: Mapping[str, ArrayLike]) -> dict[str, Any]:
        """Results and inputs by name, as arrays of the common shape."""
        asked, indices = self._asked(inputs)
        vary = {name: asked.flat[name] for name in self._vary}
        numbers = self._numbers(asked, inputs)
        soils = [it._document for it in self._soils]
        wheels = [it._document for it in self._wheels]
        rows, names = native(
            soils, wheels, self._setting, *numbers, *indices, vary, self._outside_is_nan
        )
        found = dict(zip(names, rows.reshape(len(names), *asked.shape)))
        found |= {name: asked.flat[name].reshape(asked.shape) for name in inputs}
        return {**found, "inputs": {**self._names, **asked.given}}

    def gradient(self, inputs: Mapping[str, ArrayLike], keys: Sequence[str]) -> Gradient:
        """The derivatives of settled wheels by some keys."""
        if len(self._wheels) > 1:
            raise ParameterError("gradients go with one wheel, wheel is several", "gradients")
        asked, indices = self._asked(inputs)
        vary = {name: asked.flat[name] for name in self._vary}
        numbers = self._numbers(asked, inputs)
        native: Any = _core.settle_gradients
        soils, wheel = [it._document for it in self._soils], self._wheels[0]._document
        rows, one_sided, keys, names = native(
            soils, wheel, self._setting, *numbers, indices[0], vary, keys, self._outside_is_nan
        )
        return of_rows(rows, one_sided, keys, names, asked.shape)

    def missing(self, inputs: Mapping[str, ArrayLike]) -> NDArray[np.bool_]:
        """Whether a number of each wheel is NaN."""
        asked, _ = self._asked(inputs)
        numbers = (np.asarray(asked.flat[name]) for name in (*self._vary, *inputs))
        each = [np.isnan(it) for it in numbers]
        each += [it == INPUT_IS_NAN for it in self._left_out(asked)]
        missing: NDArray[np.bool_] = np.logical_or.reduce(each)
        return missing.reshape(asked.shape)

    def _left_out(self, asked: Broadcast) -> list[NDArray[np.int8]]:
        """What becomes of each wheel by its soil and by itself, where some are none."""
        places = zip(("soil.", "wheel."), asked.places)
        return [self._none[kind][it] for kind, it in places if kind in self._none]

    def _numbers(self, asked: Broadcast, inputs: Mapping[str, ArrayLike]) -> list[Floats]:
        """The inputs of each wheel: NaN where there is no soil or wheel."""
        first, *others = (asked.flat[name] for name in inputs)
        for left_out in self._left_out(asked):
            first = np.where(left_out, np.nan, first)
        return [first, *others]

    def _asked(self, inputs: Mapping[str, ArrayLike]) -> tuple[Broadcast, list[Any]]:
        refuse_other_labels({**self._given, **inputs})
        asked = broadcast({**self._vary, **inputs}, self._places)
        counts = (len(self._soils), len(self._wheels))
        indices = [it if count > 1 else None for it, count in zip(asked.places, counts)]
        return asked, indices


def outside_is_nan(outside: Outside) -> bool:
    """Whether numbers out of their ranges are no error."""
    if outside not in ("raise", "nan"):
        known = "'raise' or 'nan'"
        message = f"outside is {outside!r}, it must be {known}"
        raise ParameterError(message, "outside", None, known)
    return outside == "nan"


def range_of(
    key: str, of: Soil | Wheel | Rover | Scenario | None = None
) -> tuple[float, float]:
    """The least and the most that a number may be, for samplers and optimisers.

    Parameters
    ----------
    key : str
        The key of a number: of a scenario ``slope_deg``, ``soil.cohesion_kpa`` or
        ``rover.body.mass_kg``; and arguments of studies, as ``load_n``, ``slip_ratio`` or
        ``yaw_deg``.
    of : Soil, Wheel, Rover or Scenario, optional
        The description that has the key; by default the source paper's traverse. The range of some
        keys depends on the laws that a soil follows.

    Returns
    -------
    (float, float)
        Both ends; where a key must be above its lower end, that is not allowed itself.

    Raises
    ------
    ParameterError
        For a key that leads to no number.

    Examples
    --------
    >>> import grouser as gr
    >>> gr.range_of("slope_deg"), gr.range_of("radius_m", gr.Wheel("hakuto"))
    ((0.0, 60.0), (0.01, 1.0))
    """
    description = Scenario() if of is None else of
    if not isinstance(description, (Soil, Wheel, Rover, Scenario)):
        kind = type(description).__name__
        raise ParameterError(
            f"of is of type {kind}, it must be a Soil, Wheel, Rover or Scenario", "of"
        )
    return _core.range_of(description._document, key)


def names_of(
    soils: Sequence[Soil | Wheel], places: NDArray[np.int64], kind: str = "soil"
) -> dict[str, NDArray[Any]]:
    """The column of the soils' names, if there are several; soils of one name are numbered."""
    if places.ndim == 0:
        return {}
    names = numbered([str(soil.name) for soil in soils])
    return {kind: np.array(names, dtype=object)[places]}


def setting(gravity_m_s2: Any, model: str | None) -> Scenario:
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
    return _things_of(Soil, "toyoura", soil)


def _things_of(
    kind: type[_Thing], usual: str, things: Any
) -> tuple[list[_Thing], NDArray[np.int64]]:
    """The different soils or wheels, and which of them each entry has."""
    is_one = isinstance(things, (kind, str)) or hasattr(things, "__fspath__")
    if is_one or hasattr(things, "keys"):
        one = things if isinstance(things, kind) else kind(things)
        return [one], np.zeros((), dtype=np.int64)
    cells: NDArray[np.object_] = np.empty((), dtype=object)
    if isinstance(things, np.ndarray):
        cells = things.astype(object)
    elif isinstance(things, Sequence):
        cells = np.empty(len(things), dtype=object)
        cells[:] = things
    else:
        cells[()] = things
    different: dict[_Thing, int] = {}
    made: dict[Any, _Thing] = {}
    places = np.empty(cells.shape, dtype=np.int64)
    for place, cell in np.ndenumerate(cells):
        if isinstance(cell, kind):
            one = cell
        elif isinstance(cell, str):
            one = made.setdefault(cell, made.get(cell) or kind(cell))
        else:
            one = kind(cell)
        places[place] = different.setdefault(one, len(different))
    # An empty sequence is for no entries, but an array of none needs a soil.
    return list(different) or [kind(usual)], places
