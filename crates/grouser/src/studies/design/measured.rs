//! What is measured of a rover on a ground.

use std::f64::consts::TAU;

use grouser_io::Described as _;
use grouser_io::design::Measure;
use grouser_io::design_task::{DesignGround, DesignTask, RoverChoice};
use grouser_io::statistics::NothingAccepted;
use rayon::prelude::*;

use crate::contact::Model;
use crate::contact::validity::Finding;
use crate::simulation::Scenario;
use crate::simulation::power::electrical;
use crate::studies::ensemble::models::Question;
use crate::studies::ensemble::samples::{BandInputs, Sample};
use crate::studies::heading::{HeadingStudy, LimitedBy};
use crate::vehicle::{Inertia, Rover};
use crate::wheel::Wheel;

/// What is measured of a design, in SI, in the order of [`Measure::ALL`].
pub type Measures = [f64; Measure::COUNT];

/// A ground with the soils and models that are taken for it.
pub(super) struct MeasuredGround {
    scenario: Scenario,
    slope: f64,
    course: f64,
    samples: Vec<Sample>,
    is_uncertain: bool,
}

impl MeasuredGround {
    /// The soil as its document has it, and its one model.
    pub(super) fn nominal(there: &DesignGround) -> Self {
        let scenario = there.scenario.value.clone();
        let sample = Sample { soil: scenario.ground.soil, model: scenario.model.clone() };
        let DesignGround { slope, course, .. } = *there;
        Self { scenario, slope, course, samples: vec![sample], is_uncertain: false }
    }

    /// So many soils and models that it may be, where its document leaves that open.
    pub(super) fn drawn(
        there: &DesignGround,
        seed: u64,
        count: u32,
    ) -> Result<Self, NothingAccepted> {
        let nominal = Self::nominal(there);
        if there.scenario.soils_of_bands().is_none() {
            return Ok(nominal);
        }
        let inputs = BandInputs::of_scenario(&there.scenario);
        let samples = inputs.asked(Question::on_course(there.course)).samples(seed, count)?;
        Ok(Self { samples, is_uncertain: true, ..nominal })
    }

    /// The same by another model.
    pub(super) fn with_model(mut self, model: &Model) -> Self {
        for sample in &mut self.samples {
            sample.model = model.clone();
        }
        self
    }

    pub(super) fn is_uncertain(&self) -> bool {
        self.is_uncertain
    }

    /// How many samples there are.
    pub(super) fn count(&self) -> usize {
        self.samples.len()
    }

    /// The steepest slope on which the ground stands by its own strength [rad], the strongest where
    /// it is uncertain.
    pub(super) fn strength(&self) -> f64 {
        let limits = self.samples.iter().map(|it| study(&self.scenario, it).ground_limit());
        limits.fold(0.0, f64::max)
    }

    /// The flags of the rover with other numbers in its first soil and model.
    pub(super) fn findings(&self, numbers: &[(String, f64)]) -> Vec<Finding> {
        let numbers = numbers.iter().map(|(key, value)| (&**key, *value));
        let (Ok(scenario), [sample, ..]) = (self.scenario.with(numbers), &self.samples[..]) else {
            return Vec::new();
        };
        let Ok(curve) = study(&scenario, sample).curve_on(self.course) else {
            return Vec::new();
        };
        curve.findings(self.slope, &curve.at(self.slope))
    }

    /// What each sample measures of the rover with other numbers; nothing where it does not move.
    pub(super) fn measures(&self, numbers: &[(String, f64)]) -> Vec<Option<Measures>> {
        let numbers = numbers.iter().map(|(key, value)| (&**key, *value));
        let Ok(scenario) = self.scenario.with(numbers) else {
            return vec![None; self.samples.len()];
        };
        let of_rover = of_rover(&scenario);
        let of_sample = |it: &Sample| self.measures_of(&study(&scenario, it), of_rover);
        self.samples.par_iter().map(of_sample).collect()
    }

    /// The same without what is of no slope that is crossed: none of that is kept.
    pub(super) fn where_crossed(&self, mut measures: Measures) -> Measures {
        if measures[Measure::LimitSlope.place()] < self.slope {
            let of_slope = |it: &Measure| *it != Measure::LimitSlope && !it.is_of_rover();
            for measure in Measure::ALL.into_iter().filter(of_slope) {
                measures[measure.place()] = f64::NAN;
            }
        }
        measures
    }

    /// * `of_rover`: what is measured of the rover alone
    fn measures_of(&self, study: &HeadingStudy, of_rover: Measures) -> Option<Measures> {
        /// Short of a curve's end, which has no slope [-].
        const SHORT_OF_END: f64 = 1.0 - 1e-6;
        /// Any speed of wheels forward [rad/s].
        const FORWARD: f64 = 1.0;
        let curve = study.curve_on(self.course).ok()?;
        let (limit, _) = curve.limit().ok()?;
        if curve.limited_by() == Some(LimitedBy::NotFound) {
            return None;
        }
        let heading = curve.at(self.slope.min(SHORT_OF_END * limit)).ok()?;
        let wheels = study.rover.mounts().iter().zip(&heading.wheels);
        let sinkages = wheels.map(|(mount, it)| it.settled.sinkage / mount.shearing_radius());
        let torques = heading.wheels.iter().map(|it| it.settled.forces.torque);
        let motors = study.rover.mounts().iter().zip(torques.clone());
        // Only the sense of a wheel's speed acts on the current.
        let currents = motors
            .filter_map(|(mount, torque)| Some(electrical(mount, torque, FORWARD)?.current.abs()));
        let mut measures = of_rover;
        let mut set = |measure: Measure, value: f64| measures[measure.place()] = value;
        set(Measure::LimitSlope, limit);
        set(Measure::SinkageRatio, sinkages.fold(0.0, f64::max));
        set(Measure::SlipRatio, heading.slip_ratio.abs());
        set(Measure::EnergyPerMetre, heading.energy_per_metre(&study.rover));
        set(Measure::Crab, heading.crab().abs());
        set(Measure::Torque, torques.clone().map(f64::abs).fold(0.0, f64::max));
        set(Measure::BrakingTorque, torques.map(|it| -it).fold(0.0, f64::max));
        // Of motors that nobody knows there is none.
        set(Measure::Current, currents.reduce(f64::max).unwrap_or(f64::NAN));
        Some(measures)
    }
}

