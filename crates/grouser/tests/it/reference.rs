//! Numbers of an independent implementation (`reference/README.md` says how they were made).

use grouser::contact::{Contact, Ishigami, Slip, settle};
use grouser::soil::{
    Bulldozing, Exit, PressureSinkage, Shear, ShearModulus, SinkageExponent, Soil, StressPeak,
};
use grouser::units::deg;
use grouser::wheel::{Grousers, Wheel};
use serde_json::Value;

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
        exit: Exit::Ratio(number(&soil["exit_angle_ratio"])),
        bulldozing: Bulldozing::Sine,
        extended: grouser::soil::Extended::OFF,
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
        let settled = settle(&Ishigami::default(), &contact, load).expect("the soil carries it");
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
