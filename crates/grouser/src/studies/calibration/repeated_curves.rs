//! Curves of raw logs, and curves that repeat each other, made observations: means, with the
//! scatter of repeats.
//!
//! A log of thousands of rows is no thousand independent readings, and five repeats of a test are
//! not one test with five times as many points. Long curves are averaged over intervals, repeats
//! over each other; how far the repeats differ says how well their mean is known, with what they
//! have in common along the curve.

/// A reading of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// Where it was read: a sinkage or a displacement [m].
    pub at: f64,
    /// Its value: a pressure or a stress [Pa].
    pub value: f64,
    /// Standard deviation of the value [Pa]; 0 where it is unknown.
    pub scatter: f64,
}

/// The mean over curves that repeat each other.
#[derive(Clone, Debug, PartialEq)]
pub struct MeanCurve {
    /// The mean at common places, with its standard deviation from repeat to repeat.
    pub points: Vec<CurvePoint>,
    /// The number of curves.
    pub repeats: usize,
}

/// A curve of more readings is averaged over so many intervals of equal length. Source: ours; the
/// laws that are fitted bend less than what a fiftieth of a curve shows.
pub const INTERVALS: usize = 50;

/// Readings on either side with which the variance between repeats is averaged. Source: ours; three
/// or five repeats alone hardly determine it at one place.
const NEIGHBOURS: usize = 2;

/// Least number of degrees of freedom [-]: of fewer, Student's t has no variance.
const LEAST_FREEDOM: f64 = 3.0;

/// A curve with at most [`INTERVALS`] points, rising in their places: the means over intervals of
/// equal length where it has more. Their scatter is that of a single reading: readings of one log
/// are not independent.
#[must_use]
pub fn thinned(points: &[CurvePoint]) -> Vec<CurvePoint> {
    let mut points = points.to_vec();
    points.sort_by(|one, other| one.at.total_cmp(&other.at));
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return points };
    let (low, length) = (first.at, last.at - first.at);
    if points.len() <= INTERVALS || length <= 0.0 {
        return points;
    }
    let mut rest = points.as_slice();
    let interval = |number: usize| {
        let end = low + length * number as f64 / INTERVALS as f64;
        let is_last = number == INTERVALS;
        let (own, beyond) = rest.split_at(rest.partition_point(|point| is_last || point.at <= end));
        rest = beyond;
        (!own.is_empty()).then(|| mean_point(own))
    };
    (1..=INTERVALS).filter_map(interval).collect()
}

/// The mean place and value of some readings, with their root mean square scatter.
fn mean_point(points: &[CurvePoint]) -> CurvePoint {
    let count = points.len() as f64;
    let mean = |of: fn(&CurvePoint) -> f64| points.iter().map(of).sum::<f64>() / count;
    CurvePoint {
        at: mean(|it| it.at),
        value: mean(|it| it.value),
        scatter: mean(|it| it.scatter * it.scatter).sqrt(),
    }
}

/// The mean over the curves of each setting, at places that all of them reach.
///
/// The standard deviation of a mean is s √(D/n), with s between n repeats and the design effect D
/// (Kish 1965) of all settings together: repeats that differ along the whole curve alike, by the
/// plate's place in the bin, say as little about it as one reading. D is 1 where they differ from
/// place to place at random, and the number of places where they differ by one factor. A scatter
/// that is known from few repeats is enlarged to the standard deviation of Student's t, by √(ν/(ν −
/// 2)) with ν = Σ (n − 1) of all settings, at least 3.
///
/// * `settings`: for each setting, the curves that repeat each other, each [`thinned`]
#[must_use]
pub fn means(settings: &[Vec<Vec<CurvePoint>>]) -> Vec<MeanCurve> {
    let spreads: Vec<Spread> = settings.iter().map(|curves| Spread::of(curves)).collect();
    let levels: f64 = spreads.iter().map(Spread::squared_levels).sum();
    let freedom: f64 = spreads.iter().map(Spread::freedom).sum();
    let design_effect = if freedom > 0.0 { (levels / freedom).max(1.0) } else { 1.0 };
    let known_freedom = freedom.max(LEAST_FREEDOM);
    let of_few = known_freedom / (known_freedom - 2.0);
    spreads.iter().map(|spread| spread.mean(design_effect * of_few)).collect()
}

