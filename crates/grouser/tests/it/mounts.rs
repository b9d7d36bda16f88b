//! Wheels that differ from mount to mount, and wheels that are steered.

use grouser::contact::{Model, WheelForces};
use grouser::document::{Overrides, Source, read_rover, read_scenario};
use grouser::simulation::{Approach, Motion, Numerics, Scenario, Start};
use grouser::soil::{PressureSinkage, Soil};
use grouser::studies::heading::HeadingStudy;
use grouser::units::{Vec2, Vec3, deg};
use grouser::vehicle::{DriveLaw, LoadSharing, Mount, OwnMoments, Rover};
use grouser::wheel::Wheel;
use nalgebra::Rotation2;

use super::given::{self, RIM_SPEED, hakuto, run, traverse};

/// The rover of the source with its mounts changed.
pub(super) fn changed(change: impl Fn(usize, &mut Mount)) -> Rover {
    let rover = hakuto();
    let mut mounts = rover.mounts().to_vec();
    mounts.iter_mut().enumerate().for_each(|(place, mount)| change(place, mount));
    Rover::new(*rover.body(), mounts).expect("a rover that stands")
}

/// Soil that wheels hardly sink into: so little slip is needed that a rover follows its wheels.
pub(super) fn firm() -> Soil {
    let soil = given::toyoura();
    let PressureSinkage::Reece { k_c, k_phi, exponent } = soil.pressure_sinkage else {
        panic!("Toyoura sand has Reece's law");
    };
    let pressure_sinkage = PressureSinkage::Reece { k_c, k_phi: 1e4 * k_phi, exponent };
    Soil { pressure_sinkage, ..soil }
}

fn on_level_firm_ground(rover: Rover) -> Scenario {
    let base = traverse(0.0, 0.0);
    Scenario { rover, ground: base.ground.clone().with_soil(firm()), duration: 5.0, ..base }
}

/// On the left in the order of the mounts: front left, rear left, rear right, front right.
fn is_left(place: usize) -> bool {
    place < 2
}

#[test]
fn mounts_that_repeat_the_common_unit_make_the_same_rover() {
    let text = |mounts: &str| {
        format!(
            "schema = \"rover/1\"\n[body]\nmass_kg = 5.0\n\
             inertia_kg_m2 = {{ xx = 0.1, yy = 0.1, zz = 0.2 }}\n[wheel_unit]\nmass_kg = 0.4\n\
             inertia_kg_m2 = {{ xx = 0.001, yy = 0.002, zz = 0.001 }}\nwheel = \"hakuto\"\n{mounts}"
        )
    };
    let mount = |name: &str, x: f64, y: f64, more: &str| {
        format!("[[mount]]\nname = \"{name}\"\nposition_m = [{x}, {y}, -0.06]\n{more}")
    };
    let all = |more: &str| {
        let hubs = [("a", 0.2, 0.2), ("b", -0.2, 0.2), ("c", -0.2, -0.2), ("d", 0.2, -0.2)];
        text(&hubs.map(|(name, x, y)| mount(name, x, y, more)).concat())
    };
    let read = |text: String| {
        let loaded = read_rover(&Source::text("a rover", text), &Overrides::none());
        loaded.expect("it is a rover").value
    };
    let common = read(all(""));
    let repeated = read(all("mass_kg = 0.4\nsteering_deg = 0.0\nwheel = \"hakuto\"\n\
         inertia_kg_m2 = { xx = 0.001, yy = 0.002, zz = 0.001 }\n"));
    assert_eq!(common, repeated);
    let end = |rover: &Rover| {
        run(&Scenario { rover: rover.clone(), duration: 2.0, ..traverse(deg(10.0), deg(3.0)) })
    };
    assert_eq!(end(&common), end(&repeated));
    // And the document repeats what its author wrote, no more.
    let source = Source::text("a rover", all(""));
    let loaded = read_rover(&source, &Overrides::none()).expect("it is a rover");
    assert!(!loaded.to_toml().contains("steering"), "{}", loaded.to_toml());
}

