//! The state of learning, written and read field by field, so that it can go on elsewhere with the
//! same bits.
//!
//! Each type walks its fields once, for both ways: an [`Archive`] takes them, or puts kept ones in
//! their place. What follows from the scenario is not part of the state. An exhaustive pattern in
//! each walk leaves no field out.

use super::archive::{Archive, items, maybes, named, numbers};
use super::gross::{GrossFault, Suspect};
use super::information::InformationByKind;
use super::motion::NotUsed;
use super::one_sided::OneSided;
use super::stretch::{Reading, Stretch};
use super::warnings::{Evidence, Warning, WarningKind};
use super::{Learner, Learnt, Lesson};

impl Learner {
    /// Writes all that was learnt.
    pub fn write_state(&self, archive: &mut dyn Archive) {
        self.clone().walk(archive);
    }

    /// Goes on from a state that a learner of the same scenario and settings wrote. Whether it was
    /// one; else this learner is not to be used any more.
    pub fn read_state(&mut self, archive: &mut dyn Archive) -> bool {
        self.walk(archive);
        self.bank.is_whole()
            && self.gatherer.is_whole()
            && self.change.is_whole(|filter| self.bank.unknowns(filter))
    }

    fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { study: _, settings: _, gatherer, gross, pending, bank, change, watch, learnt } =
            self;
        archive.group("gatherer");
        gatherer.walk(archive);
        archive.end();
        archive.group("gross");
        gross.walk(archive);
        archive.end();
        items(archive, "pending", pending, Warning::blank, Warning::walk);
        archive.group("bank");
        bank.walk(archive);
        archive.end();
        archive.group("change");
        change.walk(archive);
        archive.end();
        archive.group("watch");
        watch.walk(archive);
        archive.end();
        archive.group("learnt");
        learnt.walk(archive);
        archive.end();
    }
}

impl Learnt {
    fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { records, outliers, stretches, forgotten, way, not_used } = self;
        archive.count("records", records);
        archive.count("outliers", outliers);
        archive.count("stretches", stretches);
        archive.count("forgotten", forgotten);
        archive.number("way", way);
        archive.group("not_used");
        for why in NotUsed::ALL {
            let mut count = not_used.get(&why).copied().unwrap_or(0);
            archive.count(why.name(), &mut count);
            if count > 0 {
                not_used.insert(why, count);
            }
        }
        archive.end();
    }
}

impl Lesson {
    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let Self {
            stretch,
            way,
            slip_ratio,
            expected_slip,
            information,
            by_kind,
            scores,
            warnings,
        } = self;
        archive.number("way", way);
        archive.maybe("slip_ratio", slip_ratio);
        archive.number("expected_slip", expected_slip);
        archive.number("information", information);
        let InformationByKind { along, across, turning, torque, sinkage } = by_kind;
        named(archive, [("along", along), ("across", across), ("turning", turning)]);
        named(archive, [("torque", torque), ("sinkage", sinkage)]);
        numbers(archive, "scores", scores);
        items(archive, "warnings", warnings, Warning::blank, Warning::walk);
        archive.group("stretch");
        stretch.walk(archive);
        archive.end();
    }
}

impl Stretch {
    fn walk(&mut self, archive: &mut dyn Archive) {
        let Self {
            time: [from, to],
            way,
            attitude,
            reported_yaw,
            rim_speeds,
            rim_scatter,
            steering,
            velocity: [forward, leftward],
            yaw_rate,
            torques,
            currents,
            sinkages,
            outliers,
        } = self;
        archive.number("from", from);
        archive.number("to", to);
        archive.number("way", way);
        let mut of_attitude: Vec<f64> = attitude.iter().flatten().copied().collect();
        numbers(archive, "attitude", &mut of_attitude);
        *attitude = of_attitude.try_into().ok();
        archive.maybe("reported_yaw", reported_yaw);
        numbers(archive, "rim_speeds", rim_speeds);
        archive.number("rim_scatter", rim_scatter);
        maybes(archive, "steering", steering);
        for (name, reading) in
            [("forward", forward), ("leftward", leftward), ("yaw_rate", yaw_rate)]
        {
            let mut one = vec![*reading];
            readings(archive, name, &mut one);
            *reading = one.into_iter().flatten().next();
        }
        readings(archive, "torques", torques);
        maybes(archive, "currents", currents);
        readings(archive, "sinkages", sinkages);
        let mut of_outliers = *outliers as u64;
        archive.count("outliers", &mut of_outliers);
        *outliers = usize::try_from(of_outliers).unwrap_or(usize::MAX);
    }
}

