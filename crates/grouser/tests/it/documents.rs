//! Documents: the presets, the way there and back, and everything that can be wrong with one.

use std::fs;
use std::path::{Path, PathBuf};

use grouser::contact::{Contact, Ishigami, Model, Slip, settle};
use grouser::document::{self, DocumentError, Kind, Overrides, Problem, Source};
use grouser::soil::{
    Bulldozing, Domain, Exit, PressureSinkage, Shear, ShearBound, ShearModulus, SinkageExponent,
    SlopeStability, Soil,
};
use grouser::units::deg;
use grouser::vehicle::{DriveLaw, LoadSharing, OwnMoments};
use grouser::wheel::{Grousers, Wheel};
use proptest::prelude::*;
use serde_json::Value;

// ---- Presets ----

/// What reading any document gives that all kinds have.
#[derive(Debug)]
struct Read {
    resolved: String,
    meaning: String,
    assumptions: Vec<String>,
}

fn read(kind: Kind, source: &Source, overrides: &Overrides) -> Result<Read, DocumentError> {
    macro_rules! read {
        ($reader:ident) => {{
            let loaded = document::$reader(source, overrides)?;
            let meaning = format!("{:?}", loaded.value);
            Ok(Read { resolved: loaded.to_toml(), meaning, assumptions: loaded.assumptions })
        }};
    }
    match kind {
        Kind::Soil => read!(read_soil),
        Kind::Wheel => read!(read_wheel),
        Kind::Motor => read!(read_motor),
        Kind::Rover => read!(read_rover),
        Kind::Scenario => read!(read_scenario),
        Kind::Mission => read!(read_mission),
        Kind::DataSet => read!(read_data_set),
        Kind::Design => read!(read_design),
        Kind::Campaign => {
            let campaign = document::read_campaign(source, overrides)?;
            let resolved = campaign.resolved().to_owned();
            // A row of each: what a campaign means is what it computes.
            let meaning = format!("{:?} {:?}", campaign.columns(), campaign.run(0));
            Ok(Read { resolved, meaning, assumptions: campaign.assumptions().to_vec() })
        }
        Kind::Prior => {
            let resolved = document::read_priors(source, overrides)?.to_toml();
            Ok(Read { meaning: resolved.clone(), resolved, assumptions: Vec::new() })
        }
        Kind::TelemetryMapping => read!(read_telemetry_mapping),
    }
}

fn all_presets() -> impl Iterator<Item = &'static document::Preset> {
    Kind::ALL.into_iter().flat_map(document::presets)
}

#[test]
fn every_preset_is_read_and_its_resolved_document_means_the_same() {
    for preset in all_presets() {
        let first = read(preset.kind, &Source::Preset(preset), &Overrides::none());
        let first = first.unwrap_or_else(|error| panic!("{error}"));
        let again = Source::text("resolved", &first.resolved);
        let second = read(preset.kind, &again, &Overrides::none())
            .unwrap_or_else(|error| panic!("{}: {error}", preset.name));
        assert_eq!(first.meaning, second.meaning, "{}", preset.name);
        assert_eq!(first.resolved, second.resolved, "{}", preset.name);
        assert_eq!(first.assumptions, second.assumptions, "{}", preset.name);
    }
}

#[test]
fn every_preset_says_its_name_and_its_source() {
    for preset in all_presets() {
        let (name, source) = preset.title_and_source();
        assert_ne!(name, "unnamed", "{}", preset.name);
        if !matches!(preset.kind, Kind::Scenario | Kind::Mission) {
            assert!(!source.is_empty() && source != "not stated", "{}", preset.name);
        }
    }
}

#[test]
fn every_file_of_the_data_is_a_preset() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../grouser-io/data");
    for (folder, kind) in [
        ("soils", Kind::Soil),
        ("wheels", Kind::Wheel),
        ("motors", Kind::Motor),
        ("rovers", Kind::Rover),
        ("scenarios", Kind::Scenario),
        ("missions", Kind::Mission),
        ("measurements", Kind::DataSet),
        ("campaigns", Kind::Campaign),
        ("priors", Kind::Prior),
        ("mappings", Kind::TelemetryMapping),
    ] {
        let entries = fs::read_dir(data.join(folder)).expect("the folder is there");
        let mut files: Vec<_> = entries
            .map(|entry| entry.expect("it can be listed").path())
            .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
            .map(|path| path.file_stem().expect("a name").to_string_lossy().into_owned())
            .collect();
        files.sort();
        let mut presets: Vec<_> =
            document::presets(kind).map(|preset| preset.name.to_owned()).collect();
        presets.sort();
        assert_eq!(files, presets, "{folder}");
    }
}

fn soil(name: &str) -> Soil {
    soil_with(name, &[])
}

fn soil_with(name: &str, settings: &[&str]) -> Soil {
    let source = Source::find(Kind::Soil, name).expect("a preset");
    let overrides = Overrides::parse(settings).expect("they are written so");
    document::read_soil(&source, &overrides).expect("it is read").value
}

fn wheel(name: &str) -> Wheel {
    let source = Source::find(Kind::Wheel, name).expect("a preset");
    document::read_wheel(&source, &Overrides::none()).expect("it is read").value
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("not a number: {value}"))
}

