//! Layer 4, missions: legs that a rover drives one after the other, and limits at which it stops.
//!
//! A [`Mission`] is a plan: a [`Scenario`](crate::simulation::Scenario) for rover, ground and
//! start, and [`Leg`]s, each with a [`Manoeuvre`]. A [`MissionRun`] drives it with one
//! [`Run`](crate::simulation::Run), a `pilot` for each manoeuvre. After every control period an
//! `odometer` says how far the rover came, and the [`Stop`]s are looked at: one that is passed ends
//! the leg, and is a value like every other outcome.
//!
//! A rover whose wheels someone else turns has the same [`Limits`]: a [`PathRun`] is led along a
//! [`Route`] by one command after the other.
//!
//! Source of the manoeuvres, and of the three kinds of limits: [BiesiadeckiMaimone2006], of the
//! Mars Exploration Rovers.

mod angles;
mod contour;
mod driven;
mod limits;
mod look_ahead;
mod navigator;
mod odometer;
mod path_run;
mod pilot;
mod plan;
mod report;
mod route;
mod run;
mod steering;
mod stop;
mod turn;
mod yaw_watch;

pub use angles::MOST_CROSS_YAW;
pub use limits::Limits;
pub use navigator::{Fix, Sensors};
pub use path_run::{PathRun, PathTask};
pub use pilot::{CROSS_TRACK_GAIN, CROSS_TRACK_INTEGRAL, YAW_GAIN, YAW_INTEGRAL};
pub use plan::{Heading, Leg, Manoeuvre, Measure, Mission, PlanError, Steering};
pub use report::{BackOut, LegOutcome, LegReport, MissionReport, Taken};
pub use route::{BesideRoute, Route};
pub use run::{MissionError, MissionRun};
pub use stop::{Cause, Kind, Limited, LimitedRow, Stop, Stopped, Then, Where};
pub use yaw_watch::{FellShort, ShortBecause};
