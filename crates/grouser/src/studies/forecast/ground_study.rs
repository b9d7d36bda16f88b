//! The forecast on one ground: its cases, their bands and their error budget.

use super::case::{self, OfCase};
use super::choices::{Choices, Ground, with_strength_of};
use super::error::ForecastError;
use super::factor::{Factor, FactorKind};
use super::result::{GroundForecast, SlopeForecast};
use super::study::{ForecastStudy, design_of};
use super::support::Support;
use crate::contact::validity::{Finding, Flag};
use crate::soil::GravityScaling;
use crate::studies::ensemble::factorial::Factorial;
use crate::studies::ensemble::samples::BandInputs;
use crate::studies::ensemble::{Band, outputs_while};
use crate::studies::heading::HeadingStudy;

/// One ground, and the scalings of its cases.
pub(super) struct GroundStudy<'s> {
    pub(super) study: &'s ForecastStudy,
    pub(super) band: &'s BandInputs,
    pub(super) ground: &'s Ground,
    pub(super) scalings: Vec<GravityScaling>,
    pub(super) support: Support,
}

/// Places of the sampled factors: soil, and what a model gets wrong.
const SAMPLED: [usize; 2] = [2, 3];

impl GroundStudy<'_> {
    /// All factors with their levels, as in [`FactorKind::ALL`].
    fn factors(&self) -> Vec<Factor> {
        let [model, soils, discrepancies] = self.study.sampled(self.band, Some(self.ground));
        let masses = self.study.choices.masses.iter().map(|mass| mass.name.as_str());
        let scalings = self.scalings.iter().map(|it| it.name());
        let mass = Factor::named(FactorKind::RoverMass, masses);
        let scaling = Factor::named(FactorKind::GravityScaling, scalings);
        vec![mass, model, soils, discrepancies, scaling]
    }

    /// How many groups of cases there are; those of a group differ in the scaling alone.
    pub(super) fn groups(&self) -> usize {
        design_of(&self.factors()).cases() / self.scalings.len()
    }

    /// The forecast; nothing if `go_on` was false before the end.
    pub(super) fn forecast(
        &self,
        slopes: &[f64],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<GroundForecast>, ForecastError> {
        let factors = self.factors();
        let design = design_of(&factors);
        let one = |group: usize| self.group(&design.levels(group * self.scalings.len()), slopes);
        let Some(found) = outputs_while(0..self.groups(), go_on, one) else { return Ok(None) };
        // In order, so that the error is always that of the first case.
        let found = found.into_iter().collect::<Result<Vec<Vec<OfCase>>, _>>()?;
        let cases: Vec<OfCase> = found.into_iter().flatten().collect();
        let limits: Vec<f64> = cases.iter().map(|case| case.limit).collect();
        let findings = self.findings(slopes)?;
        let on_slope = |((place, slope), findings): ((usize, &f64), Vec<Finding>)| {
            let on = cases.iter().map(|case| case.slopes[place]).collect::<Vec<_>>();
            SlopeForecast::over(&design, &on, self.study.no_go_slip_ratio, (*slope, findings))
        };
        Ok(Some(GroundForecast {
            ground: self.ground.name().to_owned(),
            scalings: self.scalings.clone(),
            support: self.support,
            slopes: slopes.iter().enumerate().zip(findings).map(on_slope).collect(),
            limit: Band::of(design.repeated(&limits)),
            limit_budget: design.budget(&limits),
            limit_means: means(&design, &limits),
            cases: cases.len(),
            factors,
        }))
    }

    /// The cases of all scalings, at levels of the other factors. Soils that come out alike are
    /// computed once.
    fn group(&self, levels: &[usize], slopes: &[f64]) -> Result<Vec<OfCase>, ForecastError> {
        let study = self.study;
        let sample = study.sample(self.band, &levels[1..4])?;
        let ground = self.ground.drawn(study.seed, levels[SAMPLED[0]] as u64)?;
        let factor = study.choices.masses[levels[0]].factor;
        let rover = study.heading.rover.with_mass_factor(factor)?;
        let heading = HeadingStudy { rover, ..study.heading.of_sample(&sample) };
        let mut found: Vec<(HeadingStudy, OfCase)> = Vec::new();
        for scaling in &self.scalings {
            // The strength of the site's ground is known there: nothing of it is scaled.
            let scaled = heading.soil.under(heading.gravity, study.measured_under, *scaling)?;
            let heading =
                HeadingStudy { soil: with_strength_of(scaled, ground), ..heading.clone() };
            let same = found.iter().find(|(other, _)| *other == heading);
            let case = match same {
                Some((_, case)) => case.clone(),
                None => OfCase::of(&heading, study.rim_speed, slopes)?,
            };
            found.push((heading, case));
        }
        Ok(found.into_iter().map(|(_, case)| case).collect())
    }

    /// The flags on each slope of the ground as written, with the first level of every choice.
    fn findings(&self, slopes: &[f64]) -> Result<Vec<Vec<Finding>>, ForecastError> {
        let ForecastStudy { heading, measured_under, choices, .. } = self.study;
        let Choices { masses, .. } = choices;
        let scaling = self.scalings.first().copied().unwrap_or(GravityScaling::Reece);
        let scaled = heading.soil.under(heading.gravity, *measured_under, scaling)?;
        let soil = with_strength_of(scaled, self.ground.as_written());
        let factor = masses.first().map_or(1.0, |mass| mass.factor);
        let rover = heading.rover.with_mass_factor(factor)?;
        let curve = HeadingStudy { rover, soil, ..heading.clone() }.curve()?;
        // Bekker's moduli that were scaled are no more under another gravity than they were made
        // for.
        let is_kept = self.scalings.contains(&GravityScaling::Bekker);
        let holds = |finding: &Finding| is_kept || finding.flag != Flag::BekkerGravity;
        let on_slope = |slope: &f64| {
            let findings = curve.findings(*slope, &curve.at(*slope));
            findings.into_iter().filter(holds).collect()
        };
        Ok(slopes.iter().map(on_slope).collect())
    }
}

