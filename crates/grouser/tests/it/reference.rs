//! Numbers of an independent implementation (`reference/README.md` says how they were made).

use grouser::contact::{Contact, Ishigami, Model, Settled, Slip, WheelForces};
use grouser::simulation::Scenario;
use grouser::soil::{
    Bulldozing, Domain, Exit, PressureSinkage, Shear, ShearModulus, SinkageExponent, Soil,
    StressPeak,
};
use grouser::studies::comparison::Levelness;
use grouser::studies::heading::{HeadingOffset, HeadingStudy, Steering};
use grouser::terrain::Ground;
use grouser::units::{EARTH_GRAVITY, MOON_GRAVITY, Vec2, deg};
use grouser::vehicle::load::{slope_pull, wheel_loads};
use grouser::vehicle::{LoadSharing, OwnMoments, RoverState, dynamics};
use grouser::wheel::{Grousers, Wheel};
use serde_json::Value;

use super::given;

fn rows(json: &str) -> Vec<Value> {
    let document: Value = serde_json::from_str(json).expect("the reference files are JSON");
    document["rows"].as_array().expect("they have rows").clone()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("not a number: {value}"))
}

fn soil_of(soil: &Value) -> Soil {
    let law = &soil["pressure_sinkage"];
    let (k_c, k_phi) = (number(&law["k_c"]), number(&law["k_phi"]));
    let exponent = SinkageExponent::constant(number(&law["n"]));
    let modulus = &soil["shear_modulus"];
    let linear = |axis: &str| ShearModulus::Linear {
        at_zero: number(&modulus[format!("{axis}_m")]),
        per_radian: number(&modulus[format!("{axis}_per_rad_m")]),
    };
    assert_eq!(soil["shear_law"], "anisotropic");
    assert_eq!(soil["bulldozing"], "sine");
    Soil {
        cohesion: number(&soil["cohesion_pa"]),
        friction_angle: deg(number(&soil["friction_angle_deg"])),
        constant_volume_share: 0.0,
        density: number(&soil["density_kg_m3"]),
        pressure_sinkage: match law["law"].as_str() {
            Some("reece") => PressureSinkage::Reece { k_c, k_phi, exponent },
            Some("bekker") => PressureSinkage::Bekker { k_c, k_phi, exponent },
            other => panic!("unknown law {other:?}"),
        },
        stress_peak: StressPeak {
            a0: number(&soil["max_stress"]["a0"]),
            a1: number(&soil["max_stress"]["a1"]),
        },
        shear: Shear::Anisotropic {
            longitudinal: linear("longitudinal"),
            lateral: linear("lateral"),
        },
        shear_bound: grouser::soil::ShearBound::None,
        exit: Exit::Ratio(number(&soil["exit_angle_ratio"])),
        bulldozing: Bulldozing::Sine,
        small_wheel: grouser::soil::SmallWheel::OFF,
        rft: grouser::soil::Rft::PUBLISHED,
        discrepancy: None,
        domain: Domain::UNSTATED,
    }
}

fn wheel_of(wheel: &Value) -> Wheel {
    let height = number(&wheel["grouser_height_m"]);
    Wheel {
        radius: number(&wheel["radius_m"]),
        width: number(&wheel["width_m"]),
        grousers: (height > 0.0).then_some(Grousers { height, count: 24 }),
    }
}

/// Every quantity of every settled wheel to 1e-6 of its size, or of a thousandth of its scale.
#[test]
fn settled_wheels_of_the_reference() {
    let rows = rows(include_str!("reference/wheel_equilibrium.json"));
    assert_eq!(rows.len(), 140);
    for row in &rows {
        let wheel = wheel_of(&row["wheel"]);
        let load = number(&row["load_n"]);
        let contact = Contact {
            wheel,
            soil: soil_of(&row["soil"]),
            slip: Slip::on_test_stand(
                number(&row["slip_ratio"]),
                deg(number(&row["slip_angle_deg"])),
            ),
            gravity: number(&row["gravity_m_s2"]),
        };
        let settled = given::settled(&Ishigami::default(), &contact, load);
        let forces = settled.forces;
        let radius = wheel.shearing_radius();
        let quantities = [
            ("sinkage_m", settled.sinkage, radius),
            ("entry_angle_rad", forces.patch.entry, 1.0),
            ("max_stress_angle_rad", forces.patch.max_stress, 1.0),
            ("exit_angle_rad", forces.patch.exit, 1.0),
            ("drawbar_pull_n", forces.drawbar_pull, load),
            ("side_force_n", forces.side_force, load),
            ("side_force_from_shear_n", forces.side_force_from_shear, load),
            ("bulldozing_integral_n", forces.bulldozing_load, load),
            ("torque_nm", forces.torque, load * radius),
        ];
        for (name, computed, scale) in quantities {
            let expected = number(&row[name]);
            let error = (computed - expected).abs() / expected.abs().max(1e-3 * scale);
            assert!(error < 1e-6, "{name} is {computed}, not {expected} ({error:.1e}): {row}");
        }
    }
}

