//! What resistive force theory must obey, and an independent sum of its facets.

use std::f64::consts::{FRAC_PI_2, TAU};

use grouser::contact::{
    Contact, InstructionSet, Rft, SettleError, Slip, WheelForces, WheelSoilModel, settle,
};
use grouser::document::{self, Kind, Overrides, Source};
use grouser::soil::{self, Soil};
use grouser::units::{Vec2, Vec3, deg};
use grouser::wheel::{Grousers, Wheel};
use proptest::prelude::*;

use super::given::{self, cases};

fn wheel(name: &str) -> Wheel {
    let source = Source::find(Kind::Wheel, name).expect("a preset");
    document::read_wheel(&source, &Overrides::none()).expect("it is read").value
}

fn sand(overrides: &[&str]) -> Soil {
    let source = Source::find(Kind::Soil, "cmu-direct90-smooth").expect("a preset");
    let overrides = overrides.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>();
    let overrides = Overrides::parse(&overrides).expect("they are read");
    document::read_soil(&source, &overrides).expect("it is read").value
}

fn sunk(contact: &Contact, depth: f64) -> WheelForces {
    Rft::DEFAULT.forces(contact, depth * contact.wheel.shearing_radius())
}

/// Drawbar pull, side force, normal force [N], torque [N·m].
fn wrench(forces: &WheelForces) -> [f64; 4] {
    [forces.drawbar_pull, forces.side_force, forces.normal_force, forces.torque]
}

/// The largest difference over the size of the force, torque taken at the rim.
fn difference(ours: &WheelForces, [x, y, z, torque]: [f64; 4], radius: f64) -> f64 {
    let size = Vec3::new(x, y, z).norm();
    let ours = wrench(ours);
    let parts = [ours[0] - x, ours[1] - y, ours[2] - z, (ours[3] - torque) / radius];
    parts.into_iter().fold(0.0, |largest: f64, part| largest.max(part.abs())) / size
}

// ---- an independent sum ----

/// The law by the source's angles, with its own coefficients in the source's order of rows.
mod by_angles {
    use super::Vec3;

    const F1: &str = ".00212 -.02320 -.20890 -.43083 -.00259 .48872 -.00415 .07204 -.02750 -.08772 \
                      .01992 -.45961 .40799 -.10107 -.06576 .05664 -.09269 .01892 .01033 .15120";
    const F2: &str = "-.06796 -.10941 .04725 -.06914 -.05835 -.65880 -.11985 -.25739 -.26834 \
                      .02692 -.00736 .63758 .08997 .21069 .04748 .20406 .18589 .04934 .13527 \
                      -.33207";
    const F3: &str = "-.02634 -.03436 .45256 .00835 .02553 -1.31290 -.05532 .06790 -.16404 .02287 \
                      .02927 .95406 -.00131 -.11028 .01487 -.02730 .10911 -.04097 .07881 -.27519";

    /// Powers of x₁, x₂, x₃ in each term.
    const POWERS: [[i32; 3]; 20] = [
        [0, 0, 0],
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
        [2, 0, 0],
        [0, 2, 0],
        [0, 0, 2],
        [1, 1, 0],
        [0, 1, 1],
        [1, 0, 1],
        [3, 0, 0],
        [0, 3, 0],
        [0, 0, 3],
        [1, 2, 0],
        [2, 1, 0],
        [0, 1, 2],
        [0, 2, 1],
        [2, 0, 1],
        [1, 0, 2],
        [1, 1, 1],
    ];

    pub(super) struct Law {
        coefficients: [Vec<f64>; 3],
        /// Whether it switches as published, at once.
        pub sharp: bool,
    }

    impl Law {
        pub(super) fn new(sharp: bool) -> Self {
            let read =
                |row: &str| row.split_whitespace().map(|c| c.parse().expect("a number")).collect();
            Self { coefficients: [read(F1), read(F2), read(F3)], sharp }
        }

