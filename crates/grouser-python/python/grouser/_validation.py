"""Errors of wheel–soil models against measured wheel tests, and rovers measured on slopes and over
drives."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core, _tables
from ._descriptions import Rover, Soil, Source, Wheel
from ._measurements import Data, rows_of
from ._studies import scenario_of
from ._telemetry import budget_of
from ._wheels import setting

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes


def _with_diagonal(axes: Axes, measured: Any, predicted: Any, name: str) -> Axes:
    """Adds the line on which predictions are what was measured, and labels."""
    low, high = np.nanmin([measured, predicted]), np.nanmax([measured, predicted])
    axes.plot([low, high], [low, high], color="grey", lw=0.8)
    axes.set_xlabel(f"measured {_tables.label(name)}")
    axes.set_ylabel(f"predicted {_tables.label(name)}")
    return axes


@dataclass(frozen=True, eq=False)
class Validation(_tables.Tabular):
    """Errors of a wheel–soil model against measurements, with the names of ``grouser validate``.

    A group of cells is a mapping: ``slip_angle_deg``, ``motion``, ``cells``, ``trials``,
    ``unsettled_trials``, and for each of ``drawbar_pull_n``, ``side_force_n``, ``sinkage_mm`` and
    ``torque_nm`` its ``rmse``, ``bias`` (prediction minus measurement), ``r2``, ``repeatability``,
    ``cells``, ``largest_measured``, ``rmse_share`` and ``bias_share`` of that, ``aim`` and
    ``within_aim``, or None where it was not measured.

    Made by `validate`, which has an example.
    """

    overall: Mapping[str, Any]
    """All cells."""
    driven: Mapping[str, Any] | Any
    """The driven cells; None if there are none."""
    skid: Mapping[str, Any] | Any
    """The skidding cells; None if there are none."""
    groups: tuple[Mapping[str, Any], ...]
    """The cells of each slip angle, driven and skidding."""
    yardsticks: tuple[Mapping[str, Any], ...]
    """Errors of predictions without physics: ``yardstick`` (``mean``, ``interpolation`` or
    ``angle-left-out``), and the groups ``driven`` and ``overall``."""
    cells: Mapping[str, Any]
    """Columns over cells: repeated trials under one condition, measured means and predictions."""
    trials: Mapping[str, Any]
    """Columns over trials, in the order of the file."""
    notes: tuple[str, ...]
    """Remarks on the file."""

    @property
    def flags(self) -> Any:
        """Why each cell is an extrapolation: names of `FLAGS`, joined by ``;``."""
        return self.cells["flags"]

    def _table(self) -> Mapping[str, Any]:
        return self.trials

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each trial."""
        return _tables.frame(self._table())

    def plot(self, axes: Axes | None = None, *, name: str = "drawbar_pull_n", **style: Any) -> Axes:
        """Plots predictions of a quantity over its measurements, a dot for each cell.

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
        measured, predicted = self.cells[f"measured_{name}"], self.cells[name]
        axes.plot(measured, predicted, **{"ls": "", "marker": ".", **style})
        return _with_diagonal(axes, measured, predicted, name)

    def __repr__(self) -> str:
        return f"<Validation of {self.overall['trials']} trials in {self.overall['cells']} cells>"


def validate(
    data: Data,
    soil: Soil | Source,
    wheel: Wheel | Source,
    *,
    where: Sequence[str] | str = (),
    wheel_label: str | None = None,
    gravity_m_s2: float = _core.EARTH_GRAVITY,
    model: str | None = None,
) -> Validation:
    """Compares a wheel–soil model with measured wheel tests, from a file or a table.

    Parameters
    ----------
    data : str, path or table
        A data set that comes with Grouser, such as ``"cmu-single-wheel"``; a CSV file in the layout
        of ``docs/guide/data.md``; or a table with the same columns: a DataFrame of pandas or
        polars, a table of Arrow, or a mapping of columns. NaN and None are missing cells. Messages
        count the lines of a table as those of a file: line 1 is the header.
    soil, wheel, gravity_m_s2, model
        As for `settle`; one soil.
    where : sequence of str
        Which rows to use: ``column=value,value`` or ``column!=value``; all conditions must be met.
    wheel_label : str, optional
        The wheel whose rows to use, in a file with several; by default the name or path of
        ``wheel``.

    Returns
    -------
    Validation

    Raises
    ------
    DocumentError
        For a file that cannot be used, with its line.
    DocumentNotFoundError, ParameterError
        As `settle`, and for a file that is not there.

    Examples
    --------
    >>> import grouser as gr
    >>> found = gr.validate("published-wheel-tests", "hit-lss1-2011", "ding-2011-smooth")
    >>> pull = found.overall["drawbar_pull_n"]
    >>> found.overall["trials"], pull["rmse"] < pull["aim"]
    (6, True)
    """
    if wheel_label is None and isinstance(wheel, (str, os.PathLike)):
        wheel_label = os.fspath(wheel)
    soil = soil if isinstance(soil, Soil) else Soil(soil)
    wheel = wheel if isinstance(wheel, Wheel) else Wheel(wheel)
    stand = setting(gravity_m_s2, model)
    conditions = [where] if isinstance(where, str) else list(where)
    documents = (soil._document, wheel._document, stand._document)
    found = _core.validate(rows_of(data), *documents, wheel_label, conditions)
    return validation_of(found)


def validation_of(found: dict[str, Any]) -> Validation:
    """The result of the native half."""
    for name in ("groups", "yardsticks", "notes"):
        found[name] = tuple(found[name])
    return Validation(**found)


@dataclass(frozen=True, eq=False)
class SlopeValidation(_tables.Tabular):
    """Errors of a wheel–soil model against a rover's measured slip or yaw on slopes, with the names
    of ``grouser validate --rover``.

    Made by `validate_slopes`, which has an example.
    """

    overall: Mapping[str, Any]
    """``cells`` (slopes), ``not_held`` (those on which no heading holds the course),
    ``no_prediction`` (those on which something was measured that the model does not predict: they
    are in no error), and the errors of ``slip_ratio`` and ``yaw_deg`` as in a `Validation`, or None
    where it was not measured."""
    yardsticks: tuple[Mapping[str, Any], ...]
    """Errors of predictions without physics: ``yardstick`` and ``overall``."""
    slopes: Mapping[str, Any]
    """Columns over slopes: ``slope_deg``, ``course_deg``, ``measured_slip_ratio``, ``slip_ratio``,
    ``measured_yaw_deg``, ``yaw_deg``, ``status`` and others. Where no heading holds a course along
    or up the slope, the slip ratio is 1."""
    notes: tuple[str, ...]
    """Remarks on the file."""

    def _table(self) -> Mapping[str, Any]:
        return self.slopes

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each slope."""
        return _tables.frame(self._table())

    def plot(self, axes: Axes | None = None, *, name: str = "slip_ratio", **style: Any) -> Axes:
        """Plots a quantity over the slope: measured as dots, predicted as a line.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        name : str
            The quantity, ``slip_ratio`` or ``yaw_deg``.
        **style
            Arguments of the drawing functions of matplotlib.
        """
        axes = _tables.axes_or_new(axes)
        slope = self.slopes["slope_deg"]
        axes.plot(slope, self.slopes[name], **style)
        axes.plot(slope, self.slopes[f"measured_{name}"], ls="", marker="o")
        axes.set_xlabel(_tables.label("slope_deg"))
        axes.set_ylabel(_tables.label(name))
        return axes

    def __repr__(self) -> str:
        return f"<SlopeValidation on {self.overall['cells']} slopes>"


