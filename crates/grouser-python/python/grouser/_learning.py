"""Learning the soil from the telemetry of a drive."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._arrays import line, whole_number
from ._card import Card
from ._card import card as _card
from ._descriptions import Rover, Scenario, Soil, Source
from ._errors import ParameterError
from ._studies import scenario_of
from ._telemetry import Files, budget_of, files_of

if TYPE_CHECKING:
    import pandas
    import xarray

#: Telemetry: columns by name, a record by name, records, a table of pandas, or a dataset of xarray.
Telemetry = Union[
    "Mapping[str, Any]", "Iterable[Mapping[str, Any]]", "pandas.DataFrame", "xarray.Dataset"
]

#: The dimension over which a dataset has the rover's wheels.
_WHEEL = "wheel"


class Learner:
    """Learns the soil from the telemetry of a drive, record by record, and predicts heading and
    slip of the slopes that come next, with 95 % bands. The numbers are those of the program's
    ``grouser learn``, bit for bit, however many records are given at once.

    Parameters
    ----------
    scenario : Scenario, name, path or mapping, optional
        Its rover, soil, gravity, model and load transfer are used; its drive and start are not.
        Without it the default scenario.
    prior : Soil, name, path or mapping, optional
        What is known of the soil before the drive, in place of the scenario's soil: one that says
        how uncertain it is, such as ``"toyoura-uncertain"``, or one that was learnt before.
    rover : Rover, name, path or mapping, optional
        The rover, in place of the scenario's.
    slope_deg : float, optional
        Slope of the ground where the telemetry has neither roll nor pitch [°].
    **changes
        Keys of the scenario with other values: ``gravity_m_s2``, ``model``, …

    Raises
    ------
    ParameterError
        If all numbers of the soil are taken as exact, so that there is nothing to learn.

    Examples
    --------
    >>> import grouser as gr
    >>> learner = gr.Learner(prior="toyoura-uncertain", rover="hakuto", model="ishigami")
    >>> rim = {f"wheel_speed_rad_s_{wheel}": 0.55 for wheel in learner.wheel_names}
    >>> records = [{"time_s": 0.5 * k, "roll_deg": 8.0, "pitch_deg": 0.4, "vo_dx_m": 0.0125, **rim}
    ...            for k in range(30)]
    >>> taught = [lesson for lesson in learner.stream(records)]
    >>> len(taught) == learner.learnt["stretches"], learner.warnings
    (True, [])
    >>> found = learner.predict([5.0], samples=10)
    >>> bool(found["yaw_deg_p2_5"][0] < found["yaw_deg_p97_5"][0])
    True
    """

    _native: _core.Learner

    def __init__(
        self,
        scenario: Scenario | Source | None = None,
        /,
        *,
        prior: Soil | Source | None = None,
        rover: Rover | Source | None = None,
        slope_deg: float | None = None,
        **changes: Any,
    ) -> None:
        given = {"soil": prior, "rover": rover, "slope_deg": slope_deg}
        changes.update({name: value for name, value in given.items() if value is not None})
        scenario = scenario_of(scenario, changes)
        self._native = _core.Learner(scenario._document, slope_deg is not None)

    @classmethod
    def _of(cls, native: _core.Learner) -> Learner:
        learner = cls.__new__(cls)
        learner._native = native
        return learner

    def __getstate__(self) -> dict[str, Any]:
        return {"scenario": self.scenario, "state": self._native.state()}

    def __setstate__(self, kept: dict[str, Any]) -> None:
        self._native = _core.Learner.from_state(kept["state"], kept["scenario"]._document)

    @property
    def scenario(self) -> Scenario:
        """The scenario that it began with."""
        return _scenario(self._native.scenario())

    @property
    def wheel_names(self) -> tuple[str, ...]:
        """The wheels, by whose names telemetry has its columns."""
        return tuple(self._native.wheel_names)

    def update(
        self, telemetry: Telemetry, *, odometry: str | None = None
    ) -> list[dict[str, Any]]:
        """Takes telemetry that comes after what it has, and learns from it.

        Parameters
        ----------
        telemetry : mapping, iterable of mappings, pandas.DataFrame or xarray.Dataset
            Columns by their names, as the program's logs have them: ``time_s`` and any of
            ``roll_deg``, ``vo_dx_m``, ``wheel_torque_nm_front-left``, …; a mapping of single
            numbers is one record. NaN is a gap. A dataset may have its wheels over a dimension
            ``wheel``. Records that do not come after the last one are left out.
        odometry : str, optional
            What measured ways and rotations, in place of what the names of the columns say:
            ``"visual"``, ``"wheels"`` (which show no slip, and are left out), ``"fused"`` with
            wheels, or ``"motion-capture"``.

        Returns
        -------
        list of dict
            What each stretch of the way taught that was completed: the columns of the program's
            ``lessons.csv``, and ``warnings``, of which each has the columns of ``warnings.csv``.
        """
        columns = _columns(telemetry)
        return _lessons(self._native.update(list(columns), list(columns.values()), odometry))

    def update_log(
        self,
        log: Files,
        *,
        odometry: str | None = None,
        max_unpacked_mib: int | None = None,
    ) -> list[dict[str, Any]]:
        """Takes the records of a log that come after what it has; returns as `update`.

        Parameters
        ----------
        log : str or path, or a list of them
            The log: CSV, Parquet, Arrow or MCAP; files of one drive in any order, or a folder of
            MCAP files.
        odometry : str, optional
            What measured ways and rotations, in place of what a mapping says: ``"visual"``,
            ``"wheels"`` (which show no slip, and are left out), ``"fused"`` with wheels, or
            ``"motion-capture"``.
        max_unpacked_mib : int, optional
            The most that is unpacked of a packed log [MiB], in place of 256 and 64 for each of its
            own.
        """
        budget = budget_of(max_unpacked_mib)
        return _lessons(self._native.update_log(files_of(log) or [], odometry, budget))

    def stream(self, records: Iterable[Telemetry]) -> Iterator[dict[str, Any]]:
        """Takes record after record, and gives each lesson as soon as it is learnt.

        Parameters
        ----------
        records : iterable
            Records, or larger parts of the telemetry, each as of `update`.
        """
        for record in records:
            yield from self.update(record)

    def finished(self) -> Learner:
        """A copy in which the drive is over: the records that are too few for a stretch of their
        own count, too."""
        return self._of(self._native.finished())

    def predict(
        self, slope_deg: ArrayLike = (5.0, 10.0, 15.0), *, samples: int = 200, seed: int = 1
    ) -> xarray.Dataset:
        """The heading that holds the contour, and the slip there, over ``slope_deg``: medians and
        95 % bands, with those before the drive beside them.

        Parameters
        ----------
        slope_deg : array_like
            Slopes [°], 0 to 60.
        samples : int
            Number of samples, 2 to 100000.
        seed : int
            Seed of the samples.

        Returns
        -------
        xarray.Dataset
            The columns of the program's ``predictions.csv``: ``yaw_deg``, ``yaw_deg_p2_5``,
            ``yaw_deg_p97_5``, ``slip_ratio``, …, ``before_yaw_deg_p2_5``, …
        """
        count, seed = _count(samples), whole_number("seed", seed)
        found = self._native.predict(line("slope_deg", slope_deg), count, seed)
        slopes = found.pop("slope_deg")
        notes = {"samples": count, "seed": seed, "version": _core.__version__}
        return _tables.dataset(("slope_deg",), found, {"slope_deg": slopes}, notes)

    @property
    def lessons(self) -> dict[str, NDArray[Any]]:
        """What stretches taught: the columns of the program's ``lessons.csv``. Of a long drive
        every n-th."""
        lessons, _ = self._native.taught()
        return _tables.arrays_of(lessons)

    @property
    def warnings(self) -> list[dict[str, Any]]:
        """What there is to warn of: each with the columns of the program's ``warnings.csv``."""
        _, warnings = self._native.taught()
        return _rows(warnings)

    @property
    def learnt(self) -> dict[str, Any]:
        """How much was learnt from: ``records``, ``stretches``, ``way_m``, ``outliers``,
        ``stretches_not_used``."""
        return self._native.learnt()

    @property
    def models(self) -> dict[str, float]:
        """The wheel–soil models with their shares [-]."""
        return self._native.models()

    @property
    def files(self) -> tuple[dict[str, Any], ...]:
        """What logs, and files that documents name, gave: ``file``, ``content``, ``counted``,
        ``there`` and ``used``, as ``inputs.files`` of the program's answers has them."""
        return tuple(json.loads(self._native.files()))

    @property
    def notes(self) -> tuple[str, ...]:
        """What was left out of the telemetry, and why stretches taught nothing."""
        return tuple(self._native.notes())

    def narrowed(self, *, samples: int = 200, seed: int = 1) -> dict[str, float]:
        """What is left of the uncertainty of each of the soil's keys [-]: 1 where nothing was
        learnt.

        Parameters
        ----------
        samples, seed : int
            How many samples, and their seed.
        """
        return self._native.narrowed(_count(samples), whole_number("seed", seed))

    def soil(self, *, samples: int = 200, seed: int = 1, name: str = "telemetry") -> Soil:
        """The soil as it is known now, with samples: for `heading`, `card`, and as the ``prior`` of
        the next day.

        Parameters
        ----------
        samples, seed : int
            How many samples, and their seed.
        name : str
            What the drive is called in the soil's source.
        """
        soil = Soil.__new__(Soil)
        soil._take(self._native.soil(name, _count(samples), whole_number("seed", seed)))
        return soil

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        samples: int = 200,
        seed: int = 1,
        name: str = "telemetry",
    ) -> None:
        """Writes that soil as a document, with the file of its samples beside it.

        Parameters
        ----------
        path : str or path
            The document, such as ``soil.toml``.
        samples, seed : int
            How many samples, and their seed.
        name : str
            What the drive is called in the soil's source.
        """
        soil = self.soil(samples=samples, seed=seed, name=name)
        target = Path(path)
        for file, content in soil.files.items():
            _write(target.with_name(file), str(content))
        _write(target, soil.to_toml())

    def card(self, *, before: bool = False, samples: int = 200, seed: int = 1, **settings: Any) -> Card:
        """The operator's card by what is known now.

        Parameters
        ----------
        before : bool
            The card of the soil before the drive, to set beside it.
        samples, seed : int
            How many samples, and their seed.
        **settings
            As of `grouser.card`: ``slope_deg``, ``uphill``, …
        """
        scenario = self.scenario
        if not before:
            made = self._native.scenario_now("telemetry", _count(samples), whole_number("seed", seed))
            scenario = _scenario(made)
        card: Card = _card(scenario, samples=samples, seed=seed, **settings)
        return card

    def to_arviz(self, *, samples: int = 1000, seed: int = 1) -> Any:
        """Samples of the soil's keys for ArviZ, a variable for each, before the drive (the group
        ``prior``) and now (``posterior``): one chain, whose samples do not depend on each other.

        Parameters
        ----------
        samples, seed : int
            How many samples, and their seed.

        Returns
        -------
        arviz.InferenceData
            From ArviZ 1.0 on an ``xarray.DataTree``.

        Raises
        ------
        ImportError
            Without ArviZ.
        """
        try:
            import arviz
        except ImportError as error:
            raise ImportError("to_arviz needs ArviZ: pip install arviz", name="arviz") from error
        count, seed = _count(samples), whole_number("seed", seed)
        groups: dict[str, Any] = {}
        for group, is_before in (("posterior", False), ("prior", True)):
            keys, values = self._native.samples(count, seed, is_before)
            groups[group] = {f"soil.{key}": values[None, :, k] for k, key in enumerate(keys)}
        if int(arviz.__version__.split(".")[0]) < 1:
            return arviz.from_dict(**groups)
        return arviz.from_dict(groups)

    def save_state(self, path: str | os.PathLike[str]) -> None:
        """Writes its state, from which `load_state` goes on with the same bits; the file that is
        there stays until the new one is whole.

        Parameters
        ----------
        path : str or path
            The file.
        """
        _write(Path(path), self._native.state())

    @classmethod
    def load_state(
        cls, path: str | os.PathLike[str], scenario: Scenario | None = None
    ) -> Learner:
        """A learner that goes on from a state, the program's (``learn-state.json``) or that of
        `save_state`.

        Parameters
        ----------
        path : str or path
            The file.
        scenario : Scenario, optional
            The scenario that the state has to belong to. Without it the state's own.

        Raises
        ------
        ParameterError
            For a state that is damaged, of another version, or of another scenario.
        """
        # What is no text is damaged, as its check sum tells.
        text = Path(path).read_text(encoding="utf-8", errors="replace")
        document = None if scenario is None else scenario._document
        return cls._of(_core.Learner.from_state(text, document))

    def __repr__(self) -> str:
        learnt = self.learnt
        return f"<Learner: {learnt['stretches']} stretches, {learnt['way_m']:.1f} m>"


