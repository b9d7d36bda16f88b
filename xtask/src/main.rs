//! Chores of the workspace that need logic: `cargo xtask` lists them.

mod ci;
mod cited;
mod diff;
mod figures;
mod fuzz;
mod hygiene;
mod instructions;
mod libtest;
mod links;
mod markdown;
mod markers;
mod measurements;
mod python;
mod rustdoc;
mod schema;
mod site;
mod texts;
mod workspace;

use std::process::ExitCode;

use anyhow::{Result, bail};

const USAGE: &str = "\
cargo xtask CHORE

  ci [--full]         everything that is checked; --full runs the slow tests too
  schema [--check]    write schema/*.json from the program, or only compare
  figures [--check]   write what the program makes inside the Markdown files, or only compare
  fuzz [--cases N] [--seed N] [--only N] [--program FILE]
                      damaged and hostile input for every command, under limits of memory and time
  instructions        count the instructions of the units of work anew (valgrind)
  python              build the Python package's wheel and test it in an environment of its own
  site                build the documentation site into target/site, and run its notebooks
  python-times        measure what Python costs, and write it into docs/performance.md
  texts               check the texts of the repository: links, hosts, paths, cited code
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &[&str]) -> Result<ExitCode> {
    let done = match arguments {
        [] | ["help" | "--help" | "-h"] => {
            print!("{USAGE}");
            true
        }
        ["ci"] => ci::run(ci::Extent::Usual),
        ["ci", "--full"] => ci::run(ci::Extent::Full),
        ["schema"] => schema::write()?,
        ["schema", "--check"] => schema::check()?,
        ["figures"] => figures::write()?,
        ["figures", "--check"] => figures::check()?,
        ["fuzz", options @ ..] => {
            let libtest::Count { passed, failed } = fuzz::check(fuzz::Plan::parse(options)?)?;
            println!("{passed} passed, {failed} failed");
            failed == 0
        }
        ["instructions"] => instructions::write()?,
        ["python"] => {
            let libtest::Count { passed, failed } = python::check()?;
            println!("{passed} passed, {failed} failed");
            failed == 0
        }
        ["site"] => site::build()?,
        ["python-times"] => {
            python::write_times()?;
            true
        }
        ["texts"] => texts::check()?,
        other => bail!("unknown chore `{}`\n\n{USAGE}", other.join(" ")),
    };
    Ok(if done { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
