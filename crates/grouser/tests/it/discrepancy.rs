//! What a model gets wrong: where it is added, its mirrors, and its way through documents.

use grouser::contact::time_step::{FORCES, MOTIONS, REST_SPEED, SINKAGE_DAMPING};
use grouser::contact::{
    Contact, Model, Settled, Slip, SteppingWheel, TimeStep, WheelForces, forces_many, settle,
    settle_from, settle_many,
};
use grouser::document::{self, Kind, LoadedSoil, Overrides, Source};
use grouser::soil::discrepancy::{SIDE_VALUES, VALUES};
use grouser::soil::{Discrepancy, Soil};
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::units::{EARTH_GRAVITY, Vec2, deg};
use nalgebra::{DMatrix, DVector};

use crate::given::{hakuto_wheel, toyoura};

const LOAD: f64 = 17.0;

/// Values that differ from place to place.
pub(crate) fn uneven() -> Discrepancy {
    Discrepancy {
        drawbar_pull: std::array::from_fn(|place| 0.05 - 0.004 * place as f64),
        side_force: std::array::from_fn(|place| 0.02 + 0.003 * place as f64),
        sinkage: std::array::from_fn(|place| 0.1 - 0.01 * place as f64),
        torque: std::array::from_fn(|place| -0.03 + 0.002 * place as f64),
    }
}

fn sand(discrepancy: Option<Discrepancy>) -> Soil {
    Soil { discrepancy, ..toyoura() }
}

fn contact(soil: Soil, slip: Slip) -> Contact {
    Contact { wheel: hakuto_wheel(), soil, slip, gravity: EARTH_GRAVITY }
}

fn settled(model: &Model, discrepancy: Option<Discrepancy>, slip: Slip, load: f64) -> Settled {
    settle(model.as_ref(), &contact(sand(discrepancy), slip), load).expect("the sand carries it")
}

/// Motions of every kind: rim speed, and the hub's along and across the wheel [m/s].
const MOTIONS_TRIED: [(f64, f64, f64); 8] = [
    (0.06, 0.05, 0.0),
    (0.06, 0.05, 0.01),
    (0.06, 0.005, -0.004),
    (0.0, 0.05, 0.02),
    (0.03, 0.05, 0.0),
    (0.06, -0.02, 0.01),
    (-0.06, -0.05, 0.01),
    (0.06, 0.0, 0.03),
];

fn slip_of((rim, v_x, v_y): (f64, f64, f64)) -> Slip {
    Slip::of_motion(rim, Vec2::new(v_x, v_y))
}

#[test]
fn a_discrepancy_of_zeros_changes_no_bit() {
    for model in Model::ALL {
        for motion in MOTIONS_TRIED {
            let slip = slip_of(motion);
            let zeros = settled(&model, Some(Discrepancy::NONE), slip, LOAD);
            assert_eq!(zeros, settled(&model, None, slip, LOAD), "{model:?} {motion:?}");
        }
    }
}

/// The same everywhere: what is added is the load times the value, the torque's times the radius.
#[test]
fn a_discrepancy_is_added_in_shares_of_the_load() {
    let even = Discrepancy {
        drawbar_pull: [0.1; VALUES],
        side_force: [-0.05; SIDE_VALUES],
        sinkage: [0.2; VALUES],
        torque: [0.07; VALUES],
    };
    for model in Model::ALL {
        let slip = Slip::on_test_stand(0.3, deg(15.0));
        let (plain, with) =
            (settled(&model, None, slip, LOAD), settled(&model, Some(even), slip, LOAD));
        // u = (1 + 0.7)/(1 + 0.7/cos 15°): the sense of rolling is 1 to 2e-4 there.
        let (share, radius) = (|force: f64| force / LOAD, hakuto_wheel().shearing_radius());
        let (one, other) = (&plain.forces, &with.forces);
        assert!((share(other.drawbar_pull - one.drawbar_pull) - 0.1).abs() < 1e-4);
        assert!((share(other.side_force - one.side_force) + 0.05).abs() < 1e-9);
        assert!((share(other.torque - one.torque) - 0.07 * radius).abs() < 1e-4);
        assert!(((with.sinkage / plain.sinkage).ln() - 0.2).abs() < 1e-9);
        assert_eq!(other.normal_force, one.normal_force);
    }
}

#[test]
fn mirrored_motions_have_mirrored_discrepancies() {
    for model in Model::ALL {
        for (rim, v_x, v_y) in MOTIONS_TRIED {
            let of = |motion| settled(&model, Some(uneven()), slip_of(motion), LOAD);
            let (one, left, back) =
                (of((rim, v_x, v_y)), of((rim, v_x, -v_y)), of((-rim, -v_x, v_y)));
            // Sinkages repeat to the last digits.
            let near = |a: f64, b: f64| (a - b).abs() < 1e-9 * LOAD;
            assert!(near(left.forces.side_force, -one.forces.side_force), "{model:?}");
            assert!(near(left.forces.drawbar_pull, one.forces.drawbar_pull), "{model:?}");
            assert!(near(left.sinkage, one.sinkage) && near(back.sinkage, one.sinkage));
            assert!(near(back.forces.drawbar_pull, -one.forces.drawbar_pull), "{model:?}");
            assert!(near(back.forces.torque, -one.forces.torque), "{model:?}");
            assert!(near(back.forces.side_force, one.forces.side_force), "{model:?}");
        }
    }
}

