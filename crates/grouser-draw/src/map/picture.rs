//! A number of each place of a map, in colours over its relief or as arrows.

use grouser_core::terrain::ElevationGrid;
use grouser_core::units::Vec2;
use rayon::prelude::*;

use super::arrows::Arrows;
use super::light::{lit, relief};
use super::pixels::Pixels;
use super::{CORNER, LETTERS, OfPlace, Window, text};
use crate::chart::colour_bar;
use crate::scale::Scale;
use crate::sheet::{Cells, Colour, Shape, Sheet, Stroke};
use crate::style::{Ground, Role};

/// Shades of colours that are mixed.
const SHADES: usize = 24;
/// Ground without a colour of its own.
const PLAIN: Colour = Colour::grey(0.8);

/// What a pixel shows that has several cells.
#[derive(Clone, Copy, Debug)]
pub struct OfSeveral {
    /// One of two numbers.
    pub of: fn(f64, f64) -> f64,
    /// Which one that is.
    pub name: &'static str,
}

/// Pictures of a map: north up, with a scale, over the relief of its ground.
pub struct MapPictures<'m> {
    caption: String,
    grid: &'m ElevationGrid,
    pixels: Pixels,
    /// The light of each pixel.
    relief: Vec<Option<f64>>,
}

/// Where the ground lies on a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapFrame {
    /// Width and height of the picture [mm].
    pub picture: [f64; 2],
    /// The ground's north-western corner, from the left and from above [mm].
    pub corner: [f64; 2],
    /// Width and height of the ground [mm].
    pub size: [f64; 2],
    /// The outer corners of the ground's cells [m].
    pub south_west: Vec2,
    /// Likewise.
    pub north_east: Vec2,
}

impl<'m> MapPictures<'m> {
    /// * `caption`: whose map it is
    /// * `gradient`: of the ground, by column and row of the grid; `None` where it is not known
    #[must_use]
    pub fn new(
        caption: &str,
        grid: &'m ElevationGrid,
        gradient: &(dyn Fn(usize, usize) -> Option<Vec2> + Sync),
    ) -> Self {
        let pixels = Pixels::of(grid);
        let relief = relief(&pixels, grid, gradient);
        Self { caption: caption.to_owned(), grid, pixels, relief }
    }

    /// Where the ground lies on each picture.
    #[must_use]
    pub fn frame(&self) -> MapFrame {
        let window = self.window();
        let Window { south_west, north_east, .. } = window;
        let size = window.size();
        MapFrame { picture: window.picture(), corner: CORNER, size, south_west, north_east }
    }

    fn window(&self) -> Window {
        let grid = self.grid;
        Window::new(grid, [0, 0], [grid.columns - 1, grid.rows - 1], usize::MAX)
    }

    /// A number of each place in colours, with their scale beside them. Ground without a number is
    /// grey, and where no height is known the picture is empty.
    ///
    /// * `number`: `None` or NaN where there is none
    /// * `several`: what a pixel shows of several cells
    #[must_use]
    pub fn colours(
        &self,
        title: &str,
        number: &OfPlace<'_>,
        scale: &Scale,
        several: OfSeveral,
    ) -> Sheet {
        let [columns, rows] = self.pixels.size;
        let of_row = |y: usize| -> Vec<Option<Colour>> {
            let of_pixel = |x: usize| {
                let light = self.relief[y * columns + x]?;
                let number = self.of_pixel([x, y], number, several.of);
                let colour = number.map_or(PLAIN, |it| scale.colour(shade(scale, it)));
                Some(lit(colour, light))
            };
            (0..columns).map(of_pixel).collect()
        };
        let colours: Vec<_> = (0..rows).into_par_iter().flat_map_iter(of_row).collect();
        let several = match self.pixels.cells_of_each() {
            [1, 1] => String::new(),
            [east, north] => format!(
                "each pixel has {} of its cells, of which there are up to {east} × {north}",
                several.name
            ),
        };
        let (mut sheet, window) = self.sheet(title, colours, &several);
        let [width, height] = window.size();
        let beside = [CORNER[0] + width + 5.0, CORNER[1]];
        colour_bar(&mut sheet, scale, beside, height.min(90.0), LETTERS);
        sheet
    }

    /// Directions as arrows on a coarse grid, each that of the cell in the middle of its square.
    ///
    /// * `direction`: from the east to the left [°]; `None` or NaN where there is none
    #[must_use]
    pub fn arrows(&self, title: &str, direction: &OfPlace<'_>) -> Sheet {
        let colours = self.relief.iter().map(|light| Some(lit(PLAIN, (*light)?)));
        let arrows = Arrows::on(self.grid);
        let note = format!("an arrow: the cell in the middle of {}", arrows.in_words());
        let (mut sheet, window) = self.sheet(title, colours.collect(), &note);
        arrows.draw(&mut sheet, &window, direction);
        sheet
    }

    /// What a pixel has of its cells.
    fn of_pixel(
        &self,
        [x, y]: [usize; 2],
        number: &OfPlace<'_>,
        several: fn(f64, f64) -> f64,
    ) -> Option<f64> {
        let [columns, rows] = self.pixels.cells(x, y).map(|[first, end]| first..end);
        let cells = rows.flat_map(|row| columns.clone().map(move |column| (column, row)));
        let numbers = cells.filter_map(|(column, row)| number(column, row));
        numbers.filter(|number| !number.is_nan()).reduce(several)
    }

    fn sheet(&self, title: &str, colours: Vec<Option<Colour>>, note: &str) -> (Sheet, Window) {
        let window = self.window();
        let extent = self.grid.extent();
        let corners = [extent.south_west, extent.north_east];
        let mut sheet = window.sheet(title, &self.caption, corners);
        let size = window.size();
        sheet.cells(Cells::new(CORNER, size, self.pixels.size[0], colours));
        let edge = Stroke::new(0.25, Role::Faint.on(Ground::Light));
        sheet.draw(Shape::rectangle(CORNER, size, edge.colour).unfilled().outlined(edge));
        if !note.is_empty() {
            let below = [CORNER[0], CORNER[1] + size[1] + 15.5];
            sheet.text(text(note, 0.8 * LETTERS, Role::Faint), below);
        }
        (sheet, window)
    }
}

/// The middle of the shade that a number has.
fn shade(scale: &Scale, number: f64) -> f64 {
    if scale.is_of_words() {
        return number;
    }
    let [low, high] = scale.ends();
    let place = ((number - low) / (high - low) * SHADES as f64).floor();
    let place = place.clamp(0.0, SHADES as f64 - 1.0);
    low + (place + 0.5) / SHADES as f64 * (high - low)
}
