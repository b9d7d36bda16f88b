//! Text on a terminal: tables fit its width, a reason stands once, verdicts have their colours.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use anstyle::{AnsiColor, Style};
use grouser::document::columns::STATUS;
use grouser::document::columns::card::VERDICT;
use grouser::document::columns::flags::FLAGS;
use grouser::document::escape;
use grouser::simulation::{OutcomeKind, Severity};

use super::text::{Grid, Part, Text};

/// What a terminal, or what stands for one, can show.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Screen {
    /// Characters in a line; none where lines have any length.
    pub(super) width: Option<usize>,
    /// Whether there are colours.
    pub(super) has_colours: bool,
}

const GOOD: Style = AnsiColor::Green.on_default();
const CAUTION: Style = AnsiColor::Yellow.on_default();
const BAD: Style = AnsiColor::Red.on_default();
const HEADER: Style = Style::new().bold();
const ERROR: Style = BAD.bold();
const NOTE: Style = CAUTION.bold();
const HINT: Style = AnsiColor::Cyan.on_default().bold();

/// Words that begin a line, and their colours; names of outcomes do, too.
const LABELS: [(&str, Style); 4] =
    [("error:", ERROR), ("interrupted:", ERROR), ("note:", NOTE), ("hint:", HINT)];

/// A longer cell of a column of reasons stands under the table.
const LONG_REASON: usize = 14;
/// A column of prose is wrapped down to so many characters, before columns are left out.
const LEAST_PROSE: usize = 24;
/// Between two columns.
const GAP: &str = "  ";

impl Screen {
    /// A text in this width and these colours. What steers a terminal is written out first.
    pub(super) fn show(&self, text: &Text) -> String {
        let parts = text.0.iter().map(|part| match (part, self.width) {
            (Part::Words(words), Some(width)) => self.words(&in_lines(words, width)),
            (Part::Words(words), None) => self.words(words),
            (Part::Grid(grid), Some(width)) => self.fitted(grid, width),
            (Part::Grid(grid), None) => self.plain(grid),
        });
        parts.collect()
    }

    /// Words, with colours where a line begins with a label.
    pub(super) fn words(&self, words: &str) -> String {
        let shown = escape::visible(words);
        if !self.has_colours {
            return shown.into_owned();
        }
        let paint = |line: &str| match label_of(line) {
            Some((label, style)) => self.painted(label, style) + &line[label.len()..],
            None => line.to_owned(),
        };
        shown.split_inclusive('\n').map(paint).collect()
    }

    fn painted(&self, text: &str, style: Style) -> String {
        if self.has_colours && style != Style::new() {
            format!("{style}{text}{style:#}")
        } else {
            text.to_owned()
        }
    }

    /// A table in its whole width.
    fn plain(&self, grid: &Grid) -> String {
        let columns: Vec<Column> =
            (0..grid.header.len()).map(|place| Column::of(grid, place)).collect();
        self.lines(&columns) + &notes_of(grid)
    }

    /// A table in the width of the terminal: reasons and names stand under it, headers on several
    /// lines; then prose is wrapped, and at last columns are left out.
    fn fitted(&self, grid: &Grid, width: usize) -> String {
        let (grid, notes) = with_marks(grid);
        let mut columns: Vec<Column> =
            (0..grid.header.len()).map(|place| Column::of(&grid, place)).collect();
        if width_of(&columns) > width {
            columns.iter_mut().for_each(Column::stack_header);
        }
        wrap_prose(&mut columns, width);
        let left_out = leave_out(&mut columns, width);
        let mut text = self.lines(&columns);
        if !left_out.is_empty() {
            let names = left_out.join(", ");
            let line =
                format!("not shown in {width} columns, but in a wider terminal or a pipe: {names}");
            let _ = writeln!(text, "{}", wrapped(&line, width, "  "));
        }
        for note in notes {
            let _ = writeln!(text, "{}", wrapped(&note, width, "    "));
        }
        text
    }

    fn lines(&self, columns: &[Column]) -> String {
        let rows = columns.first().map_or(0, |column| column.cells.len());
        let mut text = String::new();
        self.row(&mut text, columns, |column| (&column.header, HEADER));
        for row in 0..rows {
            self.row(&mut text, columns, |column| {
                (&column.cells[row], style_of(column, &column.cells[row]))
            });
        }
        text
    }

