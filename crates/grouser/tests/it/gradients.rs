//! Derivatives of a settled wheel, of headings and of the steepest slope, against differences of
//! the whole answers.

use std::sync::atomic::{AtomicUsize, Ordering};

use grouser::contact::gradient::{ChangeableWheel, WheelDerivative, gradient};
use grouser::contact::{
    Contact, Ishigami, Model, Settled, Slip, WheelForces, WheelSoilModel, settle,
};
use grouser::difference::Variable;
use grouser::document::gradient::{
    ChangedKeys, GradientKeys, HeadingKeys, StandSetting, WheelKeys,
};
use grouser::document::{Kind, Overrides, Source, read_scenario, read_soil, read_wheel};
use grouser::soil::{PressureSinkage, SmallWheel, Soil, Span};
use grouser::studies::heading::{HeadingStudy, Steering};
use grouser::units::deg;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

use crate::given;

/// A contact by its numbers: of the soil, the wheel and its motion, and the load.
struct Numbers {
    contact: Contact,
    values: [f64; 12],
    scales: [f64; 12],
}

impl Numbers {
    fn of(contact: Contact, slip: [f64; 2], load: f64) -> Self {
        let Contact { soil, wheel, gravity, .. } = contact;
        let (PressureSinkage::Reece { k_phi, .. } | PressureSinkage::Bekker { k_phi, .. }) =
            soil.pressure_sinkage;
        let values = [
            soil.cohesion,
            soil.friction_angle,
            soil.density,
            k_phi,
            soil.stress_peak.a0,
            soil.stress_peak.a1,
            wheel.radius,
            wheel.width,
            gravity,
            slip[0],
            slip[1],
            load,
        ];
        let mut scales = values.map(f64::abs);
        for (place, least) in [(0, 500.0), (4, 0.1), (5, 0.1), (9, 0.1), (10, 0.1)] {
            scales[place] = scales[place].max(least);
        }
        Self { contact, values, scales }
    }

    fn variables(&self) -> Vec<Variable> {
        let all = self.values.iter().zip(&self.scales);
        all.map(|(value, scale)| {
            let range = if *value == 0.0 { Span::at_least(0.0) } else { Span::ANY };
            Variable { value: *value, scale: *scale, range }
        })
        .collect()
    }

    fn with(&self, values: &[f64]) -> Option<(Contact, f64)> {
        let [
            cohesion,
            friction_angle,
            density,
            stiffness,
            a0,
            a1,
            radius,
            width,
            gravity,
            s,
            beta,
            load,
        ] = values.try_into().ok()?;
        let mut contact = Contact { gravity, slip: Slip::on_test_stand(s, beta), ..self.contact };
        let soil = &mut contact.soil;
        (soil.cohesion, soil.friction_angle, soil.density) = (cohesion, friction_angle, density);
        (soil.stress_peak.a0, soil.stress_peak.a1) = (a0, a1);
        let (PressureSinkage::Reece { k_phi, .. } | PressureSinkage::Bekker { k_phi, .. }) =
            &mut soil.pressure_sinkage;
        *k_phi = stiffness;
        (contact.wheel.radius, contact.wheel.width) = (radius, width);
        Some((contact, load))
    }
}

/// The results that are compared, each over its size.
fn compared(settled: &Settled, load: f64, radius: f64) -> [f64; 5] {
    let forces = &settled.forces;
    [
        settled.sinkage / radius,
        forces.drawbar_pull / load,
        forces.side_force / load,
        forces.torque / (load * radius),
        forces.patch.entry,
    ]
}

/// The six-point difference of whole settlings: exact to the sixth power of its step.
fn by_settlings(
    model: &Model,
    numbers: &Numbers,
    place: usize,
    step: f64,
    sizes: (f64, f64),
) -> Option<[f64; 5]> {
    const WEIGHTS: [(f64, f64); 6] =
        [(-3.0, -1.0), (-2.0, 9.0), (-1.0, -45.0), (1.0, 45.0), (2.0, -9.0), (3.0, 1.0)];
    let mut sum = [0.0; 5];
    for (steps, weight) in WEIGHTS {
        let mut values = numbers.values;
        values[place] += steps * step * numbers.scales[place];
        let (contact, load) = numbers.with(&values)?;
        let settled = settle(model.as_ref(), &contact, load).ok()?;
        let results = compared(&settled, sizes.0, sizes.1);
        sum.iter_mut().zip(results).for_each(|(sum, it)| *sum += weight * it);
    }
    Some(sum.map(|it| it / (60.0 * step)))
}