#[test]
fn a_document_has_wheels_of_their_own_and_steering() {
    let text = "schema = \"scenario/1\"\n[rover]\nschema = \"rover/1\"\n[rover.body]\nmass_kg = 5.0\n\
        inertia_kg_m2 = { xx = 0.1, yy = 0.1, zz = 0.2 }\n[rover.wheel_unit]\nmass_kg = 0.4\n\
        inertia_kg_m2 = { xx = 0.001, yy = 0.002, zz = 0.001 }\nwheel = \"hakuto\"\n\
        [[rover.mount]]\nname = \"front\"\nposition_m = [0.2, 0.0, -0.06]\nsteering_deg = 20\n\
        [[rover.mount]]\nname = \"left\"\nposition_m = [-0.2, 0.2, -0.06]\nmass_kg = 0.9\n\
        [[rover.mount]]\nname = \"right\"\nposition_m = [-0.2, -0.2, -0.07]\n\
        wheel = { radius_m = 0.1, width_m = 0.2 }\n";
    let read = |settings: &[&str]| {
        let overrides = Overrides::parse(settings).expect("settings");
        read_scenario(&Source::text("a scenario", text), &overrides)
    };
    let loaded = read(&[]).expect("a scenario");
    let [front, left, right] = loaded.value.rover.mounts() else { panic!("three wheels") };
    assert_eq!((front.steering, left.steering), (deg(20.0), 0.0));
    assert_eq!((front.unit.mass, left.unit.mass), (0.4, 0.9));
    assert_eq!(left.unit.wheel, given::hakuto_wheel());
    assert_eq!((right.unit.wheel.width, right.unit.wheel.grousers), (0.2, None));
    assert_eq!((right.shearing_radius(), left.shearing_radius()), (0.1, 0.11));
    assert!((loaded.value.rover.mass() - (5.0 + 0.4 + 0.9 + 0.4)).abs() < 1e-12);
    let again = read_scenario(&Source::text("again", loaded.to_toml()), &Overrides::none());
    assert_eq!(again.expect("it was written").value, loaded.value);

    // What is set for wheels is set for the common one; a mount's own has its own key.
    let set = read(&[
        "wheel.width_m=0.05",
        "scenario.rover.mount.2.wheel.width_m=0.3",
        "rover.mount.1.steering_deg=-5",
    ]);
    let set = set.expect("a scenario").value.rover;
    let widths: Vec<f64> = set.mounts().iter().map(|mount| mount.unit.wheel.width).collect();
    assert_eq!(widths, [0.05, 0.05, 0.3]);
    assert_eq!(set.mounts()[1].steering, deg(-5.0));

    let message = |settings: &[&str]| read(settings).expect_err("no rover").to_string();
    let too_low = message(&["rover.mount.2.wheel.radius_m=0.12"]);
    assert!(too_low.contains("height z of wheel right"), "{too_low}");
    let too_wide = message(&["rover.mount.2.wheel.width_m=9"]);
    assert!(too_wide.contains("`rover.mount.2.wheel.width_m` is 9"), "{too_wide}");
    let too_far = message(&["rover.mount.0.steering_deg=91"]);
    assert!(too_far.contains("`rover.mount.0.steering_deg` is 91"), "{too_far}");
}

/// Wide wheels on one side turn a climbing rover to the side that pulls less, as the test stand
/// says: in dry sand theirs, for its pressure grows more than in proportion with depth and they
/// stay in its soft top; in cohesive soil the other, for they hold on to more of it.
#[test]
fn wide_wheels_on_one_side_turn_the_rover_to_the_side_that_pulls_less() {
    let wide = |wheel: Wheel| Wheel { width: 2.0 * wheel.width, ..wheel };
    let cohesive = Soil { cohesion: 3000.0, ..given::toyoura() };
    for (soil, name, side) in [(given::toyoura(), "sand", 1.0), (cohesive, "cohesive soil", -1.0)] {
        let turn = |widens: fn(usize) -> bool| {
            let rover = changed(|place, mount| {
                if widens(place) {
                    mount.unit.wheel = wide(mount.unit.wheel);
                }
            });
            let base = traverse(deg(16.0), deg(90.0));
            let ground = base.ground.clone().with_soil(soil);
            let scenario = Scenario { rover, ground, duration: 5.0, ..base };
            run(&scenario).last().state.yaw - deg(90.0)
        };
        let pull = |wheel: Wheel| {
            let contact = given::on_stand(soil, wheel, 0.2, 0.0);
            given::settled(Model::Ishigami.as_ref(), &contact, 17.0).forces.drawbar_pull
        };
        let lacking = pull(given::hakuto_wheel()) - pull(wide(given::hakuto_wheel()));
        assert!(lacking.signum() == side && lacking.abs() > 0.05, "{name}: {lacking} N");
        let (left, right, none) = (turn(is_left), turn(|place| !is_left(place)), turn(|_| false));
        assert!(left * side > deg(0.1) && right * side < -deg(0.1), "{name}: {left} and {right}");
        assert!(
            (left + right).abs() < 1e-6 && none.abs() < 1e-6,
            "{name}: {left}, {right}, {none}"
        );
    }
}

