//! What the Python package requires, read from its `pyproject.toml`.

use anyhow::{Context, Result};
use toml::Value;

/// A requirement such as `pandas>=2.0`, and the extra that it belongs to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Requirement {
    /// Empty for what the package always needs.
    pub(crate) extra: String,
    /// The name and its lower bound.
    pub(crate) text: String,
}

impl Requirement {
    /// The requirement of exactly its lower bound: `pandas==2.0`.
    pub(crate) fn lowest(&self) -> String {
        self.text.replacen(">=", "==", 1)
    }
}

/// The package's own requirements and those of its extras.
pub(crate) fn of_project(pyproject: &str) -> Result<Vec<Requirement>> {
    let pyproject: toml::Table = pyproject.parse()?;
    let project = pyproject.get("project").and_then(Value::as_table).context("[project]")?;
    let own = project.get("dependencies").map(|list| ("", list));
    let extras = project.get("optional-dependencies").and_then(Value::as_table);
    let extras = extras.into_iter().flatten().map(|(extra, list)| (extra.as_str(), list));
    let mut found = Vec::new();
    for (extra, list) in own.into_iter().chain(extras) {
        for text in list.as_array().context("requirements are a list")? {
            let text = text.as_str().context("a requirement is a text")?;
            found.push(Requirement { extra: extra.into(), text: text.into() });
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requirements_are_read_with_their_extras() {
        let text = "[build-system]\nrequires = [\"maturin>=1.16,<2\"]\n[project]\n\
                    dependencies = [\"numpy>=1.24\"]\n[project.optional-dependencies]\n\
                    data = [\"pandas>=2.0\", \"pyarrow>=15\"]\n";
        let requirements = of_project(text).expect("a project");
        let texts: Vec<(&str, String)> =
            requirements.iter().map(|one| (one.extra.as_str(), one.lowest())).collect();
        let expected = [("", "numpy==1.24"), ("data", "pandas==2.0"), ("data", "pyarrow==15")];
        assert_eq!(texts, expected.map(|(extra, text)| (extra, text.to_owned())));
    }
}