def validate_slopes(
    data: Data,
    soil: Soil | Source,
    rover: Rover | Source,
    *,
    where: Sequence[str] | str = (),
    **changes: Any,
) -> SlopeValidation:
    """Compares a wheel–soil model with a rover's measured slip or yaw on slopes.

    Parameters
    ----------
    data : str, path or table
        A data set that comes with Grouser, such as ``"viper-slip-slope"``, a CSV file in the layout
        of ``docs/guide/data.md``, or a table with the same columns, as for `validate`.
    soil, rover
        The soil, and the rover that was driven.
    where : sequence of str
        As for `validate`.
    **changes
        Keys of the scenario with other values, such as ``model`` or ``gravity_m_s2``.

    Returns
    -------
    SlopeValidation

    Raises
    ------
    DocumentError
        For a file that cannot be used, with its line.
    DocumentNotFoundError, ParameterError
        As `heading`, and for a file that is not there.

    Examples
    --------
    >>> import grouser as gr
    >>> soil = "grc-1-second-hand"                                  # of the simulated climbs
    >>> found = gr.validate_slopes("viper-slip-slope", soil, "mgru3", gravity_m_s2=gr.MOON_GRAVITY)
    >>> slip = found.overall["slip_ratio"]
    >>> found.overall["cells"], slip["rmse"] < 0.15                 # slopes to 25°
    (7, True)
    """
    scenario = scenario_of(None, {"soil": soil, "rover": rover, **changes})
    conditions = [where] if isinstance(where, str) else list(where)
    found = _core.validate_slopes(rows_of(data), scenario._document, conditions)
    found["yardsticks"], found["notes"] = tuple(found["yardsticks"]), tuple(found["notes"])
    return SlopeValidation(**found)


