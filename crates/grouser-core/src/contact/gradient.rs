//! Derivatives of a settled wheel by any number of its contact, and by its load.
//!
//! With the settled sinkage h and the forces F(h, p) at a *fixed* sinkage,
//!
//! ```text
//! dh/dp = (dW/dp − ∂F_z/∂p) / (∂F_z/∂h)        dF/dp = ∂F/∂p + ∂F/∂h dh/dp
//! ```
//!
//! The partial derivatives are differences of forces ([`derivatives`]), all of them together in the
//! lanes that many wheels share. Nothing is settled twice, so that no search's tolerance enters.

use super::batch::own_forces_many;
use super::discrepancy;
use super::equilibrium::Settled;
use super::forces::WheelForces;
use super::inputs::Contact;
use super::model::WheelSoilModel;
use super::patch::ContactPatch;
use crate::difference::{Derivative, StepLengths, Variable, derivatives};
use crate::soil::Span;

/// How a settled wheel changes with a number, by one unit of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelDerivative {
    /// The derivative of each result; where both sides differ, their mean.
    pub value: Settled,
    /// The same below and above the number's value; alike where a result is smooth.
    pub sides: [Settled; 2],
}

/// The derivatives of one settled wheel.
#[derive(Clone, Debug, PartialEq)]
pub struct WheelGradient {
    /// Those by each number; none by one that can be changed to neither side.
    pub by_variable: Vec<Option<WheelDerivative>>,
    /// How often all forces were computed.
    pub evaluations: usize,
}

/// A contact and its load [N] with values for some numbers; none where they are no contact.
pub type ContactWith<'a> = dyn Fn(&[f64]) -> Option<(Contact, f64)> + 'a;

/// A wheel that may be changed: with other values for some numbers.
#[derive(Clone, Copy)]
pub struct ChangeableWheel<'a> {
    /// The wheel–soil model.
    pub model: &'a dyn WheelSoilModel,
    /// The contact with other values for all numbers.
    pub with: &'a ContactWith<'a>,
}

/// How many results a settled wheel has.
const RESULTS: usize = 15;

/// How a settled wheel changes with some numbers.
///
/// How much less does HAKUTO's wheel sink under 17 N for every millimetre that it is wider?
///
/// ```
/// use grouser_core::contact::gradient::{ChangeableWheel, gradient};
/// use grouser_core::contact::{Contact, Ishigami, Slip, settle};
/// use grouser_core::difference::Variable;
/// use grouser_core::soil::Span;
/// use grouser_core::wheel::Wheel;
/// use grouser_core::{paper, units::EARTH_GRAVITY};
///
/// let (wheel, slip) = (paper::hakuto_wheel(), Slip::on_test_stand(0.2, 0.0));
/// let contact = Contact { wheel, soil: paper::toyoura(), slip, gravity: EARTH_GRAVITY };
/// let settled = settle(&Ishigami::DEFAULT, &contact, 17.0)?;
///
/// let width = Variable { value: wheel.width, scale: wheel.width, range: Span::at_least(0.0) };
/// let with = |numbers: &[f64]| {
///     Some((Contact { wheel: Wheel { width: numbers[0], ..wheel }, ..contact }, 17.0))
/// };
/// let changeable = ChangeableWheel { model: &Ishigami::DEFAULT, with: &with };
/// let found = gradient(&changeable, &[width], &contact, &settled);
/// let by_width = found.by_variable[0].expect("a wheel may be wider").value;
/// assert_eq!(format!("{:.3} mm/mm", by_width.sinkage), "-0.022 mm/mm");
/// # Ok::<(), grouser_core::contact::SettleError>(())
/// ```
///
/// * `variables`: the numbers, in the order of [`ChangeableWheel::with`]
/// * `settled`: the wheel with the numbers as they are
#[must_use]
pub fn gradient(
    wheel: &ChangeableWheel<'_>,
    variables: &[Variable],
    contact: &Contact,
    settled: &Settled,
) -> WheelGradient {
    let load = settled.forces.normal_force;
    if load <= 0.0 {
        // A wheel without a load touches nothing: its sinkage starts to grow without a slope.
        return WheelGradient { by_variable: vec![None; variables.len()], evaluations: 0 };
    }
    let sinkage = discrepancy::own_sinkage(contact, settled.sinkage);
    let radius = contact.wheel.shearing_radius();
    let own = Variable { value: sinkage, scale: sinkage, range: Span::new(0.0, radius) };
    let all: Vec<Variable> = variables.iter().copied().chain([own]).collect();
    // The imbalance F_z − W comes last.
    let here: Vec<f64> = results_of(settled).into_iter().chain([0.0]).collect();
    let sizes: Vec<f64> = sizes(settled, radius).into_iter().chain([load]).collect();
    let mut evaluate = |points: &[Vec<f64>]| evaluated(wheel, points);
    let found = derivatives(&all, &here, &sizes, StepLengths::EXACT, &mut evaluate);
    let [rest @ .., by_sinkage] = &found.by_variable[..] else {
        unreachable!("the sinkage is one of them")
    };
    let by_variable = rest.iter().map(|slopes| {
        let (slopes, by_sinkage) = (slopes.as_ref()?, by_sinkage.as_ref()?);
        implicit(slopes, by_sinkage)
    });
    WheelGradient { by_variable: by_variable.collect(), evaluations: found.evaluations }
}

