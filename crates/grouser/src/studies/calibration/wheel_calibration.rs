//! A complete calibration on wheel tests: fit, posterior samples, errors, cross-validation, and the
//! runs to make next.

use super::cross_validation::{
    Coverage, LeftOut, LeftOutBand, leave_one_angle_out, slip_angles, without,
};
use super::design::{Aim, Proposal};
use super::solution::{Observer, Sampling, Solution, Work};
use super::wheel_test::Setup;
use super::{
    Calibration, CalibrationError, Fit, FitSettings, Parameter, ParameterSpace,
    WheelTestExperiment, handed_on,
};
use crate::error::ParameterError;
use crate::soil::Soil;
use crate::studies::measurement::{PerQuantity, WheelTests};
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
    pub left_out: Vec<LeftOutGroup>,
    /// The same of all of them together, if angles were left out.
    pub left_out_overall: Option<LeftOutGroup>,
    /// The runs to make next, the best first.
    pub proposals: Vec<Proposal>,
}

/// Cells that a fit has not seen: its errors, and how its bands hold them.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOutGroup {
    /// The cells, with the errors of the fit.
    pub group: Group,
    /// How the posterior's bands hold them; `None` where the quantity was not measured, or nothing
    /// was sampled.
    pub coverage: PerQuantity<Option<Coverage>>,
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
        let mut solution = calibration.solve(fit, self.sampling.clone(), observer)?;
        if let Some(posterior) = &mut solution.posterior {
            let (rows, seed) = (posterior.kept(), posterior.settings.seed);
            posterior.discrepancies =
                handed_on::discrepancies(&calibration, &experiment, &rows, seed);
        }
        let left_out = if self.cross_validate { Some(self.left_out(observer)?) } else { None };
        let (left_out, overall) = left_out.unzip();
        Ok(WheelFindings {
            proposals: self.aim.proposals(calibration.space(), &experiment, &solution),
            validation: self.judge((self.setup.soil_of)(&solution.fit.values)?),
            left_out: left_out.unwrap_or_default(),
            left_out_overall: overall,
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
        let Setup { wheel, model, gravity, .. } = self.setup;
        ValidationStudy { tests: self.tests, wheel, soil, model: model.clone(), gravity }.run()
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

    /// Each slip angle by the fit without it, and all of them together.
    fn left_out(
        &self,
        observer: &dyn Observer,
    ) -> Result<(Vec<LeftOutGroup>, LeftOutGroup), CalibrationError> {
        observer.begins(Work::LeavingOut);
        let (settings, searched) = (FitSettings::default(), || observer.searched());
        let sampler = self.sampling.as_ref().map(|sampling| &sampling.settings);
        let (tests, space) = (self.tests, &self.space);
        let fits = leave_one_angle_out(tests, self.setup, space, &settings, sampler, &searched)?;
        observer.ends();
        let validation = self.unseen(&fits)?;
        let bands: Vec<LeftOutBand> = fits.into_iter().flat_map(|left| left.bands).collect();
        let with_coverage = |group: Group| {
            let is_own = |band: &&LeftOutBand| {
                let cell = &tests.cells[band.cell];
                group.slip_angle.is_none_or(|angle| angle == cell.slip_angle)
                    && group.driven.is_none_or(|driven| driven == cell.is_driven())
            };
            let own: Vec<LeftOutBand> = bands.iter().filter(is_own).copied().collect();
            let coverage = PerQuantity::from_fn(|quantity| {
                let own = own.iter().filter(|band| band.quantity == quantity);
                Coverage::of(&own.copied().collect::<Vec<_>>())
            });
            LeftOutGroup { group, coverage }
        };
        let groups = validation.groups.into_iter().map(with_coverage).collect();
        Ok((groups, with_coverage(validation.overall)))
    }

    /// Every trial by the fit that has not seen its slip angle.
    fn unseen(&self, fits: &[LeftOut]) -> Result<Validation, ParameterError> {
        let Some(first) = fits.first() else { return Ok(Validation::of(self.tests, Vec::new())) };
        // Trials of no cell are in no error.
        let mut predictions = self.judge((self.setup.soil_of)(&first.fit.values)?).predictions;
        for (trial, prediction) in fits.iter().flat_map(|left| &left.predictions) {
            predictions[*trial] = *prediction;
        }
        Ok(Validation::of(self.tests, predictions))
    }
}