@dataclass(frozen=True, eq=False)
class DriveValidation(_tables.Tabular):
    """Every wheel–soil model beside recorded drives, with the names of ``grouser validate
    --drives``.

    Made by `validate_drives`, which has an example.
    """

    judged_on: str
    """The set on which models are ranked: ``test``, or ``training`` where the hash puts no drive
    into the test set."""
    sentences: tuple[str, ...]
    """What was found."""
    rows: Mapping[str, Any]
    """Columns over predictions, sets and quantities: ``rank`` (of models), ``prediction``,
    ``split``, ``score`` (0 is perfect), ``quantity``, ``quantity_score``, ``rmse``, ``bias``,
    ``repeatability`` (the standard deviation between drives that repeat each other) and others."""
    cells: Mapping[str, Any]
    """Columns over models and cells, which are stretches of like conditions: ``model``, ``split``,
    ``slope_deg``, ``yaw_deg``, ``turn_radius_m``, ``rim_speed_m_s``, ``trials``, and for each of
    ``slip_ratio``, ``drift_m_per_m``, ``yaw_rate_deg_s`` and ``power_w`` what was measured
    (``measured_…``) and what the model predicts."""
    drives: Mapping[str, Any]
    """Columns over drives: ``drive``, ``split`` and others."""
    compared_stretches: int
    """How many stretches were compared."""
    notes: tuple[str, ...]
    """Remarks on the logs, and what was not compared."""
    files: tuple[Mapping[str, Any], ...]
    """What each log gave: ``file``, ``content``, and how many rows were ``there`` and ``used``."""

    @property
    def models(self) -> tuple[str, ...]:
        """The models by their rank on the set that they are judged on."""
        rank = np.asarray(self.rows["rank"], dtype=float)
        judged = np.asarray(self.rows["split"]) == self.judged_on
        ranked = {r: name for r, name, on in zip(rank, self.rows["prediction"], judged) if on}
        return tuple(str(ranked[r]) for r in sorted(ranked) if np.isfinite(r))

    def _table(self) -> Mapping[str, Any]:
        return self.cells

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each cell with each model."""
        return _tables.frame(self._table())

    def plot(self, axes: Axes | None = None, *, name: str = "slip_ratio", **style: Any) -> Axes:
        """Plots what each model predicts over what was measured, a dot for each cell.

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
        measured, predicted = self.cells[f"measured_{name}"], self.cells[name]
        for model in self.models:
            own = np.asarray(self.cells["model"]) == model
            named = {"ls": "", "marker": ".", "label": model, **style}
            axes.plot(measured[own], predicted[own], **named)
        return _with_diagonal(axes, measured, predicted, name)

    def __repr__(self) -> str:
        count = len(self.drives["drive"])
        return f"<DriveValidation of {count} drives, {self.compared_stretches} stretches>"


