//! The rules of validity, one for each flag.

use std::f64::consts::{PI, TAU};

use super::super::cohesion::Cohesion;
use super::super::equilibrium::Settled;
use super::super::forces::WheelForces;
use super::super::inputs::Contact;
use super::super::models::Model;
use super::super::small_wheel::SmallWheel as SmallWheelModel;
use super::super::{coulomb, coulomb_cone, discrepancy};
use super::situation::{DOUBTFUL_MODULUS, Flag, Rule, Situation};
use crate::elementary::wide;
use crate::soil::{PressureSinkage, ShearBound, SlopeStability, SmallWheel, Soil, Span};
use crate::units::EARTH_GRAVITY;
use crate::wheel::Grousers;

/// How far gravity may be from the Earth's where Bekker's moduli state none, as a share [-].
/// Source: ours; gravity on Earth differs by half a hundredth from place to place.
const SAME_GRAVITY: f64 = 0.01;

/// How far a wheel's size may be from the fit's, as a share [-]. Source: ours.
const SAME_SIZE: f64 = 0.02;

const NONE: Span = Span::at_most(0.0);

/// In the order of [`Flag::ALL`].
pub(super) static RULES: [Rule; Flag::ALL.len()] = [
    Rule {
        flag: Flag::LoadOutside,
        name: "load-outside",
        forbids_driving: true,
        meaning: "The wheel's load is outside the range in which the soil's constants were \
                  measured or fitted.",
        quantity: "load",
        criterion: "the load is outside the soil's `domain.load_n`",
        source: "the soil's document",
        judge: |it| Some((it.load?, it.domain(|domain| domain.load))),
    },
    Rule {
        flag: Flag::RadiusOutside,
        name: "radius-outside",
        forbids_driving: true,
        meaning: "The wheel is smaller or larger than those for which the model was tested.",
        quantity: "radius of the rim",
        criterion: "the radius of the rim is outside 0.09 to 0.63 m (`ishigami`), or below 0.25 m \
                    (`bekker`)",
        source: "wheels of Ishigami et al. (2007) and of Wong and Reece (1967); Bekker (1969): \
                 less accurate below 20 inches in diameter",
        judge: |it| Some((it.wheel.radius, it.model.domain().radius)),
    },
    Rule {
        flag: Flag::OtherWheel,
        name: "other-wheel",
        forbids_driving: false,
        meaning: "The soil's constants were fitted to a wheel of another radius or width.",
        quantity: "radius or width of the rim",
        criterion: "radius or width is more than 2 % outside the soil's `domain.radius_m` or \
                    `domain.width_m`",
        source: "the soil's document; the 2 % are ours",
        judge: other_wheel,
    },
    Rule {
        flag: Flag::SinkageOutside,
        name: "sinkage-outside",
        forbids_driving: true,
        meaning: "The wheel sinks deeper than the model holds, or than the tests behind the soil's \
                  constants went.",
        quantity: "sinkage over shearing radius",
        criterion: "h/r_s is above 1/3 (`ishigami`, `bekker`), 0.95 (`small-wheel`) or 1 (`rft`), \
                    or outside the soil's `domain.sinkage_over_radius`",
        source: "Bekker (1969): up to a sixth of the diameter; the deepest wheels of Pavlov and \
                 Johnson (2022); the axle",
        judge: |it| {
            let depth = it.settled?.sinkage / it.wheel.shearing_radius();
            Some((depth, it.domain(|domain| domain.depth)))
        },
    },
    Rule {
        flag: Flag::SlipOutside,
        name: "slip-outside",
        forbids_driving: false,
        meaning: "The slip ratio is outside the tests of the model or of the soil's fit, or near \
                  1.",
        quantity: "slip ratio",
        criterion: "s is outside -0.1 to 0.9 (`ishigami`, `bekker`), -1 to 0.975 (`small-wheel`), \
                    or the soil's `domain.slip_ratio`",
        source: "Ishigami et al. (2007): 0 to 0.8, a tenth more is ours; Pavlov and Johnson (2022)",
        judge: |it| Some((it.slip?.ratio, it.domain(|domain| domain.slip_ratio))),
    },
    Rule {
        flag: Flag::SlipAngleOutside,
        name: "slip-angle-outside",
        forbids_driving: true,
        meaning: "The slip angle is outside the tests of the model or of the soil's fit.",
        quantity: "slip angle",
        criterion: "β is above 45° to either side (`ishigami`) or 75° (`small-wheel`), or outside \
                    the soil's `domain.slip_angle_deg`",
        source: "Ishigami et al. (2007); Pavlov and Johnson (2022)",
        judge: |it| Some((it.slip?.angle.abs(), it.domain(|domain| domain.slip_angle))),
    },
    Rule {
        flag: Flag::GravityOutside,
        name: "gravity-outside",
        forbids_driving: false,
        meaning: "The soil's constants are stated for another gravity.",
        quantity: "gravity",
        criterion: "g is outside the soil's `domain.gravity_m_s2`",
        source: "the soil's document",
        judge: |it| Some((it.gravity, it.soil.domain.gravity)),
    },
    Rule {
        flag: Flag::BekkerGravity,
        name: "bekker-gravity",
        forbids_driving: true,
        meaning: "Bekker's moduli do not scale with gravity, and were measured under another one.",
        quantity: "gravity",
        criterion: "the soil has Bekker's law, and g is outside its `domain.gravity_m_s2`, or \
                    differs by more than 1 % from the Earth's where that is not stated; not for \
                    `rft`",
        source: "granular scaling, Slonaker et al. (2017), which these moduli do not obey",
        judge: bekker_gravity,
    },
    Rule {
        flag: Flag::ModulusDoubtful,
        name: "modulus-doubtful",
        forbids_driving: true,
        meaning: "Bekker's moduli are so small that they look like kN; they are taken as N.",
        quantity: "modulus k_c/b + k_phi",
        criterion: "Bekker's law with k_c/b + k_phi below 1e4 N/m^(n+2); not for `rft`",
        source: "ours; published soils, snow included, have more",
        judge: |it| Some((bekker_modulus(it)?, Span::at_least(*DOUBTFUL_MODULUS.end()))),
    },
    Rule {
        flag: Flag::SlopeBeyondStrength,
        name: "slope-beyond-strength",
        forbids_driving: false,
        meaning: "The slope comes near to where the ground itself slides.",
        quantity: "factor of safety of the ground",
        criterion: "an infinite slope that slides 1 m below its surface has a factor of safety \
                    below 1.3",
        source: "limit equilibrium of the infinite slope; 1.3 is usual for temporary slopes",
        judge: |it| {
            let SlopeStability { factor_of_safety, depth } = SlopeStability::USUAL;
            let safety = || it.soil.slope_safety(it.slope, it.gravity, depth);
            (it.slope > 0.0).then(|| (safety(), Span::at_least(factor_of_safety)))
        },
    },
    Rule {
        flag: Flag::GrousersExposed,
        name: "grousers-exposed",
        forbids_driving: false,
        meaning: "The grousers are deeper than the wheel sinks: the rim does not touch the soil, \
                  and the model, which takes the grousers as dense, has no law for their number.",
        quantity: "sinkage",
        criterion: "the sinkage of the tips is below the grousers' height; not for `rft`, which \
                    has their faces",
        source: "geometry",
        judge: |it| {
            let grousers = dense_grousers(it)?;
            Some((it.settled?.sinkage, Span::at_least(grousers.height)))
        },
    },
    Rule {
        flag: Flag::GrousersApart,
        name: "grousers-apart",
        forbids_driving: false,
        meaning: "The grousers are too far apart to move the soil between them as one body.",
        quantity: "spacing of the grousers",
        criterion: "2π/N is above [√((1 + h_g/r)² − (1 − z/r)²) − √(1 − (1 − z/r)²)] / (1 − s), z \
                    the sinkage of the rim; not for `rft`",
        source: "Skonieczny, Moreland and Wettergreen (2012)",
        judge: grousers_apart,
    },
    Rule {
        flag: Flag::GrouserNumber,
        name: "grouser-number",
        forbids_driving: false,
        meaning: "There are so few grousers that at times none is in the soil; the model takes \
                  them as dense, and their number has no effect.",
        quantity: "grousers in the soil",
        criterion: "the arc in contact is shorter than the spacing of the grousers; not for `rft`",
        source: "geometry",
        judge: |it| {
            let grousers = dense_grousers(it)?;
            let patch = it.settled?.forces.patch;
            let in_soil = f64::from(grousers.count) * (patch.entry - patch.exit).abs() / TAU;
            Some((in_soil, Span::at_least(1.0)))
        },
    },
    Rule {
        flag: Flag::ForceBeyondFriction,
        name: "force-beyond-friction",
        forbids_driving: true,
        meaning: "The model asks more of the soil along the ground than its friction and cohesion \
                  allow.",
        quantity: "force along the ground",
        criterion: "√(F_x² + F_y²) is above c A + F_z tan φ, A the arc in contact times the width; \
                    where `shear.bound` keeps it within what the soil resists: above that bound, \
                    before bound and cut-off reduced it",
        source: "Mohr-Coulomb; with the bound, a wedge of soil ahead, Chen (1975)",
        judge: force_beyond_friction,
    },
    Rule {
        flag: Flag::NoSideForce,
        name: "no-side-force",
        forbids_driving: true,
        meaning: "The wheel moves sideways; Bekker's theory has no force across the wheel, ours is \
                  an addition.",
        quantity: "slip angle",
        criterion: "`bekker` with a slip angle",
        source: "Bekker (1969), plane motion only",
        judge: |it| {
            let angle = it.slip?.angle.abs();
            (*it.model == Model::Bekker).then_some((angle, NONE))
        },
    },
    Rule {
        flag: Flag::NoCohesion,
        name: "no-cohesion",
        forbids_driving: false,
        meaning: "The soil is cohesive, and the model has no cohesion.",
        quantity: "cohesion",
        criterion: "`rft` with a cohesion above 0",
        source: "Agarwal, Goldman and Kamrin (2023): a law of dry, cohesionless media",
        judge: |it| (*it.model == Model::Rft).then_some((it.soil.cohesion, NONE)),
    },
    Rule {
        flag: Flag::TermsMissing,
        name: "terms-missing",
        forbids_driving: false,
        meaning: "The soil states no terms for the model `small-wheel`: general values stand for \
                  them.",
        quantity: "sets of terms for the small-wheel model",
        criterion: "`small-wheel` on a soil without `small_wheel`, or with nothing of it but what \
                    priors have",
        source: "two wheels on one sand, Pavlov and Johnson (2022); Lyasko (2010)",
        judge: |it| {
            let terms = if has_general_terms(&it.soil.small_wheel) { 0.0 } else { 1.0 };
            (*it.model == Model::SmallWheel).then_some((terms, Span::at_least(1.0)))
        },
    },
    Rule {
        flag: Flag::Assumed,
        name: "assumed",
        forbids_driving: false,
        meaning: "Values that the soil's source does not print are the medians of priors.",
        quantity: "number of assumed values",
        criterion: "the soil's document leaves out a value that the model uses",
        source: "the soil's document",
        judge: |it| {
            let assumed = it.soil.domain.assumed_values;
            let count = match it.model {
                Model::Ishigami => assumed.ishigami,
                Model::Bekker => assumed.bekker,
                Model::SmallWheel => assumed.small_wheel,
                Model::Rft => assumed.rft,
                Model::Own(_) => return None,
            };
            Some((f64::from(count), NONE))
        },
    },
];

