//! Negative moduli of pressure-sinkage: published, and good for a range of widths.

use grouser::document::{self, Kind, LoadedScenario, Overrides, Source};
use grouser::soil::{PressureSinkage, SinkageExponent, Soil, Span};
use grouser::studies::heading::HeadingStudy;
use grouser::studies::verdict::SlopeStudy;
use grouser::studies::wheel_test::WheelTest;
use grouser::units::{MARS_GRAVITY, deg};

use crate::given::{smooth_wheel, toyoura};

/// KLS-1, by plates of 30, 35 and 37.5 mm radius. Source: Lim et al., Journal of Astronomy and
/// Space Sciences 38(4):237-244, 2021.
const KLS_1: &str =
    "soil.pressure_sinkage={ law = \"bekker\", k_c_kn = -44.06, k_phi_kn = 3581.8, n = 1.2594 }";

/// Changes its sign at a width of 0.1 m. Source: ours.
const WIDE_ONLY: &str =
    "soil.pressure_sinkage={ law = \"bekker\", k_c_kn = -100, k_phi_kn = 1000, n = 1.1 }";
const WIDE: &str = "soil.domain.width_m=[0.12, 0.2]";

fn soil(settings: &[&str]) -> Result<Soil, String> {
    let source = Source::find(Kind::Soil, "toyoura").expect("a preset");
    let settings = Overrides::parse(settings.iter().copied()).expect("settings");
    let loaded = document::read_soil(&source, &settings).map_err(|error| error.to_string())?;
    Ok(loaded.value)
}

fn scenario(settings: &[&str]) -> Result<LoadedScenario, String> {
    let settings = Overrides::parse(settings.iter().copied()).expect("settings");
    let read = document::read_scenario(&Source::default_scenario(), &settings);
    read.map_err(|error| error.to_string())
}

#[track_caller]
fn check_refusal<T>(found: Result<T, String>, parts: &[&str]) {
    let Err(message) = found else { panic!("not refused: {parts:?}") };
    assert!(parts.iter().all(|part| message.contains(part)), "{message}");
}

/// With KLS-1 as published, 35 mm sink under 82.8 kPa: k = 3581.8 − 44.06/0.035 kN/m^(n+2), times
/// 0.07^1.2594.
#[test]
fn published_negative_moduli_are_a_soil_for_their_plates() {
    let kls = soil(&[KLS_1, "soil.domain.width_m=[0.03, 0.0375]"]).expect("published");
    let pressure = kls.pressure_sinkage.stiffness(0.035, 0.0, 0.0, 0.0).pressure(0.07);
    let expected = (3_581_800.0 - 44_060.0 / 0.035) * 0.07_f64.powf(1.2594);
    assert!((pressure / expected - 1.0).abs() < 1e-12, "{pressure}");
}

#[test]
fn a_negative_modulus_needs_widths_over_which_the_soil_is_stiff() {
    let without = soil(&[KLS_1, "soil.domain={}"]);
    check_refusal(without, &["k_c is -44060", "domain.width_m", "[smallest, largest]"]);
    // 44.06/3581.8 = 12.3 mm.
    let too_wide = soil(&[KLS_1, "soil.domain.width_m=[0.012, 0.0375]"]);
    check_refusal(too_wide, &["k_c/b + k_phi", "0.012 m", "above zero"]);
    let thousandth =
        KLS_1.replace("_kn", "").replace("-44.06", "-0.04406").replace("3581.8", "3.5818");
    check_refusal(soil(&[&thousandth, WIDE]), &["over `domain.width_m`", "in kN they are"]);
}

/// Reece's stiffness is c k_c + γ b k_φ: under a lower gravity the negative part weighs more.
#[test]
fn reece_s_negative_modulus_holds_for_the_gravities_that_are_stated() {
    let law =
        PressureSinkage::Reece { k_c: -1.0, k_phi: 10.0, exponent: SinkageExponent::constant(1.0) };
    let mut soil = Soil { cohesion: 1000.0, density: 1500.0, pressure_sinkage: law, ..toyoura() };
    soil.domain.width = Span::new(0.01, 0.2);
    // 1500 · 9.81 · 10 b > 1000 from b = 6.8 mm on, on Mars from 18 mm on.
    assert_eq!(soil.check(), Ok(()));
    soil.domain.gravity = Span::new(MARS_GRAVITY, MARS_GRAVITY);
    let error = soil.check().expect_err("too narrow for Mars").to_string();
    assert!(error.contains("density g b k_phi"), "{error}");
}

/// HAKUTO's wheels are 80 mm wide, the soil carries from 100 mm on.
#[test]
fn a_wheel_without_stiffness_under_it_is_refused_wherever_it_meets_the_soil() {
    let refused = &["under a width b of 0.08 m", "above zero", "domain.width_m"];
    check_refusal(scenario(&[WIDE_ONLY, WIDE]), refused);
    // Wider wheels are no matter.
    let wide = scenario(&[WIDE_ONLY, WIDE, "wheel.width_m=0.14"]).expect("the soil carries it");
    let narrow = scenario(&["wheel.width_m=0.08"]).expect("ordinary");

    let mut heading = HeadingStudy::of(&narrow.value);
    heading.soil = wide.value.ground.soil;
    check_refusal(heading.curve().map_err(|error| error.to_string()), refused);
    let card = SlopeStudy { heading, ..SlopeStudy::of(&narrow) };
    let card = card.card(&[], &[deg(5.0)], &|| true).map_err(|error| error.to_string());
    check_refusal(card, refused);
    let mut run = narrow.value.clone();
    run.ground.soil = wide.value.ground.soil;
    check_refusal(run.check().map_err(|error| error.to_string()), refused);
    let wheel = smooth_wheel(0.1, 0.08);
    let test = WheelTest {
        wheel,
        soil: wide.value.ground.soil,
        gravity: run.gravity,
        model: run.model,
        loads: vec![20.0],
        slip_angles: vec![0.0],
        slip_ratios: vec![0.1],
    };
    let width = "under a width b of 0.08 m";
    check_refusal(test.check().map_err(|error| error.to_string()), &[width]);
}
