//! `wheel-test`: forces and sinkage of one wheel on a test stand.

use grouser::answers::wheel_test::WheelTestQuestion;
use grouser::answers::{Answer, AnswerOptions, Sampling};
use grouser::document::gradient::GradientKeys;
use grouser::document::study::{LOAD_N, SLIP_ANGLE_DEG, SLIP_RATIO};
use grouser::studies::ensemble::samples::BandInputs;
use http::StatusCode;

use super::command::CommandLine;
use super::fields::AskedFields;
use super::parts::{Stand, StandParts};
use super::staged::{Staged, Stages, refused};
use crate::asked::Question;
use crate::console::Console;
use crate::refusal::Refusal;

/// What is asked where nothing is said of it, as the program has it.
const LOADS: [f64; 1] = [17.0];
const SLIPS: [f64; 10] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9];
const ANGLES: [f64; 1] = [0.0];

pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let loads = fields.numbers("load_n", &LOAD_N, &LOADS)?;
    let slip_ratios = fields.numbers("slip_ratio", &SLIP_RATIO, &SLIPS)?;
    let slip_angles_deg = fields.numbers("slip_angle_deg", &SLIP_ANGLE_DEG, &ANGLES)?;
    let parts = StandParts::of(&fields, &console.folder)?;
    let stages = Stages::of(&fields, None)?;
    let gradients = fields.texts("gradients")?;
    fields.finish()?;
    let rows = loads.len() * slip_ratios.len() * slip_angles_deg.len();
    let every = parts.common().has_every_model();
    let stages = stages.of_rows(("load_n", rows), every, gradients.len())?;
    let stands = parts.stands(&console.folder, stages.has_samples())?;
    let mut line = CommandLine::new("wheel-test");
    parts.add_words(&mut line);
    line.numbers("load-n", &loads);
    line.numbers("slip-ratio", &slip_ratios);
    line.numbers("slip-angle-deg", &slip_angles_deg);
    if !gradients.is_empty() {
        line.option("gradients", &gradients.join(","));
    }
    let of_model = |stand: &Stand| {
        (stand.model(), BandInputs::of_soil(&stand.soil, stand.asked_model.clone()))
    };
    let models = stands.iter().map(of_model).collect();
    // Stands differ by their models alone.
    let Some(Stand { soil, wheel, gravity, .. }) = stands.into_iter().next() else {
        return Err(Refusal::new(StatusCode::INTERNAL_SERVER_ERROR, "there is no model"));
    };
    let question = WheelTestQuestion {
        soil,
        wheel,
        gravity,
        models,
        is_model_named: parts.common().names_model(),
        loads,
        slip_angles_deg,
        slip_ratios,
        stand: None,
        sampling: None,
        gradients: (!gradients.is_empty()).then(|| GradientKeys::of(&gradients)),
    };
    Ok(stages.question(question, line))
}

impl Staged for WheelTestQuestion {
    fn sample(&mut self, sampling: Option<Sampling>) {
        self.sampling = sampling;
    }

    fn answer(&self, options: &AnswerOptions<'_>) -> Result<Answer, Refusal> {
        self.answer("wheel-test", options).map_err(refused)
    }

    fn whose(&self) -> String {
        format!("{} on {}", self.wheel.document.name(), self.soil.document.name())
    }

    fn add_samples(&self, line: &mut CommandLine, sampling: Option<Sampling>) {
        add_uncertainty(line, sampling);
    }
}

/// The words for samples, where there are none without them.
pub(super) fn add_uncertainty(line: &mut CommandLine, sampling: Option<Sampling>) {
    if let Some(Sampling { count, seed }) = sampling {
        line.flag("uncertainty");
        line.option("samples", &count.to_string());
        line.option("seed", &seed.to_string());
    }
}
