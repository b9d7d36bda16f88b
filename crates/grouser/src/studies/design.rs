//! Numbers of a rover that are found instead of guessed: the least of an aim under limits.
//!
//! Some numbers of a scenario are free between bounds. Every design is measured by the curve of its
//! headings along the contour: the steepest slope, and on one slope the slip, the sinkage and the
//! work. The aim is the least of one such measure, the limits are on others; both are smooth, so
//! that sequential least-squares programming finds a minimum and what each limit costs
//! ([`slsqp`]). It is sought from several starts, and looked at again by designs around it.
//!
//! A wheel that grows gets heavier by a rule: it is of one sheet, rim and grousers, whose mass per
//! area is that of the scenario's own wheel. What its mass adds to the load counts.

mod slsqp;

use rayon::prelude::*;

use self::slsqp::{Minimum, Smooth, Values};
use super::heading::HeadingStudy;
use crate::difference::{StepLengths, Variable, derivatives};
use crate::document::Described as _;
use crate::document::columns::SLOPE;
use crate::document::design::{DesignTask, Measure};
use crate::document::varied::Key;
use crate::soil::Span;
use crate::vehicle::{Inertia, Rover};
use crate::wheel::Wheel;

/// The least of an aim under limits.
#[derive(Clone, Debug)]
pub struct DesignStudy {
    /// What is free, what is to be least, and what is limited.
    pub task: DesignTask,
    /// The slope on which slip, sinkage and work are measured [rad].
    slope: f64,
    limits: Vec<Limit>,
}

/// A limit of a measure, in its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// What is limited.
    pub measure: Measure,
    /// To which side.
    pub side: Side,
    /// The limit.
    pub bound: f64,
}

/// To which side a measure is limited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// It is to be as large or larger.
    AtLeast,
    /// It is to be as small or smaller.
    AtMost,
}

/// A design that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// The free numbers, in their keys' units.
    pub values: Vec<f64>,
    /// All numbers of the scenario that it changes, by their keys: the free ones, and what the mass
    /// of the wheels follows from.
    pub numbers: Vec<(String, f64)>,
    /// What is measured of it, in the order of [`Measure::ALL`].
    pub measures: [f64; Measure::ALL.len()],
    /// By how much the aim would fall for each limit loosened by one, in both units; 0 for one that does
    /// not hold it back.
    pub prices: Vec<f64>,
    /// What shows that it is the least.
    pub certificate: Certificate,
}

impl Side {
    /// Its key in documents.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::AtLeast => "at_least",
            Self::AtMost => "at_most",
        }
    }
}

impl Design {
    /// A measure of it, in its unit.
    #[must_use]
    pub fn of(&self, measure: Measure) -> f64 {
        self.measures[place(measure)]
    }
}

/// What shows that a design is the least.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Certificate {
    /// Searches that were started.
    pub starts: usize,
    /// Those that came to this design.
    pub agreed: usize,
    /// Designs around it that were looked at.
    pub probes: usize,
    /// Those that keep all limits and are better; none for a minimum.
    pub better: usize,
}

/// Why no design was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoDesign {
    /// No rover within the bounds moves, or none that was looked at.
    #[error("no rover within these bounds crosses a slope of {:.2}°", .slope.to_degrees())]
    NothingMoves {
        /// The slope on which designs are measured [rad].
        slope: f64,
    },
    /// No design keeps a limit.
    #[error("no design within these bounds keeps every limit; the nearest misses {miss}")]
    Unreachable {
        /// The limit that is missed by the most, and its measure there, in SI.
        miss: String,
    },
}

/// The key of a wheel's mass.
const MASS: &str = "rover.wheel_unit.mass_kg";
/// The table of its inertia.
const INERTIA: &str = "rover.wheel_unit.inertia_kg_m2";

