//! Conditions that select rows: `slip_angle_deg=0,15`, `wheel!=grouser`.

use std::collections::HashSet;
use std::fmt;

/// What the value in a column must be, or must not be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Condition {
    /// The column's name.
    pub column: String,
    /// Whether the values are the wanted ones; otherwise they are the unwanted.
    pub wanted: bool,
    /// The values, as they were written.
    pub values: Vec<String>,
}

impl Condition {
    /// Reads `column=value,value` or `column!=value,value`.
    ///
    /// # Errors
    /// A sentence, if it is not written so.
    pub fn parse(text: &str) -> Result<Self, String> {
        let (left, values) = text.split_once('=').ok_or_else(|| malformed(text))?;
        let (column, wanted) = match left.strip_suffix('!') {
            Some(column) => (column, false),
            None => (left, true),
        };
        let values: Vec<String> = values.split(',').map(|value| value.trim().to_owned()).collect();
        if column.trim().is_empty() || values.iter().any(String::is_empty) {
            return Err(malformed(text));
        }
        Ok(Self { column: column.trim().to_owned(), wanted, values })
    }

    /// Whether a cell of that column meets it. Numbers are compared as numbers.
    #[must_use]
    pub fn is_met_by(&self, cell: &str) -> bool {
        self.values.iter().any(|value| same(value, cell)) == self.wanted
    }

    /// Whether a number meets it, for many numbers.
    pub(super) fn of_numbers(&self) -> impl Fn(f64) -> bool {
        let each = self.values.iter().filter_map(|value| value.parse::<f64>().ok());
        let values: HashSet<u64> = each.map(f64::to_bits).collect();
        let wanted = self.wanted;
        move |number| values.contains(&number.to_bits()) == wanted
    }
}

impl fmt::Display for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.wanted { "=" } else { "!=" };
        write!(f, "{}{sign}{}", self.column, self.values.join(","))
    }
}

fn same(value: &str, cell: &str) -> bool {
    match (value.parse::<f64>(), cell.parse::<f64>()) {
        (Ok(value), Ok(cell)) => value == cell,
        _ => value == cell,
    }
}

fn malformed(text: &str) -> String {
    format!("'{text}' is not of the form column=value,value or column!=value,value")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_compared_as_numbers_and_words_as_words() {
        let angles = Condition::parse("slip_angle_deg=0,15").unwrap();
        assert!(angles.is_met_by("15.0") && angles.is_met_by("0") && !angles.is_met_by("45"));
        let wheel = Condition::parse("wheel != grouser").unwrap();
        assert!(wheel.is_met_by("smooth") && !wheel.is_met_by("grouser"));
    }

    #[test]
    fn what_is_no_condition_says_so() {
        for text in ["", "wheel", "=5", "wheel=", "wheel=a,,b", "!=3"] {
            assert!(Condition::parse(text).is_err(), "{text}");
        }
    }
}
