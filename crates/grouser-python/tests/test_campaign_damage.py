"""Damage is refused by everything that reads, and program and package say the same of a folder."""

from __future__ import annotations

import os
import random
from pathlib import Path
from typing import Any

import campaigns
import numpy as np
import pytest
from conftest import Program

import grouser as gr


def answers(folder: Path) -> tuple[Any, ...]:
    """What everything that reads says of a folder."""
    found = gr.campaign.results(folder)
    table = found.to_pandas()
    arrow = found.to_arrow()
    rows = [repr(found.row(run)) for run in range(len(found))]
    return (found.digest, found.summarise(), found.count(), repr(table.to_dict()), arrow, rows, found.campaign)


def test_flipped_bits_are_refused_or_change_nothing(tmp_path: Path) -> None:
    """A thousand single bits, spread by a seed over manifest, study and shards."""
    gr.campaign.run(campaigns.wheel_study(runs=12, shard_runs=4), out=tmp_path)
    before, generator = answers(tmp_path), random.Random(4711)
    files = [tmp_path / "manifest.json", tmp_path / "study.toml"]
    files += sorted((tmp_path / "runs").iterdir())
    refused = 0
    for flip in range(1000):
        file = files[flip % len(files)]
        good = file.read_bytes()
        bad, bit = bytearray(good), generator.randrange(8 * len(good))
        bad[bit // 8] ^= 1 << (bit % 8)
        file.write_bytes(bad)
        try:
            found = answers(tmp_path)
        except gr.CampaignError as error:
            assert file.name in str(error)
            refused += 1
        else:
            assert found == before, f"bit {bit} of {file}"
        file.write_bytes(good)
    # Every byte of these files is hashed.
    assert refused == 1000
    (tmp_path / ".lock").write_bytes(b"anything")
    assert answers(tmp_path) == before


def test_the_digest_is_that_of_the_shards(tmp_path: Path) -> None:
    gr.campaign.run(campaigns.wheel_study(), out=tmp_path)
    file = tmp_path / "runs" / "part-000001.parquet"
    damaged = bytearray(file.read_bytes())
    damaged[len(damaged) // 2] ^= 1
    file.write_bytes(damaged)
    with pytest.raises(gr.CampaignError, match="part-000001.parquet"):
        _ = gr.campaign.results(tmp_path).digest


def test_exchanged_and_strange_shards_are_refused(tmp_path: Path) -> None:
    gr.campaign.run(campaigns.wheel_study(), out=tmp_path)
    first, second = (tmp_path / "runs" / f"part-00000{shard}.parquet" for shard in (1, 2))
    data = first.read_bytes(), second.read_bytes()
    first.write_bytes(data[1])
    second.write_bytes(data[0])
    with pytest.raises(gr.CampaignError, match="part-000001.parquet: .*another number"):
        gr.campaign.results(tmp_path).column("load_n")
    second.write_bytes(data[1])
    first.unlink()
    first.symlink_to("/dev/zero")
    with pytest.raises(gr.CampaignError, match="not a regular file"):
        gr.campaign.results(tmp_path).count()
    first.unlink()
    os.mkfifo(first)
    with pytest.raises(gr.CampaignError, match="not a regular file"):
        gr.campaign.results(tmp_path).to_arrow()
    # Going on puts the shard in its place.
    assert gr.campaign.run(campaigns.wheel_study(), out=tmp_path).count()[0] == {"ok": 100}
    assert first.read_bytes() == data[0]


def test_urls_are_mended(tmp_path: Path) -> None:
    pytest.importorskip("fsspec")
    url, study = f"file://{tmp_path}/campaign", campaigns.wheel_study()
    digest = gr.campaign.run(study, out=url).digest
    manifest = tmp_path / "campaign" / "manifest.json"
    manifest.write_text(manifest.read_text().replace('"seed": 1', '"seed": 2'))
    with pytest.raises(gr.CampaignError, match="hash of itself is wrong"):
        gr.campaign.results(url)
    assert gr.campaign.run(study, out=url).digest == digest
    with pytest.raises(gr.CampaignError, match="seed is 1 there, 2 here"):
        gr.campaign.run(study.replace(seed=2), out=url)


BOTH = [
    {"key": "load_n", "distribution": "normal", "standard_deviation": 1.0},
    {"key": "slip_ratio", "distribution": "uniform", "low": 0.1, "high": 0.3},
    {"key": "soil.friction_angle_deg", "distribution": "normal", "standard_deviation": 2.0},
]


@pytest.mark.parametrize("sensitivity", [True, False])
@pytest.mark.parametrize("part", [None, (1, 2)])
def test_program_and_package_say_the_same(
    program: Program, tmp_path: Path, sensitivity: bool, part: tuple[int, int] | None
) -> None:
    """Number by number. With sensitivities, runs with one input exchanged are no independent ones; and shards of
    seven cut points of five in two."""
    study = campaigns.wheel_study(
        runs=64, shard_runs=7, sampling="sobol", sensitivity=sensitivity, parameter=BOTH
    )
    found = gr.campaign.run(study, out=tmp_path / "out", part=part)
    shares = (0.025, 0.25, 0.5, 0.75, 0.975)
    ours = found.summarise(quantiles=shares)
    theirs = program("campaign", "summarise", str(tmp_path / "out"))
    assert len(theirs["rows"]) == len(ours.quantities) == len(study.outputs)
    if part is None:
        assert ours.runs == (128 if sensitivity else 64)
        assert len(found) == (320 if sensitivity else 64)
    for row in theirs["rows"]:
        it = ours.quantities[row["quantity"]]
        assert (it.count, it.missing) == (row["runs"], row["runs_without"])
        pairs = [(getattr(it, name), row[name]) for name in ("mean", "mean_low", "mean_high")]
        pairs += [(it.standard_deviation, row["std"]), (it.least, row["least"])]
        pairs += [(it.most, row["most"])]
        for share, word in zip(shares, ("p2_5", "p25", "p50", "p75", "p97_5")):
            pairs += zip(it.quantiles[share], (row[word + end] for end in ("", "_low", "_high")))
        assert [our for our, _ in pairs] == [their for _, their in pairs], row["quantity"]
        steps = [step for step in theirs["convergence"] if step["quantity"] == it.name]
        assert [step["runs"] for step in steps] == [step["runs"] for step in it.convergence]
        assert [step["mean_low"] for step in steps] == [step["mean_low"] for step in it.convergence]
        medians = [{at[0]: at[1:] for at in step["quantiles"]}[0.5] for step in it.convergence]
        assert [(step["p50"], step["p50_low"], step["p50_high"]) for step in steps] == medians
    indices = {(it["quantity"], it["input"]): it for it in theirs["sensitivities"]}
    assert bool(indices) == sensitivity
    for name, it in ours.quantities.items():
        for key, values in it.sensitivity.items():
            of = indices.pop((name, key))
            assert dict(values) == {word: of[word] for word in values} and len(values) == 8
    assert not indices
    events = {it["event"]: it for it in theirs["probabilities"]}
    for word, chance in ours.status.items():
        of = events[word]
        numbers = (of["count"], of["probability"], of["probability_low"], of["probability_high"])
        assert numbers == (chance.count, chance.share, chance.low, chance.high)
        assert of["runs"] == ours.runs


def test_a_million_million_runs_are_no_list(tmp_path: Path) -> None:
    """Shards are ranges: the first one comes at once, and what is there is read at once."""

    class Enough(Exception):
        pass

    def stop(now: gr.campaign.Progress) -> None:
        raise Enough

    study = campaigns.wheel_study(runs=10**12)
    for part in (None, (1, 1000)):
        out = tmp_path / str(part is None)
        with pytest.raises(Enough):
            gr.campaign.run(study, out=out, part=part, progress=stop)
        found = gr.campaign.results(out)
        assert found.shard_count == 1 and len(found) == 10 and not found.is_finished
        assert np.array_equal(found.column("run"), np.arange(10))
        with pytest.raises(gr.CampaignError, match="is not finished"):
            found.summarise()
