//! From a document to the domain's value: numbers by the rows of its table, in SI units and
//! radians, and the checks of values against each other.

mod mission;

pub(crate) use mission::check_stops;

use std::ops::RangeInclusive;
use std::sync::Arc;

use super::campaign::{Settings, Stand};
use super::describe::campaign::{BLANK_STAND, CAMPAIGN, STAND};
use super::describe::power::{MOTOR, NO_MOTOR};
use super::describe::run::{ROVER_OF_PARTS, SLOPE, TERRAIN};
use super::describe::scenario::SCENARIO;
use super::describe::soil::{LARGEST_EXIT_RATIO, LARGEST_EXPONENT, SMALLEST_EXPONENT, SOIL};
use super::describe::terrain::START;
use super::describe::wheel::WHEEL;
use super::describe::{rover, scenario, soil, wheel};
use super::document::Document;
use super::error::{DocumentError, Problem};
use super::field::Inner;
use super::given_file::NamedFiles;
use super::kind::Kind;
use super::priors;
use super::raster_file::key;
use super::terrain_file::{self, spans};
use super::tree::Node;
use super::unit::DEG;
use grouser_core::contact::validity;
use grouser_core::error::ParameterError;
use grouser_core::simulation::{PrescribedYaw, Scenario, TooFast};
use grouser_core::soil::{AssumedValues, Exit, PressureSinkage, Shear, ShearModulus, Soil, Span};
use grouser_core::terrain::{Extent, Shape};
use grouser_core::units::Vec2;
use grouser_core::vehicle::{Inertia, LoadSharing, Motor, Mount, OwnMoments, Rover};
use grouser_core::wheel::Wheel;

/// Values that are valid one by one, but not together.
#[derive(Debug)]
pub struct Misfit {
    /// The key of the document, inside this one, that they stand in; nothing for this one itself.
    part: &'static str,
    /// The key, or table, that they stand in.
    path: String,
    /// What is wrong with them.
    pub problem: Box<Problem>,
    hint: Option<String>,
}

impl Misfit {
    fn new(path: impl Into<String>, problem: impl Into<Problem>) -> Self {
        Self { part: "", path: path.into(), problem: Box::new(problem.into()), hint: None }
    }

    /// For `map_err` of a check of what stands at a key.
    fn at(path: &'static str) -> impl Fn(ParameterError) -> Self {
        move |error| Self::new(path, error)
    }

    fn of_no_number(path: &str, number: f64) -> Self {
        let expected = "left out: this document has no such number";
        Self::new(path, ParameterError::new(format!("`{path}`"), number, expected))
    }

    fn with_hint(self, hint: impl Into<String>) -> Self {
        Self { hint: Some(hint.into()), ..self }
    }

    fn within(self, part: &'static str) -> Self {
        Self { part, ..self }
    }

    /// The same, of what stands at a dotted key.
    fn below(self, key: &str) -> Self {
        Self { path: format!("{key}.{}", self.path), ..self }
    }

    /// How they may be mended.
    pub(crate) fn hint(self) -> Option<String> {
        self.hint
    }

    /// What is wrong with the numbers of a value that was one.
    #[must_use]
    pub fn of_numbers(self) -> ParameterError {
        match *self.problem {
            Problem::Unfit(error) => error,
            _ => unreachable!("new numbers leave words and names as they were"),
        }
    }

    /// The same where it was written.
    pub(crate) fn of(self, tree: &Node) -> DocumentError {
        let node = tree.entry(self.part).map_or(tree, |entry| &entry.node);
        DocumentError::at(node.origin_of(&self.path), *self.problem).with_hint(self.hint)
    }
}

