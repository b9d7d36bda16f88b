//! Axes: a range of numbers, and round numbers along it.

use grouser_core::elementary::wide;

use crate::sheet::{Face, width};

/// Numbers beyond are drawn as little as those that are missing: a range of them has no length.
const LARGEST: f64 = 1e300;
/// Numbers nearer to zero are zero.
const SMALLEST: f64 = 1e-300;
/// Numbers that differ by less than this share of them are one number.
const ALIKE: f64 = 1e-9;
/// How far beyond the last tick a number may be, in steps: no one sees it.
const UNSEEN: f64 = 1e-6;

/// A number along an axis, or what stands there instead.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    /// Where it stands, in the axis's unit.
    pub(super) at: f64,
    /// What is written there.
    pub(super) label: String,
}

/// A range with ticks.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    low: f64,
    high: f64,
    is_log: bool,
    /// From the low to the high end.
    pub(super) ticks: Vec<Tick>,
}

/// Whether a number has a place on an axis.
pub(super) fn is_drawn(number: f64) -> bool {
    number.abs() <= LARGEST
}

/// The least and the largest of the numbers that have a place on an axis; `None` without any.
pub(super) fn range(numbers: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    let drawn = numbers.into_iter().filter(|number| is_drawn(*number));
    drawn.fold(None, |range, number| {
        let [low, high] = range.unwrap_or([number; 2]);
        Some([low.min(number), high.max(number)])
    })
}

impl Axis {
    /// A linear axis from tick to tick, over a range and little more.
    ///
    /// * `most`: number of intervals between ticks
    pub(super) fn linear(range: Option<[f64; 2]>, most: usize) -> Self {
        let [low, high] = widened(range.unwrap_or([0.0, 1.0]));
        // Around zero, two intervals are the least.
        let most = i64::try_from(most.max(2)).unwrap_or(i64::MAX);
        let mut digits = [1, 2, 5].into_iter().cycle();
        let mut step = Round { digits: 1, power: power_of((high - low) / most as f64) - 1 };
        loop {
            step.digits = digits.next().unwrap_or(1);
            step.power += i32::from(step.digits == 1);
            let [first, last] = step.counts_over(low, high);
            if last - first <= most {
                return Self::of((first..=last).map(|count| step.times(count)), false);
            }
        }
    }

    /// A logarithmic axis from tick to tick, over a range above zero.
    ///
    /// * `most`: number of intervals between ticks
    pub(super) fn log(range: Option<[f64; 2]>, most: usize) -> Self {
        let [low, high] = range.unwrap_or([1.0, 10.0]);
        // Around one, two intervals are the least.
        let most = most.max(2);
        let [first, last] = [power_of(low) - 1, power_of(high) + 2];
        // Fewer and fewer of all powers of ten, and twice and five times each.
        let strides = std::iter::once((&[1, 2, 5][..], 1)).chain((1..).map(|it| (&[1][..], it)));
        for (digits, stride) in strides {
            let first = first.div_euclid(stride) * stride;
            let powers = (first..=last + stride).step_by(stride.unsigned_abs() as usize);
            let all: Vec<Round> = powers
                .flat_map(|power| digits.iter().map(move |digits| Round { digits: *digits, power }))
                .collect();
            let start = all.iter().rposition(|tick| tick.number() < low * (1.0 + ALIKE));
            let end = all.iter().position(|tick| tick.number() > high * (1.0 - ALIKE));
            let (start, mut end) = (start.unwrap_or(0), end.unwrap_or(all.len() - 1));
            end = end.max(start + 1).min(all.len() - 1);
            if end - start <= most {
                return Self::of(all[start..=end].iter().copied(), true);
            }
        }
        unreachable!("strides grow until two ticks are left")
    }

    /// An axis with names at 1, 2, … instead of numbers.
    pub(super) fn named(names: impl IntoIterator<Item = String>) -> Self {
        let names = names.into_iter().enumerate();
        let ticks: Vec<Tick> =
            names.map(|(place, label)| Tick { at: (place + 1) as f64, label }).collect();
        Self { low: 0.5, high: ticks.len().max(1) as f64 + 0.5, is_log: false, ticks }
    }

    /// The axis with the most ticks, of no more than some, whose labels do not touch.
    ///
    /// * `make`: an axis by its most intervals
    /// * `length`: of the axis [mm]
    /// * `size`: height of the labels' font [mm]
    pub(super) fn fitting(
        most: usize,
        make: impl Fn(usize) -> Self,
        length: f64,
        size: f64,
    ) -> Self {
        let axes = (2..=most).rev().map(&make);
        let mut fitting = axes.filter(|axis| axis.labels_fit(length, size));
        fitting.next().unwrap_or_else(|| make(1))
    }

