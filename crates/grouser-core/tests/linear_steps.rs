//! Control steps, linearised: closed forms on level ground, and differences of runs' own steps.

use grouser_core::paper;
use grouser_core::simulation::{
    Approach, LinearStep, NoLinearStep, Numerics, Run, Scenario, State,
};
use grouser_core::terrain::Ground;
use grouser_core::units::deg;

/// Rims that turn the rover to the left [m/s].
const TURNING: [f64; 4] = [0.05, 0.05, 0.07, 0.07];
const SPAN: f64 = 0.5;

fn scenario(slope: f64, yaw: f64, approach: Approach) -> Scenario {
    let usual = paper::traverse().expect("a scenario");
    let mut scenario = Scenario {
        ground: Ground::plane(paper::toyoura(), deg(slope)),
        numerics: Numerics { approach, ..usual.numerics },
        ..usual
    };
    scenario.start.yaw = deg(yaw);
    scenario
}

/// A rover that has turned for two seconds.
fn driven(scenario: &Scenario) -> Run {
    let mut run = Run::new(scenario).expect("a run");
    run.step(&TURNING, 2.0).expect("a step");
    run
}

fn value(step: &LinearStep, of: usize, by: usize) -> f64 {
    step.slopes[by][of].value
}

fn check_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    let off = (found - expected).abs();
    assert!(off <= tolerance, "{what}: {found:e} for {expected:e}, off by {off:e}");
}

/// On level ground no place and no heading is like no other: a rover that starts elsewhere, or
/// turned, ends as much elsewhere, or turned. Tolerance: of differences over 1e-3 rad.
#[test]
fn on_level_ground_the_pose_is_carried_along() {
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let step = driven(&scenario(0.0, 0.0, approach)).linear_step(&TURNING, SPAN);
        let step = step.expect("slopes");
        let [dx, dy] = [0, 1].map(|axis| step.after[axis] - step.before[axis]);
        let expected = [[1.0, 0.0, -dy], [0.0, 1.0, dx], [0.0, 0.0, 1.0]];
        for (of, row) in expected.iter().enumerate() {
            for (by, expected) in row.iter().enumerate() {
                let what = format!("{approach:?}: {of} by {by}");
                check_near(value(&step, of, by), *expected, 2e-6, &what);
            }
        }
        assert!(dx > 0.02, "it drives");
    }
}

/// Forces depend on ratios of speeds alone: where nothing accelerates, all rims twice as fast lead
/// as far in half the time, so that the slopes by all commands add up to the velocity (Euler's
/// theorem of homogeneous functions); of the pose, on level ground, for a straight drive.
#[test]
fn steady_velocities_grow_with_all_commands_together() {
    let straight = [0.06; 4];
    let mut run = Run::new(&scenario(0.0, 0.0, Approach::QuasiSteady)).expect("a run");
    run.step(&straight, 1.0).expect("a step");
    let step = run.linear_step(&straight, SPAN).expect("slopes");
    let states = step.before.len();
    let along: f64 = (0..4).map(|wheel| straight[wheel] * value(&step, 0, states + wheel)).sum();
    check_near(along, step.after[0] - step.before[0], 1e-7, "way by all commands");
}

/// Differences of the steps that a run itself makes, over other lengths.
fn check_by_own_steps(scenario: &Scenario, within: f64) {
    let run = driven(scenario);
    let step = run.linear_step(&TURNING, SPAN).expect("slopes");
    let states = step.before.len();
    for wheel in 0..4 {
        let moved = |by: f64| {
            let mut rims = TURNING;
            rims[wheel] += by;
            let mut run = run.clone();
            run.step(&rims, SPAN).expect("a step");
            numbers(run.state())
        };
        for length in [5e-4, 2e-3] {
            let [low, high] = [-length, length].map(moved);
            for of in 0..3 {
                let own = (high[of] - low[of]) / (2.0 * length);
                let found = value(&step, of, states + wheel);
                check_near(found, own, within, &format!("{of} by wheel {wheel}, over {length}"));
            }
        }
    }
}

fn numbers(state: &State) -> [f64; 3] {
    let rover = state.rover();
    [rover.position.x, rover.position.y, rover.yaw]
}

/// Tolerance: a run's own error of 1e-6 m over the shorter length.
#[test]
fn slopes_by_commands_are_those_of_whole_steps() {
    check_by_own_steps(&scenario(10.0, 20.0, Approach::Dynamic), 2e-3);
    check_by_own_steps(&scenario(10.0, 20.0, Approach::QuasiSteady), 2e-3);
}

/// What slip settles within milliseconds is forgotten: half a second later, only the way that was
/// gone meanwhile is left of a velocity.
#[test]
fn velocities_are_forgotten_within_a_step() {
    let step = driven(&scenario(10.0, 20.0, Approach::Dynamic)).linear_step(&TURNING, SPAN);
    let step = step.expect("slopes");
    for by in 3..6 {
        for of in 3..6 {
            check_near(value(&step, of, by), 0.0, 1e-2, &format!("velocity {of} by {by}"));
        }
    }
}

#[test]
fn a_run_that_ends_has_no_slopes() {
    let steep = scenario(35.0, 0.0, Approach::Dynamic);
    let run = Run::new(&steep).expect("a run");
    // It slides before the step is over.
    let found = run.linear_step(&TURNING, 60.0);
    assert!(matches!(found, Err(NoLinearStep::Ends { .. })), "{found:?}");
    let mut ended = run;
    ended.run_to_end().expect("an end");
    let found = ended.linear_step(&TURNING, SPAN);
    assert!(matches!(found, Err(NoLinearStep::Ends { .. })), "{found:?}");
}

/// Wheels at rest hold, to whatever side they begin to turn: their slopes are flagged.
#[test]
fn wheels_that_begin_to_turn_are_flagged() {
    let mut run = Run::new(&scenario(5.0, 0.0, Approach::Dynamic)).expect("a run");
    run.step(&[0.0; 4], 2.0).expect("a step");
    let step = run.linear_step(&[0.0; 4], SPAN).expect("slopes");
    let states = step.before.len();
    let flagged =
        (0..4).any(|wheel| step.slopes[states + wheel].iter().any(|it| it.is_one_sided()));
    assert!(flagged, "{:?}", step.slopes);
}
