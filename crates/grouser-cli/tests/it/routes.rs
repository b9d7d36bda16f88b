//! Routes: found, checked by simulation, driven as missions, and refused with a reason.

use serde_json::{Value, json};

use crate::maps::heights;
use crate::program::{Place, number};

/// A ridge across the map with a pass in the north, too steep to be crossed elsewhere.
fn ridge(x: f64, y: f64) -> f64 {
    let height = if y > 7.0 { 0.0 } else { (7.0 - y).min(2.0) };
    height * (-((x - 7.0) / 1.2).powi(2)).exp()
}

/// Length to the middle of a piece.
fn along(piece: &Value) -> f64 {
    number(&piece["along_m"])
}

fn places(route: &Value) -> Vec<[f64; 2]> {
    let list = route["waypoints"].as_array().expect("waypoints").iter();
    list.map(|place| [number(&place[0]), number(&place[1])]).collect()
}

#[test]
fn a_route_goes_around_and_can_be_driven() {
    let place = Place::new();
    place.write("ridge.xyz", heights(ridge));
    let line = "route ridge.xyz --from 7002,-298 --to 7010.5,-298 --samples 2 --alternatives \
                --no-drive --out out";
    let route = place.json(line);
    assert_eq!(route["status"], "found");
    let way = places(&route);
    assert_eq!((way[0], way[way.len() - 1]), ([7002.0, -298.0], [7010.5, -298.0]));
    assert!(way.iter().any(|[_, y]| *y > -294.5), "{way:?}");
    let straight = number(&route["straight_m"]);
    assert!(number(&route["length_m"]) > 1.2 * straight);
    let named: Vec<&Value> = route["alternatives"].as_array().unwrap().iter().collect();
    assert_eq!(named.iter().map(|it| &it["minimise"]).collect::<Vec<_>>(), ["energy", "risk"]);
    assert!(named.iter().all(|it| number(&it["time_s"]) >= 0.999 * number(&route["time_s"])));
    // First how probably it is completed, and the worst verdict.
    let sentence = route["sentence"].as_str().expect("a sentence");
    assert!(sentence.starts_with("Completed on "), "{sentence}");
    assert!((0.0..=1.0).contains(&number(&route["probability_completed"])), "{route}");
    assert_ne!(route["verdict"], "no_go");
    let page = place.read("out/report.html");
    let first = page.find(sentence).expect("the sentence");
    assert!(first < page.find("the way with the least time").expect("what it takes"));
    // Its profile leads from the start to the target.
    let profile = route["profile"].as_array().expect("a profile");
    let step: f64 = profile.windows(2).map(|it| along(&it[1]) - along(&it[0])).fold(0.0, f64::max);
    assert!(along(&profile[0]) < 2.0 * step && step < 1.2);
    assert!(number(&route["length_m"]) >= along(&profile[profile.len() - 1]));
    assert!(profile.iter().all(|it| it["z_m"].is_f64() && it["slip_ratio"].is_f64()));
    let rows = place.read("out/profile.csv");
    assert!(rows.starts_with("leg,along_m,x_m,y_m,z_m,slope_deg,course_deg,slip_ratio,"));
    assert_eq!(rows.lines().count(), profile.len() + 1);
    let other = named[0]["profile"].as_array().expect("a profile").len();
    assert_eq!(place.read("out/profile-energy.csv").lines().count(), other + 1);
    assert!(
        page.contains("Height of the map") && page.contains("Probability of a no-go"),
        "its charts"
    );
    assert!(
        page.contains("Ways over the ground") && page.contains(">least risk<"),
        "their picture"
    );
    // A short one is driven at once, and its line is a mission.
    let short =
        place.json("route ridge.xyz --from 7002,-298 --to 7003,-296 --samples 2 --out short");
    let driven = &short["simulated"];
    assert_eq!(driven["outcome"], "completed");
    for error in ["time_error", "energy_error"] {
        assert!(number(&driven[error]).abs() < 0.1, "{error}: {driven}");
    }
    let mission =
        "schema = \"mission/1\"\n[terrain]\nfile = \"ridge.xyz\"\nstart_m = [7002.0, -298.0]\n";
    place.write("mission.toml", mission);
    let legs = place.json(
        "mission mission.toml --nominal --legs-from short/route.geojson --set \
         mission.simulation=quasi-steady",
    );
    let rows = legs["legs"].as_array().or(legs["rows"].as_array()).expect("legs");
    let last = rows.last().expect("a leg");
    assert!((number(&last["x_m"]) - 7003.0).abs() < 0.2, "{last}");
    // A mission that names no start starts where the line does, and so does its repetition.
    let terrain = "[terrain]\nfile = \"ridge.xyz\"\n";
    place.write("plain.toml", format!("schema = \"mission/1\"\n{terrain}[[leg]]\nwait_s = 1.0\n"));
    let plain = place.line(
        "mission plain.toml --nominal --legs-from short/route.geojson --simulation quasi-steady \
         --out plain --format json",
    );
    for words in ["the rover starts where its line does, at [7002.0,-298.0]", "the mission's own"] {
        assert!(plain.stderr.contains(words), "{}", plain.stderr);
    }
    let plain: Value = serde_json::from_str(&plain.stdout).expect("JSON");
    let legs_of = |answer: &Value| answer["legs"].as_array().expect("legs").clone();
    assert_eq!(legs_of(&plain).len(), rows.len() + 1);
    assert_eq!(legs_of(&plain)[..rows.len()], rows[..]);
    let again = place.json("mission plain/mission.toml --nominal --simulation quasi-steady");
    assert_eq!(legs_of(&again), legs_of(&plain));
    // The same way again as a line to check takes the same.
    let back = place.json("route ridge.xyz --along short/route.geojson --samples 2 --out back");
    assert_eq!((&back["status"], &back["minimise"]), (&json!("safe"), &Value::Null));
    for key in ["length_m", "time_s", "energy_j"] {
        let (one, other) = (number(&back[key]), number(&short[key]));
        assert!((one / other - 1.0).abs() < 1e-9, "{key}: {one} {other}");
    }
    assert_eq!(back["waypoints"], short["waypoints"]);
    assert_eq!(back["simulated"]["outcome"], "completed");
    assert!(place.read("back/report.html").contains("the given way is safe"));
    assert_eq!(place.read("back/route.geojson").matches("LineString").count(), 1);
}

