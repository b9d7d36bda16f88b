//! Drives without a fault, of every rover: on level ground, on one slope and over several.

use grouser::document::{Kind, LoadedScenario, presets};
use grouser::studies::learn::{self, TelemetryRecord};
use grouser::studies::simulated_telemetry::SensorModels;

use super::PRIOR;
use super::coverage::LEGS;
use super::drive::{Drive, Leg, learner, scenario};

/// Where a drive goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Course {
    Level,
    OneSlope,
    Slopes,
}

impl Course {
    fn legs(self) -> Vec<Leg> {
        match self {
            Self::Level => vec![(0.0, 0.0, 2.0)],
            Self::OneSlope => vec![(8.0, 5.0, 2.0)],
            Self::Slopes => LEGS.to_vec(),
        }
    }
}

fn number_of_rovers() -> u64 {
    presets(Kind::Rover).count() as u64
}

/// The rover of a drive on a soil of which little is known.
pub(super) fn prior(number: u64) -> LoadedScenario {
    let mut rovers = (0..number_of_rovers()).zip(presets(Kind::Rover));
    let rover = rovers.find(|(place, _)| *place == number % number_of_rovers());
    let rover = format!("scenario.rover={}", rover.expect("a rover").1.name);
    scenario(&[PRIOR, "scenario.model=ishigami", &rover])
}

/// A drive on a soil of the prior, over ground that is uneven; nothing where the rover cannot move.
pub(super) fn drive(prior: &LoadedScenario, course: Course, number: u64) -> Option<Drive> {
    /// Over so much time a rover may have turned unseen [s].
    const PAUSE: f64 = 60.0;
    let mut truth = super::truths(prior, 1000 + number, 1).remove(0);
    // A discrepancy would pull a rover that no wheel drives, and no real ground does.
    truth.soil.discrepancy = None;
    let truth = &truth;
    let begin = || Drive::uneven(prior, truth, number);
    let (mut drive, mut begun) = (begin(), 0.0);
    for leg in course.legs() {
        let mut part = begin();
        part.leg(leg)?;
        let end = begun + part.time();
        let later =
            part.records.into_iter().map(|it| TelemetryRecord { time: begun + it.time, ..it });
        drive.records.extend(later);
        begun = end + PAUSE;
    }
    Some(drive)
}

/// What usual instruments make of it.
pub(super) fn seen(drive: &Drive, number: u64) -> Vec<TelemetryRecord> {
    drive.seen(SensorModels::USUAL, number)
}

/// What is wrong with what was learnt from a drive: warnings, gross faults, contradictions, or that
/// it taught nothing.
fn faults(prior: &LoadedScenario, drive: &Drive, number: u64) -> Vec<String> {
    let mut learning = learn::Drive::new(learner(prior));
    for record in seen(drive, number) {
        learning.update(record);
    }
    let learning = learning.finished();
    let learner = learning.learner();
    let warnings = learning.warnings().iter().map(|it| format!("{:?}", it.evidence));
    let gross = learner.gross_faults().iter().map(|it| format!("{it:?}"));
    let contradictions = learner.contradictions().into_iter().map(|it| format!("{it:?}"));
    let refused = (learner.learnt().stretches == 0).then(|| "refused".to_owned());
    warnings.chain(gross).chain(contradictions).chain(refused).collect()
}

/// How many of so many drives warn, and what of.
fn warned(drives: u64) -> (u64, Vec<String>) {
    let (mut taken, mut found) = (0, Vec::new());
    for number in 0..drives {
        let prior = prior(number);
        let course = match number / number_of_rovers() % 3 {
            0 => Course::OneSlope,
            1 => Course::Level,
            _ => Course::Slopes,
        };
        // On a soil that is too weak for the rover there is no drive.
        let Some(drive) = drive(&prior, course, number) else { continue };
        taken += 1;
        let faults = faults(&prior, &drive, number);
        let rover = prior.document.text("rover.name").unwrap_or_default();
        let line = || format!("drive {number}, {rover}, {course:?}: {}", faults.join("; "));
        found.extend((!faults.is_empty()).then(line));
    }
    (taken, found)
}

/// On each kind of ground, one drive of some rovers.
#[test]
fn drives_without_a_fault_are_not_warned_of() {
    let (taken, warned) = warned(8);
    assert!(taken >= 6 && warned.is_empty(), "{taken} drives: {warned:#?}");
}

/// Of two hundred at most two.
#[test]
#[ignore = "minutes"]
fn of_two_hundred_drives_without_a_fault_at_most_two_are_warned_of() {
    let (taken, warned) = warned(200);
    println!("{taken} drives, of which {} are warned of: {warned:#?}", warned.len());
    assert!(taken >= 180, "{taken} drives");
    assert!(warned.len() <= 2, "{warned:#?}");
    assert!(warned.iter().all(|it| !it.ends_with("refused")), "{warned:#?}");
}