        /// α with friction, for a facet that moves along `v` with an outward normal `n`.
        pub(super) fn stress(&self, n: Vec3, v: Vec3, friction: f64) -> Vec3 {
            // Ours leads gradually, over ±0.02.
            const WIDTH: f64 = 0.02;
            let lead = n.dot(&v);
            let share = if self.sharp {
                f64::from(u8::from(lead >= 0.0))
            } else {
                ((lead + WIDTH) / (2.0 * WIDTH)).clamp(0.0, 1.0)
            };
            if share == 0.0 {
                return Vec3::zeros();
            }
            let alpha = self.without_friction(n, v);
            let push = -n * alpha.dot(&n).abs();
            let mut shear = alpha - n * alpha.dot(&n);
            if shear.dot(&v) > 0.0 {
                if self.sharp {
                    shear = -shear;
                } else {
                    let sliding = v - n * lead;
                    let unit = sliding.normalize();
                    let turned = (sliding.norm() / WIDTH).min(1.0);
                    shear -= unit * (2.0 * turned * shear.dot(&unit));
                }
            }
            let cap = (friction * push.norm() / shear.norm()).min(1.0);
            (push + shear * cap) * share
        }

        fn without_friction(&self, n: Vec3, v: Vec3) -> Vec3 {
            let n = if n.z > 0.0 { -n } else { n };
            let level = v.x.hypot(v.y);
            let gamma = (-v.z).atan2(level);
            // The horizontal axis along the motion, and the one to its left.
            let r = if level > 0.0 { Vec3::new(v.x, v.y, 0.0) / level } else { Vec3::x() };
            let theta = Vec3::z().cross(&r);
            let beta = n.x.hypot(n.y).atan2(-n.z);
            let psi = n.dot(&theta).atan2(n.dot(&r));
            let x = [
                gamma.sin(),
                beta.cos(),
                psi.cos() * gamma.cos() * beta.sin() + gamma.sin() * beta.cos(),
            ];
            let [f1, f2, f3] = self.coefficients.each_ref().map(|row| {
                row.iter()
                    .zip(POWERS)
                    .map(|(c, p)| c * x[0].powi(p[0]) * x[1].powi(p[1]) * x[2].powi(p[2]))
                    .sum::<f64>()
            });
            r * (f1 * beta.sin() * psi.cos() + f2 * gamma.cos())
                + theta * (f1 * beta.sin() * psi.sin())
                + Vec3::z() * (-f1 * beta.cos() - f2 * gamma.sin() - f3)
        }
    }
}

use by_angles::Law;

/// A wheel cut into small pieces, all around and not by halves.
struct Pieces<'a> {
    contact: &'a Contact,
    law: Law,
    sinkage: f64,
    sum: [f64; 4],
}

impl<'a> Pieces<'a> {
    fn new(contact: &'a Contact, sinkage: f64, sharp: bool) -> Self {
        Self { contact, law: Law::new(sharp), sinkage, sum: [0.0; 4] }
    }

    fn velocity(&self, place: Vec3) -> Vec3 {
        let slip = &self.contact.slip;
        let spin = Vec3::y() * (slip.rim / self.contact.wheel.shearing_radius());
        Vec3::new(slip.forward, slip.lateral, 0.0) + spin.cross(&place)
    }

    fn add(&mut self, place: Vec3, normal: Vec3, area: f64, friction: f64) {
        let Contact { wheel, soil, gravity, .. } = self.contact;
        let depth = wheel.shearing_radius() - self.sinkage - place.z.abs();
        let depth = if place.z < 0.0 { -depth } else { 0.0 };
        if depth <= 0.0 {
            return;
        }
        let mu = soil.friction_angle.tan();
        let xi = soil.density * gravity * (894.0 * mu.powi(3) - 386.0 * mu * mu + 89.0 * mu);
        let v = self.velocity(place).normalize();
        let force = self.law.stress(normal, v, friction) * (soil.rft.scale * xi * depth * area);
        self.sum[0] += force.x;
        self.sum[1] += force.y;
        self.sum[2] += force.z;
        self.sum[3] -= place.cross(&force).y;
    }

