//! Maps north up: the ground in the light, with numbers in colours, arrows and ways over it.

mod arrows;
mod light;
mod picture;
mod pixels;
mod ways;

pub use self::picture::{MapFrame, MapPictures, OfSeveral};
pub use self::ways::{Track, ways_over_ground};

use grouser_core::terrain::ElevationGrid;
use grouser_core::units::Vec2;
use grouser_io::escape;

use crate::sheet::{Anchor, Place, Shape, Sheet, Stroke, Text};
use crate::step::round_step;
use crate::style::{Ground, Role};

/// A number of each place of a map, by column and row of its grid.
pub type OfPlace<'m> = dyn Fn(usize, usize) -> Option<f64> + Sync + 'm;

/// Length of the longer side of the ground [mm].
const LENGTH: f64 = 140.0;
/// Where the ground begins, and room on the right of it and below it [mm].
const CORNER: Place = [5.0, 14.5];
const RIGHT: f64 = 50.0;
const BOTTOM: f64 = 17.5;
/// Height of letters, and of those of the title [mm].
const LETTERS: f64 = 3.4;
const TITLE: f64 = 4.0;

/// A part of a grid of points, north up: its cells thinned to what can be seen.
#[derive(Clone, Copy, Debug)]
struct Window {
    /// First column and row, and how many of each.
    first: [usize; 2],
    count: [usize; 2],
    /// From cell to cell that is drawn.
    step: usize,
    south_west: Vec2,
    north_east: Vec2,
}

impl Window {
    /// * `most`: cells along the longer side that are drawn
    fn new(grid: &ElevationGrid, first: [usize; 2], last: [usize; 2], most: usize) -> Self {
        let count = [last[0] - first[0] + 1, last[1] - first[1] + 1];
        let half = 0.5 * grid.spacing;
        Self {
            first,
            count,
            step: count[0].max(count[1]).div_ceil(most).max(1),
            south_west: grid.point(first[0], first[1]) - half,
            north_east: grid.point(last[0], last[1]) + half,
        }
    }

    /// Columns and rows that are drawn.
    fn cells(&self) -> [usize; 2] {
        self.count.map(|count| count.div_ceil(self.step))
    }

    /// Column and row of the grid for each cell that is drawn, from the north-west, row by row.
    fn places(&self) -> impl Iterator<Item = [usize; 2]> {
        let [columns, rows] = self.cells();
        let Self { first, count, step, .. } = *self;
        (0..rows).flat_map(move |y| {
            let row = (first[1] + count[1] - 1).saturating_sub(y * step);
            (0..columns).map(move |x| [first[0] + x * step, row])
        })
    }

    /// Width and height on the page [mm].
    fn size(&self) -> [f64; 2] {
        let size = self.north_east - self.south_west;
        [size.x, size.y].map(|side| side * LENGTH / size.amax())
    }

    /// Width and height of the page [mm].
    fn picture(&self) -> [f64; 2] {
        let [width, height] = self.size();
        [CORNER[0] + width + RIGHT, CORNER[1] + height + BOTTOM]
    }

    /// Where a place [m] is on the page.
    fn at(&self, place: Vec2) -> Place {
        let (way, size) = (place - self.south_west, self.north_east - self.south_west);
        let [width, height] = self.size();
        [CORNER[0] + way.x / size.x * width, CORNER[1] + (1.0 - way.y / size.y) * height]
    }

