//! Whole runs: that they are computed right, keep their books, and end as a rover would.

use std::f64::consts::PI;

use grouser::contact::Model;
use grouser::document::{self, Kind, Overrides, Source};
use grouser::simulation::equations::Equations;
use grouser::simulation::steady_state::LONGEST_SETTLING;
use grouser::simulation::{
    Approach, Integrator, Method, Motion, Numerics, Outcome, Record, Run, Scenario, Start,
    StuckBecause, Trajectory, WheelRecord,
};
use grouser::soil::{Bulldozing, PressureSinkage, Shear, SinkageExponent, Soil};
use grouser::studies::heading::{HeadingStudy, Steering};
use grouser::units::{EARTH_GRAVITY, MOON_GRAVITY, Vec2, deg};
use grouser::vehicle::drive::SlipTarget;
use grouser::vehicle::kinematics::hub_velocity;
use grouser::vehicle::{DriveLaw, LoadSharing, OwnMoments, Rover, RoverState, WheelReaction};

use super::given::{self, RIM_SPEED, run, traverse};

/// A rover that does not move before its wheels do.
const AT_REST: Start = Start { yaw: 0.0, motion: Motion::Rest };
/// Left wheels backward, right wheels forward: a spot turn to the left.
const SPOT_TURN: [f64; 4] = [-RIM_SPEED, -RIM_SPEED, RIM_SPEED, RIM_SPEED];
/// What the source's Eq. 18 is told. Source: [FourWheel], sections 3 and 5.2.
const TARGET: SlipTarget = SlipTarget { speed: 0.06, slip_ratio: 0.2 };

fn on_level_ground() -> Scenario {
    traverse(0.0, 0.0)
}

fn with_shear(shear: Shear, scenario: Scenario) -> Scenario {
    let soil = Soil { shear, ..scenario.ground.soil };
    Scenario { ground: scenario.ground.clone().with_soil(soil), ..scenario }
}

fn with_integrator(integrator: Integrator, scenario: &Scenario) -> Scenario {
    Scenario { numerics: Numerics { integrator, ..scenario.numerics }, ..scenario.clone() }
}

/// Every kind of run, short enough to be run often.
pub(crate) fn all_kinds() -> Vec<(&'static str, Scenario)> {
    let base = Scenario { duration: 1.5, ..traverse(deg(10.0), deg(5.5)) };
    let level = Scenario { duration: 1.5, ..on_level_ground() };
    let spot_turn = DriveLaw::ConstantEach(SPOT_TURN.to_vec());
    let isotropic = Shear::Isotropic { modulus: given::linear(0.028, 0.0) };
    vec![
        ("traverse", base.clone()),
        ("from rest", Scenario { start: AT_REST, ..base.clone() }),
        ("uphill", Scenario { start: Start { yaw: deg(70.0), ..base.start }, ..base.clone() }),
        ("reverse", Scenario { drive: DriveLaw::Constant(-RIM_SPEED), ..base.clone() }),
        ("spot turn", Scenario { drive: spot_turn, start: AT_REST, ..level.clone() }),
        (
            "arc",
            Scenario {
                drive: DriveLaw::ConstantEach(vec![0.04, 0.04, 0.08, 0.08]),
                ..level.clone()
            },
        ),
        (
            "locked wheel",
            Scenario { drive: DriveLaw::ConstantEach(vec![0.0, 0.06, 0.06, 0.06]), ..level },
        ),
        ("Eq. 18", Scenario { drive: DriveLaw::Eq18(TARGET), ..base.clone() }),
        ("Eq. 18 as printed", Scenario { drive: DriveLaw::Eq18AsPrinted(TARGET), ..base.clone() }),
        ("torque", Scenario { sharing: LoadSharing::QuasiStaticTorque, ..base.clone() }),
        ("own moments", Scenario { own_moments: OwnMoments::Included, ..base.clone() }),
        // Here the aligning moments of all wheels have one sign, and do work.
        (
            "arc on a slope with own moments",
            Scenario {
                drive: DriveLaw::ConstantEach(vec![0.04, 0.04, 0.08, 0.08]),
                own_moments: OwnMoments::Included,
                ground: base.ground.with_slope(deg(15.0)),
                ..base.clone()
            },
        ),
        ("equal loads", Scenario { sharing: LoadSharing::Uniform, ..base.clone() }),
        ("isotropic", with_shear(isotropic, base.clone())),
        ("Bekker's theory", Scenario { model: Model::Bekker, ..base.clone() }),
        ("sliding", Scenario { ground: base.ground.with_slope(deg(35.0)), ..base }),
    ]
}

// ---- numerics ----

/// Greatest distance in position [m] and difference in yaw [rad] at the end of two runs.
fn apart(one: &Trajectory, other: &Trajectory) -> (f64, f64) {
    let (one, other) = (&one.last().state, &other.last().state);
    ((one.position - other.position).norm(), (one.yaw - other.yaw).abs())
}

fn check_together(name: &str, one: &Trajectory, other: &Trajectory, within: f64) {
    assert_eq!(one.outcome.name(), other.outcome.name(), "{name}");
    let (distance, turn) = apart(one, other);
    assert!(distance < within && turn < within, "{name}: {distance:.1e} m, {turn:.1e} rad");
}

