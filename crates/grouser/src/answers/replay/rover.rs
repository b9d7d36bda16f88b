//! The rover with the radius of its wheels that a drive points to.

use serde_json::{Value, json};

use super::ReplayQuestion;
use crate::document::reading::four_digits;
use crate::document::{Document, Kind};
use crate::studies::replay::{Attribution, Finding, Parameter, Replay};

impl ReplayQuestion {
    /// The document of the rover with another radius of its wheels, where the differences point to
    /// the speed of the rims; `None` where they do not, and for a rover whose wheels are not alike:
    /// with other radii these would no longer stand on one plane.
    ///
    /// ```text
    /// r' + h_g = (1 + share) (r + h_g)
    /// ```
    pub(super) fn changed_rover(&self, replay: &Replay) -> Option<Document> {
        let is_speed = |it: &&Finding| it.parameter == Parameter::Speed;
        let found = replay.findings.iter().find(is_speed)?;
        if matches!(found.verdict, Attribution::Nothing | Attribution::CannotTell) {
            return None;
        }
        let mounts = self.scenario.value.rover.mounts();
        let wheel = &mounts.first()?.unit.wheel;
        let are_alike = mounts.iter().all(|it| {
            (it.unit.wheel.radius, it.shearing_radius())
                == (wheel.radius, mounts[0].shearing_radius())
        });
        let radius = round(wheel.radius + found.estimate * mounts[0].shearing_radius());
        let is_one = (0.01..=1.0).contains(&radius);
        let rover = self.scenario.document.part(Kind::Rover, "rover")?;
        if !(are_alike && is_one) {
            return None;
        }
        let why = self.why(found, wheel.radius);
        Some(rover.changed(|keys| {
            keys.get_mut("wheel_unit").into_iter().for_each(|it| change(it, radius, &why));
            let mounts = keys.get_mut("mount").and_then(Value::as_array_mut);
            mounts.into_iter().flatten().for_each(|it| change(it, radius, &why));
        }))
    }

    /// Where the radius comes from.
    fn why(&self, found: &Finding, was: f64) -> String {
        let [share, deviation] =
            [found.estimate, found.deviation].map(|it| four_digits(100.0 * it));
        format!(
            "radius_m: by a replay of {}, in which the rims are {share} ± {deviation} % faster than \
             was read; it was {}; an encoder's scale, or the odometry's, does the same",
            self.log,
            four_digits(was)
        )
    }
}

/// To the hundredth of a millimetre: no replay knows it better.
fn round(radius: f64) -> f64 {
    (radius * 1e5).round() / 1e5
}

/// Gives a wheel's table, if this table has one, another radius, with its reason in place of what
/// was assumed of the one before.
fn change(unit: &mut Value, radius: f64, why: &str) {
    let Some(Value::Object(wheel)) = unit.get_mut("wheel") else { return };
    wheel.insert("radius_m".to_owned(), radius.into());
    let assumed = wheel.entry("assumed").or_insert_with(|| json!([]));
    if let Value::Array(all) = assumed {
        all.retain(|it| !it.as_str().is_some_and(|it| it.starts_with("radius_m:")));
        all.push(why.into());
    }
}
