//! The sentences of the card.

use grouser::contact::Model;
use grouser::contact::validity::Flag;
use grouser::document::columns::{LIMIT_SLOPE, SLOPE, card, gradient};
use grouser::document::learn::contradictions_of_soil;
use grouser::document::reading::{four_digits, rounded_down};
use grouser::document::table::Table;
use grouser::soil::SlopeStability;
use grouser::studies::card::{Card, CardRow};
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::verdict::{
    BELOW_FRICTION_ANGLE, HEADING_ERROR, MOST_CHECKED_SLIP, Rule, SHORTEST_LEG, SLIDES_ON_NO_GO,
    STUCK_ON_GO, Verdict,
};

use super::row::upwards;
use crate::args::{CardArgs, SideChoice};
use crate::inputs::CardInputs;

/// All texts of a card that depend on its inputs.
pub(super) struct Texts {
    pub(super) title: String,
    /// What to do, step by step, and on which side uphill can be.
    pub(super) steps: Vec<String>,
    /// The day of the soil, or that nobody states it.
    pub(super) date: Date,
    /// The other conditions of the numbers: gravity, speed.
    pub(super) setting: String,
    pub(super) has_bands: bool,
    /// What the columns are, each by its name.
    pub(super) legend: Vec<(&'static str, String)>,
    /// Each verdict with its rule.
    pub(super) rule: Vec<(&'static str, String)>,
    /// Facts in the margin, each by its name.
    pub(super) facts: Vec<(&'static str, String)>,
    pub(super) holds_for: String,
    pub(super) leaves_out: String,
    /// What is an extrapolation, and from which slope on.
    pub(super) outside: Vec<String>,
    pub(super) assumed: Vec<String>,
}

/// When the soil was looked at.
pub(super) enum Date {
    Stated(String),
    NotStated,
}

/// * `steepest`: the row of the steepest slope, with what numbers are worth
pub(super) fn of(args: &CardArgs, inputs: &CardInputs, card: &Card, steepest: &Table) -> Texts {
    let document = &inputs.scenario.document;
    let rover = document.text("rover.name").unwrap_or("unnamed rover");
    let soil = document.text("soil.name").unwrap_or("unnamed soil");
    Texts {
        title: format!("{rover} on {soil}"),
        steps: steps(args, inputs),
        date: document
            .text("soil.date")
            .map_or(Date::NotStated, |date| Date::Stated(date.to_owned())),
        setting: setting(inputs),
        has_bands: card.draws.is_some(),
        legend: legend(card.draws, args.holds_heading),
        rule: rule(args, inputs, card),
        facts: facts(args, inputs, card, steepest),
        holds_for: holds_for(args.holds_heading),
        leaves_out: "rocks, ripples, layers, slopes that change, starts, stops and turns; what \
                     no model of the bands knows comes on top: a real rover scatters by more."
            .to_owned(),
        outside: extrapolations(card),
        assumed: assumed(inputs),
    }
}

fn holds_for(holds_heading: bool) -> String {
    let heading = if holds_heading {
        "a heading that the rover holds by itself"
    } else {
        "the nose set again as the card says"
    };
    format!(
        "steady driving along the contour of an even slope of one soil, with all wheels turning \
         alike and {heading}. To be made anew: once a reading is above its limit on two legs in a \
         row, or rover, load or ground are others than on the day of the soil."
    )
}

fn steps(args: &CardArgs, inputs: &CardInputs) -> Vec<String> {
    let is_symmetric = inputs.scenario.value.rover.is_symmetric();
    let side = match (is_symmetric, args.uphill) {
        (true, _) => "Uphill on the left or on the right: the same numbers.",
        (false, SideChoice::Left) => "ONLY with uphill on the rover's LEFT.",
        (false, SideChoice::Right) => "ONLY with uphill on the rover's RIGHT.",
    };
    [
        "1  Find the slope on the left; between two rows take the steeper one.",
        "2  Turn the nose uphill by the large number (page 2: how); check roll and pitch.",
        if args.holds_heading {
            "3  Drive on. The rover holds the heading by itself."
        } else {
            "3  Drive on. The nose falls: correct, set it again every so many metres."
        },
        "4  Stop if a reading is above the limit in the row.",
        side,
    ]
    .map(String::from)
    .into()
}

/// An angle, for reading.
pub(super) fn degrees(angle: f64) -> String {
    format!("{}°", four_digits(SLOPE.unit.from_si(angle)))
}

/// A share, for reading.
pub(super) fn percent(share: f64) -> String {
    format!("{} %", four_digits(share * 100.0))
}

/// What the columns are.
fn legend(draws: Option<usize>, holds_heading: bool) -> Vec<(&'static str, String)> {
    let roll = format!(
        "with the nose set, uphill side and nose higher: roll reads the slope itself. Pitch above its range: the nose is too far uphill by more than {error}; \
         below: too far down. Where the range begins with 0 pitch cannot tell.",
        error = degrees(HEADING_ERROR)
    );
    let every = format!(
        "way in which the nose falls by {} or less{}; set it to within {} of the large number.",
        degrees(HEADING_ERROR),
        if draws.is_some() { " in 97.5 % of the samples" } else { "" },
        degrees(HEADING_ERROR)
    );
    let every = if holds_heading {
        format!(
            "by itself: the rover holds its heading; set it once, to within {} of the large number.",
            degrees(HEADING_ERROR)
        )
    } else {
        every
    };
    let readings = "Slip: mean of the wheels, in per cent of the rims' way; drift: downhill, over 10 \
                    m; sinkage: mean; torque: of the wheel that has most; both where it moves.";
    let others = format!(
        "wheel way: metres of rim for a metre of ground{}. Tips over: how much steeper the slope \
         could be before the rover at rest tips.",
        if draws.is_some() { ", median" } else { "" }
    );
    let Some(draws) = draws else {
        return vec![
            ("Nose", "heading that holds the contour on the soil as written; no band.".to_owned()),
            ("Roll, pitch", roll.clone()),
            ("Correct", every),
            ("Expected", readings.to_owned()),
            ("Beside", others),
        ];
    };
    let nose = format!(
        "median of all {draws} samples of soil and model; 95 % of them need a heading in the range \
         beside it. 'None': in more than 2.5 % of them no heading holds the contour."
    );
    vec![
        ("Nose", nose),
        ("Roll, pitch", roll),
        ("Correct", every),
        (
            "Stop if above",
            format!(
                "97.5 % of the samples stay below, of the slip each by its own heading, {most} at \
             most. {readings} '–': in more \
             than 2.5 % of the samples the rover is stuck.",
                most = percent(MOST_CHECKED_SLIP)
            ),
        ),
        ("Beside", others),
    ]
}

/// Which flags the contour traverses carry, and from which slope on.
fn extrapolations(card: &Card) -> Vec<String> {
    let held = || card.rows.iter().filter(|row| row.level.is_some());
    let carries = |row: &CardRow, flag| row.findings.iter().any(|it| it.flag == flag);
    let line = |flag: Flag| {
        let first = held().find(|row| carries(row, flag))?;
        let slope = four_digits(SLOPE.unit.from_si(first.advice.slope));
        Some(format!("from {slope}° ({}): {}", flag.name(), flag.rule().meaning))
    };
    Flag::ALL.into_iter().filter_map(line).collect()
}

/// The documents' assumptions without the names of soil and rover, which stand above.
fn assumed(inputs: &CardInputs) -> Vec<String> {
    let document = &inputs.scenario.document;
    let named = |kind: &str, path: &str| Some(format!("{kind} {}: ", document.text(path)?));
    let names = [
        named("soil", "soil.name").map(|name| (name, "")),
        named("rover", "rover.name").map(|name| (name, "")),
        named("wheel", "rover.wheel_unit.wheel.name").map(|name| (name, "wheel: ")),
    ];
    let short = |assumption: &String| {
        let named = names.iter().flatten().find(|(name, _)| assumption.starts_with(name));
        named.map_or(assumption.clone(), |(name, kind)| {
            format!("{kind}{}", &assumption[name.len()..])
        })
    };
    let contradictions = contradictions_of_soil(document);
    contradictions.into_iter().chain(inputs.scenario.assumptions.iter().map(short)).collect()
}

fn rule(args: &CardArgs, inputs: &CardInputs, card: &Card) -> Vec<(&'static str, String)> {
    let rule: &Rule = &inputs.rule;
    let (go_slip, stop_slip) = (percent(rule.go_slip_ratio), percent(rule.no_go_slip_ratio));
    let (share, least) = (percent(rule.go_probability), percent(rule.no_go_probability));
    let drift = four_digits(100.0 * rule.go_drift_m_per_m);
    let (held, not_held) = match card.draws {
        None => (
            format!("a heading holds the contour with slip up to {go_slip}"),
            format!("no heading holds the contour with slip up to {stop_slip}"),
        ),
        Some(draws) => (
            format!(
                "in at least {share} of {draws} samples a heading holds the contour with slip up \
                 to {go_slip}; at most {} get stuck by the card's heading; 97.5 % drift by at most \
                 {drift} cm/m",
                percent(STUCK_ON_GO)
            ),
            format!(
                "in {least} of them or more no heading does so with slip up to {stop_slip}, or the \
                 rover gets stuck; or {} slide",
                percent(SLIDES_ON_NO_GO)
            ),
        ),
    };
    let value = &inputs.scenario.value;
    let below = degrees(BELOW_FRICTION_ANGLE);
    let friction = degrees(value.ground.soil.friction_angle);
    let usual = four_digits(SlopeStability::USUAL.factor_of_safety);
    let go = format!("{held}; the slope stands with a factor of safety of {usual}.");
    let between = "not without a second look, and with slip measured on the way.";
    let open = "the soil's document states no uncertainty, most of the samples are outside a \
                domain, or the search for a heading gave up.";
    // A nose that is held falls nowhere.
    let end = if args.holds_heading {
        "the ground slides, or the rover tips over.".to_owned()
    } else {
        let (fall, way) = (degrees(HEADING_ERROR), four_digits(SHORTEST_LEG));
        format!(
            "the ground slides, the rover tips over, or the nose falls by {fall} within {way} m."
        )
    };
    let no_go = format!(
        "{not_held}; the slope is within {below} of the friction angle of {friction}, {end}"
    );
    let here = |verdict: Verdict, text: String| match first_of(card, verdict) {
        Some(first) => format!("{text} Here {first}."),
        None => text,
    };
    let mut all = vec![("GO", go), ("CAUTION", here(Verdict::Caution, between.to_owned()))];
    if first_of(card, Verdict::CannotTell).is_some() {
        all.push(("CANNOT TELL", here(Verdict::CannotTell, open.to_owned())));
    }
    all.push(("NO-GO", here(Verdict::NoGo, no_go)));
    all
}

/// From which slope on a card has a verdict, and why.
fn first_of(card: &Card, verdict: Verdict) -> Option<String> {
    let first =
        card.rows.iter().map(|row| &row.advice).find(|it| it.judgement.verdict == verdict)?;
    let slope = four_digits(SLOPE.unit.from_si(first.slope));
    Some(format!("from {slope}°: {}", first.judgement.meaning()))
}

/// How well the soil is known, and what the bands are over.
fn known(args: &CardArgs, inputs: &CardInputs, card: &Card) -> String {
    let is_stated = inputs.scenario.stated_uncertainty().is_some();
    match (card.draws, is_stated) {
        (Some(draws), true) => {
            format!("as its document states; {draws} samples, seed {}", args.seed)
        }
        (Some(draws), false) => {
            let over = if inputs.scenario.uncertain.is_some() {
                "priors of what it leaves out, and the models"
            } else {
                "the models alone"
            };
            format!("NOT STATED: bands are of {over}; {draws} samples, seed {}", args.seed)
        }
        (None, _) => "NOT STATED: no bands".to_owned(),
    }
}

/// The model of the soil as written, and those of the samples.
fn model(inputs: &CardInputs) -> String {
    let nominal = inputs.scenario.value.model.name();
    let band = BandInputs::of_scenario(&inputs.scenario);
    let share = |(model, share): &(Model, f64)| format!("{} {:.0} %", model.name(), share * 100.0);
    match band.models().shares() {
        [_] => nominal.to_owned(),
        all => {
            let shares: Vec<String> = all.iter().map(share).collect();
            format!("{nominal}; of the samples {}", shares.join(", "))
        }
    }
}

fn facts(
    args: &CardArgs,
    inputs: &CardInputs,
    card: &Card,
    steepest: &Table,
) -> Vec<(&'static str, String)> {
    let scenario = &inputs.scenario;
    let (document, value) = (&scenario.document, &scenario.value);
    let source = document.text("soil.source").unwrap_or("not stated");
    vec![
        ("Soil", source.to_owned()),
        ("Uncertainty", known(args, inputs, card)),
        (
            "Rover",
            format!("{} wheels, {} kg", value.rover.wheel_count(), four_digits(value.rover.mass())),
        ),
        ("Steepest slope", limit(card)),
        ("Worth of it", worth(steepest)),
        ("Power", power(card)),
        ("Models say", other_models(inputs, card)),
        (
            "Model",
            format!(
                "{}; load transfer {}; wheel moments {}",
                model(inputs),
                document.text("load_transfer").unwrap_or("unknown"),
                document.text("wheel_moments").unwrap_or("unknown")
            ),
        ),
        (
            "Made by",
            format!(
                "grouser {}; documents {:016x}",
                env!("CARGO_PKG_VERSION"),
                scenario.fingerprint()
            ),
        ),
    ]
}

/// Rows that may be driven.
fn driven(card: &Card) -> impl Iterator<Item = &CardRow> {
    card.rows.iter().take_while(|row| row.advice.judgement.verdict != Verdict::NoGo)
}

/// The most power that rows of the page take.
fn power(card: &Card) -> String {
    let of = |row: &CardRow| match row.bands {
        Some(bands) => bands.power.map(|band| band.high),
        None => row.level.map(|level| level.power),
    };
    let most = driven(card).filter_map(of).fold(0.0, f64::max);
    if most == 0.0 {
        return "none: no slope is to be driven".to_owned();
    }
    let most = upwards(most, 2);
    format!("mechanical, of all wheels: up to {most} W; what motors and electronics draw is more")
}

/// What numbers are worth, in the steepest slope.
fn worth(steepest: &Table) -> String {
    // Changes that a laboratory would call different soils, or a rover a different load.
    const CHANGES: [(f64, &str); 3] =
        [(1.0, "1° of friction angle"), (0.1, "0.1 kPa of cohesion"), (1.0, "1 kg of body")];
    let one = |(key, (change, words)): (&str, (f64, &str))| {
        let name = gradient::name(LIMIT_SLOPE.name, key);
        let slope = change * (*steepest.numbers(&name).first()?)?;
        let slope = (slope * 100.0).round() / 100.0;
        Some(format!("{words} is worth {}°", four_digits(slope)).replace('-', "−"))
    };
    let all: Vec<String> = card::WORTH.into_iter().zip(CHANGES).filter_map(one).collect();
    if all.is_empty() {
        return "not known: what ends it has no slope".to_owned();
    }
    format!("{}; for the soil as written, nominally", all.join(", "))
}

/// The headings of the models on the soil as written, on the steepest slope that is driven.
fn other_models(inputs: &CardInputs, card: &Card) -> String {
    let Some(row) = driven(card).filter(|row| row.level.is_some()).last() else {
        return "no heading".to_owned();
    };
    let degrees = |yaw: f64| four_digits((SLOPE.unit.from_si(yaw) * 2.0).round() / 2.0);
    let own = (inputs.scenario.value.model.clone(), row.level.map(|level| level.yaw));
    let say = |(model, yaw): &(Model, Option<f64>)| match yaw {
        Some(yaw) => format!("{} {}°", model.name(), degrees(*yaw)),
        None => format!("{} none", model.name()),
    };
    let all: Vec<String> = std::iter::once(&own).chain(&row.other_models).map(say).collect();
    let slope = four_digits(SLOPE.unit.from_si(row.advice.slope));
    format!("on {slope}°, for the soil as written: nose uphill by {}", all.join(", "))
}

fn setting(inputs: &CardInputs) -> String {
    let gravity = inputs.scenario.value.gravity;
    let named = grouser::document::GRAVITIES.iter().find(|(_, value)| *value == gravity);
    let place = named.map_or(String::new(), |(name, _)| format!(" ({name})"));
    format!(
        "Gravity {} m/s²{place}.  Rims at {} cm/s.",
        four_digits(gravity),
        four_digits(inputs.rim_speed * 100.0)
    )
}

fn limit(card: &Card) -> String {
    let shown = |slope: f64| rounded_down(SLOPE.unit.from_si(slope));
    let nominal = match &card.limit {
        Ok((slope, _)) => format!("{}°", shown(*slope)),
        Err(_) => "none".to_owned(),
    };
    match card.limit_band {
        Some(band) => format!(
            "{nominal} (95 %: {} to {}°), not a limit to drive by",
            shown(band.low),
            shown(band.high)
        ),
        None => format!("{nominal}, not a limit to drive by"),
    }
}
