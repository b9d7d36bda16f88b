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
//! The part along e_n pushes; the part across it is friction, at most μ_s times the push. A facet
//! is loaded where it leads, e_n·e_v ≥ 0.
//!
//! The published law jumps in three places: where a facet ceases to lead, where friction that would
//! drive a facet is turned against it, and where the facet is upright. Here the first two pass over
//! [`BLEND`]; the third, a hundredth of ξ, stays and is met at θ = 0 alone, the edge of every
//! integral.
//!
//! Pushing and friction need no vectors: with p = |f₁ + f₂ x₃ + f₃ x₂| against the facet, the shear
//! is f₂ v_t − f₃ z_t, where v_t and z_t are the parts of e_v and e_z along the facet, and all
//! products of these two follow from x₁, x₂ and x₃. So [`response`] gives the factors of v_t and
//! z_t alone, and its caller, which knows how the facets lie, multiplies them by these vectors.
//!
//! Each stage runs over all lanes before the next one begins: the square roots and divisions of
//! some facets are waited for while others are computed.

#![expect(clippy::inline_always, reason = "all of it is compiled once for each instruction set")]

use super::super::lanes::{Each, WIDE, each};

/// Half the width, in e_n·e_v [-], over which a facet ceases to lead. Source: ours.
///
/// A facet that slides along itself still carries soil, on both sides alike; the published law
/// gives all to whichever side leads by a hair. A wheel that spins on the spot slides along itself
/// everywhere, so that without a width it would not know which half of it carries the rover.
pub(super) const BLEND: f64 = 0.02;

/// Coefficients c₁ₖ, c₂ₖ, c₃ₖ [-] of the terms Tₖ, five a line:
///
/// ```text
/// 1      x₁     x₂     x₃     x₁²
/// x₂²    x₃²    x₁x₂   x₂x₃   x₃x₁
/// x₁³    x₂³    x₃³    x₁x₂²  x₂x₁²
/// x₂x₃²  x₃x₂²  x₃x₁²  x₁x₃²  x₁x₂x₃
/// ```
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

/// More than the law gives of pressure and shear together on any facet, over ξ and the depth [-].
/// Source: measured over all inclinations and motions, below.
pub(super) const MOST_STRESS: f64 = 2.0;

/// How much of a face counts [-], by how far it leads.
#[inline(always)]
pub(super) fn lead_share(lead: f64) -> f64 {
    (0.5 + (0.5 / BLEND) * lead).clamp(0.0, 1.0)
}

/// The law at each lane's inclination: what is left of f₁, f₂ and f₃ once x₂ is known.
///
/// Plates along one radius of a wheel differ by their motion alone.
pub(super) struct Inclined {
    x2: Each,
    cubics: [Cubic; 3],
}

/// A cubic in x₁ and x₃ for each lane, its coefficients named by their powers.
struct Cubic {
    c00: Each,
    c10: Each,
    c20: Each,
    c30: f64,
    c01: Each,
    c11: Each,
    c21: f64,
    c02: Each,
    c12: f64,
    c03: f64,
}

impl Inclined {
    /// * `x2`: −e_z·e_n [-], not negative
    #[inline(always)]
    pub(super) fn at(x2: Each) -> Self {
        // One by one: a map over the three would be a call, and no vectors.
        let [c1, c2, c3] = &COEFFICIENTS;
        let cubics = [Cubic::at(c1, &x2), Cubic::at(c2, &x2), Cubic::at(c3, &x2)];
        Self { x2, cubics }
    }
}

impl Cubic {
    #[inline(always)]
    fn at(c: &[f64; 20], x2: &Each) -> Self {
        Self {
            c00: each(|k| c[0] + x2[k] * (c[2] + x2[k] * (c[5] + x2[k] * c[11]))),
            c10: each(|k| c[1] + x2[k] * (c[7] + x2[k] * c[13])),
            c20: each(|k| c[4] + x2[k] * c[14]),
            c30: c[10],
            c01: each(|k| c[3] + x2[k] * (c[8] + x2[k] * c[16])),
            c11: each(|k| c[9] + x2[k] * c[19]),
            c21: c[17],
            c02: each(|k| c[6] + x2[k] * c[15]),
            c12: c[18],
            c03: c[12],
        }
    }

