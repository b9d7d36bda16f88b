//! What to warn of on the way.
//!
//! A [`Watch`] looks at stretch after stretch. A warning is given once, and again only after a
//! metre without its cause.

use std::collections::BTreeMap;

use super::archive::{Archive, items, numbers};
use super::noise::ModelNoise;
use super::one_sided::{OneSided, OneSides};
use super::stretch::Stretch;
use super::trail::{Past, Trail, Trend};
use super::unexplained::Push;
use super::warnings::{Evidence, Warning, WarningKind};
use crate::elementary::wide::{cos, hypot, ln_1p};
use crate::vehicle::Rover;

/// What a stretch says beside its readings.
#[derive(Clone, Copy)]
pub(super) struct Seen<'a> {
    pub(super) stretch: &'a Stretch,
    pub(super) slip_ratio: f64,
    /// Whether they were seen; else they are those that were expected.
    pub(super) is_slip_known: bool,
    /// Slip ratio that was expected [-].
    pub(super) expected_slip: f64,
    /// Way to the left over that of the wheels, and the same as it was expected [-].
    pub(super) drift: f64,
    pub(super) expected_drift: f64,
    /// Torque of each wheel that was expected [N·m]; of none where there is no soil that carries
    /// the rover.
    pub(super) expected_torques: &'a [f64],
    /// Thrust of all wheels that was expected, over the weight [-].
    pub(super) thrust: f64,
    /// What is left over however well the soil is known.
    pub(super) noise: ModelNoise,
    /// The number of the filter that has learnt it.
    pub(super) filter: u64,
    /// The force that would explain the motion on the soil that was learnt so far.
    pub(super) push: Option<&'a Push>,
    /// How far each number of the observation is from what was expected [standard deviations].
    pub(super) scores: &'a [f64],
    /// Whether the soil was just found to be another.
    pub(super) is_another_soil: bool,
    /// The slope on which the wheels' slip reaches [`DEEP`] on this course [rad], by what was
    /// learnt; nothing where it is steeper by more than what is asked for [rad].
    pub(super) deep_slope: &'a dyn Fn(f64) -> Option<f64>,
    /// The force over the weight that the soil has to spare until the wheels' slip is [`DEEP`], by
    /// what was learnt [-]; nothing where it has plenty.
    pub(super) holds_against: &'a dyn Fn() -> Option<f64>,
}

/// Looks at stretches.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    way: f64,
    trail: Trail,
    /// The force against the way by which the soil learnt so far is weaker than that at the start,
    /// over the weight [-].
    learnt: f64,
    /// The number of the filter that learnt it.
    filter: u64,
    /// The way at which the cause of each warning was last seen [m].
    causes: BTreeMap<(WarningKind, usize), f64>,
    /// The rims' way over which the torque of each wheel is too small [m].
    idle: Vec<f64>,
    /// The rims' way over which yaw contradicts roll and pitch [m].
    contradicted: f64,
    /// The rims' way over which odometry is faster than the wheels [m].
    outrun: f64,
    one_sides: OneSides,
}

/// Slip at which a rover is as good as stuck [-].
pub(super) const DEEP: f64 = 0.9;
/// Trends are those of this way of the rims [m]; of weak ground also those of more.
const TREND: f64 = 0.8;
const LONG_TRENDS: [f64; 2] = [1.6, 3.2];
/// Entrapment is looked for this far ahead [m of ground]: by a slip that grows, a slope that has
/// begun to rise, one that rises steadily, and ground that grows weaker, which does so slowly.
const BY_SLIP: f64 = 1.2;
const BY_RISE: f64 = 0.8;
const BY_STEADY_RISE: f64 = 1.6;
const BY_WEAKNESS: f64 = 2.5;
/// And as soon as this [s].
const SOON: f64 = 90.0;
/// Less slip than this is no sign of entrapment [-].
const SLIPS: f64 = 0.25;
/// With more than this on ground that grows weaker it is near, however much the soil that was
/// learnt has to spare [-].
const SLIPS_DEEPLY: f64 = 0.4;
/// More slip than this is entrapment whatever the trend [-].
const SPINS: f64 = 0.6;
/// A cause has to last this way of the rims to be one [m].
const LASTS: f64 = 0.5;
/// A warning is given again after this way without its cause [m].
const QUIET: f64 = 1.0;

