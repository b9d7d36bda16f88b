//! Heights as GeoTIFF, read through `tiff-reader`, which no other file of ours knows.
//!
//! Formats: TIFF 6.0 and BigTIFF, GeoTIFF 1.1 (OGC 19-008r4), GDAL's tags 42112 (metadata) and
//! 42113 (nodata). Of several images the first is read that is neither an overview nor a mask. A
//! height is missing where the cell has the file's nodata value, is NaN, is masked by a mask in the
//! file or beside it, or lies in a block that was never written; GDAL's scale and offset are applied
//! to the others. Cells are areas, whose heights are those of their middles, or points, as the file
//! says (key 1025).

mod affine;
pub(crate) mod beside;
pub(crate) mod metadata;
mod opened_file;
mod reference;

use std::sync::Arc;

use tiff_reader::{ByteOrder, Ifd, OpenOptions, Tag, TiffError, TiffFile, TiffSample};

use crate::coordinate_system::{CoordinateSystem, DIRECTORY, DOUBLES, TEXT};
use crate::error::{Fault, RasterError};
use crate::heights::{Heights, checked_cells};
use crate::{Content, MapPath, Raster, ReadOptions};
use beside::Sidecars;
use metadata::Scaling;
use opened_file::OpenedFile;
use reference::Georeference;

/// Tags of TIFF 6.0, GeoTIFF and GDAL.
mod tag {
    pub(super) const NEW_SUBFILE_TYPE: u16 = 254;
    pub(super) const PIXEL_SCALE: u16 = 33550;
    pub(super) const TIEPOINT: u16 = 33922;
    pub(super) const TRANSFORMATION: u16 = 34264;
    pub(super) const GDAL_METADATA: u16 = 42112;
    pub(super) const GDAL_NODATA: u16 = 42113;
}

/// Whether a file that starts so is a TIFF.
pub(crate) fn starts_so(start: &[u8]) -> bool {
    [b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"].iter().any(|magic| start.starts_with(*magic))
}

/// Reads a file.
///
/// # Errors
/// [`RasterError`] with the file's name, and what to do.
pub fn read<'p>(
    path: impl Into<MapPath<'p>>,
    options: &ReadOptions,
) -> Result<Raster, RasterError> {
    let path = path.into();
    let raster = || {
        let source = OpenedFile::of(path)?;
        let length = source.length;
        let tiff = TiffFile::from_source_with_options(Arc::new(source), limits(length, options))?;
        let beside = Sidecars::of(path, options.band.unwrap_or(1), limits(length, options))?;
        raster_of(&tiff, length, &beside, options)
    };
    raster().map_err(|fault| RasterError::new(path.path, fault))
}

/// Reads what a file holds.
///
/// # Errors
/// [`Fault`] if it is no elevation model.
pub fn decode(bytes: Vec<u8>, options: &ReadOptions) -> Result<Raster, Fault> {
    let length = bytes.len() as u64;
    let tiff = TiffFile::from_bytes_with_options(bytes, limits(length, options))?;
    raster_of(&tiff, length, &Sidecars::default(), options)
}

impl From<TiffError> for Fault {
    fn from(error: TiffError) -> Self {
        match error {
            TiffError::Io(error, _) => Self::Disk(error),
            error => Self::Tiff { problem: error.to_string() },
        }
    }
}

/// What the decoder may take.
fn limits(length: u64, options: &ReadOptions) -> OpenOptions {
    /// Bytes of a cell, at most.
    const CELL: u64 = 8;
    /// A block is decoded as a whole, even where a small image fills little of it [bytes].
    const BLOCK: u64 = 1 << 24;
    let bytes = |bytes: u64| usize::try_from(bytes).unwrap_or(usize::MAX);
    let mut limits = OpenOptions {
        // Rows of blocks are read once each.
        block_cache_bytes: 0,
        decode_output_bytes: bytes(
            options.most_cells(length).saturating_mul(CELL).saturating_add(BLOCK),
        ),
        ..OpenOptions::default()
    };
    // A tag's values are in the file: no more of them than it is long.
    let budgets = &mut limits.parse_budgets;
    budgets.max_tag_value_bytes = budgets.max_tag_value_bytes.min(bytes(length));
    budgets.max_metadata_value_bytes = budgets.max_metadata_value_bytes.min(bytes(length) * 4);
    limits
}

