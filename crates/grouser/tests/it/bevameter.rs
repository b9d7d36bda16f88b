//! Soils from raw plate and shear tests: published sets, and soils that were hidden.

use std::ops::ControlFlow;

use grouser::document::calibration::{BevameterFound, BevameterProblem, BevameterTests};
use grouser::document::measurements::Limits;
use grouser::document::measurements::bevameter_sets::BEVAMETER_SETS;
use grouser::document::{self, Described, Document, Kind, Overrides, Source, plates, shear_tests};
use grouser::soil::Soil;
use grouser::studies::calibration::bevameter::shear_strength;
use grouser::studies::calibration::plate_curve::PlatePoint;
use grouser::studies::calibration::repeated_curves::CurvePoint;
use grouser::studies::calibration::{
    Fit, Observer, PlateCurve, PosteriorState, ShearCurve, WongFit,
};
use grouser::units::{EARTH_GRAVITY, kpa, mm};
use nalgebra::{DMatrix, DVector};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

struct Patient;

impl Observer for Patient {
    fn searched(&self) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn fitted(&self, _: &Fit) {}

    fn walked(&self, _: &PosteriorState) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

fn rows(name: &str) -> &'static str {
    BEVAMETER_SETS.iter().find(|set| set.name == name).expect("a set").rows
}

fn plates_of(name: &str) -> Vec<PlateCurve> {
    let read = plates::read_from(name, rows(name).as_bytes(), Limits::default());
    read.expect("rows of plates").curves
}

fn shear_of(name: &str) -> Vec<ShearCurve> {
    let read = shear_tests::read_from(name, rows(name).as_bytes(), Limits::default());
    read.expect("rows of shear tests").curves
}

fn document(name: &str) -> Document {
    let source = Source::find(Kind::Soil, name).expect("a preset");
    document::read_soil(&source, &Overrides::none()).expect("a soil").document
}

fn problem(soil: &Document, law: &str, tests: &BevameterTests) -> BevameterProblem {
    BevameterProblem::new(soil, Some(law), EARTH_GRAVITY, tests).expect("curves")
}

fn solved(problem: &BevameterProblem) -> BevameterFound {
    problem.solve("tests.csv", None, &Patient).expect("a fit")
}

// ---- GRC-1 ----

/// A cubic spline whose third derivative does not jump at the last knots but one ("not a knot").
fn spline(x: &[f64], y: &[f64], at: f64) -> f64 {
    let n = x.len();
    let h: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let slopes: Vec<f64> = (0..n - 1).map(|i| (y[i + 1] - y[i]) / h[i]).collect();
    let (mut system, mut right) = (DMatrix::zeros(n, n), DVector::zeros(n));
    for i in 1..n - 1 {
        system[(i, i - 1)] = h[i - 1];
        system[(i, i)] = 2.0 * (h[i - 1] + h[i]);
        system[(i, i + 1)] = h[i];
        right[i] = 6.0 * (slopes[i] - slopes[i - 1]);
    }
    for (row, [first, middle, last]) in [(0, [0, 1, 2]), (n - 1, [n - 1, n - 2, n - 3])] {
        let (near, far) = if row == 0 { (h[0], h[1]) } else { (h[n - 2], h[n - 3]) };
        system[(row, first)] = far;
        system[(row, middle)] = -(near + far);
        system[(row, last)] = near;
    }
    let bend = system.lu().solve(&right).expect("knots differ");
    let i = x.partition_point(|knot| *knot <= at).clamp(1, n - 1) - 1;
    let away = at - x[i];
    let first = slopes[i] - h[i] * (2.0 * bend[i] + bend[i + 1]) / 6.0;
    let third = (bend[i + 1] - bend[i]) / (6.0 * h[i]);
    y[i] + away * (first + away * (bend[i] / 2.0 + away * third))
}

/// The mean sinkage of the repeats of a plate at every half kilopascal.
fn oravec_s_mean(curves: &[PlateCurve], width: f64, top_kpa: u32, dropped: usize) -> PlateCurve {
    let repeats: Vec<&PlateCurve> =
        curves.iter().filter(|it| (it.width - width).abs() < 1e-9).collect();
    assert_eq!(repeats.len(), 5);
    let sinkage = |curve: &PlateCurve, pressure: f64| {
        let (p, z): (Vec<f64>, Vec<f64>) =
            curve.points.iter().map(|it| (it.pressure, it.sinkage)).unzip();
        spline(&p, &z, pressure)
    };
    let point = |step: u32| {
        let pressure = kpa(0.5 * f64::from(step));
        let mean = repeats.iter().map(|it| sinkage(it, pressure)).sum::<f64>() / 5.0;
        PlatePoint { sinkage: mean, pressure, scatter: 0.0 }
    };
    PlateCurve { width, points: (0..=2 * top_kpa).skip(dropped).map(point).collect() }
}

