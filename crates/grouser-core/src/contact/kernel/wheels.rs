//! The force integral of many wheels at once.
//!
//! Here the lanes of a vector are wheels, and every formula is computed for all of them before the
//! next begins: none waits for another, as the nodes of a single wheel do. A wheel's nodes are
//! added up in the order in which [`integral`](super::integral) adds them, so that it has the same
//! bits alone and among others.

#![expect(clippy::inline_always, reason = "all of it is compiled once for each instruction set")]

use super::super::bulldozing::{self, SideWallLoad, WallResistance};
use super::super::lanes::{Each, WIDE, each};
use super::super::load_sinkage::Reaction;
use super::super::patch::ContactPatch;
use super::super::stress::wheels::{ShearNumbers, StressFields, StressLaws};
use super::super::stress::{
    AnisotropicShear, BoundedShear, IsotropicShear, MobilisedShear, RimPoint,
};
use super::integral::StressSums;
use super::rule::{EVEN, NodeBlock, Nodes, PieceRule};
use super::{LANES, sum};
use crate::elementary;

/// Wheels of one kind, each at a sinkage: the same shear law, and nodes that are as many.
pub(in crate::contact) struct Wheels<'a> {
    pub laws: &'a StressLaws,
    /// Sinkage of each wheel [m].
    pub sinkages: &'a Each,
    pub nodes: Nodes,
}

/// Σ over the nodes of each wheel, in the order of [`sum`].
#[inline(always)]
fn sums(of_nodes: &NodeSums) -> Each {
    let mut all = [0.0; WIDE];
    for wheel in 0..WIDE {
        all[wheel] = sum(&of_nodes.each_ref().map(|each| each[wheel]));
    }
    all
}

/// One number for each lane of a single wheel's nodes.
type NodeSums = [Each; LANES];

/// A point on the rim of each wheel.
struct Points {
    behind_entry: Each,
    angle: Each,
    sin: Each,
    height: Each,
}

impl Points {
    #[inline(always)]
    fn of(point: impl Fn(usize) -> RimPoint) -> Self {
        let zeros = [0.0; WIDE];
        let mut points = Self { behind_entry: zeros, angle: zeros, sin: zeros, height: zeros };
        for wheel in 0..WIDE {
            let RimPoint { behind_entry, angle, sin, height } = point(wheel);
            points.behind_entry[wheel] = behind_entry;
            points.angle[wheel] = angle;
            points.sin[wheel] = sin;
            points.height[wheel] = height;
        }
        points
    }

    #[inline(always)]
    fn at(&self, wheel: usize) -> RimPoint {
        RimPoint {
            behind_entry: self.behind_entry[wheel],
            angle: self.angle[wheel],
            sin: self.sin[wheel],
            height: self.height[wheel],
        }
    }
}

/// An integral on its way: [`StressSums`] for each lane of a single wheel's nodes.
struct Integral<'a> {
    fields: &'a StressFields<'a>,
    wheels: &'a Wheels<'a>,
    up: NodeSums,
    /// All that is not `up`, if it is asked for.
    rest: Option<Rest>,
}

#[derive(Default)]
struct Rest {
    shear_forward: NodeSums,
    normal_back: NodeSums,
    shear: NodeSums,
    lateral: NodeSums,
    lateral_below: NodeSums,
    lateral_ahead: NodeSums,
}

impl<'a> Integral<'a> {
    /// Over the whole arcs.
    #[inline(always)]
    fn new(fields: &'a StressFields<'a>, wheels: &'a Wheels<'a>, all: bool) -> Self {
        let rest = all.then(Rest::default);
        let mut integral = Self { fields, wheels, up: [[0.0; WIDE]; LANES], rest };
        match wheels.nodes {
            Nodes::BothSides(blocks) => {
                for block in blocks {
                    integral.add_both_sides(block);
                }
            }
            Nodes::Pieces(rule) => integral.add_pieces(rule),
        }
        integral
    }

    /// Two nodes that mirror each other share their normal stress.
    #[inline(always)]
    fn add_both_sides(&mut self, block: &NodeBlock) {
        let fields = self.fields;
        let (mut front, mut rear) = ([0.0; WIDE], [0.0; WIDE]);
        for wheel in 0..WIDE {
            let ContactPatch { entry, max_stress, exit } = fields.patch(wheel);
            (front[wheel], rear[wheel]) = (entry - max_stress, max_stress - exit);
        }
        for node in 0..LANES {
            let (abscissa, width) = (block.abscissa[node], block.width[node]);
            let before = Points::of(|wheel| fields.field(wheel).point(abscissa * front[wheel]));
            let behind = Points::of(|wheel| {
                fields.field(wheel).point((front[wheel] + rear[wheel]) - abscissa * rear[wheel])
            });
            let normal = self.normals(&before.height);
            for (points, span) in [(&before, &front), (&behind, &rear)] {
                self.add(node, points, &normal, width, span);
            }
        }
    }

