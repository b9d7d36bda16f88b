//! The ground's heights at the points of a grid: shades and contour lines.

use crate::sheet::Place;
use grouser_core::terrain::{Footprint, Terrain};
use grouser_core::units::{Vec2, Vec3};

use super::view::View;
use crate::style::Role;

/// Cells along the longer side.
const CELLS: f64 = 44.0;
/// Colours of the ground from what is turned to the light to what is turned away from it.
const SHADES: [Role; 4] = [Role::Soil, Role::SoilEdge, Role::Contour, Role::Track];
/// Where the light comes from: north-west, 45° high.
const LIGHT: Vec3 = Vec3::new(-0.5, 0.5, std::f64::consts::FRAC_1_SQRT_2);

/// Heights of the ground, from the start [m].
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    /// The south-western corner.
    pub(super) low: Vec2,
    /// Distance of neighbours.
    step: f64,
    columns: usize,
    rows: usize,
    /// In rows from south to north; none where the map has no heights.
    heights: Vec<Option<f64>>,
}

impl Surface {
    /// The ground around a way.
    ///
    /// * `places`: along it [m]
    /// * `margin`: how far around it [m]
    pub(super) fn around(
        terrain: &dyn Terrain,
        places: impl Iterator<Item = Vec2>,
        margin: f64,
    ) -> Self {
        let far = Vec2::repeat(f64::INFINITY);
        let [low, high] = places.fold([far, -far], |[low, high], at| [low.inf(&at), high.sup(&at)]);
        // A way along an axis leaves room to either side.
        let room = Vec2::repeat(margin.max(0.2 * (high - low).max()));
        let (low, size) = (low - room, high - low + 2.0 * room);
        let step = size.max() / CELLS;
        let count = |length: f64| {
            1 + (0..1000_u16).take_while(|cell| f64::from(*cell) + 0.5 < length / step).count()
        };
        let (columns, rows) = (count(size.x), count(size.y));
        let mut surface = Self { low, step, columns, rows, heights: Vec::new() };
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        let footprint =
            Footprint { forward: Vec2::x(), half_length: 0.1 * step, half_width: 0.1 * step };
        let height = |(column, row)| {
            let at = surface.at(column, row);
            terrain.covers(at, footprint).then(|| terrain.patch(at, footprint).height)
        };
        surface.heights = cells.map(height).collect();
        surface
    }

    fn at(&self, column: usize, row: usize) -> Vec2 {
        self.low + self.step * Vec2::new(column as f64, row as f64)
    }

    fn point(&self, column: usize, row: usize) -> Option<Vec3> {
        let height = (*self.heights.get(row * self.columns + column)?)?;
        Some(self.at(column, row).push(height))
    }

    /// [m]
    pub(super) fn size(&self) -> Vec2 {
        self.at(self.columns - 1, self.rows - 1) - self.low
    }

    /// The lowest and the highest point [m].
    pub(super) fn heights_between(&self) -> [f64; 2] {
        let known = self.heights.iter().flatten();
        let ends = known.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], height| {
            [low.min(*height), high.max(*height)]
        });
        if ends[0] <= ends[1] { ends } else { [0.0, 0.0] }
    }

    /// Corners of the box around it.
    pub(super) fn corners(&self) -> Vec<Vec3> {
        let (low, high) = (self.low, self.low + self.size());
        let ends = self.heights_between();
        let seen_from_above =
            [low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)].into_iter();
        seen_from_above.flat_map(|at| ends.map(|height| at.push(height))).collect()
    }

    /// Its cells from back to front, those of one shade beside each other in one piece.
    pub(super) fn shades<'a>(
        &'a self,
        view: &'a View,
    ) -> impl Iterator<Item = (Vec<Place>, Role)> + 'a {
        // From north to south, and within a row from west to east: the eye is in the south-east.
        let rows = (0..self.rows - 1).rev();
        rows.flat_map(move |row| self.pieces(row)).map(move |(points, role)| {
            (points.into_iter().map(|point| view.place(point)).collect(), role)
        })
    }

    /// The pieces of a row, each with its outline.
    fn pieces(&self, row: usize) -> Vec<(Vec<Vec3>, Role)> {
        let mut pieces: Vec<(Vec<Vec3>, Vec<Vec3>, Role)> = Vec::new();
        let mut is_on = false;
        for column in 0..self.columns - 1 {
            let at = |right, up| self.point(column + right, row + up);
            let (Some(a), Some(b), Some(c), Some(d)) = (at(0, 0), at(1, 0), at(1, 1), at(0, 1))
            else {
                is_on = false;
                continue;
            };
            let role = shade_of((c - a).cross(&(d - b)));
            match pieces.last_mut() {
                Some((south, north, of)) if is_on && *of == role => {
                    south.push(b);
                    north.push(c);
                }
                _ => pieces.push((vec![a, b], vec![d, c], role)),
            }
            is_on = true;
        }
        let outline = |(mut south, north, role): (Vec<Vec3>, Vec<Vec3>, Role)| {
            south.extend(north.into_iter().rev());
            (south, role)
        };
        pieces.into_iter().map(outline).collect()
    }

    /// Its cells, each as a quadrilateral with its corners counter-clockwise as seen from above.
    pub(crate) fn cells(&self) -> impl Iterator<Item = [Vec3; 4]> + '_ {
        let cells = (0..self.rows - 1)
            .flat_map(|row| (0..self.columns - 1).map(move |column| (column, row)));
        cells.filter_map(|(column, row)| {
            let at = |right, up| self.point(column + right, row + up);
            Some([at(0, 0)?, at(1, 0)?, at(1, 1)?, at(0, 1)?])
        })
    }

    /// Lines of equal height, as pieces within cells.
    ///
    /// * `step`: between their heights [m]
    pub(crate) fn contours(&self, step: f64) -> Vec<[Vec3; 2]> {
        let mut lines = Vec::new();
        for [a, b, c, d] in self.cells() {
            for triangle in [[a, b, c], [a, c, d]] {
                let heights = triangle.map(|point| point.z);
                let low = heights.into_iter().fold(f64::INFINITY, f64::min);
                let high = heights.into_iter().fold(f64::NEG_INFINITY, f64::max);
                let first = (low / step).ceil();
                let levels = std::iter::successors(Some(first), |level| Some(level + 1.0));
                for level in levels.map(|level| level * step).take_while(|level| *level < high) {
                    lines.extend(across(&triangle, level));
                }
            }
        }
        lines
    }
}

