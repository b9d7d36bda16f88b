//! Twin experiments: a rover on a soil that is hidden from the learner, and its telemetry.

use grouser::document::{self, LoadedScenario, Overrides, Source};
use grouser::simulation::SteadyMotion;
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::studies::heading::HeadingStudy;
use grouser::studies::learn::{LearnSettings, Learner, TelemetryRecord, WheelTelemetry};
use grouser::studies::simulated_telemetry::{SensorModels, Sensors};
use grouser::units::deg;
use grouser::vehicle::roll_and_pitch;

/// Rim speed of all wheels [m/s].
pub(crate) const RIM_SPEED: f64 = 0.06;
/// Time between records [s].
const STEP: f64 = 0.1;

/// A part of a drive: slope and yaw [°], and the rims' way [m].
pub(crate) type Leg = (f64, f64, f64);

/// The HAKUTO rover on a soil.
pub(crate) fn scenario(settings: &[&str]) -> LoadedScenario {
    let overrides = Overrides::parse(settings.iter().copied()).unwrap();
    document::read_scenario(&Source::default_scenario(), &overrides).unwrap()
}

/// A drive on a hidden soil.
pub(crate) struct Drive {
    study: HeadingStudy,
    time: f64,
    pub(crate) records: Vec<TelemetryRecord>,
}

impl Drive {
    pub(crate) fn new(prior: &LoadedScenario, truth: &Sample) -> Self {
        let study = HeadingStudy::of(&prior.value).of_sample(truth);
        Self { study, time: 0.0, records: Vec::new() }
    }

    /// Goes on over another soil.
    pub(crate) fn change(&mut self, truth: &Sample) {
        self.study = self.study.of_sample(truth);
    }

    /// What is true of steady motion; `None` where there is none.
    pub(crate) fn leg(&mut self, (slope, yaw, way): Leg) -> Option<()> {
        let (slope, mut yaw) = (deg(slope), deg(yaw));
        let mut motion: Option<SteadyMotion> = None;
        let [count, _] = [(way / RIM_SPEED / STEP).round(), 0.0];
        let rover = self.study.rover.clone();
        for _ in 0..count as u32 {
            let found = match &motion {
                Some(motion) => self.study.steady_motion_near(motion, slope, yaw, RIM_SPEED),
                None => self.study.steady_motion(slope, yaw, RIM_SPEED),
            };
            let here = found.ok()?;
            let [roll, pitch] = roll_and_pitch(slope, yaw);
            let wheels = here.wheels.iter().zip(rover.mounts()).map(|(wheel, mount)| {
                let speed = RIM_SPEED / mount.shearing_radius();
                let torque = wheel.settled.forces.torque;
                WheelTelemetry {
                    speed: Some(speed),
                    torque: Some(torque),
                    ..WheelTelemetry::default()
                }
            });
            self.time += STEP;
            self.records.push(TelemetryRecord {
                time: self.time,
                roll: Some(roll),
                pitch: Some(pitch),
                yaw: Some(yaw),
                displacement: [Some(here.velocity.x * STEP), Some(here.velocity.y * STEP)],
                rotation: Some(here.yaw_rate * STEP),
                position: [None; 2],
                wheels: wheels.collect(),
            });
            yaw += here.yaw_rate * STEP;
            motion = Some(here);
        }
        Some(())
    }

    /// What instruments make of it.
    pub(crate) fn seen(&self, models: SensorModels, seed: u64) -> Vec<TelemetryRecord> {
        let mut sensors = Sensors::new(models, seed).unwrap();
        self.records.iter().map(|record| sensors.read(record)).collect()
    }
}

/// What is predicted for one slope, before a drive and after it, and what is true there.
#[derive(Debug)]
pub(crate) struct Answer {
    pub(crate) truth: [f64; 2],
    /// Of slip ratio and yaw: lower end, median, upper end.
    pub(crate) before: [[f64; 3]; 2],
    pub(crate) after: [[f64; 3]; 2],
    /// The place of the true slip among the samples, 0 to 1.
    pub(crate) rank: f64,
}

/// Drives over legs on a hidden soil, and predicts slip and yaw of the contour on a slope [°]; `None` where the rover
/// cannot drive there.
pub(crate) fn answer(
    prior: &LoadedScenario,
    truth: &Sample,
    legs: &[Leg],
    slope: f64,
    models: SensorModels,
    seed: u64,
) -> Option<Answer> {
    let mut drive = Drive::new(prior, truth);
    for leg in legs {
        drive.leg(*leg)?;
    }
    let there = drive.study.curve().unwrap().at(deg(slope)).ok()?;
    let mut learner = Learner::new(prior, false, LearnSettings::USUAL).unwrap();
    let before = band(&learner, slope, seed);
    for record in drive.seen(models, seed) {
        learner.update(record);
    }
    learner.finish();
    if std::env::var("SHARES").is_ok() {
        println!("{:?} {:?} {:?}", learner.models().shares(), learner.narrowed(), learner.learnt());
        for theory in ["ishigami", "rft", "small-wheel"] {
            let study = HeadingStudy::of(&prior.value);
            let all: Vec<f64> = learner
                .samples(seed, 200)
                .unwrap()
                .iter()
                .filter(|it| it.sample.theory.name() == theory)
                .filter_map(|it| {
                    Some(
                        study
                            .of_sample(&it.sample)
                            .curve()
                            .unwrap()
                            .at(deg(slope))
                            .ok()?
                            .yaw
                            .to_degrees(),
                    )
                })
                .collect();
            let mean = all.iter().sum::<f64>() / all.len() as f64;
            let sd =
                (all.iter().map(|it| (it - mean).powi(2)).sum::<f64>() / all.len() as f64).sqrt();
            println!("   {theory} {} {mean:.2} +- {sd:.2}", all.len());
        }
    }
    let after = band(&learner, slope, seed);
    let samples = learner.samples(seed, 64).unwrap();
    let study = HeadingStudy::of(&prior.value);
    let below = samples.iter().filter(|it| {
        let curve = study.of_sample(&it.sample).curve().unwrap();
        curve.at(deg(slope)).is_ok_and(|it| it.slip_ratio < there.slip_ratio)
    });
    let rank = below.count() as f64 / samples.len() as f64;
    Some(Answer { truth: [there.slip_ratio, there.yaw], before, after, rank })
}

pub(crate) fn band(learner: &Learner, slope: f64, seed: u64) -> [[f64; 3]; 2] {
    let samples = learner.samples(seed, 100).unwrap();
    let found = learner.predict(&samples, &[deg(slope)], &|| true).unwrap().unwrap();
    let found = &found.slopes[0];
    [found.slip_ratio, found.yaw]
        .map(|band| band.map_or([f64::NAN; 3], |it| [it.low, it.median, it.high]))
}

/// The hidden soils of some repeats.
pub(crate) fn truths(prior: &LoadedScenario, seed: u64, count: u32) -> Vec<Sample> {
    BandInputs::of_scenario(prior).samples(seed, count).unwrap()
}
