"""Keys of the documents as attributes, for type checkers. Written by ``generate_keys.py`` from the
schemas of the documents; a description finds its keys itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

if TYPE_CHECKING:
    from typing_extensions import Required


class SoilKnownFrom(TypedDict, total=False):
    """Where the constants are from, for priors: how widely bands draw about them."""

    strength: str
    """Cohesion and friction angle; without it, this soil."""
    pressure_sinkage: str
    """Moduli and exponent of sinkage; likewise."""
    shear: str
    """Shear moduli; likewise."""


class SoilPressureSinkage(TypedDict, total=False):
    """How pressure grows with sinkage."""

    law: Required[str]
    k_c: Required[float]
    """Cohesive modulus, k'_c [-]; a negative one needs `domain.width_m`."""
    k_phi: Required[float]
    """Frictional modulus, k'_φ [-]; a negative one needs `domain.width_m`."""
    n: Required[float]
    """Sinkage exponent at zero slip, n [-]."""
    n_per_slip: float
    """Growth of n with the slip ratio while driving [-]."""
    n_per_skid: float
    """Growth of n with the size of the slip ratio while skidding [-]."""


class SoilStressPeak(TypedDict, total=False):
    """Where along the arc the normal stress peaks."""

    a0: float
    """Share of the entry angle at zero slip, a₀ [-]."""
    a1: float
    """Its growth with the slip ratio, a₁ [-]."""


class SoilShear(TypedDict, total=False):
    """How shear stress is mobilised."""

    law: Required[str]
    longitudinal_m: Required[float]
    """Modulus along the wheel at zero slip angle, K_x [m]."""
    longitudinal_per_rad_m: float
    """Its growth with the slip angle [m/rad]."""
    lateral_m: float
    """Modulus across the wheel at zero slip angle, K_y [m]."""
    lateral_per_rad_m: float
    """Its growth with the slip angle [m/rad]."""
    bound: str
    """Whether the soil's resistance is kept within its friction and cohesion."""
    longitudinal_per_rad2_m: float
    """Its growth with the square of the slip angle [m/rad²]."""
    lateral_per_rad2_m: float
    """Its growth with the square of the slip angle [m/rad²]."""
    slip_angle_limit_deg: float
    """The largest slip angle that the fits know; beyond it they stay [°]."""


class SoilExit(TypedDict, total=False):
    """Where the wheel leaves the soil."""

    law: str
    """The law; may be left out."""
    ratio: float
    """Wheel sinkage ratio, λ [-]."""
    at_zero: float
    """λ at zero slip [-]."""
    per_slip: float
    """Its growth with the slip ratio [-]."""
    per_slip2: float
    """Its growth with the square of the slip ratio [-]."""


class SoilBulldozing(TypedDict, total=False):
    """How soil pushed aside loads the side wall."""

    law: Required[str]
    """How that force depends on the slip angle."""


class SoilSmallWheelSinkage(TypedDict, total=False):
    """How a moving wheel sinks deeper than a plate."""

    with_slip_angle: float
    """Growth per sin β/(cos β + 0.3) [-]."""
    with_slip: float
    """Growth with the slip by total speed, S/(1 − bend S) [-]."""
    bend: float
    """How that growth bends: above 0 it speeds up with slip, below 0 it slows down [-]."""
    locked: float
    """Growth of a locked wheel [-]."""
    sharpness: float
    """How much the larger of two growths hides the smaller; at 1 they add up [-]."""


class SoilSmallWheelExit(TypedDict, total=False):
    """How the exit moves with the motion."""

    fading: float
    """Share of λ that a wheel spinning on the spot has lost, in proportion to the slip by total
    speed [-]."""
    with_slip: float
    """Growth with the slip by total speed, while driving [-]."""
    with_slip_angle: float
    """Growth with |sin β| [-]."""


class SoilSmallWheelInterface(TypedDict, total=False):
    """Friction between wheel and soil."""

    friction_angle_deg: float
    """Friction angle of the wheel-soil interface, δ, where below the soil's own [°]."""
    friction_share: float
    """Without it: δ of a wheel without grousers, as a share of the soil's friction angle [-]."""


class SoilSmallWheelSideWall(TypedDict, total=False):
    """The soil's load on the side wall of the wheel."""

    pressure_factor: float
    """Factor on the passive pressure, for the bow wave at the wall and for its ends [-]."""
    fading: float
    """How fast the load fades with slip or skid: e^(−fading |S|) [-]."""
    friction: float
    """Coefficient of friction of the side face, μ_f [-]."""


class SoilSmallWheelMounds(TypedDict, total=False):
    """Soil pushed by the width of the rim."""

    bow_wave: float
    """In front of a wheel that skids [-]."""
    rear_mound: float
    """Behind a wheel that spins [-]."""


class SoilSmallWheel(TypedDict, total=False):
    """Terms of the model `small-wheel`, for one wheel on this soil; general values without it."""

    sinkage: SoilSmallWheelSinkage
    """How a moving wheel sinks deeper than a plate."""
    exit: SoilSmallWheelExit
    """How the exit moves with the motion."""
    interface: SoilSmallWheelInterface
    """Friction between wheel and soil."""
    side_wall: SoilSmallWheelSideWall
    """The soil's load on the side wall of the wheel."""
    mounds: SoilSmallWheelMounds
    """Soil pushed by the width of the rim."""


class SoilRft(TypedDict, total=False):
    """Constants of the model `rft`, resistive force theory; as published without it."""

    scale: float
    """Factor on the stiffness that follows from density and friction angle [-]."""
    surface_friction_angle_deg: float
    """Friction angle between the wheel and the soil, δ [°]; without it the soil's own."""


class SoilDomain(TypedDict, total=False):
    """The ranges within which the constants were measured or fitted; not stated without it."""

    wheel: str
    """The wheel of the fit, by its preset's name."""
    load_n: tuple[float, ...]
    """Loads on the wheel [N]."""
    radius_m: tuple[float, ...]
    """Radii of the rims, without grousers, r [m]."""
    width_m: tuple[float, ...]
    """Widths of the wheels or plates, b [m]."""
    sinkage_over_radius: tuple[float, ...]
    """Sinkages, as h/r_s [-]."""
    slip_ratio: tuple[float, ...]
    """Slip ratios, s [-]."""
    slip_angle_deg: tuple[float, ...]
    """Sizes of the slip angles, |β| [°]."""
    gravity_m_s2: tuple[float, ...]
    """Gravities, g [m/s²]."""


