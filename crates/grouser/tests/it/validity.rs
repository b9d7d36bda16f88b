//! Flags of validity: each is raised where its rule says so, and not where it does not.

use grouser::contact::validity::{Flag, Situation};
use grouser::contact::{Model, Settled, Slip, settle};
use grouser::document::validity::OutsideDomain;
use grouser::document::{self, Kind, Overrides, Source, doubts, presets};
use grouser::simulation::{Run, Scenario};
use grouser::soil::{AssumedValues, Domain, ShearBound, SmallWheel, Soil, Span};
use grouser::studies::heading::HeadingStudy;
use grouser::studies::validity::RoverOnSlope;
use grouser::studies::wheel_test::WheelTest;
use grouser::units::{EARTH_GRAVITY, MOON_GRAVITY, deg};
use grouser::wheel::{Grousers, Wheel};

use crate::given;

/// A wheel on a test stand, or on a slope, by which a flag is tried.
struct Trial {
    model: Model,
    wheel: Wheel,
    soil: Soil,
    gravity: f64,
    slope: f64,
    load: f64,
    slip_ratio: f64,
    slip_angle: f64,
}

impl Trial {
    /// The paper's wheel under its load on its soil, of which nothing is stated: no flag.
    fn quiet() -> Self {
        Self {
            model: Model::Ishigami,
            wheel: given::hakuto_wheel(),
            soil: given::toyoura(),
            gravity: EARTH_GRAVITY,
            slope: 0.0,
            load: 17.0,
            slip_ratio: 0.2,
            slip_angle: 0.0,
        }
    }

    /// On a soil of a stated domain.
    fn within(domain: Domain) -> Self {
        Self { soil: Soil { domain, ..given::toyoura() }, ..Self::quiet() }
    }

    fn bekker_soil() -> Self {
        Self { soil: given::simulant_2007(), ..Self::quiet() }
    }

    fn flags(&self) -> Vec<Flag> {
        let Self { ref model, wheel, soil, gravity, .. } = *self;
        let slip = Slip::on_test_stand(self.slip_ratio, self.slip_angle);
        let contact = grouser::contact::Contact { wheel, soil, slip, gravity };
        let settled: Option<Settled> = settle(model.as_ref(), &contact, self.load).ok();
        let situation = Situation {
            model,
            wheel: &wheel,
            soil: &soil,
            gravity,
            slope: self.slope,
            load: Some(self.load),
            slip: Some(slip),
            settled: settled.as_ref(),
        };
        situation.findings().into_iter().map(|finding| finding.flag).collect()
    }
}

