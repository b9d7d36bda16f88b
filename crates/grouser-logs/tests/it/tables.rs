//! Tables whose columns are fields of messages.

use std::fmt::Write as _;

use super::*;

/// A quaternion about x, by the right-hand rule, as cells.
fn about_x(degrees: f64) -> String {
    let (sin, cos) = (0.5 * degrees.to_radians()).sin_cos();
    format!("{sin},0,0,{cos}")
}

fn close(found: Option<f64>, expected: f64) -> bool {
    found.is_some_and(|found| (found - expected).abs() < 1e-9)
}

/// Columns as PlotJuggler writes them, each topic at its own times, by the mapping for ROS.
#[test]
fn columns_of_plotjuggler_are_topics_with_fields() {
    let mut table = String::from("__time");
    for part in ["x", "y", "z", "w"] {
        let _ = write!(table, ",/rover/imu/orientation/{part}");
    }
    for part in ["position/x", "position/y", "position/z"] {
        let _ = write!(table, ",/odom/pose/pose/{part}");
    }
    for part in ["x", "y", "z", "w"] {
        let _ = write!(table, ",/odom/pose/pose/orientation/{part}");
    }
    table +=
        ",/joint_states/front_left/velocity,/joint_states/rear_left/position,/battery/voltage\n";
    for step in 0..5_u32 {
        let time = 1_700_000_000.0 + f64::from(step);
        let _ = writeln!(table, "{time},{},,,,,,,,,,12.5", about_x(5.0));
        let x = 0.5 * f64::from(step);
        let _ = writeln!(table, "{},,,,,{x},0,0,{},,,", time + 0.02, about_x(0.0));
        let (speed, angle) = (0.25, 0.75 * f64::from(step));
        let _ = writeln!(table, "{},,,,,,,,,,,,{speed},{angle},", time + 0.04);
    }
    let (records, notes) = read(table.as_bytes(), Some(ROS)).unwrap();
    assert_eq!(records.len(), 5, "{notes:?}");
    for (step, record) in records.iter().enumerate() {
        assert!(close(record.roll, 5_f64.to_radians()), "{record:?}");
        assert_eq!(record.wheels[place("front-left")].speed, Some(0.25));
        let (way, turn) = (record.displacement[0], record.wheels[place("rear-left")].speed);
        let is_first = step == 0;
        assert!(if is_first { way.is_none() } else { close(way, 0.5) }, "{record:?}");
        // Times of today have a fraction of a millionth of a second.
        let is_it = turn.is_some_and(|turn| (turn - 0.75).abs() < 1e-5);
        assert!(if is_first { turn.is_none() } else { is_it }, "{record:?}");
    }
}

/// The mapping for ROS that comes with the library.
const ROS: &str = include_str!("../../../grouser-io/data/mappings/ros.toml");

/// A table of somebody's own: vectors by the ends of names, wheels by numbers, units, and a pose
/// in two parts.
#[test]
fn columns_of_any_name_are_read() {
    let mut table = String::from(
        "time_s,pos_x,pos_y,pos_z,quat_x,quat_y,quat_z,quat_w,enc1,vel2_rpm,current3\n",
    );
    for step in 0..4_u32 {
        let time = 0.5 * f64::from(step);
        let rpm = if step == 2 { "oops" } else { "30" };
        let _ =
            writeln!(table, "{time},{},0,0,{},{},{rpm},500", 0.2 * time, about_x(4.0), 3.0 * time);
    }
    let root = |rest: &str| format!("[[reading]]\ntopic = \"/\"\n{rest}\n");
    let readings = [
        root("attitude = \"quat\""),
        root("pose = \"pos\"\norientation = \"quat\""),
        root("field = \"enc1\"\nposition = true\ncolumn = \"wheel_speed_rad_s_front-left\""),
        root("field = \"vel2_rpm\"\nunit = \"rpm\"\ncolumn = \"wheel_speed_rad_s_rear-left\""),
        root("field = \"current3\"\nunit = \"mA\"\ncolumn = \"motor_current_a_rear-left\""),
        root("field = \"current4\"\nunit = \"mA\"\ncolumn = \"motor_current_a_front-left\""),
    ];
    let (records, notes) = read(table.as_bytes(), Some(&mapping(&readings.concat()))).unwrap();
    assert_eq!(records.iter().map(|it| it.time).collect::<Vec<_>>(), [0.0, 0.5, 1.0, 1.5]);
    let last = &records[3];
    assert!(close(last.roll, 4_f64.to_radians()) && close(last.displacement[0], 0.1), "{last:?}");
    assert!(close(last.wheels[place("front-left")].speed, 3.0), "{last:?}");
    let rear = &last.wheels[place("rear-left")];
    assert!(close(rear.speed, std::f64::consts::PI) && rear.current == Some(0.5), "{last:?}");
    assert_eq!(records[2].wheels[place("rear-left")].speed, None);
    for part in [
        "1 readings of / are no numbers",
        "looks for `current4` of /, which no column has; there are time_s, pos_x",
    ] {
        assert!(notes.iter().any(|it| it.contains(part)), "{part}: {notes:?}");
    }
}

/// What does not fit is answered with what is sought and what is there.
#[test]
fn a_table_that_does_not_fit_is_refused_with_both_lists() {
    let reading = "[[reading]]\ntopic = \"/odom\"\nfield = \"pitch\"\ncolumn = \"pitch_deg\"\n";
    let error =
        |table: &str, readings: &str| read(table.as_bytes(), Some(&mapping(readings))).unwrap_err();
    let found = error("time_s,/odom/ptich\n1,2\n", reading);
    for part in ["none of its columns, which are time_s, /odom/ptich", "`pitch` of /odom"] {
        assert!(found.to_string().contains(part), "{found}");
    }
    assert_eq!(found.remedy(), Some(Remedy::MappingOfTable));
    let found = error("t,/odom/pitch\n1,2\n", reading);
    for part in ["known as the time", "t, /odom/pitch"] {
        assert!(found.to_string().contains(part), "{found}");
    }
    assert_eq!(found.remedy(), Some(Remedy::TimeOfMapping));
    // Which of two is meant is a choice, as of messages.
    let two = "time_s,/a/angle,/b/angle\n1,2,3\n";
    let reading = "[[reading]]\ntopic = \"*\"\nfield = \"angle\"\ncolumn = \"pitch_deg\"\n";
    assert!(error(two, reading).to_string().contains("several topics"));
}

/// Rows without a time, and rows that are none, are counted; names that are deeper than any message
/// are no fields.
#[test]
fn what_is_damaged_of_a_mapped_table_is_counted() {
    let deep = "a/".repeat(4_000);
    let table = format!("time_s,angle,{deep}\n1,2,3\n,2,3\n2,4\n3,5,6\n");
    let reading = "[[reading]]\ntopic = \"/\"\nfield = \"angle\"\ncolumn = \"pitch_deg\"\n";
    let (records, notes) = read(table.as_bytes(), Some(&mapping(reading))).unwrap();
    assert_eq!(records.iter().map(|it| it.time).collect::<Vec<_>>(), [1.0, 3.0]);
    for part in ["1 row without a time", "1 row with another number of cells"] {
        assert!(notes.iter().any(|it| it.contains(part)), "{part}: {notes:?}");
    }
}
