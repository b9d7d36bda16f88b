//! The parts of a binary glTF file: numbers, meshes, nodes and motions.

use grouser_core::units::Vec3;
use grouser_core::wheel::Wheel;
use serde_json::{Value, json};

use super::solid::{Solid, wheel_solids};
use crate::style::{Ground, Role};

/// Kinds of numbers and uses of buffers, by their codes in the format.
const FLOAT: u32 = 5126;
const UNSIGNED: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// The parts of the file.
pub(super) struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Role>,
    nodes: Vec<Value>,
    samplers: Vec<Value>,
    channels: Vec<Value>,
}

impl File {
    pub(super) fn new() -> Self {
        Self {
            bytes: Vec::new(),
            views: Vec::new(),
            accessors: Vec::new(),
            meshes: Vec::new(),
            materials: Vec::new(),
            nodes: Vec::new(),
            samplers: Vec::new(),
            channels: Vec::new(),
        }
    }

    pub(super) fn node(&mut self, node: Value) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    fn material(&mut self, role: Role) -> usize {
        let known = self.materials.iter().position(|other| *other == role);
        known.unwrap_or_else(|| {
            self.materials.push(role);
            self.materials.len() - 1
        })
    }

    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        let mut view = json!({
            "buffer": 0,
            "byteOffset": self.bytes.len(),
            "byteLength": bytes.len(),
        });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.bytes.extend_from_slice(bytes);
        self.views.push(view);
        self.views.len() - 1
    }

    /// Numbers of a shape, such as `VEC3`; returns their accessor.
    ///
    /// * `has_range`: whether least and largest are listed
    #[expect(clippy::cast_possible_truncation)]
    pub(super) fn numbers(
        &mut self,
        shape: &str,
        values: &[f64],
        has_range: bool,
        target: Option<u32>,
    ) -> usize {
        let size = match shape {
            "VEC3" => 3,
            "VEC4" => 4,
            _ => 1,
        };
        let values: Vec<f32> = values.iter().map(|value| *value as f32).collect();
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let view = self.view(&bytes, target);
        let mut accessor = json!({
            "bufferView": view,
            "componentType": FLOAT,
            "count": values.len() / size,
            "type": shape,
        });
        if has_range {
            let end = |pick: fn(f32, f32) -> f32, start: f32| -> Vec<f32> {
                let part = |k: usize| values[k..].iter().step_by(size).copied().fold(start, pick);
                (0..size).map(part).collect()
            };
            accessor["min"] = json!(end(f32::min, f32::INFINITY));
            accessor["max"] = json!(end(f32::max, f32::NEG_INFINITY));
        }
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn primitive(&mut self, solid: &Solid, role: Role) -> Value {
        let flat = |vectors: &[Vec3]| -> Vec<f64> {
            vectors.iter().flat_map(|vector| [vector.x, vector.y, vector.z]).collect()
        };
        let places = self.numbers("VEC3", &flat(&solid.places), true, Some(VERTICES));
        let normals = self.numbers("VEC3", &flat(&solid.normals), false, Some(VERTICES));
        let bytes: Vec<u8> = solid.triangles.iter().flat_map(|index| index.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(INDICES));
        self.accessors.push(json!({
            "bufferView": view,
            "componentType": UNSIGNED,
            "count": solid.triangles.len(),
            "type": "SCALAR",
        }));
        json!({
            "attributes": { "POSITION": places, "NORMAL": normals },
            "indices": self.accessors.len() - 1,
            "material": self.material(role),
        })
    }

    pub(super) fn mesh(&mut self, name: &str, solid: &Solid, role: Role) -> usize {
        let primitive = self.primitive(solid, role);
        self.meshes.push(json!({ "name": name, "primitives": [primitive] }));
        self.meshes.len() - 1
    }

    pub(super) fn wheel(&mut self, wheel: &Wheel) -> usize {
        let [rim, bars] = wheel_solids(wheel);
        let primitives = [self.primitive(&rim, Role::Wheel), self.primitive(&bars, Role::Grouser)];
        self.meshes.push(json!({ "name": "wheel", "primitives": primitives }));
        self.meshes.len() - 1
    }

    pub(super) fn lines(&mut self, name: &str, ends: &[Vec3], role: Role) -> usize {
        let flat: Vec<f64> = ends.iter().flat_map(|end| [end.x, end.y, end.z]).collect();
        let places = self.numbers("VEC3", &flat, true, Some(VERTICES));
        let material = self.material(role);
        let primitive =
            json!({ "attributes": { "POSITION": places }, "mode": 1, "material": material });
        self.meshes.push(json!({ "name": name, "primitives": [primitive] }));
        self.meshes.len() - 1
    }

    pub(super) fn channel(
        &mut self,
        node: usize,
        path: &str,
        ends: [usize; 2],
        interpolation: &str,
    ) {
        self.samplers.push(json!({
            "input": ends[0],
            "output": ends[1],
            "interpolation": interpolation,
        }));
        self.channels.push(json!({
            "sampler": self.samplers.len() - 1,
            "target": { "node": node, "path": path },
        }));
    }

    pub(super) fn finish(mut self, root: usize, title: &str, extras: &Value) -> Vec<u8> {
        let document = json!({
            "asset": { "version": "2.0", "generator": "Grouser" },
            "scene": 0,
            "scenes": [{ "name": title, "nodes": [root] }],
            "nodes": self.nodes,
            "meshes": self.meshes,
            "materials": self.materials.iter().map(|role| material(*role)).collect::<Vec<_>>(),
            "animations": [{
                "name": "run",
                "samplers": self.samplers,
                "channels": self.channels,
                "extras": extras,
            }],
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{ "byteLength": self.bytes.len() }],
        });
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let length = |count: usize| u32::try_from(count).unwrap_or(u32::MAX).to_le_bytes();
        let mut file = Vec::with_capacity(28 + text.len() + self.bytes.len());
        file.extend(*b"glTF");
        file.extend(2_u32.to_le_bytes());
        file.extend(length(28 + text.len() + self.bytes.len()));
        for (kind, chunk) in [(*b"JSON", &text), (*b"BIN\0", &self.bytes)] {
            file.extend(length(chunk.len()));
            file.extend(kind);
            file.extend(chunk);
        }
        file
    }
}

fn material(role: Role) -> Value {
    // The format has the light's strength, of which a screen's colour is the root.
    let [red, green, blue] = role.on(Ground::Light).parts().map(|part| part * part);
    json!({
        "name": format!("{role:?}").to_lowercase(),
        "doubleSided": true,
        "pbrMetallicRoughness": {
            "baseColorFactor": [red, green, blue, 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": 0.9,
        },
    })
}
