//! The reproduction against the experiment: what was compared and how far off it is, other models,
//! drift, and the yaw lost on the way.

use grouser::contact::Model;
use grouser::document::columns::{SLOPE, YAW};
use grouser::document::reading::rounded_down;
use grouser::document::unit::MM;
use grouser::studies::comparison::{Levelness, MeasuredTraverse};
use grouser::studies::heading_band::SlopeBand;
use grouser::studies::lost_yaw::SlopeLoss;
use grouser::studies::reproduction::{Reproduction, SlopeRuns};
use grouser_draw::chart::{Chart, Series, Style};
use serde_json::{Map, Value, json};

use super::figures::Figure;
use super::tables::{Table, column, printed, row_of};

/// All that the report is made of.
pub(crate) struct Study {
    /// The paper's study.
    pub(crate) paper: Reproduction,
    /// Headings where soil and model are uncertain, over slope.
    pub(crate) band: Vec<SlopeBand>,
    /// The yaw lost on the way, on each measured slope.
    pub(crate) lost: Vec<SlopeLoss>,
    /// Other correlation lengths of the soil that were tried [m].
    pub(crate) other_lengths: Vec<f64>,
}

// ---- What was reproduced ----

/// Each figure and table of the paper: what could be compared, how far off it is, and what is
/// missing.
pub(crate) fn verdict(study: &Study) -> Table {
    let mut rows = vec![
        taken("Tables 1, 2, 3", "taken as printed", "wheel radius, width, grousers; unit of k'φ"),
        taken(
            "Fig. 7",
            "shape of drawbar pull over slip",
            "the measured points as numbers; with the printed K_x of 0.3 no wheel pulls",
        ),
        taken(
            "Fig. 9",
            "drift stops where the nose is turned uphill",
            "coordinates of the paths, length of the runs",
        ),
    ];
    let slopes = &study.paper.slopes;
    rows.extend(slopes.iter().map(heading_row));
    rows.extend(slopes.iter().map(drift_row));
    rows.extend(slopes.iter().map(distance_row));
    rows.extend(study.lost.iter().map(lost_row));
    Table {
        caption: "What was reproduced: how far Grouser is off, in per cent",
        file: "what-was-reproduced",
        columns: vec![
            column("where", "in the paper", 0),
            column("compared", "compared", 0),
            column(SLOPE.name, "slope [°]", 0),
            column("off_model_percent", "from its model [%]", 0),
            column("off_measured_percent", "from measurement [%]", 0),
            column("not_printed", "what the paper does not print", 0),
        ],
        rows,
    }
}

fn taken(place: &str, compared: &str, not_printed: &str) -> Map<String, Value> {
    row_of(json!({ "where": place, "compared": compared, "not_printed": not_printed }))
}

fn percent_off(ours: f64, theirs: f64) -> f64 {
    100.0 * (ours - theirs) / theirs
}

fn heading_row(runs: &SlopeRuns) -> Map<String, Value> {
    let measured = &runs.measured;
    let ours = runs.heading.as_ref().ok().map(|heading| heading.yaw);
    row_of(json!({
        "where": "Fig. 10",
        "compared": "heading that holds the contour, with the mean measured yaw",
        (SLOPE.name): printed(measured.slope),
        "off_model_percent": ours.map(|yaw| percent_off(yaw, measured.model_yaw)),
        "off_measured_percent": ours.map(|yaw| percent_off(yaw, measured.mean_yaw())),
        "not_printed": "the curve as numbers",
    }))
}

fn drift_row(runs: &SlopeRuns) -> Map<String, Value> {
    let ours = runs.at_measured_yaw.last().state.position.y.abs();
    table_4_row(
        "final distance, held at the measured yaw",
        &runs.measured,
        percent_off(ours, runs.measured.final_distance_error),
        "its sign, and the yaw over time",
    )
}

fn distance_row(runs: &SlopeRuns) -> Map<String, Value> {
    let ours = Levelness::of(&runs.at_measured_yaw).rms_distance_error;
    table_4_row(
        "RMS distance, held at the measured yaw",
        &runs.measured,
        percent_off(ours, runs.measured.rms_distance_error),
        "how it is formed",
    )
}

fn lost_row(loss: &SlopeLoss) -> Map<String, Value> {
    table_4_row(
        "yaw lost on the way, with complete loads",
        &loss.measured,
        percent_off(loss.by_loads, loss.measured.yaw_loss()),
        "repetitions, length of the runs",
    )
}

/// * `off`: from the measurement [%]
fn table_4_row(
    compared: &str,
    measured: &MeasuredTraverse,
    off: f64,
    not_printed: &str,
) -> Map<String, Value> {
    row_of(json!({
        "where": "Table 4",
        "compared": compared,
        (SLOPE.name): printed(measured.slope),
        "off_measured_percent": off,
        "not_printed": not_printed,
    }))
}

