"""Campaigns in this process and in processes of this machine."""

from __future__ import annotations

import json
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import time
from concurrent.futures import CancelledError, Executor, Future, ProcessPoolExecutor
from pathlib import Path
from typing import Any

import campaigns
import numpy as np
import pytest
from conftest import Program

import grouser as gr

SPAWN = multiprocessing.get_context("spawn")


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> gr.campaign.Results:
    """The study computed by one thread, undisturbed."""
    folder = tmp_path_factory.mktemp("whole") / "out"
    return gr.campaign.run(campaigns.study(), out=folder, threads=1)


@pytest.fixture(scope="module")
def long(tmp_path_factory: pytest.TempPathFactory) -> gr.campaign.Results:
    """The same of the study whose workers are killed."""
    folder = tmp_path_factory.mktemp("long") / "out"
    return gr.campaign.run(campaigns.long_study(), out=folder, threads=1)


class Backwards(Executor):
    """Computes what was submitted last first, and counts what waits."""

    def __init__(self) -> None:
        self.waiting: list[tuple[Future[Any], Any, Any]] = []
        self.most = 0

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        self.waiting.append((future, fn, args))
        self.most = max(self.most, len(self.waiting))
        if len(self.waiting) == 5:
            self.compute_one()
        return future

    def compute_one(self) -> None:
        future, fn, args = self.waiting.pop()
        future.set_result(fn(*args))


def test_a_campaign_is_a_description() -> None:
    study = campaigns.study()
    assert (study.row_count, study.shard_count) == (45, campaigns.SHARDS)
    assert [len(study.runs_of(shard)) for shard in (0, 11, 12)] == [4, 1, 0]
    assert study.inputs == ("slope_deg", "soil.friction_angle_deg")
    assert "y_m" in study.outputs and study.units["y_m"] == "m"
    assert gr.Campaign.from_toml(study.to_toml()) == study == pickle.loads(pickle.dumps(study))
    assert study.replace(seed=2).sha256 != study.sha256
    with pytest.raises(gr.ParameterError, match="soil.warmth"):
        campaigns.study(
            parameter=[{"key": "soil.warmth", "distribution": "uniform", "low": 0, "high": 1}]
        )


@pytest.mark.parametrize("ways", [{"threads": 2}, {"executor": "threads", "workers": 2}])
def test_threads_change_no_byte(
    whole: gr.campaign.Results, tmp_path: Path, ways: dict[str, Any]
) -> None:
    found = gr.campaign.run(campaigns.study(), out=tmp_path, **ways)
    assert found.digest == whole.digest is not None
    assert campaigns.files_of(tmp_path) == campaigns.files_of(Path(whole.location))


def test_a_pool_of_processes_finds_the_same(whole: gr.campaign.Results, tmp_path: Path) -> None:
    found = gr.campaign.run(
        campaigns.study(), out=tmp_path / "ours", executor="processes", workers=2
    )
    assert found.digest == whole.digest
    with ProcessPoolExecutor(2, mp_context=SPAWN) as pool:
        for write in ("coordinator", "workers"):
            out = tmp_path / write
            found = gr.campaign.run(campaigns.study(), out=out, executor=pool, write=write)
            assert found.digest == whole.digest


def test_shards_may_come_in_any_order(whole: gr.campaign.Results, tmp_path: Path) -> None:
    executor = Backwards()
    order: list[int] = []

    def note(now: gr.campaign.Progress) -> None:
        order.append(now.shards_done)
        if now.shards_done >= campaigns.SHARDS - 4 and executor.waiting:
            executor.compute_one()

    found = gr.campaign.run(
        campaigns.study(), out=tmp_path, executor=executor, in_flight=5, progress=note
    )
    assert found.digest == whole.digest
    assert order == list(range(1, campaigns.SHARDS + 1)) and executor.most == 5


def test_a_killed_process_costs_time_only(long: gr.campaign.Results, tmp_path: Path) -> None:
    def workers() -> list[int]:
        return [child.pid for child in multiprocessing.active_children() if child.pid]

    killer = campaigns.Killer(workers)
    found = gr.campaign.run(
        campaigns.long_study(), out=tmp_path, executor="processes", workers=2, progress=killer
    )
    assert found.digest == long.digest
    assert killer.killed and killer.lost >= 1


