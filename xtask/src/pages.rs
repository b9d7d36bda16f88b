//! The site and the reports as their readers see them: in Chromium, at two widths, light and dark.
//!
//! Pages must not be wider than the window, nor clip text, nor ask other hosts; their scripts must
//! run without an error, their links lead somewhere, and axe must find no serious violation of
//! accessibility. The console is used too: what it shows must be what the program prints.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

use crate::libtest::Count;
use crate::tools::{self, CHROMIUM, NPM};
use crate::{python, vendored, workspace};

/// What checks types that comments declare: where from is for npm's own settings to say.
const TYPESCRIPT: &str = "typescript@5.9.3";
/// What it is to check, and how strictly.
const TYPED: &str = "crates/grouser-serve/jsconfig.json";

/// What uses the console, in the same language.
pub(crate) const USER: &str = include_str!("console.py");

/// What looks at the pages, in the language whose driver of browsers is at hand.
const LOOKER: &str = include_str!("pages.py");

/// The site's pages that are looked at: one of each kind, and those with the widest contents.
const PAGES: [&str; 29] = [
    "index.html",
    "start.html",
    "tutorials/index.html",
    "tutorials/driver.html",
    "tutorials/own-rover.html",
    "notebooks/heading.html",
    "notebooks/wheel-test.html",
    "notebooks/own-environment.html",
    "guide/index.html",
    "guide/first-run.html",
    "guide/card.html",
    "guide/try.html",
    "guide/forecast.html",
    "models/index.html",
    "models/rover.html",
    "models/small-wheel.html",
    "equations.html",
    "conventions.html",
    "glossary.html",
    "bibliography.html",
    "trust.html",
    "validation.html",
    "gallery.html",
    "reference/index.html",
    "reference/generated/python/grouser.heading.html",
    "reference/generated/python/grouser.Soil.html",
    "reference/generated/program/traverse.html",
    "reference/generated/documents/soil.html",
    "search.html",
];

/// What makes reports: the name of the page, and the command, whose folder or file comes last.
const REPORTS: [(&str, &[&str]); 9] = [
    ("reproduce/report.html", &["reproduce", "--samples", "2", "--out", "reproduce"]),
    (
        "forecast/report.html",
        &["forecast", "--site", "moon", "--soil", "toyoura", "--samples", "8", "--out", "forecast"],
    ),
    ("traverse/report.html", &["traverse", "--slope-deg", "10", "--out", "traverse"]),
    ("run.html", &["traverse", "--slope-deg", "10", "--duration-s", "4", "--animate", "run.html"]),
    ("wheel/report.html", &["wheel-test", "--out", "wheel"]),
    ("heading/report.html", &["heading", "--slope-deg", "0:20:5", "--out", "heading"]),
    ("map/report.html", &["heading-map", "--out", "map"]),
    (
        "card.html",
        &["card", "--soil", "toyoura-uncertain", "--samples", "16", "--out", "card.html"],
    ),
    ("card/report.html", &["card", "--soil", "toyoura", "--samples", "16", "--out", "card"]),
];

/// Looks at the site in `target/site`, and at reports made for it, and counts pages; without a
/// browser all count as skipped.
pub(crate) fn check() -> Result<Count> {
    let mut count = scripts()?;
    let Some(browser) = tools::browser() else {
        println!("{}", CHROMIUM.missing());
        count += Count::skipped();
        return Ok(count);
    };
    let python = python::environment()?;
    let site = workspace::target().join("site");
    ensure!(site.join("index.html").is_file(), "there is no site: cargo xtask site");
    count += looked_at(&python, browser, &site, &PAGES)?;
    let (folder, pages) = reports()?;
    count += looked_at(&python, browser, &folder, &pages)?;
    count += used(&python, browser, None)?;
    Ok(count)
}

