//! Files of measured wheel tests: what they mean, what is wrong with them, and how a theory is
//! judged by them.

use std::fmt::Write as _;

use grouser::contact::{Model, Slip};
use grouser::document::measurements::bevameter_columns::{PLATE_COLUMNS, SHEAR_COLUMNS};
use grouser::document::measurements::{
    Choice, Condition, MeasurementError, Measurements, columns, read_from, slope_tests,
};
use grouser::studies::measurement::{Quantity, Reading, WheelTests};
use grouser::studies::validation::{Validation, ValidationStudy};
use grouser::units::{EARTH_GRAVITY, Vec2, deg};
use proptest::prelude::*;

use crate::given::{hakuto_wheel, toyoura};

fn read(text: &str) -> Result<Measurements, MeasurementError> {
    read_from("a.csv", text.as_bytes(), &Choice::default())
}

fn tests(text: &str) -> WheelTests {
    read(text).unwrap_or_else(|error| panic!("{error}")).tests
}

fn value(tests: &WheelTests, trial: usize, quantity: Quantity) -> f64 {
    tests.trials[trial].readings[quantity].expect("it was read").value
}

// ---- What files mean ----

#[test]
fn our_own_layout_is_read_as_it_says() {
    let text = "slip_angle_deg,slip_ratio,load_n,drawbar_pull_n,side_force_n,sinkage_mm,torque_nm\n\
                15,0.3,20,1.5,-2.5,12,0.4\n-15,-0.5,20,-9,,,\n";
    let tests = tests(text);
    assert_eq!(tests.trials[0].slip, Slip::on_test_stand(0.3, deg(15.0)));
    assert_eq!(tests.trials[0].load, 20.0);
    assert_eq!(value(&tests, 0, Quantity::DrawbarPull), 1.5);
    assert_eq!(value(&tests, 0, Quantity::SideForce), -2.5);
    assert!((value(&tests, 0, Quantity::Sinkage) - 0.012).abs() < 1e-15);
    assert_eq!(value(&tests, 0, Quantity::Torque), 0.4);
    assert_eq!(tests.trials[1].readings.side_force, None);
    assert_eq!(tests.cells.len(), 2);
    assert!(tests.cells[0].is_driven() && !tests.cells[1].is_driven());
}

/// Pull over load, as terramechanics prints it, is a pull; rows in time are no trials.
#[test]
fn a_share_of_the_load_is_a_pull_and_samples_in_time_are_no_trials() {
    let shares = tests("slip_ratio,load_n,drawbar_pull_over_load\n0.3,20,0.25\n0.3,40,-0.1\n");
    let pulls = [0, 1].map(|trial| value(&shares, trial, Quantity::DrawbarPull));
    assert_eq!(pulls, [5.0, -4.0]);
    for time in ["time_s", "t", "Time", "timestamp"] {
        let text = format!("{time},slip_ratio,load_n,drawbar_pull_n\n0,0.3,20,1\n0.01,0.3,20,2\n");
        let error = read(&text).expect_err("refused");
        let error = error.to_string();
        assert!(error.contains("rows are samples of runs in time"), "{error}");
        assert!(error.contains("steady part"), "{error}");
    }
}

/// In that layout the side force opposes the hub, which at a positive slip angle moves left.
#[test]
fn the_layout_of_the_cmu_wheels_turns_its_side_forces() {
    let text = "wheel,slip_angle_deg,trial,peripheral_speed_setpoint_mm_s,travel_speed_mm_s,\
                peripheral_speed_mm_s,slip_ratio_total_speed,longitudinal_force_n,\
                longitudinal_force_std_n,side_force_n,side_force_std_n,normal_force_n,\
                normal_force_std_n,sinkage_mm,sinkage_std_mm\n\
                a,45,1,20,10,20,0.5,2,0.1,8,0.2,24,0.3,25,0.4\n\
                a,45,2,20,10,20.1,0.5,2.2,0.1,8.5,0.2,23,0.3,26,0.4\n\
                a,-45,1,0,10,0,-1,-20,0.1,30,0.2,24,0.3,40,0.4\n";
    let tests = tests(text);
    assert_eq!(value(&tests, 0, Quantity::SideForce), -8.0);
    assert_eq!(value(&tests, 2, Quantity::SideForce), 30.0);
    let scatter = Some(Reading { value: 2.0, scatter: Some(0.1) });
    assert_eq!(tests.trials[0].readings.drawbar_pull, scatter);
    assert_eq!(tests.trials[1].load, 23.0);
    let leg = 0.01 * std::f64::consts::FRAC_1_SQRT_2;
    let motion = Slip::of_motion(0.02, Vec2::new(leg, leg));
    assert!((tests.trials[0].slip.ratio - motion.ratio).abs() < 1e-12);
    assert!((tests.trials[0].slip.total() - 0.5).abs() < 1e-6);
    let cells: Vec<_> = tests.cells.iter().map(|cell| cell.trials.clone()).collect();
    assert_eq!(cells, [vec![0, 1], vec![2]]);
    assert_eq!(tests.cells[0].rim_speed, Some(0.02));
}