def validate_drives(
    folder: str | os.PathLike[str],
    soil: Soil | Source,
    rover: Rover | Source,
    *,
    mapping: str | os.PathLike[str] | None = None,
    topics: Mapping[str, str] | None = None,
    odometry: str | None = None,
    max_unpacked_mib: int | None = None,
    **changes: Any,
) -> DriveValidation:
    r"""Ranks every wheel–soil model on the recorded drives of a folder, which each predicts from
    wheel speeds, steering angles and attitudes alone. The numbers are those of ``grouser validate
    --drives``; ``docs/guide/data.md`` explains them.

    Parameters
    ----------
    folder : str or path
        A folder with a log of each drive, in folders of any depth: CSV, Parquet, Arrow or MCAP.
    soil, rover
        The soil, of which an uncertain one predicts with its nominal values, and the rover that was
        driven.
    mapping, topics, odometry, max_unpacked_mib
        As for `import_telemetry`; ``"mines"``, ``"enav"`` and ``"baseprod"`` are layouts of public
        data sets.
    **changes
        Keys of the scenario with other values, such as ``gravity_m_s2``, or ``model`` for that one
        alone.

    Returns
    -------
    DriveValidation

    Raises
    ------
    DocumentError
        For a log that cannot be used, where no other can.
    DocumentNotFoundError, ParameterError
        As `heading`, for a folder that is not there or has no log, and for drives without a
        stretch that can be compared.

    Examples
    --------
    >>> import csv, os, tempfile
    >>> import grouser as gr
    >>> folder = tempfile.TemporaryDirectory()
    >>> for slope_deg in (4.0, 8.0, 12.0):                   # the program writes such logs as well
    ...     run = gr.simulate(slope_deg=slope_deg, model="ishigami", duration_s=60.0)
    ...     log = {"time_s": run.time_s, "x_m": run.x_m, "y_m": run.y_m, "yaw_deg": run.yaw_deg}
    ...     log["roll_deg"] = slope_deg + 0.0 * run.time_s    # along the contour
    ...     for k, name in enumerate(run.wheel_names):
    ...         log[f"wheel_speed_rad_s_{name}"] = run.wheel["wheel_speed_rad_s"][:, k]
    ...     with open(os.path.join(folder.name, f"{slope_deg}.csv"), "w", newline="") as file:
    ...         csv.writer(file).writerows([list(log), *zip(*log.values())])
    >>> found = gr.validate_drives(folder.name, "toyoura", "hakuto")
    >>> found.models[0], len(found.drives["drive"])
    ('ishigami', 3)
    >>> folder.cleanup()
    """
    scenario = scenario_of(None, {"soil": soil, "rover": rover, **changes})
    choices = [(str(what), str(topic)) for what, topic in (topics or {}).items()]
    path = None if mapping is None else os.fspath(mapping)
    how = (odometry, budget_of(max_unpacked_mib))
    found, tables, files = _core.validate_drives(
        os.fspath(folder), scenario._document, path, choices, how
    )
    words = {name: tuple(found.pop(name)) for name in ("sentences", "notes")}
    named: dict[str, Any] = {**found, **tables, **words}
    return DriveValidation(**named, files=tuple(json.loads(files)))


