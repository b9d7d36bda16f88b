//! What to do tomorrow: headings, looks at the slip, and test drives.

use grouser::answers::learn::{AdviceQuestion, LearnQuestion};
use grouser::studies::ensemble::samples::Sample;
use grouser::studies::heading_band::HeadingBand;
use grouser::studies::learn::Drive;
use grouser::studies::learn::advice::DriveAdvice;

use crate::commands::sampling;
use crate::failure::Failure;

/// The advice that is asked for, if any is.
///
/// * `drive`: its last lesson has what is read on a drive
pub(super) fn of(
    question: &LearnQuestion,
    drive: &Drive,
    (samples, band): (&[Sample], &HeadingBand),
) -> Result<Option<DriveAdvice>, Failure> {
    let Some(settings) = question.advice_settings(drive) else { return Ok(None) };
    let learner = drive.learner();
    let found =
        sampling::with_bar(samples.len(), |go_on| learner.advice(samples, band, &settings, go_on));
    let found = found.map_err(|error| Failure::Usage(error.to_string()))?;
    Ok(Some(sampling::whole(found)))
}

/// The flags that ask for the same advice again, after a blank; nothing where none is asked for.
/// Their names are the keys of the inputs.
pub(super) fn flags(advice: Option<&AdviceQuestion>) -> String {
    let given = advice.into_iter().flat_map(AdviceQuestion::given);
    let flags = given.map(|(key, value)| format!(" --{}={value}", key.replace('_', "-")));
    let first = advice.map(|_| " --advice".to_owned());
    first.into_iter().chain(flags).collect()
}
