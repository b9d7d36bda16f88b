use grouser::contact::*;
use grouser::soil::*;
use grouser::units::*;
use grouser::wheel::*;
fn soil(n: f64, k: f64, kx: f64, iso: bool, lam: f64) -> Soil {
    Soil {
        cohesion: 0.0,
        friction_angle: deg(38.0),
        density: 1490.0,
        pressure_sinkage: PressureSinkage::Reece {
            k_c: 0.0,
            k_phi: k,
            exponent: SinkageExponent::constant(n),
        },
        stress_peak: StressPeak { a0: 0.4, a1: 0.15 },
        shear: if iso {
            Shear::Isotropic { modulus: ShearModulus::constant(kx) }
        } else {
            Shear::Anisotropic {
                longitudinal: ShearModulus::constant(kx),
                lateral: ShearModulus::constant(kx / 2.0),
            }
        },
        exit: Exit::Ratio(lam),
        bulldozing: Bulldozing::Sine,
    }
}
fn main() {
    let wheel =
        Wheel { radius: 0.1, width: 0.08, grousers: Some(Grousers { height: 0.01, count: 24 }) };
    for iso in [false, true] {
        for n in [0.3, 0.5, 0.7, 1.0, 1.3, 1.7, 2.0] {
            for kx in [0.0005, 0.005, 0.036] {
                let mut worst: [f64; 3] = [0.0; 3];
                let mut at = [(0.0, 0.0, 0.0); 3];
                for s in [-0.9, -0.5, -0.2, -0.05, -0.01, 0.05, 0.2, 0.5, 0.9, 1.0, 1.5] {
                    for beta in [0.0, 5.0, 30.0, 80.0] {
                        for h in [0.001, 0.012, 0.05] {
                            let contact = Contact {
                                wheel,
                                soil: soil(n, 122.7, kx, iso, 1.0),
                                slip: Slip::on_test_stand(s, deg(beta)),
                                gravity: 9.80665,
                            };
                            let a = Ishigami::default().forces(&contact, h);
                            let b = Ishigami::reference().forces(&contact, h);
                            let w = b.normal_force.abs().max(1e-9);
                            let e = ((a.drawbar_pull - b.drawbar_pull)
                                .abs()
                                .max((a.side_force - b.side_force).abs())
                                .max((a.normal_force - b.normal_force).abs()))
                                / w;
                            let c = if s < 0.0 {
                                0
                            } else if s <= 1.0 {
                                1
                            } else {
                                2
                            };
                            if e > worst[c] {
                                worst[c] = e;
                                at[c] = (s, beta, h);
                            }
                        }
                    }
                }
                println!(
                    "iso {iso} n {n} K {kx}: skid {:.1e} {:?} drive {:.1e} {:?} opp {:.1e} {:?}",
                    worst[0], at[0], worst[1], at[1], worst[2], at[2]
                );
            }
        }
    }
    let contact = Contact {
        wheel,
        soil: soil(1.703, 122.7, 0.036, false, 1.0),
        slip: Slip::on_test_stand(0.2, deg(5.0)),
        gravity: 9.80665,
    };
    let t = std::time::Instant::now();
    let mut acc = 0.0;
    let mut ev = 0;
    for i in 0..20000 {
        let r = settle(&Ishigami::default(), &contact, 10.0 + 1e-3 * i as f64).unwrap();
        acc += r.sinkage;
        ev += r.evaluations;
    }
    println!("settle {:?} evaluations {} {acc}", t.elapsed() / 20000, ev as f64 / 20000.0);
    for s in [-1.0, -0.5, -0.1, -0.01, 0.0, 0.01, 0.1, 0.5, 1.0, 1.5, 2.0] {
        let c = Contact { slip: Slip::on_test_stand(s, deg(10.0)), ..contact };
        println!(
            "{s} {:?}",
            settle(&Ishigami::default(), &c, 17.0).map(|r| (
                r.sinkage,
                r.evaluations,
                r.forces.drawbar_pull,
                r.forces.side_force,
                r.forces.torque
            ))
        );
    }
}
