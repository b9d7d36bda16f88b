//! Which preset to take: the world that a soil or a rover is of, what it is good for, how well it
//! is known.

use super::super::kind::Kind;
use super::Preset;

/// What a preset is good for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Advice {
    /// The world that it is of, as [`GRAVITIES`](crate::GRAVITIES) names it: that of a simulant is
    /// `earth`.
    pub world: &'static str,
    /// What it is for, and how well it is known.
    pub text: &'static str,
}

impl Preset {
    /// What it is good for; soils and rovers have such advice.
    ///
    /// Which soil does one begin with on the Moon?
    ///
    /// ```
    /// use grouser_io::{Kind, presets};
    ///
    /// let soils = presets(Kind::Soil).filter_map(|soil| Some((soil.name, soil.advice()?)));
    /// let mut of_the_moon = soils.filter(|(_, advice)| advice.world == "moon");
    /// let (name, advice) = of_the_moon.find(|(_, advice)| advice.text.contains("start with")).expect("one");
    /// assert_eq!(name, "lunar-0-15-cm");
    /// assert!(advice.text.ends_with("with bands"));
    /// ```
    #[must_use]
    pub fn advice(&self) -> Option<Advice> {
        let all: &[(&str, &'static str, &'static str)] = match self.kind {
            Kind::Soil => &SOILS,
            Kind::Rover => &ROVERS,
            _ => &[],
        };
        let (_, world, text) = *all.iter().find(|(name, ..)| *name == self.name)?;
        Some(Advice { world, text })
    }
}

const SOILS: [(&str, &str, &str); 31] = [
    (
        "toyoura",
        "earth",
        "to start with: the sand of the paper's rover; its shear moduli are a simulant's",
    ),
    (
        "toyoura-uncertain",
        "earth",
        "cards and bands to start with: the same sand; how wide the bands are is assumed",
    ),
    ("toyoura-as-printed", "earth", "a warning: wrong on purpose, 9.8 times too stiff"),
    ("toyoura-lab-2007", "earth", "to compare with the laboratory's code of 2007"),
    ("toyoura-lab-2012", "earth", "to compare with the laboratory's code of 2012"),
    ("simulant-2007", "earth", "the wheel jfr-2007; second-hand, from two re-implementations"),
    (
        "lunar-nominal",
        "moon",
        "the Moon under traffic: Lunar Roving Vehicle constants, second-hand; slips more than \
         rovers did",
    ),
    ("lunar-umd", "moon", "a second opinion on the Moon: a course's values, not traced further"),
    ("lunar-chrono", "moon", "to compare with Project Chrono's Apollo-site demonstration"),
    (
        "lunar-0-15-cm",
        "moon",
        "the Moon to start with: recommended values of the surface between craters, with bands",
    ),
    (
        "lunar-0-30-cm",
        "moon",
        "wheels deeper than 15 cm, and driven tracks: recommended values, with bands",
    ),
    (
        "lunar-30-60-cm",
        "moon",
        "ground that was dug free: recommended values, with bands; no wheel on the surface meets \
         it",
    ),
    ("hit-lss1", "earth", "a lunar simulant of Harbin, values of 2015; second-hand"),
    ("hit-lss1-2011", "earth", "the wheel ding-2011-smooth, values of 2011; second-hand"),
    (
        "fjs-1-loose",
        "earth",
        "the wheel rashid-1; its friction angle is printed, the rest second-hand",
    ),
    (
        "grc-1",
        "earth",
        "a lunar simulant with its own plates, loose; friction interpolated over density",
    ),
    (
        "grc-1-second-hand",
        "earth",
        "simulated climbs of mgru3, with the constants printed beside them; its plates refute them",
    ),
    (
        "grc-3",
        "earth",
        "the wheel viper-engineering; friction measured over density, with bands, the rest \
         second-hand",
    ),
    ("mars-simulant", "earth", "a Mars simulant on Earth; second-hand"),
    (
        "mars-regolith",
        "mars",
        "a first look at Mars: a student's code, not traced to a measurement",
    ),
    (
        "mars-sand",
        "mars",
        "a first look at loose ground on Mars: a student's code, not traced to a measurement",
    ),
    (
        "mines-lunar",
        "earth",
        "a warning: a mean over unlike soils of the literature; unfit for prediction",
    ),
    ("dry-sand", "earth", "vehicles on dry sand: a textbook's example, second-hand"),
    ("clay", "earth", "vehicles on clay: a textbook's example, second-hand"),
    (
        "direct-90",
        "earth",
        "the smooth wheel of Carnegie Mellon: one stiffness from plates, an exponent fitted to its \
         tests",
    ),
    ("direct-90-grousers", "earth", "the same sand under the wheel with grousers"),
    (
        "cmu-direct90-smooth",
        "earth",
        "best known of all, for the wheel cmu-smooth alone: fitted to its tests",
    ),
    (
        "cmu-direct90-grouser",
        "earth",
        "best known of all, for the wheel cmu-grouser alone: fitted to its tests",
    ),
    (
        "krex-granite",
        "earth",
        "the rover KRex on decomposed granite; values without their measurements",
    ),
    ("mit-rig-a", "earth", "the wheel mit-rig, the stiffer of two sets; second-hand"),
    ("mit-rig-b", "earth", "the wheel mit-rig, the softer of two sets; second-hand"),
];