/// A soil of the reference files, whose keys are in SI.
fn reference_soil(case: &str) -> Soil {
    let json: Value = serde_json::from_str(include_str!("reference/wheel_equilibrium.json"))
        .expect("the reference files are JSON");
    let rows = json["rows"].as_array().expect("they have rows");
    let soil = &rows.iter().find(|row| row["case"] == case).expect("the case is there")["soil"];
    let law = &soil["pressure_sinkage"];
    let (k_c, k_phi) = (number(&law["k_c"]), number(&law["k_phi"]));
    let exponent = SinkageExponent::constant(number(&law["n"]));
    let modulus = |axis: &str| ShearModulus::Linear {
        at_zero: number(&soil["shear_modulus"][format!("{axis}_m")]),
        per_radian: number(&soil["shear_modulus"][format!("{axis}_per_rad_m")]),
    };
    Soil {
        cohesion: number(&soil["cohesion_pa"]),
        friction_angle: deg(number(&soil["friction_angle_deg"])),
        constant_volume_share: 0.0,
        density: number(&soil["density_kg_m3"]),
        pressure_sinkage: if law["law"] == "reece" {
            PressureSinkage::Reece { k_c, k_phi, exponent }
        } else {
            PressureSinkage::Bekker { k_c, k_phi, exponent }
        },
        stress_peak: grouser::soil::StressPeak {
            a0: number(&soil["max_stress"]["a0"]),
            a1: number(&soil["max_stress"]["a1"]),
        },
        shear: Shear::Anisotropic {
            longitudinal: modulus("longitudinal"),
            lateral: modulus("lateral"),
        },
        shear_bound: ShearBound::None,
        exit: Exit::Ratio(number(&soil["exit_angle_ratio"])),
        bulldozing: Bulldozing::Sine,
        small_wheel: grouser::soil::SmallWheel::OFF,
        rft: grouser::soil::Rft::PUBLISHED,
        discrepancy: None,
        domain: Domain::UNSTATED,
    }
}

/// All equal; the moduli to the last but one bit, which is how well the JSON is read here.
fn check_constants(soil: &Soil, reference: &Soil) {
    let pressure_sinkage = reference.pressure_sinkage;
    // The reference has no bound of the shear stresses, no small-wheel model and tan φ under a
    // wheel, and what a preset states of its domain is no constant.
    let Soil { shear_bound, domain, small_wheel, constant_volume_share, .. } = *reference;
    let soil_there =
        Soil { pressure_sinkage, shear_bound, domain, small_wheel, constant_volume_share, ..*soil };
    assert_eq!(&soil_there, reference);
    let stiffness = |soil: &Soil| soil.pressure_sinkage.stiffness(0.1, soil.cohesion, 1e4, 0.0);
    let (ours, theirs) = (stiffness(soil), stiffness(reference));
    assert_eq!(ours.exponent, theirs.exponent);
    assert!((ours.modulus / theirs.modulus - 1.0).abs() < 4.0 * f64::EPSILON);
}

#[test]
fn presets_have_the_constants_of_the_reference() {
    check_constants(&soil("toyoura"), &reference_soil("toyoura_17n"));
    check_constants(&soil("simulant-2007"), &reference_soil("simulant_2007"));
    // What the reference assumes, and the preset leaves to priors.
    let lunar = soil_with(
        "lunar-nominal",
        &[
            "soil.stress_peak={ a0 = 0.4, a1 = 0.15 }",
            "soil.exit.ratio=1",
            "soil.shear.lateral_m=0.018",
            "soil.shear.longitudinal_per_rad_m=0",
            "soil.shear.lateral_per_rad_m=0",
        ],
    );
    check_constants(&lunar, &reference_soil("lunar_nominal"));
    let grousers = Some(Grousers { height: 0.010, count: 24 });
    assert_eq!(wheel("hakuto"), Wheel { radius: 0.10, width: 0.08, grousers });
    assert_eq!(wheel("jfr-2007"), Wheel { radius: 0.092, width: 0.107, grousers: None });
}

/// k_eq (z/b)ⁿ of the MIT rig, written as Reece's law: at a sinkage of b the pressure is k_eq.
#[test]
fn the_mit_rig_has_its_stiffness() {
    for (name, k_eq) in [("mit-rig-a", 2.54e5), ("mit-rig-b", 0.141e6)] {
        let soil = soil(name);
        let width = wheel("mit-rig").width;
        let stiffness = soil.pressure_sinkage.stiffness(width, soil.cohesion, 0.0, 0.3);
        assert!((stiffness.pressure(width) / k_eq - 1.0).abs() < 1e-12, "{name}");
    }
}

/// Complete enough to run: on every soil the HAKUTO wheel stands under a quarter of its rover's
/// weight, at every slip.
#[test]
fn every_soil_carries_a_wheel() {
    for preset in document::presets(Kind::Soil) {
        for slip_ratio in [-0.5, 0.0, 0.2, 0.8] {
            let contact = Contact {
                wheel: wheel("hakuto"),
                soil: soil(preset.name),
                slip: Slip::on_test_stand(slip_ratio, deg(10.0)),
                gravity: 9.80665,
            };
            let settled = settle(&Ishigami::default(), &contact, 17.0);
            assert!(settled.is_ok(), "{} at slip {slip_ratio}: {settled:?}", preset.name);
        }
    }
}

#[test]
fn the_laboratory_blocks_keep_their_shapes() {
    let lab_2007 = soil("toyoura-lab-2007");
    assert_eq!(lab_2007.bulldozing, Bulldozing::SineSquared);
    let Shear::Anisotropic { longitudinal, .. } = lab_2007.shear else { panic!("{lab_2007:?}") };
    let beta = deg(30.0);
    let k_x = -0.0073 * beta * beta - 0.0403 * beta + 0.07;
    assert!((longitudinal.at(beta) - k_x).abs() < 1e-15);
    assert_eq!(longitudinal.at(deg(60.0)), longitudinal.at(deg(45.0)));
    let lab_2012 = soil("toyoura-lab-2012");
    assert_eq!(lab_2012.bulldozing, Bulldozing::None);
    assert!((lab_2012.exit.ratio(0.463) - 0.3634).abs() < 1e-4);
}

#[test]
fn rovers_weigh_what_their_sources_say() {
    for (name, mass, height) in [
        ("hakuto", 6.928, 0.11 + 0.0454),
        ("hakuto-flight", 4.5, 0.11 + 0.0454),
        ("el-dorado-2", 22.36, 0.2115),
    ] {
        let source = Source::find(Kind::Rover, name).expect("a preset");
        let rover = document::read_rover(&source, &Overrides::none()).expect("it is read").value;
        assert!((rover.mass() - mass).abs() < 1e-8, "{name} weighs {}", rover.mass());
        assert!((rover.centre_height() - height).abs() < 5e-5, "{name}");
    }
}

