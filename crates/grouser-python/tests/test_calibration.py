"""Calibration: a known truth is found, the program has the same results, the soil can be used."""

from __future__ import annotations

import pickle
import sys
import types
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Program
from test_same_bits import same

import grouser as gr

#: Toyoura sand with two keys searched from elsewhere, and what they are.
START = {"shear": {"longitudinal_m": 0.1}, "pressure_sinkage": {"k_phi": 60.0}}
FIT = ["pressure_sinkage.k_phi", "soil.shear.longitudinal_m"]
TRUTH = np.array([122.727, 0.036])


@pytest.fixture(scope="module")
def stand_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A stand that reads the HAKUTO wheel on Toyoura sand: 8 settings three times each."""
    test = gr.wheel_test(
        load_n=20, slip_ratio=[0.0, 0.2, 0.4, 0.6], slip_angle_deg=[0, 15], trials=3
    )
    path = tmp_path_factory.mktemp("stand") / "test.csv"
    test.to_pandas().to_csv(path, index=False)
    return path


@pytest.fixture(scope="module")
def found(stand_file: Path) -> gr.Calibration:
    soil = gr.Soil("toyoura", **START)
    return gr.calibrate(stand_file, soil, "hakuto", fit=FIT, steps=100, cross_validate=True)


@pytest.fixture(scope="module")
def plates_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Bekker's law with k_c = 1000, k_phi = 5e5, n = 1.1, read to a hundredth of a kilopascal."""
    path = tmp_path_factory.mktemp("plates") / "plates.csv"
    lines = ["plate_width_mm,sinkage_mm,pressure_kpa"]
    for width in (50, 100):
        for sinkage in range(5, 45, 5):
            kpa = (1000.0 / (width * 1e-3) + 5e5) * (sinkage * 1e-3) ** 1.1 * 1e-3
            lines.append(f"{width},{sinkage},{kpa:.2f}")
    path.write_text("\n".join(lines) + "\n")
    return path


def test_the_truth_is_found_within_its_uncertainty(found: gr.Calibration) -> None:
    """Four standard errors: one try in ten thousand misses by more, and the noise is seeded."""
    assert found.key == ("soil.pressure_sinkage.k_phi", "soil.shear.longitudinal_m")
    assert (np.abs(found.fit - TRUTH) < 4 * found.fit_std).all()
    assert found.best == dict(zip(found.key, found.fit.tolist()))
    assert found.unidentifiable == () and found.searches_that_agree >= 2
    assert found.samples is not None and found.samples.shape[1] == 2
    np.testing.assert_allclose(found.samples.mean(axis=0), found.mean, rtol=1e-12)
    np.testing.assert_allclose(np.corrcoef(found.samples.T), found.correlations, atol=1e-12)
    assert found.proposals is not None
    assert (found.proposals["std_after"] < found.proposals["std_before"]).all()
    assert len(found.cross_validation) == 2 and found.validation is not None
    assert found.outcome in ("determined", "not_converged")
    assert (found.message is None) == (found.outcome == "determined")


