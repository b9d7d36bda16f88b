//! What forces that no soil explains do to the motion, the torques and the sinkages that a soil expects.
//!
//! Ground leans where the body does not, and is stronger here than there. Both are a force that differs from patch to
//! patch, and slip grows with it ever faster: over many patches a rover slips more than on their mean. So the force is an
//! unknown of the observation beside those of the soil, over whose width the line is fitted as over theirs
//! ([`Line::over`](super::gaussian::Line::over)): it adds to what is expected on the mean, and what it moves together
//! (velocities, torques, sinkages) is known to move together.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::filter::Fitted;
use super::gaussian::Gaussian;
use super::motion::{Expected, SeenMotion};
use super::noise::ModelNoise;
use crate::elementary::wide::{cos, hypot, sin};
use crate::studies::ensemble::samples::Sample;
use crate::studies::heading::HeadingStudy;

/// What unexplained forces do to the numbers of an observation.
#[derive(Clone, Debug)]
pub(super) struct Unexplained {
    /// What they add on the mean.
    pub(super) shift: DVector<f64>,
    /// How they move them: a covariance.
    pub(super) covariance: DMatrix<f64>,
    /// How the motion goes with them: over the fastest rim's speed, for a force of the weight [-].
    pub(super) motion_by_force: Matrix3<f64>,
}

impl SeenMotion {
    /// What unexplained forces do.
    ///
    /// * `here`: what the sample expects without them
    pub(super) fn unexplained(
        &self,
        study: &HeadingStudy,
        sample: &Sample,
        here: &Expected,
        noise: &ModelNoise,
    ) -> Unexplained {
        const WIDTH: f64 = 3.0;
        /// Where nothing balances the motion is no better known than this, over the fastest rim's speed [-].
        const STUCK: f64 = 0.3;
        let size = hypot(noise.force, noise.attitude);
        let count = here.numbers.len();
        let (mut shift, mut covariance) = (DVector::zeros(count), DMatrix::zeros(count, count));
        let mut motion_by_force = Matrix3::zeros();
        for axis in 0..3 {
            let under = |sign: f64| {
                let mut force = Vector3::zeros();
                force[axis] = sign * size * WIDTH.sqrt();
                let found = self.expected_under(study, sample, Some(here), force);
                found.map_or_else(|| here.numbers.clone(), |it| it.numbers)
            };
            let (ahead, behind) = (under(1.0), under(-1.0));
            let slope = (&ahead - &behind) / (2.0 * WIDTH.sqrt());
            let bend = ahead + behind - &here.numbers * 2.0;
            shift += &bend / (2.0 * WIDTH);
            covariance += &bend * bend.transpose() * ((WIDTH - 1.0) / (4.0 * WIDTH * WIDTH));
            // Of the leaning ground the wheels' torques know, of stronger ground they do not: there the wheels need the pull
            // that they need elsewhere.
            let of_ground = &slope + self.torques_of_pull(axis, size, count);
            covariance += &slope * slope.transpose() * (noise.attitude / size).powi(2);
            covariance += &of_ground * of_ground.transpose() * (noise.force / size).powi(2);
            motion_by_force.set_column(axis, &(slope.fixed_rows::<3>(0) / size));
        }
        if !here.balances() {
            for place in 0..3 {
                covariance[(place, place)] += STUCK * STUCK;
            }
        }
        Unexplained { shift, covariance, motion_by_force }
    }

    /// The torques with which wheels pull by a force more, each its share, among the numbers of an observation.
    ///
    /// * `axis`: 0 along the body, 1 to its left
    /// * `force`: over the weight [-]
    fn torques_of_pull(&self, axis: usize, force: f64, count: usize) -> DVector<f64> {
        let mut numbers = DVector::zeros(count);
        let mounts = self.rover().mounts();
        let read = (0..mounts.len()).filter(|wheel| self.torques()[*wheel].is_some());
        for (place, wheel) in read.enumerate() {
            let steering = mounts[wheel].steering;
            let share = [cos(steering), sin(steering), 0.0][axis];
            numbers[3 + place] = force * share / mounts.len() as f64;
        }
        numbers
    }
}

/// The force against the way that would explain a motion, if the soil is as it was believed to be.
#[derive(Clone, Debug)]
pub(super) struct Push {
    /// Over the weight [-].
    pub(super) force: f64,
    /// Its standard deviation by the readings [-].
    pub(super) deviation: f64,
    /// Standard deviation of the slip ratio by such forces [-].
    pub(super) of_slip: f64,
    /// What it would be less by for each unknown of the soil.
    by_unknowns: DVector<f64>,
}

impl Push {
    /// `None` where the motion does not go with forces.
    ///
    /// * `fitted`: over the belief
    pub(super) fn of(
        motion: &SeenMotion,
        fitted: &Fitted,
        belief: &Gaussian,
        seen: &DVector<f64>,
    ) -> Option<Self> {
        let inverse = fitted.motion_by_force.try_inverse()?;
        let along = inverse.row(0) * motion.against();
        let line = &fitted.line;
        let off = seen - (&line.value + &line.jacobian * (&belief.mean - &line.at));
        let force = (along * off.fixed_rows::<3>(0))[0];
        let own = fitted.own.fixed_rows::<3>(0);
        let variance: f64 = along.iter().zip(own.iter()).map(|(it, own)| it * it * own).sum();
        let by_unknowns = (along * line.jacobian.fixed_rows::<3>(0)).transpose();
        let by_unknowns = DVector::from_column_slice(by_unknowns.as_slice());
        let of_slip = fitted.deviation_along();
        Some(Self { force, deviation: variance.sqrt(), of_slip, by_unknowns })
    }

    /// By how much less a force would explain the motion once the soil is believed to be another.
    pub(super) fn learnt(&self, before: &DVector<f64>, after: &DVector<f64>) -> f64 {
        self.by_unknowns.dot(&(after - before))
    }
}