#[test]
fn a_line_over_a_ridge_is_not_safe_and_is_told_where() {
    let place = Place::new();
    place.write("ridge.xyz", heights(ridge));
    // Heights in it are passed over.
    let line = json!({"type": "LineString", "coordinates": [[7002, -298, 5.0], [7010.5, -298]]});
    place.write("line.geojson", line.to_string());
    let answer = place.json("route ridge.xyz --along line.geojson --samples 2 --out out");
    assert_eq!(answer["status"], "not-safe");
    let reason = answer["reason"].as_str().expect("a reason");
    // Up the ridge and down it again no heading holds the course: one stretch.
    assert!(reason.contains("m along the line, at x "), "{reason}");
    let dangers: Vec<&str> = answer["hazards"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|it| it["danger"].as_str())
        .collect();
    assert!(dangers.contains(&"no-heading"), "{dangers:?}");
    assert!(answer["energy_j"].is_null() && answer["simulated"].is_null());
    // All samples end on the ridge, and it is said how and where.
    assert_eq!(number(&answer["probability_completed"]), 0.0, "{answer}");
    assert!(answer["commonest_end"] == "no-heading" || answer["commonest_end"] == "too-much-slip");
    assert!((number(&answer["commonest_end_along_m"]) - 3.5).abs() < 1.5, "{answer}");
    assert_eq!((&answer["verdict"], &answer["verdict_leg"]), (&json!("no_go"), &json!(1)));
    let sentence = answer["sentence"].as_str().expect("a sentence");
    assert!(sentence.contains("it ends most often in leg 1, ") && sentence.contains(" No-go"));
    assert!(place.read("out/report.html").contains("no heading holds the course"));
    assert_eq!(place.read("out/route.geojson").matches("LineString").count(), 0);
    // There and back, a metre beside it: two stretches, and what lies between them is safe.
    let line = json!({
        "type": "LineString",
        "coordinates": [[7002, -298], [7010.5, -298], [7010.5, -297], [7002, -297]],
    });
    place.write("line.geojson", line.to_string());
    let answer = place.json("route ridge.xyz --along line.geojson --samples 2 --out twice");
    let reason = answer["reason"].as_str().expect("a reason");
    assert!(reason.contains("another stretch is not safe"), "{reason}");
}

