//! `grouser reproduce`: runs the paper's study and writes its report.

use std::path::{Path, PathBuf};

use grouser::contact::Theory;
use grouser::contact::validity::Finding;
use grouser::document::columns::run::table as run_table;
use grouser::document::{self, LoadedScenario, Overrides, Source, escape, experiment, file};
use grouser::simulation::{Scatter, Scenario};
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::heading::HeadingStudy;
use grouser::studies::heading_band::HeadingBand;
use grouser::studies::lost_yaw::LostYawPlan;
use grouser::studies::reproduction::{Plan, Reproduction, ReproductionError, SlopeRuns};
use grouser::studies::validity::RoverOnSlope;
use grouser::terrain::SoilScatter;

use super::sampling;
use crate::args::ReproduceArgs;
use crate::failure::Failure;
use crate::output;
use crate::output::folder::{OldFiles, OutputFolder, has_entries};
use crate::output::rows::Rows;
use crate::report::experiment::{self as against, Study};
use crate::report::figures::Figure;
use crate::report::page::{self, Page};
use crate::report::tables::{self, Table};
use crate::report::{figures, outlines};

/// The paper. The copy that this was made from names no authors.
const PAPER: &str = "The paper: \"Dynamical modeling and simulation of the four-wheel micro rover in sandy terrain\", Space \
                     Robotics Laboratory, Tohoku University, with the HAKUTO team, about 2017 (the copy at hand \
                     prints no authors' names).";

/// The folder without `--out`.
const DEFAULT_FOLDER: &str = "reproduction";
/// The file by which a folder is known as an earlier reproduction's.
const REPORT: &str = "report.html";

/// Load transfer of the paper's model, its Eqs 12-14: by the weight and the slope alone.
const PAPERS_LOADS: &str = "quasi-static";

/// Load in the paper's single-wheel test [N]: "about 20N", its section 4.1.
const WHEEL_LOAD: f64 = 20.0;
/// K_x at slip angle 0 [m]: Table 3; a value that would explain the paper's *attitude* on 20°; and
/// what its section 4.2 prints after tuning.
const LONGITUDINAL_MODULI: [f64; 3] = [0.036, 0.030, 0.3];

/// Slip angles of the wheel curves [°]; the rover's own are below 22°.
const SLIP_ANGLES_DEG: [f64; 3] = [0.0, 15.0, 30.0];
/// Models whose headings stand beside those of the paper's.
const OTHER_MODELS: [Theory; 2] = [Theory::Rft, Theory::Bekker];
/// What scatters where the yaw that is lost is explained: 1° of friction, a tenth of stiffness, half a per cent of
/// speed. Source: assumed, for a raked bed and motors under speed control.
const SCATTER: Scatter = Scatter {
    soil: SoilScatter {
        friction_angle: std::f64::consts::PI / 180.0,
        stiffness: 0.1,
        correlation_length: Scatter::USUAL_LENGTH,
    },
    speed: 0.005,
    seed: 0,
};
/// Other correlation lengths that are tried [m]: about a footprint's length, and that of the bed.
const OTHER_LENGTHS: [f64; 2] = [0.1, 1.0];
/// The sand as it is known for the band of headings.
const UNCERTAIN_SOIL: &str = "toyoura-uncertain";
/// Slopes of that band, 1° apart, to this one [°].
const LAST_SLOPE_DEG: u32 = 24;
/// Seed of all samples.
const SEED: u64 = 1;

/// Loads of the sinkage curves [N]: half of, about, and twice what the rover's wheels carry.
const LOADS: [f64; 3] = [10.0, 20.0, 40.0];

impl From<ReproductionError> for Failure {
    fn from(error: ReproductionError) -> Self {
        match error {
            ReproductionError::Parameter(error) => error.into(),
            ReproductionError::Simulation(error) => error.into(),
        }
    }
}

pub(crate) fn run(args: &ReproduceArgs) -> Result<(), Failure> {
    let (target, mut folder) = open_folder(args)?;
    let mut as_in_the_paper = Overrides::none();
    as_in_the_paper.flag_text("--load-transfer", "scenario.load_transfer", PAPERS_LOADS)?;
    let scenario = document::read_scenario(&Source::default_scenario(), &as_in_the_paper)?;
    let plan = Plan {
        scenario: scenario.value.clone(),
        measured: experiment::table_4(),
        wheel_load: WHEEL_LOAD,
        longitudinal_moduli: LONGITUDINAL_MODULI.to_vec(),
        slip_angles: SLIP_ANGLES_DEG.map(f64::to_radians).to_vec(),
        loads: LOADS.to_vec(),
        other_models: OTHER_MODELS.to_vec(),
    };
    let paper = run_with_bar(&plan)?;
    let study = Study {
        band: band(args.samples)?,
        lost: lost_yaw(&plan, args.samples)?,
        other_lengths: OTHER_LENGTHS.to_vec(),
        paper,
    };
    write_report(&mut folder, &study, &scenario)?;
    folder.finish()?;
    output::print(&format!(
        "{PAPER}\n\n{}\n{}\n\n{}\n{}\n{}\n{}\nreport: {}\n",
        titled(&against::verdict(&study)),
        tables::limit_sentence(&study.paper),
        titled(&against::by_model(&study.paper)),
        titled(&tables::measured_yaw_drift(&study.paper)),
        titled(&against::lost_yaw(&study)),
        against::lost_yaw_verdict(&study),
        escape::path(&target.join(REPORT))
    ))
}

