//! Inputs of the units of work.

use grouser::contact::{Contact, Model, Slip};
use grouser::document::{self, DocumentError, Kind, Overrides, Source};
use grouser::simulation::{Approach, Scenario, Start};
use grouser::soil::Soil;
use grouser::units::EARTH_GRAVITY;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Wheels, a rover's run, and many runs with varied soil.
pub struct Fixtures {
    /// Wheels in all kinds of motion, each with its load [N] and the sinkage [m] that carries it.
    pub wheels: Vec<LoadedWheel>,
    /// The same wheels as a batch, each with its load [N].
    pub batch: Vec<(Contact, f64)>,
    /// Those of them that resistive force theory carries, up to 256, each with its load [N].
    pub faceted: Vec<(Contact, f64)>,
    /// The same wheels at the sinkages [m] that carry them.
    pub sunk: Vec<(Contact, f64)>,
    /// Such wheels under loads [N] that the soil cannot carry.
    pub overloaded: Vec<(Contact, f64)>,
    /// The paper's rover on 10°, nose along the contour, for 20 s.
    pub scenario: Scenario,
    /// The same rover on 200 soils, a tenth more or less of everything.
    pub campaign: Vec<Scenario>,
}

/// A wheel, its load [N] and the sinkage [m] at which the soil carries it.
#[derive(Clone, Copy, Debug)]
pub struct LoadedWheel {
    /// The contact.
    pub contact: Contact,
    /// The load [N].
    pub load: f64,
    /// The sinkage [m].
    pub sinkage: f64,
}

/// Wheels of the fixtures.
const WHEELS: usize = 1024;
/// Wheels made of facets.
const FACETED: usize = 256;
/// Runs of the campaign.
const CAMPAIGN: usize = 200;
/// Each soil value of the campaign is within this share of its own.
const VARIATION: f64 = 0.1;

impl Fixtures {
    /// The fixtures, always the same.
    ///
    /// # Errors
    /// [`DocumentError`] if a preset cannot be read.
    ///
    /// # Panics
    /// Never: the presets of these wheels carry their loads.
    pub fn new() -> Result<Self, DocumentError> {
        let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none())?;
        let soil = document::read_soil(&Source::find(Kind::Soil, "toyoura")?, &Overrides::none())?;
        let scenario = scenario.value;
        let mut draws = Draws::new();
        let wheels: Vec<LoadedWheel> =
            (0..WHEELS).map(|_| wheel(&scenario, soil.value, &mut draws)).collect();
        let batch: Vec<_> = wheels.iter().map(|wheel| (wheel.contact, wheel.load)).collect();
        let sunk = wheels.iter().map(|wheel| (wheel.contact, wheel.sinkage)).collect();
        let carried = |(contact, load): &&(Contact, f64)| {
            grouser::contact::settle(Model::Rft.as_ref(), contact, *load).is_ok()
        };
        let faceted = batch.iter().filter(carried).take(FACETED).copied().collect();
        let mut loads = Draws::of_stream(2);
        let overload = |wheel: &LoadedWheel| overloaded(wheel, &mut loads);
        let overloaded = wheels.iter().map(overload).collect();
        let campaign = (0..CAMPAIGN).map(|_| varied(&scenario, &mut draws)).collect();
        Ok(Self { wheels, batch, faceted, sunk, overloaded, scenario, campaign })
    }
}

/// A wheel of the paper's rover: 5 to 40 N, slip ratios −0.3 to 0.9, slip angles up to 45°.
fn wheel(scenario: &Scenario, soil: Soil, draws: &mut Draws) -> LoadedWheel {
    loop {
        let load = draws.between(5.0, 40.0);
        let slip =
            Slip::on_test_stand(draws.between(-0.3, 0.9), draws.between(-45.0, 45.0).to_radians());
        let wheel = scenario.rover.mounts()[0].unit.wheel;
        let contact = Contact { wheel, soil, slip, gravity: EARTH_GRAVITY };
        if let Ok(settled) = grouser::contact::settle(Model::Ishigami.as_ref(), &contact, load) {
            return LoadedWheel { contact, load, sinkage: settled.sinkage };
        }
    }
}

/// The same wheel under a load [N] from a little more than the soil carries to ten times that.
fn overloaded(wheel: &LoadedWheel, draws: &mut Draws) -> (Contact, f64) {
    let model = Model::Ishigami.as_ref();
    let contact = wheel.contact;
    let at_axle = model.forces(&contact, contact.wheel.shearing_radius()).normal_force;
    loop {
        let load = at_axle * draws.between(1.02, 10.0);
        if grouser::contact::settle(model, &contact, load).is_err() {
            return (contact, load);
        }
    }
}

/// The scenario on another soil, at another yaw, with velocities in balance as a campaign has them.
fn varied(scenario: &Scenario, draws: &mut Draws) -> Scenario {
    let mut scenario = scenario.clone();
    let soil = &mut scenario.ground.soil;
    soil.friction_angle *= draws.between(1.0 - VARIATION, 1.0 + VARIATION);
    soil.cohesion *= draws.between(1.0 - VARIATION, 1.0 + VARIATION);
    scenario.numerics.approach = Approach::QuasiSteady;
    scenario.start = Start { yaw: draws.between(0.0, 10.0).to_radians(), ..scenario.start };
    scenario
}

/// Random numbers, the same at each call.
pub(crate) struct Draws(ChaCha8Rng);

impl Draws {
    pub(crate) fn new() -> Self {
        Self::of_stream(1)
    }

    fn of_stream(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        /// 2^-53: what a 53-bit integer is times to lie in [0, 1).
        const UNIT: f64 = 1.110_223_024_625_156_5e-16;
        let share = (self.0.next_u64() >> 11) as f64 * UNIT;
        low + (high - low) * share
    }
}