/// A domain's value that a table describes.
pub trait Described: Clone + 'static {
    /// The rows of its documents.
    fn table() -> &'static dyn Inner<Self>;

    /// The value before its numbers are put in.
    fn blank() -> Self;

    /// Takes over what follows from several keys of the document.
    fn follow(&mut self, _document: &Document) {}

    /// Takes over what stands in files that the document names, and gives what is odd about them.
    ///
    /// * `tree`: the document as it was written
    ///
    /// # Errors
    /// [`DocumentError`] for a file that is not what it should be.
    fn fetch(&mut self, _document: &Document, _tree: &Node) -> Result<NamedFiles, DocumentError> {
        Ok(NamedFiles::default())
    }

    /// What a document means, with what stands in files that it names, all of it in force; and what
    /// there is to say of these files.
    ///
    /// * `tree`: the document as it was written
    ///
    /// # Errors
    /// [`DocumentError`] for files that are wrong, and values that do not go together.
    fn read(document: &Document, tree: &Node) -> Result<(Self, NamedFiles), DocumentError> {
        let mut value = Self::of(document);
        let files = value.fetch(document, tree)?;
        Ok((value.settled().map_err(|misfit| misfit.of(tree))?, files))
    }

    /// The value, all of it in force.
    ///
    /// # Errors
    /// [`Misfit`] for values that do not go together.
    fn settled(self) -> Result<Self, Misfit>;

    /// What a document means, not yet [`settled`](Self::settled).
    #[must_use]
    fn of(document: &Document) -> Self {
        let mut value = Self::blank();
        Self::table().put(&mut value, document.keys());
        value.follow(document);
        value
    }

    /// What the number under a dotted key may be, in the key's unit; nothing for what leads to
    /// none.
    fn range(&self, path: &str) -> Option<RangeInclusive<f64>> {
        Self::table().reach(&mut self.clone(), path).map(|reached| reached.range())
    }

    /// Checks a number under a dotted key that leads to none in this value.
    ///
    /// # Errors
    /// [`Misfit`] unless the number changes nothing.
    fn check_without(&self, path: &str, number: f64) -> Result<(), Misfit> {
        Err(Misfit::of_no_number(path, number))
    }

    /// The same with other values of some keys, in the keys' units.
    ///
    /// # Errors
    /// [`Misfit`] if the new values do not go together.
    fn with<'k>(&self, values: impl IntoIterator<Item = (&'k str, f64)>) -> Result<Self, Misfit> {
        let mut value = self.clone();
        for (path, number) in values {
            match Self::table().reach(&mut value, path) {
                Some(reached) => reached.set(number),
                None => value.check_without(path, number)?,
            }
        }
        value.settled()
    }
}

impl Described for Soil {
    fn table() -> &'static dyn Inner<Self> {
        &SOIL
    }

    fn blank() -> Self {
        soil::BLANK
    }

    fn follow(&mut self, document: &Document) {
        self.domain.assumed_values = assumed_values(Some(document));
    }

    fn settled(mut self) -> Result<Self, Misfit> {
        share_angle_limit(&mut self.shear);
        self.domain.check().map_err(Misfit::at("domain"))?;
        self.check_pressure_sinkage().map_err(Misfit::at("pressure_sinkage"))?;
        check_moduli(&self).map_err(Misfit::at("pressure_sinkage"))?;
        check_exponent(self.pressure_sinkage).map_err(Misfit::at("pressure_sinkage"))?;
        self.shear.check().map_err(Misfit::at("shear"))?;
        self.small_wheel.check().map_err(Misfit::at("small_wheel"))?;
        self.rft.check().map_err(Misfit::at("rft"))?;
        check_exit(self.exit).map_err(Misfit::at("exit"))?;
        self.check().map_err(Misfit::at("schema"))?;
        Ok(self)
    }
}

/// How many values of a soil stand in for ones that its document does not state, of those that each
/// model uses.
fn assumed_values(soil: Option<&Document>) -> AssumedValues {
    let assumed = soil.map_or_else(Vec::new, priors::assumed);
    // Each has the beginnings of the keys that a model leaves aside.
    let but = |left_aside: &[&str]| {
        let is_used = |key: &str| !left_aside.iter().any(|start| key.starts_with(start));
        let count = assumed.iter().filter(|it| is_used(&it.key)).count();
        u32::try_from(count).unwrap_or(u32::MAX)
    };
    AssumedValues {
        ishigami: but(&["small_wheel.", "rft."]),
        bekker: but(&["small_wheel.", "rft.", "exit.", "stress_peak.", "constant_volume_share"]),
        small_wheel: but(&["rft."]),
        rft: but(&[
            "small_wheel.",
            "exit.",
            "stress_peak.",
            "shear.",
            "bulldozing.",
            "cohesion_kpa",
            "constant_volume_share",
            "pressure_sinkage.",
        ]),
    }
}

