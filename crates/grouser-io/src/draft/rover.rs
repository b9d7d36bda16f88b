//! The draft of a rover from its data sheet.

use serde_json::{Value as Json, json};

use super::super::error::{DocumentError, Problem};
use super::super::kind::Kind;
use super::answers::{Answers, Usual, rounded};
use super::lines::Lines;
use grouser_core::vehicle::Inertia;
use grouser_core::vehicle::estimate::{self, Sizes};

pub(super) const KEYS: [&str; 15] = [
    "name",
    "source",
    TOTAL_MASS,
    AXLES,
    RADIUS,
    WIDTH,
    GROUSER_HEIGHT,
    GROUSER_COUNT,
    WHEELBASE,
    TRACK,
    CENTRE_HEIGHT,
    WHEEL_MASS,
    BODY[0],
    BODY[1],
    BODY[2],
];

const TOTAL_MASS: &str = "total_mass_kg";
const AXLES: &str = "axle_count";
const WHEELBASE: &str = "wheelbase_m";
const TRACK: &str = "track_m";
const CENTRE_HEIGHT: &str = "centre_of_mass_height_m";
const BODY: [&str; 3] = ["body_length_m", "body_width_m", "body_height_m"];
const WHEEL_MASS: &str = "wheel_unit.mass_kg";
/// The tables that the wheel's keys stand in.
const WHEEL: &str = "wheel_unit.wheel.";
const RADIUS: &str = "wheel_unit.wheel.radius_m";
const WIDTH: &str = "wheel_unit.wheel.width_m";
const GROUSER_HEIGHT: &str = "wheel_unit.wheel.grousers.height_m";
const GROUSER_COUNT: &str = "wheel_unit.wheel.grousers.count";

/// An example [kg], and its axles.
const USUAL_MASS: f64 = 10.0;
const USUAL_AXLES: u32 = 2;
/// A fit to the presets of rovers.
const FITTED: &str = "fitted to rovers that flew, which it meets within a factor of 2";

/// The usual value of a question.
pub(super) fn usual(answers: &Answers, key: &str) -> Usual {
    answers.usual_of_rover(key)
}

impl Answers {
    pub(super) fn usual_of_rover(&self, key: &str) -> Usual {
        let Sizes { wheelbase, track, wheel_radius, wheel_width } = self.sizes();
        match key {
            TOTAL_MASS => Usual::of(USUAL_MASS, "an example"),
            AXLES => Usual::of(
                USUAL_AXLES,
                "four wheels, as small rovers have; six are usual above some 100 kg",
            ),
            WHEELBASE => Usual::estimate(
                wheelbase,
                format!("0.24 m times the cube root of the mass in kg, {FITTED}"),
            ),
            TRACK => Usual::estimate(
                track,
                format!("0.23 m times the cube root of the mass in kg, {FITTED}"),
            ),
            RADIUS => {
                let factor = if self.wheels() <= 4 { "0.050" } else { "0.027" };
                Usual::estimate(
                    wheel_radius,
                    format!("{factor} m times the cube root of the mass in kg, {FITTED}"),
                )
            }
            WIDTH => {
                // Of the radius that was given, if one was.
                let (width, factor) =
                    (self.number(RADIUS) * wheel_width / wheel_radius, wheel_width / wheel_radius);
                Usual::estimate(
                    width,
                    format!("{factor:.1} times the radius, as on rovers that flew"),
                )
            }
            CENTRE_HEIGHT => {
                let height = estimate::centre_of_mass_height(
                    self.tip_radius(),
                    self.number(WHEELBASE),
                    self.number(TRACK),
                );
                Usual::estimate(
                    height,
                    "above the hubs by a fifth of the mean of wheelbase and track",
                )
            }
            WHEEL_MASS => Usual::estimate(
                estimate::wheel_mass(self.number(TOTAL_MASS), self.wheels()),
                "all wheels with their motors have a fifth of the mass",
            ),
            key if key == BODY[0] => Usual::of(self.number(WHEELBASE), "the wheelbase"),
            key if key == BODY[1] => Usual::of(self.number(TRACK), "the track"),
            key if key == BODY[2] => Usual::estimate(
                estimate::body_height(self.number(WHEELBASE), self.number(TRACK)),
                "two fifths of the mean of wheelbase and track",
            ),
            _ => match key.strip_prefix(WHEEL) {
                Some(key) => self.usual_of_wheel(key, WHEEL),
                None => Usual::left_out(""),
            },
        }
    }

    fn axles(&self) -> u32 {
        let given = self.given.get(AXLES).and_then(Json::as_u64);
        given.map_or(USUAL_AXLES, |count| u32::try_from(count).unwrap_or(u32::MAX))
    }

    fn wheels(&self) -> u32 {
        self.axles().saturating_mul(2)
    }

    fn sizes(&self) -> Sizes {
        let mass = self.given.get(TOTAL_MASS).and_then(Json::as_f64);
        estimate::sizes(mass.unwrap_or(USUAL_MASS), self.wheels())
    }

    fn tip_radius(&self) -> f64 {
        self.number(RADIUS) + self.number(GROUSER_HEIGHT)
    }