#[test]
fn a_wheel_without_load_or_at_rest_has_no_discrepancy() {
    for model in Model::ALL {
        let slip = slip_of((0.06, 0.03, 0.01));
        let unloaded = settled(&model, Some(uneven()), slip, 0.0);
        assert_eq!((unloaded.sinkage, unloaded.forces), (0.0, WheelForces::default()));
        let rest = slip_of((0.0, 0.0, 0.0));
        let (with, plain) =
            (settled(&model, Some(uneven()), rest, LOAD), settled(&model, None, rest, LOAD));
        assert_eq!(with.forces, plain.forces, "{model:?}");
    }
}

/// Through rest, through locking, and past a rim and a hub that oppose each other: a thousandth of
/// a speed moves no force by more than a hundredth of the load.
#[test]
fn what_a_discrepancy_adds_never_jumps() {
    let added = |motion: (f64, f64, f64)| {
        let slip = slip_of(motion);
        let of = |discrepancy| settled(&Model::Bekker, discrepancy, slip, LOAD).forces;
        let (with, plain) = (of(Some(uneven())), of(None));
        [
            with.drawbar_pull - plain.drawbar_pull,
            with.side_force - plain.side_force,
            with.torque - plain.torque,
        ]
    };
    // From one motion to another, in units of speed: of a rover, and of creeping.
    for unit in [1.0, 2e-5] {
        for (from, to) in [
            ((0.06, 0.05, 0.01), (-0.06, -0.05, -0.01)),
            ((0.0, 0.05, 0.03), (0.0, -0.05, 0.03)),
            ((0.06, 0.05, 0.01), (0.06, -0.05, 0.02)),
            ((0.05, 0.05, -0.03), (-0.05, 0.05, 0.03)),
        ] {
            let motion = |share: f64| {
                let at = |one: f64, other: f64| unit * (one + share * (other - one));
                (at(from.0, to.0), at(from.1, to.1), at(from.2, to.2))
            };
            let mut last = added(motion(0.0));
            for step in 1..=4000_u32 {
                let next = added(motion(f64::from(step) / 4000.0));
                for (next, last) in next.iter().zip(last) {
                    // Through rest at a rover's speed everything turns round within a creep speed.
                    let passes_rest = unit == 1.0 && step.abs_diff(2000) <= 1;
                    let jump = (next - last).abs() / LOAD;
                    assert!(passes_rest || jump < 0.01, "{from:?} to {to:?}, {step}: {jump}");
                }
                last = next;
            }
        }
    }
}

#[test]
fn every_way_to_a_reaction_has_the_discrepancy() {
    let model = Model::Ishigami.as_ref();
    let slip = Slip::on_test_stand(0.2, deg(10.0));
    let contact = contact(sand(Some(uneven())), slip);
    let one = settle(model, &contact, LOAD).expect("it settles");
    let many = settle_many(model, &[(contact, LOAD)]);
    assert_eq!(many[0].as_ref(), Ok(&one));
    let near = settle_from(model, &contact, LOAD, 0.01).expect("it settles");
    assert!((near.forces.drawbar_pull - one.forces.drawbar_pull).abs() < 1e-9 * LOAD);

    // A step of another engine, at the sinkage where the model carries the load, with nothing free
    // to move: the same forces.
    let plain = settled(&Model::Ishigami, None, slip, LOAD);
    let inverse_mass = DMatrix::zeros(MOTIONS, FORCES);
    let (rim, v_x) = (1.0, 0.8);
    let free = DVector::from_row_slice(&[v_x, v_x * deg(10.0).tan(), 0.0, rim]);
    let step = TimeStep {
        duration: 1e-3,
        gravity: EARTH_GRAVITY,
        damping: SINKAGE_DAMPING,
        rest_speed: REST_SPEED,
        inverse_mass: &inverse_mass,
        free: &free,
    };
    let wheel =
        SteppingWheel { model, wheel: hakuto_wheel(), soil: contact.soil, sinkage: plain.sinkage };
    let stepped = step.reaction(&[wheel]).wheels[0].forces;
    // The rest speed of 0.1 mm/s beside 1 m/s, squared.
    assert!((stepped.drawbar_pull - one.forces.drawbar_pull).abs() < 1e-6 * LOAD);
    assert!((stepped.side_force - one.forces.side_force).abs() < 1e-6 * LOAD);
    assert!((stepped.torque - one.forces.torque).abs() < 1e-6 * LOAD);
}

