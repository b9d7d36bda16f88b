//! How fast this machine computes, and how accurately: `cargo run --release -p grouser-bench`.

use std::error::Error;
use std::hint::black_box;
use std::io::{Write, stdout};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use clap::{Parser, ValueEnum};
use grouser::answers::{Answer, Member};
use grouser::contact::InstructionSet;
use grouser::document::reading::four_digits;
use grouser_bench::{Accuracy, Fixtures, OPERATIONS_OF_A_FORCE, Unit};
use serde_json::json;

/// Measures how fast this machine computes, and how accurately.
#[derive(Debug, Parser)]
#[command(name = "grouser-bench", version)]
struct Arguments {
    /// Time to measure, in all [s], 0.1 to 600: the longer, the smaller the effect of other work on
    /// the machine.
    #[arg(long, value_name = "S", default_value_t = 10.0, value_parser = seconds)]
    seconds: f64,
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    format: Printed,
}

/// How times are printed.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum Printed {
    /// For reading: aligned columns, few digits.
    #[default]
    Table,
    /// For programs: every digit.
    Json,
    /// For spreadsheets: every digit, a header.
    Csv,
}

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

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    let rows = measured(arguments.seconds)?;
    let set = InstructionSet::best().name();
    let threads = grouser_bench::threads();
    let text = match arguments.format {
        Printed::Table => {
            format!("{}\n{set}, {threads} threads; the best of many times\n", table(&rows))
        }
        Printed::Json => {
            let mut answer = Answer::new("bench", "Times and errors");
            answer.input("seconds", arguments.seconds);
            let values = values(&rows).into_iter().map(|(key, it)| Member::Value(key, json!(it)));
            answer.results.extend(values);
            answer.results.push(Member::Value("threads", json!(threads)));
            answer.results.push(Member::Value("instruction_set", json!(set)));
            serde_json::to_string_pretty(&answer)? + "\n"
        }
        Printed::Csv => {
            let (keys, numbers): (Vec<&str>, Vec<String>) =
                values(&rows).into_iter().map(|(key, it)| (key, it.to_string())).unzip();
            format!("{}\n{}\n", keys.join(","), numbers.join(","))
        }
    };
    Ok(stdout().write_all(text.as_bytes())?)
}

fn seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| format!("'{text}' is not a number"))?;
    let range = 0.1..=600.0;
    range.contains(&seconds).then_some(seconds).ok_or_else(|| "it must be 0.1 to 600".to_owned())
}

/// A row for each unit of work.
///
/// * `seconds`: time for all of them together [s]
fn measured(seconds: f64) -> Result<Vec<Row>, Box<dyn Error>> {
    let fixtures = Fixtures::new()?;
    let budget = Duration::from_secs_f64(seconds / Unit::ALL.len() as f64);
    let accuracy = Accuracy::of(&fixtures);
    let mut rows = Vec::new();
    for unit in Unit::ALL {
        let seconds = best(budget, || fixtures.work(unit).count);
        rows.push(row(unit, seconds, &accuracy));
        if unit == Unit::Operation {
            rows.push(least_of_force(seconds));
        }
    }
    rows.extend(start_up());
    Ok(rows)
}

/// The rows in aligned columns.
fn table(rows: &[Row]) -> String {
    let cells = |row: &Row| {
        let error = row.error.as_ref().map_or("-", |(_, _, text)| text);
        [row.what.to_owned(), format!("{} {}", four_digits(row.value), row.unit), error.to_owned()]
    };
    let header = ["work", "time", "error"].map(str::to_owned);
    let lines: Vec<[String; 3]> = [header].into_iter().chain(rows.iter().map(cells)).collect();
    let width = |column: usize| {
        lines.iter().map(|line| line[column].chars().count()).max().unwrap_or_default()
    };
    let (first, second) = (width(0), width(1));
    let line =
        |[what, time, error]: &[String; 3]| format!("{what:<first$}  {time:<second$}  {error}\n");
    lines.iter().map(line).collect()
}

/// All times, then all errors, by their keys.
fn values(rows: &[Row]) -> Vec<(&'static str, f64)> {
    let times = rows.iter().map(|row| (row.key, row.value));
    let errors = rows.iter().filter_map(|row| row.error.as_ref());
    times.chain(errors.map(|(key, value, _)| (*key, *value))).collect()
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
        Unit::RandomStep => {
            let error = of_way("random_step_error_mm", accuracy.random_step);
            ("step of 20 ms at random speeds, dynamic", 1e6, "µs", error)
        }
        Unit::StopAndGoStep => {
            let error = of_way("stop_and_go_step_error_mm", accuracy.stop_and_go_step);
            ("step of 20 ms with rests, dynamic", 1e6, "µs", error)
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

/// Time from the start of the program to its first answer; missing where it is not built beside
/// this one.
fn start_up() -> Option<Row> {
    const TIMES: usize = 10;
    let name = format!("grouser{}", std::env::consts::EXE_SUFFIX);
    let program = std::env::current_exe().ok()?.with_file_name(name);
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
