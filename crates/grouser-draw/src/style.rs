//! The colours of all pictures, by what they stand for, on a light and on a dark ground.
//!
//! Lines that are told apart by colour take [`series`]: the colours of Okabe and Ito, "Color
//! universal design" (2008), which stay apart for colour-blind eyes, darkest first, so that they
//! stay apart in grey too. On a dark ground their order and hues are the same, and their lightness
//! is turned round.

// Colours are written as style sheets write them.
#![allow(clippy::unreadable_literal)]

use std::fmt::Write as _;

use crate::sheet::{Colour, Sheet};

/// What a picture is drawn on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Ground {
    /// White paper.
    #[default]
    Light,
    /// A dark screen.
    Dark,
}

/// What a colour stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Role {
    /// What the picture is drawn on.
    Paper,
    /// Text, axes and outlines.
    Ink,
    /// Text of less weight, such as units and notes.
    Faint,
    /// Lines behind everything, such as those of a grid.
    Grid,
    /// The surface of the soil.
    Soil,
    /// The soil where it is cut or ends.
    SoilEdge,
    /// The other side of the soil that is cut.
    SoilSide,
    /// Contour lines on the soil.
    Contour,
    /// What a wheel leaves behind in the soil.
    Track,
    /// What a grouser leaves in a wheel's track.
    Print,
    /// Shade on the soil.
    Shade,
    /// The rover's body, seen from above.
    BodyTop,
    /// The sides of the body that face the light.
    BodyLit,
    /// The sides of the body that do not.
    BodyDark,
    /// A solar panel.
    Panel,
    /// The edges of the body.
    Edge,
    /// The side of a wheel.
    Wheel,
    /// The rim of a wheel.
    Rim,
    /// Grousers.
    Grouser,
    /// A force that is a sum of others, such as all that the soil does to a wheel.
    Force,
    /// Forces along the wheel that push it ahead: thrust, drawbar pull.
    Thrust,
    /// Forces across the wheel.
    Side,
    /// Forces across the surface of the soil: loads, and what carries them.
    Normal,
    /// A light edge around arrows, before what is dark.
    Halo,
    /// Weight.
    Weight,
    /// A message, such as what became of a rover.
    Message,
    /// A path.
    Path,
    /// What is compared with it.
    Other,
}

impl Role {
    /// Every one of them.
    pub const ALL: [Self; 28] = [
        Self::Paper,
        Self::Ink,
        Self::Faint,
        Self::Grid,
        Self::Soil,
        Self::SoilEdge,
        Self::SoilSide,
        Self::Contour,
        Self::Track,
        Self::Print,
        Self::Shade,
        Self::BodyTop,
        Self::BodyLit,
        Self::BodyDark,
        Self::Panel,
        Self::Edge,
        Self::Wheel,
        Self::Rim,
        Self::Grouser,
        Self::Force,
        Self::Thrust,
        Self::Side,
        Self::Normal,
        Self::Halo,
        Self::Weight,
        Self::Message,
        Self::Path,
        Self::Other,
    ];

    /// The colour on a ground.
    #[must_use]
    pub const fn on(self, ground: Ground) -> Colour {
        let [light, dark] = match self {
            Self::Paper | Self::Halo => [0xffffff, 0x14171c],
            Self::Ink | Self::Weight => [0x1a1d22, 0xf0f1f3],
            Self::Faint => [0x5b6470, 0xa3abb6],
            Self::Grid => [0xdde1e6, 0x333a44],
            Self::Soil => [0xece3d2, 0x3a352c],
            Self::SoilEdge => [0xcdbfa5, 0x5a5142],
            Self::SoilSide => [0xb8a988, 0x4a4336],
            Self::Contour => [0xc3b594, 0x5f5747],
            Self::Track => [0xb39f78, 0x7a6c51],
            Self::Print => [0x94815a, 0x4d4433],
            Self::Shade => [0x6b5d42, 0x000000],
            Self::BodyTop => [0xf7f8fa, 0xc9ced6],
            Self::BodyLit => [0xd3d8df, 0x9aa2ad],
            Self::BodyDark => [0xa9b1bc, 0x6d7682],
            Self::Panel => [0x35507a, 0x2b4468],
            Self::Edge => [0x5b6470, 0x2b3038],
            Self::Wheel => [0x6d7682, 0x8a94a1],
            Self::Rim => [0x434b56, 0x59626e],
            Self::Grouser => [0x1a1d22, 0xb4bcc7],
            Self::Force => [0xd55e00, 0xff8a3d],
            Self::Thrust | Self::Path => [0x0072b2, 0x56b4e9],
            Self::Side => [0x009e73, 0x2fcf9f],
            Self::Normal => [0xcc79a7, 0xe7a3c8],
            Self::Message => [0xa84300, 0xff9b57],
            Self::Other => [0x8a94a1, 0x8a94a1],
        };
        let colour = Colour::hex(match ground {
            Ground::Light => light,
            Ground::Dark => dark,
        });
        match self {
            Self::Shade => colour.opacity(0.35),
            _ => colour,
        }
    }
}

