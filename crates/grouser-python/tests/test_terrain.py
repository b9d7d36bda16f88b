"""Ground with heights: documents with a terrain, maps from arrays, files, rasterio and xarray, and runs on them."""

from __future__ import annotations

import copy
import pickle
import warnings
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import grouser as gr

Floats = NDArray[np.float64]
QUICK = {"simulation": "quasi-steady", "duration_s": 5.0}


def ramp(x: Any, y: Any) -> Any:
    """Ground that rises by 0.1 to the east and falls by 0.05 to the north [m]."""
    return 100.0 + 0.1 * x - 0.05 * y


def grid(rows: str = "north-first") -> Floats:
    """The ramp at 9 × 7 points, 2 m apart, from (10, 20) on."""
    x, y = 10.0 + 2.0 * np.arange(9), 20.0 + 2.0 * np.arange(7)
    heights = ramp(x, y[:, None])
    return heights if rows == "south-first" else heights[::-1]


def terrain(rows: Any = "north-first", **changes: Any) -> gr.Terrain:
    settings = {"cell_size_m": 2.0, "south_west_m": (10.0, 20.0), "rows": rows, **changes}
    return gr.Terrain(grid(rows), **settings)


# ---- documents ----


def test_a_run_on_an_incline_by_formula_stands_as_it_is_inclined() -> None:
    """Straight up 5°, from 100 m east of the origin. The rear wheels carry more, and sink by some
    tenths of a degree deeper."""
    incline = {"surface": "incline", "slope_deg": 5.0, "start_m": [100.0, 7.0]}
    run = gr.simulate(terrain=incline, **QUICK)
    assert run.pitch_deg is not None and run.roll_deg is not None
    # Steady states have sinkages to 1e-8.
    np.testing.assert_allclose(run.pitch_deg, run.pitch_deg[0], rtol=1e-8)
    assert 5.0 < run.pitch_deg[0] < 5.5
    np.testing.assert_allclose(run.roll_deg, 0.0, atol=1e-6)
    assert run.x_m[0] == 100.0 and run.y_m[0] == 7.0 and run.z_m is not None
    rise = (run.z_m[-1] - run.z_m[0]) / (run.x_m[-1] - run.x_m[0])
    assert rise == pytest.approx(np.tan(np.radians(5.0)), rel=1e-6)


def test_the_standing_of_the_rover_is_in_all_tables() -> None:
    run = gr.simulate(terrain=terrain(), **QUICK)
    xarray, pandas = pytest.importorskip("xarray"), pytest.importorskip("pandas")
    data, table = run.to_xarray(), run.to_pandas()
    assert isinstance(data, xarray.Dataset) and isinstance(table, pandas.DataFrame)
    for name, unit in {"z_m": "m", "roll_deg": "°", "pitch_deg": "°"}.items():
        np.testing.assert_array_equal(data[name], getattr(run, name))
        np.testing.assert_array_equal(table[name], getattr(run, name))
        assert data[name].units == unit
    plane = gr.simulate(**QUICK)
    assert plane.z_m is plane.roll_deg is plane.pitch_deg is None
    assert "z_m" not in plane.to_xarray()


def test_a_document_beside_its_map_drives_on_it(tmp_path: Path) -> None:
    np.save(tmp_path / "site.npy", grid())
    document = (
        'schema = "scenario/1"\nname = "survey"\nduration_s = 5\nsimulation = "quasi-steady"\n'
        '[terrain]\nfile = "site.npy"\ncell_size_m = 2\nsouth_west_m = [10, 20]\nstart_m = [12, 24]\n'
    )
    (tmp_path / "survey.toml").write_text(document)
    scenario = gr.Scenario(tmp_path / "survey.toml")
    own = {"file": terrain(), "start_m": (12, 24)}
    assert_same_run(gr.simulate(scenario), gr.simulate(scenario, terrain=own))
    # The map is carried along: nothing reads the file again.
    (tmp_path / "site.npy").unlink()
    assert list(scenario.files.values()) == [terrain()]
    moved = scenario.replace(terrain={"start_m": (14, 24)})
    assert gr.simulate(moved).x_m[0] == 14.0
    with pytest.raises(gr.DocumentNotFoundError):
        scenario.replace(terrain={"cell_size_m": 1.0})


