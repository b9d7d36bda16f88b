"""What maps mean, by every reader alike: files of many kinds, by file, rasterio, xarray and text."""

from __future__ import annotations

import json
import pickle
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import grouser as gr

rasterio = pytest.importorskip("rasterio")
rioxarray = pytest.importorskip("rioxarray")

#: Of affine's operators, which rasterio uses; and of files that have no place.
pytestmark = [
    pytest.mark.filterwarnings("ignore::PendingDeprecationWarning"),
    pytest.mark.filterwarnings("ignore::rasterio.errors.NotGeoreferencedWarning"),
]

UTM = "EPSG:32633"
#: Twenty rows of thirty points, 2 m apart.
PLACE = (2.0, 0.0, 500_000.0, 0.0, -2.0, 5_200_040.0)
FIXTURES = Path(__file__).parents[2] / "grouser-raster/tests/fixtures"


def ground() -> Any:
    """Rolling ground between 102 and 118 m, from north to south."""
    x, y = np.meshgrid(np.arange(30.0), np.arange(20.0))
    return 110.0 + 5.0 * np.sin(0.23 * x) + 3.0 * np.cos(0.31 * y)


def write(path: Path, heights: Any = None, **settings: Any) -> Path:
    """A file of rasterio's."""
    heights = np.asarray(ground() if heights is None else heights)
    bands = heights if heights.ndim == 3 else heights[None]
    scale, offset, unit, mask, env = (
        settings.pop(name, None) for name in ("scale", "offset", "unit", "mask", "env")
    )
    place = settings.pop("transform", PLACE)
    profile = {
        "driver": "GTiff",
        "count": len(bands),
        "height": bands.shape[1],
        "width": bands.shape[2],
        "dtype": bands.dtype.name,
        "crs": UTM,
        **settings,
    }
    if place is not None:
        profile["transform"] = rasterio.Affine(*place)
    with rasterio.Env(**(env or {})), rasterio.open(path, "w", **profile) as file:
        file.write(bands)
        if scale is not None:
            file.scales = (scale,) * len(bands)
        if offset is not None:
            file.offsets = (offset,) * len(bands)
        if unit is not None:
            file.units = (unit,) * len(bands)
        if mask is not None:
            file.write_mask(mask)
    return path


# ---- files that both read ----


def shown() -> Any:
    """A mask with a hole of 2 × 3 cells."""
    mask = np.full((20, 30), 255, np.uint8)
    mask[7:9, 11:14] = 0
    return mask


def holed(missing: float, dtype: str) -> Any:
    """The ground with the hole as a number."""
    return np.where(shown() == 0, missing, ground()).astype(dtype)


Write = Callable[[Path], Path]


def plain(dtype: str, **settings: Any) -> Write:
    return lambda path: write(path, ground().astype(dtype), **settings)


def with_notes(notes: str, heights: Any = None, **settings: Any) -> Write:
    """A file with GDAL's notes beside it."""

    def written(path: Path) -> Path:
        write(path, heights, **settings)
        beside = path.with_name(path.name + ".aux.xml")
        beside.write_text(f"<PAMDataset>{notes}</PAMDataset>")
        return path

    return written


def with_world(path: Path) -> Path:
    """A file whose place lies beside it."""
    write(path, ground().astype("float32"), transform=None, crs=None)
    path.with_suffix(".tfw").write_text("2\n0\n0\n-2\n500001\n5200039\n")
    return path


BANDS = np.stack([ground() - 50.0, ground(), ground() + 50.0]).astype("float32")
SMALL = ((ground() - 100.0) / 0.01).astype("int16")
TILED = {"tiled": True, "blockxsize": 16, "blockysize": 16}
NOTED = f"<SRS>{rasterio.crs.CRS.from_epsg(32633).to_wkt()}</SRS>".replace('"', "&quot;")
TRANSFORM = "<GeoTransform>500000.0, 2.0, 0.0, 5200040.0, 0.0, -2.0</GeoTransform>"
OF_BAND = '<PAMRasterBand band="1">{}</PAMRasterBand>'

