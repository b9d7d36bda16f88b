//! `campaign`: what scripts rely on, and that nothing is lost or doubled, whatever happens.

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Child, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use insta::assert_snapshot;
use serde_json::Value;

use crate::program::{Answer, Place, keys, number};

/// 60 wheels in 8 shards.
pub(crate) const WHEELS: &str = r#"
schema = "campaign/1"
name = "A wheel on sand that is known roughly"
study = "wheel-test"
runs = 60
shard_runs = 8
[wheel_test]
soil = "toyoura"
wheel = "hakuto"
load_n = 17.0
slip_ratio = 0.2
[[parameter]]
key = "soil.friction_angle_deg"
distribution = "normal"
standard_deviation = 2.0
"#;

/// 600 traverses in 75 shards: long enough to be stopped on the way.
const TRAVERSES: &str = r#"
schema = "campaign/1"
name = "Traverses of a slope that is known roughly"
study = "traverse"
runs = 600
shard_runs = 8
[scenario]
simulation = "quasi-steady"
slope_deg = 10.0
duration_s = 20.0
[[parameter]]
key = "slope_deg"
distribution = "uniform"
low = 5.0
high = 12.0
"#;

fn with_study(text: &str) -> Place {
    let place = Place::new();
    place.write("study.toml", text);
    place
}

/// The digest of a folder, with what `run` says in JSON at its end.
fn finished(place: &Place, line: &str) -> Value {
    let answer = place.line(&format!("{line} --format json"));
    assert_eq!(answer.code(), 0, "{}", answer.conversation());
    let last = answer.stdout.lines().last().expect("a line");
    serde_json::from_str(last).expect("it is JSON")
}

fn digest(place: &Place, folder: &str) -> String {
    let json = place.json(&format!("campaign digest {folder}"));
    json["digest"].as_str().expect("a text").to_owned()
}

/// A conversation without the digest, which is that of every bit of physics.
fn masked(answer: &Answer) -> String {
    let is_digest = |word: &str| word.len() == 64 && word.chars().all(|c| c.is_ascii_hexdigit());
    let line = |line: &str| {
        let words = line.split(' ').map(|word| if is_digest(word) { "[DIGEST]" } else { word });
        words.collect::<Vec<_>>().join(" ") + "\n"
    };
    answer.conversation().lines().map(line).collect()
}

/// The files of a folder's shards, with their bytes.
fn shards(place: &Place, folder: &str) -> BTreeMap<String, Vec<u8>> {
    let files = fs::read_dir(place.file(folder).join("runs")).expect("it is there");
    files
        .map(|file| file.expect("it is there").path())
        .map(|file| {
            let name = file.file_name().expect("a name").to_string_lossy().into_owned();
            (name, fs::read(&file).expect("it can be read"))
        })
        .collect()
}

// ---- What it says ----

#[test]
fn it_says_what_it_did() {
    let place = with_study(WHEELS);
    let started = place.line("campaign run study.toml --out out");
    let text = started.stdout.split(", ").collect::<Vec<_>>();
    // The rate is this machine's.
    assert!(text[1].contains(" per second\nok: 60\n"), "{}", started.conversation());
    assert_snapshot!("again", masked(&place.line("campaign run study.toml --out out")));
    assert_snapshot!("summary", masked(&place.line("campaign summarise out")));
    let rerun = place.results("campaign rerun out 13");
    assert!(rerun.ends_with("equal to the stored row\n"), "{rerun}");
    for command in ["run", "rerun", "merge", "summarise", "digest", "cost"] {
        let answer = place.line(&format!("campaign {command} --help"));
        assert_snapshot!(format!("help-{command}"), answer.conversation());
    }
}