/// A trial that raises a flag, and one next to it that does not. A new flag has to say both here.
fn trials_of(flag: Flag) -> [Trial; 2] {
    let quiet = Trial::quiet;
    let stated = Domain::UNSTATED;
    let light = |load| Domain { load: Span::new(load, 26.0), ..stated };
    let grousers = |height, count| Wheel {
        grousers: Some(Grousers { height, count }),
        ..given::hakuto_wheel()
    };
    match flag {
        Flag::LoadOutside => [Trial::within(light(18.0)), Trial::within(light(17.0))],
        Flag::RadiusOutside => {
            let small = given::smooth_wheel(0.0625, 0.05);
            [
                Trial { wheel: small, ..quiet() },
                Trial { model: Model::SmallWheel, wheel: small, ..quiet() },
            ]
        }
        Flag::OtherWheel => {
            let fit = |radius| Domain { radius: Span::new(radius, radius), ..stated };
            [Trial::within(fit(0.0625)), Trial::within(fit(0.101))]
        }
        Flag::SinkageOutside => {
            [Trial { load: 200.0, ..quiet() }, Trial { load: 100.0, ..quiet() }]
        }
        Flag::SlipOutside => {
            [Trial { slip_ratio: 0.95, ..quiet() }, Trial { slip_ratio: 0.9, ..quiet() }]
        }
        Flag::SlipAngleOutside => {
            let at = |angle| Trial { slip_angle: deg(angle), ..quiet() };
            [at(-46.0), at(-45.0)]
        }
        Flag::GravityOutside => {
            let lunar = Domain { gravity: Span::new(1.6, 1.65), ..stated };
            [Trial::within(lunar), Trial { gravity: MOON_GRAVITY, ..Trial::within(lunar) }]
        }
        Flag::BekkerGravity => {
            // Carried to the Moon, where Reece's law follows.
            let on_moon = |trial| Trial { gravity: MOON_GRAVITY, load: 3.0, ..trial };
            [on_moon(Trial::bekker_soil()), on_moon(quiet())]
        }
        Flag::ModulusDoubtful => {
            let of = |k_phi| {
                let mut trial = Trial::bekker_soil();
                let exponent = grouser::soil::SinkageExponent::constant(1.0);
                trial.soil.pressure_sinkage =
                    grouser::soil::PressureSinkage::Bekker { k_c: 0.0, k_phi, exponent };
                trial
            };
            [of(820.0), of(8.2e5)]
        }
        Flag::SlopeBeyondStrength => {
            // tan 38° / 1.3 is the tangent of 31.0°.
            let on = |slope| Trial { slope: deg(slope), ..quiet() };
            [on(31.1), on(30.9)]
        }
        Flag::GrousersExposed => {
            let high = grousers(0.02, 24);
            [Trial { wheel: high, ..quiet() }, Trial { wheel: high, model: Model::Rft, ..quiet() }]
        }
        Flag::GrousersApart => [
            Trial { wheel: grousers(0.01, 12), ..quiet() },
            Trial { wheel: grousers(0.01, 24), ..quiet() },
        ],
        Flag::GrouserNumber => {
            // The arc in contact is 56° long.
            [
                Trial { wheel: grousers(0.01, 6), ..quiet() },
                Trial { wheel: grousers(0.01, 7), ..quiet() },
            ]
        }
        Flag::ForceBeyondFriction => {
            // A locked wheel whose shear grows on each axis by itself (theory, second part, 11.6).
            let locked = Trial { slip_ratio: -1.0, slip_angle: deg(45.0), ..quiet() };
            [locked, quiet()]
        }
        Flag::NoSideForce => {
            let sideways = |model| Trial { model, slip_angle: deg(5.0), ..quiet() };
            [sideways(Model::Bekker), sideways(Model::Ishigami)]
        }
        Flag::NoCohesion => {
            let cohesive = |model| Trial { model, ..Trial::bekker_soil() };
            [cohesive(Model::Rft), cohesive(Model::Ishigami)]
        }
        Flag::TermsMissing => {
            let small = |small_wheel: SmallWheel| {
                let soil = Soil { small_wheel, ..given::toyoura() };
                Trial { model: Model::SmallWheel, soil, ..quiet() }
            };
            let mut terms = SmallWheel::GENERAL;
            terms.mounds.rear_mound = 1.0;
            [small(SmallWheel::GENERAL), small(terms)]
        }
        Flag::Assumed => {
            let one_assumed = AssumedValues { ishigami: 1, ..AssumedValues::NONE };
            [Trial::within(Domain { assumed_values: one_assumed, ..stated }), quiet()]
        }
    }
}

#[test]
fn every_flag_is_raised_by_its_rule_and_not_beside_it() {
    for flag in Flag::ALL {
        let [raising, beside] = trials_of(flag);
        let (raised, not) = (raising.flags(), beside.flags());
        assert!(raised.contains(&flag), "{}: {raised:?}", flag.name());
        assert!(!not.contains(&flag), "{}: {not:?}", flag.name());
    }
}

/// A soil that keeps forces within what it resists hides nothing: where it has reduced a force the
/// law asked for more.
#[test]
fn a_force_that_the_soils_bound_has_reduced_is_flagged() {
    let bounded = Soil { shear_bound: ShearBound::Coulomb, ..given::toyoura() };
    let on = |model| Trial { model, soil: bounded, ..Trial::quiet() };
    let is_raised = |trial: Trial| trial.flags().contains(&Flag::ForceBeyondFriction);
    let sideways = Trial { slip_ratio: -1.0, slip_angle: deg(45.0), ..on(Model::Ishigami) };
    assert!(is_raised(sideways));
    for model in Model::ALL {
        assert!(!is_raised(on(model.clone())), "{}", model.name());
    }
}

