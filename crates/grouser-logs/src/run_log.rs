//! A log on its way: what is written when.

pub(crate) mod error;
pub(crate) mod frames;
mod numbers;
mod scene;
mod urdf;

use std::io::{self, Write};

use grouser::document::columns::mission::in_words;
use grouser::studies::mission::{DrivenLeg, DrivenMission};
use grouser::studies::validity::RoverOnSlope;
use grouser_core::contact::validity::Flag;
use grouser_core::mission::{BackOut, Leg};
use grouser_core::simulation::{Outcome, OutcomeKind, Record, Scenario, Severity, WheelRecord};
use grouser_core::terrain::{Footprint, Terrain as _};
use grouser_core::units::{Vec2, Vec3};
use grouser_draw::motion::{Follower, Pose};

use self::error::{LONGEST, LogError};
use self::frames::WheelName;
use self::numbers::Numbers;
use self::scene::{Forces, Ground, Path};
use crate::foxglove::{self, FrameTransforms, Level, SceneUpdate, Timestamp};
use crate::mcap::write::{ChannelId, Container, SchemaOf};
use crate::protobuf::message::{Message, Types};

/// How far a wheel may turn between two transforms [rad]: what turns by half a circle could turn
/// back as well.
const TURN: f64 = 1.0;
/// Transforms at most between two records.
const BETWEEN: f64 = 1000.0;

/// What is written where.
#[derive(Debug)]
struct Channels {
    transforms: ChannelId,
    ground: ChannelId,
    path: ChannelId,
    forces: ChannelId,
    rover: ChannelId,
    /// Channel of the battery, for a rover whose battery is known.
    battery: Option<ChannelId>,
    /// On ground with heights.
    standing: Option<ChannelId>,
    wheels: Vec<ChannelId>,
    events: ChannelId,
}

/// A log on its way; [the crate](crate) says what it has.
///
/// It is whole once it is [finished](Self::finish).
#[derive(Debug)]
pub struct Log<W> {
    out: Container<W>,
    to: Channels,
    scenario: Scenario,
    names: Vec<WheelName>,
    rover: Numbers<Record>,
    battery: Numbers<Record>,
    standing: Numbers<Record>,
    wheel: Numbers<WheelRecord>,
    follower: Follower,
    /// The last record's.
    pose: Option<Pose>,
    ground: Ground,
    path: Path,
    forces: Forces,
    /// Height of the ground where the run starts, where it has heights [m].
    base: Option<f64>,
    raised: Vec<Flag>,
}

