//! Tools that the checks need besides the toolchain, and how to install them.
//!
//! The machine belongs to the person who runs the checks: packages of the system are installed only
//! where the environment variable `CI` says that it is a machine of continuous integration.
//! Elsewhere a check that needs one says so and is counted as skipped.

use std::process::{Command, Stdio};

use crate::libtest::Count;
use crate::workspace;

/// A part of the system that some checks need.
#[derive(Clone, Copy)]
pub(crate) struct SystemTool {
    name: &'static str,
    /// Packages of Debian and of the distributions derived from it.
    packages: &'static [&'static str],
    /// What is skipped without it.
    checks: &'static str,
    found: fn() -> bool,
}

/// All of them.
const ALL: [SystemTool; 5] = [VALGRIND, RENDERER, CHROMIUM, NPM, CLANG];

/// What counts instructions.
pub(crate) const VALGRIND: SystemTool = SystemTool {
    name: "valgrind",
    packages: &["valgrind"],
    checks: "the counts of instructions",
    found: || runs("valgrind", &["--version"]),
};

/// What MuJoCo draws with where there is no display. Elsewhere than on Linux the system does.
pub(crate) const RENDERER: SystemTool = SystemTool {
    name: "a renderer without a display (Mesa's EGL)",
    packages: &["libegl1", "libegl-mesa0", "libgl1-mesa-dri"],
    checks: "pictures of MuJoCo models",
    found: || {
        let libraries = Command::new("/sbin/ldconfig").arg("-p").output();
        !cfg!(target_os = "linux")
            || libraries.is_ok_and(|listed| {
                String::from_utf8_lossy(&listed.stdout).contains("libEGL_mesa.so")
            })
    },
};

/// What shows pages as their readers see them.
pub(crate) const CHROMIUM: SystemTool = SystemTool {
    name: "Chromium",
    packages: &["chromium", "fonts-dejavu-core"],
    checks: "the looks at pages in a browser",
    found: || browser().is_some(),
};

/// What installs the checker of types of scripts.
pub(crate) const NPM: SystemTool = SystemTool {
    name: "npm",
    packages: &["npm"],
    checks: "the types of the console's scripts",
    found: || runs("npm", &["--version"]),
};

/// The second compiler of C and C++, whose warnings are others.
const CLANG: SystemTool = SystemTool {
    name: "clang",
    packages: &["clang"],
    checks: "the programs in C and C++ by it",
    found: || runs("clang", &["--version"]) && runs("clang++", &["--version"]),
};

/// What compiles for other processors, and runs that.
pub(crate) const PROCESSORS: SystemTool = SystemTool {
    name: "what compiles for other processors, or an emulator,",
    packages: &[
        "rustc-web",
        "rust-web-src",
        "lld",
        "wasi-libc",
        "nodejs",
        "qemu-user",
        "gcc-aarch64-linux-gnu",
        "gcc-riscv64-linux-gnu",
    ],
    checks: "the digests by these",
    found: || {
        let linkers = ["wasm-ld", "aarch64-linux-gnu-gcc", "riscv64-linux-gnu-gcc"];
        let programs = ["node", "qemu-aarch64", "qemu-riscv64"];
        has_sources() && linkers.iter().chain(&programs).all(|it| runs(it, &["--version"]))
    },
};

/// What compiles for browsers where the toolchain cannot.
pub(crate) const ENGINE: SystemTool = SystemTool {
    name: "what compiles for browsers (else: rustup target add wasm32-wasip1)",
    packages: &["rustc-web", "rust-web-src", "lld", "wasi-libc"],
    checks: "the engine of the console without a server and its checks",
    found: || has_sources() && runs("wasm-ld", &["--version"]),
};

/// What runs scripts and WebAssembly outside of browsers.
pub(crate) const NODE: SystemTool = SystemTool {
    name: "node",
    packages: &["nodejs"],
    checks: "the comparisons of the console's engine",
    found: || runs("node", &["--version"]),
};

/// Whether Debian's compiler has the sources of its standard library.
fn has_sources() -> bool {
    std::path::Path::new("/usr/lib/rustlib/src/rust/library").exists()
}

