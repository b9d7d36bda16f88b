//! Stated probabilities of a no-go against drives by simulation.
//!
//! Cells of uneven ground are drawn, with a stated probability of a no-go on a course. On each the
//! rover is driven in a soil and by a model that the probability knows nothing of: it starts with
//! the heading of the map, measures over every stretch which course it made good, and turns by what
//! it is off. A drive is a no-go if the rover stops or slides, if it slips more than the rule
//! allows, or if no heading that it tries holds the course.

use std::f64::consts::FRAC_PI_2;

use grouser::document::{self, LoadedScenario, Overrides, Source};
use grouser::simulation::{Approach, Outcome, PrescribedYaw, Run, Scenario};
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::studies::mobility::{CellMotion, CourseChoice, Ground, MobilityMap};
use grouser::studies::verdict::SlopeStudy;
use grouser::terrain::ElevationGrid;
use grouser::units::{Vec2, deg};
use grouser::vehicle::DriveLaw;
use grouser_raster::{CoordinateSystem, Raster};
use rayon::prelude::*;

/// Courses that are driven: along the contour, and across it.
const COURSES: [f64; 2] = [0.0, std::f64::consts::FRAC_PI_4];
/// Seed of the samples that probabilities are stated by; drives have another.
const STATED_SEED: u64 = 1;
const DRIVEN_SEED: u64 = 2;

/// A drive: what was stated, and what came of it.
struct Drive {
    stated: f64,
    is_no_go: bool,
}

/// Hills that nothing repeats, from level to steeper than any sample can drive on.
fn ground() -> Raster {
    let spacing = Vec2::new(0.5, 0.5);
    let grid = ElevationGrid { columns: 120, rows: 120, south_west: Vec2::zeros(), spacing };
    let height = |at: Vec2| {
        2.6 * f64::sin(0.21 * at.x + 0.4) * f64::cos(0.17 * at.y)
            + 0.9 * f64::sin(0.37 * at.y - 0.2 * at.x)
    };
    #[expect(clippy::cast_possible_truncation, reason = "heights of a test")]
    let heights = grid.points().map(|at| height(at) as f32).collect();
    Raster {
        grid,
        base: 0.0,
        heights,
        coordinates: CoordinateSystem::default(),
        remarks: Vec::new(),
    }
}

/// * `samples`: that probabilities are stated by
fn drives(count: usize, samples: u32) -> Vec<Drive> {
    let overrides = Overrides::parse(["scenario.soil=toyoura-uncertain"]).unwrap();
    let loaded = document::read_scenario(&Source::default_scenario(), &overrides).unwrap();
    let study = SlopeStudy::of(&loaded);
    let inputs = BandInputs::of_scenario(&loaded);
    let samples = inputs.samples(STATED_SEED, samples).unwrap();
    let maps = COURSES.map(|course| {
        let choice = CourseChoice::Fixed(course);
        // Probabilities are looked at, and no verdict: that of level ground is enough.
        MobilityMap::of(&study, choice, 0.0, &samples, &|| true).unwrap().unwrap()
    });
    let raster = ground();
    let ground = Ground::under(&study.heading.rover, &raster);
    // Cells all over the map, far from each other.
    let cells = (0..).map(|number: usize| (number * 7919) % raster.heights.len());
    // From slopes that all samples can drive on to those that few can.
    let slopes = deg(9.0)..deg(24.0);
    let chosen = cells.enumerate().filter_map(|(number, cell)| {
        let map = &maps[number % COURSES.len()];
        let (column, row) = (cell % raster.grid.columns, cell / raster.grid.columns);
        let found = ground.at(map, column, row)?;
        slopes.contains(&found.slope).then_some((map, found))
    });
    let chosen: Vec<_> = chosen.take(count).enumerate().collect();
    let one = |(number, (map, found)): (usize, (&MobilityMap, CellMotion))| {
        let sample = inputs.sample(DRIVEN_SEED, number as u64).unwrap();
        // Where the soil as written has no heading, one begins with that of the steepest slope that
        // has one.
        let table = &map.tables()[0];
        let motion = found.motion.or_else(|| table.motion(table.limit()?)).unwrap();
        let drive = On { loaded: &loaded, study: &study, sample, slope: found.slope };
        let is_no_go = drive.is_no_go(found.course, found.course + motion.crab);
        Drive { stated: found.probability_no_go, is_no_go }
    };
    chosen.into_par_iter().map(one).collect()
}

/// Ground as steep as a cell, with the soil and the model of a sample.
struct On<'a> {
    loaded: &'a LoadedScenario,
    study: &'a SlopeStudy,
    sample: Sample,
    slope: f64,
}