/// Whether the terms are the general ones, but for what a slope does and what priors may have
/// drawn.
fn has_general_terms(terms: &SmallWheel) -> bool {
    let general = SmallWheel::GENERAL;
    let mut own = SmallWheel { wedge_share: general.wedge_share, ..*terms };
    own.sinkage.with_slip = general.sinkage.with_slip;
    own.interface.friction_share = general.interface.friction_share;
    own == general
}

fn other_wheel(it: &Situation<'_>) -> Option<(f64, Span)> {
    let fit = &it.soil.domain;
    let sizes = [(it.wheel.radius, fit.radius), (it.wheel.width, fit.width)];
    let alike = |it: Span| Span::new(it.low * (1.0 - SAME_SIZE), it.high * (1.0 + SAME_SIZE));
    sizes
        .into_iter()
        .map(|(size, of_fit)| (size, alike(of_fit)))
        .find(|(size, it)| !it.holds(*size))
}

fn bekker_gravity(it: &Situation<'_>) -> Option<(f64, Span)> {
    bekker_modulus(it)?;
    let stated = it.soil.domain.gravity;
    let low = (1.0 - SAME_GRAVITY) * EARTH_GRAVITY;
    let high = (1.0 + SAME_GRAVITY) * EARTH_GRAVITY;
    Some((it.gravity, if stated.is_stated() { stated } else { Span::new(low, high) }))
}

