//! Columns of Arrow: their types, and what a batch has of them.

use std::io::{self, Read, Write as _};

use super::cell::{damage, quoted};
use super::flatbuffer::FlatTable;

/// No buffer unpacks to more [bytes].
const LARGEST_BUFFER: u64 = 128 << 20;

/// A column, with what the batch at hand has of it.
pub(super) struct ArrowColumn {
    pub(super) name: String,
    kind: ArrowKind,
    /// Buffers that it has in a batch, those of columns inside it too.
    pub(super) buffers: usize,
    /// Which rows have a value, a bit for each; none where all have.
    valid: Vec<u8>,
    /// Where texts begin and end.
    offsets: Vec<u8>,
    values: Vec<u8>,
}

/// What its values are.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ArrowKind {
    Half,
    Float,
    Double,
    /// Of so many bytes, with a sign or without; so many count a second, of a time.
    Whole {
        size: usize,
        has_sign: bool,
        per_second: Option<f64>,
    },
    Bit,
    /// With offsets of so many bytes.
    Text(usize),
    /// What has no number or text in each row, and is no telemetry.
    Other,
}

/// Types of Arrow by their numbers.
mod types {
    pub(super) const NULL: u8 = 1;
    pub(super) const INT: u8 = 2;
    pub(super) const FLOAT: u8 = 3;
    pub(super) const BINARY: u8 = 4;
    pub(super) const TEXT: u8 = 5;
    pub(super) const BOOL: u8 = 6;
    pub(super) const TIME: u8 = 9;
    pub(super) const TIMESTAMP: u8 = 10;
    pub(super) const INTERVAL: u8 = 11;
    pub(super) const LIST: u8 = 12;
    pub(super) const STRUCT: u8 = 13;
    pub(super) const FIXED_BINARY: u8 = 15;
    pub(super) const FIXED_LIST: u8 = 16;
    pub(super) const MAP: u8 = 17;
    pub(super) const DURATION: u8 = 18;
    pub(super) const LARGE_BINARY: u8 = 19;
    pub(super) const LARGE_TEXT: u8 = 20;
    pub(super) const LARGE_LIST: u8 = 21;
}

impl ArrowColumn {
    /// A column as a schema describes it; nothing of a type that is not known.
    pub(super) fn of(field: &FlatTable<'_>) -> Option<Self> {
        let kind = kind_of(field)?;
        let buffers = buffers_of(field, DEEPEST)?;
        let name = field.text(0).unwrap_or_default().to_owned();
        let [valid, offsets, values] = Default::default();
        Some(Self { name, kind, buffers, valid, offsets, values })
    }

    /// Takes its part of a batch.
    ///
    /// * `codec`: what the buffers are packed by, if they are
    pub(super) fn take(
        &mut self,
        buffers: &[&[u8]],
        codec: Option<u8>,
        rows: usize,
    ) -> io::Result<()> {
        let unpacked = |place: usize| {
            let buffer = buffers.get(place).copied().unwrap_or_default();
            codec.map_or_else(|| Ok(buffer.to_vec()), |codec| unpack(buffer, codec))
        };
        let (offset_size, bits) = match self.kind {
            ArrowKind::Other => return Ok(()),
            ArrowKind::Text(size) => (Some(size), 0),
            ArrowKind::Bit => (None, 1),
            ArrowKind::Half => (None, 16),
            ArrowKind::Float => (None, 32),
            ArrowKind::Double => (None, 64),
            ArrowKind::Whole { size, .. } => (None, 8 * size),
        };
        self.valid = unpacked(0)?;
        let is_short = |bytes: &[u8], bits: Option<usize>| {
            bits.is_none_or(|bits| bytes.len() < bits.div_ceil(8))
        };
        let mut short = !self.valid.is_empty() && is_short(&self.valid, Some(rows));
        if let Some(size) = offset_size {
            (self.offsets, self.values) = (unpacked(1)?, unpacked(2)?);
            short |= rows > 0 && is_short(&self.offsets, (rows + 1).checked_mul(8 * size));
        } else {
            self.values = unpacked(1)?;
            short |= is_short(&self.values, rows.checked_mul(bits));
        }
        if short { Err(damage("a column has fewer values than rows")) } else { Ok(()) }
    }

    /// Writes a cell of CSV.
    pub(super) fn write(&self, row: usize, text: &mut Vec<u8>) -> io::Result<()> {
        if self.kind == ArrowKind::Other {
            return text.write_all(b"no number");
        }
        if !self.valid.is_empty() && !bit(&self.valid, row) {
            return Ok(());
        }
        match self.kind {
            ArrowKind::Half => {
                write_number(text, half(u16::from_le_bytes(some(&self.values, row)?)))
            }
            ArrowKind::Float => {
                write_number(text, f64::from(f32::from_le_bytes(some(&self.values, row)?)))
            }
            ArrowKind::Double => write_number(text, f64::from_le_bytes(some(&self.values, row)?)),
            ArrowKind::Whole { size, has_sign, per_second } => {
                let number = whole(&self.values, row, size, has_sign)?;
                match per_second {
                    Some(count) => write_number(text, number as f64 / count),
                    None => write!(text, "{number}"),
                }
            }
            ArrowKind::Bit => write!(text, "{}", u8::from(bit(&self.values, row))),
            ArrowKind::Text(size) => {
                let [from, to] = [row, row + 1].map(|it| whole(&self.offsets, it, size, false));
                let place = |it: i128| usize::try_from(it).unwrap_or(usize::MAX);
                let bytes = self.values.get(place(from?)..place(to?));
                let found = bytes.and_then(|it| std::str::from_utf8(it).ok());
                write!(text, "{}", quoted(found.ok_or_else(|| damage("a text"))?))
            }
            ArrowKind::Other => Ok(()),
        }
    }
}

