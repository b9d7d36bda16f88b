//! The operator's card: its numbers, its bands and its verdicts.

use grouser::contact::Theory;
use grouser::document::{self, LoadedScenario, Overrides, Source};
use grouser::simulation::Scenario;
use grouser::soil::Soil;
use grouser::studies::card::{Card, CardStudy, Rule, Verdict};
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::ensemble::{Band, Probability};
use grouser::studies::heading::HeadingStudy;
use grouser::units::deg;

use super::given;

const SEED: u64 = 7;

fn scenario() -> LoadedScenario {
    let mut overrides = Overrides::none();
    overrides.flag_text("--soil", "scenario.soil", "toyoura-uncertain").expect("it is a key");
    document::read_scenario(&Source::default_scenario(), &overrides).expect("a preset")
}

fn study() -> CardStudy {
    let heading = HeadingStudy::of(&scenario().value);
    let (rim_speed, rule) = (given::RIM_SPEED, Rule::DEFAULT);
    CardStudy { heading, rim_speed, rule, is_soil_uncertain: true }
}

fn soils(count: u64) -> Vec<Soil> {
    let uncertain = scenario().uncertain.expect("it says so");
    (0..count).map(|index| uncertain.draw(SEED, index).expect("it can be drawn")).collect()
}

fn slopes(to: u32) -> Vec<f64> {
    (0..=to).map(|degree| deg(f64::from(degree))).collect()
}

fn card(study: &CardStudy, soils: &[Soil], slopes: &[f64]) -> Card {
    let sample = |soil: &Soil| Sample { soil: *soil, theory: study.heading.theory };
    let samples: Vec<Sample> = soils.iter().map(sample).collect();
    study.card(&samples, slopes, &|| ()).expect("rule, slopes and soils are in order")
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

/// With the nose on the contour the soil pushes uphill with all of the weight's share, and not forward.
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
        assert_eq!(bands.yaw, exactly(row.level.map(|level| level.yaw)));
        let slip = row.level.map_or(1.0, |level| level.slip_ratio);
        assert_eq!(bands.slip_ratio, exactly(Some(slip)));
        assert_eq!(bands.power, exactly(row.level.map(|level| level.power)));
        assert_eq!(bands.drift, exactly(Some(row.drift.unwrap_or(1.0))));
        let successes = if row.level.is_some() { 4 } else { 0 };
        assert_eq!(bands.level, Probability { successes, trials: 4 });
    }
}

