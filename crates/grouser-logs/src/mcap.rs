//! The container MCAP: messages of channels in chunks, with an index at the end. Source: "MCAP
//! Format Specification", version 0, mcap.dev/spec.

pub(crate) mod format;
pub(crate) mod order;
pub(crate) mod read;
pub(crate) mod write;

#[cfg(test)]
mod tests;