/// Cohesion holds a locked wheel by more than its light load's friction: as published, of 800 Pa
/// over its contact.
#[test]
fn a_light_wheel_that_cohesion_alone_would_hold_is_flagged() {
    let cohesive = Soil { shear_bound: ShearBound::Coulomb, ..given::simulant_2007() };
    for model in [Model::Ishigami, Model::SmallWheel] {
        let locked = |load| {
            let trial = Trial { model: model.clone(), soil: cohesive, load, ..Trial::quiet() };
            Trial { slip_ratio: -1.0, ..trial }.flags().contains(&Flag::ForceBeyondFriction)
        };
        assert!(locked(0.02) && !locked(17.0), "{}", model.name());
    }
}

#[test]
fn the_papers_wheel_under_its_load_raises_nothing() {
    assert_eq!(Trial::quiet().flags(), []);
}

/// The list is closed: the table of rules has each flag at its place, under a name of its own.
#[test]
fn every_flag_has_its_own_rule_and_name() {
    for (place, flag) in Flag::ALL.into_iter().enumerate() {
        assert_eq!(flag as usize, place);
        assert_eq!(flag.rule().flag, flag);
        assert_eq!(Flag::of_name(flag.name()), Some(flag));
        let said = [flag.rule().meaning, flag.rule().criterion, flag.rule().source];
        assert!(said.iter().all(|text| !text.is_empty()), "{flag:?}");
        // A bar would break the table of the guide.
        assert!(said.iter().all(|text| !text.contains('|')), "{flag:?}");
    }
}

/// Flags are about the wheel, not about the side to which it moves.
#[test]
fn a_mirrored_wheel_carries_the_same_flags() {
    for trial in Flag::ALL.into_iter().flat_map(trials_of) {
        let flags = trial.flags();
        assert_eq!(Trial { slip_angle: -trial.slip_angle, ..trial }.flags(), flags);
    }
}

fn scenario(overrides: &[&str]) -> Scenario {
    let overrides = Overrides::parse(overrides.iter().copied()).unwrap();
    document::read_scenario(&Source::default_scenario(), &overrides).unwrap().value
}

/// The paper's own rover, soil and slopes are inside the domain that its soil states.
#[test]
fn the_papers_headings_carry_no_flag() {
    let curve = HeadingStudy::of(&scenario(&[])).curve().unwrap();
    for slope in [5.0, 10.0, 15.0, 20.0].map(deg) {
        assert_eq!(curve.findings(slope, &curve.at(slope)), [], "{slope}");
    }
}

/// By the paper's shear law a rover holds on slopes on which the sand itself slides: that is
/// flagged.
#[test]
fn a_rover_on_a_slope_steeper_than_the_ground_is_flagged() {
    let scenario = scenario(&["scenario.slope_deg=35", "scenario.duration_s=0.2"]);
    let run = Run::new(&scenario).unwrap().to_end().unwrap();
    let raised = RoverOnSlope::of(&scenario).over(&run);
    let steep = raised.iter().find(|it| it.finding.flag == Flag::SlopeBeyondStrength).unwrap();
    assert_eq!(steep.time, 0.0);
    assert!((steep.finding.value - deg(38.0).tan() / deg(35.0).tan()).abs() < 1e-12);
}

/// In a run each flag counts from the record that raises it first.
#[test]
fn the_union_over_a_run_has_the_first_time_of_each_flag() {
    let scenario = scenario(&["scenario.slope_deg=18", "scenario.duration_s=6"]);
    let run = Run::new(&scenario).unwrap().to_end().unwrap();
    let rover = RoverOnSlope::of(&scenario);
    let raised = rover.over(&run);
    for record in &run.records {
        for finding in rover.at(record) {
            let first = raised.iter().find(|it| it.finding.flag == finding.flag).unwrap();
            assert!(first.time <= record.time);
        }
    }
    for one in &raised {
        let record = run.records.iter().find(|record| record.time == one.time).unwrap();
        assert!(rover.at(record).contains(&one.finding));
    }
}

