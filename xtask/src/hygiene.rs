//! Finds texts that must not be in the repository: hosts that are not allowed, paths of one
//! machine, and letters with marks that browsers lose.

use crate::flaw::Flaw;

/// Hosts that a text may name. Another one is added here, on purpose, or stays out.
const HOSTS: [&str; 8] = [
    // The loopback.
    "127.0.0.1",
    "doi.org",
    "json-schema.org",
    "keepachangelog.com",
    // Positions of rovers on Mars.
    "planetarydata.jpl.nasa.gov",
    "semver.org",
    "www.apache.org",
    "www.w3.org",
];

/// First labels of host names from which package managers download.
const REGISTRY_LABELS: [&str; 4] = ["registry", "mirror", "proxy", "index"];

/// Folders at the root of a file system that hold one person's or one machine's files.
const MACHINE_FOLDERS: [&str; 6] = ["home", "root", "tmp", "work", "Users", "workspace"];

/// How the one source of packages that the lock file may name starts and ends.
const LOCKED_SOURCE: (&str, &str) = ("registry+", "/crates.io-index");

/// What is wrong in a file, by these rules.
///
/// * `own_host`: that of the project's address
pub(crate) fn flaws(path: &str, text: &str, own_host: &str) -> Vec<Flaw> {
    let mut flaws = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let mut found = |what: String| flaws.push(Flaw::new(path, index + 1, what));
        if path == "Cargo.lock" {
            if let Some(source) = line.strip_prefix("source = ")
                && !is_locked_source(source.trim_matches('"'))
            {
                found(format!("a package from another source: {source}"));
            }
            continue;
        }
        for host in url_hosts(line).filter(|host| !HOSTS.contains(host) && *host != own_host) {
            found(format!("the host {host} is not one that texts may name"));
        }
        for word in line.split(|c: char| !(c.is_ascii_alphanumeric() || "-.".contains(c))) {
            if names_a_registry(word) {
                found(format!("{word} looks like a package registry"));
            }
        }
        if let Some(mark) = line.chars().find(|&letter| is_combining(letter)) {
            let code = u32::from(mark);
            found(format!(
                "a combining mark (U+{code:04X}), which browsers lose: write TeX, or γ'"
            ));
        }
        if let Some(folder) = machine_folder(line) {
            found(format!("a path below /{folder} exists on one machine only"));
        }
    }
    flaws
}

fn is_locked_source(source: &str) -> bool {
    source.starts_with(LOCKED_SOURCE.0) && source.ends_with(LOCKED_SOURCE.1)
}

/// Hosts of the addresses in a line.
fn url_hosts(line: &str) -> impl Iterator<Item = &str> {
    line.split("://").skip(1).filter_map(|rest| {
        let ends = |c: char| !(c.is_ascii_alphanumeric() || "-._".contains(c));
        rest.split(ends).next().filter(|host| host.contains('.'))
    })
}

/// Whether a mark stands over the letter before it, such as the dot of a derivative: in the
/// monospaced fonts of browsers many are missing.
fn is_combining(letter: char) -> bool {
    ('\u{0300}'..='\u{036F}').contains(&letter)
}

fn names_a_registry(word: &str) -> bool {
    let labels: Vec<&str> = word.trim_end_matches('.').split('.').collect();
    // A file such as `index.html` has two labels, a host with such a first label has three.
    labels.len() >= 3
        && REGISTRY_LABELS.contains(&labels[0])
        && labels.iter().all(|label| label.starts_with(|c: char| c.is_ascii_lowercase()))
}

fn machine_folder(line: &str) -> Option<&'static str> {
    MACHINE_FOLDERS.into_iter().find(|folder| {
        let path = format!("/{folder}/");
        line.match_indices(&path).any(|(at, _)| {
            // Within a longer path it is a folder like any other.
            !line[..at].ends_with(|c: char| c.is_alphanumeric() || "._-/}*)".contains(c))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whats(text: &str) -> Vec<String> {
        flaws("a.md", text, "git.example").into_iter().map(|flaw| flaw.what).collect()
    }

    #[test]
    fn only_agreed_hosts_pass() {
        assert!(whats("see https://doi.org/10.1002/rob.20187").is_empty());
        assert!(whats("see https://git.example/grouser").is_empty());
        assert_eq!(whats(&format!("see https:{}example.org/x", "//")).len(), 1);
    }

    #[test]
    fn registries_are_seen_without_an_address_too() {
        assert_eq!(whats(&format!("from {}.example.com", "mirror")).len(), 1);
        assert!(whats("index.html, rows.index.x, self.index.len()").is_empty());
    }

    #[test]
    fn marks_over_letters_are_seen() {
        assert_eq!(whats("the rate γ\u{0307} of the yaw").len(), 1);
        assert!(whats("the rate γ' of the yaw, Größe").is_empty());
    }

    #[test]
    fn paths_of_a_machine_are_seen_and_relative_ones_pass() {
        for folder in MACHINE_FOLDERS {
            assert_eq!(whats(&format!("see `/{folder}/x`")).len(), 1, "{folder}");
            assert_eq!(whats(&format!("see `docs/{folder}/x`")).len(), 0, "{folder}");
        }
    }

    #[test]
    fn locked_packages_come_from_one_source() {
        let (start, end) = LOCKED_SOURCE;
        let line = format!("source = \"{start}somewhere{end}\"\n");
        assert!(flaws("Cargo.lock", &line, "").is_empty());
        assert_eq!(flaws("Cargo.lock", "source = \"git+somewhere\"\n", "").len(), 1);
    }
}
