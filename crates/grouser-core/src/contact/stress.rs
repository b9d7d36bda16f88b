//! Normal and shear stress along the rim (Wong and Reece 1967; Janosi and Hanamoto 1961).

#![expect(
    clippy::inline_always,
    reason = "the kernel compiles these formulas for several instruction sets"
)]

mod breaks;
pub(super) mod wheels;

use std::f64::consts::FRAC_PI_2;

use super::cohesion::Cohesion;
use super::inputs::Contact;
use super::patch::ContactPatch;
use super::slip::Slip;
use crate::elementary;
use crate::soil::pressure_sinkage::ScaledPressure;
use crate::soil::{Shear, ShearBound, Soil};

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
    pub(super) behind_entry: f64,
    /// *θ* [rad].
    pub(super) angle: f64,
    /// sin θ [-].
    pub(super) sin: f64,
    /// Height over the rim's lowest point, (1 − cos θ) [radii].
    pub(super) height: f64,
}

impl RimPoint {
    #[inline(always)]
    pub(super) fn new(angle: f64, behind_entry: f64) -> Self {
        // By the half angle, so that shallow contact keeps its digits.
        let (sin_half, cos_half) = elementary::sin_cos(0.5 * angle);
        let height = 2.0 * sin_half * sin_half;
        Self { behind_entry, angle, sin: 2.0 * sin_half * cos_half, height }
    }

    /// cos θ [-].
    #[inline(always)]
    pub(super) fn cosine(&self) -> f64 {
        1.0 - self.height
    }
}

/// How a rim moves against the soil, in hub and rim speeds over the rim's: what stresses know of a
/// [`Slip`].
#[derive(Clone, Copy, Debug)]
struct RimMotion {
    /// Sense of the rim [-].
    rim: f64,
    /// v_x / |ω r_s| [-].
    forward: f64,
    /// v_y / |ω r_s| [-].
    lateral: f64,
    /// The angle on either side of straight down at which the rim is as fast as the soil under it
    /// [rad], cos θ = r_s ω / v_x; NaN where there is none.
    still: f64,
}

impl From<Slip> for RimMotion {
    fn from(Slip { rim, forward, lateral, .. }: Slip) -> Self {
        let share = rim / forward;
        let is_skidding = share > 0.0 && share < 1.0;
        let still = if is_skidding { elementary::wide::acos(share) } else { f64::NAN };
        Self { rim, forward, lateral, still }
    }
}

/// All that decides the stresses on a wheel's rim, but for the sinkage.
#[derive(Clone, Copy, Debug)]
pub(super) struct StressLaw {
    radius: f64,
    motion: RimMotion,
    /// Pressure at the depth of [`Self::scale`] [Pa].
    pressure: f64,
    /// Depth of the pressure-sinkage law [radii].
    scale: f64,
    exponent: f64,
    cohesion: Cohesion,
    friction: f64,
    shear: MobilisedShear,
    /// θ_m/θ_f [-].
    peak_share: f64,
    exit_ratio: f64,
}

/// What a model decides about a soil under a moving wheel before the stresses are known.
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
    /// Returns the response in the classical model.
    pub(super) fn classical(contact: &Contact) -> Self {
        Self {
            sinkage_growth: 1.0,
            exit_ratio: contact.soil.exit.ratio(contact.slip.ratio),
            friction: contact.soil.mobilised_friction(),
        }
    }
}

impl StressLaw {
    /// The law of a soil that responds to the wheel in its own way.
    pub(super) fn new(contact: &Contact, response: &Response) -> Self {
        let Contact { wheel, soil, slip, gravity } = contact;
        let unit_weight = soil.unit_weight(*gravity);
        let law = soil.pressure_sinkage;
        let ScaledPressure { at_scale, scale, exponent } =
            law.scaled(wheel.width, soil.cohesion, unit_weight, slip.ratio);
        let radius = wheel.shearing_radius();
        Self {
            radius,
            motion: (*slip).into(),
            pressure: at_scale,
            // σ = K (z/ζ)ⁿ
            scale: scale * response.sinkage_growth / radius,
            exponent,
            cohesion: Cohesion::of(soil),
            friction: response.friction,
            shear: MobilisedShear::new(soil, slip.angle),
            peak_share: soil.stress_peak.share(slip.ratio),
            exit_ratio: response.exit_ratio,
        }
    }

