//! Answers as slides.

use crate::bad_input::check_is_refusal;
use crate::maps::heights;
use crate::program::Place;

/// One sentence, one picture, and what it is of, in the form that the file's name ends in.
#[test]
fn an_answer_is_a_slide_of_16_to_9() {
    let place = Place::new();
    let line = "heading --slope-deg 5 --nominal";
    let plain = place.results(line);
    assert_eq!(place.results(&format!("{line} --slide a.svg")), plain);
    let svg = place.read("a.svg");
    assert!(svg.contains("width=\"320mm\" height=\"180mm\""), "{svg}");
    let version = env!("CARGO_PKG_VERSION");
    for words in ["HAKUTO", version, "grouser heading --slope-deg 5 --nominal<"] {
        assert!(svg.contains(words), "{words}: {svg}");
    }
    for (file, start) in [("a.png", b"\x89PNG".as_slice()), ("a.pdf", b"%PDF-".as_slice())] {
        place.results(&format!("{line} --slide {file}"));
        assert!(std::fs::read(place.file(file)).expect("a file").starts_with(start), "{file}");
    }
    place.results("traverse --duration-s 1 --slide run.svg");
    assert!(place.read("run.svg").contains("Path on the slope"));
    let line = "mission two-steps-forward --simulation quasi-steady --nominal --slide legs.svg";
    place.results(line);
    assert!(place.read("legs.svg").contains("grouser mission two-steps-forward"));
    place.write("flat.xyz", heights(|_, _| 2.0));
    let line =
        "route flat.xyz --from 7002,-298 --to 7010,-298 --no-drive --samples 2 --slide way.svg";
    place.results(line);
    let slide = place.read("way.svg");
    assert!(slide.contains("Completed on") && slide.contains("least time"), "{slide}");
}

/// Before anything is computed.
#[test]
fn slides_that_cannot_be_made_say_why() {
    let place = Place::new();
    let refused = |line: &str, words: &[&str]| {
        let answer = check_is_refusal(&place.line(line), 2);
        for word in words {
            assert!(answer.contains(word), "{line}: {answer}");
        }
    };
    refused("heading --slide a.gif", &["--slide a.gif", ".svg, .png or .pdf"]);
    place.write("mine.svg", "mine");
    refused("heading --slide mine.svg", &["mine.svg exists already"]);
    assert_eq!(place.read("mine.svg"), "mine");
    place.results("heading --slope-deg 5 --nominal --slide mine.svg --force");
    assert!(place.read("mine.svg").starts_with("<svg"));
    let able = "heading, map, route, mission".split(", ").chain(["traverse", "learn", "replay"]);
    refused("card --slide a.svg", &able.collect::<Vec<_>>());
}
