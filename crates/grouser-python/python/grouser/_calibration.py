"""Estimates soil parameters, with confidence intervals, from wheel or plate tests."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._arrays import Floats, line, number, whole_number
from ._descriptions import Soil, Source, Wheel
from ._errors import ParameterError
from ._measurements import Data, rows_of
from ._studies import soil_of
from ._validation import Validation, validation_of
from ._wheels import setting

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.axes import Axes

#: Keys to fit: names, or names with bounds (None for the default ones).
Fit = Union[str, Sequence[str], Mapping[str, Union[tuple[float, float], None]]]

#: Fields of a `Calibration` over keys that have the name of their column.
_SAME_NAMES = (
    "start",
    "lower",
    "upper",
    "fit",
    "fit_std",
    "mean",
    "std",
    "p2_5",
    "p50",
    "p97_5",
    "r_hat",
    "effective_samples",
)
#: Columns over keys.
_PARAMETERS = (*_SAME_NAMES, "posterior_contraction")
#: Columns of numbers without a unit.
_RATIOS = ("r_hat", "effective_samples", "posterior_contraction")


@dataclass(frozen=True, eq=False)
class Calibration(_tables.Tabular):
    """A soil fitted to measurements: arrays of shape (keys,) in each key's own unit. With
    ``point_fit`` fields of the posterior are NaN or None.

    Examples
    --------
    >>> import grouser as gr
    >>> test = gr.wheel_test("toyoura", load_n=20, slip_ratio=[0, 0.2, 0.4, 0.6], trials=3)
    >>> start = gr.Soil("toyoura", shear={"longitudinal_m": 0.1})
    >>> found = gr.calibrate(test, start, "hakuto", fit=["shear.longitudinal_m"], point_fit=True)
    >>> true_m, found_m = (soil.shear["longitudinal_m"] for soil in (gr.Soil("toyoura"), found.soil))
    >>> abs(found_m / true_m - 1.0) < 0.2, found.best == {"soil.shear.longitudinal_m": found_m}
    (True, True)
    """

    key: tuple[str, ...]
    """The fitted keys, as ``soil.pressure_sinkage.k_phi``."""
    start: Floats
    """The document's values."""
    lower: Floats
    """Lower bounds of the search."""
    upper: Floats
    """Upper bounds of the search."""
    fit: Floats
    """Least squares."""
    fit_std: Floats
    """Their standard errors, to first order."""
    mean: Floats
    """Mean of the posterior."""
    std: Floats
    """Its standard deviation."""
    p2_5: Floats
    """2.5 % quantile of the posterior."""
    p50: Floats
    """Median of the posterior."""
    p97_5: Floats
    """97.5 % quantile of the posterior."""
    r_hat: Floats
    """Convergence diagnostic R-hat [-]: near 1 if the sampler has converged."""
    effective_samples: Floats
    """Effective sample size [-]: the number of independent samples with the same information."""
    posterior_contraction: Floats
    """Standard deviation of the posterior over that of the prior [-]: near 1 the data do not inform
    the key."""
    samples: Floats | Any
    """Posterior samples, shape (samples, keys): ensemble by ensemble, step by step, walker by
    walker. Neighbours are of different walkers: taken as one chain they look independent, which
    they are not. `chains` has the order of the steps."""
    correlations: Floats
    """Correlation of each key with each other [-], shape (keys, keys)."""
    discrepancies: Mapping[str, Any]
    """Model discrepancy: standard deviation of the errors beyond the scatter of repeated trials.
    Columns ``channel``, ``fit``, ``mean``, ``std`` over the measured quantities, in their units."""
    correlation_lengths: Mapping[str, Any]
    """The distance over which discrepancies stay alike: columns ``along``, ``fit``, ``mean``,
    ``std``, a row for the slip by the total speed and one for the slip angle [°]. Plate tests have
    none."""
    outcome: str
    """``determined``; ``underdetermined`` if some keys are unidentifiable from these data;
    ``not_converged`` if least squares or the sampler has not converged."""
    message: str | None
    """The outcome explained; None for ``determined``."""
    unidentifiable: tuple[str, ...]
    """Keys and combinations of keys that the data do not determine, a sentence for each."""
    notes: tuple[str, ...]
    """Remarks on the file and the search."""
    searches: int
    """Number of least-squares searches, from different starts."""
    searches_that_agree: int
    """Number of searches that reached the same minimum as the best."""
    sampler: Mapping[str, Any] | Any
    """Settings and diagnostics of the sampler: ``seed``, ``ensembles``, ``walkers``, ``steps``,
    ``acceptance``, ``worst_r_hat``, ``least_effective_samples``."""
    soil: Soil
    """The fitted soil, with the posterior samples as uncertainty: for `heading` and every other
    study that has samples."""
    validation: Validation | Any = None
    """Errors of the fitted model; None for plate tests."""
    cross_validation: tuple[Mapping[str, Any], ...] = ()
    """With ``cross_validate=True``, errors at each slip angle of a fit without that angle, as
    groups of a `Validation`; with samples also, for each quantity, ``coverage_50`` and
    ``coverage_95``, the shares of cells within the predictive bands, ``interval_score`` of the
    95 % bands, in the quantity's unit, and the number of ``cells_with_band``."""
    cross_validation_overall: Mapping[str, Any] | Any = None
    """The same of all left-out cells together; None without ``cross_validate=True``."""
    target: str | Any = None
    """The prediction whose uncertainty the proposed tests should reduce."""
    proposals: Mapping[str, Any] | Any = None
    """The tests to run next, the best first: columns ``load_n``, ``slip_ratio``,
    ``slip_angle_deg``, and the standard deviations of the target ``std_before`` and
    ``std_after``."""
    curves: Mapping[str, Floats] | Any = None
    """Of plate tests, columns over points: ``plate_width_mm``, ``sinkage_mm``,
    ``measured_pressure_kpa``, ``pressure_kpa``. Repeats are one curve, their mean."""
    shear_curves: Mapping[str, Floats] | Any = None
    """Of shear tests, columns over points: ``normal_stress_kpa``, ``shear_displacement_mm``,
    ``measured_shear_stress_kpa``, ``shear_stress_kpa``."""

    @property
    def chains(self) -> Floats | None:
        """The posterior samples by walker, shape (chains, steps, keys): a chain is one walker, and
        ``sampler["walkers"]`` neighbouring chains are one ensemble. None for a ``point_fit``.

        Their effective samples agree with `effective_samples`. Walkers of one ensemble depend on
        each other, ensembles do not: `r_hat` compares ensembles, whose samples are
        ``samples.reshape(sampler["ensembles"], -1, len(key))``. `to_arviz` gives both to ArviZ.
        """
        if self.samples is None or self.sampler is None:
            return None
        ensembles, walkers = self.sampler["ensembles"], self.sampler["walkers"]
        steps = self.samples.reshape(ensembles, -1, walkers, len(self.key))
        return np.ascontiguousarray(steps.swapaxes(1, 2)).reshape(
            ensembles * walkers, -1, len(self.key)
        )

    @property
    def best(self) -> dict[str, float]:
        """Least-squares values by key."""
        return dict(zip(self.key, self.fit.tolist()))

    def _table(self) -> dict[str, Any]:
        return {"key": np.array(self.key, dtype=object), **self._parameters()}

    def _notes(self) -> dict[str, str]:
        notes = {"outcome": self.outcome, "soil": self.soil.to_toml()}
        return notes if self.message is None else {**notes, "message": self.message}

    def _unit_of(self, name: str) -> str | None:
        return "1" if name in _RATIOS else None

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each key, as the program's CSV has it."""
        return _tables.frame(self._table())

    def to_xarray(self) -> xarray.Dataset:
        """A dataset over ``key`` (with the ``unit`` that its name ends with; empty for a ratio, and
        for a modulus whose unit goes with the sinkage exponent), with ``samples`` over ``sample``
        and ``key``, and ``chains`` over ``chain`` (with its ``ensemble``), ``draw`` and ``key``."""
        data = _tables.dataset(("key",), self._parameters(), {"key": list(self.key)})
        for name in data.data_vars:
            if name not in _RATIOS:
                # Their units differ from key to key.
                data[name].attrs.clear()
        names = [key.removeprefix("soil.") for key in self.key]
        data = data.assign_coords(unit=("key", [_core.unit_of(name) or "" for name in names]))
        data["correlations"] = (("key", "other_key"), self.correlations)
        if self.samples is not None:
            data["samples"] = (("sample", "key"), self.samples)
        if self.chains is not None and self.sampler is not None:
            data["chains"] = (("chain", "draw", "key"), self.chains)
            ensemble = np.arange(len(self.chains)) // self.sampler["walkers"]
            data = data.assign_coords(ensemble=("chain", ensemble))
        return data.assign_attrs(self._notes())

    def to_arviz(self, by: Literal["walker", "ensemble"] = "walker") -> Any:
        """The posterior samples for ArviZ, a variable for each key.

        Parameters
        ----------
        by : {"walker", "ensemble"}
            What a chain is: a walker, as in `chains`, for effective sample sizes; or an ensemble,
            for R-hat: ensembles do not depend on each other, the walkers of one do.

        Returns
        -------
        arviz.InferenceData
            From ArviZ 1.0 on an ``xarray.DataTree``.

        Raises
        ------
        ParameterError
            If there are no posterior samples.
        ImportError
            Without ArviZ.
        """
        if self.chains is None or self.samples is None or self.sampler is None:
            raise ParameterError("a point fit has no posterior samples for ArviZ")
        if by not in ("walker", "ensemble"):
            known = "'walker' or 'ensemble'"
            raise ParameterError(f"by is {by!r}, it must be {known}", "by", None, known)
        try:
            import arviz
        except ImportError as error:
            raise ImportError("to_arviz needs ArviZ: pip install arviz", name="arviz") from error
        chains = self.chains
        if by == "ensemble":
            chains = self.samples.reshape(self.sampler["ensembles"], -1, len(self.key))
        posterior = {key: chains[..., k] for k, key in enumerate(self.key)}
        if int(arviz.__version__.split(".")[0]) < 1:
            return arviz.from_dict(posterior=posterior)
        return arviz.from_dict({"posterior": posterior})

    def _parameters(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in _PARAMETERS}

    def plot(self, axes: Axes | None = None, *, name: str = "drawbar_pull_n", **style: Any) -> Axes:
        """Plots predictions of the fitted model over measurements, a dot for each cell; for plate
        tests pressure over sinkage, a line for each plate.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        name : str
            The quantity, of wheel tests.
        **style
            Arguments of the drawing functions of matplotlib.
        """
        if self.validation is not None:
            return self.validation.plot(axes, name=name, **style)
        axes = _tables.axes_or_new(axes)
        if self.curves is not None:
            setting, place, value, unit = "plate_width_mm", "sinkage_mm", "pressure_kpa", "mm"
            curves = self.curves
        else:
            setting, place, unit = "normal_stress_kpa", "shear_displacement_mm", "kPa"
            value, curves = "shear_stress_kpa", self.shear_curves or {}
        for one in dict.fromkeys(curves[setting].tolist()):
            own = np.flatnonzero(curves[setting] == one)
            own = own[np.argsort(curves[place][own], kind="stable")]
            line = axes.plot(
                curves[place][own],
                curves[value][own],
                **{"label": f"{one:g} {unit}", **style},
            )[0]
            measured = curves[f"measured_{value}"][own]
            axes.plot(curves[place][own], measured, ".", color=line.get_color())
        axes.set_xlabel("sinkage [mm]" if self.curves is not None else "displacement [mm]")
        axes.set_ylabel("pressure [kPa]" if self.curves is not None else "shear stress [kPa]")
        axes.legend()
        return axes

    def plot_corner(self, axes: NDArray[np.object_] | None = None) -> NDArray[np.object_]:
        """Plots the posterior: a histogram of each key, and a scatter plot of each pair of keys.

        Parameters
        ----------
        axes : array of matplotlib axes, shape (keys, keys), optional
            Axes to plot on; by default those of a new figure.

        Returns
        -------
        array of matplotlib axes

        Raises
        ------
        ParameterError
            If there are no posterior samples, or the shape of the axes is wrong.
        """
        if self.samples is None:
            raise ParameterError("a point fit has no posterior samples to plot")
        count = len(self.key)
        if axes is None:
            import matplotlib.pyplot as plt

            axes = plt.subplots(count, count, squeeze=False, figsize=(2.2 * count, 2.2 * count))[1]
        if np.shape(axes) != (count, count):
            raise ParameterError(f"axes has shape {np.shape(axes)}, it must be ({count}, {count})")
        for i in range(count):
            for j in range(count):
                _corner_cell(axes[i, j], self.samples[:, i], self.samples[:, j], (i, j))
        for k, key in enumerate(self.key):
            axes[-1, k].set_xlabel(key.rsplit(".", 1)[-1])
            if k > 0:
                axes[k, 0].set_ylabel(key.rsplit(".", 1)[-1])
        return axes

    def __repr__(self) -> str:
        values = ", ".join(f"{key}={value:.4g}" for key, value in self.best.items())
        return f"<Calibration {self.outcome}: {values}>"


