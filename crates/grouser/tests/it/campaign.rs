//! Campaigns without documents: designs, cut distributions, and statistics with known answers.

use grouser::studies::ensemble::design::{Design, SOBOL_LENGTH, Sampling};
use grouser::studies::ensemble::sensitivity::Sensitivity;
use grouser::studies::ensemble::statistics::{Convergence, Quantile, Summary};
use grouser::studies::ensemble::{Correlation, Distribution, Ensemble, Marginal, Matrix};
use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, Normal};

const ALL: [Sampling; 3] = [Sampling::MonteCarlo, Sampling::LatinHypercube, Sampling::Sobol];

fn design(sampling: Sampling, points: u64, dimensions: usize, seed: u64) -> Design {
    Design { sampling, points, dimensions, seed }
}

fn points(design: &Design) -> Vec<Vec<f64>> {
    (0..design.points).map(|index| design.point(index)).collect()
}

/// How many points are in each of some equal parts of an axis.
fn counts(points: &[Vec<f64>], axis: usize, parts: usize) -> Vec<usize> {
    let mut counts = vec![0; parts];
    for point in points {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let part = (point[axis] * parts as f64) as usize;
        counts[part] += 1;
    }
    counts
}

// ---- Designs ----

#[test]
fn points_are_inside_the_cube_and_repeat_alone() {
    for sampling in ALL {
        let design = design(sampling, 300, 5, 11);
        for point in points(&design) {
            assert!(point.iter().all(|u| *u > 0.0 && *u < 1.0), "{sampling:?}: {point:?}");
        }
        assert_eq!(design.point(123), design.point(123));
        assert_ne!(design.point(123), design.point(124));
        assert_ne!(design.point(123), Design { seed: 12, ..design }.point(123));
    }
}

/// A Latin hypercube has one point in each of N parts of every axis, whatever N.
#[test]
fn a_latin_hypercube_has_a_point_in_every_stratum() {
    for count in [1_u64, 7, 64, 1000] {
        let points = points(&design(Sampling::LatinHypercube, count, 4, 3));
        for axis in 0..4 {
            let counts = counts(&points, axis, points.len());
            assert!(counts.iter().all(|count| *count == 1), "{count} axis {axis}");
        }
    }
}

/// And its axes are shuffled apart: the correlation of two has the deviation 1/√(N − 1).
#[test]
fn the_axes_of_a_latin_hypercube_do_not_go_together() {
    let points = points(&design(Sampling::LatinHypercube, 2000, 6, 5));
    for one in 0..6 {
        for other in 0..one {
            let products = points.iter().map(|point| (point[one] - 0.5) * (point[other] - 0.5));
            let correlation = 12.0 * products.sum::<f64>() / points.len() as f64;
            assert!(correlation.abs() < 4.5 / 2000_f64.sqrt(), "{one} {other}: {correlation}");
        }
    }
}

/// The first 2^k points of a scrambled net have one in each of 2^k parts of every axis, and the
/// first two axes one in every box of 2^a by 2^(k−a).
#[test]
fn scrambled_sobol_points_are_a_net() {
    let points = points(&design(Sampling::Sobol, 1024, 8, 9));
    for axis in 0..8 {
        for power in [4, 8, 10] {
            let first = &points[..1 << power];
            let counts = counts(first, axis, first.len());
            assert!(counts.iter().all(|count| *count == 1), "axis {axis}, 2^{power}");
        }
    }
    for split in 0..=10 {
        let (rows, columns) = (f64::from(1 << split), f64::from(1 << (10 - split)));
        let mut boxes: Vec<(u64, u64)> = points
            .iter()
            .map(|point| {
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
                let place = ((point[0] * rows) as u64, (point[1] * columns) as u64);
                place
            })
            .collect();
        boxes.sort_unstable();
        boxes.dedup();
        assert_eq!(boxes.len(), 1024, "2^{split} rows");
    }
}

/// The direction numbers end after 2¹⁶ points; the sequence goes on with another scramble.
#[test]
fn a_sobol_design_goes_on_beyond_its_direction_numbers() {
    let design = design(Sampling::Sobol, 2 * SOBOL_LENGTH, 3, 1);
    let second: Vec<Vec<f64>> =
        (SOBOL_LENGTH..SOBOL_LENGTH + 4096).map(|index| design.point(index)).collect();
    for axis in 0..3 {
        let counts = counts(&second, axis, 4096);
        assert!(counts.iter().all(|count| *count == 1), "axis {axis}");
    }
    assert_ne!(design.point(5), design.point(SOBOL_LENGTH + 5));
}

