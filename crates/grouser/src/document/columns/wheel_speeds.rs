//! Contour traverses with wheels that turn alike, and with speeds of their own.

use super::super::table::Table;
use super::super::unit::{ONE, PER_M};
use super::flags::{self, FLAGS};
use super::heading::{LIMIT_REASON, LIMITED_BY, YAW_MOMENT, steepest};
use super::{
    Column, ENERGY_PER_METRE, LIMIT_SLOPE, OK, SINKAGE, SLIP_RATIO, SLOPE, STATUS, TORQUE, YAW,
    number, quantity, text,
};
use crate::contact::validity::Finding;
use crate::studies::heading::{HeadingOffset, NoHeading};
use crate::studies::wheel_speeds::{SpeedFreedom, StraightMotion, WheelSpeeds};
use crate::vehicle::Rover;

/// Which wheels have a speed in common.
pub const WHEELS: &str = "wheels";
/// All of them.
pub const ALIKE: &str = "alike";
/// How fast an error of the yaw grows.
pub const YAW_GROWTH: super::Quantity = quantity("yaw_growth_per_m", PER_M);
/// Where no straight motion was found.
pub const NONE_FOUND: &str = "no speeds were found that hold the contour";

/// A rover that holds the contour, or does not.
#[derive(Clone, Debug)]
pub struct Crossing<'a> {
    slope: f64,
    wheels: &'static str,
    rover: &'a Rover,
    found: Found,
    findings: Vec<Finding>,
}

#[derive(Clone, Debug)]
enum Found {
    Alike(Result<HeadingOffset, NoHeading>),
    Own(Option<StraightMotion>),
}

impl Crossing<'_> {
    /// A number of whichever it is.
    fn number(
        &self,
        alike: impl Fn(&HeadingOffset) -> f64,
        own: impl Fn(&StraightMotion) -> f64,
    ) -> Option<f64> {
        match &self.found {
            Found::Alike(found) => found.as_ref().ok().map(alike),
            Found::Own(found) => found.as_ref().map(own),
        }
    }

    /// Rim speeds over the rover's [-].
    fn speed_ratios(&self) -> Option<Vec<f64>> {
        match &self.found {
            Found::Alike(found) => {
                let ratio = found.as_ref().ok()?.speed_ratio();
                Some(vec![ratio; self.rover.wheel_count()])
            }
            Found::Own(found) => found.as_ref().map(|motion| motion.speed_ratios.clone()),
        }
    }

    fn status(&self) -> String {
        match &self.found {
            Found::Alike(found) => found.as_ref().map_or_else(ToString::to_string, |_| OK.into()),
            Found::Own(found) => found.as_ref().map_or(NONE_FOUND, |_| OK).into(),
        }
    }
}

const fn settings<'a>() -> [Column<Crossing<'a>>; 2] {
    [
        SLOPE.given("Slopes", |it| Some(it.slope)),
        text(
            WHEELS,
            "Which wheels have a speed in common: `alike`, all; `by-side`, those of a side; \
             `by-wheel`, none; `uphill-reversed`, none, and those of the uphill side turn backward \
             or stand",
            |it| Some(it.wheels.into()),
        ),
    ]
}

/// What is found on a slope.
#[must_use]
pub const fn results<'a>() -> [Column<Crossing<'a>>; 7] {
    [
        YAW.maybe("Yaw that holds the contour, positive uphill", |it| {
            it.number(|alike| alike.yaw, |own| own.yaw)
        }),
        SLIP_RATIO.maybe("Mean slip ratio of the wheels", |it| {
            it.number(|alike| alike.slip_ratio, StraightMotion::slip_ratio)
        }),
        SINKAGE.maybe("Mean sinkage of the wheels", |it| {
            it.number(HeadingOffset::mean_sinkage, StraightMotion::mean_sinkage)
        }),
        TORQUE.maybe("Torque of all wheels together", |it| {
            it.number(HeadingOffset::torque, StraightMotion::torque)
        }),
        ENERGY_PER_METRE.maybe(
            "Work of the motors per metre along the contour; a wheel that is dragged gives nothing \
             back",
            |it| it.number(|alike| alike.energy_per_metre(it.rover), |own| own.energy_per_metre),
        ),
        YAW_MOMENT.maybe(
            "Yaw moment left over; negative turns the nose downhill. Wheels at speeds of their own \
             leave none",
            |it| it.number(|alike| alike.yaw_moment, |_| 0.0),
        ),
        YAW_GROWTH.maybe(
            "How fast a small error of the yaw grows over the way, of a motion that is steady; \
             negative where it fades",
            |it| match &it.found {
                Found::Alike(_) => None,
                Found::Own(own) => own.as_ref().map(|own| own.yaw_growth),
            },
        ),
    ]
}

const fn limit<'a>() -> [Column<Crossing<'a>>; 1] {
    [LIMIT_SLOPE.maybe("The steepest slope on which the contour is held", |it| {
        it.number(|alike| alike.slope, |own| own.slope)
    })]
}

/// A wheel's speed: a column for each, with its name before.
pub const SPEED_RATIO: [Column<f64>; 1] =
    [number("speed_ratio", ONE, "Rim speed over the rover's speed; negative backward", |it| *it)];