    fn friction(&self) -> f64 {
        self.contact.soil.friction_angle.tan()
    }

    /// Rim and side faces of a wheel without grousers.
    fn smooth(mut self) -> [f64; 4] {
        const COUNT: u32 = 4000;
        const RINGS: u32 = 60;
        let Wheel { radius, width, .. } = self.contact.wheel;
        let friction = self.friction();
        let arc = 2.0 * (1.0 - self.sinkage / radius).acos();
        for k in 0..COUNT {
            let angle = arc * ((f64::from(k) + 0.5) / f64::from(COUNT) - 0.5);
            let out = Vec3::new(angle.sin(), 0.0, -angle.cos());
            let step = arc / f64::from(COUNT);
            self.add(out * radius, out, radius * width * step, friction);
            let inner = (radius - self.sinkage) / angle.cos();
            let thickness = (radius - inner) / f64::from(RINGS);
            for ring in 0..RINGS {
                let place = inner + (f64::from(ring) + 0.5) * thickness;
                for side in [-1.0, 1.0] {
                    let (n, area) = (Vec3::y() * side, place * step * thickness);
                    self.add(out * place + n * (width / 2.0), n, area, friction);
                }
            }
        }
        self.sum
    }
}

fn check_smooth_sum(slip: f64, beta: f64, depth: f64) -> (f64, f64) {
    let contact = given::on_stand(sand(&[]), wheel("cmu-smooth"), slip, beta);
    let (radius, h) = (contact.wheel.radius, depth * contact.wheel.radius);
    let fine = Rft::reference().forces(&contact, h);
    let same_law = difference(&fine, Pieces::new(&contact, h, false).smooth(), radius);
    let published = difference(&fine, Pieces::new(&contact, h, true).smooth(), radius);
    (same_law, published)
}

/// Midpoint sums of 4000 strips and 240 000 flank pieces, whose switches cost a strip's width.
#[test]
fn a_sum_of_small_pieces_by_the_sources_angles_agrees() {
    let mut worst_published = 0.0_f64;
    for (slip, beta) in [
        (0.0, 0.1),
        (0.02, 0.0),
        (0.3, 0.0),
        (0.3, 0.6),
        (0.7, 0.2),
        (0.0, 0.8),
        (-0.3, 0.2),
        (-1.0, 0.0),
        (-1.0, 0.8),
        (1.4, 0.2),
        (-1.5, 0.4),
    ] {
        for depth in [0.1, 0.4] {
            let (same_law, published) = check_smooth_sum(slip, beta, depth);
            println!(
                "slip {slip} angle {beta} depth {depth}: {same_law:.1e}, published {published:.1e}"
            );
            assert!(same_law < 3e-4, "{same_law:.1e} at slip {slip}, {beta} rad, depth {depth}");
            worst_published = worst_published.max(published);
        }
    }
    println!("worst against the published switches {worst_published:.1e}");
    // What the blended switches change, away from wheels that spin on the spot.
    assert!(worst_published < 0.03, "{worst_published:.1e}");
}

/// A cross-section with its grousers at one phase, seen from each piece along its motion.
struct Comb<'a> {
    pieces: Pieces<'a>,
    grousers: Vec<f64>,
}

/// Pieces over the lower half of the rim, and over the height of a grouser or of a side face.
const COUNT: u32 = 1200;
const ROWS: u32 = 20;