def assert_same_run(one: gr.Trajectory, other: gr.Trajectory) -> None:
    for name in ("time_s", "x_m", "y_m", "z_m", "yaw_deg", "roll_deg", "pitch_deg", "energy_j"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))


# ---- maps ----


def test_a_map_has_the_heights_between_its_points() -> None:
    """Cubic convolution repeats a plane."""
    ground = terrain()
    x, y = np.array([[10.0], [15.3], [26.0]]), np.array([20.0, 31.9])
    np.testing.assert_allclose(ground.height_m(x, y), ramp(x, y), atol=1e-5)
    np.testing.assert_allclose(
        ground.slope_deg(x, y), np.degrees(np.arctan(np.hypot(0.1, 0.05))), rtol=1e-5
    )
    normal = np.array([-0.1, 0.05, 1.0]) / np.sqrt(1.0125)
    np.testing.assert_allclose(ground.normal(x, y), np.broadcast_to(normal, (3, 2, 3)), atol=1e-5)
    assert ground.normal(15.0, 25.0).shape == (3,)
    assert np.isnan(ground.height_m([9.9, np.nan], 25.0)).all()
    assert ground.shape == (7, 9) and ground.extent_m == (10.0, 20.0, 26.0, 32.0)
    assert ground.cell_size_m == (2.0, 2.0) and ground.missing_count == 0
    np.testing.assert_allclose(ground.heights_m, grid("south-first"), atol=1e-6)


def test_rows_come_from_the_north_or_from_the_south() -> None:
    assert terrain("south-first") == terrain("north-first")
    assert terrain("south-first") != gr.Terrain(
        grid(), cell_size_m=2.0, south_west_m=(10.0, 20.0), rows="south-first"
    )


def test_missing_heights_are_nan_or_masked() -> None:
    heights = grid().copy()
    heights[3, 4] = np.nan
    by_nan = gr.Terrain(heights, cell_size_m=2.0, south_west_m=(10.0, 20.0))
    masked = np.ma.masked_invalid(heights)
    assert by_nan == gr.Terrain(masked, cell_size_m=2.0, south_west_m=(10.0, 20.0))
    assert by_nan.missing_count == 1 and np.isnan(by_nan.heights_m).sum() == 1
    assert np.isnan(by_nan.height_m(18.5, 26.5)) and not np.isnan(by_nan.height_m(21.0, 26.5))
    assert by_nan != terrain()
    # What planetary formats write.
    heights[3, 4] = -3.4028226550889045e38
    assert by_nan == gr.Terrain(heights, cell_size_m=2.0, south_west_m=(10.0, 20.0))


@pytest.mark.parametrize(
    ("heights", "settings", "message"),
    [
        (np.zeros(5), {"cell_size_m": 1.0}, "two axes"),
        (np.zeros((1, 5)), {"cell_size_m": 1.0}, "too few"),
        (np.zeros((3, 3)), {"cell_size_m": 0.0}, "above zero"),
        (np.zeros((3, 3)), {"cell_size_m": (1.0, 2.0, 3.0)}, "pair"),
        (np.full((3, 3), np.nan), {"cell_size_m": 1.0}, "missing|known"),
        (np.zeros((3, 3)), {"cell_size_m": 1.0, "rows": "up"}, "north-first"),
        (np.zeros((3, 3)), {"cell_size_m": 1.0, "south_west_m": (np.inf, 0.0)}, "finite"),
    ],
)
def test_what_is_no_map_is_refused(heights: Any, settings: Any, message: str) -> None:
    with pytest.raises(gr.ParameterError, match=message):
        gr.Terrain(heights, **settings)


