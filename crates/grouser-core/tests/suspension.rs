//! Postures and loads on uneven ground: planes, closed forms, balances and virtual work.

use grouser_core::contact::{Slip, WheelForces};
use grouser_core::paper;
use grouser_core::terrain::{Footprint, Ground, Patch, Terrain};
use grouser_core::units::{Vec2, Vec3, deg};
use grouser_core::vehicle::{
    Balance, Bogie, End, LoadSharing, Mount, OnGround, OwnMoments, Posture, Rover, RoverState,
    Suspension, WheelReaction,
};

/// Ground of some heights.
struct Heights<F: Fn(Vec2) -> f64>(F);

impl<F: Fn(Vec2) -> f64 + Send + Sync> Terrain for Heights<F> {
    fn patch(&self, at: Vec2, footprint: Footprint) -> Patch {
        footprint.fit(&footprint.points(at).map(&self.0))
    }
}

fn ground(
    height: impl Fn(Vec2) -> f64 + Send + Sync,
) -> Heights<impl Fn(Vec2) -> f64 + Send + Sync> {
    Heights(height)
}

/// A plane that rises by the tangent of a slope in a direction [rad].
fn plane(slope: f64, azimuth: f64) -> impl Fn(Vec2) -> f64 + Send + Sync {
    let uphill = slope.tan() * Vec2::new(azimuth.cos(), azimuth.sin());
    move |at| 3.0 + uphill.dot(&at)
}

/// Hills of half a metre, a decimetre high.
fn hills(at: Vec2) -> f64 {
    0.1 * (4.0 * at.x).sin() + 0.08 * (3.1 * at.x + 5.0 * at.y).cos()
}

fn rigid() -> Rover {
    paper::hakuto().expect("it stands")
}

fn rocker() -> Rover {
    let suspension = Suspension { pivot: Vec2::new(0.01, 0.02), bogie: None };
    rigid().on_rockers(suspension).expect("it has four wheels")
}

/// Six wheels; the bogies are at the rear, each with its axis in the middle of its wheels.
fn rocker_bogie() -> Rover {
    let first = rigid().mounts()[0].clone();
    let place = |x: f64, y: f64| Mount {
        name: format!("{x} {y}"),
        position: Vec3::new(x, y, first.position.z),
        ..first.clone()
    };
    let mounts = [(0.4, 0.3), (0.0, 0.3), (-0.3, 0.3), (0.4, -0.3), (0.0, -0.3), (-0.3, -0.3)];
    let mounts = mounts.map(|(x, y)| place(x, y)).to_vec();
    let rover = Rover::new(*rigid().body(), mounts).expect("it stands");
    let bogie = Bogie { pivot: Vec2::new(-0.15, 0.0), end: End::Rear };
    rover
        .on_rockers(Suspension { pivot: Vec2::new(0.05, 0.05), bogie: Some(bogie) })
        .expect("six wheels")
}

fn stand(rover: &Rover, terrain: &dyn Terrain, place: Vec2, yaw: f64) -> Posture {
    let sinkages = vec![0.0; rover.wheel_count()];
    Posture::of(rover, terrain, place, yaw, &sinkages).expect("it stands")
}

const COMPLETE: Balance =
    Balance { sharing: LoadSharing::Complete, own_moments: OwnMoments::Included };

fn close(one: f64, other: f64, within: f64) {
    assert!((one - other).abs() <= within, "{one} and {other} differ by {:e}", one - other);
}

