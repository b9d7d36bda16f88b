mod alarms;
mod change;
mod coverage;
mod drive;
mod entrapment;
mod probe;

use std::time::Instant;
use coverage::*;
use drive::*;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let what = arguments[0].as_str();
    let seed: u64 = arguments[1].parse().unwrap();
    let repeats: u32 = arguments[2].parse().unwrap();
    let samples: u32 = arguments.get(3).map_or(60, |it| it.parse().unwrap());
    let prior = scenario(&["scenario.soil=toyoura-uncertain", "scenario.model=ishigami"]);
    let other = scenario(&["scenario.soil=toyoura-uncertain", "scenario.model=small-wheel"]);
    let open = scenario(&["scenario.soil=toyoura-uncertain"]);
    let trial = Trial { prior: &prior, hidden: &prior, uneven: true, samples, seed };
    let start = Instant::now();
    match what {
        "even" | "uneven" | "other" | "other-even" | "bank" => {
            let trial = match what {
                "even" => Trial { uneven: false, ..trial },
                "other" => Trial { hidden: &other, ..trial },
                "other-even" => Trial { hidden: &other, uneven: false, ..trial },
                "bank" => Trial { hidden: &open, prior: &open, ..trial },
                _ => trial,
            };
            let answers = trial.answers(repeats);
            println!("{what} {} held {:?} errors {:?}", answers.len(), held(&answers), yaw_errors(&answers));
            for place in 0..answers[0].ranks.len() {
                let mut bins = [0; 10];
                for a in &answers { bins[((a.ranks[place] * 10.0) as usize).min(9)] += 1; }
                println!("ranks {place} {bins:?}");
            }
            if std::env::var("SHOW").is_ok() {
                for a in &answers { println!("{:?} {:?} {:?}", a.truth, a.after, a.ranks); }
            }
        }
        "change" => for change in change::Change::ALL {
            let all = change::flagged(&trial, change, repeats);
            let matter: Vec<_> = all.iter().filter(|it| it.matters).collect();
            let soon = matter.iter().filter(|it| it.way.is_some_and(|it| it < 0.5)).count();
            let ever = matter.iter().filter(|it| it.way.is_some()).count();
            let not = all.iter().filter(|it| !it.matters && it.way.is_some()).count();
            let early = all.iter().filter(|it| it.early).count();
            println!("{}: {} cases, {} matter, {soon} within .5, {ever} ever; of others {not}; early {early}", change.name(), all.len(), matter.len());
            let mut ways: Vec<f64> = matter.iter().filter_map(|it| it.way).collect();
            ways.sort_by(f64::total_cmp);
            println!("{ways:.2?}");
        },
        "entrapment" => for way in [entrapment::Way::Steepening(5.0), entrapment::Way::Steepening(2.0), entrapment::Way::Weakening(0.1), entrapment::Way::Weakening(0.3)] {
            let all = entrapment::leads(&trial, way, repeats);
            let mut ways: Vec<f64> = all.iter().map(|it| it.map_or(0.0, |it| it.way)).collect();
            let mut times: Vec<f64> = all.iter().map(|it| it.map_or(0.0, |it| it.time)).collect();
            ways.sort_by(f64::total_cmp); times.sort_by(f64::total_cmp);
            let q = |v: &[f64], s: f64| v[((v.len() as f64 * s) as usize).min(v.len()-1)];
            let ok = all.iter().filter(|it| it.is_some_and(|it| it.way >= 0.3 && it.time >= 5.0)).count();
            println!("{}: {} cases, {ok} ok, never {}; way 5% {:.2} median {:.2} 95% {:.2}; time 5% {:.1} median {:.1} 95% {:.1}", way.name(), all.len(), all.iter().filter(|it| it.is_none()).count(), q(&ways,0.05), q(&ways,0.5), q(&ways,0.95), q(&times,0.05), q(&times,0.5), q(&times,0.95));
        },
        "alarms" => for (name, models) in alarms::instruments() {
            let all = alarms::alarms(&trial, models, repeats);
            println!("{name}: {all:?}");
        },
        "probe" => { use grouser::studies::simulated_telemetry::SensorModels;
            let models = match arguments[4].as_str() { "perfect" => SensorModels::PERFECT, "clean" => SensorModels { dropouts: 0.0, ..SensorModels::USUAL }, "usual" => SensorModels::USUAL, "att" => SensorModels { attitude: SensorModels::USUAL.attitude, ..SensorModels::PERFECT }, "odo" => SensorModels { odometry: SensorModels::USUAL.odometry, ..SensorModels::PERFECT }, "rot" => SensorModels { rotation: SensorModels::USUAL.rotation, ..SensorModels::PERFECT },"speed" => SensorModels { wheel_speed: SensorModels::USUAL.wheel_speed, ..SensorModels::PERFECT },"torque" => SensorModels { torque: SensorModels::USUAL.torque, ..SensorModels::PERFECT },"drop" => SensorModels { dropouts: 0.05, ..SensorModels::PERFECT },"out" => SensorModels { outliers: 0.05, ..SensorModels::PERFECT }, _ => INSTRUMENTS };
            let trial = Trial { uneven: arguments.get(6).is_some(), ..trial };
            probe::probe(&trial, repeats, models, arguments[5] == "own") }
        _ => panic!(),
    }
    println!("{:?}", start.elapsed());
}
