//! The facets of half a wheel, and the sum of what they meet.
//!
//! Integrals over the angle θ from straight down go by θ = δ sinh u: where a wheel slips little,
//! the direction of its rim turns within an angle of δ = |slip velocity|/|ω r_s| beside the lowest
//! point, and there the nodes have to be.

use super::super::forces::WheelForces;
use super::super::gauss::Rule;
use super::super::model::Contact;
use super::super::patch::ContactPatch;
use super::exposure::Comb;
use super::facet;
use crate::soil::Soil;
use crate::units::Vec3;
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
    fn at(&self, place: Vec3) -> Vec3 {
        Vec3::new(
            self.forward + self.spin * place.z,
            self.lateral,
            -self.spin * place.x - self.sinking,
        )
    }

    /// Its direction; downward where nothing moves.
    fn direction_at(&self, place: Vec3) -> Vec3 {
        let velocity = self.at(place);
        let speed = velocity.norm();
        if speed > 0.0 { velocity / speed } else { -Vec3::z() }
    }
}

/// To which part of the wheel a facet belongs.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Rim,
    Grouser,
    Flank,
}

/// Reactions of the rim with its grousers and of both flanks.
#[derive(Default)]
struct Sums {
    middle: WheelForces,
    left: WheelForces,
    right: WheelForces,
}

/// A place of the wheel in the soil.
#[derive(Clone, Copy)]
struct Spot {
    /// From the hub [m].
    place: Vec3,
    /// Below the surface [m].
    depth: f64,
    /// Of its motion [-].
    direction: Vec3,
}

/// A narrow piece of both flanks, along a radius.
struct Ray {
    /// From straight down [rad].
    angle: f64,
    /// [rad]
    width: f64,
    /// From this radius [m]
    inner: f64,
    /// to this [m].
    outer: f64,
    /// Share of it that is covered [-].
    share: f64,
    friction: f64,
}

/// A piece of surface.
struct Facet {
    part: Part,
    normal: Vec3,
    /// [m²]
    area: f64,
    friction: f64,
}

