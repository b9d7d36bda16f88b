//! Zones before their soils are known.

use grouser_core::soil::Soil;
use grouser_core::terrain::zones::{MOST_SOILS, NO_ZONE};
use grouser_core::terrain::{ElevationGrid, Extent, SoilZones, ZonePolygon};
use grouser_core::units::Vec2;

use super::key::ZoneKey;
use super::places::{MapFrame, PlacesSystem, check_places};
use crate::degrees::may_be_degrees;
use crate::error::Fault;
use crate::{CoordinateSystem, Remark};

/// Zones as a file has them.
#[derive(Clone, Debug, PartialEq)]
pub struct ZoneMap {
    /// Ascending.
    keys: Vec<ZoneKey>,
    shape: Shape,
    system: PlacesSystem,
}

/// How many zones there are: cells of a raster that have one, or areas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ZoneCounts {
    /// All: also cells without a zone.
    pub there: u64,
    /// Those whose span meets that of the ground.
    pub used: u64,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    /// The number of each cell's key, or [`NO_ZONE`].
    Cells(ElevationGrid, Vec<u8>),
    /// Each with the number of its key in place of a soil's.
    Polygons(Vec<ZonePolygon>, Option<Extent>),
}

impl ZoneMap {
    /// * `keys`: ascending
    /// * `cells`: the number of each cell's key, or [`NO_ZONE`]
    pub(super) fn of_cells(
        keys: Vec<ZoneKey>,
        grid: ElevationGrid,
        cells: Vec<u8>,
        system: CoordinateSystem,
    ) -> Self {
        Self { keys, shape: Shape::Cells(grid, cells), system: PlacesSystem::OfGrid(system) }
    }

    /// * `polygons`: each with its key
    pub(super) fn of_polygons(
        polygons: Vec<(ZoneKey, Vec<Vec<Vec2>>)>,
        system: PlacesSystem,
    ) -> Result<Self, Fault> {
        let mut keys: Vec<ZoneKey> = polygons.iter().map(|(key, _)| key.clone()).collect();
        keys.sort();
        keys.dedup();
        check_count(&keys)?;
        let extent = Extent::around(polygons.iter().flat_map(|(_, rings)| rings.iter().flatten()));
        let number = |key: &ZoneKey| keys.binary_search(key).unwrap_or(keys.len());
        let polygons = polygons
            .into_iter()
            .map(|(key, rings)| ZonePolygon { soil: Some(number(&key)), rings })
            .collect();
        Ok(Self { keys, shape: Shape::Polygons(polygons, extent), system })
    }

    /// All that the file calls its zones, ascending.
    #[must_use]
    pub fn keys(&self) -> &[ZoneKey] {
        &self.keys
    }

    /// The corners of all zones; none if the file has no zone.
    #[must_use]
    pub fn extent(&self) -> Option<Extent> {
        match &self.shape {
            Shape::Cells(grid, _) => Some(grid.extent()),
            Shape::Polygons(_, extent) => *extent,
        }
    }

    /// Whether it is a raster of cells, not areas.
    #[must_use]
    pub fn is_raster(&self) -> bool {
        matches!(self.shape, Shape::Cells(..))
    }

    /// How many zones there are, and how many lie on the ground that they are for.
    ///
    /// * `ground`: without an end, if it has none
    #[must_use]
    pub fn counts(&self, ground: Option<&Extent>) -> ZoneCounts {
        let is_on = |it: &Extent| ground.is_none_or(|ground| !it.is_apart_from(ground));
        let (there, used) = match &self.shape {
            Shape::Cells(grid, cells) => {
                let is_used = |(place, zone): &(usize, &u8)| {
                    let (column, row) = (place % grid.columns, place / grid.columns);
                    let offset = Vec2::new(column as f64, row as f64);
                    let at = grid.south_west + grid.spacing.component_mul(&offset);
                    let half = 0.5 * grid.spacing;
                    let cell = Extent { south_west: at - half, north_east: at + half };
                    **zone != NO_ZONE && is_on(&cell)
                };
                (cells.len(), cells.iter().enumerate().filter(is_used).count())
            }
            Shape::Polygons(polygons, _) => {
                let is_used = |polygon: &&ZonePolygon| {
                    Extent::around(polygon.rings.iter().flatten()).is_some_and(|it| is_on(&it))
                };
                (polygons.len(), polygons.iter().filter(is_used).count())
            }
        };
        ZoneCounts { there: there as u64, used: used as u64 }
    }

    /// The zones with their soils.
    ///
    /// * `legend`: for each key which of the soils it means, or none for the scenario's own
    ///
    /// # Errors
    /// [`Fault::NotInLegend`] with all keys of the file that the legend does not have.
    pub fn with_legend(
        self,
        legend: &[(ZoneKey, Option<usize>)],
        soils: Vec<Soil>,
    ) -> Result<SoilZones, Fault> {
        let meaning =
            |key: &ZoneKey| legend.iter().find(|(of, _)| of == key).map(|(_, soil)| *soil);
        let missing: Vec<_> =
            self.keys.iter().filter(|key| meaning(key).is_none()).cloned().collect();
        if !missing.is_empty() {
            return Err(Fault::NotInLegend { keys: missing });
        }
        let soil_of: Vec<Option<usize>> =
            self.keys.iter().map(|key| meaning(key).flatten()).collect();
        Ok(match self.shape {
            Shape::Cells(grid, mut cells) => {
                let number = |soil: Option<usize>| {
                    soil.map_or(Some(NO_ZONE), |soil| u8::try_from(soil).ok())
                };
                let too_many = Fault::TooManyZones { zones: soils.len() };
                let numbers: Option<Vec<u8>> = soil_of.iter().map(|soil| number(*soil)).collect();
                let numbers = numbers.ok_or(too_many)?;
                for cell in cells.iter_mut().filter(|cell| **cell != NO_ZONE) {
                    *cell = numbers[usize::from(*cell)];
                }
                SoilZones::from_grid(grid, cells, soils)?
            }
            Shape::Polygons(polygons, _) => {
                let of_soil = polygons.into_iter().map(|ZonePolygon { soil, rings }| ZonePolygon {
                    soil: soil.and_then(|key| soil_of[key]),
                    rings,
                });
                SoilZones::from_polygons(&of_soil.collect::<Vec<_>>(), soils)?
            }
        })
    }

    /// Checks that the zones are in the system of the map that they are for, and that some of them
    /// lie on it; a remark where nobody can compare the systems.
    pub(super) fn check_place(&self, map: Option<&MapFrame<'_>>) -> Result<Option<Remark>, Fault> {
        let Some(MapFrame { system, extent: ground }) = map else {
            // Ground by a formula has no end.
            return self.extent().map_or(Ok(()), |it| check_places(None, &it)).map(|()| None);
        };
        let remark = system.map_or(Ok(None), |system| self.system.compare(system))?;
        let Some(zones) = self.extent() else { return Ok(remark) };
        if self.counts(Some(ground)).used > 0 {
            return Ok(remark);
        }
        Err(if may_be_degrees(&zones) {
            Fault::ZonesInDegrees
        } else {
            Fault::Elsewhere { zones, ground: *ground }
        })
    }
}

/// Checks that there are no more zones than can be distinguished.
pub(super) fn check_count(keys: &[ZoneKey]) -> Result<(), Fault> {
    if keys.len() > MOST_SOILS {
        return Err(Fault::TooManyZones { zones: keys.len() });
    }
    Ok(())
}
