//! What is learnt from drives whose soil is hidden from the learner.

mod twin;

use grouser::studies::simulated_telemetry::SensorModels;
use twin::{answer, scenario, truths};

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
