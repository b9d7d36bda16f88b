//! What a mission risks on other soils and models, and what to do on each of its legs.

use grouser::answers::Sampling;
use grouser::document::LoadedMission;
use grouser::document::columns::YAW;
use grouser::document::columns::completion::in_words;
use grouser::document::columns::verdict::subject;
use grouser::mission::{Manoeuvre, Mission};
use grouser::studies::completion::Completion;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::mission::{DrivenLeg, DrivenMission};
use grouser::studies::verdict::{Advice, Reason, Rule, SlopeStudy};
use serde_json::Value;

use crate::args::MissionArgs;
use crate::commands::sampling::{whole, with_bar};
use crate::failure::Failure;
use crate::inputs;

/// Before the numbers of legs that there is no advice for.
const NOT_ADVISED: &str = "Not advised on, backward, crabbing or over several soils: leg ";

/// What each mission risks, and the advice for each of its legs that leads somewhere or turns.
pub(super) struct Believed {
    pub(super) sampling: Sampling,
    pub(super) rule: Rule,
    /// Name, samples and models, as JSON has them.
    pub(super) belief: Value,
    ways: Vec<(Completion, Vec<Option<Advice>>)>,
}

impl Believed {
    /// * `missions`, `ways`: by their names, and as they were driven
    pub(super) fn of(
        args: &MissionArgs,
        document: &LoadedMission,
        (missions, ways): (&[(String, Mission)], &[DrivenMission]),
        sampling: Sampling,
    ) -> Result<Self, Failure> {
        let rule = inputs::rule(&args.rule)?;
        let scenario = document.with_value(document.value.scenario.clone());
        let samples = sampling.draw_if_uncertain(&BandInputs::of_scenario(&scenario))?;
        let study = SlopeStudy { rule, ..SlopeStudy::of(&scenario) };
        let pairs = missions.iter().zip(ways);
        let all = pairs.map(|((_, mission), way)| {
            let study = SlopeStudy { rim_speed: mission.rim_speed(), ..study.clone() };
            let count = samples.len().max(1);
            let risk = with_bar(count, |go_on| Completion::of_mission(mission, &samples, go_on));
            let advice = way.advice(&study, &mission.scenario, &samples, &|| true)?;
            Ok((whole(risk), whole(advice)))
        });
        let ways = all.collect::<Result<_, Failure>>()?;
        Ok(Self { sampling, rule, belief: sampling.belief(&scenario), ways })
    }

    /// What one of the missions risks.
    pub(super) fn way(&self, place: usize) -> (&Completion, &[Option<Advice>]) {
        let (risk, advice) = &self.ways[place];
        (risk, advice)
    }

    /// The reasons of all verdicts.
    pub(super) fn reasons(&self) -> impl Iterator<Item = Reason> {
        let all = self.ways.iter().flat_map(|(_, advice)| advice.iter().flatten());
        all.map(|advice| advice.judgement.reason)
    }

    /// Sentences on a mission: the whole first, then each leg that has advice, and which have none:
    /// those that it is not made for, and those that were not begun.
    pub(super) fn sentences(&self, place: usize, way: &DrivenMission) -> Vec<String> {
        let (risk, advice) = self.way(place);
        let legs = || way.legs.iter().zip(advice);
        let advised = legs().filter_map(|(leg, advice)| Some(of_leg(leg, advice.as_ref()?)));
        let moves = |leg: &DrivenLeg| !matches!(leg.leg.manoeuvre, Manoeuvre::Wait { .. });
        let others = legs().filter(|(leg, advice)| advice.is_none() && moves(leg));
        let others: Vec<String> = others.map(|(leg, _)| leg.number.to_string()).collect();
        let others = (!others.is_empty()).then(|| format!("{NOT_ADVISED}{}.", others.join(", ")));
        let begun = way.legs.len();
        let not_begun = (begun < way.planned).then(|| {
            let later = match way.planned - begun {
                1 => format!("leg {}", way.planned),
                _ => format!("legs {} to {}", begun + 1, way.planned),
            };
            format!(
                "Not advised on, as the drive on the soil as written ends in leg {begun}: {later}."
            )
        });
        [in_words(risk, "")].into_iter().chain(advised).chain(others).chain(not_begun).collect()
    }

    /// The leg with the worst verdict, and of several the one on which the rover most often gets
    /// stuck: nothing where fewer than two have advice.
    pub(super) fn worst(&self, place: usize, way: &DrivenMission) -> Option<String> {
        let (_, advice) = self.way(place);
        let legs = way.legs.iter().zip(advice).filter_map(|(leg, it)| Some((leg, it.as_ref()?)));
        let count = advice.iter().flatten().count();
        let rank = |it: &Advice| (it.judgement.verdict, it.probability_stuck().unwrap_or(0.0));
        // Of two that are as bad it is the first.
        let (leg, advice) =
            legs.reduce(|one, other| if rank(other.1) > rank(one.1) { other } else { one })?;
        (count > 1).then(|| format!("The worst: {}", of_leg(leg, advice)))
    }
}

/// What to do on a leg.
fn of_leg(leg: &DrivenLeg, advice: &Advice) -> String {
    let nose = advice
        .heading()
        .map_or_else(String::new, |yaw| format!("nose at {:.1}°; ", YAW.unit.from_si(yaw)));
    format!("Leg {} ({}): {nose}{}.", leg.number, subject(advice), advice.judgement.sentence())
}
