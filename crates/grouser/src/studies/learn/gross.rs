//! Gross faults of telemetry, on an absolute scale, before anything statistical: units taken for
//! others, signs, and odometry that is that of wheels.
//!
//! What is judged by the scatter of its own data is noticed the less the larger it is. These checks
//! ask physics alone, whatever the soil: how much torque a rover of a weight can put on the ground,
//! whether the wheels' work lifts the rover, whether odometry and wheels, angles and their rates,
//! can be of one rover. Each looks both ways. Limits are wide: a fault that they find is no matter
//! of degree.

use super::archive::{Archive, items, numbers};
use super::by_record::ByRecord;
use super::motion::{NotUsed, steady_attitude};
use super::straight_line::StraightLine;
use super::stretch::{GAP, Reading, Stretch};
use crate::elementary::wide::{cos, hypot, ln, sin};
use crate::vehicle::Rover;
use grouser_io::measurements::telemetry::TelemetryRecord;

/// A gross fault of telemetry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrossFault {
    /// What it is a fault of.
    pub suspect: Suspect,
    /// What was read over what can be [-]: negative where the sign is another.
    pub factor: f64,
}

/// What a gross fault is a fault of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Suspect {
    /// Odometry that is that of wheels: it shows no slip.
    WheelOdometry,
    /// Torques, or currents.
    Torque,
    /// The way by odometry over that of the rims.
    Speed,
    /// Roll and pitch.
    Attitude,
    /// Roll and pitch that stay exactly the same: no sensor measures them.
    StillAttitude,
    /// The rotation by odometry over the change of yaw.
    Turning,
    /// Sinkages.
    Sinkage,
    /// The way to the side, or the roll: a rover drifts downhill.
    Drift,
    /// Ways that do not grow with the time since the last one: some are lost.
    LostWays,
}

/// One radian [°], and one turn in a minute [rad/s], the other way round.
const DEGREES: f64 = 180.0 / std::f64::consts::PI;
const TURNS_PER_MINUTE: f64 = 30.0 / std::f64::consts::PI;
/// Millimetres, and centimetres, of a metre.
const MM: f64 = 1000.0;
const CM: f64 = 100.0;

/// Factors with what makes them.
type Units = &'static [(f64, &'static str)];

const ANGLES: Units =
    &[(DEGREES, "degrees taken for radians"), (1.0 / DEGREES, "radians taken for degrees")];

impl Suspect {
    /// All of them, each with one word and the factors that it is known by.
    pub(super) const ALL: [(&'static str, Self, Units); 9] = [
        ("wheel-odometry", Self::WheelOdometry, &[]),
        (
            "torque",
            Self::Torque,
            &[
                (1000.0, "N·mm, or mA, taken for N·m, or A"),
                (100.0, "N·cm taken for N·m"),
                (1e-3, "N·m, or A, taken for N·mm, or mA"),
            ],
        ),
        (
            "speed",
            Self::Speed,
            &[
                (MM, "ways in mm taken for m"),
                (CM, "ways in cm taken for m"),
                (1.0 / MM, "ways in m taken for mm"),
                (1.0 / TURNS_PER_MINUTE, "wheel speeds in rpm taken for rad/s"),
                (TURNS_PER_MINUTE, "wheel speeds in rad/s taken for rpm"),
                (1.0 / DEGREES, "wheel speeds in °/s taken for rad/s"),
                (DEGREES, "wheel speeds in rad/s taken for °/s"),
            ],
        ),
        ("attitude", Self::Attitude, ANGLES),
        ("still-attitude", Self::StillAttitude, &[]),
        ("turning", Self::Turning, ANGLES),
        ("sinkage", Self::Sinkage, &[(1000.0, "µm taken for mm"), (1e-3, "m taken for mm")]),
        ("drift", Self::Drift, &[]),
        ("lost-ways", Self::LostWays, &[]),
    ];

    /// One word.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.row().0
    }

    fn row(self) -> (&'static str, Self, Units) {
        Self::ALL[self as usize]
    }
}

