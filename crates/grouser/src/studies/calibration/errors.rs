//! The errors of observations about a model: the scatter of their trials, and a discrepancy of the
//! model that is alike at motions that are alike.
//!
//! The discrepancies of a channel have a standard deviation δ. Two of them in one family, at slips
//! S and S' and slip angles β and β', are correlated by
//!
//! ```text
//! ρ = κ(|S − S'|/ℓ_S) κ(||β| − |β'||/ℓ_β)      κ(x) = (1 + √3 x) e^(−√3 x)
//! Cov(y_i, y_j) = s_i² [i = j] + δ_i f_i δ_j f_j ρ_ij
//! ```
//!
//! with one correlation length ℓ_S in slip and one ℓ_β in slip angle for all families: a Gaussian
//! process with a Matérn kernel (Rasmussen and Williams 2006, Eq. 4.17), as Kennedy and O'Hagan
//! (2001) take the discrepancy of a model. The weight f_i is 1 for an observation of usual size: a
//! wheel under twice the load is mistaken about twice the force. An observation of weight 0 can
//! have no discrepancy. With both lengths near zero the discrepancies are independent, as they are
//! where observations have no place.
//!
//! What is positive and may be several times what a model says, such as a sinkage, is counted by
//! its logarithm: its residual is f_i ln(y_i/prediction) in units of the usual f.

use std::f64::consts::PI;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::experiment::{Experiment, Measure, Observation, Place, Site};
use super::parameter::{Parameter, Scale};
use crate::elementary::exp;
use crate::elementary::wide::{ln, powi};

/// Correlation lengths in slip [-]: from less than any two settings differ, to the whole range.
const SLIP_LENGTHS: [f64; 2] = [0.05, 2.0];

/// Where the search for that length starts [-].
const START_SLIP_LENGTH: f64 = 0.5;

/// Correlation lengths in slip angle [rad], likewise.
const ANGLE_LENGTHS: [f64; 2] = [PI / 60.0, PI / 2.0];

/// Where the search for that length starts [rad].
const START_ANGLE_LENGTH: f64 = PI / 9.0;

/// Observations at one place differ by this share of the discrepancy's variance at least [-], so
/// that their covariance can be inverted.
const JITTER: f64 = 1e-8;

/// What is counted by its logarithm is at least this share of what was read [-].
const LEAST_SHARE: f64 = 1e-3;

/// Lengths tried for a fit, each over its range.
const LENGTHS_TRIED: i32 = 10;

/// The errors of an experiment's observations.
#[derive(Clone, Debug, Default)]
pub struct Errors {
    scatters: Vec<f64>,
    channels: Vec<usize>,
    /// Each observation's discrepancy, in units of its channel's δ.
    weights: Vec<f64>,
    /// The weight at which a discrepancy is δ, for each channel.
    usual_weights: Vec<f64>,
    /// What a logarithm of 1 counts as, for each observation that is counted by its logarithm.
    logarithmic: Vec<Option<f64>>,
    /// Observations whose discrepancies are correlated; none if all are independent.
    families: Vec<Vec<usize>>,
    /// Where the observations are, each place once.
    sites: Vec<Site>,
    /// The site of each observation.
    site_of: Vec<usize>,
    /// Number of channels: the lengths stand after their deviations.
    channel_count: usize,
    lengths: Vec<Parameter>,
}

/// The distances over which discrepancies stay alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lengths {
    /// In slip [-].
    pub slip: f64,
    /// In slip angle [rad]; infinite where all observations have the same.
    pub slip_angle: f64,
}

impl Lengths {
    /// Correlation of the discrepancies at two sites [-].
    #[must_use]
    pub fn correlation(&self, one: &Site, other: &Site) -> f64 {
        matern((one.slip - other.slip).abs() / self.slip)
            * matern((one.slip_angle - other.slip_angle).abs() / self.slip_angle)
    }
}

/// Matérn's correlation of order 3/2 at a distance in units of its length [-].
fn matern(distance: f64) -> f64 {
    let x = 3.0_f64.sqrt() * distance;
    (1.0 + x) * exp(-x)
}

/// The inverse of a family's covariance, as its factor.
struct Family<'a> {
    members: &'a [usize],
    factor: Cholesky<f64, Dyn>,
}

