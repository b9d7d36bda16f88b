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
use crate::document::varied::{Key, Varied};
use crate::simulation::Scenario;
use crate::soil::Span;
use crate::wheel::Wheel;

/// The least of an aim under limits.
#[derive(Clone, Debug)]
pub struct DesignStudy {
    /// The scenario whose rover, soil, gravity, model and load transfer count.
    pub scenario: Varied<Scenario>,
    /// The numbers that are free, at least one.
    pub free: Vec<FreeNumber>,
    /// What is to be least.
    pub aim: Measure,
    /// What is limited.
    pub limits: Vec<Limit>,
    /// The slope on which slip, sinkage and work are measured [rad].
    pub slope: f64,
}

/// A number that is free between two bounds, in its key's unit.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeNumber {
    /// The number.
    pub key: Key,
    /// The least that it may be.
    pub least: f64,
    /// The most that it may be.
    pub most: f64,
}

/// What is measured of a design.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// The steepest slope on which a heading holds the contour [rad].
    LimitSlope,
    /// The deepest wheel's sinkage over its shearing radius, h/r_s [-].
    SinkageRatio,
    /// Slip ratio of the wheels [-].
    SlipRatio,
    /// Work of the wheels per metre of way [J/m].
    EnergyPerMetre,
    /// Yaw that holds the contour [rad].
    Yaw,
    /// The largest torque of a wheel [N·m].
    Torque,
    /// Mass of all wheels [kg].
    WheelMass,
}

/// A limit of a measure, in SI.
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
    /// What is measured of it, in the order of [`Measure::ALL`].
    pub measures: [f64; Measure::ALL.len()],
    /// By how much the aim would fall for each limit loosened by one, in SI; 0 for one that does
    /// not hold it back.
    pub prices: Vec<f64>,
    /// What shows that it is the least.
    pub certificate: Certificate,
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

impl Measure {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::LimitSlope,
        Self::SinkageRatio,
        Self::SlipRatio,
        Self::EnergyPerMetre,
        Self::Yaw,
        Self::Torque,
        Self::WheelMass,
    ];

    /// Its name in documents, with the unit that it has there.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::LimitSlope => "limit_slope_deg",
            Self::SinkageRatio => "sinkage_ratio",
            Self::SlipRatio => "slip_ratio",
            Self::EnergyPerMetre => "energy_j_per_m",
            Self::Yaw => "yaw_deg",
            Self::Torque => "torque_nm",
            Self::WheelMass => "wheel_mass_kg",
        }
    }

    fn place(self) -> usize {
        Self::ALL.iter().position(|it| *it == self).unwrap_or_default()
    }

    /// What a change of it is small against, in SI: objective and limits are measured in it.
    const fn size(self) -> f64 {
        match self {
            Self::LimitSlope | Self::Yaw => 0.1,
            Self::SinkageRatio | Self::SlipRatio => 0.1,
            Self::EnergyPerMetre => 10.0,
            Self::Torque | Self::WheelMass => 1.0,
        }
    }
}

/// Measures of a design.
type Measures = [f64; Measure::ALL.len()];

impl DesignStudy {
    /// The least of the aim.
    ///
    /// # Errors
    /// [`NoDesign`] where no design moves, or none keeps all limits.
    pub fn design(&self) -> Result<Design, NoDesign> {
        let starts = self.starts();
        let found: Vec<Option<Minimum>> =
            starts.par_iter().map(|start| slsqp::minimum(self, start)).collect();
        let best = found.iter().flatten().min_by(|one, other| {
            one.objective.total_cmp(&other.objective)
        });
        let Some(best) = best else { return Err(self.why_none(&starts)) };
        let values = self.values(&best.point);
        let Some(measures) = self.measures(&values) else {
            return Err(NoDesign::NothingMoves { slope: self.slope });
        };
        let agreed = found.iter().flatten().filter(|it| {
            (it.objective - best.objective).abs() <= AGREED * best.objective.abs().max(1.0)
        });
        let certificate = self.certificate(best, starts.len(), agreed.count());
        Ok(Design { values, measures, prices: self.prices(best), certificate })
    }

