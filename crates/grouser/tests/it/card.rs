//! The operator's card: its numbers, its bands and its verdicts.

use grouser::document::{self, LoadedScenario, Overrides, Source};
use grouser::simulation::{Approach, Motion, Scenario, Start};

use grouser::soil::{SlopeStability, Soil};
use grouser::studies::card::courses::{Course, CourseRow};
use grouser::studies::card::drives::{CardDrives, RowDrives};
use grouser::studies::card::{Card, CardRow};
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::studies::ensemble::{Band, Probability};
use grouser::studies::heading::{HeadingCurve, HeadingStudy};
use grouser::studies::verdict::{
    Judgement, Reason, Rule, SLIDES_ON_NO_GO, STUCK_ON_GO, SlopeStudy, Verdict,
};
use grouser::terrain::Ground;
use grouser::units::{EARTH_GRAVITY, MOON_GRAVITY, deg};
use grouser::vehicle::{DriveLaw, Rover};

use super::given;

const SEED: u64 = 7;

fn scenario() -> LoadedScenario {
    let mut overrides = Overrides::none();
    overrides.flag_text("--soil", "scenario.soil", "toyoura-uncertain").expect("it is a key");
    document::read_scenario(&Source::default_scenario(), &overrides).expect("a preset")
}

fn study() -> SlopeStudy {
    let heading = HeadingStudy::of(&scenario().value);
    let (rim_speed, rule) = (given::RIM_SPEED, Rule::DEFAULT);
    SlopeStudy { heading, rim_speed, rule, is_uncertainty_stated: true, holds_heading: false }
}

fn soils(count: u64) -> Vec<Soil> {
    let uncertain = scenario().uncertain.expect("it says so");
    (0..count).map(|index| uncertain.draw(SEED, index).expect("it can be drawn")).collect()
}

fn slopes(to: u32) -> Vec<f64> {
    (0..=to).map(|degree| deg(f64::from(degree))).collect()
}

fn card(study: &SlopeStudy, soils: &[Soil], slopes: &[f64]) -> Card {
    let sample = |soil: &Soil| Sample { soil: *soil, model: study.heading.model.clone() };
    let samples: Vec<Sample> = soils.iter().map(sample).collect();
    let card = study.card(&samples, slopes, &|| true);
    card.expect("rule, slopes and soils are in order").expect("not stopped")
}

/// Largest torques become largest currents by the motor's closed form; without motors there are
/// none.
#[test]
fn a_card_of_a_rover_with_motors_has_their_currents() {
    use super::motors::MOTOR;
    let slopes = [deg(5.0), deg(10.0)];
    let mut study = study();
    let plain = card(&study, &soils(4), &slopes);
    let table = grouser::document::columns::card::table;
    assert!(table(&plain).column("current_a_p50").is_none());
    let mut parts = study.heading.rover.parts().clone();
    parts.wheel_unit.motor = Some(MOTOR);
    study.heading.rover = Rover::draft(parts).checked().expect("a rover");
    let motors = card(&study, &soils(4), &slopes);
    for (row, without) in motors.rows.iter().zip(&plain.rows) {
        let motion = |row: &CardRow| row.advice.driven.and_then(|it| it.motion).expect("it moves");
        let (torque, current) = (motion(row).torque.expect("a band"), motion(row).current);
        assert_eq!(motion(without).torque, Some(torque));
        assert_eq!(motion(without).current, None);
        let current = current.expect("a band");
        let pairs = [
            (torque.low, current.low),
            (torque.median, current.median),
            (torque.high, current.high),
        ];
        for (torque, current) in pairs {
            let expected = (torque / (250.0 * 0.6) + 1e-3) / 0.010;
            assert!((current / expected - 1.0).abs() < 1e-12, "{current} A, {expected} A");
        }
    }
    let table = table(&motors);
    let names: Vec<&str> = table.columns.iter().map(|(name, _)| &**name).collect();
    let place = names.iter().position(|name| *name == "torque_nm_p97_5").expect("a column");
    assert_eq!(names[place + 1], "current_a_p2_5");
}

// ---- What a rover does that is not turned uphill ----