    /// A row, which may have several lines.
    fn row<'c>(
        &self,
        text: &mut String,
        columns: &'c [Column],
        cell: impl Fn(&'c Column) -> (&'c Vec<String>, Style),
    ) {
        let height = columns.iter().map(|column| cell(column).0.len()).max().unwrap_or(0);
        for line in 0..height {
            let mut shown = String::new();
            let mut blank = 0;
            for column in columns {
                let (lines, style) = cell(column);
                let piece = lines.get(line).map_or("", String::as_str);
                let space = column.width() - piece.chars().count();
                let (before, after) = if column.is_numeric { (space, 0) } else { (0, space) };
                if piece.is_empty() {
                    blank += before + after;
                } else {
                    let _ = write!(shown, "{:1$}", "", blank + before);
                    shown.push_str(&self.painted(piece, style));
                    blank = after;
                }
                blank += GAP.len();
            }
            text.push_str(&shown);
            text.push('\n');
        }
    }
}

/// The label with which a line begins, and its colour: a word of messages, or what became of a run.
fn label_of(line: &str) -> Option<(&str, Style)> {
    let of_messages = LABELS.iter().find(|(label, _)| line.starts_with(label)).copied();
    of_messages.or_else(|| {
        let (name, rest) = line.split_once(' ')?;
        let kind = OutcomeKind::of_name(name).filter(|_| rest.starts_with(AFTER))?;
        Some((&line[..name.len() + 1 + AFTER.len()], colour_of(kind.row().severity)))
    })
}

/// What follows an outcome that begins a line.
const AFTER: &str = "after";

/// The colour of an outcome.
fn colour_of(severity: Severity) -> Style {
    match severity {
        Severity::Good => GOOD,
        Severity::Stopped => CAUTION,
        Severity::Stuck | Severity::Lost => BAD,
    }
}

/// The colour of a cell: its words say the same. What is as it should be has none, so that the rest
/// is seen.
fn style_of(column: &Column, cell: &[String]) -> Style {
    let words = cell.first().map_or("", String::as_str);
    if let Some(kind) = OutcomeKind::of_name(words) {
        let severity = kind.row().severity;
        return if severity == Severity::Good { Style::new() } else { colour_of(severity) };
    }
    match words {
        "go" => GOOD,
        "caution" => CAUTION,
        "no_go" | "cannot_tell" => BAD,
        "-" | "ok" => Style::new(),
        _ if column.name == STATUS => BAD,
        _ if column.name == FLAGS => CAUTION,
        _ if words.starts_with('[') => BAD,
        _ => Style::new(),
    }
}

/// A column with the lines of its cells.
struct Column {
    name: String,
    header: Vec<String>,
    cells: Vec<Vec<String>>,
    is_numeric: bool,
}

impl Column {
    fn of(grid: &Grid, place: usize) -> Self {
        let is_number = |cell: &str| cell == "-" || is_mark(cell) || cell.parse::<f64>().is_ok();
        let name = &grid.header[place];
        let is_words = [STATUS, FLAGS].contains(&name.as_str());
        Self {
            name: name.clone(),
            header: vec![name.clone()],
            cells: grid.rows.iter().map(|row| vec![row[place].clone()]).collect(),
            is_numeric: !is_words && grid.rows.iter().all(|row| is_number(&row[place])),
        }
    }

    fn width(&self) -> usize {
        let lines = self.header.iter().chain(self.cells.iter().flatten());
        lines.map(|line| line.chars().count()).max().unwrap_or(0)
    }

    fn cell_width(&self) -> usize {
        self.cells.iter().flatten().map(|line| line.chars().count()).max().unwrap_or(0)
    }

    /// The header on several lines, parted at its underscores, where that makes the column
    /// narrower.
    fn stack_header(&mut self) {
        let pieces = pieces_of(&self.name);
        let longest = pieces.iter().map(|piece| piece.chars().count()).max().unwrap_or(0);
        let most = longest.max(self.cell_width());
        let mut lines: Vec<String> = vec![String::new()];
        for piece in pieces {
            let last = lines.len() - 1;
            if !lines[last].is_empty() && lines[last].chars().count() + piece.chars().count() > most
            {
                lines.push(piece);
            } else {
                lines[last].push_str(&piece);
            }
        }
        self.header = lines;
    }

    /// Whether its cells are sentences.
    fn is_prose(&self) -> bool {
        let is_sentence = |line: &String| line.chars().count() > LEAST_PROSE && line.contains(' ');
        self.cells.iter().flatten().any(is_sentence)
    }

    fn wrap(&mut self, width: usize) {
        for cell in &mut self.cells {
            let text = cell.join(" ");
            *cell = wrapped(&text, width, "").split('\n').map(str::to_owned).collect();
        }
    }