impl Comb<'_> {
    /// The nearest grouser that a ray from a place meets, along its velocity in the wheel's plane.
    fn hiding(&self, place: Vec3, own: Option<usize>) -> Option<usize> {
        let Wheel { radius, grousers, .. } = self.pieces.contact.wheel;
        let tip = radius + grousers.expect("it has them").height;
        let v = self.pieces.velocity(place);
        let met = self.grousers.iter().enumerate().filter(|(k, _)| Some(*k) != own);
        let met = met.filter_map(|(k, angle)| {
            // place + t v = ρ (sin, −cos), by Cramer's rule in (x, z).
            let (sin, cos) = angle.sin_cos();
            let det = -v.x * cos - v.z * sin;
            let t = (place.x * cos + place.z * sin) / det;
            let rho = sin * (place.x + t * v.x) - cos * (place.z + t * v.z);
            (t > 0.0 && (radius..tip).contains(&rho)).then_some((k, t))
        });
        met.min_by(|(_, one), (_, other)| one.total_cmp(other)).map(|(k, _)| k)
    }

    /// Radii [m] over the height of a grouser.
    fn rows(&self) -> impl Iterator<Item = f64> + use<> {
        let Wheel { radius, grousers, .. } = self.pieces.contact.wheel;
        let height = grousers.expect("it has them").height;
        (0..ROWS).map(move |row| radius + height * (f64::from(row) + 0.5) / f64::from(ROWS))
    }

    /// Share of a grouser's height that lies open.
    fn open(&self, k: usize) -> f64 {
        let out = outward(self.grousers[k]);
        let rows = self.rows().filter(|rho| self.hiding(out * *rho, Some(k)).is_none());
        rows.count() as f64 / f64::from(ROWS)
    }

    fn sum(mut self) -> [f64; 4] {
        let Wheel { radius, width, grousers } = self.pieces.contact.wheel;
        let height = grousers.expect("it has them").height;
        let friction = self.pieces.friction();
        let open: Vec<_> = (0..self.grousers.len()).map(|k| self.open(k)).collect();
        for k in 0..COUNT {
            let step = std::f64::consts::PI / f64::from(COUNT);
            let out = outward((f64::from(k) + 0.5) * step - FRAC_PI_2);
            let rim = f64::from(u8::from(self.hiding(out * radius, None).is_none()));
            let lid = 1.0 - rim;
            for (share, rho) in [(rim, radius), (lid, radius + height)] {
                self.pieces.add(out * rho, out, share * rho * width * step, friction);
            }
            for (share, inner, outer) in [(1.0, 0.0, radius), (lid, radius, radius + height)] {
                for row in 0..ROWS {
                    let thickness = (outer - inner) / f64::from(ROWS);
                    let rho = inner + (f64::from(row) + 0.5) * thickness;
                    for side in [-1.0, 1.0] {
                        let (n, area) = (Vec3::y() * side, share * rho * step * thickness);
                        self.pieces.add(out * rho + n * (width / 2.0), n, area, friction);
                    }
                }
            }
        }
        for (k, share) in open.into_iter().enumerate() {
            let angle = self.grousers[k];
            let (out, along) = (outward(angle), Vec3::new(angle.cos(), 0.0, angle.sin()));
            for rho in self
                .rows()
                .filter(|rho| self.hiding(out * *rho, Some(k)).is_none())
                .collect::<Vec<_>>()
            {
                let area = share * width * height / f64::from(ROWS);
                self.pieces.add(out * rho, along, area, friction);
                self.pieces.add(out * rho, -along, area, friction);
            }
        }
        self.pieces.sum
    }
}

fn outward(angle: f64) -> Vec3 {
    Vec3::new(angle.sin(), 0.0, -angle.cos())
}

/// The mean over a pitch of wheels with real grousers, each piece looked at along its own ray.
fn comb_sum(contact: &Contact, sinkage: f64) -> [f64; 4] {
    const PHASES: u32 = 12;
    let count = contact.wheel.grousers.expect("it has them").count;
    let mut mean = [0.0; 4];
    for phase in 0..PHASES {
        let turn = (f64::from(phase) + 0.5) / f64::from(PHASES);
        let grousers = (0..count).map(|k| TAU * (f64::from(k) + turn) / f64::from(count)).collect();
        let pieces = Pieces::new(contact, sinkage, false);
        let sum = Comb { pieces, grousers }.sum();
        for (mean, part) in mean.iter_mut().zip(sum) {
            *mean += part / f64::from(PHASES);
        }
    }
    mean
}

