//! The rover from above along its paths, to scale: Fig. 9 as one would see it.

use grouser::simulation::Trajectory;
use grouser::studies::reproduction::{Reproduction, SlopeRuns};
use grouser::units::Vec2;
use grouser::vehicle::Rover;
use grouser_draw::{Place, Shape, Sheet, Stroke, Text, draw_outline, reach};

/// Name of the drawing's file, without ending.
pub(crate) const FILE: &str = "fig9-outlines";
/// The text below it.
pub(crate) const CAPTION: &str = "The runs of Fig. 9 from above, to scale, uphill at the top; the \
                                  rover's wheels at the start and at the end. Grey: nose along the \
                                  contour. Black: with the heading offset.";

/// Width of the drawing [mm].
const WIDTH: f64 = 180.0;
/// Its scale [mm/m].
const SCALE: f64 = 80.0;
/// Room on the left and above [mm].
const MARGIN: f64 = 24.0;
const TOP: f64 = 6.0;
/// Size of letters [mm].
const LETTERS: f64 = 3.4;
/// Grey of the runs without heading offset.
const PALE: f64 = 0.6;

/// A panel for each slope, one below the other.
pub(crate) fn drawing(study: &Reproduction, rover: &Rover) -> Sheet {
    let heights: Vec<f64> = study.slopes.iter().map(|runs| height(runs, rover)).collect();
    let mut sheet =
        Sheet::new("The runs of Fig. 9 from above", WIDTH, TOP + heights.iter().sum::<f64>());
    let mut top = TOP;
    for (runs, height) in study.slopes.iter().zip(heights) {
        panel(&mut sheet, runs, rover, top);
        top += height;
    }
    sheet
}

/// Height of a slope's panel [mm].
fn height(runs: &SlopeRuns, rover: &Rover) -> f64 {
    let lowest = runs.uncompensated.last().state.position.y.min(0.0);
    SCALE * (2.0 * reach(rover) - lowest) + 2.0
}

fn panel(sheet: &mut Sheet, runs: &SlopeRuns, rover: &Rover, top: f64) {
    let contour = top + SCALE * reach(rover);
    let at = |place: Vec2| -> Place {
        [MARGIN + SCALE * (place.x + reach(rover)), contour - SCALE * place.y]
    };
    let ends = [[2.0, contour], [WIDTH - 2.0, contour]];
    sheet.draw(Shape::line(ends, Stroke::grey(0.25, 0.3).dashed(2.0, 1.2)));
    let slope = format!("{:.0}°", runs.measured.slope.to_degrees());
    sheet.text(Text::new(slope, LETTERS), [2.0, contour - 1.5]);
    draw_run(sheet, &runs.uncompensated, rover, &at, Stroke::grey(0.35, PALE));
    if let Some(run) = &runs.compensated {
        draw_run(sheet, run, rover, &at, Stroke::black(0.35));
    }
}

fn draw_run(
    sheet: &mut Sheet,
    run: &Trajectory,
    rover: &Rover,
    at: &dyn Fn(Vec2) -> Place,
    stroke: Stroke,
) {
    let path = run.records.iter().map(|record| at(record.state.position));
    sheet.draw(Shape::line(path, Stroke { width: 0.6, ..stroke }));
    let last = run.records.len() - 1;
    for index in [0, last] {
        draw_outline(sheet, &run.records[index].state, rover, at, stroke);
    }
}