def test_what_a_broken_pool_has_left_is_gone_on_with(
    long: gr.campaign.Results, tmp_path: Path
) -> None:
    pool = ProcessPoolExecutor(2, mp_context=SPAWN)
    killer = campaigns.Killer(lambda: list(pool._processes))
    with pytest.raises(gr.CampaignError, match="the executor is broken"):
        gr.campaign.run(campaigns.long_study(), out=tmp_path, executor=pool, progress=killer)
    pool.shutdown()
    kept = campaigns.files_of(tmp_path)
    assert 2 <= len(kept) < campaigns.SHARDS
    assert gr.campaign.run(campaigns.long_study(), out=tmp_path).digest == long.digest
    assert kept.items() <= campaigns.files_of(tmp_path).items()


def test_a_shard_that_always_kills_its_worker_is_named(tmp_path: Path) -> None:
    class Deadly(Backwards):
        def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
            future: Future[Any] = Future()
            if args[1] == 3:
                future.set_exception(CancelledError())
            else:
                future.set_result(fn(*args))
            return future

    with pytest.raises(gr.CampaignError, match="shard 3 was lost 6 times"):
        gr.campaign.run(campaigns.wheel_study(), out=tmp_path, executor=Deadly())
    # All others were computed before it was given up.
    assert len(campaigns.files_of(tmp_path)) == 9


def test_workers_that_never_finish_anything_are_given_up(tmp_path: Path) -> None:
    """Soon, however many shards there are."""

    class Lost(Executor):
        asked = 0

        def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
            self.asked += 1
            future: Future[Any] = Future()
            future.set_exception(CancelledError())
            return future

    executor, study = Lost(), campaigns.wheel_study(runs=100_000, shard_runs=1)
    with pytest.raises(gr.CampaignError, match="workers die before they finish a shard"):
        gr.campaign.run(study, out=tmp_path / "out", executor=executor, in_flight=4)
    assert executor.asked <= 16
    # As where a script is read again by each process that it starts.
    script = tmp_path / "script.py"
    script.write_text(
        "import grouser as gr\n"
        f"study = gr.Campaign.from_toml({campaigns.study().to_toml()!r})\n"
        f"gr.campaign.run(study, out={str(tmp_path / 'script')!r}, executor='processes', workers=1)\n"
    )
    finished = subprocess.run([sys.executable, str(script)], capture_output=True, text=True)
    assert finished.returncode == 1 and "below `if __name__ == '__main__':`" in finished.stderr


def test_an_interrupted_campaign_goes_on(whole: gr.campaign.Results, tmp_path: Path) -> None:
    class Enough(Exception):
        pass

    def stop(now: gr.campaign.Progress) -> None:
        if now.shards_done == 3:
            raise Enough

    with pytest.raises(Enough):
        gr.campaign.run(campaigns.study(), out=tmp_path, progress=stop)
    part = gr.campaign.results(tmp_path)
    assert not part.is_finished and part.digest is None and len(part) == 12
    with pytest.raises(gr.CampaignError, match="9 of its shards are missing"):
        part.summarise()
    reports: list[gr.campaign.Progress] = []
    found = gr.campaign.run(campaigns.study(), out=tmp_path, progress=reports.append)
    assert found.digest == whole.digest and len(reports) == campaigns.SHARDS - 3
    assert reports[-1].runs_done == reports[-1].runs == 45
    # Finished: there is nothing to do, and no worker is started.
    again = gr.campaign.run(campaigns.study(), out=tmp_path, executor="dask", scheduler="nowhere")
    assert again.digest == whole.digest
    assert [session["shards"] for session in again.manifest["sessions"]] == [3, 9]


def endless(tmp_path: Path) -> subprocess.Popen[str]:
    """A campaign on two processes that takes minutes, once its first shard is there."""
    script = tmp_path / "study.toml"
    script.write_text(campaigns.study(runs=40_000, shard_runs=4).to_toml())
    command = [sys.executable, "-m", "grouser.campaign", "run", str(script)]
    command += ["--out", str(tmp_path / "out"), "--workers", "2", "--format", "json"]
    child = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    assert child.stdout is not None
    first = json.loads(child.stdout.readline())
    assert first["runs_done"] >= 4
    return child


