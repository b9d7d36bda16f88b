//! The ground's own strength: slopes that it holds, what it resists under a wheel, and the
//! experiment's second, untuned test.

use grouser::contact::{Contact, Ishigami, Model, Slip, WheelSoilModel, coulomb};
use grouser::document::{self, Kind, Overrides, Source, experiment};
use grouser::simulation::{
    Approach, Motion, Numerics, Outcome, PrescribedYaw, Run, Scenario, Start,
};
use grouser::soil::{Shear, ShearBound, SlopeStability, Soil};
use grouser::studies::comparison::{Levelness, MeasuredTraverse};
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::heading::{HeadingStudy, LimitedBy, NoHeading};
use grouser::studies::verdict::{Rule, SlopeStudy, Verdict};
use grouser::terrain::Ground;
use grouser::units::{
    EARTH_GRAVITY, MARS_GRAVITY, MOON_GRAVITY, STEEPEST_SLOPE, Vec2, deg, kpa, mm,
};
use grouser::vehicle::{DriveLaw, LoadSharing, OwnMoments};
use proptest::prelude::*;
use rayon::prelude::*;

use super::given::{self, run, traverse};

/// Every soil that comes with the library, with the model that it was made for.
fn preset_soils() -> Vec<(&'static str, Soil, Model)> {
    let read = |preset: &'static document::Preset| {
        let source = Source::find(Kind::Soil, preset.name).expect("a preset");
        let loaded = document::read_soil(&source, &Overrides::none()).expect("it is read");
        (preset.name, loaded.value, loaded.document.model().unwrap_or_default())
    };
    document::presets(Kind::Soil).map(read).collect()
}

/// With the complete load transfer, as everything that predicts has it.
fn study(soil: Soil, model: Model, gravity: f64) -> HeadingStudy {
    let (sharing, own_moments) = (LoadSharing::Complete, OwnMoments::Included);
    let base = HeadingStudy::of(&traverse(0.0, 0.0));
    HeadingStudy { soil, model, gravity, sharing, own_moments, ..base }
}

// ---- slopes ----

/// theory-2, section 11.6: contour traverses were found on 39.7° of sand whose friction angle is
/// 29°.
#[test]
fn no_slope_limit_is_above_what_the_ground_holds() {
    let places: Vec<_> = preset_soils()
        .into_iter()
        .flat_map(|(name, soil, model)| {
            [MOON_GRAVITY, MARS_GRAVITY, EARTH_GRAVITY]
                .map(|gravity| (name, study(soil, model.clone(), gravity)))
        })
        .collect();
    let ends: Vec<_> = places
        .par_iter()
        .map(|(name, study)| {
            let curve = study.curve().expect("it is a soil");
            let ground = study.soil.stable_slope(study.gravity, SlopeStability::USUAL);
            let beyond = ground + deg(0.1);
            let end = curve.limit();
            let g = study.gravity;
            println!("{name} {g}: {:?}", end.as_ref().map(|(s, r)| (s.to_degrees(), *r)));
            if let Ok((limit, reason)) = end {
                assert!(limit <= ground, "{name} at {} m/s²", study.gravity);
                let by = curve.limited_by().expect("it moves");
                assert_eq!(by == LimitedBy::GroundStrength, reason.contains("ground"), "{name}");
                assert_eq!(by == LimitedBy::Wheels, limit < ground, "{name}");
                if ground < STEEPEST_SLOPE {
                    let refused = curve.at(beyond).expect_err("no heading there");
                    assert!(refused.to_string().starts_with("ground-strength"), "{refused}");
                }
            }
            curve.limited_by()
        })
        .collect();
    for by in [LimitedBy::Wheels, LimitedBy::GroundStrength] {
        assert!(ends.contains(&Some(by)), "the presets show both ends, {by:?} too");
    }
}

