//! Names that were withdrawn before version 0.1. Documents, options and the Python package refuse
//! them, and hint at the present ones.

/// Withdrawn names, each with its present ones: of keys, keywords and presets of documents, then of
/// the Python package, its arguments and attributes. Options have those of keys.
const WITHDRAWN: [(&str, &[&str]); 21] = [
    ("attitude", &["heading"]),
    ("behind", &["rear_mound"]),
    ("campaign-attitude", &["campaign-heading"]),
    ("extended", &["small-wheel", "small_wheel"]),
    ("flank", &["side_wall"]),
    ("front", &["bow_wave"]),
    ("heap", &["mounds"]),
    ("loads", &["load_transfer"]),
    ("moments", &["wheel_moments"]),
    ("rim", &["interface"]),
    ("sinkage_ratio", &["sinkage_over_radius"]),
    ("speed_m_s", &["rim_speed_m_s", "ground_speed_m_s"]),
    ("AttitudeBand", &["HeadingBand"]),
    ("AttitudeMap", &["HeadingMap"]),
    ("Attitudes", &["Headings"]),
    ("Simulator", &["Run"]),
    ("SimulatorBatch", &["RunBatch"]),
    ("attitude_map", &["heading_map"]),
    ("cannot_tell_apart", &["unidentifiable"]),
    ("narrowing", &["posterior_contraction"]),
    ("samples", &["records"]),
];

/// The present names of a withdrawn one; none of any other.
///
/// ```
/// assert_eq!(grouser_io::present_names("loads"), ["load_transfer"]);
/// assert!(grouser_io::present_names("load_transfer").is_empty());
/// ```
#[must_use]
pub fn present_names(name: &str) -> &'static [&'static str] {
    let found = WITHDRAWN.iter().find(|(withdrawn, _)| *withdrawn == name);
    found.map_or(&[], |(_, present)| present)
}

/// Whether a dotted key has another for its present name, step by step.
pub(crate) fn is_now(withdrawn: &str, present: &str) -> bool {
    let steps = || withdrawn.split('.').zip(present.split('.'));
    withdrawn.split('.').count() == present.split('.').count()
        && steps().all(|(one, other)| one == other || present_names(one).contains(&other))
}