/// Mean squared error of the mean of exp(x) + y z over 64 sets of 256 points; both means are known.
/// Latin hypercubes take the additive part away, which has all but 1/12² of the variance; nets take
/// interactions, too. The bounds are a third of what is found.
#[test]
fn better_designs_have_smaller_errors() {
    let error = |sampling: Sampling| -> f64 {
        let square = |seed: u64| {
            let points = points(&design(sampling, 256, 3, seed));
            let sum: f64 = points.iter().map(|u| u[0].exp() + u[1] * u[2]).sum();
            (sum / 256.0 - (1_f64.exp() - 1.0 + 0.25)).powi(2)
        };
        (0..64).map(square).sum::<f64>() / 64.0
    };
    let [random, latin, sobol] = ALL.map(error);
    // V = V(eˣ) + V(yz) = 0.2420 + 7/144; its mean square over 64 sets scatters by 18 %.
    let expected = (0.2420 + 7.0 / 144.0) / 256.0;
    assert!((random / expected - 1.0).abs() < 0.6, "{random} {expected}");
    // V of what is not additive in y z is 1/144.
    let latin_expected = 1.0 / 144.0 / 256.0;
    assert!((latin / latin_expected - 1.0).abs() < 0.6, "{latin} {latin_expected}");
    assert!(sobol < latin / 10.0, "{sobol} {latin}");
}

// ---- Distributions ----

fn quantiles(marginal: Marginal, range: Option<(f64, f64)>, shares: &[f64]) -> Vec<f64> {
    let mut distribution = Distribution::of_marginals(vec![marginal], &[]).expect("one value");
    if let Some((low, high)) = range {
        distribution = distribution.within(&[low..=high]);
    }
    shares.iter().map(|share| distribution.at(&[*share])[0]).collect()
}

/// The error function and its inverse are good to 1e-10 together.
fn check_close(found: &[f64], expected: &[f64]) {
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= 1e-9 * expected.abs().max(1.0), "{found} {expected}");
    }
}

#[test]
fn uniform_and_triangular_quantiles_are_exact() {
    let uniform = Marginal::Uniform { low: -2.0, high: 6.0 };
    check_close(&quantiles(uniform, None, &[0.125, 0.5, 0.9]), &[-1.0, 2.0, 5.2]);
    // F(x) = (x − a)²/[(b − a)(c − a)] up to the mode: with a = 0, c = 1, b = 4 it is x²/4.
    let triangular = Marginal::Triangular { low: 0.0, mode: 1.0, high: 4.0 };
    check_close(&quantiles(triangular, None, &[0.04, 0.25, 0.97]), &[0.4, 1.0, 4.0 - 0.6]);
    let rising = Marginal::Triangular { low: 0.0, mode: 2.0, high: 2.0 };
    check_close(&quantiles(rising, None, &[0.25, 0.81]), &[1.0, 1.8]);
}

/// A cut distribution has the quantiles of the whole one at the shares that are inside.
#[test]
fn a_cut_distribution_keeps_its_shape_inside() {
    let standard = Normal::standard();
    let normal = Marginal::Normal { mean: 1.0, standard_deviation: 0.2 };
    let (low, high) = (0.9, 1.5);
    let below = standard.cdf((low - 1.0) / 0.2);
    let inside = standard.cdf((high - 1.0) / 0.2) - below;
    let shares = [1e-9, 0.1, 0.5, 0.9, 1.0 - 1e-9];
    let expected = shares.map(|share| 1.0 + 0.2 * standard.inverse_cdf(below + share * inside));
    let found = quantiles(normal, Some((low, high)), &shares);
    // The reference's inverse is good to 1e-10 or so.
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-8, "{found} {expected}");
    }
    // What no end cuts is what it was, to the bit.
    let wide = quantiles(normal, Some((-1e3, 1e3)), &shares);
    assert_eq!(wide, quantiles(normal, None, &shares));
    // Nothing is outside, however narrow the range.
    for share in [1e-300, 1e-12, 0.5, 1.0 - 1e-16] {
        let cut = quantiles(normal, Some((1.3, 1.31)), &[share])[0];
        assert!((1.3..=1.31).contains(&cut), "{cut}");
    }
    // A value that is certain stays, also at the end of its range.
    let certain = Marginal::Normal { mean: 0.0, standard_deviation: 0.0 };
    assert_eq!(quantiles(certain, Some((0.0, 1.0)), &[0.1, 0.9]), [0.0, 0.0]);
}

