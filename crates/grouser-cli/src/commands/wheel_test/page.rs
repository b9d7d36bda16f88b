//! The page of a wheel test: forces, sinkage and torque over slip, and the rows.

use grouser_draw::chart::Draw;
use std::fmt::Write as _;

use grouser::contact::validity::Finding;
use grouser::document::columns::wheel::WHEEL;
use grouser::document::columns::{DRAWBAR_PULL, Quantity, SIDE_FORCE, SINKAGE, SLIP_RATIO, TORQUE};
use grouser::studies::wheel_test::WheelTest;

use super::charted::{Charted, brief, plan};
use crate::args::{EVERY_MODEL, WheelTestArgs};
use crate::inputs::StandInputs;
use crate::output::rows::four_digits;
use crate::report::answer::{self, Basis, meanings};
use crate::report::page::Page;

pub(super) fn html(args: &WheelTestArgs, stands: &[StandInputs], charted: &Charted<'_>) -> String {
    let mut page = Page::new("A wheel test");
    page.answer(&sentence(charted));
    page.list(what_was_tested(args, &stands[0]));
    page.heading("Over the slip ratio");
    let has_side_force = args.slip_angle_deg.0.iter().any(|angle| *angle != 0.0);
    let quantities = [DRAWBAR_PULL, SINKAGE, TORQUE, SIDE_FORCE];
    let shown = if has_side_force { &quantities[..] } else { &quantities[..3] };
    for quantity in shown {
        page.drawing(&charted.chart(*quantity).to_svg(), caption(*quantity));
    }
    page.heading("Every row");
    page.rows("Settings and results", charted.rows, &brief(args));
    let tests: Vec<WheelTest> = stands.iter().map(|stand| plan(args, stand)).collect();
    let findings: Vec<Finding> =
        tests.iter().flat_map(WheelTest::run).flat_map(|row| row.findings).collect();
    answer::close(page, &findings, &meanings(&WHEEL), &basis(args, &stands[0]))
}

/// The largest pull, and where.
fn sentence(charted: &Charted<'_>) -> String {
    let rows = charted.rows;
    let [slips, pulls] = [SLIP_RATIO, DRAWBAR_PULL].map(|it| rows.numbers(it.name));
    let known = slips.iter().zip(pulls).filter_map(|(slip, pull)| slip.zip(*pull));
    let largest = known.max_by(|one, other| one.1.total_cmp(&other.1));
    match largest {
        Some((slip, pull)) => format!(
            "The largest drawbar pull of these rows is {} N, at a slip ratio of {}.",
            four_digits(pull),
            four_digits(slip)
        ),
        None => "No row has a result: each says why.".into(),
    }
}

fn what_was_tested(args: &WheelTestArgs, stand: &StandInputs) -> Vec<String> {
    let model = if args.setting.has_every_model() { "every model" } else { stand.model.name() };
    vec![
        format!("wheel: {}", stand.wheel.document.name()),
        format!("soil: {}", stand.soil.document.name()),
        format!("gravity: {} m/s²", stand.gravity),
        format!("wheel–soil model: {model}"),
    ]
}

fn caption(quantity: Quantity) -> &'static str {
    match quantity {
        SINKAGE => "Sinkage of the grouser tips below the undisturbed ground.",
        TORQUE => "Torque that the motor gives to the wheel.",
        SIDE_FORCE => "Force of the soil across the wheel, positive to the left.",
        _ => "Force of the soil along the wheel: what is left of the thrust to pull with.",
    }
}

fn basis(args: &WheelTestArgs, stand: &StandInputs) -> Basis {
    let list =
        |numbers: &[f64]| numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
    let model = if args.setting.has_every_model() { EVERY_MODEL } else { stand.model.name() };
    let mut repeat = format!(
        "grouser wheel-test --soil soil.toml --wheel wheel.toml --model {model} --gravity-m-s2 {} --load-n {} \
         --slip-angle-deg {} --slip-ratio {}",
        stand.gravity,
        list(&args.load_n.0),
        list(&args.slip_angle_deg.0),
        list(&args.slip_ratio.0),
    );
    // Writing to a string does not fail.
    if let Some(trials) = args.stand.trials {
        let it = &args.stand;
        let _ = write!(
            repeat,
            " --trials {trials} --noise-n {} --noise-mm {} --noise-nm {} --seed {}",
            it.noise_n, it.noise_mm, it.noise_nm, it.seed
        );
    }
    if args.sampling.uncertainty {
        let (samples, seed) = (args.sampling.samples, args.stand.seed);
        let _ = write!(repeat, " --uncertainty --samples {samples} --seed {seed}");
    }
    Basis::new(repeat).with("soil.toml", &stand.soil).with("wheel.toml", &stand.wheel)
}
