//! Which heading holds a course on a slope, over slope, course and soil.

use std::sync::Arc;

use rayon::prelude::*;
use serde_json::{Value, json};

use super::{
    Answer, AnswerError, AnswerOptions, CrossTable, Displayed, Member, Sampling, gradient,
    meanings, samples,
};
use crate::document::columns::gradient::RowDerivatives;
use crate::document::columns::heading::{self, held};
use crate::document::columns::{self, COURSE, MODEL, SLIP_RATIO, SLOPE, YAW};
use crate::document::figure::HeatMap;
use crate::document::gradient::{GradientKeys, HeadingKeys};
use crate::document::table::{Table, Values};
use crate::document::{LoadedScenario, escape};
use crate::studies::ensemble::models::Question;
use crate::studies::ensemble::samples::BandInputs;
use crate::studies::heading::{HeadingOffset, HeadingStudy, Steering};
use crate::studies::heading_map::{HeadingMap, HeadingRow};

/// The question.
#[derive(Clone, Debug)]
pub struct HeadingMapQuestion {
    /// The scenarios whose rover, soil, gravity and load transfer count, one for each soil; with
    /// every model all soils of the first model, then those of the next.
    pub scenarios: Vec<LoadedScenario>,
    /// Whether every model is asked for: rows have its name.
    pub has_every_model: bool,
    /// Slopes [°], as they were given.
    pub slopes_deg: Vec<f64>,
    /// Courses from the contour [°], positive uphill, as they were given.
    pub courses_deg: Vec<f64>,
    /// Rim speed, for the power [m/s].
    pub rim_speed: f64,
    /// The samples of its bands, if it has any.
    pub sampling: Option<Sampling>,
    /// The numbers that its results are differentiated by, if any.
    pub gradients: Option<GradientKeys>,
}

impl HeadingMapQuestion {
    /// How often [`AnswerOptions::go_on`] is asked.
    #[must_use]
    pub fn samples(&self) -> usize {
        let each = self.scenarios.len() * self.courses_deg.len();
        let derivatives = self.gradients.as_ref().map_or(0, |_| each);
        self.sampling.map_or(derivatives, |it| it.count as usize * each)
    }

    /// The answer.
    ///
    /// # Errors
    /// [`AnswerError`]: a soil or a course that is not valid, a soil whose uncertainty reaches too
    /// far, a flag where none is accepted, or a stop on the way.
    pub fn answer(&self, name: &str, options: &AnswerOptions<'_>) -> Result<Answer, AnswerError> {
        for (what, count) in [
            ("scenarios", self.scenarios.len()),
            ("slopes", self.slopes_deg.len()),
            ("courses", self.courses_deg.len()),
        ] {
            if count == 0 {
                return Err(AnswerError::Empty(what));
            }
        }
        AnswerError::check_together(&[
            ("samples", self.sampling.is_some()),
            ("derivatives", self.gradients.is_some()),
        ])?;
        let studies: Vec<HeadingStudy> =
            self.scenarios.iter().map(|scenario| HeadingStudy::of(&scenario.value)).collect();
        let courses = COURSE.in_si(&self.courses_deg);
        let map = HeadingMap::of(&studies, &courses, &SLOPE.in_si(&self.slopes_deg))?;
        let table = Arc::new(self.table(&studies, &map, options)?);
        let flags = map.rows.iter().flat_map(|row| &row.findings);
        options.check(flags.map(|it| &**it), &table, &heading::SETTINGS)?;

        let mut answer = Answer::new(name, "Heading offset over slope and course");
        self.state(&mut answer);
        answer.results.push(Member::rows("rows", Arc::clone(&table)));
        answer.tables.push((name.to_owned(), Arc::clone(&table)));
        let keys = self.gradients.as_ref();
        let keys =
            keys.map(|it| HeadingKeys::of(&self.scenarios[0], Steering::None, it)).transpose()?;
        let (names, lacking) = keys.as_ref().map_or_else(Default::default, |it| {
            (it.names().collect::<Vec<_>>(), it.lacking().collect::<Vec<_>>())
        });
        let brief = gradient::brief(&[YAW.name], &names);
        let derivatives = gradient::lines(&table, &names, &lacking);
        answer.results.extend(gradient::notes(&derivatives));
        let crossed = Displayed::Crossed {
            table: Arc::clone(&table),
            columns: [self.brief(), brief].concat(),
            crossing: self.crossing(),
        };
        answer.screen = vec![crossed, Displayed::Words(self.model_lines() + &derivatives)];
        for (place, scenario) in self.scenarios.iter().enumerate() {
            answer.attach(self.file(place), scenario);
        }
        if options.has_page {
            self.page(&mut answer, &map, &table);
            let (settings, results) = ([COURSE.name, SLOPE.name], [YAW.name, SLIP_RATIO.name]);
            gradient::page(&mut answer, &table, [&settings, &results, &names], &derivatives);
        }
        Ok(answer)
    }

    /// The name of a scenario's file.
    ///
    /// * `place`: among the scenarios
    #[must_use]
    pub fn file(&self, place: usize) -> String {
        format!("scenario{}.toml", self.number(place))
    }