/// The derivatives of random wheels against six-point differences of whole settlings: the errors,
/// over the results' sizes and the numbers' scales, and how many were left out.
struct Comparison {
    errors: Vec<f64>,
    /// The largest of them, and of what it is.
    largest: f64,
    worst: String,
    one_sided: usize,
    /// The reference itself is not smooth: it steps over a switch.
    unclear: usize,
}

fn any_case() -> impl Strategy<Value = (Contact, [f64; 2], f64)> {
    let motion = (-0.9..0.9, -0.8..0.8_f64);
    let wheel = (given::any_soil(), given::any_wheel());
    (wheel, motion, given::log_range(1.0, 20.0), given::log_range(2e-3, 0.4)).prop_map(
        |((soil, wheel), (s, beta), gravity, depth)| {
            let soil = Soil { small_wheel: SmallWheel::GENERAL, ..soil };
            let contact = Contact { wheel, soil, slip: Slip::on_test_stand(s, beta), gravity };
            (contact, [s, beta], depth)
        },
    )
}

fn compare(model: &Model, cases: u32, steps: [f64; 2]) -> Comparison {
    let mut found = Comparison {
        errors: Vec::new(),
        largest: 0.0,
        worst: String::new(),
        one_sided: 0,
        unclear: 0,
    };
    let mut runner = TestRunner::new(given::cases(cases));
    for _ in 0..cases {
        let (contact, slip, depth) = any_case().new_tree(&mut runner).unwrap().current();
        let radius = contact.wheel.shearing_radius();
        let load = model.as_ref().forces(&contact, depth * radius).normal_force;
        let Ok(settled) = settle(model.as_ref(), &contact, load) else { continue };
        if load <= 0.0 || (settled.sinkage / radius - depth).abs() > 1e-6 {
            continue;
        }
        let numbers = Numbers::of(contact, slip, load);
        let with = |values: &[f64]| numbers.with(values);
        let changeable = ChangeableWheel { model: model.as_ref(), with: &with };
        let gradient = gradient(&changeable, &numbers.variables(), &contact, &settled);
        for (place, derivative) in gradient.by_variable.iter().enumerate() {
            if numbers.values[place] == 0.0 {
                continue;
            }
            let Some(derivative) = derivative else { continue };
            found.add(model, &numbers, place, derivative, (load, radius), steps);
        }
    }
    found
}

impl Comparison {
    fn add(
        &mut self,
        model: &Model,
        numbers: &Numbers,
        place: usize,
        derivative: &WheelDerivative,
        sizes: (f64, f64),
        steps: [f64; 2],
    ) {
        let references = steps.map(|step| by_settlings(model, numbers, place, step, sizes));
        let [Some(long), Some(short)] = references else {
            self.unclear += 5;
            return;
        };
        // A reference that is not sure to a tenth of what is asked for is none.
        let sure = 0.1 * allowed(model).1;
        let scale = numbers.scales[place];
        let value = compared(&derivative.value, sizes.0, sizes.1).map(|it| it * scale);
        let sides = derivative.sides.map(|it| compared(&it, sizes.0, sizes.1));
        for result in 0..value.len() {
            let size = 1.0 + short[result].abs();
            if sides[0][result] != sides[1][result] {
                self.one_sided += 1;
            } else if (long[result] - short[result]).abs() > sure * size {
                self.unclear += 1;
            } else {
                let error = (value[result] - short[result]).abs() / size;
                if error > self.largest {
                    self.largest = error;
                    let Numbers { contact, values, .. } = numbers;
                    self.worst = format!(
                        "number {place} of {values:?}, result {result}: {} for {} and {}, {contact:?}",
                        value[result], short[result], long[result]
                    );
                }
                self.errors.push(error);
            }
        }
    }

