//! `heading-map`: the heading offset over slope and course, with slip, sinkage and power.

use grouser::answers::heading_map::HeadingMapQuestion;
use grouser::answers::{Answer, AnswerOptions, Sampling};
use grouser::document::study::{COURSE_DEG, MAP_SPEED_M_S};
use grouser::document::{self, Kind};
use grouser_draw::title_of;

use super::command::CommandLine;
use super::fields::AskedFields;
use super::parts::ScenarioParts;
use super::staged::{Staged, Stages, refused};
use crate::asked::Question;
use crate::console::Console;
use crate::refusal::Refusal;

/// The slopes and courses where nothing is said of them, as the program has them [°].
const SLOPES: [f64; 13] = [0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0, 22.0, 24.0];
const COURSES: [f64; 9] = [-60.0, -45.0, -30.0, -15.0, 0.0, 15.0, 30.0, 45.0, 60.0];

/// The rim speed, likewise [m/s].
const RIM_SPEED: f64 = 0.06;

pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let range = document::range(Kind::Scenario, "slope_deg").unwrap_or(0.0..=60.0);
    let slopes_deg = fields.numbers("slope_deg", &range, &SLOPES)?;
    let courses_deg = fields.numbers("course_deg", &COURSE_DEG, &COURSES)?;
    let rim_speed = fields.number("rim_speed_m_s", &MAP_SPEED_M_S)?.unwrap_or(RIM_SPEED);
    let parts = ScenarioParts::of(&fields)?;
    let stages = Stages::of(&fields, None)?;
    fields.finish()?;
    let rows = slopes_deg.len() * courses_deg.len();
    let stages = stages.of_rows(("slope_deg", rows), parts.common().has_every_model(), 0)?;
    let scenarios = parts.scenarios(&console.folder, stages.has_samples())?;
    let mut line = CommandLine::new("heading-map");
    parts.add_words(&mut line);
    line.numbers("slope-deg", &slopes_deg);
    line.numbers("course-deg", &courses_deg);
    line.option("rim-speed-m-s", &rim_speed.to_string());
    let has_every_model = parts.common().has_every_model();
    let question = HeadingMapQuestion {
        scenarios,
        has_every_model,
        slopes_deg,
        courses_deg,
        rim_speed,
        sampling: None,
        gradients: None,
    };
    Ok(stages.question(question, line))
}

impl Staged for HeadingMapQuestion {
    fn sample(&mut self, sampling: Option<Sampling>) {
        self.sampling = sampling;
    }

    fn answer(&self, options: &AnswerOptions<'_>) -> Result<Answer, Refusal> {
        self.answer("heading-map", options).map_err(refused)
    }

    fn whose(&self) -> String {
        title_of(&self.scenarios[0])
    }

    fn add_samples(&self, line: &mut CommandLine, sampling: Option<Sampling>) {
        super::wheel_test::add_uncertainty(line, sampling);
    }
}
