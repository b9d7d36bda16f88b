//! What the workspace weighs: crates that are built, lines, modules that use each other, and how
//! long a first build takes.
//!
//! `ARCHITECTURE.md` keeps the numbers. Crates and cycles are compared at every check; lines and
//! what a build takes are recorded, since they move with every commit or from machine to machine.

mod homes;
mod lines;
mod modules;

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context, Result, ensure};
use serde_json::Value;

use crate::libtest::Count;
use crate::{cpu, crates, diff, markers, python, workspace};
use homes::{Home, Sources};
use lines::Lines;
use modules::{Cycle, Modules};

/// The most cycles that all crates together may have. It only ever gets smaller.
const MOST_CYCLES: usize = 5;

/// Where the numbers stand, and their blocks there.
const FILE: &str = "ARCHITECTURE.md";
const EXACT: &str = "made by: cargo xtask count";
const RECORDED: &str = "measured by: cargo xtask count";
const BUILD: &str = "measured by: cargo xtask count --build";

/// A package of the workspace.
struct Package {
    name: String,
    /// How many crates it builds, itself included.
    crates: usize,
    lines: Lines,
    /// Modules of its library and its programs together.
    modules: usize,
    cycles: Vec<Cycle>,
}

/// Writes what repeats, and the lines.
pub(crate) fn write() -> Result<bool> {
    let packages = packages()?;
    print(&packages);
    let path = workspace::root().join(FILE);
    let text = fs::read_to_string(&path).context(FILE)?;
    let text = markers::with_content_by(&text, EXACT, &exact(&packages)).context(FILE)?;
    let text = markers::with_content_by(&text, RECORDED, &recorded(&packages)).context(FILE)?;
    fs::write(&path, text).context(FILE)?;
    Ok(true)
}

/// Whether crates and cycles are those that are recorded, and no more cycles than may be.
pub(crate) fn check() -> Result<Count> {
    let packages = packages()?;
    print(&packages);
    let text = fs::read_to_string(workspace::root().join(FILE)).context(FILE)?;
    let (is, should) = (markers::content_by(&text, EXACT).context(FILE)?, exact(&packages));
    let difference = diff::between(is.trim_matches('\n'), should.trim_matches('\n'));
    if !difference.is_empty() {
        println!("{FILE} is stale; `cargo xtask count` refreshes it\n{difference}");
    }
    let cycles: usize = packages.iter().map(|package| package.cycles.len()).sum();
    println!("{cycles} cycles of modules, {MOST_CYCLES} are the most that may be");
    let mut count = Count::one(difference.is_empty());
    count += Count::one(cycles <= MOST_CYCLES);
    for Home { what, most, found } in homes()? {
        println!("{found:>7} {what}, {most} are the most that may be");
        count += Count::one(found <= most);
    }
    Ok(count)
}

/// Things that are declared more than once, with the most that may be.
fn homes() -> Result<Vec<Home>> {
    let [rust, python] = ["rs", "py"].map(workspace::texts_with_extension);
    Ok(homes::counted(&Sources::of(&rust?, &python?)))
}

/// Measures a first build of the program in an empty folder, and writes it.
pub(crate) fn write_build() -> Result<bool> {
    let folder = workspace::target().join("xtask/first-build");
    if folder.exists() {
        fs::remove_dir_all(&folder).context("an earlier build")?;
    }
    // What waits for the network is not the build.
    let fetched = workspace::cargo().args(["fetch", "--locked"]).status()?;
    ensure!(fetched.success(), "the crates cannot be fetched");
    let (start, before) = (Instant::now(), cpu::of_children());
    let mut build = workspace::cargo();
    build.args(["build", "--release", "--locked", "--package", "grouser-cli"]);
    let built = build.env("CARGO_TARGET_DIR", &folder).status().context("cargo did not start")?;
    ensure!(built.success(), "the program does not build");
    let seconds = start.elapsed().as_secs_f64();
    let computed = cpu::of_children().zip(before).map(|(now, before)| now.saturating_sub(before));
    let computed = computed.map_or("-".into(), |time| format!("{:.0} s", time.as_secs_f64()));
    let program = format!("release/grouser{}", std::env::consts::EXE_SUFFIX);
    let size = fs::metadata(folder.join(program)).context("the program")?.len();
    fs::remove_dir_all(&folder).context("the build")?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let mut table = format!(
        "| what | measured |\n|---|---|\n| first build of the program, {cores} cores | {seconds:.0} s |\n\
         | its CPU time | {computed} |\n| the program | {} |\n",
        megabytes(size)
    );
    if let Some(wheel) = wheel() {
        let _ = writeln!(table, "| the Python package's wheel | {} |", megabytes(wheel));
    }
    print!("{table}");
    let path = workspace::root().join(FILE);
    let text = fs::read_to_string(&path).context(FILE)?;
    let text = markers::with_content_by(&text, BUILD, &table).context(FILE)?;
    fs::write(&path, text).context(FILE)?;
    Ok(true)
}

