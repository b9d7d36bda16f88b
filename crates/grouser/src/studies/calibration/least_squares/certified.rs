//! The search against nonlinear regressions with certified results.
//!
//! Source: NIST, Statistical Reference Datasets, Nonlinear Regression: data, starts and certified
//! values of Misra1a, Thurber, MGH09, MGH10 and Rat43.

use super::{Evaluated, Minimum, Residuals, minimise};
use crate::elementary::{exp, pow};

/// A regression: y = f(b, x), from two starts to the certified parameters.
struct Regression {
    law: fn(&[f64], f64) -> f64,
    /// x and y.
    points: &'static [(f64, f64)],
    starts: [&'static [f64]; 2],
    parameters: &'static [f64],
    residual_sum_of_squares: f64,
}

impl Residuals for Regression {
    fn at(&self, b: &[f64]) -> Option<Evaluated> {
        let residuals: Vec<f64> = self.points.iter().map(|&(x, y)| (self.law)(b, x) - y).collect();
        let is_finite = residuals.iter().all(|residual| residual.is_finite());
        is_finite.then_some(Evaluated { residuals, kept: Vec::new() })
    }

    /// Central differences, good to about 1e-10 of the derivatives.
    fn jacobian_at(&self, b: &[f64], _: &[f64]) -> Option<Vec<Vec<f64>>> {
        let column = |axis: usize| {
            let step = 1e-5 * b[axis].abs();
            let moved = |by: f64| {
                let mut there = b.to_vec();
                there[axis] += by;
                self.at(&there).map(|it| it.residuals)
            };
            let (ahead, behind) = (moved(step)?, moved(-step)?);
            Some(ahead.iter().zip(&behind).map(|(a, b)| (a - b) / (2.0 * step)).collect())
        };
        (0..b.len()).map(column).collect()
    }
}

/// More than any of these searches takes, MGH10 from afar included.
const PATIENCE: usize = 1000;

/// Every start leads to the certified values: seven digits of the sum of squares. A search that
/// ends at a gain of 1e-9 leaves five to seven of the parameters, and four along the flat valley of
/// MGH09.
fn check_certified(regression: &Regression) {
    for start in regression.starts {
        let Minimum { coordinates, cost, converged } = minimise(regression, start, PATIENCE);
        assert!(converged, "from {start:?} it came to {coordinates:?}");
        let sum = 2.0 * cost;
        let certified = regression.residual_sum_of_squares;
        assert!((sum / certified - 1.0).abs() < 1e-7, "{sum} instead of {certified}");
        for (found, certified) in coordinates.iter().zip(regression.parameters) {
            assert!((found / certified - 1.0).abs() < 1e-4, "{found} instead of {certified}");
        }
    }
}

#[test]
fn misra1a_is_found_from_both_starts() {
    check_certified(&Regression {
        law: |b, x| b[0] * (1.0 - exp(-b[1] * x)),
        points: &[
            (77.6, 10.07),
            (114.9, 14.73),
            (141.1, 17.94),
            (190.8, 23.93),
            (239.9, 29.61),
            (289.0, 35.18),
            (332.8, 40.02),
            (378.4, 44.82),
            (434.8, 50.76),
            (477.3, 55.05),
            (536.8, 61.01),
            (593.1, 66.40),
            (689.1, 75.47),
            (760.0, 81.78),
        ],
        starts: [&[500.0, 1e-4], &[250.0, 5e-4]],
        parameters: &[238.942_129_18, 5.501_564_318_1e-4],
        residual_sum_of_squares: 0.124_551_388_94,
    });
}

/// Seven parameters of a rational function.
#[test]
fn thurber_is_found_from_both_starts() {
    check_certified(&Regression {
        law: |b, x| {
            let above = b[0] + x * (b[1] + x * (b[2] + x * b[3]));
            above / (1.0 + x * (b[4] + x * (b[5] + x * b[6])))
        },
        points: &[
            (-3.067, 80.574),
            (-2.981, 84.248),
            (-2.921, 87.264),
            (-2.912, 87.195),
            (-2.840, 89.076),
            (-2.797, 89.608),
            (-2.702, 89.868),
            (-2.699, 90.101),
            (-2.633, 92.405),
            (-2.481, 95.854),
            (-2.363, 100.696),
            (-2.322, 101.060),
            (-1.501, 401.672),
            (-1.460, 390.724),
            (-1.274, 567.534),
            (-1.212, 635.316),
            (-1.100, 733.054),
            (-1.046, 759.087),
            (-0.915, 894.206),
            (-0.714, 990.785),
            (-0.566, 1090.109),
            (-0.545, 1080.914),
            (-0.400, 1122.643),
            (-0.309, 1178.351),
            (-0.109, 1260.531),
            (-0.103, 1273.514),
            (0.010, 1288.339),
            (0.119, 1327.543),
            (0.377, 1353.863),
            (0.790, 1414.509),
            (0.963, 1425.208),
            (1.006, 1421.384),
            (1.115, 1442.962),
            (1.572, 1464.350),
            (1.841, 1468.705),
            (2.047, 1447.894),
            (2.200, 1457.628),
        ],
        starts: [
            &[1000.0, 1000.0, 400.0, 40.0, 0.7, 0.3, 0.03],
            &[1300.0, 1500.0, 500.0, 75.0, 1.0, 0.4, 0.05],
        ],
        parameters: &[
            1_288.139_680_0,
            1_491.079_253_5,
            583.238_368_77,
            75.416_644_291,
            0.966_295_028_64,
            0.397_972_857_97,
            0.049_727_297_349,
        ],
        residual_sum_of_squares: 5_642.708_239_7,
    });
}

/// Four parameters, searched from a hundred times their values.
#[test]
fn mgh09_is_found_from_both_starts() {
    check_certified(&Regression {
        law: |b, x| b[0] * (x * x + x * b[1]) / (x * x + x * b[2] + b[3]),
        points: &[
            (4.0, 0.1957),
            (2.0, 0.1947),
            (1.0, 0.1735),
            (0.5, 0.16),
            (0.25, 0.0844),
            (0.167, 0.0627),
            (0.125, 0.0456),
            (0.1, 0.0342),
            (0.0833, 0.0323),
            (0.0714, 0.0235),
            (0.0625, 0.0246),
        ],
        starts: [&[25.0, 39.0, 41.5, 39.0], &[0.25, 0.39, 0.415, 0.39]],
        parameters: &[0.192_806_934_58, 0.191_282_328_73, 0.123_056_506_93, 0.136_062_330_68],
        residual_sum_of_squares: 3.075_056_038_5e-4,
    });
}

/// Parameters from 0.006 to 6000, along a narrow curved valley.
#[test]
fn mgh10_is_found_from_both_starts() {
    check_certified(&Regression {
        law: |b, x| b[0] * exp(b[1] / (x + b[2])),
        points: &[
            (50.0, 34_780.0),
            (55.0, 28_610.0),
            (60.0, 23_650.0),
            (65.0, 19_630.0),
            (70.0, 16_370.0),
            (75.0, 13_720.0),
            (80.0, 11_540.0),
            (85.0, 9_744.0),
            (90.0, 8_261.0),
            (95.0, 7_030.0),
            (100.0, 6_005.0),
            (105.0, 5_147.0),
            (110.0, 4_427.0),
            (115.0, 3_820.0),
            (120.0, 3_307.0),
            (125.0, 2_872.0),
        ],
        starts: [&[2.0, 400_000.0, 25_000.0], &[0.02, 4_000.0, 250.0]],
        parameters: &[5.609_636_471_0e-3, 6_181.346_346_3, 345.223_634_62],
        residual_sum_of_squares: 87.945_855_171,
    });
}

/// A law that is no number for negative parameters.
#[test]
fn rat43_is_found_from_both_starts() {
    check_certified(&Regression {
        law: |b, x| b[0] / pow(1.0 + exp(b[1] - b[2] * x), 1.0 / b[3]),
        points: &[
            (1.0, 16.08),
            (2.0, 33.83),
            (3.0, 65.80),
            (4.0, 97.20),
            (5.0, 191.55),
            (6.0, 326.20),
            (7.0, 386.87),
            (8.0, 520.53),
            (9.0, 590.03),
            (10.0, 651.92),
            (11.0, 724.93),
            (12.0, 699.56),
            (13.0, 689.96),
            (14.0, 637.56),
            (15.0, 717.41),
        ],
        starts: [&[100.0, 10.0, 1.0, 1.0], &[700.0, 5.0, 0.75, 1.3]],
        parameters: &[699.641_512_70, 5.277_125_302_5, 0.759_629_383_29, 1.279_248_385_9],
        residual_sum_of_squares: 8_786.404_908_0,
    });
}

/// (x − 3)², which has no residual left of 1. Its slope is given ten times too flat, so that from
/// 10 the first step goes to −60.
struct EndsAtOne;

impl Residuals for EndsAtOne {
    fn at(&self, x: &[f64]) -> Option<Evaluated> {
        (x[0] > 1.0).then(|| Evaluated { residuals: vec![x[0] - 3.0], kept: Vec::new() })
    }

