//! Predictions without physics, to compare models with: the mean of a set, and interpolation within
//! it.
//!
//! A model that is not better than these has nothing to say about that set. They have seen the
//! other measurements of the set, so a model from published constants that comes near them is good.

/// A prediction from the other measurements of a set alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Yardstick {
    /// The mean of all cells, the predicted one among them: its score is 1.
    Mean,
    /// Linear over slip (over slope, of a rover) between the neighbouring cells of the same slip
    /// angle (course), the predicted one left out; beyond the last one its value.
    Interpolation,
    /// Linear over slip angle between the neighbouring ones, the predicted angle left out as a
    /// whole, each interpolated to the same slip; beyond the last angle its value.
    AngleLeftOut,
}

/// A measured mean and its place in a set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// What a series has in common: the slip angle [rad], or the course [rad].
    pub series: f64,
    /// Place within the series: the slip by the total speed [-], or the slope [rad].
    pub x: f64,
    /// Measured.
    pub value: f64,
}

impl Yardstick {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Mean, Self::Interpolation, Self::AngleLeftOut];

    /// Its name in results.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mean => "mean",
            Self::Interpolation => "interpolation",
            Self::AngleLeftOut => "angle-left-out",
        }
    }

    /// Predicts every measurement from the others; `None` where there are no others to predict it
    /// from.
    #[must_use]
    pub fn predict(self, all: &[Placed]) -> Vec<Option<f64>> {
        match self {
            Self::Mean => {
                let mean = all.iter().map(|it| it.value).sum::<f64>() / all.len() as f64;
                vec![Some(mean); all.len()]
            }
            Self::Interpolation => {
                let series = Series::of(all);
                all.iter()
                    .enumerate()
                    .map(|(own, it)| of_series(&series, it).without(own))
                    .collect()
            }
            Self::AngleLeftOut => {
                let series = Series::of(all);
                all.iter().map(|it| across(&series, it)).collect()
            }
        }
    }
}

/// The measurements of one slip angle, by their slip.
struct Series {
    angle: f64,
    /// Slip, value, and place among all.
    points: Vec<(f64, f64, usize)>,
}

impl Series {
    /// All series, by their angle.
    fn of(all: &[Placed]) -> Vec<Self> {
        let mut sorted: Vec<(usize, &Placed)> = all.iter().enumerate().collect();
        sorted.sort_by(|(_, one), (_, other)| {
            one.series.total_cmp(&other.series).then(one.x.total_cmp(&other.x))
        });
        let series = sorted.chunk_by(|(_, one), (_, other)| one.series == other.series);
        let one = |members: &[(usize, &Placed)]| Self {
            angle: members[0].1.series,
            points: members.iter().map(|(own, it)| (it.x, it.value, *own)).collect(),
        };
        series.map(one).collect()
    }

    /// The value at the place of a measurement, from its neighbours.
    fn without(&self, own: usize) -> Option<f64> {
        let place = self.points.iter().position(|(.., other)| *other == own)?;
        let before = place.checked_sub(1).map(|before| &self.points[before]);
        between(before, self.points.get(place + 1), self.points[place].0)
    }

    /// The value at a slip.
    fn at(&self, x: f64) -> Option<f64> {
        let above = self.points.partition_point(|(slip, ..)| *slip < x);
        let before = above.checked_sub(1).map(|before| &self.points[before]);
        between(before, self.points.get(above), x)
    }
}

fn of_series<'s>(series: &'s [Series], it: &Placed) -> &'s Series {
    let place = series.partition_point(|one| one.angle < it.series);
    &series[place.min(series.len() - 1)]
}

/// Linear between two points; beyond the last one its value.
fn between(
    before: Option<&(f64, f64, usize)>,
    after: Option<&(f64, f64, usize)>,
    x: f64,
) -> Option<f64> {
    match (before, after) {
        (Some((from, low, _)), Some((to, high, _))) if to > from => {
            Some(low + (high - low) * (x - from) / (to - from))
        }
        (Some((_, low, _)), Some((_, high, _))) => Some(f64::midpoint(*low, *high)),
        (Some((_, value, _)), None) | (None, Some((_, value, _))) => Some(*value),
        (None, None) => None,
    }
}

