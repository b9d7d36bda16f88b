//! The programs in `examples/` run, and answer their questions.

use grouser::simulation::Outcome;
use grouser::studies::heading::HeadingStudy;
use grouser::units::deg;

#[path = "../../examples/closed_loop.rs"]
mod closed_loop;
#[path = "../../examples/heading_on_a_slope.rs"]
mod heading_on_a_slope;
#[path = "../../examples/own_ground.rs"]
mod own_ground;
#[path = "../../examples/own_model.rs"]
pub(super) mod own_model;
#[path = "../../examples/own_rover.rs"]
pub(super) mod own_rover;
#[path = "../../examples/uncertain_soil.rs"]
mod uncertain_soil;
#[path = "../../examples/wheel_on_sand.rs"]
mod wheel_on_sand;

/// A wheel that rolls freely is held back; it pulls from a slip of 5 % on, and ever more.
#[test]
fn a_wheel_on_sand_pulls_more_the_more_it_slips() {
    wheel_on_sand::main().expect("it runs");
    let rows = wheel_on_sand::rows().expect("presets are read");
    let pull = |row: &grouser::studies::wheel_test::WheelTestRow| {
        row.result.expect("the soil carries 17 N").forces.drawbar_pull
    };
    assert_eq!(rows.len(), 12);
    assert!(rows.windows(2).all(|pair| pull(&pair[0]) < pull(&pair[1])));
    let first = wheel_on_sand::first_pull(&rows).expect("it pulls at some slip");
    assert!((first - 0.049).abs() < 1e-3, "{first}");
}

/// The heading offset leaves a yaw moment over, by which a run turns: a tenth of the drift is left.
#[test]
fn a_heading_offset_keeps_a_run_nearly_on_the_contour() {
    heading_on_a_slope::main().expect("it runs");
    for row in heading_on_a_slope::rows(&[5.0, 10.0, 15.0]).expect("the slopes can be crossed") {
        let slope = row.slope_deg;
        let left = row.offset_mm / row.straight_mm;
        assert!((0.0..0.15).contains(&left), "{slope}°: {} mm", row.offset_mm);
        assert!(row.straight_mm < -40.0, "{slope}°: {} mm", row.straight_mm);
    }
}

/// The dune is steepest 3 m from its top, 11.4°. The rover starts there and comes half round it, at
/// its height.
#[test]
fn a_rover_drives_along_the_contour_of_ground_of_your_own() {
    own_ground::main().expect("it runs");
    let report = own_ground::drive(9.5).expect("it can be computed");
    assert_eq!(report.trajectory.outcome, Outcome::Completed);
    for record in &report.trajectory.records {
        let off = record.place().norm() - 3.0;
        // Until the heading offset that the slope asks for is learnt: 7.6 cm of map, 1.5 cm of
        // height.
        assert!(off.abs() < 0.08, "{off} m off the contour at {} s", record.time);
    }
    assert!(report.trajectory.last().place().y > 2.8, "{}", report.trajectory.last().place());
}

/// The closed form is that of the steady motion on the contour; on gentle slopes the drive from
/// rest keeps to it.
#[test]
fn a_model_of_your_own_has_the_heading_of_its_closed_form() {
    own_model::main().expect("it runs");
    let scenario = own_model::scenario().expect("the preset is read");
    let curve = HeadingStudy::of(&scenario).curve().expect("it can be computed");
    for slope_deg in [1.0, 5.0, 10.0, 15.0, 20.0] {
        let heading = curve.at(deg(slope_deg)).expect("the contour is held");
        let by_hand = own_model::closed_form(deg(slope_deg));
        assert!(
            (heading.yaw - by_hand).abs() < 1e-7,
            "{slope_deg}°: {} for {by_hand}",
            heading.yaw
        );
    }
    let end = own_model::traverse(&scenario, 5.0, own_model::closed_form(deg(5.0)));
    let end = end.expect("it runs").last().state.position;
    assert!(end.x > 0.9 && end.y.abs() < 1e-3, "{end}");
}

/// A larger steering angle gives a smaller circle. Without slip it would be that of a bicycle whose
/// rear axle is half-way between the middle and the rear wheels, 0.6 m/tan δ; four wheels that
/// cannot be steered make it two to three times as wide.
#[test]
fn a_rover_of_your_own_drives_a_circle() {
    own_rover::main().expect("it runs");
    let mut last = f64::INFINITY;
    for steering_deg in [5.0, 10.0, 20.0] {
        let run = own_rover::drive(steering_deg).expect("it can be computed");
        assert_eq!(run.outcome, Outcome::Completed);
        let radius = own_rover::radius(&run);
        let without_slip = 0.6 / f64::to_radians(steering_deg).tan();
        assert!((2.0..3.0).contains(&(radius / without_slip)), "{steering_deg}°: {radius} m");
        assert!(radius < last);
        last = radius;
    }
    let straight = own_rover::drive(0.0).expect("it can be computed");
    assert!(straight.last().state.yaw.abs() < 1e-9);
}

#[test]
fn a_controller_holds_the_yaw_that_is_lost_without_it() {
    closed_loop::main().expect("it runs");
    let scenario = closed_loop::scenario().expect("the preset is read");
    let wanted = scenario.start.yaw;
    let open = closed_loop::led_by(&scenario, &mut scenario.drive.clone()).expect("it runs");
    let closed = closed_loop::led_by(&scenario, &mut closed_loop::holding(&scenario));
    let closed = closed.expect("it runs");
    let [open, closed] = [&open, &closed].map(|records| records.last().expect("a minute").clone());
    let lost_deg = [&open, &closed].map(|record| (wanted - record.state.yaw).to_degrees());
    assert!(lost_deg[0] > 4.0 && lost_deg[1].abs() < 0.25, "{lost_deg:?}");
    let drifts = [&open, &closed].map(closed_loop::drift_mm);
    assert!(drifts[0] > 100.0 && drifts[1].abs() < 10.0, "{drifts:?}");
}

/// The band holds the heading offset of the sand as written, and steeper slopes have wider ones.
#[test]
fn an_uncertain_soil_has_a_band_of_heading_offsets() {
    uncertain_soil::main().expect("it runs");
    let bands = uncertain_soil::bands(200, &[5.0, 10.0]).expect("the document is read");
    let certain = heading_on_a_slope::rows(&[5.0, 10.0]).expect("the slopes can be crossed");
    let mut width = 0.0;
    for (band, row) in bands.iter().zip(&certain) {
        let yaw = band.yaw.expect("some sands have one");
        assert!(yaw.low.to_degrees() < row.heading_deg && row.heading_deg < yaw.high.to_degrees());
        assert!(yaw.high - yaw.low > width);
        width = yaw.high - yaw.low;
        assert_eq!(band.level.trials, 200);
    }
}
