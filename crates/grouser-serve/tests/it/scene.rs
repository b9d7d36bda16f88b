//! Runs in three dimensions: the engine's scene comes along where it is asked for, and what shows
//! it is served.

use grouser_draw::from_base64;
use serde_json::{Value, json};

use crate::served::Served;

/// A scene as its description and its numbers.
struct Scene {
    description: Value,
    numbers: Vec<u8>,
}

impl Scene {
    /// * `text`: binary glTF in base64
    fn of(text: &Value) -> Self {
        let bytes = from_base64(text.as_str().unwrap()).unwrap();
        assert_eq!(bytes[..4], *b"glTF");
        let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
        let description = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
        Self { description, numbers: bytes[28 + length..].to_vec() }
    }

    fn list(&self, name: &str) -> &[Value] {
        self.description[name].as_array().unwrap()
    }

    /// The places of the nodes whose names end so.
    fn nodes(&self, end: &str) -> Vec<usize> {
        let is = |node: &Value| node["name"].as_str().is_some_and(|name| name.ends_with(end));
        (0..self.list("nodes").len()).filter(|place| is(&self.list("nodes")[*place])).collect()
    }

    /// Where a node is at the end [m].
    fn end_of(&self, node: usize) -> [f64; 3] {
        let animation = &self.list("animations")[0];
        let channels = animation["channels"].as_array().unwrap();
        let target = json!({"node": node, "path": "translation"});
        let channel = channels.iter().find(|it| it["target"] == target).unwrap();
        let place = |value: &Value| usize::try_from(value.as_u64().unwrap()).unwrap();
        let sampler = &animation["samplers"][place(&channel["sampler"])];
        let accessor = &self.list("accessors")[place(&sampler["output"])];
        let view = &self.list("bufferViews")[place(&accessor["bufferView"])];
        let end = place(&view["byteOffset"]) + 12 * place(&accessor["count"]);
        [12, 8, 4].map(|back| {
            let bytes = self.numbers[end - back..][..4].try_into().unwrap();
            f64::from(f32::from_le_bytes(bytes))
        })
    }
}

/// The tolerance is that of single precision at a metre.
fn check_end(lines: &[Value], run: &Value, axes: &[(&str, usize)], wheels: usize) {
    let scene = Scene::of(&lines[1]["scene"]);
    assert_eq!(scene.nodes(" wheel").len(), wheels);
    let end = scene.end_of(scene.nodes("rover")[0]);
    for (column, axis) in axes {
        let expected = run[column].as_f64().unwrap();
        assert!((end[*axis] - expected).abs() < 1e-6, "{column}: {} and {expected}", end[*axis]);
    }
}

#[test]
fn a_run_comes_in_three_dimensions_with_its_wheels_and_ends_there() {
    let server = Served::usual();
    let asked = json!({"soil": "toyoura", "slope_deg": 12, "duration_s": 3, "scene": true});
    let lines = server.post("traverse", &asked).lines();
    check_end(&lines, &lines[0]["final"], &[("x_m", 0), ("y_m", 1)], 4);
    // The same question gives the same scene, and none where none is asked for.
    assert_eq!(server.post("traverse", &asked).lines(), lines);
    let plain = json!({"soil": "toyoura", "slope_deg": 12, "duration_s": 3, "shown": true});
    let plain = server.post("traverse", &plain).lines();
    assert_eq!(plain[0], lines[0]);
    assert!(plain[1].get("scene").is_none());
}

#[test]
fn a_mission_comes_in_three_dimensions_too() {
    let server = Served::usual();
    let asked = json!({"mission": "there-and-back", "scene": true});
    let lines = server.post("mission", &asked).lines();
    let samples = lines[1]["run"]["samples"].as_array().unwrap();
    let last = samples.last().unwrap();
    let wheels = last["wheels"].as_array().unwrap().len();
    check_end(&lines, last, &[("x_m", 0), ("y_m", 1)], wheels);
}

#[test]
fn what_has_no_scene_refuses_it() {
    let server = Served::usual();
    for (question, asked, words) in [
        ("heading", json!({"scene": true}), "no such key"),
        ("traverse", json!({"scene": 3}), "it must be true or false"),
    ] {
        let reply = server.post(question, &asked);
        assert_eq!(reply.status, 422, "{reply:?}");
        let error = reply.lines().remove(0);
        assert_eq!(error["key"], "scene");
        assert!(error["error"].as_str().unwrap().contains(words), "{error}");
    }
}

#[test]
fn what_shows_scenes_is_served_with_its_licence() {
    let server = Served::usual();
    for (path, kind) in [
        ("/scene.js", "text/javascript"),
        ("/three/build/three.core.js", "text/javascript"),
        ("/three/build/three.module.js", "text/javascript"),
        ("/three/examples/jsm/loaders/GLTFLoader.js", "text/javascript"),
        ("/three/LICENSE", "text/plain"),
    ] {
        let reply = server.ask("GET", path, "", "");
        assert_eq!(reply.status, 200, "{path}");
        assert!(reply.head.contains(&format!("content-type: {kind}")), "{path}: {}", reply.head);
    }
    assert!(server.ask("GET", "/three/LICENSE", "", "").body.contains("The MIT License"));
    assert_eq!(server.ask("GET", "/three/package.json", "", "").status, 404);
}