/// A document has one limit for both axes.
fn share_angle_limit(shear: &mut Shear) {
    if let Shear::Anisotropic {
        longitudinal: ShearModulus::Quadratic { angle_limit: shared, .. },
        lateral: ShearModulus::Quadratic { angle_limit, .. },
    } = shear
    {
        *angle_limit = *shared;
    }
}

/// Checks that Bekker's moduli are not a thousandth or millionth of a soil's: by their sum, and
/// where one is negative by the stiffness over the widths for which they hold.
fn check_moduli(soil: &Soil) -> Result<(), ParameterError> {
    let PressureSinkage::Bekker { k_c, k_phi, .. } = soil.pressure_sinkage else { return Ok(()) };
    let least = *validity::DOUBTFUL_MODULUS.start();
    let (name, value) = if soil.pressure_sinkage.has_negative_modulus() {
        let Span { low, high } = soil.domain.width;
        let softest = f64::min(k_c / low + k_phi, k_c / high + k_phi);
        ("the least stiffness k_c/b + k_phi over `domain.width_m`, in N/m^(n+2),", softest)
    } else {
        ("the moduli k_c and k_phi together, in N/m^(n+1) and N/m^(n+2),", k_c + k_phi)
    };
    if value >= least {
        return Ok(());
    }
    Err(ParameterError::new(name, value, "at least 10: in kN they are k_c_kn and k_phi_kn"))
}

/// Checks that n stays in its range at every slip: it is linear, so its ends suffice.
fn check_exponent(law: PressureSinkage) -> Result<(), ParameterError> {
    let (PressureSinkage::Reece { exponent, .. } | PressureSinkage::Bekker { exponent, .. }) = law;
    for slip_ratio in [-1.0, 1.0] {
        let n = exponent.at(slip_ratio);
        if !(SMALLEST_EXPONENT..=LARGEST_EXPONENT).contains(&n) {
            let name = format!("the sinkage exponent n at a slip ratio of {slip_ratio}");
            return Err(ParameterError::new(name, n, "0.3 to 3"));
        }
    }
    Ok(())
}

/// Checks that λ stays in its range at every slip.
fn check_exit(exit: Exit) -> Result<(), ParameterError> {
    for percent in 0..=100 {
        let slip_ratio = f64::from(percent) / 100.0;
        let ratio = exit.ratio(slip_ratio);
        if ratio > LARGEST_EXIT_RATIO {
            let name = format!("the wheel sinkage ratio at a slip ratio of {slip_ratio}");
            return Err(ParameterError::new(name, ratio, "0 to 1.5"));
        }
    }
    Ok(())
}

impl Described for Wheel {
    fn table() -> &'static dyn Inner<Self> {
        &WHEEL
    }

    fn blank() -> Self {
        wheel::BLANK
    }

    fn settled(self) -> Result<Self, Misfit> {
        self.check().map_err(Misfit::at(""))?;
        Ok(self)
    }
}

impl Described for Motor {
    fn table() -> &'static dyn Inner<Self> {
        &MOTOR
    }

    fn blank() -> Self {
        NO_MOTOR
    }

    fn settled(self) -> Result<Self, Misfit> {
        self.check().map_err(Misfit::at(""))?;
        Ok(self)
    }
}

impl Described for Rover {
    fn table() -> &'static dyn Inner<Self> {
        &ROVER_OF_PARTS
    }

    fn blank() -> Self {
        Self::draft(rover::BLANK)
    }

    fn settled(self) -> Result<Self, Misfit> {
        check_names(&self)?;
        check_steering(&self)?;
        check_suspension(&self)?;
        // Masses and lengths are in their ranges by now: what can still be wrong is the stance.
        let place = uneven_mount(&self);
        let rover = self.checked().map_err(|error| Misfit::new(place, error))?;
        check_places(&rover)?;
        check_inertias(&rover)?;
        Ok(rover)
    }
}

/// Checks that rockers have the wheels that they can carry.
fn check_suspension(rover: &Rover) -> Result<(), Misfit> {
    let parts = rover.parts();
    let Some(suspension) = parts.suspension else { return Ok(()) };
    suspension.check(&parts.complete_mounts()).map_err(|error| {
        Misfit::new("suspension", error).with_hint(
            "rockers carry two wheels on a side, with [suspension.bogie] three; without \
             [suspension] the wheels are rigidly joined",
        )
    })
}

