//! Flags as errors, for those who accept no extrapolation.

use std::fmt;

use super::columns::flags::in_words;
use crate::contact::validity::{Finding, Flag};

/// Rows that carry flags where none is accepted: each flag with its first row, value and range.
#[derive(Clone, Debug, PartialEq)]
pub struct OutsideDomain {
    /// Each flag once, in the order of the list.
    pub flags: Vec<FlaggedRow>,
}

/// A flag, and the first row that carries it.
#[derive(Clone, Debug, PartialEq)]
pub struct FlaggedRow {
    /// The flag, with the row's value and range.
    pub finding: Finding,
    /// The row, in words.
    pub row: String,
    /// How many rows carry it.
    pub rows: usize,
}

impl OutsideDomain {
    /// Checks that no row carries a flag.
    ///
    /// * `rows`: the flags of each row
    /// * `name`: what a row is called, by its place: `row 3: load_n 17`
    ///
    /// # Errors
    /// [`OutsideDomain`] with all flags that any row carries.
    pub fn check<'f>(
        rows: impl IntoIterator<Item = &'f [Finding]>,
        name: impl Fn(usize) -> String,
    ) -> Result<(), Self> {
        let mut flags: Vec<FlaggedRow> = Vec::new();
        for (place, findings) in rows.into_iter().enumerate() {
            for finding in findings {
                match flags.iter_mut().find(|it| it.finding.flag == finding.flag) {
                    Some(known) => known.rows += 1,
                    None => {
                        flags.push(FlaggedRow { finding: *finding, row: name(place), rows: 1 });
                    }
                }
            }
        }
        flags.sort_by_key(|it| it.finding.flag);
        if flags.is_empty() { Ok(()) } else { Err(Self { flags }) }
    }

    /// The flags, in the order of the list.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.flags.iter().map(|it| it.finding.flag.name())
    }
}

impl fmt::Display for OutsideDomain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "results are outside the domain of the model or the soil")?;
        for FlaggedRow { finding, row, rows } in &self.flags {
            write!(f, "\n{row}: {}", in_words(finding))?;
            match rows - 1 {
                0 => {}
                1 => write!(f, " (and 1 more row)")?,
                more => write!(f, " (and {more} more rows)")?,
            }
        }
        Ok(())
    }
}

impl std::error::Error for OutsideDomain {}

/// All flags as the rows of a table in Markdown: name, meaning, rule, whether a verdict may rest on a
/// result that carries it, and source.
#[must_use]
pub fn list() -> String {
    let row = |flag: Flag| {
        let rule = flag.rule();
        let drive = if rule.forbids_driving { "no" } else { "yes" };
        let [what, raised, source] = [rule.meaning, rule.criterion, rule.source];
        format!("| `{}` | {what} | {raised} | {drive} | {source} |\n", rule.name)
    };
    let head = "| flag | what it means | raised where | a verdict may rest on it | source |\n\
                |---|---|---|---|---|\n";
    std::iter::once(head.to_owned()).chain(Flag::ALL.map(row)).collect()
}
