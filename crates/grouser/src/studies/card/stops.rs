//! Limits at which a mission turns back, by the card.

use super::super::verdict::{Rule, Verdict};
use super::Card;
use crate::mission::{Limited, Stop};

/// Limits that hold on every slope of a card that is a go or a caution.
#[derive(Clone, Debug, PartialEq)]
pub struct CardStops {
    /// Slip, drift, roll and pitch: at each the mission ends.
    pub stops: [Stop; 4],
    /// These slopes [rad], from level ground to the first no-go, each with the card's limit of the
    /// slip there [-].
    pub slopes: Vec<(f64, f64)>,
}

/// The longest way over which slip is taken [m]: what a limit of a mission has where nobody states
/// another, so that it holds on short legs, too. Source: ours.
const LONGEST_WAY: f64 = 1.0;

impl Card {
    /// Limits for a mission whose slopes are not known; `None` where no slope is a go or a caution.
    ///
    /// The slip's is that of the slope that the mission is on, which is the first of the card's that
    /// is as steep; without one the lowest of all: on each of them 97.5 % of the samples stay below
    /// the limit of that slope, which a steeper one only raises. It is taken over the shortest way
    /// between two looks at the slip, a metre at most. Roll and pitch are at most the steepest of
    /// these slopes, whatever the heading; drift is the rule's limit of a go.
    ///
    /// * `rule`: the one that the card was computed with
    /// * `on`: the slope of the mission [rad], if it is one; `None` comes of one that is steeper than
    ///   all that are a go or a caution
    #[must_use]
    pub fn stops(&self, rule: &Rule, on: Option<f64>) -> Option<CardStops> {
        /// Slopes that differ by less are the same [rad].
        const SAME: f64 = 1e-9;
        let driven = self.rows.iter().map(|row| &row.advice);
        let driven = driven.take_while(|it| it.judgement.verdict != Verdict::NoGo);
        let known =
            driven.filter(|it| matches!(it.judgement.verdict, Verdict::Go | Verdict::Caution));
        let checks: Vec<_> =
            known.filter_map(|it| Some((it.slope, it.driven?.motion?.slip_check))).collect();
        let (steepest, _) = checks.last()?;
        let of_slope = |on: f64| checks.iter().position(|(slope, _)| *slope >= on - SAME);
        let counting = match on {
            Some(on) => std::slice::from_ref(&checks[of_slope(on)?]),
            None => &checks[..],
        };
        let limit = counting.iter().map(|(_, check)| check.limit).fold(f64::INFINITY, f64::min);
        let over = counting.iter().map(|(_, check)| check.interval()).fold(LONGEST_WAY, f64::min);
        let slip = Stop { over, ..Stop::above(Limited::SlipRatio, limit) };
        let stops = [
            slip,
            Stop::above(Limited::DriftPerMetre, rule.go_drift_m_per_m),
            Stop::above(Limited::Roll, *steepest),
            Stop::above(Limited::Pitch, *steepest),
        ];
        let slopes = checks.iter().map(|(slope, check)| (*slope, check.limit)).collect();
        Some(CardStops { stops, slopes })
    }
}
