//! Prints digests of ten thousand wheels, of a traverse and of a mission: all that computes them,
//! whatever its language and its instructions, has to print the same. `cargo xtask hashes` compares
//! them.
//!
//! `hashes` computes by the instructions that the processor has, `hashes SET` by others: it prints
//! nothing where the processor lacks them.

use std::error::Error;

use grouser_core::contact::{
    Contact, InstructionSet, Ishigami, Model, SettleError, Settled, Slip, settle_many,
};
use grouser_core::mission::MissionRun;
use grouser_core::paper;
use grouser_core::simulation::{Run, WheelRecord};
use grouser_core::units::EARTH_GRAVITY;
use grouser_core::vehicle::RoverState;
use grouser_io::{Kind, Overrides, Source, fnv_1a, read_mission, read_scenario};

fn main() -> Result<(), Box<dyn Error>> {
    let model = match std::env::args().nth(1).as_deref() {
        None => Model::Ishigami,
        Some(name) => {
            let set = SETS.into_iter().find(|(known, _)| *known == name);
            let (_, set) = set.ok_or("which instructions? baseline, avx2 or avx512")?;
            if !set.is_available() {
                return Ok(());
            }
            Model::own(Ishigami::DEFAULT.on(set))
        }
    };
    show("wheels", &wheels(&model));
    show("traverse", &traverse(&model)?);
    show("mission", &mission(&model)?);
    Ok(())
}

const SETS: [(&str, InstructionSet); 3] = [
    ("baseline", InstructionSet::Baseline),
    ("avx2", InstructionSet::Avx2),
    ("avx512", InstructionSet::Avx512),
];

fn show(name: &str, numbers: &[f64]) {
    println!("{name} {:016x}", fnv_1a(numbers.iter().flat_map(|number| number.to_le_bytes())));
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
