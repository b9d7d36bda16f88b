"""Campaigns under URLs of fsspec."""

from __future__ import annotations

import uuid
from collections.abc import Iterator
from pathlib import Path

import campaigns
import pytest

import grouser as gr

fsspec = pytest.importorskip("fsspec")


@pytest.fixture(params=["memory", "file"])
def url(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[str]:
    """A place that nothing else is in."""
    if request.param == "file":
        yield f"file://{tmp_path}/campaign"
    else:
        place = f"memory://{uuid.uuid4().hex}"
        yield place
        files, path = fsspec.core.url_to_fs(place)
        if files.exists(path):
            files.rm(path, recursive=True)


def test_a_url_has_what_a_folder_has(url: str, tmp_path: Path) -> None:
    study = campaigns.wheel_study()
    here = gr.campaign.run(study, out=tmp_path / "folder")
    there = gr.campaign.run(study, out=url)
    assert there.digest == here.digest and there.is_finished and there.campaign == study
    files, path = fsspec.core.url_to_fs(url)
    for name, data in campaigns.files_of(tmp_path / "folder").items():
        assert files.cat_file(f"{path}/runs/{name}") == data
    assert there.manifest.keys() == here.manifest.keys()
    differing = {key for key, value in here.manifest.items() if there.manifest[key] != value}
    assert differing <= {"sessions", "manifest_sha256"}
    assert there.to_pandas().equals(here.to_pandas())
    assert there.summarise() == here.summarise()


def test_a_url_is_gone_on_with(url: str, tmp_path: Path) -> None:
    study = campaigns.wheel_study()

    class Enough(Exception):
        pass

    def stop(now: gr.campaign.Progress) -> None:
        if now.shards_done == 4:
            raise Enough

    with pytest.raises(Enough):
        gr.campaign.run(study, out=url, progress=stop)
    files, path = fsspec.core.url_to_fs(url)
    cut = files.cat_file(f"{path}/runs/part-000001.parquet")
    files.pipe_file(f"{path}/runs/part-000001.parquet", cut[:-100])
    files.pipe_file(f"{path}/runs/.part-000005.parquet.partial-77", b"half")
    reports: list[gr.campaign.Progress] = []
    found = gr.campaign.run(study, out=url, progress=reports.append)
    # Six that were missing, and the damaged one.
    assert len(reports) == 7
    assert found.digest == gr.campaign.run(study, out=tmp_path / "folder").digest
    assert len(files.ls(f"{path}/runs", detail=False)) == 10
    with pytest.raises(gr.CampaignError, match="seed is 1 there, 9 here"):
        gr.campaign.run(study.replace(seed=9), out=url)


def test_workers_write_to_a_url_by_themselves(tmp_path: Path) -> None:
    study = campaigns.study()
    url = f"file://{tmp_path}/campaign"
    found = gr.campaign.run(study, out=url, executor="processes", workers=2, write="workers")
    assert found.digest == gr.campaign.run(study, out=tmp_path / "folder").digest
    # Nothing unfinished is left, and the folder is one that the program would go on with, too.
    assert gr.campaign.run(study, out=tmp_path / "campaign").digest == found.digest


def test_parts_may_go_to_urls(url: str) -> None:
    study = campaigns.wheel_study()
    found = gr.campaign.run(study, out=url, part=(2, 3))
    assert found.is_finished and found.shard_count == 3 and len(found) == 30


def test_strangers_are_left_alone(url: str) -> None:
    files, path = fsspec.core.url_to_fs(url)
    files.makedirs(path, exist_ok=True)
    files.pipe_file(f"{path}/thesis.tex", b"mine")
    with pytest.raises(gr.CampaignError, match="thesis.tex is in it"):
        gr.campaign.run(campaigns.wheel_study(), out=url)
    assert files.ls(path, detail=False) == [f"{path}/thesis.tex"]


def test_a_url_that_nothing_reaches_is_named() -> None:
    with pytest.raises(gr.ParameterError, match="teletype") as caught:
        gr.campaign.run(campaigns.wheel_study(), out="teletype://nowhere")
    assert caught.value.name == "out"


def test_without_fsspec_its_command_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "fsspec", None)
    with pytest.raises(ImportError, match=r"pip install fsspec"):
        gr.campaign.run(campaigns.wheel_study(), out="memory://nowhere")
