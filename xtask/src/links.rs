//! Links between the repository's Markdown files: the file and the heading must exist.

use std::collections::{HashMap, HashSet};

use crate::flaw::Flaw;
use crate::markdown::Page;
use crate::workspace;

/// Links that lead nowhere.
pub(crate) fn flaws(texts: &[(String, String)]) -> Vec<Flaw> {
    let files: HashSet<&str> = texts.iter().map(|(path, _)| path.as_str()).collect();
    let documents = texts.iter().filter(|(path, _)| workspace::has_extension(path, "md"));
    let pages: Vec<(&str, Page)> =
        documents.map(|(path, text)| (path.as_str(), Page::read(text))).collect();
    let headings: HashMap<&str, HashSet<String>> =
        pages.iter().map(|(path, page)| (*path, anchors(&page.headings))).collect();
    let mut flaws = Vec::new();
    for (path, page) in &pages {
        for (number, target) in &page.targets {
            if let Some(what) = flaw_of(path, target, &files, &headings) {
                flaws.push(Flaw::new(path, *number, what));
            }
        }
    }
    flaws
}

fn flaw_of(
    from: &str,
    target: &str,
    files: &HashSet<&str>,
    headings: &HashMap<&str, HashSet<String>>,
) -> Option<String> {
    if target.contains("://") || target.starts_with("mailto:") {
        return None;
    }
    let (file, anchor) = target.split_once('#').map_or((target, None), |(f, a)| (f, Some(a)));
    let Some(file) = (if file.is_empty() { Some(from.into()) } else { joined(from, file) }) else {
        return Some(format!("the link {target} leaves the repository"));
    };
    let is_folder = || {
        let folder = format!("{}/", file.trim_end_matches('/'));
        files.iter().any(|path| path.starts_with(&folder))
    };
    if !files.contains(file.as_str()) && !is_folder() {
        return Some(format!("the link {target} leads to no file"));
    }
    let anchor = anchor?;
    let known = headings.get(file.as_str()).is_some_and(|anchors| anchors.contains(anchor));
    (!known).then(|| format!("the link {target} leads to no heading"))
}

/// A path relative to a file, from the root; none where it leads out of the repository.
fn joined(from: &str, target: &str) -> Option<String> {
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for part in target.split('/') {
        match part {
            "." | "" => {}
            ".." => {
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

/// The anchors of a document's headings, as forges make them.
fn anchors(headings: &[String]) -> HashSet<String> {
    let mut anchors = HashSet::new();
    for title in headings {
        let anchor: String = title
            .trim()
            .to_lowercase()
            .chars()
            .filter_map(|c| match c {
                ' ' => Some('-'),
                c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c),
                _ => None,
            })
            .collect();
        // A title that occurs again gets a number.
        let mut free = anchor.clone();
        let mut count = 0;
        while anchors.contains(&free) {
            count += 1;
            free = format!("{anchor}-{count}");
        }
        anchors.insert(free);
    }
    anchors
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whats(from: &str, text: &str) -> Vec<String> {
        let texts = [
            (from.to_string(), text.to_string()),
            ("docs/b.md".into(), "# One, two\n## Again\n## Again\n".into()),
            ("docs/models/c.svg".into(), String::new()),
        ];
        flaws(&texts).into_iter().map(|flaw| flaw.what).collect()
    }

    #[test]
    fn links_that_lead_somewhere_pass() {
        for link in ["b.md", "./b.md#one-two", "b.md#again-1", "models/c.svg", "models", "#here"] {
            let text = format!("# Here\n[x]({link}) and ![y](models/c.svg \"title\")\n");
            assert!(whats("docs/a.md", &text).is_empty(), "{link}");
        }
        assert!(whats("a.md", "[x](docs/b.md)").is_empty());
        assert!(whats("docs/models/a.md", "[x](../b.md)").is_empty());
    }

    #[test]
    fn links_that_lead_nowhere_are_seen() {
        for link in ["c.md", "b.md#three", "../../b.md", "#there"] {
            assert_eq!(whats("docs/a.md", &format!("[x]({link})")).len(), 1, "{link}");
        }
    }

    #[test]
    fn code_holds_no_links() {
        assert!(whats("a.md", "`[x](nowhere.md)`\n```\n[x](nowhere.md)\n```\n").is_empty());
    }
}
