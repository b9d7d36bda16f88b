//! The operator's card in the words of tables, JSON and CSV.

use std::ops::RangeInclusive;

use serde::Serialize;

use super::study::{OK, printed_degrees};
use crate::studies::card::{Card, CardRow, Rule, Verdict};
use crate::studies::ensemble::Band;

/// Shares and slip ratios that a rule may have [-].
pub const SHARE: RangeInclusive<f64> = 0.0..=1.0;
/// Margins that a rule may have [°].
pub const MARGIN_DEG: RangeInclusive<f64> = 0.0..=60.0;

/// The word of a verdict.
#[must_use]
pub const fn word_of(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Go => "go",
        Verdict::Caution => "caution",
        Verdict::NoGo => "no-go",
    }
}

/// When to go.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RuleRecord {
    /// Largest slip ratio of a go [-].
    pub go_slip_ratio: f64,
    /// Least share of the draws within it [-].
    pub go_probability: f64,
    /// Largest slip ratio that is no no-go [-].
    pub no_go_slip_ratio: f64,
    /// Least share of the draws within it [-].
    pub no_go_probability: f64,
    /// Margin of slope where no uncertainty is stated [°].
    pub margin_deg: f64,
}

impl From<&Rule> for RuleRecord {
    fn from(rule: &Rule) -> Self {
        Self {
            go_slip_ratio: rule.go_slip_ratio,
            go_probability: rule.go_probability,
            no_go_slip_ratio: rule.no_go_slip_ratio,
            no_go_probability: rule.no_go_probability,
            margin_deg: printed_degrees(rule.margin),
        }
    }
}

impl From<&RuleRecord> for Rule {
    fn from(record: &RuleRecord) -> Self {
        Self {
            go_slip_ratio: record.go_slip_ratio,
            go_probability: record.go_probability,
            no_go_slip_ratio: record.no_go_slip_ratio,
            no_go_probability: record.no_go_probability,
            margin: record.margin_deg.to_radians(),
        }
    }
}

/// One slope of the card. Plain words are of the soil as its document has it, quantiles are over
/// the draws, and null where no uncertainty is stated.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CardRecord {
    /// Slope [°].
    pub slope_deg: f64,
    /// `go`, `caution` or `no-go`.
    pub verdict: &'static str,
    /// Yaw that keeps the traverse level [°], positive uphill.
    pub yaw_deg: Option<f64>,
    /// 2.5 % quantile of it [°].
    pub yaw_deg_p2_5: Option<f64>,
    /// Its median [°].
    pub yaw_deg_p50: Option<f64>,
    /// Its 97.5 % quantile [°].
    pub yaw_deg_p97_5: Option<f64>,
    /// Slip ratio of every wheel at that yaw [-].
    pub slip_ratio: Option<f64>,
    /// 2.5 % quantile of it [-].
    pub slip_ratio_p2_5: Option<f64>,
    /// Its median [-].
    pub slip_ratio_p50: Option<f64>,
    /// Its 97.5 % quantile [-].
    pub slip_ratio_p97_5: Option<f64>,
    /// Power of the motors at that yaw [W].
    pub power_w: Option<f64>,
    /// 2.5 % quantile of it [W].
    pub power_w_p2_5: Option<f64>,
    /// Its median [W].
    pub power_w_p50: Option<f64>,
    /// Its 97.5 % quantile [W].
    pub power_w_p97_5: Option<f64>,
    /// Drift per metre travelled at yaw 0 [m/m], positive downhill.
    pub downhill_m_per_m: Option<f64>,
    /// 2.5 % quantile of it [m/m].
    pub downhill_m_per_m_p2_5: Option<f64>,
    /// Its median [m/m].
    pub downhill_m_per_m_p50: Option<f64>,
    /// Its 97.5 % quantile [m/m].
    pub downhill_m_per_m_p97_5: Option<f64>,
    /// Share of the draws with a level traverse [-].
    pub probability_level: Option<f64>,
    /// Lower end of its 95 % confidence interval, for the number of draws [-].
    pub probability_level_low: Option<f64>,
    /// Upper end of that interval [-].
    pub probability_level_high: Option<f64>,
    /// Draws with a level traverse: those that yaw, slip and power are over.
    pub draws_level: Option<usize>,
    /// Draws that do not slide at yaw 0: those that drift is over.
    pub draws_held: Option<usize>,
    /// All draws.
    pub draws: Option<usize>,
    /// `ok`, or why the soil as written has no level traverse.
    pub status: String,
}

