//! Simulated trials in the layouts of public data sets, by their README files and sources.

use std::fmt::Write as _;

use grouser::document::statistics::random::{generator, standard_normal};
use grouser::simulation::{Outcome, Run, Scenario};
use grouser::studies::ensemble::samples::Sample;
use grouser::terrain::Ground;
use grouser::units::deg;
use grouser::vehicle::Rover;
use grouser::vehicle::drive::DriveLaw;

/// Slope and yaw [°], radius of the turn to the left, none straight on [m], and speed [m/s].
pub(super) type Trial = (f64, f64, Option<f64>, f64);

/// Standard deviations of attitudes [rad], and of the wheels' speeds [rad/s].
const ATTITUDE: f64 = 1e-3;
const WHEEL_SPEED: f64 = 5e-3;
/// Front left, front right, back left, back right.
const WHEELS: [&str; 4] = ["front-left", "front-right", "rear-left", "rear-right"];
/// `Processed_Data.csv` of the Rover Mobility in a Lunar Analogue Dataset.
const MINES: &str = "time_s,pos_x,pos_y,pos_z,quat_x,quat_y,quat_z,quat_w,ang_vel_x,ang_vel_y,\
    ang_vel_z,lin_acc_x,lin_acc_y,lin_acc_z,enc1,enc2,enc3,enc4,enc1_rad,enc2_rad,enc3_rad,\
    enc4_rad,vel1_rad_s,vel2_rad_s,vel3_rad_s,vel4_rad_s,current1,current2,current3,current4\n";

/// The topics of the Energy-Aware Rover Navigation Dataset, as PlotJuggler names their fields.
const ENAV: &str = "__time,/global_odometry_utm/pose/pose/position/x,\
    /global_odometry_utm/pose/pose/position/y,/global_odometry_utm/pose/pose/position/z,\
    /global_odometry_utm/pose/pose/orientation/x,/global_odometry_utm/pose/pose/orientation/y,\
    /global_odometry_utm/pose/pose/orientation/z,/global_odometry_utm/pose/pose/orientation/w,\
    /joint_states/front_left_wheel/velocity,/joint_states/front_right_wheel/velocity,\
    /joint_states/rear_left_wheel/velocity,/joint_states/rear_right_wheel/velocity\n";

/// Which data set's columns a table has.
#[derive(Clone, Copy)]
pub(super) enum Layout {
    Mines,
    Enav,
    Baseprod,
}

impl Layout {
    /// The name of its mapping.
    pub(super) fn mapping(self) -> &'static str {
        match self {
            Self::Mines => "mines",
            Self::Enav => "enav",
            Self::Baseprod => "baseprod",
        }
    }

    /// A rover with its wheels: four that are not steered, or six of which most are.
    pub(super) fn rover(self) -> &'static str {
        match self {
            Self::Mines | Self::Enav => "hakuto",
            Self::Baseprod => "sojourner",
        }
    }

    /// How far a trial goes [m], and what a position scatters by [m]: motion capture in a hall, a
    /// filter of cameras that is taken for as good, satellites in the field.
    fn way(self) -> (f64, f64) {
        match self {
            Self::Mines | Self::Enav => (1.5, 2e-4),
            Self::Baseprod => (4.0, 3e-3),
        }
    }

    /// Between two rows [s].
    fn interval(self) -> f64 {
        match self {
            Self::Mines | Self::Enav => 0.1,
            Self::Baseprod => 0.5,
        }
    }

    /// The wheels that its columns are of, in their order.
    fn wheels(self, rover: &Rover) -> Vec<String> {
        match self {
            Self::Mines | Self::Enav => WHEELS.map(str::to_owned).to_vec(),
            Self::Baseprod => rover.mounts().iter().map(|it| it.name.clone()).collect(),
        }
    }

    fn header(self, wheels: &[String]) -> String {
        let of_wheels = |column: &str| -> String {
            wheels.iter().map(|wheel| format!(",{column}/{wheel}")).collect()
        };
        match self {
            Self::Mines => MINES.to_owned(),
            Self::Enav => ENAV.to_owned(),
            Self::Baseprod => {
                let pose = "time_s,pos_x,pos_y,pos_z,quat_x,quat_y,quat_z,quat_w";
                format!("{pose}{}{}\n", of_wheels("drive"), of_wheels("steer"))
            }
        }
    }
}