/// Size of the wheel that was built last [bytes], if one was.
fn wheel() -> Option<u64> {
    let path = fs::read_dir(python::wheels()).ok()?.next()?.ok()?.path();
    Some(fs::metadata(path).ok()?.len())
}

fn megabytes(bytes: u64) -> String {
    format!("{:.1} MB", bytes as f64 / 1e6)
}

/// The packages of the workspace, as cargo knows them.
fn packages() -> Result<Vec<Package>> {
    let output = workspace::cargo()
        .args(["metadata", "--format-version", "1", "--no-deps", "--locked", "--quiet"])
        .output()
        .context("cargo did not start")?;
    ensure!(output.status.success(), "`cargo metadata` failed");
    let metadata: Value = serde_json::from_slice(&output.stdout)?;
    let files = workspace::texts_with_extension("rs")?;
    let packages = metadata["packages"].as_array().context("cargo's packages")?;
    packages.iter().map(|package| Package::of(package, &files)).collect()
}

impl Package {
    /// * `files`: the repository's sources, by their paths from its root
    fn of(package: &Value, files: &[(String, String)]) -> Result<Self> {
        let name = package["name"].as_str().context("a package has a name")?;
        let manifest = Path::new(package["manifest_path"].as_str().context("its manifest")?);
        let folder = manifest.parent().context("a manifest lies in a folder")?;
        let folder = folder.strip_prefix(workspace::root())?.to_string_lossy().replace('\\', "/");
        let sources: Vec<(&str, &str)> = files
            .iter()
            .filter_map(|(path, text)| {
                let inside = path.strip_prefix(folder.as_str())?.strip_prefix('/')?;
                Some((inside, text.as_str()))
            })
            .collect();
        let (mut modules, mut cycles) = (0, Vec::new());
        for root in roots(package)? {
            let found = Modules::read(&root)?;
            modules += found.count;
            cycles.extend(found.cycles);
        }
        let crates = crates::built_by(name)?;
        Ok(Self { name: name.into(), crates, lines: Lines::of(&sources), modules, cycles })
    }

    fn largest(&self) -> usize {
        self.cycles.iter().map(Vec::len).max().unwrap_or(0)
    }
}

/// The roots of what a package ships: its library and its programs.
fn roots(package: &Value) -> Result<Vec<PathBuf>> {
    const SHIPPED: [&str; 3] = ["lib", "cdylib", "bin"];
    let targets = package["targets"].as_array().context("a package has targets")?;
    let is_shipped = |target: &&Value| {
        target["kind"].as_array().is_some_and(|kinds| {
            kinds.iter().filter_map(Value::as_str).any(|kind| SHIPPED.contains(&kind))
        })
    };
    let root = |target: &Value| Some(PathBuf::from(target["src_path"].as_str()?));
    targets.iter().filter(is_shipped).map(|one| root(one).context("a target has a root")).collect()
}

/// What is the same on every machine until a crate or a cycle comes or goes.
fn exact(packages: &[Package]) -> String {
    let mut table = String::from(
        "| package | crates built | cycles of modules | modules in the largest |\n|---|---|---|---|\n",
    );
    for package in packages {
        let Package { name, crates, cycles, .. } = package;
        let row = format!("| `{name}` | {crates} | {} | {} |", cycles.len(), package.largest());
        let _ = writeln!(table, "{row}");
    }
    table
}

/// What moves with every commit, rounded.
fn recorded(packages: &[Package]) -> String {
    let hundreds = |lines: usize| (lines as f64 / 100.0).round() * 100.0;
    let mut table =
        String::from("| package | modules | lines of Rust | lines of tests |\n|---|---|---|---|\n");
    for Package { name, modules, lines, .. } in packages {
        let (code, tests) = (hundreds(lines.code), hundreds(lines.tests));
        let _ = writeln!(table, "| `{name}` | {modules} | {code} | {tests} |");
    }
    table
}

/// Prints both tables, and the modules of each cycle.
fn print(packages: &[Package]) {
    println!("{}\n{}", exact(packages), recorded(packages));
    for package in packages {
        for cycle in &package.cycles {
            println!("{}: {} modules use each other", package.name, cycle.len());
            for (module, used) in cycle {
                println!("  {module}: {}", used.join(", "));
            }
        }
    }
}
