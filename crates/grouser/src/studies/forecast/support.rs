//! What the forecast on a ground rests on.

use super::choices::Ground;

/// The weakest of what a forecast on a ground rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Support {
    /// The ground's strength was found under the site's gravity.
    SiteGravity,
    /// The ground's strength was measured under another gravity.
    OtherGravity,
    /// The document of the ground does not say under which gravity its strength was found.
    Unstated,
    /// Moduli are carried to the site by a law that no measurement supports.
    None,
}

impl Support {
    /// The name: `site-gravity`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::SiteGravity => "site-gravity",
            Self::OtherGravity => "other-gravity",
            Self::Unstated => "unstated",
            Self::None => "none",
        }
    }

    /// What the strength of a ground rests on.
    ///
    /// * `measured_under`, `gravity`: where the soil was measured, and at the site [m/s²]
    pub(super) fn of(ground: &Ground, measured_under: f64, gravity: f64) -> Self {
        let is_of_site = match ground {
            Ground::AsMeasured => measured_under == gravity,
            Ground::Site(site) => {
                let range = site.soil.domain.gravity;
                if !(range.low.is_finite() && range.high.is_finite()) {
                    return Self::Unstated;
                }
                range.holds(gravity)
            }
        };
        if is_of_site { Self::SiteGravity } else { Self::OtherGravity }
    }
}
