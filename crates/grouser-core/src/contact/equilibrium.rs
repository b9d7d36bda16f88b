//! The sinkage at which a wheel carries its load.

use std::f64::consts::LN_10;

use super::discrepancy;
use super::forces::WheelForces;
use super::inputs::Contact;
use super::load_sinkage::LoadSinkage;
use super::model::WheelSoilModel;
use crate::{elementary, root};

/// A wheel that has sunk until the soil carries it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settled {
    /// Sinkage of the grouser tips, *h* [m].
    pub sinkage: f64,
    /// The soil's reaction there.
    pub forces: WheelForces,
    /// How often the model was evaluated, for F_z alone or for all forces.
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
/// both, where it is nearly a straight line. It starts where a shallow wheel without shear would
/// settle, and interpolates through all that it has seen: three or four evaluations of F_z, and one
/// of all forces. Where they do not close in as they should, the root is bracketed before it is
/// closed in on, and where the growth ends before the load is reached (deep, skidding
/// wheels on strong soil) the highest F_z is sought before the wheel is given up. (In cohesive soil
/// F_z may also rise and fall while the wheel has hardly sunk and shear outweighs pressure; there
/// the answer is one of the sinkages with F_z = W, not always the smallest.)
///
/// Where the soil has a [`Discrepancy`](crate::soil::Discrepancy), it is added to what the model
/// finds.
///
/// How deep does a wheel of HAKUTO sink under 17 N, and how hard does it pull at a slip ratio of 0.2?
///
/// ```
/// # mod hakuto { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/by_hand/hakuto.rs")); }
/// use grouser_core::contact::{Contact, Ishigami, Slip, settle};
/// use grouser_core::units::EARTH_GRAVITY;
///
/// let slip = Slip::on_test_stand(0.2, 0.0);
/// let (wheel, soil) = (hakuto::wheel(), hakuto::sand());
/// let contact = Contact { wheel, soil, slip, gravity: EARTH_GRAVITY };
/// let settled = settle(&Ishigami::DEFAULT, &contact, 17.0)?;
///
/// assert_eq!(format!("{:.1} mm", 1e3 * settled.sinkage), "13.0 mm");
/// assert_eq!(format!("{:.2} N", settled.forces.drawbar_pull), "1.82 N");
/// # Ok::<(), grouser_core::contact::SettleError>(())
/// ```
///
/// # Errors
/// [`SettleError::SunkToAxle`] if the soil carries less at every sinkage down to the axle;
/// [`SettleError::BadLoad`] if the load is negative or not finite.
pub fn settle(
    model: &dyn WheelSoilModel,
    contact: &Contact,
    load: f64,
) -> Result<Settled, SettleError> {
    settle_near(model, contact, load, None)
}

/// As [`settle`], from a sinkage [m] near which the answer is expected: that of the same wheel a
/// moment ago.
///
/// The answer is the same whatever the guess, but for its last digits: F_z and load agree to 1e-12.
/// A guess is therefore an input like any other where results have to repeat bit for bit. Where
/// several sinkages carry the load, the guess may decide which is found.
///
/// # Errors
/// As [`settle`].
pub fn settle_from(
    model: &dyn WheelSoilModel,
    contact: &Contact,
    load: f64,
    guess: f64,
) -> Result<Settled, SettleError> {
    let usable = guess.is_finite() && guess > 0.0;
    settle_near(model, contact, load, usable.then_some(guess))
}

/// Many independent wheels under their loads [N], in their order; each has the bits that it has
/// alone.
pub fn settle_many(
    model: &dyn WheelSoilModel,
    wheels: &[(Contact, f64)],
) -> Vec<Result<Settled, SettleError>> {
    wheels.iter().map(|(contact, load)| settle(model, contact, *load)).collect()
}

fn settle_near(
    model: &dyn WheelSoilModel,
    contact: &Contact,
    load: f64,
    guess: Option<f64>,
) -> Result<Settled, SettleError> {
    if !(load.is_finite() && load >= 0.0) {
        return Err(SettleError::BadLoad { load });
    }
    if load == 0.0 {
        let forces = model.forces(contact, 0.0);
        return Ok(Settled { sinkage: 0.0, forces, evaluations: 1 });
    }
    let relation = model.load_sinkage(contact);
    let relation = relation.as_ref();
    let shallow = relation.map(LoadSinkage::shallow);
    let exponent = shallow.map_or_else(|| growth(contact), |(_, power)| power);
    // A guess is a sinkage as answers have it.
    let guess = guess
        .map(|sinkage| discrepancy::own_sinkage(contact, sinkage))
        .or_else(|| shallow.map(|(factor, power)| elementary::pow(load / factor, 1.0 / power)));
    let axle = elementary::ln(contact.wheel.shearing_radius());
    let mut search =
        Search { model, contact, load, relation, exponent, axle, evaluations: 0, last: None };
    let start = search.start(guess);
    let log_sinkage = if let Some(log_sinkage) = search.interpolated(start) {
        log_sinkage
    } else {
        let (low, high) = search.bracket(start)?;
        root::bracketed(|x| search.excess(x), low, high, 0.0, LOAD_TOLERANCE).0
    };
    let (sinkage, forces) = search.reaction(log_sinkage);
    Ok(Settled {
        sinkage: discrepancy::corrected_sinkage(contact, sinkage),
        forces: discrepancy::corrected(contact, forces),
        evaluations: search.evaluations,
    })
}

/// A point of the search: ln h and ln(F_z/W).
type Point = (f64, f64);

/// No step goes further than this at once [ln h]: past the highest F_z the law has no meaning.
const LONGEST_STEP: f64 = 1.0;

