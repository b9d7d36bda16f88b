//! What the extended theory must obey, and how well it agrees with measurements.

use grouser::contact::coulomb_cone::largest_horizontal_force;
use grouser::contact::{
    Contact, Ishigami, Model, SettleError, Settled, Slip, SmallWheel, WheelForces, WheelSoilModel,
    settle,
};
use grouser::document::{self, Kind, Overrides, Source};
use grouser::soil::small_wheel::{Interface, Mounds, SideWall, SinkageGrowth};
use grouser::soil::{
    self, PressureSinkage, Shear, ShearBound, ShearModulus, SinkageExponent, SlopeStability, Soil,
};
use grouser::studies::heading::HeadingStudy;
use grouser::units::{EARTH_GRAVITY, MOON_GRAVITY, Vec2, deg};
use grouser::vehicle::{LoadSharing, OwnMoments};
use grouser::wheel::Wheel;
use proptest::prelude::*;

const SOILS: [&str; 2] = ["smooth", "grouser"];

fn soil(name: &str) -> Soil {
    let source = Source::find(Kind::Soil, name).expect("a preset");
    document::read_soil(&source, &Overrides::none()).expect("it is read").value
}

fn wheel(name: &str) -> Wheel {
    let source = Source::find(Kind::Wheel, name).expect("a preset");
    document::read_wheel(&source, &Overrides::none()).expect("it is read").value
}

/// A wheel of the test series on its sand.
fn cmu(kind: &str, slip: Slip) -> Contact {
    let wheel = wheel(&format!("cmu-{kind}"));
    let soil = soil(&format!("cmu-direct90-{kind}"));
    Contact { wheel, soil, slip, gravity: EARTH_GRAVITY }
}

fn settled(contact: &Contact, load: f64) -> Result<Settled, SettleError> {
    settle(&SmallWheel::DEFAULT, contact, load)
}

/// The same sand, with a stiffness that knows gravity and width: equal at 1 g and b = 50 mm.
fn gravity_aware(soil: &Soil, width: f64) -> Soil {
    let PressureSinkage::Bekker { k_phi, exponent, .. } = soil.pressure_sinkage else {
        panic!("the fitted soils follow Bekker's law");
    };
    let n = exponent.at(0.0);
    let k_phi = k_phi * width.powf(n) / (soil.unit_weight(EARTH_GRAVITY) * width);
    let exponent = SinkageExponent::constant(n);
    Soil { pressure_sinkage: PressureSinkage::Reece { k_c: 0.0, k_phi, exponent }, ..*soil }
}

/// Any motion of rim and hub: [m/s], both senses, rest included.
fn any_motion() -> impl Strategy<Value = (f64, f64, f64)> {
    let speed = prop_oneof![Just(0.0), -0.2..0.2, -1e-7..1e-7, Just(0.05)];
    (speed.clone(), speed.clone(), speed)
}

/// The horizontal force of the soil on the wheel [N].
fn horizontal(forces: &WheelForces) -> f64 {
    forces.drawbar_pull.hypot(forces.side_force)
}

/// tan φ N + c A, and what the wedges of soil in front and at one side resist [N]: each weighs as
/// much as the piled-up wall's own wedge with the pile on it, and slides up a plane at 45° − φ/2.
pub(crate) fn friction_and_wedges(contact: &Contact, load: f64, sinkage: f64) -> f64 {
    const STRIPS: u32 = 2000;
    let Contact { wheel, soil, gravity, .. } = contact;
    let (phi, r) = (soil.friction_angle, wheel.shearing_radius());
    let plane = deg(45.0) - phi / 2.0;
    let per_metre = |depth: f64| {
        let height = depth * (1.0 + phi.tan() / plane.tan());
        let reach = height / plane.tan();
        let weight =
            soil.unit_weight(*gravity) * (0.5 * height * reach + 0.5 * reach * reach * phi.tan());
        let share = soil.small_wheel.wedge_share;
        share * weight * (plane + phi).tan() + 2.0 * soil.cohesion * height / plane.tan()
    };
    let half_chord = (sinkage * (2.0 * r - sinkage)).sqrt();
    let strip = 2.0 * half_chord / f64::from(STRIPS);
    let side: f64 = (0..STRIPS)
        .map(|number| strip * (f64::from(number) + 0.5) - half_chord)
        .map(|x| strip * per_metre((r * r - x * x).sqrt() - (r - sinkage)))
        .sum();
    let arc = 2.0 * (1.0 - sinkage / r).acos();
    load * phi.tan()
        + soil.cohesion * wheel.width * r * arc
        + wheel.width * per_metre(sinkage)
        + side
}