impl CardRecord {
    /// The records of a card, slope by slope.
    #[must_use]
    pub fn of(card: &Card) -> Vec<Self> {
        card.rows.iter().map(|row| Self::of_row(row, card)).collect()
    }

    fn of_row(row: &CardRow, card: &Card) -> Self {
        let bands = row.bands.as_ref();
        let degrees = |angle: f64| angle.to_degrees();
        let [yaw_low, yaw_median, yaw_high] = ends(bands.and_then(|bands| bands.yaw), degrees);
        let [slip_low, slip_median, slip_high] =
            ends(bands.and_then(|bands| bands.slip_ratio), same);
        let [power_low, power_median, power_high] = ends(bands.and_then(|bands| bands.power), same);
        let [drift_low, drift_median, drift_high] = ends(bands.and_then(|bands| bands.drift), same);
        let level = bands.map(|bands| bands.level);
        Self {
            slope_deg: printed_degrees(row.slope),
            verdict: word_of(row.verdict),
            yaw_deg: row.level.map(|level| level.yaw.to_degrees()),
            yaw_deg_p2_5: yaw_low,
            yaw_deg_p50: yaw_median,
            yaw_deg_p97_5: yaw_high,
            slip_ratio: row.level.map(|level| level.slip_ratio),
            slip_ratio_p2_5: slip_low,
            slip_ratio_p50: slip_median,
            slip_ratio_p97_5: slip_high,
            power_w: row.level.map(|level| level.power),
            power_w_p2_5: power_low,
            power_w_p50: power_median,
            power_w_p97_5: power_high,
            downhill_m_per_m: row.drift,
            downhill_m_per_m_p2_5: drift_low,
            downhill_m_per_m_p50: drift_median,
            downhill_m_per_m_p97_5: drift_high,
            probability_level: level.map(|level| level.estimate()),
            probability_level_low: level.map(|level| level.interval().0),
            probability_level_high: level.map(|level| level.interval().1),
            draws_level: level.map(|level| level.successes),
            draws_held: bands.map(|bands| bands.held.successes),
            draws: card.draws,
            status: status(row, card),
        }
    }
}

/// Why the soil as written has no level traverse.
fn status(row: &CardRow, card: &Card) -> String {
    match (&row.level, &card.limit) {
        (Some(_), _) => OK.to_owned(),
        (None, Ok((limit, reason))) => {
            let limit = (limit.to_degrees() * 100.0).floor() / 100.0;
            format!("no level attitude: the steepest slope is {limit:.2}°, {reason}")
        }
        (None, Err(reason)) => reason.clone(),
    }
}

/// Lower end, median and upper end of a band, in another unit.
fn ends(band: Option<Band>, convert: impl Fn(f64) -> f64) -> [Option<f64>; 3] {
    let [low, median, high] =
        [band.map(|band| band.low), band.map(|band| band.median), band.map(|band| band.high)];
    [low, median, high].map(|end| end.map(&convert))
}

fn same(value: f64) -> f64 {
    value
}

/// A measured yaw beside the card.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeasuredRecord {
    /// Slope [°].
    pub slope_deg: f64,
    /// What was measured: the name of its column.
    pub measured: String,
    /// The measured yaw [°], positive uphill.
    pub measured_yaw_deg: f64,
    /// Yaw on the soil as written [°].
    pub yaw_deg: Option<f64>,
    /// 2.5 % quantile over the draws [°].
    pub yaw_deg_p2_5: Option<f64>,
    /// 97.5 % quantile over the draws [°].
    pub yaw_deg_p97_5: Option<f64>,
    /// Share of the draws with a level traverse [-].
    pub probability_level: Option<f64>,
    /// `below`, `inside` or `above` the band.
    pub place: Option<&'static str>,
}

impl MeasuredRecord {
    /// A measured yaw beside the row of its slope.
    #[must_use]
    pub fn new(row: &CardRecord, measured: &str, yaw_deg: f64) -> Self {
        let place = row.yaw_deg_p2_5.zip(row.yaw_deg_p97_5).map(|(low, high)| {
            if yaw_deg < low {
                "below"
            } else if yaw_deg > high {
                "above"
            } else {
                "inside"
            }
        });
        Self {
            slope_deg: row.slope_deg,
            measured: measured.to_owned(),
            measured_yaw_deg: yaw_deg,
            yaw_deg: row.yaw_deg,
            yaw_deg_p2_5: row.yaw_deg_p2_5,
            yaw_deg_p97_5: row.yaw_deg_p97_5,
            probability_level: row.probability_level,
            place,
        }
    }
}