/// Checks that the wheels' names differ: columns and messages use them.
fn check_names(rover: &Rover) -> Result<(), Misfit> {
    let mounts = &rover.parts().mounts;
    for (index, mount) in mounts.iter().enumerate() {
        if mounts[..index].iter().any(|other| other.name == mount.name) {
            let key = format!("mount.{index}.name");
            let name = mount.name.escape_debug().to_string();
            return Err(Misfit::new(key.clone(), Problem::RepeatedName { key, name }));
        }
    }
    Ok(())
}

/// Checks that wheels are turned no further than they can be, and that only those that are steered
/// have numbers of steering.
fn check_steering(rover: &Rover) -> Result<(), Misfit> {
    let parts = rover.parts();
    for (index, (mount, complete)) in parts.mounts.iter().zip(parts.complete_mounts()).enumerate() {
        let misfit = |key: &str, name: String, value: f64, expected: &'static str| {
            Err(Misfit::new(
                format!("mount.{index}.{key}"),
                ParameterError::new(name, value, expected),
            ))
        };
        let (wheel, angle) = (&mount.name, DEG.as_given(mount.steering));
        match complete.steering_axis {
            Some(axis) if mount.steering.abs() > axis.limit => {
                let limit = DEG.as_given(axis.limit);
                let name = format!(
                    "the steering angle of `{wheel}`, whose limit is {limit}° to either side, in \
                     degrees"
                );
                return misfit("steering_deg", name, angle, "at most its limit");
            }
            Some(_) => {}
            None => {
                let expected = "left out for a wheel that has no `steering_limit_deg`";
                if let Some(rate) = mount.steered.rate {
                    let name = format!("the steering rate of `{wheel}` [°/s]");
                    return misfit("steering_rate_deg_s", name, DEG.as_given(rate), expected);
                }
                if mount.kingpin_offset.norm() > 0.0 {
                    let name = format!("the kingpin offset of `{wheel}` [m]");
                    return misfit("kingpin_offset_m", name, mount.kingpin_offset.norm(), expected);
                }
            }
        }
    }
    Ok(())
}

/// Checks that no two wheels are at one place.
fn check_places(rover: &Rover) -> Result<(), Misfit> {
    /// Nearer than this two hubs are one [m]. Source: ours; no wheel is so narrow.
    const APART: f64 = 1e-3;
    let mounts = &rover.parts().mounts;
    for (index, mount) in mounts.iter().enumerate() {
        let distances =
            mounts[..index].iter().map(|other| (mount.position - other.position).norm());
        if let Some(distance) = distances.into_iter().find(|distance| *distance < APART) {
            let name = format!("the distance of `{}` from another wheel [m]", mount.name);
            let error = ParameterError::new(name, distance, "a millimetre or more");
            return Err(Misfit::new(format!("mount.{index}.position_m"), error));
        }
    }
    Ok(())
}

/// Checks that moments of inertia are those of a body: none is larger than the two others together.
fn check_inertias(rover: &Rover) -> Result<(), Misfit> {
    let parts = rover.parts();
    let own = parts.mounts.iter().enumerate().filter_map(|(index, mount)| {
        Some((format!("mount.{index}.inertia_kg_m2"), mount.inertia?))
    });
    let all = [("body", parts.body.inertia), ("wheel_unit", parts.wheel_unit.inertia)];
    let all = all.map(|(part, inertia)| (format!("{part}.inertia_kg_m2"), inertia));
    for (key, Inertia { xx, yy, zz }) in all.into_iter().chain(own) {
        for (axis, one, others) in [("xx", xx, yy + zz), ("yy", yy, xx + zz), ("zz", zz, xx + yy)] {
            // A flat body has both alike.
            if one > others * (1.0 + 1e-9) {
                let name = format!("the moment of inertia {axis} in `{key}` [kg·m²]");
                let expected = "at most the two others together, as of any body";
                return Err(Misfit::new(key, ParameterError::new(name, one, expected)));
            }
        }
    }
    Ok(())
}

/// The first wheel that reaches less or further down than the first one, or else all of them.
fn uneven_mount(rover: &Rover) -> String {
    let mounts = rover.parts().complete_mounts();
    let differs = |mount: &Mount| {
        let larger = mount.shearing_radius() - mounts[0].shearing_radius();
        mount.position.z - mounts[0].position.z != larger
    };
    match mounts.iter().position(differs) {
        Some(index) => format!("mount.{index}.position_m"),
        None => "mount.0".to_owned(),
    }
}

