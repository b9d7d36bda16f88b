//! A ranking for reading: a block for each part of each data set, then all parts and all models
//! together.

use std::sync::Arc;

use super::super::shown::{Block, Shown, number, table};
use crate::document::columns::{COURSE, Quantity, SLIP_RATIO, SLOPE, YAW, slope};
use crate::document::ranking::{Found, OverAll, RankedModel, RankedYardstick, Ranking, SetRecord};
use crate::document::table::Table;
use crate::document::validation::{ErrorsRecord, GroupRecord, PartErrors};

const LEGEND: &str = "Errors of each quantity: root mean square / mean (prediction minus \
    measurement) / root mean square over the largest\nmeasured value, and whether that is within \
    the aim.\nscore: 0 is perfect, 1 no better than the mean of what was measured. Rows without a \
    rank have no physics in them.\n";

const OVER_ALL: &str = "All parts, with soils that were not fitted to them; best first, then what \
    has no physics\n";

const TOGETHER: &str = "All models together, by weights found without the set: the median's errors \
    and the 95 % band. Forces over the\nload, sinkage over the shearing radius, slip without a \
    unit, yaw in degrees.\n";

/// A block for each part of each data set, then those for all together.
pub(super) fn blocks(ranking: &Ranking) -> Vec<Block> {
    let mut blocks: Vec<Block> = vec![vec![Shown::Words(LEGEND.to_owned())]];
    let is_same = |one: &RankedModel, other: &RankedModel| {
        (&one.data_set, &one.case) == (&other.data_set, &other.case)
    };
    let parts = ranking.rows.chunk_by(is_same);
    blocks.extend(parts.map(|part| of_part(part, &ranking.yardsticks)));
    if ranking.models.first().is_some_and(|first| first.scores.len() > 1) {
        let scores = Shown::Rows("Scores on all parts", all_parts(&ranking.models));
        blocks.push(vec![Shown::Words(OVER_ALL.to_owned()), scores]);
    }
    blocks.push(together(&ranking.sets));
    blocks.extend(zero_pulls(&ranking.sets));
    blocks
}

/// * `part`: its models, at least one
/// * `yardsticks`: of all parts
fn of_part(part: &[RankedModel], yardsticks: &[RankedYardstick]) -> Block {
    let first = &part[0];
    let is_of_part =
        |it: &&RankedYardstick| (&it.data_set, &it.case) == (&first.data_set, &first.case);
    let yardsticks: Vec<&RankedYardstick> = yardsticks.iter().filter(is_of_part).collect();
    let mut block = vec![
        Shown::Title(format!("{}, {}", first.data_set, first.case)),
        Shown::Rows("Errors over all cells", all_cells(part, &yardsticks)),
    ];
    let has_skid = first.driven.as_ref().is_some_and(
        |driven| matches!(&first.overall, PartErrors::Wheel(all) if all.0.cells > driven.0.cells),
    );
    if has_skid {
        block.push(Shown::Words("driven cells alone\n".to_owned()));
        block.push(Shown::Rows("Errors over driven cells", driven_cells(part, &yardsticks)));
    }
    block.extend(repeatability(&first.overall).map(Shown::Words));
    let slopes = [SLIP_RATIO, YAW].into_iter().filter_map(|quantity| over_slopes(part, quantity));
    block.extend(slopes.map(|table| Shown::Rows("Measured, and by each model", table)));
    block
}

/// The band of all models on each part.
fn together(sets: &[SetRecord]) -> Block {
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
    let bands = table(&header.map(str::to_owned), rows.collect());
    vec![Shown::Words(TOGETHER.to_owned()), Shown::Rows("All models together", bands)]
}

/// The slips at which the pull vanishes, if any is predicted.
fn zero_pulls(sets: &[SetRecord]) -> Option<Block> {
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
    let caption = "Slip ratios at which the pull vanishes";
    (!rows.is_empty()).then(|| vec![Shown::Rows(caption, table(&header, rows))])
}

