//! A campaign as the store sees it: columns, shards, version.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::ops::Range;

use grouser::document::campaign::{Campaign, Column};
use grouser::document::nests_too_deep;
use sha2::{Digest as _, Sha256};

use crate::identity::{ColumnRecord, Identity};

/// The version of the program: another one may compute other numbers.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A campaign as its folder knows it: which one it is, and how its runs are split.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Study {
    pub(crate) name: String,
    pub(crate) text: String,
    pub(crate) hash: String,
    pub(crate) seed: u64,
    pub(crate) runs: u64,
    pub(crate) shard_runs: u64,
    pub(crate) columns: Vec<Column>,
}

impl Study {
    /// The study of a campaign.
    #[must_use]
    pub fn of(campaign: &Campaign) -> Self {
        let text = campaign.resolved().to_owned();
        Self {
            name: campaign.name().to_owned(),
            hash: hex(&Sha256::digest(text.as_bytes())),
            text,
            seed: campaign.seed(),
            runs: campaign.runs(),
            shard_runs: campaign.shard_runs(),
            columns: campaign.columns().to_vec(),
        }
    }

    /// SHA-256 of the resolved study: its name among all studies.
    #[must_use]
    pub fn hash(&self) -> &str {
        &self.hash
    }

    /// How many shards there are.
    #[must_use]
    pub fn shards(&self) -> u64 {
        self.runs.div_ceil(self.shard_runs.max(1))
    }

    /// What a shard's file has to say of itself.
    #[must_use]
    pub fn identity(&self, shard: u64) -> Identity {
        let runs = self.runs_of(shard);
        Identity {
            study_sha256: self.hash.clone(),
            version: VERSION.to_owned(),
            shard,
            rows: runs.end - runs.start,
            columns: self.columns.iter().map(ColumnRecord::from).collect(),
        }
    }

    /// The runs of a shard.
    #[must_use]
    pub fn runs_of(&self, shard: u64) -> Range<u64> {
        let start = shard.saturating_mul(self.shard_runs).min(self.runs);
        start..start.saturating_add(self.shard_runs).min(self.runs)
    }
}

/// SHA-256 of bytes, as `sha256sum` prints it.
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

/// Bytes as the hexadecimal digits that `sha256sum` prints.
pub(crate) fn hex(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(2 * bytes.len());
    for byte in bytes {
        // Writing to a string does not fail.
        let _ = write!(text, "{byte:02x}");
    }
    text
}

/// Which keys of two resolved studies differ, in words.
///
/// * `theirs`: what the folder has
/// * `ours`: what is asked for
#[must_use]
pub fn difference(theirs: &str, ours: &str) -> String {
    /// How many keys are reported; more do not help to find the mistake.
    const SHOWN: usize = 3;
    let (theirs, ours) = (flat(theirs), flat(ours));
    let none = || "absent".to_owned();
    let mut differing = Vec::new();
    for key in theirs.keys().chain(ours.keys().filter(|key| !theirs.contains_key(*key))) {
        if theirs.get(key) != ours.get(key) {
            let value = |of: &BTreeMap<String, String>| of.get(key).cloned().unwrap_or_else(none);
            differing.push(format!("{key} is {} there, {} here", value(&theirs), value(&ours)));
        }
    }
    // Changed values bring words about themselves along.
    differing.sort_by_key(|words| words.contains("assumed."));
    let more = differing.len().saturating_sub(SHOWN);
    differing.truncate(SHOWN);
    match (differing.is_empty(), more) {
        (true, _) => "its study.toml was changed".to_owned(),
        (false, 0) => differing.join("; "),
        (false, more) => format!("{}; and {more} more keys", differing.join("; ")),
    }
}

/// The values of a document by their dotted keys, as TOML writes them.
fn flat(text: &str) -> BTreeMap<String, String> {
    let mut values = BTreeMap::new();
    if !nests_too_deep(text)
        && let Ok(table) = text.parse::<toml::Table>()
    {
        flatten("", &toml::Value::Table(table), &mut values);
    }
    values
}

fn flatten(key: &str, value: &toml::Value, into: &mut BTreeMap<String, String>) {
    let below = |step: &str| if key.is_empty() { step.to_owned() } else { format!("{key}.{step}") };
    match value {
        toml::Value::Table(table) => {
            for (step, value) in table {
                flatten(&below(step), value, into);
            }
        }
        toml::Value::Array(values) => {
            for (place, value) in values.iter().enumerate() {
                flatten(&below(&place.to_string()), value, into);
            }
        }
        value => {
            into.insert(key.to_owned(), value.to_string());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_keys_that_changed_are_told() {
        let theirs = "runs = 10\n[soil]\nn = 1.5\n[[parameter]]\nkey = \"a\"\n";
        assert_eq!(
            difference(theirs, &theirs.replace("1.5", "1.25").replace("\"a\"", "\"b\"")),
            "parameter.0.key is \"a\" there, \"b\" here; soil.n is 1.5 there, 1.25 here"
        );
        assert_eq!(
            difference("a = 1\n", "b = 1\n"),
            "a is 1 there, absent here; b is absent there, 1 here"
        );
        let many: String = (0..9).map(|key| format!("k{key} = 1\n")).collect();
        assert!(difference(&many, "").ends_with("; and 6 more keys"));
    }
}
