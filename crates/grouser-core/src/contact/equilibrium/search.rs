//! The search for the sinkage of one wheel.

#![expect(
    clippy::inline_always,
    reason = "what the kernel runs is compiled once for each instruction set"
)]

use std::f64::consts::LN_10;

use super::interpolation::{Interpolation, LOAD_TOLERANCE, LONGEST_STEP, Next, Point};
use super::settled::{LoadedWheel, SettleError};
use crate::contact::forces::WheelForces;
use crate::contact::inputs::Contact;
use crate::contact::load_sinkage::LoadSinkage;
use crate::{elementary, peak, root};

/// Where a search starts, and by which scales it goes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Start {
    /// ln h.
    pub(super) at: f64,
    /// ln r_s.
    pub(super) axle: f64,
    /// With which F_z grows for shallow sinkage: n + ½.
    pub(super) exponent: f64,
}

impl Start {
    /// At the wheel's guess, where a shallow wheel without shear would settle, or at a tenth of the
    /// radius.
    pub(super) fn of(wheel: &LoadedWheel<'_>, relation: Option<&LoadSinkage>) -> Self {
        let radius = wheel.contact.wheel.shearing_radius();
        match relation.map(LoadSinkage::shallow) {
            Some(shallow) => Self::near(wheel.usable_guess(), shallow, wheel.load, radius),
            None => Self::at(wheel.usable_guess(), growth(wheel.contact), radius),
        }
    }

    /// * `guess`: a sinkage [m], or NaN
    /// * `shallow`: factor [N/m^p] and power p of a shallow wheel's F_z
    #[inline(always)]
    pub(super) fn near(guess: f64, (factor, power): (f64, f64), load: f64, radius: f64) -> Self {
        let shallow = elementary::pow(load / factor, 1.0 / power);
        Self::at(if guess.is_nan() { shallow } else { guess }, power, radius)
    }

    /// * `guess`: a sinkage [m], or NaN
    #[inline(always)]
    fn at(guess: f64, exponent: f64, radius: f64) -> Self {
        /// The search starts this much above the axle or higher [ln h].
        const MARGIN: f64 = 0.05;
        let axle = elementary::ln(radius);
        let guessed = elementary::ln(guess).min(axle - MARGIN);
        let at = if guess >= f64::MIN_POSITIVE { guessed } else { axle - LN_10 };
        Self { at, axle, exponent }
    }
}

/// The exponent with which F_z of a model without a load–sinkage relation grows.
fn growth(contact: &Contact) -> f64 {
    let Contact { wheel, soil, slip, gravity } = contact;
    let unit_weight = soil.unit_weight(*gravity);
    let law = soil.pressure_sinkage;
    law.stiffness(wheel.width, soil.cohesion, unit_weight, slip.ratio).exponent + 0.5
}

/// The sinkage [m] at an ln h, which never is beyond the axle.
#[inline(always)]
pub(super) fn sinkage_at(log_sinkage: f64, radius: f64) -> f64 {
    elementary::exp(log_sinkage).min(radius)
}

/// ln(F_z/W): negative where the soil carries less than the load.
#[inline(always)]
pub(super) fn excess(force: f64, load: f64) -> f64 {
    /// Stands for F_z ≤ 0: below the logarithm of any F_z/W that a double can hold.
    const CARRIES_NOTHING: f64 = -1500.0;
    let share = force / load;
    let logarithm = elementary::ln(share);
    if share >= f64::MIN_POSITIVE { logarithm } else { CARRIES_NOTHING }
}

pub(super) struct Search<'a> {
    wheel: &'a LoadedWheel<'a>,
    relation: Option<&'a LoadSinkage>,
    start: Start,
    evaluations: u32,
    last: Option<(f64, WheelForces)>,
}

impl<'a> Search<'a> {
    pub(super) fn new(
        wheel: &'a LoadedWheel<'a>,
        relation: Option<&'a LoadSinkage>,
        start: Start,
    ) -> Self {
        Self { wheel, relation, start, evaluations: 0, last: None }
    }

    /// How often the model was evaluated.
    pub(super) fn evaluations(&self) -> u32 {
        self.evaluations
    }

    /// The ln h at which the soil carries the load.
    pub(super) fn root(&mut self) -> Result<f64, SettleError> {
        let start = (self.start.at, self.excess(self.start.at));
        if let Some(found) = self.interpolated(start) {
            return Ok(found);
        }
        let (low, high) = self.bracket(start)?;
        Ok(root::bracketed(|x| self.excess(x), low, high, 0.0, LOAD_TOLERANCE).0)
    }

    fn sinkage(&self, log_sinkage: f64) -> f64 {
        sinkage_at(log_sinkage, self.wheel.contact.wheel.shearing_radius())
    }

    /// The reaction at a sinkage of e^`log_sinkage`; the last one is remembered.
    pub(super) fn reaction(&mut self, log_sinkage: f64) -> (f64, WheelForces) {
        let sinkage = self.sinkage(log_sinkage);
        match self.last {
            Some((at, forces)) if at == log_sinkage => (sinkage, forces),
            _ => {
                let LoadedWheel { model, contact, .. } = *self.wheel;
                let forces = match self.relation {
                    Some(relation) => relation.forces(contact, sinkage),
                    None => model.forces(contact, sinkage),
                };
                self.evaluations += 1;
                self.last = Some((log_sinkage, forces));
                (sinkage, forces)
            }
        }
    }

