//! Chores of the workspace that need logic: `cargo xtask` lists them.

mod address;
mod alone;
mod c;
mod changed;
mod ci;
mod cited;
mod cores;
mod costs;
mod count;
mod cpu;
mod crates;
mod diff;
mod engine;
mod extent;
mod figures;
mod flaw;
mod fuzz;
mod hashes;
mod hygiene;
mod instructions;
mod learning;
mod libtest;
mod licence;
mod links;
mod markdown;
mod markers;
mod outputs;
mod packages;
mod pages;
mod processors;
mod python;
mod requirements;
mod rustdoc;
mod schema;
mod site;
mod texts;
mod times;
mod tools;
mod vendored;
mod wasm;
mod workflows;
mod workspace;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Result, bail};

const USAGE: &str = "\
cargo xtask CHORE

  ci [--full]         run all checks; --full runs the slow tests too
  alone [--full]      both commands of the README, in a clone that stands alone, with a home of its own
  c [--header]        compile, run and compare programs that use the C interface, by every compiler here;
                      --header writes its header instead
  schema [--check]    write schema/*.json from the program, or only compare
  figures [--check | --made]
                      write the program's output into the Markdown files, or only compare; --made leaves what
                      was measured as it is
  fuzz [--cases N] [--seed N] [--only N] [--program FILE]
                      damaged and hostile input for every command, under limits of memory and time
  fuzz --meaning      logs that mean something else, for `learn`; writes the table of docs/guide/telemetry.md
  fuzz readers [--cases N] [--seed N] [--only N]
                      damaged files for every reader, in one process
  hashes              compare digests of wheels, a traverse, a mission and a card by each instruction set and
                      interface, and by other processors where their tools are (minutes)
  instructions [--check]
                      count the instructions of the units of work anew (valgrind), or only compare
  packages [--full]   check the packages without publishing them; --full builds from them alone
  python [--lowest]   build the Python package's wheel and test it in an environment of its own;
                      --lowest with the lowest versions of all that it requires
  site [--as-it-is | --wasm]
                      build the documentation site into target/site, and run its notebooks; --as-it-is
                      with the Python package that is installed already, --wasm with the console, whose
                      engine is compiled as WebAssembly
  engine              compile the console's engine as WebAssembly into the site, and compare it with the
                      program, in node and in Chromium
  pages               look at the site of `cargo xtask site`, and at reports, in Chromium: at two widths,
                      light and dark
  console [--pictures]
                      use the console in Chromium, and compare it with the program; --pictures writes
                      one of each view into docs/pictures/console
  costs               count what wheels cost over the domain, and write the map into
                      docs/performance.md
  outputs FOLDER [PROGRAM]
                      what the program says to every example of the documents, into a folder
  outputs --compare FOLDER FOLDER
                      whether two such folders are the same but for the keys of xtask/renamed.txt
  learning [STUDY]    measure what learning from drives is worth, and write it into docs/guide/learn.md
  times               measure the units of work, and write their times into docs/performance.md
  python-times        measure what Python costs, and write it into docs/performance.md
  count [--check | --build]
                      count crates, lines and cycles of modules, and write them into ARCHITECTURE.md;
                      --check compares what repeats, --build measures a first build instead
  crates              check licences, features and advisories of the crates that we depend on
  wasm                check that grouser-core compiles for browsers (target wasm32-unknown-unknown)
  workflows           check the workflows of the code host
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
        ["ci"] => ci::run(extent::Extent::Usual),
        ["ci", "--full"] => ci::run(extent::Extent::Full),
        ["alone", options @ ..] => alone::check(options)?,
        ["c"] => good(c::check()?),
        ["c", "--header"] => good(c::write_header()?),
        ["schema"] => schema::write()?,
        ["schema", "--check"] => schema::check()?,
        ["figures"] => figures::write(true)?,
        ["figures", "--made"] => figures::write(false)?,
        ["figures", "--check"] => figures::check()?,
        ["fuzz", "--meaning"] => good(fuzz::meaning::write()?),
        ["fuzz", "readers", options @ ..] => {
            good(fuzz::readers::check(fuzz::readers::Plan::parse(options)?)?)
        }
        ["fuzz", options @ ..] => {
            let count = fuzz::check(&fuzz::Plan::parse(options)?)?;
            println!("{count}");
            count.failed == 0
        }
        ["hashes"] => good(hashes::check(extent::Extent::Full)?),
        ["instructions"] => instructions::write()?,
        ["instructions", "--check"] => good(instructions::check()?),
        ["count"] => count::write()?,
        ["count", "--check"] => good(count::check()?),
        ["count", "--build"] => count::write_build()?,
        ["crates"] => good(crates::check()?),
        ["packages"] => good(packages::check(extent::Extent::Usual)?),
        ["packages", "--full"] => good(packages::check(extent::Extent::Full)?),
        ["python"] => good(python::check(extent::Extent::Usual)?),
        ["pages"] => good(pages::check()?),
        ["console"] => good(pages::console(None)?),
        ["console", "--pictures"] => {
            good(pages::console(Some(&workspace::root().join("docs/pictures/console")))?)
        }
        ["python", "--lowest"] => good(python::check_lowest()?),
        ["site"] => good(site::build(&python::installed()?, false)?),
        ["site", "--wasm"] => good(site::build(&python::installed()?, true)?),
        ["site", "--as-it-is"] => good(site::build(&python::as_it_is(), false)?),
        ["engine"] => good(engine::check()?),
        ["outputs", "--compare", before, after] => {
            outputs::compare(Path::new(before), Path::new(after))?
        }
        ["outputs", folder, program @ ..] => {
            outputs::write(Path::new(folder), program.first().map(PathBuf::from))?;
            true
        }
        ["costs"] => {
            costs::write()?;
            true
        }
        ["learning"] => {
            learning::write(None)?;
            true
        }
        ["learning", study] => {
            learning::write(Some(study))?;
            true
        }
        ["python-times"] => {
            python::write_times()?;
            true
        }
        ["times"] => {
            times::write()?;
            true
        }
        ["wasm"] => good(wasm::check()?),
        ["workflows"] => workflows::check()?,
        ["texts"] => texts::check()?,
        other => bail!("unknown chore `{}`\n\n{USAGE}", other.join(" ")),
    };
    Ok(if done { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Whether nothing failed; prints the counts.
fn good(count: libtest::Count) -> bool {
    println!("{count}");
    count.failed == 0
}
