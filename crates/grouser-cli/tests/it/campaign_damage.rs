//! `campaign`: damaged folders are refused, and campaigns of any size start at once.

use std::fs;
use std::path::PathBuf;
use std::process::Stdio;
use std::thread;
use std::time::Duration;

use insta::assert_snapshot;

use crate::campaign::WHEELS;
use crate::program::{Place, number};

/// 12 wheels in 3 shards.
fn wheels() -> String {
    WHEELS.replace("runs = 60\nshard_runs = 8\n", "runs = 12\nshard_runs = 4\n")
}

fn finished() -> Place {
    let place = Place::new();
    place.write("study.toml", wheels());
    place.results("campaign run study.toml --out out");
    place
}

fn files(place: &Place) -> Vec<PathBuf> {
    let names =
        ["manifest.json", "study.toml", "runs/part-000000.parquet", "runs/part-000002.parquet"];
    names.iter().map(|name| place.file("out").join(name)).collect()
}

/// Single bits, spread by a seed. The store's own tests flip a thousand.
#[test]
fn flipped_bits_are_refused_with_the_file_and_the_command_that_mends_it() {
    const FLIPS: usize = 24;
    let place = finished();
    let commands =
        ["campaign summarise out --format json", "campaign digest out", "campaign rerun out 9"];
    let mut state = 20_261_122_u64;
    for flip in 0..FLIPS {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let file = &files(&place)[flip % 4];
        let good = fs::read(file).expect("it is there");
        let bit = usize::try_from(state >> 33).expect("it is small") % (8 * good.len());
        let mut bad = good.clone();
        bad[bit / 8] ^= 1 << (bit % 8);
        fs::write(file, bad).expect("it can be written");
        for command in commands {
            // A run's own shard is all that is read of it, besides manifest and study.
            if command.contains("rerun") && file.ends_with("part-000000.parquet") {
                continue;
            }
            let answer = place.line(command);
            assert_eq!((answer.code(), answer.stdout.as_str()), (1, ""), "bit {bit}");
            let name = file.file_name().expect("a name").to_string_lossy();
            assert!(answer.stderr.contains(&*name), "{}", answer.conversation());
            assert!(answer.stderr.contains("`grouser campaign run "), "{}", answer.conversation());
        }
        fs::write(file, good).expect("it can be written");
    }
}

#[test]
fn what_is_damaged_is_said_and_mended() {
    let place = finished();
    let digest = place.results("campaign digest out");
    let shard = |number: u32| place.file(&format!("out/runs/part-{number:06}.parquet"));
    let mut said = String::new();
    let mut tell = |line: &str| {
        let answer = place.line(line);
        assert_ne!(answer.code(), 0, "{}", answer.conversation());
        said += &(answer.conversation() + "\n");
    };
    let cut = fs::read(shard(1)).expect("it is there");
    fs::write(shard(1), &cut[..cut.len() / 2]).expect("it can be written");
    tell("campaign summarise out");
    place.line("campaign run study.toml --out out");
    let first = fs::read(shard(0)).expect("it is there");
    fs::copy(shard(2), shard(0)).expect("it can be copied");
    fs::write(shard(2), first).expect("it can be written");
    tell("campaign digest out");
    place.line("campaign run study.toml --out out");
    let manifest = place.read("out/manifest.json");
    place.write("out/manifest.json", manifest.replace("\"seed\": 1", "\"seed\": 2"));
    tell("campaign summarise out");
    let mended = place.line("campaign run study.toml --out out");
    assert!(
        mended.stderr.starts_with("note: manifest.json was damaged"),
        "{}",
        mended.conversation()
    );
    let study = place.read("out/study.toml");
    place.write("out/study.toml", study.replace("load_n = 17", "load_n = 18"));
    tell("campaign rerun out 3");
    place.line("campaign run study.toml --out out");
    assert_eq!(place.read("out/study.toml"), study);
    assert_eq!(place.results("campaign digest out"), digest);
    place.results("campaign run study.toml --out part --shard 2/3");
    fs::write(place.file("part/runs/part-000001.parquet"), "").expect("it can be written");
    tell("campaign summarise part");
    assert_snapshot!("said", said);
}

/// 10¹² runs: the shards are ranges, which nobody walks along.
#[cfg(target_os = "linux")]
#[test]
fn a_campaign_of_a_million_million_runs_starts_at_once() {
    let place = Place::new();
    place.write("study.toml", wheels().replace("runs = 12\n", "runs = 1_000_000_000_000\n"));
    for part in ["1/1000", "1/1"] {
        let name = part.replace('/', "-");
        let child = place
            .command(&["campaign", "run", "study.toml", "--out", &name, "--shard", part])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn();
        let mut child = child.expect("it starts");
        let status =
            || fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let first = place.file(&format!("{name}/runs/part-000000.parquet"));
        while !first.exists() {
            assert!(!status().is_empty(), "it ended too early");
            thread::sleep(Duration::from_millis(1));
        }
        let status = status();
        let most = status.lines().find(|line| line.starts_with("VmHWM:")).expect("it is running");
        let sent =
            std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
        assert!(sent.expect("there is a kill").success());
        assert_eq!(child.wait().expect("it ends").code(), Some(130));
        let kilobytes: f64 =
            most.split_whitespace().nth(1).and_then(|it| it.parse().ok()).expect("a number");
        assert!(kilobytes > 0.0 && kilobytes < 300_000.0, "{most}");
        let digest = place.line(&format!("campaign digest {name}"));
        assert_eq!(digest.code(), 2, "{}", digest.conversation());
        assert!(digest.stderr.contains(" is not finished: "), "{}", digest.conversation());
    }
    let cost = place.json("campaign cost study.toml --seconds 0.1");
    assert!(number(&cost["rows"][0]["runs_per_core_s"]) > 0.0);
}

#[cfg(unix)]
#[test]
fn a_device_in_a_shards_place_is_not_read() {
    let place = finished();
    let file = place.file("out/runs/part-000001.parquet");
    fs::remove_file(&file).expect("it is there");
    std::os::unix::fs::symlink("/dev/zero", &file).expect("it can be linked");
    let answer = place.line("campaign summarise out");
    assert_eq!(answer.code(), 1, "{}", answer.conversation());
    assert!(answer.stderr.contains("it is no regular file"), "{}", answer.conversation());
}
