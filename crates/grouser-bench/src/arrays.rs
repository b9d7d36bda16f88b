//! The work behind Python's calls on arrays, prepared once, to measure the calls' overhead against.

use grouser::contact::{Contact, Model, Slip, WheelForces, forces_many, settle_many};
use grouser::document::{self, DocumentError, Kind, Overrides, Source};
use grouser::simulation::{Approach, Run, Scenario};
use grouser::units::EARTH_GRAVITY;
use rayon::prelude::*;

/// Inputs for which all is read and converted already.
pub enum Arrays {
    /// Wheels of the paper's rover on Toyoura sand, each with its load [N].
    Wheels(Vec<(Contact, f64)>),
    /// The same wheels, each with its sinkage [m].
    Sunk(Vec<(Contact, f64)>),
    /// Runs of the paper's rover.
    Traverses(Vec<Scenario>),
}

/// Wheels that a thread takes at once, as the Python package gives them out.
const SHARE: usize = 256;

impl Arrays {
    /// Wheels, one for each `[load_n, slip_ratio, slip_angle_deg]`.
    ///
    /// # Errors
    /// [`DocumentError`] if a preset cannot be read.
    pub fn wheels(rows: &[[f64; 3]]) -> Result<Self, DocumentError> {
        Ok(Self::Wheels(pressed(rows)?))
    }

    /// Wheels, one for each `[sinkage_mm, slip_ratio, slip_angle_deg]`.
    ///
    /// # Errors
    /// [`DocumentError`] if a preset cannot be read.
    pub fn sunk(rows: &[[f64; 3]]) -> Result<Self, DocumentError> {
        let metres = |(contact, sinkage_mm)| (contact, 1e-3 * sinkage_mm);
        Ok(Self::Sunk(pressed(rows)?.into_iter().map(metres).collect()))
    }

    /// Traverses of 20 s, one for each `[slope_deg, yaw_deg]`.
    ///
    /// # Errors
    /// [`DocumentError`] if the scenario cannot be read.
    pub fn traverses(approach: Approach, rows: &[[f64; 2]]) -> Result<Self, DocumentError> {
        let base = document::read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
        let varied = |&[slope, yaw]: &[f64; 2]| {
            let mut scenario = base.clone();
            scenario.numerics.approach = approach;
            scenario.ground = scenario.ground.with_slope(slope.to_radians());
            scenario.start.yaw = yaw.to_radians();
            scenario
        };
        Ok(Self::Traverses(rows.iter().map(varied).collect()))
    }

    /// Computes all of them on all cores; how many settled, or were run to their end.
    #[must_use]
    pub fn compute(&self) -> usize {
        match self {
            Self::Wheels(wheels) => {
                let some = |wheels: &[(Contact, f64)]| settle_many(model().as_ref(), wheels);
                let settled: Vec<_> = wheels.par_chunks(SHARE).flat_map_iter(some).collect();
                settled.into_iter().flatten().count()
            }
            Self::Sunk(wheels) => {
                let some = |wheels: &[(Contact, f64)]| forces_many(model().as_ref(), wheels);
                let forces: Vec<WheelForces> =
                    wheels.par_chunks(SHARE).flat_map_iter(some).collect();
                forces.into_iter().filter(|it| it.normal_force > 0.0).count()
            }
            Self::Traverses(scenarios) => {
                let end = |scenario: &Scenario| {
                    let run = Run::new(scenario).and_then(Run::to_outcome)?;
                    Ok::<_, grouser::simulation::RunError>((run.last().clone(), run.outcome))
                };
                let ends: Vec<_> = scenarios.par_iter().map(end).collect();
                ends.into_iter().flatten().count()
            }
        }
    }
}

/// The model of a scenario that names none.
fn model() -> Model {
    Model::default()
}

/// Wheels with the first number of each row, and slip ratio and slip angle [°] of the others.
fn pressed(rows: &[[f64; 3]]) -> Result<Vec<(Contact, f64)>, DocumentError> {
    let wheel = document::read_wheel(&Source::find(Kind::Wheel, "hakuto")?, &Overrides::none())?;
    let soil = document::read_soil(&Source::find(Kind::Soil, "toyoura")?, &Overrides::none())?;
    let (wheel, soil) = (wheel.value, soil.value);
    let wheel = |&[pressed, ratio, angle]: &[f64; 3]| {
        let slip = Slip::on_test_stand(ratio, angle.to_radians());
        (Contact { wheel, soil, slip, gravity: EARTH_GRAVITY }, pressed)
    };
    Ok(rows.iter().map(wheel).collect())
}