def test_maps_are_pickled_to_the_bit() -> None:
    heights = grid() + 0.123456789
    heights[0, 0] = np.nan
    ground = gr.Terrain(heights, cell_size_m=(2.0, 1.5))
    again = pickle.loads(pickle.dumps(ground))
    assert again == ground and hash(again) == hash(ground)
    scenario = gr.Scenario(terrain={"file": ground, "start_m": (8.0, 4.0)}, **QUICK)
    twin = pickle.loads(pickle.dumps(scenario))
    assert twin == scenario and copy.deepcopy(scenario) == scenario
    assert_same_run(gr.simulate(twin), gr.simulate(scenario))
    assert gr.Scenario.from_toml(scenario.to_toml(), scenario.files) == scenario


def test_a_file_is_the_map_that_its_document_names(tmp_path: Path) -> None:
    np.save(tmp_path / "site.npy", grid())
    ground = gr.Terrain.from_file(tmp_path / "site.npy", cell_size_m=2.0, south_west_m=(10.0, 20.0))
    assert ground == terrain()
    scenario = gr.Scenario(terrain={"file": ground, "start_m": (12.0, 24.0)}, **QUICK)
    assert scenario.terrain["file"] == str(tmp_path / "site.npy")
    # The text alone is enough, for the program too.
    assert_same_run(gr.simulate(gr.Scenario.from_toml(scenario.to_toml())), gr.simulate(scenario))
    # And so is what is pickled, without the file.
    frozen = pickle.dumps(scenario)
    (tmp_path / "site.npy").unlink()
    assert_same_run(gr.simulate(pickle.loads(frozen)), gr.simulate(scenario))


def test_a_file_that_is_no_map_is_refused(tmp_path: Path) -> None:
    with pytest.raises(gr.DocumentNotFoundError):
        gr.Terrain.from_file(tmp_path / "none.npy")
    np.save(tmp_path / "site.npy", grid())
    with pytest.raises(gr.DocumentError, match="cell_size_m") as caught:
        gr.Terrain.from_file(tmp_path / "site.npy")
    assert "terrain." not in str(caught.value)


