//! The slip of each wheel from a log of its motor's current and speed.

use std::sync::Arc;

use serde_json::{Value, json};

use super::{Answer, Displayed, Member, Sampling, meanings, samples, setting};
use crate::document::LoadedScenario;
use crate::document::columns::slip_from_current::{
    self as columns, ESTIMATE, SHARE_HELD, TRUE_SLIP, WHEEL, brief,
};
use crate::document::columns::{COURSE, SLIP_RATIO, SLOPE, STATUS, TIME};
use crate::document::figure::{BAND_COLOUR, Chart, Series, Style, axis};
use crate::document::given_file::GivenFile;
use crate::document::measurements::motor_log::MotorLog;
use crate::document::reading::four_digits;
use crate::document::table::Table;
use crate::studies::ensemble::samples::BandInputs;
use crate::studies::slip_from_current::{
    MotorReading, MotorRecord, SlipEstimate, SlipSettings, SlipStatus,
};
use crate::vehicle::Rover;

/// The question.
#[derive(Clone, Debug)]
pub struct SlipQuestion {
    /// The log's name.
    pub log: String,
    /// What it gave.
    pub given: Vec<GivenFile>,
    /// Columns of the log that are not read.
    pub ignored: Vec<String>,
    /// The scenario of rover, soil and slope.
    pub scenario: LoadedScenario,
    /// Yaw and course that stand for those of the log [°], as they were given.
    pub given_yaw: Option<f64>,
    /// The same of the course.
    pub given_course: Option<f64>,
    /// Noise of torques, and the range of slips.
    pub settings: SlipSettings,
    /// The samples of soil and model, if there are any.
    pub sampling: Option<Sampling>,
}

/// Readings that a terminal shows: of four wheels at three times.
const ROWS: usize = 12;

const CAPTION: &str = "The median and the 95 % interval from the current; where the interval is \
                       wider than 0.2 the current does not give the slip.";

impl SlipQuestion {
    /// The answer.
    ///
    /// * `estimates`: of the wheels of each record of the log
    #[must_use]
    pub fn answer(
        &self,
        name: &str,
        log: &MotorLog,
        estimates: &[Vec<Option<SlipEstimate>>],
    ) -> Answer {
        let rover = &self.scenario.value.rover;
        let rows = Arc::new(columns::table(rover, log, estimates));
        let wheels = Arc::new(columns::summary(rover, log, estimates));
        let notes = self.notes(log);
        let mut answer = Answer::new(name, "Slip from motor current");
        self.state(&mut answer);
        answer.results = vec![
            Member::rows("wheels", Arc::clone(&wheels)),
            Member::rows("rows", Arc::clone(&rows)),
            Member::Value("notes", json!(notes)),
        ];
        answer.tables =
            vec![(name.to_owned(), Arc::clone(&rows)), ("wheels".into(), Arc::clone(&wheels))];
        screen(&mut answer, &rows, &wheels, &notes);
        answer.given.extend(self.given.iter().cloned());
        answer.attach("scenario.toml", &self.scenario);
        self.page(&mut answer, (&rows, &wheels), notes);
        answer
    }

    /// Where loads and slip angles come from.
    fn notes(&self, log: &MotorLog) -> Vec<String> {
        let lacks = |of: fn(&MotorReading) -> bool| {
            log.records.iter().any(|record| record.wheels.iter().flatten().any(of))
        };
        let some = |of: fn(&MotorRecord) -> bool| log.records.iter().any(of);
        let mut notes = Vec::new();
        if lacks(|reading| reading.load.is_none()) {
            let slope = if some(|record| record.slope.is_some()) {
                "the log's slope".to_owned()
            } else {
                let slope = self.scenario.value.ground.plane_slope().unwrap_or(0.0);
                format!("a slope of {}°", four_digits(SLOPE.unit.from_si(slope)))
            };
            let yaw = if some(|record| record.yaw.is_some()) { "its yaw" } else { "a yaw of 0°" };
            notes.push(format!(
                "loads follow from {slope}, {yaw} and the torques of all wheels, in steady motion"
            ));
        }
        if lacks(|reading| reading.slip_angle.is_none()) {
            notes.push(if some(|record| record.course.is_some()) {
                "slip angles are those of the yaw against the course".to_owned()
            } else {
                "slip angles are those of a rover that goes where it points; \
                 course_deg = 0 is for one that holds the contour"
                    .to_owned()
            });
        }
        notes
    }

    /// The inputs of the answer.
    fn state(&self, answer: &mut Answer) {
        let document = &self.scenario.document;
        answer.input("log", self.log.as_str());
        answer.input("ignore", self.ignored.clone());
        answer.inputs_of(document, ["rover", "soil", SLOPE.name]);
        answer.input("yaw_deg", self.given_yaw);
        answer.input(COURSE.name, self.given_course);
        answer.inputs_of(document, ["gravity_m_s2", "load_transfer", "wheel_moments"]);
        answer.input("model", self.scenario.value.model.name());
        answer.input("relative_noise", self.settings.noise.relative);
        answer.input("noise_nm", self.settings.noise.absolute);
        answer.input("slip_ratio", Value::from(self.settings.slips.to_vec()));
        if let Some(sampling) = self.sampling {
            sampling.state(answer);
            let inputs = BandInputs::of_scenario(&self.scenario);
            answer.model_weights = Some(samples::weights(&inputs));
        }
    }

