//! What a data sheet does not give, estimated from what it does: inertias, wheel masses, sizes,
//! heights.
//!
//! Each is a first guess for a rover of which no more is known, and is to be marked as assumed.
//! Inertias are those of uniform bodies; the sizes are fits to the rovers of the presets, which
//! they meet to within a factor of 2.

use super::parts::Inertia;
use crate::elementary::pow;

impl Inertia {
    /// Returns the inertia of a uniform box about its centre [kg·m²], for a body of which only mass
    /// and size are known.
    ///
    /// ```text
    /// I_xx = m (b² + h²) / 12,  I_yy = m (l² + h²) / 12,  I_zz = m (l² + b²) / 12
    /// ```
    ///
    /// * `mass`: m [kg]
    /// * `size`: length l along x, width b along y, height h along z [m]
    #[must_use]
    pub fn of_uniform_box(mass: f64, size: [f64; 3]) -> Self {
        let m = mass;
        let [l, b, h] = size;
        Self {
            xx: m * (b * b + h * h) / 12.0,
            yy: m * (l * l + h * h) / 12.0,
            zz: m * (l * l + b * b) / 12.0,
        }
    }

    /// Returns the inertia of a uniform cylinder about its centre, its axis along y [kg·m²], for a
    /// wheel of which only mass and size are known.
    ///
    /// ```text
    /// I_yy = m r² / 2,  I_xx = I_zz = m (3 r² + b²) / 12
    /// ```
    ///
    /// * `mass`: m [kg]
    /// * `radius`: r [m]
    /// * `width`: b [m]
    #[must_use]
    pub fn of_uniform_cylinder(mass: f64, radius: f64, width: f64) -> Self {
        let (m, r, b) = (mass, radius, width);
        let across = m * (3.0 * r * r + b * b) / 12.0;
        Self { xx: across, yy: 0.5 * m * r * r, zz: across }
    }
}

/// Mass of one wheel with its motor [kg]: all wheels together have a fifth of the rover's mass.
///
/// Source: ours, between HAKUTO's 24 % ([FourWheel], Table 1) and MGRU3's 16 % (Hu et al., arXiv
/// 2405.11001).
///
/// * `mass`: of the whole rover [kg]
/// * `count`: number of wheels
#[must_use]
pub fn wheel_mass(mass: f64, count: u32) -> f64 {
    const SHARE: f64 = 0.2;
    SHARE * mass / f64::from(count)
}

/// Height of a hub over the centre of mass of the body [m], negative where it is below: such that
/// the common centre of mass of body and wheels has a height over the ground under the grousers'
/// tips.
///
/// ```text
/// m h = m_b h_b + m_w r_s,  z = r_s − h_b
/// ```
///
/// * `mass`: m, of the whole rover [kg]
/// * `wheels`: m_w, of all its wheels together [kg]
/// * `height`: h, of the common centre of mass over the ground [m]
/// * `tip_radius`: r_s = r + h_g, the height of the hubs [m]
#[must_use]
pub fn hub_height(mass: f64, wheels: f64, height: f64, tip_radius: f64) -> f64 {
    let (m, m_w, h, r_s) = (mass, wheels, height, tip_radius);
    let m_b = m - m_w;
    let h_b = (m * h - m_w * r_s) / m_b;
    r_s - h_b
}

/// Sizes of a rover of which only mass and number of wheels are known [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// From the first axle to the last.
    pub wheelbase: f64,
    /// From the middle of a left wheel to that of the right one.
    pub track: f64,
    /// Radius of a wheel.
    pub wheel_radius: f64,
    /// Width of a wheel.
    pub wheel_width: f64,
}

/// Sizes that grow with the cube root of the mass, as those of similar bodies do.
///
/// ```text
/// wheelbase = 0.24 ∛m,  track = 0.23 ∛m
/// four wheels or less:  r = 0.050 ∛m,  b = 0.8 r
/// more wheels:          r = 0.027 ∛m,  b = 1.2 r
/// ```
///
/// Source: ours, fitted by eye to the rovers of the presets.
///
/// * `mass`: m, of the whole rover [kg]
/// * `count`: number of wheels
#[must_use]
pub fn sizes(mass: f64, count: u32) -> Sizes {
    let root = pow(mass, 1.0 / 3.0);
    let (radius, slenderness) = if count <= 4 { (0.050, 0.8) } else { (0.027, 1.2) };
    let wheel_radius = radius * root;
    Sizes {
        wheelbase: 0.24 * root,
        track: 0.23 * root,
        wheel_radius,
        wheel_width: slenderness * wheel_radius,
    }
}

