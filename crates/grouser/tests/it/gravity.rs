//! Granular scaling (Slonaker et al. 2017): in sand without cohesion that knows no rate, gravity
//! times q, lengths times r, masses times s and rim speeds times √(q r) change power by q^(3/2)
//! r^(1/2) s and speeds by √(q r), and no slip. And what of it is left where constants are carried
//! to another gravity in other ways.
//!
//! `laws.rs` has it for one wheel of the source paper's model; here are all models, and the rover.

use grouser::contact::{Contact, Model};
use grouser::simulation::SteadyMotion;
use grouser::soil::{
    GravityScaling, PressureSinkage, Rft, Shear, ShearModulus, SinkageExponent, SmallWheel, Soil,
};
use grouser::studies::heading::{HeadingOffset, HeadingStudy, Steering};
use grouser::units::{EARTH_GRAVITY, MARS_GRAVITY, MOON_GRAVITY, deg};
use grouser::vehicle::{Body, Inertia, LoadSharing, Mount, OwnMoments, Rover, WheelUnit};
use grouser::wheel::{Grousers, Wheel};
use proptest::prelude::*;

use super::given::{self, cases};

/// What the laws may be off by: round-off of the solvers, relative.
const WITHIN: f64 = 1e-9;

/// Gravity times q, lengths times r, masses times s.
#[derive(Clone, Copy, Debug)]
struct Scaling {
    q: f64,
    r: f64,
    s: f64,
}

impl Scaling {
    fn gravity(q: f64) -> Self {
        Self { q, r: 1.0, s: 1.0 }
    }

    /// With the width ∝ r, s = r³.
    fn size(q: f64, r: f64) -> Self {
        Self { q, r, s: r.powi(3) }
    }

    fn speed(self) -> f64 {
        (self.q * self.r).sqrt()
    }

    fn power(self) -> f64 {
        self.q.powf(1.5) * self.r.sqrt() * self.s
    }

    fn wheel(self, wheel: Wheel) -> Wheel {
        let grousers = wheel.grousers.map(|it| Grousers { height: self.r * it.height, ..it });
        Wheel { radius: self.r * wheel.radius, width: self.r * wheel.width, grousers }
    }

    fn modulus(self, modulus: ShearModulus) -> ShearModulus {
        let r = self.r;
        match modulus {
            ShearModulus::Linear { at_zero, per_radian } => {
                ShearModulus::Linear { at_zero: r * at_zero, per_radian: r * per_radian }
            }
            ShearModulus::Quadratic { at_zero, per_radian, per_radian_squared, angle_limit } => {
                ShearModulus::Quadratic {
                    at_zero: r * at_zero,
                    per_radian: r * per_radian,
                    per_radian_squared: r * per_radian_squared,
                    angle_limit,
                }
            }
        }
    }

    /// The soil with its lengths, which are the shear moduli.
    fn soil(self, soil: Soil) -> Soil {
        let shear = match soil.shear {
            Shear::Anisotropic { longitudinal, lateral } => Shear::Anisotropic {
                longitudinal: self.modulus(longitudinal),
                lateral: self.modulus(lateral),
            },
            Shear::Isotropic { modulus } => Shear::Isotropic { modulus: self.modulus(modulus) },
        };
        Soil { shear, ..soil }
    }

    fn inertia(self, inertia: Inertia) -> Inertia {
        let factor = self.s * self.r * self.r;
        Inertia { xx: factor * inertia.xx, yy: factor * inertia.yy, zz: factor * inertia.zz }
    }

    fn rover(self, rover: &Rover) -> Rover {
        let body = rover.body();
        let unit = |unit: WheelUnit| WheelUnit {
            mass: self.s * unit.mass,
            inertia: self.inertia(unit.inertia),
            wheel: self.wheel(unit.wheel),
            motor: None,
        };
        let mount = |mount: &Mount| Mount {
            position: self.r * mount.position,
            unit: unit(mount.unit),
            ..mount.clone()
        };
        let body = Body { mass: self.s * body.mass, inertia: self.inertia(body.inertia) };
        Rover::new(body, rover.mounts().iter().map(mount).collect()).expect("a rover that stands")
    }

    fn study(self, study: &HeadingStudy) -> HeadingStudy {
        HeadingStudy {
            rover: self.rover(&study.rover),
            soil: self.soil(study.soil),
            gravity: self.q * study.gravity,
            ..study.clone()
        }
    }
}

/// Reece's law without cohesion.
fn weighing(k_phi: f64, n: f64) -> PressureSinkage {
    PressureSinkage::Reece { k_c: 0.0, k_phi, exponent: SinkageExponent::constant(n) }
}

