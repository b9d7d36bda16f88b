//! The parts of GeoJSON that zones need, as they stand in the text.
//!
//! What is not needed is passed over. Lists are read into as little memory as they can have, and no
//! deeper than the parser goes; numbers of features are bounded.

use std::fmt;

use grouser_core::units::Vec2;
use serde::de::{Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, de};

use crate::zones::key::ZoneKey;

/// Features of a file, at most.
const MOST_FEATURES: usize = 100_000;

/// The outermost object.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Root {
    #[serde(rename = "type")]
    pub(super) kind: String,
    #[serde(deserialize_with = "features")]
    pub(super) features: Vec<Feature>,
    pub(super) geometry: Option<Geometry>,
    pub(super) properties: Option<Properties>,
    /// Coordinates of a geometry that stands by itself.
    pub(super) coordinates: Coordinates,
    crs: Option<System>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Feature {
    pub(super) geometry: Option<Geometry>,
    pub(super) properties: Option<Properties>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Geometry {
    #[serde(rename = "type")]
    pub(super) kind: String,
    pub(super) coordinates: Coordinates,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Properties {
    pub(super) soil: Option<Soil>,
}

/// The coordinate system as older files name it.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct System {
    properties: Option<SystemProperties>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct SystemProperties {
    name: Option<String>,
}

impl Root {
    /// The name of the coordinate system, if the file has one.
    pub(super) fn system(&self) -> Option<&str> {
        self.crs.as_ref()?.properties.as_ref()?.name.as_deref()
    }
}

/// What the property of a soil is.
#[derive(Debug)]
pub(super) enum Soil {
    Key(ZoneKey),
    Other,
}

/// Coordinates of any depth.
#[derive(Debug)]
pub(super) enum Coordinates {
    Place(Vec2),
    List(Vec<Self>),
}

impl Default for Coordinates {
    fn default() -> Self {
        Self::List(Vec::new())
    }
}

impl Coordinates {
    /// * `of`: what it should be a list of
    pub(super) fn list(self, of: &str) -> Result<Vec<Self>, String> {
        match self {
            Self::List(list) => Ok(list),
            Self::Place(at) => Err(format!(
                "where a list of {of} is expected there is a place, {}, {}",
                at.x, at.y
            )),
        }
    }

    pub(super) fn place(self) -> Result<Vec2, String> {
        match self {
            Self::Place(at) => Ok(at),
            Self::List(_) => Err("where a place is expected there is a list".to_owned()),
        }
    }
}

fn features<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Feature>, D::Error> {
    struct Features;
    impl<'de> Visitor<'de> for Features {
        type Value = Vec<Feature>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            write!(f, "a list of at most {MOST_FEATURES} features")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
            let mut features = Vec::new();
            while let Some(feature) = list.next_element()? {
                if features.len() == MOST_FEATURES {
                    return Err(A::Error::invalid_length(MOST_FEATURES + 1, &self));
                }
                features.push(feature);
            }
            Ok(features)
        }
    }
    deserializer.deserialize_seq(Features)
}

impl<'de> Deserialize<'de> for Soil {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SoilVisitor)
    }
}

struct SoilVisitor;

impl<'de> Visitor<'de> for SoilVisitor {
    type Value = Soil;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a text or a whole number")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Soil, E> {
        Ok(Soil::Key(ZoneKey::Name(name.to_owned())))
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<Soil, E> {
        Ok(Soil::Key(ZoneKey::Class(number)))
    }

    fn visit_u64<E: de::Error>(self, number: u64) -> Result<Soil, E> {
        Ok(i64::try_from(number).map_or(Soil::Other, |number| Soil::Key(ZoneKey::Class(number))))
    }

    /// Some writers have no other numbers.
    #[expect(clippy::cast_possible_truncation, reason = "whole, and far from the largest")]
    fn visit_f64<E: de::Error>(self, number: f64) -> Result<Soil, E> {
        let is_whole = number.fract() == 0.0 && number.abs() < 9e15;
        Ok(if is_whole { Soil::Key(ZoneKey::Class(number as i64)) } else { Soil::Other })
    }

    fn visit_bool<E: de::Error>(self, _: bool) -> Result<Soil, E> {
        Ok(Soil::Other)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Soil, A::Error> {
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Ok(Soil::Other)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Soil, A::Error> {
        while map.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
        Ok(Soil::Other)
    }
}

/// An element of a list of coordinates.
enum Element {
    Number(f64),
    Coordinates(Coordinates),
}

impl<'de> Deserialize<'de> for Coordinates {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match deserializer.deserialize_any(ElementVisitor)? {
            Element::Coordinates(coordinates) => Ok(coordinates),
            Element::Number(number) => {
                Err(D::Error::custom(format_args!("{number} where a list is expected")))
            }
        }
    }
}

impl<'de> Deserialize<'de> for Element {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ElementVisitor)
    }
}

struct ElementVisitor;

impl<'de> Visitor<'de> for ElementVisitor {
    type Value = Element;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("coordinates")
    }

    fn visit_f64<E: de::Error>(self, number: f64) -> Result<Element, E> {
        Ok(Element::Number(number))
    }

    #[expect(clippy::cast_precision_loss, reason = "coordinates are rounded like all numbers")]
    fn visit_i64<E: de::Error>(self, number: i64) -> Result<Element, E> {
        Ok(Element::Number(number as f64))
    }

    #[expect(clippy::cast_precision_loss, reason = "coordinates are rounded like all numbers")]
    fn visit_u64<E: de::Error>(self, number: u64) -> Result<Element, E> {
        Ok(Element::Number(number as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Element, A::Error> {
        let first = match list.next_element()? {
            None => return Ok(Element::Coordinates(Coordinates::default())),
            Some(Element::Number(x)) => {
                let y: Option<f64> = list.next_element()?;
                let y = y.ok_or_else(|| A::Error::custom("a place has an x and no y"))?;
                // Heights, and whatever follows them.
                while list.next_element::<f64>()?.is_some() {}
                return Ok(Element::Coordinates(Coordinates::Place(Vec2::new(x, y))));
            }
            Some(Element::Coordinates(first)) => first,
        };
        let mut all = vec![first];
        while let Some(next) = list.next_element()? {
            all.push(next);
        }
        Ok(Element::Coordinates(Coordinates::List(all)))
    }
}
