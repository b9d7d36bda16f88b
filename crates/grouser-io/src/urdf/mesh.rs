//! How far meshes reach: STL, Wavefront OBJ and COLLADA; and where they are.

use std::path::{Path, PathBuf};

use nalgebra::{Matrix4, Point3, Unit, Vector3};
use roxmltree::{Document, Node};

use crate::file;

/// The largest mesh [bytes].
const LARGEST: u64 = 64 << 20;

/// Looks up meshes in the folders that they are in beside a file of URDF, and above it.
pub fn meshes_beside(urdf: &Path) -> impl Fn(&str) -> Option<Vec<u8>> + '_ {
    move |mesh| places(urdf, mesh).iter().find_map(|place| file::read(place, LARGEST).ok())
}

/// Where a mesh may be: as ROS finds it by its package, and beside the URDF and in folders above it.
fn places(urdf: &Path, mesh: &str) -> Vec<PathBuf> {
    /// How far above.
    const ABOVE: usize = 4;
    let mesh = mesh.strip_prefix("file://").unwrap_or(mesh);
    // `$(find PACKAGE)/…`, which simulators expand where xacro did not.
    let found = mesh.strip_prefix("$(find ").map(|it| it.replacen(')', "", 1));
    let mesh = found.map_or(mesh.to_owned(), |it| format!("package://{it}"));
    let mesh = &*mesh;
    let in_package = ["package://", "model://"].iter().find_map(|it| mesh.strip_prefix(it));
    let whole = in_package.unwrap_or(mesh);
    let within = in_package.and_then(|it| it.split_once('/')).map(|(_, within)| within);
    // A relative path does not name the folders above the current one.
    let urdf = std::path::absolute(urdf).unwrap_or(urdf.to_owned());
    let folder = urdf.parent().unwrap_or(Path::new(""));
    let above = folder.ancestors().take(ABOVE);
    let names = move |folder: &Path| {
        [Some(whole), within].into_iter().flatten().map(|it| folder.join(it)).collect::<Vec<_>>()
    };
    above.flat_map(names).collect()
}

/// The least and the largest coordinates of a mesh, in its frame [m]; none of a format that is not
/// read.
///
/// * `name`: whose ending says which format it is
pub(super) fn extent(name: &str, bytes: &[u8]) -> Option<[Vector3<f64>; 2]> {
    let ending = name.rsplit('.').next()?.to_lowercase();
    let mut extent: Option<[Vector3<f64>; 2]> = None;
    let mut add = |at: Vector3<f64>| {
        let [low, high] = extent.unwrap_or([at; 2]);
        extent = Some([low.inf(&at), high.sup(&at)]);
    };
    match &*ending {
        "stl" => stl(bytes, &mut add)?,
        "obj" => {
            let text = std::str::from_utf8(bytes).ok()?;
            text.lines().filter_map(|line| triple(line.strip_prefix("v ")?)).for_each(add);
        }
        "dae" => collada(std::str::from_utf8(bytes).ok()?, &mut add)?,
        _ => return None,
    }
    extent.filter(|[low, high]| (high - low).iter().all(|it| it.is_finite()))
}

/// The first three numbers of a text.
fn triple(text: &str) -> Option<Vector3<f64>> {
    let mut numbers = text.split_whitespace().map(str::parse);
    let mut next = || numbers.next()?.ok();
    Some(Vector3::new(next()?, next()?, next()?))
}

/// Bytes of the binary form: a header, the number of triangles, and for each a normal, three
/// corners and two bytes.
fn stl(bytes: &[u8], add: &mut impl FnMut(Vector3<f64>)) -> Option<()> {
    const HEADER: usize = 84;
    const TRIANGLE: usize = 50;
    let count = bytes.get(80..HEADER).and_then(|four| four.try_into().ok()).map(u32::from_le_bytes);
    if count.is_some_and(|count| bytes.len() == HEADER + TRIANGLE * count as usize) {
        for triangle in bytes[HEADER..].chunks_exact(TRIANGLE) {
            for corner in triangle[12..48].chunks_exact(12) {
                let at = |place: usize| {
                    let four = [0, 1, 2, 3].map(|byte| corner[4 * place + byte]);
                    f64::from(f32::from_le_bytes(four))
                };
                add(Vector3::new(at(0), at(1), at(2)));
            }
        }
        return Some(());
    }
    let text = std::str::from_utf8(bytes).ok()?;
    text.lines().filter_map(|line| triple(line.trim().strip_prefix("vertex")?)).for_each(add);
    Some(())
}

