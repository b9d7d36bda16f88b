//! Campaigns as documents: what they mean, what their rows say, and what is wrong with them.

use std::sync::atomic::{AtomicU64, Ordering};

use grouser::document::campaign::{Frequencies, Role, STATUSES};
use grouser::document::table::{Cell, ColumnKind, Table, Values};
use grouser::document::unit_of;
use grouser::document::{self, Campaign, DocumentError, Kind, Overrides, Source};
use grouser::studies::ensemble::sensitivity::Sensitivity;
use grouser::studies::ensemble::statistics::Summary;
use grouser::studies::heading::HeadingStudy;
use grouser::studies::mission::DrivenMission;
use proptest::prelude::*;
use statrs::distribution::{ContinuousCDF, Normal};

fn read(text: &str) -> Result<Campaign, DocumentError> {
    document::read_campaign(&Source::text("campaign", text), &Overrides::none())
}

fn campaign(text: &str) -> Campaign {
    read(text).unwrap_or_else(|error| panic!("{error}"))
}

/// A campaign of a study, with more keys before its tables.
fn text(study: &str, keys: &str, tables: &str) -> String {
    format!(
        "schema = \"campaign/1\"\nname = \"test\"\nstudy = \"{study}\"\n{keys}\n{tables}\n\
         [[parameter]]\nkey = \"soil.friction_angle_deg\"\ndistribution = \"normal\"\n\
         standard_deviation = 2.0\n"
    )
}

fn attitude(keys: &str) -> String {
    text("heading", keys, "[scenario]\nslope_deg = 8.0\n")
}

fn whole(campaign: &Campaign) -> Vec<Table> {
    let shard = |shard| campaign.shard(shard, &|| true).expect("nobody stops it");
    (0..campaign.shards()).map(shard).collect()
}

fn floats(tables: &[Table], name: &str) -> Vec<Option<f64>> {
    let column = |table: &Table| match table.column(name) {
        Some(Values::Float(values)) => values.clone(),
        other => panic!("{name}: {other:?}"),
    };
    tables.iter().flat_map(column).collect()
}

fn texts(tables: &[Table], name: &str) -> Vec<Option<String>> {
    let column = |table: &Table| match table.column(name) {
        Some(Values::Text(values)) => values.clone(),
        other => panic!("{name}: {other:?}"),
    };
    tables.iter().flat_map(column).collect()
}

// ---- Closed forms ----

/// Bekker's wheel sinks by h = [W/(b k √(2r) B(n))]^(1/(n + ½)), which for n = 1 is C (W/k)^(2/3).
const BEKKER: &str = "schema = \"campaign/1\"\nname = \"closed form\"\nstudy = \"wheel-test\"\n\
    [wheel_test]\nmodel = \"bekker\"\nload_n = 20.0\nslip_ratio = 0.1\n\
    wheel = { radius_m = 0.1, width_m = 0.1 }\n\
    [wheel_test.soil]\ncohesion_kpa = 0.5\nfriction_angle_deg = 30.0\ndensity_kg_m3 = 1500.0\n\
    pressure_sinkage = { law = \"bekker\", k_c = 0.0, k_phi = 1e6, n = 1.0 }\n\
    stress_peak = { a0 = 0.4, a1 = 0.15 }\n\
    shear = { law = \"isotropic\", longitudinal_m = 0.02 }\n\
    [[parameter]]\nkey = \"soil.pressure_sinkage.k_phi\"\ndistribution = \"lognormal\"\n\
    standard_deviation = 3e5\n\
    [[parameter]]\nkey = \"load_n\"\ndistribution = \"lognormal\"\nstandard_deviation = 4.0\n";

fn bekker(keys: &str) -> Campaign {
    campaign(&BEKKER.replace("[wheel_test]", &format!("{keys}\n[wheel_test]")))
}

/// Variances of ln k and ln W: σ² = ln(1 + d²/m²).
fn variances() -> (f64, f64) {
    (0.3_f64.powi(2).ln_1p(), 0.2_f64.powi(2).ln_1p())
}

