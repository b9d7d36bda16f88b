//! The facets of half a wheel, and the sum of what they meet.
//!
//! Integrals over the angle θ from straight down go by θ = δ sinh u: where a wheel slips little,
//! the direction of its rim turns within an angle of δ = |slip velocity|/|ω r_s| beside the lowest
//! point, and there the nodes have to be.
//!
//! Eight angles are computed side by side, as the nodes of the classical models' kernel are
//! ([`kernel`](super::super::kernel)): loops over lanes without branches, which become vector
//! instructions.

#![expect(clippy::inline_always, reason = "all of it is compiled once for each instruction set")]

use super::super::forces::WheelForces;
use super::super::gauss::Rule;
use super::super::inputs::Contact;
use super::super::kernel::{LANES, Lanes};
use super::super::patch::ContactPatch;
use super::exposure::{Comb, Exposure};
use super::facet::{self, Vector, dot, scaled};
use super::sums::{Part, Sums};
use crate::elementary::{self, wide};
use crate::soil::Soil;
use crate::wheel::Wheel;

/// The half of a wheel from straight down to the front, in the soil.
pub(super) struct FrontHalf {
    motion: Motion,
    wheel: Wheel,
    comb: Option<Comb>,
    /// Height of the soil's surface below the hub [m].
    surface: f64,
    /// ξ [N/m³].
    stiffness: f64,
    friction: Friction,
}

/// Coefficients of friction [-].
struct Friction {
    /// Between wheel and soil.
    wheel: f64,
    /// In the soil.
    soil: f64,
}

/// Velocities over the rim's speed [-].
struct Motion {
    forward: f64,
    lateral: f64,
    sinking: f64,
    /// Per metre of radius [1/m].
    spin: f64,
}

impl Motion {
    /// Velocity [-] at a place, seen from the hub [m].
    #[inline(always)]
    fn at(&self, x: f64, z: f64) -> Vector {
        [self.forward + self.spin * z, self.lateral, -self.spin * x - self.sinking]
    }

    /// Its direction; downward where nothing moves.
    #[inline(always)]
    fn direction_at(&self, x: f64, z: f64) -> Vector {
        let velocity = self.at(x, z);
        let speed = dot(velocity, velocity).sqrt();
        let moves = speed > 0.0;
        let per_speed = 1.0 / if moves { speed } else { 1.0 };
        let [x, y, z] = scaled(velocity, per_speed);
        [x, y, if moves { z } else { -1.0 }]
    }
}

/// Some radii of the wheel, side by side.
struct Rays {
    /// Each stands for this angle [rad].
    width: Lanes,
    /// From straight down [rad].
    angle: Lanes,
    sin: Lanes,
    cos: Lanes,
    exposure: [Exposure; LANES],
}

impl Rays {
    /// Out of the rim.
    #[inline(always)]
    fn outward(&self, lane: usize) -> Vector {
        [self.sin[lane], 0.0, -self.cos[lane]]
    }

    /// Along the rim, the way of growing angles.
    #[inline(always)]
    fn along(&self, lane: usize) -> Vector {
        [self.cos[lane], 0.0, self.sin[lane]]
    }
}

/// The soil over a circle about the hub: how its angles are integrated.
struct Arc {
    layer: f64,
    end: f64,
}

/// Pieces of both side faces along some radii.
struct Annulus {
    /// From these radii [m]
    inner: Lanes,
    /// to this [m].
    outer: f64,
    /// Share of it that is covered [-].
    share: Lanes,
    friction: f64,
}

impl FrontHalf {
    pub(super) fn new(contact: &Contact, sinkage: f64) -> Self {
        let Contact { wheel, soil, slip, gravity } = contact;
        let radius = wheel.shearing_radius();
        let internal = soil.friction();
        Self {
            motion: Motion {
                forward: slip.forward,
                lateral: slip.lateral,
                sinking: slip.creep(),
                spin: slip.rim / radius,
            },
            wheel: *wheel,
            comb: Comb::of(wheel),
            surface: radius - sinkage,
            stiffness: soil.rft.scale * facet::stiffness(soil.unit_weight(*gravity), internal),
            friction: Friction { wheel: surface_friction(soil), soil: internal },
        }
    }

