//! Checks the C interface as its users see it: programs in C, C++ and Python that link the library
//! print what the Rust library prints, by every compiler that is here, and wrong uses end in codes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::libtest::Count;
use crate::tools::{VALGRIND, runs};
use crate::workspace;

/// A language with its compilers, what these are asked for, and its programs in
/// `crates/grouser-c/examples`.
struct Language {
    compilers: [&'static str; 2],
    standard: &'static str,
    extension: &'static str,
    programs: &'static [&'static str],
}

const LANGUAGES: [Language; 2] = [
    Language {
        compilers: ["gcc", "clang"],
        standard: "-std=c11",
        extension: "c",
        programs: &["wheel", "run", "time_step"],
    },
    Language {
        compilers: ["g++", "clang++"],
        standard: "-std=c++17",
        extension: "cpp",
        programs: &["mission"],
    },
];

/// Warnings are errors: a header that warns is one that somebody cannot use. And no compiler fuses
/// what an example computes before the library does.
const OPTIONS: [&str; 5] = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-ffp-contract=off"];

/// The folder of the crate, that of what is built here, and that of the library.
struct Folders {
    sources: PathBuf,
    made: PathBuf,
    library: PathBuf,
}

/// Builds the library, and compiles, runs and compares all programs. What is not here is named and
/// counts as skipped.
pub(crate) fn check() -> Result<Count> {
    build("reference")?;
    let folders = Folders::new()?;
    let mut count = check_header()?;
    for language in &LANGUAGES {
        for compiler in language.compilers {
            count += folders.check_with(language, compiler)?;
        }
    }
    count += folders.check_python()?;
    Ok(count)
}

/// Builds the library and an example, beside the program, with which they share all that was
/// compiled: alone, they would choose other features of the libraries below, and compile all of them
/// once more.
pub(crate) fn build(example: &str) -> Result<()> {
    let mut cargo = workspace::linting_cargo();
    cargo.args(["build", "-p", "grouser-c", "--lib", "--example", example]);
    cargo.args(["--bins", "-p", "grouser-cli", "-p", "grouser-bench"]);
    ensure!(cargo.status().context("cargo did not start")?.success(), "the library does not build");
    Ok(())
}

/// What `examples/hashes.c` prints by each compiler of C; nothing for one that is missing. The
/// library is built already.
pub(crate) fn hashes() -> Result<Vec<(&'static str, Option<String>)>> {
    let folders = Folders::new()?;
    let [language, _] = &LANGUAGES;
    let by = |compiler: &'static str| {
        if !runs(compiler, &["--version"]) {
            return Ok((compiler, None));
        }
        let source = folders.sources.join("examples/hashes.c");
        let made = folders.compile(compiler, language.standard, &source)?;
        Ok((compiler, Some(output(&mut folders.command(&made))?)))
    };
    language.compilers.into_iter().map(by).collect()
}

/// Compiles the plugin of MuJoCo's engine, against the engine in a folder of Python's package. The
/// library is built already. Nothing, and a line that says so, where it cannot be had.
pub(crate) fn mujoco_plugin(engine: &Path) -> Result<Option<PathBuf>> {
    let [_, Language { compilers, standard, .. }] = &LANGUAGES;
    let library = fs::read_dir(engine)?
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .find(|name| name.starts_with("libmujoco.so"));
    let compiler = compilers.iter().find(|compiler| runs(compiler, &["--version"]));
    let (Some(library), Some(compiler)) = (library, compiler) else {
        println!("a compiler of C++ or the engine is missing, so MuJoCo's plugin is skipped");
        return Ok(None);
    };
    let folders = Folders::new()?;
    let made = folders.made.join("libgrouser_mujoco.so");
    let mut command = Command::new(compiler);
    command.args([standard, "-O2", "-shared", "-fPIC"]).args(OPTIONS);
    command.arg(folders.sources.join("mujoco/soil.cpp"));
    command.arg("-I").arg(folders.sources.join("include"));
    command.arg("-isystem").arg(engine.join("include"));
    command.arg(folders.library.join("libgrouser_c.a"));
    command.arg("-L").arg(engine).arg(format!("-l:{library}"));
    command.args(["-lm", "-lpthread", "-ldl", "-o"]).arg(&made);
    let status = command.status().with_context(|| format!("{compiler} did not start"))?;
    ensure!(status.success(), "{compiler} does not compile MuJoCo's plugin");
    Ok(Some(made))
}

