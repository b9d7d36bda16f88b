//! `grouser new`: a rover, a wheel, a soil, a scenario or a mission from answers to questions.

mod dialogue;

use std::io::{BufReader, IsTerminal as _, stderr, stdin};
use std::path::{Path, PathBuf};

use grouser::document::draft::{Draft, Question};
use grouser::document::{self, Checked, Kind, Source, escape};
use serde::Serialize;

use crate::args::NewArgs;
use crate::failure::Failure;
use crate::output::rows::Rows;
use crate::output::{self, activity, file};
use dialogue::shown_value;

pub(crate) fn run(args: &NewArgs) -> Result<(), Failure> {
    let kind = Kind::from(args.kind);
    let Some(mut draft) = Draft::new(kind) else { return Ok(()) };
    if let Some(name) = &args.name {
        draft.answer("name", name)?;
    }
    for setting in &args.answers {
        let Some((key, value)) = setting.split_once('=') else {
            let setting = escape::line(setting);
            return Err(Failure::Usage(format!("--set {setting}: not of the form KEY=VALUE")));
        };
        draft.answer(key.trim(), value)?;
    }
    if args.questions {
        return list(&draft);
    }
    let is_asked = !args.yes && stdin().is_terminal();
    // Before anyone types; a name that is still to be asked for leads to another file.
    if !is_asked || args.out.is_some() || draft.is_answered("name") {
        file::check_new(&target(args, &draft)?, args.force)?;
    }
    if is_asked {
        activity::end();
        dialogue::ask_all(&mut draft, &mut BufReader::new(stdin()), &mut stderr())?;
    }
    let text = draft.finish()?;
    let out = target(args, &draft)?;
    file::check_new(&out, args.force)?;
    document::checked(&Source::text(escape::path(&out), text.clone()))?;
    let is_replaced = out.exists();
    file::write(&out, text.as_bytes())?;
    // Names of files that it has start from its own folder.
    document::checked(&Source::file(&out)).inspect_err(|_| {
        if !is_replaced {
            // What cannot be removed is at least reported.
            drop(std::fs::remove_file(&out));
        }
    })?;
    report(kind, &draft, &out, is_asked)
}

/// The file of a draft.
fn target(args: &NewArgs, draft: &Draft) -> Result<PathBuf, Failure> {
    if let Some(out) = &args.out {
        return Ok(out.clone());
    }
    let name = draft.question("name")?.usual;
    let name =
        draft.text_of("name").or_else(|| name.and_then(|name| name.as_str().map(str::to_owned)));
    Ok(PathBuf::from(slug(&name.unwrap_or_default()) + ".toml"))
}

/// A name as a file has it: small letters, digits and hyphens.
fn slug(name: &str) -> String {
    let plain = |letter: char| if letter.is_alphanumeric() { letter } else { '-' };
    let words: String = name.to_lowercase().chars().map(plain).collect();
    let words: Vec<&str> = words.split('-').filter(|word| !word.is_empty()).collect();
    if words.is_empty() { "unnamed".to_owned() } else { words.join("-") }
}

/// What was written, what is assumed in it, and what to do next.
fn report(kind: Kind, draft: &Draft, out: &Path, is_asked: bool) -> Result<(), Failure> {
    let Checked { assumed, .. } = document::checked(&Source::file(out))?;
    let shown = escape::path(out);
    let mut text = format!("{shown}: a valid {kind} document\n");
    let unanswered: Vec<Question> = draft
        .keys()
        .iter()
        .filter(|key| !draft.is_answered(key) && !draft.is_idle(key))
        .map(|key| draft.question(key))
        .collect::<Result<_, _>>()?;
    let lines = unanswered.iter().filter_map(|question| {
        let value = shown_value(question.usual.as_ref()?);
        Some(format!("  not answered: {} = {value}, {}\n", question.key, question.why))
    });
    text.extend(lines.map(|line| escape::visible(&line).into_owned()));
    if kind == Kind::Soil && !assumed.is_empty() {
        let keys: Vec<&str> = assumed.iter().map(|it| it.key.as_str()).collect();
        text.extend(["  left to priors: ", &keys.join(", "), "\n"]);
    }
    let not_kept = draft.not_kept();
    if !not_kept.is_empty() {
        text.extend([
            "  not taken from the preset, as it is of its own tests: ",
            &not_kept.join(", "),
            "\n",
        ]);
    }
    if !unanswered.is_empty() && !is_asked {
        text.push_str(
            "hint: --set KEY=VALUE answers a question; on a terminal, without --yes, it asks (answers from a pipe \
             are not read)\n",
        );
    }
    text.extend(["next: ", &next(kind, out), "\n"]);
    output::show(text)
}

/// The command to run next.
fn next(kind: Kind, out: &Path) -> String {
    let out = escape::path(out);
    let out = if out.contains([' ', '\'', '"']) { format!("\"{out}\"") } else { out };
    match kind {
        Kind::Rover => format!("grouser heading --rover {out}"),
        Kind::Wheel => format!("grouser wheel-test --wheel {out}"),
        Kind::Soil => format!("grouser heading --soil {out} --slope-deg 5,10,15"),
        Kind::Mission => format!("grouser mission {out}"),
        _ => format!("grouser traverse {out}"),
    }
}

#[derive(Serialize)]
struct Row {
    key: &'static str,
    usual: String,
    range: String,
    question: String,
}

/// The questions as a table.
fn list(draft: &Draft) -> Result<(), Failure> {
    let row = |key: &&str| {
        let Question { key, doc, range, usual, .. } = draft.question(key)?;
        let usual = usual.as_ref().map_or_else(|| "-".to_owned(), shown_value);
        Ok(Row { key, usual, range: range.unwrap_or_else(|| "-".to_owned()), question: doc })
    };
    let rows = draft.keys().iter().map(row).collect::<Result<Vec<Row>, Failure>>()?;
    output::show(Rows::of(&rows).to_table(&["key", "usual", "range", "question"]))
}

#[cfg(test)]
mod tests {
    use super::slug;

    #[test]
    fn files_are_named_for_what_they_hold() {
        for (name, file) in [
            ("My rover", "my-rover"),
            ("../../etc/passwd", "etc-passwd"),
            ("Jade Rabbit 2 (玉兔)", "jade-rabbit-2-玉兔"),
            ("...", "unnamed"),
        ] {
            assert_eq!(slug(name), file);
        }
    }
}