/// The rate is this machine's; all else follows from it and the bytes.
#[test]
fn what_a_campaign_costs_follows_from_a_rate_and_bytes() {
    let place = with_study(WHEELS);
    let json = place.json("campaign cost study.toml --runs 1000000 --seconds 0.1");
    assert_eq!(json["schema"], "grouser.campaign.cost.v1");
    let row = &json["rows"][0];
    assert_eq!((&row["study"], &row["shard_runs"]), (&"study.toml".into(), &8.into()));
    assert_eq!(row["shards"], 125_000);
    let (rate, bytes) = (number(&row["runs_per_core_s"]), number(&row["bytes_per_run"]));
    let near = |value: f64, expected: f64| (value - expected).abs() <= 1e-12 * expected;
    assert!(near(number(&row["core_hours"]), 1e6 / rate / 3600.0), "{row}");
    assert!(near(number(&row["gigabytes"]), 1e-3 * bytes), "{row}");
    // A file's footer is most of so small a shard. The last one has half as many runs, so that
    // bytes per run depend by 6 % on how many shards there was time for.
    place.results("campaign run study.toml --out out");
    let all: usize = shards(&place, "out").values().map(Vec::len).sum();
    assert!((bytes / (all as f64 / 60.0) - 1.0).abs() < 0.1, "{bytes} of {all}");
}

#[test]
fn what_cannot_be_done_is_said() {
    let place = with_study(WHEELS);
    place.results("campaign run study.toml --out out");
    place.results("campaign run study.toml --out part --shard 1/3");
    place.results("campaign run study.toml --out half --set campaign.runs=30");
    fs::create_dir(place.file("mine")).expect("it can be made");
    place.write("mine/notes.txt", "");
    let mut said = String::new();
    for line in [
        "campaign run absent.toml --out new",
        "campaign run study.toml",
        "campaign run study.toml --out mine",
        "campaign run study.toml --out study.toml",
        "campaign run study.toml --out out --set campaign.seed=2",
        "campaign run study.toml --out out --set soil.stress_peak.a0=0.41 --set campaign.runs=61",
        "campaign run study.toml --out out --shard 1/2",
        "campaign run study.toml --out new --shard 3/2",
        "campaign run study.toml --out new --threads 0",
        "campaign run study.toml --out new --scheduler tcp://host:8786",
        "campaign rerun out 60",
        "campaign rerun mine 0",
        "campaign summarise mine",
        "campaign merge new part",
        "campaign merge new part part",
        "campaign merge new part half",
        "campaign merge out2 absent",
    ] {
        let answer = place.line(line);
        assert_ne!(answer.code(), 0, "{}", answer.conversation());
        said += &(answer.conversation() + "\n");
    }
    assert!(!place.file("new").exists());
    assert_snapshot!("refusals", said);
}

#[test]
fn machines_are_told_how_far_it_is() {
    let place = with_study(WHEELS);
    let answer = place.line("campaign run study.toml --out out --format json");
    assert_eq!((answer.code(), answer.stderr.as_str()), (0, ""));
    let lines: Vec<Value> =
        answer.stdout.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let (last, progress) = lines.split_last().expect("lines");
    for line in progress {
        assert_eq!(line["schema"], "grouser.campaign.progress.v1");
        let words = ["schema", "runs_done", "runs", "elapsed_s", "runs_per_s", "left_s"];
        assert_eq!(keys(line), words);
        assert!(number(&line["runs_done"]) <= number(&line["runs"]));
    }
    assert_eq!(last["schema"], "grouser.campaign.run.v1");
    assert_eq!((&last["finished_before"], &last["statuses"]["ok"]), (&false.into(), &60.into()));
    assert_eq!(last["inputs"]["runs"], 60);
    assert_eq!(last["digest"], digest(&place, "out"));
}

#[test]
fn other_programs_have_words_to_rely_on() {
    let place = with_study(WHEELS);
    place.results("campaign run study.toml --out out");
    let rerun = place.json("campaign rerun out 59");
    assert_eq!(rerun["schema"], "grouser.campaign.rerun.v1");
    assert_eq!((&rerun["run"], &rerun["stored"]), (&59.into(), &true.into()));
    let row = ["run", "soil.friction_angle_deg", "status", "reason", "sinkage_mm"];
    assert_eq!(keys(&rerun["row"])[..5], row);
    let summary = place.json("campaign summarise out --out report");
    assert_eq!(summary["schema"], "grouser.campaign.summarise.v1");
    for word in ["digest", "rows", "probabilities", "sensitivities", "convergence"] {
        assert!(!summary[word].is_null(), "{word}");
    }
    let row = &summary["rows"][0];
    assert_eq!((&row["quantity"], &row["unit"]), (&"sinkage_mm".into(), &"mm".into()));
    assert!(number(&row["p2_5"]) < number(&row["p50"]) && number(&row["p50_low"]) > 0.0);
    let html = place.read("report/report.html");
    assert!(html.contains("sinkage_mm: distribution") && html.contains("<svg"));
    let manifest: Value = serde_json::from_str(&place.read("out/manifest.json")).expect("JSON");
    assert_eq!(manifest["schema"], "grouser.campaign.manifest.v2");
    assert_eq!(manifest["digest"], summary["digest"]);
    assert_eq!(manifest["sessions"][0]["shards"], 8);
}

