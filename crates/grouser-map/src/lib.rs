//! Mobility maps as files for other programs: for each number a cloud-optimised GeoTIFF in the
//! coordinates of the elevation model that it was made from, the style with which QGIS shows it,
//! the slip that Gazebo reads, and the areas that a route is to keep out of; and pictures of each
//! number over the relief.
//!
//! A map is a [`Ground`](grouser::studies::mobility::Ground), whose places have gradients, and a
//! [`MobilityMap`](grouser::studies::mobility::MobilityMap), which says what a rover does on them.
//! A band is written tile by tile, so that no more of it is in memory than a tile. Nothing is
//! computed from one place for another: a band that was written again is the same to the byte,
//! whatever else was going on.

mod error;
mod gazebo;
mod geotiff;
mod keep_out;
mod picture;
mod style;
mod summary;
mod way;

pub use error::MapError;
pub use gazebo::SlipTexture;
pub use geotiff::{elevation_model, write_band};
pub use keep_out::keep_out;
pub use picture::{BandPictures, label};
pub use style::{Look, style};
pub use summary::{BandSummary, band_files, summaries};
pub use way::way_as_geojson;

/// The page of a map, in its folder.
pub const MAP_PAGE: &str = "map.html";
/// The areas where nobody may go, likewise.
pub const KEEP_OUT_FILE: &str = "keep-out.geojson";

/// Columns of a map's bands.
pub type MapColumn = grouser::document::columns::Column<grouser::studies::mobility::CellMotion>;