    /// The parts E and O of f = E + x₃ O, which are those of the plate's other face as well.
    #[inline(always)]
    fn split(&self, lane: usize, x1: f64, square: f64) -> (f64, f64) {
        let level = self.c00[lane] + x1 * (self.c10[lane] + x1 * (self.c20[lane] + x1 * self.c30));
        let even = level + square * (self.c02[lane] + x1 * self.c12);
        let odd = (self.c01[lane] + x1 * (self.c11[lane] + x1 * self.c21)) + square * self.c03;
        (even, odd)
    }
}

/// f₁, f₂ and f₃ of plates, split into what both of their faces share and what they have against
/// each other.
pub(super) struct Faces {
    x1: Each,
    x2: Each,
    even: [Each; 3],
    odd: [Each; 3],
}

impl Faces {
    /// * `x1`: −e_z·e_v [-]
    /// * `x3`: e_n·e_v [-], of either face
    #[inline(always)]
    pub(super) fn new(law: &Inclined, x1: &Each, x3: &Each) -> Self {
        let mut faces = Self { x1: *x1, x2: law.x2, even: [[0.0; _]; 3], odd: [[0.0; _]; 3] };
        for (i, cubic) in law.cubics.iter().enumerate() {
            for lane in 0..x1.len() {
                let (even, odd) = cubic.split(lane, x1[lane], x3[lane] * x3[lane]);
                faces.even[i][lane] = even;
                faces.odd[i][lane] = odd;
            }
        }
        faces
    }
}

/// What plates meet, whichever of their faces leads: stress per depth, over ξ [-].
pub(super) struct Response {
    /// Against the leading face, not negative.
    pub pressure: Each,
    /// The shear along the plate is this times v_t,
    pub drag: Each,
    /// less this times z_t.
    pub lift: Each,
}

