//! Wheels of one side whose speeds have the other sign throughout, as motors that are mounted the other
//! way round have.

use grouser_core::vehicle::Rover;

use super::TelemetryRecord;

/// Counts rows in which one side turns against the other, and the rover goes ahead all the same.
#[derive(Clone, Debug)]
pub(super) struct Sides {
    /// How far each wheel is to the left of the body [m].
    places: Vec<f64>,
    /// Rows in which all wheels turn, and those in which the left and the right side turn against
    /// the way.
    turning: u64,
    against: [u64; 2],
}

impl Sides {
    pub(super) fn of(rover: &Rover) -> Self {
        let places = rover.mounts().iter().map(|mount| mount.position.y).collect();
        Self { places, turning: 0, against: [0; 2] }
    }

    /// Looks at a row.
    pub(super) fn see(&mut self, record: &TelemetryRecord) {
        /// A rover that goes straight turns a side's way by less than this of its own [-].
        const STRAIGHT: f64 = 0.2;
        let (Some(forward), Some(rotation)) = (record.displacement[0], record.rotation) else {
            return;
        };
        let farthest = self.places.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
        if forward == 0.0 || rotation.abs() * farthest > STRAIGHT * forward.abs() {
            return;
        }
        let speeds = || self.places.iter().zip(record.wheels.iter().map(|it| it.speed));
        let all = |is_left: bool, sign: f64| {
            let mut of_side = speeds().filter(|(y, _)| (**y > 0.0) == is_left).peekable();
            of_side.peek().is_some()
                && of_side.all(|(_, speed)| speed.is_some_and(|it| it * sign * forward > 0.0))
        };
        self.turning +=
            u64::from([true, false].map(|side| all(side, 1.0) || all(side, -1.0)) == [true; 2]);
        self.against[0] += u64::from(all(true, -1.0) && all(false, 1.0));
        self.against[1] += u64::from(all(true, 1.0) && all(false, -1.0));
    }

    /// A sentence on the side that is mounted the other way round, if one is.
    pub(super) fn sentence(&self) -> Option<String> {
        /// Rows from which on chance is no reason, and tenths of all rows. Source: ours.
        const FEW: u64 = 10;
        const SHARE: u64 = 9;
        let Self { turning, against, .. } = self;
        let place = against.iter().position(|it| *it >= FEW && 10 * it >= SHARE * turning)?;
        let (side, other) = if place == 0 { ("left", "right") } else { ("right", "left") };
        Some(format!(
            "all wheels of the {side} side turn backward in {} of {turning} rows in which the rover \
             goes straight, and those of the {other} side forward: mirrored motors, whose speeds need \
             the other sign (`sign = -1` in a mapping)",
            against[place]
        ))
    }
}
