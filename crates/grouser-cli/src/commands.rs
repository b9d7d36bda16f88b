//! The commands, each in a module of its own.

mod animation;
pub(crate) mod calibrate;
pub(crate) mod campaign;
pub(crate) mod card;
pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod design;
mod destinations;
pub(crate) mod draw;
pub(crate) mod export_fmu;
pub(crate) mod forecast;
pub(crate) mod heading;
pub(crate) mod heading_map;
pub(crate) mod import;
pub(crate) mod import_telemetry;
pub(crate) mod import_urdf;
pub(crate) mod learn;
mod log;
pub(crate) mod make_terrain;
pub(crate) mod man;
pub(crate) mod map;
mod method;
pub(crate) mod mission;
pub(crate) mod new;
mod place;
pub(crate) mod presets;
pub(crate) mod replay;
pub(crate) mod reproduce;
pub(crate) mod route;
pub(crate) mod sampling;
pub(crate) mod schema;
pub(crate) mod serve;
pub(crate) mod slip_from_current;
mod strict;
mod telemetry;
pub(crate) mod traverse;
pub(crate) mod validate;
pub(crate) mod wheel_test;

use grouser::answers::with_files;
use grouser::document::given_file::GivenFile;
use grouser::document::json;
use serde::Serialize;
use serde_json::Value;

/// A JSON output: what it is, who made it, from what, and the results.
#[derive(Serialize)]
pub(crate) struct Answer<R> {
    schema: String,
    version: &'static str,
    inputs: Value,
    /// What is believed of the soil: its name, the number of samples, and the models with their
    /// shares.
    #[serde(skip_serializing_if = "Option::is_none")]
    belief: Option<Value>,
    /// The models of a band with their shares, where there is a band.
    #[serde(skip_serializing_if = "Option::is_none")]
    model_weights: Option<Value>,
    #[serde(flatten)]
    results: R,
}

/// Adds what files gave to the inputs of an answer, where there are any.
fn add_files(inputs: &mut Value, given: &[GivenFile]) {
    if let Value::Object(inputs) = inputs {
        *inputs = with_files(inputs, given).into_owned();
    }
}

impl<R: Serialize> Answer<R> {
    /// * `inputs`: [`sampling::BELIEF`] and [`sampling::WEIGHTS`] among them stand beside them in the
    ///   answer
    pub(crate) fn new(command: &str, mut inputs: Value, results: R) -> Self {
        let schema = format!("grouser.{command}.v1");
        let mut beside = |key: &str| inputs.as_object_mut().and_then(|inputs| inputs.remove(key));
        let (belief, model_weights) = (beside(sampling::BELIEF), beside(sampling::WEIGHTS));
        Self { schema, version: env!("CARGO_PKG_VERSION"), inputs, belief, model_weights, results }
    }

    /// The text of a line.
    pub(crate) fn to_line(&self) -> String {
        json::line(self) + "\n"
    }

    /// The text for a file.
    pub(crate) fn to_text(&self) -> String {
        json::text(self) + "\n"
    }
}