    fn labels_fit(&self, length: f64, size: f64) -> bool {
        let half = |tick: &Tick| 0.5 * width(&tick.label, Face::Regular, size);
        self.ticks.windows(2).all(|pair| {
            let apart = (self.share(pair[1].at) - self.share(pair[0].at)) * length;
            apart > half(&pair[0]) + half(&pair[1]) + size
        })
    }

    /// The same with room before and after numbers that would stand at an end.
    ///
    /// * `range`: of the numbers
    /// * `room`: share of the axis
    pub(super) fn with_room(self, range: Option<[f64; 2]>, room: f64) -> Self {
        let Some([low, high]) = range else { return self };
        let (before, after) =
            ((room - self.share(low)).max(0.0), (room - 1.0 + self.share(high)).max(0.0));
        Self { low: self.at_share(-before), high: self.at_share(1.0 + after), ..self }
    }

    /// The low and the high end.
    pub(super) fn ends(&self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// Where a number stands: 0 at the low end, 1 at the high one.
    pub(super) fn share(&self, number: f64) -> f64 {
        if self.is_log {
            let [low, high, number] = [self.low, self.high, number].map(wide::ln);
            (number - low) / (high - low)
        } else {
            (number - self.low) / (self.high - self.low)
        }
    }

    fn at_share(&self, share: f64) -> f64 {
        // Where nothing moves the end keeps its round number.
        if share == 0.0 {
            self.low
        } else if share == 1.0 {
            self.high
        } else if self.is_log {
            self.low * grouser_core::elementary::pow(self.high / self.low, share)
        } else {
            self.low + share * (self.high - self.low)
        }
    }

    fn of(ticks: impl Iterator<Item = Round>, is_log: bool) -> Self {
        let rounds: Vec<Round> = ticks.collect();
        let largest = rounds.iter().map(|tick| tick.power_of()).max().unwrap_or(0);
        let tick = |round: &Round| {
            let power = if is_log { round.power_of() } else { largest };
            Tick { at: round.number(), label: round.label(power, is_log) }
        };
        let ticks: Vec<Tick> = rounds.iter().map(tick).collect();
        let [low, high] = [ticks.first(), ticks.last()].map(|end| end.map_or(0.0, |tick| tick.at));
        Self { low, high, is_log, ticks }
    }
}

/// A round number: whole digits times a power of ten.
#[derive(Clone, Copy, Debug)]
struct Round {
    digits: i64,
    power: i32,
}

impl Round {
    /// The number itself, as near as a number of the machine is.
    fn number(self) -> f64 {
        format!("{}e{}", self.digits, self.power).parse().unwrap_or(f64::NAN)
    }

    fn times(self, count: i64) -> Self {
        Self { digits: self.digits * count, ..self }
    }

    /// How many steps from zero the last tick before a range is, and the first after it.
    #[expect(clippy::cast_possible_truncation, reason = "ranges have a billion steps at most")]
    fn counts_over(self, low: f64, high: f64) -> [i64; 2] {
        let step = self.number();
        [(low / step + UNSEEN).floor() as i64, (high / step - UNSEEN).ceil() as i64]
    }

    /// The power of ten of the first digit; the least there is for zero.
    fn power_of(self) -> i32 {
        if self.digits == 0 {
            return i32::MIN;
        }
        self.power + self.digits.unsigned_abs().ilog10().cast_signed()
    }

    /// The number for people, with the digits that tell it from the next of its kind.
    ///
    /// * `largest`: power of ten of the largest number on the axis
    /// * `is_alone`: whether other numbers have other digits
    fn label(self, largest: i32, is_alone: bool) -> String {
        /// Powers of ten whose numbers are written without one.
        const PLAIN: std::ops::RangeInclusive<i32> = -3..=5;
        if self.digits == 0 {
            return "0".to_owned();
        }
        let is_plain = PLAIN.contains(&largest);
        let shift = if is_plain { 0 } else { largest };
        let decimals = usize::try_from(shift - self.power).unwrap_or(0);
        let shifted = Self { power: self.power - shift, ..self };
        let number = format!("{:.decimals$}", shifted.number()).replace('-', "−");
        match (is_plain, is_alone && number == "1") {
            (true, _) => number,
            (false, true) => format!("10{}", raised(largest)),
            (false, false) => format!("{number}·10{}", raised(largest)),
        }
    }
}

/// A power above the line.
fn raised(power: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raise = |letter: char| letter.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]);
    power.to_string().chars().map(raise).collect()
}

/// The power of ten of a number's first digit.
fn power_of(number: f64) -> i32 {
    let text = format!("{number:e}");
    text.split_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or(0)
}

