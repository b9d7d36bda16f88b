//! Names and cells that would steer a terminal, a browser or a spreadsheet are shown, and do
//! nothing.

use grouser::document::escape::is_hidden;

use crate::program::{Place, changed_preset};

/// Escape codes, a NUL, line ends, a change of direction, the ends of HTML and XML elements, a
/// formula.
const NAME: &str =
    "=1+1 \\u001b]0;x\\u0007 \\u0000\\u009b31m\\nerror: no\\r\\u202e</script><b>]]>&\\\"'$x_1$";

/// The preset with that name for it.
fn with_name(kind: &str, preset: &str, name: &str) -> String {
    changed_preset(kind, preset, &format!("\"{name}\""), &format!("\"{NAME}\""))
}

fn hostile_place() -> Place {
    let place = Place::new();
    place.write("soil.toml", with_name("soil", "toyoura", "Toyoura sand"));
    place
}

/// Checks that a text has no hidden characters but line feeds and tabs.
fn check_shown(what: &str, text: &str) {
    let hidden = text.chars().find(|&c| is_hidden(c) && !matches!(c, '\n' | '\t'));
    assert_eq!(hidden, None, "{what}");
}

/// Checks that no data ends an element or begins one.
fn check_markup(what: &str, text: &str) {
    check_shown(what, text);
    for part in ["</script>", "<b>", "]]>", "&\"", "1+1 \u{1b}"] {
        assert!(!text.contains(part), "{what}: {part}");
    }
    assert!(text.contains("&lt;/script&gt;"), "{what} does not show the name");
}

#[test]
fn a_card_shows_the_name_of_its_soil_and_nothing_else_happens() {
    let place = hostile_place();
    let answer = place.line("card --samples 4 --soil soil.toml --out card");
    assert_eq!(answer.code(), 0, "{}", answer.stderr);
    for file in ["card/card.svg", "card/card.html"] {
        check_markup(file, &place.read(file));
    }
}

#[test]
fn messages_and_tables_stay_on_their_lines() {
    let place = hostile_place();
    place.write(
        "tests.csv",
        "wheel,load_n,slip_ratio,sinkage_mm\n\u{1b}[2J\u{202e}a,17,0.2,9\n\u{9b}b,17,0.3,9\n",
    );
    let answer = place.line("validate --data tests.csv --wheel hakuto --soil soil.toml");
    assert_eq!(answer.code(), 2);
    check_shown("several wheels", &answer.stderr);
    assert!(answer.stderr.contains("\\u{1b}[2J\\u{202e}a"), "{}", answer.stderr);
    for line in ["traverse --set scenario.soil=\"\u{202e}\"", "check \u{202e}.toml"] {
        let answer = place.line(line);
        assert_eq!(answer.code(), 2, "{line}");
        check_shown(line, &answer.stderr);
        let forged = answer.stderr.lines().skip(1).any(|line| line.starts_with("error:"));
        assert!(!forged, "{}", answer.stderr);
    }
}

#[test]
fn no_cell_of_csv_is_a_formula_and_our_own_files_can_be_read() {
    let place = Place::new();
    let label = "=cmd|' /C calc'!A0";
    place.write(
        "theirs.csv",
        format!("wheel,W,slip_ratio,sinkage_mm\n\"{label}\",17,-0.2,9\n\"{label}\",17,0.3,9\n"),
    );
    let answer = place.line("import theirs.csv --column load_n=W --out ours.csv");
    assert_eq!(answer.code(), 0, "{}", answer.stderr);
    let ours = place.read("ours.csv");
    assert!(ours.contains("\n17,'=cmd|' /C calc'!A0,-0.2,9\n"), "{ours}");
    // Again, the apostrophe neither doubles nor is part of the label.
    let answer = place.line("import ours.csv --out again.csv");
    assert_eq!((answer.code(), place.read("again.csv")), (0, ours));
    let answer = place.run(&[
        "validate",
        "--data",
        "ours.csv",
        "--wheel",
        "hakuto",
        "--soil",
        "toyoura",
        "--where",
        &format!("wheel={label}"),
    ]);
    assert_eq!(answer.code(), 0, "{}", answer.stderr);
}

#[test]
fn a_traverse_names_its_wheels_without_formulas() {
    let place = Place::new();
    let rover =
        changed_preset("rover", "hakuto", "name = \"front-left\"", "name = \"@front\\nleft\"");
    place.write("rover.toml", rover);
    let csv = place.results("traverse --rover rover.toml --duration-s 0.5 --format csv");
    assert!(
        csv.lines().next().is_some_and(|header| header.contains(",'@front\\nleft.slip_ratio,"))
    );
}

