//! The figures of the report, each with its data.

use grouser::contact::Settled;
use grouser::document::columns::{SINKAGE, SLIP_ANGLE, SLOPE, YAW};
use grouser::simulation::{Trajectory, WheelRecord};
use grouser::studies::comparison::MeasuredTraverse;
use grouser::studies::heading_band::SlopeBand;
use grouser::studies::reproduction::{Reproduction, START_UP_ROW, SlopeRuns};
use grouser::studies::wheel_test::WheelTestRow;
use grouser::vehicle::Rover;
use grouser_draw::chart::{Chart, Series, Style};
use serde_json::{Map, Value, json};

use crate::output::rows::Rows;

/// A figure and the numbers it draws.
pub(crate) struct Figure {
    /// Name of its files, without ending.
    pub(crate) file: &'static str,
    /// The text below the drawing.
    pub(crate) caption: String,
    /// The drawing.
    pub(crate) chart: Chart,
}

impl Figure {
    /// Its data in long form: a row for each point.
    pub(crate) fn rows(&self) -> Rows {
        let point = |series: &Series, (x, y): &(f64, f64)| {
            let row = json!({
                "series": series.name,
                self.chart.x_label.as_str(): x,
                self.chart.y_label.as_str(): y,
            });
            match row {
                Value::Object(map) => map,
                _ => unreachable!("an object was written"),
            }
        };
        let points = self.chart.series.iter().flat_map(|series| {
            series.points.iter().map(move |xy| point(series, xy)).collect::<Vec<Map<_, _>>>()
        });
        Rows::from_maps(points.collect())
    }
}

/// The single-wheel test.
pub(crate) fn of_a_wheel(study: &Reproduction) -> [Figure; 5] {
    [
        wheel_curves(study),
        by_slip_angle(study, "pull-over-slip", "Drawbar pull", "drawbar pull [N]", |settled| {
            settled.forces.drawbar_pull
        }),
        by_slip_angle(study, "side-force-over-slip", "Side force", "side force [N]", |settled| {
            settled.forces.side_force
        }),
        by_slip_angle(study, "torque-over-slip", "Torque", "torque [N·m]", |settled| {
            settled.forces.torque
        }),
        sinkage_by_load(study),
    ]
}

/// The first moments of a run from rest.
pub(crate) fn along_a_run(study: &Reproduction, rover: &Rover) -> [Figure; 2] {
    [slip_along_run(study, rover), sinkage_along_run(study, rover)]
}

/// Fig. 10: heading offset over slope.
pub(crate) fn heading(study: &Reproduction, band: &[SlopeBand]) -> Figure {
    let curve = study.headings.headings();
    let line = curve.iter().map(|a| (SLOPE.unit.from_si(a.slope), YAW.unit.from_si(a.yaw)));
    let points = |yaw: fn(&MeasuredTraverse) -> f64| {
        let measured = study.slopes.iter().map(|runs| &runs.measured);
        measured
            .map(|m| (SLOPE.unit.from_si(m.slope), YAW.unit.from_si(yaw(m))))
            .collect::<Vec<_>>()
    };
    Figure {
        file: "fig10-attitude",
        caption: format!(
            "Fig. 10 of the paper: the heading offset that holds the contour, there called \
                  attitude, over the slope. The curve ends where turning further uphill costs more \
                  thrust than it gains. The measured runs lose yaw from start to end; on 20° they \
                  were started high on purpose. The band: sand known as well as preset \
                  toyoura-uncertain says, any of three models, complete loads, {} samples; it ends \
                  where fewer than 97.5 % of them hold the contour.",
            band.first().map_or(0, |on| on.level.trials)
        ),
        chart: Chart::new(
            "Heading offset that holds the contour",
            ("slope [°]", "yaw, positive uphill [°]"),
            vec![
                heading_band(band),
                Series::new("Grouser", Style::Line, 1, line),
                Series::new("paper's model", Style::Squares, 0, points(|m| m.model_yaw)),
                Series::new("measured, mean", Style::Dots, 4, points(MeasuredTraverse::mean_yaw)),
                Series::new("measured, start", Style::Dots, 2, points(|m| m.initial_yaw)),
                Series::new("measured, end", Style::Triangles, 3, points(|m| m.final_yaw)),
            ],
        ),
    }
}

