//! `grouser attitude --uncertainty`: what the draws of an uncertain soil add to the attitude.

use grouser::document::study::{AttitudeBandLimit, AttitudeBandRecord};
use grouser::document::{LoadedScenario, UncertainSoil};
use grouser::soil::Soil;
use grouser::studies::attitude::{AttitudeCurve, AttitudeStudy};
use grouser::studies::attitude_band::{AttitudeBand, SlopeBand};
use grouser::studies::ensemble::Band;

use crate::args::AttitudeArgs;
use crate::chart::{Chart, Series, Style};
use crate::failure::Failure;
use crate::inputs;
use crate::output;
use crate::output::rows::rounded_down;

/// What the draws say.
pub(crate) struct Bands {
    /// On each slope that was asked for.
    pub(crate) records: Vec<AttitudeBandRecord>,
    /// Of the steepest slope.
    pub(crate) limit: AttitudeBandLimit,
    /// On the slopes of the charts, from level ground up; empty if nobody wants any.
    along: Vec<SlopeBand>,
}

/// Steepest slope of the charts [°]: the steepest that is looked at.
const STEEPEST_DEG: u8 = 60;
/// A band over fewer of the draws than this is not drawn [-]: it would tell of the few strong soils
/// that are left.
const LEAST_DRAWN: f64 = 0.5;
/// Where the chance of a level traverse is charted until [-].
const LEAST_CHANCE: f64 = 0.001;

/// Draws the soils and follows the curve of each.
///
/// * `nominal`: the curve of the soil as its document has it
/// * `charted`: whether there will be charts
pub(crate) fn draw(
    args: &AttitudeArgs,
    scenario: &LoadedScenario,
    nominal: &AttitudeCurve,
    charted: bool,
) -> Result<Bands, Failure> {
    let uncertain = inputs::uncertain_soil(args, scenario)?;
    let soils = soils(uncertain, args.uncertainty.seed, args.uncertainty.samples)?;
    let asked: Vec<f64> = args.slope_deg.0.iter().map(|slope| slope.to_radians()).collect();
    let charted = if charted { chart_slopes(nominal) } else { Vec::new() };
    let slopes: Vec<f64> = asked.iter().chain(&charted).copied().collect();
    let bar = output::progress_bar(soils.len() as u64);
    bar.set_message("soils");
    let study = AttitudeStudy::of(&scenario.value);
    let band = AttitudeBand::of(&study, &soils, &slopes, &|| {
        bar.inc(1);
        true
    });
    bar.finish_and_clear();
    // Nobody breaks it off: Ctrl-C ends the program.
    let band = band?.unwrap_or_else(|| unreachable!("it was not broken off"));
    let (asked, along) = band.slopes.split_at(asked.len());
    Ok(Bands {
        records: asked.iter().map(AttitudeBandRecord::from).collect(),
        limit: AttitudeBandLimit::from(&band),
        along: along.to_vec(),
    })
}

/// The drawn soils.
pub(crate) fn soils(
    uncertain: &UncertainSoil,
    seed: u64,
    samples: u32,
) -> Result<Vec<Soil>, Failure> {
    uncertain.draws(seed, samples).map_err(|error| {
        Failure::Usage(format!(
            "the soil's uncertainty reaches too far: {error}\nhint: smaller standard deviations \
             keep the draws within the ranges of their keys"
        ))
    })
}

/// Every degree, and the points of the nominal curve, which crowd where it bends.
fn chart_slopes(nominal: &AttitudeCurve) -> Vec<f64> {
    let degrees = (0..=STEEPEST_DEG).map(|degree| f64::from(degree).to_radians());
    let points = nominal.attitudes().into_iter().map(|attitude| attitude.slope);
    let mut slopes: Vec<f64> = degrees.chain(points).collect();
    slopes.sort_by(f64::total_cmp);
    slopes
}

impl Bands {
    /// A sentence on the steepest slope.
    pub(crate) fn limit_line(&self) -> String {
        let AttitudeBandLimit {
            limit_slope_deg_p2_5,
            limit_slope_deg_p50,
            limit_slope_deg_p97_5,
            draws_mobile,
            draws,
        } = &self.limit;
        let ends = (limit_slope_deg_p2_5, limit_slope_deg_p50, limit_slope_deg_p97_5);
        let (Some(low), Some(median), Some(high)) = ends else {
            return format!("no level attitude in any of {draws} draws\n");
        };
        let [low, median, high] = [low, median, high].map(|slope| rounded_down(*slope));
        let stuck = match draws - draws_mobile {
            0 => String::new(),
            stuck => format!("; on {stuck} more the rover cannot move at all"),
        };
        format!("over {draws_mobile} draws: {low}° to {high}° (95 %), median {median}°{stuck}\n")
    }

    /// Yaw over slope, with its band.
    pub(crate) fn chart(&self, nominal: Series) -> Chart {
        let drawn = |band: &&SlopeBand| band.level.estimate() >= LEAST_DRAWN;
        let edges = self.along.iter().filter(drawn).filter_map(|on_slope| {
            let Band { low, high, .. } = on_slope.yaw?;
            Some((on_slope.slope.to_degrees(), low.to_degrees(), high.to_degrees()))
        });
        let medians = self.along.iter().filter(drawn).filter_map(|on_slope| {
            Some((on_slope.slope.to_degrees(), on_slope.yaw?.median.to_degrees()))
        });
        Chart {
            title: format!("Yaw that keeps a traverse level, {} draws", self.limit.draws),
            x_label: "slope [°]".into(),
            y_label: "yaw, positive uphill [°]".into(),
            series: vec![
                Series::band("95 % of the draws", 6, edges),
                Series::new("median", Style::Dashed, 0, medians),
                nominal,
            ],
        }
    }

    /// The chance of a level traverse over slope.
    pub(crate) fn chance_chart(&self) -> Chart {
        let impossible = |band: &SlopeBand| band.level.estimate() < LEAST_CHANCE;
        let end = self.along.iter().position(impossible).map_or(self.along.len(), |end| end + 1);
        let shown = &self.along[..end];
        let edges = shown.iter().map(|on_slope| {
            let (low, high) = on_slope.level.interval();
            (on_slope.slope.to_degrees(), low, high)
        });
        let chances =
            shown.iter().map(|on_slope| (on_slope.slope.to_degrees(), on_slope.level.estimate()));
        Chart {
            title: format!("Probability of a level traverse, {} draws", self.limit.draws),
            x_label: "slope [°]".into(),
            y_label: "probability".into(),
            series: vec![
                Series::band("95 % interval", 6, edges),
                Series::new("share of the draws", Style::Line, 1, chances),
            ],
        }
    }
}
