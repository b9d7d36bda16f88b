//! What a branch changes, so that checks which look at other things can wait.

use std::process::Command;

use crate::workspace;

/// Where branches leave from, the nearest name first.
const MAIN: [&str; 2] = ["origin/main", "main"];

/// The files, as paths from the root, that differ from where the branch left `main`, with those
/// that are new. Nothing where there is no such place, or where nothing differs: then all is to be
/// checked.
pub(crate) fn files() -> Option<Vec<String>> {
    let base = MAIN.iter().find_map(|main| git(&["merge-base", "HEAD", main]))?;
    let differing = git(&["diff", "--name-only", base.trim()])?;
    let new = git(&["ls-files", "--others", "--exclude-standard"])?;
    let files: Vec<String> = differing.lines().chain(new.lines()).map(String::from).collect();
    (!files.is_empty()).then_some(files)
}

/// What git prints at the root, where it succeeds.
fn git(arguments: &[&str]) -> Option<String> {
    let output =
        Command::new("git").args(arguments).current_dir(workspace::root()).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned())
}
