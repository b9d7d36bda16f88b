//! How the way of a rover was measured.

/// What measured the way of a rover, and its rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Odometry {
    /// Cameras, or other sensors that see the ground or what stands on it.
    Visual,
    /// The turning of the wheels: it has no slip.
    Wheels,
    /// A filter of the wheels' turning and of other sensors.
    Fused,
    /// A system outside the rover.
    MotionCapture,
}

impl Odometry {
    /// All of them, each with its name in documents and options, and what it is.
    pub const ALL: [(&'static str, Self, &'static str); 4] = [
        ("visual", Self::Visual, "Cameras, or other sensors that see the ground."),
        ("wheels", Self::Wheels, "The turning of the wheels, which has no slip: it is left out."),
        ("fused", Self::Fused, "A filter of the wheels' turning and of other sensors."),
        ("motion-capture", Self::MotionCapture, "A system outside the rover."),
    ];

    /// That of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|(known, ..)| *known == name).map(|(_, odometry, _)| odometry)
    }

    /// What there is to say of readings by it; nothing where they measure the rover's motion.
    pub(super) fn sentence(self) -> Option<&'static str> {
        match self {
            Self::Visual | Self::MotionCapture => None,
            Self::Wheels => Some(
                "the odometry is that of wheels, which has no slip: ways, rotations and positions \
                 are left out; attitude, torques and sinkages are used",
            ),
            Self::Fused => Some(
                "the odometry is fused with that of wheels: where they slip it may show less slip \
                 than there is",
            ),
        }
    }
}
