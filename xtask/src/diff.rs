//! A difference between two texts, for people.

use std::borrow::Cow;

use similar::{ChangeTag, TextDiff};

/// Longer stretches and lines are cut: the reader runs the chore anyway.
const MOST_LINES: usize = 80;
const MOST_CHARACTERS: usize = 300;

/// The lines that differ, with `-` for those that stand there and `+` for those that should; empty
/// if none do.
pub(crate) fn between(is: &str, should: &str) -> String {
    let difference = TextDiff::from_lines(is, should);
    let differing = difference.iter_all_changes().filter(|change| change.tag() != ChangeTag::Equal);
    let mut lines: Vec<String> = differing
        .map(|change| format!("{} {}", change.tag(), cut(change.value().trim_end_matches('\n'))))
        .collect();
    let more = lines.len().saturating_sub(MOST_LINES);
    lines.truncate(MOST_LINES);
    lines.extend((more > 0).then(|| format!("… {more} more lines")));
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
