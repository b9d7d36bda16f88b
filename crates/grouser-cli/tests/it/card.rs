//! `card`: the operator's page, its numbers and its files.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde_json::Value;

use crate::program::{Place, changed_preset, number};

/// An uncertain soil, with draws enough to tell go from no-go.
const UNCERTAIN: &str = "card --soil toyoura-uncertain --samples 20";

/// One on which only the soil is uncertain, which takes a tenth of the time: for flags that have
/// nothing to do with models.
const OF_ONE_MODEL: &str = "card --soil toyoura-uncertain --samples 20 --model ishigami";

/// Its card, made once for all tests that only read it.
static CARD: LazyLock<Card> = LazyLock::new(|| {
    let place = Place::new();
    let answer = place.json(&format!("{UNCERTAIN} --out card"));
    let files = std::fs::read_dir(place.file("card")).expect("a folder").map(|entry| {
        let entry = entry.expect("an entry");
        let bytes = std::fs::read(entry.path()).expect("a file");
        (entry.file_name().to_string_lossy().into_owned(), bytes)
    });
    Card { answer, files: files.collect() }
});

/// The numbers of a card, and the files of its folder.
struct Card {
    answer: Value,
    files: BTreeMap<String, Vec<u8>>,
}

impl Card {
    fn text(&self, name: &str) -> String {
        String::from_utf8(self.files[name].clone()).expect("UTF-8")
    }
}

fn rows(answer: &Value) -> &Vec<Value> {
    answer["rows"].as_array().expect("rows")
}

fn row(answer: &Value, slope_deg: f64) -> &Value {
    let is_it = |row: &&Value| number(&row["slope_deg"]) == slope_deg;
    rows(answer).iter().find(is_it).expect("the slope is on the card")
}

/// What a person could read on an SVG page, line by line.
fn texts(svg: &str) -> Vec<String> {
    let parts = svg.split("fill-opacity=\"0\">").skip(1);
    parts.map(|part| part.split_once('<').expect("the element ends").0.to_owned()).collect()
}

/// The limits of a card are a mission's: the lowest slip limit of the slopes that are a go or a
/// caution, and the steepest of these.
#[test]
fn a_mission_reads_the_limits_of_a_card() {
    let place = Place::new();
    let card = place.json(&format!("{UNCERTAIN} --stops stops.toml"));
    let stops = place.read("stops.toml");
    assert_eq!(stops, CARD.text("stops.toml"));
    let is_driven = |row: &&Value| ["go", "caution"].contains(&row["verdict"].as_str().unwrap());
    let driven: Vec<&Value> = rows(&card).iter().take_while(is_driven).collect();
    let slips = driven.iter().map(|row| number(&row["slip_limit"]));
    place.write(
        "m.toml",
        "schema = \"mission/1\"\nname = \"m\"\nslope_deg = 5.0\nstop_from = \"stops.toml\"\n\
         [[leg]]\ndrive_m = 1.0\nyaw_deg = 2.0\n",
    );
    place.results("check m.toml");
    let mission = place.json("mission m.toml --nominal");
    let limits = &mission["inputs"]["mission"]["stop"];
    let above = |key: &str| number(&limits[key]["above"]);
    let lowest = slips.fold(f64::INFINITY, f64::min);
    assert!(above("slip_ratio") <= lowest && lowest < above("slip_ratio") + 1e-4, "{limits}");
    let steepest = number(&driven.last().expect("a go")["slope_deg"]);
    assert_eq!((above("roll_deg"), above("pitch_deg")), (steepest, steepest));
    assert_eq!(above("drift_m_per_m"), 0.1);
    assert_eq!(mission["outcome"], "completed");
    let over = "mission m.toml --nominal --slope-deg 25 --set mission.leg.0.yaw_deg=0";
    assert_eq!(place.json(over)["outcome"], "stopped");
    // A mission on one slope has that slope's limit of the slip.
    let slope = number(&driven[1]["slope_deg"]);
    place.json(&format!("{UNCERTAIN} --stops one.toml --stops-slope-deg {slope}"));
    place.json("mission m.toml --nominal --set mission.stop_from=one.toml --out one");
    let own = number(&driven[1]["slip_limit"]);
    let one = place.read("one/mission.toml");
    let line = format!("above = {}", (own * 1e4 + 1e-6).floor() / 1e4);
    assert!(own > lowest && one.contains(&line), "{line}: {one}");
    let steep = place.line(&format!("{UNCERTAIN} --stops two.toml --stops-slope-deg 60"));
    assert!(steep.stderr.contains("--stops-slope-deg 60: this card has no go"), "{}", steep.stderr);
    let answer = place.line(&format!("{UNCERTAIN} --stops stops.toml"));
    assert_eq!(answer.code(), 2, "it is not replaced: {}", answer.stderr);
    let unknown = place.line("card --samples 2 --stops none.toml");
    assert!(
        unknown.code() == 1 && unknown.stderr.contains("--stops: no slope"),
        "{}",
        unknown.stderr
    );
    assert!(!place.file("none.toml").exists());
}

