//! Advice after a drive: headings, looks at the slip, and test drives.

use grouser::document::{self, LoadedScenario, Overrides, Source};
use grouser::mission::{
    Leg as MissionLeg, LegOutcome, Limited, Manoeuvre, Mission, MissionRun, Sensors, Stop,
};
use grouser::simulation::{Approach, Numerics};
use grouser::studies::ensemble::Probability;
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::heading::HeadingStudy;
use grouser::studies::learn::advice::{
    AdviceSettings, Check, CheckSettings, DriveAdvice, SoilAhead, TestCost, TestDrive,
    TestSettings, WAY_AHEAD,
};
use grouser::studies::learn::{LearnSettings, Learner};
use grouser::studies::simulated_telemetry::SensorModels;
use grouser::terrain::surface::{Incline, Surface};
use grouser::terrain::{Ground, SoilZones, ZonePolygon};
use grouser::units::{Vec2, deg};
use rayon::prelude::*;

use super::drive::{Drive, RIM_SPEED, learner, scenario};
use super::truths;

const PRIOR: [&str; 2] = ["scenario.soil=toyoura-uncertain", "scenario.model=ishigami"];

/// The prior of an information study (theory, 13 f): all numbers on their own, with its relative
/// deviations.
const STUDY: &str = r#"
schema = "scenario/1"
name = "information study"
model = "ishigami"
soil = { schema = "soil/1", name = "sand", source = "test", priors = "none", cohesion_kpa = 0.0, friction_angle_deg = 38.0, density_kg_m3 = 1490.0, pressure_sinkage = { law = "reece", k_c = 0.0, k_phi = 122.7, n = 1.703 }, stress_peak = { a0 = 0.40, a1 = 0.15 }, shear = { law = "anisotropic", longitudinal_m = 0.036, longitudinal_per_rad_m = 0.043, lateral_m = 0.013, lateral_per_rad_m = 0.020 }, exit = { ratio = 0.5 }, bulldozing = { law = "sine" }, uncertainty = { parameter = [{ key = "friction_angle_deg", standard_deviation = 1.9 }, { key = "pressure_sinkage.k_phi", standard_deviation = 61.0, distribution = "lognormal" }, { key = "shear.longitudinal_m", standard_deviation = 0.018, distribution = "lognormal" }, { key = "shear.lateral_m", standard_deviation = 0.0065, distribution = "lognormal" }, { key = "exit.ratio", standard_deviation = 0.2 }] } }
"#;

fn study_of_information() -> LoadedScenario {
    let source = Source::text("the study", STUDY);
    document::read_scenario(&source, &Overrides::none()).unwrap()
}

/// Legs of one metre: on level ground, and along the contour, at 45° and straight up and down 5°.
fn tests() -> TestSettings {
    TestSettings::on_slopes(&[0.0, deg(5.0)], 1.0)
}

/// Usual settings over few ways.
fn settings() -> AdviceSettings {
    let usual = AdviceSettings::usual(RIM_SPEED, tests());
    AdviceSettings { checks: CheckSettings { ways: 250, ..usual.checks }, ..usual }
}

fn samples(learner: &Learner, seed: u64) -> Vec<Sample> {
    learner.samples(seed, 40).unwrap().into_iter().map(|it| it.sample).collect()
}

fn advice(learner: &Learner, slopes_deg: &[f64], settings: &AdviceSettings) -> DriveAdvice {
    let slopes: Vec<f64> = slopes_deg.iter().map(|slope| deg(*slope)).collect();
    let samples = samples(learner, settings.seed);
    let band = learner.predict(&samples, &slopes, &|| true).unwrap().unwrap();
    learner.advice(&samples, &band, settings, &|| true).unwrap().expect("not stopped")
}

/// The usual settings without test drives.
fn without_tests() -> AdviceSettings {
    AdviceSettings { tests: TestSettings { legs: Vec::new(), ..tests() }, ..settings() }
}