/// Curves at common places.
struct Spread {
    places: Vec<f64>,
    /// Values of each curve at these places.
    values: Vec<Vec<f64>>,
    /// The mean's scatter as far as the readings' own is known.
    own_scatter: Vec<f64>,
    /// Standard deviation between the curves; empty of one alone.
    deviations: Vec<f64>,
}

impl Spread {
    fn of(curves: &[Vec<CurvePoint>]) -> Self {
        if let [only] = curves {
            return Self {
                places: only.iter().map(|it| it.at).collect(),
                values: vec![only.iter().map(|it| it.value).collect()],
                own_scatter: only.iter().map(|it| it.scatter).collect(),
                deviations: Vec::new(),
            };
        }
        let places = common_places(curves);
        let at = |of: fn(&CurvePoint) -> f64| -> Vec<Vec<f64>> {
            curves.iter().map(|curve| interpolated(curve, &places, of)).collect()
        };
        let (values, scatters) = (at(|it| it.value), at(|it| it.scatter));
        let count = curves.len() as f64;
        let own_scatter = (0..places.len())
            .map(|place| scatters.iter().map(|it| it[place].powi(2)).sum::<f64>().sqrt() / count);
        let own_scatter = own_scatter.collect();
        let variances: Vec<f64> =
            (0..places.len()).map(|place| variance_at(&values, place)).collect();
        let deviations = (0..places.len()).map(|place| smoothed(&variances, place).sqrt());
        let deviations = deviations.collect();
        Self { places, values, own_scatter, deviations }
    }

    /// The number of repeats beyond the first, which is what their scatter is known by.
    fn freedom(&self) -> f64 {
        self.values.len().saturating_sub(1) as f64
    }

    /// The sum over the curves of their squared mean distance from the mean, in deviations, times
    /// the places.
    fn squared_levels(&self) -> f64 {
        let known: Vec<usize> =
            (0..self.deviations.len()).filter(|place| self.deviations[*place] > 0.0).collect();
        let level = |curve: &Vec<f64>| {
            let scaled = known
                .iter()
                .map(|&place| (curve[place] - self.mean_at(place)) / self.deviations[place]);
            scaled.sum::<f64>() / (known.len() as f64).max(1.0)
        };
        known.len() as f64 * self.values.iter().map(|it| level(it).powi(2)).sum::<f64>()
    }

    fn mean_at(&self, place: usize) -> f64 {
        self.values.iter().map(|curve| curve[place]).sum::<f64>() / self.values.len() as f64
    }

    /// * `enlarged`: the variance of the mean over that of independent readings [-]
    fn mean(&self, enlarged: f64) -> MeanCurve {
        let of_mean = (enlarged / self.values.len() as f64).sqrt();
        let point = |place: usize| {
            let between = self.deviations.get(place).map_or(0.0, |one| one * of_mean);
            let scatter = between.max(self.own_scatter[place]);
            CurvePoint { at: self.places[place], value: self.mean_at(place), scatter }
        };
        let points = (0..self.places.len()).map(point).collect();
        MeanCurve { points, repeats: self.values.len() }
    }
}

/// Returns as many places as the shortest curve has points, evenly over what all curves reach.
fn common_places(curves: &[Vec<CurvePoint>]) -> Vec<f64> {
    let ends = |of: fn(&[CurvePoint]) -> Option<&CurvePoint>| {
        curves.iter().filter_map(move |curve| of(curve)).map(|point| point.at)
    };
    let low = ends(<[_]>::first).fold(f64::NEG_INFINITY, f64::max);
    let high = ends(<[_]>::last).fold(f64::INFINITY, f64::min);
    let count = curves.iter().map(Vec::len).min().unwrap_or(0);
    if low > high {
        return Vec::new();
    }
    let place = |number: usize| low + (high - low) * (number as f64 + 0.5) / count as f64;
    (0..count).map(place).collect()
}

