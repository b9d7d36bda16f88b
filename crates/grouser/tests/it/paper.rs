//! Every table and every number of the source paper, with what we make of it.

use grouser::contact::{Contact, Ishigami};
use grouser::contact::{Model, Slip, WheelForces};
use grouser::document::{Overrides, Source, read_scenario};
use grouser::paper;
use grouser::simulation::Scenario;
use grouser::soil::{Bulldozing, Exit, PressureSinkage, Shear, SinkageExponent, Soil};
use grouser::studies::comparison::{Levelness, yaw_error};
use grouser::studies::heading::{HeadingCurve, HeadingStudy, NoHeading, Steering};
use grouser::studies::wheel_test::WheelTest;
use grouser::terrain::Ground;
use grouser::units::{EARTH_GRAVITY, Vec2, deg};
use grouser::vehicle::drive::SlipTarget;
use grouser::vehicle::{DriveLaw, LoadSharing, OwnMoments};
use grouser::wheel::Wheel;

use super::given;

// ---- What the core has of it ----

/// Tables 1 to 3 of the core and of the documents are the same bits, and what a scenario has that
/// says no more.
#[test]
fn the_cores_sand_and_rover_are_those_of_the_documents() {
    let scenario = read_scenario(&Source::default_scenario(), &Overrides::none()).expect("it");
    let (read, made) = (scenario.value, paper::hakuto().expect("it stands"));
    let ground = Ground::plane(paper::toyoura(), deg(10.0));
    assert_eq!(read.ground.soil, paper::toyoura());
    assert_eq!(read.rover, made);
    assert_eq!(read, Scenario::new(made, ground));
}

// ---- Tables 1 and 2: the rover ----

/// Source: [FourWheel], Tables 1 and 2, and Eq. 10; sums from theory, section 5.
/// DIFFERENCE: the text speaks of a rover of about 4.5 kg; the table's parts add up to 6.928 kg.
#[test]
fn tables_1_and_2_make_a_rover_of_7_kg_with_its_centre_low_and_2_mm_ahead() {
    let rover = given::hakuto();
    assert!((rover.mass() - (5.24 + 4.0 * 0.422)).abs() < 1e-12);
    // 0.230 + 4 · 0.001 + 0.422 Σ(d_x² + d_y²), which the theory rounds to 0.386.
    assert!((rover.yaw_inertia() - 0.386).abs() < 5e-4, "{} kg·m²", rover.yaw_inertia());
    assert!((rover.centre_of_mass() - Vec2::new(0.0024, 0.0)).norm() < 5e-5);
    // The common centre of mass lies 14.6 mm below the body's, the hubs 60 mm.
    let height = rover.mounts()[0].shearing_radius() + 0.060 - 0.0146;
    assert!((rover.centre_height() - height).abs() < 5e-5, "{} m", rover.centre_height());
}

/// Source: [FourWheel], Table 2. Wheels 1 and 4 are the front ones, 1 and 2 the left ones.
#[test]
fn table_2_has_a_wheelbase_of_36_cm_and_a_track_of_48_cm() {
    let rover = given::hakuto();
    let hub = |wheel: usize| rover.mounts()[wheel - 1].position.xy();
    assert!((hub(1) - hub(2) - Vec2::new(0.36, 0.0)).norm() < 1e-12);
    assert!((hub(1) - hub(4) - Vec2::new(0.0, 0.48)).norm() < 1e-12);
}

/// Source: [FourWheel], Table 1, wheel inertias; theory, section 5: the assumed width follows from
/// the axial spread, I_xx − I_yy/2, of a uniform ring.
#[test]
fn the_assumed_width_follows_from_table_1() {
    let unit = given::hakuto().mounts()[0].unit;
    let spread = ((unit.inertia.xx - unit.inertia.yy / 2.0) / unit.mass).sqrt();
    let width = spread * 12.0_f64.sqrt();
    assert!((width - unit.wheel.width).abs() < 0.002, "{width} m");
}