/// Exposure is computed from the velocity at the tips and flat geometry between two grousers; rays
/// on the round wheel, from each piece by its own velocity, are what it stands for.
#[test]
fn exposed_grousers_agree_with_rays_between_real_ones() {
    let mut worst = 0.0_f64;
    for count in [12, 24] {
        let mut wheel = wheel("cmu-grouser");
        wheel.grousers = wheel.grousers.map(|grousers| Grousers { count, ..grousers });
        for (slip, beta) in
            [(0.1, 0.0), (0.3, 0.0), (0.7, 0.3), (0.2, 0.7), (-0.4, 0.2), (-1.0, 0.0)]
        {
            let contact = given::on_stand(sand(&[]), wheel, slip, beta);
            let sinkage = 0.3 * wheel.shearing_radius();
            let ours = Rft::reference().forces(&contact, sinkage);
            let theirs = comb_sum(&contact, sinkage);
            let error = difference(&ours, theirs, wheel.shearing_radius());
            println!(
                "{count} at slip {slip}, {beta} rad: {error:.3}; {:.2?} {theirs:.2?}",
                wrench(&ours)
            );
            worst = worst.max(error);
        }
    }
    assert!(worst < 0.1, "{worst}");
}

// ---- limits ----

proptest! {
    #![proptest_config(cases(100))]

    /// Countless grousers make a rough cylinder of their tips' radius, hardly any a bare rim.
    #[test]
    fn grousers_lie_between_a_cylinder_of_soil_and_a_bare_rim(
        (s, beta) in (-0.9..0.9, -1.2..1.2), depth in 0.05..0.8,
    ) {
        let soil = sand(&[]);
        let at = |radius, grousers| {
            let wheel = Wheel { radius, width: 0.05, grousers };
            wrench(&sunk(&given::on_stand(soil, wheel, s, beta), depth))
        };
        let smooth = at(0.0625, None);
        let dense = at(0.0575, Some(Grousers { height: 0.005, count: 100_000 }));
        let low = at(0.0625, Some(Grousers { height: 1e-9, count: 24 }));
        let size = smooth.iter().map(|part| part * part).sum::<f64>().sqrt();
        for k in 0..4 {
            // The curvature of a pitch, and the kinks of the ring beside the rim on few nodes.
            prop_assert!((dense[k] - smooth[k]).abs() < 1e-2 * size, "{dense:?}, not {smooth:?}");
            prop_assert!((low[k] - smooth[k]).abs() < 1e-4 * size, "{low:?}, not {smooth:?}");
        }
    }
}

/// The law is linear in depth, and the arc of a shallow wheel grows like its root: F_z ∝ h^(3/2) on
/// the rim alone, where the wheel slides more than it sinks in.
#[test]
fn a_shallow_rim_carries_like_the_three_halves_power_of_its_sinkage() {
    let rim = |h: f64| {
        let of_width = |width| {
            let contact = given::on_stand(sand(&[]), given::smooth_wheel(0.1, width), 0.5, 0.0);
            Rft::reference().forces(&contact, h).normal_force
        };
        of_width(0.2) - of_width(0.1)
    };
    for h in [1e-7, 1e-6] {
        let exponent = (rim(4.0 * h) / rim(h)).log(4.0);
        assert!((exponent - 1.5).abs() < 0.02, "{exponent}");
    }
}

#[test]
fn the_scale_is_a_factor_on_every_force() {
    let forces = |soil| sunk(&given::on_stand(soil, wheel("cmu-grouser"), 0.3, 0.4), 0.3);
    let (one, two) = (forces(sand(&[])), forces(sand(&["soil.rft.scale=2.5"])));
    for (one, two) in wrench(&one).into_iter().zip(wrench(&two)) {
        assert!((2.5 * one - two).abs() < 1e-12 * two.abs());
    }
}

#[test]
fn a_smoother_wheel_pulls_less() {
    let pull = |degrees: &str| {
        let soil = sand(&[&format!("soil.rft.surface_friction_angle_deg={degrees}")]);
        let contact = given::on_stand(soil, wheel("cmu-smooth"), 0.4, 0.0);
        settle(&Rft::DEFAULT, &contact, 20.0).expect("it is carried").forces.drawbar_pull
    };
    assert!(pull("5") < pull("15") && pull("15") < pull("29"));
    let rough =
        settle(&Rft::DEFAULT, &given::on_stand(sand(&[]), wheel("cmu-smooth"), 0.4, 0.0), 20.0);
    // The soil's own friction angle.
    assert!((pull("29") - rough.expect("it is carried").forces.drawbar_pull).abs() < 1e-9);
}

