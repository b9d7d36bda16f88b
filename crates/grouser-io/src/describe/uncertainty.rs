//! Uncertainty of numbers: the same keys for soils and campaigns.

use super::super::field::{
    Each, Field, Law, Laws, Number, OF_KEY, ONE, Reach, Shape, Table, Texts, field, list, number,
    text,
};
use crate::statistics::Marginal;

/// The uncertain numbers of a document.
#[derive(Clone, Debug, Default)]
pub struct Stated {
    pub samples: Option<Samples>,
    pub parameters: Vec<Parameter>,
    pub correlations: Vec<Pair>,
}

/// The place of rows of samples.
#[derive(Clone, Debug)]
pub enum Samples {
    /// In a CSV file, from the folder of the document.
    File(String),
    /// In the document.
    Inline(String),
}

/// An uncertain number.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its key, with the tables it stands in.
    pub key: String,
    /// Its distribution; the mean is NaN where it is left out.
    pub marginal: Marginal,
}

/// Two keys that are correlated.
#[derive(Clone, Debug, Default)]
pub struct Pair {
    pub between: [String; 2],
    pub value: f64,
}

impl Parameter {
    /// Its mean, if its distribution has one.
    fn mean_mut(&mut self) -> Option<&mut f64> {
        match &mut self.marginal {
            Marginal::Normal { mean, .. } | Marginal::Lognormal { mean, .. } => Some(mean),
            Marginal::Uniform { .. } | Marginal::Triangular { .. } => None,
        }
    }

    /// Whether its mean is left out.
    pub fn has_no_mean(&self) -> bool {
        self.clone().mean_mut().is_some_and(|mean| mean.is_nan())
    }

    /// Its distribution, about a value unless it has a mean of its own.
    pub fn around(&self, value: f64) -> Marginal {
        let mut whole = self.clone();
        if let Some(mean) = whole.mean_mut().filter(|mean| mean.is_nan()) {
            *mean = value;
        }
        whole.marginal
    }
}

/// The `[uncertainty]` of a soil.
pub static UNCERTAINTY: Table<Stated> = Table {
    doc: "How well the numbers of a soil are known: keys with distributions, or rows of samples.",
    fields: &[
        field("samples", SAMPLES_DOC, Shape::TextOr(FILE_DOC, put_file, &INLINE)).optional(),
        list("parameter", PARAMETERS_DOC, &Each { inner: &OF_SOIL, ..PARAMETERS }, 0).optional(),
        list("correlation", CORRELATIONS_DOC, &CORRELATIONS, 0).optional(),
    ],
};

// ---- Samples ----

pub const SAMPLES_DOC: &str =
    "Rows of numbers that belong together, such as a posterior's: each run takes one of them.";
pub const FILE_DOC: &str =
    "A CSV file, from the folder of this document: columns are keys, rows are samples.";

pub fn put_file(all: &mut Stated, name: &str) {
    all.samples = Some(Samples::File(name.to_owned()));
}

pub static INLINE: Table<Stated> = Table {
    doc: "The table itself.",
    fields: &[text(
        "csv",
        0,
        "What a CSV file would say: keys in the first line, a sample in every other.",
        |all: &mut Stated, csv| all.samples = Some(Samples::Inline(csv.to_owned())),
    )],
};

// ---- Distributions ----

pub const PARAMETERS_DOC: &str =
    "The numbers that are not known exactly, each with its distribution.";

pub const PARAMETERS: Each<Stated, Parameter> = Each {
    inner: &OF_CAMPAIGN,
    list: |all| &mut all.parameters,
    blank: || Parameter { key: String::new(), marginal: NORMAL },
};

static OF_CAMPAIGN: Laws<Parameter> = PARAMETER;
static OF_SOIL: Laws<Parameter> =
    Laws { may_be_left_out: true, is_written_last: true, ..PARAMETER };

const PARAMETER: Laws<Parameter> = Laws {
    doc: "A number that is not known exactly. Its distribution is cut off at the ends of the key's range.",
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
                fields: &[
                    KEY,
                    anywhere("mean", MEAN_DOC, Parameter::mean_mut).optional(),
                    STANDARD_DEVIATION,
                ],
            },
        },
        Law {
            name: "lognormal",
            word: None,
            choose: |it| {
                it.marginal = Marginal::Lognormal { mean: UNSET, standard_deviation: UNSET };
            },
            table: Table {
                doc: "Of a number above zero whose logarithm is normal.",
                fields: &[
                    KEY,
                    field("mean", MEAN_DOC, Shape::Number(ABOVE_ZERO, Parameter::mean_mut))
                        .optional(),
                    STANDARD_DEVIATION,
                ],
            },
        },
        Law {
            name: "uniform",
            word: None,
            choose: |it| it.marginal = Marginal::Uniform { low: UNSET, high: UNSET },
            table: Table { doc: "Every value between two alike.", fields: &[KEY, LOW, HIGH] },
        },
        Law {
            name: "triangular",
            word: None,
            choose: |it| {
                it.marginal = Marginal::Triangular { low: UNSET, mode: UNSET, high: UNSET };
            },
            table: Table {
                doc: "Most likely at a value, less and less towards two ends.",
                fields: &[KEY, LOW, MODE, HIGH],
            },
        },
    ],
};

/// What a number is before a document's is put in; a mean that is left out stays so.
const UNSET: f64 = f64::NAN;
const NORMAL: Marginal = Marginal::Normal { mean: UNSET, standard_deviation: UNSET };

const KEY: Field<Parameter> = text(
    "key",
    0,
    "A number of this document or, in a campaign, of what is varied, with the tables it stands in: `pressure_sinkage.k_phi`, `soil.cohesion_kpa`.",
    |it, key| key.clone_into(&mut it.key),
);

const MEAN_DOC: &str = "Its mean, in the unit of the key; without it, the value that the key has";
const ABOVE_ZERO: Number = Number { unit: OF_KEY, least: 0.0, most: 1e12, is_open: true };

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

// ---- Correlations ----

pub const CORRELATIONS_DOC: &str = "Correlations between them; pairs that are not named have none.";

pub static CORRELATIONS: Each<Stated, Pair> =
    Each { inner: &CORRELATION, list: |all| &mut all.correlations, blank: Pair::default };

static CORRELATION: Table<Pair> = Table {
    doc: "How two keys go together.",
    fields: &[
        field(
            "between",
            "Two of the uncertain keys.",
            Shape::Texts(Texts {
                least: 2,
                most: Some(2),
                put: |pair, end, key| key.clone_into(&mut pair.between[end]),
            }),
        ),
        number(
            "value",
            ONE,
            -1.0..=1.0,
            "Their correlation (of the logarithm, where a key is lognormal)",
            |pair: &mut Pair| Some(&mut pair.value),
        ),
    ],
};
