//! Every run ends: a run that takes more than it may take ends with an error, and its records until then are kept.

use grouser::contact::{Contact, Model, WheelForces, WheelSoilModel};
use grouser::document::{Overrides, Source, read_scenario};
use grouser::simulation::{Approach, Run, RunError, Scenario};
use grouser::terrain::{ElevationGrid, ElevationModel, Footprint, Ground, Patch, Terrain};
use grouser::units::{Vec2, Vec3};

use super::million::Draw;

/// Wavelength of what changes too fast [of its argument].
const TOO_SHORT: f64 = 1e-9;

/// A drive of 2 s over level ground.
fn scenario(rover: &str) -> Scenario {
    let text = format!(
        "schema = \"scenario/1\"\nrover = \"{rover}\"\nsoil = \"toyoura\"\nslope_deg = 0.0\nduration_s = 2.0\n\
         [drive]\nlaw = \"constant\"\nrim_speed_m_s = 0.06\n"
    );
    let source = Source::text("a drive", text);
    read_scenario(&source, &Overrides::none()).expect("it is read").value
}

/// Ground like springs, whose friction changes up and down within a billionth of the slip.
struct Chattering;

impl WheelSoilModel for Chattering {
    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        let slip = &contact.slip;
        let slides = Vec2::new(slip.rim - slip.forward, -slip.lateral);
        let normal_force = 4e3 * sinkage;
        let chatter = Vec2::new(0.5 * (slides.x / TOO_SHORT).sin(), 0.0);
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
        let mut scenario = Scenario { model: Model::own(Chattering), ..scenario("hakuto") };
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

/// Level ground, smooth as far as a line across x, with slopes that change within a nanometre beyond.
struct SmoothAsFarAs(f64);

impl Terrain for SmoothAsFarAs {
    fn patch(&self, at: Vec2, _: Footprint) -> Patch {
        let beyond = (at.x - self.0).max(0.0);
        let slope = 0.1 * (beyond / TOO_SHORT).sin();
        Patch { height: 0.0, normal: Vec3::new(-slope, 0.0, 1.0).normalize() }
    }
}

/// Where and when the run ends, and the records until there.
#[test]
fn records_until_the_error_are_kept() {
    let base = scenario("hakuto-rockers");
    let ground = Ground::own(base.ground.soil, SmoothAsFarAs(0.25));
    let scenario = Scenario { model: Model::own(Springs), ground, ..base };
    let mut run = Run::new(&scenario).expect("springs carry it");
    let error = run.run_to_end().expect_err("it takes too much");
    let message = error.to_string();
    let RunError::Endless { time, place, .. } = error else { panic!("{message}") };
    // The front wheels are 0.19 m ahead.
    assert!((0.05..0.065).contains(&place.x), "{place}");
    assert!((0.5..2.0).contains(&time), "{time}");
    assert!(message.contains(&format!("beyond {time:.3} s, at x = {:.3} m", place.x)), "{message}");
    let last = run.records().last().expect("the start");
    assert!((last.time - time).abs() < 1e-9 && run.records().len() as f64 > 10.0 * time);
    assert_eq!(run.outcome(), None);
}

/// Ground like springs, with friction in proportion to the sliding.
struct Springs;

impl WheelSoilModel for Springs {
    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        let slip = &contact.slip;
        let normal_force = 4e3 * sinkage;
        let friction = normal_force * Vec2::new(slip.rim - slip.forward, -slip.lateral);
        WheelForces {
            normal_force,
            drawbar_pull: friction.x,
            side_force: friction.y,
            torque: friction.x * contact.wheel.shearing_radius(),
            ..WheelForces::default()
        }
    }
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
    let base = Scenario { duration: 1.0, ..scenario("hakuto") };
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
