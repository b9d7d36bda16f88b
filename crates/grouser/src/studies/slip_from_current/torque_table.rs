//! Torque over slip, of each wheel under loads and at slip angles.

use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::{Arc, PoisonError, RwLock};

use super::super::ensemble::outputs_while;
use super::super::ensemble::samples::Sample;
use crate::contact::{Contact, Slip, settle};
use crate::elementary::wide;
use crate::vehicle::Rover;
use crate::wheel::Wheel;

/// Slips of a curve, in equal steps.
const SLIPS: usize = 241;
/// A load is this many times the next smaller one of the table. Torque over load differs by a few
/// percent from one to the next, and what is between them by a part in 10⁴.
const LOAD_RATIO: f64 = 1.05;
/// Slip angles of the table are whole multiples of this [rad]: 2.5°.
const ANGLE_STEP: f64 = PI / 72.0;
/// Slopes are rounded to whole multiples of this [rad], 0.5°: they change no more than the
/// resistance of wedges.
const SLOPE_STEP: f64 = PI / 360.0;

/// Where a wheel is in the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    wheel: usize,
    /// Load [N], above 0.
    load: f64,
    /// Slip angle [rad].
    slip_angle: f64,
    /// Slope of the ground [rad].
    slope: f64,
}

impl Place {
    /// * `wheel`: its place among the rover's mounts
    pub(super) fn of(wheel: usize, load: f64, slip_angle: f64, slope: f64) -> Self {
        Self { wheel, load, slip_angle, slope }
    }
}

/// A node of the table: a wheel, and numbers of its slope, load and slip angle.
type Node = (usize, i32, i32, i32);

/// Torque over load at each slip, for each sample [m].
type Curves = Arc<Vec<Vec<f64>>>;

/// Torque over slip for samples of soil and model. It is filled where it is asked.
#[derive(Debug)]
pub(super) struct TorqueTable {
    /// The wheel of each mount, by its place among those that differ.
    kinds: Vec<usize>,
    wheels: Vec<Wheel>,
    gravity: f64,
    samples: Vec<Sample>,
    slips: Vec<f64>,
    nodes: RwLock<HashMap<Node, Curves>>,
}

impl TorqueTable {
    /// * `slips`: the first and the last [-]
    pub(super) fn new(
        rover: &Rover,
        gravity: f64,
        samples: Vec<Sample>,
        [first, last]: [f64; 2],
    ) -> Self {
        let mut wheels: Vec<Wheel> = Vec::new();
        let kinds = rover.mounts().iter().map(|mount| {
            let wheel = mount.unit.wheel;
            wheels.iter().position(|known| *known == wheel).unwrap_or_else(|| {
                wheels.push(wheel);
                wheels.len() - 1
            })
        });
        let kinds = kinds.collect();
        let share = |step: usize| step as f64 / (SLIPS - 1) as f64;
        let slips = (0..SLIPS).map(|step| first + (last - first) * share(step)).collect();
        Self { kinds, wheels, gravity, samples, slips, nodes: RwLock::default() }
    }

    /// Torques at each slip [N·m], for each sample; not a number where the soil does not carry the
    /// wheel.
    pub(super) fn curves(&self, place: Place) -> Vec<Vec<f64>> {
        let corners = self.corners(place).map(|(node, share)| (self.node(node), share));
        let curve = |sample: usize| {
            let torque = |slip: usize| {
                let part = |(curves, share): &(Curves, f64)| {
                    // A corner that does not count may have no torque.
                    if *share == 0.0 { 0.0 } else { share * curves[sample][slip] }
                };
                place.load * corners.iter().map(part).sum::<f64>()
            };
            (0..SLIPS).map(torque).collect()
        };
        (0..self.samples.len()).map(curve).collect()
    }

    /// The nodes around some places that are not there yet.
    pub(super) fn missing(&self, places: impl Iterator<Item = Place>) -> Vec<Node> {
        let corners = places.flat_map(|place| self.corners(place));
        let mut needed: Vec<Node> =
            corners.filter(|(_, share)| *share > 0.0).map(|(node, _)| node).collect();
        needed.sort_unstable();
        needed.dedup();
        let known = self.nodes.read().unwrap_or_else(PoisonError::into_inner);
        needed.retain(|node| !known.contains_key(node));
        needed
    }

    /// Computes what some places need; nothing if `go_on` was false before the end.
    pub(super) fn fill(
        &self,
        places: impl Iterator<Item = Place>,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<()> {
        outputs_while(self.missing(places), go_on, |node| self.node(node)).map(|_| ())
    }

    /// The four nodes around a place, each with its share.
    fn corners(&self, place: Place) -> [(Node, f64); 4] {
        let split = |number: f64| (whole(number.floor()), number - number.floor());
        let (load, load_share) = split(wide::ln(place.load.max(1e-9)) / wide::ln(LOAD_RATIO));
        let (angle, angle_share) = split(place.slip_angle / ANGLE_STEP);
        let slope = whole((place.slope / SLOPE_STEP).round());
        let kind = self.kinds[place.wheel];
        let ends = [(0, 1.0 - load_share), (1, load_share)];
        let corner = |of_load: usize, of_angle: usize| {
            let (more, share) = ends[of_load];
            let (turn, part) = [(0, 1.0 - angle_share), (1, angle_share)][of_angle];
            ((kind, slope, load + more, angle + turn), share * part)
        };
        [corner(0, 0), corner(0, 1), corner(1, 0), corner(1, 1)]
    }

    fn node(&self, node: Node) -> Curves {
        let known = self.nodes.read().unwrap_or_else(PoisonError::into_inner).get(&node).cloned();
        if let Some(curves) = known {
            return curves;
        }
        let curves = Arc::new(self.computed(node));
        let mut nodes = self.nodes.write().unwrap_or_else(PoisonError::into_inner);
        nodes.entry(node).or_insert(curves).clone()
    }

    fn computed(&self, (kind, slope, load, angle): Node) -> Vec<Vec<f64>> {
        let load = crate::elementary::exp(f64::from(load) * wide::ln(LOAD_RATIO));
        // Nothing moves further to the side than across.
        let angle = (f64::from(angle) * ANGLE_STEP).clamp(-FRAC_PI_2, FRAC_PI_2);
        let steepness = wide::tan(f64::from(slope) * SLOPE_STEP);
        let of_sample = |sample: &Sample| {
            let soil = sample.soil.on_slope(steepness);
            let torque = |slip: &f64| {
                let slip = Slip::on_test_stand(*slip, angle);
                let wheel = self.wheels[kind];
                let contact = Contact { wheel, soil, slip, gravity: self.gravity };
                let settled = settle(sample.model.as_ref(), &contact, load);
                settled.map_or(f64::NAN, |settled| settled.forces.torque / load)
            };
            self.slips.iter().map(torque).collect()
        };
        super::super::ensemble::outputs(&self.samples, of_sample)
    }
}

/// A whole number, at the end of the range where it is beyond.
#[allow(clippy::cast_possible_truncation, reason = "numbers of nodes are whole and small")]
fn whole(number: f64) -> i32 {
    number as i32
}
