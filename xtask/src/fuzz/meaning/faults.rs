//! The faults: of units, of signs and places, of clocks, of sources, of sensors, and of loss.

use std::f64::consts::PI;

use super::table::Table;

/// A fault of meaning.
pub(super) struct Fault {
    pub(super) name: &'static str,
    kind: Kind,
}

enum Kind {
    /// Columns whose names begin so, times a number.
    Scaled(&'static [&'static str], f64),
    /// Two words of names exchanged.
    Exchanged(&'static str, &'static str),
    Other(Change),
}

/// Any change of a table.
type Change = fn(&mut Table);

impl Fault {
    pub(super) fn damage(&self, table: &mut Table) {
        match self.kind {
            Kind::Scaled(columns, factor) => {
                for start in columns {
                    table.scale(start, factor);
                }
            }
            Kind::Exchanged(one, other) => table.exchange(one, other),
            Kind::Other(change) => change(table),
        }
    }
}

const DEGREES: f64 = 180.0 / PI;
const TURNS: f64 = 30.0 / PI;
/// Angles of the body's attitude.
const ATTITUDE: &[&str] = &["roll_deg", "pitch_deg"];

const SCALED: [(&str, &[&str], f64); 33] = [
    ("torques in N·mm", &["wheel_torque"], 1e3),
    ("torques in N·cm", &["wheel_torque"], 100.0),
    ("torques in kN·m", &["wheel_torque"], 1e-3),
    ("torques before a gear of 10 to 1", &["wheel_torque"], 0.1),
    ("torques ten times too large", &["wheel_torque"], 10.0),
    ("wheel speeds in rpm", &["wheel_speed"], TURNS),
    ("wheel speeds in rad/s, as if they were rpm", &["wheel_speed"], 1.0 / TURNS),
    ("wheel speeds in °/s", &["wheel_speed"], DEGREES),
    ("wheel speeds in turns/s", &["wheel_speed"], 0.5 / PI),
    ("ways in mm", &["vo_dx_m", "vo_dy_m"], 1e3),
    ("ways in cm", &["vo_dx_m", "vo_dy_m"], 100.0),
    ("ways in feet", &["vo_dx_m", "vo_dy_m"], 1.0 / 0.3048),
    ("ways in m, as if they were mm", &["vo_dx_m", "vo_dy_m"], 1e-3),
    ("rotations in radians", &["vo_dyaw"], 1.0 / DEGREES),
    ("rotations in degrees, as if they were radians", &["vo_dyaw"], DEGREES),
    ("roll and pitch in radians", ATTITUDE, 1.0 / DEGREES),
    ("roll in radians", &["roll_deg"], 1.0 / DEGREES),
    ("pitch in radians", &["pitch_deg"], 1.0 / DEGREES),
    ("roll and pitch in degrees, as if they were radians", ATTITUDE, DEGREES),
    ("yaw in radians", &["yaw_deg"], 1.0 / DEGREES),
    ("times in ms", &["time_s"], 1e3),
    ("times in minutes", &["time_s"], 1.0 / 60.0),
    ("torques of the other sign", &["wheel_torque"], -1.0),
    ("wheel speeds of the other sign", &["wheel_speed"], -1.0),
    ("speeds and torques of the right side of the other sign", RIGHT, -1.0),
    ("one wheel's speed of the other sign", &["wheel_speed_rad_s_front-left"], -1.0),
    ("roll of the other sign", &["roll_deg"], -1.0),
    ("pitch of the other sign", &["pitch_deg"], -1.0),
    ("yaw of the other sign", &["yaw_deg"], -1.0),
    ("ways forward of the other sign", &["vo_dx_m"], -1.0),
    ("ways to the side of the other sign", &["vo_dy_m"], -1.0),
    ("rotations of the other sign", &["vo_dyaw"], -1.0),
    ("torques of 0", &["wheel_torque"], 0.0),
];

const RIGHT: &[&str] = &[
    "wheel_speed_rad_s_front-right",
    "wheel_speed_rad_s_middle-right",
    "wheel_speed_rad_s_rear-right",
    "wheel_torque_nm_front-right",
    "wheel_torque_nm_middle-right",
    "wheel_torque_nm_rear-right",
];

const EXCHANGED: [(&str, &str, &str); 4] = [
    ("ways forward and to the side exchanged", "vo_dx_m", "vo_dy_m"),
    ("roll and pitch exchanged", "roll_deg", "pitch_deg"),
    ("wheels left and right exchanged", "left", "right"),
    ("wheels front and rear exchanged", "front", "rear"),
];

