//! Times of a log, however they are written: seconds, thousandths, millionths, billionths since
//! whenever, and dates.

use chrono::{DateTime, NaiveDateTime};

/// Between 1973 and 2286, in seconds since 1970: no log takes as long.
const ERA: std::ops::Range<f64> = 1e8..1e10;

/// How times of a column are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeUnit {
    /// Seconds, or dates.
    Seconds,
    /// Thousandths of a second.
    Milliseconds,
    /// Millionths.
    Microseconds,
    /// Billionths.
    Nanoseconds,
}

/// Columns of the time beside `time_s`, in the order in which they are taken, with their units; none
/// of those whose name does not say it.
pub(super) const OTHER_TIMES: [(&str, Option<TimeUnit>); 9] = [
    ("time_ms", Some(TimeUnit::Milliseconds)),
    ("time_us", Some(TimeUnit::Microseconds)),
    ("time_ns", Some(TimeUnit::Nanoseconds)),
    // Of `rostopic echo -p`, in nanoseconds.
    ("%time", Some(TimeUnit::Nanoseconds)),
    ("timestamp", None),
    ("Timestamp", None),
    ("time", None),
    ("Time", None),
    // Of PlotJuggler.
    ("__time", None),
];

/// Endings of the names of such columns, which are units.
pub(super) const TIME_UNITS: [&str; 4] = ["s", "ms", "us", "ns"];

impl TimeUnit {
    /// The unit in which a number is a time between 1973 and 2286; seconds for any other number.
    /// None of these is a time in seconds that a log has.
    pub(super) fn of(time: f64) -> Self {
        let is_time = |unit: &Self| ERA.contains(&(time.abs() / unit.per_second()));
        let all = [Self::Milliseconds, Self::Microseconds, Self::Nanoseconds];
        all.into_iter().find(is_time).unwrap_or(Self::Seconds)
    }

    /// How many make a second.
    pub(super) fn per_second(self) -> f64 {
        match self {
            Self::Seconds => 1.0,
            Self::Milliseconds => 1e3,
            Self::Microseconds => 1e6,
            Self::Nanoseconds => 1e9,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Seconds => "seconds",
            Self::Milliseconds => "milliseconds",
            Self::Microseconds => "microseconds",
            Self::Nanoseconds => "nanoseconds",
        }
    }
}

/// The day of a time in Greenwich, year-month-day; none of a clock that does not count seconds from
/// 1970 on.
///
/// * `time`: [s]
#[must_use]
pub fn day_of(time: f64) -> Option<String> {
    #[expect(clippy::cast_possible_truncation, reason = "a day has a second of its own")]
    let date = ERA.contains(&time).then(|| DateTime::from_timestamp(time as i64, 0))??;
    Some(date.date_naive().to_string())
}

/// A date with its time of day, in seconds since 1970; without an offset it is that of Greenwich.
pub(super) fn seconds_of_date(text: &str) -> Option<f64> {
    // Dates begin with a year of four digits: no other cell is looked at.
    if text.as_bytes().get(4) != Some(&b'-') {
        return None;
    }
    let with_offset = DateTime::parse_from_rfc3339(text).map(|it| it.naive_utc());
    let formats = ["%Y-%m-%dT%H:%M:%S%.f", "%Y-%m-%d %H:%M:%S%.f"].into_iter();
    let plain = || formats.map(|it| NaiveDateTime::parse_from_str(text, it)).find_map(Result::ok);
    let date = with_offset.ok().or_else(plain)?.and_utc();
    Some(date.timestamp() as f64 + f64::from(date.timestamp_subsec_nanos()) / 1e9)
}

/// Whether a text is a date or a time of day, as clocks show them, and none that is read: which of
/// its numbers is the day cannot be known.
pub(super) fn is_other_date(text: &str) -> bool {
    let has_parts = |text: &str, mark: char, least: usize| {
        let parts = || text.split(mark);
        let is_number = |it: &str| !it.is_empty() && it.bytes().all(|byte| byte.is_ascii_digit());
        parts().count() >= least && parts().take(least).all(is_number)
    };
    let day = text.split([' ', 'T', ',']).next().unwrap_or_default();
    // Months may have names, but for points: those stand in numbers, too.
    let has_two = |mark: char| mark != '.' && day.matches(mark).count() == 2;
    let is_day = |mark: char| has_parts(day, mark, 3) || has_two(mark);
    let is_clock = |it: &str| has_parts(it, ':', 2);
    let has_digit = text.bytes().any(|it| it.is_ascii_digit());
    has_digit && (['/', '-', '.'].into_iter().any(is_day) || text.split([' ', 'T']).any(is_clock))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_of_other_clocks_are_known_as_such() {
        for text in [
            "29/11/2026 10:00:00",
            "29.11.2026",
            "11-29-2026T10:00",
            "29-Nov-2026 10:00:00",
            "2026/11/29 10:00:00.5",
            "10:23:45.125",
            "Nov 29 10:23:45",
        ] {
            assert!(is_other_date(text) && seconds_of_date(text).is_none(), "{text}");
        }
        for text in ["", "soon", "x1", "1,5", "12.5.", "a:b", "--", "1e5x"] {
            assert!(!is_other_date(text), "{text}");
        }
    }

    #[test]
    fn dates_are_seconds_since_1970() {
        for (text, expected) in [
            ("1970-01-01T00:00:10Z", 10.0),
            ("1970-01-01T01:00:10.25+01:00", 10.25),
            ("1970-01-01 00:00:10.5", 10.5),
            ("1970-01-02T00:00:00", 86_400.0),
        ] {
            assert_eq!(seconds_of_date(text), Some(expected), "{text}");
        }
        for text in ["", "10", "1970", "1970-13-01T00:00:00Z", "yesterday", "2026-11-26"] {
            assert_eq!(seconds_of_date(text), None, "{text}");
        }
    }

    #[test]
    fn a_day_is_that_of_a_time_since_1970_and_of_no_other() {
        let noon = seconds_of_date("2026-11-27T12:00:00Z").expect("a date");
        assert_eq!(day_of(noon).as_deref(), Some("2026-11-27"));
        assert_eq!(day_of(noon + 43_200.0).as_deref(), Some("2026-11-28"));
        for time in [0.0, 3600.0, -noon, f64::NAN] {
            assert_eq!(day_of(time), None, "{time}");
        }
    }

    #[test]
    fn a_time_of_this_century_says_its_unit() {
        let now = 1.7e9;
        assert_eq!(TimeUnit::of(now), TimeUnit::Seconds);
        assert_eq!(TimeUnit::of(12.5), TimeUnit::Seconds);
        assert_eq!(TimeUnit::of(now * 1e3), TimeUnit::Milliseconds);
        assert_eq!(TimeUnit::of(now * 1e6), TimeUnit::Microseconds);
        assert_eq!(TimeUnit::of(now * 1e9), TimeUnit::Nanoseconds);
        assert_eq!(TimeUnit::of(1e300), TimeUnit::Seconds, "damage");
    }
}
