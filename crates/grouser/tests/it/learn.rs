//! What is learnt from drives whose soil is hidden from the learner.

mod twin;

use grouser::document::LoadedScenario;
use grouser::studies::learn::{LearnSettings, Learner, Warning, WarningKind};
use grouser::studies::simulated_telemetry::SensorModels;
use twin::{Drive, answer, scenario, truths};

#[test]
#[ignore = "prints"]
fn look() {
    let prior = scenario(&["scenario.soil=toyoura-uncertain"]);
    let legs = [(0.0, 0.0, 0.6), (5.0, 3.0, 1.0), (6.0, 40.0, 0.6), (8.0, 5.0, 1.0)];
    let usual = SensorModels::USUAL;
    let models = match std::env::var("ONLY").as_deref() {
        Ok("none") => SensorModels::PERFECT,
        Ok("attitude") => SensorModels { attitude: usual.attitude, ..SensorModels::PERFECT },
        Ok("odometry") => SensorModels { odometry: usual.odometry, ..SensorModels::PERFECT },
        Ok("rotation") => SensorModels { rotation: usual.rotation, ..SensorModels::PERFECT },
        Ok("torque") => SensorModels { torque: usual.torque, ..SensorModels::PERFECT },
        Ok("speed") => SensorModels { wheel_speed: usual.wheel_speed, ..SensorModels::PERFECT },
        Ok("drop") => SensorModels { dropouts: 0.02, ..SensorModels::PERFECT },
        Ok("outliers") => SensorModels { outliers: 0.05, ..SensorModels::PERFECT },
        _ => SensorModels { outliers: 0.05, ..usual },
    };
    let count: u32 = std::env::var("N").map_or(12, |it| it.parse().unwrap());
    let started = std::time::Instant::now();
    let mut held = [[0, 0], [0, 0]];
    let mut all = 0;
    let mut errors = [0.0, 0.0];
    for (place, truth) in truths(&prior, 77, count).iter().enumerate() {
        let Some(found) = answer(&prior, truth, &legs, 12.0, models, place as u64) else {
            println!("{place} {:?}: no motion", truth.theory);
            continue;
        };
        all += 1;
        for q in 0..2 {
            for (w, band) in [found.before, found.after].iter().enumerate() {
                let [low, _, high] = band[q];
                held[w][q] += usize::from((low..=high).contains(&found.truth[q]));
            }
        }
        errors[0] += (found.before[1][1] - found.truth[1]).abs().to_degrees();
        errors[1] += (found.after[1][1] - found.truth[1]).abs().to_degrees();
        let show = |v: [f64; 3], k: f64| format!("{:.2} {:.2} {:.2}", v[0] * k, v[1] * k, v[2] * k);
        println!(
            "{place} {:?} slip {:.3}: {} -> {} | yaw {:.2}: {} -> {} rank {:.2}",
            truth.theory,
            found.truth[0],
            show(found.before[0], 1.0),
            show(found.after[0], 1.0),
            found.truth[1].to_degrees(),
            show(found.before[1], 57.3),
            show(found.after[1], 57.3),
            found.rank
        );
    }
    println!(
        "{all} held before {:?} after {:?}; yaw errors {:?}; {:?}",
        held[0],
        held[1],
        errors.map(|e| e / f64::from(all)),
        started.elapsed()
    );
}

/// The warnings of a drive.
fn warnings(
    prior: &LoadedScenario,
    drive: &Drive,
    models: SensorModels,
    seed: u64,
) -> Vec<Warning> {
    let mut learner = Learner::new(prior, false, LearnSettings::USUAL).unwrap();
    let lessons = drive.seen(models, seed).into_iter().filter_map(|it| learner.update(it));
    lessons.flat_map(|it| it.warnings).collect()
}

fn usual() -> SensorModels {
    SensorModels { outliers: 0.05, ..SensorModels::USUAL }
}

#[test]
#[ignore = "writes"]
fn dump() {
    use grouser::document::measurements::telemetry::{csv_header, csv_line};
    let prior = scenario(&["scenario.soil=toyoura-uncertain"]);
    let truth = truths(&prior, 77, 3)[2];
    let mut drive = Drive::new(&prior, &truth);
    for leg in [(0.0, 0.0, 0.6), (5.0, 3.0, 1.0), (6.0, 40.0, 0.6), (8.0, 5.0, 1.0)] {
        drive.leg(leg).unwrap();
    }
    let rover = &prior.value.rover;
    let text: String = drive.seen(usual(), 4).iter().map(csv_line).collect();
    std::fs::write("/tmp/drive.csv", csv_header(rover) + &text).unwrap();
}

#[test]
#[ignore = "prints"]
fn look_at_warnings() {
    let prior = scenario(&["scenario.soil=toyoura-uncertain"]);
    let count: u32 = std::env::var("N").map_or(10, |it| it.parse().unwrap());
    let started = std::time::Instant::now();
    for (place, truth) in truths(&prior, 5, count).iter().enumerate() {
        let mut drive = Drive::new(&prior, truth);
        if drive.leg((4.0, 3.0, 3.0)).is_none() || drive.leg((6.0, 20.0, 2.0)).is_none() {
            continue;
        }
        println!("{place} {:?} false: {:?}", truth.theory, warnings(&prior, &drive, usual(), 3));
        let mut drive = Drive::new(&prior, truth);
        drive.leg((6.0, 40.0, 2.0));
        let mut other = *truth;
        other.soil.friction_angle *= 0.85;
        drive.change(&other);
        let before = drive.records.last().unwrap().displacement[0];
        drive.leg((6.0, 40.0, 1.5));
        let after = drive.records.last().unwrap().displacement[0];
        println!("   change {before:?} {after:?}: {:?}", warnings(&prior, &drive, usual(), 3));
        let mut drive = Drive::new(&prior, truth);
        let mut slope = 3.0;
        while drive.leg((slope, 90.0, 0.06)).is_some() && slope < 40.0 {
            slope += 0.3;
        }
        let end = drive.records.last().unwrap();
        let ways: Vec<(f64, f64)> =
            drive.records.iter().map(|it| (it.time, it.displacement[0].unwrap())).collect();
        let stuck =
            ways.iter().position(|it| it.1 < 0.1 * twin::RIM_SPEED * 0.1).unwrap_or(ways.len() - 1);
        let all = warnings(&prior, &drive, usual(), 3);
        println!(
            "   stuck at {:.1} s of {:.1} slope {slope:.1} {:?}",
            ways[stuck].0, end.time, end.displacement[0]
        );
        for w in all.iter().filter(|it| it.kind == WarningKind::Entrapment) {
            let ground: f64 = ways[..stuck].iter().filter(|it| it.0 > w.time).map(|it| it.1).sum();
            println!("       {:.1} s and {:.2} m ahead: {:?}", ways[stuck].0 - w.time, ground, w);
        }
    }
    println!("{:?}", started.elapsed());
}