/// Sand to clay, with terms of any size and either law of shear.
fn any_soil() -> impl Strategy<Value = Soil> {
    let ground = (0.0..5e3, 8.0..50.0, 500.0..3000.0, 5.0..8.0, 0.3..2.0, any::<bool>());
    let terms = (0.0..5.0, 0.0..10.0, 0.0..20.0, 0.0..1.0, 0.0..20.0, 0.0..20.0);
    (ground, terms).prop_map(|(ground, terms)| {
        let (cohesion, phi, density, stiffness, n, isotropic) = ground;
        let (with_slip, locked, pressure_factor, friction, bow_wave, rear_mound) = terms;
        let modulus = ShearModulus::constant(0.01);
        let general = soil::SmallWheel::GENERAL;
        Soil {
            cohesion,
            friction_angle: deg(phi),
            density,
            pressure_sinkage: PressureSinkage::Bekker {
                k_c: 0.0,
                k_phi: 10_f64.powf(stiffness),
                exponent: SinkageExponent::constant(n),
            },
            shear: if isotropic {
                Shear::Isotropic { modulus }
            } else {
                Shear::Anisotropic { longitudinal: modulus, lateral: modulus }
            },
            small_wheel: soil::SmallWheel {
                sinkage: SinkageGrowth { with_slip, locked, ..general.sinkage },
                side_wall: SideWall { pressure_factor, friction, fading: 0.0 },
                mounds: Mounds { bow_wave, rear_mound },
                ..general
            },
            ..soil("cmu-direct90-smooth")
        }
    })
}

