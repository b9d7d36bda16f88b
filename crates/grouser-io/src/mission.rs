//! Missions as documents say them: legs with keys, each of which becomes a leg with a manoeuvre.

use super::columns::{
    CURRENT, DRIFT, ENERGY, PITCH, Quantity, ROLL, SINKAGE, SLIP_RATIO, TEMPERATURE, TIME, TORQUE,
    quantity,
};
use super::unit::{DEG, M, ONE};
use grouser_core::mission::{
    Heading, Leg, Limited, Manoeuvre, Measure, Mission, Sensors, Steering, Stop,
};
use grouser_core::simulation::Scenario;
use grouser_core::units::Vec2;
use grouser_core::vehicle::drive::{SlipLimit, SlipTarget};
use grouser_core::vehicle::{DriveLaw, PerWheel};

/// A mission as its document says it: the keys of its legs, in SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Rover, ground, model, and how the run is computed.
    pub scenario: Scenario,
    pub(crate) legs: Vec<LegKeys>,
    pub(crate) alternatives: Vec<Alternative>,
    pub(crate) stops: Vec<Stop>,
    pub(crate) sensors: Option<Sensors>,
}

/// One of several ways to drive a mission.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Alternative {
    pub name: String,
    pub legs: Vec<LegKeys>,
}

/// What documents and results call a number that is limited.
#[must_use]
pub const fn limited_quantity(limited: Limited) -> Quantity {
    match limited {
        Limited::SlipRatio => SLIP_RATIO,
        Limited::Drift => quantity("drift_m", M),
        Limited::DriftPerMetre => DRIFT,
        Limited::SinkageDepth => SINKAGE,
        Limited::Sinkage => quantity("sinkage_over_radius", ONE),
        Limited::Roll => ROLL,
        Limited::Pitch => PITCH,
        Limited::Torque => TORQUE,
        Limited::Time => TIME,
        Limited::Energy => ENERGY,
        Limited::OffPath => quantity("off_path_m", M),
        Limited::Current => CURRENT,
        Limited::Temperature => TEMPERATURE,
        Limited::Discharge => quantity("depth_of_discharge", ONE),
        Limited::Shortfall => quantity("shortfall_deg", DEG),
    }
}

/// The key under which the file of legs stands.
pub(crate) const LEGS_FROM: &str = "legs_from";
/// The key under which the file of limits stands.
pub(crate) const STOP_FROM: &str = "stop_from";

/// The keys of a leg that are given.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct LegKeys {
    pub drive: Option<f64>,
    pub by: Option<Measure>,
    pub turn: Option<f64>,
    pub arc: Option<Arc>,
    pub goto: Option<Waypoint>,
    pub wait: Option<f64>,
    pub reverse: bool,
    pub speed: Option<PerWheel>,
    pub law: Option<LegLaw>,
    pub yaw: Option<f64>,
    pub held: Option<Held>,
    pub crab: Option<f64>,
    pub steering: Option<Steering>,
    pub toward: Option<Waypoint>,
    pub look_ahead: Option<f64>,
    pub stops: Vec<Stop>,
}

/// A law that looks at the slip of wheels, with its slip ratio [-].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LegLaw {
    Eq18AsPrinted(f64),
    Eq18(f64),
    SlipLimiting(f64),
}

/// A way along a circle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Arc {
    pub radius: f64,
    pub angle: f64,
}

/// A place, and how near is near enough.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Waypoint {
    pub place: Vec2,
    pub within: f64,
}

/// What is held on the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Held {
    Hold,
    Contour,
    Toward,
    Crab,
}

impl Plan {
    /// The mission: the first of its alternatives, where it has some.
    #[must_use]
    pub fn mission(&self) -> Mission {
        let first = self.alternatives.first();
        self.mission_of(first.map_or(&self.legs, |alternative| &alternative.legs))
    }