    /// Piece by piece; a wheel with fewer pieces than another has some of no width before its last.
    #[inline(always)]
    fn add_pieces(&mut self, rule: &PieceRule) {
        let ends = self.fields.breaks();
        let most = ends.iter().map(|(count, _)| *count).max().unwrap_or(0);
        for piece in 0..most - 1 {
            let is_closing = piece == most - 2;
            let blocks = match piece {
                0 => rule.opening,
                _ if is_closing => rule.closing,
                _ => rule.inner,
            };
            let (mut start, mut span) = ([0.0; WIDE], [0.0; WIDE]);
            for (wheel, &(count, ref breaks)) in ends.iter().enumerate() {
                let last = count - 2;
                let (from, to) = match piece {
                    _ if is_closing => (breaks[last], breaks[last + 1]),
                    _ if piece < last => (breaks[piece], breaks[piece + 1]),
                    _ => (breaks[last], breaks[last]),
                };
                (start[wheel], span[wheel]) = (breaks[0] - from, from - to);
            }
            for block in blocks {
                self.add_piece(block, &start, &span);
            }
        }
    }

    #[inline(always)]
    fn add_piece(&mut self, block: &NodeBlock, start: &Each, span: &Each) {
        let fields = self.fields;
        for node in 0..LANES {
            let (abscissa, width) = (block.abscissa[node], block.width[node]);
            let behind = |wheel: usize| start[wheel] + abscissa * span[wheel];
            let points = Points::of(|wheel| fields.field(wheel).point(behind(wheel)));
            let heights = each(|wheel| fields.field(wheel).front_height(&points.at(wheel)));
            let normal = self.normals(&heights);
            self.add(node, &points, &normal, width, span);
        }
    }

    /// Adds one node of each wheel.
    ///
    /// * `width`, `span`: the node's share [-] of pieces [rad]
    #[inline(always)]
    fn add(&mut self, node: usize, points: &Points, normal: &Each, width: f64, span: &Each) {
        let is_all = self.rest.is_some();
        let (along, across) = match self.wheels.laws.kind() {
            MobilisedShear::Anisotropic(_) if is_all => {
                self.shear::<AnisotropicShear, 2>(points, normal)
            }
            // What it does along the wheel knows nothing of what it does across.
            MobilisedShear::Anisotropic(_) => self.shear::<AnisotropicShear, 1>(points, normal),
            MobilisedShear::Bounded(_) => self.shear::<BoundedShear, 2>(points, normal),
            MobilisedShear::Isotropic(_) => self.shear::<IsotropicShear, 1>(points, normal),
        };
        let up = &mut self.up[node];
        for wheel in 0..WIDE {
            let (sin, cos) = (points.sin[wheel], points.at(wheel).cosine());
            let width = width * span[wheel];
            up[wheel] += along[wheel] * width * sin + normal[wheel] * width * cos;
        }
        let Some(rest) = &mut self.rest else { return };
        for wheel in 0..WIDE {
            let (sin, cos) = (points.sin[wheel], points.at(wheel).cosine());
            let width = width * span[wheel];
            let (along, inward) = (along[wheel] * width, normal[wheel] * width);
            let across = across[wheel] * width;
            rest.shear_forward[node][wheel] += along * cos;
            rest.normal_back[node][wheel] += inward * sin;
            rest.shear[node][wheel] += along;
            rest.lateral[node][wheel] += across;
            rest.lateral_below[node][wheel] += across * cos;
            rest.lateral_ahead[node][wheel] += across * sin;
        }
    }

    /// Normal stresses [Pa] of points before the peak, by their heights over the rim's lowest point
    /// [radii].
    #[inline(always)]
    fn normals(&self, heights: &Each) -> Each {
        let fields = self.fields;
        let (mut depths, mut logs, mut normals) = ([0.0; WIDE], [0.0; WIDE], [0.0; WIDE]);
        for wheel in 0..WIDE {
            depths[wheel] = fields.field(wheel).depth(heights[wheel]);
            logs[wheel] = elementary::ln(depths[wheel]);
        }
        for wheel in 0..WIDE {
            normals[wheel] = fields.field(wheel).normal_at(depths[wheel], logs[wheel]);
        }
        normals
    }

    /// Shear stresses along and across each wheel [Pa], by so many of the law's decays.
    #[inline(always)]
    fn shear<L: ShearNumbers, const DECAYS: usize>(
        &self,
        points: &Points,
        normal: &Each,
    ) -> (Each, Each) {
        let fields = self.fields;
        let mut unmobilised = [[0.0; WIDE]; 2];
        let [first, second] = &mut unmobilised;
        for wheel in 0..WIDE {
            let shear = fields.laws.shear::<L>(wheel);
            let slipping = fields.field(wheel).slipping(&points.at(wheel));
            [first[wheel], second[wheel]] = shear.decays(&slipping);
        }
        for decays in &mut unmobilised[..DECAYS] {
            for decay in decays {
                *decay = elementary::exp(*decay);
            }
        }
        let (mut along, mut across) = ([0.0; WIDE], [0.0; WIDE]);
        for wheel in 0..WIDE {
            let left = [unmobilised[0][wheel], unmobilised[1][wheel]];
            let (shear, field) = (fields.laws.shear::<L>(wheel), fields.field(wheel));
            let slipping = field.slipping(&points.at(wheel));
            let stresses = field.shear(&shear, normal[wheel], left, &slipping);
            (along[wheel], across[wheel]) = stresses;
        }
        (along, across)
    }
}