/// The run in time of a rover that starts with its nose on the contour knows nothing of the card.
/// In a second its yaw moment turns it a little.
#[test]
fn drift_is_that_of_a_run_with_the_nose_on_the_contour() {
    let drift = study().heading.drift_curve().expect("sand");
    for slope in [3.0, 10.0, 16.0].map(deg) {
        let held = drift.at(slope).expect("it is held");
        let run = given::run(&Scenario { duration: 1.0, ..given::traverse(slope, 0.0) });
        let (first, last) = (run.records[5].state.position, run.last().state.position);
        let way = (last.x - first.x).hypot(last.y - first.y);
        let drifted = (first.y - last.y) / way;
        assert!((held.drift() - drifted).abs() < 2e-3, "{} and {drifted}", held.drift());
        let slip = run.last().wheels[0].reaction.slip.ratio;
        assert!((held.slip_ratio - slip).abs() < 5e-3, "{} and {slip}", held.slip_ratio);
    }
}

/// With the nose on the contour the soil pushes uphill with all of the weight's share, and not
/// forward.
#[test]
fn drift_balances_the_pull_of_the_slope() {
    let study = study();
    let drift = study.heading.drift_curve().expect("sand");
    let weight = study.heading.rover.mass() * study.heading.gravity;
    for attitude in drift.headings() {
        let forces = attitude.wheels.iter().map(|wheel| wheel.settled.forces);
        let (pull, side) =
            forces.fold((0.0, 0.0), |(x, y), f| (x + f.drawbar_pull, y + f.side_force));
        // The correction ends at 1e-10 of the weight.
        assert!(pull.abs() < 1e-9 * weight, "{pull}");
        assert!((side - weight * attitude.slope.sin()).abs() < 1e-9 * weight);
        assert!(attitude.yaw == 0.0 && attitude.drift() >= 0.0);
    }
}

// ---- Bands ----

#[test]
fn soils_that_do_not_differ_have_no_band() {
    let study = study();
    let card = card(&study, &vec![study.heading.soil; 4], &slopes(22));
    for row in &card.rows {
        let bands = row.bands.expect("soils were drawn");
        let exactly = |value: Option<f64>| value.map(|v| Band { low: v, median: v, high: v });
        // Above every number where no heading holds the contour.
        let yaw = row.level.map_or(f64::INFINITY, |level| level.yaw);
        assert_eq!(row.advice.yaw, exactly(Some(yaw)));
        let slip = row.level.map_or(1.0, |level| level.slip_ratio);
        assert_eq!(bands.slip_ratio, exactly(Some(slip)));
        assert_eq!(bands.power, exactly(row.level.map(|level| level.power)));
        assert_eq!(bands.drift, exactly(Some(row.drift.unwrap_or(1.0))));
        let successes = if row.level.is_some() { 4 } else { 0 };
        assert_eq!(row.advice.level, Probability { successes, trials: 4 });
    }
}

/// The means of the uncertain values make a soil in the middle of the others.
#[test]
fn the_band_contains_the_curve_of_the_mean_soil() {
    let card = card(&study(), &soils(120), &slopes(14));
    for row in &card.rows[1..] {
        let (bands, level) = (row.bands.expect("drawn"), row.level.expect("not steep"));
        let inside = |band: Option<Band>, value: f64| {
            let band = band.expect("not steep");
            band.low < value && value < band.high
        };
        assert!(inside(row.advice.yaw, level.yaw), "{row:?}");
        assert!(inside(bands.slip_ratio, level.slip_ratio), "{row:?}");
        assert!(inside(bands.power, level.power), "{row:?}");
        assert!(inside(bands.drift, row.drift.expect("not steep")), "{row:?}");
    }
}

#[test]
fn without_stated_uncertainty_there_is_no_band() {
    let card = card(&study(), &[], &slopes(22));
    assert_eq!((card.draws, card.limit_band), (None, None));
    assert!(card.rows.iter().all(|row| row.bands.is_none()));
}

/// The large number of the page: counted here one by one, a soil on which no heading holds the
/// contour above all.
#[test]
fn the_cards_heading_is_the_median_over_all_samples() {
    let (study, soils) = (study(), soils(41));
    let card = card(&study, &soils, &slopes(26));
    let curve = |soil: &Soil| {
        HeadingStudy { soil: *soil, ..study.heading.clone() }.curve().expect("the soil is valid")
    };
    let curves: Vec<_> = soils.iter().map(curve).collect();
    let mut without = 0;
    for row in &card.rows {
        let of = |it: &HeadingCurve| it.at(row.advice.slope).map_or(f64::INFINITY, |held| held.yaw);
        let mut yaws: Vec<f64> = curves.iter().map(of).collect();
        yaws.sort_by(f64::total_cmp);
        let expected = Some(yaws[20]).filter(|yaw| yaw.is_finite());
        assert_eq!(row.advice.heading(), expected, "{row:?}");
        without += usize::from(expected.is_none());
    }
    assert!(without > 0, "every slope has a heading in half of the samples");
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let soils = soils(16);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads can be started").install(|| card(&study(), &soils, &slopes(20)))
    };
    assert_eq!(on(1), on(2));
}