/// Source: `reference/attitude.json`, found by an independent static balance.
#[test]
fn level_attitudes_of_the_reference() {
    let curve = hakuto_study(LoadSharing::QuasiStatic).curve().expect("sand and gravity");
    for row in &rows(include_str!("reference/attitude.json")) {
        let attitude = curve.at(deg(number(&row["slope_deg"]))).expect("it can be crossed");
        let yaw_error = attitude.yaw.to_degrees() - number(&row["yaw_deg"]);
        // Both solve the same equations: what is left is the reference's own tolerance.
        assert!(yaw_error.abs() < 1e-5, "off by {yaw_error:.1e}°: {row}");
        let slip_error = attitude.slip_ratio - number(&row["slip_ratio"]);
        assert!(slip_error.abs() < 1e-6, "off by {slip_error:.1e}: {row}");
    }
}

/// Source: `reference/traverse.json`, an independent simulation.
#[test]
fn traverses_of_the_reference() {
    let rows = rows(include_str!("reference/traverse.json"));
    assert_eq!(rows.len(), 10);
    for row in &rows {
        let value = |key: &str| number(&row[key]);
        let mut scenario = given::traverse(deg(value("slope_deg")), deg(value("yaw_deg")));
        if row["load_transfer"] == false {
            scenario.sharing = LoadSharing::Uniform;
        }
        assert_eq!((value("duration_s"), value("speed_m_s")), (scenario.duration, 0.06));
        let RoverState { position, yaw, velocity, .. } = given::run(&scenario).last().state;
        // Both integrate to a relative 1e-6, which leaves some micrometres after a metre.
        for (name, computed, within) in [
            ("x_m", position.x, 1e-4),
            ("y_m", position.y, 1e-4),
            ("final_yaw_deg", yaw.to_degrees(), 5e-3),
            ("final_u_m_s", velocity.x, 1e-5),
            ("final_v_m_s", velocity.y, 1e-5),
        ] {
            let error = computed - value(name);
            assert!(error.abs() < within, "{name} is {computed}, off by {error:.1e}: {row}");
        }
    }
}

fn hakuto_study(sharing: LoadSharing) -> HeadingStudy {
    HeadingStudy {
        rover: given::hakuto(),
        soil: given::toyoura(),
        gravity: EARTH_GRAVITY,
        model: Model::Ishigami,
        sharing,
        own_moments: OwnMoments::Neglected,
        stability: grouser::soil::SlopeStability::USUAL,
        steering: Steering::None,
    }
}

/// A row of the oracle tables, in their units: s, β°, h mm, θ_f°, θ_m°, σ_max kPa, F_x, F_u, F_s N,
/// T N·m.
type OracleRow = [f64; 10];

/// Every printed digit but the last: half a unit of it, and a little for the constants' own digits.
fn check_oracle(soil: Soil, wheel: Wheel, load: f64, rows: &[OracleRow]) {
    for row in rows {
        let contact = given::on_stand(soil, wheel, row[0], deg(row[1]));
        let Settled { sinkage, forces, .. } = given::settled(&Ishigami::default(), &contact, load);
        let patch = forces.patch;
        for (name, computed, printed, within) in [
            ("sinkage", sinkage * 1e3, row[2], 6e-5),
            ("entry angle", patch.entry.to_degrees(), row[3], 6e-4),
            ("stress peak", patch.max_stress.to_degrees(), row[4], 6e-4),
            ("largest stress", forces.max_normal_stress * 1e-3, row[5], 6e-4),
            ("drawbar pull", forces.drawbar_pull, row[6], 6e-5),
            ("side force from shear", -forces.side_force_from_shear, row[7], 6e-5),
            ("bulldozing load", forces.bulldozing_load, row[8], 6e-5),
            ("torque", forces.torque, row[9], 6e-6),
        ] {
            assert!((computed - printed).abs() < within, "{name} is {computed}: {row:?}");
        }
    }
}

