//! `grouser calibrate`: estimates soil parameters, with confidence intervals, from wheel or plate tests.

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
