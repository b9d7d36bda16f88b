//! Counts what test programs report.

use std::fmt::{self, Display, Formatter};
use std::ops::AddAssign;

/// How many checks passed and failed, and how many were not made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Count {
    pub(crate) passed: u64,
    pub(crate) failed: u64,
    /// Not made, for want of something that the machine lacks or because only `ci --full` makes
    /// them.
    pub(crate) skipped: u64,
}

impl Count {
    /// One check.
    pub(crate) fn one(passed: bool) -> Self {
        Self { passed: u64::from(passed), failed: u64::from(!passed), skipped: 0 }
    }

    /// One check that was not made.
    pub(crate) fn skipped() -> Self {
        Self { skipped: 1, ..Self::default() }
    }

    /// The counts of the last line that another process of this program printed, see `Display`;
    /// without one, it failed.
    pub(crate) fn of_closing_line(output: &str) -> Self {
        let line = output.lines().last().unwrap_or_default();
        let number_before = |word: &str| -> Option<u64> {
            line.split(", ").find_map(|part| part.strip_suffix(word)?.parse().ok())
        };
        let counts = number_before(" passed").zip(number_before(" failed"));
        let skipped = number_before(" skipped").unwrap_or(0);
        counts.map_or(Self::one(false), |(passed, failed)| Self { passed, failed, skipped })
    }

    /// The tests of a test run that ended well or not.
    ///
    /// A run that failed without a failed test (it did not compile, or a test program crashed)
    /// counts as one failure.
    pub(crate) fn of_run(output: &str, succeeded: bool) -> Self {
        let mut count = Self::default();
        for line in output.lines() {
            if let Some(of_one_program) = result_of(line) {
                count += of_one_program;
            }
        }
        if count.failed == 0 && !succeeded {
            count.failed = 1;
        }
        count
    }
}

impl AddAssign for Count {
    fn add_assign(&mut self, other: Self) {
        self.passed += other.passed;
        self.failed += other.failed;
        self.skipped += other.skipped;
    }
}

impl Display for Count {
    /// The closing line: `N passed, N failed`, and what was skipped if anything was.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{} passed, {} failed", self.passed, self.failed)?;
        if self.skipped > 0 {
            write!(f, ", {} skipped", self.skipped)?;
        }
        Ok(())
    }
}

/// The counts of a line `test result: ok. 3 passed; 0 failed; …`.
fn result_of(line: &str) -> Option<Count> {
    let result = line.trim().strip_prefix("test result: ")?;
    let (_verdict, counts) = result.split_once(". ")?;
    let number_before = |word: &str| {
        counts.split(';').find_map(|part| part.trim().strip_suffix(word)?.trim().parse().ok())
    };
    Some(Count {
        passed: number_before("passed")?,
        failed: number_before("failed")?,
        skipped: number_before("ignored")?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const OUTPUT: &str = "\
running 2 tests
test a ... ok
test result: ok. 2 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.01s

test result: FAILED. 10 passed; 3 failed; 0 ignored; 0 measured; 0 filtered out; finished in 2.5s
";

    #[test]
    fn the_results_of_all_test_programs_add_up() {
        assert_eq!(Count::of_run(OUTPUT, false), Count { passed: 12, failed: 3, skipped: 1 });
    }

    #[test]
    fn a_line_that_only_looks_like_a_result_is_none() {
        for line in ["test result of the day", "test result: ok. many passed", "2 passed; 0 failed"]
        {
            assert_eq!(result_of(line), None, "{line}");
        }
    }

    #[test]
    fn a_run_that_crashed_has_failed() {
        let crashed = "test result: ok. 2 passed; 0 failed; 0 ignored; 0 measured";
        assert_eq!(Count::of_run(crashed, false), Count { passed: 2, failed: 1, skipped: 0 });
    }

    #[test]
    fn the_closing_line_names_skipped_checks_only_if_there_are_any() {
        let mut count = Count { passed: 3, failed: 1, skipped: 0 };
        assert_eq!(count.to_string(), "3 passed, 1 failed");
        count += Count::skipped();
        assert_eq!(count.to_string(), "3 passed, 1 failed, 1 skipped");
        assert_eq!(Count::of_closing_line(&format!("a\n{count}\n")), count);
        assert_eq!(Count::of_closing_line("3 passed, 0 failed\nkilled"), Count::one(false));
    }
}
