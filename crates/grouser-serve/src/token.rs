//! The secret by which the server knows its user.

use rand::TryRng as _;
use rand::rngs::SysRng;

/// A secret of 128 bits, as 32 hexadecimal digits.
pub(crate) struct Token(String);

impl Token {
    /// A new one, of the system's random numbers.
    ///
    /// # Errors
    /// Where the system has none.
    pub(crate) fn random() -> std::io::Result<Self> {
        let mut bytes = [0; 16];
        SysRng.try_fill_bytes(&mut bytes).map_err(std::io::Error::other)?;
        Ok(Self(bytes.iter().map(|byte| format!("{byte:02x}")).collect()))
    }

    /// Whether a text is the secret, in a time that does not depend on where they differ.
    pub(crate) fn is(&self, other: &str) -> bool {
        let (own, other) = (self.0.as_bytes(), other.as_bytes());
        let difference = own.iter().zip(other).fold(0, |all, (one, other)| all | (one ^ other));
        // Kept from being made a comparison that ends early.
        own.len() == other.len() && std::hint::black_box(difference) == 0
    }

    /// The secret.
    pub(crate) fn text(&self) -> &str {
        &self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_token_is_itself_and_nothing_else() {
        let [one, other] = [(); 2].map(|()| Token::random().unwrap());
        assert!(one.is(one.text()) && one.text().len() == 32);
        assert!(!one.is(other.text()) && !one.is(""));
        assert!(!one.is(&one.text()[1..]) && !one.is(&format!("{}0", one.text())));
    }
}
