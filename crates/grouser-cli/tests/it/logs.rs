//! `traverse --mcap`: where a log is written, and what is refused. What it has is read by
//! `crates/grouser-python/tests/test_logs.py` with other programs' readers.

use crate::program::Place;

const BEGINS: &[u8] = b"\x89MCAP0\r\n";

fn is_log(place: &Place, name: &str) -> bool {
    let file = std::fs::read(place.file(name)).expect("it is written");
    file.starts_with(BEGINS) && file.ends_with(BEGINS)
}

#[test]
fn a_run_is_logged_beside_its_answer_and_the_same_run_is_the_same_log() {
    let place = Place::new();
    let answer = place.line("traverse --duration-s 1 --mcap run.mcap");
    assert_eq!(answer.code(), 0, "{}", answer.stderr);
    assert!(answer.stdout.contains("completed after 1 s") && is_log(&place, "run.mcap"));
    let line = "traverse --duration-s 1 --mcap again.MCAP --animate run.svg";
    assert_eq!(place.line(line).code(), 0);
    let read = |name| std::fs::read(place.file(name)).expect("it is written");
    assert!(read("run.mcap") == read("again.MCAP"));
    assert!(place.read("run.svg").starts_with("<svg"));
}

#[test]
fn a_name_alone_goes_to_the_other_results_and_a_path_does_not() {
    let place = Place::new();
    let line = "traverse --duration-s 1 --out results --mcap run.mcap";
    assert_eq!(place.line(line).code(), 0);
    assert!(is_log(&place, "results/run.mcap") && !place.file("run.mcap").exists());
    let line = "traverse --duration-s 1 --out others --mcap ./run.mcap";
    assert_eq!(place.line(line).code(), 0);
    assert!(is_log(&place, "run.mcap") && !place.file("others/run.mcap").exists());
}

#[test]
fn what_cannot_be_logged_is_refused_before_anything_is_computed() {
    let place = Place::new();
    place.write("mine.mcap", "mine");
    std::fs::create_dir(place.file("folder.mcap")).expect("a folder");
    let refused = |arguments: &str, words: &[&str]| {
        let answer = place.line(&format!("traverse --duration-s 80000 {arguments}"));
        assert_eq!(answer.code(), 2, "{}", answer.stderr);
        for word in words {
            assert!(answer.stderr.contains(word), "{word}: {}", answer.stderr);
        }
    };
    refused("--mcap run.log", &["--mcap run.log", "`.mcap`"]);
    refused("--mcap run", &["`.mcap`"]);
    refused("--mcap nowhere/run.mcap", &["nowhere/run.mcap", "nowhere is no folder", "make it"]);
    refused("--mcap mine.mcap", &["mine.mcap exists already", "--force"]);
    refused("--mcap folder.mcap", &["is a folder"]);
    refused("--mcap run.mcap --model all", &["--mcap logs one run", "--model"]);
    refused("--animate nowhere/run.svg", &["nowhere is no folder"]);
    assert_eq!(place.read("mine.mcap"), "mine");
    assert!(!place.file("run.mcap").exists());
    let replaced = place.line("traverse --duration-s 1 --mcap mine.mcap --force");
    assert_eq!(replaced.code(), 0, "{}", replaced.stderr);
    assert!(is_log(&place, "mine.mcap"));
}
