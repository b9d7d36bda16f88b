//! Forces and sinkage of one wheel on a test stand.

use std::sync::Arc;

use serde_json::json;

use super::{
    Answer, AnswerError, AnswerOptions, Displayed, EVERY_MODEL, Member, Sampling, gradient,
    meanings, samples,
};
use crate::contact::Model;
use crate::document::columns::wheel::WHEEL;
use crate::document::columns::{
    self, DRAWBAR_PULL, LOAD, MODEL, Quantity, SIDE_FORCE, SINKAGE, SLIP_ANGLE, SLIP_RATIO, TORQUE,
};
use crate::document::figure::{BAND_COLOUR, Chart, Series, Style, axis};
use crate::document::gradient::{GradientKeys, WheelKeys};
use crate::document::reading::{capitalised, four_digits};
use crate::document::table::Table;
use crate::document::{LoadedSoil, LoadedWheel};
use crate::studies::ensemble::models::Question;
use crate::studies::ensemble::samples::BandInputs;
use crate::studies::measurement::PerQuantity;
use crate::studies::simulated_test::SimulatedTest;
use crate::studies::wheel_test::{WheelTest, WheelTestRow};

/// The question.
#[derive(Clone, Debug)]
pub struct WheelTestQuestion {
    /// The soil.
    pub soil: LoadedSoil,
    /// The wheel.
    pub wheel: LoadedWheel,
    /// Gravity [m/s²].
    pub gravity: f64,
    /// The model, or each of several, with what its bands are drawn from.
    pub models: Vec<(Model, BandInputs)>,
    /// Whether somebody named the model.
    pub is_model_named: bool,
    /// Loads [N].
    pub loads: Vec<f64>,
    /// Slip angles [°], as they were given.
    pub slip_angles_deg: Vec<f64>,
    /// Slip ratios [-].
    pub slip_ratios: Vec<f64>,
    /// Trials with the noise of a stand, in place of the model's own values.
    pub stand: Option<SimulatedStand>,
    /// The samples of its bands, if it has any.
    pub sampling: Option<Sampling>,
    /// The numbers that its results are differentiated by, if any.
    pub gradients: Option<GradientKeys>,
}

/// A simulated test stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimulatedStand {
    /// Trials of each setting.
    pub trials: usize,
    /// Standard deviation of the noise of forces [N].
    pub noise_n: f64,
    /// The same of sinkages [mm], as it was given.
    pub noise_mm: f64,
    /// The same of torques [N·m].
    pub noise_nm: f64,
    /// Seed of the noise.
    pub seed: u64,
}

/// The rows of a test, and what charts draw of it.
struct Charted<'t> {
    rows: &'t Table,
    /// The same, or the same test at more slip ratios.
    drawn: &'t Table,
    style: Style,
}

impl WheelTestQuestion {
    /// The answer.
    ///
    /// # Errors
    /// [`AnswerError`]: a soil whose uncertainty reaches too far, a flag where none is accepted, or
    /// a stop on the way.
    pub fn answer(&self, name: &str, options: &AnswerOptions<'_>) -> Result<Answer, AnswerError> {
        if self.models.is_empty() {
            return Err(AnswerError::Empty("models"));
        }
        self.check_together()?;
        let keys = self.gradients.as_ref().map(|it| WheelKeys::of(&self.soil, &self.wheel, it));
        let keys = keys.transpose()?;
        let mut answer = Answer::new(name, "A wheel test");
        let mut rows = Table::default();
        for (model, inputs) in &self.models {
            let test = self.plan(model);
            let found = test.run();
            let mut table = self.of_model(&test, inputs, &found, options)?;
            if let Some(keys) = &keys {
                let derivatives: Vec<_> = found.iter().map(|row| keys.of_row(&test, row)).collect();
                let names: Vec<&str> = keys.names().collect();
                table = columns::gradient::of_wheels(table, &names, &derivatives);
            }
            rows.append(self.named(model, table));
            let found = found.into_iter().flat_map(|row| row.findings);
            answer.findings.get_or_insert_default().extend(found);
        }
        let (names, lacking): (Vec<&str>, Vec<&str>) = keys
            .as_ref()
            .map_or_else(Default::default, |it| (it.names().collect(), it.lacking().collect()));
        let derivatives = gradient::lines(&rows, &names, &lacking);
        let mut brief = self.brief();
        brief.extend(gradient::brief(&[SINKAGE.name, DRAWBAR_PULL.name], &names));
        let rows = Arc::new(rows);
        self.state(&mut answer);
        answer.results.push(Member::rows("rows", Arc::clone(&rows)));
        answer.results.extend(gradient::notes(&derivatives));
        answer.tables.push((name.to_owned(), Arc::clone(&rows)));
        answer.screen = vec![
            Displayed::Rows(Arc::clone(&rows), brief),
            Displayed::Words(self.model_line() + &derivatives),
        ];
        answer.attach("soil.toml", &self.soil);
        answer.attach("wheel.toml", &self.wheel);
        if options.has_page {
            self.page(&mut answer, &rows);
            let settings = [LOAD.name, SLIP_ANGLE.name, SLIP_RATIO.name];
            let results = [SINKAGE.name, DRAWBAR_PULL.name, TORQUE.name];
            gradient::page(&mut answer, &rows, [&settings, &results, &names], &derivatives);
        }
        Ok(answer)
    }