/// A quaternion, w first.
type Turn = [f64; 4];

fn after(one: Turn, other: Turn) -> Turn {
    let ([a, b, c, d], [w, x, y, z]) = (one, other);
    [
        a * w - b * x - c * y - d * z,
        a * x + b * w + c * z - d * y,
        a * y - b * z + c * w + d * x,
        a * z + b * y - c * x + d * w,
    ]
}

/// About the axis x, y or z, by an angle [rad].
fn about(axis: usize, angle: f64) -> Turn {
    let mut turn = [(0.5 * angle).cos(), 0.0, 0.0, 0.0];
    turn[1 + axis] = (0.5 * angle).sin();
    turn
}

/// A vector, turned.
fn turned(turn: Turn, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let [w, i, j, k] = turn;
    let [_, x, y, z] = after(after(turn, [0.0, x, y, z]), [w, -i, -j, -k]);
    [x, y, z]
}

/// The rows of a trial; nothing where the rover does not get along.
///
/// * `of`: its rover, gravity and load transfer are taken
pub(super) fn table(
    layout: Layout,
    of: &Scenario,
    truth: &Sample,
    trial: Trial,
    seed: u64,
) -> Option<String> {
    let (slope, yaw, radius, speed) = trial;
    let mut scenario = of.clone();
    scenario.model = truth.model.clone();
    scenario.ground = Ground::plane(truth.soil, deg(slope));
    scenario.start.yaw = deg(yaw);
    let (way, scatter) = layout.way();
    scenario.duration = way / speed;
    scenario.numerics.sample_interval = layout.interval();
    let curvature = radius.map_or(0.0, f64::recip);
    let rims = scenario.rover.mounts().iter().map(|it| speed * (1.0 - curvature * it.position.y));
    scenario.drive = DriveLaw::ConstantEach(rims.collect());
    let run = Run::new(&scenario).ok()?.to_end().ok()?;
    matches!(run.outcome, Outcome::Completed).then_some(())?;

    // The data set's frame has its x along the first heading, and z up.
    let [forward, leftward, _] =
        turned(after(about(0, deg(slope)), about(2, deg(yaw))), [1.0, 0.0, 0.0]);
    let of_slope = after(about(2, -leftward.atan2(forward)), about(0, deg(slope)));
    let place = |name: &str| scenario.rover.mounts().iter().position(|it| it.name == name);
    let names = layout.wheels(&scenario.rover);
    let wheels: Vec<usize> =
        names.iter().map(|name| place(name).expect("the rover has it")).collect();
    let mut random = generator(seed, 0xD1 << 56);
    let mut normal = |deviation: f64| deviation * standard_normal(&mut random);
    let (mut table, mut angles) = (layout.header(&names), vec![0.0; wheels.len()]);
    let mut before = 0.0;
    for record in &run.records {
        let state = &record.state;
        let place = turned(of_slope, [state.position.x, state.position.y, 0.0]);
        let place = place.map(|it| it + normal(scatter));
        let noise = [0, 1, 2].map(|axis| about(axis, normal(ATTITUDE)));
        let turn = after(of_slope, about(2, state.yaw));
        let [w, x, y, z] = noise.into_iter().fold(turn, after);
        let of_wheels =
            |of: &dyn Fn(usize) -> f64| -> Vec<f64> { wheels.iter().map(|it| of(*it)).collect() };
        let speeds = of_wheels(&|it| record.wheels[it].wheel_speed);
        let speeds: Vec<f64> = speeds.iter().map(|it| it + normal(WHEEL_SPEED)).collect();
        for (angle, speed) in angles.iter_mut().zip(&speeds) {
            *angle += (record.time - before) * speed;
        }
        before = record.time;
        let rest = match layout {
            Layout::Enav => speeds,
            Layout::Mines => {
                let torque = |it: usize| record.wheels[it].reaction.settled.forces.torque;
                let currents = of_wheels(&|it| 512.0 + 40.0 * torque(it));
                [vec![0.0; 6], angles.clone(), angles.clone(), speeds, currents].concat()
            }
            Layout::Baseprod => [angles.clone(), vec![0.0; wheels.len()]].concat(),
        };
        write!(table, "{}", record.time).expect("a text is written");
        for number in place.into_iter().chain([x, y, z, w]).chain(rest) {
            write!(table, ",{number:.6}").expect("a text is written");
        }
        table.push('\n');
    }
    Some(table)
}