/// With steps of its own, and with fixed ones: they share no code but the equations.
/// But for the locked wheel: its hub comes to rest, where forces change within the creep speed, and
/// an explicit step would have to be a microsecond.
#[test]
fn steps_of_its_own_and_fixed_ones_agree() {
    for (name, scenario) in all_kinds().into_iter().filter(|(name, _)| *name != "locked wheel") {
        // The control period of Eq. 18 would not be the same time for both past a second.
        let scenario = Scenario { duration: 1.0, ..scenario };
        let rk4 = with_integrator(Integrator::Rk4 { step: 1e-3 }, &scenario);
        // Measured: below 1e-8 from a rolling start, 3e-6 from rest, where the first millisecond is
        // rough for fixed steps, and 8e-6 in a spot turn, which at first is unstable.
        check_together(name, &run(&scenario), &run(&rk4), 5e-5);
    }
}

#[test]
fn halving_the_tolerance_changes_nothing_visible() {
    for (name, scenario) in all_kinds() {
        let finer = with_integrator(Integrator::Adaptive { tolerance: 5e-7 }, &scenario);
        // Measured: 2e-7 in a spot turn, which at first is unstable; 1e-8 in all others.
        check_together(name, &run(&scenario), &run(&finer), 2e-6);
    }
}

#[test]
fn the_same_scenario_gives_the_same_bits() {
    for (name, scenario) in all_kinds() {
        assert_eq!(run(&scenario), run(&scenario.clone()), "{name}");
    }
}

/// Where samples are taken does not steer the integration.
#[test]
fn the_sample_interval_changes_nothing_visible() {
    let scenario = Scenario { duration: 2.0, ..traverse(deg(10.0), 0.0) };
    let often = Numerics { sample_interval: 0.013, ..scenario.numerics };
    let often = Scenario { numerics: often, ..scenario.clone() };
    check_together("often", &run(&scenario), &run(&often), 1e-7);
}

// ---- quasi-steady ----

/// A record begins its search where those before it point to, and ends it where any other does.
#[test]
fn the_wheels_of_records_are_those_that_settle_anew() {
    for (name, scenario) in all_kinds() {
        let mut most: f64 = 0.0;
        for record in run(&scenario).records {
            let pairs = record.wheels.iter().zip(scenario.rover.mounts());
            let rim_speeds: Vec<f64> =
                pairs.map(|(wheel, mount)| wheel.wheel_speed * mount.shearing_radius()).collect();
            let Ok(anew) = Equations::of(&scenario, &rim_speeds).reactions(&record.state) else {
                continue;
            };
            for (wheel, anew) in record.wheels.iter().zip(&anew) {
                let (ours, theirs) = (&wheel.reaction, anew);
                let forces = |it: &WheelReaction| {
                    let forces = &it.settled.forces;
                    [it.load, forces.drawbar_pull, forces.side_force, forces.normal_force]
                };
                let apart =
                    forces(ours).into_iter().zip(forces(theirs)).map(|(a, b)| (a - b).abs());
                let sunk = ours.settled.sinkage / theirs.settled.sinkage - 1.0;
                assert!(ours.load.is_finite() && sunk.is_finite(), "{name}");
                most = apart.map(|it| it / theirs.load).fold(most.max(sunk.abs()), f64::max);
            }
        }
        assert!(most < 1e-11, "{name}: {most:.1e} of the load");
    }
}

/// What a record on the way has, a run has there too: one that goes on from a state, and one whose
/// records are taken away.
#[test]
fn the_last_record_is_where_the_run_is() {
    let mut run = Run::new(&traverse(deg(10.0), 0.0)).expect("it starts");
    for _ in 0..20 {
        run.play(0.1).expect("it goes on");
        let records = run.take_records();
        let last = records.last().expect("it keeps tenths of a second");
        assert_eq!(run.now(), last);
        assert_eq!(Run::resume(run.scenario(), run.state().clone()).now(), last);
    }
}

fn quasi_steady(scenario: &Scenario) -> Scenario {
    let numerics = Numerics { approach: Approach::QuasiSteady, ..scenario.numerics };
    Scenario { numerics, ..scenario.clone() }
}

/// How far two runs of a scenario are from each other, once both have settled.
struct Apart {
    position: f64,
    yaw: f64,
    slip_ratio: f64,
    sinkage: f64,
    /// Over the power itself.
    power: f64,
}

impl Apart {
    /// The greatest differences over all samples from 1 s on: slip settles in milliseconds, at most
    /// in a tenth of a second.
    fn over(one: &Trajectory, other: &Trajectory) -> Self {
        let mut apart = Self { position: 0.0, yaw: 0.0, slip_ratio: 0.0, sinkage: 0.0, power: 0.0 };
        let power = |sample: &Record| sample.wheels.iter().map(WheelRecord::power).sum::<f64>();
        for (one, other) in one.records.iter().zip(&other.records).skip(10) {
            assert_eq!(one.time, other.time);
            let max = |most: &mut f64, value: f64| *most = most.max(value.abs());
            max(&mut apart.position, (one.state.position - other.state.position).norm());
            max(&mut apart.yaw, one.state.yaw - other.state.yaw);
            max(&mut apart.power, power(other) / power(one) - 1.0);
            for (one, other) in one.wheels.iter().zip(&other.wheels) {
                let (one, other) = (&one.reaction, &other.reaction);
                max(&mut apart.slip_ratio, one.slip.ratio - other.slip.ratio);
                max(&mut apart.sinkage, one.settled.sinkage - other.settled.sinkage);
            }
        }
        apart
    }

