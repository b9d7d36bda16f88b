//! Charts of a validation: predictions through measured points, and residuals.

use crate::document::columns::fit::{self, column_of};
use crate::document::columns::{
    self, COURSE, SLIP_ANGLE, SLIP_RATIO, SLOPE, TOTAL_SLIP, YAW, slope,
};
use crate::document::figure::{Chart, Series, Style};
use crate::document::reading::capitalised;
use crate::document::table::Table;
use crate::studies::measurement::Quantity;
use crate::studies::slope_validation::SlopeValidation;
use crate::studies::validation::Validation;

/// A chart that is a file too.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The name of its file, without the ending.
    pub file: String,
    /// What is drawn.
    pub chart: Chart,
    /// What it shows.
    pub caption: &'static str,
}

/// Cells by slip angle, then by slip.
struct Cells(Table);

/// A cell at its place.
#[derive(Clone, Copy)]
struct Cell {
    angle: f64,
    slip: f64,
    measured: Option<f64>,
    deviation: Option<f64>,
    predicted: Option<f64>,
}

impl Cells {
    fn of(validation: &Validation) -> Self {
        let mut sorted = validation.cells.clone();
        sorted.sort_by(|one, other| {
            let by_angle = one.slip_angle.total_cmp(&other.slip_angle);
            by_angle.then(one.total_slip.total_cmp(&other.total_slip))
        });
        Self(fit::cells(&sorted))
    }

    /// The cells' values of a quantity.
    fn of_quantity(&self, quantity: columns::Quantity) -> Vec<Cell> {
        let (measurement, deviation) = (quantity.measurement(), quantity.deviation());
        let names = [SLIP_ANGLE.name, TOTAL_SLIP.name, &measurement, &deviation, quantity.name];
        let [angle, slip, measured, deviation, predicted] = names.map(|name| self.0.numbers(name));
        let cell = |place: usize| Cell {
            angle: angle[place].unwrap_or_default(),
            slip: slip[place].unwrap_or_default(),
            measured: measured[place],
            deviation: deviation[place],
            predicted: predicted[place],
        };
        (0..self.0.rows()).map(cell).collect()
    }
}

/// For each quantity that was measured: curves through points, and residuals.
#[must_use]
pub fn all(validation: &Validation) -> Vec<Figure> {
    let all = Cells::of(validation);
    let mut figures = Vec::new();
    for quantity in Quantity::ALL {
        let column = column_of(quantity);
        let (name, unit) = (&column.label(), column.unit.symbol);
        let cells = all.of_quantity(column);
        if cells.iter().all(|cell| cell.measured.is_none()) {
            continue;
        }
        let file = name.replace(' ', "-");
        figures.push(Figure {
            file: file.clone(),
            chart: over_slip(&cells, name, unit),
            caption: "Dots are means over the trials of a cell, bars the standard deviation \
                      between them. Predictions are of the same trials, at their own loads, so \
                      lines bend where the load does.",
        });
        figures.push(Figure {
            file: format!("{file}-residuals"),
            chart: residuals(&cells, name, unit),
            caption: "Prediction minus measurement, cell by cell: above zero the model predicts \
                      too much. Where a bar reaches zero, the trials differ from each other as \
                      much as from the model.",
        });
    }
    figures
}

/// For each quantity that was measured: measured and predicted over the slope, a colour for each
/// course.
#[must_use]
pub fn of_slopes(validation: &SlopeValidation) -> Vec<Figure> {
    let table = slope::slopes(&validation.points);
    let figure = |quantity: columns::Quantity| {
        let measured = quantity.measurement();
        table.points(SLOPE.name, &measured).next()?;
        let mut series = Vec::new();
        for (place, (course, rows)) in by_course(&table).into_iter().enumerate() {
            let of_course = table.rows_at(&rows);
            let predicted = of_course.points(SLOPE.name, quantity.name);
            series.push(Series::new(
                format!("predicted, course {course}°"),
                Style::Line,
                place,
                predicted,
            ));
            let points = of_course.points(SLOPE.name, &measured);
            series.push(Series::new(
                format!("measured, course {course}°"),
                Style::Dots,
                place,
                points,
            ));
        }
        let (name, unit) = (quantity.label(), quantity.unit.symbol);
        Some(Figure {
            file: name.replace(' ', "-"),
            chart: Chart::new(
                format!("{} over slope: measured and predicted", capitalised(&name)),
                ("slope [°]", format!("{name} [{unit}]")),
                series,
            ),
            caption: "Dots are measured. Where no heading holds a course along or up the slope, \
                      the slip counts as 1.",
        })
    };
    [SLIP_RATIO, YAW].into_iter().filter_map(figure).collect()
}

