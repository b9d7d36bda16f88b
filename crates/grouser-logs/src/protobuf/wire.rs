//! Fields of messages as bytes: a tag with the field's number, and a value that ends as the tag
//! says.

/// How a value ends; the tag has it in its three lowest bits.
mod ending {
    pub(super) const VARINT: u64 = 0;
    pub(super) const EIGHT_BYTES: u64 = 1;
    pub(super) const COUNTED: u64 = 2;
    pub(super) const FOUR_BYTES: u64 = 5;
    /// How far the field's number is above it [bits].
    pub(super) const BITS: u32 = 3;
}

/// A value as it is encoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoded<'a> {
    Number(u64),
    Four([u8; 4]),
    Eight([u8; 8]),
    Bytes(&'a [u8]),
}

impl Encoded<'_> {
    /// Writes it as a field.
    pub(crate) fn put(self, number: u32, out: &mut Vec<u8>) {
        let ending = match self {
            Self::Number(_) => ending::VARINT,
            Self::Four(_) => ending::FOUR_BYTES,
            Self::Eight(_) => ending::EIGHT_BYTES,
            Self::Bytes(_) => ending::COUNTED,
        };
        put_varint(u64::from(number) << ending::BITS | ending, out);
        match self {
            Self::Number(value) => put_varint(value, out),
            Self::Four(bytes) => out.extend_from_slice(&bytes),
            Self::Eight(bytes) => out.extend_from_slice(&bytes),
            Self::Bytes(bytes) => {
                put_varint(bytes.len() as u64, out);
                out.extend_from_slice(bytes);
            }
        }
    }
}

fn put_varint(mut value: u64, out: &mut Vec<u8>) {
    while value >= 0x80 {
        out.push(value.to_le_bytes()[0] | 0x80);
        value >>= 7;
    }
    out.push(value.to_le_bytes()[0]);
}

/// Bytes that are read field by field.
pub(crate) struct Encoding<'a>(pub(crate) &'a [u8]);

impl<'a> Encoding<'a> {
    pub(crate) fn varint(&mut self) -> Option<u64> {
        let mut value = 0;
        for shift in (0..64).step_by(7) {
            let (&byte, rest) = self.0.split_first()?;
            self.0 = rest;
            value |= u64::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Some(value);
            }
        }
        None
    }

    pub(crate) fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (bytes, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*bytes)
    }

    /// The number of the next field, and its value; nothing at the end.
    ///
    /// # Errors
    /// `()` for bytes that are no field.
    pub(crate) fn next(&mut self) -> Result<Option<(u64, Encoded<'a>)>, ()> {
        if self.0.is_empty() {
            return Ok(None);
        }
        let tag = self.varint().ok_or(())?;
        let encoded = match tag & ((1 << ending::BITS) - 1) {
            ending::VARINT => self.varint().map(Encoded::Number),
            ending::EIGHT_BYTES => self.array().map(Encoded::Eight),
            ending::COUNTED => self.varint().and_then(|count| {
                let (bytes, rest) = self.0.split_at_checked(usize::try_from(count).ok()?)?;
                self.0 = rest;
                Some(Encoded::Bytes(bytes))
            }),
            ending::FOUR_BYTES => self.array().map(Encoded::Four),
            _ => None,
        };
        encoded.map(|encoded| Some((tag >> ending::BITS, encoded))).ok_or(())
    }
}