/// The resolved study is all that is needed.
#[test]
fn the_folders_study_is_the_same_campaign() {
    let place = with_study(WHEELS);
    place.results("campaign run study.toml --out out");
    place.results("campaign run out/study.toml --out again");
    assert_eq!(digest(&place, "out"), digest(&place, "again"));
    let answer = place.line("campaign run out/study.toml --out out");
    assert!(answer.stdout.contains("nothing to do"), "{}", answer.conversation());
}

/// An exit-angle ratio that is above its largest at full slip for half of the draws.
const UNFIT: &str = r#"
schema = "campaign/1"
study = "heading"
runs = 40
shard_runs = 8
[scenario.soil]
cohesion_kpa = 0.0
friction_angle_deg = 38.0
density_kg_m3 = 1490.0
pressure_sinkage = { law = "reece", k_c = 0.0, k_phi = 120.0, n = 1.7 }
stress_peak = { a0 = 0.4, a1 = 0.15 }
shear = { law = "isotropic", longitudinal_m = 0.02 }
exit = { law = "quadratic-in-slip", at_zero = 0.5, per_slip = 0.9, per_slip2 = 0.0 }
[[parameter]]
key = "soil.exit.per_slip"
distribution = "uniform"
low = 0.5
high = 1.5
"#;

/// A draw that is no soil is a row that says so, and the exit code tells; a finding is a result.
#[test]
fn failed_runs_are_rows_and_the_exit_code_tells() {
    let place = with_study(UNFIT);
    for _ in 0..2 {
        let answer = place.line("campaign run study.toml --out out");
        assert_eq!(answer.code(), 3, "{}", answer.conversation());
        assert!(answer.stdout.contains("not possible together: "), "{}", answer.stdout);
        assert!(
            answer.stderr.starts_with("note: ") && answer.stderr.contains(" of 40 runs failed")
        );
    }
    let steep = place.line(
        "campaign run study.toml --out steep --set scenario.slope_deg=40 \
         --set soil.exit.at_zero=0.0",
    );
    assert_eq!(steep.code(), 0, "{}", steep.conversation());
    assert!(steep.stdout.contains("ground-strength: 40\n"), "{}", steep.stdout);
}

// ---- The same bytes ----

#[test]
fn threads_and_parts_change_no_bit() {
    let place = with_study(WHEELS);
    place.results("campaign run study.toml --out one --threads 1");
    place.results("campaign run study.toml --out two --threads 2");
    let whole = shards(&place, "one");
    assert_eq!(whole, shards(&place, "two"));
    for part in [3, 1, 2] {
        place.results(&format!("campaign run study.toml --out part{part} --shard {part}/3"));
    }
    let merged = place.json("campaign merge merged part2 part3 part1");
    assert_eq!(merged["schema"], "grouser.campaign.merge.v1");
    assert_eq!(whole, shards(&place, "merged"));
    assert_eq!(merged["digest"], digest(&place, "one"));
    // Interrupted or finished, the same command does no harm.
    fs::remove_file(place.file("merged/runs/part-000004.parquet")).expect("it is there");
    assert_eq!(place.json("campaign merge merged part2 part3 part1"), merged);
}