    /// What is further apart than it may be.
    fn beyond(&self, name: &str, within: &Self) -> Vec<String> {
        let told = [
            ("position [m]", self.position, within.position),
            ("yaw [rad]", self.yaw, within.yaw),
            ("slip ratio", self.slip_ratio, within.slip_ratio),
            ("sinkage [m]", self.sinkage, within.sinkage),
            ("power", self.power, within.power),
        ];
        let beyond = told.iter().filter(|(_, apart, within)| apart >= within);
        let line = |(quantity, apart, within): &(&str, f64, f64)| {
            format!("{name}: {quantity} {apart:.1e} apart, not {within:.1e}\n")
        };
        beyond.map(line).collect()
    }
}

/// What a quasi-steady run may differ by from a dynamic one.
///
/// It settles at once, and so leaves out what the first instants change: in position and yaw the
/// velocities that have to settle, times the time they take. That is 3 ms where slip is small and
/// ten times as much where the wheels nearly spin. Afterwards velocities lag behind their balance
/// by up to 3e-4 of the rims' speed (measured, in arcs across a slope; 1e-5 in traverses), and what
/// was lost in yaw stays.
fn tolerance(dynamic: &Trajectory, steady: &Trajectory) -> Apart {
    /// Longest time of settling [s].
    const SETTLING: f64 = LONGEST_SETTLING;
    let (start, balance) = (&dynamic.records[0].state, &steady.records[0].state);
    let to_settle = (start.velocity - balance.velocity).norm();
    // Hubs are 0.3 m from the middle: what jolts the rover along may turn it as well.
    let turn_to_settle = (start.yaw_rate - balance.yaw_rate).abs() + to_settle / 0.3;
    Apart {
        position: 1e-4 + SETTLING * to_settle,
        yaw: 5e-5 + SETTLING * turn_to_settle,
        slip_ratio: 5e-4,
        sinkage: 3e-6,
        power: 2e-3,
    }
}

/// Many slopes and headings, on two soils: what one way to simulate says, the other says too.
#[test]
fn quasi_steady_and_dynamic_runs_agree() {
    let soils = [("toyoura", given::toyoura()), ("simulant", given::simulant_2007())];
    let mut beyond = Vec::new();
    for ((soil_name, soil), slope) in
        soils.iter().flat_map(|soil| [0.0, 5.0, 10.0, 15.0, 20.0].map(|slope| (soil, slope)))
    {
        for yaw in [-40.0, -10.0, 0.0, 4.0, 12.0, 30.0, 70.0, 180.0] {
            let base = traverse(deg(slope), deg(yaw));
            let ground = base.ground.clone().with_soil(*soil);
            let scenario = Scenario { ground, duration: 5.0, ..base };
            let name = format!("{soil_name}, {slope}°, yaw {yaw}°");
            let (dynamic, steady) = (run(&scenario), run(&quasi_steady(&scenario)));
            assert_eq!(dynamic.outcome, steady.outcome, "{name}");
            assert_eq!(dynamic.records.len(), steady.records.len(), "{name}");
            let within = tolerance(&dynamic, &steady);
            beyond.extend(Apart::over(&dynamic, &steady).beyond(&name, &within));
            // Where the wheels all but spin, velocities need tenths of a second.
            let rolls = slope <= 15.0 && dynamic.outcome == Outcome::Completed;
            if rolls && steady.method != Method::QuasiSteady {
                beyond.push(format!("{name}: {:?}\n", steady.method));
            }
        }
    }
    assert!(beyond.is_empty(), "{}", beyond.concat());
}

/// Every kind of run, whether it is quasi-steady to its end or falls back.
#[test]
fn every_kind_of_run_can_be_asked_for_quasi_steadily() {
    let mut beyond = Vec::new();
    for (name, scenario) in all_kinds() {
        let (dynamic, steady) = (run(&scenario), run(&quasi_steady(&scenario)));
        assert_eq!(dynamic.outcome.name(), steady.outcome.name(), "{name}");
        let within = match name {
            // On 35° velocities approach their balance through ever slower stages: at 1 s a part in
            // 100 is left.
            "sliding" => Apart {
                slip_ratio: 0.01,
                sinkage: 3e-5,
                power: 0.02,
                ..tolerance(&dynamic, &steady)
            },
            _ => tolerance(&dynamic, &steady),
        };
        beyond.extend(Apart::over(&dynamic, &steady).beyond(name, &within));
        let energy = &steady.last().energy;
        let exchanged = energy.motors.abs() + energy.soil.abs() + energy.kinetic;
        // Balances leave forces of a 1e-7 over, and tables of them a 1e-6.
        let error = steady.energy_error().abs();
        if error > 2e-6 * exchanged {
            beyond.push(format!("{name}: {error:.1e} of {exchanged:.1e} J\n"));
        }
    }
    assert!(beyond.is_empty(), "{}", beyond.concat());
}