fn any_weighing_sand() -> impl Strategy<Value = Soil> {
    let law = (10.0..3000.0, 0.5..2.0).prop_map(|(k_phi, n)| weighing(k_phi, n));
    (given::any_sand(), law).prop_map(|(sand, pressure_sinkage)| Soil {
        pressure_sinkage,
        small_wheel: SmallWheel::GENERAL,
        ..sand
    })
}

fn near(one: f64, other: f64, size: f64) -> bool {
    (one - other).abs() <= WITHIN * size
}

/// The same of a motion at a speed. Resistive force theory takes every wheel to sink by a creep of
/// 1 µm/s, which is a share of 3e-6 of the slowest rims here, and no scaling law's; torque
/// multiplies it by ten.
fn within(model: &Model) -> f64 {
    if *model == Model::Rft { 1e-4 } else { WITHIN }
}

/// One wheel under a load, here and scaled: every force over its load, torque over load times
/// radius.
fn check_wheel(
    model: &Model,
    contact: &Contact,
    depth: f64,
    scaling: Scaling,
) -> Result<(), TestCaseError> {
    let radius = contact.wheel.shearing_radius();
    let load = model.as_ref().forces(contact, depth * radius).normal_force;
    if load <= 0.0 {
        return Ok(());
    }
    let here = given::settled(model.as_ref(), contact, load);
    let scaled = Contact {
        wheel: scaling.wheel(contact.wheel),
        soil: scaling.soil(contact.soil),
        gravity: scaling.q * contact.gravity,
        ..*contact
    };
    let force = scaling.q * scaling.s;
    let there = given::settled(model.as_ref(), &scaled, force * load);
    let pairs = [
        ("sinkage", here.sinkage / radius, there.sinkage / (scaling.r * radius)),
        (
            "drawbar pull",
            here.forces.drawbar_pull / load,
            there.forces.drawbar_pull / (force * load),
        ),
        ("side force", here.forces.side_force / load, there.forces.side_force / (force * load)),
        (
            "torque",
            here.forces.torque / (load * radius),
            there.forces.torque / (force * load * scaling.r * radius),
        ),
    ];
    for (name, one, other) in pairs {
        prop_assert!(near(one, other, one.abs().max(1.0)), "{model:?}, {name}: {one} and {other}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn any_wheel_in_weighing_sand_does_the_same_under_any_gravity_and_at_any_size(
        sand in any_weighing_sand(),
        wheel in given::any_wheel(),
        slip in -0.5..0.95,
        angle in given::any_slip_angle(),
        depth in 1e-3..0.4,
        q in given::log_range(0.01, 100.0),
        r in given::log_range(0.1, 10.0),
    ) {
        let contact = given::on_stand(sand, wheel, slip, angle);
        for model in Model::ALL {
            check_wheel(&model, &contact, depth, Scaling::gravity(q))?;
            check_wheel(&model, &contact, depth, Scaling::size(q, r))?;
        }
    }
}

/// HAKUTO on its sand, whose constants Reece's law and the weight make; with all load transfer.
fn study(model: Model) -> HeadingStudy {
    HeadingStudy {
        rover: given::hakuto(),
        soil: given::toyoura(),
        gravity: EARTH_GRAVITY,
        model,
        sharing: LoadSharing::Complete,
        own_moments: OwnMoments::Included,
        stability: grouser::soil::SlopeStability::USUAL,
        steering: Steering::None,
    }
}

fn headings(study: &HeadingStudy) -> Vec<Option<HeadingOffset>> {
    let curve = study.curve().expect("a soil");
    [0.0, 4.0, 8.0, 12.0].map(|slope| curve.at(deg(slope)).ok()).into()
}

/// Yaw and slip are equal, the torque of all wheels has its factor q r s.
fn same_headings(one: &HeadingStudy, other: &HeadingStudy, scaling: Scaling) -> Result<(), String> {
    let Scaling { q, r, s } = scaling;
    for (here, there) in headings(one).iter().zip(&headings(other)) {
        let (Some(here), Some(there)) = (here, there) else {
            if here.is_some() == there.is_some() {
                continue;
            }
            return Err("only one has a heading".to_owned());
        };
        let torque = there.torque() / (q * r * s);
        let pairs = [
            ("yaw", here.yaw, there.yaw),
            ("slip ratio", here.slip_ratio, there.slip_ratio),
            ("sinkage", here.mean_sinkage(), there.mean_sinkage() / r),
            ("torque", here.torque(), torque),
        ];
        for (name, a, b) in pairs {
            if !near(a, b, 1.0) {
                return Err(format!("{name}: {a} and {b} differ by {:.1e}", a - b));
            }
        }
    }
    Ok(())
}

/// Wide, with no factor a power of two: those would leave every bit as it is.
const GRAVITIES: [f64; 5] =
    [0.01, MOON_GRAVITY / EARTH_GRAVITY, MARS_GRAVITY / EARTH_GRAVITY, 3.0, 70.0];
const SIZES: [f64; 4] = [0.1, 0.3, 3.0, 10.0];

#[test]
fn a_rover_in_weighing_sand_holds_the_contour_by_one_heading_under_any_gravity_and_at_any_size() {
    for model in Model::ALL {
        let here = study(model.clone());
        let scalings = GRAVITIES.map(Scaling::gravity).into_iter();
        let scalings = scalings.chain(SIZES.map(|r| Scaling::size(0.3, r)));
        for scaling in scalings {
            let there = scaling.study(&here);
            let same = same_headings(&here, &there, scaling);
            assert!(same.is_ok(), "{model:?}, {scaling:?}: {same:?}");
        }
    }
}

/// Rim speed [m/s]. Far from the creep of 1 µm/s that keeps slip finite at rest and knows no
/// scaling: at a hundredth of a metre per second it changes a slip ratio by more than [`WITHIN`].
const RIM_SPEED: f64 = 3.0;

/// Power ΣT ω and speed of a rover that settles into a motion, while nobody holds its heading.
fn moved(study: &HeadingStudy, yaw: f64, rim_speed: f64) -> (SteadyMotion, f64) {
    let slope = deg(8.0);
    // A search ends within 1e-7 of the rims' speed. One that comes from less and less far away ends
    // much nearer, as every step of it leaves a small share of the way.
    const FROM: [f64; 8] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-5, 2e-6, 1e-6, 0.0];
    let first = study.steady_motion(slope, yaw, rim_speed).expect("it settles");
    let motion = FROM.into_iter().fold(first, |motion, away| {
        study.steady_motion_near(&motion, slope, yaw + away, rim_speed).expect("it is near")
    });
    let torques = motion.wheels.iter().zip(study.rover.mounts());
    let power = torques
        .map(|(wheel, mount)| wheel.settled.forces.torque * rim_speed / mount.shearing_radius());
    let power = power.sum();
    (motion, power)
}