    /// The mission, or its alternatives by their names, each a mission of its own from the same
    /// start.
    #[must_use]
    pub fn missions(&self) -> Vec<(String, Mission)> {
        if self.alternatives.is_empty() {
            return vec![(String::new(), self.mission())];
        }
        self.alternatives.iter().map(|it| (it.name.clone(), self.mission_of(&it.legs))).collect()
    }

    /// The mission of some legs, with the speed of each.
    pub(crate) fn mission_of(&self, legs: &[LegKeys]) -> Mission {
        let mut speed = None;
        let origin = self.scenario.ground.start;
        let legs = legs.iter().map(|keys| {
            speed = keys.speed.clone().or(speed.take());
            keys.leg(speed.as_ref(), origin)
        });
        Mission {
            scenario: self.scenario.clone(),
            legs: legs.collect(),
            stops: self.stops.clone(),
            sensors: self.sensors,
        }
    }

    /// All legs, with the keys under which they stand.
    pub(crate) fn all_legs(&self) -> Vec<(String, &[LegKeys])> {
        let each = self.alternatives.iter().enumerate();
        let each = each.map(|(place, it)| (format!("alternative.{place}.leg"), &*it.legs));
        std::iter::once(("leg".to_owned(), &*self.legs)).chain(each).collect()
    }
}

impl LegKeys {
    /// The manoeuvres that are given, with their keys: one, of a leg that is one.
    ///
    /// * `origin`: where the mission starts, in the coordinates of its places [m]
    pub(crate) fn manoeuvres(&self, origin: Vec2) -> Vec<(&'static str, Manoeuvre)> {
        let reverse = self.reverse;
        let drive = self.drive.map(|distance| {
            ("drive_m", Manoeuvre::Drive { distance, by: self.by.unwrap_or_default() })
        });
        let turn = self.turn.map(|angle| ("turn_deg", Manoeuvre::Turn { angle }));
        let arc = self
            .arc
            .map(|Arc { radius, angle }| ("arc", Manoeuvre::Arc { radius, angle, reverse }));
        let goto = self.goto.map(|Waypoint { place, within }| {
            ("goto", Manoeuvre::Goto { place: place - origin, within, reverse })
        });
        let wait = self.wait.map(|time| ("wait_s", Manoeuvre::Wait { time }));
        [drive, turn, arc, goto, wait].into_iter().flatten().collect()
    }

    /// The leg, of keys that go together.
    ///
    /// * `origin`: as in [`manoeuvres`](Self::manoeuvres)
    fn leg(&self, speed: Option<&PerWheel>, origin: Vec2) -> Leg {
        let manoeuvres = self.manoeuvres(origin);
        let manoeuvre = manoeuvres.first().map_or(Manoeuvre::Wait { time: 0.0 }, |(_, it)| *it);
        let usual = Leg::new(manoeuvre);
        let heading = match (self.held, self.toward) {
            (Some(Held::Hold), _) => Heading::Hold,
            (Some(Held::Contour), _) => Heading::Contour,
            (Some(Held::Toward), Some(to)) => Heading::Toward(to.place - origin),
            (Some(Held::Crab), _) => Heading::Crab { angle: self.crab.unwrap_or(0.0) },
            _ => Heading::Free,
        };
        Leg {
            drive: speed.map_or(usual.drive, |speed| self.drive_at(speed)),
            yaw: self.yaw,
            heading,
            steering: self.steering.unwrap_or_default(),
            stops: self.stops.clone(),
            look_ahead: self.look_ahead,
            ..usual
        }
    }

    /// What turns the wheels of a leg with this speed [m/s].
    fn drive_at(&self, speed: &PerWheel) -> DriveLaw {
        let target = |slip_ratio| SlipTarget { speed: speed.of(0), slip_ratio };
        match (self.law, speed) {
            (None, PerWheel::All(speed)) => DriveLaw::Constant(*speed),
            (None, PerWheel::Each(speeds)) => DriveLaw::ConstantEach(speeds.clone()),
            (Some(LegLaw::Eq18AsPrinted(slip_ratio)), _) => {
                DriveLaw::Eq18AsPrinted(target(slip_ratio))
            }
            (Some(LegLaw::Eq18(slip_ratio)), _) => DriveLaw::Eq18(target(slip_ratio)),
            (Some(LegLaw::SlipLimiting(slip_ratio)), _) => {
                DriveLaw::SlipLimiting(SlipLimit { speed: speed.clone(), slip_ratio })
            }
        }
    }

