//! What a piece of surface meets in granular soil: the law of three-dimensional resistive force
//! theory (Agarwal, Goldman and Kamrin, PNAS 2023).
//!
//! A small plane facet with outward normal n̂, moving in the direction v̂ at depth d, meets the stress
//! ξ d α. With the upright ẑ and the three numbers on which an isotropic soil can depend,
//!
//! ```text
//! x₁ = −ẑ·v̂     x₂ = −ẑ·n̂     x₃ = n̂·v̂          n̂ turned so that x₂ ≥ 0: a plate has no front
//! α = f₁ n̂ + f₂ v̂ − f₃ ẑ                          fᵢ = Σ cᵢₖ Tₖ(x₁, x₂, x₃), cubic, 20 terms each
//! ξ = ρ g (894 μ³ − 386 μ² + 89 μ)                 μ = tan φ
//! ```
//!
//! The part along n̂ pushes; the part across it is friction, at most μ_s times the push. A facet is
//! loaded where it leads, n̂·v̂ ≥ 0.
//!
//! The published law jumps in three places: where a facet ceases to lead, where friction that
//! would drive a facet is turned against it, and where the facet is upright. Here the first two pass
//! over [`BLEND`]; the third, a hundredth of ξ, stays and is met at θ = 0 alone, the edge of every
//! integral.

use crate::units::Vec3;

/// Half the width, in n̂·v̂ [-], over which a facet ceases to lead. Source: ours.
///
/// A facet that slides along itself still carries soil, on both sides alike; the published law
/// gives all to whichever side leads by a hair. A wheel that spins on the spot slides along itself
/// everywhere, so that without a width it would not know which half of it carries the rover.
pub(super) const BLEND: f64 = 0.02;

/// Coefficients c₁ₖ, c₂ₖ, c₃ₖ [-] of the terms Tₖ in the order of [`terms`].
///
/// Source: Agarwal, Goldman and Kamrin (2023), as in their public code (KKKobefeng/3D-RFT).
const COEFFICIENTS: [[f64; 3]; 20] = [
    [0.002_12, -0.067_96, -0.026_34],
    [-0.023_20, -0.109_41, -0.034_36],
    [-0.208_90, 0.047_25, 0.452_56],
    [-0.430_83, -0.069_14, 0.008_35],
    [-0.002_59, -0.058_35, 0.025_53],
    [0.488_72, -0.658_80, -1.312_90],
    [-0.004_15, -0.119_85, -0.055_32],
    [0.072_04, -0.257_39, 0.067_90],
    [-0.027_50, -0.268_34, -0.164_04],
    [-0.087_72, 0.026_92, 0.022_87],
    [0.019_92, -0.007_36, 0.029_27],
    [-0.459_61, 0.637_58, 0.954_06],
    [0.407_99, 0.089_97, -0.001_31],
    [-0.101_07, 0.210_69, -0.110_28],
    [-0.065_76, 0.047_48, 0.014_87],
    [0.056_64, 0.204_06, -0.027_30],
    [-0.092_69, 0.185_89, 0.109_11],
    [0.018_92, 0.049_34, -0.040_97],
    [0.010_33, 0.135_27, 0.078_81],
    [0.151_20, -0.332_07, -0.275_19],
];

/// The terms Tₖ [-].
fn terms(x1: f64, x2: f64, x3: f64) -> [f64; 20] {
    let (s1, s2, s3) = (x1 * x1, x2 * x2, x3 * x3);
    [
        1.0,
        x1,
        x2,
        x3,
        s1,
        s2,
        s3,
        x1 * x2,
        x2 * x3,
        x3 * x1,
        s1 * x1,
        s2 * x2,
        s3 * x3,
        x1 * s2,
        x2 * s1,
        x2 * s3,
        x3 * s2,
        x3 * s1,
        x1 * s3,
        x1 * x2 * x3,
    ]
}

/// Stress on a facet per depth, over ξ [-].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FacetStress {
    /// Against the outward normal, not negative.
    pub pressure: f64,
    /// Along the facet, as a vector.
    pub shear: Vec3,
}

/// Stiffness of the medium, *ξ* [N/m³]: stress per depth.
///
/// ```text
/// ξ = ρ g (894 μ³ − 386 μ² + 89 μ)                  after Agarwal, Goldman and Kamrin (2023)
/// ```
///
/// It is positive for every friction; the fit knows soils with μ of about 0.2 to 0.9.
///
/// * `unit_weight`: ρ g [N/m³]
/// * `friction`: internal friction, *μ* = tan φ [-]
pub(super) fn stiffness(unit_weight: f64, friction: f64) -> f64 {
    unit_weight * ((894.0 * friction - 386.0) * friction + 89.0) * friction
}

