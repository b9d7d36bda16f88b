//! Every run ends: a run that takes more than it may take ends with an error, and its records until
//! then are kept.

use std::borrow::Cow;

use grouser::contact::{Contact, Model, WheelForces, WheelSoilModel};
use grouser::document::{Overrides, Source, read_scenario};
use grouser::simulation::{Approach, Run, RunError, Scenario};
use grouser::soil::Soil;
use grouser::terrain::{ElevationGrid, ElevationModel, Footprint, Ground, Patch, Terrain};
use grouser::units::Vec2;

use super::million::Draw;

/// Wavelength of what changes too fast [of its argument].
const TOO_SHORT: f64 = 1e-9;

/// The default drive across a slope, 2 s of it.
fn scenario() -> Scenario {
    let loaded = read_scenario(&Source::default_scenario(), &Overrides::none());
    Scenario { duration: 2.0, ..loaded.expect("the preset is read").value }
}

/// Ground like springs, whose friction changes up and down within a billionth of the slip where the
/// soil coheres.
struct Chattering;

/// The cohesion from which on it does [Pa].
const COHERES: f64 = 5e3;

impl WheelSoilModel for Chattering {
    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        let slip = &contact.slip;
        let slides = Vec2::new(slip.rim - slip.forward, -slip.lateral);
        let normal_force = 4e3 * sinkage;
        let size = if contact.soil.cohesion >= COHERES { 0.5 } else { 0.0 };
        let chatter = Vec2::new(size * (slides.x / TOO_SHORT).sin(), 0.0);
        let friction = 0.6 * normal_force * (slides + chatter);
        WheelForces {
            normal_force,
            drawbar_pull: friction.x,
            side_force: friction.y,
            torque: friction.x * contact.wheel.shearing_radius(),
            ..WheelForces::default()
        }
    }
}

#[test]
fn a_run_by_a_model_that_chatters_ends_with_an_error() {
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let mut scenario = Scenario { model: Model::own(Chattering), ..scenario() };
        scenario.ground.soil.cohesion = COHERES;
        scenario.numerics.approach = approach;
        let mut run = Run::new(&scenario).expect("springs carry it");
        let error = run.run_to_end().expect_err("it takes too much");
        let RunError::Endless { time, place, ref reason } = error else { panic!("{error}") };
        assert_eq!((time, place), (0.0, Vec2::zeros()));
        assert!(reason.contains("100000 evaluations"), "{reason}");
        assert!(run.state().work().evaluations <= 100_000, "{:?}", run.state().work());
        assert_eq!((run.records().len(), run.outcome()), (1, None));
    }
}

/// A slope of one in six whose soil coheres beyond a line across it.
struct Beyond {
    /// x of the line [m].
    line: f64,
    cohesive: Soil,
}

impl Terrain for Beyond {
    fn patch(&self, at: Vec2, footprint: Footprint) -> Patch {
        footprint.fit(&footprint.points(at).map(|place| place.y / 6.0))
    }

    fn soil(&self, at: Vec2, _: Footprint) -> Option<Cow<'_, Soil>> {
        (at.x > self.line).then_some(Cow::Borrowed(&self.cohesive))
    }
}

/// Where and when the run ends, and the records until there.
#[test]
fn records_until_the_error_are_kept() {
    let base = scenario();
    let soil = base.ground.soil;
    // The front wheels are 0.19 m ahead.
    let beyond = Beyond { line: 0.25, cohesive: Soil { cohesion: COHERES, ..soil } };
    let ground = Ground::own(soil, beyond);
    let mut run = Run::new(&Scenario { model: Model::own(Chattering), ground, ..base })
        .expect("springs carry it");
    let error = run.run_to_end().expect_err("it takes too much");
    let message = error.to_string();
    let RunError::Endless { time, place, .. } = error else { panic!("{message}") };
    assert!((0.04..0.065).contains(&place.x), "{place}");
    assert!((0.5..2.0).contains(&time), "{time}");
    assert!(message.contains(&format!("beyond {time:.3} s, at x = {:.3} m", place.x)), "{message}");
    let last = run.records().last().expect("the start");
    assert!((last.time - time).abs() < 1e-9 && run.records().len() as f64 > 10.0 * time);
    assert_eq!(run.outcome(), None);
}

/// Uniform noise on cells of 1 m, as no ground is.
fn noise(case: u64, amplitude: f64) -> Scenario {
    let mut draw = Draw::of_case(case);
    let grid = ElevationGrid {
        columns: 20,
        rows: 20,
        spacing: Vec2::new(1.0, 1.0),
        south_west: Vec2::zeros(),
    };
    let heights: Vec<f64> = (0..400).map(|_| draw.between(-amplitude, amplitude)).collect();
    let base = Scenario { duration: 1.0, ..scenario() };
    let map = ElevationModel::new(grid, heights).expect("a map");
    let ground = Ground::map(base.ground.soil, map).starting_at(Vec2::new(9.5, 9.5));
    Scenario { ground, ..base }
}

fn check_noise(cases: impl IntoIterator<Item = (u64, f64)>, most_evaluations: u64) {
    for (case, amplitude) in cases {
        for approach in [Approach::QuasiSteady, Approach::Dynamic] {
            let mut scenario = noise(case, amplitude);
            scenario.numerics.approach = approach;
            let mut run = Run::new(&scenario).expect("it stands");
            let done = run.run_to_end();
            let evaluations = run.state().work().evaluations;
            assert!(done.is_ok(), "case {case}, {approach:?}: {done:?}");
            assert!(evaluations < most_evaluations, "case {case}, {approach:?}: {evaluations}");
        }
    }
}

#[test]
fn runs_over_noise_end_within_bounds_of_work() {
    check_noise([(1, 1.0), (2, 1.0)], 3_000);
}

#[test]
#[ignore = "minutes"]
fn all_runs_over_noise_end_within_bounds_of_work() {
    check_noise((1..20).map(|case| (case, 1.0)), 100_000);
}
