//! Lines and areas of a picture, in colours by role.

use crate::sheet::{Place, Shape, Sheet, Stroke};
use grouser_core::units::Vec3;

use crate::style::{Ground, Role};

/// A line, or an area, or both.
#[derive(Clone, Debug)]
pub(crate) struct Mark {
    /// On the picture [mm].
    pub(crate) points: Vec<Place>,
    pub(crate) fill: Option<Role>,
    pub(crate) line: Option<Line>,
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    pub(crate) role: Role,
    /// Its width [mm].
    pub(crate) width: f64,
    pub(crate) dashed: bool,
}

/// Lengths of dashes and of the gaps between them [mm].
pub(crate) const DASHES: [f64; 2] = [1.6, 1.1];

impl Line {
    pub(crate) const fn new(role: Role, width: f64) -> Self {
        Self { role, width, dashed: false }
    }

    pub(crate) const fn dashed(self) -> Self {
        Self { dashed: true, ..self }
    }
}

impl Mark {
    pub(crate) fn line(points: impl IntoIterator<Item = Place>, line: Line) -> Self {
        Self { points: points.into_iter().collect(), fill: None, line: Some(line) }
    }

    pub(crate) fn area(points: impl IntoIterator<Item = Place>, fill: Role) -> Self {
        Self { points: points.into_iter().collect(), fill: Some(fill), line: None }
    }

    pub(crate) fn outlined(self, line: Line) -> Self {
        Self { line: Some(line), ..self }
    }

    pub(crate) fn moved(mut self, by: Place) -> Self {
        for point in &mut self.points {
            *point = [point[0] + by[0], point[1] + by[1]];
        }
        self
    }

    /// Its parts inside a convex area: of a line all pieces, of an area one.
    pub(crate) fn within(&self, area: &[Place]) -> Vec<Self> {
        if self.fill.is_some() {
            let inside = edges(area).fold(self.points.clone(), |points, edge| {
                cut(&points, |point| side(edge, *point), between)
            });
            return vec![Self { points: inside, ..self.clone() }];
        }
        let mut pieces: Vec<Vec<Place>> = Vec::new();
        for pair in self.points.windows(2) {
            let Some([start, end]) = segment_within([pair[0], pair[1]], area) else { continue };
            match pieces.last_mut() {
                Some(piece) if piece.last() == Some(&start) => piece.push(end),
                _ => pieces.push(vec![start, end]),
            }
        }
        pieces.into_iter().map(|points| Self { points, ..self.clone() }).collect()
    }

    pub(crate) fn draw(&self, sheet: &mut Sheet, ground: Ground) {
        let points = self.points.iter().copied();
        let stroke = self.line.map(|line| {
            let stroke = Stroke::new(line.width, line.role.on(ground)).rounded();
            if line.dashed { stroke.dashed(DASHES[0], DASHES[1]) } else { stroke }
        });
        let shape = match (self.fill, stroke) {
            (Some(fill), Some(stroke)) => Shape::area(points, fill.on(ground)).outlined(stroke),
            (Some(fill), None) => Shape::area(points, fill.on(ground)),
            (None, Some(stroke)) => Shape::line(points, stroke),
            (None, None) => return,
        };
        sheet.draw(shape);
    }
}

/// An arrow with a filled head.
pub(crate) fn arrow(tail: Place, way: Place, role: Role, width: f64) -> Vec<Mark> {
    let length = way[0].hypot(way[1]);
    let head = (4.2 * width).min(0.6 * length);
    if length < 0.3 {
        return Vec::new();
    }
    let [x, y] = way.map(|part| part / length);
    let at = |along: f64, across: f64| {
        [tail[0] + along * x - across * y, tail[1] + along * y + across * x]
    };
    let neck = length - head;
    vec![
        Mark::line([tail, at(neck, 0.0)], Line::new(role, width)),
        Mark::area([at(length, 0.0), at(neck, 0.42 * head), at(neck, -0.42 * head)], role)
            .outlined(Line::new(role, 0.25 * width)),
    ]
}

/// The part of a polygon of points of the slope frame that is over the surface.
pub(crate) fn over_ground(points: &[Vec3]) -> Vec<Vec3> {
    cut(points, |point| point.z, |a, b, share| a + (b - a) * share)
}

