//! Numbers, values and words for reading: few digits, capital letters.

use serde_json::Value;

use super::cell::BETWEEN_NAMES;
use super::table::Row;

/// A value: a number with four significant digits, null as a dash.
#[must_use]
pub fn short(value: &Value) -> String {
    match value {
        Value::Null => "-".into(),
        Value::String(text) => text.clone(),
        Value::Array(names) if names.is_empty() => "-".into(),
        Value::Array(names) => joined(names),
        Value::Number(number) => number.as_f64().map_or_else(|| number.to_string(), four_digits),
        other => other.to_string(),
    }
}

/// Names of a list as one text.
#[must_use]
pub fn joined(names: &[Value]) -> String {
    let names: Vec<&str> = names.iter().filter_map(Value::as_str).collect();
    names.join(BETWEEN_NAMES)
}

/// So many of something: `1 row`, `2 rows`.
#[must_use]
pub fn counted(count: u64, one: &str, more: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { more })
}

/// A row as `load_n 17, slip_ratio 0.2`.
#[must_use]
pub fn row_in_words(row: &Row<'_>) -> String {
    let Ok(Value::Object(cells)) = serde_json::to_value(row) else { return String::new() };
    let cells = cells.iter().map(|(key, value)| format!("{key} {}", short(value)));
    cells.collect::<Vec<_>>().join(", ")
}

/// A number with four significant digits.
#[must_use]
pub fn four_digits(value: f64) -> String {
    /// What is smaller is left over where terms cancel, in any unit of ours.
    const NOISE: f64 = 1e-9;
    let value = if value.abs() < NOISE { 0.0 } else { value };
    let scientific = format!("{value:.3e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    match exponent.parse::<usize>() {
        // 0 to 9999: as many decimals as digits are left. Up to a million: none.
        Ok(exponent @ 0..=3) => trimmed(&format!("{value:.*}", 3 - exponent)),
        Ok(4..=6) => format!("{value:.0}"),
        _ if value.abs() >= 1e-4 && value.abs() < 1.0 => {
            let decimals = 3 + exponent.trim_start_matches('-').parse::<usize>().unwrap_or(0);
            trimmed(&format!("{value:.decimals$}"))
        }
        _ => format!("{}e{exponent}", trimmed(digits)),
    }
}

/// A place [m], to the millimetre, or with four significant digits where these are finer.
#[must_use]
pub fn metres(value: f64) -> String {
    /// From here on four digits are coarser than a millimetre [m].
    const FAR: f64 = 10.0;
    if value.abs() < FAR { four_digits(value) } else { trimmed(&format!("{value:.3}")) }
}

/// A limit with two decimals, rounded down: what is rounded up is beyond it.
#[must_use]
pub fn rounded_down(limit: f64) -> String {
    format!("{:.2}", (limit * 100.0).floor() / 100.0)
}

/// Without the zeros that end a decimal fraction.
fn trimmed(text: &str) -> String {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text.to_owned()
    }
}

/// A text with a capital letter at its start.
#[must_use]
pub fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// A line as a sentence: a capital letter at its start, one full stop at its end.
#[must_use]
pub fn sentence(line: &str) -> String {
    format!("{}.", capitalised(line.trim_end_matches('.')))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_with_four_digits() {
        for (value, text) in [
            (0.0, "0"),
            (5.035_561, "5.036"),
            (-0.055_399_7, "-0.0554"),
            (17.0, "17"),
            (1203.54, "1204"),
            (1.234e-9, "1.234e-9"),
            (-3.4e-13, "0"),
            (123_456_789.0, "1.235e8"),
        ] {
            assert_eq!(four_digits(value), text);
        }
    }

    #[test]
    fn places_are_read_to_the_millimetre() {
        for (value, text) in [(0.123_456, "0.1235"), (-25_871.123_4, "-25871.123"), (12.0, "12")] {
            assert_eq!(metres(value), text);
        }
    }

    #[test]
    fn a_sentence_has_one_full_stop() {
        assert_eq!(sentence("no wheel moves"), "No wheel moves.");
        assert_eq!(sentence("no wheel moves."), "No wheel moves.");
    }
}