/// Source: theory, section 2.9, adaptive quadrature. The table has X_c rounded to 26.4°, which is
/// what 45° − φ/2 gives.
#[test]
fn oracle_table_of_the_simulant_of_2007() {
    let rows = [
        [0.1, 0.0, 15.2456, 33.458, 13.885, 10.382, 5.9426, 0.0, 4.8791, 1.01663],
        [0.1, 15.0, 15.2335, 33.445, 13.880, 10.374, 3.6188, 26.6992, 4.8724, 0.79456],
        [0.2, 0.0, 15.5037, 33.749, 14.512, 10.392, 11.1704, 0.0, 5.0233, 1.53951],
        [0.2, 5.0, 15.4984, 33.743, 14.509, 10.388, 9.8942, 12.1043, 5.0203, 1.41765],
        [0.2, 30.0, 15.4756, 33.717, 14.498, 10.373, 5.6716, 34.3258, 5.0075, 1.01404],
        [0.4, 5.0, 15.9976, 34.298, 15.777, 10.361, 17.7686, 9.5117, 5.3043, 2.21742],
        [0.8, 0.0, 16.9986, 35.390, 18.403, 10.165, 29.7362, 0.0, 5.8946, 3.45849],
        [0.8, 30.0, 17.0785, 35.475, 18.447, 10.212, 20.9652, 12.8781, 5.9429, 2.62772],
    ];
    check_oracle(given::simulant_2007(), given::smooth_wheel(0.092, 0.107), 64.68, &rows);
}

/// Source: theory, section 2.9, adaptive quadrature.
#[test]
fn oracle_table_of_toyoura_sand() {
    let rows = [
        [0.1, 0.0, 12.8100, 27.927, 11.590, 4.566, 0.6813, 0.0, 1.3445, 0.23408],
        [0.2, 0.0, 12.9982, 28.135, 12.098, 4.557, 1.8157, 0.0, 1.3923, 0.36849],
        [0.2, 5.0, 13.0011, 28.139, 12.100, 4.559, 1.5505, 2.5225, 1.3931, 0.33891],
        [0.2, 15.0, 13.0055, 28.144, 12.102, 4.562, 1.1295, 5.2849, 1.3942, 0.29196],
        [0.4, 15.0, 13.4100, 28.587, 13.150, 4.536, 2.6393, 4.2246, 1.5003, 0.47651],
        [0.8, 0.0, 14.2991, 29.540, 15.361, 4.422, 5.7997, 0.0, 1.7488, 0.86247],
        [0.8, 30.0, 14.3704, 29.616, 15.400, 4.459, 3.8368, 2.5755, 1.7696, 0.64483],
    ];
    check_oracle(given::toyoura(), given::hakuto_wheel(), 17.0, &rows);
}

/// Without shear, with the stress peak below the hub and full recovery the wheel only stands.
/// Source: theory, section 2.9, static sinkage h_s and entry angle θ_s.
#[test]
fn oracle_static_sinkage() {
    for (soil, wheel, load, entry, sinkage_mm) in [
        (given::simulant_2007(), given::smooth_wheel(0.092, 0.107), 64.68, 0.515_059, 11.9357),
        (given::toyoura(), given::hakuto_wheel(), 17.0, 0.427_283, 9.8896),
    ] {
        let stress_peak = StressPeak { a0: 0.0, a1: 0.0 };
        // A wheel at rest shears nothing.
        let slip = Slip::of_motion(0.0, Vec2::zeros());
        let soil = Soil { stress_peak, ..soil };
        let contact = Contact { slip, ..given::on_stand(soil, wheel, 0.0, 0.0) };
        let settled = given::settled(&Ishigami::default(), &contact, load);
        assert!((settled.sinkage * 1e3 - sinkage_mm).abs() < 6e-5);
        assert!((settled.forces.patch.entry - entry).abs() < 6e-7);
    }
}