def learn(
    log: Files | Telemetry,
    scenario: Scenario | Source | None = None,
    /,
    *,
    prior: Soil | Source | None = None,
    rover: Rover | Source | None = None,
    slope_deg: float | None = None,
    odometry: str | None = None,
    max_unpacked_mib: int | None = None,
    **changes: Any,
) -> Learner:
    """Learns from a whole drive, as the program's ``grouser learn`` does.

    Parameters
    ----------
    log : path, list of paths, or telemetry as of `Learner.update`
        The drive; several files as of `Learner.update_log`.
    scenario, prior, rover, slope_deg, **changes
        As of `Learner`.
    odometry : str, optional
        What measured ways and rotations, in place of what a mapping says: ``"visual"``,
        ``"wheels"`` (which show no slip, and are left out), ``"fused"`` with wheels, or
        ``"motion-capture"``.
    max_unpacked_mib : int, optional
        The most that is unpacked of a packed log [MiB], in place of 256 and 64 for each of its own.

    Returns
    -------
    Learner
        What was learnt; the drive is over.

    Examples
    --------
    >>> import grouser as gr
    >>> run = gr.simulate(rover="hakuto", soil="toyoura", slope_deg=8.0, duration_s=20.0,
    ...                   start={"yaw_deg": 4.0}, simulation="quasi-steady")
    >>> found = gr.learn(run.to_xarray(), prior="toyoura-uncertain", rover="hakuto", slope_deg=8.0,
    ...                  model="ishigami")
    >>> found.learnt["stretches"] > 2, found.narrowed(samples=50)["shear.lateral_m"] < 1.0
    (True, True)
    """
    learner = Learner(scenario, prior=prior, rover=rover, slope_deg=slope_deg, **changes)
    if files_of(log) is not None:
        learner.update_log(cast(Any, log), odometry=odometry, max_unpacked_mib=max_unpacked_mib)
    else:
        learner.update(cast(Any, log), odometry=odometry)
    return learner.finished()