/// Readings that may be missing: means, and their deviations.
fn readings(archive: &mut dyn Archive, name: &str, readings: &mut Vec<Option<Reading>>) {
    let each = |of: fn(Reading) -> f64| readings.iter().map(|it| it.map(of)).collect();
    let (mut values, mut deviations): (Vec<_>, Vec<_>) =
        (each(|it| it.value), each(|it| it.deviation));
    archive.group(name);
    maybes(archive, "value", &mut values);
    maybes(archive, "deviation", &mut deviations);
    archive.end();
    let both = values.into_iter().zip(deviations);
    *readings = both
        .map(|(value, deviation)| value.zip(deviation))
        .map(|it| it.map(|(value, deviation)| Reading { value, deviation }))
        .collect();
}

impl Warning {
    pub(super) fn blank() -> Self {
        let evidence = Evidence::Spinning { slip_ratio: 0.0 };
        let (kind, lead_time, lead_way) = (WarningKind::Entrapment, None, None);
        Self { kind, time: 0.0, way: 0.0, lead_time, lead_way, evidence }
    }

    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { kind, time, way, lead_time, lead_way, evidence } = self;
        kind.walk(archive);
        archive.number("time", time);
        archive.number("way", way);
        archive.maybe("lead_time", lead_time);
        archive.maybe("lead_way", lead_way);
        evidence.walk(archive);
    }
}

impl Evidence {
    /// One of each, to read into.
    fn all() -> [Self; 10] {
        let zero = 0.0;
        [
            Self::Strange { slip_ratio: zero, expected: zero, drift: zero, expected_drift: zero },
            Self::Spinning { slip_ratio: zero },
            Self::Growing { slip_ratio: zero },
            Self::Weakening { slip_ratio: zero, loss: zero, spare: zero },
            Self::Rising { slip_ratio: zero, slope: zero, limit: zero },
            Self::Contradiction { reported: zero, by_attitude: zero },
            Self::Outrun { slip_ratio: zero },
            Self::Idle { wheel: String::new(), share: zero },
            Self::OneSided { what: OneSided::Leftward, deviations: zero },
            Self::Gross(GrossFault { suspect: Suspect::Torque, factor: zero }),
        ]
    }

    const fn name(&self) -> &'static str {
        match self {
            Self::Strange { .. } => "strange",
            Self::Spinning { .. } => "spinning",
            Self::Growing { .. } => "growing",
            Self::Weakening { .. } => "weakening",
            Self::Rising { .. } => "rising",
            Self::Contradiction { .. } => "contradiction",
            Self::Outrun { .. } => "outrun",
            Self::Idle { .. } => "idle",
            Self::OneSided { .. } => "one-sided",
            Self::Gross(_) => "gross",
        }
    }

    fn walk(&mut self, archive: &mut dyn Archive) {
        let mut name = self.name().to_owned();
        archive.word("evidence", &mut name);
        if name != self.name() {
            match Self::all().into_iter().find(|it| it.name() == name) {
                Some(blank) => *self = blank,
                None => return archive.refuse("evidence"),
            }
        }
        match self {
            Self::Strange { slip_ratio, expected, drift, expected_drift } => {
                archive.number("slip_ratio", slip_ratio);
                archive.number("expected", expected);
                archive.number("drift", drift);
                archive.number("expected_drift", expected_drift);
            }
            Self::Weakening { slip_ratio, loss, spare } => {
                archive.number("slip_ratio", slip_ratio);
                archive.number("loss", loss);
                archive.number("spare", spare);
            }
            Self::Spinning { slip_ratio }
            | Self::Growing { slip_ratio }
            | Self::Outrun { slip_ratio } => archive.number("slip_ratio", slip_ratio),
            Self::Rising { slip_ratio, slope, limit } => {
                archive.number("slip_ratio", slip_ratio);
                archive.number("slope", slope);
                archive.number("limit", limit);
            }
            Self::Contradiction { reported, by_attitude } => {
                archive.number("reported", reported);
                archive.number("by_attitude", by_attitude);
            }
            Self::Gross(fault) => fault.walk(archive),
            Self::OneSided { what, deviations } => {
                let mut name = what.name().to_owned();
                archive.word("what", &mut name);
                match OneSided::ALL.into_iter().find(|it| it.name() == name) {
                    Some(known) => *what = known,
                    None => archive.refuse("what"),
                }
                archive.number("deviations", deviations);
            }
            Self::Idle { wheel, share } => {
                archive.word("wheel", wheel);
                archive.number("share", share);
            }
        }
    }
}