def _corner_cell(axes: Axes, y: Floats, x: Floats, place: tuple[int, int]) -> None:
    if place[0] < place[1]:
        axes.set_visible(False)
    elif place[0] == place[1]:
        axes.hist(x, bins=24, histtype="step")
        axes.set_yticks([])
    else:
        stride = max(1, len(x) // 1000)
        axes.plot(x[::stride], y[::stride], ls="", marker=".", ms=2)


def calibrate(
    data: Data,
    soil: Soil | Source,
    wheel: Wheel | Source,
    *,
    fit: Fit,
    where: Sequence[str] | str = (),
    wheel_label: str | None = None,
    gravity_m_s2: float = _core.EARTH_GRAVITY,
    model: str | None = None,
    point_fit: bool = False,
    steps: int = 400,
    seed: int = 1,
    cross_validate: bool = False,
    target: str = "drawbar_pull_n:slip_ratio=0.2",
    propose: int = 3,
    candidate_load_n: ArrayLike | None = None,
    candidate_slip_ratio: ArrayLike = (-0.6, -0.3, 0.0, 0.3, 0.6, 0.9),
    candidate_slip_angle_deg: ArrayLike = (0.0, 15.0, 30.0, 45.0),
) -> Calibration:
    """Fits numbers of a soil to measured wheel tests: bounded least squares from several
    starts, then an affine-invariant ensemble sampler. Results equal the program's, bit for bit.

    Parameters
    ----------
    data, where, wheel_label
        As for `validate`.
    soil : Soil, name, path or mapping
        The soil: initial values of the fit, and all values that are not fitted.
    wheel, gravity_m_s2, model
        As for `settle`.
    fit : str, sequence of str, or mapping of str to (float, float) or None
        Keys of the soil, such as ``"pressure_sinkage.k_phi"``; a mapping gives bounds,
        or None for the default ones.
    point_fit : bool
        Whether to stop after least squares, without the posterior.
    steps : int
        Steps of each walker of the posterior, 100 to 999999, rounded up to whole blocks of 25.
    seed : int
        Seed of all random numbers.
    cross_validate : bool
        Whether to repeat the fit without each slip angle in turn, and validate it at that angle.
    target : str
        The prediction whose uncertainty the proposed tests should reduce, such as
        ``"side_force_n:load_n=17,slip_ratio=0.2,slip_angle_deg=15"``.
    propose : int
        How many tests to propose.
    candidate_load_n, candidate_slip_ratio, candidate_slip_angle_deg : array_like
        Settings that the test stand can run: loads [N] (by default half, once and twice those of
        the tests), slip ratios [-], slip angles [°].

    Returns
    -------
    Calibration

    Raises
    ------
    ParameterError
        For keys that are not numbers of the soil, or that these measurements cannot determine.
    DocumentError, DocumentNotFoundError
        As `validate`.
    CalibrationError
        If no start gives finite predictions.

    Examples
    --------
    >>> import grouser as gr
    >>> test = gr.wheel_test(load_n=20, slip_ratio=[0.0, 0.2, 0.4, 0.6], trials=3).to_pandas()
    >>> start = gr.Soil("toyoura", shear={"longitudinal_m": 0.1})
    >>> found = gr.calibrate(test, start, "hakuto", fit="shear.longitudinal_m", point_fit=True)
    >>> found.outcome, bool(abs(found.fit[0] - 0.036) < 4 * found.fit_std[0])
    ('determined', True)
    """
    if wheel_label is None and isinstance(wheel, (str, os.PathLike)):
        wheel_label = os.fspath(wheel)
    wheel = wheel if isinstance(wheel, Wheel) else Wheel(wheel)
    loads = None if candidate_load_n is None else line("candidate_load_n", candidate_load_n)
    if not isinstance(target, str):
        raise ParameterError(
            f"target is of type {type(target).__name__}, it must be text", "target"
        )
    aim = (
        target,
        whole_number("propose", propose, most=1000),
        None if loads is None else loads.tolist(),
        line("candidate_slip_ratio", candidate_slip_ratio).tolist(),
        line("candidate_slip_angle_deg", candidate_slip_angle_deg).tolist(),
    )
    found = _core.calibrate_wheel_tests(
        rows_of(data),
        soil_of(soil)._document,
        wheel._document,
        setting(gravity_m_s2, model)._document,
        wheel_label,
        [where] if isinstance(where, str) else list(where),
        _keys(fit),
        aim,
        whole_number("seed", seed),
        None if point_fit else whole_number("steps", steps),
        bool(cross_validate),
    )
    return Calibration(
        **_common(found),
        validation=validation_of(found["validation"]),
        cross_validation=tuple(found["cross_validation"]),
        cross_validation_overall=found["cross_validation_overall"],
        target=found["target"],
        proposals=found["proposals"],
    )


def calibrate_plates(
    data: Data,
    soil: Soil | Source,
    *,
    shear: Data | None = None,
    plate_law: str | None = None,
    gravity_m_s2: float = _core.EARTH_GRAVITY,
    point_fit: bool = False,
    steps: int = 400,
    seed: int = 1,
) -> Calibration:
    """Fits the moduli of a pressure-sinkage law to plate tests, and cohesion, friction angle and
    shear modulus to shear tests beside them. Results equal the program's, bit for bit.

    Parameters
    ----------
    data : str, path or table
        A CSV file, a set that comes with the program (``grc-1-plates``), or a table as for `validate`, with
        ``plate_width_mm``, ``plate_diameter_mm`` or ``plate_radius_mm``, and ``sinkage_mm``, ``pressure_kpa``;
        ``repeat`` tells curves of one plate apart.
    soil : Soil, name, path or mapping
        The soil, for all other values.
    shear : str, path or table, optional
        Shear tests of the same soil, as for `calibrate_shear`.
    plate_law : {"bekker", "reece"}, optional
        The law; by default the soil's own.
    gravity_m_s2 : float
        Gravity [m/s²].
    point_fit, steps, seed
        As for `calibrate`.

    Returns
    -------
    Calibration

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError, CalibrationError
        As `calibrate`.

    Examples
    --------
    Two plates were pressed into sand, with three readings each:

    >>> import grouser as gr
    >>> test = {
    ...     "plate_width_mm": [100.0, 100.0, 100.0, 200.0, 200.0, 200.0],
    ...     "sinkage_mm": [5.0, 10.0, 20.0, 5.0, 10.0, 20.0],
    ...     "pressure_kpa": [3.0, 9.0, 30.0, 2.9, 8.9, 29.0],
    ... }
    >>> found = gr.calibrate_plates(test, "toyoura", plate_law="bekker", point_fit=True)
    >>> list(found.best)
    ['soil.pressure_sinkage.k_c', 'soil.pressure_sinkage.k_phi', 'soil.pressure_sinkage.n']
    >>> found.soil.pressure_sinkage["n"] == found.best["soil.pressure_sinkage.n"]
    True
    """
    if not isinstance(plate_law, (str, type(None))):
        given = type(plate_law).__name__
        raise ParameterError(f"plate_law is of type {given}, it must be a name", "plate_law")
    found = _core.calibrate_bevameter(
        rows_of(data),
        None if shear is None else rows_of(shear),
        soil_of(soil)._document,
        setting(gravity_m_s2, None)._document,
        plate_law,
        whole_number("seed", seed),
        None if point_fit else whole_number("steps", steps),
    )
    return Calibration(
        **_common(found), curves=found["curves"], shear_curves=found.get("shear_curves")
    )


def calibrate_shear(
    data: Data,
    soil: Soil | Source,
    *,
    point_fit: bool = False,
    steps: int = 400,
    seed: int = 1,
) -> Calibration:
    """Fits cohesion, friction angle and shear modulus to shear tests under several normal
    stresses. Results equal the program's, bit for bit.

    Parameters
    ----------
    data : str, path or table
        A CSV file, a set that comes with the program (``cullinan-shear``), or a table as for `validate`, with
        ``shear_displacement_mm``, ``shear_stress_kpa`` and ``normal_stress_kpa``; ``repeat`` tells tests under
        one normal stress apart.
    soil : Soil, name, path or mapping
        The soil, for all other values.
    point_fit, steps, seed
        As for `calibrate`.

    Returns
    -------
    Calibration

    Raises
    ------
    ParameterError, DocumentError, DocumentNotFoundError, CalibrationError
        As `calibrate`.

    Examples
    --------
    A sand without cohesion was sheared under two normal stresses:

    >>> import grouser as gr
    >>> test = {
    ...     "normal_stress_kpa": [10.0, 10.0, 10.0, 20.0, 20.0, 20.0],
    ...     "shear_displacement_mm": [5.0, 10.0, 40.0, 5.0, 10.0, 40.0],
    ...     "shear_stress_kpa": [2.3, 3.7, 5.7, 4.5, 7.3, 11.3],
    ... }
    >>> found = gr.calibrate_shear(test, "toyoura", point_fit=True)
    >>> f"{found.best['soil.friction_angle_deg']:.0f}"
    '30'
    """
    found = _core.calibrate_bevameter(
        None,
        rows_of(data),
        soil_of(soil)._document,
        setting(_core.EARTH_GRAVITY, None)._document,
        None,
        whole_number("seed", seed),
        None if point_fit else whole_number("steps", steps),
    )
    return Calibration(**_common(found), shear_curves=found["shear_curves"])


def _common(found: dict[str, Any]) -> dict[str, Any]:
    """The fields that every calibration has."""
    parameters = found["parameters"]
    reasons = [*found["notes"], *found["unidentifiable"]]
    is_determined = found["outcome"] == "determined"
    names = (
        "samples",
        "correlations",
        "discrepancies",
        "correlation_lengths",
        "searches",
        "searches_that_agree",
    )
    soil = Soil.__new__(Soil)
    soil._take(found["soil"])
    return {
        "key": tuple(parameters["key"]),
        **{name: parameters[name] for name in _PARAMETERS},
        **{name: found[name] for name in names},
        "outcome": found["outcome"],
        "message": None if is_determined else "; ".join(reasons),
        "unidentifiable": tuple(found["unidentifiable"]),
        "notes": tuple(found["notes"]),
        "sampler": found["sampler"],
        "soil": soil,
    }


def _keys(fit: Any) -> list[tuple[str, tuple[float, float] | None]]:
    """Keys with their bounds; a key may start with ``soil.``."""
    if isinstance(fit, str):
        fit = [fit]
    if isinstance(fit, Mapping):
        pairs: list[tuple[Any, Any]] = list(fit.items())
    elif isinstance(fit, Iterable):
        pairs = [(key, None) for key in fit]
    else:
        given = type(fit).__name__
        raise ParameterError(f"fit is of type {given}, it must be names of keys", "fit")
    return [(_name(key), _bounds(key, bounds)) for key, bounds in pairs]


def _name(key: Any) -> str:
    if not isinstance(key, str):
        raise ParameterError(f"fit has a key of type {type(key).__name__}, it must be text", "fit")
    return key.removeprefix("soil.")


def _bounds(key: str, bounds: Any) -> tuple[float, float] | None:
    if bounds is None:
        return None
    try:
        lower, upper = bounds
    except (TypeError, ValueError):
        raise ParameterError(f"the bounds of {key} must be two numbers", "fit") from None
    return number(f"lower bound of {key}", lower), number(f"upper bound of {key}", upper)
