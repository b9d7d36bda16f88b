//! Craters that wear down: the shapes that a fresh one takes as its soil creeps downhill.
//!
//! Small impacts move soil downhill in proportion to the slope, so that the ground obeys the
//! equation of diffusion ([FassettThomson2014]). About a crater's centre, with lengths in radii *R*
//! of the fresh crater, that is
//!
//! ```text
//! ∂z/∂τ = (1/x) ∂/∂x (x ∂z/∂x)          x = r/R, τ = κ t/R²
//! ```
//!
//! with the diffusivity *κ* and the age *t*. All craters pass through the same shapes, large ones
//! later: a shape is known by its depth over its diameter alone. They are computed once, with the
//! Crank–Nicolson scheme on rings of equal width, from [`Crater::fresh`].

use crate::terrain::surface::{Crater, Surface};
use crate::units::Vec2;

/// Intervals of a radius of the fresh crater.
const PER_RADIUS: usize = 50;
/// How far from the centre the ground stays level, in radii of the fresh crater: at the ages that
/// are kept what creeps farther is less than a ten-thousandth of the diameter.
const RADII: usize = 4;
const POINTS: usize = RADII * PER_RADIUS;
/// Width of a ring [-].
const RING: f64 = 1.0 / PER_RADIUS as f64;
/// A step of τ [-]: eight of them per kept shape.
const STEP: f64 = 0.0005;
const STEPS_PER_SHAPE: usize = 8;

/// Depth over diameter of the shallowest craters that are made [-]: the shallowest class of
/// [Dsne2021] is below 0.07, without an end. *Assumed*: a crater of this depth has walls of 6° at
/// most, and shows on no picture but one with a low Sun.
pub(super) const SHALLOWEST: f64 = 0.03;

/// The shapes from fresh to hardly visible.
#[derive(Clone, Debug)]
pub(super) struct Shapes {
    all: Vec<Shape>,
}

/// A shape at one age.
#[derive(Clone, Debug)]
struct Shape {
    /// Heights over the diameter of the fresh crater [-], on rings about the centre.
    heights: Vec<f64>,
    /// Radius of the crest over that of the fresh crater [-].
    crest: f64,
    /// Depth of the centre below the crest over the diameter of the crest [-].
    depth: f64,
}

impl Shapes {
    pub(super) fn new() -> Self {
        let mut all = vec![Shape::of(fresh())];
        let mut heights = all[0].heights.clone();
        while all.last().is_some_and(|shape| shape.depth > SHALLOWEST) {
            (0..STEPS_PER_SHAPE).for_each(|_| creep(&mut heights));
            all.push(Shape::of(heights.clone()));
        }
        Self { all }
    }

    /// The profile of a crater.
    ///
    /// * `diameter`: of its crest as it is today [m]
    /// * `depth`: of its centre below the crest over that diameter [-]; kept between those of the
    ///   first and the last shape
    pub(super) fn profile(&self, diameter: f64, depth: f64) -> Profile<'_> {
        let after = self.all.partition_point(|shape| shape.depth > depth);
        let after = after.clamp(1, self.all.len() - 1);
        let (younger, older) = (&self.all[after - 1], &self.all[after]);
        let share = (younger.depth - depth) / (younger.depth - older.depth);
        Profile { younger, older, share: share.clamp(0.0, 1.0), diameter }
    }

    /// Depth over diameter of a fresh crater [-].
    pub(super) fn deepest(&self) -> f64 {
        self.all[0].depth
    }
}

/// Heights along a ray from the centre of one crater.
#[derive(Clone, Copy, Debug)]
pub(super) struct Profile<'a> {
    younger: &'a Shape,
    older: &'a Shape,
    /// How far it is from the younger to the older [-].
    share: f64,
    diameter: f64,
}

impl Profile<'_> {
    /// How far from the centre the ground is level [m].
    pub(super) fn reach(&self) -> f64 {
        0.5 * self.diameter * RADII as f64 / self.younger.crest.min(self.older.crest)
    }

    /// Height above the ground about the crater [m].
    ///
    /// * `distance`: from its centre [m]
    pub(super) fn height(&self, distance: f64) -> f64 {
        let x = 2.0 * distance / self.diameter;
        let height = |shape: &Shape| shape.height(x);
        let (young, old) = (height(self.younger), height(self.older));
        self.diameter * (young + self.share * (old - young))
    }
}

impl Shape {
    fn of(heights: Vec<f64>) -> Self {
        let highest = (0..POINTS)
            .fold(0, |best, point| if heights[point] > heights[best] { point } else { best });
        // The top of the parabola through the highest point and its neighbours.
        let [before, top, after] = [heights[highest - 1], heights[highest], heights[highest + 1]];
        let bend = 2.0 * top - before - after;
        let off = if bend > 0.0 { 0.5 * (after - before) / bend } else { 0.0 };
        let crest = (highest as f64 + off) * RING;
        let height = top + 0.25 * (after - before) * off;
        let depth = (height - heights[0]) / crest;
        Self { heights, crest, depth }
    }

