//! Measured single-wheel tests: settings, readings, and the trials that repeat each other.
//!
//! Everything is in SI units and in Grouser's signs: `document` converts other units, signs and
//! slip definitions.

use std::ops::{Index, IndexMut};

use grouser_core::contact::{Contact, SettleError, Settled, Slip, WheelSoilModel, settle};
use grouser_core::soil::Soil;
use grouser_core::wheel::Wheel;

/// A quantity that a test stand reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Force along the wheel, *F_x* [N].
    DrawbarPull,
    /// Force across the wheel, *F_y* [N], positive to the left.
    SideForce,
    /// Sinkage of the grouser tips, *h* [m].
    Sinkage,
    /// Driving torque, *T* [N·m].
    Torque,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::DrawbarPull, Self::SideForce, Self::Sinkage, Self::Torque];

    /// The quantity of a settled wheel, in its SI unit.
    #[must_use]
    pub fn of(self, settled: &Settled) -> f64 {
        match self {
            Self::DrawbarPull => settled.forces.drawbar_pull,
            Self::SideForce => settled.forces.side_force,
            Self::Sinkage => settled.sinkage,
            Self::Torque => settled.forces.torque,
        }
    }
}

/// A value for each [`Quantity`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PerQuantity<T> {
    /// Value for the force along the wheel.
    pub drawbar_pull: T,
    /// Value for the force across it.
    pub side_force: T,
    /// Value for the sinkage.
    pub sinkage: T,
    /// Value for the torque.
    pub torque: T,
}

impl<T> PerQuantity<T> {
    /// The results of a function for each quantity.
    #[must_use]
    pub fn from_fn(make: impl Fn(Quantity) -> T) -> Self {
        Self {
            drawbar_pull: make(Quantity::DrawbarPull),
            side_force: make(Quantity::SideForce),
            sinkage: make(Quantity::Sinkage),
            torque: make(Quantity::Torque),
        }
    }
}

impl<T> Index<Quantity> for PerQuantity<T> {
    type Output = T;

    fn index(&self, quantity: Quantity) -> &T {
        match quantity {
            Quantity::DrawbarPull => &self.drawbar_pull,
            Quantity::SideForce => &self.side_force,
            Quantity::Sinkage => &self.sinkage,
            Quantity::Torque => &self.torque,
        }
    }
}

impl<T> IndexMut<Quantity> for PerQuantity<T> {
    fn index_mut(&mut self, quantity: Quantity) -> &mut T {
        match quantity {
            Quantity::DrawbarPull => &mut self.drawbar_pull,
            Quantity::SideForce => &mut self.side_force,
            Quantity::Sinkage => &mut self.sinkage,
            Quantity::Torque => &mut self.torque,
        }
    }
}

/// A reading of a test stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Its mean over the trial, in SI units.
    pub value: f64,
    /// Its standard deviation within the trial, where it was recorded.
    pub scatter: Option<f64>,
}

/// One run of a wheel through the soil, averaged over its steady part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// Slip of the rim.
    pub slip: Slip,
    /// Load on the wheel, *W* [N].
    pub load: f64,
    /// The readings; `None` for quantities that were not measured.
    pub readings: PerQuantity<Option<Reading>>,
}

impl Trial {
    /// Predicts the trial with a model, at its own load and motion.
    ///
    /// * `gravity`: *g* [m/s²]
    ///
    /// # Errors
    /// [`SettleError`] if the soil cannot carry the load.
    pub fn predict(
        &self,
        model: &dyn WheelSoilModel,
        wheel: &Wheel,
        soil: &Soil,
        gravity: f64,
    ) -> Result<Settled, SettleError> {
        let contact = Contact { wheel: *wheel, soil: *soil, slip: self.slip, gravity };
        settle(model, &contact, self.load)
    }
}

/// Trials that repeat one setting of the test stand.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Slip angle that was set, *β* [rad].
    pub slip_angle: f64,
    /// Rim speed that was set [m/s], where the stand sets speeds.
    pub rim_speed: Option<f64>,
    /// Slip by the total speed, the mean over the trials, *S* [-].
    pub total_slip: f64,
    /// Its trials, by their places in [`WheelTests::trials`].
    pub trials: Vec<usize>,
}

/// A cell counts as driven from this slip by the total speed on [-].
///
/// Source: ours. Rim and hub set to the same speed belong to the driven side, and stands hold
/// their speeds within a few percent.
pub const DRIVEN_FROM: f64 = -0.05;

impl Cell {
    /// Whether the wheel drives; otherwise it skids.
    #[must_use]
    pub fn is_driven(&self) -> bool {
        self.total_slip >= DRIVEN_FROM
    }
}

/// A series of trials with one wheel on one soil.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WheelTests {
    /// The trials, in the order of their file.
    pub trials: Vec<Trial>,
    /// The trials that repeat each other.
    pub cells: Vec<Cell>,
}

impl WheelTests {
    /// The readings of a quantity in a cell.
    pub fn readings_of(&self, cell: &Cell, quantity: Quantity) -> impl Iterator<Item = Reading> {
        cell.trials.iter().filter_map(move |&trial| self.trials[trial].readings[quantity])
    }
}
