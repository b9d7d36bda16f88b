//! The sentences of the card.

use grouser::contact::Theory;
use grouser::contact::validity::Flag;
use grouser::document::columns::SLOPE;
use grouser::studies::card::{Card, CardRow, Rule};
use grouser::studies::ensemble::samples::BandInputs;

use crate::args::{CardArgs, SideChoice};
use crate::inputs::CardInputs;
use crate::output::rows::{four_digits, rounded_down};

/// All texts of a card that depend on its inputs.
pub(super) struct Texts {
    pub(super) title: String,
    /// On which side uphill can be.
    pub(super) side: &'static str,
    /// The conditions of the numbers: day, gravity, speed.
    pub(super) setting: String,
    /// Heads the column of headings' bands, with the share of samples in them.
    pub(super) band: String,
    pub(super) has_bands: bool,
    /// Each verdict with its rule.
    pub(super) rule: Vec<(&'static str, String)>,
    /// Facts in the margin, each by its name.
    pub(super) facts: Vec<(&'static str, String)>,
    pub(super) holds_for: String,
    pub(super) leaves_out: String,
    pub(super) assumed: Vec<String>,
}

pub(super) fn of(args: &CardArgs, inputs: &CardInputs, card: &Card) -> Texts {
    let document = &inputs.scenario.document;
    let rover = document.text("rover.name").unwrap_or("unnamed rover");
    let soil = document.text("soil.name").unwrap_or("unnamed soil");
    let is_symmetric = inputs.scenario.value.rover.is_symmetric();
    let side = match (is_symmetric, args.uphill) {
        (true, _) => "Uphill on the left or on the right: the same heading.",
        (false, SideChoice::Left) => "ONLY with uphill on the rover's LEFT.",
        (false, SideChoice::Right) => "ONLY with uphill on the rover's RIGHT.",
    };
    let has_bands = card.draws.is_some();
    Texts {
        title: format!("{rover} on {soil}"),
        side,
        setting: setting(inputs),
        band: if has_bands { "95 % of samples" } else { "no band" }.to_owned(),
        has_bands,
        rule: rule(inputs, card.draws),
        facts: facts(args, inputs, card),
        holds_for: "steady straight driving along the contour of an even slope of one soil, with all \
                    wheels turning alike. Nothing holds the heading by itself: correct it on the way."
            .to_owned(),
        leaves_out: "rocks, ripples, layers, slopes that change, starts, stops and turns; what \
                     no model of the bands knows comes on top: a real rover scatters by more."
            .to_owned(),
        assumed: extrapolations(card).into_iter().chain(assumed(inputs)).collect(),
    }
}

/// Which flags the contour traverses carry, and from which slope on.
fn extrapolations(card: &Card) -> Vec<String> {
    let held = || card.rows.iter().filter(|row| row.level.is_some());
    let carries = |row: &CardRow, flag| row.findings.iter().any(|it| it.flag == flag);
    let line = |flag: Flag| {
        let first = held().find(|row| carries(row, flag))?;
        let slope = four_digits(SLOPE.unit.from_si(first.slope));
        Some(format!("OUTSIDE ITS DOMAIN from {slope}° ({}): {}", flag.name(), flag.rule().meaning))
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
    inputs.scenario.assumptions.iter().map(short).collect()
}

fn rule(inputs: &CardInputs, draws: Option<usize>) -> Vec<(&'static str, String)> {
    let rule: &Rule = &inputs.rule;
    let percent = |share: f64| four_digits(share * 100.0);
    let (go_slip, stop_slip) = (percent(rule.go_slip_ratio), percent(rule.no_go_slip_ratio));
    let (go, stop) = (percent(rule.go_probability), percent(rule.no_go_probability));
    let between = "all between: not without a second look, and with slip measured on the way.";
    let last = "A steeper slope never gets a better verdict.";
    let margin = four_digits(SLOPE.unit.from_si(rule.margin));
    let has_margin = inputs.scenario.uncertain.is_none();
    let where_to =
        if has_margin { format!(" of a slope {margin}° steeper") } else { String::new() };
    let (go, no_go) = match draws {
        None => (
            format!("a heading still holds the contour{where_to}, with slip up to {go_slip} %."),
            format!("no heading holds the contour{where_to} with slip up to {stop_slip} %. {last}"),
        ),
        Some(draws) => (
            format!(
                "in at least {go} % of {draws} samples a heading holds the contour{where_to}, with slip up to {go_slip} %."
            ),
            format!(
                "in less than {stop} % of them it does so with slip up to {stop_slip} %. {last}"
            ),
        ),
    };
    vec![("GO", go), ("CAUTION", between.to_owned()), ("NO-GO", no_go)]
}

/// How well the soil is known, and what the bands are over.
fn known(args: &CardArgs, inputs: &CardInputs, card: &Card) -> String {
    let is_stated = inputs.scenario.uncertain.is_some();
    match (card.draws, is_stated) {
        (Some(draws), true) => {
            format!("as its document states; {draws} samples, seed {}", args.seed)
        }
        (Some(draws), false) => format!(
            "NOT STATED: bands are of the models alone; {draws} samples, seed {}. The margin above \
             stands in for the soil's.",
            args.seed
        ),
        (None, _) => "NOT STATED: no bands. The margin above stands in for it.".to_owned(),
    }
}

/// The model of the soil as written, and those of the samples.
fn model(inputs: &CardInputs) -> String {
    let nominal = inputs.scenario.value.theory.name();
    let band = BandInputs::of_scenario(&inputs.scenario);
    let share = |(theory, share): &(Theory, f64)| {
        format!("{} {} %", theory.name(), four_digits(share * 100.0))
    };
    match band.models().shares() {
        [_] => nominal.to_owned(),
        all => {
            let shares: Vec<String> = all.iter().map(share).collect();
            format!("{nominal}; of the samples {}", shares.join(", "))
        }
    }
}

fn facts(args: &CardArgs, inputs: &CardInputs, card: &Card) -> Vec<(&'static str, String)> {
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
        (
            "Model",
            format!(
                "{}; load transfer {}; wheel moments {}",
                model(inputs),
                document.text("loads").unwrap_or("unknown"),
                document.text("moments").unwrap_or("unknown")
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

fn setting(inputs: &CardInputs) -> String {
    let document = &inputs.scenario.document;
    let date = document.text("soil.date");
    let gravity = inputs.scenario.value.site.gravity;
    let named = grouser::document::GRAVITIES.iter().find(|(_, value)| *value == gravity);
    let place = named.map_or(String::new(), |(name, _)| format!(" ({name})"));
    format!(
        "Date of the soil: {}.  Gravity {} m/s²{place}.  Rims at {} cm/s.",
        date.unwrap_or("not stated"),
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