    /// The soil's reaction on this half; its patch holds the angle of the largest normal stress.
    ///
    /// * `arc`: a rule whose nodes fill the lanes
    #[inline(always)]
    pub(super) fn reaction(&self, arc: &Rule, height: &Rule) -> WheelForces {
        let mut sums = Sums::default();
        if let Some(circle) = self.arc_of(self.wheel.radius) {
            for nodes in arc.chunks_exact(LANES) {
                let rays = self.rays(&circle, nodes);
                self.add_rim(&mut sums, &rays);
                self.add_disc(&mut sums, &rays, height);
            }
        }
        if let Some(comb) = &self.comb
            && let Some(circle) = self.arc_of(self.wheel.shearing_radius())
        {
            for nodes in arc.chunks_exact(LANES) {
                let rays = self.rays(&circle, nodes);
                self.add_grousers(&mut sums, comb, &rays, height);
                self.add_shut_in(&mut sums, &rays, height);
            }
        }
        sums.total()
    }

    /// The submerged arc of a circle about the hub; none if it is above the soil.
    #[inline(always)]
    fn arc_of(&self, radius: f64) -> Option<Arc> {
        let depth = radius - self.surface;
        if depth <= 0.0 {
            return None;
        }
        let entry = ContactPatch::of_depth(depth / radius, 0.0, 0.0).entry;
        let layer = self.layer().clamp(SHORTEST_LAYER * entry, LONGEST_LAYER * entry);
        Some(Arc { layer, end: wide::asinh(entry / layer) })
    }

    /// The angle [rad] beside the lowest point within which slip turns the rim's direction.
    #[inline(always)]
    fn layer(&self) -> f64 {
        let spin = self.motion.spin * self.wheel.shearing_radius();
        let slip = wide::hypot(self.motion.forward - spin, self.motion.lateral);
        slip / spin.abs().max(f64::MIN_POSITIVE)
    }

    #[inline(always)]
    fn rays(&self, arc: &Arc, nodes: &Rule) -> Rays {
        let mut rays = Rays {
            width: [0.0; LANES],
            angle: [0.0; LANES],
            sin: [0.0; LANES],
            cos: [0.0; LANES],
            exposure: [Exposure::BARE; LANES],
        };
        for (lane, (node, weight)) in nodes.iter().enumerate() {
            let (sinh, cosh) = elementary::sinh_cosh(node * arc.end);
            rays.width[lane] = weight * arc.end * arc.layer * cosh;
            rays.angle[lane] = arc.layer * sinh;
            (rays.sin[lane], rays.cos[lane]) = elementary::sin_cos(rays.angle[lane]);
        }
        if let Some(comb) = &self.comb {
            let tip = self.wheel.shearing_radius();
            for lane in 0..LANES {
                let (outward, along) = (rays.outward(lane), rays.along(lane));
                let velocity = self.motion.at(outward[0] * tip, outward[2] * tip);
                rays.exposure[lane] = comb.exposure(dot(velocity, outward), dot(velocity, along));
            }
        }
        rays
    }

    /// Strips across the rim, as far as they lie open.
    #[inline(always)]
    fn add_rim(&self, sums: &mut Sums, rays: &Rays) {
        let r = self.wheel.radius;
        self.add_cylinder(sums, rays, r, self.friction.wheel, |lane| rays.exposure[lane].rim);
    }

    /// Strips of a cylinder about the hub, with a share of their area.
    #[inline(always)]
    fn add_cylinder(
        &self,
        sums: &mut Sums,
        rays: &Rays,
        radius: f64,
        friction: f64,
        share: impl Fn(usize) -> f64,
    ) {
        for lane in 0..LANES {
            let normal = rays.outward(lane);
            let (x, z) = (normal[0] * radius, normal[2] * radius);
            let depth = (-z - self.surface).max(0.0);
            let met = facet::response::<false>(normal, self.motion.direction_at(x, z), friction);
            let lead = facet::lead_share(met.lead);
            let area = share(lane) * radius * rays.width[lane] * self.wheel.width;
            let pressure = self.stiffness * depth * (met.pressure * lead);
            let push = scaled(normal, -pressure * area);
            let shear = scaled(met.shear, self.stiffness * depth * area * lead);
            let counts = depth > 0.0 && lead > 0.0;
            sums.middle.note_pressure(lane, if counts { pressure } else { 0.0 }, rays.angle[lane]);
            sums.middle.add(Part::Rim, lane, [x, 0.0, z], push, shear);
        }
    }

    /// Both side faces, from the soil's surface to the rim.
    #[inline(always)]
    fn add_disc(&self, sums: &mut Sums, rays: &Rays, rule: &Rule) {
        let mut disc = Annulus {
            inner: [0.0; LANES],
            outer: self.wheel.radius,
            share: [1.0; LANES],
            friction: self.friction.wheel,
        };
        for lane in 0..LANES {
            disc.inner[lane] = self.surface / rays.cos[lane];
        }
        self.add_sides(sums, rays, &disc, rule);
    }

