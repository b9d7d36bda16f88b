//! Presets of rovers that flew, or were to: their numbers go together, and estimates are those of
//! the library.

use std::f64::consts::FRAC_PI_2;

use grouser::document::{
    Kind, LoadedRover, LoadedScenario, Overrides, Source, presets, read_rover, read_scenario,
};
use grouser::studies::ensemble::Band;
use grouser::studies::ensemble::models::Question;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::heading::HeadingStudy;
use grouser::studies::heading_band::HeadingBand;
use grouser::units::{EARTH_GRAVITY, Vec2, deg};
use grouser::vehicle::estimate::{self, Sizes};
use grouser::vehicle::load::wheel_loads;
use grouser::vehicle::{Inertia, LoadSharing};

/// Name, published mass of all [kg], number of wheels, height of the centre of mass [m], box of the
/// body [m], soil of its world, and that world's gravity.
type Flown = (&'static str, f64, u32, f64, [f64; 3], &'static str, &'static str);

const FLOWN: [Flown; 8] = [
    ("viper", 430.0, 4, 0.59, [1.28, 1.22, 1.0], "lunar-nominal", "moon"),
    ("rashid", 10.0, 4, 0.25, [0.26, 0.42, 0.20], "lunar-nominal", "moon"),
    ("pragyan", 26.0, 6, 0.255, [0.73, 0.68, 0.30], "lunar-nominal", "moon"),
    ("yutu-2", 135.0, 6, 0.45, [1.20, 0.85, 0.40], "lunar-nominal", "moon"),
    ("sojourner", 10.6, 6, 0.205, [0.50, 0.40, 0.15], "mars-regolith", "mars"),
    ("spirit", 174.0, 6, 0.45, [1.34, 1.00, 0.30], "mars-regolith", "mars"),
    ("curiosity", 899.0, 6, 0.85, [2.2, 1.2, 0.5], "mars-regolith", "mars"),
    ("lrv", 700.0, 4, 0.75, [2.3, 1.83, 0.78], "lunar-nominal", "moon"),
];

fn rover(name: &str) -> LoadedRover {
    let source = Source::find(Kind::Rover, name).expect("a preset");
    read_rover(&source, &Overrides::none()).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// A rover on a soil, on a world.
fn scenario_of(rover: &str, soil: &str, world: &str) -> LoadedScenario {
    let mut overrides = Overrides::none();
    overrides.flag_text("--rover", "scenario.rover", rover).expect("a key");
    overrides.flag_text("--soil", "scenario.soil", soil).expect("a key");
    let gravity = grouser::document::gravity(world).expect("a world").to_string();
    overrides.flag("--gravity-m-s2", "scenario.gravity_m_s2", &gravity).expect("a key");
    read_scenario(&Source::default_scenario(), &overrides).expect(rover)
}

/// Masses are written with six digits.
const MASS_DIGITS: f64 = 1e-5;

#[test]
fn masses_and_heights_are_those_of_their_sources() {
    for (name, mass, wheels, height, ..) in FLOWN {
        let rover = rover(name).value;
        assert!((rover.mass() / mass - 1.0).abs() < MASS_DIGITS, "{name}: {} kg", rover.mass());
        assert_eq!(rover.wheel_count(), wheels as usize, "{name}");
        let centre = rover.centre_height();
        // Hubs are written in micrometres.
        assert!((centre - height).abs() < 1e-5, "{name}: {centre} m");
    }
}

#[test]
fn the_wheels_carry_the_weight_and_as_much_on_the_left_as_on_the_right() {
    for (name, mass, ..) in FLOWN {
        let rover = rover(name).value;
        let weight = rover.mass() * EARTH_GRAVITY;
        let loads = wheel_loads(&rover, LoadSharing::QuasiStatic, weight, Vec2::zeros());
        let loads = loads.unwrap_or_else(|_| panic!("{name} tips over"));
        let sum: f64 = loads.iter().sum();
        assert!((sum / (mass * EARTH_GRAVITY) - 1.0).abs() < MASS_DIGITS, "{name}: {sum} N");
        let mounts = rover.mounts().iter().zip(&loads);
        let left: f64 = mounts.filter(|(it, _)| it.position.y > 0.0).map(|(_, load)| load).sum();
        assert!((left / sum - 0.5).abs() < 1e-9, "{name}: {left} of {sum} N");
    }
}

/// Inertias that their documents call those of boxes and cylinders are, to the four digits that are
/// written.
#[test]
fn assumed_inertias_are_the_estimates_of_the_library() {
    for (name, .., size, _, _) in FLOWN {
        let loaded = rover(name);
        let assumed = loaded.document.get("assumed").expect("a list").to_string();
        assert!(assumed.contains("uniform box") && assumed.contains("uniform cylinder"), "{name}");
        let parts = loaded.value.parts();
        let (body, unit) = (parts.body, parts.wheel_unit);
        let wheel = unit.wheel;
        let of_box = Inertia::of_uniform_box(body.mass, size);
        let of_cylinder = Inertia::of_uniform_cylinder(unit.mass, wheel.radius, wheel.width);
        for (found, expected) in [(body.inertia, of_box), (unit.inertia, of_cylinder)] {
            let axes = [(found.xx, expected.xx), (found.yy, expected.yy), (found.zz, expected.zz)];
            for (found, expected) in axes {
                assert!((found / expected - 1.0).abs() < 1e-3, "{name}: {found}, {expected}");
            }
        }
    }
}

/// Each holds the contour of a gentle slope of its own world.
#[test]
fn each_holds_a_contour_of_its_world() {
    for (name, .., soil, gravity) in FLOWN {
        let scenario = scenario_of(name, soil, gravity);
        let curve = HeadingStudy::of(&scenario.value).curve().expect(name);
        let heading = curve.at(deg(3.0)).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(heading.yaw.is_finite() && heading.yaw > 0.0, "{name}: {heading:?}");
        assert!((0.0..0.6).contains(&heading.slip_ratio), "{name}: {heading:?}");
    }
}

/// The documented reach of [`estimate::sizes`].
#[test]
fn sizes_are_those_of_the_presets_within_a_factor() {
    const FACTOR: f64 = 2.0;
    for preset in presets(Kind::Rover) {
        let rover = rover(preset.name).value;
        let mounts = rover.mounts();
        let ends = |axis: fn(&Vec2) -> f64| {
            let all: Vec<f64> = mounts.iter().map(|it| axis(&it.position.xy())).collect();
            all.iter().fold(f64::MIN, |most, it| most.max(*it))
                - all.iter().fold(f64::MAX, |least, it| least.min(*it))
        };
        let count = u32::try_from(mounts.len()).expect("a few");
        // The flight model of HAKUTO is as large as the heavier one, and the LRV's mass is mostly
        // its load.
        let mass = match preset.name {
            "hakuto-flight" => 6.928,
            "lrv" => 210.0,
            _ => rover.mass(),
        };
        let Sizes { wheelbase, track, wheel_radius, wheel_width } = estimate::sizes(mass, count);
        let wheel = mounts[0].unit.wheel;
        let pairs = [
            (wheelbase, ends(|it| it.x)),
            (track, ends(|it| it.y)),
            (wheel_radius, wheel.radius),
            (wheel_width, wheel.width),
        ];
        for (estimated, found) in pairs {
            let factor = (estimated / found).max(found / estimated);
            assert!(factor < FACTOR, "{}: {estimated} m for {found} m", preset.name);
        }
    }
}

/// What was seen of a rover straight up a slope.
enum Seen {
    /// On a slope [°], [-].
    Slip(f64, f64),
    /// On a slope [°], from, to [mm].
    Sinkage(f64, f64, f64),
    /// The steepest slope [°].
    Limit(f64),
}

/// Rover, soil, world, and what was seen there. Beside `docs/validation.md`, *Rovers on Moon and
/// Mars*, which has the sources.
const SEEN: [(&str, &str, &str, &[Seen]); 5] = {
    use Seen::{Limit, Sinkage, Slip};
    [
        ("yutu-2", "lunar-0-15-cm", "moon", &[Slip(8.9, 0.075), Sinkage(8.9, 5.0, 15.0)]),
        ("lrv", "lunar-0-15-cm", "moon", &[Slip(0.5, 0.025), Limit(23.0)]),
        ("spirit", "mars-regolith", "mars", &[Slip(0.5, 0.025), Slip(16.0, 1.0)]),
        ("spirit", "mars-sand", "mars", &[Slip(16.0, 1.0)]),
        ("curiosity", "mars-sand", "mars", &[Limit(15.0), Limit(23.0)]),
    ]
};

/// What was seen on Moon and Mars beside the bands of the ready soils: `--nocapture` prints the
/// table.
#[test]
fn bands_hold_what_was_seen_on_moon_and_mars() {
    const SLOPES: [f64; 3] = [0.5, 8.9, 16.0];
    for (rover, soil, world, all) in SEEN {
        let scenario = scenario_of(rover, soil, world);
        let inputs = BandInputs::of_scenario(&scenario).asked(Question::Along);
        let samples = inputs.samples(1, 200).expect("samples");
        let study = HeadingStudy::of(&scenario.value);
        let band = HeadingBand::on_course(&study, FRAC_PI_2, &samples, &SLOPES.map(deg), &|| true);
        let band = band.expect(rover).expect("a band");
        let on = |slope: f64| {
            let place = SLOPES.iter().position(|it| *it == slope);
            &band.slopes[place.expect("one of the slopes")]
        };
        for seen in all {
            let (name, found, unit, from, to) = match *seen {
                Seen::Slip(slope, slip) => ("slip", on(slope).slip_ratio, 1.0, slip, slip),
                Seen::Sinkage(slope, from, to) => {
                    ("sinkage [mm]", on(slope).sinkage, 1e-3, from, to)
                }
                Seen::Limit(limit) => ("limit [°]", band.limit, deg(1.0), limit, limit),
            };
            let Band { low, median, high } = found.expect("a band");
            let [low, median, high] = [low, median, high].map(|it| it / unit);
            let what = format!("{rover} on {soil}: {name}");
            println!("{what} {from} to {to}, {low:.3} {median:.3} {high:.3}");
            let holds = (low..=high).contains(&from) && (low..=high).contains(&to);
            assert!(holds, "{what}: {from} to {to} is outside {low} to {high}");
        }
    }
}
