//! An animation as one page: drawn by the browser, to be played, stopped and moved through by hand.

use crate::sheet::{Anchor, Place, markup};
use serde_json::{Value, json};

use crate::animation::{Animation, COLUMNS, LETTERS, RATE, STAYS};
use crate::marks::{DASHES, Mark};
use crate::scene::Around;
use crate::shown::{TOP, WIDTH};
use crate::style::{Ground, Role};

/// Steps in a millimetre: places are whole numbers of them.
const STEPS: f64 = 20.0;

impl Animation {
    /// The animation as an HTML page that needs no other file: with a button to play and pause and
    /// a slider over time, both for the keyboard too, light or dark as its reader has it, and
    /// standing still for readers who want less motion.
    #[must_use]
    pub fn to_html(&self) -> String {
        let shown = match self.scene.ground {
            Around::Plane { .. } => {
                "Rover, wheels, tracks and the soil's forces on the wheels, on a piece of the \
                 slope."
            }
            Around::Heights(_) => "Rover, its way and the ground's heights.",
        };
        let description = format!("Animation: {}. {shown}", self.title);
        let data = self.data().to_string().replace('<', "\\u003c");
        // A title may look like a place for something else: each place is filled in its own part.
        let (page, program) = include_str!("player.html").split_once("{data}").unwrap_or_default();
        let page = page.replace("{light}", &variables(Ground::Light));
        let page = page.replace("{dark}", &variables(Ground::Dark));
        let page = page.replace("{description}", &markup(&description));
        let page = page.replace("{title}", &markup(&self.title));
        format!("{page}{data}{program}")
    }

    fn data(&self) -> Value {
        let scene = &self.scene;
        let (legend, labels) = self.legend();
        let labels = scene.labels.iter().chain(&labels);
        let labels: Vec<Value> = labels
            .map(|label| {
                let [x, y] = label.at.map(steps);
                json!([label.text, x, y, align(label.anchor), place_of(label.role)])
            })
            .collect();
        let left: Vec<Value> =
            scene.left.iter().map(|(from, mark)| json!([from, numbers(mark)])).collect();
        let frames = scene.frames.iter().map(|frame| {
            let [x, y] = frame.offset.map(steps);
            json!([x, y, all(&frame.marks)])
        });
        let rows = self.rows.iter().map(|row| json!({ "name": row.name, "numbers": row.numbers }));
        let several = self.rows.len() > 1;
        let messages = self.rows.iter().filter_map(|row| {
            let (from, text) = row.outcome.as_ref()?;
            Some(if several {
                json!([from, format!("{}: {text}", row.name)])
            } else {
                json!([from, text])
            })
        });
        json!({
            "size": [steps(WIDTH), steps(scene.height)],
            "top": steps(TOP),
            "rate": RATE,
            "stays": STAYS,
            "dashes": DASHES.map(steps),
            "letters": steps(LETTERS),
            "light": colours(Ground::Light),
            "dark": colours(Ground::Dark),
            "paper": place_of(Role::Paper),
            "columns": COLUMNS,
            "rows": rows.collect::<Vec<_>>(),
            "clock": (0..self.len()).map(|index| self.clock(index)).collect::<Vec<_>>(),
            "messages": messages.collect::<Vec<_>>(),
            "window": points(&scene.window),
            "still": all(&scene.still),
            "left": left,
            "legend": all(&legend),
            "labels": labels,
            "frames": frames.collect::<Vec<_>>(),
        })
    }
}

fn align(anchor: Anchor) -> &'static str {
    match anchor {
        Anchor::Start => "left",
        Anchor::Middle => "center",
        Anchor::End => "right",
    }
}

fn all(marks: &[Mark]) -> Vec<Value> {
    marks.iter().filter(|mark| mark.points.len() > 1).map(numbers).collect()
}

/// A mark as the page's program reads it.
fn numbers(mark: &Mark) -> Value {
    let fill = mark.fill.map_or(-1, place_of);
    let (line, width, dashed) = mark
        .line
        .map_or((-1, 0, false), |line| (place_of(line.role), steps(line.width), line.dashed));
    let mut numbers = vec![fill, line, width, i64::from(dashed)];
    numbers.extend(points(&mark.points));
    numbers.into()
}

fn points(places: &[Place]) -> Vec<i64> {
    places.iter().flatten().map(|length| steps(*length)).collect()
}

/// Pictures are far less than a kilometre wide.
#[expect(clippy::cast_possible_truncation)]
fn steps(length: f64) -> i64 {
    (STEPS * length).round() as i64
}

fn place_of(role: Role) -> i64 {
    let place = Role::ALL.iter().position(|other| *other == role);
    place.and_then(|place| i64::try_from(place).ok()).unwrap_or(-1)
}

fn colours(ground: Ground) -> Vec<String> {
    let colour = |role: &Role| {
        let colour = role.on(ground);
        if colour.hides() == 1.0 {
            return colour.code();
        }
        let [red, green, blue] = colour.bytes();
        format!("rgba({red},{green},{blue},{})", colour.hides())
    };
    Role::ALL.iter().map(colour).collect()
}

/// The colours of the page around the picture.
fn variables(ground: Ground) -> String {
    let named = [
        ("paper", Role::Paper),
        ("ink", Role::Ink),
        ("faint", Role::Faint),
        ("grid", Role::Grid),
        ("force", Role::Message),
        ("thrust", Role::Thrust),
    ];
    named.map(|(name, role)| format!("--{name}: {};", role.on(ground).code())).join(" ")
}