impl Errors {
    /// The errors of an experiment.
    #[must_use]
    pub fn of(experiment: &dyn Experiment) -> Self {
        let observations = experiment.observations();
        let channels: Vec<usize> = observations.iter().map(|one| one.channel).collect();
        let channel_count = experiment.channels().len();
        let scatters = observations.iter().map(|one| one.scatter).collect();
        let places = experiment.places();
        let mut errors = Self { scatters, channels, channel_count, ..Self::default() };
        errors.weights = vec![1.0; observations.len()];
        errors.logarithmic = vec![None; observations.len()];
        if places.is_empty() {
            return errors;
        }
        errors.weigh(places);
        for (number, place) in places.iter().enumerate() {
            if place.family >= errors.families.len() {
                errors.families.resize(place.family + 1, Vec::new());
            }
            if place.measure == Measure::Logarithmic {
                errors.logarithmic[number] = Some(place.weight);
            }
            // Where nothing can be wrong, what is read beyond the model tells nothing of it.
            if place.weight != 0.0 {
                errors.families[place.family].push(number);
            }
            let site = place.site;
            let known = errors.sites.iter().position(|one| *one == site);
            errors.site_of.push(known.unwrap_or_else(|| {
                errors.sites.push(site);
                errors.sites.len() - 1
            }));
        }
        errors.lengths = lengths_to_find(&errors.sites);
        errors
    }

    /// Weights relative to the root mean square of their channel.
    fn weigh(&mut self, places: &[Place]) {
        for channel in 0..self.channel_count {
            let usual = root_mean_square(places, &self.channels, channel);
            self.usual_weights.push(usual);
            for (number, place) in places.iter().enumerate() {
                if self.channels[number] == channel {
                    self.weights[number] = place.weight / usual;
                }
            }
        }
    }

    /// The weight at which a discrepancy is δ, in the channel's unit; 1 where observations have no
    /// place.
    #[must_use]
    pub fn usual_weight(&self, channel: usize) -> f64 {
        self.usual_weights.get(channel).copied().unwrap_or(1.0)
    }

    /// The weight of each observation's discrepancy, over that of one of usual size [-].
    #[must_use]
    pub(super) fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// What was measured beyond what was predicted, as discrepancies are counted.
    #[must_use]
    pub(super) fn residuals(&self, observations: &[Observation], predictions: &[f64]) -> Vec<f64> {
        let pairs = observations.iter().zip(predictions).zip(&self.logarithmic);
        let beyond = |((one, &predicted), logarithmic): ((&Observation, &f64), &Option<f64>)| {
            match *logarithmic {
                // A weight is its observation, or the least that counts as one.
                Some(weight) => {
                    let predicted = predicted.max(LEAST_SHARE * weight);
                    weight * (ln(one.value.max(weight)) - ln(predicted))
                }
                None => one.value - predicted,
            }
        };
        pairs.map(beyond).collect()
    }

    /// The correlation lengths, as parameters with priors uniform by the logarithm.
    #[must_use]
    pub fn lengths(&self) -> &[Parameter] {
        &self.lengths
    }

    /// * `found`: the channels' deviations, then the correlation lengths
    #[must_use]
    pub fn lengths_in(&self, found: &[f64]) -> Lengths {
        let mut lengths = found[self.channel_count..].iter().copied();
        Lengths {
            slip: lengths.next().unwrap_or(f64::INFINITY),
            slip_angle: lengths.next().unwrap_or(f64::INFINITY),
        }
    }

    /// Standard deviation of each observation's discrepancy, δ f.
    fn deviations(&self, found: &[f64]) -> Vec<f64> {
        let each = self.channels.iter().zip(&self.weights);
        each.map(|(&channel, weight)| found[channel] * weight).collect()
    }

    /// Variances of observations on their own, s² + δ²: those of least squares, in which every cell
    /// of a channel counts by its scatter alone.
    #[must_use]
    pub fn variances_alike(&self, found: &[f64]) -> Vec<f64> {
        let each = self.scatters.iter().zip(&self.channels);
        each.map(|(scatter, &channel)| scatter.powi(2) + found[channel].powi(2)).collect()
    }