    /// Whether the arc has no breaks ([`StressField::breaks`]) but the stress peak: the rim is
    /// faster than the soil under it everywhere, and not nearly as slow where that matters.
    #[inline(always)]
    pub(super) fn has_two_pieces(&self) -> bool {
        let margin = match self.shear {
            MobilisedShear::Anisotropic(_) | MobilisedShear::Bounded(_) => 1.0,
            MobilisedShear::Isotropic(_) => TURNS_UNDER_HUB,
        };
        self.motion.rim >= margin * self.motion.forward
    }

    /// Whether the slip velocity of an arc of two pieces turns under the hub, if not sharply.
    #[inline(always)]
    pub(super) fn turns_under_hub(&self) -> bool {
        const HARDLY: f64 = 1.6;
        self.motion.rim < HARDLY * self.motion.forward
    }

    /// Whether the soil shears much faster along the arc than under a wheel that rolls freely: the
    /// rim turns less than half as fast as the soil passes it.
    #[inline(always)]
    pub(super) fn shears_at_once(&self) -> bool {
        let RimMotion { forward, lateral, .. } = self.motion;
        const FAST: f64 = 2.0;
        forward.abs() > FAST || lateral.abs() > FAST
    }

    /// The shear law, ready to be asked.
    pub(super) fn shear_law(&self) -> MobilisedShear {
        self.shear
    }

    /// The angle on either side of straight down at which the rim is as fast as the soil [rad]; NaN
    /// where there is none.
    pub(super) fn still(&self) -> f64 {
        self.motion.still
    }

    /// *r_s* [m].
    pub(super) fn radius(&self) -> f64 {
        self.radius
    }

    /// The stresses of the wheel sunk by `sinkage` [m].
    #[inline(always)]
    pub(super) fn sunk(&self, sinkage: f64) -> StressField {
        let depth = sinkage / self.radius;
        let patch = ContactPatch::of_depth(depth, self.peak_share, self.exit_ratio);
        let ContactPatch { entry, max_stress, exit } = patch;
        let (ahead, behind) = (entry - max_stress, max_stress - exit);
        // The height of the surface is the depth: no need to ask the angle.
        let height = depth.clamp(0.0, 2.0);
        StressField {
            patch,
            entry_sin: (height * (2.0 - height)).sqrt(),
            entry_height: height,
            per_scale: 1.0 / self.scale,
            squeeze: if behind > 0.0 { ahead / behind } else { 0.0 },
            max_normal: 0.0,
            cohesion: 0.0,
            law: *self,
        }
        .pressed()
    }

    /// More than ∫ (τ_x sin θ + σ cos θ) dθ [Pa·rad] at this sinkage [m] and at all that are
    /// shallower.
    ///
    /// ```text
    /// σ (sin θ_f + sin |θ_r|) + (c + σ tan φ) (2 − cos θ_f − cos θ_r)      σ = K_σ hⁿ
    /// ```
    pub(super) fn most_up(&self, sinkage: f64) -> f64 {
        let depth = sinkage / self.radius;
        let arc = ContactPatch::of_depth(depth, self.peak_share, self.exit_ratio);
        let pressure = self.pressure * elementary::pow(depth / self.scale, self.exponent);
        let (ahead, behind) = (arc.entry, -arc.exit);
        let reach = |angle: f64| elementary::sin(angle.min(FRAC_PI_2));
        let rise = |angle: f64| RimPoint::new(angle, 0.0).height;
        pressure * (reach(ahead) + reach(behind))
            + (self.cohesion.full + pressure * self.friction) * (rise(ahead) + rise(behind))
    }

    /// F_z of a shallow wheel without shear over r_s b: the factor [Pa/m^p] and the power p of its
    /// sinkage.
    ///
    /// ```text
    /// F_z ≈ r_s b K_σ hⁿ θ_f (1 + √λ)/(1 − a) ∫ₐ¹ (1 − t²)ⁿ dt        a = θ_m/θ_f,  θ_f = √(2h/r_s)
    /// ```
    ///
    /// with t = 1 − (1 − a) u and the integral by one node for the weight uⁿ, to a hundredth.
    #[inline(always)]
    pub(super) fn shallow(&self) -> (f64, f64) {
        let (n, front) = (self.exponent, 1.0 - self.peak_share);
        let node = (n + 1.0) / (n + 2.0);
        let scale = self.scale * self.radius;
        let profile = elementary::pow(front * (2.0 - front * node) / scale, n) / (n + 1.0);
        let arc = (2.0 / self.radius).sqrt() * (1.0 + self.exit_ratio.sqrt()) * profile;
        (self.pressure * arc, self.shallow_exponent())
    }

    /// The power of the sinkage [-] in the same: n + ½.
    #[inline(always)]
    pub(super) fn shallow_exponent(&self) -> f64 {
        self.exponent + 0.5
    }
}

