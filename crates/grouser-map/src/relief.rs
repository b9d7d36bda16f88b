//! A small picture of the ground with ways over it.

use std::fmt::Write as _;

use grouser_core::units::Vec2;
use grouser_raster::Raster;

/// A way on a picture.
#[derive(Clone, Debug)]
pub struct Track<'a> {
    /// What it is called.
    pub name: String,
    /// Its places [m].
    pub places: &'a [Vec2],
}

/// Cells along the longer side, at most.
const CELLS: usize = 240;
/// Shades of grey, from ground in its own shadow to ground that faces the light.
const SHADES: usize = 24;
/// Where the light comes from: a unit vector to the north-west, 30° above the horizon.
const LIGHT: [f64; 3] = [-0.612_372_435_695_794_5, 0.612_372_435_695_794_5, 0.5];
/// Length of the longer side [px].
const LENGTH: f64 = 560.0;
/// Colours of Okabe and Ito.
const COLOURS: [&str; 3] = ["#d55e00", "#0072b2", "#009e73"];

/// The part of a map about some ways in the light of a low Sun, and the ways, as a stand-alone SVG document.
#[must_use]
pub fn relief(raster: &Raster, tracks: &[Track<'_>], title: &str) -> String {
    let window = Window::about(raster, tracks);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0} {:.0}\" font-family=\"sans-serif\" \
         font-size=\"13\" role=\"img\" aria-label=\"{title}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        window.width + 190.0,
        window.height + 70.0
    );
    let _ = writeln!(
        text,
        "<text x=\"20\" y=\"22\" font-size=\"15\">{title}</text>\n<g transform=\"translate(20 36)\">"
    );
    window.draw_ground(&mut text, raster);
    for (place, track) in tracks.iter().enumerate().rev() {
        window.draw_track(&mut text, track, COLOURS[place % COLOURS.len()]);
    }
    window.draw_ends(&mut text, tracks);
    for (place, track) in tracks.iter().enumerate() {
        let y = 14.0 + 22.0 * place as f64;
        let (x, colour) = (window.width + 16.0, COLOURS[place % COLOURS.len()]);
        let _ = writeln!(
            text,
            "<path d=\"M{x:.1} {:.1}h24\" stroke=\"{colour}\" stroke-width=\"3\"/><text x=\"{:.1}\" y=\"{y:.1}\">{}</text>",
            y - 4.0,
            x + 30.0,
            track.name
        );
    }
    let (low, high) = (window.south_west, window.north_east);
    let round = |at: f64| (at * 10.0).round() / 10.0;
    let _ = writeln!(
        text,
        "<text x=\"0\" y=\"{:.0}\" fill=\"#555\">x {} … {} m, y {} … {} m</text>\n</g>\n</svg>",
        window.height + 20.0,
        round(low.x),
        round(high.x),
        round(low.y),
        round(high.y)
    );
    text
}

/// The part of the map that is shown.
struct Window {
    /// First column and row, and how many of each.
    first: [usize; 2],
    count: [usize; 2],
    step: usize,
    south_west: Vec2,
    north_east: Vec2,
    width: f64,
    height: f64,
}

