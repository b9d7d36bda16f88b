//! A model of one's own, wherever a model is asked for. Its heading has a closed form: see
//! `examples`.

use grouser::contact::validity::Flag;
use grouser::contact::{Contact, Model, WheelForces, WheelSoilModel};
use grouser::document::calibration::WheelProblem;
use grouser::document::{FitKey, Kind, Overrides, SoilFamily, Source, read_scenario, read_soil};
use grouser::mission::{Heading, Leg, Manoeuvre, Mission, MissionRun};
use grouser::simulation::{Approach, Outcome, Run, Scenario};
use grouser::soil::{Domain, Span};
use grouser::studies::calibration::Observer;
use grouser::studies::calibration::design::{Aim, Setting, Target};
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::heading::HeadingStudy;
use grouser::studies::heading_band::HeadingBand;
use grouser::studies::measurement::Quantity;
use grouser::studies::traverse_band::TraverseBand;
use grouser::studies::wheel_test::WheelTest;
use grouser::terrain::Ground;
use grouser::terrain::surface::{Cone, Surface};
use grouser::units::{Vec2, deg};

use crate::examples::own_model::{FRICTION, Friction, closed_form, scenario, traverse};

#[test]
fn a_wheel_test_settles_by_it() {
    let base = scenario().expect("the preset is read");
    let test = WheelTest {
        wheel: base.rover.mounts()[0].unit.wheel,
        soil: base.ground.soil,
        gravity: base.gravity,
        model: base.model,
        loads: vec![20.0],
        slip_angles: vec![0.0],
        slip_ratios: vec![-0.5, 0.0, 0.3, 1.0],
    };
    for row in test.run() {
        let settled = row.result.expect("springs carry it");
        assert!((settled.sinkage - 20.0 / FRICTION.stiffness).abs() < 1e-9);
        // While it skids, s is over the hub's speed, and the sliding over the rim's.
        let sliding = if row.slip_ratio < 0.0 { -0.5 / 0.5 } else { row.slip_ratio };
        let share: f64 = 1.0 - f64::exp(-f64::abs(sliding) / FRICTION.sliding);
        let pull = FRICTION.coefficient * 20.0 * share.copysign(sliding);
        assert!((settled.forces.drawbar_pull - pull).abs() < 1e-4, "{}", row.slip_ratio);
    }
}

/// A drive settles into the steady motion; both ways to compute it agree; on a hill as on the
/// plane.
#[test]
fn dynamic_and_quasi_steady_runs_follow_it() {
    let base = scenario().expect("the preset is read");
    let hill = Cone { tip: Vec2::new(0.0, 4.0), slope: deg(10.0), rounding: 0.5 };
    let on_hill =
        Scenario { ground: Ground::formula(base.ground.soil, Surface::Cone(hill)), ..base.clone() };
    for scenario in [base, on_hill] {
        let ends = [Approach::Dynamic, Approach::QuasiSteady].map(|approach| {
            let mut scenario = scenario.clone();
            scenario.numerics.approach = approach;
            scenario.start.yaw = closed_form(deg(10.0));
            let run = Run::new(&scenario).and_then(Run::to_end).expect("it can be computed");
            assert_eq!(run.outcome, Outcome::Completed);
            run.last().place()
        });
        assert!(ends[0].x > 0.8 && (ends[0] - ends[1]).norm() < 0.01, "{ends:?}");
    }
}

#[test]
fn a_mission_holds_the_contour_by_it() {
    let mut scenario = scenario().expect("the preset is read");
    scenario.ground = Ground::plane(scenario.ground.soil, deg(10.0));
    let leg = Leg { heading: Heading::Contour, ..Leg::new(Manoeuvre::drive(3.0)) };
    let mission = Mission { scenario, legs: vec![leg], stops: Vec::new(), sensors: None };
    let report = MissionRun::new(&mission).expect("it can begin").to_end().expect("it runs");
    let end = report.trajectory.last();
    assert_eq!(report.trajectory.outcome, Outcome::Completed);
    assert!(end.place().x > 2.95 && end.place().y.abs() < 0.03, "{}", end.place());
}

