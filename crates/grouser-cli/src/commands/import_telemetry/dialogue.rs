//! Which topic is meant, asked on a terminal.

use std::io::{BufRead, Write};
use std::path::Path;

use grouser::document::escape;

use crate::failure::Failure;

/// Asks until one of the topics is chosen.
///
/// * `what`: the type of messages that several topics have
pub(super) fn ask(
    what: &str,
    topics: &[String],
    answers: &mut dyn BufRead,
    terminal: &mut dyn Write,
) -> Result<String, Failure> {
    let list = (1..).zip(topics).map(|(number, topic)| format!("  {number}: {topic}\n"));
    let question =
        format!("Which topic has the {what} that is meant?\n{}", list.collect::<String>());
    say(terminal, &escape::visible(&question))?;
    loop {
        say(terminal, &format!("  [1 to {}] > ", topics.len()))?;
        let mut line = String::new();
        let count = answers
            .read_line(&mut line)
            .map_err(Failure::at("cannot read from the", Path::new("terminal")))?;
        if count == 0 {
            say(terminal, "\n")?;
            let what = escape::line(what);
            return Err(Failure::Usage(format!(
                "the input ended before a topic was chosen: nothing is written\n\
                 hint: --topic {what}=TOPIC chooses it"
            )));
        }
        let answer = line.trim();
        let by_number = answer.parse::<usize>().ok().and_then(|it| topics.get(it.checked_sub(1)?));
        if let Some(topic) = by_number.or_else(|| topics.iter().find(|topic| *topic == answer)) {
            return Ok(topic.clone());
        }
    }
}

fn say(terminal: &mut dyn Write, text: &str) -> Result<(), Failure> {
    let written = terminal.write_all(text.as_bytes()).and_then(|()| terminal.flush());
    written.map_err(Failure::at("cannot write to the", Path::new("terminal")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answered(typed: &str) -> (Result<String, Failure>, String) {
        let topics = ["/imu/front".to_owned(), "/imu/\u{1b}[2Jrear".to_owned()];
        let mut shown = Vec::new();
        let answer = ask("sensor_msgs/Imu", &topics, &mut typed.as_bytes(), &mut shown);
        (answer, String::from_utf8(shown).expect("UTF-8"))
    }

    #[test]
    fn a_topic_is_chosen_by_number_or_name_and_asked_for_again() {
        for typed in ["1\n", "/imu/front\n", "0\n3\nfront\n-1\n\n1\n"] {
            let (answer, shown) = answered(typed);
            assert_eq!(answer.expect("it is chosen"), "/imu/front", "{typed:?}");
            assert_eq!(shown.matches("[1 to 2] > ").count(), typed.lines().count(), "{shown}");
            assert!(!shown.contains('\u{1b}'), "{shown:?}");
        }
        let error = answered("7\n").0.expect_err("nothing is chosen").to_string();
        assert!(error.contains("--topic sensor_msgs/Imu=TOPIC"), "{error}");
    }
}
