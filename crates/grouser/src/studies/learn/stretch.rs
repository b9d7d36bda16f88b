//! Telemetry in stretches: what the instruments said on the mean over a decimetre or so of the
//! wheels' way.

use super::archive::{self, Archive, items, maybes, numbers};
use super::middle::Middle;
use crate::elementary::wide::{asin, cos, sin};
use crate::units::Vec2;
use crate::vehicle::{Rover, slope_and_yaw};
use grouser_io::measurements::telemetry::{TelemetryRecord, WheelTelemetry};

/// What was read on the mean over a stretch of the way.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stretch {
    /// When it began and ended [s].
    pub time: [f64; 2],
    /// The way of the rims over it [m].
    pub way: f64,
    /// Slope of the ground and yaw of the body, *α*, *γ* [rad], from roll and pitch; `None` without
    /// them.
    pub attitude: Option<[f64; 2]>,
    /// Yaw as the telemetry has it, *γ* [rad].
    pub reported_yaw: Option<f64>,
    /// Rim speed of each wheel [m/s].
    pub rim_speeds: Vec<f64>,
    /// How much rim speeds scatter, over their size [-].
    pub rim_scatter: f64,
    /// Steering angle of each wheel [rad], where it was read.
    pub steering: Vec<Option<f64>>,
    /// Velocity along the body and to its left [m/s].
    pub velocity: [Option<Reading>; 2],
    /// Yaw rate [rad/s].
    pub yaw_rate: Option<Reading>,
    /// Torque of each wheel [N·m].
    pub torques: Vec<Option<Reading>>,
    /// Current of each wheel's motor [A], where it was read.
    pub currents: Vec<Option<f64>>,
    /// Sinkage of each wheel [m].
    pub sinkages: Vec<Option<Reading>>,
    /// How many readings were outliers.
    pub outliers: usize,
}

/// A mean, and how well it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading {
    /// The mean.
    pub value: f64,
    /// Its standard deviation.
    pub deviation: f64,
}

/// The rims' way of a stretch [m]: short enough to see the soil change, long enough for a mean.
/// Source: ours.
pub(super) const WAY: f64 = 0.1;
/// A stretch has this many readings of the motion at least, unless it is [`LONGEST`].
pub(super) const LEAST_READINGS: usize = 7;
/// The rims' way of the longest stretch [m].
const LONGEST: f64 = 0.5;
/// A stretch takes this long at most [s]: rovers that stand have one, too.
const LAST: f64 = 30.0;
/// A gap this long between records ends a stretch [s].
pub(in crate::studies) const GAP: f64 = 5.0;
/// A stretch has this many records at most.
const MOST_RECORDS: usize = 4096;
/// Rims whose speeds differ by no more than this are alike: in standard deviations of their means,
/// and over their speed [-].
const MOST_ALIKE: f64 = 4.0;
const ALIKE: f64 = 5e-3;
/// What a reading of the motion scatters by where too few tell, over the rims' speed [-].
pub(super) const USUAL_SCATTER: f64 = 0.05;
/// The same of torques, over their size, and of sinkages [m].
pub(super) const USUAL_TORQUE: f64 = 0.1;
const USUAL_SINKAGE: f64 = 0.003;

/// Gathers records into stretches. What it gives depends on the records alone, not on how many are
/// given at once.
#[derive(Clone, Debug)]
pub(in crate::studies) struct Gatherer {
    rover: Rover,
    slope: Option<f64>,
    records: Vec<TelemetryRecord>,
    readings: [Vec<f64>; 3],
    way: f64,
    /// The rims' speed as it was last read [m/s].
    rim_speed: f64,
    /// When each of forward, leftward and rotation was last read [s].
    last: [Option<f64>; 3],
    fix: Option<(f64, Vec2)>,
    last_time: Option<f64>,
}

impl Gatherer {
    /// * `slope`: of the ground where the telemetry does not tell it [rad]
    pub(in crate::studies) fn new(rover: &Rover, slope: Option<f64>) -> Self {
        Self {
            rover: rover.clone(),
            slope,
            records: Vec::new(),
            readings: Default::default(),
            way: 0.0,
            rim_speed: 0.0,
            last: [None; 3],
            fix: None,
            last_time: None,
        }
    }

    /// Adds a record; the stretch that is complete with it, if one is.
    pub(in crate::studies) fn push(&mut self, record: TelemetryRecord) -> Option<Stretch> {
        let before = self.last_time.replace(record.time);
        let gap = before.map_or(0.0, |before| record.time - before);
        let ended = if gap > GAP { self.take() } else { None };
        self.read_motion(&record);
        self.rim_speed = self.read_rim_speed(&record).unwrap_or(self.rim_speed);
        if gap <= GAP {
            self.way += gap * self.rim_speed;
        }
        self.records.push(record);
        if ended.is_some() {
            return ended;
        }
        if self.is_complete() { self.take() } else { None }
    }