def test_the_map_is_drawn_where_it_lies() -> None:
    """The missing corner in the south-west is left out of the relief, whose first row is northern."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    heights = grid("south-first").copy()
    heights[0, 0] = np.nan
    ground = gr.Terrain(heights, cell_size_m=2.0, south_west_m=(10.0, 20.0), rows="south-first")
    [image] = ground.plot().images
    assert tuple(image.get_extent()) == (9.0, 27.0, 19.0, 33.0)
    assert np.argwhere(np.ma.getmaskarray(image.get_array())).tolist() == [[6, 0]]


# ---- runs ----


def test_runs_and_missions_of_every_kind_take_a_map() -> None:
    place = {"file": terrain(), "start_m": (12.0, 24.0)}
    scenario = gr.Scenario(terrain=place, **QUICK)
    run = gr.simulate(scenario)
    ends = gr.rollout([scenario, gr.Scenario(**QUICK)], trajectories=True)
    assert ends.x_m[0] == run.x_m[-1] and ends.z_m is not None and run.z_m is not None
    assert ends.z_m[0] == run.z_m[-1] and np.isnan(ends.z_m[1])
    assert ends.records is not None and ends.records["pitch_deg"].shape[0] == 2
    stepped = gr.Run(scenario, commands="rim_speed_m_s")
    state = dict(zip(stepped.STATE, stepped.step(0.06, 1.0)))
    assert state["x_m"] > 12.0
    driven = gr.mission(
        gr.Mission(
            leg=[{"goto": {"x_m": 12.5, "y_m": 24.0}}], terrain=place, simulation="quasi-steady"
        )
    )
    assert (
        driven.final["x_m"] == pytest.approx(12.5, abs=0.11) and driven.trajectory.z_m is not None
    )
    assert gr.Mission("there-and-back", terrain=place).scenario.terrain["start_m"] == (12.0, 24.0)


def test_a_map_alone_starts_in_its_middle_and_takes_the_place_of_other_ground() -> None:
    middle = gr.simulate("traverse-10-deg", terrain=terrain(), **QUICK)
    assert (middle.x_m[0], middle.y_m[0]) == (18.0, 26.0)
    crater = {"surface": "cone", "slope_deg": 5.0, "start_m": [3.0, 0.0]}
    on_cone = gr.Scenario(terrain=crater, **QUICK)
    on_map = on_cone.replace(terrain=terrain())
    assert "start_m" not in on_map.terrain and on_map.terrain["surface"] == "map"


def test_a_map_in_memory_has_its_own_cell_size() -> None:
    scenario = gr.Scenario(terrain=terrain())
    with pytest.raises(gr.ParameterError, match="a map in memory has this already"):
        scenario.replace(terrain={"cell_size_m": 1.0})
    with pytest.raises(gr.ParameterError, match="on the map"):
        scenario.replace(terrain={"start_m": (0.0, 0.0)})


def test_rules_between_keys_hold_where_numbers_are_exchanged() -> None:
    rover = gr.Run(terrain=terrain(), **QUICK)
    for exchange in (
        lambda: rover.reset(slope_deg=8.0),
        lambda: gr.rollout(rover.scenario, slope_deg=[0.0, 8.0]),
        lambda: rover.scenario.replace(slope_deg=8.0),
    ):
        with pytest.raises(gr.ParameterError, match=r"`slope_deg`, beside a `\[terrain\]`, is 8"):
            exchange()
    np.testing.assert_array_equal(rover.reset(slope_deg=0.0), rover.reset())
    placed = gr.Scenario(terrain={"file": terrain(), "start_m": (12.0, 24.0)}, **QUICK)
    with pytest.raises(gr.ParameterError, match=r"x of `terrain.start_m`, on a map from 10 to 26 m"):
        gr.rollout(placed, vary={"terrain.start_m.0": [12.0, 99.0]})


def test_a_campaign_reads_its_map_from_a_file(tmp_path: Path) -> None:
    spread = {"key": "soil.friction_angle_deg", "distribution": "uniform", "low": 36.0, "high": 38.0}
    settings: dict[str, Any] = {"runs": 2, "parameter": [spread]}
    on_array = gr.Scenario(terrain=terrain(), **QUICK)
    with pytest.raises(gr.ParameterError, match=r"(?s)the map is an array.*numpy.save"):
        gr.Campaign(study="traverse", scenario=on_array, **settings)
    np.save(tmp_path / "site.npy", terrain().heights_m[::-1])
    place = {"cell_size_m": 2.0, "south_west_m": (10.0, 20.0)}
    on_file = on_array.replace(terrain=gr.Terrain.from_file(tmp_path / "site.npy", **place))
    study = gr.Campaign(study="traverse", scenario=on_file, **settings)
    assert pickle.loads(pickle.dumps(study)) == study
    assert gr.campaign.run(study, out=tmp_path / "runs").is_finished
    with pytest.raises(gr.ParameterError, match="headings are of planes"):
        gr.Campaign(study="heading", scenario=on_file, **settings)


# ---- rasterio ----


#: The Moon, as well-known text has it.
GLOBE = (
    'GEOGCS["Moon",DATUM["Moon",SPHEROID["Moon",1737400,0]],PRIMEM["Reference",0],'
    'UNIT["degree",0.0174532925199433]]'
)


def system(unit_m: float, *, latitude: float = -90.0, heights: float | None = None) -> str:
    """A stereographic projection of the Moon about its pole, true to scale at a latitude."""
    text = (
        f'PROJCS["site",{GLOBE},PROJECTION["Polar_Stereographic"],'
        f'PARAMETER["latitude_of_origin",{latitude}],PARAMETER["central_meridian",0],'
        f'PARAMETER["false_easting",0],PARAMETER["false_northing",0],UNIT["own",{unit_m}]]'
    )
    if heights is None:
        return text
    return f'COMPD_CS["site",{text},VERT_CS["up",VERT_DATUM["up",2005],UNIT["own",{heights}]]]'


def dataset(heights: Any = None, transform: Any = None, **settings: Any) -> Any:
    """What rasterio gives of an open file, as far as it is looked at."""
    heights = np.ma.asarray(grid() if heights is None else heights)
    given = {
        "crs": SimpleNamespace(to_wkt=lambda: system(1.0)),
        "transform": transform or (2.0, 0.0, 9.0, 0.0, -2.0, 33.0, 0.0, 0.0, 1.0),
        "read": lambda band, masked: heights,
        "scales": (1.0,),
        "offsets": (0.0,),
        "units": (None,),
        **settings,
    }
    return SimpleNamespace(**given)


def test_a_dataset_of_rasterio_is_its_map() -> None:
    assert gr.Terrain.from_rasterio(dataset()) == terrain()
    southern = dataset(grid("south-first"), (2.0, 0.0, 9.0, 0.0, 2.0, 19.0))
    assert gr.Terrain.from_rasterio(southern) == terrain()
    assert gr.Terrain.from_rasterio(dataset(crs=None)) == terrain()
    stored = dataset((grid() - 100.0) * 4.0, scales=(0.25,), offsets=(100.0,))
    np.testing.assert_allclose(
        gr.Terrain.from_rasterio(stored).heights_m, terrain().heights_m, atol=1e-5
    )
    heights = np.ma.masked_less(grid(), 99.6)
    found = gr.Terrain.from_rasterio(dataset(heights))
    assert found.missing_count == heights.mask.sum() > 0


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"transform": (2.0, 0.1, 9.0, 0.0, -2.0, 33.0)}, "gdalwarp"),
        ({"transform": (-2.0, 0.0, 9.0, 0.0, -2.0, 33.0)}, "mirrored"),
        ({"crs": SimpleNamespace(to_wkt=lambda: GLOBE)}, "degrees(.|\n)*gdalwarp"),
        ({"crs": SimpleNamespace(to_wkt=lambda: system(0.3048))}, "feet"),
        ({"crs": SimpleNamespace(to_wkt=lambda: system(1.0, heights=0.3048))}, "heights.*feet"),
        (
            {"crs": SimpleNamespace(to_wkt=lambda: system(1.0, latitude=-60.0))},
            "has 0.93[0-9]* m in place",
        ),
        ({"units": ("ft",)}, "metres"),
    ],
)
def test_a_dataset_that_is_no_map_in_metres_is_refused(settings: Any, message: str) -> None:
    with pytest.raises(gr.ParameterError, match=message):
        gr.Terrain.from_rasterio(dataset(**settings))


def test_odd_heights_are_warned_of(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        terrain()
    void = np.add.outer(0.013 * np.arange(40.0), 0.1 * np.arange(40.0))
    void[10:14, 10:14] = -9999.0
    message = "16 cells of -9999 m are .* below all others: missing heights"
    with pytest.warns(UserWarning, match=message):
        gr.Terrain(void, cell_size_m=1.0)
    with pytest.warns(UserWarning, match=message):
        gr.Terrain.from_rasterio(dataset(void))
    lines = [f"{x} {y} {void[y, x]}" for y in range(40) for x in range(40)]
    (tmp_path / "void.xyz").write_text("\n".join(lines))
    with pytest.warns(UserWarning, match=message):
        gr.Terrain.from_file(tmp_path / "void.xyz")
    with pytest.warns(UserWarning, match="missing heights"):
        gr.Scenario(terrain={"file": str(tmp_path / "void.xyz")})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert gr.Terrain.from_file(tmp_path / "void.xyz", missing_m=-9999.0).missing_count == 16


def written(path: Path) -> gr.Terrain:
    """A file of rasterio's with a missing height, in a projection of the Moon; and its map."""
    rasterio = pytest.importorskip("rasterio")
    heights = grid().astype(np.float32)
    heights[2, 3] = -9999.0
    settings = {
        "width": 9,
        "height": 7,
        "count": 1,
        "dtype": "float32",
        "nodata": -9999.0,
        "crs": "+proj=stere +lat_0=-90 +lon_0=0 +R=1737400 +units=m +no_defs",
        "transform": rasterio.Affine(2.0, 0.0, 9.0, 0.0, -2.0, 33.0),
    }
    with rasterio.open(path, "w", driver="GTiff", **settings) as file:
        file.write(heights, 1)
    with rasterio.open(path) as file:
        return gr.Terrain.from_rasterio(file)