class SoilDiscrepancy(TypedDict, total=False):
    """What the model gets wrong under one wheel, from a calibration; nothing without it."""

    drawbar_pull: tuple[float, ...]
    """Added to the drawbar pull, in shares of the load [-]."""
    side_force: tuple[float, ...]
    """Added to the side force, in shares of the load; it begins with 15°, since there is none at
    0° [-]."""
    sinkage: tuple[float, ...]
    """Added to the logarithm of the sinkage [-]."""
    torque: tuple[float, ...]
    """Added to the torque, in shares of the load times the shearing radius [-]."""


class SoilUncertaintySamples(TypedDict, total=False):
    """Rows of numbers that belong together, such as a posterior's: each run takes one of them."""

    csv: Required[str]
    """What a CSV file would say: keys in the first line, a sample in every other."""


class SoilUncertaintyParameter(TypedDict, total=False):
    """A number that is not known exactly. Its distribution is cut off at the ends of the key's
    range."""

    distribution: str
    key: Required[str]
    """A number of this document or, in a campaign, of what is varied, with the tables it stands
    in: `pressure_sinkage.k_phi`, `soil.cohesion_kpa`."""
    mean: float
    """Its mean, in the unit of the key; without it, the value that the key has."""
    standard_deviation: float
    """Its standard deviation, in the unit of the key."""
    low: float
    """The lower end, in the unit of the key."""
    high: float
    """The upper end, in the unit of the key."""
    mode: float
    """The most likely value, in the unit of the key."""


class SoilUncertaintyCorrelation(TypedDict, total=False):
    """How two keys go together."""

    between: Required[tuple[str, ...]]
    """Two of the uncertain keys."""
    value: Required[float]
    """Their correlation (of the logarithm, where a key is lognormal) [-]."""


class SoilUncertainty(TypedDict, total=False):
    """How well the numbers above are known; without it, as well as the priors say."""

    samples: SoilUncertaintySamples
    """Rows of numbers that belong together, such as a posterior's: each run takes one of them."""
    parameter: tuple[SoilUncertaintyParameter, ...]
    """The numbers that are not known exactly, each with its distribution."""
    correlation: tuple[SoilUncertaintyCorrelation, ...]
    """Correlations between them; pairs that are not named have none."""


class SoilPriorsMissing(TypedDict, total=False):
    """What is believed of a number of a soil."""

    distribution: str
    key: Required[str]
    """A number of a soil, with the tables it stands in: `exit.ratio`."""
    relative_to: str
    """A number of the soil of which the numbers of this row are multiples; without it, they are in
    the key's unit."""
    mean: float
    """Its mean, in the unit of the key; without it, the value that the key has."""
    median: float
    """Its median, in place of the mean."""
    standard_deviation: float
    """Its standard deviation, in the unit of the key."""
    soils: str
    """The soils that it is about, by their `consistency`; without it, all."""
    unless: str
    """A table, or a key, of the soil: the row is only for soils that do not have it."""
    when: str
    """A keyword of the soil and what it has to be, as `known_from.shear=copied`: the row is only
    for soils that have it."""
    reason: str
    """Why it is so, in a sentence; a document of its own must have it."""
    source: str
    """Where it was read; with `assumed` before it, what stands for a source."""
    low: float
    """The lower end, in the unit of the key."""
    high: float
    """The upper end, in the unit of the key."""
    mode: float
    """The most likely value, in the unit of the key."""


class SoilPriorsKeyword(TypedDict, total=False):
    """A keyword that a soil does not state."""

    key: Required[str]
    """A keyword of a soil, with the tables it stands in: `bulldozing.law`."""
    word: Required[str]
    """The keyword that stands there."""
    reason: str
    """Why it is so, in a sentence; a document of its own must have it."""
    source: str
    """Where it was read."""


class SoilPriorsCorrelation(TypedDict, total=False):
    """How two keys go together, and why."""

    between: Required[tuple[str, ...]]
    """Two of the uncertain keys."""
    value: Required[float]
    """Their correlation (of the logarithm, where a key is lognormal) [-]."""
    reason: str
    """Why it is so, in a sentence; a document of its own must have it."""


class SoilPriors(TypedDict, total=False):
    """What is believed of the numbers that are not stated above; without it, `general`. In a
    resolved document, the rows that hold for this soil: a number that they call missing is the
    prior's, not the source's."""

    schema: str
    """Kind and version of this document."""
    name: str
    """What people call it."""
    source: str
    """Where the rows come from."""
    notes: str
    """Anything else worth knowing."""
    missing: tuple[SoilPriorsMissing, ...]
    """Numbers that a soil does not state: a single answer takes the median, a band draws."""
    keyword: tuple[SoilPriorsKeyword, ...]
    """Keywords that a soil does not state."""
    stated: tuple[SoilPriorsMissing, ...]
    """How well a stated number is known, where the soil does not say: bands draw about it."""
    correlation: tuple[SoilPriorsCorrelation, ...]
    """Correlations between them; pairs that are not named have none."""


class SoilKeys:
    """Keys of a soil."""

    __slots__ = ()

    if TYPE_CHECKING:

        @property
        def schema(self) -> str:
            """Kind and version of this document."""
            ...

        @property
        def name(self) -> str:
            """What people call it."""
            ...

        @property
        def source(self) -> str:
            """Where the values come from."""
            ...

        @property
        def date(self) -> str:
            """The day on which the soil was measured or observed to be like this, as
            2026-11-20."""
            ...

        @property
        def notes(self) -> str:
            """Anything else worth knowing."""
            ...

        @property
        def assumed(self) -> tuple[str, ...]:
            """Values that the source does not give, each as `key: why this value`."""
            ...

        @property
        def contradictions(self) -> tuple[str, ...]:
            """What contradicts itself in how a soil was learnt, a sentence each: no operator's
            card is made of such a soil unless that is accepted."""
            ...

        @property
        def model(self) -> str:
            """The wheel–soil model that the values were made for; without it, `ishigami`."""
            ...

        @property
        def consistency(self) -> str:
            """Whether the soil is loose or firm, for priors; without it, loose."""
            ...

        @property
        def known_from(self) -> SoilKnownFrom:
            """Where the constants are from, for priors: how widely bands draw about them."""
            ...

        @property
        def cohesion_kpa(self) -> float:
            """Cohesion, c [kPa]."""
            ...

        @property
        def friction_angle_deg(self) -> float:
            """Angle of internal friction, φ [°]."""
            ...

        @property
        def friction_test(self) -> str:
            """The kind of test that the friction angle is from, which tells what of it a wheel
            mobilises; without it, not printed."""
            ...

        @property
        def constant_volume_share(self) -> float:
            """How far friction under a wheel has gone from tan φ, 0, to sin φ of soil that shears
            on at constant volume, 1; without it, as the kind of test says, or else the priors
            [-]."""
            ...

        @property
        def density_kg_m3(self) -> float:
            """Bulk density, ρ [kg/m³]."""
            ...

        @property
        def pressure_sinkage(self) -> SoilPressureSinkage:
            """How pressure grows with sinkage."""
            ...

        @property
        def stress_peak(self) -> SoilStressPeak:
            """Where along the arc the normal stress peaks."""
            ...

        @property
        def shear(self) -> SoilShear:
            """How shear stress is mobilised."""
            ...

        @property
        def exit(self) -> SoilExit:
            """Where the wheel leaves the soil."""
            ...

        @property
        def bulldozing(self) -> SoilBulldozing:
            """How soil pushed aside loads the side wall."""
            ...

        @property
        def small_wheel(self) -> SoilSmallWheel:
            """Terms of the model `small-wheel`, for one wheel on this soil; general values without
            it."""
            ...

        @property
        def rft(self) -> SoilRft:
            """Constants of the model `rft`, resistive force theory; as published without it."""
            ...

        @property
        def domain(self) -> SoilDomain:
            """The ranges within which the constants were measured or fitted; not stated without
            it."""
            ...

        @property
        def discrepancy(self) -> SoilDiscrepancy:
            """What the model gets wrong under one wheel, from a calibration; nothing without
            it."""
            ...

        @property
        def uncertainty(self) -> SoilUncertainty:
            """How well the numbers above are known; without it, as well as the priors say."""
            ...

        @property
        def priors(self) -> SoilPriors:
            """What is believed of the numbers that are not stated above; without it, `general`. In
            a resolved document, the rows that hold for this soil: a number that they call missing
            is the prior's, not the source's."""
            ...


