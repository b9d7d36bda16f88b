//! Values as bytes, and back bit for bit: little-endian, in the order of their fields.
//!
//! A type says once which fields it has, by [`stored`], and both ways are made of that. A field
//! that is left out does not compile.

use std::collections::VecDeque;

use nalgebra::{DMatrix, Matrix3, Vector2, Vector3};

/// A value that can be stored as bytes.
pub(crate) trait Stored: Sized {
    /// Writes the value after what is there.
    fn store(&self, bytes: &mut Vec<u8>);

    /// Reads what [`store`](Self::store) wrote, and leaves what follows; nothing if it is no such
    /// value.
    fn restore(bytes: &mut &[u8]) -> Option<Self>;
}

/// Stores a struct by its fields, or an enum by a number for each variant and its fields.
macro_rules! stored {
    (struct $name:ident $(<const $N:ident>)? { $($field:ident),+ $(,)? }) => {
        impl $(<const $N: usize>)? $crate::stored::Stored for $name $(<$N>)? {
            fn store(&self, bytes: &mut Vec<u8>) {
                let Self { $($field),+ } = self;
                $($crate::stored::Stored::store($field, bytes);)+
            }

            fn restore(bytes: &mut &[u8]) -> Option<Self> {
                $(let $field = $crate::stored::Stored::restore(bytes)?;)+
                Some(Self { $($field),+ })
            }
        }
    };
    (enum $name:ident {
        $($code:literal => $variant:ident $({ $($field:ident),+ })? $(($inner:ident))?),+ $(,)?
    }) => {
        impl $crate::stored::Stored for $name {
            fn store(&self, bytes: &mut Vec<u8>) {
                match self {
                    $(Self::$variant $({ $($field),+ })? $(($inner))? => {
                        bytes.push($code);
                        $($($crate::stored::Stored::store($field, bytes);)+)?
                        $($crate::stored::Stored::store($inner, bytes);)?
                    })+
                }
            }

            fn restore(bytes: &mut &[u8]) -> Option<Self> {
                match <u8 as $crate::stored::Stored>::restore(bytes)? {
                    $($code => {
                        $($(let $field = $crate::stored::Stored::restore(bytes)?;)+)?
                        $(let $inner = $crate::stored::Stored::restore(bytes)?;)?
                        Some(Self::$variant $({ $($field),+ })? $(($inner))?)
                    })+
                    _ => None,
                }
            }
        }
    };
}
pub(crate) use stored;

/// Numbers of a fixed size.
macro_rules! stored_numbers {
    ($($number:ty),+) => {
        $(impl Stored for $number {
            fn store(&self, bytes: &mut Vec<u8>) {
                bytes.extend(self.to_le_bytes());
            }

            fn restore(bytes: &mut &[u8]) -> Option<Self> {
                let (number, rest) = bytes.split_first_chunk()?;
                *bytes = rest;
                Some(Self::from_le_bytes(*number))
            }
        })+
    };
}
stored_numbers!(u8, u32, u64, f64);

impl Stored for usize {
    fn store(&self, bytes: &mut Vec<u8>) {
        (*self as u64).store(bytes);
    }

    fn restore(bytes: &mut &[u8]) -> Option<Self> {
        u64::restore(bytes)?.try_into().ok()
    }
}

impl Stored for bool {
    fn store(&self, bytes: &mut Vec<u8>) {
        bytes.push(u8::from(*self));
    }

    fn restore(bytes: &mut &[u8]) -> Option<Self> {
        match u8::restore(bytes)? {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }
}

impl Stored for String {
    fn store(&self, bytes: &mut Vec<u8>) {
        self.len().store(bytes);
        bytes.extend(self.as_bytes());
    }

    fn restore(bytes: &mut &[u8]) -> Option<Self> {
        let length = usize::restore(bytes)?;
        let (text, rest) = bytes.split_at_checked(length)?;
        *bytes = rest;
        Self::from_utf8(text.to_vec()).ok()
    }
}

impl<T: Stored> Stored for Option<T> {
    fn store(&self, bytes: &mut Vec<u8>) {
        self.is_some().store(bytes);
        if let Some(value) = self {
            value.store(bytes);
        }
    }

    fn restore(bytes: &mut &[u8]) -> Option<Self> {
        if bool::restore(bytes)? { T::restore(bytes).map(Some) } else { Some(None) }
    }
}

impl<T: Stored> Stored for Vec<T> {
    fn store(&self, bytes: &mut Vec<u8>) {
        self.len().store(bytes);
        for value in self {
            value.store(bytes);
        }
    }

