//! Tables of FlatBuffers, in which Arrow describes its columns and batches. Source: *FlatBuffers
//! Internals*. Offsets are not believed: what lies outside is nothing.

/// A table: its fields are found by a list of their places, which lies before it.
#[derive(Clone, Copy)]
pub(super) struct FlatTable<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> FlatTable<'a> {
    /// The table at the root.
    pub(super) fn root(bytes: &'a [u8]) -> Option<Self> {
        Some(Self { bytes, at: followed(bytes, 0)? })
    }

    /// Where a field is; nothing where it has its usual value.
    fn place(&self, field: usize) -> Option<usize> {
        let back = i32::from_le_bytes(some(self.bytes, self.at)?);
        let list = usize::try_from(i64::try_from(self.at).ok()? - i64::from(back)).ok()?;
        let length = usize::from(u16::from_le_bytes(some(self.bytes, list)?));
        let entry = 4 + 2 * field;
        if entry + 2 > length {
            return None;
        }
        let offset = u16::from_le_bytes(some(self.bytes, list + entry)?);
        (offset > 0).then(|| self.at + usize::from(offset))
    }

    pub(super) fn byte(&self, field: usize) -> Option<u8> {
        self.bytes.get(self.place(field)?).copied()
    }

    pub(super) fn short(&self, field: usize) -> Option<i16> {
        Some(i16::from_le_bytes(some(self.bytes, self.place(field)?)?))
    }

    pub(super) fn int(&self, field: usize) -> Option<i32> {
        Some(i32::from_le_bytes(some(self.bytes, self.place(field)?)?))
    }

    pub(super) fn long(&self, field: usize) -> Option<i64> {
        long_at(self.bytes, self.place(field)?)
    }

    pub(super) fn table(&self, field: usize) -> Option<Self> {
        Some(Self { bytes: self.bytes, at: followed(self.bytes, self.place(field)?)? })
    }

    pub(super) fn text(&self, field: usize) -> Option<&'a str> {
        let (start, length) = self.list(field)?;
        std::str::from_utf8(self.bytes.get(start..start.checked_add(length)?)?).ok()
    }

    /// The tables of a list.
    pub(super) fn tables(&self, field: usize) -> Option<Vec<Self>> {
        const SIZE: usize = 4;
        let (start, length) = self.list(field)?;
        let at = |place: usize| followed(self.bytes, start + SIZE * place);
        (0..length).map(|it| Some(Self { bytes: self.bytes, at: at(it)? })).collect()
    }

    /// The pairs of whole numbers of a list.
    pub(super) fn pairs(&self, field: usize) -> Option<Vec<[i64; 2]>> {
        const SIZE: usize = 16;
        let (start, length) = self.list(field)?;
        let at = |place: usize| {
            let first = start + SIZE * place;
            Some([long_at(self.bytes, first)?, long_at(self.bytes, first + SIZE / 2)?])
        };
        (0..length).map(at).collect()
    }

    /// Where a list begins, and how many items it has.
    fn list(&self, field: usize) -> Option<(usize, usize)> {
        let at = followed(self.bytes, self.place(field)?)?;
        let length = usize::try_from(u32::from_le_bytes(some(self.bytes, at)?)).ok()?;
        // No more than there are bytes.
        (length <= self.bytes.len()).then_some((at + 4, length))
    }
}

fn some<const N: usize>(bytes: &[u8], at: usize) -> Option<[u8; N]> {
    bytes.get(at..at.checked_add(N)?)?.try_into().ok()
}

fn long_at(bytes: &[u8], at: usize) -> Option<i64> {
    Some(i64::from_le_bytes(some(bytes, at)?))
}

/// Where the offset at a place leads.
fn followed(bytes: &[u8], at: usize) -> Option<usize> {
    let offset = usize::try_from(u32::from_le_bytes(some(bytes, at)?)).ok()?;
    let place = at.checked_add(offset)?;
    (place < bytes.len()).then_some(place)
}
