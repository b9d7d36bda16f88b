//! Numbers of zones.

/// The most soils that zones may have.
pub const MOST_SOILS: usize = NO_ZONE as usize;

/// The number of a cell that belongs to no zone.
pub const NO_ZONE: u8 = u8::MAX;