/// A lognormal over a lognormal, to a power, is lognormal: its quantiles are known.
#[test]
fn quantiles_of_a_closed_form_lie_in_their_intervals() {
    let (of_k, of_w) = variances();
    let middle = (20.0_f64.ln() - of_w / 2.0) - (1e6_f64.ln() - of_k / 2.0);
    let constant = (0.1 * 0.2_f64.sqrt() * 2.0 / 3.0_f64).ln();
    let (centre, deviation) = (2.0 / 3.0 * (middle - constant), 2.0 / 3.0 * (of_k + of_w).sqrt());
    for sampling in ["monte-carlo", "latin-hypercube", "sobol"] {
        let campaign = bekker(&format!("runs = 4096\nsampling = \"{sampling}\""));
        let shares = [0.025, 0.25, 0.5, 0.75, 0.975];
        let summary = Summary::of(&floats(&whole(&campaign), "sinkage_mm"), &shares);
        let summary = summary.expect("all settle");
        assert_eq!(summary.missing, 0);
        for quantile in summary.quantiles {
            let score = Normal::standard().inverse_cdf(quantile.share);
            let truth = 1e3 * (centre + deviation * score).exp();
            let (low, high) = (quantile.low.expect("many"), quantile.high.expect("many"));
            assert!(low <= truth && truth <= high, "{sampling}: {truth} {quantile:?}");
            // 4096 draws tell the outer quantiles with an error of 4 % of the deviation: an
            // interval of 16 % or so, whose ends are draws that scatter themselves.
            assert!(high - low < 0.25 * deviation * truth, "{sampling}: {quantile:?}");
        }
    }
}

/// Indices of a product of lognormal factors e^(a z): with v = a², S = (e^v − 1)/(e^Σv − 1) and
/// T = 1 − (e^(Σv − v) − 1)/(e^Σv − 1).
#[test]
fn sobol_indices_of_a_closed_form_lie_in_their_intervals() {
    let (of_k, of_w) = variances();
    let (k, w) = (4.0 / 9.0 * of_k, 4.0 / 9.0 * of_w);
    let all = (k + w).exp_m1();
    let campaign = bekker("runs = 2048\nsampling = \"sobol\"\nsensitivity = true");
    assert_eq!((campaign.runs(), campaign.factors().len()), (8192, 2));
    let outputs = floats(&whole(&campaign), "sinkage_mm");
    let found = Sensitivity::of(&outputs, 2, campaign.seed()).expect("it varies");
    for (index, (own, other)) in found.indices.iter().zip([(k, w), (w, k)]) {
        let (first, total) = (own.exp_m1() / all, 1.0 - other.exp_m1() / all);
        for (estimate, truth) in [(index.first, first), (index.total, total)] {
            assert!(estimate.low <= truth && truth <= estimate.high, "{truth} {estimate:?}");
            assert!(estimate.high - estimate.low < 0.2, "{estimate:?}");
        }
    }
}

// ---- Rows ----

#[test]
fn a_run_alone_is_its_row_of_the_shard_whatever_the_threads() {
    let campaign =
        campaign(&attitude("runs = 70\nshard_runs = 32\nsampling = \"latin-hypercube\""));
    assert_eq!((campaign.shards(), campaign.runs_of(2), campaign.runs_of(3)), (3, 64..70, 70..70));
    let tables = whole(&campaign);
    assert_eq!(tables.iter().map(Table::rows).collect::<Vec<_>>(), [32, 32, 6]);
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        assert_eq!(pool.install(|| whole(&campaign)), tables);
    }
    for index in [0_u64, 31, 32, 69] {
        let (shard, row) = (index / 32, usize::try_from(index % 32).expect("small"));
        let table = &tables[usize::try_from(shard).expect("small")];
        for (cell, (column, (name, values))) in
            campaign.run(index).iter().zip(campaign.columns().iter().zip(&table.columns))
        {
            assert_eq!(&column.name, name);
            match (cell, values) {
                (Cell::Float(cell), Values::Float(values)) => assert_eq!(*cell, values[row]),
                (Cell::Whole(cell), Values::Whole(values)) => assert_eq!(*cell, values[row]),
                (Cell::Text(cell), Values::Text(values)) => assert_eq!(*cell, values[row]),
                other => panic!("{name}: {other:?}"),
            }
        }
    }
}

#[test]
fn a_shard_stops_when_it_is_told_to() {
    let campaign = campaign(&attitude("runs = 500"));
    let asked = AtomicU64::new(0);
    let go_on = || asked.fetch_add(1, Ordering::Relaxed) < 10;
    assert_eq!(campaign.shard(0, &go_on), None);
    assert!(asked.load(Ordering::Relaxed) < 100, "it asked on");
}