/// The paper's word for heading is attitude: its command knows nothing of cards.
#[test]
fn numbers_are_those_of_the_attitude() {
    let place = Place::new();
    let card = &CARD.answer;
    let attitude = place
        .json("attitude --soil toyoura-uncertain --slope-deg 5,13,17 --uncertainty --samples 20");
    for expected in rows(&attitude) {
        let row = row(card, number(&expected["slope_deg"]));
        assert_eq!(row["yaw_deg_as_written"], expected["yaw_deg_as_written"]);
        for suffix in ["", "_p2_5", "_p50", "_p97_5"] {
            let key = format!("slip_ratio{suffix}");
            assert_eq!(row[&key], expected[&key], "{key}");
        }
        for key in ["yaw_deg_p2_5", "yaw_deg_p50", "yaw_deg_p97_5", "verdict", "reason"] {
            assert_eq!(row[key], expected[key], "{key}");
        }
        assert_eq!(row["yaw_deg"], row["yaw_deg_p50"]);
        assert_eq!(row["probability_level"], expected["probability_level"]);
        // Work per metre is power over speed: P = E v (1 - s)/cos γ along the contour.
        let (energy, slip) = (number(&expected["energy_j_per_m"]), number(&row["slip_ratio"]));
        let way = 0.06 * (1.0 - slip) / number(&expected["yaw_deg_as_written"]).to_radians().cos();
        assert!((number(&row["power_w"]) - energy * way).abs() < 1e-12);
    }
}

/// What a driver needs is there on every slope that may be driven, and no number is infinite.
#[test]
fn rows_have_what_a_driver_needs() {
    let answer = &CARD.answer;
    for row in rows(answer) {
        let verdict = row["verdict"].as_str().expect("a verdict");
        assert!(row["flags"].is_array() && ["go", "caution", "no_go"].contains(&verdict));
        let is_driven = verdict != "no_go";
        for key in [
            "correct_every_m",
            "heading_fall_deg_per_m_p50",
            "drift_m_per_m_p97_5",
            "torque_nm_p97_5",
        ] {
            assert_eq!(row[key].is_number(), is_driven, "{key} of {row}");
        }
        if !is_driven {
            continue;
        }
        let angle = |key: &str| number(&row[key]).to_radians();
        let upright = angle("roll_deg").cos() * angle("pitch_deg").cos();
        assert!((upright - angle("slope_deg").cos()).abs() < 1e-12, "{row}");
        assert!(angle("pitch_deg") >= 0.0 && angle("yaw_deg") >= 0.0);
        assert!(number(&row["correct_every_m"]) > 0.0);
        // The nose falls downhill, and the rims go farther than the rover.
        assert!(number(&row["heading_fall_deg_per_m_p50"]) >= 0.0, "{row}");
        assert!(number(&row["rim_way_m_per_m_p97_5"]) > 1.0);
        assert_eq!(row["yaw_deg_ishigami"], row["yaw_deg_as_written"]);
    }
    let heading =
        Place::new().json("heading --soil toyoura-uncertain --model rft --slope-deg 13 --nominal");
    let row = row(answer, 13.0);
    assert_eq!(row["yaw_deg_rft"], rows(&heading)[0]["yaw_deg"]);
    assert!(row["yaw_deg_small_wheel"].is_number() && row["yaw_deg_ishigami"].is_number());
}

