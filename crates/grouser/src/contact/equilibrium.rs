//! The sinkage at which a wheel carries its load.

use std::f64::consts::LN_10;

use super::forces::WheelForces;
use super::model::{Contact, WheelSoilModel};
use crate::root;

/// A wheel that has sunk until the soil carries it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settled {
    /// Sinkage of the grouser tips, *h* [m].
    pub sinkage: f64,
    /// The soil's reaction there.
    pub forces: WheelForces,
    /// How often the theory was evaluated.
    pub evaluations: u32,
}

/// Why no sinkage carries the load.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SettleError {
    /// Even sunk to the axle, the soil carries less than the wheel's load.
    #[error("the soil carries at most {capacity:.4} N down to axle depth, the load is {load:.4} N")]
    SunkToAxle {
        /// The wheel's load [N].
        load: f64,
        /// The most that the soil carries at any sinkage down to the axle [N].
        capacity: f64,
    },
    /// The load is not a number that a wheel can carry.
    #[error("a wheel load must be finite and not negative, it is {load} N")]
    BadLoad {
        /// The load [N].
        load: f64,
    },
}

/// |F_z − W| / W below which a wheel counts as settled [-].
const LOAD_TOLERANCE: f64 = 1e-12;

/// The smallest sinkage at which the soil carries `load` [N] (F_z = W), and the forces there.
///
/// F_z starts at 0 and grows like a power of the sinkage, so the search goes by the logarithms of
/// both, where it is nearly a straight line: about six evaluations. The root is bracketed before
/// it is closed in on, and where the growth ends before the load is reached (deep, skidding
/// wheels on strong soil) the highest F_z is sought before the wheel is given up. (In cohesive soil
/// F_z may also rise and fall while the wheel has hardly sunk and shear outweighs pressure; there
/// the answer is one of the sinkages with F_z = W, not always the smallest.)
///
/// # Errors
/// [`SettleError::SunkToAxle`] if the soil carries less at every sinkage down to the axle;
/// [`SettleError::BadLoad`] if the load is negative or not finite.
pub fn settle(
    model: &dyn WheelSoilModel,
    contact: &Contact,
    load: f64,
) -> Result<Settled, SettleError> {
    if !(load.is_finite() && load >= 0.0) {
        return Err(SettleError::BadLoad { load });
    }
    if load == 0.0 {
        let forces = model.forces(contact, 0.0);
        return Ok(Settled { sinkage: 0.0, forces, evaluations: 1 });
    }
    let mut search = Search { model, contact, load, evaluations: 0, last: None };
    let (low, high) = search.bracket()?;
    let close = LOAD_TOLERANCE;
    let (log_sinkage, _) = root::bracketed(|x| search.excess(x), low, high, 0.0, close);
    let (sinkage, forces) = search.reaction(log_sinkage);
    Ok(Settled { sinkage, forces, evaluations: search.evaluations })
}

/// A point of the search: ln h and ln(F_z/W).
type Point = (f64, f64);

struct Search<'a> {
    model: &'a dyn WheelSoilModel,
    contact: &'a Contact,
    load: f64,
    evaluations: u32,
    last: Option<(f64, WheelForces)>,
}