const OTHER: [(&str, Change); 29] = [
    ("newest row first", |table| table.rows.reverse()),
    ("rows in groups of ten, newest first", |table| {
        table.rows.chunks_mut(10).for_each(<[_]>::reverse);
    }),
    ("one time in all rows", |table| table.change("time_s", |_, _| 5.0)),
    ("times rounded to a second", |table| table.change("time_s", |_, time| time.floor())),
    ("the clock set back by 5 s half way", |table| {
        let half = table.rows.len() / 2;
        table.change("time_s", |row, time| if row < half { time } else { time - 5.0 });
    }),
    ("the drive twice, one behind the other", |table| table.rows.extend(table.rows.clone())),
    ("each row twice", |table| {
        table.rows = table.rows.iter().flat_map(|row| [row.clone(), row.clone()]).collect();
    }),
    ("odometry 1 s late", |table| table.delay("vo_d", 10)),
    ("odometry 5 s late", |table| table.delay("vo_d", 50)),
    ("attitude 5 s late", |table| {
        for start in ATTITUDE {
            table.delay(start, 50);
        }
    }),
    ("odometry of wheels", |table| by_wheels(table, 1.0, 1.0)),
    ("odometry of wheels, by a radius 5 % too small", |table| by_wheels(table, 0.95, 1.0)),
    ("odometry of wheels and cameras, half and half", |table| by_wheels(table, 1.0, 0.5)),
    ("a frozen roll", |table| freeze(table, "roll_deg")),
    ("a frozen pitch", |table| freeze(table, "pitch_deg")),
    ("a frozen torque", |table| freeze(table, "wheel_torque_nm_front-left")),
    ("a frozen wheel speed", |table| freeze(table, "wheel_speed_rad_s_rear-right")),
    ("frozen ways", |table| freeze(table, "vo_d")),
    ("everything frozen", |table| freeze(table, "")),
    ("roll and pitch of 0", |table| {
        for start in ATTITUDE {
            table.put(start, "0", |_| true);
        }
    }),
    ("a yaw from north", |table| table.change("yaw_deg", |_, yaw| yaw + 90.0)),
    ("columns `effort_…` for torques", |table| rename(table, "wheel_torque_nm", "effort")),
    ("columns `odom_d…` for ways", |table| rename(table, "vo_d", "odom_d")),
    ("a third of the rows lost", |table| table.keep_rows(|row| row % 3 != 0)),
    ("half of the rows lost, here and there", |table| {
        table.keep_rows(|row| row * 7919 % 101 < 50);
    }),
    ("one way in ten lost", |table| table.put("vo_d", "0", |row| row * 7919 % 101 < 10)),
    ("−9999 where one reading in ten is missing", |table| {
        for start in ["vo_d", "wheel_torque", "roll_deg", "pitch_deg"] {
            table.put(start, "-9999", |row| row * 7919 % 101 < 10);
        }
    }),
    ("a log that ends in the first tenth", |table| table.rows.truncate(table.rows.len() / 10)),
    ("cells of two columns run together from half way", |table| {
        let half = table.rows.len() / 2;
        for row in &mut table.rows[half..] {
            let cell = row.remove(1);
            row[1].insert_str(0, &cell);
            row.push(String::new());
        }
    }),
];

/// All of them.
pub(super) fn all() -> Vec<Fault> {
    let scaled = SCALED.map(|(name, columns, by)| Fault { name, kind: Kind::Scaled(columns, by) });
    let exchanged =
        EXCHANGED.map(|(name, one, other)| Fault { name, kind: Kind::Exchanged(one, other) });
    let other = OTHER.map(|(name, change)| Fault { name, kind: Kind::Other(change) });
    scaled.into_iter().chain(exchanged).chain(other).collect()
}

/// A channel that stays what it is from a third of the drive on.
fn freeze(table: &mut Table, start: &str) {
    // The time goes on.
    let times: Vec<String> = table.rows.iter().map(|row| row[0].clone()).collect();
    table.freeze(start, table.rows.len() / 3);
    table.rows.iter_mut().zip(times).for_each(|(row, time)| row[0] = time);
}

fn rename(table: &mut Table, start: &str, name: &str) {
    for place in table.columns(start) {
        table.names[place] = table.names[place].replacen(start, name, 1);
    }
}

/// Ways that are the turning of the wheels, which all have one rim speed in these drives.
///
/// * `radius`: over that of the wheels [-]
/// * `share`: of the wheels in the ways, the rest of them is as it was [-]
fn by_wheels(table: &mut Table, radius: f64, share: f64) {
    /// The rims' way between two rows [m]: 60 mm/s for 0.1 s.
    const WAY: f64 = 0.006;
    let speeds = table.columns("wheel_speed");
    let mean = |row: &Vec<String>| {
        let read = speeds.iter().filter_map(|place| row[*place].parse::<f64>().ok());
        let read: Vec<f64> = read.collect();
        (!read.is_empty()).then(|| read.iter().sum::<f64>() / read.len() as f64)
    };
    let means: Vec<Option<f64>> = table.rows.iter().map(mean).collect();
    let known: Vec<f64> = means.iter().flatten().copied().collect();
    let usual = known.iter().sum::<f64>() / known.len() as f64;
    let turned = |row: usize| radius * WAY * means[row].map_or(1.0, |it| it / usual);
    table.change("vo_dx_m", |row, way| share * turned(row) + (1.0 - share) * way);
    for start in ["vo_dy_m", "vo_dyaw"] {
        table.scale(start, 1.0 - share);
    }
}
