//! Slip from the currents of motors: how well it holds, where it is ill-posed, and what a wrong
//! soil does to it.

use grouser::contact::{Contact, Model, Slip, settle};
use grouser::document::measurements::motor_log::{LogChoice, read_motor_log};
use grouser::document::statistics::{Probability, random};
use grouser::document::{self, Overrides, Source};
use grouser::simulation::{Approach, Numerics, Scenario, Trajectory};
use grouser::soil::{Shear, Soil};
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::slip_from_current::{
    Agreement, MotorLog, MotorReading, MotorRecord, NoEstimator, SlipEstimate, SlipEstimator,
    SlipSettings, SlipStatus, TorqueNoise, WIDEST,
};
use grouser::units::{EARTH_GRAVITY, deg};
use grouser::vehicle::{Motor, Rover};

use super::given::{complete_traverse, hakuto_wheel, linear, run, toyoura};
use super::motors::{MOTOR, with};

/// Torques are known to 5 %, and to no other error.
const FIVE_PERCENT: SlipSettings =
    SlipSettings { noise: TorqueNoise { relative: 0.05, absolute: 0.0 }, ..SlipSettings::USUAL };

/// * `slope`, `yaw`: [°]
fn drive(slope: f64, yaw: f64) -> Scenario {
    let mut scenario = with(MOTOR, complete_traverse(slope, yaw));
    let numerics = scenario.numerics;
    scenario.numerics =
        Numerics { approach: Approach::QuasiSteady, sample_interval: 0.2, ..numerics };
    scenario
}

/// Currents and speeds of a run, as of torques with noise.
///
/// * `has_loads`: whether the loads are read, too
fn log_of(run: &Trajectory, scenario: &Scenario, noise: f64, has_loads: bool) -> MotorLog {
    let mut random = random::generator(7, 0);
    let records = run.records.iter().map(|record| {
        let wheels = record.wheels.iter().zip(scenario.rover.mounts()).map(|(wheel, mount)| {
            let (reaction, motor) = (wheel.reaction, mount.unit.motor?);
            let factor = 1.0 + noise * random::standard_normal(&mut random);
            let torque = reaction.settled.forces.torque * factor;
            Some(MotorReading {
                current: motor.at(torque, wheel.wheel_speed).current,
                wheel_speed: wheel.wheel_speed,
                load: has_loads.then_some(reaction.load),
                slip_angle: Some(reaction.slip.angle),
                steering: None,
                slip_ratio: Some(reaction.slip.ratio),
            })
        });
        MotorRecord {
            time: record.time,
            slope: Some(scenario.ground.plane_slope().expect("a plane")),
            yaw: Some(record.state.yaw),
            course: None,
            wheels: wheels.collect(),
        }
    });
    MotorLog { records: records.collect() }
}

fn estimator(scenario: &Scenario, settings: SlipSettings) -> SlipEstimator {
    SlipEstimator::new(scenario, Vec::new(), settings).expect("a rover with motors")
}

/// The torque of HAKUTO's wheel under a load, at a slip ratio and slip angle.
fn torque(soil: Soil, load: f64, slip_ratio: f64, slip_angle: f64) -> f64 {
    let slip = Slip::on_test_stand(slip_ratio, slip_angle);
    let contact = Contact { wheel: hakuto_wheel(), soil, slip, gravity: EARTH_GRAVITY };
    let settled = settle(Model::Ishigami.as_ref(), &contact, load).expect("it is carried");
    settled.forces.torque
}

/// What one wheel of a level rover says, from its torque.
fn of_torque(
    estimator: &SlipEstimator,
    torque: f64,
    (load, slip_angle): (f64, f64),
    wheel_speed: f64,
) -> SlipEstimate {
    let current = MOTOR.at(torque, wheel_speed).current;
    let (load, slip_angle) = (Some(load), Some(slip_angle));
    let reading =
        MotorReading { current, wheel_speed, load, slip_angle, ..MotorReading::default() };
    let record = MotorRecord { wheels: vec![Some(reading)], ..MotorRecord::default() };
    estimator.estimate(&record)[0].expect("a reading")
}

