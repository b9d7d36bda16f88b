//! The test drives that tell most of tomorrow's slopes for what they cost.
//!
//! A leg on a slope at a yaw would be taken in by the filter as stretches of a decimetre. In a
//! filter of normal unknowns how much a stretch narrows the belief does not depend on what is read,
//! so that it is known beforehand:
//!
//! ```text
//! P' = P − P Jᵀ (J P Jᵀ + R)⁻¹ J P
//! ```
//!
//! with the line (J, R) that the filter itself fits over the width of what is believed, first
//! before and then after a stretch. Tomorrow's headings and slips are lines of the same unknowns, h
//! ≈ H x, and what a leg tells of them is
//!
//! ```text
//! I = ½ ln det(H P Hᵀ + D) − ½ ln det(H P' Hᵀ + D)
//! ```
//!
//! with what nobody needs to know better, *D*. Legs are chosen one after the other, each as that
//! with the most information for its cost after those before it.

use nalgebra::{Cholesky, DMatrix, DVector};

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use super::super::DISCREPANCY;
use super::super::filter::Filter;
use super::super::gaussian::{Gaussian, Line};
use super::super::motion::SeenMotion;
use super::super::settings::LearnSettings;
use super::super::stretch;
use super::course::{moving, slip_of};
use super::instruments::Instruments;
use super::leg::TestLeg;
use super::limits::Limits;
use crate::elementary::wide::{ln, sin};
use crate::simulation::SteadyMotion;
use crate::studies::ensemble::samples::{Sample, outputs_of_samples};
use crate::studies::ensemble::{Probability, outputs};
use crate::studies::heading::{HeadingStudy, STUCK};
use crate::vehicle::{Mount, WheelReaction};
use grouser_io::statistics::random::place_below;

/// What a leg costs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TestCost {
    /// Work of the wheels that pull, and that by which lost height is won back [J].
    #[default]
    Energy,
    /// Way of the rims [m].
    Way,
}

impl TestCost {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Energy, Self::Way];

    /// One word: `energy`, `way`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Energy => "energy",
            Self::Way => "way",
        }
    }
}

/// Which test drives there may be.
#[derive(Clone, Debug, PartialEq)]
pub struct TestSettings {
    /// Legs to choose among.
    pub legs: Vec<TestLeg>,
    /// What they cost.
    pub cost: TestCost,
    /// How many to choose.
    pub count: usize,
    /// What is read on the way.
    pub instruments: Instruments,
}

/// Yaws at which legs are tried [rad]: along the contour, crabwise up, straight up, crabwise down,
/// straight down.
const YAWS: [f64; 5] = [0.0, FRAC_PI_4, FRAC_PI_2, -FRAC_PI_4, -FRAC_PI_2];

impl TestSettings {
    /// Legs of one length [m] on some slopes [rad]: along the contour, at 45° and straight up and
    /// down; on level ground, where all yaws are alike, along it alone.
    #[must_use]
    pub fn on_slopes(slopes: &[f64], way: f64) -> Self {
        let each = slopes.iter().flat_map(|slope| {
            let yaws = if *slope == 0.0 { &YAWS[..1] } else { &YAWS[..] };
            yaws.iter().map(|yaw| TestLeg { slope: *slope, yaw: *yaw, way })
        });
        Self {
            legs: each.collect(),
            cost: TestCost::default(),
            count: 3,
            instruments: Instruments::usual(),
        }
    }
}

/// What test drives would tell.
#[derive(Clone, Debug, PartialEq)]
pub struct TestDrives {
    /// Every leg on its own, by the most information for its cost.
    pub legs: Vec<TestDrive>,
    /// The legs to drive, one after the other; none where there is nothing to learn of the slopes.
    pub chosen: Vec<TestDrive>,
    /// The heading that is least certain before any of them: its slope [rad].
    pub slope: Option<f64>,
}

/// What a leg would tell, after those before it.
#[derive(Clone, Debug, PartialEq)]
pub struct TestDrive {
    /// The leg.
    pub leg: TestLeg,
    /// Mean slip ratio of the wheels that is expected [-].
    pub slip_ratio: f64,
    /// Work of the wheels that pull, and that by which lost height is won back [J].
    pub energy: f64,
    /// Samples in which the slip keeps its limit.
    pub within: Probability,
    /// Width of the 95 % band of the heading that is least certain, before it and after it [rad].
    pub widths: [f64; 2],
    /// Width of the 95 % band of the slip on that slope, before it and after it [-].
    pub slip_widths: [f64; 2],
    /// What it tells of the headings and slips of the slopes [nat].
    pub information: f64,
    /// The same for its cost [nat/J] or [nat/m].
    pub per_cost: f64,
    /// Standard deviations of the soil's uncertain numbers after it over those before any [-], by
    /// their keys.
    pub left: Vec<(String, f64)>,
}

