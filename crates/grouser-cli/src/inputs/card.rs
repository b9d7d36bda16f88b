//! The inputs of a card.

use grouser::document::{self, LoadedScenario};
use grouser::studies::card::Rule;

use super::{balanced, refuse_sampled_keys, single};
use crate::args::CardArgs;
use crate::failure::Failure;

/// The inputs of a card.
pub(crate) struct CardInputs {
    pub(crate) scenario: LoadedScenario,
    /// Rim speed [m/s].
    pub(crate) rim_speed: f64,
    pub(crate) rule: Rule,
}

pub(crate) fn card(args: &CardArgs) -> Result<CardInputs, Failure> {
    use document::card::{RuleRecord, SHARE};
    let flags = &args.rule;
    let record = RuleRecord {
        go_slip_ratio: single("--go-slip-ratio", &flags.go_slip_ratio, &SHARE)?,
        go_probability: single("--go-probability", &flags.go_probability, &SHARE)?,
        no_go_slip_ratio: single("--no-go-slip-ratio", &flags.no_go_slip_ratio, &SHARE)?,
        no_go_probability: single("--no-go-probability", &flags.no_go_probability, &SHARE)?,
    };
    let rule = Rule::from(&record);
    rule.check()?;
    let (rover, soil) = (args.parts.rover.as_ref(), args.parts.soil.as_ref());
    let (setting, balance) = (&args.setting, &args.balance);
    let scenario = balanced("card", args.scenario.as_deref(), rover, soil, setting, balance)?;
    refuse_sampled_keys(setting, scenario.uncertain.as_ref())?;
    let rim_speed = match &args.rim_speed_m_s {
        Some(speed) => single("--rim-speed-m-s", speed, &document::study::MAP_SPEED_M_S)?,
        None => scenario.value.drive.nominal_rim_speed(),
    };
    Ok(CardInputs { scenario, rim_speed, rule })
}
