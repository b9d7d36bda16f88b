//! Counts of the samples of a band that ended early: a column for each way, made from the table of
//! outcomes.

use super::{Column, whole};
use crate::simulation::{InBand, OutcomeKind};
use crate::studies::traverse_band::RunBand;

/// Count of the samples that ended in one way: `draws_off_map`.
///
/// * `KIND`: place in [`OutcomeKind::ALL`]
pub(super) const fn draws_ended<const KIND: usize>() -> Column<RunBand> {
    whole(Ended::<KIND>::NAME, Ended::<KIND>::DOC, |it| Some(it.ends.count(OutcomeKind::ALL[KIND])))
}

/// Name and description of the column that counts the samples which ended in one way, from its row
/// of the table.
struct Ended<const KIND: usize>;

impl<const KIND: usize> Ended<KIND> {
    const NAME: &'static str =
        joined(&Self::NAME_TEXT, ["draws_", OutcomeKind::ALL[KIND].row().name]);
    const DOC: &'static str =
        joined(&Self::DOC_TEXT, ["Samples that ended so: ", OutcomeKind::ALL[KIND].row().meaning]);
    const NAME_TEXT: [u8; LONGEST] = bytes(["draws_", OutcomeKind::ALL[KIND].row().name]);
    const DOC_TEXT: [u8; LONGEST] =
        bytes(["Samples that ended so: ", OutcomeKind::ALL[KIND].row().meaning]);
}

/// Longest text that is joined [bytes]; a longer one does not compile.
const LONGEST: usize = 160;

/// Bytes of two texts, one after the other.
const fn bytes(parts: [&str; 2]) -> [u8; LONGEST] {
    let mut all = [0; LONGEST];
    let (mut part, mut place) = (0, 0);
    while part < 2 {
        let text = parts[part].as_bytes();
        let mut at = 0;
        while at < text.len() {
            all[place] = text[at];
            (at, place) = (at + 1, place + 1);
        }
        part += 1;
    }
    all
}

/// Two texts as one, whose [`bytes`] are given.
const fn joined(bytes: &'static [u8; LONGEST], [first, second]: [&str; 2]) -> &'static str {
    match std::str::from_utf8(bytes.split_at(first.len() + second.len()).0) {
        Ok(text) => text,
        Err(_) => panic!("two texts are one text"),
    }
}

// A way in which runs can end early without a column does not compile.
const _: () = {
    let mut early = 0;
    let mut place = 0;
    while place < OutcomeKind::ALL.len() {
        let row = OutcomeKind::ALL[place].row();
        early += (row.ends_runs && !matches!(row.in_band, InBand::Counts)) as usize;
        place += 1;
    }
    assert!(early == 6);
};
