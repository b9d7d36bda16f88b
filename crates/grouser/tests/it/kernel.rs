//! The force integral: the same bits on every instruction set, its accuracy, and the search on it.

use grouser::contact::{
    Contact, InstructionSet, Ishigami, Model, Slip, SmallWheel, WheelSoilModel, settle,
    settle_from, settle_many,
};
use grouser::soil::{
    Bulldozing, Domain, Exit, PressureSinkage, Rft, Shear, ShearBound, ShearModulus,
    SinkageExponent, Soil, StressPeak, small_wheel,
};
use grouser::units::deg;
use grouser::wheel::Wheel;

use super::million::{Draw, any_case, numbers_of};

/// Motions that a rover's wheel has, and those that need the most nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Motion {
    Driving,
    Skidding,
    Locked,
}

fn any_slip(draw: &mut Draw, motion: Motion) -> Slip {
    let beta = draw.between(deg(-45.0), deg(45.0));
    let ratio = match motion {
        Motion::Driving => draw.between(0.0, 1.0),
        Motion::Skidding => draw.between(-0.99, -0.01),
        Motion::Locked => -1.0,
    };
    Slip::on_test_stand(ratio, beta)
}

/// Wheels of 3 cm to half a metre, sunk by up to half a radius, K from half a millimetre, n from
/// 0.5 to 2.
fn any_contact(draw: &mut Draw, motion: Motion, isotropic: bool) -> (Contact, f64) {
    let radius = draw.sized(0.03, 0.5);
    let wheel = Wheel { radius, width: 0.7 * radius, grousers: None };
    let modulus = |draw: &mut Draw| ShearModulus::constant(draw.sized(5e-4, 0.1));
    let shear = if isotropic {
        Shear::Isotropic { modulus: modulus(draw) }
    } else {
        Shear::Anisotropic { longitudinal: modulus(draw), lateral: modulus(draw) }
    };
    let exponent = SinkageExponent::constant(draw.between(0.5, 2.0));
    let soil = Soil {
        cohesion: if draw.once_in(2) { 0.0 } else { draw.sized(10.0, 2000.0) },
        friction_angle: draw.between(deg(20.0), deg(45.0)),
        constant_volume_share: draw.between(0.0, 1.0),
        density: 1500.0,
        pressure_sinkage: PressureSinkage::Reece {
            k_c: 10.0,
            k_phi: draw.sized(50.0, 500.0),
            exponent,
        },
        stress_peak: StressPeak { a0: draw.between(0.1, 0.5), a1: draw.between(0.0, 0.2) },
        shear,
        shear_bound: ShearBound::None,
        exit: Exit::Ratio(draw.between(0.1, 1.2)),
        bulldozing: Bulldozing::Sine,
        small_wheel: small_wheel::SmallWheel::OFF,
        rft: Rft::PUBLISHED,
        domain: Domain::UNSTATED,
        discrepancy: None,
    };
    let slip = any_slip(draw, motion);
    (Contact { wheel, soil, slip, gravity: 9.81 }, draw.sized(1e-3, 0.5) * radius)
}

/// Largest error of any force, over the load, or of any moment, over load times radius [-]. Where
/// cohesion holds a wheel harder than its load presses it, that is the scale.
fn error(contact: &Contact, sinkage: f64) -> f64 {
    let [coarse, exact] =
        [Ishigami::default(), Ishigami::reference()].map(|model| model.forces(contact, sinkage));
    let Contact { wheel, soil, .. } = contact;
    let radius = wheel.shearing_radius();
    let held = soil.cohesion * wheel.width * radius * (exact.patch.entry - exact.patch.exit);
    let load = exact.normal_force.max(held);
    let errors = [
        (coarse.drawbar_pull - exact.drawbar_pull) / load,
        (coarse.side_force - exact.side_force) / load,
        (coarse.normal_force - exact.normal_force) / load,
        (coarse.torque - exact.torque) / (load * radius),
        (coarse.overturning_moment - exact.overturning_moment) / (load * radius),
        (coarse.aligning_moment - exact.aligning_moment) / (load * radius),
    ];
    errors.iter().fold(0.0, |most, error| f64::max(most, error.abs()))
}

