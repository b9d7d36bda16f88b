//! Which heading holds the contour on a slope, and on which slope none does.

mod bands;
mod figures;
mod of_model;
mod question;

use std::sync::Arc;

use serde_json::{Value, json};

use self::of_model::OfModel;
pub use self::question::HeadingQuestion;
use super::{
    Answer, AnswerError, AnswerOptions, Displayed, EVERY_MODEL, Member, gradient, meanings,
    samples, setting,
};
use crate::contact::validity::Finding;
use crate::document::columns::heading::{self, held, steered};
use crate::document::columns::verdict::{self, ADVICE_OBJECT};
use crate::document::columns::{ENERGY_PER_METRE, MODEL, SLIP_RATIO, SLOPE, wheel_speeds};
use crate::document::figure::by_unit;
use crate::document::gradient::HeadingKeys;
use crate::document::reading::sentence;
use crate::document::table::Table;
use crate::studies::ensemble::samples::BandInputs;
use crate::studies::heading::Steering;

impl HeadingQuestion {
    /// The answer.
    ///
    /// # Errors
    /// [`AnswerError`]: a soil, a wheel or a ratio that is not valid, a soil whose uncertainty
    /// reaches too far, a flag where none is accepted, or a stop on the way.
    pub fn answer(&self, name: &str, options: &AnswerOptions<'_>) -> Result<Answer, AnswerError> {
        self.check()?;
        let each = |scenario| OfModel::of(self, scenario, options);
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
        let limits =
            if is_one { Member::Row(None, limits) } else { Member::rows("limits", limits) };
        let advice = all.iter().filter_map(|it| it.bands.as_ref()).flat_map(|it| it.advice.clone());
        let advice = verdict::advice(&advice.collect::<Vec<_>>());
        answer.results = vec![
            limits,
            match self.sampling {
                Some(_) => Member::With("rows", Arc::clone(&rows), ADVICE_OBJECT, advice),
                None => Member::rows("rows", Arc::clone(&rows)),
            },
        ];
        answer.tables.push((name.to_owned(), Arc::clone(&rows)));
        let lines: String = all.iter().map(|it| it.lines(self.has_several())).collect();
        let derivatives: String = all.iter().map(OfModel::gradient_lines).collect();
        answer.results.extend(gradient::notes(&derivatives));
        let words = lines + &self.model_lines() + &derivatives;
        answer.screen =
            vec![Displayed::Rows(Arc::clone(&rows), columns.clone()), Displayed::Words(words)];
        for (place, of_model) in all.iter().enumerate() {
            answer.attach(self.file(place), of_model.scenario);
        }
        if options.has_page {
            self.page(&mut answer, &all, &rows, columns);
            let names: Vec<&str> = all[0].keys.iter().flat_map(HeadingKeys::names).collect();
            let results =
                [heading::turned(self.steering).name, SLIP_RATIO.name, ENERGY_PER_METRE.name];
            gradient::page(&mut answer, &rows, [&[SLOPE.name], &results, &names], &derivatives);
        }
        Ok(answer)
    }

    /// A table of a model's results, with its name where there are several.
    fn named(&self, of_model: &OfModel<'_>, table: &Table) -> Table {
        let table = table.clone();
        if self.has_several() { table.with_word(MODEL, of_model.name()) } else { table }
    }

    /// The columns for reading.
    fn brief(&self, first: &OfModel<'_>) -> Vec<String> {
        let mut names = match first {
            OfModel { bands: Some(_), .. } => heading::advised_brief(),
            OfModel { own_speeds: Some(_), .. } => wheel_speeds::brief(&first.scenario.value.rover),
            _ => heading::brief(self.steering),
        };
        if let Some(keys) = &first.keys {
            let turned = heading::turned(self.steering).name;
            names.extend(gradient::brief(&[turned], &keys.names().collect::<Vec<_>>()));
        }
        if self.has_several() {
            names.insert(0, MODEL.to_owned());
        }
        names
    }

    /// The inputs of the answer.
    fn state(&self, answer: &mut Answer) {
        let first = &self.scenarios[0];
        let model = if self.has_several() { EVERY_MODEL } else { first.value.model.name() };
        answer.inputs_of(&first.document, ["rover", "soil", "gravity_m_s2"]);
        answer.input("model", model);
        answer.inputs_of(&first.document, ["load_transfer", "wheel_moments"]);
        answer.input("slope_deg", self.slopes_deg.clone());
        if self.steering != Steering::None {
            answer.input("steering", self.steering.name());
        }
        if let Some(keys) = &self.gradients {
            answer.input("gradients", json!(keys.names()));
        }
        if let Some(ratio) = self.most_speed_ratio {
            answer.input("most_speed_ratio", ratio);
        }
        if let Some(sampling) = self.sampling {
            if let Value::Object(rule) = json!(self.rule) {
                answer.inputs.extend(rule);
            }
            sampling.state(answer);
            let belief = |scenario| sampling.belief(scenario);
            answer.belief = Some(samples::one_or_each(self.scenarios.iter().map(belief).collect()));
        }
    }

    /// Which ground and model the rows have, where nobody asks for these, and which models their
    /// bands.
    fn model_lines(&self) -> String {
        let first = &self.scenarios[0];
        let is_spread = self.sampling.is_some() && !self.has_several();
        let weights = || samples::line(&BandInputs::of_scenario(first));
        first.document.plane_line()
            + &first.document.usual_model_line("soil")
            + &is_spread.then(weights).unwrap_or_default()
    }

    fn page(
        &self,
        answer: &mut Answer,
        all: &[OfModel<'_>],
        rows: &Arc<Table>,
        columns: Vec<String>,
    ) {
        if let [OfModel { bands: Some(bands), .. }] = all
            && bands.advice.len() > 1
        {
            answer.verdict(sentence(&verdict::in_words(&bands.advice)));
        }
        for line in all.iter().flat_map(|it| {
            let lines = it.lines(self.has_several());
            lines.lines().map(sentence).collect::<Vec<_>>()
        }) {
            answer.verdict(line);
        }
        answer.list(setting(&all[0].scenario.document));
        self.figures(answer, all);
        answer.rows("On each slope", rows, columns);
        answer.folded("Everything over the slope", |answer| {
            answer.charts(match all {
                [one] => by_unit(&one.dense(), SLOPE, &held()),
                several => figures::of_models(several),
            });
        });
        let slopes = self.slopes();
        let findings = all.iter().flat_map(|it| heading::findings(&it.curve, &slopes));
        answer.findings = Some(findings.flatten().collect::<Vec<Finding>>());
        answer.columns = meanings(&held());
        if self.sampling.is_some() {
            answer.columns.splice(0..0, meanings(&verdict::ADVICE));
        }
        if self.steering == Steering::Crab {
            answer.columns.splice(0..0, meanings(&steered()));
        }
    }
}
