//! `grouser calibrate`: the soil that measurements speak for, and how surely.

mod checkpoint;
mod next_runs;
mod plates;
mod progress;
mod report;
mod wheel;

use crate::args::CalibrateArgs;
use crate::failure::Failure;

pub(crate) fn run(args: &CalibrateArgs) -> Result<(), Failure> {
    match &args.plates {
        Some(file) => plates::run(args, file),
        None => wheel::run(args),
    }
}