/// What plates meet. No branch and no call: loops over plates become vector instructions.
///
/// The part of the shear along the sliding v_t that would drive a facet is turned against it. The
/// source turns the whole vector, which jumps; turning the part alone ends as friction does. For a
/// facet that moves nearly along its normal the turn fades: there the sliding has no direction, and
/// the push takes far more energy than such shear could give.
///
/// * `x3`: e_n·e_v [-], of the face that counts
/// * `sliding`: |v_t|² = 1 − x₃² [-]
/// * `friction`: of the surface, *μ_s* [-]
#[inline(always)]
pub(super) fn response(faces: &Faces, x3: &Each, sliding: &Each, friction: f64) -> Response {
    let mut met = Response { pressure: [0.0; WIDE], drag: [0.0; WIDE], lift: [0.0; WIDE] };
    for lane in 0..WIDE {
        let (x1, x2, x3, square) = (faces.x1[lane], faces.x2[lane], x3[lane], sliding[lane]);
        let f = |i: usize| faces.even[i][lane] + x3 * faces.odd[i][lane];
        let (f1, f2, f3) = (f(0), f(1), f(2));
        // A fit in cubic terms pulls here and there; soil without cohesion cannot.
        let pressure = (f1 + f2 * x3 + f3 * x2).abs();
        // v_t·z_t.
        let product = x2 * x3 - x1;
        let driving = f2 * square - f3 * product;
        let speed = square.sqrt();
        let scale = speed * if speed > BLEND { speed } else { BLEND };
        let turn = 2.0 * driving / if scale > 0.0 { scale } else { 1.0 };
        let drag = f2 - if driving > 0.0 { turn } else { 0.0 };
        let shear = drag * (drag * square - 2.0 * f3 * product) + f3 * f3 * (1.0 - x2 * x2);
        let (size, limit) = (shear.max(0.0).sqrt(), friction * pressure);
        let held = if size > limit { limit / size } else { 1.0 };
        met.pressure[lane] = pressure;
        met.drag[lane] = held * drag;
        met.lift[lane] = held * f3;
    }
    met
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
        let lead = normal.dot(&direction);
        let share = lead_share(lead);
        let (pressure, shear) = met(normal, direction, friction);
        (share > 0.0).then_some(FacetStress { pressure: pressure * share, shear: shear * share })
    }

    /// Pressure and shear on a facet, whether it leads or not.
    fn met(normal: Vec3, direction: Vec3, friction: f64) -> (f64, Vec3) {
        let lead = normal.dot(&direction);
        let turn = if normal.z > 0.0 { -1.0 } else { 1.0 };
        let (tangential, up) = (direction - normal * lead, Vec3::z() - normal * normal.z);
        let same = |x: f64| each(|_| x);
        let x3 = same(turn * lead);
        let faces = Faces::new(&Inclined::at(same(-turn * normal.z)), &same(-direction.z), &x3);
        let met = response(&faces, &x3, &same(tangential.norm_squared()), friction);
        (met.pressure[0], tangential * met.drag[0] - up * met.lift[0])
    }

    /// Powers of x₁, x₂, x₃ in each term, as the source prints them.
    const POWERS: [[i32; 3]; 20] = [
        [0, 0, 0],
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
        [2, 0, 0],
        [0, 2, 0],
        [0, 0, 2],
        [1, 1, 0],
        [0, 1, 1],
        [1, 0, 1],
        [3, 0, 0],
        [0, 3, 0],
        [0, 0, 3],
        [1, 2, 0],
        [2, 1, 0],
        [0, 1, 2],
        [0, 2, 1],
        [2, 0, 1],
        [1, 0, 2],
        [1, 1, 1],
    ];

    /// α as it is printed, friction without limit and where the soil brakes: pressure and shear
    /// found without a vector are its parts.
    #[test]
    fn pressure_and_shear_are_the_parts_of_the_printed_stress() {
        for k in 0..400 {
            let (normal, direction) = (sphere_point(k, 400), sphere_point(7 * k % 400, 400));
            let turn = if normal.z > 0.0 { -1.0 } else { 1.0 };
            let x = [-direction.z, -turn * normal.z, turn * normal.dot(&direction)];
            let [f1, f2, f3] = COEFFICIENTS.map(|c| {
                let term = |p: [i32; 3]| (0..3).map(|i| x[i].powi(p[i])).product::<f64>();
                c.iter().zip(POWERS).map(|(c, powers)| c * term(powers)).sum::<f64>()
            });
            let alpha = turn * normal * f1 + direction * f2 - Vec3::z() * f3;
            let printed = alpha - normal * alpha.dot(&normal);
            let (pressure, shear) = met(normal, direction, ROUGH);
            assert!((pressure - alpha.dot(&normal).abs()).abs() < 1e-14);
            let braked = printed.dot(&direction) <= 0.0;
            assert!(!braked || (shear - printed).norm() < 1e-13, "{shear:?}, not {printed:?}");
            // What would drive is turned: as large along the sliding, the other way.
            assert!(shear.dot(&direction) <= 1e-15);
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
    /// direction they differ by 0.16 of the stress under a plate pressed down, two fifths of the
    /// mean stress. Where plates are pushed down by 45° or more with at most 60° of tilt they are
    /// nearer.
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

    #[test]
    fn no_facet_meets_more_than_the_most() {
        const COUNT: u32 = 400;
        let all = (0..COUNT).flat_map(|k| (0..COUNT).map(move |n| (k, n)));
        let stresses = all.filter_map(|(k, n)| {
            let (normal, direction) = (sphere_point(k, COUNT), sphere_point(n, COUNT));
            let met = stress(normal, direction, ROUGH)?;
            Some(met.pressure.abs() + met.shear.norm())
        });
        let most = stresses.fold(0.0, f64::max);
        assert!(most < 0.95 * MOST_STRESS && most > 0.4 * MOST_STRESS, "{most}");
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
