//! A rover on a soil that is hidden from the learner, over ground that is no plane, and its
//! telemetry.

use grouser::document::{self, LoadedScenario, Overrides, Source};
use grouser::simulation::SteadyMotion;
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::heading::HeadingStudy;
use grouser::studies::learn::{
    LearnSettings, Learner, ModelNoise, TelemetryRecord, WheelTelemetry,
};
use grouser::studies::simulated_telemetry::{SensorModels, Sensors};
use grouser::units::deg;
use grouser::vehicle::{roll_and_pitch, slope_and_yaw};
use grouser_io::statistics::random::{generator, standard_normal};
use rand_chacha::ChaCha8Rng;

/// Rim speed of all wheels [m/s].
pub(crate) const RIM_SPEED: f64 = 0.06;
/// Time between records [s].
pub(crate) const STEP: f64 = 0.1;

/// A part of a drive: slope and yaw [°], and the rims' way [m].
pub(crate) type Leg = (f64, f64, f64);

/// The HAKUTO rover on a soil.
pub(crate) fn scenario(settings: &[&str]) -> LoadedScenario {
    let overrides = Overrides::parse(settings.iter().copied()).expect("settings are well formed");
    document::read_scenario(&Source::default_scenario(), &overrides).expect("presets are read")
}

/// A learner that knows what a scenario's soil document knows.
pub(crate) fn learner(prior: &LoadedScenario) -> Learner {
    Learner::new(prior, false, LearnSettings::USUAL).expect("the soil is uncertain")
}

/// Instruments with noise, rounding, gaps, and one reading in twenty wrong by far.
pub(crate) const INSTRUMENTS: SensorModels = SensorModels { outliers: 0.05, ..SensorModels::USUAL };

/// A drive on a hidden soil.
pub(crate) struct Drive {
    study: HeadingStudy,
    ground: Option<Ground>,
    time: f64,
    /// Whether its wheels' sinkages are read.
    pub(crate) reads_sinkages: bool,
    pub(crate) records: Vec<TelemetryRecord>,
}

/// Ground that is uneven: patch by patch it leans, and its strength differs, by what [`ModelNoise`]
/// says of it.
struct Ground {
    noise: ModelNoise,
    random: ChaCha8Rng,
    patch: Option<Patch>,
}

/// Ground over which its unevenness is the same.
#[derive(Clone, Debug)]
struct Patch {
    /// The rims' way that is left of it [m].
    left: f64,
    /// How it leans to the right and up ahead [rad].
    lean: [f64; 2],
    /// By how much it is weaker across and along, as what it lacks of the force at the same slip,
    /// over the weight [-].
    weakness: [f64; 2],
    /// What is added to each wheel's torque: over its size [-], and as a torque [N·m].
    torques: Vec<[f64; 2]>,
}

impl Ground {
    /// The patch after a step [m], and whether it is a new one.
    fn step(&mut self, way: f64, wheels: usize) -> (Patch, bool) {
        if let Some(patch) = self.patch.as_mut().filter(|it| it.left > way) {
            patch.left -= way;
            return (patch.clone(), false);
        }
        let noise = self.noise;
        let mut normal = |deviation: f64| deviation * standard_normal(&mut self.random);
        let patch = Patch {
            left: noise.way,
            lean: [normal(noise.attitude), normal(noise.attitude)],
            weakness: [normal(noise.force), normal(noise.force)],
            torques: (0..wheels)
                .map(|_| [normal(noise.torque_share), normal(noise.torque)])
                .collect(),
        };
        self.patch = Some(patch.clone());
        (patch, true)
    }
}

impl Drive {
    /// On an even plane.
    pub(crate) fn new(prior: &LoadedScenario, truth: &Sample) -> Self {
        let study = HeadingStudy::of(&prior.value).of_sample(truth);
        Self { study, ground: None, time: 0.0, reads_sinkages: false, records: Vec::new() }
    }

    /// On ground that is as uneven as a learner takes it to be.
    pub(crate) fn uneven(prior: &LoadedScenario, truth: &Sample, seed: u64) -> Self {
        /// Streams of random numbers that no instrument has.
        const STREAM: u64 = 0xF5 << 56;
        let noise = LearnSettings::USUAL.noise;
        let ground = Ground { noise, random: generator(seed, STREAM), patch: None };
        Self { ground: Some(ground), ..Self::new(prior, truth) }
    }

