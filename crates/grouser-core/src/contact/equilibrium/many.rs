//! Many wheels at once, side by side.
//!
//! All of them search together: in each round every wheel asks for F_z, or for all forces, at its
//! next sinkage, and wheels whose questions have the same form are answered as lanes of a vector.
//! The search and the formulas are those of a single wheel, and so are the bits.

#![expect(
    clippy::inline_always,
    reason = "what the kernel runs is compiled once for each instruction set"
)]

use super::interpolation::{Interpolation, Next};
use super::one::{settle_ready, settle_wheel};
use super::search::{Start, excess, sinkage_at};
use super::settled::{LoadedWheel, SettleError, Settled};
use crate::contact::batch::{FEWEST, Groups, Kind, Lanes};
use crate::contact::inputs::Contact;
use crate::contact::kernel::InstructionSet;
use crate::contact::kernel::dispatch::Work;
use crate::contact::kernel::wheels::Reactions;
use crate::contact::lanes::{Each, WIDE, each};
use crate::contact::load_sinkage::{Arc, LoadSinkage, Reaction};
use crate::contact::model::WheelSoilModel;

/// Many independent wheels under their loads [N], in their order; each has the bits that it has
/// alone.
pub fn settle_many(
    model: &dyn WheelSoilModel,
    wheels: &[(Contact, f64)],
) -> Vec<Result<Settled, SettleError>> {
    let loaded: Vec<LoadedWheel<'_>> = wheels
        .iter()
        .map(|(contact, load)| LoadedWheel { model, contact, load: *load, guess: None })
        .collect();
    settle_each(&loaded)
}

/// Many independent wheels, each with a model of its own, in their order; each has the bits that it
/// has alone.
pub fn settle_each(wheels: &[LoadedWheel<'_>]) -> Vec<Result<Settled, SettleError>> {
    if wheels.len() < FEWEST {
        return wheels.iter().map(settle_wheel).collect();
    }
    // Each is replaced by the wheel's own.
    let mut results = vec![Err(SettleError::BadLoad { load: f64::NAN }); wheels.len()];
    let mut groups = Groups::new(TOGETHER.min(wheels.len()));
    for (place, wheel) in wheels.iter().enumerate() {
        let relation = wheel.model.load_sinkage(wheel.contact);
        let kind = relation.as_ref().and_then(LoadSinkage::only_arc).map(Kind::of);
        let has_load = wheel.load.is_finite() && wheel.load > 0.0;
        let (Some(relation), Some(kind), true) = (relation, kind, has_load) else {
            results[place] = settle_wheel(wheel);
            continue;
        };
        if let Some(full) = groups.add(kind, Searching::of(place, wheel, relation)) {
            settle_together(full, &mut results);
        }
    }
    groups.rest().for_each(|mut group| settle_together(&mut group, &mut results));
    results
}

/// Wheels that search together: what a processor's nearest cache holds.
const TOGETHER: usize = 32;

/// A wheel on its way.
struct Searching<'a> {
    /// Among the results.
    place: usize,
    wheel: &'a LoadedWheel<'a>,
    relation: LoadSinkage,
    start: Start,
    search: Option<Interpolation>,
    question: Question,
}

/// What a wheel asks for, at an ln h.
#[derive(Clone, Copy)]
enum Question {
    /// F_z.
    Load(f64),
    /// All forces.
    Forces(f64),
    /// It has its result.
    Nothing,
}

impl<'a> Searching<'a> {
    fn of(place: usize, wheel: &'a LoadedWheel<'a>, relation: LoadSinkage) -> Self {
        Self {
            place,
            wheel,
            relation,
            start: Start::default(),
            search: None,
            question: Question::Nothing,
        }
    }

    fn arc(&self) -> &Arc {
        self.relation.only_arc().expect("a wheel with two is not among them")
    }

    /// Takes the excess where it was asked for, with sinkage [m] and reaction if all forces were
    /// asked for; the result, if that is one.
    fn take(
        &mut self,
        at: f64,
        excess: f64,
        reaction: Option<(f64, &Reaction)>,
    ) -> Option<Result<Settled, SettleError>> {
        let Start { axle, exponent, .. } = self.start;
        let search = match &mut self.search {
            Some(search) => {
                search.take((at, excess));
                search
            }
            None => self.search.insert(Interpolation::new(axle, exponent, (at, excess))),
        };
        self.question = match search.next() {
            Next::Try(next) => Question::Load(next),
            Next::TryLast(next) => Question::Forces(next),
            Next::Found(_) => {
                if let Some((sinkage, reaction)) = reaction {
                    self.question = Question::Nothing;
                    let (contact, evaluations) = (self.wheel.contact, search.evaluations());
                    let forces = self.relation.finished(contact, reaction, sinkage);
                    return Some(Ok(Settled::of(contact, sinkage, forces, evaluations)));
                }
                Question::Forces(at)
            }
            Next::Lost => {
                self.question = Question::Nothing;
                return Some(settle_ready(self.wheel, Some(&self.relation)).0);
            }
        };
        None
    }
}

type Results = [Result<Settled, SettleError>];