class WheelGrousers(TypedDict, total=False):
    """Bars across the rim; left out for a smooth wheel."""

    height_m: Required[float]
    """Height over the rim, h_g [m]."""
    count: Required[int]
    """How many there are."""


class WheelKeys:
    """Keys of a wheel."""

    __slots__ = ()

    if TYPE_CHECKING:

        @property
        def schema(self) -> str:
            """Kind and version of this document."""
            ...

        @property
        def name(self) -> str:
            """What people call it."""
            ...

        @property
        def source(self) -> str:
            """Where the values come from."""
            ...

        @property
        def notes(self) -> str:
            """Anything else worth knowing."""
            ...

        @property
        def assumed(self) -> tuple[str, ...]:
            """Values that the source does not give, each as `key: why this value`."""
            ...

        @property
        def radius_m(self) -> float:
            """Radius of the rim, without grousers, r [m]."""
            ...

        @property
        def width_m(self) -> float:
            """Width of the rim, b [m]."""
            ...

        @property
        def grousers(self) -> WheelGrousers:
            """Bars across the rim; left out for a smooth wheel."""
            ...


class RoverBodyInertiaKgM2(TypedDict, total=False):
    """Moments of inertia about its centre of mass [kg·m²]."""

    xx: Required[float]
    """About x, forward [kg·m²]."""
    yy: Required[float]
    """About y, to the left [kg·m²]."""
    zz: Required[float]
    """About z, up [kg·m²]."""


class RoverBody(TypedDict, total=False):
    """The body, without its wheels."""

    mass_kg: Required[float]
    """Mass [kg]."""
    inertia_kg_m2: Required[RoverBodyInertiaKgM2]
    """Moments of inertia about its centre of mass [kg·m²]."""


class RoverWheelUnitInertiaKgM2(TypedDict, total=False):
    """Moments of inertia about its hub [kg·m²]."""

    xx: Required[float]
    """About x, forward [kg·m²]."""
    yy: Required[float]
    """About y, to the left [kg·m²]."""
    zz: Required[float]
    """About z, up [kg·m²]."""


class RoverWheelUnitWheel(TypedDict, total=False):
    """Its geometry: a preset's name, a path from this document's folder, or a wheel's keys."""

    schema: str
    """Kind and version of this document."""
    name: str
    """What people call it."""
    source: str
    """Where the values come from."""
    notes: str
    """Anything else worth knowing."""
    assumed: tuple[str, ...]
    """Values that the source does not give, each as `key: why this value`."""
    radius_m: Required[float]
    """Radius of the rim, without grousers, r [m]."""
    width_m: Required[float]
    """Width of the rim, b [m]."""
    grousers: WheelGrousers
    """Bars across the rim; left out for a smooth wheel."""


class RoverWheelUnit(TypedDict, total=False):
    """A wheel with its motor: that of every mount that has no other."""

    mass_kg: Required[float]
    """Mass [kg]."""
    inertia_kg_m2: Required[RoverWheelUnitInertiaKgM2]
    """Moments of inertia about its hub [kg·m²]."""
    wheel: Required[RoverWheelUnitWheel]
    """Its geometry: a preset's name, a path from this document's folder, or a wheel's keys."""


class RoverMotorControl(TypedDict, total=False):
    """Its speed controller: with one, the wheel turns slower under load. Left out, it turns as
    fast as it is set to, whatever that takes."""

    gain_v_s_rad: Required[float]
    """Voltage that it adds to that of the set speed for each rad/s that the wheel is too slow, K_p
    [V·s/rad]."""
    integral_v_rad: float
    """Voltage that it adds for each radian that the wheel is behind, K_i; 0 leaves an error under
    load, the droop [V/rad]."""
    voltage_limit_v: float
    """The most voltage that it gives; left out, as much as the battery has, or any [V]."""
    current_limit_a: float
    """The most current that it gives; left out, any [A]."""


class RoverMotorWinding(TypedDict, total=False):
    """How warm its winding becomes; left out, nothing is said of that."""

    thermal_resistance_k_w: Required[float]
    """From the winding to its surroundings, R_th [K/W]."""
    heat_capacity_j_k: Required[float]
    """Heat capacity, C: the thermal time constant over R_th [J/K]."""
    surroundings_degc: float
    """Temperature of its surroundings, and its own at the start [°C]."""
    highest_degc: Required[float]
    """The highest temperature that it stands [°C]."""
    derated_from_degc: float
    """Temperature from which on the current limit falls, to nothing at the highest; left out, it
    does not [°C]."""


