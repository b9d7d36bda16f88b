//! What is said of drives without a fault: nothing.

use grouser::document::LoadedScenario;
use grouser::studies::learn;

use super::drive::{Drive, learner};
use super::faultless::{Course, drive, prior, seen};

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
        let course = Course::of(number);
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
