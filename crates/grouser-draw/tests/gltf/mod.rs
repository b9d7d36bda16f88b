//! Binary glTF, read back.

use serde_json::Value;

/// The two chunks of a glTF file.
pub(crate) fn chunks(file: &[u8]) -> (Value, &[u8]) {
    let word = |at: usize| {
        let bytes: [u8; 4] = file[at..at + 4].try_into().expect("four bytes");
        u32::from_le_bytes(bytes) as usize
    };
    assert_eq!((&file[..4], word(4), word(8)), (&b"glTF"[..], 2, file.len()));
    let text = word(12);
    assert!(&file[16..20] == b"JSON" && text.is_multiple_of(4));
    let start = 20 + text;
    assert_eq!((&file[start + 4..start + 8], word(start)), (&b"BIN\0"[..], file.len() - start - 8));
    (serde_json::from_slice(&file[20..start]).expect("JSON"), &file[start + 8..])
}

pub(crate) fn number(value: &Value) -> usize {
    value.as_u64().and_then(|number| usize::try_from(number).ok()).expect("a whole number")
}

/// The numbers of an accessor, and how many make one of its elements.
pub(crate) fn numbers(document: &Value, bytes: &[u8], accessor: usize) -> (Vec<f32>, usize) {
    let accessor = &document["accessors"][accessor];
    assert_eq!(number(&accessor["componentType"]), 5126);
    let size = match accessor["type"].as_str() {
        Some("VEC3") => 3,
        Some("VEC4") => 4,
        _ => 1,
    };
    let view = &document["bufferViews"][number(&accessor["bufferView"])];
    let (start, length) = (number(&view["byteOffset"]), number(&view["byteLength"]));
    assert!(start.is_multiple_of(4) && length == 4 * size * number(&accessor["count"]));
    let values = bytes[start..start + length].as_chunks::<4>().0;
    (values.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect(), size)
}
