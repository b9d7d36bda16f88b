//! How far meshes reach: STL, Wavefront OBJ and COLLADA.

use nalgebra::Vector3;
use roxmltree::{Document, Node};

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

/// Positions of all meshes, in metres. Nodes that move or turn them are not followed: with one
/// there is no extent.
fn collada(text: &str, add: &mut impl FnMut(Vector3<f64>)) -> Option<()> {
    let document = Document::parse(text).ok()?;
    let all = |tag: &'static str| {
        document.descendants().filter(move |node| node.tag_name().name() == tag)
    };
    if ["matrix", "translate", "rotate", "scale"].into_iter().flat_map(all).any(|it| moves(it)) {
        return None;
    }
    let unit = all("unit").next().and_then(|it| it.attribute("meter")?.parse().ok()).unwrap_or(1.0);
    let up = all("up_axis").next().and_then(|it| it.text()).unwrap_or("Y_UP").trim();
    let is_position = |node: &Node<'_, '_>| node.attribute("semantic") == Some("POSITION");
    for input in all("input").filter(is_position) {
        let source = input.attribute("source")?.strip_prefix('#')?;
        let source = all("source").find(|it| it.attribute("id") == Some(source))?;
        let values = source.descendants().find(|it| it.tag_name().name() == "float_array")?;
        let numbers: Vec<f64> =
            values.text()?.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
        for at in numbers.chunks_exact(3) {
            let [x, y, z] = [at[0], at[1], at[2]].map(|it| unit * it);
            add(if up == "Z_UP" { Vector3::new(x, y, z) } else { Vector3::new(x, -z, y) });
        }
    }
    Some(())
}

/// Whether a transform is one.
fn moves(node: Node<'_, '_>) -> bool {
    let numbers: Option<Vec<f64>> =
        node.text().map(|text| text.split_whitespace().filter_map(|it| it.parse().ok()).collect());
    let numbers = numbers.unwrap_or_default();
    let nothing: &[f64] = match node.tag_name().name() {
        "matrix" => &[1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.],
        "scale" => &[1., 1., 1.],
        "translate" => &[0., 0., 0.],
        // An axis and an angle.
        _ => return numbers.last().is_none_or(|angle| *angle != 0.0),
    };
    numbers != nothing
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
        let still = "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>";
        check("a.dae", text("Z_UP", still).as_bytes(), [0.0, 0.01, 0.02], [0.3, 0.4, 0.5]);
        let turned = "<rotate>0 1 0 90</rotate>";
        assert_eq!(extent("a.dae", text("Z_UP", turned).as_bytes()), None);
    }
}
