//! Which zones of soil a run met.

use crate::elementary::wide::sin_cos;
use crate::simulation::{Record, Scenario, Trajectory};
use crate::units::Vec2;

/// Whether a wheel stood in a zone of each of the zones' soils, in their order, at any record; empty
/// where the ground has no zones.
///
/// A wheel stands where its middle is, seen from above.
#[must_use]
pub fn zones_met(run: &Trajectory, scenario: &Scenario) -> Vec<bool> {
    let Some(zones) = &scenario.ground.zones else { return Vec::new() };
    let mut met = vec![false; zones.soils.len()];
    for record in &run.records {
        for place in wheels_of(record, scenario) {
            if let Some(met) = zones.zone(place).and_then(|zone| met.get_mut(zone)) {
                *met = true;
            }
        }
    }
    met
}

/// The middles of a rover's wheels, seen from above, in the coordinates of the ground [m].
fn wheels_of(record: &Record, scenario: &Scenario) -> impl Iterator<Item = Vec2> {
    let (sin, cos) = sin_cos(record.state.yaw);
    let body = scenario.ground.start + record.state.position;
    scenario.rover.mounts().iter().map(move |mount| {
        let (forward, left) = (mount.position.x, mount.position.y);
        body + Vec2::new(cos * forward - sin * left, sin * forward + cos * left)
    })
}
