//! What of a wheel lies open to soil that its grousers do not carry along.
//!
//! A facet pushes the soil in front of it, along its motion. Where the next grouser stands there,
//! the soil between is shut in and turns with the wheel; it pushes with its own surface, at the
//! grousers' tips. Seen in the wheel, soil comes in along −e_v: past a tip it falls by k =
//! v_n/|v_t| (velocities normal to and along the rim, at the tips) per length, and the rim curves
//! away from it:
//!
//! ```text
//! e = min(h_g, p k + p²/2r)                         height of a grouser that lies open
//! d = 2 h_g/(k + √(k² + 2 h_g/r))                   rim behind a grouser that lies in its shadow
//! f = max(0, 1 − d/p)                               share of the rim that lies open
//! ```
//!
//! with the pitch p = 2π r/N. The rim counts with its share f, and the soil shut in with 1 − f, as
//! a cylinder of the tips' radius with the soil's own friction. A low step of a grouser does not
//! stay open, soil lodges in its corner: its open face counts with w = e/h_g. And a cell that is
//! deeper than wide carries its soil along whatever its motion: f and w are times min(1, p/h_g).
//! So few grousers leave a bare rim with plates on it (f → 1, w → 1), and many make a cylinder of
//! their tips' radius (f → 0, w → 0).
//!
//! The geometry is that of the spacing rule of Skonieczny, Moreland and Wettergreen (2012), for any
//! motion. w is ours: any weight with those two limits would do, and between them the soil that
//! slides over the shut-in soil's surface onto an open face is met twice, the price of the simplest
//! one.

#![expect(clippy::inline_always, reason = "part of the lanes' loops")]

use super::super::lanes::{Each, each};
use crate::wheel::{Grousers, Wheel};

/// Grousers as plates that stand out of a rim.
#[derive(Clone, Copy, Debug)]
pub(super) struct Comb {
    /// Height over the rim, *h_g* [m].
    pub height: f64,
    /// How many there are per radian, N/2π [-].
    pub density: f64,
    /// Distance from one to the next along the rim, *p* [m].
    pitch: f64,
    /// Radius of the rim, *r* [m].
    radius: f64,
}

/// What lies open along each radius.
pub(super) struct Exposure {
    /// Height of a grouser, from its tip down [m].
    pub grouser: Each,
    /// Share with which its open face counts, *w* [-].
    pub share: Each,
    /// Share of the rim, *f* [-].
    pub rim: Each,
}

impl Comb {
    /// The grousers of a wheel that has any.
    pub(super) fn of(wheel: &Wheel) -> Option<Self> {
        let Grousers { height, count } = wheel.grousers?;
        if height <= 0.0 || count == 0 {
            return None;
        }
        let density = f64::from(count) / std::f64::consts::TAU;
        Some(Self { height, density, pitch: wheel.radius / density, radius: wheel.radius })
    }

    /// What lies open where the tips move with v_n [-] out of the rim and v_t along it.
    #[inline(always)]
    pub(super) fn exposure(&self, outward: &Each, along: &Each) -> Exposure {
        let (h, p, r) = (self.height, self.pitch, self.radius);
        let wide = (p / h).min(1.0);
        let open = p * p / (2.0 * r);
        // As products with |v_t|, which may be zero.
        let grouser = each(|lane| {
            let (v_n, v_t) = (outward[lane].max(0.0), along[lane].abs());
            if v_n * p >= (h - open) * v_t { h } else { p * v_n / v_t + open }
        });
        let rim = each(|lane| {
            let (v_n, v_t) = (outward[lane].max(0.0), along[lane].abs());
            let shadow = 2.0 * h * v_t / (v_n + (v_n * v_n + 2.0 * h / r * v_t * v_t).sqrt());
            // Tips at rest, or moving outward alone, cast no shadow.
            let shadow = if v_t > 0.0 { shadow } else { 0.0 };
            wide * (1.0 - shadow / p).max(0.0)
        });
        Exposure { share: each(|lane| wide * grouser[lane] / h), grouser, rim }
    }
}
