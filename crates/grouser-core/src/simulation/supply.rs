//! What has become of the battery and of the motors' windings in a run.
//!
//! Both change in seconds to hours, the motion in milliseconds: they are carried on from one look
//! at the rover to the next, [a tenth of a second](super::watch::WATCH_PERIOD) later, by the mean
//! of what motors take at both. What that leaves of voltage and current limits the motors from the
//! next [`LIMIT_PERIOD`] on.

use super::outcome::{Outcome, PowerLost};
use super::times::is_same_time;
use crate::stored::stored;
use crate::vehicle::{Electrical, MotorLimits, Rover, Terminals};

/// Time between two changes of the motors' limits [s]. Source: ours; the windings of the smallest
/// motors take ten times as long to warm.
pub(super) const LIMIT_PERIOD: f64 = 1.0;

/// The state of the battery, at a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Charge {
    /// State of charge, *q* [-].
    pub charge: f64,
    /// Voltage and current at its terminals.
    pub terminals: Terminals,
}

/// Battery and windings on their way.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Supply {
    /// Temperature of each motor's winding, where it is known [°C].
    temperatures: Vec<Option<f64>>,
    /// State of charge [-].
    charge: f64,
    /// Voltage and current of the battery, if there is one.
    terminals: Option<Terminals>,
    /// What electronics took, and warm windings more than those at 20 °C [J].
    beside: f64,
    /// What each motor may take.
    limits: Vec<MotorLimits>,
    last: Option<Look>,
}

stored!(struct Supply { temperatures, charge, terminals, beside, limits, last });

/// What was seen at a look.
#[derive(Clone, Debug, PartialEq)]
struct Look {
    time: f64,
    taken: Vec<Electrical>,
    /// Heat of each winding [W].
    heats: Vec<f64>,
    /// Rate at which the charge falls [1/s], and power beside that of motors with cold windings
    /// [W].
    discharge: f64,
    beside: f64,
}

stored!(struct Look { time, taken, heats, discharge, beside });

impl Supply {
    /// At the start of a run; none of a rover of which neither is known.
    pub(super) fn of(rover: &Rover) -> Option<Self> {
        if !rover.has_supply() {
            return None;
        }
        let winding = |mount: &crate::vehicle::Mount| mount.unit.motor.and_then(|it| it.winding);
        let temperatures = rover.mounts().iter().map(|it| Some(winding(it)?.surroundings));
        let charge = rover.battery().map_or(1.0, |battery| battery.charge);
        let terminals = rover
            .battery()
            .map(|battery| Terminals { voltage: battery.open_voltage(charge), current: 0.0 });
        let mut supply = Self {
            temperatures: temperatures.collect(),
            charge,
            terminals,
            beside: 0.0,
            limits: Vec::new(),
            last: None,
        };
        supply.limits = supply.limits_of(rover);
        Some(supply)
    }

    /// What each motor may take.
    pub(super) fn limits(&self) -> &[MotorLimits] {
        &self.limits
    }

    /// Temperature of a wheel's winding, where it is known [°C].
    pub(super) fn temperature(&self, wheel: usize) -> Option<f64> {
        self.temperatures[wheel]
    }

    /// Temperature of the warmest winding, where some are known [°C].
    pub(super) fn warmest(&self) -> Option<f64> {
        self.temperatures.iter().flatten().copied().reduce(f64::max)
    }

    /// What electronics took, and warm windings more than those at 20 °C [J].
    pub(super) fn beside(&self) -> f64 {
        self.beside
    }

    /// The battery, if there is one.
    pub(super) fn battery(&self) -> Option<Charge> {
        Some(Charge { charge: self.charge, terminals: self.terminals? })
    }

    /// Looks at the rover; says what becomes of it without power.
    ///
    /// * `taken`: by each motor with its winding at 20 °C
    pub(super) fn look(
        &mut self,
        rover: &Rover,
        time: f64,
        taken: &[Option<Electrical>],
    ) -> Option<Outcome> {
        if self.last.as_ref().is_some_and(|last| is_same_time(last.time, time)) {
            return None;
        }
        let taken: Vec<Electrical> = taken.iter().map(|it| it.unwrap_or_default()).collect();
        let now = self.seen(rover, time, taken);
        if let Some(last) = self.last.take() {
            self.go_on(rover, &last, &now);
        }
        let warm = self.warm(rover, &now.taken);
        let terminals = self.drawn(rover, &warm);
        self.last = Some(now);
        let cutoff = rover.battery()?.cutoff_voltage;
        let because = match terminals {
            _ if self.charge == 0.0 => Some(PowerLost::Empty),
            None => Some(PowerLost::TooMuchDrawn { power: power_of(rover, &warm) }),
            Some(Terminals { voltage, .. }) if voltage < cutoff => {
                Some(PowerLost::BelowCutoff { voltage, cutoff })
            }
            Some(_) => None,
        };
        self.terminals = terminals.or(self.terminals);
        because.map(|because| Outcome::BrownOut { time, because })
    }