/// What the kernel computes of each wheel.
#[derive(Default)]
pub(in crate::contact) struct Reactions {
    /// All of [`StressSums`] but `up`, in the order there.
    sums: [Each; 6],
    up: Each,
    side_wall: [Each; 3],
    max_normal_stress: Each,
    patch: [Each; 3],
}

impl Reactions {
    /// Returns the reaction of one wheel.
    pub(in crate::contact) fn of(&self, wheel: usize) -> Reaction {
        let [shear_forward, normal_back, shear, lateral, lateral_below, lateral_ahead] =
            self.sums.each_ref().map(|each| each[wheel]);
        let [force, below, ahead] = self.side_wall.each_ref().map(|each| each[wheel]);
        let [entry, max_stress, exit] = self.patch.each_ref().map(|each| each[wheel]);
        Reaction {
            patch: ContactPatch { entry, max_stress, exit },
            sums: StressSums {
                shear_forward,
                normal_back,
                up: self.up[wheel],
                shear,
                lateral,
                lateral_below,
                lateral_ahead,
            },
            side_wall: SideWallLoad::of_sums(force, below, ahead),
            max_normal_stress: self.max_normal_stress[wheel],
        }
    }
}

/// ∫ (τ_x sin θ + σ cos θ) dθ of each wheel [Pa·rad].
///
/// * `all`: the wheels' walls, and where to put all that the kernel computes, if that is asked for
#[inline(always)]
pub(in crate::contact) fn reactions(
    wheels: &Wheels<'_>,
    all: Option<(&Walls, &mut Reactions)>,
) -> Each {
    let fields = StressFields::new(wheels.laws, wheels.sinkages);
    let integral = Integral::new(&fields, wheels, all.is_some());
    let up = sums(&integral.up);
    let (Some((walls, all)), Some(rest)) = (all, &integral.rest) else { return up };
    let parts = [
        &rest.shear_forward,
        &rest.normal_back,
        &rest.shear,
        &rest.lateral,
        &rest.lateral_below,
        &rest.lateral_ahead,
    ];
    for (sum, of_nodes) in all.sums.iter_mut().zip(parts) {
        *sum = sums(of_nodes);
    }
    all.up = up;
    all.max_normal_stress = fields.max_normal;
    all.patch = [fields.entry, fields.max_stress, fields.exit];
    side_walls(&fields, walls, &mut all.side_wall);
    up
}

/// The soils that side walls are pushed through.
pub(in crate::contact) struct Walls {
    cohesive: Each,
    frictional: Each,
    heaped: Each,
}

impl Walls {
    pub(in crate::contact) fn of(wall: impl Fn(usize) -> WallResistance) -> Self {
        let mut walls =
            Self { cohesive: [0.0; WIDE], frictional: [0.0; WIDE], heaped: [0.0; WIDE] };
        for wheel in 0..WIDE {
            let WallResistance { cohesive, frictional, heaped } = wall(wheel);
            walls.cohesive[wheel] = cohesive;
            walls.frictional[wheel] = frictional;
            walls.heaped[wheel] = heaped;
        }
        walls
    }

    #[inline(always)]
    fn at(&self, wheel: usize) -> WallResistance {
        WallResistance {
            cohesive: self.cohesive[wheel],
            frictional: self.frictional[wheel],
            heaped: self.heaped[wheel],
        }
    }
}

/// The force on the side wall of each wheel [N], and its moments [N·m].
#[inline(always)]
fn side_walls(fields: &StressFields<'_>, walls: &Walls, loads: &mut [Each; 3]) {
    let mut strips = [[[0.0; WIDE]; LANES]; 3];
    for node in 0..LANES {
        let (abscissa, width) = (EVEN.abscissa[node], EVEN.width[node]);
        let [force, below, ahead] = &mut strips;
        for wheel in 0..WIDE {
            let wall = walls.at(wheel).pressed(fields.field(wheel).cohesion_share());
            let (patch, radius) = (fields.patch(wheel), fields.laws.radius[wheel]);
            (force[node][wheel], below[node][wheel], ahead[node][wheel]) =
                bulldozing::strip(&wall, &patch, radius, (abscissa, width));
        }
    }
    for (load, of_nodes) in loads.iter_mut().zip(&strips) {
        *load = sums(of_nodes);
    }
}
