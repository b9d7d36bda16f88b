//! Maps north up: numbers in colours, and the ground in the light with ways over it.

mod picture;
mod ways;

pub use self::picture::map_picture;
pub use self::ways::{Track, ways_over_ground};

use grouser_core::terrain::ElevationGrid;
use grouser_core::units::Vec2;
use grouser_io::escape;

use crate::sheet::{Anchor, Place, Sheet, Text};
use crate::style::{Ground, Role};

/// Length of the longer side of the ground [mm].
const LENGTH: f64 = 140.0;
/// Where the ground begins, and room on the right of it and below it [mm].
const CORNER: Place = [5.0, 10.0];
const RIGHT: f64 = 50.0;
const BOTTOM: f64 = 9.0;
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

    /// Where a place [m] is on the page.
    fn at(&self, place: Vec2) -> Place {
        let (way, size) = (place - self.south_west, self.north_east - self.south_west);
        let [width, height] = self.size();
        [CORNER[0] + way.x / size.x * width, CORNER[1] + (1.0 - way.y / size.y) * height]
    }

    /// A page with the title above the ground and its corners below it.
    ///
    /// * `corners`: south-west and north-east [m], as they are written
    fn sheet(&self, title: &str, [low, high]: [Vec2; 2]) -> Sheet {
        let [width, height] = self.size();
        let title = escape::line(title);
        let size = [CORNER[0] + width + RIGHT, CORNER[1] + height + BOTTOM];
        let mut sheet = Sheet::new(&title, size[0], size[1]).on(Role::Paper.on(Ground::Light));
        sheet.text(text(&title, TITLE, Role::Ink), [CORNER[0], 6.5]);
        let round = |at: f64| ((at * 10.0).round() / 10.0 + 0.0).to_string().replace('-', "−");
        let corners = format!(
            "x {} … {} m, y {} … {} m",
            round(low.x),
            round(high.x),
            round(low.y),
            round(high.y)
        );
        sheet.text(text(&corners, LETTERS, Role::Faint), [CORNER[0], CORNER[1] + height + 5.5]);
        sheet
    }
}

fn text(content: &str, size: f64, role: Role) -> Text {
    Text::new(content, size).colour(role.on(Ground::Light)).anchor(Anchor::Start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scale::Scale;

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

    /// One of 15 places is not known and one is not a number.
    #[test]
    fn places_without_a_number_are_empty() {
        let number = |column: usize, row: usize| match (column, row) {
            (0, 0) => None,
            (1, 0) => Some(f64::NAN),
            _ => Some(if column < 3 { 0.0 } else { 1.0 }),
        };
        let scale = Scale::ramp(0.0, 1.0);
        let svg = map_picture("slope < [°]", &grid(5, 3), &number, &scale);
        roxmltree::Document::parse(&svg).unwrap();
        assert!(
            svg.contains("d=\"M0 0h3M0 1h3M2 2h1\"") && svg.contains("d=\"M3 0h2M3 1h2M3 2h2\"")
        );
        assert!(svg.contains(">slope &lt; [°]</text>") && svg.contains(">0.5</text>"));
        assert!(svg.contains(">x 100 … 108 m, y −50 … −48 m</text>"), "{svg}");
    }

    #[test]
    fn verdicts_have_their_words_beside_them() {
        let [green, red] = [0x00_9e73, 0xd5_5e00].map(crate::sheet::Colour::hex);
        let scale = Scale::words([(1.0, green, "go"), (2.0, red, "no-go")]);
        let svg =
            map_picture("verdict", &grid(2, 2), &|column, _| Some(1.0 + column as f64), &scale);
        assert!(svg.contains(">go</text>") && svg.contains(">no-go</text>"));
        assert!(svg.contains("stroke=\"#009e73\" d=\"M0 0h1M0 1h1\""), "{svg}");
    }

    #[test]
    fn ways_lie_on_their_ground_with_names() {
        let places = [Vec2::new(110.0, -45.0), Vec2::new(130.0, -40.0)];
        let tracks = [Track { name: "least <time>".into(), places: &places }];
        let flat = |_: usize, _: usize| Some(Vec2::zeros());
        let svg = ways_over_ground("Ways", &grid(50, 40), &flat, &tracks);
        roxmltree::Document::parse(&svg).unwrap();
        assert_eq!(svg.matches("<circle").count(), 2, "a ring for each place");
        for text in [">least &lt;time&gt;</text>", ">start</text>", ">goal</text>"] {
            assert!(svg.contains(text), "{text}");
        }
    }
}
