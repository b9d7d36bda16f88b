//! A calibration on wheel tests, from documents to documents.

use serde::Serialize;
use serde_json::{Value, json};

use super::super::checkpoint::fingerprint;
use super::super::measurements::{Condition, Measurements};
use super::super::soil_family::DISCREPANCY;
use super::super::validation::GroupRecord;
use super::super::{Document, SAMPLES_FILE, SoilFamily, with_priors_held};
use super::{
    DiscrepancyRecord, LeftOutRecord, LengthRecord, ParameterRecord, ProposalRecord, SamplerRecord,
    Solved, handed_on,
};
use crate::contact::Model;
use crate::error::ParameterError;
use crate::soil::Soil;
use crate::studies::calibration::design::Aim;
use crate::studies::calibration::wheel_test::{Discrepancies, Setup};
use crate::studies::calibration::{
    CalibrationError, Observer, ParameterSpace, Resolution, Sampling, WheelCalibration,
};
use crate::studies::measurement::{Quantity, WheelTests};
use crate::studies::validation::Validation;
use crate::wheel::Wheel;

/// The inputs of a calibration on wheel tests.
pub struct WheelProblem<'a> {
    /// The soils among which it chooses.
    pub family: &'a SoilFamily,
    /// The measurements.
    pub measured: &'a Measurements,
    /// Name of the file, for the soil's source.
    pub file: &'a str,
    /// The wheel.
    pub wheel: Wheel,
    /// The wheel–soil model.
    pub model: Model,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// How the posterior is sampled; least squares alone without.
    pub sampling: Option<Sampling>,
    /// The prediction that the next runs should narrow.
    pub aim: Aim,
    /// Whether each slip angle is left out in turn.
    pub cross_validate: bool,
}

/// What a calibration on wheel tests was asked, as its answer states it.
pub struct WheelInputs<'a> {
    /// What the data are called.
    pub data: &'a str,
    /// Their bytes.
    pub bytes: &'a [u8],
    /// Which rows count.
    pub conditions: &'a [Condition],
    /// The soils among which it chooses.
    pub family: &'a SoilFamily,
    /// The soil to start from.
    pub soil: &'a Document,
    /// The wheel that was tested.
    pub wheel: &'a Document,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// The wheel–soil model.
    pub model: &'a Model,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Steps of each walker of the posterior.
    pub steps: u64,
}

impl WheelInputs<'_> {
    /// The inputs by their names.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let conditions: Vec<String> = self.conditions.iter().map(ToString::to_string).collect();
        let keys = self.family.parameters().iter();
        let fit: Vec<Value> =
            keys.map(|key| json!({"key": key.name, "from": key.lower, "to": key.upper})).collect();
        json!({
            "data": self.data,
            "data_fingerprint": fingerprint(self.bytes),
            "where": conditions,
            "fit": fit,
            "soil": self.soil,
            "wheel": self.wheel,
            "gravity_m_s2": self.gravity,
            "model": self.model.name(),
            "seed": self.seed,
            "steps": self.steps,
        })
    }
}

/// The results of a calibration on wheel tests.
#[derive(Clone, Debug)]
pub struct WheelFound {
    /// Parameters, samples, unidentifiable parameters.
    pub solved: Solved,
    /// The errors with the fit.
    pub validation: Validation,
    /// The errors at each slip angle of the fit without it.
    pub left_out: Vec<LeftOutRecord>,
    /// The same of all of them together, if angles were left out.
    pub left_out_overall: Option<LeftOutRecord>,
    /// The runs to make next, the best first.
    pub proposals: Vec<ProposalRecord>,
    /// The soil of the fit.
    pub soil: Document,
    /// What the data cannot show, a sentence each.
    notes: Vec<String>,
}

/// The same as JSON.
#[derive(Clone, Debug, Serialize)]
pub struct WheelResults<'a> {
    rows: &'a [ParameterRecord],
    discrepancies: &'a [DiscrepancyRecord],
    correlation_lengths: &'a [LengthRecord],
    unidentifiable: &'a [String],
    target: &'a str,
    proposals: &'a [ProposalRecord],
    overall: GroupRecord,
    driven: Option<GroupRecord>,
    cross_validation: &'a [LeftOutRecord],
    cross_validation_overall: &'a Option<LeftOutRecord>,
    searches_that_agree: usize,
    searches: usize,
    sampler: &'a Option<SamplerRecord>,
    notes: Vec<String>,
}

