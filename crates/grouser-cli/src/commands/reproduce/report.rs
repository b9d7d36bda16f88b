//! The report: one page, with every number and every figure beside it.

use grouser::contact::validity::Finding;
use grouser::document::LoadedScenario;
use grouser::document::columns::run::table as run_table;
use grouser::document::reading::four_digits;
use grouser::simulation::{Scenario, Trajectory};
use grouser::studies::reproduction::{Reproduction, SlopeRuns};
use grouser::studies::validity::RoverOnSlope;
use grouser_draw::chart::Drawable;

use super::study::SCATTER;
use crate::failure::Failure;
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;
use crate::report::REPORT;
use crate::report::experiment::{self as against, Study};
use crate::report::figures::{self, Figure};
use crate::report::outlines;
use crate::report::page::Page;
use crate::report::tables::{self, Table};

/// The paper. The copy that this was made from names no authors.
pub(super) const PAPER: &str = "The paper: \"Dynamical modeling and simulation of the four-wheel \
                     micro rover in sandy terrain\", Space Robotics Laboratory, Tohoku University, \
                     with the HAKUTO team, about 2017 (the copy at hand prints no authors' names).";

/// A page in the making, and the folder of its numbers.
struct Report<'a> {
    page: Page,
    folder: &'a mut OutputFolder,
}

impl Report<'_> {
    /// A table, and its file.
    fn table(&mut self, table: &Table) -> Result<(), Failure> {
        self.page.table(table);
        self.folder.add(format!("data/{}.csv", table.file), table.to_rows().to_csv()?);
        Ok(())
    }

    /// A figure, its file and that of its numbers.
    fn figure(&mut self, figure: &Figure) -> Result<(), Failure> {
        let svg = figure.chart.to_svg();
        self.page.figure(figure, &svg);
        self.folder.add(format!("figures/{}.svg", figure.file), svg);
        self.folder.add(format!("data/{}.csv", figure.file), figure.rows().to_csv()?);
        Ok(())
    }
}

/// Adds the report and its files to the folder.
pub(super) fn write(
    folder: &mut OutputFolder,
    study: &Study,
    scenario: &LoadedScenario,
) -> Result<(), Failure> {
    let (paper, rover) = (&study.paper, &scenario.value.rover);
    let mut report = Report { page: Page::new("Across a slope on loose soil"), folder };
    opening(&mut report.page, paper);
    report.page.heading("What was reproduced");
    report.table(&against::verdict(study))?;
    report.page.paragraph(&against::caveats(study));
    report.page.heading("The heading that holds the contour");
    report.table(&tables::headings(paper))?;
    report.page.paragraph(&tables::limit_sentence(paper));
    report.figure(&figures::heading(paper, &study.band))?;
    report.table(&against::by_model(paper))?;
    report.page.heading("What the compensation saves");
    report.figure(&figures::traverses(paper))?;
    let outlines = outlines::drawing(paper, rover).to_svg();
    report.page.drawing(&outlines, outlines::CAPTION);
    report.folder.add(format!("figures/{}.svg", outlines::FILE), outlines);
    report.table(&tables::drift(paper))?;
    comparison(&mut report, paper)?;
    second_test(&mut report, paper)?;
    lost_on_the_way(&mut report, study)?;
    report.page.heading("One wheel");
    for figure in figures::of_a_wheel(paper) {
        report.figure(&figure)?;
    }
    report.page.heading("Along a run");
    for figure in figures::along_a_run(paper, rover) {
        report.figure(&figure)?;
    }
    report.page.flags(Some(&findings(paper, &scenario.value)));
    closing(&mut report.page, scenario);
    let page = report.page.to_html();
    add_traverses(folder, paper, &scenario.value)?;
    folder.add_document("scenario.toml", scenario);
    folder.add(REPORT, page);
    Ok(())
}