impl Watch {
    /// The warnings that a stretch gives rise to.
    pub(super) fn look(&mut self, seen: &Seen<'_>, rover: &Rover) -> Vec<Warning> {
        self.way += seen.stretch.way;
        self.remember(seen);
        let found = [
            self.soil_change(seen),
            self.entrapment(seen),
            self.contradiction(seen.stretch),
            self.outrunning(seen),
        ];
        let idle = self.idle_wheels(seen, rover);
        let one_sided = self.one_sided(seen, rover);
        found.into_iter().flatten().chain(idle).chain(one_sided).collect()
    }

    fn remember(&mut self, seen: &Seen<'_>) {
        if seen.filter != self.filter {
            self.filter = seen.filter;
            self.trail.forget_weakness();
        }
        let [slope, yaw] = seen.stretch.attitude.unwrap_or_default();
        let together = seen.noise.together(seen.stretch.way);
        let ground = self.trail.back(0).map_or(0.0, |it| it.ground)
            + seen.stretch.way * (1.0 - seen.slip_ratio).max(0.0);
        let (time, way) = (seen.stretch.time[1], self.way);
        let slip_ratio = seen.slip_ratio;
        let rolls = 1.0 - slip_ratio.min(0.995);
        let of_slip = seen.push.map_or(0.0, |it| it.of_slip / rolls);
        let size = hypot(seen.noise.force, seen.noise.attitude);
        let own = seen.push.map_or(0.0, |it| it.deviation);
        let past = Past {
            time,
            way,
            ground,
            slip_ratio,
            strain: -ln_1p(-slip_ratio.min(0.995)),
            strain_variance: together * of_slip.powi(2),
            slope,
            yaw,
            weakness: seen.push.map(|it| self.learnt + it.force),
            weakness_variance: together * size.powi(2) + own.powi(2),
        };
        self.trail.push(past, LONG_TRENDS[1]);
    }

    /// A warning, unless its cause was there a moment ago.
    ///
    /// * `which`: of several of a kind
    fn raise(
        &mut self,
        kind: WarningKind,
        which: usize,
        lead: [Option<f64>; 2],
        evidence: Evidence,
    ) -> Option<Warning> {
        let before = self.causes.insert((kind, which), self.way);
        if before.is_some_and(|before| self.way - before < QUIET) {
            return None;
        }
        let time = self.trail.back(0)?.time;
        let [lead_time, lead_way] = lead;
        Some(Warning { kind, time, way: self.way, lead_time, lead_way, evidence })
    }

    /// Whether the soil has just been found to be another.
    fn soil_change(&mut self, seen: &Seen<'_>) -> Option<Warning> {
        if !seen.is_another_soil {
            return None;
        }
        let evidence = Evidence::Strange {
            slip_ratio: seen.slip_ratio,
            expected: seen.expected_slip,
            drift: seen.drift,
            expected_drift: seen.expected_drift,
        };
        self.raise(WarningKind::SoilChange, 0, [None; 2], evidence)
    }

    /// Whether the slip goes to 1, or the ground gets too steep for what was learnt.
    fn entrapment(&mut self, seen: &Seen<'_>) -> Option<Warning> {
        if !seen.is_slip_known {
            return None;
        }
        let slip_ratio = seen.slip_ratio;
        // Two in a row: one may be outliers that got through.
        let before = self.trail.back(1).map_or(0.0, |it| it.slip_ratio);
        if slip_ratio.min(before) > SPINS {
            let evidence = Evidence::Spinning { slip_ratio };
            return self.raise(WarningKind::Entrapment, 0, [Some(0.0); 2], evidence);
        }
        let growing = self.strain_ahead(slip_ratio);
        let rising = self.slope_ahead(seen);
        let weakening = self.weakening_ahead(seen);
        let nearest = [growing, rising, weakening].into_iter().flatten();
        let (way, evidence) = nearest.min_by(|one, other| one.0.total_cmp(&other.0))?;
        let time = way / self.trail.ground_speed(TREND).max(1e-6);
        if time > SOON {
            return None;
        }
        self.raise(WarningKind::Entrapment, 0, [Some(time), Some(way)], evidence)
    }

    /// Way over the ground until the slip is [`DEEP`], if it grows as it did.
    fn strain_ahead(&self, slip_ratio: f64) -> Option<(f64, Evidence)> {
        if slip_ratio <= SLIPS {
            return None;
        }
        let trend = self.trail.trend(0.0..TREND, |it| Some((it.strain, it.strain_variance)))?;
        let way = (-ln_1p(-DEEP) - trend.now).max(0.0) / trend.rise;
        (trend.is_no_chance() && way <= BY_SLIP).then_some((way, Evidence::Growing { slip_ratio }))
    }