/// A curve between its points, by straight lines.
fn interpolated(curve: &[CurvePoint], places: &[f64], of: fn(&CurvePoint) -> f64) -> Vec<f64> {
    let value = |place: &f64| {
        let above = curve.partition_point(|point| point.at < *place).min(curve.len() - 1);
        let (left, right) = (&curve[above.saturating_sub(1)], &curve[above]);
        let length = right.at - left.at;
        let share = if length > 0.0 { ((place - left.at) / length).clamp(0.0, 1.0) } else { 1.0 };
        of(left) + share * (of(right) - of(left))
    };
    places.iter().map(value).collect()
}

fn variance_at(values: &[Vec<f64>], place: usize) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().map(|curve| curve[place]).sum::<f64>() / count;
    values.iter().map(|curve| (curve[place] - mean).powi(2)).sum::<f64>() / (count - 1.0)
}

fn smoothed(variances: &[f64], place: usize) -> f64 {
    let window =
        &variances[place.saturating_sub(NEIGHBOURS)..(place + NEIGHBOURS + 1).min(variances.len())];
    window.iter().sum::<f64>() / window.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// value = level + at, at 0, 1, … 39.
    fn line(level: f64) -> Vec<CurvePoint> {
        (0..40)
            .map(|k| CurvePoint { at: f64::from(k), value: level + f64::from(k), scatter: 0.0 })
            .collect()
    }

    /// Interval means of a straight line lie on it.
    #[test]
    fn a_long_straight_log_stays_a_straight_line() {
        let long: Vec<CurvePoint> = (0..1000)
            .rev()
            .map(|k| CurvePoint { at: f64::from(k), value: 3.0 * f64::from(k), scatter: 2.0 })
            .collect();
        let kept = thinned(&long);
        assert_eq!(kept.len(), INTERVALS);
        assert!(kept.windows(2).all(|pair| pair[0].at < pair[1].at));
        // A handful of roundings.
        assert!(kept.iter().all(|it| (it.value - 3.0 * it.at).abs() < 1e-9 && it.scatter == 2.0));
    }

    /// Closed form: repeats that differ by a constant know their mean as well as one reading each
    /// does.
    #[test]
    fn repeats_that_differ_as_a_whole_count_once() {
        let curves: Vec<_> = [-1.0, -1.0, 0.0, 1.0, 1.0].map(line).to_vec();
        let [mean] = &means(&[curves])[..] else { panic!("one setting") };
        // s = 1 between five: D is the number of places, 40, and ν/(ν − 2) is 2.
        let expected = (40.0_f64 * 2.0 / 5.0).sqrt();
        for point in &mean.points {
            assert!((point.value - point.at).abs() < 1e-12);
            assert!((point.scatter - expected).abs() < 1e-9, "{point:?}");
        }
        assert_eq!((mean.points.len(), mean.repeats), (40, 5));
    }

    #[test]
    fn a_curve_alone_stays_as_it_is() {
        let [mean] = &means(&[vec![line(2.0)]])[..] else { panic!("one setting") };
        assert_eq!((mean.points.clone(), mean.repeats), (line(2.0), 1));
    }

    /// A repeat that ends early ends the mean, and rows beyond are not made up.
    #[test]
    fn the_mean_ends_where_the_first_repeat_does() {
        let short = line(0.0)[..20].to_vec();
        let [mean] = &means(&[vec![line(0.0), short]])[..] else { panic!("one setting") };
        assert!(mean.points.iter().all(|point| point.at < 19.0));
        assert_eq!(mean.points.len(), 20);
    }
}
