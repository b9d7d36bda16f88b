//! `grouser validate --all`: every theory on every data set that is there, best first.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use grouser::contact::Theory;
use grouser::document::measurements::{self, Choice};
use grouser::document::validation::GroupRecord;
use grouser::document::{self, DataSetCase, Kind, LoadedDataSet, Overrides, Source};
use grouser::soil::Extended;
use grouser::studies::measurement::Quantity;
use grouser::studies::validation::{Validation, ValidationStudy};
use serde::Serialize;
use serde_json::json;

use super::super::Answer;
use super::figures;
use crate::args::ValidateArgs;
use crate::failure::Failure;
use crate::output::folder::OutputFolder;
use crate::output::rows::{aligned, csv_of_nested};
use crate::output::{self, Format};

/// Where measurements are, if no flag says it.
const VARIABLE: &str = "GROUSER_DATA_DIR";

/// A theory with a soil on a part of a data set.
#[derive(Serialize)]
struct Entry {
    data_set: String,
    case: String,
    rank: usize,
    model: &'static str,
    soil: String,
    /// Root mean square error over the standard deviation of what was measured, averaged over
    /// the measured quantities [-]: 0 is perfect, 1 no better than a constant.
    score: Option<f64>,
    unsettled_trials: usize,
    driven: Option<GroupRecord>,
    overall: GroupRecord,
    #[serde(skip)]
    validation: Validation,
}

#[derive(Serialize)]
struct Results<'a> {
    rows: &'a [Entry],
}

pub(super) fn run(args: &ValidateArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let place = data_folder(args)?;
    let mut entries = Vec::new();
    for (set, file) in data_sets(&place)? {
        for case in &set.value {
            entries.extend(rank(&set, case, &file)?);
        }
    }
    let inputs = json!({ "data_sets": entries.iter().map(|it| &it.data_set).collect::<std::collections::BTreeSet<_>>() });
    let answer = Answer::new("validate", inputs, Results { rows: &entries });
    let text = text_of(&entries);
    if let Some(mut folder) = folder {
        folder.add("ranking.json", answer.to_text());
        folder.add("ranking.csv", csv_of_nested(&entries)?);
        folder.add("ranking.txt", text.clone());
        for best in entries.iter().filter(|entry| entry.rank == 1) {
            let part = slug(&format!("{} {}", best.data_set, best.case));
            for figure in figures::all(&best.validation) {
                folder.add(&format!("figures/{part}-{}.svg", figure.file), figure.chart.to_svg());
            }
        }
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::print(&text),
        Format::Csv => output::print(&csv_of_nested(&entries)?),
        Format::Json => output::print_json(&answer),
    }
}

/// A name as part of a file's name.
fn slug(name: &str) -> String {
    let words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("-")
}

fn data_folder(args: &ValidateArgs) -> Result<PathBuf, Failure> {
    let place = args.data_dir.clone().or_else(|| std::env::var_os(VARIABLE).map(PathBuf::from));
    let place = place.ok_or_else(|| {
        Failure::Usage(format!(
            "--all needs a folder of measurements: --data-dir DIR, or the environment variable \
             {VARIABLE}\nhint: docs/guide/data.md tells where public data sets are"
        ))
    })?;
    if place.is_dir() {
        Ok(place)
    } else {
        Err(Failure::Usage(format!("{}: there is no such folder", place.display())))
    }
}

/// The data sets whose files are in a folder: those that are presets, and those that documents in
/// the folder describe.
fn data_sets(place: &Path) -> Result<Vec<(LoadedDataSet, PathBuf)>, Failure> {
    let mut sources: Vec<Source> = document::presets(Kind::DataSet).map(Source::Preset).collect();
    let entries = std::fs::read_dir(place).map_err(Failure::at("cannot look into", place))?;
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<_, _>>()
        .map_err(Failure::at("cannot look into", place))?;
    files.sort();
    let documents = files.into_iter().filter(|path| path.extension() == Some(OsStr::new("toml")));
    let is_data_set =
        |path: &PathBuf| matches!(document::check(&Source::file(path)), Ok(Kind::DataSet) | Err(_));
    sources.extend(documents.filter(is_data_set).map(Source::File));
    let mut sets = Vec::new();
    for source in sources {
        let set = document::read_data_set(&source, &Overrides::none())?;
        let file = place.join(&set.document.file);
        if file.exists() {
            sets.push((set, file));
        } else if let Source::File(path) = source {
            let (path, file) = (path.display(), file.display());
            return Err(Failure::Usage(format!("{path} names a file that is not there: {file}")));
        }
    }
    if sets.is_empty() {
        let known = document::presets(Kind::DataSet).map(|preset| preset.name);
        return Err(Failure::Usage(format!(
            "no known data set in {} (known: {})\nhint: docs/guide/data.md tells how to lay them \
             out; `grouser validate --data FILE` judges any other file",
            place.display(),
            known.collect::<Vec<_>>().join(", ")
        )));
    }
    Ok(sets)
}