/// The headings of a rover on a sample's soil by its model.
fn study(scenario: &Scenario, sample: &Sample) -> HeadingStudy {
    let Sample { soil, model } = sample.clone();
    HeadingStudy { soil, model, ..HeadingStudy::of(scenario) }
}

/// What is measured of a rover alone, wherever it drives.
fn of_rover(scenario: &Scenario) -> Measures {
    /// Yaws at which it may tip over: every 5 degrees.
    const YAWS: u32 = 72;
    let study = HeadingStudy::of(scenario);
    let mounts = study.rover.mounts();
    let tipping = (0..YAWS).map(|it| study.tipping_slope(TAU * f64::from(it) / f64::from(YAWS)));
    let side = |sign: f64| {
        let ends = mounts.iter().map(|it| sign * it.position.y + it.unit.wheel.width / 2.0);
        ends.fold(f64::NEG_INFINITY, f64::max)
    };
    let mut measures = [0.0; Measure::COUNT];
    measures[Measure::TippingSlope.place()] = tipping.fold(f64::INFINITY, f64::min);
    measures[Measure::Width.place()] = side(1.0) + side(-1.0);
    measures[Measure::WheelMass.place()] = mounts.iter().map(|it| it.unit.mass).sum();
    measures
}

/// All numbers that a design changes, by their keys: the free ones, those that go with them, and
/// masses and inertias of wheels whose size is among them. Nothing where they are no rover.
pub(super) fn numbers(
    task: &DesignTask,
    candidate: &RoverChoice,
    values: &[f64],
) -> Option<Vec<(String, f64)>> {
    let own = task.free.iter().map(|(key, _)| key.clone()).zip(values.iter().copied());
    let tied = task.tied.iter().map(|it| (it.key.clone(), it.sign * values[it.free]));
    let mut numbers: Vec<(String, f64)> = own.chain(tied).collect();
    let moved: Vec<String> = numbers.iter().map(|(key, _)| key.clone()).collect();
    let scenario = &candidate.grounds.first()?.scenario;
    let keys = numbers.iter().map(|(key, value)| (&**key, *value));
    let changed = scenario.value.with(keys).ok()?;
    for (table, factor, radii, inertia, mass) in units(&candidate.base, &changed.rover) {
        let is_free = |key: &str| {
            let chosen = candidate.chosen.iter().map(|(key, _)| key);
            moved.iter().chain(chosen).any(|it| it == key)
        };
        let key = format!("{table}.mass_kg");
        if factor == 1.0 || is_free(&key) || scenario.document.number(&key).is_none() {
            continue;
        }
        numbers.push((key, mass * factor));
        let turning = factor * radii * radii;
        let Inertia { xx, yy, zz } = inertia;
        let axes = [("xx", xx), ("yy", yy), ("zz", zz)];
        let inertias =
            axes.map(|(axis, own)| (format!("{table}.inertia_kg_m2.{axis}"), own * turning));
        numbers.extend(
            inertias
                .into_iter()
                .filter(|(key, _)| scenario.document.number(key).is_some() && !is_free(key)),
        );
    }
    Some(numbers)
}

/// The wheel units of a rover that have a mass: the tables that they stand in, by which factors
/// their sheets and their radii grew, and their own inertia and mass [kg].
fn units(own: &Rover, changed: &Rover) -> Vec<(String, f64, f64, Inertia, f64)> {
    let growth =
        |own: &Wheel, changed: &Wheel| (sheet(changed) / sheet(own), changed.radius / own.radius);
    let unit = |rover: &Rover| rover.parts().wheel_unit;
    let (one, other_unit) = (unit(own), unit(changed));
    let (factor, radii) = growth(&one.wheel, &other_unit.wheel);
    let mut units = vec![("rover.wheel_unit".to_owned(), factor, radii, one.inertia, one.mass)];
    let mounts = own.parts().mounts.iter().zip(&changed.parts().mounts).enumerate();
    units.extend(mounts.filter_map(|(place, (mount, other))| {
        let wheel = mount.wheel.as_ref().unwrap_or(&one.wheel);
        let changed = other.wheel.as_ref().unwrap_or(&other_unit.wheel);
        let (factor, radii) = growth(wheel, changed);
        let inertia = mount.inertia.unwrap_or(one.inertia);
        Some((format!("rover.mount.{place}"), factor, radii, inertia, mount.mass?))
    }));
    units
}

/// The area of the sheet that a wheel is made of, 2π r b + N h_g b [m²].
fn sheet(wheel: &Wheel) -> f64 {
    let grousers = wheel.grousers.map_or(0.0, |it| f64::from(it.count) * it.height);
    (TAU * wheel.radius + grousers) * wheel.width
}
