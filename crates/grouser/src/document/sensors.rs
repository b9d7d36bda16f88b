//! Settings of simulated instruments, as they are written.

use std::ops::RangeInclusive;

use grouser_io::nearest;
use grouser_io::unit::{DEG, M, MM, NM, ONE, RAD_S, Unit};

use crate::studies::simulated_telemetry::SensorModels;

/// A number of the instruments.
pub struct SensorKey {
    /// With its unit.
    pub key: &'static str,
    /// Unit of the number.
    pub unit: Unit,
    /// What it is.
    pub doc: &'static str,
    range: RangeInclusive<f64>,
    place: fn(&mut SensorModels) -> &mut f64,
}

/// The word for instruments without a fault.
pub const PERFECT: &str = "perfect";

const SIZE: RangeInclusive<f64> = 0.0..=1e3;
const BIAS: RangeInclusive<f64> = -1e3..=1e3;
const SHARE: RangeInclusive<f64> = 0.0..=1.0;

/// All of them.
pub const KEYS: [SensorKey; 20] = [
    key("roll_pitch_noise_deg", DEG, "noise of roll and pitch", SIZE, |it| &mut it.attitude.noise),
    key("roll_pitch_bias_deg", DEG, "added to roll and pitch", BIAS, |it| &mut it.attitude.bias),
    key("roll_pitch_step_deg", DEG, "step of roll and pitch", SIZE, |it| &mut it.attitude.step),
    key("yaw_noise_deg", DEG, "noise of the yaw", SIZE, |it| &mut it.yaw.noise),
    key("yaw_bias_deg", DEG, "added to the yaw", BIAS, |it| &mut it.yaw.bias),
    key("vo_noise_m", M, "noise of each way by odometry", SIZE, |it| &mut it.odometry.noise),
    key("vo_relative_noise", ONE, "its part that grows with the way", SIZE, |it| {
        &mut it.odometry.relative_noise
    }),
    key("vo_bias_m", M, "added to each way", BIAS, |it| &mut it.odometry.bias),
    key("vo_step_m", M, "step of ways", SIZE, |it| &mut it.odometry.step),
    key("vo_rotation_noise_deg", DEG, "noise of each rotation", SIZE, |it| &mut it.rotation.noise),
    key("wheel_speed_noise_rad_s", RAD_S, "noise of wheel speeds", SIZE, |it| {
        &mut it.wheel_speed.noise
    }),
    key("torque_noise_nm", NM, "noise of torques; of currents, in A", SIZE, |it| {
        &mut it.torque.noise
    }),
    key("torque_relative_noise", ONE, "its part that grows with the torque", SIZE, |it| {
        &mut it.torque.relative_noise
    }),
    key("torque_bias_nm", NM, "added to torques; to currents, in A", BIAS, |it| {
        &mut it.torque.bias
    }),
    key("torque_step_nm", NM, "step of torques; of currents, in A", SIZE, |it| &mut it.torque.step),
    key("sinkage_noise_mm", MM, "noise of sinkages", SIZE, |it| &mut it.sinkage.noise),
    key("sinkage_relative_noise", ONE, "its part that grows with the sinkage", SIZE, |it| {
        &mut it.sinkage.relative_noise
    }),
    key("dropouts", ONE, "share of readings that are missing", SHARE, |it| &mut it.dropouts),
    key("outliers", ONE, "share of readings that are wrong by far", SHARE, |it| &mut it.outliers),
    key("rate_hz", ONE, "readings a second; 0 for one at each record", SIZE, |it| &mut it.rate),
];

const fn key(
    key: &'static str,
    unit: Unit,
    doc: &'static str,
    range: RangeInclusive<f64>,
    place: fn(&mut SensorModels) -> &mut f64,
) -> SensorKey {
    SensorKey { key, unit, doc, range, place }
}

/// Instruments with settings: those of a micro rover, changed by `KEY=VALUE` one after the other,
/// or without a fault from the word [`PERFECT`] on.
///
/// # Errors
/// A sentence for the first invalid setting.
pub fn sensor_models<'s>(
    settings: impl IntoIterator<Item = &'s str>,
) -> Result<SensorModels, String> {
    let mut models = SensorModels::USUAL;
    for setting in settings {
        if setting == PERFECT {
            models = SensorModels::PERFECT;
            continue;
        }
        let (name, value) = setting
            .split_once('=')
            .ok_or_else(|| format!("'{setting}' is neither KEY=VALUE nor the word {PERFECT}"))?;
        let key = KEYS.iter().find(|it| it.key == name.trim()).ok_or_else(|| {
            let names = || KEYS.iter().map(|it| it.key);
            match nearest(name, names()) {
                Some(meant) => format!("there is no '{name}': did you mean `{meant}`?"),
                None => {
                    format!(
                        "there is no '{name}': there are {}",
                        names().collect::<Vec<_>>().join(", ")
                    )
                }
            }
        })?;
        let number = value.trim().parse::<f64>().ok().filter(|it| key.range.contains(it));
        let number = number.ok_or_else(|| {
            let (least, most) = (key.range.start(), key.range.end());
            format!("{name} is '{value}', it must be a number from {least} to {most}")
        })?;
        *(key.place)(&mut models) = key.unit.to_si(number);
    }
    Ok(models)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_change_what_they_name() {
        let models =
            sensor_models(["perfect", "roll_pitch_noise_deg=0.5", "outliers=0.05"]).unwrap();
        assert!((models.attitude.noise - 0.5_f64.to_radians()).abs() < 1e-12);
        assert_eq!((models.outliers, models.dropouts, models.torque.noise), (0.05, 0.0, 0.0));
        assert_eq!(sensor_models([]).unwrap(), SensorModels::USUAL);
    }

    #[test]
    fn what_is_no_setting_is_said() {
        for (setting, words) in [
            ("roll_pitch_nois_deg=1", "did you mean `roll_pitch_noise_deg`"),
            ("colour=1", "there are roll_pitch_noise_deg"),
            ("outliers=2", "from 0 to 1"),
            ("outliers=many", "must be a number"),
            ("imperfect", "neither KEY=VALUE"),
        ] {
            let said = sensor_models([setting]).unwrap_err();
            assert!(said.contains(words), "{said}");
        }
    }
}