    /// The end of a scenario's files' names: nothing if it is alone.
    fn number(&self, place: usize) -> String {
        if self.scenarios.len() > 1 { format!("-{}", place + 1) } else { String::new() }
    }

    /// What the samples of a scenario are drawn from. Straight up or down a slope no model needs
    /// forces across the wheels.
    fn band_inputs(&self, scenario: &LoadedScenario) -> BandInputs {
        let courses = self.courses_deg.iter();
        let courses = courses.map(|course| Question::on_course(course.to_radians()));
        BandInputs::of_scenario(scenario).asked(Question::of_all(courses))
    }

    /// A row for each model that is asked for, soil, course and slope, with the bands that are
    /// asked for.
    fn table(
        &self,
        studies: &[HeadingStudy],
        map: &HeadingMap,
        options: &AnswerOptions<'_>,
    ) -> Result<Table, AnswerError> {
        let (names, rover) = (self.soils(), &self.scenarios[0].value.rover);
        let mut table = heading::map_table(map, &names, rover, self.rim_speed);
        if let Some(sampling) = self.sampling {
            let draw = |scenario| sampling.draw(&self.band_inputs(scenario));
            let samples = self.scenarios.iter().map(draw).collect::<Result<Vec<_>, _>>()?;
            let bands = map.bands(studies, &samples, options.go_on)?;
            table = heading::map_with_bands(table, &bands.ok_or(AnswerError::Stopped)?);
        }
        if let Some(asked_for) = &self.gradients {
            table = self.with_derivatives(table, studies, map, asked_for, options)?;
        }
        if self.has_every_model {
            let rows = self.scenarios.iter().flat_map(|scenario| {
                std::iter::repeat_n(scenario.value.model.name(), self.cells())
            });
            let words = rows.map(|name| Some(name.to_owned())).collect();
            table.columns.insert(0, (MODEL.to_owned(), Values::Text(words)));
        }
        Ok(table)
    }

    /// The rows with the derivatives of their results; the keys of all numbers are those of the
    /// first scenario.
    fn with_derivatives(
        &self,
        table: Table,
        studies: &[HeadingStudy],
        map: &HeadingMap,
        asked_for: &GradientKeys,
        options: &AnswerOptions<'_>,
    ) -> Result<Table, AnswerError> {
        let first = HeadingKeys::of(&self.scenarios[0], Steering::None, asked_for)?;
        let names = GradientKeys::These(first.names().map(str::to_owned).collect());
        let of_row = |row: &HeadingRow| -> Result<Vec<RowDerivatives>, AnswerError> {
            if !(options.go_on)() {
                return Err(AnswerError::Stopped);
            }
            let keys = HeadingKeys::of(&self.scenarios[row.study], Steering::None, &names)?;
            let curve = studies[row.study].curve_on(row.course)?;
            let limit = keys.of_limit(&curve);
            let slopes = map.slopes.iter();
            Ok(slopes.map(|slope| (keys.on_slope(&curve, *slope), limit.clone())).collect())
        };
        let rows: Vec<_> = map.rows.par_iter().map(of_row).collect::<Result<_, _>>()?;
        Ok(columns::gradient::of_heading_map(table, &first, &rows.concat()))
    }

    /// How many rows a scenario has.
    fn cells(&self) -> usize {
        self.courses_deg.len() * self.slopes_deg.len()
    }

    /// The names of the soils, one for each scenario.
    fn soils(&self) -> Vec<String> {
        let name = |it: &LoadedScenario| it.document.name_of("soil").into();
        self.scenarios.iter().map(name).collect()
    }

    /// What figures and tables of each scenario are of: the soil, and the model where there are
    /// several.
    fn titles(&self) -> Vec<String> {
        let title = |(scenario, soil): (&LoadedScenario, String)| {
            let model = scenario.value.model.name();
            if self.has_every_model { format!("{soil}, {model}") } else { soil }
        };
        self.scenarios.iter().zip(self.soils()).map(title).collect()
    }

    /// The columns for reading.
    fn brief(&self) -> Vec<String> {
        let has_bands = self.sampling.is_some();
        let mut names = if has_bands { heading::map_bands_brief() } else { heading::map_brief() };
        if self.has_every_model {
            names.insert(0, MODEL.to_owned());
        }
        names
    }

    /// How a terminal sets slopes against courses.
    fn crossing(&self) -> CrossTable {
        let mut cells = vec![YAW.name.to_owned(), SLIP_RATIO.name.to_owned()];
        if self.sampling.is_some() {
            let [_, _, high] = SLIP_RATIO.quantiles();
            cells.push(high);
        }
        CrossTable {
            titles: self.titles(),
            down: SLOPE.name,
            rows_down: self.slopes_deg.len(),
            across: COURSE.name,
            across_label: format!("{} (across, positive uphill)", COURSE.name),
            cells,
        }
    }