def _count(samples: Any) -> int:
    count = whole_number("samples", samples, most=100_000)
    if count < 2:
        raise ParameterError(f"samples is {count}, it must be from 2 to 100000", "samples")
    return count


def _scenario(document: _core.Document) -> Scenario:
    scenario = Scenario.__new__(Scenario)
    scenario._take(document)
    return scenario


def _rows(table: Mapping[str, Any]) -> list[dict[str, Any]]:
    """A table as a dictionary for each row."""
    columns = {
        name: values.tolist() if isinstance(values, np.ndarray) else list(values)
        for name, values in table.items()
    }
    count = max((len(values) for values in columns.values()), default=0)
    return [{name: values[row] for name, values in columns.items()} for row in range(count)]


def _lessons(taught: tuple[dict[str, Any], dict[str, Any]]) -> list[dict[str, Any]]:
    """Lessons, each with its warnings: those of its time."""
    lessons, warnings = (_rows(table) for table in taught)
    for lesson in lessons:
        lesson["warnings"] = [it for it in warnings if it["time_s"] == lesson["time_s"]]
    return lessons


def _columns(telemetry: Any) -> dict[str, NDArray[np.float64]]:
    """Telemetry as columns of one length."""
    if type(telemetry).__module__.split(".")[0] == "xarray":
        pairs = _of_dataset(telemetry)
    elif hasattr(telemetry, "columns") and hasattr(telemetry, "index"):
        table = telemetry.reset_index() if telemetry.index.name else telemetry
        pairs = [(str(name), table[name]) for name in table.columns]
    elif isinstance(telemetry, Mapping):
        pairs = [(str(name), values) for name, values in telemetry.items()]
    else:
        records = list(telemetry)
        names = dict.fromkeys(name for record in records for name in record)
        pairs = [(str(name), [record.get(name) for record in records]) for name in names]
    columns = {name: values for name, it in pairs if (values := _numbers(it)) is not None}
    lengths = {name: len(values) for name, values in columns.items()}
    if len(set(lengths.values())) > 1:
        raise ParameterError(f"the columns of telemetry have different lengths: {lengths}", "telemetry")
    return columns


def _of_dataset(data: Any) -> list[tuple[str, Any]]:
    """The columns of a dataset: of wheels one for each."""
    pairs: list[tuple[str, Any]] = []
    for name, values in data.variables.items():
        if _WHEEL in values.dims and values.ndim == 2:
            wheels = data.coords[_WHEEL].values
            array = values.transpose(..., _WHEEL).values
            pairs += [(f"{name}_{wheel}", array[:, k]) for k, wheel in enumerate(wheels)]
        elif values.ndim <= 1 and values.dims != (_WHEEL,):
            pairs.append((str(name), values.values))
    return pairs


def _numbers(values: Any) -> NDArray[np.float64] | None:
    """A column of numbers, of which a single one is a record; nothing of a column of texts."""
    try:
        array = np.array(values, dtype=np.float64)
    except (TypeError, ValueError):
        return None
    return np.ascontiguousarray(np.atleast_1d(array)) if array.ndim <= 1 else None


def _write(target: Path, text: str) -> None:
    """Writes beside and renames."""
    handle, name = tempfile.mkstemp(dir=target.parent, prefix=".grouser-")
    try:
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(name, target)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
