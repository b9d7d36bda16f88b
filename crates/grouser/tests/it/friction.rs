//! Friction under a wheel: which part of a soil's friction angle a wheel mobilises, and which
//! models have it.

use grouser::contact::{Contact, Model, Slip, coulomb_cone, settle};
use grouser::document::{Kind, Overrides, Source, presets, read_rover, read_soil, read_wheel};
use grouser::soil::Soil;
use grouser::studies::heading::HeadingStudy;
use grouser::units::{EARTH_GRAVITY, MARS_GRAVITY, MOON_GRAVITY, deg};

fn soil(name: &str, settings: &[&str]) -> Soil {
    let source = Source::find(Kind::Soil, name).expect("a preset");
    let overrides = Overrides::parse(settings.iter().copied()).expect("settings");
    read_soil(&source, &overrides).unwrap_or_else(|error| panic!("{name}: {error}")).value
}

/// sin φ cos ψ/(1 − sin φ sin ψ) of Davis (1968) is tan φ at ψ = φ, and sin φ at ψ = 0.
#[test]
fn the_ends_are_those_of_the_flow_rule() {
    for angle in [5.0, 20.0, 31.9, 38.0, 42.0, 60.0] {
        let soil = Soil { friction_angle: deg(angle), ..soil("grc-3", &[]) };
        let davis = |dilation: f64| {
            let sin = soil.friction_angle.sin();
            sin * dilation.cos() / (1.0 - sin * dilation.sin())
        };
        let at =
            |constant_volume_share| Soil { constant_volume_share, ..soil }.mobilised_friction();
        assert!((at(1.0) - davis(0.0)).abs() < 1e-14, "{angle}");
        assert!((at(0.0) - davis(soil.friction_angle)).abs() < 1e-12, "{angle}");
        assert!(at(0.0) > at(0.5) && at(0.5) > at(1.0), "{angle}");
    }
}

#[test]
fn a_document_says_it_by_the_kind_of_test_or_by_itself() {
    let share = |settings: &[&str]| soil("fjs-1-loose", settings).constant_volume_share;
    assert_eq!(share(&[]), 0.5, "not printed: the prior's median");
    for (word, expected) in
        [("triaxial", 1.0), ("plane-strain", 1.0), ("direct-shear", 0.0), ("repose", 0.0)]
    {
        assert_eq!(share(&[&format!("soil.friction_test={word}")]), expected, "{word}");
    }
    assert_eq!(share(&["soil.constant_volume_share=0.3"]), 0.3);
    let both = ["soil.friction_test=triaxial", "soil.constant_volume_share=0.3"];
    assert_eq!(share(&both), 0.3);
    assert_eq!(
        share(&[
            "soil.priors=none",
            "soil.cohesion_kpa=0",
            "soil.density_kg_m3=1500",
            "soil.exit.ratio=0.3",
            "soil.stress_peak.a0=0.4",
            "soil.stress_peak.a1=0.1",
            "soil.bulldozing.law=sine"
        ]),
        0.0,
        "nobody says more"
    );
}

/// Constants that were chosen with tan φ keep it.
#[test]
fn fitted_soils_keep_their_friction() {
    for name in [
        "toyoura",
        "toyoura-uncertain",
        "toyoura-as-printed",
        "toyoura-lab-2007",
        "toyoura-lab-2012",
        "cmu-direct90-smooth",
        "cmu-direct90-grouser",
        "lunar-nominal",
    ] {
        let soil = soil(name, &[]);
        assert_eq!(soil.constant_volume_share, 0.0, "{name}");
        let off = soil.mobilised_friction() - soil.friction_angle.tan();
        assert!(off.abs() < 1e-15, "{name}: {off}");
    }
}

/// The table of the chapter: the stresses of two models have it, a closed form and an intrusion law
/// have not, and the ground's own bound has φ.
#[test]
fn models_have_it_as_the_chapter_says() {
    let source = Source::find(Kind::Wheel, "viper-engineering").expect("a preset");
    let wheel = read_wheel(&source, &Overrides::none()).expect("a wheel").value;
    let slip = Slip::on_test_stand(0.3, 0.0);
    for model in Model::ALL {
        let pull = |constant_volume_share| {
            let soil = Soil { constant_volume_share, ..soil("grc-3", &[]) };
            let contact = Contact { wheel, soil, slip, gravity: EARTH_GRAVITY };
            let settled = settle(model.as_ref(), &contact, 171.7).expect("it carries");
            let bound = coulomb_cone::largest_horizontal_force(&contact, &settled.forces, 0.01);
            (settled.forces.drawbar_pull, bound / settled.forces.normal_force)
        };
        let ((peak, _), (loose, _)) = (pull(0.0), pull(1.0));
        match model {
            Model::Ishigami | Model::SmallWheel => {
                assert!(loose < peak - 5.0, "{}: {peak} {loose}", model.name());
            }
            _ => assert_eq!(loose, peak, "{}", model.name()),
        }
    }
}

/// On every soil that comes with the program some ready rover drives on level ground, in some
/// gravity.
#[test]
fn on_each_ready_soil_some_rover_moves() {
    let rovers: Vec<_> = presets(Kind::Rover)
        .map(|preset| {
            let rover = read_rover(&Source::Preset(preset), &Overrides::none());
            rover.expect("a preset").value
        })
        .collect();
    for preset in presets(Kind::Soil) {
        let loaded = read_soil(&Source::Preset(preset), &Overrides::none()).expect("a preset");
        let model = loaded.document.usual_model("");
        let usual =
            grouser::document::read_scenario(&Source::default_scenario(), &Overrides::none());
        let usual = HeadingStudy::of(&usual.expect("the default").value);
        let moves = rovers.iter().any(|rover| {
            [EARTH_GRAVITY, MARS_GRAVITY, MOON_GRAVITY].into_iter().any(|gravity| {
                let (rover, soil, model) = (rover.clone(), loaded.value, model.clone());
                let study = HeadingStudy { rover, soil, model, gravity, ..usual.clone() };
                study.curve().is_ok_and(|curve| curve.at(0.0).is_ok())
            })
        });
        assert!(moves, "no rover moves on {}", preset.name);
    }
}