impl Described for Scenario {
    fn table() -> &'static dyn Inner<Self> {
        &SCENARIO
    }

    fn blank() -> Self {
        scenario::blank()
    }

    fn follow(&mut self, document: &Document) {
        self.model = document.model().unwrap_or_else(|| document.usual_model("soil"));
        let soil = document.part(Kind::Soil, "soil");
        self.ground.soil.domain.assumed_values = assumed_values(soil.as_ref());
        for (number, soil) in zone_soils(self).iter_mut().enumerate() {
            let part = document.part(Kind::Soil, &format!("terrain.zone.{number}.soil"));
            soil.domain.assumed_values = assumed_values(part.as_ref());
        }
    }

    fn fetch(&mut self, document: &Document, tree: &Node) -> Result<NamedFiles, DocumentError> {
        if let Some(slope) = document.number(SLOPE).filter(|_| !self.ground.is_plane()) {
            self.check_without(SLOPE, slope).map_err(|misfit| misfit.of(tree))?;
        }
        terrain_file::read(self, document, tree)
    }

    fn check_without(&self, path: &str, number: f64) -> Result<(), Misfit> {
        match path {
            SLOPE if number == 0.0 => Ok(()),
            SLOPE => {
                let name = "`slope_deg`, beside a `[terrain]`,";
                let error = ParameterError::new(name, number, INCLINED_BY_TERRAIN);
                let hint = "leave out `slope_deg`, or `[terrain]`, which inclines the ground";
                Err(Misfit::new(SLOPE, error).with_hint(hint))
            }
            _ => Err(Misfit::of_no_number(path, number)),
        }
    }

    fn settled(self) -> Result<Self, Misfit> {
        let rover = self.rover.settled().map_err(|misfit| misfit.within("rover"))?;
        let soil = self.ground.soil.settled().map_err(|misfit| misfit.within("soil"))?;
        let mut run = Self { rover, ground: self.ground.with_soil(soil), ..self };
        check_terrain(&run)?;
        for (number, soil) in zone_soils(&mut run).iter_mut().enumerate() {
            *soil = soil
                .settled()
                .map_err(|misfit| misfit.below(&format!("terrain.zone.{number}.soil")))?;
        }
        check_sample_count(run.duration, run.numerics.sample_interval)
            .map_err(Misfit::at("sample_interval_s"))?;
        let with_names = |misfit: Misfit| {
            let names: Vec<_> =
                run.rover.mounts().iter().map(|mount| mount.name.as_str()).collect();
            let hint = format!("the wheels are {}, in this order", names.join(", "));
            Misfit { hint: Some(hint), ..misfit }
        };
        run.drive
            .check(&run.rover)
            .map_err(|error| with_names(Misfit::new("drive.rim_speed_m_s", error)))?;
        run.by_wheel
            .check(run.rover.wheel_count())
            .map_err(|error| with_names(Misfit::new("by_wheel", error)))?;
        if run.sharing == LoadSharing::Complete && run.own_moments == OwnMoments::Neglected {
            return Err(Misfit {
                hint: Some(NEGLECTED_MOMENTS.to_owned()),
                ..Misfit::new("wheel_moments", Problem::Conflict(COMPLETE))
            });
        }
        if let Some(yaw) = &run.yaw {
            check_course(yaw, run.start.yaw)?;
        }
        run.check().map_err(Misfit::at("schema"))?;
        Ok(run)
    }
}

/// The soils of a scenario's zones.
fn zone_soils(run: &mut Scenario) -> &mut [Soil] {
    run.ground.zones.as_mut().map_or(&mut [], |zones| &mut Arc::make_mut(zones).soils)
}

/// What a slope beside ground with heights may be.
const INCLINED_BY_TERRAIN: &str = "0, or left out: the terrain says how the ground is inclined";

/// Checks that the ground can be, and that a run starts on its map.
fn check_terrain(run: &Scenario) -> Result<(), Misfit> {
    match &run.ground.shape {
        Shape::Formula(surface) => surface.check().map_err(Misfit::at(TERRAIN)),
        Shape::Map(map) => check_start(run.ground.start, map.extent()),
        Shape::Plane(_) | Shape::Own(_) => Ok(()),
    }
}