/// It said GO on 45° of a sand of 28°.
#[test]
fn the_moon_is_no_place_to_go_45_degrees_steep() {
    let place = Place::new();
    let line = "card --soil dry-sand --rover hakuto --gravity-m-s2 moon --samples 3";
    let answer = place.json(line);
    // Nothing states how uncertain that soil is: priors do not count.
    assert!(rows(&answer).iter().all(|row| row["verdict"] != "go"));
    place.write("soil.toml", stated("dry-sand"));
    let line = line.replace("dry-sand", "soil.toml");
    // Bekker's moduli of the Earth do not hold there.
    let on_moon = place.json(&line);
    assert_eq!(row(&on_moon, 5.0)["reason"], "outside_domain");
    assert!(rows(&on_moon).iter().all(|row| row["verdict"] != "go"));
    let answer = place.json(&line.replace("moon", "earth"));
    let goes = rows(&answer).iter().filter(|row| row["verdict"] == "go");
    let steepest = goes.map(|row| number(&row["slope_deg"])).fold(-1.0, f64::max);
    assert!((0.0..=23.0).contains(&steepest), "{steepest}");
}

/// A preset with a stated uncertainty.
fn stated(soil: &str) -> String {
    let text = changed_preset("soil", soil, "name ", "name ");
    format!(
        "{text}\n[[uncertainty.parameter]]\nkey = \"friction_angle_deg\"\nstandard_deviation = 0.5\n"
    )
}

/// For a slope of 12° the page has one line with the slope, the heading and the heading's band.
#[test]
fn the_page_says_what_it_must() {
    let texts = texts(&CARD.text("card.svg"));
    let row = row(&CARD.answer, 12.0);
    let [heading, low, high] =
        ["yaw_deg", "yaw_deg_p2_5", "yaw_deg_p97_5"].map(|key| number(&row[key]));
    assert!(high - low > 4.0, "whole degrees are all that this band carries");
    let slope = texts.iter().position(|text| text == "12°").expect("the slope");
    let every = number(&row["correct_every_m"]);
    let half = |key: &str| (number(&row[key]) * 2.0).round() / 2.0;
    let expected = [
        format!("{heading:.0}°"),
        format!("{:.0} to {:.0}°", low.floor(), high.ceil()),
        format!("{:.0}", number(&row["roll_deg"])),
        format!("{} to {}", half("pitch_least_deg"), half("pitch_most_deg")),
        format!("{}", (every * 100.0).round() / 100.0),
    ];
    assert_eq!(texts[slope + 1..slope + 6], expected);
    let all = texts.join("\n");
    for part in [
        "HAKUTO on Toyoura sand, uncertain",
        "GO\n",
        "CAUTION",
        "NO-GO",
        "at least 95 % of 20 samples",
        "in 20 % of them or more",
        "The nose falls: correct, set it again",
        "the nose is too far uphill",
        "To be made anew",
        "page 1 of 2",
        "STOP IF ABOVE",
        "DATE OF THE SOIL: NOT STATED",
        "Gravity 9.807 m/s² (earth)",
        "6 cm/s",
        "mechanical",
        "Holds for",
        "Leaves out",
        "Assumed",
        "Uphill on the left or on the right",
        "20 samples, seed 1",
        "Card no.",
        "Signature",
        "Superseded by",
        &format!("grouser {}", env!("CARGO_PKG_VERSION")),
    ] {
        let is_there = all.contains(part) || all.replace('\n', " ").contains(part);
        assert!(is_there, "{part} is missing in\n{all}");
    }
    let slopes = texts.iter().filter(|text| text.ends_with('°') && text.len() <= 4);
    // Slopes and headings stand in large digits.
    assert!(slopes.count() <= 2 * 16);
}

/// Seven points, at arm's length.
#[test]
fn no_letter_of_the_page_is_small() {
    let place = Place::new();
    place.results("card --samples 2 --soil dry-sand --out card.svg");
    let svg = place.read("card.svg");
    let sizes = svg.split("font-size=\"").skip(1).map(|rest| {
        rest.split_once('"').expect("the attribute ends").0.parse::<f64>().expect("a size in mm")
    });
    let smallest = sizes.fold(f64::INFINITY, f64::min);
    assert!((2.47..10.0).contains(&smallest), "{smallest}");
}

