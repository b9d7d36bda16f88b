//! What a drive taught.

use std::collections::BTreeMap;

use grouser::document::columns::learn::sentence;
use grouser::document::columns::{SLIP_RATIO, SLOPE, YAW};
use grouser::document::reading::four_digits;
use grouser::document::table::Table;
use grouser::studies::learn::{Drive, Learner, Warning};

use super::advice::AdviceTables;

/// What a drive taught.
pub(in crate::commands) struct Found {
    pub(in crate::commands) drive: Drive,
    /// What was left out of the telemetry, a sentence each.
    pub(in crate::commands) notes: Vec<String>,
    pub(in crate::commands) predictions: Table,
    /// What to do tomorrow, if that is asked for.
    pub(super) advice: Option<AdviceTables>,
    /// What is left of the uncertainty of each of the soil's keys [-].
    pub(in crate::commands) narrowed: BTreeMap<String, f64>,
}

/// The models with their shares.
pub(in crate::commands) fn shares(learner: &Learner) -> BTreeMap<&'static str, f64> {
    learner.models().shares().iter().map(|(model, share)| (model.name(), *share)).collect()
}

/// What one slope comes to, for a sentence: yaw and slip with their bands.
pub(in crate::commands) fn of_row(table: &Table, row: usize) -> Option<String> {
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

/// A warning, for reading.
pub(in crate::commands) fn warning(warning: &Warning) -> String {
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
