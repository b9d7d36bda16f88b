//! What is wrong is said once and clearly, with exit code 2 (1 where the disk or its permissions
//! failed), and leaves nothing behind.

use insta::assert_snapshot;

use crate::program::{Answer, Place, changed_preset};

/// Asks for things that cannot be had; the conversations are one snapshot.
pub(crate) fn check_refused(name: &str, place: &Place, lines: &[&[&str]]) {
    let before = place.names();
    let refused = |line: &&[&str]| check_is_refusal(&place.run(line), 2);
    let conversations: Vec<String> = lines.iter().map(refused).collect();
    assert_snapshot!(name, conversations.join("\n"));
    assert_eq!(place.names(), before, "something was left behind");
}

/// Checks that nothing was printed but one message; returns the conversation.
pub(crate) fn check_is_refusal(answer: &Answer, code: i32) -> String {
    let conversation = answer.conversation();
    assert_eq!(answer.code(), code, "{conversation}");
    assert_eq!(answer.stdout, "", "{conversation}");
    assert_eq!(answer.stderr.matches("error: ").count(), 1, "{conversation}");
    conversation
}

/// Lines whose words have no blanks in them.
pub(crate) fn check_lines_refused(name: &str, place: &Place, lines: &[&str]) {
    let words: Vec<Vec<&str>> = lines.iter().map(|line| line.split(' ').collect()).collect();
    let lines: Vec<&[&str]> = words.iter().map(Vec::as_slice).collect();
    check_refused(name, place, &lines);
}

// ---- Flags ----

#[test]
fn wrong_commands_and_flags() {
    check_lines_refused(
        "commands-and-flags",
        &Place::new(),
        &[
            "wheeltest",
            "wheel-test --slip-ratoi 0",
            "wheel-test extra",
            "wheel-test --format yaml",
            "wheel-test --slip-ratio",
            "check",
            "schema soils",
            "completions tcsh",
            "traverse one two",
        ],
    );
}

#[test]
fn rules_of_a_card() {
    check_lines_refused(
        "cards",
        &Place::new(),
        &[
            "card --go-slip-ratio 0.7",
            "card --go-slip-ratio -0.1",
            "card --no-go-probability 0.01",
            "card --go-probability 1,2",
            "card --rim-speed-m-s 0",
            "card --samples 1",
            "card --set scenario.slope_deg=5",
            "card --out card.docx",
            "card --force",
        ],
    );
}

#[test]
fn numbers_out_of_range() {
    check_lines_refused(
        "numbers-out-of-range",
        &Place::new(),
        &[
            "wheel-test --load-n -1",
            "wheel-test --load-n 1e6",
            "wheel-test --slip-ratio 3",
            "wheel-test --slip-angle-deg 91",
            "wheel-test --gravity-m-s2 0",
            "wheel-test --trials 0",
            "wheel-test --trials 2 --noise-n -1",
            "wheel-test --trials 2 --noise-mm nan",
            "wheel-test --trials 2 --noise-nm 1e6",
            "attitude --slope-deg 61",
            "attitude --slope-deg -5",
            "attitude --gravity-m-s2 -9.8",
            "traverse --slope-deg 61",
            "traverse --yaw-deg 2e9",
            "traverse --duration-s 0",
            "traverse --duration-s 1e9",
            "traverse --duration-s -20",
            "traverse --rim-speed-m-s 20",
            "traverse --gravity-m-s2 -1",
            "traverse --drive eq18 --reference-slip-ratio 1",
        ],
    );
}

