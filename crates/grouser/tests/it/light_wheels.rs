//! Forces vanish with the load, for every model: a light wheel is no anchor.

use std::f64::consts::SQRT_2;

use grouser::contact::stress::StressField;
use grouser::contact::{Contact, Ishigami, Model, Slip, WheelForces, WheelSoilModel};
use grouser::document::{self, Kind, Overrides, Source, presets};
use grouser::soil::{Shear, ShearBound, SmallWheel, Soil, StressPeak};
use grouser::units::{EARTH_GRAVITY, deg};
use grouser::wheel::Wheel;
use proptest::prelude::*;

use crate::given;
use crate::small_wheel::friction_and_wedges;

/// The horizontal force of the soil on the wheel [N].
fn horizontal(forces: &WheelForces) -> f64 {
    forces.drawbar_pull.hypot(forces.side_force)
}

/// Soils with general terms or without, bounded by Coulomb's law.
fn any_bounded_soil() -> impl Strategy<Value = Soil> {
    let terms = prop_oneof![Just(SmallWheel::OFF), Just(SmallWheel::GENERAL)];
    (given::any_soil(), given::any_exit(1.0), terms).prop_map(|(soil, exit, small_wheel)| Soil {
        exit,
        small_wheel,
        shear_bound: ShearBound::Coulomb,
        ..soil
    })
}

/// Wheels that roll, skid, slip or are locked, straight ahead or at an angle.
fn any_forward_contact() -> impl Strategy<Value = Contact> {
    let slip = prop_oneof![4 => -1.0..1.0, 1 => Just(-1.0), 1 => Just(0.0), 1 => Just(1.0)];
    let angle = prop_oneof![1 => Just(0.0), 2 => -80.0..80.0];
    (any_bounded_soil(), given::any_wheel(), slip, angle).prop_map(|(soil, wheel, s, degrees)| {
        Contact { wheel, soil, slip: Slip::on_test_stand(s, deg(degrees)), gravity: EARTH_GRAVITY }
    })
}

/// Cohesion [Pa] of loose soil that takes no tension under this wheel, at most σ/cos φ.
fn without_tension(soil: &Soil, forces: &WheelForces) -> f64 {
    soil.cohesion.min(forces.max_normal_stress / soil.friction_angle.cos())
}

proptest! {
    #![proptest_config(given::cases(2000))]

    /// Friction of what the wheel carries, cohesion over its contact, and wedges of soil ahead and
    /// at one side. Cohesion counts as far as the wheel's pressure keeps the soil from tension.
    #[test]
    fn no_wheel_is_held_by_more_than_friction_cohesion_and_wedges(
        contact in any_forward_contact(),
        depth in given::log_range(1e-6, 1.0),
    ) {
        let sinkage = depth * contact.wheel.shearing_radius();
        for model in Model::ALL {
            let forces = model.as_ref().forces(&contact, sinkage);
            let cohesion = without_tension(&contact.soil, &forces);
            let soil = Soil { cohesion, ..contact.soil };
            let load = forces.normal_force.max(0.0);
            let most = friction_and_wedges(&Contact { soil, ..contact }, load, sinkage);
            let force = horizontal(&forces);
            prop_assert!(force <= most * (1.0 + 1e-9), "{}: {force} > {most} N", model.name());
        }
    }

    /// A wheel that has hardly sunk carries more the deeper it sinks, whatever its motion and
    /// however cohesive the soil: so its load, however small, is carried at one sinkage, which
    /// vanishes with the load.
    #[test]
    fn a_shallow_wheel_carries_more_the_deeper_it_sinks(
        contact in any_forward_contact(),
        depth in given::log_range(1e-9, 0.02),
    ) {
        for model in Model::ALL {
            let carried = |depth: f64| {
                let sinkage = depth * contact.wheel.shearing_radius();
                model.as_ref().forces(&contact, sinkage).normal_force
            };
            let (here, deeper) = (carried(depth), carried(1.01 * depth));
            prop_assert!(here > 0.0 && deeper > here, "{}: {here}, {deeper} N", model.name());
        }
    }
}

fn preset_wheel(name: &str) -> Wheel {
    let source = Source::find(Kind::Wheel, name).expect("a preset");
    document::read_wheel(&source, &Overrides::none()).expect("it is read").value
}

fn preset_soil(name: &str) -> Soil {
    let source = Source::find(Kind::Soil, name).expect("a preset");
    document::read_soil(&source, &Overrides::none()).expect("it is read").value
}