#[test]
fn the_share_within_a_range_is_that_of_the_distribution() {
    let standard = Normal::standard();
    let normal = Marginal::Normal { mean: 10.0, standard_deviation: 2.0 };
    let expected = standard.cdf(1.0) - standard.cdf(-0.5);
    assert!((normal.share_within(&(9.0..=12.0)) - expected).abs() < 1e-10);
    let lognormal = Marginal::Lognormal { mean: 1.0, standard_deviation: 1.0 };
    // The median is 1/√(1 + 1).
    assert!((lognormal.share_within(&(0.0..=0.5_f64.sqrt())) - 0.5).abs() < 1e-12);
    let uniform = Marginal::Uniform { low: 0.0, high: 4.0 };
    assert_eq!(uniform.share_within(&(3.0..=9.0)), 0.25);
    let triangular = Marginal::Triangular { low: 0.0, mode: 1.0, high: 2.0 };
    assert_eq!(triangular.share_within(&(0.5..=1.5)), 0.75);
}

// ---- Quantiles ----

/// Ranks of the 95 % interval of a median of 100, as tables print them: the 40th and the 61st; with
/// five draws no two bound it that surely, and with six the outermost do.
#[test]
fn intervals_of_a_median_are_those_of_the_tables() {
    let draws = |count: i32| -> Vec<f64> { (1..=count).map(f64::from).collect() };
    let of = |count| Quantile::of(&draws(count), 0.5).expect("there are draws");
    assert_eq!((of(100).value, of(100).low, of(100).high), (50.5, Some(40.0), Some(61.0)));
    assert_eq!((of(6).low, of(6).high), (Some(1.0), Some(6.0)));
    assert_eq!((of(5).low, of(5).high), (None, None));
    assert_eq!(Quantile::of(&[], 0.5), None);
    assert_eq!(Quantile::of(&draws(9), f64::NAN), None);
}

/// The intervals hold in 95 % of campaigns or more, for any distribution, and not in all: 2000
/// campaigns tell 95 % to half a percent, here five times that.
#[test]
fn intervals_of_quantiles_cover_as_often_as_they_say() {
    const CAMPAIGNS: u64 = 2000;
    for share in [0.1, 0.5, 0.9] {
        // An exponential: x = −ln(1 − u).
        let truth = -(1.0_f64 - share).ln();
        let covers = |seed: &u64| {
            let points = points(&design(Sampling::MonteCarlo, 200, 1, *seed));
            let mut draws: Vec<f64> = points.iter().map(|u| -(1.0 - u[0]).ln()).collect();
            draws.sort_by(f64::total_cmp);
            let Quantile { low, high, .. } = Quantile::of(&draws, share).expect("draws");
            low.is_some_and(|low| low <= truth) && high.is_some_and(|high| truth <= high)
        };
        let covered = (0..CAMPAIGNS).into_par_iter().filter(covers).count() as f64;
        let coverage = covered / CAMPAIGNS as f64;
        assert!((0.945..0.985).contains(&coverage), "{share}: {coverage}");
    }
}

/// Mean 0 and deviation 1 of a normal; missing draws are counted and left out.
#[test]
fn a_summary_tells_moments_and_what_is_missing() {
    let one = Distribution::of_marginals(
        vec![Marginal::Normal { mean: 3.0, standard_deviation: 0.5 }],
        &[],
    )
    .expect("one value");
    let plan = Ensemble::new(Sampling::Sobol, 4096, 2, one, false);
    let mut draws: Vec<Option<f64>> =
        (0..plan.runs()).map(|run| Some(plan.inputs(run).values[0])).collect();
    draws.extend([None; 4]);
    let summary = Summary::of(&draws, &[0.025, 0.5]).expect("many draws");
    assert_eq!((summary.count, summary.missing), (4096, 4));
    // A net of 4096 points tells the mean to about 1/4096 of the deviation.
    assert!((summary.mean.value - 3.0).abs() < 1e-3, "{:?}", summary.mean);
    assert!((summary.deviation - 0.5).abs() < 2e-3, "{}", summary.deviation);
    let half = 1.96 * 0.5 / 64.0;
    assert!((summary.mean.high - summary.mean.low - 2.0 * half).abs() < 0.01 * half);
    assert!((summary.quantiles[0].value - (3.0 - 0.98)).abs() < 0.01);
    assert_eq!(Summary::of(&[Some(1.0), None], &[]), None);
}