// ---- Left and right ----

/// In a mirror, left is right: the rover with its uphill side on the other side needs the same
/// heading. Sums over wheels in another order differ by rounding.
#[test]
fn a_mirrored_traverse_has_the_mirrored_heading() {
    let study = study();
    let mut mirrored = study.clone();
    mirrored.heading.rover = study.heading.rover.mirrored();
    assert!(study.heading.rover.is_symmetric());
    assert_eq!(mirrored.heading.rover.mirrored(), study.heading.rover);
    let (one, other) = (card(&study, &[], &slopes(19)), card(&mirrored, &[], &slopes(19)));
    for (one, other) in one.rows.iter().zip(&other.rows) {
        let (level, image) = (one.level.expect("not steep"), other.level.expect("not steep"));
        assert!(
            (level.yaw - image.yaw).abs() < 1e-8 && one.advice.judgement == other.advice.judgement
        );
    }
}

/// A rover with more of its weight on its left wheels is another one in the mirror, and needs
/// another heading.
#[test]
fn a_lopsided_rover_has_two_cards() {
    let hubs = [(0.19, 0.20), (-0.17, 0.20), (-0.17, -0.28), (0.19, -0.28)];
    let rover = given::rover_on(given::hakuto_wheel(), &hubs);
    assert!(!rover.is_symmetric());
    let yaw = |rover| {
        let heading = HeadingStudy { rover, ..study().heading };
        let card = card(&SlopeStudy { heading, ..study() }, &[], &[deg(12.0)]);
        card.rows[0].level.expect("not steep").yaw
    };
    assert!((yaw(rover.mirrored()) - yaw(rover)).abs() > deg(0.01));
}

// ---- Verdicts ----

fn verdict(row: &CardRow) -> Verdict {
    row.advice.judgement.verdict
}

/// A verdict depends on its slope alone; on this rover and sand none is better than on a gentler
/// slope, and corrections, looks at the slip and its limit are never laxer.
#[test]
fn a_steeper_slope_is_never_better() {
    for soils in [Vec::new(), soils(40)] {
        let card = card(&study(), &soils, &slopes(30));
        assert!(card.rows.windows(2).all(|pair| verdict(&pair[0]) <= verdict(&pair[1])));
        let motions = card.rows.iter().filter_map(|row| row.advice.driven.as_ref()?.motion);
        let asked: Vec<[f64; 3]> = motions
            .map(|motion| {
                let check = motion.slip_check;
                [-motion.correct_every.unwrap_or(0.0), -check.every.unwrap_or(0.0), check.limit]
            })
            .collect();
        assert!(asked.len() > 5, "{asked:?}");
        let is_stricter = |pair: &[[f64; 3]]| (0..3).all(|place| pair[0][place] <= pair[1][place]);
        assert!(asked.windows(2).all(is_stricter), "{asked:?}");
        assert_eq!(verdict(&card.rows[0]), Verdict::Go);
        assert_eq!(verdict(&card.rows[30]), Verdict::NoGo);
        assert!(card.rows.iter().any(|row| verdict(row) == Verdict::Caution));
    }
}