/// A table under its caption.
fn titled(table: &Table) -> String {
    format!("{}\n{}", table.caption, table.to_text())
}

/// Opens the output folder: the default one may be replaced if it is an earlier report, another one only with `--force`.
fn open_folder(args: &ReproduceArgs) -> Result<(PathBuf, OutputFolder), Failure> {
    let (target, old_files) = match &args.out {
        Some(out) if args.force => (out.clone(), OldFiles::Replace),
        Some(out) => (out.clone(), OldFiles::Keep),
        None => {
            let target = PathBuf::from(DEFAULT_FOLDER);
            if has_entries(&target)? && !is_ours(&target.join(REPORT)) {
                return Err(Failure::Usage(format!(
                    "the folder {DEFAULT_FOLDER} holds other files than a report of this program: \
                     name another folder with --out DIR"
                )));
            }
            (target, OldFiles::Replace)
        }
    };
    let folder = OutputFolder::open(&target, old_files)?;
    Ok((target, folder))
}

/// Whether a file is a report that this program wrote.
fn is_ours(report: &Path) -> bool {
    /// A report has about half a megabyte.
    const LARGEST: u64 = 1 << 26;
    let marks = |html: &[u8]| String::from_utf8_lossy(html).contains(page::GENERATOR);
    file::read(report, LARGEST).is_ok_and(|html| marks(&html))
}

fn run_with_bar(plan: &Plan) -> Result<Reproduction, Failure> {
    with_bar(plan.step_count(), |progress| Ok(plan.run(progress)?))
}

/// Computes with a bar that goes on with every step.
fn with_bar<T>(
    steps: usize,
    compute: impl FnOnce(&mut dyn FnMut(&str)) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let bar = output::progress_bar(steps as u64);
    let mut begun = 0;
    let found = compute(&mut |step| {
        bar.set_position(begun);
        bar.set_message(step.to_owned());
        begun += 1;
    });
    bar.finish_and_clear();
    found
}

/// Headings where soil and model are uncertain, with complete loads.
fn band(samples: u32) -> Result<Vec<grouser::studies::heading_band::SlopeBand>, Failure> {
    let mut uncertain = Overrides::none();
    uncertain.flag_text("--soil", "scenario.soil", UNCERTAIN_SOIL)?;
    let scenario = document::read_scenario(&Source::default_scenario(), &uncertain)?;
    let samples = sampling::draw(&BandInputs::of_scenario(&scenario), samples, SEED)?;
    let slopes: Vec<f64> =
        (1..=LAST_SLOPE_DEG).map(|slope| f64::from(slope).to_radians()).collect();
    let study = HeadingStudy::of(&scenario.value);
    let band = sampling::with_bar(samples.len(), |go_on| {
        HeadingBand::of(&study, &samples, &slopes, go_on)
    });
    Ok(sampling::whole(band?).slopes)
}

/// The yaw lost on the way, with complete loads.
fn lost_yaw(
    plan: &Plan,
    samples: u32,
) -> Result<Vec<grouser::studies::lost_yaw::SlopeLoss>, Failure> {
    let plan = LostYawPlan {
        scenario: document::read_scenario(&Source::default_scenario(), &Overrides::none())?.value,
        measured: plan.measured.clone(),
        scatter: SCATTER,
        other_lengths: OTHER_LENGTHS.to_vec(),
        samples,
        seed: SEED,
    };
    with_bar(plan.step_count(), |progress| Ok(plan.run(progress)?))
}

