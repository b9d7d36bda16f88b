"""Maps of heights on which rovers drive."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _tables
from ._arrays import Floats, number, numbers, whole_number
from ._errors import ParameterError

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

#: Which row of an array comes first.
Rows = Literal["north-first", "south-first"]
#: Kinds of lunar ground.
Ground = Literal["mare", "highlands"]


class Terrain:
    """A map of heights: ground on which rovers drive.

    Places are on the map: x to the east, y to the north [m]. Between the points of the grid the
    ground is that of cubic convolution, with a continuous slope. The map is read-only, and all runs
    on it share it without copies: ``gr.simulate(terrain=terrain)`` starts in its middle,
    ``terrain={"file": terrain, "start_m": (x, y)}`` at a place, and so do `Scenario`, `Mission`,
    `rollout`, `Run` and `RunBatch`.

    Parameters
    ----------
    heights_m : array_like, shape (rows, columns)
        Heights [m]: rows run from west to east. NaN and masked entries are missing heights.
    cell_size_m : float or (float, float)
        Distance between neighbours [m], or the distances to the east and to the north.
    south_west_m : (float, float)
        x and y of the point farthest to the south and west [m]: the middle of its cell.
    rows : {"north-first", "south-first"}
        Which row comes first: the northern one, as in pictures, rasterio and GeoTIFF, or the
        southern one, as in plots with their origin below.
    crs : str or object with ``to_wkt``, optional
        The system of the coordinates: well-known text, a code such as ``"EPSG:32633"``, or what
        rasterio and pyproj have. Files of places are compared with it, and maps and ways carry it.

    Raises
    ------
    ParameterError
        If the heights are no grid, if all are missing, for values that are not finite or are no
        real numbers, for coordinates in degrees or other units, and for a map far larger or smaller
        than its ground.

    Warns
    -----
    UserWarning
        Of heights that no ground has: voids that nobody declared, steps, spikes; and of a
        projection that is larger or smaller than the ground.

    Examples
    --------
    A hill of 1 m, 20 m wide, and a rover that drives up its western side:

    >>> import numpy as np
    >>> import grouser as gr
    >>> x = y = np.linspace(-20.0, 20.0, 81)
    >>> hill = gr.Terrain(
    ...     np.exp(-(x**2 + y[:, None] ** 2) / 100.0),
    ...     cell_size_m=0.5,
    ...     south_west_m=(-20.0, -20.0),
    ...     rows="south-first",
    ... )
    >>> hill.height_m(0.0, 0.0), round(hill.slope_deg(-7.0, 0.0), 1)
    (1.0, 4.9)
    >>> run = gr.simulate(
    ...     terrain={"file": hill, "start_m": (-7.0, 0.0)},
    ...     duration_s=10.0,
    ...     simulation="quasi-steady",
    ... )
    >>> bool(run.z_m[-1] > run.z_m[0]), bool(4.0 < run.pitch_deg[-1] < 6.0)
    (True, True)
    """

    __slots__ = ("_native",)
    _native: _core.Terrain

    def __init__(
        self,
        heights_m: ArrayLike,
        /,
        *,
        cell_size_m: float | Sequence[float],
        south_west_m: Sequence[float] = (0.0, 0.0),
        rows: Rows = "north-first",
        crs: Any = None,
    ) -> None:
        if rows not in ("north-first", "south-first"):
            raise ParameterError(
                f"rows is {rows!r}, it must be 'north-first' or 'south-first'", "rows"
            )
        if getattr(heights_m, "dims", None):
            raise ParameterError(
                "heights_m is a DataArray: Terrain.from_xarray takes its coordinates too",
                "heights_m",
            )
        given: Any = np.ma.asarray(heights_m)
        if given.dtype.kind not in "biuf" and given.dtype != object:
            raise ParameterError(
                f"heights_m has numbers of type {given.dtype}, they must be real: heights in metres",
                "heights_m",
            )
        heights = np.ma.filled(given.astype(np.float64), np.nan)
        if heights.ndim != 2:
            raise ParameterError(
                f"heights_m has shape {heights.shape}, it must have two axes, rows and columns",
                "heights_m",
            )
        corner, cell = _pair("south_west_m", south_west_m), _pair("cell_size_m", cell_size_m)
        text = _text_of(crs)
        self._native = _core.Terrain(heights, corner, cell, rows == "north-first", text)

    @classmethod
    def _of(cls, native: _core.Terrain) -> Terrain:
        made = cls.__new__(cls)
        made._native = native
        return made

    @classmethod
    def from_file(
        cls,
        path: str | os.PathLike[str],
        *,
        cell_size_m: float | None = None,
        south_west_m: Sequence[float] = (0.0, 0.0),
        band: int | None = None,
        missing_m: float | None = None,
    ) -> Terrain:
        """Reads a GeoTIFF in metres of a projection, a NumPy array (``.npy``), or text with x, y
        and z in each line. Scenarios on it name the file, so that the program reads their documents.

        Parameters
        ----------
        path : str or path
            The file.
        cell_size_m : float, optional
            Distance between neighbours [m], of a file that does not say it.
        south_west_m : (float, float)
            x and y of the point farthest to the south and west [m], of a file that does not say it.
        band : int, optional
            Which band of a GeoTIFF has the heights, from 1; needed where it has several.
        missing_m : float, optional
            A height that stands for a missing one [m], beside those that the file declares.

        Raises
        ------
        DocumentNotFoundError
            If there is no such file; also a ``FileNotFoundError``.
        DocumentError
            For a file that is no map in metres, with what helps.

        Examples
        --------
        >>> import pathlib, tempfile
        >>> import numpy as np
        >>> import grouser as gr
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     np.save(pathlib.Path(folder) / "site.npy", np.zeros((3, 5)))
        ...     site = gr.Terrain.from_file(f"{folder}/site.npy", cell_size_m=2.0)
        >>> site.shape, site.extent_m
        ((3, 5), (0.0, 0.0, 8.0, 4.0))
        """
        placement = None
        if cell_size_m is not None:
            placement = (number("cell_size_m", cell_size_m), *_pair("south_west_m", south_west_m))
        which = None if band is None else whole_number("band", band, most=65_535)
        missing = None if missing_m is None else number("missing_m", missing_m)
        return cls._of(_core.Terrain.from_file(os.fspath(path), (placement, which, missing)))

    @classmethod
    def lunar(
        cls,
        *,
        size_m: float = 500.0,
        cell_size_m: float = 1.0,
        ground: Ground = "mare",
        crater_share: float = 1.0,
        largest_crater_m: float = 100.0,
        seed: int = 1,
    ) -> Terrain:
        """Lunar ground made by chance: craters by published counts, from fresh to worn, on fractal
        relief. It is no place of the Moon; the same seed gives the same ground, and the program's
        ``grouser terrain moon`` the same heights.

        Parameters
        ----------
        size_m : float
            Length of a side [m], up to 20000, and 8 to 4096 cells; the origin is in the middle.
        cell_size_m : float
            Distance between neighbours [m]. The smallest craters have a diameter of four cells.
        ground : {"mare", "highlands"}
            A plain of lava, or the older and steeper ground about the plains.
        crater_share : float
            Number of craters, over that of ground where as many form as wear away, 0 to 1.
        largest_crater_m : float
            Upper limit of the craters' diameters [m], up to 300.
        seed : int
            What chance it is made by.

        Raises
        ------
        ParameterError
            For values beyond these ranges, with the range.

        Examples
        --------
        >>> import grouser as gr
        >>> site = gr.Terrain.lunar(size_m=100.0, seed=2)
        >>> site.shape, site.extent_m
        ((101, 101), (-50.0, -50.0, 50.0, 50.0))
        """
        sizes = (number("size_m", size_m), number("cell_size_m", cell_size_m))
        share = number("crater_share", crater_share)
        largest = number("largest_crater_m", largest_crater_m)
        at_random = whole_number("seed", seed)
        return cls._of(_core.Terrain.lunar(*sizes, ground, share, largest, at_random))

    @classmethod
    def from_rasterio(cls, dataset: Any, *, band: int | None = None) -> Terrain:
        """The map of an open dataset of rasterio, with its transform, its missing heights, and its
        scale and offset. It is refused where `from_file` refuses the file.

        Parameters
        ----------
        dataset : rasterio.DatasetReader
            The dataset, in metres of a projection and not rotated.
        band : int, optional
            Which band has the heights, from 1; needed where there are several.

        Raises
        ------
        ParameterError
            For coordinates in degrees or other units, a map far larger or smaller than its ground,
            cells that are colours, several bands of which none is chosen, a dataset without a
            place, and a transform that is rotated, sheared or mirrored, with what helps.

        Examples
        --------
        Made with rasterio as ``gr.Terrain.from_rasterio(rasterio.open("site.tif"))``.
        """
        place = _band_of(dataset, band) - 1
        _check_heights_unit((getattr(dataset, "units", None) or {place: None})[place])
        a, b, c, d, e, f = tuple(dataset.transform)[:6]
        if (a, b, c, d, e, f) == (1.0, 0.0, 0.0, 0.0, 1.0, 0.0) and not dataset.crs:
            raise ParameterError(
                "the dataset has no georeference: nothing says where it lies and how large its "
                "cells are; Terrain(dataset.read(1), cell_size_m=…, south_west_m=…) does",
                "dataset",
            )
        if b or d or a <= 0.0 or not e:
            raise ParameterError(
                "the transform of the dataset is rotated, sheared or mirrored: "
                "`gdalwarp -r cubic IN.tif OUT.tif` writes a north-up file",
                "dataset",
            )
        heights = np.ma.asarray(dataset.read(place + 1, masked=True))
        rows, _ = heights.shape
        scale = (getattr(dataset, "scales", None) or {place: 1.0})[place]
        offset = (getattr(dataset, "offsets", None) or {place: 0.0})[place]
        # A transform is of the cells' corners, a map of their middles.
        lowest = f + (rows - 0.5) * e if e < 0.0 else f + 0.5 * e
        return cls(
            _scaled(heights, scale, offset),
            cell_size_m=(a, abs(e)),
            south_west_m=(c + 0.5 * a, lowest),
            rows="north-first" if e < 0.0 else "south-first",
            crs=dataset.crs,
        )

    @classmethod
    def from_xarray(cls, heights_m: Any) -> Terrain:
        """The map of a DataArray over ``y`` and ``x``, with the conventions of rioxarray: the
        coordinates are the middles of cells [m], and run either way along ``y``.

        Missing are NaN and the ``nodata`` of its accessor ``rio``, or its attributes ``_FillValue``
        and ``missing_value``; a mask that a file has counts where it is opened with ``masked=True``.

        Parameters
        ----------
        heights_m : xarray.DataArray, shape (y, x)
            The heights [m]; other dimensions, such as ``band``, have one entry.

        Raises
        ------
        ParameterError
            For other dimensions, coordinates that are not evenly spaced, coordinates in degrees or
            other units, and a map far larger or smaller than its ground, with what helps.

        Examples
        --------
        Made as ``gr.Terrain.from_xarray(rioxarray.open_rasterio("site.tif"))``.
        """
        array = heights_m
        _check_no_degrees(array)
        for dim in array.dims:
            if dim not in ("y", "x") and array.sizes[dim] == 1:
                array = array.isel({dim: 0})
        if set(array.dims) != {"y", "x"} or not {"y", "x"} <= set(array.coords):
            raise ParameterError(
                f"the DataArray has dimensions {tuple(array.dims)}, it must have y and x, with "
                "coordinates in metres; `.rename(…)` gives them these names",
                "heights_m",
            )
        array = array.transpose("y", "x")
        _check_heights_unit(array.attrs.get("units"))
        (west, east), (first, last) = _ends("x", array), _ends("y", array)
        if east < west:
            array, (west, east) = array.isel(x=slice(None, None, -1)), (east, west)
        rows, columns = array.shape
        heights = np.ma.masked_invalid(np.asarray(array.values))
        for nodata in _nodata_of(array):
            heights = np.ma.masked_where(heights == nodata, heights)
        scale, offset = (array.attrs.get(it) for it in ("scale_factor", "add_offset"))
        return cls(
            _scaled(heights, scale, offset),
            cell_size_m=((east - west) / (columns - 1), abs(last - first) / (rows - 1)),
            south_west_m=(west, min(first, last)),
            rows="south-first" if last > first else "north-first",
            crs=_system_of(array),
        )

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self._native.shape

    @property
    def extent_m(self) -> tuple[float, float, float, float]:
        """x and y of the outermost points [m]: west, south, east, north."""
        west, south, east, north = self._native.extent
        return west, south, east, north

    @property
    def cell_size_m(self) -> tuple[float, float]:
        """Distance between neighbours to the east and to the north [m]."""
        east, north = self._native.spacing
        return east, north

    @property
    def crs(self) -> str | None:
        """The system of the coordinates, for other programs: its code (``"EPSG:32633"``), well-known
        text or the words of PROJ; None where it is not known."""
        return self._native.crs

    @property
    def missing_count(self) -> int:
        """Number of points whose height is missing."""
        return self._native.missing

    @property
    def heights_m(self) -> Floats:
        """Heights at the points [m], shape (rows, columns), rows from south to north; NaN where
        they are missing; a copy."""
        _, _, base, _, _, above, _ = self._native.parts()
        return base + above.astype(np.float64)

    def height_m(self, x_m: ArrayLike, y_m: ArrayLike) -> Any:
        """Heights of the ground.

        Parameters
        ----------
        x_m, y_m : array_like
            Places on the map [m], of shapes that broadcast.

        Returns
        -------
        float or ndarray
            Heights [m] of the broadcast shape; NaN beyond the map and where heights are missing.

        Examples
        --------
        >>> import grouser as gr
        >>> ramp = gr.Terrain([[0.0, 1.0], [0.0, 1.0]], cell_size_m=10.0)
        >>> ramp.height_m([2.0, 5.0, 12.0], 5.0).tolist()
        [0.2, 0.5, nan]
        """
        return _each(self._native.heights, x_m, y_m)

    def slope_deg(self, x_m: ArrayLike, y_m: ArrayLike) -> Any:
        """Inclinations of the ground, at a point: a wheel meets a mean plane.

        Parameters
        ----------
        x_m, y_m : array_like
            Places on the map [m], of shapes that broadcast.

        Returns
        -------
        float or ndarray
            Inclinations [°] of the broadcast shape, 0 where it is level; NaN as of `height_m`.
        """
        return _each(self._native.slopes, x_m, y_m)

    def normal(self, x_m: ArrayLike, y_m: ArrayLike) -> Floats:
        """Unit vectors that stand on the ground.

        Parameters
        ----------
        x_m, y_m : array_like
            Places on the map [m], of shapes that broadcast.

        Returns
        -------
        ndarray, shape (…, 3)
            Parts to the east, to the north and up, after the broadcast shape; NaN as of `height_m`.
        """
        found: Floats = _each(self._native.normals, x_m, y_m)
        return found

    def plot(self, axes: Axes | None = None, **style: Any) -> Axes:
        """Plots the ground as shaded relief, with light from the north-west, seen from above.

        Parameters
        ----------
        axes : matplotlib axes, optional
            Axes to plot on; by default those of a new figure.
        **style
            Arguments of ``Axes.imshow``.
        """
        from matplotlib.colors import LightSource

        axes = _tables.axes_or_new(axes)
        heights = self.heights_m
        (dx, dy), (west, south, east, north) = self.cell_size_m, self.extent_m
        known = np.where(np.isnan(heights), np.nanmin(heights), heights)
        # The light's azimuth is for rows from north to south.
        shade = LightSource(azdeg=315.0, altdeg=45.0).hillshade(known[::-1], dx=dx, dy=dy)
        shade = np.where(np.isnan(heights[::-1]), np.nan, shade)
        extent = west - dx / 2, east + dx / 2, south - dy / 2, north + dy / 2
        axes.imshow(shade, **{"cmap": "gray", "vmin": 0.0, "vmax": 1.0, "extent": extent, **style})
        axes.set_xlabel("east, x [m]")
        axes.set_ylabel("north, y [m]")
        return axes

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Terrain):
            return NotImplemented
        return self._native == other._native

    def __hash__(self) -> int:
        return hash((self.shape, self.extent_m))

    def __reduce__(self) -> tuple[Any, ...]:
        return _of_parts, self._native.parts()

    def __repr__(self) -> str:
        (rows, columns), (west, south, east, north) = self.shape, self.extent_m
        return f"<Terrain {columns} × {rows}: x {west:g} to {east:g} m, y {south:g} to {north:g} m>"


def native_of(terrain: Any) -> _core.Terrain:
    """The native half of what must be a terrain."""
    if not isinstance(terrain, Terrain):
        raise ParameterError(
            f"terrain is {type(terrain).__name__}, it must be a Terrain: Terrain.from_file, "
            "from_rasterio and from_xarray make one",
            "terrain",
        )
    return terrain._native


def _of_parts(*parts: Any) -> Terrain:
    """A map that was pickled."""
    return Terrain._of(_core.Terrain.of_parts(*parts))


def _pair(name: str, value: Any) -> tuple[float, float]:
    """Two numbers, or one for both."""
    given = numbers(name, value)
    if given.shape not in ((), (2,)):
        raise ParameterError(f"{name} has shape {given.shape}, it must be a pair of numbers", name)
    first, second = np.broadcast_to(given, (2,))
    return float(first), float(second)


def _each(found: Any, x_m: ArrayLike, y_m: ArrayLike) -> Any:
    """What is found at places, in their shape."""
    try:
        x, y = np.broadcast_arrays(numbers("x_m", x_m), numbers("y_m", y_m))
    except ValueError:
        shapes = f"{np.shape(x_m)} and {np.shape(y_m)}"
        raise ParameterError(
            f"x_m and y_m have shapes {shapes}, they must broadcast", "x_m"
        ) from None
    values = found(np.ascontiguousarray(x).ravel(), np.ascontiguousarray(y).ravel())
    values = values.reshape(x.shape + values.shape[1:])
    return float(values) if values.ndim == 0 else values


def _scaled(heights: NDArray[Any], scale: float | None, offset: float | None) -> NDArray[Any]:
    """Heights of stored numbers; those that are plain heights as they are."""
    scale, offset = 1.0 if scale is None else scale, 0.0 if offset is None else offset
    if (scale, offset) == (1.0, 0.0):
        return heights
    scaled: NDArray[Any] = heights.astype(np.float64) * scale + offset
    return scaled


def _text_of(crs: Any) -> str | None:
    """A coordinate system as text; None without one."""
    if not crs:
        return None
    return str(crs.to_wkt() if hasattr(crs, "to_wkt") else crs)


def _band_of(dataset: Any, band: int | None) -> int:
    """Which band of a dataset has the heights, from 1."""
    count = int(getattr(dataset, "count", 1))
    if band is None and count > 1:
        raise ParameterError(
            f"the dataset has {count} bands, and one of them has the heights: `band` says which",
            "band",
        )
    chosen = 1 if band is None else whole_number("band", band)
    if not 1 <= chosen <= count:
        raise ParameterError(
            f"the dataset has no band {chosen}: it has {count}, counted from 1", "band"
        )
    colours = getattr(dataset, "colorinterp", None)
    if colours is not None and colours[chosen - 1].name == "palette":
        raise ParameterError("the dataset's cells are numbers of colours, not heights", "dataset")
    return chosen


def _check_heights_unit(unit: object) -> None:
    """Checks that heights are in metres, as far as a unit is stated."""
    if unit:
        _core.check_height_unit(str(unit))


def _check_no_degrees(array: Any) -> None:
    """Checks that the coordinates of an array are no degrees, by their names and units."""
    for name, values in array.coords.items():
        units = str(values.attrs.get("units", ""))
        if name not in array.dims or not (
            units.startswith("degree") or name in ("lon", "lat", "longitude", "latitude")
        ):
            continue
        raise ParameterError(
            f"the coordinates {name} are degrees of longitude and latitude, and a rover needs "
            "metres: `.rio.reproject(array.rio.estimate_utm_crs())` projects them",
            "heights_m",
        )


def _ends(dim: str, array: Any) -> tuple[float, float]:
    """The first and the last coordinate along a dimension [m], which are evenly spaced."""
    places = np.asarray(array[dim].values, dtype=np.float64)
    units = str(array[dim].attrs.get("units") or "m").lower()
    if units not in ("m", "metre", "meter", "metres", "meters"):
        raise ParameterError(
            f"the coordinates {dim} are in {units!r}, and a rover needs metres", "heights_m"
        )
    if len(places) < 2:
        raise ParameterError(
            f"there are {len(places)} places along {dim}, two or more are needed", dim
        )
    first, last = float(places[0]), float(places[-1])
    cell = (last - first) / (len(places) - 1)
    # Coordinates in single precision are off by some thousandths of a cell.
    even = first + cell * np.arange(len(places))
    if not np.abs(places - even).max() <= 0.01 * abs(cell) or cell == 0.0:
        raise ParameterError(f"the coordinates along {dim} are not evenly spaced", dim)
    return first, last


def _system_of(array: Any) -> Any:
    """The coordinate system that rioxarray knows, or else its text; None without one."""
    accessor = getattr(array, "rio", None)
    if accessor is not None:
        return accessor.crs
    name = array.encoding.get("grid_mapping") or array.attrs.get("grid_mapping") or "spatial_ref"
    if name not in array.coords:
        return None
    attributes: Mapping[str, Any] = array.coords[name].attrs
    return attributes.get("crs_wkt") or attributes.get("spatial_ref")


def _nodata_of(array: Any) -> list[float]:
    """What stands for missing heights."""
    accessor = getattr(array, "rio", None)
    values = [None if accessor is None else accessor.nodata]
    values += [array.attrs.get(name) for name in ("_FillValue", "missing_value")]
    return [float(value) for value in values if value is not None]


def carried(data: xarray.Dataset, terrain: Terrain) -> xarray.Dataset:
    """A dataset over places of a map, with the map's coordinate system as rioxarray reads it."""
    if terrain.crs is None:
        return data
    return data.assign_coords(spatial_ref=((), 0, {"spatial_ref": terrain.crs}))