const fn status<'a>() -> [Column<Crossing<'a>>; 2] {
    [
        text(STATUS, "`ok`, or why the contour is not held", |it| Some(it.status())),
        flags::flags(|it| flags::names(&it.findings)),
    ]
}

/// The flags on each slope [rad], of all motions there.
#[must_use]
pub fn findings(found: &WheelSpeeds, slopes: &[f64]) -> Vec<Vec<Finding>> {
    crossings(found, slopes).into_iter().map(|crossing| crossing.findings).collect()
}

/// Rows for each slope [rad]: of wheels that turn alike, of sides and of wheels with speeds of
/// their own.
#[must_use]
pub fn table(found: &WheelSpeeds, slopes: &[f64]) -> Table {
    of_crossings(&crossings(found, slopes))
}

/// The steepest slopes: a row for each freedom, and what is driven there.
#[must_use]
pub fn limits(found: &WheelSpeeds) -> Table {
    let curve = found.curve();
    let alike = curve.limit().and_then(|(slope, _)| curve.at(slope));
    let mut crossings = vec![crossing(found, ALIKE, 0.0, Found::Alike(alike))];
    crossings.extend(
        SpeedFreedom::ALL.map(|freedom| {
            crossing(found, freedom.name(), 0.0, Found::Own(found.steepest(freedom)))
        }),
    );
    let all: Vec<Option<&Crossing<'_>>> = crossings.iter().map(Some).collect();
    let [_, wheels] = settings();
    let table = Table::default().and(&[wheels], &all).and(&limit(), &all).and(&results(), &all);
    let table = and_speeds(table, &crossings);
    let of_curve = steepest(curve);
    const REASONS: [Column<Reason>; 2] = [
        text(LIMIT_REASON, "What ends the slopes there", |it| it.0.clone()),
        text(LIMITED_BY, "The same in a word, of wheels that turn alike", |it| it.1.clone()),
    ];
    type Reason = (Option<String>, Option<String>);
    let of = |name: &str| of_curve.texts(name)[0].clone();
    let reasons: Vec<Reason> = crossings
        .iter()
        .map(|crossing| match &crossing.found {
            Found::Alike(_) => (of(LIMIT_REASON), of(LIMITED_BY)),
            Found::Own(Some(_)) => (Some("the steepest that the search found".into()), None),
            Found::Own(None) => (Some(NONE_FOUND.into()), None),
        })
        .collect();
    table.and(&REASONS, &reasons.iter().map(Some).collect::<Vec<_>>())
}

fn crossings<'a>(found: &'a WheelSpeeds, slopes: &[f64]) -> Vec<Crossing<'a>> {
    let on_slope = |slope: &f64| {
        let own = [SpeedFreedom::BySide, SpeedFreedom::ByWheel]
            .map(|freedom| (freedom.name(), Found::Own(found.least_energy(freedom, *slope))));
        let alike = (ALIKE, Found::Alike(found.curve().at(*slope)));
        let all = [alike].into_iter().chain(own);
        all.map(|(name, motion)| crossing(found, name, *slope, motion)).collect::<Vec<_>>()
    };
    slopes.iter().flat_map(on_slope).collect()
}

fn crossing<'a>(
    of: &'a WheelSpeeds,
    wheels: &'static str,
    slope: f64,
    found: Found,
) -> Crossing<'a> {
    let findings = match &found {
        Found::Alike(alike) => of.curve().findings(slope, alike),
        Found::Own(own) => of.findings(slope, own.as_ref()),
    };
    Crossing { slope, wheels, rover: of.rover(), found, findings }
}

fn of_crossings(crossings: &[Crossing<'_>]) -> Table {
    let all: Vec<Option<&Crossing<'_>>> = crossings.iter().map(Some).collect();
    let table = Table::default().and(&settings(), &all).and(&results(), &all);
    and_speeds(table, crossings).and(&status(), &all)
}

/// A column for each wheel.
fn and_speeds(mut table: Table, crossings: &[Crossing<'_>]) -> Table {
    let ratios: Vec<Option<Vec<f64>>> = crossings.iter().map(Crossing::speed_ratios).collect();
    let Some(first) = crossings.first() else { return table };
    for (wheel, mount) in first.rover.mounts().iter().enumerate() {
        let of_wheel: Vec<Option<&f64>> =
            ratios.iter().map(|all| all.as_ref().map(|all| &all[wheel])).collect();
        table = table.and_named(&format!("{}.", mount.name), &SPEED_RATIO, &of_wheel);
    }
    table
}

/// The columns of [`table`] for reading.
#[must_use]
pub fn brief(rover: &Rover) -> Vec<String> {
    let first =
        [SLOPE.name, WHEELS, YAW.name, ENERGY_PER_METRE.name, YAW_MOMENT.name, YAW_GROWTH.name];
    let speeds =
        rover.mounts().iter().map(|mount| format!("{}.{}", mount.name, SPEED_RATIO[0].name));
    first
        .map(String::from)
        .into_iter()
        .chain(speeds)
        .chain([STATUS, FLAGS].map(String::from))
        .collect()
}
