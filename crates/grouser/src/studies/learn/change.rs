//! Whether the soil has become another: evidence that is summed up over stretches (Page 1954).
//!
//! Where a stretch is stranger than it would be if nothing had been learnt, a second learner begins anew with it. Both
//! learn from then on, and each stretch speaks for another soil by as much as the new learner expected it better. A
//! belief that is a little off is so in every stretch; since both learn, that counts once.

use super::filter::Filter;
use super::gaussian::Surprise;
use super::motion::SeenMotion;
use super::noise::ModelNoise;
use super::state::Archive;
use crate::studies::heading::HeadingStudy;

/// The evidence so far.
#[derive(Clone, Debug, Default)]
pub(super) struct SoilChange {
    /// What is suspected; nothing where there is no evidence.
    suspicion: Option<Suspicion>,
}

/// That the soil is another since a while.
#[derive(Clone, Debug)]
struct Suspicion {
    /// What a learner believes that began anew.
    anew: Filter,
    /// A logarithm of densities.
    evidence: f64,
    /// The rims' way since it began [m].
    way: f64,
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
    /// * `learner`: what is believed now, of any soil
    /// * `surprise`: how surprising the stretch was before that
    pub(super) fn look(
        &mut self,
        (learner, surprise): (&Filter, &Surprise),
        (study, motion, noise): (&HeadingStudy, &SeenMotion, &ModelNoise),
        way: f64,
    ) -> bool {
        let suspicion = self.suspicion.take().or_else(|| {
            let begins = surprise.strangeness > 0.0;
            begins.then(|| Suspicion { anew: learner.anew(), evidence: 0.0, way: 0.0 })
        });
        let Some(mut suspicion) = suspicion else { return false };
        let Ok((surprise_anew, _)) = suspicion.anew.learn(study, motion, noise) else {
            return false;
        };
        let stranger = surprise_anew.log_density - surprise.log_density;
        suspicion.evidence += stranger.min(MOST_SAID);
        suspicion.way += way;
        let is_another = suspicion.evidence >= CHANGED;
        let goes_on = suspicion.evidence > 0.0 && suspicion.way < LONGEST && !is_another;
        self.suspicion = goes_on.then_some(suspicion);
        is_another
    }

    /// * `blank`: a filter of a model by its name, to read into
    pub(super) fn walk(
        &mut self,
        archive: &mut dyn Archive,
        blank: impl Fn(&str) -> Option<Filter>,
    ) {
        let theory = self.suspicion.as_ref().map(|it| it.anew.unknowns.theory().name());
        let mut theory = theory.unwrap_or_default().to_owned();
        archive.word("theory", &mut theory);
        if theory.is_empty() {
            self.suspicion = None;
            return;
        }
        let begun = self
            .suspicion
            .take()
            .or_else(|| Some(Suspicion { anew: blank(&theory)?, evidence: 0.0, way: 0.0 }));
        let Some(mut suspicion) = begun else { return archive.refuse("theory") };
        let Suspicion { anew, evidence, way } = &mut suspicion;
        archive.number("evidence", evidence);
        archive.number("way", way);
        archive.group("belief");
        anew.walk(archive);
        archive.end();
        self.suspicion = Some(suspicion);
    }

    /// Whether what is suspected is of as many numbers as there are unknowns.
    pub(super) fn is_whole(&self) -> bool {
        self.suspicion.as_ref().is_none_or(|it| it.anew.is_whole())
    }
}