/// On level ground the nose goes along the way, nobody gets stuck, and looks are as far apart as
/// they may be. Where none may get stuck at all, no look is safe enough: none of a thousand is not
/// yet never.
#[test]
fn level_ground_needs_few_looks() {
    let learner = learner(&scenario(&PRIOR));
    let few = CheckSettings { stuck_probability: 0.02, ..without_tests().checks };
    let found = advice(&learner, &[0.0], &AdviceSettings { checks: few, ..without_tests() });
    let slope = &found.slopes[0];
    let heading = slope.heading.advised.expect("a heading");
    assert!(heading.yaw.abs() < 1e-6 && heading.within.estimate() == 1.0, "{heading:?}");
    let check = slope.check.expect("looks");
    assert_eq!((check.check.map(|it| it.every), check.unchecked.successes), (Some(5.0), 0));
    assert_eq!(slope.rim_speed, Some(RIM_SPEED));
    // Nothing but test drives is left out.
    assert_eq!((found.tests.legs.len(), found.tests.chosen.len()), (0, 0));
    let never = CheckSettings { stuck_probability: 0.0, ..without_tests().checks };
    let never = AdviceSettings { checks: never, ..without_tests() };
    let found = advice(&learner, &[0.0], &never);
    assert_eq!(found.slopes[0].check.expect("looks").check, None);
}

/// The less often a rover may get stuck, the shorter the interval; and odometry that takes its time
/// slows the rover down.
#[test]
fn stricter_probabilities_have_shorter_intervals() {
    let learner = learner(&scenario(&PRIOR));
    let mut before = f64::INFINITY;
    let mut seen = Vec::new();
    for stuck_probability in [0.6, 0.1, 0.01] {
        let checks = CheckSettings { stuck_probability, ..without_tests().checks };
        let settings = AdviceSettings { checks, look_time: 20.0, ..without_tests() };
        let slope = advice(&learner, &[17.0], &settings).slopes[0].clone();
        let check = slope.check.expect("looks");
        let (unchecked, every) = (check.unchecked, check.check.map_or(0.0, |it| it.every));
        assert!(every <= before, "{stuck_probability}: {check:?}");
        if let Some(check) = check.check {
            assert!(check.stuck.interval().1 <= stuck_probability);
            assert!(check.stuck.successes <= unchecked.successes);
            assert!(slope.rim_speed.unwrap() * 20.0 <= every + 1e-12);
        }
        before = every;
        seen.push(every);
    }
    println!("{seen:?}");
    assert!(seen[0] > seen[2], "{seen:?}");
}

/// A stricter limit of slip turns the steepest heading downhill, until there is none.
#[test]
fn no_such_heading_is_a_value() {
    let learner = learner(&scenario(&PRIOR));
    let mut steepest = f64::INFINITY;
    for (slip_ratio, exists) in [(0.6, true), (0.3, true), (0.15, true), (0.0, false)] {
        let mut settings = without_tests();
        settings.limits.slip_ratio = slip_ratio;
        // No ways: what is asked for here is the heading alone.
        settings.checks.ways = 1;
        let heading = advice(&learner, &[10.0], &settings).slopes[0].heading.clone();
        let contour = heading.contour.expect("some hold it");
        assert_eq!(heading.steepest.is_some(), exists, "{slip_ratio}: {heading:?}");
        let Some(here) = heading.steepest else {
            assert_eq!(heading.advised, None);
            continue;
        };
        assert!(here <= steepest, "{slip_ratio}: {heading:?}");
        steepest = here;
        let advised = heading.advised.expect("a heading");
        assert!((advised.yaw - contour.median.min(here)).abs() < 1e-12);
        assert!(advised.within.estimate() >= 0.8, "{slip_ratio}: {advised:?}");
    }
}

fn left(drive: &TestDrive, key: &str) -> f64 {
    drive.left.iter().find(|it| it.0 == key).expect("a key").1
}

fn leg(drives: &[TestDrive], slope: f64, yaw: f64) -> &TestDrive {
    let is_it = |it: &&TestDrive| {
        (it.leg.slope - deg(slope)).abs() < 1e-9 && (it.leg.yaw - deg(yaw)).abs() < 1e-9
    };
    drives.iter().find(is_it).expect("a leg")
}