/// What the name promises: the work goes with the yaw that is turned through, not with the way.
#[test]
fn driving_straight_costs_one_balance_however_far() {
    let settled = |duration: f64, scenario: Scenario| {
        let run = run(&quasi_steady(&Scenario { duration, ..scenario }));
        assert_eq!(run.method, Method::QuasiSteady);
        run.work.settled_wheels
    };
    assert_eq!(settled(20.0, on_level_ground()), settled(2000.0, on_level_ground()));
    // On a slope a rover at its attitude has next to no yaw rate, and turns until it has none.
    let across = |duration| settled(duration, traverse(deg(10.0), deg(5.0)));
    let uphill = |duration| settled(duration, traverse(deg(10.0), deg(90.0)));
    assert!(across(20.0) < 200 && across(2000.0) < 2 * across(20.0), "{}", across(2000.0));
    assert_eq!(uphill(20.0), uphill(2000.0));
    // A dynamic run of 20 s settles some 1500 wheels.
    assert!(run(&traverse(deg(10.0), deg(5.0))).work.settled_wheels > 5 * across(20.0));
}

/// Where no balance is stable, or none exists, the run is dynamic and says so: the same bits.
#[test]
fn without_a_valid_balance_the_run_is_dynamic() {
    let locked = DriveLaw::ConstantEach(vec![0.0; 4]);
    let sliding = Scenario { drive: locked, start: AT_REST, ..traverse(deg(45.0), 0.0) };
    for scenario in [sliding, traverse(deg(58.0), 0.0)] {
        let scenario = Scenario { duration: 2.0, ..scenario };
        let (dynamic, steady) = (run(&scenario), run(&quasi_steady(&scenario)));
        assert!(
            matches!(steady.method, Method::FallbackToDynamic { time: 0.0, .. }),
            "{:?}",
            steady.method
        );
        assert_eq!((dynamic.records, dynamic.outcome), (steady.records, steady.outcome));
    }
}

/// Locked wheels hold a rover up to where the soil gives way: it creeps below a micrometre in a
/// second, straight down, and to know it takes one balance.
#[test]
fn a_parked_rover_stays_where_it_is() {
    let locked = DriveLaw::ConstantEach(vec![0.0; 4]);
    for (slope, yaw) in [(0.0, 0.0), (10.0, 0.0), (10.0, 90.0), (10.0, -40.0), (18.0, 25.0)] {
        let base = traverse(deg(slope), deg(yaw));
        let parked = Scenario { drive: locked.clone(), duration: 20.0, start: AT_REST, ..base };
        let (dynamic, steady) = (run(&parked), run(&quasi_steady(&parked)));
        let name = format!("{slope}°, yaw {yaw}°");
        assert_eq!(steady.method, Method::QuasiSteady, "{name}");
        assert_eq!((&steady.outcome, &dynamic.outcome), (&Outcome::Completed, &Outcome::Completed));
        assert!(steady.work.evaluations < 60, "{name}: {:?}", steady.work);
        let [way, other] = [&steady, &dynamic].map(|run| run.last().state.position);
        assert!(way.norm() < 2e-5 && way.y <= 1e-12, "{name}: {way}");
        assert!((way - other).norm() < 1e-6, "{name}: {way} and {other}");
    }
}

// ---- energy ----

/// Motors in; soil, potential and kinetic energy out.
#[test]
fn the_books_of_energy_close() {
    for (name, scenario) in all_kinds() {
        let run = run(&scenario);
        let energy = &run.last().energy;
        let exchanged = energy.motors.abs() + energy.soil.abs() + energy.kinetic;
        // The energies are integrated with the motion, to a relative 1e-6 of each.
        let error = run.energy_error().abs();
        assert!(error < 2e-6 * exchanged, "{name}: {error:.1e} of {exchanged:.1e} J");
        assert!(exchanged > 1e-3, "{name} exchanges only {exchanged:.1e} J");
    }
}

/// The second law: whatever a rover does, the soil only takes.
#[test]
fn the_soil_never_gives_energy_back() {
    for (name, scenario) in all_kinds() {
        let run = run(&scenario);
        for pair in run.records.windows(2) {
            let (before, after) = (pair[0].energy.soil, pair[1].energy.soil);
            assert!(after > before, "{name}: {before} J, then {after} J at {} s", pair[1].time);
        }
    }
}

// ---- laws ----

/// A rover whose left and right, front and back are all different.
fn irregular(flip_x: f64, flip_y: f64) -> Rover {
    let hubs = [(0.21, 0.24), (-0.17, 0.20), (-0.15, -0.26), (0.05, -0.25), (0.19, -0.22)];
    given::rover_on(given::hakuto_wheel(), &hubs.map(|(x, y)| (flip_x * x, flip_y * y)))
}

