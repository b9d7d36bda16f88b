//! Which way the ground falls is nobody's choice: runs and missions on turned ground are the turned
//! runs and missions.

use std::f64::consts::{FRAC_PI_2, TAU};

use grouser::document::{self, Kind, Overrides, Source};
use grouser::mission::{Heading, Manoeuvre, Mission, MissionReport, MissionRun};
use grouser::simulation::equations::Equations;
use grouser::simulation::{Approach, Outcome, OutcomeKind, Run, Scenario, Trajectory};
use grouser::terrain::surface::{Cone, Crater, Incline, Surface};
use grouser::terrain::{Ground, Shape};
use grouser::units::{Vec2, deg};
use grouser::vehicle::{DriveLaw, RoverState};
use rayon::prelude::*;

use crate::million::Draw;

/// Directions by which everything is turned [°]: one obliquely, two squarely, and one nearly not.
/// Whole runs are turned by the first two, and by all of them where time does not matter.
const FEW: [f64; 4] = [217.0, 90.0, 180.0, -0.5];

/// Sixteen directions all around, and those few.
fn many() -> Vec<f64> {
    let around =
        (1..=16).map(|step| 22.5 * f64::from(step) + if step % 4 == 0 { 7.0 } else { 0.0 });
    around.chain(FEW).collect()
}

fn turned(place: Vec2, angle: f64) -> Vec2 {
    let (sin, cos) = angle.sin_cos();
    Vec2::new(cos * place.x - sin * place.y, sin * place.x + cos * place.y)
}

/// Ground by formula that is turned about the origin of its coordinates; a plane as an incline.
fn turned_ground(ground: &Ground, angle: f64) -> Ground {
    let surface = match &ground.shape {
        Shape::Plane(plane) => {
            Surface::Incline(Incline { slope: plane.slope, uphill: FRAC_PI_2 + angle })
        }
        Shape::Formula(Surface::Incline(it)) => {
            Surface::Incline(Incline { uphill: it.uphill + angle, ..*it })
        }
        Shape::Formula(Surface::Cone(it)) => {
            Surface::Cone(Cone { tip: turned(it.tip, angle), ..*it })
        }
        Shape::Formula(Surface::Crater(it)) => {
            Surface::Crater(Crater { centre: turned(it.centre, angle), ..*it })
        }
        other => panic!("not turned here: {other:?}"),
    };
    Ground::formula(ground.soil, surface).starting_at(turned(ground.start, angle))
}

fn turned_scenario(scenario: &Scenario, angle: f64) -> Scenario {
    let mut scenario = scenario.clone();
    scenario.ground = turned_ground(&scenario.ground, angle);
    scenario.start.yaw += angle;
    if let Some(yaw) = &mut scenario.yaw {
        yaw.points.iter_mut().for_each(|(_, yaw)| *yaw += angle);
    }
    scenario
}

fn turned_mission(mission: &Mission, angle: f64) -> Mission {
    let mut mission = mission.clone();
    mission.scenario = turned_scenario(&mission.scenario, angle);
    for leg in &mut mission.legs {
        leg.yaw = leg.yaw.map(|yaw| yaw + angle);
        if let Manoeuvre::Goto { place, .. } = &mut leg.manoeuvre {
            *place = turned(*place, angle);
        }
        if let Heading::Toward(place) = &mut leg.heading {
            *place = turned(*place, angle);
        }
    }
    mission
}

/// How far two ends are apart, over the way or a decimetre, with angles in parts of a radian.
fn apart(one: &Trajectory, other: &Trajectory, angle: f64) -> f64 {
    let pairs = one.records.windows(2);
    let way = pairs.map(|pair| (pair[1].state.position - pair[0].state.position).norm());
    let size = way.sum::<f64>().max(0.1);
    let (one, other) = (one.last(), other.last());
    let place = (turned(one.state.position, angle) - other.state.position).norm() / size;
    let yaw = (one.state.yaw + angle - other.state.yaw).rem_euclid(TAU);
    let yaw = yaw.min(TAU - yaw);
    let energy = (one.energy.motors - other.energy.motors).abs() / one.energy.motors.abs().max(0.1);
    place.max(yaw).max(energy)
}

