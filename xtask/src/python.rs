//! The Python package: built as a wheel, installed into an environment of its own, and tested there
//! as its users have it.

use std::ffi::OsStr;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;

use anyhow::{Context, Error, Result, ensure};

use crate::extent::Extent;
use crate::libtest::Count;
use crate::requirements::{self, Requirement};
use crate::tools::RENDERER;
use crate::{c, markers, workspace};

/// The package's folder.
const PACKAGE: &str = "crates/grouser-python";

/// What builds the site, besides what tests the package.
const SITE: [&str; 10] = [
    "sphinx>=8.1,<10",
    "myst-nb>=1.3,<2",
    "pydata-sphinx-theme>=0.16,<1",
    "numpydoc>=1.8,<2",
    "sphinx-design",
    "sphinx-copybutton",
    // Equations: KaTeX, what runs it, and a font.
    "sphinxcontrib-katex>=0.9.10,<1",
    "dukpy>=0.5,<1",
    "ziamath>=0.12",
    // What a notebook shows besides Dask.
    "joblib>=1.3",
];

/// What looks at the site: a driver of browsers, and the rules of accessibility.
const LOOKING: [&str; 2] = ["playwright>=1.45,<2", "axe-playwright-python>=0.1.4"];

/// What builds and tests the package besides what it requires itself, by name: where from is for
/// pip's own settings to say.
const BUILDING: &str = "maturin>=1.16,<2";
const TESTING: [&str; 3] = ["pytest>=8", "pytest-xdist>=3.5", "hypothesis>=6"];
/// What reads the program's logs: the container, Foxglove's schemas, and Rerun, which is large (100
/// MB).
const LOGS: [&str; 4] = [
    "mcap>=1.2,<2",
    "mcap-protobuf-support>=0.5,<1",
    "foxglove-sdk>=0.30,<1",
    "rerun-sdk>=0.41,<1",
];
/// What loads the program's FMUs: the version that `docs/guide/fmi.md` names.
const FMUS: &str = "fmpy==0.3.32";
const TYPES: &str = "mypy>=1.10";
/// What reads the workflows.
const YAML: &str = "pyyaml>=6";
/// What knows the form of `CITATION.cff`.
const CITATION: &str = "check-jsonschema>=0.33";
/// Extras that only `ci --full` installs: each package is larger than all others together, and
/// starting Ray's workers takes longest of all tests. Without them those tests are skipped.
const HEAVY: [&str; 2] = ["ray", "torch"];
/// The module whose examples need one of them.
const NEEDS_HEAVY: &str = "--ignore-glob=/*/grouser/torch.py";

/// Builds the wheel, installs it, and counts the tests of the package: pytest's, the examples of
/// its docstrings, and its types. `Extent::Full` tests the heavy extras too, and the lower bounds of
/// all.
pub(crate) fn check(extent: Extent) -> Result<Count> {
    let python = installed()?;
    if extent == Extent::Full {
        let heavy = requirements()?.into_iter().filter(|one| HEAVY.contains(&&*one.extra));
        install(&python, &heavy.map(|one| one.text).collect::<Vec<_>>())?;
    }
    let built = built(&python)?;
    let mut count = pytest(&python, &built, &["-n", "2", "--dist", "loadfile", "tests"])?;
    let mut examples = vec!["--doctest-modules", "--pyargs", "grouser"];
    if extent != Extent::Full {
        examples.push(NEEDS_HEAVY);
    }
    count += pytest(&python, &built, &examples)?;
    count += types(&python, &["-m", "mypy.stubtest", "grouser._core"])?;
    count += types(&python, &["-m", "mypy", "--strict", "tests/user_script.py"])?;
    // The package's own half; what it draws and tabulates with need not be typed.
    let own = ["-m", "mypy", "--strict", "--ignore-missing-imports", "--package", "grouser"];
    count += types(&python, &own)?;
    if extent == Extent::Full {
        count += check_lowest()?;
    }
    Ok(count)
}

/// Counts the package's tests in an environment that has exactly the lower bounds of what the
/// package and its extras require.
pub(crate) fn check_lowest() -> Result<Count> {
    let folder = folder().join("lowest");
    let python = made(&folder)?;
    let mut needed: Vec<String> = requirements()?.iter().map(Requirement::lowest).collect();
    needed.extend(TESTING.map(String::from));
    install(&python, &needed)?;
    install_wheel(&python, &wheel()?)?;
    // Old packages warn of younger ones that they use themselves: those warnings are theirs.
    pytest(&python, &built(&python)?, &["-W", "default", "tests"])
}