    /// Way over the ground until the slope holds the rover no longer, if it grows as it did: one
    /// that rose before as well may be expected to go on for longer.
    fn slope_ahead(&self, seen: &Seen<'_>) -> Option<(f64, Evidence)> {
        let (slip_ratio, slope) = (seen.slip_ratio, self.trail.back(0)?.slope);
        let trend = |within| self.trail.trend(within, |it| Some((it.slope, 0.0)));
        let now = trend(0.0..TREND).filter(Trend::is_no_chance)?;
        let is_steady = trend(TREND..2.0 * TREND).is_some_and(|it| it.is_no_chance());
        let farthest = if is_steady { BY_STEADY_RISE } else { BY_RISE };
        let limit = (seen.deep_slope)(now.rise * farthest)?;
        Some(((limit - slope) / now.rise, Evidence::Rising { slip_ratio, slope, limit }))
    }

    /// Way over the ground until the ground is too weak for the rover, if it grows weaker as it
    /// did. Where the slope changes another soil than was believed passes for one that changes.
    fn weakening_ahead(&self, seen: &Seen<'_>) -> Option<(f64, Evidence)> {
        /// A slope that differs by no more than this is the same [rad].
        const SAME: f64 = 0.02;
        let of = |way: f64| {
            let slopes = || self.trail.before(0.0..way).map(|it| it.slope);
            let range = slopes().fold(f64::MIN, f64::max) - slopes().fold(f64::MAX, f64::min);
            let trend =
                self.trail.trend(0.0..way, |it| Some((it.weakness?, it.weakness_variance)))?;
            (range < SAME && trend.is_no_chance()).then_some(trend)
        };
        let steepest = [TREND, LONG_TRENDS[0], LONG_TRENDS[1]].into_iter().filter_map(of);
        let trend = steepest.max_by(|one, other| one.rise.total_cmp(&other.rise))?;
        let spare = ((seen.holds_against)()? - (trend.now - self.learnt)).max(0.0);
        let slip_ratio = seen.slip_ratio;
        let evidence = Evidence::Weakening { slip_ratio, loss: trend.rise, spare };
        // What the ground loses of the thrust at this slip it loses in proportion of the larger one
        // at more. Where there is little thrust the loss may be of another kind.
        let thrust = seen.thrust.max(spare).max(f64::MIN_POSITIVE);
        let way = spare / trend.rise * thrust / (thrust + spare);
        (way <= BY_WEAKNESS || slip_ratio > SLIPS_DEEPLY).then_some((way, evidence))
    }

    /// Takes into account that the belief of the soil has changed.
    ///
    /// * `learnt`: the force against the way that goes with it, over the weight; nothing where that
    ///   is not known
    pub(super) fn believed(&mut self, learnt: Option<f64>) {
        match learnt {
            Some(learnt) => self.learnt += learnt,
            None => self.trail.forget_weakness(),
        }
    }

    /// Whether yaw contradicts roll and pitch.
    fn contradiction(&mut self, stretch: &Stretch) -> Option<Warning> {
        /// On less slope roll and pitch do not tell the yaw [rad].
        const STEEP: f64 = 0.09;
        /// More than this is no mounting [rad].
        const APART: f64 = 0.17;
        let ([slope, yaw], reported) = (stretch.attitude?, stretch.reported_yaw?);
        let apart = cos(reported - yaw) < cos(APART);
        self.contradicted =
            if slope > STEEP && apart { self.contradicted + stretch.way } else { 0.0 };
        if self.contradicted < LASTS {
            return None;
        }
        let evidence = Evidence::Contradiction { reported, by_attitude: yaw };
        self.raise(WarningKind::LyingSensor, 0, [None; 2], evidence)
    }

    /// Whether odometry says that the rover is faster than its wheels, where none drives it down.
    fn outrunning(&mut self, seen: &Seen<'_>) -> Option<Warning> {
        /// Slip that no soil has of wheels that drive [-].
        const SKIDS: f64 = -0.3;
        let faster = seen.slip_ratio < SKIDS && seen.expected_slip > 0.5 * SKIDS;
        self.outrun = if faster { self.outrun + seen.stretch.way } else { 0.0 };
        if self.outrun < LASTS {
            return None;
        }
        let evidence = Evidence::Outrun { slip_ratio: seen.slip_ratio };
        self.raise(WarningKind::LyingSensor, 1, [None; 2], evidence)
    }