    fn check(mut self, name: &str, worst: f64, median: f64) {
        self.errors.sort_by(f64::total_cmp);
        let at = |percent: usize| self.errors[(self.errors.len() - 1) * percent / 100];
        let (left_out, all) = (self.one_sided + self.unclear, self.errors.len());
        println!(
            "{name}: {all} derivatives, median {:.1e}, 99 % {:.1e}, worst {:.1e}; {} one-sided, {} unclear",
            at(50),
            at(99),
            at(100),
            self.one_sided,
            self.unclear
        );
        let above = self.errors.iter().filter(|it| **it >= worst).count();
        // Where one rule of nodes follows another the forces themselves jump, by a few 1e-11.
        let is_rare = above * 100_000 <= all && at(100) < 10.0 * worst;
        let found = &self.worst;
        assert!(is_rare && at(50) < median, "{name}: {above} above {worst}: {found}");
        assert!(left_out * 20 < all, "{name}: {left_out} of {all} were left out");
    }
}

/// The steps of the references, the largest error and the median that are allowed. Facets of `rft`
/// leave the soil one by one, so that longer steps go over a switch.
fn allowed(model: &Model) -> ([f64; 2], f64, f64) {
    match model {
        Model::Rft => ([1e-4, 3e-5], 1e-5, 1e-9),
        _ => ([3e-3, 1e-3], 1e-6, 1e-10),
    }
}

#[test]
fn derivatives_of_a_wheel_are_those_of_whole_settlings() {
    for model in Model::ALL {
        let (steps, worst, median) = allowed(&model);
        compare(&model, 60, steps).check(model.name(), worst, median);
    }
}

#[test]
#[ignore = "some minutes"]
fn derivatives_of_ten_thousand_wheels_are_those_of_whole_settlings() {
    for model in Model::ALL {
        let (steps, worst, median) = allowed(&model);
        compare(&model, 10_000, steps).check(model.name(), worst, median);
    }
}

/// Bekker's wheel carries W ∝ k_φ h^n √h nearly, and forces scale: each derivative by the load and
/// by all that forces are made of adds up (Euler), whatever the model.
#[test]
fn a_soil_twice_as_strong_under_twice_the_load_is_no_change() {
    let contact = given::on_stand(given::simulant_2007(), given::hakuto_wheel(), 0.2, 0.1);
    let numbers = Numbers::of(contact, [0.2, 0.1], 17.0);
    let with = |values: &[f64]| numbers.with(values);
    let model = Model::Ishigami;
    let settled = given::settled(model.as_ref(), &contact, 17.0);
    let changeable = ChangeableWheel { model: model.as_ref(), with: &with };
    let found = gradient(&changeable, &numbers.variables(), &contact, &settled);
    // k_c is not among the numbers: take it out of the contact's stiffness.
    let by = |place: usize| found.by_variable[place].as_ref().unwrap().value;
    let sum = |of: fn(&Settled) -> f64| -> f64 {
        [0, 2, 3, 11].map(|place| of(&by(place)) * numbers.values[place]).iter().sum()
    };
    let PressureSinkage::Bekker { k_c, .. } = contact.soil.pressure_sinkage else { unreachable!() };
    assert!(k_c > 0.0, "its part is what the sums lack");
    assert!((sum(|it| it.forces.normal_force) - 17.0).abs() < 1e-8);
    let without = |cohesive: f64| {
        let mut soil = contact.soil;
        let PressureSinkage::Bekker { k_c, .. } = &mut soil.pressure_sinkage else {
            unreachable!()
        };
        *k_c = cohesive;
        given::settled(model.as_ref(), &Contact { soil, ..contact }, 17.0)
    };
    let [less, more] = [without(k_c * (1.0 - 1e-4)), without(k_c * (1.0 + 1e-4))];
    let by_k_c = (more.sinkage - less.sinkage) / 2e-4;
    assert!((sum(|it| it.sinkage) + by_k_c).abs() < 1e-8 * settled.sinkage.max(1.0));
}

/// Sides are swapped by a mirror: what pulls to the left pulls to the right.
#[test]
fn a_mirrored_wheel_has_mirrored_derivatives() {
    let of = |beta: f64| {
        let contact = given::on_stand(given::toyoura(), given::hakuto_wheel(), 0.3, beta);
        let numbers = Numbers::of(contact, [0.3, beta], 17.0);
        let with = |values: &[f64]| numbers.with(values);
        let model = Model::Ishigami;
        let settled = given::settled(model.as_ref(), &contact, 17.0);
        let changeable = ChangeableWheel { model: model.as_ref(), with: &with };
        gradient(&changeable, &numbers.variables(), &contact, &settled)
    };
    let [left, right] = [of(0.2), of(-0.2)];
    assert!(left.evaluations <= 2 * (12 + 1) + 2, "{}", left.evaluations);
    for place in [1, 3, 6, 7, 9, 11] {
        let [left, right] = [&left, &right].map(|it| it.by_variable[place].as_ref().unwrap().value);
        assert!((left.sinkage - right.sinkage).abs() < 1e-8 * left.sinkage.abs().max(1.0));
        let sides = left.forces.side_force + right.forces.side_force;
        assert!(sides.abs() < 1e-8 * left.forces.side_force.abs().max(1.0), "{place}: {sides}");
    }
}