    /// ln(F_z/W): negative where the soil carries less than the load.
    fn excess(&mut self, log_sinkage: f64) -> f64 {
        let force = match &self.relation {
            Some(relation) => {
                self.evaluations += 1;
                relation.normal_force(self.sinkage(log_sinkage))
            }
            None => self.reaction(log_sinkage).1.normal_force,
        };
        excess(force, self.wheel.load)
    }

    /// The same, from all forces: the last look at a sinkage that will do.
    fn final_excess(&mut self, log_sinkage: f64) -> f64 {
        let force = self.reaction(log_sinkage).1.normal_force;
        excess(force, self.wheel.load)
    }

    /// The root by interpolation; `None` where F_z does not grow as a power of the sinkage does.
    fn interpolated(&mut self, start: Point) -> Option<f64> {
        let mut search = Interpolation::new(self.start.axle, self.start.exponent, start);
        loop {
            match search.next() {
                Next::Try(at) => search.take((at, self.excess(at))),
                Next::TryLast(at) => search.take((at, self.final_excess(at))),
                Next::Found(at) => return Some(at),
                Next::Lost => return None,
            }
        }
    }

    /// Two sinkages, the first carrying less than the load and the second at least as much.
    fn bracket(&mut self, start: Point) -> Result<(Point, Point), SettleError> {
        /// Each step goes this much beyond the power law's answer [ln h].
        const BEYOND: f64 = 0.02;
        let Start { axle, exponent, .. } = self.start;
        let mut here = start;
        let mut step = 0.0;
        while here.1 >= 0.0 {
            step = here.1 / exponent + BEYOND + 2.0 * step;
            let next = here.0 - step;
            let shallower = (next, self.excess(next));
            if shallower.1 < 0.0 {
                return Ok((shallower, here));
            }
            here = shallower;
        }
        let may_carry = self.most_excess(axle) >= 0.0;
        while may_carry && here.0 < axle {
            step = (-here.1 / exponent + BEYOND).min(LONGEST_STEP);
            let next = (here.0 + step).min(axle);
            let deeper = (next, self.excess(next));
            if deeper.1 >= 0.0 {
                return Ok((here, deeper));
            }
            if deeper.1 < here.1 {
                break;
            }
            here = deeper;
        }
        let at_axle = if here.0 == axle { here } else { (axle, self.excess(axle)) };
        self.bracket_below_the_peak(at_axle)
    }

    /// The bracket where F_z has a highest value: seek it, and look whether it is enough.
    fn bracket_below_the_peak(&mut self, at_axle: Point) -> Result<(Point, Point), SettleError> {
        /// Steps of the scan from the axle up, each this long [ln h], over twelve decades: on
        /// cohesive soil tiny loads are carried by shear at sinkages that are as tiny. It mostly
        /// ends after a few, where the soil's strength tells that F_z is lower from there up.
        const STEPS: i32 = 300;
        const STEP: f64 = 0.092;
        let axle = at_axle.0;
        let mut best = at_axle;
        for step in 1..=STEPS {
            let at = axle - STEP * f64::from(step);
            if self.most_excess(at) < best.1 {
                break;
            }
            let point = (at, self.excess(at));
            if point.1 > best.1 {
                best = point;
            }
        }
        let best = if best.1 < 0.0 { self.peak_around(best, STEP) } else { best };
        if best.1 < 0.0 {
            let load = self.wheel.load;
            let capacity = (load * elementary::exp(best.1)).max(0.0);
            return Err(SettleError::SunkToAxle { load, capacity });
        }
        let mut shallower = best;
        while shallower.1 >= 0.0 {
            shallower = (shallower.0 - STEP, self.excess(shallower.0 - STEP));
        }
        Ok((shallower, best))
    }

    /// More than the excess at this sinkage and at all that are shallower, where the model tells.
    fn most_excess(&self, log_sinkage: f64) -> f64 {
        let LoadedWheel { model, contact, load, .. } = *self.wheel;
        let sinkage = self.sinkage(log_sinkage);
        let most = match self.relation {
            Some(relation) => relation.most_normal_force(sinkage),
            None => model.most_normal_force(contact, sinkage),
        };
        if most.is_finite() { excess(most, load) } else { f64::INFINITY }
    }

    /// The highest point within a scan's step of `best`.
    fn peak_around(&mut self, best: Point, step: f64) -> Point {
        /// The peak is flat: a width of 1e-6 finds its height to 1e-12.
        const NARROW: f64 = 1e-6;
        let axle = self.start.axle;
        let peak = |search: &mut Self, ends, best| {
            peak::highest(|at| search.excess(at), ends, best, NARROW)
        };
        if best.0 < axle {
            return peak(self, (best.0 - step, (best.0 + step).min(axle)), best);
        }
        // Mostly F_z grows down to the axle, or has a smooth peak above it.
        let look = axle - 0.2 * step;
        let look = (look, self.excess(look));
        let best = if look.1 > best.1 { peak(self, (axle - step, axle), look) } else { best };
        // Corners near the axle are lower than this.
        const CORNERS: f64 = 1e-3;
        if best.1 < -CORNERS || best.1 >= 0.0 {
            return best;
        }
        // Where they decide, they are looked for ever nearer to the axle.
        const HALVINGS: i32 = 22;
        let (smooth, mut best, mut ends) = (best, best, (axle - step, axle));
        let mut deeper = axle;
        for halvings in (0..=HALVINGS).rev() {
            let at = axle - step / f64::from(1 << halvings);
            let point = (at, self.excess(at));
            if point.1 > best.1 {
                (best, ends) = (point, (axle - 2.0 * (axle - at), deeper));
            }
            deeper = at;
        }
        if best == smooth { best } else { peak(self, (ends.0.max(axle - step), ends.1), best) }
    }
}