/// Source: theory, 13 (f). Level ground tells nothing of K_y, legs along the contour tell most of
/// it, and legs uphill tell most of K_x.
#[test]
fn legs_tell_what_the_information_study_says() {
    let learner = learner(&study_of_information());
    let found = advice(&learner, &[8.0], &settings_of_tests());
    let drives = &found.tests.legs;
    let (along, lateral) = ("shear.longitudinal_m", "shear.lateral_m");
    for drive in drives {
        println!(
            "{:?} {:.3} nat {:.2?} {:.2?}",
            drive.leg,
            drive.information,
            drive.widths.map(f64::to_degrees),
            drive.left
        );
    }
    let [level, contour, uphill] =
        [leg(drives, 0.0, 0.0), leg(drives, 5.0, 0.0), leg(drives, 5.0, 90.0)];
    assert!(left(level, lateral) > 0.97);
    assert!(left(contour, lateral) < 0.8 && left(contour, lateral) < left(uphill, lateral));
    assert!(left(uphill, along) < left(contour, along) && left(uphill, along) < left(level, along));
    // Each leg that is chosen narrows what the one before it left.
    let chosen = &found.tests.chosen;
    assert!(!chosen.is_empty());
    for drive in chosen {
        assert!(drive.widths[1] < drive.widths[0] && drive.information > 0.0, "{drive:?}");
    }
    for pair in chosen.windows(2) {
        assert!((pair[0].widths[1] - pair[1].widths[0]).abs() < 1e-12);
    }
    // The first is the best for its work.
    assert!(drives.windows(2).all(|pair| pair[0].per_cost >= pair[1].per_cost));
}

/// The usual settings without ways: test drives alone.
fn settings_of_tests() -> AdviceSettings {
    let mut settings = settings();
    settings.checks.ways = 1;
    settings
}

/// There is no learner, and so no advice on test drives, of a soil that is known; and a leg that
/// was driven for as long as it tells anything is not advised again.
#[test]
fn nothing_is_to_be_learnt_of_what_is_known() {
    let exact = scenario(&["scenario.soil=toyoura", "soil.priors=none", "scenario.model=ishigami"]);
    assert!(Learner::new(&exact, false, LearnSettings::USUAL).is_err());
    let mut settings = settings_of_tests();
    settings.tests = TestSettings::on_slopes(&[0.0], 100.0);
    settings.tests.cost = TestCost::Way;
    let found = advice(&learner(&scenario(&PRIOR)), &[8.0], &settings);
    assert_eq!(found.tests.chosen.len(), 1, "{:?}", found.tests);
    let drive = &found.tests.chosen[0];
    assert!((drive.per_cost - drive.information / 100.0).abs() < 1e-12);
}

/// The learner after a leg of a metre on a hidden soil.
fn driven(prior: &LoadedScenario, drive: &TestDrive, truth: u32) -> Option<Learner> {
    let truth = truths(prior, 91, truth + 1).pop().expect("one at least");
    let truth = &truth;
    let mut twin = Drive::new(prior, truth);
    twin.leg((drive.leg.slope.to_degrees(), drive.leg.yaw.to_degrees(), drive.leg.way))?;
    let mut learner = learner(prior);
    for record in twin.seen(SensorModels::USUAL, truth_seed(truth)) {
        learner.update(record);
    }
    learner.finish();
    Some(learner)
}

fn truth_seed(truth: &Sample) -> u64 {
    truth.soil.friction_angle.to_bits()
}

/// Mean of what is left of the lower half of the heading's band after a leg on hidden soils, over
/// that before.
fn narrowed(prior: &LoadedScenario, drive: &TestDrive, count: u32) -> f64 {
    let width = |learner: &Learner| {
        let samples = samples(learner, 5);
        let found = learner.predict(&samples, &[deg(8.0)], &|| true).unwrap().unwrap();
        let yaw = found.slopes[0].yaw.expect("samples");
        // The upper end may be above every number: what is wide below the median is so above it.
        yaw.median - yaw.low
    };
    let before = width(&learner(prior));
    let after: Vec<f64> = (0..count)
        .into_par_iter()
        .filter_map(|truth| driven(prior, drive, truth).map(|it| width(&it)))
        .collect();
    after.iter().sum::<f64>() / after.len() as f64 / before
}