#[test]
fn damaged_shards_are_computed_anew() {
    let place = with_study(WHEELS);
    place.results("campaign run study.toml --out out");
    let (before, whole) = (digest(&place, "out"), shards(&place, "out"));
    let shard = |number: u64| place.file(&format!("out/runs/part-{number:06}.parquet"));
    let cut = &whole["part-000003.parquet"];
    fs::write(shard(3), &cut[..cut.len() / 2]).expect("it can be written");
    let mut flipped = whole["part-000005.parquet"].clone();
    flipped[100] ^= 4;
    fs::write(shard(5), flipped).expect("it can be written");
    fs::copy(shard(0), shard(6)).expect("it can be copied");
    fs::remove_file(shard(7)).expect("it is there");
    place.write("out/runs/.part-000001.parquet.partial-4711", "half a file");
    let answer = place.line("campaign run study.toml --out out");
    assert_eq!(answer.code(), 0, "{}", answer.conversation());
    assert_snapshot!("damaged", answer.stderr);
    assert_eq!((digest(&place, "out"), shards(&place, "out")), (before, whole));
}

#[test]
fn a_finished_folder_is_left_as_it_is() {
    let place = with_study(WHEELS);
    let before = finished(&place, "campaign run study.toml --out out");
    let manifest = place.read("out/manifest.json");
    let again = finished(&place, "campaign run study.toml --out out");
    assert_eq!((&again["finished_before"], &again["digest"]), (&true.into(), &before["digest"]));
    assert_eq!(place.read("out/manifest.json"), manifest);
}

// ---- Interruptions ----

fn start(place: &Place, arguments: &[&str]) -> Child {
    let mut command = place.command(arguments);
    command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("it starts")
}

const RUN: [&str; 5] = ["campaign", "run", "study.toml", "--out", "out"];

/// A campaign that has some of its shards, and is still running.
fn under_way(place: &Place) -> Child {
    let mut child = start(place, &RUN);
    while !place.file("out/runs/part-000001.parquet").exists() {
        assert!(child.try_wait().expect("it can be asked").is_none(), "it ended too early");
        thread::sleep(Duration::from_millis(1));
    }
    child
}

/// Some way from one number to the next, in no order that a program could be used to.
fn scrambled(state: &mut u64) -> f64 {
    // Knuth's MMIX generator; its upper bits are good.
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

/// Killed at 50 moments of its life, from before it made its folder to after its last shard.
#[test]
fn fifty_kills_lose_nothing_and_double_nothing() {
    const KILLS: usize = 50;
    let place = with_study(TRAVERSES);
    let since = Instant::now();
    place.results("campaign run study.toml --out whole");
    let (life, expected) = (since.elapsed(), digest(&place, "whole"));
    let (mut state, mut kills, mut went_on) = (4711, 0, 0);
    while kills < KILLS {
        let mut child = start(&place, &RUN);
        thread::sleep(life.mul_f64(scrambled(&mut state) / 2.0));
        child.kill().expect("it can be killed");
        if child.wait().expect("it ends").success() {
            // It was quicker than we: the next one starts anew.
            assert_eq!(digest(&place, "out"), expected);
            fs::remove_dir_all(place.file("out")).expect("it can be removed");
        } else {
            kills += 1;
            went_on += usize::from(place.file("out/runs/part-000000.parquet").exists());
        }
    }
    assert!(went_on > 0, "no kill came while it was computing");
    finished(&place, "campaign run study.toml --out out");
    assert_eq!(shards(&place, "out"), shards(&place, "whole"));
    assert_eq!(digest(&place, "out"), expected);
    let left: Vec<String> = names(&place.file("out"));
    assert_eq!(left, [".lock", "manifest.json", "runs", "study.toml"]);
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("it is there");
    let name = |entry: std::io::Result<fs::DirEntry>| {
        entry.expect("it is there").file_name().to_string_lossy().into_owned()
    };
    let mut names: Vec<String> = entries.map(name).collect();
    names.sort();
    names
}

/// The lock goes with the program, however that ends.
#[test]
fn two_campaigns_in_one_folder_are_one_too_many() {
    let place = with_study(TRAVERSES);
    let mut first = under_way(&place);
    let second = place.run(&RUN);
    first.kill().expect("it can be killed");
    first.wait().expect("it ends");
    assert_eq!(second.code(), 1, "{}", second.conversation());
    assert!(second.stderr.starts_with("error: another campaign is writing to out\nhint: "));
    finished(&place, "campaign run study.toml --out out");
    finished(&place, "campaign run study.toml --out whole");
    assert_eq!(digest(&place, "out"), digest(&place, "whole"));
}

#[cfg(unix)]
#[test]
fn ctrl_c_leaves_a_folder_that_goes_on() {
    let place = with_study(TRAVERSES);
    let child = under_way(&place);
    let sent = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(sent.expect("there is a kill").success());
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(130));
    let manifest: Value = serde_json::from_str(&place.read("out/manifest.json")).expect("JSON");
    let session = &manifest["sessions"][0];
    assert_eq!(session["shards"], shards(&place, "out").len());
    assert!(session["ended"].is_string() && manifest["digest"].is_null(), "{manifest}");
    let unfinished = place.line("campaign summarise out");
    assert_eq!(unfinished.code(), 2, "{}", unfinished.conversation());
    let answer = place.line("campaign run study.toml --out out");
    assert!(answer.stderr.starts_with("going on: "), "{}", answer.conversation());
    finished(&place, "campaign run study.toml --out whole");
    assert_eq!(digest(&place, "out"), digest(&place, "whole"));
}

