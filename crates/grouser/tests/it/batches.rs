//! Many wheels at once: the bits of single wheels, in any company, and what answers cost.

use grouser::contact::{
    Contact, InstructionSet, Ishigami, LoadedWheel, Model, SettleError, Settled, Slip, SmallWheel,
    WheelSoilModel, forces_many, settle, settle_counted, settle_each, settle_from, settle_many,
};
use grouser::soil::{Bulldozing, Shear, ShearBound, ShearModulus};
use grouser::units::{EARTH_GRAVITY, deg};

use super::given;
use super::million::{Draw, any_case, numbers_of};

/// Sizes of batches around those at which lanes fill.
const SIZES: [usize; 8] = [1, 2, 11, 12, 16, 17, 63, 300];

type Answer = Result<Settled, SettleError>;

/// An answer as bits.
fn bits(answer: &Answer) -> Vec<u64> {
    let numbers = match answer {
        Ok(Settled { sinkage, forces, evaluations }) => {
            let rest = [*sinkage, f64::from(*evaluations)];
            numbers_of(forces).into_iter().chain(rest).collect()
        }
        Err(SettleError::SunkToAxle { load, capacity }) => vec![*load, *capacity],
        Err(SettleError::BadLoad { load }) => vec![*load],
    };
    numbers.into_iter().map(f64::to_bits).collect()
}

/// A wheel anywhere in the domain, in any motion, some of them backward, locked, dragged or without
/// a load.
fn any_wheel(case: u64) -> (Model, Contact, f64) {
    let mut draw = Draw::of_case(case);
    let model = if draw.once_in(2) { Model::SmallWheel } else { Model::Ishigami };
    let model = if draw.once_in(40) { Model::Bekker } else { model };
    let found = any_case(&model, case);
    let mut contact = found.contact;
    if draw.once_in(4) {
        contact.slip = contact.slip.front_to_back();
    }
    if draw.once_in(8) {
        contact.soil.shear_bound = ShearBound::Coulomb;
    }
    let load = if draw.once_in(50) { 0.0 } else { found.load };
    let load = if draw.once_in(200) { -load } else { load };
    (model, contact, load)
}

#[test]
fn mixed_wheels_settle_as_they_do_alone() {
    let wheels: Vec<_> = (0..6_000).map(any_wheel).collect();
    let alone: Vec<Answer> = wheels
        .iter()
        .map(|(model, contact, load)| settle(model.as_ref(), contact, *load))
        .collect();
    let loaded: Vec<_> = wheels
        .iter()
        .map(|(model, contact, load)| LoadedWheel {
            model: model.as_ref(),
            contact,
            load: *load,
            guess: None,
        })
        .collect();
    for size in SIZES {
        let together = loaded.chunks(size).flat_map(settle_each);
        for (case, (one, other)) in alone.iter().zip(together).enumerate() {
            assert_eq!(bits(one), bits(&other), "case {case} among {size}: {:?}", wheels[case]);
        }
    }
}

#[test]
fn guesses_count_among_others_as_they_do_alone() {
    let wheels: Vec<_> = (0..2_000).map(any_wheel).collect();
    let guess = |case: usize, contact: &Contact| {
        let mut draw = Draw::of_case(!(case as u64));
        let near = draw.sized(1e-6, 3.0) * contact.wheel.shearing_radius();
        if draw.once_in(9) { f64::NAN } else { near }
    };
    let loaded: Vec<_> = wheels
        .iter()
        .enumerate()
        .map(|(case, (model, contact, load))| LoadedWheel {
            model: model.as_ref(),
            contact,
            load: *load,
            guess: Some(guess(case, contact)),
        })
        .collect();
    for (case, (wheel, together)) in loaded.iter().zip(settle_each(&loaded)).enumerate() {
        let alone = settle_from(wheel.model, wheel.contact, wheel.load, guess(case, wheel.contact));
        assert_eq!(bits(&alone), bits(&together), "case {case}: {:?}", wheels[case]);
    }
}

#[test]
fn batches_have_the_same_bits_on_every_instruction_set() {
    let wheels: Vec<(Contact, f64)> =
        (0..3_000).map(any_wheel).map(|(_, contact, load)| (contact, load)).collect();
    let on = |set: InstructionSet| {
        let models: [&dyn WheelSoilModel; 2] =
            [&Ishigami::DEFAULT.on(set), &SmallWheel::DEFAULT.on(set)];
        models.map(|model| settle_many(model, &wheels).iter().map(bits).collect::<Vec<_>>())
    };
    let baseline = on(InstructionSet::Baseline);
    let mut compared = 0;
    for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
        assert!(on(set) == baseline, "{set:?}");
        compared += 1;
    }
    println!("{compared} instruction sets compared");
}

