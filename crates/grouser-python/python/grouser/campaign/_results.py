"""The results of a campaign, read from its folder or URL."""

from __future__ import annotations

import copy
import functools
import hashlib
import json
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .. import _core, _tables
from .._errors import CampaignError, ParameterError
from ._files import MANIFEST, RUNS, STUDY, Files, Location, files_of, is_url, need
from ._study import Campaign
from ._summary import Summary, summary_of
from ._worker import file_name

if TYPE_CHECKING:
    import pandas
    import pyarrow


class Results:
    """The finished runs of a campaign: a row for each run, a column for each input and result.

    Nothing is locked, and a campaign may still be running: the results are those that existed when
    this object was made. Everything is checked: the manifest contains a hash of itself and one of
    the study, each shard one of itself, and the digest over all shards of a finished campaign is
    compared with the manifest's. A changed or damaged file raises `grouser.CampaignError` with its
    name; `run` into the same location computes it again.

    The files are an ordinary Parquet data set; DuckDB, polars and pandas read
    ``DIR/runs/*.parquet`` as it is.

    Examples
    --------
    >>> import tempfile
    >>> import grouser as gr
    >>> study = gr.Campaign("campaign-heading", runs=8, sensitivity=False)
    >>> folder = tempfile.TemporaryDirectory()
    >>> found = gr.campaign.run(study, out=folder.name)
    >>> table = found.to_pandas()
    >>> len(table), found.is_finished, bool(found.rerun(3)["yaw_deg"] == table["yaw_deg"][3])
    (8, True, True)
    >>> folder.cleanup()
    """

    def __init__(self, files: Files) -> None:
        self._files = files
        data = need(files, MANIFEST)
        self._checked = _core.CampaignManifest(data, files.where(MANIFEST))
        self._manifest: dict[str, Any] = json.loads(data)
        self._study = need(files, STUDY)
        self._checked.check_study(self._study, files.where(STUDY))
        there = (self._checked.shard_of(name) for name in files.names(RUNS))
        self._there = sorted(shard for shard in there if shard is not None)
        self._missing = self._checked.shards() - len(self._there)
        # Whether the shards' digest was compared with the manifest's.
        self._compared = False

    @functools.cached_property
    def campaign(self) -> Campaign:
        """The campaign, with all documents that it names."""
        campaign = Campaign.from_toml(self._study.decode())
        if self._manifest["version"] == _core.__version__:
            self._checked.check_campaign(campaign._document, self._files.where(MANIFEST))
        return campaign

    @property
    def location(self) -> str:
        """The folder, or the URL."""
        return self._files.location

    @property
    def digest(self) -> str | None:
        """SHA-256 over the bytes of all shards in their order; None before the campaign is
        finished. It is the same on every machine. The first access reads and checks all shards,
        unless they were read before."""
        if self._recorded is not None and not self._compared:
            for shard, data in self._shards():
                self._read(shard, data, [])
        return self._recorded

    @property
    def _recorded(self) -> str | None:
        """The digest in the manifest."""
        digest: str | None = self._manifest["digest"]
        return digest

    @property
    def is_finished(self) -> bool:
        """Whether all shards are finished."""
        return self._missing == 0

    @property
    def manifest(self) -> dict[str, Any]:
        """The manifest: study, version, seed, columns with their units, and times of computation; a
        copy."""
        manifest: dict[str, Any] = copy.deepcopy(self._manifest)
        return manifest

    @property
    def shard_count(self) -> int:
        """Number of finished shards."""
        return len(self._there)

    def count(self) -> tuple[dict[str, int], int]:
        """Number of finished runs with each status, and their size in bytes; read shard by
        shard."""
        statuses: Counter[str] = Counter()
        size = 0
        for shard, data in self._shards():
            statuses.update(self._read(shard, data, ["status"])["status"])
            size += len(data)
        return dict(sorted(statuses.items())), size

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns, in order."""
        return tuple(column["name"] for column in self._manifest["columns"])

    def __len__(self) -> int:
        """Number of finished runs."""
        return sum(end - start for start, end in self._runs())

    def _runs(self) -> list[tuple[int, int]]:
        """The finished runs: the first of each shard, and the one after its last."""
        return [self._checked.runs_of(shard) for shard in self._there]

    def column(self, name: str) -> NDArray[Any]:
        """A column, shape (runs,): numbers with NaN where a run has none, or texts with None.

        Parameters
        ----------
        name : str
            One of `columns`.

        Raises
        ------
        ParameterError
            If the column does not exist.
        """
        found: NDArray[Any] = self._columns([name])[name]
        return found

    def _columns(self, names: Sequence[str]) -> dict[str, NDArray[Any]]:
        kinds = {column["name"]: column["kind"] for column in self._manifest["columns"]}
        for name in names:
            if name not in kinds:
                raise ParameterError(
                    f"there is no column {name!r}", "columns", None, ", ".join(kinds)
                )
        parts: dict[str, list[NDArray[Any]]] = {name: [] for name in names}
        for shard, data in self._shards():
            for name, values in self._read(shard, data, names).items():
                parts[name].append(np.asarray(values, dtype=_DTYPES[kinds[name]]))
        empty = {name: np.empty(0, dtype=_DTYPES[kinds[name]]) for name in names}
        return {name: np.concatenate([empty[name], *parts[name]]) for name in names}

    def _shards(self) -> Iterator[tuple[int, bytes]]:
        """The finished shards, in order: one at a time is in memory. After the last one of a
        finished campaign, their digest is compared with the manifest's."""
        digest = hashlib.sha256()
        for shard in self._there:
            data = self._bytes(shard)
            digest.update(data)
            yield shard, data
        recorded, found = self._recorded, digest.hexdigest()
        if self.is_finished and recorded not in (None, found):
            raise CampaignError(
                f"{self.location}: its digest was {recorded}, now it is {found}: some shard was computed "
                "again with other numbers; run the campaign in a new folder"
            )
        self._compared = self.is_finished

    def _bytes(self, shard: int) -> bytes:
        return need(self._files, f"{RUNS}/{file_name(shard)}", self._checked.most_bytes(shard))

    def _read(self, shard: int, data: bytes, columns: Sequence[str]) -> dict[str, Any]:
        """Columns of a shard, after its hash was checked."""
        place = self._files.where(f"{RUNS}/{file_name(shard)}")
        return self._checked.read(shard, data, list(columns), place)

    def to_pandas(self, columns: Iterable[str] | None = None) -> pandas.DataFrame:
        """A table with a row for each run.

        Parameters
        ----------
        columns : names, optional
            Which columns; by default all. Only these are in memory.
        """
        return _tables.frame(self._columns(list(self.columns if columns is None else columns)))

    def to_arrow(self, columns: Iterable[str] | None = None) -> pyarrow.Table:
        """A table of Arrow with a row for each run, null where a run has no value.

        Parameters
        ----------
        columns : names, optional
            Which columns; by default all.

        Raises
        ------
        ImportError
            Without pyarrow.
        """
        try:
            import pyarrow
            from pyarrow import parquet
        except ImportError as error:
            raise ImportError("tables of Arrow need pyarrow: pip install pyarrow") from error
        names = list(self.columns if columns is None else columns)
        tables = []
        for shard, data in self._shards():
            self._read(shard, data, [])
            tables.append(parquet.read_table(pyarrow.BufferReader(data), columns=names))
        if not tables:
            raise CampaignError(f"{self.location} has no shards yet")
        # Each shard's footer has its own number.
        return pyarrow.concat_tables(table.replace_schema_metadata(None) for table in tables)

    def row(self, run: int) -> dict[str, Any]:
        """The stored row of a run by column, None or NaN for a missing value.

        Parameters
        ----------
        run : int
            The run's number, from 0.

        Raises
        ------
        ParameterError
            If the run does not exist, or its shard is missing.
        """
        shard = run // self._manifest["shard_runs"]
        if run < 0 or shard not in self._there:
            raise ParameterError(
                f"run {run} is not there", "run", run, f"below {self._manifest['runs']}"
            )
        place = run - self._checked.runs_of(shard)[0]
        columns = self._read(shard, self._bytes(shard), self.columns)
        return {name: _plain(values[place]) for name, values in columns.items()}

    def rerun(self, run: int) -> dict[str, Any]:
        """Computes a single run again, finished or not: its row by column, None for a missing
        value.

        Parameters
        ----------
        run : int
            The run's number, from 0.

        Raises
        ------
        ParameterError
            If the run does not exist.
        """
        return self.campaign.rerun(run)

    def summarise(
        self,
        columns: Iterable[str] | None = None,
        *,
        quantiles: Sequence[float] = (0.025, 0.5, 0.975),
    ) -> Summary:
        """Statistics over the runs: the share of each status, with Wilson intervals; mean and
        quantiles of each result, with confidence intervals; convergence over the runs; Sobol
        indices of a campaign with ``sensitivity``. Such a campaign repeats runs with one input
        exchanged; all statistics but the indices are over its independent runs alone.

        Parameters
        ----------
        columns : names, optional
            Which results; by default all.
        quantiles : sequence of float
            Probabilities of the quantiles, between 0 and 1.

        Raises
        ------
        CampaignError
            If shards are missing, because the others may be biased; or if a file was changed or
            damaged.
        """
        if not self.is_finished:
            raise CampaignError(
                f"{self.location} is not finished: {self._missing} of its shards are missing"
            )
        return summary_of(self, columns, quantiles)

    def __reduce__(self) -> tuple[Any, ...]:
        # Read again after unpickling: the checks made here do not hold for the files there.
        return Results, (self._files,)

    def __repr__(self) -> str:
        state = "finished" if self.is_finished else f"{self._missing} shards missing"
        return f"<Results {self._manifest['name']!r} in {self.location}: {len(self)} runs, {state}>"


