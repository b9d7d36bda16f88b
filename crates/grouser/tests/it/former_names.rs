//! Keys, keywords and presets of earlier versions mean what they meant.

use grouser::document::{self, Kind, Overrides, Source};

/// A small wheel's soil by the names of version 0.1.
const FORMER_SOIL: &str = r#"
model = "extended"
[extended.rim]
friction_angle_deg = 19.0
[extended.flank]
friction = 0.28
[extended.heap]
front = 2.1
behind = 1.2
"#;

fn scenario(lines: &str, overrides: &[&str]) -> String {
    let text = format!("schema = \"scenario/1\"\n{lines}\n");
    let overrides = Overrides::parse(overrides).expect("keys with values");
    match document::read_scenario(&Source::text("run.toml", text), &overrides) {
        Ok(loaded) => loaded.to_toml(),
        Err(error) => panic!("{lines} {overrides:?}: {error}"),
    }
}

#[test]
fn a_scenario_by_former_names_is_the_same_scenario() {
    for (former, today) in [
        ("loads = \"uniform\"", "load_transfer = \"uniform\""),
        ("moments = \"included\"", "wheel_moments = \"included\""),
        ("drive.speed_m_s = 0.03", "drive.rim_speed_m_s = 0.03"),
        ("drive.speed_m_s = [0, 1, 2, 3]", "drive.rim_speed_m_s = [0, 1, 2, 3]"),
        (
            "drive = { law = \"eq18\", speed_m_s = 0.03 }",
            "drive = { law = \"eq18\", ground_speed_m_s = 0.03 }",
        ),
        ("model = \"extended\"", "model = \"small-wheel\""),
    ] {
        assert_eq!(scenario(former, &[]), scenario(today, &[]), "{former}");
    }
}

#[test]
fn a_setting_by_a_former_name_is_the_same_setting() {
    for (former, today) in [
        (vec!["scenario.loads=uniform"], vec!["scenario.load_transfer=uniform"]),
        (vec!["scenario.moments=included"], vec!["scenario.wheel_moments=included"]),
        (vec!["scenario.drive.speed_m_s=0.03"], vec!["scenario.drive.rim_speed_m_s=0.03"]),
        (vec!["scenario.model=extended"], vec!["scenario.model=small-wheel"]),
        (vec!["soil.extended.heap.front=2"], vec!["soil.small_wheel.mounds.bow_wave=2"]),
        // Which law the drive follows is known whatever is set first.
        (
            vec!["scenario.drive.speed_m_s=0.03", "scenario.drive.law=eq18"],
            vec!["scenario.drive.law=eq18", "scenario.drive.ground_speed_m_s=0.03"],
        ),
    ] {
        let written = |text: String| {
            // The notes on what was set quote the setting itself.
            text.lines().filter(|line| !line.contains("set to")).collect::<Vec<_>>().join("\n")
        };
        assert_eq!(written(scenario("", &former)), written(scenario("", &today)), "{former:?}");
    }
}

#[test]
fn a_soil_by_former_names_is_the_same_soil() {
    let toyoura = document::preset(Kind::Soil, "toyoura").expect("a preset").text;
    let (root, tables) = FORMER_SOIL.split_once("[extended").expect("tables after the root");
    // The root names a model of its own.
    let unnamed = toyoura.lines().filter(|line| !line.starts_with("model = "));
    let toyoura: String = unnamed.flat_map(|line| [line, "\n"]).collect();
    let former = format!("{root}{toyoura}[extended{tables}");
    let today = former
        .replace("\"extended\"", "\"small-wheel\"")
        .replace("extended.rim", "small_wheel.interface")
        .replace("extended.flank", "small_wheel.side_wall")
        .replace("extended.heap", "small_wheel.mounds")
        .replace("front = ", "bow_wave = ")
        .replace("behind = ", "rear_mound = ");
    let read = |text: &str| {
        document::read_soil(&Source::text("sand.toml", text.to_owned()), &Overrides::none())
            .unwrap_or_else(|error| panic!("{error}"))
    };
    let (former, today) = (read(&former), read(&today));
    assert_eq!(former.to_toml(), today.to_toml());
    assert_eq!(former.value, today.value);
    // Looked at by either name.
    let path = ["extended.flank.friction", "small_wheel.side_wall.friction"];
    assert_eq!(path.map(|path| former.document.number(path)), [Some(0.28); 2]);
}

#[test]
fn a_key_by_both_its_names_is_an_error() {
    let text = "schema = \"scenario/1\"\nloads = \"uniform\"\nload_transfer = \"uniform\"\n";
    let error = document::read_scenario(&Source::text("run.toml", text), &Overrides::none())
        .expect_err("it says it twice");
    let message = "run.toml:2:1: `loads` is the former name of `load_transfer`, which is given too";
    assert!(error.to_string().contains(message), "{error}");
    let text = "schema = \"scenario/1\"\ndrive = { speed_m_s = 0.1, rim_speed_m_s = 0.1 }\n";
    let error = document::read_scenario(&Source::text("run.toml", text), &Overrides::none())
        .expect_err("it says it twice");
    let message = "`drive.speed_m_s` is the former name of `drive.rim_speed_m_s`";
    assert!(error.to_string().contains(message), "{error}");
}

#[test]
fn a_campaign_and_its_preset_by_former_names() {
    let preset = document::preset(Kind::Campaign, "campaign-heading").expect("a preset");
    assert_eq!(document::preset(Kind::Campaign, "campaign-attitude"), Some(preset));
    let text = preset.text;
    let read = |text: String| {
        let source = Source::text("study.toml", text);
        let campaign = document::read_campaign(&source, &Overrides::none());
        campaign.unwrap_or_else(|error| panic!("{error}")).resolved().to_owned()
    };
    let former = text.replace("\"heading\"", "\"attitude\"");
    assert_ne!(former, text);
    assert_eq!(read(former), read(text.to_owned()));
}