    /// Checks that what is asked for has an answer together.
    fn check_together(&self) -> Result<(), AnswerError> {
        let choices = [
            ("a simulated stand", self.stand.is_some()),
            ("samples", self.sampling.is_some()),
            ("derivatives", self.gradients.is_some()),
        ];
        AnswerError::check_together(&choices)
    }

    /// How often [`AnswerOptions::go_on`] is asked.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.sampling.map_or(0, |it| it.count as usize * self.models.len())
    }

    /// The name of the model, or that there are several.
    #[must_use]
    pub fn model_name(&self) -> &'static str {
        match &self.models[..] {
            [(model, _)] => model.name(),
            _ => EVERY_MODEL,
        }
    }

    fn has_several(&self) -> bool {
        self.models.len() > 1
    }

    /// The rows of one model.
    ///
    /// * `inputs`: what its bands are drawn from
    /// * `found`: what its test came to
    fn of_model(
        &self,
        test: &WheelTest,
        inputs: &BandInputs,
        found: &[WheelTestRow],
        options: &AnswerOptions<'_>,
    ) -> Result<Table, AnswerError> {
        let table = columns::wheel_test::table(found);
        let flags = found.iter().map(|row| &*row.findings);
        options.check(flags, &table, &columns::wheel_test::SETTINGS)?;
        if let Some(stand) = self.stand {
            return Ok(columns::stand::table(&stand.of(test.clone()).run()));
        }
        let Some(sampling) = self.sampling else { return Ok(table) };
        let samples = sampling.draw(&self.asked(inputs))?;
        let bands = test.bands(&samples, options.go_on).ok_or(AnswerError::Stopped)?;
        Ok(columns::wheel_test::with_bands(table, &bands))
    }

    /// A table of a model's results, with its name where there are several.
    fn named(&self, model: &Model, table: Table) -> Table {
        if self.has_several() { table.with_word(MODEL, model.name()) } else { table }
    }

    /// What bands are drawn from. A wheel that runs straight needs no force across it.
    fn asked(&self, inputs: &BandInputs) -> BandInputs {
        let angles = self.slip_angles_deg.iter().map(|angle| Question::at_slip_angle(*angle));
        inputs.clone().asked(Question::of_all(angles))
    }

    fn plan(&self, model: &Model) -> WheelTest {
        WheelTest {
            wheel: self.wheel.value,
            soil: self.soil.value,
            gravity: self.gravity,
            model: model.clone(),
            loads: self.loads.clone(),
            slip_angles: SLIP_ANGLE.in_si(&self.slip_angles_deg),
            slip_ratios: self.slip_ratios.clone(),
        }
    }

    /// The inputs of the answer.
    fn state(&self, answer: &mut Answer) {
        answer.input("soil", json!(self.soil.document));
        answer.input("wheel", json!(self.wheel.document));
        answer.input("gravity_m_s2", self.gravity);
        answer.input("model", self.model_name());
        answer.input("load_n", self.loads.clone());
        answer.input("slip_angle_deg", self.slip_angles_deg.clone());
        answer.input("slip_ratio", self.slip_ratios.clone());
        if let Some(stand) = self.stand {
            let SimulatedStand { trials, noise_n, noise_mm, noise_nm, seed } = stand;
            answer.input(
                "simulated_stand",
                json!({
                    "trials": trials,
                    "noise_n": noise_n,
                    "noise_mm": noise_mm,
                    "noise_nm": noise_nm,
                    "seed": seed,
                }),
            );
        }
        if let Some(keys) = &self.gradients {
            answer.input("gradients", json!(keys.names()));
        }
        if let Some(sampling) = self.sampling {
            sampling.state(answer);
            let weights = || samples::weights(&self.asked(&self.models[0].1));
            answer.model_weights = (!self.has_several()).then(weights);
        }
    }

    /// The columns for reading.
    fn brief(&self) -> Vec<String> {
        let mut names = if self.stand.is_some() {
            columns::stand::brief()
        } else if self.sampling.is_some() {
            columns::wheel_test::bands_brief()
        } else {
            columns::wheel_test::brief()
        };
        if self.has_several() {
            names.insert(0, MODEL.to_owned());
        }
        names
    }

    /// Which model the rows have, where nobody names one, and which ones their bands.
    fn model_line(&self) -> String {
        if self.is_model_named {
            return String::new();
        }
        let weights = self.sampling.map(|_| samples::line(&self.asked(&self.models[0].1)));
        self.soil.document.usual_model_line("") + &weights.unwrap_or_default()
    }

    /// The same test at slip ratios so close that curves are smooth; nothing where the rows have
    /// noise or bands, or are of few slip ratios.
    fn dense(&self) -> Option<Table> {
        /// Points of a curve.
        const POINTS: u32 = 120;
        let slips = &self.slip_ratios;
        if slips.len() < 3 || self.stand.is_some() || self.sampling.is_some() {
            return None;
        }
        let [low, high] = [f64::min, f64::max].map(|end| slips.iter().copied().fold(f64::NAN, end));
        let share = |point| f64::from(point) / f64::from(POINTS);
        let between = (0..=POINTS).map(|point| low + (high - low) * share(point));
        let slip_ratios: Vec<f64> = between.collect();
        let mut table = Table::default();
        for (model, _) in &self.models {
            let test = WheelTest { slip_ratios: slip_ratios.clone(), ..self.plan(model) };
            table.append(self.named(model, columns::wheel_test::table(&test.run())));
        }
        Some(table)
    }

    fn page(&self, answer: &mut Answer, rows: &Arc<Table>) {
        let dense = self.dense();
        let style = if self.stand.is_some() { Style::Dots } else { Style::Line };
        let charted = Charted { rows, drawn: dense.as_ref().unwrap_or(rows), style };
        answer.verdict(charted.sentence());
        let model = if self.has_several() { "every model" } else { self.model_name() };
        answer.list([
            format!("wheel: {}", self.wheel.document.name()),
            format!("soil: {}", self.soil.document.name()),
            format!("gravity: {} m/s²", self.gravity),
            format!("wheel–soil model: {model}"),
        ]);
        answer.heading("Over the slip ratio");
        let has_side_force = self.slip_angles_deg.iter().any(|angle| *angle != 0.0);
        let name = answer.name.clone();
        let figures =
            [(DRAWBAR_PULL, Some(&*name)), (SINKAGE, Some("sinkage")), (TORQUE, Some("torque"))];
        for (quantity, file) in
            figures.into_iter().chain(has_side_force.then_some((SIDE_FORCE, None)))
        {
            answer.figure(file, charted.chart(quantity), caption(quantity));
        }
        answer.heading("Every row");
        answer.rows("Settings and results", rows, self.brief());
        answer.columns = meanings(&WHEEL);
    }
}

