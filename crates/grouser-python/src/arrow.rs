//! Columns of a result as an Arrow stream, by Arrow's C interface.

use std::collections::HashMap;
use std::ffi::CStr;
use std::sync::Arc;

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{
    ArrayRef, BooleanArray, Float64Array, Int64Array, RecordBatch, RecordBatchIterator, StringArray,
};
use arrow_schema::{ArrowError, Field, Schema};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;

use crate::errors;

/// The name of the capsule in the interface. Source: Arrow, *The Arrow PyCapsule Interface*.
const STREAM: &CStr = c"arrow_array_stream";

/// A column as it comes from Python: one of the kinds that results have.
#[derive(FromPyObject)]
pub(crate) enum Column<'py> {
    /// Numbers; NaN is a missing one.
    Numbers(PyReadonlyArray1<'py, f64>),
    /// Whole numbers.
    Integers(PyReadonlyArray1<'py, i64>),
    /// Truth values.
    Truths(PyReadonlyArray1<'py, bool>),
    /// Texts, some of which are missing.
    Texts(Vec<Option<String>>),
}

impl Column<'_> {
    fn to_array(&self) -> ArrayRef {
        match self {
            Self::Numbers(numbers) => {
                let cells = numbers.as_array();
                let present = cells.iter().map(|number| (!number.is_nan()).then_some(*number));
                Arc::new(present.collect::<Float64Array>())
            }
            Self::Integers(numbers) => {
                Arc::new(Int64Array::from_iter_values(numbers.as_array().iter().copied()))
            }
            Self::Truths(truths) => Arc::new(BooleanArray::from(truths.as_array().to_vec())),
            Self::Texts(texts) => Arc::new(texts.iter().collect::<StringArray>()),
        }
    }
}

/// A capsule with a stream of one batch. A column without unit has no metadata.
///
/// * `columns`: name, unit and cells of each, all of one length
/// * `notes`: metadata of the whole
#[pyfunction]
pub(crate) fn arrow_stream<'py>(
    py: Python<'py>,
    columns: Vec<(String, Option<String>, Column<'py>)>,
    notes: HashMap<String, String>,
) -> PyResult<Bound<'py, PyCapsule>> {
    let mut fields = Vec::with_capacity(columns.len());
    let mut arrays = Vec::with_capacity(columns.len());
    for (name, unit, cells) in columns {
        let array = cells.to_array();
        let field = Field::new(name, array.data_type().clone(), true);
        let units: HashMap<String, String> =
            unit.map(|unit| ("units".to_owned(), unit)).into_iter().collect();
        fields.push(field.with_metadata(units));
        arrays.push(array);
    }
    let schema = Arc::new(Schema::new_with_metadata(fields, notes));
    let batch = RecordBatch::try_new(Arc::clone(&schema), arrays).map_err(|error| unfit(&error))?;
    let batches = RecordBatchIterator::new([Ok::<_, ArrowError>(batch)], schema);
    PyCapsule::new_with_value(py, FFI_ArrowArrayStream::new(Box::new(batches)), STREAM)
}

fn unfit(error: &ArrowError) -> PyErr {
    errors::parameter(error.to_string(), "columns", None, "columns of one length")
}
