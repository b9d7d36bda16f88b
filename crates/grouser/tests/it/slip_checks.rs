//! Slip checks: limits on slip over a metre, asked of what visual odometry says, on beds whose
//! friction scatters.

use grouser::mission::{
    Leg, LegOutcome, Limited, Manoeuvre, Mission, MissionReport, MissionRun, Sensors, Stop,
};
use grouser::simulation::{Approach, Numerics, Record};
use grouser::units::deg;
use rayon::prelude::*;

use super::given::{RIM_SPEED, complete_traverse};
use super::mission::SENSORS;

/// Limit of slip over a metre of the rims' way.
const LIMIT: f64 = 0.4;
/// Three standard deviations of slip over a metre, of which two fixes say each half with 2 %:
/// 3 (1 − 0.4) 0.02/√2.
const ERROR: f64 = 0.026;

fn checked_drive(slope: f64, way: f64, seed: u64) -> Mission {
    let stops = vec![Stop::above(Limited::SlipRatio, LIMIT)];
    let leg = Leg { yaw: Some(deg(90.0)), stops, ..Leg::new(Manoeuvre::drive(way)) };
    let (scenario, sensors) = (complete_traverse(slope, 0.0), Some(Sensors { seed, ..SENSORS }));
    Mission { scenario, legs: vec![leg], stops: Vec::new(), sensors }
}

fn driven(mission: &Mission) -> MissionReport {
    MissionRun::new(mission).expect("a mission").to_end().expect("it can be computed")
}

/// On the soil that is expected a check stops no rover, whatever its odometry says: straight up 8°
/// it slips by 26 %, ten standard deviations of a fix over a metre below the limit.
fn check_without_alarm(seeds: std::ops::Range<u64>) {
    seeds.into_par_iter().for_each(|seed| {
        let mut plan = checked_drive(8.0, 100.0, seed);
        let numerics = plan.scenario.numerics;
        plan.scenario.numerics = Numerics { approach: Approach::QuasiSteady, ..numerics };
        let report = driven(&plan);
        assert_eq!(report.outcome(), "completed", "seed {seed}: {:?}", report.legs);
        assert!(report.legs[0].slip_ratio.is_some_and(|slip| slip > 0.2));
    });
}

#[test]
fn slip_checks_give_no_false_alarm() {
    check_without_alarm(0..20);
}

/// None in 400 drives of 100 m: with a confidence of 95 % fewer than 0.75 % have one.
#[test]
#[ignore = "a minute"]
fn slip_checks_give_no_false_alarm_in_forty_kilometres() {
    check_without_alarm(0..400);
}

/// What became of rovers on beds that scatter by 3°.
#[derive(Debug, Default)]
struct Count {
    /// They slipped too much over a metre, and stopped.
    entrapped: usize,
    /// They spun for a second before they had slipped too much over a metre.
    spun: usize,
    /// They slipped too much over a metre, and drove on for more than half a metre of their rims,
    /// to the next fix.
    missed: usize,
}

impl Count {
    fn of_beds(slope: f64, beds: std::ops::Range<u64>) -> Self {
        let each = beds.into_par_iter().map(|seed| {
            let mut plan = checked_drive(slope, 6.0, seed);
            plan.scenario.scatter.soil.friction_angle = deg(3.0);
            plan.scenario.scatter.seed = seed;
            plan.scenario.numerics.sample_interval = INTERVAL;
            let report = driven(&plan);
            let spun = matches!(report.legs[0].outcome, LegOutcome::Ended(_));
            let late = way_after_too_much_slip(&report.trajectory.records);
            let missed = late.is_some_and(|way| way > 0.5 + RIM_SPEED * 2.0 * INTERVAL);
            let entrapped = usize::from(late.is_some() && !missed);
            Self { entrapped, spun: usize::from(spun), missed: usize::from(missed) }
        });
        each.reduce(Self::default, |a, b| Self {
            entrapped: a.entrapped + b.entrapped,
            spun: a.spun + b.spun,
            missed: a.missed + b.missed,
        })
    }
}

/// Time between two records [s].
const INTERVAL: f64 = 0.1;
/// So many of them pass while rims at 6 cm/s go a metre.
const METRE: usize = 167;

/// Way of the rims after slip over a metre of them really was too much [m]; none if it never was.
fn way_after_too_much_slip(records: &[Record]) -> Option<f64> {
    let slip_ratio = |pair: &[Record]| {
        let [first, last] = [&pair[0], &pair[METRE]];
        let way = (last.state.position - first.state.position).norm();
        1.0 - way / (RIM_SPEED * (last.time - first.time))
    };
    let pair = records.windows(METRE + 1).find(|pair| slip_ratio(pair) > LIMIT + ERROR)?;
    Some(RIM_SPEED * (records[records.len() - 1].time - pair[METRE].time))
}

/// No rover drives on that has slipped too much over a metre, whatever its odometry says and
/// wherever its bed is soft; one that spins before a metre is gone ends its run after a second.
#[test]
fn slip_checks_miss_no_rover_that_gets_stuck() {
    let count = Count::of_beds(14.0, 0..100);
    assert!(count.missed == 0 && count.entrapped > 80, "{count:?}");
}

#[test]
#[ignore = "a minute"]
fn slip_checks_miss_none_of_a_thousand() {
    for (slope, beds, entrapped) in
        [(11.0, 0..200, 1), (14.0, 200..700, 400), (16.0, 700..1700, 500)]
    {
        let count = Count::of_beds(slope, beds);
        println!("{slope}°: {count:?}");
        assert!(count.missed == 0 && count.entrapped >= entrapped, "{slope}°: {count:?}");
    }
}
