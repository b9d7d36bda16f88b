//! Which heading holds the contour on a slope, and on which slope none does.

mod bands;
mod figures;
mod of_model;

use std::sync::Arc;

use self::of_model::OfModel;
use super::{Answer, AnswerError, Block, Extent, Part, Sampling, Shown, meanings, samples};
use crate::contact::validity::Finding;
use crate::document::LoadedScenario;
use crate::document::columns::heading::{self, held, steered};
use crate::document::columns::{MODEL, SLOPE, wheel_speeds};
use crate::document::figure::by_unit;
use crate::document::reading::sentence;
use crate::document::table::Table;
use crate::studies::ensemble::samples::BandInputs;
use crate::studies::heading::Steering;

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
    /// The samples of its bands, if it has any.
    pub sampling: Option<Sampling>,
}

impl HeadingQuestion {
    /// The answer.
    ///
    /// # Errors
    /// [`AnswerError`]: a soil, a wheel or a ratio that is not valid, a soil whose uncertainty
    /// reaches too far, a flag where none is accepted, or a stop on the way.
    pub fn answer(&self, name: &str, extent: &Extent<'_>) -> Result<Answer, AnswerError> {
        let each = |scenario| OfModel::of(self, scenario, extent);
        let all: Vec<OfModel> = self.scenarios.iter().map(each).collect::<Result<_, _>>()?;
        let (mut rows, mut limits) = (Table::default(), Table::default());
        for of_model in &all {
            rows.append(self.named(of_model, &of_model.table));
            let limit = of_model.own_speeds.as_ref().unwrap_or(&of_model.limit);
            limits.append(self.named(of_model, limit));
        }
        let (rows, columns) = (Arc::new(rows), self.brief(&all[0]));

        let mut answer = Answer::new(name, "Heading offset that holds the contour");
        self.state(&mut answer);
        let is_one = !self.has_several() && self.most_speed_ratio.is_none();
        let limits = if is_one { Part::Row(None, limits) } else { Part::rows("limits", limits) };
        answer.results = vec![limits, Part::rows("rows", Arc::clone(&rows))];
        answer.tables.push((name.to_owned(), Arc::clone(&rows)));
        let lines: String = all.iter().map(|it| it.lines(self.has_several())).collect();
        let words = lines + &self.model_lines();
        answer.screen = vec![Shown::Rows(Arc::clone(&rows), columns.clone()), Shown::Words(words)];
        for (place, of_model) in all.iter().enumerate() {
            answer.attach(self.file(place), of_model.scenario);
        }
        if extent.has_page {
            self.page(&mut answer, &all, rows, columns);
        }
        Ok(answer)
    }

    /// Whether there is an answer for each of several models.
    fn has_several(&self) -> bool {
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
    fn end(&self, scenario: &LoadedScenario) -> String {
        let name = scenario.value.model.name();
        if self.has_several() { format!("-{name}") } else { String::new() }
    }

    /// A table of a model's results, with its name where there are several.
    fn named(&self, of_model: &OfModel<'_>, table: &Table) -> Table {
        let table = table.clone();
        if self.has_several() { table.with_word(MODEL, of_model.name()) } else { table }
    }

    /// The columns for reading.
    fn brief(&self, first: &OfModel<'_>) -> Vec<String> {
        let mut names = match first {
            OfModel { bands: Some(_), .. } => heading::bands_brief(),
            OfModel { own_speeds: Some(_), .. } => wheel_speeds::brief(&first.scenario.value.rover),
            _ => heading::brief(self.steering),
        };
        if self.has_several() {
            names.insert(0, MODEL.to_owned());
        }
        names
    }

    /// The inputs of the answer.
    fn state(&self, answer: &mut Answer) {
        let first = &self.scenarios[0];
        let model = if self.has_several() { "all" } else { first.value.model.name() };
        let of_document = |key: &str| first.document.get(key).cloned().unwrap_or_default();
        for key in ["rover", "soil", "gravity_m_s2"] {
            answer.input(key, of_document(key));
        }
        answer.input("model", model);
        for key in ["load_transfer", "wheel_moments"] {
            answer.input(key, of_document(key));
        }
        answer.input("slope_deg", self.slopes_deg.clone());
        if self.steering != Steering::None {
            answer.input("steering", self.steering.name());
        }
        if let Some(ratio) = self.most_speed_ratio {
            answer.input("most_speed_ratio", ratio);
        }
        if let Some(sampling) = self.sampling {
            sampling.state(answer);
            let weights = || samples::weights(&BandInputs::of_scenario(first));
            answer.model_weights = (!self.has_several()).then(weights);
        }
    }

    /// Which model the rows have, where nobody names one, and which ones their bands.
    fn model_lines(&self) -> String {
        let first = &self.scenarios[0];
        let is_spread = self.sampling.is_some() && !self.has_several();
        let weights = || samples::line(&BandInputs::of_scenario(first));
        first.document.usual_model_line("soil") + &is_spread.then(weights).unwrap_or_default()
    }

    fn page(
        &self,
        answer: &mut Answer,
        all: &[OfModel<'_>],
        rows: Arc<Table>,
        columns: Vec<String>,
    ) {
        for of_model in all {
            let lines = of_model.lines(self.has_several());
            let verdict: Vec<String> = lines.lines().map(sentence).collect();
            answer.page.push(Block::Verdict(verdict.join(" ")));
        }
        let document = &all[0].scenario.document;
        let name = |key: &str| document.text(key).unwrap_or("unnamed").to_owned();
        answer.page.push(Block::List(vec![
            format!("rover: {}", name("rover.name")),
            format!("soil: {}", name("soil.name")),
        ]));
        self.figures(answer, all);
        answer.page.push(Block::Rows { caption: "On each slope", table: rows, columns });
        answer.heading("Everything over the slope");
        answer.page.push(Block::Charts(match all {
            [one] => by_unit(&one.dense(), SLOPE, &held()),
            several => figures::of_models(several),
        }));
        let slopes = self.slopes();
        let findings = all.iter().flat_map(|it| heading::findings(&it.curve, &slopes));
        answer.findings = findings.flatten().collect::<Vec<Finding>>();
        answer.columns = meanings(&held());
        if self.steering == Steering::Crab {
            answer.columns.splice(0..0, meanings(&steered()));
        }
    }

    /// Slopes [rad].
    fn slopes(&self) -> Vec<f64> {
        self.slopes_deg.iter().map(|slope| SLOPE.unit.to_si(*slope)).collect()
    }
}