    fn page(
        &self,
        answer: &mut Answer,
        (rows, wheels): (&Arc<Table>, &Arc<Table>),
        notes: Vec<String>,
    ) {
        answer.verdict(verdict(wheels));
        answer.list(setting(&self.scenario.document).into_iter().chain(notes));
        answer.heading("Each wheel over time");
        for (wheel, chart) in charts(&self.scenario.value.rover, rows) {
            answer.figure(Some(&format!("figures/{wheel}")), chart, CAPTION);
        }
        answer.heading("What it comes to");
        answer.rows("Each wheel, and all of them", wheels, wheels.names());
        answer.list(states(rows).lines().map(String::from));
        answer.heading("Every reading");
        answer.rows("Readings and slip", rows, brief(rows));
        answer.columns = meanings(&columns::of_reading());
        answer.columns.extend(meanings(&ESTIMATE));
        answer.columns.extend(meanings(&columns::of_truth()));
    }
}

/// For reading: some of the readings, then each wheel.
fn screen(answer: &mut Answer, rows: &Arc<Table>, wheels: &Arc<Table>, notes: &[String]) {
    let notes: String = notes.iter().map(|note| format!("note: {note}\n")).collect();
    answer.screen = vec![
        Displayed::Excerpt {
            table: Arc::clone(rows),
            columns: brief(rows),
            most: ROWS,
            what: "readings",
        },
        Displayed::Words(states(rows) + "\n"),
        Displayed::Rows(Arc::clone(wheels), wheels.names()),
        Displayed::Words(format!("\n{notes}")),
    ];
}

/// What the words in the column of states mean, a line for each that is not `ok`.
fn states(rows: &Table) -> String {
    let states = rows.texts(STATUS);
    let is_there =
        |status: &SlipStatus| states.iter().any(|name| name.as_deref() == Some(status.name()));
    let others = SlipStatus::ALL.into_iter().filter(|status| *status != SlipStatus::Ok);
    let lines = others.filter(is_there);
    lines.map(|status| format!("{}: {}\n", status.name(), status.meaning())).collect()
}

/// What all wheels come to.
fn verdict(wheels: &Table) -> String {
    let last = wheels.rows() - 1;
    let all = wheels.rows_at(&[last]);
    let count = |name: &str| all.count(name).unwrap_or_default();
    let (readings, estimated, ill_posed) =
        (count("readings"), count("estimated"), count("ill_posed"));
    let held = wheels.numbers(SHARE_HELD.name).get(last).copied().flatten();
    let held = held.map_or(String::new(), |share| {
        format!(
            " The 95 % intervals hold the slip that was measured by other means in {} % of them.",
            four_digits(100.0 * share)
        )
    });
    format!(
        "{estimated} of {readings} readings of a current give a slip ratio; in {ill_posed} of \
         these torque hardly changes with slip, so that the interval is wider than 0.2.{held}"
    )
}

/// The slip of each wheel over time, by the wheel's name.
fn charts(rover: &Rover, rows: &Table) -> Vec<(String, Chart)> {
    let chart = |name: &String| {
        let of_wheel = rows.texts(WHEEL).iter().enumerate();
        let of_wheel = of_wheel.filter(|(_, wheel)| wheel.as_ref() == Some(name));
        let places: Vec<usize> = of_wheel.map(|(place, _)| place).collect();
        let rows = rows.rows_at(&places);
        let [low, median, high] = SLIP_RATIO.quantiles();
        let edges = rows.edges(TIME, [&low, &high]);
        let states = rows.texts(STATUS).iter().enumerate();
        let ill_posed = states
            .filter(|(_, status)| status.as_deref() == Some(SlipStatus::IllPosed.name()))
            .map(|(place, _)| place);
        let ill_posed = rows.rows_at(&ill_posed.collect::<Vec<_>>());
        let series = [
            Series::band("95 %", BAND_COLOUR, edges),
            Series::new("from the current", Style::Line, 1, rows.points(TIME.name, &median)),
            Series::new("ill-posed", Style::Triangles, 3, ill_posed.points(TIME.name, &median)),
            Series::new("measured", Style::Dashed, 2, rows.points(TIME.name, TRUE_SLIP.name)),
        ];
        let series: Vec<Series> =
            series.into_iter().filter(|series| !series.points.is_empty()).collect();
        let chart =
            Chart::new(format!("Slip ratio of {name}"), (axis(TIME), axis(SLIP_RATIO)), series);
        (!chart.series.is_empty()).then(|| (name.clone(), chart))
    };
    rover.mounts().iter().filter_map(|mount| chart(&mount.name)).collect()
}
