//! The page of a heading map.

use grouser::document::LoadedScenario;
use grouser::document::columns::heading::{held, map_brief};
use grouser::document::table::Table;
use grouser::studies::heading_map::HeadingMap;
use grouser_draw::chart::{Draw, HeatMap};

use crate::args::HeadingMapArgs;
use crate::commands::sampling;
use crate::report::answer::{self, Basis, meanings};
use crate::report::page::Page;

/// * `maps`: of each soil and model
/// * `table`: all rows
pub(super) fn html(
    command: &str,
    args: &HeadingMapArgs,
    scenarios: &[LoadedScenario],
    map: &HeadingMap,
    (maps, table): (&[HeatMap], &Table),
) -> String {
    let mut page = Page::new("Heading offset over slope and course");
    page.answer(&sentence(map));
    page.paragraph(
        "A course is the direction of travel, counted from the contour line: 0° is along it, 90° straight up, −90° \
         straight down. The yaw beyond the course is how far the nose must point uphill of the way that the rover \
         shall take.",
    );
    for map in maps {
        page.drawing(&map.to_svg(), "Grey: no heading holds the course.");
    }
    page.heading("Every slope and course");
    page.rows("Heading offsets", table, &map_brief());
    let findings = map.rows.iter().flat_map(|row| row.findings.iter().flatten());
    answer::close(page, findings, &meanings(&held()), &basis(command, args, scenarios))
}

/// How many of the pairs of slope and course can be held.
fn sentence(map: &HeadingMap) -> String {
    let cells = || map.rows.iter().flat_map(|row| &row.cells);
    let held = cells().filter(|cell| cell.is_ok()).count();
    format!(
        "A heading holds the course in {held} of {} pairs of slope and course.",
        cells().count()
    )
}

fn basis(command: &str, args: &HeadingMapArgs, scenarios: &[LoadedScenario]) -> Basis {
    let list =
        |numbers: &[f64]| numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
    let file = |place: usize| match scenarios {
        [_] => "scenario.toml".to_owned(),
        _ => format!("scenario-{}.toml", place + 1),
    };
    let line = |place| {
        format!(
            "grouser {command} {} --slope-deg {} --course-deg {} --rim-speed-m-s {}{}",
            file(place),
            list(&args.slope_deg.0),
            list(&args.course_deg.0),
            args.rim_speed_m_s.0[0],
            sampling::flags(&args.uncertainty)
        )
    };
    let repeat: Vec<String> = (0..scenarios.len()).map(line).collect();
    let basis = Basis::new(repeat.join("\n"));
    scenarios.iter().enumerate().fold(basis, |basis, (place, it)| basis.with(file(place), it))
}
