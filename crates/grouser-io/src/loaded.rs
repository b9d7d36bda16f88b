//! A document that was read: its keys in their own units, and the domain's value in SI.

use super::document::Document;
use super::given_file::GivenFile;
use super::priors::Assumed;
use super::tree::Companion;
use super::uncertain_soil::UncertainSoil;
use grouser_core::terrain::ElevationModel;

/// A document that was read: its keys, and the domain's value.
///
/// How wide is the wheel of HAKUTO, and what is assumed about it?
///
/// ```
/// use grouser_io::{Kind, Overrides, Source, read_wheel};
///
/// let wheel = read_wheel(&Source::find(Kind::Wheel, "hakuto")?, &Overrides::none())?;
/// assert_eq!(format!("{:.3} m", wheel.value.width), "0.080 m");
/// assert_eq!(wheel.document.number("width_m"), Some(0.08));
/// assert!(wheel.assumptions[2].contains("width_m: not printed"), "{:?}", wheel.assumptions);
/// assert!(wheel.to_toml().contains("width_m = 0.08"));
/// # Ok::<(), grouser_io::DocumentError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded<V> {
    /// The document with every named part in its place and every default filled in.
    pub document: Document,
    /// Its meaning, in SI units and radians.
    pub value: V,
    /// The soils that it, or its soil, may be: by what it says of how well its numbers are known,
    /// and by priors where it does not. None for an exact soil.
    pub uncertain: Option<UncertainSoil>,
    /// What was assumed, each with the name of the document that says so.
    pub assumptions: Vec<String>,
    /// The keys that it, or its soil, takes from priors because they are not stated; empty if all
    /// are.
    pub assumed: Vec<Assumed>,
    /// Files that the resolved document names, to be written beside it.
    pub companions: Vec<Companion>,
    /// What the files gave that it names, such as a map of heights.
    pub given: Vec<GivenFile>,
    /// What is odd about them.
    pub notes: Vec<String>,
}

impl<V> Loaded<V> {
    /// A document that assumes nothing, and names no file.
    pub(crate) fn of(document: Document, value: V) -> Self {
        Self {
            document,
            value,
            uncertain: None,
            assumptions: Vec::new(),
            assumed: Vec::new(),
            companions: Vec::new(),
            given: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// The soils that it, or its soil, may be, if the document itself says how well its numbers are
    /// known.
    #[must_use]
    pub fn stated_uncertainty(&self) -> Option<&UncertainSoil> {
        self.uncertain.as_ref().filter(|soils| soils.is_stated())
    }

    /// The soils that an answer has to be about that always has a band where there is a reason for
    /// one: those of a document that says how well its numbers are known, or does not state all of
    /// them.
    #[must_use]
    pub fn soils_of_bands(&self) -> Option<&UncertainSoil> {
        self.uncertain.as_ref().filter(|soils| soils.is_stated() || !self.assumed.is_empty())
    }

    /// The same document with another meaning: that of a part of its value.
    #[must_use]
    pub fn with_value<W>(&self, value: W) -> Loaded<W> {
        let Self { document, uncertain, assumptions, assumed, companions, given, notes, .. } = self;
        Loaded {
            document: document.clone(),
            value,
            uncertain: uncertain.clone(),
            assumptions: assumptions.clone(),
            assumed: assumed.clone(),
            companions: companions.clone(),
            given: given.clone(),
            notes: notes.clone(),
        }
    }

    /// The resolved document as TOML: read again, with its [`companions`](Self::companions) beside
    /// it, it gives the same value.
    #[must_use]
    pub fn to_toml(&self) -> String {
        self.document.to_toml()
    }

    /// A number by which the resolved document, with its companions, is known again: FNV-1a
    /// (Fowler, Noll, Vo) of 64 bits. It distinguishes documents that differ by chance, not by
    /// intent.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        let toml = self.to_toml();
        let companions = self.companions.iter().flat_map(|companion| companion.content.bytes());
        fnv_1a(toml.bytes().chain(companions))
    }
}

/// A number by which a resolved document, with its companions and its map of heights, is known again
/// as by [`Loaded::fingerprint`]: states of its runs have it.
///
/// * `map`: the heights that a scenario or mission names
#[must_use]
pub fn mark_of(document: &Document, companions: &[Companion], map: Option<&ElevationModel>) -> u64 {
    let texts = companions.iter().flat_map(|it| [it.name.as_bytes(), it.content.as_bytes()]);
    let heights = map.into_iter().flat_map(|model| {
        let above = model.heights_above_base().flat_map(f32::to_le_bytes);
        model.base().to_le_bytes().into_iter().chain(above)
    });
    let toml = document.to_toml();
    fnv_1a(toml.bytes().chain(texts.flatten().copied()).chain(heights))
}

/// FNV-1a with 64 bits (Fowler, Noll and Vo): tells bytes apart that differ by accident, not by
/// intent, and is the same for every compiler.
pub fn fnv_1a(bytes: impl Iterator<Item = u8>) -> u64 {
    const BASIS: u64 = 0xCBF2_9CE4_8422_2325;
    const PRIME: u64 = 0x0000_0100_0000_01B3;
    bytes.fold(BASIS, |sum, byte| (sum ^ u64::from(byte)).wrapping_mul(PRIME))
}
