//! How much the server takes on, and for how long.

use std::time::Duration;

/// The limits of a server.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Connections at a time. For one more the oldest that has asked nothing ends, with 503; where
    /// all have, it is refused so itself.
    pub connections: usize,
    /// Time for the head of a request, and between two requests on a connection.
    pub head_time: Duration,
    /// Time for the body of a request.
    pub body_time: Duration,
    /// Bytes of a body.
    pub body_bytes: usize,
    /// Time without progress after which a reader has gone.
    pub write_time: Duration,
    /// Bytes in a second that a reader takes at the least; who takes fewer has as much time as one
    /// who takes none.
    pub slowest: u32,
    /// Bytes of answers that wait for their readers, of all together.
    pub answer_bytes: u32,
    /// Computations that take long, at a time: those with samples. Each has all processors.
    pub runs: usize,
    /// Computations that wait for these, are quick, or have a reader who has not taken all. One more
    /// is refused with 503.
    pub waiting: usize,
    /// Time of a computation.
    pub run_time: Duration,
}

impl Default for Limits {
    /// Ours: a page has six connections and one computation; a document has some kilobytes.
    fn default() -> Self {
        Self {
            connections: 256,
            head_time: Duration::from_secs(10),
            body_time: Duration::from_secs(10),
            body_bytes: 1 << 20,
            write_time: Duration::from_secs(20),
            slowest: 16 << 10,
            answer_bytes: 128 << 20,
            runs: 2,
            waiting: 64,
            run_time: Duration::from_secs(60),
        }
    }
}