impl Search<'_> {
    /// The reaction at a sinkage of e^`log_sinkage`; the last one is remembered.
    fn reaction(&mut self, log_sinkage: f64) -> (f64, WheelForces) {
        let sinkage = log_sinkage.exp().min(self.contact.wheel.shearing_radius());
        match self.last {
            Some((at, forces)) if at == log_sinkage => (sinkage, forces),
            _ => {
                let forces = self.model.forces(self.contact, sinkage);
                self.evaluations += 1;
                self.last = Some((log_sinkage, forces));
                (sinkage, forces)
            }
        }
    }

    /// ln(F_z/W): negative where the soil carries less than the load.
    fn excess(&mut self, log_sinkage: f64) -> f64 {
        /// Stands for F_z ≤ 0: below the logarithm of any F_z/W that a double can hold.
        const CARRIES_NOTHING: f64 = -1500.0;
        let share = self.reaction(log_sinkage).1.normal_force / self.load;
        if share > 0.0 { share.ln() } else { CARRIES_NOTHING }
    }

    /// Two sinkages, the first carrying less than the load and the second at least as much.
    fn bracket(&mut self) -> Result<(Point, Point), SettleError> {
        let exponent = self.growth();
        let axle = self.contact.wheel.shearing_radius().ln();
        /// Each step goes this much beyond the power law's answer [ln h].
        const BEYOND: f64 = 0.02;
        /// And no further than this at once [ln h]: past the highest F_z the law has no meaning.
        const LONGEST_STEP: f64 = 1.0;

        let mut here = self.first_guess(axle);
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
        while here.0 < axle {
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
        self.bracket_below_the_peak(axle)
    }

    /// The exponent with which F_z grows for shallow sinkage: n + ½.
    fn growth(&self) -> f64 {
        let Contact { wheel, soil, slip, gravity } = self.contact;
        let unit_weight = soil.unit_weight(*gravity);
        let law = soil.pressure_sinkage;
        law.stiffness(wheel.width, soil.cohesion, unit_weight, slip.ratio).exponent + 0.5
    }

    /// A power law through one evaluation, at a tenth of the radius or nearer to the answer.
    fn first_guess(&mut self, axle: f64) -> Point {
        let start = axle - LN_10;
        let excess = self.excess(start);
        let next = (start - excess / self.growth()).min(axle);
        if next >= start { (start, excess) } else { (next, self.excess(next)) }
    }

    /// The bracket where F_z has a highest value: seek it, and look whether it is enough.
    fn bracket_below_the_peak(&mut self, axle: f64) -> Result<(Point, Point), SettleError> {
        /// Steps of the scan from the axle up, each this long [ln h], over twelve decades: on
        /// cohesive soil tiny loads are carried by shear at sinkages that are as tiny.
        const STEPS: i32 = 300;
        const STEP: f64 = 0.092;
        let at = |step: i32| axle - STEP * f64::from(step);
        let mut best = (axle, self.excess(axle));
        for step in 1..=STEPS {
            let point = (at(step), self.excess(at(step)));
            if point.1 > best.1 {
                best = point;
            }
        }
        let best = self.peak_around(best, STEP, axle);
        if best.1 < 0.0 {
            let capacity = (self.load * best.1.exp()).max(0.0);
            return Err(SettleError::SunkToAxle { load: self.load, capacity });
        }
        let mut shallower = best;
        while shallower.1 >= 0.0 {
            shallower = (shallower.0 - STEP, self.excess(shallower.0 - STEP));
        }
        Ok((shallower, best))
    }

    /// The highest point within a scan's step of `best`, by golden sections.
    fn peak_around(&mut self, best: Point, step: f64, axle: f64) -> Point {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        /// The peak is flat: a width of 1e-7 finds its height to 1e-14.
        const NARROW: f64 = 1e-7;
        let (mut low, mut high) = (best.0 - step, (best.0 + step).min(axle));
        let mut at = |x: f64| (x, self.excess(x));
        let mut shallower = at(high - GOLDEN * (high - low));
        let mut deeper = at(low + GOLDEN * (high - low));
        let mut best = best;
        while high - low > NARROW {
            for point in [shallower, deeper] {
                if point.1 > best.1 {
                    best = point;
                }
            }
            // The inner point that stays is one of the golden sections of what is left.
            if shallower.1 > deeper.1 {
                high = deeper.0;
                deeper = shallower;
                shallower = at(high - GOLDEN * (high - low));
            } else {
                low = shallower.0;
                shallower = deeper;
                deeper = at(low + GOLDEN * (high - low));
            }
        }
        best
    }
}
