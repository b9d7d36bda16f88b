//! What the Python package requires, read from its `pyproject.toml`.

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

/// The package's own requirements and those of its extras, each list on a line of its own.
pub(crate) fn of_project(pyproject: &str) -> Vec<Requirement> {
    let mut section = "";
    let mut found = Vec::new();
    for line in pyproject.lines() {
        if line.starts_with('[') {
            section = line.trim();
            continue;
        }
        let Some((key, list)) = line.split_once(" = [") else { continue };
        let extra = match (section, key) {
            ("[project]", "dependencies") => "",
            ("[project.optional-dependencies]", extra) => extra,
            _ => continue,
        };
        let texts = list.split('"').skip(1).step_by(2);
        found.extend(texts.map(|text| Requirement { extra: extra.into(), text: text.into() }));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requirements_are_read_with_their_extras() {
        let text = "[build-system]\nrequires = [\"maturin>=1.16,<2\"]\n[project]\n\
                    dependencies = [\"numpy>=1.24\"]\n[project.optional-dependencies]\n\
                    data = [\"pandas>=2.0\", \"pyarrow>=15\"]\n";
        let requirements = of_project(text);
        let texts: Vec<(&str, String)> =
            requirements.iter().map(|one| (one.extra.as_str(), one.lowest())).collect();
        let expected = [("", "numpy==1.24"), ("data", "pandas==2.0"), ("data", "pyarrow==15")];
        assert_eq!(texts, expected.map(|(extra, text)| (extra, text.to_owned())));
    }
}