/// What a facet meets, counting how far it leads.
///
/// * `normal`: outward, n̂, and `direction` of its motion, v̂ [-], in the wheel frame
/// * `friction`: of the surface, *μ_s* [-]
///
/// `None` where the facet trails.
pub(super) fn stress(normal: Vec3, direction: Vec3, friction: f64) -> Option<FacetStress> {
    let lead = normal.dot(&direction);
    let share = (0.5 + 0.5 * lead / BLEND).clamp(0.0, 1.0);
    if share == 0.0 {
        return None;
    }
    let generic = generic(normal, direction);
    let along_normal = generic.dot(&normal);
    // A fit in cubic terms pulls here and there; soil without cohesion cannot.
    let pressure = along_normal.abs();
    let shear = against_sliding(generic - normal * along_normal, direction - normal * lead);
    let (size, limit) = (shear.norm(), friction * pressure);
    let shear = if size > limit { shear * (limit / size) } else { shear };
    Some(FacetStress { pressure: pressure * share, shear: shear * share })
}

/// The law without friction: α [-].
fn generic(normal: Vec3, direction: Vec3) -> Vec3 {
    let downward = if normal.z > 0.0 { -normal } else { normal };
    let terms = terms(-direction.z, -downward.z, downward.dot(&direction));
    let mut f = [0.0; 3];
    for (term, row) in terms.iter().zip(&COEFFICIENTS) {
        for (sum, coefficient) in f.iter_mut().zip(row) {
            *sum += term * coefficient;
        }
    }
    downward * f[0] + direction * f[1] - Vec3::z() * f[2]
}

/// A shear stress with its part along the sliding turned against it.
///
/// The source turns the whole vector, which jumps; turning the part alone ends as friction does.
/// For a facet that moves nearly along its normal the turn fades: there the sliding has no
/// direction, and the push takes far more energy than such shear could give.
fn against_sliding(shear: Vec3, sliding: Vec3) -> Vec3 {
    let driving = shear.dot(&sliding);
    if driving <= 0.0 {
        return shear;
    }
    let speed = sliding.norm();
    shear - sliding * (2.0 * driving / (speed * speed.max(BLEND)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::deg;

    /// Without limit of friction.
    const ROUGH: f64 = f64::INFINITY;

    /// Stress on a plate (x forward, z up): inclined by `beta`, moving downward by `gamma`.
    fn on_plate(beta: f64, gamma: f64) -> Vec3 {
        let normal = Vec3::new(beta.sin(), 0.0, -beta.cos());
        let direction = Vec3::new(gamma.cos(), 0.0, -gamma.sin());
        let normal = if normal.dot(&direction) < 0.0 { -normal } else { normal };
        let stress = stress(normal, direction, ROUGH).expect("it leads");
        stress.shear - normal * stress.pressure
    }

    /// Source: theory, section 7.4.
    #[test]
    fn a_plate_pressed_straight_down_meets_seven_eighths() {
        let force = on_plate(0.0, deg(90.0));
        assert!((force.z - 0.875).abs() < 1e-3, "{force:?}");
        assert!(force.x.abs() < 1e-12);
    }

    /// Two-dimensional theory by its own coefficients (Li, Zhang and Goldman, Science 2013, as in
    /// qishuny/3D-RFT-wheel), in N/cm³: the force on the plate (x, z).
    fn in_the_plane(beta: f64, gamma: f64) -> (f64, f64) {
        let lift = 0.206
            + 0.169 * (2.0 * beta).cos()
            + 0.358 * gamma.sin()
            + 0.212 * (2.0 * beta + gamma).sin()
            + 0.055 * (gamma - 2.0 * beta).sin();
        let drag = 0.253 * gamma.cos() - 0.124 * (2.0 * beta + gamma).cos()
            - 0.007 * (gamma - 2.0 * beta).cos()
            + 0.088 * (2.0 * beta).sin();
        (-drag, lift)
    }

    #[test]
    fn print_comparison() {
        let (mut sum, mut size, mut worst, mut n) = (0.0, 0.0, 0.0_f64, 0.0);
        for b in (-80..=90).step_by(10) {
            for g in (-80..=80).step_by(10) {
                let (beta, gamma) = (deg(f64::from(b)), deg(f64::from(g)));
                let (x, z) = in_the_plane(beta, gamma);
                let f = on_plate(beta, gamma) / 0.875;
                let e = (f.x - x).hypot(f.z - z);
                sum += e * e;
                size += x * x + z * z;
                n += 1.0;
                worst = worst.max(e);
                if b % 30 == 0 && g % 40 == 0 {
                    println!("{b} {g}: 2D {x:.3} {z:.3}  3D {:.3} {:.3}", f.x, f.z);
                }
            }
        }
        println!("rms err {:.3} rms size {:.3} worst {worst:.3}", f64::sqrt(sum / n), f64::sqrt(size / n));
    }
}
