//! What forces that no soil explains do to the motion, the torques and the sinkages that a soil
//! expects.
//!
//! Ground leans where the body does not, and is stronger here than there. Both are a force that
//! differs from patch to patch, and slip grows with it ever faster: over many patches a rover slips
//! more than on their mean. So the force is an unknown of the observation beside those of the soil,
//! over whose width the line is fitted as over theirs
//! ([`Line::over`](super::gaussian::Line::over)): it adds to what is expected on the mean, and what
//! it moves together (velocities, torques, sinkages) is known to move together.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::fitted::Fitted;
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
        /// Where nothing balances the motion is no better known than this, over the fastest rim's
        /// speed [-].
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
            // Of the leaning ground the wheels' torques know, of stronger ground they do not: there
            // the wheels need the pull that they need elsewhere.
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

    /// The torques with which wheels pull by a force more, each its share, among the numbers of an
    /// observation.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studies::learn::stretch::{Reading, Stretch};
    use crate::studies::random;
    use grouser_io::{self as document, Overrides, Source};

    /// The rover up 15° of a sand, and what it expects there.
    fn up_a_slope() -> (HeadingStudy, SeenMotion, Sample) {
        let settings = Overrides::parse(["scenario.soil=toyoura"]).unwrap();
        let loaded = document::read_scenario(&Source::default_scenario(), &settings).unwrap();
        let study = HeadingStudy::of(&loaded.value);
        let wheels = study.rover.wheel_count();
        let seen = |value| Some(Reading { value, deviation: 1e-3 });
        let stretch = Stretch {
            way: 0.1,
            attitude: Some([0.262, 1.2]),
            rim_speeds: vec![0.06; wheels],
            steering: vec![None; wheels],
            velocity: [seen(0.03), seen(-0.005)],
            yaw_rate: seen(0.0),
            torques: vec![seen(0.3); wheels],
            currents: vec![None; wheels],
            sinkages: vec![None; wheels],
            ..Stretch::default()
        };
        let motion = SeenMotion::of(&stretch, &study.rover).unwrap();
        let sample = Sample { soil: study.soil, model: study.model.clone() };
        (study, motion, sample)
    }

    /// Mean and covariance of the motion under forces at random are those that are fitted, within
    /// their statistical error: where the slip grows ever faster the mean is above that without
    /// forces.
    #[test]
    fn forces_at_random_have_the_mean_and_the_covariance_that_are_fitted() {
        const DRAWS: u32 = 600;
        let (study, motion, sample) = up_a_slope();
        let noise = ModelNoise { attitude: 0.0, ..ModelNoise::USUAL };
        let here = motion.expected(&study, &sample, None).unwrap();
        let fitted = motion.unexplained(&study, &sample, &here, &noise);
        let mut random = random::generator(4, 0);
        let all: Vec<Vector3<f64>> = (0..DRAWS)
            .map(|_| {
                let force =
                    Vector3::from_fn(|_, _| noise.force * random::standard_normal(&mut random));
                let found = motion.expected_under(&study, &sample, Some(&here), force).unwrap();
                (found.numbers - &here.numbers).fixed_rows::<3>(0).into()
            })
            .collect();
        let mean = all.iter().sum::<Vector3<f64>>() / f64::from(DRAWS);
        let covariance = all.iter().map(|it| (it - mean) * (it - mean).transpose());
        let covariance = covariance.sum::<Matrix3<f64>>() / f64::from(DRAWS);
        for axis in 0..3 {
            let error = (covariance[(axis, axis)] / f64::from(DRAWS)).sqrt();
            assert!((mean[axis] - fitted.shift[axis]).abs() < 4.0 * error, "{mean} {fitted:?}");
            for other in 0..3 {
                let scale = (covariance[(axis, axis)] * covariance[(other, other)]).sqrt();
                let off = covariance[(axis, other)] - fitted.covariance[(axis, other)];
                assert!(off.abs() < 0.2 * scale, "{covariance} {}", fitted.covariance);
            }
        }
        assert!(mean[0] < -0.002, "the slip is larger on the mean: {mean}");
    }

    /// Ground that leans up takes torque, ground that is weak does not.
    #[test]
    fn torques_know_of_leaning_ground_alone() {
        let (study, motion, sample) = up_a_slope();
        let here = motion.expected(&study, &sample, None).unwrap();
        let of = |force: f64, attitude: f64| {
            let noise = ModelNoise { force, attitude, ..ModelNoise::USUAL };
            let found = motion.unexplained(&study, &sample, &here, &noise);
            // The torques of all wheels together.
            let total: f64 = found.covariance.view((3, 3), (4, 4)).sum();
            let with_motion: f64 = found.covariance.view((0, 3), (1, 4)).sum();
            (found.covariance[(0, 0)].sqrt(), total.sqrt(), with_motion)
        };
        let (leans, weak) = (of(0.0, 0.01), of(0.01, 0.0));
        assert!(
            (leans.0 / weak.0 - 1.0).abs() < 1e-9,
            "the motion is the same: {leans:?} {weak:?}"
        );
        assert!(weak.1 < 0.4 * leans.1, "{leans:?} {weak:?}");
        assert!(leans.2 < 0.0, "a rover that is slower up a lean has more torque: {leans:?}");
    }

    /// The force that explains a motion is the one under which it is what is expected.
    #[test]
    fn a_push_is_the_force_that_there_was() {
        let (study, motion, sample) = up_a_slope();
        let here = motion.expected(&study, &sample, None).unwrap();
        let fitted = motion.unexplained(&study, &sample, &here, &ModelNoise::USUAL);
        let force = Vector3::new(-0.004, 0.002, 0.001);
        let found = motion.expected_under(&study, &sample, Some(&here), force).unwrap();
        let off: Vector3<f64> = (found.numbers - &here.numbers).fixed_rows::<3>(0).into();
        let explained = fitted.motion_by_force.try_inverse().unwrap() * off;
        assert!((explained - force).norm() < 0.1 * force.norm(), "{explained} {force}");
    }
}