impl GrossFault {
    /// The factor that is nearest, with what makes it; nothing where none is near.
    #[must_use]
    pub fn unit(&self) -> Option<(f64, &'static str)> {
        /// Soils, slopes and slips make the factor as uncertain as this, its logarithm [-].
        const NEAR: f64 = 1.1;
        let distance = |factor: f64| (ln(self.factor.max(f64::MIN_POSITIVE)) - ln(factor)).abs();
        let known = self.suspect.row().2.iter().copied();
        let nearest = known.min_by(|one, other| distance(one.0).total_cmp(&distance(other.0)));
        nearest.filter(|(factor, _)| distance(*factor) < NEAR)
    }

    /// Whether wheel speeds may be wrong, and with them the way that all readings are over: where
    /// ways and wheel speeds disagree, and it is no unit of ways.
    #[must_use]
    pub fn is_of_wheel_speeds(&self) -> bool {
        let is_of_ways = |(factor, _): (f64, _)| [MM, CM, 1.0 / MM].contains(&factor);
        self.suspect == Suspect::Speed && !self.unit().is_some_and(is_of_ways)
    }

    /// Leaves out of a stretch what the fault is of.
    fn leave_out(&self, stretch: &mut Stretch) {
        if self.is_of_wheel_speeds() {
            stretch.torques.fill(None);
            stretch.currents.fill(None);
            stretch.sinkages.fill(None);
        }
        match self.suspect {
            Suspect::WheelOdometry | Suspect::Speed | Suspect::Drift | Suspect::LostWays => {
                (stretch.velocity, stretch.yaw_rate) = ([None; 2], None);
            }
            Suspect::Turning => stretch.yaw_rate = None,
            Suspect::Torque => {
                stretch.torques.fill(None);
                stretch.currents.fill(None);
            }
            Suspect::Attitude | Suspect::StillAttitude => stretch.attitude = None,
            Suspect::Sinkage => stretch.sinkages.fill(None),
        }
    }
}

/// Looks at stretches for gross faults.
#[derive(Clone, Debug, Default)]
pub(in crate::studies) struct GrossFaults {
    found: Vec<GrossFault>,
    /// Thrust over the weight over the sine of the slope along the way, by stretches.
    pull: StraightLine,
    /// The change of yaw over the rotation by odometry between stretches [rad].
    turn: StraightLine,
    sums: SumsOfPairs,
    /// Middle of the last stretch [s], its yaw and yaw rate [rad, rad/s].
    last: Option<[f64; 3]>,
    records: ByRecord,
}

/// SumsOfPairs over the rims' way of what was read, in multiples of weight, radius and rim speed.
#[derive(Clone, Copy, Debug, Default)]
struct SumsOfPairs {
    /// Sine of the slope, of all that has an attitude.
    slope: RunningMean,
    /// Size of the thrust, and of the sine of the slope along the way, of all that has torques.
    thrust: RunningMean,
    along: RunningMean,
    /// The same where it does not go downhill: with its sign, and its size.
    driving: RunningMean,
    driving_size: RunningMean,
    /// Work of the wheels, and that against the slope, where it goes uphill.
    work: RunningMean,
    lift: RunningMean,
    /// Way by odometry over that of the rims, with the sign of the way forward, and its square; to
    /// the left, its size.
    forward: RunningMean,
    forward_squared: RunningMean,
    leftward: RunningMean,
    /// The slope along the way there, its square, and that across it, its size.
    along_there: RunningMean,
    along_squared: RunningMean,
    across: RunningMean,
    /// Where it does not go downhill there.
    loaded: RunningMean,
    /// The way uphill across the slope over that of the rims, of wheels that are not steered.
    uphill: RunningMean,
    /// Sinkage over the radius of the wheel.
    sinkage: RunningMean,
}

/// A mean over the way.
#[derive(Clone, Copy, Debug, Default)]
struct RunningMean {
    way: f64,
    sum: f64,
}

impl RunningMean {
    fn add(&mut self, way: f64, value: f64) {
        self.way += way;
        self.sum += way * value;
    }

    /// The mean; nothing over less than a way [m].
    fn over(self, least: f64) -> Option<f64> {
        (self.way >= least).then(|| self.sum / self.way)
    }
}

