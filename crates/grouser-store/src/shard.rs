//! A shard's rows as the bytes of a Parquet file, and back.
//!
//! The bytes depend on the study, the shard's number and its rows alone: one group of rows, fixed
//! settings, no times, no compression (sampled numbers have nothing to compress, and what repeats
//! goes into a dictionary). The footer has study, version, number, columns with their units, and
//! the SHA-256 of the whole file, computed with zeros in that place.

use std::collections::HashSet;
use std::sync::Arc;

use bytes::Bytes;
use grouser::document::campaign::Column;
use grouser::document::table::{BETWEEN_NAMES, ColumnKind, Table, Values};
use parquet::basic::{Compression, Encoding, LogicalType, Repetition, Type as PhysicalType};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::{ParquetError, Result as ParquetResult};
use parquet::file::metadata::{FileMetaData, KeyValue};
use parquet::file::properties::{EnabledStatistics, WriterProperties, WriterPropertiesBuilder};
use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::{ColumnPath, Type};
use serde_json::json;
use sha2::{Digest as _, Sha256};

use crate::error::{ShardFault, StoreError};
use crate::identity::ColumnRecord;
pub use crate::identity::Identity;
use crate::study::{Study, VERSION, hex};

const SCHEMA_KEY: &str = "grouser.schema";
const SCHEMA: &str = "grouser.campaign.shard.v1";
const STUDY_KEY: &str = "grouser.study_sha256";
const VERSION_KEY: &str = "grouser.version";
const SHARD_KEY: &str = "grouser.shard";
const COLUMNS_KEY: &str = "grouser.columns";
/// Key of the SHA-256 of the file with zeros in place of this value.
const HASH_KEY: &str = "grouser.file_sha256";
/// Digits of a SHA-256.
const HASH_DIGITS: usize = 64;
/// The digest that stands in a file while its own is computed.
const ZEROS: [u8; HASH_DIGITS] = [b'0'; HASH_DIGITS];

/// The name of a shard's file.
#[must_use]
pub fn file_name(shard: u64) -> String {
    format!("part-{shard:06}.parquet")
}

/// The number of the shard that a file is named for.
#[must_use]
pub fn number_of(name: &str) -> Option<u64> {
    let digits = name.strip_prefix("part-")?.strip_suffix(".parquet")?;
    let shard = digits.parse().ok()?;
    (file_name(shard) == name).then_some(shard)
}

// ---- Writing ----

/// The bytes of a shard's file.
///
/// # Errors
/// [`StoreError::Parquet`] if the table is not one of the study's columns and the shard's rows;
/// [`StoreError::Shard`] if its texts are so long that no reader would take it
/// ([`Identity::most_bytes`]).
pub fn encode(study: &Study, shard: u64, table: &Table) -> Result<Vec<u8>, StoreError> {
    let runs = study.runs_of(shard);
    let fits = table.columns.len() == study.columns.len()
        && table.columns.iter().all(|(_, values)| values.len() as u64 == runs.end - runs.start);
    if !fits {
        return Err(ParquetError::General("the table is not one of this study".into()).into());
    }
    let fields = study.columns.iter().map(field).collect::<ParquetResult<Vec<_>>>()?;
    let schema = Type::group_type_builder("runs").with_fields(fields).build()?;
    let properties = Arc::new(properties(study, shard, table));
    let mut writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), properties)?;
    let mut group = writer.next_row_group()?;
    for (_, values) in &table.columns {
        let Some(mut column) = group.next_column()? else { break };
        write(&mut column, values)?;
        column.close()?;
    }
    group.close()?;
    let mut file = writer.into_inner()?;
    let (bytes, most) = (file.len() as u64, study.identity(shard).most_bytes());
    if bytes > most {
        return Err(StoreError::Shard { shard, fault: ShardFault::TooLarge { bytes, most } });
    }
    sign(&mut file);
    Ok(file)
}

/// Puts the file's hash in its place.
fn sign(file: &mut [u8]) {
    if let Some(place) = hash_place(file) {
        let hash = hex(&Sha256::digest(&*file));
        file[place..place + HASH_DIGITS].copy_from_slice(hash.as_bytes());
    }
}

/// Where in a file its hash stands: after its key and the two bytes by which Thrift says "a text of
/// 64 bytes".
fn hash_place(file: &[u8]) -> Option<usize> {
    let key = HASH_KEY.as_bytes();
    let key_at = file.windows(key.len()).rposition(|window| window == key)?;
    let place = key_at + key.len() + 2;
    (place + HASH_DIGITS <= file.len()).then_some(place)
}