#[test]
fn without_stated_uncertainty_the_page_says_so_and_has_no_band() {
    let place = Place::new();
    let table = place.results("card --model ishigami --set soil.priors=none --out card.svg");
    assert!(
        table.contains("no uncertainty of this soil is stated: no bands; nobody can tell a go")
    );
    let texts = texts(&place.read("card.svg")).join("\n");
    assert!(texts.contains("NOT STATED: no bands") && texts.contains("CANNOT TELL"));
    assert!(!texts.contains("95 %") && !texts.contains("STOP IF ABOVE"));
    let json = place.json("card --model ishigami --set soil.priors=none");
    assert!(rows(&json).iter().all(|row| row["yaw_deg_p50"].is_null() && row["draws"].is_null()));
    assert!(rows(&json).iter().all(|row| row["verdict"] != "go"));
}

/// Where only the models are uncertain, the bands are theirs, and no slope is a go.
#[test]
fn models_alone_have_bands_and_no_go() {
    let place = Place::new();
    let line = "card --samples 30 --soil simulant-2007 --set soil.priors=none";
    let table = place.results(&format!("{line} --out card.svg"));
    assert!(table.contains("bands are of the models alone; nobody can tell a go"));
    let texts = texts(&place.read("card.svg")).join("\n");
    assert!(texts.contains("NOT STATED: bands") && texts.contains("rft 18"), "{texts}");
    let card = place.json(line);
    let row = row(&card, 10.0);
    let models = place.json(
        "heading --soil simulant-2007 --set soil.priors=none --slope-deg 10 --model all --nominal",
    );
    for word in ["yaw_deg", "slip_ratio"] {
        let of_spread = rows(&models).iter().filter(|row| row["model"] != "bekker");
        let values: Vec<f64> = of_spread.map(|row| number(&row[word])).collect();
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = values.iter().copied().fold(0.0, f64::max);
        let ends = ["p2_5", "p97_5"].map(|end| number(&row[format!("{word}_{end}")]));
        assert_eq!((values.len(), ends), (3, [least, most]));
    }
}

/// Six wheels are drawn as six, four as four.
#[test]
fn the_rover_is_drawn_as_it_is() {
    let place = Place::new();
    let four = changed_preset("rover", "hakuto", "", "");
    let middle = |side: &str, y: f64| {
        format!("\n[[mount]]\nname = \"middle-{side}\"\nposition_m = [0.0, {y}, -0.06]\n")
    };
    place.write("six.toml", format!("{four}{}{}", middle("left", 0.24), middle("right", -0.24)));
    place.write("four.toml", four);
    let wheels = |rover: &str| {
        let line = "card --samples 2 --model ishigami --set soil.priors=none --rover";
        place.results(&format!("{line} {rover}.toml --out {rover}.svg"));
        let svg = place.read(&format!("{rover}.svg"));
        // Arrows have three corners, wheels four, and none of them is upright as the bars of the
        // table are.
        let areas = svg.lines().filter(|line| line.contains("Z\" fill=\"#000000\""));
        let has_four = |line: &&str| line.matches('L').count() == 3;
        let is_upright = |line: &&str| {
            let path = line.split("d=\"M").nth(1).expect("a path");
            let height = |point: &str| point.split(' ').nth(1).map(str::to_owned);
            let mut points = path.split('L');
            points.next().and_then(height) == points.next().and_then(height)
        };
        areas.filter(has_four).filter(|line| !is_upright(line)).count()
    };
    assert_eq!(wheels("six"), wheels("four") + 2);
}

#[test]
fn the_day_of_the_soil_is_on_the_page() {
    let place = Place::new();
    let dated =
        |day: &str| changed_preset("soil", "toyoura", "name ", &format!("date = \"{day}\"\nname "));
    place.write("soil.toml", dated("2026-11-20"));
    place.results("card --samples 4 --soil soil.toml --out card.svg");
    assert!(texts(&place.read("card.svg")).join("\n").contains("Date of the soil: 2026-11-20"));
    for day in ["2026-02-29", "20.11.2026", "yesterday", "2026-13-01"] {
        place.write("soil.toml", dated(day));
        let answer = place.line("card --samples 4 --soil soil.toml");
        assert_eq!(answer.code(), 2, "{day}");
        assert!(answer.stderr.contains("soil.toml:") && answer.stderr.contains("date"));
    }
}

