//! `grouser reproduce`: runs the paper's study and writes its report.

mod report;
mod study;

use std::path::{Path, PathBuf};

use grouser::document::{escape, file};

use self::report::PAPER;
use crate::args::ReproduceArgs;
use crate::failure::Failure;
use crate::output;
use crate::output::folder::{OldFiles, OutputFolder, has_entries};
use crate::output::text::Text;
use crate::report::REPORT;
use crate::report::experiment as against;
use crate::report::page;
use crate::report::tables::{self, Table};

/// The folder without `--out`.
const DEFAULT_FOLDER: &str = "reproduction";

pub(crate) fn run(args: &ReproduceArgs) -> Result<(), Failure> {
    let (target, mut folder) = open_folder(args)?;
    let (scenario, study) = study::run(args.samples)?;
    report::write(&mut folder, &study, &scenario)?;
    folder.finish()?;
    let limit = tables::limit_sentence(&study.paper);
    let verdict = against::lost_yaw_verdict(&study);
    let report = escape::path(&target.join(REPORT));
    output::show(
        Text::from(format!("{PAPER}\n\n"))
            + titled(&against::verdict(&study))
            + format!("\n{limit}\n\n")
            + titled(&against::by_model(&study.paper))
            + "\n"
            + titled(&tables::measured_yaw_drift(&study.paper))
            + "\n"
            + titled(&against::lost_yaw(&study))
            + format!("\n{verdict}\nreport: {report}\n"),
    )
}

/// A table under its caption.
fn titled(table: &Table) -> Text {
    Text::from(format!("{}\n", table.caption)) + table.to_text()
}

/// Opens the output folder: the default one may be replaced if it is an earlier report, another one
/// only with `--force`.
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