// ---- Table 3: the soil ----

/// Source: [FourWheel], Table 3, "soil destructive angle" 26.0° beside a friction angle of 38.0°.
#[test]
fn table_3_destructive_angle_follows_from_the_friction_angle() {
    assert!((given::toyoura().destructive_angle() - deg(26.0)).abs() < 1e-12);
}

/// Source: [FourWheel], Table 3, K_x and K_y. DIFFERENCE: the unit of β is not printed; radians.
#[test]
fn table_3_shear_moduli_at_15_degrees() {
    let Shear::Anisotropic { longitudinal, lateral } = given::toyoura().shear else {
        panic!("the paper shears each axis on its own");
    };
    for beta in [deg(15.0), deg(-15.0)] {
        assert!((longitudinal.at(beta) - (0.036 + 0.043 * deg(15.0))).abs() < 1e-15);
        assert!((lateral.at(beta) - (0.013 + 0.020 * deg(15.0))).abs() < 1e-15);
    }
}

/// Source: [FourWheel], Table 3: k'φ = 1203.54, without a unit. DIFFERENCE: read as 1203.54 m/s²
/// times ρ, as the laboratory's code does, it is 122.7 times γ. As printed, with γ, the sand is g
/// times too stiff, and Table 4's rover finds no level attitude at 15°.
#[test]
fn table_3_frictional_modulus_is_not_for_use_with_the_unit_weight() {
    let stiffness = |k_phi| {
        let exponent = SinkageExponent::constant(1.703);
        let law = PressureSinkage::Reece { k_c: 0.0, k_phi, exponent };
        (law, law.stiffness(0.08, 0.0, 1490.0 * EARTH_GRAVITY, 0.0).modulus)
    };
    let (as_printed, stiffer) = stiffness(1203.54);
    let (_, ours) = stiffness(1203.54 / EARTH_GRAVITY);
    // Source: theory, section 2.7: 1.06e7 and 1.04e8 N/m^3.703.
    assert!((ours / 1.06e7 - 1.0).abs() < 5e-3 && (stiffer / 1.04e8 - 1.0).abs() < 5e-3);
    let soil = Soil { pressure_sinkage: as_printed, ..given::toyoura() };
    let curve = curve_with(soil, LoadSharing::QuasiStatic);
    // Source: theory, section 4.4, "literal Reece (g)", λ = 1: 4.1°, 11.3°, none. DIFFERENCE: that
    // table has H = 0.16 m, and rounds.
    assert!((yaw_on(&curve, 5.0) - 4.1).abs() < 0.06);
    assert!((yaw_on(&curve, 10.0) - 11.3).abs() < 0.1);
    assert!(matches!(curve.at(deg(15.0)), Err(NoHeading::TooSteep { .. })));
}

/// Source: theory, section 2.7: a static wheel of r = 0.10 m, b = 0.08 m, W = 20 N, λ = 1; sinkages
/// static and at s = 0.1, 0.4 and 0.8 for the readings of k'φ.
#[test]
fn readings_of_the_frictional_modulus_and_their_sinkages() {
    let wheel = given::smooth_wheel(0.10, 0.08);
    for (k_phi, printed) in
        [(1203.54 / EARTH_GRAVITY, [14.1, 14.8, 15.8]), (1203.54, [5.0, 5.2, 5.6])]
    {
        let exponent = SinkageExponent::constant(1.703);
        let pressure_sinkage = PressureSinkage::Reece { k_c: 0.0, k_phi, exponent };
        let soil = Soil { pressure_sinkage, ..given::toyoura() };
        for (s, printed) in [0.1, 0.4, 0.8].into_iter().zip(printed) {
            let contact = given::on_stand(soil, wheel, s, 0.0);
            let sinkage = given::settled(&Ishigami::default(), &contact, 20.0).sinkage * 1e3;
            assert!((sinkage - printed).abs() < 0.051, "{sinkage} mm, not {printed} mm");
        }
    }
}

