//! The limits of verdicts.

use grouser::document::study::SHARE;
use grouser::studies::verdict::Rule;
use http::StatusCode;

use super::command::CommandLine;
use super::fields::AskedFields;
use crate::refusal::Refusal;

/// A limit of the verdicts.
type RuleLimit = fn(&Rule) -> f64;

/// The limits of the verdicts by their keys.
const RULE: [(&str, RuleLimit); 5] = [
    ("go_slip_ratio", |it| it.go_slip_ratio),
    ("go_probability", |it| it.go_probability),
    ("go_drift_m_per_m", |it| it.go_drift_m_per_m),
    ("no_go_slip_ratio", |it| it.no_go_slip_ratio),
    ("no_go_probability", |it| it.no_go_probability),
];

/// Those of a question; the usual ones where it says nothing of them.
pub(super) fn of(fields: &AskedFields) -> Result<Rule, Refusal> {
    let mut limits = [0.0; 5];
    for ((name, usual), limit) in RULE.into_iter().zip(&mut limits) {
        *limit = fields.number(name, &SHARE)?.unwrap_or(usual(&Rule::DEFAULT));
    }
    let [go_slip_ratio, go_probability, go_drift_m_per_m, no_go_slip_ratio, no_go_probability] =
        limits;
    let rule = Rule {
        go_slip_ratio,
        go_probability,
        go_drift_m_per_m,
        no_go_slip_ratio,
        no_go_probability,
    };
    let checked = rule.check();
    checked.map_err(|it| Refusal::new(StatusCode::UNPROCESSABLE_ENTITY, it.to_string()))?;
    Ok(rule)
}

/// Adds those that are not the usual ones.
pub(super) fn add_words(rule: &Rule, line: &mut CommandLine) {
    for (name, of) in RULE {
        if of(rule) != of(&Rule::DEFAULT) {
            line.option(&name.replace('_', "-"), &of(rule).to_string());
        }
    }
}
