//! The shapes of links, and the rims of wheels among them.

use nalgebra::{Isometry3, Vector3};
use roxmltree::Node;

use super::error::UrdfError;
use super::mesh;
use super::options::UrdfOptions;
use super::xml::{attribute, child, number, origin, triple};
use crate::reading::four_digits;

/// Cosine of the angle by which an axis may be off its direction: 10°.
pub(super) const ALONG: f64 = 0.985;

/// The bytes of a mesh by its name in URDF, such as `package://rover/meshes/wheel.stl`; none where
/// it is not there.
pub type Meshes<'a> = dyn Fn(&str) -> Option<Vec<u8>> + 'a;

/// A shape of a link, in the link's frame.
#[derive(Clone, Debug)]
pub(super) struct LinkShape {
    kind: RimForm,
    origin: Isometry3<f64>,
    is_collision: bool,
}

#[derive(Clone, Debug)]
enum RimForm {
    Cylinder { radius: f64, length: f64 },
    Sphere { radius: f64 },
    Box,
    Mesh { file: String, scale: Vector3<f64> },
}

/// What is known of a wheel's rim.
#[derive(Clone, Debug)]
pub(super) struct Rim {
    /// [m]
    pub(super) radius: Option<f64>,
    pub(super) width: Option<f64>,
    /// Its middle, in the root's frame [m].
    pub(super) centre: Vector3<f64>,
    /// Where radius and width are from, in words; none for one cylinder.
    pub(super) note: Option<String>,
    /// What its shapes are where they do not tell radius and width.
    pub(super) lacks: String,
}

impl LinkShape {
    /// The shapes of a link's element; a number that is none is told when a wheel has it.
    pub(super) fn all(link: Node<'_, '_>, what: &str) -> Vec<Result<Self, UrdfError>> {
        let parts = link.children().filter_map(|part| match part.tag_name().name() {
            "collision" => Some((part, true)),
            "visual" => Some((part, false)),
            _ => None,
        });
        parts.filter_map(|(part, is_collision)| Self::of(part, is_collision, what)).collect()
    }

    fn of(part: Node<'_, '_>, is_collision: bool, what: &str) -> Option<Result<Self, UrdfError>> {
        let geometry = child(part, "geometry")?;
        let shape = geometry.children().find(Node::is_element)?;
        let size = |name| number(shape, what, name, |size| size > 0.0, "a length in m, above 0");
        let kind = match shape.tag_name().name() {
            "cylinder" => size("radius").and_then(|radius| {
                size("length").map(|length| RimForm::Cylinder { radius, length })
            }),
            "sphere" => size("radius").map(|radius| RimForm::Sphere { radius }),
            "box" => Ok(RimForm::Box),
            "mesh" => attribute(shape, what, "filename").and_then(|file| {
                let is_scaled = shape.has_attribute("scale");
                let scale =
                    if is_scaled { triple(shape, what, "scale")? } else { Vector3::repeat(1.0) };
                Ok(RimForm::Mesh { file: file.to_owned(), scale })
            }),
            _ => return None,
        };
        let placed = |kind| Ok(Self { kind, origin: origin(part, what)?, is_collision });
        Some(kind.and_then(placed))
    }

    /// Radius and width about an axis of the root's frame, and the middle; none of a shape that is
    /// no body of revolution about it.
    fn rim(&self, frame: &Isometry3<f64>, meshes: &Meshes<'_>) -> Option<(f64, f64, Vector3<f64>)> {
        let placed = frame * self.origin;
        match &self.kind {
            RimForm::Cylinder { radius, length } => {
                let lies = (placed.rotation * Vector3::z()).y.abs() > ALONG;
                lies.then_some((*radius, *length, placed.translation.vector))
            }
            RimForm::Sphere { .. } | RimForm::Box => None,
            RimForm::Mesh { file, scale } => {
                let [low, high] = mesh::extent(file, &meshes(file)?)?;
                let (low, high) = (low.component_mul(scale), high.component_mul(scale));
                let size = (high - low).abs();
                let middle = placed * nalgebra::Point3::from(0.5 * (low + high));
                // In the mesh's frame, in which a wheel may have turned by any angle.
                let axle = placed.inverse_transform_vector(&Vector3::y());
                let along = axle.iamax();
                let (one, other) = (size[(along + 1) % 3], size[(along + 2) % 3]);
                let is_round = (one - other).abs() <= 0.1 * one.max(other);
                let is_wheel = is_round && axle[along].abs() > ALONG;
                is_wheel.then_some((0.25 * (one + other), size[along], middle.coords))
            }
        }
    }
}