/// Leads the wheels of a group to their results, round by round, and empties it.
fn settle_together(group: &mut Vec<Searching<'_>>, results: &mut Results) {
    if group.len() < FEWEST {
        for Searching { place, wheel, relation, .. } in group.drain(..) {
            results[place] = settle_ready(wheel, Some(&relation)).0;
        }
        return;
    }
    let mut together = Together(group);
    let mut chunks = Vec::new();
    // Wheels that skid alike have as many pieces of smooth stress.
    let mut order: Vec<usize> = (0..together.0.len()).collect();
    order.sort_by(|one, other| {
        let still = |wheel: usize| together.0[wheel].arc().law.still();
        still(*one).total_cmp(&still(*other))
    });
    let mut loads = order.clone();
    let mut forces = Vec::new();
    for (number, some) in loads.chunks(WIDE).enumerate() {
        let chunk = chunk(&mut chunks, number, some, together.0);
        together.start(some, chunk);
    }
    while !(loads.is_empty() && forces.is_empty()) {
        for (asked, all) in [(&loads, false), (&forces, true)] {
            for (number, some) in asked.chunks(WIDE).enumerate() {
                let chunk = chunk(&mut chunks, number, some, together.0);
                together.answer(some, chunk, all, results);
            }
        }
        loads.clear();
        forces.clear();
        for &wheel in &order {
            match together.0[wheel].question {
                Question::Load(_) => loads.push(wheel),
                Question::Forces(_) => forces.push(wheel),
                Question::Nothing => {}
            }
        }
    }
    group.clear();
}

/// Wheels of one kind that search together.
struct Together<'s, 'a>(&'s mut [Searching<'a>]);

impl Together<'_, '_> {
    fn set(&self) -> InstructionSet {
        self.0[0].arc().set
    }

    /// Has some wheels start.
    fn start(&mut self, some: &[usize], chunk: &Chunk) {
        let guesses = chunk.each(|wheel| self.0[wheel].wheel.usable_guess());
        let starts = self.set().run(Starting { chunk, guesses: &guesses });
        for (&wheel, start) in some.iter().zip(starts) {
            let search = &mut self.0[wheel];
            (search.start, search.question) = (start, Question::Load(start.at));
        }
    }

    /// Answers some wheels.
    fn answer(&mut self, some: &[usize], chunk: &Chunk, all: bool, results: &mut Results) {
        let at = chunk.each(|wheel| match self.0[wheel].question {
            Question::Load(at) | Question::Forces(at) => at,
            Question::Nothing => f64::NAN,
        });
        let mut answered = Answered::default();
        self.set().run(Asking { chunk, at: &at, all, answered: &mut answered });
        for (lane, &wheel) in some.iter().enumerate() {
            let search = &mut self.0[wheel];
            let reaction = all.then(|| answered.reactions.of(lane));
            let reaction = reaction.as_ref().map(|it| (answered.sinkages[lane], it));
            if let Some(result) = search.take(at[lane], answered.excesses[lane], reaction) {
                results[search.place] = result;
            }
        }
    }
}

/// Some wheels of a group in lanes; the last stands in where there is none.
struct Chunk {
    /// Their places in the group.
    wheels: Vec<usize>,
    lanes: Lanes,
    /// [N]
    loads: Each,
}

/// The chunk of a number, which mostly has the same wheels as in the round before.
fn chunk<'c>(
    chunks: &'c mut Vec<Chunk>,
    number: usize,
    wheels: &[usize],
    searches: &[Searching<'_>],
) -> &'c Chunk {
    if chunks.get(number).is_none_or(|known| known.wheels != wheels) {
        let chunk = Chunk::of(wheels, searches);
        match chunks.get_mut(number) {
            Some(known) => *known = chunk,
            None => chunks.push(chunk),
        }
    }
    &chunks[number]
}

impl Chunk {
    fn of(wheels: &[usize], searches: &[Searching<'_>]) -> Self {
        let of = |lane: usize| &searches[wheels[lane.min(wheels.len() - 1)]];
        Self {
            wheels: wheels.to_vec(),
            lanes: Lanes::of(|lane| (of(lane).wheel.contact, &of(lane).relation, of(lane).arc())),
            loads: each(|lane| of(lane).wheel.load),
        }
    }

    /// A number of each wheel.
    fn each(&self, number: impl Fn(usize) -> f64) -> Each {
        let last = self.wheels.len() - 1;
        each(|lane| number(self.wheels[lane.min(last)]))
    }
}

/// Wheels that start.
struct Starting<'a> {
    chunk: &'a Chunk,
    /// [m], or NaN.
    guesses: &'a Each,
}

impl Work for Starting<'_> {
    type Output = [Start; WIDE];

    #[inline(always)]
    fn run(self) -> [Start; WIDE] {
        let Chunk { lanes: Lanes { laws, areas, .. }, loads, .. } = self.chunk;
        let mut starts = [Start::default(); WIDE];
        for wheel in 0..WIDE {
            let (factor, power) = laws.law(wheel).shallow();
            let shallow = (areas[wheel] * factor, power);
            let guess = self.guesses[wheel];
            starts[wheel] = Start::near(guess, shallow, loads[wheel], laws.radius[wheel]);
        }
        starts
    }
}

/// Wheels that ask for F_z, or for all forces, each at its ln h.
struct Asking<'a> {
    chunk: &'a Chunk,
    at: &'a Each,
    all: bool,
    answered: &'a mut Answered,
}

/// What they get: sinkages [m], excesses, and what the kernel computes if all forces were asked
/// for.
#[derive(Default)]
struct Answered {
    sinkages: Each,
    excesses: Each,
    reactions: Reactions,
}

impl Work for Asking<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { chunk: Chunk { lanes, loads, .. }, at, all, answered } = self;
        let Answered { sinkages, excesses, reactions } = answered;
        for wheel in 0..WIDE {
            sinkages[wheel] = sinkage_at(at[wheel], lanes.laws.radius[wheel]);
        }
        let up = lanes.reactions(sinkages, if all { Some(reactions) } else { None });
        for wheel in 0..WIDE {
            excesses[wheel] = excess(lanes.areas[wheel] * up[wheel], loads[wheel]);
        }
    }
}