// ---- Equations 15 to 18 ----

/// Source: [FourWheel], Eqs 15 and 16: driving at slip 0.2, braking at slip −0.5; Eq. 16 is on
/// r + h_g. DIFFERENCE: its "> <" leave pure rolling out; there s = 0.
#[test]
fn equations_15_and_16_on_both_branches() {
    let radius = given::hakuto_wheel().shearing_radius();
    let slip = |wheel_speed: f64, v_x: f64| {
        Slip::of_motion(radius * wheel_speed, Vec2::new(v_x, 0.0)).ratio
    };
    let wheel_speed = 0.06 / 0.11;
    // The creep speed, 1e-6 m/s, counts as 1e-10 against 6 cm/s.
    assert!((slip(wheel_speed, 0.048) - 0.2).abs() < 1e-9);
    assert!((slip(wheel_speed, 0.12) + 0.5).abs() < 1e-9);
    assert_eq!(slip(wheel_speed, 0.11 * wheel_speed), 0.0);
}

/// Source: [FourWheel], Eq. 17. DIFFERENCE: with v_y/|v_x|, or it would flip its sign in reverse.
#[test]
fn equation_17_is_positive_to_the_left() {
    let angle = |v_x: f64, v_y: f64| Slip::of_motion(0.06, Vec2::new(v_x, v_y)).angle;
    assert!((angle(0.06, 0.06 * deg(15.0).tan()) - deg(15.0)).abs() < 1e-9);
    assert!((angle(-0.06, 0.06 * deg(15.0).tan()) - deg(15.0)).abs() < 1e-9);
}

/// Rim speed [m/s] that a drive sets at a slip and a yaw.
fn rim_speed(drive: &DriveLaw, slip_ratio: f64, yaw: f64) -> f64 {
    let mut speeds = [0.0; 4];
    drive.rim_speeds(&given::hakuto(), yaw, &[slip_ratio; 4], &mut speeds);
    speeds[0]
}

/// Source: [FourWheel], Eq. 18, s_ref = 0.2, v_des = 6 cm/s.
/// DIFFERENCE: at the reference slip it meets 0.8 v_des, not v_des; and it divides by cos γ where
/// the way along the contour multiplies by it, 7 % too fast at 15° (theory, section 9).
#[test]
fn equation_18_as_printed_and_corrected() {
    let target = SlipTarget { speed: 0.06, slip_ratio: 0.2 };
    let along_contour = |drive: DriveLaw, yaw: f64| rim_speed(&drive, 0.2, yaw) * 0.8 / yaw.cos();
    let printed = |yaw| along_contour(DriveLaw::Eq18AsPrinted(target), yaw);
    let corrected = |yaw| along_contour(DriveLaw::Eq18(target), yaw);
    assert!((printed(0.0) - 0.8 * 0.06).abs() < 1e-12);
    assert!((corrected(0.0) - 0.06).abs() < 1e-12 && (corrected(deg(15.0)) - 0.06).abs() < 1e-12);
    let too_fast = printed(deg(15.0)) / printed(0.0);
    assert!((too_fast - 1.07).abs() < 0.005, "{too_fast}");
    // More slip than the reference slows the printed law down and speeds the corrected one up.
    assert!(rim_speed(&DriveLaw::Eq18AsPrinted(target), 0.3, 0.0) < 0.06);
    assert!(rim_speed(&DriveLaw::Eq18(target), 0.3, 0.0) > 0.06 / 0.8);
}

// ---- Section 4.2 and Fig. 7: the single wheel ----

fn with_k_x(at_zero: f64) -> Soil {
    let shear = Shear::Anisotropic {
        longitudinal: given::linear(at_zero, 0.043),
        lateral: given::linear(0.013, 0.020),
    };
    Soil { shear, ..given::toyoura() }
}