/// Positions of all meshes where the nodes of the scene put them, in metres; without a scene they
/// stand as they are.
fn collada(text: &str, add: &mut impl FnMut(Vector3<f64>)) -> Option<()> {
    let document = Document::parse(text).ok()?;
    let all = |tag: &'static str| {
        document.descendants().filter(move |node| node.tag_name().name() == tag)
    };
    let unit = all("unit").next().and_then(|it| it.attribute("meter")?.parse().ok()).unwrap_or(1.0);
    let up = all("up_axis").next().and_then(|it| it.text()).unwrap_or("Y_UP").trim();
    let by_id = |tag, of: &str| {
        let id = of.strip_prefix('#')?;
        all(tag).find(|it| it.attribute("id") == Some(id))
    };
    let instance = |it: Node<'_, '_>| Some((placed(it)?, by_id("geometry", it.attribute("url")?)?));
    let mut meshes = all("instance_geometry").map(instance).collect::<Option<Vec<_>>>()?;
    if meshes.is_empty() {
        meshes.push((Matrix4::<f64>::identity(), document.root()));
    }
    let is_position = |node: &Node<'_, '_>| node.attribute("semantic") == Some("POSITION");
    for (place, mesh) in meshes {
        for input in mesh.descendants().filter(is_position) {
            for at in corners(by_id("source", input.attribute("source")?)?)? {
                let at = unit * place.transform_point(&at).coords;
                add(if up == "Z_UP" { at } else { Vector3::new(at.x, -at.z, at.y) });
            }
        }
    }
    Some(())
}

/// The points of a source of COLLADA.
fn corners(source: Node<'_, '_>) -> Option<Vec<Point3<f64>>> {
    let values = source.descendants().find(|it| it.tag_name().name() == "float_array")?;
    let numbers = numbers(values)?;
    Some(numbers.chunks_exact(3).map(|at| Point3::new(at[0], at[1], at[2])).collect())
}

/// Where the nodes that an element stands in put it.
fn placed(element: Node<'_, '_>) -> Option<Matrix4<f64>> {
    let nodes = element.ancestors().filter(|it| it.tag_name().name() == "node");
    let own = |node: Node<'_, '_>| {
        node.children()
            .try_fold(Matrix4::<f64>::identity(), |place, it| Some(place * transform(it)?))
    };
    nodes.map(own).try_fold(Matrix4::<f64>::identity(), |inner, outer| Some(outer? * inner))
}

/// The transform of a child of a node: the identity for other elements, and none for a `lookat`, a
/// `skew` and malformed numbers.
fn transform(node: Node<'_, '_>) -> Option<Matrix4<f64>> {
    let tag = node.tag_name().name();
    if !["matrix", "translate", "rotate", "scale", "lookat", "skew"].contains(&tag) {
        return Some(Matrix4::<f64>::identity());
    }
    let numbers = numbers(node)?;
    let first = || Some(Vector3::from_column_slice(numbers.get(..3)?));
    match tag {
        "matrix" => Some(Matrix4::from_row_slice(numbers.get(..16)?)),
        "translate" => Some(Matrix4::new_translation(&first()?)),
        "scale" => Some(Matrix4::new_nonuniform_scaling(&first()?)),
        "rotate" => {
            let axis = Unit::try_new(first()?, 1e-9)?;
            Some(Matrix4::from_axis_angle(&axis, numbers.get(3)?.to_radians()))
        }
        _ => None,
    }
}