fn write_report(
    folder: &mut OutputFolder,
    study: &Study,
    scenario: &LoadedScenario,
) -> Result<(), Failure> {
    let (rover, whole) = (&scenario.value.rover, study);
    let study = &whole.paper;
    let all_tables = [
        tables::headings(study),
        tables::table_4(study),
        tables::yaw_loss(study),
        tables::mean_yaw(study),
        tables::measured_yaw_drift(study),
        tables::drift(study),
        against::verdict(whole),
        against::by_model(study),
        against::lost_yaw(whole),
    ];
    let mut page = Page::new("Across a slope on loose soil");
    opening(&mut page, study);
    let [
        headings,
        table_4,
        yaw_loss,
        mean_yaw,
        measured_yaw_drift,
        drift,
        verdict,
        by_model,
        lost_yaw,
    ] = &all_tables;
    let mut drawn = figures::all(study, rover, &whole.band).into_iter();
    let add = |page: &mut Page, folder: &mut OutputFolder, figure: Figure| -> Result<(), Failure> {
        let svg = figure.chart.to_svg();
        page.figure(&figure, &svg);
        folder.add(format!("figures/{}.svg", figure.file), svg);
        folder.add(format!("data/{}.csv", figure.file), figure.rows().to_csv()?);
        Ok(())
    };
    let mut draw = |page: &mut Page, folder: &mut OutputFolder| {
        drawn.next().map_or(Ok(()), |figure| add(page, folder, figure))
    };

    page.heading("What was reproduced");
    page.table(verdict);
    page.paragraph(&against::caveats(whole));
    page.heading("The heading that holds the contour");
    page.table(headings);
    page.paragraph(&tables::limit_sentence(study));
    draw(&mut page, folder)?;
    page.table(by_model);
    page.heading("What the compensation saves");
    draw(&mut page, folder)?;
    let seen = outlines::drawing(study, rover).to_svg();
    page.drawing(&seen, outlines::CAPTION);
    folder.add(format!("figures/{}.svg", outlines::FILE), seen);
    page.table(drift);
    page.heading("Against the experiment");
    comparison(&mut page, table_4, yaw_loss);
    page.heading("An untuned second test");
    second_test(&mut page, mean_yaw, measured_yaw_drift);
    add(&mut page, folder, against::drift(study))?;
    page.heading("The yaw lost on the way");
    add(&mut page, folder, against::lost_yaw_figure(whole))?;
    lost_on_the_way(&mut page, whole, lost_yaw);
    page.heading("One wheel");
    for _ in 0..5 {
        draw(&mut page, folder)?;
    }
    page.heading("Along a run");
    draw(&mut page, folder)?;
    draw(&mut page, folder)?;
    page.flags(&findings(study, &scenario.value));
    closing(&mut page, scenario);

    for table in &all_tables {
        folder.add(format!("data/{}.csv", table.file), table.to_rows().to_csv()?);
    }
    for runs in &study.slopes {
        let slope = runs.measured.slope.to_degrees().round();
        let on_slope = on_slope(&scenario.value, runs);
        let mut add = |name: &str, run: &grouser::simulation::Trajectory| {
            let rows = Rows::of_table(&run_table(run, &on_slope)).to_csv()?;
            folder.add(format!("data/traverse-{slope}deg-{name}.csv"), rows);
            Ok::<(), Failure>(())
        };
        add("nose-level", &runs.uncompensated)?;
        add("from-measured-yaw", &runs.from_measured_yaw)?;
        add("from-measured-yaw-torque", &runs.from_measured_yaw_with_torque)?;
        add("from-measured-yaw-complete", &runs.from_measured_yaw_complete)?;
        add("at-measured-yaw", &runs.at_measured_yaw)?;
        runs.compensated.as_ref().map_or(Ok(()), |run| add("at-attitude", run))?;
    }
    folder.add_document("scenario.toml", scenario);
    folder.add(REPORT, page.to_html());
    Ok(())
}

/// The scenario of the traverses on a slope.
fn on_slope(scenario: &Scenario, runs: &SlopeRuns) -> Scenario {
    Scenario { site: scenario.site.with_slope(runs.measured.slope), ..scenario.clone() }
}

/// The flags of all wheel tests and traverses of the study.
fn findings(study: &Reproduction, scenario: &Scenario) -> Vec<Finding> {
    let curves = study.wheel_curves.iter().flat_map(|curve| &curve.rows);
    let tests = curves.chain(&study.by_slip_angle).chain(&study.by_load);
    let tests = tests.flat_map(|row| row.findings.clone());
    let runs = study.slopes.iter().flat_map(|runs| {
        let scenario = on_slope(scenario, runs);
        let all =
            [&runs.uncompensated, &runs.from_measured_yaw, &runs.from_measured_yaw_with_torque];
        let all = all.into_iter().chain(&runs.compensated);
        let raised = all.flat_map(|run| RoverOnSlope::of(&scenario).over(run));
        raised.map(|raised| raised.finding).collect::<Vec<_>>()
    });
    tests.chain(runs).collect()
}