/// Adds the samples of all traverses.
fn add_traverses(
    folder: &mut OutputFolder,
    study: &Reproduction,
    scenario: &Scenario,
) -> Result<(), Failure> {
    for runs in &study.slopes {
        let slope = runs.measured.slope.to_degrees().round();
        let on_slope = on_slope(scenario, runs);
        let mut add = |name: &str, run: &Trajectory| {
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
    Ok(())
}

/// The scenario of the traverses on a slope.
fn on_slope(scenario: &Scenario, runs: &SlopeRuns) -> Scenario {
    Scenario { ground: scenario.ground.with_slope(runs.measured.slope), ..scenario.clone() }
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
        let others = [&runs.from_measured_yaw_complete, &runs.at_measured_yaw];
        let all = all.into_iter().chain(others).chain(&runs.compensated);
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
         on Toyoura sand, and compares it with the experiment of the paper that the model comes \
         from.",
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

fn comparison(report: &mut Report<'_>, study: &Reproduction) -> Result<(), Failure> {
    report.page.heading("Against the experiment");
    report.table(&tables::table_4(study))?;
    report.page.paragraph(
        "Errors of a yaw are over the predicted yaw, as the paper's printed percentages follow \
         from its printed angles. The paper does not say how its distance errors are formed; ours \
         are rms(y) over the distance along the contour, and |y| at the end, of a simulated run \
         of 20 s from the measured yaw.",
    );
    report.table(&tables::yaw_loss(study))?;
    report.page.paragraph(
        "The paper's model keeps its yaw, the measured rover loses some. With load transfer by the \
         weight alone (quasi-static) the loads follow the wheel forces and the yaw moments cancel. \
         With the torque of the wheels in the pitch balance (quasi-static-torque) the rear wheels \
         carry more and hold the slope better, and the nose falls downhill: the right sign, and on \
         some slopes about the size, of what was measured. The complete load transfer has the \
         wheels' own overturning and aligning moments as well; it is what all other commands take. \
         The length of the measured runs is not printed.",
    );
    Ok(())
}

fn second_test(report: &mut Report<'_>, study: &Reproduction) -> Result<(), Failure> {
    report.page.heading("An untuned second test");
    report.page.paragraph(
        "The measured rover turned on its way, so a heading that holds the contour is to be \
         compared with the mean of its yaw, not with its start.",
    );
    report.table(&tables::mean_yaw(study))?;
    report.page.paragraph(
        "And the yaw can be imposed: held at what was measured, taken to go straight from start to \
         end over the 20 s (assumed), the rover drifts as the balance of forces alone decides. The \
         model's constants were chosen with the headings in view; nothing was tuned to these \
         drifts. The paper prints them without a sign; ours are negative downhill.",
    );
    report.table(&tables::measured_yaw_drift(study))?;
    report.figure(&against::drift(study))
}

fn lost_on_the_way(report: &mut Report<'_>, study: &Study) -> Result<(), Failure> {
    report.page.heading("The yaw lost on the way");
    report.figure(&against::lost_yaw_figure(study))?;
    report.page.answer(&against::lost_yaw_verdict(study));
    report.table(&against::lost_yaw(study))?;
    report.page.paragraph(&format!(
        "Scattered runs have sand whose friction angle differs from place to place by {}° and \
         whose stiffness by {} % (standard deviations, correlated over {} m), and wheels whose \
         speeds differ by {} %; all of that is assumed for a raked bed. Runs that end early, \
         because the rover slides or gets stuck, count with the yaw that they had then. {}",
        four_digits(SCATTER.soil.friction_angle.to_degrees()),
        four_digits(100.0 * SCATTER.soil.stiffness),
        SCATTER.soil.correlation_length,
        four_digits(100.0 * SCATTER.speed),
        against::lengths_sentence(study)
    ));
    Ok(())
}

fn closing(page: &mut Page, scenario: &LoadedScenario) {
    page.heading("Assumptions in force");
    page.list(&scenario.assumptions);
    page.paragraph(
        "Besides these: the slope is plane and the sand homogeneous; wheels are rigid and settle \
         at once; load transfer is quasi-static, by weight and slope, without the wheels' torque \
         unless stated; the wheels' own overturning and aligning moments are neglected; rear \
         wheels meet sand as fresh as the front ones do, unless ruts are named. The band of \
         headings, the yaw lost on the way and the runs that say so have the complete load \
         transfer instead, with the wheels' own moments.",
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
         grouser wheel-test --load-n 20 --slip-ratio 0:1:0.02 --set soil.shear.longitudinal_m=0.03",
    );
    page.paragraph("The scenario in full:");
    page.code(&scenario.to_toml());
}
