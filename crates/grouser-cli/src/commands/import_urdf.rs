//! `grouser import-urdf`: a rover's document of the robot that ROS knows.

use grouser::document::urdf::{self, UrdfError, UrdfOptions};
use grouser::document::{self, Overrides, Source, escape};

use crate::args::ImportUrdfArgs;
use crate::failure::Failure;
use crate::output::{self, file};

/// The largest file [bytes]: meshes stand in files of their own.
const LARGEST: u64 = 16 << 20;

pub(crate) fn run(args: &ImportUrdfArgs) -> Result<(), Failure> {
    if let Some(out) = &args.out {
        file::check_new(out, args.force)?;
    }
    let name = escape::path(&args.file);
    let refused = |what: String| Failure::Usage(format!("{name}: {what}"));
    let bytes = document::file::read(&args.file, LARGEST).map_err(|it| refused(it.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|_| refused("is not a text".to_owned()))?;
    let options = UrdfOptions { wheels: args.wheels.clone(), has_differential: args.differential };
    let found = urdf::import(&text, &options)
        .map_err(|error| refused(escape::visible(&with_flags(&error)).into_owned()))?;
    let source = Source::text(format!("the rover of {name}"), found.toml.clone());
    document::read_rover(&source, &Overrides::none())?;
    output::notes(found.notes.iter().map(|note| escape::line(note)));
    match &args.out {
        Some(out) => file::write_result(out, found.toml.as_bytes()),
        None => output::print(&found.toml),
    }
}

/// An error with the flags that help.
fn with_flags(error: &UrdfError) -> String {
    let hint = match error {
        UrdfError::NoWheels(_) | UrdfError::TooManyWheels { .. } => {
            "\nhint: --wheels '*wheel*' names those that are wheels"
        }
        UrdfError::Differential(_) => "\nhint: --differential says that there is one",
        _ => "",
    };
    format!("{error}{hint}")
}