fn oravec_s_fit(tops_kpa: [u32; 3], dropped: [usize; 3]) -> WongFit {
    let curves = plates_of("grc-1-plates");
    let radii = [38.0, 51.0, 95.0].map(mm);
    let mean = |i: usize| oravec_s_mean(&curves, radii[i], tops_kpa[i], dropped[i]);
    WongFit::of(&[0, 1, 2].map(mean)).expect("three plates")
}

/// Source: Oravec 2009, Figure 5.52 and Code D5 (lunar range of pressures): n 1.232, k_c 4096.3537,
/// k_φ −22284.5786.
#[test]
fn raw_plates_of_grc_1_give_the_published_moduli_to_the_last_digit() {
    let fit = oravec_s_fit([50, 50, 30], [3, 1, 1]);
    assert_eq!(format!("{:.3}", fit.exponent), "1.232");
    assert_eq!(format!("{:.4}", 1e-3 * fit.k_c), "4096.3537");
    assert_eq!(format!("{:.4}", 1e-3 * fit.k_phi), "-22284.5786");
}

/// Source: Oravec 2009, Figure 5.53 (entire range): n 0.80563, k_c 97.06, k_φ 1744.2495.
/// DIFFERENCE: k_φ comes out as 1744.2940, 3e-5 more. The ends of the pressures are not printed;
/// 160, 105 and 30 kPa are those found by the transcription of the data.
#[test]
fn over_the_entire_range_they_give_the_published_exponent_and_k_c() {
    let fit = oravec_s_fit([160, 105, 30], [1, 1, 1]);
    assert_eq!(format!("{:.5}", fit.exponent), "0.80563");
    assert_eq!(format!("{:.2}", 1e-3 * fit.k_c), "97.06");
    assert!((1e-3 * fit.k_phi / 1744.2495 - 1.0).abs() < 5e-5, "{}", fit.k_phi);
}

/// Five repeats, three widths: determined or said not to be, no modulus at a bound, a soil document
/// that can be read.
#[test]
fn raw_plates_of_grc_1_make_a_soil() {
    let tests = BevameterTests { plates: plates_of("grc-1-plates"), shear: Vec::new() };
    let problem = problem(&document("grc-1"), "bekker", &tests);
    assert_eq!(problem.curves().repeats.0, [5, 5, 5]);
    assert_eq!(problem.notes().len(), 3, "{:?}", problem.notes());
    let found = solved(&problem);
    let at_bound = found.solved.records.iter().filter(|record| record.fit_std.is_none());
    assert_eq!(at_bound.count(), 0, "{:?}", found.solved.records);
    let text = found.soil.to_toml();
    assert!(text.contains("width_m"), "{text}");
    let again = document::read_soil(&Source::text("fitted", &text), &Overrides::none());
    again.expect("it is a soil for its plates");
}

// ---- Cullinan sand ----

/// One plate and one normal stress leave one number of each pair open, and the fit says so.
#[test]
fn one_plate_and_one_normal_stress_say_what_they_leave_open() {
    let tests =
        BevameterTests { plates: plates_of("cullinan-plates"), shear: shear_of("cullinan-shear") };
    let found = solved(&problem(&document("dry-sand"), "bekker", &tests));
    for part in ["plates of one width", "one normal stress"] {
        let sentences = &found.solved.unidentifiable;
        assert!(sentences.iter().any(|sentence| sentence.contains(part)), "{sentences:?}");
    }
    // Under 93 kPa the stress rises to 45 kPa at once and then slowly to 65 kPa: the law ends
    // between.
    let soil = Soil::of(&found.soil);
    let strength = shear_strength(&soil).stress(kpa(93.0), 1.0);
    assert!((kpa(45.0)..kpa(65.3)).contains(&strength), "{strength}");
}

// ---- a soil laboratory's round trip ----

/// Standard normal numbers.
struct Noise(ChaCha8Rng);

impl Noise {
    fn normal(&mut self) -> f64 {
        // Twelve uniform numbers add up to a nearly normal one of variance 1.
        let uniform = |_| f64::from(self.0.next_u32()) / f64::from(u32::MAX);
        (0..12).map(uniform).sum::<f64>() - 6.0
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.0.next_u32()) / f64::from(u32::MAX)
    }
}

/// Readings of a curve: as a whole off by 3 %, each by noise of 1 % of the curve's end.
fn noisy(noise: &mut Noise, places: &[f64], law: impl Fn(f64) -> f64) -> Vec<CurvePoint> {
    let level = 1.0 + 0.03 * noise.normal();
    let own = 0.01 * law(places[places.len() - 1]);
    let read = |at: &f64| CurvePoint {
        at: *at,
        value: level * law(*at) + own * noise.normal(),
        scatter: 0.0,
    };
    places.iter().map(read).collect()
}