/// What the numbers are worth.
pub(crate) fn caveats(study: &Study) -> String {
    let end = study.paper.headings.limit().ok().map(|(slope, _)| SLOPE.unit.from_si(slope));
    let near = end.map_or(String::new(), |end| {
        format!(
            " 20° lies {:.1}° before the end of our curve, {}°: there a small change of the \
             soil moves the heading by degrees.",
            end - 20.0,
            rounded_down(end)
        )
    });
    format!(
        "This is a reproduction, no validation: the exit angle's ratio λ, the bulldozing law and \
         the reading of k'φ were chosen with these four headings in view. A heading that holds the \
         contour is compared with the mean of a run's yaw, not with its start; the run on 20° was \
         started high on purpose, at 21.63°, and ended at 12.05°, so that its agreement with a \
         start is none.{near}"
    )
}

// ---- Other models ----

/// Headings by all models beside the mean of the measured yaw.
pub(crate) fn by_model(study: &Reproduction) -> Table {
    let key = |model: &Model| match model {
        Model::Ishigami => "ishigami_yaw_deg",
        Model::SmallWheel => "small_wheel_yaw_deg",
        Model::Bekker => "bekker_yaw_deg",
        Model::Rft => "rft_yaw_deg",
        Model::Own(_) => "own_yaw_deg",
    };
    let row = |runs: &SlopeRuns| {
        let slope = runs.measured.slope;
        let mut row = row_of(json!({
            (SLOPE.name): printed(slope),
            "measured_mean_yaw_deg": printed(runs.measured.mean_yaw()),
            "ishigami_yaw_deg": runs.heading.as_ref().ok().map(|it| YAW.unit.from_si(it.yaw)),
        }));
        for (model, curve) in &study.other_headings {
            let yaw = curve.at(slope).ok().map(|it| YAW.unit.from_si(it.yaw));
            row.insert(key(model).to_owned(), json!(yaw));
        }
        row
    };
    let mut columns = vec![
        column(SLOPE.name, "slope", 0),
        column("measured_mean_yaw_deg", "measured, mean", 2),
        column("ishigami_yaw_deg", "ishigami", 2),
    ];
    let others = study.other_headings.iter();
    columns.extend(others.map(|(model, _)| column(key(model), model.name(), 2)));
    Table {
        caption: "Heading offset that holds the contour by each wheel-soil model, in degrees; a \
                  dash where none does",
        file: "models",
        columns,
        rows: study.slopes.iter().map(row).collect(),
    }
}

// ---- Drift at the measured yaw ----

/// Measured and predicted drift over slope.
pub(crate) fn drift(study: &Reproduction) -> Figure {
    let points = |of: fn(&SlopeRuns) -> f64| {
        let point =
            |runs: &SlopeRuns| (SLOPE.unit.from_si(runs.measured.slope), MM.from_si(of(runs)));
        study.slopes.iter().map(point).collect::<Vec<_>>()
    };
    let ours = points(|runs| runs.at_measured_yaw.last().state.position.y.abs());
    let level = points(|runs| runs.uncompensated.last().state.position.y.abs());
    Figure {
        file: "drift-at-measured-yaw",
        caption: "Distance from the contour at the end of a run that is held at the measured yaw, \
                  predicted and measured, beside that of a run with its nose along the contour. \
                  The paper prints no sign; all predictions are downhill."
            .into(),
        chart: Chart::new(
            "Drift at the measured yaw",
            ("slope [°]", "distance from the contour [mm]"),
            vec![
                Series::new("nose along the contour", Style::Dotted, 3, level),
                Series::new("at the measured yaw, predicted", Style::Squares, 1, ours),
                Series::new(
                    "measured",
                    Style::Dots,
                    2,
                    points(|runs| runs.measured.final_distance_error),
                ),
            ],
        ),
    }
}

// ---- The yaw lost on the way ----

/// The yaw that is lost: measured, by loads, and by what scatters.
pub(crate) fn lost_yaw(study: &Study) -> Table {
    let row = |loss: &SlopeLoss| {
        let degrees = |angle: f64| YAW.unit.from_si(angle);
        let [friction_angle, stiffness, speed] = loss.alone.map(|it| degrees(it.deviation));
        row_of(json!({
            (SLOPE.name): printed(loss.measured.slope),
            "measured_yaw_loss_deg": printed(loss.measured.yaw_loss()),
            "complete_yaw_loss_deg": degrees(loss.by_loads),
            "ruts_yaw_loss_deg": degrees(loss.by_ruts),
            "yaw_loss_low_deg": degrees(loss.together.losses.low),
            "yaw_loss_high_deg": degrees(loss.together.losses.high),
            "lose_less_percent": 100.0 * loss.below_measured.estimate(),
            "ended_early_percent": 100.0 * loss.together.ended_early.estimate(),
            "friction_angle_std_deg": friction_angle,
            "stiffness_std_deg": stiffness,
            "speed_std_deg": speed,
            "together_std_deg": degrees(loss.together.deviation),
        }))
    };
    Table {
        caption: "Yaw lost on the way from the measured start, in degrees: by complete loads \
                  alone, with rear wheels in compacted ruts too, and with soil and speeds that \
                  scatter; standard deviations by each cause alone and by all",
        file: "lost-yaw",
        columns: vec![
            column(SLOPE.name, "slope", 0),
            column("measured_yaw_loss_deg", "measured", 2),
            column("complete_yaw_loss_deg", "loads alone", 2),
            column("ruts_yaw_loss_deg", "with ruts", 2),
            column("yaw_loss_low_deg", "95 % of runs: from", 2),
            column("yaw_loss_high_deg", "to", 2),
            column("lose_less_percent", "runs that lose less than measured [%]", 0),
            column("ended_early_percent", "end early [%]", 0),
            column("friction_angle_std_deg", "± friction", 2),
            column("stiffness_std_deg", "± stiffness", 2),
            column("speed_std_deg", "± speed", 2),
            column("together_std_deg", "± all", 2),
        ],
        rows: study.lost.iter().map(row).collect(),
    }
}

