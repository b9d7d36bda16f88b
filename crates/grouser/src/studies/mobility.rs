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
//! which a heading holds the course and slips no more than the [`Rule`](super::verdict::Rule) allows,
//! and the probability at a slope is the share of the samples whose steepest is below it. No curve
//! in between is stored: the steepest slopes, sorted, say it exactly.
//!
//! Verdicts are those of the [advice](super::verdict) on whole degrees: a place has that of the
//! degree above its slope.

mod choice;
mod classes;
mod compliance;
mod detail;
mod ground;
mod map;
mod median_slip;
mod table;
mod thresholds;

pub use self::choice::CourseChoice;
pub use self::classes::{advised_place, class_of, slope_and_course};
pub use self::compliance::SlipCompliances;
pub(super) use self::detail::Detail;
pub use self::ground::Ground;
pub use self::map::{CellMotion, MobilityMap};
pub use self::table::{Mobility, MobilityTable, OnSlope};
pub(super) use self::thresholds::Beyond;

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::studies::ensemble::samples::{BandInputs, Sample};
    use crate::studies::verdict::{Reason, SlopeStudy, Verdict};
    use crate::units::{Vec2, deg};
    use grouser_io::LoadedScenario;
    use grouser_io::unit::DEG;
    use grouser_io::{self as document, Overrides, Source};

    fn scenario(settings: &[&str]) -> LoadedScenario {
        let overrides = Overrides::parse(settings.iter().copied()).unwrap();
        document::read_scenario(&Source::default_scenario(), &overrides).unwrap()
    }

    fn table_of(course: f64) -> (SlopeStudy, MobilityTable) {
        let study = SlopeStudy::of(&scenario(&[]));
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
        let study = SlopeStudy::of(&loaded);
        let table = study.table(0.0, &samples, &|| true).unwrap().unwrap();
        for slope in [5.0, 12.0, 17.0, 19.0, 21.0, 23.0, 30.0].map(deg) {
            let is_no_go = |sample: &&Sample| {
                let found = study.heading.of_sample(sample).curve().unwrap().at(slope);
                found.map_or(true, |it| it.slip_ratio > study.rule.no_go_slip_ratio)
            };
            let counted = samples.iter().filter(is_no_go).count() as f64 / 40.0;
            assert_eq!(table.at(slope).probability_no_go, counted, "{slope}");
        }
    }

    /// A place has the verdict of the whole degree above it.
    #[test]
    fn the_verdict_of_a_place_is_the_advice_for_its_class() {
        let loaded = scenario(&["scenario.soil=toyoura-uncertain"]);
        let samples = BandInputs::of_scenario(&loaded).samples(3, 20).unwrap();
        let study = SlopeStudy::of(&loaded);
        let fixed = CourseChoice::Fixed(0.0);
        let map = MobilityMap::of(&study, fixed, deg(25.0), &samples, &|| true).unwrap().unwrap();
        assert_eq!(map.advice().len(), 26);
        let at = |slope: f64| map.at(Vec2::new(0.0, deg(slope).tan())).verdict;
        let advice = |slope: f64| {
            let on = study.advice(0.0, &[DEG.to_si(slope)], &samples, &|| true).unwrap().unwrap();
            on[0].judgement
        };
        for (slope, class) in [(2.1, 3.0), (3.0, 3.0), (9.5, 10.0), (12.0, 12.0), (22.5, 23.0)] {
            assert_eq!(at(slope), advice(class).verdict, "{slope}");
        }
        assert_eq!((at(2.1), at(22.5)), (Verdict::Go, Verdict::NoGo));
        assert_eq!(at(26.5), Verdict::CannotTell, "nobody looked there");
    }

    #[test]
    fn without_a_stated_uncertainty_nobody_can_tell() {
        let study = SlopeStudy::of(&scenario(&[]));
        let slopes = [3.0, 40.0].map(deg);
        let advice = study.advice(0.0, &slopes, &[], &|| true).unwrap().unwrap();
        let [gentle, steep] = [0, 1].map(|place: usize| advice[place].judgement);
        assert_eq!(gentle.verdict, Verdict::CannotTell);
        assert_eq!(gentle.reason, Reason::NoStatedUncertainty);
        assert_eq!(steep.verdict, Verdict::NoGo);
    }

    /// Down is easy where up is not: who is to come back may not go.
    #[test]
    fn the_best_course_counts_the_way_back() {
        let loaded = scenario(&["scenario.soil=toyoura-uncertain"]);
        let samples = BandInputs::of_scenario(&loaded).samples(3, 20).unwrap();
        let study = SlopeStudy::of(&loaded);
        let slope = deg(16.0);
        let map =
            |choice| MobilityMap::of(&study, choice, slope, &samples, &|| true).unwrap().unwrap();
        let advice = |choice| map(choice).advice()[16].clone();
        let best = advice(CourseChoice::Best);
        let [up, down] = [FRAC_PI_2, -FRAC_PI_2].map(|course| advice(CourseChoice::Fixed(course)));
        assert!(down.judgement.verdict < up.judgement.verdict, "{down:?} {up:?}");
        assert!(best.course.abs() < deg(89.0) && best.judgement.verdict < Verdict::NoGo);
        let back = study.advice(-best.course, &[slope], &samples, &|| true).unwrap().unwrap();
        assert!(best.judgement.verdict >= back[0].judgement.verdict);
        // Nobody leaves a contour that is a go.
        for gentle in [6, 8] {
            let [best, contour] = [CourseChoice::Best, CourseChoice::Fixed(0.0)]
                .map(|choice| map(choice).advice()[gentle].judgement.verdict);
            assert!(best <= contour, "{gentle}°: {best:?} {contour:?}");
        }
    }

    /// Turning the ground turns the heading by as much, and nothing else.
    #[test]
    fn headings_turn_with_the_ground() {
        let study = SlopeStudy::of(&scenario(&[]));
        let map = MobilityMap::of(&study, CourseChoice::Fixed(0.0), deg(10.0), &[], &|| true)
            .unwrap()
            .unwrap();
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
        let study = SlopeStudy::of(&scenario(&[]));
        let up = CourseChoice::Fixed(FRAC_PI_2);
        let map = MobilityMap::of(&study, up, deg(5.0), &[], &|| true).unwrap().unwrap();
        let heading = map.at(Vec2::new(0.05, 0.05)).heading.unwrap();
        assert!((heading.to_degrees() - 45.0).abs() < 1e-6, "{heading}");
    }

    #[test]
    fn the_best_course_is_no_worse_than_any_and_the_worst_no_better() {
        let study = SlopeStudy::of(&scenario(&[]));
        let [best, worst] = [CourseChoice::Best, CourseChoice::Worst].map(|choice| {
            MobilityMap::of(&study, choice, deg(26.0), &[], &|| true).unwrap().unwrap()
        });
        for degrees in [2.0, 8.0, 14.0, 19.0, 26.0] {
            let gradient = Vec2::new(deg(degrees).tan(), 0.0);
            let (good, bad) = (best.at(gradient), worst.at(gradient));
            assert!(good.probability_no_go <= bad.probability_no_go, "{degrees}");
            // Of the courses that are as seldom a no-go, it slips least: both there and back.
            let both_ways = |place: usize, of: &dyn Fn(usize) -> f64| {
                of(place).max(of(best.tables().len() - 1 - place))
            };
            let fails = |place: usize| best.tables()[place].probability_no_go(good.slope);
            let slips = |place: usize| {
                let motion = best.tables()[place].motion(good.slope);
                motion.map_or(f64::INFINITY, |motion| motion.slip_ratio.abs())
            };
            let all = 0..best.tables().len();
            let least = all.clone().map(|it| both_ways(it, &fails)).fold(f64::INFINITY, f64::min);
            let is_chosen = |place: &usize| best.tables()[*place].course() == good.course;
            let chosen = all.clone().find(is_chosen).expect("one of them");
            assert_eq!(both_ways(chosen, &fails), least, "{degrees}");
            for place in all.filter(|place| both_ways(*place, &fails) == least) {
                let slack = 2e-3;
                assert!(both_ways(chosen, &slips) <= both_ways(place, &slips) + slack, "{degrees}");
            }
        }
    }
}