/// A limit on the size of files stands in for a full disk.
#[cfg(unix)]
#[test]
fn a_full_disk_half_way_leaves_a_folder_that_goes_on() {
    let place = with_study(TRAVERSES);
    let mut child = under_way(&place);
    child.kill().expect("it can be killed");
    child.wait().expect("it ends");
    let before = shards(&place, "out").into_iter().filter(|(name, _)| !name.starts_with('.'));
    let before: BTreeMap<String, Vec<u8>> = before.collect();
    let answer = place.shell("ulimit -f 5; grouser campaign run study.toml --out out");
    assert_eq!(answer.code(), 1, "{}", answer.conversation());
    assert!(answer.stderr.contains("error: cannot write out/runs/part-"), "{}", answer.stderr);
    assert_eq!(shards(&place, "out"), before);
    finished(&place, "campaign run study.toml --out out");
    finished(&place, "campaign run study.toml --out whole");
    assert_eq!(digest(&place, "out"), digest(&place, "whole"));
}

// ---- Other executors ----

/// A Python that takes down what it is asked.
#[cfg(unix)]
#[test]
fn other_executors_are_the_python_packages() {
    use std::os::unix::fs::PermissionsExt as _;
    let place = with_study(WHEELS);
    let script = "#!/bin/sh\n[ \"$1\" = -c ] && exit 0\necho \"$@\"\nexit 3\n";
    place.write("python", script);
    let runnable = fs::Permissions::from_mode(0o755);
    fs::set_permissions(place.file("python"), runnable).expect("it can be made runnable");
    let line = "campaign run study.toml --out out --executor dask --scheduler tcp://host:8786 \
                --threads 4 --set campaign.seed=2 --format json";
    let words: Vec<&str> = line.split_whitespace().collect();
    let output = place.command(&words).env("GROUSER_PYTHON", place.file("python")).output();
    let output = output.expect("it starts");
    assert_eq!(output.status.code(), Some(3));
    assert_eq!(
        String::from_utf8_lossy(&output.stdout),
        "-m grouser.campaign run study.toml --out out --executor dask --scheduler tcp://host:8786 \
         --workers 4 --set campaign.seed=2 --format json\n"
    );
    let output = place.command(&words).env("GROUSER_PYTHON", "/no/python").output();
    let output = output.expect("it starts");
    assert_eq!(output.status.code(), Some(1));
    assert_snapshot!("no-python", String::from_utf8_lossy(&output.stderr));
}

/// Lines come while it runs, not at the end.
#[test]
fn lines_for_machines_come_at_once() {
    let place = with_study(TRAVERSES);
    let arguments = [&RUN[..], &["--format", "json"]].concat();
    let mut child = start(&place, &arguments);
    let mut lines = BufReader::new(child.stdout.take().expect("a pipe")).lines();
    let first: Value =
        serde_json::from_str(&lines.next().expect("a line").expect("text")).expect("JSON");
    assert_eq!((&first["runs_done"], &first["runs_per_s"]), (&0.into(), &Value::Null));
    assert!(!place.file("out/runs/part-000074.parquet").exists());
    assert!(lines.count() >= 1);
    assert!(child.wait().expect("it ends").success());
}