def test_ctrl_c_is_heard_and_keeps_what_is_there(tmp_path: Path) -> None:
    with endless(tmp_path) as child:
        child.send_signal(signal.SIGINT)
        _, error = child.communicate(timeout=300)
        assert child.returncode == 130, error
    assert "the same command goes on" in error and "Traceback" not in error
    assert len(gr.campaign.results(tmp_path / "out")) >= 4


def test_workers_do_not_outlive_who_started_them(tmp_path: Path) -> None:
    with endless(tmp_path) as child:
        child.kill()
        # The workers hold its output open as long as they live.
        child.communicate(timeout=300)
    deadline = time.monotonic() + 300
    while time.monotonic() < deadline:
        try:
            os.killpg(child.pid, 0)
        except ProcessLookupError:
            return
        time.sleep(0.1)
    pytest.fail("a worker is still there")


def test_a_folder_is_for_one_at_a_time_and_for_one_study(tmp_path: Path) -> None:
    def again(_: gr.campaign.Progress) -> None:
        with pytest.raises(gr.CampaignLockedError, match="another campaign is writing"):
            gr.campaign.run(campaigns.wheel_study(), out=tmp_path)

    gr.campaign.run(campaigns.wheel_study(), out=tmp_path, progress=again)
    with pytest.raises(gr.CampaignError, match="seed is 1 there, 2 here"):
        gr.campaign.run(campaigns.wheel_study(seed=2), out=tmp_path)
    with pytest.raises(gr.CampaignNotFoundError):
        gr.campaign.results(tmp_path / "elsewhere")
    with pytest.raises(FileNotFoundError):
        gr.campaign.results(tmp_path / "elsewhere")


def test_parts_are_brought_together(whole: gr.campaign.Results, tmp_path: Path) -> None:
    parts = [tmp_path / str(index) for index in (1, 2, 3)]
    for index, folder in enumerate(parts, start=1):
        part = gr.campaign.run(campaigns.study(), out=folder, part=(index, 3))
        assert part.shard_count == 4 and part.digest != whole.digest
    with pytest.raises(gr.CampaignError, match="4 of 12 shards are missing"):
        gr.campaign.merge(tmp_path / "merged", parts[:2])
    assert gr.campaign.merge(tmp_path / "merged", parts[::-1]).digest == whole.digest
    with pytest.raises(gr.ParameterError, match="no part 4 of 3"):
        gr.campaign.run(campaigns.study(), out=tmp_path / "x", part=(4, 3))


def test_runs_can_be_had_alone(whole: gr.campaign.Results) -> None:
    for run in (0, 7, 44):
        again, stored = whole.rerun(run), whole.row(run)
        assert list(again) == list(stored) == list(whole.columns)
        for name, value in again.items():
            assert value == stored[name] or value is None and np.isnan(stored[name])
    with pytest.raises(gr.ParameterError, match="there is no run 45"):
        whole.rerun(45)


def test_tables_have_every_run(whole: gr.campaign.Results) -> None:
    table = whole.to_pandas()
    assert list(table.columns) == list(whole.columns) and table["run"].tolist() == list(range(45))
    assert whole.column("y_m").dtype == np.float64
    arrow = whole.to_arrow(["run", "y_m", "status"])
    assert arrow.column("run").to_pylist() == list(range(45))
    assert arrow.column("y_m").to_numpy().tobytes() == table["y_m"].to_numpy().tobytes()
    assert arrow.column("status").to_pylist() == table["status"].tolist()
    with pytest.raises(gr.ParameterError, match="there is no column 'z_m'"):
        whole.to_pandas(["z_m"])


def test_runs_without_an_answer_are_rows(tmp_path: Path) -> None:
    stand = {"soil": "toyoura", "wheel": "hakuto", "load_n": 17.0, "slip_ratio": 0.2}
    spread = [{"key": "load_n", "distribution": "uniform", "low": 10.0, "high": 20_000.0}]
    found = gr.campaign.run(campaigns.wheel_study(wheel_test=stand, parameter=spread), out=tmp_path)
    status, sinkage = found.column("status"), found.column("sinkage_mm")
    sunk = status == "soil cannot carry the load"
    assert 0 < sunk.sum() < 100
    assert np.array_equal(np.isnan(sinkage), sunk)
    summary = found.summarise(["sinkage_mm"])
    assert summary.status["soil cannot carry the load"].count == sunk.sum()
    # Statistics leave no run out: a wheel that the soil cannot carry has sunk to its axle.
    counted = summary.quantities["sinkage_mm"]
    assert counted.missing == 0 and counted.mean > np.nanmean(sinkage)