impl On<'_> {
    /// * `course`: to be held [rad]
    /// * `yaw`: at the start [rad]
    fn is_no_go(&self, course: f64, mut yaw: f64) -> bool {
        /// Stretches after which a rover that still is off its course gives up.
        const STRETCHES: usize = 60;
        /// A course that is so near is held [rad].
        const HELD: f64 = 0.003;
        for _ in 0..STRETCHES {
            let Some((slip_ratio, made_good)) = self.stretch(yaw) else { return true };
            let off = course - made_good;
            if off.abs() < HELD {
                return slip_ratio > self.study.rule.no_go_slip_ratio;
            }
            yaw += off;
            if yaw > course + FRAC_PI_2 {
                return true;
            }
        }
        true
    }

    /// Slip ratio, and the course that is made good [rad], over some seconds; none if the rover
    /// stops or slides.
    fn stretch(&self, yaw: f64) -> Option<(f64, f64)> {
        let rim_speed = self.study.rim_speed;
        let mut scenario: Scenario = self.loaded.value.clone();
        scenario.ground.soil = self.sample.soil;
        scenario.ground = scenario.ground.with_slope(self.slope);
        scenario.model = self.sample.model.clone();
        scenario.drive = DriveLaw::Constant(rim_speed);
        scenario.numerics.approach = Approach::QuasiSteady;
        scenario.yaw = Some(PrescribedYaw { points: vec![(0.0, yaw)] });
        scenario.start.yaw = yaw;
        scenario.duration = 4.0;
        // What cannot be computed any more has sunk in.
        let trajectory = Run::new(&scenario).and_then(Run::to_end).ok()?;
        if trajectory.outcome != Outcome::Completed {
            return None;
        }
        let middle = &trajectory.records[trajectory.records.len() / 2];
        let (from, to) = (middle.state.position, trajectory.last().state.position);
        let way = to - from;
        let ahead =
            (way.x * yaw.cos() + way.y * yaw.sin()) / (trajectory.last().time - middle.time);
        Some((1.0 - ahead / rim_speed, way.y.atan2(way.x)))
    }
}

/// Drives by stated probability, in tenths: how many, their mean stated probability, and the share
/// that was a no-go.
fn by_tenth(drives: &[Drive]) -> Vec<(usize, f64, f64)> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 9")]
    let tenth = |drive: &Drive| ((drive.stated * 10.0) as usize).min(9);
    let bin = |number: usize| {
        let own = || drives.iter().filter(move |drive| tenth(drive) == number);
        let count = own().count();
        let mean = |of: fn(&Drive) -> f64| own().map(of).sum::<f64>() / count.max(1) as f64;
        (count, mean(|it| it.stated), mean(|it| f64::from(u8::from(it.is_no_go))))
    };
    (0..10).map(bin).collect()
}

/// How far an observed share may be off a stated one: three standard errors, those of the drives
/// and of the samples that the probability was stated by.
fn allowance(stated: f64, drives: usize, samples: u32) -> f64 {
    let variance = (stated * (1.0 - stated)).max(0.01);
    3.0 * (variance / drives as f64 + variance / f64::from(samples)).sqrt()
}

fn check(count: usize, samples: u32) {
    let drives = drives(count, samples);
    let mean = |of: &dyn Fn(&Drive) -> f64| drives.iter().map(of).sum::<f64>() / count as f64;
    let observed = mean(&|it| f64::from(u8::from(it.is_no_go)));
    let stated = mean(&|it| it.stated);
    let brier = mean(&|it| (it.stated - f64::from(u8::from(it.is_no_go))).powi(2));
    let without = observed * (1.0 - observed);
    println!(
        "{count} drives: stated {stated:.3}, observed {observed:.3}, Brier {brier:.4}, of the mean \
         {without:.4}"
    );
    println!("| stated | drives | mean stated | observed |\n|---|---|---|---|");
    let bins = by_tenth(&drives);
    for (number, (count, stated, observed)) in bins.iter().enumerate() {
        println!("| 0.{number} … | {count} | {stated:.3} | {observed:.3} |");
    }
    assert!((observed - stated).abs() < allowance(stated, count, samples), "{observed} {stated}");
    for (count, stated, observed) in bins.into_iter().filter(|(count, ..)| *count > 0) {
        let off = (observed - stated).abs();
        assert!(off < allowance(stated, count, samples), "{count}: {stated} {observed}");
    }
    // It tells apart what can be driven and what cannot.
    assert!(brier < 0.9 * without, "{brier} {without}");
}

#[test]
fn a_stated_probability_is_the_share_of_drives_that_fail() {
    check(50, 80);
}

#[test]
#[ignore = "minutes: a thousand drives"]
fn a_stated_probability_is_the_share_of_a_thousand_drives_that_fail() {
    check(1000, 400);
}
