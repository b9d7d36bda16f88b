"""Computes a campaign."""

from __future__ import annotations

import time
from collections import Counter, deque
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Future, wait
from typing import Any, Union

from .._descriptions import Source
from .._errors import CampaignError, GrouserError, ParameterError
from ._engines import Engine, Job, engine_of, is_death
from ._files import Location
from ._places import Place, place_of
from ._progress import Progress
from ._results import Results, results
from ._study import Campaign

#: How often a shard may be lost with its worker, before the shard is taken for the cause.
MOST_LOSSES = 5
#: How often all shards in flight may be lost without a finished one in between, before the workers
#: are taken for too short-lived.
MOST_BARREN_ROUNDS = 3


def run(
    study: Campaign | Source,
    /,
    *,
    out: Location,
    executor: Any = None,
    scheduler: str | None = None,
    workers: int | None = None,
    threads: int | None = None,
    part: tuple[int, int] | None = None,
    write: str = "coordinator",
    in_flight: int | None = None,
    progress: Callable[[Progress], None] | None = None,
    storage_options: Mapping[str, Any] | None = None,
) -> Results:
    """Computes the missing shards of a campaign, and its digest.

    After an interruption at any moment, the same call continues from there; on a finished campaign
    it computes nothing. Shards of workers that die are given to other workers.

    Parameters
    ----------
    study : Campaign, path or mapping
        The campaign.
    out : path or str
        A folder, made if it does not exist and locked meanwhile; or a URL of fsspec such as
        ``s3://bucket/campaign``, which has no lock.
    executor : optional
        The workers. None: this process, on all cores. ``"processes"`` or ``"threads"``: as many of
        this machine as ``workers``. ``"dask"`` or ``"ray"``: the cluster at ``scheduler``, or else
        workers of this machine. Or an object: any executor of ``concurrent.futures``, a client or
        cluster of Dask distributed, the module ``ray``; it is not shut down.
    scheduler : str, optional
        The address of a scheduler of Dask, or of a cluster of Ray.
    workers : int, optional
        Number of workers to start on this machine; by default one for each core.
    threads : int, optional
        Threads for each shard: 1, or all cores without an executor. The bytes are the same.
    part : (int, int), optional
        Part *i* of *n*, counted from 1, for an array of jobs without any engine: each has a folder
        of its own, `merge` brings them together. By default all shards.
    write : {"coordinator", "workers"}
        The writer of shards: this process, to which they are sent; or the workers, directly to the
        folder, which all of them must share under the same path, or to the URL.
    in_flight : int, optional
        Number of shards that are submitted at once; by default two for each worker. It bounds the
        memory of this process.
    progress : callable, optional
        Called with a `Progress` after every shard, in this thread.
    storage_options : mapping, optional
        Options of fsspec for the URL.

    Returns
    -------
    Results
        The results of the campaign, or of the part.

    Raises
    ------
    DocumentError, ParameterError
        If the study or an argument is invalid.
    CampaignError
        If the folder belongs to another study, or a shard is lost repeatedly.
    CampaignLockedError
        If another program writes to the folder.
    CampaignDiskError
        If the disk fails or is full. Files written before are kept.
    ImportError
        If an engine is not installed, with the command that installs it.
    KeyboardInterrupt
        On Ctrl-C. Finished shards are kept.

    Examples
    --------
    >>> import tempfile
    >>> import grouser as gr
    >>> study = gr.Campaign(
    ...     study="heading",
    ...     runs=32,
    ...     scenario="traverse-10-deg",
    ...     parameter=[
    ...         {
    ...             "key": "soil.friction_angle_deg",
    ...             "distribution": "normal",
    ...             "standard_deviation": 1.5,
    ...         }
    ...     ],
    ... )
    >>> folder = tempfile.TemporaryDirectory()
    >>> found = gr.campaign.run(study, out=folder.name)
    >>> yaw = found.summarise().quantities["yaw_deg"]
    >>> yaw.count, yaw.least < yaw.mean < yaw.most
    (32, True)
    >>> again = gr.campaign.run(study, out=folder.name)             # all is there: computes nothing
    >>> again.digest == found.digest
    True
    >>> folder.cleanup()
    """
    campaign = study if isinstance(study, Campaign) else Campaign(study)
    _check_counts(workers=workers, threads=threads, in_flight=in_flight)
    if write not in ("coordinator", "workers"):
        known = "coordinator or workers"
        raise ParameterError(
            f"shards are written by the {known}, not {write!r}", "write", None, known
        )
    _check_part(part)
    place = place_of(out, storage_options, campaign, part)
    try:
        each = (0 if executor is None else 1) if threads is None else threads
        job = Job(campaign.to_toml(), each, place.writer() if write == "workers" else None)
        if next(place.missing(), None) is not None:
            engine = engine_of(
                executor, job, scheduler=scheduler, workers=workers, in_flight=in_flight
            )
            _compute(campaign, place, engine, progress)
        place.finish()
    except BaseException:
        # The first error is the one to report; another failure of the disk adds nothing.
        try:
            place.pause()
        except (GrouserError, OSError):
            pass
        raise
    finally:
        place.close()
    return results(out, storage_options=storage_options)


