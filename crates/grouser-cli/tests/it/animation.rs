//! `traverse --animate`: what is written, where, and what is refused.

use crate::program::Place;

#[test]
fn the_ending_decides_what_is_written() {
    let place = Place::new();
    let begins: [(&str, &[u8]); 5] = [
        ("run.gif", b"GIF89a"),
        ("run.html", b"<!doctype html>"),
        ("run.glb", b"glTF"),
        ("run.svg", b"<svg"),
        ("run.png", b"\x89PNG"),
    ];
    for (name, begins) in begins {
        let answer = place.line(&format!("traverse --duration-s 1 --animate {name}"));
        assert_eq!(answer.code(), 0, "{}", answer.stderr);
        // The answer is printed as without it.
        assert!(answer.stdout.contains("completed after 1 s"));
        let written = std::fs::read(place.file(name)).expect("it is written");
        assert!(written.starts_with(begins), "{name}");
    }
}

#[test]
fn an_unknown_ending_and_an_old_file_are_refused_before_anything_is_computed() {
    let place = Place::new();
    let unknown = place.line("traverse --animate run.avi --duration-s 80000");
    assert_eq!(unknown.code(), 2);
    for ending in [".gif", ".mp4", ".html", ".glb", ".svg", ".png"] {
        assert!(unknown.stderr.contains(&format!("`{ending}`")), "{}", unknown.stderr);
    }
    place.write("run.svg", "mine");
    let refused = place.line("traverse --animate run.svg --duration-s 80000");
    assert_eq!(refused.code(), 2);
    assert!(refused.stderr.contains("--force"), "{}", refused.stderr);
    assert_eq!(place.read("run.svg"), "mine");
    let replaced = place.line("traverse --animate run.svg --duration-s 1 --force");
    assert_eq!(replaced.code(), 0, "{}", replaced.stderr);
    assert!(place.read("run.svg").starts_with("<svg"));
    // There is nothing to replace.
    assert_eq!(place.line("traverse --force").code(), 2);
}

#[test]
fn a_name_alone_goes_to_the_other_results() {
    let place = Place::new();
    let line = "traverse --duration-s 1 --out results --animate run.glb";
    assert_eq!(place.line(line).code(), 0);
    assert!(place.file("results/run.glb").exists() && !place.file("run.glb").exists());
    assert!(place.file("results/traverse.csv").exists());
}

#[test]
fn two_yaws_and_all_models_are_drawn_beside_each_other() {
    let place = Place::new();
    let line = "traverse --duration-s 1 --beside-yaw-deg 9.56 --animate yaws.svg";
    assert_eq!(place.line(line).code(), 0);
    let svg = place.read("yaws.svg");
    assert!(svg.contains(">start yaw 0°</text>") && svg.contains(">start yaw 9.56°</text>"));
    let line = "traverse --duration-s 1 --model all --animate models.svg";
    assert_eq!(place.line(line).code(), 0);
    let svg = place.read("models.svg");
    assert!(["ishigami", "bekker", "rft"].iter().all(|it| svg.contains(&format!(">{it}</text>"))));
    let both = place.line("traverse --model all --beside-yaw-deg 5 --animate both.svg");
    assert_eq!(both.code(), 2);
    assert!(both.stderr.contains("--model"), "{}", both.stderr);
}

/// Where there is no ffmpeg the message says what to do; where there is one, it makes a film.
#[test]
fn a_film_needs_ffmpeg() {
    let place = Place::new();
    let answer = place.line("traverse --duration-s 0.2 --animate run.mp4");
    if answer.code() == 0 {
        let film = std::fs::read(place.file("run.mp4")).expect("it is written");
        assert_eq!(&film[4..8], b"ftyp");
    } else {
        assert!(answer.stderr.contains("ffmpeg"), "{}", answer.stderr);
        assert!(answer.stderr.contains(".gif") && !place.file("run.mp4").exists());
    }
}