class RoverMotor(TypedDict, total=False):
    """The motor of every wheel whose mount has no other: a preset's name, a path from this
    document's folder, or a motor's keys; without it nothing is said of current and battery."""

    schema: str
    """Kind and version of this document."""
    name: str
    """What people call it."""
    source: str
    """Where the values come from."""
    notes: str
    """Anything else worth knowing."""
    assumed: tuple[str, ...]
    """Values that the source does not give, each as `key: why this value`."""
    preset: str
    """A preset whose keys it takes where it has none of its own: those of the motor and the gear
    of a data sheet."""
    resistance_ohm: float
    """Resistance of the winding at 20 °C, R [Ω]."""
    torque_constant_nm_a: float
    """Torque constant, k, which is that of the induced voltage, too [N·m/A]."""
    gear_ratio: float
    """Turns of the motor for one of the wheel, N [-]."""
    gear_efficiency: float
    """Efficiency of the gear, η [-]."""
    friction_torque_nm: float
    """Torque of friction at the motor's shaft, τ_f [N·m]."""
    self_locking: bool
    """Whether the wheel cannot turn the gear: then the motor holds a slope without current, and
    brakes with none."""
    feeds_back: bool
    """Whether its braking power is taken back into the battery: then its power is below 0 where it
    brakes. Left out, it is not, and that power is lost."""
    control: RoverMotorControl
    """Its speed controller: with one, the wheel turns slower under load. Left out, it turns as
    fast as it is set to, whatever that takes."""
    winding: RoverMotorWinding
    """How warm its winding becomes; left out, nothing is said of that."""


class RoverBattery(TypedDict, total=False):
    """The battery, and what the electronics draw from it; without it nothing is known of its
    voltage and charge."""

    capacity_wh: Required[float]
    """Energy that it holds when it is full [W·h]."""
    full_voltage_v: Required[float]
    """Open-circuit voltage when it is full [V]."""
    empty_voltage_v: Required[float]
    """Open-circuit voltage when it is empty; it falls in a line [V]."""
    internal_resistance_ohm: float
    """Internal resistance, R_b [Ω]."""
    cutoff_voltage_v: float
    """Voltage at its terminals below which the electronics switch off: the rover stops with
    `brown_out` [V]."""
    electronics_w: float
    """Power that the electronics draw all the time [W]."""
    state_of_charge: float
    """State of charge at the start [-]."""


class RoverSuspensionBogie(TypedDict, total=False):
    """The bogie of each rocker, which carries two of three wheels on a side."""

    pivot_m: Required[tuple[float, ...]]
    """Its axis, seen from the side, from the body's centre of mass where the rover stands on a
    plane: x forward, z up [m]."""
    end: Required[str]
    """The end of the rover at which it is."""


class RoverSuspension(TypedDict, total=False):
    """How the wheels are joined to the body: on rockers with a differential, two wheels on a side,
    or with bogies three; left out, rigidly."""

    pivot_m: Required[tuple[float, ...]]
    """Axis of the rockers, seen from the side, from the body's centre of mass: x forward, z up
    [m]."""
    bogie: RoverSuspensionBogie
    """The bogie of each rocker, which carries two of three wheels on a side."""


class RoverMountInertiaKgM2(TypedDict, total=False):
    """Moments of inertia of this wheel with its motor about its hub [kg·m²], instead of the wheel
    unit's."""

    xx: Required[float]
    """About x, forward [kg·m²]."""
    yy: Required[float]
    """About y, to the left [kg·m²]."""
    zz: Required[float]
    """About z, up [kg·m²]."""


class RoverMountWheel(TypedDict, total=False):
    """The geometry of this wheel, instead of the wheel unit's: a preset's name, a path from this
    document's folder, or a wheel's keys."""

    schema: str
    """Kind and version of this document."""
    name: str
    """What people call it."""
    source: str
    """Where the values come from."""
    notes: str
    """Anything else worth knowing."""
    assumed: tuple[str, ...]
    """Values that the source does not give, each as `key: why this value`."""
    radius_m: Required[float]
    """Radius of the rim, without grousers, r [m]."""
    width_m: Required[float]
    """Width of the rim, b [m]."""
    grousers: WheelGrousers
    """Bars across the rim; left out for a smooth wheel."""


class RoverMountMotor(TypedDict, total=False):
    """The motor of this wheel, instead of the rover's: a preset's name, a path from this
    document's folder, or a motor's keys."""

    schema: str
    """Kind and version of this document."""
    name: str
    """What people call it."""
    source: str
    """Where the values come from."""
    notes: str
    """Anything else worth knowing."""
    assumed: tuple[str, ...]
    """Values that the source does not give, each as `key: why this value`."""
    preset: str
    """A preset whose keys it takes where it has none of its own: those of the motor and the gear
    of a data sheet."""
    resistance_ohm: float
    """Resistance of the winding at 20 °C, R [Ω]."""
    torque_constant_nm_a: float
    """Torque constant, k, which is that of the induced voltage, too [N·m/A]."""
    gear_ratio: float
    """Turns of the motor for one of the wheel, N [-]."""
    gear_efficiency: float
    """Efficiency of the gear, η [-]."""
    friction_torque_nm: float
    """Torque of friction at the motor's shaft, τ_f [N·m]."""
    self_locking: bool
    """Whether the wheel cannot turn the gear: then the motor holds a slope without current, and
    brakes with none."""
    feeds_back: bool
    """Whether its braking power is taken back into the battery: then its power is below 0 where it
    brakes. Left out, it is not, and that power is lost."""
    control: RoverMotorControl
    """Its speed controller: with one, the wheel turns slower under load. Left out, it turns as
    fast as it is set to, whatever that takes."""
    winding: RoverMotorWinding
    """How warm its winding becomes; left out, nothing is said of that."""


class RoverMount(TypedDict, total=False):
    """Where a wheel sits, and what it has instead of the common wheel unit."""

    name: Required[str]
    """The wheel's name, such as `front-left`; no two alike."""
    joint: str
    """What logs of the robot call the joint that turns it, as URDF does, if that is another name;
    with a minus before it where the joint's positive speeds roll the wheel backward, as about an
    axis that points to the right."""
    position_m: Required[tuple[float, ...]]
    """The wheel's centre, at a steering angle of zero, from the body's centre of mass: x forward,
    y left, z up [m]."""
    steering_deg: float
    """Steering angle, δ: the wheel is turned to the left by this much, for good if it has no limit
    of steering; left out, it points straight ahead [°]."""
    steering_limit_deg: float
    """How far this wheel can be steered to either side, instead of the rover's; 0 if it is not
    steered [°]."""
    steering_rate_deg_s: float
    """How fast this wheel is steered, instead of the rover's [°/s]."""
    kingpin_offset_m: tuple[float, ...]
    """Kingpin offset, k: from the wheel's centre, at a steering angle of zero, to the upright axis
    about which it is steered: x forward, y left [m]."""
    mass_kg: float
    """Mass of this wheel with its motor, instead of the wheel unit's [kg]."""
    inertia_kg_m2: RoverMountInertiaKgM2
    """Moments of inertia of this wheel with its motor about its hub [kg·m²], instead of the wheel
    unit's."""
    wheel: RoverMountWheel
    """The geometry of this wheel, instead of the wheel unit's: a preset's name, a path from this
    document's folder, or a wheel's keys."""
    motor: RoverMountMotor
    """The motor of this wheel, instead of the rover's: a preset's name, a path from this
    document's folder, or a motor's keys."""


