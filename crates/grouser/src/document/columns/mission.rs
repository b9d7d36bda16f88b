//! A mission: a row for each leg that was begun, and the whole of it.

use serde::ser::{Serialize, SerializeMap, Serializer};

use super::super::limited_quantity;
use super::super::table::{Table, WithObject};
use super::super::unit::{DEG, M};
use super::completion::RISK;
use super::run::{BATTERY_ENERGY, DISTANCE, END, METHOD, STANDING, STATE_OF_CHARGE};
use super::verdict::{ADVICE, ADVICE_OBJECT};
use super::{
    CURRENT, Column, ENERGY, Quantity, SLIP_RATIO, TEMPERATURE, TIME, X, Y, YAW, maybe, quantity,
    text, whole,
};
use crate::mission::{
    Cause, FellShort, Heading, Kind, Leg, LegOutcome, Limited, Manoeuvre, Measure, Steering, Stop,
    Stopped, Taken,
};
use crate::studies::completion::Completion;
use crate::studies::mission::{DrivenLeg, DrivenMission};
use crate::studies::verdict::Advice;
use crate::units::Vec2;

impl DrivenMission {
    /// What became of its legs: a row for each that was begun.
    #[must_use]
    pub fn table(&self) -> Table {
        let electrical = electrical(&ELECTRICAL_LEG, &self.legs, |leg| leg.report.taken);
        Table::of(&LEG, &self.legs).and(electrical, &self.legs.iter().map(Some).collect::<Vec<_>>())
    }

    /// Alternatives, each a row.
    #[must_use]
    pub fn alternatives(ways: &[Self]) -> Table {
        let electrical = electrical(&ELECTRICAL_MISSION, ways, |way| way.report.taken());
        Table::of(&MISSION, ways).and(electrical, &ways.iter().map(Some).collect::<Vec<_>>())
    }
}

impl DrivenLeg {
    /// Why it did not end as it says, in a sentence; none if it did.
    #[must_use]
    pub fn reason(&self) -> Option<String> {
        match &self.report.outcome {
            LegOutcome::Completed => None,
            LegOutcome::Stopped(stopped) => Some(why_stopped(stopped)),
            LegOutcome::FellShort(short) => Some(why_short(short)),
            LegOutcome::Ended(outcome) => outcome.reason(),
        }
    }
}

/// A mission among its alternatives.
pub const MISSION: [Column<DrivenMission>; 10] = [
    text(ALTERNATIVE, "The way that was driven", |it| Some(it.name.clone())),
    text(
        OUTCOME,
        "What became of the last leg that was begun, by its name in the table of outcomes",
        |it| Some(it.report.outcome().to_owned()),
    ),
    whole("legs_completed", "Legs that ended as they say", |it| {
        let completed = |leg: &&DrivenLeg| leg.report.outcome.is_completed();
        Some(it.legs.iter().filter(completed).count())
    }),
    whole("legs_planned", "Legs of the plan", |it| Some(it.planned)),
    DISTANCE.number("Way over the ground of drives, arcs and ways to places", |it| {
        it.ways().map(|leg| leg.distance).sum()
    }),
    SLIP_RATIO.maybe("Largest slip ratio of a leg", |it| {
        it.ways().filter_map(|leg| leg.slip_ratio).reduce(f64::max)
    }),
    TIME.number("Time at the end", |it| it.report.last().time),
    X.number("Along the contour, at the end", |it| it.report.last().place().x),
    Y.number("Uphill, at the end", |it| it.report.last().place().y),
    ENERGY.number("Work of the motors", |it| it.report.energy()),
];

/// What motors and battery took over a mission, of a rover whose motors are known: beside
/// [`MISSION`].
pub const ELECTRICAL_MISSION: [Column<DrivenMission>; 4] = [
    BATTERY_ENERGY
        .maybe("Electrical energy that motors, and with a battery the electronics, took", |it| {
            Some(it.report.taken()?.energy)
        }),
    CURRENT.maybe("Largest current of a motor", |it| Some(it.report.taken()?.current)),
    TEMPERATURE
        .maybe("Highest temperature of a motor's winding", |it| it.report.taken()?.temperature),
    STATE_OF_CHARGE
        .maybe("State of charge of the battery at the end", |it| it.report.taken()?.charge),
];

