//! Runs as moving pictures: rovers on their slope, with a few numbers below.

use crate::png::Picture;
use crate::sheet::{Anchor, Face, Place, Sheet, Text, width};
use grouser_core::simulation::Outcome;
use rayon::prelude::*;

use crate::marks::{Line, Mark, arrow};
use crate::motion::Motion;
use crate::relief;
use crate::scene::{Actor, Label, Scene};
use crate::shown::{Shown, TOP, WIDTH};
use crate::step::round_step;
use crate::style::{Ground, Role};

/// Pictures in a second.
pub(crate) const RATE: f64 = 10.0;
/// The longest time for which an animation moves [s]; longer runs are shown faster than they are.
const LONGEST: f64 = 24.0;
/// How many pictures the last one stays for.
pub(crate) const STAYS: u16 = 20;
/// Height of what is drawn above the numbers of runs on planes [mm].
const SCENE: f64 = 88.0;
const MARGIN: f64 = 5.0;
/// Height of the letters on the scene [mm].
pub(crate) const LETTERS: f64 = 3.8;
/// Height of a row of numbers [mm].
const ROW: f64 = 6.6;

/// One run or several, as pictures in time.
///
/// Each picture of runs on planes has the rover on a piece of the slope, its tracks, the soil's
/// forces on its wheels, and a row of numbers. Over ground with heights it has the drawing of
/// [`relief_of`](crate::relief_of), the way behind the rover, and the same numbers; of several runs
/// each has its own view. Wheels turn and sink as recorded, and nothing is computed but where it is
/// drawn. The body is a likeness: a block with the inertia of the document's.
#[derive(Clone, Debug)]
pub struct Animation {
    pub(crate) title: String,
    pub(crate) actors: Vec<Actor>,
    pub(crate) rows: Vec<Row>,
    pub(crate) scene: Scene,
    /// Time of each picture since the start of the run [s].
    pub(crate) times: Vec<f64>,
    /// Seconds of the run in a second of the animation.
    pub(crate) speed: f64,
}

/// The numbers of a run.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) name: String,
    /// A row of [`COLUMNS`] for each picture.
    pub(crate) numbers: Vec<[String; 4]>,
    /// The picture from which on there is something to say of the outcome, and that.
    pub(crate) outcome: Option<(usize, String)>,
}

/// What the numbers are.
pub(crate) const COLUMNS: [&str; 4] = ["slip", "sinkage", "yaw", "downhill"];

impl Animation {
    /// * `title`: a line above the picture
    /// * `runs`: one at least, either all on planes, whose slope is that of the first, or all over
    ///   ground with heights
    ///
    /// # Panics
    ///
    /// If there is no run.
    #[must_use]
    pub fn of(title: &str, runs: &[Shown<'_>]) -> Self {
        let mut actors: Vec<Actor> = runs
            .iter()
            .map(|shown| Actor::new(Motion::of(shown.run, shown.scenario), shown.scenario))
            .collect();
        let end = actors.iter().map(|actor| actor.motion.end()).fold(0.0, f64::max);
        let speed = speed(end);
        let times = times(end, speed);
        let scene = if runs.iter().any(|shown| shown.scenario.ground.is_plane()) {
            let slope = runs[0].scenario.ground.plane_slope().unwrap_or(0.0);
            let area = [[MARGIN, TOP + 2.0], [WIDTH - 2.0 * MARGIN, SCENE - TOP - 4.0]];
            Scene::of(&mut actors, slope, &times, area)
        } else {
            relief::scene_of(&actors, runs, &times)
        };
        let row = |(actor, shown): (&Actor, &Shown<'_>)| Row {
            name: shown.name.to_owned(),
            numbers: times.iter().map(|&time| numbers(&actor.motion, time)).collect(),
            outcome: outcome(&shown.run.outcome).map(|(time, text)| {
                (times.partition_point(|at| *at < time).min(times.len() - 1), text)
            }),
        };
        let rows = actors.iter().zip(runs).map(row).collect();
        Self { title: title.to_owned(), actors, rows, scene, times, speed }
    }

    /// How many pictures there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Whether there is no picture: never.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// A picture.
    ///
    /// * `index`: below [`len`](Self::len)
    ///
    /// # Panics
    ///
    /// If there is no such picture.
    #[must_use]
    pub fn picture(&self, index: usize, ground: Ground) -> Sheet {
        let rows = self.rows.len() as f64;
        let height = self.scene.height + ROW * (rows + 1.0) + 1.0;
        let mut sheet = Sheet::new(&self.title, WIDTH, height).on(Role::Paper.on(ground));
        let scene = &self.scene;
        let frame = &scene.frames[index];
        for mark in &scene.still {
            mark.draw(&mut sheet, ground);
        }
        for (from, mark) in &scene.left {
            if *from <= index {
                let moved = mark.clone().moved(frame.offset);
                moved.within(&scene.window).iter().for_each(|it| it.draw(&mut sheet, ground));
            }
        }
        for mark in &frame.marks {
            mark.draw(&mut sheet, ground);
        }
        let write = Writer { ground };
        let (legend, labels) = self.legend();
        for mark in &legend {
            mark.draw(&mut sheet, ground);
        }
        for label in scene.labels.iter().chain(&labels) {
            write.text(&mut sheet, (&label.text, LETTERS, label.role), label.at, label.anchor);
        }
        write.heading(&mut sheet, self, index);
        write.numbers(&mut sheet, self, index);
        sheet
    }

    /// All pictures as pixels, in their order.
    pub(crate) fn pictures(
        &self,
        ground: Ground,
        pixels_per_mm: f64,
    ) -> impl Iterator<Item = Picture> + '_ {
        /// How many are computed at a time, and kept.
        const BATCH: usize = 16;
        (0..self.len()).step_by(BATCH).flat_map(move |start| {
            let batch = start..self.len().min(start + BATCH);
            let picture = |index| self.picture(index, ground).to_picture(pixels_per_mm);
            batch.into_par_iter().map(picture).collect::<Vec<_>>()
        })
    }

