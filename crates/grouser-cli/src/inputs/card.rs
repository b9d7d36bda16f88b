//! The inputs of a card.

use grouser::document::learn::contradiction;
use grouser::document::{self, LoadedScenario};
use grouser::studies::verdict::Rule;

use super::{balanced, refuse_sampled_keys, single};
use crate::args::{CardArgs, RuleArgs};
use crate::failure::Failure;
use crate::list::Numbers;

/// The inputs of a card.
pub(crate) struct CardInputs {
    pub(crate) scenario: LoadedScenario,
    /// Rim speed [m/s].
    pub(crate) rim_speed: f64,
    pub(crate) rule: Rule,
}

pub(crate) fn card(args: &CardArgs) -> Result<CardInputs, Failure> {
    let rule = rule(&args.rule)?;
    let (rover, soil) = (args.parts.rover.as_ref(), args.parts.soil.as_ref());
    let (setting, balance) = (&args.setting, &args.balance);
    let scenario = balanced("card", args.scenario.as_deref(), rover, soil, setting, balance)?;
    refuse_sampled_keys(setting, scenario.uncertain.as_ref())?;
    if !args.accept_contradiction {
        check_agreement(&scenario).map_err(|failure| {
            Failure::Usage(format!("{failure}, or take it as it is by --accept-contradiction"))
        })?;
    }
    let rim_speed = rim_speed(args.rim_speed_m_s.as_ref(), &scenario)?;
    Ok(CardInputs { scenario, rim_speed, rule })
}

/// Refuses a soil that was learnt of what contradicts it: no rover is to be driven by its card.
pub(crate) fn check_agreement(scenario: &LoadedScenario) -> Result<(), Failure> {
    let Some(why) = contradiction(&scenario.document) else { return Ok(()) };
    let hint = "learn anew with another prior or mended telemetry";
    Err(Failure::Usage(format!("{why}\nhint: {hint}")))
}

impl CardInputs {
    /// Those of a scenario that was read for another command.
    pub(crate) fn usual(args: &CardArgs, scenario: LoadedScenario) -> Result<Self, Failure> {
        let rule = rule(&args.rule)?;
        let rim_speed = rim_speed(args.rim_speed_m_s.as_ref(), &scenario)?;
        Ok(Self { scenario, rim_speed, rule })
    }
}

/// The limits of go and no-go.
pub(crate) fn rule(flags: &RuleArgs) -> Result<Rule, Failure> {
    use document::study::SHARE;
    let rule = Rule {
        go_slip_ratio: single("--go-slip-ratio", &flags.go_slip_ratio, &SHARE)?,
        go_probability: single("--go-probability", &flags.go_probability, &SHARE)?,
        go_drift_m_per_m: single("--go-drift-m-per-m", &flags.go_drift_m_per_m, &SHARE)?,
        no_go_slip_ratio: single("--no-go-slip-ratio", &flags.no_go_slip_ratio, &SHARE)?,
        no_go_probability: single("--no-go-probability", &flags.no_go_probability, &SHARE)?,
    };
    rule.check()?;
    Ok(rule)
}

/// The rim speed that is asked for, or else the scenario's [m/s].
pub(super) fn rim_speed(
    asked: Option<&Numbers>,
    scenario: &LoadedScenario,
) -> Result<f64, Failure> {
    match asked {
        Some(speed) => single("--rim-speed-m-s", speed, &document::study::MAP_SPEED_M_S),
        None => Ok(scenario.value.drive.nominal_rim_speed()),
    }
}
