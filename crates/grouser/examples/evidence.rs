//! What the wheel-soil models have achieved on the data sets that come with the library, and the weights that follow.

use grouser::contact::Model;
use grouser::document::measurements::Limits;
use grouser::document::ranking::{RankingError, evidence};
use grouser::studies::evidence::{judged, stacked, without};

fn main() -> Result<(), RankingError> {
    let samples = std::env::args().nth(1).and_then(|it| it.parse().ok()).unwrap_or(100);
    let mut all = evidence(samples, 1, Limits::default())?;
    let factor: f64 = std::env::var("F").ok().and_then(|it| it.parse().ok()).unwrap_or(1.0);
    all.retain(|it| it.soil != "grc-1");
    for set in &mut all {
        for answer in &mut set.answers {
            for samples in &mut answer.predicted {
                let mut sorted = samples.clone();
                sorted.sort_by(f64::total_cmp);
                let middle = sorted[sorted.len() / 2];
                for it in samples.iter_mut() {
                    *it = middle + factor * (*it - middle);
                }
            }
        }
    }
    let equal = [1.0 / 3.0, 0.0, 1.0 / 3.0, 1.0 / 3.0];
    let mut named = [0.0; 4];
    for (place, model) in Model::ALL.iter().enumerate() {
        named[place] = if *model == Model::Bekker { 0.0 } else { equal[0] };
        print!("{} ", model.name());
    }
    println!("\nall: {:.3?}", stacked(&all.iter().collect::<Vec<_>>()));
    let whole = stacked(&all.iter().filter(|it| it.in_sample.is_none()).collect::<Vec<_>>());
    println!("whole {whole:.3?}");
    for set in &all {
        if set.case == "contour" {
            for answer in &set.answers {
                let ones: Vec<f64> = (0..4)
                    .map(|place| {
                        let mut one = [0.0; 4];
                        one[place] = 1.0;
                        answer.quantile(&one, 0.5).to_degrees()
                    })
                    .collect();
                println!(
                    "yaw measured {:.2} whole {:.2} equal {:.2} models {:.2?}",
                    answer.measured.to_degrees(),
                    answer.quantile(&without(set, &all), 0.5).to_degrees(),
                    answer.quantile(&named, 0.5).to_degrees(),
                    ones
                );
            }
        }
        let shares = without(set, &all);
        println!("{} {} {}: {:.2?}", set.data_set, set.case, set.soil, shares);
        for (label, shares) in [("equal", named), ("stacked", shares)] {
            for it in judged(set, &shares) {
                println!(
                    "  {label:8} {:13} n {:3} rmse {:.3} worst {:.3} held {:.2} width {:.3} score {:.3}",
                    it.kind.name(),
                    it.count,
                    it.rmse,
                    it.worst,
                    it.held as f64 / it.count as f64,
                    it.width,
                    it.interval_score
                );
            }
        }
        for (place, model) in Model::ALL.iter().enumerate() {
            let mut one = [0.0; 4];
            one[place] = 1.0;
            for it in judged(set, &one) {
                if it.rmse.is_finite() {
                    println!(
                        "  {:11} {:13} rmse {:.3} worst {:.3} held {:.2} width {:.3} score {:.3}",
                        model.name(),
                        it.kind.name(),
                        it.rmse,
                        it.worst,
                        it.held as f64 / it.count as f64,
                        it.width,
                        it.interval_score
                    );
                }
            }
        }
    }
    let (mut n, mut held) = (0, 0);
    let mut ratio = Vec::new();
    for set in &all {
        let shares = without(set, &all);
        for it in judged(set, &shares) {
            n += it.count;
            held += it.held;
            ratio.push((it.interval_score, it.width));
        }
    }
    println!(
        "TOTAL held {:.3} scores {:?}",
        held as f64 / n as f64,
        ratio.iter().map(|it| (it.0 * 1000.0).round() / 1000.0).collect::<Vec<_>>()
    );
    println!("TOTAL whole {whole:.3?}");
    Ok(())
}