/// k_c/b + k_φ [N/m^(n+2)], where the model uses Bekker's law.
fn bekker_modulus(it: &Situation<'_>) -> Option<f64> {
    match it.soil.pressure_sinkage {
        PressureSinkage::Bekker { k_c, k_phi, .. } if *it.model != Model::Rft => {
            Some(k_c / it.wheel.width + k_phi)
        }
        _ => None,
    }
}

/// Grousers that the model takes as dense: those of all models but resistive force theory.
fn dense_grousers(it: &Situation<'_>) -> Option<Grousers> {
    let has_faces = *it.model == Model::Rft;
    it.wheel.grousers.filter(|grousers| !has_faces && grousers.height > 0.0 && grousers.count > 0)
}

/// The spacing of the grousers [rad], and the largest at which a grouser enters the soil before the
/// rim pushes it ahead.
///
/// ```text
/// φ_g < [√((1 + h')² − (1 − z')²) − √(1 − (1 − z')²)] / (1 − s)
/// ```
///
/// after Skonieczny, Moreland and Wettergreen (2012); h' = h_g/r, and z' = z/r with the rim's
/// sinkage z. Skid counts as s = 0, and a rim above the soil as z = 0.
fn grousers_apart(it: &Situation<'_>) -> Option<(f64, Span)> {
    let grousers = dense_grousers(it)?;
    let (r, h_g) = (it.wheel.radius, grousers.height);
    let (height, depth) = (h_g / r, ((it.settled?.sinkage - h_g) / r).clamp(0.0, 1.0));
    let s = it.slip?.ratio.clamp(0.0, 1.0);
    let above = (1.0 - depth) * (1.0 - depth);
    let ahead = ((1.0 + height) * (1.0 + height) - above).sqrt() - (1.0 - above).sqrt();
    let largest = if s < 1.0 { ahead / (1.0 - s) } else { PI };
    Some((TAU / f64::from(grousers.count), Span::at_most(largest)))
}