/// The mirror swaps x of the slope; uphill stays uphill.
fn check_mirrored(original: &Scenario, mirrored: &Scenario, yaw_of: impl Fn(f64) -> f64) {
    let (original, mirrored) = (run(original), run(mirrored));
    let (here, there) = (&original.last().state, &mirrored.last().state);
    let expected = Vec2::new(-here.position.x, here.position.y);
    // A tenth of the integrator's tolerance: yaws differ in size, and so do the errors they may
    // have.
    assert!((there.position - expected).norm() < 1e-7, "{} and {expected}", there.position);
    assert!((there.yaw - yaw_of(here.yaw)).abs() < 1e-7);
}

/// A rover with its wheels mirrored from front to back, driven backward, turned the other way.
#[test]
fn backward_is_forward_in_a_mirror() {
    let speeds = [0.05, 0.07, 0.06, 0.04, 0.08];
    let drive = |sense: f64| DriveLaw::ConstantEach(speeds.map(|speed| sense * speed).to_vec());
    for sharing in [LoadSharing::QuasiStatic, LoadSharing::QuasiStaticTorque] {
        let scenario = |flip: f64| Scenario {
            rover: irregular(flip, 1.0),
            drive: drive(flip),
            sharing,
            own_moments: OwnMoments::Included,
            duration: 5.0,
            ..traverse(deg(10.0), flip * deg(12.0))
        };
        check_mirrored(&scenario(1.0), &scenario(-1.0), |yaw| -yaw);
    }
}

/// A rover with its wheels mirrored from left to right, driven forward the other way along the
/// slope.
#[test]
fn left_is_right_in_a_mirror() {
    for sharing in [LoadSharing::QuasiStatic, LoadSharing::QuasiStaticTorque] {
        let scenario = |flip: f64, yaw: f64| Scenario {
            rover: irregular(1.0, flip),
            drive: DriveLaw::ConstantEach(vec![0.05, 0.07, 0.06, 0.04, 0.08]),
            sharing,
            own_moments: OwnMoments::Included,
            duration: 5.0,
            ..traverse(deg(10.0), yaw)
        };
        let (one, other) = (scenario(1.0, deg(12.0)), scenario(-1.0, PI - deg(12.0)));
        check_mirrored(&one, &other, |yaw| PI - yaw);
    }
}

/// Source: theory, section 7.5: in weighing sand the same rover goes the same way under any
/// gravity, in a time and at a speed that go with its root.
#[test]
fn on_the_moon_the_same_rover_goes_the_same_way_more_slowly() {
    let earth = traverse(deg(15.0), deg(5.0));
    let q: f64 = MOON_GRAVITY / EARTH_GRAVITY;
    let moon = Scenario {
        gravity: MOON_GRAVITY,
        drive: DriveLaw::Constant(RIM_SPEED * q.sqrt()),
        duration: earth.duration / q.sqrt(),
        ..earth.clone()
    };
    // The integrator's tolerances are lengths and speeds, and do not scale along.
    check_together("moon", &run(&earth), &run(&moon), 1e-5);
    let energy = |scenario: &Scenario| run(scenario).last().energy.motors;
    assert!((energy(&moon) / energy(&earth) / q - 1.0).abs() < 1e-5, "energy goes with gravity");
}

#[test]
fn the_level_attitude_does_not_depend_on_gravity_in_weighing_sand() {
    let yaw_under = |gravity: f64| {
        let study = HeadingStudy {
            rover: given::hakuto(),
            soil: given::toyoura(),
            gravity,
            model: Model::Ishigami,
            sharing: LoadSharing::QuasiStatic,
            own_moments: OwnMoments::Neglected,
            stability: grouser::soil::SlopeStability::USUAL,
            steering: Steering::None,
        };
        let curve = study.curve().expect("sand and gravity");
        let yaw = curve.at(deg(15.0)).expect("it can be crossed").yaw;
        (yaw, curve.limit().expect("it moves").0)
    };
    let (earth, moon) = (yaw_under(EARTH_GRAVITY), yaw_under(MOON_GRAVITY));
    assert!((earth.0 - moon.0).abs() < 1e-8 && (earth.1 - moon.1).abs() < 1e-6);
}

// ---- how a rover drives ----

#[test]
fn a_start_from_rest_joins_a_rolling_start() {
    let rolling = traverse(deg(10.0), deg(5.0));
    let start = Start { motion: Motion::Rest, ..rolling.start };
    let (rolling, rest) = (run(&rolling), run(&Scenario { start, ..rolling }));
    let (rolling, rest) = (rolling.last().state, rest.last().state);
    // Slip settles in milliseconds; what stays is yaw, by hundredths of a degree.
    assert!((rolling.velocity - rest.velocity).norm() < 1e-5);
    assert!((rolling.yaw - rest.yaw).abs() < deg(0.02));
    let behind = rolling.position.x - rest.position.x;
    assert!(behind > 0.0 && behind < 2e-3, "{behind} m behind");
}

