//! Looks for numbers that are not finite.

use std::fmt::Debug;

use crate::readers::Outcome;

/// What was read, if all its numbers are finite; texts in it may say what they like.
pub(crate) fn finite(read: &impl Debug) -> Outcome {
    let shown = format!("{read:?}");
    // The pieces outside of quotation marks, between which a mark after a backslash is a character.
    let mut is_text = false;
    for (place, piece) in pieces(&shown) {
        let is_found = |at: &usize| !is_text && is_not_finite(&piece[*at..]);
        let mut starts = piece.match_indices(['N', 'i']).map(|(at, _)| at);
        if let Some(at) = starts.find(is_found).map(|at| place + at) {
            let start = shown[..at].char_indices().rev().nth(80).map_or(0, |(start, _)| start);
            let around: String = shown[start..].chars().take(120).collect();
            return Outcome::Wrong(format!("not finite: {around}"));
        }
        is_text = !is_text;
    }
    Outcome::Read
}

/// Whether a text begins with such a number, and no longer word.
fn is_not_finite(text: &str) -> bool {
    let rest = ["NaN", "inf"].into_iter().find_map(|word| text.strip_prefix(word));
    rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
}

/// The pieces of a text between quotation marks, each with where it starts.
fn pieces(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut ends = Vec::new();
    let mut is_escaped = false;
    for (place, byte) in text.bytes().enumerate() {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' => is_escaped = true,
            b'"' => ends.push(place),
            _ => {}
        }
    }
    let starts = std::iter::once(0).chain(ends.clone().into_iter().map(|end| end + 1));
    let ends = ends.into_iter().chain([text.len()]);
    starts.zip(ends).map(|(start, end)| (start, &text[start..end])).collect::<Vec<_>>().into_iter()
}