impl SlopeForecast {
    fn over(
        design: &Factorial,
        cases: &[case::OnSlope],
        limit: f64,
        (slope, findings): (f64, Vec<Finding>),
    ) -> Self {
        let of = |of: fn(&case::OnSlope) -> f64| cases.iter().map(of).collect::<Vec<f64>>();
        let band = |of: fn(&case::OnSlope) -> f64| {
            Band::of(design.repeated(&cases.iter().map(of).collect::<Vec<_>>()))
        };
        let share = |holds: &dyn Fn(&case::OnSlope) -> bool| {
            design.share_of(&cases.iter().map(holds).collect::<Vec<_>>(), SAMPLED)
        };
        let (slips, drifts) = (of(|it| it.slip_ratio), of(|it| it.drift));
        Self {
            slope,
            slip_above_limit: share(&|it| it.is_stuck() || it.slip_ratio.abs() > limit),
            no_heading: share(&case::OnSlope::is_stuck),
            yaw: band(|it| it.yaw),
            slip_ratio: band(|it| it.slip_ratio),
            sinkage: band(|it| it.sinkage),
            drift: band(|it| it.drift),
            power: band(|it| it.power),
            energy_per_metre: band(|it| it.energy_per_metre),
            slip_budget: design.budget(&slips),
            drift_budget: design.budget(&drifts),
            slip_means: means(design, &slips),
            drift_means: means(design, &drifts),
            level_means: means(design, &of(|it| f64::from(u8::from(!it.is_stuck())))),
            findings,
        }
    }
}

/// The mean output at each level of each factor.
fn means(design: &Factorial, outputs: &[f64]) -> Vec<Vec<f64>> {
    (0..FactorKind::ALL.len()).map(|factor| design.means(factor, outputs)).collect()
}
