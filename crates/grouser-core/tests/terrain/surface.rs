use std::f64::consts::TAU;

use grouser_core::terrain::surface::{Cone, Crater, Incline, Ramp, Ripple, Surface};
use grouser_core::terrain::{ElevationGrid, ElevationModel, Footprint, Terrain};
use grouser_core::units::{Vec2, Vec3, deg};
use proptest::prelude::*;

fn ramp(rounding: f64) -> Ramp {
    Ramp { foot: Vec2::new(1.0, -0.5), uphill: 0.7, slope: deg(20.0), length: 3.0, rounding }
}

fn surfaces() -> [Surface; 7] {
    let centre = Vec2::new(0.4, -0.3);
    [
        Surface::Incline(Incline { slope: deg(12.0), uphill: 2.1 }),
        Surface::Ramp(ramp(0.8)),
        Surface::Ramp(ramp(3.0)),
        Surface::Cone(Cone { tip: centre, slope: deg(15.0), rounding: 0.5 }),
        Surface::Cone(Cone { tip: centre, slope: deg(-25.0), rounding: 0.2 }),
        Surface::Ripple(Ripple { amplitude: 0.1, wavelength: 1.3, across: 0.4, phase: 0.9 }),
        Surface::Crater(Crater::fresh(centre, 4.0)),
    ]
}

proptest! {
    #[test]
    fn gradients_are_those_of_the_heights(x in -5.0..5.0, y in -5.0..5.0) {
        for surface in surfaces() {
            surface.check().expect("a surface");
            let at = Vec2::new(x, y);
            let slope = |along: Vec2| {
                let step = 1e-5 * along;
                (surface.height(at + step) - surface.height(at - step)) / 2e-5
            };
            let difference = Vec2::new(slope(Vec2::x()), slope(Vec2::y())) - surface.gradient(at);
            // The second derivative jumps where a rounding ends: by at most 2.3 per metre here.
            prop_assert!(difference.norm() < 3e-5, "{surface:?}: {difference}");
        }
    }

    /// A cone falls by its slope in any direction, and its contours are circles.
    #[test]
    fn a_cone_is_as_steep_everywhere(angle in 0.0..TAU, r in 0.5..40.0_f64) {
        let cone = Cone { tip: Vec2::new(3.0, 2.0), slope: deg(15.0), rounding: 0.5 };
        let outward = Vec2::new(angle.cos(), angle.sin());
        let at = cone.tip + r * outward;
        let surface = Surface::Cone(cone);
        prop_assert!((surface.height(at) + r * deg(15.0).tan()).abs() < 1e-12);
        prop_assert!((surface.gradient(at) + deg(15.0).tan() * outward).norm() < 1e-12);
    }

    /// Under any wheel an incline is itself.
    #[test]
    fn an_incline_is_the_plane_that_a_wheel_meets(
        (slope, uphill) in (0.0..1.2, 0.0..TAU),
        (x, y, heading) in (-9.0..9.0, -9.0..9.0, 0.0..TAU),
    ) {
        let surface = Surface::Incline(Incline { slope, uphill });
        let terrain = surface;
        let forward = Vec2::new(heading.cos(), heading.sin());
        let footprint = Footprint { forward, half_length: 0.06, half_width: 0.05 };
        let at = Vec2::new(x, y);
        let patch = terrain.patch(at, footprint);
        let climb = slope.sin() * Vec2::new(uphill.cos(), uphill.sin());
        let normal = Vec3::new(-climb.x, -climb.y, slope.cos());
        prop_assert!((patch.normal - normal).norm() < 1e-11);
        prop_assert!((patch.height - surface.height(at)).abs() < 1e-11);
        prop_assert!(terrain.covers(at, footprint));
    }
}

/// The mean over a footprint takes the share sin(k l)/(k l) or so off a ripple, and nothing off
/// long ones.
#[test]
fn a_ripple_repeats_itself_and_long_ones_are_planes() {
    let ripple = Ripple { amplitude: 0.05, wavelength: 0.9, across: 0.0, phase: 0.2 };
    let surface = Surface::Ripple(ripple);
    for x in [-0.4, 0.0, 0.3] {
        let (at, next) = (Vec2::new(x, 0.0), Vec2::new(x + 0.9, 0.7));
        assert!((surface.height(at) - surface.height(next)).abs() < 1e-14);
    }
    let crest = Vec2::new(0.9 * (0.25 - 0.2 / TAU), 0.0);
    assert!((surface.height(crest) - 0.05).abs() < 1e-15);
    let wheel = Footprint { forward: Vec2::x(), half_length: 0.06, half_width: 0.05 };
    let deviation = |wavelength: f64| {
        let surface =
            Surface::Ripple(Ripple { amplitude: 0.05 * wavelength, wavelength, ..ripple });
        let terrain = surface;
        let normal = terrain.patch(Vec2::zeros(), wheel).normal;
        let gradient = surface.gradient(Vec2::zeros());
        (normal.x / normal.z + gradient.x).abs()
    };
    let (short, long) = (deviation(1.0), deviation(10.0));
    assert!(short > 1e-3 && (90.0..110.0).contains(&(short / long)), "{short} and {long}");
}