/// On a plane a rover is parallel to it, whatever joins its wheels, and moves along it.
#[test]
fn on_a_plane_the_rover_is_parallel_to_it() {
    for rover in [rigid(), rocker(), rocker_bogie()] {
        for (slope, azimuth, yaw) in [(0.0, 0.0, 0.3), (10.0, 90.0, 0.2), (20.0, 200.0, -2.0)] {
            let (slope, azimuth) = (deg(slope), deg(azimuth));
            let height = plane(slope, azimuth);
            let place = Vec2::new(0.7, -0.4);
            let terrain = ground(&height);
            let posture = stand(&rover, &terrain, place, yaw);
            let [x, _, z] = posture.axes();
            close(z.z, slope.cos(), 1e-12);
            close(x.y.atan2(x.x), yaw, 1e-12);
            // The centre of mass is over the plane by the radius and its height over the hubs.
            let over = (posture.place.z - height(place)) * slope.cos();
            let mount = &rover.mounts()[0];
            close(over, mount.shearing_radius() - mount.position.z, 1e-11);
            assert!(posture.joints.rocker.abs() < 1e-10, "{:?}", posture.joints);

            let state = RoverState {
                velocity: Vec2::new(0.05, -0.01),
                yaw_rate: 0.1,
                ..RoverState::default()
            };
            let motion = posture.motion(&state).expect("it moves");
            for (hub, mount) in motion.hubs.iter().zip(rover.mounts()) {
                let flat = grouser_core::vehicle::kinematics::wheel_velocity(&state, mount);
                close((hub - flat).norm(), 0.0, 1e-12);
            }
            // Turning about the plane's normal, seen from above.
            close(motion.velocity.dot(&z), 0.0, 1e-12);
            let nose = x + 1e-6 * state.yaw_rate * z.cross(&x);
            let turned = nose.y.atan2(nose.x) - x.y.atan2(x.x);
            close(motion.yaw_rate, 1e6 * turned, 1e-6);
        }
    }
}

/// Every wheel stands on its ground, and follows it: the way between two postures is the motion.
#[test]
fn the_motion_is_the_change_of_the_posture() {
    for rover in [rocker(), rocker_bogie()] {
        let terrain = ground(hills);
        let (place, yaw) = (Vec2::new(0.35, 0.2), 0.6);
        let posture = stand(&rover, &terrain, place, yaw);
        assert!(posture.wheels.iter().all(|wheel| wheel.gap.abs() < 1e-9));
        assert!(posture.joints.rocker.abs() > 0.02, "{:?}", posture.joints);
        let state =
            RoverState { velocity: Vec2::new(0.05, 0.02), yaw_rate: -0.1, ..RoverState::default() };
        let motion = posture.motion(&state).expect("it moves");
        let after = |time: f64| {
            let place = place + time * motion.velocity.xy();
            stand(&rover, &terrain, place, yaw + time * motion.yaw_rate)
        };
        let time = 1e-4;
        let (before, later) = (after(-time), after(time));
        let rate = (later.place - before.place) / (2.0 * time);
        // The hub follows the mean plane of its footprint, which turns under it: to first order of
        // its curvature.
        assert!(
            (rate - motion.velocity).norm() < 0.05 * motion.velocity.norm(),
            "{rate} {}",
            motion.velocity
        );
        for (place, wheel) in posture.wheels.iter().enumerate() {
            let hub = |it: &Posture| it.place + it.wheels[place].hub;
            let seen = (hub(&later) - hub(&before)) / (2.0 * time);
            let along = Vec2::new(seen.dot(&wheel.forward), seen.dot(&wheel.left));
            assert!(
                (along - motion.hubs[place]).norm() < 0.05 * 0.055,
                "{along} and {}",
                motion.hubs[place]
            );
        }
    }
}

fn forces(drawbar_pull: f64, side_force: f64, torque: f64) -> WheelForces {
    WheelForces { drawbar_pull, side_force, torque, ..WheelForces::default() }
}

/// Bogies with their axis in the middle: each wheel of a level rover with its centre of mass there
/// carries a sixth.
#[test]
fn a_level_rover_with_bogies_carries_a_sixth_on_each_wheel() {
    // With the rocker's axis a third of the way from the bogie's to the front wheel, below the
    // centre of mass.
    let first = rigid().mounts()[0].clone();
    let place = |x: f64, y: f64| Mount {
        name: format!("{x} {y}"),
        position: Vec3::new(x, y, first.position.z),
        ..first.clone()
    };
    let mounts = [(0.4, 0.3), (0.0, 0.3), (-0.4, 0.3), (0.4, -0.3), (0.0, -0.3), (-0.4, -0.3)];
    let rover =
        Rover::new(*rigid().body(), mounts.map(|(x, y)| place(x, y)).to_vec()).expect("it stands");
    let bogie = Bogie { pivot: Vec2::new(-0.2, 0.0), end: End::Rear };
    let rover = rover
        .on_rockers(Suspension { pivot: Vec2::new(0.0, 0.1), bogie: Some(bogie) })
        .expect("six");
    let terrain = ground(plane(0.0, 0.0));
    let posture = stand(&rover, &terrain, Vec2::zeros(), 0.0);
    let loads = COMPLETE.loads(&rover, &posture, 60.0 * Vec3::z(), &[]).expect("it stands");
    for load in &loads {
        close(*load, 10.0, 1e-9);
    }
    // A torque of 0.3 N·m of each wheel of a bogie loads the rear one by the sum over the bogie's
    // length.
    let torques = [0.0, 0.3, 0.3, 0.0, 0.3, 0.3].map(|torque| forces(0.0, 0.0, torque));
    let with = COMPLETE.loads(&rover, &posture, 60.0 * Vec3::z(), &torques).expect("it stands");
    close(with[2] - with[1], 2.0 * 0.6 / 0.4, 1e-9);
}

