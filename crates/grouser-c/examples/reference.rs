//! Prints by the Rust library what the programs beside this one print by the C interface: all digits
//! have to agree. `cargo xtask c` compares them.

use std::error::Error;

use grouser_core::contact::time_step::{FORCES, MOTIONS, REST_SPEED, SINKAGE_DAMPING};
use grouser_core::contact::{Contact, Model, Slip, SteppingWheel, TimeStep, settle};
use grouser_core::mission::MissionRun;
use grouser_core::paper;
use grouser_core::simulation::Run;
use grouser_core::units::EARTH_GRAVITY;
use grouser_io::{Kind, Overrides, Source, read_mission, read_scenario, read_soil};
use nalgebra::{DMatrix, DVector};

fn main() -> Result<(), Box<dyn Error>> {
    match std::env::args().nth(1).as_deref() {
        Some("wheel") => wheel(),
        Some("run") => run(),
        Some("time_step") => time_step(),
        Some("mission") => mission(),
        _ => Err("which program? wheel, run, time_step or mission".into()),
    }
}

fn show(name: &str, number: f64) {
    println!("{name} {number:?}");
}

fn wheel() -> Result<(), Box<dyn Error>> {
    let changes = Overrides::parse(["soil.cohesion_kpa=0.1"])?;
    let soil = read_soil(&Source::find(Kind::Soil, "toyoura")?, &changes)?.value;
    let (wheel, gravity, model) = (paper::hakuto_wheel(), EARTH_GRAVITY, Model::Ishigami);
    for (ratio, angle) in [(0.0, 0.0), (0.1, 0.0), (0.2, 0.1), (0.4, 0.1)] {
        let contact = Contact { wheel, soil, slip: Slip::on_test_stand(ratio, angle), gravity };
        let settled = settle(model.as_ref(), &contact, 17.0)?;
        show("sinkage_m", settled.sinkage);
        show("drawbar_pull_n", settled.forces.drawbar_pull);
        show("side_force_n", settled.forces.side_force);
        show("drawbar_pull_n", model.as_ref().forces(&contact, 0.01).drawbar_pull);
    }
    Ok(())
}

fn run() -> Result<(), Box<dyn Error>> {
    let text = "schema = \"scenario/1\"\nname = \"across a slope\"\nslope_deg = 10.0\n";
    let scenario = read_scenario(&Source::text("scenario", text), &Overrides::none())?.value;
    let radii = scenario.rover.mounts().iter().map(grouser_core::vehicle::Mount::shearing_radius);
    let radii: Vec<f64> = radii.collect();
    let drive = |run: &mut Run, left: f64, right: f64| {
        let speeds = [left, left, right, right];
        let rims: Vec<f64> =
            speeds.iter().zip(&radii).map(|(speed, radius)| speed * radius).collect();
        (0..20).try_for_each(|_| run.step(&rims, 0.1))
    };
    let mut run = Run::new(&scenario)?;
    drive(&mut run, 0.5, 0.6)?;
    let mut braked = run.clone();
    drive(&mut run, 0.5, 0.6)?;
    drive(&mut braked, 0.1, 0.1)?;
    for run in [run, braked] {
        let now = run.now();
        show("time_s", now.time);
        show("x_m", now.state.position.x);
        show("y_m", now.state.position.y);
        for wheel in &now.wheels {
            show("slip_ratio", wheel.reaction.slip.ratio);
            show("load_n", wheel.reaction.load);
            show("torque_nm", wheel.reaction.settled.forces.torque);
        }
    }
    Ok(())
}

fn time_step() -> Result<(), Box<dyn Error>> {
    let (duration, gravity, mass) = (2e-3, 9.81, 1.7);
    let inverse_mass = DMatrix::from_fn(MOTIONS, FORCES, |motion, force| {
        if motion == force && motion < 3 { 1.0 / mass } else { 0.0 }
    });
    let model = Model::Ishigami;
    let (mut velocity, mut sinkage) = ([0.05, 0.0, 0.0], 0.01);
    let mut stepped = None;
    for _ in 0..50 {
        let free = [0.05, velocity[1], velocity[2] - gravity * duration, 0.0];
        let in_the_end = DVector::from_row_slice(&free);
        let step = TimeStep {
            duration,
            gravity,
            damping: SINKAGE_DAMPING,
            rest_speed: REST_SPEED,
            inverse_mass: &inverse_mass,
            free: &in_the_end,
        };
        let (wheel, soil) = (paper::hakuto_wheel(), paper::toyoura());
        let after = step.reaction(&[SteppingWheel { model: model.as_ref(), wheel, soil, sinkage }]);
        let wheel = after.wheels[0];
        let forces =
            [wheel.forces.drawbar_pull, wheel.forces.side_force, wheel.forces.normal_force];
        for axis in 0..3 {
            velocity[axis] = free[axis] + duration * forces[axis] / mass;
        }
        sinkage = wheel.sinkage;
        stepped = Some(wheel);
    }
    let stepped = stepped.ok_or("there was no step")?;
    show("sinkage_m", sinkage);
    show("drawbar_pull_n", stepped.forces.drawbar_pull);
    show("normal_force_n", stepped.forces.normal_force);
    Ok(())
}

fn mission() -> Result<(), Box<dyn Error>> {
    let source = Source::find(Kind::Mission, "there-and-back")?;
    let mission = read_mission(&source, &Overrides::none())?.value.mission();
    let report = MissionRun::new(&mission)?.to_end()?;
    for leg in &report.legs {
        show("distance_m", leg.distance);
        show("motor_energy_j", leg.energy);
    }
    let end = report.trajectory.last();
    show("time_s", end.time);
    show("x_m", end.state.position.x);
    show("y_m", end.state.position.y);
    Ok(())
}
