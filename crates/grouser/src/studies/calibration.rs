//! Calibration: estimates parameters from measurements, with confidence intervals, and proposes the
//! runs to make next.
//!
//! An [`Experiment`] is measurements and the model that predicts them: [`WheelTestExperiment`] for
//! a wheel on a test stand, [`BevameterTest`](bevameter::BevameterTest) for plates and shear tests,
//! [`PlateTest`] for plates alone. A [`Calibration`] has one, and the [`ParameterSpace`] to search.
//! An observation y_i of channel k, the mean over repeated trials, is taken as
//!
//! ```text
//! y_i = f_i(θ) + δ_i + N(0, s_i²)
//! ```
//!
//! with the scatter s_i of the trials, which is known, and the model's discrepancy δ_i, which is
//! estimated along with θ: no model is exact, and more trials of an inexact model must not narrow
//! its parameters without limit. A discrepancy is normal, with a standard deviation for each
//! channel, and those of wheels at similar slips and slip angles are correlated ([`errors`]).
//!
//! The order of work, each step on its own:
//!
//! 1. [`Calibration::fit`]: bounded least squares from several starts;
//! 2. [`Calibration::start_posterior`] and [`Calibration::advance`]: samples of all parameter sets
//!    that agree with the data, in blocks, between which a run can be stopped, kept and resumed;
//! 3. [`diagnostics`]: convergence of the sampler, and summaries of the samples;
//! 4. [`identifiability`]: parameters that these data do not determine;
//! 5. [`design`]: which run to make next;
//! 6. [`handed_on`]: what a sample hands on to predictions, its discrepancy included;
//! 7. [`cross_validation`]: the same fit with some measurements left out.
//!
//! [`solution`] takes the first four at once, and [`WheelCalibration`] all of them.
//!
//! Everything has the same bits for any number of threads.

pub mod bevameter;
pub mod cross_validation;
pub mod design;
pub mod diagnostics;
mod ensemble;
pub mod errors;
pub mod experiment;
pub mod fit;
pub mod handed_on;
pub mod identifiability;
mod least_squares;
pub mod parameter;
pub mod plate_curve;
pub mod plate_test;
pub mod posterior;
pub mod repeated_curves;
pub mod scatter;
pub mod shear_test;
pub mod solution;
pub mod wheel_calibration;
pub mod wheel_test;
pub mod wong;

pub use experiment::{Channel, Experiment, Measure, Observation, Place, Regime, Site};
pub use fit::{Fit, FitSettings};
pub use parameter::{Parameter, ParameterSpace, Scale};
pub use plate_curve::PlateCurve;
pub use plate_test::{PlateLaw, PlateTest};
pub use posterior::{Advanced, PosteriorState, SamplerSettings};
pub use shear_test::ShearCurve;
pub use solution::{Observer, Posterior, Sampling, Solution, Work};
pub use wheel_calibration::{LeftOutGroup, WheelCalibration, WheelFindings};
pub use wheel_test::{Resolution, WheelTestExperiment};
pub use wong::WongFit;

use crate::error::ParameterError;
use errors::Errors;

