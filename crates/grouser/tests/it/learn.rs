//! What is learnt from drives whose soil is hidden from the learner.

mod advice;
pub(crate) mod twin;

use grouser::document::LoadedScenario;
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::studies::learn::{Lesson, TelemetryRecord, Warning, WarningKind};
use grouser::studies::simulated_telemetry::SensorModels;
use twin::{Answer, Drive, Leg, RIM_SPEED, answer, learner, scenario, truths};

/// A level start, a slope along the contour and across it, and a steeper one.
const LEGS: [Leg; 4] = [(0.0, 0.0, 0.6), (5.0, 3.0, 1.0), (6.0, 40.0, 0.6), (8.0, 5.0, 1.0)];
/// The slope that comes next [°].
const NEXT: f64 = 12.0;

const PRIOR: &str = "scenario.soil=toyoura-uncertain";

/// Instruments with noise, rounding, gaps, and one reading in twenty wrong by far.
fn usual() -> SensorModels {
    SensorModels { outliers: 0.05, ..SensorModels::USUAL }
}

/// How many of the answers hold the truth within their bands, of slip and of yaw.
fn held(answers: &[Answer]) -> [usize; 2] {
    [0, 1].map(|place| {
        let holds = |it: &&Answer| {
            let band = it.after[place];
            (band.low..=band.high).contains(&it.truth[place])
        };
        answers.iter().filter(holds).count()
    })
}

/// Mean error of the median yaw, before the drives and after them [rad].
fn yaw_errors(answers: &[Answer]) -> [f64; 2] {
    let mean = |of: &dyn Fn(&Answer) -> f64| {
        answers.iter().map(|it| (of(it) - it.truth[1]).abs()).sum::<f64>() / answers.len() as f64
    };
    [mean(&|it| it.before[1].median), mean(&|it| it.after[1].median)]
}

fn answers(prior: &LoadedScenario, truths: &[Sample], samples: u32) -> Vec<Answer> {
    let each = truths.iter().zip(0..);
    each.filter_map(|(truth, seed)| answer(prior, truth, (&LEGS, NEXT), usual(), (seed, samples)))
        .collect()
}

#[test]
fn without_telemetry_predictions_are_those_of_the_soil() {
    let prior = scenario(&[PRIOR]);
    let before = BandInputs::of_scenario(&prior).samples(7, 50).unwrap();
    let found = learner(&prior).samples(7, 50).unwrap();
    for (one, other) in found.iter().zip(&before) {
        assert_eq!(one.sample.theory, other.theory);
        let (one, other) = (&one.sample.soil, &other.soil);
        assert!((one.friction_angle / other.friction_angle - 1.0).abs() < 1e-9);
        let pulls = |it: &grouser::soil::Soil| it.discrepancy.unwrap().drawbar_pull;
        let pairs = pulls(one).into_iter().zip(pulls(other));
        assert!(pairs.into_iter().all(|(one, other)| (one - other).abs() < 1e-9));
    }
}

/// Six hidden soils of the prior: slip and yaw of the next slope lie within the bands, but for one of either at most, and
/// the error of the heading is less than half of what it was.
#[test]
fn bands_hold_one_slope_ahead() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let answers = answers(&prior, &truths(&prior, 77, 6), 60);
    assert_eq!(answers.len(), 6);
    assert!(held(&answers).into_iter().all(|held| held >= 5), "{answers:?}");
    let [before, after] = yaw_errors(&answers);
    assert!(after < 0.5 * before, "{before} {after}");
}

/// The same where the hidden soils follow another theory than the learner's.
#[test]
fn bands_hold_under_another_theory() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let other = scenario(&[PRIOR, "scenario.model=small-wheel"]);
    let answers = answers(&prior, &truths(&other, 78, 4), 60);
    assert_eq!(answers.len(), 4);
    assert!(held(&answers).into_iter().all(|held| held >= 3), "{answers:?}");
}

fn lessons(prior: &LoadedScenario, records: Vec<TelemetryRecord>) -> Vec<Lesson> {
    let mut learner = learner(prior);
    records.into_iter().filter_map(|record| learner.update(record)).collect()
}

fn warnings(prior: &LoadedScenario, drive: &Drive) -> Vec<Warning> {
    lessons(prior, drive.seen(usual(), 3)).into_iter().flat_map(|it| it.warnings).collect()
}

