//! Everything that the program says to the examples of the documents, in a folder: of two such
//! folders, before and after a change of structure, every bit is the same but for keys that were
//! renamed.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use anyhow::{Context, Result, ensure};
use pulldown_cmark::{CodeBlockKind, Event, Parser, Tag, TagEnd};
use wait_timeout::ChildExt;

use crate::markers::{self, Kind, Piece};
use crate::{diff, workspace};

/// Keys that have another name now: a line for each, the former and the present.
const RENAMED: &str = "xtask/renamed.txt";
/// What takes longer is no example of a reader's.
const MOST_TIME: Duration = Duration::from_secs(60);
/// What examples name, from the root.
const NAMED: [&str; 2] = ["crates", "docs"];

/// Runs every example, and writes what each says, and what files it makes, into a folder.
///
/// * `folder`: replaced where it is there
/// * `program`: that of another build, if not of this one
pub(crate) fn write(folder: &Path, program: Option<PathBuf>) -> Result<()> {
    let program = program.map_or_else(workspace::build_program, Ok)?;
    let program = fs::canonicalize(program).context("the program")?;
    if folder.exists() {
        fs::remove_dir_all(folder).context("the folder")?;
    }
    let mut count = 0;
    for (path, text) in workspace::texts_with_extension("md")? {
        let examples = examples(&text).with_context(|| path.clone())?;
        if examples.is_empty() {
            continue;
        }
        // Examples of one document may build on each other.
        let place = folder.join(path.replace('/', "-"));
        fs::create_dir_all(&place)?;
        for name in NAMED {
            link(&workspace::root().join(name), &place.join(name))?;
        }
        for (number, arguments) in examples.iter().enumerate() {
            for (form, arguments) in forms(&program, arguments, number) {
                let name = format!("{number:02}-{form}.txt");
                fs::write(place.join(name), said(&program, &arguments, &place)?)?;
                count += 1;
            }
        }
        for name in NAMED {
            fs::remove_file(place.join(name))?;
        }
    }
    println!("{count} outputs in {}", folder.display());
    Ok(())
}

#[cfg(unix)]
fn link(of: &Path, at: &Path) -> Result<()> {
    std::os::unix::fs::symlink(of, at).context("a link")
}

#[cfg(not(unix))]
fn link(_: &Path, _: &Path) -> Result<()> {
    anyhow::bail!("links to folders are made on Unix alone")
}

/// What readers of a document would type: the lines of its shell blocks, and what makes its own
/// blocks.
fn examples(markdown: &str) -> Result<Vec<Vec<String>>> {
    let mut found = Vec::new();
    for piece in markers::pieces(markdown)? {
        if let Piece::Made(block) = piece
            && block.kind != Kind::Measurement
        {
            let commands = markers::commands(&block.arguments)?;
            found.extend(commands.into_iter().map(<[String]>::to_vec));
        }
    }
    let mut is_shell = false;
    for event in Parser::new(markdown) {
        match event {
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(language))) => {
                is_shell = &*language == "sh";
            }
            Event::End(TagEnd::CodeBlock) => is_shell = false,
            Event::Text(text) if is_shell => found.extend(typed(&text)),
            _ => {}
        }
    }
    let mut seen = BTreeSet::new();
    found.retain(|arguments| seen.insert(arguments.clone()));
    Ok(found)
}

/// The program's arguments on each line of a shell block that calls it and nothing else.
fn typed(block: &str) -> Vec<Vec<String>> {
    let whole = block.replace("\\\n", " ");
    let arguments = |line: &str| {
        let line = line.split(" #").next().unwrap_or_default();
        let words = shell_words::split(line.strip_prefix("grouser ")?).ok()?;
        let is_plain = !words.iter().any(|word| ["|", ">", "&&", "&"].contains(&&**word));
        is_plain.then_some(words)
    };
    whole.lines().filter_map(arguments).collect()
}

/// Ways to ask for an example's answer, each with its name: as it is, and as all that a script
/// would ask.
fn forms(program: &Path, arguments: &[String], number: usize) -> Vec<(&'static str, Vec<String>)> {
    let mut forms = vec![("as-it-is", arguments.to_vec())];
    let help = Command::new(program).args(&arguments[..1]).arg("--help").output();
    let help = help.map(|it| String::from_utf8_lossy(&it.stdout).into_owned()).unwrap_or_default();
    let bare: Vec<String> = without(arguments, &["--format", "--out"]);
    let mut with = |name, more: &[String]| forms.push((name, [&bare[..], more].concat()));
    for format in ["json", "csv"] {
        if help.contains("--format") {
            with(format, &["--format".to_owned(), format.to_owned()]);
        }
    }
    if help.contains("--out <DIR>") {
        with("out", &["--out".to_owned(), format!("{number:02}-out"), "--force".to_owned()]);
    }
    forms
}

