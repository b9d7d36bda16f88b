//! What was computed of maps: the last few are kept, since places and ways of one map are asked for
//! one after another.

use std::sync::Arc;

use grouser::answers::map::VerdictCounts;
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::mobility::MobilityMap;
use grouser::studies::route::RouteTables;
use grouser_map::BandSummary;
use grouser_raster::Raster;

use crate::kept::Kept;

/// What was computed of maps.
pub(crate) struct KeptOfMaps {
    pub(crate) rasters: Arc<Kept<Raster>>,
    pub(crate) maps: Arc<Kept<Mapped>>,
    pub(crate) sought: Arc<Kept<Sought>>,
}

impl Default for KeptOfMaps {
    /// Those of the last few set-ups.
    fn default() -> Self {
        Self {
            rasters: Arc::new(Kept::new(2)),
            maps: Arc::new(Kept::new(6)),
            sought: Arc::new(Kept::new(3)),
        }
    }
}

/// A map that was computed.
pub(crate) struct Mapped {
    pub(crate) raster: Arc<Raster>,
    pub(crate) map: MobilityMap,
    /// The least, mean and largest number of each band.
    pub(crate) sums: Vec<BandSummary>,
    pub(crate) verdicts: VerdictCounts,
    /// Where nobody may go, as GeoJSON, or why there are no such areas.
    pub(crate) areas: Result<String, &'static str>,
}

/// What ways are sought with.
pub(crate) struct Sought {
    pub(crate) tables: RouteTables,
    pub(crate) samples: Vec<Sample>,
}
