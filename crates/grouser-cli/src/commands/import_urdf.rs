//! `grouser import-urdf`: a rover's document of the robot that ROS knows.

use grouser::document::reading::four_digits;
use grouser::document::urdf::{self, Forward, FoundWheel, UrdfError, UrdfOptions};
use grouser::document::{self, Overrides, Source, escape};

use crate::args::ImportUrdfArgs;
use crate::failure::Failure;
use crate::output::rows::aligned;
use crate::output::text::Text;
use crate::output::{self, file};

pub(crate) fn run(args: &ImportUrdfArgs) -> Result<(), Failure> {
    if let Some(out) = &args.out {
        file::check_new(out, args.force)?;
    }
    let name = escape::path(&args.file);
    let refused = |what: String| Failure::Usage(format!("{name}: {what}"));
    let bytes = document::file::read(&args.file, urdf::LARGEST_FILE)
        .map_err(|it| refused(it.to_string()))?;
    let found = urdf::import(bytes, &options(args), &urdf::meshes_beside(&args.file))
        .map_err(|error| refused(escape::visible(&with_flags(&error)).into_owned()))?;
    let source = Source::text(format!("the rover of {name}"), found.toml.clone());
    document::read_rover(&source, &Overrides::none())?;
    output::message(table(&found.wheels).to_string().trim_end());
    output::notes(found.notes.iter().map(|note| escape::line(note)));
    match &args.out {
        Some(out) => file::write_result(out, found.toml.as_bytes()),
        None => output::print(&found.toml),
    }
}

fn options(args: &ImportUrdfArgs) -> UrdfOptions {
    UrdfOptions {
        wheels: args.wheels.clone(),
        passive: args.passive.clone(),
        wheel_radius: args.wheel_radius_m,
        wheel_width: args.wheel_width_m,
        forward: Forward::named(&args.forward).unwrap_or_default(),
        has_differential: args.differential,
        is_rigid: args.rigid,
    }
}

/// The wheels that were found.
fn table(wheels: &[FoundWheel]) -> Text {
    let header = [
        "wheel",
        "joint",
        "radius [m]",
        "width [m]",
        "x [m]",
        "y [m]",
        "z [m]",
        "hangs on",
        "steered by",
    ];
    let or_none = |name: String| if name.is_empty() { "-".to_owned() } else { name };
    let row = |wheel: &FoundWheel| {
        let [x, y, z] = wheel.position;
        let numbers = [wheel.radius, wheel.width, x, y, z].map(four_digits);
        let names = [wheel.link.clone(), wheel.joint.clone()].into_iter().chain(numbers);
        let steered = wheel.steered_by.clone().unwrap_or_default();
        names.chain([or_none(wheel.hangs_on.join(", ")), or_none(steered)]).collect()
    };
    let rows: Vec<Vec<String>> = wheels.iter().map(row).collect();
    aligned(&header.map(str::to_owned), &rows)
}

/// An error with the flags that help.
fn with_flags(error: &UrdfError) -> String {
    let hint = match error {
        UrdfError::NoWheels { along: 2.., .. } => "\nhint: --forward y, or --forward -y",
        UrdfError::NoWheels { .. } => {
            "\nhint: --wheels LINK names one that is a wheel, and can be repeated; * stands for any \
             letters; --wheel-radius-m and --wheel-width-m give what their shapes do not tell"
        }
        UrdfError::TooManyWheels { .. } | UrdfError::Tracks { .. } => {
            "\nhint: --wheels LINK names one that is a wheel, and can be repeated; * stands for any \
             letters"
        }
        UrdfError::NoRim { .. } => "\nhint: --wheel-radius-m R --wheel-width-m B",
        UrdfError::Differential(_) => {
            "\nhint: --differential says that there is one, --rigid takes rockers as they stand"
        }
        UrdfError::TurnTogether(..)
        | UrdfError::TurnUnequally { .. }
        | UrdfError::Askew(_)
        | UrdfError::TooManyJoints(_)
        | UrdfError::Sides(..)
        | UrdfError::OtherSuspension => "\nhint: --rigid takes these joints as they stand",
        _ => "",
    };
    format!("{error}{hint}")
}