/// How light a piece of ground is, with the light from the north-west.
///
/// * `normal`: out of the ground
#[must_use]
pub fn shade_of(normal: Vec3) -> Role {
    /// What a level piece has, and how fast slopes change it.
    const LEVEL: f64 = 1.0;
    const CONTRAST: f64 = 6.0;
    let level = LIGHT.z;
    let light = normal.try_normalize(0.0).map_or(level, |normal| normal.dot(&LIGHT));
    let darker = LEVEL + CONTRAST * (level - light);
    let passed = (1..SHADES.len()).filter(|shade| darker >= *shade as f64 - 0.5);
    SHADES[passed.count()]
}

/// Where a height runs through a triangle.
fn across(triangle: &[Vec3; 3], level: f64) -> Option<[Vec3; 2]> {
    let crossing = |from: Vec3, to: Vec3| {
        let is_between = (from.z < level) != (to.z < level);
        let share = (level - from.z) / (to.z - from.z);
        is_between.then(|| (from.xy() + share * (to.xy() - from.xy())).push(level))
    };
    let [a, b, c] = *triangle;
    let mut ends = [crossing(a, b), crossing(b, c), crossing(c, a)].into_iter().flatten();
    Some([ends.next()?, ends.next()?])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A plane that rises by 0.1 m/m to the north, and has a hole.
    fn plane() -> Surface {
        let mut surface = Surface {
            low: Vec2::new(-1.0, -2.0),
            step: 0.25,
            columns: 9,
            rows: 17,
            heights: Vec::new(),
        };
        let cells = (0..17).flat_map(|row| (0..9).map(move |column| (column, row)));
        surface.heights = cells
            .map(|(column, row)| (column, row) != (4, 8))
            .zip((0..17).flat_map(|row| (0..9).map(move |_| row)))
            .map(|(is_known, row)| is_known.then(|| 0.1 * (0.25 * f64::from(row) - 2.0)))
            .collect();
        surface
    }

    #[test]
    fn contours_of_a_plane_are_level_lines() {
        let lines = plane().contours(0.03);
        assert!(!lines.is_empty());
        for [from, to] in &lines {
            assert!((from.y - to.y).abs() < 1e-12, "{from} {to}");
            let level = 0.1 * from.y / 0.03;
            assert!((level - level.round()).abs() < 1e-9, "{level}");
        }
        // Thirteen lines of 2 m, of which two or three are cut by the hole.
        let length: f64 = lines.iter().map(|[from, to]| (to - from).norm()).sum();
        assert!((24.0..25.6).contains(&length), "{length}");
    }

    #[test]
    fn pieces_of_one_shade_are_one_but_for_holes() {
        let surface = plane();
        assert_eq!(surface.pieces(0).len(), 1);
        assert_eq!(surface.pieces(8).len(), 2);
        let slopes =
            [Vec3::z(), Vec3::new(0.3, -0.3, 1.0), Vec3::new(-0.3, 0.3, 1.0)].map(shade_of);
        assert_eq!(slopes, [Role::SoilEdge, Role::Track, Role::Soil]);
    }
}
