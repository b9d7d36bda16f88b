//! Statistics of a campaign's runs. This module alone decides which runs are independent samples.
//!
//! In a campaign laid out for sensitivities, a point is run as A, as B, and as A with each input of
//! B in turn. Only A and B are independent samples; the others repeat them but for one input.
//! Summaries and probabilities are therefore over A and B alone, and sensitivities over all runs of
//! whole points.

use std::collections::BTreeMap;
use std::ops::Range;

use super::super::columns::OK;
use super::Campaign;
use crate::simulation::{OutcomeKind, Severity};
use crate::studies::ensemble::sensitivity::Sensitivity;
use crate::studies::ensemble::statistics::{Convergence, Summary};
use crate::studies::ensemble::{Ensemble, Probability};

/// Statistics of one quantity over runs.
#[derive(Clone, Debug, PartialEq)]
pub struct QuantityStatistics {
    /// How many independent samples there are, with or without the quantity.
    pub samples: usize,
    /// Over the independent samples; nothing if fewer than two have the quantity.
    pub summary: Option<Summary>,
    /// The same after the first samples.
    pub convergence: Vec<Convergence>,
    /// Sobol indices, if the campaign was laid out for them and the quantity varies.
    pub sensitivity: Option<Sensitivity>,
}

impl QuantityStatistics {
    /// * `runs`: numbers of the runs that there are, in order
    /// * `values`: of these runs, `None` for those without the quantity
    /// * `shares`: of the quantiles [-], above 0 and below 1
    #[must_use]
    pub fn of(
        campaign: &Campaign,
        runs: &[Range<u64>],
        values: &[Option<f64>],
        shares: &[f64],
    ) -> Self {
        let plan = campaign.ensemble();
        let numbered = || runs.iter().cloned().flatten().zip(values.iter().copied());
        if !plan.is_for_sensitivity() {
            return Self::of_samples(values, shares, None);
        }
        let samples: Vec<Option<f64>> =
            numbered().filter(|(run, _)| plan.is_sample(*run)).map(|(_, value)| value).collect();
        let points = whole_points(plan, numbered());
        let sensitivity = Sensitivity::of(&points, plan.dimensions(), campaign.seed());
        Self::of_samples(&samples, shares, sensitivity)
    }

    fn of_samples(
        samples: &[Option<f64>],
        shares: &[f64],
        sensitivity: Option<Sensitivity>,
    ) -> Self {
        Self {
            samples: samples.len(),
            summary: Summary::of(samples, shares),
            convergence: Convergence::of(samples, shares),
            sensitivity,
        }
    }
}

/// The values of those points all runs of which are there, one point after another: where a part of
/// a campaign ends, a point may be cut in two.
fn whole_points(
    plan: &Ensemble,
    runs: impl Iterator<Item = (u64, Option<f64>)>,
) -> Vec<Option<f64>> {
    let length = plan.runs_per_point();
    let (mut all, mut point, mut next) = (Vec::new(), Vec::new(), 0);
    for (run, value) in runs {
        if run % length == 0 || run != next {
            point.clear();
        }
        next = run + 1;
        // What goes on a point whose start is elsewhere.
        if point.len() as u64 != run % length {
            continue;
        }
        point.push(value);
        if point.len() as u64 == length {
            all.append(&mut point);
        }
    }
    all
}

/// Counts of statuses and outcomes over the independent samples.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Frequencies {
    /// How many independent samples there are.
    pub samples: usize,
    /// How often each status is.
    pub statuses: BTreeMap<String, usize>,
    /// How often each outcome is, for traverses and missions.
    pub outcomes: BTreeMap<String, usize>,
    /// How often the outcome or, without one, the status is each word.
    pub events: BTreeMap<String, usize>,
    /// Samples without a result, or not completed.
    pub failures: usize,
    /// How often each word stands in a column of words about a leg: `stopped` in `leg_2.outcome`.
    /// In the columns' order.
    pub legs: Vec<(String, BTreeMap<String, usize>)>,
}

impl Frequencies {
    /// Counts some runs.
    ///
    /// * `runs`: their numbers
    /// * `statuses`, `outcomes`: theirs; no outcomes for studies without them
    pub fn add(
        &mut self,
        campaign: &Campaign,
        runs: Range<u64>,
        statuses: &[Option<String>],
        outcomes: &[Option<String>],
    ) {
        for (place, run) in runs.enumerate() {
            if campaign.ensemble().is_sample(run) {
                let word = |words: &[Option<String>]| words.get(place).cloned().flatten();
                self.count(word(statuses).unwrap_or_default(), word(outcomes));
            }
        }
    }

