//! Both commands of the README as somebody runs them who has nothing but a clone: in an empty
//! folder, with a home of its own and hardly any environment variables, so that nothing of this
//! checkout, of folders beside it or of its caches is found.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, ensure};

use crate::workspace;

/// The two commands.
const COMMANDS: [&[&str]; 2] = [&["run", "--release", "--", "reproduce"], &["xtask", "ci"]];

/// Clones what is committed and runs both commands there; whether both succeed. The folder is left
/// where one fails, and removed where none does.
///
/// * `options`: more words for `cargo xtask ci`
pub(crate) fn check(options: &[&str]) -> Result<bool> {
    let folder = std::env::temp_dir().join(format!("grouser-alone-{}", std::process::id()));
    let (clone, home) = (folder.join("grouser"), folder.join("home"));
    fs::create_dir_all(&home).with_context(|| format!("{}", home.display()))?;
    let status = Command::new("git")
        .args(["clone", "--quiet", "--no-hardlinks"])
        .args([&workspace::root(), &clone])
        .status()
        .context("`git` did not start")?;
    ensure!(status.success(), "what is committed cannot be cloned");
    let mut good = true;
    for arguments in COMMANDS {
        let more: &[&str] = if arguments[0] == "xtask" { options } else { &[] };
        println!("\n══ cargo {} ══", [arguments, more].concat().join(" "));
        let mut command = Command::new("cargo");
        command.args(arguments).args(more).current_dir(&clone).stdin(Stdio::null());
        command.env_clear().envs(environment(std::env::vars_os(), &home));
        good &= command.status().context("cargo did not start")?.success();
    }
    if good {
        fs::remove_dir_all(&folder).with_context(|| format!("{}", folder.display()))?;
    } else {
        println!("left as it is: {}", folder.display());
    }
    Ok(good)
}

/// What a fresh machine's shell would set, and what names the network's own way to packages: the
/// path to programs, the toolchain, and the settings of pip and cargo, which are files. Everything
/// else stays behind.
fn environment(
    ours: impl IntoIterator<Item = (OsString, OsString)>,
    home: &Path,
) -> Vec<(OsString, OsString)> {
    let mut kept: Vec<(OsString, OsString)> =
        ours.into_iter().filter(|(name, _)| is_kept(&name.to_string_lossy())).collect();
    let own = ["HOME", "USERPROFILE"].map(|name| (name.into(), home.into()));
    kept.extend(own);
    kept.push(("CARGO_HOME".into(), home.join(".cargo").into()));
    // Programs of the toolchain are found by rustup through its home, which is not ours to copy.
    let rustup = std::env::var_os("RUSTUP_HOME").map_or_else(rustup_beside_home, PathBuf::from);
    kept.push(("RUSTUP_HOME".into(), rustup.into()));
    kept
}

/// The default folder of rustup's toolchains.
fn rustup_beside_home() -> PathBuf {
    std::env::home_dir().unwrap_or_default().join(".rustup")
}

/// Whether a variable belongs to the machine and not to its user or to this project.
fn is_kept(name: &str) -> bool {
    let machine =
        ["PATH", "CI", "LANG", "SYSTEMROOT", "TMPDIR", "TEMP", "TMP", "COMSPEC", "PATHEXT"];
    let network = ["_PROXY", "_CERT", "CERT_FILE", "CERT_DIR", "CA_BUNDLE"];
    let name = name.to_uppercase();
    machine.contains(&name.as_str())
        || network.iter().any(|end| name.ends_with(end))
        || name.starts_with("PIP_") && name != "PIP_CACHE_DIR"
        || name.starts_with("CARGO_REGISTRIES_")
        || name.starts_with("CARGO_SOURCE_")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variables_of_the_project_and_of_python_stay_behind() {
        let ours =
            ["PATH", "GROUSER_PROGRAM", "PYTHONPATH", "CARGO_TARGET_DIR", "HOME", "RUSTFLAGS"];
        let ours = ours.map(|name| (name.into(), "x".into()));
        let kept = environment(ours, Path::new("h"));
        let names: Vec<_> = kept.iter().map(|(name, _)| name.to_string_lossy()).collect();
        assert_eq!(names, ["PATH", "HOME", "USERPROFILE", "CARGO_HOME", "RUSTUP_HOME"]);
        assert_eq!(kept[1].1, "h");
    }
}
