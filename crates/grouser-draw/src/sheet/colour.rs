//! Colours, and how much of what is below them they hide.

/// A colour of the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour {
    /// Red, green and blue as screens mix them, of 255.
    rgb: [f64; 3],
    /// What it hides of what is below: 0 nothing, 1 all.
    opacity: f64,
}

/// Black.
pub const BLACK: Colour = Colour::grey(0.0);
/// White.
pub const WHITE: Colour = Colour::grey(1.0);

impl Colour {
    /// A grey: 0 is black, 1 is white.
    #[must_use]
    pub const fn grey(level: f64) -> Self {
        let level = level.clamp(0.0, 1.0) * 255.0;
        Self { rgb: [level; 3], opacity: 1.0 }
    }

    /// A colour as style sheets write it: `0x0072B2` is `#0072B2`.
    #[must_use]
    pub const fn hex(code: u32) -> Self {
        let [_, red, green, blue] = code.to_be_bytes();
        Self { rgb: [red as f64, green as f64, blue as f64], opacity: 1.0 }
    }

    /// The same, which hides only a share of what is below it.
    #[must_use]
    pub const fn opacity(self, opacity: f64) -> Self {
        Self { opacity: opacity.clamp(0.0, 1.0), ..self }
    }

    /// A colour between two: this one at a share of 0, the other at 1.
    #[must_use]
    pub fn mixed(self, other: Self, share: f64) -> Self {
        let between = |a: f64, b: f64| a + (b - a) * share.clamp(0.0, 1.0);
        let rgb = [0, 1, 2].map(|k| between(self.rgb[k], other.rgb[k]));
        Self { rgb, opacity: between(self.opacity, other.opacity) }
    }

    /// The colour as style sheets write it, such as `#0072b2`, without its opacity.
    #[must_use]
    pub fn code(self) -> String {
        self.bytes().iter().fold(String::from("#"), |code, byte| format!("{code}{byte:02x}"))
    }

    /// Red, green and blue, of 255.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    pub fn bytes(self) -> [u8; 3] {
        self.rgb.map(|part| part.round() as u8)
    }

    /// Red, green and blue, of 1.
    #[must_use]
    pub fn parts(self) -> [f64; 3] {
        self.rgb.map(|part| part / 255.0)
    }

    /// How much it hides of what is below: 0 nothing, 1 all.
    #[must_use]
    pub const fn hides(self) -> f64 {
        self.opacity
    }

    pub(crate) fn is_grey(self) -> bool {
        self.rgb[0] == self.rgb[1] && self.rgb[1] == self.rgb[2]
    }
}
