//! What one thing is declared more than once for: counts that may only fall.
//!
//! Sources are read as text, without their comments and tests; what is counted is a word that gives
//! the thing away, so that a count is comparable with the one before, and no more.

use std::collections::BTreeMap;

/// A count, and the most that it may be.
pub(super) struct Home {
    pub(super) what: &'static str,
    pub(super) most: usize,
    pub(super) found: usize,
}

/// How something is counted.
type Rule = fn(&Sources) -> usize;

/// What is counted, the most that there may be, and by which rule. A limit only ever gets smaller.
///
/// Lines of Rust were 98,800 at the most before strings were wrapped at a hundred columns (some 500
/// more) and before ten commands had questions in the library (some 700 more); they were 101,600
/// before routes had profiles, pages pictures and slides, and logs readers of any order, and 105,000
/// before messages of ROS, tables by mappings, robots of URDF as people describe them, watched logs
/// and checks of where a reading is from; lines of Python were 8,150 before those. Recorded drives as
/// a referee and what maps mean took 2,000 lines and three conversions; the C interface, whose names
/// are those of what it wraps, and derivatives 3,100 lines, eight conversions and a dozen names; designs
/// 1,700 lines and an answer's inputs, turns that are judged and rules of exchanges 400; FMUs and states
/// as bytes 2,200 of 2,700 at once; the console 2,500, and two names that traits of its server ask for.
/// States as values in Python, linearised steps and numbers out of range took 300 lines of Rust, 210 of
/// Python, a conversion, and the four arrays of a linearised step, which is no table. What files gave,
/// rows of units, Parquet by mappings, derivatives through PyTorch, and hints took 900 of Rust and 100
/// of Python. Drives of several files, with hints as data, took 480; tables parted by bars, times that
/// fall and refusals by name 420; faults that no soil explains 330, bounds of readers that were tried in
/// one process 150; a reader of Arrow, whose library would take a fifth of the first build, 470;
/// stresses that are refused in their own unit a conversion. Maps that mean the same by file, array and
/// text, drives of public data sets, robots of other formats and Python, control steps through JAX and
/// PyTorch, and designs that say what stands against them took 1,950 of Rust, 220 of Python, a name and a
/// conversion. Designs, campaigns, fits and missions on the console took 980, its server's bounds and files
/// that are opened from their folder 400, digests by other processors 100, and numbers that are tied or
/// vary 150 of Rust and 40 of Python. Drives in three dimensions on the console took 40, logs
/// on it 150, and random commands that are timed and engines' steps that begin near their end 110.
/// Wheels on uneven ground that settle together and starts that are followed took 490,
/// drives by hand, trials left out and what newcomers asked of the console 530, its first two views
/// without a server 130, and a card that it saves and steps that any cutting leaves as they are 230.
/// Studies of many entries, whatever varies, took 300 and 500 of Python, of which half are signatures;
/// parts of a log with their causes, force arrows in scenes, fits and ends of designs on the console 500,
/// and a conversion, of the slope in the command that reads a saved drive.
/// Searches that begin where velocities are expected, and records that begin where those before point
/// to, took 210; starts that go straight, and tangents that steps bring up to date, 80.
const COUNTS: [(&str, usize, Rule); 9] = [
    ("lines of Rust without comments and tests", 132_330, |all| all.rust.iter().map(lines).sum()),
    ("lines of Python without comments and tests", 9_600, |all| all.python.iter().map(lines).sum()),
    ("files that name three outcomes or more as text", 1, outcome_homes),
    ("inputs of an answer written by hand (`fn settings`, `fn state`)", 18, |all| {
        all.rust_count("fn settings(") + all.rust_count("fn state(&self, answer")
    }),
    ("records of results beside column tables (`derive(Serialize)`)", 43, |all| {
        all.rust.iter().map(|(_, text)| text.matches("Serialize)]").count()).sum()
    }),
    ("columns of results written by hand in Python", 235, python_columns),
    ("conversions of units above the documents", 163, conversions),
    ("names of types used more than once", 203, |all| repeated(&all.type_names())),
    ("names of types used more than once in one crate", 101, |all| {
        all.type_names_by_crate().values().map(repeated).sum()
    }),
];