    /// What is left.
    pub(in crate::studies) fn take(&mut self) -> Option<Stretch> {
        let stretch = self.stretch();
        self.records.clear();
        self.readings.iter_mut().for_each(Vec::clear);
        self.way = 0.0;
        stretch
    }

    fn is_complete(&self) -> bool {
        let [first, .., last] = &self.records[..] else { return false };
        self.way >= LONGEST
            || last.time - first.time >= LAST
            || self.records.len() >= MOST_RECORDS
            || (self.way >= WAY && self.readings[0].len() >= LEAST_READINGS)
    }

    /// The middle of the rims' speeds [m/s]; `None` where none was read.
    fn read_rim_speed(&self, record: &TelemetryRecord) -> Option<f64> {
        let mounts = self.rover.mounts().iter().zip(&record.wheels);
        let mut speeds: Vec<f64> = mounts
            .filter_map(|(mount, wheel)| Some((wheel.speed? * mount.shearing_radius()).abs()))
            .collect();
        speeds.sort_by(f64::total_cmp);
        grouser_io::statistics::quantile(&speeds, 0.5)
    }

    /// Takes the velocities that a record tells: ways since the last one, or without them two
    /// fixes.
    fn read_motion(&mut self, record: &TelemetryRecord) {
        if record.is_way_incomplete {
            self.last = [None; 3];
        }
        let [forward, leftward] = record.displacement;
        for (place, way) in [forward, leftward, record.rotation].into_iter().enumerate() {
            let Some(way) = way else { continue };
            let since = self.last[place].replace(record.time);
            if let Some(since) = since.filter(|since| record.time - since <= GAP) {
                self.readings[place].push(way / (record.time - since));
            }
        }
        if let [Some(x), Some(y)] = record.position {
            let (at, before) = (Vec2::new(x, y), self.fix);
            self.fix = Some((record.time, at));
            let has_odometry = self.last[0].is_some();
            if let (Some((since, from)), Some(yaw), false) = (before, record.yaw, has_odometry)
                && record.time - since <= GAP
            {
                let speed = (at - from) / (record.time - since);
                let (cos, sin) = (cos(yaw), sin(yaw));
                self.readings[0].push(cos * speed.x + sin * speed.y);
                self.readings[1].push(cos * speed.y - sin * speed.x);
            }
        }
    }

    fn stretch(&self) -> Option<Stretch> {
        let (first, last) = (self.records.first()?, self.records.last()?);
        let mut outliers = 0;
        let mut middle = |readings: &mut Vec<f64>| {
            let found = Middle::of(readings);
            outliers += found.map_or(0, |it| it.outliers);
            found
        };
        let mut of = |read: &dyn Fn(&TelemetryRecord) -> Option<f64>| {
            middle(&mut self.records.iter().filter_map(read).collect())
        };
        let rims = self.rims(&mut of)?;
        let fastest = rims.iter().map(|it| it.value.abs()).fold(0.0, f64::max);
        // Outliers are those of one wheel, a change of speed is that of most.
        let mut scatters: Vec<f64> = rims.iter().map(|it| it.scatter).collect();
        scatters.sort_by(f64::total_cmp);
        let scatter = grouser_io::statistics::quantile(&scatters, 0.5).unwrap_or(0.0);
        let value = |it: Option<Middle>| it.map(|it| it.value);
        let (roll, pitch) = (value(of(&|it| it.roll)), value(of(&|it| it.pitch)));
        let reported_yaw = value(of(&|it| it.yaw));
        let each = 0..self.rover.wheel_count();
        let torques = each.clone().map(|wheel| {
            let found = of(&|it| self.torque(wheel, &it.wheels[wheel]))?;
            Some(found.reading(USUAL_TORQUE * found.value.abs()))
        });
        let torques = torques.collect();
        let currents =
            each.clone().map(|wheel| value(of(&|it| it.wheels[wheel].current))).collect();
        let sinkages = each
            .clone()
            .map(|wheel| of(&|it| it.wheels[wheel].sinkage).map(|it| it.reading(USUAL_SINKAGE)));
        let sinkages = sinkages.collect();
        let steering = each.map(|wheel| value(of(&|it| it.wheels[wheel].steering))).collect();
        let usual = USUAL_SCATTER * fastest;
        let [forward, leftward, rotation] =
            [0, 1, 2].map(|place| middle(&mut self.readings[place].clone()));
        let reach = self.rover.load_arms().iter().map(Vec2::norm).fold(f64::MIN_POSITIVE, f64::max);
        Some(Stretch {
            time: [first.time, last.time],
            way: self.way,
            attitude: attitude(roll, pitch, reported_yaw, self.slope),
            reported_yaw,
            rim_scatter: if fastest > 0.0 { scatter / fastest } else { 0.0 },
            rim_speeds: rims.iter().map(|it| it.value).collect(),
            steering,
            velocity: [forward, leftward].map(|it| it.map(|it| it.reading(usual))),
            yaw_rate: rotation.map(|it| it.reading(usual / reach)),
            torques,
            currents,
            sinkages,
            outliers,
        })
    }