/// The file that says what Python costs.
const PERFORMANCE: &str = "docs/performance.md";
/// Its block.
const TIMES: &str = "measured by: cargo xtask python-times";

/// Measures what Python costs beside a program that does the same, and writes it into its document.
pub(crate) fn write_times() -> Result<()> {
    let mut command = Command::new(installed()?);
    command.arg(workspace::root().join(PACKAGE).join("benches/ratios.py"));
    command.arg(workspace::build_work(workspace::Profile::Release)?);
    let output = command.stderr(Stdio::inherit()).output().context("Python did not start")?;
    ensure!(output.status.success(), "the times cannot be measured");
    markers::write_content_by(PERFORMANCE, TIMES, &String::from_utf8(output.stdout)?)
}

/// The Python of an environment that has the package as it is now, built once in a run.
pub(crate) fn installed() -> Result<PathBuf> {
    static INSTALLED: OnceLock<()> = OnceLock::new();
    let python = environment()?;
    if INSTALLED.get().is_none() {
        install_wheel(&python, &wheel()?)?;
        INSTALLED.get_or_init(|| ());
    }
    Ok(python)
}

/// The Python of that environment, as another process of this program has made it.
pub(crate) fn as_it_is() -> PathBuf {
    python_of(&folder().join("environment"))
}

/// The Python of an environment with all that builds and tests the package, but without it. Made
/// once in a run; who asks meanwhile, waits.
pub(crate) fn environment() -> Result<PathBuf> {
    static PYTHON: OnceLock<Result<PathBuf, String>> = OnceLock::new();
    let python = PYTHON.get_or_init(|| make_environment().map_err(|error| format!("{error:#}")));
    python.clone().map_err(Error::msg)
}

fn make_environment() -> Result<PathBuf> {
    let python = made(&folder().join("environment"))?;
    let required = requirements()?.into_iter().filter(|one| !HEAVY.contains(&&*one.extra));
    let mut needed: Vec<String> = required.map(|one| one.text).collect();
    needed.extend([BUILDING, TYPES, FMUS, YAML, CITATION].map(String::from));
    needed.extend(TESTING.map(String::from));
    needed.extend(LOGS.map(String::from));
    needed.extend(SITE.map(String::from));
    needed.extend(LOOKING.map(String::from));
    install(&python, &needed)?;
    Ok(python)
}

/// The package's manifest for cargo.
pub(crate) fn manifest() -> PathBuf {
    workspace::root().join(PACKAGE).join("Cargo.toml")
}

fn folder() -> PathBuf {
    workspace::target().join("python")
}

fn requirements() -> Result<Vec<Requirement>> {
    let path = workspace::root().join(PACKAGE).join("pyproject.toml");
    let found = requirements::of_project(&fs::read_to_string(path).context("pyproject.toml")?)?;
    ensure!(!found.is_empty(), "pyproject.toml requires nothing");
    Ok(found)
}

/// The Python of a virtual environment, made if it is not there.
fn made(folder: &Path) -> Result<PathBuf> {
    let python = python_of(folder);
    if !python.exists() {
        let system = if cfg!(windows) { "python" } else { "python3" };
        let make = ["-m", "venv", "--clear"];
        done(Command::new(system).args(make).arg(folder), "no virtual environment can be made")?;
    }
    Ok(python)
}

fn python_of(environment: &Path) -> PathBuf {
    environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" })
}

/// Has pip fetch packages, by name.
pub(crate) fn install(python: &Path, packages: &[impl AsRef<OsStr>]) -> Result<()> {
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
    let command = &mut Command::new(python);
    done(command.args(install).args(packages), "pip cannot install what is needed")
}

fn install_wheel(python: &Path, wheel: &Path) -> Result<()> {
    let install = ["-m", "pip", "install", "--quiet", "--force-reinstall", "--no-deps"];
    done(Command::new(python).args(install).arg(wheel), "the wheel cannot be installed")
}

/// Where the wheel is built.
pub(crate) fn wheels() -> PathBuf {
    folder().join("wheels")
}