/// The stress peak moves with |s|: a wheel that rolls freely has a kink.
#[test]
fn a_wheel_that_rolls_freely_has_one_sided_derivatives_by_its_slip() {
    let contact = given::on_stand(given::toyoura(), given::hakuto_wheel(), 0.0, 0.0);
    let numbers = Numbers::of(contact, [0.0, 0.0], 17.0);
    let with = |values: &[f64]| numbers.with(values);
    let model = Model::Ishigami;
    let settled = given::settled(model.as_ref(), &contact, 17.0);
    let mut variables = numbers.variables();
    variables[9].range = Span::ANY;
    let changeable = ChangeableWheel { model: model.as_ref(), with: &with };
    let found = gradient(&changeable, &variables, &contact, &settled);
    let by_slip = found.by_variable[9].as_ref().unwrap();
    let [below, above] = by_slip.sides.map(|it| it.sinkage);
    assert!((below - above).abs() > 1e-4, "{below} and {above} m");
    let at = |slip: f64| {
        let contact = given::on_stand(given::toyoura(), given::hakuto_wheel(), slip, 0.0);
        given::settled(model.as_ref(), &contact, 17.0).sinkage
    };
    let step = 1e-5;
    assert!((above - (at(step) - at(0.0)) / step).abs() < 1e-5);
    assert!((below - (at(0.0) - at(-step)) / step).abs() < 1e-5);
}

const HEADING_KEYS: [&str; 8] = [
    "soil.friction_angle_deg",
    "soil.pressure_sinkage.n",
    "soil.stress_peak.a1",
    "rover.wheel_unit.wheel.radius_m",
    "rover.body.mass_kg",
    "rover.mount.0.position_m.0",
    "gravity_m_s2",
    "duration_s",
];

/// Yaw, slip, sinkage and energy on slopes, and the steepest slope, by numbers of rover and soil:
/// against differences of whole curves.
#[test]
fn derivatives_of_headings_are_those_of_whole_curves() {
    let mut worst = 0.0_f64;
    for model in ["ishigami", "bekker", "small-wheel", "rft"] {
        // Longer steps of `rft` go over facets that leave the soil.
        let (share, allowed) = if model == "rft" { (3e-4, 1e-5) } else { (1e-3, 1e-6) };
        let overrides = Overrides::parse(&[format!("scenario.model={model}")]).unwrap();
        let scenario = read_scenario(&Source::default_scenario(), &overrides).unwrap();
        let asked = GradientKeys::These(HEADING_KEYS.map(String::from).into());
        let keys = HeadingKeys::of(&scenario, Steering::None, &asked).unwrap();
        let curve = HeadingStudy::of(&scenario.value).curve().unwrap();
        let (limit, _) = curve.limit().unwrap();
        let slopes = [0.3, 0.6, 0.9].map(|share| share * limit);
        let of_limit = keys.of_limit(&curve);
        for (place, key) in HEADING_KEYS.iter().enumerate() {
            let value = scenario.document.number(key).unwrap();
            let step = share * value.abs();
            let of = |changed: f64| {
                let changed = grouser::document::scenario_with(&scenario.value, [(*key, changed)]);
                let curve = HeadingStudy::of(&changed.unwrap()).curve().unwrap();
                let [low, middle, high] = slopes.map(|slope| curve.at(slope).unwrap().yaw);
                [low, middle, high, curve.limit().unwrap().0].map(f64::to_degrees)
            };
            let ends = [1.0, 2.0, 3.0].map(|it| [of(value - it * step), of(value + it * step)]);
            // The six-point difference.
            let reference = |place: usize| {
                let [near, middle, far] = ends.map(|[below, above]| above[place] - below[place]);
                (45.0 * near - 9.0 * middle + far) / (60.0 * step)
            };
            let size = |reference: f64| allowed * (reference.abs() + 10.0 / value.abs());
            for (at, slope) in slopes.iter().enumerate() {
                let found = keys.on_slope(&curve, *slope)[place].as_ref().unwrap()[0];
                let reference = reference(at);
                let error = (found.value - reference).abs();
                worst = worst.max(error / size(reference));
                assert!(
                    error < size(reference),
                    "{model}, {key}, {:.1}°: {found:?} for {reference}",
                    slope.to_degrees()
                );
            }
            let reference = reference(3);
            let found = of_limit[place].unwrap();
            assert!(
                (found.value - reference).abs() < size(reference),
                "{model}, {key}, steepest slope: {found:?} for {reference}"
            );
        }
        let by_slope = {
            let asked = GradientKeys::These(vec!["slope_deg".into()]);
            let keys = HeadingKeys::of(&scenario, Steering::None, &asked).unwrap();
            keys.on_slope(&curve, slopes[1])[0].as_ref().unwrap()[0].value
        };
        let yaw = |degrees: f64| curve.at(slopes[1] + deg(degrees)).unwrap().yaw.to_degrees();
        let reference = (yaw(0.01) - yaw(-0.01)) / 0.02;
        assert!((by_slope - reference).abs() < 1e-5, "{model}: {by_slope} for {reference}");
    }
    println!("headings: worst {worst:.2} of what is allowed");
}

