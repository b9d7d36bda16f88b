//! Messages name keys: what sets them is a flag in the program and an argument in Python, and each
//! front end says so itself.

use std::fs;

use super::layers::{skipped, sources_of_the_library, visit};

/// The string literals of a source, without its tests.
fn strings_of(text: &str) -> Vec<(usize, &str)> {
    let shipped = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    let (mut strings, mut at) = (Vec::new(), 0);
    while let Some(first) = shipped[at..].chars().next() {
        let rest = &shipped[at..];
        let length = skipped(rest).unwrap_or(first.len_utf8());
        // Comments and characters are skipped as strings are, and begin otherwise.
        if length > 1 && !rest.starts_with(['/', '\'']) {
            strings.push((shipped[..at].matches('\n').count() + 1, &rest[..length]));
        }
        at += length;
    }
    strings
}

/// A flag, or a command, of the program.
fn of_the_program(string: &str) -> bool {
    let is_flag = |after: &str| after.starts_with(|c: char| c.is_ascii_lowercase());
    string.split("--").skip(1).any(is_flag) || string.contains("`grouser ")
}

#[test]
fn no_message_names_a_flag_or_a_command() {
    let (mut found, mut count) = (Vec::new(), 0);
    for sources in sources_of_the_library() {
        visit(&sources, &mut |file| {
            let text = fs::read_to_string(file).expect("a source is text");
            for (line, string) in strings_of(&text) {
                count += 1;
                if of_the_program(string) {
                    found.push(format!("{}:{line}: {string}", file.display()));
                }
            }
        });
    }
    assert!(count > 1000, "only {count} strings were found");
    assert!(found.is_empty(), "\n{}\n", found.join("\n"));
}

#[test]
fn flags_and_commands_are_seen() {
    let text = "// --set\nfn f() { g(\"add --set a=1\"); }\n#[cfg(test)]\nmod tests { \"--x\" }";
    assert_eq!(strings_of(text), [(2, "\"add --set a=1\"")]);
    for string in ["add --set a=1", "`grouser import` does it"] {
        assert!(of_the_program(string));
    }
    for string in ["a -- b", "grouser height [m]", "|---|"] {
        assert!(!of_the_program(string));
    }
}
