//! A complete calibration on wheel tests: fit, posterior samples, errors, cross-validation, and the runs to
//! make next.

use super::cross_validation::{leave_one_angle_out, slip_angles, without};
use super::design::{Aim, Proposal};
use super::solution::{Observer, Sampling, Solution, Work};
use super::wheel_test::Setup;
use super::{
    Calibration, CalibrationError, Fit, FitSettings, Parameter, ParameterSpace, WheelTestExperiment,
};
use crate::error::ParameterError;
use crate::soil::Soil;
use crate::studies::measurement::WheelTests;
use crate::studies::validation::{Group, Validation, ValidationStudy};

/// Measurements, the model to fit, and the steps to take.
pub struct WheelCalibration<'a> {
    /// The tests.
    pub tests: &'a WheelTests,
    /// The wheel, gravity and model of the tests.
    pub setup: Setup<'a>,
    /// The parameters of the soil.
    pub space: ParameterSpace,
    /// How the posterior is sampled; least squares alone without.
    pub sampling: Option<Sampling>,
    /// The prediction that the next runs should narrow.
    pub aim: Aim,
    /// Whether each slip angle is left out in turn, and the fit judged there.
    pub cross_validate: bool,
}

/// The results of a calibration on wheel tests.
#[derive(Clone, Debug)]
pub struct WheelFindings {
    /// Parameters, samples, unidentifiable parameters.
    pub solution: Solution,
    /// The errors with the fit.
    pub validation: Validation,
    /// The errors at each slip angle of the fit without it: driven, skid.
    pub left_out: Vec<Group>,
    /// The runs to make next, the best first; none without samples.
    pub proposals: Vec<Proposal>,
}

impl WheelCalibration<'_> {
    /// Takes all steps of the calibration.
    ///
    /// # Errors
    /// [`CalibrationError`] for measurements and parameters that do not go together, and if the
    /// observer stopped it.
    pub fn run(&self, observer: &dyn Observer) -> Result<WheelFindings, CalibrationError> {
        if self.cross_validate {
            self.check_that_angles_can_be_left_out()?;
        }
        let experiment = WheelTestExperiment::new(self.tests, self.setup)?;
        let rough = Calibration::new(&experiment, self.space.clone())?
            .search(&FitSettings::default(), observer)?;
        // Now that a soil is known, what differing loads did to repeated trials is no scatter.
        let experiment = experiment.with_scatter_about(&rough.values)?;
        let calibration = Calibration::new(&experiment, self.starting_at(&rough.values)?)?;
        let last = FitSettings { starts: 1, tried: 1, ..FitSettings::default() };
        let fit = Fit { searches: rough.searches, ..calibration.search(&last, observer)? };
        let solution = calibration.solve(fit, self.sampling.clone(), observer)?;
        let left_out = if self.cross_validate { self.left_out(observer)? } else { Vec::new() };
        Ok(WheelFindings {
            proposals: self.aim.proposals(&experiment, &solution),
            validation: self.judge((self.setup.soil_of)(&solution.fit.values)?),
            left_out,
            solution,
        })
    }

    /// The same parameters, searched from other values.
    fn starting_at(&self, values: &[f64]) -> Result<ParameterSpace, ParameterError> {
        let each = self.space.parameters().iter().zip(values);
        let moved = each.map(|(parameter, &start)| Parameter { start, ..parameter.clone() });
        ParameterSpace::new(moved.collect())
    }

    fn judge(&self, soil: Soil) -> Validation {
        let Setup { wheel, theory, gravity, .. } = self.setup;
        ValidationStudy { tests: self.tests, wheel, soil, theory, gravity }.run()
    }

    /// What would fail after hours of sampling fails at once.
    fn check_that_angles_can_be_left_out(&self) -> Result<(), CalibrationError> {
        let angles = slip_angles(self.tests);
        if let [_] = angles[..] {
            return Err(CalibrationError::OneSlipAngle);
        }
        for slip_angle in angles {
            let tests = without(self.tests, slip_angle);
            let others = WheelTestExperiment::new(&tests, self.setup)?;
            Calibration::new(&others, self.space.clone()).map_err(|error| {
                CalibrationError::LeavingOut { slip_angle, error: Box::new(error) }
            })?;
        }
        Ok(())
    }

    fn left_out(&self, observer: &dyn Observer) -> Result<Vec<Group>, CalibrationError> {
        observer.begins(Work::LeavingOut);
        let (settings, searched) = (FitSettings::default(), || observer.searched());
        let fits = leave_one_angle_out(self.tests, self.setup, &self.space, &settings, &searched)?;
        observer.ends();
        let mut groups = Vec::new();
        for left in fits {
            let mut validation = self.judge((self.setup.soil_of)(&left.fit.values)?);
            validation.groups.retain(|group| group.slip_angle == Some(left.slip_angle));
            groups.append(&mut validation.groups);
        }
        Ok(groups)
    }
}
