// Toyoura sand and the HAKUTO rover, value by value. The examples in the library's documentation use
// this file, too.

use grouser_core::contact::Model;
use grouser_core::error::ParameterError;
use grouser_core::simulation::{Motion, Numerics, Scatter, Scenario, Start};
use grouser_core::soil::{
    Bulldozing, Domain, Exit, PressureSinkage, Rft, Shear, ShearBound, ShearModulus,
    SinkageExponent, SlopeStability, SmallWheel, Soil, StressPeak,
};
use grouser_core::terrain::Ground;
use grouser_core::units::{EARTH_GRAVITY, Vec3, deg};
use grouser_core::vehicle::{
    Body, ByWheel, DriveLaw, Inertia, LoadSharing, Mount, OwnMoments, Rover, Ruts, WheelUnit,
};
use grouser_core::wheel::{Grousers, Wheel};

/// Toyoura sand, by [FourWheel], Table 3.
pub(crate) fn sand() -> Soil {
    let modulus = |at_zero, per_radian| ShearModulus::Linear { at_zero, per_radian };
    Soil {
        cohesion: 0.0,
        friction_angle: deg(38.0),
        constant_volume_share: 0.0,
        density: 1490.0,
        pressure_sinkage: PressureSinkage::Reece {
            k_c: 0.0,
            k_phi: 122.727,
            exponent: SinkageExponent::constant(1.703),
        },
        stress_peak: StressPeak { a0: 0.40, a1: 0.15 },
        shear: Shear::Anisotropic {
            longitudinal: modulus(0.036, 0.043),
            lateral: modulus(0.013, 0.020),
        },
        shear_bound: ShearBound::None,
        exit: Exit::Ratio(1.0),
        bulldozing: Bulldozing::Sine,
        small_wheel: SmallWheel::OFF,
        rft: Rft::PUBLISHED,
        domain: Domain::UNSTATED,
        discrepancy: None,
    }
}

/// A wheel of 10 cm radius with 24 grousers of 1 cm.
pub(crate) fn wheel() -> Wheel {
    let grousers = Grousers { height: 0.010, count: 24 };
    Wheel { radius: 0.10, width: 0.08, grousers: Some(grousers) }
}

/// The four-wheel rover of [FourWheel], Tables 1 and 2.
pub(crate) fn rover() -> Result<Rover, ParameterError> {
    let body = Body { mass: 5.24, inertia: Inertia { xx: 0.138, yy: 0.142, zz: 0.230 } };
    let inertia = Inertia { xx: 0.001_00, yy: 0.001_54, zz: 0.001_00 };
    let unit = WheelUnit { mass: 0.422, inertia, wheel: wheel(), motor: None };
    let mount = |(name, x, y): (&str, f64, f64)| Mount {
        name: name.to_owned(),
        position: Vec3::new(x, y, -0.06),
        unit,
        steering: 0.0,
        steering_axis: None,
    };
    let places = [
        ("front-left", 0.19, 0.24),
        ("rear-left", -0.17, 0.24),
        ("rear-right", -0.17, -0.24),
        ("front-right", 0.19, -0.24),
    ];
    Rover::new(body, places.map(mount).to_vec())
}

/// Twenty seconds along the contour of a slope of 10°, with rims that turn at 6 cm/s.
pub(crate) fn traverse() -> Result<Scenario, ParameterError> {
    Ok(Scenario {
        rover: rover()?,
        ground: Ground::plane(sand(), deg(10.0)),
        gravity: EARTH_GRAVITY,
        model: Model::Ishigami,
        sharing: LoadSharing::QuasiStatic,
        own_moments: OwnMoments::Neglected,
        drive: DriveLaw::Constant(0.06),
        yaw: None,
        by_wheel: ByWheel::ALIKE,
        scatter: Scatter::NONE,
        ruts: Ruts::Fresh,
        stability: SlopeStability::USUAL,
        start: Start { yaw: 0.0, motion: Motion::Rolling },
        duration: 20.0,
        numerics: Numerics::DEFAULT,
    })
}
