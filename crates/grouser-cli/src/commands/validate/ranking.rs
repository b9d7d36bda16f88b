//! `grouser validate --all`, or on one data set: ranks every model on every part, beside
//! predictions without physics.

use grouser_draw::chart::Drawable;
use std::collections::BTreeSet;
use std::path::Path;

use grouser::document::columns::{COURSE, Quantity, SLIP_RATIO, SLOPE, YAW, slope};
use grouser::document::ranking::{
    Found, OverAll, RankedModel, RankedYardstick, Ranking, RankingError, SetRecord, rank_all,
    rank_one,
};
use grouser::document::reading::four_digits;
use grouser::document::table::Table;
use grouser::document::validation::{ErrorsRecord, PartErrors};
use grouser::document::{Kind, Source, measurements};
use serde::Serialize;
use serde_json::{Map, Value, json};

use super::super::Answer;
use super::figures;
use crate::args::ValidateArgs;
use crate::failure::Failure;
use crate::output::folder::OutputFolder;
use crate::output::rows::{aligned, csv, csv_of_nested};
use crate::output::text::Text;
use crate::output::{self, Format};
use crate::report::REPORT;
use crate::report::page::Page;

#[derive(Serialize)]
struct Results<'a> {
    #[serde(flatten)]
    ranking: &'a Ranking,
    /// Each slope of every rover, measured and predicted.
    slopes: &'a [Map<String, Value>],
}

/// On the data sets of the program, or of a folder.
pub(super) fn of_all(args: &ValidateArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    write(args, folder, &rank_all(args.data_dir.as_deref(), args.read.limits())?)
}

/// On one data set: a preset, or a document.
pub(super) fn of_one(args: &ValidateArgs, data: &Path) -> Result<(), Failure> {
    const BOTH: &str = "one model is judged with --soil and either --wheel or --rover; a data set \
                        by its name, or its document (FILE.toml), alone ranks all models";
    let folder = OutputFolder::for_args(&args.output)?;
    let of_one_model = [
        ("--soil", args.soil.is_some()),
        ("--where", !args.conditions.is_empty()),
        ("--set", !args.setting.settings.is_empty()),
        ("--model", args.setting.model.is_some()),
        ("--gravity-m-s2", args.setting.gravity.is_some()),
    ];
    if let Some((flag, _)) = of_one_model.into_iter().find(|(_, is_given)| *is_given) {
        return Err(Failure::Usage(format!("{flag}: {BOTH}")));
    }
    let is_document = data.extension().is_some_and(|extension| extension == "toml");
    // A misspelt name is answered with the right one.
    let rows = measurements::Source::find(data)?;
    let is_preset = matches!(rows, measurements::Source::Preset { .. });
    if !is_document && !is_preset {
        // What is not there is no matter of flags.
        rows.bytes(args.read.limits())?;
        return Err(Failure::Usage(format!("--data {}: {BOTH}", data.display())));
    }
    let source = Source::find(Kind::DataSet, &data.to_string_lossy())?;
    write(args, folder, &rank_one(&source, args.read.limits())?)
}

fn write(
    args: &ValidateArgs,
    folder: Option<OutputFolder>,
    ranking: &Ranking,
) -> Result<(), Failure> {
    let names: BTreeSet<&String> = ranking.rows.iter().map(|row| &row.data_set).collect();
    let inputs = json!({ "data_sets": names });
    let slopes = slopes(ranking);
    let answer = Answer::new("validate", inputs, Results { ranking, slopes: &slopes });
    let text = text_of(ranking);
    let rows = csv_of_rows(ranking)?;
    if let Some(mut folder) = folder {
        folder.add("ranking.json", answer.to_text());
        folder.add("ranking.csv", rows.clone());
        folder.add("ranking.txt", text.to_string());
        if let Some(first) = slopes.first() {
            let columns: Vec<String> = first.keys().cloned().collect();
            folder.add("slopes.csv", csv(&columns, slopes.iter())?);
        }
        let mut page = Page::new("Models ranked on measured tests");
        page.code(&text.to_string());
        page.heading("The best model of each part");
        for best in ranking.rows.iter().filter(|entry| entry.rank == 1) {
            let part = slug(&format!("{} {}", best.data_set, best.case));
            let figures = match &best.found {
                Found::Wheel(validation) => figures::all(validation),
                Found::Slope(validation) => figures::of_slopes(validation),
            };
            for figure in figures {
                let svg = figure.chart.to_svg();
                let what = format!("{}, {}: {}", best.data_set, best.case, figure.caption);
                page.drawing(&svg, &what);
                folder.add(format!("figures/{part}-{}.svg", figure.file), svg);
            }
        }
        folder.add(REPORT, page.to_html());
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::show(text),
        Format::Csv => output::print(&rows),
        Format::Json => output::print_json(&answer),
    }
}