    /// What is wrong with it: the key, a sentence, and what to write instead.
    ///
    /// * `speed`: its own, or that of the leg before
    pub(crate) fn fault(
        &self,
        speed: Option<&PerWheel>,
    ) -> Option<(&'static str, String, &'static str)> {
        let given: Vec<&str> =
            self.manoeuvres(Vec2::zeros()).into_iter().map(|(key, _)| key).collect();
        let [manoeuvre] = given[..] else {
            let (key, what) = match given[..] {
                [] => ("", "says nothing to do".to_owned()),
                [one, other, ..] => (other, format!("has both `{one}` and `{other}`")),
                [_] => return None,
            };
            return Some((key, what, ONE_OF));
        };
        let only = |key: &'static str, with: &str, instead| {
            Some((
                key,
                format!("has `{key}` beside `{manoeuvre}`: it goes with {with} only"),
                instead,
            ))
        };
        let drives = manoeuvre == "drive_m";
        if self.by.is_some() && !drives {
            return only("by", "`drive_m`", "leave it out");
        }
        let crabs_to_place = self.held == Some(Held::Crab) && manoeuvre == "goto";
        if self.held.is_some() && !drives && !crabs_to_place {
            return only(
                "heading",
                "`drive_m`",
                "leave it out: turns, arcs and ways to places have their own",
            );
        }
        if self.crab.is_some() && self.held != Some(Held::Crab) {
            let what = "has an angle `crab_deg`, but not the heading \"crab\"".to_owned();
            return Some(("crab_deg", what, "write heading = \"crab\", or leave the angle out"));
        }
        if self.steering.is_some() && manoeuvre != "arc" {
            return only("steering", "`arc`", "leave it out; `drive_m` has the heading \"crab\"");
        }
        if self.reverse && !matches!(manoeuvre, "arc" | "goto") {
            return only("reverse", "`arc` and `goto`", "a `drive_m` below 0 is driven backward");
        }
        if self.law.is_some() && !matches!(manoeuvre, "drive_m" | "arc" | "goto") {
            return only("drive", "`drive_m`, `arc` and `goto`", "leave it out");
        }
        if let Some(PerWheel::All(speed)) = self.speed
            && speed <= 0.0
        {
            let what = format!("has `speed_m_s` = {speed}, which is not above 0");
            return Some(("speed_m_s", what, "a `drive_m` below 0 is driven backward"));
        }
        let is_eq18 = matches!(self.law, Some(LegLaw::Eq18(_) | LegLaw::Eq18AsPrinted(_)));
        if is_eq18 && matches!(speed, Some(PerWheel::Each(_))) {
            let what = "has Eq. 18 beside a list of speeds, its own or that of the leg before";
            let hint = "give the leg one `speed_m_s`, or leave `drive` out";
            return Some(("drive", what.to_owned(), hint));
        }
        match (self.held, self.toward) {
            (Some(Held::Toward), None) => {
                let what = "has the heading \"toward\", but no place `toward`".to_owned();
                Some(("heading", what, "write for instance toward = { x_m = 5.0, y_m = 1.0 }"))
            }
            (held, Some(_)) if held != Some(Held::Toward) => {
                let what = "has a place `toward`, but not the heading \"toward\"".to_owned();
                Some(("toward", what, "write heading = \"toward\", or leave the place out"))
            }
            _ => None,
        }
    }
}

const ONE_OF: &str = "a leg has exactly one of drive_m, turn_deg, arc, goto and wait_s";
