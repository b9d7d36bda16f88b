//! Uncertainty of numbers: the same keys for soils and campaigns.

use super::super::field::{
    Allowed, Each, Field, Law, Laws, Number, OF_KEY, ONE, Reach, Shape, Table, Texts, field, list,
    note, number, text, word, words,
};
use super::super::stated::{NORMAL, Pair, Parameter, Samples, Soils, Stated, UNSET};
use crate::statistics::Marginal;

/// The `[uncertainty]` of a soil.
pub(crate) static UNCERTAINTY: Table<Stated> = Table {
    doc: "How well the numbers of a soil are known: keys with distributions, or rows of samples.",
    fields: &[
        field("samples", SAMPLES_DOC, Shape::TextOr(FILE_DOC, put_file, &INLINE)).optional(),
        list("parameter", PARAMETERS_DOC, &Each { inner: &OF_SOIL, ..PARAMETERS }, 0).optional(),
        list("correlation", CORRELATIONS_DOC, &CORRELATIONS, 0).optional(),
    ],
};

// ---- Samples ----

pub(crate) const SAMPLES_DOC: &str =
    "Rows of numbers that belong together, such as a posterior's: each run takes one of them.";
pub(crate) const FILE_DOC: &str = "A CSV file, from the folder of this document: columns are keys, rows are samples. A column \
     `model` names the wheel–soil model that a row is believed under, and `weight` how much the row \
     counts: rows of a model weigh the same and stand in a random order.";

pub(crate) fn put_file(all: &mut Stated, name: &str) {
    all.samples = Some(Samples::File(name.to_owned()));
}

pub(crate) static INLINE: Table<Stated> = Table {
    doc: "The table itself.",
    fields: &[text(
        "csv",
        0,
        "What a CSV file would say: keys in the first line, a sample in every other.",
        |all: &mut Stated, csv| all.samples = Some(Samples::Inline(csv.to_owned())),
    )],
};

// ---- Distributions ----

pub(crate) const PARAMETERS_DOC: &str =
    "The numbers that are not known exactly, each with its distribution.";

pub(crate) const PARAMETERS: Each<Stated, Parameter> =
    Each { inner: &OF_CAMPAIGN, list: |all| &mut all.parameters, blank: Parameter::blank };

static OF_CAMPAIGN: Laws<Parameter> = PARAMETER;
static OF_SOIL: Laws<Parameter> =
    Laws { may_be_left_out: true, is_written_last: true, ..PARAMETER };

const PARAMETER: Laws<Parameter> = Laws {
    doc: "A number that is not known exactly. Its distribution is cut off at the ends of the key's \
          range.",
    key: "distribution",
    may_be_left_out: false,
    is_written_last: false,
    all: &[
        Law {
            name: "normal",
            word: None,
            choose: |it| it.marginal = NORMAL,
            table: Table {
                doc: "Symmetric about its mean.",
                fields: &[KEY, MEAN, STANDARD_DEVIATION],
            },
        },
        Law {
            name: "lognormal",
            word: None,
            choose: lognormal,
            table: Table {
                doc: "Of a number above zero whose logarithm is normal.",
                fields: &[KEY, MEAN_ABOVE_ZERO, STANDARD_DEVIATION],
            },
        },
        Law {
            name: "uniform",
            word: None,
            choose: uniform,
            table: Table { doc: "Every value between two alike.", fields: &[KEY, LOW, HIGH] },
        },
        Law {
            name: "triangular",
            word: None,
            choose: triangular,
            table: Table {
                doc: "Most likely at a value, less and less towards two ends.",
                fields: &[KEY, LOW, MODE, HIGH],
            },
        },
    ],
};

pub(super) const KEY: Field<Parameter> = text(
    "key",
    0,
    "A number of this document or, in a campaign, of what is varied, with the tables it stands in: \
     `pressure_sinkage.k_phi`, `soil.cohesion_kpa`.",
    |it, key| key.clone_into(&mut it.key),
);

fn lognormal(it: &mut Parameter) {
    it.marginal = Marginal::Lognormal { mean: UNSET, standard_deviation: UNSET };
}