impl Window {
    /// All ways, with a fifth of their extent around them.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the grid"
    )]
    fn about(raster: &Raster, tracks: &[Track<'_>]) -> Self {
        let grid = &raster.grid;
        let extent = grid.extent();
        let places = || tracks.iter().flat_map(|track| track.places.iter().copied());
        let low = places().reduce(|one, other| one.inf(&other)).unwrap_or(extent.south_west);
        let high = places().reduce(|one, other| one.sup(&other)).unwrap_or(extent.north_east);
        let margin = 0.2 * (high - low).amax() + 4.0 * grid.spacing.amax();
        let column = |x: f64, count: usize, spacing: f64| {
            ((x / spacing).round().max(0.0) as usize).min(count - 1)
        };
        let cell = |at: Vec2| {
            let way = at - grid.south_west;
            [column(way.x, grid.columns, grid.spacing.x), column(way.y, grid.rows, grid.spacing.y)]
        };
        let margin = Vec2::new(margin, margin);
        let (first, last) = (cell(low - margin), cell(high + margin));
        let count = [last[0] - first[0] + 1, last[1] - first[1] + 1];
        let half = 0.5 * grid.spacing;
        let south_west = grid.point(first[0], first[1]) - half;
        let north_east = grid.point(last[0], last[1]) + half;
        let size = north_east - south_west;
        let pixels = LENGTH / size.amax();
        Self {
            first,
            count,
            step: count[0].max(count[1]).div_ceil(CELLS).max(1),
            south_west,
            north_east,
            width: size.x * pixels,
            height: size.y * pixels,
        }
    }

    fn draw_ground(&self, text: &mut String, raster: &Raster) {
        let [columns, rows] = self.count.map(|count| count.div_ceil(self.step));
        let mut runs = vec![String::new(); SHADES];
        for y in 0..rows {
            let row = (self.first[1] + self.count[1] - 1).saturating_sub(y * self.step);
            let shade =
                |x: usize| raster.gradient(self.first[0] + x * self.step, row, [1, 1]).map(shade);
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
        let scale = [self.width / columns as f64, self.height / rows as f64];
        let _ = writeln!(
            text,
            "<g transform=\"scale({:.5} {:.5})\" stroke-width=\"1.02\" fill=\"none\">",
            scale[0], scale[1]
        );
        for (place, run) in runs.iter().enumerate().filter(|(_, run)| !run.is_empty()) {
            let grey = 30 + place * 220 / SHADES;
            let _ = writeln!(
                text,
                "<path transform=\"translate(0 .5)\" stroke=\"#{grey:02x}{grey:02x}{grey:02x}\" d=\"{run}\"/>"
            );
        }
        *text += "</g>\n";
    }

    /// Where a place is on the picture [px].
    fn pixel(&self, at: &Vec2) -> [f64; 2] {
        let size = self.north_east - self.south_west;
        let way = at - self.south_west;
        [way.x / size.x * self.width, (1.0 - way.y / size.y) * self.height]
    }

    /// Names of the first and the last place, which all ways share.
    fn draw_ends(&self, text: &mut String, tracks: &[Track<'_>]) {
        let Some(Track { places: [first, .., last], .. }) = tracks.first() else { return };
        for (place, name) in [(first, "start"), (last, "goal")] {
            let [x, y] = self.pixel(place);
            // To the side where there is room.
            let (x, anchor) =
                if x > 0.5 * self.width { (x - 9.0, "end") } else { (x + 9.0, "start") };
            // White below, so that it is read on dark ground.
            for paint in
                ["stroke=\"#fff\" stroke-width=\"3.5\" stroke-linejoin=\"round\"", "fill=\"#000\""]
            {
                let _ = writeln!(
                    text,
                    "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\" font-weight=\"bold\" {paint}>{name}</text>",
                    y + 4.5
                );
            }
        }
    }

    fn draw_track(&self, text: &mut String, track: &Track<'_>, colour: &str) {
        let points: Vec<[f64; 2]> = track.places.iter().map(|at| self.pixel(at)).collect();
        let line: Vec<String> = points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let _ = writeln!(
            text,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"#fff\" stroke-width=\"5\"/>\n<polyline points=\"{}\" fill=\"none\" \
             stroke=\"{colour}\" stroke-width=\"2.6\" stroke-linejoin=\"round\"/>",
            line.join(" "),
            line.join(" ")
        );
        for [x, y] in points {
            let _ = writeln!(
                text,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.6\" fill=\"#fff\" stroke=\"{colour}\" stroke-width=\"1.6\"/>"
            );
        }
    }
}

/// The shade of ground with a gradient: how much of the light meets it.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in a list")]
fn shade(gradient: Vec2) -> usize {
    let [east, north, up] = LIGHT;
    let across = (1.0 + gradient.norm_squared()).sqrt();
    let light = (up - east * gradient.x - north * gradient.y) / across;
    ((light.max(0.0) * SHADES as f64) as usize).min(SHADES - 1)
}