/// Verdicts and reasons follow from the samples and the rule, counted here one by one.
#[test]
fn verdicts_are_the_rules() {
    let (study, soils) = (study(), soils(40));
    let card = card(&study, &soils, &slopes(24));
    let slips = |slope: f64| {
        let slip = |soil: &Soil| {
            let heading = HeadingStudy { soil: *soil, ..study.heading.clone() };
            heading.curve().expect("sand").at(slope).ok().map(|level| level.slip_ratio)
        };
        soils.iter().map(slip).collect::<Vec<Option<f64>>>()
    };
    let rule = Rule::DEFAULT;
    let mut reasons = Vec::new();
    for row in &card.rows {
        let slips = slips(row.advice.slope);
        let within = |most: f64| slips.iter().flatten().filter(|slip| **slip <= most).count();
        let share = |count: usize| count as f64 / 40.0;
        let failing = share(40 - within(rule.no_go_slip_ratio));
        let motion = row.advice.driven.and_then(|driven| driven.motion);
        let stuck = motion.map_or(0.0, |it| it.stuck.estimate().max(it.slip_check.stuck));
        let is_free = stuck <= STUCK_ON_GO;
        let drift = motion.and_then(|it| it.drift).map_or(1.0, |drift| drift.high);
        let slides = motion.is_some_and(|it| it.slides.estimate() >= SLIDES_ON_NO_GO);
        let own = match () {
            () if failing >= rule.no_go_probability => (Verdict::NoGo, Reason::ShareThatHolds),
            () if motion.is_none() => (Verdict::NoGo, Reason::HeadingFalls),
            () if stuck >= rule.no_go_probability => (Verdict::NoGo, Reason::Stuck),
            () if slides => (Verdict::NoGo, Reason::Slides),
            () if share(within(rule.go_slip_ratio)) < rule.go_probability => {
                (Verdict::Caution, Reason::ShareThatHolds)
            }
            () if !is_free => (Verdict::Caution, Reason::Stuck),
            () if drift > rule.go_drift_m_per_m => (Verdict::Caution, Reason::Drift),
            () => (Verdict::Go, Reason::AllMet),
        };
        println!("{:.0}° {:?}", row.advice.slope.to_degrees(), row.advice.judgement);
        // In half of the samples no heading holds the contour: that is said first.
        let own =
            if row.advice.driven.is_none() { (Verdict::NoGo, Reason::NoHeading) } else { own };
        let Judgement { verdict, reason, .. } = row.advice.judgement;
        assert_eq!((verdict, reason), own, "{row:?}");
        reasons.push(reason);
    }
    for reason in [Reason::AllMet, Reason::Drift, Reason::ShareThatHolds] {
        assert!(reasons.contains(&reason), "{reasons:?}");
    }
}

/// Slopes near the friction angle are a question of strength, not of slip: cohesion holds a slab,
/// and nobody knows for how long. On the Moon the wheels of a cohesive soil would go farther.
#[test]
fn no_slope_near_the_friction_angle_is_a_go() {
    let mut would_go = 0;
    for (cohesion, gravity) in [(0.0, EARTH_GRAVITY), (800.0, MOON_GRAVITY), (20e3, MOON_GRAVITY)] {
        for friction_angle in [28.0, 38.0].map(deg) {
            let mut study = study();
            study.heading.gravity = gravity;
            study.heading.soil = Soil { friction_angle, cohesion, ..study.heading.soil };
            let card = card(&study, &[], &slopes(50));
            let usual = study.heading.soil.stable_slope(gravity, SlopeStability::USUAL);
            let steepest = usual.min(friction_angle - deg(5.0));
            for row in card.rows.iter().filter(|row| row.advice.slope >= steepest + deg(1e-9)) {
                assert_eq!(verdict(row), Verdict::NoGo, "{row:?}");
                let slip = row.level.map_or(1.0, |level| level.slip_ratio);
                would_go += usize::from(slip <= Rule::DEFAULT.go_slip_ratio);
            }
        }
    }
    assert!(would_go > 0, "slip alone decides");
}

#[test]
fn without_a_stated_uncertainty_nobody_can_tell() {
    let stated = study();
    let unstated = SlopeStudy { is_uncertainty_stated: false, ..stated.clone() };
    for soils in [Vec::new(), soils(8)] {
        let verdicts =
            |study| card(study, &soils, &slopes(24)).rows.iter().map(verdict).collect::<Vec<_>>();
        let (with, without) = (verdicts(&stated), verdicts(&unstated));
        let expected: Vec<Verdict> = with.iter().map(|it| *it.max(&Verdict::CannotTell)).collect();
        assert_eq!(without, expected);
        assert!(with.contains(&Verdict::Go));
    }
}

// ---- Driven as the card says ----

