//! Coordinates of an uncertain soil in which it is standard normal: what an estimator moves in.
//!
//! A number with a distribution has one coordinate, the normal score it is drawn with; correlated
//! numbers have as many independent ones. Rows of samples have the principal components of their
//! keys, of logarithms where all samples of a key are above 0: those with the most variance, and
//! beyond them each row keeps what it has of its own.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::statistics::NothingAccepted;
use super::statistics::normal::{normal_score, normal_share};
use super::statistics::random::place_below;
use super::uncertain_soil::UncertainSoil;
use super::varied::Key;
use grouser_core::elementary::exp;
use grouser_core::elementary::wide::ln;
use grouser_core::soil::Soil;

/// An uncertain soil in coordinates of mean 0, variance 1 and no correlation.
#[derive(Clone, Debug)]
pub struct SoilCoordinates {
    soils: UncertainSoil,
    rows: Option<Arc<Rows>>,
}

/// A sample of a soil, with the place at which it lies.
#[derive(Clone, Debug, PartialEq)]
pub struct SoilDraw {
    /// Its coordinates [-].
    pub coordinates: Vec<f64>,
    /// The soil.
    pub soil: Soil,
    /// The row of samples that it has.
    row: Option<usize>,
}

/// Rows of samples by their principal components.
#[derive(Debug)]
struct Rows {
    /// Which keys count by their logarithms.
    are_logarithms: Vec<bool>,
    mean: DVector<f64>,
    /// A column for each coordinate: what a coordinate of 1 adds.
    axes: DMatrix<f64>,
    /// The keys as they count, a column for each row of samples, and its coordinates.
    samples: DMatrix<f64>,
    coordinates: DMatrix<f64>,
}

/// The most principal components that are coordinates.
const MOST_COMPONENTS: usize = 12;

/// Least share of the variance of a component that is a coordinate [-].
const LEAST_VARIANCE: f64 = 0.005;

impl SoilCoordinates {
    /// Those of an uncertain soil.
    #[must_use]
    pub fn of(soils: &UncertainSoil) -> Self {
        let rows = soils.distribution().sample_rows().map(|rows| Arc::new(Rows::of(rows)));
        Self { soils: soils.clone(), rows }
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.scores() + self.rows.as_ref().map_or(0, |rows| rows.axes.ncols())
    }

    /// The soil at a place, its numbers within the ranges of their keys; `None` if they are no soil
    /// together.
    ///
    /// * `coordinates`: as many as [`count`](Self::count) says
    #[must_use]
    pub fn soil(&self, coordinates: &[f64]) -> Option<Soil> {
        self.values_at(coordinates, None).and_then(|values| self.soils.soil(&values))
    }

    /// The values of the keys at a place, in their own units and within their ranges; `None` of
    /// coordinates that are not finite.
    ///
    /// * `coordinates`: as many as [`count`](Self::count) says
    #[must_use]
    pub fn values(&self, coordinates: &[f64]) -> Option<Vec<f64>> {
        self.values_at(coordinates, None)
    }

    /// Sample number `index` with its place: the same soil as [`UncertainSoil::draw`] gives, or of one model
    /// [`UncertainSoil::draw_under`].
    ///
    /// # Errors
    /// [`NothingAccepted`] if no soil can be drawn.
    pub fn draw(&self, seed: u64, index: u64) -> Result<SoilDraw, NothingAccepted> {
        let accept = |values: &[f64]| self.soils.soil(values);
        let (point, soil) = self.soils.draw_with_point(seed, index, accept)?;
        let mut coordinates: Vec<f64> =
            point[..self.scores()].iter().map(|share| normal_score(*share)).collect();
        let row = self.rows.as_ref().map(|rows| {
            let count = rows.samples.ncols();
            let row = place_below(point[self.scores()] * count as f64, count);
            coordinates.extend(rows.coordinates.column(row).iter());
            row
        });
        Ok(SoilDraw { coordinates, soil, row })
    }

    /// The values of the keys of a sample that is moved to another place, in their own units;
    /// `None` if they are no soil together. A row of samples keeps what no coordinate has.
    #[must_use]
    pub fn moved(&self, draw: &SoilDraw, coordinates: &[f64]) -> Option<(Vec<f64>, Soil)> {
        let values = self.values_at(coordinates, draw.row)?;
        let soil = self.soils.soil(&values)?;
        Some((values, soil))
    }

    /// The keys whose values [`moved`](Self::moved) gives, in its order.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.soils.keys()
    }

    /// How many of the coordinates are normal scores.
    fn scores(&self) -> usize {
        self.soils.all_keys().len() - self.soils.sampled_keys().count()
    }

    /// The values of all keys, within their ranges.
    ///
    /// * `row`: of the samples, that keeps what it has beyond the coordinates
    fn values_at(&self, coordinates: &[f64], row: Option<usize>) -> Option<Vec<f64>> {
        if coordinates.iter().any(|it| !it.is_finite()) {
            return None;
        }
        let (scores, components) = coordinates.split_at(self.scores());
        let mut point: Vec<f64> = scores.iter().map(|score| share_of(*score)).collect();
        // Which row the distribution takes does not matter: its values are put in place below.
        point.extend(self.rows.as_ref().map(|_| 0.5));
        let mut values = self.soils.distribution().at(&point);
        if let Some(rows) = &self.rows {
            values.truncate(scores.len());
            values.extend(rows.values(components, row));
        }
        let clamped = self.soils.all_keys().iter().zip(values);
        Some(
            clamped.map(|(Key { range, .. }, it)| it.clamp(*range.start(), *range.end())).collect(),
        )
    }
}

