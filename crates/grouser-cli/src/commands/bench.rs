//! `grouser bench`: how fast this machine computes, and how accurately.

use std::hint::black_box;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use grouser::contact::InstructionSet;
use grouser::document::reading::four_digits;
use grouser_bench::{Accuracy, Fixtures, OPERATIONS_OF_A_FORCE, Unit};
use serde_json::{Map, Value, json};

use super::Answer;
use crate::args::BenchArgs;
use crate::failure::Failure;
use crate::output;
use crate::output::Format;
use crate::output::rows::{Rows, aligned};

/// The time of a unit of work, and its accuracy.
struct Row {
    what: &'static str,
    key: &'static str,
    value: f64,
    /// Its name for readers.
    unit: &'static str,
    /// Its accuracy: key, value, and text.
    error: Option<(&'static str, f64, String)>,
}

pub(crate) fn run(args: &BenchArgs) -> Result<(), Failure> {
    let fixtures = Fixtures::new()?;
    let budget = Duration::from_secs_f64(args.seconds / Unit::ALL.len() as f64);
    let bar = output::progress_bar(Unit::ALL.len() as u64 + 1);
    bar.set_message("measuring");
    let accuracy = Accuracy::of(&fixtures);
    bar.inc(1);
    let mut rows = Vec::new();
    for unit in Unit::ALL {
        let seconds = best(budget, || fixtures.work(unit).count);
        rows.push(row(unit, seconds, &accuracy));
        if unit == Unit::Operation {
            rows.push(least_of_force(seconds));
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    rows.extend(start_up());
    let set = InstructionSet::best().name();
    let threads = grouser_bench::threads();
    match args.format {
        Format::Table => {
            let header = ["work", "time", "error"].map(str::to_owned);
            let cells = rows.iter().map(|row| {
                let error = row.error.as_ref().map_or("-".to_owned(), |it| it.2.clone());
                vec![row.what.to_owned(), format!("{} {}", four_digits(row.value), row.unit), error]
            });
            let table = aligned(&header, &cells.collect::<Vec<_>>());
            output::print(&format!("{table}\n{set}, {threads} threads; the best of many times\n"))
        }
        Format::Json => {
            output::print_json(&Answer::new("bench", json!({ "seconds": args.seconds }), {
                let mut all = values(&rows);
                all.insert("threads".into(), threads.into());
                all.insert("instruction_set".into(), set.into());
                all
            }))
        }
        Format::Csv => output::print(&Rows::from_maps(vec![values(&rows)]).to_csv()?),
    }
}

fn values(rows: &[Row]) -> Map<String, Value> {
    let times = rows.iter().map(|row| (row.key.to_owned(), json!(row.value)));
    let errors = rows.iter().filter_map(|row| row.error.as_ref());
    times.chain(errors.map(|(key, value, _)| ((*key).to_owned(), json!(value)))).collect()
}

/// The shortest time of one piece of work [s], among all that fit into the budget.
fn best(budget: Duration, mut work: impl FnMut() -> usize) -> f64 {
    let mut shortest = f64::INFINITY;
    let start = Instant::now();
    while shortest.is_infinite() || start.elapsed() < budget {
        let before = Instant::now();
        let count = black_box(work());
        shortest = shortest.min(before.elapsed().as_secs_f64() / count as f64);
    }
    shortest
}

fn row(unit: Unit, seconds: f64, accuracy: &Accuracy) -> Row {
    let of_load = |key, error: f64| Some((key, error, format!("{error:.1e} of the load")));
    let of_way = |key, error: f64| Some((key, error * 1e3, format!("{:.1e} mm", error * 1e3)));
    let force = || of_load("force_error", accuracy.force);
    let settle = || of_load("settle_error", accuracy.settle);
    let (what, factor, name, error) = match unit {
        Unit::Operation => ("multiplication or addition, side by side", 1e9, "ns", None),
        Unit::ForceSingle => ("force of a wheel, one by one", 1e9, "ns", force()),
        Unit::ForceBatched => ("force of a wheel, many", 1e9, "ns", None),
        Unit::SettleSingle => ("settled wheel, one by one", 1e9, "ns", settle()),
        Unit::SettleBatched => ("settled wheel, many", 1e9, "ns", None),
        Unit::SettleFacets => {
            let error = of_load("rft_settle_error", accuracy.settle_facets);
            ("settled wheel of facets, rft", 1e6, "µs", error)
        }
        Unit::SettleOverloaded => ("wheel that the soil cannot carry", 1e9, "ns", None),
        Unit::RoverRates => ("motion of a 4-wheel rover, once", 1e6, "µs", None),
        Unit::TraverseDynamic => {
            let error = of_way("traverse_dynamic_error_mm", accuracy.traverse_dynamic);
            ("traverse of 20 s, dynamic", 1e3, "ms", error)
        }
        Unit::TraverseQuasiSteady => {
            let error = of_way("traverse_quasi_steady_error_mm", accuracy.traverse_quasi_steady);
            ("traverse of 20 s, quasi-steady", 1e3, "ms", error)
        }
        Unit::TraverseDynamicOutcome => ("the same without records, dynamic", 1e3, "ms", None),
        Unit::TraverseQuasiSteadyOutcome => {
            ("the same without records, quasi-steady", 1e3, "ms", None)
        }
        Unit::ControlStep => {
            let error = of_way("control_step_error_mm", accuracy.control_step);
            ("step of 20 ms at new speeds, dynamic", 1e6, "µs", error)
        }
        Unit::ControlStepQuasiSteady => {
            let error =
                of_way("control_step_quasi_steady_error_mm", accuracy.control_step_quasi_steady);
            ("step of 20 ms at new speeds, quasi-steady", 1e6, "µs", error)
        }
        Unit::HeadingCurve => {
            let error = accuracy.heading_curve;
            let shown = format!("{error:.1e} of the weight");
            ("heading offset on 25 slopes", 1e3, "ms", Some(("attitude_curve_error", error, shown)))
        }
        Unit::Campaign => {
            let value = 1.0 / seconds;
            let (what, unit) = ("ends of traverses on varied soil, all cores", "per second");
            return Row { what, key: Unit::Campaign.key(), value, unit, error: None };
        }
    };
    Row { what, key: unit.key(), value: seconds * factor, unit: name, error }
}

/// What the force of a driving wheel takes at least.
///
/// * `operation`: time of a multiplication or an addition [s]
fn least_of_force(operation: f64) -> Row {
    let value = 1e9 * operation * OPERATIONS_OF_A_FORCE;
    let what = "force of a driving wheel, at least";
    Row { what, key: "force_ns_least", value, unit: "ns", error: None }
}

/// Time from the start of the program to its first answer; missing where it cannot start itself.
fn start_up() -> Option<Row> {
    const TIMES: usize = 10;
    let program = std::env::current_exe().ok()?;
    let start = || {
        let before = Instant::now();
        let mut answer = Command::new(&program);
        answer.args(["wheel-test", "--load-n", "17", "--slip-ratio", "0.2"]);
        let status = answer.stdout(Stdio::null()).stderr(Stdio::null()).status().ok()?;
        status.success().then(|| before.elapsed().as_secs_f64())
    };
    let times = std::iter::repeat_with(start).take(TIMES).collect::<Option<Vec<f64>>>()?;
    let value = times.into_iter().fold(f64::INFINITY, f64::min) * 1e3;
    let what = "start of the program to its first answer";
    Some(Row { what, key: "start_up_ms", value, unit: "ms", error: None })
}