fn any_kind() -> impl Strategy<Value = &'static str> {
    prop_oneof![Just(SOILS[0]), Just(SOILS[1])]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn without_its_terms_it_is_the_classical_model_to_the_last_bit_within_the_cone(
        name in prop_oneof![Just("toyoura"), Just("direct-90"), Just("toyoura-lab-2012")],
        (rim, v_x, v_y) in any_motion(),
        sinkage in 1e-6..0.05,
    ) {
        let slip = Slip::of_motion(rim, Vec2::new(v_x, v_y));
        let (small_wheel, shear_bound) = (soil::SmallWheel::OFF, ShearBound::None);
        let soil = Soil { small_wheel, shear_bound, ..soil(name) };
        let contact = Contact { wheel: wheel("cmu-grouser"), soil, slip, gravity: EARTH_GRAVITY };
        let (ours, theirs) = (
            SmallWheel::DEFAULT.forces(&contact, sinkage),
            Ishigami::DEFAULT.forces(&contact, sinkage),
        );
        if horizontal(&theirs) <= largest_horizontal_force(&contact, &theirs, sinkage) {
            prop_assert_eq!(ours, theirs);
        } else {
            prop_assert!(horizontal(&ours) < horizontal(&theirs));
            prop_assert_eq!(ours.normal_force, theirs.normal_force);
        }
    }

    /// Coulomb's law on every plane on which the ground fails, by wedges that are weighed here:
    /// whatever the terms are, the ground resists no more than that.
    #[test]
    fn no_wheel_pushes_harder_than_the_ground_resists(
        soil in any_soil(),
        (rim, v_x, v_y) in any_motion(),
        share in 0.0..1.0_f64,
        steepness in prop_oneof![Just(0.0), 0.0..1.0],
    ) {
        let slip = Slip::of_motion(rim, Vec2::new(v_x, v_y));
        let soil = soil.on_slope(steepness);
        let contact = Contact { wheel: wheel("cmu-grouser"), soil, slip, gravity: EARTH_GRAVITY };
        let sinkage = share * contact.wheel.shearing_radius();
        let forces = SmallWheel::DEFAULT.forces(&contact, sinkage);
        let most = friction_and_wedges(&contact, forces.normal_force, sinkage);
        // The sides of a wheel are parabolas there, and segments of a circle here: a little more.
        prop_assert!(horizontal(&forces) <= most * (1.0 + 1e-9), "{forces:?} > {most}");
    }

    /// A wheel either carries its load, or the soil carries less than that at every sinkage.
    #[test]
    fn any_load_is_carried_or_sinks_to_the_axle(
        kind in any_kind(),
        (rim, v_x, v_y) in any_motion(),
        load in (-1.0..3.0).prop_map(|power: f64| 10_f64.powf(power)),
    ) {
        let contact = cmu(kind, Slip::of_motion(rim, Vec2::new(v_x, v_y)));
        match settled(&contact, load) {
            Ok(settled) => {
                prop_assert!((settled.forces.normal_force / load - 1.0).abs() < 1e-9);
                prop_assert!(settled.sinkage > 0.0);
                prop_assert!(settled.sinkage <= contact.wheel.shearing_radius());
            }
            Err(SettleError::SunkToAxle { capacity, .. }) => prop_assert!(capacity < load),
            Err(error) => return Err(TestCaseError::fail(error.to_string())),
        }
    }

    #[test]
    fn forces_are_finite_for_any_motion_and_sinkage(
        kind in any_kind(),
        (rim, v_x, v_y) in any_motion(),
        share in 0.0..=1.0_f64,
    ) {
        let contact = cmu(kind, Slip::of_motion(rim, Vec2::new(v_x, v_y)));
        let forces = SmallWheel::DEFAULT.forces(&contact, share * contact.wheel.shearing_radius());
        for value in [
            forces.drawbar_pull, forces.side_force, forces.normal_force, forces.torque,
            forces.overturning_moment, forces.aligning_moment, forces.max_normal_stress,
        ] {
            prop_assert!(value.is_finite());
        }
    }

    /// Nothing jumps: a step of 1e-5 in slip or slip angle moves no force by 0.2 % of the load.
    /// (The steepest place, a wheel that begins to slide sideways, has about 60 loads per unit.)
    #[test]
    fn forces_are_continuous_in_slip_and_slip_angle(
        kind in any_kind(),
        slip in -1.0..0.98,
        degrees in -80.0..80.0,
    ) {
        const STEP: f64 = 1e-5;
        let load = 15.0;
        let at = |slip, angle| settled(&cmu(kind, Slip::on_test_stand(slip, angle)), load);
        let here = at(slip, deg(degrees)).expect("the sand carries the wheel");
        for there in [at(slip + STEP, deg(degrees)), at(slip, deg(degrees) + STEP)] {
            let there = there.expect("the sand carries the wheel");
            let close = 2e-3 * load;
            let (one, two) = (here.forces, there.forces);
            prop_assert!((one.drawbar_pull - two.drawbar_pull).abs() < close);
            prop_assert!((one.side_force - two.side_force).abs() < close);
            prop_assert!((one.torque - two.torque).abs() < close * 0.0625);
            prop_assert!((here.sinkage - there.sinkage).abs() < 1e-4);
        }
    }

    /// Left and right are alike.
    #[test]
    fn a_mirrored_motion_has_the_mirrored_side_force(
        kind in any_kind(),
        (rim, v_x, v_y) in any_motion(),
    ) {
        let at = |v_y| {
            let contact = cmu(kind, Slip::of_motion(rim, Vec2::new(v_x, v_y)));
            SmallWheel::DEFAULT.forces(&contact, 0.02)
        };
        let (left, right) = (at(v_y), at(-v_y));
        prop_assert!((left.side_force + right.side_force).abs() < 1e-9);
        prop_assert!((left.drawbar_pull - right.drawbar_pull).abs() < 1e-9);
    }

    /// Granular scaling: without cohesion, weight and load grow together and nothing else moves.
    #[test]
    fn gravity_scales_every_force_and_no_sinkage(
        kind in any_kind(),
        slip in -1.0..1.0,
        degrees in 0.0..80.0,
        load in 1.0..15.0,
    ) {
        let earth = cmu(kind, Slip::on_test_stand(slip, deg(degrees)));
        let soil = gravity_aware(&earth.soil, earth.wheel.width);
        let earth = Contact { soil, ..earth };
        let moon = Contact { gravity: MOON_GRAVITY, ..earth };
        let share = MOON_GRAVITY / EARTH_GRAVITY;
        let one = settled(&earth, load).expect("the sand carries the wheel");
        let two = settled(&moon, load * share).expect("the sand carries the wheel");
        prop_assert!((one.sinkage - two.sinkage).abs() < 1e-9 * one.sinkage);
        prop_assert!((one.forces.drawbar_pull * share - two.forces.drawbar_pull).abs() < 1e-6);
        prop_assert!((one.forces.side_force * share - two.forces.side_force).abs() < 1e-6);
    }

    /// A wheel twice as large with eight times the load leaves the same picture, provided that
    /// the shear modulus, a length, grows with it.
    #[test]
    fn size_scales_every_length_and_its_cube_every_force(
        kind in any_kind(),
        slip in -1.0..1.0,
        degrees in 0.0..80.0,
        size in 0.5..5.0_f64,
    ) {
        let small = cmu(kind, Slip::on_test_stand(slip, deg(degrees)));
        let soil = gravity_aware(&small.soil, small.wheel.width);
        let small = Contact { soil, wheel: Wheel { radius: 0.0625, grousers: None, ..small.wheel }, ..small };
        let Shear::Isotropic { modulus } = soil.shear else { panic!("the soils are isotropic") };
        let modulus = ShearModulus::constant(modulus.at(0.0) * size);
        let large = Contact {
            soil: Soil { shear: Shear::Isotropic { modulus }, ..soil },
            wheel: Wheel { radius: 0.0625 * size, width: 0.05 * size, grousers: None },
            ..small
        };
        let one = settled(&small, 12.0).expect("the sand carries the wheel");
        let two = settled(&large, 12.0 * size.powi(3)).expect("the sand carries the wheel");
        prop_assert!((one.sinkage * size / two.sinkage - 1.0).abs() < 1e-9);
        let pull = two.forces.drawbar_pull / size.powi(3);
        prop_assert!((one.forces.drawbar_pull - pull).abs() < 1e-6);
    }

    /// The soil takes power from rim and hub together; it never gives any.
    #[test]
    fn the_soil_is_passive(kind in any_kind(), (rim, v_x, v_y) in any_motion()) {
        let contact = cmu(kind, Slip::of_motion(rim, Vec2::new(v_x, v_y)));
        let forces = SmallWheel::DEFAULT.forces(&contact, 0.015);
        let turning = forces.torque * rim / contact.wheel.shearing_radius();
        let moving = forces.drawbar_pull * v_x + forces.side_force * v_y;
        // Sinking is held up from outside: a rim that climbs its own front slope gains nothing.
        let speed = rim.abs() + v_x.hypot(v_y);
        prop_assert!(moving - turning <= 1e-9 + 0.2 * forces.normal_force * speed);
    }
}