fn raster_of(
    tiff: &TiffFile,
    length: u64,
    beside: &Sidecars,
    options: &ReadOptions,
) -> Result<Raster, Fault> {
    let ifd = image(tiff)?;
    let (columns, rows) = (u64::from(ifd.width()), u64::from(ifd.height()));
    let cells = checked_cells(columns, rows, options.most_cells(length))?;
    check_samples(ifd, options.content)?;
    check_order(tiff, ifd)?;
    let layout = ifd.raster_layout()?;
    let band = chosen_band(layout.samples_per_pixel, options)?;
    let notes = &beside.notes;
    let georeference = Georeference {
        system: coordinate_system(ifd),
        beside,
        scale: reals(ifd, tag::PIXEL_SCALE),
        tiepoint: reals(ifd, tag::TIEPOINT),
        matrix: reals(ifd, tag::TRANSFORMATION),
    };
    let placed = georeference.grid(layout.width, layout.height, options.placement)?;
    let own = metadata::scaling(text(ifd, tag::GDAL_METADATA), band)?;
    let scaling = Scaling {
        scale: notes.scale.unwrap_or(own.scale),
        offset: notes.offset.unwrap_or(own.offset),
    };
    check_block(ifd, cells)?;
    let blocks = Blocks::of(ifd, layout.samples_per_pixel, band);
    let promised = cells as u64 * (layout.bytes_per_sample * layout.samples_per_pixel) as u64;
    if blocks.uncompressed && blocks.all_written() && promised > length {
        return Err(Fault::Truncated { promised, found: length });
    }
    let own = text(ifd, tag::GDAL_NODATA).and_then(|text| text.trim().parse().ok());
    let nodata = notes.nodata.or(own);
    let reading = Reading {
        tiff,
        ifd,
        mask: match &beside.mask {
            Some(beside) => Some(Mask::beside(beside, ifd, band)?),
            None => mask(tiff, ifd).map(|ifd| Mask { tiff, ifd, band: 0 }),
        },
        band,
        blocks,
        scaling,
        nodata,
        missing: options.missing,
    };
    let mut heights = Heights::new(cells, options.content);
    reading.read(&mut heights, (layout.sample_format, layout.bits_per_sample))?;
    let mut raster = heights.raster(placed.grid, placed.order, placed.system)?;
    raster.remarks.extend(placed.remark);
    Ok(raster)
}

/// The first image that is neither an overview nor a mask.
fn image(tiff: &TiffFile) -> Result<&Ifd, Fault> {
    let full = tiff.ifds().iter().find(|ifd| kind(ifd) & (OVERVIEW | MASK) == 0);
    full.or(tiff.ifds().first()).ok_or(Fault::Tiff { problem: "it has no image".into() })
}

/// The internal mask of an image, GDAL's `GDAL_TIFF_INTERNAL_MASK`.
fn mask<'t>(tiff: &'t TiffFile, image: &Ifd) -> Option<&'t Ifd> {
    let fits = |ifd: &&Ifd| (ifd.width(), ifd.height()) == (image.width(), image.height());
    tiff.ifds().iter().filter(|ifd| kind(ifd) & (OVERVIEW | MASK) == MASK).find(fits)
}

const OVERVIEW: u64 = 1;
const MASK: u64 = 4;

/// The bits of an image's kind.
fn kind(ifd: &Ifd) -> u64 {
    ifd.tag(tag::NEW_SUBFILE_TYPE).and_then(|tag| tag.value.as_u64()).unwrap_or(0)
}

/// The band with the heights, from 0.
fn chosen_band(bands: usize, options: &ReadOptions) -> Result<usize, Fault> {
    match options.band {
        None if bands == 1 => Ok(0),
        None => Err(Fault::Bands { bands }),
        Some(band) if (1..=bands).contains(&band) => Ok(band - 1),
        Some(band) => Err(Fault::NoBand { band, bands }),
    }
}

/// Checks that bytes are in an order that is read as GDAL means it: its LERC exchanges the bytes of
/// big-endian files before it compresses them, and the decoder does not exchange them back.
fn check_order(tiff: &TiffFile, ifd: &Ifd) -> Result<(), Fault> {
    const LERC: u16 = 34887;
    if tiff.byte_order() == ByteOrder::LittleEndian || ifd.compression() != LERC {
        return Ok(());
    }
    let problem = "LERC in a big-endian file, whose bytes writers order differently".into();
    Err(Fault::Tiff { problem })
}