/// The rim of a link's shapes: the largest radius of what collides, or else of what is seen.
///
/// * `frame`: of the link in the root's
pub(super) fn rim(
    shapes: &[Result<LinkShape, UrdfError>],
    frame: &Isometry3<f64>,
    options: &UrdfOptions,
    meshes: &Meshes<'_>,
) -> Result<Rim, UrdfError> {
    let shapes: Vec<&LinkShape> =
        shapes.iter().map(|it| it.as_ref().map_err(Clone::clone)).collect::<Result<_, _>>()?;
    let of = |is_collision: bool| -> Vec<_> {
        let those = shapes.iter().filter(|it| it.is_collision == is_collision);
        those.filter_map(|it| Some((it.rim(frame, meshes)?, *it))).collect()
    };
    let collides = of(true);
    let found = if collides.is_empty() { of(false) } else { collides };
    let largest = found.iter().max_by(|one, other| one.0.0.total_cmp(&other.0.0));
    let most = largest.map_or(0.0, |it| it.0.0);
    let tyres: Vec<Tyre> = found
        .iter()
        .filter(|it| it.0.0 > (1.0 - ALIKE) * most)
        .map(|((_, width, middle), _)| (*width, *middle))
        .collect();
    let side_by_side = side_by_side(&tyres);
    let radii: Vec<f64> = found.iter().map(|it| it.0.0).collect();
    let differ = radii.iter().any(|it| (it - radii[0]).abs() > 1e-6);
    let note = largest.and_then(|(_, shape)| match &shape.kind {
        RimForm::Mesh { file, .. } => Some(format!("radius and width by the extent of {file}")),
        _ if differ => {
            let radii: Vec<String> = radii.iter().map(|it| four_digits(*it)).collect();
            Some(format!("radius the largest of {} m", radii.join(", ")))
        }
        _ => None,
    });
    let several = side_by_side.filter(|(width, _)| *width > (1.0 + ALIKE) * tyres[0].0);
    let several = several.map(|(width, _)| {
        format!("{} tyres side by side, together {} m wide", tyres.len(), four_digits(width))
    });
    let notes: Vec<String> = note.into_iter().chain(several).collect();
    let place = |shape: &&LinkShape| (frame * shape.origin).translation.vector;
    let somewhere = || shapes.first().map_or(frame.translation.vector, place);
    let sphere = shapes.iter().find_map(|it| match it.kind {
        RimForm::Sphere { radius } => Some(radius),
        _ => None,
    });
    let radius = options.wheel_radius.or(largest.map(|it| it.0.0)).or(sphere);
    let width = options.wheel_width.or(side_by_side.map(|it| it.0));
    let is_known = radius.is_some() && width.is_some();
    Ok(Rim {
        radius,
        width,
        centre: side_by_side.map_or_else(somewhere, |it| it.1),
        note: Some(notes.join("; ")).filter(|it| !it.is_empty() && options.wheel_radius.is_none()),
        lacks: if is_known { String::new() } else { lacks(&shapes, meshes) },
    })
}

/// Radii that differ by less are alike [-].
const ALIKE: f64 = 1e-3;

/// The width of a tyre [m], and its middle in the root's frame [m].
type Tyre = (f64, Vector3<f64>);

/// Tyres of one wheel as one: as wide as what they cover of its axle, and in their middle.
fn side_by_side(tyres: &[Tyre]) -> Option<Tyre> {
    let first = tyres.first()?;
    if tyres.iter().all(|it| it == first) {
        return Some(*first);
    }
    let mut spans: Vec<[f64; 2]> =
        tyres.iter().map(|(width, at)| [at.y - 0.5 * width, at.y + 0.5 * width]).collect();
    spans.sort_by(|one, other| one[0].total_cmp(&other[0]));
    let begin = spans.first()?[0];
    let cover = |(covered, until): (f64, f64), [low, high]: &[f64; 2]| {
        (covered + (high - until.max(*low)).max(0.0), until.max(*high))
    };
    let (width, end) = spans.iter().fold((0.0, begin), cover);
    let middle = tyres.iter().map(|(_, at)| at).sum::<Vector3<f64>>() / tyres.len() as f64;
    Some((width, Vector3::new(middle.x, 0.5 * (begin + end), middle.z)))
}

fn lacks(shapes: &[&LinkShape], meshes: &Meshes<'_>) -> String {
    let what = match shapes.first().map(|it| &it.kind) {
        None => "it has no geometry",
        Some(RimForm::Cylinder { .. }) => "the axis of its cylinder is not across the rover",
        Some(RimForm::Sphere { .. }) => "its geometry is a sphere, which has no width",
        Some(RimForm::Box) => "its geometry is a box",
        Some(RimForm::Mesh { file, .. }) => {
            let why = match meshes(file) {
                Some(_) => "is not round across the rover, or of no known form",
                None => "was not found",
            };
            return format!("its geometry is a mesh, {file}, which {why}");
        }
    };
    what.to_owned()
}

/// Whether a shape is a sphere or a cylinder, as casters and skids are.
pub(super) fn kinds(shapes: &[Result<LinkShape, UrdfError>]) -> Option<&'static str> {
    match shapes.first()?.as_ref().ok()?.kind {
        RimForm::Sphere { .. } => Some("a sphere"),
        RimForm::Cylinder { .. } => Some("a cylinder"),
        RimForm::Box | RimForm::Mesh { .. } => None,
    }
}
