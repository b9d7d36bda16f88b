//! Drives by the card on sand that obeys none of its models: friction is mobilised otherwise.
//!
//! The models mobilise shear stress by 1 − exp(−j/K) (Janosi and Hanamoto 1961). Here it is
//! j/(K + j), Kondner's hyperbola (1963), which rises as steeply and then far slower. A law of that
//! kind has the modulus K' = j/ln(1 + j/K) under a wheel whose soil is sheared by j in the mean.

use grouser::contact::{Contact, Model, WheelForces, WheelSoilModel};
use grouser::simulation::Approach;
use grouser::soil::{Shear, ShearModulus, Soil};
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::verdict::{STUCK_ON_GO, Verdict};

use super::card;

/// A model whose shear stress is mobilised by a hyperbola.
struct Hyperbolic {
    /// All else.
    model: Model,
}

impl WheelSoilModel for Hyperbolic {
    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        let Contact { wheel, slip, .. } = contact;
        let radius = wheel.shearing_radius();
        let arc = (1.0 - sinkage / radius).clamp(-1.0, 1.0).acos();
        let sheared = |share: f64| 0.5 * radius * arc * share.abs().min(1.0);
        let moved = |modulus: ShearModulus, sheared: f64| {
            let modulus = modulus.at(slip.angle);
            let ratio = sheared / modulus;
            let factor = if ratio > 1e-9 { ratio / ratio.ln_1p() } else { 1.0 };
            ShearModulus::constant(factor * modulus)
        };
        let shear = match contact.soil.shear {
            Shear::Anisotropic { longitudinal, lateral } => Shear::Anisotropic {
                longitudinal: moved(longitudinal, sheared(slip.ratio)),
                lateral: moved(lateral, sheared(slip.lateral)),
            },
            Shear::Isotropic { modulus } => Shear::Isotropic {
                modulus: moved(modulus, sheared(slip.ratio.hypot(slip.lateral))),
            },
        };
        let soil = Soil { shear, ..contact.soil };
        self.model.as_ref().forces(&Contact { soil, ..*contact }, sinkage)
    }
}

/// On go rows at most five drives of a thousand get stuck, and the stated drift is kept by more
/// than 85 %; on the others as many get stuck as stated.
fn check(soils: u32, slopes_deg: &[f64]) {
    let otherwise = |sample: Sample| Sample {
        model: Model::own(Hyperbolic { model: sample.model }),
        soil: sample.soil,
    };
    let [all] = card::drives(soils, slopes_deg, [(1.0, Approach::QuasiSteady)], otherwise);
    for drives in &all {
        let slope = drives.slope.to_degrees();
        let most = match drives.verdict {
            Verdict::Go => STUCK_ON_GO,
            _ => drives.stated_stuck.interval().1,
        };
        assert!(drives.stuck.estimate() <= most, "{slope}°: {drives:?}");
        assert!(drives.within.estimate() >= 0.85, "{slope}°: {drives:?}");
    }
    assert!(all.iter().any(|drives| drives.verdict == Verdict::Go));
}

#[test]
fn the_card_holds_where_friction_is_mobilised_otherwise() {
    check(40, &[3.0, 8.0, 14.0]);
}

/// The same of a thousand soils on every slope of the page.
#[test]
#[ignore = "minutes"]
fn the_card_holds_on_a_thousand_soils_where_friction_is_mobilised_otherwise() {
    let slopes: Vec<f64> = (1..18).map(f64::from).collect();
    check(1000, &slopes);
}