/// An experiment, and the parameters to estimate.
///
/// Which moduli of Bekker's law fit two plates, 5 and 10 cm wide, that were pressed 1 to 4 cm deep?
///
/// ```
/// use std::ops::ControlFlow;
///
/// use grouser::studies::calibration::plate_curve::PlatePoint;
/// use grouser::studies::calibration::{
///     Calibration, FitSettings, Parameter, ParameterSpace, PlateCurve, PlateLaw, PlateTest, Scale,
/// };
/// use grouser::units::{kpa, mm};
///
/// // Readings made up for this example: the plate's width [mm], and its pressures [kPa]
/// // at sinkages of 10, 20, 30 and 40 mm.
/// let measured = [(50.0, [21.3, 45.1, 70.8, 97.4]), (100.0, [16.9, 36.3, 56.9, 77.5])];
/// let curves = measured.map(|(width, pressures)| PlateCurve {
///     width: mm(width),
///     points: std::iter::zip([10.0, 20.0, 30.0, 40.0], pressures)
///         .map(|(z, p)| PlatePoint { sinkage: mm(z), pressure: kpa(p), scatter: kpa(0.5) })
///         .collect(),
/// });
/// let plates = PlateTest::new(PlateLaw::Bekker, curves.to_vec())?;
/// let parameter = |name: &str, lower, upper, start| {
///     Parameter { name: name.into(), lower, upper, scale: Scale::Logarithmic, start }
/// };
/// let space = ParameterSpace::new(vec![
///     parameter("k_c", 1e3, 1e6, 5e4),
///     parameter("k_phi", 1e5, 1e8, 1e6),
///     parameter("n", 0.3, 3.0, 1.0),
/// ])?;
/// let calibration = Calibration::new(&plates, space)?;
/// let fit = calibration.fit(&FitSettings::default(), &|| ControlFlow::Continue(()))?;
/// assert_eq!(format!("k_c = {:.0} kN/m^(n+1)", 1e-3 * fit.values[0]), "k_c = 67 kN/m^(n+1)");
/// assert_eq!(format!("k_phi = {:.0} kN/m^(n+2)", 1e-3 * fit.values[1]), "k_phi = 2009 kN/m^(n+2)");
/// assert_eq!(format!("n = {:.2}", fit.values[2]), "n = 1.10");
/// # Ok::<(), grouser::studies::calibration::CalibrationError>(())
/// ```
#[derive(Clone)]
pub struct Calibration<'a> {
    experiment: &'a dyn Experiment,
    space: ParameterSpace,
    discrepancies: ParameterSpace,
    errors: Errors,
}

/// The most observations that are fitted. Thirty-six cells of wheel tests with seventeen keys take
/// a minute, and the time grows with their number: ten thousand keep a machine busy for hours.
pub const MOST_OBSERVATIONS: usize = 10_000;

/// A calibration has no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CalibrationError {
    /// No parameters were given.
    #[error("no parameter is to be fitted")]
    NoParameters,
    /// The fitted soil is a document, which has no name for a model of your own.
    #[error(
        "the fitted soil is a document that names its model, and documents have no name for a \
         model of your own: fit it with `studies::calibration`, which gives the parameters alone"
    )]
    OwnModel,
    /// There are not enough observations for the parameters.
    #[error("{observations} observations cannot determine {parameters} parameters")]
    TooFewObservations {
        /// Their number.
        observations: usize,
        /// The number of parameters to determine.
        parameters: usize,
    },
    /// There are more observations than a search can use in reasonable time.
    #[error(
        "{observations} observations are more than {most}, the most that are fitted: let rows that \
         repeat each other form one cell (their mean is one observation), or choose rows"
    )]
    TooManyObservations {
        /// Their number.
        observations: usize,
        /// The largest number that is fitted.
        most: usize,
    },
    /// An observation is not a finite number, or its scatter is negative.
    #[error("observation {number} is {value} with a scatter of {scatter}: both must be finite")]
    BadObservation {
        /// Its place, from 0.
        number: usize,
        /// Its value.
        value: f64,
        /// Its scatter.
        scatter: f64,
    },
    /// A parameter is invalid.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// No start has parameters of a valid soil with finite predictions.
    #[error("none of {starts} starts gives finite predictions; the first fails: {reason}")]
    NoStart {
        /// The number of starts tried.
        starts: usize,
        /// The error at the given start.
        reason: String,
    },
    /// A slip angle cannot be left out where there is no other.
    #[error("each slip angle is left out in turn, and all trials are at one")]
    OneSlipAngle,
    /// Without a slip angle the other cells cannot be fitted. (The angle is rounded as it was
    /// written.)
    #[error("without the trials at {}°, {error}", (slip_angle.to_degrees() * 1e9).round() / 1e9)]
    LeavingOut {
        /// The slip angle that is left out [rad].
        slip_angle: f64,
        /// The error of the others.
        error: Box<CalibrationError>,
    },
    /// The observer asked to stop.
    #[error("interrupted")]
    Interrupted,
    /// A state of the sampler that belongs to another problem, or was damaged.
    #[error("the sampler's state does not fit the problem: {what}")]
    ForeignState {
        /// The difference.
        what: String,
    },
}

