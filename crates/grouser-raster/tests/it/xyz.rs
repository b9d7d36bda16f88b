use grouser_core::units::Vec2;
use grouser_raster::{Fault, Raster, ReadOptions, read, xyz};

fn decode(text: &str) -> Result<Raster, Fault> {
    xyz::decode(text.as_bytes(), &ReadOptions::default())
}

/// The line and the words of a refusal.
fn refused(text: &str, line: usize, words: &str) {
    match decode(text) {
        Err(Fault::Line { line: found, flaw }) => {
            assert_eq!(found, line, "{flaw}");
            assert!(flaw.problem.contains(words), "{flaw}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn points_in_any_order_and_form_make_a_grid() {
    for text in [
        "0 0 1\n1 0 2\n2 0 3\n0 1 4\n1 1 5\n2 1 6\n",
        "\u{feff}X,Y,Z\n2,1,6\r\n0,0,1\r\n1,1,5\r\n0,1,4\r\n2,0,3\r\n1,0,2",
        "# heights\n0\t0\t1\t99\n\n// more\n1\t0\t2\n2;0;3\n 0  1  4\n1, 1, 5\n2e0 1.0 +6\n",
    ] {
        let raster = decode(text).expect("a grid");
        let heights = [0, 1].map(|row| [0, 1, 2].map(|column| raster.height(column, row)));
        assert_eq!(heights, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]].map(|row| row.map(Some)), "{text}");
    }
}

#[test]
fn a_grid_may_have_gaps() {
    let raster = decode("500000 10 1\n500005 10 nan\n500005 20 4\n500015 25 7\n").expect("a grid");
    assert_eq!(raster.grid.spacing, Vec2::new(5.0, 5.0));
    assert_eq!((raster.grid.columns, raster.grid.rows), (4, 4));
    assert_eq!(raster.grid.south_west, Vec2::new(500_000.0, 10.0));
    assert_eq!(raster.height(3, 3), Some(7.0));
    assert_eq!((raster.height(1, 0), raster.height(2, 2)), (None, None));
}

#[test]
fn lines_that_are_no_points_are_refused_by_their_number() {
    refused("0 0 1\n1 0 2\n0 0 3\n1 1 4\n", 3, "was there before");
    refused("0 0 1\n1 0 2\nx 1 3\n1 1 4\n", 3, "x is no number: x");
    refused("0 0 1\n1 0\n", 2, "it has no z");
    refused("0 0 1\n1 inf 2\n", 2, "finite");
    refused("0 0 1\n1 0 2\n2 0 3\n3 0 4\n4 0 4\n1.4 1 5\n", 6, "1 m apart");
    refused("0 0 1\n0 1 2\n0 2 3\n", 1, "a line, not a grid");
    refused(&format!("0 0 1\n{} 1 2\n", "1".repeat(2000)), 2, "longer than 1000 bytes");
}

#[test]
fn what_is_no_grid_is_refused() {
    assert!(matches!(decode(""), Err(Fault::NoPoints)));
    assert!(matches!(decode("# nothing\n"), Err(Fault::NoPoints)));
    let far = decode("0 0 1\n1 1 2\n2 2 1\n1e9 1e9 3\n");
    assert!(matches!(far, Err(Fault::TooLarge { .. })), "{far:?}");
    let few = decode("0 0 1\n1 1 2\n2 2 1\n999 999 3\n");
    assert!(matches!(few, Err(Fault::Sparse { points: 4, .. })), "{few:?}");
    assert!(decode("0 0 nan\n1 1 nan\n").expect_err("nothing").to_string().contains("is known"));
    let options = ReadOptions { cells: Some(3), ..ReadOptions::default() };
    let many = xyz::decode(&b"0 0 1\n1 0 1\n0 1 1\n1 1 1\n"[..], &options);
    assert!(matches!(many, Err(Fault::TooLarge { limit: 3, .. })), "{many:?}");
}

#[test]
fn text_is_told_by_its_content() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("heights.csv");
    std::fs::write(&path, "x;y;z\n0;0;1\n0;1;2\n1;0;3\n1;1;4\n").expect("written");
    let raster = read(&path, &ReadOptions::default()).expect("a grid");
    assert_eq!(raster.height(1, 1), Some(4.0));
    assert!(!raster.coordinates.is_known());
    assert_eq!(raster.coordinates.name(), "not stated");
}