    fn jacobian_at(&self, _: &[f64], _: &[f64]) -> Option<Vec<Vec<f64>>> {
        Some(vec![vec![0.1]])
    }
}

#[test]
fn a_step_to_where_there_are_no_residuals_is_taken_back() {
    let end = minimise(&EndsAtOne, &[10.0], 100);
    assert!((end.coordinates[0] - 3.0).abs() < 1e-3 && end.coordinates[0] > 1.0, "{end:?}");
    let nowhere = minimise(&EndsAtOne, &[0.0], 100);
    assert!(nowhere.cost.is_infinite() && !nowhere.converged);
}

/// The search that runs out of evaluations says so, and keeps the best point with its own cost.
#[test]
fn a_search_ends_with_its_patience() {
    let law = Regression {
        law: |b, x| b[0] * exp(b[1] / (x + b[2])),
        points: &[(50.0, 34_780.0), (85.0, 9_744.0), (105.0, 5_147.0), (125.0, 2_872.0)],
        starts: [&[], &[]],
        parameters: &[],
        residual_sum_of_squares: 0.0,
    };
    let start = [0.02, 4_000.0, 250.0];
    let end = minimise(&law, &start, 2);
    let cost = |at: &[f64]| super::half_square(&law.at(at).expect("residuals").residuals);
    assert!(!end.converged);
    assert!((end.cost / cost(&end.coordinates) - 1.0).abs() < 1e-15);
    assert!(end.cost < cost(&start));
}