    /// Whether it stays, however narrow the terminal.
    fn is_kept(&self) -> bool {
        [STATUS, FLAGS, VERDICT].contains(&self.name.as_str())
    }
}

/// A name in pieces that end in underscores; `p97_5` is one number.
fn pieces_of(name: &str) -> Vec<String> {
    let mut pieces: Vec<String> = Vec::new();
    for piece in name.split_inclusive('_') {
        match pieces.last_mut() {
            Some(last) if piece.starts_with(|first: char| first.is_ascii_digit()) => {
                last.push_str(piece);
            }
            _ => pieces.push(piece.to_owned()),
        }
    }
    pieces
}

fn width_of(columns: &[Column]) -> usize {
    let widths: usize = columns.iter().map(Column::width).sum();
    widths + GAP.len() * columns.len().saturating_sub(1)
}

/// Wraps the widest column of prose until the table fits, or all are as narrow as they may be.
fn wrap_prose(columns: &mut [Column], width: usize) {
    loop {
        let excess = width_of(columns).saturating_sub(width);
        let widest = columns.iter_mut().filter(|column| column.is_prose());
        let Some(widest) = widest.max_by_key(|column| column.width()) else { return };
        let now = widest.width();
        if excess == 0 || now <= LEAST_PROSE {
            return;
        }
        // Never narrower than half of what it was: the next turn looks for the widest again.
        widest.wrap(now.saturating_sub(excess).max(now / 2).max(LEAST_PROSE));
        if widest.width() >= now {
            return;
        }
    }
}

/// Takes columns away from the right until the rest fits, and returns their names in the order of
/// the table.
fn leave_out(columns: &mut Vec<Column>, width: usize) -> Vec<String> {
    let mut names = Vec::new();
    while width_of(columns) > width {
        // The first column says what a row is of.
        let Some(last) = columns.iter().skip(1).rposition(|column| !column.is_kept()) else {
            break;
        };
        names.insert(0, columns.remove(last + 1).name);
    }
    names
}

/// The table with marks such as `[1]` in place of what a note says, and the notes.
fn with_marks(grid: &Grid) -> (Grid, Vec<String>) {
    let mut marked = grid.clone();
    let mut notes: Vec<String> = Vec::new();
    for row in &mut marked.rows {
        for column in &grid.reasons {
            let cell = &mut row[*column];
            if cell.chars().count() > LONG_REASON && cell.contains(' ') {
                *cell = format!("[{}]", place_of(&mut notes, cell));
            }
        }
        if let Some(cell) = grid.names.map(|column| &mut row[column]) {
            let names = cell.split(grouser::document::table::BETWEEN_NAMES);
            let notes_of = |name: &str| grid.notes.iter().find(|(known, _)| known == name);
            let places: BTreeSet<usize> = names
                .filter_map(notes_of)
                .map(|(name, meaning)| place_of(&mut notes, &format!("{name}: {meaning}")))
                .collect();
            if !places.is_empty() {
                *cell = mark_of(&places);
            }
        }
    }
    let lines = notes.iter().enumerate().map(|(place, note)| format!("[{}] {note}", place + 1));
    (marked, lines.collect())
}

/// The number of a note, counted from one.
fn place_of(notes: &mut Vec<String>, note: &str) -> usize {
    if let Some(place) = notes.iter().position(|known| known == note) {
        return place + 1;
    }
    notes.push(note.to_owned());
    notes.len()
}

/// `[1-3,5]` for 1, 2, 3 and 5.
fn mark_of(places: &BTreeSet<usize>) -> String {
    let places: Vec<usize> = places.iter().copied().collect();
    let runs = places.chunk_by(|one, next| *next == one + 1).map(|run| match run {
        [one] => one.to_string(),
        [first, .., last] if run.len() > 2 => format!("{first}-{last}"),
        [first, .., last] => format!("{first},{last}"),
        [] => String::new(),
    });
    format!("[{}]", runs.collect::<Vec<_>>().join(","))
}

fn is_mark(cell: &str) -> bool {
    let inner = cell.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
    inner.is_some_and(|inner| inner.parse::<usize>().is_ok())
}

fn notes_of(grid: &Grid) -> String {
    grid.notes.iter().map(|(name, meaning)| format!("{name}: {meaning}\n")).collect()
}

/// Words of several lines, those that are longer than the terminal's broken at blanks.
fn in_lines(words: &str, width: usize) -> String {
    let broken = |line: &str| match line.strip_suffix('\n') {
        Some(inner) if inner.chars().count() > width => wrapped(inner, width, "    ") + "\n",
        _ => line.to_owned(),
    };
    words.split_inclusive('\n').map(broken).collect()
}