/// Drawbar pull [N] over slip ratios 0 to 1 by tenths, under 20 N at β = 0, on a smooth wheel whose
/// shearing radius is r_s = 0.11 m: theory, section 0.4.
fn drawbar_pulls(soil: Soil) -> Vec<WheelForces> {
    let test = WheelTest {
        wheel: given::smooth_wheel(0.11, 0.08),
        soil,
        gravity: EARTH_GRAVITY,
        model: Model::Ishigami,
        loads: vec![20.0],
        slip_angles: vec![0.0],
        slip_ratios: (0..=10).map(|k| 0.1 * f64::from(k)).collect(),
    };
    test.run().iter().map(|row| row.result.expect("sand carries 20 N").forces).collect()
}

/// Source: [FourWheel], section 4.2 and Fig. 7: "K_x changed to 0.3 at the y-intercept".
/// DIFFERENCE: in metres that leaves no pull at any slip (−1.2 N at s = 0.2, −0.4 N at s = 1): the
/// rover of section 5 could not move. (Theory, section 0.4.)
#[test]
fn with_the_tuned_shear_modulus_of_0_3_the_wheel_cannot_pull() {
    let pulls = drawbar_pulls(with_k_x(0.3));
    assert!(pulls.iter().all(|forces| forces.drawbar_pull < 0.0));
    // To the printed digit.
    assert!((pulls[2].drawbar_pull + 1.2).abs() < 0.051, "{} N", pulls[2].drawbar_pull);
    assert!((pulls[10].drawbar_pull + 0.4).abs() < 0.051, "{} N", pulls[10].drawbar_pull);
    let curve = curve_with(with_k_x(0.3), LoadSharing::QuasiStatic);
    assert!(matches!(curve.limit(), Err(NoHeading::CannotMove(_))));
}

/// Source: [FourWheel], section 4.2: the untuned model "overestimates the forces at high slip". A
/// larger modulus does lower them, so the direction of the tuning is right; 0.030 (theory, section
/// 0.4) raises them. DIFFERENCE: Fig. 7's measured curve is not printed as numbers.
#[test]
fn a_larger_shear_modulus_lowers_the_pull_at_every_slip() {
    let [softer, printed, tuned] = [0.030, 0.036, 0.3].map(|k_x| drawbar_pulls(with_k_x(k_x)));
    for slip in 1..=10 {
        let [softer, printed, tuned] =
            [&softer, &printed, &tuned].map(|pulls| pulls[slip].drawbar_pull);
        assert!(softer > printed && printed > tuned, "{softer}, {printed}, {tuned} N");
    }
}

/// Source: [FourWheel], section 4.2: "as no side slip is applied", F_y is zero. DIFFERENCE: true of
/// any theory; it says nothing about side forces.
#[test]
fn fig_7_side_force_is_zero_without_a_slip_angle() {
    assert!(drawbar_pulls(given::toyoura()).iter().all(|forces| forces.side_force == 0.0));
}

/// Source: [FourWheel], Fig. 7, model: the pull grows with slip and saturates.
#[test]
fn fig_7_drawbar_pull_grows_with_slip() {
    let pulls = drawbar_pulls(given::toyoura());
    for pair in pulls.windows(2) {
        assert!(pair[1].drawbar_pull > pair[0].drawbar_pull);
    }
    assert!(pulls[0].drawbar_pull < 0.0, "a rolling wheel without slip is held back");
    let growth = |slip: usize| pulls[slip].drawbar_pull - pulls[slip - 1].drawbar_pull;
    assert!(growth(10) < 0.6 * growth(1), "{} N, then {} N", growth(1), growth(10));
}

