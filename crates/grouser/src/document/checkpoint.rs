//! A sampler's state as a file, from which sampling continues with the same bits.
//!
//! Numbers are written as they are, bit for bit, little-endian; an identity at the start names
//! the calibration, and a check sum at the end (FNV-1a, 64 bits) finds damage.

use super::fnv_1a;
use crate::studies::calibration::PosteriorState;
use crate::studies::calibration::posterior::Ensemble;

const MAGIC: &[u8] = b"grouser posterior 2\n";
/// The mark of earlier versions, whose check sum depended on the compiler.
const OLD_MAGIC: &[u8] = b"grouser posterior 1\n";

/// The largest file of a state that is read [bytes]: that of ten keys after a hundred thousand
/// steps has about a gigabyte.
pub const LARGEST: u64 = 4 << 30;

/// A state that cannot be continued.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CheckpointError {
    /// Not a state, or not all of one.
    #[error("it is damaged")]
    Damaged,
    /// The state is written as an earlier version of Grouser wrote it.
    #[error(
        "an earlier version of Grouser wrote it, with a check sum that can no longer be verified"
    )]
    Old,
    /// The state of another calibration.
    #[error("it belongs to a calibration with other inputs")]
    Foreign,
}

/// The state as bytes.
///
/// * `identity`: the inputs that identify this calibration
#[must_use]
pub fn to_bytes(state: &PosteriorState, identity: &str) -> Vec<u8> {
    let mut bytes = MAGIC.to_vec();
    let count = |bytes: &mut Vec<u8>, value: u64| bytes.extend(value.to_le_bytes());
    count(&mut bytes, identity.len() as u64);
    bytes.extend(identity.as_bytes());
    count(&mut bytes, state.blocks);
    count(&mut bytes, state.ensembles.len() as u64);
    for Ensemble { walkers, chain, accepted, proposed } in &state.ensembles {
        let width = walkers.first().map_or(0, Vec::len);
        for value in [*accepted, *proposed, walkers.len() as u64, chain.len() as u64, width as u64]
        {
            count(&mut bytes, value);
        }
        for coordinate in walkers.iter().chain(chain).flatten() {
            bytes.extend(coordinate.to_le_bytes());
        }
    }
    let sum = check_sum(&bytes);
    bytes.extend(sum.to_le_bytes());
    bytes
}

/// The state that bytes hold.
///
/// # Errors
/// [`CheckpointError`] if they are not all there, of an earlier version, or another calibration's.
pub fn from_bytes(bytes: &[u8], identity: &str) -> Result<PosteriorState, CheckpointError> {
    let damaged = CheckpointError::Damaged;
    if bytes.starts_with(OLD_MAGIC) {
        return Err(CheckpointError::Old);
    }
    let body = bytes.len().checked_sub(8).ok_or(damaged)?;
    let (body, sum) = bytes.split_at(body);
    if sum != check_sum(body).to_le_bytes() {
        return Err(damaged);
    }
    let mut reader = Reader { rest: body.strip_prefix(MAGIC).ok_or(damaged)? };
    let length = reader.count()?;
    if reader.take(length)? != identity.as_bytes() {
        return Err(CheckpointError::Foreign);
    }
    let blocks = reader.word()?;
    let ensembles = (0..reader.count()?).map(|_| reader.ensemble()).collect::<Result<_, _>>()?;
    Ok(PosteriorState { blocks, ensembles })
}

struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    fn take(&mut self, length: usize) -> Result<&'a [u8], CheckpointError> {
        let (taken, rest) = self.rest.split_at_checked(length).ok_or(CheckpointError::Damaged)?;
        self.rest = rest;
        Ok(taken)
    }

    fn word(&mut self) -> Result<u64, CheckpointError> {
        let bytes = self.take(8)?.try_into().map_err(|_| CheckpointError::Damaged)?;
        Ok(u64::from_le_bytes(bytes))
    }

    fn count(&mut self) -> Result<usize, CheckpointError> {
        usize::try_from(self.word()?).map_err(|_| CheckpointError::Damaged)
    }

    fn ensemble(&mut self) -> Result<Ensemble, CheckpointError> {
        let (accepted, proposed) = (self.word()?, self.word()?);
        let (walkers, kept, width) = (self.count()?, self.count()?, self.count()?);
        // Places without coordinates take no bytes: nothing would end a wrong count of them.
        if width == 0 && walkers.max(kept) > 0 {
            return Err(CheckpointError::Damaged);
        }
        let mut place = || -> Result<Vec<f64>, CheckpointError> {
            (0..width).map(|_| self.word().map(f64::from_bits)).collect()
        };
        Ok(Ensemble {
            walkers: (0..walkers).map(|_| place()).collect::<Result<_, _>>()?,
            chain: (0..kept).map(|_| place()).collect::<Result<_, _>>()?,
            accepted,
            proposed,
        })
    }
}

fn check_sum(bytes: &[u8]) -> u64 {
    fnv_1a(bytes.iter().copied())
}

/// A fingerprint of a file's bytes, to tell whether it is still the same.
#[must_use]
pub fn fingerprint(bytes: &[u8]) -> String {
    format!("{:016x}", check_sum(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state() -> PosteriorState {
        let ensemble = |shift: f64| Ensemble {
            walkers: vec![vec![shift, -0.0], vec![f64::MIN_POSITIVE, 1.0 / 3.0]],
            chain: vec![vec![shift, 2.0]; 4],
            accepted: 7,
            proposed: 9,
        };
        PosteriorState { blocks: 3, ensembles: vec![ensemble(0.1), ensemble(1e300)] }
    }

    #[test]
    fn a_state_returns_bit_for_bit() {
        let bytes = to_bytes(&state(), "this one");
        let back = from_bytes(&bytes, "this one").unwrap();
        assert_eq!(back, state());
        assert_eq!(to_bytes(&back, "this one"), bytes);
    }

    /// Source: the authors' test vectors for FNV-1a with 64 bits.
    #[test]
    fn the_check_sum_is_the_published_one() {
        assert_eq!(fingerprint(b""), "cbf29ce484222325");
        assert_eq!(fingerprint(b"a"), "af63dc4c8601ec8c");
        assert_eq!(fingerprint(b"foobar"), "85944171f73967e8");
    }

    #[test]
    fn a_state_of_an_earlier_version_is_refused_as_such() {
        let mut bytes = to_bytes(&state(), "this one");
        bytes[..OLD_MAGIC.len()].copy_from_slice(OLD_MAGIC);
        assert_eq!(from_bytes(&bytes, "this one"), Err(CheckpointError::Old));
    }

    #[test]
    fn walkers_without_coordinates_are_damage() {
        let walkers = vec![Vec::new(); 3];
        let ensemble = Ensemble { walkers, chain: Vec::new(), accepted: 0, proposed: 0 };
        let state = PosteriorState { blocks: 1, ensembles: vec![ensemble] };
        assert_eq!(from_bytes(&to_bytes(&state, "it"), "it"), Err(CheckpointError::Damaged));
    }

    #[test]
    fn damage_and_strangers_are_found() {
        let bytes = to_bytes(&state(), "this one");
        assert_eq!(from_bytes(&bytes, "that one"), Err(CheckpointError::Foreign));
        for end in 0..bytes.len() {
            assert_eq!(from_bytes(&bytes[..end], "this one"), Err(CheckpointError::Damaged));
        }
        for place in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[place] ^= 0x10;
            assert_eq!(from_bytes(&changed, "this one"), Err(CheckpointError::Damaged), "{place}");
        }
    }
}
