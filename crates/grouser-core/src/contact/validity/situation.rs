//! What the rules of validity are about: the flags, and a wheel on a soil.

use std::ops::RangeInclusive;

use super::super::equilibrium::Settled;
use super::super::models::Model;
use super::super::slip::Slip;
use crate::soil::{Domain, Soil, Span};
use crate::wheel::Wheel;

/// Why a result is to be trusted less than the model's errors within its domain suggest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Flag {
    /// The wheel's load is outside the soil's domain.
    LoadOutside,
    /// The wheel is smaller or larger than those for which the model was tested.
    RadiusOutside,
    /// The soil's constants were fitted to a wheel of another radius or width.
    OtherWheel,
    /// The wheel sinks deeper than the theory allows.
    SinkageOutside,
    /// The slip ratio is outside the domain.
    SlipOutside,
    /// The slip angle is outside the domain.
    SlipAngleOutside,
    /// The soil's constants are stated for another gravity.
    GravityOutside,
    /// Bekker's moduli were measured under another gravity.
    BekkerGravity,
    /// Bekker's moduli are so small that they look like kN.
    ModulusDoubtful,
    /// The slope comes near to where the ground itself slides.
    SlopeBeyondStrength,
    /// The grousers are deeper than the wheel sinks.
    GrousersExposed,
    /// The grousers are too far apart to move the soil between them as one body.
    GrousersApart,
    /// At times no grouser is in the soil.
    GrouserNumber,
    /// The wheel pushes harder along the ground than the soil's friction allows.
    ForceBeyondFriction,
    /// The theory has no side force.
    NoSideForce,
    /// The model has no cohesion.
    NoCohesion,
    /// The soil lacks the terms that the model adds.
    TermsMissing,
    /// Values of the soil are assumed.
    Assumed,
}

impl Flag {
    /// All of them.
    pub const ALL: [Self; 18] = [
        Self::LoadOutside,
        Self::RadiusOutside,
        Self::OtherWheel,
        Self::SinkageOutside,
        Self::SlipOutside,
        Self::SlipAngleOutside,
        Self::GravityOutside,
        Self::BekkerGravity,
        Self::ModulusDoubtful,
        Self::SlopeBeyondStrength,
        Self::GrousersExposed,
        Self::GrousersApart,
        Self::GrouserNumber,
        Self::ForceBeyondFriction,
        Self::NoSideForce,
        Self::NoCohesion,
        Self::TermsMissing,
        Self::Assumed,
    ];
}

/// What a flag is called, what it means, and when it is raised.
#[derive(Debug)]
pub struct Rule {
    /// The flag.
    pub flag: Flag,
    /// Its name in results.
    pub name: &'static str,
    /// Whether nobody is to drive by a result that carries it: the model's law, or the constants,
    /// are known to be wrong there. Where the bands cover what is left out, as grousers that are
    /// few, or a value that is assumed, it does not; nor does a slip, which verdicts limit anyway.
    pub forbids_driving: bool,
    /// What it means: a sentence.
    pub meaning: &'static str,
    /// The compared number, in words.
    pub quantity: &'static str,
    /// When it is raised, with its threshold.
    pub criterion: &'static str,
    /// Where the threshold comes from.
    pub source: &'static str,
    /// The number, and the range in which it raises nothing; nothing where the rule does not apply.
    pub(super) judge: fn(&Situation<'_>) -> Option<(f64, Span)>,
}

/// What the rules look at: a wheel on a soil, and as much of its motion and result as there is.
///
/// Which flags does a wheel of HAKUTO carry on 15° of slip angle and a slip ratio of 0.95?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::contact::validity::Situation;
/// use grouser_core::contact::{Contact, Slip, Model, settle};
/// use grouser_core::units::{EARTH_GRAVITY, deg};
///
/// let slip = Slip::on_test_stand(0.95, deg(15.0));
/// let contact = Contact { wheel: paper::hakuto_wheel(), soil: paper::toyoura(), slip, gravity: EARTH_GRAVITY };
/// let settled = settle(Model::Ishigami.as_ref(), &contact, 17.0)?;
/// let situation = Situation {
///     model: &Model::Ishigami,
///     wheel: &contact.wheel,
///     soil: &contact.soil,
///     gravity: contact.gravity,
///     slope: 0.0,
///     load: Some(17.0),
///     slip: Some(slip),
///     settled: Some(&settled),
/// };
/// let names: Vec<&str> = situation.findings().iter().map(|it| it.flag.name()).collect();
/// assert_eq!(names, ["slip-outside"]);
/// # Ok::<(), grouser_core::contact::SettleError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Situation<'a> {
    /// The wheel–soil model.
    pub model: &'a Model,
    /// The wheel.
    pub wheel: &'a Wheel,
    /// The soil under it.
    pub soil: &'a Soil,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// Slope of the ground, *α* [rad]; 0 on a test stand.
    pub slope: f64,
    /// The wheel's load [N], if it is known.
    pub load: Option<f64>,
    /// How the rim moves against the soil, if it is known.
    pub slip: Option<Slip>,
    /// The settled wheel, if it settles.
    pub settled: Option<&'a Settled>,
}

impl Situation<'_> {
    /// The ranges of the model and the soil together.
    pub(super) fn domain(&self, of: fn(&Domain) -> Span) -> Span {
        of(&self.model.domain()).and(of(&self.soil.domain))
    }
}

/// The moduli k_c/b + k_φ [N/m^(n+2)] that look like kN rather than N.
///
/// Source: ours. The softest ground in Wong's table, snow, has 6.6e4; soils written in kN have some
/// hundred to some thousand.
pub const DOUBTFUL_MODULUS: RangeInclusive<f64> = 10.0..=1e4;
