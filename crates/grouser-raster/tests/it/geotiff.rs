use grouser_core::units::Vec2;
use grouser_raster::{Fault, Placement, Raster, ReadOptions, geotiff, read};

use crate::ground;

fn raster(name: &str) -> Raster {
    read(&ground::fixture(name), &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn refused(name: &str) -> String {
    let error = read(&ground::fixture(name), &ReadOptions::default()).expect_err("refused");
    let text = error.to_string();
    assert!(text.contains(name), "{text}");
    text
}

/// Tiles, strips, BigTIFF, either byte order; deflate, LZW, Zstandard; nodata as a number, as NaN
/// and as a mask; with the heights that GDAL wrote.
#[test]
fn heights_are_those_that_were_written() {
    for name in [
        "tiled-deflate-f32.tif",
        "strips-lzw-f64.tif",
        "big-point-i16.tif",
        "big-endian-zstd-f32.tif",
        "masked-f32.tif",
    ] {
        let raster = raster(name);
        ground::check(&raster, 0.0, ground::height);
        // The middle of the cell in the south-west.
        let south_west = Vec2::new(500_001.5, 5_200_060.25 - 59.0);
        assert_eq!(raster.grid.south_west, south_west, "{name}");
        assert_eq!(raster.grid.spacing, Vec2::new(2.0, 2.0));
        assert_eq!(raster.coordinates.epsg(), Some(32633));
        assert_eq!(raster.coordinates.name(), "WGS 84 / UTM zone 33N");
    }
}

/// Blocks that were never written are missing, and no heights of zero.
#[test]
fn blocks_that_were_not_written_are_missing() {
    let is_sparse = |column, row| row < 16 && (16..32).contains(&column);
    ground::check(&raster("sparse-f32.tif"), 0.0, |column, row| {
        ground::height(column, row).filter(|_| !is_sparse(column, row))
    });
}

/// Cloud-optimised files are read at full resolution, and a system of the Moon that no register has
/// is carried along.
#[test]
fn cloud_optimised_files_of_the_moon_are_read() {
    for (name, within) in [
        ("moon-cog-deflate-f32.tif", 0.0),
        ("moon-cog-lerc-f32.tif", 0.0),
        ("moon-cog-lerc-deflate-f32.tif", 0.001),
    ] {
        let raster = raster(name);
        ground::check(&raster, within, ground::height);
        assert_eq!(raster.grid.south_west, Vec2::new(-19_999.0, 30_000.0 - 59.0), "{name}");
        assert_eq!(raster.coordinates.epsg(), None);
        let name = raster.coordinates.name();
        assert_eq!(name, "a system without a name, on a body of radius 1737400 m");
        assert!(raster.coordinates.keys().doubles.contains(&1_737_400.0));
    }
}

#[test]
fn a_model_of_a_file_has_its_gaps() {
    let raster = raster("tiled-deflate-f32.tif");
    let missing = raster.heights.iter().filter(|height| height.is_nan()).count();
    assert_eq!(missing, 3);
    assert_eq!(raster.base, -2613.0);
}

/// A picture whose first row is the southern one is read as such.
#[test]
fn south_may_be_up() {
    let raster = raster("south-up.tif");
    assert_eq!(raster.grid.south_west, Vec2::new(101.0, 201.0));
    assert_eq!((raster.height(0, 0), raster.height(3, 3)), (Some(0.0), Some(15.0)));
}

#[test]
fn what_is_no_map_in_metres_is_refused_with_the_command_that_helps() {
    for (name, words) in [
        ("degrees-earth.tif", &["degrees", "gdalwarp -t_srs \"EPSG:32632\" -tr 30.9 30.9"][..]),
        ("degrees-moon.tif", &["+proj=stere +lat_0=-89.4", "+R=1737400 ", "-tr 29.6 29.6"]),
        ("rotated.tif", &["rotated", "gdalwarp -r cubic ", "rotated.tif OUT.tif"]),
        ("feet.tif", &["coordinates are in US survey feet", "gdalwarp", "+units=m"]),
        ("heights-in-feet.tif", &["heights are in ft", "gdal_calc.py", "\"A*0.3048\""]),
        ("three-bands.tif", &["3 bands", "gdal_translate -b 1"]),
        ("complex.tif", &["complex numbers", "-ot Float32"]),
        ("big-endian-lerc-i16.tif", &["LERC in a big-endian file", "gdal_translate"]),
        ("no-place.tif", &["no georeference", "cell size"]),
    ] {
        let text = refused(name);
        assert!(words.iter().all(|word| text.contains(word)), "{text}");
    }
}

#[test]
fn a_band_can_be_chosen() {
    let read = |band| {
        let options = ReadOptions { band: Some(band), ..ReadOptions::default() };
        read(&ground::fixture("three-bands.tif"), &options)
    };
    // The north-western cell.
    assert_eq!(read(2).expect("a band").height(0, 3), Some(100.0));
    for band in [0, 4] {
        let error = read(band).expect_err("refused");
        assert!(matches!(error.fault, Fault::NoBand { bands: 3, .. }), "{error}");
    }
}

#[test]
fn a_picture_can_be_placed() {
    let placement = Placement::north_first(Vec2::new(7.0, 8.0), 0.5);
    let options = ReadOptions { placement: Some(placement), ..ReadOptions::default() };
    let raster = read(&ground::fixture("no-place.tif"), &options).expect("placed");
    assert_eq!(raster.grid.extent().north_east, Vec2::new(8.5, 9.5));
    assert_eq!((raster.height(0, 0), raster.height(0, 3)), (Some(12.0), Some(0.0)));
    assert!(!raster.coordinates.is_known());
}

#[test]
fn a_height_can_be_declared_missing() {
    let options = ReadOptions { missing: Some(5.0), ..ReadOptions::default() };
    let raster = read(&ground::fixture("south-up.tif"), &options).expect("read");
    assert_eq!((raster.height(1, 1), raster.height(2, 1)), (None, Some(6.0)));
}

/// A little-endian TIFF without compression, of one strip.
fn tiff(width: u32, height: u32, bytes: &[u8]) -> Vec<u8> {
    const SHORT: u16 = 3;
    const LONG: u16 = 4;
    const DOUBLE: u16 = 12;
    let entries: [(u16, u16, u32, u32); 11] = [
        (256, LONG, 1, width),
        (257, LONG, 1, height),
        (258, SHORT, 1, 32),
        (259, SHORT, 1, 1),
        (262, SHORT, 1, 1),
        (273, LONG, 1, 300),
        (278, LONG, 1, height),
        (279, LONG, 1, u32::try_from(bytes.len()).expect("few")),
        (339, SHORT, 1, 3),
        (33550, DOUBLE, 3, 180),
        (33922, DOUBLE, 6, 204),
    ];
    let mut file = b"II*\0\x08\0\0\0".to_vec();
    file.extend(11_u16.to_le_bytes());
    for (tag, kind, count, value) in entries {
        file.extend(tag.to_le_bytes().into_iter().chain(kind.to_le_bytes()));
        file.extend(count.to_le_bytes().into_iter().chain(value.to_le_bytes()));
    }
    file.resize(180, 0);
    for value in [1.0_f64, 1.0, 0.0, 0.0, 0.0, 0.0, 100.0, 200.0, 0.0] {
        file.extend(value.to_le_bytes());
    }
    file.resize(300, 0);
    file.extend(bytes);
    file
}

#[test]
fn a_header_that_promises_too_much_is_refused() {
    let heights: Vec<u8> = (0..6_u8).flat_map(|i| f32::from(i).to_le_bytes()).collect();
    let good = geotiff::decode(tiff(3, 2, &heights), &ReadOptions::default()).expect("a grid");
    assert_eq!(good.grid.south_west, Vec2::new(100.5, 198.5));
    assert_eq!(good.height(0, 1), Some(0.0));
    let decode = |width, height, cells| {
        let options = ReadOptions { cells, ..ReadOptions::default() };
        geotiff::decode(tiff(width, height, &heights), &options).expect_err("refused")
    };
    let small = decode(16_000, 16_000, None);
    assert!(matches!(small, Fault::TooLarge { limit: 0x100_0000, .. }), "{small}");
    assert!(small.hint(None).is_some_and(|it| it.contains("gdal_translate -projwin")), "{small}");
    let huge = decode(1_000_000, 1_000_000, None);
    assert!(matches!(huge, Fault::TooLarge { .. }), "{huge}");
    assert!(huge.hint(None).is_some_and(|it| it.contains("gdal_translate -projwin")), "{huge}");
    let long = decode(16_000, 16_000, Some(1 << 28));
    assert!(matches!(long, Fault::Truncated { promised: 1_024_000_000, .. }), "{long}");
    let options = ReadOptions { cells: Some(5), ..ReadOptions::default() };
    let few = geotiff::decode(tiff(3, 2, &heights), &options).expect_err("refused");
    assert!(matches!(few, Fault::TooLarge { limit: 5, .. }), "{few}");
    let nothing = geotiff::decode(tiff(0, 2, &heights), &ReadOptions::default());
    assert!(nothing.is_err());
    // One strip of 2³¹ rows.
    let mut block = tiff(3, 2, &heights);
    let rows_in_a_strip = 10 + 6 * 12 + 8;
    block[rows_in_a_strip + 3] = 0x80;
    assert!(geotiff::decode(block, &ReadOptions::default()).is_ok());
    let tiles = ground::fixture("tiled-deflate-f32.tif");
    let mut tiles = std::fs::read(tiles).expect("a fixture");
    let entry = [0x43, 1, 3, 0, 1, 0, 0, 0, 16, 0];
    // GDAL wrote its list of tags anew: the last one counts.
    let at = tiles.windows(entry.len()).rposition(|bytes| bytes == entry).expect("a tile's length");
    // Its value, and that of the width before it.
    for value in [at + 8, at - 4] {
        tiles[value..value + 2].copy_from_slice(&[0xf0, 0xff]);
    }
    let vast = geotiff::decode(tiles, &ReadOptions::default()).expect_err("refused");
    assert!(vast.to_string().contains("65520 × 65520 cells"), "{vast}");
}

#[test]
fn a_file_without_a_known_height_is_refused() {
    let nan: Vec<u8> = [f32::NAN, f32::INFINITY, -3.4e38, f32::NAN].map(f32::to_le_bytes).concat();
    let error = geotiff::decode(tiff(2, 2, &nan), &ReadOptions::default()).expect_err("refused");
    assert!(error.to_string().contains("none of the 4 heights is known"), "{error}");
}

#[test]
fn files_that_are_not_there_or_empty_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let read = |name: &str| read(&folder.path().join(name), &ReadOptions::default());
    assert!(matches!(read("none.tif").expect_err("none").fault, Fault::Disk(_)));
    for (name, content, words) in [
        ("empty.tif", &b""[..], "is empty"),
        ("short.tif", b"II*\0", "gdal_translate"),
        ("other.tif", b"\x89PNG\0\0\0", "is none of GeoTIFF, .npy and xyz"),
        ("DTEEC.IMG", b"PDS_VERSION_ID = PDS3\r\n", "DTEEC.IMG OUT.tif"),
    ] {
        std::fs::write(folder.path().join(name), content).expect("written");
        let text = read(name).expect_err("refused").to_string();
        assert!(text.contains(name) && text.contains(words), "{text}");
    }
}
