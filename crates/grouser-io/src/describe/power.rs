//! `motor/1`: a motor with its gear; and the battery of `rover/1`.

use super::super::field::{
    A, At, DEG_C, J_K, K_W, NM, NM_A, OHM, ONE, Table, V, V_RAD, V_S_RAD, W, WH, flag, number,
    positive, preset, table,
};
use super::about::{assumed, name, notes, schema, source};
use grouser_core::vehicle::{Battery, Motor, SpeedControl, Winding};

/// A motor before its numbers are put in.
pub(crate) const NO_MOTOR: Motor = Motor {
    resistance: 0.0,
    torque_constant: 0.0,
    gear_ratio: 0.0,
    efficiency: 0.0,
    friction: 0.0,
    is_self_locking: false,
    feeds_back: false,
    control: None,
    winding: None,
};

const NO_CONTROL: SpeedControl =
    SpeedControl { gain: 0.0, integral: 0.0, voltage: None, current: None };

const NO_WINDING: Winding = Winding {
    thermal_resistance: 0.0,
    heat_capacity: 0.0,
    surroundings: 20.0,
    highest: 0.0,
    derated_from: None,
};

/// A battery before its numbers are put in.
pub(super) const NO_BATTERY: Battery = Battery {
    capacity: 0.0,
    full_voltage: 0.0,
    empty_voltage: 0.0,
    resistance: 0.0,
    cutoff_voltage: 0.0,
    electronics: 0.0,
    charge: 1.0,
};

pub(crate) static MOTOR: Table<Motor> = Table {
    doc: "A DC motor behind a gear. Without a speed controller it turns as fast as it is set to, \
          and takes the current that this needs.",
    fields: &[
        schema("motor/1"),
        name(),
        source(),
        notes(),
        assumed(),
        preset(
            "A preset whose keys it takes where it has none of its own: those of the motor and \
                the gear of a data sheet.",
        ),
        positive(
            "resistance_ohm",
            OHM,
            1e6,
            "Resistance of the winding at 20 °C, R",
            |motor: &mut Motor| Some(&mut motor.resistance),
        ),
        positive(
            "torque_constant_nm_a",
            NM_A,
            1e4,
            "Torque constant, k, which is that of the induced voltage, too",
            |motor: &mut Motor| Some(&mut motor.torque_constant),
        ),
        positive(
            "gear_ratio",
            ONE,
            1e6,
            "Turns of the motor for one of the wheel, N",
            |motor: &mut Motor| Some(&mut motor.gear_ratio),
        ),
        number(
            "gear_efficiency",
            ONE,
            0.01..=1.0,
            "Efficiency of the gear, η",
            |motor: &mut Motor| Some(&mut motor.efficiency),
        ),
        number(
            "friction_torque_nm",
            NM,
            0.0..=1e3,
            "Torque of friction at the motor's shaft, τ_f",
            |motor: &mut Motor| Some(&mut motor.friction),
        )
        .or(0.0),
        flag(
            "self_locking",
            "Whether the wheel cannot turn the gear: then the motor holds a slope without current, \
             and brakes with none.",
            |motor: &mut Motor, yes| motor.is_self_locking = yes,
        )
        .optional(),
        flag(
            "feeds_back",
            "Whether its braking power is taken back into the battery: then its power is below 0 \
             where it brakes. Left out, it is not, and that power is lost.",
            |motor: &mut Motor, yes| motor.feeds_back = yes,
        )
        .optional(),
        table(
            "control",
            "Its speed controller: with one, the wheel turns slower under load. Left out, it turns \
             as fast as it is set to, whatever that takes.",
            &At {
                inner: &CONTROL,
                at: |motor: &mut Motor| motor.control.get_or_insert(NO_CONTROL),
            },
        )
        .optional(),
        table(
            "winding",
            "How warm its winding becomes; left out, nothing is said of that.",
            &At {
                inner: &WINDING,
                at: |motor: &mut Motor| motor.winding.get_or_insert(NO_WINDING),
            },
        )
        .optional(),
    ],
};