#[test]
fn flags_change_the_verdicts_and_the_rule_on_the_page() {
    let place = Place::new();
    let last_go = |answer: &Value| {
        let goes = rows(answer).iter().filter(|row| row["verdict"] == "go");
        goes.map(|row| number(&row["slope_deg"])).fold(0.0, f64::max)
    };
    let with = |flag: &str| last_go(&place.json(&format!("{OF_ONE_MODEL} {flag}")));
    let usual = with("");
    assert!(with("--go-slip-ratio 0.15") < usual);
    assert!(with("--go-probability 0.8") > usual);
    let strict = "--no-go-probability 0.1 --no-go-slip-ratio 0.4";
    place.results(&format!("{OF_ONE_MODEL} {strict} --out card.svg"));
    let texts = texts(&place.read("card.svg")).join("\n");
    assert!(texts.contains("10 % of them or more no heading does so with slip up to 40 %"));
}

/// The file's name says which form; what is there stays there.
#[test]
fn files_are_what_their_names_say_and_are_not_replaced() {
    let place = Place::new();
    for (name, start) in [
        ("card.svg", b"<svg".as_slice()),
        ("card.pdf", b"%PDF-"),
        ("card.png", b"\x89PNG"),
        ("card.html", b"<!doctype html>"),
    ] {
        let line = format!("card --samples 2 --model ishigami --out {name}");
        place.results(&line);
        let bytes = std::fs::read(place.file(name)).expect("it is written");
        assert!(bytes.starts_with(start), "{name}");
        let again = place.line(&line);
        assert!(again.code() == 2 && again.stderr.contains("--force"), "{}", again.stderr);
        place.results(&format!("{line} --force"));
        assert_eq!(std::fs::read(place.file(name)).expect("it is written"), bytes, "{name}");
    }
    let other = place.line("card --out card.docx");
    assert!(other.code() == 2 && other.stderr.contains(".pdf"), "{}", other.stderr);
    // Pictures have one for each page.
    assert_eq!(place.names().len(), 6);
}

/// A folder is enough to make the card again, with the same bytes.
#[test]
fn a_folder_has_all_forms_and_its_documents_make_the_same_card() {
    let names: Vec<&str> = CARD.files.keys().map(String::as_str).collect();
    let expected = [
        "card-2.png",
        "card-2.svg",
        "card.csv",
        "card.html",
        "card.json",
        "card.pdf",
        "card.png",
        "card.svg",
        "courses.csv",
        "report.html",
        "scenario.toml",
        "stops.toml",
    ];
    assert_eq!(names, expected);
    let place = Place::new();
    place.write("scenario.toml", CARD.text("scenario.toml"));
    place.results("card scenario.toml --samples 20 --out again");
    for name in expected {
        let again = std::fs::read(place.file("again").join(name)).expect("a file");
        assert!(CARD.files[name] == again, "{name}");
    }
}

#[test]
fn measured_yaws_are_placed_beside_the_band() {
    let place = Place::new();
    place.write("yaws.csv", "slope_deg,start_yaw_deg,end_yaw_deg\n5,0.1,2\n7.5,30,\n15,30,\n");
    let answer = place.json(&format!("{OF_ONE_MODEL} --measured yaws.csv"));
    let measured = answer["measured"].as_array().expect("records");
    let seen: Vec<(f64, &str, &str)> = measured
        .iter()
        .map(|record| {
            let word = |key: &str| record[key].as_str().expect("a word");
            (number(&record["slope_deg"]), word("measured"), word("place"))
        })
        .collect();
    // On 15° the band has no upper end: on some soils no heading holds the contour.
    let expected = [
        (5.0, "start_yaw", "below"),
        (5.0, "end_yaw", "inside"),
        (7.5, "start_yaw", "above"),
        (15.0, "start_yaw", "inside"),
    ];
    assert_eq!(seen, expected);
    for (content, part) in [
        ("yaw_deg\n1\n", "slope_deg"),
        ("slope_deg\n1\n", "yaw_deg"),
        ("slope_deg,yaw_deg\n5,much\n", "yaws.csv:2: "),
        ("slope_deg,yaw_deg\n95,1\n", "0 to 60"),
    ] {
        place.write("yaws.csv", content);
        let answer = place.line("card --samples 4 --measured yaws.csv");
        assert_eq!(answer.code(), 2, "{content}");
        assert!(answer.stderr.contains(part), "{}", answer.stderr);
    }
    assert_eq!(place.line("card --measured nowhere.csv").code(), 2);
}