/// What motors and battery took over a leg, of a rover whose motors are known: beside [`LEG`].
pub const ELECTRICAL_LEG: [Column<DrivenLeg>; 4] = [
    BATTERY_ENERGY.maybe(
        "Electrical energy that motors, and with a battery the electronics, took, with the turn \
         before it",
        |it| Some(it.report.taken?.energy),
    ),
    CURRENT.maybe("Largest current of a motor, with the turn before it", |it| {
        Some(it.report.taken?.current)
    }),
    TEMPERATURE.maybe("Highest temperature of a motor's winding, with the turn before it", |it| {
        it.report.taken?.temperature
    }),
    STATE_OF_CHARGE
        .maybe("State of charge of the battery where it ended", |it| it.report.taken?.charge),
];

/// Those of four columns of motors and battery that some row has: all of what is known of the
/// rover.
fn electrical<R>(
    columns: &'static [Column<R>; 4],
    rows: &[R],
    taken: fn(&R) -> Option<Taken>,
) -> impl Iterator<Item = &'static Column<R>> {
    let first = rows.iter().find_map(taken);
    let is_known = [
        first.is_some(),
        first.is_some(),
        first.is_some_and(|taken| taken.temperature.is_some()),
        first.is_some_and(|taken| taken.charge.is_some()),
    ];
    columns.iter().zip(is_known).filter_map(|(column, is_known)| is_known.then_some(column))
}

/// What became of a mission or of a leg.
pub(in super::super) const OUTCOME: &str = "outcome";
/// Yaw that a leg turned.
pub const TURNED: Quantity = quantity("yaw_turned_deg", DEG);
/// What stopped a leg.
pub(in super::super) const STOPPED_BY: &str = "stopped_by";
/// The name of an alternative.
const ALTERNATIVE: &str = "alternative";

/// A leg.
pub const LEG: [Column<DrivenLeg>; 17] = [
    whole("leg", "Number of the leg, from 1", |it| Some(it.number)),
    text("manoeuvre", "What the leg says, in a few words", |it| Some(in_words(&it.leg, it.origin))),
    text(OUTCOME, "What became of it, by its name in the table of outcomes", |it| {
        Some(it.report.outcome.name().into())
    }),
    DISTANCE.number(
        "Way over the ground; a turn to the yaw of the leg before it does not count",
        |it| it.report.distance,
    ),
    TIME.number("How long it took, with the turn before it", |it| it.report.time),
    ENERGY.number("Work of the motors, with the turn before it", |it| it.report.energy),
    SLIP_RATIO.maybe(
        "1 less the way over the ground by that of the rims; of drives, arcs and ways to places",
        |it| it.report.slip_ratio,
    ),
    TURNED
        .maybe("Yaw that an arc or a turn on the spot really turned, positive to the left", |it| {
            it.report.turned
        }),
    maybe("radius_m", M, "Radius of an arc as driven: the way over the ground by the turn", |it| {
        it.report.radius()
    }),
    text(
        STOPPED_BY,
        "The limit that stopped it, by its key, or what would have become of it",
        |it| stopped(it).map(|it| stopped_by(it).to_owned()),
    ),
    text(
        "stopped_kind",
        "`command`, `reactive`, or `predictive` for what was simulated ahead",
        |it| stopped(it).map(|it| it.kind.name().to_owned()),
    ),
    text("reason", "Why it did not end as it says", DrivenLeg::reason),
    X.number("Along the contour, where it ended, of the body's centre of mass", |it| {
        it.origin.x + it.report.end.position.x
    }),
    Y.number("Uphill, where it ended", |it| it.origin.y + it.report.end.position.y),
    YAW.number("Yaw where it ended, positive where the nose points uphill", |it| it.report.end.yaw),
    maybe("back_out_m", M, "How far it drove back out of the leg", |it| {
        Some(it.report.back_out.as_ref()?.distance)
    }),
    text("back_out", "What became of that", |it| {
        Some(it.report.back_out.as_ref()?.outcome.name().to_owned())
    }),
];

/// What a campaign keeps of a mission beside its end: way and slip ratio, and energy; electrical
/// energy and largest current, too, of a rover whose motors are known.
pub(in super::super) fn kept(
    has_motors: bool,
) -> impl Iterator<Item = &'static Column<DrivenMission>> {
    static ALL: [Column<DrivenMission>; 10] = MISSION;
    static TAKEN: [Column<DrivenMission>; 4] = ELECTRICAL_MISSION;
    let names = [DISTANCE.name, SLIP_RATIO.name, ENERGY.name];
    let kept = ALL.iter().filter(move |column| names.contains(&column.name));
    kept.chain(TAKEN.split_at(OF_MOTORS).0.iter().filter(move |_| has_motors))
}