#[test]
fn power_and_speed_of_a_rover_on_a_slope_scale_as_granular_scaling_says() {
    let scalings: Vec<Scaling> = GRAVITIES
        .map(Scaling::gravity)
        .into_iter()
        .chain(SIZES.map(|r| Scaling::size(0.3, r)))
        .collect();
    for model in [Model::Ishigami, Model::SmallWheel, Model::Rft] {
        let here = study(model.clone());
        for yaw in [0.0, 4.0] {
            let (one, power) = moved(&here, deg(yaw), RIM_SPEED);
            for scaling in &scalings {
                let there = scaling.study(&here);
                let (other, scaled) = moved(&there, deg(yaw), scaling.speed() * RIM_SPEED);
                let case = format!("{model:?}, {yaw}°, {scaling:?}");
                let pairs = [
                    ("slip", one.slip_ratio(), other.slip_ratio(), 1.0),
                    ("course", one.course(), other.course(), 1.0),
                    ("speed", one.speed(), other.speed() / scaling.speed(), one.speed()),
                    ("power", power, scaled / scaling.power(), power),
                ];
                for (name, here, there, size) in pairs {
                    let error = (here - there) / size;
                    assert!(error.abs() <= within(&model), "{name} by {error:.1e}, {case}");
                }
            }
        }
    }
}

/// The conditions are needed: each, left out, shows.
#[test]
fn a_rover_does_not_do_the_same_where_scaling_does_not_hold() {
    let moon = Scaling::gravity(MOON_GRAVITY / EARTH_GRAVITY);
    let here = study(Model::Ishigami);
    let differ = |here: &HeadingStudy, there: &HeadingStudy, scaling| {
        let same = same_headings(here, there, scaling);
        same.expect_err("it should not hold");
    };
    let with = |soil: Soil| HeadingStudy { soil, ..here.clone() };
    let cohesive = with(Soil { cohesion: 100.0, ..here.soil });
    differ(&cohesive, &moon.study(&cohesive), moon);
    // Bekker's constants that give the same pressure on Earth.
    let PressureSinkage::Reece { k_phi, exponent, .. } = here.soil.pressure_sinkage else {
        panic!("Reece's law")
    };
    let width: f64 = given::hakuto_wheel().width;
    let unit_weight = here.soil.unit_weight(EARTH_GRAVITY);
    let k_phi = unit_weight * k_phi * width.powf(1.0 - exponent.at_zero);
    let pressure_sinkage = PressureSinkage::Bekker { k_c: 0.0, k_phi, exponent };
    let bekker = with(Soil { pressure_sinkage, ..here.soil });
    assert!(same_headings(&here, &bekker, Scaling::gravity(1.0)).is_ok());
    differ(&bekker, &moon.study(&bekker), moon);
    // K that does not grow with the wheel.
    let large = Scaling::size(1.0, 3.0);
    differ(&here, &HeadingStudy { soil: here.soil, ..large.study(&here) }, large);
    // A rover that is as heavy on the Moon as it is here.
    let heavy = here.rover.with_mass_factor(1.0 / moon.q).expect("a rover");
    let heavy = HeadingStudy { rover: heavy, ..moon.study(&here) };
    differ(&here, &heavy, Scaling { s: 1.0 / moon.q, ..moon });
}

