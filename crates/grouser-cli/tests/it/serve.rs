//! `grouser serve`: one line, the same numbers as the commands have, and an end.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use grouser::document::json;
use grouser_draw::from_base64;
use serde_json::{Value, json};

use crate::maps::heights;
use crate::program::{Place, changed_preset};

/// A server, and the address that it printed.
struct Served {
    child: Child,
    port: u16,
    token: String,
}

impl Served {
    fn start(place: &Place, arguments: &[&str]) -> Self {
        let arguments = [&["serve", "--no-open"], arguments].concat();
        let mut child =
            place.command(&arguments).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
        let (port, token) = line
            .trim()
            .strip_prefix("http://127.0.0.1:")
            .and_then(|rest| rest.split_once("/?token="))
            .unwrap_or_else(|| panic!("this is no address: {line}"));
        let (port, token) = (port.parse().unwrap(), token.to_owned());
        Self { child, port, token }
    }

    /// The lines that a question is answered by.
    fn ask(&self, question: &str, body: &Value) -> Vec<Value> {
        let reply = self.reply(question, body);
        let (head, body) = reply.split_once("\r\n\r\n").unwrap();
        assert!(head.contains(" 200 "), "{reply}");
        body.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    }

    /// Why a question is not answered.
    fn refused(&self, question: &str, body: &Value) -> Value {
        let reply = self.reply(question, body);
        let (head, body) = reply.split_once("\r\n\r\n").unwrap();
        assert!(head.contains(" 422 "), "{reply}");
        serde_json::from_str(body).unwrap()
    }