/// Torques with 5 % of noise, across slopes and straight up them to a slip of 0.4; with loads that
/// are read, and with those of the load transfer.
#[test]
fn intervals_hold_the_slip_as_often_as_they_say() {
    let drives = [(0.0, 0.0), (5.0, 2.0), (10.0, 5.0), (15.0, 9.0), (18.0, 13.0)];
    let climbs = [4.0, 8.0, 10.0, 12.0].map(|slope| (slope, 90.0));
    for has_loads in [true, false] {
        let (mut held, mut compared, mut most) = (0, 0, 0.0_f64);
        for (slope, yaw) in drives.into_iter().chain(climbs) {
            let scenario = drive(slope, yaw);
            let run = run(&scenario);
            let log = log_of(&run, &scenario, 0.05, has_loads);
            let found = estimator(&scenario, FIVE_PERCENT).of_log(&log, &|| true).expect("all");
            let agreement = Agreement::over(&log, &found, None);
            let here = agreement.held.expect("the slip is known");
            assert_eq!(agreement.readings, here.trials, "every reading has an interval");
            let share = here.estimate();
            assert!((0.90..=0.98).contains(&share), "{slope}°, {yaw}°: {share}, {has_loads}");
            (held, compared) = (held + here.successes, compared + here.trials);
            most = most.max(run.last().wheels[0].reaction.slip.ratio);
        }
        let share = Probability { successes: held, trials: compared }.estimate();
        assert!((0.94..=0.97).contains(&share), "{share} of {compared}, {has_loads}");
        assert!(most > 0.39, "slip up to {most}");
    }
}

/// Loads from the torques of all wheels and the slope are those of the run to 0.1 N of 11 to 22 N.
#[test]
fn loads_follow_from_the_torques_of_all_wheels() {
    for (slope, yaw) in [(0.0, 0.0), (15.0, 9.0), (18.0, 13.0), (12.0, 90.0)] {
        let scenario = drive(slope, yaw);
        let run = run(&scenario);
        let log = log_of(&run, &scenario, 0.0, false);
        let found = estimator(&scenario, FIVE_PERCENT).of_log(&log, &|| true).expect("all");
        let last = found.last().expect("records");
        for (wheel, estimate) in run.last().wheels.iter().zip(last) {
            let load = estimate.expect("a reading").load.expect("it stands");
            assert!((load - wheel.reaction.load).abs() < 0.1, "{slope}°: {load} N, {wheel:?}");
        }
    }
}

/// At a slip of 0.05 in soil that is known, to 0.005, whatever the load and the slip angle; and so
/// backward.
#[test]
fn without_noise_the_slip_is_found() {
    let estimator = estimator(&drive(0.0, 0.0), SlipSettings::USUAL);
    for load in [8.0, 12.3, 17.0, 24.0] {
        for slip_angle in [0.0, -4.0, 7.0, -13.0].map(deg) {
            for slip_ratio in [0.02, 0.05, 0.15, 0.3] {
                let torque = torque(toyoura(), load, slip_ratio, slip_angle);
                let found = of_torque(&estimator, torque, (load, slip_angle), 0.55);
                let slip = found.slip_ratio.expect("it is driven");
                let (error, within) = (slip.median - slip_ratio, 0.005_f64.max(0.03 * slip_ratio));
                assert!(error.abs() < within, "{load} N, {slip_angle}: {slip_ratio}, {slip:?}");
                let back = of_torque(&estimator, -torque, (load, slip_angle), -0.55);
                let back = back.slip_ratio.expect("it is driven");
                assert!((back.median + slip.median).abs() < 1e-9 && back.low < back.high);
            }
        }
    }
}

/// Soil whose shear is mobilised within a few millimetres: theory 13b.
fn short(modulus: f64) -> Soil {
    let shear =
        Shear::Anisotropic { longitudinal: linear(modulus, 0.0), lateral: linear(modulus, 0.0) };
    Soil { shear, ..toyoura() }
}

/// The status is `ill-posed` exactly where the interval is wider than 0.2: with K_x of 5 mm from a
/// slip of 0.15 on, with 10 mm from 0.3 on, and with Toyoura's 36 mm from 0.55 on, under 17 N and
/// with 5 % and 0.005 N·m of noise.
#[test]
fn saturated_torque_is_ill_posed_and_says_so() {
    for (modulus, from) in [(0.005, 0.15), (0.010, 0.30), (0.036, 0.55)] {
        let mut scenario = drive(0.0, 0.0);
        scenario.ground.soil = short(modulus);
        let estimator = estimator(&scenario, SlipSettings::USUAL);
        for step in 1..18 {
            let slip_ratio = 0.05 * f64::from(step);
            let torque = torque(short(modulus), 17.0, slip_ratio, 0.0);
            let found = of_torque(&estimator, torque, (17.0, 0.0), 0.55);
            let width = found.width().expect("it is driven");
            let is_ill_posed = found.status == SlipStatus::IllPosed;
            assert_eq!(is_ill_posed, width > WIDEST, "{found:?}");
            let is_beyond = slip_ratio > from - 0.01;
            assert_eq!(is_ill_posed, is_beyond, "{modulus} m, slip {slip_ratio}: {found:?}");
            assert!(found.holds(slip_ratio) == Some(true), "{found:?}");
        }
    }
}