fn carried(study: &HeadingStudy, gravity: f64, scaling: GravityScaling) -> HeadingStudy {
    let soil = study.soil.under(gravity, study.gravity, scaling).expect("gravities");
    HeadingStudy { soil, gravity, ..study.clone() }
}

/// Soils of both laws, with cohesion and without.
fn soils() -> [Soil; 4] {
    let sand = given::toyoura();
    let reece = PressureSinkage::Reece {
        k_c: 20.0,
        k_phi: 122.7,
        exponent: SinkageExponent::constant(1.2),
    };
    let cohesive = Soil { cohesion: 300.0, pressure_sinkage: reece, ..sand };
    [sand, cohesive, given::simulant_2007(), Soil { cohesion: 0.0, ..given::simulant_2007() }]
}

/// Whatever the soil and its law: that is what the choice means.
#[test]
fn by_granular_scaling_the_test_of_the_same_rover_is_the_forecast() {
    for soil in soils() {
        for model in Model::ALL {
            let here = HeadingStudy { soil, ..study(model.clone()) };
            for gravity in [MOON_GRAVITY, MARS_GRAVITY] {
                let there = carried(&here, gravity, GravityScaling::Granular);
                let same = same_headings(&here, &there, Scaling::gravity(gravity / EARTH_GRAVITY));
                assert!(same.is_ok(), "{model:?}, {soil:?}: {same:?}");
            }
        }
    }
}

#[test]
fn without_cohesion_unit_weight_and_granular_scaling_are_one() {
    let here = study(Model::Ishigami);
    let [reece, granular] = [GravityScaling::Reece, GravityScaling::Granular]
        .map(|scaling| carried(&here, MOON_GRAVITY, scaling).soil);
    assert_eq!(reece, granular);
}

/// The pressure under a rim at one depth, over that on Earth: 1 and q and what lies between.
#[test]
fn moduli_scale_as_their_choice_says() {
    let q = MOON_GRAVITY / EARTH_GRAVITY;
    let pressure = |soil: &Soil, gravity: f64| {
        let unit_weight = soil.unit_weight(gravity);
        soil.pressure_sinkage.stiffness(0.08, soil.cohesion, unit_weight, 0.0).pressure(0.01)
    };
    for soil in soils() {
        let ratio = |scaling| {
            let there = soil.under(MOON_GRAVITY, EARTH_GRAVITY, scaling).expect("gravities");
            pressure(&there, MOON_GRAVITY) / pressure(&soil, EARTH_GRAVITY)
        };
        let [reece, bekker, granular] = GravityScaling::ALL.map(ratio);
        assert!((granular - q).abs() < 1e-12, "{granular}");
        assert!(reece > q - 1e-12 && reece < 1.0, "{reece}");
        // Reece's law has its cohesive part from the cohesion, which stays.
        assert!(bekker > 1.0 - 1e-12 && bekker < 1.0 + 1e-12, "{bekker}");
    }
}

/// Carried to the gravity of the measurement nothing changes, and a gravity is above zero.
#[test]
fn at_home_every_choice_leaves_the_soil_as_it_is() {
    for soil in soils() {
        for scaling in GravityScaling::ALL {
            assert_eq!(soil.under(EARTH_GRAVITY, EARTH_GRAVITY, scaling), Ok(soil));
            assert!(soil.under(0.0, EARTH_GRAVITY, scaling).is_err());
            assert!(soil.under(EARTH_GRAVITY, -1.0, scaling).is_err());
        }
    }
    assert_eq!(given::toyoura().rft, Rft::PUBLISHED);
}

/// Cohesion is worth more where the weight is less: a rover slips less by unit weight than by
/// granular scaling.
#[test]
fn cohesion_helps_more_on_the_moon() {
    let soil = Soil { cohesion: 200.0, ..given::toyoura() };
    let here = HeadingStudy { soil, ..study(Model::Ishigami) };
    let slip = |scaling| {
        let curve = carried(&here, MOON_GRAVITY, scaling).curve().expect("a soil");
        curve.at(deg(10.0)).expect("a heading").slip_ratio
    };
    assert!(slip(GravityScaling::Reece) < slip(GravityScaling::Granular) - 0.01);
}