/// A rover that is no mirror image of itself has two cards, and each says whose it is.
#[test]
fn a_lopsided_rover_has_a_card_for_each_side() {
    let place = Place::new();
    let text = changed_preset("rover", "hakuto", "0.24", "0.30");
    place.write("rover.toml", text);
    let line = "card --samples 2 --rover rover.toml --out";
    let [left, right] = ["left.svg", "right.svg --uphill right"].map(|side| {
        number(&row(&place.json(&format!("{line} {side}")), 10.0)["yaw_deg_as_written"])
    });
    assert!(texts(&place.read("left.svg")).join("\n").contains("rover's LEFT"));
    assert!(texts(&place.read("right.svg")).join("\n").contains("rover's RIGHT"));
    assert!((left - right).abs() > 1e-3);
}

/// Where the rover cannot even drive on level ground the card is a single no-go.
#[test]
fn a_rover_that_cannot_move_has_a_card_that_forbids_it() {
    let place = Place::new();
    let slick = "--set soil.friction_angle_deg=5 --set soil.exit.ratio=0";
    place.results(&format!("card --samples 4 {slick} --out card.svg"));
    let texts = texts(&place.read("card.svg")).join("\n");
    assert!(texts.contains("NO-GO   on any slope"), "{texts}");
}

/// Nobody sets a nose again that the rover holds; the card says so.
#[test]
fn a_rover_that_holds_its_heading_is_not_corrected() {
    let place = Place::new();
    let line = "card --soil toyoura-uncertain --samples 12 --out held.svg";
    let (free, held) = (place.json(line), place.json(&format!("{line} --holds-heading --force")));
    let said = [&free, &held].map(|answer| answer["inputs"]["holds_heading"].as_bool());
    assert_eq!(said, [Some(false), Some(true)]);
    for slope_deg in [5.0, 10.0] {
        let (free, held) = (row(&free, slope_deg), row(&held, slope_deg));
        assert!(held["correct_every_m"].is_null() && held["heading_fall_deg_per_m_p50"].is_null());
        assert!(free["correct_every_m"].is_number());
        // The heading does not depend on who holds it.
        assert_eq!(free["yaw_deg"], held["yaw_deg"]);
    }
    // Where the nose falls fast, a rover that holds it drifts less.
    let drift = |answer: &Value| number(&row(answer, 10.0)["drift_m_per_m_p97_5"]);
    assert!(drift(&held) < drift(&free), "{} and {}", drift(&held), drift(&free));
    let texts = texts(&place.read("held.svg"));
    assert!(texts.iter().any(|text| text == "itself"));
    assert!(texts.join(" ").contains("The rover holds the heading by itself."));
}

/// The second page: where to look at the slip, and a verdict for every course on each of the first
/// page's slopes.
#[test]
fn the_second_page_leads_out() {
    let [first, second] = ["card.svg", "card-2.svg"].map(|name| texts(&CARD.text(name)));
    let answer: Value = serde_json::from_str(&CARD.text("card.json")).expect("it is JSON");
    let courses = answer["courses"].as_array().expect("courses");
    let slopes: Vec<&String> = first.iter().filter(|text| is_slope(text)).collect();
    // Headings are as large as slopes, on the first page alone.
    let of_second: Vec<&String> = second.iter().filter(|text| is_slope(text)).collect();
    assert!(of_second.len() > 4 && of_second.iter().all(|slope| slopes.contains(slope)));
    let all = second.join("\n");
    for part in [
        "page 2 of 2",
        "SLIP CHECK",
        "REAR UPHILL",
        "at most 0.5 % of ways of 10 m",
        "mechanical",
        "DATE OF THE SOIL: NOT STATED",
        "Superseded by",
    ] {
        assert!(all.contains(part), "{part} is missing in\n{all}");
    }
    for course in ["up", "back-down", "down", "back-up", "back-across", "turn", "turn-on-the-spot"]
    {
        let of_course: Vec<&Value> = courses.iter().filter(|it| it["course"] == course).collect();
        assert!(!of_course.is_empty(), "{course}");
        for row in of_course {
            let is_driven = row["verdict"] != "no_go";
            assert!(!is_driven || row["slip_ratio_p97_5"].is_number(), "{row}");
        }
    }
    for row in rows(&answer).iter().filter(|row| row["verdict"] != "no_go") {
        let limit = number(&row["slip_limit"]);
        assert!(limit > 0.0 && limit <= 0.4, "{row}");
        assert!(number(&row["probability_stuck"]) <= 0.005 || row["slip_check_every_m"].is_null());
    }
}