/// A rover that goes straight downhill brakes on any slope; sand of 38° holds 31.0° with a factor
/// of safety of 1.3, and 38° with one of 1.
#[test]
fn downhill_the_ground_ends_the_curve() {
    let study = study(given::toyoura(), Model::Ishigami, EARTH_GRAVITY);
    for (factor_of_safety, limit) in [(1.3, (deg(38.0).tan() / 1.3).atan()), (1.0, deg(38.0))] {
        let stability = SlopeStability { factor_of_safety, ..SlopeStability::USUAL };
        let study = HeadingStudy { stability, ..study.clone() };
        let curve = study.curve_on(deg(-90.0)).expect("sand and gravity");
        let (found, _) = curve.limit().expect("it moves");
        assert_eq!(curve.limited_by(), Some(LimitedBy::GroundStrength));
        assert!((found - limit).abs() < 1e-12, "{}°", found.to_degrees());
        assert!(curve.at(limit - 1e-9).is_ok());
        let refused = curve.at(limit + 1e-9).expect_err("no heading there");
        assert_eq!(refused, NoHeading::GroundStrength { limit: found, factor_of_safety });
    }
}

#[test]
fn the_wheels_end_the_curve_of_the_paper_below_the_grounds_own_limit() {
    let curve = study(given::toyoura(), Model::Ishigami, EARTH_GRAVITY).curve().expect("sand");
    assert_eq!(curve.limited_by(), Some(LimitedBy::Wheels));
    assert!((curve.limit().expect("it moves").0.to_degrees() - 20.2).abs() < 0.5);
    // Between the two the wheels are the reason, and beyond both the ground is.
    assert!(matches!(curve.at(deg(25.0)), Err(NoHeading::TooSteep { .. })));
    assert!(matches!(curve.at(deg(32.0)), Err(NoHeading::GroundStrength { .. })));
}

#[test]
fn a_card_says_no_go_where_the_ground_slides() {
    let soil = Soil { friction_angle: deg(24.0), ..given::toyoura() };
    let heading = study(soil, Model::Ishigami, EARTH_GRAVITY);
    let ground = heading.ground_limit();
    let rule = Rule { go_slip_ratio: 0.9, no_go_slip_ratio: 0.95, ..Rule::DEFAULT };
    let slopes = [ground - deg(12.0), ground + deg(0.1)];
    // Of the samples, all hold the contour; the soil as written does not stand.
    let soil = Soil { friction_angle: deg(45.0), ..soil };
    let samples = [Sample { soil, model: Model::Ishigami }];
    let study = SlopeStudy {
        heading,
        rim_speed: 0.06,
        rule,
        is_uncertainty_stated: true,
        holds_heading: false,
    };
    let card = study.card(&samples, &slopes, &|| true).expect("a card").expect("not stopped");
    assert_eq!(card.rows[1].advice.judgement.verdict, Verdict::NoGo);
    assert!(card.rows[1].refusal.as_ref().is_some_and(|text| text.starts_with("ground-strength")));
    assert_ne!(card.rows[0].advice.judgement.verdict, Verdict::NoGo);
}

// ---- what the ground resists ----

fn bounded(soil: Soil) -> Soil {
    Soil { shear_bound: ShearBound::Coulomb, ..soil }
}