/// The hubs of wheels that differ in radius differ in height; their lowest points lie on one plane.
#[test]
fn a_larger_wheel_needs_a_higher_hub_and_turns_slower() {
    let larger = |rise: f64| {
        let rover = hakuto();
        let mut mounts = rover.mounts().to_vec();
        mounts[0].unit.wheel.radius += 0.03;
        mounts[0].position.z += rise;
        Rover::new(*rover.body(), mounts)
    };
    assert!(larger(0.0).is_err() && larger(0.02).is_err());
    let rover = larger(0.03).expect("all stand on one plane");
    assert_eq!(rover.common_radius(), None);
    // It stands as high as before: the same lowest points, and the wheel has the same mass.
    let lifted = 0.422 * 0.03 / rover.mass();
    assert!((rover.centre_height() - hakuto().centre_height() - lifted).abs() < 1e-12);
    let run = run(&Scenario { rover, duration: 1.0, ..traverse(deg(5.0), 0.0) });
    let wheels = &run.last().wheels;
    let speeds = [wheels[0].wheel_speed, wheels[1].wheel_speed];
    assert!((speeds[0] - RIM_SPEED / 0.14).abs() < 1e-12);
    assert!((speeds[1] - RIM_SPEED / 0.11).abs() < 1e-12);
    assert!(run.energy_error().abs() < 1e-6, "{} J", run.energy_error());
}

/// Front wheels to the left and rear wheels to the right by δ: the axles' normals meet on the line
/// through the middle of the wheelbase L, at R = L/(2 tan δ). Left and right wheels have one angle,
/// a misfit that cancels but for the square of half the track over R, and rims as fast as their
/// distances from there.
#[test]
fn front_and_rear_wheels_steered_against_each_other_drive_an_arc() {
    for steering in [deg(5.0), deg(-10.0)] {
        let front = |place: usize| place == 0 || place == 3;
        let rover = changed(|place, mount| {
            mount.steering = if front(place) { steering } else { -steering };
        });
        let radius = 0.36 / 2.0 / steering.tan();
        let rim = |mount: &Mount| RIM_SPEED * (1.0 - mount.position.y / radius);
        let drive = DriveLaw::ConstantEach(rover.mounts().iter().map(rim).collect());
        let end = run(&Scenario { drive, ..on_level_firm_ground(rover) }).last().state;
        // The body's centre is 1 cm behind the middle of the wheelbase.
        let middle = end.velocity + end.yaw_rate * Vec2::new(0.0, 0.01);
        let driven = middle.x / end.yaw_rate;
        assert!(
            (driven / radius - 1.0).abs() < 0.01 + (0.24 / radius).powi(2),
            "{driven} m, not {radius} m"
        );
    }
}

/// Each wheel across its line to one centre, and as fast as its distance from there: the arc is
/// that of the kinematics, and the wheels slip no more than on a straight way.
#[test]
fn wheels_steered_about_one_centre_drive_about_it() {
    let centre = Vec2::new(0.01, 1.0);
    let rover = changed(|_, mount| {
        let to_centre = centre - mount.position.xy();
        mount.steering = (-to_centre.x).atan2(to_centre.y);
    });
    let distance = |mount: &Mount| (centre - mount.position.xy()).norm();
    let rims = rover.mounts().iter().map(|mount| RIM_SPEED * distance(mount)).collect();
    let straight = run(&on_level_firm_ground(hakuto()));
    let scenario = Scenario { drive: DriveLaw::ConstantEach(rims), ..on_level_firm_ground(rover) };
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let numerics = Numerics { approach, ..scenario.numerics };
        let run = run(&Scenario { numerics, ..scenario.clone() });
        let end = run.last();
        // The centre of rotation, seen from the body: v = ω × (−c).
        let found = Vec2::new(-end.state.velocity.y, end.state.velocity.x) / end.state.yaw_rate;
        assert!((found - centre).norm() < 0.02, "{found}");
        for (wheel, other) in end.wheels.iter().zip(&straight.last().wheels) {
            let (slip, there) = (wheel.reaction.slip, other.reaction.slip);
            assert!((slip.ratio - there.ratio).abs() < 0.01, "{slip:?} and {there:?}");
            assert!(slip.angle.abs() < 0.01, "{slip:?}");
        }
    }
}