#[test]
fn what_is_no_number() {
    check_refused(
        "no-numbers",
        &Place::new(),
        &[
            &["wheel-test", "--slip-ratio", "nan"],
            &["wheel-test", "--slip-ratio", "-inf"],
            &["wheel-test", "--slip-ratio", "0:nan:0.1"],
            &["wheel-test", "--slip-ratio", ""],
            &["wheel-test", "--load-n", "5,,10"],
            &["wheel-test", "--load-n", "17N"],
            &["wheel-test", "--slip-ratio", "0:1"],
            &["wheel-test", "--slip-ratio", "0:1:0"],
            &["wheel-test", "--slip-ratio", "0:1:-0.1"],
            &["wheel-test", "--gravity-m-s2", "monn"],
            &["wheel-test", "--gravity-m-s2", "g"],
            &["attitude", "--gravity-m-s2", "NaN"],
            &["traverse", "--slope-deg", "nan"],
            &["traverse", "--slope-deg", "steep"],
            &["traverse", "--slope-deg", "5,10"],
            &["traverse", "--slope-deg", ""],
            &["traverse", "--duration-s", "inf"],
            &["traverse", "--rim-speed-m-s", "0.06,fast"],
            &["traverse", "--yaw-deg", "1e400"],
        ],
    );
}

#[test]
fn more_than_anyone_can_have_meant() {
    check_lines_refused(
        "too-much",
        &Place::new(),
        &[
            "wheel-test --slip-ratio 0:1:1e-9",
            "wheel-test --slip-ratio 0:1:1e-5 --load-n 0:100:1e-3",
            "traverse --duration-s 86400 --set scenario.sample_interval_s=0.001",
        ],
    );
}

#[test]
fn unknown_names_and_words() {
    check_refused(
        "unknown-names",
        &Place::new(),
        &[
            &["wheel-test", "--soil", "toyora"],
            &["wheel-test", "--soil", "moon dust"],
            &["wheel-test", "--soil", ""],
            &["wheel-test", "--wheel", "toyoura"],
            &["wheel-test", "--soil", "no/such/file.toml"],
            &["wheel-test", "--model", "bekkr"],
            &["attitude", "--rover", "hakutto"],
            &["attitude", "--load-transfer", "static"],
            &["traverse", "nothing"],
            &["traverse", "--soil", "toyora"],
            &["traverse", "--soil", "sand.toml"],
            &["traverse", "--drive", "eq19"],
            &["traverse", "--start", "rolled"],
            &["traverse", "--wheel-moments", "yes"],
            &["presets", "toyora"],
            &["presets", "xyzzy"],
            &["presets", "toyoura", "--kind", "rover"],
        ],
    );
}

#[test]
fn contradictory_flags() {
    check_lines_refused(
        "contradictions",
        &Place::new(),
        &[
            "traverse --drive eq18 --ground-speed-m-s 0.06,0.06,0.06,0.06",
            "traverse skid-steered-arc --drive eq18",
            "traverse --rim-speed-m-s 0.06,0.06",
            "traverse --reference-slip-ratio 0.2",
            "traverse --force",
            "wheel-test --seed 3",
            "reproduce --force",
            "presets toyoura --format json",
            "attitude --set scenario.slope_deg=4",
            "wheel-test --set rover.body.mass_kg=6",
        ],
    );
}

#[test]
fn wrong_settings() {
    check_refused(
        "settings",
        &Place::new(),
        &[
            &["traverse", "--set", "soil.cohesion_kpa"],
            &["traverse", "--set", "soil.cohesion_kpa="],
            &["traverse", "--set", "soil.cohesion=1"],
            &["traverse", "--set", "sol.cohesion_kpa=1"],
            &["traverse", "--set", "cohesion_kpa=1"],
            &["traverse", "--set", "soil=toyoura"],
            &["traverse", "--set", "soil..x=1"],
            &["traverse", "--set", "=1"],
            &["traverse", "--set", ""],
            &["traverse", "--set", "soil.cohesion_kpa=much"],
            &["traverse", "--set", "soil.cohesion_kpa=\"1\""],
            &["traverse", "--set", "soil.cohesion_kpa=[1, 2]"],
            &["traverse", "--set", "soil.cohesion_kpa=[1"],
            &["traverse", "--set", "soil.cohesion_kpa=nan"],
            &["traverse", "--set", "soil.density_kg_m3=1e400"],
            &["traverse", "--set", "soil.friction_angle_deg=61"],
            &["traverse", "--set", "soil.n=1"],
            &["traverse", "--set", "soil.cohesion_kpa.x=1"],
            &["traverse", "--set", "rover.body.mass_kg=0"],
            &["traverse", "--set", "rover.mount.7.name=x"],
            &["traverse", "--set", "scenario.gravity_m_s2=-9.81"],
            &["traverse", "--set", "scenario.soil.cohesion_kpa=101"],
            &["traverse", "--set", "wheel.grousers.count=1.5"],
        ],
    );
}

