//! The facets of a wheel, half by half, and the sum of what they meet.
//!
//! Integrals over the angle θ from straight down go by θ = δ sinh u: where a wheel slips little,
//! the direction of its rim turns within an angle of δ = |slip velocity|/|ω r_s| beside the lowest
//! point, and there the nodes have to be.
//!
//! The angles of a half are computed side by side: loops over lanes without branches, which become
//! vector instructions. Along a ray everything is seen in directions of its own, out of the rim and
//! along it, in which a facet's inclination is the ray's and the motion out of the rim the same at
//! every radius.

#![expect(clippy::inline_always, reason = "all of it is compiled once for each instruction set")]

use super::super::forces::WheelForces;
use super::super::gauss::Rule;
use super::super::inputs::Contact;
use super::super::lanes::{Each, WIDE, each};
use super::super::patch::ContactPatch;
use super::exposure::{Comb, Exposure};
use super::facet::{self, Faces, Inclined, Response, lead_share};
use super::nodes::Nodes;
use super::rays::Rays;
use super::sums::{RaySums, SideSums, Sums};
use crate::elementary::{self, wide};
use crate::soil::Soil;
use crate::wheel::Wheel;

/// A wheel in the soil, made of facets.
pub(super) struct FacetedWheel {
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
#[derive(Clone, Copy)]
struct Motion {
    forward: f64,
    lateral: f64,
    sinking: f64,
    /// Per metre of radius [1/m].
    spin: f64,
}

impl Motion {
    /// The same seen in a mirror that swaps front and back.
    fn front_to_back(self) -> Self {
        Self { forward: -self.forward, spin: -self.spin, ..self }
    }

    /// The hub's velocity [-] along some rays.
    #[inline(always)]
    fn of_hub(&self, rays: &Rays) -> HubVelocity {
        let (forward, sinking) = (self.forward, self.sinking);
        HubVelocity {
            outward: each(|lane| forward * rays.sin[lane] + sinking * rays.cos[lane]),
            along: each(|lane| forward * rays.cos[lane] - sinking * rays.sin[lane]),
        }
    }

    /// Directions of motion at places of each ray, so far from the hub [m]; downward where nothing
    /// moves.
    #[inline(always)]
    fn directions(&self, rays: &Rays, hub: &HubVelocity, radius: &Each) -> Directions {
        let lateral = self.lateral;
        let rim = each(|lane| hub.along[lane] - self.spin * radius[lane]);
        let speed = each(|lane| {
            let (outward, along) = (hub.outward[lane], rim[lane]);
            (outward * outward + along * along + lateral * lateral).sqrt()
        });
        let per_speed = each(|lane| 1.0 / if speed[lane] > 0.0 { speed[lane] } else { 1.0 });
        let moving = |lane: usize, part: f64, still: f64| {
            if speed[lane] > 0.0 { part * per_speed[lane] } else { still }
        };
        let outward = each(|lane| moving(lane, hub.outward[lane], rays.cos[lane]));
        let along = each(|lane| moving(lane, rim[lane], -rays.sin[lane]));
        Directions {
            across: each(|lane| lateral * per_speed[lane]),
            down: each(|lane| outward[lane] * rays.cos[lane] - along[lane] * rays.sin[lane]),
            outward,
            along,
        }
    }
}

/// The hub's velocity [-] out of the rim, as everywhere on a ray, and along the rim.
struct HubVelocity {
    outward: Each,
    along: Each,
}

/// Directions of motion [-]: out of the rim, along it the way of growing angles, to the left; and
/// straight down.
struct Directions {
    outward: Each,
    along: Each,
    across: Each,
    down: Each,
}

/// The soil over a circle about the hub: how its angles are integrated.
struct Arc {
    layer: f64,
    end: f64,
}

/// Pieces of both side faces along some radii.
struct Annulus {
    /// From these radii [m]
    inner: Each,
    /// to this [m].
    outer: f64,
    /// Share of it that is covered [-].
    share: Each,
    friction: f64,
}

/// One half of the wheel: some of its rays, the way they move, and the sum that they add to.
struct Half<'a> {
    facets: &'a FacetedWheel,
    motion: &'a Motion,
    hub: HubVelocity,
    rays: &'a Rays,
    sums: &'a mut Sums,
}