/// The drawn numbers stand in the row, and the answer is that of the scenario with them.
#[test]
fn a_row_is_the_study_of_the_scenario_with_its_inputs() {
    let campaign = campaign(&attitude("runs = 5"));
    let tables = whole(&campaign);
    let angles = floats(&tables, "soil.friction_angle_deg");
    for (angle, yaw) in angles.iter().zip(floats(&tables, "yaw_deg")) {
        let set = format!("soil.friction_angle_deg={:?}", angle.expect("a draw"));
        let overrides = Overrides::parse([set.as_str(), "scenario.slope_deg=8"]).expect("they are");
        let scenario = document::read_scenario(&Source::default_scenario(), &overrides);
        let scenario = scenario.expect("it is one").value;
        let curve = HeadingStudy::of(&scenario).curve().expect("a soil");
        let attitude =
            curve.at(scenario.ground.plane_slope().expect("a plane")).expect("it exists");
        assert_eq!(yaw, Some(attitude.yaw.to_degrees()));
    }
}

/// The curve is followed only as far as the slope: the same bits, but next to its end round-off.
#[test]
fn an_attitude_on_one_slope_is_that_of_the_whole_curve() {
    let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none());
    let study = HeadingStudy::of(&scenario.expect("it is one").value);
    let curve = study.curve().expect("a soil");
    let (limit, _) = curve.limit().expect("it moves");
    for share in 0..=20 {
        let slope = limit * f64::from(share) / 20.0;
        let (whole, alone) = (curve.at(slope), study.on_slope(slope).expect("a soil"));
        let (whole, alone) = (whole.expect("below the limit"), alone.expect("below the limit"));
        if share < 19 {
            assert_eq!((whole.yaw, whole.slip_ratio), (alone.yaw, alone.slip_ratio), "{share}/20");
        } else {
            // At the fold the slope is flat: balanced to 1e-10 means known to 1e-5.
            assert!((whole.yaw - alone.yaw).abs() < 1e-4, "{share}/20");
        }
    }
    let beyond = study.on_slope(limit + 1e-6).expect("a soil");
    assert_eq!(
        beyond.map_err(|error| error.to_string()),
        curve.at(limit + 1e-6).map_err(|error| error.to_string())
    );
}

/// Rows without an answer keep their inputs and say why; nothing else is in them.
#[test]
fn rows_without_an_answer_have_a_status() {
    let steep = text("heading", "runs = 200", "[scenario]\nslope_deg = 20.0\n");
    let tables = whole(&campaign(&steep));
    let (statuses, reasons) = (texts(&tables, "status"), texts(&tables, "reason"));
    let yaws = floats(&tables, "yaw_deg");
    let mut failed = 0;
    for ((status, reason), yaw) in statuses.iter().zip(&reasons).zip(&yaws) {
        let status = status.as_deref().expect("every row has one");
        assert!(STATUSES.contains(&status), "{status}");
        assert_eq!((status == "ok", reason.is_none()), (yaw.is_some(), yaw.is_some()));
        failed += usize::from(status == "no level attitude");
    }
    assert!((20..180).contains(&failed), "{failed}");
    assert!(floats(&tables, "soil.friction_angle_deg").iter().all(Option::is_some));

    let heavy = BEKKER.replace("standard_deviation = 4.0", "mean = 3e4\nstandard_deviation = 3e4");
    let sunk = campaign(&heavy.replace("[wheel_test]", "runs = 20\n[wheel_test]"));
    assert!(
        texts(&whole(&sunk), "status").contains(&Some("soil cannot carry the load".to_owned()))
    );
}

/// Values that are fine one by one may be no soil together: λ above its largest at full slip.
#[test]
fn draws_that_are_no_soil_together_are_rows_with_a_status() {
    let soil = "[scenario.soil]\ncohesion_kpa = 0.0\nfriction_angle_deg = 38.0\n\
        density_kg_m3 = 1490.0\npressure_sinkage = { law = \"reece\", k_c = 0.0, k_phi = 120.0, n = 1.7 }\n\
        stress_peak = { a0 = 0.4, a1 = 0.15 }\n\
        shear = { law = \"isotropic\", longitudinal_m = 0.02 }\n\
        exit = { law = \"quadratic-in-slip\", at_zero = 0.5, per_slip = 0.9, per_slip2 = 0.0 }\n\
        [[parameter]]\nkey = \"soil.exit.per_slip\"\ndistribution = \"uniform\"\nlow = 0.5\nhigh = 1.5\n";
    let tables = whole(&campaign(&text("heading", "runs = 40", soil)));
    let unfit = texts(&tables, "status")
        .iter()
        .filter(|s| s.as_deref() == Some("not possible together"))
        .count();
    // λ(1) = 0.5 + per_slip is above 1.5 for half of the draws; 4 deviations are 13.
    assert!((7..33).contains(&unfit), "{unfit}");
    let reason = texts(&tables, "reason").into_iter().flatten().next().expect("some are");
    assert!(reason.contains("wheel sinkage ratio"), "{reason}");
}

