//! How long arrows of forces are in scenes in three dimensions.

use grouser_core::simulation::Scenario;
use grouser_core::vehicle::Mount;

/// Newtons of a metre of arrow [N/m]: an even share of the rover's weight is an arrow twice as long
/// as its largest wheel is high, so that it shows beyond the wheel. It depends on the scenario
/// alone, so that arrows of two parts of a drive are of one scale.
#[must_use]
pub fn newtons_per_metre(scenario: &Scenario) -> f64 {
    let rover = &scenario.rover;
    let largest = rover.mounts().iter().map(Mount::shearing_radius).fold(0.0, f64::max);
    let share = rover.mass() * scenario.gravity / rover.wheel_count() as f64;
    share / (2.0 * 2.0 * largest)
}