/// So much of the rims' way is looked at before anything is said [m].
const WAY: f64 = 0.3;
/// Thrusts over the weight that no wheel on soil exceeds, or rolls with less than: even on hard
/// ground rolling takes a hundredth [-]. Source: ours.
const THRUST: [f64; 2] = [0.004, 2.0];
/// What rolling takes on the mean of soils, over the weight [-].
const ROLLING: f64 = 0.1;
/// Slopes on which no rover drives, as sines [-]: 43°.
const STEEPEST: f64 = 0.68;
/// More than this across the way makes a rover drift downhill, unless its wheels are steered by more
/// than an angle [rad]: 3° and 2° [-].
const ACROSS: f64 = 0.05;
const STRAIGHT_ON: f64 = 0.035;
/// Less than this along the way is level [-].
const LEVEL: f64 = 0.02;

impl GrossFaults {
    /// Looks at a stretch; what was found with it that was not found before.
    ///
    /// * `gravity`: [m/s²]
    pub(in crate::studies) fn look(
        &mut self,
        stretch: &Stretch,
        rover: &Rover,
        gravity: f64,
    ) -> Vec<GrossFault> {
        self.add(stretch, rover, gravity);
        let all = [
            self.attitude(),
            self.torque(),
            self.speed(),
            self.wheel_odometry(rover),
            self.turning(),
            self.sinkage(),
            self.drift(),
            self.lost_ways(),
            self.still_attitude(),
        ];
        let mut new = Vec::new();
        for fault in all.into_iter().flatten() {
            match self.found.iter_mut().find(|known| known.suspect == fault.suspect) {
                Some(known) => known.factor = fault.factor,
                None => new.push(fault),
            }
        }
        self.found.extend(&new);
        new
    }

    /// Looks at a record, before it is part of a stretch.
    pub(in crate::studies) fn read(&mut self, record: &TelemetryRecord) {
        self.records.read(record);
    }

    /// What was found.
    pub(in crate::studies) fn found(&self) -> &[GrossFault] {
        &self.found
    }

    /// Leaves out of a stretch what was found to be wrong.
    pub(in crate::studies) fn leave_out(&self, stretch: &mut Stretch) {
        self.found.iter().for_each(|it| it.leave_out(stretch));
    }

    fn add(&mut self, stretch: &Stretch, rover: &Rover, gravity: f64) {
        let attitude = match steady_attitude(stretch) {
            Ok(attitude) => Some(attitude),
            Err(NotUsed::NoAttitude) => None,
            Err(_) => return,
        };
        let rims = &stretch.rim_speeds;
        let rim = rims.iter().sum::<f64>() / rims.len() as f64;
        let [slope, yaw] = attitude.unwrap_or_default();
        let along = rim.signum() * sin(slope) * sin(yaw);
        let (way, sums) = (stretch.way, &mut self.sums);
        if attitude.is_some() {
            sums.slope.add(way, sin(slope));
        }
        let forward = stretch.velocity[0].map(|it| it.value / rim);
        if let Some(thrust) = thrust(stretch, rover, rim.signum() * rover.mass() * gravity) {
            sums.torques(way, thrust, along, forward);
            if attitude.is_some() {
                self.pull.add(along, thrust[0]);
            }
        }
        if let Some(forward) = forward {
            let leftward = stretch.velocity[1].map_or(0.0, |it| it.value / rim);
            let moved = [forward.signum() * hypot(forward, leftward), leftward];
            sums.odometry(way, moved, [along, sin(slope) * cos(yaw)]);
        }
        let is_straight = stretch.steering.iter().flatten().all(|it| it.abs() < STRAIGHT_ON);
        if let (Some(leftward), true) = (stretch.velocity[1], is_straight) {
            let across = sin(slope) * cos(yaw);
            if across.abs() > ACROSS {
                sums.uphill.add(way, across.signum() * leftward.value / rim.abs());
            }
        }
        let mounts = rover.mounts().iter().zip(&stretch.sinkages);
        for (mount, sinkage) in mounts {
            if let Some(sinkage) = sinkage {
                sums.sinkage.add(way, sinkage.value / mount.shearing_radius());
            }
        }
        self.turned(stretch, attitude);
    }

