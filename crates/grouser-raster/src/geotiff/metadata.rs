//! GDAL's metadata of a band: scale, offset and unit of its numbers.

use crate::error::Fault;

/// How numbers of cells become heights [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scaling {
    pub(super) scale: f64,
    pub(super) offset: f64,
}

/// Reads the text of tag 42112, XML with items such as
/// `<Item name="SCALE" sample="0" role="scale">0.5</Item>`.
///
/// * `band`: from 0
pub(super) fn scaling(text: Option<&str>, band: usize) -> Result<Scaling, Fault> {
    let mut scaling = Scaling { scale: 1.0, offset: 0.0 };
    let Some(text) = text.map(|text| text.trim_matches(['\0', ' ', '\n'])) else {
        return Ok(scaling);
    };
    let damaged = |problem: String| Fault::Tiff { problem };
    let metadata = roxmltree::Document::parse(text)
        .map_err(|error| damaged(format!("GDAL's metadata (tag 42112): {error}")))?;
    for item in metadata.descendants().filter(|node| node.has_tag_name("Item")) {
        let sample = item.attribute("sample").and_then(|sample| sample.parse().ok());
        if sample != Some(band) {
            continue;
        }
        let value = item.text().unwrap_or_default().trim();
        let number = || {
            let number = value.parse().ok().filter(|number: &f64| number.is_finite());
            number.ok_or_else(|| damaged(format!("GDAL's metadata: {value:?} is no number")))
        };
        match item.attribute("role") {
            Some("scale") => scaling.scale = number()?,
            Some("offset") => scaling.offset = number()?,
            Some("unittype") => check_unit(value)?,
            _ => {}
        }
    }
    if scaling.scale == 0.0 {
        return Err(damaged("GDAL's metadata: a scale of zero".into()));
    }
    Ok(scaling)
}

/// Checks that heights are in metres.
///
/// * `unit`: the name of their unit; nothing where none is stated
///
/// # Errors
/// [`Fault::HeightUnit`] for another one.
pub fn check_unit(unit: &str) -> Result<(), Fault> {
    const METRES: [&str; 6] = ["", "m", "metre", "meter", "metres", "meters"];
    if METRES.contains(&unit.to_lowercase().as_str()) {
        return Ok(());
    }
    let shown = unit.chars().filter(|c| !c.is_control()).take(40).collect();
    Err(Fault::HeightUnit { unit: shown })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"<GDALMetadata>
  <Item name="AREA">here &amp; there</Item>
  <Item name="SCALE" sample="1" role="scale">0.5</Item>
  <Item name="OFFSET" sample="1" role="offset">-100</Item>
  <Item name="UNITTYPE" sample="1" role="unittype">metre</Item>
  <Item name="UNITTYPE" sample="2" role="unittype">ft</Item>
</GDALMetadata>"#;

    #[test]
    fn a_band_has_its_own_scale_and_unit() {
        assert_eq!(scaling(Some(TEXT), 0).expect("none"), Scaling { scale: 1.0, offset: 0.0 });
        assert_eq!(scaling(Some(TEXT), 1).expect("some"), Scaling { scale: 0.5, offset: -100.0 });
        let feet = scaling(Some(TEXT), 2).expect_err("feet");
        assert!(matches!(&feet, Fault::HeightUnit { unit } if unit == "ft"), "{feet}");
        assert_eq!(scaling(None, 0).expect("none"), Scaling { scale: 1.0, offset: 0.0 });
    }

    #[test]
    fn what_is_no_metadata_is_refused() {
        for text in ["<GDALMetadata>", "", &TEXT.replace("0.5", "x"), &TEXT.replace("0.5", "0")] {
            assert!(matches!(scaling(Some(text), 1), Err(Fault::Tiff { .. })), "{text}");
        }
    }
}