/// What makes the header. A tool and no dependency: who builds the library has the header already.
const CBINDGEN: &str = "0.29.4";

/// Writes the header.
pub(crate) fn write_header() -> Result<Count> {
    let Some(made) = header()? else { return Ok(Count::skipped()) };
    fs::write(header_path(), made)?;
    Ok(Count::one(true))
}

/// Compares the header with what is made of the sources.
fn check_header() -> Result<Count> {
    let Some(made) = header()? else { return Ok(Count::skipped()) };
    let is_same = fs::read(header_path())? == made;
    if !is_same {
        println!("grouser.h is not what the sources have; cargo xtask c --header writes it");
    }
    Ok(Count::one(is_same))
}

fn header_path() -> PathBuf {
    workspace::root().join("crates/grouser-c/include/grouser.h")
}

/// What cbindgen makes of the sources; nothing, and a line that says so, where it cannot be had.
fn header() -> Result<Option<Vec<u8>>> {
    let tools = workspace::target().join("xtask/tools");
    let cbindgen = tools.join("bin").join(format!("cbindgen{}", std::env::consts::EXE_SUFFIX));
    let is_here = || {
        let version = Command::new(&cbindgen).arg("--version").output();
        version.is_ok_and(|it| String::from_utf8_lossy(&it.stdout).trim_end().ends_with(CBINDGEN))
    };
    if !is_here() {
        println!("building cbindgen {CBINDGEN} into {}", tools.display());
        let mut install = workspace::cargo();
        install.args([
            "install",
            "cbindgen",
            "--locked",
            "--force",
            "--version",
            CBINDGEN,
            "--root",
        ]);
        // Where it fails, the look that follows says so.
        let _ = install.arg(&tools).status();
    }
    if !is_here() {
        println!(
            "cbindgen {CBINDGEN} is missing, so the header of the C interface is not compared"
        );
        return Ok(None);
    }
    let folder = workspace::root().join("crates/grouser-c");
    let mut command = Command::new(&cbindgen);
    command.arg("--quiet").arg("--config").arg(folder.join("cbindgen.toml")).arg(&folder);
    let output = command.output().context("cbindgen did not start")?;
    let text = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "cbindgen failed: {text}");
    Ok(Some(output.stdout))
}

impl Folders {
    fn new() -> Result<Self> {
        let made = workspace::target().join("xtask/c");
        fs::create_dir_all(&made)?;
        let sources = workspace::root().join("crates/grouser-c");
        Ok(Self { sources, made, library: workspace::target().join("debug") })
    }

    /// Compiles, runs and compares the programs of a language by one compiler; and in C the wrong
    /// uses.
    fn check_with(&self, language: &Language, compiler: &str) -> Result<Count> {
        let is_c = language.extension == "c";
        if !runs(compiler, &["--version"]) {
            println!("{compiler} is missing, so programs compiled by it are skipped");
            return Ok(Count::skipped());
        }
        let mut count = Count::default();
        for program in language.programs {
            let source = self.sources.join(format!("examples/{program}.{}", language.extension));
            let made = self.compile(compiler, language.standard, &source)?;
            let printed = output(&mut self.command(&made))?;
            count +=
                compare(&format!("{program} by {compiler}"), &printed, &self.expected(program)?);
        }
        if is_c {
            let made = self.compile(
                compiler,
                language.standard,
                &self.sources.join("tests/wrong_uses.c"),
            )?;
            count += self.check_wrong_uses(&made);
        }
        Ok(count)
    }