/// Any value may be missing: a run without an answer has none, and the schema is that of all
/// shards.
fn field(column: &Column) -> ParquetResult<Arc<Type>> {
    let physical = match column.kind {
        ColumnKind::Float => PhysicalType::DOUBLE,
        ColumnKind::Whole => PhysicalType::INT64,
        ColumnKind::Text | ColumnKind::Words => PhysicalType::BYTE_ARRAY,
    };
    let logical = match column.kind {
        ColumnKind::Float => None,
        ColumnKind::Whole => Some(LogicalType::integer(64, false)),
        ColumnKind::Text | ColumnKind::Words => Some(LogicalType::String),
    };
    let builder = Type::primitive_type_builder(&column.name, physical)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(logical);
    builder.build().map(Arc::new)
}

fn properties(study: &Study, shard: u64, table: &Table) -> WriterProperties {
    let pair = |key: &str, value: String| KeyValue::new(key.to_owned(), value);
    let columns: Vec<ColumnRecord> = study.columns.iter().map(ColumnRecord::from).collect();
    let about = vec![
        pair(SCHEMA_KEY, SCHEMA.into()),
        pair(STUDY_KEY, study.hash.clone()),
        pair(VERSION_KEY, VERSION.into()),
        pair(SHARD_KEY, shard.to_string()),
        pair(COLUMNS_KEY, json!(columns).to_string()),
        pair(HASH_KEY, "0".repeat(HASH_DIGITS)),
    ];
    let fixed = WriterProperties::builder()
        .set_created_by(format!("grouser {VERSION}"))
        .set_compression(Compression::UNCOMPRESSED)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true)
        .set_max_row_group_row_count(None)
        .set_dictionary_enabled(false)
        .set_key_value_metadata(Some(about));
    table
        .columns
        .iter()
        .fold(fixed, |builder, (name, values)| encoding(builder, name, values))
        .build()
}

/// Counting numbers as their steps, what repeats through a dictionary, all others as they are.
fn encoding(
    builder: WriterPropertiesBuilder,
    name: &str,
    values: &Values,
) -> WriterPropertiesBuilder {
    let column = ColumnPath::new(vec![name.to_owned()]);
    match values {
        Values::Whole(_) => builder.set_column_encoding(column, Encoding::DELTA_BINARY_PACKED),
        Values::Text(_) | Values::Words(_) => builder.set_column_dictionary_enabled(column, true),
        Values::Float(values) => builder.set_column_dictionary_enabled(column, repeats(values)),
    }
}

/// Whether numbers take few values: a dictionary of them and places in it are shorter then.
fn repeats(values: &[Option<f64>]) -> bool {
    let most = values.len() / 4;
    let mut seen = HashSet::new();
    values.iter().flatten().all(|value| {
        seen.insert(value.to_bits());
        seen.len() <= most
    })
}

fn write(column: &mut SerializedColumnWriter<'_>, values: &Values) -> ParquetResult<()> {
    match values {
        Values::Float(values) => write_as::<DoubleType, _>(column, values, |value| *value),
        Values::Whole(values) => {
            write_as::<Int64Type, _>(column, values, |value| value.cast_signed())
        }
        Values::Text(values) => {
            write_as::<ByteArrayType, _>(column, values, |text| ByteArray::from(text.as_str()))
        }
        Values::Words(values) => {
            let texts: Vec<_> =
                values.iter().map(|names| Some(names.join(BETWEEN_NAMES))).collect();
            write_as::<ByteArrayType, _>(column, &texts, |text| ByteArray::from(text.as_str()))
        }
    }
}

fn write_as<T: DataType, V>(
    column: &mut SerializedColumnWriter<'_>,
    values: &[Option<V>],
    convert: impl Fn(&V) -> T::T,
) -> ParquetResult<()> {
    let present: Vec<T::T> = values.iter().flatten().map(convert).collect();
    let levels: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
    column.typed::<T>().write_batch(&present, Some(&levels), None).map(drop)
}

// ---- Reading ----

/// A shard's file that was checked.
pub struct Checked {
    reader: SerializedFileReader<Bytes>,
    rows: usize,
}

/// Checks that a file is a shard of a study, to the last bit as it was written.
///
/// # Errors
/// [`ShardFault`], whatever is wrong first.
pub fn check(study: &Study, shard: u64, file: &[u8]) -> Result<(), ShardFault> {
    Checked::open(&study.identity(shard), Bytes::copy_from_slice(file)).map(drop)
}