/// The share of a normal score [-], inside of the unit interval.
fn share_of(score: f64) -> f64 {
    /// Beyond this score shares are 0 or 1 to rounding.
    const FARTHEST: f64 = 7.0;
    normal_share(score.clamp(-FARTHEST, FARTHEST))
}

impl Rows {
    fn of(rows: &[Vec<f64>]) -> Self {
        let width = rows[0].len();
        let are_logarithms: Vec<bool> =
            (0..width).map(|key| rows.iter().all(|row| row[key] > 0.0)).collect();
        let counted = |key: usize, value: f64| if are_logarithms[key] { ln(value) } else { value };
        let samples = DMatrix::from_fn(width, rows.len(), |key, row| counted(key, rows[row][key]));
        let mean = samples.column_mean();
        let mut centred = samples.clone();
        centred.column_iter_mut().for_each(|mut column| column -= &mean);
        let count = rows.len() as f64;
        let deviations =
            DVector::from_fn(width, |key, _| (centred.row(key).norm_squared() / count).sqrt());
        let scale = |key: usize| if deviations[key] > 0.0 { deviations[key] } else { 1.0 };
        let scaled =
            DMatrix::from_fn(width, rows.len(), |key, row| centred[(key, row)] / scale(key));
        let correlations = &scaled * scaled.transpose() / count;
        let found = correlations.symmetric_eigen();
        let mut order: Vec<usize> = (0..width).collect();
        order.sort_by(|one, other| found.eigenvalues[*other].total_cmp(&found.eigenvalues[*one]));
        let whole: f64 = found.eigenvalues.iter().map(|it| it.max(0.0)).sum();
        order.retain(|place| found.eigenvalues[*place] > LEAST_VARIANCE * whole);
        order.truncate(MOST_COMPONENTS);
        let length = |component: usize| found.eigenvalues[order[component]].sqrt();
        let direction = |key: usize, component: usize| found.eigenvectors[(key, order[component])];
        let axes = DMatrix::from_fn(width, order.len(), |key, component| {
            scale(key) * direction(key, component) * length(component)
        });
        let into = DMatrix::from_fn(order.len(), width, |component, key| {
            direction(key, component) / (scale(key) * length(component))
        });
        let coordinates = into * centred;
        Self { are_logarithms, mean, axes, samples, coordinates }
    }

    /// The values of the keys at a place.
    fn values(&self, coordinates: &[f64], row: Option<usize>) -> Vec<f64> {
        let place = DVector::from_column_slice(coordinates);
        let counted = match row {
            None => &self.mean + &self.axes * place,
            Some(row) => {
                self.samples.column(row) + &self.axes * (place - self.coordinates.column(row))
            }
        };
        let value = |(value, is_logarithm): (&f64, &bool)| {
            if *is_logarithm { exp(*value) } else { *value }
        };
        counted.iter().zip(&self.are_logarithms).map(value).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Kind, Overrides, Source, read_soil};

    fn coordinates(soil: &Source) -> SoilCoordinates {
        let soil = read_soil(soil, &Overrides::none()).unwrap();
        SoilCoordinates::of(&soil.uncertain.expect("an uncertain soil"))
    }

    fn uncertain() -> SoilCoordinates {
        coordinates(&Source::find(Kind::Soil, "toyoura-uncertain").unwrap())
    }

    #[test]
    fn a_sample_lies_where_its_coordinates_say() {
        let soil = uncertain();
        assert_eq!(soil.count(), 5);
        for index in 0..50 {
            let draw = soil.draw(7, index).unwrap();
            let (_, again) = soil.moved(&draw, &draw.coordinates).unwrap();
            let ratio = again.friction_angle / draw.soil.friction_angle;
            assert!((ratio - 1.0).abs() < 1e-9, "{ratio}");
        }
    }

    /// The coordinates of 2000 samples have mean 0, variance 1 and no correlation, to within 4.5
    /// standard errors.
    #[test]
    fn coordinates_are_standard_normal() {
        let soil = uncertain();
        let all: Vec<_> = (0..2000).map(|it| soil.draw(3, it).unwrap().coordinates).collect();
        let mean = |of: &dyn Fn(&Vec<f64>) -> f64| all.iter().map(of).sum::<f64>() / 2000.0;
        for one in 0..soil.count() {
            assert!(mean(&|it| it[one]).abs() < 0.1, "{one}");
            for other in 0..soil.count() {
                let expected = if one == other { 1.0 } else { 0.0 };
                let found = mean(&|it| it[one] * it[other]);
                assert!((found - expected).abs() < 0.15, "{one}, {other}: {found}");
            }
        }
    }

    /// Rows of two keys of which one is a power of the other have one coordinate, and a row that is
    /// moved by one standard deviation keeps what it has beyond it.
    #[test]
    fn rows_of_samples_have_their_principal_components() {
        let rows: Vec<Vec<f64>> = (0..200)
            .map(|row| {
                let score = normal_score((f64::from(row) + 0.5) / 200.0);
                vec![(0.2 * score).exp(), -0.4 * score]
            })
            .collect();
        let found = Rows::of(&rows);
        assert_eq!((found.axes.ncols(), &*found.are_logarithms), (1, &[true, false][..]));
        let place = found.coordinates[(0, 17)];
        let moved = found.values(&[place + 0.5_f64.copysign(found.axes[(0, 0)])], Some(17));
        assert!((moved[0] / rows[17][0]).ln() > 0.0);
        let (one, other) = ((moved[0] / rows[17][0]).ln() / 0.2, (rows[17][1] - moved[1]) / 0.4);
        assert!((one - other).abs() < 1e-9, "{one} {other}");
        assert!((one - 0.5).abs() < 0.01, "{one}");
    }
}