    /// What the document assumes, under the keys that follow from it.
    fn assumed(&self) -> Vec<String> {
        let places = [
            (TOTAL_MASS, "body.mass_kg"),
            (WHEEL_MASS, WHEEL_MASS),
            (RADIUS, RADIUS),
            (WIDTH, WIDTH),
            (GROUSER_HEIGHT, GROUSER_HEIGHT),
            (GROUSER_COUNT, GROUSER_COUNT),
            (AXLES, "mount"),
            (WHEELBASE, "mount.position_m"),
            (TRACK, "mount.position_m"),
            (CENTRE_HEIGHT, "mount.position_m"),
        ];
        let mut assumed: Vec<String> =
            places.iter().filter_map(|(key, of)| self.reason(key, of)).collect();
        assumed.push(
            "mount.position_m: the centre of mass midway between the first and the last \
                      axle, the axles evenly spaced"
                .to_owned(),
        );
        let sizes: Vec<String> =
            BODY.iter().filter_map(|key| self.reason(key, "body.inertia_kg_m2")).collect();
        assumed.extend(sizes);
        let [l, b, h] = BODY.map(|key| self.number(key));
        assumed.push(format!(
            "body.inertia_kg_m2: a uniform box of l = {l} m, b = {b} m, h = {h} m: m (b² + h²) / \
             12, m (l² + h²) / 12, m (l² + b²) / 12"
        ));
        assumed.push(
            "wheel_unit.inertia_kg_m2: a uniform cylinder of the wheel's radius r and \
                      width b: m (3 r² + b²) / 12, m r² / 2, m (3 r² + b²) / 12"
                .to_owned(),
        );
        assumed
    }

    pub(super) fn rover(&self) -> Result<String, DocumentError> {
        let (total, wheels, wheel_mass) =
            (self.number(TOTAL_MASS), self.wheels(), self.number(WHEEL_MASS));
        let in_wheels = f64::from(wheels) * wheel_mass;
        if in_wheels >= total {
            let problem =
                Problem::Malformed("the wheels weigh as much as the whole rover, or more");
            let hint = format!(
                "{wheels} wheels of {wheel_mass} kg are {in_wheels} kg, the rover has {total} kg"
            );
            return Err(DocumentError::whole(WHEEL_MASS.to_owned(), problem).with_hint(hint));
        }
        // Seven digits: the sum is the mass that was given.
        let body_mass: f64 =
            format!("{:.6e}", total - in_wheels).parse().unwrap_or(total - in_wheels);
        let size = BODY.map(|key| self.number(key));
        let (radius, width) = (self.number(RADIUS), self.number(WIDTH));

        let mut lines = Lines::new(
            Kind::Rover,
            "A rover of Grouser, from a data sheet: `assumed` has what was estimated, and how.",
        );
        lines.plain("name", &Json::from(self.text("name")));
        lines.plain("source", &Json::from(self.text("source")));
        lines.texts("assumed", &self.assumed());

        lines.table("[body]", "body");
        lines.key(
            "mass_kg",
            Some(&body_mass.into()),
            &format!("{total} kg less {wheels} wheels of {wheel_mass} kg"),
        );
        lines.key(
            "inertia_kg_m2",
            Some(&table_of(Inertia::of_uniform_box(body_mass, size))),
            "assumed",
        );

        lines.table("[wheel_unit]", "wheel_unit");
        lines.key("mass_kg", Some(&wheel_mass.into()), "");
        let inertia = Inertia::of_uniform_cylinder(wheel_mass, radius, width);
        lines.key("inertia_kg_m2", Some(&table_of(inertia)), "assumed");
        lines.table("[wheel_unit.wheel]", "wheel_unit.wheel");
        self.wheel_lines(&mut lines, WHEEL, "wheel_unit.wheel");
        self.mounts(&mut lines, total, in_wheels);
        Ok(lines.end())
    }

    /// The wheels in their places: down the left side, up the right.
    fn mounts(&self, lines: &mut Lines, total: f64, in_wheels: f64) {
        let height = self.number(CENTRE_HEIGHT);
        let hub = estimate::hub_height(total, in_wheels, height, self.tip_radius());
        let (wheelbase, track, axles) = (self.number(WHEELBASE), self.number(TRACK), self.axles());
        let axle = |place: u32| {
            let share = f64::from(place) / f64::from(axles - 1);
            (name_of_axle(place, axles), wheelbase * (0.5 - share))
        };
        let left = (0..axles).map(|place| (axle(place), "left", 0.5 * track));
        let right = (0..axles).rev().map(|place| (axle(place), "right", -0.5 * track));
        for (place, ((name, x), side, y)) in left.chain(right).enumerate() {
            lines.table("[[mount]]", "mount");
            lines.plain("name", &Json::from(format!("{name}-{side}")));
            let position = json!([in_micrometres(x), in_micrometres(y), in_micrometres(hub)]);
            if place == 0 {
                lines.key("position_m", Some(&position), "");
            } else {
                lines.plain("position_m", &position);
            }
        }
    }
}

fn table_of(Inertia { xx, yy, zz }: Inertia) -> Json {
    json!({ "xx": rounded(xx), "yy": rounded(yy), "zz": rounded(zz) })
}

/// A length without the digits that rounding leaves behind [m].
fn in_micrometres(length: f64) -> f64 {
    (length * 1e6).round() / 1e6 + 0.0
}

fn name_of_axle(place: u32, count: u32) -> String {
    match place {
        0 => "front".to_owned(),
        place if place + 1 == count => "rear".to_owned(),
        _ if count == 3 => "middle".to_owned(),
        place => format!("middle-{place}"),
    }
}
