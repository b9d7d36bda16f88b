//! Drawings of the theory, each from the numbers of a computed case: nothing in them is drawn by
//! hand, so that an angle on paper is the angle of the model.

mod bulldozing;
mod frames;
mod loads;
mod pen;
mod shear;
mod slope;
mod subject;
mod wheel;
mod wheels;

use crate::sheet::Sheet;

pub use subject::{Crossing, WheelInSoil};
pub(crate) use wheels::sheet as wheels_in_a_row;

use crate::style::on_both_grounds;

/// A drawing.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// The name of its file, without ending.
    pub name: &'static str,
    /// What it shows, for a caption.
    pub caption: &'static str,
    sheet: Sheet,
}

impl Drawing {
    /// The drawing as SVG: its letters are outlines, and on a dark screen its colours are dark
    /// ones.
    #[must_use]
    pub fn to_svg(&self) -> String {
        on_both_grounds(&self.sheet)
    }
}

/// All drawings, those of a wheel first.
#[must_use]
pub fn all(wheel: &WheelInSoil<'_>, crossing: &Crossing<'_>) -> Vec<Drawing> {
    of_a_wheel(wheel).into_iter().chain(of_a_slope(crossing)).collect()
}

/// The drawings of a wheel in its soil.
#[must_use]
pub fn of_a_wheel(wheel: &WheelInSoil<'_>) -> [Drawing; 3] {
    [
        Drawing {
            name: "wheel",
            caption: "A wheel in its soil, from its left side: the arc in contact from the entry \
                      angle θ_f to the exit angle θ_r, the angle θ_m of the largest normal stress, \
                      the normal stress σ and the shear stress τ on the rim, the sinkage h, and \
                      the forces on the hub.",
            sheet: wheel::sheet(wheel),
        },
        Drawing {
            name: "shear",
            caption: "Along the arc in contact, from where the rim enters the soil: the shear \
                      displacement j that builds up, the normal stress σ, and the shear stress τ \
                      that j mobilises.",
            sheet: shear::sheet(wheel),
        },
        Drawing {
            name: "bulldozing",
            caption: "A wheel that drifts sideways pushes soil with its side wall, seen from \
                      behind: a wedge fails along a plane at the angle X_c, and piles up at the \
                      friction angle φ. The resistance R_b grows with the depth and acts at two \
                      thirds of it.",
            sheet: bulldozing::sheet(wheel),
        },
    ]
}

/// The drawings of a rover on a slope.
#[must_use]
pub fn of_a_slope(crossing: &Crossing<'_>) -> [Drawing; 3] {
    [
        Drawing {
            name: "frames",
            caption: "The frames: x_s runs along the contour, y_s uphill, z_s away from the slope; \
                      x_b, y_b, z_b are the body's, turned by the yaw γ. The slope is inclined by \
                      α.",
            sheet: frames::sheet(crossing),
        },
        Drawing {
            name: "slope",
            caption: "A rover that holds the contour: seen from the side, its weight pulls it \
                      downhill with W sin α; seen from above the slope, its nose points uphill by \
                      the yaw γ, it moves along the contour, and every wheel has the slip angle β \
                      = −γ.",
            sheet: slope::sheet(crossing),
        },
        Drawing {
            name: "loads",
            caption: "How the wheels share the load, seen from above: each disc has an area in \
                      proportion to the load of its wheel. The wheels below the body carry more.",
            sheet: loads::sheet(crossing),
        },
    ]
}

#[cfg(test)]
mod tests {
    use grouser::document::{Overrides, Source, read_scenario};
    use grouser::simulation::Scenario;
    use grouser::studies::heading::HeadingStudy;
    use grouser_core::contact::stress::StressField;
    use grouser_core::contact::{Contact, Ishigami, Slip, settle};

    use super::*;

    fn scenario() -> Scenario {
        read_scenario(&Source::default_scenario(), &Overrides::none()).unwrap().value
    }

    fn check_wheel(load: f64, slip_ratio: f64) {
        let scenario = scenario();
        let contact = Contact {
            wheel: scenario.rover.mounts()[0].unit.wheel,
            soil: scenario.ground.soil,
            slip: Slip::on_test_stand(slip_ratio, 0.0),
            gravity: scenario.gravity,
        };
        let settled = settle(&Ishigami::DEFAULT, &contact, load).unwrap();
        for drawing in of_a_wheel(&WheelInSoil { contact: &contact, settled: &settled, load }) {
            let svg = check_svg(&drawing);
            // Searchable text is the text of the drawing.
            if drawing.name == "wheel" {
                let patch = StressField::new(&contact, settled.sinkage).patch;
                for angle in [patch.entry, patch.max_stress, patch.exit] {
                    let text = format!(" = {}", pen::degrees(angle));
                    assert!(svg.contains(&text), "{text} at {load} N, slip {slip_ratio}");
                }
            }
        }
    }

    fn check_svg(drawing: &Drawing) -> String {
        let svg = drawing.to_svg();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let root = document.root_element();
        assert!(root.children().any(|child| child.has_tag_name("title")), "{}", drawing.name);
        for word in ["NaN", "inf"] {
            assert!(!svg.contains(word), "{word} in {}", drawing.name);
        }
        svg
    }

    #[test]
    fn a_wheel_is_drawn_with_its_angles_at_any_load_and_slip() {
        for load in [0.01, 1.0, 17.0, 60.0] {
            for slip_ratio in [-0.9, -0.3, 0.0, 0.2, 1.0] {
                check_wheel(load, slip_ratio);
            }
        }
    }

    #[test]
    fn a_slope_is_drawn_with_the_loads_of_the_wheels() {
        let scenario = scenario();
        let curve = HeadingStudy::of(&scenario).curve().unwrap();
        for degrees in [0.0_f64, 5.0, 20.0] {
            let slope = degrees.to_radians();
            let heading = curve.at(slope).unwrap();
            let crossing = Crossing {
                rover: &scenario.rover,
                slope,
                yaw: heading.yaw,
                gravity: scenario.gravity,
                wheels: &heading.wheels,
            };
            for drawing in of_a_slope(&crossing) {
                let svg = check_svg(&drawing);
                if drawing.name == "loads" {
                    for wheel in &heading.wheels {
                        assert!(svg.contains(&format!("{:.1} N", wheel.load)), "{degrees}°");
                    }
                }
            }
        }
    }
}