/// The part of a polygon on the side of a straight cut where a measure is not negative.
fn cut<P: Copy>(
    points: &[P],
    measure: impl Fn(&P) -> f64,
    between: impl Fn(P, P, f64) -> P,
) -> Vec<P> {
    let mut kept = Vec::with_capacity(points.len() + 2);
    for (index, &point) in points.iter().enumerate() {
        let next = points[(index + 1) % points.len()];
        let (here, there) = (measure(&point), measure(&next));
        if here >= 0.0 {
            kept.push(point);
        }
        if (here >= 0.0) != (there >= 0.0) {
            kept.push(between(point, next, here / (here - there)));
        }
    }
    kept
}

fn between(a: Place, b: Place, share: f64) -> Place {
    [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]
}

/// The edges of an area, each from point to point.
fn edges(area: &[Place]) -> impl Iterator<Item = [Place; 2]> + '_ {
    (0..area.len()).map(|index| [area[index], area[(index + 1) % area.len()]])
}

/// How far a point is on the inner side of an edge, times the edge's length. Areas are listed
/// clockwise as seen on the picture.
fn side([start, end]: [Place; 2], point: Place) -> f64 {
    (end[0] - start[0]) * (point[1] - start[1]) - (end[1] - start[1]) * (point[0] - start[0])
}

fn segment_within([start, end]: [Place; 2], area: &[Place]) -> Option<[Place; 2]> {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for edge in edges(area) {
        let (here, there) = (side(edge, start), side(edge, end));
        if here < 0.0 && there < 0.0 {
            return None;
        }
        let share = here / (here - there);
        if here < 0.0 {
            from = from.max(share);
        } else if there < 0.0 {
            to = to.min(share);
        }
    }
    let at = |share: f64| match share {
        0.0 => start,
        1.0 => end,
        _ => between(start, end, share),
    };
    (from < to).then(|| [at(from), at(to)])
}

/// The smallest convex area around points, clockwise as seen on the picture.
pub(crate) fn hull(mut points: Vec<Place>) -> Vec<Place> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let half = |points: &mut dyn Iterator<Item = Place>| {
        let mut chain: Vec<Place> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..] {
                if side([a, b], point) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut all = half(&mut points.iter().copied());
    all.extend(half(&mut points.iter().rev().copied()));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [Place; 4] = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];

    #[test]
    fn lines_and_areas_are_cut_at_the_edge() {
        let line = Mark::line([[-5.0, 5.0], [5.0, 5.0], [15.0, 5.0]], Line::new(Role::Ink, 1.0));
        let pieces = line.within(&SQUARE);
        assert_eq!(pieces.len(), 1);
        assert_eq!(pieces[0].points, [[0.0, 5.0], [5.0, 5.0], [10.0, 5.0]]);
        let beside = Mark::line([[-5.0, 0.0], [-5.0, 9.0]], Line::new(Role::Ink, 1.0));
        assert!(beside.within(&SQUARE).is_empty());
        let area = Mark::area([[5.0, 5.0], [15.0, 5.0], [15.0, 8.0], [5.0, 8.0]], Role::Track);
        let inside = &area.within(&SQUARE)[0].points;
        assert!(inside.iter().all(|point| point[0] <= 10.0) && inside.len() == 4, "{inside:?}");
    }

    #[test]
    fn a_hull_leaves_out_what_is_inside() {
        let mut points = SQUARE.to_vec();
        points.push([5.0, 5.0]);
        let hull = hull(points);
        assert_eq!(hull.len(), 4);
        assert!(edges(&hull).all(|edge| side(edge, [5.0, 5.0]) > 0.0));
    }

    #[test]
    fn what_is_below_the_surface_is_cut_away() {
        let upright =
            [Vec3::new(0.0, 0.0, -1.0), Vec3::new(1.0, 0.0, -1.0), Vec3::new(0.5, 0.0, 1.0)];
        let above = over_ground(&upright);
        assert_eq!(above.len(), 3);
        assert!(above.iter().all(|point| point.z >= 0.0));
    }
}