/// The means of the uncertain values make a soil in the middle of the others. (Only where nearly all soils
/// have an attitude: the yaw's band is over those that have.)
#[test]
fn the_band_contains_the_curve_of_the_mean_soil() {
    let card = card(&study(), &soils(120), &slopes(14));
    for row in &card.rows[1..] {
        let (bands, level) = (row.bands.expect("drawn"), row.level.expect("not steep"));
        let inside = |band: Option<Band>, value: f64| {
            let band = band.expect("not steep");
            band.low < value && value < band.high
        };
        assert!(inside(bands.yaw, level.yaw), "{row:?}");
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

/// Models that differ say nothing about the soil: the margin stays, in each of them.
#[test]
fn samples_of_models_alone_keep_the_margin() {
    let study = CardStudy { is_soil_uncertain: false, ..study() };
    let (soil, slopes) = (study.heading.soil, slopes(30));
    let of = |theory| Sample { soil, theory };
    let card = |samples: &[Sample]| study.card(samples, &slopes, &|| ()).expect("in order");
    let alone = card(&[]);
    let same = card(&[of(Theory::Ishigami), of(Theory::Ishigami)]);
    let verdicts = |card: &Card| card.rows.iter().map(|row| row.verdict).collect::<Vec<_>>();
    assert_eq!(verdicts(&alone), verdicts(&same));
    // One in two of the models would have to be ignored to go further than the weaker one.
    let both = card(&[of(Theory::Ishigami), of(Theory::Rft)]);
    assert_eq!(verdicts(&alone), verdicts(&both));
    let [weak, strong] = [Theory::Ishigami, Theory::Rft]
        .map(|theory| HeadingStudy { theory, ..study.heading.clone() }.curve().expect("sand"))
        .map(|curve| curve.limit().expect("the rover moves").0);
    let limit = both.limit_band.expect("there are samples");
    assert!(limit.low >= weak && limit.high <= strong && limit.median > weak, "{limit:?}");
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

/// In a mirror, left is right: the rover with its uphill side on the other side needs the same heading.
/// Sums over wheels in another order differ by rounding.
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
        assert!((level.yaw - image.yaw).abs() < 1e-8 && one.verdict == other.verdict);
    }
}

/// A rover with more of its weight on its left wheels is another one in the mirror, and needs another heading.
#[test]
fn a_lopsided_rover_has_two_cards() {
    let hubs = [(0.19, 0.20), (-0.17, 0.20), (-0.17, -0.28), (0.19, -0.28)];
    let rover = given::rover_on(given::hakuto_wheel(), &hubs);
    assert!(!rover.is_symmetric());
    let yaw = |rover| {
        let heading = HeadingStudy { rover, ..study().heading };
        let card = card(&CardStudy { heading, ..study() }, &[], &[deg(12.0)]);
        card.rows[0].level.expect("not steep").yaw
    };
    assert!((yaw(rover.mirrored()) - yaw(rover)).abs() > deg(0.01));
}

// ---- Verdicts ----

#[test]
fn a_steeper_slope_is_never_better() {
    for soils in [Vec::new(), soils(40)] {
        let card = card(&study(), &soils, &slopes(30));
        assert!(card.rows.windows(2).all(|pair| pair[0].verdict <= pair[1].verdict));
        assert_eq!(card.rows[0].verdict, Verdict::Go);
        assert_eq!(card.rows[30].verdict, Verdict::NoGo);
        assert!(card.rows.iter().any(|row| row.verdict == Verdict::Caution));
    }
}

/// The verdicts follow from the draws and the rule, counted here one by one.
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
    let mut before = Verdict::Go;
    for row in &card.rows {
        let slips = slips(row.slope);
        let within = |most: f64| slips.iter().flatten().filter(|slip| **slip <= most).count();
        let rule = Rule::DEFAULT;
        let go = within(rule.go_slip_ratio) as f64 >= rule.go_probability * 40.0;
        let no_go = (within(rule.no_go_slip_ratio) as f64) < rule.no_go_probability * 40.0;
        let own = match (go, no_go) {
            (true, _) => Verdict::Go,
            (false, true) => Verdict::NoGo,
            (false, false) => Verdict::Caution,
        };
        assert_eq!(row.verdict, own.max(before), "{row:?}");
        before = row.verdict;
    }
}

/// Without draws a slope is judged as if it were steeper by the margin: no-go starts that much before the end.
#[test]
fn the_margin_is_kept_from_the_steepest_slope() {
    let card = card(&study(), &[], &slopes(25));
    let limit = card.limit.expect("the rover moves").0;
    let margin = Rule::DEFAULT.margin;
    for row in &card.rows {
        assert_eq!(row.slope + margin > limit, row.verdict == Verdict::NoGo, "{row:?}");
    }
}

#[test]
fn a_rule_without_order_is_refused() {
    let slips = Rule { go_slip_ratio: 0.7, ..Rule::DEFAULT };
    let shares = Rule { no_go_probability: 0.99, ..Rule::DEFAULT };
    let margin = Rule { margin: f64::NAN, ..Rule::DEFAULT };
    for (rule, value) in [(slips, 0.7), (shares, 0.99)] {
        let study = CardStudy { rule, ..study() };
        assert_eq!(study.card(&[], &slopes(3), &|| ()).expect_err("no order").value, value);
    }
    assert!(margin.check().is_err());
    let falling = [deg(3.0), deg(2.0)];
    assert_eq!(study().card(&[], &falling, &|| ()).expect_err("falling").value, deg(2.0));
}