/// Checks that cells are real numbers, not colours.
fn check_samples(ifd: &Ifd, content: Content) -> Result<(), Fault> {
    /// Sample formats of complex numbers, of whole and of real parts.
    const COMPLEX: [u16; 2] = [5, 6];
    /// Photometric interpretations of TIFF 6.0: white or black is zero.
    const GREY: [u16; 2] = [0, 1];
    /// Colours.
    const RGB: u16 = 2;
    const PALETTE: u16 = 3;
    if ifd.sample_format()?.iter().any(|format| COMPLEX.contains(format)) {
        return Err(Fault::Samples { samples: "complex numbers".into() });
    }
    match ifd.photometric_interpretation() {
        // Several bands without a meaning are often called red, green and blue.
        None | Some(RGB) => Ok(()),
        Some(grey) if GREY.contains(&grey) => Ok(()),
        Some(PALETTE) if content == Content::Classes => Ok(()),
        Some(PALETTE) => Err(Fault::Samples { samples: "numbers of colours".into() }),
        Some(other) => Err(Fault::Samples { samples: format!("colours (interpretation {other})") }),
    }
}

fn coordinate_system(ifd: &Ifd) -> CoordinateSystem {
    let directory = ifd.tag(DIRECTORY).and_then(|tag| tag.value.as_u16_slice());
    let text = text(ifd, TEXT).unwrap_or_default().to_owned();
    CoordinateSystem::of_keys(directory.unwrap_or_default().to_vec(), reals(ifd, DOUBLES), text)
}

fn reals(ifd: &Ifd, code: u16) -> Vec<f64> {
    ifd.tag(code).and_then(|tag: &Tag| tag.value.as_f64_vec()).unwrap_or_default()
}

fn text(ifd: &Ifd, code: u16) -> Option<&str> {
    ifd.tag(code)?.value.as_str()
}

/// The tiles or strips of a band.
struct Blocks {
    /// Rows of cells in one.
    rows: usize,
    /// Columns of cells in one.
    columns: usize,
    /// How many lie side by side.
    across: usize,
    /// Whether each of the band's was written, row by row; those beyond the list were.
    written: Vec<bool>,
    uncompressed: bool,
}

impl Blocks {
    fn of(ifd: &Ifd, bands: usize, band: usize) -> Self {
        /// No compression, TIFF 6.0.
        const NONE: u16 = 1;
        /// Band after band.
        const PLANAR: u16 = 2;
        let (rows, columns, offsets, counts) = if ifd.is_tiled() {
            let (rows, columns) = (ifd.tile_height(), ifd.tile_width());
            (rows.unwrap_or(1), columns.unwrap_or(1), ifd.tile_offsets(), ifd.tile_byte_counts())
        } else {
            (ifd.rows_per_strip(), ifd.width(), ifd.strip_offsets(), ifd.strip_byte_counts())
        };
        let (rows, columns) = (rows.clamp(1, ifd.height().max(1)), columns.max(1));
        let offsets = offsets.unwrap_or_default().into_iter();
        let written = offsets.zip(counts.unwrap_or_default());
        let mut written: Vec<bool> =
            written.map(|(offset, count)| offset != 0 && count != 0).collect();
        if ifd.planar_configuration() == PLANAR {
            let of_band = written.len() / bands;
            written = written.into_iter().skip(band * of_band).take(of_band).collect();
        }
        Self {
            rows: rows as usize,
            columns: columns as usize,
            across: ifd.width().div_ceil(columns) as usize,
            written,
            uncompressed: ifd.compression() == NONE,
        }
    }

    fn all_written(&self) -> bool {
        self.written.iter().all(|written| *written)
    }

    /// Whether the block of a cell was written.
    fn has(&self, row: usize, column: usize) -> bool {
        let block = row / self.rows * self.across + column / self.columns;
        self.written.get(block).copied().unwrap_or(true)
    }
}

/// Checks that a tile, which is decoded as a whole, is not far larger than the image.
fn check_block(ifd: &Ifd, cells: usize) -> Result<(), Fault> {
    /// Cells of a tile, however small the image.
    const USUAL: u64 = 1 << 22;
    let (Some(columns), Some(rows)) = (ifd.tile_width(), ifd.tile_height()) else { return Ok(()) };
    if u64::from(columns) * u64::from(rows) <= USUAL.max(4 * cells as u64) {
        return Ok(());
    }
    let problem = format!("its tiles have {columns} × {rows} cells, the image has {cells}");
    Err(Fault::Tiff { problem })
}

/// Where the cells are known: where a mask is not zero.
#[derive(Clone, Copy)]
struct Mask<'t> {
    tiff: &'t TiffFile,
    ifd: &'t Ifd,
    /// From 0.
    band: usize,
}

impl<'t> Mask<'t> {
    /// The mask of a band in a file of its own: one for all bands, or one each.
    fn beside(tiff: &'t TiffFile, image: &Ifd, band: usize) -> Result<Self, Fault> {
        let fits = |ifd: &&Ifd| (ifd.width(), ifd.height()) == (image.width(), image.height());
        let Some(ifd) = tiff.ifds().iter().find(fits) else {
            let problem = "the .msk file beside it has no mask of its size".to_owned();
            return Err(Fault::Tiff { problem });
        };
        let bands = ifd.raster_layout()?.samples_per_pixel;
        Ok(Self { tiff, ifd, band: if bands > band { band } else { 0 } })
    }
}

