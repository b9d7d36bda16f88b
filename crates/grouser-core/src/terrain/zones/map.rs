//! A map of zones of either kind.

use super::border::Border;
use super::grid::GridZones;
use super::polygons::PolygonZones;
use crate::units::Vec2;

/// A map of zones; places are seen from its base.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Map {
    Grid(GridZones),
    Polygons(PolygonZones),
}

/// No zones.
impl Default for Map {
    fn default() -> Self {
        Self::Polygons(PolygonZones::default())
    }
}

impl Map {
    pub(super) fn base(&self) -> Vec2 {
        match self {
            Self::Grid(grid) => grid.base(),
            Self::Polygons(polygons) => polygons.base(),
        }
    }

    pub(super) fn zone(&self, at: Vec2) -> Option<usize> {
        match self {
            Self::Grid(grid) => grid.zone(at),
            Self::Polygons(polygons) => polygons.zone(at),
        }
    }

    /// All borders that come near a place, and perhaps some more; none where there are very many.
    ///
    /// * `reach`: how far that is to the east and to the north [m]
    pub(super) fn borders(&self, about: Vec2, reach: Vec2) -> Option<Vec<Border>> {
        match self {
            Self::Grid(grid) => grid.borders(about, reach),
            Self::Polygons(polygons) => polygons.borders(about, reach),
        }
    }
}