/// Design, section 4: the example is the default.
#[test]
fn a_scenario_that_says_nothing_is_the_traverse_on_10_degrees() {
    let overrides = Overrides::none();
    let default = document::read_scenario(&Source::default_scenario(), &overrides);
    let run = default.expect("it is read").value;
    let written = Source::find(Kind::Scenario, "traverse-10-deg").expect("a preset");
    assert_eq!(run, document::read_scenario(&written, &overrides).expect("it is read").value);
    assert_eq!(run.ground.plane_slope().expect("a plane"), deg(10.0));
    assert_eq!(run.gravity, 9.80665);
    assert_eq!(run.duration, 20.0);
    assert_eq!(run.model, Model::Ishigami);
    assert_eq!(run.drive, DriveLaw::Constant(0.06));
    assert_eq!((run.sharing, run.own_moments), (LoadSharing::Complete, OwnMoments::Included));
    assert_eq!((run.yaw, run.stability), (None, SlopeStability::USUAL));
    assert_eq!(run.ground.soil, soil("toyoura"));
    assert_eq!(run.rover.mounts()[0].name, "front-left");
}

fn scenario_with(settings: &[&str]) -> Result<document::LoadedScenario, document::DocumentError> {
    let overrides = Overrides::parse(settings)?;
    document::read_scenario(&Source::default_scenario(), &overrides)
}

/// The wheels' own moments follow the load transfer, and may not contradict it.
#[test]
fn the_complete_load_transfer_includes_the_wheels_own_moments() {
    use grouser::vehicle::{LoadSharing::*, OwnMoments::*};
    for (settings, expected) in [
        (&[][..], (Complete, Included)),
        (&["scenario.load_transfer=complete"], (Complete, Included)),
        (&["scenario.load_transfer=quasi-static"], (QuasiStatic, Neglected)),
        (&["scenario.load_transfer=quasi-static-torque"], (QuasiStaticTorque, Neglected)),
        (
            &["scenario.load_transfer=uniform", "scenario.wheel_moments=included"],
            (Uniform, Included),
        ),
        (&["scenario.wheel_moments=included"], (Complete, Included)),
    ] {
        let read = scenario_with(settings).expect("it is read");
        assert_eq!((read.value.sharing, read.value.own_moments), expected, "{settings:?}");
        let word = if expected.1 == Included { "included" } else { "neglected" };
        assert_eq!(read.document.text("wheel_moments"), Some(word), "the document says it");
    }
    for settings in [
        &["scenario.load_transfer=complete", "scenario.wheel_moments=neglected"][..],
        &["scenario.wheel_moments=neglected"],
    ] {
        let refused = scenario_with(settings).expect_err("they contradict each other").to_string();
        assert!(refused.contains("wheel_moments") && refused.contains("complete"), "{refused}");
    }
}

#[test]
fn a_scenario_takes_a_yaw_over_time_and_writes_it_again() {
    let read = scenario_with(&["scenario.drive.yaw_deg=[[0, 3.31], [20, 0.56]]"]).expect("read");
    let points = vec![(0.0, deg(3.31)), (20.0, deg(0.56))];
    assert_eq!(read.value.yaw, Some(grouser::simulation::PrescribedYaw { points }));
    let again = Source::text("resolved", read.to_toml());
    let again = document::read_scenario(&again, &Overrides::none()).expect("what was written");
    assert_eq!(again.value, read.value);
    for (wrong, message) in [
        ("[[0, 1], [0, 2]]", "later than the one before it"),
        ("[[0, 1, 2]]", "must have 2"),
        ("[]", "must have 1 or more"),
        ("[[-1, 2]]", "from 0 to a day"),
        ("3.0", "a list"),
        ("[[0, nan]]", "finite"),
        ("[[0, 3.31], [0.001, 300]]", "from [0, 3.31] to [0.001, 300] [°/s] is 296690"),
        ("[[0, 0], [1, 57.2], [2, -0.2]]", "at most 57 to either side"),
    ] {
        let setting = format!("scenario.drive.yaw_deg={wrong}");
        let refused = scenario_with(&[&setting]).expect_err(wrong).to_string();
        assert!(refused.contains(message) && refused.contains("yaw_deg"), "{wrong}: {refused}");
    }
}

/// A number of the table varies like any other: campaigns reach it by its place.
#[test]
fn the_yaw_over_time_has_keys() {
    use grouser::document::Described;
    let read = scenario_with(&["scenario.drive.yaw_deg=[[0, 3.31], [20, 0.56]]"]).expect("read");
    let changed = read.value.with([("drive.yaw_deg.1.1", 2.0), ("drive.yaw_deg.1.0", 10.0)]);
    let yaw = changed.expect("they fit").yaw.expect("it is there");
    assert_eq!(yaw.points[1], (10.0, deg(2.0)));
}

/// What the source does not say otherwise resists within its friction; the paper's law keeps its
/// answers.
#[test]
fn presets_but_toyouras_and_the_fitted_ones_are_bounded() {
    for preset in document::presets(Kind::Soil) {
        let is_as_published = preset.name.starts_with("toyoura") || preset.name.starts_with("cmu-");
        let expected = if is_as_published { ShearBound::None } else { ShearBound::Coulomb };
        assert_eq!(soil(preset.name).shear_bound, expected, "{}", preset.name);
    }
}

#[test]
fn gravities_have_names() {
    assert_eq!(document::gravity("earth"), Some(9.80665));
    assert_eq!(document::gravity("moon"), Some(1.62));
    assert_eq!(document::gravity("mars"), Some(3.71));
    assert_eq!(document::gravity("venus"), None);
}

// ---- Overrides ----

fn override_scenario(settings: &[&str]) -> Result<document::LoadedScenario, DocumentError> {
    document::read_scenario(&Source::default_scenario(), &Overrides::parse(settings)?)
}

