//! Zones by polygons.
//!
//! A place is inside of a polygon if a ray from it to the east crosses its rings an odd number of
//! times, so that rings within rings are holes. Edges are listed by bands from south to north: a
//! place and a wheel meet those of few bands.

use std::ops::RangeInclusive;

use super::border::Border;
use super::error::ZonesError;
use crate::units::Vec2;

/// Ground of one soil within rings.
#[derive(Clone, Debug, PartialEq)]
pub struct ZonePolygon {
    /// Which of the soils, from 0; none for the ground's own.
    pub soil: Option<usize>,
    /// Its outline and its holes: the corners of each [m], in either sense, the last one joined to
    /// the first.
    pub rings: Vec<Vec<Vec2>>,
}

/// More borders than this below a wheel are not looked at one by one.
const MOST_BORDERS: usize = 2_000;

/// An edge of a polygon, from south to north, seen from the base.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Edge {
    south: Vec2,
    north: Vec2,
    polygon: u32,
}

/// Polygons; places are seen from their corner in the south-west.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PolygonZones {
    base: Vec2,
    /// In the order of polygons.
    edges: Vec<Edge>,
    /// The soil of each polygon.
    soils: Vec<Option<usize>>,
    /// How high a band is [m].
    height: f64,
    /// Which of the edges reach into each band, in their order.
    bands: Vec<Vec<u32>>,
}

/// No polygons.
impl Default for PolygonZones {
    fn default() -> Self {
        let (edges, soils, bands) = (Vec::new(), Vec::new(), vec![Vec::new()]);
        Self { base: Vec2::zeros(), edges, soils, height: 1.0, bands }
    }
}

impl PolygonZones {
    pub(super) fn new(polygons: &[ZonePolygon]) -> Result<Self, ZonesError> {
        for (number, polygon) in (1..).zip(polygons) {
            for ring in &polygon.rings {
                check(number, ring)?;
            }
        }
        let corners = || polygons.iter().flat_map(|polygon| polygon.rings.iter().flatten());
        let base = corners().copied().reduce(|low, at| low.inf(&at)).unwrap_or_default();
        let top = corners().map(|at| at.y - base.y).fold(0.0, f64::max);
        let mut edges = Vec::new();
        for (polygon, ZonePolygon { rings, .. }) in (0_u32..).zip(polygons) {
            for ring in rings {
                let next = ring.iter().skip(1).chain(ring.first());
                edges.extend(ring.iter().zip(next).map(|(one, other)| {
                    let [one, other] = [one, other].map(|corner| corner - base);
                    let [south, north] = if one.y <= other.y { [one, other] } else { [other, one] };
                    Edge { south, north, polygon }
                }));
            }
        }
        let soils = polygons.iter().map(|polygon| polygon.soil).collect();
        let mut zones = Self { base, edges, soils, height: top, bands: Vec::new() };
        zones.sort_into_bands(top);
        Ok(zones)
    }

    /// Lists the edges by bands: as many bands as keep the lists short.
    fn sort_into_bands(&mut self, top: f64) {
        /// Entries of all lists for each edge, at most, and for all edges together.
        const ENTRIES: (usize, usize) = (4, 1000);
        let mut bands = self.edges.len().clamp(1, 1 << 16);
        let most = ENTRIES.0 * self.edges.len() + ENTRIES.1;
        loop {
            self.height = if top > 0.0 { top / bands as f64 } else { 1.0 };
            self.bands = vec![Vec::new(); bands];
            let entries: usize = self.edges.iter().map(|edge| self.bands_of(edge).count()).sum();
            if entries <= most || bands == 1 {
                break;
            }
            bands = bands.div_ceil(2);
        }
        for (number, edge) in (0_u32..).zip(&self.edges) {
            let bands = self.bands_of(edge);
            self.bands[bands].iter_mut().for_each(|edges| edges.push(number));
        }
    }

    fn bands_of(&self, edge: &Edge) -> RangeInclusive<usize> {
        self.band(edge.south.y)..=self.band(edge.north.y)
    }

    /// The band of a place; that of the nearest edge for one beyond all.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place between zero and the number of bands"
    )]
    fn band(&self, y: f64) -> usize {
        ((y / self.height).max(0.0) as usize).min(self.bands.len() - 1)
    }

    pub(super) fn base(&self) -> Vec2 {
        self.base
    }

    pub(super) fn zone(&self, at: Vec2) -> Option<usize> {
        let edges = self.bands[self.band(at.y)].iter().map(|edge| &self.edges[*edge as usize]);
        let crossed = edges.filter(|edge| edge.is_east_of(at));
        let (mut last, mut current) = (None, (u32::MAX, false));
        // The edges of a polygon follow each other; the last polygon that has the place covers the
        // others.
        for Edge { polygon, .. } in crossed {
            if *polygon != current.0 {
                last = if current.1 { Some(current.0) } else { last };
                current = (*polygon, false);
            }
            current.1 = !current.1;
        }
        last = if current.1 { Some(current.0) } else { last };
        last.and_then(|polygon| self.soils[polygon as usize])
    }

    pub(super) fn borders(&self, about: Vec2, reach: Vec2) -> Option<Vec<Border>> {
        let (low, high) = (about - reach, about + reach);
        let [from, to] = [low.y, high.y].map(|y| self.band(y));
        let mut borders = Vec::new();
        for (number, edges) in (from..).zip(&self.bands[from..=to]) {
            for edge in edges.iter().map(|edge| &self.edges[*edge as usize]) {
                // An edge of several bands is taken in the first.
                let is_new = number == from || *self.bands_of(edge).start() == number;
                if is_new && edge.comes_near(low, high) {
                    borders.push([edge.south, edge.north]);
                }
            }
        }
        (borders.len() <= MOST_BORDERS).then_some(borders)
    }
}

impl Edge {
    /// Whether a ray from a place to the east crosses it. Of an edge's ends, the northern one does
    /// not count.
    fn is_east_of(&self, at: Vec2) -> bool {
        let Self { south, north, .. } = *self;
        if !(south.y <= at.y && at.y < north.y) {
            return false;
        }
        let (way, there) = (north - south, at - south);
        way.x * there.y > there.x * way.y
    }

    /// Whether its box and another one meet.
    fn comes_near(&self, low: Vec2, high: Vec2) -> bool {
        let Self { south, north, .. } = *self;
        south.y <= high.y
            && north.y >= low.y
            && south.x.min(north.x) <= high.x
            && south.x.max(north.x) >= low.x
    }
}

fn check(polygon: usize, ring: &[Vec2]) -> Result<(), ZonesError> {
    if let Some(corner) = ring.iter().find(|corner| !corner.iter().all(|part| part.is_finite())) {
        return Err(ZonesError::Corner { polygon, x: corner.x, y: corner.y });
    }
    if ring.len() < 3 {
        return Err(ZonesError::Ring { polygon, corners: ring.len() });
    }
    Ok(())
}