/// A friction angle 2° too small biases a slip of 0.26 by +0.03, one 2° too large by −0.02.
#[test]
fn a_wrong_friction_angle_biases_the_slip() {
    let scenario = drive(8.0, 90.0);
    let run = run(&scenario);
    let log = log_of(&run, &scenario, 0.0, true);
    let bias = |error: f64| {
        let soil = Soil { friction_angle: toyoura().friction_angle + deg(error), ..toyoura() };
        let wrong =
            Scenario { ground: scenario.ground.clone().with_soil(soil), ..scenario.clone() };
        let found = estimator(&wrong, SlipSettings::USUAL).of_log(&log, &|| true).expect("all");
        Agreement::over(&log, &found, None).bias.expect("the slip is known")
    };
    let [low, right, high] = [-2.0, 0.0, 2.0].map(bias);
    assert!(right.abs() < 3e-3, "{right}");
    assert!((0.025..0.035).contains(&low) && (-0.03..-0.02).contains(&high), "{low}, {high}");
}

/// Samples of what the soil's document leaves open widen the interval: from 0.05 to 0.3, with the
/// priors of Toyoura sand.
#[test]
fn an_uncertain_soil_widens_the_interval() {
    let overrides = Overrides::parse(["soil.friction_angle_deg=37.5"]).expect("a setting");
    let loaded = document::read_scenario(&Source::default_scenario(), &overrides).expect("it is");
    let mut scenario = with(MOTOR, loaded.value.clone());
    scenario.ground = scenario.ground.with_slope(0.0);
    let samples = BandInputs::of_scenario(&loaded).samples(1, 40).expect("soils");
    let torque = 0.3;
    let widths = [Vec::new(), samples].map(|samples| {
        let estimator = SlipEstimator::new(&scenario, samples, SlipSettings::USUAL);
        let found = of_torque(&estimator.expect("motors"), torque, (17.0, 0.0), 0.55);
        found.width().expect("it is driven")
    });
    assert!(widths[0] < 0.06 && widths[1] > 4.0 * widths[0], "{widths:?}");
}

#[test]
fn what_a_current_does_not_say_has_a_status() {
    let scenario = drive(0.0, 0.0);
    let own = estimator(&scenario, SlipSettings::USUAL);
    let status = |torque, wheel_speed| {
        let found = of_torque(&own, torque, (17.0, 0.0), wheel_speed);
        assert_eq!(
            found.slip_ratio.is_some(),
            matches!(found.status, SlipStatus::Ok | SlipStatus::IllPosed)
        );
        found.status
    };
    assert_eq!(status(0.2, 0.0), SlipStatus::Standing);
    assert_eq!(status(3.0, 0.5), SlipStatus::TorqueTooHigh);
    assert_eq!(status(-3.0, 0.5), SlipStatus::TorqueTooLow);
    assert_eq!(of_torque(&own, 0.2, (1e5, 0.0), 0.5).status, SlipStatus::NotCarried);
    assert_eq!(of_torque(&own, 0.0, (0.0, 0.0), 0.5).status, SlipStatus::Unloaded);

    let motor = Motor { is_self_locking: true, ..MOTOR };
    let locking = estimator(&with(motor, complete_traverse(0.0, 0.0)), SlipSettings::USUAL);
    let reading = |current| {
        let reading =
            MotorReading { current, wheel_speed: 0.5, load: Some(17.0), ..MotorReading::default() };
        let record = MotorRecord { wheels: vec![Some(reading)], ..MotorRecord::default() };
        locking.estimate(&record)[0].expect("a reading")
    };
    assert_eq!(reading(motor.at(-0.2, 0.5).current).status, SlipStatus::SelfLocking);
    // Hardly any torque: it may be driven a little, or brake as much as the slips asked for allow.
    let hardly = reading(0.1001).slip_ratio.expect("it drives");
    assert!(hardly.low < -0.15 && hardly.high < 0.03, "{hardly:?}");

    let steep = MotorRecord {
        slope: Some(deg(60.0)),
        wheels: vec![Some(MotorReading {
            wheel_speed: 0.5,
            current: 0.2,
            ..MotorReading::default()
        })],
        ..MotorRecord::default()
    };
    assert_eq!(own.estimate(&steep)[0].expect("a reading").status, SlipStatus::Tipping);
    let without = SlipEstimator::new(&complete_traverse(0.0, 0.0), Vec::new(), SlipSettings::USUAL);
    assert_eq!(without.expect_err("no motor"), NoEstimator::NoMotor);
    let wrong = SlipSettings { slips: [0.5, 0.1], ..SlipSettings::USUAL };
    assert!(SlipEstimator::new(&scenario, Vec::new(), wrong).is_err());
}