#[test]
fn traverses_say_what_became_of_the_rover() {
    let keys = "runs = 3";
    let base = "[scenario]\nsimulation = \"quasi-steady\"\nduration_s = 5.0\n";
    let tables = whole(&campaign(&text("traverse", keys, base)));
    assert_eq!(texts(&tables, "outcome"), vec![Some("completed".to_owned()); 3]);
    assert_eq!(texts(&tables, "simulation"), vec![Some("quasi-steady".to_owned()); 3]);
    let columns = ["y_m", "distance_m", "drift_m_per_m", "energy_j", "energy_j_per_m", "power_w"];
    let [y, way, drift, energy, per_metre, power] =
        columns.map(|name| floats(&tables, name)[0].expect("it drove"));
    // A rim of 6 cm/s with some slip for 5 s; ratios are what they say.
    assert!((0.25..0.3).contains(&way), "{way}");
    assert!(y < 0.0 && drift == -y / way && per_metre == energy / way && power == energy / 5.0);
    let steep = "[scenario]\nslope_deg = 35.0\nduration_s = 5.0\n";
    let tables = whole(&campaign(&text("traverse", keys, steep)));
    assert_eq!(texts(&tables, "status"), vec![Some("ok".to_owned()); 3]);
    assert!(
        texts(&tables, "outcome").iter().all(|outcome| outcome.as_deref() != Some("completed"))
    );
    assert!(texts(&tables, "reason").iter().all(Option::is_some));
}

// ---- Missions ----

/// Two drives and a wait, that a limit on drift may stop; the slope is between 6° and 14°.
const MISSION: &str = "schema = \"campaign/1\"\nname = \"mission\"\nstudy = \"mission\"\nruns = 12\n\
    sampling = \"latin-hypercube\"\n\
    [mission]\nsimulation = \"quasi-steady\"\n\
    [mission.stop]\ndrift_m = { above = 0.008, over_m = 0.1 }\n\
    [[mission.leg]]\ndrive_m = 0.05\nyaw_deg = 0.0\n[[mission.leg]]\ndrive_m = 0.2\n\
    [[mission.leg]]\nwait_s = 1.0\n\
    [[parameter]]\nkey = \"slope_deg\"\ndistribution = \"uniform\"\nlow = 6.0\nhigh = 14.0\n";