#[test]
fn a_ramp_climbs_from_one_level_to_the_other() {
    for rounding in [0.0, 0.8, 3.0] {
        let (ramp, uphill) = (ramp(rounding), Vec2::new(0.7_f64.cos(), 0.7_f64.sin()));
        let height = |s: f64| {
            Surface::Ramp(ramp)
                .height(ramp.foot + s * uphill + 2.0 * Vec2::new(-uphill.y, uphill.x))
        };
        let rise = deg(20.0).tan();
        assert_eq!(height(-2.0), 0.0);
        for (s, expected) in [(1.5, 1.5 * rise), (5.0, 3.0 * rise)] {
            assert!((height(s) - expected).abs() < 1e-12, "{rounding}: {} at {s}", height(s));
        }
        assert!((height(0.0) - rise * rounding / 8.0).abs() < 1e-12);
    }
}

/// Source: [Pike1977], as quoted in `Crater`; 31° is that of our profile.
#[test]
fn a_fresh_crater_has_its_depth_rim_and_walls() {
    let surface = Surface::Crater(Crater::fresh(Vec2::zeros(), 100.0));
    let height = |r: f64| surface.height(Vec2::new(0.6 * r, 0.8 * r));
    assert!((height(50.0) - height(0.0) - 19.6).abs() < 1e-12);
    assert!(
        (height(50.0) - 3.6).abs() < 1e-12 && height(75.7).abs() < 1e-12 && height(90.0) == 0.0
    );
    let slopes = (0..1000).map(|i| surface.gradient(Vec2::new(0.1 * f64::from(i), 0.0)).norm());
    let steepest = slopes.fold(0.0, f64::max).atan().to_degrees();
    assert!((steepest - 31.1).abs() < 0.1, "{steepest}");
    // The blanket as published, ∝ (R/r)³ less a constant.
    let published = |r: f64| {
        let [outer, inner] = [75.7_f64, 50.0].map(|r| r.powi(3));
        3.6 * (outer * inner / r.powi(3) - inner) / (outer - inner)
    };
    let apart = (50..=75).map(|r| height(f64::from(r)) - published(f64::from(r)));
    let (least, most) = apart.fold((0.0_f64, 0.0_f64), |(low, high), d| (low.min(d), high.max(d)));
    assert!((0.17..0.18).contains(&(most / 3.6)) && least > -0.08 * 3.6, "{least} to {most}");
}

/// The same ground as a formula and as heights at points: what a wheel meets converges with the
/// grid.
#[test]
fn an_elevation_model_of_a_surface_approaches_it() {
    let wheel = Footprint { forward: Vec2::x(), half_length: 0.06, half_width: 0.05 };
    for surface in surfaces() {
        let terrain = surface;
        let worst = |cells: usize| {
            let spacing = Vec2::new(8.0, 8.0) / cells as f64;
            let south_west = Vec2::new(-4.0, -4.0);
            let grid = ElevationGrid { columns: cells + 1, rows: cells + 1, south_west, spacing };
            let heights = grid.points().map(|at| surface.height(at));
            let model = ElevationModel::new(grid, heights).expect("a model");
            let places = (0..400)
                .map(|i| 3.5 * Vec2::new((1.7 * f64::from(i)).sin(), (2.9 * f64::from(i)).cos()));
            places.fold(0.0_f64, |worst, at| {
                let (exact, near) = (terrain.patch(at, wheel), model.patch(at, wheel));
                worst.max((exact.normal - near.normal).norm())
            })
        };
        let (coarse, fine) = (worst(40), worst(160));
        // Four times finer: of second order where the surface is smooth, of first where its
        // curvature jumps.
        assert!(fine < coarse / 3.0 || coarse < 1e-6, "{surface:?}: {coarse:e} and {fine:e}");
    }
}

#[test]
fn what_is_no_surface_is_refused() {
    let usual = Crater::fresh(Vec2::zeros(), 4.0);
    let ripple = Ripple { amplitude: 0.1, wavelength: 1.0, across: 0.0, phase: 0.0 };
    let wrong = [
        (Surface::Incline(Incline { slope: 1.6, uphill: 0.0 }), "slope"),
        (Surface::Incline(Incline { slope: 0.1, uphill: f64::NAN }), "uphill"),
        (Surface::Ramp(ramp(3.1)), "rounding"),
        (Surface::Ramp(Ramp { length: 0.0, ..ramp(0.0) }), "length"),
        (Surface::Cone(Cone { tip: Vec2::zeros(), slope: -1.6, rounding: 0.0 }), "slope"),
        (Surface::Ripple(Ripple { wavelength: 0.0, ..ripple }), "wavelength"),
        (Surface::Crater(Crater { diameter: -4.0, ..usual }), "diameter"),
        (Surface::Crater(Crater { rim_width: 0.0, ..usual }), "rim"),
    ];
    for (surface, name) in wrong {
        let error = surface.check().expect_err("refused");
        assert!(error.name.contains(name), "{error}");
        assert!(surface.check().is_err());
    }
}
