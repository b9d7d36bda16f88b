//! Charts of a validation: predictions through measured points, and what is left over.

use grouser::document::validation::CellRecord;
use grouser::studies::measurement::Quantity;
use grouser::studies::validation::Validation;

use crate::chart::{Chart, Series, Style};

/// Measured, deviation, predicted.
type Columns = fn(&CellRecord) -> (Option<f64>, Option<f64>, Option<f64>);

/// A quantity's names and where its values are.
fn words(quantity: Quantity) -> (&'static str, &'static str, &'static str, Columns) {
    match quantity {
        Quantity::DrawbarPull => ("drawbar-pull", "Drawbar pull", "drawbar pull [N]", |cell| {
            (cell.measured_drawbar_pull_n, cell.drawbar_pull_std_n, cell.drawbar_pull_n)
        }),
        Quantity::SideForce => ("side-force", "Side force", "side force [N]", |cell| {
            (cell.measured_side_force_n, cell.side_force_std_n, cell.side_force_n)
        }),
        Quantity::Sinkage => ("sinkage", "Sinkage", "sinkage [mm]", |cell| {
            (cell.measured_sinkage_mm, cell.sinkage_std_mm, cell.sinkage_mm)
        }),
        Quantity::Torque => ("torque", "Torque", "torque [N·m]", |cell| {
            (cell.measured_torque_nm, cell.torque_std_nm, cell.torque_nm)
        }),
    }
}

/// For each quantity that was measured: curves through points, and residuals. With file names.
pub(crate) fn all(validation: &Validation) -> Vec<(String, Chart)> {
    let mut cells: Vec<CellRecord> = validation.cells.iter().map(CellRecord::from).collect();
    cells.sort_by(|one, other| {
        let key = |cell: &CellRecord| (cell.slip_angle_deg, cell.slip_ratio_total_speed);
        let ((angle, slip), (other_angle, other_slip)) = (key(one), key(other));
        angle.total_cmp(&other_angle).then(slip.total_cmp(&other_slip))
    });
    let mut charts = Vec::new();
    for quantity in Quantity::ALL {
        let (file, title, label, columns) = words(quantity);
        if cells.iter().any(|cell| columns(cell).0.is_some()) {
            charts.push((file.to_owned(), over_slip(&cells, title, label, columns)));
            charts.push((format!("{file}-residuals"), residuals(&cells, title, label, columns)));
        }
    }
    charts
}

const SLIP_LABEL: &str = "slip by the total speed: -1 locked, 0 rolling, 1 spinning";

fn over_slip(cells: &[CellRecord], title: &str, label: &str, columns: Columns) -> Chart {
    let mut series = Vec::new();
    for (place, of_angle) in by_angle(cells).into_iter().enumerate() {
        let angle = of_angle[0].slip_angle_deg;
        let point = |value: Option<f64>, cell: &CellRecord| {
            value.map(|value| (cell.slip_ratio_total_speed, value))
        };
        let curve = of_angle.iter().filter_map(|cell| point(columns(cell).2, cell));
        series.push(Series::new(format!("predicted, {angle}°"), Style::Line, place, curve));
        let measured = of_angle.iter().filter_map(|cell| point(columns(cell).0, cell));
        let with_value = of_angle.iter().filter(|cell| columns(cell).0.is_some());
        let bars = with_value.map(|cell| columns(cell).1.unwrap_or(0.0));
        let points = Series::new(format!("measured, {angle}°"), Style::Dots, place, measured);
        series.push(points.with_error_bars(bars));
    }
    Chart {
        title: format!("{title}: measured and predicted"),
        x_label: SLIP_LABEL.into(),
        y_label: label.into(),
        series,
    }
}

fn residuals(cells: &[CellRecord], title: &str, label: &str, columns: Columns) -> Chart {
    let of_angle = |(place, cells): (usize, Vec<&CellRecord>)| {
        let angle = cells[0].slip_angle_deg;
        let points: Vec<(f64, f64)> = cells
            .iter()
            .filter_map(|cell| {
                let (measured, _, predicted) = columns(cell);
                Some((cell.slip_ratio_total_speed, predicted? - measured?))
            })
            .collect();
        Series::new(format!("{angle}°"), Style::Dots, place, points)
    };
    Chart {
        title: format!("{title}: predicted minus measured"),
        x_label: SLIP_LABEL.into(),
        y_label: format!("error of {label}"),
        series: by_angle(cells).into_iter().enumerate().map(of_angle).collect(),
    }
}

/// Sorted cells, apart by slip angle.
fn by_angle(cells: &[CellRecord]) -> Vec<Vec<&CellRecord>> {
    cells
        .chunk_by(|one, other| one.slip_angle_deg == other.slip_angle_deg)
        .map(|chunk| chunk.iter().collect())
        .collect()
}