impl FacetedWheel {
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
            friction: Friction { wheel: surface_friction(soil, internal), soil: internal },
        }
    }

    /// More than the soil's force on all facets [N]: the law's largest stress, as at the deepest of
    /// them.
    pub(super) fn most_force(&self) -> f64 {
        let Wheel { radius, width, .. } = self.wheel;
        let tip = self.wheel.shearing_radius();
        let depth = tip - self.surface;
        let entry = ContactPatch::of_depth(depth / tip, 0.0, 1.0).entry;
        let rims = 2.0 * entry * width * (radius + tip);
        // Both faces of the wheel, and both of the soil that the grousers shut in.
        let faces = 4.0 * entry * tip * depth;
        let grousers = self
            .comb
            .as_ref()
            .map_or(0.0, |comb| 2.0 * entry * comb.density * width * (tip - radius));
        facet::MOST_STRESS * self.stiffness * depth * (rims + faces + grousers)
    }

    /// The soil's reaction on the front half, and on the back half as the mirror shows it, which
    /// makes a front of it. Their patches hold the angles of the largest normal stress.
    #[inline(always)]
    pub(super) fn reaction(&self, nodes: &Nodes) -> (WheelForces, WheelForces) {
        let mut sums = [Sums::default(), Sums::default()];
        let motions = [self.motion, self.motion.front_to_back()];
        if let Some(circle) = self.arc_of(self.wheel.radius) {
            for nodes_of_arc in nodes.arc.chunks_exact(WIDE) {
                let rays = circle.rays(nodes_of_arc);
                for (motion, sums) in motions.iter().zip(&mut sums) {
                    self.half(motion, &rays, sums).add_wheel(nodes);
                }
            }
        }
        if let Some(comb) = &self.comb
            && let Some(circle) = self.arc_of(self.wheel.shearing_radius())
        {
            for nodes_of_arc in nodes.arc.chunks_exact(WIDE) {
                let rays = circle.rays(nodes_of_arc);
                for (motion, sums) in motions.iter().zip(&mut sums) {
                    self.half(motion, &rays, sums).add_comb(comb, nodes);
                }
            }
        }
        let [front, back] = sums;
        (front.total(), back.total())
    }

    #[inline(always)]
    fn half<'a>(&'a self, motion: &'a Motion, rays: &'a Rays, sums: &'a mut Sums) -> Half<'a> {
        Half { facets: self, motion, hub: motion.of_hub(rays), rays, sums }
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
}

impl Arc {
    #[inline(always)]
    fn rays(&self, nodes: &Rule) -> Rays {
        let (mut width, mut angle) = ([0.0; WIDE], [0.0; WIDE]);
        let (mut sin, mut cos) = ([0.0; WIDE], [0.0; WIDE]);
        for (lane, (node, weight)) in nodes.iter().enumerate().take(WIDE) {
            let (sinh, cosh) = elementary::sinh_cosh(node * self.end);
            width[lane] = weight * self.end * self.layer * cosh;
            angle[lane] = self.layer * sinh;
            (sin[lane], cos[lane]) = elementary::sin_cos(angle[lane]);
        }
        Rays { width, angle, sin, cos }
    }
}

