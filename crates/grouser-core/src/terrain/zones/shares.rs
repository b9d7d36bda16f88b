//! The shares of zones below a footprint.
//!
//! In the footprint's coordinates, a along it and b across it, both from −1 to 1, borders are
//! straight pieces. Between the ends and crossings of all of them the footprint is cut into strips
//! across it; within one, the borders stand in one order, and what is between two neighbours
//! belongs to one zone. Gauss's rule with two nodes along a strip has its weight exactly: the
//! integrand is of degree three.

use super::border::{Border, across, clipped, crossing};
use super::map::Map;
use crate::terrain::footprint::Footprint;
use crate::units::Vec2;

/// With more borders below a footprint, the shares are those of points of it.
const MOST_BORDERS: usize = 64;

/// Nodes of Gauss's rule with two nodes, from −1 to 1; both weights are 1.
const GAUSS: [f64; 2] = [-0.577_350_269_189_625_8, 0.577_350_269_189_625_8];

/// The zones of a footprint, in their order, and the share of each.
///
/// * `middle`: of the footprint, seen from the map's base [m]
pub(super) fn of(map: &Map, middle: Vec2, footprint: Footprint) -> Vec<(Option<usize>, f64)> {
    let Footprint { forward, half_length, half_width } = footprint;
    let left = Vec2::new(-forward.y, forward.x);
    let reach = half_length * forward.abs() + half_width * left.abs();
    let place = |at: Vec2| middle + at.x * half_length * forward + at.y * half_width * left;
    let mut shares = Shares { map, place: &place, found: Vec::new() };
    let inside = |border: Border| {
        let ends = border.map(|end| {
            let from = end - middle;
            Vec2::new(from.dot(&forward) / half_length, from.dot(&left) / half_width)
        });
        clipped(ends)
    };
    let borders = map.borders(middle, reach);
    let borders: Option<Vec<Border>> =
        borders.map(|borders| borders.into_iter().filter_map(inside).collect());
    match borders {
        Some(borders) if borders.is_empty() => return vec![(map.zone(middle), 1.0)],
        Some(borders) if borders.len() <= MOST_BORDERS => shares.by_strips(&borders),
        _ => shares.by_points(),
    }
    let mut found = shares.found;
    found.retain(|(_, weight)| *weight > 0.0);
    found.sort_by_key(|(zone, _)| *zone);
    if let [(_, weight)] = &mut found[..] {
        *weight = 1.0;
    }
    found
}

struct Shares<'a> {
    map: &'a Map,
    /// From the footprint's coordinates to the map's.
    place: &'a dyn Fn(Vec2) -> Vec2,
    found: Vec<(Option<usize>, f64)>,
}

impl Shares<'_> {
    /// Counts a piece, of which one place is given.
    fn add(&mut self, at: Vec2, weight: f64) {
        let zone = self.map.zone((self.place)(at));
        match self.found.iter_mut().find(|(other, _)| *other == zone) {
            Some((_, sum)) => *sum += weight,
            None => self.found.push((zone, weight)),
        }
    }

    fn by_strips(&mut self, borders: &[Border]) {
        let mut ends: Vec<f64> = borders.iter().flatten().map(|end| end.x).collect();
        ends.extend([-1.0, 1.0]);
        for (at, one) in borders.iter().enumerate() {
            ends.extend(borders[..at].iter().filter_map(|other| crossing(one, other)));
        }
        ends.sort_by(f64::total_cmp);
        for strip in ends.windows(2).filter(|strip| strip[1] > strip[0]) {
            self.by_strip(borders, strip[0], strip[1]);
        }
    }

    /// A strip in which no border begins or ends, and no two cross.
    fn by_strip(&mut self, borders: &[Border], from: f64, to: f64) {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let through = |border: &&Border| {
            let (low, high) = (border[0].x.min(border[1].x), border[0].x.max(border[1].x));
            low < middle && middle < high
        };
        let mut through: Vec<&Border> = borders.iter().filter(through).collect();
        through.sort_by(|one, other| across(one, middle).total_cmp(&across(other, middle)));
        let nodes = GAUSS.map(|node| middle + half * node);
        let mut low = [-1.0; GAUSS.len()];
        for border in through.into_iter().map(Some).chain([None]) {
            let high = nodes.map(|along| border.map_or(1.0, |border| across(border, along)));
            let of = |node: usize| weight_at(nodes[node]) * 0.5 * (high[node] - low[node]);
            let centre = 0.25 * (low[0] + low[1] + high[0] + high[1]);
            self.add(Vec2::new(middle, centre), half * (of(0) + of(1)));
            low = high;
        }
    }

    /// By the middles of equal pieces.
    fn by_points(&mut self) {
        const PIECES: u32 = 16;
        let size = 2.0 / f64::from(PIECES);
        let end = |piece: u32| -1.0 + size * f64::from(piece);
        let weight = |piece: u32| weight_before(end(piece + 1)) - weight_before(end(piece));
        for a in 0..PIECES {
            for b in 0..PIECES {
                let at = Vec2::new(end(a) + 0.5 * size, end(b) + 0.5 * size);
                self.add(at, weight(a) * 0.5 * size);
            }
        }
    }
}

/// How much a place along the footprint counts, *w* [-].
fn weight_at(along: f64) -> f64 {
    0.75 * (1.0 - along * along)
}

/// How much all before a place counts [-]: the integral of *w*.
fn weight_before(at: f64) -> f64 {
    0.5 + 0.25 * at * (3.0 - at * at)
}
