//! Ways that are sought, or given, and driven.

use std::sync::Arc;

use super::question::{Asked, RouteQuestion};
use super::way::Way;
use crate::mission::MissionError;
use crate::studies::ensemble::samples::Sample;
use crate::studies::mobility::Ground;
use crate::studies::route::{
    Answer as Found, DrivenRoute, Objective, Route, RouteError, RouteTables,
};
use crate::terrain::ElevationError;

/// Why nothing can be said of a way.
#[derive(Debug, thiserror::Error)]
pub enum WayError {
    /// What is asked is not on the map, or out of range.
    #[error(transparent)]
    Route(#[from] RouteError),
    /// The heights make no ground to drive on.
    #[error(transparent)]
    Ground(#[from] ElevationError),
    /// The simulation of the way has no end.
    #[error("the way cannot be driven: {0}")]
    Drive(#[from] MissionError),
}

impl RouteQuestion<'_> {
    /// The ground, as the rover stands on it.
    #[must_use]
    pub fn ground(&self) -> Ground<'_> {
        Ground::under(&self.study.mobility.heading.rover, self.raster)
    }

    /// The way with the least of something, or the given one; `None` if `go_on` was false before
    /// the end.
    ///
    /// * `tables`: of the study, with the samples that they were made of
    /// * `objective`: what a way that is sought has least of
    /// * `has_drive`: whether it is driven by simulation, too, which nobody can stop
    ///
    /// # Errors
    /// [`WayError`] for places that are not on the map, and a way that cannot be driven.
    pub fn way(
        &self,
        (tables, samples): (&RouteTables, &[Sample]),
        objective: Objective,
        has_drive: bool,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Way>, WayError> {
        let study = self.study;
        match self.asked {
            Asked::Between(ends) => {
                let asked = (self.ground(), ends);
                let found = study.judged_route(tables, asked, objective, samples, go_on)?;
                let Some((found, legs)) = found else { return Ok(None) };
                let route = match &found {
                    Found::Route(route) => Some(route),
                    Found::NoSafeRoute(_) => None,
                };
                let driven = self.driven(route.filter(|_| has_drive))?;
                Ok(Some(Way::sought(objective, found, driven, &legs)))
            }
            Asked::Along(line) => {
                let found = study.along(tables, self.ground(), line)?;
                let route = found.route.as_ref().filter(|_| has_drive);
                let driven = self.driven(route)?;
                let legs = found.seen.advice(&study.mobility, samples, go_on);
                let legs = legs.map_err(RouteError::from)?;
                Ok(legs.map(|legs| Way::along(line, found, &study.limits, driven, &legs)))
            }
        }
    }

    /// What simulation makes of a way, if there is one.
    fn driven(&self, route: Option<&Route>) -> Result<Option<DrivenRoute>, WayError> {
        let Some(route) = route else { return Ok(None) };
        let ground = Arc::new(self.raster.clone().model()?);
        let speed = self.study.mobility.rim_speed;
        Ok(Some(route.drive(&self.scenario.value, &ground, speed)?))
    }
}