/// What legs are expected to leave of the heading's band is in the order of what simulated drives
/// leave of it.
fn check_order(count: u32, legs: &[(f64, f64)]) {
    let prior = study_of_information();
    let found = advice(&learner(&prior), &[8.0], &settings_of_tests());
    let pairs: Vec<[f64; 2]> = legs
        .iter()
        .map(|(slope, yaw)| {
            let drive = leg(&found.tests.legs, *slope, *yaw);
            let expected = drive.widths[1] / drive.widths[0];
            let seen = narrowed(&prior, drive, count);
            println!("{slope}° {yaw}°: expected {expected:.3}, seen {seen:.3}");
            [expected, seen]
        })
        .collect();
    for pair in pairs.windows(2) {
        assert!(pair[0][0] < pair[1][0] && pair[0][1] < pair[1][1], "{pairs:?}");
    }
}

#[test]
fn expected_bands_are_in_the_order_of_simulated_ones() {
    check_order(3, &[(5.0, 0.0), (0.0, 0.0)]);
}

#[test]
#[ignore = "minutes"]
fn expected_bands_are_in_the_order_of_many_simulated_ones() {
    check_order(30, &[(5.0, 0.0), (5.0, 45.0), (0.0, 0.0)]);
}

// ---- Looks at the slip, by other simulations ----

/// A slope and the looks that are advised there.
fn looks(learner: &Learner, slope_deg: f64, stuck_probability: f64) -> (f64, Check) {
    let checks = CheckSettings { stuck_probability, ways: 500, ..CheckSettings::USUAL };
    let found = advice(learner, &[slope_deg], &AdviceSettings { checks, ..without_tests() });
    let slope = &found.slopes[0];
    let check = slope.check.and_then(|it| it.check);
    (slope.heading.advised.expect("a heading").yaw, check.expect("looks that are safe enough"))
}

/// The whole number next to a place.
fn place_at(place: f64) -> usize {
    (0..1000).position(|whole| f64::from(whole) >= place - 0.5).expect("it is on the way")
}

/// Whether a rover gets stuck on soils that no advice has seen, looked at ten times as often as the
/// advice does.
fn gets_stuck(
    study: &HeadingStudy,
    learner: &Learner,
    (slope, yaw): (f64, f64),
    check: Check,
    way: u64,
) -> bool {
    const STEP: f64 = 0.1;
    let places = place_at(WAY_AHEAD / STEP);
    let each = place_at(check.every / STEP);
    // Over the ground it goes less far than its rims: soils are looked up by the way over the
    // ground.
    let soils = learner.soils_ahead(SoilAhead::USUAL, (4711, way), &vec![STEP; places]).unwrap();
    let (mut ground, mut since) = (0.0, 0.0);
    for place in 0..places {
        let soil = &soils[place_at(ground / STEP).min(places)];
        let motion = study.of_sample(soil).steady_motion(slope, yaw, RIM_SPEED).ok();
        let slip = motion.map_or(1.0, |it| it.slip_ratio());
        if slip > 0.9 {
            return true;
        }
        ground += STEP * (1.0 - slip);
        since += STEP * (1.0 - slip);
        if (place + 1) % each == 0 {
            if 1.0 - since / check.every > check.limit {
                return false;
            }
            since = 0.0;
        }
    }
    false
}