    /// A page with the title and a caption above the ground, where north is beside it, and its
    /// corners and a scale below it.
    ///
    /// * `corners`: south-west and north-east [m], as they are written
    fn sheet(&self, title: &str, caption: &str, [low, high]: [Vec2; 2]) -> Sheet {
        let [width, height] = self.size();
        let title = escape::line(title);
        let size = self.picture();
        let mut sheet = Sheet::new(&title, size[0], size[1]).on(Role::Paper.on(Ground::Light));
        sheet.text(text(&title, TITLE, Role::Ink), [CORNER[0], 6.5]);
        sheet.text(text(&escape::line(caption), LETTERS, Role::Faint), [CORNER[0], 11.8]);
        let round = |at: f64| ((at * 10.0).round() / 10.0 + 0.0).to_string().replace('-', "−");
        let corners = format!(
            "x {} … {} m, y {} … {} m",
            round(low.x),
            round(high.x),
            round(low.y),
            round(high.y)
        );
        let below = CORNER[1] + height;
        sheet.text(text(&corners, LETTERS, Role::Faint), [CORNER[0], below + 5.0]);
        self.scale(&mut sheet, [CORNER[0], below + 9.0]);
        north(&mut sheet, [CORNER[0] + width + RIGHT - 9.0, below]);
        sheet
    }

    /// A bar of a round length, about a quarter of the ground's width, with that length.
    fn scale(&self, sheet: &mut Sheet, [left, y]: Place) {
        let across = (self.north_east - self.south_west).x;
        let length = round_step(0.15 * across);
        let bar = self.size()[0] * length / across;
        let ink = Role::Ink.on(Ground::Light);
        // Half of it is filled, as on paper maps.
        let edge = Stroke::new(0.25, ink);
        let size = [0.5 * bar, 1.4];
        sheet.draw(Shape::rectangle([left, y - 0.7], size, ink).outlined(edge));
        let rest = [left + 0.5 * bar, y - 0.7];
        sheet.draw(Shape::rectangle(rest, size, ink).unfilled().outlined(edge));
        let label = format!("{length} m");
        sheet.text(text(&label, LETTERS, Role::Ink), [left + bar + 2.0, y + 0.36 * LETTERS]);
    }
}

/// An arrow to the north, as high as two lines.
///
/// * `foot`: the middle of its lower end
fn north(sheet: &mut Sheet, [x, y]: Place) {
    let ink = Role::Ink.on(Ground::Light);
    let points = [[x, y - 9.0], [x + 2.4, y], [x, y - 2.0], [x - 2.4, y]];
    sheet.draw(Shape::area(points, ink));
    let name = text("N", LETTERS, Role::Ink).anchor(Anchor::Middle);
    sheet.text(name, [x, y - 10.4]);
}