/// The numbers in an element.
fn numbers(node: Node<'_, '_>) -> Option<Vec<f64>> {
    node.text()?.split_whitespace().map(|it| it.parse().ok()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(name: &str, bytes: &[u8], low: [f64; 3], high: [f64; 3]) {
        let [least, most] = extent(name, bytes).expect(name);
        assert!((least - Vector3::from(low)).norm() < 1e-6, "{name}: {least}");
        assert!((most - Vector3::from(high)).norm() < 1e-6, "{name}: {most}");
    }

    #[test]
    fn extents_are_those_of_all_corners() {
        let corners = [[1.0_f32, -2.0, 0.5], [0.0, 3.0, 0.5], [-4.0, 0.0, 0.25]];
        let mut binary = [b' '; 80].to_vec();
        binary.extend(1_u32.to_le_bytes());
        binary.extend([0; 12]);
        for corner in corners {
            binary.extend(corner.iter().flat_map(|it| it.to_le_bytes()));
        }
        binary.extend([0; 2]);
        let lines =
            |line: fn([f32; 3]) -> String| corners.into_iter().map(line).collect::<String>();
        let ascii = lines(|[x, y, z]| format!("   vertex {x} {y} {z}\n"));
        let wavefront = lines(|[x, y, z]| format!("v {x} {y} {z}\nvn 9 9 9\n"));
        let (low, high) = ([-4.0, -2.0, 0.25], [1.0, 3.0, 0.5]);
        check("a.STL", &binary, low, high);
        check(
            "a.stl",
            format!("solid wheel\n facet normal 0 0 1\n{ascii}endsolid").as_bytes(),
            low,
            high,
        );
        check("a.obj", wavefront.as_bytes(), low, high);
        assert_eq!(extent("a.stl", &binary[..90]), None);
        assert_eq!(extent("a.step", &binary), None);
    }

    #[test]
    fn collada_has_units_and_an_upright_axis() {
        let text = |up: &str, node: &str| {
            format!(
                "<COLLADA><asset><unit meter=\"0.01\"/><up_axis>{up}</up_axis></asset><mesh>\
                 <source id=\"p\"><float_array count=\"6\">0 1 2 30 40 50</float_array></source>\
                 <vertices><input semantic=\"POSITION\" source=\"#p\"/></vertices></mesh>{node}</COLLADA>"
            )
        };
        check("a.dae", text("Z_UP", "").as_bytes(), [0.0, 0.01, 0.02], [0.3, 0.4, 0.5]);
        check("a.dae", text("Y_UP", "").as_bytes(), [0.0, -0.5, 0.01], [0.3, -0.02, 0.4]);
    }

    /// As drawing programs write them: with a camera and a light, the mesh in a node in a node.
    #[test]
    fn collada_has_scenes() {
        let text = |inner: &str| {
            format!(
                "<COLLADA><asset><up_axis>Z_UP</up_axis></asset><geometry id=\"wheel\"><mesh>\
                 <source id=\"p\"><float_array count=\"6\">0 1 2 30 40 50</float_array></source>\
                 <vertices><input semantic=\"POSITION\" source=\"#p\"/></vertices></mesh></geometry>\
                 <visual_scene><node><matrix>9 0 0 9 0 9 0 9 0 0 9 9 0 0 0 1</matrix>\
                 <instance_camera url=\"#c\"/></node><node><scale>0.1 0.1 0.1</scale><node>{inner}\
                 <instance_geometry url=\"#wheel\"/></node></node></visual_scene></COLLADA>"
            )
        };
        let still = "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>";
        check("a.dae", text(still).as_bytes(), [0.0, 0.1, 0.2], [3.0, 4.0, 5.0]);
        // A quarter about x: y to z, and z to -y; then one to the left.
        let turned = "<translate>0 10 0</translate><rotate>1 0 0 90</rotate>";
        check("a.dae", text(turned).as_bytes(), [0.0, -4.0, 0.1], [3.0, 0.8, 4.0]);
        for odd in ["<lookat>1 2 3</lookat>", "<matrix>1 2</matrix>", "<rotate>0 0 0 9</rotate>"] {
            assert_eq!(extent("a.dae", text(odd).as_bytes()), None, "{odd}");
        }
    }
}
