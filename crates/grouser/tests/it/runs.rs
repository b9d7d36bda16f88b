//! probe
use super::given;
use grouser::simulation::*;
use grouser::soil::*;
use grouser::units::*;
use grouser::vehicle::drive::SlipTarget;
use grouser::vehicle::*;

fn show(name: &str, s: &Scenario) {
    let t = std::time::Instant::now();
    match Simulation::new(s).and_then(Simulation::run) {
        Ok(r) => {
            let l = r.last();
            let st = l.state;
            println!(
                "{name}: {:?} t {:.2} x {:.6} y {:.6} yaw {:.4}° u {:.6} v {:.6} r {:.2e} | motors {:.5} err {:.1e} | ev {} {:?}",
                r.outcome,
                l.time,
                st.position.x,
                st.position.y,
                st.yaw.to_degrees(),
                st.velocity.x,
                st.velocity.y,
                st.yaw_rate,
                l.energy.motors,
                r.energy_error(),
                r.work.evaluations,
                t.elapsed()
            );
        }
        Err(e) => println!("{name}: ERROR {e} {:?}", t.elapsed()),
    }
}

#[test]
fn probe() {
    let base = given::traverse(deg(10.0), deg(5.5));
    show("base", &base);
    for tol in [1e-5, 1e-7, 1e-8] {
        show(
            &format!("tol {tol}"),
            &Scenario {
                numerics: Numerics {
                    integrator: Integrator::Bdf { tolerance: tol },
                    ..base.numerics
                },
                ..base.clone()
            },
        );
    }
    let two = Scenario { duration: 2.0, ..base.clone() };
    show("bdf 2s", &two);
    for step in [1e-3, 5e-4, 1e-4] {
        show(
            &format!("rk4 {step}"),
            &Scenario {
                numerics: Numerics { integrator: Integrator::Rk4 { step }, ..base.numerics },
                ..two.clone()
            },
        );
    }
    for (slope, yaw) in [(5.0, 2.13), (10.0, 5.04), (15.0, 9.58), (20.0, 21.38)] {
        show("attitude", &given::traverse(deg(slope), deg(yaw)));
    }
    let target = SlipTarget { speed: 0.06, slip_ratio: 0.2 };
    show("eq18", &Scenario { drive: DriveLaw::Eq18(target), ..base.clone() });
    show("eq18p", &Scenario { drive: DriveLaw::Eq18AsPrinted(target), ..base.clone() });
    show("rest", &Scenario { start: Start { motion: Motion::Rest, ..base.start }, ..base.clone() });
    show("torque", &Scenario { sharing: LoadSharing::QuasiStaticTorque, ..base.clone() });
    show("own", &Scenario { own_moments: OwnMoments::Included, ..base.clone() });
    show(
        "own torque",
        &Scenario {
            own_moments: OwnMoments::Included,
            sharing: LoadSharing::QuasiStaticTorque,
            ..base.clone()
        },
    );
    show(
        "uniform own",
        &Scenario {
            own_moments: OwnMoments::Included,
            sharing: LoadSharing::Uniform,
            ..base.clone()
        },
    );
    show("reverse", &Scenario { drive: DriveLaw::Constant(-0.06), ..base.clone() });
    let level = given::traverse(0.0, 0.0);
    show("level", &level);
    let spin = DriveLaw::ConstantEach(vec![-0.06, -0.06, 0.06, 0.06]);
    let rest = Start { yaw: 0.0, motion: Motion::Rest };
    show("spot", &Scenario { drive: spin.clone(), start: rest, ..level.clone() });
    let soil = |shear| {
        let mut s = level.clone();
        s.site.soil.shear = shear;
        s
    };
    let iso = Shear::Isotropic { modulus: given::linear(0.036, 0.043) };
    let cons = Shear::Anisotropic {
        longitudinal: given::linear(0.036, 0.0),
        lateral: given::linear(0.013, 0.0),
    };
    show("spot iso", &Scenario { drive: spin.clone(), start: rest, ..soil(iso) });
    show("spot const", &Scenario { drive: spin.clone(), start: rest, ..soil(cons) });
    for k in [0.01, 0.02, 0.03] {
        show(
            &format!("spot Kx1 {k}"),
            &Scenario {
                drive: spin.clone(),
                start: rest,
                ..soil(Shear::Anisotropic {
                    longitudinal: given::linear(0.036, k),
                    lateral: given::linear(0.013, 0.020),
                })
            },
        );
    }
    show(
        "spot energy 2s",
        &Scenario { drive: spin.clone(), start: rest, duration: 2.0, ..level.clone() },
    );
    show(
        "arc",
        &Scenario { drive: DriveLaw::ConstantEach(vec![0.04, 0.04, 0.08, 0.08]), ..level.clone() },
    );
    show(
        "locked",
        &Scenario { drive: DriveLaw::ConstantEach(vec![0.0, 0.06, 0.06, 0.06]), ..level.clone() },
    );
    for s in [10.0, 20.0, 30.0] {
        show(
            &format!("parked {s}"),
            &Scenario {
                drive: DriveLaw::Constant(0.0),
                start: rest,
                duration: 60.0,
                ..given::traverse(deg(s), 0.0)
            },
        );
        show(
            &format!("parked nose up {s}"),
            &Scenario {
                drive: DriveLaw::Constant(0.0),
                start: Start { yaw: deg(90.0), ..rest },
                duration: 60.0,
                ..given::traverse(deg(s), 0.0)
            },
        );
    }
    for s in [20.0, 22.0, 25.0, 30.0, 35.0] {
        show(&format!("uphill {s}"), &given::traverse(deg(s), deg(90.0)));
        show(&format!("across {s}"), &given::traverse(deg(s), 0.0));
    }
    show(
        "uphill25 rest",
        &Scenario {
            start: Start { yaw: deg(90.0), ..rest },
            ..given::traverse(deg(25.0), deg(90.0))
        },
    );
    show(
        "kx .3",
        &soil(Shear::Anisotropic {
            longitudinal: given::linear(0.3, 0.043),
            lateral: given::linear(0.013, 0.020),
        }),
    );
    show("tip 58", &given::traverse(deg(58.0), 0.0));
    show("50", &given::traverse(deg(50.0), 0.0));
    let mut soft = level.clone();
    soft.site.soil.pressure_sinkage =
        PressureSinkage::Reece { k_c: 0.0, k_phi: 1.0, exponent: SinkageExponent::constant(1.703) };
    show("soft", &soft);
    let three = given::rover_on(given::hakuto_wheel(), &[(0.25, 0.0), (-0.15, 0.2), (-0.15, -0.2)]);
    show("three", &Scenario { rover: three, ..base.clone() });
    let six = given::rover_on(
        given::hakuto_wheel(),
        &[(0.25, 0.24), (0.0, 0.24), (-0.25, 0.24), (-0.25, -0.24), (0.0, -0.24), (0.25, -0.24)],
    );
    show("six", &Scenario { rover: six, ..base.clone() });
    let mut moon = base.clone();
    moon.site.gravity = MOON_GRAVITY;
    show("moon", &moon);
    let mut bek = base.clone();
    bek.theory = grouser::contact::Theory::Bekker;
    show("bekker", &bek);
    let mut sign = base.clone();
    sign.site.soil.bulldozing = Bulldozing::Sign;
    show("sign", &sign);
    let mut sign = level.clone();
    sign.site.soil.bulldozing = Bulldozing::Sign;
    show("sign level", &sign);
}