fn text(content: &str, size: f64, role: Role) -> Text {
    Text::new(content, size).colour(role.on(Ground::Light)).anchor(Anchor::Start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scale::Scale;
    use crate::sheet::Colour;

    fn grid(columns: usize, rows: usize) -> ElevationGrid {
        let (south_west, spacing) = (Vec2::new(100.0, -50.0), Vec2::new(2.0, 1.0));
        ElevationGrid { columns, rows, south_west, spacing }
    }

    #[test]
    fn a_map_is_north_up_and_thinned_to_what_can_be_seen() {
        let window = Window::new(&grid(5, 3), [0, 0], [4, 2], 200);
        assert_eq!((window.cells(), window.size()), ([5, 3], [140.0, 42.0]));
        let places: Vec<[usize; 2]> = window.places().collect();
        assert_eq!((places[0], places[5], places[14]), ([0, 2], [0, 1], [4, 0]));
        assert_eq!(window.at(Vec2::new(99.0, -50.5)), [CORNER[0], CORNER[1] + 42.0]);
        let thinned = Window::new(&grid(1000, 10), [0, 0], [999, 9], 100);
        assert_eq!((thinned.cells(), thinned.step), ([100, 1], 10));
        assert!(thinned.places().all(|[column, row]| column < 1000 && row < 10));
    }

    const LARGEST: OfSeveral = OfSeveral { of: f64::max, name: "the largest" };

    /// Without a hole.
    fn level(column: usize, row: usize) -> Option<Vec2> {
        (column < 10_000 && row < 10_000).then(Vec2::zeros)
    }

    /// How many pixels of a sheet have a colour.
    fn count(sheet: &Sheet, colour: Colour) -> usize {
        sheet.to_picture(4.0).pixels.iter().filter(|it| **it == colour.bytes()).count()
    }

    /// One of 15 places has no height, and one no number.
    #[test]
    fn places_without_a_height_are_empty_and_those_without_a_number_grey() {
        let number = |column: usize, row: usize| match (column, row) {
            (1, 0) => Some(f64::NAN),
            _ => Some(if column < 3 { 0.0 } else { 1.0 }),
        };
        let known =
            |column: usize, row: usize| level(column, row).filter(|_| (column, row) != (0, 0));
        let grid = grid(5, 3);
        let pictures = MapPictures::new("rover <on> sand", &grid, &known);
        let scale = Scale::words([(0.0, BLUE, "low"), (1.0, RED, "high")]);
        let sheet = pictures.colours("slope < [°]", &number, &scale, LARGEST);
        let svg = sheet.to_svg();
        roxmltree::Document::parse(&svg).unwrap();
        assert_eq!(svg.matches("<image").count(), 1);
        for text in ["slope &lt; [°]", "rover &lt;on&gt; sand", "x 100 … 108 m, y −50 … −48 m", "N"]
        {
            assert!(svg.contains(&format!(">{text}</text>")), "{text}: {svg}");
        }
        // 7 cells are low, 6 high, 1 has no number: each is 112 × 56 pixels, but for edges.
        let each = 112.0 * 56.0;
        for (colour, cells) in [(BLUE, 7.0), (RED, 6.0), (Colour::grey(0.8), 1.0)] {
            let found = count(&sheet, colour) as f64 / each;
            assert!((found - cells).abs() < 0.5, "{colour:?}: {found} {cells}");
        }
    }

    const BLUE: Colour = Colour::hex(0x00_72b2);
    const RED: Colour = Colour::hex(0xd5_5e00);

    /// One cell in nine is high: a pixel that has it among its cells shows it.
    #[test]
    fn a_pixel_of_several_cells_has_the_one_that_is_asked_for() {
        let grid = grid(2400, 1200);
        let pictures = MapPictures::new("", &grid, &level);
        let number = |column: usize, row: usize| {
            Some(if column.is_multiple_of(3) && row.is_multiple_of(3) { 2.0 } else { 1.0 })
        };
        let scale = Scale::words([(1.0, BLUE, "go"), (2.0, RED, "no-go")]);
        let sheet = pictures.colours("verdict", &number, &scale, LARGEST);
        let svg = sheet.to_svg();
        assert!(svg.contains(">go</text>") && svg.contains(">no-go</text>"));
        let note = "each pixel has the largest of its cells, of which there are up to 3 × 3";
        assert!(svg.contains(note), "{svg}");
        // Blue is in the scale alone.
        assert!(count(&sheet, RED) > 20 * count(&sheet, BLUE));
    }

    #[test]
    fn directions_are_arrows_on_a_coarse_grid() {
        let grid = grid(480, 480);
        let pictures = MapPictures::new("", &grid, &level);
        let direction = |column: usize, _: usize| (column > 240).then_some(45.0);
        let svg = pictures.arrows("heading [°]", &direction).to_svg();
        assert!(svg.contains(">an arrow: the cell in the middle of 20 × 40 cells</text>"), "{svg}");
        let ink = Role::Ink.on(Ground::Light).code();
        // Half of 24 × 12 squares, the scale's two rectangles and north.
        let filled = svg.matches(&format!("fill=\"{ink}\"/>")).count();
        assert_eq!(filled, 12 * 12 + 1, "{svg}");
    }

    #[test]
    fn ways_lie_on_their_ground_with_names() {
        let places = [Vec2::new(110.0, -45.0), Vec2::new(130.0, -40.0)];
        let tracks = [Track { name: "least <time>".into(), places: &places }];
        let flat = |_: usize, _: usize| Some(Vec2::zeros());
        let svg = ways_over_ground("Ways", &grid(50, 40), &flat, &tracks).to_svg();
        roxmltree::Document::parse(&svg).unwrap();
        assert_eq!(svg.matches("<circle").count(), 2, "a ring for each place");
        for text in [">least &lt;time&gt;</text>", ">start</text>", ">goal</text>"] {
            assert!(svg.contains(text), "{text}");
        }
    }
}