/// |y| below 5 mm after 20 s at 6 cm/s, and yaw within half a degree.
#[test]
fn a_run_started_at_the_attitude_stays_level() {
    for (slope, yaw) in [(5.0, 2.13), (10.0, 5.04), (15.0, 9.58), (20.0, 21.38)] {
        let run = run(&traverse(deg(slope), deg(yaw)));
        let end = run.last().state;
        assert_eq!(run.outcome, Outcome::Completed);
        assert!(end.position.y.abs() < 5e-3, "{} m on {slope}°", end.position.y);
        assert!((end.yaw - deg(yaw)).abs() < deg(0.5), "{}° on {slope}°", end.yaw.to_degrees());
        assert!(end.position.x > 0.7, "{} m along {slope}°", end.position.x);
    }
}

#[test]
fn on_level_ground_straight_ahead_stays_straight() {
    for drive in [RIM_SPEED, -RIM_SPEED] {
        let end =
            run(&Scenario { drive: DriveLaw::Constant(drive), ..on_level_ground() }).last().state;
        // 20 s at 6 cm/s, less some per cent of slip.
        assert!((end.position.x / (20.0 * drive) - 0.95).abs() < 0.02, "{} m", end.position.x);
        assert!(end.position.y.abs() < 1e-9 && end.yaw.abs() < 1e-9);
    }
}

/// Source: theory, section 10: the jump of the law of 2007 at β = 0 is the stress test.
#[test]
fn the_sign_law_does_not_chatter() {
    let with_sign = |scenario: Scenario| {
        let soil = Soil { bulldozing: Bulldozing::Sign, ..scenario.ground.soil };
        run(&Scenario { ground: scenario.ground.clone().with_soil(soil), ..scenario })
    };
    for scenario in [
        on_level_ground(),
        Scenario { start: AT_REST, ..on_level_ground() },
        traverse(deg(3.0), 0.0),
    ] {
        let run = with_sign(scenario);
        assert!(run.work.evaluations < 1000, "{} evaluations", run.work.evaluations);
        // On 3° the flanks hold the rover as a keel would: no drift, no yaw needed.
        assert!(run.last().state.position.y.abs() < 1e-4);
    }
    assert!(with_sign(traverse(deg(10.0), 0.0)).last().state.position.y < -0.01);
}

#[test]
fn eq_18_corrected_reaches_its_target_along_the_contour_and_as_printed_misses_it() {
    let speed_with = |drive| {
        let run = run(&Scenario { drive, ..traverse(deg(10.0), deg(5.04)) });
        run.last().state.velocity_slope().x
    };
    let corrected = speed_with(DriveLaw::Eq18(TARGET));
    assert!((corrected / 0.06 - 1.0).abs() < 1e-3, "{corrected} m/s");
    // At a slip below the reference of 0.2 it turns too fast: at 0.08, by 1/(0.88 cos²γ).
    let printed = speed_with(DriveLaw::Eq18AsPrinted(TARGET));
    let expected = 0.06 * (1.0 - 0.08) / (1.0 - 0.12);
    assert!((printed / expected - 1.0).abs() < 0.01, "{printed} m/s, not {expected} m/s");
}

#[test]
fn faster_wheels_on_the_right_turn_the_rover_left() {
    let drive = DriveLaw::ConstantEach(vec![0.04, 0.04, 0.08, 0.08]);
    let end = run(&Scenario { drive, ..on_level_ground() }).last().state;
    // Without slip: 0.04 m/s over a track of 0.48 m for 20 s, 95°. Skidding, a third of it.
    assert!(end.yaw > deg(20.0) && end.yaw < deg(50.0), "{}°", end.yaw.to_degrees());
    assert!(end.position.x > 0.8 && end.position.y > 0.1, "{}", end.position);
}

/// A motor that has failed with its wheel blocked, front left: the others cannot drag it.
#[test]
fn a_rover_turns_about_its_locked_wheel() {
    let drive = DriveLaw::ConstantEach(vec![0.0, RIM_SPEED, RIM_SPEED, RIM_SPEED]);
    let run = run(&Scenario { drive, ..on_level_ground() });
    let (state, locked) = (run.last().state, &run.last().wheels[0]);
    let hub = hub_velocity(&state, Vec2::new(0.19, 0.24));
    assert!(hub.norm() < 1e-5, "its hub moves at {} m/s", hub.norm());
    assert!(locked.reaction.settled.forces.drawbar_pull < -0.1 * locked.reaction.load);
    assert_eq!(locked.power(), 0.0);
    assert!(state.yaw > deg(20.0), "{}°", state.yaw.to_degrees());
}

/// A theory of ratios of speeds has no friction at rest; what holds a parked rover is creep, of at
/// most a micrometre a second.
#[test]
fn a_parked_rover_stays() {
    for slope in [10.0, 20.0, 30.0] {
        for yaw in [0.0, 45.0, 90.0] {
            let start = Start { yaw: deg(yaw), motion: Motion::Rest };
            let drive = DriveLaw::Constant(0.0);
            let parked = Scenario { drive, start, duration: 60.0, ..traverse(deg(slope), 0.0) };
            let run = run(&parked);
            let moved = run.last().state.position.norm();
            assert_eq!(run.outcome, Outcome::Completed);
            assert!(moved < 1e-4, "{moved} m in a minute on {slope}°, yaw {yaw}°");
            assert!(run.last().state.position.y < 0.0, "and if it creeps, then downhill");
        }
    }
}