impl<'a> Calibration<'a> {
    /// The calibration of some parameters from an experiment.
    ///
    /// # Errors
    /// [`CalibrationError`] if there are no parameters, fewer observations than parameters, more
    /// than [`MOST_OBSERVATIONS`], or observations that are not finite.
    pub fn new(
        experiment: &'a dyn Experiment,
        space: ParameterSpace,
    ) -> Result<Self, CalibrationError> {
        if space.is_empty() {
            return Err(CalibrationError::NoParameters);
        }
        let observations = experiment.observations();
        if observations.len() < space.len() {
            let (observations, parameters) = (observations.len(), space.len());
            return Err(CalibrationError::TooFewObservations { observations, parameters });
        }
        if observations.len() > MOST_OBSERVATIONS {
            let (observations, most) = (observations.len(), MOST_OBSERVATIONS);
            return Err(CalibrationError::TooManyObservations { observations, most });
        }
        for (number, &Observation { value, scatter, .. }) in observations.iter().enumerate() {
            if !(value.is_finite() && scatter.is_finite() && scatter >= 0.0) {
                return Err(CalibrationError::BadObservation { number, value, scatter });
            }
        }
        let errors = Errors::of(experiment);
        let mut discrepancies = experiment::discrepancies(experiment);
        discrepancies.extend_from_slice(errors.lengths());
        let discrepancies = ParameterSpace::new(discrepancies)?;
        Ok(Self { experiment, space, discrepancies, errors })
    }

    /// The experiment.
    #[must_use]
    pub fn experiment(&self) -> &'a dyn Experiment {
        self.experiment
    }

    /// The parameters.
    #[must_use]
    pub fn space(&self) -> &ParameterSpace {
        &self.space
    }

    /// What describes the model discrepancies, as parameters with priors of their own: a standard
    /// deviation for each channel, then the correlation lengths, where there are any.
    #[must_use]
    pub fn discrepancies(&self) -> &ParameterSpace {
        &self.discrepancies
    }

    /// The number of parameters and discrepancies: the coordinates of a posterior sample.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.space.len() + self.discrepancies.len()
    }

    /// Predictions of all observations; `None` where the values are no valid soil or give no finite
    /// predictions.
    fn predictions(&self, values: &[f64]) -> Option<Vec<f64>> {
        let mut predictions = vec![0.0; self.experiment.observations().len()];
        self.experiment.predict(values, &mut predictions).ok()?;
        predictions.iter().all(|prediction| prediction.is_finite()).then_some(predictions)
    }

    /// The errors of the observations about the model.
    #[must_use]
    pub fn errors(&self) -> &Errors {
        &self.errors
    }

    /// Logarithm of the posterior's density in coordinates, up to a constant.
    ///
    /// * `coordinates`: of the parameters, then of the discrepancies
    #[must_use]
    pub fn log_posterior(&self, coordinates: &[f64]) -> f64 {
        let (parameters, discrepancies) = coordinates.split_at(self.space.len());
        let Some(predictions) = self.predictions(&self.space.values(parameters)) else {
            return f64::NEG_INFINITY;
        };
        let residuals = self.errors.residuals(self.experiment.observations(), &predictions);
        let found = self.discrepancies.values(discrepancies);
        let log_density =
            ParameterSpace::log_prior(coordinates) + self.errors.log_density(&residuals, &found);
        if log_density.is_finite() { log_density } else { f64::NEG_INFINITY }
    }
}