/// Ishigami's model, which counts how often all forces of a wheel are computed.
struct Counted(&'static AtomicUsize);

impl WheelSoilModel for Counted {
    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        self.0.fetch_add(1, Ordering::Relaxed);
        Ishigami::DEFAULT.forces(contact, sinkage)
    }
}

/// How often something computes all forces of a wheel.
fn count_of<T>(counter: &AtomicUsize, work: impl FnOnce() -> T) -> (T, usize) {
    let before = counter.load(Ordering::Relaxed);
    let done = work();
    (done, counter.load(Ordering::Relaxed) - before)
}

/// By 17 numbers of a wheel's documents and setting, in at most 40 evaluations of its forces, and at
/// most ten times what one settling takes.
#[test]
fn seventeen_derivatives_of_a_wheel_take_forty_forces() {
    static FORCES: AtomicUsize = AtomicUsize::new(0);
    let model = Model::own(Counted(&FORCES));
    let none = Overrides::none();
    let soil = read_soil(&Source::find(Kind::Soil, "cmu-direct90-smooth").unwrap(), &none).unwrap();
    let wheel = read_wheel(&Source::find(Kind::Wheel, "hakuto").unwrap(), &none).unwrap();
    let all = WheelKeys::of(&soil, &wheel, &GradientKeys::All).unwrap();
    let names: Vec<String> = all.names().take(14).map(String::from).collect();
    let settings = ["load_n", "slip_ratio", "slip_angle_deg"].map(String::from);
    let asked = GradientKeys::These([&names[..], &settings[..]].concat());
    let keys = WheelKeys::of(&soil, &wheel, &asked).unwrap();
    assert_eq!(keys.names().count(), 17);
    let setting = StandSetting { gravity: 9.81, load: 17.0, slip_ratio: 0.2, slip_angle: 0.1 };
    let slip = Slip::on_test_stand(setting.slip_ratio, setting.slip_angle);
    let contact = Contact { soil: soil.value, wheel: wheel.value, slip, gravity: setting.gravity };
    let (settled, settling) =
        count_of(&FORCES, || settle(model.as_ref(), &contact, setting.load).unwrap());
    let (found, forces) =
        count_of(&FORCES, || keys.of_wheel(&model, &setting, &ChangedKeys::default(), &settled));
    assert!(found.iter().all(Option::is_some));
    assert!(forces <= 40, "{forces} forces");
    assert!(forces <= 10 * settling, "{forces} forces, {settling} for settling");
}