/// The rows of each course, by slope.
fn by_course(table: &Table) -> Vec<(f64, Vec<usize>)> {
    let (slopes, courses) = (table.numbers(SLOPE.name), table.numbers(COURSE.name));
    let mut rows: Vec<usize> = (0..table.rows()).collect();
    let place = |row: usize| [courses[row], slopes[row]].map(Option::unwrap_or_default);
    rows.sort_by(|one, other| {
        let ([course, slope], [other_course, other_slope]) = (place(*one), place(*other));
        course.total_cmp(&other_course).then(slope.total_cmp(&other_slope))
    });
    let of_one_course = rows.chunk_by(|one, other| place(*one)[0] == place(*other)[0]);
    of_one_course.map(|rows| (place(rows[0])[0], rows.to_vec())).collect()
}

const SLIP_LABEL: &str = "slip by the total speed: -1 locked, 0 rolling, 1 spinning";

fn over_slip(cells: &[Cell], name: &str, unit: &str) -> Chart {
    let mut series = Vec::new();
    for (place, of_angle) in by_angle(cells).enumerate() {
        let angle = of_angle[0].angle;
        let predicted = of_angle.iter().filter_map(|cell| Some((cell.slip, cell.predicted?)));
        let style = style_of_predictions(of_angle);
        series.push(Series::new(format!("predicted, {angle}°"), style, place, predicted));
        let measured = of_angle.iter().filter_map(|cell| Some((cell.slip, cell.measured?)));
        let with_value = of_angle.iter().filter(|cell| cell.measured.is_some());
        let bars = with_value.map(|cell| cell.deviation.unwrap_or(0.0));
        let points = Series::new(format!("measured, {angle}°"), Style::Dots, place, measured);
        series.push(points.with_error_bars(bars));
    }
    Chart::new(
        format!("{}: measured and predicted", capitalised(name)),
        (SLIP_LABEL, format!("{name} [{unit}]")),
        series,
    )
}

/// A line, unless several cells have the same slip, as at several loads: it would run up and down.
fn style_of_predictions(cells: &[Cell]) -> Style {
    /// Cells closer than this on the slip axis stand above each other [-]. Source: ours.
    const SAME_SLIP: f64 = 0.01;
    let above = cells.windows(2).any(|pair| pair[1].slip - pair[0].slip < SAME_SLIP);
    if above { Style::Squares } else { Style::Line }
}

fn residuals(cells: &[Cell], name: &str, unit: &str) -> Chart {
    let of_angle = |(place, cells): (usize, &[Cell])| {
        let angle = cells[0].angle;
        let (points, bars): (Vec<(f64, f64)>, Vec<f64>) = cells
            .iter()
            .filter_map(|cell| {
                let point = (cell.slip, cell.predicted? - cell.measured?);
                Some((point, cell.deviation.unwrap_or(0.0)))
            })
            .unzip();
        Series::new(format!("{angle}°"), Style::Dots, place, points).with_error_bars(bars)
    };
    Chart::new(
        format!("{}: predicted minus measured", capitalised(name)),
        (SLIP_LABEL, format!("error of {name} [{unit}]")),
        by_angle(cells).enumerate().map(of_angle).collect(),
    )
}

/// Sorted cells, apart by slip angle.
fn by_angle(cells: &[Cell]) -> impl Iterator<Item = &[Cell]> {
    cells.chunk_by(|one, other| one.angle == other.angle)
}