fn uniform(it: &mut Parameter) {
    it.marginal = Marginal::Uniform { low: UNSET, high: UNSET };
}

fn triangular(it: &mut Parameter) {
    it.marginal = Marginal::Triangular { low: UNSET, mode: UNSET, high: UNSET };
}

const MEAN: Field<Parameter> = anywhere("mean", MEAN_DOC, Parameter::mean_mut).optional();
const MEAN_ABOVE_ZERO: Field<Parameter> =
    field("mean", MEAN_DOC, Shape::Number(ABOVE_ZERO, Parameter::mean_mut)).optional();
const MEAN_DOC: &str = "Its mean, in the unit of the key; without it, the value that the key has";
const ABOVE_ZERO: Number =
    Number { unit: OF_KEY, least: 0.0, most: 1e12, is_open: true, is_direction: false };

const STANDARD_DEVIATION: Field<Parameter> = number(
    "standard_deviation",
    OF_KEY,
    0.0..=1e12,
    "Its standard deviation, in the unit of the key",
    |it| match &mut it.marginal {
        Marginal::Normal { standard_deviation, .. }
        | Marginal::Lognormal { standard_deviation, .. } => Some(standard_deviation),
        Marginal::Uniform { .. } | Marginal::Triangular { .. } => None,
    },
);
const LOW: Field<Parameter> =
    anywhere("low", "The lower end, in the unit of the key", |it| match &mut it.marginal {
        Marginal::Uniform { low, .. } | Marginal::Triangular { low, .. } => Some(low),
        Marginal::Normal { .. } | Marginal::Lognormal { .. } => None,
    });
const MODE: Field<Parameter> =
    anywhere("mode", "The most likely value, in the unit of the key", |it| {
        if let Marginal::Triangular { mode, .. } = &mut it.marginal { Some(mode) } else { None }
    });
const HIGH: Field<Parameter> =
    anywhere("high", "The upper end, in the unit of the key", |it| match &mut it.marginal {
        Marginal::Uniform { high, .. } | Marginal::Triangular { high, .. } => Some(high),
        Marginal::Normal { .. } | Marginal::Lognormal { .. } => None,
    });

/// A number of any size, in the unit of the key that it is about.
const fn anywhere(
    key: &'static str,
    doc: &'static str,
    reach: Reach<Parameter>,
) -> Field<Parameter> {
    number(key, OF_KEY, -1e12..=1e12, doc, reach)
}

// ---- Rows of priors ----

pub(super) static OF_PRIOR: Laws<Parameter> = Laws {
    doc: "What is believed of a number of a soil.",
    key: "distribution",
    may_be_left_out: true,
    is_written_last: true,
    all: &[
        Law {
            name: "normal",
            word: None,
            choose: |it| it.marginal = NORMAL,
            table: Table {
                doc: "Symmetric about its mean.",
                fields: &[
                    KEY_OF_PRIOR,
                    RELATIVE_TO,
                    MEAN,
                    MEDIAN,
                    STANDARD_DEVIATION,
                    SOILS,
                    UNLESS,
                    WHEN,
                    REASON,
                    SOURCE,
                ],
            },
        },
        Law {
            name: "lognormal",
            word: None,
            choose: lognormal,
            table: Table {
                doc: "Of a number above zero whose logarithm is normal.",
                fields: &[
                    KEY_OF_PRIOR,
                    RELATIVE_TO,
                    MEAN_ABOVE_ZERO,
                    MEDIAN_ABOVE_ZERO,
                    STANDARD_DEVIATION,
                    SOILS,
                    UNLESS,
                    WHEN,
                    REASON,
                    SOURCE,
                ],
            },
        },
        Law {
            name: "uniform",
            word: None,
            choose: uniform,
            table: Table {
                doc: "Every value between two alike.",
                fields: &[
                    KEY_OF_PRIOR,
                    RELATIVE_TO,
                    LOW,
                    HIGH,
                    SOILS,
                    UNLESS,
                    WHEN,
                    REASON,
                    SOURCE,
                ],
            },
        },
        Law {
            name: "triangular",
            word: None,
            choose: triangular,
            table: Table {
                doc: "Most likely at a value, less and less towards two ends.",
                fields: &[
                    KEY_OF_PRIOR,
                    RELATIVE_TO,
                    LOW,
                    MODE,
                    HIGH,
                    SOILS,
                    UNLESS,
                    WHEN,
                    REASON,
                    SOURCE,
                ],
            },
        },
    ],
};