/// Models, then yardsticks, as CSV.
fn csv_of_rows(ranking: &Ranking) -> Result<String, Failure> {
    #[derive(Serialize)]
    #[serde(untagged)]
    enum Row<'a> {
        Model(&'a RankedModel),
        Yardstick(&'a RankedYardstick),
    }
    let models = ranking.rows.iter().map(Row::Model);
    let all = models.chain(ranking.yardsticks.iter().map(Row::Yardstick));
    csv_of_nested(&all.collect::<Vec<_>>())
}

/// Every slope of every ranked model of a rover.
fn slopes(ranking: &Ranking) -> Vec<Map<String, Value>> {
    let of_row = |row: &RankedModel| {
        let Found::Slope(validation) = &row.found else { return Vec::new() };
        let table = slope::slopes(&validation.points);
        let of_slope = |place: usize| {
            let place = serde_json::to_value(table.row(place)).unwrap_or_default();
            let mut all = Map::new();
            for (key, text) in [
                ("data_set", row.data_set.as_str()),
                ("case", &row.case),
                ("model", row.model),
                ("soil", &row.soil),
            ] {
                all.insert(key.to_owned(), text.into());
            }
            all.extend(place.as_object().cloned().unwrap_or_default());
            all
        };
        (0..table.rows()).map(of_slope).collect()
    };
    ranking.rows.iter().flat_map(of_row).collect()
}

/// A name as part of a file's name.
fn slug(name: &str) -> String {
    let words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("-")
}

impl From<RankingError> for Failure {
    fn from(error: RankingError) -> Self {
        match error {
            RankingError::Document(error) => error.into(),
            RankingError::Measurements(error) => error.into(),
            RankingError::Rover(error) => error.into(),
            RankingError::Unreadable { folder, error } => {
                Self::at("cannot look into", &folder)(error)
            }
            RankingError::NoDataSet { .. } => Self::Usage(format!(
                "{error}\nhint: docs/guide/data.md explains how a document describes a data set; without \
                 --data-dir those that come with the program are ranked"
            )),
            RankingError::NoSuchFolder(_) | RankingError::NoSuchFile { .. } => {
                Self::Usage(error.to_string())
            }
        }
    }
}

// ---- For people ----

const LEGEND: &str = "\
Errors of each quantity: root mean square / mean (prediction minus measurement) / root mean square over the largest
measured value, and whether that is within the aim.
score: 0 is perfect, 1 no better than the mean of what was measured. Rows without a rank have no physics in them.
";

/// A block for each part of each data set, and one for all together.
fn text_of(ranking: &Ranking) -> Text {
    let mut blocks = vec![Text::from(LEGEND)];
    let is_same = |one: &RankedModel, other: &RankedModel| {
        (&one.data_set, &one.case) == (&other.data_set, &other.case)
    };
    for part in ranking.rows.chunk_by(is_same) {
        let [first, ..] = part else { continue };
        let yardsticks: Vec<&RankedYardstick> = ranking
            .yardsticks
            .iter()
            .filter(|it| (&it.data_set, &it.case) == (&first.data_set, &first.case))
            .collect();
        let title = format!("{}, {}\n", first.data_set, first.case);
        let mut block = Text::from(title) + all_cells(part, &yardsticks);
        let has_skid = first.driven.as_ref().is_some_and(|driven| {
            matches!(&first.overall, PartErrors::Wheel(all) if all.0.cells > driven.0.cells)
        });
        if has_skid {
            block = block + "driven cells alone\n" + driven_cells(part, &yardsticks);
        }
        block = block + repeatability(&first.overall);
        blocks.push(
            [SLIP_RATIO, YAW]
                .into_iter()
                .fold(block, |block, quantity| block + over_slopes(part, quantity)),
        );
    }
    if ranking.models.first().is_some_and(|first| first.scores.len() > 1) {
        blocks.push(all_parts(&ranking.models));
    }
    blocks.push(together(&ranking.sets));
    Text::blocks(blocks)
}

/// The band of all models on each part.
fn together(sets: &[SetRecord]) -> Text {
    let header = ["set", "answers", "numbers", "rmse", "worst", "held", "width", "interval score"];
    let rows = sets.iter().flat_map(|set| {
        set.answers.iter().map(move |it| {
            let numbers = [it.rmse, it.worst, it.held, it.width, it.interval_score];
            let own = if set.in_sample { " (in sample)" } else { "" };
            let names = [format!("{}, {}{own}", set.data_set, set.case), it.kind.to_owned()];
            let numbers = numbers.into_iter().map(|it| format!("{it:.3}"));
            names.into_iter().chain([it.numbers.to_string()]).chain(numbers).collect::<Vec<_>>()
        })
    });
    let title = "All models together, by weights found without the set: the median's errors and the 95 % band. \
                 Forces over the\nload, sinkage over the shearing radius, slip without a unit, yaw in degrees.\n";
    Text::from(title)
        + aligned(&header.map(str::to_owned), &rows.collect::<Vec<_>>())
        + zero_pulls(sets)
}

/// The slips at which the pull vanishes.
fn zero_pulls(sets: &[SetRecord]) -> Text {
    let number = |it: Option<f64>| it.map_or_else(|| "-".to_owned(), |it| format!("{it:.3}"));
    let rows = sets.iter().filter(|it| it.zero_pull_slip_predicted.is_some()).map(|set| {
        let doubt = if set.zero_pull_is_doubtful { "a radius or a zero may be off" } else { "" };
        vec![
            format!("{}, {}", set.data_set, set.case),
            number(set.zero_pull_slip_measured),
            number(set.zero_pull_slip_predicted),
            doubt.to_owned(),
        ]
    });
    let rows: Vec<Vec<String>> = rows.collect();
    let header = ["slip without pull", "measured", "predicted", ""].map(str::to_owned);
    if rows.is_empty() { Text::from("") } else { Text::from("\n") + aligned(&header, &rows) }
}

/// Columns of the errors of a part.
fn header(quantities: &[Quantity]) -> Vec<String> {
    let names = ["rank", "model", "soil", "score", "no prediction"].map(str::to_owned);
    names.into_iter().chain(quantities.iter().map(|it| it.name.to_owned())).collect()
}

fn all_cells(part: &[RankedModel], yardsticks: &[&RankedYardstick]) -> Text {
    let measured = measured_in(yardsticks.iter().map(|it| it.reference.overall.measured()));
    let models = part.iter().map(|row| {
        let errors = row.overall.measured();
        line(named(row), row.score, row.unsettled_trials.to_string(), &errors, &measured)
    });
    let references = yardsticks.iter().map(|row| {
        let names = ["-", row.reference.yardstick, "-"].map(str::to_owned);
        let errors = row.reference.overall.measured();
        line(names, row.score, "-".to_owned(), &errors, &measured)
    });
    aligned(&header(&measured), &models.chain(references).collect::<Vec<_>>())
}

fn driven_cells(part: &[RankedModel], yardsticks: &[&RankedYardstick]) -> Text {
    let errors = |driven: &Option<_>| {
        driven
            .as_ref()
            .map_or(Vec::new(), |group| PartErrors::Wheel(Clone::clone(group)).measured())
    };
    let measured = measured_in(yardsticks.iter().map(|it| errors(&it.reference.driven)));
    let models = part.iter().map(|row| {
        let group = row.driven.as_ref();
        let unsettled = group.map_or("-".to_owned(), |group| group.0.unsettled.to_string());
        let score = group.and_then(|group| group.0.score());
        line(named(row), score, unsettled, &errors(&row.driven), &measured)
    });
    let references = yardsticks.iter().map(|row| {
        let names = ["-", row.reference.yardstick, "-"].map(str::to_owned);
        let score = row.reference.driven.as_ref().and_then(|group| group.0.score());
        line(names, score, "-".to_owned(), &errors(&row.reference.driven), &measured)
    });
    aligned(&header(&measured), &models.chain(references).collect::<Vec<_>>())
}

/// The quantities that any of some errors has, in their order.
fn measured_in(all: impl Iterator<Item = Vec<(Quantity, ErrorsRecord)>>) -> Vec<Quantity> {
    let mut found = Vec::new();
    for (quantity, _) in all.flatten() {
        if !found.contains(&quantity) {
            found.push(quantity);
        }
    }
    found
}

fn named(row: &RankedModel) -> [String; 3] {
    let fitted = if row.in_sample { " (fitted to these)" } else { "" };
    [row.rank.to_string(), row.model.to_owned(), format!("{}{fitted}", row.soil)]
}

fn line(
    names: [String; 3],
    score: Option<f64>,
    no_prediction: String,
    errors: &[(Quantity, ErrorsRecord)],
    measured: &[Quantity],
) -> Vec<String> {
    let errors = measured.iter().map(|quantity| {
        let found = errors.iter().find(|(known, _)| known == quantity);
        found.map_or("-".to_owned(), |(_, errors)| in_brief(errors))
    });
    names.into_iter().chain([in_two_digits(score), no_prediction]).chain(errors).collect()
}

/// `4.21 / +1.30 / 28 % within`.
fn in_brief(errors: &ErrorsRecord) -> String {
    let ErrorsRecord { rmse, bias, rmse_share, within_aim, .. } = errors;
    let share = rmse_share.map_or(String::new(), |share| format!(" / {:.0} %", share * 100.0));
    let aim = within_aim.map_or("", |is_met| if is_met { " within" } else { " miss" });
    // What rounds to zero has no sign.
    let bias = (bias * 100.0).round() / 100.0 + 0.0;
    format!("{rmse:.2} / {bias:+.2}{share}{aim}")
}

fn in_two_digits(score: Option<f64>) -> String {
    score.map_or("-".to_owned(), |score| format!("{score:.2}"))
}

/// The scatter of the experiment, where it was repeated.
fn repeatability(overall: &PartErrors) -> String {
    let of = |(quantity, errors): (Quantity, ErrorsRecord)| {
        Some(format!("{} {:.2}", quantity.name, errors.repeatability?))
    };
    let found: Vec<String> = overall.measured().into_iter().filter_map(of).collect();
    if found.is_empty() {
        return String::new();
    }
    format!("between repeated trials, all cells: {}\n", found.join(", "))
}

/// A quantity of a rover, slope by slope: measured, then each model.
fn over_slopes(part: &[RankedModel], quantity: Quantity) -> Text {
    let tables: Vec<(String, Table)> = part
        .iter()
        .filter_map(|row| match &row.found {
            Found::Slope(it) => Some((row.model.to_owned(), slope::slopes(&it.points))),
            Found::Wheel(_) => None,
        })
        .collect();
    let Some((_, first)) = tables.first() else { return Text::default() };
    let measured = first.numbers(&quantity.measurement());
    if measured.iter().all(Option::is_none) {
        return Text::default();
    }
    let number = |value: &Option<f64>| value.map_or("-".to_owned(), four_digits);
    let line = |name: &str, values: &[Option<f64>]| -> Vec<String> {
        std::iter::once(name.to_owned()).chain(values.iter().map(number)).collect()
    };
    let places = first.numbers(SLOPE.name).iter().zip(first.numbers(COURSE.name));
    let places = places.map(|(slope, course)| format!("{}°, {}°", number(slope), number(course)));
    let header: Vec<String> =
        std::iter::once(format!("{} on slope, course", quantity.name)).chain(places).collect();
    let models = tables.iter().map(|(model, table)| line(model, table.numbers(quantity.name)));
    let rows = std::iter::once(line("measured", measured)).chain(models);
    aligned(&header, &rows.collect::<Vec<_>>())
}

/// The scores of all models and yardsticks on all parts.
fn all_parts(models: &[OverAll]) -> Text {
    let name = |one: &OverAll| one.model.or(one.yardstick).unwrap_or("-").to_owned();
    let header: Vec<String> =
        std::iter::once("score on".to_owned()).chain(models.iter().map(name)).collect();
    let parts = models.first().map_or(&[][..], |first| &first.scores);
    let row = |name: String, of: &dyn Fn(&OverAll) -> String| -> Vec<String> {
        std::iter::once(name).chain(models.iter().map(of)).collect()
    };
    let scores = parts.iter().enumerate().map(|(place, part)| {
        let name = format!("{}, {}", part.data_set, part.case);
        row(name, &|one| in_two_digits(one.scores[place].score))
    });
    let sums = [
        row("mean".to_owned(), &|one| in_two_digits(one.score)),
        row("within the aim".to_owned(), &|one| format!("{} of {}", one.aims_met, one.aims)),
        row("no prediction".to_owned(), &|one| one.unsettled_trials.to_string()),
    ];
    let rows: Vec<Vec<String>> = scores.chain(sums).collect();
    let title = "All parts, with soils that were not fitted to them; best first, then what has no physics\n";
    Text::from(title) + aligned(&header, &rows)
}
