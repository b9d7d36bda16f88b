//! What advice after a drive is asked for.

use std::ops::RangeInclusive;

use grouser::answers::learn::AdviceQuestion;
use grouser::document::{self, LoadedScenario};
use grouser::studies::learn::advice::{CheckSettings, Limits, SoilAhead};

use super::{check_numbers, single};
use crate::args::AdviceArgs;
use crate::failure::Failure;

/// Ways of a test drive [m], and between two changes of the soil.
const WAY: RangeInclusive<f64> = 0.1..=100.0;
const CHANGE: RangeInclusive<f64> = 0.0..=1e6;
/// Times of a look at the slip [s].
const LOOK: RangeInclusive<f64> = 0.0..=1e5;

/// What advice is asked for, if any is.
pub(crate) fn advice(
    args: &AdviceArgs,
    scenario: &LoadedScenario,
) -> Result<Option<AdviceQuestion>, Failure> {
    if !args.advice {
        return Ok(None);
    }
    let share = |flag: &str, numbers| single(flag, numbers, &document::study::SHARE);
    let slopes = document::range(document::Kind::Scenario, "slope_deg").unwrap_or(0.0..=60.0);
    check_numbers("--test-slope-deg", &args.test_slope_deg, &slopes)?;
    let test_way = single("--test-way-m", &args.test_way_m, &WAY)?;
    let change = single("--soil-change-m", &args.soil_change_m, &CHANGE)?;
    Ok(Some(AdviceQuestion {
        limits: Limits {
            slip_ratio: share("--no-go-slip-ratio", &args.no_go_slip_ratio)?,
            no_go_probability: share("--no-go-probability", &args.no_go_probability)?,
            rim_speed: scenario.value.drive.nominal_rim_speed(),
        },
        checks: CheckSettings {
            stuck_probability: share("--stuck-probability", &args.stuck_probability)?,
            false_stops: share("--false-stops", &args.false_stops)?,
            odometry_error: share("--odometry-error", &args.odometry_error)?,
            ways: args.ways,
            soil: SoilAhead { change_way: (change > 0.0).then_some(change) },
        },
        look_time: single("--look-s", &args.look_s, &LOOK)?,
        test_slopes_deg: args.test_slope_deg.0.clone(),
        test_way,
        test_cost: args.test_cost.into(),
    }))
}
