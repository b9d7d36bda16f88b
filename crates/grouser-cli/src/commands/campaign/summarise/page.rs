//! The page of a summary.

use grouser::document::Campaign;
use grouser_draw::chart::Drawable;
use grouser_store::{Figure, Results, Statistics};

use crate::commands::campaign::digest::DigestRecord;
use crate::report::page::Page;

pub(super) fn html(
    campaign: &Campaign,
    results: &Results,
    statistics: &Statistics,
    digest: &DigestRecord,
    figures: &[Figure],
) -> String {
    let manifest = results.manifest();
    let mut page = Page::new(&manifest.name);
    page.answer(&statistics.sentence());
    let part =
        manifest.part.map_or(String::new(), |part| format!(", of which this is part {part}"));
    page.list([
        format!("{} runs{part}, seed {}", manifest.runs, manifest.seed),
        format!("grouser {}", manifest.version),
        digest.line().trim_end().to_owned(),
    ]);
    page.heading("Numbers");
    page.paragraph(
        "Quantiles are over the runs that have a result; their intervals hold for any \
         distribution; a dash in one is an end that so few runs do not bound. All intervals are \
         for independent samples: those of a Latin hypercube or a Sobol design are rather too \
         wide. Of a campaign for sensitivities, quantiles and probabilities are over the runs of \
         both independent sets, A and B.",
    );
    for table in statistics.tables() {
        page.grid(table.caption, &table.header, &table.cells);
    }
    page.heading("Figures");
    for figure in figures {
        page.drawing(&figure.chart.to_svg(), &figure.caption);
    }
    // Typed where the campaign's folder is: a summary knows no way to it.
    page.heading("What to do next");
    page.paragraph("With the campaign's folder, and a run's number, in place of the capitals:");
    page.code("grouser campaign rerun CAMPAIGN RUN\ngrouser campaign cost STUDY.toml");
    page.folded("Assumptions in force", |page| page.list(campaign.assumptions()));
    page.folded("The study", |page| page.code(results.study()));
    page.to_html()
}