    /// Logarithm of the density of residuals, up to a constant.
    #[must_use]
    pub fn log_density(&self, residuals: &[f64], found: &[f64]) -> f64 {
        if self.families.is_empty() {
            let each = residuals.iter().zip(self.variances_alike(found));
            return each.map(|(r, variance)| -0.5 * (r * r / variance + ln(variance))).sum();
        }
        let Some(families) = self.factored(found) else { return f64::NEG_INFINITY };
        families.iter().map(|family| family.log_density(residuals)).sum()
    }

    /// Independent residuals of deviation 1 that say the same as correlated ones.
    #[must_use]
    pub(super) fn whitener(&self, found: &[f64]) -> Whitener {
        let deviations = self.variances_alike(found).into_iter().map(f64::sqrt).collect();
        let factors = self.factored(found).unwrap_or_default();
        let factors = factors.into_iter().map(|one| (one.members.to_vec(), one.factor.unpack()));
        Whitener { deviations, factors: factors.collect() }
    }

    /// The covariance of each family, factored; `None` where that cannot be.
    fn factored(&self, found: &[f64]) -> Option<Vec<Family<'_>>> {
        let lengths = self.lengths_in(found);
        let deviations = self.deviations(found);
        let correlations = self.correlations(&lengths);
        let family = |members: &'_ Vec<usize>| {
            let mut covariance = DMatrix::zeros(members.len(), members.len());
            for (j, &other) in members.iter().enumerate() {
                for (i, &one) in members.iter().enumerate().skip(j) {
                    covariance[(i, j)] = deviations[one]
                        * deviations[other]
                        * correlations[(self.site_of[one], self.site_of[other])];
                }
                covariance[(j, j)] +=
                    self.scatters[other].powi(2) + JITTER * deviations[other].powi(2);
            }
            covariance.cholesky()
        };
        self.families
            .iter()
            .map(|members| Some(Family { members, factor: family(members)? }))
            .collect()
    }

    fn correlations(&self, lengths: &Lengths) -> DMatrix<f64> {
        let mut correlations = DMatrix::identity(self.sites.len(), self.sites.len());
        for (j, other) in self.sites.iter().enumerate() {
            for (i, one) in self.sites.iter().enumerate().skip(j + 1) {
                let correlation = lengths.correlation(one, other);
                correlations[(i, j)] = correlation;
                correlations[(j, i)] = correlation;
            }
        }
        correlations
    }

    /// The most likely correlation lengths of residuals, for given deviations: the best of a grid.
    ///
    /// * `found`: the channels' deviations
    #[must_use]
    pub(super) fn likely_lengths(&self, residuals: &[f64], found: &[f64]) -> Vec<f64> {
        let tried = |parameter: &Parameter| -> Vec<f64> {
            let at = |step: i32| f64::from(step) / f64::from(LENGTHS_TRIED);
            (0..=LENGTHS_TRIED).map(|step| parameter.value_at(at(step))).collect()
        };
        let mut grid: Vec<Vec<f64>> = vec![Vec::new()];
        for length in &self.lengths {
            let longer = |shorter: &Vec<f64>| {
                let add = |value: f64| [shorter.as_slice(), &[value]].concat();
                tried(length).into_iter().map(add).collect::<Vec<_>>()
            };
            grid = grid.iter().flat_map(longer).collect();
        }
        let density = |lengths: &Vec<f64>| {
            self.log_density(residuals, &[&found[..self.channel_count], lengths].concat())
        };
        let densities: Vec<f64> = grid.iter().map(density).collect();
        let best = (0..grid.len()).max_by(|&i, &j| densities[i].total_cmp(&densities[j]));
        best.map(|best| grid[best].clone()).unwrap_or_default()
    }

    /// Discrepancies at sites, in units of their deviations: drawn given the residuals of a family.
    ///
    /// * `numbers`: normal ones, one for each site
    #[must_use]
    pub(super) fn drawn(
        &self,
        family: usize,
        sites: &[Site],
        residuals: &[f64],
        found: &[f64],
        numbers: &[f64],
    ) -> Drawn {
        let lengths = self.lengths_in(found);
        let deviations = self.deviations(found);
        let members = &self.families[family];
        let site = |one: usize| &self.sites[self.site_of[one]];
        let covariance = DMatrix::from_fn(members.len(), members.len(), |i, j| {
            let (one, other) = (members[i], members[j]);
            let scatter = self.scatters[one].powi(2) + JITTER * deviations[one].powi(2);
            let both = deviations[one] * deviations[other];
            both * lengths.correlation(site(one), site(other)) + if i == j { scatter } else { 0.0 }
        });
        let prior = DMatrix::from_fn(sites.len(), sites.len(), |i, j| {
            lengths.correlation(&sites[i], &sites[j]) + if i == j { JITTER } else { 0.0 }
        });
        let across = DMatrix::from_fn(sites.len(), members.len(), |i, j| {
            deviations[members[j]] * lengths.correlation(&sites[i], site(members[j]))
        });
        let (mean, spread) = match covariance.cholesky() {
            Some(factor) if !members.is_empty() => {
                let read = DVector::from_iterator(
                    members.len(),
                    members.iter().map(|&one| residuals[one]),
                );
                let left = &prior - &across * factor.solve(&across.transpose());
                (&across * factor.solve(&read), left)
            }
            _ => (DVector::zeros(sites.len()), prior),
        };
        Drawn { mean: mean.iter().copied().collect(), deviation: deviation_of(&spread, numbers) }
    }
}

