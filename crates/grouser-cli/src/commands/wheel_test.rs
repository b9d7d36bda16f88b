//! `grouser wheel-test`: forces and sinkage of one wheel on a test stand.

use grouser::answers::AnswerOptions;
use grouser::answers::wheel_test::{SimulatedStand, WheelTestQuestion};

use super::sampling;
use crate::args::WheelTestArgs;
use crate::failure::Failure;
use crate::inputs;
use crate::list::Numbers;
use crate::output::answer::give;
use crate::output::folder::OutputFolder;

pub(crate) fn run(args: &WheelTestArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let question = inputs::wheel_test(args)?;
    let answer = sampling::with_bar(question.samples(), |go_on| {
        let (has_page, is_strict) = (folder.is_some(), args.strict.strict);
        question.answer("wheel-test", &AnswerOptions { has_page, is_strict, go_on })
    })?;
    give(&answer, &repeat(args, &question), folder, args.output.format)
}

/// The command that gives the answer again.
fn repeat(args: &WheelTestArgs, question: &WheelTestQuestion) -> String {
    let (model, gravity) = (question.model_name(), question.gravity);
    let [loads, angles, slips] =
        [&args.load_n, &args.slip_angle_deg, &args.slip_ratio].map(Numbers::joined);
    let stand = question.stand.map(|it| {
        let SimulatedStand { trials, noise_n, noise_mm, noise_nm, seed } = it;
        format!(
            " --trials {trials} --noise-n {noise_n} --noise-mm {noise_mm} --noise-nm {noise_nm} \
             --seed {seed}"
        )
    });
    let gradients = sampling::gradient_flag(question.gradients.as_ref());
    let (stand, samples) = (stand.unwrap_or_default(), sampling::flags(question.sampling));
    format!(
        "grouser wheel-test --soil soil.toml --wheel wheel.toml --model {model} \
         --gravity-m-s2 {gravity} --load-n {loads} --slip-angle-deg {angles} --slip-ratio {slips}\
         {stand}{samples}{gradients}"
    )
}