/// Drift grows with how far the nose is from a soil's own heading, so that the median is the heading
/// with the least drift on the mean, up or down.
#[test]
fn no_other_heading_drifts_much_less() {
    let (study, soils) = (study(), soils(60));
    for slope in [5.0, 10.0, 14.0].map(deg) {
        let heading = card(&study, &soils, &[slope]).rows[0].advice.heading().expect("not steep");
        let drift = |yaw: f64| {
            let one = |soil: &Soil| {
                let study = HeadingStudy { soil: *soil, ..study.heading.clone() };
                let motion = study.steady_motion(slope, yaw, given::RIM_SPEED);
                motion.map_or(1.0, |it| it.course().sin().abs())
            };
            soils.iter().map(one).sum::<f64>() / soils.len() as f64
        };
        let beside = (-6..=6_i8).map(|step| drift(heading + deg(0.5 * f64::from(step))));
        let least = beside.fold(f64::INFINITY, f64::min);
        let (own, slope) = (drift(heading), slope.to_degrees());
        println!("{slope}°: {own:.4} by the median, {least:.4} at the least");
        assert!(own <= 1.03 * least, "{slope}°: {own} and {least}");
    }
}

/// Roll, pitch, slope and heading are two angles seen twice.
#[test]
fn instruments_show_the_slope_and_the_heading() {
    let card = card(&study(), &[], &slopes(19));
    for row in &card.rows {
        let driven = row.advice.driven.expect("not steep");
        let upright = driven.roll.cos() * driven.pitch.cos();
        assert!((upright - row.advice.slope.cos()).abs() < 1e-12);
        assert!((driven.pitch.sin() - row.advice.slope.sin() * driven.yaw.sin()).abs() < 1e-12);
        assert!(driven.tipping_margin > 0.0 && driven.roll <= row.advice.slope + 1e-12);
    }
}

/// The run in time of a rover whose nose is set knows nothing of the card: on the soil as written
/// its nose falls as the card says, by 2° at most until it is set again, and it drifts as the card
/// says.
#[test]
fn a_run_with_the_nose_set_again_drifts_as_the_card_says() {
    let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none());
    let scenario = scenario.expect("the default").value;
    let heading = HeadingStudy::of(&scenario);
    let study = SlopeStudy { heading, ..study() };
    for row in card(&study, &[], &[6.0, 13.0, 18.0].map(deg)).rows {
        let driven = row.advice.driven.expect("not steep");
        let motion = driven.motion.expect("it moves");
        let duration = motion.correct_every.expect("a driver corrects") / given::RIM_SPEED;
        let ground = Ground::plane(study.heading.soil, row.advice.slope);
        let gravity = study.heading.gravity;
        let start = Start { yaw: driven.yaw, motion: Motion::Rolling };
        let run = given::run(&Scenario { ground, gravity, start, duration, ..scenario.clone() });
        let (first, last) = (&run.records[0].state, &run.last().state);
        let way = last.position - first.position;
        let drift = -way.y / way.x.hypot(way.y);
        let expected = motion.drift.expect("a sample").median;
        // The start's transient, and slip by which the way is shorter than the rims'.
        assert!((drift - expected).abs() < 0.01, "{drift} and {expected}");
        let fall = driven.yaw - last.yaw;
        assert!(fall > 0.0 && fall <= deg(2.1), "{}", fall.to_degrees());
    }
}

/// Drives other soils by rows of a card, in time; for each lateness and approach, by the same card.
///
/// * `otherwise`: what a soil really is
pub(crate) fn drives<const N: usize>(
    soils: u32,
    slopes_deg: &[f64],
    ways: [(f64, Approach); N],
    otherwise: impl Fn(Sample) -> Sample,
) -> [Vec<RowDrives>; N] {
    let inputs = BandInputs::of_scenario(&scenario());
    let samples = |seed, count| inputs.samples(seed, count).expect("the soils can be drawn");
    let slopes: Vec<f64> = slopes_deg.iter().map(|slope| deg(*slope)).collect();
    let study = study();
    let card = study.card(&samples(1, 200), &slopes, &|| true);
    let card = card.expect("all in order").expect("not stopped");
    let others: Vec<Sample> = samples(2, soils).into_iter().map(otherwise).collect();
    ways.map(|(lateness, approach)| {
        let drives = CardDrives { study: &study, lateness, approach, seed: 3 };
        let on = |row| {
            let driven = drives.on(row, &others, &|| ()).expect("runs").expect("it is driven");
            println!("{:.0}° {driven:?}", driven.slope.to_degrees());
            driven
        };
        card.rows.iter().map(on).collect()
    })
}

