//! `heading`: the heading offset that holds the contour, with its verdict.

use grouser::answers::heading::HeadingQuestion;
use grouser::answers::{Answer, AnswerOptions, Sampling};
use grouser::document::gradient::GradientKeys;
use grouser::document::{self, Kind};
use grouser::studies::heading::Steering;
use grouser_draw::title_of;

use super::command::CommandLine;
use super::fields::AskedFields;
use super::parts::ScenarioParts;
use super::rule;
use super::staged::{Staged, Stages, refused};
use crate::asked::Question;
use crate::console::Console;
use crate::refusal::Refusal;

/// The samples of a first answer, as the program has them.
const DRAFT: u32 = 40;
/// The slopes where nothing is said of them, as the program has them [°].
const SLOPES: [f64; 4] = [5.0, 10.0, 15.0, 20.0];

pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let range = document::range(Kind::Scenario, "slope_deg").unwrap_or(0.0..=60.0);
    let slopes_deg = fields.numbers("slope_deg", &range, &SLOPES)?;
    let parts = ScenarioParts::of(&fields)?;
    let stages = Stages::of(&fields, Some(DRAFT))?;
    let steering = steering(&fields)?;
    let gradients = fields.texts("gradients")?;
    let is_nominal = !stages.has_samples();
    let rule = rule::of(&fields)?;
    fields.finish()?;
    // What is no heading of the body has no samples, and derivatives are of the soil as written.
    let is_plain = steering == Steering::None && gradients.is_empty();
    let stages = if is_plain { stages } else { stages.without_samples() };
    let every = parts.common().has_every_model();
    let stages = stages.of_rows(("slope_deg", slopes_deg.len()), every, gradients.len())?;
    let scenarios = parts.scenarios(&console.folder, stages.has_samples())?;
    let is_believed = scenarios.iter().any(|it| it.soils_of_bands().is_some());
    if !gradients.is_empty() && !is_nominal && is_believed {
        let message = "derivatives are of the soil as its document has it, with one model, and \
                       this soil is uncertain";
        return Err(
            Refusal::of_key("gradients", message).with_hint("`nominal` asks for that answer")
        );
    }
    let mut line = CommandLine::new("heading");
    parts.add_words(&mut line);
    line.numbers("slope-deg", &slopes_deg);
    if steering != Steering::None {
        line.option("steering", steering.name());
    }
    if !gradients.is_empty() {
        line.option("gradients", &gradients.join(","));
    }
    rule::add_words(&rule, &mut line);
    let question = HeadingQuestion {
        scenarios,
        slopes_deg,
        steering,
        most_speed_ratio: None,
        sampling: None,
        rule,
        gradients: (!gradients.is_empty()).then(|| GradientKeys::of(&gradients)),
    };
    Ok(stages.question(question, line))
}

fn steering(fields: &AskedFields) -> Result<Steering, Refusal> {
    let Some(word) = fields.text("steering")? else { return Ok(Steering::None) };
    Steering::ALL.into_iter().find(|it| it.name() == word).ok_or_else(|| {
        let words = Steering::ALL.map(Steering::name).join(", ");
        Refusal::of_key("steering", "there is no such steering").with_hint(format!("it is {words}"))
    })
}

impl Staged for HeadingQuestion {
    fn sample(&mut self, sampling: Option<Sampling>) {
        self.sampling = sampling;
    }

    fn answer(&self, options: &AnswerOptions<'_>) -> Result<Answer, Refusal> {
        self.answer("heading", options).map_err(refused)
    }

    fn whose(&self) -> String {
        title_of(&self.scenarios[0])
    }

    fn add_samples(&self, line: &mut CommandLine, sampling: Option<Sampling>) {
        match sampling {
            Some(Sampling { count, seed }) => {
                line.option("samples", &count.to_string());
                line.option("seed", &seed.to_string());
            }
            None if self.steering == Steering::None => line.flag("nominal"),
            None => {}
        }
    }
}