/// The colours of lines in a chart, in the order in which they are given out.
#[must_use]
pub fn series(ground: Ground) -> [Colour; 7] {
    let codes = match ground {
        Ground::Light => [0x000000, 0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xe69f00, 0x56b4e9],
        Ground::Dark => [0xffffff, 0x4aa8e0, 0xff8a3d, 0x2fbf92, 0xe59bc4, 0xf5bf45, 0xa5d8f7],
    };
    codes.map(Colour::hex)
}

/// The class of drawings that [`rules_for_dark`] are for.
pub const ON_BOTH_GROUNDS: &str = "on-both-grounds";

/// Rules of a style sheet for a drawing on a light ground: on a dark screen each of its colours
/// becomes its counterpart. They are for the `<style>` of an SVG of the class [`ON_BOTH_GROUNDS`]
/// whose colours are attributes; other drawings of the same page stay as they are.
#[must_use]
pub fn rules_for_dark() -> String {
    let on = |role: Role| [role.on(Ground::Light), role.on(Ground::Dark)];
    let lines = series(Ground::Light).into_iter().zip(series(Ground::Dark));
    let pairs = lines.map(|(light, dark)| [light, dark]).chain(Role::ALL.map(on));
    let mut known = Vec::new();
    let mut rules = String::from("@media screen and (prefers-color-scheme:dark){");
    for [light, dark] in pairs.map(|pair| pair.map(Colour::code)) {
        // Roles of one colour on a light ground have nearly one on a dark one.
        if known.contains(&light) || light == dark {
            continue;
        }
        for attribute in ["fill", "stroke"] {
            // Writing to a string does not fail.
            let of = format!("[{attribute}=\"{light}\" i]");
            let class = ON_BOTH_GROUNDS;
            let _ = write!(rules, ".{class}{of},.{class} {of}{{{attribute}:{dark}}}");
        }
        known.push(light);
    }
    rules + "}"
}

/// A drawing in the colours of a light ground as SVG: its letters are outlines, and on a dark
/// screen its colours are dark ones.
#[must_use]
pub fn on_both_grounds(sheet: &Sheet) -> String {
    let style = format!("</title>\n<style>{}</style>", rules_for_dark());
    let svg = sheet.to_svg().replacen("</title>", &style, 1);
    svg.replacen("<svg ", &format!("<svg class=\"{ON_BOTH_GROUNDS}\" "), 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_colour_that_differs_has_one_rule_for_each_attribute() {
        let rules = rules_for_dark();
        for role in [Role::Ink, Role::Paper, Role::Soil, Role::Force] {
            let [light, dark] = [Ground::Light, Ground::Dark].map(|ground| role.on(ground).code());
            for attribute in ["fill", "stroke"] {
                let rule =
                    format!(".{ON_BOTH_GROUNDS} [{attribute}=\"{light}\" i]{{{attribute}:{dark}}}");
                assert_eq!(rules.matches(&rule).count(), 1, "{rule}");
            }
        }
    }

    /// Relative luminance.
    ///
    /// Source: W3C, "Web Content Accessibility Guidelines (WCAG) 2.2".
    fn luminance(colour: Colour) -> f64 {
        let linear = |part: f64| {
            if part <= 0.04045 { part / 12.92 } else { ((part + 0.055) / 1.055).powf(2.4) }
        };
        let [red, green, blue] = colour.parts().map(linear);
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    }

    fn contrast(a: Colour, b: Colour) -> f64 {
        let [a, b] = [luminance(a), luminance(b)].map(|it| it + 0.05);
        a.max(b) / a.min(b)
    }

    /// The ratios that WCAG 2.2 asks for: 4.5 of text, 3 of lines that carry meaning.
    #[test]
    fn text_and_arrows_stand_out_from_what_they_are_drawn_on() {
        for ground in [Ground::Light, Ground::Dark] {
            for back in [Role::Paper, Role::Soil] {
                let against = |role: Role| contrast(role.on(ground), back.on(ground));
                assert!(against(Role::Ink) >= 7.0, "{ground:?} {back:?}");
                assert!(
                    against(Role::Faint) >= 4.5,
                    "{ground:?} {back:?}: {}",
                    against(Role::Faint)
                );
                assert!(against(Role::Message) >= 4.5, "{}", against(Role::Message));
                for role in [Role::Force, Role::Thrust, Role::Path] {
                    let found = against(role);
                    assert!(found >= 3.0, "{role:?} on {back:?}, {ground:?}: {found:.2}");
                }
            }
        }
    }

    /// Okabe and Ito's lightest colours have a contrast of 2.2 with white: charts draw them wider
    /// or label them.
    #[test]
    fn every_line_is_seen_on_its_ground() {
        for ground in [Ground::Light, Ground::Dark] {
            for colour in series(ground) {
                let found = contrast(colour, Role::Paper.on(ground));
                assert!(found >= 2.0, "{} on {ground:?}: {found:.2}", colour.code());
            }
        }
    }
}
