//! Keeps `schema/KIND.json` equal to what `grouser schema KIND` prints.

use std::fs;

use anyhow::{Context, Result};

use crate::{diff, workspace};

/// Writes every file of `schema/` anew. (A new kind starts as an empty file.)
pub(crate) fn write() -> Result<bool> {
    for schema in schemas()? {
        fs::write(workspace::root().join(&schema.path), &schema.should)
            .with_context(|| format!("writing {}", schema.path))?;
        println!("{} written", schema.path);
    }
    Ok(true)
}

/// Whether every file of `schema/` is what the program prints now; prints what is not.
pub(crate) fn check() -> Result<bool> {
    let schemas = schemas()?;
    let mut fresh = 0;
    for schema in &schemas {
        if schema.is == schema.should {
            fresh += 1;
        } else {
            println!("{} is stale; `cargo xtask schema` refreshes it", schema.path);
            println!("{}", diff::between(&schema.is, &schema.should));
        }
    }
    println!("{} schemas, {} stale", schemas.len(), schemas.len() - fresh);
    Ok(fresh == schemas.len())
}

struct Schema {
    path: String,
    is: String,
    should: String,
}

fn schemas() -> Result<Vec<Schema>> {
    let mut files = workspace::texts_with_extension("json")?;
    files.retain(|(path, _)| kind_of(path).is_some());
    if files.is_empty() {
        return Ok(Vec::new());
    }
    let program = workspace::build_program()?;
    files
        .into_iter()
        .map(|(path, is)| {
            let kind = kind_of(&path).unwrap_or_default().to_string();
            let should = workspace::output_of(&program, &["schema".into(), kind])?;
            Ok(Schema { path, is, should })
        })
        .collect()
}

/// The kind of document that a file describes: `soil` for `schema/soil.json`.
fn kind_of(path: &str) -> Option<&str> {
    let kind = path.strip_prefix("schema/")?.strip_suffix(".json")?;
    (!kind.contains('/')).then_some(kind)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_kind_is_the_files_name() {
        assert_eq!(kind_of("schema/soil.json"), Some("soil"));
        assert_eq!(kind_of("schema/old/soil.json"), None);
        assert_eq!(kind_of("crates/schema/soil.json"), None);
    }
}