fn is_slope(text: &str) -> bool {
    text.ends_with('°') && text.len() <= 4
}

/// PDF and HTML have both pages, and letters of the second are as large as those of the first.
#[test]
fn both_pages_are_printed() {
    let place = Place::new();
    place.results("card --samples 2 --soil dry-sand --out card");
    let file = |name: &str| std::fs::read(place.file("card").join(name)).expect("a file");
    let pdf = file("card.pdf");
    let has = |part: &[u8]| pdf.windows(part.len()).any(|window| window == part);
    assert!(has(b"/Count 2"));
    let html = String::from_utf8(file("card.html")).expect("text");
    assert_eq!(html.matches("<svg").count(), 2);
    let svg = String::from_utf8(file("card-2.svg")).expect("text");
    let sizes = svg.split("font-size=\"").skip(1).map(|rest| {
        rest.split_once('"').expect("the attribute ends").0.parse::<f64>().expect("a size in mm")
    });
    assert!(sizes.fold(f64::INFINITY, f64::min) >= 2.47);
}

/// Other soils, driven by the card on time and late.
#[test]
fn drives_are_told_beside_what_the_card_states() {
    let place = Place::new();
    let line = "card --soil toyoura-uncertain --samples 8 --model ishigami --drives 6";
    let answer = place.json(line);
    assert_eq!(answer["inputs"]["seed_of_drives"], 2);
    let drives = answer["drives"].as_array().expect("drives");
    let of = |lateness: f64| -> Vec<&Value> {
        drives.iter().filter(|it| number(&it["lateness"]) == lateness).collect()
    };
    let (on_time, late) = (of(1.0), of(2.0));
    assert!(on_time.len() == late.len() && on_time.len() > 4);
    for (row, late) in on_time.iter().zip(&late) {
        assert_eq!((&row["slope_deg"], number(&row["drives"])), (&late["slope_deg"], 6.0));
        let stated = self::row(&answer, number(&row["slope_deg"]));
        assert_eq!(row["stated_drift_m_per_m"], stated["drift_m_per_m_p97_5"]);
        assert_eq!(row["verdict"], stated["verdict"]);
        assert!(number(&row["distance_m"]) >= 10.0 - 1e-9);
    }
}

/// What a driver keeps to on 13° (the step that was missing said: it goes straight across the
/// slope).
#[test]
fn an_uncorrected_traverse_ends_low_with_its_nose_down_and_the_card_says_to_correct() {
    let place = Place::new();
    let line = "traverse --slope-deg 13 --yaw-deg 6.863 --load-transfer quasi-static-torque \
                --duration-s 167 --set soil.priors=none";
    let end = &place.json(line)["final"];
    assert!(
        (number(&end["y_m"]) + 1.47).abs() < 0.01 && (number(&end["yaw_deg"]) + 9.7).abs() < 0.1,
        "{end}"
    );
    let answer = place
        .json("card --load-transfer quasi-static-torque --model ishigami --set soil.priors=none");
    // Over that way the nose fell by 16.5°: by 2° it may fall until it is set again.
    let way = number(&end["x_m"]).hypot(number(&end["y_m"]));
    let fall = (6.863 - number(&end["yaw_deg"])) / way;
    assert!(number(&row(&answer, 13.0)["correct_every_m"]) <= 2.0 / fall);
}