/// Longer legs count as having so many stretches: beyond that nothing is left to tell.
const MOST_STRETCHES: usize = 1000;
/// Legs that tell less than this are not worth driving [nat]: a band that narrows by 2 %.
const LEAST_INFORMATION: f64 = 0.02;
/// Nobody needs to know a heading better than this [rad], half a degree, nor a slip [-]. Source:
/// ours.
const HEADING_NEEDED: f64 = 0.5 * std::f64::consts::PI / 180.0;
const SLIP_NEEDED: f64 = 0.02;

/// Work of the wheels that pull over a leg, and that by which height is won back that was lost on
/// it [J]: motors that brake give nothing back, and a leg downhill is not for nothing.
fn work(study: &HeadingStudy, motion: &SteadyMotion, leg: &TestLeg, rim_speed: f64) -> f64 {
    let each = motion.wheels.iter().zip(study.rover.mounts());
    let thrust = |(wheel, mount): (&WheelReaction, &Mount)| {
        wheel.settled.forces.torque.max(0.0) / mount.shearing_radius()
    };
    let pulled: f64 = each.map(thrust).sum::<f64>() * leg.way;
    let way = motion.speed() / rim_speed * leg.way;
    let lost = -way * sin(motion.course()) * sin(leg.slope);
    pulled + study.rover.mass() * study.gravity * lost.max(0.0)
}

/// Width of a 95 % band, in standard deviations.
const WIDTH: f64 = 2.0 * 1.959_963_984_540_054;

/// Where test drives are planned.
pub(super) struct Planner<'a> {
    pub(super) study: &'a HeadingStudy,
    pub(super) settings: &'a LearnSettings,
    /// Filter of the model with the greatest share.
    pub(super) filter: &'a Filter,
    pub(super) limits: &'a Limits,
    pub(super) tests: &'a TestSettings,
}

/// Headings and slips of the slopes ahead as lines of the unknowns.
struct Target {
    slopes: Vec<f64>,
    /// A row for each slope's heading over what is needed, then one for each slope's slip.
    jacobian: DMatrix<f64>,
    /// A row for each of the soil's uncertain keys.
    values: Option<DMatrix<f64>>,
}

/// A leg that can be driven.
struct Candidate {
    leg: TestLeg,
    stretch: SeenMotion,
    /// Stretches that it has.
    stretches: usize,
    slip_ratio: f64,
    energy: f64,
    within: Probability,
}

