//! Styles with which QGIS shows bands.
//!
//! Colours: *viridis* of matplotlib for numbers that go one way, a cyclic scale for directions, and the green, orange
//! and vermilion of Okabe and Ito for go, caution and no-go.

use std::fmt::Write as _;

use crate::BandSummary;

/// How a band is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// Numbers that go one way.
    Ramp,
    /// Directions, −180° to 180°.
    Cycle,
    /// Go, caution, no-go.
    Verdicts,
}

/// Of numbers that go one way, from the least to the largest.
const RAMP: [&str; 9] = [
    "#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30",
    "#fde725",
];
/// Of directions, from −180° to 180°: the ends are alike.
const CYCLE: [&str; 9] = [
    "#e2d9e2", "#9ebbc9", "#6276ba", "#5e43a5", "#2f1436", "#7b1e50", "#b25652", "#cfa28a",
    "#e2d9e2",
];
/// Of verdicts: the number, the colour and the word.
const VERDICTS: [(u8, &str, &str); 3] =
    [(1, "#009e73", "go"), (2, "#e69f00", "caution"), (3, "#d55e00", "no-go")];

impl Look {
    /// How a band of this name is shown.
    #[must_use]
    pub fn of(band: &str) -> Self {
        match band {
            "heading_deg" => Self::Cycle,
            "verdict" => Self::Verdicts,
            _ => Self::Ramp,
        }
    }

    /// The words of verdicts, in the order of their numbers.
    pub(crate) fn verdict_words() -> [&'static str; 3] {
        VERDICTS.map(|(_, _, word)| word)
    }

    /// Numbers and their colours, rising; between them colours are mixed, but for verdicts.
    ///
    /// * `of`: the numbers that are shown
    #[must_use]
    pub fn stops(self, of: &BandSummary) -> Vec<(f64, &'static str)> {
        let spread = |colours: &[&'static str], low: f64, high: f64| {
            let last = (colours.len() - 1) as f64;
            let stop = |(place, colour): (usize, &&'static str)| {
                (low + (high - low) * place as f64 / last, *colour)
            };
            colours.iter().enumerate().map(stop).collect()
        };
        match self {
            Self::Ramp => {
                let (low, high) = range(of);
                spread(&RAMP, low, high)
            }
            Self::Cycle => spread(&CYCLE, -180.0, 180.0),
            Self::Verdicts => {
                VERDICTS.iter().map(|(number, colour, _)| (f64::from(*number), *colour)).collect()
            }
        }
    }
}

/// From the least to the largest number; wider than nothing.
fn range(of: &BandSummary) -> (f64, f64) {
    let (low, high) = if of.known > 0 { (of.least, of.most) } else { (0.0, 1.0) };
    (low, if high > low { high } else { low + 1.0 })
}

/// The style of a band, as a `.qml` file.
///
/// * `label`: what it is, with the unit
#[must_use]
pub fn style(look: Look, of: &BandSummary, label: &str) -> String {
    let stops = look.stops(of);
    let mut text = String::from(
        "<!DOCTYPE qgis>\n<qgis version=\"3.22\" styleCategories=\"Symbology\">\n  <pipe>\n",
    );
    if look == Look::Verdicts {
        text += "    <rasterrenderer type=\"paletted\" band=\"1\" opacity=\"1\" alphaBand=\"-1\" nodataColor=\"\">\n      <rasterTransparency/>\n      <colorPalette>\n";
        for (number, colour, word) in VERDICTS {
            let _ = writeln!(
                text,
                "        <paletteEntry value=\"{number}\" color=\"{colour}\" alpha=\"255\" label=\"{word}\"/>"
            );
        }
        text += "      </colorPalette>\n    </rasterrenderer>\n";
    } else {
        let (low, high) = (stops[0].0, stops[stops.len() - 1].0);
        let _ = writeln!(
            text,
            "    <rasterrenderer type=\"singlebandpseudocolor\" band=\"1\" opacity=\"1\" alphaBand=\"-1\" nodataColor=\"\" classificationMin=\"{low}\" classificationMax=\"{high}\">"
        );
        text += "      <rasterTransparency/>\n      <rastershader>\n";
        let _ = writeln!(
            text,
            "        <colorrampshader colorRampType=\"INTERPOLATED\" classificationMode=\"2\" clip=\"0\" minimumValue=\"{low}\" maximumValue=\"{high}\" labelPrecision=\"4\">"
        );
        for (number, colour) in stops {
            let _ = writeln!(
                text,
                "          <item value=\"{number}\" color=\"{colour}\" alpha=\"255\" label=\"{}\"/>",
                rounded(number)
            );
        }
        text += "        </colorrampshader>\n      </rastershader>\n    </rasterrenderer>\n";
    }
    text += "    <brightnesscontrast brightness=\"0\" contrast=\"0\" gamma=\"1\"/>\n    <huesaturation saturation=\"0\" grayscaleMode=\"0\" colorizeOn=\"0\"/>\n    <rasterresampler maxOversampling=\"2\"/>\n  </pipe>\n";
    let _ = writeln!(text, "  <!-- {} -->", label.replace("--", "-"));
    text + "  <blendMode>0</blendMode>\n</qgis>\n"
}

/// A number with four digits.
pub(crate) fn rounded(number: f64) -> String {
    let rounded: f64 = format!("{number:.3e}").parse().unwrap_or(number);
    rounded.to_string()
}