fn opening(page: &mut Page, study: &Reproduction) {
    page.paragraph(PAPER);
    page.paragraph(
        "A four-wheel rover that crosses a slope of loose sand slides downhill as it drives. \
         Pointed uphill by the right angle it stays on the contour instead. Which angle is right \
         depends on the soil, the wheels and the slope; this page computes it for the HAKUTO rover \
         on Toyoura sand, and compares it with the experiment of the paper that the model comes from.",
    );
    let answers = study.slopes.iter().filter_map(|runs| {
        let heading = runs.heading.as_ref().ok()?;
        let slope = runs.measured.slope.to_degrees().round();
        Some(format!("{:.1}° on {slope}°", heading.yaw.to_degrees()))
    });
    let answers: Vec<String> = answers.collect();
    page.answer(&format!(
        "Point the nose uphill by {}. {}",
        answers.join(", "),
        tables::limit_sentence(study)
    ));
}

fn comparison(page: &mut Page, table_4: &Table, yaw_loss: &Table) {
    page.table(table_4);
    page.paragraph(
        "Errors of a yaw are over the predicted yaw, as the paper's printed percentages follow \
         from its printed angles. The paper does not say how its distance errors are formed; ours \
         are rms(y) over the distance along the contour, and |y| at the end, of a simulated run \
         of 20 s from the measured yaw.",
    );
    page.table(yaw_loss);
    page.paragraph(
        "The paper's model keeps its yaw, the measured rover loses some. With load transfer by the \
         weight alone (quasi-static) the loads follow the wheel forces and the yaw moments cancel. With \
         the torque of the wheels in the pitch balance (quasi-static-torque) the rear wheels carry \
         more and hold the slope better, and the nose falls downhill: the right sign, and on some \
         slopes about the size, of what was measured. The complete load transfer has the wheels' own \
         overturning and aligning moments as well; it is what all other commands take. The length of \
         the measured runs is not printed.",
    );
}

fn second_test(page: &mut Page, mean_yaw: &Table, measured_yaw_drift: &Table) {
    page.paragraph(
        "The measured rover turned on its way, so a heading that holds the contour is to be \
         compared with the mean of its yaw, not with its start.",
    );
    page.table(mean_yaw);
    page.paragraph(
        "And the yaw can be imposed: held at what was measured, taken to go straight from start to \
         end over the 20 s (assumed), the rover drifts as the balance of forces alone decides. The \
         model's constants were chosen with the headings in view; nothing was tuned to these drifts. \
         The paper prints them without a sign; ours are negative downhill.",
    );
    page.table(measured_yaw_drift);
}

fn lost_on_the_way(page: &mut Page, study: &Study, lost_yaw: &Table) {
    page.answer(&against::lost_yaw_verdict(study));
    page.table(lost_yaw);
    page.paragraph(&format!(
        "Scattered runs have sand whose friction angle differs from place to place by 1° and whose stiffness by a tenth \
         (standard deviations, correlated over {} m), and wheels whose speeds differ by half a per cent; all of that is \
         assumed for a raked bed. {}",
        Scatter::USUAL_LENGTH,
        against::lengths_sentence(study)
    ));
}

fn closing(page: &mut Page, scenario: &LoadedScenario) {
    page.heading("Assumptions in force");
    page.list(&scenario.assumptions);
    page.paragraph(
        "Besides these: the slope is plane and the sand homogeneous; wheels are rigid and settle \
         at once; load transfer is quasi-static, by weight and slope, without the wheels' torque \
         unless stated; the wheels' own overturning and aligning moments are neglected; rear \
         wheels meet sand as fresh as the front ones do.",
    );
    page.heading("How the numbers were made");
    page.paragraph(&format!(
        "By Grouser {}, from the documents that come with it; data/ and figures/ beside this page \
         hold every number and every figure, scenario.toml the rover, soil and drive of every run; \
         slopes and measured yaws are those of the tables above. The same numbers, one \
         at a time:",
        env!("CARGO_PKG_VERSION")
    ));
    page.code(
        "grouser heading --slope-deg 5,10,15,20 --load-transfer quasi-static\n\
         grouser traverse --slope-deg 10 --yaw-deg 0 --load-transfer quasi-static\n\
         grouser traverse --slope-deg 10 --yaw-deg 5.51 --load-transfer quasi-static-torque\n\
         grouser traverse --slope-deg 10 --load-transfer quasi-static \\\n    \
         --set 'scenario.drive.yaw_deg=[[0, 5.51], [20, 3.10]]'\n\
         grouser wheel-test --load-n 20 --slip-ratio 0:1:0.02 --set soil.shear.longitudinal_m=0.03\n\
         grouser traverse --slope-deg 10 --yaw-deg 5.51 --set scenario.scatter.friction_angle_std_deg=1 \\\n    \
         --set scenario.scatter.stiffness_std=0.1 --set scenario.scatter.speed_std=0.005",
    );
    page.paragraph("The scenario in full:");
    page.code(&scenario.to_toml());
}