def test_statistics_of_known_runs(tmp_path: Path) -> None:
    """The normal force of a settled wheel is its load, and has the distribution of the load."""
    study = campaigns.wheel_study(runs=4096, shard_runs=1024, sampling="latin-hypercube")
    found = gr.campaign.run(study, out=tmp_path)
    summary = found.summarise(["normal_force_n"]).quantities["normal_force_n"]
    assert summary.count == 4096 and summary.mean_low <= 17.0 <= summary.mean_high
    # The normal law's 2.5 %, 50 % and 97.5 %.
    for share, score in [(0.025, -1.959964), (0.5, 0.0), (0.975, 1.959964)]:
        _, low, high = summary.quantiles[share]
        assert low is not None and high is not None and low <= 17.0 + score <= high
    assert summary.convergence[0]["runs"] == 16 and summary.convergence[-1]["runs"] == 4096


def test_sensitivities_are_those_of_the_inputs(tmp_path: Path) -> None:
    """The load alone decides what a settled wheel bears; the slip ratio has no part in it."""
    both = [
        {"key": "load_n", "distribution": "normal", "standard_deviation": 1.0},
        {"key": "slip_ratio", "distribution": "uniform", "low": 0.1, "high": 0.3},
    ]
    study = campaigns.wheel_study(runs=256, sampling="sobol", sensitivity=True, parameter=both)
    found = gr.campaign.run(study, out=tmp_path).summarise(["normal_force_n"])
    indices = found.quantities["normal_force_n"].sensitivity
    load, slip = indices["load_n"], indices["slip_ratio"]
    assert load["first_low"] <= 1.0 <= load["first_high"]
    # What the wheel bears differs from its load by what settling tolerates.
    assert abs(slip["total"]) < 1e-6
    table = found.to_pandas("sensitivity")
    assert table[["name", "input"]].values.tolist() == [
        ["normal_force_n", "load_n"],
        ["normal_force_n", "slip_ratio"],
    ]
    assert table["total"].tolist() == [load["total"], slip["total"]]
    runs = found.to_pandas("convergence").runs.tolist()
    assert runs == sorted(runs) and runs[-1] == found.runs
    assert "Sobol indices" in found._repr_html_()
    with pytest.raises(gr.ParameterError, match="table is 'sobol'"):
        found.to_pandas("sobol")  # type: ignore[arg-type]


def test_legs_of_missions_have_shares(program: Program, tmp_path: Path) -> None:
    """A mission that drift may stop, as a description in a campaign: program and Python agree."""
    mission = gr.Mission(
        name="short",
        simulation="quasi-steady",
        stop={"drift_m": {"above": 0.008, "over_m": 0.1}},
        leg=[{"drive_m": 0.05, "yaw_deg": 0.0}, {"drive_m": 0.2}, {"wait_s": 1.0}],
    )
    slope = {"key": "slope_deg", "distribution": "uniform", "low": 6.0, "high": 14.0}
    study = gr.Campaign(study="mission", runs=20, mission=mission, parameter=[slope])
    found = gr.campaign.run(study, out=tmp_path / "out")
    summary = found.summarise()
    assert list(summary.legs) == [
        f"leg_{k}.{name}" for k in (1, 2, 3) for name in ("outcome", "stopped_by")
    ]
    assert summary.legs["leg_1.outcome"]["completed"].share == 1.0
    stopped = summary.legs["leg_2.outcome"]["stopped"]
    assert 0 < stopped.count < 20 and stopped.low < stopped.count / 20 < stopped.high
    assert stopped == summary.legs["leg_2.stopped_by"]["drift_m"] == summary.outcome["stopped"]
    assert stopped == summary.legs["leg_3.outcome"]["not_begun"]
    assert "leg_2.outcome stopped" in repr(summary)
    table = found.to_pandas()
    for run in (0, 7):
        row = table.iloc[run]
        alone = gr.mission(mission, slope_deg=row["slope_deg"])
        assert (row["outcome"], row["energy_j"]) == (alone.outcome, alone.energy_j)
        begun = len(alone.legs)
        assert [row[f"leg_{k}.distance_m"] for k in range(1, begun + 1)] == list(alone.legs.distance_m)
    answer = program("campaign", "summarise", str(tmp_path / "out"))
    events = {row["event"]: row for row in answer["probabilities"]}
    for column, shares in summary.legs.items():
        for word, share in shares.items():
            row = events[f"{column}: {word}"]
            theirs = row["count"], row["probability"], row["probability_low"], row["probability_high"]
            assert theirs == (share.count, share.share, share.low, share.high)