    /// Compares the rotation by odometry with the change of yaw since the last stretch.
    fn turned(&mut self, stretch: &Stretch, attitude: Option<[f64; 2]>) {
        // On level ground roll and pitch are noise, and so is the yaw that follows from them.
        let slope_tells = attitude.filter(|it| it[0] > LEVEL);
        let yaw = stretch.reported_yaw.or(slope_tells.map(|it| it[1]));
        let now = yaw
            .zip(stretch.yaw_rate)
            .map(|(yaw, rate)| [0.5 * (stretch.time[0] + stretch.time[1]), yaw, rate.value]);
        let span = stretch.time[1] - stretch.time[0];
        if let (Some([then, from, before]), Some([time, to, rate])) = (self.last, now)
            // Over a gap a rover may have turned unseen.
            && time - then <= span + GAP
        {
            // Turns of the whole circle do not count.
            let turned = (to - from + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU);
            let rotation = 0.5 * (before + rate) * (time - then);
            self.turn.add(rotation, turned - std::f64::consts::PI);
        }
        self.last = now;
    }

    fn attitude(&self) -> Option<GrossFault> {
        let fault = |factor| Some(GrossFault { suspect: Suspect::Attitude, factor });
        if self.sums.slope.over(WAY).is_some_and(|it| it > STEEPEST) {
            return fault(DEGREES);
        }
        /// Thrust, and slopes, that move by less than this tell nothing of each other [-].
        const MOVES: f64 = 0.02;
        /// The thrust rises by the weight for each sine of the slope, and by somewhat more where the
        /// wheels sink: by less than this [-].
        const STEEP: f64 = 8.0;
        self.sums.thrust.over(WAY).filter(|it| is_of_soil(*it))?;
        let rise = self.pull.rise(MOVES)?;
        // Angles that are 57 times as large have to be slopes on which rovers drive; one of roll and
        // pitch may be right.
        let along = self.pull.size_of_x();
        if rise > STEEP && along * DEGREES < STEEPEST {
            return fault(1.0 / rise);
        }
        (rise < -0.5 && self.pull.moves(MOVES))
            .then_some(GrossFault { suspect: Suspect::Attitude, factor: -1.0 })
    }

    fn torque(&self) -> Option<GrossFault> {
        let fault = |factor| Some(GrossFault { suspect: Suspect::Torque, factor });
        let SumsOfPairs { thrust, along, driving, driving_size, work, lift, .. } = self.sums;
        let needed = ROLLING + along.over(0.0).unwrap_or(0.0).abs();
        let size = thrust.over(WAY)?;
        if size > THRUST[1] {
            return fault(size / needed);
        }
        let (signed, size) = (driving.over(WAY)?, driving_size.over(WAY)?);
        if size < THRUST[0] && size > 0.0 {
            return fault(size / needed);
        }
        if signed < -0.5 * size {
            return fault(-1.0);
        }
        // The wheels' work lifts the rover, and more.
        let (work, lift) = (work.over(WAY)?, lift.over(WAY)?);
        let is_odometry_wrong = self.speed().is_some();
        (work > 0.0 && work < 0.5 * lift && !is_odometry_wrong)
            .then_some(GrossFault { suspect: Suspect::Torque, factor: work / lift })
    }

    fn speed(&self) -> Option<GrossFault> {
        /// No rover is so much faster than its rims [-].
        const FASTEST: f64 = 1.6;
        /// Nor does one go backward so fast against its wheels [-].
        const BACKWARD: f64 = -0.3;
        /// A rover may slip as much as this leaves; one that goes on so, by the same share, over a
        /// way of the rims [m] does not [-].
        const SLOWEST: f64 = 0.13;
        const LONG: f64 = 3.0;
        /// The same of one that hardly comes forward.
        const STANDS: f64 = 0.02;
        const SHORTER: f64 = 1.0;
        const SAME: f64 = 0.15;
        let SumsOfPairs { forward, forward_squared, along_there, .. } = self.sums;
        // Rims that are read too slow have less way than the ground.
        let least = if forward.sum >= WAY { 0.0 } else { WAY };
        let (mean, along) = (forward.over(least)?, along_there.over(least)?);
        let scatter = (forward_squared.over(least)? - mean * mean).max(0.0).sqrt();
        let long = if mean < STANDS { SHORTER } else { LONG };
        let is_gentle = along.abs() < 0.12;
        let is_fault = (mean > FASTEST && along > -0.2)
            || (mean < BACKWARD && is_gentle)
            || (mean > 0.0
                && mean < SLOWEST
                && is_gentle
                && forward.way >= long
                && scatter < SAME * mean);
        is_fault.then_some(GrossFault { suspect: Suspect::Speed, factor: mean })
    }

