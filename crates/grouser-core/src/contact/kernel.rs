//! The force integral, made for vector instructions.
//!
//! A piece of the arc on which the stresses are smooth is integrated over a handful of Gauss nodes,
//! and the lanes of a vector are nodes of one wheel. So a wheel has the same bits alone and among a
//! thousand, and wheels in different motions do not wait for each other. The formulas are those of
//! [`StressField`](super::stress::StressField), written for one point; [`integral`] runs them over
//! [`LANES`] nodes at a time in a loop that compilers turn into vector instructions, [`rule`] says
//! where the nodes are, and [`dispatch`] chooses the instruction set while the program runs.

pub(super) mod dispatch;
pub(super) mod integral;
pub(super) mod rule;

pub use dispatch::InstructionSet;

/// Nodes that are computed side by side: what the widest vectors hold.
pub(super) const LANES: usize = 8;

/// One number for each node.
pub(super) type Lanes = [f64; LANES];

/// Σ over the lanes, always in this order.
#[expect(clippy::inline_always, reason = "part of the kernel")]
#[inline(always)]
pub(super) fn sum(x: &Lanes) -> f64 {
    ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]))
}