READ: dict[str, tuple[Write, int | None]] = {
    **{name: (plain(name), None) for name in ("float32", "float64", "int16", "uint16", "int32")},
    "uint8": (plain("uint8"), None),
    "scaled int16": (lambda path: write(path, SMALL, scale=0.01, offset=100.0), None),
    "nodata of float32": (lambda p: write(p, holed(-9999.0, "float32"), nodata=-9999.0), None),
    "nodata of int16": (lambda p: write(p, holed(-32768, "int16"), nodata=-32768), None),
    "nodata of uint16": (lambda p: write(p, holed(0, "uint16"), nodata=0), None),
    "nodata that rounds": (lambda p: write(p, holed(-9999.9, "float32"), nodata=-9999.9), None),
    "nodata of NaN": (lambda p: write(p, holed(np.nan, "float32"), nodata=np.nan), None),
    "NaN": (lambda p: write(p, holed(np.nan, "float64")), None),
    "smallest float": (
        lambda p: write(p, holed(-3.4028234663852886e38, "float32"), nodata=-3.4028234663852886e38),
        None,
    ),
    "nodata and scale": (
        lambda p: write(p, np.where(shown() == 0, -1, SMALL), scale=0.01, offset=100.0, nodata=-1),
        None,
    ),
    "mask beside": (
        lambda p: write(p, mask=shown(), env={"GDAL_TIFF_INTERNAL_MASK": False}),
        None,
    ),
    "mask inside": (lambda p: write(p, mask=shown(), env={"GDAL_TIFF_INTERNAL_MASK": True}), None),
    "nodata in notes": (
        with_notes(OF_BAND.format("<NoDataValue>-9999</NoDataValue>"), holed(-9999.0, "float32")),
        None,
    ),
    "scale in notes": (
        with_notes(OF_BAND.format("<Offset>100</Offset><Scale>0.01</Scale>"), SMALL),
        None,
    ),
    "place and system in notes": (
        with_notes(NOTED + TRANSFORM, ground().astype("float32"), transform=None, crs=None),
        None,
    ),
    "world file": (with_world, None),
    "second of three bands": (lambda path: write(path, BANDS), 2),
    "bands band by band": (lambda path: write(path, BANDS, interleave="band"), 2),
    "bands cell by cell": (lambda path: write(path, BANDS, interleave="pixel", **TILED), 3),
    "tiles": (plain("float32", **TILED), None),
    "strips of three rows": (plain("float32", blockysize=3), None),
    "deflate": (plain("float32", compress="deflate"), None),
    "deflate, predicted": (plain("float32", compress="deflate", predictor=3, **TILED), None),
    "LZW, predicted": (plain("int16", compress="lzw", predictor=2), None),
    "Zstandard": (plain("float64", compress="zstd", **TILED), None),
    "LERC": (plain("float32", compress="lerc", **TILED), None),
    "packed bits": (plain("int16", compress="packbits"), None),
    "BigTIFF": (plain("float32", BIGTIFF="YES"), None),
    "big-endian": (plain("float32", ENDIANNESS="BIG"), None),
    "south up": (plain("float32", transform=(2.0, 0.0, 5e5, 0.0, 2.0, 5.2e6)), None),
    "cells of two lengths": (plain("float32", transform=(2.0, 0.0, 5e5, 0.0, -3.0, 5.2e6)), None),
    "in metres by name": (plain("float32", unit="metre"), None),
    "heights above a datum": (plain("float32", crs="EPSG:32633+5773"), None),
    "keys of ArcGIS": (plain("float32", GEOTIFF_KEYS_FLAVOR="ESRI_PE"), None),
    "no code": (plain("float32", crs="+proj=stere +lat_0=-90 +R=1737400 +units=m"), None),
    "no system": (plain("float32", crs=None), None),
}