    /// The arrows' colours and scale, at the lower left.
    pub(crate) fn legend(&self) -> (Vec<Mark>, Vec<Label>) {
        let Some((force, length)) = self.scene.arrow else { return (Vec::new(), Vec::new()) };
        let rows =
            [(Role::Force, "soil's force on a wheel"), (Role::Thrust, "its part along the slope")];
        let step = 5.2;
        let mut y = self.scene.height - 3.0 - step * (rows.len() as f64);
        let (x, along) = (MARGIN, 8.0);
        let mut marks = Vec::new();
        let mut labels = Vec::new();
        let mut label = |text: String, x: f64, y: f64| {
            labels.push(Label::new(text, [x + 1.6, y], Anchor::Start));
        };
        for (role, text) in rows {
            marks.extend(arrow([x, y - 1.3], [along, 0.0], role, 0.75));
            label(text.to_owned(), x + along, y);
            y += step;
        }
        let line = Line::new(Role::Ink, 0.35);
        let (high, low, middle) = (y - 2.2, y - 0.4, y - 1.3);
        for points in [
            [[x, high], [x, low]],
            [[x, middle], [x + length, middle]],
            [[x + length, high], [x + length, low]],
        ] {
            marks.push(Mark::line(points, line));
        }
        label(format!("{force} N"), x + length, y);
        (marks, labels)
    }

    /// The time of a picture, in words.
    pub(crate) fn clock(&self, index: usize) -> String {
        format!("{:.1} s", self.times[index])
    }

    /// How much faster than the run it is shown; nothing where it is as fast.
    pub(crate) fn pace(&self) -> Option<String> {
        (self.speed != 1.0).then(|| format!("{} times as fast", self.speed))
    }

    /// What became of the rovers, as far as a picture shows it.
    pub(crate) fn message(&self, index: usize) -> Option<String> {
        let several = self.rows.len() > 1;
        let messages: Vec<String> = self
            .rows
            .iter()
            .filter_map(|row| row.outcome.as_ref().map(|outcome| (row, outcome)))
            .filter(|(_, (from, _))| *from <= index)
            .map(
                |(row, (_, text))| {
                    if several { format!("{}: {text}", row.name) } else { text.clone() }
                },
            )
            .collect();
        (!messages.is_empty()).then(|| messages.join("; "))
    }
}

/// How many seconds of a run go into one of the animation: 1, 2 or 5 times a power of ten.
fn speed(end: f64) -> f64 {
    round_step((end / LONGEST).max(1.0))
}

/// The times of pictures [s]: even, and the end.
fn times(end: f64, speed: f64) -> Vec<f64> {
    let step = speed / RATE;
    let even = (0..).map(|k| f64::from(k) * step).take_while(|time| *time < end - 1e-6 * step);
    even.chain([end]).collect()
}

/// What becomes of a rover that does not complete its run, and when [s].
fn outcome(outcome: &Outcome) -> Option<(f64, String)> {
    let time = outcome.time()?;
    let name = outcome.kind().in_words();
    let reason = outcome.reason().unwrap_or_default();
    Some((time, format!("{name} after {time:.1} s: {reason}")))
}