/// The band of headings for Fig. 10.
fn heading_band(band: &[SlopeBand]) -> Series {
    let edges = band.iter().filter_map(|on| {
        let yaw = on.yaw.filter(|_| on.level.estimate() >= MOSTLY)?;
        let slope = SLOPE.unit.from_si(on.slope);
        Some((slope, YAW.unit.from_si(yaw.low), YAW.unit.from_si(yaw.high)))
    });
    Series::band("95 %, soil and model uncertain", 6, edges)
}

/// The band ends where fewer of the samples hold the contour [-]: beyond it would be that of the
/// strong ones.
const MOSTLY: f64 = 0.975;

/// Fig. 9: paths without and with compensation.
pub(crate) fn traverses(study: &Reproduction) -> Figure {
    let path = |run: &Trajectory| -> Vec<(f64, f64)> {
        run.records.iter().map(|s| (s.state.position.x, 1e3 * s.state.position.y)).collect()
    };
    let mut series = Vec::new();
    for (index, SlopeRuns { measured, uncompensated, compensated, .. }) in
        study.slopes.iter().enumerate()
    {
        let slope = measured.slope.to_degrees().round();
        let colour = index + 1;
        series.push(Series::new(
            format!("{slope}°, nose level"),
            Style::Line,
            colour,
            path(uncompensated),
        ));
        if let Some(run) = compensated {
            let name = format!("{slope}°, with heading offset");
            series.push(Series::new(name, Style::Dashed, colour, path(run)));
        }
    }
    Figure {
        file: "fig9-traverses",
        caption: "Fig. 9 of the paper: paths on the slope, x along the contour and y uphill (note \
                  the scales). With its nose along the contour the rover drifts downhill; started \
                  with its heading offset it stays on the contour, and pays with slip and distance."
            .into(),
        chart: Chart::new(
            "Traverses without and with compensation",
            ("along the contour, x [m]", "uphill, y [mm]"),
            series,
        ),
    }
}

/// Fig. 7: drawbar pull over slip for three longitudinal moduli.
fn wheel_curves(study: &Reproduction) -> Figure {
    let styles = [Style::Line, Style::Dashed, Style::Dotted];
    let curves = study.wheel_curves.iter().zip(styles.iter().cycle()).enumerate();
    let series = curves.map(|(index, (curve, style))| {
        let settled = curve
            .rows
            .iter()
            .filter_map(|row| Some((row.slip_ratio, row.result.ok()?.forces.drawbar_pull)));
        let name = format!("K_x = {} m", curve.longitudinal_modulus);
        Series::new(name, *style, index + 1, settled)
    });
    let never = study.wheel_curves.iter().find(|curve| {
        let pulls = |settled: grouser::contact::Settled| settled.forces.drawbar_pull > 0.0;
        !curve.rows.iter().any(|row| row.result.is_ok_and(pulls))
    });
    let verdict = never.map_or(String::new(), |curve| {
        format!(
            " With the {} that the paper reports after tuning, read as metres, the wheel does not \
             pull at any slip: a rover on such wheels could not move, so the number cannot be what \
             was used. (0.03 would be near; a grouser thrust added apart would be another \
             reading.)",
            curve.longitudinal_modulus
        )
    });
    Figure {
        file: "fig7-wheel-test",
        caption: format!(
            "Fig. 7 of the paper: drawbar pull of one wheel over slip at slip angle 0, where the \
             side force is zero by symmetry, for three values of K_x at slip angle 0.{verdict}"
        ),
        chart: Chart::new(
            "Single-wheel test",
            ("slip ratio", "drawbar pull [N]"),
            series.collect(),
        ),
    }
}

