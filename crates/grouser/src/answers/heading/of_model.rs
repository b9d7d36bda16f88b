//! What a wheel–soil model answers about headings.

use super::super::{AnswerError, AnswerOptions};
use super::bands::Bands;
use super::question::HeadingQuestion;
use crate::document::LoadedScenario;
use crate::document::columns::gradient;
use crate::document::columns::heading::{self, LIMIT_REASON, LIMITED_BY};
use crate::document::columns::wheel_speeds::{self, NONE_FOUND, WHEELS};
use crate::document::columns::{ENERGY_PER_METRE, LIMIT_SLOPE, SLOPE};
use crate::document::gradient::HeadingKeys;
use crate::document::reading::rounded_down;
use crate::document::table::Table;
use crate::studies::heading::{HeadingCurve, HeadingStudy, LimitedBy};
use crate::studies::wheel_speeds::{WheelSpeedStudy, WheelSpeeds};

/// What a model answers.
pub(super) struct OfModel<'q> {
    pub(super) scenario: &'q LoadedScenario,
    pub(super) curve: HeadingCurve,
    pub(super) bands: Option<Bands>,
    /// With wheels at speeds of their own: the steepest slopes, a row for each freedom.
    pub(super) own_speeds: Option<Table>,
    /// The numbers that results are differentiated by.
    pub(super) keys: Option<HeadingKeys>,
    /// A row for each slope.
    pub(super) table: Table,
    /// The steepest slope: one row.
    pub(super) limit: Table,
}

impl<'q> OfModel<'q> {
    /// Follows the curve of a scenario, and computes what else is asked for.
    pub(super) fn of(
        question: &HeadingQuestion,
        scenario: &'q LoadedScenario,
        options: &AnswerOptions<'_>,
    ) -> Result<Self, AnswerError> {
        let slope_study = question.study(scenario);
        let study = slope_study.heading.clone();
        let curve = HeadingStudy { steering: question.steering, ..study.clone() }.curve()?;
        let bands = question.sampling.map(|sampling| {
            Bands::of(sampling, scenario, (&slope_study, &curve), &question.slopes(), options)
        });
        let bands = bands.transpose()?;
        let slopes = question.slopes();
        let mut table = heading::table(&curve, &scenario.value.rover, &slopes);
        if options.is_strict {
            let flags = heading::findings(&curve, &slopes);
            options.check(flags.iter().map(|it| &**it), &table, &[SLOPE.name])?;
        }
        let mut limit = heading::steepest(&curve);
        let keys = question.gradients.as_ref();
        let keys = keys.map(|it| HeadingKeys::of(scenario, question.steering, it)).transpose()?;
        if let Some(keys) = &keys {
            let on_slope = |slope: &f64| {
                let go_on = (options.go_on)();
                go_on.then(|| keys.on_slope(&curve, *slope)).ok_or(AnswerError::Stopped)
            };
            let rows = slopes.iter().map(on_slope).collect::<Result<Vec<_>, _>>()?;
            table = gradient::of_headings(table, keys, &rows);
            limit = gradient::of_limit(limit, keys, &keys.of_limit(&curve));
        }
        let own_speeds = question.most_speed_ratio.map(|most_ratio| {
            WheelSpeeds::from(WheelSpeedStudy { heading: study, most_ratio }, curve.clone())
        });
        let own_speeds = own_speeds.transpose()?;
        if let Some(own) = &own_speeds {
            table = wheel_speeds::table(own, &slopes);
        }
        let own_speeds = own_speeds.map(|own| wheel_speeds::limits(&own));
        if let Some(bands) = &bands {
            table = heading::advised(table, &bands.advice, &bands.asked, &bands.of_models);
            limit.columns.extend(bands.limit.columns.clone());
        }
        Ok(Self { scenario, curve, bands, own_speeds, keys, table, limit })
    }

    pub(super) fn name(&self) -> &'static str {
        self.scenario.value.model.name()
    }

    /// The results at the points of the curve, which crowd where it bends.
    pub(super) fn dense(&self) -> Table {
        let slopes: Vec<f64> = self.curve.headings().into_iter().map(|it| it.slope).collect();
        heading::table(&self.curve, &self.scenario.value.rover, &slopes)
    }

    /// What is said about derivatives, of the rows and of the steepest slope.
    pub(super) fn gradient_lines(&self) -> String {
        let Some(keys) = &self.keys else { return String::new() };
        let names: Vec<&str> = keys.names().collect();
        let lacking: Vec<&str> = keys.lacking().collect();
        let of_rows = super::super::gradient::lines(&self.table, &names, &lacking);
        let of_limit = super::super::gradient::lines(&self.limit, &names, &lacking);
        let new = of_limit.lines().filter(|line| line.starts_with("no derivative"));
        let new = new.filter(|line| !of_rows.contains(line));
        of_rows.clone() + &new.map(|line| format!("steepest slope: {line}\n")).collect::<String>()
    }

    /// What is said about its steepest slope.
    ///
    /// * `is_named`: whether each line begins with the model's name
    pub(super) fn lines(&self, is_named: bool) -> String {
        let name = if is_named { format!("{}: ", self.name()) } else { String::new() };
        let advice = self.bands.as_ref().map(Bands::advice_lines).unwrap_or_default();
        let band = self.bands.as_ref().map(|bands| format!("{name}{}", bands.limit_line()));
        let own = self.own_speeds.as_ref().map(|limits| own_lines(&name, limits));
        let limit = limit_line(&self.limit);
        let limit = if self.bands.is_some() { format!("as written, {limit}") } else { limit };
        let (band, own) = (band.unwrap_or_default(), own.unwrap_or_default());
        let named = |line: &str| format!("{name}{line}\n");
        advice.lines().map(named).collect::<String>() + &format!("{name}{limit}{band}{own}")
    }
}

fn limit_line(limit: &Table) -> String {
    let slope = limit.numbers(LIMIT_SLOPE.name)[0];
    let reason = limit.texts(LIMIT_REASON)[0].as_deref().unwrap_or_default();
    match slope {
        Some(slope) => {
            let slope = rounded_down(slope);
            format!("steepest slope on which a heading holds the contour: {slope}°, {reason}\n")
        }
        None if limit.texts(LIMITED_BY)[0].as_deref() == Some(LimitedBy::NotFound.name()) => {
            format!("{reason}\n")
        }
        None => format!("no heading holds the contour on any slope: {reason}\n"),
    }
}

/// What wheels at speeds of their own hold at the most.
fn own_lines(name: &str, limits: &Table) -> String {
    let rows = limits.texts(WHEELS).iter().zip(limits.numbers(LIMIT_SLOPE.name));
    let energies = limits.numbers(ENERGY_PER_METRE.name);
    let lines = rows.zip(energies).skip(1).map(|((wheels, slope), energy)| {
        let wheels = wheels.as_deref().unwrap_or_default();
        match (slope, energy) {
            (Some(slope), Some(energy)) => {
                let slope = rounded_down(*slope);
                format!("{name}with wheels {wheels}: {slope}°, with {energy:.1} J/m\n")
            }
            _ => format!("{name}with wheels {wheels}: {NONE_FOUND}\n"),
        }
    });
    lines.collect()
}