    /// Compiles a program, which is linked with the shared library, and returns its path.
    fn compile(&self, compiler: &str, standard: &str, source: &Path) -> Result<PathBuf> {
        let name = source.file_stem().unwrap_or_default().to_string_lossy();
        let made = self.made.join(format!("{name}-{compiler}"));
        let mut command = Command::new(compiler);
        command.arg(standard).args(OPTIONS).arg(source);
        command.arg("-I").arg(self.sources.join("include")).arg("-L").arg(&self.library);
        command.args(["-lgrouser_c", "-lm", "-lpthread", "-o"]).arg(&made);
        let status = command.status().with_context(|| format!("{compiler} did not start"))?;
        ensure!(status.success(), "{compiler} does not compile {}", source.display());
        Ok(made)
    }

    /// A program that finds the library.
    fn command(&self, program: &Path) -> Command {
        let mut command = Command::new(program);
        for variable in ["LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH"] {
            command.env(variable, &self.library);
        }
        command
    }

    /// Runs the wrong uses, alone and where memory is watched.
    fn check_wrong_uses(&self, made: &Path) -> Count {
        let passes = |command: &mut Command| command.status().is_ok_and(|it| it.success());
        let mut count = Count::one(passes(&mut self.command(made)));
        if !VALGRIND.is_here() {
            println!("valgrind is missing, so wrong uses of the C interface are not watched by it");
            count += Count::skipped();
            return count;
        }
        let mut watched = self.command(Path::new("valgrind"));
        // What the library computes once and keeps is not lost.
        watched.args(["--quiet", "--error-exitcode=1", "--leak-check=full"]);
        watched.args(["--show-leak-kinds=definite", "--errors-for-leak-kinds=definite"]);
        count += Count::one(passes(watched.arg(made)));
        count
    }

    /// Compares what Python's ctypes get of the library.
    fn check_python(&self) -> Result<Count> {
        if !runs("python3", &["--version"]) {
            println!("python3 is missing, so the program by ctypes is skipped");
            return Ok(Count::skipped());
        }
        let (start, end) = (std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
        let mut python = Command::new("python3");
        python.arg(self.sources.join("examples/wheel.py"));
        python.arg(self.library.join(format!("{start}grouser_c{end}")));
        Ok(compare("wheel by ctypes", &output(&mut python)?, &self.expected("wheel")?))
    }

    /// What the Rust library prints in the place of a program.
    fn expected(&self, program: &str) -> Result<String> {
        output(Command::new(self.library.join("examples/reference")).arg(program))
    }
}

/// What a program prints.
pub(crate) fn output(command: &mut Command) -> Result<String> {
    let output = command.output().with_context(|| format!("{command:?} did not start"))?;
    let text = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "{command:?} failed: {text}");
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Compares names and numbers, these bit for bit; each language writes them in its own way.
fn compare(what: &str, printed: &str, expected: &str) -> Count {
    let (printed, expected) = (numbers(printed), numbers(expected));
    let is_same = printed == expected && !expected.is_empty();
    if !is_same {
        println!("{what} printed {printed:?}, the library {expected:?}");
    }
    Count::one(is_same)
}

/// Each line's name, and the bits of its number.
fn numbers(text: &str) -> Vec<(String, Option<u64>)> {
    let bits = |number: &str| number.parse::<f64>().ok().map(f64::to_bits);
    let line = |line: &str| {
        let (name, number) = line.split_once(' ').unwrap_or((line, ""));
        (name.to_owned(), bits(number))
    };
    text.lines().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_compared_by_their_bits_however_they_are_written() {
        let compare = |one, other| compare("", one, other) == Count::one(true);
        assert!(compare("x_m 0.10000000000000001\ny_m 4\n", "x_m 0.1\ny_m 4.0\n"));
        assert!(!compare("x_m 0.10000000000000002\n", "x_m 0.1\n"));
        assert!(!compare("x_m 0.1\n", "y_m 0.1\n") && !compare("", ""));
    }
}