#: Of affine's operators, which rasterio uses.
PENDING = pytest.mark.filterwarnings("ignore::PendingDeprecationWarning")


@PENDING
def test_rasterio_itself_gives_the_map_that_we_read(tmp_path: Path) -> None:
    found = written(tmp_path / "site.tif")
    assert found.missing_count == 1 and found.extent_m == terrain().extent_m
    assert found == gr.Terrain.from_file(tmp_path / "site.tif")


@PENDING
def test_rioxarray_gives_the_same_map(tmp_path: Path) -> None:
    found = written(tmp_path / "site.tif")
    rioxarray = pytest.importorskip("rioxarray")
    with rioxarray.open_rasterio(tmp_path / "site.tif") as array:
        assert gr.Terrain.from_xarray(array) == found
    with rioxarray.open_rasterio(tmp_path / "site.tif", masked=True) as array:
        assert gr.Terrain.from_xarray(array) == found
        with pytest.raises(gr.ParameterError, match="degrees"):
            gr.Terrain.from_xarray(array.rio.write_crs("EPSG:4326"))


# ---- xarray ----


def array(rows: str = "north-first", **settings: Any) -> Any:
    xarray = pytest.importorskip("xarray")
    x, y = 10.0 + 2.0 * np.arange(9), 20.0 + 2.0 * np.arange(7)
    coords = {"y": y if rows == "south-first" else y[::-1], "x": x}
    return xarray.DataArray(grid(rows), dims=("y", "x"), coords=coords, **settings)


