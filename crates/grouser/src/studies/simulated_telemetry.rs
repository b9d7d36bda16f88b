//! What a rover's instruments would say of a drive, with their noise and faults.
//!
//! [`truth`] is what perfect ones would say of a run.
//!
//! [`Sensors`] take what is true at a time and give what the telemetry has of it: with noise, bias,
//! rounding, gaps and outliers, from a seed. A reading depends on the seed and on the readings
//! before it, and on nothing else.

use rand_chacha::ChaCha8Rng;

use super::random;
use crate::elementary::wide::{cos, sin};
use crate::error::{ParameterError, not_negative};
use crate::simulation::{Record, Scenario, Trajectory, WheelRecord};
use crate::vehicle::{Mount, roll_and_pitch};
use grouser_io::measurements::telemetry::{TelemetryRecord, WheelTelemetry};

/// What is wrong with one kind of instrument.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fault {
    /// Standard deviation of a reading, in the reading's unit.
    pub noise: f64,
    /// Part of the noise that grows with the reading [-].
    pub relative_noise: f64,
    /// What is always added, in the reading's unit.
    pub bias: f64,
    /// Readings are whole multiples of this, in the reading's unit; 0 where they are not rounded.
    pub step: f64,
}

/// A rover's instruments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorModels {
    /// Roll and pitch [rad].
    pub attitude: Fault,
    /// Yaw [rad].
    pub yaw: Fault,
    /// Ways by odometry, each since the last [m].
    pub odometry: Fault,
    /// Rotation by odometry, each since the last [rad].
    pub rotation: Fault,
    /// Wheel speeds [rad/s].
    pub wheel_speed: Fault,
    /// Torques [N·m] or currents [A].
    pub torque: Fault,
    /// Sinkages [m].
    pub sinkage: Fault,
    /// The share of readings that are missing [-].
    pub dropouts: f64,
    /// The share of readings that are wrong by far [-].
    pub outliers: f64,
    /// Readings a second [Hz]; 0 for one at each record of the run.
    pub rate: f64,
}

impl SensorModels {
    /// Instruments without a fault.
    pub const PERFECT: Self = Self {
        attitude: Fault::NONE,
        yaw: Fault::NONE,
        odometry: Fault::NONE,
        rotation: Fault::NONE,
        wheel_speed: Fault::NONE,
        torque: Fault::NONE,
        sinkage: Fault::NONE,
        dropouts: 0.0,
        outliers: 0.0,
        rate: 0.0,
    };

    /// Those of a micro rover. Source: ours, after what is sold: an attitude to 0.2°, odometry to a
    /// millimetre for each picture, torques to 5 %.
    pub const USUAL: Self = Self {
        attitude: Fault { noise: 3.5e-3, relative_noise: 0.0, bias: 0.0, step: 1.7e-4 },
        yaw: Fault { noise: 8.7e-3, relative_noise: 0.0, bias: 0.0, step: 1.7e-4 },
        odometry: Fault { noise: 5e-4, relative_noise: 0.02, bias: 0.0, step: 1e-5 },
        rotation: Fault { noise: 1e-3, relative_noise: 0.0, bias: 0.0, step: 1e-5 },
        wheel_speed: Fault { noise: 5e-3, relative_noise: 0.0, bias: 0.0, step: 1e-3 },
        torque: Fault { noise: 5e-3, relative_noise: 0.05, bias: 0.0, step: 1e-3 },
        sinkage: Fault { noise: 3e-3, relative_noise: 0.1, bias: 0.0, step: 1e-3 },
        dropouts: 0.02,
        outliers: 0.0,
        rate: 0.0,
    };

    /// Checks that every number of the instruments is in its range.
    ///
    /// # Errors
    /// [`ParameterError`] for the first number that is out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        let all = [
            self.attitude,
            self.yaw,
            self.odometry,
            self.rotation,
            self.wheel_speed,
            self.torque,
            self.sinkage,
        ];
        for fault in all {
            not_negative("noise of an instrument", fault.noise)?;
            not_negative("relative noise of an instrument", fault.relative_noise)?;
            not_negative("step of an instrument", fault.step)?;
            crate::error::finite("bias of an instrument", fault.bias)?;
        }
        not_negative("rate of readings [Hz]", self.rate)?;
        for share in [self.dropouts, self.outliers] {
            if !(0.0..=1.0).contains(&share) {
                let expected = "a share, 0 to 1";
                return Err(ParameterError::new("share of readings", share, expected));
            }
        }
        Ok(())
    }
}

impl Fault {
    /// No fault.
    pub const NONE: Self = Self { noise: 0.0, relative_noise: 0.0, bias: 0.0, step: 0.0 };
}

/// Instruments that read.
#[derive(Clone, Debug)]
pub struct Sensors {
    models: SensorModels,
    random: ChaCha8Rng,
    /// When they last read [s].
    last: Option<f64>,
    /// Ways and rotation that no reading has reported yet.
    unreported: [f64; 3],
}