/// A wheel that settles near its own answer needs no more than one that has no discrepancy: a guess
/// is a sinkage as answers have it.
/// Asked at the sinkage at which it has settled, a wheel has the forces that it has settled with.
#[test]
fn forces_at_a_settled_sinkage_are_those_of_the_settled_wheel() {
    for model in Model::ALL {
        for motion in MOTIONS_TRIED {
            let soil = sand(Some(uneven()));
            let contact = contact(soil, slip_of(motion));
            let settled = settled(&model, Some(uneven()), slip_of(motion), LOAD);
            for count in [1, 40] {
                let sunk = vec![(contact, settled.sinkage); count];
                for forces in forces_many(model.as_ref(), &sunk) {
                    for (found, expected) in [
                        (forces.normal_force, LOAD),
                        (forces.drawbar_pull, settled.forces.drawbar_pull),
                        (forces.torque, settled.forces.torque),
                    ] {
                        assert!((found - expected).abs() < 1e-8 * LOAD, "{found} for {expected}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_guess_has_the_discrepancy_of_an_answer() {
    let deep = Discrepancy { sinkage: [1.5; VALUES], ..Discrepancy::NONE };
    let slip = Slip::on_test_stand(0.2, deg(10.0));
    for model in Model::ALL {
        let again = |discrepancy: Option<Discrepancy>| {
            let contact = contact(sand(discrepancy), slip);
            let first = settle(model.as_ref(), &contact, LOAD).expect("it settles");
            settle_from(model.as_ref(), &contact, LOAD, first.sinkage).expect("it settles")
        };
        let (plain, with) = (again(None), again(Some(deep)));
        assert!(with.evaluations <= plain.evaluations + 1, "{model:?}: {}", with.evaluations);
    }
}

// ---- documents ----

fn read(addition: &str) -> LoadedSoil {
    let text = document::preset(Kind::Soil, "toyoura").expect("a preset").text;
    let source = Source::text("sand.toml", format!("{text}\n{addition}\n"));
    document::read_soil(&source, &Overrides::none()).expect("it is right")
}

fn list(values: &[f64]) -> String {
    format!("{values:?}")
}

#[test]
fn a_document_without_the_table_has_no_discrepancy() {
    let plain = read("");
    assert_eq!(plain.value.discrepancy, None);
    assert!(!plain.to_toml().contains("discrepancy"));
}

#[test]
fn a_documents_discrepancy_is_the_soils() {
    let Discrepancy { drawbar_pull, side_force, .. } = uneven();
    let table = format!(
        "[discrepancy]\ndrawbar_pull = {}\nside_force = {}",
        list(&drawbar_pull),
        list(&side_force)
    );
    let expected = Discrepancy { drawbar_pull, side_force, ..Discrepancy::NONE };
    let loaded = read(&table);
    assert_eq!(loaded.value.discrepancy, Some(expected));
    let again = Source::text("sand.toml", loaded.to_toml());
    let again = document::read_soil(&again, &Overrides::none()).expect("it is right");
    assert_eq!(again.value.discrepancy, Some(expected));
}

/// A row of samples has a column for each value that differs.
#[test]
fn samples_may_hold_a_discrepancy() {
    let loaded = read(&format!(
        "[discrepancy]\ndrawbar_pull = {}\n[uncertainty.samples]\ncsv = '''\n{}'''",
        list(&[0.0; VALUES]),
        "friction_angle_deg,discrepancy.drawbar_pull.2,discrepancy.drawbar_pull.19\n\
         37.0,0.05,-0.5\n37.0,0.05,-0.5\n",
    ));
    let drawn = loaded.uncertain.expect("it is uncertain").draw(1, 0).expect("a row");
    let found = drawn.discrepancy.expect("it has one").drawbar_pull;
    let mut expected = [0.0; VALUES];
    (expected[2], expected[19]) = (0.05, -0.5);
    assert_eq!(found, expected);
}

/// What a calibration found wrong with one model is not what another gets wrong: samples of others
/// have what any model may miss.
#[test]
fn a_discrepancy_goes_with_the_model_that_it_was_found_with() {
    let text = document::preset(Kind::Soil, "toyoura").expect("a preset").text;
    let soil = format!(
        "{}\n[discrepancy]\ndrawbar_pull = {}\n[uncertainty.samples]\ncsv = '''\n{}'''\n",
        text,
        list(&[0.0; VALUES]),
        "discrepancy.drawbar_pull.2\n0.05\n0.06\n",
    );
    let source = Source::text("sand.toml", &soil);
    let loaded = document::read_soil(&source, &Overrides::none()).expect("it is right");
    let samples = BandInputs::of_soil(&loaded, None).samples(1, 100).expect("samples");
    let pull =
        |sample: &Sample| sample.soil.discrepancy.expect("every sample has one").drawbar_pull;
    let (own, others): (Vec<&Sample>, Vec<&Sample>) =
        samples.iter().partition(|sample| sample.model == Model::Ishigami);
    assert!(own.iter().all(|it| [0.05, 0.06].contains(&pull(it)[2]) && pull(it)[0] == 0.0));
    assert!(!others.is_empty() && others.iter().all(|it| pull(it)[0] != 0.0));
}