// ---- Documents ----

/// Puts a changed preset into the folder.
fn put(place: &Place, file: &str, kind: &str, name: &str, from: &str, to: &str) {
    place.write(file, changed_preset(kind, name, from, to));
}

#[test]
fn wrong_soils() {
    let place = Place::new();
    for (file, from, to) in [
        ("misspelt", "cohesion_kpa ", "cohesion_pka "),
        ("misspelt-table", "[stress_peak]", "[stress_peek]"),
        ("unknown", "cohesion_kpa ", "colour "),
        ("text", "= 38.0", "= \"38\""),
        ("list", "= 38.0", "= [38.0]"),
        ("range", "= 38.0", "= 380.0"),
        ("nan", "= 38.0", "= nan"),
        ("infinite", "= 38.0", "= -inf"),
        ("overflow", "= 38.0", "= 1e400"),
        ("no-value", "= 38.0", "= "),
        ("comma", "= 38.0", "= 38,0"),
        ("word", "\"reece\"", "\"rece\""),
        ("law", "\"anisotropic\"", "\"isotropic\""),
        ("missing", "friction_angle_deg ", "#"),
        ("twice", "density_kg_m3 ", "cohesion_kpa "),
        ("no-schema", "schema", "# schema"),
        ("version", "soil/1", "soil/2"),
        ("kind", "soil/1", "wheel/1"),
        ("modulus", "longitudinal_m         = 0.036", "longitudinal_m = 0"),
    ] {
        put(&place, &format!("{file}.toml"), "soil", "toyoura", from, to);
    }
    let lines: Vec<String> = place
        .names()
        .iter()
        .map(|name| format!("wheel-test --slip-ratio 0 --soil {name}"))
        .collect();
    let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
    check_lines_refused("soils", &place, &lines);
}

#[test]
fn wrong_uncertainties() {
    let place = Place::new();
    let soil = |file: &str, section: &str| {
        let text = changed_preset("soil", "toyoura", "schema", "schema");
        place.write(&format!("{file}.toml"), format!("{text}\n{section}\n"));
    };
    let angle = "[[uncertainty.parameter]]\nkey = \"friction_angle_deg\"\nstandard_deviation = ";
    let modulus = "[[uncertainty.parameter]]\nkey = \"exit.ratio\"\nstandard_deviation = 0.1\n";
    soil("unknown", &format!("{}1", angle.replace("_deg", "")));
    soil("negative", &format!("{angle}-1"));
    soil("far", &format!("{angle}1e9"));
    soil("twice", &format!("{angle}1\n{angle}2"));
    soil(
        "whole",
        &format!(
            "{angle}1\n{modulus}[[uncertainty.correlation]]\n\
             between = [\"friction_angle_deg\", \"exit.ratio\"]\nvalue = -1"
        ),
    );
    soil("no-samples", "[uncertainty]\nsamples = \"none.csv\"");
    soil("bad-samples", "[uncertainty]\nsamples = \"samples.csv\"");
    place.write("samples.csv", "friction_angle_deg,exit.ratio\n38,1.0\n38,high\n");
    soil("good-samples", "[uncertainty]\nsamples = \"good.csv\"");
    place.write("good.csv", "friction_angle_deg,exit.ratio\n38,1.0\n37,0.9\n");
    check_lines_refused(
        "uncertainties",
        &place,
        &[
            "check unknown.toml",
            "attitude --soil negative.toml",
            "attitude --soil far.toml --uncertainty",
            "check twice.toml",
            "check whole.toml",
            "check no-samples.toml",
            "check bad-samples.toml",
            "attitude --seed 2 --nominal",
            "wheel-test --seed 2",
            "wheel-test --uncertainty --trials 2",
            "card --model all",
            "attitude --uncertainty --samples 1",
            "attitude --uncertainty --samples 1000000",
            "attitude --uncertainty --samples many",
            "attitude --uncertainty --seed -1",
            "attitude --soil toyoura-uncertain --uncertainty --samples 100000 --slope-deg 0:20:1",
            "attitude --soil good-samples.toml --uncertainty --set soil.exit.ratio=0.5",
            "attitude --soil toyoura-uncertain --set soil.uncertainty.parameter.9.key=x",
            "attitude --soil toyoura-uncertain --set soil.uncertainty.parameter.friction=2",
            "attitude --soil toyoura-uncertain --set soil.uncertainty=2",
            "attitude --soil toyoura-uncertain --set soil.shear.law=isotropic",
        ],
    );
}