proptest! {
    /// The same motion, told by speeds, by the slip along the wheel or by the total slip.
    #[test]
    fn all_ways_to_tell_the_slip_agree(
        rim in 0.0..100.0_f64, travel in 1.0..100.0_f64, degrees in -80.0..80.0_f64,
    ) {
        let motion = Slip::of_motion(
            rim * 1e-3,
            Vec2::new(travel * 1e-3 * deg(degrees).cos(), travel * 1e-3 * deg(degrees).sin()),
        );
        let row = |column: &str, value: String| {
            let text = format!("{column},slip_angle_deg,load_n,torque_nm\n{value},{degrees},9,0\n");
            tests(&text).trials[0].slip
        };
        let told = [
            row("travel_speed_mm_s,rim_speed_mm_s", format!("{travel},{rim}")),
            row("slip_ratio", motion.ratio.to_string()),
            row("slip_ratio_total_speed", motion.total().to_string()),
        ];
        for slip in told {
            // The creep speed, 1 µm/s, is another share of the speed where only ratios are told: of
            // the slowest hub's millimetre per second, straight ahead, 4 mm at 75°.
            prop_assert!((slip.ratio - motion.ratio).abs() < 1e-5);
            prop_assert!((slip.total() - motion.total()).abs() < 1e-5);
            prop_assert!((slip.angle - motion.angle).abs() < 1e-3);
        }
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        if let Err(error) = read_from("any", &bytes[..], &Choice::default()) {
            prop_assert!(!error.to_string().is_empty());
        }
    }

    #[test]
    fn any_cells_are_read_or_refused(
        cells in prop::collection::vec("(nan|inf|-?[0-9]{1,3}(\\.[0-9])?|[a-z,;\"]{0,3})", 4),
    ) {
        let text = format!("slip_ratio,slip_angle_deg,load_n,sinkage_mm\n{}\n", cells.join(","));
        if let Ok(measured) = read(&text) {
            let trial = &measured.tests.trials[0];
            prop_assert!(trial.load.is_finite() && trial.slip.ratio.is_finite());
        }
    }
}

#[test]
fn rows_are_chosen_by_conditions_and_by_the_wheels_name() {
    let text = "wheel,slip_angle_deg,slip_ratio,load_n,torque_nm\n\
                smooth,0,0,20,1\nsmooth,15,0,20,2\nbars,0,0,20,3\n";
    let choose = |conditions: &[&str], wheel: Option<&str>| {
        let conditions = conditions.iter().map(|text| Condition::parse(text).unwrap()).collect();
        let choice = Choice { conditions, wheel: wheel.map(str::to_owned), ..Choice::default() };
        read_from("a.csv", text.as_bytes(), &choice)
            .map(|measured| measured.lines)
            .map_err(|error| error.to_string())
    };
    assert_eq!(choose(&[], Some("cmu-smooth")), Ok(vec![2, 3]));
    assert_eq!(choose(&["slip_angle_deg!=15"], Some("my/wheels/lab_Smooth.toml")), Ok(vec![2]));
    assert_eq!(choose(&["wheel=bars"], Some("hakuto")), Ok(vec![4]));
    let several = choose(&[], Some("hakuto")).unwrap_err();
    assert!(several.contains("smooth, bars") && several.contains("wheel=smooth"), "{several}");
    assert!(choose(&["slip_angle=0"], None).unwrap_err().contains("did you mean"));
    assert!(choose(&["slip_angle_deg=7"], None).unwrap_err().contains("no row"));
}

/// Either of two loads that agree will do; if they do not, nobody knows which was carried.
#[test]
fn a_normal_force_beside_the_load_must_agree_with_it() {
    let header = "slip_ratio,load_n,normal_force_n,sinkage_mm\n";
    assert_eq!(tests(&format!("{header}0.1,20,19.99,5\n")).trials[0].load, 20.0);
    assert_eq!(tests(&format!("{header}0.1,,19.99,5\n")).trials[0].load, 19.99);
    let error = read(&format!("{header}0.1,20,24,5\n")).unwrap_err().to_string();
    assert!(error.contains("load_setting_n"), "{error}");
}