/// Source: JFR abstracts (theory, section 2.9): side force falls with slip and rises with slip
/// angle.
#[test]
fn side_force_falls_with_slip_and_rises_with_slip_angle() {
    let side = |s: f64, beta: f64| {
        let contact: Contact =
            given::on_stand(given::toyoura(), given::hakuto_wheel(), s, deg(beta));
        -given::settled(&Ishigami::default(), &contact, 20.0).forces.side_force
    };
    for beta in [5.0, 10.0, 20.0, 30.0] {
        assert!(side(0.1, beta) > side(0.3, beta) && side(0.3, beta) > side(0.6, beta));
    }
    for s in [0.1, 0.3, 0.6] {
        assert!(side(s, 5.0) < side(s, 10.0) && side(s, 10.0) < side(s, 20.0));
    }
}

// ---- Section 5, Figs 9 and 10, Table 4: the traverse ----

fn curve_with(soil: Soil, sharing: LoadSharing) -> HeadingCurve {
    let study = HeadingStudy {
        rover: given::hakuto(),
        soil,
        gravity: EARTH_GRAVITY,
        model: Model::Ishigami,
        sharing,
        own_moments: OwnMoments::Neglected,
        stability: grouser::soil::SlopeStability::USUAL,
        steering: Steering::None,
    };
    study.curve().expect("sand and gravity")
}

fn yaw_on(curve: &HeadingCurve, slope_deg: f64) -> f64 {
    curve.at(deg(slope_deg)).expect("it can be crossed").yaw.to_degrees()
}

/// A row of Table 4 [°]: slope; the model's yaw; the experiment's at the start and at the end.
const TABLE_4: [[f64; 4]; 4] = [
    [5.0, 3.4, 3.31, 0.56],
    [10.0, 5.5, 5.51, 3.10],
    [15.0, 11.0, 9.19, 8.75],
    [20.0, 15.5, 21.63, 12.05],
];

/// Source: [FourWheel], Table 4, rows "Model", 5 to 15°: within the ±1.5° that the theory allows
/// (section 4.4): ours are 1.3, 0.5 and 1.4° lower. DIFFERENCE: the wheel's radius and width and
/// the ratio λ are not printed there; ours are assumed.
#[test]
fn table_4_models_attitudes_up_to_15_degrees() {
    let curve = curve_with(given::toyoura(), LoadSharing::QuasiStatic);
    for [slope, model, ..] in &TABLE_4[..3] {
        let yaw = yaw_on(&curve, *slope);
        assert!((yaw - model).abs() < 1.5, "{yaw}° on {slope}°, not {model}°");
        assert!(yaw < *model, "ours are all below the paper's");
    }
}

/// Source: [FourWheel], Table 4, row "Model", 20°: 15.5°. DIFFERENCE: ours is 21.4°, beyond the
/// ±2.5° that the theory allows, and there the curve is steep: its fold is less than a degree away.
/// The measured start is 21.63°, and with K_x0 = 0.020 instead of 0.036 ours would be the paper's
/// 15.5°.
#[test]
fn table_4_models_attitude_on_20_degrees_is_not_ours() {
    let curve = curve_with(given::toyoura(), LoadSharing::QuasiStatic);
    let yaw = yaw_on(&curve, 20.0);
    assert!((yaw - 21.38).abs() < 0.01, "{yaw}°");
    assert!((yaw - 21.63).abs() < 0.5, "but the experiment started there");
    let (limit, _) = curve.limit().expect("it moves");
    assert!(limit > deg(20.0) && limit < deg(21.0), "{}°", limit.to_degrees());
    let stiffer = yaw_on(&curve_with(with_k_x(0.020), LoadSharing::QuasiStatic), 20.0);
    assert!((stiffer - 15.5).abs() < 0.5, "{stiffer}°");
}

/// Source: [FourWheel], Table 4 and Fig. 10, yaw at the start of the experiments: 3.31, 5.51, 9.19
/// and 21.63°. Ours are nearer than the paper's model on the two steep slopes.
#[test]
fn table_4_measured_starts() {
    let curve = curve_with(given::toyoura(), LoadSharing::QuasiStatic);
    for ([slope, model, measured, _], within) in TABLE_4.into_iter().zip([1.2, 0.5, 0.5, 0.5]) {
        let error = (yaw_on(&curve, slope) - measured).abs();
        assert!(error < within, "{error}° on {slope}°");
        assert!(slope < 12.0 || error < (model - measured).abs(), "{slope}°");
    }
}

