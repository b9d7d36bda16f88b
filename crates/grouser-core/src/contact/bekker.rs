//! A closed-form model to check others against: Bekker's rigid wheel (Bekker 1956, 1969).
//!
//! The wheel is a plate on the front half of a parabolic arc, of contact length ℓ = √(2 r_s h).
//! The soil does not recover behind it. With K_σ and n of the pressure-sinkage law:
//!
//! ```text
//! F_z = b K_σ hⁿ ℓ B(n)        B(n) = ∫₀¹ (1 − x²)ⁿ dx = (√π/2) Γ(n + 1)/Γ(n + 3/2)
//! R_c = b K_σ h^(n+1)/(n + 1)                                         compaction resistance
//! H   = (b ℓ c + F_z tan φ)[1 − (K/iℓ)(1 − e^(−iℓ/K))]                Janosi and Hanamoto
//! ```
//!
//! Bekker writes (3 − n)/3 for B(n), its straight line near n = 1. The shear displacement grows
//! as i = |slip velocity|/|ω r_s| per metre of contact and acts against that velocity, so the
//! thrust has a side force with it. Nothing is integrated numerically.

use super::bulldozing::{self, WallResistance};
use super::cohesion::Cohesion;
use super::coulomb::bounded;
use super::forces::WheelForces;
use super::inputs::Contact;
use super::mirror::from_both_sides;
use super::model::{SHALLOW, WheelSoilModel};
use super::patch::ContactPatch;
use crate::elementary::wide::{exp_m1, hypot};
use crate::soil::{Domain, Shear, Span};

/// Bekker's closed-form model of a rigid wheel.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bekker;

impl WheelSoilModel for Bekker {
    fn domain(&self) -> Domain {
        Domain {
            depth: SHALLOW,
            // Source: Bekker (1969), in Wong, Theory of Ground Vehicles: less accurate for wheels
            // below 20 inches in diameter, the more so the smaller they are.
            radius: Span::at_least(0.25),
            slip_ratio: Span::new(-0.1, 0.9),
            ..Domain::UNSTATED
        }
    }

    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        from_both_sides(contact, sinkage, |contact, _| {
            bounded(contact, sinkage, entering_front(contact, sinkage))
        })
    }

    /// F_z grows with the sinkage.
    fn most_normal_force(&self, contact: &Contact, sinkage: f64) -> f64 {
        /// For the last digits of a power.
        const ROUNDING: f64 = 1.0 + 1e-12;
        ROUNDING * self.forces(contact, sinkage).normal_force
    }
}

fn entering_front(contact: &Contact, sinkage: f64) -> WheelForces {
    let Contact { wheel, soil, slip, gravity } = contact;
    let (r, b, h) = (wheel.shearing_radius(), wheel.width, sinkage);
    let unit_weight = soil.unit_weight(*gravity);
    let stiffness = soil.pressure_sinkage.stiffness(b, soil.cohesion, unit_weight, slip.ratio);
    let n = stiffness.exponent;
    let pressure = stiffness.pressure(h);
    let length = (2.0 * r * h).sqrt();

    let normal_force = b * pressure * length * mean_pressure(n);
    let compaction = b * pressure * h / (n + 1.0);

    let cohesion = Cohesion::of(soil);
    let strength = b * length * cohesion.mobilised(pressure) + normal_force * soil.friction();
    let (thrust, side_shear) = shear_forces(contact, length, strength);

    // ∫ R_b over the parabola: its mean depth is 2/3 h, its mean square 8/15 h².
    let wall = WallResistance::new(soil, unit_weight).pressed(cohesion.share(pressure));
    let wall_load = length * wall.mean_over_parabola(h);
    let (across, along) = bulldozing::shares(soil.bulldozing, slip);
    let motion_resistance = along * wall_load - compaction;
    let side_force = side_shear + across * wall_load;
    WheelForces {
        drawbar_pull: thrust + motion_resistance,
        side_force,
        normal_force,
        torque: r * thrust,
        overturning_moment: r * side_force,
        // The parabola's centre of pressure lies ahead of the hub by ℓ ∫x(1−x²)ⁿ / B(n).
        aligning_moment: side_force * length / (2.0 * (n + 1.0) * mean_pressure(n)),
        thrust,
        motion_resistance,
        side_force_from_shear: side_shear,
        bulldozing_load: wall_load,
        max_normal_stress: pressure,
        patch: ContactPatch { max_stress: 0.0, exit: 0.0, ..ContactPatch::new(soil, r, h, 0.0) },
    }
}

