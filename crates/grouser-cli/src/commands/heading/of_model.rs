//! What a wheel–soil model answers about headings.

use grouser::document::LoadedScenario;
use grouser::document::columns::heading::{self, LIMIT_REASON, LIMITED_BY, turned};
use grouser::document::columns::wheel_speeds::{self, NONE_FOUND, WHEELS};
use grouser::document::columns::{ENERGY_PER_METRE, LIMIT_SLOPE, MODEL, SLOPE};
use grouser::document::table::Table;
use grouser::studies::heading::{HeadingCurve, LimitedBy, Steering};
use grouser_draw::chart::{Chart, Series, Style};

use crate::args::HeadingArgs;
use crate::commands::heading_band::Bands;
use crate::output::rows::rounded_down;

/// What a model answers.
pub(super) struct OfModel {
    pub(super) scenario: LoadedScenario,
    pub(super) curve: HeadingCurve,
    pub(super) bands: Option<Bands>,
    /// With wheels at speeds of their own: the steepest slopes, a row for each freedom.
    pub(super) own_speeds: Option<Table>,
    /// A row for each slope.
    pub(super) table: Table,
    /// The steepest slope: one row.
    pub(super) limit: Table,
}

impl OfModel {
    pub(super) fn name(&self) -> &'static str {
        self.scenario.value.model.name()
    }

    /// A table of its results, with its name where there are several.
    pub(super) fn named(&self, args: &HeadingArgs, table: &Table) -> Table {
        let table = table.clone();
        if args.setting.has_every_model() { table.with_word(MODEL, self.name()) } else { table }
    }

    /// The end of its files' names: nothing if it is alone.
    pub(super) fn end(&self, count: usize) -> String {
        if count > 1 { format!("-{}", self.name()) } else { String::new() }
    }

    /// What is said about its steepest slope.
    pub(super) fn lines(&self, count: usize) -> String {
        let name = if count > 1 { format!("{}: ", self.name()) } else { String::new() };
        let band = self
            .bands
            .as_ref()
            .map_or(String::new(), |bands| format!("{name}{}", bands.limit_line()));
        let own = self.own_speeds.as_ref().map_or(String::new(), |limits| own_lines(&name, limits));
        format!("{name}{}{band}{own}", limit_line(&self.limit))
    }
}

const CURVE: &str = "The rover crosses the slope along the contour line with its nose turned uphill by this angle. \
                     Where the curve ends no heading holds the contour.";
const CRAB: &str = "The rover crosses the slope with its body along the contour line and its wheels steered uphill by \
                    this angle. Where the curve ends no steering angle holds the contour.";
const CHANCE: &str = "The share of the samples in which some heading holds the contour. The band is what so many \
                      samples leave open of that share, with 95 % confidence.";

/// A chart of the curves of all models, or those of the bands of each, with the names of their
/// files and captions.
pub(super) fn figures(command: &str, all: &[OfModel]) -> Vec<(String, Chart, &'static str)> {
    if all.iter().all(|of_model| of_model.bands.is_none()) {
        let caption = match all[0].curve.steering() {
            Steering::None => CURVE,
            Steering::Crab => CRAB,
        };
        return vec![(format!("{command}.svg"), chart(all), caption)];
    }
    let of_bands = |of_model: &OfModel| {
        let bands = of_model.bands.as_ref()?;
        let end = of_model.end(all.len());
        let nominal = line("soil as written", 1, &of_model.curve);
        Some([
            (format!("{command}{end}.svg"), bands.chart(nominal), CURVE),
            (format!("probability{end}.svg"), bands.chance_chart(), CHANCE),
        ])
    };
    all.iter().filter_map(of_bands).flatten().collect()
}

/// The columns for reading.
pub(super) fn brief(args: &HeadingArgs, first: &OfModel) -> Vec<String> {
    let mut names = match first {
        OfModel { bands: Some(_), .. } => heading::bands_brief(),
        OfModel { own_speeds: Some(_), .. } => wheel_speeds::brief(&first.scenario.value.rover),
        _ => heading::brief(first.curve.steering()),
    };
    if args.setting.has_every_model() {
        names.insert(0, MODEL.to_owned());
    }
    names
}

fn limit_line(limit: &Table) -> String {
    let slope = limit.numbers(LIMIT_SLOPE.name)[0];
    let reason = limit.texts(LIMIT_REASON)[0].as_deref().unwrap_or_default();
    match slope {
        Some(slope) => {
            let slope = rounded_down(slope);
            format!("steepest slope on which a heading holds the contour: {slope}°, {reason}\n")
        }
        None if limit.texts(LIMITED_BY)[0].as_deref() == Some(LimitedBy::NotFound.name()) => {
            format!("{reason}\n")
        }
        None => format!("no heading holds the contour on any slope: {reason}\n"),
    }
}

/// What wheels at speeds of their own hold at the most.
fn own_lines(name: &str, limits: &Table) -> String {
    let rows = limits.texts(WHEELS).iter().zip(limits.numbers(LIMIT_SLOPE.name));
    let energies = limits.numbers(ENERGY_PER_METRE.name);
    let lines = rows.zip(energies).skip(1).map(|((wheels, slope), energy)| {
        let wheels = wheels.as_deref().unwrap_or_default();
        match (slope, energy) {
            (Some(slope), Some(energy)) => {
                format!(
                    "{name}with wheels {wheels}: {}°, with {energy:.1} J/m\n",
                    rounded_down(*slope)
                )
            }
            _ => format!("{name}with wheels {wheels}: {NONE_FOUND}\n"),
        }
    });
    lines.collect()
}

/// Yaw over slope.
fn chart(all: &[OfModel]) -> Chart {
    let series = all.iter().enumerate().map(|(place, of_model)| {
        let name = if all.len() > 1 { of_model.name() } else { "" };
        line(name, place + 1, &of_model.curve)
    });
    let (title, angle) = match all[0].curve.steering() {
        Steering::None => ("Heading offset that holds the contour", "yaw, positive uphill [°]"),
        Steering::Crab => {
            ("Steering angle that holds the contour", "steering angle, positive uphill [°]")
        }
    };
    Chart::new(title, ("slope [°]", angle), series.collect())
}

fn line(name: &str, colour: usize, curve: &HeadingCurve) -> Series {
    let points = heading::curve(curve);
    Series::new(name, Style::Line, colour, points.points(SLOPE.name, turned(curve.steering()).name))
}