    /// Where searches start: the scenario's own numbers, then points spread over the bounds.
    fn starts(&self) -> Vec<Vec<f64>> {
        /// Searches from points that are spread.
        const SPREAD: u32 = 4;
        let share = |free: &FreeNumber| (free.key.value - free.least) / (free.most - free.least);
        let own: Vec<f64> = self.free.iter().map(|it| share(it).clamp(0.0, 1.0)).collect();
        // The additive recurrence of the golden ratio's kin (R_d), which fills any cube evenly.
        let count = self.free.len() as f64;
        let ratio = (0..32).fold(2.0_f64, |ratio, _| (1.0 + ratio).powf(1.0 / (count + 1.0)));
        let spread = (1..=SPREAD).map(|number| {
            let axis = |axis: i32| (0.5 + f64::from(number) * ratio.powi(-(axis + 1))).fract();
            (0..self.free.len()).map(|place| axis(i32::try_from(place).unwrap_or(0))).collect()
        });
        std::iter::once(own).chain(spread).collect()
    }

    /// The free numbers at a point of the unit cube, in their keys' units.
    fn values(&self, point: &[f64]) -> Vec<f64> {
        let pairs = self.free.iter().zip(point);
        pairs.map(|(free, share)| free.least + share * (free.most - free.least)).collect()
    }

    /// What is measured of a design; nothing of one that is none, or that does not cross the slope.
    fn measures(&self, values: &[f64]) -> Option<Measures> {
        let keys = self.free.iter().map(|it| &*it.key.path);
        let mut scenario = self.scenario.value.with(keys.zip(values.iter().copied())).ok()?;
        scenario.rover = self.with_masses(scenario.rover)?;
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
        Some(Measure::ALL.map(of))
    }

    /// The rover with wheels of the mass that their size has.
    fn with_masses(&self, mut rover: crate::vehicle::Rover) -> Option<crate::vehicle::Rover> {
        let is_free = |key: &FreeNumber| key.key.path.ends_with("mass_kg");
        if self.free.iter().any(is_free) {
            return Some(rover);
        }
        let own = self.scenario.value.rover.parts().wheel_unit;
        let unit = &mut rover.parts_mut().wheel_unit;
        let factor = sheet(&unit.wheel) / sheet(&own.wheel);
        unit.mass = own.mass * factor;
        let turning = factor * (unit.wheel.radius / own.wheel.radius).powi(2);
        for (axis, own) in [
            (&mut unit.inertia.xx, own.inertia.xx),
            (&mut unit.inertia.yy, own.inertia.yy),
            (&mut unit.inertia.zz, own.inertia.zz),
        ] {
            *axis = own * turning;
        }
        rover.checked().ok()
    }

    /// By how much the aim falls for each limit that is loosened by one, in SI.
    fn prices(&self, best: &Minimum) -> Vec<f64> {
        let limits = self.limits.iter().zip(&best.multipliers);
        limits.map(|(limit, price)| price * self.aim.size() / limit.measure.size()).collect()
    }

    /// Looks at designs around the best, 1 % of the bounds away along each number and between.
    fn certificate(&self, best: &Minimum, starts: usize, agreed: usize) -> Certificate {
        /// How far away, over the bounds [-].
        const AWAY: f64 = 0.01;
        /// Better by less than this is rounding, over the aim's size [-].
        const ROUNDING: f64 = 1e-6;
        let count = self.free.len();
        let shifts: Vec<Vec<f64>> = (0..3_usize.pow(u32::try_from(count.min(5)).unwrap_or(5)))
            .map(|number| {
                (0..count)
                    .map(|place| {
                        let digit = number / 3_usize.pow(u32::try_from(place.min(5)).unwrap_or(5)) % 3;
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
                let aim = measures[self.aim.place()] / self.aim.size();
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
        let nearest = measured.filter_map(|it| worst(&it)).min_by(|one, other| one.0.total_cmp(&other.0));
        match nearest {
            None => NoDesign::NothingMoves { slope: self.slope },
            Some((_, measure, measures)) => {
                let value = measures[measure.place()];
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
        let over = (measures[self.measure.place()] - self.bound) / self.measure.size();
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
        self.free.len()
    }

    fn constraints(&self) -> usize {
        self.limits.len()
    }

    fn at(&self, point: &[f64]) -> Option<Values> {
        let of = |point: &[f64]| {
            let measures = self.measures(&self.values(point))?;
            let aim = measures[self.aim.place()] / self.aim.size();
            let limits = self.limits.iter().map(|limit| limit.excess(&measures));
            Some(std::iter::once(aim).chain(limits).collect::<Vec<f64>>())
        };
        let here = of(point)?;
        let variable = |value: &f64| Variable { value: *value, scale: 1.0, range: Span::new(0.0, 1.0) };
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