    /// Readings that stay on one side of what is expected. On another soil they begin anew.
    fn one_sided(&mut self, seen: &Seen<'_>, rover: &Rover) -> Vec<Warning> {
        if seen.is_another_soil {
            self.forget_sides();
            return Vec::new();
        }
        let all_pull = self.idle.iter().all(|it| *it == 0.0);
        self.one_sides.add(seen.stretch, seen.scores, rover, all_pull);
        let found: Vec<_> = self.one_sides.found().collect();
        let warn = |(what, deviations)| {
            // Two causes are other warnings'.
            let which = 2 + what as usize;
            let evidence = Evidence::OneSided { what, deviations };
            self.raise(WarningKind::LyingSensor, which, [None; 2], evidence)
        };
        found.into_iter().filter_map(warn).collect()
    }

    /// What stays on one side of what is expected, and by how many standard deviations.
    pub(super) fn on_one_side(&self) -> impl Iterator<Item = (OneSided, f64)> {
        self.one_sides.found()
    }

    /// Forgets on which side of what is expected readings were.
    pub(super) fn forget_sides(&mut self) {
        self.one_sides = OneSides::default();
    }

    /// Wheels that have much less torque than the others, where the soil would not have it so.
    fn idle_wheels(&mut self, seen: &Seen<'_>, rover: &Rover) -> Vec<Warning> {
        /// Share of the others' torque below which a wheel counts as idle [-].
        const LITTLE: f64 = 0.15;
        /// Where so little is expected of a wheel, a small torque is nothing strange [-].
        const EXPECTED: f64 = 0.5;
        let stretch = seen.stretch;
        let torques: Vec<f64> = stretch.torques.iter().flatten().map(|it| it.value.abs()).collect();
        let Some(middle) = middle_of(torques) else { return Vec::new() };
        self.idle.resize(rover.wheel_count(), 0.0);
        for (place, read) in stretch.torques.iter().enumerate() {
            let noise = read.map_or(0.0, |it| it.deviation);
            let expected = seen.expected_torques.get(place).map_or(f64::INFINITY, |it| it.abs());
            let is_idle = read.is_some_and(|it| {
                it.value.abs() < LITTLE * middle
                    && middle - it.value.abs() > 4.0 * noise
                    && expected > EXPECTED * middle
            });
            self.idle[place] = if is_idle { self.idle[place] + stretch.way } else { 0.0 };
        }
        let idle: Vec<usize> =
            (0..self.idle.len()).filter(|place| self.idle[*place] >= LASTS).collect();
        let warn = |place: usize| {
            let evidence =
                Evidence::Idle { wheel: rover.mounts()[place].name.clone(), share: LITTLE };
            self.raise(WarningKind::WheelNotPulling, place, [None; 2], evidence)
        };
        idle.into_iter().filter_map(warn).collect()
    }
}

impl Watch {
    /// Writes or reads what it has seen.
    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { way, trail, learnt, filter, causes, idle, contradicted, outrun, one_sides } =
            self;
        archive.group("one_sides");
        one_sides.walk(archive);
        archive.end();
        archive.number("way", way);
        archive.number("learnt", learnt);
        archive.number("contradicted", contradicted);
        archive.number("outrun", outrun);
        numbers(archive, "idle", idle);
        archive.count("filter", filter);
        archive.group("trail");
        trail.walk(archive);
        archive.end();
        let mut of_causes: Vec<_> =
            causes.iter().map(|((kind, which), way)| (*kind, *which as u64, *way)).collect();
        let blank = || (WarningKind::SoilChange, 0, 0.0);
        items(archive, "causes", &mut of_causes, blank, |(kind, which, way), archive| {
            kind.walk(archive);
            archive.count("which", which);
            archive.number("way", way);
        });
        let place = |which: u64| usize::try_from(which).unwrap_or(usize::MAX);
        let of_causes = of_causes.into_iter();
        *causes = of_causes.map(|(kind, which, way)| ((kind, place(which)), way)).collect();
    }
}

fn middle_of(mut values: Vec<f64>) -> Option<f64> {
    const LEAST: usize = 3;
    values.sort_by(f64::total_cmp);
    (values.len() >= LEAST).then(|| values[values.len() / 2])
}
