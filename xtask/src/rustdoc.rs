//! Builds the documentation and refuses all warnings but one kind, which is mistaken.
//!
//! Our docs write units and sources in brackets, `[m]` or `[FourWheel]`, which rustdoc takes for
//! links. So `Cargo.toml` switches its lint of broken links off, and here it is switched on by
//! force: what is left after the units and sources are links that really lead nowhere.

use std::process::Stdio;

use anyhow::{Context, Result};

use crate::cited::is_work;
use crate::workspace;

/// Units, which may stand in brackets without being a link; works that are cited may, too.
const UNITS: [&str; 19] = [
    "A", "Hz", "J", "K", "N", "Pa", "V", "W", "bytes", "kPa", "kg", "m", "m²", "mm", "nat", "ns",
    "rad", "s", "Ω",
];

/// Whether the documentation of all crates builds without a warning; prints those it has.
pub(crate) fn check() -> Result<bool> {
    let output = workspace::cargo()
        .args(["doc", "--workspace", "--no-deps"])
        .env("RUSTDOCFLAGS", "--deny warnings --force-warn rustdoc::broken_intra_doc_links")
        .stderr(Stdio::piped())
        .output()
        .context("cargo did not start")?;
    let report = String::from_utf8_lossy(&output.stderr);
    let broken = broken_links(&report);
    if output.status.success() {
        println!("{}", broken.join("\n\n"));
    } else {
        println!("{}", without_mistaken_links(&report).join("\n\n"));
    }
    println!("{} broken links", broken.len());
    Ok(output.status.success() && broken.is_empty())
}

/// The reports of rustdoc on links that lead nowhere.
fn broken_links(report: &str) -> Vec<&str> {
    without_mistaken_links(report)
        .into_iter()
        .filter(|report| report.contains("unresolved link to `"))
        .collect()
}

/// The output of rustdoc, report by report, without those on units and sources.
fn without_mistaken_links(report: &str) -> Vec<&str> {
    report
        .split("\n\n")
        .filter(|report| {
            let link = report.split("unresolved link to `").nth(1);
            let target = link.and_then(|rest| rest.split('`').next());
            !target.is_some_and(|target| UNITS.contains(&target) || is_work(target))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const REPORT: &str = "\
 Documenting grouser
warning: unresolved link to `m`
  --> a.rs:1:1

warning: unresolved link to `Soil::chek`
  --> a.rs:2:1

error: something else
  --> a.rs:3:1";

    #[test]
    fn units_are_no_links_and_the_rest_is_reported() {
        let broken = broken_links(REPORT);
        assert_eq!(broken.len(), 1);
        assert!(broken[0].contains("Soil::chek"));
        assert_eq!(without_mistaken_links(REPORT).len(), 2);
    }
}