/// Raw tests of a hidden soil: plates of three radii and shear under four normal stresses, each
/// five times.
fn hidden_tests(noise: &mut Noise) -> (Soil, BevameterTests) {
    const REPEATS: usize = 5;
    let settings = [
        format!("soil.cohesion_kpa={}", noise.between(0.5, 4.0)),
        format!("soil.friction_angle_deg={}", noise.between(28.0, 42.0)),
        format!("soil.shear.longitudinal_m={}", noise.between(0.005, 0.03)),
        format!(
            "soil.pressure_sinkage={{ law = \"bekker\", k_c = {}, k_phi = {}, n = {} }}",
            noise.between(-2e4, 4e4),
            noise.between(1.5e6, 4e6),
            noise.between(0.7, 1.4)
        ),
        "soil.domain.width_m=[0.03, 0.1]".to_owned(),
    ];
    let source = Source::find(Kind::Soil, "dry-sand").expect("a preset");
    let settings = Overrides::parse(settings.iter().map(String::as_str)).expect("settings");
    let soil = document::read_soil(&source, &settings).expect("a soil").value;
    let places = |most: f64| (1..=40).map(|k| most * f64::from(k) / 40.0).collect::<Vec<_>>();
    let mut tests = BevameterTests::default();
    for _ in 0..REPEATS {
        for width in [30.0, 50.0, 100.0].map(mm) {
            let stiffness = soil.pressure_sinkage.stiffness(width, 0.0, 0.0, 0.0);
            let points = noisy(noise, &places(0.05), |z| stiffness.pressure(z));
            let point = |it: &CurvePoint| PlatePoint {
                sinkage: it.at,
                pressure: it.value,
                scatter: it.scatter,
            };
            tests.plates.push(PlateCurve { width, points: points.iter().map(point).collect() });
        }
        for normal_stress in [5.0, 10.0, 20.0, 40.0].map(kpa) {
            let strength = shear_strength(&soil);
            let points = noisy(noise, &places(0.08), |j| strength.stress(normal_stress, j));
            tests.shear.push(ShearCurve { normal_stress, points });
        }
    }
    (soil, tests)
}

/// Counts, for each fitted key, the hidden soils whose value lies within its 95 % interval.
fn within_their_intervals(soils: u64) -> Vec<(String, usize)> {
    let mut within: Vec<(String, usize)> = Vec::new();
    for number in 0..soils {
        let mut noise = Noise(ChaCha8Rng::seed_from_u64(number));
        let (soil, tests) = hidden_tests(&mut noise);
        let found = solved(&problem(&document("dry-sand"), "bekker", &tests));
        for record in &found.solved.records {
            let key = record.key.trim_start_matches("soil.");
            let truth = number_of(&soil, key);
            let deviation = record.fit_std.unwrap_or(0.0);
            let is_within = (record.fit - truth).abs() <= 1.96 * deviation;
            match within.iter_mut().find(|(known, _)| known == key) {
                Some((_, count)) => *count += usize::from(is_within),
                None => within.push((key.to_owned(), usize::from(is_within))),
            }
        }
    }
    within
}

/// A number of a soil in its key's unit.
fn number_of(soil: &Soil, key: &str) -> f64 {
    let grouser::soil::PressureSinkage::Bekker { k_c, k_phi, exponent } = soil.pressure_sinkage
    else {
        panic!("the hidden soils have Bekker's law")
    };
    match key {
        "pressure_sinkage.k_c" => k_c,
        "pressure_sinkage.k_phi" => k_phi,
        "pressure_sinkage.n" => exponent.at_zero,
        "cohesion_kpa" => 1e-3 * soil.cohesion,
        "friction_angle_deg" => soil.friction_angle.to_degrees(),
        _ => shear_strength(soil).modulus,
    }
}

#[track_caller]
fn check_coverage(soils: u64, least: usize) {
    let within = within_their_intervals(soils);
    assert_eq!(within.len(), 6);
    println!("of {soils} soils within 95 % intervals: {within:?}");
    assert!(within.iter().all(|(_, count)| *count >= least), "of {soils}: {within:?}");
}

/// Nine or fewer of 12 intervals of 95 % hold the truth once in 500 times.
#[test]
fn hidden_soils_come_back_within_their_intervals() {
    check_coverage(12, 10);
}

#[test]
#[ignore = "a hundred soils"]
fn a_hundred_hidden_soils_come_back_within_their_intervals() {
    check_coverage(100, 90);
}