/// A row is the mission with its inputs, driven alone: the mission's end, and each leg or that it
/// was not begun.
#[test]
fn a_row_of_a_mission_is_the_mission_with_its_inputs() {
    let campaign = campaign(MISSION);
    let tables = whole(&campaign);
    let slopes = floats(&tables, "slope_deg");
    let mut stopped = 0;
    for (run, slope) in slopes.iter().enumerate() {
        let document = MISSION.split_once("[mission]\n").expect("it has one").1;
        let document = document.split_once("[[parameter]]").expect("it has one").0;
        let slope = slope.expect("a sample");
        let text = format!(
            "schema = \"mission/1\"\nname = \"alone\"\nslope_deg = {slope:?}\n{}",
            document.replace("mission.", "")
        );
        let plan = document::read_mission(&Source::text("mission", text), &Overrides::none());
        let mission = plan.expect("it is one").value.mission();
        let alone = DrivenMission::drive("", &mission).expect("it can be driven");
        let text = |name: &str| texts(&tables, name)[run].clone();
        let float = |name: &str| floats(&tables, name)[run];
        assert_eq!(text("outcome").as_deref(), Some(alone.report.outcome()));
        assert_eq!(float("energy_j"), Some(alone.report.energy()));
        assert_eq!(float("x_m"), Some(alone.report.last().state.position.x));
        for place in 0..3 {
            let name = |column: &str| format!("leg_{}.{column}", place + 1);
            let leg = alone.legs.get(place).map(|leg| &leg.report);
            let outcome = leg.map_or("not_begun", |leg| leg.outcome.name());
            assert_eq!(text(&name("outcome")).as_deref(), Some(outcome));
            assert_eq!(float(&name("distance_m")), leg.map(|leg| leg.distance));
            assert_eq!(float(&name("slip_ratio")), leg.and_then(|leg| leg.slip_ratio));
            let is_stopped = outcome == "stopped";
            assert_eq!(text(&name("stopped_by")), is_stopped.then(|| "drift_m".to_owned()));
            stopped += usize::from(is_stopped);
        }
        // Rims that have not gone 0.1 m are not looked at, so that the first leg always ends.
        assert_eq!(text("leg_1.outcome").as_deref(), Some("completed"));
    }
    assert!((1..12).contains(&stopped), "{stopped}");
    let mut frequencies = Frequencies::default();
    for column in campaign.words_of_legs() {
        frequencies.add_of_leg(&campaign, 0..12, column, &texts(&tables, column));
    }
    let counts = |column: &str| &frequencies.legs.iter().find(|it| it.0 == column).expect("one").1;
    assert_eq!(counts("leg_1.outcome")["completed"], 12);
    assert_eq!(counts("leg_2.outcome")["stopped"], stopped);
    assert_eq!(counts("leg_2.stopped_by")["drift_m"], stopped);
    assert_eq!(counts("leg_3.outcome")["not_begun"], stopped);
    assert!(counts("leg_1.stopped_by").is_empty());
}

/// Keys of legs are inputs as others, a resolved campaign is the same one, and what cannot be is
/// named.
#[test]
fn missions_of_campaigns_are_checked() {
    let of_leg = MISSION.replace(
        "key = \"slope_deg\"\ndistribution = \"uniform\"\nlow = 6.0\nhigh = 14.0",
        "key = \"leg.1.drive_m\"\ndistribution = \"uniform\"\nlow = 0.1\nhigh = 0.2",
    );
    let with_legs = campaign(&of_leg);
    let (inputs, ways) = (whole(&with_legs), floats(&whole(&with_legs), "leg_2.distance_m"));
    for (given, way) in floats(&inputs, "leg.1.drive_m").iter().zip(ways) {
        let (given, way) = (given.expect("a sample"), way.expect("it was driven"));
        assert!(way > 0.0 && way <= given + 1e-6, "{way} of {given}");
    }
    assert_eq!(campaign(with_legs.resolved()).run(3), with_legs.run(3));
    let refused = |text: &str| read(text).expect_err("it is refused").to_string();
    let start = refused(&MISSION.replace("key = \"slope_deg\"", "key = \"start.yaw_deg\""));
    assert!(start.contains("the first leg begins with a yaw of its own"), "{start}");
    let fault = refused(&MISSION.replace("wait_s = 1.0", "wait_s = 1.0\ndrive_m = 1.0"));
    assert!(fault.contains("leg 3 has both"), "{fault}");
    let ways = MISSION.replace("[[mission.leg]]", "[[mission.alternative.leg]]");
    let ways = ways.replacen(
        "[[mission.alternative.leg]]",
        "[[mission.alternative]]\nname = \"one\"\n[[mission.alternative.leg]]",
        1,
    );
    assert!(refused(&ways).contains("without alternatives"), "{}", refused(&ways));
    let other = refused(&format!("scenario = \"traverse-10-deg\"\n{MISSION}"));
    assert!(other.contains("the study does not use this table"), "{other}");
    let none = refused(&text("mission", "runs = 3", ""));
    assert!(none.contains("mission = \"slip-check\""), "{none}");
}

