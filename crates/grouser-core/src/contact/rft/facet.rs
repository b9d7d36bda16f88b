//! What a piece of surface meets in granular soil: the law of three-dimensional resistive force
//! theory (Agarwal, Goldman and Kamrin, PNAS 2023).
//!
//! A small plane facet with outward normal e_n, moving in the direction e_v at depth d, meets the
//! stress ξ d α. With the upright e_z and the three numbers on which an isotropic soil can depend,
//!
//! ```text
//! x₁ = −e_z·e_v     x₂ = −e_z·e_n     x₃ = e_n·e_v     e_n turned so that x₂ ≥ 0: a plate has no front
//! α = f₁ e_n + f₂ e_v − f₃ e_z                          fᵢ = Σ cᵢₖ Tₖ(x₁, x₂, x₃), cubic, 20 terms each
//! ξ = ρ g (894 μ³ − 386 μ² + 89 μ)                 μ = tan φ
//! ```
//!
//! The part along e_n pushes; the part across it is friction, at most μ_s times the push. A facet is
//! loaded where it leads, e_n·e_v ≥ 0.
//!
//! The published law jumps in three places: where a facet ceases to lead, where friction that
//! would drive a facet is turned against it, and where the facet is upright. Here the first two pass
//! over [`BLEND`]; the third, a hundredth of ξ, stays and is met at θ = 0 alone, the edge of every
//! integral.

#![expect(clippy::inline_always, reason = "all of it is compiled once for each instruction set")]

/// Half the width, in e_n·e_v [-], over which a facet ceases to lead. Source: ours.
///
/// A facet that slides along itself still carries soil, on both sides alike; the published law
/// gives all to whichever side leads by a hair. A wheel that spins on the spot slides along itself
/// everywhere, so that without a width it would not know which half of it carries the rover.
pub(super) const BLEND: f64 = 0.02;

/// Coefficients c₁ₖ, c₂ₖ, c₃ₖ [-] of the terms Tₖ in the order of [`terms`], five a line.
///
/// Source: Agarwal, Goldman and Kamrin (2023), as in their public code (KKKobefeng/3D-RFT).
#[rustfmt::skip]
const COEFFICIENTS: [[f64; 20]; 3] = [
    [
        0.002_12, -0.023_20, -0.208_90, -0.430_83, -0.002_59,
        0.488_72, -0.004_15, 0.072_04, -0.027_50, -0.087_72,
        0.019_92, -0.459_61, 0.407_99, -0.101_07, -0.065_76,
        0.056_64, -0.092_69, 0.018_92, 0.010_33, 0.151_20,
    ],
    [
        -0.067_96, -0.109_41, 0.047_25, -0.069_14, -0.058_35,
        -0.658_80, -0.119_85, -0.257_39, -0.268_34, 0.026_92,
        -0.007_36, 0.637_58, 0.089_97, 0.210_69, 0.047_48,
        0.204_06, 0.185_89, 0.049_34, 0.135_27, -0.332_07,
    ],
    [
        -0.026_34, -0.034_36, 0.452_56, 0.008_35, 0.025_53,
        -1.312_90, -0.055_32, 0.067_90, -0.164_04, 0.022_87,
        0.029_27, 0.954_06, -0.001_31, -0.110_28, 0.014_87,
        -0.027_30, 0.109_11, -0.040_97, 0.078_81, -0.275_19,
    ],
];

/// The terms Tₖ [-].
#[inline(always)]
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

/// Which of them are left where a facet is upright, x₂ = 0.
const UPRIGHT: [usize; 10] = [0, 1, 3, 4, 6, 9, 10, 12, 17, 18];

/// x forward, y left, z up.
pub(super) type Vector = [f64; 3];