    /// The study of the soil that is there.
    pub(crate) fn study(&self) -> &HeadingStudy {
        &self.study
    }

    /// Goes on over another soil.
    pub(crate) fn change(&mut self, truth: &Sample) {
        self.study = self.study.of_sample(truth);
    }

    /// When the last record was [s].
    pub(crate) fn time(&self) -> f64 {
        self.time
    }

    /// What is true of steady motion; `None` where there is none.
    pub(crate) fn leg(&mut self, (slope, yaw, way): Leg) -> Option<()> {
        /// A motion is computed anew after as much yaw [rad].
        const TURNED: f64 = 2e-3;
        let (slope, mut yaw) = (deg(slope), deg(yaw));
        let mut motion: Option<SteadyMotion> = None;
        let until = self.time + way / RIM_SPEED - 0.5 * STEP;
        let mut yaw_of_motion = yaw;
        while self.time < until {
            let wheels = self.study.rover.wheel_count();
            let (patch, is_new) = match &mut self.ground {
                Some(ground) => {
                    let (patch, is_new) = ground.step(RIM_SPEED * STEP, wheels);
                    (Some(patch), is_new)
                }
                None => (None, false),
            };
            // On weaker ground a rover moves as up a steeper slope.
            let lean = patch
                .as_ref()
                .map_or([0.0; 2], |it| [it.lean[0] + it.weakness[0], it.lean[1] + it.weakness[1]]);
            let [roll, pitch] = roll_and_pitch(slope, yaw);
            let here = match &motion {
                Some(motion) if !is_new && (yaw - yaw_of_motion).abs() < TURNED => motion.clone(),
                _ => {
                    let [slope, yaw] = slope_and_yaw(roll + lean[0], pitch + lean[1]);
                    let near = motion.as_ref().filter(|_| !is_new).map(|motion| {
                        self.study.steady_motion_near(motion, slope, yaw, RIM_SPEED).ok()
                    });
                    let found = near.flatten();
                    found.or_else(|| self.study.steady_motion(slope, yaw, RIM_SPEED).ok())?
                }
            };
            if motion.as_ref() != Some(&here) {
                yaw_of_motion = yaw;
            }
            self.time += STEP;
            self.records.push(self.record(&here, [roll, pitch], yaw, patch.as_ref()));
            yaw += here.yaw_rate * STEP;
            motion = Some(here);
        }
        Some(())
    }

    fn record(
        &self,
        here: &SteadyMotion,
        [roll, pitch]: [f64; 2],
        yaw: f64,
        patch: Option<&Patch>,
    ) -> TelemetryRecord {
        let mounts = self.study.rover.mounts();
        let weight = self.study.rover.mass() * self.study.gravity;
        // Up a steeper slope wheels would pull more; on weaker ground they do not.
        let weakness = patch.map_or(0.0, |it| it.weakness[1]);
        let wheels = here.wheels.iter().zip(mounts).enumerate().map(|(place, (wheel, mount))| {
            let lacking = weakness * weight * mount.shearing_radius() / mounts.len() as f64;
            let torque = wheel.settled.forces.torque - lacking;
            let [share, added] = patch.map_or([0.0; 2], |it| it.torques[place]);
            WheelTelemetry {
                speed: Some(RIM_SPEED / mount.shearing_radius()),
                torque: Some(torque * (1.0 + share) + added),
                sinkage: self.reads_sinkages.then_some(wheel.settled.sinkage),
                ..WheelTelemetry::default()
            }
        });
        TelemetryRecord {
            time: self.time,
            roll: Some(roll),
            pitch: Some(pitch),
            yaw: Some(yaw),
            displacement: [Some(here.velocity.x * STEP), Some(here.velocity.y * STEP)],
            rotation: Some(here.yaw_rate * STEP),
            wheels: wheels.collect(),
            ..TelemetryRecord::default()
        }
    }

    /// What instruments make of it.
    pub(crate) fn seen(&self, models: SensorModels, seed: u64) -> Vec<TelemetryRecord> {
        let mut sensors = Sensors::new(models, seed).expect("instruments are valid");
        self.records.iter().map(|record| sensors.read(record)).collect()
    }
}
