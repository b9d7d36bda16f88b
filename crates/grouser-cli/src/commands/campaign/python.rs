//! Campaigns by the Python package: it has the executors that reach other processes and machines.

use std::env;
use std::process::{Command, Stdio};

use crate::args::{CampaignRunArgs, ExecutorChoice, TableOrJson};
use crate::failure::Failure;
use crate::interrupt;

/// Which Python has the package, if it is not the first one on the path.
const PYTHON: &str = "GROUSER_PYTHON";
/// The package's half of this command.
const MODULE: &str = "grouser.campaign";

/// Runs the campaign by the Python package, and returns its exit code.
pub(super) fn hand_over(args: &CampaignRunArgs) -> Result<(), Failure> {
    let python = env::var_os(PYTHON).unwrap_or_else(|| "python3".into());
    let word = name(args.executor);
    let probe = Command::new(&python)
        .args(["-c", &format!("import {MODULE}")])
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    if !probe.is_ok_and(|status| status.success()) {
        return Err(Failure::Run(format!(
            "--executor {word} needs the Python package grouser, and {} does not have it\n\
             hint: install it (docs/guide/python.md), name the Python that has it by the environment \
             variable {PYTHON}, or leave the flag out for the threads of this machine",
            python.display()
        )));
    }
    interrupt::handle_ctrl_c();
    let status = Command::new(&python).args(["-m", MODULE, "run"]).args(arguments(args)).status();
    let status = status.map_err(|source| Failure::Environment {
        what: format!("cannot start {}", python.display()),
        source,
    })?;
    match status.code() {
        Some(0) => Ok(()),
        // Exit codes of programs have eight bits; without one, a signal ended it.
        Some(code) => Err(Failure::ReportedByChild(u8::try_from(code).unwrap_or(1))),
        None => Err(Failure::Run(format!("{} ended: {status}", python.display()))),
    }
}

fn name(executor: ExecutorChoice) -> &'static str {
    match executor {
        ExecutorChoice::Threads => "threads",
        ExecutorChoice::Processes => "processes",
        ExecutorChoice::Dask => "dask",
        ExecutorChoice::Ray => "ray",
    }
}

/// The arguments of this command for the Python package.
fn arguments(args: &CampaignRunArgs) -> Vec<std::ffi::OsString> {
    let mut arguments = vec![args.study.clone().into(), "--out".into(), args.out.clone().into()];
    let mut flag = |name: &str, value: Option<String>| {
        if let Some(value) = value {
            arguments.extend([name.into(), value.into()]);
        }
    };
    flag("--executor", Some(name(args.executor).to_owned()));
    flag("--scheduler", args.scheduler.clone());
    flag("--workers", args.threads.map(|threads| threads.to_string()));
    flag("--shard", args.shard.map(|part| part.to_string()));
    for setting in &args.settings {
        flag("--set", Some(setting.clone()));
    }
    if args.format == TableOrJson::Json {
        flag("--format", Some("json".to_owned()));
    }
    arguments
}
