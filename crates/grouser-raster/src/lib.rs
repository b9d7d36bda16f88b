//! Elevation models, and zones of soil, from files: GeoTIFF, NumPy arrays, xyz text and GeoJSON.
//!
//! [`read`] tells the format by the content, and gives a [`Raster`]: heights at the points of a
//! grid, with the file's coordinate system, which is checked and carried along.
//! [`Raster::model`] makes the [`ElevationModel`](grouser_core::terrain::ElevationModel) of it that
//! a rover drives on.
//!
//! | format | read | coordinates |
//! |---|---|---|
//! | [GeoTIFF](geotiff) | tiles and strips, cloud-optimised at full resolution, BigTIFF; deflate, LZW, LERC, Zstandard; real and whole numbers | of the file: projected, in metres, north up |
//! | [`.npy`](npy) | versions 1 to 3, row by row or column by column, either byte order; real and whole numbers | [`Placement`] |
//! | [xyz] | a point in each line, in any order | of the file, in metres |
//!
//! [`read_zones`] reads which soil lies where: class numbers from the same formats, or polygons
//! from [GeoJSON](zones::geojson).
//!
//! What a file promises is compared with its length and with [`ReadOptions::cells`] before memory
//! is taken for it. A file that cannot be used gives a [`RasterError`] that says what to do.
//!
//! How large is an array of heights, and how high is its middle?
//!
//! ```
//! use grouser_core::units::Vec2;
//! use grouser_raster::{Placement, ReadOptions, npy};
//!
//! let mut file = b"\x93NUMPY\x01\x00\x46\x00".to_vec();
//! file.extend(format!("{:69}\n", "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 3), }").bytes());
//! for height in [7.0_f32, 8.0, 9.0, 4.0, 5.0, 6.0, 1.0, 2.0, 3.0] {
//!     file.extend(height.to_le_bytes());
//! }
//! let placement = Placement::north_first(Vec2::zeros(), 0.5);
//! let options = ReadOptions { placement: Some(placement), ..ReadOptions::default() };
//! let raster = npy::decode(&file, &options)?;
//! assert_eq!(raster.grid.extent().north_east, Vec2::new(1.0, 1.0));
//! // The rows of a picture are from north to south, those of a grid from south to north.
//! assert_eq!(raster.height(0, 0), Some(1.0));
//! assert_eq!(raster.height(1, 1), Some(5.0));
//! # Ok::<(), grouser_raster::Fault>(())
//! ```

mod advice;
mod coordinate_system;
mod degrees;
mod error;
pub mod geotiff;
mod heights;
mod hint;
mod length;
mod map_path;
mod meaning;
pub mod npy;
mod options;
mod plausibility;
mod projection;
mod raster;
mod read;
mod remark;
mod wkt;
pub mod xyz;
pub mod zones;

pub use advice::Warp;
pub use coordinate_system::{CoordinateSystem, GeoKeys};
pub use degrees::check_grid;
pub use error::{Fault, InnerFault, RasterError};
pub use geotiff::beside::beside;
pub use geotiff::metadata::check_unit;
pub use heights::BEYOND;
pub use map_path::MapPath;
pub use meaning::{MapSite, check_system};
pub use options::{CELLS, Content, Placement, ReadOptions, RowOrder};
pub use plausibility::remarks;
pub use raster::Raster;
pub use read::read;
pub use remark::Remark;
pub use zones::geojson::read_line_string;
pub use zones::{
    MapFrame, ZoneKey, ZoneMap, check_places, check_places_on, read_areas, read_zones, zone_names,
};
