//! `map-place`: what a map has at one of its places, and why.

use grouser::answers::{Answer, AnswerOptions, Displayed, Member, Sampling};
use grouser::document::columns::map::CLASS;
use grouser::document::columns::verdict::ADVICE;
use grouser::document::table::Table;
use grouser::studies::mobility::class_of;
use grouser::units::Vec2;
use serde_json::json;

use super::command::CommandLine;
use super::fields::AskedFields;
use super::ground::shown;
use super::map::{self, MapAsked, MapFields, SAMPLES};
use super::staged::{Staged, Stages};
use crate::asked::Question;
use crate::console::Console;
use crate::refusal::Refusal;

/// What is asked of a place.
struct PlaceAsked {
    map: MapAsked,
    /// [m]
    at: Vec2,
}

pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let of_map = MapFields::of(&fields)?;
    let stages = Stages::of(&fields, Some(SAMPLES))?.of_samples()?;
    let at = fields.place(AT)?;
    fields.finish()?;
    let [x, y] = at.ok_or_else(|| Refusal::of_key(AT, "it must be x and y in metres"))?;
    let line = of_map.line("map");
    Ok(stages.question(PlaceAsked { map: of_map.open(console)?, at: Vec2::new(x, y) }, line))
}

/// The key of the place.
const AT: &str = "at_m";

impl Staged for PlaceAsked {
    fn sample(&mut self, sampling: Option<Sampling>) {
        self.map.sample(sampling);
    }

    fn answer(&self, options: &AnswerOptions<'_>) -> Result<Answer, Refusal> {
        let mapped = self.map.mapped(options)?;
        let raster = &mapped.raster;
        let Some([column, row]) = raster.cell_of(self.at) else {
            let refusal = Refusal::of_key(AT, "this place is not on the map");
            return Err(refusal.with_hint(format!("it is {}", raster.spans())));
        };
        let question = self.map.question(raster);
        let cell = question.ground.at(&mapped.map, column, row);
        let mut answer = Answer::new("map-place", "A place of a map");
        answer.input("dem", shown(question.dem));
        answer.input(AT, [self.at.x, self.at.y]);
        let point = raster.grid.point(column, row);
        answer.results = vec![
            Member::Value("x_m", json!(point.x)),
            Member::Value("y_m", json!(point.y)),
            Member::Value("z_m", json!(raster.height(column, row))),
        ];
        let Some(cell) = cell else {
            let words = "No height is known here, or none around it.";
            answer.screen = vec![Displayed::Words(words.to_owned())];
            return Ok(answer);
        };
        answer.results.push(Member::Row(None, Table::of(&question.bands(), &[cell])));
        if let Some(advice) = mapped.map.advice().get(class_of(cell.slope)) {
            let table =
                Table::of(&CLASS, std::slice::from_ref(advice)).and(&ADVICE, &[Some(advice)]);
            answer.results.push(Member::Row(Some("advice"), table));
            answer.screen = vec![Displayed::Words(advice.judgement.sentence())];
        }
        Ok(answer)
    }

    fn whose(&self) -> String {
        self.map.whose()
    }

    fn add_samples(&self, line: &mut CommandLine, sampling: Option<Sampling>) {
        map::add_samples(line, sampling);
    }
}