#: NumPy's types of columns.
_DTYPES: dict[str, Any] = {"float": np.float64, "whole": np.int64, "text": object}


def _plain(value: Any) -> Any:
    """Python's own number for NumPy's."""
    return value.item() if isinstance(value, np.generic) else value


def results(location: Location, *, storage_options: Mapping[str, Any] | None = None) -> Results:
    """The results in a folder or under a URL, finished or not.

    Parameters
    ----------
    location : path or str
        The folder, or a URL of fsspec.
    storage_options : mapping, optional
        Options of fsspec for the URL.

    Returns
    -------
    Results
        Those that exist now.

    Raises
    ------
    CampaignNotFoundError
        If the location has no campaign.
    CampaignError
        If the manifest or the study was changed or damaged. Shards are checked when they are read.

    Examples
    --------
    >>> import tempfile
    >>> import grouser as gr
    >>> folder = tempfile.TemporaryDirectory()
    >>> study = gr.Campaign("campaign-heading", runs=8, sensitivity=False)
    >>> _ = gr.campaign.run(study, out=folder.name)                 # perhaps elsewhere, some time ago
    >>> gr.campaign.results(folder.name).campaign == study
    True
    >>> folder.cleanup()
    """
    return Results(files_of(location, storage_options))


def merge(out: Location, parts: Sequence[Location]) -> Results:
    """Joins the parts of an array of jobs: their shards are copied to one folder, which is then the
    same as if one process had computed all.

    Parameters
    ----------
    out : path
        The folder for all shards.
    parts : sequence of paths
        The parts' folders, in any order.

    Returns
    -------
    Results
        The results of the whole campaign.

    Raises
    ------
    CampaignError
        If parts are unfinished, missing, given twice, or of another study. Nothing is written then.
    CampaignNotFoundError
        If a folder has no campaign.

    Examples
    --------
    Two jobs of an array compute a half each:

    >>> import tempfile
    >>> import grouser as gr
    >>> study = gr.Campaign("campaign-heading", runs=8, shard_runs=4, sensitivity=False)
    >>> folders = [tempfile.TemporaryDirectory() for _ in range(3)]
    >>> whole, *parts = (folder.name for folder in folders)
    >>> for job, part in enumerate(parts, start=1):
    ...     _ = gr.campaign.run(study, out=part, part=(job, 2))
    >>> found = gr.campaign.merge(whole, parts)
    >>> len(found.to_pandas()), found.is_finished
    (8, True)
    >>> for folder in folders:
    ...     folder.cleanup()
    """
    if not parts:
        raise ParameterError("there are no parts to merge", "parts", None, "at least one folder")
    for location in (out, *parts):
        if is_url(location):
            raise ParameterError(
                f"{location} is not a folder: parts are merged in folders", "parts"
            )
    study = results(parts[0]).campaign
    _core.merge_campaign(out, study._document, list(parts))
    return results(out)
