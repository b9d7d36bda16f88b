//! The plan of a wheel test, its columns for reading, and its charts.

use grouser::document::columns::{self, LOAD, MODEL, Quantity, SLIP_ANGLE, SLIP_RATIO};
use grouser::document::table::Table;
use grouser::studies::wheel_test::WheelTest;
use grouser_draw::chart::{BAND_COLOUR, Chart, Series, Style};

use crate::args::WheelTestArgs;
use crate::inputs::StandInputs;
use crate::output::text::capitalised;
use crate::report::answer::axis;

pub(super) fn plan(args: &WheelTestArgs, stand: &StandInputs) -> WheelTest {
    let angles = args.slip_angle_deg.0.iter().map(|angle| SLIP_ANGLE.unit.to_si(*angle));
    WheelTest {
        wheel: stand.wheel.value,
        soil: stand.soil.value,
        gravity: stand.gravity,
        model: stand.model.clone(),
        loads: args.load_n.0.clone(),
        slip_angles: angles.collect(),
        slip_ratios: args.slip_ratio.0.clone(),
    }
}

/// The columns for reading.
pub(super) fn brief(args: &WheelTestArgs) -> Vec<String> {
    let mut names = if args.stand.trials.is_some() {
        columns::stand::brief()
    } else if args.sampling.uncertainty {
        columns::wheel_test::bands_brief()
    } else {
        columns::wheel_test::brief()
    };
    if args.setting.has_every_model() {
        names.insert(0, MODEL.to_owned());
    }
    names
}

/// The rows of a test, and what charts draw of it.
pub(super) struct Charted<'a> {
    pub(super) rows: &'a Table,
    /// The same, or the same test at more slip ratios.
    pub(super) drawn: &'a Table,
    pub(super) style: Style,
}

impl Charted<'_> {
    /// A quantity over the slip ratio, a series for each model, load and slip angle, with its band
    /// if there is one.
    pub(super) fn chart(&self, quantity: Quantity) -> Chart {
        let table = self.drawn;
        let models = table.texts(MODEL);
        let [loads, angles] = [LOAD, SLIP_ANGLE].map(|it| table.numbers(it.name));
        let name = |row: usize| {
            let [load, angle] = [loads, angles].map(|column| column[row].unwrap_or_default());
            let model = models.get(row).and_then(Option::as_deref);
            let model = model.map_or(String::new(), |model| format!("{model}, "));
            format!("{model}{load} N, {angle}°")
        };
        let names: Vec<String> = (0..table.rows()).map(name).collect();
        let places: Vec<usize> = (0..table.rows()).collect();
        let [low, _, high] = quantity.quantiles();
        let mut bands: Vec<Series> = Vec::new();
        let mut lines: Vec<Series> = Vec::new();
        for rows in places.chunk_by(|one, next| names[*one] == names[*next]) {
            let (name, part) = (&names[rows[0]], table.rows_at(rows));
            let edges = part
                .points(SLIP_RATIO.name, &low)
                .zip(part.points(SLIP_RATIO.name, &high))
                .map(|((slip_ratio, low), (_, high))| (slip_ratio, low, high));
            let edges: Vec<_> = edges.collect();
            if !edges.is_empty() {
                let colour = if rows.len() < table.rows() { lines.len() } else { BAND_COLOUR };
                bands.push(Series::band(format!("95 %, {name}"), colour, edges));
            }
            let points = part.points(SLIP_RATIO.name, quantity.name);
            lines.push(Series::new(name, self.style, lines.len(), points));
        }
        let series = bands.into_iter().chain(lines).collect();
        let title = capitalised(&quantity.label());
        Chart::new(title, (axis(SLIP_RATIO), axis(quantity)), series)
    }
}