/// What perfect instruments say of a run: of a rover whose motors are known currents, of another
/// torques. Yaw is reported on a plane, where it counts from the contour.
#[must_use]
pub fn truth(run: &Trajectory, scenario: &Scenario) -> Vec<TelemetryRecord> {
    let mounts = scenario.rover.mounts();
    let slope = scenario.ground.plane_slope();
    let mut last: Option<&Record> = None;
    let mut all = Vec::with_capacity(run.records.len());
    for record in &run.records {
        all.push(truth_at(record, last, (slope, mounts)));
        last = Some(record);
    }
    all
}

/// * `slope`: of a plane [rad]
fn truth_at(
    record: &Record,
    last: Option<&Record>,
    (slope, mounts): (Option<f64>, &[Mount]),
) -> TelemetryRecord {
    let yaw = record.state.yaw;
    let on_plane = slope.map(|slope| roll_and_pitch(slope, yaw));
    let stands = record.attitude.as_ref().map(|it| [it.roll, it.pitch]);
    let [roll, pitch] = [0, 1].map(|place| stands.or(on_plane).map(|it| it[place]));
    let moved = last.map(|last| {
        let (way, turned) = (record.state.position - last.state.position, yaw - last.state.yaw);
        let middle = yaw - 0.5 * turned;
        let (cos, sin) = (cos(middle), sin(middle));
        ([cos * way.x + sin * way.y, cos * way.y - sin * way.x], turned)
    });
    let wheels = mounts.iter().enumerate().map(|(place, mount)| {
        record.wheels.get(place).map_or_else(WheelTelemetry::default, |it| of_wheel(it, mount))
    });
    TelemetryRecord {
        time: record.time,
        roll,
        pitch,
        yaw: slope.map(|_| yaw),
        displacement: [0, 1].map(|place| moved.map(|(way, _)| way[place])),
        rotation: moved.map(|(_, turned)| turned),
        wheels: wheels.collect(),
        ..TelemetryRecord::default()
    }
}

fn of_wheel(record: &WheelRecord, mount: &Mount) -> WheelTelemetry {
    let current = record.electrical.as_ref().map(|it| it.current);
    let torque = record.reaction.settled.forces.torque;
    WheelTelemetry {
        speed: Some(record.wheel_speed),
        torque: current.is_none().then_some(torque),
        current,
        steering: mount.steering_axis.is_some().then_some(record.steering),
        sinkage: Some(record.reaction.settled.sinkage),
    }
}

/// The stream of random numbers of instruments.
const STREAM: u64 = 0xFB << 56;

impl Sensors {
    /// # Errors
    /// The same as [`SensorModels::check`].
    pub fn new(models: SensorModels, seed: u64) -> Result<Self, ParameterError> {
        models.check()?;
        Ok(Self {
            models,
            random: random::generator(seed, STREAM),
            last: None,
            unreported: [0.0; 3],
        })
    }

    /// What they say of a drive, at their rate.
    pub fn read_all(&mut self, truth: &[TelemetryRecord]) -> Vec<TelemetryRecord> {
        truth.iter().filter_map(|record| self.read_at_rate(record)).collect()
    }

    /// What they say at a time, if they read then; ways and rotation add up until they do.
    fn read_at_rate(&mut self, truth: &TelemetryRecord) -> Option<TelemetryRecord> {
        /// A record this much too early is one of its time [-].
        const EARLY: f64 = 1e-6;
        let due =
            self.last.is_none_or(|last| (truth.time - last) * self.models.rate >= 1.0 - EARLY);
        if due || self.models.rate == 0.0 {
            self.last = Some(truth.time);
            return Some(self.read(truth));
        }
        let [forward, leftward] = truth.displacement;
        for (unreported, way) in self.unreported.iter_mut().zip([forward, leftward, truth.rotation])
        {
            *unreported += way.unwrap_or(0.0);
        }
        None
    }

    /// What they say at a time. Where a way or a rotation is missing, the next reading has it too.
    ///
    /// * `truth`: what is true then; ways and rotation since the last
    pub fn read(&mut self, truth: &TelemetryRecord) -> TelemetryRecord {
        /// An angle that is wrong by far [rad].
        const ANGLE: f64 = 0.5;
        let models = self.models;
        let mut seen = truth.clone();
        seen.roll = seen.roll.and_then(|it| self.reading(it, models.attitude, ANGLE));
        seen.pitch = seen.pitch.and_then(|it| self.reading(it, models.attitude, ANGLE));
        seen.yaw = seen.yaw.and_then(|it| self.reading(it, models.yaw, ANGLE));
        let [forward, leftward] = truth.displacement;
        let ways = [
            (forward, models.odometry),
            (leftward, models.odometry),
            (truth.rotation, models.rotation),
        ];
        let mut reported = [None; 3];
        for (place, (way, fault)) in ways.into_iter().enumerate() {
            let Some(way) = way else { continue };
            self.unreported[place] += way;
            let whole = self.unreported[place];
            reported[place] = self.reading(whole, fault, 10.0 * (whole.abs() + fault.noise));
            if reported[place].is_some() {
                self.unreported[place] = 0.0;
            }
        }
        seen.displacement = [reported[0], reported[1]];
        seen.rotation = reported[2];
        for wheel in &mut seen.wheels {
            let far = |value: Option<f64>| value.map_or(0.0, |it| 3.0 * it.abs());
            let (speed, torque) = (far(wheel.speed), far(wheel.torque));
            wheel.speed = wheel.speed.and_then(|it| self.reading(it, models.wheel_speed, speed));
            wheel.torque = wheel.torque.and_then(|it| self.reading(it, models.torque, torque));
            let current = far(wheel.current);
            wheel.current = wheel.current.and_then(|it| self.reading(it, models.torque, current));
            let sinkage = far(wheel.sinkage);
            let sunk = wheel.sinkage.and_then(|it| self.reading(it, models.sinkage, sinkage));
            wheel.sinkage = sunk.map(|it| it.max(0.0));
        }
        seen
    }

