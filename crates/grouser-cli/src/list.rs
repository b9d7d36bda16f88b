//! Numbers as flags write them: `5`, `5,10,15`, `0:0.9:0.1`, and mixtures.

use clap::builder::{PossibleValuesParser, TypedValueParser};

/// A list of numbers from a flag.
///
/// Whether a number makes sense, a NaN or an infinity above all, is for its range to tell.
///
/// `from:to:step` includes its end if the steps meet it to within a millionth of a step.
pub(crate) fn parse(text: &str) -> Result<Numbers, String> {
    let mut numbers = Vec::new();
    for part in text.split(',') {
        let fields: Vec<&str> = part.split(':').collect();
        match fields[..] {
            [single] => numbers.push(number(single)?),
            [from, to, step] => range(number(from)?, number(to)?, number(step)?, &mut numbers)?,
            _ => return Err(format!("'{part}' is neither a number nor a range from:to:step")),
        }
        if numbers.len() > MOST {
            return Err(format!("more than {MOST} numbers"));
        }
    }
    Ok(Numbers(numbers))
}

/// A parser of a flag that takes one of some values by its name.
pub(crate) fn one_of<T: Copy + Send + Sync + 'static, const N: usize>(
    all: [T; N],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    let value = move |word: String| all.into_iter().find(|it| name(*it) == word);
    PossibleValuesParser::new(all.map(name)).try_map(move |word| value(word).ok_or("unknown"))
}

/// A parsed list. (A type of its own, for the parser of flags would take a `Vec` apart.)
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Numbers(pub(crate) Vec<f64>);

impl Numbers {
    /// The numbers as a flag takes them again: `5,10,15`.
    pub(crate) fn joined(&self) -> String {
        self.0.iter().map(ToString::to_string).collect::<Vec<_>>().join(",")
    }
}

/// Longer lists are slips of the pen.
pub(crate) const MOST: usize = 1_000_000;

fn number(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| format!("'{}' is not a number", text.trim()))
}

fn range(from: f64, to: f64, step: f64, numbers: &mut Vec<f64>) -> Result<(), String> {
    if let Some(end) = [from, to, step].into_iter().find(|end| !end.is_finite()) {
        return Err(format!("a range cannot have {end} in it"));
    }
    if step == 0.0 || (to - from) * step < 0.0 {
        return Err(format!("the step {step} does not lead from {from} to {to}"));
    }
    /// Decimal steps do not add up exactly; this much of a step is forgiven.
    const FORGIVEN: f64 = 1e-6;
    let last = ((to - from) / step + FORGIVEN).floor();
    if last >= MOST as f64 {
        return Err(format!("the range {from}:{to}:{step} has more than {MOST} numbers"));
    }
    let mut index = 0.0;
    while index <= last {
        numbers.push(rounded(from + index * step, step.abs()));
        index += 1.0;
    }
    Ok(())
}

/// 0.30000000000000004 as it was meant, 0.3; and what is nearly zero beside the step is zero.
fn rounded(value: f64, step: f64) -> f64 {
    /// Sums of decimal steps are off by less than this share of a step.
    const NOISE: f64 = 1e-12;
    if value.abs() < NOISE * step {
        return 0.0;
    }
    // A double has 17 digits; of such sums the first 13 are right.
    format!("{value:.12e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_ranges_and_mixtures() {
        assert_eq!(parse("5, 10,15").unwrap().0, [5.0, 10.0, 15.0]);
        assert_eq!(parse("0:0.3:0.1").unwrap().0, [0.0, 0.1, 0.2, 0.3]);
        assert_eq!(parse("1:-1:-0.5,7").unwrap().0, [1.0, 0.5, 0.0, -0.5, -1.0, 7.0]);
        assert_eq!(parse("0:1:0.3").unwrap().0, [0.0, 0.3, 0.6, 0.9]);
        assert_eq!(parse("-1e-3").unwrap().0, [-1e-3]);
    }

    #[test]
    fn a_range_ends_on_its_end() {
        let numbers = parse("0:0.9:0.1").unwrap().0;
        assert_eq!((numbers.len(), numbers[9], numbers[3]), (10, 0.9, 0.3));
    }

    #[test]
    fn what_is_no_list_says_why() {
        for text in
            ["", "five", "1:2", "1:2:3:4", "0:1:0", "0:1:-0.1", "0:nan:1", "0:inf:1", "0:1:1e-9"]
        {
            assert!(parse(text).is_err(), "{text}");
        }
    }
}
