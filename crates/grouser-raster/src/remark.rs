//! What is odd about heights that can be driven on.

use std::fmt;

use grouser_core::units::Vec2;

/// Something odd about heights, which does not keep a rover from driving on them.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Remark {
    /// The map is larger or smaller than the ground.
    Scale {
        /// Metres on the map of a metre on the ground at the map's middle, in the direction where it
        /// is least and where it is most [-].
        factors: [f64; 2],
        /// The least and the greatest over the map [-].
        over_map: [f64; 2],
    },
    /// Nothing says how large the ground is on the map.
    UnknownScale {
        /// What the file calls its system.
        system: String,
    },
    /// Cells far below or above all others.
    Void {
        /// How many.
        cells: usize,
        /// Their height [m].
        height: f64,
        /// How far they are from the next one [m].
        gap: f64,
    },
    /// Heights that are whole multiples of a step, which smooth ground goes up and down by.
    Steps {
        /// The step [m].
        step: f64,
        /// The slope that one makes between neighbours [rad].
        slope: f64,
    },
    /// Single cells that stand out of their neighbours as no ground does.
    Spikes {
        /// How many.
        cells: usize,
        /// How far the worst is above, or below if negative, the nearest of its neighbours [m].
        height: f64,
        /// Where that is.
        at: Vec2,
    },
    /// Places that may be of another system than the map's.
    SystemNotCompared {
        /// The system that their file names; nothing if it names none.
        places: Option<String>,
        /// What the map calls its system.
        map: String,
    },
    /// Columns of a text that no one asked for.
    UnusedColumns {
        /// Their names; for text without names their numbers, from 1.
        columns: Vec<String>,
    },
    /// A column of a text that is taken for the heights, whatever its name.
    TakenForHeight {
        /// Its name.
        column: String,
    },
}

impl Remark {
    /// The remark in a sentence.
    ///
    /// * `missing`: how whoever reads the file again declares a height [m] that is a missing one
    #[must_use]
    pub fn in_words(&self, missing: impl Fn(f64) -> String) -> String {
        let Self::Void { cells, height, gap } = self else { return self.to_string() };
        let side = if *gap < 0.0 { "below" } else { "above" };
        let (count, stand) = if *cells == 1 { ("cell", "is") } else { ("cells", "are") };
        let declared = missing(*height);
        format!(
            "{cells} {count} of {height} m {stand} {:.0} m {side} all others: missing heights? \
             {declared} takes them as such",
            gap.abs()
        )
    }
}

/// Metres on the map of a metre on the ground, in words.
pub(crate) fn scale(factors: [f64; 2]) -> String {
    let [least, most] = factors.map(|factor| format!("{factor:.3}"));
    if least == most {
        format!("{least} m")
    } else {
        format!("{least} to {most} m, by the direction,")
    }
}

/// A difference of scales that is told [-]: slopes of 20° are wrong by a tenth of a degree.
pub(crate) const TOLD: f64 = 0.005;

/// What a scale is in other places of the map, where that is something else.
fn elsewhere(factors: [f64; 2], over_map: [f64; 2]) -> String {
    let is_like = (0..2).all(|end| (factors[end] - over_map[end]).abs() < TOLD);
    let [least, most] = over_map;
    if is_like { String::new() } else { format!(", and {least:.3} to {most:.3} m over all of it") }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scale { factors, over_map } => write!(
                f,
                "a metre of the ground has {} on the map at its middle{}: slopes and ways are wrong \
                 by as much",
                scale(*factors),
                elsewhere(*factors, *over_map)
            ),
            Self::UnknownScale { system } => write!(
                f,
                "the scale of the map's projection was not looked at: nothing is known of {system}"
            ),
            Self::Void { .. } => {
                f.write_str(&self.in_words(|height| format!("`missing_m` = {height}")))
            }
            Self::SystemNotCompared { places, map } => write!(
                f,
                "whether its places are in the map's system was not looked at: it names {}, and the \
                 map {map}",
                places.as_deref().unwrap_or("none")
            ),
            Self::Steps { step, slope } => write!(
                f,
                "heights go up and down in steps of {} m, and one between neighbours makes {:.0}°: \
                 smooth the map, or take one with finer heights",
                short(*step),
                slope.to_degrees()
            ),
            Self::Spikes { cells: count, height, at } => write!(
                f,
                "{count} {} {} out of all neighbours more steeply than ground does, the farthest by \
                 {} m at x {} m, y {} m: spikes and pits of the data?",
                if *count == 1 { "cell" } else { "cells" },
                if *count == 1 { "stands" } else { "stand" },
                short(*height),
                at.x,
                at.y
            ),
            Self::UnusedColumns { columns } => {
                write!(f, "columns not used: {}", columns.join(", "))
            }
            Self::TakenForHeight { column } => {
                write!(f, "column {column} is taken for the height, in metres")
            }
        }
    }
}

/// A length with three digits.
fn short(length: f64) -> f64 {
    let places = 10.0_f64.powf(2.0 - length.abs().max(1e-9).log10().floor());
    (length * places).round() / places
}