const KEY_OF_PRIOR: Field<Parameter> =
    Field { doc: "A number of a soil, with the tables it stands in: `exit.ratio`.", ..KEY };
const RELATIVE_TO: Field<Parameter> = text(
    "relative_to",
    0,
    "A number of the soil of which the numbers of this row are multiples; without it, they are in \
     the key's unit.",
    |it: &mut Parameter, key| key.clone_into(&mut it.belief.relative_to),
)
.optional();
const MEDIAN: Field<Parameter> =
    anywhere("median", MEDIAN_DOC, |it| Some(&mut it.belief.median)).optional();
const MEDIAN_ABOVE_ZERO: Field<Parameter> = field(
    "median",
    MEDIAN_DOC,
    Shape::Number(ABOVE_ZERO, |it: &mut Parameter| Some(&mut it.belief.median)),
)
.optional();
const MEDIAN_DOC: &str = "Its median, in place of the mean";
const SOILS: Field<Parameter> = words(
    "soils",
    "The soils that it is about, by their `consistency`; without it, all.",
    &[
        word("any", "All soils.", |it: &mut Parameter| it.belief.soils = Soils::Any),
        word("loose", "Loose soils, and those that do not say.", |it: &mut Parameter| {
            it.belief.soils = Soils::Loose;
        }),
        word("firm", "Firm soils.", |it: &mut Parameter| it.belief.soils = Soils::Firm),
    ],
)
.optional();
const UNLESS: Field<Parameter> = text(
    "unless",
    0,
    "A table, or a key, of the soil: the row is only for soils that do not have it.",
    |it: &mut Parameter, key| key.clone_into(&mut it.belief.unless),
)
.optional();
const WHEN: Field<Parameter> = text(
    "when",
    0,
    "A keyword of the soil and what it has to be, as `known_from.shear=copied`: the row is only \
     for soils that have it.",
    |it: &mut Parameter, when| when.clone_into(&mut it.belief.when),
)
.optional();
const REASON: Field<Parameter> = text("reason", 0, REASON_DOC, |it: &mut Parameter, reason| {
    reason.clone_into(&mut it.belief.reason);
})
.optional();
const SOURCE: Field<Parameter> =
    note("source", "Where it was read; with `assumed` before it, what stands for a source.")
        .optional();
pub(super) const REASON_DOC: &str =
    "Why it is so, in a sentence; a document of its own must have it.";

// ---- Correlations ----

pub(crate) const CORRELATIONS_DOC: &str =
    "Correlations between them; pairs that are not named have none.";

pub(crate) static CORRELATIONS: Each<Stated, Pair> =
    Each { inner: &CORRELATION, list: |all| &mut all.correlations, blank: Pair::default };

static CORRELATION: Table<Pair> =
    Table { doc: "How two keys go together.", fields: &[BETWEEN, CORRELATION_VALUE] };

/// The same with its reason.
pub(super) static CORRELATION_OF_PRIOR: Table<Pair> = Table {
    doc: "How two keys go together, and why.",
    fields: &[BETWEEN, CORRELATION_VALUE, note("reason", REASON_DOC).optional()],
};

const BETWEEN: Field<Pair> = field(
    "between",
    "Two of the uncertain keys.",
    Shape::Texts(Texts {
        least: 2,
        most: Some(2),
        allowed: Allowed::All,
        put: |pair, end, key| key.clone_into(&mut pair.between[end]),
    }),
);
const CORRELATION_VALUE: Field<Pair> = number(
    "value",
    ONE,
    -1.0..=1.0,
    "Their correlation (of the logarithm, where a key is lognormal)",
    |pair: &mut Pair| Some(&mut pair.value),
);