    /// Grousers: plates with two faces, one of which leads.
    #[inline(always)]
    fn add_grousers(&self, sums: &mut Sums, comb: &Comb, rays: &Rays, rule: &Rule) {
        let tip = self.wheel.shearing_radius();
        let per_height = comb.density * self.wheel.width;
        for (node, weight) in rule {
            for lane in 0..LANES {
                let (outward, normal) = (rays.outward(lane), rays.along(lane));
                let Exposure { grouser, share, .. } = rays.exposure[lane];
                let submerged = self.surface / rays.cos[lane];
                let inner = tip - grouser;
                let inner = if inner > submerged { inner } else { submerged };
                let open = (tip - inner).max(0.0);
                let radius = inner + node * open;
                let area = share * per_height * rays.width[lane] * (weight * open);
                let (x, z) = (outward[0] * radius, outward[2] * radius);
                let depth = (-z - self.surface).max(0.0);
                let direction = self.motion.direction_at(x, z);
                let met = facet::response::<false>(normal, direction, self.friction.wheel);
                // Shares of both faces add up to 1; the push is the difference of theirs.
                let per_stress = self.stiffness * depth * area;
                let facing = 2.0 * facet::lead_share(met.lead) - 1.0;
                let push = scaled(normal, -met.pressure * facing * per_stress);
                let shear = scaled(met.shear, per_stress);
                sums.middle.add(Part::Grouser, lane, [x, 0.0, z], push, shear);
            }
        }
    }

    /// The soil that the grousers shut in: a cylinder of their tips' radius with its own side faces.
    #[inline(always)]
    fn add_shut_in(&self, sums: &mut Sums, rays: &Rays, rule: &Rule) {
        let (rim, tip) = (self.wheel.radius, self.wheel.shearing_radius());
        let mut shut = Annulus {
            inner: [0.0; LANES],
            outer: tip,
            share: [0.0; LANES],
            friction: self.friction.soil,
        };
        for lane in 0..LANES {
            let submerged = self.surface / rays.cos[lane];
            shut.inner[lane] = if submerged > rim { submerged } else { rim };
            shut.share[lane] = 1.0 - rays.exposure[lane].rim;
        }
        self.add_cylinder(sums, rays, tip, self.friction.soil, |lane| shut.share[lane]);
        self.add_sides(sums, rays, &shut, rule);
    }

    /// Facets of both side faces.
    #[inline(always)]
    fn add_sides(&self, sums: &mut Sums, rays: &Rays, annulus: &Annulus, rule: &Rule) {
        for (node, weight) in rule {
            let mut per_stress = [0.0; LANES];
            let mut places = [[0.0; LANES]; 2];
            let mut directions = [[0.0; LANES]; 3];
            for lane in 0..LANES {
                let inner = annulus.inner[lane];
                let thickness = (annulus.outer - inner).max(0.0);
                let radius = inner + node * thickness;
                let [x, _, z] = scaled(rays.outward(lane), radius);
                let depth = (-z - self.surface).max(0.0);
                let ring = weight * thickness * radius * rays.width[lane];
                per_stress[lane] = self.stiffness * depth * (annulus.share[lane] * ring);
                (places[0][lane], places[1][lane]) = (x, z);
                let direction = self.motion.direction_at(x, z);
                for axis in 0..3 {
                    directions[axis][lane] = direction[axis];
                }
            }
            for (side, sum) in [(1.0, &mut sums.left), (-1.0, &mut sums.right)] {
                // Mostly one side leads and the other one trails everywhere.
                if directions[1].iter().all(|across| facet::lead_share(side * across) == 0.0) {
                    continue;
                }
                let across = side * (0.5 * self.wheel.width);
                for lane in 0..LANES {
                    let direction = [directions[0][lane], directions[1][lane], directions[2][lane]];
                    let normal = [0.0, side, 0.0];
                    let met = facet::response::<true>(normal, direction, annulus.friction);
                    let share = facet::lead_share(met.lead) * per_stress[lane];
                    let place = [places[0][lane], across, places[1][lane]];
                    let push = scaled(normal, -met.pressure * share);
                    sum.add(Part::SideWall, lane, place, push, scaled(met.shear, share));
                }
            }
        }
    }
}

/// The layer of turning directions, in entry angles: thinner ones carry nothing that counts, and
/// thicker ones are no layer.
const SHORTEST_LAYER: f64 = 1e-3;
const LONGEST_LAYER: f64 = 3.0;

/// Friction between the wheel and the soil, *μ_s* [-].
fn surface_friction(soil: &Soil) -> f64 {
    soil.rft.surface_friction_angle.map_or_else(|| soil.friction(), wide::tan)
}