    /// A reading; nothing where it is missing.
    ///
    /// * `far`: how far off an outlier may be
    fn reading(&mut self, value: f64, fault: Fault, far: f64) -> Option<f64> {
        let mut uniform = || random::uniform(&mut self.random);
        let (drop, wild, where_to) = (uniform(), uniform(), uniform());
        let score = random::standard_normal(&mut self.random);
        if drop < self.models.dropouts {
            return None;
        }
        if wild < self.models.outliers {
            return Some(value + (2.0 * where_to - 1.0) * far);
        }
        let size = crate::elementary::wide::hypot(fault.noise, fault.relative_noise * value);
        let read = value + fault.bias + size * score;
        Some(if fault.step > 0.0 { (read / fault.step).round() * fault.step } else { read })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use grouser_io::measurements::telemetry::WheelTelemetry;

    fn truth(time: f64) -> TelemetryRecord {
        TelemetryRecord {
            time,
            roll: Some(0.1),
            pitch: Some(-0.05),
            yaw: Some(0.3),
            displacement: [Some(0.01), Some(-0.001)],
            rotation: Some(2e-4),
            wheels: vec![WheelTelemetry {
                speed: Some(1.0),
                torque: Some(0.3),
                ..WheelTelemetry::default()
            }],
            ..TelemetryRecord::default()
        }
    }

    #[test]
    fn perfect_instruments_say_what_is_true() {
        let mut sensors = Sensors::new(SensorModels::PERFECT, 1).unwrap();
        assert_eq!(sensors.read(&truth(2.0)), truth(2.0));
    }

    /// However many readings are missing, the ways add up.
    #[test]
    fn no_way_is_lost_in_gaps() {
        let models = SensorModels { dropouts: 0.4, ..SensorModels::PERFECT };
        let mut sensors = Sensors::new(models, 5).unwrap();
        let (mut sum, mut gaps) = (0.0, 0);
        for step in 0..2000 {
            match sensors.read(&truth(f64::from(step))).displacement[0] {
                Some(way) => sum += way,
                None => gaps += 1,
            }
        }
        assert!((sum + sensors.unreported[0] - 20.0).abs() < 1e-9);
        assert!((700..900).contains(&gaps), "{gaps}");
    }

    /// At a tenth of the records the ways are those of ten.
    #[test]
    fn a_slower_rate_tells_the_same_way() {
        let models = SensorModels { rate: 1.0, ..SensorModels::PERFECT };
        let mut sensors = Sensors::new(models, 5).unwrap();
        let truths: Vec<_> = (0..101).map(|step| truth(0.1 * f64::from(step))).collect();
        let seen = sensors.read_all(&truths);
        assert_eq!(seen.len(), 11);
        let ways: Vec<f64> = seen.iter().filter_map(|it| it.displacement[0]).collect();
        assert!((ways[3] - 0.1).abs() < 1e-12 && (ways.iter().sum::<f64>() - 1.01).abs() < 1e-9);
    }

    #[test]
    fn noise_has_its_deviation_and_outliers_their_share() {
        let fault = Fault { noise: 0.02, ..Fault::NONE };
        let models = SensorModels { attitude: fault, outliers: 0.05, ..SensorModels::PERFECT };
        let mut sensors = Sensors::new(models, 9).unwrap();
        let rolls: Vec<f64> =
            (0..4000).filter_map(|it| sensors.read(&truth(f64::from(it))).roll).collect();
        let near: Vec<f64> = rolls.iter().map(|it| it - 0.1).filter(|it| it.abs() < 0.08).collect();
        let variance = near.iter().map(|it| it * it).sum::<f64>() / near.len() as f64;
        assert!((variance.sqrt() / 0.02 - 1.0).abs() < 0.15, "{}", variance.sqrt());
        let wild = (rolls.len() - near.len()) as f64 / rolls.len() as f64;
        assert!((wild - 0.05 * 0.84).abs() < 0.01, "{wild}");
    }

    #[test]
    fn hostile_models_are_refused() {
        for models in [
            SensorModels { dropouts: 1.5, ..SensorModels::PERFECT },
            SensorModels { outliers: f64::NAN, ..SensorModels::PERFECT },
            SensorModels { torque: Fault { noise: -1.0, ..Fault::NONE }, ..SensorModels::PERFECT },
        ] {
            assert!(Sensors::new(models, 1).is_err());
        }
    }
}
