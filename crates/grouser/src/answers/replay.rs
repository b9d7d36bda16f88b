//! A drive that was measured beside the one that is predicted.

mod rover;

use std::sync::Arc;

use serde_json::json;

use super::{Answer, Attached, Displayed, Member, Sampling, meanings, samples, setting};
use crate::document::LoadedScenario;
use crate::document::columns::replay::{
    self as columns, FINDINGS, FROM, STRETCH, TO, WORK, brief_channels, brief_findings, columns_of,
    measured_channels, prefix_of, quantity_of,
};
use crate::document::columns::{ENERGY, SLOPE, TIME};
use crate::document::figure::{BAND_COLOUR, Chart, Series, Style, axis};
use crate::document::given_file::GivenFile;
use crate::document::reading::{capitalised, counted, four_digits, sentence};
use crate::document::table::Table;
use crate::studies::ensemble::samples::BandInputs;
use crate::studies::learn::{GrossFault, Suspect};
use crate::studies::replay::{Channel, Part, Prediction, Replay};
use crate::vehicle::Rover;

/// The file of a rover whose wheels have the radius that a drive points to.
pub const ROVER: &str = "rover.toml";
const CHANGED_ROVER: &str = "rover.toml has wheels of the radius with which the rims would move as \
    they did. Take it where the radius is what was wrong: the scale of an encoder, or of the \
    odometry, makes the same differences, and is no number of a rover.";

/// What was replayed, from what.
#[derive(Clone, Debug)]
pub struct ReplayQuestion {
    /// The log's name.
    pub log: String,
    /// The scenario that is predicted with.
    pub scenario: LoadedScenario,
    /// Whether the slope is the scenario's, and not the log's.
    pub has_slope: bool,
    /// The part of the log.
    pub part: Part,
    /// The samples of its bands, if it has any.
    pub sampling: Option<Sampling>,
}

/// A drive that was replayed, as tables and sentences.
struct Found<'r> {
    replay: &'r Replay,
    rover: &'r Rover,
    over_time: Arc<Table>,
    channels: Arc<Table>,
    findings: Arc<Table>,
    /// What the differences point to.
    sentences: Vec<String>,
    notes: Vec<String>,
}

impl ReplayQuestion {
    /// The answer.
    ///
    /// * `replay`: the log, replayed with the scenario and the samples
    /// * `given`: what the log and its mapping gave
    /// * `notes`: on what of it was left out
    #[must_use]
    pub fn answer(
        &self,
        name: &str,
        replay: &Replay,
        given: Vec<GivenFile>,
        notes: Vec<String>,
    ) -> Answer {
        let rover = &self.scenario.value.rover;
        let found = Found {
            replay,
            rover,
            over_time: columns::over_time(replay, rover).into(),
            channels: columns::channels(replay, rover).into(),
            findings: columns::findings(replay).into(),
            sentences: columns::sentences(replay),
            notes: notes.into_iter().chain(columns::notes(replay)).collect(),
        };
        let mut answer = Answer::new(name, "The drive, replayed");
        self.state(&mut answer);
        found.results(&mut answer);
        for (name, table) in
            [(name, &found.over_time), ("channels", &found.channels), ("findings", &found.findings)]
        {
            answer.tables.push((name.to_owned(), Arc::clone(table)));
        }
        let (channels, findings) = found.brief();
        let lines: String = found.lines().iter().map(|line| format!("{line}\n")).collect();
        answer.screen = vec![
            Displayed::Rows(Arc::clone(&found.channels), channels),
            Displayed::Words("\n".into()),
            Displayed::Rows(Arc::clone(&found.findings), findings),
            Displayed::Words(format!("\n{lines}")),
        ];
        answer.given.extend(given);
        answer.attach("scenario.toml", &self.scenario);
        self.page(&mut answer, &found);
        if let Some(changed) = self.changed_rover(replay) {
            answer.heading("The rover that the drive points to");
            answer.words(CHANGED_ROVER);
            answer.documents.push(Attached {
                file: ROVER.to_owned(),
                toml: changed.to_toml(),
                companions: Vec::new(),
                assumptions: Vec::new(),
            });
        }
        answer
    }

    /// The inputs of the answer.
    fn state(&self, answer: &mut Answer) {
        let document = &self.scenario.document;
        answer.input("log", self.log.as_str());
        answer.inputs_of(document, ["rover", "soil"]);
        let slope = document.get(SLOPE.name).filter(|_| self.has_slope);
        answer.input(SLOPE.name, slope.cloned().unwrap_or_default());
        for (end, quantity) in self.part.ends().into_iter().zip([FROM, TO]) {
            answer.input(quantity.name, end);
        }
        answer.inputs_of(document, ["gravity_m_s2", "load_transfer", "wheel_moments"]);
        answer.input("model", self.scenario.value.model.name());
        answer.input("samples", self.sampling.map(|it| it.count));
        answer.input("seed", self.sampling.map(|it| it.seed));
        let weights = |_| samples::weights(&BandInputs::of_scenario(&self.scenario));
        answer.model_weights = Some(json!(self.sampling.map(weights)));
    }