/// The crab of a rover that holds the contour is the slip angle of its wheels.
#[test]
fn a_course_gives_the_slip_angle() {
    let estimator = estimator(&drive(10.0, 5.0), SlipSettings::USUAL);
    let reading = MotorReading { current: 0.25, wheel_speed: 0.5, ..MotorReading::default() };
    let record =
        MotorRecord { yaw: Some(deg(5.0)), wheels: vec![Some(reading)], ..MotorRecord::default() };
    let angle = |record: &MotorRecord| estimator.estimate(record)[0].expect("a reading").slip_angle;
    assert_eq!(angle(&record), 0.0);
    let held = MotorRecord { course: Some(0.0), ..record };
    assert!((angle(&held) + deg(5.0)).abs() < 1e-12);
}

/// With its wheels at the crab angle and its body on the contour a rover's wheels see what they see
/// with the body turned.
#[test]
fn a_steering_angle_counts_against_the_course() {
    let mut scenario = drive(10.0, 0.0);
    let mut parts = scenario.rover.parts().clone();
    parts.steering.limit = Some(deg(30.0));
    scenario.rover = Rover::draft(parts).checked().expect("a rover");
    let estimator = estimator(&scenario, SlipSettings::USUAL);
    let steered = |steering: f64| {
        let reading = MotorReading {
            current: 0.25,
            wheel_speed: 0.5,
            steering: Some(deg(steering)),
            ..MotorReading::default()
        };
        let wheels = vec![Some(reading); 4];
        let record = MotorRecord { course: Some(0.0), wheels, ..MotorRecord::default() };
        estimator.estimate(&record)[0].expect("a reading")
    };
    assert!((steered(5.0).slip_angle + deg(5.0)).abs() < 1e-12);
    assert_eq!(steered(0.0).slip_angle, 0.0);
    assert_eq!(steered(40.0), steered(30.0), "beyond the limit");
    assert_ne!(steered(5.0).load, steered(0.0).load);
}

/// Both layouts of a log are the same log.
#[test]
fn logs_are_read_wide_and_long() {
    let rover = drive(0.0, 0.0).rover;
    let read =
        |text: &str| read_motor_log("log.csv", text.as_bytes(), &LogChoice::default(), &rover);
    let wide = "time_s,yaw_deg,wheel 1.current_a,wheel 1.wheel_speed_rad_s,wheel 2.current_a,wheel 2.wheel_speed_rad_s\n\
                0,5,0.2,0.5,0.3,0.5\n1,5,0.2,0.5,,\n";
    let long = "time_s,wheel,yaw_deg,current_a,wheel_speed_rad_s\n\
                0,wheel 1,5,0.2,0.5\n0,wheel 2,5,0.3,0.5\n1,wheel 1,5,0.2,0.5\n";
    let log = read(wide).expect("a log");
    assert_eq!(log, read(long).expect("a log"));
    assert_eq!(log.records[0].wheels.iter().flatten().count(), 2);
    for (text, message) in [
        ("wheel 1.current_a\n0.2\n", "the time is missing"),
        ("time_s,wheel 1.current_a\n0,0.2\n", "no column `wheel 1.wheel_speed_rad_s`"),
        ("time_s,wheel 1.wheel_speed_rad_s\n0,0.2\n", "a [motor]"),
        (
            "time_s,nose.current_a,nose.wheel_speed_rad_s\n0,0.2,1\n",
            "`nose` is no wheel of the rover",
        ),
        ("time_s,current_a,wheel_speed_rad_s\n0,0.2,1\n", "no column `wheel`"),
        (
            "time_s,wheel,current_a,wheel_speed_rad_s\n0,wheel 1,1,1\n0,wheel 1,1,1\n",
            "log.csv:3: `wheel 1` has two rows",
        ),
        ("time_s,wheel,current_a,wheel_speed_rad_s\n0,wheel 1,,1\n", "no row has both"),
        ("time_s,wheel,current_a,wheel_speed_rad_s\n0,wheel 1,x,1\n", "it must be a number"),
    ] {
        let error = read(text).expect_err(text).to_string();
        assert!(error.contains(message), "{error}");
    }
}
