//! Outcomes are one table: the documents have its rows, and no source names an outcome by hand.

use std::fs;
use std::path::{Path, PathBuf};

use grouser::simulation::{InBand, OutcomeKind, Severity};

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

#[test]
fn the_conventions_have_the_table_of_outcomes() {
    let text = fs::read_to_string(repository().join("docs/conventions.md")).expect("a document");
    for kind in OutcomeKind::ALL {
        let row = kind.row();
        let (severity, in_band) = (row.severity.name(), row.in_band.name());
        let line = format!("| `{}` | {} | {severity} | {in_band} |\n", row.name, row.meaning);
        assert!(text.contains(&line), "{line}");
    }
}

/// Only a rover that is stuck counts as slip 1; all that is not good ends the run for the band.
#[test]
fn an_end_that_is_not_good_is_stuck_or_leaves_a_band() {
    for kind in OutcomeKind::ALL {
        let row = kind.row();
        assert_eq!(row.severity == Severity::Good, row.in_band == InBand::Counts, "{}", row.name);
        assert_eq!(row.in_band == InBand::Stuck, kind == OutcomeKind::Immobilised, "{}", row.name);
    }
}

/// Sources under a folder, with their texts.
fn sources(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let is_source = path.extension().is_some_and(|end| end == "rs" || end == "py");
        if path.is_dir() {
            found.extend(sources(&path));
        } else if is_source {
            let text = fs::read_to_string(&path).expect("a source is text");
            found.push((path, text));
        }
    }
    found
}

/// Names that nothing else has.
const OWN: [OutcomeKind; 5] = [
    OutcomeKind::FellShort,
    OutcomeKind::TippedOver,
    OutcomeKind::BrownOut,
    OutcomeKind::OffTheMap,
    OutcomeKind::HighCentred,
];

#[test]
fn no_source_names_an_outcome_beside_the_table() {
    let crates = fs::read_dir(repository().join("crates")).expect("a folder");
    let folders = crates.map(|entry| entry.expect("an entry").path());
    let folders = folders.flat_map(|path| [path.join("src"), path.join("python")]);
    for (path, text) in folders.filter(|path| path.is_dir()).flat_map(|path| sources(&path)) {
        for kind in OWN.map(|kind| format!("\"{}\"", kind.name())) {
            let is_home = path.ends_with("simulation/outcome_kind.rs");
            assert!(is_home || !text.contains(&kind), "{kind} in {}", path.display());
        }
    }
}