/// Mean slip and sinkage of the wheels, the yaw, and how far downhill the rover has come.
fn numbers(motion: &Motion, time: f64) -> [String; 4] {
    let pose = motion.at(time);
    let slip = pose.mean(|wheel| wheel.slip_ratio);
    let sinkage = 1e3 * pose.mean(|wheel| wheel.sinkage);
    let down = 1e3 * motion.way_down(time);
    let downhill = if down.abs() < 9999.5 {
        format!("{} mm", plain(down, 0))
    } else {
        format!("{} m", plain(1e-3 * down, 1))
    };
    [
        plain(slip, 2),
        format!("{} mm", plain(sinkage, 1)),
        format!("{}°", plain(pose.yaw.to_degrees(), 1)),
        downhill,
    ]
}

/// A number with digits after its point, and a minus that is one; no zero is negative.
fn plain(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let is_zero = !text.contains(|digit: char| digit.is_ascii_digit() && digit != '0');
    match text.strip_prefix('-') {
        Some(size) if is_zero => size.to_owned(),
        Some(size) => format!("−{size}"),
        None => text,
    }
}

struct Writer {
    ground: Ground,
}

impl Writer {
    fn text(
        &self,
        sheet: &mut Sheet,
        (text, size, role): (&str, f64, Role),
        at: Place,
        anchor: Anchor,
    ) {
        sheet.text(Text::new(text, size).colour(role.on(self.ground)).anchor(anchor), at);
    }

    fn bold(&self, sheet: &mut Sheet, (text, size): (&str, f64), at: Place, anchor: Anchor) {
        let text = Text::new(text, size).face(Face::Bold).colour(Role::Ink.on(self.ground));
        sheet.text(text.anchor(anchor), at);
    }

    fn heading(&self, sheet: &mut Sheet, animation: &Animation, index: usize) {
        let most = WIDTH - 2.0 * MARGIN;
        let (title, size) = fitted(&animation.title, Face::Bold, 4.8, most);
        self.bold(sheet, (&title, size), [MARGIN, 7.4], Anchor::Start);
        if let Some(message) = animation.message(index) {
            let (message, size) = fitted(&message, Face::Regular, 3.8, most);
            let at = [MARGIN, 13.0];
            self.text(sheet, (&message, size, Role::Message), at, Anchor::Start);
        }
    }

    fn numbers(&self, sheet: &mut Sheet, animation: &Animation, index: usize) {
        let under = animation.scene.height;
        let y = under + ROW - 1.4;
        let line = Line::new(Role::Grid, 0.3);
        let rule = [[MARGIN, under], [WIDTH - MARGIN, under]];
        Mark::line(rule, line).draw(sheet, self.ground);
        let several = animation.rows.len() > 1;
        let first = if several { 52.0 } else { 44.0 };
        let step = (WIDTH - MARGIN - first) / COLUMNS.len() as f64;
        let at = |column: usize| first + step * (column as f64 + 1.0);
        let pace = animation.pace().map(|pace| format!(", {pace}")).unwrap_or_default();
        let clock = animation.clock(index);
        let label = if several { format!("time {clock}{pace}") } else { format!("time{pace}") };
        self.text(sheet, (&label, 3.6, Role::Faint), [MARGIN, y], Anchor::Start);
        for (column, name) in COLUMNS.iter().enumerate() {
            self.text(sheet, (name, 3.6, Role::Faint), [at(column), y], Anchor::End);
        }
        for (place, row) in animation.rows.iter().enumerate() {
            let y = y + ROW * (place as f64 + 1.0);
            let name = if several { &row.name } else { &clock };
            let (name, size) = fitted(name, Face::Bold, 4.8, first - MARGIN + 4.0);
            self.bold(sheet, (&name, size), [MARGIN, y], Anchor::Start);
            for (column, number) in row.numbers[index].iter().enumerate() {
                self.bold(sheet, (number, 4.8), [at(column), y], Anchor::End);
            }
        }
    }
}

/// A text that is no wider than it may be: smaller, and if that is not enough, cut.
fn fitted(text: &str, face: Face, size: f64, most: f64) -> (String, f64) {
    let full = width(text, face, size);
    if full <= most {
        return (text.to_owned(), size);
    }
    let size = (size * most / full).max(0.65 * size);
    let mut cut = text.to_owned();
    while width(&format!("{cut}…"), face, size) > most && cut.pop().is_some() {}
    let cut = if cut.len() == text.len() { cut } else { format!("{}…", cut.trim_end()) };
    (cut, size)
}