#[test]
fn overrides_reach_every_part_of_a_scenario() {
    let run = override_scenario(&[
        "scenario.rover=el-dorado-2",
        "scenario.slope_deg = 5",
        "soil.cohesion_kpa=0.5",
        "wheel.radius_m=0.2",
        "rover.body.mass_kg=20",
        "rover.mount.0.position_m=[0.31, 0.275, -0.14]",
        "scenario.drive.rim_speed_m_s=[0.1, 0.1, -0.1, -0.1]",
    ]);
    let error = run.expect_err("the hubs are no longer level");
    assert!(error.to_string().contains("height z of wheel"), "{error}");
    let run = override_scenario(&[
        "scenario.rover=el-dorado-2",
        "scenario.slope_deg = 5",
        "soil.cohesion_kpa=0.5",
        "wheel.radius_m=0.2",
        "rover.body.mass_kg=20",
        "scenario.drive={rim_speed_m_s=[0.1, 0.1, -0.1, -0.1]}",
    ]);
    let run = run.expect("all are allowed");
    assert_eq!(run.value.ground.plane_slope().expect("a plane"), deg(5.0));
    assert_eq!(run.value.ground.soil.cohesion, 500.0);
    assert_eq!(run.value.rover.mounts()[0].unit.wheel.radius, 0.2);
    assert_eq!(run.value.rover.mass(), 24.0);
    assert_eq!(run.value.drive, DriveLaw::ConstantEach(vec![0.1, 0.1, -0.1, -0.1]));
    let set = "soil Toyoura sand: cohesion_kpa: set to 0.5";
    assert!(run.assumptions.iter().any(|one| one.starts_with(set)), "{:#?}", run.assumptions);
}

#[test]
fn an_override_ends_the_assumption_it_replaces() {
    let run = override_scenario(&["soil.exit.ratio=0.8"]).expect("allowed");
    let of_exit: Vec<_> =
        run.assumptions.iter().filter(|one| one.contains("exit.ratio:")).collect();
    assert_eq!(of_exit.len(), 1, "{of_exit:?}");
}

#[test]
fn a_new_law_needs_no_cleaning_up() {
    let run = override_scenario(&["soil.shear.law=isotropic", "soil.bulldozing.law=none"]);
    let soil = run.expect("allowed").value.ground.soil;
    assert!(matches!(soil.shear, Shear::Isotropic { .. }));
    assert_eq!(soil.bulldozing, Bulldozing::None);
    let run =
        override_scenario(&["scenario.drive.law=eq18", "scenario.drive.ground_speed_m_s=0.1"]);
    assert!(matches!(run.expect("allowed").value.drive, DriveLaw::Eq18(_)));
}

#[test]
fn a_soil_names_its_theory_and_a_scenario_overrules_it() {
    let model = |settings: &[&str]| override_scenario(settings).expect("allowed").value.model;
    assert_eq!(model(&["soil.model=bekker"]), Model::Bekker);
    assert_eq!(model(&["soil.model=bekker", "scenario.model=ishigami"]), Model::Ishigami);
}

#[test]
fn flags_are_named_in_messages() {
    let mut overrides = Overrides::none();
    overrides.flag("--slope-deg", "scenario.slope_deg", "80").expect("it is a value");
    let error = document::read_scenario(&Source::default_scenario(), &overrides);
    let error = error.expect_err("too steep").to_string();
    assert!(error.starts_with("--slope-deg 80: `slope_deg` is 80, it must be 0 to 60"), "{error}");
    overrides.flag_text("--soil", "scenario.soil", "1e5").expect("a name is a name");
    let error = document::read_scenario(&Source::default_scenario(), &overrides);
    let error = error.expect_err("no such soil").to_string();
    assert!(error.starts_with("--soil 1e5: there is no soil preset and no file"), "{error}");
}

/// What callers in other languages set: a key, and its value as TOML.
#[test]
fn changes_are_set_as_flags_are_and_quoted_whole() {
    let changed = |key: &str, value: &str| {
        let mut overrides = Overrides::none();
        overrides.change(key, value, Vec::new())?;
        document::read_scenario(&Source::default_scenario(), &overrides)
    };
    let run = changed("scenario.soil.shear.longitudinal_m", "0.02").expect("allowed");
    let Shear::Anisotropic { longitudinal: ShearModulus::Linear { at_zero, .. }, .. } =
        run.value.ground.soil.shear
    else {
        panic!("Toyoura's law")
    };
    assert_eq!(at_zero, 0.02);
    assert!(run.assumptions.iter().any(|it| it.contains("shear.longitudinal_m: set to 0.02")));
    for (key, value, message) in [
        ("scenario.slope_deg", "80", "`slope_deg` is 80, it must be 0 to 60"),
        ("scenario.slope_deg", "[1", "not TOML"),
        ("scenario.slop_deg", "8", "did you mean `slope_deg`?"),
        ("scen.slope_deg", "8", "does not start with the name of a document"),
    ] {
        let error = changed(key, value).expect_err(key);
        assert_eq!(error.place().document, Overrides::change_label(key, value));
        assert!(error.to_string().starts_with(&format!("{key} = {value}: ")), "{error}");
        assert!(error.to_string().contains(message), "{error}");
    }
}

