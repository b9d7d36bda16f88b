//! `grouser presets [NAME]`: lists presets, or prints one.

use grouser::document::{self, Kind, Preset};
use serde::Serialize;

use super::Answer;
use crate::args::PresetsArgs;
use crate::failure::Failure;
use crate::output::rows::Rows;
use crate::output::{self, Format};

#[derive(Serialize)]
struct PresetRecord {
    kind: &'static str,
    name: &'static str,
    title: String,
    source: String,
}

#[derive(Serialize)]
struct Results<'a> {
    rows: &'a [PresetRecord],
}

pub(crate) fn run(args: &PresetsArgs) -> Result<(), Failure> {
    let kinds = args.kind.map_or(Kind::ALL.to_vec(), |word| vec![word.into()]);
    let presets: Vec<&Preset> = kinds.iter().flat_map(|kind| document::presets(*kind)).collect();
    match &args.name {
        Some(name) => print_preset(name, args.kind.map(Kind::from), &presets),
        None => list(&presets, args.format),
    }
}

/// * `kind`: the one that was asked for, if any
fn print_preset(
    name: &str,
    kind: Option<Kind>,
    presets: &[&'static Preset],
) -> Result<(), Failure> {
    // A former name is that of the preset that has another now.
    let is_named = |preset: &&&Preset| {
        document::preset(preset.kind, name).is_some_and(|named| named.name == preset.name)
    };
    let named: Vec<_> = presets.iter().filter(is_named).collect();
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

fn list(presets: &[&'static Preset], format: Format) -> Result<(), Failure> {
    let records: Vec<PresetRecord> = presets
        .iter()
        .map(|preset| {
            let (title, source) = preset.title_and_source();
            PresetRecord { kind: preset.kind.name(), name: preset.name, title, source }
        })
        .collect();
    let rows = Rows::of(&records);
    match format {
        Format::Table => output::show(rows.to_table(&["kind", "name", "title", "source"])),
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => {
            let results = Results { rows: &records };
            output::print_json(&Answer::new("presets", serde_json::json!({}), results))
        }
    }
}