/// Source: theory, section 4.4, the table of variants: yaw on 5, 10, 15 and 20° (none: 0).
/// DIFFERENCE: that table has H = 0.16 m, ours is 0.155 m: 0.1° up to 15°, more near the fold.
#[test]
fn variants_of_the_model_and_their_attitudes() {
    let soil = given::toyoura;
    let half = Exit::Ratio(0.5);
    let variants = [
        (soil(), [2.1, 5.0, 9.6, 21.7]),
        (Soil { bulldozing: Bulldozing::Sign, ..soil() }, [0.2, 2.5, 6.0, 12.4]),
        (Soil { bulldozing: Bulldozing::None, ..soil() }, [2.2, 5.3, 10.5, 0.0]),
        (Soil { exit: half, ..soil() }, [2.5, 6.1, 12.9, 0.0]),
        (with_k_x(0.030), [2.1, 4.9, 9.2, 18.2]),
        (with_k_x(0.025), [2.1, 4.8, 9.0, 16.7]),
        (with_k_x(0.020), [2.0, 4.8, 8.8, 15.7]),
    ];
    for (soil, yaws) in variants {
        let curve = curve_with(soil, LoadSharing::QuasiStatic);
        for ([slope, ..], printed) in TABLE_4.into_iter().zip(yaws) {
            let found = curve.at(deg(slope)).map_or(0.0, |attitude| attitude.yaw.to_degrees());
            let within = if slope < 18.0 { 0.15 } else { 0.5 };
            let message = format!("{soil:?} on {slope}°: {found}°, not {printed}°");
            assert!((found - printed).abs() < within, "{message}");
        }
    }
}

/// Source: [FourWheel], Table 4, γ_final of the model: equal to γ_initial in every row.
/// DIFFERENCE: on 20° ours loses 0.4°, for near the fold the yaw moment does not quite vanish.
#[test]
fn table_4_model_keeps_its_yaw() {
    let curve = curve_with(given::toyoura(), LoadSharing::QuasiStatic);
    for [slope, ..] in TABLE_4 {
        let yaw = deg(yaw_on(&curve, slope));
        let loss = Levelness::of(&given::run(&given::traverse(deg(slope), yaw))).yaw_loss;
        let within = if slope < 18.0 { 0.1 } else { 0.45 };
        assert!(loss.to_degrees().abs() < within, "{}° on {slope}°", loss.to_degrees());
    }
}

/// Source: [FourWheel], Table 4: the experiment lost 2.75, 2.41, 0.44 and 9.58° of yaw. DIFFERENCE:
/// the paper's model loses none. With the wheels' torque in the pitch balance ours loses 0.56, 1.4,
/// 2.9 and 7.2°: the right sign, and the right order but for the row of 15°.
#[test]
fn table_4_yaw_losses_have_the_sign_that_the_wheels_torque_gives_them() {
    let curve = curve_with(given::toyoura(), LoadSharing::QuasiStatic);
    let loss_on = |slope: f64, sharing| {
        let yaw = deg(yaw_on(&curve, slope));
        let run = given::run(&Scenario { sharing, ..given::traverse(deg(slope), yaw) });
        Levelness::of(&run).yaw_loss.to_degrees()
    };
    for [slope, _, start, end] in TABLE_4 {
        let (measured, ours) = (start - end, loss_on(slope, LoadSharing::QuasiStaticTorque));
        assert!(measured > 0.0 && ours > 0.5, "{ours}°, measured {measured}°");
        assert!(loss_on(slope, LoadSharing::QuasiStatic) < 0.2 * ours);
        // All but the row of 15°, where the experiment hardly turned.
        assert!(slope == 15.0 || (ours / measured > 0.2 && ours / measured < 1.0));
    }
}