/// A draw: what is expected, and the random part.
pub(super) struct Drawn {
    pub(super) mean: Vec<f64>,
    pub(super) deviation: Vec<f64>,
}

/// Numbers of a covariance from independent ones.
fn deviation_of(covariance: &DMatrix<f64>, numbers: &[f64]) -> Vec<f64> {
    let size = covariance.nrows();
    let mut jitter = JITTER;
    // Rounding may leave a covariance that is not quite positive.
    let factor = loop {
        let raised = covariance + DMatrix::identity(size, size) * jitter;
        if let Some(factor) = raised.cholesky() {
            break factor;
        }
        jitter *= 10.0;
    };
    let away = factor.l() * DVector::from_column_slice(&numbers[..size]);
    away.iter().copied().collect()
}

impl Family<'_> {
    fn log_density(&self, residuals: &[f64]) -> f64 {
        let mut own = DVector::from_iterator(
            self.members.len(),
            self.members.iter().map(|&one| residuals[one]),
        );
        let factor = self.factor.l_dirty();
        let solved = factor.solve_lower_triangular_mut(&mut own);
        if !solved {
            return f64::NEG_INFINITY;
        }
        let logarithms: f64 = factor.diagonal().iter().map(|&one| ln(one)).sum();
        -0.5 * own.norm_squared() - logarithms
    }
}

/// Turns residuals into independent ones of deviation 1.
pub(super) struct Whitener {
    deviations: Vec<f64>,
    factors: Vec<(Vec<usize>, DMatrix<f64>)>,
}

impl Whitener {
    /// Returns the whitener of each residual on its own, without its correlations.
    pub(super) fn independent(deviations: Vec<f64>) -> Self {
        Self { deviations, factors: Vec::new() }
    }

    pub(super) fn whitened(&self, residuals: &[f64]) -> Vec<f64> {
        let each = residuals.iter().zip(&self.deviations);
        let mut white: Vec<f64> = each.map(|(residual, deviation)| residual / deviation).collect();
        for (members, factor) in &self.factors {
            let own = members.iter().map(|&one| residuals[one]);
            let mut own = DVector::from_iterator(members.len(), own);
            if factor.solve_lower_triangular_mut(&mut own) {
                for (&one, value) in members.iter().zip(own.iter()) {
                    white[one] = *value;
                }
            }
        }
        white
    }
}

/// Root mean square of a channel's weights.
fn root_mean_square(places: &[Place], channels: &[usize], channel: usize) -> f64 {
    let own = || places.iter().zip(channels).filter(|(_, one)| **one == channel);
    let squares: f64 = own().map(|(place, _)| powi(place.weight, 2)).sum();
    (squares / (own().count() as f64).max(1.0)).sqrt().max(f64::MIN_POSITIVE)
}