    /// The rim speeds of all wheels [m/s]; that of a wheel without readings is the middle of the
    /// others.
    fn rims(
        &self,
        of: &mut impl FnMut(&dyn Fn(&TelemetryRecord) -> Option<f64>) -> Option<Middle>,
    ) -> Option<Vec<Middle>> {
        let mounts = self.rover.mounts().iter().enumerate();
        let read: Vec<Option<Middle>> = mounts
            .map(|(wheel, mount)| {
                let radius = mount.shearing_radius();
                of(&|it| it.wheels[wheel].speed.map(|speed| speed * radius))
            })
            .collect();
        let known: Vec<Middle> = read.iter().copied().flatten().collect();
        let first = *known.first()?;
        let mut speeds: Vec<f64> = known.iter().map(|it| it.value).collect();
        speeds.sort_by(f64::total_cmp);
        let middle = grouser_io::statistics::quantile(&speeds, 0.5)?;
        // Rims that differ by no more than their readings' noise turn alike: where wheels hardly
        // slip, a hundredth between them is as much as their slip.
        let differs = |it: &Middle| {
            (it.value - middle).abs() > MOST_ALIKE * it.deviation(0.0) + ALIKE * middle.abs()
        };
        if !known.iter().any(differs) {
            return Some(vec![Middle { value: middle, ..first }; read.len()]);
        }
        Some(read.into_iter().map(|it| it.unwrap_or(Middle { value: middle, ..first })).collect())
    }

    /// The torque of a wheel [N·m], as it was read or from its current.
    fn torque(&self, wheel: usize, read: &WheelTelemetry) -> Option<f64> {
        let of_current = || {
            let motor = self.rover.mounts()[wheel].unit.motor?;
            motor.torque(read.current?, read.speed?)
        };
        read.torque.or_else(of_current)
    }
}

impl Gatherer {
    /// Writes or reads what was gathered so far; the rest follows from the rover.
    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { rover: _, slope: _, records, readings, way, rim_speed, last, fix, last_time } =
            self;
        items(archive, "records", records, TelemetryRecord::default, archive::record);
        for (name, readings) in ["forward", "leftward", "rotation"].into_iter().zip(readings) {
            numbers(archive, name, readings);
        }
        archive.number("way", way);
        archive.number("rim_speed", rim_speed);
        let mut of_last = last.to_vec();
        maybes(archive, "last", &mut of_last);
        if let Ok(read) = of_last.try_into() {
            *last = read;
        }
        let mut of_fix: Vec<f64> = fix.iter().flat_map(|(time, at)| [*time, at.x, at.y]).collect();
        numbers(archive, "fix", &mut of_fix);
        *fix = match of_fix[..] {
            [time, x, y] => Some((time, Vec2::new(x, y))),
            _ => None,
        };
        archive.maybe("last_time", last_time);
    }

    /// Whether its records have the rover's wheels.
    pub(super) fn is_whole(&self) -> bool {
        self.records.iter().all(|it| it.wheels.len() == self.rover.wheel_count())
    }
}

impl Middle {
    /// * `usual`: standard deviation of a single reading, where too few tell
    fn reading(self, usual: f64) -> Reading {
        Reading { value: self.value, deviation: self.deviation(usual) }
    }
}

/// Slope and yaw from what there is of roll, pitch and yaw; with none of roll and pitch, the slope
/// that is known by other means.
fn attitude(
    roll: Option<f64>,
    pitch: Option<f64>,
    yaw: Option<f64>,
    slope: Option<f64>,
) -> Option<[f64; 2]> {
    /// A share of the slope this small says little of the whole [-].
    const LEAST_SHARE: f64 = 0.3;
    match (roll, pitch, yaw) {
        (Some(roll), Some(pitch), _) => Some(slope_and_yaw(roll, pitch)),
        (Some(roll), None, Some(yaw)) if cos(yaw).abs() > LEAST_SHARE => {
            Some([asin((sin(roll) / cos(yaw)).clamp(-1.0, 1.0)), yaw])
        }
        (None, Some(pitch), Some(yaw)) if sin(yaw).abs() > LEAST_SHARE => {
            Some([asin((sin(pitch) / sin(yaw)).clamp(-1.0, 1.0)), yaw])
        }
        (_, _, yaw) => slope.map(|slope| [slope, yaw.unwrap_or(0.0)]),
    }
    .map(|[slope, yaw]| {
        // Down the other way is the same slope seen from behind.
        if slope < 0.0 { [-slope, yaw + std::f64::consts::PI] } else { [slope, yaw] }
    })
}
