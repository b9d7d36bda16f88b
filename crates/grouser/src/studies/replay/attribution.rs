//! What differences of measured and predicted point to: a linear regression on what each fault
//! would do to them.
//!
//! Differences over their noise, r, and what the parameters would do to them, J, add up over the
//! drive to
//!
//! ```text
//! N = Σ JᵀJ        g = Σ Jᵀr        c = Σ rᵀr
//! ```
//!
//! with parameters θ over their usual size, which are standard normal beforehand. Where the
//! parameters of some causes S are not zero, the differences have the evidence
//!
//! ```text
//! 2 ln Z_S = g_Sᵀ (N_S + 1)⁻¹ g_S − ln det(N_S + 1) − c
//! ```
//!
//! which pays for each parameter that it has to find (Kass and Raftery 1995). Causes are taken one
//! after the other, that with the most evidence first, as long as it is very strong. Others that
//! would have explained nearly as much cannot be told apart from it.

use nalgebra::{DMatrix, DVector};

use super::differences::Differences;
use super::faults::{COUNT, Cause, Faults, Parameter};
use crate::elementary::wide::ln;

/// Evidence from which on a cause is taken, ln of the Bayes factor: "very strong" (Kass and Raftery
/// 1995, their 2 ln B > 10).
const VERY_STRONG: f64 = 5.0;
/// Causes whose evidence is within this of the best are not told apart from it: what is above is
/// "strong" (2 ln B > 6).
const STRONG: f64 = 3.0;
/// A cause that explains less of the differences than this is not pointed to [-]: with enough
/// telemetry the smallest difference is beyond doubt. Source: ours.
const LEAST_SHARE: f64 = 0.02;
/// Causes at most. Source: ours: after three there is more wrong than a list of causes has.
const MOST: usize = 3;
/// A parameter that the differences leave as uncertain as this, over its usual size, is one that
/// nothing was learnt of [-]. Source: ours.
const NOT_LEARNT: f64 = 0.9;

/// Differences added up over a drive.
#[derive(Clone, Debug)]
pub(super) struct Sums {
    information: DMatrix<f64>,
    gradient: DVector<f64>,
    square: f64,
    /// Numbers that were compared.
    count: f64,
    /// Stretches.
    pub(super) stretches: usize,
}

/// What differences say of a cause.
#[derive(Clone, Debug, PartialEq)]
pub enum Attribution {
    /// They point to it.
    PointsTo,
    /// They point to it or to others, which cannot be told apart.
    Underdetermined(Vec<Cause>),
    /// They do not point to it.
    Nothing,
    /// They leave its parameters as uncertain as before.
    CannotTell,
}

/// A cause with its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The parameter.
    pub parameter: Parameter,
    /// Its estimate, in SI; of the soil the share by which a number is larger. Together with the
    /// other causes that are pointed to; of another cause as if it were the next.
    pub estimate: f64,
    /// Its standard deviation.
    pub deviation: f64,
    /// The share of the squares of the differences that its cause explains [-].
    pub share: f64,
    /// The evidence for its cause, ln of the Bayes factor [-].
    pub evidence: f64,
    /// What the differences say of its cause.
    pub verdict: Attribution,
    /// Its cause as the only one.
    pub alone: Alone,
}

/// A cause as the only one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alone {
    /// The share of the squares of the differences that it explains [-].
    pub share: f64,
    /// The evidence for it, ln of the Bayes factor over no cause at all [-].
    pub evidence: f64,
}

/// A fit of the parameters of some causes.
struct Fit {
    /// Parameters by their places among all.
    places: Vec<usize>,
    /// Estimates and standard deviations, over the usual size.
    estimates: DVector<f64>,
    deviations: Vec<f64>,
    evidence: f64,
    /// Squares that are explained.
    explained: f64,
}

impl Fit {
    /// Whether the differences say anything of a parameter of a cause.
    fn has_learnt(&self, cause: Cause) -> bool {
        let of_cause = |place: usize| Parameter::ALL[place].cause() == cause;
        let pairs = self.places.iter().zip(&self.deviations);
        pairs.into_iter().any(|(place, deviation)| of_cause(*place) && *deviation < NOT_LEARNT)
    }
}

impl Sums {
    pub(super) fn new() -> Self {
        Self {
            information: DMatrix::zeros(COUNT, COUNT),
            gradient: DVector::zeros(COUNT),
            square: 0.0,
            count: 0.0,
            stretches: 0,
        }
    }

    /// Adds a stretch.
    ///
    /// * `base`: what its differences take to be wrong already
    pub(super) fn add(&mut self, stretch: &Differences, base: &Faults) {
        // As if nothing were wrong: a tangent at the base is drawn back to zero.
        let at = DVector::from_vec(base.over_usual());
        let residuals = &stretch.residuals + &stretch.sensitivities * at;
        self.information += stretch.sensitivities.tr_mul(&stretch.sensitivities);
        self.gradient += stretch.sensitivities.tr_mul(&residuals);
        self.square += residuals.norm_squared();
        self.count += residuals.len() as f64;
        self.stretches += 1;
    }

