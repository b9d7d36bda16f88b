//! Names of columns: which of them are x, y and z.

use crate::error::Flaw;
use crate::remark::Remark;

/// Names that the places and the heights have, in small letters and without a unit.
const X: [&str; 5] = ["x", "east", "easting", "e", "x_coord"];
const Y: [&str; 5] = ["y", "north", "northing", "n", "y_coord"];
const Z: [&str; 8] = ["z", "height", "heights", "elevation", "elev", "alt", "altitude", "h"];
/// Those of longitude and latitude.
const DEGREES: [&str; 5] = ["lon", "long", "longitude", "lat", "latitude"];
/// Words for the metre.
const METRES: [&str; 5] = ["m", "metre", "metres", "meter", "meters"];

/// Which columns of a text have x, y and z, from 0.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TextColumns {
    of: [usize; 3],
    /// What is taken for z, if it is not called so.
    height: Option<String>,
    unused: Vec<String>,
}

/// Whether a line is for people.
pub(super) fn is_comment(line: &str) -> bool {
    line.starts_with('#') || line.starts_with("//")
}

/// The names of columns that stand in a comment, if they do.
pub(super) fn of_comment(line: &str) -> Option<Vec<String>> {
    let names: Vec<String> =
        words(line.trim_start_matches(['#', '/'])).into_iter().map(str::to_owned).collect();
    let has = |known: &[&str]| names.iter().any(|name| known.contains(&&*parts(name).0));
    (has(&X) && has(&Y) && has(&Z)).then_some(names)
}

/// The words of a line: apart by semicolons, else by tabs, by commas, by spaces.
pub(super) fn words(line: &str) -> Vec<&str> {
    match [';', '\t', ','].into_iter().find(|it| line.contains(*it)) {
        Some(apart) => line.split(apart).map(bare).collect(),
        None => line.split_whitespace().map(bare).collect(),
    }
}

/// A word without quotation marks.
fn bare(word: &str) -> &str {
    word.trim().trim_matches('"').trim()
}

/// A name in small letters without its unit, and the unit.
fn parts(name: &str) -> (String, Option<String>) {
    let name = name.to_lowercase();
    let in_brackets = name.split_once(['[', '(']);
    let (name, unit) = match in_brackets {
        Some((name, unit)) => (name, Some(unit.trim_end_matches([']', ')']))),
        None => match name.rsplit_once('_') {
            Some((start, unit)) if unit.len() <= 2 => (start, Some(unit)),
            _ => (&*name, None),
        },
    };
    (name.trim().to_owned(), unit.map(|unit| unit.trim().to_owned()))
}

impl TextColumns {
    /// * `names`: of the first line, if there are any
    /// * `count`: of the words of the first point
    pub(super) fn of(names: Option<Vec<String>>, count: usize) -> Result<Self, Flaw> {
        if let Some(names) = names.filter(|names| names.len() == count) {
            return Self::named(&names);
        }
        let unused = (4..=count).map(|column| column.to_string()).collect();
        Ok(Self { of: [0, 1, 2], height: None, unused })
    }

    fn named(names: &[String]) -> Result<Self, Flaw> {
        let known: Vec<(String, Option<String>)> = names.iter().map(|name| parts(name)).collect();
        let shown = || listed(names);
        if let Some(at) = known.iter().position(|(name, _)| DEGREES.contains(&&**name)) {
            let problem = format!(
                "column {} is in degrees, and a rover needs metres: the columns are {}",
                shown_name(&names[at]),
                shown()
            );
            return Err(Flaw::with_hint(problem, |_| "gdalwarp projects a grid".to_owned()));
        }
        let column = |of: &[&str]| known.iter().position(|(name, _)| of.contains(&&**name));
        let (x, y, z) = (column(&X), column(&Y), column(&Z));
        let rest = |taken: &[usize]| -> Vec<usize> {
            (0..names.len()).filter(|column| !taken.contains(column)).collect()
        };
        let sought = || {
            format!(
                "its columns are {}: x, y and z in metres are sought, or easting, northing and \
                     height",
                shown()
            )
        };
        let (Some(x), Some(y)) = (x, y) else { return Err(sought().into()) };
        let others = rest(&[x, y]);
        let z_or_only = z.or(if let [only] = others[..] { Some(only) } else { None });
        let z_column = z_or_only.ok_or_else(sought)?;
        for column in [Some(x), Some(y), z].into_iter().flatten() {
            if let Some(unit) = known[column].1.as_deref().filter(|it| !METRES.contains(it)) {
                let name = shown_name(&names[column]);
                return Err(format!("column {name} is in {unit}, and a rover needs metres").into());
            }
        }
        let unused = rest(&[x, y, z_column]).into_iter().map(|it| shown_name(&names[it])).collect();
        let height = z.is_none().then(|| shown_name(&names[z_column]));
        Ok(Self { of: [x, y, z_column], height, unused })
    }

    /// What ought to be said of them.
    pub(super) fn remark(&self) -> Option<Remark> {
        match &self.height {
            Some(column) => Some(Remark::TakenForHeight { column: column.clone() }),
            None if self.unused.is_empty() => None,
            None => Some(Remark::UnusedColumns { columns: self.unused.clone() }),
        }
    }

    /// x, y and z of a line.
    pub(super) fn numbers(&self, words: &[&str]) -> Result<[f64; 3], String> {
        let number = |axis: usize, name: &str| {
            let word = words.get(self.of[axis]).filter(|word| !word.is_empty() || axis == 2);
            let word = word.ok_or_else(|| format!("it has no {name}: x, y and z are expected"))?;
            if word.is_empty() {
                return Ok(f64::NAN);
            }
            // Where commas do not stand between numbers, they stand in them.
            word.replace(',', ".")
                .parse()
                .map_err(|_| format!("{name} is no number: {}", shown_name(word)))
        };
        Ok([number(0, "x")?, number(1, "y")?, number(2, "z")?])
    }
}

/// A word of the file, fit to be shown.
fn shown_name(word: &str) -> String {
    word.chars().filter(|c| !c.is_control()).take(20).collect()
}

/// Names of columns, as many as are read at a glance.
fn listed(names: &[String]) -> String {
    const MOST: usize = 8;
    let names: Vec<String> = names.iter().map(|name| shown_name(name)).collect();
    let more = if names.len() > MOST { ", …" } else { "" };
    names[..names.len().min(MOST)].join(", ") + more
}
