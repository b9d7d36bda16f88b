//! Where measurements are. They are not ours to publish, so they are not in the repository; without
//! them the tests that need them skip, which is no way to pass.

use std::path::{Path, PathBuf};

use crate::workspace;

/// The environment variable that names their folder, to the program and to the tests.
pub(crate) const VARIABLE: &str = "GROUSER_DATA_DIR";
/// The folder beside the checkout that is taken where the variable is not set.
const BESIDE: &str = "../shared/data";
/// The file that the tests need.
const FILE: &str = "cmu_single_wheel.csv";
/// What to read.
const GUIDE: &str = "docs/guide/data.md tells where the public data set is and how to lay it out";

/// The folder of measurements, as an absolute path: tests do not run where we do.
pub(crate) fn folder() -> Option<PathBuf> {
    chosen(std::env::var_os(VARIABLE).map(PathBuf::from), &workspace::root())
}

/// * `named`: the variable's value
fn chosen(named: Option<PathBuf>, root: &Path) -> Option<PathBuf> {
    match named.filter(|named| !named.as_os_str().is_empty()) {
        Some(named) => std::path::absolute(named).ok(),
        None => Some(root.join(BESIDE)).filter(|beside| beside.is_dir()),
    }
}

/// Whether the measurements are there; says where they were looked for.
pub(crate) fn check() -> bool {
    let Some(folder) = folder() else {
        println!(
            "there are no measurements: {VARIABLE} is not set, and there is no {BESIDE} beside the \
             checkout; {GUIDE}"
        );
        return false;
    };
    if std::env::var_os(VARIABLE).is_none_or(|named| named.is_empty()) {
        println!("{VARIABLE} is not set: taking {BESIDE}");
    }
    let found = folder.join(FILE).is_file();
    if found {
        println!("{FILE}: found");
    } else {
        println!(
            "there is no {FILE} in {}: the tests that need it would skip; {GUIDE}",
            folder.display()
        );
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_variable_goes_before_the_folder_beside() {
        let root = tempfile();
        assert_eq!(chosen(None, &root.join("checkout")), None);
        std::fs::create_dir_all(root.join("shared/data")).unwrap();
        std::fs::create_dir_all(root.join("checkout")).unwrap();
        let beside = chosen(None, &root.join("checkout"));
        assert_eq!(beside, Some(root.join("checkout").join(BESIDE)));
        assert_eq!(chosen(Some(PathBuf::new()), &root.join("checkout")), beside);
        let named = chosen(Some(PathBuf::from("mine")), &root.join("checkout")).unwrap();
        assert!(named.is_absolute() && named.ends_with("mine"));
        std::fs::remove_dir_all(root).unwrap();
    }

    fn tempfile() -> PathBuf {
        let folder = std::env::temp_dir().join(format!("grouser-xtask-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        folder
    }
}
