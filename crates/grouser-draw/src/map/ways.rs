//! The ground in the light of a low Sun, with ways over it.

use grouser_core::terrain::ElevationGrid;
use grouser_core::units::Vec2;
use grouser_io::escape;

use super::light::{light, lit};
use super::{CORNER, LETTERS, Window, text};
use crate::sheet::{Cells, Colour, Face, Shape, Sheet, Stroke, Text, wrap};
use crate::style::{Ground, Role, series};

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
/// Ground that is level.
const GROUND: Colour = Colour::grey(0.62);

/// The part of a map about some ways in the light of a low Sun, and the ways, as a stand-alone SVG
/// document.
///
/// * `gradient`: of the ground, by column and row of the grid; `None` where it is not known
#[must_use]
pub fn ways_over_ground(
    title: &str,
    grid: &ElevationGrid,
    gradient: &dyn Fn(usize, usize) -> Option<Vec2>,
    tracks: &[Track<'_>],
) -> Sheet {
    let window = about(grid, tracks);
    let mut sheet = window.sheet(title, "", [window.south_west, window.north_east]);
    let shades =
        window.places().map(|[column, row]| gradient(column, row).map(|it| lit(GROUND, light(it))));
    sheet.cells(Cells::new(CORNER, window.size(), window.cells()[0], shades));
    for (place, track) in tracks.iter().enumerate().rev() {
        draw_track(&mut sheet, &window, track, colour_of(place));
    }
    draw_ends(&mut sheet, &window, tracks);
    names(&mut sheet, &window, tracks);
    sheet
}

/// All ways, with a fifth of their extent around them.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the grid")]
fn about(grid: &ElevationGrid, tracks: &[Track<'_>]) -> Window {
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
    Window::new(grid, cell(low - margin), cell(high + margin), CELLS)
}

/// Vermilion, blue, green: what stands out of grey.
fn colour_of(place: usize) -> Colour {
    let colours = series(Ground::Light);
    colours[[2, 1, 3][place % 3]]
}

fn draw_track(sheet: &mut Sheet, window: &Window, track: &Track<'_>, colour: Colour) {
    let points: Vec<_> = track.places.iter().map(|at| window.at(*at)).collect();
    for stroke in [Stroke::new(1.3, HALO), Stroke::new(0.7, colour)] {
        sheet.draw(Shape::line(points.iter().copied(), stroke.rounded()));
    }
    for at in points {
        sheet.draw(Shape::circle(at, 0.7, HALO).outlined(Stroke::new(0.4, colour)));
    }
}

/// Around ways, on whatever ground: white that is white on a dark screen, too.
const HALO: Colour = Colour::grey(254.0 / 255.0);
/// Letters on it, which stay as they are, too.
const DARK: Colour = Colour::grey(1.0 / 255.0);

/// Names of the first and the last place, which all ways share.
fn draw_ends(sheet: &mut Sheet, window: &Window, tracks: &[Track<'_>]) {
    let Some(Track { places: [first, .., last], .. }) = tracks.first() else { return };
    for (place, name) in [(first, "start"), (last, "goal")] {
        let [x, y] = window.at(*place);
        // To the side where there is room.
        let is_right = x > CORNER[0] + 0.5 * window.size()[0];
        let text = Text::new(name, LETTERS).face(Face::Bold);
        let (wide, high) = (text.width() + 1.2, 1.25 * LETTERS);
        let left = if is_right { x - 1.8 - wide } else { x + 1.8 };
        // White below, so that it is read on dark ground.
        let plate = Shape::rectangle([left, y - 0.5 * high], [wide, high], HALO.opacity(0.8));
        sheet.draw(plate);
        sheet.text(text.colour(DARK), [left + 0.6, y + 0.36 * LETTERS]);
    }
}

/// The names of ways with their colours, on the right of the ground.
fn names(sheet: &mut Sheet, window: &Window, tracks: &[Track<'_>]) {
    let left = CORNER[0] + window.size()[0] + 4.0;
    let mut y = CORNER[1] + LETTERS;
    for (place, track) in tracks.iter().enumerate() {
        let stroke = Stroke::new(0.8, colour_of(place));
        let middle = y - 0.36 * LETTERS;
        sheet.draw(Shape::line([[left, middle], [left + 6.0, middle]], stroke));
        for line in wrap(&escape::line(&track.name), Face::Regular, LETTERS, 36.0) {
            sheet.text(text(&line, LETTERS, Role::Ink), [left + 7.6, y]);
            y += 1.3 * LETTERS;
        }
        y += 1.2;
    }
}
