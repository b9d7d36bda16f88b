//! Other processors, as this machine imitates them: the digests of `grouser-bench`, compiled for each
//! by Debian's compiler of Rust, which has the sources of its standard library, and run by an emulator.

use std::path::PathBuf;
use std::process::Command;

use anyhow::{Result, ensure};

use crate::extent::Extent;
use crate::tools::{self, RUSTC};
use crate::{c, workspace};

/// A processor that this machine imitates.
pub(crate) struct Processor {
    pub(crate) name: &'static str,
    target: &'static str,
    linker: &'static str,
    /// The program that runs what is compiled for it, with its arguments.
    emulator: &'static [&'static str],
}

pub(crate) const PROCESSORS: [Processor; 3] = [
    Processor {
        name: "WebAssembly under node",
        target: "wasm32-wasip1",
        linker: "wasm-ld",
        emulator: &["node", "--no-warnings", "--eval", WASI],
    },
    Processor {
        name: "aarch64 under qemu",
        target: "aarch64-unknown-linux-gnu",
        linker: "aarch64-linux-gnu-gcc",
        emulator: &["qemu-aarch64"],
    },
    Processor {
        name: "riscv64 under qemu",
        target: "riscv64gc-unknown-linux-gnu",
        linker: "riscv64-linux-gnu-gcc",
        emulator: &["qemu-riscv64"],
    },
];

/// What gives a program of WebAssembly its standard output.
const WASI: &str = "
const wasi = new (require('wasi').WASI)({ version: 'preview1', args: ['hashes'] });
WebAssembly.instantiate(require('fs').readFileSync(process.argv[1]), wasi.getImportObject())
  .then(({ instance }) => wasi.start(instance));";

impl Processor {
    /// The digests, or why there are none.
    pub(crate) fn output(&self, extent: Extent) -> Result<Result<String, String>> {
        if extent != Extent::Full {
            return Ok(Err("which `cargo xtask hashes` and `ci --full` compute".into()));
        }
        if !tools::PROCESSORS.is_here_or_installed() {
            return Ok(Err(tools::PROCESSORS.missing()));
        }
        let [program, arguments @ ..] = self.emulator else {
            return Ok(Err("nothing runs it".into()));
        };
        c::output(Command::new(program).args(arguments).arg(self.build()?)).map(Ok)
    }

    /// Compiles the program of digests, with all that it needs.
    fn build(&self) -> Result<PathBuf> {
        let folder = workspace::target().join("xtask/processors");
        let variable = self.target.to_uppercase().replace('-', "_");
        let mut cargo = workspace::cargo();
        cargo.args(["build", "-Zbuild-std=std,panic_abort", "--target", self.target]);
        cargo.args(["-p", "grouser-bench", "--bin", "hashes"]);
        cargo.env("CARGO_TARGET_DIR", &folder).env("CARGO_INCREMENTAL", "0");
        cargo.env("RUSTC", RUSTC).env("RUSTC_BOOTSTRAP", "1");
        cargo.env(format!("CARGO_TARGET_{variable}_LINKER"), self.linker);
        cargo.env(format!("CARGO_TARGET_{variable}_RUSTFLAGS"), "-Ctarget-feature=+crt-static");
        ensure!(cargo.status()?.success(), "grouser-bench does not build for {}", self.target);
        let end = if self.linker == "wasm-ld" { ".wasm" } else { "" };
        Ok(folder.join(self.target).join(format!("debug/hashes{end}")))
    }
}