fn force_beyond_friction(it: &Situation<'_>) -> Option<(f64, Span)> {
    if it.soil.shear_bound == ShearBound::Coulomb {
        return force_beyond_bound(it);
    }
    let forces = &it.settled?.forces;
    let arc = (forces.patch.entry - forces.patch.exit).abs() * it.wheel.shearing_radius();
    let most = it.soil.cohesion * arc * it.wheel.width + forces.normal_force * it.soil.friction();
    Some((horizontal(forces), Span::at_most(most)))
}

/// The force of the model's law as it is published, where the soil's bound has reduced it, and the
/// bound.
fn force_beyond_bound(it: &Situation<'_>) -> Option<(f64, Span)> {
    /// A bounded force has the bound but for its last digits.
    const DIGITS: f64 = 1e-9;
    /// Share of the cohesion [-] up to which it counts as cut off. Source: ours.
    const WHOLE: f64 = 0.9;
    let Settled { sinkage, ref forces, .. } = *it.settled?;
    let Situation { wheel, soil, gravity, .. } = *it;
    let contact = Contact { wheel: *wheel, soil: *soil, slip: it.slip?, gravity };
    let sinkage = discrepancy::own_sinkage(&contact, sinkage);
    let most = match it.model {
        Model::SmallWheel => coulomb_cone::largest_horizontal_force(&contact, forces, sinkage),
        _ => coulomb::most_resistance(&contact, sinkage, forces),
    };
    let is_cut_off = Cohesion::of(soil).share(forces.max_normal_stress) < WHOLE;
    let is_reduced = is_cut_off || horizontal(forces) >= (1.0 - DIGITS) * most;
    let of_law = is_reduced.then(|| horizontal(&unbounded_forces(it.model, &contact, sinkage)));
    let allowed = Span::at_most((1.0 + DIGITS) * most);
    Some((of_law.unwrap_or_else(|| horizontal(forces)), allowed))
}

/// The forces of a model's law as it is published.
fn unbounded_forces(model: &Model, contact: &Contact, sinkage: f64) -> WheelForces {
    let soil = Soil { shear_bound: ShearBound::None, ..contact.soil };
    let contact = Contact { soil, ..*contact };
    match model {
        Model::SmallWheel => SmallWheelModel::DEFAULT.unbounded_forces(&contact, sinkage),
        _ => model.as_ref().forces(&contact, sinkage),
    }
}

/// √(F_x² + F_y²) [N]
fn horizontal(forces: &WheelForces) -> f64 {
    wide::hypot(forces.drawbar_pull, forces.side_force)
}
