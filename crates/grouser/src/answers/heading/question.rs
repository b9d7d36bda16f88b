//! The question of headings.

use super::super::{AnswerError, Sampling};
use crate::document::LoadedScenario;
use crate::document::columns::SLOPE;
use crate::document::gradient::GradientKeys;
use crate::studies::heading::Steering;
use crate::studies::verdict::{Rule, SlopeStudy};

/// The question.
#[derive(Clone, Debug)]
pub struct HeadingQuestion {
    /// The scenarios whose rover, soil, gravity and load transfer count: one, or one for each of
    /// several models.
    pub scenarios: Vec<LoadedScenario>,
    /// Slopes [°], as they were given.
    pub slopes_deg: Vec<f64>,
    /// What holds the contour.
    pub steering: Steering,
    /// The fastest wheel's speed over the mean of all at the most [-], where wheels may turn at
    /// speeds of their own.
    pub most_speed_ratio: Option<f64>,
    /// The samples of soil and model that it is answered by; without them by the soil as its document
    /// has it, and one model.
    pub sampling: Option<Sampling>,
    /// The limits of the verdicts.
    pub rule: Rule,
    /// The numbers that its results are differentiated by, if any.
    pub gradients: Option<GradientKeys>,
}

impl HeadingQuestion {
    /// How often [`AnswerOptions::go_on`] is asked.
    ///
    /// [`AnswerOptions::go_on`]: super::super::AnswerOptions::go_on
    #[must_use]
    pub fn samples(&self) -> usize {
        let derivatives = self.gradients.as_ref().map_or(0, |_| self.slopes_deg.len());
        let each = self.sampling.map_or(derivatives, |it| it.count as usize);
        each * self.scenarios.len()
    }

    /// Checks that there is something to answer, and that its parts have an answer together.
    pub(super) fn check(&self) -> Result<(), AnswerError> {
        if self.scenarios.is_empty() {
            return Err(AnswerError::Empty("scenarios"));
        }
        let choices = [
            ("steered wheels", self.steering != Steering::None),
            ("wheels at speeds of their own", self.most_speed_ratio.is_some()),
            ("samples", self.sampling.is_some()),
        ];
        AnswerError::check_together(&choices)?;
        let [_, own_speeds, samples] = choices;
        let derivatives = ("derivatives", self.gradients.is_some());
        AnswerError::check_together(&[own_speeds, samples, derivatives])
    }

    /// Whether there is an answer for each of several models.
    pub(super) fn has_several(&self) -> bool {
        self.scenarios.len() > 1
    }

    /// The name of a scenario's file.
    ///
    /// * `place`: among the scenarios
    #[must_use]
    pub fn file(&self, place: usize) -> String {
        format!("scenario{}.toml", self.end(&self.scenarios[place]))
    }

    /// The end of a scenario's files' names: nothing if it is alone.
    pub(super) fn end(&self, scenario: &LoadedScenario) -> String {
        let name = scenario.value.model.name();
        if self.has_several() { format!("-{name}") } else { String::new() }
    }

    /// What advice is about.
    pub(super) fn study(&self, scenario: &LoadedScenario) -> SlopeStudy {
        SlopeStudy { rule: self.rule, ..SlopeStudy::of(scenario) }
    }

    /// Slopes [rad].
    pub(super) fn slopes(&self) -> Vec<f64> {
        SLOPE.in_si(&self.slopes_deg)
    }
}