/// On every soil of ours, with every model: of a ten-thousandth of its ordinary load a wheel keeps
/// no more than a fifth of its sinkage, and of its ordinary bound a fiftieth.
#[test]
fn sinkage_and_force_vanish_with_the_load() {
    const DECADES: i32 = 4;
    let wheel = preset_wheel("yutu-2");
    for preset in presets(Kind::Soil) {
        let soil = preset_soil(preset.name);
        for (s, degrees) in [(-1.0, 0.0), (-1.0, 45.0), (-0.3, 10.0), (0.0, 0.0), (0.3, 20.0)] {
            let slip = Slip::on_test_stand(s, deg(degrees));
            let contact = Contact { wheel, soil, slip, gravity: EARTH_GRAVITY };
            for model in Model::ALL {
                // What it carries a tenth of its radius deep.
                let model_forces = |sinkage| model.as_ref().forces(&contact, sinkage);
                let ordinary = model_forces(0.1 * wheel.radius).normal_force;
                let at = |load| given::settled(model.as_ref(), &contact, load);
                let settled: Vec<_> =
                    (0..=DECADES).map(|tenth| at(ordinary * 0.1_f64.powi(tenth))).collect();
                for pair in settled.windows(2) {
                    assert!(pair[1].sinkage < pair[0].sinkage, "{}, {}", preset.name, model.name());
                }
                let (first, last) = (settled[0], settled[DECADES as usize]);
                let (sinkage, force) =
                    (last.sinkage / first.sinkage, horizontal(&last.forces) / ordinary);
                let place = format!("{}, {}, {s}, {degrees}°", preset.name, model.name());
                assert!(sinkage < 0.2, "{place}: {sinkage} of the sinkage");
                assert!(force < 0.02, "{place}: {force} of the load");
            }
        }
    }
}

/// Yutu-2's wheel, locked, on the sand "direct-90" of 1 kPa: the drag under a load [N].
fn locked_on_direct_90(load: f64) -> (f64, f64) {
    let slip = Slip::on_test_stand(-1.0, 0.0);
    let (wheel, soil) = (preset_wheel("yutu-2"), preset_soil("direct-90"));
    let contact = Contact { wheel, soil, slip, gravity: EARTH_GRAVITY };
    let settled = given::settled(Model::SmallWheel.as_ref(), &contact, load);
    (settled.sinkage, horizontal(&settled.forces))
}

/// Before its cohesion was cut off it lay 53 mm deep under 0.022 N, held by 117 N.
#[test]
fn a_locked_wheel_without_a_load_is_no_anchor() {
    let (sinkage, force) = locked_on_direct_90(0.022);
    assert!(sinkage < 1e-3 && force < 0.1, "{sinkage} m, {force} N");
    let loads = [0.022, 0.22, 2.2, 22.0, 220.0].map(locked_on_direct_90);
    // It was 20 times the load under 22 N. Source: wheels of Pavlov and Johnson (2022), up to 2.8
    // times.
    assert!(loads[3].1 < 3.0 * 22.0, "{loads:?}");
    assert!(loads.is_sorted_by(|one, other| one.0 < other.0 && one.1 < other.1), "{loads:?}");
}

// ---- the slope of the pull at zero slip ----

/// A wheel on the stiff, cohesive granite, straight ahead, at a fixed sinkage.
fn pull_on_granite(shear_of: impl Fn(Shear) -> Shear, s: f64) -> f64 {
    let granite = preset_soil("krex-granite");
    // A peak that moves with |s| would bend the pull at zero slip by itself.
    let stress_peak = StressPeak { a1: 0.0, ..granite.stress_peak };
    let soil = Soil { shear: shear_of(granite.shear), stress_peak, ..granite };
    let contact = given::on_stand(soil, preset_wheel("yutu-2"), s, 0.0);
    Ishigami::reference().forces(&contact, SINKAGE).drawbar_pull
}

const SINKAGE: f64 = 0.005;

/// What braking by a slip of `s` takes from the pull, over √|s| [N]: between −√(2|s|) and √(2|s|)
/// from straight down the isotropic stress turns round.
///
/// ```text
/// −ΔF_x/√|s| → 4 √2 r b τ(0),   τ(0) = (c + σ tan φ)(1 − e^(−r (θ_f − sin θ_f)/K)) straight down
/// ```
#[test]
fn isotropic_shear_gives_the_pull_the_root_of_the_slip_from_below() {
    let pull = |s| pull_on_granite(|shear| shear, s);
    let (soil, wheel) = (preset_soil("krex-granite"), preset_wheel("yutu-2"));
    let field = StressField::new(&given::on_stand(soil, wheel, 0.0, 0.0), SINKAGE);
    // At s = 0 the rim slips forward everywhere but straight down.
    let stress = field.at(1e-4).longitudinal;
    assert!(stress > 0.0);
    let root = 4.0 * SQRT_2 * wheel.radius * wheel.width * stress;
    for s in [1e-6, 4e-6] {
        let taken = (pull(0.0) - pull(-s)) / s.sqrt();
        assert!((taken / root - 1.0).abs() < 0.02, "{taken}, {root}");
        let given = (pull(s) - pull(0.0)) / s.sqrt();
        assert!(given.abs() < 0.05 * root, "{given}, {root}");
    }
}

/// The anisotropic law has the sign of the displacement, which has grown since the entry: one
/// slope.
#[test]
fn anisotropic_shear_gives_the_pull_one_slope_at_zero_slip() {
    let anisotropic = |shear| match shear {
        Shear::Isotropic { modulus } => {
            Shear::Anisotropic { longitudinal: modulus, lateral: modulus }
        }
        other @ Shear::Anisotropic { .. } => other,
    };
    let pull = |s| pull_on_granite(anisotropic, s);
    let step = 1e-6;
    let (above, below) = (pull(step) - pull(0.0), pull(0.0) - pull(-step));
    assert!((above / below - 1.0).abs() < 1e-3, "{above}, {below}");
}
