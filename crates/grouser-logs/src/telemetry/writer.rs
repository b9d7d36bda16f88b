//! Writes telemetry, `telemetry/1`, as CSV or Parquet.

use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

use grouser_core::vehicle::Rover;
use grouser_io::measurements::telemetry::{
    TelemetryRecord, column_names, csv_header, csv_line, numbers,
};
use parquet::basic::{Compression, Repetition, Type as PhysicalType};
use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

/// Rows of a group of Parquet: a column then takes half a megabyte of memory.
const GROUP: usize = 1 << 16;

/// A table of telemetry on its way.
pub struct TelemetryWriter<W> {
    out: W,
    kind: Kind,
}

enum Kind {
    Csv,
    /// Its bytes are collected in memory, and passed on after each group of rows.
    Parquet {
        writer: Box<SerializedFileWriter<Vec<u8>>>,
        columns: Vec<Vec<Option<f64>>>,
    },
}

impl<W: Write> TelemetryWriter<W> {
    /// Begins a table with all columns of a rover: Parquet for a name that ends with `.parquet`, or
    /// else CSV.
    ///
    /// # Errors
    /// Those of what is written to.
    pub fn begin(name: &Path, mut out: W, rover: &Rover) -> io::Result<Self> {
        let is_parquet = name.extension().is_some_and(|it| it.eq_ignore_ascii_case("parquet"));
        if !is_parquet {
            out.write_all(csv_header(rover).as_bytes())?;
            return Ok(Self { out, kind: Kind::Csv });
        }
        let names = column_names(rover);
        let field = |name: &String| {
            let field = Type::primitive_type_builder(name, PhysicalType::DOUBLE);
            field.with_repetition(Repetition::OPTIONAL).build().map(Arc::new)
        };
        let fields = names.iter().map(field).collect::<Result<_, _>>().map_err(io_error)?;
        let schema = Type::group_type_builder("telemetry").with_fields(fields).build();
        let schema = Arc::new(schema.map_err(io_error)?);
        let properties = WriterProperties::builder().set_compression(Compression::UNCOMPRESSED);
        let writer = SerializedFileWriter::new(Vec::new(), schema, Arc::new(properties.build()));
        let columns = vec![Vec::new(); names.len()];
        Ok(Self {
            out,
            kind: Kind::Parquet { writer: Box::new(writer.map_err(io_error)?), columns },
        })
    }

    /// Adds a record.
    ///
    /// # Errors
    /// Those of what is written to.
    pub fn write(&mut self, record: &TelemetryRecord) -> io::Result<()> {
        match &mut self.kind {
            Kind::Csv => self.out.write_all(csv_line(record).as_bytes()),
            Kind::Parquet { writer, columns } => {
                for (column, number) in columns.iter_mut().zip(numbers(record)) {
                    column.push(number);
                }
                if columns.first().is_some_and(|it| it.len() >= GROUP) {
                    write_group(writer, columns).map_err(io_error)?;
                    writer.flush()?;
                    self.out.write_all(writer.inner())?;
                    writer.inner_mut().clear();
                }
                Ok(())
            }
        }
    }

    /// Writes the rest; what it was written to comes back.
    ///
    /// # Errors
    /// Those of what is written to.
    pub fn finish(mut self) -> io::Result<W> {
        if let Kind::Parquet { mut writer, mut columns } = self.kind {
            if columns.first().is_some_and(|it| !it.is_empty()) {
                write_group(&mut writer, &mut columns).map_err(io_error)?;
            }
            self.out.write_all(&writer.into_inner().map_err(io_error)?)?;
        }
        self.out.flush()?;
        Ok(self.out)
    }
}

fn io_error(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(inner) => match inner.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(other) => io::Error::other(other),
        },
        other => io::Error::other(other),
    }
}

/// Writes the rows of all columns as a group, and empties them.
fn write_group(
    writer: &mut SerializedFileWriter<Vec<u8>>,
    columns: &mut [Vec<Option<f64>>],
) -> Result<(), ParquetError> {
    let mut group = writer.next_row_group()?;
    for values in columns {
        let Some(mut column) = group.next_column()? else { break };
        let present: Vec<f64> = values.iter().flatten().copied().collect();
        let levels: Vec<i16> = values.iter().map(|it| i16::from(it.is_some())).collect();
        column.typed::<DoubleType>().write_batch(&present, Some(&levels), None)?;
        column.close()?;
        values.clear();
    }
    group.close().map(drop)
}