/// What a change of a measure is small against, in its unit: aims and limits are counted in it.
const fn size(measure: Measure) -> f64 {
    match measure {
        Measure::LimitSlope | Measure::Yaw => 5.0,
        Measure::SinkageRatio | Measure::SlipRatio => 0.1,
        Measure::EnergyPerMetre => 10.0,
        Measure::Torque | Measure::WheelMass => 1.0,
    }
}

fn place(measure: Measure) -> usize {
    Measure::ALL.iter().position(|it| *it == measure).unwrap_or_default()
}

/// Measures of a design.
type Measures = [f64; Measure::ALL.len()];

impl DesignStudy {
    /// The study of a task.
    #[must_use]
    pub fn of(task: DesignTask) -> Self {
        let slope = task.scenario.document.number("slope_deg").unwrap_or_default();
        let both = Measure::ALL.into_iter().zip(task.limits).flat_map(|(measure, ends)| {
            let of = |side, bound| Limit { measure, side, bound };
            [of(Side::AtLeast, ends.least), of(Side::AtMost, ends.most)]
        });
        // Documents have the limits of angles in degrees, as measures are here.
        let in_unit =
            |limit: Limit| Limit { bound: limit.measure.unit().as_given(limit.bound), ..limit };
        let limits = both.filter(|it| it.bound.is_finite()).map(in_unit).collect();
        Self { task, slope: SLOPE.unit.to_si(slope), limits }
    }

    /// The limits, in the order of prices.
    #[must_use]
    pub fn limits(&self) -> &[Limit] {
        &self.limits
    }

    /// The least of the aim.
    ///
    /// # Errors
    /// [`NoDesign`] where no design moves, or none keeps all limits.
    pub fn design(&self) -> Result<Design, NoDesign> {
        let starts = self.starts();
        let found: Vec<Option<Minimum>> =
            starts.par_iter().map(|start| slsqp::minimum(self, start)).collect();
        let best =
            found.iter().flatten().min_by(|one, other| one.objective.total_cmp(&other.objective));
        let Some(best) = best else { return Err(self.why_none(&starts)) };
        let values = self.values(&best.point);
        let Some(measures) = self.measures(&values) else {
            return Err(NoDesign::NothingMoves { slope: self.slope });
        };
        let agreed = found.iter().flatten().filter(|it| {
            (it.objective - best.objective).abs() <= AGREED * best.objective.abs().max(1.0)
        });
        let certificate = self.certificate(best, starts.len(), agreed.count());
        let (numbers, prices) = (self.numbers(&values), self.prices(best));
        Ok(Design { values, numbers, measures, prices, certificate })
    }

    /// Where searches start: the scenario's own numbers, then points spread over the bounds.
    fn starts(&self) -> Vec<Vec<f64>> {
        /// Searches from points that are spread.
        const SPREAD: u32 = 4;
        let share = |(key, [least, most]): &(Key, [f64; 2])| (key.value - least) / (most - least);
        let own: Vec<f64> = self.task.free.iter().map(|it| share(it).clamp(0.0, 1.0)).collect();
        // The additive recurrence of the golden ratio's kin (R_d), which fills any cube evenly.
        let count = self.task.free.len() as f64;
        let ratio = (0..32).fold(2.0_f64, |ratio, _| (1.0 + ratio).powf(1.0 / (count + 1.0)));
        let spread = (1..=SPREAD).map(|number| {
            let axis = |axis: i32| (0.5 + f64::from(number) * ratio.powi(-(axis + 1))).fract();
            (0..self.task.free.len()).map(|place| axis(i32::try_from(place).unwrap_or(0))).collect()
        });
        std::iter::once(own).chain(spread).collect()
    }

    /// The free numbers at a point of the unit cube, in their keys' units.
    fn values(&self, point: &[f64]) -> Vec<f64> {
        let pairs = self.task.free.iter().zip(point);
        pairs.map(|((_, [least, most]), share)| least + share * (most - least)).collect()
    }

