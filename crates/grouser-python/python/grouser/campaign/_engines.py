"""The workers of a campaign: this process, pools, Dask, Ray, or any executor of
`concurrent.futures`.

All of them become executors of `concurrent.futures`, so that one loop submits and collects. They
differ in the number of shards in flight, in the errors by which a dead worker shows, and in what
has to be done then.
"""

from __future__ import annotations

import importlib
import multiprocessing
import os
import signal
import sys
import threading
import time
from concurrent.futures import (
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
)
from dataclasses import dataclass
from multiprocessing import connection
from typing import Any, Union

from .._errors import ParameterError
from ._worker import Writer, compute

#: Shards in flight for each worker: one to compute, one to continue with at once.
_AHEAD = 2
#: Interval between queries of the number of workers of a cluster [s].
_ASKED_EVERY_S = 2.0
#: Exceptions by which engines report that a worker died, by name: most engines are not installed.
_DEATHS = frozenset(
    {
        "KilledWorker",  # Dask
        "FutureCancelledError",  # Dask: all copies of something were lost
        "CommClosedError",  # Dask
        "WorkerCrashedError",  # Ray
        "NodeDiedError",  # Ray
        "LocalRayletDiedError",  # Ray
        "OutOfMemoryError",  # Ray: the machine's memory ran out, and a worker was ended
        "ObjectLostError",  # Ray
        "OwnerDiedError",  # Ray
    }
)


def is_death(error: BaseException) -> bool:
    """Whether a worker died, so that its shard may be given to another."""
    if isinstance(error, (BrokenExecutor, CancelledError)):
        return True
    return any(kind.__name__ in _DEATHS for kind in type(error).__mro__)


@dataclass(frozen=True)
class Job:
    """The arguments that are the same for all shards."""

    study: str
    threads: int
    writer: Writer | None


class Engine:
    """Any executor of `concurrent.futures`. It belongs to the caller: it is neither replaced nor
    shut down."""

    #: Whether a broken one can be replaced.
    mends = False
    #: Advice for the case that workers die before they finish a shard.
    hint = "has each of them enough memory, and this package?"

    def __init__(self, executor: Executor, job: Job, in_flight: int | None) -> None:
        self.executor = executor
        self.job = job
        self._in_flight = in_flight

    def capacity(self) -> int:
        """How many shards may be in flight now."""
        return self._in_flight or _AHEAD * max(1, self._workers())

    def _workers(self) -> int:
        return getattr(self.executor, "_max_workers", None) or os.cpu_count() or 1

    def submit(self, shard: int) -> Future[Union[bytes, int]]:
        """Submits a shard."""
        job = self.job
        return self.executor.submit(compute, job.study, shard, job.threads, job.writer)

    def mend(self) -> None:
        """Makes a new pool in place of a broken one."""

    def close(self, *, at_once: bool) -> None:
        """Ends the workers that were started here; with `at_once` without waiting for their
        shards."""


class _Here(Executor):
    """Computes at once, in this process."""

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:
            future.set_exception(error)
        return future


class Here(Engine):
    """This process: one shard after another, with all threads."""

    def __init__(self, job: Job) -> None:
        super().__init__(_Here(), job, 1)


class Threads(Engine):
    """Threads of this process, a shard each."""

    def __init__(self, job: Job, workers: int | None, in_flight: int | None) -> None:
        count = workers or os.cpu_count() or 1
        super().__init__(ThreadPoolExecutor(count, "grouser-campaign"), job, in_flight)

    def close(self, *, at_once: bool) -> None:
        self.executor.shutdown(wait=not at_once, cancel_futures=True)


