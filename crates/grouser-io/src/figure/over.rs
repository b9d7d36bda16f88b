//! Charts of the columns of a table over one of them.

use super::{Chart, Series, Style};
use crate::columns::{Column, Quantity};
use crate::reading::capitalised;
use crate::table::Table;
use crate::unit::ONE;

/// A quantity and its unit, for an axis.
#[must_use]
pub fn axis(quantity: Quantity) -> String {
    let (label, unit) = (quantity.label(), quantity.unit.symbol);
    if unit == ONE.symbol { label } else { format!("{label} [{unit}]") }
}

/// A chart for each unit of some columns over another: columns of one unit share an axis.
#[must_use]
pub fn by_unit<R>(table: &Table, over: Quantity, columns: &[Column<R>]) -> Vec<Chart> {
    let is_number =
        |column: &&Column<R>| column.name != over.name && !table.numbers(column.name).is_empty();
    let columns: Vec<&Column<R>> = columns.iter().filter(is_number).collect();
    let mut units: Vec<&str> = Vec::new();
    for column in &columns {
        if !units.contains(&column.unit.symbol) {
            units.push(column.unit.symbol);
        }
    }
    let chart = |unit: &&str| {
        let of_unit: Vec<&&Column<R>> =
            columns.iter().filter(|column| column.unit.symbol == *unit).collect();
        let series = of_unit.iter().enumerate().map(|(place, column)| {
            let name = if of_unit.len() > 1 { label(column) } else { String::new() };
            let points = table.points(over.name, column.name);
            Series::new(name, Style::of_line(place), place + 1, points)
        });
        let labels: Vec<String> = of_unit.iter().map(|column| label(column)).collect();
        Chart::new(
            capitalised(&shared(&labels)),
            (axis(over), if *unit == ONE.symbol { String::new() } else { format!("[{unit}]") }),
            series.collect(),
        )
    };
    units.iter().map(chart).collect()
}

/// A chart for each column over another, with a curve for each prefix of the column's name.
///
/// * `prefixes`: of names in the table, each with the name of its curve
#[must_use]
pub fn by_part<R>(
    table: &Table,
    over: Quantity,
    prefixes: &[(String, String)],
    columns: &[Column<R>],
) -> Vec<Chart> {
    let chart = |column: &Column<R>| {
        let series = prefixes.iter().enumerate().map(|(place, (prefix, name))| {
            let points = table.points(over.name, &format!("{prefix}{}", column.name));
            Series::new(name, Style::of_line(place), place + 1, points)
        });
        let series: Vec<Series> = series.filter(|series| !series.points.is_empty()).collect();
        let unit = column.unit.symbol;
        let unit = if unit == ONE.symbol { String::new() } else { format!("[{unit}]") };
        let chart = Chart::new(capitalised(&label(column)), (axis(over), unit), series);
        (!chart.series.is_empty()).then_some(chart)
    };
    columns.iter().filter_map(chart).collect()
}

/// What names have in common: their last word, or all of them.
fn shared(names: &[String]) -> String {
    let last = |name: &String| name.rsplit(' ').next().unwrap_or_default().to_owned();
    match names {
        [only] => only.clone(),
        all if all.iter().all(|name| name.len() == 1) => format!("position, {}", all.join(" and ")),
        [first, rest @ ..] if rest.iter().all(|name| last(name) == last(first)) => last(first),
        _ => names.join(", "),
    }
}

/// A column's name in words, without its unit.
fn label<R>(column: &Column<R>) -> String {
    Quantity { name: column.name, unit: column.unit }.label()
}
