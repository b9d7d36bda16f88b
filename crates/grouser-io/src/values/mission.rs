//! Missions: that their legs can be driven.

use super::super::describe::mission::{self, MISSION};
use super::super::document::Document;
use super::super::error::{DocumentError, Problem};
use super::super::field::Inner;
use super::super::given_file::NamedFiles;
use super::super::legs_file;
use super::super::mission::{LegKeys, Plan, limited_quantity};
use super::super::stop_file;
use super::super::terrain_file;
use super::super::tree::Node;
use super::super::unit::DEG;
use super::{Described, Misfit};
use grouser_core::mission::{Limited, Manoeuvre, Mission, PlanError, Stop, Then, Where};
use grouser_core::terrain::{Ground, Shape};
use grouser_core::units::Vec2;
use grouser_core::vehicle::{Mount, Rover};

/// Checks that alternatives have names of their own, and stand in place of legs.
fn check_alternatives(plan: &Plan) -> Result<(), Misfit> {
    let names: Vec<&str> = plan.alternatives.iter().map(|it| &*it.name).collect();
    for (place, name) in names.iter().enumerate() {
        if names[..place].contains(name) {
            let key = format!("alternative.{place}.name");
            let name = name.escape_debug().to_string();
            return Err(Misfit::new(key.clone(), Problem::RepeatedName { key, name }));
        }
    }
    if !names.is_empty() && !plan.legs.is_empty() {
        let problem = Problem::Conflict("the mission has legs beside its alternatives");
        let hint = "legs that all alternatives have stand in each of them";
        return Err(Misfit::new("leg", problem).with_hint(hint));
    }
    Ok(())
}

/// Checks that limits at which the rover backs out state how far.
///
/// * `within`: the table of the limits, with a dot after it
pub(crate) fn check_stops(stops: &[Stop], within: &str) -> Result<(), Misfit> {
    let Some(stop) = stops.iter().find(|stop| stop.then == Then::BackOut(0.0)) else {
        return Ok(());
    };
    let path = format!("{within}stop.{}.then", limited_quantity(stop.limited).name);
    let problem =
        Problem::Conflict("`then` is \"back-out\", but `back_out_m` does not say how far");
    Err(Misfit::new(path, problem).with_hint("write for instance back_out_m = 0.5 beside it"))
}

/// Checks that the quantities that limits stop at are known of a rover.
///
/// * `within`: the table of the limits, with a dot after it
fn check_known(stops: &[Stop], within: &str, rover: &Rover) -> Result<(), Misfit> {
    let winding = |mount: &Mount| mount.unit.motor.is_some_and(|motor| motor.winding.is_some());
    let lacks = |limited: Limited| match limited {
        Limited::Current if !rover.has_motors() => Some((
            "this limits the current of motors, but the rover has no [motor]",
            "add [motor] to the rover's document, or leave the limit out",
        )),
        Limited::Temperature if !rover.mounts().iter().any(winding) => Some((
            "this limits how warm motors become, but no motor of the rover has a [motor.winding]",
            "add [motor] with [motor.winding] to the rover's document, or leave the limit out",
        )),
        Limited::Discharge if rover.battery().is_none() => Some((
            "this limits what is taken from the battery, but the rover has no [battery]",
            "add [motor] and [battery] to the rover's document, or leave the limit out",
        )),
        _ => None,
    };
    let found = stops.iter().find_map(|stop| Some((stop.limited, lacks(stop.limited)?)));
    let Some((limited, (what, hint))) = found else { return Ok(()) };
    let path = format!("{within}stop.{}", limited_quantity(limited).name);
    Err(Misfit::new(path, Problem::Conflict(what)).with_hint(hint))
}

/// What is wrong with limits of a leg's own: one on a number that its manoeuvre never has.
fn unknown_in(leg: &LegKeys) -> Option<(Limited, String)> {
    let (manoeuvre, _) = *leg.manoeuvres(Vec2::zeros()).first()?;
    let is_unknown = |limited: &Limited| match limited.row().known {
        Where::Everywhere => false,
        Where::Drives | Where::Ways => matches!(manoeuvre, "turn_deg" | "wait_s"),
        Where::Ends => !matches!(manoeuvre, "turn_deg" | "arc"),
    };
    let limited = leg.stops.iter().map(|stop| stop.limited).find(is_unknown)?;
    let name = limited_quantity(limited).name;
    Some((limited, format!("limits `{name}`, which has no value in a leg of `{manoeuvre}`")))
}