    /// Height over the diameter of the crest [-].
    ///
    /// * `x`: distance from the centre over the radius of the crest [-]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the rings"
    )]
    fn height(&self, x: f64) -> f64 {
        let place = x * self.crest / RING;
        if place >= POINTS as f64 {
            return 0.0;
        }
        let ring = place as usize;
        let [near, far] = [self.heights[ring], self.heights[ring + 1]];
        (near + (place - ring as f64) * (far - near)) / self.crest
    }
}

/// Heights of the fresh crater over its diameter, on the rings.
fn fresh() -> Vec<f64> {
    let crater = Surface::Crater(Crater::fresh(Vec2::zeros(), 1.0));
    let at = |point: usize| crater.height(Vec2::new(0.5 * RING * point as f64, 0.0));
    (0..=POINTS).map(at).collect()
}

/// Takes heights a step on. The outermost stays.
fn creep(heights: &mut [f64]) {
    /// Half a step over the square of a ring's width.
    const R: f64 = 0.5 * STEP / (RING * RING);
    // Weights of the inner and the outer neighbour; the middle is a disc of half a ring's radius.
    let weights = |point: usize| {
        let x = point as f64;
        if point == 0 { (0.0, 4.0 * R) } else { (R * (x - 0.5) / x, R * (x + 0.5) / x) }
    };
    let mut right = vec![0.0; POINTS];
    for (point, to) in right.iter_mut().enumerate() {
        let (inner, outer) = weights(point);
        let here = heights[point];
        let before = if point == 0 { here } else { heights[point - 1] };
        *to = here + inner * (before - here) + outer * (heights[point + 1] - here);
    }
    // Elimination from the centre outwards: −inner z₋ + (1 + inner + outer) z − outer z₊ = right.
    let mut upper = vec![0.0; POINTS];
    for point in 0..POINTS {
        let (inner, outer) = weights(point);
        let (before, value) =
            if point == 0 { (0.0, 0.0) } else { (upper[point - 1], right[point - 1]) };
        let pivot = 1.0 + inner + outer - inner * before;
        upper[point] = outer / pivot;
        right[point] = (right[point] + inner * value) / pivot;
    }
    for point in (0..POINTS).rev() {
        heights[point] = right[point] + upper[point] * heights[point + 1];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Source: [FassettThomson2014], abstract: with 5.5 m²/Myr a crater of 1 km has 52 % of its
    /// first depth after 3 Gyr. DIFFERENCE: their first profile is not ours, which has a narrower
    /// rim; ours keeps 47 %.
    #[test]
    fn after_3_billion_years_a_crater_of_1_km_has_half_of_its_depth() {
        let (diffusivity, age, radius) = (5.5, 3000.0, 500.0);
        let tau: f64 = diffusivity * age / (radius * radius);
        let mut heights = fresh();
        let depth = |heights: &[f64]| {
            let shape = Shape::of(heights.to_vec());
            shape.depth * shape.crest
        };
        let first = depth(&heights);
        let mut at = 0.0;
        while at < tau {
            creep(&mut heights);
            at += STEP;
        }
        let kept = depth(&heights) / first;
        assert!((0.46..0.52).contains(&kept), "{kept}");
    }

    /// Creep moves soil, and makes none; what has left through the outer edge is too little to see.
    #[test]
    fn creep_keeps_the_volume() {
        let volume = |heights: &[f64]| {
            let rings =
                heights.iter().enumerate().skip(1).map(|(point, height)| point as f64 * height);
            heights[0] / 8.0 + rings.sum::<f64>()
        };
        let mut heights = fresh();
        let first = volume(&heights);
        (0..300).for_each(|_| creep(&mut heights));
        assert!((volume(&heights) / first - 1.0).abs() < 2e-3, "{}", volume(&heights) / first);
    }

    #[test]
    fn a_profile_has_the_diameter_and_the_depth_that_are_asked_for() {
        let shapes = Shapes::new();
        for depth in [0.196, 0.15, 0.1, 0.05, SHALLOWEST] {
            let profile = shapes.profile(20.0, depth);
            let heights: Vec<f64> =
                (0..=400).map(|step| profile.height(0.05 * f64::from(step))).collect();
            let crest = heights.iter().copied().fold(f64::MIN, f64::max);
            let at = heights.iter().position(|height| *height == crest).expect("the highest");
            assert!(
                (at as f64 * 0.05 - 10.0).abs() <= 0.2,
                "{depth}: crest at {}",
                at as f64 * 0.05
            );
            assert!(((crest - heights[0]) / 20.0 - depth).abs() < 2e-4, "{depth}");
            assert!(profile.height(profile.reach()).abs() < 2e-3, "{depth}");
        }
    }

    /// Source: [Pike1977], by way of `Crater::fresh`.
    #[test]
    fn a_fresh_profile_is_the_fresh_crater() {
        let (shapes, fresh) = (Shapes::new(), Surface::Crater(Crater::fresh(Vec2::zeros(), 20.0)));
        let profile = shapes.profile(20.0, shapes.deepest());
        for step in 0..120 {
            let r = 0.2 * f64::from(step);
            let difference = profile.height(r) - fresh.height(Vec2::new(r, 0.0));
            assert!(difference.abs() < 3e-3, "{difference} at {r}");
        }
    }
}