/// So many columns of motors and battery are known of every rover with motors.
const OF_MOTORS: usize = 2;

/// What a campaign keeps of each leg: outcome, way, time, energy, slip ratio, and what stopped it;
/// electrical energy and largest current, too, of a rover whose motors are known.
pub(in super::super) fn kept_of_leg(
    has_motors: bool,
) -> impl Iterator<Item = &'static Column<DrivenLeg>> {
    static ALL: [Column<DrivenLeg>; 17] = LEG;
    static TAKEN: [Column<DrivenLeg>; 4] = ELECTRICAL_LEG;
    let names = [OUTCOME, DISTANCE.name, TIME.name, ENERGY.name, SLIP_RATIO.name, STOPPED_BY];
    let kept = ALL.iter().filter(move |column| names.contains(&column.name));
    kept.chain(TAKEN.split_at(OF_MOTORS).0.iter().filter(move |_| has_motors))
}

/// The columns of a table of missions for reading: those of [`MISSION`], and of motors and battery
/// where it has them.
#[must_use]
pub fn missions_brief(missions: &Table) -> Vec<String> {
    let electrical = ELECTRICAL_MISSION.iter().map(|column| column.name);
    those_of(missions, MISSION.iter().map(|column| column.name).chain(electrical))
}

/// The columns of a table of legs for reading; of motors and battery where it has them.
#[must_use]
pub fn legs_brief(legs: &Table) -> Vec<String> {
    let names = [
        "leg",
        "manoeuvre",
        OUTCOME,
        DISTANCE.name,
        TIME.name,
        ENERGY.name,
        BATTERY_ENERGY.name,
        CURRENT.name,
        TEMPERATURE.name,
        STATE_OF_CHARGE.name,
        SLIP_RATIO.name,
        TURNED.name,
        X.name,
        Y.name,
        YAW.name,
    ];
    those_of(legs, names.into_iter())
}

/// The names that a table has.
fn those_of(table: &Table, names: impl Iterator<Item = &'static str>) -> Vec<String> {
    let is_there = |name: &&str| table.columns.iter().any(|(there, _)| there == name);
    names.filter(is_there).map(str::to_owned).collect()
}

/// A mission as one object of JSON: `outcome`, `energy_j`, what motors and battery took where that
/// is known, `final`, and its `legs`.
#[derive(Clone, Copy, Debug)]
pub struct MissionObject<'a> {
    /// The mission.
    pub mission: &'a DrivenMission,
    /// What it risks, and what to do on each leg that was begun, if that was asked for.
    pub believed: Option<(&'a Completion, &'a [Option<Advice>])>,
}

impl Serialize for MissionObject<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let DrivenMission { name, report, .. } = self.mission;
        let last = [Some(report.last())];
        let standing = STANDING.iter().filter(|_| report.last().origin.is_some());
        let end = Table::default().and(END, &last).and(standing, &last);
        let mut map = serializer.serialize_map(None)?;
        if !name.is_empty() {
            map.serialize_entry(ALTERNATIVE, name)?;
        }
        map.serialize_entry(OUTCOME, report.outcome())?;
        if let Some((risk, _)) = self.believed {
            RISK.iter().try_for_each(|column| column.write(&mut map, risk))?;
        }
        map.serialize_entry(ENERGY.name, &report.energy())?;
        let ways = std::slice::from_ref(self.mission);
        electrical(&ELECTRICAL_MISSION, ways, |way| way.report.taken())
            .try_for_each(|column| column.write(&mut map, self.mission))?;
        METHOD.iter().try_for_each(|column| column.write(&mut map, &report.trajectory))?;
        map.serialize_entry("final", &end.row(0))?;
        let legs = self.mission.table();
        match self.believed {
            Some((_, advice)) => {
                let advice: Vec<_> = advice.iter().map(Option::as_ref).collect();
                let advice = Table::default().and(&ADVICE, &advice);
                let legs = WithObject { rows: &legs, name: ADVICE_OBJECT, of: &advice };
                map.serialize_entry("legs", &legs)?;
            }
            None => map.serialize_entry("legs", &legs)?,
        }
        map.end()
    }
}

fn stopped(leg: &DrivenLeg) -> Option<&Stopped> {
    leg.report.outcome.stopped()
}

