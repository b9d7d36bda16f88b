//! Uncertain soils: draws, bands, probabilities, and the attitude on soils that are drawn.

use std::sync::atomic::{AtomicUsize, Ordering};

use grouser::contact::Model;
use grouser::document::{self, LoadedScenario, Overrides, Source};
use grouser::soil::{Exit, Soil};
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::ensemble::{
    Band, Contradiction, Correlation, Distribution, Marginal, Probability,
};
use grouser::studies::heading::{HeadingCurve, HeadingStudy};
use grouser::studies::heading_band::HeadingBand;
use grouser::units::deg;
use statrs::distribution::{ContinuousCDF, Normal};

const SEED: u64 = 7;

fn normal(mean: f64, standard_deviation: f64) -> Marginal {
    Marginal::Normal { mean, standard_deviation }
}

fn lognormal(mean: f64, standard_deviation: f64) -> Marginal {
    Marginal::Lognormal { mean, standard_deviation }
}

fn of_marginals(marginals: &[Marginal], correlations: &[Correlation]) -> Distribution {
    Distribution::of_marginals(marginals.to_vec(), correlations).expect("they can be")
}

fn draws(distribution: &Distribution, count: u64) -> Vec<Vec<f64>> {
    let draw = |index| distribution.draw(SEED, index, |values| Some(values.to_vec()));
    (0..count).map(|index| draw(index).expect("all are taken")).collect()
}