def _check_counts(**counts: int | None) -> None:
    for name, count in counts.items():
        if count is not None and count < 1:
            raise ParameterError(
                f"{name} is {count}, and must be 1 or more", name, count, "1 or more"
            )


def _check_part(part: tuple[int, int] | None) -> None:
    if part is not None and not 1 <= part[0] <= part[1]:
        message = f"there is no part {part[0]} of {part[1]}: parts are counted from 1"
        raise ParameterError(message, "part", part[0], f"from 1 to {part[1]}")


def _compute(
    campaign: Campaign,
    place: Place,
    engine: Engine,
    report: Callable[[Progress], None] | None,
) -> None:
    """Computes all missing shards."""
    loop = _Loop(campaign, place, engine, report)
    try:
        loop.run()
    except BaseException:
        loop.cancel()
        engine.close(at_once=True)
        raise
    engine.close(at_once=False)


class _Loop:
    """Keeps an engine busy until all shards are finished."""

    def __init__(
        self,
        campaign: Campaign,
        place: Place,
        engine: Engine,
        report: Callable[[Progress], None] | None,
    ) -> None:
        self._campaign, self._place, self._engine, self._report = campaign, place, engine, report
        self._missing: Iterator[int] = place.missing()
        #: Shards that were lost with their worker. They come last, so that a shard that kills
        #: workers harms the fewest others.
        self._again: deque[int] = deque()
        self._losses: Counter[int] = Counter()
        #: Losses since a shard was last finished.
        self._barren = 0
        self._pending: dict[Future[Union[bytes, int]], int] = {}
        self._start = time.monotonic()
        self._shards, self._all_shards = place.shards()
        self._runs, self._all_runs = place.runs()
        self._runs_before = self._runs

    def run(self) -> None:
        """Submits and collects."""
        while self._fill() or self._pending:
            # Waits for a second at most, so that Ctrl-C interrupts on every system.
            done, _ = wait(self._pending, timeout=1.0, return_when=FIRST_COMPLETED)
            broken: BaseException | None = None
            for future in done:
                error = self._collect(future)
                broken = error if isinstance(error, BrokenExecutor) else broken
            if broken is not None:
                self._mend(broken)

    def _fill(self) -> bool:
        """Submits as many shards as may be in flight; returns whether there were any."""
        submitted = False
        while len(self._pending) < self._engine.capacity():
            shard = next(self._missing, None)
            if shard is None:
                if not self._again:
                    break
                shard = self._again.popleft()
            try:
                self._pending[self._engine.submit(shard)] = shard
            except BrokenExecutor as error:
                # It broke since the last check; this shard is not the cause.
                self._again.append(shard)
                if self._pending:
                    return True
                self._mend(error)
            submitted = True
        return submitted

    def _collect(self, future: Future[Union[bytes, int]]) -> BaseException | None:
        """Adds a finished shard, or counts a lost one."""
        shard = self._pending.pop(future)
        error = _error_of(future)
        if error is None:
            found = future.result()
            if isinstance(found, bytes):
                self._place.accept(shard, found)
            else:
                self._place.adopt(shard)
            self._barren = 0
            self._report_progress(shard)
        elif is_death(error):
            self._lose(shard, error)
        elif isinstance(error, (GrouserError, KeyboardInterrupt)):
            raise error
        else:
            message = f"shard {shard} failed: {type(error).__name__}: {error}"
            raise CampaignError(message) from error
        return error

    def _lose(self, shard: int, error: BaseException) -> None:
        self._losses[shard] += 1
        self._barren += 1
        if self._barren > MOST_BARREN_ROUNDS * self._engine.capacity():
            raise CampaignError(
                f"workers die before they finish a shard: {self._engine.hint}"
            ) from error
        if self._losses[shard] > MOST_LOSSES:
            raise CampaignError(
                f"shard {shard} was lost {self._losses[shard]} times with its worker, the last time by "
                f"{type(error).__name__}: has a worker enough memory, and this package?"
            ) from error
        self._again.append(shard)

    def _mend(self, error: BaseException) -> None:
        """Replaces a broken executor, after all its shards have been collected."""
        if not self._engine.mends:
            raise CampaignError(
                f"the executor is broken ({error}); what was finished is kept: go on with a new one"
            ) from error
        done, _ = wait(self._pending)
        for future in done:
            self._collect(future)
        self._engine.mend()

    def _report_progress(self, shard: int) -> None:
        self._shards += 1
        self._runs += len(self._campaign.runs_of(shard))
        if self._report is not None:
            elapsed = time.monotonic() - self._start
            self._report(
                Progress(
                    shards_done=self._shards,
                    shards=self._all_shards,
                    runs_done=self._runs,
                    runs=self._all_runs,
                    elapsed_s=elapsed,
                    runs_per_s=(self._runs - self._runs_before) / max(elapsed, 1e-9),
                    lost=sum(self._losses.values()),
                )
            )

    def cancel(self) -> None:
        """Cancels shards that no worker has started."""
        for future in self._pending:
            future.cancel()


def _error_of(future: Future[Any]) -> BaseException | None:
    """The error of a shard; cancellation is one as well."""
    try:
        return future.exception()
    except BaseException as error:
        return error