/// Source: [FourWheel], Table 4, errors of the yaws: |measured − model| over the model's.
#[test]
fn table_4_errors_of_the_yaws_are_relative_to_the_model() {
    for ([_, model, start, end], (initial, last)) in
        TABLE_4.into_iter().zip([(2.40, 83.54), (0.10, 43.68), (16.45, 20.49), (39.56, 22.29)])
    {
        // In per cent. The first two rows come from a model's yaw printed with a digit less.
        let within = if model < 6.0 { 0.3 } else { 0.06 };
        assert!((100.0 * yaw_error(deg(start), deg(model)) - initial).abs() < within);
        assert!((100.0 * yaw_error(deg(end), deg(model)) - last).abs() < within);
    }
}

/// Source: [FourWheel], Fig. 9 and section 5.2: drift grows with the slope, and a yaw at the start
/// reduces it "drastically". DIFFERENCE: the figure's values are not printed; a factor of seven.
#[test]
fn fig_9_compensation_reduces_the_drift_drastically() {
    let mut least = 0.0;
    for [slope, _, start, _] in TABLE_4 {
        let drift = |yaw: f64| {
            let run = given::run(&given::traverse(deg(slope), deg(yaw)));
            Levelness::of(&run).final_distance_error
        };
        let (without, with) = (drift(0.0), drift(start));
        assert!(without > least, "{without} m on {slope}°");
        // On 5° the measured start turns the rover more than ours needs: it climbs.
        let factor = if slope < 6.0 { 1.5 } else { 7.0 };
        assert!(without > factor * with, "{without} m without, {with} m with, on {slope}°");
        least = without;
    }
}

/// Source: [FourWheel], Table 4: final distance errors of 3 to 28 mm, RMS errors of 3.6 to 13.3 %.
/// DIFFERENCE: those are the experiment's, which lost its yaw; ours are the model's own, with our
/// definition of the RMS error (its is not printed): smaller by far.
#[test]
fn table_4_distance_errors_of_the_model_are_below_the_measured_ones() {
    let curve = curve_with(given::toyoura(), LoadSharing::QuasiStatic);
    for ([slope, ..], (rms, last)) in TABLE_4.into_iter().zip([
        (0.0357, 0.003),
        (0.0600, 0.013),
        (0.0883, 0.011),
        (0.1334, 0.028),
    ]) {
        let yaw = deg(yaw_on(&curve, slope));
        let level = Levelness::of(&given::run(&given::traverse(deg(slope), yaw)));
        assert!(level.rms_distance_error < 0.1 * rms, "{}", level.rms_distance_error);
        assert!(level.final_distance_error < 0.5 * last, "{} m", level.final_distance_error);
    }
}

/// Source: [FourWheel], section 5.2: "reasonable … up to 15 degrees slope". Its wheels: no radius,
/// no width. Within what could be theirs the attitude on 10° moves by less than a degree and a
/// half.
#[test]
fn the_assumed_wheel_decides_little_on_10_degrees() {
    for radius in [0.10, 0.105, 0.115] {
        for width in [0.06, 0.10] {
            let wheel: Wheel = given::smooth_wheel(radius, width);
            let study = HeadingStudy {
                rover: given::rover_on(wheel, &given::HAKUTO_HUBS),
                soil: given::toyoura(),
                gravity: EARTH_GRAVITY,
                model: Model::Ishigami,
                sharing: LoadSharing::QuasiStatic,
                own_moments: OwnMoments::Neglected,
                stability: grouser::soil::SlopeStability::USUAL,
                steering: Steering::None,
            };
            let yaw = yaw_on(&study.curve().expect("sand and gravity"), 10.0);
            assert!((yaw - 5.04).abs() < 1.5, "{yaw}° with r {radius}, b {width} m");
        }
    }
}