/// The picture of it.
pub(crate) fn lost_yaw_figure(study: &Study) -> Figure {
    let point = |loss: &SlopeLoss, value: f64| {
        (SLOPE.unit.from_si(loss.measured.slope), YAW.unit.from_si(value))
    };
    let over = |of: &dyn Fn(&SlopeLoss) -> f64| {
        study.lost.iter().map(|loss| point(loss, of(loss))).collect::<Vec<_>>()
    };
    let edges = study.lost.iter().map(|loss| {
        let (slope, low) = point(loss, loss.together.losses.low);
        (slope, low, point(loss, loss.together.losses.high).1)
    });
    let torque = study.paper.slopes.iter().map(|runs| {
        let loss = Levelness::of(&runs.from_measured_yaw_with_torque).yaw_loss;
        (SLOPE.unit.from_si(runs.measured.slope), YAW.unit.from_si(loss))
    });
    Figure {
        file: "lost-yaw",
        caption: format!(
            "Yaw lost in 20 s from the measured starts. The line is what complete loads take on \
                  even sand with even motors, the dotted one with rear wheels in compacted ruts; \
                  the band holds 95 % of {} runs on each slope in which friction, stiffness and \
                  speeds scatter. With loads by the weight alone, as in the paper, nothing is \
                  lost.",
            study.lost.first().map_or(0, |loss| loss.below_measured.trials)
        ),
        chart: Chart::new(
            "The yaw lost on the way",
            ("slope [°]", "yaw lost [°]"),
            vec![
                Series::band("95 % of scattered runs", 6, edges),
                Series::new("complete loads", Style::Line, 1, over(&|loss| loss.by_loads)),
                Series::new("with ruts", Style::Dotted, 4, over(&|loss| loss.by_ruts)),
                Series::new("the wheels' torque in pitch alone", Style::Dashed, 3, torque),
                Series::new("measured", Style::Dots, 2, over(&|loss| loss.measured.yaw_loss())),
            ],
        ),
    }
}

/// Whether loads and scatter explain what was measured.
pub(crate) fn lost_yaw_verdict(study: &Study) -> String {
    let name = |loss: &SlopeLoss| format!("{:.0}°", SLOPE.unit.from_si(loss.measured.slope));
    let slopes = |which: &dyn Fn(&SlopeLoss) -> bool| {
        let found: Vec<String> = study.lost.iter().filter(|loss| which(loss)).map(name).collect();
        if found.is_empty() { "none".to_owned() } else { found.join(", ") }
    };
    let measured = |loss: &SlopeLoss| loss.measured.yaw_loss();
    let more = slopes(&|loss| measured(loss) > loss.together.losses.high);
    let less = slopes(&|loss| measured(loss) < loss.together.losses.low);
    let inside = study.lost.iter().filter(|loss| {
        (loss.together.losses.low..=loss.together.losses.high).contains(&measured(loss))
    });
    let inside = inside.count();
    let all = study.lost.len();
    let verdict = match inside {
        0 => "It explains none of them.",
        some if some == all => "It explains them all.",
        _ => "It does not explain them all.",
    };
    let mean = |of: &dyn Fn(&SlopeLoss) -> f64| {
        YAW.unit.from_si(study.lost.iter().map(of).sum::<f64>() / all as f64)
    };
    let (ours, theirs) = (mean(&|loss| loss.by_loads), mean(&measured));
    format!(
        "Of the {all} measured losses {inside} lie within what complete loads and this scatter \
         give in 95 % of runs. More than that was lost on: {more}; less on: {less}. {verdict} Over \
         the slopes the loads take {ours:.1}° and {theirs:.1}° were measured, as far as is printed \
         in one run each. Nothing here was tuned to these runs; repeated runs on one slope would \
         tell."
    )
}

/// How much of the scatter hangs on the correlation length.
pub(crate) fn lengths_sentence(study: &Study) -> String {
    let deviations = |place: usize| {
        let of =
            |loss: &SlopeLoss| format!("{:.2}", YAW.unit.from_si(loss.by_length[place].deviation));
        study.lost.iter().map(of).collect::<Vec<_>>().join("/")
    };
    let each = study.other_lengths.iter().enumerate();
    let each = each.map(|(place, length)| format!("{} with {length} m", deviations(place)));
    format!(
        "Standard deviations with other correlation lengths of the soil, in degrees: {}.",
        each.collect::<Vec<_>>().join("; ")
    )
}