    /// Whether odometry has neither slip along nor across, whatever the slope and the torques are.
    fn wheel_odometry(&self, rover: &Rover) -> Option<GrossFault> {
        const LONG: f64 = 0.5;
        /// The way scatters by less than this around a share of the rims' [-], and that across is
        /// less than this of it.
        const SAME: f64 = 3e-3;
        const NONE: f64 = 5e-4;
        /// What is the way of the wheels' radius to this needs no more than that it goes nearly
        /// straight on: the frame of the odometry may be turned [-].
        const EXACT: f64 = 1e-3;
        const STRAIGHT: f64 = 0.05;
        /// A share that is a radius for another [-].
        const RADII: [f64; 2] = [0.8, 1.25];
        /// Slopes that make slip, along and across, as sines [-]: 3°.
        const SLOPES: f64 = 0.05;
        let sums = &self.sums;
        let mean = sums.forward.over(LONG)?;
        let scatter = (sums.forward_squared.over(LONG)? - mean * mean).max(0.0).sqrt();
        let along = sums.along_there.over(LONG)?;
        let varies =
            (sums.along_squared.over(LONG)? - along * along).max(0.0).sqrt() > 0.5 * SLOPES;
        let goes_across = sums.across.over(LONG)? > SLOPES;
        let of_radius = |it: f64| (mean - it).abs() < EXACT;
        let smooth = rover.mounts().first().map(|it| it.unit.wheel.radius / it.shearing_radius());
        let leftward = sums.leftward.over(LONG)?;
        let is_of_radius = of_radius(1.0) || smooth.is_some_and(of_radius);
        let is_exact = is_of_radius && scatter < EXACT && leftward < STRAIGHT;
        let is_share = (RADII[0]..RADII[1]).contains(&mean);
        let is_same = is_share && scatter < SAME && leftward < NONE;
        // Wheels that drive slip, on level ground, too; downhill there is a slope on which they do
        // not.
        let is_driven = sums.loaded.way > 0.9 * sums.forward.way;
        let is_loaded = is_driven && sums.driving_size.over(0.0).is_some_and(|it| it > 0.01);
        ((is_same && (varies || goes_across)) || (is_exact && is_loaded))
            .then_some(GrossFault { suspect: Suspect::WheelOdometry, factor: mean })
    }

    fn turning(&self) -> Option<GrossFault> {
        /// Changes of yaw between stretches that tell something, on the root of the mean square
        /// [rad].
        const TURNS: f64 = 0.005;
        /// Sensors of one rover agree better than this [-].
        const APART: f64 = 8.0;
        let rise = self.turn.rise(TURNS)?;
        let is_fault = rise.abs() > APART || rise.abs() < 1.0 / APART || rise < -0.5;
        is_fault.then_some(GrossFault { suspect: Suspect::Turning, factor: 1.0 / rise })
    }

    fn drift(&self) -> Option<GrossFault> {
        /// A mounting of 2° makes less [-].
        const UPHILL: f64 = 0.04;
        let is_fault = self.sums.uphill.over(WAY)? > UPHILL;
        is_fault.then_some(GrossFault { suspect: Suspect::Drift, factor: -1.0 })
    }

    fn lost_ways(&self) -> Option<GrossFault> {
        let factor = self.records.share_of_ways()?;
        Some(GrossFault { suspect: Suspect::LostWays, factor })
    }

    fn still_attitude(&self) -> Option<GrossFault> {
        let fault = GrossFault { suspect: Suspect::StillAttitude, factor: 0.0 };
        self.records.is_attitude_still().then_some(fault)
    }

    fn sinkage(&self) -> Option<GrossFault> {
        /// Sinkages over the radius that a wheel rolls with [-].
        const SINKAGES: [f64; 2] = [5e-4, 1.0];
        /// The same on the mean of soils [-].
        const USUAL: f64 = 0.1;
        let mean = self.sums.sinkage.over(WAY)?;
        let is_fault = mean > SINKAGES[1] || (mean > 0.0 && mean < SINKAGES[0]);
        is_fault.then_some(GrossFault { suspect: Suspect::Sinkage, factor: mean / USUAL })
    }