proptest! {
    /// The resultant of the shear stresses stays within the soil's strength, at every point of the
    /// rim.
    #[test]
    fn bounded_shear_stays_within_the_strength(
        soil in given::any_soil(),
        s in given::any_slip_ratio(),
        beta in deg(-89.0)..deg(89.0),
        depth in 0.01..0.8_f64,
    ) {
        let soil = bounded(soil);
        let contact = given::on_stand(soil, given::hakuto_wheel(), s.abs(), beta);
        let sinkage = depth * contact.wheel.shearing_radius();
        let field = grouser::contact::stress::StressField::new(&contact, sinkage);
        let (entry, exit) = (field.patch.entry, field.patch.exit);
        for step in 1..50 {
            let stress = field.at(exit + (entry - exit) * f64::from(step) / 50.0);
            let strength = soil.cohesion + stress.normal * soil.friction_angle.tan();
            let resultant = stress.longitudinal.hypot(stress.lateral);
            prop_assert!(resultant <= strength * (1.0 + 1e-12), "{resultant} of {strength} Pa");
        }
    }

    /// Along one axis alone the bound changes nothing in sand, bit for bit.
    #[test]
    fn a_wheel_that_does_not_slip_sideways_shears_as_without_the_bound(
        soil in given::any_sand(),
        s in 0.0..1.0,
    ) {
        let at = |soil: Soil, angle: f64| {
            let contact = given::on_stand(soil, given::hakuto_wheel(), s, 0.0);
            let field = grouser::contact::stress::StressField::new(&contact, mm(20.0));
            field.at(angle * field.patch.entry)
        };
        for share in [0.1, 0.4, 0.9] {
            prop_assert_eq!(
                at(bounded(soil), share),
                at(Soil { shear_bound: ShearBound::None, ..soil }, share)
            );
        }
    }

    /// Whatever its motion, a wheel gets no more from the ground than friction, cohesion and a
    /// wedge. (The small-wheel model piles soil up, and has a bound of its own.)
    #[test]
    fn a_wheels_horizontal_force_stays_within_what_the_ground_resists(
        soil in given::any_soil(),
        s in -1.0..1.0,
        beta in deg(-89.0)..deg(89.0),
        depth in 0.01..0.8_f64,
    ) {
        let contact = given::on_stand(bounded(soil), given::hakuto_wheel(), s, beta);
        let sinkage = depth * contact.wheel.shearing_radius();
        for model in [Model::Ishigami, Model::Bekker, Model::Rft] {
            let forces = model.as_ref().forces(&contact, sinkage);
            let most = coulomb::most_resistance(&contact, sinkage, &forces);
            let horizontal = forces.drawbar_pull.hypot(forces.side_force);
            prop_assert!(horizontal <= most * (1.0 + 1e-9), "{model:?}: {horizontal} of {most} N");
        }
    }
}

/// theory-2, section 11.6: the anisotropic law lets a locked wheel resist 1.35 W where tan φ =
/// 0.78.
#[test]
fn a_locked_wheel_resists_within_its_soils_friction() {
    let most = |soil: Soil| {
        let directions = (0..90).map(|step| deg(f64::from(step)));
        let of = |beta: f64| {
            let contact = given::on_stand(soil, given::hakuto_wheel(), -1.0, beta);
            let forces = given::settled(&Ishigami::DEFAULT, &contact, 17.0).forces;
            forces.drawbar_pull.hypot(forces.side_force) / 17.0
        };
        directions.map(of).fold(0.0, f64::max)
    };
    assert!(most(given::toyoura()) > 1.35, "{}", most(given::toyoura()));
    let friction = deg(38.0).tan();
    let with_bound = most(bounded(given::toyoura()));
    // The passive wedge of a wheel that sinks 20 mm: 5 % of its load.
    assert!(with_bound > friction && with_bound < friction * 1.08, "{with_bound}");
}

/// The steepest slope on which a rover with locked wheels stays, nose along or against the slope
/// [rad].
fn steepest_to_park_on(soil: Soil, model: &Model, yaw: f64) -> f64 {
    let stays = |slope: f64| {
        let parked = Scenario {
            ground: Ground::plane(soil, slope),
            model: model.clone(),
            drive: DriveLaw::Constant(0.0),
            start: Start { yaw, motion: Motion::Rest },
            duration: 3.0,
            numerics: Numerics { sample_interval: 3.0, ..Numerics::default() },
            ..traverse(slope, yaw)
        };
        run(&parked).outcome == Outcome::Completed
    };
    let (mut low, mut high) = (0.0, STEEPEST_SLOPE);
    for _ in 0..9 {
        let middle = 0.5 * (low + high);
        if stays(middle) { low = middle } else { high = middle }
    }
    low
}