#[test]
fn strictness_names_flag_row_value_and_range() {
    let test = WheelTest {
        wheel: given::hakuto_wheel(),
        soil: given::toyoura(),
        gravity: EARTH_GRAVITY,
        model: Model::Ishigami,
        loads: vec![17.0],
        slip_angles: vec![deg(50.0)],
        slip_ratios: vec![0.2, 0.95],
    };
    let rows = test.run();
    let flags = rows.iter().map(|row| &*row.findings);
    let error = OutsideDomain::check(flags, |place| format!("row {place}")).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("row 1: slip-outside: the slip ratio is 0.95, the domain is -0.1 to 0.9")
    );
    assert!(error.to_string().contains(
        "row 0: slip-angle-outside: the slip angle is 50 °, the domain is at most 45 ° (and 1 more \
         row)"
    ));
    let none: [&[grouser::contact::validity::Finding]; 2] = [&[], &[]];
    assert_eq!(OutsideDomain::check(none, |place| place.to_string()), Ok(()));
}

// ---- Documents ----

fn read(text: &str) -> Result<document::LoadedSoil, document::DocumentError> {
    document::read_soil(&Source::text("soil", text), &Overrides::none())
}

fn bekker(moduli: &str) -> String {
    format!(
        "schema = \"soil/1\"\ncohesion_kpa = 0\nfriction_angle_deg = 30\ndensity_kg_m3 = 1500\n\
         [pressure_sinkage]\nlaw = \"bekker\"\n{moduli}\nn = 1.0\n\
         [stress_peak]\na0 = 0.4\na1 = 0.15\n\
         [shear]\nlaw = \"isotropic\"\nlongitudinal_m = 0.02\n[exit]\nratio = 1.0\n"
    )
}

/// The same soil in N and in kN, one modulus in either or both.
#[test]
fn moduli_in_kilonewtons_are_those_in_newtons() {
    let newtons = read(&bekker("k_c = 1400.0\nk_phi = 820000.0")).unwrap();
    for moduli in ["k_c_kn = 1.4\nk_phi_kn = 820", "k_c = 1400\nk_phi_kn = 820.0"] {
        let kilo = read(&bekker(moduli)).unwrap();
        assert_eq!(kilo.value, newtons.value, "{moduli}");
        assert_eq!(kilo.document.number("pressure_sinkage.k_phi"), Some(820_000.0));
    }
    let both = read(&bekker("k_c = 1400\nk_phi = 8.2e5\nk_phi_kn = 820")).unwrap_err();
    let message = both.to_string();
    assert!(message.contains("`pressure_sinkage.k_phi_kn` is `k_phi` in thousands"), "{message}");
    assert!(message.contains("given too") && message.contains("remove one of them"), "{message}");
}

#[test]
fn moduli_that_look_like_kilonewtons_are_asked_about_and_absurd_ones_refused() {
    let asked = |moduli: &str| doubts(&Source::text("soil", bekker(moduli))).unwrap();
    assert!(asked("k_c = 1.4\nk_phi = 820")[0].contains("are the moduli in kN?"));
    assert_eq!(asked("k_c = 1400\nk_phi = 8.2e5"), [""; 0]);
    let absurd = read(&bekker("k_c = 0.0014\nk_phi = 0.82")).unwrap_err();
    assert!(absurd.to_string().contains("at least 10"), "{absurd}");
}

fn rover(settings: &[&str]) -> Result<document::LoadedRover, document::DocumentError> {
    let overrides = Overrides::parse(settings.iter().copied()).unwrap();
    document::read_rover(&Source::find(Kind::Rover, "hakuto").unwrap(), &overrides)
}

#[test]
fn inertias_obey_the_triangle_inequality() {
    // 0.138 and 0.142 kg·m²: a flat plate would have 0.280 about its normal.
    assert!(rover(&["rover.body.inertia_kg_m2.zz=0.280"]).is_ok());
    let error = rover(&["rover.body.inertia_kg_m2.zz=0.281"]).unwrap_err();
    assert!(error.to_string().contains("moment of inertia zz"), "{error}");
    let error = rover(&["rover.wheel_unit.inertia_kg_m2.yy=0.0021"]).unwrap_err();
    assert!(error.to_string().contains("moment of inertia yy"), "{error}");
}

