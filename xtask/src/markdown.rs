//! The little of Markdown that the chores need to know: which lines are prose, which are code.

/// Tells fenced code from prose while lines go by.
#[derive(Default)]
pub(crate) struct Fences {
    open: Option<&'static str>,
}

impl Fences {
    /// Whether the next line is fenced code, or one of its fences.
    pub(crate) fn is_code(&mut self, line: &str) -> bool {
        let fence = ["```", "~~~"].into_iter().find(|fence| line.trim_start().starts_with(fence));
        match (self.open, fence) {
            (None, None) => return false,
            (None, Some(_)) => self.open = fence,
            (Some(_), Some(_)) if self.open == fence => self.open = None,
            (Some(_), _) => {}
        }
        true
    }
}

/// The lines of a text with their numbers from 1, without those of fenced code and its fences.
pub(crate) fn prose(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut fences = Fences::default();
    text.lines()
        .enumerate()
        .filter(move |(_, line)| !fences.is_code(line))
        .map(|(index, line)| (index + 1, line))
}

/// A line without what stands between backticks.
pub(crate) fn without_code(line: &str) -> String {
    line.split('`').step_by(2).collect::<Vec<_>>().join("``")
}

/// What stands between backticks in a line.
pub(crate) fn code_of(line: &str) -> impl Iterator<Item = &str> {
    line.split('`').skip(1).step_by(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fenced_code_is_no_prose() {
        let text = "one\n```rust\ntwo\n```\nthree\n~~~\n```\n~~~\nfour";
        let lines: Vec<_> = prose(text).collect();
        assert_eq!(lines, [(1, "one"), (5, "three"), (9, "four")]);
    }

    #[test]
    fn code_between_backticks_is_told_from_the_rest() {
        assert_eq!(code_of("a `b` c `d::e`").collect::<Vec<_>>(), ["b", "d::e"]);
        assert_eq!(without_code("a `b` c"), "a `` c");
    }
}
