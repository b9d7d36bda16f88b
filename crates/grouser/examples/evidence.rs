//! What the wheel-soil models have achieved on the data sets that come with the library, and the weights that follow.

use grouser::contact::Model;
use grouser::document::measurements::Limits;
use grouser::document::ranking::{RankingError, evidence};
use grouser::studies::evidence::{Evidence, judged, stacked};

fn main() -> Result<(), RankingError> {
    let samples = std::env::args().nth(1).and_then(|it| it.parse().ok()).unwrap_or(100);
    let all = evidence(samples, 1, Limits::default())?;
    let equal = [1.0 / 3.0, 0.0, 1.0 / 3.0, 1.0 / 3.0];
    let mut named = [0.0; 4];
    for (place, model) in Model::ALL.iter().enumerate() {
        named[place] = if *model == Model::Bekker { 0.0 } else { equal[0] };
        print!("{} ", model.name());
    }
    println!("\nall: {:.3?}", stacked(&all.iter().collect::<Vec<_>>()));
    for set in &all {
        let others: Vec<&Evidence> = all.iter().filter(|it| it.source != set.source).collect();
        let shares = stacked(&others);
        println!("{} {} {}: {:.2?}", set.data_set, set.case, set.soil, shares);
        for (label, shares) in [("equal", named), ("stacked", shares)] {
            for it in judged(set, &shares) {
                println!("  {label:8} {:13} n {:3} rmse {:.3} worst {:.3} held {:.2} width {:.3} score {:.3}", it.kind.name(), it.count, it.rmse, it.worst, it.held as f64 / it.count as f64, it.width, it.interval_score);
            }
        }
        for (place, model) in Model::ALL.iter().enumerate() {
            let mut one = [0.0; 4];
            one[place] = 1.0;
            for it in judged(set, &one) {
                if it.rmse.is_finite() {
                    println!("  {:11} {:13} rmse {:.3} worst {:.3} held {:.2} width {:.3} score {:.3}", model.name(), it.kind.name(), it.rmse, it.worst, it.held as f64 / it.count as f64, it.width, it.interval_score);
                }
            }
        }
    }
    Ok(())
}