/// The search starts this much above the axle or higher [ln h].
const MARGIN: f64 = 0.05;

/// The polynomial x(f) through some points, at f = 0 (Neville).
fn interpolate_at_zero(points: &[Point]) -> f64 {
    let mut x = [0.0; 4];
    for (x, point) in x.iter_mut().zip(points) {
        *x = point.0;
    }
    for order in 1..points.len() {
        for k in 0..points.len() - order {
            let (f_low, f_high) = (points[k].1, points[k + order].1);
            x[k] += f_low * (x[k + 1] - x[k]) / (f_low - f_high);
        }
    }
    x[0]
}

/// The exponent with which F_z of a model without a load–sinkage relation grows.
fn growth(contact: &Contact) -> f64 {
    let Contact { wheel, soil, slip, gravity } = contact;
    let unit_weight = soil.unit_weight(*gravity);
    let law = soil.pressure_sinkage;
    law.stiffness(wheel.width, soil.cohesion, unit_weight, slip.ratio).exponent + 0.5
}

struct Search<'a> {
    model: &'a dyn WheelSoilModel,
    contact: &'a Contact,
    load: f64,
    relation: Option<&'a LoadSinkage>,
    /// With which F_z grows for shallow sinkage: n + ½.
    exponent: f64,
    /// ln r_s.
    axle: f64,
    evaluations: u32,
    last: Option<(f64, WheelForces)>,
}

impl Search<'_> {
    fn sinkage(&self, log_sinkage: f64) -> f64 {
        elementary::exp(log_sinkage).min(self.contact.wheel.shearing_radius())
    }

    /// The reaction at a sinkage of e^`log_sinkage`; the last one is remembered.
    fn reaction(&mut self, log_sinkage: f64) -> (f64, WheelForces) {
        let sinkage = self.sinkage(log_sinkage);
        match self.last {
            Some((at, forces)) if at == log_sinkage => (sinkage, forces),
            _ => {
                let forces = match self.relation {
                    Some(relation) => self.model.forces_of(self.contact, relation, sinkage),
                    None => self.model.forces(self.contact, sinkage),
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
        self.logarithm(force)
    }

    /// The same, from all forces: the last look at a sinkage that will do.
    fn final_excess(&mut self, log_sinkage: f64) -> f64 {
        let force = self.reaction(log_sinkage).1.normal_force;
        self.logarithm(force)
    }

    fn logarithm(&self, force: f64) -> f64 {
        /// Stands for F_z ≤ 0: below the logarithm of any F_z/W that a double can hold.
        const CARRIES_NOTHING: f64 = -1500.0;
        let share = force / self.load;
        if share >= f64::MIN_POSITIVE { elementary::ln(share) } else { CARRIES_NOTHING }
    }

    /// Where the search starts: at the guess, or at a tenth of the radius.
    fn start(&mut self, guess: Option<f64>) -> Point {
        let axle = self.axle;
        let start = match guess {
            Some(guess) if guess >= f64::MIN_POSITIVE => elementary::ln(guess).min(axle - MARGIN),
            _ => axle - LN_10,
        };
        (start, self.excess(start))
    }

    /// The root by interpolation through all points seen, as long as they close in on it.
    ///
    /// The sinkage is interpolated as a polynomial of the excess, which is nearly a straight line of
    /// known slope. `None` where F_z does not grow as a power of the sinkage does.
    fn interpolated(&mut self, start: Point) -> Option<f64> {
        /// Points are used up to this many: a cubic.
        const MOST_POINTS: usize = 4;
        /// Sinkages that are tried: every usual law is solved by then.
        const MOST_STEPS: usize = 8;
        /// F_z grows with a power of h that is this many times its shallow one at most, or at least.
        const STEEPEST: f64 = 4.0;
        /// The next point's error is below the product of the last points' (three, or the only two), times
        /// this.
        const CURVATURE: f64 = 0.05;
        let (axle, exponent) = (self.axle, self.exponent);
        let mut points = [start; MOST_POINTS];
        let mut count = 1;
        for _ in 0..MOST_STEPS {
            let (here, excess) = points[count - 1];
            if excess.abs() <= LOAD_TOLERANCE {
                return Some(here);
            }
            let next = if count == 1 {
                here - excess / exponent
            } else {
                let (before, excess_before) = points[count - 2];
                let slope = (excess - excess_before) / (here - before);
                if !(slope * STEEPEST > exponent && slope < exponent * STEEPEST) {
                    return None;
                }
                interpolate_at_zero(&points[..count])
            };
            // Negated, so that no NaN gets through.
            if !(next < axle && (next - here).abs() < LONGEST_STEP) {
                return None;
            }
            let error: f64 =
                points[count.saturating_sub(3)..count].iter().map(|p| p.1.abs()).product();
            let last = count >= 2 && CURVATURE * error < LOAD_TOLERANCE;
            let excess = if last || count == MOST_POINTS {
                let excess = self.final_excess(next);
                if excess.abs() <= LOAD_TOLERANCE {
                    return Some(next);
                }
                excess
            } else {
                self.excess(next)
            };
            if count == MOST_POINTS {
                points.rotate_left(1);
            } else {
                count += 1;
            }
            points[count - 1] = (next, excess);
        }
        None
    }

    /// Two sinkages, the first carrying less than the load and the second at least as much.
    fn bracket(&mut self, start: Point) -> Result<(Point, Point), SettleError> {
        let (axle, exponent) = (self.axle, self.exponent);
        /// Each step goes this much beyond the power law's answer [ln h].
        const BEYOND: f64 = 0.02;

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
            let capacity = (self.load * elementary::exp(best.1)).max(0.0);
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