fn scenarios() -> Vec<(String, Scenario)> {
    let read = |name: &str| {
        let source = Source::find(Kind::Scenario, name).expect("a preset");
        document::read_scenario(&source, &Overrides::none()).expect("it is valid").value
    };
    let ready = document::presets(Kind::Scenario).map(|it| (it.name.to_owned(), read(it.name)));
    let mut all: Vec<(String, Scenario)> = ready.collect();
    let base = read("traverse-10-deg-compensated");
    let hill = Cone { tip: Vec2::new(0.0, 4.0), slope: deg(12.0), rounding: 0.5 };
    let bowl = Crater::fresh(Vec2::new(0.0, 9.0), 16.0);
    for (name, surface) in [("hill", Surface::Cone(hill)), ("bowl", Surface::Crater(bowl))] {
        for approach in [Approach::Dynamic, Approach::QuasiSteady] {
            let mut scenario = base.clone();
            scenario.ground = Ground::formula(base.ground.soil, surface);
            scenario.numerics.approach = approach;
            all.push((format!("{name}, {approach:?}"), scenario));
        }
    }
    for slope in [30.0, 45.0, 60.0] {
        let mut scenario = base.clone();
        scenario.ground = base.ground.with_slope(deg(slope));
        all.push((format!("{slope}°"), scenario));
    }
    all
}

/// A scenario that lasts so long at most [s].
fn for_at_most(longest: f64, scenario: Scenario) -> Scenario {
    Scenario { duration: scenario.duration.min(longest), ..scenario }
}

/// Relative to the way: what rounding leaves of dynamic runs, whose steps are chosen by estimates
/// of their error and kept to a tolerance of 1e-6.
const DYNAMIC: f64 = 1e-6;
/// The same of missions, which turn wheels once a control period by what was seen.
const MISSION: f64 = 3e-6;
/// The same of a mission with turns on the spot, which begin and end their shifts by thresholds: a
/// millimetre in a metre.
const WITH_TURNS: f64 = 1e-3;

/// * `longest`: so long the runs are at most [s]
fn check_scenarios(scenarios: Vec<(String, Scenario)>, angles: &[f64], longest: f64) {
    let off = scenarios.into_par_iter().filter_map(|(name, scenario)| {
        let scenario = for_at_most(longest, scenario);
        let base = turned_scenario(&scenario, 0.0);
        let one = Run::new(&base).and_then(Run::to_end);
        let off = angles.iter().filter_map(|angle| {
            let angle = deg(*angle);
            let other = Run::new(&turned_scenario(&scenario, angle)).and_then(Run::to_end);
            match (&one, other) {
                (Ok(one), Ok(other)) => {
                    let off = apart(one, &other, angle);
                    let is_same = one.outcome.kind() == other.outcome.kind();
                    (!is_same || off > DYNAMIC).then(|| {
                        format!(
                            "{name}, {angle:.2}: {off:e}, {:?}, {:?}",
                            one.outcome, other.outcome
                        )
                    })
                }
                (one, other) => {
                    let errors = (one.as_ref().err().map(ToString::to_string), other.err());
                    matches!(errors, (None, _) | (_, None)).then(|| format!("{name}: {errors:?}"))
                }
            }
        });
        let off: Vec<String> = off.collect();
        (!off.is_empty()).then(|| off.join("\n"))
    });
    let off: Vec<String> = off.collect();
    assert!(off.is_empty(), "{}", off.join("\n"));
}

fn missions() -> Vec<(String, Mission)> {
    let ready = document::presets(Kind::Mission).flat_map(|it| {
        let source = Source::find(Kind::Mission, it.name).expect("a preset");
        let read = document::read_mission(&source, &Overrides::none()).expect("it is valid").value;
        read.missions()
            .into_iter()
            .map(move |(way, mission)| (format!("{} {way}", it.name), mission))
    });
    ready.collect()
}