impl SimulatedStand {
    fn of(self, plan: WheelTest) -> SimulatedTest {
        let noise = PerQuantity {
            drawbar_pull: self.noise_n,
            side_force: self.noise_n,
            sinkage: SINKAGE.unit.to_si(self.noise_mm),
            torque: self.noise_nm,
        };
        SimulatedTest { plan, trials: self.trials, noise, seed: self.seed }
    }
}

impl Charted<'_> {
    /// The largest pull, and where.
    fn sentence(&self) -> String {
        let [slips, pulls] = [SLIP_RATIO, DRAWBAR_PULL].map(|it| self.rows.numbers(it.name));
        let known = slips.iter().zip(pulls).filter_map(|(slip, pull)| slip.zip(*pull));
        let largest = known.max_by(|one, other| one.1.total_cmp(&other.1));
        match largest {
            Some((slip, pull)) => format!(
                "The largest drawbar pull of these rows is {} N, at a slip ratio of {}.",
                four_digits(pull),
                four_digits(slip)
            ),
            None => "No row has a result: each says why.".into(),
        }
    }

    /// A quantity over the slip ratio, a series for each model, load and slip angle, with its band
    /// if there is one.
    fn chart(&self, quantity: Quantity) -> Chart {
        let table = self.drawn;
        let models = table.texts(MODEL);
        let [loads, angles] = [LOAD, SLIP_ANGLE].map(|it| table.numbers(it.name));
        let name = |row: usize| {
            let [load, angle] = [loads, angles].map(|column| column[row].unwrap_or_default());
            let model = models.get(row).and_then(Option::as_deref);
            let model = model.map_or(String::new(), |model| format!("{model}, "));
            format!("{model}{load} N, {angle}°")
        };
        let names: Vec<String> = (0..table.rows()).map(name).collect();
        let places: Vec<usize> = (0..table.rows()).collect();
        let mut bands: Vec<Series> = Vec::new();
        let mut lines: Vec<Series> = Vec::new();
        for rows in places.chunk_by(|one, next| names[*one] == names[*next]) {
            let (name, part) = (&names[rows[0]], table.rows_at(rows));
            let [low, _, high] = quantity.quantiles();
            let edges = part.edges(SLIP_RATIO, [&low, &high]);
            if !edges.is_empty() {
                let colour = if rows.len() < table.rows() { lines.len() } else { BAND_COLOUR };
                bands.push(Series::band(format!("95 %, {name}"), colour, edges));
            }
            let points = part.points(SLIP_RATIO.name, quantity.name);
            lines.push(Series::new(name, self.style, lines.len(), points));
        }
        let series = bands.into_iter().chain(lines).collect();
        let title = capitalised(&quantity.label());
        Chart::new(title, (axis(SLIP_RATIO), axis(quantity)), series)
    }
}

fn caption(quantity: Quantity) -> &'static str {
    match quantity {
        SINKAGE => "Sinkage of the grouser tips below the undisturbed ground.",
        TORQUE => "Torque that the motor gives to the wheel.",
        SIDE_FORCE => "Force of the soil across the wheel, positive to the left.",
        _ => "Force of the soil along the wheel: what is left of the thrust to pull with.",
    }
}