#[test]
fn columns_say_their_kind_role_and_unit() {
    let campaign = campaign(&attitude("runs = 2\nsensitivity = true"));
    let columns = campaign.columns();
    let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
    assert_eq!(
        names[..6],
        ["run", "point", "matrix", "soil.friction_angle_deg", "status", "reason"]
    );
    assert_eq!((columns[0].kind, columns[0].role), (ColumnKind::Whole, Role::Index));
    assert_eq!((columns[3].role, columns[3].unit()), (Role::Input, Some("°")));
    assert_eq!((columns[4].role, columns[4].unit()), (Role::Status, None));
    for (name, expected) in [
        ("energy_j_per_m", Some("J/m")),
        ("leg_2.distance_m", Some("m")),
        ("leg_2.slip_ratio", None),
        ("drift_m_per_m", Some("m/m")),
        ("yaw_moment_nm", Some("N·m")),
        ("soil.density_kg_m3", Some("kg/m³")),
        ("soil.shear.longitudinal_per_rad_m", Some("m/rad")),
        ("yaw_rate_deg_s", Some("°/s")),
        ("downhill_m_per_m", Some("m/m")),
        ("rover.mount.0.position_m.2", Some("m")),
        ("slip_ratio", None),
        ("soil.pressure_sinkage.n", None),
    ] {
        assert_eq!(unit_of(name).map(|unit| unit.symbol), expected, "{name}");
    }
    let matrices = texts(&whole(&campaign), "matrix");
    let one = ["a", "b", "soil.friction_angle_deg"].map(|name| Some(name.to_owned()));
    assert_eq!(matrices, [one.clone(), one].concat());
}

// ---- What is uncertain ----

#[test]
fn the_soils_own_uncertainty_becomes_the_campaigns() {
    let keys = "schema = \"campaign/1\"\nname = \"own\"\nstudy = \"heading\"\nruns = 1000\n";
    let own = campaign(&format!(
        "{keys}soil_uncertainty = true\nscenario = {{ soil = \"toyoura-uncertain\" }}\n"
    ));
    let inputs = own.columns().iter().filter(|column| column.role == Role::Input).count();
    assert_eq!(inputs, 5);
    let resolved = own.resolved();
    for part in
        ["soil_uncertainty = false", "key = \"soil.exit.ratio\"", "mean = 38.0", "value = 0.4"]
    {
        assert!(resolved.contains(part), "{part}: {resolved}");
    }
    assert!(!resolved.contains("uncertainty.parameter"), "{resolved}");
    assert_eq!(campaign(resolved).run(7), own.run(7));
}

