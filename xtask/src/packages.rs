//! What is published: the crates, and the sources of the Python package.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};

use crate::extent::Extent;
use crate::libtest::Count;
use crate::{python, workspace};

/// Whose files the sources of the Python package must have: the package, and the crates that it is
/// made of.
const IN_THE_SOURCES: [&str; 10] = [
    "crates/grouser/src/",
    "crates/grouser-core/src/",
    "crates/grouser-draw/src/",
    "crates/grouser-io/src/",
    "crates/grouser-logs/src/",
    "crates/grouser-serve/page/",
    "crates/grouser-serve/src/",
    "crates/grouser-store/src/",
    "crates/grouser-python/src/",
    "crates/grouser-python/python/",
];

/// Whether the crates could be published, and the sources of the Python package hold all that it is
/// made of. `Extent::Full` builds both from what would be published, and nothing else.
pub(crate) fn check(extent: Extent) -> Result<Count> {
    let mut count = Count::one(crates(extent)?);
    let python = python::environment()?;
    let sources = sources(&python)?;
    count += Count::one(complete(&python, &sources)?);
    count += match extent {
        Extent::Usual => Count::skipped(),
        Extent::Full => Count::one(builds(&python, &sources)),
    };
    Ok(count)
}

/// Whether cargo would publish every crate that is not marked `publish = false`: none depends on
/// one that stays here, and all that its manifest names exists.
fn crates(extent: Extent) -> Result<bool> {
    let mut publish = workspace::cargo();
    // What is not committed yet is tried as well.
    publish.args(["publish", "--workspace", "--dry-run", "--allow-dirty", "--quiet"]);
    if extent == Extent::Usual {
        publish.arg("--no-verify");
    }
    let good = publish.status().context("cargo did not start")?.success();
    println!("crates: {}", if good { "could be published" } else { "cannot be published" });
    Ok(good)
}

/// The archive of the Python package's sources.
fn sources(python: &Path) -> Result<PathBuf> {
    let folder = workspace::target().join("python/sources");
    if folder.exists() {
        fs::remove_dir_all(&folder).context("old sources")?;
    }
    let mut make = Command::new(python);
    make.args(["-m", "maturin", "sdist", "--out"]).arg(&folder);
    make.arg("--manifest-path").arg(python::manifest());
    python::done(&mut make, "the sources of the Python package cannot be packed")?;
    let mut archives = fs::read_dir(&folder).context("the folder of the sources")?;
    Ok(archives.next().context("maturin made no archive")??.path())
}

/// Whether an archive has every file that the package is made of; prints those it lacks.
fn complete(python: &Path, archive: &Path) -> Result<bool> {
    let list = Command::new(python)
        .args(["-m", "tarfile", "--list"])
        .arg(archive)
        .output()
        .context("Python did not start")?;
    let list = String::from_utf8_lossy(&list.stdout);
    let packed: Vec<&str> = list.lines().map(str::trim).collect();
    let files = workspace::files()?;
    let lacking = lacking(&files, &packed);
    for file in &lacking {
        println!("{file} is not in the sources of the Python package");
    }
    println!("sources of the Python package: {} files, {} lacking", packed.len(), lacking.len());
    Ok(lacking.is_empty() && !packed.is_empty())
}

/// Files of the repository that must be in an archive, and are not.
///
/// * `packed`: paths in the archive, which begin with its own folder; maturin puts the package
///   itself, without its path, there
fn lacking<'a>(files: &'a [String], packed: &[&str]) -> Vec<&'a str> {
    let needed = |file: &&str| IN_THE_SOURCES.iter().any(|folder| file.starts_with(folder));
    let is_packed = |file: &str| {
        let own = file.strip_prefix("crates/grouser-python/").unwrap_or(file);
        packed.iter().any(|path| {
            let inside = path.split_once('/').map_or("", |(_, inside)| inside);
            inside == file || inside == own
        })
    };
    files.iter().map(String::as_str).filter(needed).filter(|file| !is_packed(file)).collect()
}

/// Whether a wheel can be built from the sources alone.
fn builds(python: &Path, archive: &Path) -> bool {
    let folder = workspace::target().join("python/from-sources");
    let mut build = Command::new(python);
    build.args(["-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation"]);
    build.arg("--wheel-dir").arg(folder).arg(archive);
    // Without an environment of its own, the build finds maturin as a shell would.
    let programs = python.parent().map(Path::to_path_buf);
    let others = std::env::var_os("PATH").unwrap_or_default();
    let all = programs.into_iter().chain(std::env::split_paths(&others));
    if let Ok(path) = std::env::join_paths(all) {
        build.env("PATH", path);
    }
    python::done(&mut build, "no wheel can be built from the sources").is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_the_package_that_was_left_out_is_found() {
        let files = ["crates/grouser/src/lib.rs", "crates/grouser-python/python/grouser/style.py"];
        let files = files.map(String::from);
        let packed = ["grouser-0.1.0/crates/grouser/src/lib.rs", "grouser-0.1.0/PKG-INFO"];
        assert_eq!(lacking(&files, &packed), ["crates/grouser-python/python/grouser/style.py"]);
        let packed = [packed[0], "grouser-0.1.0/python/grouser/style.py"];
        assert!(lacking(&files, &packed).is_empty());
        assert!(lacking(&["README.md".into()], &[]).is_empty());
    }
}