impl Checked {
    /// Checks that a file is the shard that it should be, to the last bit as it was written.
    ///
    /// # Errors
    /// [`ShardFault`], whatever is wrong first.
    pub fn open(identity: &Identity, file: Bytes) -> Result<Self, ShardFault> {
        check_hash(&file)?;
        let reader = SerializedFileReader::new(file).map_err(|_| ShardFault::Damaged)?;
        let about = reader.metadata().file_metadata();
        let expected = [
            (SCHEMA_KEY, SCHEMA, "kind"),
            (STUDY_KEY, identity.study_sha256.as_str(), "study"),
            (VERSION_KEY, identity.version.as_str(), "version"),
            (SHARD_KEY, &identity.shard.to_string(), "number"),
            (COLUMNS_KEY, &json!(identity.columns).to_string(), "set of columns"),
        ];
        for (key, value, what) in expected {
            if metadata(about, key) != Some(value) {
                return Err(ShardFault::Foreign(what));
            }
        }
        let (found, expected) = (about.num_rows().cast_unsigned(), identity.rows);
        if found != expected {
            return Err(ShardFault::Rows { found, expected });
        }
        // One group has all rows: any other file is no shard.
        let groups = reader.metadata().row_groups();
        let rows: u64 = groups.iter().map(|group| group.num_rows().cast_unsigned()).sum();
        if groups.len() > 1 || rows != expected {
            return Err(ShardFault::Rows { found: rows, expected });
        }
        let rows = usize::try_from(rows).map_err(|_| ShardFault::Damaged)?;
        Ok(Self { reader, rows })
    }

    /// The values of some columns.
    ///
    /// # Errors
    /// [`StoreError::NoColumn`], or whatever Parquet's reader finds wrong.
    pub fn table(&self, columns: &[&str]) -> Result<Table, StoreError> {
        let schema = self.reader.metadata().file_metadata().schema_descr_ptr();
        let mut table = Table { columns: Vec::new() };
        for name in columns {
            let mut places = schema.columns().iter();
            let place = places
                .position(|column| column.name() == *name)
                .ok_or_else(|| StoreError::NoColumn((*name).to_owned()))?;
            let group = self.reader.get_row_group(0)?;
            let values = column_values(group.get_column_reader(place)?, self.rows)?;
            table.columns.push(((*name).to_owned(), values));
        }
        Ok(table)
    }
}

/// Checks that a file's hash of itself is right.
fn check_hash(file: &[u8]) -> Result<(), ShardFault> {
    let place = hash_place(file).ok_or(ShardFault::Damaged)?;
    let (before, rest) = file.split_at(place);
    let (hash, after) = rest.split_at(HASH_DIGITS);
    let found =
        Sha256::new().chain_update(before).chain_update(ZEROS).chain_update(after).finalize();
    if hex(&found).as_bytes() == hash { Ok(()) } else { Err(ShardFault::Damaged) }
}

fn metadata<'m>(about: &'m FileMetaData, key: &str) -> Option<&'m str> {
    let pairs = about.key_value_metadata()?;
    pairs.iter().find(|pair| pair.key == key)?.value.as_deref()
}

fn column_values(reader: ColumnReader, rows: usize) -> Result<Values, StoreError> {
    match reader {
        ColumnReader::DoubleColumnReader(reader) => {
            Ok(Values::Float(read_as(reader, rows, |value| value)?))
        }
        ColumnReader::Int64ColumnReader(reader) => {
            Ok(Values::Whole(read_as(reader, rows, i64::cast_unsigned)?))
        }
        ColumnReader::ByteArrayColumnReader(reader) => {
            let text = |value: ByteArray| String::from_utf8_lossy(value.data()).into_owned();
            Ok(Values::Text(read_as(reader, rows, text)?))
        }
        _ => Err(ParquetError::General("a column of a type that shards do not have".into()).into()),
    }
}

fn read_as<T: DataType, V>(
    mut reader: ColumnReaderImpl<T>,
    rows: usize,
    convert: impl Fn(T::T) -> V,
) -> ParquetResult<Vec<Option<V>>> {
    let (mut present, mut levels) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
    while levels.len() < rows {
        let (read, ..) =
            reader.read_records(rows - levels.len(), Some(&mut levels), None, &mut present)?;
        if read == 0 {
            return Err(ParquetError::EOF("a column ends too early".into()));
        }
    }
    let mut present = present.into_iter();
    let value = |level: i16| if level == 0 { None } else { present.next().map(&convert) };
    Ok(levels.into_iter().map(value).collect())
}

/// More rows to a column; whether they are of its kind.
pub(crate) fn append(values: &mut Values, more: Values) -> bool {
    match (values, more) {
        (Values::Float(values), Values::Float(more)) => values.extend(more),
        (Values::Whole(values), Values::Whole(more)) => values.extend(more),
        (Values::Text(values), Values::Text(more)) => values.extend(more),
        _ => return false,
    }
    true
}