impl Half<'_> {
    /// The rim, as far as it lies open, and both side faces from the soil's surface to it.
    #[inline(always)]
    fn add_wheel(&mut self, nodes: &Nodes) {
        let FacetedWheel { wheel, friction, surface, .. } = self.facets;
        let open = match &self.facets.comb {
            Some(comb) => self.exposure(comb).rim,
            None => [1.0; WIDE],
        };
        self.add_cylinder(wheel.radius, friction.wheel, &open);
        let disc = Annulus {
            inner: each(|lane| surface / self.rays.cos[lane]),
            outer: wheel.radius,
            share: [1.0; WIDE],
            friction: friction.wheel,
        };
        self.add_sides(&disc, nodes.disc);
    }

    /// Grousers, and the soil that they shut in: a cylinder of their tips' radius with its own side
    /// faces.
    #[inline(always)]
    fn add_comb(&mut self, comb: &Comb, nodes: &Nodes) {
        let FacetedWheel { wheel, friction, surface, .. } = self.facets;
        let exposure = self.exposure(comb);
        self.add_grousers(comb, &exposure, nodes.height);
        let (rim, tip) = (wheel.radius, wheel.shearing_radius());
        let shut = each(|lane| 1.0 - exposure.rim[lane]);
        self.add_cylinder(tip, friction.soil, &shut);
        let inner = each(|lane| {
            let submerged = surface / self.rays.cos[lane];
            if submerged > rim { submerged } else { rim }
        });
        let ring = Annulus { inner, outer: tip, share: shut, friction: friction.soil };
        self.add_sides(&ring, nodes.height);
    }

    /// What lies open of the wheel along the rays.
    #[inline(always)]
    fn exposure(&self, comb: &Comb) -> Exposure {
        let at_tip = self.motion.spin * self.facets.wheel.shearing_radius();
        comb.exposure(&self.hub.outward, &each(|lane| self.hub.along[lane] - at_tip))
    }

    #[inline(always)]
    fn directions(&self, radius: &Each) -> Directions {
        self.motion.directions(self.rays, &self.hub, radius)
    }

    /// Depths below the soil's surface [m], not negative, of places so far from the hub [m].
    #[inline(always)]
    fn depths(&self, radius: &Each) -> Each {
        each(|lane| (radius[lane] * self.rays.cos[lane] - self.facets.surface).max(0.0))
    }

    /// Strips of a cylinder about the hub, with a share of their area.
    #[inline(always)]
    fn add_cylinder(&mut self, radius: f64, friction: f64, share: &Each) {
        let radii = [radius; WIDE];
        let toward = self.directions(&radii);
        let lead = each(|lane| lead_share(toward.outward[lane]));
        if (0..WIDE).all(|lane| lead[lane] * share[lane] == 0.0) {
            return;
        }
        let faces = Faces::new(&Inclined::at(self.rays.cos), &toward.down, &toward.outward);
        let sliding = each(|lane| {
            let (along, across) = (toward.along[lane], toward.across[lane]);
            along * along + across * across
        });
        let Response { pressure, drag, lift } =
            facet::response(&faces, &toward.outward, &sliding, friction);
        let depth = self.depths(&radii);
        let per_width = radius * self.facets.wheel.width;
        let mut forces = RaySums::default();
        for lane in 0..WIDE {
            let area = share[lane] * self.rays.width[lane] * per_width;
            let per_stress = self.facets.stiffness * depth[lane] * lead[lane];
            let stress = per_stress * pressure[lane];
            let shear = per_stress * area;
            let along = drag[lane] * toward.along[lane] - lift[lane] * self.rays.sin[lane];
            let across = drag[lane] * toward.across[lane];
            forces.add(lane, radius, -stress * area, shear * along, shear * across);
            self.sums.note_pressure(lane, stress, self.rays.angle[lane]);
        }
        self.sums.add_cylinder(self.rays, &forces);
    }

    /// Grousers: plates with two faces, one of which leads.
    #[inline(always)]
    fn add_grousers(&mut self, comb: &Comb, exposure: &Exposure, rule: &Rule) {
        let FacetedWheel { wheel, friction, surface, stiffness, .. } = self.facets;
        let tip = wheel.shearing_radius();
        let per_height = comb.density * wheel.width;
        let inner = each(|lane| {
            let (submerged, inner) = (surface / self.rays.cos[lane], tip - exposure.grouser[lane]);
            if inner > submerged { inner } else { submerged }
        });
        let open = each(|lane| (tip - inner[lane]).max(0.0));
        let law = Inclined::at(self.rays.sin);
        let mut forces = RaySums::default();
        for (node, weight) in rule {
            let radius = each(|lane| inner[lane] + node * open[lane]);
            let (toward, depth) = (self.directions(&radius), self.depths(&radius));
            // The face that looks down looks back along the rim.
            let lead = each(|lane| -toward.along[lane]);
            let sliding = each(|lane| {
                let (outward, across) = (toward.outward[lane], toward.across[lane]);
                outward * outward + across * across
            });
            let faces = Faces::new(&law, &toward.down, &lead);
            let Response { pressure, drag, lift } =
                facet::response(&faces, &lead, &sliding, friction.wheel);
            for lane in 0..WIDE {
                let area = exposure.share[lane]
                    * per_height
                    * self.rays.width[lane]
                    * (weight * open[lane]);
                let per_stress = stiffness * depth[lane] * area;
                // Shares of both faces add up to 1; the push is the difference of theirs.
                let facing = 2.0 * lead_share(lead[lane]) - 1.0;
                let outward = drag[lane] * toward.outward[lane] + lift[lane] * self.rays.cos[lane];
                let along = pressure[lane] * facing;
                let across = drag[lane] * toward.across[lane];
                let force = [outward, along, across].map(|part| per_stress * part);
                forces.add(lane, radius[lane], force[0], force[1], force[2]);
            }
        }
        self.sums.add_grousers(self.rays, &forces);
    }

    /// Facets of both side faces.
    #[inline(always)]
    fn add_sides(&mut self, annulus: &Annulus, rule: &Rule) {
        if annulus.share.iter().all(|share| *share == 0.0) {
            return;
        }
        let thickness = each(|lane| (annulus.outer - annulus.inner[lane]).max(0.0));
        let law = Inclined::at([0.0; WIDE]);
        let mut forces = SideSums::default();
        for (node, weight) in rule {
            let radius = each(|lane| annulus.inner[lane] + node * thickness[lane]);
            let (toward, depth) = (self.directions(&radius), self.depths(&radius));
            let per_stress = each(|lane| {
                let ring = weight * thickness[lane] * radius[lane] * self.rays.width[lane];
                self.facets.stiffness * depth[lane] * (annulus.share[lane] * ring)
            });
            let faces = Faces::new(&law, &toward.down, &toward.across);
            let sliding = each(|lane| {
                let (outward, along) = (toward.outward[lane], toward.along[lane]);
                outward * outward + along * along
            });
            for (side, sum) in [(1.0, &mut forces.left), (-1.0, &mut forces.right)] {
                let lead = each(|lane| side * toward.across[lane]);
                // Mostly one side leads and the other one trails everywhere.
                if lead.iter().all(|lead| lead_share(*lead) == 0.0) {
                    continue;
                }
                let Response { pressure, drag, lift } =
                    facet::response(&faces, &lead, &sliding, annulus.friction);
                for lane in 0..WIDE {
                    let (sin, cos) = (self.rays.sin[lane], self.rays.cos[lane]);
                    let outward = drag[lane] * toward.outward[lane] + lift[lane] * cos;
                    let along = drag[lane] * toward.along[lane] - lift[lane] * sin;
                    let push = -side * pressure[lane];
                    let share = lead_share(lead[lane]) * per_stress[lane];
                    sum.add(lane, radius[lane], share * outward, share * along, share * push);
                }
            }
        }
        self.sums.add_sides(self.rays, &forces, 0.5 * self.facets.wheel.width);
    }
}

/// The layer of turning directions, in entry angles: thinner ones carry nothing that counts, and
/// thicker ones are no layer.
const SHORTEST_LAYER: f64 = 1e-3;
const LONGEST_LAYER: f64 = 3.0;

/// Friction between the wheel and the soil, *μ_s* [-].
///
/// * `internal`: the soil's own friction, of a wheel as rough as that
fn surface_friction(soil: &Soil, internal: f64) -> f64 {
    soil.rft.surface_friction_angle.map_or(internal, wide::tan)
}