#[test]
fn two_wheels_at_one_place_are_refused() {
    let hakuto = document::preset(Kind::Rover, "hakuto").unwrap().text;
    let folded = hakuto.replace("[-0.17, 0.24, -0.06]", "[0.19, 0.24, -0.06]");
    assert_ne!(folded, hakuto);
    let error = document::read_rover(&Source::text("rover", folded), &Overrides::none());
    let error = error.unwrap_err().to_string();
    assert!(error.contains("the distance of `rear-left` from another wheel"), "{error}");
}

#[test]
fn a_domain_that_ends_before_it_starts_is_refused() {
    let text = bekker("k_c = 0\nk_phi = 8e5") + "[domain]\nload_n = [30, 13]\n";
    let error = read(&text).unwrap_err();
    assert!(error.to_string().contains("domain's load"), "{error}");
}

/// A rover of a ton on a soil that carries some hundred newtons.
#[test]
fn a_soil_that_does_not_carry_the_rover_is_told_by_check() {
    let text = |mass: &str| {
        let overrides = Overrides::parse([&*format!("rover.body.mass_kg={mass}")]).unwrap();
        let rover = document::read_rover(&Source::find(Kind::Rover, "hakuto").unwrap(), &overrides);
        rover.unwrap().to_toml()
    };
    let heavy = doubts(&Source::text("rover", text("1000"))).unwrap();
    assert!(heavy.iter().any(|doubt| doubt.contains("the soil carries at most")), "{heavy:?}");
    assert_eq!(doubts(&Source::text("rover", text("5.24"))).unwrap(), [""; 0]);
}

/// The priors fill in two of the terms, and the others stay general.
#[test]
fn a_preset_without_terms_is_flagged_under_the_small_wheel_model() {
    for (name, is_raised) in
        [("lunar-nominal", true), ("grc-1", true), ("cmu-direct90-smooth", false)]
    {
        let soil = Source::find(Kind::Soil, name).unwrap();
        let soil = document::read_soil(&soil, &Overrides::none()).unwrap().value;
        let trial = Trial { model: Model::SmallWheel, soil, ..Trial::quiet() };
        assert_eq!(trial.flags().contains(&Flag::TermsMissing), is_raised, "{name}");
    }
}

/// A value that the model leaves aside is not assumed by its result.
#[test]
fn assumed_values_count_where_the_model_uses_them() {
    let overrides = Overrides::none();
    let toyoura = Source::find(Kind::Soil, "toyoura").unwrap();
    let toyoura = document::read_soil(&toyoura, &overrides).unwrap().value.domain.assumed_values;
    assert_eq!((toyoura.ishigami, toyoura.bekker, toyoura.rft), (0, 0, 0));
    let text = bekker("k_c = 0\nk_phi = 8e5").replace("[exit]\nratio = 1.0\n", "");
    let without_exit = read(&text).unwrap().value.domain.assumed_values;
    assert!(without_exit.ishigami > without_exit.bekker, "{without_exit:?}");
    assert_eq!(without_exit.rft, 0);
}

/// What a preset states of its domain holds for the wheel that it names.
#[test]
fn presets_are_inside_their_own_domains() {
    for preset in presets(Kind::Soil) {
        let soil = document::read_soil(&Source::Preset(preset), &Overrides::none()).unwrap();
        let Some(name) = soil.document.text("domain.wheel") else { continue };
        let wheel = Source::find(Kind::Wheel, name).unwrap();
        let wheel = document::read_wheel(&wheel, &Overrides::none()).unwrap().value;
        let domain = soil.value.domain;
        assert!(domain.radius.holds(wheel.radius) && domain.width.holds(wheel.width), "{name}");
        assert!(domain.gravity.holds(EARTH_GRAVITY), "{name}");
    }
}
