//! One hash through every interface: whatever computes ten thousand wheels, a traverse, a mission and
//! an operator's card has the same bits. What was not computed here is named in the last lines.

use std::path::Path;
use std::process::Command;

use anyhow::{Result, ensure};

use crate::extent::Extent;
use crate::libtest::Count;
use crate::processors::PROCESSORS;
use crate::{c, python, tools, workspace};

/// Instruction sets by which the Rust library computes, if the processor has them.
const SETS: [&str; 3] = ["baseline", "avx2", "avx512"];

/// Interfaces that `crates/grouser-python/tests/hashes.py` asks, by its words for them, and the answers
/// that each has.
const INTERFACES: [(&str, &str, &[&str]); 3] = [
    ("the program", "program", &["wheel-test", "traverse", "mission", "card", "courses"]),
    ("the Python package", "package", &["wheel-test", "traverse", "mission", "card", "courses"]),
    ("an FMU", "fmu", &["traverse"]),
];

/// Compares the digests that the Rust library has with those by each instruction set, by C, the
/// program, the Python package and an FMU, and with `Extent::Full` by other processors.
pub(crate) fn check(extent: Extent) -> Result<Count> {
    c::build("hashes")?;
    let program = workspace::target().join("debug/examples/hashes");
    let all = c::output(&mut Command::new(&program))?;
    print!("by the Rust library:\n{all}");
    let expected = of_answers(&all, &["wheels", "traverse", "mission"]);
    ensure!(expected.lines().count() == 3, "there is not a digest for each answer");
    let mut count = Count::default();
    for set in SETS {
        let found = c::output(Command::new(&program).arg(set))?;
        count += if found.is_empty() {
            not_computed(&format!("instructions of {set}, which this processor lacks"))
        } else {
            compare(set, &found, &expected)
        };
    }
    for (compiler, found) in c::hashes()? {
        count += match found {
            Some(found) => compare(&format!("C, by {compiler}"), &found, &expected),
            None => not_computed(&format!("C by {compiler}, which is missing")),
        };
    }
    count += by_interfaces(&c::output(Command::new(&program).arg("tables"))?)?;
    let has_tools = extent == Extent::Full && tools::PROCESSORS.is_here_or_installed();
    if extent != Extent::Full {
        println!("other processors are left to `cargo xtask hashes` and `ci --full`");
    }
    for processor in PROCESSORS {
        count += if has_tools {
            compare(processor.name, &processor.output()?, &all)
        } else {
            not_computed(processor.name)
        };
    }
    Ok(count)
}

/// * `tables`: the digests of the columns of all answers
fn by_interfaces(tables: &str) -> Result<Count> {
    let python = python::installed()?;
    let grouser = workspace::target().join("debug/grouser");
    let mut count = Count::default();
    for (name, word, answers) in INTERFACES {
        let script = Path::new("crates/grouser-python/tests/hashes.py");
        let mut asked = Command::new(&python);
        asked.arg(workspace::root().join(script)).arg(word).arg(&grouser);
        count += compare(name, &c::output(&mut asked)?, &of_answers(tables, answers));
    }
    Ok(count)
}

/// The lines that are about some answers, or columns of them.
fn of_answers(digests: &str, answers: &[&str]) -> String {
    let is_about = |line: &&str| {
        let answer = line.split([' ', '.']).next().unwrap_or_default();
        answers.contains(&answer)
    };
    digests.lines().filter(is_about).map(|line| format!("{line}\n")).collect()
}

/// Compares digests, in whatever order they are.
fn compare(what: &str, found: &str, expected: &str) -> Count {
    let lines = |text: &str| -> Vec<String> {
        let mut lines: Vec<_> = text.lines().map(String::from).collect();
        lines.sort();
        lines
    };
    let (found, expected) = (lines(found), lines(expected));
    let is_same = found == expected && !expected.is_empty();
    println!("{what}: {} digests{}", found.len(), if is_same { ", all the same" } else { "" });
    for (whose, some, others) in [("its", &found, &expected), ("the library's", &expected, &found)]
    {
        for line in some.iter().filter(|line| !others.contains(line)) {
            println!("  only {whose}: {line}");
        }
    }
    Count::one(is_same)
}

fn not_computed(what: &str) -> Count {
    println!("not computed: {what}");
    Count::skipped()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_digest_that_differs_or_lacks_is_noticed() {
        let expected = "card.yaw_deg 00ff\nwheels 12ab\n";
        let is_same = |found| compare("here", found, expected) == Count::one(true);
        assert!(is_same("wheels 12ab\ncard.yaw_deg 00ff\n"));
        assert!(!is_same("wheels 12aa\ncard.yaw_deg 00ff\n") && !is_same("wheels 12ab\n"));
        assert!(compare("here", "", "") == Count::one(false));
        assert_eq!(of_answers(expected, &["card"]), "card.yaw_deg 00ff\n");
    }
}
