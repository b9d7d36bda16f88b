//! Bands in colours and as arrows, over the relief of the ground.

use grouser::document::LoadedScenario;
use grouser::document::columns::map::{HEADING, VERDICT};
use grouser::document::columns::{COURSE, quantity};
use grouser::studies::mobility::{Ground, MobilityMap};
use grouser_draw::Sheet;
use grouser_draw::map::{MapFrame, MapPictures, OfSeveral};

use crate::{BandSummary, Look, MapColumn};

/// The worst of several verdicts by their numbers: go, caution, cannot tell, no-go.
const WORST: OfSeveral = OfSeveral { of: worse, name: "the worst" };
/// Of other numbers more is worse.
const LARGEST: OfSeveral = OfSeveral { of: f64::max, name: "the largest" };

/// What a band is called in pictures and styles.
#[must_use]
pub fn label(band: &MapColumn) -> String {
    let words = quantity(band.name, band.unit).label();
    match band.unit.symbol {
        "" | "-" => words,
        unit => format!("{words} [{unit}]"),
    }
}

/// The pictures of a map's bands.
pub struct BandPictures<'m> {
    ground: Ground<'m>,
    map: &'m MobilityMap,
    over_relief: MapPictures<'m>,
}

impl<'m> BandPictures<'m> {
    /// * `course`: as it was asked for, a number of degrees or a word
    #[must_use]
    pub fn of(
        scenario: &LoadedScenario,
        course: &str,
        (ground, map): (Ground<'m>, &'m MobilityMap),
    ) -> Self {
        let whose = grouser_draw::title_of(scenario);
        let course = match course {
            "best" => "the best course of each place".to_owned(),
            "worst" => "the worst course of each place".to_owned(),
            degrees => format!("course {degrees}° from the contour"),
        };
        let caption = format!("{whose}; {course}");
        let gradient = |column: usize, row: usize| ground.gradient(column, row);
        let over_relief = MapPictures::new(&caption, &ground.raster().grid, &gradient);
        Self { ground, map, over_relief }
    }

    /// Where the ground lies on each picture.
    #[must_use]
    pub fn frame(&self) -> MapFrame {
        self.over_relief.frame()
    }

    /// A band: directions as arrows, and other numbers in colours.
    ///
    /// * `of`: its numbers in all
    #[must_use]
    pub fn band(&self, band: &MapColumn, of: &BandSummary) -> Sheet {
        let Self { ground, map, over_relief } = self;
        let number = |column: usize, row: usize| Some(band.number(&ground.at(map, column, row)?));
        let title = label(band);
        match band.name {
            name if name == HEADING.name => {
                over_relief.arrows("where the nose points, seen from above", &number)
            }
            name if name == COURSE.name => {
                let travel = |column: usize, row: usize| {
                    let motion = ground.at(map, column, row)?;
                    Some(motion.travel(ground.gradient(column, row)?)?.to_degrees())
                };
                over_relief.arrows("where the rover goes, seen from above", &travel)
            }
            name => {
                let several = if name == VERDICT { WORST } else { LARGEST };
                over_relief.colours(&title, &number, &Look::of(name).scale(of), several)
            }
        }
    }
}

/// The worse of two verdicts.
fn worse(one: f64, other: f64) -> f64 {
    // Cannot tell, 4, is better than no-go, 3.
    let rank = |verdict: f64| if verdict == 3.0 { 5.0 } else { verdict };
    if rank(other) > rank(one) { other } else { one }
}

#[cfg(test)]
mod tests {
    use grouser::document::columns::map::verdict_number;
    use grouser::studies::verdict::Verdict;

    use super::*;

    /// The order of verdicts is that of their enum.
    #[test]
    fn the_worse_of_two_verdicts_is_the_later_one() {
        let all = [Verdict::Go, Verdict::Caution, Verdict::CannotTell, Verdict::NoGo];
        for (one, other) in all.iter().flat_map(|one| all.iter().map(move |other| (one, other))) {
            let number = |verdict: &Verdict| f64::from(verdict_number(*verdict));
            assert_eq!(worse(number(one), number(other)), number(one.max(other)));
        }
    }
}