impl FrontHalf {
    pub(super) fn new(contact: &Contact, sinkage: f64) -> Self {
        let Contact { wheel, soil, slip, gravity } = contact;
        let radius = wheel.shearing_radius();
        let internal = soil.friction_angle.tan();
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
    pub(super) fn reaction(&self, arc: &Rule, height: &Rule) -> WheelForces {
        let mut sums = Sums::default();
        self.for_each_angle(self.wheel.radius, arc, |angle, width| {
            self.add_rim(&mut sums, angle, width);
            self.add_disc(&mut sums, angle, width, height);
        });
        if let Some(comb) = &self.comb {
            self.for_each_angle(self.wheel.shearing_radius(), arc, |angle, width| {
                self.add_comb(&mut sums, comb, angle, width, height);
            });
        }
        // The sides together first, so that a mirror between left and right keeps every bit.
        let mut sum = sums.middle + (sums.left + sums.right);
        // Largest values and their places do not add up.
        sum.max_normal_stress = sums.middle.max_normal_stress;
        sum.drawbar_pull = sum.thrust + sum.motion_resistance;
        sum
    }

    /// Calls `visit` with the angles [rad] and weights [rad] of a rule over the submerged arc of a
    /// circle about the hub.
    fn for_each_angle(&self, radius: f64, rule: &Rule, mut visit: impl FnMut(f64, f64)) {
        let depth = radius - self.surface;
        if depth <= 0.0 {
            return;
        }
        let entry = ContactPatch::of_depth(depth / radius, 0.0, 0.0).entry;
        let layer = self.layer().clamp(SHORTEST_LAYER * entry, LONGEST_LAYER * entry);
        let end = (entry / layer).asinh();
        for (node, weight) in rule {
            let u = node * end;
            visit(layer * u.sinh(), weight * end * layer * u.cosh());
        }
    }

    /// The angle [rad] beside the lowest point within which slip turns the rim's direction.
    fn layer(&self) -> f64 {
        let spin = self.motion.spin * self.wheel.shearing_radius();
        let slip = (self.motion.forward - spin).hypot(self.motion.lateral);
        slip / spin.abs().max(f64::MIN_POSITIVE)
    }

    /// A strip across the rim, as far as it lies open.
    fn add_rim(&self, sums: &mut Sums, angle: f64, width: f64) {
        let (r, b) = (self.wheel.radius, self.wheel.width);
        let outward = outward(angle);
        let open = self.comb.as_ref().map_or(1.0, |comb| self.exposure(comb, angle).rim);
        let area = open * r * width * b;
        let friction = self.friction.wheel;
        let Some(spot) = self.spot(outward * r) else { return };
        self.add(
            &mut sums.middle,
            &spot,
            &Facet { part: Part::Rim, normal: outward, area, friction },
        );
    }

    fn exposure(&self, comb: &Comb, angle: f64) -> super::exposure::Exposure {
        let outward = outward(angle);
        let velocity = self.motion.at(outward * self.wheel.shearing_radius());
        comb.exposure(velocity.dot(&outward), velocity.dot(&forward_along(angle)))
    }

    /// A ray of both side faces, from the soil's surface to the rim.
    fn add_disc(&self, sums: &mut Sums, angle: f64, width: f64, rule: &Rule) {
        let (inner, outer) = (self.surface / angle.cos(), self.wheel.radius);
        let friction = self.friction.wheel;
        self.add_ray(sums, &Ray { angle, width, inner, outer, share: 1.0, friction }, rule);
    }

    /// Facets of both flanks.
    fn add_ray(&self, sums: &mut Sums, ray: &Ray, rule: &Rule) {
        let Ray { angle, width, inner, outer, share, friction } = *ray;
        if share <= 0.0 || outer <= inner {
            return;
        }
        let outward = outward(angle);
        for (node, weight) in rule {
            let radius = inner + node * (outer - inner);
            let area = share * weight * (outer - inner) * radius * width;
            let Some(spot) = self.spot(outward * radius) else { continue };
            for (side, sum) in [(1.0, &mut sums.left), (-1.0, &mut sums.right)] {
                let normal = Vec3::y() * side;
                let place = spot.place + normal * (0.5 * self.wheel.width);
                let spot = Spot { place, ..spot };
                self.add(sum, &spot, &Facet { part: Part::Flank, normal, area, friction });
            }
        }
    }

    /// Grousers, and the soil that they shut in.
    fn add_comb(&self, sums: &mut Sums, comb: &Comb, angle: f64, width: f64, rule: &Rule) {
        let (tip, b) = (self.wheel.shearing_radius(), self.wheel.width);
        let (outward, along) = (outward(angle), forward_along(angle));
        let exposure = self.exposure(comb, angle);
        let submerged = self.surface / angle.cos();

        let inner = (tip - exposure.grouser).max(submerged);
        for (node, weight) in rule {
            let radius = inner + node * (tip - inner);
            let area = exposure.share * comb.density * width * b * weight * (tip - inner);
            let Some(spot) = self.spot(outward * radius) else { continue };
            for normal in [along, -along] {
                let friction = self.friction.wheel;
                self.add(
                    &mut sums.middle,
                    &spot,
                    &Facet { part: Part::Grouser, normal, area, friction },
                );
            }
        }

        let shut = 1.0 - exposure.rim;
        let (area, friction) = (shut * tip * width * b, self.friction.soil);
        if let Some(spot) = self.spot(outward * tip) {
            self.add(
                &mut sums.middle,
                &spot,
                &Facet { part: Part::Rim, normal: outward, area, friction },
            );
        }
        let (inner, outer) = (self.wheel.radius.max(submerged), tip);
        self.add_ray(sums, &Ray { angle, width, inner, outer, share: shut, friction }, rule);
    }

    /// A place in the soil, or none above it.
    fn spot(&self, place: Vec3) -> Option<Spot> {
        let depth = -place.z - self.surface;
        (depth > 0.0).then(|| Spot { place, depth, direction: self.motion.direction_at(place) })
    }

    /// Adds what a facet at a place meets.
    fn add(&self, sum: &mut WheelForces, spot: &Spot, facet: &Facet) {
        let Spot { place, depth, direction } = *spot;
        let Facet { part, normal, area, friction } = *facet;
        let Some(stress) = facet::stress(normal, direction, friction) else { return };
        let per_stress = self.stiffness * depth * area;
        let (push, shear) = (normal * (-stress.pressure * per_stress), stress.shear * per_stress);
        let force = push + shear;
        match part {
            Part::Rim => {
                sum.motion_resistance += push.x;
                sum.thrust += shear.x;
                sum.side_force_from_shear += force.y;
                let pressure = self.stiffness * depth * stress.pressure;
                if pressure > sum.max_normal_stress {
                    sum.max_normal_stress = pressure;
                    sum.patch.max_stress = place.x.atan2(-place.z);
                }
            }
            Part::Grouser => {
                sum.thrust += force.x;
                sum.side_force_from_shear += force.y;
            }
            Part::Flank => {
                sum.thrust += force.x;
                sum.bulldozing_load += push.y.abs();
            }
        }
        sum.side_force += force.y;
        sum.normal_force += force.z;
        let moment = place.cross(&force);
        sum.overturning_moment += moment.x;
        sum.torque -= moment.y;
        sum.aligning_moment += moment.z;
    }
}

/// The layer of turning directions, in entry angles: thinner ones carry nothing that counts, and
/// thicker ones are no layer.
const SHORTEST_LAYER: f64 = 1e-3;
const LONGEST_LAYER: f64 = 3.0;

/// Friction between the wheel and the soil, *μ_s* [-].
fn surface_friction(soil: &Soil) -> f64 {
    soil.rft.surface_friction_angle.unwrap_or(soil.friction_angle).tan()
}

/// Out of the rim at an angle from straight down.
fn outward(angle: f64) -> Vec3 {
    Vec3::new(angle.sin(), 0.0, -angle.cos())
}

/// Along the rim, the way of growing angles.
fn forward_along(angle: f64) -> Vec3 {
    Vec3::new(angle.cos(), 0.0, angle.sin())
}
