//! Text from outside made safe to show: names, cells and keys of files may hold characters that
//! steer a terminal, turn the direction of writing, or start a formula in a spreadsheet.
//!
//! What an application prints goes through [`visible`], what stands on one line through [`line()`],
//! a cell of CSV through [`cell`], which [`plain`] takes back. JSON escapes by itself.

use std::borrow::Cow;
use std::path::Path;

/// Whether a character does something else than show itself: control characters, line separators,
/// marks that change the direction of writing, tags, and what XML forbids.
#[must_use]
pub fn is_hidden(character: char) -> bool {
    character.is_control()
        || matches!(
            character,
            '\u{61c}'
                | '\u{200e}'..='\u{200f}'
                | '\u{2028}'..='\u{202e}'
                | '\u{2066}'..='\u{2069}'
                | '\u{feff}'
                | '\u{fff9}'..='\u{fffb}'
                | '\u{fffe}'..='\u{ffff}'
                | '\u{e0000}'..='\u{e007f}'
        )
}

/// A text of several lines with its hidden characters written out, such as `\u{1b}`; line feeds and
/// tabs stay.
#[must_use]
pub fn visible(text: &str) -> Cow<'_, str> {
    written_out(text, |character| matches!(character, '\n' | '\t'))
}

/// A text on one line: line feeds and tabs are written out too, as `\n` and `\t`.
#[must_use]
pub fn line(text: &str) -> Cow<'_, str> {
    written_out(text, |_| false)
}

/// A path on one line, as messages show it.
#[must_use]
pub fn path(path: &Path) -> String {
    line(&path.display().to_string()).into_owned()
}

/// [`line()`] with no more than some characters; what is longer ends in `…`.
#[must_use]
pub fn short_line(text: &str, most: usize) -> String {
    let mut characters = text.chars();
    let start: String = characters.by_ref().take(most).collect();
    let more = if characters.next().is_some() { "…" } else { "" };
    line(&start).into_owned() + more
}

fn written_out(text: &str, is_kept: impl Fn(char) -> bool) -> Cow<'_, str> {
    let is_shown = |character: char| !is_hidden(character) || is_kept(character);
    if text.chars().all(is_shown) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 16);
    for character in text.chars() {
        if is_shown(character) {
            shown.push(character);
        } else {
            shown.extend(character.escape_default());
        }
    }
    Cow::Owned(shown)
}

/// A text as a cell of CSV: on one line, and never a formula.
///
/// Spreadsheets compute cells that begin with `=`, `+`, `-` or `@`, in either width; an apostrophe
/// before it makes the cell a text. Numbers stay as they are. [`plain`] takes the apostrophe away.
///
/// Source: OWASP, "CSV Injection".
#[must_use]
pub fn cell(text: &str) -> Cow<'_, str> {
    let text = line(text);
    if starts_a_formula(&text) && text.parse::<f64>().is_err() {
        Cow::Owned(format!("'{text}"))
    } else {
        text
    }
}

/// A cell of CSV without the apostrophe that [`cell`] put before it.
#[must_use]
pub fn plain(cell: &str) -> &str {
    cell.strip_prefix('\'').filter(|rest| starts_a_formula(rest)).unwrap_or(cell)
}

/// Apostrophes before it do not count, so that none is lost on the way out and back.
fn starts_a_formula(text: &str) -> bool {
    let start = text.trim_start_matches('\'').chars().next();
    matches!(start, Some('=' | '+' | '-' | '@' | '＝' | '＋' | '－' | '＠'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hidden_characters_are_written_out() {
        assert_eq!(visible("a\u{1b}[31mb\tc\nd\u{202e}e"), "a\\u{1b}[31mb\tc\nd\\u{202e}e");
        assert_eq!(line("a\nb\rc\0\u{9b}"), "a\\nb\\rc\\u{0}\\u{9b}");
        assert!(matches!(line("φρ 25° 砂 – “ok”"), Cow::Borrowed(_)));
        assert_eq!(short_line("ab\ncd", 3), "ab\\n…");
    }

    #[test]
    fn no_cell_is_a_formula_and_each_returns() {
        for (text, expected) in [
            ("=1+1", "'=1+1"),
            ("@x", "'@x"),
            ("-cmd|' /C calc'!A0", "'-cmd|' /C calc'!A0"),
            ("-5.5", "-5.5"),
            ("+3e2", "+3e2"),
            ("'=x", "''=x"),
            ("'quoted'", "'quoted'"),
            ("＝1", "'＝1"),
        ] {
            assert_eq!(cell(text), expected);
            assert_eq!(plain(expected), text);
        }
        // A tab or a return before the formula is written out, and starts none.
        assert_eq!(cell("\t=1"), "\\t=1");
        assert_eq!(cell("\r=1"), "\\r=1");
    }
}