/// All that the heights are read by.
struct Reading<'t> {
    tiff: &'t TiffFile,
    ifd: &'t Ifd,
    mask: Option<Mask<'t>>,
    band: usize,
    blocks: Blocks,
    scaling: Scaling,
    nodata: Option<f64>,
    missing: Option<f64>,
}

/// A kind of number that cells may be.
trait Cell: TiffSample + Copy {
    fn number(self) -> f64;
    /// The number nearest to another one that such a cell can have.
    fn nearest(number: f64) -> f64;
}

macro_rules! cells {
    ($($kind:ty),+) => {$(
        impl Cell for $kind {
            #[allow(clippy::cast_lossless, reason = "one text for all kinds")]
            fn number(self) -> f64 {
                self as f64
            }
            #[allow(
                clippy::cast_lossless,
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "the nearest is asked for"
            )]
            fn nearest(number: f64) -> f64 {
                let near = number as $kind as f64;
                // A number far outside of what a cell can have is no cell's.
                if (near - number).abs() <= 1e-6 * number.abs() { near } else { f64::NAN }
            }
        }
    )+};
}
cells!(f32, f64, i8, i16, i32, i64, u8, u16, u32, u64);

impl Reading<'_> {
    /// Reads all rows.
    ///
    /// * `kind`: TIFF's sample format, and bits
    fn read(&self, heights: &mut Heights, kind: (u16, u16)) -> Result<(), Fault> {
        match kind {
            (1, 8) => self.rows::<u8>(heights),
            (1, 16) => self.rows::<u16>(heights),
            (1, 32) => self.rows::<u32>(heights),
            (1, 64) => self.rows::<u64>(heights),
            (2, 8) => self.rows::<i8>(heights),
            (2, 16) => self.rows::<i16>(heights),
            (2, 32) => self.rows::<i32>(heights),
            (2, 64) => self.rows::<i64>(heights),
            (3, 32) => self.rows::<f32>(heights),
            (3, 64) => self.rows::<f64>(heights),
            (_, bits) => Err(Fault::Samples { samples: format!("numbers of {bits} bits") }),
        }
    }

    fn rows<T: Cell>(&self, heights: &mut Heights) -> Result<(), Fault> {
        /// Cells that are read at once, where blocks are smaller.
        const AT_ONCE: usize = 1 << 20;
        let (rows, columns) = (self.ifd.height() as usize, self.ifd.width() as usize);
        let block = self.blocks.rows;
        let all_shown = self.mask.is_none() && self.blocks.all_written();
        let step = (AT_ONCE / columns.max(1) / block).max(1) * block;
        for start in (0..rows).step_by(step) {
            let count = step.min(rows - start);
            heights.reserve(count * columns)?;
            let cells = self
                .tiff
                .read_band_window_from_ifd::<T>(self.ifd, self.band, start, 0, count, columns)?;
            let masked = self.masked(start, count, columns)?;
            if all_shown {
                cells.iter().for_each(|cell| heights.push(self.height(*cell)));
                continue;
            }
            for (at, cell) in cells.iter().enumerate() {
                let written = self.blocks.has(start + at / columns, at % columns);
                let shown = masked.get(at).is_none_or(|mask| *mask != 0);
                let height = if written && shown { self.height(*cell) } else { f64::NAN };
                heights.push(height);
            }
        }
        Ok(())
    }

    /// The mask of some rows; none where there is no mask.
    fn masked(&self, start: usize, count: usize, columns: usize) -> Result<Vec<u8>, Fault> {
        let Some(Mask { tiff, ifd, band }) = self.mask else { return Ok(Vec::new()) };
        let mask = tiff.read_band_window_from_ifd::<u8>(ifd, band, start, 0, count, columns)?;
        Ok(mask.iter().copied().collect())
    }

    fn height<T: Cell>(&self, cell: T) -> f64 {
        let number = cell.number();
        if self.nodata.is_some_and(|value| T::nearest(value) == number) {
            return f64::NAN;
        }
        let height = number * self.scaling.scale + self.scaling.offset;
        // What a height of few digits becomes in single precision, scaled.
        let is_missing = |missing: f64| (height - missing).abs() <= 1e-6 * missing.abs();
        if self.missing.is_some_and(is_missing) { f64::NAN } else { height }
    }
}