// ---- gravity and size, energy, load ----

proptest! {
    #![proptest_config(cases(300))]

    /// Granular scaling (theory, section 7.5): gravity times q, lengths times r, masses times r³.
    #[test]
    fn gravity_and_size_scale_the_wheel_and_change_nothing_else(
        contact in given::any_contact(), depth in given::any_depth(),
        (q, r) in (given::log_range(0.01, 100.0), given::log_range(0.1, 10.0)),
    ) {
        let Wheel { radius, width, grousers } = contact.wheel;
        let grousers = grousers.map(|g| Grousers { height: r * g.height, ..g });
        let wheel = Wheel { radius: r * radius, width: r * width, grousers };
        // The bound has the soil's cohesion, which the law itself leaves out.
        let contact = Contact { soil: Soil { cohesion: 0.0, ..contact.soil }, ..contact };
        let large = Contact { wheel, gravity: q * contact.gravity, ..contact };
        let (one, two) = (sunk(&contact, depth), sunk(&large, depth));
        let size = wrench(&one).iter().map(|part| part.abs()).fold(0.0, f64::max);
        let force = q * r.powi(3);
        for (k, (one, two)) in wrench(&one).into_iter().zip(wrench(&two)).enumerate() {
            let unit = if k == 3 { force * r } else { force };
            prop_assert!((two / unit - one).abs() < 1e-9 * size, "{one} and {two}");
        }
        let load = one.normal_force;
        prop_assume!(load > 0.0);
        let small = given::settled(&Rft::DEFAULT, &contact, load).sinkage;
        let scaled = given::settled(&Rft::DEFAULT, &large, load * force).sinkage;
        prop_assert!((scaled / (r * small) - 1.0).abs() < 1e-9);
    }
}

proptest! {
    #![proptest_config(cases(3000))]

    #[test]
    fn every_instruction_set_gives_the_same_bits(
        contact in given::any_contact(), depth in given::any_depth(),
    ) {
        let sinkage = depth * contact.wheel.shearing_radius();
        let on = |set| {
            let WheelForces {
                drawbar_pull, side_force, normal_force, torque, overturning_moment,
                aligning_moment, thrust, motion_resistance, side_force_from_shear,
                bulldozing_load, max_normal_stress, patch,
            } = Rft::DEFAULT.on(set).forces(&contact, sinkage);
            [
                drawbar_pull, side_force, normal_force, torque, overturning_moment,
                aligning_moment, thrust, motion_resistance, side_force_from_shear,
                bulldozing_load, max_normal_stress, patch.max_stress,
            ].map(f64::to_bits)
        };
        for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
            prop_assert_eq!(on(set), on(InstructionSet::Baseline), "{:?}", set);
        }
    }

    /// The soil takes energy in every motion, opposed rim and hub included.
    #[test]
    fn the_soil_is_passive(
        (soil, wheel) in (given::any_soil(), given::any_wheel()),
        (rim, v_x, v_y) in (-1.0..1.0, -1.0..1.0, prop_oneof![Just(0.0), -1.0..1.0]),
        depth in given::any_depth(),
    ) {
        let slip = Slip::of_motion(rim, Vec2::new(v_x, v_y));
        let contact = Contact { slip, ..given::on_stand(soil, wheel, 0.0, 0.0) };
        let forces = sunk(&contact, depth);
        let turning = forces.torque / wheel.shearing_radius() * slip.rim;
        let moving = forces.drawbar_pull * slip.forward + forces.side_force * slip.lateral;
        prop_assert!(turning - moving > 0.0, "{turning} in, {moving} out");
    }

    /// F_z grows with the sinkage down to the axle, whatever the motion.
    #[test]
    fn deeper_carries_more(
        contact in given::any_contact(), depth in given::any_depth(), deeper in 1.01..1.5,
    ) {
        prop_assume!(depth * deeper <= 1.0);
        let (above, below) = (sunk(&contact, depth), sunk(&contact, depth * deeper));
        prop_assert!(below.normal_force > above.normal_force);
    }

    /// Loads of three decades and more: carried, or more than the soil can.
    #[test]
    fn any_load_is_carried_or_sinks_to_the_axle(
        contact in given::any_contact(), load in given::log_range(0.1, 1000.0),
    ) {
        match settle(&Rft::DEFAULT, &contact, load) {
            Ok(settled) => {
                prop_assert!((settled.forces.normal_force / load - 1.0).abs() < 1e-9);
                prop_assert!(settled.evaluations <= 40);
            }
            Err(SettleError::SunkToAxle { capacity, .. }) => prop_assert!(capacity < load),
            Err(error) => return Err(TestCaseError::fail(error.to_string())),
        }
    }
}