/// Today's presets without cohesion, and sand of the paper: a parked rover slides between the
/// friction that its wheels mobilise and its soil's friction angle, where no wedge lies safe below
/// it any more.
#[test]
fn a_parked_rover_on_sand_slides_at_about_the_friction_angle() {
    let sands = preset_soils()
        .into_iter()
        .filter(|(_, soil, _)| soil.shear_bound == ShearBound::Coulomb)
        .map(|(name, soil, model)| (name, Soil { cohesion: 0.0, ..soil }, model))
        // A law by cohesion alone carries nothing without it.
        .filter(|(_, soil, _)| soil.check().is_ok() && carries(soil))
        // On steeper slopes the rover tips over its rear wheels before it slides.
        .filter(|(_, soil, _)| soil.friction_angle < deg(47.0))
        .chain([("toyoura, bounded", bounded(given::toyoura()), Model::Ishigami)]);
    let places: Vec<_> = sands.flat_map(|sand| [(sand.clone(), 0.0), (sand, deg(90.0))]).collect();
    assert!(places.len() > 20);
    let found: Vec<f64> = places
        .par_iter()
        .map(|((_, soil, model), yaw)| steepest_to_park_on(*soil, model, *yaw).to_degrees())
        .collect();
    for (((name, soil, _), yaw), found) in places.iter().zip(found) {
        let phi = soil.friction_angle.to_degrees();
        let mobilised = soil.mobilised_friction().atan().to_degrees();
        assert!(
            found > mobilised - 1.0 && found < phi + 0.1,
            "{name} at a yaw of {yaw}: {found}°, φ {phi}°"
        );
    }
    let unbounded = steepest_to_park_on(given::toyoura(), &Model::Ishigami, 0.0).to_degrees();
    assert!(unbounded > 40.0, "without the bound: {unbounded}°");
}

fn carries(soil: &Soil) -> bool {
    let stiffness = soil.pressure_sinkage.stiffness(0.08, soil.cohesion, 1e4, 0.0);
    stiffness.pressure(0.02) > 0.0
}

/// At the shear law's edge nothing jumps: the bound sets in where the two are equal.
#[test]
fn the_bound_sets_in_without_a_jump() {
    let soil = bounded(given::toyoura());
    let forces = |beta: f64| {
        let contact = given::on_stand(soil, given::hakuto_wheel(), -0.6, beta);
        Ishigami::DEFAULT.forces(&contact, mm(15.0))
    };
    let mut last = forces(0.0);
    for step in 1..=9000 {
        let next = forces(deg(f64::from(step) * 0.009));
        let change = Vec2::new(next.drawbar_pull, next.side_force)
            - Vec2::new(last.drawbar_pull, last.side_force);
        assert!(change.norm() < 0.02 * last.normal_force, "{}°: {change}", f64::from(step) * 0.009);
        last = next;
    }
}

#[test]
fn a_cohesive_soil_resists_by_its_cohesion_over_the_contact() {
    let soil = |cohesion: f64| bounded(Soil { cohesion, ..given::toyoura() });
    let most = |cohesion: f64| {
        let contact = Contact {
            wheel: given::hakuto_wheel(),
            soil: soil(cohesion),
            slip: Slip::on_test_stand(-1.0, 0.0),
            gravity: EARTH_GRAVITY,
        };
        let forces = Ishigami::DEFAULT.forces(&contact, mm(10.0));
        // As much of it as the wheel's pressure keeps from tension.
        let tension = cohesion * deg(38.0).cos() / forces.max_normal_stress;
        let cohesion = cohesion / (1.0 + tension * tension).sqrt();
        let (patch, r) = (forces.patch, contact.wheel.shearing_radius());
        let length = r * (patch.entry.sin() - patch.exit.sin());
        let root = 1.0 / soil(cohesion).destructive_angle().tan();
        let weight = soil(cohesion).unit_weight(EARTH_GRAVITY);
        let wedge = 0.08 * (0.5 * root * root * weight * 1e-4 + 2.0 * cohesion * root * 0.01);
        let expected = forces.normal_force * deg(38.0).tan() + cohesion * 0.08 * length + wedge;
        (coulomb::most_resistance(&contact, mm(10.0), &forces), expected)
    };
    for cohesion in [0.0, kpa(0.2), kpa(2.0)] {
        let (found, expected) = most(cohesion);
        assert!((found / expected - 1.0).abs() < 1e-12, "{found}, not {expected} N");
    }
}

