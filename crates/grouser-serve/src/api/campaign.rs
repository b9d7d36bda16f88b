//! Campaigns of the folder: those that are there, a run of one with its progress, which goes on
//! where it was stopped, and the statistics of what is computed.

use std::fs;
use std::path::{Path, PathBuf};

use grouser::answers::AnswerError;
use grouser::document::{self, Campaign, Kind, json};
use grouser_draw::Slide;
use grouser_draw::chart::Drawable as _;
use grouser_store::{
    Finished, Folder, Manifest, Results, Statistics, StoreError, Study, compute, figures,
};
use http::StatusCode;
use serde_json::{Value, json};

use super::command::CommandLine;
use super::document::study_keys;
use super::fields::AskedFields;
use super::parts::StudyParts;
use super::staged::{refused, shown_table};
use crate::asked::{Question, Send};
use crate::console::Console;
use crate::progress::Progress;
use crate::refusal::Refusal;

const CAMPAIGN: (Kind, &str) = (Kind::Campaign, "campaign");
/// The key of a campaign's folder.
const OUT: &str = "out";
/// Runs of a campaign at the most, and of its statistics, which are kept in memory.
const RUNS: u64 = 10_000_000;
/// Folders that are looked at.
const FOLDERS: usize = 200;

/// The campaigns of the folder.
pub(super) fn list(console: &Console) -> String {
    let root = console.folder.beside().within.unwrap_or_default();
    let entries = fs::read_dir(&root).into_iter().flatten().flatten().take(FOLDERS);
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let mut rows: Vec<Value> = names.filter_map(|name| row(console, &name)).collect();
    rows.sort_by_key(|row| row[OUT].to_string());
    json::line(&json!({ "schema": "grouser.campaigns.v1", "rows": rows })) + "\n"
}

fn row(console: &Console, name: &str) -> Option<Value> {
    let results = Results::open(&place(console, name).ok()?).ok()?;
    let manifest = results.manifest();
    let done = runs_done(&results);
    Some(json!({
        OUT: name,
        "name": manifest.name,
        "runs": done + manifest.runs_in(results.missing()),
        "done": done,
        "is_finished": manifest.digest.is_some(),
    }))
}

fn runs_done(results: &Results) -> u64 {
    results.manifest().runs_in(&results.missing().others())
}

/// A campaign's document: its numbers, and how many runs it has.
pub(super) fn task(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let parts = StudyParts::of(&fields, CAMPAIGN)?;
    fields.finish()?;
    let campaign = parts.read(&console.folder, document::read_campaign)?;
    Ok(Question::new(move |_, send| {
        send(json::line(&json!({
            "schema": "grouser.session.v1",
            "names": { "campaign": campaign.name() },
            "assumptions": campaign.assumptions(),
            "documents": { "study.toml": campaign.resolved() },
            "keys": study_keys(Kind::Campaign, campaign.document()),
            "runs": campaign.runs(),
        })));
        Ok(())
    }))
}

/// Computes the runs of a campaign that are missing.
pub(super) fn read(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let out = out(&fields)?;
    let is_new = fields.text(CAMPAIGN.1)?;
    let path = place(console, &out)?;
    let parts = match is_new {
        Some(name) => StudyParts::named(&fields, Kind::Campaign, name)?,
        None => StudyParts::named(&fields, Kind::Campaign, format!("{out}/study.toml"))?,
    };
    fields.finish()?;
    let campaign = parts.read(&console.folder, document::read_campaign)?;
    if campaign.runs() > RUNS {
        let message = format!("{} runs: it must be at most {RUNS}", campaign.runs());
        return Err(Refusal::of_key("campaign", message).with_hint("the program has no such limit"));
    }
    let mut line = CommandLine::new("campaign run");
    parts.add_words(&mut line);
    line.option(OUT, &out);
    Ok(Question::new(move |go_on, send| {
        let go_on = go_on.of_study();
        let turn = go_on.turn().ok_or_else(|| refused(AnswerError::Stopped))?;
        let part = Results::open(&path).ok().and_then(|results| results.manifest().part);
        let mut folder = Folder::open(&path, &Study::of(&campaign), part).map_err(stored)?;
        let progress = Progress::new(send, "runs", folder.runs_done(), Some(folder.runs()));
        let next = || {
            progress.count();
            go_on.is_on()
        };
        let take = |folder: &mut Folder, shard, bytes: &[u8]| folder.accept(shard, bytes);
        let computed = compute(&campaign, &mut folder, &next, take);
        folder.pause().map_err(stored)?;
        computed.map_err(stored)?;
        if folder.missing().is_empty() {
            folder.finish().map_err(stored)?;
        }
        drop((folder, turn));
        summarise(&path, &campaign, &line, send)
    }))
}

