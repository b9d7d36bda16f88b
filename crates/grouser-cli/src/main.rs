//! The program `grouser`: a command-line interface to the library.
//!
//! It computes no physics. [`args`] has the arguments, [`commands`] the commands, [`output`] prints
//! and writes results, [`report`] makes the page of `reproduce`.

mod args;
mod commands;
mod failure;
mod hints;
mod inputs;
mod interrupt;
mod list;
mod output;
mod report;

use std::process::ExitCode;

use clap::{CommandFactory as _, FromArgMatches as _};

use args::{Cli, Command, TerminalArgs};
use failure::Failure;
use output::terminal::Settings;

fn main() -> ExitCode {
    interrupt::exit_on_ctrl_c();
    interrupt::fail_at_file_size_limit();
    let done = match args::grouped(Cli::command()).try_get_matches() {
        Ok(matches) => parsed(&matches),
        Err(answer) => {
            output::terminal::set_colours(args::colours_of(std::env::args_os()));
            let (command, arguments) = (Cli::command(), std::env::args_os().skip(1));
            output::print_answer(&hints::with_present_option(answer, &command, arguments))
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            output::report(&failure);
            ExitCode::from(failure.code())
        }
    }
}

fn parsed(matches: &clap::ArgMatches) -> Result<(), Failure> {
    let cli = match Cli::from_arg_matches(matches) {
        Ok(cli) => cli,
        Err(answer) => return output::print_answer(&answer),
    };
    let TerminalArgs { color, quiet, width } = cli.terminal;
    output::terminal::set(Settings { is_quiet: quiet, width }, color);
    output::activity::start(matches.subcommand_name().unwrap_or_default());
    run(&cli.command)
}

fn run(command: &Command) -> Result<(), Failure> {
    match command {
        Command::Reproduce(args) => commands::reproduce::run(args),
        Command::Serve(args) => commands::serve::run(args),
        Command::Traverse(args) => commands::traverse::run(args),
        Command::Mission(args) => commands::mission::run(args),
        Command::WheelTest(args) => commands::wheel_test::run(args),
        Command::Heading(args) => commands::heading::run("heading", args),
        Command::HeadingMap(args) => commands::heading_map::run("heading-map", args),
        Command::Map(args) => commands::map::run(args),
        Command::Route(args) => commands::route::run(args),
        Command::Terrain(args) => commands::make_terrain::run(args),
        Command::Attitude(args) => commands::heading::run("attitude", args),
        Command::AttitudeMap(args) => commands::heading_map::run("attitude-map", args),
        Command::Card(args) => commands::card::run(args),
        Command::Forecast(args) => commands::forecast::run(args),
        Command::SlipFromCurrent(args) => commands::slip_from_current::run(args),
        Command::Learn(args) => commands::learn::run(args),
        Command::Replay(args) => commands::replay::run(args),
        Command::Validate(args) => commands::validate::run(args),
        Command::Calibrate(args) => commands::calibrate::run(args),
        Command::Design(args) => commands::design::run(args),
        Command::Campaign(args) => commands::campaign::run(args),
        Command::Draw(args) => commands::draw::run(args),
        Command::Import(args) => commands::import::run(args),
        Command::ImportTelemetry(args) => commands::import_telemetry::run(args),
        Command::ImportUrdf(args) => commands::import_urdf::run(args),
        Command::ExportFmu(args) => commands::export_fmu::run(args),
        Command::New(args) => commands::new::run(args),
        Command::Check(args) => commands::check::run(args),
        Command::Presets(args) => commands::presets::run(args),
        Command::Schema(args) => commands::schema::run(args),
        Command::Completions(args) => commands::completions::run(args),
        Command::Man(args) => commands::man::run(args),
    }
}