#[test]
fn wrong_overrides_say_so() {
    for (setting, message) in [
        ("soil.cohesion_kpa", "not of the form document.key=value"),
        ("sol.cohesion_kpa=1", "did you mean `soil.cohesion_kpa`?"),
        ("cohesion_kpa=1", "did you mean `soil.cohesion_kpa`?"),
        ("body.mass_kg=1", "did you mean `rover.body.mass_kg`?"),
        ("mass_kg=1", "did you mean `rover.body.mass_kg` or `rover.wheel_unit.mass_kg`?"),
        // A drive's yaw is a list.
        ("yaw_deg=5", "did you mean `scenario.start.yaw_deg`?"),
        ("scenario.yaw=5", "did you mean `start.yaw_deg`?"),
        ("soil=1", "not set as a whole, only its keys"),
        ("scenario.soil.cohesion_kpa=200", "`soil.cohesion_kpa` is 200, it must be 0 to 100"),
        ("scenario.drive.reference_slip_ratio=0.1", "it goes with law = \"eq18-as-printed\" or"),
        ("soil..x=1", "there is no key"),
        ("soil.cohesion_kpa=", "there is no value"),
        ("soil.cohesion_kpa=[1", "not TOML"),
        ("soil.cohesion_kpa=1\nx=2", "this is not one value"),
        ("soil.cohesion_kpa=much", "`soil.cohesion_kpa` is the text \"much\", it must be a number"),
        ("soil.cohesion_kpa=\"1\"", "a number is written without quotes"),
        ("soil.cohesion_kpa.x=1", "leads through a value that is not a table"),
        ("soil.n=-1", "did you mean `soil.pressure_sinkage.n`?"),
        ("soil.cohesion=1", "did you mean `cohesion_kpa`?"),
        ("soil.density_kg_m3=1e400", "is inf, it must be a finite number, 200 to 4000"),
        ("soil.density_kg_m3=inf", "it must be a finite number, 200 to 4000"),
        ("scenario.rover=hakutoo", "did you mean `hakuto`?"),
        ("scenario.model=bekke", "did you mean \"bekker\"?"),
    ] {
        let error = override_scenario(&[setting]).expect_err(setting).to_string();
        assert!(error.contains(message), "{setting}: {error}");
        let first_line = setting.lines().next().unwrap_or_default();
        assert!(error.starts_with(first_line), "{error}");
    }
    let overrides = Overrides::parse(["rover.body.mass_kg=1"]).expect("it is a value");
    let error = overrides.check_kinds(&[Kind::Soil, Kind::Wheel]).expect_err("no rover is read");
    assert!(error.to_string().contains("it reads: soil, wheel"), "{error}");
}

// ---- Bad documents ----

/// A preset's text with one piece replaced.
pub(crate) fn changed(kind: Kind, name: &str, from: &str, to: &str) -> String {
    let text = document::preset(kind, name).expect("a preset").text;
    assert!(text.contains(from), "{name} has no `{from}`");
    text.replacen(from, to, 1)
}

fn fail(kind: Kind, content: &str) -> DocumentError {
    let source = Source::text("bad.toml", content);
    read(kind, &source, &Overrides::none()).expect_err(content)
}

/// The whole of a message, once: place, line, mark, hint.
#[test]
fn a_message_reads_like_a_compilers() {
    let text = changed(
        Kind::Soil,
        "toyoura",
        "friction_angle_deg = 38.0",
        "friction_angle_deg = 80.0 # steep",
    );
    let line = text.lines().position(|line| line.contains("80.0")).expect("it is there") + 1;
    let expected = format!(
        "bad.toml:{line}:22: `friction_angle_deg` is 80, it must be 5 to 60\n   \
         |\n{line} | friction_angle_deg = 80.0 # steep\n   \
         |                      ^^^^\n\
         hint: Angle of internal friction, φ [°]."
    );
    assert_eq!(fail(Kind::Soil, &text).to_string(), expected);
}

#[test]
fn wrong_soils_say_what_where_and_how_to_mend_it() {
    for (from, to, message) in [
        ("cohesion_kpa ", "cohesion_pka ", "hint: did you mean `cohesion_kpa`?"),
        ("cohesion_kpa ", "cohesion ", "unknown key `cohesion`\n"),
        ("friction_angle_deg = 38.0", "", ":1:1: `friction_angle_deg` is missing"),
        ("= 38.0", "= \"38.0\"", "`friction_angle_deg` is the text \"38.0\", it must be a number"),
        ("= 38.0", "= true", "is the truth value true, it must be a number"),
        ("= 38.0", "= 2020-01-01", "is the date 2020-01-01, it must be a number"),
        ("= 38.0", "= [38.0]", "is a list, it must be a number"),
        ("= 38.0", "= nan", "`friction_angle_deg` is NaN, it must be a finite number, 5 to 60"),
        ("= 38.0", "= -inf", "`friction_angle_deg` is -inf, it must be a finite number, 5 to 60"),
        ("= 38.0", "= 4.999", "is 4.999, it must be 5 to 60"),
        ("= 1490.0", "= 9999999999999999999", "not TOML"),
        ("cohesion_kpa ", "density_kg_m3 = 1.0\ncohesion_kpa ", "duplicate key"),
        ("[exit]", "[shear]", "duplicate key"),
        ("\"reece\"", "\"rece\"", "`pressure_sinkage.law` is \"rece\", it must be"),
        ("\"reece\"", "\"rece\"", "hint: did you mean \"reece\"?"),
        ("law   = \"reece\"", "", "`pressure_sinkage.law` is missing\n"),
        ("n     = 1.703", "", "`pressure_sinkage.n` is missing"),
        ("n     = 1.703", "n     = 2.9\nn_per_slip = 1", "at a slip ratio of 1 is 3.9"),
        ("k_phi = 122.72692509674557", "k_phi = 0", "together is 0, it must be"),
        ("k_phi = 122.72692509674557", "k_phi = 1e6", "it must be -100000 to 100000"),
        ("longitudinal_per_rad_m = 0.043", "longitudinal_per_rad_m = -0.1", "at a slip angle of"),
        ("ratio = 1.0", "ratios = 1.0", "did you mean `ratio`?"),
        ("ratio = 1.0", "law = \"quadratic-in-slip\"", "`exit.at_zero` is missing"),
        (
            "ratio = 1.0",
            "law = \"quadratic-in-slip\"\nat_zero = 1\nper_slip = 1\nper_slip2 = 0",
            "the wheel sinkage ratio at a slip ratio of 0.51",
        ),
        ("\"sine\"", "\"cosine\"", "`bulldozing.law` is \"cosine\", it must be \"none\", \"sign\""),
        ("[shear]", "[shears]", "unknown key `shears`"),
        ("\"soil/1\"", "\"soil/2\"", "`schema` is \"soil/2\", it must be \"soil/1\""),
        (
            "\"soil/1\"",
            "\"wheel/1\"",
            "this is a `wheel/1` document, a `soil/1` document is needed",
        ),
        ("\"soil/1\"", "1", "`schema` is the integer 1, it must be"),
        ("schema = \"soil/1\"", "", "`schema` is missing"),
        ("n     = 1.703", "n     = 1.703 1.8", "not TOML"),
    ] {
        let text = changed(Kind::Soil, "toyoura", from, to);
        let error = fail(Kind::Soil, &text).to_string();
        assert!(error.contains(message), "`{to}`: {error}");
        assert!(error.starts_with("bad.toml:"), "{error}");
        assert!(error.lines().nth(2).is_some_and(|line| line.contains(" | ")), "{error}");
    }
}

