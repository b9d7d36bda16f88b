//! Files of a package of npm that come along with the console: each is the package's, byte for byte.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use crate::workspace;

/// The folder of the files; below it their paths are those of the package.
pub(crate) const FOLDER: &str = "crates/grouser-serve/page/three/";
/// The package, with its version.
pub(crate) const PACKAGE: &str = "three@0.187.0";
/// The checksum of its archive, which npm compares with what it fetches.
const INTEGRITY: &str = "sha512-Qiu7R+Cmh8CstZsY1uJOSWnVlfo7ZtNLV7mF8Jltk3LB3AtDu9cRZlcnRKkAk8Y4z6KKw35z7Y7Urd7jWY8etA==";

/// Whether the files are those of the package; prints those that are not.
///
/// * `modules`: the folder `node_modules` that npm installed the package into
pub(crate) fn check(modules: &Path) -> Result<bool> {
    let (name, _) = PACKAGE.split_once('@').context(PACKAGE)?;
    let listed = fs::read_to_string(modules.join(".package-lock.json")).context("npm's list")?;
    let is_pinned = listed.contains(INTEGRITY);
    if !is_pinned {
        println!("{PACKAGE}: npm has another archive than that of {INTEGRITY}");
    }
    let files = workspace::files()?;
    let own: Vec<&str> = files.iter().filter_map(|path| path.strip_prefix(FOLDER)).collect();
    let mut differ = 0;
    for path in &own {
        let ours = fs::read(workspace::root().join(FOLDER).join(path))?;
        if fs::read(modules.join(name).join(path)).ok() != Some(ours) {
            println!("{FOLDER}{path}: it is not that of {PACKAGE}");
            differ += 1;
        }
    }
    println!("{PACKAGE}: {} files come along, {differ} differ from the package's", own.len());
    Ok(is_pinned && differ == 0 && own.contains(&"LICENSE"))
}
