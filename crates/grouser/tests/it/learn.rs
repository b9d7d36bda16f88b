//! What is learnt from drives whose soil is hidden from the learner.

mod advice;
#[allow(dead_code, reason = "the example uses all of it")]
#[path = "../../examples/learning/change.rs"]
mod change;
#[allow(dead_code, reason = "the example uses all of it")]
#[path = "../../examples/learning/coverage.rs"]
mod coverage;
#[allow(dead_code, reason = "the example uses all of it")]
#[path = "../../examples/learning/drive.rs"]
pub(crate) mod drive;
mod drives;
#[allow(dead_code, reason = "the example uses all of it")]
#[path = "../../examples/learning/entrapment.rs"]
mod entrapment;
#[allow(dead_code, reason = "the example uses all of it")]
#[path = "../../examples/learning/drives.rs"]
mod faultless;
#[allow(dead_code, reason = "the example uses all of it")]
#[path = "../../examples/learning/heading.rs"]
mod heading;

use grouser::document::LoadedScenario;
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::studies::learn::{Evidence, OneSided, Suspect, TelemetryRecord, WarningKind};
use grouser::studies::simulated_telemetry::SensorModels;

use grouser_io::measurements::telemetry::{TelemetryReader, csv_header, csv_line};

use change::{Change, flagged, warnings};
use coverage::{LEGS, Trial, held, yaw_errors};
use drive::{Drive, INSTRUMENTS, learner, scenario};
use entrapment::{Case, Way, cases};

const PRIOR: &str = "scenario.soil=toyoura-uncertain";

/// Few repeats of what the example `learning` does: the guide has its numbers for many.
fn trial<'a>(prior: &'a LoadedScenario, hidden: &'a LoadedScenario, seed: u64) -> Trial<'a> {
    Trial { prior, hidden, uneven: true, samples: 40, seed }
}

/// The hidden soils of some repeats.
pub(crate) fn truths(prior: &LoadedScenario, seed: u64, count: u32) -> Vec<Sample> {
    BandInputs::of_scenario(prior).samples(seed, count).unwrap()
}

#[test]
fn without_telemetry_predictions_are_those_of_the_soil() {
    let prior = scenario(&[PRIOR]);
    let before = BandInputs::of_scenario(&prior).samples(7, 50).unwrap();
    let found = learner(&prior).samples(7, 50).unwrap();
    for (one, other) in found.iter().zip(&before) {
        assert_eq!(one.sample.model, other.model);
        let (one, other) = (&one.sample.soil, &other.soil);
        assert!((one.friction_angle / other.friction_angle - 1.0).abs() < 1e-9);
        let pulls = |it: &grouser::soil::Soil| it.discrepancy.unwrap().drawbar_pull;
        let pairs = pulls(one).into_iter().zip(pulls(other));
        assert!(pairs.into_iter().all(|(one, other)| (one - other).abs() < 1e-9));
    }
}

/// The same on even ground.
fn on_a_plane(trial: Trial<'_>) -> Trial<'_> {
    Trial { uneven: false, ..trial }
}

/// Six hidden soils of the prior, on even ground: slip and yaw of the next slope lie within the
/// bands, but for one of either at most, and the error of the heading is less than two thirds of
/// what it was: over many soils it is a third.
#[test]
fn bands_hold_one_slope_ahead() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let answers = on_a_plane(trial(&prior, &prior, 77)).answers(6);
    assert_eq!(answers.len(), 6);
    assert!(held(&answers).into_iter().all(|held| 6.0 * held > 4.5), "{answers:?}");
    let [before, after] = yaw_errors(&answers);
    assert!(after < before / 1.5, "{before} {after}");
}

/// The same where the hidden soils follow another theory than the learner's.
#[test]
fn bands_hold_under_another_theory() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let other = scenario(&[PRIOR, "scenario.model=small-wheel"]);
    let answers = on_a_plane(trial(&prior, &other, 78)).answers(4);
    assert_eq!(answers.len(), 4);
    assert!(held(&answers).into_iter().all(|held| 4.0 * held > 2.5), "{answers:?}");
}

/// Shear moduli that are off by half: after two metres of the wheels' way the heading is off by
/// less than half as much.
#[test]
fn the_heading_is_learnt_within_two_metres() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let errors = heading::errors(&trial(&prior, &prior, 80), 2);
    let sums = errors.iter().fold([0.0; 2], |sums, it| [sums[0] + it[0], sums[1] + it[1]]);
    assert!(errors.len() == 2 && sums[1] < 0.5 * sums[0], "{errors:?}");
}