/// One quantity of the single-wheel test over slip, a curve for each slip angle.
fn by_slip_angle(
    study: &Reproduction,
    file: &'static str,
    title: &str,
    y_label: &str,
    quantity: fn(&Settled) -> f64,
) -> Figure {
    let key =
        |row: &WheelTestRow| format!("slip angle {:.0}°", SLIP_ANGLE.unit.from_si(row.slip_angle));
    Figure {
        file,
        caption: format!(
            "{title} of one wheel over slip, for several slip angles, under the load of the \
             paper's test and with the K_x of its Table 3. Side force is positive to the left: a \
             wheel that moves to the left is pushed to the right."
        ),
        chart: Chart::new(
            format!("Single-wheel test: {}", title.to_lowercase()),
            ("slip ratio", y_label),
            curves(&study.by_slip_angle, key, quantity),
        ),
    }
}

fn sinkage_by_load(study: &Reproduction) -> Figure {
    Figure {
        file: "sinkage-over-slip",
        caption: "Sinkage of one wheel over slip at slip angle 0, under several loads. Measured \
                  wheels sink faster with slip than in this model."
            .into(),
        chart: Chart::new(
            "Single-wheel test: sinkage",
            ("slip ratio", "sinkage [mm]"),
            curves(
                &study.by_load,
                |row| format!("load {} N", row.load),
                |settled| SINKAGE.unit.from_si(settled.sinkage),
            ),
        ),
    }
}

/// A curve over slip for each run of rows with the same key; rows without a result are left out.
fn curves(
    rows: &[WheelTestRow],
    key: impl Fn(&WheelTestRow) -> String,
    quantity: impl Fn(&Settled) -> f64,
) -> Vec<Series> {
    let styles = [Style::Line, Style::Dashed, Style::Dotted];
    let mut series: Vec<Series> = Vec::new();
    for row in rows {
        let name = key(row);
        if series.last().is_none_or(|last| last.name != name) {
            let index = series.len();
            series.push(Series::new(name, styles[index % styles.len()], index + 1, []));
        }
        if let (Some(last), Ok(settled)) = (series.last_mut(), &row.result) {
            last.points.push((row.slip_ratio, quantity(settled)));
        }
    }
    series
}

fn along_run(
    study: &Reproduction,
    rover: &Rover,
    quantity: fn(&WheelRecord) -> f64,
) -> Vec<Series> {
    let wheels = rover.mounts().iter().enumerate();
    let styles = [Style::Line, Style::Dashed, Style::Dotted];
    let series = wheels.map(|(index, mount)| {
        let samples = &study.start_up.records;
        let points = samples
            .iter()
            .filter_map(|sample| Some((sample.time, quantity(sample.wheels.get(index)?))));
        Series::new(mount.name.as_str(), styles[index % styles.len()], index + 1, points)
    });
    series.collect()
}

/// The slope of the run from rest, in words.
fn start_up_slope(study: &Reproduction) -> String {
    let runs = study.slopes.get(START_UP_ROW).or(study.slopes.first());
    runs.map_or(String::new(), |runs| format!("{}°", runs.measured.slope.to_degrees().round()))
}

fn slip_along_run(study: &Reproduction, rover: &Rover) -> Figure {
    Figure {
        file: "slip-along-run",
        caption: format!(
            "Slip ratio of each wheel in the first moments of a run from rest on {}, with the \
             heading offset. The wheels turn from the first instant; slip settles within a tenth \
             of a second and stays for the rest of the run.",
            start_up_slope(study)
        ),
        chart: Chart::new(
            "Slip along a run from rest",
            ("time [s]", "slip ratio"),
            along_run(study, rover, |wheel| wheel.reaction.slip.ratio),
        ),
    }
}

fn sinkage_along_run(study: &Reproduction, rover: &Rover) -> Figure {
    Figure {
        file: "sinkage-along-run",
        caption: "Sinkage of each wheel in the same run: the downhill wheels carry more and sink \
                  deeper; in the classical model sinkage follows slip at once."
            .into(),
        chart: Chart::new(
            "Sinkage along a run from rest",
            ("time [s]", "sinkage [mm]"),
            along_run(study, rover, |wheel| SINKAGE.unit.from_si(wheel.reaction.settled.sinkage)),
        ),
    }
}