static CONTROL: Table<SpeedControl> = Table {
    doc: "A speed controller: proportional, or with an integral, and within limits.",
    fields: &[
        number(
            "gain_v_s_rad",
            V_S_RAD,
            0.0..=1e9,
            "Voltage that it adds to that of the set speed for each rad/s that the wheel is too \
             slow, K_p",
            |control: &mut SpeedControl| Some(&mut control.gain),
        ),
        number(
            "integral_v_rad",
            V_RAD,
            0.0..=1e9,
            "Voltage that it adds for each radian that the wheel is behind, K_i; 0 leaves an error \
             under load, the droop",
            |control: &mut SpeedControl| Some(&mut control.integral),
        )
        .or(0.0),
        positive(
            "voltage_limit_v",
            V,
            1e5,
            "The most voltage that it gives; left out, as much as the battery has, or any",
            |control: &mut SpeedControl| Some(control.voltage.get_or_insert(0.0)),
        )
        .optional(),
        positive(
            "current_limit_a",
            A,
            1e5,
            "The most current that it gives; left out, any",
            |control: &mut SpeedControl| Some(control.current.get_or_insert(0.0)),
        )
        .optional(),
    ],
};

static WINDING: Table<Winding> = Table {
    doc: "A winding that warms by its current and cools to its surroundings, as one body.",
    fields: &[
        positive(
            "thermal_resistance_k_w",
            K_W,
            1e6,
            "From the winding to its surroundings, R_th",
            |winding: &mut Winding| Some(&mut winding.thermal_resistance),
        ),
        positive(
            "heat_capacity_j_k",
            J_K,
            1e6,
            "Heat capacity, C: the thermal time constant over R_th",
            |winding: &mut Winding| Some(&mut winding.heat_capacity),
        ),
        number(
            "surroundings_degc",
            DEG_C,
            -270.0..=500.0,
            "Temperature of its surroundings, and its own at the start",
            |winding: &mut Winding| Some(&mut winding.surroundings),
        )
        .or(20.0),
        number(
            "highest_degc",
            DEG_C,
            -270.0..=1000.0,
            "The highest temperature that it stands",
            |winding: &mut Winding| Some(&mut winding.highest),
        ),
        number(
            "derated_from_degc",
            DEG_C,
            -270.0..=1000.0,
            "Temperature from which on the current limit falls, to nothing at the highest; left \
             out, it does not",
            |winding: &mut Winding| Some(winding.derated_from.get_or_insert(0.0)),
        )
        .optional(),
    ],
};

pub(super) static BATTERY: Table<Battery> = Table {
    doc: "A battery behind its internal resistance, and the electronics that it feeds besides the \
          motors.",
    fields: &[
        positive(
            "capacity_wh",
            WH,
            1e9,
            "Energy that it holds when it is full",
            |battery: &mut Battery| Some(&mut battery.capacity),
        ),
        positive(
            "full_voltage_v",
            V,
            1e5,
            "Open-circuit voltage when it is full",
            |battery: &mut Battery| Some(&mut battery.full_voltage),
        ),
        positive(
            "empty_voltage_v",
            V,
            1e5,
            "Open-circuit voltage when it is empty; it falls in a line",
            |battery: &mut Battery| Some(&mut battery.empty_voltage),
        ),
        number(
            "internal_resistance_ohm",
            OHM,
            0.0..=1e6,
            "Internal resistance, R_b",
            |battery: &mut Battery| Some(&mut battery.resistance),
        )
        .or(0.0),
        number(
            "cutoff_voltage_v",
            V,
            0.0..=1e5,
            "Voltage at its terminals below which the electronics switch off: the rover stops with \
             `brown_out`",
            |battery: &mut Battery| Some(&mut battery.cutoff_voltage),
        )
        .or(0.0),
        number(
            "electronics_w",
            W,
            0.0..=1e6,
            "Power that the electronics draw all the time",
            |battery: &mut Battery| Some(&mut battery.electronics),
        )
        .or(0.0),
        number(
            "state_of_charge",
            ONE,
            0.0..=1.0,
            "State of charge at the start",
            |battery: &mut Battery| Some(&mut battery.charge),
        )
        .or(1.0),
    ],
};