// ---- theory, sections 4.3 and 4.5: numbers of the same independent code ----

fn hakuto_attitude(sharing: LoadSharing, slope_deg: f64) -> HeadingOffset {
    let curve = hakuto_study(sharing).curve().expect("sand and gravity");
    curve.at(deg(slope_deg)).expect("it can be crossed")
}

/// Height of the centre of mass in the table of theory, section 4.5 [m]; ours is 0.1554.
const TABLE_HEIGHT: f64 = 0.145;

/// Yaw moment about the common centre of mass [N·m] where the default attitude is held, but the
/// loads balance only these shares of the moments in pitch and in roll.
fn yaw_moment_with_transfers(slope_deg: f64, pitch: f64, roll: f64) -> f64 {
    let attitude = hakuto_attitude(LoadSharing::QuasiStatic, slope_deg);
    let rover = given::hakuto();
    let ground = Ground::plane(given::toyoura(), deg(slope_deg));
    let weight = rover.mass() * EARTH_GRAVITY * deg(slope_deg).cos();
    let pull = TABLE_HEIGHT
        * slope_pull(
            &rover,
            &ground,
            EARTH_GRAVITY,
            &RoverState { yaw: attitude.yaw, ..RoverState::default() },
        );
    let moments = Vec2::new(pitch * pull.x, roll * pull.y);
    let loads = wheel_loads(&rover, LoadSharing::QuasiStatic, weight, moments).expect("it stands");
    let slip = Slip::on_test_stand(attitude.slip_ratio, -attitude.yaw);
    let contact = Contact {
        wheel: rover.mounts()[0].unit.wheel,
        soil: ground.soil,
        slip,
        gravity: EARTH_GRAVITY,
    };
    let forces_under = |&load: &f64| given::settled(&Ishigami::default(), &contact, load).forces;
    let wheels: Vec<WheelForces> = loads.iter().map(forces_under).collect();
    let (force, moment) = dynamics::soil_resultant(&rover, &wheels, OwnMoments::Neglected);
    moment - rover.centre_of_mass().perp(&force)
}

/// Load transfer in pitch alone or in roll alone invents a yaw moment that both together do not
/// have. Source: theory, section 4.5, first table. DIFFERENCE: that table holds the attitude found
/// with its own height of the centre of mass, ours the one found with ours, up to 0.3° apart on
/// 20°.
#[test]
fn pitch_or_roll_transfer_alone_invents_a_yaw_moment() {
    for (slope, [both, pitch_only, roll_only, none], within) in [
        (10.0, [0.003, -0.050, 0.035, -0.018], 0.003),
        (15.0, [0.001, -0.158, 0.134, -0.025], 0.003),
        (20.0, [-0.015, -0.529, 0.477, -0.028], 0.03),
    ] {
        for (pitch, roll, printed) in
            [(1.0, 1.0, both), (1.0, 0.0, pitch_only), (0.0, 1.0, roll_only), (0.0, 0.0, none)]
        {
            let moment = yaw_moment_with_transfers(slope, pitch, roll);
            let message = format!("{slope}°, pitch {pitch}, roll {roll}: {moment}, not {printed}");
            assert!((moment - printed).abs() < within, "{message}");
        }
    }
}

/// Source: theory, sections 4.5 and 10: less than 0.02 N·m is left over with both transfers.
#[test]
fn the_level_attitude_nearly_balances_in_yaw_too() {
    for slope in [5.0, 10.0, 15.0, 20.0] {
        let moment = hakuto_attitude(LoadSharing::QuasiStatic, slope).yaw_moment;
        assert!(moment.abs() < 0.02, "{moment} N·m on {slope}°");
    }
}

/// Source: theory, section 4.5: +0.045, +0.089, +0.131, +0.163 N·m for equal loads, and −0.06,
/// −0.125, −0.19, −0.285 N·m with the wheels' torque in the pitch balance. To the last digit, which
/// for the second row is half a hundredth.
#[test]
fn equal_loads_turn_the_nose_uphill_and_torque_turns_it_downhill() {
    for (sharing, moments, within) in [
        (LoadSharing::Uniform, [0.045, 0.089, 0.131, 0.163], 1.1e-3),
        (LoadSharing::QuasiStaticTorque, [-0.06, -0.125, -0.19, -0.285], 6e-3),
    ] {
        for (slope, printed) in [5.0, 10.0, 15.0, 20.0].into_iter().zip(moments) {
            let moment = hakuto_attitude(sharing, slope).yaw_moment;
            let message = format!("{sharing:?} on {slope}°: {moment} N·m, not {printed}");
            assert!((moment - printed).abs() < within, "{message}");
        }
    }
}