/// Uses the console as its users do, and counts claims about it; without a browser they count as
/// skipped.
///
/// * `pictures`: the folder that a picture of each view is written into
pub(crate) fn console(pictures: Option<&Path>) -> Result<Count> {
    let mut count = scripts()?;
    count += if let Some(browser) = tools::browser() {
        used(&python::environment()?, browser, pictures)?
    } else {
        println!("{}", CHROMIUM.missing());
        Count::skipped()
    };
    Ok(count)
}

/// Checks the types of the console's scripts, and that those of others are as they were published:
/// two checks, skipped without npm.
fn scripts() -> Result<Count> {
    if !NPM.is_here() {
        println!("{}", NPM.missing());
        return Ok(Count::skipped());
    }
    let folder = workspace::target().join("npm");
    fs::create_dir_all(&folder)?;
    let mut install = Command::new("npm");
    install.args(["install", "--no-save", "--no-audit", "--no-fund", "--silent"]);
    install.args([TYPESCRIPT, vendored::PACKAGE]).arg("--prefix").arg(&folder);
    let done = install.status().context("npm did not start")?;
    ensure!(done.success(), "npm cannot install {TYPESCRIPT} and {}", vendored::PACKAGE);
    let mut check = Command::new(folder.join("node_modules/.bin/tsc"));
    check.args(["--pretty", "false", "--project"]).arg(workspace::root().join(TYPED));
    let mut count = Count::one(check.status().context("tsc did not start")?.success());
    println!("types of the console's scripts: {count}");
    count += Count::one(vendored::check(&folder.join("node_modules"))?);
    Ok(count)
}

fn used(python: &Path, browser: &str, pictures: Option<&Path>) -> Result<Count> {
    let program = workspace::build_program()?;
    let mut look = Command::new(python);
    look.arg("-c").arg(USER).arg(browser).arg(rules_of_axe(python)?).arg(program);
    look.args(pictures);
    let output = look.stdin(Stdio::null()).stderr(Stdio::inherit()).output()?;
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    print!("{printed}");
    ensure!(output.status.success() || printed.contains("failed"), "the console was not tried");
    Ok(Count::of_closing_line(&printed))
}

/// Makes the reports anew; their folder, and their names in it.
fn reports() -> Result<(PathBuf, Vec<&'static str>)> {
    let program = workspace::build_program()?;
    let folder = workspace::target().join("reports");
    if folder.exists() {
        fs::remove_dir_all(&folder).context("old reports")?;
    }
    fs::create_dir_all(&folder)?;
    for (name, arguments) in REPORTS {
        let mut make = Command::new(&program);
        make.args(arguments).current_dir(&folder).stdin(Stdio::null()).stdout(Stdio::null());
        let done = make.status().with_context(|| format!("making {name}"))?.success();
        ensure!(done, "grouser {} failed", arguments.join(" "));
    }
    Ok((folder, REPORTS.map(|(name, _)| name).to_vec()))
}

fn looked_at(python: &Path, browser: &str, folder: &Path, pages: &[&str]) -> Result<Count> {
    let script = workspace::target().join("xtask/pages.py");
    fs::create_dir_all(script.parent().context("target")?)?;
    // A file: its worker processes read it again.
    fs::write(&script, LOOKER)?;
    let axe = rules_of_axe(python)?;
    let mut look = Command::new(python);
    look.arg(script).arg(browser).arg(axe).arg(folder).args(pages);
    let output = look.stdin(Stdio::null()).stderr(Stdio::inherit()).output()?;
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    print!("{printed}");
    Ok(Count::of_closing_line(&printed))
}

/// The script of axe, in the package that has it.
pub(crate) fn rules_of_axe(python: &Path) -> Result<String> {
    let ask = "import pathlib, axe_playwright_python as a; print(pathlib.Path(a.__file__).parent / \
               'axe.min.js')";
    let output = Command::new(python).args(["-c", ask]).output().context("Python did not start")?;
    ensure!(output.status.success(), "axe-playwright-python is not installed");
    Ok(String::from_utf8(output.stdout)?.trim().to_owned())
}