    /// Which ground the rows have, and which model those of a soil, where nobody names one; with
    /// the soil's name if there are several.
    fn model_lines(&self) -> String {
        let is_spread = self.sampling.is_some() && !self.has_every_model;
        let line = |(scenario, name): (&LoadedScenario, String)| {
            let weights = || samples::line(&self.band_inputs(scenario));
            let weights = is_spread.then(weights).unwrap_or_default();
            let line = scenario.document.usual_model_line("soil") + &weights;
            let is_named = self.scenarios.len() > 1 && !line.is_empty();
            if is_named { format!("{}: {line}", escape::line(&name)) } else { line }
        };
        let each: String = self.scenarios.iter().zip(self.soils()).map(line).collect();
        self.scenarios[0].document.plane_line() + &each
    }

    /// The inputs of the answer.
    fn state(&self, answer: &mut Answer) {
        let first = &self.scenarios[0].document;
        let each = |value: fn(&LoadedScenario) -> Value| {
            self.scenarios.iter().map(value).collect::<Value>()
        };
        answer.inputs_of(first, ["rover"]);
        answer.input("soils", each(|it| it.document.get("soil").cloned().unwrap_or_default()));
        answer.input("models", each(|it| it.value.model.name().into()));
        answer.inputs_of(first, ["gravity_m_s2", "load_transfer", "wheel_moments"]);
        answer.input(COURSE.name, self.courses_deg.clone());
        answer.input(SLOPE.name, self.slopes_deg.clone());
        answer.input("rim_speed_m_s", self.rim_speed);
        if let Some(keys) = &self.gradients {
            answer.input("gradients", json!(keys.names()));
        }
        if let Some(sampling) = self.sampling {
            sampling.state(answer);
            let weights = self.scenarios.iter().map(|it| samples::weights(&self.band_inputs(it)));
            answer.model_weights = Some(samples::one_or_each(weights.collect()));
        }
    }

    fn page(&self, answer: &mut Answer, map: &HeadingMap, table: &Arc<Table>) {
        answer.verdict(sentence(map));
        answer.words(
            "A course is the direction of travel, counted from the contour line: 0° is along it, \
             90° straight up, −90° straight down. The yaw beyond the course is how far the nose \
             must point uphill of the way that the rover shall take.",
        );
        for (place, name) in self.titles().iter().enumerate() {
            let number = self.number(place);
            for (file, figure) in self.figures(map, table, place, name) {
                let caption = "Grey: no heading holds the course.";
                answer.figure(Some(&format!("{file}{number}")), figure, caption);
            }
        }
        answer.heading("Every slope and course");
        answer.rows("Heading offsets", table, heading::map_brief());
        let findings = map.rows.iter().flat_map(|row| row.findings.concat());
        answer.findings = Some(findings.collect());
        answer.columns = meanings(&held());
    }

    /// Heat maps of the yaw beyond the course, of the slip, and of the upper end of the slip's band
    /// if there is one, each with the name of its file.
    ///
    /// * `study`: the place of the scenario
    fn figures(
        &self,
        map: &HeadingMap,
        table: &Table,
        study: usize,
        name: &str,
    ) -> Vec<(&'static str, HeatMap)> {
        let of_map = |value: fn(&HeadingOffset) -> f64| {
            let rows = map.rows.iter().filter(|row| row.study == study);
            let values = rows.map(|row| {
                row.cells.iter().map(|cell| cell.as_ref().ok().map(value)).collect::<Vec<_>>()
            });
            values.collect::<Vec<_>>()
        };
        let crab = of_map(|heading| YAW.unit.from_si(heading.yaw - heading.course));
        let slip = of_map(|heading| heading.slip_ratio);
        let [_, _, high] = SLIP_RATIO.quantiles();
        let rows = table.numbers(&high).chunks(self.slopes_deg.len());
        let rows = rows.skip(study * self.courses_deg.len()).take(self.courses_deg.len());
        let highest: Vec<Vec<Option<f64>>> = rows.map(<[_]>::to_vec).collect();
        let figures = [
            ("crab", "Yaw beyond the course [°]", crab),
            ("slip", "Slip ratio", slip),
            ("slip-p97_5", "Slip ratio that 97.5 % of the samples stay below", highest),
        ];
        let drawn = figures.into_iter().filter(|(_, _, values)| !values.is_empty());
        drawn.map(|(file, title, values)| (file, self.figure(title, name, values))).collect()
    }

    fn figure(&self, title: &str, name: &str, values: Vec<Vec<Option<f64>>>) -> HeatMap {
        HeatMap {
            title: format!("{title}, on {name}"),
            x_label: "slope [°]".into(),
            columns: self.slopes_deg.clone(),
            y_label: "course, positive uphill [°]".into(),
            rows: self.courses_deg.clone(),
            values,
        }
    }
}

/// How many of the pairs of slope and course can be held.
fn sentence(map: &HeadingMap) -> String {
    let cells = || map.rows.iter().flat_map(|row| &row.cells);
    let held = cells().filter(|cell| cell.is_ok()).count();
    let count = cells().count();
    format!("A heading holds the course in {held} of {count} pairs of slope and course.")
}