/// A rover without a belly clearance has none, one with it another value of its own; both are
/// written as they were read.
#[test]
fn a_rover_may_have_a_belly_clearance() {
    let source = Source::find(Kind::Rover, "hakuto").expect("a preset");
    let read = |settings: &[&str]| {
        let overrides = Overrides::parse(settings.iter().copied()).expect("good settings");
        document::read_rover(&source, &overrides).expect("a rover")
    };
    let [without, with] = [&[][..], &["rover.belly_clearance_m=0.12"]].map(read);
    assert_eq!(without.value.parts().belly_clearance, None);
    assert_eq!(with.value.parts().belly_clearance, Some(0.12));
    assert!(with.value != without.value);
    for loaded in [without, with] {
        let again = Source::text("again", loaded.to_toml());
        let again = document::read_rover(&again, &Overrides::none()).expect("it was written");
        assert_eq!(again.value, loaded.value);
    }
}

#[test]
fn wrong_rovers_say_what_where_and_how_to_mend_it() {
    let cut = |from: &str| {
        let text = document::preset(Kind::Rover, "hakuto").expect("a preset").text;
        text[..text.find(from).expect("it is there")].to_owned()
    };
    let two_wheels = fail(Kind::Rover, &cut("[[mount]]\nname = \"rear-right\""));
    assert!(two_wheels.to_string().contains("`mount` has 2 entries, it must have 3 or more"));
    assert!(two_wheels.place().spot.as_ref().is_some_and(|spot| spot.line > 10), "{two_wheels}");
    for (from, to, message) in [
        ("mass_kg = 5.24", "mass_kg = 0", "`body.mass_kg` is 0, it must be 0.01 to 100000"),
        ("zz = 0.230", "zz = -1", "`body.inertia_kg_m2.zz` is -1, it must be"),
        (
            "[0.19, 0.24, -0.06]",
            "[0.19, 0.24]",
            "`mount.0.position_m` has 2 entries, it must have 3",
        ),
        ("[0.19, 0.24, -0.06]", "[0.19, nan, -0.06]", "`mount.0.position_m.1` is NaN"),
        (
            "[-0.17, 0.24, -0.06]",
            "[-0.17, 0.24, -0.07]",
            "height z of wheel rear-left [m] is -0.07",
        ),
        ("\"rear-left\"", "\"front-left\"", "`mount.1.name` is \"front-left\" a second time"),
        ("wheel = \"hakuto\"", "wheel = \"hakuot\"", "did you mean `hakuto`?"),
        ("wheel = \"hakuto\"", "wheel = \"w/none.toml\"", "there is no such file"),
        (
            "wheel = \"hakuto\"",
            "wheel = 5",
            "is the integer 5, it must be a text in quotes or a table",
        ),
        (
            "wheel = \"hakuto\"",
            "wheel = { radius_m = 2, width_m = 0.1 }",
            "`wheel_unit.wheel.radius_m` is 2, it must be 0.01 to 1",
        ),
        (
            "wheel = \"hakuto\"",
            "wheel = { schema = \"soil/1\", radius_m = 0.1, width_m = 0.1 }",
            "this is a `soil/1` document, a `wheel/1` document is needed",
        ),
        ("wheel = \"hakuto\"", "", "`wheel_unit.wheel` is missing"),
        (
            "[body]",
            "belly_clearance_m = -0.05\n[body]",
            "`belly_clearance_m` is -0.05, it must be 0 to 10",
        ),
    ] {
        let text = changed(Kind::Rover, "hakuto", from, to);
        let error = fail(Kind::Rover, &text);
        assert!(error.to_string().contains(message), "`{to}`: {error}");
        let line = error.place().spot.as_ref().map(|spot| spot.line);
        assert!(line > Some(1), "`{to}`: {error}");
    }
    let in_line = document::preset(Kind::Rover, "hakuto").expect("a preset").text;
    let in_line = in_line.replace(" 0.24,", " 0.0,").replace("-0.24,", "0.0,");
    let error = fail(Kind::Rover, &in_line);
    assert!(error.to_string().contains("the wheels must not stand in one line"), "{error}");
    assert!(error.to_string().contains("[[mount]]"), "{error}");
}

#[test]
fn wrong_scenarios_say_what_where_and_how_to_mend_it() {
    for (lines, message) in [
        ("gravity_m_s2 = -1.62", "`gravity_m_s2` is -1.62, it must be 0.01 to 30"),
        ("duration_s = 0", "`duration_s` is 0, it must be above 0 and at most 86400"),
        ("slope_deg = 60.1", "`slope_deg` is 60.1, it must be 0 to 60"),
        ("load_transfer = \"quasistatic\"", "did you mean \"quasi-static\"?"),
        ("wheel_moments = true", "it must be \"neglected\" or \"included\""),
        ("drive = 1", "`drive` is the integer 1, it must be a table"),
        ("drive.rim_speed_m_s = [1, 2, 3]", "the number of rim speeds is 3"),
        (
            "drive.rim_speed_m_s = [1, 2, 3, 11]",
            "`drive.rim_speed_m_s.3` is 11, it must be -10 to 10",
        ),
        ("drive.rim_speed_m_s = \"fast\"", "it must be a number or a list"),
        ("drive = { law = \"eq18\", ground_speed_m_s = 0 }", "it must be above 0 and at most 10"),
        ("drive = { law = \"eq-18\" }", "did you mean \"eq18\"?"),
        ("drive = { reference_slip_ratio = 0.1 }", "unknown key `drive.reference_slip_ratio`"),
        ("start.yaw_deg = inf", "`start.yaw_deg`"),
        ("soil = \"hakuto\"", "there is no soil preset and no file called `hakuto`"),
        ("[soil]\ndensity_kg_m3 = 1500", "`soil.friction_angle_deg` is missing"),
        ("[rover.wheel_unit.wheel]\nradius = 1", "did you mean `radius_m`?"),
    ] {
        let error = fail(Kind::Scenario, &format!("schema = \"scenario/1\"\n{lines}\n"));
        assert!(error.to_string().contains(message), "`{lines}`: {error}");
        assert!(error.to_string().starts_with("bad.toml:"), "`{lines}`: {error}");
    }
}

