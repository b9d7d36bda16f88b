//! What a rover does on any slope of a soil, as tables that millions of places are read from.
//!
//! A [`MobilityTable`] has one course: a direction of travel, counted from the contour and positive
//! uphill. Its numbers are those of the [heading offset](super::heading) that holds the course, at
//! nodes that lie closer the nearer the steepest slope is. There slip and crab angle rise with a
//! vertical tangent, like a square root; over
//!
//! ```text
//! v = 1 − √(1 − α/α_max)        α = α_max v (2 − v)
//! ```
//!
//! they have none, and straight lines between nodes meet them closely. How closely is measured
//! while the table is made, half-way between nodes, and stated with it
//! ([`MobilityTable::largest_errors`]).
//!
//! How likely a slope is a no-go comes from samples of soil and model: each has a steepest slope on
//! which a heading holds the course and slips no more than the [`Rule`](super::card::Rule) allows,
//! and the probability at a slope is the share of the samples whose steepest is below it. No curve
//! in between is stored: the steepest slopes, sorted, say it exactly.

mod choice;
mod compliance;
mod detail;
mod ground;
mod map;
mod table;
mod thresholds;

pub use self::choice::CourseChoice;
pub use self::compliance::SlipCompliances;
pub(super) use self::detail::Detail;
pub use self::ground::Ground;
pub use self::map::{CellMotion, MobilityMap};
pub use self::table::{Mobility, MobilityStudy, MobilityTable, OnSlope};

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::studies::card::Verdict;
    use crate::studies::ensemble::samples::{BandInputs, Sample};
    use crate::units::{Vec2, deg};
    use grouser_io::LoadedScenario;
    use grouser_io::{self as document, Overrides, Source};

    fn scenario(settings: &[&str]) -> LoadedScenario {
        let overrides = Overrides::parse(settings.iter().copied()).unwrap();
        document::read_scenario(&Source::default_scenario(), &overrides).unwrap()
    }

    fn table_of(course: f64) -> (MobilityStudy, MobilityTable) {
        let study = MobilityStudy::of(&scenario(&[]));
        let table = study.table(course, &[], &|| true).unwrap().unwrap();
        (study, table)
    }

    /// At slopes that are no nodes, up to a hair from the steepest.
    #[test]
    fn a_table_is_as_near_to_its_curve_as_it_says() {
        for course in [-60.0, 0.0, 30.0, 90.0].map(deg) {
            let (study, table) = table_of(course);
            let (curve, stated) =
                (study.heading.curve_on(course).unwrap(), *table.largest_errors());
            assert!(stated.crab < deg(0.05) && stated.slip_ratio < 0.002, "{course}: {stated:?}");
            let limit = table.limit().unwrap();
            for share in [0.013, 0.21, 0.377, 0.5, 0.731, 0.9, 0.97, 0.999, 0.999_999] {
                let slope = limit * share;
                let (read, exact) = (table.motion(slope).unwrap(), curve.at(slope).unwrap());
                let within =
                    |one: f64, other: f64, stated: f64| (one - other).abs() <= 2.0 * stated + 1e-9;
                assert!(within(read.crab, exact.crab(), stated.crab), "{course} {share}: {read:?}");
                assert!(within(read.slip_ratio, exact.slip_ratio, stated.slip_ratio), "{share}");
                assert!(within(read.sinkage, exact.mean_sinkage(), stated.sinkage), "{share}");
                let work = exact.energy_per_metre(&study.heading.rover);
                assert!((read.energy_per_metre() / work - 1.0).abs() < 0.01, "{share}");
            }
            assert_eq!(table.motion(limit + 1e-9), None);
        }
    }

    /// The share of the samples, counted one by one.
    #[test]
    fn the_probability_is_that_of_the_samples() {
        let loaded = scenario(&["scenario.soil=toyoura-uncertain"]);
        let samples = BandInputs::of_scenario(&loaded).samples(3, 40).unwrap();
        let study = MobilityStudy::of(&loaded);
        let table = study.table(0.0, &samples, &|| true).unwrap().unwrap();
        for slope in [5.0, 12.0, 17.0, 19.0, 21.0, 23.0, 30.0].map(deg) {
            let is_no_go = |sample: &&Sample| {
                let found = study.heading.of_sample(sample).curve().unwrap().at(slope);
                found.map_or(true, |it| it.slip_ratio > study.rule.no_go_slip_ratio)
            };
            let counted = samples.iter().filter(is_no_go).count() as f64 / 40.0;
            assert_eq!(table.at(slope).probability_no_go, counted, "{slope}");
            let verdict = table.at(slope).verdict;
            assert!(counted < 0.21 || verdict == Verdict::NoGo, "{slope}: {counted} {verdict:?}");
        }
        assert_eq!(table.at(deg(3.0)).verdict, Verdict::Go);
    }

    #[test]
    fn without_a_stated_uncertainty_no_slope_is_a_go() {
        let (_, table) = table_of(0.0);
        assert_eq!(table.at(deg(3.0)).verdict, Verdict::Caution);
        assert_eq!(table.at(deg(40.0)).verdict, Verdict::NoGo);
    }

    /// Turning the ground turns the heading by as much, and nothing else.
    #[test]
    fn headings_turn_with_the_ground() {
        let study = MobilityStudy::of(&scenario(&[]));
        let map =
            MobilityMap::of(&study, CourseChoice::Fixed(0.0), &[], &|| true).unwrap().unwrap();
        let rise = deg(10.0).tan();
        let contour = map.at(Vec2::new(0.0, rise));
        let yaw = contour.motion.unwrap().crab;
        // With the hill in the north, the contour with the hill on the left leads east.
        let expected = (yaw.sin() * deg(10.0).cos()).atan2(yaw.cos());
        assert!((contour.heading.unwrap() - expected).abs() < 1e-12);
        for turn in [0.3, 1.0, 2.5, -2.0] {
            let turned = map.at(Vec2::new(-rise * f64::sin(turn), rise * f64::cos(turn)));
            assert!((turned.heading.unwrap() - expected - turn).sin().abs() < 1e-12, "{turn}");
            assert!((turned.slope - contour.slope).abs() < 1e-15);
        }
        assert_eq!(map.at(Vec2::zeros()).heading, None);
    }

    /// Straight up, where the nose has to point uphill on the map.
    #[test]
    fn straight_up_leads_up_the_gradient() {
        let study = MobilityStudy::of(&scenario(&[]));
        let up = CourseChoice::Fixed(FRAC_PI_2);
        let map = MobilityMap::of(&study, up, &[], &|| true).unwrap().unwrap();
        let heading = map.at(Vec2::new(0.05, 0.05)).heading.unwrap();
        assert!((heading.to_degrees() - 45.0).abs() < 1e-6, "{heading}");
    }

    #[test]
    fn the_best_course_is_no_worse_than_any_and_the_worst_no_better() {
        let study = MobilityStudy::of(&scenario(&[]));
        let [best, worst] = [CourseChoice::Best, CourseChoice::Worst]
            .map(|choice| MobilityMap::of(&study, choice, &[], &|| true).unwrap().unwrap());
        for degrees in [2.0, 8.0, 14.0, 19.0, 26.0] {
            let gradient = Vec2::new(deg(degrees).tan(), 0.0);
            let (good, bad) = (best.at(gradient), worst.at(gradient));
            assert!(good.probability_no_go <= bad.probability_no_go, "{degrees}");
            for table in best.tables() {
                let (Some(motion), Some(found)) = (table.motion(good.slope), good.motion) else {
                    continue;
                };
                let slack = 2e-3;
                assert!(found.slip_ratio.abs() <= motion.slip_ratio.abs() + slack, "{degrees}");
            }
        }
    }
}
