//! The numbers of documents by their dotted keys, to be given other values quickly.
//!
//! A campaign gives a few numbers new values for every run, a million times over. Going by way of a
//! TOML tree takes longer than some of the studies; here a key leads straight to the field. The
//! fields are named a second time for that; a test finds any that is forgotten.

use super::super::Reference;
use super::super::rover::{InertiaSection, RoverDocument};
use super::super::scenario::{ConstantSection, DriveSection, ScenarioDocument, Speeds};
use super::super::soil::{
    ExitSection, ExtendedSection, PressureSinkageSection, RftSection, ShearSection, SoilDocument,
};
use super::super::wheel::WheelDocument;
use super::sections::WheelTestSection;

/// A part of a document that has numbers.
pub(super) trait Numbers {
    /// The number under a dotted key, entries of lists by their place; `None` if there is none.
    fn number_mut(&mut self, key: &str) -> Option<&mut f64>;
}

/// The first step of a key, and the rest.
fn step(key: &str) -> (&str, &str) {
    key.split_once('.').unwrap_or((key, ""))
}

impl<D: Numbers> Numbers for Reference<D> {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match self {
            Self::Inline(document) => document.number_mut(key),
            Self::Named(_) => None,
        }
    }
}

impl Numbers for ScenarioDocument {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match step(key) {
            ("rover", rest) => self.rover.number_mut(rest),
            ("soil", rest) => self.soil.number_mut(rest),
            ("drive", rest) => self.drive.number_mut(rest),
            ("start", "yaw_deg") => Some(&mut self.start.yaw_deg),
            ("gravity_m_s2", "") => Some(&mut self.gravity_m_s2),
            ("slope_deg", "") => Some(&mut self.slope_deg),
            ("duration_s", "") => Some(&mut self.duration_s),
            ("sample_interval_s", "") => Some(&mut self.sample_interval_s),
            _ => None,
        }
    }
}

impl Numbers for WheelTestSection {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match step(key) {
            ("soil", rest) => self.soil.number_mut(rest),
            ("wheel", rest) => self.wheel.number_mut(rest),
            ("gravity_m_s2", "") => Some(&mut self.gravity_m_s2),
            ("load_n", "") => Some(&mut self.load_n),
            ("slip_ratio", "") => Some(&mut self.slip_ratio),
            ("slip_angle_deg", "") => Some(&mut self.slip_angle_deg),
            _ => None,
        }
    }
}

impl Numbers for DriveSection {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match (self, step(key)) {
            (Self::Constant(ConstantSection { speed_m_s, .. }), ("speed_m_s", rest)) => {
                match speed_m_s {
                    Speeds::All(speed) => rest.is_empty().then_some(speed),
                    Speeds::Each(speeds) => speeds.get_mut(rest.parse::<usize>().ok()?),
                }
            }
            (Self::Eq18AsPrinted(section), ("speed_m_s", "")) => Some(&mut section.speed_m_s),
            (Self::Eq18AsPrinted(section), ("reference_slip_ratio", "")) => {
                Some(&mut section.reference_slip_ratio)
            }
            (Self::Eq18(section), ("speed_m_s", "")) => Some(&mut section.speed_m_s),
            (Self::Eq18(section), ("reference_slip_ratio", "")) => {
                Some(&mut section.reference_slip_ratio)
            }
            _ => None,
        }
    }
}

impl Numbers for RoverDocument {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match step(key) {
            ("body", "mass_kg") => Some(&mut self.body.mass_kg),
            ("body", rest) => inertia(&mut self.body.inertia_kg_m2, rest),
            ("wheel_unit", "mass_kg") => Some(&mut self.wheel_unit.mass_kg),
            ("wheel_unit", rest) => match step(rest) {
                ("wheel", rest) => self.wheel_unit.wheel.number_mut(rest),
                _ => inertia(&mut self.wheel_unit.inertia_kg_m2, rest),
            },
            ("mount", rest) => {
                let (place, rest) = step(rest);
                let mount = self.mount.get_mut(place.parse::<usize>().ok()?)?;
                let axis = rest.strip_prefix("position_m.")?;
                mount.position_m.get_mut(axis.parse::<usize>().ok()?)
            }
            _ => None,
        }
    }
}