#[inline(always)]
pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(super) fn scaled(a: Vector, factor: f64) -> Vector {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

#[inline(always)]
pub(super) fn added(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
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

/// What a plate meets, whichever of its faces leads: stress per depth, over ξ [-].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Response {
    /// Against the leading face, not negative.
    pub pressure: f64,
    /// Along the plate, as a vector.
    pub shear: Vector,
    /// e_n·e_v [-]: how far the face of the normal leads.
    pub lead: f64,
}

/// What a plate meets. No branch and no call: a loop over plates becomes vector instructions.
///
/// * `IS_UPRIGHT`: whether e_n lies level
/// * `normal`: e_n, and `direction` of its motion, e_v [-], in the wheel frame
/// * `friction`: of the surface, *μ_s* [-]
#[inline(always)]
pub(super) fn response<const IS_UPRIGHT: bool>(
    normal: Vector,
    direction: Vector,
    friction: f64,
) -> Response {
    let lead = dot(normal, direction);
    let generic = generic::<IS_UPRIGHT>(normal, direction, lead);
    let along_normal = dot(generic, normal);
    // A fit in cubic terms pulls here and there; soil without cohesion cannot.
    let pressure = along_normal.abs();
    let shear = against_sliding(
        added(generic, scaled(normal, -along_normal)),
        added(direction, scaled(normal, -lead)),
    );
    let (size, limit) = (dot(shear, shear).sqrt(), friction * pressure);
    let held = if size > limit { limit / size } else { 1.0 };
    Response { pressure, shear: scaled(shear, held), lead }
}

/// How much of a face counts [-], by how far it leads.
#[inline(always)]
pub(super) fn lead_share(lead: f64) -> f64 {
    (0.5 + (0.5 / BLEND) * lead).clamp(0.0, 1.0)
}

/// The law without friction: α [-].
#[inline(always)]
fn generic<const IS_UPRIGHT: bool>(normal: Vector, direction: Vector, lead: f64) -> Vector {
    let turn = if normal[2] > 0.0 { -1.0 } else { 1.0 };
    let downward = scaled(normal, turn);
    let terms = terms(-direction[2], -downward[2], turn * lead);
    // One by one: a map over the three would be a call, and no vectors.
    let [c1, c2, c3] = &COEFFICIENTS;
    let f1 = weighted::<IS_UPRIGHT>(c1, &terms);
    let f2 = weighted::<IS_UPRIGHT>(c2, &terms);
    let f3 = weighted::<IS_UPRIGHT>(c3, &terms);
    let [x, y, z] = added(scaled(downward, f1), scaled(direction, f2));
    [x, y, z - f3]
}

/// Σ cₖ Tₖ, in sums side by side: this is what the model's time goes into.
#[inline(always)]
fn weighted<const IS_UPRIGHT: bool>(coefficients: &[f64; 20], terms: &[f64; 20]) -> f64 {
    let (c, t) = (coefficients, terms);
    if IS_UPRIGHT {
        let two = |k: usize| {
            let (one, other) = (UPRIGHT[k], UPRIGHT[k + 1]);
            c[one] * t[one] + c[other] * t[other]
        };
        (two(0) + two(2)) + (two(4) + two(6)) + two(8)
    } else {
        let four = |k: usize| {
            (c[k] * t[k] + c[k + 1] * t[k + 1]) + (c[k + 2] * t[k + 2] + c[k + 3] * t[k + 3])
        };
        (four(0) + four(4)) + (four(8) + four(12)) + four(16)
    }
}

/// A shear stress with its part along the sliding turned against it.
///
/// The source turns the whole vector, which jumps; turning the part alone ends as friction does.
/// For a facet that moves nearly along its normal the turn fades: there the sliding has no
/// direction, and the push takes far more energy than such shear could give.
#[inline(always)]
fn against_sliding(shear: Vector, sliding: Vector) -> Vector {
    let driving = dot(shear, sliding);
    let speed = dot(sliding, sliding).sqrt();
    let scale = speed * if speed > BLEND { speed } else { BLEND };
    let turn = 2.0 * driving / if scale > 0.0 { scale } else { 1.0 };
    added(shear, scaled(sliding, if driving > 0.0 { -turn } else { 0.0 }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::{Vec3, deg};

    /// Stress on a facet that leads, per depth and over ξ [-].
    #[derive(Debug)]
    struct FacetStress {
        pressure: f64,
        shear: Vec3,
    }

    /// What a facet meets, counting how far it leads; nothing where it trails.
    fn stress(normal: Vec3, direction: Vec3, friction: f64) -> Option<FacetStress> {
        let met = response::<false>(normal.into(), direction.into(), friction);
        let share = lead_share(met.lead);
        let shear = Vec3::from(met.shear) * share;
        (share > 0.0).then_some(FacetStress { pressure: met.pressure * share, shear })
    }

    /// A level normal is one of all normals.
    #[test]
    fn the_law_of_upright_facets_is_the_general_one() {
        for k in 0..400 {
            let direction: Vector = sphere_point(k, 400).into();
            for side in [1.0, -1.0] {
                let general = response::<false>([0.0, side, 0.0], direction, 0.6);
                let upright = response::<true>([0.0, side, 0.0], direction, 0.6);
                let difference = Vec3::from(general.shear) - Vec3::from(upright.shear);
                assert!(difference.norm() < 1e-14 && general.lead == upright.lead);
                assert!((general.pressure - upright.pressure).abs() < 1e-14);
            }
        }
    }

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
        let drag = 0.253 * gamma.cos()
            - 0.124 * (2.0 * beta + gamma).cos()
            - 0.007 * (gamma - 2.0 * beta).cos()
            + 0.088 * (2.0 * beta).sin();
        (-drag, lift)
    }

    /// Two models of the same plates from different experiments. Over every inclination and
    /// direction they differ by 0.16 of the stress under a plate pressed down, two fifths of the mean
    /// stress. Where plates are pushed down by 45° or more with at most 60° of tilt they are nearer.
    #[test]
    fn in_the_plane_it_resembles_the_two_dimensional_theory() {
        let differences = |tilts: std::ops::RangeInclusive<i32>,
                           ways: std::ops::RangeInclusive<i32>| {
            let (mut difference, mut stress) = (0.0, 0.0);
            for beta in tilts.step_by(15) {
                for gamma in ways.clone().step_by(15) {
                    let (beta, gamma) = (deg(f64::from(beta)), deg(f64::from(gamma)));
                    let (x, z) = in_the_plane(beta, gamma);
                    // Both in units of the stress under a plate pressed straight down.
                    let force = on_plate(beta, gamma) / 0.875;
                    difference += (force.x - x).powi(2) + (force.z - z).powi(2);
                    stress += x * x + z * z;
                }
            }
            f64::sqrt(difference / stress)
        };
        let (all, pressed) = (differences(-75..=90, -75..=75), differences(-60..=60, 45..=75));
        println!("{all:.3} of the stress, {pressed:.3} where pressed");
        assert!(all < 0.45 && pressed < 0.33);
    }

    /// The soil takes energy from every facet, whatever its inclination, motion and roughness, but
    /// for those that trail by less than the width of the blend.
    #[test]
    fn no_leading_facet_gains_energy() {
        let directions = || (0..400).map(|k| sphere_point(k, 400));
        for normal in directions() {
            for direction in directions() {
                for friction in [0.0, 0.3, 0.8, ROUGH] {
                    let lead = normal.dot(&direction);
                    let Some(stress) = stress(normal, direction, friction) else { continue };
                    let power = stress.shear.dot(&direction) - stress.pressure * lead;
                    let most = if lead >= 0.0 { 1e-15 } else { BLEND * stress.pressure };
                    assert!(power <= most, "{power} of {stress:?}");
                }
            }
        }
    }

    /// Points spread over a sphere along a spiral.
    fn sphere_point(k: u32, count: u32) -> Vec3 {
        const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;
        let z = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(count);
        let (sin, cos) = (GOLDEN_ANGLE * f64::from(k)).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        Vec3::new(radius * cos, radius * sin, z)
    }

    /// A motion that turns by a hair moves the stress by a hair, through every switch of the law.
    #[test]
    fn the_stress_is_continuous_in_the_motion() {
        const HAIR: f64 = 1e-9;
        for k in 0..300 {
            let (normal, across) = (sphere_point(k, 300), sphere_point(k + 7, 307));
            let at = |turn: f64| {
                let direction = (normal * turn.cos() + across * turn.sin()).normalize();
                stress(normal, direction, 0.6)
                    .map_or(Vec3::zeros(), |s| s.shear - normal * s.pressure)
            };
            for step in 0..720 {
                let turn = deg(0.5 * f64::from(step));
                let jump = (at(turn + HAIR) - at(turn - HAIR)).norm();
                assert!(jump < 1e-5, "{jump} at {turn} for {normal:?}");
            }
        }
    }

    /// Source: theory, section 7.4, with ρ 1330 kg/m³ and φ 29° of the CMU sand: ξ = 83.0 ρ g.
    #[test]
    fn the_stiffness_follows_from_weight_and_friction() {
        let xi = stiffness(1330.0 * 9.80665, deg(29.0).tan());
        assert!((xi / 1.0825e6 - 1.0).abs() < 1e-3, "{xi}");
    }
}
