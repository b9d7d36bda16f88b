//! Styles with which QGIS shows bands.
//!
//! Colours are those of our own pictures of maps: a [`Scale`], with the green, orange, vermilion and
//! purple of Okabe and Ito for go, caution, no-go and cannot tell, and classes of slopes.

// Colours are written as style sheets write them.
#![allow(clippy::unreadable_literal)]

use std::fmt::Write as _;

use grouser_draw::{Colour, Scale, Stop};

use crate::BandSummary;

/// How a band is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// Numbers that go one way, from the least to the largest.
    Ramp,
    /// Shares, from 0 to 1.
    Share,
    /// Slopes in classes, the same on every map: one steep cell does not make all others alike.
    Slopes,
    /// Directions, −180° to 180°.
    Cycle,
    /// Go, caution, no-go, cannot tell.
    Verdicts,
}

/// Verdicts: the number, the colour and the word.
const VERDICTS: [(u8, u32, &str); 4] = [
    (1, 0x009e73, "go"),
    (2, 0xe69f00, "caution"),
    (3, 0xd55e00, "no-go"),
    (4, 0xcc79a7, "cannot tell"),
];

/// Classes of slopes: the least [°], the colour and the word; the colours of ColorBrewer's YlOrRd,
/// which stay apart for colour-blind eyes.
const SLOPES: [(f64, u32, &str); 7] = [
    (0.0, 0xffffb2, "0 to 5°"),
    (5.0, 0xfed976, "5 to 10°"),
    (10.0, 0xfeb24c, "10 to 15°"),
    (15.0, 0xfd8d3c, "15 to 20°"),
    (20.0, 0xf03b20, "20 to 25°"),
    (25.0, 0xbd0026, "25 to 30°"),
    (30.0, 0x67001f, "over 30°"),
];

impl Look {
    /// How a band of this name is shown.
    #[must_use]
    pub fn of(band: &str) -> Self {
        match band {
            "heading_deg" => Self::Cycle,
            "verdict" => Self::Verdicts,
            "slope_deg" => Self::Slopes,
            "probability_no_go" => Self::Share,
            _ => Self::Ramp,
        }
    }

    /// Colours by number.
    ///
    /// * `of`: the numbers that are shown
    #[must_use]
    pub fn scale(self, of: &BandSummary) -> Scale {
        match self {
            Self::Ramp => {
                let (low, high) = range(of);
                Scale::ramp(low, high)
            }
            Self::Share => Scale::ramp(0.0, 1.0),
            Self::Slopes => {
                Scale::words(SLOPES.map(|(least, code, word)| (least, Colour::hex(code), word)))
            }
            Self::Cycle => Scale::cycle(-180.0, 180.0),
            Self::Verdicts => Scale::words(
                VERDICTS.map(|(number, code, word)| (f64::from(number), Colour::hex(code), word)),
            ),
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
    let scale = look.scale(of);
    let mut text = String::from(
        "<!DOCTYPE qgis>\n<qgis version=\"3.22\" styleCategories=\"Symbology\">\n  <pipe>\n",
    );
    if look == Look::Verdicts {
        text += "    <rasterrenderer type=\"paletted\" band=\"1\" opacity=\"1\" alphaBand=\"-1\" nodataColor=\"\">\n      <rasterTransparency/>\n      <colorPalette>\n";
        for Stop { at, colour, word } in scale.stops() {
            let (colour, word) = (colour.code(), word.unwrap_or_default());
            let _ = writeln!(
                text,
                "        <paletteEntry value=\"{at}\" color=\"{colour}\" alpha=\"255\" \
                 label=\"{word}\"/>"
            );
        }
        text += "      </colorPalette>\n    </rasterrenderer>\n";
    } else {
        let [low, high] = scale.ends();
        let _ = writeln!(
            text,
            "    <rasterrenderer type=\"singlebandpseudocolor\" band=\"1\" opacity=\"1\" \
             alphaBand=\"-1\" nodataColor=\"\" classificationMin=\"{low}\" \
             classificationMax=\"{high}\">"
        );
        text += "      <rasterTransparency/>\n      <rastershader>\n";
        let kind = if look == Look::Slopes { "DISCRETE" } else { "INTERPOLATED" };
        let _ = writeln!(
            text,
            "        <colorrampshader colorRampType=\"{kind}\" classificationMode=\"2\" \
             clip=\"0\" minimumValue=\"{low}\" maximumValue=\"{high}\" labelPrecision=\"4\">"
        );
        for (value, colour, label) in items(&scale) {
            let _ = writeln!(
                text,
                "          <item value=\"{value}\" color=\"{colour}\" alpha=\"255\" label=\"{label}\"/>"
            );
        }
        text += "        </colorrampshader>\n      </rastershader>\n    </rasterrenderer>\n";
    }
    text += "    <brightnesscontrast brightness=\"0\" contrast=\"0\" gamma=\"1\"/>\n    <huesaturation saturation=\"0\" grayscaleMode=\"0\" colorizeOn=\"0\"/>\n    <rasterresampler maxOversampling=\"2\"/>\n  </pipe>\n";
    let _ = writeln!(text, "  <!-- {} -->", label.replace("--", "-"));
    text + "  <blendMode>0</blendMode>\n</qgis>\n"
}

/// The number, the colour and the label of each item. A class ends with its number, the last one
/// with none.
fn items(scale: &Scale) -> Vec<(String, String, String)> {
    let stops = scale.stops();
    let item = |(place, Stop { at, colour, word }): (usize, &Stop)| {
        let value = match (word, stops.get(place + 1)) {
            (None, _) => at.to_string(),
            (Some(_), Some(next)) => next.at.to_string(),
            (Some(_), None) => "inf".to_owned(),
        };
        let label = word.map_or_else(|| rounded(*at), str::to_owned);
        (value, colour.code(), label)
    };
    stops.iter().enumerate().map(item).collect()
}

/// A number with four digits.
fn rounded(number: f64) -> String {
    let rounded: f64 = format!("{number:.3e}").parse().unwrap_or(number);
    rounded.to_string()
}
