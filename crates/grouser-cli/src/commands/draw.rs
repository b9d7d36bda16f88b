//! `grouser draw`: the theory as drawings, from the numbers of a rover on a slope.

use grouser::contact::{Contact, Ishigami, Slip, settle};
use grouser::document::columns::SLOPE;
use grouser::studies::heading::HeadingStudy;
use grouser_draw::drawings::{self, Crossing, WheelInSoil};

use crate::args::DrawArgs;
use crate::failure::Failure;
use crate::inputs;
use crate::output::folder::{OldFiles, OutputFolder};
use crate::report::REPORT;
use crate::report::page::Page;

pub(crate) fn run(args: &DrawArgs) -> Result<(), Failure> {
    let old_files = if args.force { OldFiles::Replace } else { OldFiles::Keep };
    let mut folder = OutputFolder::open(&args.out, old_files)?;
    let scenario = inputs::draw(args)?;
    let value = &scenario.value;
    let slope = SLOPE.unit.to_si(args.slope_deg);
    let heading = HeadingStudy::of(value).curve()?.at(slope).map_err(|none| {
        Failure::Run(format!("--slope-deg {}: {none}; choose a gentler slope", args.slope_deg))
    })?;
    let (rover, gravity) = (&value.rover, value.gravity);
    let share = rover.mass() * gravity / rover.mounts().len() as f64;
    let load = args.load_n.unwrap_or(share);
    let contact = Contact {
        wheel: rover.mounts()[0].unit.wheel,
        soil: value.ground.soil,
        slip: Slip::on_test_stand(args.slip_ratio, 0.0),
        gravity,
    };
    let settled = settle(&Ishigami::DEFAULT, &contact, load)
        .map_err(|problem| Failure::Run(format!("the drawn wheel does not settle: {problem}")))?;
    let wheel = WheelInSoil { contact: &contact, settled: &settled, load };
    let crossing = Crossing { rover, slope, yaw: heading.yaw, gravity, wheels: &heading.wheels };
    let mut page = Page::new("The theory in drawings");
    page.list([
        format!("rover: {}", scenario.document.name_of("rover")),
        format!("soil: {}", scenario.document.name_of("soil")),
        format!("slope: {}°", args.slope_deg),
        format!("the drawn wheel: load {load:.1} N, slip ratio {}", args.slip_ratio),
    ]);
    for drawing in drawings::all(&wheel, &crossing) {
        let svg = drawing.to_svg();
        page.drawing(&svg, drawing.caption);
        folder.add(format!("{}.svg", drawing.name), svg);
    }
    folder.add(REPORT, page.to_html());
    folder.add_document("scenario.toml", &scenario);
    folder.finish()
}