#[test]
fn convergence_ends_with_all_runs() {
    let draws: Vec<Option<f64>> =
        (0..100).map(|run| (run != 3).then_some(f64::from(run))).collect();
    let steps = Convergence::of(&draws, &[0.5]);
    assert_eq!(steps.iter().map(|step| step.runs).collect::<Vec<_>>(), [16, 32, 64, 100]);
    assert_eq!(steps[3].summary, Summary::of(&draws, &[0.5]));
    assert_eq!(steps[0].summary, Summary::of(&draws[..16], &[0.5]));
    assert_eq!(Convergence::of(&draws[..1], &[0.5])[0].summary, None);
}

// ---- Sensitivities ----

/// Independent values, drawn by any design, through a function, with Saltelli's matrices.
fn sensitivity(
    sampling: Sampling,
    points: u64,
    marginals: &[Marginal],
    function: impl Fn(&[f64]) -> Option<f64>,
) -> Sensitivity {
    let inputs = marginals.len();
    let distribution = Distribution::of_marginals(marginals.to_vec(), &[]).expect("independent");
    let plan = Ensemble::new(sampling, points, 4, distribution, true);
    assert_eq!(plan.runs(), points * (inputs as u64 + 2));
    let outputs: Vec<Option<f64>> =
        (0..plan.runs()).map(|run| function(&plan.inputs(run).values)).collect();
    Sensitivity::of(&outputs, inputs, 1).expect("it varies")
}

/// Checks that known indices lie in their intervals, and that the intervals are no wider than
/// asked.
fn check_indices(found: &Sensitivity, expected: &[(f64, f64)], widest: f64) {
    for (place, (index, (first, total))) in found.indices.iter().zip(expected).enumerate() {
        for (name, estimate, truth) in [("S", index.first, *first), ("T", index.total, *total)] {
            // An index of exactly 0 or a sum of squares that is 0 has an interval of no width.
            let within = estimate.low - 1e-12 <= truth && truth <= estimate.high + 1e-12;
            assert!(within, "{name}{place}: {truth} not in {estimate:?}");
            assert!(estimate.high - estimate.low < widest, "{name}{place}: {estimate:?}");
        }
    }
}

/// f = sin x₁ + a sin² x₂ + b x₃⁴ sin x₁ with a = 7, b = 0.1 over −π to π (Ishigami and Homma
/// 1990).
///
/// V₁ = (1 + bπ⁴/5)²/2, V₂ = a²/8, V₁₃ = 8b²π⁸/225.
#[test]
fn sobol_indices_of_the_ishigami_function() {
    let (a, b) = (7.0_f64, 0.1);
    let pi = std::f64::consts::PI;
    let (v1, v2) = ((1.0 + b * pi.powi(4) / 5.0).powi(2) / 2.0, a * a / 8.0);
    let v13 = 8.0 * b * b * pi.powi(8) / 225.0;
    let v = v1 + v2 + v13;
    let expected = [(v1 / v, (v1 + v13) / v), (v2 / v, v2 / v), (0.0, v13 / v)];
    // As printed everywhere: 0.3139, 0.4424, 0; 0.5576, 0.4424, 0.2437.
    assert!((expected[0].0 - 0.3139).abs() < 5e-5 && (expected[2].1 - 0.2437).abs() < 5e-5);
    let x = [Marginal::Uniform { low: -pi, high: pi }; 3];
    for sampling in ALL {
        let found = sensitivity(sampling, 4096, &x, |x| {
            Some(x[0].sin() + a * x[1].sin().powi(2) + b * x[2].powi(4) * x[0].sin())
        });
        assert_eq!((found.points, found.missing), (4096, 0));
        check_indices(&found, &expected, 0.12);
        // V is 13.84; independent draws tell it to 2 % or so.
        assert!((found.variance / v - 1.0).abs() < 0.1, "{sampling:?}: {}", found.variance);
    }
}

/// f = Σ c_i x_i of independent normal values: S_i = T_i = c_i² d_i²/Σ. No interaction anywhere.
#[test]
fn sobol_indices_of_a_sum_of_normal_values() {
    let deviations = [1.0, 2.0, 0.5, 0.0];
    let marginals =
        deviations.map(|standard_deviation| Marginal::Normal { mean: 10.0, standard_deviation });
    let all: f64 = deviations.iter().map(|d| d * d).sum();
    let expected = deviations.map(|d| (d * d / all, d * d / all));
    for sampling in ALL {
        let found = sensitivity(sampling, 2048, &marginals, |x| Some(x.iter().sum()));
        check_indices(&found, &expected, 0.2);
        assert!((found.mean - 40.0).abs() < 0.2);
    }
}