/// On a plane whose slope is below every limit of slip, but too near to the friction angle, a line
/// is not safe, and the verdict is why.
#[test]
fn a_line_with_a_leg_of_no_go_is_not_safe() {
    let place = Place::new();
    place.write("plane.xyz", heights(|_, y| 0.3 * y));
    let line = json!({"type": "LineString", "coordinates": [[7004, -298], [7004, -294]]});
    place.write("line.geojson", line.to_string());
    let asked = "route plane.xyz --along line.geojson --samples 8 --no-drive --soil \
                 toyoura-uncertain --most-no-go 1 --most-slip-ratio 1";
    let answer = place.json(asked);
    assert_eq!(answer["legs"][0]["advice"]["verdict"], "no_go", "{answer}");
    assert_eq!(answer["status"], "not-safe");
    let [hazard] = &answer["hazards"].as_array().expect("hazards")[..] else { panic!("{answer}") };
    assert_eq!(hazard["danger"], "no-go-verdict");
    let words = answer["reason"].as_str().expect("a reason");
    assert!(words.contains("the verdict is no-go: "), "{words}");
}

/// A square of GeoJSON, as a start and a size [m].
fn square(x: f64, y: f64, size: f64) -> Value {
    let ring = [[x, y], [x + size, y], [x + size, y + size], [x, y + size], [x, y]];
    json!({"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [ring]}})
}

#[test]
fn a_route_keeps_out_of_areas() {
    let place = Place::new();
    place.write("flat.xyz", heights(|_, _| 2.0));
    place.write("keep.geojson", square(7005.0, -300.0, 4.0).to_string());
    let line = "route flat.xyz --from 7002,-298 --to 7010.5,-298 --samples 2 --no-drive --keep-out \
                keep.geojson";
    let route = place.json(line);
    assert!(places(&route).iter().any(|[_, y]| *y > -296.2), "{route}");
    let inside = place.json(&line.replace("7010.5,-298", "7007,-298"));
    assert_eq!(inside["status"], "no-safe-route");
    assert!(inside["reason"].as_str().unwrap().contains("lies where nobody may go"), "{inside}");
    // However narrow it is: less than half as wide as the points are apart.
    let mut fence = square(7006.1, -301.0, 0.2);
    for corner in [2, 3] {
        fence["geometry"]["coordinates"][0][corner][1] = json!(-293.2);
    }
    place.write("keep.geojson", fence.to_string());
    let route = place.json(line);
    assert!(places(&route).iter().any(|[_, y]| *y > -293.2), "{route}");
    let tie =
        [[7003.0, -299.0], [7006.0, -296.0], [7006.0, -299.0], [7003.0, -296.0], [7003.0, -299.0]];
    let tie = json!({"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [tie]}});
    place.write("keep.geojson", tie.to_string());
    let answer = place.line(line);
    assert!(
        answer.stderr.contains("its edge crosses itself near x 7004.5, y -297.5"),
        "{}",
        answer.stderr
    );
    place.write("keep.geojson", square(0.0, 0.0, 4.0).to_string());
    assert_eq!(place.line(line).code(), 2, "an area somewhere else");
}

#[test]
fn what_is_no_route_is_said() {
    let place = Place::new();
    place.write("wall.xyz", heights(|x, _| 6.0 * ((x - 6.0) / 2.0).clamp(0.0, 1.0)));
    let cut = place.json("route wall.xyz --from 7002,-298 --to 7010.5,-298 --samples 2");
    assert_eq!(cut["status"], "no-safe-route");
    assert!(
        cut["reason"].as_str().unwrap().contains("cannot be crossed within the limits"),
        "{cut}"
    );
    assert!(cut["waypoints"].as_array().unwrap().is_empty() && cut["energy_j"].is_null());
    for (line, words) in [
        (
            "route wall.xyz --samples 2 --from 7002,-298 --to 8012,-298",
            "the target at x 8012.00 m, y -298.00 m is not on the map",
        ),
        ("route wall.xyz --from 7002 --to 8012,-298", "--from: expected two numbers"),
        ("route wall.xyz --from 7002,-298 --to 7003,-298 --most-no-go 2", "--most-no-go"),
        (
            "route wall.xyz --from 7002,-298 --to 7003,-298 --samples 2 --keep-out no.geojson",
            "no.geojson",
        ),
        ("route wall.xyz --from 7002,-298", "--to"),
    ] {
        let answer = place.line(line);
        assert!(answer.code() == 1 || answer.code() == 2, "{}", answer.conversation());
        assert!(answer.stderr.contains(words), "{}", answer.conversation());
    }
}