def own_effective_samples(chains: Any) -> float:
    """Samples over Sokal's integrated autocorrelation time, with lags counted along each chain and
    deviations from the mean of all, as docs/guide/calibration.md writes it."""
    away = chains - chains.mean()
    variance, steps, time = (away**2).sum() / (away.size - 1), chains.shape[1], 1.0
    for lag in range(1, steps // 2):
        time += 2.0 * (away[:, :-lag] * away[:, lag:]).mean() / variance
        if lag >= 5.0 * time:
            break
    return float(chains.size / max(time, 1.0))


def own_r_hat(chains: Any, walkers: int) -> float:
    """Split R-hat of the ensembles."""
    ensembles = chains.reshape(-1, walkers, chains.shape[1])
    middle = chains.shape[1] // 2
    halves = [half.ravel() for it in ensembles for half in (it[:, :middle], it[:, middle:])]
    within = np.mean([half.var(ddof=1) for half in halves])
    between = np.var([half.mean() for half in halves], ddof=1)
    n = ensembles[0].size // 2
    return float(np.sqrt((within * (n - 1) / n + between) / within))


def test_chains_say_of_themselves_what_the_library_says(found: gr.Calibration) -> None:
    """R-hat and effective samples from the chains alone. Taken flat, as one chain in the order of
    the samples, they would look several times as good."""
    chains, samples, sampler = found.chains, found.samples, found.sampler
    assert chains is not None and samples is not None and sampler is not None
    walkers = sampler["walkers"]
    assert chains.shape == (sampler["ensembles"] * walkers, chains.shape[1], len(found.key))
    for k in range(len(found.key)):
        assert np.sort(chains[..., k].ravel()).tobytes() == np.sort(samples[:, k]).tobytes()
        own = own_effective_samples(chains[..., k])
        assert own == pytest.approx(found.effective_samples[k], rel=1e-9)
        assert own_r_hat(chains[..., k], walkers) == pytest.approx(found.r_hat[k], rel=1e-9)
        assert own_effective_samples(samples[None, :, k]) > 2.0 * own
    # The first walker's second step is one row of all walkers further on.
    assert (chains[0, 1] == samples[walkers]).all() and (chains[1, 0] == samples[1]).all()
    data = found.to_xarray()
    assert data["chains"].dims == ("chain", "draw", "key")
    assert data["ensemble"].values[[0, walkers - 1, walkers]].tolist() == [0, 0, 1]


def check_same_as_program(found: gr.Calibration, answer: dict[str, Any]) -> None:
    assert list(found.key) == [row["key"] for row in answer["rows"]]
    table = found.to_pandas()
    for name in answer["rows"][0].keys() - {"key"}:
        assert same(table[name].to_numpy(), answer["rows"], name), name
    assert found.sampler == answer["sampler"]
    assert list(found.unidentifiable) == answer["unidentifiable"]
    assert same(found.discrepancies["std"], answer["discrepancies"], "std")
    lengths = answer.get("correlation_lengths", [])
    assert same(found.correlation_lengths.get("mean", []), lengths, "mean")
    assert found.cross_validation_overall == answer.get("cross_validation_overall")


def test_wheel_tests_as_the_program_has_them(
    program: Program, found: gr.Calibration, stand_file: Path, tmp_path: Path
) -> None:
    answer = program(
        "calibrate", "--data", str(stand_file), "--wheel", "hakuto", "--soil", "toyoura",
        "--set", "soil.shear.longitudinal_m=0.1", "--set", "soil.pressure_sinkage.k_phi=60",
        "--fit", "soil.pressure_sinkage.k_phi,soil.shear.longitudinal_m", "--steps", "100",
        "--cross-validate", "--out", str(tmp_path / "fit"),
    )  # fmt: skip
    check_same_as_program(found, answer)
    assert found.validation is not None and found.validation.overall == answer["overall"]
    assert list(found.cross_validation) == answer["cross_validation"]
    assert found.proposals is not None and found.target == answer["target"]
    for name in answer["proposals"][0]:
        assert same(found.proposals[name], answer["proposals"], name), name
    folder = tmp_path / "fit"
    assert found.soil.files == {
        "soil-samples.csv": (folder / "soil-samples.csv").read_text(encoding="utf-8")
    }
    assert gr.Soil(folder / "soil.toml") == found.soil
    table = found.to_pandas()
    assert table.columns.tolist() == list(answer["rows"][0])


def test_plate_tests_as_the_program_has_them(program: Program, plates_file: Path) -> None:
    answer = program(
        "calibrate", "--plates", str(plates_file), "--plate-law", "bekker", "--soil", "dry-sand",
        "--steps", "100", "--seed", "7",
    )  # fmt: skip
    found = gr.calibrate_plates(plates_file, "dry-sand", plate_law="bekker", steps=100, seed=7)
    check_same_as_program(found, answer)
    assert found.curves is not None
    measured, fitted = found.curves["measured_pressure_kpa"], found.curves["pressure_kpa"]
    # The readings are rounded to 0.01 kPa, and there is no other noise.
    assert np.abs(measured - fitted).max() < 0.02


def test_shear_tests_as_the_program_has_them(program: Program, plates_file: Path) -> None:
    answer = program(
        "calibrate", "--shear", "cullinan-shear", "--plates", str(plates_file), "--plate-law", "bekker",
        "--soil", "dry-sand", "--steps", "100", "--seed", "7",
    )  # fmt: skip
    found = gr.calibrate_plates(
        plates_file, "dry-sand", shear="cullinan-shear", plate_law="bekker", steps=100, seed=7
    )
    check_same_as_program(found, answer)
    assert found.shear_curves is not None and found.curves is not None
    alone = gr.calibrate_shear("cullinan-shear", "dry-sand", point_fit=True)
    assert alone.curves is None and alone.shear_curves is not None
    assert alone.shear_curves["normal_stress_kpa"].tolist() == [93.0] * 50
    # One normal stress leaves cohesion and friction angle open.
    assert any("one normal stress" in reason for reason in alone.unidentifiable)


def test_a_wheel_without_stiffness_under_it_is_refused() -> None:
    """k_c/b + k_phi is above zero from b = 0.1 m on; HAKUTO's wheel is 0.08 m wide."""
    soil = gr.Soil(
        "toyoura",
        pressure_sinkage={"law": "bekker", "k_c": -1e5, "k_phi": 1e6, "n": 1.1},
        domain={"width_m": [0.12, 0.2]},
    )
    with pytest.raises(gr.ParameterError, match="width b of 0.08 m"):
        gr.wheel_test(soil, "hakuto", load_n=[17.0], slip_ratio=[0.1])
    with pytest.raises(gr.ParameterError, match="width b of 0.08 m"):
        gr.settle(soil, "hakuto", load_n=[17.0], slip_ratio=[0.1])


def test_a_point_fit_has_no_samples(stand_file: Path) -> None:
    soil = gr.Soil("toyoura", **START)
    bounds = {"shear.longitudinal_m": (0.001, 0.2), "pressure_sinkage.k_phi": None}
    fit = gr.calibrate(stand_file, soil, "hakuto", fit=bounds, point_fit=True)
    assert (
        fit.samples is None
        and fit.chains is None
        and fit.sampler is None
        and np.isnan(fit.r_hat).all()
    )
    assert (fit.lower[0], fit.upper[0]) == (0.001, 0.2)
    assert not fit.soil.files and "fitted by Grouser" in fit.soil.source
    with pytest.raises(gr.ParameterError, match="no posterior samples"):
        fit.plot_corner()


def test_its_soil_is_a_description_with_uncertainty(found: gr.Calibration) -> None:
    soil = found.soil
    assert soil.uncertainty["samples"] in soil.files
    assert soil.shear["longitudinal_m"] == found.fit[1]
    level = gr.heading(soil=soil, slope_deg=10.0, samples=20)
    assert level.band is not None and level.band.draws == 20
    run = gr.Scenario(soil=soil)
    for one in (soil, run, run.site):
        again = pickle.loads(pickle.dumps(one))
        assert again == one and hash(again) == hash(one) and again.files == soil.files
        assert type(one).from_toml(one.to_toml(), one.files) == one
        assert one.replace() == one
    assert run.soil == soil == run.site.soil == gr.Scenario(site=gr.Site(soil)).soil
    assert gr.Scenario().replace(soil=soil) != gr.Scenario()
    assert gr.Scenario().replace(soil=soil).soil.files == soil.files
    firm = soil.replace(density_kg_m3=1600.0)
    assert firm.files == soil.files and firm != soil
    # A text alone does not have the samples, and says so.
    for alone in (lambda: gr.Soil(soil.to_dict()), lambda: gr.Soil.from_toml(soil.to_toml())):
        with pytest.raises(gr.DocumentNotFoundError, match=r"soil-samples\.csv"):
            alone()


def test_tables_and_pictures(found: gr.Calibration, plates_file: Path) -> None:
    import matplotlib.pyplot as plt

    data = found.to_xarray()
    assert data.samples.dims == ("sample", "key") and data.unit.values.tolist() == ["", "m"]
    assert data.fit.sel(key="soil.shear.longitudinal_m") == found.fit[1]
    plates = gr.calibrate_plates(plates_file, "dry-sand", plate_law="bekker", point_fit=True)
    shear = gr.calibrate_shear("cullinan-shear", "dry-sand", point_fit=True)
    for result in (found, plates, shear):
        axes = plt.subplots()[1]
        assert result.plot(axes) is axes and axes.get_xlabel()
        assert result.plot() is not axes
        assert repr(result).startswith("<Calibration")
    cells = found.plot_corner()
    assert cells.shape == (2, 2) and found.plot_corner(cells) is cells
    with pytest.raises(gr.ParameterError, match="axes"):
        found.plot_corner(cells[:1])
    plt.close("all")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"fit": "shear.longitud_m"}, "did you mean"),
        ({"fit": {"shear.longitudinal_m": (0.05, 0.01)}}, "bounds must rise"),
        ({"fit": {"shear.longitudinal_m": 3}}, "two numbers"),
        ({"fit": []}, "no parameter"),
        ({"fit": 3}, "names of keys"),
        ({"steps": 10}, "steps is 10, it must be from 100"),
        ({"steps": 200.0}, "whole number"),
        ({"seed": -1}, "seed is -1"),
        ({"target": "nothing"}, "target: 'nothing' is none of drawbar_pull_n"),
        ({"candidate_slip_ratio": [3.0]}, "candidate_slip_ratio is 3, it must be from -2 to 2"),
        ({"candidate_load_n": np.arange(1.0, 1000.0)}, "settings"),
        ({"where": "slip_angle_deg=0", "cross_validate": True}, "all trials are at one"),
        ({"where": "nothing"}, "where|column"),
    ],
)
def test_what_cannot_be_asked_says_what_can(
    stand_file: Path, arguments: dict[str, Any], message: str
) -> None:
    with pytest.raises(gr.ParameterError, match=message):
        gr.calibrate(stand_file, "toyoura", "hakuto", **{"fit": FIT, "steps": 100, **arguments})