/// What stopped a rover: the limit by its key, or what would have become of it.
#[must_use]
pub fn stopped_by(stopped: &Stopped) -> &'static str {
    match &stopped.cause {
        Cause::Limit { stop, .. } => limited_quantity(stop.limited).name,
        Cause::Outcome(outcome) => outcome.name(),
    }
}

/// Why a rover stopped: `slip ratio 0.42 over 1 m after 3.70 m`.
#[must_use]
pub fn why_stopped(stopped: &Stopped) -> String {
    let ahead = if stopped.kind == Kind::Predictive { "ahead " } else { "" };
    let cause = match &stopped.cause {
        Cause::Limit { stop, value } => passed(stop, *value),
        Cause::Outcome(outcome) => outcome.kind().in_words(),
    };
    format!("{ahead}{cause} after {:.2} m", stopped.after)
}

/// How far a turn or an arc fell short:
/// `turned 37.6° of 90°, 52.4° short: its yaw stands still, after 1.57 m`.
#[must_use]
pub fn why_short(short: &FellShort) -> String {
    let deg = |angle: f64| DEG.from_si(angle);
    format!(
        "turned {:.1}° of {:.1}°, {:.1}° short: {}, after {:.2} m",
        deg(short.turned),
        deg(short.asked),
        deg(short.shortfall()),
        short.because.meaning(),
        short.stopped.after,
    )
}

/// The number that passed a limit, with so many digits that it is seen to have done so.
fn passed(stop: &Stop, value: f64) -> String {
    if stop.limited == Limited::Time {
        return format!("not done within {:.0} s,", stop.above);
    }
    let quantity = limited_quantity(stop.limited);
    let [value, above] = [value, stop.above].map(|it| quantity.unit.from_si(it));
    let is_above = |shown: String| shown.parse::<f64>().is_ok_and(|shown| shown > above);
    let digits = (2..6).find(|digits| is_above(format!("{value:.digits$}"))).unwrap_or(6);
    let unit = match quantity.unit.symbol {
        "-" => String::new(),
        "°" => "°".to_owned(),
        symbol => format!(" {symbol}"),
    };
    let over =
        if stop.limited.is_of_a_way() { format!(" over {} m", stop.over) } else { String::new() };
    format!("{} {value:.digits$}{unit}{over}", quantity.label())
}

/// A coordinate that was written as it stands and is kept as seen from an origin [m].
fn as_written(seen: f64, origin: f64) -> f64 {
    /// What the difference and the sum of two coordinates may change [1/m].
    const STEPS: f64 = 1e6;
    if origin == 0.0 { seen } else { ((origin + seen) * STEPS).round() / STEPS }
}

/// What a leg says: `drive 2 m on the contour`.
///
/// * `origin`: where its mission starts, in the coordinates of its places [m]
#[must_use]
pub fn in_words(leg: &Leg, origin: Vec2) -> String {
    let deg = |angle: f64| format!("{}°", YAW.unit.as_given(angle));
    let side = |angle: f64| if angle < 0.0 { "right" } else { "left" };
    let on_map = |place: Vec2| {
        let [x, y] = [0, 1].map(|axis| as_written(place[axis], origin[axis]));
        format!("{x}, {y}")
    };
    let back = |reverse: bool| if reverse { " backward" } else { "" };
    let what = match leg.manoeuvre {
        Manoeuvre::Drive { distance, by } => {
            let by = if by == Measure::Odometry { " by odometry" } else { "" };
            format!("drive {distance} m{by}")
        }
        Manoeuvre::Turn { angle } => format!("turn {} {}", deg(angle.abs()), side(angle)),
        Manoeuvre::Arc { radius, angle, reverse } => {
            let steered = if leg.steering == Steering::Ackermann { ", wheels steered" } else { "" };
            let (angle, side) = (deg(angle.abs()), side(angle));
            format!("arc {angle} {side}, radius {radius} m{}{steered}", back(reverse))
        }
        Manoeuvre::Goto { place, reverse, .. } => {
            format!("go to {} m{}", on_map(place), back(reverse))
        }
        Manoeuvre::Wait { time } => format!("wait {time} s"),
    };
    let held = match leg.heading {
        Heading::Free => String::new(),
        Heading::Hold => ", yaw held".to_owned(),
        Heading::Contour => ", on the contour".to_owned(),
        Heading::Toward(place) => format!(", toward {} m", on_map(place)),
        Heading::Crab { .. } => ", wheels crab".to_owned(),
    };
    let yaw = leg.yaw.map_or(String::new(), |yaw| format!(", from yaw {}", deg(yaw)));
    what + &yaw + &held
}