    /// All numbers that a design changes, by their keys: the free ones, and where the wheels' size is
    /// among them their mass and inertia.
    fn numbers(&self, values: &[f64]) -> Vec<(String, f64)> {
        let own =
            self.task.free.iter().map(|(key, _)| key.path.clone()).zip(values.iter().copied());
        let mut numbers: Vec<(String, f64)> = own.collect();
        if numbers.iter().any(|(key, _)| key == MASS) {
            return numbers;
        }
        let keys = numbers.iter().map(|(key, value)| (&**key, *value));
        let Ok(changed) = self.task.scenario.value.with(keys) else { return numbers };
        let unit = |rover: &Rover| rover.parts().wheel_unit;
        let (own, unit) = (unit(&self.task.scenario.value.rover), unit(&changed.rover));
        let factor = sheet(&unit.wheel) / sheet(&own.wheel);
        if factor == 1.0 {
            return numbers;
        }
        numbers.push((MASS.to_owned(), own.mass * factor));
        let turning = factor * (unit.wheel.radius / own.wheel.radius).powi(2);
        let Inertia { xx, yy, zz } = own.inertia;
        let axes = [("xx", xx), ("yy", yy), ("zz", zz)];
        numbers.extend(axes.map(|(axis, own)| (format!("{INERTIA}.{axis}"), own * turning)));
        numbers
    }

    /// What is measured of a design; nothing of one that is none, or that does not cross the slope.
    fn measures(&self, values: &[f64]) -> Option<Measures> {
        let numbers = self.numbers(values);
        let numbers = numbers.iter().map(|(key, value)| (&**key, *value));
        let scenario = self.task.scenario.value.with(numbers).ok()?;
        let curve = HeadingStudy::of(&scenario).curve().ok()?;
        let (limit, _) = curve.limit().ok()?;
        let heading = curve.at(self.slope).ok()?;
        let rover = &scenario.rover;
        let wheels = rover.mounts().iter().zip(&heading.wheels);
        let sinkage = wheels.map(|(mount, it)| it.settled.sinkage / mount.shearing_radius());
        let torques = heading.wheels.iter().map(|it| it.settled.forces.torque.abs());
        let of = |measure| match measure {
            Measure::LimitSlope => limit,
            Measure::SinkageRatio => sinkage.clone().fold(0.0, f64::max),
            Measure::SlipRatio => heading.slip_ratio,
            Measure::EnergyPerMetre => heading.energy_per_metre(rover),
            Measure::Yaw => heading.yaw,
            Measure::Torque => torques.clone().fold(0.0, f64::max),
            Measure::WheelMass => rover.mounts().iter().map(|mount| mount.unit.mass).sum(),
        };
        Some(Measure::ALL.map(|measure| measure.unit().from_si(of(measure))))
    }

    /// By how much the aim falls for each limit that is loosened by one, in SI.
    fn prices(&self, best: &Minimum) -> Vec<f64> {
        let limits = self.limits.iter().zip(&best.multipliers);
        limits
            .map(|(limit, price)| price * size(self.task.minimise) / size(limit.measure))
            .collect()
    }

    /// Looks at designs around the best, 1 % of the bounds away along each number and between.
    fn certificate(&self, best: &Minimum, starts: usize, agreed: usize) -> Certificate {
        /// How far away, over the bounds [-].
        const AWAY: f64 = 0.01;
        /// Better by less than this is rounding, over the aim's size [-].
        const ROUNDING: f64 = 1e-6;
        let count = self.task.free.len();
        let shifts: Vec<Vec<f64>> = (0..3_usize.pow(u32::try_from(count.min(5)).unwrap_or(5)))
            .map(|number| {
                (0..count)
                    .map(|place| {
                        let digit =
                            number / 3_usize.pow(u32::try_from(place.min(5)).unwrap_or(5)) % 3;
                        AWAY * (digit as f64 - 1.0)
                    })
                    .collect()
            })
            .collect();
        let is_better = |shift: &Vec<f64>| {
            let moved = best.point.iter().zip(shift).map(|(it, by)| (it + by).clamp(0.0, 1.0));
            let point: Vec<f64> = moved.collect();
            let measures = self.measures(&self.values(&point));
            measures.is_some_and(|measures| {
                let keeps = self.limits.iter().all(|limit| limit.excess(&measures) <= 0.0);
                let aim = measures[place(self.task.minimise)] / size(self.task.minimise);
                keeps && aim < best.objective - ROUNDING
            })
        };
        let better = shifts.par_iter().filter(|shift| is_better(shift)).count();
        Certificate { starts, agreed, probes: shifts.len(), better }
    }

