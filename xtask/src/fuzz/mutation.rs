//! Mutations: damage to the input of a case.

use fastrand::Rng;

use super::subjects::{Oracle, Subject};

/// Markup that must not reach a page as markup.
pub(super) const MARK: &str = "<b id=x>";

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

/// Damages a subject at one to three places, mostly in one of its files.
pub(super) fn mutate(subject: &mut Subject, dice: &mut Rng) {
    let guarded = matches!(subject.oracle, Oracle::Unchanged { .. });
    for _ in 0..if guarded { 1 } else { 1 + dice.usize(..3) / 2 } {
        let count = subject.files.len();
        if guarded {
            damage_bytes(&mut subject.files, dice);
        } else if count > 0 && dice.u8(..10) < 7 {
            let file = &mut subject.files[dice.usize(..count)].1;
            if std::str::from_utf8(file).is_ok() {
                damage_text(file, dice);
            } else {
                damage_binary(file, dice);
            }
        } else {
            damage_line(&mut subject.words, dice);
        }
    }
}

/// Damage as disks and hands do it: a bit, a piece, the end, another file in its place, two
/// exchanged.
fn damage_bytes(files: &mut [(String, Vec<u8>)], dice: &mut Rng) {
    let at = dice.usize(..files.len());
    let other = dice.usize(..files.len());
    let content = &mut files[at].1;
    let length = content.len().max(1);
    match dice.u8(..10) {
        0..6 if !content.is_empty() => content[dice.usize(..length)] ^= 1 << dice.u8(..8),
        6 => content.truncate(dice.usize(..length)),
        7 if !content.is_empty() => {
            let start = dice.usize(..length);
            let end = (start + dice.usize(1..64)).min(length);
            content[start..end].fill(dice.u8(..));
        }
        8 => {
            let copy = files[other].1.clone();
            files[at].1 = copy;
        }
        _ => {
            let (one, two) = (files[at].1.clone(), files[other].1.clone());
            (files[at].1, files[other].1) = (two, one);
        }
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

fn word(dice: &mut Rng) -> String {
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

/// One change of a command line: a word left out, put in, doubled, swapped, or changed within.
fn damage_line(words: &mut Vec<String>, dice: &mut Rng) {
    // What comes after the command is where there is more to go wrong.
    let at = dice.usize(..words.len()).max(dice.usize(..words.len()));
    match dice.u8(..8) {
        0 if words.len() > 1 => drop(words.remove(at)),
        1 => words.insert(at, without_zero(&word(dice))),
        2 => words.insert(at, words[at].clone()),
        3 => {
            let other = dice.usize(..words.len());
            words.swap(at, other);
        }
        4 | 5 => words[at] = without_zero(&word(dice)),
        _ => {
            let mut letters: Vec<char> = words[at].chars().collect();
            if let Some(place) = dice.choice(0..letters.len()) {
                letters[place] = ['-', '.', '9', '0', '1', '5', ',', 'e', 'µ'][dice.usize(..9)];
            }
            words[at] = letters.into_iter().collect();
        }
    }
}

/// An argument as a system takes it: without NUL, and shorter than the longest.
fn without_zero(word: &str) -> String {
    word.replace('\0', "0").chars().take(60_000).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A map of heights stays one, but for a few bytes: text would lose every byte that is not
    /// UTF-8.
    #[test]
    fn binary_files_are_damaged_in_few_bytes() {
        let content: Vec<u8> = (0..2_000_u32).flat_map(|cell| (cell << 23).to_be_bytes()).collect();
        let mut small = 0;
        for seed in 0..500 {
            let file = ("map.tif".to_owned(), content.clone());
            let mut subject = Subject {
                name: "stand-in",
                words: vec!["read".into(), "map.tif".into()],
                files: vec![file],
                oracle: Oracle::Sane,
            };
            mutate(&mut subject, &mut Rng::with_seed(seed));
            let damaged = &subject.files[0].1;
            let changed = content.iter().zip(damaged).filter(|(one, other)| one != other).count();
            small += usize::from(damaged.len() == content.len() && (1..=8).contains(&changed));
        }
        assert!(small > 200, "{small} of 500 are damaged so");
    }
}
