//! The rule of an operator's card.

use std::ops::RangeInclusive;

use serde::Serialize;

use crate::studies::card::Rule;

/// Shares and slip ratios that a rule may have [-].
pub const SHARE: RangeInclusive<f64> = 0.0..=1.0;

/// The limits of the verdicts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RuleRecord {
    /// Largest slip ratio of a go [-].
    pub go_slip_ratio: f64,
    /// Least share of the samples within it [-].
    pub go_probability: f64,
    /// Largest slip ratio that is not a no-go [-].
    pub no_go_slip_ratio: f64,
    /// Least share of the samples within it [-].
    pub no_go_probability: f64,
}

impl From<&Rule> for RuleRecord {
    fn from(rule: &Rule) -> Self {
        Self {
            go_slip_ratio: rule.go_slip_ratio,
            go_probability: rule.go_probability,
            no_go_slip_ratio: rule.no_go_slip_ratio,
            no_go_probability: rule.no_go_probability,
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
        }
    }
}
