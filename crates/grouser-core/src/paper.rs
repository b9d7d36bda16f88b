//! The sand, the rover and the traverse of the source paper ([FourWheel]), value by value:
//! something to begin with, and what the examples of this documentation take.
//!
//! They are those of the documents `toyoura` and `hakuto` of `grouser-io`, bit for bit.

#[cfg(test)]
mod uneven;

use crate::error::ParameterError;
use crate::simulation::Scenario;
use crate::soil::{Domain, PressureSinkage, Shear, ShearModulus, SinkageExponent, Soil, Span};
use crate::terrain::Ground;
use crate::units::{Vec3, deg};
use crate::vehicle::{Body, Inertia, LoadSharing, Mount, OwnMoments, Rover, WheelUnit};
use crate::wheel::{Grousers, Wheel};

/// Toyoura sand, by [FourWheel], Table 3. How the soil rises behind a wheel and what pushes against
/// its side are not printed there, and assumed.
#[must_use]
pub fn toyoura() -> Soil {
    let modulus = |at_zero, per_radian| ShearModulus::Linear { at_zero, per_radian };
    let pressure_sinkage = PressureSinkage::Reece {
        k_c: 0.0,
        // Printed is 1203.54, which is m/s² times this.
        k_phi: 122.726_925_096_745_57,
        exponent: SinkageExponent::constant(1.703),
    };
    let shear =
        Shear::Anisotropic { longitudinal: modulus(0.036, 0.043), lateral: modulus(0.013, 0.020) };
    let span = |low, high| Span { low, high };
    let domain = Domain {
        load: span(8.0, 26.0),
        slip_angle: span(0.0, deg(45.0)),
        gravity: span(9.78, 9.84),
        ..Domain::UNSTATED
    };
    Soil { domain, ..Soil::new(0.0, deg(38.0), 1490.0, pressure_sinkage, shear) }
}

/// HAKUTO's wheel: 10 cm of radius and 24 grousers of 1 cm, which the paper does not print.
#[must_use]
pub fn hakuto_wheel() -> Wheel {
    let grousers = Grousers { height: 0.010, count: 24 };
    Wheel { radius: 0.10, width: 0.08, grousers: Some(grousers) }
}

/// HAKUTO, the four-wheel rover of [FourWheel], Tables 1 and 2.
///
/// # Errors
/// None: it stands. [`Rover::new`] refuses those that do not.
pub fn hakuto() -> Result<Rover, ParameterError> {
    let body = Body { mass: 5.24, inertia: Inertia { xx: 0.138, yy: 0.142, zz: 0.230 } };
    let inertia = Inertia { xx: 0.001_00, yy: 0.001_54, zz: 0.001_00 };
    let unit = WheelUnit { mass: 0.422, inertia, wheel: hakuto_wheel(), motor: None };
    let mount = |(name, x, y): (&str, f64, f64)| Mount {
        name: name.to_owned(),
        joint: None,
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

/// Twenty seconds along the contour of a slope of 10°, with rims that turn at 6 cm/s, and the
/// paper's shares of the load.
///
/// # Errors
/// The same as [`hakuto`].
pub fn traverse() -> Result<Scenario, ParameterError> {
    Ok(Scenario {
        sharing: LoadSharing::QuasiStatic,
        own_moments: OwnMoments::Neglected,
        ..Scenario::new(hakuto()?, Ground::plane(toyoura(), deg(10.0)))
    })
}