/// The drift that the card states holds in 95 % of the drives, and where it says go the rover gets
/// through.
fn check_drives(all: &[RowDrives]) {
    for drives in all {
        let slope = drives.slope.to_degrees();
        assert!(drives.within.estimate() >= 0.95, "{slope}°: {drives:?}");
        let most = if drives.verdict == Verdict::Go {
            STUCK_ON_GO
        } else {
            // Of so few drives the share may be as much above the card's.
            drives.stated_stuck.interval().1
        };
        assert!(drives.stuck.estimate() <= most, "{slope}°: {drives:?}");
    }
    let goes = all.iter().filter(|drives| drives.verdict == Verdict::Go).count();
    assert!(goes >= 3 && goes < all.len(), "{goes}");
}

/// Soils that the card has never seen, driven in time with the complete loads by a driver who sets
/// the heading to 2°.
#[test]
fn soils_that_are_driven_by_the_card_stay_within_its_drift() {
    let [all] = drives(60, &[1.0, 4.0, 8.0, 12.0, 15.0], [(1.0, Approach::QuasiSteady)], |it| it);
    check_drives(&all);
}

/// The same of a thousand soils on every slope of the page.
#[test]
#[ignore = "minutes"]
fn a_thousand_soils_that_are_driven_by_the_card_stay_within_its_drift() {
    let slopes: Vec<f64> = (1..18).map(f64::from).collect();
    let [all] = drives(1000, &slopes, [(1.0, Approach::QuasiSteady)], |it| it);
    check_drives(&all);
}

/// Quasi-steady drives end where dynamic ones do, to a thousandth of the way.
#[test]
fn quasi_steady_drives_drift_as_dynamic_ones() {
    let ways = [(1.0, Approach::QuasiSteady), (1.0, Approach::Dynamic)];
    let [steady, dynamic] = drives(6, &[4.0, 12.0], ways, |it| it);
    for (one, other) in steady.iter().zip(&dynamic) {
        let ends = |drives: &RowDrives| drives.drift.map(|it| [it.low, it.median, it.high]);
        let (one, other) = (ends(one).expect("drives"), ends(other).expect("drives"));
        for (one, other) in one.iter().zip(other) {
            assert!((one - other).abs() < 1e-3, "{one} and {other}");
        }
    }
}

/// Twice the way between corrections, twice the fall of the nose: the drift goes up.
#[test]
fn a_driver_who_corrects_late_drifts_more() {
    let [on_time, late] =
        drives(30, &[2.0, 8.0], [1.0, 3.0].map(|it| (it, Approach::QuasiSteady)), |it| it);
    for (on_time, late) in on_time.iter().zip(&late) {
        let high = |drives: &RowDrives| drives.drift.expect("drives").high;
        assert!(high(late) > high(on_time) + 1e-3, "{late:?}");
        assert!(late.within.successes <= on_time.within.successes);
    }
}

#[test]
fn a_rule_without_order_is_refused() {
    let slips = Rule { go_slip_ratio: 0.7, ..Rule::DEFAULT };
    let shares = Rule { no_go_probability: 0.01, ..Rule::DEFAULT };
    let nothing = Rule { go_probability: f64::NAN, ..Rule::DEFAULT };
    for (rule, value) in [(slips, 0.7), (shares, 0.01)] {
        let study = SlopeStudy { rule, ..study() };
        assert_eq!(study.card(&[], &slopes(3), &|| true).expect_err("no order").value, value);
    }
    assert!(nothing.check().is_err());
    let falling = [deg(3.0), deg(2.0)];
    assert_eq!(study().card(&[], &falling, &|| true).expect_err("falling").value, deg(2.0));
}

// ---- The second page ----

/// The other courses of a card of forty samples.
fn courses(slopes_deg: &[f64]) -> Vec<CourseRow> {
    let inputs = BandInputs::of_scenario(&scenario());
    let samples = inputs.samples(1, 40).expect("the soils can be drawn");
    let slopes: Vec<f64> = slopes_deg.iter().map(|slope| deg(*slope)).collect();
    let study = study();
    let card = study.card(&samples, &slopes, &|| true);
    let card = card.expect("all in order").expect("not stopped");
    let courses = study.courses(&card.rows, &samples, &|| true).expect("all in order");
    let courses = courses.expect("not stopped");
    for row in &courses {
        println!("{:.0}° {row:?}", row.slope.to_degrees());
    }
    courses
}

