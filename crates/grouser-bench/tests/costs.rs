//! No answer costs much more than that of a driving wheel: a bound over the whole domain.

use grouser::contact::Model;
use grouser_bench::costs::{CostMap, LOAD_SHARES, SLIP_RATIOS};

/// Up to half of what the soil carries, in any motion. Locked wheels of `small-wheel` take 3.0.
const CARRIED: f64 = 3.1;
/// Near the most that the soil carries and beyond: the highest F_z is sought, as far up from the
/// axle as it may be. Locked wheels of `ishigami`, whose F_z is highest above the axle, take 9.0.
const NEAR_THE_MOST: f64 = 9.1;

#[test]
fn no_answer_takes_many_times_the_looks_of_a_driving_wheel() {
    let map = CostMap::new().expect("the presets can be read");
    for model in &Model::ALL {
        for (ratio, row) in SLIP_RATIOS.iter().zip(map.worst(model)) {
            for (share, cost) in LOAD_SHARES.iter().zip(row) {
                let bound = if *share <= 0.5 { CARRIED } else { NEAR_THE_MOST };
                let place = format!("{} at a slip ratio of {ratio}", model.name());
                assert!(cost <= bound, "{place}, {share} of what the soil carries: {cost}");
                // A wheel that nothing was asked of would cost nothing.
                assert!(cost > 0.3, "{place}: {cost}");
            }
        }
    }
}

/// The map has the same wheels and counts at every call.
#[test]
fn the_map_repeats() {
    let map = CostMap::new().expect("the presets can be read");
    let [one, other] = [map.worst(&Model::Bekker), map.worst(&Model::Bekker)];
    assert_eq!(one, other);
}