fn column(rows: &[Vec<f64>], column: usize) -> Vec<f64> {
    rows.iter().map(|row| row[column]).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn deviation(values: &[f64]) -> f64 {
    let centre = mean(values);
    (values.iter().map(|value| (value - centre).powi(2)).sum::<f64>() / values.len() as f64).sqrt()
}

fn correlation(one: &[f64], other: &[f64]) -> f64 {
    let (a, b) = (mean(one), mean(other));
    let products: Vec<f64> = one.iter().zip(other).map(|(x, y)| (x - a) * (y - b)).collect();
    mean(&products) / (deviation(one) * deviation(other))
}

// ---- Draws ----

/// Largest distance between the steps of the draws and a distribution (Kolmogorov and Smirnov).
fn kolmogorov(mut values: Vec<f64>, cumulative: impl Fn(f64) -> f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let count = values.len() as f64;
    let distances = values.iter().enumerate().map(|(index, value)| {
        let (expected, index) = (cumulative(*value), index as f64);
        (expected - index / count).abs().max((expected - (index + 1.0) / count).abs())
    });
    distances.fold(0.0, f64::max)
}

/// One set of true draws in ten thousand is further away than 2.23/√n (Kolmogorov's limit law); the
/// seed is fixed, so the test cannot fail by chance later.
#[test]
fn draws_follow_the_distributions_that_were_asked_for() {
    const COUNT: u64 = 4000;
    let farthest = 2.23 / (COUNT as f64).sqrt();
    let both = of_marginals(&[normal(38.0, 1.5), lognormal(0.036, 0.02)], &[]);
    let rows = draws(&both, COUNT);
    let standard = Normal::standard();
    let first = kolmogorov(column(&rows, 0), |x| standard.cdf((x - 38.0) / 1.5));
    assert!(first < farthest, "{first}");
    // Mean m and deviation d of a lognormal: σ² = ln(1 + d²/m²), μ = ln m − σ²/2.
    let variance = (0.02_f64 / 0.036).powi(2).ln_1p();
    let centre = 0.036_f64.ln() - variance / 2.0;
    let second =
        kolmogorov(column(&rows, 1), |x| standard.cdf((x.ln() - centre) / variance.sqrt()));
    assert!(second < farthest, "{second}");
    // And not just any: a normal of the same mean and deviation is told apart.
    let wrong = kolmogorov(column(&rows, 1), |x| standard.cdf((x - 0.036) / 0.02));
    assert!(wrong > 2.0 * farthest, "{wrong}");
}

/// The standard error of a correlation ρ is (1 − ρ²)/√n; five of them.
#[test]
fn correlations_are_recovered() {
    const COUNT: u64 = 4000;
    let asked = [([0, 1], -0.4), ([1, 2], 0.5), ([0, 2], 0.0)];
    let named =
        asked[..2].iter().map(|(between, value)| Correlation { between: *between, value: *value });
    let marginals = [normal(1.0, 2.0), normal(-3.0, 0.1), lognormal(5.0, 1.0)];
    let rows = draws(&of_marginals(&marginals, &named.collect::<Vec<_>>()), COUNT);
    let scores = |place: usize| -> Vec<f64> {
        let values = column(&rows, place);
        if place == 2 { values.iter().map(|value| value.ln()).collect() } else { values }
    };
    for ([one, other], expected) in asked {
        let found = correlation(&scores(one), &scores(other));
        let tolerance = 5.0 * (1.0 - expected * expected) / (COUNT as f64).sqrt();
        assert!((found - expected).abs() < tolerance, "{one} {other}: {found}, not {expected}");
    }
}

#[test]
fn correlations_that_contradict_each_other_are_refused() {
    let three = vec![normal(0.0, 1.0); 3];
    let pair = |one, other, value| Correlation { between: [one, other], value };
    // If one goes with two and two with three, one cannot go against three.
    let around = [pair(0, 1, 0.9), pair(1, 2, 0.9), pair(0, 2, -0.9)];
    assert_eq!(Distribution::of_marginals(three.clone(), &around), Err(Contradiction));
    for whole in [1.0, -1.0] {
        let one = [pair(0, 1, whole)];
        assert_eq!(Distribution::of_marginals(three.clone(), &one), Err(Contradiction));
    }
    // A pair that is not named has none, which can contradict the others, too.
    assert_eq!(Distribution::of_marginals(three.clone(), &around[..2]), Err(Contradiction));
    let mild = [pair(0, 1, 0.7), pair(1, 2, 0.7)];
    assert!(Distribution::of_marginals(three, &mild).is_ok());
}

#[test]
fn a_draw_alone_is_the_same_as_among_many() {
    let distribution = of_marginals(&[normal(0.0, 1.0), lognormal(2.0, 1.0)], &[]);
    let many = draws(&distribution, 50);
    for index in [49_u64, 17, 0] {
        let alone = distribution.draw(SEED, index, |values| Some(values.to_vec()));
        assert_eq!(alone.as_ref(), Ok(&many[usize::try_from(index).expect("it is small")]));
        let other = distribution.draw(SEED + 1, index, |values| Some(values.to_vec()));
        assert_ne!(alone, other);
    }
    let mut all = column(&many, 0);
    all.sort_by(f64::total_cmp);
    all.dedup();
    assert_eq!(all.len(), 50, "draws repeat");
}

/// A normal cut off at its mean is half normal, with mean √(2/π).
#[test]
fn what_is_refused_is_drawn_again() {
    const COUNT: u64 = 4000;
    let distribution = of_marginals(&[normal(0.0, 1.0)], &[]);
    let positive =
        |index| distribution.draw(SEED, index, |values| (values[0] > 0.0).then_some(values[0]));
    let values: Vec<f64> = (0..COUNT).map(|index| positive(index).expect("half are")).collect();
    let expected = (2.0 / std::f64::consts::PI).sqrt();
    // Five standard errors of a half normal, whose deviation is √(1 − 2/π).
    let tolerance = 5.0 * ((1.0 - 2.0 / std::f64::consts::PI) / COUNT as f64).sqrt();
    assert!((mean(&values) - expected).abs() < tolerance, "{}", mean(&values));

    let mut tries = 0;
    let never = distribution.draw(SEED, 3, |_| {
        tries += 1;
        None::<f64>
    });
    let error = never.expect_err("nothing is taken");
    assert_eq!((error.index, error.tries), (3, tries));
}

/// Shares of true draws scatter by √(p(1 − p)/n); five of that.
#[test]
fn each_sample_is_drawn_as_often_as_the_others() {
    const COUNT: u64 = 4000;
    let rows = [[1.0, 10.0], [2.0, 20.0], [3.0, 30.0], [4.0, 40.0]].map(Vec::from);
    let drawn = draws(&Distribution::of_samples(rows.to_vec()), COUNT);
    for row in &rows {
        let share = drawn.iter().filter(|drawn| *drawn == row).count() as f64 / COUNT as f64;
        let tolerance = 5.0 * (0.25 * 0.75 / COUNT as f64).sqrt();
        assert!((share - 0.25).abs() < tolerance, "{row:?}: {share}");
    }
    assert!(drawn.iter().all(|drawn| rows.contains(drawn)), "rows are kept together");
}

#[test]
fn without_deviation_every_draw_is_the_mean_exactly() {
    let means = [38.0, 122.726_925_096_745_57, 0.1];
    let marginals = [normal(means[0], 0.0), lognormal(means[1], 0.0), lognormal(means[2], 0.0)];
    for row in draws(&of_marginals(&marginals, &[]), 20) {
        assert_eq!(row, means);
    }
}

// ---- Bands and probabilities ----

#[test]
fn the_band_of_evenly_spaced_draws_is_read_off() {
    let band = Band::of((0..=1000).rev().map(f64::from)).expect("there are draws");
    assert_eq!((band.low, band.median, band.high), (25.0, 500.0, 975.0));
    let two = Band::of([1.0, 3.0]).expect("there are draws");
    assert_eq!(two.median, 2.0);
    let one = Band::of([5.0]).expect("there is a draw");
    assert_eq!((one.low, one.median, one.high), (5.0, 5.0, 5.0));
    assert_eq!(Band::of([]), None);
}

/// 2.5 % of the way from the first to the fifth number is a tenth of the way to the second.
#[test]
fn the_ends_of_a_band_lie_between_neighbours() {
    let band = Band::of([4.0, 0.0, 3.0, 1.0, 2.0]).expect("there are draws");
    assert!((band.low - 0.1).abs() < 1e-12 && (band.high - 3.9).abs() < 1e-12, "{band:?}");
    assert_eq!(band.median, 2.0);
    assert_eq!(Band::of([7.0]), Some(Band { low: 7.0, median: 7.0, high: 7.0 }));
}

/// A quantile at p of n draws scatters by √(p(1 − p)/n)/f, with f the density there: 0.0584 at
/// 2.5 %, 0.399 at the median; five of that.
#[test]
fn the_band_of_normal_draws_is_the_normals() {
    const COUNT: u64 = 4000;
    let rows = draws(&of_marginals(&[normal(0.0, 1.0)], &[]), COUNT);
    let band = Band::of(column(&rows, 0)).expect("there are draws");
    for (found, expected, share, density) in [
        (band.low, -1.959_964, 0.025, 0.0584),
        (band.median, 0.0, 0.5, 0.3989),
        (band.high, 1.959_964, 0.975, 0.0584),
    ] {
        let scatter = (share * (1.0 - share) / COUNT as f64).sqrt() / density;
        let off: f64 = found - expected;
        assert!(off.abs() < 5.0 * scatter, "{found}, not {expected}");
    }
}

/// Wilson's interval ends where the score test is at its limit: (p_hat − p)² = z² p(1 − p)/n.
#[test]
fn wilsons_interval_solves_its_equation() {
    let z: f64 = Normal::standard().inverse_cdf(0.975);
    for (successes, trials) in [(1, 2), (0, 10), (10, 10), (3, 10), (499, 500), (37, 5000)] {
        let probability = Probability { successes, trials };
        let (low, high) = probability.interval();
        let estimate = probability.estimate();
        assert!(0.0 <= low && low <= estimate && estimate <= high && high <= 1.0);
        for (end, is_trivial) in [(low, successes == 0), (high, successes == trials)] {
            let left = (estimate - end).powi(2);
            let right = z * z * end * (1.0 - end) / trials as f64;
            // Round-off of a sum of terms below 1.
            assert!(is_trivial || (left - right).abs() < 1e-14, "{probability:?}: {end}");
        }
    }
    let never = Probability { successes: 0, trials: 10 };
    // z²/(n + z²), the closed form without a success.
    assert!((never.interval().1 - z * z / (10.0 + z * z)).abs() < 1e-14);
    assert_eq!(never.interval().0, 0.0);
}

/// In 95 % of repeats the interval covers the truth; Wilson's own coverage at p = 0.3, n = 100 is
/// 0.937 to 0.96 about there, and 2000 repeats scatter by 0.005.
#[test]
fn wilsons_interval_covers_the_truth() {
    const REPEATS: u64 = 2000;
    let fair = Distribution::of_samples((0..10).map(|place| vec![f64::from(place)]).collect());
    let covers = |repeat: u64| {
        let happens = |trial: u64| {
            fair.draw(repeat, trial, |values| Some(values[0] < 3.0)).expect("all are taken")
        };
        let successes = (0..100).filter(|trial| happens(*trial)).count();
        let (low, high) = Probability { successes, trials: 100 }.interval();
        (low..=high).contains(&0.3)
    };
    let share = (0..REPEATS).filter(|repeat| covers(*repeat)).count() as f64 / REPEATS as f64;
    assert!((0.925..0.965).contains(&share), "{share}");
}

// ---- The attitude ----

fn scenario() -> LoadedScenario {
    let mut overrides = Overrides::none();
    overrides.flag_text("--soil", "scenario.soil", "toyoura-uncertain").expect("it is a key");
    document::read_scenario(&Source::default_scenario(), &overrides).expect("a preset")
}

fn soils(count: u64) -> Vec<Soil> {
    let uncertain = scenario().uncertain.expect("it says so");
    (0..count).map(|index| uncertain.draw(SEED, index).expect("it can be drawn")).collect()
}

/// Soils in the source paper's model.
fn samples(soils: &[Soil]) -> Vec<Sample> {
    soils.iter().map(|soil| Sample { soil: *soil, model: Model::Ishigami }).collect()
}

fn band(soils: &[Soil], slopes: &[f64]) -> HeadingBand {
    let study = HeadingStudy::of(&scenario().value);
    let band = HeadingBand::of(&study, &samples(soils), slopes, &|| true);
    band.expect("they are soils").expect("nobody broke it off")
}

const SLOPES: [f64; 3] = [5.0, 15.0, 21.0];

fn slopes() -> Vec<f64> {
    SLOPES.map(deg).to_vec()
}

#[test]
fn soils_that_do_not_differ_give_the_nominal_curve_exactly() {
    let scenario = scenario();
    let study = HeadingStudy::of(&scenario.value);
    let curve = study.curve().expect("it is a soil");
    let band = band(&vec![scenario.value.ground.soil; 5], &slopes());
    for on_slope in &band.slopes {
        match curve.at(on_slope.slope) {
            Err(_) => {
                let above_all = f64::INFINITY;
                let none = Band { low: above_all, median: above_all, high: above_all };
                assert_eq!((on_slope.level.successes, on_slope.yaw), (0, Some(none)));
                let stuck = Band { low: 1.0, median: 1.0, high: 1.0 };
                assert_eq!(on_slope.slip_ratio, Some(stuck));
            }
            Ok(attitude) => {
                let exactly = |value| Some(Band { low: value, median: value, high: value });
                assert_eq!(on_slope.level, Probability { successes: 5, trials: 5 });
                assert_eq!(on_slope.yaw, exactly(attitude.yaw));
                assert_eq!(on_slope.slip_ratio, exactly(attitude.slip_ratio));
                assert_eq!(on_slope.sinkage, exactly(attitude.mean_sinkage()));
                let energy = attitude.energy_per_metre(&study.rover);
                assert_eq!(on_slope.energy_per_metre, exactly(energy));
            }
        }
    }
    let (limit, _) = curve.limit().expect("the rover moves");
    assert_eq!(band.limit, Some(Band { low: limit, median: limit, high: limit }));
    assert_eq!(band.slopes[2].level.successes, 0, "21° is too steep for the nominal soil");
}

#[test]
fn the_band_is_that_of_the_curves_one_by_one() {
    let soils = soils(12);
    let band = band(&soils, &slopes());
    let study = HeadingStudy::of(&scenario().value);
    let curve =
        |soil: &Soil| HeadingStudy { soil: *soil, ..study.clone() }.curve().expect("it is a soil");
    let curves: Vec<_> = soils.iter().map(curve).collect();
    for on_slope in &band.slopes {
        let yaw = |curve: &HeadingCurve| {
            curve.at(on_slope.slope).map_or(f64::INFINITY, |heading| heading.yaw)
        };
        let yaws: Vec<f64> = curves.iter().map(yaw).collect();
        let successes = yaws.iter().filter(|yaw| yaw.is_finite()).count();
        assert_eq!(on_slope.level, Probability { successes, trials: 12 });
        assert_eq!(on_slope.yaw, Band::of(yaws));
        let slips = curves.iter().map(|curve| curve.at(on_slope.slope));
        let slips = slips.map(|found| found.map_or(1.0, |heading| heading.slip_ratio));
        assert_eq!(on_slope.slip_ratio, Band::of(slips));
    }
    let limits = curves.iter().map(|curve| curve.limit().map_or(0.0, |(slope, _)| slope));
    assert_eq!(band.limit, Band::of(limits));
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let soils = soils(24);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads can be started").install(|| band(&soils, &slopes()))
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn every_draw_is_told_when_it_is_done() {
    let done = AtomicUsize::new(0);
    let count = || {
        done.fetch_add(1, Ordering::Relaxed);
        true
    };
    let study = HeadingStudy::of(&scenario().value);
    HeadingBand::of(&study, &samples(&soils(7)), &[deg(5.0)], &count).expect("they are soils");
    assert_eq!(done.into_inner(), 7);
}

#[test]
fn a_study_that_is_broken_off_has_no_result() {
    let study = HeadingStudy::of(&scenario().value);
    let broken_off = HeadingBand::of(&study, &samples(&soils(7)), &[deg(5.0)], &|| false);
    assert_eq!(broken_off.expect("they are soils"), None);
}

/// A soil that cannot move the rover has no attitude and no steepest slope; it still counts.
#[test]
fn soils_that_do_not_carry_the_rover_count_against_it() {
    let good = scenario().value.ground.soil;
    let mut slick = good;
    slick.friction_angle = deg(5.0);
    slick.exit = Exit::Ratio(0.0);
    let band = band(&[good, slick, good, slick], &[deg(5.0)]);
    assert_eq!(band.slopes[0].level, Probability { successes: 2, trials: 4 });
    assert_eq!(band.mobile, Probability { successes: 2, trials: 4 });
    // None is left out: half of the samples do not get on, on any slope.
    assert_eq!(band.limit.expect("there are samples").low, 0.0);
    let slip = band.slopes[0].slip_ratio.expect("there are samples");
    assert!(slip.low < 0.1 && slip.high == 1.0, "{slip:?}");
    let wheel = scenario().value.rover.mounts()[0].unit.wheel;
    let sinkage = band.slopes[0].sinkage.expect("there are samples");
    assert!((sinkage.high - wheel.shearing_radius()).abs() < 1e-12, "{sinkage:?}");
    let energy = band.slopes[0].energy_per_metre.expect("there are samples");
    assert!(energy.low.is_finite() && energy.high == f64::INFINITY, "{energy:?}");
}

/// A curve that breaks off for want of a solver would count as too steep a slope.
#[test]
fn every_drawn_curve_ends_for_a_physical_reason() {
    let study = HeadingStudy::of(&scenario().value);
    for soil in soils(60) {
        let curve = HeadingStudy { soil, ..study.clone() }.curve().expect("it is a soil");
        let (limit, reason) = curve.limit().expect("the rover moves");
        let physical = ["turning further uphill", "wheels spin", "tips over", "range of slopes"];
        assert!(physical.iter().any(|end| reason.contains(end)), "{limit}: {reason} on {soil:?}");
    }
}

#[test]
fn the_first_soil_that_is_none_is_the_error() {
    let good = scenario().value.ground.soil;
    let bad = |density| Soil { density, ..good };
    let study = HeadingStudy::of(&scenario().value);
    let soils = [good, bad(-1.0), good, bad(-2.0)];
    let error = HeadingBand::of(&study, &samples(&soils), &[deg(5.0)], &|| true);
    let error = error.expect_err("density");
    assert_eq!(error.value, -1.0);
}