    fn restore(bytes: &mut &[u8]) -> Option<Self> {
        // A damaged length asks for no memory: the bytes end before.
        let length = usize::restore(bytes)?;
        let mut all = Self::new();
        for _ in 0..length {
            all.push(T::restore(bytes)?);
        }
        Some(all)
    }
}

impl<T: Stored + Clone> Stored for VecDeque<T> {
    fn store(&self, bytes: &mut Vec<u8>) {
        self.iter().cloned().collect::<Vec<T>>().store(bytes);
    }

    fn restore(bytes: &mut &[u8]) -> Option<Self> {
        Vec::restore(bytes).map(Self::from)
    }
}

impl<T: Stored, const N: usize> Stored for [T; N] {
    fn store(&self, bytes: &mut Vec<u8>) {
        for value in self {
            value.store(bytes);
        }
    }

    fn restore(bytes: &mut &[u8]) -> Option<Self> {
        let all: Option<Vec<T>> = (0..N).map(|_| T::restore(bytes)).collect();
        all?.try_into().ok()
    }
}

impl<T: Stored> Stored for Box<T> {
    fn store(&self, bytes: &mut Vec<u8>) {
        (**self).store(bytes);
    }

    fn restore(bytes: &mut &[u8]) -> Option<Self> {
        T::restore(bytes).map(Self::new)
    }
}

impl<A: Stored, B: Stored> Stored for (A, B) {
    fn store(&self, bytes: &mut Vec<u8>) {
        self.0.store(bytes);
        self.1.store(bytes);
    }

    fn restore(bytes: &mut &[u8]) -> Option<Self> {
        Some((A::restore(bytes)?, B::restore(bytes)?))
    }
}

impl<A: Stored, B: Stored, C: Stored> Stored for (A, B, C) {
    fn store(&self, bytes: &mut Vec<u8>) {
        self.0.store(bytes);
        self.1.store(bytes);
        self.2.store(bytes);
    }

    fn restore(bytes: &mut &[u8]) -> Option<Self> {
        Some((A::restore(bytes)?, B::restore(bytes)?, C::restore(bytes)?))
    }
}

/// Vectors and matrices of a fixed size, column by column.
macro_rules! stored_columns {
    ($($matrix:ty),+) => {
        $(impl Stored for $matrix {
            fn store(&self, bytes: &mut Vec<u8>) {
                self.iter().for_each(|number| number.store(bytes));
            }

            fn restore(bytes: &mut &[u8]) -> Option<Self> {
                let mut matrix = Self::zeros();
                for number in &mut matrix {
                    *number = f64::restore(bytes)?;
                }
                Some(matrix)
            }
        })+
    };
}
stored_columns!(Vector2<f64>, Vector3<f64>, Matrix3<f64>);

impl Stored for DMatrix<f64> {
    fn store(&self, bytes: &mut Vec<u8>) {
        self.nrows().store(bytes);
        self.as_slice().to_vec().store(bytes);
    }

    fn restore(bytes: &mut &[u8]) -> Option<Self> {
        let (rows, numbers) = <(usize, Vec<f64>)>::restore(bytes)?;
        let columns = numbers.len().checked_div(rows)?;
        (rows * columns == numbers.len()).then(|| Self::from_vec(rows, columns, numbers))
    }
}

/// Bytes that say which version of the library wrote them, and that end with a sum by which damage
/// is seen.
pub(crate) fn sealed(content: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    let mut bytes = SEAL.as_bytes().to_vec();
    content(&mut bytes);
    checksum(&bytes).store(&mut bytes);
    bytes
}

/// The content of [`sealed`] bytes; none of bytes that are damaged or by another version.
pub(crate) fn opened(bytes: &[u8]) -> Option<&[u8]> {
    let (content, mut sum) = bytes.split_at_checked(bytes.len().checked_sub(size_of::<u64>())?)?;
    let is_whole = u64::restore(&mut sum)? == checksum(content);
    content.strip_prefix(SEAL.as_bytes()).filter(|_| is_whole)
}

/// What sealed bytes start with: the version, and a number that grows whenever fields of some
/// [`stored`] type change within one.
const SEAL: &str = concat!("grouser state ", env!("CARGO_PKG_VERSION"), ", 3\n");

/// FNV-1a (Fowler, Noll and Vo) of 64 bits: it tells damage, not intent.
fn checksum(bytes: &[u8]) -> u64 {
    const BASIS: u64 = 0xCBF2_9CE4_8422_2325;
    const PRIME: u64 = 0x0000_0100_0000_01B3;
    bytes.iter().fold(BASIS, |sum, byte| (sum ^ u64::from(*byte)).wrapping_mul(PRIME))
}