/// Columns of the errors of a part.
fn header(quantities: &[Quantity]) -> Vec<String> {
    let names = ["rank", "model", "soil", "score", "no prediction"].map(str::to_owned);
    names.into_iter().chain(quantities.iter().map(|it| it.name.to_owned())).collect()
}

fn all_cells(part: &[RankedModel], yardsticks: &[&RankedYardstick]) -> Arc<Table> {
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
    table(&header(&measured), models.chain(references).collect())
}

fn driven_cells(part: &[RankedModel], yardsticks: &[&RankedYardstick]) -> Arc<Table> {
    let errors = |driven: Option<&GroupRecord>| {
        driven.map_or(Vec::new(), |group| PartErrors::Wheel(group.clone()).measured())
    };
    let driven = yardsticks.iter().map(|it| errors(it.reference.driven.as_ref()));
    let measured = measured_in(driven);
    let models = part.iter().map(|row| {
        let group = row.driven.as_ref();
        let unsettled = group.map_or("-".to_owned(), |group| group.0.unsettled.to_string());
        let score = group.and_then(|group| group.0.score());
        line(named(row), score, unsettled, &errors(group), &measured)
    });
    let references = yardsticks.iter().map(|row| {
        let names = ["-", row.reference.yardstick, "-"].map(str::to_owned);
        let group = row.reference.driven.as_ref();
        let score = group.and_then(|group| group.0.score());
        line(names, score, "-".to_owned(), &errors(group), &measured)
    });
    table(&header(&measured), models.chain(references).collect())
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
fn repeatability(overall: &PartErrors) -> Option<String> {
    let of = |(quantity, errors): (Quantity, ErrorsRecord)| {
        Some(format!("{} {:.2}", quantity.name, errors.repeatability?))
    };
    let found: Vec<String> = overall.measured().into_iter().filter_map(of).collect();
    let all = found.join(", ");
    (!found.is_empty()).then(|| format!("between repeated trials, all cells: {all}\n"))
}

/// A quantity of a rover, slope by slope: measured, then each model; nothing if it was not
/// measured.
fn over_slopes(part: &[RankedModel], quantity: Quantity) -> Option<Arc<Table>> {
    let tables = part.iter().filter_map(|row| match &row.found {
        Found::Slope(it) => Some((row.model, slope::slopes(&it.points))),
        Found::Wheel(_) => None,
    });
    let tables: Vec<(&str, Table)> = tables.collect();
    let (_, first) = tables.first()?;
    let measured = first.numbers(&quantity.measurement());
    if measured.iter().all(Option::is_none) {
        return None;
    }
    let line = |name: &str, values: &[Option<f64>]| -> Vec<String> {
        std::iter::once(name.to_owned()).chain(values.iter().copied().map(number)).collect()
    };
    let places = first.numbers(SLOPE.name).iter().zip(first.numbers(COURSE.name));
    let places = places.map(|(slope, course)| format!("{}°, {}°", number(*slope), number(*course)));
    let mut header = vec![format!("{} on slope, course", quantity.name)];
    header.extend(with_unique_names(&places.collect::<Vec<_>>()));
    let models = tables.iter().map(|(model, table)| line(model, table.numbers(quantity.name)));
    let rows = std::iter::once(line("measured", measured)).chain(models);
    Some(table(&header, rows.collect()))
}

/// Names, with a number where one stands again: columns need names of their own.
fn with_unique_names(names: &[String]) -> impl Iterator<Item = String> {
    let earlier = |place: usize| names[..place].iter().filter(|it| **it == names[place]).count();
    names.iter().enumerate().map(move |(place, name)| match earlier(place) {
        0 => name.clone(),
        count => format!("{name} ({})", count + 1),
    })
}

/// The scores of all models and yardsticks on all parts.
fn all_parts(models: &[OverAll]) -> Arc<Table> {
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
    table(&header, scores.chain(sums).collect())
}
