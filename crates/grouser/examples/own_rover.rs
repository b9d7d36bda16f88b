//! Which circle does my own rover drive on sand? It has six wheels, the two in front steered to the
//! left, and is made in Rust, without a document.
//!
//! ```sh
//! cargo run --release -p grouser --example own_rover
//! ```

use std::error::Error;

use grouser::contact::Model;
use grouser::document::{Kind, Overrides, Source, read_soil};
use grouser::error::ParameterError;
use grouser::simulation::{Motion, Numerics, Run, Scatter, Scenario, Start, Trajectory};
use grouser::soil::SlopeStability;
use grouser::terrain::Ground;
use grouser::units::{EARTH_GRAVITY, Vec3, deg};
use grouser::vehicle::{
    Body, ByWheel, DriveLaw, Inertia, LoadSharing, Mount, OwnMoments, Rover, Ruts, WheelUnit,
};
use grouser::wheel::{Grousers, Wheel};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    println!("steering_deg  x_m    y_m    yaw_deg  radius_m  slip_ratio");
    for steering_deg in [5.0, 10.0, 15.0, 20.0] {
        let run = drive(steering_deg)?;
        let end = run.last();
        let slips = end.wheels.iter().map(|wheel| wheel.reaction.slip.ratio);
        let slip_ratio = slips.sum::<f64>() / end.wheels.len() as f64;
        let (position, yaw_deg) = (end.state.position, end.state.yaw.to_degrees());
        print!("{steering_deg:12.1}  {:.3}  {:.3}  {yaw_deg:7.1}  ", position.x, position.y);
        println!("{:8.2}  {slip_ratio:10.3}", radius(&run));
    }
    Ok(())
}

/// A rover of 26 kg on six wheels of 25 cm diameter.
///
/// * `steering`: of both front wheels [rad], positive to the left
pub(crate) fn six_wheels(steering: f64) -> Result<Rover, ParameterError> {
    let body = Body { mass: 20.0, inertia: Inertia { xx: 1.2, yy: 1.6, zz: 2.4 } };
    let grousers = Grousers { height: 0.010, count: 24 };
    let unit = WheelUnit {
        mass: 1.0,
        inertia: Inertia { xx: 0.005, yy: 0.008, zz: 0.005 },
        wheel: Wheel { radius: 0.115, width: 0.10, grousers: Some(grousers) },
        motor: None,
    };
    let mount = |(name, x, y, steering): (&str, f64, f64, f64)| Mount {
        name: name.to_owned(),
        joint: None,
        position: Vec3::new(x, y, -0.15),
        unit,
        steering,
        steering_axis: None,
    };
    let mounts = [
        ("front-left", 0.40, 0.35, steering),
        ("middle-left", 0.00, 0.38, 0.0),
        ("rear-left", -0.40, 0.35, 0.0),
        ("rear-right", -0.40, -0.35, 0.0),
        ("middle-right", 0.00, -0.38, 0.0),
        ("front-right", 0.40, -0.35, steering),
    ];
    Rover::new(body, mounts.map(mount).to_vec())
}

/// The rover on level sand for 30 s, with rims that turn at 6 cm/s.
pub(crate) fn drive(steering_deg: f64) -> Result<Trajectory, Box<dyn Error>> {
    // Its shear law is isotropic, and holds at the slip angles of wheels in a turn.
    let soil = read_soil(&Source::find(Kind::Soil, "toyoura-lab-2012")?, &Overrides::none())?.value;
    let scenario = Scenario {
        rover: six_wheels(deg(steering_deg))?,
        ground: Ground::plane(soil, 0.0),
        gravity: EARTH_GRAVITY,
        model: Model::Ishigami,
        sharing: LoadSharing::QuasiStatic,
        own_moments: OwnMoments::Neglected,
        drive: DriveLaw::Constant(0.06),
        yaw: None,
        by_wheel: ByWheel::ALIKE,
        scatter: Scatter::NONE,
        ruts: Ruts::Fresh,
        stability: SlopeStability::USUAL,
        start: Start { yaw: 0.0, motion: Motion::Rolling },
        duration: 30.0,
        numerics: Numerics::DEFAULT,
    };
    Ok(Run::new(&scenario)?.to_end()?)
}

/// Radius of the circle that it drives at the end: its speed over its yaw rate [m].
pub(crate) fn radius(run: &Trajectory) -> f64 {
    let end = run.last().state;
    end.velocity.norm() / end.yaw_rate
}