/// The sources of what is shipped, as paths from the root and texts without comments and tests.
pub(super) struct Sources {
    rust: Vec<(String, String)>,
    python: Vec<(String, String)>,
}

/// Counts everything.
pub(super) fn counted(sources: &Sources) -> Vec<Home> {
    let home = |&(what, most, count): &(_, _, Rule)| Home { what, most, found: count(sources) };
    COUNTS.iter().map(home).collect()
}

impl Sources {
    /// * `rust`, `python`: all of the repository, as paths from its root and texts
    pub(super) fn of(rust: &[(String, String)], python: &[(String, String)]) -> Self {
        let is_shipped = |path: &str| path.starts_with("crates/") && path.contains("/src/");
        let rust = rust.iter().filter(|(path, _)| is_shipped(path) && !path.contains("/tests"));
        let in_package = "crates/grouser-python/python/";
        let python = python.iter().filter(|(path, _)| path.starts_with(in_package));
        Self {
            rust: rust.map(|(path, text)| (path.clone(), shipped_rust(text))).collect(),
            python: python.map(|(path, text)| (path.clone(), shipped_python(text))).collect(),
        }
    }

    fn rust_count(&self, word: &str) -> usize {
        self.rust.iter().map(|(_, text)| text.matches(word).count()).sum()
    }

    /// How often each name of a type is declared, crate by crate.
    fn type_names_by_crate(&self) -> BTreeMap<&str, BTreeMap<&str, usize>> {
        let mut crates: BTreeMap<&str, BTreeMap<&str, usize>> = BTreeMap::new();
        for (path, text) in &self.rust {
            let name = path.split('/').nth(1).unwrap_or_default();
            for declared in text.lines().filter_map(declared_type) {
                *crates.entry(name).or_default().entry(declared).or_default() += 1;
            }
        }
        crates
    }

    fn type_names(&self) -> BTreeMap<&str, usize> {
        let mut all: BTreeMap<&str, usize> = BTreeMap::new();
        for (name, count) in self.type_names_by_crate().values().flatten() {
            *all.entry(name).or_default() += count;
        }
        all
    }
}

fn repeated(names: &BTreeMap<&str, usize>) -> usize {
    names.values().filter(|count| **count > 1).count()
}

/// Lines that say something.
fn lines((_, text): &(String, String)) -> usize {
    text.lines().filter(|line| !line.trim().is_empty()).count()
}

/// The type that a line declares.
fn declared_type(line: &str) -> Option<&str> {
    let line = line.trim_start();
    let after_visibility = match line.strip_prefix("pub") {
        Some(rest) if rest.starts_with('(') => rest.split_once(") ")?.1,
        Some(rest) => rest.strip_prefix(' ')?,
        None => line,
    };
    let rest =
        ["struct ", "enum ", "trait "].iter().find_map(|it| after_visibility.strip_prefix(it))?;
    rest.split(|it: char| !it.is_alphanumeric() && it != '_').next()
}

/// A source without its comments and its modules of tests.
fn shipped_rust(text: &str) -> String {
    let mut kept = String::new();
    let mut in_tests = false;
    for line in text.lines() {
        in_tests |= line == "#[cfg(test)]";
        if !in_tests && !line.trim_start().starts_with("//") {
            kept.push_str(line);
            kept.push('\n');
        }
        in_tests &= line != "}" && (line.starts_with(' ') || !line.ends_with(';'));
    }
    kept
}

