//! `grouser calibrate`: estimates soil parameters, with confidence intervals, from wheel tests,
//! plate tests or shear tests.

mod bevameter;
mod checkpoint;
mod next_runs;
mod progress;
mod report;
mod wheel;

use crate::args::CalibrateArgs;
use crate::failure::Failure;

pub(crate) fn run(args: &CalibrateArgs) -> Result<(), Failure> {
    if args.plates.is_some() || args.shear.is_some() {
        bevameter::run(args)
    } else {
        wheel::run(args)
    }
}
