//! The columns of ways.

use super::way::Way;
use crate::document::columns::map::PROBABILITY_NO_GO;
use crate::document::columns::run::BATTERY_ENERGY;
use crate::document::columns::verdict::VERDICT;
use crate::document::columns::{
    Column, ENERGY, PROBABILITY_COMPLETED, Quantity, STATUS, TIME, quantity, text,
};
use crate::document::unit::{DEG, J, M, ONE, S};

const MINIMISE: &str = "minimise";
const LENGTH: Quantity = quantity("length_m", M);
const TURNED: Quantity = quantity("turned_deg", DEG);
const MEAN_SLIP: Quantity = quantity("mean_slip_ratio", ONE);
const MOST_SLIP: Quantity = quantity("most_slip_ratio", ONE);
/// The steepest slope.
pub(super) const MOST_SLOPE: Quantity = quantity("most_slope_deg", DEG);
const SIMULATED_TIME: Quantity = quantity("simulated_time_s", S);
const SIMULATED_ENERGY: Quantity = quantity("simulated_energy_j", J);

/// What a way takes; without a way there is a reason instead of numbers.
pub(super) const WAY: [Column<Way>; 15] = [
    text(MINIMISE, "What the way has least of; none of a line that was given", |way| {
        way.record.minimise.map(str::to_owned)
    }),
    text(
        STATUS,
        "`found` or `no-safe-route`; of a line that was given `safe` or `not-safe`, and of a way \
         that has a leg with the verdict no-go all the same",
        |way| Some(way.record.status.to_owned()),
    ),
    text(VERDICT, "The worst verdict of its legs", |way| way.record.verdict.map(str::to_owned)),
    LENGTH.maybe("Length over the ground", |way| way.by_tables(|it| it.length)),
    TIME.maybe("Time, with turns", |way| way.by_tables(|it| it.time)),
    ENERGY.maybe("Work of the wheels, with turns", |way| way.by_tables(|it| it.energy)),
    BATTERY_ENERGY.maybe(
        "Electrical energy that motors, with cold windings, and with a battery the electronics \
         draw, with turns; missing where no motor is known",
        |way| way.record.battery_energy_j,
    ),
    TURNED.maybe("Angle of all turns together", |way| way.by_tables(|it| it.turned)),
    MEAN_SLIP.maybe("Mean slip ratio over the way", |way| way.by_tables(|it| it.mean_slip_ratio)),
    MOST_SLIP.maybe("The largest slip ratio", |way| way.by_tables(|it| it.most_slip_ratio)),
    MOST_SLOPE.maybe("The steepest slope", |way| way.by_tables(|it| it.most_slope)),
    PROBABILITY_NO_GO
        .maybe("Share of the samples in which some place of the way is a no-go", |way| {
            way.by_tables(|it| it.probability_no_go)
        }),
    SIMULATED_TIME
        .maybe("Time of the simulated drive, with turns", |way| way.by_simulation(|it| it.time)),
    SIMULATED_ENERGY.maybe("Work of the wheels in the simulated drive, with turns", |way| {
        way.by_simulation(|it| it.energy)
    }),
    text("reason", "Why there is no way, or why it is not safe", |way| way.record.reason.clone()),
];

/// The columns for reading; what motors draw where some are known.
pub(super) fn brief(ways: &[Way]) -> Vec<String> {
    let has_motors = ways.iter().any(|way| way.record.battery_energy_j.is_some());
    let first = [MINIMISE, STATUS, PROBABILITY_COMPLETED.name, VERDICT];
    let taken = [LENGTH.name, TIME.name, ENERGY.name, BATTERY_ENERGY.name, TURNED.name];
    let worst = [MOST_SLIP.name, MOST_SLOPE.name];
    let all = first.into_iter().chain(taken).chain(worst);
    all.filter(|it| has_motors || *it != BATTERY_ENERGY.name).map(String::from).collect()
}
