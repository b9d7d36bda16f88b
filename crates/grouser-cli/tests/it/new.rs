//! `grouser new`: documents of one's own, from flags and from a terminal.

use std::fs;

use crate::program::Place;

#[test]
fn a_rover_from_flags_passes_the_check_and_drives() {
    let place = Place::new();
    let line = "new rover Grasshopper --yes --set total_mass_kg=12 --set track_m=0.5 --set \
                wheelbase_m=0.55";
    let text = place.results(line);
    insta::assert_snapshot!("new_rover", text);
    insta::assert_snapshot!("new_rover_document", place.read("grasshopper.toml"));
    assert!(place.results("check grasshopper.toml").contains("a valid rover document"));
    // The next command is the one that the output names.
    assert!(text.ends_with("next: grouser heading --rover grasshopper.toml\n"), "{text}");
    let heading = place.results("heading --rover grasshopper.toml --slope-deg 5 --nominal");
    assert!(heading.contains("  ok"), "{heading}");
}

/// A soil like a preset is not the preset: what is of its own tests is left out, and named.
#[test]
fn what_is_not_taken_from_a_preset_is_said() {
    let place = Place::new();
    let text = place.results("new soil --yes --set like=toyoura-uncertain");
    let line =
        "not taken from the preset, as it is of its own tests: domain, uncertainty, priors\n";
    assert!(text.contains(line), "{text}");
    let document = place.read("my-soil.toml");
    assert!(
        document.contains("# Not taken from `toyoura-uncertain`: domain, uncertainty, priors.\n")
    );
}

/// Without a terminal nothing is asked; every next command runs.
#[test]
fn every_kind_passes_the_check_and_its_next_command_runs() {
    for kind in ["rover", "wheel", "soil", "scenario", "mission"] {
        let place = Place::new();
        let text = place.results(&format!("new {kind}"));
        assert!(text.contains("  not answered: name = my "), "{text}");
        let next = text.lines().last().and_then(|line| line.strip_prefix("next: grouser "));
        let next = next.unwrap_or_else(|| panic!("{kind}: {text}")).to_owned();
        assert!(place.results(&format!("check my-{kind}.toml")).contains("a valid"), "{kind}");
        // A wheel is tested under some load.
        let next = if next.starts_with("wheel-test") {
            next + " --load-n 20 --slip-ratio 0.2"
        } else {
            next
        };
        assert!(!place.results(&next).is_empty(), "{kind}");
    }
}

#[test]
fn a_file_is_replaced_with_force_alone() {
    let place = Place::new();
    place.write("mine.toml", "precious");
    for line in ["new wheel --out mine.toml", "new wheel Mine", "new rover mine --yes"] {
        let answer = place.line(line);
        assert_eq!(answer.code(), 2, "{line}");
        assert!(answer.stderr.contains("mine.toml exists already"), "{}", answer.stderr);
    }
    assert_eq!(place.read("mine.toml"), "precious");
    place.results("new wheel Mine --force");
    assert!(place.read("mine.toml").contains("name = \"Mine\""));
}

/// Nothing is written where an answer is invalid, and the message says which.
#[test]
fn hostile_answers_write_nothing() {
    let place = Place::new();
    for (line, message) in [
        (
            "new rover x --set total_mass_kg=heavy",
            "`total_mass_kg` is the text \"heavy\", it must be a number",
        ),
        ("new rover x --set total_mass_kg=nan", "it must be a finite number"),
        ("new rover x --set total_mass_kg=1e9", "it must be 0.1 to 100000"),
        ("new rover x --set total_mass=3", "did you mean `total_mass_kg`?"),
        ("new rover x --set total_mass_kg", "--set total_mass_kg: not of the form KEY=VALUE"),
        (
            "new rover x --set wheel_unit.mass_kg=9",
            "4 wheels of 9 kg are 36 kg, the rover has 10 kg",
        ),
        ("new soil x --set like=tojoura", "did you mean `toyoura`?"),
        ("new scenario x --set rover=nowhere", "nowhere"),
        ("new rover x --out missing/rover.toml", "cannot write"),
        ("new prior x", "invalid value 'prior'"),
    ] {
        let answer = place.line(line);
        assert_ne!(answer.code(), 0, "{line}");
        assert!(answer.stderr.contains(message), "{line}: {}", answer.stderr);
    }
    assert_eq!(place.names(), [""; 0]);
}

/// A scenario's files are found from its own folder, or it is not left there.
#[test]
fn a_scenario_elsewhere_names_files_from_its_folder() {
    let place = Place::new();
    place.results("new rover hopper");
    fs::create_dir(place.file("runs")).expect("a folder");
    let answer = place.line("new scenario --set rover=hopper.toml --out runs/first.toml");
    assert_eq!(answer.code(), 2, "{}", answer.stderr);
    assert!(!place.file("runs/first.toml").exists());
    place.results("new scenario --set rover=hopper.toml --out first.toml");
}

#[test]
fn questions_are_listed() {
    insta::assert_snapshot!(
        "new_questions",
        Place::new().results("new rover --questions --width 100")
    );
}

/// Typed into a pseudo-terminal: asked, asked again, answered, written.
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_is_asked() {
    use std::io::Write as _;
    use std::process::{Command, Stdio};
    let place = Place::new();
    let line = format!("{} new wheel --color never", crate::program::GROUSER);
    let mut script = Command::new("script");
    script.args(["-qec", &line, "/dev/null"]).current_dir(place.path());
    script.env("TERM", "xterm").stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = script.spawn().expect("script of util-linux");
    let mut typed = child.stdin.take().expect("it is piped");
    typed.write_all(b"Disc\nmine\nwide\n0.12\n\n0\n").expect("it is read");
    let output = child.wait_with_output().expect("it ends");
    drop(typed);
    let shown = String::from_utf8_lossy(&output.stdout).replace("\r\n", "\n");
    assert!(
        shown.contains("radius_m: Radius of the rim, without grousers, r [m]. (0.01 to 1)"),
        "{shown}"
    );
    assert!(shown.contains("it must be a number"), "{shown}");
    assert!(shown.contains("next: grouser wheel-test --wheel disc.toml"), "{shown}");
    assert!(place.read("disc.toml").contains("radius_m = 0.12\n"), "{shown}");
}