    fn reply(&self, question: &str, body: &Value) -> String {
        let Self { port, token, .. } = self;
        let body = body.to_string();
        let mut stream = TcpStream::connect(("127.0.0.1", *port)).unwrap();
        // In the elder protocol an answer is not cut into pieces.
        let request = format!(
            "POST /api/{question} HTTP/1.0\r\nHost: 127.0.0.1:{port}\r\nAuthorization: Bearer \
             {token}\r\nContent-Type: application/json\r\nContent-Length: {}\r\n\r\n{body}",
            body.len()
        );
        stream.write_all(request.as_bytes()).unwrap();
        let mut reply = String::new();
        stream.read_to_string(&mut reply).unwrap();
        reply
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Each question with its command, whose output it equals.
#[test]
fn answers_are_those_of_the_commands_that_come_with_them() {
    let place = Place::new();
    place
        .write("soft sand.toml", crate::program::changed_preset("soil", "toyoura", "38.0", "33.0"));
    let served = Served::start(&place, &["."]);
    for (question, body) in [
        ("heading", json!({})),
        ("heading", json!({"soil": "toyoura-uncertain", "slope_deg": [4, 12], "stages": [0, 10]})),
        (
            "heading",
            json!({"soil": "soft sand.toml", "rover": "hakuto", "gravity_m_s2": "moon", "nominal": true}),
        ),
        ("heading", json!({"slope_deg": 8.5, "model": "all", "nominal": true})),
        ("heading", json!({"steering": "crab", "rover": "mgru3", "slope_deg": 5})),
        (
            "heading",
            json!({
                "slope_deg": 10, "samples": 8, "seed": 3, "go_slip_ratio": 0.2,
                "set": {"soil.cohesion_kpa": 0.25, "rover.wheel_unit.wheel.radius_m": 0.12},
            }),
        ),
        (
            "heading",
            json!({
                "slope_deg": 10, "nominal": true, "gradients": ["soil.friction_angle_deg", "slope_deg"],
            }),
        ),
        ("heading-map", json!({})),
        (
            "heading-map",
            json!({
                "slope_deg": 10, "course_deg": [-30, 15], "samples": 8, "rim_speed_m_s": 0.1,
                "set": {"scenario.gravity_m_s2": 3.71},
            }),
        ),
        ("wheel-test", json!({})),
        (
            "wheel-test",
            json!({
                "slip_ratio": [-0.2, 0.3], "slip_angle_deg": 10, "load_n": [5, 20], "stages": [0, 8],
                "soil": "toyoura-uncertain", "set": {"wheel.width_m": 0.1},
            }),
        ),
        ("wheel-test", json!({"slip_ratio": 0.3, "gradients": ["all"], "model": "small-wheel"})),
    ] {
        check_is_of_its_command(&place, &served, question, &body);
    }
}

/// The same of what lies on a map of heights, and of runs.
#[test]
fn maps_ways_and_runs_are_those_of_their_commands() {
    let place = Place::new();
    place
        .write("soft sand.toml", crate::program::changed_preset("soil", "toyoura", "38.0", "33.0"));
    place.write("hills.xyz", heights(|x, y| 0.12 * x + 0.4 * (0.9 * y).sin()));
    place.write(
        "rocks.geojson",
        r#"{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [[[7005, -298], [7007, -298], [7007, -296], [7005, -298]]]}}"#,
    );
    let served = Served::start(&place, &["."]);
    for (question, body) in [
        ("map", json!({"dem": "hills.xyz", "samples": 8, "soil": "toyoura-uncertain"})),
        (
            "map",
            json!({
                "dem": "./hills.xyz", "stages": [4, 6], "course_deg": "best", "missing_m": 0.25,
                "soil": "soft sand.toml", "gravity_m_s2": "moon", "rim_speed_m_s": 0.1,
                "go_slip_ratio": 0.2, "layers": ["course_deg", "slip_ratio"],
            }),
        ),
        (
            "route",
            json!({"dem": "hills.xyz", "samples": 4, "from_m": [7002, -298], "to_m": [7012, -293]}),
        ),
        (
            "route",
            json!({
                "dem": "hills.xyz", "samples": 4, "soil": "toyoura-uncertain", "keep_out": "rocks.geojson",
                "from_m": [7002, -297], "to_m": [7011, -296.5], "minimise": "energy", "yaw_deg": 370,
                "most_slope_deg": 25, "most_slip_ratio": 0.9, "most_no_go": 0.5, "alternatives": true,
            }),
        ),
        ("traverse", json!({})),
        (
            "traverse",
            json!({
                "soil": "toyoura-uncertain", "slope_deg": 14, "yaw_deg": -3.5, "duration_s": 6.05,
                "rim_speed_m_s": [0.05, 0.05, 0.06, 0.06], "stages": [0, 4],
            }),
        ),
        (
            "traverse",
            json!({
                "set": {"scenario.terrain.file": "hills.xyz"}, "duration_s": 8, "yaw_deg": 20,
            }),
        ),
        (
            "traverse",
            json!({"slope_deg": 8, "duration_s": 3, "set": {"scenario.simulation": "quasi-steady"}}),
        ),
    ] {
        check_is_of_its_command(&place, &served, question, &body);
    }
}

/// A log of the folder is replayed as by its command; one outside of it, and what is no log, are
/// refused.
#[test]
fn a_log_is_replayed_as_by_its_command() {
    let place = Place::new();
    let made = place.line("traverse --soil toyoura --slope-deg 8 --telemetry drive.csv");
    assert!(made.status.success(), "{}", made.stderr);
    place.write("other.csv", "load_n,slip_ratio\n5,0.2\n");
    std::fs::create_dir(place.file("inside")).unwrap();
    let outside = place.file("drive.csv");
    let confined = Served::start(&place, &["inside"]);
    for log in ["../drive.csv", outside.to_str().unwrap()] {
        let refused = confined.refused("replay", &json!({"log": log, "soil": "toyoura"}));
        assert_eq!(refused["key"], "log", "{refused}");
        assert!(refused["error"].as_str().unwrap().contains("leads out of"), "{refused}");
    }
    let served = Served::start(&place, &["."]);
    for body in [
        json!({"log": "drive.csv", "soil": "toyoura"}),
        json!({"log": "drive.csv", "soil": "toyoura", "from_s": 4, "to_s": 11.5}),
        json!({
            "log": "./drive.csv", "soil": "toyoura-uncertain", "samples": 8, "odometry": "visual",
            "model": "small-wheel", "set": {"soil.cohesion_kpa": 0.25},
        }),
    ] {
        check_is_of_its_command(&place, &served, "replay", &body);
    }
    for (body, key, says) in [
        (json!({}), "log", "the path of a log"),
        (json!({"log": "other.csv"}), "log", "other.csv"),
        (json!({"log": "drive.csv", "odometry": "guess"}), "odometry", "visual"),
        (json!({"log": "drive.csv", "model": "all"}), "model", "one model"),
        (json!({"log": "drive.csv", "slope_deg": 4}), "slope_deg", ""),
        (json!({"log": "drive.csv", "from_s": 9, "to_s": 3}), "to_s", "not after 9 s"),
        (
            json!({"log": "drive.csv", "from_s": 3, "to_s": 3.01}),
            "log",
            "nothing can be told from 1 ",
        ),
    ] {
        let refused = served.refused("replay", &body);
        assert_eq!(refused["key"], key, "{body}: {refused}");
        assert!(refused["error"].as_str().unwrap().contains(says), "{body}: {refused}");
    }
}

/// Checks that each stage of an answer is what its command prints.
fn check_is_of_its_command(place: &Place, served: &Served, question: &str, body: &Value) {
    let mut asked = body.clone();
    asked["shown"] = true.into();
    let mut lines = served.ask(question, &asked);
    lines.retain(|line| line["schema"] != "grouser.progress.v1");
    assert_eq!(lines.len() % 2, 0);
    for stage in lines.chunks(2) {
        // A map is a folder, which is written once.
        drop(std::fs::remove_dir_all(place.file("map")));
        let command = stage[1]["command"].as_str().unwrap();
        let printed = place.shell(&format!("{command} --format json"));
        assert!(printed.status.success(), "{command}: {}", printed.stderr);
        let printed: Value = serde_json::from_str(&printed.stdout).unwrap();
        assert_eq!(json::line(&printed), json::line(&stage[0]), "{command}");
    }
}

#[test]
fn presets_are_those_of_the_command() {
    let place = Place::new();
    let served = Served::start(&place, &[]);
    let mut stream = TcpStream::connect(("127.0.0.1", served.port)).unwrap();
    let request = format!(
        "GET /api/presets HTTP/1.0\r\nHost: localhost:{}\r\nAuthorization: Bearer {}\r\n\r\n",
        served.port, served.token
    );
    stream.write_all(request.as_bytes()).unwrap();
    let mut reply = String::new();
    stream.read_to_string(&mut reply).unwrap();
    let listed: Value = serde_json::from_str(reply.split_once("\r\n\r\n").unwrap().1).unwrap();
    assert_eq!(listed, place.json("presets"));
}

/// What was computed before a kill is there after it, and the end has the digest of the command.
#[test]
fn a_kill_loses_nothing_of_a_campaign() {
    let place = Place::new();
    let set = json!({"campaign.runs": 20_000, "campaign.shard_runs": 50});
    let asked = json!({"campaign": "campaign-wheel-test", "out": "killed", "set": set});
    let mut served = Served::start(&place, &["."]);
    let (port, token, body) = (served.port, served.token.clone(), asked.to_string());
    let mut stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
    let request = format!(
        "POST /api/campaign HTTP/1.0\r\nHost: localhost:{port}\r\nAuthorization: Bearer \
         {token}\r\nContent-Type: application/json\r\nContent-Length: {}\r\n\r\n{body}",
        body.len()
    );
    stream.write_all(request.as_bytes()).unwrap();
    let shards = || {
        let files = std::fs::read_dir(place.file("killed/runs")).into_iter().flatten().flatten();
        let names = files.filter_map(|it| it.file_name().into_string().ok());
        names.filter(|it| it.ends_with(".parquet")).count()
    };
    let began = Instant::now();
    while shards() < 3 {
        assert!(began.elapsed() < Duration::from_secs(60), "nothing is computed");
        std::thread::sleep(Duration::from_millis(5));
    }
    served.child.kill().unwrap();
    served.child.wait().unwrap();
    let kept = shards();
    assert!(kept < 400, "it was too quick to be killed");
    let served = Served::start(&place, &["."]);
    let lines = served.ask("campaign", &json!({"out": "killed"}));
    assert!(lines[0]["done"].as_u64().unwrap() > 50 * kept as u64, "{}", lines[0]);
    let command = "campaign run campaign-wheel-test --set campaign.runs=20000 --set \
                   campaign.shard_runs=50 --out whole --format json";
    let whole = place.shell(&format!("grouser {command}"));
    let whole: Value = serde_json::from_str(whole.stdout.lines().last().unwrap()).unwrap();
    assert_eq!(lines[lines.len() - 2]["digest"], whole["digest"]);
}

#[test]
#[cfg(unix)]
fn ctrl_c_ends_it_with_what_it_computes() {
    let place = Place::new();
    let mut served = Served::start(&place, &[]);
    let (port, token) = (served.port, served.token.clone());
    let asking = std::thread::spawn(move || {
        let mut stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        let body = r#"{"soil": "toyoura-uncertain", "samples": 10000}"#;
        let request = format!(
            "POST /api/heading HTTP/1.0\r\nHost: localhost:{port}\r\nAuthorization: Bearer \
             {token}\r\nContent-Type: application/json\r\nContent-Length: {}\r\n\r\n{body}",
            body.len()
        );
        stream.write_all(request.as_bytes()).unwrap();
        let _ = stream.read_to_string(&mut String::new());
    });
    std::thread::sleep(Duration::from_millis(300));
    let id = served.child.id().to_string();
    let sent = std::process::Command::new("kill").args(["-INT", &id]).status().unwrap();
    assert!(sent.success());
    let began = Instant::now();
    let status = loop {
        if let Some(status) = served.child.try_wait().unwrap() {
            break status;
        }
        assert!(began.elapsed() < Duration::from_secs(10), "it does not end");
        std::thread::sleep(Duration::from_millis(20));
    };
    assert!(status.success(), "{status}");
    asking.join().unwrap();
}

#[test]
fn wrong_settings_say_what_is_wrong() {
    let place = Place::new();
    let absent = place.run(&["serve", "--no-open", "nowhere"]);
    assert_eq!(absent.code(), 2);
    assert!(absent.stderr.contains("the folder nowhere cannot be read"), "{}", absent.stderr);
    let served = Served::start(&place, &[]);
    let port = served.port.to_string();
    let taken = place.run(&["serve", "--no-open", "--port", &port]);
    assert_eq!(taken.code(), 1);
    assert!(taken.stderr.contains("cannot be listened on"), "{}", taken.stderr);
    assert_eq!(place.run(&["serve", "--no-open", "--listen", "moon"]).code(), 2);
}

/// All users of a machine can read command lines: the browser is opened with a private file.
#[test]
#[cfg(target_os = "linux")]
fn the_token_is_on_no_command_line() {
    use std::os::unix::fs::PermissionsExt as _;
    let place = Place::new();
    place.write(
        "xdg-open",
        "#!/bin/sh\nprintf %s \"$*\" > opened.part\ncat \"$1\" > read\nmv opened.part opened\n",
    );
    let program = place.file("xdg-open");
    std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).unwrap();
    let path = std::env::var("PATH").unwrap_or_default();
    let mut child = place
        .command(&["serve"])
        .env("PATH", format!("{}:{path}", program.parent().unwrap().display()))
        .env("TMPDIR", place.path())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
    let began = Instant::now();
    while !place.file("opened").exists() {
        assert!(began.elapsed() < Duration::from_secs(10), "no browser was opened");
        std::thread::sleep(Duration::from_millis(20));
    }
    let _ = child.kill();
    let _ = child.wait();
    let read = |name: &str| std::fs::read_to_string(place.file(name)).unwrap();
    assert!(
        read("opened").contains("/grouser-") && !read("opened").contains("token"),
        "{}",
        read("opened")
    );
    assert!(read("read").contains(line.trim()), "{}", read("read"));
}

/// The card is the file of the command; a soil that was learnt of what contradicts it has none.
#[test]
fn the_card_is_that_of_the_command() {
    let place = Place::new();
    let (key, named) =
        ("friction_angle_deg", "contradictions = [\"it slips less\"]\nfriction_angle_deg");
    place.write("odd.toml", changed_preset("soil", "toyoura", key, named));
    let server = Served::start(&place, &["."]);
    let lines = server.ask("card", &json!({"soil": "toyoura", "go_slip_ratio": 0.25}));
    let pdf = from_base64(lines.last().unwrap()["pdf"].as_str().unwrap()).unwrap();
    place.line("card --soil toyoura --go-slip-ratio 0.25 --out card.pdf");
    assert!(pdf.starts_with(b"%PDF") && pdf == std::fs::read(place.file("card.pdf")).unwrap());
    let refused = server.refused("card", &json!({"soil": "odd.toml"}));
    assert!(refused["error"].as_str().unwrap().contains("it slips less"), "{refused}");
}
