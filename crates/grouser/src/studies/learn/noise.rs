//! How far off a right model of the right soil still is on a stretch of the way.

/// What is left over however well soil and model are known, and over which way it is the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelNoise {
    /// Standard deviation of forces, over the weight [-].
    pub force: f64,
    /// Standard deviation of the attitude of the ground under the wheels against that of the body
    /// [rad].
    pub attitude: f64,
    /// Standard deviation of torques, over their size [-].
    pub torque_share: f64,
    /// Standard deviation of torques that are small [N·m].
    pub torque: f64,
    /// Standard deviation of the logarithm of a sinkage [-].
    pub sinkage: f64,
    /// The way over which it is the same [m]: two stretches within it say no more than one.
    pub way: f64,
}

impl ModelNoise {
    /// Source: ours. The ground of a decimetre or two is uneven by some tenths of a degree and by
    /// as much of its strength; torques are those of slip from currents.
    pub const USUAL: Self = Self {
        force: 0.01,
        attitude: 0.005,
        torque_share: 0.05,
        torque: 0.005,
        sinkage: 0.1,
        way: 0.5,
    };

    /// The variance of a stretch counts this often, so that stretches within [`way`](Self::way) of
    /// each other say no more than one [-].
    ///
    /// * `way`: of the stretch [m]
    pub(in crate::studies) fn together(&self, way: f64) -> f64 {
        /// Way that counts for a rover that does not come forward [m].
        const SHORTEST: f64 = 0.01;
        (self.way / way.max(SHORTEST)).max(1.0)
    }
}
