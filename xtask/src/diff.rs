//! A difference between two texts, for people.

use std::borrow::Cow;

/// Longer stretches and lines are cut: the reader runs the chore anyway.
const MOST_LINES: usize = 40;
const MOST_CHARACTERS: usize = 300;

/// The lines that differ, with `-` for those that stand there and `+` for those that should; empty
/// if none do. Only the stretch from the first difference to the last is shown.
pub(crate) fn between(is: &str, should: &str) -> String {
    let (is, should): (Vec<&str>, Vec<&str>) = (is.lines().collect(), should.lines().collect());
    let head = is.iter().zip(&should).take_while(|(a, b)| a == b).count();
    let (is_rest, should_rest) = (&is[head..], &should[head..]);
    let tail =
        is_rest.iter().rev().zip(should_rest.iter().rev()).take_while(|(a, b)| a == b).count();
    let mut lines = Vec::new();
    for (sign, rest) in [('-', is_rest), ('+', should_rest)] {
        let differing = &rest[..rest.len() - tail];
        lines.extend(differing.iter().take(MOST_LINES).map(|line| format!("{sign} {}", cut(line))));
        if differing.len() > MOST_LINES {
            lines.push(format!("{sign} … {} more lines", differing.len() - MOST_LINES));
        }
    }
    lines.join("\n")
}

/// A line, or its start and what is missing.
fn cut(line: &str) -> Cow<'_, str> {
    let more = line.chars().count().saturating_sub(MOST_CHARACTERS);
    if more == 0 {
        return line.into();
    }
    let start: String = line.chars().take(MOST_CHARACTERS).collect();
    format!("{start} … {more} more characters").into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_lines_that_differ_are_shown() {
        assert_eq!(between("a\nb\nc\n", "a\nB\nBB\nc\n"), "- b\n+ B\n+ BB");
        assert_eq!(between("a\n", "a\n"), "");
        assert_eq!(between("", "a\n"), "+ a");
        let drawing = "x".repeat(302);
        assert!(between("", &drawing).ends_with("x … 2 more characters"));
    }
}