/// A learner that is copied half-way goes on as the one it was copied from: what it knows is all in
/// it.
#[test]
fn a_copy_goes_on_where_it_was() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let mut drive = Drive::new(&prior, &truths(&prior, 77, 1)[0]);
    drive.leg(LEGS[1]).unwrap();
    let records = drive.seen(INSTRUMENTS, 5);
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

/// Telemetry whose columns stand in the opposite order teaches the same.
#[test]
fn the_order_of_columns_does_not_matter() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let mut drive = Drive::new(&prior, &truths(&prior, 77, 1)[0]);
    drive.leg((8.0, 5.0, 0.4)).unwrap();
    let rover = &drive.study().rover;
    let lines = drive.seen(INSTRUMENTS, 5).iter().map(csv_line).collect::<String>();
    let table = csv_header(rover) + &lines;
    let turned = |line: &str| line.split(',').rev().collect::<Vec<_>>().join(",") + "\n";
    let learnt = |table: &str| {
        let mut reader = TelemetryReader::new("drive", table.as_bytes(), rover).unwrap();
        let mut learner = learner(&prior);
        while let Some(record) = reader.next_record().unwrap() {
            learner.update(record);
        }
        assert!(learner.learnt().stretches > 2);
        learner.samples(1, 5).unwrap()
    };
    assert_eq!(learnt(&table), learnt(&table.lines().map(turned).collect::<String>()));
}

/// Wheel speeds that are read once a second, beside ten readings a second of the rest, make
/// stretches of the same way.
#[test]
fn wheel_speeds_that_are_read_seldom_hold_until_the_next() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let mut drive = Drive::new(&prior, &truths(&prior, 77, 1)[0]);
    drive.leg((8.0, 5.0, 1.2)).unwrap();
    let learnt = |every: usize| {
        let mut learner = learner(&prior);
        for (place, mut record) in drive.seen(INSTRUMENTS, 5).into_iter().enumerate() {
            if place % every != 0 {
                record.wheels.iter_mut().for_each(|it| it.speed = None);
            }
            learner.update(record);
        }
        learner.learnt().clone()
    };
    let (all, seldom) = (learnt(1), learnt(10));
    assert!((seldom.way / all.way - 1.0).abs() < 0.1, "{all:?} {seldom:?}");
    assert!(seldom.stretches + 2 > all.stretches, "{all:?} {seldom:?}");
}

/// Up a slope that steepens, and on soil that is weaker ahead, until the rover stands: called 5 s
/// and 0.3 m ahead, and more.
#[test]
fn entrapment_is_called_ahead() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    for way in [Way::Steepening(5.0), Way::WeakerAhead(0.3)] {
        let cases = cases(&trial(&prior, &prior, 5), way, 2);
        assert_eq!(cases.len(), 2);
        let is_called =
            |it: &Case| it.lead.is_some_and(|it| it.time > 5.0 && it.way > 0.3) && it.left > 0.3;
        assert!(cases.iter().all(is_called), "{way:?}: {cases:?}");
    }
}

/// Onto sand in which wheels slip more: flagged within half a metre of the wheels' way, and nothing
/// before.
#[test]
fn another_soil_is_flagged() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let all = flagged(&trial(&prior, &prior, 77), Change::ShearAlong(3.0), 6);
    let matter: Vec<_> = all.iter().filter(|it| it.matters).collect();
    assert!(matter.len() >= 2, "{all:?}");
    let is_in_time = |it: &change::Flagged| !it.early && it.way.is_some_and(|way| way <= 0.5);
    assert!(matter.iter().all(|it| is_in_time(it)), "{all:?}");
}

/// On one soil, level and across slopes, nothing is warned of: neither on even ground nor where it
/// leans and is stronger here than there.
#[test]
fn nothing_is_warned_of_on_one_soil() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let uneven = trial(&prior, &prior, 79);
    for trial in [on_a_plane(uneven), uneven] {
        for (truth, seed) in truths(&prior, 79, 3).iter().zip(0..) {
            let mut drive = trial.drive(truth, seed);
            for leg in LEGS {
                drive.leg(leg).unwrap();
            }
            assert_eq!(warnings(&trial, &drive, seed), []);
        }
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
    let kinds: Vec<_> =
        warnings(&trial(&prior, &prior, 77), &drive, 3).iter().map(|it| it.kind).collect();
    for kind in [WarningKind::WheelNotPulling, WarningKind::LyingSensor] {
        assert_eq!(kinds.iter().filter(|it| **it == kind).count(), 1, "{kinds:?}");
    }
}

