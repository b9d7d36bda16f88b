//! `grouser presets [NAME]`: lists presets, or prints one.

use grouser::document::{self, Kind, Preset, PresetRecord};
use serde::Serialize;

use super::Answer;
use crate::args::PresetsArgs;
use crate::failure::Failure;
use crate::output::rows::Rows;
use crate::output::text::Text;
use crate::output::{self, Format};

#[derive(Serialize)]
struct Results<'a> {
    rows: &'a [PresetRecord],
}

/// The columns of a list in full, of one to choose from, and of one without advice.
const SOURCES: [&str; 4] = ["kind", "name", "title", "source"];
const CHOICE: [&str; 3] = ["name", "world", "advice"];
const TITLES: [&str; 2] = ["name", "title"];

pub(crate) fn run(args: &PresetsArgs) -> Result<(), Failure> {
    let kinds = args.kind.map_or(Kind::ALL.to_vec(), |word| vec![word.into()]);
    let presets: Vec<&Preset> = kinds.iter().flat_map(|kind| document::presets(*kind)).collect();
    match args.name.as_deref().map(|name| (name, kind_of(name, &presets))) {
        Some((name, None)) => print_preset(name, args.kind.map(Kind::from), &presets),
        Some((_, Some(kind))) => list(&of_kind(&presets, kind), args, true),
        None => list(&presets, args, false),
    }
}

/// The kind that a word names in one or in many, unless it is a preset.
fn kind_of(word: &str, presets: &[&'static Preset]) -> Option<Kind> {
    let is_preset = presets.iter().any(|preset| preset.name == word);
    let is_named = |kind: &Kind| word == kind.name() || word == format!("{kind}s");
    Kind::ALL.into_iter().find(is_named).filter(|_| !is_preset)
}

fn of_kind(presets: &[&'static Preset], kind: Kind) -> Vec<&'static Preset> {
    presets.iter().copied().filter(|preset| preset.kind == kind).collect()
}

/// * `kind`: the one that was asked for, if any
fn print_preset(
    name: &str,
    kind: Option<Kind>,
    presets: &[&'static Preset],
) -> Result<(), Failure> {
    let named: Vec<_> = presets.iter().filter(|preset| preset.name == name).collect();
    match named[..] {
        [] => {
            let hint = match document::nearest(name, presets.iter().map(|preset| preset.name)) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => "`grouser presets` lists them".to_owned(),
            };
            let name = name.escape_debug();
            let preset = kind.map_or("preset".to_owned(), |kind| format!("{kind} preset"));
            Err(Failure::Usage(format!("there is no {preset} called `{name}`\nhint: {hint}")))
        }
        [preset] => output::print(preset.text),
        [..] => {
            // A name that a rover and its wheel share means the rover.
            let whole = named.iter().max_by_key(|preset| preset.kind == Kind::Rover);
            let others = named.iter().filter(|preset| Some(preset) != whole.as_ref());
            for other in others {
                let kind = other.kind;
                output::message(&format!("note: there is also a {kind} `{name}`: --kind {kind}"));
            }
            whole.map_or(Ok(()), |preset| output::print(preset.text))
        }
    }
}

/// * `is_chosen`: whether one kind was asked for by its name
fn list(presets: &[&'static Preset], args: &PresetsArgs, is_chosen: bool) -> Result<(), Failure> {
    let all = presets.iter().map(|preset| preset.record());
    let is_of_world = |it: &PresetRecord| args.world.is_none() || it.world == args.world.as_deref();
    let sought = args.search.as_ref().map(|text| text.to_lowercase());
    let is_found = |preset: &Preset, it: &PresetRecord| {
        sought.as_ref().is_none_or(|text| {
            let own = [preset.name, preset.text, it.advice.unwrap_or_default()];
            own.iter().any(|own| own.to_lowercase().contains(text))
        })
    };
    let pairs = presets.iter().zip(all);
    let records: Vec<PresetRecord> = pairs
        .filter(|(preset, it)| is_of_world(it) && is_found(preset, it))
        .map(|(_, it)| it)
        .collect();
    if records.is_empty() {
        return Err(Failure::Usage(
            "no preset is like that\nhint: `grouser presets` lists them all".to_owned(),
        ));
    }
    let rows = Rows::of(&records);
    match args.format {
        Format::Table => {
            let is_filtered = is_chosen || args.world.is_some() || args.search.is_some();
            if is_filtered || output::terminal::width().is_some() {
                output::show(to_choose_from(&records, &rows))
            } else {
                output::show(rows.to_table(&SOURCES))
            }
        }
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => {
            let results = Results { rows: &records };
            output::print_json(&Answer::new("presets", serde_json::json!({}), results))
        }
    }
}

/// A table for each kind, with advice where it has any.
fn to_choose_from(records: &[PresetRecord], rows: &Rows) -> Text {
    let kinds = records.chunk_by(|one, next| one.kind == next.kind);
    let mut place = 0;
    let blocks = kinds.map(|part| {
        let rows = rows.part(place..place + part.len());
        place += part.len();
        let has_advice = part.iter().any(|it| it.advice.is_some());
        let columns = if has_advice { &CHOICE[..] } else { &TITLES[..] };
        Text::from(format!("{}s\n", part[0].kind)) + rows.to_table(columns)
    });
    Text::blocks(blocks.collect::<Vec<_>>()) + "`grouser presets NAME` prints one with its source\n"
}
