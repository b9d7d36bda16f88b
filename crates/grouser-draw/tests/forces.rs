//! The arrows of a scene in three dimensions are the forces of the soil: those of the records, and
//! where nothing speeds up all of them together carry the rover.

mod gltf;

use std::f64::consts::FRAC_PI_2;

use grouser::document::{LoadedScenario, Overrides, Source, read_scenario};
use grouser::simulation::{Run, Trajectory};
use grouser::units::Vec3;
use grouser_draw::{Animation, Shown, newtons_per_metre};
use serde_json::{Value, json};

use gltf::{chunks, number, numbers};

/// A scene, node by node.
struct Scene<'f> {
    document: Value,
    bytes: &'f [u8],
}

/// A point or a direction turned by a quaternion: x, y, z and w.
fn turned([x, y, z, w]: [f64; 4], vector: Vec3) -> Vec3 {
    let axis = Vec3::new(x, y, z);
    let across = 2.0 * axis.cross(&vector);
    vector + w * across + axis.cross(&across)
}

impl<'f> Scene<'f> {
    fn of(file: &'f [u8]) -> Self {
        let (document, bytes) = chunks(file);
        Self { document, bytes }
    }

    fn nodes(&self) -> &[Value] {
        self.document["nodes"].as_array().expect("nodes")
    }

    /// The arrows' places among the nodes, in the wheels' order.
    fn arrows(&self) -> Vec<usize> {
        let is = |it: &usize| {
            self.nodes()[*it]["name"].as_str().is_some_and(|name| name.starts_with("force "))
        };
        (0..self.nodes().len()).filter(is).collect()
    }

    /// What a node has of a path at a time of the animation [s].
    fn at<const N: usize>(&self, node: usize, path: &str, time: f64, usual: [f64; N]) -> [f64; N] {
        let motion = &self.document["animations"][0];
        let target = json!({ "node": node, "path": path });
        let mut channels = motion["channels"].as_array().expect("channels").iter();
        let Some(channel) = channels.find(|it| it["target"] == target) else {
            let still = self.nodes()[node].get(path);
            let part = |at: usize| still.map_or(usual[at], |it| it[at].as_f64().expect("a number"));
            return std::array::from_fn(part);
        };
        let sampler = &motion["samplers"][number(&channel["sampler"])];
        let (times, _) = numbers(&self.document, self.bytes, number(&sampler["input"]));
        let (values, _) = numbers(&self.document, self.bytes, number(&sampler["output"]));
        let place = times.iter().position(|at| (f64::from(*at) - time).abs() < 1e-5);
        let place = place.expect("a sample at this time");
        std::array::from_fn(|at| f64::from(values[N * place + at]))
    }

    /// A point of a node, in the scene.
    fn in_scene(&self, node: usize, point: Vec3, time: f64) -> Vec3 {
        let size = Vec3::from(self.at(node, "scale", time, [1.0; 3])).component_mul(&point);
        let about = self.at(node, "rotation", time, [0.0, 0.0, 0.0, 1.0]);
        let here = turned(about, size) + Vec3::from(self.at(node, "translation", time, [0.0; 3]));
        let has =
            |it: &Value| it["children"].as_array().is_some_and(|all| all.contains(&json!(node)));
        match self.nodes().iter().position(has) {
            Some(above) => self.in_scene(above, here, time),
            None => here,
        }
    }

    /// Where an arrow begins, and the force that it stands for [N].
    fn force(&self, arrow: usize, time: f64) -> (Vec3, Vec3) {
        let extras = &self.document["animations"][0]["extras"];
        let scale = extras["newtons_per_metre"].as_f64().expect("a scale");
        let ends = [Vec3::zeros(), Vec3::z()].map(|point| self.in_scene(arrow, point, time));
        (ends[0], scale * (ends[1] - ends[0]))
    }
}

fn run(text: &str, settings: &[&str]) -> (LoadedScenario, Trajectory) {
    let text = format!("schema = \"scenario/1\"\nname = \"s\"\n{text}");
    let overrides = Overrides::parse(settings.iter().copied()).expect("good settings");
    let scenario = read_scenario(&Source::text("s", text), &overrides).expect("a scenario");
    let run = Run::new(&scenario.value).expect("a run").to_end().expect("an end");
    (scenario, run)
}

fn glb(runs: &[&(LoadedScenario, Trajectory)]) -> Vec<u8> {
    let shown =
        runs.iter().map(|(scenario, run)| Shown { name: "rover", run, scenario: &scenario.value });
    let shown: Vec<Shown<'_>> = shown.collect();
    Animation::of("Forces", &shown).to_glb()
}

