//! Small pictures of bands, for pages.

use std::fmt::Write as _;

use grouser::studies::mobility::{Ground, MobilityMap};

use crate::style::{Look, rounded};
use crate::{BandSummary, MapColumn};

/// Cells of a picture along its longer side, at most.
const CELLS: usize = 200;
/// Shades of a scale.
const SHADES: usize = 48;
/// Length of the longer side, and of the scale beside it [px].
const LENGTH: f64 = 520.0;

/// A band as a stand-alone SVG document: the map north up, its corners, and the scale of its colours. Where nothing is
/// known the picture is empty.
#[must_use]
pub fn picture(
    ground: Ground<'_>,
    map: &MobilityMap,
    band: &MapColumn,
    of: &BandSummary,
    title: &str,
) -> String {
    let grid = &ground.raster().grid;
    let step = grid.columns.max(grid.rows).div_ceil(CELLS).max(1);
    let (columns, rows) = (grid.columns.div_ceil(step), grid.rows.div_ceil(step));
    let scale = Scale::of(Look::of(band.name), of);
    let mut runs = vec![String::new(); scale.colours.len()];
    for y in 0..rows {
        let row = grid.rows - 1 - y * step;
        let shade = |x: usize| {
            let number = band.number(&ground.at(map, x * step, row)?);
            (!number.is_nan()).then(|| scale.shade(number))
        };
        let mut start = 0;
        while start < columns {
            let own = shade(start);
            let end = (start + 1..columns).find(|x| shade(*x) != own).unwrap_or(columns);
            if let Some(own) = own {
                let _ = write!(runs[own], "M{start} {y}h{}", end - start);
            }
            start = end;
        }
    }
    let cell = [grid.spacing.x, grid.spacing.y];
    let (east, north) = (columns as f64 * cell[0], rows as f64 * cell[1]);
    let pixels = LENGTH / east.max(north);
    let (width, height) = (east * pixels, north * pixels);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0} {:.0}\" font-family=\"sans-serif\" font-size=\"13\" \
         role=\"img\" aria-label=\"{title}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        width + 190.0,
        height + 70.0
    );
    let _ = writeln!(text, "<text x=\"20\" y=\"22\" font-size=\"15\">{title}</text>");
    let _ = writeln!(
        text,
        "<g transform=\"translate(20 36) scale({:.5} {:.5})\" stroke-width=\"1.02\" fill=\"none\">",
        width / columns as f64,
        height / rows as f64
    );
    for (colour, run) in scale.colours.iter().zip(&runs).filter(|(_, run)| !run.is_empty()) {
        // A line through the middles of a row's cells, as wide as the row.
        let _ =
            writeln!(text, "<path transform=\"translate(0 .5)\" stroke=\"{colour}\" d=\"{run}\"/>");
    }
    text += "</g>\n";
    let _ = writeln!(
        text,
        "<rect x=\"20\" y=\"36\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"none\" stroke=\"#888\"/>"
    );
    let extent = grid.extent();
    let below = height + 54.0;
    let corner = rounded_place;
    let _ = writeln!(
        text,
        "<text x=\"20\" y=\"{below:.0}\" fill=\"#555\">x {} … {} m, y {} … {} m</text>",
        corner(extent.south_west.x),
        corner(extent.north_east.x),
        corner(extent.south_west.y),
        corner(extent.north_east.y)
    );
    scale.draw(&mut text, width + 40.0, height);
    text + "</svg>\n"
}

/// A coordinate without digits that nobody reads.
fn rounded_place(at: f64) -> String {
    ((at * 10.0).round() / 10.0).to_string()
}

/// Colours by number.
struct Scale {
    look: Look,
    low: f64,
    high: f64,
    colours: Vec<String>,
}

impl Scale {
    fn of(look: Look, of: &BandSummary) -> Self {
        let stops = look.stops(of);
        let (low, high) = (stops[0].0, stops[stops.len() - 1].0);
        let colours = if look == Look::Verdicts {
            stops.iter().map(|(_, colour)| (*colour).to_owned()).collect()
        } else {
            let place =
                |shade: usize| (shade as f64 + 0.5) / SHADES as f64 * (stops.len() - 1) as f64;
            (0..SHADES).map(|shade| mixed(&stops, place(shade))).collect()
        };
        Self { look, low, high, colours }
    }

    /// The number of the colour of a number.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place in a list"
    )]
    fn shade(&self, number: f64) -> usize {
        let count = self.colours.len();
        let place = if self.look == Look::Verdicts {
            number - self.low
        } else {
            (number - self.low) / (self.high - self.low) * count as f64
        };
        (place.max(0.0) as usize).min(count - 1)
    }

    fn draw(&self, text: &mut String, x: f64, height: f64) {
        let count = self.colours.len() as f64;
        for (place, colour) in self.colours.iter().enumerate() {
            let step = height / count;
            let y = 36.0 + height - (place as f64 + 1.0) * step;
            let _ = writeln!(
                text,
                "<rect x=\"{x:.1}\" y=\"{y:.2}\" width=\"18\" height=\"{:.2}\" fill=\"{colour}\"/>",
                step + 0.3
            );
        }
        let labels: Vec<(f64, String)> = if self.look == Look::Verdicts {
            let words = Look::verdict_words().into_iter().enumerate();
            words.map(|(place, word)| ((place as f64 + 0.5) / count, word.to_owned())).collect()
        } else {
            let number = |share: f64| rounded(self.low + share * (self.high - self.low));
            [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| (share, number(share))).into()
        };
        for (share, label) in labels {
            let y = 36.0 + height * (1.0 - share) + 5.0;
            let _ = writeln!(text, "<text x=\"{:.1}\" y=\"{y:.1}\">{label}</text>", x + 26.0);
        }
    }
}

/// The colour at a place between stops.
///
/// * `place`: in stops from the first
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "places and bytes")]
fn mixed(stops: &[(f64, &str)], place: f64) -> String {
    let below = (place as usize).min(stops.len() - 2);
    let share = place - below as f64;
    let byte = |colour: &str, at: usize| {
        f64::from(u8::from_str_radix(&colour[1 + 2 * at..3 + 2 * at], 16).unwrap_or(0))
    };
    let (one, other) = (stops[below].1, stops[below + 1].1);
    let part = |at| (byte(one, at) * (1.0 - share) + byte(other, at) * share).round() as u8;
    format!("#{:02x}{:02x}{:02x}", part(0), part(1), part(2))
}