class RoverKeys:
    """Keys of a rover."""

    __slots__ = ()

    if TYPE_CHECKING:

        @property
        def schema(self) -> str:
            """Kind and version of this document."""
            ...

        @property
        def name(self) -> str:
            """What people call it."""
            ...

        @property
        def source(self) -> str:
            """Where the values come from."""
            ...

        @property
        def notes(self) -> str:
            """Anything else worth knowing."""
            ...

        @property
        def assumed(self) -> tuple[str, ...]:
            """Values that the source does not give, each as `key: why this value`."""
            ...

        @property
        def body(self) -> RoverBody:
            """The body, without its wheels."""
            ...

        @property
        def wheel_unit(self) -> RoverWheelUnit:
            """A wheel with its motor: that of every mount that has no other."""
            ...

        @property
        def motor(self) -> RoverMotor:
            """The motor of every wheel whose mount has no other: a preset's name, a path from this
            document's folder, or a motor's keys; without it nothing is said of current and
            battery."""
            ...

        @property
        def steering_limit_deg(self) -> float:
            """How far every wheel can be steered to either side; left out, wheels keep their
            angles [°]."""
            ...

        @property
        def steering_rate_deg_s(self) -> float:
            """How fast every wheel is steered; left out, 10 °/s (assumed) [°/s]."""
            ...

        @property
        def battery(self) -> RoverBattery:
            """The battery, and what the electronics draw from it; without it nothing is known of
            its voltage and charge."""
            ...

        @property
        def suspension(self) -> RoverSuspension:
            """How the wheels are joined to the body: on rockers with a differential, two wheels on
            a side, or with bogies three; left out, rigidly."""
            ...

        @property
        def belly_clearance_m(self) -> float:
            """Height of the body's flat underside, between the wheels' hubs, over level hard
            ground; left out, nothing is said of high-centring [m]."""
            ...

        @property
        def mount(self) -> tuple[RoverMount, ...]:
            """Where the wheels sit: three or more, standing on one plane, not in one line."""
            ...


class ScenarioTerrainZoneSoil(TypedDict, total=False):
    """Its soil: a preset's name, a path from this document's folder, or a soil's keys; left out,
    the scenario's."""

    schema: str
    """Kind and version of this document."""
    name: str
    """What people call it."""
    source: str
    """Where the values come from."""
    date: str
    """The day on which the soil was measured or observed to be like this, as 2026-11-20."""
    notes: str
    """Anything else worth knowing."""
    assumed: tuple[str, ...]
    """Values that the source does not give, each as `key: why this value`."""
    contradictions: tuple[str, ...]
    """What contradicts itself in how a soil was learnt, a sentence each: no operator's card is
    made of such a soil unless that is accepted."""
    model: str
    """The wheel–soil model that the values were made for; without it, `ishigami`."""
    consistency: str
    """Whether the soil is loose or firm, for priors; without it, loose."""
    known_from: SoilKnownFrom
    """Where the constants are from, for priors: how widely bands draw about them."""
    cohesion_kpa: float
    """Cohesion, c [kPa]."""
    friction_angle_deg: Required[float]
    """Angle of internal friction, φ [°]."""
    friction_test: str
    """The kind of test that the friction angle is from, which tells what of it a wheel mobilises;
    without it, not printed."""
    constant_volume_share: float
    """How far friction under a wheel has gone from tan φ, 0, to sin φ of soil that shears on at
    constant volume, 1; without it, as the kind of test says, or else the priors [-]."""
    density_kg_m3: float
    """Bulk density, ρ [kg/m³]."""
    pressure_sinkage: Required[SoilPressureSinkage]
    """How pressure grows with sinkage."""
    stress_peak: SoilStressPeak
    """Where along the arc the normal stress peaks."""
    shear: Required[SoilShear]
    """How shear stress is mobilised."""
    exit: SoilExit
    """Where the wheel leaves the soil."""
    bulldozing: SoilBulldozing
    """How soil pushed aside loads the side wall."""
    small_wheel: SoilSmallWheel
    """Terms of the model `small-wheel`, for one wheel on this soil; general values without it."""
    rft: SoilRft
    """Constants of the model `rft`, resistive force theory; as published without it."""
    domain: SoilDomain
    """The ranges within which the constants were measured or fitted; not stated without it."""
    discrepancy: SoilDiscrepancy
    """What the model gets wrong under one wheel, from a calibration; nothing without it."""
    uncertainty: SoilUncertainty
    """How well the numbers above are known; without it, as well as the priors say."""
    priors: SoilPriors
    """What is believed of the numbers that are not stated above; without it, `general`. In a
    resolved document, the rows that hold for this soil: a number that they call missing is the
    prior's, not the source's."""


_ScenarioTerrainZoneReserved = TypedDict("_ScenarioTerrainZoneReserved", {"class": int}, total=False)


class ScenarioTerrainZone(_ScenarioTerrainZoneReserved, total=False):
    """The soil of a zone."""

    name: str
    """The zone's name in the file, in place of a class number."""
    soil: ScenarioTerrainZoneSoil
    """Its soil: a preset's name, a path from this document's folder, or a soil's keys; left out,
    the scenario's."""


