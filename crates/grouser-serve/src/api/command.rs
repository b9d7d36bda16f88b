//! The command line that gives the same answer.

use std::fmt::Write as _;

/// A command line, word by word.
#[derive(Clone, Debug)]
pub(super) struct CommandLine(String);

impl CommandLine {
    pub(super) fn new(command: &str) -> Self {
        Self(format!("grouser {command}"))
    }

    /// Adds a word.
    pub(super) fn word(&mut self, word: &str) {
        self.0.push(' ');
        self.0.push_str(&quoted(word));
    }

    /// Adds an option with its value.
    pub(super) fn option(&mut self, option: &str, value: &str) {
        // A number below zero is no option.
        write!(self.0, " --{option} {}", quoted(value)).unwrap_or_default();
    }

    /// Adds an option with its value, if there is one.
    pub(super) fn maybe(&mut self, option: &str, value: Option<&str>) {
        if let Some(value) = value {
            self.option(option, value);
        }
    }

    /// Adds an option with a list of numbers.
    pub(super) fn numbers(&mut self, option: &str, numbers: &[f64]) {
        let all: Vec<String> = numbers.iter().map(ToString::to_string).collect();
        self.option(option, &all.join(","));
    }

    /// Adds an option without a value.
    pub(super) fn flag(&mut self, option: &str) {
        write!(self.0, " --{option}").unwrap_or_default();
    }

    pub(super) fn text(&self) -> &str {
        &self.0
    }
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./,:=+@".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn a_shell_takes_words_as_they_are() {
        assert_eq!(quoted("soil.cohesion_kpa=0.5"), "soil.cohesion_kpa=0.5");
        assert_eq!(quoted("it's $(here)"), r"'it'\''s $(here)'");
        assert_eq!(quoted(""), "''");
    }
}