fn inertia<'i>(inertia: &'i mut InertiaSection, key: &str) -> Option<&'i mut f64> {
    match key {
        "inertia_kg_m2.xx" => Some(&mut inertia.xx),
        "inertia_kg_m2.yy" => Some(&mut inertia.yy),
        "inertia_kg_m2.zz" => Some(&mut inertia.zz),
        _ => None,
    }
}

impl Numbers for WheelDocument {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "radius_m" => Some(&mut self.radius_m),
            "width_m" => Some(&mut self.width_m),
            "grousers.height_m" => Some(&mut self.grousers.as_mut()?.height_m),
            _ => None,
        }
    }
}

impl Numbers for SoilDocument {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match step(key) {
            ("cohesion_kpa", "") => Some(&mut self.cohesion_kpa),
            ("friction_angle_deg", "") => Some(&mut self.friction_angle_deg),
            ("density_kg_m3", "") => Some(&mut self.density_kg_m3),
            ("pressure_sinkage", rest) => self.pressure_sinkage.number_mut(rest),
            ("stress_peak", "a0") => Some(&mut self.stress_peak.a0),
            ("stress_peak", "a1") => Some(&mut self.stress_peak.a1),
            ("shear", rest) => self.shear.number_mut(rest),
            ("exit", rest) => self.exit.number_mut(rest),
            ("extended", rest) => self.extended.as_mut()?.number_mut(rest),
            ("rft", rest) => self.rft.as_mut()?.number_mut(rest),
            _ => None,
        }
    }
}

impl Numbers for PressureSinkageSection {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        let (Self::Reece { k_c, k_phi, n, n_per_slip, n_per_skid }
        | Self::Bekker { k_c, k_phi, n, n_per_slip, n_per_skid }) = self;
        match key {
            "k_c" => Some(k_c),
            "k_phi" => Some(k_phi),
            "n" => Some(n),
            "n_per_slip" => Some(n_per_slip),
            "n_per_skid" => Some(n_per_skid),
            _ => None,
        }
    }
}

impl Numbers for ShearSection {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match (self, key) {
            (
                Self::Anisotropic { longitudinal_m: modulus, .. }
                | Self::AnisotropicQuadratic { longitudinal_m: modulus, .. }
                | Self::Isotropic { longitudinal_m: modulus, .. },
                "longitudinal_m",
            )
            | (
                Self::Anisotropic { longitudinal_per_rad_m: modulus, .. }
                | Self::AnisotropicQuadratic { longitudinal_per_rad_m: modulus, .. }
                | Self::Isotropic { longitudinal_per_rad_m: modulus, .. },
                "longitudinal_per_rad_m",
            )
            | (
                Self::Anisotropic { lateral_m: modulus, .. }
                | Self::AnisotropicQuadratic { lateral_m: modulus, .. },
                "lateral_m",
            )
            | (
                Self::Anisotropic { lateral_per_rad_m: modulus, .. }
                | Self::AnisotropicQuadratic { lateral_per_rad_m: modulus, .. },
                "lateral_per_rad_m",
            )
            | (
                Self::AnisotropicQuadratic { longitudinal_per_rad2_m: modulus, .. },
                "longitudinal_per_rad2_m",
            )
            | (
                Self::AnisotropicQuadratic { lateral_per_rad2_m: modulus, .. },
                "lateral_per_rad2_m",
            )
            | (
                Self::AnisotropicQuadratic { slip_angle_limit_deg: modulus, .. },
                "slip_angle_limit_deg",
            ) => Some(modulus),
            _ => None,
        }
    }
}

impl Numbers for ExitSection {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match (self, key) {
            (Self::Ratio(section), "ratio") => Some(&mut section.ratio),
            (Self::QuadraticInSlip(section), "at_zero") => Some(&mut section.at_zero),
            (Self::QuadraticInSlip(section), "per_slip") => Some(&mut section.per_slip),
            (Self::QuadraticInSlip(section), "per_slip2") => Some(&mut section.per_slip2),
            _ => None,
        }
    }
}