/// Source: theory, section 4.5: 0.73 N·m of torque where the pull would need 0.11 N·m.
#[test]
fn crossing_10_degrees_takes_seven_times_the_torque_of_its_pull() {
    let attitude = hakuto_attitude(LoadSharing::QuasiStatic, 10.0);
    assert!((attitude.torque() - 0.73).abs() < 5e-3, "{} N·m", attitude.torque());
    let pull: f64 = attitude.wheels.iter().map(|wheel| wheel.settled.forces.drawbar_pull).sum();
    assert!((0.11 * pull - 0.11).abs() < 6e-3, "{} N·m", 0.11 * pull);
}

/// Source: theory, section 4.5, second table: yaw lost in 20 s runs that start at the attitude.
#[test]
fn torque_in_the_pitch_balance_loses_the_yaw_that_the_theory_says() {
    for (slope, with_torque, without) in
        [(5.0, 0.56, -0.03), (10.0, 1.41, -0.05), (15.0, 2.88, -0.05), (20.0, 7.27, 0.40)]
    {
        let yaw = hakuto_attitude(LoadSharing::QuasiStatic, slope).yaw;
        for (sharing, printed) in
            [(LoadSharing::QuasiStaticTorque, with_torque), (LoadSharing::QuasiStatic, without)]
        {
            let run = given::run(&Scenario { sharing, ..given::traverse(deg(slope), yaw) });
            let loss = Levelness::of(&run).yaw_loss.to_degrees();
            // The attitudes differ in their last digits, which on 20°, near the fold, weigh most.
            assert!((loss - printed).abs() < 0.06, "{sharing:?} on {slope}°: {loss}°");
        }
    }
}

/// Without compensation a rover drifts by about the angle that would have compensated it.
/// Source: theory, section 4.3: β = 2.1, 4.9, 8.9, 15.1° where ΣF_x = 0 and ΣF_y = m g sin α.
#[test]
fn an_uncompensated_rover_drifts_by_the_angle_that_the_theory_says() {
    for (slope, printed) in [(5.0, 2.1), (10.0, 4.9), (15.0, 8.9), (20.0, 15.1)] {
        let run = given::run(&given::traverse(deg(slope), 0.0));
        let velocity = run.last().state.velocity;
        let drift = (-velocity.y / velocity.x).atan().to_degrees();
        // The run has turned by up to 0.14° by then, and its wheels' loads differ.
        assert!((drift - printed).abs() < 0.1, "{drift}° on {slope}°, not {printed}°");
    }
}

/// Constants copied from Earth make the Moon's soil relatively stiffer, and the rover crab more.
/// Source: theory, section 4.3: 5.0° becomes 9.4° on a slope of 10° if K_σ is held.
#[test]
fn soil_constants_that_ignore_gravity_nearly_double_the_yaw_on_the_moon() {
    let earth = hakuto_study(LoadSharing::QuasiStatic);
    let width = earth.rover.mounts()[0].unit.wheel.width;
    let stiffness = earth.soil.pressure_sinkage.stiffness(
        width,
        0.0,
        earth.soil.unit_weight(EARTH_GRAVITY),
        0.0,
    );
    let exponent = SinkageExponent::constant(stiffness.exponent);
    let held = PressureSinkage::Bekker { k_c: 0.0, k_phi: stiffness.modulus, exponent };
    for (pressure_sinkage, printed) in [(earth.soil.pressure_sinkage, 5.0), (held, 9.4)] {
        let soil = Soil { pressure_sinkage, ..earth.soil };
        let moon = HeadingStudy { soil, gravity: MOON_GRAVITY, ..earth.clone() };
        let yaw = moon.curve().expect("sand").at(deg(10.0)).expect("it can be crossed").yaw;
        assert!((yaw.to_degrees() - printed).abs() < 0.06, "{}°, not {printed}°", yaw.to_degrees());
    }
}