def test_an_array_of_xarray_is_its_map() -> None:
    for rows in ("north-first", "south-first"):
        assert gr.Terrain.from_xarray(array(rows)) == terrain()
        assert gr.Terrain.from_xarray(array(rows).transpose("x", "y")) == terrain()
        assert gr.Terrain.from_xarray(array(rows).expand_dims("band")) == terrain()
        assert gr.Terrain.from_xarray(array(rows)[:, ::-1]) == terrain()
    missing = array(attrs={"_FillValue": -1.0})
    missing[3, 4] = -1.0
    assert gr.Terrain.from_xarray(missing).missing_count == 1


def test_an_array_of_xarray_that_is_no_map_in_metres_is_refused() -> None:
    with pytest.raises(gr.ParameterError, match="from_xarray"):
        gr.Terrain(array(), cell_size_m=1.0)
    with pytest.raises(gr.ParameterError, match="rename"):
        gr.Terrain.from_xarray(array().rename(x="easting", y="northing"))
    with pytest.raises(gr.ParameterError, match="degrees of longitude"):
        gr.Terrain.from_xarray(array().rename(x="lon", y="lat"))
    with pytest.raises(gr.ParameterError, match="evenly"):
        gr.Terrain.from_xarray(array().isel(x=[0, 1, 3, 4]))
    degrees = array()
    degrees.x.attrs["units"] = "degrees_east"
    with pytest.raises(gr.ParameterError, match="degrees"):
        gr.Terrain.from_xarray(degrees)
    feet = array(attrs={"units": "ft"})
    with pytest.raises(gr.ParameterError, match="metres"):
        gr.Terrain.from_xarray(feet)