#[test]
fn all_wheels_steered_alike_let_the_rover_crab() {
    let rover = changed(|_, mount| mount.steering = deg(30.0));
    let run = run(&on_level_firm_ground(rover));
    let (first, last) = (&run.records[0].state, &run.last().state);
    let way = last.position - first.position;
    assert!((way.y.atan2(way.x) - deg(30.0)).abs() < deg(0.2), "{way}");
    assert!(last.yaw.abs() < deg(0.2) && way.norm() > 0.25, "{} and {way}", last.yaw);
}

/// What is the body's forward is nobody's business: a rover with its parts turned in its frame, its
/// wheels steered the other way and its yaw to match, is the same rover. All that counts directions
/// is in here: motion, loads, torques and moments in the balance of loads, powers.
#[test]
fn a_rover_described_in_a_turned_frame_is_the_same_rover() {
    let turn = deg(35.0);
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        for (sharing, own_moments) in [
            (LoadSharing::Uniform, OwnMoments::Included),
            (LoadSharing::QuasiStatic, OwnMoments::Neglected),
            (LoadSharing::QuasiStatic, OwnMoments::Included),
            (LoadSharing::QuasiStaticTorque, OwnMoments::Neglected),
            (LoadSharing::QuasiStaticTorque, OwnMoments::Included),
        ] {
            let base = traverse(deg(10.0), deg(12.0));
            let numerics = Numerics { approach, ..base.numerics };
            let drive = DriveLaw::ConstantEach(vec![0.055, 0.05, 0.06, 0.065]);
            let base = Scenario { sharing, own_moments, numerics, drive, duration: 3.0, ..base };
            let mut mounts = base.rover.mounts().to_vec();
            for mount in &mut mounts {
                let plane = Rotation2::new(turn) * mount.position.xy();
                mount.position = Vec3::new(plane.x, plane.y, mount.position.z);
                mount.steering = turn;
            }
            let rover = Rover::new(*base.rover.body(), mounts).expect("it stands as before");
            let start = Start { yaw: base.start.yaw - turn, ..base.start };
            let turned = run(&Scenario { rover, start, ..base.clone() });
            let straight = run(&base);
            // Where torques count, the forces along the rover are those of now and those across it
            // those of rest: these differ by what accelerates the rover round its bend.
            let within = if sharing == LoadSharing::QuasiStaticTorque { 1e-3 } else { 1e-6 };
            let (one, other) = (straight.last(), turned.last());
            assert!((one.state.position - other.state.position).norm() < within, "{sharing:?}");
            assert!((one.state.yaw - turn - other.state.yaw).abs() < within, "{sharing:?}");
            for (wheel, there) in one.wheels.iter().zip(&other.wheels) {
                let (wheel, there) = (wheel.reaction, there.reaction);
                assert!(
                    (wheel.load / there.load - 1.0).abs() < 5.0 * within,
                    "{sharing:?}, {own_moments:?}"
                );
                let pull = |wheel: &grouser::vehicle::WheelReaction| wheel.settled.forces.torque;
                assert!((pull(&wheel) / pull(&there) - 1.0).abs() < 10.0 * within, "{sharing:?}");
            }
            let energies = (one.energy, other.energy);
            assert!(
                (energies.0.motors / energies.1.motors - 1.0).abs() < 10.0 * within,
                "{energies:?}"
            );
            assert!(turned.energy_error().abs() < 1e-5, "{} J", turned.energy_error());
        }
    }
}

/// Different wheels, steered differently, on every place.
pub(super) fn motley() -> Rover {
    changed(|place, mount| {
        let share = place as f64;
        mount.unit.wheel.width *= 1.0 + 0.2 * share;
        mount.unit.wheel.radius += 0.01 * share;
        mount.position.z += 0.01 * share;
        mount.unit.mass *= 1.0 + 0.5 * share;
        mount.unit.inertia.yy *= 1.0 + share;
        mount.steering = deg(3.0) * (share - 1.0);
    })
}