/// The statistics of what is computed of a campaign.
pub(super) fn summary(console: &Console, body: &[u8]) -> Result<Question, Refusal> {
    let fields = AskedFields::of(body)?;
    let out = out(&fields)?;
    let path = place(console, &out)?;
    let parts = StudyParts::named(&fields, Kind::Campaign, format!("{out}/study.toml"))?;
    fields.finish()?;
    let campaign = parts.read(&console.folder, document::read_campaign)?;
    let mut line = CommandLine::new("campaign summarise");
    line.word(&out);
    Ok(Question::new(move |go_on, send| {
        let _turn = go_on.turn().ok_or_else(|| refused(AnswerError::Stopped))?;
        summarise(&path, &campaign, &line, send)
    }))
}

fn summarise(
    path: &Path,
    campaign: &Campaign,
    line: &CommandLine,
    send: Send<'_>,
) -> Result<(), Refusal> {
    let results = Results::open(path).map_err(stored)?;
    results.require_study(&Study::of(campaign)).map_err(stored)?;
    let (done, all) = (runs_done(&results), campaign.runs());
    if done == 0 || done > RUNS {
        let message = format!("there are statistics of 1 to {RUNS} runs, and {done} are computed");
        return Err(Refusal::of_key(OUT, message));
    }
    let (statistics, finished) = Statistics::of(campaign, &results).map_err(stored)?;
    let Manifest { name, seed, study_sha256, part, .. } = results.manifest();
    let Finished { digest, shards, bytes } = finished;
    // The answer is that of `grouser campaign summarise --format json`.
    let mut answer = json!({
        "schema": "grouser.campaign.summarise.v1",
        "version": env!("CARGO_PKG_VERSION"),
        "inputs": {
            "study": name, "study_sha256": study_sha256, "seed": seed, "runs": all, "part": part,
        },
        "digest": digest,
        "shards": shards,
        "bytes": bytes,
    });
    if let (Some(own), Value::Object(more)) = (answer.as_object_mut(), json!(statistics)) {
        own.extend(more);
    }
    if !send(json::line(&answer)) {
        return Ok(());
    }
    let tables = statistics.tables().into_iter().map(|table| {
        let rows: Vec<Value> = table
            .cells
            .iter()
            .map(|cells| {
                table
                    .header
                    .iter()
                    .zip(cells)
                    .map(|(name, cell)| (name.clone(), json!(cell)))
                    .collect()
            })
            .collect();
        shown_table(table.caption, &table.header, &json!(rows))
    });
    let drawn = figures(&statistics);
    let slide = drawn.first().map(|it| {
        let says = statistics.sentence();
        Slide::of_answer(&says, &it.chart.sheet(), name, line.text().to_owned()).to_svg()
    });
    let figures = drawn.iter().map(|it| json!({ "caption": it.caption, "svg": it.chart.to_svg() }));
    send(json::line(&json!({
        "schema": "grouser.shown.v1",
        "command": line.text(),
        "sentences": [statistics.sentence()],
        "assumptions": campaign.assumptions(),
        "documents": { "study.toml": results.study() },
        "tables": tables.collect::<Vec<_>>(),
        "figures": figures.collect::<Vec<_>>(),
        "slide": slide,
    })));
    Ok(())
}

/// The name of a campaign's folder.
fn out(fields: &AskedFields) -> Result<String, Refusal> {
    let out = fields.text(OUT)?.unwrap_or_default();
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    if out.is_empty() || out.len() > 80 || out.starts_with('.') || !out.chars().all(is_plain) {
        let message = "it must be the name of a folder: letters, digits, `-`, `_` and `.`, and no \
                       `.` at its beginning";
        return Err(Refusal::of_key(OUT, message));
    }
    Ok(out)
}

/// A campaign's folder within the folder that is served: no link leads out of it.
fn place(console: &Console, name: &str) -> Result<PathBuf, Refusal> {
    let root = console.folder.beside().within.filter(|root| root.is_dir());
    let root = root.ok_or_else(|| {
        let refusal = Refusal::of_key(OUT, "the console was started without a folder");
        refusal.with_hint("`grouser serve FOLDER` has campaigns in FOLDER")
    })?;
    let path = root.join(name);
    let own = ["runs", "manifest.json", "study.toml", ".lock"].map(|it| path.join(it));
    let mut all = own.into_iter().chain([path.clone()]);
    let is_link = |path: PathBuf| fs::symlink_metadata(path).is_ok_and(|it| it.is_symlink());
    let runs = || fs::read_dir(path.join("runs")).into_iter().flatten().flatten();
    if all.any(is_link) || runs().any(|entry| is_link(entry.path())) {
        return Err(Refusal::of_key(OUT, "a link is in it, or it is one"));
    }
    Ok(path)
}

#[expect(clippy::needless_pass_by_value, reason = "for `map_err`")]
fn stored(error: StoreError) -> Refusal {
    let status = if error.is_environment() {
        StatusCode::INTERNAL_SERVER_ERROR
    } else {
        StatusCode::UNPROCESSABLE_ENTITY
    };
    let text = error.to_string();
    let (message, hint) = text.split_once("\nhint: ").unwrap_or((&text, ""));
    let refusal = Refusal { key: Some(OUT.to_owned()), ..Refusal::new(status, message) };
    if hint.is_empty() { refusal } else { refusal.with_hint(hint) }
}