/// Radians that were taken for degrees, and a pitch with the other sign, are seen by the pull over
/// several slopes; a healthy drive has no gross fault.
#[test]
fn angles_are_checked_against_the_pull() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    for (truth, seed) in truths(&prior, 81, 2).iter().zip(0..) {
        let mut drive = Drive::uneven(&prior, truth, seed);
        for leg in [(2.0, 60.0, 0.8), (9.0, 60.0, 0.8), (4.0, 75.0, 0.8), (11.0, 80.0, 0.8)] {
            drive.leg(leg).unwrap();
        }
        let found = |[of_roll, of_pitch]: [f64; 2]| {
            let mut learner = learner(&prior);
            for mut record in drive.seen(INSTRUMENTS, seed) {
                record.roll = record.roll.map(|it| of_roll * it);
                record.pitch = record.pitch.map(|it| of_pitch * it);
                learner.update(record);
            }
            learner.gross_faults().to_vec()
        };
        assert_eq!(found([1.0; 2]), []);
        let radians = found([1_f64.to_radians(); 2]);
        let [fault] = radians[..] else { panic!("{radians:?}") };
        assert_eq!(fault.suspect, Suspect::Attitude);
        let (factor, _) = fault.unit().expect("a unit");
        assert!((factor - 1_f64.to_radians()).abs() < 1e-12, "{fault:?}");
        let turned = found([1.0, -1.0]);
        assert!(
            turned.iter().any(|it| it.suspect == Suspect::Attitude && it.factor < 0.0),
            "{turned:?}"
        );
    }
}

/// What is said of an uneven drive up a slope whose records are changed.
fn said_of(prior: &LoadedScenario, change: impl Fn(usize, &mut TelemetryRecord)) -> Vec<Evidence> {
    let mut drive = Drive::uneven(prior, &truths(prior, 77, 1)[0], 4);
    for leg in [(6.0, 8.0, 0.8), (9.0, 5.0, 1.6)] {
        drive.leg(leg).expect("the rover moves");
    }
    let mut learner = learner(prior);
    let mut said = Vec::new();
    for (place, mut record) in drive.seen(SensorModels::USUAL, 4).into_iter().enumerate() {
        change(place, &mut record);
        let lesson = learner.update(record);
        said.extend(lesson.into_iter().flat_map(|it| it.warnings).map(|it| it.evidence));
    }
    said.extend(learner.gross_faults().iter().map(|it| Evidence::Gross(*it)));
    said
}

/// Wheels by each other's names, and ways to the side by another sign, are on one side of whatever
/// soil is learnt.
#[test]
fn what_no_soil_explains_is_named() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let of = |change: fn(usize, &mut TelemetryRecord)| -> Vec<OneSided> {
        let said = said_of(&prior, change).into_iter();
        said.filter_map(|it| match it {
            Evidence::OneSided { what, .. } => Some(what),
            _ => None,
        })
        .collect()
    };
    assert_eq!(of(|_, _| ()), []);
    // The wheels are front left, rear left, rear right, front right.
    let front = of(|_, it| {
        it.wheels.swap(0, 1);
        it.wheels.swap(2, 3);
    });
    assert_eq!(front, [OneSided::FrontTorques]);
    assert_eq!(of(|_, it| it.wheels.reverse()), [OneSided::LeftTorques]);
}

/// Ways that are lost, with their rows or as 0, and an attitude that nobody measures.
#[test]
fn lost_ways_and_still_attitudes_are_named() {
    let prior = scenario(&[PRIOR, "scenario.model=ishigami"]);
    let of = |change: fn(usize, &mut TelemetryRecord)| -> Vec<Suspect> {
        let said = said_of(&prior, change).into_iter();
        said.filter_map(|it| match it {
            Evidence::Gross(fault) => Some(fault.suspect),
            _ => None,
        })
        .collect()
    };
    let is_only =
        |found: &[Suspect], suspect| !found.is_empty() && found.iter().all(|it| *it == suspect);
    assert_eq!(of(|_, _| ()), []);
    let zeros = of(|place, it| {
        if place * 7919 % 101 < 10 {
            it.displacement = [Some(0.0); 2];
        }
    });
    assert!(is_only(&zeros, Suspect::LostWays), "{zeros:?}");
    let level = of(|_, it| (it.roll, it.pitch) = (Some(0.0), Some(0.0)));
    assert!(is_only(&level, Suspect::StillAttitude), "{level:?}");
    // Cameras of one picture a second have ways of 0 in between that are no loss.
    let seldom = of(|place, it| {
        let sum = it.displacement.map(|it| it.map(|it| 10.0 * it));
        it.displacement = if place % 10 == 9 { sum } else { [Some(0.0); 2] };
    });
    assert_eq!(seldom, []);
}
