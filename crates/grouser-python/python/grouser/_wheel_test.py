"""Wheel tests on a simulated test stand, with or without measurement noise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._arrays import Floats, line, number, together, varied, whole_number
from ._cells import as_array
from ._descriptions import Scenario, Soil, Source, Wheel
from ._errors import ParameterError
from ._models import ByModel, each_model
from ._studies import soil_of
from ._sweeps import Sweep, Vary
from ._wheels import Outside, Settled, Soils, Wheels, setting, settle

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes


#: The usual soil and wheel, by which it is known whether others are given.
_SOIL, _WHEEL = "toyoura", "hakuto"
#: The settings of a test stand, and the number of the trial.
_COORDS = ("load_n", "slip_angle_deg", "slip_ratio", "trial")


@dataclass(frozen=True, eq=False)
class WheelTestBand(_tables.Band):
    """A wheel test over samples of soil and model: arrays of shape (loads, angles, ratios).

    ``…_p2_5``, ``…_p50`` and ``…_p97_5`` are quantiles over the samples: 95 % of the values lie
    between the first and the last. Where the soil does not carry the wheel, a sample counts as sunk
    to the axle, with the load as its drag, no side force, and the torque that turns the rim against
    the whole load.

    Examples
    --------
    >>> import grouser as gr
    >>> test = gr.wheel_test("toyoura-uncertain", load_n=17, slip_ratio=[0.1, 0.4], uncertainty=True, samples=20)
    >>> bool((test.band.drawbar_pull_n_p2_5 < test.band.drawbar_pull_n_p97_5).all())
    True
    """

    sinkage_mm_p2_5: Floats
    """Sinkage of the grouser tips [mm]."""
    sinkage_mm_p50: Floats
    """Its median [mm]."""
    sinkage_mm_p97_5: Floats
    """Its upper end [mm]."""
    drawbar_pull_n_p2_5: Floats
    """Force along the wheel [N]."""
    drawbar_pull_n_p50: Floats
    """Its median [N]."""
    drawbar_pull_n_p97_5: Floats
    """Its upper end [N]."""
    side_force_n_p2_5: Floats
    """Force across the wheel [N], positive to the left."""
    side_force_n_p50: Floats
    """Its median [N]."""
    side_force_n_p97_5: Floats
    """Its upper end [N]."""
    torque_nm_p2_5: Floats
    """Torque of the drive [N·m]."""
    torque_nm_p50: Floats
    """Its median [N·m]."""
    torque_nm_p97_5: Floats
    """Its upper end [N·m]."""
    probability_carried: Floats
    """Probability that the soil carries the wheel [-]: the share of the samples in which it
    does."""
    probability_carried_low: Floats
    """Lower end of its 95 % confidence interval, for the number of samples [-]."""
    probability_carried_high: Floats
    """Upper end of that interval [-]."""
    draws: Floats
    """All samples."""
    model_weights: Mapping[str, float]
    """The share of the samples that each wheel–soil model computes [-]."""

    def __repr__(self) -> str:
        return f"<WheelTestBand of {' × '.join(map(str, self.draws.shape))} loads, angles, ratios>"


@dataclass(frozen=True, eq=False)
class WheelTest(_tables.Tabular):
    """A wheel test: every load with every slip angle and every slip ratio.

    Examples
    --------
    >>> import grouser as gr
    >>> test = gr.wheel_test("toyoura", load_n=17, slip_ratio=[0.1, 0.3, 0.5], slip_angle_deg=[0, 15])
    >>> test.wheels.drawbar_pull_n.shape                            # loads, slip angles, slip ratios
    (1, 2, 3)
    >>> straight = test.to_xarray().drawbar_pull_n.sel(load_n=17, slip_angle_deg=0)
    >>> bool(straight.sel(slip_ratio=0.5) > straight.sel(slip_ratio=0.1))
    True
    """

    load_n: Floats
    """Loads [N], shape (loads,)."""
    slip_angle_deg: Floats
    """Slip angles [°], shape (angles,)."""
    slip_ratio: Floats
    """Slip ratios [-], shape (ratios,)."""
    wheels: Settled
    """Sinkage and forces; fields of shape (loads, angles, ratios)."""
    band: WheelTestBand | Any = None
    """The same over samples of soil and model, with ``uncertainty=True``; else None."""

    def _bands(self) -> dict[str, Any]:
        return {} if self.band is None else self.band._table()

    @property
    def flags(self) -> NDArray[np.object_]:
        """Why each row is an extrapolation: names of `FLAGS`, joined by ``;``."""
        return self.wheels.flags

    def _table(self) -> dict[str, Any]:
        return {**self.wheels._table(), "status": self.wheels.messages, **self._bands()}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each setting, slip ratios fastest, as in the program's CSV."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``load_n``, ``slip_angle_deg`` and ``slip_ratio``; units in the
        attributes."""
        coords = {name: getattr(self, name) for name in _COORDS[:3]}
        columns = {k: v for k, v in self.wheels._table().items() if k not in coords}
        columns |= self._bands()
        return _tables.dataset(tuple(coords), columns, coords)

    def plot(self, axes: Axes | None = None, *, name: str = "drawbar_pull_n", **style: Any) -> Axes:
        """Plots a quantity over the slip ratio, a line for each load and slip angle, with its band
        if there is one.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        name : str
            The quantity.
        **style
            Arguments of the drawing functions of matplotlib.
        """
        axes = _tables.axes_or_new(axes)
        values = getattr(self.wheels, name)
        ends = [self._bands().get(f"{name}_{end}") for end in ("p2_5", "p97_5")]
        for i, load in enumerate(self.load_n):
            for j, angle in enumerate(self.slip_angle_deg):
                if ends[0] is not None and ends[1] is not None:
                    axes.fill_between(self.slip_ratio, ends[0][i, j], ends[1][i, j], alpha=0.25)
                axes.plot(
                    self.slip_ratio, values[i, j], **{"label": f"{load:g} N, {angle:g}°", **style}
                )
        axes.set_xlabel("slip ratio")
        axes.set_ylabel(_tables.label(name))
        axes.legend()
        return axes

    def __repr__(self) -> str:
        return f"<WheelTest of {' × '.join(map(str, self.wheels.shape))} loads, angles, ratios>"


