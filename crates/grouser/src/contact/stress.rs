//! Normal and shear stress along the rim (Wong and Reece 1967; Janosi and Hanamoto 1961).

use super::model::Contact;
use super::patch::ContactPatch;
use super::slip::Slip;
use crate::root;
use crate::soil::pressure_sinkage::Stiffness;
use crate::soil::{Shear, Soil};

/// Stress of the soil on the rim at one angle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RimStress {
    /// Normal stress, *σ* [Pa], towards the hub.
    pub normal: f64,
    /// Shear stress along the rim, *τ_x* [Pa]; positive where the soil pushes the wheel onward.
    pub longitudinal: f64,
    /// Shear stress across the rim, *τ_y* [Pa]; positive to the left.
    pub lateral: f64,
}

/// A point of the rim, by its angle from straight down.
#[derive(Clone, Copy, Debug)]
pub(super) struct RimPoint {
    /// Angle behind the entry, θ_f − θ [rad].
    behind_entry: f64,
    /// *θ* [rad].
    angle: f64,
    /// sin θ [-].
    pub(super) sin: f64,
    /// cos θ [-].
    pub(super) cos: f64,
    /// Height over the rim's lowest point, (1 − cos θ) [radii].
    height: f64,
}

impl RimPoint {
    fn new(angle: f64, behind_entry: f64) -> Self {
        // By the half angle, so that shallow contact keeps its digits.
        let (sin_half, cos_half) = (0.5 * angle).sin_cos();
        let height = 2.0 * sin_half * sin_half;
        Self { behind_entry, angle, sin: 2.0 * sin_half * cos_half, cos: 1.0 - height, height }
    }
}

/// The stresses along the arc of one wheel at one sinkage.
///
/// All lengths are on the shearing radius *r_s*. The wheel enters the soil at its front: a wheel
/// that rolls backward is looked at in the mirror ([`Slip::front_to_back`]).
#[derive(Clone, Copy, Debug)]
pub struct StressField {
    /// The arc in contact.
    pub patch: ContactPatch,
    radius: f64,
    slip: Slip,
    stiffness: Stiffness,
    cohesion: f64,
    friction: f64,
    shear: MobilisedShear,
    /// The point at which the rim enters the soil.
    entry: RimPoint,
}

/// What a theory decides about a soil under a moving wheel before the stresses are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Response {
    /// Sinkage growth, *ζ* [-]: the pressure at depth z is the law's at z/ζ.
    pub(super) sinkage_growth: f64,
    /// Exit-angle ratio, *λ* [-].
    pub(super) exit_ratio: f64,
    /// Coefficient of friction between rim and soil [-].
    pub(super) friction: f64,
}

impl Response {
    /// That of the classical theory.
    pub(super) fn classical(contact: &Contact) -> Self {
        Self {
            sinkage_growth: 1.0,
            exit_ratio: contact.soil.exit.ratio(contact.slip.ratio),
            friction: contact.soil.friction_angle.tan(),
        }
    }
}

/// The shear law with its moduli at the slip angle.
#[derive(Clone, Copy, Debug)]
enum MobilisedShear {
    Anisotropic { longitudinal: f64, lateral: f64 },
    Isotropic { modulus: f64 },
}

impl MobilisedShear {
    fn new(soil: &Soil, slip_angle: f64) -> Self {
        match &soil.shear {
            Shear::Anisotropic { longitudinal, lateral } => Self::Anisotropic {
                longitudinal: longitudinal.at(slip_angle),
                lateral: lateral.at(slip_angle),
            },
            Shear::Isotropic { modulus } => Self::Isotropic { modulus: modulus.at(slip_angle) },
        }
    }
}

/// At most this many points divide the arc into pieces on which the stresses are smooth: entry,
/// exit, stress peak, two zeros of the shear displacement, two of the slip velocity.
pub(super) const MOST_BREAKS: usize = 7;

impl StressField {
    /// The stresses of a wheel sunk by `sinkage` [m].
    #[must_use]
    pub fn new(contact: &Contact, sinkage: f64) -> Self {
        Self::of_response(contact, sinkage, &Response::classical(contact))
    }

