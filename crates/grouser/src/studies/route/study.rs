//! What routes are made of.

use grouser_raster::zones::{ZoneCounts, ZoneKey};
use grouser_raster::{MapFrame, MapPath, RasterError, Remark, read_areas};

use crate::studies::verdict::SlopeStudy;
use crate::terrain::SoilZones;
use crate::units::STEEPEST_SLOPE;

/// A sample that is stuck on a metre counts as so much way on top [m]. Source: ours; the order of
/// what is driven to get around a place.
pub const STUCK_WAY: f64 = 100.0;

/// The share of the samples that a risk is the mean of [-]. Source: ours.
pub const WORST_SHARE: f64 = 0.1;

/// What a way is to have least of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Objective {
    /// Time.
    #[default]
    Time,
    /// What motors and electronics draw; where no motor is known, work of the wheels.
    Energy,
    /// Time in the worst of the samples.
    Risk,
}

impl Objective {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Time, Self::Energy, Self::Risk];

    /// One word: `time`, `energy`, `risk`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Energy => "energy",
            Self::Risk => "risk",
        }
    }
}

/// Where a way may lead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The steepest slope [rad].
    pub most_slope: f64,
    /// The largest slip ratio on the soil as written [-].
    pub most_slip_ratio: f64,
    /// A place is one to keep out of where it is a no-go in at least this share of the samples [-],
    /// and in any.
    pub most_no_go: f64,
}

/// What routes are made of.
#[derive(Clone, Debug)]
pub struct RouteStudy {
    /// Rover, soil, model, rim speed, rule.
    pub mobility: SlopeStudy,
    /// Where a way may lead.
    pub limits: Limits,
    /// Where it may not: any zone of these.
    pub keep_out: Option<SoilZones>,
}

impl RouteStudy {
    /// The study with areas that ways are to keep out of: the polygons of a file of GeoJSON; how
    /// many there are, and lie on the ground; and what is to be remarked about their system.
    ///
    /// * `ground`: the map of heights
    ///
    /// # Errors
    /// [`RasterError`] if the file has no such polygons on this ground, or is in another system.
    pub fn keeping_out_of<'p>(
        self,
        file: impl Into<MapPath<'p>>,
        ground: &MapFrame<'_>,
    ) -> Result<(Self, ZoneCounts, Option<Remark>), RasterError> {
        let file = file.into();
        let (map, remark) = read_areas(file, ground)?;
        let counts = map.counts(Some(&ground.extent));
        // That there is a zone is all that counts.
        let legend = [(ZoneKey::Class(0), Some(0))];
        let zones = map.with_legend(&legend, vec![self.mobility.heading.soil]);
        let zones = zones.map_err(|fault| RasterError { file: file.path.to_owned(), fault })?;
        Ok((Self { keep_out: Some(zones), ..self }, counts, remark))
    }
}

impl Limits {
    /// Those of a study's rule: slip up to its no-go, in more samples than make one.
    #[must_use]
    pub fn of(study: &SlopeStudy) -> Self {
        Self {
            most_slope: STEEPEST_SLOPE,
            most_slip_ratio: study.rule.no_go_slip_ratio,
            most_no_go: study.rule.no_go_probability,
        }
    }
}