/// A text in lines of some characters, broken at its blanks; a word that is longer than a line
/// stays whole.
///
/// * `indent`: before all lines but the first
fn wrapped(text: &str, width: usize, indent: &str) -> String {
    let mut shown = String::new();
    let mut used = 0;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if used > 0 && used + 1 + length > width {
            shown.push('\n');
            shown.push_str(indent);
            used = indent.chars().count();
        } else if used > 0 {
            shown.push(' ');
            used += 1;
        }
        shown.push_str(word);
        used += length;
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Grid {
        let header = ["slope_deg", "yaw_deg", "energy_j_per_m", STATUS, FLAGS].map(str::to_owned);
        let long = "no heading holds the contour: too steep";
        let rows = [
            ["5", "2.1", "6.157", "ok", "-"],
            ["10", "5.0", "7.188", "ok", "flag-a;flag-b"],
            ["25", "-", "-", long, "flag-b"],
            ["30", "-", "-", long, "flag-b"],
        ];
        let notes = [("flag-a", "Meaning of a."), ("flag-b", "Meaning of b.")];
        let notes = notes.map(|(name, meaning)| (name.to_owned(), meaning.to_owned()));
        Grid::new(&header, &rows.map(|row| row.map(str::to_owned).to_vec()))
            .with_reasons([3])
            .with_notes(4, notes.to_vec())
    }

    fn shown(width: Option<usize>) -> String {
        Screen { width, has_colours: false }.show(&grid().into())
    }

    /// Without a width a screen shows what a pipe gets.
    #[test]
    fn without_a_width_text_stays_plain() {
        assert_eq!(shown(None), Text::from(grid()).to_string());
    }

    #[test]
    fn a_reason_and_a_flag_stand_once() {
        assert_eq!(
            shown(Some(80)),
            "slope_deg  yaw_deg  energy_j_per_m  status  flags\n\
             \x20       5      2.1           6.157  ok      -\n\
             \x20      10      5.0           7.188  ok      [1,2]\n\
             \x20      25        -               -  [3]     [2]\n\
             \x20      30        -               -  [3]     [2]\n\
             [1] flag-a: Meaning of a.\n\
             [2] flag-b: Meaning of b.\n\
             [3] no heading holds the contour: too steep\n"
        );
    }

    /// Every line fits, whatever the width, as long as the kept columns do.
    #[test]
    fn tables_fit_the_width() {
        for width in 24..90 {
            let text = shown(Some(width));
            for line in text.lines() {
                assert!(line.chars().count() <= width, "{width}: {line}");
            }
            assert!(text.contains("slope_"), "{width}: {text}");
        }
        let narrow = shown(Some(24));
        assert!(narrow.contains("or a pipe:\n  yaw_deg,\n  energy_j_per_m\n"), "{narrow}");
    }

    #[test]
    fn prose_is_wrapped_before_columns_are_left_out() {
        let long = "a title that goes on and on over a whole line of a terminal".to_owned();
        let header = ["name", "title"].map(str::to_owned);
        let grid = Grid::new(&header, &[vec!["sand".to_owned(), long]]);
        let text = Screen { width: Some(40), has_colours: false }.show(&grid.into());
        assert_eq!(
            text,
            "name  title\n\
             sand  a title that goes on and on over a\n\
             \x20     whole line of a terminal\n"
        );
    }

    /// The colours are the only difference.
    #[test]
    fn colours_change_no_word() {
        let text = Text::from(grid()) + "note: a note\nhint: a hint\n";
        let plain = Screen { width: Some(60), has_colours: false }.show(&text);
        let coloured = Screen { width: Some(60), has_colours: true }.show(&text);
        assert!(coloured.contains("\u{1b}[1m\u{1b}[33mnote:\u{1b}[0m a note"), "{coloured:?}");
        assert_eq!(anstream::adapter::strip_str(&coloured).to_string(), plain);
    }

    /// A text from outside cannot bring colours of its own.
    #[test]
    fn outside_text_steers_nothing() {
        let header = ["\u{1b}[31mname".to_owned()];
        let grid = Grid::new(&header, &[vec!["\u{1b}[2J".to_owned()]]);
        let text = Text::from(grid) + "\u{1b}[31mwords\n";
        let shown = Screen { width: Some(60), has_colours: false }.show(&text);
        assert!(!shown.contains('\u{1b}'), "{shown:?}");
    }
}