/// Checks that legs can be driven.
///
/// * `within`: the key under which they stand
/// * `rover`: that drives them
fn check_legs(legs: &[LegKeys], within: &str, rover: &Rover) -> Result<(), Misfit> {
    let mut speed = None;
    for (place, leg) in legs.iter().enumerate() {
        speed = leg.speed.as_ref().or(speed);
        if let Some((key, what, hint)) = leg.fault(speed) {
            let problem = Problem::Leg { number: place + 1, what };
            return Err(Misfit::new(format!("{within}.{place}.{key}"), problem).with_hint(hint));
        }
        let of_leg = format!("{within}.{place}.");
        if let Some((limited, what)) = unknown_in(leg) {
            let path = format!("{of_leg}stop.{}", limited_quantity(limited).name);
            let problem = Problem::Leg { number: place + 1, what };
            return Err(Misfit::new(path, problem).with_hint("leave the limit out"));
        }
        check_stops(&leg.stops, &of_leg)?;
        check_known(&leg.stops, &of_leg, rover)?;
        let angle = leg.crab.unwrap_or(0.0);
        let is_beyond =
            |mount: &&Mount| mount.steering_axis.is_some_and(|axis| angle.abs() > axis.limit);
        if let Some(mount) = rover.mounts().iter().find(is_beyond) {
            let limit = DEG.as_given(mount.steering_axis.map_or(0.0, |axis| axis.limit));
            let what = format!(
                "has `crab_deg` = {}, but wheel `{}` turns up to {limit}° to either side",
                DEG.as_given(angle),
                mount.name
            );
            let problem = Problem::Leg { number: place + 1, what };
            return Err(Misfit::new(format!("{within}.{place}.crab_deg"), problem));
        }
    }
    Ok(())
}

/// Checks that the places of a mission are on its map.
///
/// * `within`: the key under which its legs stand
fn check_places(mission: &Mission, ground: &Ground, within: &str) -> Result<(), Misfit> {
    let Shape::Map(map) = &ground.shape else { return check_distances(mission, within) };
    let on_map = |at: Vec2| terrain_file::contains(map.extent(), at);
    for (number, leg) in mission.legs.iter().enumerate() {
        let Manoeuvre::Goto { place, .. } = leg.manoeuvre else { continue };
        let place = place + ground.start;
        if on_map(place) {
            continue;
        }
        let what = format!("goes to x {} m, y {} m, beyond the map", place.x, place.y);
        let problem = Problem::Leg { number: number + 1, what };
        let mut hint = terrain_file::spans(map.extent());
        if on_map(Vec2::new(place.y, place.x)) {
            hint += ": x and y are exchanged?";
        }
        return Err(Misfit::new(format!("{within}.{number}.goto"), problem).with_hint(hint));
    }
    Ok(())
}

/// Checks that the places of a mission without a map are no coordinates of one.
///
/// * `within`: the key under which its legs stand
fn check_distances(mission: &Mission, within: &str) -> Result<(), Misfit> {
    /// No rover drives so far in a mission [m].
    const FARTHEST: f64 = 1e5;
    for (number, leg) in mission.legs.iter().enumerate() {
        let Manoeuvre::Goto { place, .. } = leg.manoeuvre else { continue };
        if place.norm() <= FARTHEST {
            continue;
        }
        let kilometres = (1e-3 * place.norm()).round();
        let what = format!("goes to x {} m, y {} m, {kilometres} km away", place.x, place.y);
        let problem = Problem::Leg { number: number + 1, what };
        let hint = "places are from where the mission starts; those of a map need the map";
        return Err(Misfit::new(format!("{within}.{number}.goto"), problem).with_hint(hint));
    }
    Ok(())
}

/// Checks that a mission is possible.
///
/// * `within`: the key under which its legs stand
fn check_mission(mission: &Mission, within: &str) -> Result<(), Misfit> {
    mission.check().map_err(|PlanError { leg, source }| match leg {
        0 if mission.legs.is_empty() => {
            let problem = Problem::Conflict("the mission has no legs");
            let hint = "each leg is a table [[leg]]; `legs_from` names a file with legs";
            Misfit::new(within, problem).with_hint(hint)
        }
        0 => Misfit::new(within, source),
        number => {
            let what = format!("cannot be driven: {source}");
            Misfit::new(format!("{within}.{}", number - 1), Problem::Leg { number, what })
        }
    })
}

impl Described for Plan {
    fn table() -> &'static dyn Inner<Self> {
        &MISSION
    }

    fn blank() -> Self {
        mission::blank()
    }

    fn follow(&mut self, document: &Document) {
        self.scenario.follow(document);
    }

    fn fetch(&mut self, document: &Document, tree: &Node) -> Result<NamedFiles, DocumentError> {
        let mut files = self.scenario.fetch(document, tree)?;
        files.given.extend(legs_file::given(tree).into_iter().chain(stop_file::given(tree)));
        files.notes.extend(legs_file::notes(tree));
        Ok(files)
    }

    fn check_without(&self, path: &str, number: f64) -> Result<(), Misfit> {
        self.scenario.check_without(path, number)
    }

    fn settled(self) -> Result<Self, Misfit> {
        let plan = Self { scenario: self.scenario.settled()?, ..self };
        check_stops(&plan.stops, "")?;
        check_known(&plan.stops, "", &plan.scenario.rover)?;
        check_alternatives(&plan)?;
        for (within, legs) in plan.all_legs() {
            check_legs(legs, &within, &plan.scenario.rover)?;
            check_places(&plan.mission_of(legs), &plan.scenario.ground, &within)?;
            if plan.alternatives.is_empty() || within != "leg" {
                check_mission(&plan.mission_of(legs), &within)?;
            }
        }
        Ok(plan)
    }
}