/// The wheel, built once in a run.
fn wheel() -> Result<PathBuf> {
    static WHEEL: OnceLock<PathBuf> = OnceLock::new();
    if let Some(wheel) = WHEEL.get() {
        return Ok(wheel.clone());
    }
    let wheels = wheels();
    if wheels.exists() {
        fs::remove_dir_all(&wheels).context("old wheels")?;
    }
    let mut build = Command::new(environment()?);
    build.args(["-m", "maturin", "build", "--quiet", "--out"]).arg(&wheels);
    build.arg("--manifest-path").arg(manifest());
    workspace::with_lints(&mut build);
    done(&mut build, "the wheel does not build")?;
    let mut made = fs::read_dir(wheels).context("the folder of the wheel")?;
    let wheel = made.next().context("maturin made no wheel")??.path();
    let megabytes = fs::metadata(&wheel)?.len() as f64 / 1e6;
    println!("wheel: {megabytes:.1} MB");
    Ok(WHEEL.get_or_init(|| wheel).clone())
}

/// The setting by which MuJoCo draws nothing.
pub(crate) const WITHOUT_RENDERER: [(&str, &str); 1] = [("MUJOCO_GL", "disable")];

/// What tests of an environment use besides the package, by the variables that say where it is: the
/// program, and the plugin of the engine that the environment has.
fn built(python: &Path) -> Result<Vec<(&'static str, PathBuf)>> {
    let find = "import mujoco, pathlib; print(pathlib.Path(mujoco.__file__).parent)";
    let engine = c::output(Command::new(python).args(["-c", find]))?;
    // The library for C is built beside the program.
    let program = workspace::build_program()?;
    c::build("reference")?;
    let plugin = c::mujoco_plugin(Path::new(engine.trim()))?;
    let plugin = plugin.map(|it| ("GROUSER_MUJOCO_PLUGIN", it));
    Ok([("GROUSER_PROGRAM", program)].into_iter().chain(plugin).collect())
}

/// Runs pytest in the package's folder, shows what it says, and counts.
fn pytest(python: &Path, built: &[(&str, PathBuf)], arguments: &[&str]) -> Result<Count> {
    let mut command = Command::new(python);
    command.args(["-m", "pytest", "--quiet", "-rs", "-p", "no:cacheprovider"]).args(arguments);
    command.current_dir(workspace::root().join(PACKAGE)).envs(built.iter().cloned());
    if !RENDERER.is_here() {
        command.envs(WITHOUT_RENDERER);
    }
    let mut child = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn()?;
    let mut last = String::new();
    if let Some(stdout) = child.stdout.take() {
        for line in BufReader::new(stdout).lines() {
            last = line?;
            println!("{last}");
        }
    }
    Ok(count_of(&last, child.wait()?.success()))
}

/// The counts of pytest's last line, `1 failed, 59 passed in 12.3s`.
fn count_of(line: &str, succeeded: bool) -> Count {
    let before = |word: &str| -> u64 {
        let words = line.split([' ', ',']).filter(|part| !part.is_empty());
        let mut number = 0;
        for part in words {
            match part.parse() {
                Ok(found) => number = found,
                Err(_) if part.starts_with(word) => return number,
                Err(_) => {}
            }
        }
        0
    };
    let (passed, failed) = (before("passed"), before("failed") + before("error"));
    let skipped = before("skipped") + before("deselected");
    // A run that ended badly without a failed test counts as one failure, and so does one without
    // any tests.
    let silent = failed == 0 && (!succeeded || passed == 0);
    Count { passed, failed: failed + u64::from(silent), skipped }
}

fn types(python: &Path, arguments: &[&str]) -> Result<Count> {
    let mut command = Command::new(python);
    command.args(arguments).current_dir(workspace::root().join(PACKAGE)).stdin(Stdio::null());
    Ok(Count::one(command.status().context("mypy did not start")?.success()))
}

/// Runs a command at the root; an error if it fails.
pub(crate) fn done(command: &mut Command, otherwise: &str) -> Result<()> {
    command.current_dir(workspace::root()).stdin(Stdio::null());
    let status = command.status().with_context(|| otherwise.to_owned())?;
    ensure!(status.success(), "{otherwise}");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_line_of_pytest_is_counted() {
        let counts = |line, succeeded| {
            let Count { passed, failed, skipped } = count_of(line, succeeded);
            (passed, failed, skipped)
        };
        assert_eq!(counts("59 passed in 21.33s", true), (59, 0, 0));
        assert_eq!(counts("7 failed, 52 passed, 1 warning in 21.33s", false), (52, 7, 0));
        assert_eq!(counts("1 passed, 2 errors in 0.1s", false), (1, 2, 0));
        assert_eq!(counts("58 passed, 2 skipped, 3 deselected in 9s", true), (58, 0, 5));
        assert_eq!(counts("no tests ran in 0.01s", true), (0, 1, 0));
        assert_eq!(counts("Segmentation fault", false), (0, 1, 0));
    }
}
