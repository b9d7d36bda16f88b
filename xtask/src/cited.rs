//! Code and works that are cited, and the ledger of equations: what they name must exist.

use std::collections::HashMap;

use crate::flaw::Flaw;
use crate::markdown::Page;
use crate::workspace;

/// Where paths that start with `crate::` lead: the crates of the library, which re-exports all of
/// them.
const SOURCES: [&str; 3] =
    ["crates/grouser/src", "crates/grouser-io/src", "crates/grouser-core/src"];
/// The ledger of the source paper's equations.
const LEDGER: &str = "docs/equations.md";
/// The list of the works that code and documents cite, a heading for each.
const BIBLIOGRAPHY: &str = "docs/bibliography.md";
/// Names of works that do not end in their year.
const WITHOUT_YEAR: [&str; 2] = ["FourWheel", "LunarSourcebook"];
/// The numbers of its equations; the paper numbers two of them 10.
const EQUATIONS: [u32; 19] = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 10, 11, 12, 13, 14, 15, 16, 17, 18];

/// Paths of documents that lead to nothing, works that the bibliography lacks, and equations
/// missing from the ledger.
pub(crate) fn flaws(texts: &[(String, String)]) -> Vec<Flaw> {
    let sources: HashMap<&str, &str> = texts
        .iter()
        .filter(|(path, _)| SOURCES.iter().any(|folder| path.starts_with(folder)))
        .map(|(path, text)| (path.as_str(), text.as_str()))
        .collect();
    let mut flaws = unlisted(texts);
    for (path, text) in texts.iter().filter(|(path, _)| workspace::has_extension(path, "md")) {
        for (number, code) in Page::read(text).codes {
            if code.starts_with("crate::") && !exists(&code, &sources) {
                flaws.push(Flaw::new(path, number, format!("there is no {code}")));
            }
        }
        if path == LEDGER {
            flaws.extend(missing_equations(text));
        }
    }
    flaws
}

/// Works that are cited and have no heading in the bibliography; and, in a document, citations
/// without the line that links them there.
fn unlisted(texts: &[(String, String)]) -> Vec<Flaw> {
    let listed: Vec<String> = texts
        .iter()
        .filter(|(path, _)| path == BIBLIOGRAPHY)
        .flat_map(|(_, text)| Page::read(text).headings)
        .collect();
    let mut flaws = Vec::new();
    for (path, text) in texts {
        let is_page = workspace::has_extension(path, "md");
        if !is_page && !["rs", "toml"].iter().any(|kind| workspace::has_extension(path, kind)) {
            continue;
        }
        for (index, line) in text.lines().enumerate() {
            for work in works(line) {
                let mut found = |what| flaws.push(Flaw::new(path, index + 1, what));
                if !listed.iter().any(|listed| listed == work) {
                    found(format!("{BIBLIOGRAPHY} has no {work}"));
                } else if is_page && !text.contains(&format!("\n[{work}]: ")) {
                    found(format!(
                        "[{work}] is not linked: its address stands at the end of the file"
                    ));
                }
            }
        }
    }
    flaws
}

/// Names of works that a line cites, such as Ishigami2007 where it stands in brackets.
fn works(line: &str) -> impl Iterator<Item = &str> {
    line.split('[').skip(1).filter_map(|rest| {
        let name = rest.split_once(']')?.0;
        is_work(name).then_some(name)
    })
}

/// Whether a name is one by which works are cited.
pub(crate) fn is_work(name: &str) -> bool {
    let author = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let has_year = name.len() == author.len() + 4
        && author.len() > 2
        && author.starts_with(|c: char| c.is_ascii_uppercase())
        && author.chars().all(|c| c.is_ascii_alphabetic());
    has_year || WITHOUT_YEAR.contains(&name)
}

/// Whether a path such as `crate::contact::slip::slip_ratio` or `crate::soil::Soil::check` names
/// something that the sources define.
fn exists(path: &str, sources: &HashMap<&str, &str>) -> bool {
    SOURCES.iter().any(|folder| exists_below(folder, path, sources))
}

fn exists_below(folder: &str, path: &str, sources: &HashMap<&str, &str>) -> bool {
    let mut place = folder.to_string();
    let mut text = sources.get(format!("{folder}/lib.rs").as_str()).copied();
    let mut names = path.trim_end_matches("()").split("::").skip(1).peekable();
    while let Some(name) = names.peek() {
        let Some(module) = sources.get(format!("{place}/{name}.rs").as_str()) else { break };
        place = format!("{place}/{name}");
        text = Some(*module);
        names.next();
    }
    let Some(text) = text else { return false };
    names.all(|name| text.lines().any(|line| defines(line, name)))
}

