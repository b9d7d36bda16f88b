//! `import`: other laboratories' files as ours.

use std::fmt::Write as _;

use insta::assert_snapshot;
use serde_json::Value;

use crate::bad_input::{check_is_refusal, check_refused};
use crate::program::{Place, number};
use crate::validate::{JUDGE, simulate};

/// The simulated test as a laboratory might write it that likes commas, percent, centimetres,
/// and forces on the soil rather than on the wheel.
fn their_layout(place: &Place) -> String {
    let json = place.json(simulate());
    let mut text = "Laboratory of sand\nrun 7\nslip %;beta;W [N];z (cm);Fx [kN];T\n".to_owned();
    for row in json["rows"].as_array().expect("rows") {
        let value = |word: &str| number(&row[word]);
        let ours = value("slip_ratio");
        // Theirs is wr/v - 1 throughout.
        let theirs = if ours > 0.0 { ours / (1.0 - ours) } else { ours };
        let cells = [
            theirs * 100.0,
            value("slip_angle_deg").to_radians(),
            value("load_n"),
            value("sinkage_mm") / 10.0,
            -value("drawbar_pull_n") / 1000.0,
            value("torque_nm"),
        ];
        let cells = cells.map(|cell| cell.to_string().replace('.', ","));
        writeln!(text, "{}", cells.join(";")).expect("writing to memory");
    }
    text
}

const IMPORT: [&str; 20] = [
    "import",
    "theirs.csv",
    "--delimiter",
    ";",
    "--decimal-comma",
    "--skip-lines",
    "2",
    "--slip-definition",
    "hub",
    "--column",
    "slip_ratio=slip %:%",
    "--column",
    "slip_angle_deg=beta:rad",
    "--column",
    "load_n=W [N]",
    "--column",
    "sinkage_mm=z (cm):cm",
    "--column",
    "drawbar_pull_n=-Fx [kN]:kN",
    "--column=torque_nm=T",
];

#[test]
fn units_signs_commas_and_slips_come_back() {
    let place = Place::new();
    place.write("ours.csv", place.results(&format!("{} --format csv", simulate())));
    place.write("theirs.csv", their_layout(&place));
    let answer = place.run(&[&IMPORT[..], &["--out", "imported.csv"]].concat());
    assert_eq!((answer.code(), answer.stdout.as_str()), (0, ""), "{}", answer.stderr);
    assert!(answer.stderr.contains("36 trials in 12 cells"), "{}", answer.stderr);
    let [ours, imported] = ["ours.csv", "imported.csv"].map(|file| {
        let json = place.json(&format!("{JUDGE} --data {file}"));
        json["overall"].clone()
    });
    for quantity in ["drawbar_pull_n", "sinkage_mm", "torque_nm"] {
        for word in ["rmse", "bias", "r2", "repeatability"] {
            let [ours, imported] = [&ours, &imported].map(|it| number(&it[quantity][word]));
            // Slips and angles went there and back, each time to the last bit or so.
            assert!((ours - imported).abs() < 1e-9, "{quantity}: {word} {ours} {imported}");
        }
    }
    assert_eq!(imported["side_force_n"], Value::Null);
}

#[test]
fn an_import_goes_to_the_standard_output_and_says_what_is_in_it() {
    let place = Place::new();
    place.write("lab.csv", "Fx [kN],slip,W,operator\n0.0012,20,24.5,me\n0.0015,40,24.5,me\n");
    let columns = ["drawbar_pull_n=Fx [kN]:kN", "slip_ratio=slip:%", "load_n=W"];
    let flags: Vec<&str> = columns.iter().flat_map(|column| ["--column", *column]).collect();
    let answer = place.run(&[&["import", "lab.csv"][..], &flags].concat());
    assert_eq!(answer.code(), 0);
    assert_snapshot!("import", answer.conversation());
}