/// Down to the axle the soil's capacity grows as the pressure–sinkage law lets it, F_z ∝ h^(n + ½),
/// or more slowly: nothing holds a wheel up there but the soil.
#[test]
fn no_wall_holds_a_wheel_at_its_axle() {
    for kind in SOILS {
        for slip in [-1.0, -0.5, 0.0, 0.3, 0.6, 0.9] {
            for degrees in [0.0, 30.0, 60.0, 85.0] {
                let contact = cmu(kind, Slip::on_test_stand(slip, deg(degrees)));
                let PressureSinkage::Bekker { exponent, .. } = contact.soil.pressure_sinkage else {
                    panic!("the fitted soils follow Bekker's law");
                };
                let force = |share: f64| {
                    let sinkage = share * contact.wheel.shearing_radius();
                    SmallWheel::DEFAULT.forces(&contact, sinkage).normal_force
                };
                for percent in 50..100 {
                    let (here, deeper) =
                        (f64::from(percent) / 100.0, f64::from(percent + 1) / 100.0);
                    let power = (force(deeper) / force(here)).ln() / (deeper / here).ln();
                    assert!(power < exponent.at(0.0) + 0.5, "{kind}, {slip}, {degrees}°: {power}");
                }
            }
        }
    }
}

/// A locked wheel digs deeper and deeper with its load, without a jump, until it has sunk to the
/// axle: then no sinkage carries it, and the most that the soil carries is reported.
#[test]
fn locked_wheels_sink_to_the_axle_without_a_jump() {
    for kind in SOILS {
        for degrees in [0.0, 30.0, 60.0, 85.0] {
            let contact = cmu(kind, Slip::on_test_stand(-1.0, deg(degrees)));
            let axle = contact.wheel.shearing_radius();
            let mut last = 0.0;
            let mut load = 0.0;
            let capacity = loop {
                load += 0.25;
                match settled(&contact, load) {
                    Ok(Settled { sinkage, .. }) => {
                        assert!(sinkage > last && sinkage < last + 0.1 * axle, "{kind}, {load} N");
                        last = sinkage;
                    }
                    Err(SettleError::SunkToAxle { capacity, .. }) => break capacity,
                    Err(error) => panic!("{error}"),
                }
            };
            assert!(last > 0.98 * axle, "{kind}, {degrees}°: {last} m at {load} N");
            assert!((load - 0.25..load).contains(&capacity), "{kind}, {degrees}°: {capacity} N");
            let at_axle = SmallWheel::DEFAULT.forces(&contact, axle).normal_force;
            assert!((capacity / at_axle - 1.0).abs() < 1e-9, "{capacity} N, {at_axle} N");
        }
    }
}

