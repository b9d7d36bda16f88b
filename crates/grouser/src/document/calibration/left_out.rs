//! Cells that a fit has not seen, as records: errors, and how the bands of its posterior hold them.

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use super::super::columns::fit::{GROUP, column_of};
use super::super::validation::{ErrorsRecord, GroupRecord};
use crate::studies::calibration::LeftOutGroup;
use crate::studies::calibration::cross_validation::Coverage;
use crate::studies::measurement::{PerQuantity, Quantity};

/// A group of cells with its errors, and the coverage of its bands. As JSON an object with an
/// object for each quantity; null for one that was not measured.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftOutRecord {
    /// The errors.
    pub errors: GroupRecord,
    coverage: PerQuantity<Option<Coverage>>,
}

/// How bands hold the cells of one quantity. All are null without a posterior.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct CoverageRecord {
    /// Share of the cells within their 50 % bands [-].
    pub coverage_50: Option<f64>,
    /// Share of the cells within their 95 % bands [-].
    pub coverage_95: Option<f64>,
    /// Mean interval score of the 95 % bands, in the quantity's unit; smaller is better.
    pub interval_score: Option<f64>,
    /// How many cells have a band: none of the side force straight ahead.
    pub cells_with_band: Option<usize>,
}

#[derive(Serialize)]
struct OfQuantity {
    #[serde(flatten)]
    errors: ErrorsRecord,
    #[serde(flatten)]
    coverage: CoverageRecord,
}

impl From<&LeftOutGroup> for LeftOutRecord {
    fn from(left: &LeftOutGroup) -> Self {
        Self { errors: GroupRecord::from(&left.group), coverage: left.coverage }
    }
}

impl LeftOutRecord {
    /// How the bands hold the cells of a quantity.
    #[must_use]
    pub fn coverage(&self, quantity: Quantity) -> CoverageRecord {
        let unit = column_of(quantity).unit;
        self.coverage[quantity].map_or_else(CoverageRecord::default, |it| CoverageRecord {
            coverage_50: Some(it.share_within_50),
            coverage_95: Some(it.share_within_95),
            interval_score: Some(unit.from_si(it.interval_score)),
            cells_with_band: Some(it.cells),
        })
    }

    /// Whether there are bands.
    #[must_use]
    pub fn has_bands(&self) -> bool {
        Quantity::ALL.into_iter().any(|quantity| self.coverage[quantity].is_some())
    }
}

impl Serialize for LeftOutRecord {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        GROUP.iter().try_for_each(|column| column.write(&mut map, &self.errors.0))?;
        for quantity in Quantity::ALL {
            let errors = self.errors.errors(quantity);
            let both =
                errors.map(|errors| OfQuantity { errors, coverage: self.coverage(quantity) });
            map.serialize_entry(column_of(quantity).name, &both)?;
        }
        map.end()
    }
}
