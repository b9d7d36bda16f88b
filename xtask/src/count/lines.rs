//! How many lines of Rust a package has, and how many of them are tests.

use std::collections::HashSet;

/// Lines of Rust.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Lines {
    /// What is shipped, comments and empty lines included.
    pub(super) code: usize,
    /// Tests, benches and examples.
    pub(super) tests: usize,
}

/// Folders of a package whose sources are not shipped.
const FOLDERS: [&str; 3] = ["tests/", "benches/", "examples/"];

impl Lines {
    /// * `sources`: paths from the package's folder, and texts
    pub(super) fn of(sources: &[(&str, &str)]) -> Self {
        let split: Vec<_> = sources.iter().map(|(path, text)| (*path, Split::of(text))).collect();
        // A module of tests in a file of its own: `a.rs` or `a/mod.rs`, beside or below who
        // declares it.
        let modules: HashSet<String> = split
            .iter()
            .flat_map(|(path, split)| {
                let stem = path.trim_end_matches(".rs");
                let folder = stem.rsplit_once('/').map_or("", |(folder, _)| folder);
                let is_root = ["lib", "main", "mod"].iter().any(|root| stem.ends_with(root));
                let below = if is_root { folder } else { stem };
                split.modules.iter().map(move |name| format!("{below}/{name}.rs"))
            })
            .collect();
        let mut lines = Self::default();
        for (path, split) in &split {
            let is_test = FOLDERS.iter().any(|folder| path.starts_with(folder));
            if is_test || modules.contains(*path) {
                lines.tests += split.code + split.tests;
            } else {
                lines.code += split.code;
                lines.tests += split.tests;
            }
        }
        lines
    }
}

/// A source in two parts.
#[derive(Debug, Default, PartialEq)]
struct Split<'t> {
    code: usize,
    tests: usize,
    /// Modules of tests in files of their own.
    modules: Vec<&'t str>,
}

impl<'t> Split<'t> {
    /// Sources are formatted: a module of tests begins with `#[cfg(test)]` at the start of a line,
    /// and ends with a brace there.
    fn of(text: &'t str) -> Self {
        let mut split = Self::default();
        let mut in_tests = false;
        for line in text.lines() {
            in_tests |= line == "#[cfg(test)]";
            if in_tests {
                split.tests += 1;
            } else {
                split.code += 1;
            }
            let declared = line.split_once("mod ").and_then(|(_, rest)| rest.strip_suffix(';'));
            if in_tests && !line.starts_with(' ') {
                split.modules.extend(declared);
            }
            in_tests &= line != "}" && (line.starts_with(' ') || !line.ends_with(';'));
        }
        split
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tests_are_told_from_what_is_shipped() {
        let source = "fn f() {\n}\n\n#[cfg(test)]\nmod tests {\n    use super::*;\n}\n";
        assert_eq!(Split::of(source), Split { code: 3, tests: 4, modules: vec![] });
        let declaring = "#[cfg(test)]\nmod certified;\nfn f() {}\n";
        assert_eq!(Split::of(declaring), Split { code: 1, tests: 2, modules: vec!["certified"] });
        let sources = [
            ("src/lib.rs", source),
            ("src/a.rs", declaring),
            ("src/a/certified.rs", "one\ntwo\n"),
            ("tests/it/main.rs", "one\n"),
        ];
        assert_eq!(Lines::of(&sources), Lines { code: 4, tests: 9 });
    }
}