impl<W: Write> Log<W> {
    /// A log with what does not change: the rover and the slope.
    ///
    /// * `title`: what was driven, a line
    /// * `scenario`: that of the run, or of the mission
    ///
    /// # Errors
    /// [`LogError`] if it cannot be written to.
    pub fn begin(out: W, title: &str, scenario: &Scenario) -> Result<Self, LogError> {
        let library = concat!("grouser ", env!("CARGO_PKG_VERSION"));
        let mut out = Container::begin(out, library)?;
        let about = [
            ("title", title),
            ("model", scenario.model.name()),
            ("time", "since the start of the run, which is 0 ns"),
        ];
        let about = about.map(|(key, value)| (key.to_owned(), value.to_owned()));
        out.metadata("grouser", &about)?;
        let rover = &scenario.rover;
        let names = WheelName::all(rover.mounts());
        let mut fixed = |topic, schema: &SchemaOf<'_>, message: &[u8]| -> io::Result<()> {
            let to = out.channel(topic, schema, &[]);
            out.message(to, 0, message)
        };
        let base = height_of_start(scenario);
        let ground = match scenario.ground.plane_slope() {
            Some(slope) => frames::slope_in_world(slope),
            None => frames::map_in_world(scenario.ground.start.push(base.unwrap_or(0.0))),
        };
        let transforms = FrameTransforms { transforms: vec![ground] };
        fixed("/tf_static", &schema::<FrameTransforms>(), &transforms.to_bytes())?;
        let text = urdf::of(title, rover, &names);
        let string = SchemaOf {
            name: "std_msgs/msg/String",
            encoding: "ros2msg",
            data: b"string data".into(),
            messages: "cdr",
        };
        fixed("/robot_description", &string, &cdr(&text))?;
        let likeness = scene::of_rover(rover, &names);
        fixed("/scene/rover", &schema::<SceneUpdate>(), &likeness.to_bytes())?;
        let (of_rover, of_wheel) = (numbers::of_rover(rover), numbers::of_wheel(rover));
        let of_battery = numbers::of_battery();
        let scene =
            |out: &mut Container<W>, topic| out.channel(topic, &schema::<SceneUpdate>(), &[]);
        let wheel = |name: &WheelName| {
            let mut about = of_wheel.described();
            about.push(("wheel".into(), name.own.clone()));
            out.channel(&format!("/wheels/{}", name.frame), &of_wheel.schema(), &about)
        };
        let wheels = names.iter().map(wheel).collect();
        let battery = rover
            .battery()
            .map(|_| out.channel("/rover/battery", &of_battery.schema(), &of_battery.described()));
        let of_standing = numbers::of_standing(rover);
        let standing = base.map(|_| {
            out.channel("/rover/standing", &of_standing.schema(), &of_standing.described())
        });
        let to = Channels {
            wheels,
            standing,
            battery,
            transforms: out.channel("/tf", &schema::<FrameTransforms>(), &[]),
            ground: scene(&mut out, "/scene/ground"),
            path: scene(&mut out, "/scene/path"),
            forces: scene(&mut out, "/scene/forces"),
            rover: out.channel("/rover", &of_rover.schema(), &of_rover.described()),
            events: out.channel("/events", &schema::<foxglove::Log>(), &[]),
        };
        Ok(Self {
            out,
            to,
            names,
            rover: of_rover,
            battery: of_battery,
            standing: of_standing,
            wheel: of_wheel,
            follower: Follower::new(rover),
            pose: None,
            ground: Ground::of(rover),
            path: Path::of(rover),
            forces: Forces::of(scenario),
            base,
            raised: Vec::new(),
            scenario: scenario.clone(),
        })
    }

    /// Adds records, which follow those that were added before.
    ///
    /// # Errors
    /// [`LogError`] if they do not, if a number is not finite, or if the log cannot be written to.
    pub fn append(&mut self, records: &[Record]) -> Result<(), LogError> {
        records.iter().try_for_each(|record| self.add(record))
    }

    /// Adds a message in words.
    ///
    /// * `time`: since the start of the run [s]
    /// * `from`: what it comes from, such as `leg 2`
    ///
    /// # Errors
    /// [`LogError`] if there is no such time, or if the log cannot be written to.
    pub fn event(
        &mut self,
        time: f64,
        level: Level,
        from: &str,
        text: &str,
    ) -> Result<(), LogError> {
        let time = nanoseconds(time)?;
        let message = foxglove::Log {
            timestamp: Timestamp::of(time),
            level,
            message: text.to_owned(),
            name: from.to_owned(),
            ..foxglove::Log::default()
        };
        Ok(self.out.message(self.to.events, time, &message.to_bytes())?)
    }

    /// Says what became of a run.
    ///
    /// * `time`: its end [s]
    ///
    /// # Errors
    /// The same as [`event`](Self::event).
    pub fn outcome(&mut self, time: f64, outcome: &Outcome) -> Result<(), LogError> {
        self.event(time, level_of(outcome.kind()), "run", &words(outcome))
    }

    /// Says that a leg of a mission begins.
    ///
    /// * `time`: [s]
    /// * `number`: of the leg, from 1
    ///
    /// # Errors
    /// The same as [`event`](Self::event).
    pub fn leg_began(&mut self, time: f64, number: usize, leg: &Leg) -> Result<(), LogError> {
        let origin = self.scenario.ground.start;
        let began = format!("began: {}", in_words(leg, origin));
        self.event(time, Level::Info, &leg_name(number), &began)
    }

    /// Says what became of a leg.
    ///
    /// * `time`: its end, without a way back out of it [s]
    ///
    /// # Errors
    /// The same as [`event`](Self::event).
    pub fn leg_ended(&mut self, time: f64, leg: &DrivenLeg) -> Result<(), LogError> {
        let report = &leg.report;
        let reason = leg.reason().map_or(String::new(), |reason| format!(": {reason}"));
        let (became, name) = (format!("{}{reason}", report.outcome.name()), leg_name(leg.number));
        let way =
            format!("{:.3} m in {:.1} s with {:.1} J", report.distance, report.time, report.energy);
        self.event(time, level_of(report.outcome.kind()), &name, &format!("{became}; {way}"))
    }

    /// Says what became of a way back out of a leg.
    ///
    /// * `time`: its end [s]
    /// * `number`: of the leg, from 1
    ///
    /// # Errors
    /// The same as [`event`](Self::event).
    pub fn backed_out(&mut self, time: f64, number: usize, back: &BackOut) -> Result<(), LogError> {
        let way = format!("backed out by {:.3} m in {:.1} s", back.distance, back.time);
        let kind = back.outcome.kind();
        let became = if kind.row().severity == Severity::Good {
            way
        } else {
            format!("{way}; {}", kind.name())
        };
        self.event(time, level_of(kind), &leg_name(number), &became)
    }

    /// Appends a mission that was driven: the records of each leg between what is said of it.
    ///
    /// # Errors
    /// The same as [`append`](Self::append).
    pub fn mission(&mut self, mission: &DrivenMission) -> Result<(), LogError> {
        let mut time = mission.report.trajectory.records.first().map_or(0.0, |first| first.time);
        let legs = mission.legs.iter().zip(mission.report.legs_with_records()).enumerate();
        for (place, (leg, (report, records))) in legs {
            self.leg_began(time, leg.number, &leg.leg)?;
            // Its first record is the last one of the leg before.
            let records = &records[usize::from(place > 0).min(records.len())..];
            time += report.time;
            let ended = nanoseconds(time)?;
            let on_leg = |record: &Record| nanoseconds(record.time).is_ok_and(|it| it <= ended);
            let (on_leg, later) = records.split_at(records.partition_point(on_leg));
            self.append(on_leg)?;
            self.leg_ended(time, leg)?;
            self.append(later)?;
            if let Some(back) = &report.back_out {
                time += back.time;
                self.backed_out(time, leg.number, back)?;
            }
        }
        self.event(time, Level::Info, "mission", &mission.report.kind().in_words())
    }

    /// Puts a file into the log, such as the document that determined the run.
    ///
    /// * `media_type`: what it is, such as `application/toml`
    ///
    /// # Errors
    /// [`LogError`] if the log cannot be written to.
    pub fn attach(&mut self, name: &str, media_type: &str, content: &[u8]) -> Result<(), LogError> {
        Ok(self.out.attach(name, media_type, content)?)
    }

    /// Writes the rest, and the index by which readers find all; what it was written to comes back.
    ///
    /// # Errors
    /// [`LogError`] if the log cannot be written to.
    pub fn finish(self) -> Result<W, LogError> {
        Ok(self.out.finish()?)
    }

    fn add(&mut self, record: &Record) -> Result<(), LogError> {
        let last = self.pose.as_ref().map_or(0.0, |pose| pose.time);
        if record.time < last {
            return Err(LogError::OutOfOrder { time: record.time, last });
        }
        // With these, all that follows is finite.
        let message = self.rover.message(record, "the rover", record.time)?;
        let time = nanoseconds(record.time)?;
        self.out.message(self.to.rover, time, &message)?;
        if let Some(to) = self.to.battery {
            let message = self.battery.message(record, "the battery", record.time)?;
            self.out.message(to, time, &message)?;
        }
        if let (Some(to), Some(_)) = (self.to.standing, record.standing()) {
            let message = self.standing.message(record, "the rover", record.time)?;
            self.out.message(to, time, &message)?;
        }
        for ((wheel, name), to) in record.wheels.iter().zip(&self.names).zip(&self.to.wheels) {
            let message = self.wheel.message(wheel, &name.own, record.time)?;
            self.out.message(*to, time, &message)?;
        }
        let pose = self.follower.pose(&self.scenario, record);
        self.add_transforms(&pose)?;
        self.add_scene(time, &pose)?;
        self.add_flags(record)?;
        self.pose = Some(pose);
        Ok(())
    }

    /// The transforms of a record, and of times before it, as many as the wheels' turning needs.
    fn add_transforms(&mut self, pose: &Pose) -> Result<(), LogError> {
        let mut poses = Vec::new();
        if let Some(last) = &self.pose {
            let turned = last.wheels.iter().zip(&pose.wheels);
            let turned = turned.map(|(a, b)| (b.turned - a.turned).abs()).fold(0.0, f64::max);
            let steps = (turned / TURN).ceil().min(BETWEEN);
            let between = |step: f64| last.time + (pose.time - last.time) * step / steps;
            let times = (1..).map(f64::from).take_while(|step| *step < steps).map(between);
            poses.extend(times.map(|time| last.between(pose, time)));
        }
        for pose in poses.iter().chain([pose]) {
            let time = nanoseconds(pose.time)?;
            let mounts = self.scenario.rover.mounts();
            let transforms = frames::of_rover(time, pose, mounts, &self.names, self.base);
            let message = FrameTransforms { transforms }.to_bytes();
            self.out.message(self.to.transforms, time, &message)?;
        }
        Ok(())
    }

    fn add_scene(&mut self, time: u64, pose: &Pose) -> Result<(), LogError> {
        if self.ground.grow(pose.centre.xy()) {
            let scene = match self.base {
                Some(base) => self.ground.relief(time, &self.scenario.ground, base),
                None => self.ground.scene(time),
            };
            self.out.message(self.to.ground, time, &scene.to_bytes())?;
        }
        let (place, frame) = match self.base {
            // The path is that of the body, which is seen over uneven ground.
            Some(base) => (pose.centre - Vec3::new(0.0, 0.0, base), frames::WORLD),
            None => (pose.centre.xy().push(0.0), frames::SLOPE),
        };
        if self.path.grow(place) {
            self.out.message(self.to.path, time, &self.path.scene(time, frame).to_bytes())?;
        }
        let mounts = self.scenario.rover.mounts();
        let forces = self.forces.scene(time, pose, mounts, &self.names);
        Ok(self.out.message(self.to.forces, time, &forces.to_bytes())?)
    }

    /// The flags that no record before has raised.
    fn add_flags(&mut self, record: &Record) -> Result<(), LogError> {
        for finding in RoverOnSlope::of(&self.scenario).at(record) {
            if !self.raised.contains(&finding.flag) {
                self.raised.push(finding.flag);
                let text = format!("{}: {}", finding.flag.name(), finding.flag.rule().meaning);
                self.event(record.time, Level::Warning, "validity", &text)?;
            }
        }
        Ok(())
    }
}

