//! Withdrawn keys, keywords and presets are refused, with the present name as a hint.

use grouser::document::{self, Kind, Overrides, Source};

/// The message about a document with some lines and settings, which is wrong.
fn message(kind: Kind, lines: &str, settings: &[&str]) -> String {
    let source = Source::text("given.toml", format!("schema = \"{kind}/1\"\n{lines}\n"));
    let overrides = Overrides::parse(settings);
    let read = overrides.and_then(|overrides| match kind {
        Kind::Mission => document::read_mission(&source, &overrides).map(drop),
        Kind::Campaign => document::read_campaign(&source, &overrides).map(drop),
        _ => document::read_scenario(&source, &overrides).map(drop),
    });
    read.expect_err(lines).to_string()
}

#[test]
fn a_document_says_where_and_what_is_meant() {
    let stop = "slope_deg = 0.0\n[[leg]]\ndrive_m = 1.0\n[stop]\nsinkage_ratio = { above = 0.3 }";
    for (kind, lines, place, hint) in [
        (Kind::Scenario, "loads = \"uniform\"", "2:1: unknown key `loads`", "`load_transfer`"),
        (Kind::Scenario, "moments = \"included\"", "2:1: unknown key `moments`", "`wheel_moments`"),
        (Kind::Scenario, "drive.speed_m_s = 0.03", "`drive.speed_m_s`", "`rim_speed_m_s`"),
        (
            Kind::Scenario,
            "drive = { law = \"eq18\", speed_m_s = 0.03 }",
            "`drive.speed_m_s`",
            "`ground_speed_m_s`",
        ),
        (Kind::Scenario, "model = \"extended\"", "`model` is \"extended\"", "\"small-wheel\""),
        (Kind::Scenario, "speed_m_s = 0.03", "unknown key `speed_m_s`", "`drive.rim_speed_m_s`"),
        (Kind::Mission, stop, "6:1: unknown key `stop.sinkage_ratio`", "`sinkage_over_radius`"),
        (Kind::Campaign, "study = \"attitude\"", "`study` is \"attitude\"", "\"heading\""),
    ] {
        let message = message(kind, lines, &[]);
        assert!(message.contains("given.toml:") && message.contains(place), "{message}");
        assert!(message.contains(&format!("did you mean {hint}")), "{message}");
    }
}

#[test]
fn a_setting_says_what_is_meant() {
    for (setting, hint) in [
        ("scenario.loads=uniform", "`load_transfer`"),
        ("scenario.drive.speed_m_s=0.03", "`rim_speed_m_s`"),
        ("soil.extended.heap.front=2", "`small_wheel`"),
        ("soil.small_wheel.mounds.behind=2", "`rear_mound`"),
    ] {
        let message = message(Kind::Scenario, "", &[setting]);
        assert!(message.contains(&format!("did you mean {hint}?")), "{message}");
    }
}

/// A drive keeps its speed under another law, of the rims or over the ground.
#[test]
fn a_speed_stays_under_another_law() {
    let text = "schema = \"scenario/1\"\ndrive.rim_speed_m_s = 0.04\n";
    let overrides = Overrides::parse(["scenario.drive.law=eq18"]).expect("a key with a value");
    let loaded = document::read_scenario(&Source::text("run.toml", text), &overrides);
    let document = loaded.expect("it is a scenario").document;
    assert_eq!(document.number("drive.ground_speed_m_s"), Some(0.04));
}

#[test]
fn a_preset_is_not_found_by_its_withdrawn_name() {
    assert_eq!(document::preset(Kind::Campaign, "campaign-attitude"), None);
    let error = Source::find(Kind::Campaign, "campaign-attitude").expect_err("it is withdrawn");
    assert!(error.to_string().contains("`campaign-heading`"), "{error}");
}