/// Rockers and a rigid body share alike on a plane where all wheels pull alike, and the axis is in
/// the middle.
#[test]
fn rockers_and_a_rigid_body_agree_on_a_plane_with_equal_torques() {
    let mut mounts = rigid().mounts().to_vec();
    for mount in &mut mounts {
        mount.position.x = 0.18 * mount.position.x.signum();
    }
    let rigid = Rover::new(*rigid().body(), mounts).expect("it stands");
    let rocker =
        rigid.on_rockers(Suspension { pivot: Vec2::new(0.0, 0.03), bogie: None }).expect("four");
    for (slope, yaw) in [(10.0, 0.0), (15.0, 0.4), (20.0, 1.5)] {
        let height = plane(deg(slope), deg(90.0));
        let terrain = ground(&height);
        let wheels = [forces(3.0, 2.0, 0.9); 4];
        let loads = |rover: &Rover, wheels: &[WheelForces]| {
            let posture = stand(rover, &terrain, Vec2::zeros(), yaw);
            COMPLETE.loads(rover, &posture, 60.0 * Vec3::z(), wheels).expect("it stands")
        };
        let (one, other) = (loads(&rigid, &wheels), loads(&rocker, &wheels));
        for (one, other) in one.iter().zip(&other) {
            close(*one, *other, 60.0 * 1e-9);
        }
        // They part by the difference of the sides' torques, which turns the rockers against each
        // other.
        let sides =
            rigid.mounts().iter().map(|mount| if mount.position.y > 0.0 { 0.5 } else { 1.3 });
        let uneven: Vec<WheelForces> = sides.map(|torque| forces(3.0, 2.0, torque)).collect();
        let (one, other) = (loads(&rigid, &uneven), loads(&rocker, &uneven));
        let rockers: Vec<f64> = one.iter().zip(&other).map(|(one, other)| other - one).collect();
        // About the axis the left side's moments equal the right side's: 4 ΔN · 0.18 = 2 (1.3 −
        // 0.5).
        for (mount, change) in rigid.mounts().iter().zip(&rockers) {
            let sense = mount.position.x.signum() * mount.position.y.signum();
            close(*change, sense * 2.0 * (1.3 - 0.5) / (4.0 * 2.0 * 0.18) * 2.0, 1e-9);
        }
    }
}

/// Forces and moments of every posture balance to rounding, and no freedom does work.
#[test]
fn every_posture_balances() {
    for rover in [rocker(), rocker_bogie()] {
        for step in 0..20 {
            let terrain = ground(hills);
            let (place, yaw) = (Vec2::new(0.1 * f64::from(step), 0.3), 0.3 * f64::from(step));
            let posture = stand(&rover, &terrain, place, yaw);
            let mut wheels: Vec<WheelForces> = (0..rover.wheel_count())
                .map(|wheel| {
                    forces(
                        1.0 + 0.3 * wheel as f64,
                        0.5 - 0.2 * wheel as f64,
                        0.2 + 0.05 * wheel as f64,
                    )
                })
                .collect();
            let weight = 70.0;
            let loads =
                COMPLETE.loads(&rover, &posture, weight * Vec3::z(), &wheels).expect("it stands");
            for (wheel, load) in wheels.iter_mut().zip(&loads) {
                wheel.normal_force = *load;
            }
            let all = COMPLETE.resultant(&rover, &posture, &wheels);
            let [.., z] = posture.axes();
            close(all.force.z, weight * z.z, 1e-8 * weight);
            let centre = posture.ground_from_body.inverse()
                * grouser_core::vehicle::statics::centre_of_mass(&rover, &posture);
            let about_centre = all.moment - centre.cross(&all.force);
            close(about_centre.x, 0.0, 1e-8 * weight);
            close(about_centre.y, 0.0, 1e-8 * weight);
        }
    }
}

