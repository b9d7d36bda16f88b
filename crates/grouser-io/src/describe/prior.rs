//! `prior/1`: what is believed of a soil's numbers that its source does not print.

use super::super::field::{Each, Table, list, note, text};
use super::super::stated::{KeywordPrior, Pair, Parameter, Priors};
use super::about::{name, notes, schema};
use super::uncertainty::{CORRELATION_OF_PRIOR, OF_PRIOR, REASON_DOC};

pub(crate) static PRIORS: Table<Priors> = Table {
    doc: "What is believed of the numbers of a soil that its source does not print, or prints \
          without saying how well they are known.",
    fields: &[
        schema("prior/1"),
        name(),
        note("source", "Where the rows come from.").optional(),
        notes(),
        list(
            "missing",
            "Numbers that a soil does not state: a single answer takes the median, a band draws.",
            &Each {
                inner: &OF_PRIOR,
                list: |all: &mut Priors| &mut all.missing,
                blank: Parameter::blank,
            },
            0,
        )
        .optional(),
        list(
            "keyword",
            "Keywords that a soil does not state.",
            &Each {
                inner: &KEYWORD,
                list: |all: &mut Priors| &mut all.keywords,
                blank: KeywordPrior::default,
            },
            0,
        )
        .optional(),
        list(
            "stated",
            "How well a stated number is known, where the soil does not say: bands draw about it.",
            &Each {
                inner: &OF_PRIOR,
                list: |all: &mut Priors| &mut all.stated,
                blank: Parameter::blank,
            },
            0,
        )
        .optional(),
        list(
            "correlation",
            "Correlations between them; pairs that are not named have none.",
            &Each {
                inner: &CORRELATION_OF_PRIOR,
                list: |all: &mut Priors| &mut all.correlations,
                blank: Pair::default,
            },
            0,
        )
        .optional(),
    ],
};

static KEYWORD: Table<KeywordPrior> = Table {
    doc: "A keyword that a soil does not state.",
    fields: &[
        text(
            "key",
            0,
            "A keyword of a soil, with the tables it stands in: `bulldozing.law`.",
            |it, key| {
                key.clone_into(&mut it.key);
            },
        ),
        text("word", 1, "The keyword that stands there.", |it: &mut KeywordPrior, word| {
            word.clone_into(&mut it.word);
        }),
        text("reason", 0, REASON_DOC, |it: &mut KeywordPrior, reason| {
            reason.clone_into(&mut it.reason);
        })
        .optional(),
        note("source", "Where it was read.").optional(),
    ],
};
