"""Campaigns on clusters of Dask and Ray: two worker processes each, and one of them is killed."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import campaigns
import pytest

import grouser as gr

# What engines warn of, such as a busy machine, is theirs.
pytestmark = [pytest.mark.cluster, pytest.mark.filterwarnings("default")]


def undisturbed(study: gr.Campaign, folder: Path) -> str:
    """The digest of a run in one thread."""
    found = gr.campaign.run(study, out=folder / "out", threads=1)
    assert found.digest is not None
    return found.digest


@pytest.fixture(scope="module")
def digest(tmp_path_factory: pytest.TempPathFactory) -> str:
    return undisturbed(campaigns.study(), tmp_path_factory.mktemp("one"))


@pytest.fixture(scope="module")
def long_digest(tmp_path_factory: pytest.TempPathFactory) -> str:
    return undisturbed(campaigns.long_study(), tmp_path_factory.mktemp("long"))


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    """Dask with two worker processes, each watched by a nanny that starts it again."""
    distributed = pytest.importorskip("distributed")
    cluster = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    )
    yield cluster
    cluster.close()


def workers_of(cluster: Any) -> list[int]:
    return [worker.pid for worker in cluster.workers.values() if worker.pid]


def test_dask_finds_the_same(cluster: Any, digest: str, tmp_path: Path) -> None:
    with cluster.get_client() as client:
        assert len(client.nthreads()) == 2
        for write in ("coordinator", "workers"):
            out = tmp_path / write
            found = gr.campaign.run(campaigns.study(), out=out, executor=client, write=write)
            assert found.digest == digest
        # The client is its maker's, and works on.
        assert client.submit(int, "3").result() == 3


def test_dask_by_its_address(cluster: Any, digest: str, tmp_path: Path) -> None:
    study = tmp_path / "study.toml"
    study.write_text(campaigns.study().to_toml())
    finished = subprocess.run(
        [sys.executable, "-m", "grouser.campaign", "run", str(study), "--out", str(tmp_path / "out"),
         "--executor", "dask", "--scheduler", cluster.scheduler_address, "--format", "json"],
        capture_output=True, text=True,
    )  # fmt: skip
    assert finished.returncode == 0, finished.stderr
    assert json.loads(finished.stdout.splitlines()[-1])["digest"] == digest


def test_dask_with_a_killed_worker(cluster: Any, long_digest: str, tmp_path: Path) -> None:
    killer = campaigns.Killer(lambda: workers_of(cluster))
    with cluster.get_client() as client:
        found = gr.campaign.run(
            campaigns.long_study(), out=tmp_path, executor=client, progress=killer
        )
    assert found.digest == long_digest and killer.killed


@pytest.fixture(scope="module")
def ray() -> Iterator[Any]:
    """Ray with two processors."""
    ray = pytest.importorskip("ray")
    ray.init(address="local", num_cpus=2, include_dashboard=False, log_to_driver=False)
    yield ray
    ray.shutdown()


def workers_of_ray() -> list[int]:
    """Processes that compute shards now, by what Ray calls them."""
    names = {
        int(path.parent.name): path.read_bytes()
        for path in Path("/proc").glob("[0-9]*/cmdline")
        if path.exists()
    }
    return [pid for pid, name in names.items() if name.startswith(b"ray::compute")]


def test_ray_finds_the_same(ray: Any, digest: str, tmp_path: Path) -> None:
    found = gr.campaign.run(campaigns.study(), out=tmp_path / "object", executor=ray)
    assert found.digest == digest
    found = gr.campaign.run(
        campaigns.study(), out=tmp_path / "name", executor="ray", write="workers"
    )
    assert found.digest == digest
    # It was started before, and is left as it is.
    assert ray.is_initialized()


@pytest.mark.skipif(sys.platform != "linux", reason="workers are found in /proc")
def test_ray_with_a_killed_worker(ray: Any, long_digest: str, tmp_path: Path) -> None:
    killer = campaigns.Killer(workers_of_ray)
    found = gr.campaign.run(campaigns.long_study(), out=tmp_path, executor=ray, progress=killer)
    assert found.digest == long_digest and killer.killed