impl Numbers for ExtendedSection {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "sinkage.with_slip_angle" => Some(&mut self.sinkage.with_slip_angle),
            "sinkage.with_slip" => Some(&mut self.sinkage.with_slip),
            "sinkage.bend" => Some(&mut self.sinkage.bend),
            "sinkage.locked" => Some(&mut self.sinkage.locked),
            "sinkage.sharpness" => Some(&mut self.sinkage.sharpness),
            "exit.with_slip" => Some(&mut self.exit.with_slip),
            "exit.with_slip_angle" => Some(&mut self.exit.with_slip_angle),
            "rim.friction_angle_deg" => self.rim.friction_angle_deg.as_mut(),
            "flank.pressure_factor" => Some(&mut self.flank.pressure_factor),
            "flank.fading" => Some(&mut self.flank.fading),
            "flank.friction" => Some(&mut self.flank.friction),
            "heap.front" => Some(&mut self.heap.front),
            "heap.behind" => Some(&mut self.heap.behind),
            _ => None,
        }
    }
}

impl Numbers for RftSection {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "scale" => Some(&mut self.scale),
            "surface_friction_angle_deg" => self.surface_friction_angle_deg.as_mut(),
            _ => None,
        }
    }
}

/// The dotted keys of all numbers of a tree, entries of lists by their place.
pub(super) fn number_keys(tree: &toml::Value) -> Vec<String> {
    let children: Vec<(String, &toml::Value)> = match tree {
        toml::Value::Table(table) => table.iter().map(|(key, node)| (key.clone(), node)).collect(),
        toml::Value::Array(list) => {
            list.iter().enumerate().map(|(place, node)| (place.to_string(), node)).collect()
        }
        _ => Vec::new(),
    };
    let keys = children.into_iter().flat_map(|(key, node)| match node {
        toml::Value::Float(_) => vec![key],
        node => number_keys(node).into_iter().map(|inner| format!("{key}.{inner}")).collect(),
    });
    keys.collect()
}

#[cfg(test)]
mod tests {
    use serde::Serialize;
    use serde::de::DeserializeOwned;

    use super::*;
    use crate::document::{Kind, Overrides, Source, presets, read_scenario, read_soil};

    /// That every number of a document is reached by its key, and no other is changed by it.
    fn check_numbers<D: Numbers + Serialize + DeserializeOwned + Clone>(document: &D) -> usize {
        let tree = |document: &D| toml::Value::try_from(document).expect("a table");
        let at = |tree: &toml::Value, key: &str| {
            key.split('.').fold(tree.clone(), |node, step| match step.parse::<usize>() {
                Ok(place) => node[place].clone(),
                Err(_) => node[step].clone(),
            })
        };
        let before = tree(document);
        let keys = number_keys(&before);
        for key in &keys {
            let mut changed = document.clone();
            let number = changed.number_mut(key).unwrap_or_else(|| panic!("{key} is forgotten"));
            assert_eq!(Some(*number), at(&before, key).as_float(), "{key}");
            *number += 1.0;
            let after = tree(&changed);
            for other in &keys {
                let differs = at(&before, other) != at(&after, other);
                assert_eq!(differs, key == other, "{key} changes {other}");
            }
        }
        keys.len()
    }

    #[test]
    fn every_number_of_the_presets_is_reached_by_its_key() {
        let mut count = 0;
        for preset in presets(Kind::Soil) {
            let loaded = read_soil(&Source::Preset(preset), &Overrides::none()).expect("a preset");
            let mut soil = loaded.document;
            soil.uncertainty = None;
            count += check_numbers(&soil);
        }
        for preset in presets(Kind::Scenario) {
            let source = Source::Preset(preset);
            let loaded = read_scenario(&source, &Overrides::none()).expect("a preset");
            count += check_numbers(&loaded.document);
        }
        assert!(count > 500, "{count}");
    }
}