@dataclass(frozen=True, eq=False)
class SimulatedWheelTest(_tables.Tabular):
    """A wheel test with simulated measurement noise: arrays of shape (loads, angles, ratios,
    trials), NaN where the soil does not carry the wheel. Readings are rounded to a ten-thousandth
    of their unit.

    Examples
    --------
    >>> import grouser as gr
    >>> test = gr.wheel_test("toyoura", load_n=17, slip_ratio=[0.1, 0.4], trials=5, seed=3)
    >>> test.drawbar_pull_n.shape                                   # loads, angles, ratios, trials
    (1, 1, 2, 5)
    >>> bool((test.drawbar_pull_n.std(axis=-1) > 0.0).all())        # trials differ by noise
    True
    """

    load_n: Floats
    """Loads [N], shape (loads,)."""
    slip_angle_deg: Floats
    """Slip angles [°], shape (angles,)."""
    slip_ratio: Floats
    """Slip ratios [-], shape (ratios,)."""
    status: NDArray[np.object_]
    """``ok``, or why there are no readings."""
    sinkage_mm: Floats
    """Sinkage [mm]."""
    drawbar_pull_n: Floats
    """Force along the wheel [N]."""
    side_force_n: Floats
    """Force across the wheel [N], positive to the left."""
    torque_nm: Floats
    """Torque of the drive [N·m]."""

    def _readings(self) -> dict[str, Any]:
        names = [name for name in _tables.COLUMNS["stand"] if name not in _COORDS]
        return {"status": self.status, **{name: getattr(self, name) for name in names}}

    def _coords(self) -> dict[str, Any]:
        trial = np.arange(1, self.status.shape[-1] + 1)
        return dict(zip(_COORDS, (self.load_n, self.slip_angle_deg, self.slip_ratio, trial)))

    def _table(self) -> dict[str, Any]:
        coords = self._coords()
        mesh = np.meshgrid(*coords.values(), indexing="ij")
        return {**dict(zip(coords, mesh)), **self._readings()}

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each trial of each setting, as in the program's CSV. Its CSV
        (``.to_csv(file, index=False)``) is a file of measurements, for `calibrate` and
        `validate`."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``load_n``, ``slip_angle_deg``, ``slip_ratio`` and ``trial``; units in the
        attributes."""
        coords = self._coords()
        return _tables.dataset(tuple(coords), self._readings(), coords)

    def plot(self, axes: Axes | None = None, *, name: str = "drawbar_pull_n", **style: Any) -> Axes:
        """Plots a reading over the slip ratio, a dot for each trial.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        name : str
            The quantity.
        **style
            Arguments of the drawing functions of matplotlib.
        """
        axes = _tables.axes_or_new(axes)
        values = getattr(self, name)
        for i, load in enumerate(self.load_n):
            for j, angle in enumerate(self.slip_angle_deg):
                ratios = np.repeat(self.slip_ratio, values.shape[-1])
                own = {"ls": "", "marker": ".", "label": f"{load:g} N, {angle:g}°", **style}
                axes.plot(ratios, values[i, j].ravel(), **own)
        axes.set_xlabel("slip ratio")
        axes.set_ylabel(_tables.label(name))
        axes.legend()
        return axes

    def __repr__(self) -> str:
        shape = " × ".join(map(str, self.status.shape))
        return f"<SimulatedWheelTest of {shape} loads, angles, ratios, trials>"


@overload
def wheel_test(  # type: ignore[overload-overlap]
    soil: Soils = ..., wheel: Wheels = ..., *, load_n: ArrayLike, slip_ratio: ArrayLike,
    slip_angle_deg: ArrayLike = ..., gravity_m_s2: float = ..., model: Literal["all"], vary: Vary,
    outside: Outside = ...,
) -> ByModel[Sweep]: ...


@overload
def wheel_test(
    soil: Soils = ..., wheel: Wheels = ..., *, load_n: ArrayLike, slip_ratio: ArrayLike,
    slip_angle_deg: ArrayLike = ..., gravity_m_s2: float = ..., model: str | None = ..., vary: Vary,
    outside: Outside = ...,
) -> Sweep: ...


@overload
def wheel_test(  # type: ignore[overload-overlap]
    soil: Soil | Source = ...,
    wheel: Wheel | Source = ...,
    *,
    load_n: ArrayLike,
    slip_ratio: ArrayLike,
    slip_angle_deg: ArrayLike = ...,
    gravity_m_s2: float = ...,
    model: Literal["all"],
    trials: None = ...,
    noise_n: float = ...,
    noise_mm: float = ...,
    noise_nm: float = ...,
    uncertainty: bool = ...,
    samples: int = ...,
    seed: int = ...,
) -> ByModel[WheelTest]: ...


@overload
def wheel_test(  # type: ignore[overload-overlap]
    soil: Soil | Source = ...,
    wheel: Wheel | Source = ...,
    *,
    load_n: ArrayLike,
    slip_ratio: ArrayLike,
    slip_angle_deg: ArrayLike = ...,
    gravity_m_s2: float = ...,
    model: Literal["all"],
    trials: int,
    noise_n: float = ...,
    noise_mm: float = ...,
    noise_nm: float = ...,
    seed: int = ...,
) -> ByModel[SimulatedWheelTest]: ...


@overload
def wheel_test(
    soil: Soil | Source = ...,
    wheel: Wheel | Source = ...,
    *,
    load_n: ArrayLike,
    slip_ratio: ArrayLike,
    slip_angle_deg: ArrayLike = ...,
    gravity_m_s2: float = ...,
    model: str | None = ...,
    trials: None = ...,
    noise_n: float = ...,
    noise_mm: float = ...,
    noise_nm: float = ...,
    uncertainty: bool = ...,
    samples: int = ...,
    seed: int = ...,
) -> WheelTest: ...


@overload
def wheel_test(
    soil: Soil | Source = ...,
    wheel: Wheel | Source = ...,
    *,
    load_n: ArrayLike,
    slip_ratio: ArrayLike,
    slip_angle_deg: ArrayLike = ...,
    gravity_m_s2: float = ...,
    model: str | None = ...,
    trials: int,
    noise_n: float = ...,
    noise_mm: float = ...,
    noise_nm: float = ...,
    seed: int = ...,
) -> SimulatedWheelTest: ...


def wheel_test(
    soil: Soils = _SOIL,
    wheel: Wheels = _WHEEL,
    *,
    load_n: ArrayLike,
    slip_ratio: ArrayLike,
    slip_angle_deg: ArrayLike = 0.0,
    gravity_m_s2: float = _core.EARTH_GRAVITY,
    model: str | None = None,
    trials: int | None = None,
    noise_n: float = 0.3,
    noise_mm: float = 0.5,
    noise_nm: float = 0.02,
    uncertainty: bool = False,
    samples: int = 200,
    seed: int = 1,
    vary: Vary | None = None,
    outside: Outside = "raise",
) -> WheelTest | SimulatedWheelTest | Sweep | ByModel[Any]:
    """Simulates a wheel on a test stand: every load with every slip angle and every slip ratio
    ([FourWheel], section 4 and Fig. 7).

    Parameters
    ----------
    soil, wheel, gravity_m_s2
        As for `settle`; one soil and wheel, but with ``vary``.
    model : str, optional
        The wheel–soil model, or ``"all"`` for the results of each; by default the soil's own.
    load_n : array_like, shape (loads,)
        Loads [N], 0 to 1e5.
    slip_ratio : array_like, shape (ratios,)
        Slip ratios [-], −2 to 2.
    slip_angle_deg : array_like, shape (angles,)
        Slip angles [°], −90 to 90.
    trials : int, optional
        Number of trials of each setting, 1 to 1000, with normally distributed measurement noise; by
        default the exact values, once.
    noise_n, noise_mm, noise_nm : float
        Standard deviations of the simulated forces [N], sinkage [mm] and torque [N·m].
    uncertainty : bool
        Whether to sample what is uncertain, for `WheelTest.band`: the soil, where its document says
        so, and the wheel–soil model, where none is asked for. Not with ``trials``.
    samples : int
        Number of samples, 2 to 100000.
    seed : int
        Seed of the noise or of the samples: the same seed gives the same readings, or the same
        soils and models.
    vary, outside
        As for `settle`, and ``soil`` and ``wheel`` may vary, too: what varies broadcasts with those,
        and loads, slip angles and slip ratios are the axes of the `Sweep`. Not with ``trials`` and ``uncertainty``.

    Returns
    -------
    WheelTest
        Or `SimulatedWheelTest`, with ``trials``, or `Sweep`, with ``vary``; or `ByModel` of them, for
        all models.

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError
        As `settle`.

    Examples
    --------
    >>> import grouser as gr
    >>> test = gr.wheel_test(load_n=[10, 20], slip_ratio=[0.1, 0.3, 0.5], trials=4)
    >>> test.drawbar_pull_n.shape
    (2, 1, 3, 4)
    """
    if model == "all":
        settings: dict[str, Any] = {
            "load_n": load_n,
            "slip_ratio": slip_ratio,
            "slip_angle_deg": slip_angle_deg,
            "gravity_m_s2": gravity_m_s2,
            "trials": trials,
            "noise_n": noise_n,
            "noise_mm": noise_mm,
            "noise_nm": noise_nm,
            "uncertainty": uncertainty,
            "samples": samples,
            "seed": seed,
            "vary": vary,
            "outside": outside,
        }
        found_by: Any = each_model(lambda name: wheel_test(soil, wheel, model=name, **settings))
        return found_by  # type: ignore[no-any-return]
    loads, angles = line("load_n", load_n), line("slip_angle_deg", slip_angle_deg)
    ratios = line("slip_ratio", slip_ratio)
    if vary is not None:
        if trials is not None or uncertainty:
            name = "uncertainty" if trials is None else "trials"
            raise ParameterError(f"vary does not go with {name}: leave one of them out", "vary")
        axes = dict(zip(_COORDS, (loads, angles, ratios)))
        return _sweep(soil, wheel, axes, gravity_m_s2, model, vary, outside)
    if trials is not None and uncertainty:
        raise ParameterError("uncertainty is not known of readings with noise", "uncertainty")
    if trials is not None:
        deviations = {"noise_n": noise_n, "noise_mm": noise_mm, "noise_nm": noise_nm}
        noise = [number(name, value) for name, value in deviations.items()]
        documents = _documents(soil, wheel, setting(gravity_m_s2, model))
        count = whole_number("trials", trials, most=2**53)
        found = _core.simulated_wheel_test(
            *documents, loads, angles, ratios, count, noise, whole_number("seed", seed)
        )
        shape = (len(loads), len(angles), len(ratios), count)
        status = np.array(found.pop("status"), dtype=object).reshape(shape)
        readings = {
            name: values.reshape(shape) for name, values in found.items() if name not in _COORDS
        }
        settings = dict(zip(_COORDS, (loads, angles, ratios)))
        return SimulatedWheelTest(**settings, status=status, **readings)
    wheels = settle(
        soil_of(soil),
        wheel,
        load_n=loads[:, None, None],
        slip_angle_deg=angles[:, None],
        slip_ratio=ratios,
        gravity_m_s2=gravity_m_s2,
        model=model,
    )
    band = None
    if uncertainty:
        documents = _documents(soil, wheel, setting(gravity_m_s2, model))
        drawn = whole_number("seed", seed), whole_number("samples", samples, most=2**32 - 1)
        found = _core.wheel_test_band(*documents, loads, angles, ratios, *drawn)
        sizes = (len(loads), len(angles), len(ratios))
        weights = found.pop("model_weights")
        numbers = {name: values.reshape(sizes) for name, values in found.items()}
        band = WheelTestBand(**numbers, model_weights=weights)
    return WheelTest(
        load_n=loads, slip_angle_deg=angles, slip_ratio=ratios, wheels=wheels, band=band
    )


def _documents(
    soil: Any, wheel: Any, stand: Scenario
) -> tuple[_core.Document, _core.Document, _core.Document]:
    """Soil, wheel and setting, as the native half takes them."""
    one = wheel if isinstance(wheel, Wheel) else Wheel(wheel)
    return soil_of(soil)._document, one._document, stand._document


def _sweep(
    soil: Soils,
    wheel: Wheels,
    axes: dict[str, Floats],
    gravity_m_s2: float,
    model: str | None,
    vary: Vary,
    outside: Outside,
) -> Sweep:
    """Wheel tests over what varies, whose axes stand before those of the test."""
    usual = {"soil": _SOIL, "wheel": _WHEEL, "gravity_m_s2": _core.EARTH_GRAVITY}
    own: dict[str, Any] = {"soil": soil, "wheel": wheel, "gravity_m_s2": gravity_m_s2}
    taken = [name for name, it in own.items() if it is not usual[name]]
    own |= varied(vary, (*axes, *taken))
    several = (list, tuple, np.ndarray)
    arrays = {
        name: as_array(name, it)
        for name, it in own.items()
        if name in vary or isinstance(it, several)
    }
    together(arrays)
    own |= {name: it[..., None, None, None] for name, it in arrays.items()}
    loads, angles, ratios = axes.values()
    wheels = settle(
        own.pop("soil"),
        own.pop("wheel"),
        load_n=loads[:, None, None],
        slip_angle_deg=angles[:, None],
        slip_ratio=ratios,
        gravity_m_s2=own.pop("gravity_m_s2"),
        model=model,
        vary=own,
        outside=outside,
    )
    inputs = {name: it for name, it in wheels.inputs.items() if name not in axes}
    inputs = {name: it[..., 0, 0, 0] if it.ndim else it for name, it in inputs.items()}
    columns = {name: it for name, it in wheels._results().items() if name not in axes}
    columns["status"] = wheels.messages
    return Sweep(columns, axes, inputs, wheels.shape[:-3], {}, "wheel")
