//! What a terminal gets: colours, tables in its width, progress; and that files and pipes get none
//! of it.

use std::process::Output;

use crate::program::Place;

const MAP: &str = "heading-map --slope-deg 8,24 --course-deg=-30,0,30";

/// The output of a line, escape codes and all.
fn raw(line: &str) -> Output {
    let words: Vec<&str> = line.split_whitespace().collect();
    Place::new().command(&words).output().expect("the program starts")
}

fn stdout(line: &str) -> String {
    String::from_utf8(raw(line).stdout).expect("UTF-8")
}

#[test]
fn a_map_is_a_table_of_slopes_and_courses_in_a_width_and_long_without_one() {
    let place = Place::new();
    let text = place.results(&format!("{MAP} --width 80"));
    insta::assert_snapshot!("terminal_heading_map", text);
    let long = place.results(MAP);
    assert!(long.starts_with("soil "), "{long}");
    assert_eq!(long.lines().filter(|line| line.starts_with("Toyoura sand")).count(), 6, "{long}");
}

/// Programs read CSV and JSON: they are the same in any terminal.
#[test]
fn csv_and_json_know_no_width() {
    let place = Place::new();
    for format in ["csv", "json"] {
        let line = format!("{MAP} --format {format}");
        assert_eq!(
            place.results(&format!("{line} --width 40 --color always")),
            place.results(&line)
        );
    }
}

/// In 80 columns the flags and the reason are a line each, and a column that is left out has its
/// name there.
#[test]
fn a_narrow_table_says_what_it_leaves_out() {
    let line = "wheel-test --soil lunar-nominal --slip-ratio 0.1,0.5,0.9 --load-n 200 --width 80";
    let text = Place::new().results(line);
    insta::assert_snapshot!("terminal_wheel_test", text);
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    assert!(text.contains("a pipe: entry_angle_deg\n"), "{text}");
    assert_eq!(text.matches("the soil carries at most").count(), 1, "{text}");
}

#[test]
fn colours_stand_where_they_are_asked_for_and_change_no_word() {
    let line = "card --soil toyoura-uncertain --samples 20 --model ishigami";
    let coloured = stdout(&format!("{line} --color always"));
    for code in ["\u{1b}[32mgo\u{1b}[0m", "\u{1b}[33mcaution\u{1b}[0m", "\u{1b}[1mverdict\u{1b}[0m"]
    {
        assert!(coloured.contains(code), "{code:?} in {coloured:?}");
    }
    let plain = anstream::adapter::strip_str(&coloured).to_string();
    assert_eq!(plain, stdout(line));
    assert_eq!(plain, stdout(&format!("{line} --color never")));
}

#[test]
fn errors_have_colours_whether_they_are_ours_or_the_parsers() {
    for line in ["heading --soil tojoura --color always", "heading --bad --color=always"] {
        let stderr = String::from_utf8(raw(line).stderr).expect("UTF-8");
        assert!(stderr.starts_with("\u{1b}[1m\u{1b}[31merror:"), "{line}: {stderr:?}");
    }
}

#[test]
fn quiet_keeps_errors_and_drops_notes() {
    let place = Place::new();
    let line = "presets hakuto";
    let noted = place.line(line);
    assert!(noted.stderr.starts_with("note: "), "{}", noted.stderr);
    for flag in ["--quiet", "-q"] {
        let quiet = place.line(&format!("{line} {flag}"));
        assert_eq!((quiet.stderr.as_str(), &quiet.stdout), ("", &noted.stdout));
        assert!(place.line(&format!("presets nothing {flag}")).stderr.starts_with("error: "));
    }
}

#[test]
fn a_width_beyond_reason_is_refused() {
    for width in ["19", "1001", "-5", "wide"] {
        let answer = Place::new().line(&format!("presets --width={width}"));
        assert_eq!(answer.code(), 2, "{width}");
    }
}

/// Runs a line in a pseudo-terminal of some columns, with its standard error.
#[cfg(target_os = "linux")]
fn in_terminal(place: &Place, columns: u16, line: &str) -> String {
    use std::process::Stdio;
    let line = format!("stty rows 24 cols {columns}; {} {line}", crate::program::GROUSER);
    let mut script = std::process::Command::new("script");
    script.args(["-qec", &line, "/dev/null"]).current_dir(place.path()).stdin(Stdio::null());
    script.env("TERM", "xterm").env_remove("NO_COLOR").env_remove("CLICOLOR").env_remove("CI");
    let output = script.output().expect("script of util-linux");
    String::from_utf8(output.stdout).expect("UTF-8").replace("\r\n", "\n")
}

#[cfg(target_os = "linux")]
#[test]
fn a_terminal_gets_its_width_and_colours() {
    let place = Place::new();
    let text = in_terminal(&place, 60, "heading --slope-deg 10,25 --nominal");
    assert!(text.contains("\u{1b}[31m[1]\u{1b}[0m"), "{text:?}");
    let plain = anstream::adapter::strip_str(&text).to_string();
    assert!(plain.lines().all(|line| line.chars().count() <= 60), "{plain}");
    assert_eq!(plain, place.results("heading --slope-deg 10,25 --nominal --width 60"));
}

/// Work of more than a second has a line with its time, and `--quiet` has none.
#[cfg(target_os = "linux")]
#[test]
fn long_work_is_seen_at_work() {
    let place = Place::new();
    let line = "heading --soil toyoura-uncertain --slope-deg 5 --uncertainty --samples 300";
    assert!(in_terminal(&place, 80, line).contains(" samples "));
    assert!(!in_terminal(&place, 80, &format!("{line} --quiet")).contains(" samples "));
    // No count of steps is known here.
    let line = "wheel-test --model rft --load-n 1:200:0.2 --slip-ratio 0.1,0.5,0.9 --format csv";
    let started = std::time::Instant::now();
    place.results(line);
    let is_long = started.elapsed() > std::time::Duration::from_secs(2);
    let text = in_terminal(&place, 80, line);
    // A machine on which this takes less than a second shows no line, and need not.
    assert!(!is_long || text.contains("wheel-test  "), "{text:?}");
}