/// Height of the common centre of mass over the ground under the grousers' tips [m]: above the hubs
/// by a fifth of the mean of wheelbase and track.
///
/// Source: ours, between HAKUTO's 11 % and MGRU3's 25 %.
#[must_use]
pub fn centre_of_mass_height(tip_radius: f64, wheelbase: f64, track: f64) -> f64 {
    const SHARE: f64 = 0.2;
    tip_radius + SHARE * 0.5 * (wheelbase + track)
}

/// Height of the body [m]: two fifths of the mean of wheelbase and track.
///
/// Source: ours; the box that `mgru3` assumes is 1.28 m by 1.22 m by 0.50 m.
#[must_use]
pub fn body_height(wheelbase: f64, track: f64) -> f64 {
    const SHARE: f64 = 0.4;
    SHARE * 0.5 * (wheelbase + track)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums over many small masses, evenly spread, have the inertias of the closed forms.
    #[test]
    fn inertias_are_those_of_many_small_masses() {
        const COUNT: usize = 40;
        let [l, b, h] = [1.28, 1.22, 0.5];
        let at = |place: usize, size: f64| ((place as f64 + 0.5) / COUNT as f64 - 0.5) * size;
        let mass = 74.0 / (COUNT * COUNT * COUNT) as f64;
        let (mut xx, mut yy, mut zz) = (0.0, 0.0, 0.0);
        for place in 0..COUNT * COUNT * COUNT {
            let x = at(place % COUNT, l);
            let y = at(place / COUNT % COUNT, b);
            let z = at(place / COUNT / COUNT, h);
            xx += mass * (y * y + z * z);
            yy += mass * (x * x + z * z);
            zz += mass * (x * x + y * y);
        }
        let found = Inertia::of_uniform_box(74.0, [l, b, h]);
        // The midpoint rule is short by 1/n² of a second moment.
        for (sum, closed) in [(xx, found.xx), (yy, found.yy), (zz, found.zz)] {
            assert!((sum / closed - (1.0 - 1.0 / 1600.0)).abs() < 1e-9, "{sum} {closed}");
        }
    }

    /// A flat disc and a thin rod are the ends of the cylinder.
    #[test]
    fn a_cylinder_is_between_a_disc_and_a_rod() {
        let disc = Inertia::of_uniform_cylinder(3.5, 0.25, 0.0);
        assert!((disc.yy - 2.0 * disc.xx).abs() < 1e-15 && disc.xx == disc.zz, "{disc:?}");
        let rod = Inertia::of_uniform_cylinder(3.5, 0.0, 0.2);
        assert!(rod.yy == 0.0 && (rod.xx - 3.5 * 0.04 / 12.0).abs() < 1e-15, "{rod:?}");
    }

    /// Source: the preset `mgru3`, computed on its own.
    #[test]
    fn the_hubs_of_mgru3_are_where_its_document_has_them() {
        assert!((hub_height(88.0, 14.0, 0.59, 0.25) - -0.404_324).abs() < 1e-6);
    }

    #[test]
    fn wheels_of_any_number_have_a_fifth_of_the_mass() {
        for count in [3, 4, 6, 8] {
            assert!((f64::from(count) * wheel_mass(88.0, count) - 17.6).abs() < 1e-12);
        }
    }

    /// Twice as long, eight times as heavy.
    #[test]
    fn sizes_are_those_of_similar_bodies() {
        let (one, eight) = (sizes(10.0, 6), sizes(80.0, 6));
        assert!((eight.wheelbase / one.wheelbase - 2.0).abs() < 1e-12);
        assert!((eight.wheel_width / one.wheel_width - 2.0).abs() < 1e-12);
    }
}
