//! Simulated wheel tests: a known truth with known noise.

use grouser::contact::Model;
use grouser::studies::measurement::{PerQuantity, Quantity};
use grouser::studies::simulated_test::{SimulatedTest, SimulatedTrial};
use grouser::studies::wheel_test::WheelTest;
use grouser::units::EARTH_GRAVITY;

use crate::given::{hakuto_wheel, toyoura};

const NOISE: PerQuantity<f64> =
    PerQuantity { drawbar_pull: 0.3, side_force: 0.2, sinkage: 5e-4, torque: 0.02 };

fn test(slip_ratios: &[f64], trials: usize, seed: u64) -> SimulatedTest {
    let plan = WheelTest {
        wheel: hakuto_wheel(),
        soil: toyoura(),
        gravity: EARTH_GRAVITY,
        model: Model::Ishigami,
        loads: vec![20.0],
        slip_angles: vec![0.1],
        slip_ratios: slip_ratios.to_vec(),
    };
    SimulatedTest { plan, trials, noise: NOISE, seed }
}

fn reading(trial: &SimulatedTrial, quantity: Quantity) -> f64 {
    trial.readings.expect("it settles")[quantity]
}

/// Over 4000 trials a mean is known to 1.6 % of the noise and a deviation to 1.1 %; five times as
/// much is allowed, and that two quantities do not go together: their correlation is known to 1.6
/// %.
#[test]
fn readings_scatter_normally_about_the_truth() {
    let test = test(&[0.3], 4000, 1);
    let truth = test.plan.run()[0].result.expect("it settles");
    let trials = test.run();
    let scores = |quantity: Quantity| -> Vec<f64> {
        let score = |trial| (reading(trial, quantity) - quantity.of(&truth)) / NOISE[quantity];
        trials.iter().map(score).collect()
    };
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let product = |one: &[f64], other: &[f64]| {
        mean(&one.iter().zip(other).map(|(one, other)| one * other).collect::<Vec<_>>())
    };
    for quantity in Quantity::ALL {
        let scores_of = scores(quantity);
        assert!(mean(&scores_of).abs() < 0.08, "{quantity:?}: {}", mean(&scores_of));
        let deviation = product(&scores_of, &scores_of).sqrt();
        assert!((deviation - 1.0).abs() < 0.056, "{quantity:?}: {deviation}");
        let beyond_two = scores_of.iter().filter(|score| score.abs() > 1.96).count();
        // 5 % of 4000, known to ±14.
        assert!((130..270).contains(&beyond_two), "{quantity:?}: {beyond_two}");
        for other in Quantity::ALL.into_iter().filter(|other| *other != quantity) {
            assert!(product(&scores_of, &scores(other)).abs() < 0.08, "{quantity:?} {other:?}");
        }
    }
}

#[test]
fn the_same_seed_makes_the_same_test_and_another_another() {
    assert_eq!(test(&[0.0, 0.4], 3, 9).run(), test(&[0.0, 0.4], 3, 9).run());
    let [one, other] = [9, 10].map(|seed| test(&[0.4], 1, seed).run()[0]);
    assert_ne!(one.readings, other.readings);
}

#[test]
fn rows_stay_when_others_are_added_after_them() {
    let [short, long] = [&[0.1, 0.2][..], &[0.1, 0.2, 0.3]].map(|slips| test(slips, 3, 4).run());
    assert_eq!((short.len(), long.len()), (6, 9));
    assert_eq!(short[..], long[..6]);
}

#[test]
fn trials_of_a_setting_stand_together_and_are_counted_from_one() {
    let trials = test(&[0.1, 0.2], 2, 1).run();
    let places: Vec<_> = trials.iter().map(|trial| (trial.slip_ratio, trial.trial)).collect();
    assert_eq!(places, [(0.1, 1), (0.1, 2), (0.2, 1), (0.2, 2)]);
}

#[test]
fn a_wheel_that_does_not_settle_reads_nothing() {
    let mut heavy = test(&[0.1], 2, 1);
    heavy.plan.loads = vec![1e5];
    assert!(heavy.run().iter().all(|trial| trial.readings.is_err()));
}
