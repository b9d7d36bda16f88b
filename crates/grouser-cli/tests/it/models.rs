//! Which model an answer has, in tables and in the help.

use crate::program::Place;

/// Commands with a table of one model, but for the soil.
const TABLES: [&str; 4] = [
    "wheel-test --slip-ratio 0.2",
    "heading --slope-deg 5 --nominal",
    "heading-map --slope-deg 5 --course-deg 0",
    "traverse --slope-deg 5 --duration-s 0.2",
];

const LINE: &str = "model: small-wheel, as the soil leaves its wheel sinkage ratio to priors\n";

#[test]
fn a_table_says_which_model_a_soil_has_that_leaves_its_sinkage_ratio_to_priors() {
    let place = Place::new();
    for line in TABLES {
        let text = place.results(&format!("{line} --soil grc-1"));
        assert_eq!(text.matches(&format!("\n{LINE}")).count(), 1, "{line}: {text}");
        // Where the model is the usual one, or is asked for, or every row has its own, the line
        // is left out.
        for rest in ["--soil toyoura", "--soil grc-1 --model rft", "--soil grc-1 --model all"] {
            let text = place.results(&format!("{line} {rest}"));
            assert!(!text.contains("model: "), "{line} {rest}: {text}");
        }
    }
    let both = place.results(&format!("{} --soil toyoura --soil grc-1", TABLES[2]));
    assert_eq!(both.lines().last(), Some(format!("GRC-1 lunar simulant: {LINE}").trim_end()));
}

/// The model of the line is that of the numbers.
#[test]
fn the_line_of_the_model_is_true() {
    let place = Place::new();
    for line in TABLES {
        let [usual, named] = ["", " --model small-wheel"]
            .map(|rest| place.results(&format!("{line} --soil grc-1{rest}")));
        assert_eq!(usual.replace(LINE, ""), named, "{line}");
    }
}

#[test]
fn help_offers_every_model_where_it_is_taken_alone() {
    let place = Place::new();
    for (command, takes_all) in [
        ("wheel-test", true),
        ("heading", true),
        ("heading-map", true),
        ("traverse", true),
        ("card", false),
        ("validate", false),
        ("calibrate", false),
    ] {
        let help = place.results(&format!("{command} --help"));
        let words: Vec<&str> = help.split_whitespace().collect();
        let help = words.join(" ");
        assert_eq!(help.contains("or `all` for the results of each"), takes_all, "{command}");
        assert!(help.contains("or else `small-wheel` where the soil leaves"), "{command}: {help}");
    }
}

#[test]
fn every_model_of_a_traverse_has_its_bands_and_flags_in_the_table() {
    let place = Place::new();
    let line = "traverse --slope-deg 10 --duration-s 1 --model all --gravity-m-s2 moon";
    let bands = place.results(&format!("{line} --uncertainty --samples 4"));
    let header: Vec<&str> = bands.lines().next().expect("a header").split_whitespace().collect();
    for word in ["y_m_p2_5", "y_m_p97_5", "slip_ratio_p97_5", "probability_completed", "flags"] {
        assert!(header.contains(&word), "{word}: {header:?}");
    }
    assert_eq!(bands.matches("\ngravity-outside: ").count(), 1, "{bands}");
    let plain = place.results(line);
    assert!(plain.contains(" flags\n") && !plain.contains("_p2_5"), "{plain}");
}
