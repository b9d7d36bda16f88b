//! Runs the program under limits, and finds faults in its behaviour.

use std::fmt;
use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::time::Duration;

use anyhow::{Context, Result};
use wait_timeout::ChildExt as _;

use super::files_below;
use super::mutation::MARK;
use super::subjects::{Oracle, Subject};

/// What a run may take.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Address space, in KiB. Its start and two threads take half a gigabyte of it.
    memory_kib: u64,
    /// Time of the processors [s]: other work on the machine does not count.
    pub(super) processor_s: u64,
    /// Size of a file that it writes, in blocks of 512 bytes.
    file_blocks: u64,
    /// Time of day, for a program that waits [s].
    waiting_s: u64,
}

impl Limits {
    /// Far more than any case needs.
    pub(super) const GENEROUS: Self =
        Self { memory_kib: 2 << 20, processor_s: 20, file_blocks: 1 << 17, waiting_s: 240 };
}

/// What a run printed, and how it ended; `None` if it had to be ended.
#[derive(Debug)]
pub(super) struct Answer {
    pub(super) status: Option<ExitStatus>,
    pub(super) stdout: Vec<u8>,
    pub(super) stderr: Vec<u8>,
}

/// What no run may do.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Fault {
    /// It took more time of the processors than it may, or waited for ever.
    TooLong,
    /// It ended by a signal: memory ran out, or worse.
    Signal(i32),
    Panic(String),
    ExitCode(i32),
    /// It failed without a message that starts with `error: `.
    Silent(i32),
    /// It printed a character that moves the cursor or turns the text around.
    ControlCharacter {
        place: String,
        character: char,
    },
    /// The answer should be JSON and is not.
    NotJson(String),
    /// A drawing is no XML, or has markup from the data.
    Markup {
        file: String,
        problem: String,
    },
    /// A cell that a spreadsheet takes for a formula.
    Formula(String),
    /// Damage changed the answer, and the exit code was 0.
    OtherAnswer,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLong => f.write_str("it reached the limit of time"),
            Self::Signal(signal) => write!(f, "it ended by signal {signal}"),
            Self::Panic(line) => write!(f, "panic: {line}"),
            Self::ExitCode(code) => write!(f, "exit code {code}"),
            Self::Silent(code) => write!(f, "exit code {code} without saying why"),
            Self::ControlCharacter { place, character } => {
                write!(f, "control character U+{:04X} in {place}", u32::from(*character))
            }
            Self::NotJson(problem) => write!(f, "its JSON: {problem}"),
            Self::Markup { file, problem } => write!(f, "{file}: {problem}"),
            Self::Formula(cell) => write!(f, "a cell of its CSV is a formula: {cell}"),
            Self::OtherAnswer => f.write_str("damage was not refused and changed the answer"),
        }
    }
}

/// Runs the program in a folder.
pub(super) fn run(
    program: &Path,
    words: &[String],
    folder: &Path,
    limits: Limits,
) -> Result<Answer> {
    let Limits { memory_kib, processor_s, file_blocks, waiting_s } = limits;
    let script = format!(
        "ulimit -v {memory_kib}; ulimit -t {processor_s}; ulimit -f {file_blocks}; ulimit -c 0; \
         exec \"$0\" \"$@\""
    );
    let output = tempfile::tempdir().context("a folder for the output")?;
    let [stdout, stderr] = ["stdout", "stderr"].map(|name| output.path().join(name));
    let mut command = Command::new("/bin/sh");
    command.arg("-c").arg(script).arg(program).args(words).current_dir(folder);
    command.stdin(Stdio::null());
    command.stdout(File::create(&stdout)?).stderr(File::create(&stderr)?);
    // Each thread's heap reserves an address space of its own.
    command.env("MALLOC_ARENA_MAX", "2").env("RAYON_NUM_THREADS", "2").env("NO_COLOR", "1");
    let mut child = command.spawn().context("the program did not start")?;
    let status = child.wait_timeout(Duration::from_secs(waiting_s))?;
    if status.is_none() {
        child.kill()?;
        child.wait()?;
    }
    Ok(Answer { status, stdout: fs::read(stdout)?, stderr: fs::read(stderr)? })
}

