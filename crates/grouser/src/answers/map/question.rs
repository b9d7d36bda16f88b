//! What is asked of a map.

use std::path::Path;

use serde_json::{Value, json};

use super::super::{Answer, Sampling, findings_up_to};
use super::files::{MadeMap, MapFile};
use crate::contact::validity::Finding;
use crate::document::LoadedScenario;
use crate::document::columns::map::{bands, chosen};
use crate::document::columns::{COURSE, Column, SLOPE};
use crate::studies::mobility::{CellMotion, CourseChoice, Ground, MobilityTable};
use crate::studies::verdict::SlopeStudy;

/// The question.
#[derive(Clone, Copy, Debug)]
pub struct MapQuestion<'q> {
    /// The file of the heights.
    pub dem: &'q Path,
    /// The heights, under the scenario's rover.
    pub ground: Ground<'q>,
    /// The scenario of rover, soil, gravity, load transfer and model.
    pub scenario: &'q LoadedScenario,
    /// Its study.
    pub study: &'q SlopeStudy,
    /// The course.
    pub course: CourseChoice,
    /// The same as it was given: a number of degrees, or a word.
    pub given_course: &'q str,
    /// The samples of soil and model.
    pub sampling: Sampling,
}

impl MapQuestion<'_> {
    /// The bands of the map: the course as well, where it is chosen.
    #[must_use]
    pub fn bands(&self) -> Vec<Column<CellMotion>> {
        let mut all: Vec<Column<CellMotion>> = bands().into();
        if !matches!(self.course, CourseChoice::Fixed(_)) {
            all.extend(chosen());
        }
        all
    }

    /// All that the map depends on but its heights: by it a map that was stopped is known again.
    #[must_use]
    pub fn identity(&self) -> Value {
        let mut answer = Answer::default();
        self.state(&mut answer);
        let mut identity = answer.inputs;
        identity.insert("belief".to_owned(), json!(answer.belief));
        Value::Object(identity)
    }

    /// The flags of the soil as written: on the map's courses, and each degree of its slopes.
    pub(super) fn findings(&self, made: &MadeMap<'_>) -> Option<Vec<Finding>> {
        // A map without a known slope has no number.
        let is_slope = |file: &&MapFile| file.name == SLOPE.name && file.most.is_finite();
        let slopes = made.files.iter().find(is_slope);
        let steepest = slopes.map_or(0.0, |file| SLOPE.unit.to_si(file.most));
        let courses = made.map.tables().iter().map(MobilityTable::course);
        findings_up_to(&self.study.heading, courses, steepest)
    }

    /// The inputs of the answer.
    pub(super) fn state(&self, answer: &mut Answer) {
        let document = &self.scenario.document;
        answer.input("dem", self.dem.display().to_string());
        answer.inputs_of(document, ["rover", "soil"]);
        answer.input("model", self.scenario.value.model.name());
        let keys = ["gravity_m_s2", "load_transfer", "wheel_moments", "slope_stability"];
        answer.inputs_of(document, keys);
        answer.input(COURSE.name, self.given_course);
        answer.input("rim_speed_m_s", self.study.rim_speed);
        if let Value::Object(rule) = json!(self.study.rule) {
            answer.inputs.extend(rule);
        }
        self.sampling.state(answer);
        answer.belief = Some(self.sampling.belief(self.scenario));
    }
}
