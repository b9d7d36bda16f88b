//! The single-wheel test stand: forces, torque and sinkage over load, slip ratio and slip angle
//! ([FourWheel], section 4 and Fig. 7).

use crate::contact::validity::{Finding, Situation};
use crate::contact::{Contact, Model, SettleError, Settled, Slip, settle_many};
use crate::error::ParameterError;
use crate::soil::Soil;
use crate::wheel::Wheel;

/// A test plan: every load with every slip angle and every slip ratio.
///
/// How hard does the wheel of HAKUTO pull under 17 N, and which torque does that take?
///
/// ```
/// use grouser::contact::Model;
/// use grouser::document::{self, Overrides, Source};
/// use grouser::studies::wheel_test::WheelTest;
///
/// let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
/// let test = WheelTest {
///     wheel: scenario.rover.mounts()[0].unit.wheel,
///     soil: scenario.ground.soil,
///     gravity: scenario.gravity,
///     model: Model::Ishigami,
///     loads: vec![17.0],
///     slip_angles: vec![0.0],
///     slip_ratios: vec![0.1, 0.2, 0.4],
/// };
/// let forces = test.run().into_iter().map(|row| row.result.map(|settled| settled.forces));
/// let forces = forces.collect::<Result<Vec<_>, _>>()?;
/// let pulls: Vec<String> = forces.iter().map(|f| format!("{:.2} N", f.drawbar_pull)).collect();
/// assert_eq!(pulls.join(", "), "0.68 N, 1.82 N, 3.60 N");
/// assert_eq!(format!("{:.2} N·m", forces[1].torque), "0.37 N·m");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct WheelTest {
    /// The wheel.
    pub wheel: Wheel,
    /// The soil.
    pub soil: Soil,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// The wheel–soil model.
    pub model: Model,
    /// Loads [N].
    pub loads: Vec<f64>,
    /// Slip angles [rad].
    pub slip_angles: Vec<f64>,
    /// Slip ratios [-].
    pub slip_ratios: Vec<f64>,
}

/// One setting of the test stand, and its result.
#[derive(Clone, Debug, PartialEq)]
pub struct WheelTestRow {
    /// Load [N].
    pub load: f64,
    /// Slip angle [rad].
    pub slip_angle: f64,
    /// Slip ratio [-].
    pub slip_ratio: f64,
    /// The settled wheel, or why it does not settle.
    pub result: Result<Settled, SettleError>,
    /// Why the row is an extrapolation.
    pub findings: Vec<Finding>,
}

impl WheelTest {
    /// Checks that the soil resists the wheel, which [`run`](Self::run) takes for granted.
    ///
    /// # Errors
    /// [`ParameterError`] if the soil has no stiffness under a wheel of this width.
    pub fn check(&self) -> Result<(), ParameterError> {
        self.soil.check_under(&self.wheel, self.gravity)
    }

    /// Settles the wheel at every setting; slip ratios change fastest, then slip angles.
    #[must_use]
    pub fn run(&self) -> Vec<WheelTestRow> {
        let mut settings = Vec::new();
        for &load in &self.loads {
            for &slip_angle in &self.slip_angles {
                for &slip_ratio in &self.slip_ratios {
                    settings.push((load, slip_angle, slip_ratio));
                }
            }
        }
        let wheels: Vec<(Contact, f64)> = settings
            .iter()
            .map(|&(load, slip_angle, slip_ratio)| (self.contact(slip_angle, slip_ratio), load))
            .collect();
        let results = settle_many(self.model.as_ref(), &wheels);
        let rows = settings.into_iter().zip(&wheels).zip(results);
        rows.map(|((setting, (contact, _)), result)| self.row(setting, contact, result)).collect()
    }

    /// The wheel in the soil, in a motion of the stand.
    pub(super) fn contact(&self, slip_angle: f64, slip_ratio: f64) -> Contact {
        let slip = Slip::on_test_stand(slip_ratio, slip_angle);
        Contact { wheel: self.wheel, soil: self.soil, slip, gravity: self.gravity }
    }

    fn row(
        &self,
        (load, slip_angle, slip_ratio): (f64, f64, f64),
        contact: &Contact,
        result: Result<Settled, SettleError>,
    ) -> WheelTestRow {
        let situation = Situation {
            model: &self.model,
            wheel: &self.wheel,
            soil: &self.soil,
            gravity: self.gravity,
            slope: 0.0,
            load: Some(load),
            slip: Some(contact.slip),
            settled: result.as_ref().ok(),
        };
        let findings = situation.findings();
        WheelTestRow { load, slip_angle, slip_ratio, result, findings }
    }
}