/// A learner that is copied half-way goes on as the one it was copied from: what it knows is all in it.
#[test]
fn a_copy_goes_on_where_it_was() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let mut drive = Drive::new(&prior, &truths(&prior, 77, 1)[0]);
    drive.leg(LEGS[1]).unwrap();
    let records = drive.seen(usual(), 5);
    let (first, second) = records.split_at(records.len() / 2 + 3);
    let mut one = learner(&prior);
    for record in first {
        one.update(record.clone());
    }
    let mut other = one.clone();
    for record in second {
        one.update(record.clone());
        other.update(record.clone());
    }
    assert_eq!(one.samples(1, 5).unwrap(), other.samples(1, 5).unwrap());
    assert_eq!(one.learnt(), other.learnt());
}

/// Up a slope that steepens until the rover stands: called 5 s and 0.3 m ahead, and more.
#[test]
fn entrapment_is_called_ahead() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    for truth in &truths(&prior, 5, 3) {
        let mut drive = Drive::new(&prior, truth);
        let mut slope = 3.0;
        // A tenth of the rims' speed is as good as none.
        let is_stuck = |drive: &Drive| {
            let last = drive.records.last().and_then(|it| it.displacement[0]);
            last.is_some_and(|way| way < 0.1 * RIM_SPEED * 0.1)
        };
        while !is_stuck(&drive) {
            drive.leg((slope, 90.0, 0.06)).expect("steady motion until it stands");
            slope += 0.3;
        }
        let stuck = drive.records.last().unwrap().time;
        let all = warnings(&prior, &drive);
        let called = all.iter().find(|it| it.kind == WarningKind::Entrapment).expect("called");
        let left = drive.records.iter().filter(|it| it.time > called.time);
        let way: f64 = left.filter_map(|it| it.displacement[0]).sum();
        assert!(stuck - called.time > 5.0 && way > 0.3, "{way} m, {} s", stuck - called.time);
    }
}

/// From firm sand into loose sand in which the slip is larger by far: flagged within half a metre of the wheels' way, and
/// nothing before.
#[test]
fn another_soil_is_flagged() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let mut drive = Drive::new(&prior, &truths(&prior, 77, 1)[0]);
    drive.leg((6.0, 40.0, 2.0)).unwrap();
    let changed = drive.records.last().unwrap().time;
    let firm = drive.records.last().unwrap().displacement[0].unwrap();
    let mut loose = truths(&prior, 77, 1)[0];
    loose.soil.friction_angle *= 0.7;
    drive.change(&loose);
    drive.leg((6.0, 40.0, 1.0)).unwrap();
    let slip = 1.0 - drive.records.last().unwrap().displacement[0].unwrap() / firm;
    assert!(slip > 0.1, "the soils differ: {slip}");
    let all = warnings(&prior, &drive);
    let flagged = all.iter().find(|it| it.kind == WarningKind::SoilChange).expect("flagged");
    let way = (flagged.time - changed) * RIM_SPEED;
    assert!((0.0..0.5).contains(&way), "{way}");
}

/// On one soil, level and across slopes, nothing is warned of.
#[test]
fn nothing_is_warned_of_on_one_soil() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    for truth in &truths(&prior, 79, 3) {
        let mut drive = Drive::new(&prior, truth);
        for leg in LEGS {
            drive.leg(leg).unwrap();
        }
        assert_eq!(warnings(&prior, &drive), []);
    }
}

/// A wheel without torque, and a compass that is off: each is named.
#[test]
fn idle_wheels_and_lying_sensors_are_named() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let mut drive = Drive::new(&prior, &truths(&prior, 77, 1)[0]);
    drive.leg((8.0, 5.0, 1.5)).unwrap();
    for record in &mut drive.records {
        record.wheels[1].torque = Some(0.0);
        record.yaw = record.yaw.map(|yaw| yaw + 0.5);
    }
    let kinds: Vec<_> = warnings(&prior, &drive).iter().map(|it| it.kind).collect();
    for kind in [WarningKind::WheelNotPulling, WarningKind::LyingSensor] {
        assert_eq!(kinds.iter().filter(|it| **it == kind).count(), 1, "{kinds:?}");
    }
}