/// The shear law with its moduli at the slip angle.
#[derive(Clone, Copy, Debug)]
pub(super) enum MobilisedShear {
    Anisotropic(AnisotropicShear),
    Bounded(BoundedShear),
    Isotropic(IsotropicShear),
}

/// 1/*K_x* and 1/*K_y* [1/m].
#[derive(Clone, Copy, Debug)]
pub(super) struct AnisotropicShear {
    per_longitudinal: f64,
    per_lateral: f64,
}

/// The same, with a resultant within the soil's strength.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoundedShear(AnisotropicShear);

/// 1/*K* [1/m].
#[derive(Clone, Copy, Debug)]
pub(super) struct IsotropicShear {
    per_modulus: f64,
}

impl MobilisedShear {
    fn new(soil: &Soil, slip_angle: f64) -> Self {
        match &soil.shear {
            Shear::Anisotropic { longitudinal, lateral } => {
                let each = AnisotropicShear {
                    per_longitudinal: 1.0 / longitudinal.at(slip_angle),
                    per_lateral: 1.0 / lateral.at(slip_angle),
                };
                match soil.shear_bound {
                    ShearBound::None => Self::Anisotropic(each),
                    ShearBound::Coulomb => Self::Bounded(BoundedShear(each)),
                }
            }
            Shear::Isotropic { modulus } => {
                Self::Isotropic(IsotropicShear { per_modulus: 1.0 / modulus.at(slip_angle) })
            }
        }
    }
}

/// Shear stresses, *τ_x* and *τ_y* [Pa], where the soil has a strength of c + σ tan φ [Pa].
///
/// ```text
/// anisotropic   τ_x = ±(c + σ tan φ)(1 − e^(−|j_x|/K_x)) with the sign of j_x; τ_y alike, against v_y
/// bounded       both of them by the factor √(1 − m_x² m_y²/(m_x² + m_y²)), m the shares mobilised
/// isotropic     |τ| = (c + σ tan φ)(1 − e^(−|j|/K)), against the slip velocity
/// ```
///
/// The bounded law has |τ|² = (c + σ tan φ)² (1 − (1 − m_x²)(1 − m_y²)): within the strength, equal
/// to it only where one axis is fully mobilised, and the anisotropic one where the wheel slips
/// along one axis alone. A factor that sets in only beyond the strength would bend the stress
/// within the arc.
///
/// A law is asked in two steps, so that the kernel can compute all exponentials of many wheels at
/// once.
pub(super) trait ShearLaw {
    /// What e is raised to at a point: minus the displacements over their moduli [-]. A law with
    /// one modulus has one of them twice.
    fn decays(&self, slipping: &Slipping) -> [f64; 2];

    /// * `strength`: c + σ tan φ [Pa]
    /// * `unmobilised`: e to the power of the [`decays`](Self::decays) [-]
    fn stresses(&self, strength: f64, unmobilised: [f64; 2], slipping: &Slipping) -> (f64, f64);
}

/// How the rim slips over the soil at a point, along and across the wheel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slipping {
    /// Shear displacement of the soil since it entered, *j_x* and *j_y* [m].
    displacement: (f64, f64),
    /// Velocity of the rim against the soil, over the rim's speed [-].
    velocity: (f64, f64),
}

impl ShearLaw for AnisotropicShear {
    #[inline(always)]
    fn decays(&self, slipping: &Slipping) -> [f64; 2] {
        let (j_x, j_y) = slipping.displacement;
        [-j_x.abs() * self.per_longitudinal, -j_y.abs() * self.per_lateral]
    }

    #[inline(always)]
    fn stresses(&self, strength: f64, unmobilised: [f64; 2], slipping: &Slipping) -> (f64, f64) {
        let (j_x, j_y) = slipping.displacement;
        let across = -strength * mobilised(unmobilised[1], j_y);
        let along = strength * mobilised(unmobilised[0], j_x);
        (along, if j_y == 0.0 { 0.0 } else { across })
    }
}

impl ShearLaw for BoundedShear {
    #[inline(always)]
    fn decays(&self, slipping: &Slipping) -> [f64; 2] {
        self.0.decays(slipping)
    }