/// Every theory with the soils of a case, best first.
fn rank(set: &LoadedDataSet, case: &DataSetCase, file: &Path) -> Result<Vec<Entry>, Failure> {
    let choice = Choice { conditions: case.conditions.clone(), wheel: None };
    let measured = measurements::read(file, &choice)?;
    let mut entries = Vec::new();
    for (name, soil) in &case.soils {
        for theory in Theory::ALL {
            let for_another = soil.document.theory().is_some_and(|own| own != theory);
            // Without its terms the extended theory is the classical one.
            let same = theory == Theory::Extended && soil.value.extended == Extended::OFF;
            if for_another || same {
                continue;
            }
            let study = ValidationStudy {
                tests: &measured.tests,
                wheel: case.wheel.value,
                soil: soil.value,
                theory,
                gravity: set.document.gravity_m_s2,
            };
            let validation = study.run();
            entries.push(Entry {
                data_set: set.document.name.clone(),
                case: case.name.clone(),
                rank: 0,
                model: theory.name(),
                soil: name.clone(),
                score: score(&validation),
                unsettled_trials: validation.overall.unsettled,
                driven: validation.driven.as_ref().map(GroupRecord::from),
                overall: GroupRecord::from(&validation.overall),
                validation,
            });
        }
    }
    // What has no prediction for a trial ranks below whatever has one for each.
    let key = |entry: &Entry| (entry.unsettled_trials, entry.score.unwrap_or(f64::INFINITY));
    entries.sort_by(|one, other| {
        let ((unsettled, score), (others, other_score)) = (key(one), key(other));
        unsettled.cmp(&others).then(score.total_cmp(&other_score))
    });
    for (place, entry) in entries.iter_mut().enumerate() {
        entry.rank = place + 1;
    }
    Ok(entries)
}

/// √(1 − R²), averaged over the measured quantities.
fn score(validation: &Validation) -> Option<f64> {
    let of = |quantity| validation.overall.errors[quantity]?.r2;
    let shares: Vec<f64> =
        Quantity::ALL.into_iter().filter_map(of).map(|r2| (1.0 - r2).max(0.0).sqrt()).collect();
    (!shares.is_empty()).then(|| shares.iter().sum::<f64>() / shares.len() as f64)
}

/// For people: a block for each part of each data set.
fn text_of(entries: &[Entry]) -> String {
    let mut blocks = vec![
        "Root mean square errors over cells: drawbar pull [N] / side force [N] / sinkage [mm]\n\
         score: 0 is perfect, 1 no better than the mean of what was measured\n"
            .to_owned(),
    ];
    for part in
        entries.chunk_by(|one, other| (&one.data_set, &one.case) == (&other.data_set, &other.case))
    {
        let header = ["rank", "model", "soil", "driven", "all", "score", "no prediction"];
        let rows: Vec<Vec<String>> = part.iter().map(row).collect();
        let table = aligned(&header.map(str::to_owned), &rows);
        let [first, ..] = part else { continue };
        let repeatability = errors(&first.overall, |it| it.repeatability)
            .map_or(String::new(), |it| format!("between repeated trials, all cells: {it}\n"));
        blocks.push(format!("{}, {}\n{table}{repeatability}", first.data_set, first.case));
    }
    blocks.join("\n")
}

fn row(entry: &Entry) -> Vec<String> {
    let rmse = |group: &GroupRecord| errors(group, |it| Some(it.rmse));
    vec![
        entry.rank.to_string(),
        entry.model.to_owned(),
        entry.soil.clone(),
        entry.driven.as_ref().and_then(rmse).unwrap_or_else(|| "-".to_owned()),
        rmse(&entry.overall).unwrap_or_else(|| "-".to_owned()),
        entry.score.map_or("-".to_owned(), |score| format!("{score:.2}")),
        entry.unsettled_trials.to_string(),
    ]
}

/// Three numbers as one cell; torque is named where it was measured.
fn errors(
    group: &GroupRecord,
    of: fn(&document::validation::ErrorsRecord) -> Option<f64>,
) -> Option<String> {
    let number = |quantity| {
        let value = group.errors(quantity).and_then(of);
        value.map_or("-".to_owned(), |value| format!("{value:.2}"))
    };
    let three = [Quantity::DrawbarPull, Quantity::SideForce, Quantity::Sinkage].map(number);
    three.iter().any(|cell| cell != "-").then(|| three.join(" / "))
}
