//! Errors of a wheel–soil model against measured wheel tests or a rover on slopes, and the ranking
//! of all models on these or on recorded drives.

mod drives;
pub mod figures;
mod flat;
mod ranking;
mod shown;
mod slopes;
mod wheel;

pub use self::drives::DriveValidationQuestion;
pub use self::ranking::ranked;
pub use self::slopes::SlopeValidationQuestion;
pub use self::wheel::ValidationQuestion;

use super::{Answer, ColumnMeaning};
use crate::document::measurements::Condition;
use crate::document::unit::ONE;

/// The name that the files of an answer about one model have.
const FILE: &str = "validation";

/// What stands for the unit of an error: it is that of its row.
const OF_QUANTITY: &str = "of the quantity";

/// The errors of a quantity: name, unit, and what it is.
const ERRORS: [(&str, &str, &str); 10] = [
    ("rmse", OF_QUANTITY, "Root mean square of prediction minus measurement"),
    ("bias", OF_QUANTITY, "Mean of prediction minus measurement"),
    ("r2", ONE.symbol, "Coefficient of determination; none where measured values do not differ"),
    ("repeatability", OF_QUANTITY, "Standard deviation between repeated trials; none without them"),
    ("cells", ONE.symbol, "How many cells, or slopes, have the quantity and a prediction"),
    ("largest_measured", OF_QUANTITY, "The largest measured value, without its sign"),
    ("rmse_share", ONE.symbol, "rmse over the largest measured value"),
    ("bias_share", ONE.symbol, "bias over the largest measured value"),
    ("aim", OF_QUANTITY, "The largest error that is within the aim; none where there is no aim"),
    ("within_aim", ONE.symbol, "Whether the aim is met, with a prediction for every trial"),
];

/// What the columns of errors are.
fn meanings_of_errors() -> Vec<ColumnMeaning> {
    let meaning = |(name, unit, doc): (&str, &'static str, &'static str)| ColumnMeaning {
        name: name.to_owned(),
        unit,
        doc,
    };
    ERRORS.into_iter().map(meaning).collect()
}

/// Conditions as they are written.
fn written(conditions: &[Condition]) -> Vec<String> {
    conditions.iter().map(ToString::to_string).collect()
}

/// Adds figures to the page, each with a file.
fn draw(answer: &mut Answer, figures: Vec<figures::Figure>) {
    for figures::Figure { file, chart, caption } in figures {
        answer.figure(Some(&format!("figures/{file}")), chart, caption);
    }
}