/// On cohesionless sand no slope steeper than the angle of friction can be crossed: all wheels
/// together resist no more than tan φ times what they carry there. The heading offset of a rover
/// whose wheels could push off against mounds and walls of soil for ever ends there too.
#[test]
fn no_contour_is_held_on_sand_steeper_than_its_angle_of_friction() {
    for name in ["cmu-direct90-smooth", "cmu-direct90-grouser", "dry-sand", "toyoura"] {
        for gravity in [EARTH_GRAVITY, MOON_GRAVITY] {
            let ours = soil(name);
            let soil = Soil { cohesion: 0.0, ..ours };
            let limit = steepest_contour(soil, gravity);
            assert!(limit <= soil.friction_angle + 1e-9, "{name}: {limit} rad");
            let mut mounds = soil;
            mounds.small_wheel.mounds.rear_mound = 20.0;
            mounds.small_wheel.side_wall.pressure_factor = 20.0;
            let limit = steepest_contour(mounds, gravity);
            assert!(limit <= soil.friction_angle + 1e-9, "{name}: {limit} rad with mounds");
            assert!(limit > 0.5 * soil.friction_angle, "{name}: {limit} rad with mounds");
        }
    }
}

fn steepest_contour(soil: Soil, gravity: f64) -> f64 {
    // The wheels alone: the ground's own strength ends no curve with so small a factor of safety.
    let stability = SlopeStability { factor_of_safety: 0.1, ..SlopeStability::USUAL };
    let model = Model::SmallWheel;
    // Without the wheels' torque in the loads: beyond any mound a rover would tip over first.
    let (sharing, own_moments) = (LoadSharing::QuasiStatic, OwnMoments::Neglected);
    let base = heading_study();
    let study = HeadingStudy { soil, gravity, model, stability, sharing, own_moments, ..base };
    study.curve().expect("a soil").limit().expect("it moves").0
}