#[test]
fn an_old_file_stays_unless_forced() {
    let place = Place::new();
    place.write("lab.csv", "slip_ratio,load_n,sinkage_mm\n0.1,20,5\n");
    place.write("mine.csv", "mine");
    let answer = place.line("import lab.csv --out mine.csv");
    assert!(answer.stderr.contains("--force"), "{}", answer.stderr);
    check_is_refusal(&answer, 2);
    assert_eq!(place.read("mine.csv"), "mine");
    assert_eq!(place.line("import lab.csv --out mine.csv --force").code(), 0);
    assert_eq!(place.read("mine.csv"), "slip_ratio,load_n,sinkage_mm\n0.1,20,5\n");
    assert_eq!(place.names(), ["lab.csv", "mine.csv"]);
}

#[test]
fn wrong_imports() {
    let place = Place::new();
    place.write("lab.csv", "Fx,slip,W\n1.2,0.2,24\n");
    place.write("words.csv", "slip_ratio,load_n,sinkage_mm\n0.2,24,deep\n");
    place.write("comma.csv", "slip_ratio;load_n;sinkage_mm\n0,2;24;5\n");
    place.write("percent.csv", "slip_ratio,load_n,sinkage_mm\n20,24,5\n");
    place.write("header.csv", "slip_ratio,load_n,sinkage_mm\n");
    place.write("empty.csv", "");
    check_refused(
        "imports",
        &place,
        &[
            &["import"],
            &["import", "none.csv"],
            &["import", "."],
            &["import", "lab.csv"],
            &["import", "lab.csv", "--column", "drawbar=Fx"],
            &["import", "lab.csv", "--column", "drawbar_pull_n=Fx:mm"],
            &["import", "lab.csv", "--column", "drawbar_pull_n"],
            &["import", "lab.csv", "--column", "drawbar_pull_n=Fz"],
            &["import", "lab.csv", "--column", "drawbar_pull_n=Fx", "--column", "load_n=W"],
            &["import", "lab.csv", "--delimiter", ";;"],
            &["import", "lab.csv", "--slip-definition", "wheel"],
            &["import", "lab.csv", "--force"],
            &["import", "words.csv"],
            &["import", "comma.csv"],
            &["import", "comma.csv", "--delimiter", ";"],
            &["import", "percent.csv"],
            &["import", "header.csv"],
            &["import", "empty.csv"],
        ],
    );
}

/// A limit on the size of files stands in for a full disk.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_no_imported_file() {
    let place = Place::new();
    let rows: String = (0..200).map(|row| format!("0.{row:03},20,5\n")).collect();
    place.write("lab.csv", format!("slip_ratio,load_n,sinkage_mm\n{rows}"));
    let answer = place.shell("ulimit -f 1; grouser import lab.csv --out ours.csv");
    assert_eq!(answer.code(), 1, "{}", answer.stderr);
    assert!(answer.stderr.contains("error: cannot write ours.csv"), "{}", answer.stderr);
    assert_eq!(place.names(), ["lab.csv"]);
}

/// A log has the rover as URDF, wheels on sliding joints: it comes back with the masses, places and
/// wheels of its document.
#[test]
fn urdf_of_a_log_comes_back_as_its_rover() {
    let place = Place::new();
    place.line("traverse --duration-s 1 --mcap run.mcap");
    let log = std::fs::read(place.file("run.mcap")).expect("a log");
    let find = |what: &[u8]| log.windows(what.len()).position(|it| it == what).expect("it");
    let (start, end) = (find(b"<?xml"), find(b"</robot>") + b"</robot>".len());
    place.write("rover.urdf", &log[start..end]);
    let answer = place.line("import-urdf rover.urdf --out back.toml");
    assert_eq!(answer.code(), 0, "{}", answer.stderr);
    assert!(answer.stderr.contains("wheels: front-left_rim") && answer.stderr.contains("slides"));
    let back = place.read("back.toml");
    for expected in ["mass_kg = 5.24", "mass_kg = 0.422", "radius_m = 0.1,", "width_m = 0.08"] {
        assert!(back.contains(expected), "{expected}: {back}");
    }
    assert!(back.contains("position_m = [0.19, 0.24, -0.06]"), "{back}");
    assert_eq!(place.line("check back.toml").code(), 0);
    assert_eq!(place.line("import-urdf rover.urdf --out back.toml").code(), 2);
    let printed = place.line("import-urdf rover.urdf --wheels *_rim");
    assert!(printed.stdout.starts_with("schema = \"rover/1\""), "{}", printed.stderr);
    let run = place.json("traverse --rover back.toml --duration-s 2");
    assert_eq!(run["outcome"], "completed");
}