#[test]
fn forces_of_many_are_those_of_each() {
    let wheels: Vec<(Contact, f64)> = (0..6_000)
        .map(|case| {
            let (_, contact, _) = any_wheel(case);
            let mut draw = Draw::of_case(!case);
            let sinkage = draw.sized(1e-6, 1.0) * contact.wheel.shearing_radius();
            (contact, if draw.once_in(50) { 0.0 } else { sinkage })
        })
        .collect();
    for model in Model::ALL {
        for size in SIZES {
            let count = if model == Model::Rft { 300 } else { wheels.len() };
            let together =
                wheels[..count].chunks(size).flat_map(|some| forces_many(model.as_ref(), some));
            for (case, ((contact, sinkage), many)) in wheels.iter().zip(together).enumerate() {
                let alone = model.as_ref().forces(contact, *sinkage);
                let bits = |it| numbers_of(it).map(f64::to_bits);
                assert_eq!(bits(&alone), bits(&many), "case {case} of {model:?} among {size}");
            }
        }
    }
}

/// Wheels of the reference rover on sand under more than it carries, in all motions.
fn overloaded(case: u64) -> (Model, Contact, f64) {
    let mut draw = Draw::of_case(case);
    let beta = draw.between(deg(-80.0), deg(80.0));
    let mut soil = given::toyoura();
    soil.cohesion = if draw.once_in(2) { 0.0 } else { draw.sized(10.0, 5e4) };
    soil.friction_angle = draw.between(deg(20.0), deg(55.0));
    soil.bulldozing = Bulldozing::Sine;
    if draw.once_in(2) {
        soil.shear = Shear::Isotropic { modulus: ShearModulus::constant(draw.sized(1e-3, 0.1)) };
    }
    let slip = Slip::on_test_stand(draw.between(-1.0, 1.0), beta);
    let contact = Contact { wheel: given::hakuto_wheel(), soil, slip, gravity: EARTH_GRAVITY };
    let model = if draw.once_in(2) { Model::Ishigami } else { Model::SmallWheel };
    (model, contact, draw.sized(1e2, 1e6))
}

/// The capacity that is stated is the highest F_z of a dense scan, and it is found in as few
/// evaluations as three wheels that settle.
#[test]
fn a_wheel_that_the_soil_cannot_carry_costs_no_more_than_three_that_it_carries() {
    /// Number of evaluations for a wheel that settles.
    const USUAL: u32 = 5;
    const MOST: u32 = 4 * USUAL;
    /// Where the load is within a thousandth of the most, its peak is looked for as closely as
    /// that.
    const MOST_NEARBY: u32 = 12 * USUAL;
    let (mut sunk, mut sum, mut most) = (0, 0, 0);
    for case in 0..2_000 {
        let (model, contact, load) = overloaded(case);
        let (answer, evaluations) = settle_counted(model.as_ref(), &contact, load);
        let Err(SettleError::SunkToAxle { capacity, .. }) = answer else { continue };
        let is_near = load < 1.0011 * capacity;
        assert!(evaluations <= if is_near { MOST_NEARBY } else { MOST }, "case {case}");
        (sunk, sum, most) = (sunk + 1, sum + evaluations, most.max(evaluations));
        let radius = contact.wheel.shearing_radius();
        let scan = (0..=2_000).map(|step| {
            let sinkage = radius * f64::exp(-8.0 * f64::from(step) / 2_000.0);
            model.as_ref().forces(&contact, sinkage).normal_force
        });
        let highest = scan.fold(0.0, f64::max);
        let apart = capacity / highest - 1.0;
        assert!((-1e-12..1e-4).contains(&apart), "case {case}: {capacity} N, {highest} N");
    }
    let mean = f64::from(sum) / f64::from(sunk);
    println!("{sunk} sunk: {mean:.1} evaluations, {most} at most");
    assert!(
        sunk > 1_000 && mean < 3.0 * f64::from(USUAL) && most <= MOST,
        "{sunk}, {mean}, {most}"
    );
}