/// What is wrong with an answer, if anything is.
///
/// * `folder`: where the program ran, with what it wrote
pub(super) fn fault(trial: &Subject, answer: &Answer, folder: &Path) -> Result<Option<Fault>> {
    let stdout = String::from_utf8_lossy(&answer.stdout);
    let stderr = String::from_utf8_lossy(&answer.stderr);
    if let Some(line) = stderr.lines().find(|line| line.contains("panicked at")) {
        return Ok(Some(Fault::Panic(line.to_owned())));
    }
    let code = match exit_code(answer) {
        Ok(code) => code,
        Err(fault) => return Ok(Some(fault)),
    };
    if code != 0 && code != 3 && !stderr.contains("error: ") {
        return Ok(Some(Fault::Silent(code)));
    }
    for (place, text) in [("what it printed", &stdout), ("its messages", &stderr)] {
        if let Some(character) = text.chars().find(|character| is_control(*character)) {
            return Ok(Some(Fault::ControlCharacter { place: place.to_owned(), character }));
        }
    }
    if code != 0 {
        return Ok(None);
    }
    if let Oracle::Unchanged { stdout: before } = &trial.oracle
        && *before != stdout
    {
        return Ok(Some(Fault::OtherAnswer));
    }
    Ok(match trial.format() {
        Some("json") => json_fault(&stdout),
        Some("csv") => csv_fault(&stdout),
        _ => None,
    }
    .or(written_fault(trial, folder)?))
}

fn exit_code(answer: &Answer) -> Result<i32, Fault> {
    use std::os::unix::process::ExitStatusExt as _;
    /// Time of the processors, and the kill that follows it.
    const TIME: [i32; 2] = [24, 9];
    let status = answer.status.ok_or(Fault::TooLong)?;
    match (status.code(), status.signal()) {
        (Some(code @ 0..=3), _) => Ok(code),
        (Some(code), _) => Err(Fault::ExitCode(code)),
        (None, Some(signal)) if TIME.contains(&signal) => Err(Fault::TooLong),
        (None, signal) => Err(Fault::Signal(signal.unwrap_or(0))),
    }
}

/// Whether a character acts on a terminal or a page instead of being shown: control characters, and
/// those that turn the direction of the text (Unicode Standard Annex 9).
fn is_control(character: char) -> bool {
    let direction = matches!(character, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    direction || (character.is_control() && !matches!(character, '\n' | '\t'))
}

fn json_fault(text: &str) -> Option<Fault> {
    let mut values = serde_json::Deserializer::from_str(text).into_iter::<serde_json::Value>();
    values.find_map(Result::err).map(|error| Fault::NotJson(error.to_string()))
}

fn csv_fault(text: &str) -> Option<Fault> {
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
    let records = reader.records().filter_map(Result::ok);
    let is_formula = |cell: &str| {
        cell.starts_with(['=', '+', '@', '-']) && cell.len() > 1 && cell.parse::<f64>().is_err()
    };
    for record in records {
        if let Some(cell) = record.iter().find(|cell| is_formula(cell)) {
            return Some(Fault::Formula(cell.to_owned()));
        }
    }
    None
}

/// What is wrong with the files that were written: those that the trial did not bring.
fn written_fault(trial: &Subject, folder: &Path) -> Result<Option<Fault>> {
    for path in files_below(folder)? {
        let file = path.strip_prefix(folder)?.to_string_lossy().into_owned();
        let extension = path.extension().and_then(|extension| extension.to_str());
        let is_page = matches!(extension, Some("svg" | "html"));
        if !is_page || trial.files.iter().any(|(name, _)| *name == file) {
            continue;
        }
        let text = fs::read_to_string(&path).with_context(|| file.clone())?;
        if let Some(character) = text.chars().find(|character| is_control(*character)) {
            return Ok(Some(Fault::ControlCharacter { place: file, character }));
        }
        if text.contains(MARK) {
            return Ok(Some(Fault::Markup { file, problem: "markup from the data".to_owned() }));
        }
        if let (Some("svg"), Err(error)) = (extension, roxmltree::Document::parse(&text)) {
            return Ok(Some(Fault::Markup { file, problem: error.to_string() }));
        }
    }
    Ok(None)
}