fn on(courses: &[CourseRow], course: Course) -> Vec<CourseRow> {
    courses.iter().filter(|row| row.course == course).copied().collect()
}

#[test]
fn a_course_is_never_better_on_a_steeper_slope_and_slips_more_uphill() {
    let courses = courses(&[2.0, 5.0, 8.0, 10.0]);
    for course in Course::ALL {
        let rows = on(&courses, course);
        assert_eq!(rows.len(), 4);
        assert!(rows.windows(2).all(|pair| pair[0].judgement.verdict <= pair[1].judgement.verdict));
    }
    let slip = |row: &CourseRow| {
        row.motion.and_then(|motion| motion.slip_ratio).expect("it is driven").median
    };
    let slips = |course| on(&courses, course).iter().map(slip).collect::<Vec<f64>>();
    let (up, down) = (slips(Course::Up), slips(Course::Down));
    assert!(up.windows(2).all(|pair| pair[0] < pair[1]), "{up:?}");
    assert!(down.windows(2).all(|pair| pair[0] > pair[1]), "{down:?}");
    // The rover is all but the same from behind; backwards along the contour its rear is uphill,
    // and it holds it.
    for (ahead, back) in [(&up, slips(Course::BackUp)), (&down, slips(Course::BackDown))] {
        assert!(ahead.iter().zip(&back).all(|(one, other)| (one - other).abs() < 0.02));
    }
    for row in on(&courses, Course::BackAcross) {
        let drift = row.motion.and_then(|motion| motion.drift).expect("it is driven");
        assert!(drift.median.abs() < 0.01 && drift.high > 0.0, "{row:?}");
    }
}

/// Up and down are the runs in time with the nose there.
#[test]
fn straight_up_and_down_slip_as_runs_do() {
    let study = SlopeStudy { heading: HeadingStudy::of(&given::traverse(0.0, 0.0)), ..study() };
    let slope = deg(8.0);
    let card = card(&study, &[], &[slope]);
    let rows = study.courses(&card.rows, &[], &|| true).expect("all in order");
    let rows = rows.expect("not stopped");
    for (course, yaw, rim_speed) in [
        (Course::Up, 90.0, 0.06),
        (Course::Down, -90.0, 0.06),
        (Course::BackDown, 90.0, -0.06),
        (Course::BackUp, -90.0, -0.06),
    ] {
        let [row] = on(&rows, course)[..] else { panic!("one slope") };
        let scenario = Scenario {
            drive: DriveLaw::Constant(rim_speed),
            duration: 2.0,
            ..given::traverse(slope, deg(yaw))
        };
        let run = given::run(&scenario);
        let wheels = run.last().wheels.iter();
        let slip = wheels.map(|it| it.reaction.slip.ratio).sum::<f64>() / 4.0 * rim_speed.signum();
        let found = row.motion.and_then(|motion| motion.slip_ratio).expect("it moves").median;
        assert!((found - slip).abs() < 1e-4, "{course:?}: {found} and {slip}");
    }
}

/// To set the nose a rover had better go on, with its uphill wheels slower: against each other they
/// dig.
#[test]
fn turning_on_the_way_slips_less_than_on_the_spot() {
    let courses = courses(&[4.0, 10.0]);
    for (way, spot) in on(&courses, Course::Turn).iter().zip(on(&courses, Course::TurnOnTheSpot)) {
        let slip = |row: &CourseRow| row.motion.and_then(|it| it.slip_ratio).map(|it| it.median);
        assert!(slip(way) < Some(0.2) && slip(&spot).is_none_or(|it| it > 0.4), "{way:?} {spot:?}");
        let motion = way.motion.expect("it turns");
        assert_eq!(motion.stuck.successes, 0);
        let (way, downhill) = (motion.turn_way.expect("turns"), motion.turn_downhill.expect("it"));
        assert!(way.low > 0.0 && downhill.high < 0.1 && downhill.high.abs() < way.high);
        assert!(spot.judgement.verdict > Verdict::Go, "{spot:?}");
    }
}

#[test]
fn a_card_that_is_stopped_has_no_rows() {
    let (study, slopes) = (study(), slopes(6));
    assert_eq!(study.card(&[], &slopes, &|| false).expect("in order"), None);
    let card = card(&study, &[], &slopes);
    assert_eq!(study.courses(&card.rows, &[], &|| false), Ok(None));
}