    /// Counts the words of a column about a leg in some runs.
    ///
    /// * `runs`: their numbers
    /// * `column`: one of [`Campaign::words_of_legs`]
    /// * `words`: theirs; none for legs that nothing stopped, and for runs without an answer
    pub fn add_of_leg(
        &mut self,
        campaign: &Campaign,
        runs: Range<u64>,
        column: &str,
        words: &[Option<String>],
    ) {
        let known = self.legs.iter().position(|(name, _)| name == column);
        let place = known.unwrap_or_else(|| {
            self.legs.push((column.to_owned(), BTreeMap::new()));
            self.legs.len() - 1
        });
        let counts = &mut self.legs[place].1;
        let samples = runs.zip(words).filter(|(run, _)| campaign.ensemble().is_sample(*run));
        for word in samples.filter_map(|(_, word)| word.clone()) {
            *counts.entry(word).or_default() += 1;
        }
    }

    fn count(&mut self, status: String, outcome: Option<String>) {
        let kind = outcome.as_deref().map(OutcomeKind::of_name);
        let is_failure = status != OK || kind.is_some_and(|it| !is_good(it));
        self.samples += 1;
        self.failures += usize::from(is_failure);
        *self.events.entry(outcome.clone().unwrap_or_else(|| status.clone())).or_default() += 1;
        *self.statuses.entry(status).or_default() += 1;
        if let Some(outcome) = outcome {
            *self.outcomes.entry(outcome).or_default() += 1;
        }
    }

    /// The probability of an event by its count; nothing without samples.
    #[must_use]
    pub fn probability(&self, count: usize) -> Option<Probability> {
        (self.samples > 0).then_some(Probability { successes: count, trials: self.samples })
    }
}

/// Whether an end is that of a run that did what was asked for; a name that is not known is not.
fn is_good(kind: Option<OutcomeKind>) -> bool {
    kind.is_some_and(|kind| kind.row().severity == Severity::Good)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::{Overrides, Source, read_campaign};

    /// Two inputs, so that a point has the runs A, B, and A with either input exchanged.
    fn campaign() -> Campaign {
        let text = "schema = \"campaign/1\"\nstudy = \"wheel-test\"\nruns = 8\nsensitivity = true\n\
             wheel_test = { soil = \"toyoura\", wheel = \"hakuto\", load_n = 17.0, slip_ratio = 0.2 }\n\
             parameter = [\
             { key = \"load_n\", distribution = \"uniform\", low = 10.0, high = 20.0 },\
             { key = \"slip_ratio\", distribution = \"uniform\", low = 0.1, high = 0.3 }]\n";
        let source = Source::text("study.toml", text.to_owned());
        read_campaign(&source, &Overrides::none()).unwrap()
    }

    #[test]
    fn runs_with_an_exchanged_input_are_no_samples() {
        let campaign = campaign();
        let all = 0..campaign.runs();
        let values: Vec<Option<f64>> = all.clone().map(|run| Some(run as f64)).collect();
        let found = QuantityStatistics::of(&campaign, std::slice::from_ref(&all), &values, &[0.5]);
        // Of 32 runs, 0, 1, 4, 5 … 28, 29.
        assert_eq!(found.samples, 16);
        let summary = found.summary.unwrap();
        assert_eq!((summary.count, summary.least, summary.most), (16, 0.0, 29.0));
        assert_eq!(found.sensitivity.unwrap().points, 8);
        let words = vec![Some("ok".to_owned()); 32];
        let mut frequencies = Frequencies::default();
        frequencies.add(&campaign, all, &words, &[]);
        assert_eq!((frequencies.samples, frequencies.statuses["ok"]), (16, 16));
    }

    /// Only whole points count for sensitivities in a part whose shards of three runs cut points of
    /// four in two.
    #[test]
    fn points_that_a_part_cuts_in_two_are_left_out() {
        let campaign = campaign();
        let runs = [0..3, 6..9, 9..12, 12..15, 15..18];
        let numbers = || runs.iter().cloned().flatten();
        let whole = whole_points(campaign.ensemble(), numbers().map(|run| (run, Some(run as f64))));
        let expected: Vec<Option<f64>> = (8..16).map(|run| Some(f64::from(run))).collect();
        assert_eq!(whole, expected);
    }
}