impl Planner<'_> {
    /// * `samples`: by which legs are judged as safe
    /// * `slopes`: that come next [rad]
    /// * `go_on`: asked before each leg; `None` if it was false
    pub(super) fn plan(
        &self,
        samples: &[Sample],
        slopes: &[f64],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<TestDrives> {
        let none = TestDrives { legs: Vec::new(), chosen: Vec::new(), slope: None };
        let Some(target) = self.target(slopes) else { return Some(none) };
        let mut candidates = Vec::new();
        for leg in &self.tests.legs {
            let slips = self.slips(leg, samples, go_on)?;
            candidates.extend(self.candidate(leg, &slips));
        }
        let mut belief = self.filter.belief.clone();
        let mut drives = TestDrives { slope: target.least_certain(&belief).map(|it| it.1), ..none };
        for round in 0..self.tests.count {
            let mut told = self.told(&candidates, &target, &belief, go_on)?;
            told.sort_by(|(one, _), (other, _)| other.per_cost.total_cmp(&one.per_cost));
            let worth = |it: &&(TestDrive, Gaussian)| it.0.information >= LEAST_INFORMATION;
            let best = told.iter().find(worth).cloned();
            if round == 0 {
                drives.legs = told.into_iter().map(|it| it.0).collect();
            }
            let Some((drive, after)) = best else { break };
            drives.chosen.push(drive);
            belief = after;
        }
        Some(drives)
    }

    /// What each leg tells, with what is believed after it.
    fn told(
        &self,
        candidates: &[Candidate],
        target: &Target,
        belief: &Gaussian,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<(TestDrive, Gaussian)>> {
        let each = outputs(candidates, |candidate| {
            go_on().then(|| {
                let after = self.after(candidate, belief)?;
                Some((self.drive(candidate, target, belief, &after), after))
            })
        });
        each.into_iter().collect::<Option<Vec<_>>>().map(|it| it.into_iter().flatten().collect())
    }

    fn drive(
        &self,
        candidate: &Candidate,
        target: &Target,
        belief: &Gaussian,
        after: &Gaussian,
    ) -> TestDrive {
        let information = target.uncertainty(belief) - target.uncertainty(after);
        let cost = match self.tests.cost {
            TestCost::Energy => candidate.energy,
            TestCost::Way => candidate.leg.way,
        };
        let place = target.least_certain(&self.filter.belief).map_or(0, |it| it.0);
        TestDrive {
            leg: candidate.leg,
            slip_ratio: candidate.slip_ratio,
            energy: candidate.energy,
            within: candidate.within,
            widths: [belief, after].map(|it| target.heading_width(it, place)),
            slip_widths: [belief, after].map(|it| target.slip_width(it, place)),
            information,
            per_cost: information / cost.max(f64::MIN_POSITIVE),
            left: target.values.as_ref().map_or(Vec::new(), |it| self.left(it, after)),
        }
    }

    /// How the values of the soil's uncertain keys go with the unknowns: a line for each.
    fn values(&self) -> Option<DMatrix<f64>> {
        let unknowns = &self.filter.unknowns;
        let values = |at: &DVector<f64>| unknowns.values(at.as_slice()).map(DVector::from_vec);
        let belief = &self.filter.belief;
        Some(Line::over(belief, &values(&belief.mean)?, values).jacobian)
    }

    /// What is left of the uncertainty of the soil's keys.
    fn left(&self, values: &DMatrix<f64>, after: &Gaussian) -> Vec<(String, f64)> {
        let deviations = |it: &Gaussian| {
            let covariance = values * &it.covariance * values.transpose();
            covariance.diagonal().map(|variance| variance.max(0.0).sqrt())
        };
        let (before, after) = (deviations(&self.filter.belief), deviations(after));
        let keys = self.filter.unknowns.keys().zip(before.iter().zip(after.iter()));
        let own = keys.filter(|(key, (before, _))| !key.starts_with(DISCREPANCY) && **before > 0.0);
        own.map(|(key, (before, after))| (key.to_owned(), after / before)).collect()
    }

    /// What is expected to be believed after a leg. The mean stays: nothing is known of where it
    /// will go.
    fn after(&self, candidate: &Candidate, belief: &Gaussian) -> Option<Gaussian> {
        let noise = &self.settings.noise;
        let line = |over: &Gaussian| {
            let fitted = self.filter.line(self.study, &candidate.stretch, noise, over);
            fitted.map(|it| it.line)
        };
        let stretch = |belief: &Gaussian, line: &Line| {
            let expected = &line.value + &line.jacobian * (&belief.mean - &line.at);
            belief.after(line, &expected)
        };
        let over_all = line(belief)?;
        let first = stretch(belief, &over_all)?;
        let narrower = line(&first)?;
        let mut after = belief.clone();
        for _ in 0..candidate.stretches {
            after = stretch(&after, &narrower)?;
        }
        Some(after)
    }

    /// Headings and slips of the slopes that can be held with the soil that is believed most.
    fn target(&self, slopes: &[f64]) -> Option<Target> {
        let belief = &self.filter.belief;
        let held = |at: &DVector<f64>, slopes: &[f64]| {
            let sample = self.filter.unknowns.sample(at.as_slice())?;
            let curve = self.study.of_sample(&sample).curve().ok()?;
            let held = |slope: &f64| match curve.at(*slope) {
                // Where the search gave up nothing is known, and nothing is learnt of it.
                Err(none) if none.is_not_found() => None,
                found => Some(found.ok()),
            };
            slopes.iter().map(held).collect::<Option<Vec<_>>>()
        };
        let of_mean = held(&belief.mean, slopes)?;
        let known = slopes.iter().zip(&of_mean).filter(|it| it.1.is_some());
        let slopes: Vec<f64> = known.map(|it| *it.0).collect();
        if slopes.is_empty() {
            return None;
        }
        let here: Vec<[f64; 2]> =
            of_mean.iter().flatten().map(|it| [it.yaw, it.slip_ratio]).collect();
        let numbers = |pairs: &[[f64; 2]]| {
            let yaws = pairs.iter().map(|it| it[0] / HEADING_NEEDED);
            let slips = pairs.iter().map(|it| it[1] / SLIP_NEEDED);
            DVector::from_vec(yaws.chain(slips).collect())
        };
        let f = |at: &DVector<f64>| {
            let there = held(at, &slopes)?;
            // Where no heading holds the contour the wheels turn on the spot; a heading it has not.
            let pairs: Vec<[f64; 2]> = here
                .iter()
                .zip(there)
                .map(|(here, it)| it.map_or([here[0], STUCK], |it| [it.yaw, it.slip_ratio]))
                .collect();
            Some(numbers(&pairs))
        };
        let jacobian = Line::over(belief, &numbers(&here), f).jacobian;
        Some(Target { slopes, jacobian, values: self.values() })
    }

    /// Mean slip ratio of the wheels on a leg, in each of the samples [-].
    fn slips(
        &self,
        leg: &TestLeg,
        samples: &[Sample],
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<f64>> {
        let (course, rim_speed) = ((leg.slope, leg.yaw), self.limits.rim_speed);
        outputs_of_samples(samples, go_on, |sample| {
            slip_of(moving(&self.study.of_sample(sample), course, rim_speed, None).as_ref())
        })
    }

    /// A leg, if its slip keeps the limit and the rover moves on it with the soil that is believed
    /// most.
    fn candidate(&self, leg: &TestLeg, slips: &[f64]) -> Option<Candidate> {
        let kept = slips.iter().filter(|slip| **slip <= self.limits.slip_ratio).count();
        let within = Probability { successes: kept, trials: slips.len() };
        if !self.limits.is_kept(kept, slips.len()) {
            return None;
        }
        let rim_speed = self.limits.rim_speed;
        let most = self.filter.unknowns.sample(self.filter.belief.mean.as_slice())?;
        let study = self.study.of_sample(&most);
        let motion = moving(&study, (leg.slope, leg.yaw), rim_speed, None)?;
        let velocities = [motion.velocity.x, motion.velocity.y, motion.yaw_rate];
        let stretch = self.tests.instruments.stretch(leg, rim_speed, velocities, &study.rover);
        Some(Candidate {
            leg: *leg,
            stretch: SeenMotion::of(&stretch, &study.rover).ok()?,
            stretches: place_below(leg.way / stretch::WAY + 0.5, MOST_STRETCHES).max(1),
            slip_ratio: motion.slip_ratio(),
            energy: work(&study, &motion, leg, rim_speed),
            within,
        })
    }
}

impl Target {
    fn covariance(&self, belief: &Gaussian) -> DMatrix<f64> {
        &self.jacobian * &belief.covariance * self.jacobian.transpose()
    }

    /// ½ ln det(H P Hᵀ + D) [nat], in units of what is needed.
    fn uncertainty(&self, belief: &Gaussian) -> f64 {
        let covariance = self.covariance(belief);
        let size = covariance.nrows();
        let root = Cholesky::new(covariance + DMatrix::identity(size, size));
        root.map_or(0.0, |root| root.l().diagonal().iter().map(|it| ln(*it)).sum())
    }

    fn deviation(&self, belief: &Gaussian, row: usize) -> f64 {
        let covariance = self.covariance(belief);
        covariance[(row, row)].max(0.0).sqrt()
    }

    /// Width of the heading's 95 % band on one of the slopes [rad].
    fn heading_width(&self, belief: &Gaussian, place: usize) -> f64 {
        WIDTH * HEADING_NEEDED * self.deviation(belief, place)
    }

    /// The same of the slip [-].
    fn slip_width(&self, belief: &Gaussian, place: usize) -> f64 {
        WIDTH * SLIP_NEEDED * self.deviation(belief, self.slopes.len() + place)
    }

    /// The slope whose heading is least certain: its place, and the slope [rad].
    fn least_certain(&self, belief: &Gaussian) -> Option<(usize, f64)> {
        let widths = (0..self.slopes.len()).map(|place| (place, self.heading_width(belief, place)));
        let (place, _) = widths.max_by(|one, other| one.1.total_cmp(&other.1))?;
        Some((place, self.slopes[place]))
    }
}