class ScenarioTerrain(TypedDict, total=False):
    """Ground with heights, in place of the plane; `slope_deg` is then left out, or 0."""

    surface: str
    """The law; may be left out."""
    file: str
    """A GeoTIFF in metres of a projection, a NumPy array (.npy), or text with x, y and z in each
    line: a path from this document's folder."""
    start_m: tuple[float, ...]
    """Where the body's centre of mass is at the start, on the map, x and y; left out, the middle
    of the map, or the origin of a formula [m]."""
    soil_file: str
    """Zones of soil: a raster of class numbers (GeoTIFF, .npy, xyz text), or GeoJSON polygons in
    metres with a property `soil`; a path from this document's folder. Where no zone is, the soil
    is the scenario's."""
    zone: tuple[ScenarioTerrainZone, ...]
    """The soil of each class, or of each name that is not a preset's."""
    cell_size_m: float
    """Distance between neighbouring points of a file that does not say it [m]."""
    south_west_m: tuple[float, ...]
    """The point farthest to the south and west of a file that does not say it, x and y: the middle
    of its cell; left out, the origin [m]."""
    band: int
    """Which band of a GeoTIFF has the heights, from 1."""
    missing_m: float
    """A height that stands for a missing one, beside those that the file declares [m]."""
    slope_deg: float
    """Inclination [°]."""
    direction_deg: float
    """Direction in which it rises, from east to the left [°]."""
    foot_m: tuple[float, ...]
    """A place on the line where it starts, x and y; left out, the origin [m]."""
    length_m: float
    """Its length on the map [m]."""
    rounding_m: float
    """Length on the map over which the slope changes, at its foot and at its top [m]."""
    tip_m: tuple[float, ...]
    """Where its axis is, x and y; left out, the origin [m]."""
    amplitude_m: float
    """Half of the height from trough to crest [m]."""
    wavelength_m: float
    """Distance from crest to crest [m]."""
    phase_deg: float
    """Phase at the origin [°]."""
    centre_m: tuple[float, ...]
    """Where its centre is, x and y; left out, the origin [m]."""
    diameter_m: float
    """Diameter of the crest [m]."""
    depth_m: float
    """How far the centre is below the crest [m]."""
    rim_height_m: float
    """How far the crest is above the ground about it [m]."""
    rim_width_m: float
    """How far from the crest the ground is level again [m]."""


class ScenarioDrive(TypedDict, total=False):
    """What turns the wheels."""

    law: str
    """The law; may be left out."""
    rim_speed_m_s: float | tuple[float, ...]
    """Speed of the rim, (r + h_g) ω [m/s]; a list gives one for each mount, in their order."""
    yaw_deg: tuple[tuple[float, ...], ...]
    """Yaw over time, γ [°], as pairs of time [s] and yaw: straight between them, constant before
    and after; without it the wheels' moments turn the rover"""
    ground_speed_m_s: float
    """Desired speed along the contour, v_des [m/s]."""
    reference_slip_ratio: float
    """Reference slip ratio, s_ref [-]."""
    largest_slip_ratio: float
    """The most that a wheel may slip, s_max [-]."""


class ScenarioByWheel(TypedDict, total=False):
    """How the soil below each wheel, and its speed, differ from what is said of all."""

    friction_angle_offset_deg: float | tuple[float, ...]
    """Added to the soil's angle of internal friction, Δφ [°]."""
    stiffness_factor: float | tuple[float, ...]
    """Factor on the soil's stiffness: on k_c and k_phi, and on that of resistive force theory
    [-]."""
    speed_factor: float | tuple[float, ...]
    """Factor on the speed that the drive tells the motor [-]."""


class ScenarioScatter(TypedDict, total=False):
    """How the soil scatters from place to place, and the speed from wheel to wheel."""

    friction_angle_std_deg: float
    """Standard deviation of the angle of internal friction from place to place [°]."""
    stiffness_std: float
    """Standard deviation of the soil's stiffness from place to place, as a share of it (of its
    logarithm) [-]."""
    correlation_length_m: float
    """Distance at which the correlation of the soil has fallen to 1/e; not below a footprint's
    length [m]."""
    speed_std: float
    """Standard deviation of each wheel's speed over a run, as a share of the speed that its motor
    is set to (of its logarithm) [-]."""
    seed: int
    """Which realisation a single run has; the runs of a campaign have one each, by its own
    seed."""


class ScenarioSlopeStability(TypedDict, total=False):
    """What is asked of the ground's own strength (infinite slope) by headings, maps and cards; a
    run is not changed by it."""

    factor_of_safety: float
    """Least factor of safety, FS [-]."""
    depth_m: float
    """Depth of the layer that would slide, z, straight down; it counts where there is cohesion
    [m]."""


class ScenarioStart(TypedDict, total=False):
    """How the run starts."""

    yaw_deg: float
    """Yaw, γ; above 0 with the nose uphill; whole turns do not count [°]."""
    motion: str
    """Whether the rover already moves."""


class ScenarioKeys:
    """Keys of a scenario."""

    __slots__ = ()

    if TYPE_CHECKING:

        @property
        def schema(self) -> str:
            """Kind and version of this document."""
            ...

        @property
        def name(self) -> str:
            """What it is there to show."""
            ...

        @property
        def source(self) -> str:
            """Where the values come from."""
            ...

        @property
        def notes(self) -> str:
            """Anything else worth knowing."""
            ...

        @property
        def assumed(self) -> tuple[str, ...]:
            """Values that the source does not give, each as `key: why this value`."""
            ...

        @property
        def model(self) -> str:
            """The wheel-soil model; without it the soil's own, or else `ishigami`."""
            ...

        @property
        def gravity_m_s2(self) -> float:
            """Gravity, g [m/s²]."""
            ...

        @property
        def slope_deg(self) -> float:
            """Inclination of the plane, α [°]."""
            ...

        @property
        def terrain(self) -> ScenarioTerrain:
            """Ground with heights, in place of the plane; `slope_deg` is then left out, or 0."""
            ...

        @property
        def duration_s(self) -> float:
            """How long the run lasts [s]."""
            ...

        @property
        def sample_interval_s(self) -> float:
            """Time between two recorded samples [s]."""
            ...

        @property
        def load_transfer(self) -> str:
            """Load transfer: how the weight is shared among the wheels."""
            ...

        @property
        def wheel_moments(self) -> str:
            """Whether the wheels' own overturning and aligning moments act on the rover; without
            it they do where the load transfer is complete."""
            ...

        @property
        def simulation(self) -> str:
            """Whether velocities are integrated, or those of a steady state at every instant;
            without it `quasi-steady` over a `terrain`, and `dynamic` on a plane."""
            ...

        @property
        def drive(self) -> ScenarioDrive:
            """What turns the wheels."""
            ...

        @property
        def by_wheel(self) -> ScenarioByWheel:
            """How the soil below each wheel, and its speed, differ from what is said of all."""
            ...

        @property
        def scatter(self) -> ScenarioScatter:
            """How the soil scatters from place to place, and the speed from wheel to wheel."""
            ...

        @property
        def ruts(self) -> str:
            """What wheels leave behind for those that roll in their ruts."""
            ...

        @property
        def slope_stability(self) -> ScenarioSlopeStability:
            """What is asked of the ground's own strength (infinite slope) by headings, maps and
            cards; a run is not changed by it."""
            ...

        @property
        def start(self) -> ScenarioStart:
            """How the run starts."""
            ...