/// Checks that at most as many rovers get stuck as is asked for, within the error of so few.
fn check_looks(slope_deg: f64, stuck_probability: f64, ways: usize) {
    let prior = scenario(&PRIOR);
    let learner = learner(&prior);
    let (yaw, check) = looks(&learner, slope_deg, stuck_probability);
    let study = HeadingStudy::of(&prior.value);
    let stuck = (0..ways)
        .into_par_iter()
        .filter(|way| gets_stuck(&study, &learner, (deg(slope_deg), yaw), check, *way as u64))
        .count();
    let found = Probability { successes: stuck, trials: ways };
    println!("{slope_deg}°: {check:?}; {stuck} of {ways} stuck");
    assert!(found.interval().0 <= stuck_probability, "{check:?} {found:?}");
    assert!(check.stuck.interval().1 <= stuck_probability);
}

#[test]
fn few_get_stuck_with_the_looks_that_are_advised() {
    check_looks(10.0, 0.03, 100);
}

#[test]
#[ignore = "minutes"]
fn few_of_two_thousand_get_stuck_with_the_looks_that_are_advised() {
    for (slope, probability) in [(8.0, 0.02), (10.0, 0.03), (12.0, 0.1)] {
        check_looks(slope, probability, 2000);
    }
}

/// A mission over strips of soil that wander along the way, with looks at the slip.
fn mission(
    prior: &LoadedScenario,
    learner: &Learner,
    course: (f64, f64),
    check: Check,
    way: u64,
) -> Mission {
    const STRIP: f64 = 0.1;
    let (slope, yaw) = course;
    let count = place_at(WAY_AHEAD / STRIP) + 10;
    let soils = learner.soils_ahead(SoilAhead::USUAL, (815, way), &vec![STRIP; count - 1]).unwrap();
    let strip = |place: usize| {
        let [from, to] = [place, place + 1].map(|it| STRIP * it as f64);
        // The first begins behind the rover.
        let from = if place == 0 { -5.0 } else { from };
        let corners = [(from, -9.0), (to, -9.0), (to, 9.0), (from, 9.0)];
        ZonePolygon {
            soil: Some(place),
            rings: vec![corners.map(|(x, y)| Vec2::new(x, y)).to_vec()],
        }
    };
    let polygons: Vec<ZonePolygon> = (0..count).map(strip).collect();
    let zones =
        SoilZones::from_polygons(&polygons, soils.iter().map(|it| it.soil).collect()).unwrap();
    let mut scenario = prior.value.clone();
    let incline = Incline { slope, uphill: deg(90.0) };
    scenario.ground =
        Ground::formula(scenario.ground.soil, Surface::Incline(incline)).with_zones(zones);
    scenario.numerics = Numerics { approach: Approach::QuasiSteady, ..scenario.numerics };
    let stop = Stop { over: check.every, ..Stop::above(Limited::SlipRatio, check.limit) };
    let leg = MissionLeg {
        yaw: Some(yaw),
        stops: vec![stop],
        ..MissionLeg::new(Manoeuvre::drive(WAY_AHEAD))
    };
    let sensors = Sensors {
        heading_deviation: 0.0,
        heading_interval: 1.0,
        heading_delay: 0.0,
        odometry_deviation: CheckSettings::USUAL.odometry_error,
        odometry_interval: check.every,
        seed: way,
    };
    Mission { scenario, legs: vec![leg], stops: Vec::new(), sensors: Some(sensors) }
}

/// The same by missions: their engine has its own limits on slip over a way, odometry and judgement
/// of what is stuck.
#[test]
#[ignore = "minutes"]
fn few_missions_get_stuck_with_the_looks_that_are_advised() {
    let prior = scenario(&PRIOR);
    let learner = learner(&prior);
    let (slope, probability, ways) = (10.0, 0.03, 300_usize);
    let (yaw, check) = looks(&learner, slope, probability);
    let stuck = (0..ways)
        .into_par_iter()
        .filter(|way| {
            let plan = mission(&prior, &learner, (deg(slope), yaw), check, *way as u64);
            let report = MissionRun::new(&plan).expect("a mission").to_end().expect("it drives");
            matches!(report.legs[0].outcome, LegOutcome::Ended(_))
        })
        .count();
    let found = Probability { successes: stuck, trials: ways };
    println!("{slope}°: {check:?}; {stuck} of {ways} missions stuck");
    assert!(found.interval().0 <= probability, "{check:?} {found:?}");
}