/// The lengths that observations at some sites can tell.
fn lengths_to_find(sites: &[Site]) -> Vec<Parameter> {
    let parameter = |name: &str, [lower, upper]: [f64; 2], start: f64| Parameter {
        name: name.to_owned(),
        lower,
        upper,
        scale: Scale::Logarithmic,
        start,
    };
    let slip = parameter("correlation length in slip", SLIP_LENGTHS, START_SLIP_LENGTH);
    let angle = parameter("correlation length in slip angle", ANGLE_LENGTHS, START_ANGLE_LENGTH);
    let has_angles = sites.iter().any(|site| site.slip_angle != sites[0].slip_angle);
    if has_angles { vec![slip, angle] } else { vec![slip] }
}

#[cfg(test)]
mod tests {
    use super::super::ensemble::normal_numbers;
    use super::super::experiment::Channel;
    use super::*;
    use crate::error::ParameterError;
    use crate::units::deg;

    /// Observations of one quantity at some slips, of which nothing is predicted.
    struct Read {
        observations: Vec<Observation>,
        places: Vec<Place>,
    }

    impl Read {
        fn new(slips: &[f64], angles: &[f64], scatter: f64) -> Self {
            let sites = angles
                .iter()
                .flat_map(|&slip_angle| slips.iter().map(move |&slip| (slip, slip_angle)));
            let places: Vec<Place> = sites
                .map(|(slip, slip_angle)| Place {
                    family: 0,
                    site: Site { slip, slip_angle },
                    weight: 7.0,
                    measure: Measure::Linear,
                })
                .collect();
            let one = Observation { value: 0.0, scatter, channel: 0 };
            Self { observations: vec![one; places.len()], places }
        }
    }

    impl Experiment for Read {
        fn channels(&self) -> &[Channel] {
            &[Channel::Other]
        }

        fn observations(&self) -> &[Observation] {
            &self.observations
        }

        fn places(&self) -> &[Place] {
            &self.places
        }

        fn predict(&self, _: &[f64], predictions: &mut [f64]) -> Result<(), ParameterError> {
            predictions.fill(0.0);
            Ok(())
        }
    }

    const SLIPS: [f64; 9] = [-1.0, -0.7, -0.5, -0.2, 0.0, 0.23, 0.5, 0.75, 0.9];

    /// Three times what is predicted is ln 3 of what is read; a reading below its weight counts as
    /// that, so that one of 0 is no more than that of a trace.
    #[test]
    fn a_sinkage_is_counted_by_its_logarithm() {
        let mut read = Read::new(&[0.2, 0.4], &[0.0], 0.1);
        for (observation, value) in read.observations.iter_mut().zip([30.0, -1.0]) {
            observation.value = value;
        }
        for place in &mut read.places {
            place.measure = Measure::Logarithmic;
        }
        let residuals = Errors::of(&read).residuals(&read.observations, &[10.0, 14.0]);
        assert!((residuals[0] - 7.0 * 3.0_f64.ln()).abs() < 1e-12);
        assert!((residuals[1] + 7.0 * 2.0_f64.ln()).abs() < 1e-12);
    }

    /// A correlation of ρ between two: the bivariate normal density.
    #[test]
    fn two_observations_have_the_density_of_two_normal_numbers() {
        let errors = Errors::of(&Read::new(&[0.0, 0.4], &[0.0], 0.3));
        let (delta, length) = (0.8, 0.6);
        let x = 3.0_f64.sqrt() * 0.4 / length;
        let (variance, covariance) = (0.09 + 0.64, 0.64 * (1.0 + x) * (-x).exp());
        let (a, b) = (0.5, -0.2);
        let determinant = variance * variance - covariance * covariance;
        let square = (variance * (a * a + b * b) - 2.0 * covariance * a * b) / determinant;
        let expected = -0.5 * (square + determinant.ln());
        let found = errors.log_density(&[a, b], &[delta, length]);
        // The jitter is 1e-8 of the variance.
        assert!((found - expected).abs() < 1e-6, "{found}, {expected}");
    }

