//! All wheels of a rover on uneven ground settled together, as [`settling`](super::super::settling)
//! does on a plane.
//!
//! Each wheel's forces at the sinkages that were tried are a curve over F_z. Sought are the loads
//! that balance the rover with the forces that these curves have under them; there the next
//! sinkages are tried:
//!
//! ```text
//! N = N°(forces(N)) + λ p        p · (h(N) − h(N°)) = −|gaps|        p = gaps / |gaps|
//! ```
//!
//! with the loads of least norm *N°*, which are linear in the forces ([`Transfer`]). Of a rigid
//! rover on warped ground the second equation makes sinkages differ by the warp, and takes curves
//! of its own at N°; elsewhere λ = 0. Where that would have to hold a wheel down, it is lifted: its
//! load, 0, decides on λ, and its sinkage would have to be less than none. The tangent of both
//! leads to N in three or four steps of Newton's, which look at no wheel, and in more, shorter ones where
//! a wheel is light.
//!
//! Only the usual case is here: all other wheels stand, and F_z grows with the sinkage about as it
//! does for a shallow wheel. Elsewhere nothing is found.

use nalgebra::{DMatrix, DVector};

use super::{AGREED, LIGHT, NEARLY, Sought};
use crate::contact::WheelForces;
use crate::stored::stored;
use crate::vehicle::on_ground::{WheelReaction, forces_of};
use crate::vehicle::settling::{Curve, ForceAccuracy, Known};
use crate::vehicle::several_soils::Mixture;
use crate::vehicle::statics::Transfer;

/// What is known of the wheels in a motion nearby; nothing where both are empty.
#[derive(Clone, Debug, Default)]
pub(crate) struct KnownStanding {
    /// Under their loads.
    under: Vec<Known>,
    /// Under loads of least norm, on warped ground.
    least: Vec<Known>,
    /// The wheel that is lifted.
    pub(crate) lifted: Option<usize>,
}

stored!(struct KnownStanding { under, least, lifted });

/// Sinkages that are tried.
const MOST_ROUNDS: usize = 8;

/// Wheels on their way to the loads that balance the rover.
struct Settling<'a> {
    transfer: Transfer,
    /// Of warped ground, |gaps| [m] and *p*.
    warp: Option<(f64, DVector<f64>)>,
    under: Vec<Curve<'a>>,
    least: Vec<Curve<'a>>,
    /// The wheel that is lifted.
    lifted: Option<usize>,
    /// *N* [N]
    loads: DVector<f64>,
    /// *λ* [N]
    along: f64,
    /// m g [N]
    weight: f64,
}

/// Why loads were not found.
enum Unfound {
    /// A wheel would have to be held down.
    Lifts(usize),
    /// The search left its usual way.
    Unusual,
}