@dataclass(frozen=True, eq=False)
class Ranking(_tables.Tabular):
    """Wheel–soil models ranked by their errors, with the names of the program's ranking: a mapping
    for each model with a soil on a part of a data set, best first.

    It has ``data_set``, ``case``, ``rank``, ``model``, ``soil``, ``in_sample`` (whether the soil was
    fitted to these rows), ``score`` (root mean square error over the standard deviation of the
    measurements, averaged over the measured quantities [-]: 0 is perfect, 1 no better than a
    constant), ``unsettled_trials``, and the groups ``driven`` and ``overall`` of a `Validation`, or
    ``overall`` of a `SlopeValidation`.

    Made by `validate_all`, which has an example.
    """

    rows: tuple[Mapping[str, Any], ...]
    """Data set by data set and part by part."""
    yardsticks: tuple[Mapping[str, Any], ...] = ()
    """Predictions without physics on each part, with ``yardstick`` in place of ``model``."""
    models: tuple[Mapping[str, Any], ...] = ()
    """Each model, then each yardstick, over all parts with soils that were not fitted to them:
    ``model`` or ``yardstick``, ``parts``, ``score``, ``aims_met`` of ``aims``, ``scores``."""
    sets: tuple[Mapping[str, Any], ...] = ()
    """Each data set and case: the band of the weighted models beside what was measured."""

    def __len__(self) -> int:
        return len(self.rows)

    def _table(self) -> dict[str, Any]:
        def column(name: str, dtype: type) -> Any:
            return np.array([row[name] for row in self.rows], dtype=dtype)

        def rmse(quantity: str) -> Any:
            errors = (row["overall"][quantity] for row in self.rows)
            return np.array([np.nan if it is None else it["rmse"] for it in errors])

        quantities = ("drawbar_pull_n", "side_force_n", "sinkage_mm", "torque_nm")
        return {
            **{name: column(name, object) for name in ("data_set", "case", "model", "soil")},
            **{name: column(name, int) for name in ("rank", "unsettled_trials")},
            "in_sample": column("in_sample", bool),
            # None is NaN among numbers.
            "score": column("score", float),
            **{f"{quantity}_rmse": rmse(quantity) for quantity in quantities},
        }

    def to_pandas(self) -> pandas.DataFrame:
        """A table with a row for each, and the root mean square errors over all cells as
        ``drawbar_pull_n_rmse`` …"""
        return _tables.frame(self._table())

    def plot(self, axes: Axes | None = None, **style: Any) -> Axes:
        """Plots the scores as bars, the best at the top of each part.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        **style
            Arguments of the drawing functions of matplotlib.
        """
        axes = _tables.axes_or_new(axes)
        rows = self.rows[::-1]
        scores = [np.nan if row["score"] is None else row["score"] for row in rows]
        axes.barh(range(len(rows)), scores, **style)
        names = [f"{row['case']}: {row['model']}, {row['soil']}" for row in rows]
        axes.set_yticks(range(len(rows)), names)
        axes.set_xlabel("score: 0 is perfect, 1 no better than a constant")
        return axes

    def __repr__(self) -> str:
        return f"<Ranking of {len(self)} models with soils>"


def validate_all(folder: str | os.PathLike[str] | None = None) -> Ranking:
    """Ranks every wheel–soil model, with its own soils, on every data set that comes with Grouser,
    or on those of a folder.

    Parameters
    ----------
    folder : str or path, optional
        A folder of your own data sets, used instead of those that come with Grouser;
        ``docs/guide/data.md`` explains how to describe them.

    Returns
    -------
    Ranking

    Raises
    ------
    DocumentNotFoundError
        If the folder does not exist, or has no known data set.
    DocumentError
        For a document or a file of measurements that cannot be used.

    Examples
    --------
    >>> import grouser as gr
    >>> ranking = gr.validate_all().to_pandas()
    >>> best = ranking[ranking["rank"] == 1]                        # of each part of each data set
    >>> better_than_a_constant = best[best["score"] < 1.0]
    >>> 0 < len(better_than_a_constant) <= len(best) < len(ranking)
    True
    """
    place = None if folder is None else os.fspath(folder)
    found = _core.validate_all(place)
    return Ranking(**{name: tuple(all_of_them) for name, all_of_them in found.items()})