/// Errors of many contacts in rising order.
fn errors(count: u64, motion: Motion, isotropic: bool, shear_bound: ShearBound) -> Vec<f64> {
    let mut errors: Vec<f64> = (0..count)
        .map(|case| {
            let mut draw = Draw::of_case(case);
            let (contact, sinkage) = any_contact(&mut draw, motion, isotropic);
            let soil = Soil { shear_bound, ..contact.soil };
            error(&Contact { soil, ..contact }, sinkage)
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    errors
}

/// * `usual`: bound for 99 of 100, `most`: for all
fn check_errors(motion: Motion, isotropic: bool, usual: f64, most: f64) {
    check_errors_of(motion, isotropic, ShearBound::None, usual, most);
}

fn check_errors_of(
    motion: Motion,
    isotropic: bool,
    shear_bound: ShearBound,
    usual: f64,
    most: f64,
) {
    let errors = errors(20_000, motion, isotropic, shear_bound);
    let last = errors.len() - 1;
    let (at_99, at_last) = (errors[last - last / 100], errors[last]);
    println!(
        "{motion:?}, isotropic {isotropic}: 99 of 100 below {at_99:.1e}, all below {at_last:.1e}"
    );
    assert!(at_99 < usual && at_last < most, "{motion:?}: {at_99:.1e}, {at_last:.1e}");
}

/// Measured against four times as many nodes as the finest rule has: 5e-7 at most.
#[test]
fn driving_wheels_are_integrated_to_a_millionth_of_the_load() {
    check_errors(Motion::Driving, false, 1e-6, 1e-6);
}

/// The corners of skid and the turning of the isotropic law cost digits where K is millimetres.
#[test]
fn most_other_wheels_are_integrated_to_a_few_millionths() {
    check_errors(Motion::Skidding, false, 3e-6, 2e-3);
    check_errors(Motion::Locked, false, 2e-5, 1e-4);
    check_errors(Motion::Driving, true, 1e-6, 1e-3);
    check_errors(Motion::Skidding, true, 1e-5, 1e-3);
}

/// The bound's factor is smooth: it costs no digits.
#[test]
fn bounded_shear_is_integrated_as_well() {
    check_errors_of(Motion::Driving, false, ShearBound::Coulomb, 1e-6, 1e-6);
    check_errors_of(Motion::Skidding, false, ShearBound::Coulomb, 3e-6, 2e-3);
    check_errors_of(Motion::Locked, false, ShearBound::Coulomb, 2e-5, 1e-4);
}

/// All numbers of a reaction as bits.
fn bits(model: &dyn WheelSoilModel, contact: &Contact, sinkage: f64) -> Vec<u64> {
    let forces = model.forces(contact, sinkage);
    let relation = model.load_sinkage(contact).expect("these theories have one");
    let all = numbers_of(&forces).into_iter().chain([relation.normal_force(sinkage)]);
    all.map(f64::to_bits).collect()
}

/// Terms of a small wheel's soil, so that the extended theory differs from the classical one.
fn with_terms(contact: &Contact, draw: &mut Draw) -> Contact {
    let mut contact = *contact;
    let terms = &mut contact.soil.small_wheel;
    terms.sinkage.with_slip_angle = draw.between(0.0, 3.0);
    terms.sinkage.with_slip = draw.between(0.0, 3.0);
    terms.exit.with_slip = draw.between(0.0, 0.5);
    terms.side_wall.friction = 0.5;
    terms.mounds.bow_wave = draw.between(0.0, 2.0);
    contact
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    let sets = InstructionSet::ALL.map(|set| (set, set.is_available()));
    println!("{sets:?}");
    for case in 0..20_000 {
        let contact = any_case(&Model::Ishigami, case).contact;
        let mut draw = Draw::of_case(!case);
        let sinkage = draw.sized(1e-6, 1.0) * contact.wheel.shearing_radius();
        let extended = with_terms(&contact, &mut draw);
        let on = |set| {
            let mut numbers = bits(&Ishigami::DEFAULT.on(set), &contact, sinkage);
            numbers.extend(bits(&SmallWheel::DEFAULT.on(set), &extended, sinkage));
            numbers
        };
        let baseline = on(InstructionSet::Baseline);
        for (set, available) in sets {
            assert!(!available || on(set) == baseline, "case {case} on {set:?}: {contact:?}");
        }
    }
}

/// The search asks for F_z alone; what it finds is the wheel's normal force to the last bit.
#[test]
fn a_load_sinkage_relation_has_the_bits_of_the_normal_force() {
    for case in 0..5_000 {
        let contact = any_case(&Model::Ishigami, case).contact;
        let sinkage = Draw::of_case(!case).sized(1e-6, 1.0) * contact.wheel.shearing_radius();
        for model in [Model::Ishigami, Model::SmallWheel] {
            let numbers = bits(model.as_ref(), &contact, sinkage);
            assert_eq!(numbers[2], numbers[14], "case {case}, {model:?}: {contact:?}");
        }
    }
}

#[test]
fn settling_does_not_depend_on_the_guess() {
    for case in 0..5_000 {
        let mut draw = Draw::of_case(case);
        let (contact, sinkage) = any_contact(&mut draw, Motion::Driving, false);
        // Without cohesion F_z grows with the sinkage, so that one sinkage carries the load.
        let contact = Contact { soil: Soil { cohesion: 0.0, ..contact.soil }, ..contact };
        for model in [Model::Ishigami, Model::Bekker, Model::SmallWheel] {
            let load = model.as_ref().forces(&contact, sinkage).normal_force;
            let cold = settle(model.as_ref(), &contact, load).expect("it is carried there");
            let guess = draw.sized(1e-6, 3.0) * contact.wheel.shearing_radius();
            for guess in [guess, cold.sinkage, 1.001 * cold.sinkage, 0.0, f64::NAN] {
                let warm = settle_from(model.as_ref(), &contact, load, guess)
                    .expect("it is carried there");
                let apart = (warm.sinkage / sinkage - 1.0).abs();
                // F_z agrees to 1e-12 and grows at least with a root of the sinkage.
                assert!(apart < 1e-10, "case {case}, {model:?} from {guess}: {apart:.1e}");
            }
        }
    }
}

#[test]
fn a_wheel_settles_alike_alone_and_among_others() {
    for model in Model::ALL {
        let wheels: Vec<(Contact, f64)> = (0..100)
            .map(|case| any_case(&model, case))
            .map(|case| (case.contact, case.load))
            .collect();
        let alone: Vec<_> =
            wheels.iter().map(|(contact, load)| settle(model.as_ref(), contact, *load)).collect();
        assert_eq!(settle_many(model.as_ref(), &wheels), alone);
        let reversed: Vec<_> = wheels.iter().rev().copied().collect();
        let mut backward = settle_many(model.as_ref(), &reversed);
        backward.reverse();
        assert_eq!(backward, alone);
    }
}