class MissionStopSlipRatio(TypedDict, total=False):
    """Slip ratio over a way: 1 less what the ground saw of the rims' way."""

    above: Required[float]
    """The rover stops above this [-]."""
    over_m: float
    """Way of the rims over which it is taken; before they have gone so far, nothing is limited
    [m]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStopDriftM(TypedDict, total=False):
    """Way down the ground under the rover over a way."""

    above: Required[float]
    """The rover stops above this [m]."""
    over_m: float
    """Way of the rims over which it is taken; before they have gone so far, nothing is limited
    [m]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStopDriftMPerM(TypedDict, total=False):
    """Drift over a way: way down the ground under the rover for a metre travelled."""

    above: Required[float]
    """The rover stops above this [m/m]."""
    over_m: float
    """Way of the rims over which it is taken; before they have gone so far, nothing is limited
    [m]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStopSinkageOverRadius(TypedDict, total=False):
    """Largest sinkage of a wheel over its shearing radius."""

    above: Required[float]
    """The rover stops above this [-]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStopSinkageMm(TypedDict, total=False):
    """Largest sinkage of a wheel."""

    above: Required[float]
    """The rover stops above this [mm]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStopRollDeg(TypedDict, total=False):
    """Roll to either side."""

    above: Required[float]
    """The rover stops above this [°]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStopPitchDeg(TypedDict, total=False):
    """Pitch, nose up or down."""

    above: Required[float]
    """The rover stops above this [°]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStopTorqueNm(TypedDict, total=False):
    """Largest torque of a wheel's motor."""

    above: Required[float]
    """The rover stops above this [N·m]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStopTimeS(TypedDict, total=False):
    """Time since the leg began."""

    above: Required[float]
    """The rover stops above this [s]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStopEnergyJ(TypedDict, total=False):
    """Work of the motors since the leg began."""

    above: Required[float]
    """The rover stops above this [J]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStopOffPathM(TypedDict, total=False):
    """Distance from the straight line, or the circle, of the leg."""

    above: Required[float]
    """The rover stops above this [m]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStopCurrentA(TypedDict, total=False):
    """Largest current of a wheel's motor, driving or braking."""

    above: Required[float]
    """The rover stops above this [A]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStopWindingTemperatureDegc(TypedDict, total=False):
    """Highest temperature of a motor's winding."""

    above: Required[float]
    """The rover stops above this [°C]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStopDepthOfDischarge(TypedDict, total=False):
    """Depth of discharge: 1 less the battery's state of charge."""

    above: Required[float]
    """The rover stops above this [-]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStopShortfallDeg(TypedDict, total=False):
    """Yaw that a turn or an arc lacks where it ends; without it 2°: beyond, the leg is
    `fell_short`."""

    above: Required[float]
    """The rover stops above this [°]."""
    then: str
    """What the rover does once it has stopped."""
    back_out_m: float
    """How far it backs out, where `then` says so [m]."""


class MissionStop(TypedDict, total=False):
    """Limits at which the rover stops in every leg that has none of its own for the same
    number."""

    slip_ratio: MissionStopSlipRatio
    """Slip ratio over a way: 1 less what the ground saw of the rims' way."""
    drift_m: MissionStopDriftM
    """Way down the ground under the rover over a way."""
    drift_m_per_m: MissionStopDriftMPerM
    """Drift over a way: way down the ground under the rover for a metre travelled."""
    sinkage_over_radius: MissionStopSinkageOverRadius
    """Largest sinkage of a wheel over its shearing radius."""
    sinkage_mm: MissionStopSinkageMm
    """Largest sinkage of a wheel."""
    roll_deg: MissionStopRollDeg
    """Roll to either side."""
    pitch_deg: MissionStopPitchDeg
    """Pitch, nose up or down."""
    torque_nm: MissionStopTorqueNm
    """Largest torque of a wheel's motor."""
    time_s: MissionStopTimeS
    """Time since the leg began."""
    energy_j: MissionStopEnergyJ
    """Work of the motors since the leg began."""
    off_path_m: MissionStopOffPathM
    """Distance from the straight line, or the circle, of the leg."""
    current_a: MissionStopCurrentA
    """Largest current of a wheel's motor, driving or braking."""
    winding_temperature_degc: MissionStopWindingTemperatureDegc
    """Highest temperature of a motor's winding."""
    depth_of_discharge: MissionStopDepthOfDischarge
    """Depth of discharge: 1 less the battery's state of charge."""
    shortfall_deg: MissionStopShortfallDeg
    """Yaw that a turn or an arc lacks where it ends; without it 2°: beyond, the leg is
    `fell_short`."""


class MissionSensors(TypedDict, total=False):
    """What the rover knows of where it is; without the table it knows all."""

    heading_std_deg: float
    """Standard deviation of a measured heading [°]."""
    heading_interval_s: float
    """Time between two headings [s]."""
    heading_delay_s: float
    """How old a heading is when it is known [s]."""
    odometry_std: float
    """Standard deviation of a fix of visual odometry along the way since the last one and across
    it, over that way [-]."""
    odometry_interval_m: float
    """Way of the rims between two fixes [m]."""
    seed: int
    """Which realisation of the errors."""


class MissionLegArc(TypedDict, total=False):
    """It drives along a circle."""

    radius_m: Required[float]
    """Radius of the circle of the centre of mass [m]."""
    angle_deg: Required[float]
    """How far the rover turns on it, above 0 to its left: it drives on until its yaw has turned so
    far, for at most twice the circle's way [°]."""


class MissionLegGoto(TypedDict, total=False):
    """It drives along a straight line to a place, towards which it turns on the spot first where
    that is not ahead."""

    x_m: Required[float]
    """Along the contour, or on the map [m]."""
    y_m: Required[float]
    """Uphill, measured along the slope, or on the map [m]."""
    within_m: float
    """How near is near enough [m]."""


class MissionLegDrive(TypedDict, total=False):
    """What turns the wheels of a `drive_m`, an `arc` or a `goto`; without it they keep their
    speeds."""

    law: Required[str]
    """The law."""
    reference_slip_ratio: float
    """Reference slip ratio, s_ref [-]."""
    largest_slip_ratio: float
    """The most that a wheel may slip, s_max [-]."""


class MissionLegToward(TypedDict, total=False):
    """The place towards which the nose is held."""

    x_m: Required[float]
    """Along the contour, or on the map [m]."""
    y_m: Required[float]
    """Uphill, measured along the slope, or on the map [m]."""


