use grouser_core::units::Vec2;
use grouser_raster::{Fault, Placement, ReadOptions, RowOrder, npy};

/// A file of that version, with a header and numbers.
fn file(version: u8, header: &str, numbers: &[u8]) -> Vec<u8> {
    let mut file = b"\x93NUMPY".to_vec();
    file.extend([version, 0]);
    let length = u32::try_from(header.len()).expect("short");
    let length = length.to_le_bytes();
    file.extend(&length[..if version == 1 { 2 } else { 4 }]);
    file.extend(header.bytes());
    file.extend(numbers);
    file
}

fn header(descr: &str, by_columns: bool, shape: &str) -> String {
    let order = if by_columns { "True" } else { "False" };
    format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}    \n")
}

fn placed() -> ReadOptions {
    let placement = Placement::north_first(Vec2::new(10.0, 20.0), 0.5);
    ReadOptions { placement: Some(placement), ..ReadOptions::default() }
}

/// What NumPy says of `[[1, 2, 3], [4, 5, 6]]`, of any type and order.
#[test]
fn numbers_of_every_kind_are_read() {
    let rows = [1_u8, 2, 3, 4, 5, 6];
    let columns = [1_u8, 4, 2, 5, 3, 6];
    let bytes = |descr: &str, numbers: [u8; 6]| -> Vec<u8> {
        let of = |number: u8| match &descr[1..] {
            "f4" => f32::from(number).to_be_bytes().to_vec(),
            "f8" => f64::from(number).to_be_bytes().to_vec(),
            kind => {
                let size: usize = kind[1..].parse().expect("a size");
                (1..size).map(|_| 0).chain([number]).collect()
            }
        };
        let turned = |mut bytes: Vec<u8>| {
            if !descr.starts_with('>') {
                bytes.reverse();
            }
            bytes
        };
        numbers.into_iter().flat_map(|number| turned(of(number))).collect()
    };
    let kinds = ["f4", "f8", "i2", "i4", "i8", "u2", "u4", "u8"];
    let sided = kinds.iter().flat_map(|kind| [format!("<{kind}"), format!(">{kind}")]);
    for (index, descr) in sided.chain(["|i1".into(), "|u1".into()]).enumerate() {
        for (by_columns, numbers) in [(false, rows), (true, columns)] {
            let version = [1, 2, 3][index % 3];
            let file =
                file(version, &header(&descr, by_columns, "(2, 3)"), &bytes(&descr, numbers));
            let raster = npy::decode(&file, &placed()).unwrap_or_else(|e| panic!("{descr}: {e}"));
            let heights = [0, 1].map(|row| [0, 1, 2].map(|column| raster.height(column, row)));
            // The first row is the northern one.
            let expected = [[4.0, 5.0, 6.0], [1.0, 2.0, 3.0]].map(|row| row.map(Some));
            assert_eq!(heights, expected, "{descr}");
            assert_eq!(raster.grid.extent().north_east, Vec2::new(11.0, 20.5));
        }
    }
}

#[test]
fn rows_may_come_from_the_south_and_heights_be_missing() {
    let mut options = placed();
    options.placement = options.placement.map(|p| Placement { rows: RowOrder::SouthFirst, ..p });
    options.missing = Some(-9999.0);
    let numbers = [1.0, f64::NAN, -9999.0, 4.0].map(f64::to_le_bytes).concat();
    let file = file(1, &header("<f8", false, "(2, 2)"), &numbers);
    let raster = npy::decode(&file, &options).expect("read");
    let heights = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(c, r)| raster.height(c, r));
    assert_eq!(heights, [Some(1.0), None, None, Some(4.0)]);
}

#[test]
fn what_is_no_array_of_heights_is_refused() {
    let numbers = [0; 64];
    for (descr, shape, words) in [
        ("<c8", "(2, 2)", "NumPy's type <c8"),
        ("<f2", "(2, 2)", "NumPy's type <f2"),
        ("|O", "(2, 2)", "|O"),
        ("<f4", "(16,)", "1 axes"),
        ("<f4", "(2, 2, 2)", "3 axes"),
        ("<f4", "(-2, 2)", "whole numbers"),
        ("<f4", "(4, 5)", "promises 80 bytes of heights, and the file has"),
        ("<f4", "(1000000, 1000000)", "at most 16777216"),
        ("<f4", "(99999999999999999999, 1)", "whole numbers"),
        ("<f4", "(0, 4)", "none of the 0 heights"),
    ] {
        let file = file(1, &header(descr, false, shape), &numbers);
        let text = npy::decode(&file, &placed()).expect_err("refused").to_string();
        assert!(text.contains(words), "{text}");
    }
    let usual = header("<f4", false, "(4, 4)");
    for (file, words) in [
        (file(9, &usual, &numbers), "version 9"),
        (file(1, &usual.replace("descr", "describe"), &numbers), "no descr"),
        (file(1, &usual.replace("False", "No"), &numbers), "fortran_order"),
        (file(1, &usual.replace("'<f4'", "[('a', '<f4')]"), &numbers), "several fields"),
        (file(1, &usual.replace('(', "["), &numbers), "brackets"),
        (b"\x93NUMPY\x02\0\xff\xff\xff\xff".to_vec(), "4294967295 bytes long"),
        (b"\x93NUMPY\x01\0\x76\0{'descr'".to_vec(), "ends within it"),
    ] {
        let text = npy::decode(&file, &placed()).expect_err("refused").to_string();
        assert!(text.contains(words), "{text}");
    }
    let error = npy::decode(&file(1, &usual, &numbers), &ReadOptions::default());
    assert!(matches!(error, Err(Fault::NotPlaced)), "{error:?}");
}
