//! What files gave to a drive: which of their zones it met.

use super::given_file::{FileContent, GivenFile};
use super::{Document, Loaded};
use crate::simulation::{Scenario, Trajectory};
use crate::studies::zones_met::zones_met;

/// What the files gave that the document of some drives names, with the zones that they met.
///
/// * `document`: of a scenario or a mission
/// * `scenario`: of it
#[must_use]
pub fn given_to_drives<'r, V>(
    document: &Loaded<V>,
    scenario: &Scenario,
    drives: impl IntoIterator<Item = &'r Trajectory>,
) -> Vec<GivenFile> {
    let mut given = document.given.clone();
    let of_zones =
        |it: &&mut GivenFile| matches!(it.content, FileContent::Zones | FileContent::ZoneCells);
    if let Some(file) = given.iter_mut().find(of_zones) {
        let all: Vec<Vec<bool>> = drives.into_iter().map(|it| zones_met(it, scenario)).collect();
        let is_met = |place: usize| all.iter().any(|it| it.get(place) == Some(&true));
        let names = names(&document.document).into_iter().enumerate();
        file.zones = names.filter_map(|(place, name)| Some((name?, is_met(place)))).collect();
    }
    given
}

/// The name, or the class, of each row of the legend that has a soil.
fn names(document: &Document) -> Vec<Option<String>> {
    let rows = document.get("terrain.zone").and_then(|it| it.as_array());
    let name = |row: &serde_json::Value| {
        row.get("soil")?;
        let class = row.get("class").map(|class| format!("class {class}"));
        row.get("name").and_then(|name| Some(name.as_str()?.to_owned())).or(class)
    };
    rows.map_or_else(Vec::new, |rows| rows.iter().map(name).collect())
}
