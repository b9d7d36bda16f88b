//! The force integral, made for vector instructions.
//!
//! A piece of the arc on which the stresses are smooth is integrated over a handful of Gauss nodes.
//! The formulas are those of [`StressField`](super::stress::StressField), written for one point.
//! [`integral`] runs them over [`LANES`] nodes of one wheel at a time, and [`wheels`] over one node
//! of many wheels, in loops that compilers turn into vector instructions; nodes are added up in the
//! same order, so that a wheel has the same bits alone and among a thousand. [`rule`] says where
//! the nodes are, and [`dispatch`] chooses the instruction set while the program runs.

pub(super) mod dispatch;
pub(super) mod integral;
pub(super) mod rule;
pub(super) mod wheels;

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
