//! One hash through every interface: whatever computes ten thousand wheels, a traverse and a mission
//! has the same bits. What was not computed here is named in the last lines.

use std::process::Command;

use anyhow::{Result, ensure};

use crate::c;
use crate::libtest::Count;
use crate::workspace;

/// Instruction sets by which the Rust library computes, if the processor has them.
const SETS: [&str; 3] = ["baseline", "avx2", "avx512"];

/// What is yet to be computed in the same way: each is a check that is not made.
const NOT_COMPUTED: [&str; 6] = [
    "the program",
    "the Python package",
    "an operator's card",
    "WebAssembly under node",
    "aarch64 under qemu",
    "riscv64 under qemu",
];

/// Compares the digests that the Rust library has by each instruction set, and those by C.
pub(crate) fn check() -> Result<Count> {
    c::build("hashes")?;
    let program = workspace::target().join("debug/examples/hashes");
    let expected = c::output(&mut Command::new(&program))?;
    print!("by the Rust library:\n{expected}");
    ensure!(expected.lines().count() == 3, "there is not a digest for each of three answers");
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
    for what in NOT_COMPUTED {
        count += not_computed(what);
    }
    Ok(count)
}

fn compare(what: &str, found: &str, expected: &str) -> Count {
    let is_same = found == expected;
    println!("{what}: {}", if is_same { "the same" } else { found });
    Count::one(is_same)
}

fn not_computed(what: &str) -> Count {
    println!("not computed: {what}");
    Count::skipped()
}