/// A number outside its range names the range, at both ends of every range of every preset.
#[test]
fn every_end_of_every_range_is_kept() {
    let mut ends = 0;
    for preset in all_presets() {
        let resolved = read(preset.kind, &Source::Preset(preset), &Overrides::none());
        let resolved = resolved.expect("it is read").resolved;
        let table: toml::Table = resolved.parse().expect("it is TOML");
        visit_numbers(&toml::Value::Table(table), "", &mut |path| {
            // What is free has the range of the key that it is of.
            if preset.kind == Kind::Design && path.starts_with("free.") {
                return;
            }
            let schema_path = path.split('.').filter(|step| step.parse::<usize>().is_err());
            let key = schema_path.collect::<Vec<_>>().join(".");
            let range = document::range(preset.kind, &key);
            let range = range.unwrap_or_else(|| panic!("{} has no range of {key}", preset.name));
            for value in [range.start() - 1.0, range.end() * 1.01 + 1.0] {
                let whole = if key.ends_with("count") { value.round() } else { value };
                let setting = format!("{}.{path}={whole}", preset.kind);
                let overrides = Overrides::parse([&setting]).expect("it is a value");
                let error = read(preset.kind, &Source::text("resolved", &resolved), &overrides);
                let error = error.expect_err(&setting);
                let is_out_of_range = matches!(error.problem(), Problem::OutOfRange { .. });
                assert!(is_out_of_range, "{}: {error}", preset.name);
                ends += 1;
            }
        });
    }
    assert!(ends > 500, "only {ends} ends were tried");
}

fn visit_numbers(value: &toml::Value, path: &str, visit: &mut dyn FnMut(&str)) {
    let join = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
    match value {
        toml::Value::Float(_) | toml::Value::Integer(_) => visit(path),
        toml::Value::Table(table) => {
            table.iter().for_each(|(key, value)| visit_numbers(value, &join(key), visit));
        }
        toml::Value::Array(values) => {
            for (index, value) in values.iter().enumerate() {
                visit_numbers(value, &join(&index.to_string()), visit);
            }
        }
        _ => {}
    }
}

// ---- Files ----

/// A folder of its own for a test, removed afterwards.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    pub(crate) fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("grouser-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).expect("a folder can be made");
        Self(path)
    }

    pub(crate) fn file(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::create_dir_all(path.parent().expect("it has one")).expect("a folder can be made");
        fs::write(&path, content).expect("a file can be written");
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What is left over in the temporary folder does no harm.
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn files_that_are_no_documents_are_told_apart() {
    let folder = Folder::new("no-documents");
    let deep =
        |open: &str, close: &str| format!("a = {}{}", open.repeat(70_000), close.repeat(70_000));
    let table = format!("{{ {}a = ", "a.".repeat(75));
    let dotted_tables = format!("x = {}1{}", table.repeat(75), "}".repeat(75));
    for (name, content, message) in [
        ("empty.toml", b"".to_vec(), "is empty"),
        ("comment.toml", b"# nothing\n".to_vec(), "is empty"),
        (
            "binary.toml",
            vec![0x7f, b'E', b'L', b'F', 0xff, 0xfe],
            "is not a text: no UTF-8 after byte 4",
        ),
        ("zeros.toml", vec![0; 64], "not TOML"),
        ("huge.toml", vec![b'#'; 1 << 21], "is larger than 1048576 bytes"),
        ("arrays.toml", deep("[", "]").into_bytes(), "nested more than 16 levels deep"),
        ("tables.toml", deep("{a=", "}").into_bytes(), "nested more than 16 levels deep"),
        ("both.toml", dotted_tables.into_bytes(), "nested more than 16 levels deep"),
        ("keys.toml", format!("{}a = 1", "a.".repeat(70)).into_bytes(), "nested more than 16"),
        ("long-key.toml", format!("{}a = 1", "a.".repeat(300_000)).into_bytes(), "recursion"),
    ] {
        let path = folder.file(name, content);
        let error = document::check(&Source::file(&path)).expect_err(name);
        let told = error.to_string();
        assert!(told.contains(message) && told.contains(name), "{name}: {told}");
        assert!(!error.is_environment(), "{told}");
        assert!(told.lines().all(|line| line.chars().count() < 300), "{name}: {told}");
    }
    let error = document::check(&Source::file(&folder.0)).expect_err("a folder");
    assert!(error.to_string().contains("this is a folder, not a file"), "{error}");
    assert!(!error.is_environment());
    let error = document::check(&Source::file(folder.0.join("none.toml"))).expect_err("nothing");
    assert_eq!(error.problem(), &Problem::NoSuchFile);
    assert!(!error.is_environment());
}

#[cfg(unix)]
#[test]
fn a_refused_permission_is_the_environments_fault() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new("permission");
    let path = folder.file("closed.toml", "schema = \"soil/1\"");
    fs::set_permissions(&path, fs::Permissions::from_mode(0o000)).expect("it is ours");
    // The superuser may read everything.
    if fs::read(&path).is_err() {
        let error = document::check(&Source::file(&path)).expect_err("it is closed");
        assert!(error.is_environment(), "{error}");
        assert!(error.to_string().contains("cannot be read"), "{error}");
    }
}