/// Arguments without some options and their values.
fn without(arguments: &[String], options: &[&str]) -> Vec<String> {
    let mut kept = Vec::new();
    let mut rest = arguments.iter();
    while let Some(word) = rest.next() {
        if options.contains(&&**word) {
            rest.next();
        } else {
            kept.push(word.clone());
        }
    }
    kept
}

/// What the program prints, and how it ends.
fn said(program: &Path, arguments: &[String], place: &Path) -> Result<String> {
    let streams = ["stdout", "stderr"].map(|name| place.join(name));
    let [out, err] = [fs::File::create(&streams[0])?, fs::File::create(&streams[1])?];
    let mut command = Command::new(program);
    command.args(arguments).current_dir(place).env("NO_COLOR", "1");
    let mut child = command.stdin(Stdio::null()).stdout(out).stderr(err).spawn()?;
    let end = if let Some(status) = child.wait_timeout(MOST_TIME)? {
        status.to_string()
    } else {
        child.kill()?;
        child.wait()?;
        "too long".to_owned()
    };
    let [out, err] = streams.each_ref().map(|path| fs::read(path).unwrap_or_default());
    streams.iter().try_for_each(fs::remove_file)?;
    let [out, err] = [out, err].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    Ok(format!("grouser {}\n{end}\n{out}\n── \n{err}", shell_words::join(arguments)))
}

/// Whether two folders are the same but for what was renamed; prints what is not.
pub(crate) fn compare(before: &Path, after: &Path) -> Result<bool> {
    let renamed = fs::read_to_string(workspace::root().join(RENAMED)).unwrap_or_default();
    let renamed: Vec<(&str, &str)> =
        renamed.lines().filter_map(|line| line.split_once(' ')).collect();
    let (names, others) = (files(before)?, files(after)?);
    ensure!(!names.is_empty(), "{} is empty", before.display());
    let mut differing = 0;
    for name in names.union(&others) {
        let [was, is] =
            [before, after].map(|folder| fs::read(folder.join(name)).unwrap_or_default());
        if was == is {
            continue;
        }
        // A former name that is still one of another thing becomes the same on both sides.
        let [was, is] = [was, is].map(|text| with_names(&text, &renamed));
        if was != is {
            println!("{}\n{}", name.display(), diff::between(&was, &is));
            differing += 1;
        }
    }
    println!("{} files, {differing} differ", names.union(&others).count());
    Ok(differing == 0)
}

/// A text with the present names of keys: whole words of letters, digits and underscores.
fn with_names(text: &[u8], renamed: &[(&str, &str)]) -> String {
    let text = String::from_utf8_lossy(text);
    let is_letter = |it: char| it.is_alphanumeric() || it == '_';
    let mut with_names = String::with_capacity(text.len());
    let mut rest = &*text;
    while !rest.is_empty() {
        let end = rest.find(|it| !is_letter(it)).unwrap_or(rest.len());
        let (word, others) = rest.split_at(end);
        let present = renamed.iter().find(|(former, _)| *former == word);
        with_names.push_str(present.map_or(word, |(_, present)| present));
        let gap = others.find(is_letter).unwrap_or(others.len());
        with_names.push_str(&others[..gap]);
        rest = &others[gap..];
    }
    with_names
}

/// Files below a folder, as paths from it.
fn files(folder: &Path) -> Result<BTreeSet<PathBuf>> {
    let mut found = BTreeSet::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).with_context(|| next.display().to_string())? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
            } else {
                found.insert(path.strip_prefix(folder)?.to_owned());
            }
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn examples_are_what_readers_would_type() {
        let markdown = "\
<!-- made by: cargo run --release -- heading --slope-deg 5 -->
x
<!-- end -->

```sh
grouser card --soil toyoura \\
    --samples 4      # a draft
grouser log | head
ls
grouser heading --slope-deg 5
```

```python
grouser card
```
";
        let found = examples(markdown).expect("examples");
        let found: Vec<String> = found.iter().map(|words| words.join(" ")).collect();
        assert_eq!(found, ["heading --slope-deg 5", "card --soil toyoura --samples 4"]);
    }

    #[test]
    fn whole_words_are_renamed() {
        let renamed = [("loads", "load_transfer"), ("speed_m_s", "rim_speed_m_s")];
        let text = b"{\"loads\": 1, \"no_loads\": 2}\nspeed_m_s,rim_speed_m_s\n";
        let expected = "{\"load_transfer\": 1, \"no_loads\": 2}\nrim_speed_m_s,rim_speed_m_s\n";
        assert_eq!(with_names(text, &renamed), expected);
    }

    #[test]
    fn options_go_with_their_values() {
        let words = ["heading", "--out", "x", "--samples", "3"].map(String::from);
        assert_eq!(without(&words, &["--out"]), ["heading", "--samples", "3"]);
    }
}
