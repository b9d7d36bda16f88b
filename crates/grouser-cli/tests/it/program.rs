//! Runs the program in a folder of its own.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

/// The program that is tested.
pub(crate) const GROUSER: &str = env!("CARGO_BIN_EXE_grouser");

/// A folder in which the program runs, removed at the end.
pub(crate) struct Place(TempDir);

impl Place {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder can be made"))
    }

    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }

    /// A file of the folder.
    pub(crate) fn file(&self, name: &str) -> PathBuf {
        self.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.file(name), content).expect("it can be written");
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.file(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The names in it, hidden ones too.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.path()).expect("it can be listed");
        let name = |entry: std::io::Result<fs::DirEntry>| {
            entry.expect("it can be listed").file_name().to_string_lossy().into_owned()
        };
        let mut names: Vec<String> = entries.map(name).collect();
        names.sort();
        names
    }

    /// The program, ready to be started in the folder, without anything of our own environment
    /// that could change what it says.
    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(GROUSER);
        command.args(arguments);
        self.prepare(&mut command);
        command
    }

    /// A line for the shell, in which `grouser` is the program.
    pub(crate) fn shell(&self, line: &str) -> Answer {
        let mut command = Command::new("sh");
        command.args(["-c", &format!("grouser() {{ \"$GROUSER\" \"$@\"; }}\n{line}")]);
        command.env("GROUSER", GROUSER);
        self.prepare(&mut command);
        Answer::new(line, &command.output().expect("there is a shell"))
    }

    fn prepare(&self, command: &mut Command) {
        command.current_dir(self.path()).stdin(Stdio::null());
        let colours = ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"];
        for name in colours.into_iter().chain(["COLUMNS", "RUST_BACKTRACE"]) {
            command.env_remove(name);
        }
    }

    pub(crate) fn run(&self, arguments: &[&str]) -> Answer {
        let output = self.command(arguments).output().expect("the program starts");
        Answer::new(&written(arguments), &output)
    }

    /// Runs a command line that has no blanks within its words.
    pub(crate) fn line(&self, line: &str) -> Answer {
        self.run(&line.split_whitespace().collect::<Vec<_>>())
    }

    /// The results of a line that ends well.
    pub(crate) fn results(&self, line: &str) -> String {
        let answer = self.line(line);
        assert_eq!(answer.code(), 0, "{line}: {}", answer.stderr);
        assert_eq!(answer.stderr, "", "{line}");
        answer.stdout
    }

    /// The JSON of a line that ends well, asked for as such.
    pub(crate) fn json(&self, line: &str) -> Value {
        let text = self.results(&format!("{line} --format json"));
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{line}: {error}\n{text}"))
    }
}

/// What the program said and how it ended.
pub(crate) struct Answer {
    line: String,
    pub(crate) status: ExitStatus,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Answer {
    /// Takes an answer down; nothing that the program is asked may make it panic.
    pub(crate) fn new(line: &str, output: &Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("it writes UTF-8");
        let (stdout, stderr) = (text(&output.stdout), text(&output.stderr));
        assert!(!stderr.contains("panicked at"), "{line}: {stderr}");
        assert_ne!(output.status.code(), Some(101), "{line}: {stderr}");
        assert!(!stdout.contains('\u{1b}') && !stderr.contains('\u{1b}'), "{line}: escape codes");
        Self { line: line.to_owned(), status: output.status, stdout, stderr }
    }

    pub(crate) fn code(&self) -> i32 {
        self.status.code().unwrap_or_else(|| panic!("{}: ended by {}", self.line, self.status))
    }

    /// The conversation as a snapshot shows it.
    pub(crate) fn conversation(&self) -> String {
        let mut text = format!("$ {}\n", self.line);
        for (name, stream) in [("stdout", &self.stdout), ("stderr", &self.stderr)] {
            if !stream.is_empty() {
                // Writing to a string does not fail.
                let _ = write!(text, "--- {name}\n{}", timeless(stream));
            }
        }
        text + &format!("--- exit code {}\n", self.code())
    }
}

/// Without what changes from release to release and blanks at the ends of lines.
fn timeless(text: &str) -> String {
    let text = text.replace(env!("CARGO_PKG_VERSION"), "[VERSION]");
    text.lines().map(|line| line.trim_end().to_owned() + "\n").collect()
}

fn written(arguments: &[&str]) -> String {
    let quoted = arguments.iter().map(|argument| {
        let is_plain = !argument.is_empty() && !argument.contains([' ', '"', '*', '\n']);
        if is_plain { (*argument).to_owned() } else { format!("'{argument}'") }
    });
    std::iter::once("grouser".to_owned()).chain(quoted).collect::<Vec<_>>().join(" ")
}

/// A preset's document, with a piece replaced.
pub(crate) fn changed_preset(kind: &str, name: &str, from: &str, to: &str) -> String {
    let text = Place::new().results(&format!("presets {name} --kind {kind}"));
    assert!(text.contains(from), "{name} has no `{from}`");
    text.replacen(from, to, 1)
}

pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("not a number: {value}"))
}

/// The words of an object, in their order.
pub(crate) fn keys(value: &Value) -> Vec<&str> {
    value.as_object().expect("an object").keys().map(String::as_str).collect()
}
