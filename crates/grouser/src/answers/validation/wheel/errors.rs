//! The errors of wheel tests for reading.

use std::sync::Arc;

use super::super::shown::{number, table, yes_or_no};
use crate::document::columns::SLIP_ANGLE;
use crate::document::reading::four_digits;
use crate::document::table::Table;
use crate::document::validation::{ErrorsRecord, GroupRecord};
use crate::studies::measurement::Quantity;
use crate::studies::validation::{Reference, Validation};

/// The columns of a quantity's errors.
const ERRORS: [&str; 9] = [
    SLIP_ANGLE.name,
    "motion",
    "cells",
    "rmse",
    "repeatability",
    "bias",
    "r2",
    "rmse_share",
    "within_aim",
];

/// Every group with what is above it: driven, skid, all.
pub(super) fn groups_and_sums(validation: &Validation) -> Vec<GroupRecord> {
    let sums = [&validation.driven, &validation.skid].into_iter().flatten();
    let all = validation.groups.iter().chain(sums).chain([&validation.overall]);
    all.map(GroupRecord::from).collect()
}

/// The errors of each quantity that has any.
pub(super) fn tables(validation: &Validation) -> Vec<(Quantity, Arc<Table>)> {
    let groups = groups_and_sums(validation);
    let of_quantity = |quantity| {
        let rows = rows(&groups, validation, quantity);
        (!rows.is_empty()).then(|| (quantity, table(&ERRORS.map(str::to_owned), rows)))
    };
    Quantity::ALL.into_iter().filter_map(of_quantity).collect()
}

/// A row for each group, then one for each yardstick.
fn rows(groups: &[GroupRecord], validation: &Validation, quantity: Quantity) -> Vec<Vec<String>> {
    let of_group = |group: &GroupRecord| {
        let angle = group.slip_angle().map_or("all".to_owned(), four_digits);
        Some(row(angle, group.motion(), group.errors(quantity)?))
    };
    let of_yardstick = |reference: &Reference| {
        let group = GroupRecord::from(&reference.overall);
        let name = reference.yardstick.name().to_owned();
        Some(row(name, group.motion(), group.errors(quantity)?))
    };
    let models = groups.iter().filter_map(of_group);
    models.chain(validation.references.iter().filter_map(of_yardstick)).collect()
}

/// * `of`: a slip angle, or a yardstick
fn row(of: String, motion: &str, errors: ErrorsRecord) -> Vec<String> {
    vec![
        of,
        motion.to_owned(),
        errors.cells.to_string(),
        four_digits(errors.rmse),
        number(errors.repeatability),
        four_digits(errors.bias),
        number(errors.r2),
        number(errors.rmse_share),
        yes_or_no(errors.within_aim),
    ]
}