/// A rover tips over its lower wheels where the slope's tangent is half the track over the centre's
/// height.
#[test]
fn it_tips_where_the_weight_falls_outside() {
    let rover = rocker();
    let track = 2.0 * rover.mounts().iter().map(|mount| mount.position.y).fold(0.0, f64::max);
    let limit = (0.5 * track / rover.centre_height()).atan();
    for (slope, stands) in [(limit - 1e-6, true), (limit + 1e-6, false)] {
        let height = plane(slope, deg(90.0));
        let terrain = ground(&height);
        let posture = stand(&rover, &terrain, Vec2::zeros(), 0.0);
        let weight = 60.0;
        // Side forces in the ground hold it.
        let side = -weight * slope.sin() / 4.0;
        let balance = Balance { own_moments: OwnMoments::Neglected, ..COMPLETE };
        let wheels = [forces(0.0, -side, 0.0); 4];
        let loads = balance.loads(&rover, &posture, weight * Vec3::z(), &wheels).expect("loads");
        let uphill: f64 = loads
            .iter()
            .zip(rover.mounts())
            .filter(|(_, mount)| mount.position.y > 0.0)
            .map(|(load, _)| load)
            .sum();
        assert_eq!(uphill > 0.0, stands, "{loads:?}");
    }
}

/// On twisted ground the soil decides how a rigid rover's four wheels share: their sinkages differ
/// by the twist, until one is lifted; rockers turn, and their wheels share as on a plane.
#[test]
fn twisted_ground_loads_a_rigid_rover_across_and_turns_rockers() {
    let scenario = paper::traverse().expect("it stands");
    let settled = |rover: &Rover, twist: f64| -> (Posture, Vec<WheelReaction>) {
        let terrain = ground(move |at: Vec2| twist * at.x * at.y);
        let terrain = Ground::own(scenario.ground.soil, terrain);
        let reaction = OnGround { rover, ground: &terrain, ..scenario.on_ground() };
        let posture = reaction.standing_posture(&RoverState::default()).expect("it stands");
        let slips = [Slip::on_test_stand(0.2, 0.0); 4];
        let wheels = reaction.reactions_standing(&posture, Vec3::z(), &slips, &[]);
        (posture, wheels.expect("it is carried"))
    };
    let weight = rigid().mass() * scenario.gravity;
    let (_, flat) = settled(&rigid(), 0.0);
    for (twist, lifts) in [(0.02, 0), (0.1, 0), (1.0, 1)] {
        let (posture, wheels) = settled(&rigid(), twist);
        let sum: f64 = wheels.iter().map(|wheel| wheel.load).sum();
        close(sum, weight, if twist < 0.5 { 2e-3 } else { 0.1 } * weight);
        assert_eq!(
            wheels.iter().filter(|wheel| wheel.load < 1e-9).count(),
            lifts,
            "{twist}: {wheels:?}"
        );
        let gaps: Vec<f64> = posture.wheels.iter().map(|wheel| wheel.gap).collect();
        let size = gaps.iter().map(|gap| gap * gap).sum::<f64>().sqrt();
        let differ: f64 = wheels
            .iter()
            .zip(&flat)
            .zip(&gaps)
            .map(|((one, other), gap)| gap / size * (one.settled.sinkage - other.settled.sinkage))
            .sum();
        if lifts == 0 {
            close(differ, -size, 0.02 * size);
        } else {
            assert!(-differ < 0.9 * size, "{differ} of {size}");
        }

        let (posture, wheels) = settled(&rocker(), twist);
        assert!(posture.wheels.iter().all(|wheel| wheel.gap.abs() < 1e-9));
        assert!(posture.joints.rocker.abs() > 0.2 * twist, "{:?}", posture.joints);
        if twist < 0.5 {
            for (wheel, flat) in wheels.iter().zip(&flat) {
                close(wheel.load, flat.load, 0.1 * flat.load);
            }
        }
    }
}