/// A range that has a length: around one number, a tenth of it to both sides.
fn widened([low, high]: [f64; 2]) -> [f64; 2] {
    let size = low.abs().max(high.abs());
    if size < SMALLEST {
        return [-1.0, 1.0];
    }
    if high - low > ALIKE * size {
        return [low, high];
    }
    let middle = low.midpoint(high);
    [middle - 0.1 * size, middle + 0.1 * size]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().map(|tick| tick.label.as_str()).collect()
    }

    fn check_linear(low: f64, high: f64, most: usize) {
        let axis = Axis::linear(Some([low, high]), most);
        let ticks: Vec<f64> = axis.ticks.iter().map(|tick| tick.at).collect();
        let what = || format!("{low} to {high}, {most}: {ticks:?} {:?}", labels(&axis));
        assert!((2..=most.max(2) + 1).contains(&ticks.len()), "{}", what());
        let step = (ticks[ticks.len() - 1] - ticks[0]) / (ticks.len() - 1) as f64;
        let digit = format!("{step:.6e}");
        assert!(["1.0", "2.0", "5.0"].iter().any(|it| digit.starts_with(it)), "{}", what());
        for tick in &ticks {
            let steps = tick / step;
            assert!((steps - steps.round()).abs() < 1e-6 * steps.abs().max(1.0), "{}", what());
        }
        assert!(ticks[0] <= low + 1e-5 * step, "{}", what());
        assert!(ticks[ticks.len() - 1] >= high - 1e-5 * step, "{}", what());
        let mut all = labels(&axis);
        all.dedup();
        assert_eq!(all.len(), ticks.len(), "{}", what());
    }

    #[test]
    fn linear_ticks_are_round_differ_and_cover_the_data() {
        for (low, high) in [
            (0.0, 1.0),
            (0.1, 0.3),
            (-3.0, 17.0),
            (19.999, 20.001),
            (-1e-9, 4e-9),
            (3.2e8, 9.9e8),
            (1e250, 3e299),
            (-9e299, 9e299),
            (1e-290, 7e-290),
            (1e6, 1e6 + 1.0),
            (-4.0, -1.0),
        ] {
            for most in [1, 2, 3, 5, 8] {
                check_linear(low, high, most);
            }
        }
    }

    #[test]
    fn one_number_and_none_have_axes() {
        for value in [0.0, 0.3, -12.0, 5e-310, 1e299] {
            check_linear(value, value, 5);
        }
        assert_eq!(labels(&Axis::linear(None, 5)), ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(&Axis::log(None, 5)), ["1", "2", "5", "10"]);
        assert_eq!(range([f64::NAN, f64::INFINITY, 1e301]), None);
        assert_eq!(range([f64::NAN, 2.0, -1.0, f64::NEG_INFINITY]), Some([-1.0, 2.0]));
    }

    #[test]
    fn labels_are_short_and_have_true_signs() {
        let of = |low, high| Axis::linear(Some([low, high]), 4);
        assert_eq!(labels(&of(-0.2, 0.2)), ["−0.2", "−0.1", "0", "0.1", "0.2"]);
        assert_eq!(labels(&of(0.0, 4e7)), ["0", "1·10⁷", "2·10⁷", "3·10⁷", "4·10⁷"]);
        assert_eq!(labels(&of(0.0, 2e-5)), ["0", "0.5·10⁻⁵", "1.0·10⁻⁵", "1.5·10⁻⁵", "2.0·10⁻⁵"]);
    }

    #[test]
    fn logarithmic_ticks_are_round_and_cover_the_data() {
        for (low, high) in [(1.0, 1.0), (2.0, 2.0), (3.0, 40.0), (7e-9, 1e12), (16.0, 4096.0)] {
            for most in [1, 3, 6, 9] {
                let axis = Axis::log(Some([low, high]), most);
                let (first, last) = (&axis.ticks[0], &axis.ticks[axis.ticks.len() - 1]);
                assert!(
                    axis.ticks.len() <= most.max(2) + 1,
                    "{low} to {high}: {:?}",
                    labels(&axis)
                );
                assert!(first.at < last.at && first.at <= low && last.at >= high, "{low} {high}");
                assert!(
                    axis.ticks.iter().all(|tick| "125".contains(&format!("{:e}", tick.at)[..1]))
                );
            }
        }
        assert_eq!(labels(&Axis::log(Some([3.0, 40.0]), 6)), ["2", "5", "10", "20", "50"]);
        assert_eq!(labels(&Axis::log(Some([1e-5, 1e-4]), 1)), ["10⁻⁵", "10⁻⁴"]);
        assert!((Axis::log(Some([1.0, 100.0]), 2).share(10.0) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn room_is_added_only_where_numbers_stand_at_an_end() {
        let axis = Axis::linear(Some([0.0, 9.0]), 5).with_room(Some([0.0, 9.0]), 0.02);
        assert!((axis.share(0.0) * (10.0 - axis.low) - 0.2).abs() < 1e-9, "{}", axis.low);
        assert_eq!(axis.high, 10.0);
    }
}