/// A source without its comments and docstrings.
fn shipped_python(text: &str) -> String {
    let mut kept = String::new();
    let mut in_docstring = false;
    for line in text.lines() {
        let quotes = line.matches("\"\"\"").count();
        let starts = line.trim_start().trim_start_matches('r').starts_with("\"\"\"");
        let is_docstring = in_docstring || starts;
        if quotes == 1 && (in_docstring || starts) {
            in_docstring = !in_docstring;
        }
        if !is_docstring && !line.trim_start().starts_with('#') {
            kept.push_str(line);
            kept.push('\n');
        }
    }
    kept
}

/// Files that name several outcomes of a run as text: each of them would have to learn of a new
/// one.
fn outcome_homes(sources: &Sources) -> usize {
    const OUTCOMES: [&str; 6] =
        ["immobilised", "tipped_over", "tipped-over", "left_terrain", "high_centred", "completed"];
    let names = |text: &str| {
        OUTCOMES.iter().filter(|name| text.contains(&format!("\"{name}\""))).count() >= 3
    };
    sources.rust.iter().chain(&sources.python).filter(|(_, text)| names(text)).count()
}

/// Fields of Python's results that hold arrays: each is a column that Rust declares as well.
fn python_columns(sources: &Sources) -> usize {
    let is_column = |line: &&str| {
        let field = line.strip_prefix("    ").and_then(|line| line.split_once(": "));
        field.is_some_and(|(name, kind)| {
            let is_name = |it: char| it.is_alphanumeric() || it == '_';
            name.chars().all(is_name) && (kind.starts_with("Floats") || kind.starts_with("NDArray"))
        })
    };
    sources.python.iter().flat_map(|(_, text)| text.lines()).filter(is_column).count()
}

/// Conversions of units in front ends and studies, whose writers alone should need them.
fn conversions(sources: &Sources) -> usize {
    const WORDS: [&str; 4] = [".to_degrees()", ".to_radians()", "unit.from_si(", "unit.to_si("];
    let is_above = |path: &str| !path.contains("grouser-core") && !path.contains("grouser-io");
    let above = sources.rust.iter().filter(|(path, _)| is_above(path));
    above.map(|(_, text)| WORDS.iter().map(|word| text.matches(word).count()).sum::<usize>()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sources(rust: &[(&str, &str)], python: &[(&str, &str)]) -> Sources {
        let owned = |all: &[(&str, &str)]| -> Vec<(String, String)> {
            all.iter().map(|(path, text)| ((*path).into(), (*text).into())).collect()
        };
        Sources::of(&owned(rust), &owned(python))
    }

    #[test]
    fn comments_and_tests_do_not_count() {
        let text =
            "//! A doc.\nstruct A;\n\n// Why.\n#[cfg(test)]\nmod tests {\n    struct A;\n}\n";
        let all = sources(&[("crates/a/src/lib.rs", text), ("crates/a/tests/x.rs", text)], &[]);
        assert_eq!(all.rust.iter().map(lines).sum::<usize>(), 1);
        assert_eq!(repeated(&all.type_names()), 0);
    }

    #[test]
    fn a_name_is_repeated_within_a_crate_or_across() {
        let (one, two) = ("pub(crate) struct A;\nenum B {}\n", "pub struct A;\nstruct B;\n");
        let across = sources(&[("crates/a/src/lib.rs", one), ("crates/b/src/lib.rs", two)], &[]);
        assert_eq!(repeated(&across.type_names()), 2);
        assert_eq!(across.type_names_by_crate().values().map(repeated).sum::<usize>(), 0);
        let within = sources(&[("crates/a/src/x.rs", one), ("crates/a/src/y.rs", two)], &[]);
        assert_eq!(within.type_names_by_crate().values().map(repeated).sum::<usize>(), 2);
    }

    #[test]
    fn pythons_columns_are_fields_of_arrays() {
        let text = "class A:\n    \"\"\"Of\n    x: Floats\n    \"\"\"\n    y: Floats\n    z: int\n";
        let all = sources(&[], &[("crates/grouser-python/python/grouser/_a.py", text)]);
        assert_eq!(python_columns(&all), 1);
        assert_eq!(all.python.iter().map(lines).sum::<usize>(), 3);
    }
}
