//! What a drive taught, in words.

use std::collections::BTreeMap;

use super::question::LearntDrive;
use crate::document::columns::learn::{contradiction_in_words, sentence};
use crate::document::columns::verdict::in_words;
use crate::document::columns::{SLIP_RATIO, SLOPE, YAW};
use crate::document::reading::{counted, four_digits};
use crate::document::table::Table;
use crate::studies::learn::{Learner, Warning};

/// The wheel–soil models with their shares [-], by their names.
#[must_use]
pub fn shares(learner: &Learner) -> BTreeMap<&'static str, f64> {
    learner.models().shares().iter().map(|(model, share)| (model.name(), *share)).collect()
}

/// What one slope comes to, for a sentence: yaw and slip with their bands; nothing where the slip
/// is not known.
///
/// * `table`: of [`predictions`](crate::document::columns::learn::predictions)
#[must_use]
pub fn slope_in_words(table: &Table, row: usize) -> Option<String> {
    let number = |name: &str| table.numbers(name).get(row).copied().flatten();
    let [yaw_low, _, yaw_high] = YAW.quantiles();
    let [slip_low, _, slip_high] = SLIP_RATIO.quantiles();
    let slope = number(SLOPE.name)?;
    let yaw = number(YAW.name).zip(number(&yaw_low)).zip(number(&yaw_high));
    let yaw = yaw.map_or_else(
        || "no heading holds the contour".to_owned(),
        |((median, low), high)| format!("the heading is {median:.1}° ({low:.1}° to {high:.1}°)"),
    );
    let slip = number(SLIP_RATIO.name)?;
    let (low, high) = (number(&slip_low)?, number(&slip_high)?);
    Some(format!(
        "on {}° {yaw}, the slip ratio {slip:.2} ({low:.2} to {high:.2})",
        four_digits(slope)
    ))
}

/// A warning as a line.
#[must_use]
pub fn warning_in_words(warning: &Warning) -> String {
    let lead = match (warning.lead_way, warning.lead_time) {
        (Some(way), Some(time)) if way > 0.0 => format!(", {way:.1} m and {time:.0} s ahead"),
        _ => String::new(),
    };
    format!(
        "warning: {} after {:.1} m at {:.0} s{lead}: {}",
        warning.kind.name(),
        warning.way,
        warning.time,
        sentence(&warning.evidence)
    )
}

/// What was learnt from, what to warn of, and notes: a line each.
pub(super) fn lines(found: &LearntDrive) -> Vec<String> {
    let learner = found.drive.learner();
    let (learnt, models) = (learner.learnt(), shares(learner));
    let models: Vec<String> =
        models.iter().map(|(name, share)| format!("{name} {:.0} %", 100.0 * share)).collect();
    let whole = format!(
        "learnt from {}, {} m of the wheels' way, in {}; models: {}",
        counted(learnt.stretches, "stretch", "stretches"),
        four_digits(learnt.way),
        counted(learnt.records, "record", "records"),
        models.join(", ")
    );
    let narrowed: Vec<String> = found
        .narrowed
        .iter()
        .map(|(key, share)| format!("{key} {:.0} %", 100.0 * share.min(1.0)))
        .collect();
    let narrowed = format!("what is left of the uncertainty: {}", narrowed.join(", "));
    let notes = found.notes.iter().map(|note| format!("note: {note}"));
    let warnings = found.drive.warnings().iter().map(warning_in_words);
    // Gross faults are among the warnings.
    let contradictions = learner.contradictions();
    let contradictions =
        contradictions.iter().map(|it| format!("warning: {}", contradiction_in_words(it)));
    [verdicts(found), whole, narrowed]
        .into_iter()
        .chain(warnings)
        .chain(contradictions)
        .chain(notes)
        .collect()
}

/// What to do on each slope; by what was known before, where nothing was learnt.
pub(super) fn verdicts(found: &LearntDrive) -> String {
    let words = in_words(&found.verdicts);
    if found.drive.learner().learnt().is_something() {
        words
    } else {
        format!("nothing was learnt; by what was known before: {words}")
    }
}