/// Height of the ground where a run starts, where it has heights [m].
fn height_of_start(scenario: &Scenario) -> Option<f64> {
    const POINT: f64 = 1e-3;
    let footprint = Footprint { forward: Vec2::x(), half_length: POINT, half_width: POINT };
    let ground = &scenario.ground;
    (!ground.is_plane()).then(|| ground.patch(Vec2::zeros(), footprint).height)
}

fn schema<M: Message>() -> SchemaOf<'static> {
    let data = Types::of::<M>();
    SchemaOf { name: M::NAME, encoding: "protobuf", data, messages: "protobuf" }
}

/// A text as ROS 2 encodes a message that holds nothing else: the byte order, and the count with a
/// final zero.
fn cdr(text: &str) -> Vec<u8> {
    let count = u32::try_from(text.len() + 1).unwrap_or(u32::MAX);
    let mut out = vec![0, 1, 0, 0];
    out.extend(count.to_le_bytes());
    out.extend(text.as_bytes());
    out.push(0);
    out
}

/// * `time`: [s]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
pub(crate) fn nanoseconds(time: f64) -> Result<u64, LogError> {
    if (0.0..=LONGEST).contains(&time) {
        Ok((time * foxglove::NANO as f64).round() as u64)
    } else {
        Err(LogError::NoTime { time })
    }
}

fn leg_name(number: usize) -> String {
    format!("leg {number}")
}

fn level_of(kind: OutcomeKind) -> Level {
    match kind.row().severity {
        Severity::Good => Level::Info,
        Severity::Stopped => Level::Warning,
        Severity::Stuck | Severity::Lost => Level::Error,
    }
}

/// An outcome with its reason.
fn words(outcome: &Outcome) -> String {
    let name = outcome.kind().in_words();
    outcome.reason().map_or(name.clone(), |reason| format!("{name}: {reason}"))
}
