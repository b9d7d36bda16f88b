//! Speeds of wheels that change at once, and against each other: quasi-steady runs come to the
//! motion that dynamic ones settle into.

use grouser_core::paper;
use grouser_core::simulation::{Approach, Run};
use grouser_core::vehicle::{LoadSharing, OwnMoments};

/// Evenly distributed numbers in [−1, 1), the same at every call.
struct Draws(u64);

impl Draws {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn run(approach: Approach) -> Run {
    let mut scenario = paper::traverse().expect("a scenario");
    (scenario.sharing, scenario.own_moments) = (LoadSharing::Complete, OwnMoments::Included);
    scenario.numerics.approach = approach;
    Run::new(&scenario).expect("it starts")
}

/// Runs under speeds that are kept for half a second each; returns how far the velocities at the
/// ends of these are apart at the most [m/s], and the evaluations of each run.
fn apart(rim_speed: impl Fn(&mut Draws, usize) -> f64) -> (f64, [u64; 2]) {
    let mut runs = [Approach::Dynamic, Approach::QuasiSteady].map(run);
    let mut draws = Draws(88_172_645_463_325_252);
    let mut most: f64 = 0.0;
    for hold in 0..40 {
        let rim_speeds: Vec<f64> = (0..4).map(|_| rim_speed(&mut draws, hold)).collect();
        let velocities = runs.each_mut().map(|run| {
            run.step(&rim_speeds, 0.5).expect("it goes on");
            run.state().rover().velocity
        });
        most = most.max((velocities[0] - velocities[1]).norm());
    }
    (most, runs.map(|run| run.state().work().evaluations))
}

#[test]
fn random_speeds_lead_to_the_same_motion() {
    let (apart, [_, evaluations]) = apart(|draws, _| 0.06 * (1.0 + 0.3 * draws.next()));
    assert!(apart < 2e-5, "{apart:e} m/s");
    assert!(evaluations < 40 * 25, "{evaluations}");
}

/// Wheels that turn against each other, and rests: a rover may be held in more than one way, and how
/// it comes to rest decides.
#[test]
fn reversals_and_rests_lead_to_the_same_motion() {
    let (apart, [_, evaluations]) =
        apart(|draws, hold| if hold % 5 == 4 { 0.0 } else { 0.06 * draws.next() });
    assert!(apart < 1e-4, "{apart:e} m/s");
    assert!(evaluations < 40 * 60, "{evaluations}");
}
