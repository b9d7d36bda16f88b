//! Questions on a terminal, one after the other.

use std::io::{BufRead, Write};
use std::path::Path;

use grouser::document::draft::{Draft, Question};
use grouser::document::escape;
use serde_json::Value;

use crate::failure::Failure;
use crate::output;

/// Asks what is not answered yet, until all is.
pub(super) fn ask_all(
    draft: &mut Draft,
    answers: &mut dyn BufRead,
    terminal: &mut dyn Write,
) -> Result<(), Failure> {
    say(terminal, "Enter takes the value in brackets.\n\n")?;
    for key in draft.keys() {
        if !draft.is_answered(key) && !draft.is_idle(key) {
            ask(draft, key, answers, terminal)?;
        }
    }
    Ok(())
}

/// Asks a question until there is an answer that is allowed, or Enter.
fn ask(
    draft: &mut Draft,
    key: &'static str,
    answers: &mut dyn BufRead,
    terminal: &mut dyn Write,
) -> Result<(), Failure> {
    let question = draft.question(key)?;
    say(terminal, &asked(&question))?;
    loop {
        say(terminal, &prompt(&question))?;
        let mut line = String::new();
        let count = answers
            .read_line(&mut line)
            .map_err(Failure::at("cannot read from the", Path::new("terminal")))?;
        if count == 0 {
            say(terminal, "\n")?;
            return Err(Failure::Usage(format!(
                "the input ended before {key} was answered: nothing is written\n\
                 hint: --yes takes the usual values, --set {key}=VALUE answers it"
            )));
        }
        let answer = line.trim();
        if answer.is_empty() {
            return say(terminal, "\n");
        }
        match draft.answer(key, answer) {
            Ok(()) => return say(terminal, "\n"),
            Err(error) => say(terminal, &output::in_colours(&format!("error: {error}\n")))?,
        }
    }
}

/// What is asked, with its range.
fn asked(question: &Question) -> String {
    let range = question.range.as_ref().map_or(String::new(), |range| format!(" ({range})"));
    format!("{}: {}{range}\n", question.key, escape::visible(&question.doc))
}

/// The value that Enter gives, and in short why.
fn prompt(question: &Question) -> String {
    let why = question.why.split(", ").next().unwrap_or_default();
    let usual = question.usual.as_ref().map_or_else(
        || format!("left out: {why}"),
        |value| format!("{}: {why}", shown_value(value)),
    );
    format!("  [{}] > ", escape::line(&usual))
}

/// A value as it is typed.
pub(super) fn shown_value(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Number(number) => {
            number.as_f64().map_or_else(|| number.to_string(), |it| it.to_string())
        }
        other => other.to_string(),
    }
}

fn say(terminal: &mut dyn Write, text: &str) -> Result<(), Failure> {
    let written = terminal.write_all(text.as_bytes()).and_then(|()| terminal.flush());
    written.map_err(Failure::at("cannot write to the", Path::new("terminal")))
}

#[cfg(test)]
mod tests {
    use grouser::document::{Kind, Source, checked};

    use super::*;

    /// Asks everything; what is typed, and what the terminal shows.
    fn conversation(kind: Kind, typed: &str) -> (Result<(), Failure>, Draft, String) {
        let mut draft = Draft::new(kind).expect("it has questions");
        let mut shown = Vec::new();
        let done = ask_all(&mut draft, &mut typed.as_bytes(), &mut shown);
        (done, draft, String::from_utf8(shown).expect("UTF-8"))
    }

    #[test]
    fn answers_become_a_document() {
        let typed =
            "Grasshopper\nits data sheet\n12.5\n\n0.09\n0.08\n0.01\n16\n0.5\n0.45\n\n\n\n\n\n";
        let (done, draft, shown) = conversation(Kind::Rover, typed);
        done.expect("all is answered");
        let text = draft.finish().expect("a rover");
        checked(&Source::text("typed", text.clone())).expect("it passes the check");
        for line in ["name = \"Grasshopper\"", "radius_m = 0.09", "count = 16"] {
            assert!(text.contains(line), "{line}\n{text}");
        }
        assert!(
            shown.contains("Mass of the whole rover, with its wheels [kg]. (0.1 to 100000)\n"),
            "{shown}"
        );
        // The wheelbase that was typed is the usual length of the body.
        assert!(shown.contains("\n  [0.5: the wheelbase] > "), "{shown}");
    }

    /// What is no answer is asked again, with the reason.
    #[test]
    fn hostile_answers_are_asked_again() {
        let typed = "Disc\n\nwide\nnan\n-1\n7\n\u{1b}[2J\n0.2\n\n\n\n";
        let (done, draft, shown) = conversation(Kind::Wheel, typed);
        done.expect("at last it is answered");
        assert_eq!(shown.matches("  [0.1: ").count(), 6, "{shown}");
        assert_eq!(shown.matches("error: radius_m = ").count(), 5, "{shown}");
        assert!(shown.contains("it must be 0.01 to 1"), "{shown}");
        assert!(!shown.contains('\u{1b}'), "{shown:?}");
        assert!(draft.finish().expect("a wheel").contains("radius_m = 0.2\n"));
    }

    #[test]
    fn the_end_of_the_input_ends_the_questions() {
        for typed in ["", "Disc", "Disc\n\n0.2\n"] {
            let (done, ..) = conversation(Kind::Wheel, typed);
            let error = done.expect_err("something is unanswered").to_string();
            assert!(error.contains("nothing is written\nhint: --yes"), "{typed:?}: {error}");
        }
    }
}