#[test]
fn a_traverse_that_ends_early_says_so_beside_its_csv() {
    let place = Place::new();
    let answer = place.line("traverse --slope-deg 58 --format csv");
    assert_eq!(answer.code(), 0, "{}", answer.stderr);
    assert!(answer.stderr.starts_with("note: tipped_over after "), "{}", answer.stderr);
}

// ---- Files ----

#[test]
fn import_refuses_two_columns_of_one_name() {
    let place = Place::new();
    place.write("a.csv", "load_n,slip_ratio,sinkage_mm,sinkage_mm\n17,0.2,9,8\n");
    place.write("b.csv", "W,W,slip_ratio,sinkage_mm\n17,16,0.2,9\n");
    for line in ["import a.csv", "import b.csv --column load_n=W"] {
        let answer = place.line(line);
        assert_eq!((answer.code(), answer.stdout.as_str()), (2, ""), "{line}");
        assert!(answer.stderr.contains("is there twice"), "{}", answer.stderr);
    }
}

#[test]
fn a_higher_limit_of_rows_reads_more() {
    let place = Place::new();
    place.write("a.csv", "load_n,slip_ratio,sinkage_mm\n17,0.2,9\n17,0.3,10\n");
    let answer = place.line("import a.csv --max-rows 1");
    assert_eq!(answer.code(), 2);
    assert!(
        answer.stderr.contains("more than 1 rows") && answer.stderr.contains("hint: --max-rows")
    );
    assert_eq!(place.line("import a.csv --max-rows 2").code(), 0);
    let columns = (0..9).map(|number| format!("{number}_yaw_deg")).collect::<Vec<_>>().join(",");
    place.write("wide.csv", format!("slope_deg,{columns}\n5,,,,,,,,,\n"));
    let answer = place.line("card --measured wide.csv --max-rows 1");
    assert!(answer.stderr.contains("more than 8 cells"), "{}", answer.stderr);
}

#[test]
fn calibrate_refuses_more_cells_than_it_can_fit() {
    let place = Place::new();
    let rows = (0..10_001).map(|row| format!("17,{},9\n", f64::from(row) * 1e-5));
    let header = "load_n,slip_ratio,sinkage_mm\n".to_owned();
    place.write("many.csv", header + &rows.collect::<String>());
    let answer = place.line(
        "calibrate --data many.csv --wheel hakuto --soil toyoura --fit soil.cohesion_kpa \
         --point-fit",
    );
    assert_eq!(answer.code(), 2);
    assert!(answer.stderr.contains("10001 observations are more than 10000"), "{}", answer.stderr);
}

/// At a bound nothing of first order says how sure a value is: no number stands for it.
#[test]
fn a_fit_that_ends_at_its_bound_has_no_standard_deviation() {
    let place = Place::new();
    let measured = place.results("wheel-test --format csv");
    place.write("tests.csv", measured);
    let answer = place.line(
        "calibrate --data tests.csv --wheel hakuto --soil toyoura --fit soil.cohesion_kpa=5:10 \
         --set soil.cohesion_kpa=6 --point-fit --format json",
    );
    assert_eq!(answer.code(), 0, "{}", answer.stderr);
    assert!(
        answer.stderr.contains("note: soil.cohesion_kpa ends at its bound, 5:"),
        "{}",
        answer.stderr
    );
    let json: serde_json::Value = serde_json::from_str(&answer.stdout).expect("JSON");
    assert!(json["rows"][0]["fit_std"].is_null(), "{}", json["rows"][0]);
}

#[cfg(unix)]
mod unix {
    use std::fs;
    use std::os::unix::fs::{PermissionsExt as _, symlink};

    use super::*;

    const ROWS: &str = "load_n,slip_ratio,sinkage_mm\n17,0.2,9\n";

    #[test]
    fn endless_files_and_pipes_without_a_writer_are_refused_at_once() {
        let place = Place::new();
        assert_eq!(place.shell("mkfifo pipe").code(), 0);
        for (file, part) in [("/dev/zero", "this is a device"), ("pipe", "this is a named pipe")] {
            for line in [
                format!("card --measured {file}"),
                format!("import {file}"),
                format!("validate --data {file} --wheel hakuto --soil toyoura"),
                format!("calibrate --plates {file} --soil toyoura"),
                format!("check {file}"),
            ] {
                let answer = place.line(&line);
                assert_ne!(answer.code(), 0, "{line}");
                assert!(answer.stderr.contains(part), "{line}: {}", answer.stderr);
            }
        }
    }