/// Whether a line of Rust defines a name: an item, a variant or a field.
fn defines(line: &str, name: &str) -> bool {
    let line = line.trim_start();
    let (public, line) = match line.strip_prefix("pub") {
        Some(rest) if rest.starts_with('(') => {
            (true, rest.split_once(") ").map_or(rest, |(_, rest)| rest))
        }
        Some(rest) => (true, rest.trim_start()),
        None => (false, line),
    };
    const ITEMS: [&str; 9] =
        ["const fn ", "fn ", "struct ", "enum ", "trait ", "type ", "const ", "static ", "mod "];
    let item = ITEMS.iter().find_map(|keyword| line.strip_prefix(keyword));
    let Some(rest) = item.unwrap_or(line).strip_prefix(name) else { return false };
    let is_field = public && rest.starts_with(": ");
    let is_variant = name.starts_with(char::is_uppercase)
        && (rest.starts_with([',', '(']) || rest.starts_with(" {"));
    if item.is_some() {
        !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_')
    } else {
        is_field || is_variant
    }
}

fn missing_equations(ledger: &str) -> Vec<Flaw> {
    let mut missing = Vec::new();
    for number in 1..=18 {
        let wanted = EQUATIONS.iter().filter(|equation| **equation == number).count();
        let row = format!("| ({number})");
        let rows = ledger.lines().filter(|line| line.starts_with(&row)).count();
        if rows < wanted {
            let what = format!("Equation ({number}) has {rows} rows, it needs {wanted}");
            missing.push(Flaw::new(LEDGER, 1, what));
        }
    }
    missing
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLIP: &str = "\
pub(super) const FAST: f64 = 1.0;
pub fn slip_ratio(rim: f64) -> f64 {
    slip_angle(rim)
}
pub enum Law {
    Printed(f64),
    Corrected,
}
pub struct Slip {
    pub ratio: f64,
}
";

    fn check_exists(path: &str, expected: bool) {
        let sources = HashMap::from([
            ("crates/grouser/src/lib.rs", "pub mod contact;\n"),
            ("crates/grouser/src/contact.rs", "pub mod slip;\n"),
            ("crates/grouser/src/contact/slip.rs", SLIP),
        ]);
        assert_eq!(exists(path, &sources), expected, "{path}");
    }

    #[test]
    fn what_is_defined_exists() {
        for path in [
            "crate::contact",
            "crate::contact::slip",
            "crate::contact::slip::slip_ratio",
            "crate::contact::slip::slip_ratio()",
            "crate::contact::slip::Law::Printed",
            "crate::contact::slip::Law::Corrected",
            "crate::contact::slip::Slip::ratio",
            "crate::contact::slip::FAST",
        ] {
            check_exists(path, true);
        }
    }

    #[test]
    fn what_is_only_used_or_misspelt_does_not() {
        for path in [
            "crate::contacts",
            "crate::contact::slip::slip_angle",
            "crate::contact::slip::slip_rat",
            "crate::contact::slip::Law::Print",
            "crate::contact::slip_ratio",
        ] {
            check_exists(path, false);
        }
    }

    #[test]
    fn a_work_is_cited_by_its_name_in_brackets() {
        let line = "by [Hegedus1960] and [FourWheel], not `a[0]`, [link](x.md) or [ABC2]";
        assert_eq!(works(line).collect::<Vec<_>>(), ["Hegedus1960", "FourWheel"]);
    }

    #[test]
    fn works_need_a_heading_and_pages_a_link() {
        let work = format!("[{}2007]", "Ishigami");
        let flaws = |path: &str, text: String| {
            let list = (BIBLIOGRAPHY.to_owned(), "# List\n## Ishigami2007\n".to_owned());
            unlisted(&[list, (path.to_owned(), text)]).len()
        };
        assert_eq!(flaws("a.rs", format!("// {work}")), 0);
        assert_eq!(flaws("a.rs", format!("// [{}2007]", "Another")), 1);
        assert_eq!(flaws("a.md", format!("{work}\n\n{work}: list.md\n")), 0);
        assert_eq!(flaws("a.md", format!("{work}\n")), 1);
    }

    #[test]
    fn the_ledger_needs_a_row_for_every_equation() {
        let rows = EQUATIONS.map(|number| format!("| ({number}) | x |\n"));
        assert!(missing_equations(&rows.concat()).is_empty());
        assert_eq!(missing_equations(&rows[1..].concat()).len(), 1);
        let without_one_ten = [&rows[..9], &rows[10..]].concat().concat();
        assert_eq!(missing_equations(&without_one_ten).len(), 1);
    }
}
