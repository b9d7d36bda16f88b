//! Posterior samples as a table: the fitted keys, and the discrepancy that goes with each sample.

use serde_json::{Map, Value as Json, json};

use super::super::soil_family::{DISCREPANCY, SoilFamily};
use super::Solved;
use crate::soil::Discrepancy;
use crate::soil::discrepancy::{SIDE_VALUES, VALUES};
use crate::studies::calibration::{Channel, Posterior};
use crate::studies::measurement::Quantity;

/// The values of a quantity's discrepancy: their key in that table, how many there are, and where.
struct List {
    key: &'static str,
    count: usize,
    of: fn(&Discrepancy) -> &[f64],
}

fn list_of(quantity: Quantity) -> List {
    match quantity {
        Quantity::DrawbarPull => {
            List { key: "drawbar_pull", count: VALUES, of: |it| &it.drawbar_pull }
        }
        Quantity::SideForce => {
            List { key: "side_force", count: SIDE_VALUES, of: |it| &it.side_force }
        }
        Quantity::Sinkage => List { key: "sinkage", count: VALUES, of: |it| &it.sinkage },
        Quantity::Torque => List { key: "torque", count: VALUES, of: |it| &it.torque },
    }
}

/// The lists of the quantities that were measured, if samples have a discrepancy.
fn lists(channels: &[Channel], posterior: &Posterior) -> Vec<List> {
    let is_measured = |wanted: &Quantity| {
        channels
            .iter()
            .any(|channel| matches!(channel, Channel::Wheel { quantity, .. } if quantity == wanted))
    };
    let measured = Quantity::ALL.into_iter().filter(is_measured);
    if posterior.discrepancies.is_empty() { Vec::new() } else { measured.map(list_of).collect() }
}

/// The discrepancy of the fitted soil itself: none, at every place where samples have one.
pub(super) fn nominal(solved: &Solved) -> Option<Json> {
    let solution = &solved.solution;
    let lists = lists(&solution.channels, solution.posterior.as_ref()?);
    let zeros = |list: &List| (list.key.to_owned(), json!(vec![0.0; list.count]));
    (!lists.is_empty()).then(|| Json::Object(lists.iter().map(zeros).collect::<Map<_, _>>()))
}

/// Samples of the fitted keys as CSV, in the keys' own units, and of the discrepancy: the file of a
/// soil's uncertainty. None without a posterior.
#[must_use]
pub fn samples_csv(family: &SoilFamily, solved: &Solved) -> Option<String> {
    let solution = &solved.solution;
    let posterior = solution.posterior.as_ref()?;
    let lists = lists(&solution.channels, posterior);
    let mut keys: Vec<String> = family.keys().map(str::to_owned).collect();
    let fitted = keys.len();
    for List { key, count, .. } in &lists {
        keys.extend((0..*count).map(|place| format!("{DISCREPANCY}.{key}.{place}")));
    }
    let mut text = keys.join(",") + "\n";
    for (number, row) in posterior.kept().iter().enumerate() {
        let wrong = posterior.discrepancies.get(number);
        let wrong = wrong.iter().flat_map(|it| lists.iter().flat_map(|list| (list.of)(it)));
        let cells = row[..fitted].iter().chain(wrong).map(|value| json!(value).to_string());
        text += &cells.collect::<Vec<String>>().join(",");
        text.push('\n');
    }
    Some(text)
}
