//! Prints digests of ten thousand wheels, a traverse, a mission and an operator's card: all that
//! computes them, whatever its language, its processor and its instructions, has to print the same.
//! `cargo xtask hashes` compares them.
//!
//! `hashes` computes by the instructions that the processor has, `hashes SET` by others: it prints
//! nothing where the processor lacks them. `hashes tables` has a digest for each column of the tables
//! of results, in the units of documents, as the program and the Python package show them.

use std::error::Error;

use grouser::answers::Sampling;
use grouser::contact::{
    Contact, InstructionSet, Ishigami, Model, SettleError, Settled, Slip, settle_many,
};
use grouser::document::columns::{card, card_courses, run, wheel_test};
use grouser::document::table::{Table, Values};
use grouser::document::{Kind, Overrides, Source, fnv_1a, read_mission, read_scenario};
use grouser::mission::MissionRun;
use grouser::paper;
use grouser::simulation::{Run, WheelRecord};
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::mission::DrivenMission;
use grouser::studies::verdict::SlopeStudy;
use grouser::studies::wheel_test::WheelTest;
use grouser::units::{EARTH_GRAVITY, deg};
use grouser::vehicle::RoverState;

fn main() -> Result<(), Box<dyn Error>> {
    let model = match std::env::args().nth(1).as_deref() {
        None => Model::Ishigami,
        Some("tables") => return show_tables(),
        Some(name) => {
            let set = InstructionSet::ALL.into_iter().find(|set| set.name() == name);
            let set = set.ok_or("which instructions? baseline, avx2 or avx512")?;
            if !set.is_available() {
                return Ok(());
            }
            Model::own(Ishigami::DEFAULT.on(set))
        }
    };
    show("wheels", wheels(&model));
    show("traverse", traverse(&model)?);
    show("mission", mission(&model)?);
    if matches!(model, Model::Ishigami) {
        // Its samples choose models by name, and these their instructions.
        let tables = card_tables()?.into_iter();
        show("card", tables.flat_map(|(_, table)| table.columns).flat_map(|(_, it)| numbers(it)));
    }
    Ok(())
}

fn show(name: &str, numbers: impl IntoIterator<Item = f64>) {
    println!("{name} {:016x}", digest(numbers));
}

fn digest(numbers: impl IntoIterator<Item = f64>) -> u64 {
    fnv_1a(numbers.into_iter().flat_map(f64::to_le_bytes))
}

fn show_tables() -> Result<(), Box<dyn Error>> {
    let mut tables = vec![("wheel-test", wheel_table()), ("traverse", traverse_table()?)];
    tables.push(("mission", mission_table()?));
    tables.extend(card_tables()?);
    for (answer, table) in tables {
        for (name, values) in table.columns {
            let numbers = numbers(values);
            if numbers.iter().any(|number| !number.is_nan()) {
                show(&format!("{answer}.{name}"), numbers);
            }
        }
    }
    Ok(())
}

/// The numbers of a column, with the one NaN where there is none; nothing of words.
fn numbers(values: Values) -> Vec<f64> {
    let or_nan = |number: Option<f64>| number.unwrap_or(f64::from_bits(0x7ff8 << 48));
    match values {
        Values::Float(numbers) => numbers.into_iter().map(or_nan).collect(),
        Values::Whole(counts) => {
            counts.into_iter().map(|it| or_nan(it.map(|it| it as f64))).collect()
        }
        Values::Text(_) | Values::Words(_) => Vec::new(),
    }
}

/// Settings that `crates/grouser-python/tests/hashes.py` has as well.
fn wheel_table() -> Table {
    let test = WheelTest {
        wheel: paper::hakuto_wheel(),
        soil: paper::toyoura(),
        gravity: EARTH_GRAVITY,
        model: Model::Ishigami,
        loads: (1..=10).map(|k| 2.5 * f64::from(k)).collect(),
        slip_angles: (-12..=12).map(|k| deg(2.5 * f64::from(k))).collect(),
        slip_ratios: (-20..20).map(|k| 0.03125 * f64::from(k)).collect(),
    };
    wheel_test::table(&test.run())
}

fn traverse_table() -> Result<Table, Box<dyn Error>> {
    let scenario = read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
    Ok(run::table(&Run::new(&scenario)?.to_end()?, &scenario))
}