#[test]
fn rovers_of_three_and_of_six_wheels_cross_a_slope() {
    let three = [(0.25, 0.0), (-0.15, 0.2), (-0.15, -0.2)];
    let six =
        [(0.25, 0.24), (0.0, 0.24), (-0.25, 0.24), (-0.25, -0.24), (0.0, -0.24), (0.25, -0.24)];
    for hubs in [&three[..], &six[..]] {
        let rover = given::rover_on(given::hakuto_wheel(), hubs);
        let run = run(&Scenario { rover, ..traverse(deg(10.0), deg(5.0)) });
        let last = run.last();
        assert_eq!((run.outcome.name(), last.wheels.len()), ("completed", hubs.len()));
        // Level to a few per cent of the way, for the attitude is another rover's.
        assert!(last.state.position.x > 1.0 && last.state.position.y.abs() < 0.05);
    }
}

// ---- spot turns ----

fn spot_turn(rover: Rover, shear: Shear) -> Trajectory {
    let drive = DriveLaw::ConstantEach(SPOT_TURN.to_vec());
    let scenario = Scenario { rover, drive, start: AT_REST, ..on_level_ground() };
    run(&with_shear(shear, scenario))
}

fn constant_moduli() -> Shear {
    Shear::Anisotropic {
        longitudinal: given::linear(0.036, 0.0),
        lateral: given::linear(0.013, 0.0),
    }
}

fn isotropic() -> Shear {
    Shear::Isotropic { modulus: given::linear(0.028, 0.0) }
}

#[test]
fn a_spot_turn_turns_on_the_spot() {
    for shear in [constant_moduli(), isotropic()] {
        let end = spot_turn(given::hakuto(), shear).last().state;
        assert!(end.yaw > deg(60.0), "{}°", end.yaw.to_degrees());
        // Its hubs are 1 cm nearer the back, and so is what it turns about.
        assert!(end.position.norm() < 0.01, "{} m off the spot", end.position.norm());
    }
}

/// At steady turning the soil's moment about the common centre vanishes. Source: theory, 7.11.
#[test]
fn a_steady_spot_turn_balances_its_moments() {
    let run = spot_turn(given::hakuto(), constant_moduli());
    let rover = given::hakuto();
    let wheels = run.last().wheels.iter().map(|wheel| wheel.reaction.settled.forces);
    let moments = rover
        .load_arms()
        .iter()
        .zip(wheels)
        .map(|(arm, forces)| arm.perp(&Vec2::new(forces.drawbar_pull, forces.side_force)));
    let (sum, size) =
        moments.fold((0.0, 0.0), |(sum, size): (f64, f64), m: f64| (sum + m, size + m.abs()));
    assert!(sum.abs() < 1e-4 * size.max(1.0), "{sum} N·m of {size}");
}

/// With the paper's moduli a spot turn drifts off: the wheels of one side slip less, see a smaller
/// slip angle, shear a stiffer soil, and so slip less. K_x = 0.036 + 0.043 |β| was fitted to slip
/// angles well below those of a spot turn (35 to 38°), and the drift is what the fit is worth
/// there: with half the slope, with constant moduli or with isotropic shear there is none. Even a
/// rover that all but is its own mirror image drifts, to either side. LIMIT: use `isotropic` shear
/// for spot turns.
#[test]
fn the_papers_shear_moduli_make_a_spot_turn_drift() {
    let with_slope = |per_radian: f64| Shear::Anisotropic {
        longitudinal: given::linear(0.036, per_radian),
        lateral: given::linear(0.013, 0.020),
    };
    let half_base = 0.18;
    let mirrored = [1.0, -1.0].map(|side| [(half_base, 0.24 * side), (-half_base, 0.24 * side)]);
    let [left, right] = mirrored;
    // A tenth of a millimetre tips the balance: rovers without any difference stay on it.
    let nudged = (right[0].0 + 1e-4, right[0].1);
    let symmetric = given::rover_on(given::hakuto_wheel(), &[left[0], left[1], right[1], nudged]);
    let drift = |rover: &Rover, per_radian: f64| {
        spot_turn(rover.clone(), with_slope(per_radian)).last().state.velocity.x.abs()
    };
    for rover in [given::hakuto(), symmetric] {
        let paper = drift(&rover, 0.043);
        assert!((paper - 0.016).abs() < 0.001, "{paper} m/s");
        assert!(drift(&rover, 0.020) < 1e-4);
    }
}

// ---- how runs end ----

fn check_stuck(scenario: &Scenario, check: impl Fn(&StuckBecause) -> bool) {
    match run(scenario).outcome {
        Outcome::Immobilised { because, .. } if check(&because) => {}
        other => panic!("it should be immobilised, not {other:?}"),
    }
}

#[test]
fn a_slope_of_25_degrees_is_too_steep_to_climb() {
    for motion in [Motion::Rolling, Motion::Rest] {
        let start = Start { yaw: deg(90.0), motion };
        let uphill = Scenario { start, ..traverse(deg(25.0), 0.0) };
        check_stuck(&uphill, |because| *because == StuckBecause::WheelsSpin);
    }
    assert_eq!(run(&traverse(deg(15.0), deg(90.0))).outcome, Outcome::Completed);
}