    /// Why no search found a design, by the designs at which they started.
    fn why_none(&self, starts: &[Vec<f64>]) -> NoDesign {
        let measured = starts.iter().filter_map(|start| self.measures(&self.values(start)));
        let worst = |measures: &Measures| {
            let excess = |limit: &Limit| (limit.excess(measures), limit.measure);
            let all = self.limits.iter().map(excess);
            all.max_by(|one, other| one.0.total_cmp(&other.0)).map(|(by, of)| (by, of, *measures))
        };
        let nearest =
            measured.filter_map(|it| worst(&it)).min_by(|one, other| one.0.total_cmp(&other.0));
        match nearest {
            None => NoDesign::NothingMoves { slope: self.slope },
            Some((_, measure, measures)) => {
                let value = measures[place(measure)];
                NoDesign::Unreachable { miss: format!("{} with {value:.4}", measure.name()) }
            }
        }
    }
}

/// Searches that differ by less came to one design [-].
const AGREED: f64 = 1e-4;

impl Limit {
    /// By how much a design misses it, over the measure's size; not above 0 where it keeps it.
    fn excess(&self, measures: &Measures) -> f64 {
        let over = (measures[place(self.measure)] - self.bound) / size(self.measure);
        match self.side {
            Side::AtLeast => -over,
            Side::AtMost => over,
        }
    }
}

/// The area of the sheet that a wheel is made of, 2π r b + N h_g b [m²].
fn sheet(wheel: &Wheel) -> f64 {
    let grousers = wheel.grousers.map_or(0.0, |it| f64::from(it.count) * it.height);
    (std::f64::consts::TAU * wheel.radius + grousers) * wheel.width
}

impl Smooth for DesignStudy {
    fn free(&self) -> usize {
        self.task.free.len()
    }

    fn constraints(&self) -> usize {
        self.limits.len()
    }

    fn at(&self, point: &[f64]) -> Option<Values> {
        let of = |point: &[f64]| {
            let measures = self.measures(&self.values(point))?;
            let aim = measures[place(self.task.minimise)] / size(self.task.minimise);
            let limits = self.limits.iter().map(|limit| limit.excess(&measures));
            Some(std::iter::once(aim).chain(limits).collect::<Vec<f64>>())
        };
        let here = of(point)?;
        let variable =
            |value: &f64| Variable { value: *value, scale: 1.0, range: Span::new(0.0, 1.0) };
        let variables: Vec<Variable> = point.iter().map(variable).collect();
        let sizes = vec![1.0; here.len()];
        let mut evaluate = |points: &[Vec<f64>]| points.iter().map(|it| of(it)).collect();
        let found = derivatives(&variables, &here, &sizes, StepLengths::SETTLED, &mut evaluate);
        let by: Vec<Vec<f64>> = found
            .by_variable
            .into_iter()
            .map(|by| Some(by?.into_iter().map(|it| it.value).collect()))
            .collect::<Option<_>>()?;
        let gradient = |result: usize| by.iter().map(|of| of[result]).collect();
        Some(Values {
            objective: here[0],
            gradients: (0..here.len()).map(gradient).collect(),
            constraints: here[1..].to_vec(),
        })
    }
}
