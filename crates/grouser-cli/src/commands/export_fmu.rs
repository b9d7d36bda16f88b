//! `grouser export-fmu`: a scenario or a mission as an FMU.

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::fs;
use std::path::{Path, PathBuf};

use grouser::document::{self, Kind, Overrides, Source, escape, preset};
use grouser_fmi::contents::{self, Contents, File};
use grouser_fmi::drive::Drive;
use grouser_fmi::variables::Variable;

use crate::args::{BalanceArgs, DrivenBy, ExportFmuArgs};
use crate::failure::Failure;
use crate::inputs;
use crate::output::rows::aligned;
use crate::output::text::Text;
use crate::output::{self, file, zip};

pub(crate) fn run(args: &ExportFmuArgs) -> Result<(), Failure> {
    let Some(out) = &args.out else {
        return output::show(table(&contents(args)?.model.variables));
    };
    if out.extension().is_none_or(|end| !end.eq_ignore_ascii_case("fmu")) {
        let out = escape::path(out);
        return Err(Failure::Usage(format!("--out {out}: the name of an FMU must end with .fmu")));
    }
    file::check_new(out, args.force)?;
    let mut files = contents(args)?.files;
    files.push(library(args)?);
    files.sort();
    let archive = zip::archive(&files).ok_or_else(|| {
        let text = "its files have more than 4 GB, which an FMU cannot have";
        Failure::Run(format!("cannot write {}: {text}", escape::path(out)))
    })?;
    file::write_result(out, &archive)
}

/// The variables as a table; those that every wheel has once.
fn table(variables: &[Variable]) -> Text {
    let header = ["variable", "unit", "is", "what"].map(str::to_owned);
    let one = variables.iter().filter(|it| it.wheel().is_none_or(|wheel| wheel == 0));
    let row = |variable: &Variable| {
        let name = match variable.name.rsplit_once('.').filter(|_| variable.wheel().is_some()) {
            Some((_, name)) => format!("WHEEL.{name}"),
            None => variable.name.clone(),
        };
        let (unit, is) = (variable.unit.symbol.to_owned(), variable.causality().to_owned());
        vec![name, unit, is, variable.sentence.clone()]
    };
    aligned(&header, &one.map(row).collect::<Vec<_>>())
}

/// What the FMU has, all but the library.
fn contents(args: &ExportFmuArgs) -> Result<Contents, Failure> {
    let name = &*args.document;
    let kinds = [Kind::Scenario, Kind::Mission];
    let (kind, source) = if let Some(found) = kinds.iter().find_map(|kind| preset(*kind, name)) {
        (found.kind, Source::Preset(found))
    } else {
        let source = Source::find(Kind::Scenario, name)?;
        (document::kind_of_source(&source)?, source)
    };
    let mut overrides = Overrides::parse_flags("--set", &args.setting.settings)?;
    let balance = BalanceArgs { load_transfer: None, wheel_moments: None };
    let driven_by = |usual| Drive::from(args.driven_by.unwrap_or(usual));
    let made = match kind {
        Kind::Scenario => {
            inputs::scenario_settings(&mut overrides, kind, &args.setting, &balance)?;
            overrides.check_kinds(&[kind, Kind::Rover, Kind::Soil, Kind::Wheel])?;
            let loaded = document::read_scenario(&source, &overrides)?;
            output::notes(loaded.notes.iter().map(|note| escape::line(note)));
            note_nominal(loaded.stated_uncertainty().is_some());
            contents::of_scenario(&loaded, driven_by(DrivenBy::Inputs))
        }
        Kind::Mission => {
            inputs::scenario_settings(&mut overrides, kind, &args.setting, &balance)?;
            overrides.check_kinds(&[kind, Kind::Rover, Kind::Soil, Kind::Wheel])?;
            let loaded = document::read_mission(&source, &overrides)?;
            output::notes(loaded.notes.iter().map(|note| escape::line(note)));
            note_nominal(loaded.stated_uncertainty().is_some());
            contents::of_mission(&loaded, driven_by(DrivenBy::Document))
        }
        other => {
            return Err(Failure::Usage(format!(
                "{} is a {other}: an FMU is made of a scenario or a mission",
                escape::line(name)
            )));
        }
    };
    made.map_err(|text| Failure::Usage(escape::line(&text).into_owned()))
}

/// Says of a soil that is not known exactly which of its samples an FMU has.
fn note_nominal(is_uncertain: bool) {
    if is_uncertain {
        let note = "the FMU has the nominal soil of an uncertain one; samples of it are parameters \
                    for the tool to set";
        output::notes([note.to_owned()]);
    }
}

/// The library, at its place in an FMU.
fn library(args: &ExportFmuArgs) -> Result<File, Failure> {
    let place = contents::library_path().ok_or_else(|| {
        Failure::Run("FMI has no name for the system that this program runs on".to_owned())
    })?;
    let path = match &args.library {
        Some(path) => path.clone(),
        None => beside_the_program()?,
    };
    let content = fs::read(&path).map_err(Failure::at("cannot read", &path))?;
    Ok((place, content))
}

fn beside_the_program() -> Result<PathBuf, Failure> {
    let program =
        std::env::current_exe().map_err(Failure::at("cannot find", Path::new("grouser")))?;
    let name = format!("{DLL_PREFIX}grouser_fmi{DLL_SUFFIX}");
    // Cargo leaves the library of a program in `deps` beside it.
    let places = [program.with_file_name(&name), program.with_file_name("deps").join(&name)];
    if let Some(path) = places.into_iter().find(|path| path.is_file()) {
        return Ok(path);
    }
    Err(Failure::Run(format!(
        "{name}, the library that FMUs carry, is not beside the program: `cargo build --release -p \
         grouser-fmi` builds it into target/release, and --library names it"
    )))
}
