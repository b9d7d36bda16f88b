//! `replay`: a log of the folder beside what is predicted for it, as `grouser replay` has it.

use std::cell::RefCell;
use std::io::Cursor;
use std::path::PathBuf;

use grouser::answers::replay::ReplayQuestion;
use grouser::answers::{Answer, AnswerError, AnswerOptions, Sampling};
use grouser::document::columns::replay::{FROM, TO};
use grouser::document::given_file::GivenFile;
use grouser::document::measurements::telemetry::Odometry;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::replay::{Part, Replayer};
use grouser_draw::title_of;
use grouser_logs::{LogOptions, OptionNames, TelemetryError, TelemetryLog};
use http::StatusCode;

use super::command::CommandLine;
use super::fields::AskedFields;
use super::parts::ScenarioParts;
use super::staged::{Staged, Stages, refused};
use super::wheel_test::add_uncertainty;
use crate::asked::Question;
use crate::console::Console;
use crate::folder::ServedFolder;
use crate::refusal::Refusal;

/// Bytes of a log at the most: while it is read it is kept whole.
const MOST_BYTES: u64 = 64 << 20;
/// Times of logs [s].
const TIMES: std::ops::RangeInclusive<f64> = -1e12..=1e12;
/// Rows of a log between two looks at whether somebody still waits.
const ROWS_UNWATCHED: u64 = 1000;

/// What the console calls what one may ask for.
const OPTIONS: OptionNames = OptionNames {
    mapping: "the program's `--mapping FILE.toml`",
    topic: |what, topic| format!("the program's `--topic {what}={topic}`"),
    odometry: "`odometry`",
    budget: "the program's `--max-unpacked-mib N`",
    python: "`python -m grouser import-telemetry LOG --out drive.csv`",
};

/// What is asked of a log.
struct ReplayAsked {
    question: ReplayQuestion,
    folder: ServedFolder,
    path: PathBuf,
    odometry: Option<Odometry>,
    /// The log, once it is read: all stages share it.
    read: RefCell<Option<ReadLog>>,
}

/// A log, read to its end.
struct ReadLog {
    replayer: Replayer,
    given: Vec<GivenFile>,
    notes: Vec<String>,
}

pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let name = fields.text("log")?.filter(|name| !name.is_empty());
    let name =
        name.ok_or_else(|| Refusal::of_key("log", "it must be the path of a log in the folder"))?;
    let kind = fields.text("odometry")?;
    let odometry = kind.as_deref().map(odometry).transpose()?;
    let times = [FROM.name, TO.name].map(|key| fields.number(key, &TIMES));
    let [from, to] = times;
    let (from, to) = (from?, to?);
    let part = Part::new(from, to);
    let part = part.map_err(|error| Refusal::of_key(TO.name, error.to_string()))?;
    let parts = ScenarioParts::of(&fields)?;
    let stages = Stages::of(&fields, None)?.in_turn();
    fields.finish()?;
    if parts.common().has_every_model() {
        let message = "a log is replayed by one model: name one, or leave it out";
        return Err(Refusal::of_key("model", message));
    }
    let scenario = parts.scenario(&console.folder, stages.has_samples())?;
    let path = console.folder.find_map(&name);
    let path = path.map_err(|problem| Refusal::of_key("log", problem.to_string()))?;
    let mut line = CommandLine::new("replay");
    line.word(&name);
    parts.add_options(&mut line);
    line.maybe("odometry", kind.as_deref());
    for (option, end) in [("from-s", from), ("to-s", to)] {
        line.maybe(option, end.map(|it| it.to_string()).as_deref());
    }
    let question = ReplayQuestion { log: name, scenario, has_slope: false, part, sampling: None };
    let folder = console.folder.clone();
    let asked = ReplayAsked { question, folder, path, odometry, read: RefCell::default() };
    Ok(stages.question(asked, line))
}

fn odometry(kind: &str) -> Result<Odometry, Refusal> {
    Odometry::named(kind).ok_or_else(|| {
        let kinds = Odometry::ALL.map(|(name, ..)| name).join(", ");
        Refusal::of_key("odometry", format!("\"{kind}\", it must be one of {kinds}"))
    })
}

impl ReplayAsked {
    fn log(&self, go_on: &(dyn Fn() -> bool + Sync)) -> Result<ReadLog, Refusal> {
        let ReplayQuestion { log: label, scenario, part, .. } = &self.question;
        let bytes = self.folder.read(&self.path, MOST_BYTES);
        let bytes = bytes.map_err(|problem| Refusal::of_key("log", problem.to_string()))?;
        let source = Box::new(Cursor::new(bytes));
        let options = LogOptions::default().with_odometry(self.odometry);
        let log = TelemetryLog::of_table(label, source, &scenario.value.rover, &options);
        let mut log = log.map_err(unread)?;
        let mut replayer = Replayer::new(&scenario.value, None).within(*part);
        while let Some(record) = log.next_record().map_err(unread)? {
            replayer.update(record);
            if log.rows() % ROWS_UNWATCHED == 0 && !go_on() {
                return Err(refused(AnswerError::Stopped));
            }
        }
        let little = TelemetryLog::little_used(log.share_used());
        let notes = little.into_iter().chain(log.notes()).collect();
        Ok(ReadLog { replayer, given: log.given(), notes })
    }
}

impl Staged for ReplayAsked {
    fn sample(&mut self, sampling: Option<Sampling>) {
        self.question.sampling = sampling;
    }

    fn answer(&self, options: &AnswerOptions<'_>) -> Result<Answer, Refusal> {
        let mut kept = self.read.borrow_mut();
        let log = match kept.take() {
            Some(log) => log,
            None => self.log(options.go_on)?,
        };
        let log = kept.insert(log);
        let ReplayQuestion { scenario, sampling, .. } = &self.question;
        let samples = match sampling {
            Some(it) => it.draw(&BandInputs::of_scenario(scenario)),
            None => Ok(Vec::new()),
        };
        let samples = samples.map_err(|error| refused(error.into()))?;
        let replay = log.replayer.clone().finish(&samples, options.go_on);
        let replay = replay.map_err(|error| Refusal::of_key("log", error.to_string()))?;
        let replay = replay.ok_or_else(|| refused(AnswerError::Stopped))?;
        if let Some(why) = replay.nothing_predicted() {
            let message = format!("no stretch could be predicted, and nothing is compared: {why}");
            return Err(Refusal::new(StatusCode::UNPROCESSABLE_ENTITY, message));
        }
        Ok(self.question.answer("replay", &replay, log.given.clone(), log.notes.clone()))
    }

    fn counts(&self) -> Option<&'static str> {
        Some("looks at the drive")
    }

    fn whose(&self) -> String {
        title_of(&self.question.scenario)
    }

    fn add_samples(&self, line: &mut CommandLine, sampling: Option<Sampling>) {
        add_uncertainty(line, sampling);
    }
}

/// Why a log is not read, and what helps.
#[expect(clippy::needless_pass_by_value, reason = "for `map_err`")]
fn unread(error: TelemetryError) -> Refusal {
    let refusal = Refusal::of_key("log", error.to_string());
    match error.remedy() {
        Some(remedy) => refusal.with_hint(remedy.words(&OPTIONS)),
        None => refusal,
    }
}
