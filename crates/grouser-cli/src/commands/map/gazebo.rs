//! The slip of a map for Gazebo.

use grouser::studies::mobility::Ground;
use grouser_map::SlipTexture;

use super::super::sampling;
use crate::args::MapArgs;
use crate::failure::Failure;
use crate::inputs::MapInputs;
use crate::output::folder::OutputFolder;

/// Names of the files.
const PICTURE: &str = "gazebo_slip.png";
const SYSTEMS: &str = "gazebo_slip.sdf";

/// The picture, if it is asked for.
pub(super) fn texture(
    args: &MapArgs,
    inputs: &MapInputs,
    ground: Ground<'_>,
) -> Result<Option<SlipTexture>, Failure> {
    if !args.gazebo {
        return Ok(None);
    }
    /// Two courses, each of the soil as written.
    const COURSES: usize = 2;
    let found = sampling::with_bar(COURSES, |go_on| inputs.study.slip_compliances(go_on))?;
    Ok(Some(SlipTexture::of(ground, &sampling::whole(found))))
}

pub(super) fn add(output: &mut OutputFolder, inputs: &MapInputs, texture: SlipTexture) {
    let heading = &inputs.study.heading;
    output.add(SYSTEMS, texture.sdf(PICTURE, &heading.rover, heading.gravity));
    output.add(PICTURE, texture.png);
}