#[test]
fn rows_that_are_not_ok_are_left_out_and_counted() {
    let header = "slip_ratio,load_n,sinkage_mm,status\n";
    let text = format!("{header}0.1,20,5,ok\n0.2,20,,stuck\n0.3,20,5,\n0.4,20,,tipped\n");
    let measured = read(&text).expect("two rows are fine");
    assert_eq!(measured.lines, [2, 4]);
    let note = "2 rows are left out, for `status` is not `ok`; the first, line 3: stuck";
    assert_eq!(measured.notes, [note]);
    let error = read(&format!("{header}0.2,20,,stuck\n")).unwrap_err().to_string();
    assert!(error.contains("stuck"), "{error}");
}

/// `docs/guide/data.md` tells people of every column.
#[test]
fn the_guide_tells_every_column() {
    let guide = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/guide/data.md");
    let guide = std::fs::read_to_string(guide).expect("the guide is in the repository");
    let first_cells = guide.lines().filter(|line| line.starts_with("| `"));
    let told: Vec<&str> = first_cells
        .flat_map(|line| line.split('|').nth(1).unwrap_or_default().split('`').skip(1).step_by(2))
        .collect();
    for column in columns::COLUMNS.iter() {
        assert!(told.contains(&column.name), "`{}` is in no row of the tables", column.name);
    }
    for column in &slope_tests::COLUMNS {
        assert!(told.contains(&column.name), "`{}` is in no row of the tables", column.name);
    }
    let of_bevameters = PLATE_COLUMNS.iter().chain(&SHEAR_COLUMNS).map(|column| column.name);
    for name in of_bevameters.clone() {
        assert!(told.contains(&name), "`{name}` is in no row of the tables");
    }
    let of_slopes = slope_tests::COLUMNS.iter().map(|column| column.name);
    let others: Vec<&str> = of_slopes.chain(of_bevameters).collect();
    for name in told {
        assert!(columns::known(name).is_some() || others.contains(&name), "`{name}` is no column");
    }
}

// ---- What is wrong with files ----

#[test]
fn broken_files_say_what_is_wrong_and_where() {
    let header = "slip_ratio,slip_angle_deg,load_n,sinkage_mm\n";
    for (text, parts) in [
        (String::new(), vec!["no header"]),
        (header.to_owned(), vec!["no rows below its header"]),
        (format!("{header}0,0,20\n"), vec!["a.csv:2", "this line are 3", "left open"]),
        (format!("{header}0,0,20,5\n0,0,x,5\n").replace('\n', "\r\n"), vec!["a.csv:3"]),
        (format!("{header}-,deg,N,mm\n0,0,20,5\n"), vec!["a.csv:2", "line of units"]),
        (format!("{header}0,0,20,nan\n0.1,0,20,\n"), vec!["has no reading"]),
        ("slip_ratio,W,sinkage_mm\n0,20,5\n".into(), vec!["not known are `W`", "import"]),
        (format!("{header}0,0,20,5\n0,0,x,5\n"), vec!["a.csv:3", "`load_n` is 'x'"]),
        (format!("{header}0,0,,5\n"), vec!["a.csv:2", "`load_n` has no value"]),
        (format!("{header}nan,0,20,5\n"), vec!["a.csv:2", "`slip_ratio` has no value"]),
        (format!("{header}inf,0,20,5\n"), vec!["a.csv:2", "must be from -2 to 2"]),
        (format!("{header}30,0,20,5\n"), vec!["a.csv:2", "percent"]),
        (format!("{header}0,120,20,5\n"), vec!["`slip_angle_deg` is 120"]),
        (format!("{header}0,0,-5,5\n"), vec!["`load_n` is -5", "positive"]),
        (format!("{header}\"0,5\",0,20,5\n"), vec!["decimals with a point"]),
        (format!("{header}0,0,20,5\n{header}0,0,20,5\n"), vec!["a.csv:3", "header stands here"]),
        ("slip_ratio,slip_ratio,load_n,sinkage_mm\n0,0,20,5\n".into(), vec!["is there twice"]),
        ("slip_ratio,load_n,sinkage_mm,sinkage_m\n".into(), vec!["have the same meaning"]),
        ("slip_ratio,load,sinkage_mm\n0,20,5\n".into(), vec!["the load is missing", "`load_n`?"]),
        ("slip,load_n,sinkage_mm\n0,20,5\n".into(), vec!["the slip", "slip_ratio"]),
        ("slip_ratio;load_n;sinkage_mm\n0;20;5\n".into(), vec!["delimiter ';'"]),
        ("slip_ratio,load_n\n0,20\n".into(), vec!["every reading is missing"]),
        (
            "slip_ratio,travel_speed_mm_s,rim_speed_mm_s,load_n,sinkage_mm\n0.5,10,12,20,5\n"
                .into(),
            vec!["a.csv:2", "the speeds make it 0.16"],
        ),
    ] {
        let error = read(&text).err().unwrap_or_else(|| panic!("accepted: {text}")).to_string();
        for part in parts {
            assert!(error.contains(part), "{error}\ndoes not say: {part}");
        }
    }
}