    /// The stresses of a wheel sunk by `sinkage` [m] in a soil that responds in its own way.
    pub(super) fn of_response(contact: &Contact, sinkage: f64, response: &Response) -> Self {
        let Contact { wheel, soil, slip, gravity } = contact;
        let unit_weight = soil.unit_weight(*gravity);
        let radius = wheel.shearing_radius();
        let peak_share = soil.stress_peak.share(slip.ratio);
        let patch = ContactPatch::of_depth(sinkage / radius, peak_share, response.exit_ratio);
        let law = soil.pressure_sinkage;
        let rigid = law.stiffness(wheel.width, soil.cohesion, unit_weight, slip.ratio);
        // σ = K (z/ζ)ⁿ, written as a modulus of its own.
        let modulus = rigid.modulus / response.sinkage_growth.powf(rigid.exponent);
        Self {
            patch,
            entry: RimPoint::new(patch.entry, 0.0),
            radius,
            slip: *slip,
            stiffness: Stiffness { modulus, ..rigid },
            cohesion: soil.cohesion,
            friction: response.friction,
            shear: MobilisedShear::new(soil, slip.angle),
        }
    }

    /// The stresses at an angle [rad] on the rim; none outside the arc.
    #[must_use]
    pub fn at(&self, angle: f64) -> RimStress {
        if angle > self.patch.exit && angle < self.patch.entry {
            self.stress(&self.point(self.patch.entry - angle))
        } else {
            RimStress::default()
        }
    }

    /// The point of the arc `behind_entry` [rad] away from its front end.
    #[inline]
    pub(super) fn point(&self, behind_entry: f64) -> RimPoint {
        RimPoint::new(self.patch.entry - behind_entry, behind_entry)
    }

    /// The stresses at a point of the arc.
    #[inline]
    pub(super) fn stress(&self, point: &RimPoint) -> RimStress {
        let normal = self.normal(point);
        let (longitudinal, lateral) = self.shear(normal, point);
        RimStress { normal, longitudinal, lateral }
    }

    /// The largest normal stress on the rim, σ_max = σ(θ_m) [Pa].
    #[must_use]
    pub fn max_normal(&self) -> f64 {
        self.normal(&self.point(self.patch.entry - self.patch.max_stress))
    }

    /// Normal stress, *σ* [Pa].
    ///
    /// ```text
    /// θ ≥ θ_m   σ = K_σ r_sⁿ (cos θ − cos θ_f)ⁿ
    /// θ < θ_m   the same at θ_e = θ_f − (θ − θ_r)(θ_f − θ_m)/(θ_m − θ_r)
    /// ```
    #[inline]
    fn normal(&self, point: &RimPoint) -> f64 {
        let ContactPatch { entry, max_stress, exit } = self.patch;
        let height = if point.angle >= max_stress {
            point.height
        } else {
            let mirrored = (point.angle - exit) * (entry - max_stress) / (max_stress - exit);
            let sin_half = (0.5 * (entry - mirrored)).sin();
            2.0 * sin_half * sin_half
        };
        self.stiffness.pressure(self.radius * (self.entry.height - height))
    }

    /// Shear displacement of the soil against the rim since it entered [m], along and across.
    ///
    /// ```text
    /// j_x = r_s [±(θ_f − θ) − v_x/|r_s ω| (sin θ_f − sin θ)]      ± the sense of the rim
    /// j_y = r_s v_y/|r_s ω| (θ_f − θ)
    /// ```
    ///
    /// For a driving wheel v_x/|r_s ω| is 1 − s and this is Ishigami et al. (2007). As the rim
    /// comes to rest j grows beyond all bounds: a locked wheel mobilises the full strength.
    #[inline]
    fn displacement(&self, point: &RimPoint) -> (f64, f64) {
        let Slip { rim, forward, lateral, .. } = self.slip;
        let rise = self.entry.sin - point.sin;
        let j_x = self.radius * (rim * point.behind_entry - forward * rise);
        let j_y = self.radius * lateral * point.behind_entry;
        (j_x, j_y)
    }