/// The intervals of a first and a total index hold in most campaigns: bootstrapped ones of 512
/// independent points in 95 % or a little less. 300 campaigns tell that to 1.3 %.
#[test]
fn intervals_of_indices_cover_as_often_as_they_say() {
    const CAMPAIGNS: u64 = 300;
    let x = Distribution::of_marginals(
        vec![Marginal::Normal { mean: 0.0, standard_deviation: 1.0 }; 2],
        &[],
    )
    .expect("two values");
    // f = x₁ + x₁ x₂: V₁ = 1, V₂ = 0, V₁₂ = 1.
    let covered: Vec<[bool; 2]> = (0..CAMPAIGNS)
        .into_par_iter()
        .map(|seed| {
            let plan = Ensemble::new(Sampling::MonteCarlo, 512, seed, x.clone(), true);
            let outputs: Vec<Option<f64>> = (0..plan.runs())
                .map(|run| plan.inputs(run).values)
                .map(|x| Some(x[0] + x[0] * x[1]))
                .collect();
            let found = Sensitivity::of(&outputs, 2, seed).expect("it varies");
            let (first, total) = (found.indices[0].first, found.indices[1].total);
            [first, total].map(|estimate| estimate.low <= 0.5 && 0.5 <= estimate.high)
        })
        .collect();
    for which in 0..2 {
        let share = covered.iter().filter(|both| both[which]).count() as f64 / CAMPAIGNS as f64;
        assert!((0.89..0.99).contains(&share), "{which}: {share}");
    }
}

/// What cannot be computed anywhere near a point leaves the whole point out, and is counted.
#[test]
fn points_without_an_output_are_left_out_and_counted() {
    let x = [Marginal::Uniform { low: 0.0, high: 1.0 }; 2];
    let found = sensitivity(Sampling::Sobol, 256, &x, |x| (x[0] > 0.1).then_some(x[1]));
    // A and B each lose a tenth, one in common is exchanged: 0.9² of the points stay.
    assert_eq!(found.points + found.missing, 256);
    assert!(found.missing.abs_diff(49) < 8, "{}", found.missing);
    assert!(Sensitivity::of(&[Some(1.0); 12], 2, 1).is_none(), "it does not vary");
    assert!(Sensitivity::of(&[None; 12], 2, 1).is_none());
    assert!(Sensitivity::of(&[], 2, 1).is_none());
}

// ---- Plans ----

/// Rows of A and B, and A with one dimension of B: rows of samples are one dimension of several
/// values.
#[test]
fn matrices_exchange_one_dimension_at_a_time() {
    let normal = Marginal::Normal { mean: 0.0, standard_deviation: 1.0 };
    let values = Distribution::of_marginals(vec![normal; 2], &[]).expect("two values");
    let rows = (0..50).map(|row| vec![f64::from(row), -f64::from(row)]).collect();
    let samples = Distribution::of_samples(rows);
    let plan = Ensemble::new(Sampling::LatinHypercube, 10, 3, values.and(samples), true);
    assert_eq!((plan.dimensions(), plan.runs_per_point(), plan.runs()), (3, 5, 50));
    for point in 0..10 {
        let [a, b, first, second, third] =
            [0, 1, 2, 3, 4].map(|which| plan.inputs(5 * point + which));
        assert_eq!(a.place.expect("a place").matrix, Matrix::A);
        assert_eq!(third.place.expect("a place").matrix, Matrix::Exchanged(2));
        assert_eq!(third.place.expect("a place").point, point);
        assert_eq!(first.values, [b.values[0], a.values[1], a.values[2], a.values[3]]);
        assert_eq!(second.values, [a.values[0], b.values[1], a.values[2], a.values[3]]);
        assert_eq!(third.values, [a.values[0], a.values[1], b.values[2], b.values[3]]);
        assert!(a.values[2] == -a.values[3], "a row stays together");
    }
}

/// Correlations are those of the scores, with every design: 4 deviations of 1/√N.
#[test]
fn correlated_inputs_are_correlated_in_every_design() {
    let normal = Marginal::Normal { mean: 0.0, standard_deviation: 1.0 };
    let pair = [Correlation { between: [0, 1], value: 0.6 }];
    let both = Distribution::of_marginals(vec![normal; 2], &pair).expect("they can be");
    for sampling in ALL {
        let plan = Ensemble::new(sampling, 4096, 8, both.clone(), false);
        let products = (0..4096).map(|run| plan.inputs(run).values).map(|x| x[0] * x[1]);
        let found = products.sum::<f64>() / 4096.0;
        assert!((found - 0.6).abs() < 4.0 / 64.0, "{sampling:?}: {found}");
    }
}