#[test]
fn what_looks_like_another_unit_is_noted() {
    for (row, part) in [
        ("0.1,0.2618,20,1,5", "radians"),
        ("0.1,15,20,1500,5", "times the load"),
        ("0.1,15,20,1,0.0125", "in metres"),
        ("0.1,15,20,1,5,400", "in N·m"),
        ("0.1,15,20,1,nan", "`sinkage_mm` has no value"),
    ] {
        let header = "slip_ratio,slip_angle_deg,load_n,drawbar_pull_n,sinkage_mm";
        let torque = if row.ends_with(",400") { ",torque_nm" } else { "" };
        let text = format!("{header}{torque}\n{row}\n");
        let notes = read(&text).expect("it can be read").notes;
        assert!(notes.iter().any(|note| note.contains(part)), "{row}: {notes:?}");
    }
    let text = "slip_ratio,load_n,sinkage_mm,sinkage_sd_mm,operator\n0,20,5,1,me\n";
    let notes = read(text).expect("it can be read").notes;
    assert!(notes[0].contains("sinkage_std_mm") && notes[1].contains("operator"), "{notes:?}");
}

/// Spreadsheets leave columns without a name or a value behind the last.
#[test]
fn columns_without_a_name_are_passed_over() {
    let found = read("slip_ratio,load_n,sinkage_mm,,\n0,20,5,,\n").expect("it can be read");
    assert_eq!((found.tests.trials.len(), found.notes.len()), (1, 0), "{:?}", found.notes);
}

/// Rows of one wheel may be taken for another's, whose name the file does not know; but aloud.
#[test]
fn rows_of_a_wheel_by_another_name_are_noted() {
    let text = "wheel,slip_ratio,load_n,sinkage_mm\ngrouser,0,20,5\n";
    for (wheel, count) in [("cmu-grouser", 0), ("cmu-smooth", 1)] {
        let choice = Choice { wheel: Some(wheel.to_owned()), ..Choice::default() };
        let notes = read_from("a.csv", text.as_bytes(), &choice).expect("it can be read").notes;
        assert_eq!(notes.len(), count, "{wheel}: {notes:?}");
    }
}

#[test]
fn a_single_row_and_a_million_rows_are_read() {
    let header = "slip_ratio,load_n,sinkage_mm\n";
    assert_eq!(tests(&format!("{header}0.1,20,5\n")).cells.len(), 1);
    let mut text = header.to_owned();
    for row in 0..1_000_000 {
        writeln!(text, "0.{:02},20,{}", row % 50, row % 7).expect("writing to memory");
    }
    let tests = tests(&text);
    assert_eq!((tests.trials.len(), tests.cells.len()), (1_000_000, 50));
}

// ---- How a theory is judged ----

fn judge(text: &str) -> Validation {
    let tests = tests(text);
    ValidationStudy {
        tests: &tests,
        wheel: hakuto_wheel(),
        soil: toyoura(),
        model: Model::Ishigami,
        gravity: EARTH_GRAVITY,
    }
    .run()
}

/// Rows that the theory itself made, with something added to their pulls and sinkages.
fn simulated(added: &[(f64, f64)]) -> String {
    let mut text = "cell,slip_ratio,slip_angle_deg,load_n,drawbar_pull_n,sinkage_mm\n".to_owned();
    for (place, (pull, sinkage)) in added.iter().enumerate() {
        let slip_ratio = 0.1 * (place / 2) as f64;
        let row = format!("{},{slip_ratio},10,20,0,0\n", place / 2);
        let header = "cell,slip_ratio,slip_angle_deg,load_n,drawbar_pull_n,sinkage_mm\n";
        let truth = judge(&(header.to_owned() + &row)).predictions[0].expect("it settles");
        let pull = truth.forces.drawbar_pull + pull;
        let sinkage = 1e3 * truth.sinkage + sinkage;
        writeln!(text, "{},{slip_ratio},10,20,{pull},{sinkage}", place / 2).expect("memory");
    }
    text
}

