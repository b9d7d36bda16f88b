//! The crates that we depend on: their licences, their features, and what is known of their faults.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::process::Stdio;

use anyhow::{Context, Result, ensure};

use crate::libtest::Count;
use crate::{licence, tools, workspace};

/// Where the licences that we accept are listed.
const POLICY: &str = "deny.toml";

/// What users build, each alone, and what the tests build. Crates that two of them share must have
/// the same features in both, or they and all that depends on them are compiled twice.
const BUILDS: [(&str, &[&str]); 4] = [
    ("the program", &["--package", "grouser-cli", "--edges", "normal,build"]),
    ("the Python package", &["--package", "grouser-python", "--edges", "normal,build"]),
    ("the documentation", &["--workspace", "--edges", "normal,build"]),
    ("the tests", &["--workspace", "--edges", "normal,build,dev"]),
];

/// Checks licences and features; advisories where cargo-deny is installed.
pub(crate) fn check() -> Result<Count> {
    let mut count = Count::one(licences()?);
    count += Count::one(features()?);
    count += advisories()?;
    Ok(count)
}

/// Whether every crate is under a licence that we accept; prints those that are not.
fn licences() -> Result<bool> {
    let policy = fs::read_to_string(workspace::root().join(POLICY)).context(POLICY)?;
    let accepted = licence::accepted(&policy);
    ensure!(!accepted.is_empty(), "{POLICY} has no list `allow`");
    let crates = tree(&["--workspace", "--target", "all", "--edges", "normal,build,dev"], "{l}")?;
    let mut refused = 0;
    for (name, licences) in &crates {
        for expression in licences {
            if !licence::accepts(&accepted, expression) {
                println!("{name}: the licence `{expression}` is not in the list of {POLICY}");
                refused += 1;
            }
        }
    }
    println!("licences: {} crates, {refused} under a licence that is not accepted", crates.len());
    Ok(refused == 0)
}

/// Whether crates have the same features in all builds; prints those that have not.
fn features() -> Result<bool> {
    let mut trees = Vec::new();
    for (build, arguments) in BUILDS {
        trees.push((build, tree(arguments, "{f}")?));
    }
    let mut different = 0;
    for (index, (build, crates)) in trees.iter().enumerate() {
        for (other, others) in &trees[index + 1..] {
            for line in differences(crates, others) {
                println!("{line}: {build} and {other}");
                different += 1;
            }
        }
    }
    println!("features: {different} crates that two builds compile differently");
    if different > 0 {
        println!(
            "name the missing features in the workspace's Cargo.toml, in its list of crates that \
             are not used, and in the package that lacks them"
        );
    }
    Ok(different == 0)
}

/// How many crates a package builds with itself, where it runs on Linux with an x86-64 processor.
pub(crate) fn built_by(package: &str) -> Result<usize> {
    let platform = ["--target", "x86_64-unknown-linux-gnu"];
    let arguments = ["--package", package, "--edges", "normal,build", platform[0], platform[1]];
    Ok(tree(&arguments, "")?.len())
}

/// A crate with its version, and what a column of `cargo tree` says of it, once for each way in
/// which it is built.
type Crates = BTreeMap<String, BTreeSet<String>>;

/// Crates that both have with other features.
fn differences(these: &Crates, those: &Crates) -> Vec<String> {
    let shared = these.iter().filter_map(|(name, ours)| Some((name, ours, those.get(name)?)));
    let words = |sets: &BTreeSet<String>| sets.iter().map(|set| format!("[{set}]")).collect();
    let different = shared.filter(|(_, ours, theirs)| ours != theirs);
    different
        .map(|(name, ours, theirs)| {
            let (ours, theirs): (Vec<String>, Vec<String>) = (words(ours), words(theirs));
            format!("{name} {} and {}", ours.join(" "), theirs.join(" "))
        })
        .collect()
}

fn tree(arguments: &[&str], column: &str) -> Result<Crates> {
    let format = format!("{{p}}\t{column}");
    let output = workspace::cargo()
        .args(["tree", "--locked", "--quiet", "--no-dedupe", "--prefix", "none", "--format"])
        .arg(format)
        .args(arguments)
        .stderr(Stdio::inherit())
        .output()
        .context("cargo did not start")?;
    ensure!(output.status.success(), "`cargo tree {}` failed", arguments.join(" "));
    Ok(of_tree(&String::from_utf8_lossy(&output.stdout)))
}

/// Reads lines `name version (where or what)`, a tabulator, and the column.
fn of_tree(printed: &str) -> Crates {
    let mut crates = Crates::new();
    for line in printed.lines() {
        let Some((package, column)) = line.split_once('\t') else { continue };
        let name: Vec<&str> = package.split(' ').take(2).collect();
        crates.entry(name.join(" ")).or_default().insert(column.trim().to_owned());
    }
    crates
}

/// Known vulnerabilities, withdrawn versions and sources, where cargo-deny is installed and can
/// have its database. Building it takes longer than all our checks, so they do not install it.
fn advisories() -> Result<Count> {
    let pinned = "advisories: not looked at; versions are those of Cargo.lock";
    let mut fetch = workspace::cargo();
    if !tools::runs("cargo-deny", &["--version"]) {
        println!("{pinned}; `cargo install cargo-deny` gets what looks");
        return Ok(Count::skipped());
    }
    if !fetch.args(["deny", "fetch", "db"]).status().is_ok_and(|status| status.success()) {
        println!("{pinned}; cargo-deny cannot fetch its database");
        return Ok(Count::skipped());
    }
    let status = workspace::cargo().args(["deny", "check", "--disable-fetch"]).status()?;
    Ok(Count::one(status.success()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crate_with_other_features_is_found_and_one_that_is_not_shared_is_none() {
        let program = of_tree("syn v3.0.9\tfull\nrand v0.10.3\tstd\n\nclap v4.6.7\tderive\n");
        let package = of_tree("syn v3.0.9\tfull,visit-mut\nrand v0.10.3\tstd\npyo3 v0.30.1\t\n");
        assert_eq!(differences(&program, &package), ["syn v3.0.9 [full] and [full,visit-mut]"]);
    }

    #[test]
    fn where_a_crate_lies_is_not_part_of_its_name() {
        let crates =
            of_tree("grouser v0.1.0 (a/b c)\tdefault\nserde_derive v1.0.229 (proc-macro)\tx");
        assert_eq!(
            crates.into_keys().collect::<Vec<_>>(),
            ["grouser v0.1.0", "serde_derive v1.0.229"]
        );
    }
}
