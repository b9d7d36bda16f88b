//! The header of a `.npy` file.

use std::io::Read;

use crate::error::Fault;

/// What every such file starts with.
pub(super) const MAGIC: &[u8] = b"\x93NUMPY";

/// What a header says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Header {
    pub(super) kind: Kind,
    pub(super) little_endian: bool,
    /// Column after column, Fortran's order.
    pub(super) by_columns: bool,
    pub(super) rows: u64,
    pub(super) columns: u64,
    /// Its own length, after which the numbers start.
    pub(super) bytes: u64,
}

/// Numbers by kind and size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    F32,
    F64,
    I8,
    I16,
    I32,
    I64,
    U8,
    U16,
    U32,
    U64,
}

impl Kind {
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::F32 | Self::I32 | Self::U32 => 4,
            Self::F64 | Self::I64 | Self::U64 => 8,
        }
    }

    fn of(name: &str) -> Option<Self> {
        Some(match name {
            "f4" => Self::F32,
            "f8" => Self::F64,
            "i1" => Self::I8,
            "i2" => Self::I16,
            "i4" => Self::I32,
            "i8" => Self::I64,
            "u1" => Self::U8,
            "u2" => Self::U16,
            "u4" => Self::U32,
            "u8" => Self::U64,
            _ => return None,
        })
    }

    /// The number that these bytes are.
    pub(super) fn value(self, bytes: &[u8], little_endian: bool) -> f64 {
        let mut word = [0; 8];
        let size = self.bytes();
        if little_endian {
            word[..size].copy_from_slice(bytes);
        } else {
            for (to, from) in word.iter_mut().zip(bytes.iter().rev()) {
                *to = *from;
            }
        }
        let [a, b, c, d, ..] = word;
        match self {
            Self::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
            Self::F64 => f64::from_le_bytes(word),
            Self::I8 => f64::from(i8::from_le_bytes([a])),
            Self::I16 => f64::from(i16::from_le_bytes([a, b])),
            Self::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
            Self::I64 => i64::from_le_bytes(word) as f64,
            Self::U8 => f64::from(a),
            Self::U16 => f64::from(u16::from_le_bytes([a, b])),
            Self::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
            Self::U64 => u64::from_le_bytes(word) as f64,
        }
    }
}

impl Header {
    /// Reads it from the start of a file.
    ///
    /// * `length`: of the file [bytes]
    pub(super) fn read(file: &mut impl Read, length: u64) -> Result<Self, Fault> {
        /// Bytes of text, at most: NumPy's own are below 200.
        const LONGEST: usize = 1 << 16;
        if length == 0 {
            return Err(Fault::Empty);
        }
        let mut start = [0; 8];
        exactly(file, &mut start, length)?;
        if !start.starts_with(MAGIC) {
            return Err(no_header("it does not start as such files do"));
        }
        let size_bytes = match start[6] {
            1 => 2,
            2 | 3 => 4,
            version => return Err(no_header(&format!("version {version} is unknown"))),
        };
        let mut size = [0; 4];
        exactly(file, &mut size[..size_bytes], length)?;
        let size = usize::try_from(u32::from_le_bytes(size)).unwrap_or(usize::MAX);
        if size > LONGEST {
            return Err(no_header(&format!("it is {size} bytes long")));
        }
        let mut text = vec![0; size];
        exactly(file, &mut text, length)?;
        let text = String::from_utf8(text).map_err(|_| no_header("it is no text"))?;
        let bytes = (start.len() + size_bytes + size) as u64;
        Self::parse(&text, bytes)
    }

    /// Reads the dictionary, such as `{'descr': '<f4', 'fortran_order': False, 'shape': (3, 4), }`.
    fn parse(text: &str, bytes: u64) -> Result<Self, Fault> {
        let value = |key: &str| {
            let quoted = [format!("'{key}'"), format!("\"{key}\"")];
            let after = quoted.iter().find_map(|key| text.split_once(key.as_str()))?.1;
            after.trim_start().strip_prefix(':').map(str::trim_start)
        };
        let missing = |key: &str| no_header(&format!("it has no {key}"));
        let descr = value("descr").ok_or_else(|| missing("descr"))?;
        let (kind, little_endian) = numbers(descr)?;
        let order = value("fortran_order").ok_or_else(|| missing("fortran_order"))?;
        let by_columns = match order {
            order if order.starts_with("True") => true,
            order if order.starts_with("False") => false,
            _ => return Err(no_header("fortran_order is neither True nor False")),
        };
        let shape = value("shape").ok_or_else(|| missing("shape"))?;
        let (rows, columns) = two_axes(shape)?;
        Ok(Self { kind, little_endian, by_columns, rows, columns, bytes })
    }
}

/// The kind and byte order of `'<f4'`.
fn numbers(descr: &str) -> Result<(Kind, bool), Fault> {
    let quote = descr.chars().next().filter(|quote| matches!(quote, '\'' | '"'));
    let Some(name) = quote.and_then(|quote| descr[1..].split(quote).next()) else {
        return Err(Fault::Samples { samples: "records with several fields".into() });
    };
    let (order, kind) = match name.chars().next() {
        Some(order @ ('<' | '>' | '|' | '=')) => (order, &name[1..]),
        _ => ('=', name),
    };
    let Some(kind) = Kind::of(kind) else {
        let shown: String = name.chars().filter(|c| !c.is_control()).take(16).collect();
        return Err(Fault::Samples { samples: format!("of NumPy's type {shown}") });
    };
    // Files say '<' or '>'; what says neither was written by a machine such as this one, or has one
    // byte.
    Ok((kind, if order == '=' { cfg!(target_endian = "little") } else { order != '>' }))
}

/// Rows and columns of `(3, 4)`.
fn two_axes(shape: &str) -> Result<(u64, u64), Fault> {
    let inside = shape.strip_prefix('(').and_then(|shape| shape.split_once(')'));
    let Some((inside, _)) = inside else { return Err(no_header("its shape has no brackets")) };
    let axes = inside.split(',').map(str::trim).filter(|axis| !axis.is_empty());
    let axes: Result<Vec<u64>, _> = axes.map(str::parse).collect();
    match axes.as_deref() {
        Ok([rows, columns]) => Ok((*rows, *columns)),
        Ok(axes) => Err(no_header(&format!(
            "its shape has {} axes; heights have rows and columns",
            axes.len()
        ))),
        Err(_) => Err(no_header("its shape is not made of whole numbers")),
    }
}

/// Fills bytes from a file that may end before.
fn exactly(file: &mut impl Read, bytes: &mut [u8], length: u64) -> Result<(), Fault> {
    file.read_exact(bytes).map_err(|error| match error.kind() {
        std::io::ErrorKind::UnexpectedEof => {
            no_header(&format!("the file ends within it, after {length} bytes"))
        }
        _ => Fault::Disk(error),
    })
}

fn no_header(problem: &str) -> Fault {
    Fault::NpyHeader { problem: problem.to_owned() }
}