#[test]
fn a_theory_agrees_with_itself() {
    let validation = judge(&simulated(&[(0.0, 0.0); 8]));
    for quantity in [Quantity::DrawbarPull, Quantity::Sinkage] {
        let errors = validation.overall.errors[quantity].expect("it was read");
        assert!(errors.rmse < 1e-12 && errors.bias.abs() < 1e-12);
        assert_eq!(errors.repeatability, Some(0.0));
    }
    assert_eq!(validation.overall.errors.side_force, None);
    assert_eq!(validation.overall.errors.torque, None);
}

/// Two cells of two trials; errors by hand. Cell means are off by +1 and −3 N: the root mean
/// square is √5, the bias of the prediction +1. The trials differ by 2 and by 4 N: variances of 2
/// and of 8, pooled √5.
#[test]
fn errors_are_those_of_cell_means() {
    let validation = judge(&simulated(&[(0.0, 0.0), (2.0, 0.0), (-5.0, 0.0), (-1.0, 0.0)]));
    let errors = validation.overall.errors.drawbar_pull.expect("it was read");
    assert!((errors.rmse - 5.0_f64.sqrt()).abs() < 1e-12);
    assert!((errors.bias - 1.0).abs() < 1e-12);
    assert!((errors.repeatability.expect("two trials") - 5.0_f64.sqrt()).abs() < 1e-12);
    let measured: Vec<f64> = validation
        .cells
        .iter()
        .map(|cell| cell.quantities.drawbar_pull.expect("it was read").measured)
        .collect();
    let spread = (measured[0] - measured[1]).powi(2) / 2.0;
    assert!((errors.r2.expect("they differ") - (1.0 - 10.0 / spread)).abs() < 1e-12);
}

/// Two of the first cell's three trials were read, 2 N apart; the second's two are 4 N apart:
/// variances of 2 and of 8, one degree of freedom each, pooled √5.
#[test]
fn a_trial_that_was_not_read_does_not_tell_how_trials_repeat() {
    let text = "slip_ratio,load_n,drawbar_pull_n,sinkage_mm,cell\n\
                0.2,20,1,5,a\n0.2,20,3,5,a\n0.2,20,,5,a\n0.4,20,1,5,b\n0.4,20,5,5,b\n";
    let errors = judge(text).overall.errors.drawbar_pull.expect("it was read");
    assert!((errors.repeatability.expect("repeats") - 5.0_f64.sqrt()).abs() < 1e-12);
}

#[test]
fn cells_weigh_the_same_however_many_trials_they_have() {
    let text = simulated(&[(1.0, 0.0), (1.0, 0.0), (3.0, 0.0)]);
    let errors = judge(&text).overall.errors.drawbar_pull.expect("it was read");
    assert!((errors.bias + 2.0).abs() < 1e-12, "{}", errors.bias);
}

#[test]
fn groups_are_slip_angles_apart_by_drive_and_skid() {
    let text = "slip_ratio,slip_angle_deg,load_n,drawbar_pull_n\n\
                0.2,15,20,1\n-0.5,15,20,1\n0.2,0,20,1\n0.4,0,20,1\n";
    let validation = judge(text);
    let groups: Vec<_> = validation
        .groups
        .iter()
        .map(|group| (group.slip_angle.map(f64::to_degrees), group.driven, group.cells))
        .collect();
    let degrees = |angle: f64| Some(deg(angle).to_degrees());
    assert_eq!(
        groups,
        [
            (degrees(0.0), Some(true), 2),
            (degrees(15.0), Some(true), 1),
            (degrees(15.0), Some(false), 1)
        ]
    );
    assert_eq!(validation.driven.expect("three").cells, 3);
}

/// A soil that cannot carry a wheel has no error there, and says so.
#[test]
fn what_cannot_be_predicted_is_counted_and_in_no_error() {
    let text = "slip_ratio,load_n,drawbar_pull_n\n0.2,20,1\n0.3,90000,1\n";
    let validation = judge(text);
    assert_eq!((validation.overall.unsettled, validation.overall.trials), (1, 2));
    assert_eq!(validation.overall.errors.drawbar_pull.expect("one").cells, 1);
}
