//! A heading map on a terminal: slopes down, courses across.

use grouser::contact::validity::Flag;
use grouser::document::columns::flags::FLAGS;
use grouser::document::columns::{COURSE, OK, SLIP_RATIO, SLOPE, STATUS, YAW};
use grouser::document::table::Table;

use crate::args::HeadingMapArgs;
use crate::output::rows::four_digits;
use crate::output::text::{Grid, Text};

/// For each soil and model a table of the yaw, and one of the slip ratio; then the reasons where no
/// heading holds a course, and the flags that any place has.
///
/// * `titles`: of soils and models, in the order of the rows
pub(super) fn text(table: &Table, args: &HeadingMapArgs, titles: &[String]) -> Text {
    let mut reasons = Reasons::default();
    let count = args.course_deg.0.len() * args.slope_deg.0.len();
    let parts = titles.iter().enumerate().map(|(place, title)| {
        let rows: Vec<usize> = (place * count..(place + 1) * count).collect();
        let part = table.rows_at(&rows);
        let mut quantities = vec![YAW.name.to_owned(), SLIP_RATIO.name.to_owned()];
        if args.uncertainty.sampling.uncertainty {
            let [_, _, high] = SLIP_RATIO.quantiles();
            quantities.push(high);
        }
        Text::blocks(quantities.iter().map(|name| {
            let title = format!(
                "{title}: {name} by {} (down) and {} (across, positive uphill)\n",
                SLOPE.name, COURSE.name
            );
            Text::from(title) + pivoted(&part, name, args, &mut reasons)
        }))
    });
    let tables = Text::blocks(parts);
    tables + reasons.lines() + flag_lines(table)
}

/// Why there are no numbers, each reason once.
#[derive(Default)]
struct Reasons(Vec<String>);

impl Reasons {
    /// What stands for a reason in the cells.
    fn mark(&mut self, reason: &str) -> String {
        let known = self.0.iter().position(|known| known == reason);
        let place = known.unwrap_or_else(|| {
            self.0.push(reason.to_owned());
            self.0.len() - 1
        });
        format!("[{}]", place + 1)
    }

    fn lines(&self) -> String {
        let lines = self.0.iter().enumerate();
        lines.map(|(place, reason)| format!("[{}] {reason}\n", place + 1)).collect()
    }
}

/// A quantity over slope and course; where no heading holds the course, the mark of the reason.
fn pivoted(part: &Table, name: &str, args: &HeadingMapArgs, reasons: &mut Reasons) -> Grid {
    let (courses, slopes) = (&args.course_deg.0, &args.slope_deg.0);
    let (numbers, statuses) = (part.numbers(name), part.texts(STATUS));
    let mut cell = |place: usize| match (numbers[place], statuses[place].as_deref()) {
        (Some(number), _) => three_digits(number),
        (None, Some(reason)) if reason != OK => reasons.mark(reason),
        (None, _) => "-".to_owned(),
    };
    let first = std::iter::once(SLOPE.name.to_owned());
    let header: Vec<String> = first.chain(courses.iter().map(|it| four_digits(*it))).collect();
    let row = |(place, slope): (usize, &f64)| {
        let mut cells = vec![four_digits(*slope)];
        cells.extend((0..courses.len()).map(|course| cell(course * slopes.len() + place)));
        cells
    };
    let rows: Vec<Vec<String>> = slopes.iter().enumerate().map(row).collect();
    Grid::new(&header, &rows)
}

/// A number with three significant digits: many stand side by side.
fn three_digits(value: f64) -> String {
    four_digits(format!("{value:.2e}").parse().unwrap_or(value))
}

/// The flags of a table, a line each: how many of its rows have them, and what they mean.
fn flag_lines(table: &Table) -> String {
    let all = table.words(FLAGS);
    let line = |flag: Flag| {
        let count = all.iter().filter(|names| names.contains(&flag.name())).count();
        let meaning = flag.rule().meaning;
        (count > 0)
            .then(|| format!("{} ({count} of {} places): {meaning}\n", flag.name(), all.len()))
    };
    Flag::ALL.into_iter().filter_map(line).collect()
}
