//! The track that was measured: odometry added up, or fixes, with the yaw as it was read.

use crate::units::Vec2;
use crate::vehicle::RoverState;
use grouser_io::measurements::telemetry::TelemetryRecord;

/// Where the rover is on the slope at a time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// Time [s].
    pub time: f64,
    /// Position along the contour and uphill, from the start [m].
    pub position: Vec2,
    /// Yaw, *γ* [rad].
    pub yaw: f64,
}

/// The track up to a record.
#[derive(Clone, Debug, Default)]
pub(super) struct Track {
    now: Option<Pose>,
    before: Option<Pose>,
    first_fix: Option<Vec2>,
    has_odometry: bool,
    is_yaw_read: bool,
}

impl Track {
    /// Goes on to a record.
    pub(super) fn push(&mut self, record: &TelemetryRecord) {
        let last = self.now.unwrap_or_default();
        self.before = self.now;
        self.is_yaw_read |= record.yaw.is_some();
        let turned = record.rotation.unwrap_or(0.0);
        let yaw = record.yaw.unwrap_or(last.yaw + turned);
        let mut position = last.position;
        let [forward, leftward] = record.displacement;
        self.has_odometry |= forward.is_some();
        if self.has_odometry {
            // On the mean over the way the rover has turned by half.
            let middle = RoverState { yaw: yaw - 0.5 * turned, ..RoverState::default() };
            let way = Vec2::new(forward.unwrap_or(0.0), leftward.unwrap_or(0.0));
            position += middle.slope_from_body() * way;
        } else if let [Some(x), Some(y)] = record.position {
            let fix = Vec2::new(x, y);
            position = fix - *self.first_fix.get_or_insert(fix);
        }
        self.now = Some(Pose { time: record.time, position, yaw });
    }

    /// The last record's pose.
    pub(super) fn now(&self) -> Option<Pose> {
        self.now
    }

    /// The pose at the time of one of the last two records.
    pub(super) fn at(&self, time: f64) -> Option<Pose> {
        [self.now, self.before].into_iter().flatten().find(|it| it.time <= time)
    }

    /// Whether anything told where the rover is.
    pub(super) fn has_position(&self) -> bool {
        self.has_odometry || self.first_fix.is_some()
    }

    /// Turns the track by an angle [rad], so that its yaw counts from the contour, unless a yaw was
    /// read.
    ///
    /// * `poses`: others to turn with it
    pub(super) fn turn(&mut self, angle: f64, poses: &mut [&mut Option<Pose>]) {
        if self.is_yaw_read {
            return;
        }
        let rotation = RoverState { yaw: angle, ..RoverState::default() }.slope_from_body();
        let own = [&mut self.now, &mut self.before];
        let others = poses.iter_mut().map(|it| &mut **it);
        for pose in own.into_iter().chain(others).flatten() {
            pose.position = rotation * pose.position;
            pose.yaw += angle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(time: f64, yaw: Option<f64>, rotation: f64) -> TelemetryRecord {
        TelemetryRecord {
            time,
            yaw,
            displacement: [Some(1.0), Some(0.0)],
            rotation: Some(rotation),
            ..TelemetryRecord::default()
        }
    }

    #[test]
    fn odometry_adds_up_along_the_yaw() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let mut track = Track::default();
        for time in 1..=4 {
            track.push(&record(f64::from(time), None, quarter));
        }
        // Four sides of a square.
        let end = track.now().unwrap();
        assert!(end.position.norm() < 1e-12 && (end.yaw - 4.0 * quarter).abs() < 1e-12, "{end:?}");
        assert_eq!(track.at(3.5).unwrap().time, 3.0);
    }

    #[test]
    fn a_track_without_yaw_is_turned_whole() {
        let mut track = Track::default();
        track.push(&record(1.0, None, 0.0));
        track.turn(std::f64::consts::FRAC_PI_2, &mut []);
        assert!((track.now().unwrap().position - Vec2::new(0.0, 1.0)).norm() < 1e-12);
        let mut read = Track::default();
        read.push(&record(1.0, Some(0.0), 0.0));
        read.turn(1.0, &mut []);
        assert_eq!(read.now().unwrap().yaw, 0.0);
    }
}
