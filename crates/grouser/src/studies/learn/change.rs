//! Whether the soil has become another: evidence that is summed up over stretches (Page 1954).
//!
//! A stretch speaks for another soil by as much as it would be likelier if nothing had been learnt. While there is such
//! evidence, stretches are judged by what was believed before it began: a filter that learns goes along with another
//! soil, and after two or three stretches finds it no stranger than the first.

use super::filter::Filter;
use super::gaussian::Surprise;
use super::motion::SeenMotion;
use super::noise::ModelNoise;
use crate::studies::heading::HeadingStudy;

/// The evidence so far.
#[derive(Clone, Debug, Default)]
pub(super) struct SoilChange {
    /// A logarithm of densities, 0 or more.
    evidence: f64,
    /// What was believed before there was any, and the rims' way since then [m].
    suspected: Option<(Filter, f64)>,
}

/// Evidence at which the soil counts as another: false alarms are one in e^9 stretches or fewer, if what is learnt is
/// right.
const CHANGED: f64 = 9.0;
/// The most that one stretch may say: three have to agree, so that no outlier is a soil.
const MOST_SAID: f64 = 3.5;
/// Evidence that is not enough after this way of the rims is none [m].
const LONGEST: f64 = 1.0;

impl SoilChange {
    /// Whether the soil has just been found to be another.
    ///
    /// * `before`: what was believed before the stretch
    /// * `surprise`: how surprising it was to that
    pub(super) fn look(
        &mut self,
        (before, surprise): (&Filter, &Surprise),
        (study, motion, noise): (&HeadingStudy, &SeenMotion, &ModelNoise),
        way: f64,
    ) -> bool {
        let strangeness = match &mut self.suspected {
            Some((filter, since)) => {
                *since += way;
                filter.surprise(study, motion, noise).map_or(0.0, |it| it.strangeness)
            }
            None => surprise.strangeness,
        };
        self.evidence = (self.evidence + strangeness.min(MOST_SAID)).max(0.0);
        if self.evidence >= CHANGED {
            *self = Self::default();
            return true;
        }
        let is_over = self.suspected.as_ref().is_some_and(|(_, since)| *since > LONGEST);
        if self.evidence == 0.0 || is_over {
            *self = Self::default();
        } else if self.suspected.is_none() {
            self.suspected = Some((before.clone(), way));
        }
        false
    }
}