def _begin_worker() -> None:
    """Makes a worker ignore Ctrl-C, and end when the process that started it has died."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent.sentinel,), daemon=True).start()


def _end_with(sentinel: Any) -> None:
    connection.wait([sentinel])
    os._exit(1)


class Processes(Engine):
    """Processes of this machine. They are spawned, not forked: what runs here has threads."""

    mends = True
    hint = (
        "has each enough memory, and does the script call this below `if __name__ == '__main__':`?"
    )

    def __init__(self, job: Job, workers: int | None, in_flight: int | None) -> None:
        self._count = workers or os.cpu_count() or 1
        super().__init__(self._pool(), job, in_flight)

    def _pool(self) -> ProcessPoolExecutor:
        spawn = multiprocessing.get_context("spawn")
        return ProcessPoolExecutor(self._count, mp_context=spawn, initializer=_begin_worker)

    def mend(self) -> None:
        self.executor.shutdown(wait=False)
        self.executor = self._pool()

    def close(self, *, at_once: bool) -> None:
        if at_once:
            # Python 3.14 has a method for that.
            processes: dict[int, Any] | None = getattr(self.executor, "_processes", None)
            for process in list((processes or {}).values()):
                process.terminate()
        self.executor.shutdown(wait=not at_once, cancel_futures=True)


class _Asked:
    """A number that is queried from a cluster at intervals."""

    def __init__(self, ask: Any) -> None:
        self._ask, self._value, self._next = ask, 0, 0.0

    def value(self) -> int:
        if time.monotonic() >= self._next:
            self._value = int(self._ask())
            self._next = time.monotonic() + _ASKED_EVERY_S
        return self._value


class Dask(Engine):
    """A client of Dask distributed. The scheduler gives the shards of a dead worker to others;
    after as many deaths as its `allowed-failures` it returns the shard as lost."""

    mends = True

    def __init__(
        self, client: Any, job: Job, in_flight: int | None, *, closing: tuple[Any, ...] = ()
    ) -> None:
        # Not pure: Dask need not keep the results of shards.
        super().__init__(client.get_executor(pure=False), job, in_flight)
        self._closing = closing
        self._threads = _Asked(lambda: sum(client.nthreads().values()))
        # A task, not scattered data: it is computed again if all workers that have it die.
        self._study = client.submit(str, job.study, pure=False)

    def _workers(self) -> int:
        return self._threads.value()

    def submit(self, shard: int) -> Future[Union[bytes, int]]:
        job = self.job
        return self.executor.submit(compute, self._study, shard, job.threads, job.writer)

    def close(self, *, at_once: bool) -> None:
        self._study.release()
        for ours in self._closing:
            ours.close()


class _RayExecutor(Executor):
    """Tasks of Ray as an executor. Ray itself repeats tasks of a dead worker."""

    def __init__(self, ray: Any, cpus: int) -> None:
        self._compute = ray.remote(num_cpus=cpus, max_retries=3)(compute)

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = self._compute.remote(*args, **kwargs).future()
        return future


class Ray(Engine):
    """A cluster of Ray."""

    mends = True

    def __init__(self, ray: Any, job: Job, in_flight: int | None, *, owned: bool) -> None:
        super().__init__(_RayExecutor(ray, max(1, job.threads)), job, in_flight)
        self._ray, self._owned = ray, owned
        self._cpus = _Asked(lambda: ray.cluster_resources().get("CPU", 1))
        self._study = ray.put(job.study)

    def _workers(self) -> int:
        return self._cpus.value()

    def submit(self, shard: int) -> Future[Union[bytes, int]]:
        job = self.job
        return self.executor.submit(compute, self._study, shard, job.threads, job.writer)

    def close(self, *, at_once: bool) -> None:
        if self._owned:
            self._ray.shutdown()


def engine_of(
    executor: Any,
    job: Job,
    *,
    scheduler: str | None,
    workers: int | None,
    in_flight: int | None,
) -> Engine:
    """The engine that is asked for, by name or as an object."""
    if scheduler is not None and executor not in ("dask", "ray"):
        raise ParameterError("a scheduler is that of dask or ray", "scheduler", None, "dask or ray")
    if executor is None:
        return Here(job)
    if isinstance(executor, str):
        return _named(executor, job, scheduler, workers, in_flight)
    if isinstance(executor, Executor):
        return Engine(executor, job, in_flight)
    if hasattr(executor, "get_executor") and hasattr(executor, "nthreads"):
        return Dask(executor, job, in_flight)
    if hasattr(executor, "get_client"):
        client = executor.get_client()
        return Dask(client, job, in_flight, closing=(client,))
    if executor is sys.modules.get("ray"):
        return _ray(job, None, workers, in_flight)
    raise TypeError(
        "executor is None, 'processes', 'threads', 'dask', 'ray', an executor of "
        f"concurrent.futures, or a client of Dask, not {type(executor).__name__}"
    )


def _named(
    name: str, job: Job, scheduler: str | None, workers: int | None, in_flight: int | None
) -> Engine:
    if name == "processes":
        return Processes(job, workers, in_flight)
    if name == "threads":
        return Threads(job, workers, in_flight)
    if name == "dask":
        return _dask(job, scheduler, workers, in_flight)
    if name == "ray":
        return _ray(job, scheduler, workers, in_flight)
    known = "processes, threads, dask or ray"
    raise ParameterError(f"there is no executor {name!r}: it is {known}", "executor", None, known)


def _imported(module: str, otherwise: str) -> Any:
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(otherwise) from error


def _dask(job: Job, scheduler: str | None, workers: int | None, in_flight: int | None) -> Engine:
    distributed = _imported("distributed", "Dask is not installed: pip install distributed")
    if scheduler is not None:
        client = distributed.Client(scheduler, set_as_default=False)
    else:
        # No scheduler: workers of this machine, which end with this process.
        count = workers or os.cpu_count() or 1
        cluster = distributed.LocalCluster(
            n_workers=count, threads_per_worker=1, processes=True, dashboard_address=None
        )
        client = distributed.Client(cluster, set_as_default=False)
        return Dask(client, job, in_flight, closing=(client, cluster))
    return Dask(client, job, in_flight, closing=(client,))


def _ray(job: Job, scheduler: str | None, workers: int | None, in_flight: int | None) -> Engine:
    ray = _imported("ray", "Ray is not installed: pip install ray")
    owned = not ray.is_initialized()
    if owned:
        if scheduler is not None:
            ray.init(address=scheduler, log_to_driver=False)
        else:
            count = workers or os.cpu_count() or 1
            ray.init(address="local", num_cpus=count, include_dashboard=False, log_to_driver=False)
    return Ray(ray, job, in_flight, owned=owned)