impl WheelProblem<'_> {
    /// Calibrates.
    ///
    /// # Errors
    /// [`CalibrationError`] for measurements and keys that do not go together, for a model of your
    /// own, and if the observer stopped it.
    pub fn solve(&self, observer: &dyn Observer) -> Result<WheelFound, CalibrationError> {
        if matches!(self.model, Model::Own(_)) {
            return Err(CalibrationError::OwnModel);
        }
        let family = self.family;
        let soil_of = |values: &[f64]| -> Result<Soil, ParameterError> { family.soil(values) };
        let calibration = WheelCalibration {
            tests: &self.measured.tests,
            setup: Setup {
                wheel: self.wheel,
                model: &self.model,
                gravity: self.gravity,
                soil_of: &soil_of,
                resolution: Resolution::Cells,
                discrepancies: Discrepancies::PerRegime,
            },
            space: ParameterSpace::new(family.parameters().to_vec())?,
            sampling: self.sampling.clone(),
            aim: self.aim.clone(),
            cross_validate: self.cross_validate,
        };
        let found = calibration.run(observer)?;
        let unit = if self.aim.target.quantity == Quantity::Sinkage { 1e3 } else { 1.0 };
        let candidates = &self.aim.candidates;
        let proposals = found.proposals.iter();
        let solved = Solved::new(family.parameters(), found.solution);
        Ok(WheelFound {
            soil: self.soil(&solved),
            validation: found.validation,
            left_out: found.left_out.iter().map(LeftOutRecord::from).collect(),
            left_out_overall: found.left_out_overall.as_ref().map(LeftOutRecord::from),
            proposals: proposals.map(|it| ProposalRecord::new(it, candidates, unit)).collect(),
            notes: data_notes(&self.measured.tests, family.parameters().len()),
            solved,
        })
    }

    /// The soil of the fit, with where its values come from.
    fn soil(&self, solved: &Solved) -> Document {
        let keys: Vec<&str> = self.family.keys().collect();
        let source = format!(
            "{} fitted by Grouser {} to {} ({} trials in {} cells)",
            keys.join(", "),
            env!("CARGO_PKG_VERSION"),
            self.file,
            self.measured.tests.trials.len(),
            self.measured.tests.cells.len(),
        );
        let samples = solved.solution.posterior.as_ref().map(|_| SAMPLES_FILE);
        let values = &solved.solution.fit.values;
        let fitted = self.family.fitted(values, &source, Some(self.model.clone()), samples);
        let fitted = handed_on::nominal(solved).map_or_else(
            || fitted.clone(),
            |none| fitted.changed(|keys| drop(keys.insert(DISCREPANCY.to_owned(), none))),
        );
        // The samples were found with the other numbers as they are.
        if samples.is_some() { with_priors_held(&fitted) } else { fitted }
    }
}

/// What data are too few or too alike to show.
///
/// * `keys`: how many are fitted
fn data_notes(tests: &WheelTests, keys: usize) -> Vec<String> {
    /// Loads within this ratio are one load [-]. Source: ours.
    const SAME_LOAD: f64 = 1.1;
    /// Fewer cells for each fitted key are few [-]. Source: ours.
    const CELLS_PER_KEY: usize = 3;
    let mut notes = Vec::new();
    let cells = tests.cells.len();
    if cells < CELLS_PER_KEY * keys {
        notes.push(format!(
            "{cells} cells are few for {keys} fitted {}: fit fewer, or measure at least {} \
             different settings of slip, slip angle and load",
            if keys == 1 { "key" } else { "keys" },
            CELLS_PER_KEY * keys
        ));
    }
    if tests.trials.len() == cells {
        notes.push(
            "no trial is repeated: how much trials scatter is not known, and every deviation \
             counts as the model's; repeat some trials"
                .to_owned(),
        );
    }
    let loads = || tests.trials.iter().map(|trial| trial.load);
    let (low, high) = (loads().fold(f64::INFINITY, f64::min), loads().fold(0.0, f64::max));
    if cells > 0 && high <= SAME_LOAD * low {
        let [low, high] = [low, high].map(|load| format!("{load:.1}"));
        let loads = if low == high { low } else { format!("{low} to {high}") };
        notes.push(format!(
            "all trials have one load, {loads} N: how the soil answers another load is not known \
             from them"
        ));
    }
    notes
}

impl WheelFound {
    /// What to know of the results, a sentence each: what the data cannot show (few cells, no
    /// repeats, one load), and the notes of the [solution](Solved::notes).
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        [self.notes.clone(), self.solved.notes()].concat()
    }

    /// The results for JSON.
    ///
    /// * `target`: the prediction that the next runs should narrow, as it was written
    #[must_use]
    pub fn results<'a>(&'a self, target: &'a str) -> WheelResults<'a> {
        let searches = &self.solved.solution.fit.searches;
        WheelResults {
            rows: &self.solved.records,
            discrepancies: &self.solved.discrepancies,
            correlation_lengths: &self.solved.correlation_lengths,
            unidentifiable: &self.solved.unidentifiable,
            target,
            proposals: &self.proposals,
            overall: GroupRecord::from(&self.validation.overall),
            driven: self.validation.driven.as_ref().map(GroupRecord::from),
            cross_validation: &self.left_out,
            cross_validation_overall: &self.left_out_overall,
            searches_that_agree: searches.iter().filter(|search| search.agrees).count(),
            searches: searches.len(),
            sampler: &self.solved.sampler,
            notes: self.notes(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::measurements::{Choice, Limits, read_from};
    use super::data_notes;

    fn notes(rows: &[&str], keys: usize) -> Vec<String> {
        let text =
            ["load_n,slip_ratio,slip_angle_deg,drawbar_pull_n", &rows.join("\n"), ""].join("\n");
        let choice = Choice { conditions: Vec::new(), wheel: None, limits: Limits::default() };
        let measured = read_from("rows.csv", text.as_bytes(), &choice).expect("wheel tests");
        data_notes(&measured.tests, keys)
    }

    #[test]
    fn data_say_what_they_cannot_show() {
        let few = notes(&["10,0.1,0,1", "10,0.3,0,2"], 1);
        let words = ["2 cells are few for 1 fitted key:", "no trial is repeated", "one load, 10.0"];
        assert_eq!(few.len(), words.len(), "{few:?}");
        for (note, words) in few.iter().zip(words) {
            assert!(note.contains(words), "{note}");
        }
        let rows = ["10,0.1,0,1", "10,0.1,0,1.1", "20,0.3,0,2", "10,0.5,0,3"];
        assert_eq!(notes(&rows, 1), Vec::<String>::new());
    }
}