/// Records of a plane: an arrow is the force of the wheel's frame, turned by its steering and the
/// yaw, on a slope.
#[test]
fn an_arrow_is_the_force_of_its_record() {
    for rover in ["hakuto", "hakuto-steered"] {
        let driven = run(
            "duration_s = 2",
            &[
                &format!("scenario.rover={rover}"),
                "scenario.slope_deg=12",
                "scenario.start.yaw_deg=25",
            ],
        );
        let (scenario, trajectory) = &driven;
        let file = glb(&[&driven]);
        let scene = Scene::of(&file);
        let upright = 0.5 * (12_f64.to_radians() - FRAC_PI_2);
        let root = [upright.sin(), 0.0, 0.0, upright.cos()];
        let arrows = scene.arrows();
        assert_eq!(arrows.len(), scenario.value.rover.wheel_count());
        for record in &trajectory.records {
            for (arrow, wheel) in arrows.iter().zip(&record.wheels) {
                let forces = &wheel.reaction.settled.forces;
                let (sin, cos) = (record.state.yaw + wheel.steering).sin_cos();
                let [pull, side] = [forces.drawbar_pull, forces.side_force];
                let level = [cos * pull - sin * side, sin * pull + cos * side];
                let expected = Vec3::new(level[0], level[1], forces.normal_force);
                let (tail, force) = scene.force(*arrow, record.time);
                let apart = (force - turned(root, expected)).norm();
                assert!(apart < 1e-5 * expected.norm(), "{rover}: {force} at {}", record.time);
                // It begins on the surface.
                let height = turned(root, Vec3::z()).dot(&tail);
                assert!(height.abs() < 1e-6, "{rover}: {height}");
            }
        }
    }
}

/// Where the motion is steady the soil carries the weight, under stiff rovers and on rockers: all
/// arrows together are as large as it and point straight up, over heights to half a per cent. In
/// the frames of the axles, which lean against the ground, they would be 1.6 % off for HAKUTO.
#[test]
fn arrows_together_carry_the_weight() {
    let ripples = "[terrain]\nsurface = \"ripple\"\namplitude_m = 0.03\nwavelength_m = 1.0";
    for (rover, ground, within) in [
        ("hakuto", "slope_deg = 10.0", 1e-3),
        ("hakuto", ripples, 5e-3),
        ("hakuto-rockers", ripples, 5e-3),
        ("spirit", ripples, 5e-3),
    ] {
        let text = format!("simulation = \"quasi-steady\"\nduration_s = 3\n{ground}");
        let set = [&*format!("scenario.rover={rover}"), "scenario.start.yaw_deg=30"];
        let driven = run(&text, &set);
        let (scenario, trajectory) = &driven;
        let weight = scenario.value.rover.mass() * scenario.value.gravity;
        let file = glb(&[&driven]);
        let scene = Scene::of(&file);
        let end = trajectory.last().time;
        let all = scene.arrows().into_iter().map(|arrow| scene.force(arrow, end).1);
        let sum = all.fold(Vec3::zeros(), |sum, force| sum + force);
        // The scene's y axis points up.
        let apart = (sum - weight * Vec3::y()).norm();
        assert!(apart < within * weight, "{rover} over {ground}: {sum} of {weight} N");
    }
}

/// Rovers beside each other have one scale: that of the heaviest for its wheels.
#[test]
fn arrows_of_several_rovers_have_one_scale() {
    let light = run("duration_s = 1", &[]);
    let heavy = run("duration_s = 1", &["scenario.rover=curiosity"]);
    let file = glb(&[&light, &heavy]);
    let scene = Scene::of(&file);
    let arrows = scene.arrows();
    assert_eq!(arrows.len(), 4 + heavy.0.value.rover.wheel_count());
    let largest = newtons_per_metre(&heavy.0.value);
    assert!(largest > newtons_per_metre(&light.0.value));
    let end = light.1.last().time;
    let wheel = &light.1.last().wheels[0].reaction.settled.forces;
    let size = wheel.drawbar_pull.hypot(wheel.side_force).hypot(wheel.normal_force);
    let (_, force) = scene.force(arrows[0], end);
    assert!((force.norm() - size).abs() < 1e-5 * size, "{force} of {size} N");
}

/// A rover that tips over has no forces any more: its arrows have no size.
#[test]
fn a_rover_that_tips_over_has_no_arrows() {
    let driven = run("slope_deg = 60.0", &[]);
    let file = glb(&[&driven]);
    let scene = Scene::of(&file);
    let end = driven.1.last();
    assert!(end.wheels.is_empty());
    for arrow in scene.arrows() {
        assert!(scene.force(arrow, end.time).1.norm() == 0.0);
    }
}
