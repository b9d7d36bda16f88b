//! The library's hints as flags of the command line: it names keys, columns and conditions, and
//! here stand the flags and commands that set them.

use std::ffi::OsString;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use grouser::document::{Kind, present_names};

/// Words of the library's messages, and the same with the program's flags.
const WORDS: [(&str, &str); 14] = [
    ("by the setting soil.", "by --set soil."),
    ("for instance soil.cohesion_kpa", "for instance --set soil.cohesion_kpa"),
    ("choose by the condition wheel=", "choose with --where wheel="),
    ("or a wheel whose name ends so", "or a --wheel whose name ends so"),
    ("an import with the delimiter ", "`grouser import` with --delimiter "),
    ("an import turns files", "`grouser import` turns files"),
    ("are decimals written with a comma?", "are decimals written with a comma? --decimal-comma"),
    ("are fields parted by the delimiter ", "are fields parted otherwise, as by --delimiter "),
    ("does the header stand further down?", "does the header stand further down? --skip-lines N"),
    ("say which of them is which of ours", "say which is which: --column load_n=THEIRS"),
    (
        "a preset is a document to start from",
        "`grouser presets NAME` prints a document to start from",
    ),
    ("another speed or a rolling start", "another --rim-speed-m-s or a rolling start"),
    ("without them the load transfer is ", "without them --load-transfer is "),
    (
        "let it start elsewhere, or with a larger `belly_clearance_m`",
        "let it start elsewhere (--start-x-m and --start-y-m), or with a larger clearance (--set \
         rover.belly_clearance_m=M)",
    ),
];

/// Flags that set keys, words of messages about these keys, and what who typed the flag knows.
const OF_FLAGS: [(&str, &str, &str); 5] = [
    ("--start-x-m", "x of `terrain.start_m`", "x of the start"),
    ("--start-x-m", "y of `terrain.start_m`", "y of the start"),
    ("--ground-speed-m-s", "unknown key `drive.ground_speed_m_s`", "this drive has no such speed"),
    (
        "--reference-slip-ratio",
        "unknown key `drive.reference_slip_ratio`",
        "this drive has no such slip ratio",
    ),
    ("--rim-speed-m-s", "unknown key `drive.rim_speed_m_s`", "this drive has no such speed"),
];

/// The option of some commands alone that others are asked for, too.
const SLIDE: &str = "slide";

/// A message of the library with the flags of the program.
pub(crate) fn with_flags(message: &str) -> String {
    let words = WORDS.map(|(library, program)| (library.to_owned(), program.to_owned()));
    let kinds = Kind::ALL.map(|kind| {
        let library = format!("for instance {kind}.KEY=VALUE, or another {kind} by its name");
        (library, format!("for instance --set {kind}.KEY=VALUE, or --{kind} NAME"))
    });
    let all = words.into_iter().chain(kinds);
    let text =
        all.fold(message.to_owned(), |text, (library, program)| text.replace(&library, &program));
    let is_of = |flag: &str, key: &str| text.starts_with(flag) && text.contains(key);
    match OF_FLAGS.into_iter().find(|(flag, key, _)| is_of(flag, key)) {
        Some((_, key, known)) => {
            text.replace(key, known).replace("it goes with law = ", "it goes with --drive ")
        }
        None => text,
    }
}

/// A note of the library on the file of `--terrain`, with a flag in place of its key.
///
/// * `kind`: of the document that the flag changes
pub(crate) fn of_terrain(note: &str, kind: Kind) -> String {
    let Some((before, rest)) = note.split_once("`terrain.missing_m` = ") else {
        return note.to_owned();
    };
    let (height, rest) = rest.split_once(' ').unwrap_or((rest, ""));
    format!("{before}`--set {kind}.terrain.missing_m={height}` {rest}")
}

/// Puts the present option in place of what the parser takes for similar, where an option is
/// withdrawn.
///
/// * `command`: the program's
/// * `arguments`: those that were given
pub(crate) fn with_present_option(
    mut answer: clap::Error,
    command: &clap::Command,
    arguments: impl IntoIterator<Item = OsString>,
) -> clap::Error {
    let Some(ContextValue::String(given)) = answer.get(ContextKind::InvalidArg) else {
        return answer;
    };
    let name = given.trim_start_matches('-').replace('-', "_");
    let mut words = arguments.into_iter().filter_map(|argument| argument.into_string().ok());
    let named = words.find_map(|word| command.find_subcommand(word)).unwrap_or(command);
    let has = |option: &str| named.get_arguments().any(|one| one.get_long() == Some(option));
    let present = present_names(&name).iter().map(|name| name.replace('_', "-"));
    let present: Vec<_> =
        present.filter(|option| has(option)).map(|option| format!("--{option}")).collect();
    if answer.kind() == ErrorKind::UnknownArgument && !present.is_empty() {
        answer.insert(ContextKind::SuggestedArg, ContextValue::Strings(present));
    }
    if answer.kind() == ErrorKind::UnknownArgument && name == SLIDE {
        let has = |of: &&clap::Command| of.get_arguments().any(|one| one.get_long() == Some(SLIDE));
        let able = command.get_subcommands().filter(|of| !of.is_hide_set()).filter(has);
        let able: Vec<&str> = able.map(clap::Command::get_name).collect();
        let tip = format!("a slide has the answer of {}", able.join(", "));
        answer.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
    }
    answer
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::*;

    fn sources(folder: &Path) -> String {
        let entries = fs::read_dir(folder).expect("a folder of sources");
        let texts = entries.map(|entry| {
            let path = entry.expect("an entry").path();
            if path.is_dir() { sources(&path) } else { fs::read_to_string(path).expect("a source") }
        });
        texts.collect()
    }

    /// A reworded message of the library would lose its flag without a word.
    #[test]
    fn the_library_still_says_so() {
        let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let folders =
            ["grouser-core", "grouser-io", "grouser"].map(|name| crates.join(name).join("src"));
        let text: String = folders.iter().map(|folder| sources(folder)).collect();
        // A string that goes on in the next line.
        let lines = text.split("\\\n").map(str::trim_start);
        let text = lines.collect::<String>();
        for (library, _) in &WORDS[1..] {
            assert!(text.contains(library), "the library does not say `{library}`");
        }
        // Here the key is filled in.
        for setting in ["soil.{path}=VALUE", "{name}=VALUE"] {
            assert!(text.contains(&format!("by the setting {setting}")), "{setting}");
        }
        assert!(text.contains("for instance {kind}.KEY=VALUE, or another {kind} by its name"));
    }

    #[test]
    fn keys_get_their_flags() {
        let message = "give it another by the setting soil.rft.scale=VALUE";
        assert_eq!(with_flags(message), "give it another by --set soil.rft.scale=VALUE");
        let message = "--set soil.n=1: unknown key `soil.n`";
        assert_eq!(with_flags(message), message);
        let message = "for instance wheel.KEY=VALUE, or another wheel by its name";
        assert_eq!(with_flags(message), "for instance --set wheel.KEY=VALUE, or --wheel NAME");
        let message = "--ground-speed-m-s 1: unknown key `drive.ground_speed_m_s`\nhint: it goes \
                       with law = \"eq18\"";
        let known = "this drive has no such speed\nhint: it goes with --drive \"eq18\"";
        assert_eq!(with_flags(message), format!("--ground-speed-m-s 1: {known}"));
        let note = of_terrain("missing heights? `terrain.missing_m` = -9 takes", Kind::Mission);
        assert_eq!(note, "missing heights? `--set mission.terrain.missing_m=-9` takes");
    }
}