#[test]
fn paths_start_from_the_folder_of_the_document_that_names_them() {
    let folder = Folder::new("paths");
    let text = |kind, name| document::preset(kind, name).expect("a preset").text;
    folder.file("parts/wheel.toml", text(Kind::Wheel, "jfr-2007"));
    let rover = changed(Kind::Rover, "hakuto", "wheel = \"hakuto\"", "wheel = \"wheel.toml\"");
    folder.file("parts/rover.toml", rover);
    let run = "schema = \"scenario/1\"\nrover = \"parts/rover.toml\"\n";
    let path = folder.file("run.toml", run);
    let run = document::read_scenario(&Source::file(&path), &Overrides::none());
    let run = run.expect("all parts are found");
    assert_eq!(run.value.rover.mounts()[0].unit.wheel, wheel("jfr-2007"));
    assert_eq!(document::check(&Source::file(&path)), Ok(Kind::Scenario));

    folder.file("parts/wheel.toml", text(Kind::Wheel, "jfr-2007").replace("0.092", "9.2"));
    let error = document::check(&Source::file(&path)).expect_err("the wheel is too large");
    assert!(error.place().document.ends_with("wheel.toml"), "{error}");
    assert!(error.to_string().contains("`rover.wheel_unit.wheel.radius_m` is 9.2"), "{error}");
    fs::remove_file(folder.0.join("parts/wheel.toml")).expect("it is ours");
    let error = document::check(&Source::file(&path)).expect_err("the wheel is gone");
    assert!(error.place().document.ends_with("rover.toml"), "{error}");
    assert!(error.to_string().contains("hint: looked for"), "{error}");
}

#[test]
fn what_a_document_leaves_out_is_out_of_range() {
    let text = "schema = \"soil/1\"\ncohesion_kpa = 1\nfriction_angle_deg = 30\n\
                density_kg_m3 = 1500\npressure_sinkage = { law = \"bekker\", k_c = 0, k_phi = 1e6, n = 1 }\n\
                stress_peak = { a0 = 0.4, a1 = 0.15 }\n\
                shear = { law = \"isotropic\", longitudinal_m = 0.02 }\n";
    let loaded = document::read_soil(&Source::text("short", text), &Overrides::none());
    let loaded = loaded.expect("all that is needed is there");
    let Exit::Ratio(ratio) = loaded.value.exit else { panic!("it is one number") };
    assert!((ratio - 0.293).abs() < 5e-4, "{ratio}");
    assert_eq!(loaded.value.bulldozing, Bulldozing::Sine);
    for key in ["exit.ratio", "shear.longitudinal_per_rad_m", "bulldozing.law", "source"] {
        let start = format!("soil unnamed: {key}: not");
        assert!(loaded.assumptions.iter().any(|one| one.starts_with(&start)), "{key}");
    }
}

// ---- Schema ----

/// The schemas in `schema/` are those of this code. To write them anew, run this test with
/// `GROUSER_WRITE_SCHEMA=1`.
#[test]
fn the_checked_in_schemas_are_fresh() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../schema");
    for kind in Kind::ALL {
        let path = folder.join(format!("{kind}.json"));
        let made = document::schema(kind);
        if std::env::var_os("GROUSER_WRITE_SCHEMA").is_some() {
            fs::write(&path, &made).expect("the schema can be written");
        }
        let checked_in = fs::read_to_string(&path).unwrap_or_default();
        assert!(made == checked_in, "schema/{kind}.json is stale");
    }
}

/// Every key that takes a number says its range and, like all keys, what it is.
#[test]
fn every_key_of_the_schemas_is_described() {
    for kind in Kind::ALL {
        let schema: Value = serde_json::from_str(&document::schema(kind)).expect("it is JSON");
        check_described(&schema, kind.name());
    }
}

fn check_described(schema: &Value, place: &str) {
    for (key, property) in schema["properties"].as_object().into_iter().flatten() {
        // A key that chooses among tables is described by them.
        let is_law = key == "law" || property["const"].is_string();
        assert!(is_law || property["description"].is_string(), "{place}: {key} is not described");
    }
    if schema["type"] == "number" || schema["type"] == "integer" {
        let has = |names: [&str; 2]| names.iter().any(|name| schema[*name].is_number());
        assert!(has(["minimum", "exclusiveMinimum"]), "{place} has no lower end");
        assert!(has(["maximum", "exclusiveMaximum"]), "{place} has no upper end");
    }
    match schema {
        Value::Object(table) => {
            let children = table.iter().filter(|(key, _)| *key != "default");
            children.for_each(|(key, child)| check_described(child, &format!("{place}/{key}")));
        }
        Value::Array(list) => list.iter().for_each(|child| check_described(child, place)),
        _ => {}
    }
}

// ---- Anything at all ----

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn arbitrary_text_never_panics(text in ".{0,400}") {
        for kind in Kind::ALL {
            let _ = read(kind, &Source::text("any", &text), &Overrides::none());
        }
        let _ = Overrides::parse([format!("soil.{text}")]);
        let _ = Overrides::parse([&text]);
    }

    #[test]
    fn arbitrary_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        let folder = Folder::new("bytes");
        let error = document::check(&Source::file(folder.file("any.toml", bytes)));
        prop_assert!(error.is_err());
        let _ = error.map_err(|error| error.to_string());
    }

    /// What still can be read after a change means the same when it is written and read again.
    #[test]
    fn changed_presets_never_panic(
        which in any::<prop::sample::Index>(),
        at in any::<prop::sample::Index>(),
        length in 0_usize..12,
        piece in "([0-9.eE+-]{0,6}|[\\[\\]{}=\"'.,\n#a-z_µ]{0,6}|nan|inf|-1e400)",
    ) {
        let presets: Vec<_> = all_presets().collect();
        let preset = presets[which.index(presets.len())];
        let chars: Vec<char> = preset.text.chars().collect();
        let start = at.index(chars.len());
        let end = (start + length).min(chars.len());
        let text: String = chars[..start].iter().chain(&piece.chars().collect::<Vec<_>>())
            .chain(&chars[end..]).collect();
        match read(preset.kind, &Source::text("changed", &text), &Overrides::none()) {
            Ok(first) => {
                let again = Source::text("resolved", &first.resolved);
                let second = read(preset.kind, &again, &Overrides::none());
                prop_assert_eq!(second.map(|read| read.meaning), Ok(first.meaning));
            }
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }
}