impl Sought<'_> {
    /// What is known of wheels that were settled in another way, for the next search; none where
    /// that search does not apply.
    pub(super) fn known_of(&self, wheels: &[WheelReaction]) -> Option<KnownStanding> {
        let ground = self.ground;
        let of = |wheels: &[WheelReaction]| -> Vec<Option<Known>> {
            let each = wheels.iter().zip(ground.rover.mounts());
            each.map(|(wheel, mount)| Known::of(ground, mount, wheel)).collect()
        };
        let found = of(wheels);
        let mut least = Vec::new();
        if self.warp().is_some() {
            let forces: Vec<WheelForces> = forces_of(wheels).copied().collect();
            let loads = self.balanced(&forces).ok()?;
            let under_least = ground.settle_standing(&self.met, &loads, |_| None).ok()?;
            least = of(&under_least).into_iter().collect::<Option<_>>()?;
        }
        let lifted = found.iter().position(Option::is_none);
        let under = found.into_iter().enumerate();
        let under = under.map(|(wheel, it)| it.or_else(|| least.get(wheel).copied()));
        Some(KnownStanding { under: under.collect::<Option<_>>()?, least, lifted })
    }

    /// The reaction on every wheel, sought from those of a motion nearby, which this one is
    /// afterwards; none where the usual search fails.
    pub(crate) fn together(
        &self,
        near: &mut KnownStanding,
        accuracy: ForceAccuracy,
    ) -> Option<Vec<WheelReaction>> {
        let with = |lifted| self.together_with(near, lifted, accuracy);
        let found = with(near.lifted).or_else(|unfound| match unfound {
            Unfound::Lifts(wheel) => with(Some(wheel)),
            Unfound::Unusual if near.lifted.is_some() => with(None),
            Unfound::Unusual => Err(unfound),
        });
        let (reactions, known) = found.ok()?;
        *near = known;
        Some(reactions)
    }

    /// * `lifted`: the wheel that is
    fn together_with(
        &self,
        near: &KnownStanding,
        lifted: Option<usize>,
        accuracy: ForceAccuracy,
    ) -> Result<(Vec<WheelReaction>, KnownStanding), Unfound> {
        let mixtures = self.mixtures();
        let mut wheels = self.start(&mixtures, near, lifted)?;
        for _ in 0..MOST_ROUNDS {
            wheels.look().ok_or(Unfound::Unusual)?;
            wheels.meet()?;
            if wheels.are_met(accuracy) {
                return wheels.reactions().ok_or(Unfound::Unusual);
            }
        }
        Err(Unfound::Unusual)
    }

    /// The reaction in a motion beside the one that is known, by one look at every wheel: to first
    /// order in how far it is, as differences need it.
    pub(super) fn beside(&self, near: &KnownStanding) -> Option<Vec<WheelReaction>> {
        let is_known = |known: &[Known]| known.iter().all(Known::has_slope);
        let least = if self.warp().is_some() { self.met.len() } else { 0 };
        let is_whole = near.under.len() == self.met.len() && near.least.len() == least;
        if !is_whole || !is_known(&near.under) || !is_known(&near.least) {
            return None;
        }
        let mixtures = self.mixtures();
        let mut wheels = self.start(&mixtures, near, near.lifted).ok()?;
        wheels.look()?;
        wheels.meet().ok()?;
        Some(wheels.reactions()?.0)
    }

    /// What stands for the model below each wheel on several soils.
    fn mixtures(&self) -> Vec<Option<Mixture<'_>>> {
        self.met.iter().map(|met| met.mixture(self.ground.model)).collect()
    }

    fn start<'c>(
        &'c self,
        mixtures: &'c [Option<Mixture<'c>>],
        near: &KnownStanding,
        lifted: Option<usize>,
    ) -> Result<Settling<'c>, Unfound> {
        let ground = self.ground;
        let transfer = ground.balance().transfer(ground.rover, self.posture, self.weight);
        let transfer = transfer.ok_or(Unfound::Unusual)?;
        let warp = self.warp().map(|gaps| (gaps.norm(), gaps.normalize()));
        let curves = |known: &[Known]| -> Vec<Curve<'c>> {
            let known = if known.len() == self.met.len() { known } else { &[] };
            let each = self.met.iter().zip(mixtures).enumerate();
            each.map(|(wheel, (met, mixture))| {
                let model = mixture.as_ref().map_or(ground.model, |mixture| mixture);
                Curve::new(model, met.contact(), known.get(wheel))
            })
            .collect()
        };
        let least = if warp.is_some() { curves(&near.least) } else { Vec::new() };
        // What lifts a wheel of a warped rover is the warp: it lies where that takes load off.
        let is_off = |wheel: &usize| {
            warp.as_ref().is_some_and(|(_, mode)| mode.get(*wheel).is_some_and(|it| *it > 0.0))
        };
        let lifted = lifted.filter(is_off);
        let loads = transfer.of_weight().clone();
        let (under, weight) = (curves(&near.under), self.weight.norm());
        let along = 0.0;
        let mut wheels = Settling { transfer, warp, under, least, lifted, loads, along, weight };
        if wheels.under.iter().chain(&wheels.least).all(Curve::is_known) {
            wheels.meet()?;
        }
        Ok(wheels)
    }
}