    #[test]
    fn pipes_that_are_open_are_read_to_their_limit() {
        let place = Place::new();
        place.write("a.csv", ROWS);
        let read = place.shell("cat a.csv | grouser import /dev/stdin");
        assert_eq!((read.code(), read.stdout.as_str()), (0, ROWS), "{}", read.stderr);
        let redirected = place.shell("grouser import /dev/stdin < a.csv");
        assert_eq!(redirected.stdout, ROWS, "{}", redirected.stderr);
        let other = place.shell("grouser import /dev/fd/3 3< a.csv");
        assert_eq!(other.stdout, ROWS, "{}", other.stderr);
        let endless = place.shell("yes 1,2,3 | grouser import /dev/stdin --max-rows 10");
        assert_eq!(endless.code(), 2);
        assert!(endless.stderr.contains("is larger than 1048576 bytes"), "{}", endless.stderr);
    }

    /// Renamed over, a pipe would be gone, and of a device the whole system would miss it.
    #[test]
    fn only_files_are_replaced() {
        let place = Place::new();
        place.write("a.csv", ROWS);
        assert_eq!(place.shell("mkfifo pipe pipe.svg").code(), 0);
        for line in [
            "import a.csv --out pipe --force",
            "card --out pipe.svg --force",
            "import a.csv --out pipe",
        ] {
            let answer = place.line(line);
            assert_eq!(answer.code(), 2, "{line}");
            let said = &answer.stderr;
            assert!(said.contains("is a device or a pipe, which is not replaced"), "{said}");
        }
        assert_eq!(place.shell("test -p pipe && test -p pipe.svg").code(), 0);
    }

    #[test]
    fn a_link_stays_one_when_the_file_behind_it_is_replaced() {
        let place = Place::new();
        place.write("a.csv", ROWS);
        place.write("old.csv", "old");
        symlink("old.csv", place.file("link.csv")).expect("a link");
        assert_eq!(place.line("import a.csv --out link.csv --force").code(), 0);
        assert!(place.file("link.csv").is_symlink());
        assert_eq!(place.read("old.csv"), ROWS);
    }

    #[test]
    fn a_lock_that_is_a_pipe_is_refused() {
        let place = Place::new();
        let line = "campaign run campaign-wheel-test --set campaign.runs=4 --out runs";
        assert_eq!(place.line(line).code(), 0);
        assert_eq!(place.shell("rm runs/.lock && mkfifo runs/.lock").code(), 0);
        let answer = place.line(line);
        assert_eq!(answer.code(), 1, "{}", answer.stderr);
        assert!(answer.stderr.contains("it is no regular file: remove it"), "{}", answer.stderr);
    }

    #[test]
    fn a_link_to_nothing_is_called_one() {
        let place = Place::new();
        symlink("gone", place.file("link")).expect("a link");
        for line in [
            "check link",
            "traverse link",
            "card --measured link",
            "traverse --out link",
            "import a.csv --out link",
        ] {
            place.write("a.csv", ROWS);
            let answer = place.line(line);
            assert_eq!(answer.code(), 2, "{line}");
            assert!(
                answer.stderr.contains("a link to gone, which does not exist"),
                "{}",
                answer.stderr
            );
        }
    }

    #[test]
    fn a_new_file_has_the_usual_permissions_and_a_replaced_one_keeps_its_own() {
        let place = Place::new();
        place.write("a.csv", ROWS);
        let mode = |name: &str| {
            fs::metadata(place.file(name)).expect("it is there").permissions().mode() & 0o777
        };
        let line = "umask 027; grouser import a.csv --out new.csv";
        assert_eq!(place.shell(line).code(), 0);
        assert_eq!(mode("new.csv"), 0o640);
        fs::set_permissions(place.file("new.csv"), fs::Permissions::from_mode(0o604))
            .expect("mine");
        let line = "umask 077; grouser import a.csv --out new.csv --force";
        assert_eq!(place.shell(line).code(), 0);
        assert_eq!(mode("new.csv"), 0o604);
    }
}

/// What is wrong with a line is quoted by the parser of command lines, which knows of no terminals.
#[test]
fn arguments_are_quoted_without_what_steers_a_terminal() {
    let place = Place::new();
    for argument in ["\u{202e}json", "js\u{9b}31mon", "\u{1b}[31mjson"] {
        for words in [&["wheel-test", "--format", argument][..], &[argument], &["check", argument]]
        {
            let answer = place.run(words);
            assert_eq!(answer.code(), 2, "{words:?}");
            check_shown(argument, &answer.stderr);
        }
    }
}
