//! Lunar ground by chance: files that open with the heights of the library, the same bytes each
//! time, and limits.

use std::fs;

use grouser::terrain::lunar::LunarSite;
use grouser_raster::{Raster, ReadOptions};

use crate::bad_input::check_is_refusal;
use crate::program::{Place, number};

fn opened(place: &Place, name: &str) -> Raster {
    grouser_raster::read(&place.file(name), &ReadOptions::default()).expect("it opens")
}

#[test]
fn both_forms_of_file_have_the_heights_of_the_library() {
    let place = Place::new();
    let line = "terrain moon --size-m 40 --cell-size-m 0.5 --largest-crater-m 20 --seed 7 --out";
    let answer = place.json(&format!("{line} site.tif"));
    place.results(&format!("{line} site.xyz"));
    let site = LunarSite { largest_crater: 20.0, ..LunarSite::new(40.0, 0.5, 7) };
    let model = site.model().unwrap();
    assert_eq!(answer["craters"], model.craters.len());
    assert_eq!(number(&answer["expected_craters"]), site.expected_craters());
    for name in ["site.tif", "site.xyz"] {
        let raster = opened(&place, name);
        assert_eq!((raster.grid.columns, raster.grid.rows), (81, 81));
        assert_eq!((raster.grid.south_west.x, raster.grid.spacing.x), (-20.0, 0.5), "{name}");
        for (column, row) in [(0, 0), (80, 0), (3, 70), (80, 80)] {
            let difference = raster.height(column, row).unwrap() - model.heights[row * 81 + column];
            // Single precision, of heights up to hundreds of metres.
            assert!(difference.abs() < 2e-5, "{name}: {difference}");
        }
    }
    let system = opened(&place, "site.tif").coordinates;
    assert_eq!(system.name(), "made lunar ground (no place of the Moon)");
}

#[test]
fn a_seed_gives_the_same_bytes_and_an_old_file_stays() {
    let place = Place::new();
    let line = "terrain moon --size-m 100 --ground highlands --seed 3 --out";
    for name in ["one.tif", "other.tif"] {
        place.results(&format!("{line} {name}"));
    }
    let bytes = |name: &str| fs::read(place.file(name)).unwrap();
    assert_eq!(bytes("one.tif"), bytes("other.tif"));
    let refused = check_is_refusal(&place.line(&format!("{line} one.tif")), 2);
    assert!(refused.contains("one.tif exists already"), "{refused}");
    place.results("terrain moon --size-m 100 --seed 4 --out one.tif --force");
    assert_ne!(bytes("one.tif"), bytes("other.tif"));
}

#[test]
fn what_cannot_be_made_is_refused_with_the_limit() {
    let place = Place::new();
    for (flags, words) in [
        ("--size-m 1e9", "number of cells along a side is 1000000000, it must be 8 to 4096"),
        ("--size-m nan", "size of the site [m] is NaN"),
        ("--size-m -5", "size of the site [m] is -5"),
        ("--cell-size-m 1e-300", "8 to 4096"),
        ("--size-m 30000 --cell-size-m 20", "20000 at most"),
        ("--crater-share 2", "share of craters [-] is 2, it must be 0 to 1"),
        (
            "--largest-crater-m 2",
            "diameter of the largest crater [m] is 2, it must be four cells or more",
        ),
        ("--largest-crater-m inf", "300 at most"),
    ] {
        let refused =
            check_is_refusal(&place.line(&format!("terrain moon {flags} --out site.tif")), 2);
        assert!(refused.contains(words), "{flags}: {refused}");
    }
    let refused = check_is_refusal(&place.line("terrain moon --out site.png"), 2);
    assert!(refused.contains("must end with .tif"), "{refused}");
    assert!(place.names().is_empty());
}
