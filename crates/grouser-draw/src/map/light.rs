//! The ground in the light of a low Sun: shaded relief.
//!
//! How much of the light meets a piece of ground is a closed form of its gradient *g*, with the unit
//! vector *l* to the Sun: (l_z − l_x g_x − l_y g_y) / √(1 + g·g).
//!
//! Source: B. K. P. Horn, "Hill shading and the reflectance map", Proceedings of the IEEE 69(1),
//! 1981: the reflectance of a Lambertian surface.

use grouser_core::terrain::ElevationGrid;
use grouser_core::units::Vec2;
use rayon::prelude::*;

use super::pixels::Pixels;
use crate::sheet::{BLACK, Colour, WHITE};

/// Where the light comes from: a unit vector to the north-west, 30° above the horizon.
const LIGHT: [f64; 3] = [-0.612_372_435_695_794_5, 0.612_372_435_695_794_5, 0.5];
/// Shades from ground without light to ground with twice that of level ground. An even number has
/// one of level ground.
const SHADES: f64 = 24.0;

/// How much light meets ground with a gradient, over what meets level ground.
pub(super) fn light(gradient: Vec2) -> f64 {
    let [east, north, up] = LIGHT;
    let across = (1.0 + gradient.norm_squared()).sqrt();
    ((up - east * gradient.x - north * gradient.y) / (across * up)).max(0.0)
}

/// A colour in the light: on level ground it is as it is.
///
/// * `light`: over that of level ground
pub(super) fn lit(colour: Colour, light: f64) -> Colour {
    /// How far ground without light is to black, and ground that faces the Sun to white.
    const DARKEST: f64 = 0.8;
    const BRIGHTEST: f64 = 0.55;
    let light = (light * 0.5 * SHADES).round() * 2.0 / SHADES;
    if light < 1.0 {
        colour.mixed(BLACK, DARKEST * (1.0 - light))
    } else {
        colour.mixed(WHITE, BRIGHTEST * (light - 1.0))
    }
}

/// The light of each pixel of a map, mixed of that of the four cells around it; none where no
/// height is known.
///
/// * `gradient`: of the ground, by column and row of the grid
pub(super) fn relief(
    pixels: &Pixels,
    grid: &ElevationGrid,
    gradient: &(dyn Fn(usize, usize) -> Option<Vec2> + Sync),
) -> Vec<Option<f64>> {
    let of_row = |y: usize| -> Vec<Option<f64>> {
        (0..pixels.size[0])
            .map(|x| {
                let [column, row] = pixels.nearest(x, y);
                gradient(column, row)?;
                let around = pixels.around(x, y, [grid.columns, grid.rows]);
                let known = around.into_iter().filter_map(|([column, row], share)| {
                    Some((light(gradient(column, row)?) * share, share))
                });
                let (sum, shares) = known.fold((0.0, 0.0), |(a, b), (c, d)| (a + c, b + d));
                (shares > 0.0).then(|| sum / shares)
            })
            .collect()
    };
    (0..pixels.size[1]).into_par_iter().flat_map_iter(of_row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slope of 60° to the north-west faces the Sun; one of 30° to the south-east just loses it.
    #[test]
    fn light_is_that_of_a_lambertian_surface() {
        let rises = |angle: f64| {
            let tan = angle.to_radians().tan() * std::f64::consts::FRAC_1_SQRT_2;
            Vec2::new(tan, -tan)
        };
        assert!((light(Vec2::zeros()) - 1.0).abs() < 1e-15);
        assert!((light(rises(60.0)) - 2.0).abs() < 1e-12);
        assert!(light(rises(-30.0)) < 1e-12 && light(rises(-45.0)) <= 0.0);
    }

    #[test]
    fn level_ground_has_the_colour_of_the_scale() {
        let green = Colour::hex(0x00_9e73);
        assert_eq!(lit(green, 1.0), green);
        assert_eq!(lit(green, 1.01), green, "the nearest shade");
    }
}