    #[inline(always)]
    fn stresses(&self, strength: f64, unmobilised: [f64; 2], slipping: &Slipping) -> (f64, f64) {
        let (j_x, j_y) = slipping.displacement;
        let along = mobilised(unmobilised[0], j_x);
        let across = mobilised(unmobilised[1], j_y);
        let (x_2, y_2) = (along * along, across * across);
        let sum = x_2 + y_2;
        let both = x_2 * y_2 / if sum > f64::MIN_POSITIVE { sum } else { 1.0 };
        let within = strength * (1.0 - both).sqrt();
        (within * along, if j_y == 0.0 { 0.0 } else { -within * across })
    }
}

impl ShearLaw for IsotropicShear {
    #[inline(always)]
    fn decays(&self, slipping: &Slipping) -> [f64; 2] {
        let (j_x, j_y) = slipping.displacement;
        [-(j_x * j_x + j_y * j_y).sqrt() * self.per_modulus; 2]
    }

    #[inline(always)]
    fn stresses(&self, strength: f64, unmobilised: [f64; 2], slipping: &Slipping) -> (f64, f64) {
        /// Slower than this [-] is at rest; its square is still a number.
        const AT_REST: f64 = 1e-150;
        let (v_x, v_y) = slipping.velocity;
        let speed = (v_x * v_x + v_y * v_y).sqrt();
        let per_speed = 1.0 / if speed > AT_REST { speed } else { AT_REST };
        let stress = strength * mobilised(unmobilised[0], 1.0);
        (stress * (v_x * per_speed), -stress * (v_y * per_speed))
    }
}

/// Share of the shear strength mobilised after a displacement, with its sign [-].
#[inline(always)]
fn mobilised(unmobilised: f64, displacement: f64) -> f64 {
    (1.0 - unmobilised).copysign(displacement)
}

/// The stresses along the arc of one wheel at one sinkage.
///
/// All lengths are on the shearing radius *r_s*. The wheel enters the soil at its front: a wheel
/// that rolls backward is looked at in the mirror ([`Slip::front_to_back`]).
///
/// The formulas are free of branches, so that the kernel can evaluate them at many points at once.
#[derive(Clone, Copy, Debug)]
pub struct StressField {
    /// The arc in contact.
    pub patch: ContactPatch,
    law: StressLaw,
    /// Point at which the rim enters the soil: sin θ_f [-] and 1 − cos θ_f [-].
    entry_sin: f64,
    entry_height: f64,
    /// 1 over the depth of the pressure-sinkage law [1/radii].
    per_scale: f64,
    /// How much longer the arc before the stress peak is than the one behind it,
    /// (θ_f − θ_m)/(θ_m − θ_r) [-].
    squeeze: f64,
    /// σ_m = σ(θ_m) [Pa].
    max_normal: f64,
    /// Mobilised, *c_m* [Pa].
    cohesion: f64,
}

/// A rim slightly faster than its hub is never as fast as the soil, but nearly so under the hub,
/// where the slip velocity then turns; up to here [-], in hub speeds, too sharply for the isotropic
/// law's rule.
const TURNS_UNDER_HUB: f64 = 1.25;

impl StressField {
    /// The stresses of a wheel sunk by `sinkage` [m].
    #[must_use]
    pub fn new(contact: &Contact, sinkage: f64) -> Self {
        StressLaw::new(contact, &Response::classical(contact)).sunk(sinkage)
    }

    /// The stresses at an angle [rad] on the rim; none outside the arc.
    #[must_use]
    pub fn at(&self, angle: f64) -> RimStress {
        if angle > self.patch.exit && angle < self.patch.entry {
            let point = self.point(self.patch.entry - angle);
            match self.law.shear {
                MobilisedShear::Anisotropic(law) => self.stress(&law, self.normal(&point), &point),
                MobilisedShear::Bounded(law) => self.stress(&law, self.normal(&point), &point),
                MobilisedShear::Isotropic(law) => self.stress(&law, self.normal(&point), &point),
            }
        } else {
            RimStress::default()
        }
    }

    /// Shear displacement of the soil against the rim since it entered [m], along and across, at an
    /// angle [rad] on the rim; none outside the arc. Of a locked wheel it is infinite.
    #[must_use]
    pub fn shear_displacement(&self, angle: f64) -> [f64; 2] {
        if (self.patch.exit..=self.patch.entry).contains(&angle) {
            let (along, across) = self.displacement(&self.point(self.patch.entry - angle));
            [along, across]
        } else {
            [0.0; 2]
        }
    }

    /// What holds at any sinkage.
    pub(super) fn law(&self) -> &StressLaw {
        &self.law
    }

    /// The point of the arc `behind_entry` [rad] away from its front end.
    #[inline(always)]
    pub(super) fn point(&self, behind_entry: f64) -> RimPoint {
        RimPoint::new(self.patch.entry - behind_entry, behind_entry)
    }

