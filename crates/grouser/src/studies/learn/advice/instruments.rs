//! What is read on a test drive, and how well.

use super::super::stretch::{self, Reading, Stretch};
use super::leg::TestLeg;
use crate::units::Vec2;
use crate::vehicle::{Mount, Rover};

/// What is read on a test drive, and how well it is read on the mean over a stretch of a decimetre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instruments {
    /// Standard deviation of the velocity along the body, over the rims' speed [-].
    pub forward: f64,
    /// Standard deviation of the velocity to the body's left, over the rims' speed [-]; `None`
    /// where it is not read.
    pub leftward: Option<f64>,
    /// Standard deviation of the yaw rate times the distance of the farthest wheel, over the rims'
    /// speed [-].
    pub turning: Option<f64>,
    /// Standard deviation of torques, over their size [-].
    pub torque: Option<f64>,
    /// Standard deviation of sinkages [m].
    pub sinkage: Option<f64>,
}

impl Instruments {
    /// Odometry that scatters by 5 % of the rims' speed and torques by a tenth, on the mean of
    /// seven readings; no sinkage.
    #[must_use]
    pub fn usual() -> Self {
        let readings = (stretch::LEAST_READINGS as f64).sqrt();
        let odometry = stretch::USUAL_SCATTER / readings;
        let torque = Some(stretch::USUAL_TORQUE / readings);
        Self {
            forward: odometry,
            leftward: Some(odometry),
            turning: Some(odometry),
            torque,
            sinkage: None,
        }
    }

    /// Those of a stretch; the usual ones where it has no way along the body.
    #[must_use]
    pub fn of(stretch: &Stretch, rover: &Rover) -> Self {
        let fastest = stretch.rim_speeds.iter().map(|it| it.abs()).fold(0.0, f64::max);
        let [forward, leftward] = stretch.velocity;
        let Some(forward) = forward.filter(|_| fastest > 0.0) else { return Self::usual() };
        let share = |it: Reading| it.deviation / fastest;
        let torques = stretch.torques.iter().flatten();
        let sizes: f64 = torques.clone().map(|it| it.value.abs()).sum();
        let deviations: f64 = torques.map(|it| it.deviation).sum();
        let sinkages: Vec<f64> = stretch.sinkages.iter().flatten().map(|it| it.deviation).collect();
        let mean = |it: &[f64]| it.iter().sum::<f64>() / it.len() as f64;
        Self {
            forward: share(forward),
            leftward: leftward.map(share),
            turning: stretch.yaw_rate.map(|it| share(it) * reach(rover)),
            torque: (sizes > 0.0).then(|| deviations / sizes),
            sinkage: (!sinkages.is_empty()).then(|| mean(&sinkages)),
        }
    }
}

/// Distance of the farthest wheel [m].
fn reach(rover: &Rover) -> f64 {
    rover.load_arms().iter().map(Vec2::norm).fold(f64::MIN_POSITIVE, f64::max)
}

impl Instruments {
    /// A stretch of a leg as they would read it; torques and sinkages of what a soil expects have
    /// no values yet.
    pub(super) fn stretch(
        &self,
        leg: &TestLeg,
        rim_speed: f64,
        [forward, leftward, turning]: [f64; 3],
        rover: &Rover,
    ) -> Stretch {
        /// A wheel's torque over its share of the weight times its radius, by which its deviation
        /// is taken [-].
        const TORQUE: f64 = 0.3;
        const SINKAGE: f64 = 0.01;
        let wheels = rover.wheel_count();
        let reading = |value: f64, deviation: f64| Reading { value, deviation };
        let torque = |share: f64, radius: f64| {
            let size = TORQUE * rover.mass() * crate::units::EARTH_GRAVITY / wheels as f64 * radius;
            reading(size, share * size)
        };
        let radii = rover.mounts().iter().map(Mount::shearing_radius);
        let way = stretch::WAY;
        Stretch {
            time: [0.0, way / rim_speed],
            way,
            attitude: Some([leg.slope, leg.yaw]),
            reported_yaw: Some(leg.yaw),
            rim_speeds: vec![rim_speed; wheels],
            rim_scatter: 0.0,
            steering: vec![None; wheels],
            velocity: [
                Some(reading(forward, self.forward * rim_speed)),
                self.leftward.map(|share| reading(leftward, share * rim_speed)),
            ],
            yaw_rate: self.turning.map(|share| reading(turning, share * rim_speed / reach(rover))),
            torques: radii.map(|radius| self.torque.map(|share| torque(share, radius))).collect(),
            currents: vec![None; wheels],
            sinkages: vec![self.sinkage.map(|deviation| reading(SINKAGE, deviation)); wheels],
            outliers: 0,
        }
    }
}
