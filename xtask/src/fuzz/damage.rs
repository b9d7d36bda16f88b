//! Damage to the content of a file, for the program's files and for its readers alike:
//! `crates/grouser-logs/examples/read_anything` has this file too.

use fastrand::Rng;

/// Words and numbers that are likely to be wrong where they come.
const WORDS: [&str; 40] = [
    "",
    "-",
    "--",
    "0",
    "-1",
    "-0.0",
    "1e400",
    "-1e-400",
    "nan",
    "inf",
    "-inf",
    "1e308",
    "9223372036854775808",
    "0.1.2",
    "1_000",
    "0:1:0.1",
    "0:1e18:1",
    "::",
    ",",
    "[",
    "{",
    "\"",
    "'",
    "'''",
    "#",
    "=",
    "=1+1",
    "@sum(1)",
    "true",
    "[[x]]",
    "soil/1",
    "\u{1b}[31mred",
    "\u{202e}desrever",
    "\u{9b}2J",
    "<b id=x>&\"'",
    "]]></text>",
    "</script>",
    "\u{fffd}",
    "a b",
    "x\ny",
];

/// Damages a content at one place: as text if it is text.
pub(crate) fn damage(content: &mut Vec<u8>, dice: &mut Rng) {
    if std::str::from_utf8(content).is_ok() {
        damage_text(content, dice);
    } else {
        damage_binary(content, dice);
    }
}

/// Damage of a file that is no text: a bit, a byte, or a number of two or four bytes, mostly in its
/// header; or its length.
fn damage_binary(content: &mut Vec<u8>, dice: &mut Rng) {
    /// Headers are no longer than this, mostly [bytes].
    const HEADER: usize = 600;
    let reach = if dice.u8(..3) > 0 { content.len().min(HEADER) } else { content.len() };
    if reach < 5 {
        return scramble(content, dice);
    }
    let at = dice.usize(..reach - 4);
    match dice.u8(..8) {
        0..3 => content[at] ^= 1 << dice.u8(..8),
        3 => content[at] = dice.u8(..),
        4 => content[at..at + 2].copy_from_slice(&[0xff, 0xff]),
        5 => content[at..at + 4].copy_from_slice(&dice.u32(..).to_le_bytes()),
        6 => content[at..at + 4].fill(0),
        _ => scramble(content, dice),
    }
}

/// Damage as authors do it: a token, a line, a cell; now and then bytes.
fn damage_text(content: &mut Vec<u8>, dice: &mut Rng) {
    if content.is_empty() || dice.u8(..10) == 0 {
        return scramble(content, dice);
    }
    let text = String::from_utf8_lossy(content).into_owned();
    let changed = match dice.u8(..8) {
        0..5 => with_token_replaced(&text, dice),
        5 => with_line_moved(&text, dice),
        6 => with_column_changed(&text, dice),
        _ => with_text_inserted(&text, dice),
    };
    *content = changed.into_bytes();
}

fn scramble(content: &mut Vec<u8>, dice: &mut Rng) {
    let at = dice.usize(..=content.len());
    match dice.u8(..4) {
        0 => content.truncate(at),
        1 => content.insert(at, dice.u8(..)),
        2 if at < content.len() => content[at] ^= 1 << dice.u8(..8),
        _ => {
            let piece: Vec<u8> = content[..at].iter().copied().take(4_096).collect();
            content.extend(piece);
        }
    }
}

/// A word that is likely to be wrong, a number of any bits, or a very long word.
pub(crate) fn word(dice: &mut Rng) -> String {
    match dice.u8(..12) {
        0 => "a".repeat(1 << dice.u8(8..17)),
        1 => format!("{:e}", f64::from_bits(dice.u64(..))),
        _ => WORDS[dice.usize(..WORDS.len())].to_owned(),
    }
}

/// A number, a key or a word of a text, given another value.
fn with_token_replaced(text: &str, dice: &mut Rng) -> String {
    let is_part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | '-' | '+');
    let mut tokens = Vec::new();
    let mut start = None;
    for (at, c) in text.char_indices().chain([(text.len(), ' ')]) {
        match (is_part(c), start) {
            (true, None) => start = Some(at),
            (false, Some(from)) => {
                tokens.push(from..at);
                start = None;
            }
            _ => {}
        }
    }
    if tokens.is_empty() {
        return word(dice);
    }
    let token = tokens[dice.usize(..tokens.len())].clone();
    let new = match text[token.clone()].parse::<f64>() {
        // A number that is only a little wrong gets further.
        Ok(number) if dice.bool() => {
            let factors = [-1.0, 0.0, 1e-3, 0.5, 1.5, 10.0, 1e3, 1e9];
            format!("{:?}", number * factors[dice.usize(..factors.len())])
        }
        _ => word(dice),
    };
    format!("{}{new}{}", &text[..token.start], &text[token.end..])
}

/// A line left out, doubled, moved, or repeated many times.
fn with_line_moved(text: &str, dice: &mut Rng) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let (one, other) = (dice.usize(..lines.len().max(1)), dice.usize(..lines.len().max(1)));
    if lines.is_empty() {
        return String::new();
    }
    match dice.u8(..4) {
        0 => drop(lines.remove(one)),
        1 => lines.insert(other, lines[one]),
        2 => lines.swap(one, other),
        _ => {
            let line = lines[one];
            let times = 1 << dice.u8(4..13);
            lines.splice(one..one, std::iter::repeat_n(line, times));
        }
    }
    lines.join("\n") + "\n"
}

/// A column of a table left out or doubled in every line.
fn with_column_changed(text: &str, dice: &mut Rng) -> String {
    let column = dice.usize(..8);
    let double = dice.bool();
    let line = |line: &str| {
        let mut cells: Vec<&str> = line.split(',').collect();
        if column < cells.len() {
            if double {
                cells.insert(column, cells[column]);
            } else {
                cells.remove(column);
            }
        }
        cells.join(",") + "\n"
    };
    text.lines().map(line).collect()
}

fn with_text_inserted(text: &str, dice: &mut Rng) -> String {
    let mut at = dice.usize(..=text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    format!("{}{}{}", &text[..at], word(dice), &text[at..])
}
