//! Ground to damage: small maps of heights and of zones of soil, in every format, and documents
//! that name them.

use std::fmt::Write as _;
use std::fs;

use anyhow::{Context, Result};

use crate::workspace;

/// Pictures of the tests that read them; both are of one place.
const FIXTURES: [(&str, &str); 2] =
    [("map.tif", "tiled-deflate-f32.tif"), ("classes.tif", "classes-palette-u8.tif")];

const DOCUMENTS: [(&str, &str); 4] = [
    (
        "classes.toml",
        "schema = \"scenario/1\"\nname = \"classes\"\nsimulation = \"quasi-steady\"\nduration_s = 0.2\n\
         [terrain]\nfile = \"map.tif\"\nsoil_file = \"classes.tif\"\n\
         [[terrain.zone]]\nclass = 3\nsoil = \"grc-1\"\n[[terrain.zone]]\nclass = 7\n",
    ),
    (
        "zones.toml",
        "schema = \"scenario/1\"\nname = \"zones\"\nsimulation = \"quasi-steady\"\nduration_s = 0.2\n\
         [terrain]\nsurface = \"cone\"\nslope_deg = 5.0\ntip_m = [3.0, 1.0]\nrounding_m = 0.5\nstart_m = [0.0, 0.0]\n\
         soil_file = \"zones.geojson\"\n[[terrain.zone]]\nname = \"crust\"\nsoil = \"soil.toml\"\n\
         [[terrain.zone]]\nclass = 4\nsoil = \"clay\"\n",
    ),
    ("zones.geojson", include_str!("corpus/zones.geojson")),
    (
        "mission.toml",
        "schema = \"mission/1\"\nname = \"over a map\"\nsimulation = \"quasi-steady\"\n[terrain]\nfile = \"map.xyz\"\n\
         start_m = [4.0, 4.0]\n[[leg]]\nspeed_m_s = 0.06\ngoto = { x_m = 4.05, y_m = 4.0, within_m = 0.04 }\n",
    ),
];

/// All of them by their names.
pub(super) fn files() -> Result<Vec<(String, Vec<u8>)>> {
    let fixtures = workspace::root().join("crates/grouser-raster/tests/fixtures");
    let mut files = Vec::new();
    for (name, fixture) in FIXTURES {
        files.push((name.to_owned(), fs::read(fixtures.join(fixture)).context(fixture)?));
    }
    files.extend(DOCUMENTS.map(|(name, text)| (name.to_owned(), text.into())));
    files.push(("map.npy".to_owned(), array()));
    files.push(("map.xyz".to_owned(), points().into()));
    Ok(files)
}

/// Six rows of eight heights.
fn array() -> Vec<u8> {
    let header = "{'descr': '<f4', 'fortran_order': False, 'shape': (6, 8), }\n";
    let mut file = b"\x93NUMPY\x01\0".to_vec();
    file.extend([u8::try_from(header.len()).unwrap_or_default(), 0]);
    file.extend(header.bytes());
    file.extend((0..48_u8).flat_map(|cell| (0.05 * f32::from(cell % 8)).to_le_bytes()));
    file
}

/// Nine rows of nine points.
fn points() -> String {
    let mut text = String::from("x,y,z\n");
    for (row, column) in (0..9).flat_map(|row| (0..9).map(move |column| (row, column))) {
        let _ = writeln!(text, "{column},{row},{}", f64::from(row * column) / 100.0);
    }
    text
}
