//! Zones of soil: which lies where, and how much of each below a wheel.

use grouser_core::elementary::wide::sin_cos;
use grouser_core::paper;
use grouser_core::terrain::zones::{NO_ZONE, Share};
use grouser_core::terrain::{ElevationGrid, Footprint, SoilZones, ZonePolygon, ZonesError};
use grouser_core::units::{Vec2, deg};

fn soils(count: u8) -> Vec<grouser_core::soil::Soil> {
    let soil = |number: u8| {
        let friction_angle = deg(30.0 + f64::from(number));
        grouser_core::soil::Soil { friction_angle, ..paper::toyoura() }
    };
    (0..count).map(soil).collect()
}

/// The share of a soil below a footprint; of none for the ground outside of all zones.
fn share(zones: &SoilZones, soil: Option<usize>, at: Vec2, footprint: Footprint) -> f64 {
    let soil = soil.map(|soil| &zones.soils[soil]);
    let shares = zones.under(Vec2::zeros(), at, footprint);
    shares.iter().find(|share| share.soil == soil).map_or(0.0, |share| share.weight)
}

fn total(shares: &[Share<'_>]) -> f64 {
    shares.iter().map(|share| share.weight).sum()
}

fn wheel(heading: f64) -> Footprint {
    let (sin, cos) = sin_cos(heading);
    Footprint { forward: Vec2::new(cos, sin), half_length: 0.06, half_width: 0.04 }
}

fn rectangle(soil: usize, low: (f64, f64), high: (f64, f64)) -> ZonePolygon {
    let corners = [(low.0, low.1), (high.0, low.1), (high.0, high.1), (low.0, high.1)];
    ZonePolygon { soil: Some(soil), rings: vec![corners.map(|(x, y)| Vec2::new(x, y)).to_vec()] }
}

/// Numbers from 0 to 1 that repeat: a linear congruence by Knuth's constants.
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn random_place(random: &mut Random, size: f64) -> Vec2 {
    Vec2::new(size * random.uniform(), size * random.uniform())
}

#[test]
fn a_later_polygon_covers_an_earlier_one_and_rings_within_rings_are_holes() {
    let mut field = rectangle(0, (0.0, 0.0), (10.0, 10.0));
    field.rings.extend(rectangle(0, (4.0, 4.0), (6.0, 6.0)).rings);
    field.rings.extend(rectangle(0, (4.5, 4.5), (5.5, 5.5)).rings);
    let polygons = [field, rectangle(1, (8.0, 8.0), (12.0, 9.0))];
    let zones = SoilZones::from_polygons(&polygons, soils(2)).expect("zones");
    for (place, expected) in [
        ((1.0, 1.0), Some(0)),
        ((4.2, 5.0), None),
        ((5.0, 5.0), Some(0)),
        ((9.0, 8.5), Some(1)),
        ((9.0, 9.5), Some(0)),
        ((11.0, 8.5), Some(1)),
        ((11.0, 9.5), None),
        ((-1e9, 5.0), None),
        ((5.0, 1e9), None),
    ] {
        assert_eq!(zones.zone(Vec2::new(place.0, place.1)), expected, "{place:?}");
    }
}

/// Cells reach half a cell beyond their points; there and in gaps there is no zone.
#[test]
fn a_place_has_the_zone_of_the_nearest_point() {
    let grid = ElevationGrid {
        columns: 3,
        rows: 2,
        south_west: Vec2::new(100.0, -50.0),
        spacing: Vec2::new(2.0, 1.0),
    };
    let zones = SoilZones::from_grid(grid, vec![0, 1, NO_ZONE, 1, 0, 0], soils(2)).expect("zones");
    for (place, expected) in [
        ((99.1, -50.4), Some(0)),
        ((100.9, -50.0), Some(0)),
        ((101.1, -49.6), Some(1)),
        ((104.0, -50.0), None),
        ((104.9, -48.6), Some(0)),
        ((105.1, -49.0), None),
        ((98.9, -49.0), None),
        ((100.0, -48.4), None),
    ] {
        assert_eq!(zones.zone(Vec2::new(place.0, place.1)), expected, "{place:?}");
    }
}

/// ¾ (1 − a²) along the wheel, the same everywhere across it.
#[test]
fn shares_below_a_wheel_are_those_of_the_integral() {
    let zones = SoilZones::from_polygons(&[rectangle(0, (0.0, -9.0), (9.0, 9.0))], soils(1));
    let zones = zones.expect("zones");
    for part in [-1.2, -0.9, -0.3, 0.0, 0.5, 0.99, 1.3_f64] {
        let a = part.clamp(-1.0, 1.0);
        let ahead = 0.5 + 0.25 * a * (3.0 - a * a);
        let found = share(&zones, Some(0), Vec2::new(0.06 * part, 0.3), wheel(0.0));
        assert!((found - ahead).abs() < 1e-14, "{part}: {found} and {ahead}");
        // Seen from the side it is the part of the width.
        let found = share(&zones, Some(0), Vec2::new(0.04 * part, 0.3), wheel(deg(90.0)));
        assert!((found - 0.5 * (1.0 + a)).abs() < 1e-14, "{part}: {found}");
    }
}

/// Many small pieces of random polygons that cover and cross each other, in any heading.
#[test]
fn shares_of_crossing_polygons_are_those_of_small_pieces() {
    let mut random = Random(11);
    let mut most = 0;
    for _ in 0..60 {
        let polygons: Vec<ZonePolygon> = (0..3)
            .map(|soil| {
                let ring = (0..5).map(|_| random_place(&mut random, 0.3)).collect();
                ZonePolygon { soil: Some(soil), rings: vec![ring] }
            })
            .collect();
        let zones = SoilZones::from_polygons(&polygons, soils(3)).expect("zones");
        let (at, footprint) = (random_place(&mut random, 0.3), wheel(7.0 * random.uniform()));
        let shares = zones.under(Vec2::zeros(), at, footprint);
        assert!((total(&shares) - 1.0).abs() < 1e-13, "{shares:?}");
        most = most.max(shares.len());
        const PIECES: u32 = 200;
        let mut sums = [0.0; 4];
        let left = Vec2::new(-footprint.forward.y, footprint.forward.x);
        for (a, b) in (0..PIECES).flat_map(|a| (0..PIECES).map(move |b| (a, b))) {
            let [a, b] = [a, b].map(|it| (f64::from(it) + 0.5) / (0.5 * f64::from(PIECES)) - 1.0);
            let place = at + a * 0.06 * footprint.forward + b * 0.04 * left;
            let weight = 0.75 * (1.0 - a * a) * 2.0 / f64::from(PIECES * PIECES);
            sums[zones.zone(place).unwrap_or(3)] += weight;
        }
        for (soil, sum) in [Some(0), Some(1), Some(2), None].into_iter().zip(sums) {
            let found = share(&zones, soil, at, footprint);
            assert!((found - sum).abs() < 0.01, "{soil:?}: {found} and {sum}");
        }
    }
    assert!(most >= 3, "no wheel was on more than {most} soils");
}

/// Rectangles along the cells of a grid are the same zones, whatever the wheel's place and heading.
#[test]
fn a_raster_of_polygons_has_the_shares_of_the_polygons() {
    let polygons = [
        rectangle(0, (0.1, 0.1), (0.7, 0.6)),
        rectangle(1, (0.3, 0.2), (0.5, 0.9)),
        rectangle(2, (0.4, 0.4), (0.6, 0.5)),
    ];
    let by_polygons = SoilZones::from_polygons(&polygons, soils(3)).expect("zones");
    let south_west = Vec2::new(0.05, 0.05);
    let grid = ElevationGrid { columns: 10, rows: 9, south_west, spacing: Vec2::new(0.1, 0.1) };
    let cell = |at| by_polygons.zone(at).map_or(NO_ZONE, |zone| u8::try_from(zone).expect("few"));
    let by_grid = SoilZones::from_grid(grid, grid.points().map(cell).collect(), soils(3));
    let by_grid = by_grid.expect("zones");
    let mut random = Random(5);
    let mut several = 0;
    for _ in 0..500 {
        let (at, footprint) = (random_place(&mut random, 1.0), wheel(7.0 * random.uniform()));
        let [one, other] =
            [&by_polygons, &by_grid].map(|it| it.under(Vec2::zeros(), at, footprint));
        assert_eq!(one.len(), other.len(), "at {at}");
        several += usize::from(one.len() > 1);
        for (one, other) in one.iter().zip(&other) {
            assert_eq!(one.soil, other.soil);
            assert!((one.weight - other.weight).abs() < 1e-12, "{one:?} and {other:?}");
        }
    }
    assert!(several > 100, "{several}");
}

/// Turned and moved together, map and wheel have the shares that they had; a far origin costs no
/// precision.
#[test]
fn shares_turn_and_move_with_the_map() {
    let mut random = Random(3);
    for _ in 0..50 {
        let ring: Vec<Vec2> = (0..6).map(|_| random_place(&mut random, 0.3)).collect();
        let (at, heading) = (random_place(&mut random, 0.3), 7.0 * random.uniform());
        let turn = 7.0 * random.uniform();
        let (sin, cos) = sin_cos(turn);
        let turned = |at: Vec2| Vec2::new(cos * at.x - sin * at.y, sin * at.x + cos * at.y);
        let shares = |origin: Vec2, ring: Vec<Vec2>, at: Vec2, heading: f64| {
            let polygon = ZonePolygon { soil: Some(0), rings: vec![ring] };
            let zones = SoilZones::from_polygons(&[polygon], soils(1)).expect("zones");
            let shares = zones.under(origin, at, wheel(heading));
            shares.iter().filter(|it| it.soil.is_some()).map(|it| it.weight).sum::<f64>()
        };
        let one = shares(Vec2::zeros(), ring.clone(), at, heading);
        let there = ring.iter().map(|at| turned(*at)).collect();
        let other = shares(Vec2::zeros(), there, turned(at), heading + turn);
        assert!((one - other).abs() < 1e-12, "{one} and {other}");
        let origin = Vec2::new(524_288.0, -2_097_152.0);
        let far = ring.iter().map(|at| origin + at).collect();
        let other = shares(origin, far, at, heading);
        assert!((one - other).abs() < 1e-7, "{one} and {other}");
    }
}

/// Where very many borders lie below a wheel, shares are counted by points: nothing takes long, and
/// nothing is lost.
#[test]
fn very_many_borders_below_a_wheel_are_counted_by_points() {
    let spacing = Vec2::new(1e-3, 1e-3);
    let grid = ElevationGrid { columns: 400, rows: 400, south_west: Vec2::zeros(), spacing };
    let checks = (0..400 * 400).map(|cell| u8::from((cell / 400 + cell % 400) % 2 == 1)).collect();
    let fine = SoilZones::from_grid(grid, checks, soils(2)).expect("zones");
    let star: Vec<Vec2> = (0..3_000)
        .map(|corner| {
            let (sin, cos) = sin_cos(f64::from(corner) * 3.13);
            Vec2::new(0.2 + 0.1 * cos, 0.2 + 0.1 * sin)
        })
        .collect();
    let star = [ZonePolygon { soil: Some(1), rings: vec![star] }];
    let star = SoilZones::from_polygons(&star, soils(2)).expect("zones");
    for zones in [&fine, &star] {
        for heading in [0.0, 0.4] {
            let shares = zones.under(Vec2::zeros(), Vec2::new(0.2, 0.2), wheel(heading));
            assert!((total(&shares) - 1.0).abs() < 1e-13);
            let half = share(zones, Some(1), Vec2::new(0.2, 0.2), wheel(heading));
            assert!((0.3..0.7).contains(&half), "{half}");
        }
    }
}

#[test]
fn what_are_no_zones_says_so() {
    let grid = ElevationGrid {
        columns: 2,
        rows: 2,
        south_west: Vec2::zeros(),
        spacing: Vec2::new(1.0, 1.0),
    };
    let by_grid = |zones: Vec<u8>| SoilZones::from_grid(grid, zones, soils(2)).expect_err("wrong");
    assert_eq!(by_grid(vec![0, 1, 2, 0]), ZonesError::NoSoil { zone: 2, soils: 2 });
    assert_eq!(by_grid(vec![0]), ZonesError::Count { columns: 2, rows: 2, given: 1 });
    let by_polygon = |corners: Vec<Vec2>| {
        let polygon = ZonePolygon { soil: Some(0), rings: vec![corners] };
        SoilZones::from_polygons(&[polygon], soils(1)).expect_err("wrong")
    };
    let line = vec![Vec2::zeros(), Vec2::x()];
    assert_eq!(by_polygon(line), ZonesError::Ring { polygon: 1, corners: 2 });
    let nowhere = vec![Vec2::zeros(), Vec2::x(), Vec2::new(0.0, f64::INFINITY)];
    assert_eq!(by_polygon(nowhere), ZonesError::Corner { polygon: 1, x: 0.0, y: f64::INFINITY });
    let none = SoilZones::from_polygons(&[rectangle(1, (0.0, 0.0), (1.0, 1.0))], soils(1));
    assert_eq!(none.expect_err("wrong"), ZonesError::NoSoil { zone: 1, soils: 1 });
}