/// A curve of headings with its derivatives by 20 numbers takes at most ten times the forces that
/// the curve alone takes.
#[test]
fn a_curve_of_headings_has_twenty_derivatives_for_ten_curves() {
    static FORCES: AtomicUsize = AtomicUsize::new(0);
    let mut scenario = read_scenario(&Source::default_scenario(), &Overrides::none()).unwrap();
    scenario.value.model = Model::own(Counted(&FORCES));
    let all = HeadingKeys::of(&scenario, Steering::None, &GradientKeys::All).unwrap();
    let names: Vec<String> = all.names().take(20).map(String::from).collect();
    let keys =
        HeadingKeys::of(&scenario, Steering::None, &GradientKeys::These(names.clone())).unwrap();
    assert_eq!(names.len(), 20);
    let (curve, alone) = count_of(&FORCES, || HeadingStudy::of(&scenario.value).curve().unwrap());
    let ((), more) = count_of(&FORCES, || {
        for slope in [5.0, 10.0, 15.0, 20.0] {
            assert!(keys.on_slope(&curve, deg(slope)).iter().any(Option::is_some));
        }
        assert!(keys.of_limit(&curve).iter().any(Option::is_some));
    });
    println!("20 derivatives of a curve: {:.1} curves", 1.0 + more as f64 / alone as f64);
    assert!(alone + more <= 10 * alone, "{more} forces beside {alone}");
}

fn heading_keys(keys: &[&str]) -> (HeadingKeys, grouser::document::LoadedScenario) {
    let scenario = read_scenario(&Source::default_scenario(), &Overrides::none()).unwrap();
    let asked = GradientKeys::These(keys.iter().map(|key| (*key).to_owned()).collect());
    (HeadingKeys::of(&scenario, Steering::None, &asked).unwrap(), scenario)
}

/// On level ground the heading is none, and begins to turn with the slope as it does just beside.
#[test]
fn a_heading_begins_to_turn_on_level_ground() {
    let (keys, scenario) = heading_keys(&["slope_deg"]);
    let study = HeadingStudy::of(&scenario.value);
    for course in [0.0, deg(30.0)] {
        let curve = study.curve_on(course).unwrap();
        let by_slope = |slope: f64| keys.on_slope(&curve, slope)[0].as_ref().unwrap()[0].value;
        let [level, beside] = [by_slope(0.0), by_slope(deg(0.01))];
        assert!((level - beside).abs() < 0.02 * beside.abs(), "{level}, beside it {beside}");
        assert!(beside > 0.1, "{beside}");
    }
}

/// Straight up a slope the wheels spin on the spot in the end: that limit has derivatives, too.
#[test]
fn a_steepest_slope_on_which_wheels_spin_has_derivatives() {
    let key = "soil.friction_angle_deg";
    let (keys, scenario) = heading_keys(&[key]);
    let limit = |degrees: f64| {
        let changed = grouser::document::scenario_with(&scenario.value, [(key, degrees)]).unwrap();
        let curve = HeadingStudy::of(&changed).curve_on(deg(90.0)).unwrap();
        curve.limit().unwrap().0.to_degrees()
    };
    let curve = HeadingStudy::of(&scenario.value).curve_on(deg(90.0)).unwrap();
    let found = keys.of_limit(&curve)[0].expect("a derivative").value;
    let reference = (limit(38.01) - limit(37.99)) / 0.02;
    assert!((found - reference).abs() < 1e-4, "{found} for {reference}");
}

/// On the steepest slope itself the curve turns back: no number there is a derivative.
#[test]
fn the_steepest_slope_itself_has_no_derivatives_of_its_heading() {
    let (keys, scenario) = heading_keys(&["soil.friction_angle_deg"]);
    let curve = HeadingStudy::of(&scenario.value).curve().unwrap();
    let (limit, _) = curve.limit().unwrap();
    assert_eq!(keys.on_slope(&curve, limit)[0], None);
    assert!(keys.on_slope(&curve, limit - deg(0.01))[0].is_some());
}

#[test]
fn a_wheel_without_a_load_has_no_derivatives() {
    let contact = given::on_stand(given::toyoura(), given::hakuto_wheel(), 0.2, 0.0);
    let numbers = Numbers::of(contact, [0.2, 0.0], 0.0);
    let with = |values: &[f64]| numbers.with(values);
    let settled = given::settled(Model::Ishigami.as_ref(), &contact, 0.0);
    let changeable = ChangeableWheel { model: Model::Ishigami.as_ref(), with: &with };
    let found = gradient(&changeable, &numbers.variables(), &contact, &settled);
    assert!(found.by_variable.iter().all(Option::is_none));
}