/// All of the load is carried by a wheel that spins on the spot, half by each of its sides.
#[test]
fn a_wheel_that_spins_on_the_spot_is_carried_by_both_its_sides() {
    let at = |s| sunk(&given::on_stand(sand(&[]), wheel("cmu-smooth"), s, 0.0), 0.3);
    let (before, spinning, after) = (at(0.9), at(1.0), at(1.1));
    assert!(spinning.normal_force > 0.0);
    // Soil that is carried down in front resists more than soil that is carried up behind.
    assert!(before.normal_force > spinning.normal_force);
    assert!(spinning.normal_force > after.normal_force);
}

// ---- quadrature ----

/// Motions and depths over which errors are counted.
fn grid() -> impl Iterator<Item = (f64, f64, f64)> {
    const SLIPS: [f64; 16] = [
        -1.0, -0.9, -0.5, -0.2, -0.05, -0.01, 0.0, 0.003, 0.01, 0.05, 0.2, 0.5, 0.8, 0.95, 1.0, 1.5,
    ];
    const ANGLES: [f64; 8] = [0.0, 1e-3, 0.01, 0.05, 0.2, 0.5, 0.8, 1.2];
    const DEPTHS: [f64; 5] = [0.02, 0.1, 0.2, 0.3, 0.5];
    SLIPS.into_iter().flat_map(|slip| {
        ANGLES.into_iter().flat_map(move |beta| DEPTHS.into_iter().map(move |d| (slip, beta, d)))
    })
}

/// Friction that reaches its limit, grousers that come out of the shade and directions that turn
/// beside the lowest point all make corners. Errors over the size of the force.
#[test]
fn sixteen_by_three_nodes_are_good_to_a_thousandth_mostly_and_to_a_few_hundredths_at_worst() {
    for name in ["cmu-smooth", "cmu-grouser", "hakuto"] {
        let wheel = wheel(name);
        let mut errors: Vec<f64> = grid()
            .map(|(slip, beta, depth)| {
                let contact = given::on_stand(sand(&[]), wheel, slip, beta);
                let fine = Rft::reference().forces(&contact, depth * wheel.shearing_radius());
                difference(&sunk(&contact, depth), wrench(&fine), wheel.shearing_radius())
            })
            .collect();
        errors.sort_by(f64::total_cmp);
        let at = |percent: usize| errors[(errors.len() - 1) * percent / 100];
        println!("{name}: median {:.1e}, 90 % {:.1e}, worst {:.1e}", at(50), at(90), at(100));
        assert!(at(50) < 5e-4 && at(90) < 5e-3 && at(100) < 3e-2);
    }
}

#[test]
fn the_published_constants_are_the_default() {
    assert_eq!(sand(&[]).rft, soil::Rft::PUBLISHED);
    let soil = sand(&["soil.rft.scale=0.7", "soil.rft.surface_friction_angle_deg=20"]);
    assert_eq!(soil.rft, soil::Rft { scale: 0.7, surface_friction_angle: Some(deg(20.0)) });
}