const ROVERS: [(&str, &str, &str); 15] = [
    ("hakuto", "earth", "to start with: the paper's rover; the size of its wheels is assumed"),
    ("hakuto-flight", "moon", "the lighter flight model; masses scaled"),
    ("hakuto-steered", "earth", "the paper's rover with steered wheels, which it has not"),
    (
        "hakuto-rockers",
        "earth",
        "the paper's rover on rockers, which it has not: for uneven ground",
    ),
    ("el-dorado-2", "earth", "a larger rover of the same laboratory; its mass and size are known"),
    ("mgru3", "earth", "VIPER's test rover, 88 kg; mass, size and wheels are known"),
    ("viper", "moon", "430 kg on the wheels of its test rover, which are known"),
    ("rashid", "moon", "10 kg on four wheels, which are known; its axles are estimated"),
    ("pragyan", "moon", "26 kg on six wheels; its mass is known, its wheels are a guess"),
    ("yutu-2", "moon", "135 kg on six wheels; second-hand, its axles from memory"),
    ("sojourner", "mars", "10.6 kg on six wheels; size known, spikes left out"),
    ("spirit", "mars", "174 kg on six wheels; mass known, wheels from memory"),
    (
        "curiosity",
        "mars",
        "899 kg on six wheels; mass, wheels and wheelbase known, its track from memory",
    ),
    (
        "curiosity-rocker-bogie",
        "mars",
        "curiosity for uneven ground; where its rockers and bogies turn is a guess",
    ),
    (
        "lrv",
        "moon",
        "700 kg with two astronauts on four wheels, which are rigid here and flexible in reality",
    ),
];

#[cfg(test)]
mod tests {
    use crate::{GRAVITIES, Kind, presets};

    /// A soil or a rover without advice would be left out by a filter.
    #[test]
    fn every_soil_and_rover_has_advice_on_one_line() {
        for kind in [Kind::Soil, Kind::Rover] {
            for preset in presets(kind) {
                let advice = preset.advice().unwrap_or_else(|| panic!("{}", preset.name));
                assert!(
                    GRAVITIES.iter().any(|(world, _)| *world == advice.world),
                    "{}",
                    preset.name
                );
                let length = advice.text.chars().count();
                assert!((20..110).contains(&length), "{}: {length}", preset.name);
                // Advice on bands is true of the document.
                let has_bands = preset.text.contains("[uncertainty");
                let says_so =
                    advice.text.contains("with bands") || advice.text.contains("bands are");
                assert_eq!(has_bands, says_so, "{}", preset.name);
            }
        }
        assert_eq!(presets(Kind::Wheel).find_map(super::Preset::advice), None);
    }
}