#[test]
fn wrong_rovers() {
    let place = Place::new();
    let rover = |file: &str, from: &str, to: &str| {
        put(&place, &format!("{file}.toml"), "rover", "hakuto", from, to);
    };
    rover("zero-mass", "mass_kg = 5.24", "mass_kg = 0.0");
    rover("negative-mass", "mass_kg = 0.422", "mass_kg = -0.422");
    rover("two-names", "rear-left", "front-left");
    rover("uneven", "[-0.17, 0.24, -0.06]", "[-0.17, 0.24, -0.05]");
    rover("two-coordinates", "[0.19, 0.24, -0.06]", "[0.19, 0.24]");
    rover("no-such-wheel", "wheel = \"hakuto\"", "wheel = \"hakutto\"");
    rover("no-such-file", "wheel = \"hakuto\"", "wheel = \"wheels/mine.toml\"");
    rover("negative-inertia", "xx = 0.138", "xx = -0.138");
    rover("misspelt", "[body]", "[bdoy]");
    let whole = changed_preset("rover", "hakuto", "schema", "schema");
    let mounts: Vec<_> = whole.match_indices("[[mount]]").map(|(at, _)| at).collect();
    place.write("two-wheels.toml", &whole[..mounts[2]]);
    place.write("no-wheels.toml", &whole[..mounts[0]]);
    place.write("one-line.toml", whole.replace("-0.24,", "0.24,"));
    place.write("one-axle.toml", whole.replace("[-0.17,", "[0.19,"));
    place.write("a-soil.toml", changed_preset("soil", "toyoura", "schema", "schema"));
    let lines: Vec<String> = place
        .names()
        .iter()
        .map(|name| format!("attitude --slope-deg 10 --rover {name}"))
        .collect();
    let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
    check_lines_refused("rovers", &place, &lines);
}

#[test]
fn wrong_scenarios() {
    let place = Place::new();
    let head = "schema = \"scenario/1\"\n";
    for (file, body) in [
        ("gravity", "gravity_m_s2 = -9.81\n"),
        ("slope", "slope_deg = 61\n"),
        ("eq18-list", "[drive]\nlaw = \"eq18\"\nground_speed_m_s = [0.06, 0.06, 0.06, 0.06]\n"),
        ("two-speeds", "[drive]\nrim_speed_m_s = [0.06, 0.06]\n"),
        ("fast-wheel", "[drive]\nrim_speed_m_s = [0.06, 0.06, 60, 0.06]\n"),
        ("wrong-law", "[drive]\nreference_slip_ratio = 0.2\n"),
        ("no-soil", "soil = \"sand.toml\"\n"),
        ("inline", "soil = { cohesion_kpa = 1 }\n"),
        ("start", "start = \"rest\"\n"),
        ("samples", "duration_s = 86400\nsample_interval_s = 0.01\n"),
        ("number", "soil = 7\n"),
    ] {
        place.write(&format!("{file}.toml"), format!("{head}{body}"));
    }
    let lines: Vec<String> = place.names().iter().map(|name| format!("traverse {name}")).collect();
    let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
    check_lines_refused("scenarios", &place, &lines);
}

