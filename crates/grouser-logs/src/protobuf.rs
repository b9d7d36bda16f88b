//! Messages in Protocol Buffers: their bytes, types that are declared here, and types that a log
//! describes. Source: "Protocol Buffers: Encoding" and `descriptor.proto`,
//! developers.google.com/protocol-buffers.

pub(crate) mod decode;
pub(crate) mod message;
pub(crate) mod wire;

#[cfg(test)]
mod tests;