    fn page(&self, answer: &mut Answer, found: &Found<'_>) {
        for it in &found.sentences {
            answer.verdict(sentence(it));
        }
        answer.list(setting(&self.scenario.document));
        answer.list([format!("model: {}", self.scenario.value.model.name())]);
        answer.list(found.whole());
        answer.list(found.notes.clone());
        let (channels, findings) = found.brief();
        answer.heading("What the differences point to");
        answer.rows("What may be wrong, and by how much", &found.findings, findings);
        answer.heading("Measured less predicted");
        answer.rows("Each channel, in its own unit", &found.channels, channels);
        for (title, prediction) in [
            ("At the attitude and wheel speeds that were read", Prediction::Prescribed),
            ("Run freely from the first pose", Prediction::FreeRun),
        ] {
            answer.folded(title, |answer| answer.charts(found.charts(prediction)));
        }
        let first = |it: &Channel| *it == it.of_first_wheel();
        let channels = Channel::all(found.rover.wheel_count()).into_iter().filter(first);
        answer.columns = meanings(&STRETCH);
        answer.columns.extend(channels.flat_map(|it| meanings(&columns_of(it))));
        answer.columns.extend(meanings(&FINDINGS));
    }
}

impl Found<'_> {
    /// The results of JSON.
    fn results(&self, answer: &mut Answer) {
        let replay = self.replay;
        let work = replay.energy.map(|energy| Table::of(&WORK, &[energy]));
        let ended = replay.free_run.ended.as_ref();
        let replayed = json!({
            "records": replay.taken.records,
            "stretches": replay.taken.stretches,
            "compared_stretches": replay.stretches.len(),
            "explained_stretches": replay.explained_stretches,
            "outliers": replay.taken.outliers,
            "free_run": {
                (SLOPE.name): SLOPE.unit.from_si(replay.free_run.slope),
                "starts": replay.free_run.starts.len(),
                "ended": ended.map(|(time, _)| json!({ (TIME.name): time })),
            },
        });
        answer.results = vec![
            Member::Value("points_to", json!(self.sentences)),
            Member::Value(
                "best_causes",
                json!(replay.best_causes().iter().map(|(it, _)| it.name()).collect::<Vec<_>>()),
            ),
            Member::rows("findings", Arc::clone(&self.findings)),
            Member::rows("channels", Arc::clone(&self.channels)),
        ];
        answer.results.extend(work.map(|work| Member::Row(Some("work"), work)));
        answer.results.extend([
            Member::rows("stretches", Arc::clone(&self.over_time)),
            Member::Value("replayed", replayed),
            Member::Value("notes", json!(self.notes)),
        ]);
    }

    /// The columns for reading, of channels and of findings.
    fn brief(&self) -> (Vec<String>, Vec<String>) {
        let channels = brief_channels(self.replay).into_iter().map(String::from).collect();
        (channels, brief_findings().map(String::from).into())
    }

    /// What the differences point to, what was replayed, and notes: a line each.
    fn lines(&self) -> Vec<String> {
        let found = self.sentences.iter().map(|it| format!("finding: {it}"));
        let notes = self.notes.iter().map(|note| format!("note: {note}"));
        found.chain(self.whole()).chain(notes).collect()
    }

    /// How much was replayed.
    fn whole(&self) -> Vec<String> {
        let taken = &self.replay.taken;
        let (stretches, records) = (taken.stretches, taken.records);
        let work = self.replay.energy.map(|work| {
            let [measured, predicted] = work.map(|it| four_digits(ENERGY.unit.from_si(it)));
            let unit = ENERGY.unit.symbol;
            let is_of_work =
                |it: &GrossFault| matches!(it.suspect, Suspect::Torque | Suspect::Speed);
            let has_fault = self.replay.gross_faults.iter().any(is_of_work);
            let fault = if has_fault { ", with the fault that is found," } else { "," };
            format!(
                "work of the wheels: measured {measured} {unit}{fault} predicted {predicted} {unit}"
            )
        });
        let stretches = counted(stretches as u64, "stretch", "stretches");
        let ends = self.replay.part.ends().into_iter().zip(["from", "to"]);
        let ends: String =
            ends.filter_map(|(end, word)| Some(format!(" {word} {} s", end?))).collect();
        let records = counted(records, "record", "records");
        let compared = format!("replayed {stretches} of {records}{ends}");
        [compared].into_iter().chain(columns::best_in_words(self.replay)).chain(work).collect()
    }

    /// Two charts of each channel: both sides over time, and the residual.
    fn charts(&self, prediction: Prediction) -> Vec<Chart> {
        let channels = measured_channels(self.replay, self.rover).into_iter().map(|(_, it)| it);
        let shown = channels.filter(|it| it.prediction() == prediction);
        shown.flat_map(|channel| self.of_channel(channel)).collect()
    }

    fn of_channel(&self, channel: Channel) -> [Chart; 2] {
        let (quantity, prefix) = (quantity_of(channel), prefix_of(channel, self.rover));
        let named = |name: &str| format!("{prefix}{name}");
        let over = |name: &str| -> Vec<(f64, f64)> {
            self.over_time.points(TIME.name, &named(name)).collect()
        };
        let [low, _, high] = quantity.quantiles().map(|name| named(&name));
        let edges = self.over_time.edges(TIME, [&low, &high]);
        let mut series = Vec::new();
        if !edges.is_empty() {
            series.push(Series::band("95 %", BAND_COLOUR, edges));
        }
        series.push(Series::new("measured", Style::Line, 1, over(&quantity.measurement())));
        series.push(Series::new("predicted", Style::Dashed, 2, over(quantity.name)));
        let title = capitalised(&quantity.label());
        let title = match prefix.trim_end_matches('.') {
            "" => title,
            wheel => format!("{title}, {wheel}"),
        };
        let residual = Series::new("", Style::Line, 1, over(&quantity.residual()));
        let of_residual = format!("{title}: measured less predicted");
        let axes = || (axis(TIME), axis(quantity));
        [Chart::new(title, axes(), series), Chart::new(of_residual, axes(), vec![residual])]
    }
}
