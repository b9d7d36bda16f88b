//! The project's address, stated once, as `repository` in the workspace's `Cargo.toml`. Files that
//! must name it themselves, such as `CITATION.cff`, name the same one.

use crate::flaw::Flaw;

/// Where the address is stated.
const HOME: &str = "Cargo.toml";

/// The address that the workspace's manifest states.
pub(crate) fn of(texts: &[(String, String)]) -> Option<&str> {
    let (_, manifest) = texts.iter().find(|(path, _)| path == HOME)?;
    let stated = |line: &str| line.starts_with("repository = ");
    manifest.lines().find(|line| stated(line))?.split('"').nth(1)
}

/// The host of an address.
pub(crate) fn host(address: &str) -> &str {
    let rest = address.split_once("://").map_or(address, |(_, rest)| rest);
    rest.split('/').next().unwrap_or(rest)
}

/// Other addresses at the project's host.
pub(crate) fn flaws(texts: &[(String, String)]) -> Vec<Flaw> {
    let Some(address) = of(texts) else {
        return vec![Flaw::new(HOME, 1, "`repository` of the workspace is missing".to_owned())];
    };
    let mut flaws = Vec::new();
    for (path, text) in texts {
        for (index, line) in text.lines().enumerate() {
            let there = line.matches(&format!("://{}/", host(address))).count();
            if there > line.matches(address).count() {
                let what = format!("the project's address is {address}, by {HOME}");
                flaws.push(Flaw::new(path, index + 1, what));
            }
        }
    }
    flaws
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whats(text: &str) -> Vec<String> {
        let manifest = format!("[workspace.package]\nrepository = \"https:{}a.example/b\"\n", "//");
        let texts = [(HOME.to_owned(), manifest), ("README.md".to_owned(), text.to_owned())];
        flaws(&texts).into_iter().map(|flaw| flaw.what).collect()
    }

    #[test]
    fn the_address_is_the_same_everywhere() {
        assert!(whats(&format!("git clone https:{}a.example/b.git", "//")).is_empty());
        assert_eq!(whats(&format!("git clone https:{}a.example/c.git", "//")).len(), 1);
    }

    #[test]
    fn a_manifest_without_an_address_is_seen() {
        assert_eq!(flaws(&[(HOME.to_owned(), "[workspace]\n".to_owned())]).len(), 1);
    }
}