impl Settling<'_> {
    /// Loads of least norm, *N°* [N].
    fn least_loads(&self) -> DVector<f64> {
        match &self.warp {
            Some((_, mode)) => &self.loads - self.along * mode,
            None => self.loads.clone(),
        }
    }

    /// Tries the sinkage of each wheel at which it should carry its load; those of a lifted wheel's
    /// warp once.
    fn look(&mut self) -> Option<()> {
        let (least, lifted) = (self.least_loads(), self.lifted);
        let under = self.under.iter_mut().zip(self.loads.iter()).enumerate();
        let mut under = under.filter(|(wheel, _)| Some(*wheel) != lifted).map(|(_, it)| it);
        let mut look =
            |(curve, load): (&mut Curve<'_>, &f64)| (*load > 0.0).then(|| curve.look(*load))?;
        under.try_for_each(&mut look)?;
        let of_least = self.least.iter_mut().zip(least.iter());
        of_least.filter(|(curve, _)| lifted.is_none() || curve.is_new()).try_for_each(look)
    }

    /// Sets the loads that balance the rover with the forces that the curves have under them.
    fn meet(&mut self) -> Result<(), Unfound> {
        const MOST_STEPS: usize = 24;
        let mut before = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let (miss, tangent) = self.miss();
            let step = tangent.lu().solve(&miss).ok_or(Unfound::Unusual)?;
            let share = self.share_of(&step)?;
            let step = share * step;
            let size = step.amax() / self.weight;
            let count = self.loads.len();
            self.loads -= step.rows(0, count);
            if self.warp.is_some() {
                self.along -= step[count];
            }
            self.check()?;
            if share == 1.0 && (size <= AGREED || size <= NEARLY && size >= before) {
                return Ok(());
            }
            before = size;
        }
        Err(Unfound::Unusual)
    }

    /// The share of a step that leaves a tenth of its load to each wheel that stands [-]: over the
    /// logarithm of a light load forces are far from the tangent. One with hardly a load that would
    /// lose the rest lifts.
    fn share_of(&self, step: &DVector<f64>) -> Result<f64, Unfound> {
        const LEFT: f64 = 0.1;
        let mut share = 1.0;
        for (wheel, (load, step)) in self.loads.iter().zip(step.iter()).enumerate() {
            let stands = Some(wheel) != self.lifted && *load > 0.0;
            if !stands || load - step >= LEFT * load {
                continue;
            }
            if *load < LIGHT * self.weight && self.warp.is_some() && self.lifted.is_none() {
                return Err(Unfound::Lifts(wheel));
            }
            share = f64::min(share, (1.0 - LEFT) * load / step);
        }
        Ok(share)
    }

    /// Checks that no wheel but the lifted one would have to be held down.
    fn check(&self) -> Result<(), Unfound> {
        let stands = |load: &f64| *load > 0.0;
        if !self.least_loads().iter().all(stands) {
            return Err(Unfound::Unusual);
        }
        let mut wheels = self.loads.iter().enumerate();
        let held = wheels.find(|(wheel, load)| Some(*wheel) != self.lifted && !stands(load));
        match held.map(|(wheel, _)| wheel) {
            Some(wheel) if self.warp.is_some() && self.lifted.is_none() => {
                Err(Unfound::Lifts(wheel))
            }
            Some(_) => Err(Unfound::Unusual),
            None => Ok(()),
        }
    }

    /// How far loads and λ are from those that balance the rover, and how that changes with them.
    fn miss(&self) -> (DVector<f64>, DMatrix<f64>) {
        let count = self.loads.len();
        let size = count + usize::from(self.warp.is_some());
        let (mut miss, mut tangent) = (DVector::zeros(size), DMatrix::identity(size, size));
        let mut balanced = self.transfer.of_weight().clone();
        for (wheel, (curve, load)) in self.under.iter().zip(self.loads.iter()).enumerate() {
            if Some(wheel) == self.lifted {
                continue;
            }
            let (forces, slope) = curve.under(*load);
            balanced += self.transfer.of(wheel, &forces);
            let mut column = tangent.view_mut((0, wheel), (count, 1));
            column -= self.transfer.of(wheel, &slope);
        }
        let least = self.least_loads();
        miss.rows_mut(0, count).copy_from(&(&least - balanced));
        let Some((_, mode)) = &self.warp else { return (miss, tangent) };
        tangent.view_mut((0, count), (count, 1)).copy_from(&-mode);
        tangent[(count, count)] = 0.0;
        if let Some(lifted) = self.lifted {
            miss[count] = self.loads[lifted];
            tangent[(count, lifted)] = 1.0;
            return (miss, tangent);
        }
        miss[count] = self.gap();
        for (wheel, share) in mode.iter().enumerate() {
            let (_, slope) = self.under[wheel].sinkage(self.loads[wheel]);
            let (_, slope_of_least) = self.least[wheel].sinkage(least[wheel]);
            tangent[(count, wheel)] = share * (slope - slope_of_least);
            tangent[(count, count)] += share * share * slope_of_least;
        }
        (miss, tangent)
    }

    /// What is left of the warp between wheels and ground [m]: positive where wheels would have to
    /// be held down to close it.
    fn gap(&self) -> f64 {
        let Some((gap, mode)) = &self.warp else { return 0.0 };
        let least = self.least_loads();
        let sunk = |wheel: usize| {
            let is_lifted = Some(wheel) == self.lifted;
            if is_lifted { 0.0 } else { self.under[wheel].sinkage(self.loads[wheel]).0 }
        };
        let of_least = |wheel: usize| self.least[wheel].sinkage(least[wheel]).0;
        let closed = |(wheel, share): (usize, &f64)| share * (sunk(wheel) - of_least(wheel));
        gap + mode.iter().enumerate().map(closed).sum::<f64>()
    }

    /// Whether all curves are as exact as that.
    fn are_met(&self, accuracy: ForceAccuracy) -> bool {
        let least = self.least_loads();
        let under = self.under.iter().zip(self.loads.iter()).enumerate();
        let mut under = under.filter(|(wheel, _)| Some(*wheel) != self.lifted).map(|(_, it)| it);
        let mut of_least = self.least.iter().zip(least.iter());
        let is_met = |(curve, load): (&Curve<'_>, &f64)| curve.is_met(*load, accuracy);
        under.all(is_met) && (self.lifted.is_some() || of_least.all(is_met))
    }

    /// None where a lifted wheel is not surely off the ground.
    fn reactions(&self) -> Option<(Vec<WheelReaction>, KnownStanding)> {
        /// What is left of the warp below it, over the warp [-].
        const SURELY: f64 = 1e-3;
        let warp = self.warp.as_ref().map_or(0.0, |(gap, _)| *gap);
        if self.lifted.is_some() && self.gap() < SURELY * warp {
            return None;
        }
        let loads = self.least_loads();
        let least = self.least.iter().zip(loads.iter());
        let least: Vec<Known> = least.map(|(curve, load)| curve.reaction(*load).1).collect();
        let each = self.under.iter().zip(self.loads.iter()).enumerate();
        let each = each.map(|(wheel, (curve, load))| {
            if Some(wheel) == self.lifted {
                return Some((curve.unloaded()?, least[wheel]));
            }
            Some(curve.reaction(*load))
        });
        let (reactions, under) = each.collect::<Option<Vec<_>>>()?.into_iter().unzip();
        Some((reactions, KnownStanding { under, least, lifted: self.lifted }))
    }
}