def stand_files_that_cannot_be_used(tmp_path: Path, plates_file: Path) -> None:
    with pytest.raises(FileNotFoundError):
        gr.calibrate(tmp_path / "none.csv", "toyoura", "hakuto", fit=FIT)
    with pytest.raises(FileNotFoundError):
        gr.calibrate_plates(tmp_path / "none.csv", "toyoura")
    with pytest.raises(gr.DocumentError):
        gr.calibrate(plates_file, "toyoura", "hakuto", fit=FIT)
    with pytest.raises(gr.ParameterError, match="plate_law"):
        gr.calibrate_plates(plates_file, "toyoura", plate_law="mohr")


def test_arviz_gets_walkers_or_ensembles(found: gr.Calibration, monkeypatch: pytest.MonkeyPatch) -> None:
    """A stand-in for ArviZ of either kind: what it is given are the samples, in the order of chains."""
    given: dict[str, Any] = {}
    old = types.SimpleNamespace(__version__="0.21.0", from_dict=lambda posterior: posterior)
    new = types.SimpleNamespace(__version__="1.1.0", from_dict=lambda groups: groups["posterior"])
    assert found.chains is not None and found.samples is not None and found.sampler is not None
    for module in (old, new):
        monkeypatch.setitem(sys.modules, "arviz", module)
        given = found.to_arviz()
        assert tuple(given) == found.key
        assert np.array_equal(given[found.key[0]], found.chains[..., 0])
        ensembles = found.to_arviz(by="ensemble")[found.key[-1]]
        assert ensembles.shape[0] == found.sampler["ensembles"]
        assert np.array_equal(ensembles.ravel(), found.samples[:, -1])
    monkeypatch.setitem(sys.modules, "arviz", None)
    with pytest.raises(ImportError, match="pip install arviz"):
        found.to_arviz()
    with pytest.raises(gr.ParameterError, match="by is 'chain'"):
        found.to_arviz(by="chain")  # type: ignore[arg-type]


@pytest.mark.filterwarnings("ignore:More chains")
def test_arviz_itself_finds_our_diagnostics(found: gr.Calibration) -> None:
    """R-hat of the ensembles is ours. Ten steps of each walker are few for ArviZ's effective sizes: they are
    fewer than the samples, whose neighbours depend on each other."""
    arviz = pytest.importorskip("arviz")
    r_hat = arviz.rhat(found.to_arviz(by="ensemble"), method="split")
    sizes = arviz.ess(found.to_arviz(), method="mean")
    for k, key in enumerate(found.key):
        assert float(r_hat[key]) == pytest.approx(found.r_hat[k], abs=5e-3)
        assert found.samples is not None and 0.0 < float(sizes[key]) < len(found.samples)
