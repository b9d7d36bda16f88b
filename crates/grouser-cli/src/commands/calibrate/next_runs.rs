//! The flags of the next runs: the prediction to narrow, and the settings that the stand can run.

use grouser::document::calibration::{AimError, AimWords};
use grouser::studies::calibration::design::Aim;
use grouser::studies::measurement::Trial;

use crate::args::CalibrateArgs;
use crate::failure::Failure;

/// * `trials`: where the flags say no load, theirs is meant
pub(super) fn aim(args: &CalibrateArgs, trials: &[Trial]) -> Result<Aim, Failure> {
    words(args).aim(trials).map_err(|error| {
        Failure::Usage(match &error {
            AimError::Target { what } => format!(
                "--target {}: {what}\nhint: such as drawbar_pull_n:load_n=17,slip_ratio=0.2",
                args.target
            ),
            AimError::Candidate { key, .. } => {
                format!("--candidate-{} {error}", key.replace('_', "-"))
            }
            AimError::TooManyCandidates { .. } => format!("the flags --candidate-… make {error}"),
        })
    })
}

fn words(args: &CalibrateArgs) -> AimWords {
    AimWords {
        target: args.target.clone(),
        propose: args.propose,
        load_n: args.candidate_load_n.as_ref().map(|loads| loads.0.clone()),
        slip_ratio: args.candidate_slip_ratio.0.clone(),
        slip_angle_deg: args.candidate_slip_angle_deg.0.clone(),
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::*;
    use crate::args::{Cli, Command};

    #[test]
    fn without_flags_it_is_the_usual_aim() {
        let line = ["grouser", "calibrate", "--soil", "toyoura", "--plates", "plates.csv"];
        let Command::Calibrate(args) = Cli::try_parse_from(line).expect("a command").command else {
            unreachable!("it is `calibrate`")
        };
        assert_eq!(words(&args), AimWords::default());
    }
}
