//! Charts of a validation: predictions through measured points, and what is left over.

use grouser::document::validation::CellRecord;
use grouser::studies::measurement::Quantity;
use grouser::studies::validation::Validation;

use crate::chart::{Chart, Series, Style};

/// A chart with its file's name, without ending, and what to see in it.
pub(crate) struct Figure {
    pub(crate) file: String,
    pub(crate) chart: Chart,
    pub(crate) caption: &'static str,
}

/// Measured, deviation, predicted.
type Columns = fn(&CellRecord) -> (Option<f64>, Option<f64>, Option<f64>);

/// What people call a quantity, and its unit.
pub(super) fn name_and_unit(quantity: Quantity) -> (&'static str, &'static str) {
    match quantity {
        Quantity::DrawbarPull => ("drawbar pull", "N"),
        Quantity::SideForce => ("side force", "N"),
        Quantity::Sinkage => ("sinkage", "mm"),
        Quantity::Torque => ("torque", "N·m"),
    }
}

/// Where a quantity's values are.
fn columns(quantity: Quantity) -> Columns {
    match quantity {
        Quantity::DrawbarPull => {
            |cell| (cell.measured_drawbar_pull_n, cell.drawbar_pull_std_n, cell.drawbar_pull_n)
        }
        Quantity::SideForce => {
            |cell| (cell.measured_side_force_n, cell.side_force_std_n, cell.side_force_n)
        }
        Quantity::Sinkage => {
            |cell| (cell.measured_sinkage_mm, cell.sinkage_std_mm, cell.sinkage_mm)
        }
        Quantity::Torque => |cell| (cell.measured_torque_nm, cell.torque_std_nm, cell.torque_nm),
    }
}

/// For each quantity that was measured: curves through points, and residuals.
pub(crate) fn all(validation: &Validation) -> Vec<Figure> {
    let mut cells: Vec<CellRecord> = validation.cells.iter().map(CellRecord::from).collect();
    cells.sort_by(|one, other| {
        let key = |cell: &CellRecord| (cell.slip_angle_deg, cell.slip_ratio_total_speed);
        let ((angle, slip), (other_angle, other_slip)) = (key(one), key(other));
        angle.total_cmp(&other_angle).then(slip.total_cmp(&other_slip))
    });
    let mut figures = Vec::new();
    for quantity in Quantity::ALL {
        let (name, unit) = name_and_unit(quantity);
        let columns = columns(quantity);
        if cells.iter().all(|cell| columns(cell).0.is_none()) {
            continue;
        }
        let file = name.replace(' ', "-");
        figures.push(Figure {
            file: file.clone(),
            chart: over_slip(&cells, name, unit, columns),
            caption: "Dots are means over the trials of a cell, bars the standard deviation between \
                      them. Predictions are of the same trials, at their own loads, so lines \
                      bend where the load does.",
        });
        figures.push(Figure {
            file: format!("{file}-residuals"),
            chart: residuals(&cells, name, unit, columns),
            caption: "What the theory says too much (above zero) or too little, cell by cell. Where a \
                      bar reaches zero, the trials differ from each other as much as from the \
                      theory.",
        });
    }
    figures
}

const SLIP_LABEL: &str = "slip by the total speed: -1 locked, 0 rolling, 1 spinning";

fn over_slip(cells: &[CellRecord], name: &str, unit: &str, columns: Columns) -> Chart {
    let mut series = Vec::new();
    for (place, of_angle) in by_angle(cells).into_iter().enumerate() {
        let angle = of_angle[0].slip_angle_deg;
        let point = |value: Option<f64>, cell: &CellRecord| {
            value.map(|value| (cell.slip_ratio_total_speed, value))
        };
        let predicted = of_angle.iter().filter_map(|cell| point(columns(cell).2, cell));
        let style = style_of_predictions(&of_angle);
        series.push(Series::new(format!("predicted, {angle}°"), style, place, predicted));
        let measured = of_angle.iter().filter_map(|cell| point(columns(cell).0, cell));
        let with_value = of_angle.iter().filter(|cell| columns(cell).0.is_some());
        let bars = with_value.map(|cell| columns(cell).1.unwrap_or(0.0));
        let points = Series::new(format!("measured, {angle}°"), Style::Dots, place, measured);
        series.push(points.with_error_bars(bars));
    }
    Chart {
        title: format!("{}: measured and predicted", capitalised(name)),
        x_label: SLIP_LABEL.into(),
        y_label: format!("{name} [{unit}]"),
        series,
    }
}

/// A line, unless several cells have the same slip, as at several loads: it would run up and down.
fn style_of_predictions(cells: &[&CellRecord]) -> Style {
    /// Cells closer than this on the slip axis stand above each other [-]. Source: ours.
    const SAME_SLIP: f64 = 0.01;
    let slip = |cell: &CellRecord| cell.slip_ratio_total_speed;
    let above = cells.windows(2).any(|pair| slip(pair[1]) - slip(pair[0]) < SAME_SLIP);
    if above { Style::Squares } else { Style::Line }
}

fn residuals(cells: &[CellRecord], name: &str, unit: &str, columns: Columns) -> Chart {
    let of_angle = |(place, cells): (usize, Vec<&CellRecord>)| {
        let angle = cells[0].slip_angle_deg;
        let (points, bars): (Vec<(f64, f64)>, Vec<f64>) = cells
            .iter()
            .filter_map(|cell| {
                let (measured, deviation, predicted) = columns(cell);
                let point = (cell.slip_ratio_total_speed, predicted? - measured?);
                Some((point, deviation.unwrap_or(0.0)))
            })
            .unzip();
        Series::new(format!("{angle}°"), Style::Dots, place, points).with_error_bars(bars)
    };
    Chart {
        title: format!("{}: predicted minus measured", capitalised(name)),
        x_label: SLIP_LABEL.into(),
        y_label: format!("error of {name} [{unit}]"),
        series: by_angle(cells).into_iter().enumerate().map(of_angle).collect(),
    }
}

fn capitalised(name: &str) -> String {
    name[..1].to_uppercase() + &name[1..]
}

/// Sorted cells, apart by slip angle.
fn by_angle(cells: &[CellRecord]) -> Vec<Vec<&CellRecord>> {
    cells
        .chunk_by(|one, other| one.slip_angle_deg == other.slip_angle_deg)
        .map(|chunk| chunk.iter().collect())
        .collect()
}