#[test]
fn urdf_that_is_no_rover_is_refused() {
    let place = Place::new();
    place.write("arm.urdf", "<robot name=\"arm\"><link name=\"base\"/></robot>");
    place.write("bytes.urdf", [0xff_u8, 0xfe]);
    for (line, expected) in [
        ("import-urdf none.urdf", "no such file"),
        ("import-urdf bytes.urdf", "not a text"),
        ("import-urdf arm.urdf", "--wheels LINK"),
        ("import-urdf arm.urdf --wheel-radius-m 0", "above 0"),
        ("import-urdf arm.urdf --rigid --differential", "cannot be used with"),
        ("import-urdf arm.urdf --wheels tyre", "no link is called tyre"),
        ("import-urdf arm.urdf --force", "--out"),
    ] {
        let refused = check_is_refusal(&place.line(line), 2);
        assert!(refused.contains(expected), "{line}: {refused}");
    }
}

/// A rover whose wheels are meshes: the file is found by its package, beside the URDF or above it;
/// without it the hint names the flags. The guess is a table.
#[test]
fn wheels_of_meshes_are_found_by_their_package() {
    let place = Place::new();
    let inertial = "<inertial><mass value=\"0.5\"/><inertia ixx=\"0.002\" iyy=\"0.002\" izz=\"0.002\"/></inertial>";
    let shape = "<collision><geometry><mesh filename=\"package://cart/meshes/wheel.stl\"/></geometry></collision>";
    let body = inertial.replace("0.5", "6");
    let wheel = |(name, x, y): (&str, f64, f64)| {
        format!(
            "<link name=\"{name}\">{inertial}{shape}</link><joint name=\"{name}_joint\" \
             type=\"continuous\"><parent link=\"body\"/><child link=\"{name}\"/>\
             <origin xyz=\"{x} {y} -0.1\"/><axis xyz=\"0 1 0\"/></joint>"
        )
    };
    let places = [("fl", 0.2, 0.2), ("fr", 0.2, -0.2), ("rl", -0.2, 0.2), ("rr", -0.2, -0.2)];
    let wheels: String = places.into_iter().map(wheel).collect();
    let urdf = format!("<robot name=\"cart\"><link name=\"body\">{body}</link>{wheels}");
    std::fs::create_dir_all(place.file("cart/urdf")).expect("a folder");
    place.write("cart/urdf/cart.urdf", urdf + "</robot>");
    let line = "import-urdf cart/urdf/cart.urdf --out cart.toml";
    let refused = check_is_refusal(&place.line(line), 2);
    assert!(refused.contains("--wheel-radius-m") && refused.contains("link fl"), "{refused}");
    let given = place.line(&format!("{line} --wheel-radius-m 0.1 --wheel-width-m 0.05"));
    assert_eq!(given.code(), 0, "{}", given.stderr);
    assert!(place.read("cart.toml").contains("radius_m = 0.1, width_m = 0.05"));
    std::fs::create_dir_all(place.file("cart/meshes")).expect("a folder");
    place
        .write("cart/meshes/wheel.stl", "solid\nvertex -0.09 -0.03 -0.09\nvertex 0.09 0.03 0.09\n");
    let found = place.line(&format!("{line} --force"));
    assert_eq!(found.code(), 0, "{}", found.stderr);
    let row = found.stderr.lines().find(|line| line.starts_with("fl ")).expect("a row");
    assert!(row.contains("fl_joint") && row.contains("0.09") && row.contains("0.06"), "{row}");
    assert!(found.stderr.starts_with("wheel  joint     radius [m]"), "{}", found.stderr);
    assert!(place.read("cart.toml").contains("radius_m = 0.09, width_m = 0.06"));
}