#[test]
fn samples_are_rows_that_stay_together_and_go_into_the_resolved_document() {
    let folder = std::env::temp_dir().join(format!("grouser-campaign-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let rows = "soil.friction_angle_deg, soil.cohesion_kpa\n36.5,0.1\n37.25,0.2\n38,0.3\n";
    std::fs::write(folder.join("posterior.csv"), rows).expect("it is written");
    let keys = "schema = \"campaign/1\"\nname = \"rows\"\nstudy = \"heading\"\nruns = 30\n";
    let document = format!("{keys}samples = \"posterior.csv\"\n[scenario]\nslope_deg = 5.0\n");
    std::fs::write(folder.join("campaign.toml"), document).expect("it is written");
    let source = Source::file(folder.join("campaign.toml"));
    let campaign = document::read_campaign(&source, &Overrides::none());
    let campaign = campaign.unwrap_or_else(|error| panic!("{error}"));
    std::fs::remove_dir_all(&folder).expect("it is ours");
    assert_eq!(campaign.factors(), ["samples"]);
    let tables = whole(&campaign);
    let pairs = floats(&tables, "soil.friction_angle_deg");
    let mut seen: Vec<(Option<f64>, Option<f64>)> =
        pairs.into_iter().zip(floats(&tables, "soil.cohesion_kpa")).collect();
    seen.sort_by(|one, other| one.partial_cmp(other).expect("numbers"));
    seen.dedup();
    let expected = [(36.5, 0.1), (37.25, 0.2), (38.0, 0.3)].map(|(a, b)| (Some(a), Some(b)));
    assert_eq!(seen, expected);
    let again = read(campaign.resolved()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(again.resolved(), campaign.resolved());
    assert_eq!(whole(&again), tables);
}

/// A wide distribution is cut at the ends of the key's range, so that every draw is inside.
#[test]
fn draws_stay_in_the_range_of_their_key() {
    let tables = "[scenario]\n[[parameter]]\nkey = \"soil.exit.ratio\"\ndistribution = \"normal\"\n\
                  mean = 1.4\nstandard_deviation = 0.5\n";
    let campaign = campaign(&text("heading", "runs = 400", tables));
    let draws: Vec<f64> = (0..400)
        .filter_map(|run| campaign.ensemble().inputs(run).values.first().copied())
        .collect();
    assert!(draws.iter().all(|ratio| (0.0..=1.5).contains(ratio)));
    assert!(draws.iter().any(|ratio| *ratio > 1.45), "the range is used to its end");
}

/// The range is that of the law in force: speeds of Eq. (18) are positive, constant ones may be
/// negative.
#[test]
fn draws_stay_in_the_range_that_their_law_gives_the_key() {
    for (law, speed, allows_reverse) in
        [("constant", "rim_speed_m_s", true), ("eq18", "ground_speed_m_s", false)]
    {
        let tables = format!(
            "[scenario]\ndrive = {{ law = \"{law}\" }}\n[[parameter]]\nkey = \"drive.{speed}\"\n\
             distribution = \"normal\"\nmean = 0.05\nstandard_deviation = 0.05\n"
        );
        let campaign = campaign(&text("heading", "runs = 400", &tables));
        let speeds = (0..400).map(|run| campaign.ensemble().inputs(run).values[0]);
        assert_eq!(speeds.into_iter().any(|speed| speed < 0.0), allows_reverse, "{law}");
    }
}

#[test]
fn any_number_of_the_base_can_be_drawn() {
    for key in [
        "slope_deg",
        "rover.body.mass_kg",
        "rover.wheel_unit.wheel.width_m",
        "rover.wheel_unit.wheel.grousers.height_m",
        "rover.mount.0.position_m.0",
        "soil.shear.lateral_per_rad_m",
        "drive.rim_speed_m_s",
        "gravity_m_s2",
    ] {
        let own = format!(
            "[scenario]\n[[parameter]]\nkey = \"{key}\"\ndistribution = \"normal\"\n\
             standard_deviation = 1e-3\n"
        );
        let campaign = campaign(&text("heading", "runs = 2", &own));
        let tables = whole(&campaign);
        assert_eq!(texts(&tables, "status"), vec![Some("ok".to_owned()); 2], "{key}");
        let drawn = floats(&tables, key);
        assert_ne!(drawn[0], drawn[1], "{key}");
    }
}

/// `--set` reaches the campaign, and through it what it names.
#[test]
fn values_are_set_from_outside() {
    let sets = ["campaign.runs=3", "scenario.slope_deg=12", "soil.cohesion_kpa=0.25"];
    let overrides = Overrides::parse(sets).expect("they are written so");
    let source = Source::find(Kind::Campaign, "campaign-heading").expect("a preset");
    let campaign = document::read_campaign(&source, &overrides).expect("it is one");
    assert_eq!(campaign.runs(), 3 * 8);
    for part in ["slope_deg = 12.0", "cohesion_kpa = 0.25"] {
        assert!(campaign.resolved().contains(part), "{part}");
    }
    assert!(campaign.assumptions().iter().any(|one| one.contains("cohesion_kpa: set to 0.25")));
}

// ---- What is wrong ----

/// Checks that a document is refused with a message that has all of these parts.
fn check_refused(text: &str, parts: &[&str]) {
    let error = match read(text) {
        Ok(_) => panic!("read: {text}"),
        Err(error) => error.to_string(),
    };
    for part in parts {
        assert!(error.contains(part), "`{part}` is not in:\n{error}");
    }
}

#[test]
fn what_is_wrong_with_a_campaign_is_told_where_it_stands() {
    let more = |parameter: &str| attitude("runs = 4").replace("[[parameter]]", parameter);
    let own = |key: &str, rest: &str| {
        more(&format!("[[parameter]]\nkey = \"{key}\"\n{rest}\n[[parameter]]"))
    };
    let normal = "distribution = \"normal\"\nstandard_deviation = 1.0";
    check_refused(
        &own("soil.cohesion", normal),
        &["unknown key `soil.cohesion`", "soil.cohesion_kpa"],
    );
    check_refused(&own("friction_angle_deg", normal), &["did you mean `soil.friction_angle_deg`?"]);
    check_refused(&own("soil.name", normal), &["`soil.name` is not a number of what is varied"]);
    check_refused(
        &own("soil.rft.surface_friction_angle_deg", normal),
        &["gives this key no value"],
    );
    check_refused(&own("start.yaw_deg", normal), &["the study does not use this key"]);
    check_refused(&own("soil.friction_angle_deg", normal), &["a second time"]);
    check_refused(
        &own("soil.exit.ratio", "distribution = \"normal\"\nmean = 40.0\nstandard_deviation = 1.0"),
        &["less than 1 % of the samples of `soil.exit.ratio`", "0 to 1.5"],
    );
    check_refused(
        &own("soil.exit.ratio", "distribution = \"uniform\"\nlow = 1.0\nhigh = 2.0"),
        &["high = 2.0", "0 to 1.5"],
    );
    check_refused(
        &own("soil.exit.ratio", "distribution = \"uniform\"\nlow = 1.0\nhigh = 0.5"),
        &["above low, 1"],
    );
    check_refused(
        &own("soil.exit.ratio", "distribution = \"triangular\"\nlow = 0.5\nmode = 1.3\nhigh = 1.0"),
        &["`mode` is 1.3"],
    );
    check_refused(
        &own("soil.cohesion_kpa", "distribution = \"lognormal\"\nstandard_deviation = 1.0"),
        &["above 0 to be lognormal"],
    );
    check_refused(&own("slope_deg", "distribution = \"gamma\""), &["\"gamma\"", "\"triangular\""]);
    check_refused(&own("slope_deg", "standard_deviation = 1.0"), &["distribution` is missing"]);
    check_refused(
        &own("slope_deg", "distribution = \"uniform\"\nmean = 3.0\nlow = 0\nhigh = 1"),
        &[
            "unknown key `parameter.0.mean`",
            "it goes with distribution = \"normal\" or \"lognormal\"",
        ],
    );
    check_refused(&attitude("runs = 0"), &["runs", "1 to"]);
    let exact = Overrides::parse(["soil.priors=none"]).expect("it is written so");
    let whole = Source::text("campaign", attitude("runs = 4\nsoil_uncertainty = true"));
    let error = document::read_campaign(&whole, &exact).expect_err("it is exact").to_string();
    assert!(error.contains("how well it is known"), "{error}");
    check_refused(&attitude(""), &["`runs` is missing"]);
    check_refused(&text("heading", "runs = 4", ""), &["`scenario` is missing", "traverse-10-deg"]);
    check_refused(&text("wheel-test", "runs = 4", "[scenario]\n"), &["does not use this table"]);
    check_refused(&text("wheel-test", "runs = 4", ""), &["`wheel_test` is missing"]);
    let pair = "[scenario]\n[[correlation]]\nbetween = [\"soil.friction_angle_deg\", \"slope_deg\"]\n\
                value = 0.5\n[[parameter]]\nkey = \"slope_deg\"\ndistribution = \"normal\"\n\
                standard_deviation = 1.0\n";
    assert!(read(&text("heading", "runs = 4", pair)).is_ok());
    check_refused(
        &text("heading", "runs = 4\nsensitivity = true", pair),
        &["no Sobol indices of their own"],
    );
    check_refused(
        &text("heading", "runs = 4", &pair.replace("\"slope_deg\"]", "\"gravity_m_s2\"]")),
        &["`gravity_m_s2` has a correlation"],
    );
    check_refused(
        &text("heading", "runs = 4", &pair.replace("0.5", "1.0")),
        &["positive definite"],
    );
    check_refused(
        "schema = \"campaign/1\"\nstudy = \"heading\"\nruns = 4\nscenario = \"traverse-10-deg\"\n",
        &["`parameter` is missing", "soil_uncertainty = true"],
    );
    check_refused(
        &attitude("runs = 4\nsamples = { csv = \"slope_deg\\n5\\n95\\n\" }"),
        &["samples:3:1", "`slope_deg` is 95"],
    );
    check_refused(&attitude("runs = 4\nsamples = \"none.csv\""), &["no file of samples none.csv"]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// What still can be read after a change means the same when it is written and read again.
    #[test]
    fn changed_campaigns_never_panic(
        at in any::<prop::sample::Index>(),
        length in 0_usize..12,
        piece in "([0-9.eE+-]{0,6}|[\\[\\]{}=\"'.,\n#a-z_]{0,6}|nan|inf|-1e400)",
    ) {
        let whole = attitude("runs = 4\nsensitivity = true");
        let chars: Vec<char> = whole.chars().collect();
        let start = at.index(chars.len());
        let end = (start + length).min(chars.len());
        let text: String = chars[..start].iter().chain(&piece.chars().collect::<Vec<_>>())
            .chain(&chars[end..]).collect();
        match read(&text) {
            Ok(first) => {
                let second = read(first.resolved()).map(|again| again.run(1));
                prop_assert_eq!(second, Ok(first.run(1)));
            }
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }
}