fn mission_table() -> Result<Table, Box<dyn Error>> {
    let source = Source::find(Kind::Mission, "there-and-back")?;
    let mission = read_mission(&source, &Overrides::none())?.value.mission();
    Ok(DrivenMission::drive("", &mission)?.table())
}

/// The card of slopes to 20°, on samples of a soil that is uncertain, and its other courses.
fn card_tables() -> Result<[(&'static str, Table); 2], Box<dyn Error>> {
    let overrides = Overrides::parse(["scenario.soil=toyoura-uncertain"])?;
    let scenario = read_scenario(&Source::default_scenario(), &overrides)?;
    let samples = Sampling { count: 12, seed: 4 }.draw(&BandInputs::of_scenario(&scenario))?;
    let slopes: Vec<f64> = (0..=20).map(|slope| deg(f64::from(slope))).collect();
    let study = SlopeStudy::of(&scenario);
    let whole = "nobody stops it";
    let card = study.card(&samples, &slopes, &|| true)?.ok_or(whole)?;
    let courses = study.courses(&card.rows, &samples, &|| true)?.ok_or(whole)?;
    Ok([("card", card::table(&card)), ("courses", card_courses::table(&courses))])
}

fn wheels(model: &Model) -> Vec<f64> {
    let (wheel, soil, gravity) = (paper::hakuto_wheel(), paper::toyoura(), EARTH_GRAVITY);
    let loaded = |k: i32| {
        let ratio = 0.015_625 * f64::from(k / 100 % 100 - 50);
        let slip = Slip::on_test_stand(ratio, 0.031_25 * f64::from(k % 37 - 18));
        (Contact { wheel, soil, slip, gravity }, 2.0 + 0.25 * f64::from(k % 100))
    };
    let all: Vec<(Contact, f64)> = (0..10_000).map(loaded).collect();
    let numbers = |found: Result<Settled, SettleError>| match found {
        Ok(settled) => reaction(&settled).to_vec(),
        Err(SettleError::SunkToAxle { capacity, .. }) => vec![capacity],
        Err(SettleError::BadLoad { .. }) => Vec::new(),
    };
    settle_many(model.as_ref(), &all).into_iter().flat_map(numbers).collect()
}

fn traverse(model: &Model) -> Result<Vec<f64>, Box<dyn Error>> {
    let mut scenario = read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
    scenario.model = model.clone();
    let trajectory = Run::new(&scenario)?.to_end()?;
    let mut numbers = Vec::new();
    for record in trajectory.records.iter().skip(1) {
        numbers.extend(pose(record.time, &record.state));
        for WheelRecord { reaction: wheel, .. } in &record.wheels {
            numbers.extend([wheel.slip.ratio, wheel.slip.angle, wheel.load]);
            numbers.extend(reaction(&wheel.settled));
        }
    }
    Ok(numbers)
}

fn mission(model: &Model) -> Result<Vec<f64>, Box<dyn Error>> {
    let source = Source::find(Kind::Mission, "there-and-back")?;
    let mut mission = read_mission(&source, &Overrides::none())?.value.mission();
    mission.scenario.model = model.clone();
    let report = MissionRun::new(&mission)?.to_end()?;
    let legs = report.legs.iter().flat_map(|leg| [leg.distance, leg.time, leg.energy]);
    let end = report.trajectory.last();
    Ok(legs.chain(pose(end.time, &end.state)).collect())
}

fn pose(time: f64, rover: &RoverState) -> [f64; 7] {
    let RoverState { position, yaw, velocity, yaw_rate } = *rover;
    [time, position.x, position.y, yaw, velocity.x, velocity.y, yaw_rate]
}

fn reaction(settled: &Settled) -> [f64; 15] {
    let forces = &settled.forces;
    [
        settled.sinkage,
        forces.drawbar_pull,
        forces.side_force,
        forces.normal_force,
        forces.torque,
        forces.overturning_moment,
        forces.aligning_moment,
        forces.thrust,
        forces.motion_resistance,
        forces.side_force_from_shear,
        forces.bulldozing_load,
        forces.max_normal_stress,
        forces.patch.entry,
        forces.patch.exit,
        forces.patch.max_stress,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_changed_bit_changes_the_digest() {
        let of = |middle: f64| digest([0.1, middle, 0.3]);
        assert_ne!(of(0.2), of(0.2_f64.next_up()));
        assert_ne!(of(0.0), of(-0.0));
        assert_eq!(of(f64::NAN), digest(numbers(Values::Float(vec![Some(0.1), None, Some(0.3)]))));
    }
}
