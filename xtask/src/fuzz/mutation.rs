//! Mutations: damage to the input of a case.

use fastrand::Rng;

use super::damage::{damage, word};
use super::subjects::{Oracle, Subject};

/// Markup that must not reach a page as markup.
pub(super) const MARK: &str = "<b id=x>";

/// Damages a subject at one to three places, mostly in one of its files.
pub(super) fn mutate(subject: &mut Subject, dice: &mut Rng) {
    let guarded = matches!(subject.oracle, Oracle::Unchanged { .. });
    for _ in 0..if guarded { 1 } else { 1 + dice.usize(..3) / 2 } {
        let count = subject.files.len();
        if guarded {
            damage_bytes(&mut subject.files, dice);
        } else if count > 0 && dice.u8(..10) < 7 {
            damage(&mut subject.files[dice.usize(..count)].1, dice);
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
