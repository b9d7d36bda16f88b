//! Bands that were written are read again.

use grouser::answers::map::VerdictCounts;
use grouser::document::columns::map::{bands, chosen};
use grouser::document::{self, Overrides, Source};
use grouser::studies::mobility::{CourseChoice, Ground, MobilityMap};
use grouser::studies::verdict::SlopeStudy;
use grouser_core::terrain::ElevationGrid;
use grouser_core::units::{Vec2, deg};
use grouser_map::{Look, style, summaries, write_band};
use grouser_raster::{CoordinateSystem, Raster, ReadOptions};

/// A dome with a gap, of more than one tile.
fn dome() -> Raster {
    let grid = ElevationGrid {
        columns: 700,
        rows: 530,
        south_west: Vec2::new(10_000.25, -400.5),
        spacing: Vec2::new(0.5, 0.75),
    };
    let middle = 0.5 * (grid.extent().south_west + grid.extent().north_east);
    #[expect(clippy::cast_possible_truncation, reason = "heights of a test")]
    let mut heights: Vec<f32> =
        grid.points().map(|at| -((at - middle).norm_squared() / 1200.0) as f32).collect();
    heights[40 * 700 + 13] = f32::NAN;
    Raster {
        grid,
        base: 1700.0,
        heights,
        coordinates: CoordinateSystem::default(),
        remarks: Vec::new(),
    }
}

fn map(choice: CourseChoice) -> (SlopeStudy, MobilityMap) {
    let scenario =
        document::read_scenario(&Source::default_scenario(), &Overrides::none()).unwrap();
    let study = SlopeStudy::of(&scenario);
    let map = MobilityMap::of(&study, choice, deg(30.0), &[], &|| true).unwrap().unwrap();
    (study, map)
}

#[test]
fn bands_lie_where_the_heights_do_and_have_their_numbers() {
    let (raster, place) = (dome(), tempfile::tempdir().unwrap());
    let (study, map) = map(CourseChoice::Fixed(0.2));
    let ground = Ground::under(&study.heading.rover, &raster);
    for band in bands() {
        let file = place.path().join(format!("{}.tif", band.name));
        let told = std::sync::atomic::AtomicU64::new(0);
        let tell = |cells| {
            told.fetch_add(cells, std::sync::atomic::Ordering::Relaxed);
        };
        write_band(&file, ground, &map, &band, &tell).unwrap();
        assert_eq!(told.into_inner(), 700 * 530);
        let read = grouser_raster::read(&file, &ReadOptions::default()).unwrap();
        assert_eq!(read.grid, raster.grid);
        for (column, row) in [(0, 0), (350, 265), (699, 529), (600, 10), (13, 41), (200, 520)] {
            let expected = ground.at(&map, column, row).map(|cell| band.number(&cell));
            let expected = expected.filter(|number| !number.is_nan());
            match (expected, read.height(column, row)) {
                (Some(one), Some(other)) => {
                    assert!(
                        (one - other).abs() <= 1e-6 * one.abs().max(1.0),
                        "{}: {one} {other}",
                        band.name
                    );
                }
                (one, other) => assert_eq!(one, other, "{} {column} {row}", band.name),
            }
        }
        assert_eq!(read.height(13, 40), None, "{}", band.name);
    }
}

/// A second writing gives the same bytes.
#[test]
fn a_band_is_the_same_to_the_byte() {
    let (raster, place) = (dome(), tempfile::tempdir().unwrap());
    let (study, map) = map(CourseChoice::Best);
    let ground = Ground::under(&study.heading.rover, &raster);
    let bytes = |name: &str| {
        let file = place.path().join(name);
        write_band(&file, ground, &map, &chosen()[0], &|_| ()).unwrap();
        std::fs::read(file).unwrap()
    };
    assert_eq!(bytes("one.tif"), bytes("other.tif"));
}

/// Overviews come after the image and get smaller, down to one tile.
#[test]
fn a_file_is_cloud_optimised() {
    let (raster, place) = (dome(), tempfile::tempdir().unwrap());
    let (study, map) = map(CourseChoice::Fixed(0.0));
    let file = place.path().join("slope.tif");
    write_band(&file, Ground::under(&study.heading.rover, &raster), &map, &bands()[0], &|_| ())
        .unwrap();
    let tiff = tiff_reader::TiffFile::open(&file).unwrap();
    let sizes: Vec<_> = tiff.ifds().iter().map(|ifd| (ifd.width(), ifd.height())).collect();
    assert_eq!(sizes, [(700, 530), (350, 265)]);
    assert!(tiff.ifds().iter().all(tiff_reader::Ifd::is_tiled));
    let first = |place: usize| tiff.ifds()[place].tile_offsets().unwrap()[0];
    assert!(first(1) < first(0), "the overview's tiles come first");
}

#[test]
fn summaries_count_every_place_once() {
    let raster = dome();
    let (study, map) = map(CourseChoice::Fixed(0.0));
    let (of, verdicts) = summaries(Ground::under(&study.heading.rover, &raster), &map, &bands());
    let VerdictCounts { go, caution, cannot_tell, no_go, unknown } = verdicts;
    assert_eq!(go + caution + cannot_tell + no_go + unknown, 700 * 530);
    assert_eq!(unknown, 1);
    assert_eq!(of[0].known, 700 * 530 - 1);
    assert!(of[0].least < of[0].mean && of[0].mean < of[0].most);
    let text = style(Look::of("slope_deg"), &of[0], "slope [°]");
    assert!(
        text.contains("singlebandpseudocolor") && text.contains("classificationMax=\"30\""),
        "{text}"
    );
    let text = style(Look::of("verdict"), &of[6], "verdict");
    assert!(text.contains("paletted") && text.matches("<paletteEntry").count() == 4, "{text}");
}