#[test]
fn isotropic_shear_has_the_same_stresses_with_the_bound() {
    let isotropic = Shear::Isotropic { modulus: given::linear(0.02, 0.0) };
    let soil = Soil { shear: isotropic, ..given::toyoura() };
    let at = |soil: Soil| {
        let contact = given::on_stand(soil, given::hakuto_wheel(), 0.3, deg(20.0));
        Ishigami::DEFAULT.forces(&contact, mm(15.0))
    };
    assert_eq!(at(soil), at(bounded(soil)));
}

// ---- complete load transfer ----

/// Source: theory-2, section 12, first row: 20 s from the measured starts lose 0.55, 1.30, 2.49 and
/// 6.05° of yaw with the complete wrench of the wheels.
#[test]
fn the_complete_load_transfer_loses_the_yaw_of_the_independent_computation() {
    for (measured, lost) in experiment::table_4().iter().zip([0.55, 1.30, 2.49, 6.05]) {
        let scenario = Scenario {
            sharing: LoadSharing::Complete,
            own_moments: OwnMoments::Included,
            ..traverse(measured.slope, measured.initial_yaw)
        };
        let found = Levelness::of(&run(&scenario)).yaw_loss.to_degrees();
        assert!((found - lost).abs() < 0.015, "{found}°, not {lost}°");
    }
}

#[test]
fn complete_is_torque_and_own_moments_together() {
    let with = |sharing: LoadSharing| Scenario {
        sharing,
        own_moments: OwnMoments::Included,
        ..traverse(deg(10.0), deg(5.0))
    };
    let both = [LoadSharing::Complete, LoadSharing::QuasiStaticTorque].map(with);
    let [complete, torque] = both.map(|scenario| run(&scenario));
    assert_eq!(complete, torque);
    let neglected = Scenario { own_moments: OwnMoments::Neglected, ..with(LoadSharing::Complete) };
    assert!(Run::new(&neglected).is_err(), "a complete load transfer without moments is none");
    assert!(HeadingStudy::of(&neglected).curve().is_err());
}

// ---- prescribed yaw ----

fn held(points: Vec<(f64, f64)>, scenario: Scenario) -> Scenario {
    let start = Start { yaw: 0.0, ..scenario.start };
    Scenario { yaw: Some(PrescribedYaw { points }), start, ..scenario }
}

fn at_measured_yaw(measured: &MeasuredTraverse) -> Scenario {
    let points = vec![(0.0, measured.initial_yaw), (20.0, measured.final_yaw)];
    held(points, traverse(measured.slope, 0.0))
}

/// Source: theory-2, section 11.3: at the measured yaw, linear over 20 s, the rover drifts by −4,
/// −14, −10 and −45 mm. [FourWheel], Table 4, prints 3, 13, 11 and 28 mm without a sign.
#[test]
fn the_drift_at_the_measured_yaw_is_that_of_the_independent_computation() {
    for (measured, drift) in experiment::table_4().iter().zip([-4.0, -14.0, -10.0, -45.0]) {
        let found = 1e3 * run(&at_measured_yaw(measured)).last().state.position.y;
        // Printed to a millimetre.
        assert!((found - drift).abs() < 1.0, "{found} mm, not {drift}");
    }
}

/// The heading offset leaves a yaw moment over. Held against it the rover stays on the contour,
/// whatever the load transfer.
#[test]
fn a_rover_held_at_its_heading_offset_holds_the_contour() {
    for (sharing, own_moments) in [
        (LoadSharing::QuasiStatic, OwnMoments::Neglected),
        (LoadSharing::Complete, OwnMoments::Included),
    ] {
        let scenario = Scenario { sharing, own_moments, ..traverse(deg(15.0), 0.0) };
        let curve = HeadingStudy::of(&scenario).curve().expect("sand and gravity");
        let yaw = curve.at(deg(15.0)).expect("it can be crossed").yaw;
        let end = run(&held(vec![(0.0, yaw)], scenario)).last().state.position;
        // The rolling start does not slip yet as it will.
        assert!(end.y.abs() < 1e-4 && end.x > 0.8, "{sharing:?}: {end}");
    }
}

