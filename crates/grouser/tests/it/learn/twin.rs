//! Twin experiments: a rover on a soil that is hidden from the learner, and its telemetry.

use grouser::document::{self, LoadedScenario, Overrides, Source};
use grouser::simulation::SteadyMotion;
use grouser::studies::ensemble::Band;
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
        let until = self.time + way / RIM_SPEED - 0.5 * STEP;
        let rover = self.study.rover.clone();
        while self.time < until {
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
    /// Slip ratio, and yaw [rad].
    pub(crate) truth: [f64; 2],
    pub(crate) before: [Band; 2],
    pub(crate) after: [Band; 2],
}

/// Drives over legs on a hidden soil, and predicts slip and yaw of the contour on a slope [°]; `None` where the rover
/// cannot drive there.
pub(crate) fn answer(
    prior: &LoadedScenario,
    truth: &Sample,
    (legs, slope): (&[Leg], f64),
    models: SensorModels,
    (seed, samples): (u64, u32),
) -> Option<Answer> {
    let mut drive = Drive::new(prior, truth);
    for leg in legs {
        drive.leg(*leg)?;
    }
    let there = drive.study.curve().unwrap().at(deg(slope)).ok()?;
    let mut learner = learner(prior);
    let bands = |learner: &Learner| {
        let samples = learner.samples(seed, samples).unwrap();
        let found = learner.predict(&samples, &[deg(slope)], &|| true).unwrap().unwrap();
        let found = &found.slopes[0];
        [found.slip_ratio, found.yaw].map(|band| band.expect("some samples hold the contour"))
    };
    let before = bands(&learner);
    for record in drive.seen(models, seed) {
        learner.update(record);
    }
    learner.finish();
    Some(Answer { truth: [there.slip_ratio, there.yaw], before, after: bands(&learner) })
}

pub(crate) fn learner(prior: &LoadedScenario) -> Learner {
    Learner::new(prior, false, LearnSettings::USUAL).unwrap()
}

/// The hidden soils of some repeats.
pub(crate) fn truths(prior: &LoadedScenario, seed: u64, count: u32) -> Vec<Sample> {
    BandInputs::of_scenario(prior).samples(seed, count).unwrap()
}