#[test]
fn what_is_no_document_at_all() {
    let place = Place::new();
    place.write("empty.toml", "");
    place.write("comment.toml", "# nothing yet\n\n");
    place.write("binary.toml", [0x7f, b'E', b'L', b'F', 0, 0xff, 0xfe]);
    place.write("nul.toml", "schema = \"soil/1\"\n\0\n");
    place.write("deep.toml", format!("schema = \"soil/1\"\nx = {}1\n", "[".repeat(60)));
    place.write("long-line.toml", format!("schema = \"soil/1\"\nx = \"{}\"", "a".repeat(9000)));
    place.write("large.toml", "#".repeat(1 << 21));
    place.write("latin-1.toml", b"schema = \"soil/1\"\nname = \"d\xfcne\"\n");
    place.write("json.toml", "{\"schema\": \"soil/1\"}");
    std::fs::create_dir(place.file("folder.toml")).expect("it can be made");
    let names = place.names();
    let lines: Vec<String> = names
        .iter()
        .map(String::as_str)
        .chain(["nothing.toml", "empty.toml/below.toml"])
        .map(|name| format!("wheel-test --soil {name}"))
        .collect();
    let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
    check_lines_refused("no-documents", &place, &lines);
}

#[test]
fn check_tells_of_every_document() {
    let place = Place::new();
    put(&place, "steep.toml", "soil", "toyoura", "= 38.0", "= 380.0");
    put(&place, "good.toml", "soil", "toyoura", "schema", "schema");
    place.write("empty.toml", "");
    let answer = place.line("check steep.toml good.toml empty.toml none.toml .");
    assert_eq!(answer.code(), 2);
    assert_snapshot!("check-several", answer.conversation());
}

// ---- Folders and disks ----

#[test]
fn folders_that_cannot_be_used() {
    let place = Place::new();
    place.write("file", "mine");
    std::fs::create_dir(place.file("full")).expect("it can be made");
    place.write("full/notes.txt", "mine");
    check_refused(
        "folders",
        &place,
        &[
            &["wheel-test", "--out", "file"],
            &["wheel-test", "--out", "full"],
            &["wheel-test", "--out", "."],
            &["wheel-test", "--out", ""],
            &["wheel-test", "--out", "none/../other"],
            &["wheel-test", "--out", "new.pdf"],
            &["reproduce", "--samples", "2", "--out", "full"],
            &["reproduce", "--samples", "2", "--out", "file"],
        ],
    );
    assert_eq!((place.read("file"), place.read("full/notes.txt")), ("mine".into(), "mine".into()));
}

/// A folder is not made for a run that does not come about.
#[test]
fn a_bad_document_leaves_no_folder() {
    let place = Place::new();
    for line in [
        "wheel-test --soil none.toml --out a/b",
        "traverse --slope-deg 61 --out a/b",
        "attitude --slope-deg 61 --out a/b",
    ] {
        check_is_refusal(&place.line(line), 2);
        assert!(place.names().is_empty(), "{line}: {:?}", place.names());
    }
}

/// Not even root writes there.
#[cfg(unix)]
#[test]
fn folders_that_cannot_be_made_are_the_disks_fault() {
    let place = Place::new();
    place.write("file", "mine");
    let mut conversations = Vec::new();
    for line in [
        "wheel-test --out file/below",
        "traverse --out file/far/below",
        "reproduce --out file/below",
    ] {
        conversations.push(check_is_refusal(&place.line(line), 1));
    }
    assert_snapshot!("folders-that-cannot-be-made", conversations.join("\n"));
    assert_eq!((place.names(), place.read("file")), (vec!["file".into()], "mine".into()));
}

#[cfg(target_os = "linux")]
#[test]
fn folders_without_permission_are_the_disks_fault() {
    let answer = Place::new().line("attitude --out /proc/below/this");
    assert_snapshot!("folder-without-permission", check_is_refusal(&answer, 1));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_behind_the_standard_output() {
    let place = Place::new();
    for command in [
        "wheel-test",
        "attitude --format csv",
        "traverse --format json",
        "presets",
        "presets toyoura",
        "schema soil",
        "completions bash",
        "man card",
        "reproduce --samples 2 --out study",
        "--help",
        "--version",
        "traverse --help",
    ] {
        let answer = place.shell(&format!("grouser {command} > /dev/full"));
        assert_eq!(answer.code(), 1, "{command}");
        assert_eq!(
            answer.stderr,
            "error: cannot write to the standard output: No space left on device (os error 28)\n",
            "{command}"
        );
    }
}

/// Then nobody can be told, but the exit code still says it.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_behind_the_standard_error() {
    let place = Place::new();
    for command in ["wheel-test --slip-ratio 3", "wheel-test --bad", "check none.toml", ""] {
        let answer = place.shell(&format!("grouser {command} 2> /dev/full"));
        assert_eq!((answer.code(), answer.stderr.as_str()), (2, ""), "{command}");
    }
}