#[test]
fn a_mirrored_rover_of_different_wheels_drives_the_mirrored_way() {
    let rover = motley();
    assert!(!rover.is_symmetric() && hakuto().is_symmetric());
    assert_eq!(rover.mirrored().mirrored(), rover);
    let rims = DriveLaw::ConstantEach(vec![0.05, 0.06, 0.07, 0.04]);
    let base = Scenario { drive: rims, duration: 3.0, ..traverse(0.0, deg(5.0)) };
    let (sharing, own_moments) = (LoadSharing::QuasiStaticTorque, OwnMoments::Included);
    let one = run(&Scenario { rover: rover.clone(), sharing, own_moments, ..base.clone() });
    let start = Start { yaw: -base.start.yaw, ..base.start };
    let other = run(&Scenario { rover: rover.mirrored(), sharing, own_moments, start, ..base });
    let (here, there) = (&one.last().state, &other.last().state);
    assert!((here.position.x - there.position.x).abs() < 1e-7);
    assert!((here.position.y + there.position.y).abs() < 1e-7);
    assert!((here.yaw + there.yaw).abs() < 1e-7, "{} and {}", here.yaw, there.yaw);
    assert!(here.yaw.abs() > deg(4.0) && here.position.y.abs() > 0.01, "{here:?}");
}

/// The sums over wheels that differ are those over their parts.
#[test]
fn masses_and_energies_of_different_wheels_add_up() {
    let rover = motley();
    let units = rover.mounts().iter().map(|mount| mount.unit);
    let mass = rover.body().mass + units.map(|unit| unit.mass).sum::<f64>();
    assert!((rover.mass() - mass).abs() < 1e-12);
    let yaw_inertia: f64 = rover
        .mounts()
        .iter()
        .map(|m| m.unit.inertia.zz + m.unit.mass * m.position.xy().norm_squared())
        .sum();
    assert!((rover.yaw_inertia() - rover.body().inertia.zz - yaw_inertia).abs() < 1e-12);
    for approach in [Approach::Dynamic, Approach::QuasiSteady] {
        let base = traverse(deg(12.0), deg(5.0));
        let numerics = Numerics { approach, ..base.numerics };
        let start = Start { motion: Motion::Rest, ..base.start };
        let trajectory = run(&Scenario { rover: rover.clone(), numerics, start, ..base });
        let error = trajectory.energy_error();
        assert!(error.abs() < 1e-5 * trajectory.last().energy.motors, "{error} J");
    }
}

/// The heading offset of a rover with different wheels: each with its own forces at the one slip
/// ratio and the one slip angle, which together hold the rover on the slope.
#[test]
fn an_attitude_of_different_wheels_holds_the_slope() {
    let rover = changed(|place, mount| {
        if is_left(place) {
            mount.unit.wheel.width *= 1.5;
            mount.unit.wheel.radius += 0.02;
            mount.position.z += 0.02;
        }
    });
    let scenario = Scenario { rover, ..traverse(deg(10.0), 0.0) };
    let study = HeadingStudy::of(&scenario);
    let attitude = study.curve().expect("a study").at(deg(10.0)).expect("it exists");
    let rover = &scenario.rover;
    let weight = rover.mass() * scenario.gravity;
    let sum = |part: fn(&WheelForces) -> f64| {
        attitude.wheels.iter().map(|wheel| part(&wheel.settled.forces)).sum::<f64>()
    };
    let force = Vec2::new(sum(|wheel| wheel.drawbar_pull), sum(|wheel| wheel.side_force));
    let uphill = Rotation2::new(attitude.yaw) * force;
    assert!((uphill - Vec2::new(0.0, weight * deg(10.0).sin())).norm() < 1e-8 * weight, "{uphill}");
    // Over a metre of way the hubs cover cos γ, the rims 1/(1 − s) of that, and each wheel turns by
    // what its radius makes of it: the work is the power over the speed.
    let rims = attitude.yaw.cos() / (1.0 - attitude.slip_ratio);
    let power = attitude.power(rover, rims);
    assert!((attitude.energy_per_metre(rover) / power - 1.0).abs() < 1e-12);
    let torques = attitude.wheels.iter().map(|wheel| wheel.settled.forces.torque);
    let turned = [0.13, 0.13, 0.11, 0.11].map(|radius| rims / radius);
    let work: f64 = torques.zip(turned).map(|(torque, angle)| torque * angle).sum();
    assert!((work / power - 1.0).abs() < 1e-12);
    let steered = changed(|place, mount| mount.steering = deg(place as f64));
    assert!(HeadingStudy { rover: steered, ..study }.curve().is_err());
}