/// The results at many points: numbers with a sinkage [m] behind them.
fn evaluated(wheel: &ChangeableWheel<'_>, points: &[Vec<f64>]) -> Vec<Option<Vec<f64>>> {
    let changed: Vec<Option<(Contact, f64, f64)>> = points
        .iter()
        .map(|point| {
            let (sinkage, numbers) = point.split_last()?;
            let (contact, load) = (wheel.with)(numbers)?;
            Some((contact, *sinkage, load))
        })
        .collect();
    let sunk: Vec<(Contact, f64)> =
        changed.iter().flatten().map(|(contact, sinkage, _)| (*contact, *sinkage)).collect();
    let mut forces = own_forces_many(wheel.model, &sunk).into_iter();
    let results = changed.iter().map(|changed| {
        let (contact, sinkage, load) = changed.as_ref()?;
        let forces = forces.next()?;
        let imbalance = forces.normal_force - load;
        let settled = Settled::of(contact, *sinkage, forces, 0);
        Some(results_of(&settled).into_iter().chain([imbalance]).collect())
    });
    results.collect()
}

/// The derivative along one variable, with the sinkage that goes with it.
///
/// * `slopes`, `by_sinkage`: of the results and the imbalance, by the variable and by the sinkage
fn implicit(slopes: &[Derivative], by_sinkage: &[Derivative]) -> Option<WheelDerivative> {
    let (imbalance, stiffness) = (slopes[RESULTS], by_sinkage[RESULTS]);
    let grows = |slope: f64| slope.is_finite() && slope > 0.0;
    if !grows(stiffness.value) || !stiffness.sides.into_iter().all(grows) {
        // Where F_z does not grow, no sinkage follows the load.
        return None;
    }
    // Alike to the last bit on both sides where every part is.
    let of = |side: Option<usize>| {
        let change = imbalance.at(side);
        // A wheel that sinks as the variable falls comes to the sinkage's other side.
        let other = side.map(|side| if change > 0.0 { 1 - side } else { side });
        let sinking = -change / stiffness.at(other);
        let result = |place: usize| slopes[place].at(side) + by_sinkage[place].at(other) * sinking;
        of_results(std::array::from_fn(result))
    };
    Some(WheelDerivative { value: of(None), sides: [of(Some(0)), of(Some(1))] })
}

/// The results as a list.
fn results_of(settled: &Settled) -> [f64; RESULTS] {
    let Settled { sinkage, forces: it, .. } = settled;
    [
        *sinkage,
        it.drawbar_pull,
        it.side_force,
        it.normal_force,
        it.thrust,
        it.motion_resistance,
        it.side_force_from_shear,
        it.bulldozing_load,
        it.torque,
        it.overturning_moment,
        it.aligning_moment,
        it.max_normal_stress,
        it.patch.entry,
        it.patch.max_stress,
        it.patch.exit,
    ]
}

/// What a change of each result is small against.
///
/// * `radius`: r_s [m]
fn sizes(settled: &Settled, radius: f64) -> [f64; RESULTS] {
    let load = settled.forces.normal_force;
    let (moment, angle) = (load * radius, settled.forces.patch.entry);
    let (sinkage, stress) = (settled.sinkage, settled.forces.max_normal_stress);
    let kinds = [(sinkage, 1), (load, 7), (moment, 3), (stress, 1), (angle, 3)];
    let mut sizes = kinds.into_iter().flat_map(|(size, count)| std::iter::repeat_n(size, count));
    std::array::from_fn(|_| sizes.next().unwrap_or_default())
}

/// A list of results as a settled wheel.
fn of_results(results: [f64; RESULTS]) -> Settled {
    let [
        sinkage,
        drawbar_pull,
        side_force,
        normal_force,
        thrust,
        motion_resistance,
        side_force_from_shear,
        bulldozing_load,
        torque,
        overturning_moment,
        aligning_moment,
        max_normal_stress,
        entry,
        max_stress,
        exit,
    ] = results;
    let patch = ContactPatch { entry, max_stress, exit };
    let forces = WheelForces {
        drawbar_pull,
        side_force,
        normal_force,
        torque,
        overturning_moment,
        aligning_moment,
        thrust,
        motion_resistance,
        side_force_from_shear,
        bulldozing_load,
        max_normal_stress,
        patch,
    };
    Settled { sinkage, forces, evaluations: 0 }
}