    /// Writes or reads what it has seen.
    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { found, pull, turn, sums, last, records } = self;
        let blank = || GrossFault { suspect: Suspect::Torque, factor: 1.0 };
        items(archive, "found", found, blank, GrossFault::walk);
        pull.walk("pull", archive);
        turn.walk("turn", archive);
        archive.group("sums");
        for (name, mean) in sums.all() {
            archive.number(&format!("{name}_way"), &mut mean.way);
            archive.number(name, &mut mean.sum);
        }
        archive.end();
        let mut of_last = last.map(|it| it.to_vec()).unwrap_or_default();
        numbers(archive, "last", &mut of_last);
        *last = of_last.try_into().ok();
        records.walk(archive);
    }
}

impl SumsOfPairs {
    /// * `thrust`: with its sign and its size, over the weight [-]
    /// * `along`: sine of the slope along the way
    /// * `forward`: way by odometry over that of the rims
    fn torques(&mut self, way: f64, thrust: [f64; 2], along: f64, forward: Option<f64>) {
        let [thrust, size] = thrust;
        self.thrust.add(way, size);
        self.along.add(way, along);
        if along > -LEVEL {
            self.driving.add(way, thrust);
            self.driving_size.add(way, size);
        }
        if let Some(forward) = forward.filter(|_| along > LEVEL) {
            self.work.add(way, thrust);
            self.lift.add(way, along * forward);
        }
    }

    /// * `moved`: way by odometry over that of the rims, with the sign of the way forward, and that
    ///   to the left
    /// * `slope`: its sine along the way and across it
    fn odometry(&mut self, way: f64, moved: [f64; 2], slope: [f64; 2]) {
        let [[forward, leftward], [along, across]] = [moved, slope];
        self.forward.add(way, forward);
        self.forward_squared.add(way, forward * forward);
        self.leftward.add(way, leftward.abs());
        self.along_there.add(way, along);
        self.along_squared.add(way, along * along);
        self.across.add(way, across.abs());
        if along > -0.01 {
            self.loaded.add(way, 1.0);
        }
    }

    fn all(&mut self) -> [(&'static str, &mut RunningMean); 16] {
        let Self {
            slope,
            thrust,
            along,
            driving,
            driving_size,
            work,
            lift,
            forward,
            forward_squared,
            leftward,
            along_there,
            along_squared,
            across,
            loaded,
            uphill,
            sinkage,
        } = self;
        [
            ("slope", slope),
            ("thrust", thrust),
            ("along", along),
            ("driving", driving),
            ("driving_size", driving_size),
            ("work", work),
            ("lift", lift),
            ("forward", forward),
            ("forward_squared", forward_squared),
            ("leftward", leftward),
            ("along_there", along_there),
            ("along_squared", along_squared),
            ("across", across),
            ("loaded", loaded),
            ("uphill", uphill),
            ("sinkage", sinkage),
        ]
    }
}

impl GrossFault {
    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let mut name = self.suspect.name().to_owned();
        archive.word("suspect", &mut name);
        match Suspect::ALL.into_iter().find(|(known, ..)| *known == name) {
            Some((_, suspect, _)) => self.suspect = suspect,
            None => archive.refuse("suspect"),
        }
        archive.number("factor", &mut self.factor);
    }
}

fn is_of_soil(thrust: f64) -> bool {
    (THRUST[0]..THRUST[1]).contains(&thrust)
}

/// The thrust that the torques of a stretch stand for, over the weight: with its sign along the way,
/// and its size. Wheels without a torque have the mean of the others.
///
/// * `weight`: [N], with the sign of the way along the body
fn thrust(stretch: &Stretch, rover: &Rover, weight: f64) -> Option<[f64; 2]> {
    let of_wheel = |(mount, torque): (&crate::vehicle::Mount, &Option<Reading>)| {
        Some(torque.as_ref()?.value / mount.shearing_radius() / weight)
    };
    let read: Vec<f64> = rover.mounts().iter().zip(&stretch.torques).filter_map(of_wheel).collect();
    let scale = rover.wheel_count() as f64 / read.len() as f64;
    let size: f64 = read.iter().map(|it| it.abs()).sum();
    (!read.is_empty()).then(|| [scale * read.iter().sum::<f64>(), scale * size])
}
