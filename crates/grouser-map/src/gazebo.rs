//! Slip of a map for Gazebo: the picture that its system `LookupWheelSlip` reads, and the parts of
//! a model that use it.
//!
//! Source: gz-sim, `src/systems/lookup_wheel_slip` (pull request 3003). The system adds
//! `(pixel − 128) · delta` to the compliances of the system `WheelSlip`, red to the one sideways
//! and green to the one lengthwise; blue is for friction and stays at 128. It reads the pixel at
//! the place of each wheel, with the picture's middle at the origin of the world and north at its
//! top.

use std::fmt::Write as _;

use grouser::studies::mobility::{Ground, SlipCompliances};
use grouser_core::elementary::wide::atan2;
use grouser_core::vehicle::Rover;

/// A pixel that changes nothing, and the largest.
const NOMINAL: f64 = 128.0;
const STEPS: f64 = 127.0;

/// Slip of a map for Gazebo.
#[derive(Clone, Debug, PartialEq)]
pub struct SlipTexture {
    /// The picture as PNG, eight bits each of red, green and blue.
    pub png: Vec<u8>,
    /// What a step of red adds to the compliance sideways, and one of green to that lengthwise [-].
    pub deltas: [f64; 2],
    /// Extent of the picture to the east and to the north [m].
    pub size: [f64; 2],
    /// Where the world's origin, the picture's middle, lies on the map [m].
    pub middle: [f64; 2],
}

impl SlipTexture {
    /// The picture of a map: a pixel for each point, north up. Where nothing is known it changes
    /// nothing.
    ///
    /// # Panics
    /// If the map has more than 2³² columns or rows, which no memory takes.
    #[must_use]
    pub fn of(ground: Ground<'_>, compliances: &SlipCompliances) -> Self {
        let grid = &ground.raster().grid;
        let found = |place: usize| {
            let row = grid.rows - 1 - place / grid.columns;
            let gradient = ground.gradient(place % grid.columns, row)?;
            let slope = atan2(gradient.norm(), 1.0);
            Some([compliances.sideways(slope), compliances.lengthwise(slope)])
        };
        let all: Vec<Option<[f64; 2]>> = (0..grid.columns * grid.rows).map(found).collect();
        let delta = |axis: usize| {
            let most = all.iter().flatten().map(|it| it[axis]).fold(0.0, f64::max);
            if most > 0.0 { most / STEPS } else { 1.0 }
        };
        let deltas = [delta(0), delta(1)];
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "128 to 255")]
        let pixel = |number: f64| (NOMINAL + number).round() as u8;
        let nominal = pixel(0.0);
        let pixels = all.iter().flat_map(|found| match found {
            Some([sideways, lengthwise]) => {
                [pixel(sideways / deltas[0]), pixel(lengthwise / deltas[1]), nominal]
            }
            None => [nominal; 3],
        });
        let pixels: Vec<u8> = pixels.collect();
        let extent = grid.extent();
        let middle = 0.5 * (extent.south_west + extent.north_east);
        Self {
            png: encoded(grid.columns, grid.rows, &pixels),
            deltas,
            size: [grid.columns as f64 * grid.spacing.x, grid.rows as f64 * grid.spacing.y],
            middle: [middle.x, middle.y],
        }
    }

    /// The systems of a model as SDF, with links named as the rover's wheels are.
    ///
    /// * `picture`: the name of its file
    /// * `gravity`: [m/s²]
    #[must_use]
    pub fn sdf(&self, picture: &str, rover: &Rover, gravity: f64) -> String {
        let [sideways, lengthwise] = self.deltas;
        let mut text = format!(
            "<!-- Slip by place for a model of Gazebo, from `grouser map`. Both systems go into the model; rename the links to \
             those of its\n     wheels. The middle of the picture is the origin of the world: x {} m, y {} m on the map. A \
             pixel of p adds (p - 128)\n     times the delta to a compliance: slip over tangential force over load. Not \
             tried in Gazebo itself. -->\n",
            self.middle[0], self.middle[1]
        );
        text +=
            "<plugin filename=\"gz-sim-wheel-slip-system\" name=\"gz::sim::systems::WheelSlip\">\n";
        let load = rover.mass() * gravity / rover.mounts().len() as f64;
        for mount in rover.mounts() {
            let _ = writeln!(
                text,
                "  <wheel link_name=\"{}\">\n    <slip_compliance_lateral>0</slip_compliance_lateral>\n    \
                 <slip_compliance_longitudinal>0</slip_compliance_longitudinal>\n    \
                 <wheel_normal_force>{load:.4}</wheel_normal_force>\n    <wheel_radius>{:.4}</wheel_radius>\n  </wheel>",
                escaped(&mount.name),
                mount.shearing_radius()
            );
        }
        let _ = writeln!(
            text,
            "</plugin>\n<plugin filename=\"gz-sim-lookup-wheel-slip-system\" name=\"gz::sim::systems::LookupWheelSlip\">\n  \
             <slip_map>{picture}</slip_map>\n  <size_x>{}</size_x>\n  <size_y>{}</size_y>\n  \
             <slip_compliance_lateral_delta>{sideways:.6e}</slip_compliance_lateral_delta>\n  \
             <slip_compliance_longitudinal_delta>{lengthwise:.6e}</slip_compliance_longitudinal_delta>\n  \
             <friction_delta>0</friction_delta>",
            self.size[0], self.size[1]
        );
        for mount in rover.mounts() {
            let _ = writeln!(text, "  <wheel_link_name>{}</wheel_link_name>", escaped(&mount.name));
        }
        text + "</plugin>\n"
    }
}

/// A name in XML.
fn escaped(name: &str) -> String {
    name.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

fn encoded(columns: usize, rows: usize, pixels: &[u8]) -> Vec<u8> {
    let [width, height] =
        [columns, rows].map(|it| u32::try_from(it).expect("memory has fewer cells"));
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().expect("memory takes what is written");
    writer.write_image_data(pixels).expect("there are all channels of each pixel");
    writer.finish().expect("memory takes what is written");
    bytes
}