/// A limit on the size of files stands in for a full disk: both fail in the middle of a file.
#[cfg(unix)]
#[test]
fn a_full_disk_under_the_folder_leaves_nothing() {
    for command in [
        "ulimit -f 1; grouser traverse --out a/b",
        "ulimit -f 1; grouser reproduce --samples 2",
        // Without the signal that comes with it, the limit is a failed write like any other.
        "trap '' XFSZ; ulimit -f 1; grouser attitude --out a",
    ] {
        let place = Place::new();
        let answer = place.shell(command);
        assert_eq!(answer.code(), 1, "{command}: {}", answer.stderr);
        assert!(answer.stderr.starts_with("error: cannot write "), "{}", answer.stderr);
        assert!(!answer.stderr.contains(".grouser-"), "{}", answer.stderr);
        assert_eq!(answer.stdout, "");
        assert!(place.names().is_empty(), "{command}: {:?}", place.names());
    }
}

#[cfg(unix)]
#[test]
fn a_full_disk_spares_the_earlier_results() {
    let place = Place::new();
    place.results("traverse --duration-s 1 --out run");
    let before = place.read("run/traverse.json");
    let answer = place.shell("ulimit -f 1; grouser traverse --out run --force");
    assert_eq!(answer.code(), 1, "{}", answer.stderr);
    assert_eq!(before, place.read("run/traverse.json"));
    assert_eq!(std::fs::read_dir(place.file("run")).expect("a folder").count(), 5);
}

// ---- Signals ----

#[cfg(unix)]
#[test]
fn a_reader_that_has_gone_is_no_error() {
    let place = Place::new();
    for command in [
        "wheel-test --slip-ratio 0:1:0.0005 --format json",
        "wheel-test --slip-ratio 0:1:0.0005",
        "traverse --format csv",
        "traverse --format json",
        "presets",
        "schema soil",
        "completions bash",
        "--help",
    ] {
        let line = format!("{{ grouser {command}; echo code $? >&2; }} | head -n 1");
        let answer = place.shell(&line);
        assert_eq!((answer.code(), answer.stderr.as_str()), (0, "code 0\n"), "{command}");
        assert_eq!(answer.stdout.lines().count(), 1, "{command}");
    }
}

#[cfg(unix)]
mod signals {
    use std::process::{Child, Command, Stdio};
    use std::time::Duration;

    use crate::program::{Answer, Place};

    fn start(place: &Place, line: &str) -> Child {
        let words: Vec<&str> = line.split(' ').collect();
        let mut command = place.command(&words);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command.spawn().expect("the program starts")
    }

    fn send(signal: &str, child: &Child) {
        let sent = Command::new("kill").args([signal, &child.id().to_string()]).status();
        assert!(sent.expect("there is a kill").success(), "{signal}");
    }

    #[test]
    fn an_interrupted_run_ends_with_130_and_leaves_nothing() {
        for line in [
            "traverse --duration-s 86400 --out run",
            "attitude --soil toyoura-uncertain --uncertainty --samples 100000 --out run",
        ] {
            let place = Place::new();
            let child = start(&place, line);
            std::thread::sleep(Duration::from_secs(1));
            send("-INT", &child);
            let answer = Answer::new(line, &child.wait_with_output().expect("it ends"));
            assert_eq!(answer.code(), 130);
            assert_eq!((answer.stdout.as_str(), answer.stderr.as_str()), ("", "interrupted\n"));
            assert!(place.names().is_empty(), "{:?}", place.names());
        }
    }