fn drive(mission: &Mission) -> MissionReport {
    MissionRun::new(mission).expect("it is valid").to_end().expect("it drives")
}

fn check_missions(angles: &[f64]) {
    let off = missions().into_par_iter().filter_map(|(name, mission)| {
        let one = drive(&turned_mission(&mission, 0.0));
        let off = angles.iter().filter_map(|angle| {
            let angle = deg(*angle);
            let other = drive(&turned_mission(&mission, angle));
            let off = apart(&one.trajectory, &other.trajectory, angle);
            let kinds = |report: &MissionReport| -> Vec<OutcomeKind> {
                report.legs.iter().map(|leg| leg.outcome.kind()).collect()
            };
            let is_same = kinds(&one) == kinds(&other);
            let most = if name.starts_with("there-and-back") { WITH_TURNS } else { MISSION };
            (!is_same || off > most).then(|| {
                format!("{name}, {angle:.2}: {off:e}, {:?}, {:?}", kinds(&one), kinds(&other))
            })
        });
        let off: Vec<String> = off.collect();
        (!off.is_empty()).then(|| off.join("\n"))
    });
    let off: Vec<String> = off.collect();
    assert!(off.is_empty(), "{}", off.join("\n"));
}

/// Scenarios on planes, on a hill and in a bowl, and on slopes on which rovers slide and tip over.
#[test]
fn turned_scenarios_give_turned_runs() {
    check_scenarios(scenarios(), &FEW[..2], 6.0);
}

#[test]
fn turned_missions_give_turned_drives() {
    check_missions(&FEW[..1]);
}

#[test]
#[ignore = "minutes"]
fn scenarios_and_missions_turned_in_many_directions_give_turned_runs() {
    check_scenarios(scenarios(), &many(), f64::INFINITY);
    let random =
        random_states().into_iter().enumerate().map(|(case, (mut scenario, state, rims))| {
            scenario.start.yaw = state.yaw;
            scenario.drive = DriveLaw::Constant(rims[0]);
            (format!("random {case}"), scenario)
        });
    check_scenarios(random.collect(), &many(), 5.0);
    check_missions(&many());
}

/// Twenty random rovers on random soils on a plane, in a crater and on a cone, in random motion.
fn random_states() -> Vec<(Scenario, RoverState, Vec<f64>)> {
    let names = |kind| document::presets(kind).map(|it| it.name).collect::<Vec<_>>();
    let (rovers, soils) = (names(Kind::Rover), names(Kind::Soil));
    let one = |case: u64| {
        let mut draw = Draw::of_case(case);
        let mut among = |all: &[&str]| draw.one_of(all).to_owned();
        let keys = [
            format!("scenario.rover={}", among(&rovers)),
            format!("scenario.soil={}", among(&soils)),
            "scenario.load_transfer=quasi-static".to_owned(),
        ];
        let keys = Overrides::parse(keys.iter().map(String::as_str)).expect("keys");
        let read = document::read_scenario(&Source::default_scenario(), &keys);
        let mut scenario = read.expect("presets").value;
        let soil = scenario.ground.soil;
        let mut within = |low: f64, high: f64| draw.between(low, high);
        let (slope, place) =
            (deg(within(2.0, 15.0)), Vec2::new(within(-3.0, 3.0), within(2.0, 5.0)));
        scenario.ground = match case % 3 {
            0 => Ground::plane(soil, slope),
            1 => Ground::formula(soil, Surface::Crater(Crater::fresh(place, 12.0))),
            _ => Ground::formula(soil, Surface::Cone(Cone { tip: place, slope, rounding: 0.5 })),
        };
        let state = RoverState {
            position: Vec2::new(within(-0.5, 0.5), within(-0.5, 0.5)),
            yaw: within(-3.0, 3.0),
            velocity: Vec2::new(within(0.02, 0.06), within(-0.02, 0.02)),
            yaw_rate: within(-0.05, 0.05),
        };
        let rims = scenario.rover.mounts().iter().map(|_| within(0.02, 0.08)).collect();
        (scenario, state, rims)
    };
    (0..20).map(one).collect()
}

