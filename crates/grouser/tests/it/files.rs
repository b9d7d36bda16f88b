//! Files that cannot be used are refused at once, with what they are and where they are named.

use std::path::PathBuf;

use grouser::document::measurements::{self, Choice, Limits};
use grouser::document::{self, Overrides, Source};

/// A folder of its own, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("grouser-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder");
        Self(path)
    }

    fn write(&self, name: &str, content: &str) -> PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, content).expect("a file");
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn refusal_of_scenario(path: PathBuf) -> String {
    document::read_scenario(&Source::file(path), &Overrides::none()).unwrap_err().to_string()
}

#[test]
fn an_unusable_file_is_reported_with_the_line_that_names_it() {
    let folder = Folder::new("named");
    let line = "schema = \"scenario/1\"\nname = \"a\"\nsoil = \"SOIL\"\n";
    std::fs::create_dir(folder.0.join("folder.toml")).expect("a folder");
    folder.write("bytes.toml", "name = \"\u{0}\"");
    std::fs::write(folder.0.join("latin.toml"), b"name = \"\xe4\"").expect("a file");
    let too_long = usize::try_from(document::LARGEST_FILE).expect("a megabyte") + 1;
    folder.write("large.toml", &" ".repeat(too_long));
    folder.write("wrong.toml", "schema = \"soil/1\"\nname = 5\n");
    for (soil, part) in [
        ("folder.toml", "this is a folder"),
        ("latin.toml", "is not a text"),
        ("large.toml", "is larger than 1048576 bytes"),
        ("bytes.toml", "not TOML"),
        ("wrong.toml", "`soil.name` is the integer 5"),
    ] {
        let scenario = folder.write("run.toml", &line.replace("SOIL", soil));
        let message = refusal_of_scenario(scenario);
        assert!(message.contains(part) && message.contains(soil), "{message}");
        assert!(message.contains("the file is named by ") && message.contains("run.toml:3:8"));
    }
    // A file that is not there is reported at the line itself.
    let message = refusal_of_scenario(folder.write("run.toml", &line.replace("SOIL", "no.toml")));
    assert!(message.contains("run.toml:3:8: there is no such file"), "{message}");
}

#[cfg(unix)]
#[test]
fn devices_and_links_to_nothing_are_refused_at_once() {
    use std::os::unix::fs::symlink;
    let folder = Folder::new("links");
    let link = folder.0.join("link");
    symlink("gone.csv", &link).expect("a link");
    for (path, part) in [
        (link.clone(), "this is a link to gone.csv, which does not exist"),
        (PathBuf::from("/dev/zero"), "this is a device, not a file"),
        (folder.0.clone(), "this is a folder, not a file"),
        (folder.0.join("none"), "there is no such file"),
    ] {
        let measured = measurements::read(&path, &Choice::default()).unwrap_err().to_string();
        assert!(measured.contains(part), "{measured}");
        let document = document::check(&Source::file(path)).unwrap_err().to_string();
        assert!(document.contains(part), "{document}");
    }
    let named = Source::find(document::Kind::Soil, &link.display().to_string());
    assert!(matches!(named, Ok(Source::File(_))));
}

#[test]
fn more_rows_than_the_limit_are_refused_and_a_higher_limit_reads_them() {
    let rows =
        |count: usize| "load_n,slip_ratio,sinkage_mm\n".to_owned() + &"17,0.2,9\n".repeat(count);
    let choice = |rows| Choice { limits: Limits { rows }, ..Choice::default() };
    let read = |text: &str, rows| measurements::read_from("a.csv", text.as_bytes(), &choice(rows));
    let error = read(&rows(11), 10).unwrap_err().to_string();
    assert_eq!(
        error,
        "a.csv:12: has more than 10 rows, the most that are read: split the file, or raise the \
         limit"
    );
    assert_eq!(read(&rows(10), 10).expect("ten").tests.trials.len(), 10);
    assert_eq!(read(&rows(11), 11).expect("eleven").tests.trials.len(), 11);
}

/// What a spreadsheet would compute is a text with an apostrophe in our files, and comes back.
#[test]
fn a_label_that_looks_like_a_formula_comes_back() {
    let text =
        "wheel,load_n,slip_ratio,sinkage_mm\n\"'=HYPERLINK(\"\"x\"\")\",17,0.2,9\n'@b,17,-0.2,9\n";
    let error = measurements::read_from("a.csv", text.as_bytes(), &Choice::default()).unwrap_err();
    assert!(error.to_string().contains("wheels: =HYPERLINK(\"x\"), @b"), "{error}");
    let condition = measurements::Condition::parse("wheel=@b").expect("a condition");
    let choice = Choice { conditions: vec![condition], ..Choice::default() };
    let read = measurements::read_from("a.csv", text.as_bytes(), &choice).expect("one wheel");
    assert_eq!(read.lines, [3]);
}

#[test]
fn messages_are_on_their_lines_whatever_the_cells_hold() {
    let cell = "\u{1b}]0;x\u{7}\u{202e}\u{9b}31m";
    let text = format!("load_n,slip_ratio,sinkage_mm,\"a\nerror: forged\"\n{cell},0.2,9,\n");
    let error = measurements::read_from("a\n.csv", text.as_bytes(), &Choice::default());
    let message = error.unwrap_err().to_string();
    assert!(!message.chars().any(|c| c != '\n' && document::escape::is_hidden(c)), "{message:?}");
    assert!(message.contains("\\u{1b}]0;x\\u{7}\\u{202e}"), "{message}");
    assert!(message.starts_with("a\\n.csv:3: "), "{message}");
}