    #[test]
    fn an_interrupted_reproduction_is_whole_or_not_there() {
        for moment in [0, 300, 1700] {
            let place = Place::new();
            let mut child = start(&place, "reproduce --samples 2 --out study");
            std::thread::sleep(Duration::from_millis(moment));
            if child.try_wait().expect("it can be asked").is_none() {
                send("-INT", &child);
            }
            let output = child.wait_with_output().expect("it ends");
            let names = place.names();
            match output.status.code() {
                Some(0) => assert_eq!(names, ["study"]),
                Some(130) => assert!(names.is_empty() || names == ["study"], "{names:?}"),
                // Interrupted before its first line, when it had no handler yet.
                None => assert!(names.is_empty(), "{names:?}"),
                code => panic!("{code:?}"),
            }
            check_is_whole(&place);
        }
    }

    /// A hidden temporary folder beside the target may be left: nobody tidies up after SIGKILL.
    #[test]
    fn a_killed_reproduction_is_whole_or_not_there() {
        let place = Place::new();
        let begun = std::time::Instant::now();
        place.results("reproduce --samples 2 --out whole");
        let takes = begun.elapsed();
        // Most of the moments are around the end, where the files are written.
        for share in [0.3, 0.9, 0.96, 0.99, 1.02] {
            let place = Place::new();
            let mut child = start(&place, "reproduce --samples 2 --out study");
            std::thread::sleep(takes.mul_f64(share));
            child.kill().expect("it can be killed");
            child.wait().expect("it ends");
            for name in place.names() {
                assert!(name == "study" || name.starts_with(".grouser-"), "{name}");
            }
            check_is_whole(&place);
        }
    }

    /// A folder has one writer at a time, and one that was killed holds none back.
    #[test]
    fn two_runs_do_not_write_to_one_folder() {
        let place = Place::new();
        std::fs::create_dir(place.file("out")).expect("a folder");
        let mut first = start(&place, "traverse --duration-s 86400 --simulation dynamic --out out");
        std::thread::sleep(Duration::from_secs(1));
        let second = place.line("traverse --out out");
        assert_eq!(second.code(), 1, "{}", second.stderr);
        assert!(second.stderr.contains("another program"), "{}", second.stderr);
        first.kill().expect("it can be killed");
        first.wait().expect("it ends");
        place.results("traverse --out out");
    }

    /// A folder that appears while a run computes belongs to another run.
    #[test]
    fn a_folder_that_was_made_meanwhile_is_not_written_to() {
        let place = Place::new();
        let slow = start(&place, "reproduce --samples 2 --out out");
        std::thread::sleep(Duration::from_millis(200));
        place.results("heading --out out");
        let slow = Answer::new("reproduce", &slow.wait_with_output().expect("it ends"));
        assert!(slow.code() == 1 && slow.stderr.contains("meanwhile"), "{}", slow.stderr);
        assert!(place.file("out/heading.json").exists() && !place.file("out/data").exists());
        assert_eq!(place.names(), ["out"]);
    }

    /// What a killed run left an hour ago is cleared; what may still be written to is not.
    #[test]
    fn leftovers_of_killed_runs_are_cleared() {
        let place = Place::new();
        for (name, minutes) in [(".grouser-old", 90), (".grouser-new", 1), (".other", 90)] {
            std::fs::create_dir(place.file(name)).expect("a folder");
            let folder = std::fs::File::open(place.file(name)).expect("it opens");
            let then = std::time::SystemTime::now() - Duration::from_secs(60 * minutes);
            folder.set_modified(then).expect("it can be made older");
        }
        place.results("heading --out out");
        assert_eq!(place.names(), [".grouser-new", ".other", "out"]);
    }

    /// Checks that the folder, if there is one, holds all of the report.
    fn check_is_whole(place: &Place) {
        let study = place.file("study");
        if !study.exists() {
            return;
        }
        let html = place.read("study/report.html");
        assert!(html.trim_end().ends_with("</html>"));
        let count =
            |folder: &str| std::fs::read_dir(study.join(folder)).expect("it is there").count();
        assert_eq!((count("data"), count("figures"), count(".")), (43, 12, 4));
        assert!(place.read("study/scenario.toml").contains("scenario/1"));
    }
}