/// Checks that a start is on a map.
fn check_start(start: Vec2, extent: Extent) -> Result<(), Misfit> {
    let Extent { south_west: low, north_east: high } = extent;
    let axes = [("x", start.x, low.x, high.x), ("y", start.y, low.y, high.y)];
    let Some((axis, at, low, high)) =
        axes.into_iter().find(|(_, at, low, high)| !(low..=high).contains(&at))
    else {
        return Ok(());
    };
    let key = key(START);
    let name = format!("{axis} of `{key}`, on a map from {low} to {high} m,");
    let misfit = Misfit::new(key, ParameterError::new(name, at, "on the map"));
    Err(misfit.with_hint(spans(extent)))
}

/// Checks a yaw over time, beside the yaw at the start [rad].
fn check_course(course: &PrescribedYaw, start: f64) -> Result<(), Misfit> {
    const KEY: &str = "drive.yaw_deg";
    const FASTEST: &str = "at most 57 to either side, 1 rad/s";
    let rising = course.points.windows(2).all(|pair| pair[0].0 < pair[1].0);
    if let Some(TooFast { from, to, rate }) = course.too_fast().filter(|_| rising) {
        let point = |(time, yaw): (f64, f64)| format!("[{time}, {}]", DEG.as_given(yaw));
        let name = format!("the yaw rate of `{KEY}` from {} to {} [°/s]", point(from), point(to));
        return Err(Misfit::new(KEY, ParameterError::new(name, DEG.as_given(rate), FASTEST)));
    }
    course.check().map_err(Misfit::at(KEY))?;
    let first = course.at(0.0);
    if start == 0.0 || start == first {
        return Ok(());
    }
    let first = DEG.as_given(first);
    let name = format!("`start.yaw_deg`, beside a `{KEY}` that starts with {first}°,");
    let error = ParameterError::new(name, DEG.as_given(start), "the same, or left out");
    Err(Misfit { hint: Some(TWO_YAWS.to_owned()), ..Misfit::new("start.yaw_deg", error) })
}

/// What to do about a yaw at the start that a yaw over time contradicts.
const TWO_YAWS: &str = "leave out `start.yaw_deg`, or leave out `drive.yaw_deg`: without it the \
                        wheels' moments turn the rover";

/// What does not go together, and what to write instead.
const COMPLETE: &str =
    "`wheel_moments` is \"neglected\", but the complete load transfer includes them";
const NEGLECTED_MOMENTS: &str =
    "without them the load transfer is \"quasi-static-torque\", or the paper's \"quasi-static\"";

/// The most samples that a run records: with those of a rover's wheels, about a gigabyte.
const MOST_SAMPLES: f64 = 1e6;

pub(crate) fn check_sample_count(duration: f64, interval: f64) -> Result<(), ParameterError> {
    let count = (duration / interval).ceil();
    if count <= MOST_SAMPLES {
        return Ok(());
    }
    let name = "the number of samples, duration_s / sample_interval_s,";
    Err(ParameterError::new(name, count, "at most 1000000"))
}

impl Settings {
    /// What a campaign's document says, with its numbers in SI units and radians.
    #[must_use]
    pub fn of(document: &Document) -> Self {
        let mut settings = Self::BLANK;
        CAMPAIGN.put(&mut settings, document.keys());
        settings
    }
}

impl Described for Stand {
    fn table() -> &'static dyn Inner<Self> {
        &STAND
    }

    fn blank() -> Self {
        BLANK_STAND
    }

    fn follow(&mut self, document: &Document) {
        self.model = document.model().unwrap_or_else(|| document.usual_model("soil"));
        let soil = document.part(Kind::Soil, "soil");
        self.soil.domain.assumed_values = assumed_values(soil.as_ref());
    }

    fn settled(self) -> Result<Self, Misfit> {
        let wheel = self.wheel.settled().map_err(|misfit| misfit.within("wheel"))?;
        let soil = self.soil.settled().map_err(|misfit| misfit.within("soil"))?;
        soil.check_under(&wheel, self.gravity)
            .map_err(|error| Misfit::new("pressure_sinkage", error).within("soil"))?;
        Ok(Self { soil, wheel, ..self })
    }
}
