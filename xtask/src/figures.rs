//! Keeps output and figures in the documents equal to those of the program.

use std::collections::HashMap;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use crate::diff;
use crate::markers::{self, Block, Kind, Piece};
use crate::workspace;

/// Writes every block and picture anew.
///
/// * `and_measurements`: what was measured, too, which takes long
pub(crate) fn write(and_measurements: bool) -> Result<bool> {
    let measurements = if and_measurements { Measurements::Anew } else { Measurements::AsTheyAre };
    let mut written = 0;
    for file in made_files(measurements)? {
        if !file.differences.is_empty() {
            let path = workspace::root().join(&file.path);
            if let Some(folder) = path.parent() {
                fs::create_dir_all(folder)?;
            }
            fs::write(&path, &file.should).with_context(|| format!("writing {}", file.path))?;
            println!("{} written", file.path);
            written += 1;
        }
    }
    if written == 0 {
        println!("everything that the program makes was fresh");
    }
    Ok(true)
}

/// Whether every block and picture is what the program makes now; prints what is not.
pub(crate) fn check() -> Result<bool> {
    let files = made_files(Measurements::AsTheyAre)?;
    let stale: Vec<&MadeFile> = files.iter().filter(|file| !file.differences.is_empty()).collect();
    for file in &stale {
        println!("{} is stale; `cargo xtask figures` refreshes it", file.path);
        println!("{}", file.differences.join("\n"));
    }
    println!("{} files with made parts, {} stale", files.len(), stale.len());
    Ok(stale.is_empty())
}

/// A file that the program makes, or makes parts of.
struct MadeFile {
    /// From the root.
    path: String,
    should: Vec<u8>,
    /// Where it is something else, for people.
    differences: Vec<String>,
}

/// What becomes of what was measured on some machine at some time.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Measurements {
    Anew,
    AsTheyAre,
}

fn made_files(measurements: Measurements) -> Result<Vec<MadeFile>> {
    let mut sources = Vec::new();
    for (path, text) in workspace::texts_with_extension("md")? {
        let pieces = markers::pieces(&text).with_context(|| path.clone())?;
        if pieces.iter().any(|piece| matches!(piece, Piece::Made(_))) {
            sources.push((path, pieces));
        }
    }
    if sources.is_empty() {
        return Ok(Vec::new());
    }
    let mut maker = Maker { program: workspace::build_program()?, folders: HashMap::new() };
    let mut files = Vec::new();
    for (path, pieces) in sources {
        let mut should = String::new();
        let mut differences = Vec::new();
        for piece in pieces {
            match piece {
                Piece::Text(text) => should.push_str(&text),
                Piece::Made(block)
                    if block.kind == Kind::Measurement
                        && measurements == Measurements::AsTheyAre =>
                {
                    should.push_str(&block.content);
                }
                Piece::Made(block) => {
                    let place = || format!("{path}, line {}", block.line);
                    let made = match block.kind {
                        Kind::Output | Kind::Measurement => maker.output(&block),
                        Kind::Picture => maker.picture(&path, &block).map(|picture| {
                            files.push(picture);
                            block.content.clone()
                        }),
                    };
                    let made = made.with_context(place)?;
                    if made != block.content {
                        let difference = diff::between(&block.content, &made);
                        differences.push(format!("line {}:\n{difference}", block.line));
                    }
                    should.push_str(&made);
                }
            }
        }
        files.push(MadeFile { path, should: should.into_bytes(), differences });
    }
    Ok(files)
}

/// How a picture differs from what it should be.
fn difference(is: &[u8], should: &[u8]) -> String {
    match (str::from_utf8(is), str::from_utf8(should)) {
        (Ok(is), Ok(should)) => diff::between(is, should),
        _ => format!("its {} bytes should be {} others", is.len(), should.len()),
    }
}

/// The file of a name in a folder or in one inside it.
fn file_below(folder: &Path, name: &OsStr) -> Result<Option<PathBuf>> {
    let mut entries =
        fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<Result<Vec<PathBuf>>>()?;
    entries.sort();
    for entry in entries {
        if entry.is_dir() {
            if let Some(found) = file_below(&entry, name)? {
                return Ok(Some(found));
            }
        } else if entry.file_name() == Some(name) {
            return Ok(Some(entry));
        }
    }
    Ok(None)
}

struct Maker {
    program: PathBuf,
    /// Where each picture command that has already run wrote its files.
    folders: HashMap<Vec<String>, PathBuf>,
}

impl Maker {
    fn output(&self, block: &Block) -> Result<String> {
        let output = workspace::output_of(&self.program, &block.arguments)?;
        Ok(markers::as_markdown(&output, &block.arguments))
    }

    /// The picture that a block of a document links to: the file of the same name among those
    /// that its command writes.
    fn picture(&mut self, document: &str, block: &Block) -> Result<MadeFile> {
        let target = markers::picture_of(&block.content)?;
        let path = Path::new(document).parent().unwrap_or(Path::new("")).join(target);
        let name = path.file_name().context("the image link names no file")?;
        let made = file_below(&self.folder(&block.arguments)?, name)?
            .with_context(|| format!("the command writes no file {}", name.display()))?;
        let should = fs::read(&made)?;
        let is = fs::read(workspace::root().join(&path)).unwrap_or_default();
        let differences = if is == should { Vec::new() } else { vec![difference(&is, &should)] };
        let path = path.display().to_string();
        Ok(MadeFile { path, should, differences })
    }

    /// Runs a command with `--out` a fresh folder, once, and returns that folder.
    fn folder(&mut self, arguments: &[String]) -> Result<PathBuf> {
        if let Some(folder) = self.folders.get(arguments) {
            return Ok(folder.clone());
        }
        let number = self.folders.len();
        let folder = workspace::root().join("target/xtask/figures").join(number.to_string());
        if folder.exists() {
            fs::remove_dir_all(&folder)?;
        }
        if let Some(parent) = folder.parent() {
            fs::create_dir_all(parent)?;
        }
        let commands = markers::commands(arguments)?;
        let (last, before) = commands.split_last().context("no command")?;
        for command in before {
            workspace::output_of(&self.program, command)?;
        }
        let mut all = last.to_vec();
        all.extend(["--out".into(), folder.display().to_string()]);
        workspace::output_of(&self.program, &all)?;
        self.folders.insert(arguments.to_vec(), folder.clone());
        Ok(folder)
    }
}