fn heading_study() -> HeadingStudy {
    let source = Source::find(Kind::Scenario, "traverse-10-deg").expect("a preset");
    let scenario = document::read_scenario(&source, &Overrides::none()).expect("it is read");
    HeadingStudy::of(&scenario.value)
}

/// Source: Rankine's pressures below a surface inclined by α: their coefficients are
/// cos α (cos α ± √(cos² α − cos² φ))/(cos α ∓ √(cos² α − cos² φ)).
#[test]
fn on_a_slope_wedges_resist_as_rankine_has_it() {
    let sand = soil("cmu-direct90-smooth");
    let phi = sand.friction_angle;
    let resistance = |slope: f64| {
        let (cos, root) = (slope.cos(), (slope.cos().powi(2) - phi.cos().powi(2)).sqrt());
        cos * (cos + root) / (cos - root) - cos * (cos - root) / (cos + root)
    };
    for degrees in [0.0, 5.0, 15.0, 25.0, 28.9] {
        let slope = deg(degrees);
        let share = sand.on_slope(slope.tan()).small_wheel.wedge_share;
        assert!((share - resistance(slope) / resistance(0.0)).abs() < 1e-9, "{degrees}°: {share}");
    }
    for degrees in [29.0 + 1e-9, 35.0, 80.0] {
        assert_eq!(sand.on_slope(deg(degrees).tan()).small_wheel.wedge_share, 0.0);
    }
}

/// A document without the table means the general values, not that the terms are off; and a key
/// that it leaves out has its own.
#[test]
fn what_a_soil_does_not_state_has_its_general_value() {
    let general = soil::SmallWheel::GENERAL;
    assert_eq!(soil("toyoura").small_wheel, general);
    let set = Overrides::parse(&["soil.small_wheel.mounds.bow_wave=1".to_owned()]).expect("a key");
    let source = Source::find(Kind::Soil, "toyoura").expect("a preset");
    let stated = document::read_soil(&source, &set).expect("it is read").value.small_wheel;
    let mounds = Mounds { bow_wave: 1.0, ..general.mounds };
    assert_eq!(stated, soil::SmallWheel { mounds, ..general });
}

/// On a smooth rim δ is a share of φ; between grousers soil slides on soil; a stated δ is that of
/// any wheel.
#[test]
fn a_smooth_rim_has_a_share_of_the_soils_friction() {
    let slip = Slip::on_test_stand(0.4, deg(10.0));
    let forces = |kind: &str, friction_angle: Option<f64>, friction_share: f64| {
        let mut contact = cmu(kind, slip);
        contact.soil.small_wheel.interface = Interface { friction_angle, friction_share };
        SmallWheel::DEFAULT.forces(&contact, 0.02)
    };
    let phi = soil("cmu-direct90-smooth").friction_angle;
    for share in [0.5, 2.0 / 3.0] {
        assert_eq!(forces("smooth", None, share), forces("smooth", Some(share * phi), 1.0));
        assert_eq!(forces("grouser", None, share), forces("grouser", None, 1.0));
        let rough = forces("smooth", None, 1.0);
        assert!(forces("smooth", None, share).thrust < rough.thrust);
        assert_eq!(forces("grouser", Some(0.3), share), forces("grouser", Some(0.3), 1.0));
    }
}

/// Deeper with load, as a soil that yields further under more of it.
#[test]
fn sinkage_and_resistance_grow_with_load() {
    for kind in SOILS {
        for (slip, degrees) in [(0.0, 0.0), (0.5, 0.0), (0.3, 45.0), (-0.5, 15.0)] {
            let contact = cmu(kind, Slip::on_test_stand(slip, deg(degrees)));
            let mut last = 0.0;
            for load in [0.1, 1.0, 10.0, 30.0] {
                let sinkage = settled(&contact, load).expect("the sand carries it").sinkage;
                assert!(sinkage > last, "{kind} at slip {slip}, {degrees}°, {load} N");
                last = sinkage;
            }
        }
    }
}