def read(reader: Callable[[], gr.Terrain]) -> tuple[gr.Terrain, list[str]]:
    """A map, and what is warned of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", UserWarning)
        terrain = reader()
    return terrain, [str(one.message) for one in caught]


@pytest.mark.parametrize("kind", READ)
def test_all_readers_see_the_same_map(kind: str, tmp_path: Path) -> None:
    """Heights, missing cells, places and warnings are the same by file, rasterio and xarray, and the
    heights are those that rasterio itself gives; a text of them has the same."""
    written, band = READ[kind]
    path = written(tmp_path / "map.tif")
    by_file, noted = read(lambda: gr.Terrain.from_file(path, band=band))
    place = (band or 1) - 1
    with rasterio.open(path) as dataset:
        by_rasterio, also_noted = read(lambda: gr.Terrain.from_rasterio(dataset, band=band))
        stored = dataset.read(band or 1, masked=True).astype(np.float64)
        heights = np.ma.filled(stored * dataset.scales[place] + dataset.offsets[place], np.nan)
        system, north_first = dataset.crs, dataset.transform.e < 0.0
        is_whole = "int" in dataset.dtypes[place] and dataset.scales[place] == 1.0
    assert by_rasterio == by_file and also_noted == noted
    assert any("in steps of 1 m" in note for note in noted) == is_whole == bool(noted), noted
    expected = heights[::-1] if north_first else heights
    np.testing.assert_allclose(by_file.heights_m, expected, rtol=0, atol=2e-5)
    assert by_file.missing_count == np.isnan(heights).sum()
    # Masks are read by xarray where that is asked for.
    with rioxarray.open_rasterio(path, masked="mask" in kind) as array:
        by_xarray, also_noted = read(lambda: gr.Terrain.from_xarray(array.isel(band=place)))
    np.testing.assert_allclose(by_xarray.heights_m, by_file.heights_m, rtol=0, atol=2e-5)
    assert by_xarray.extent_m == pytest.approx(by_file.extent_m) and also_noted == noted
    west, south, east, north = by_file.extent_m
    lines = [
        f"{x!r};{y!r};{z!r}"
        for y, row in zip(np.linspace(south, north, 20).tolist(), expected.tolist())
        for x, z in zip(np.linspace(west, east, 30).tolist(), row)
    ]
    (tmp_path / "map.xyz").write_text("x;y;z\n" + "\n".join(lines))
    by_text, also_noted = read(lambda: gr.Terrain.from_file(tmp_path / "map.xyz"))
    np.testing.assert_allclose(by_text.heights_m, by_file.heights_m, rtol=0, atol=2e-5)
    assert also_noted == noted
    for terrain in (by_file, by_rasterio, by_xarray):
        assert (terrain.crs is None) == (system is None), terrain.crs
    if system is not None and system.to_epsg() is not None:
        assert by_rasterio.crs == by_xarray.crs == f"EPSG:{system.to_epsg()}"


# ---- meanings ----

DEGREES = {"crs": "EPSG:4326", "transform": (1 / 3600, 0.0, 10.5, 0.0, -1 / 3600, 46.5)}
MERCATOR = {"crs": "EPSG:3857", "transform": (2.0, 0.0, 1.67e6, 0.0, -2.0, 8_399_740.0)}
ROTATED = (1.73, -1.0, 5e5, -1.0, -1.73, 5.2e6)

#: How a file is written, the columns of a text that says the same, and the words of the refusal.
REFUSED: dict[str, tuple[Write, str | None, str]] = {
    "degrees": (plain("float32", **DEGREES), "lon,lat,z", "degrees"),
    "degrees with heights": (
        plain("float32", **{**DEGREES, "crs": "EPSG:4326+5773"}),
        "longitude,latitude,height",
        "degrees",
    ),
    "coordinates in feet": (plain("float32", crs="EPSG:2227"), "x_ft,y_ft,z", "feet|in ft"),
    "heights in survey feet": (
        plain("float32", crs="EPSG:26910+6360"),
        "x,y,z [ft]",
        "heights are in US survey f[eo][eo]t|in ft",
    ),
    "heights in feet": (plain("float32", crs="EPSG:32610+8228"), "x,y,z_ft", "in f[eo][eo]t|in ft"),
    "heights in centimetres": (plain("float32", unit="cm"), "x,y,z [cm]", "in cm"),
    "depths": (plain("float32", crs="EPSG:32633+5715"), None, "depths"),
    "Mercator at 60°": (plain("float32", **MERCATOR), None, "2.000 m in place of a metre"),
    "Mercator by ArcGIS": (
        plain("float32", **MERCATOR, GEOTIFF_KEYS_FLAVOR="ESRI_PE"),
        None,
        "2.000 m in place of a metre",
    ),
    "feet by ArcGIS": (
        plain("float32", crs="EPSG:2227", GEOTIFF_KEYS_FLAVOR="ESRI_PE"),
        None,
        "feet",
    ),
    "several bands": (lambda path: write(path, BANDS), "a,b,c", "bands|dimensions|columns"),
    "no place": (plain("float32", transform=None, crs=None), None, "georeference|degrees|y and x"),
    "rotated": (plain("float32", transform=ROTATED), None, "rotated|y and x"),
    "complex": (
        lambda path: write(path, ground().astype("complex64")),
        None,
        "complex",
    ),
    "degrees in notes": (
        with_notes("<SRS>GEOGCS[&quot;Moon&quot;,DATUM[&quot;Moon&quot;,SPHEROID[&quot;Moon&quot;,"
                   "1737400,0]],PRIMEM[&quot;0&quot;,0],UNIT[&quot;degree&quot;,"
                   "0.0174532925199433]]</SRS>", crs=None),
        None,
        "degrees",
    ),
    "feet in notes": (with_notes(OF_BAND.format("<UnitType>ft</UnitType>")), None, "ft"),
}


@pytest.mark.parametrize("kind", REFUSED)
def test_all_readers_refuse_what_is_no_map_in_metres(kind: str, tmp_path: Path) -> None:
    written, columns, words = REFUSED[kind]
    path = written(tmp_path / "map.tif")
    with pytest.raises(gr.DocumentError, match=words):
        gr.Terrain.from_file(path)
    with pytest.raises(gr.DocumentError, match=words):
        gr.Scenario(terrain={"file": str(path)})
    with rasterio.open(path) as dataset, pytest.raises(gr.ParameterError, match=words):
        gr.Terrain.from_rasterio(dataset)
    # A picture without a place has whole numbers as coordinates.
    if kind != "no place":
        with rioxarray.open_rasterio(path) as array, pytest.raises(gr.ParameterError, match=words):
            gr.Terrain.from_xarray(array)
    if columns is not None:
        (tmp_path / "map.csv").write_text(f"{columns}\n1,1,5\n2,1,5\n1,2,5\n2,2,5\n")
        with pytest.raises(gr.DocumentError, match=words):
            gr.Terrain.from_file(tmp_path / "map.csv")


def test_colours_are_no_heights() -> None:
    with pytest.raises(gr.DocumentError, match="colours"):
        gr.Terrain.from_file(FIXTURES / "classes-palette-u8.tif")
    with rasterio.open(FIXTURES / "classes-palette-u8.tif") as dataset:
        with pytest.raises(gr.ParameterError, match="colours"):
            gr.Terrain.from_rasterio(dataset)


def test_arrays_have_the_checks_of_files() -> None:
    settings: dict[str, Any] = {"cell_size_m": 2.0, "south_west_m": (5e5, 5.2e6)}
    known = gr.Terrain(ground(), **settings, crs=UTM)
    assert known.crs == UTM and gr.Terrain(ground(), **settings).crs is None
    assert pickle.loads(pickle.dumps(known)).crs == UTM
    with pytest.raises(gr.ParameterError, match="feet"):
        gr.Terrain(ground(), **settings, crs="EPSG:2227")
    with pytest.raises(gr.ParameterError, match="degrees"):
        gr.Terrain(ground(), **settings, crs=rasterio.crs.CRS.from_epsg(4326))
    with pytest.raises(gr.ParameterError, match="2.000 m in place of a metre"):
        gr.Terrain(ground(), cell_size_m=2.0, south_west_m=(1.67e6, 8.3997e6), crs="EPSG:3857")
    with pytest.raises(gr.ParameterError, match="complex"):
        gr.Terrain(ground() * 1j, **settings)
    # A tile of SRTM without a system.
    tile = np.add.outer(np.arange(130.0), np.arange(130.0))
    with pytest.raises(gr.ParameterError, match="degrees"):
        gr.Terrain(tile, cell_size_m=1 / 120, south_west_m=(10.0, 46.0))
    with pytest.warns(UserWarning, match="1.000 m on the map at its middle, and 1.000 to 1.0"):
        gr.Terrain(
            ground(),
            cell_size_m=20_000.0,
            south_west_m=(-290_000.0, -190_000.0),
            crs="+proj=stere +lat_0=-90 +R=1737400",
        )
    with pytest.warns(UserWarning, match="go up and down in steps of 1 m"):
        gr.Terrain(ground().round(), cell_size_m=1.0)


def test_arrays_of_xarray_name_their_units() -> None:
    xarray = pytest.importorskip("xarray")
    x, y = 2.0 * np.arange(30.0), 40.0 - 2.0 * np.arange(20.0)
    array = xarray.DataArray(ground(), dims=("y", "x"), coords={"y": y, "x": x})
    feet = array.copy()
    feet.x.attrs["units"] = "US survey foot"
    with pytest.raises(gr.ParameterError, match="coordinates x are in 'us survey foot'"):
        gr.Terrain.from_xarray(feet)
    with pytest.raises(gr.ParameterError, match="degrees"):
        gr.Terrain.from_xarray(array.rename(x="lon", y="lat"))
    holes = array.where(shown() > 0, -9999.0)
    holes.attrs["missing_value"] = -9999.0
    assert gr.Terrain.from_xarray(holes).missing_count == 6


# ---- what is written, and places of other systems ----


@pytest.fixture
def site(tmp_path: Path) -> tuple[Path, gr.Terrain]:
    """A map by rasterio, level enough to drive on."""
    path = write(tmp_path / "site.tif", (0.02 * ground()).astype("float32"))
    with rasterio.open(path) as dataset:
        return path, gr.Terrain.from_rasterio(dataset)


def test_maps_and_ways_carry_the_system(site: tuple[Path, gr.Terrain], tmp_path: Path) -> None:
    _, terrain = site
    found = gr.map(terrain, samples=2)
    assert found.rio.crs == rasterio.crs.CRS.from_string(UTM)
    found.slope_deg.rio.to_raster(tmp_path / "slope.tif")
    with rasterio.open(tmp_path / "slope.tif") as dataset:
        assert dataset.crs == rasterio.crs.CRS.from_string(UTM)
        assert dataset.transform == rasterio.Affine(*PLACE)
    way = gr.route(
        terrain, from_m=(500_010, 5_200_020), to_m=(500_050, 5_200_020), samples=2, drive=False
    )
    assert way.spatial_ref.attrs["spatial_ref"] == UTM
    again = pickle.loads(pickle.dumps(terrain))
    assert again.crs == UTM


def places(path: Path, geometry: dict[str, Any], system: str | None) -> Path:
    feature: dict[str, Any] = {
        "type": "Feature",
        "properties": {"soil": "toyoura"},
        "geometry": geometry,
    }
    if system is not None:
        feature["crs"] = {"type": "name", "properties": {"name": system}}
    path.write_text(json.dumps(feature))
    return path


def square(x: float, y: float, size: float) -> dict[str, Any]:
    ring = [[x, y], [x + size, y], [x + size, y + size], [x, y + size], [x, y]]
    return {"type": "Polygon", "coordinates": [ring]}


@pytest.mark.parametrize("held", [True, False])
@pytest.mark.parametrize(
    ("system", "words"),
    [("EPSG:32632", "system EPSG:32632, and the map those of EPSG:32633"), ("EPSG:4258", "degrees")],
)
def test_places_of_another_system_are_refused(
    site: tuple[Path, gr.Terrain], tmp_path: Path, system: str, words: str, held: bool
) -> None:
    """Areas, ways, zones and legs, on a map of rasterio's and on one by its file."""
    path, by_rasterio = site
    terrain = by_rasterio if held else gr.Terrain.from_file(path)
    scale = 1.0 if system == "EPSG:32632" else 1e-5
    x, y = 500_010 * scale, 5_200_010 * scale
    area = places(tmp_path / "area.geojson", square(x, y, 4 * scale), system)
    line = {"type": "LineString", "coordinates": [[x, y], [x + 9 * scale, y]]}
    way = places(tmp_path / "way.geojson", line, system)
    ends = {"from_m": (500_010, 5_200_020), "to_m": (500_050, 5_200_020)}
    quick: dict[str, Any] = {"samples": 2, "drive": False}
    with pytest.raises(gr.DocumentError, match=words):
        gr.route(terrain, **ends, keep_out=area, **quick)
    with pytest.raises(gr.DocumentError, match=words):
        gr.route(terrain, along=way, **quick)
    with pytest.raises(gr.DocumentError, match=words):
        gr.Scenario(terrain={"file": terrain, "soil_file": str(area)})
    with pytest.raises(gr.DocumentError, match=words):
        gr.Mission(legs_from=str(way), terrain={"file": terrain})


def test_classes_of_another_system_are_refused(site: tuple[Path, gr.Terrain], tmp_path: Path) -> None:
    path, by_rasterio = site
    classes = np.ones((20, 30), np.uint8)
    zone = [{"class": 1, "soil": "grc-1"}]
    other = write(tmp_path / "other.tif", classes, crs="EPSG:32632")
    own = write(tmp_path / "own.tif", classes)
    for terrain in (by_rasterio, gr.Terrain.from_file(path), str(path)):
        of = {"file": terrain, "zone": zone}
        with pytest.raises(gr.DocumentError, match="EPSG:32632, and the map those of EPSG:32633"):
            gr.Scenario(terrain={**of, "soil_file": str(other)})
        gr.Scenario(terrain={**of, "soil_file": str(own)})