/// What the motion of a run is made of, where no solver's tolerance stands between: rates turn with
/// the ground.
#[test]
fn rates_turn_with_the_ground() {
    let mut compared = 0;
    for (scenario, state, rims) in random_states() {
        let rates = |angle: f64| {
            let turned_state = RoverState {
                position: turned(state.position, angle),
                yaw: state.yaw + angle,
                ..state
            };
            let scenario = turned_scenario(&scenario, angle);
            Equations::of(&scenario, &rims).rates(&turned_state)
        };
        let Ok(one) = rates(0.0) else { continue };
        let size = one.acceleration.velocity_rate.norm().max(1.0);
        for angle in many().into_iter().map(deg) {
            let other = rates(angle).expect("as it is not turned");
            let velocity = turned(one.velocity_slope, angle) - other.velocity_slope;
            let acceleration = one.acceleration.velocity_rate - other.acceleration.velocity_rate;
            let yaw = one.acceleration.yaw_acceleration - other.acceleration.yaw_acceleration;
            let power = (one.motor_power - other.motor_power).abs()
                + (one.soil_power - other.soil_power).abs();
            let off = [velocity.norm(), acceleration.norm(), yaw.abs(), power];
            assert!(off.iter().all(|it| *it < 1e-9 * size), "{angle}: {off:?}, {state:?}");
        }
        compared += 1;
    }
    assert!(compared >= 15, "{compared}");
}

/// On 45° a rover slides and on 60° its weight falls outside its wheels, on a plane as on the same
/// plane by heights, whichever way that falls.
#[test]
fn a_rover_slides_and_tips_over_alike_on_any_ground() {
    let base = scenarios().into_iter().find(|(name, _)| name == "60°").expect("it is there").1;
    for (slope, kind) in [(45.0, OutcomeKind::Sliding), (60.0, OutcomeKind::TippedOver)] {
        let mut plane = base.clone();
        plane.ground = base.ground.with_slope(deg(slope));
        let directions = FEW.map(|angle| turned_scenario(&plane, deg(angle)));
        for scenario in std::iter::once(plane).chain(directions) {
            let run = Run::new(&scenario).and_then(Run::to_end).expect("it is computed");
            assert_eq!(run.outcome.kind(), kind, "{slope}°: {:?}", run.outcome);
        }
    }
}

/// A drive along the contour of a hill comes round it at the height at which it began: 12° of
/// slope, 4 m from its tip.
#[test]
fn a_contour_leg_goes_round_a_hill() {
    let text = r#"
        schema = "mission/1"
        name = "round a hill"
        soil = "toyoura"
        rover = "hakuto"
        simulation = "quasi-steady"
        [terrain]
        surface = "cone"
        slope_deg = 8.0
        rounding_m = 0.2
        start_m = [0.0, -4.0]
        [[leg]]
        drive_m = 12.0
        speed_m_s = 0.06
        yaw_deg = 0.0
        heading = "contour"
    "#;
    let source = Source::text("hill.toml", text);
    let mission = document::read_mission(&source, &Overrides::none()).expect("valid").value;
    let report = drive(&mission.mission());
    assert_eq!(report.trajectory.outcome, Outcome::Completed);
    let start = mission.mission().scenario.ground.start;
    let radii = report.trajectory.records.iter().map(|it| (start + it.state.position).norm());
    let off = radii.map(|radius| (radius - 4.0).abs()).fold(0.0, f64::max);
    // Half way round, within 6 cm of map, 8 mm of height: what its heading offset asks for is
    // learnt on the way.
    let end = start + report.trajectory.last().state.position;
    assert!(off < 0.06, "{off} m off the contour");
    assert!(end.y > 3.5, "{end}");
}
