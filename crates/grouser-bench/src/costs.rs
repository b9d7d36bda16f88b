//! The map of costs: what a wheel's answer costs, beside that of a driving wheel, over the domain.
//!
//! Cost is counted, not timed: how often the search looks at the soil's reaction before it answers,
//! a settled sinkage or a soil that does not carry the load. Counts repeat on every machine. The
//! search is the one of a model that gives no more than its forces: where a model gives its
//! load–sinkage relation, a first guess saves all answers a look or two.

use std::fmt::{self, Display, Formatter};
use std::sync::atomic::{AtomicU32, Ordering};

use grouser::contact::{Contact, Model, SettleError, Slip, WheelForces, WheelSoilModel, settle};
use grouser::document::{self, DocumentError, Kind, Overrides, Source};
use grouser::soil::Soil;
use grouser::units::EARTH_GRAVITY;
use grouser::wheel::Wheel;
use rayon::prelude::*;

/// What others are compared with: slip ratio [-], slip angle [°], and load as a share of what the
/// soil carries [-].
pub const DRIVING: (f64, f64, f64) = (0.2, 0.0, 0.1);

/// From locked to spinning on the spot [-].
pub const SLIP_RATIOS: [f64; 9] = [-1.0, -0.9, -0.5, -0.2, 0.0, 0.2, 0.6, 0.9, 1.0];
/// From straight ahead to sideways [°].
pub const SLIP_ANGLES_DEG: [f64; 5] = [0.0, 15.0, 45.0, 75.0, 90.0];
/// Up to what the soil carries, and beyond [-].
pub const LOAD_SHARES: [f64; 6] = [0.01, 0.1, 0.5, 0.99, 1.01, 3.0];

/// The wheel and the soils of the map.
pub struct CostMap {
    wheel: Wheel,
    soils: Vec<(&'static str, Soil)>,
}

/// A wheel of the map, in one motion.
#[derive(Clone, Debug)]
pub struct Stand {
    /// The soil's name.
    pub soil: &'static str,
    /// The wheel–soil model.
    pub model: Model,
    /// The contact.
    pub contact: Contact,
    /// The most that the soil carries down to axle depth [N].
    pub capacity: f64,
}

impl CostMap {
    /// The wheel of HAKUTO on all ready soils.
    ///
    /// # Errors
    /// [`DocumentError`] if a preset cannot be read.
    pub fn new() -> Result<Self, DocumentError> {
        let wheel =
            document::read_wheel(&Source::find(Kind::Wheel, "hakuto")?, &Overrides::none())?.value;
        let soil = |name: &'static str| {
            let source = Source::find(Kind::Soil, name)?;
            Ok((name, document::read_soil(&source, &Overrides::none())?.value))
        };
        let names = document::presets(Kind::Soil).map(|preset| preset.name);
        Ok(Self { wheel, soils: names.map(soil).collect::<Result<_, DocumentError>>()? })
    }

    /// The wheel in a motion on each soil.
    #[must_use]
    pub fn stands(&self, model: &Model, slip_ratio: f64, slip_angle_deg: f64) -> Vec<Stand> {
        let slip = Slip::on_test_stand(slip_ratio, slip_angle_deg.to_radians());
        let stand = |&(name, soil): &(&'static str, Soil)| {
            let contact = Contact { wheel: self.wheel, soil, slip, gravity: EARTH_GRAVITY };
            let capacity = capacity(model, &contact)?;
            (capacity > 0.0).then_some(Stand {
                soil: name,
                model: model.clone(),
                contact,
                capacity,
            })
        };
        self.soils.iter().filter_map(stand).collect()
    }

    /// Looks of a driving wheel, the mean over the soils.
    #[must_use]
    pub fn driving(&self, model: &Model) -> f64 {
        let (slip_ratio, slip_angle_deg, share) = DRIVING;
        let looks: Vec<u32> = self
            .stands(model, slip_ratio, slip_angle_deg)
            .iter()
            .map(|stand| stand.looks(share))
            .collect();
        f64::from(looks.iter().sum::<u32>()) / looks.len() as f64
    }

    /// The most looks over all soils and slip angles, over those of a driving wheel: a row for each
    /// of [`SLIP_RATIOS`], a column for each of [`LOAD_SHARES`].
    #[must_use]
    pub fn worst(&self, model: &Model) -> Vec<[f64; LOAD_SHARES.len()]> {
        let driving = self.driving(model);
        let row = |&ratio: &f64| {
            let stands: Vec<Stand> = SLIP_ANGLES_DEG
                .iter()
                .flat_map(|angle| self.stands(model, ratio, *angle))
                .collect();
            LOAD_SHARES.map(|share| {
                let most = stands.iter().map(|stand| stand.looks(share)).max().unwrap_or(0);
                f64::from(most) / driving
            })
        };
        SLIP_RATIOS.par_iter().map(row).collect()
    }
}

impl Stand {
    /// How often the search looks at the reaction before it answers, whatever the answer.
    ///
    /// * `share`: of the most that the soil carries [-]
    #[must_use]
    pub fn looks(&self, share: f64) -> u32 {
        let counted = Counted { model: self.model.as_ref(), looks: AtomicU32::new(0) };
        // Both answers count alike.
        let _ = settle(&counted, &self.contact, share * self.capacity);
        counted.looks.into_inner()
    }
}

/// The most that the soil carries down to axle depth [N]; none where it carries any load.
fn capacity(model: &Model, contact: &Contact) -> Option<f64> {
    /// More than any soil of the map carries of a wheel [N].
    const TOO_MUCH: f64 = 1e12;
    match settle(model.as_ref(), contact, TOO_MUCH) {
        Err(SettleError::SunkToAxle { capacity, .. }) => Some(capacity),
        _ => None,
    }
}

/// A model that counts how often it is asked; asked for all forces each time, it hides no look.
struct Counted<'a> {
    model: &'a dyn WheelSoilModel,
    looks: AtomicU32,
}

impl WheelSoilModel for Counted<'_> {
    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        self.looks.fetch_add(1, Ordering::Relaxed);
        self.model.forces(contact, sinkage)
    }

    fn most_normal_force(&self, contact: &Contact, sinkage: f64) -> f64 {
        self.model.most_normal_force(contact, sinkage)
    }
}

impl Display for CostMap {
    /// A table for each model.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for model in &Model::ALL {
            let driving = self.driving(model);
            writeln!(f, "{}: 1 is a driving wheel's {driving:.1} looks", model.name())?;
            write!(f, "slip ratio  load ")?;
            LOAD_SHARES.iter().try_for_each(|share| write!(f, "{:>6.0} %", 100.0 * share))?;
            writeln!(f, "  of what the soil carries")?;
            for (ratio, row) in SLIP_RATIOS.iter().zip(self.worst(model)) {
                write!(f, "{ratio:>10.1}       ")?;
                row.iter().try_for_each(|cost| write!(f, "{cost:>8.1}"))?;
                writeln!(f)?;
            }
            writeln!(f)?;
        }
        Ok(())
    }
}