class MissionLegStop(TypedDict, total=False):
    """Limits of this leg, in place of the mission's for the same numbers."""

    slip_ratio: MissionStopSlipRatio
    """Slip ratio over a way: 1 less what the ground saw of the rims' way."""
    drift_m: MissionStopDriftM
    """Way down the ground under the rover over a way."""
    drift_m_per_m: MissionStopDriftMPerM
    """Drift over a way: way down the ground under the rover for a metre travelled."""
    sinkage_over_radius: MissionStopSinkageOverRadius
    """Largest sinkage of a wheel over its shearing radius."""
    sinkage_mm: MissionStopSinkageMm
    """Largest sinkage of a wheel."""
    roll_deg: MissionStopRollDeg
    """Roll to either side."""
    pitch_deg: MissionStopPitchDeg
    """Pitch, nose up or down."""
    torque_nm: MissionStopTorqueNm
    """Largest torque of a wheel's motor."""
    time_s: MissionStopTimeS
    """Time since the leg began."""
    energy_j: MissionStopEnergyJ
    """Work of the motors since the leg began."""
    off_path_m: MissionStopOffPathM
    """Distance from the straight line, or the circle, of the leg."""
    current_a: MissionStopCurrentA
    """Largest current of a wheel's motor, driving or braking."""
    winding_temperature_degc: MissionStopWindingTemperatureDegc
    """Highest temperature of a motor's winding."""
    depth_of_discharge: MissionStopDepthOfDischarge
    """Depth of discharge: 1 less the battery's state of charge."""
    shortfall_deg: MissionStopShortfallDeg
    """Yaw that a turn or an arc lacks where it ends; without it 2°: beyond, the leg is
    `fell_short`."""


class MissionLeg(TypedDict, total=False):
    """One leg: exactly one of `drive_m`, `turn_deg`, `arc`, `goto` and `wait_s`, and how it is
    driven."""

    drive_m: float
    """It drives so far; below 0 backward [m]."""
    by: str
    """What measures `drive_m`; without it `ground`."""
    turn_deg: float
    """It turns on the spot by this much, above 0 to its left, and keeps its place [°]."""
    arc: MissionLegArc
    """It drives along a circle."""
    goto: MissionLegGoto
    """It drives along a straight line to a place, towards which it turns on the spot first where
    that is not ahead."""
    wait_s: float
    """It stands so long [s]."""
    steering: str
    """What leads the rover round an `arc`; without it `sides`."""
    reverse: bool
    """Whether an arc, or the way to a place, is driven backward."""
    speed_m_s: float | tuple[float, ...]
    """Speed of the rims, (r + h_g) ω [m/s]; a list gives one for each mount; without it that of
    the leg before, of a first leg 0.06."""
    drive: MissionLegDrive
    """What turns the wheels of a `drive_m`, an `arc` or a `goto`; without it they keep their
    speeds."""
    yaw_deg: float
    """Yaw before the leg, γ: of a first leg that of the start, of another turned to on the spot;
    held only where `heading` says so; whole turns do not count [°]."""
    heading: str
    """What `drive_m` holds on its way; without it nothing: the wheels keep one speed. `goto` knows
    `crab` alone."""
    crab_deg: float
    """Crab angle with which a leg of heading `crab` begins, above 0 to the left, of a `goto`
    beyond the direction of its place; without it 0, and the rover learns it on the way [°]."""
    toward: MissionLegToward
    """The place towards which the nose is held."""
    look_ahead_m: float
    """How far ahead the way is simulated before it is driven: where a limit would be passed, the
    rover stops before [m]."""
    stop: MissionLegStop
    """Limits of this leg, in place of the mission's for the same numbers."""


class MissionAlternative(TypedDict, total=False):
    """One of several ways to drive a mission."""

    name: Required[str]
    """What the way is called; no two alike."""
    leg: Required[tuple[MissionLeg, ...]]
    """What the rover does on this way, leg after leg."""


class MissionKeys:
    """Keys of a mission."""

    __slots__ = ()

    if TYPE_CHECKING:

        @property
        def schema(self) -> str:
            """Kind and version of this document."""
            ...

        @property
        def name(self) -> str:
            """What it is there to show."""
            ...

        @property
        def source(self) -> str:
            """Where the values come from."""
            ...

        @property
        def notes(self) -> str:
            """Anything else worth knowing."""
            ...

        @property
        def assumed(self) -> tuple[str, ...]:
            """Values that the source does not give, each as `key: why this value`."""
            ...

        @property
        def model(self) -> str:
            """The wheel-soil model; without it the soil's own, or else `ishigami`."""
            ...

        @property
        def gravity_m_s2(self) -> float:
            """Gravity, g [m/s²]."""
            ...

        @property
        def slope_deg(self) -> float:
            """Inclination of the plane, α [°]."""
            ...

        @property
        def terrain(self) -> ScenarioTerrain:
            """Ground with heights, in place of the plane; `slope_deg` is then left out, or 0."""
            ...

        @property
        def sample_interval_s(self) -> float:
            """Time between two recorded samples [s]."""
            ...

        @property
        def load_transfer(self) -> str:
            """Load transfer: how the weight is shared among the wheels."""
            ...

        @property
        def wheel_moments(self) -> str:
            """Whether the wheels' own overturning and aligning moments act on the rover; without
            it they do where the load transfer is complete."""
            ...

        @property
        def simulation(self) -> str:
            """Whether velocities are integrated, or those of a steady state at every instant;
            without it `quasi-steady` over a `terrain`, and `dynamic` on a plane."""
            ...

        @property
        def by_wheel(self) -> ScenarioByWheel:
            """How the soil below each wheel, and its speed, differ from what is said of all."""
            ...

        @property
        def scatter(self) -> ScenarioScatter:
            """How the soil scatters from place to place, and the speed from wheel to wheel."""
            ...

        @property
        def ruts(self) -> str:
            """What wheels leave behind for those that roll in their ruts."""
            ...

        @property
        def start(self) -> ScenarioStart:
            """How the run starts."""
            ...

        @property
        def stop(self) -> MissionStop:
            """Limits at which the rover stops in every leg that has none of its own for the same
            number."""
            ...

        @property
        def stop_from(self) -> str:
            """A file with a table [stop], whose limits hold in every leg: those of the document
            stand in place of the file's for the same numbers."""
            ...

        @property
        def sensors(self) -> MissionSensors:
            """What the rover knows of where it is; without the table it knows all."""
            ...

        @property
        def legs_from(self) -> str:
            """A file with legs, which come before those of the document: CSV with keys of a leg in
            its first line, or GeoJSON with places in metres."""
            ...

        @property
        def leg(self) -> tuple[MissionLeg, ...]:
            """What the rover does, leg after leg."""
            ...

        @property
        def alternative(self) -> tuple[MissionAlternative, ...]:
            """In place of legs: several ways from the same start, to be compared."""
            ...


class SiteKeys:
    """Keys of a site."""

    __slots__ = ()

    if TYPE_CHECKING:

        @property
        def slope_deg(self) -> float:
            """Inclination of the plane, α [°]."""
            ...

        @property
        def gravity_m_s2(self) -> float:
            """Gravity, g [m/s²]."""
            ...