def test_program_and_python_find_the_same(program: Program, tmp_path: Path) -> None:
    path = tmp_path / "study.toml"
    path.write_text(campaigns.study().to_toml())
    lines = subprocess.run(
        [*program.command, "campaign", "run", str(path), "--out", str(tmp_path / "program")],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    found = gr.campaign.run(path, out=tmp_path / "python")
    assert found.digest is not None and found.digest in lines.stdout
    theirs = gr.campaign.results(tmp_path / "program")
    assert theirs.digest == found.digest and theirs.campaign == found.campaign
    assert campaigns.files_of(tmp_path / "program") == campaigns.files_of(tmp_path / "python")
    # And each goes on with what the other began.
    assert gr.campaign.run(path, out=tmp_path / "program").digest == found.digest


def test_the_program_hands_over_to_processes(program: Program, tmp_path: Path) -> None:
    path = tmp_path / "study.toml"
    path.write_text(campaigns.study().to_toml())
    finished = subprocess.run(
        [*program.command, "campaign", "run", str(path), "--out", str(tmp_path / "out"),
         "--executor", "processes", "--threads", "2", "--set", "campaign.seed=5", "--format", "json"],
        capture_output=True, text=True, check=True, env={**os.environ, "GROUSER_PYTHON": sys.executable},
    )  # fmt: skip
    last = json.loads(finished.stdout.splitlines()[-1])
    here = gr.campaign.run(campaigns.study(seed=5), out=tmp_path / "here")
    assert last["schema"] == "grouser.campaign.run.v1" and last["digest"] == here.digest
    assert last["statuses"] == {"ok": 45} and last["inputs"]["seed"] == 5


def test_the_module_says_what_is_wrong(tmp_path: Path) -> None:
    def ended(*words: str) -> tuple[int, str]:
        command = [sys.executable, "-m", "grouser.campaign", "run", *words]
        finished = subprocess.run(command, capture_output=True, text=True)
        return finished.returncode, finished.stderr

    out = ["--out", str(tmp_path / "out")]
    code, error = ended("nowhere.toml", *out)
    assert code == 2 and "nowhere.toml" in error and "Traceback" not in error
    code, error = ended("nowhere.toml", *out, "--shard", "3/2")
    assert code == 2 and "I/N" in error
    path = tmp_path / "study.toml"
    path.write_text(campaigns.wheel_study().to_toml())
    code, error = ended(str(path), "--out", str(path))
    assert code in (1, 2) and "Traceback" not in error


@pytest.mark.parametrize(("engine", "module"), [("dask", "distributed"), ("ray", "ray")])
def test_a_missing_engine_is_named_with_its_command(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, engine: str, module: str
) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match=f"pip install {module}"):
        gr.campaign.run(campaigns.wheel_study(), out=tmp_path, executor=engine)


def test_wrong_arguments_are_named(tmp_path: Path) -> None:
    study = campaigns.wheel_study()
    for name, value in [("workers", 0), ("threads", -1), ("in_flight", 0), ("write", "nobody")]:
        with pytest.raises(gr.ParameterError, match=str(value)) as caught:
            gr.campaign.run(study, out=tmp_path / "out", **{name: value})
        assert caught.value.name == name
    with pytest.raises(gr.ParameterError, match="no executor 'dusk'"):
        gr.campaign.run(study, out=tmp_path / "out", executor="dusk")
    with pytest.raises(gr.ParameterError, match="a scheduler is that of dask or ray"):
        gr.campaign.run(study, out=tmp_path / "out", scheduler="tcp://a:1")
    with pytest.raises(TypeError, match="not int"):
        gr.campaign.run(study, out=tmp_path / "out", executor=3)