    /// Over lengths below the distances of the settings nothing is correlated, and without a
    /// discrepancy the scatter is all.
    #[test]
    fn without_a_length_or_a_discrepancy_errors_are_independent() {
        let correlated = Errors::of(&Read::new(&SLIPS, &[0.0, 0.5], 0.2));
        let mut alone = Read::new(&SLIPS, &[0.0, 0.5], 0.2);
        alone.places.clear();
        let independent = Errors::of(&alone);
        let residuals = normal_numbers(3, 1, 18);
        let density = |delta: f64, length: f64| {
            (
                correlated.log_density(&residuals, &[delta, length, length]),
                independent.log_density(&residuals, &[delta]),
            )
        };
        for (delta, length, within) in [(0.7, 1e-3, 1e-6), (1e-9, 0.5, 1e-6)] {
            let (one, other) = density(delta, length);
            assert!((one - other).abs() < within, "{delta}, {length}: {one} and {other}");
        }
        let (one, other) = density(0.7, 0.5);
        assert!((one - other).abs() > 1.0, "correlated ones differ: {one} and {other}");
    }

    /// Whitened residuals have the same squares as the density has.
    #[test]
    fn whitened_residuals_weigh_as_much_as_correlated_ones() {
        let errors = Errors::of(&Read::new(&SLIPS, &[0.0, 0.5], 0.2));
        let found = [0.7, 0.4, 0.3];
        let residuals = normal_numbers(5, 1, 18);
        let square = |residuals: &[f64]| {
            let white = errors.whitener(&found).whitened(residuals);
            white.iter().map(|one| one * one).sum::<f64>()
        };
        let zeros = vec![0.0; 18];
        let difference =
            errors.log_density(&zeros, &found) - errors.log_density(&residuals, &found);
        assert!((difference - 0.5 * square(&residuals)).abs() < 1e-9 * difference);
    }

    /// Twenty series of simulated residuals with lengths of 0.4 and 20°: on average the most likely
    /// lengths are those, and those of independent ones are the shortest that can be.
    #[test]
    fn correlation_lengths_are_recovered_from_residuals() {
        let errors = Errors::of(&Read::new(&SLIPS, &[0.0, deg(15.0), deg(45.0), deg(75.0)], 0.1));
        let truth = [1.0, 0.4, deg(20.0)];
        let factor = &errors.whitener(&truth).factors[0].1;
        let mean_logs = |simulate: &dyn Fn(&[f64]) -> Vec<f64>| {
            let mut sums = [0.0; 2];
            for series in 0..20 {
                let lengths =
                    errors.likely_lengths(&simulate(&normal_numbers(17, series, 36)), &[1.0]);
                for (sum, length) in sums.iter_mut().zip(lengths) {
                    *sum += ln(length) / 20.0;
                }
            }
            sums.map(f64::exp)
        };
        let smooth = mean_logs(&|numbers| {
            (factor * DVector::from_column_slice(numbers)).iter().copied().collect()
        });
        // One series knows a length to 40 % or so, twenty to 10 %; the grid's steps are 1.4.
        for (found, truth) in smooth.iter().zip(&truth[1..]) {
            assert!((found / truth).ln().abs() < 0.35, "{found} instead of {truth}");
        }
        let rough = mean_logs(&<[f64]>::to_vec);
        assert!(rough[0] < 0.15, "{rough:?}");
    }

    /// What was read without scatter is known there, and nothing is known far away.
    #[test]
    fn a_draw_passes_through_what_was_read() {
        let errors = Errors::of(&Read::new(&SLIPS, &[0.0], 1e-3));
        let (found, read) = ([2.0, 0.1], normal_numbers(9, 2, 9));
        let sites = [SLIPS[2], SLIPS[7], 20.0].map(|slip| Site { slip, slip_angle: 0.0 });
        let draws: Vec<Vec<f64>> = (0..400)
            .map(|number| {
                let numbers = normal_numbers(4, number, 3);
                let drawn = errors.drawn(0, &sites, &read, &found, &numbers);
                let both = drawn.mean.iter().zip(&drawn.deviation);
                both.map(|(mean, away)| found[0] * (mean + away)).collect()
            })
            .collect();
        for draw in &draws {
            // Five standard deviations of the scatter.
            assert!((draw[0] - read[2]).abs() < 5e-3 && (draw[1] - read[7]).abs() < 5e-3);
        }
        let square = draws.iter().map(|draw| draw[2] * draw[2]).sum::<f64>() / 400.0;
        // 400 draws know a deviation to 3.5 %.
        assert!((square.sqrt() / 2.0 - 1.0).abs() < 0.14, "{square}");
    }
}