    /// Velocity of the rim against the soil over the rim's speed [-], along and across.
    #[inline]
    fn slip_velocity(&self, point: &RimPoint) -> (f64, f64) {
        (self.slip.rim - self.slip.forward * point.cos, self.slip.lateral)
    }

    /// Shear stresses, *τ_x* and *τ_y* [Pa], for a normal stress.
    ///
    /// ```text
    /// anisotropic   τ_x = ±(c + σ tan φ)(1 − e^(−|j_x|/K_x)) with the sign of j_x; τ_y alike, against v_y
    /// isotropic     |τ| = (c + σ tan φ)(1 − e^(−|j|/K)), against the slip velocity
    /// ```
    #[inline]
    fn shear(&self, normal: f64, point: &RimPoint) -> (f64, f64) {
        let strength = self.cohesion + normal * self.friction;
        let (j_x, j_y) = self.displacement(point);
        match self.shear {
            MobilisedShear::Anisotropic { longitudinal, lateral } => {
                let along = strength * mobilised(j_x, longitudinal);
                let across = if j_y == 0.0 { 0.0 } else { -strength * mobilised(j_y, lateral) };
                (along, across)
            }
            MobilisedShear::Isotropic { modulus } => {
                let (v_x, v_y) = self.slip_velocity(point);
                let speed = v_x.hypot(v_y);
                if speed == 0.0 {
                    return (0.0, 0.0);
                }
                let stress = strength * mobilised(j_x.hypot(j_y), modulus);
                (stress * v_x / speed, -stress * v_y / speed)
            }
        }
    }

    /// The ends of the pieces of the arc on which the stresses are smooth, in falling order:
    /// how many of the array's numbers count, and they.
    ///
    /// A driving wheel has two pieces, before and behind the stress peak. Where the rim skids,
    /// the shear displacement (or, in the isotropic law, the slip velocity) changes sign within
    /// the arc; a quadrature across that corner would lose most of its digits.
    pub(super) fn breaks(&self) -> (usize, [f64; MOST_BREAKS]) {
        let ContactPatch { entry, max_stress, exit } = self.patch;
        let mut breaks = [entry, max_stress, exit, exit, exit, exit, exit];
        let mut count = 3;
        let mut add = |angle: f64| {
            if angle > exit && angle < entry {
                breaks[count] = angle;
                count += 1;
            }
        };
        // Where the rim is as fast as the soil under it: cos θ = r_s ω / v_x.
        let still = self.slip.rim / self.slip.forward;
        if matches!(self.shear, MobilisedShear::Isotropic { .. }) {
            /// A rim slightly faster than its hub is never as fast as the soil, but nearly so under
            /// the hub, where the slip velocity then turns; up to here [-] too sharply for the rule.
            const TURNS_UNDER_HUB: f64 = 1.25;
            if still > 0.0 && still < 1.0 {
                add(still.acos());
                add(-still.acos());
            } else if (1.0..TURNS_UNDER_HUB).contains(&still) {
                add(0.0);
            }
        }
        if still > 0.0 && still < 1.0 {
            let still = still.acos();
            // Between these angles j_x is monotone.
            self.displacement_zero(-still, still).map(&mut add);
            self.displacement_zero(exit, -still).map(&mut add);
        }
        breaks[..count].sort_by(|a, b| b.total_cmp(a));
        (count, breaks)
    }

    /// The angle between two others at which *j_x* changes sign, if it does.
    fn displacement_zero(&self, low: f64, high: f64) -> Option<f64> {
        let ContactPatch { entry, exit, .. } = self.patch;
        let (low, high) = (low.max(exit), high.min(entry));
        let displacement = |angle: f64| self.displacement(&self.point(entry - angle)).0;
        if low >= high || displacement(low) * displacement(high) >= 0.0 {
            return None;
        }
        /// A corner this near to a piece's end [rad] no longer costs digits.
        const NEAR_ENOUGH: f64 = 1e-12;
        Some(root::between(displacement, low, high, NEAR_ENOUGH))
    }
}

/// Share of the shear strength mobilised after a displacement, with its sign [-].
#[inline]
fn mobilised(displacement: f64, modulus: f64) -> f64 {
    (1.0 - (-displacement.abs() / modulus).exp()).copysign(displacement)
}