    /// The stresses at a point of the arc with a [`normal`](Self::normal) stress [Pa].
    #[inline(always)]
    pub(super) fn stress(&self, shear: &impl ShearLaw, normal: f64, point: &RimPoint) -> RimStress {
        let slipping = self.slipping(point);
        let unmobilised = shear.decays(&slipping).map(elementary::exp);
        let (longitudinal, lateral) = self.shear(shear, normal, unmobilised, &slipping);
        RimStress { normal, longitudinal, lateral }
    }

    /// The shear stresses there, by what e to the power of the law's decays is.
    #[inline(always)]
    pub(super) fn shear(
        &self,
        shear: &impl ShearLaw,
        normal: f64,
        unmobilised: [f64; 2],
        slipping: &Slipping,
    ) -> (f64, f64) {
        let strength = self.cohesion + normal * self.law.friction;
        shear.stresses(strength, unmobilised, slipping)
    }

    /// How the rim slips over the soil at a point of the arc.
    #[inline(always)]
    pub(super) fn slipping(&self, point: &RimPoint) -> Slipping {
        Slipping { displacement: self.displacement(point), velocity: self.slip_velocity(point) }
    }

    /// The largest normal stress on the rim, σ_max = σ(θ_m) [Pa].
    #[must_use]
    #[inline(always)]
    pub fn max_normal(&self) -> f64 {
        self.max_normal
    }

    /// Share of the cohesion that is mobilised [-].
    #[inline(always)]
    pub(super) fn cohesion_share(&self) -> f64 {
        self.law.cohesion.share(self.max_normal)
    }

    /// These stresses with their largest normal one filled in, and the cohesion under it.
    #[inline(always)]
    fn pressed(self) -> Self {
        let sin_half = elementary::sin(0.5 * self.patch.max_stress);
        let max_normal = self.front_normal(2.0 * sin_half * sin_half);
        let cohesion = self.law.cohesion.mobilised(max_normal);
        Self { max_normal, cohesion, ..self }
    }

    /// Normal stress, *σ* [Pa].
    ///
    /// ```text
    /// θ ≥ θ_m   σ = K_σ r_sⁿ (cos θ − cos θ_f)ⁿ
    /// θ < θ_m   the same at θ_e = θ_f − (θ − θ_r)(θ_f − θ_m)/(θ_m − θ_r)
    /// ```
    #[inline(always)]
    pub(super) fn normal(&self, point: &RimPoint) -> f64 {
        self.front_normal(self.front_height(point))
    }

    /// The height over the rim's lowest point at which the rim before the peak has the stress of a
    /// point [radii].
    #[inline(always)]
    pub(super) fn front_height(&self, point: &RimPoint) -> f64 {
        let ContactPatch { entry, max_stress, exit } = self.patch;
        let mirrored = entry - (point.angle - exit) * self.squeeze;
        let sin_half = elementary::sin(0.5 * mirrored);
        let behind_peak = point.angle < max_stress;
        if behind_peak { 2.0 * sin_half * sin_half } else { point.height }
    }

    /// The same before the peak, by the height over the rim's lowest point [radii].
    #[inline(always)]
    pub(super) fn front_normal(&self, height: f64) -> f64 {
        let depth = self.depth(height);
        self.normal_at(depth, elementary::ln(depth))
    }

    /// The depth of a point before the peak, on that of the pressure-sinkage law [-].
    #[inline(always)]
    pub(super) fn depth(&self, height: f64) -> f64 {
        (self.entry_height - height) * self.per_scale
    }

    /// Normal stress [Pa] at a depth [-] with its logarithm.
    #[inline(always)]
    pub(super) fn normal_at(&self, depth: f64, log: f64) -> f64 {
        self.law.pressure * elementary::pow_of_log(depth, log, self.law.exponent)
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
    #[inline(always)]
    fn displacement(&self, point: &RimPoint) -> (f64, f64) {
        let RimMotion { rim, forward, lateral, .. } = self.law.motion;
        let rise = self.entry_sin - point.sin;
        let j_x = self.law.radius * (rim * point.behind_entry - forward * rise);
        let j_y = self.law.radius * lateral * point.behind_entry;
        (j_x, j_y)
    }

    /// Velocity of the rim against the soil over the rim's speed [-], along and across.
    #[inline(always)]
    fn slip_velocity(&self, point: &RimPoint) -> (f64, f64) {
        let RimMotion { rim, forward, lateral, .. } = self.law.motion;
        (rim - forward * point.cosine(), lateral)
    }
}