/// Columns within each other, at the most.
const DEEPEST: usize = 16;

/// Buffers of a field in a batch, those of its children too; nothing of a type that is not known.
fn buffers_of(field: &FlatTable<'_>, deepest: usize) -> Option<usize> {
    if field.table(4).is_some() {
        // Numbers of the values, which lie elsewhere.
        return Some(2);
    }
    let own = match field.byte(2)? {
        types::NULL => 0,
        types::STRUCT | types::FIXED_LIST => 1,
        types::INT..=types::FLOAT
        | types::BOOL..=types::INTERVAL
        | types::LIST
        | types::FIXED_BINARY
        | types::MAP
        | types::DURATION
        | types::LARGE_LIST => 2,
        types::BINARY | types::TEXT | types::LARGE_BINARY | types::LARGE_TEXT => 3,
        _ => return None,
    };
    let children = field.tables(5).unwrap_or_default();
    let deeper = deepest.checked_sub(1)?;
    children.iter().try_fold(own, |sum, child| Some(sum + buffers_of(child, deeper)?))
}

fn kind_of(field: &FlatTable<'_>) -> Option<ArrowKind> {
    if field.table(4).is_some() {
        return Some(ArrowKind::Other);
    }
    let about = field.table(3);
    let short = |place: usize, usual: i16| about.and_then(|it| it.short(place)).unwrap_or(usual);
    let time = |size: usize, unit: i16| {
        let per_second = [1.0, 1e3, 1e6, 1e9].get(usize::try_from(unit).ok()?).copied();
        Some(ArrowKind::Whole { size, has_sign: true, per_second: Some(per_second?) })
    };
    let bits = |place: usize, usual: i32| about.and_then(|it| it.int(place)).unwrap_or(usual);
    Some(match field.byte(2)? {
        types::INT => {
            let size =
                usize::try_from(bits(0, 0) / 8).ok().filter(|it| [1, 2, 4, 8].contains(it))?;
            let has_sign = about.and_then(|it| it.byte(1)).unwrap_or(0) != 0;
            ArrowKind::Whole { size, has_sign, per_second: None }
        }
        types::FLOAT => *[ArrowKind::Half, ArrowKind::Float, ArrowKind::Double]
            .get(usize::try_from(short(0, 0)).ok()?)?,
        types::BOOL => ArrowKind::Bit,
        types::TIMESTAMP => time(8, short(0, 0))?,
        types::DURATION => time(8, short(0, 1))?,
        types::TIME => time(if bits(1, 32) == 64 { 8 } else { 4 }, short(0, 1))?,
        types::TEXT => ArrowKind::Text(4),
        types::LARGE_TEXT => ArrowKind::Text(8),
        _ => ArrowKind::Other,
    })
}

/// What a buffer unpacks to: its length comes first, −1 where it is as it is.
fn unpack(buffer: &[u8], codec: u8) -> io::Result<Vec<u8>> {
    const LZ4: u8 = 0;
    let Some((length, packed)) = buffer.split_first_chunk::<8>() else { return Ok(Vec::new()) };
    let length = i64::from_le_bytes(*length);
    if length == -1 {
        return Ok(packed.to_vec());
    }
    let length = u64::try_from(length).ok().filter(|it| *it <= LARGEST_BUFFER);
    let length = length.ok_or_else(|| damage("a column is larger than 128 MiB in one batch"))?;
    let mut bytes = Vec::new();
    if codec == LZ4 {
        lz4_flex::frame::FrameDecoder::new(packed).take(length).read_to_end(&mut bytes)?;
    } else {
        let decoder = ruzstd::decoding::StreamingDecoder::new(packed);
        let decoder = decoder.map_err(|error| damage(&error.to_string()))?;
        decoder.take(length).read_to_end(&mut bytes)?;
    }
    Ok(bytes)
}

fn bit(bytes: &[u8], row: usize) -> bool {
    bytes.get(row / 8).is_some_and(|it| (it >> (row % 8)) & 1 == 1)
}

fn some<const N: usize>(bytes: &[u8], row: usize) -> io::Result<[u8; N]> {
    let found = bytes.get(N * row..N * row + N).and_then(|it| it.try_into().ok());
    found.ok_or_else(|| damage("a column has fewer values than rows"))
}

fn whole(bytes: &[u8], row: usize, size: usize, has_sign: bool) -> io::Result<i128> {
    Ok(match (size, has_sign) {
        (1, true) => i8::from_le_bytes(some(bytes, row)?).into(),
        (1, false) => u8::from_le_bytes(some(bytes, row)?).into(),
        (2, true) => i16::from_le_bytes(some(bytes, row)?).into(),
        (2, false) => u16::from_le_bytes(some(bytes, row)?).into(),
        (4, true) => i32::from_le_bytes(some(bytes, row)?).into(),
        (4, false) => u32::from_le_bytes(some(bytes, row)?).into(),
        (_, true) => i64::from_le_bytes(some(bytes, row)?).into(),
        (_, false) => u64::from_le_bytes(some(bytes, row)?).into(),
    })
}

/// A number of half precision.
fn half(bits: u16) -> f64 {
    let fraction = f64::from(bits & 0x3ff) / 1024.0;
    let size = match (bits >> 10) & 0x1f {
        0 => fraction * 2_f64.powi(-14),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        power => (1.0 + fraction) * 2_f64.powi(i32::from(power) - 15),
    };
    if bits >> 15 == 1 { -size } else { size }
}

/// A number, from whose text it is the same again; nothing where it is none.
fn write_number(text: &mut Vec<u8>, number: f64) -> io::Result<()> {
    if number.is_nan() { Ok(()) } else { write!(text, "{number}") }
}