/// Thrust and the side force from shear [N]: the mobilised strength against the slip velocity.
fn shear_forces(contact: &Contact, length: f64, strength: f64) -> (f64, f64) {
    let Contact { soil, slip, .. } = contact;
    let (k_x, k_y) = match &soil.shear {
        Shear::Anisotropic { longitudinal, lateral } => {
            (longitudinal.at(slip.angle), lateral.at(slip.angle))
        }
        Shear::Isotropic { modulus } => (modulus.at(slip.angle), modulus.at(slip.angle)),
    };
    let (i_x, i_y) = (slip.rim - slip.forward, slip.lateral);
    let slip_size = hypot(i_x, i_y);
    if slip_size == 0.0 {
        return (0.0, 0.0);
    }
    let mobilised = mean_mobilised(length * hypot(i_x / k_x, i_y / k_y));
    (strength * mobilised * i_x / slip_size, -strength * mobilised * i_y / slip_size)
}

/// Mean of 1 − e^(−x) for x from 0 to `largest` [-]: 1 − (1 − e^(−X))/X.
fn mean_mobilised(largest: f64) -> f64 {
    /// Below it the closed form is a difference of equals; the series is exact to 1e-13.
    const SMALL: f64 = 1e-3;
    if largest < SMALL {
        largest / 2.0 - largest * largest / 6.0 + largest.powi(3) / 24.0
    } else {
        1.0 + exp_m1(-largest) / largest
    }
}

/// B(n) = ∫₀¹ (1 − x²)ⁿ dx [-], for n from 0 to 3 and more.
///
/// From n + 10 down by B(n) = B(n + 1) (n + 3/2)/(n + 1), where Γ(n+1)/Γ(n+3/2) has an asymptotic
/// series in 1/(n + 3/4)² (Tricomi and Erdélyi 1951); good to 1e-13.
fn mean_pressure(n: f64) -> f64 {
    const STEPS: u32 = 10;
    let descent: f64 =
        (0..STEPS).map(|step| n + f64::from(step)).map(|m| (m + 1.5) / (m + 1.0)).product();
    let end = n + f64::from(STEPS) + 0.75;
    let w = 1.0 / (end * end);
    let series = 1.0
        - w * (1.0 / 64.0
            - w * (21.0 / 8192.0 - w * (671.0 / 524_288.0 - w * 180_323.0 / 134_217_728.0)));
    0.5 * std::f64::consts::PI.sqrt() * descent * series / end.sqrt()
}

impl WallResistance {
    /// Mean of *R_b* [N/m] over a parabola of depth `deepest` [m].
    fn mean_over_parabola(&self, deepest: f64) -> f64 {
        // R_b is a z + b z² without constant: two depths tell both coefficients.
        let (whole, half) = (self.at(deepest), self.at(0.5 * deepest));
        let square = 2.0 * whole - 4.0 * half;
        let linear = whole - square;
        2.0 / 3.0 * linear + 8.0 / 15.0 * square
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed forms: B(0) = 1, B(½) = π/4, B(1) = 2/3, B(2) = 8/15.
    #[test]
    fn mean_pressure_has_its_known_values() {
        use std::f64::consts::PI;
        for (n, known) in [(0.0, 1.0), (0.5, PI / 4.0), (1.0, 2.0 / 3.0), (2.0, 8.0 / 15.0)] {
            let computed = mean_pressure(n);
            assert!((computed - known).abs() < 1e-12, "B({n}) = {computed}, not {known}");
        }
    }

    #[test]
    fn the_two_branches_of_the_mobilised_mean_meet() {
        let (below, above) = (mean_mobilised(0.999_999e-3), mean_mobilised(1.000_001e-3));
        assert!((above - below) / 1e-9 < 1.1 && above > below);
    }
}