/// The value at a measurement's slip and slip angle, from the neighbouring slip angles.
fn across(series: &[Series], it: &Placed) -> Option<f64> {
    let own = series.partition_point(|one| one.angle < it.series);
    let of = |one: &Series| one.at(it.x).map(|value| (one.angle, value, 0));
    let before = own.checked_sub(1).and_then(|before| of(&series[before]));
    let after = series.get(own + 1).and_then(of);
    between(before.as_ref(), after.as_ref(), it.series)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placed(points: &[[f64; 3]]) -> Vec<Placed> {
        points
            .iter()
            .map(|[series, x, value]| Placed { series: *series, x: *x, value: *value })
            .collect()
    }

    /// Over a parabola x² at steps of 1 a chord over two steps is too high by 1; at the ends the
    /// neighbour's value stands. The order of the rows does not matter.
    #[test]
    fn a_left_out_cell_is_on_the_chord_of_its_neighbours() {
        let all = placed(&[[0.0, 2.0, 4.0], [0.0, 0.0, 0.0], [0.0, 1.0, 1.0], [0.0, 3.0, 9.0]]);
        let found = Yardstick::Interpolation.predict(&all);
        assert_eq!(found, [Some(5.0), Some(1.0), Some(2.0), Some(4.0)]);
    }

    #[test]
    fn a_line_is_interpolated_exactly_and_a_single_cell_not_at_all() {
        let line = placed(&[[0.1, -0.4, 0.2], [0.1, 0.0, 1.0], [0.1, 0.7, 2.4], [0.5, 0.7, 3.0]]);
        let found = Yardstick::Interpolation.predict(&line);
        assert!((found[1].expect("between two") - 1.0).abs() < 1e-12);
        assert_eq!(found[3], None);
    }

    /// Two repeats that were not called one cell stand at one slip: the one predicts the other with
    /// half of what is beside them.
    #[test]
    fn cells_of_one_slip_make_no_division_by_zero() {
        let all = placed(&[[0.0, 0.3, 1.0], [0.0, 0.3, 2.0], [0.0, 0.3, 6.0]]);
        let found = Yardstick::Interpolation.predict(&all);
        assert_eq!(found, [Some(2.0), Some(3.5), Some(2.0)]);
    }

    /// A plane 2 S + 3 β is met exactly at the angle between; at the outer angles it is off by the
    /// whole step of the angle.
    #[test]
    fn a_left_out_angle_is_between_its_neighbours() {
        let plane = |angle: f64, slip: f64| [angle, slip, 2.0 * slip + 3.0 * angle];
        let slips = [0.0, 0.2, 0.6];
        let angles = [0.0, 0.5, 1.0];
        let points: Vec<[f64; 3]> =
            angles.iter().flat_map(|angle| slips.map(|slip| plane(*angle, slip))).collect();
        let all = placed(&points);
        for (found, it) in Yardstick::AngleLeftOut.predict(&all).into_iter().zip(&all) {
            let step = if it.series == 0.0 {
                1.5
            } else if it.series == 1.0 {
                -1.5
            } else {
                0.0
            };
            let error = found.expect("there are others") - it.value - step;
            assert!(error.abs() < 1e-12, "{it:?}: {error}");
        }
        assert_eq!(Yardstick::AngleLeftOut.predict(&all[..3]), [None; 3]);
    }

    #[test]
    fn the_mean_is_that_of_all() {
        let all = placed(&[[0.0, 0.0, 1.0], [0.0, 1.0, 2.0], [1.0, 0.0, 6.0]]);
        assert_eq!(Yardstick::Mean.predict(&all), [Some(3.0); 3]);
    }
}