/// The program of that browser; some systems name it otherwise.
pub(crate) fn browser() -> Option<&'static str> {
    // The driver of browsers starts it by its path, as Linux has it.
    let paths = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
    paths.into_iter().find(|path| std::path::Path::new(path).exists())
}

impl SystemTool {
    /// Whether the system has it.
    pub(crate) fn is_here(self) -> bool {
        (self.found)()
    }

    /// The same, after installing what is missing on a machine of continuous integration.
    pub(crate) fn is_here_or_installed(self) -> bool {
        if !self.is_here() && is_ci(std::env::var("CI").ok().as_deref()) {
            install([self].iter());
        }
        if !self.is_here() {
            println!("{}", self.missing());
        }
        self.is_here()
    }

    /// What is missing, what that costs, and how to get it.
    pub(crate) fn missing(self) -> String {
        let Self { name, packages, checks, .. } = self;
        format!(
            "{name} is missing, so {checks} are skipped; on Debian or Ubuntu: apt-get install {}",
            packages.join(" ")
        )
    }
}

/// Looks for all that the other steps need, after fetching what may be fetched.
pub(crate) fn check() -> Count {
    let mut count = Count::one(component("rustfmt", "fmt"));
    count += Count::one(component("clippy", "clippy"));
    let ours = is_ci(std::env::var("CI").ok().as_deref());
    let missing = |tool: &&SystemTool| !tool.is_here();
    if ours {
        install(ALL.iter().filter(missing));
    }
    for tool in ALL {
        let here = tool.is_here();
        println!("{}", if here { format!("{}: found", tool.name) } else { tool.missing() });
        // Elsewhere the checks that need it count themselves as skipped.
        if here || ours {
            count += Count::one(here);
        }
    }
    count
}

/// Whether this is a machine of continuous integration, whose packages are ours to install.
///
/// * `variable`: the value of `CI`
fn is_ci(variable: Option<&str>) -> bool {
    variable.is_some_and(|value| !matches!(value, "" | "0" | "false"))
}

/// Whether a component of the toolchain is here, after adding it where rustup can.
fn component(name: &str, subcommand: &str) -> bool {
    let present = || {
        let mut probe = workspace::cargo();
        probe.args([subcommand, "--version"]).stdout(Stdio::null()).stderr(Stdio::null());
        probe.status().is_ok_and(|status| status.success())
    };
    if !present() {
        println!("{name} is missing, trying to add it to the toolchain");
        // Without rustup this fails, and the second look says so.
        let _ = Command::new("rustup").args(["component", "add", name]).status();
    }
    let found = present();
    println!("{name}: {}", if found { "found" } else { "missing" });
    found
}

/// Installs the packages of tools, after one update of the lists.
fn install<'a>(tools: impl Iterator<Item = &'a SystemTool>) {
    let packages: Vec<&str> = tools.flat_map(|tool| tool.packages).copied().collect();
    if packages.is_empty() {
        return;
    }
    println!("installing {}", packages.join(" "));
    for arguments in [&["update"][..], &[&["install", "--yes"], &packages[..]].concat()] {
        let mut install = Command::new("apt-get");
        install.args(["--quiet=2"]).args(arguments).stdout(Stdio::null());
        // Where it fails, the look that follows says so.
        let _ = install.status();
    }
}

/// Whether a program is here and runs.
pub(crate) fn runs(program: &str, arguments: &[&str]) -> bool {
    let mut probe = Command::new(program);
    probe.args(arguments).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    probe.status().is_ok_and(|status| status.success())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packages_are_installed_only_where_ci_is_set() {
        assert!(is_ci(Some("true")) && is_ci(Some("1")));
        for elsewhere in [None, Some(""), Some("0"), Some("false")] {
            assert!(!is_ci(elsewhere), "{elsewhere:?}");
        }
    }

    #[test]
    fn a_missing_tool_says_what_is_skipped_and_how_to_get_it() {
        let message = VALGRIND.missing();
        assert!(
            message.contains("instructions are skipped") && message.contains("install valgrind")
        );
    }
}
