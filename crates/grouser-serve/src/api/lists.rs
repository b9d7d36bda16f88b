//! What there is to choose from: presets, and the documents of the folder.

use grouser::document::{self, Kind, json};
use serde_json::json;

use crate::console::Console;

/// The presets, as `grouser presets` lists them.
pub(super) fn presets(_: &Console) -> String {
    let all = Kind::ALL.into_iter().flat_map(document::presets);
    let rows: Vec<_> = all.map(document::Preset::record).collect();
    json::line(&json!({
        "schema": "grouser.presets.v1",
        "version": env!("CARGO_PKG_VERSION"),
        "inputs": {},
        "rows": rows,
    })) + "\n"
}

/// The maps of heights and the areas of the folder, by the ends of their names: kind and path of each.
pub(super) fn files(console: &Console) -> String {
    let files = console.folder.list_files().into_iter();
    let rows: Vec<_> = files.map(|it| json!({ "kind": it.kind, "path": it.path })).collect();
    json::line(&json!({ "schema": "grouser.files.v1", "rows": rows })) + "\n"
}

/// The documents of the folder: kind and path of each.
pub(super) fn documents(console: &Console) -> String {
    let rows = console.folder.list().into_iter();
    let rows: Vec<_> = rows.map(|it| json!({ "kind": it.kind.name(), "path": it.path })).collect();
    json::line(&json!({ "schema": "grouser.documents.v1", "rows": rows })) + "\n"
}