    /// What the differences say of every cause.
    pub(super) fn findings(&self) -> Vec<Finding> {
        let taken = self.taken();
        let causes: Vec<Cause> = taken.iter().map(|(cause, _)| *cause).collect();
        let whole = self.fit(&causes);
        let of_cause = |cause: Cause| {
            let found = taken.iter().position(|(it, _)| *it == cause);
            let before = &causes[..found.unwrap_or(causes.len())];
            let with: Vec<Cause> = before.iter().copied().chain([cause]).collect();
            let (without, with) = (self.fit(before), self.fit(&with));
            let square = self.square.max(f64::MIN_POSITIVE);
            let share = (with.explained - without.explained) / square;
            let only = self.fit(&[cause]);
            let nothing = self.fit(&[]);
            let alone = Alone {
                share: (only.explained - nothing.explained) / square,
                evidence: only.evidence - nothing.evidence,
            };
            let rival = taken.iter().find(|(_, rivals)| rivals.contains(&cause));
            let verdict = match (found.map(|place| &taken[place].1), rival) {
                (Some(rivals), _) if rivals.is_empty() => Attribution::PointsTo,
                (Some(rivals), _) => Attribution::Underdetermined(rivals.clone()),
                (None, Some((best, rivals))) => {
                    let others = rivals.iter().filter(|it| **it != cause);
                    Attribution::Underdetermined(
                        [*best].into_iter().chain(others.copied()).collect(),
                    )
                }
                (None, None) if with.has_learnt(cause) => Attribution::Nothing,
                (None, None) => Attribution::CannotTell,
            };
            let fit = if found.is_some() { &whole } else { &with };
            let evidence = with.evidence - without.evidence;
            let parameters = Parameter::ALL.into_iter().filter(|it| it.cause() == cause);
            let finding = |parameter: Parameter| {
                let place = fit.places.iter().position(|it| *it == parameter as usize);
                let found = place.map_or([0.0, 1.0], |it| [fit.estimates[it], fit.deviations[it]]);
                let [estimate, deviation] =
                    parameter.as_share(found.map(|it| it * parameter.usual()));
                Finding {
                    parameter,
                    estimate,
                    deviation,
                    share,
                    evidence,
                    verdict: verdict.clone(),
                    alone,
                }
            };
            parameters.map(finding).collect::<Vec<_>>()
        };
        Cause::ALL.into_iter().flat_map(of_cause).collect()
    }

    /// What is wrong by the causes that are pointed to.
    pub(super) fn best(&self) -> Faults {
        let causes: Vec<Cause> = self.taken().into_iter().map(|(cause, _)| cause).collect();
        let fit = self.fit(&causes);
        let mut values = [0.0; COUNT];
        for (place, estimate) in fit.places.iter().zip(fit.estimates.iter()) {
            values[*place] = *estimate;
        }
        Faults::of(values)
    }

    /// The causes that are pointed to, each with those that are not told apart from it.
    fn taken(&self) -> Vec<(Cause, Vec<Cause>)> {
        let mut taken: Vec<(Cause, Vec<Cause>)> = Vec::new();
        while taken.len() < MOST {
            let causes: Vec<Cause> = taken.iter().map(|(cause, _)| *cause).collect();
            let without = self.fit(&causes);
            let open = Cause::ALL.into_iter().filter(|it| !causes.contains(it));
            let mut found: Vec<(Cause, Fit)> = open
                .map(|cause| {
                    let with: Vec<Cause> = causes.iter().copied().chain([cause]).collect();
                    (cause, self.fit(&with))
                })
                .collect();
            found.sort_by(|(_, one), (_, other)| other.evidence.total_cmp(&one.evidence));
            let Some((best, fit)) = found.first() else { break };
            let is_strong = fit.evidence - without.evidence > VERY_STRONG;
            if !is_strong || fit.explained - without.explained < LEAST_SHARE * self.square {
                break;
            }
            let rivals = found[1..].iter().filter(|(_, it)| it.evidence > fit.evidence - STRONG);
            taken.push((*best, rivals.map(|(cause, _)| *cause).collect()));
        }
        taken
    }

    /// How much larger the squares are, where everything is fitted, than noise makes them [-]: 1 at
    /// least.
    fn misfit(&self) -> f64 {
        let all = self.fitted(&Cause::ALL, 1.0);
        ((self.square - all.explained) / self.count.max(1.0)).max(1.0)
    }

    fn fit(&self, causes: &[Cause]) -> Fit {
        self.fitted(causes, self.misfit())
    }

    /// * `misfit`: by which the noise is larger than assumed, its variance [-]
    fn fitted(&self, causes: &[Cause], misfit: f64) -> Fit {
        let is_in = |parameter: &Parameter| causes.contains(&parameter.cause());
        let places: Vec<usize> =
            Parameter::ALL.into_iter().filter(is_in).map(|it| it as usize).collect();
        let count = places.len();
        let mut information = DMatrix::identity(count, count);
        for (row, from) in places.iter().enumerate() {
            for (column, to) in places.iter().enumerate() {
                information[(row, column)] += self.information[(*from, *to)] / misfit;
            }
        }
        let gradient =
            DVector::from_iterator(count, places.iter().map(|it| self.gradient[*it] / misfit));
        let plain = DMatrix::from_fn(count, count, |row, column| {
            information[(row, column)] - if row == column { 1.0 } else { 0.0 }
        });
        // With the unit matrix in it, it is positive definite.
        let Some(factors) = information.cholesky() else {
            return Fit {
                places,
                estimates: DVector::zeros(count),
                deviations: vec![1.0; count],
                evidence: f64::NEG_INFINITY,
                explained: 0.0,
            };
        };
        let estimates = factors.solve(&gradient);
        let determinant: f64 = factors.l().diagonal().iter().map(|it| 2.0 * ln(*it)).sum();
        let evidence = 0.5 * (gradient.dot(&estimates) - determinant);
        let explained =
            misfit * (2.0 * gradient.dot(&estimates) - estimates.dot(&(plain * &estimates)));
        let covariance = factors.inverse();
        let deviations = covariance.diagonal().iter().map(|it| it.sqrt()).collect();
        Fit { places, estimates, deviations, evidence, explained }
    }
}