    /// What is seen with windings as warm, and a battery as full, as at the look before.
    fn seen(&self, rover: &Rover, time: f64, taken: Vec<Electrical>) -> Look {
        let warm = self.warm(rover, &taken);
        let heats = warm.iter().zip(&taken).map(|(warm, cold)| warm.heat(cold.current)).collect();
        let cold: f64 = taken.iter().map(|cold| cold.power).sum();
        let discharge = rover.battery().zip(self.drawn(rover, &warm)).map(|(battery, drawn)| {
            battery.open_voltage(self.charge) * drawn.current / battery.capacity
        });
        let beside = power_of(rover, &warm) - cold;
        Look { time, taken, heats, discharge: discharge.unwrap_or(0.0), beside }
    }

    /// The battery's terminals, if there is one and it gives what is drawn.
    fn drawn(&self, rover: &Rover, warm: &[Warm]) -> Option<Terminals> {
        rover.battery()?.under(power_of(rover, warm), self.charge)
    }

    /// From one look to the next.
    fn go_on(&mut self, rover: &Rover, last: &Look, now: &Look) {
        let span = now.time - last.time;
        let mean = |one: f64, other: f64| 0.5 * (one + other);
        for (wheel, mount) in rover.mounts().iter().enumerate() {
            let winding = mount.unit.motor.and_then(|motor| motor.winding);
            if let (Some(winding), Some(at)) = (winding, &mut self.temperatures[wheel]) {
                *at = winding.after(*at, mean(last.heats[wheel], now.heats[wheel]), span);
            }
        }
        // A full battery takes no more.
        let charge = self.charge - span * mean(last.discharge, now.discharge);
        self.charge = charge.clamp(0.0, 1.0);
        self.beside += span * mean(last.beside, now.beside);
    }

    /// What the motors take with their windings as warm as they are.
    pub(super) fn warm(&self, rover: &Rover, taken: &[Electrical]) -> Vec<Warm> {
        let each = rover.mounts().iter().zip(taken).zip(&self.temperatures);
        each.map(|((mount, cold), temperature)| {
            let Some(motor) = mount.unit.motor else { return Warm::default() };
            let at = temperature.map_or(motor, |temperature| motor.at_temperature(temperature));
            let voltage = cold.voltage + (at.resistance - motor.resistance) * cold.current;
            let taken = motor.taking(cold.current, voltage);
            Warm { taken, resistance: at.resistance }
        })
        .collect()
    }

    /// Sets the motors' limits to what the battery and their windings allow now; returns whether
    /// that changes what some motor does.
    pub(super) fn renew_limits(&mut self, rover: &Rover) -> bool {
        let new = self.limits_of(rover);
        let taken = self.last.as_ref().map_or(&[][..], |last| &last.taken);
        let each = taken.iter().zip(self.limits.iter().zip(&new));
        let matters = each.into_iter().any(|(taken, (old, new))| {
            let lower = old.and(*new);
            old != new && is_near(taken, lower)
        });
        self.limits = new;
        matters
    }

    fn limits_of(&self, rover: &Rover) -> Vec<MotorLimits> {
        let voltage = self.terminals.map_or(f64::INFINITY, |terminals| terminals.voltage);
        let each = rover.mounts().iter().zip(&self.temperatures);
        each.map(|(mount, temperature)| {
            let motor = mount.unit.motor;
            let most = motor.and_then(|it| it.control?.current).unwrap_or(f64::INFINITY);
            let allowed = motor.and_then(|it| Some(it.winding?.allowed((*temperature)?)));
            let current = allowed.map_or(most, |allowed| allowed * most);
            MotorLimits { voltage, current }
        })
        .collect()
    }
}

/// What a motor takes with its winding as warm as it is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Warm {
    pub(super) taken: Electrical,
    resistance: f64,
}

impl Warm {
    fn heat(&self, current: f64) -> f64 {
        self.resistance * current * current
    }
}

/// Power that motors and electronics draw [W].
fn power_of(rover: &Rover, warm: &[Warm]) -> f64 {
    let electronics = rover.battery().map_or(0.0, |battery| battery.electronics);
    warm.iter().map(|warm| warm.taken.power).sum::<f64>() + electronics
}

/// Whether a motor takes all but what it may.
fn is_near(taken: &Electrical, limits: MotorLimits) -> bool {
    /// So much of it [-].
    const NEAR: f64 = 0.98;
    taken.voltage.abs() >= NEAR * limits.voltage || taken.current.abs() >= NEAR * limits.current
}
