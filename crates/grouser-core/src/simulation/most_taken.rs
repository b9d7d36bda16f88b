//! What motors took at most over a stretch of a run.

use crate::stored::stored;
use crate::vehicle::Electrical;

/// The most that was seen since it was [begun](super::Run::begin_most_taken), at looks a tenth of a
/// second apart and where the wheels get new speeds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct MostTaken {
    /// Largest current of a motor, driving or braking [A].
    pub(crate) current: f64,
    /// Highest temperature of a motor's winding, where some are known [°C].
    pub(crate) temperature: Option<f64>,
}

stored!(struct MostTaken { current, temperature });

impl MostTaken {
    /// Looks at what each motor takes, and at the warmest winding [°C].
    pub(super) fn look(&mut self, taken: &[Option<Electrical>], warmest: Option<f64>) {
        let currents = taken.iter().flatten().map(|motor| motor.current.abs());
        self.current = currents.fold(self.current, f64::max);
        self.temperature = self.temperature.into_iter().chain(warmest).reduce(f64::max);
    }
}