/// It has no document's name, so the scenario's value alone asks for it. Samples differ in their
/// soils, which it ignores, and in what any model may get wrong, which is left out here.
#[test]
fn bands_have_it_in_every_sample() {
    let mut loaded =
        read_scenario(&Source::default_scenario(), &Overrides::none()).expect("the preset is read");
    loaded.value.model = Model::own(FRICTION);
    let mut samples = BandInputs::of_scenario(&loaded).samples(1, 5).expect("soils are drawn");
    for sample in &mut samples {
        sample.soil.discrepancy = None;
    }
    assert!(samples.iter().all(|sample| sample.model == loaded.value.model));
    let slopes = [deg(5.0), deg(15.0)];
    let study = HeadingStudy::of(&loaded.value);
    let band = HeadingBand::of(&study, &samples, &slopes, &|| true).expect("it can be computed");
    for row in band.expect("not stopped").slopes {
        let yaw = row.yaw.expect("the contour is held");
        let off = [yaw.low, yaw.high].map(|it| it - closed_form(row.slope));
        assert!(off.iter().all(|it| it.abs() < 1e-7), "{off:?}");
    }
    let band = TraverseBand::of(&loaded.value, &samples, &[20.0], &|| true).expect("it runs");
    let run = traverse(&loaded.value, 10.0, loaded.value.start.yaw).expect("it runs");
    let y = band.expect("not stopped").times[0].y.expect("none ends early");
    assert_eq!((y.low, y.high), (run.last().state.position.y, run.last().state.position.y));
}

/// Friction that says for which wheels it was tried.
struct Tried;

impl WheelSoilModel for Tried {
    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        Friction { ..FRICTION }.forces(contact, sinkage)
    }

    fn domain(&self) -> Domain {
        Domain { radius: Span::new(0.5, 1.0), ..Domain::UNSTATED }
    }
}

#[test]
fn what_lies_outside_its_domain_is_flagged() {
    let base = scenario().expect("the preset is read");
    let flags = |model: Model| {
        let test = WheelTest {
            wheel: base.rover.mounts()[0].unit.wheel,
            soil: base.ground.soil,
            gravity: base.gravity,
            model,
            loads: vec![20.0],
            slip_angles: vec![0.0],
            slip_ratios: vec![0.2],
        };
        let [row] = &test.run()[..] else { panic!("one setting") };
        row.findings.iter().map(|finding| finding.flag).collect::<Vec<_>>()
    };
    assert!(!flags(Model::own(FRICTION)).contains(&Flag::RadiusOutside));
    assert!(flags(Model::own(Tried)).contains(&Flag::RadiusOutside));
}

/// Says nothing, and lets all go on.
struct Silent;

impl Observer for Silent {}

/// A soil that was fitted with it would name a model that no document can be read with.
#[test]
fn a_calibration_that_writes_a_soil_refuses_it_by_name() {
    let soil = Source::find(Kind::Soil, "cmu-direct90-smooth").expect("a preset");
    let soil = read_soil(&soil, &Overrides::none()).expect("it is read");
    let key = FitKey::parse("soil.pressure_sinkage.k_phi").expect("a key");
    let setting = Setting { load: 30.0, slip_angle: 0.0, slip_ratio: 0.2 };
    let problem = WheelProblem {
        family: &SoilFamily::new(&soil.document, &[key]).expect("keys of the soil"),
        measured: &crate::measured::trials("smooth"),
        file: "trials.csv",
        wheel: scenario().expect("the preset is read").rover.mounts()[0].unit.wheel,
        model: Model::own(FRICTION),
        gravity: 9.81,
        sampling: None,
        aim: Aim {
            target: Target { quantity: Quantity::Sinkage, setting },
            candidates: Vec::new(),
            count: 0,
        },
        cross_validate: false,
    };
    let error = problem.solve(&Silent).expect_err("it is refused").to_string();
    assert!(error.contains("documents have no name for a model of your own"), "{error}");
}
