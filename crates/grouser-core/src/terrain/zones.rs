//! Soil by zone: which of several soils lies at a place of a map.

mod border;
mod error;
mod grid;
mod map;
mod number;
mod polygons;
mod shares;

pub use error::ZonesError;
pub use number::{MOST_SOILS, NO_ZONE};
pub use polygons::ZonePolygon;

use std::sync::Arc;

use super::elevation::ElevationGrid;
use super::footprint::Footprint;
use crate::error::ParameterError;
use crate::soil::Soil;
use crate::units::Vec2;
use grid::GridZones;
use map::Map;
use polygons::PolygonZones;

/// Zones of ground, each of one soil.
///
/// Places are in the coordinates of a map: x east, y north, in metres. Where there is no zone the
/// soil is the one that a scenario states.
///
/// The soil changes at once at a border, a wheel passes over it: what it meets is shared among the
/// zones below its [`Footprint`]. As of the stress below a wheel, there is most in the middle of
/// its length, and as much everywhere across its width.
///
/// ```text
/// share_k = ∫∫_zone k ½ w(a) da db        w(a) = ¾ (1 − a²)        a, b: −1 to 1 along and across the footprint
/// ```
///
/// The shares are exact for borders of straight lines and change smoothly as a wheel passes, so
/// that an integrator's steps need not end at a border. The force on the wheel is the mean of the
/// soils' forces at its sinkage, by their shares.
///
/// How much of a wheel has passed a border from sand to firm ground, 1 cm before its middle does?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::terrain::{Footprint, SoilZones, ZonePolygon};
/// use grouser_core::units::Vec2;
///
/// let corners = [(2.0, -5.0), (9.0, -5.0), (9.0, 5.0), (2.0, 5.0)];
/// let rings = vec![corners.map(|(x, y)| Vec2::new(x, y)).to_vec()];
/// let zones = SoilZones::from_polygons(&[ZonePolygon { soil: Some(0), rings }], vec![paper::toyoura()])?;
/// let wheel = Footprint { forward: Vec2::x(), half_length: 0.05, half_width: 0.04 };
/// let shares = zones.under(Vec2::zeros(), Vec2::new(1.99, 0.0), wheel);
/// let passed = shares.iter().find(|share| share.soil.is_some()).map(|share| share.weight);
/// assert_eq!(format!("{:.3}", passed.unwrap_or_default()), "0.352");
/// # Ok::<(), grouser_core::terrain::ZonesError>(())
/// ```
/// [`default`](Self::default) has no zones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SoilZones {
    map: Arc<Map>,
    /// The soils. A clone with others shares the places; a zone of a soil that is not there has the
    /// ground's own.
    pub soils: Vec<Soil>,
}

/// How much of a footprint lies on one soil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share<'a> {
    /// The soil; none where there is no zone.
    pub soil: Option<&'a Soil>,
    /// Its share [-]; all shares together are 1.
    pub weight: f64,
}

impl SoilZones {
    /// Zones of a grid: a place belongs to the zone of the nearest point. Beyond half a cell from
    /// the outer points there is none.
    ///
    /// * `zones`: of the grid's points, in rows from south to north, each from west to east: which
    ///   of the soils, from 0, or [`NO_ZONE`]
    ///
    /// # Errors
    /// [`ZonesError`] if the grid is invalid, does not have as many points as there are zones, or
    /// if a soil is invalid.
    pub fn from_grid(
        grid: ElevationGrid,
        zones: Vec<u8>,
        soils: Vec<Soil>,
    ) -> Result<Self, ZonesError> {
        check(&soils)?;
        let named = zones.iter().filter(|zone| **zone != NO_ZONE);
        if let Some(zone) = named.copied().find(|zone| usize::from(*zone) >= soils.len()) {
            return Err(ZonesError::NoSoil { zone: zone.into(), soils: soils.len() });
        }
        Ok(Self { map: Arc::new(Map::Grid(GridZones::new(grid, zones)?)), soils })
    }

    /// Zones of polygons; a later one covers those before it.
    ///
    /// # Errors
    /// [`ZonesError`] for a polygon with coordinates that are not finite, and for an invalid soil.
    pub fn from_polygons(polygons: &[ZonePolygon], soils: Vec<Soil>) -> Result<Self, ZonesError> {
        check(&soils)?;
        let mut named = polygons.iter().filter_map(|polygon| polygon.soil);
        if let Some(zone) = named.find(|zone| *zone >= soils.len()) {
            return Err(ZonesError::NoSoil { zone, soils: soils.len() });
        }
        Ok(Self { map: Arc::new(Map::Polygons(PolygonZones::new(polygons)?)), soils })
    }

    /// Checks that the zones' soils are valid.
    ///
    /// # Errors
    /// [`ParameterError`] for the first value that is wrong.
    pub fn check(&self) -> Result<(), ParameterError> {
        self.soils.iter().try_for_each(Soil::check)
    }

    /// Which of the soils lies at a place [m]; none where there is no zone.
    #[must_use]
    pub fn zone(&self, at: Vec2) -> Option<usize> {
        self.map.zone(at - self.map.base())
    }

    /// The soil at a place [m]; none where there is no zone.
    #[must_use]
    pub fn soil(&self, at: Vec2) -> Option<&Soil> {
        self.soils.get(self.zone(at)?)
    }

    /// The soils below a footprint, and the share of each: one where all of it is in one zone.
    ///
    /// * `origin`: in the map's coordinates [m]
    /// * `at`: the middle of the footprint, seen from there [m]
    #[must_use]
    pub fn under(&self, origin: Vec2, at: Vec2, footprint: Footprint) -> Vec<Share<'_>> {
        // The map's place is taken off first: it costs no precision.
        let middle = (origin - self.map.base()) + at;
        let soil = |zone: Option<usize>| zone.and_then(|zone| self.soils.get(zone));
        let shares = shares::of(&self.map, middle, footprint).into_iter();
        shares.map(|(zone, weight)| Share { soil: soil(zone), weight }).collect()
    }
}

fn check(soils: &[Soil]) -> Result<(), ZonesError> {
    if soils.len() > MOST_SOILS {
        return Err(ZonesError::TooManySoils { soils: soils.len() });
    }
    Ok(soils.iter().try_for_each(Soil::check)?)
}