/// A run that is held at the yaw that it would take by itself goes the same way.
#[test]
fn a_run_at_its_own_yaw_is_itself() {
    let free =
        Scenario { sharing: LoadSharing::QuasiStaticTorque, ..traverse(deg(15.0), deg(9.0)) };
    let path = run(&free);
    let points = path.records.iter().map(|record| (record.time, record.state.yaw)).collect();
    let same = run(&held(points, free));
    for (one, other) in path.records.iter().zip(&same.records).skip(1) {
        let apart = (one.state.position - other.state.position).norm();
        // The yaw between samples is a chord: the way differs by less than a twentieth of a
        // millimetre.
        assert!(apart < 5e-5, "{apart} m at {} s", one.time);
    }
}

#[test]
fn both_ways_through_time_follow_the_yaw_and_agree() {
    let points = vec![(0.0, deg(8.0)), (5.0, deg(8.0)), (12.0, deg(-4.0)), (30.0, deg(2.0))];
    let dynamic = held(points.clone(), traverse(deg(12.0), 0.0));
    let numerics = Numerics { approach: Approach::QuasiSteady, ..dynamic.numerics };
    let steady = Scenario { numerics, ..dynamic.clone() };
    let course = PrescribedYaw { points };
    let [one, other] = [run(&dynamic), run(&steady)];
    assert_eq!(other.method.name(), "quasi-steady");
    for (one, other) in one.records.iter().zip(&other.records) {
        assert!((one.state.yaw - course.at(one.time)).abs() < 1e-6, "at {} s", one.time);
        assert!((other.state.yaw - course.at(one.time)).abs() < 1e-6, "at {} s", one.time);
        let apart = (one.state.position - other.state.position).norm();
        // Slip settles once at the start, over a millimetre of the way.
        assert!(apart < 1e-3, "{apart} m at {} s", one.time);
    }
}

/// What holds the yaw works with the motors: nothing is lost or won.
#[test]
fn energy_is_balanced_while_the_yaw_is_held() {
    let points = vec![(0.0, 0.0), (4.0, deg(60.0)), (5.0, deg(60.0)), (20.0, deg(-30.0))];
    let path = run(&held(points, traverse(deg(8.0), 0.0)));
    let (first, last) = (path.records[0].energy, path.last().energy);
    let stored = (last.kinetic - first.kinetic) + (last.potential - first.potential);
    let left_over = (last.motors - first.motors) - (last.soil - first.soil) - stored;
    assert!(left_over.abs() < 1e-4 * last.motors, "{left_over} J of {} J", last.motors);
}

#[test]
fn steps_turn_where_the_yaw_does() {
    let scenario = held(vec![(0.0, 0.0), (1.05, deg(5.0)), (3.0, 0.0)], traverse(deg(10.0), 0.0));
    let whole = run(&Scenario { duration: 4.0, ..scenario.clone() });
    let mut steps = Run::new(&scenario).expect("a run");
    while steps.now().time < 4.0 - 1e-9 {
        steps.step(&[0.06; 4], 0.5).expect("it is computed");
    }
    let (one, other) = (whole.last().state, steps.now().state);
    assert!((one.yaw - other.yaw).abs() < 1e-9 && (one.position - other.position).norm() < 1e-6);
}

#[test]
fn a_start_that_contradicts_the_yaw_is_refused() {
    let course = held(vec![(0.0, deg(3.0)), (20.0, 0.0)], traverse(deg(10.0), 0.0));
    assert!(Run::new(&course).is_ok());
    let start = Start { yaw: deg(5.0), ..course.start };
    assert!(Run::new(&Scenario { start, ..course }).is_err());
}