#[test]
fn on_35_degrees_the_rover_slides_from_across_and_from_uphill() {
    for yaw in [0.0, 90.0] {
        let run = run(&traverse(deg(35.0), deg(yaw)));
        assert!(
            matches!(run.outcome, Outcome::Sliding { time } if time < 2.0),
            "{:?}",
            run.outcome
        );
        let RoverState { position, .. } = run.last().state;
        assert!(position.y < 0.0);
    }
}

#[test]
fn on_58_degrees_the_rover_tips_over_before_it_starts() {
    let run = run(&traverse(deg(58.0), 0.0));
    assert_eq!(run.outcome, Outcome::TippedOver { time: 0.0 });
    assert_eq!(run.records.len(), 1);
}

#[test]
fn in_mud_a_wheel_sinks_to_its_axle() {
    let exponent = SinkageExponent::constant(1.703);
    let pressure_sinkage = PressureSinkage::Reece { k_c: 0.0, k_phi: 1.0, exponent };
    let soil = Soil { pressure_sinkage, ..given::toyoura() };
    let level = on_level_ground();
    let mud = Scenario { ground: level.ground.clone().with_soil(soil), ..level };
    check_stuck(
        &mud,
        |because| matches!(because, StuckBecause::SunkToAxle { load, capacity, .. } if capacity < load),
    );
}

// ---- every soil, with wheels that stand still ----

/// Wheels that are locked, dragged or turned against each other bring hubs to rest, where forces
/// change within the creep speed: on every soil that comes with the program the run goes on.
#[test]
fn runs_with_locked_wheels_are_computed_on_every_soil() {
    let speeds = [
        [0.0, 0.0, RIM_SPEED, RIM_SPEED],
        [RIM_SPEED, RIM_SPEED, -RIM_SPEED, 0.0],
        [0.0, RIM_SPEED, RIM_SPEED, RIM_SPEED],
    ];
    let soils: Vec<Soil> = document::presets(Kind::Soil)
        .map(|preset| document::read_soil(&Source::Preset(preset), &Overrides::none()))
        .map(|soil| soil.expect("presets are good").value)
        .collect();
    assert!(soils.len() >= 20);
    for (soil, slope) in soils.iter().flat_map(|soil| [(soil, 0.0), (soil, deg(15.0))]) {
        for speeds in speeds {
            let base = traverse(slope, 0.0);
            let ground = base.ground.clone().with_soil(*soil);
            let drive = DriveLaw::ConstantEach(speeds.to_vec());
            run(&Scenario { ground, drive, duration: 5.0, ..base });
        }
    }
}

/// Two left wheels locked, on a steep slope, for a minute: many steps in which a hub all but stops.
#[test]
fn a_long_run_with_locked_wheels_is_computed_to_its_end() {
    let drive = DriveLaw::ConstantEach(vec![0.0, 0.0, RIM_SPEED, RIM_SPEED]);
    let end = run(&Scenario { drive, duration: 60.0, ..traverse(deg(20.0), 0.0) });
    assert_eq!(end.outcome.name(), "immobilised");
}

/// Downhill the hubs are a little faster than the rims: braking, no slide.
#[test]
fn a_rover_that_drives_downhill_does_not_slide() {
    for (slope, yaw, speed) in
        [(8.0, -90.0, RIM_SPEED), (15.0, -60.0, RIM_SPEED), (12.0, 90.0, -RIM_SPEED)]
    {
        let base = traverse(deg(slope), deg(yaw));
        let run = run(&Scenario { drive: DriveLaw::Constant(speed), duration: 10.0, ..base });
        assert_eq!(run.outcome, Outcome::Completed, "{slope}°, {yaw}°");
        let end = run.last().state.position;
        assert!((0.55..0.9).contains(&-end.y.min(0.0)), "{end}");
    }
}

/// Samples are a record; what becomes of the rover is looked at by itself.
#[test]
fn the_outcome_does_not_depend_on_how_often_samples_are_kept() {
    let outcome_at = |sample_interval: f64| {
        let base = traverse(deg(35.0), 0.0);
        let numerics = Numerics { sample_interval, ..base.numerics };
        run(&Scenario { numerics, ..base }).outcome
    };
    let usual = outcome_at(0.1);
    assert_eq!(usual.name(), "sliding");
    for sample_interval in [0.01, 0.7, 1.0, 30.0] {
        assert_eq!(outcome_at(sample_interval), usual, "every {sample_interval} s");
    }
}

/// A drive that is asked ten times a second records no more for it.
#[test]
fn a_drive_that_varies_keeps_to_the_sample_interval() {
    let base =
        Scenario { drive: DriveLaw::Eq18(TARGET), duration: 3.0, ..traverse(deg(10.0), 0.0) };
    let numerics = Numerics { sample_interval: 1.0, ..base.numerics };
    let times: Vec<f64> =
        run(&Scenario { numerics, ..base }).records.iter().map(|sample| sample.time).collect();
    assert_eq!(times, [0.0, 1.0, 2.0, 3.0]);
}
