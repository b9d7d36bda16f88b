//! Other processors, as this machine imitates them: the digests of `crates/grouser-c/examples/hashes.rs`,
//! compiled by Debian's compiler of Rust, which has the sources of its standard library, and run by
//! emulators.

use std::process::Command;

use anyhow::{Result, ensure};

use crate::{c, workspace};

/// A processor that this machine imitates.
pub(crate) struct Processor {
    pub(crate) name: &'static str,
    target: &'static str,
    linker: &'static str,
    /// What the compiler is given.
    options: &'static str,
    /// The program that runs what is compiled for it, with its arguments.
    emulator: &'static [&'static str],
    /// The end of the names of programs.
    suffix: &'static str,
}

pub(crate) const PROCESSORS: [Processor; 3] = [
    Processor {
        name: "WebAssembly under node",
        target: "wasm32-wasip1",
        linker: "wasm-ld",
        options: "-Lnative=/usr/lib/wasm32-wasi -Clink-arg=--allow-undefined",
        emulator: &["node", "--no-warnings", "--eval", WASI],
        suffix: ".wasm",
    },
    Processor {
        name: "aarch64 under qemu",
        target: "aarch64-unknown-linux-gnu",
        linker: "aarch64-linux-gnu-gcc",
        options: "",
        emulator: &["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"],
        suffix: "",
    },
    Processor {
        name: "riscv64 under qemu",
        target: "riscv64gc-unknown-linux-gnu",
        linker: "riscv64-linux-gnu-gcc",
        options: "",
        emulator: &["qemu-riscv64", "-L", "/usr/riscv64-linux-gnu"],
        suffix: "",
    },
];

/// What gives a program of WebAssembly its standard output, and what Debian's library lacks, which is
/// older than the compiler: paths are not resolved, and threads not supported (error 58).
const WASI: &str = "\
const wasi = new (require('wasi').WASI)({ version: 'preview1', args: ['hashes'] });
const zero = () => 0, env = { realpath: zero, pthread_create: () => 58, pthread_detach: zero };
for (const name of ['init', 'setstacksize', 'destroy']) env[`pthread_attr_${name}`] = zero;
const program = require('fs').readFileSync(process.argv[1]);
WebAssembly.instantiate(program, { ...wasi.getImportObject(), env })
  .then(({ instance }) => wasi.start(instance));";

impl Processor {
    /// The digests, compiled with all that they need.
    pub(crate) fn output(&self) -> Result<String> {
        let folder = workspace::target().join("xtask/processors");
        let variable = format!("CARGO_TARGET_{}_", self.target.to_uppercase().replace('-', "_"));
        let mut cargo = workspace::cargo();
        cargo.args(["build", "-Zbuild-std=std,panic_abort", "--target", self.target]);
        cargo.args(["-p", "grouser-c", "--example", "hashes"]);
        cargo.env("CARGO_TARGET_DIR", &folder).env("CARGO_INCREMENTAL", "0");
        cargo.env("RUSTC", "/usr/bin/rustc").env("RUSTC_BOOTSTRAP", "1");
        cargo.env(format!("{variable}LINKER"), self.linker);
        cargo.env(format!("{variable}RUSTFLAGS"), self.options);
        // Compiling takes longest: only the physics is worth optimising.
        cargo.env("CARGO_PROFILE_DEV_DEBUG", "0").env("CARGO_PROFILE_DEV_OPT_LEVEL", "0");
        for package in ["grouser", "grouser-io", "grouser-raster", "grouser-c"] {
            cargo.arg("--config").arg(format!("profile.dev.package.{package}.opt-level=0"));
        }
        ensure!(cargo.status()?.success(), "the digests do not build for {}", self.target);
        let program = format!("{}/debug/examples/hashes{}", self.target, self.suffix);
        let mut emulator = Command::new(self.emulator[0]);
        c::output(emulator.args(&self.emulator[1..]).arg(folder.join(program)))
    }
}
