//! Bodies, connections and computations have bounds, with an answer that says so.

use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use grouser_serve::{Limits, Settings};
use serde_json::json;

use crate::served::{Reply, Served};

fn limited(limits: Limits) -> Served {
    Served::start(&Settings { limits, ..Settings::default() })
}

pub(crate) fn head(server: &Served, length: &str) -> String {
    let Served { port, token, .. } = server;
    format!(
        "POST /api/stand HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nAuthorization: Bearer {token}\r\n\
         Content-Type: application/json\r\n{length}\r\n\r\n"
    )
}

#[test]
fn a_body_that_is_too_large_is_refused_before_it_was_read() {
    let server = Served::usual();
    // A thousand million bytes are promised, none of them is sent.
    let mut stream = server.connect();
    let long = format!("Content-Length: {}\r\nExpect: 100-continue", 1_000_000_000);
    stream.write_all(head(&server, &long).as_bytes()).unwrap();
    assert_eq!(Reply::read(stream).status, 413);
    // The same in pieces of unknown number.
    let mut stream = server.connect();
    stream.write_all(head(&server, "Transfer-Encoding: chunked").as_bytes()).unwrap();
    let chunk = format!("10000\r\n{}\r\n", "x".repeat(0x10000));
    for _ in 0..64 {
        if stream.write_all(chunk.as_bytes()).is_err() {
            break;
        }
    }
    let mut answer = [0; 12];
    if stream.read_exact(&mut answer).is_ok() {
        assert_eq!(&answer, b"HTTP/1.1 413");
    }
    assert_eq!(server.post("stand", &json!({})).status, 200);
}

#[test]
fn half_requests_have_an_end() {
    let short = Duration::from_millis(300);
    let server = limited(Limits { head_time: short, body_time: short, ..Limits::default() });
    let began = Instant::now();
    let mut of_head = server.connect();
    of_head.write_all(b"GET / HTTP/1.1\r\nHost: ").unwrap();
    assert_eq!(Reply::read(of_head).status, 408);
    let mut of_body = server.connect();
    of_body.write_all((head(&server, "Content-Length: 100") + "{").as_bytes()).unwrap();
    assert_eq!(Reply::read(of_body).status, 408);
    assert!(began.elapsed() < Duration::from_secs(10));
}

#[test]
fn a_thousand_connections_are_bounded_and_silent_ones_make_place() {
    let server = limited(Limits { connections: 50, ..Limits::default() });
    let mut open: Vec<TcpStream> = (0..1000).map(|_| server.connect()).collect();
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(server.ask("GET", "/", "", "").status, 200);
    let refused = Reply::read(open.remove(0));
    assert_eq!(refused.status, 503, "{refused:?}");
}

/// Who has begun to ask keeps the place.
#[test]
fn one_connection_too_many_is_refused() {
    let server = limited(Limits { connections: 3, ..Limits::default() });
    let open: Vec<TcpStream> = (0..3)
        .map(|_| {
            let mut stream = server.connect();
            stream.write_all((head(&server, "Content-Length: 100") + "{").as_bytes()).unwrap();
            stream
        })
        .collect();
    std::thread::sleep(Duration::from_millis(300));
    let refused = Reply::read(server.connect());
    assert_eq!(refused.status, 503, "{refused:?}");
    drop(open);
    // Their places are free again.
    let until = Instant::now() + Duration::from_secs(10);
    while server.ask("GET", "/", "", "").status != 200 {
        assert!(Instant::now() < until, "no place became free");
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn one_computation_too_many_is_refused() {
    let server = limited(Limits { runs: 1, waiting: 1, ..Limits::default() });
    let long = json!({"soil": "toyoura-uncertain", "samples": 10000, "slope_deg": [5, 10, 15]});
    let start = |body: &serde_json::Value| {
        let mut stream = server.connect();
        let body = body.to_string();
        let head = head(&server, &format!("Content-Length: {}", body.len()));
        let request = head.replace("/api/stand", "/api/heading") + &body;
        stream.write_all(request.as_bytes()).unwrap();
        stream
    };
    let (first, second) = (start(&long), start(&long));
    std::thread::sleep(Duration::from_millis(200));
    assert_eq!(server.post("stand", &json!({})).status, 503);
    // Who hangs up makes place at once: these would compute for many seconds.
    drop((first, second));
    let began = Instant::now();
    while server.post("stand", &json!({})).status != 200 {
        assert!(began.elapsed() < Duration::from_secs(5), "an aborted run goes on");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// A second request behind the first, which waits for its turn, hides that nobody waits for either.
#[test]
fn requests_behind_others_are_stopped_with_them() {
    let server = limited(Limits { runs: 1, waiting: 0, ..Limits::default() });
    let body = json!({"soil": "toyoura-uncertain", "samples": 10000, "slope_deg": [5, 10, 15]});
    let body = body.to_string();
    let head = head(&server, &format!("Content-Length: {}", body.len()));
    let request = head.replace("/api/stand", "/api/heading") + &body;
    let mut stream = server.connect();
    stream.write_all(request.repeat(2).as_bytes()).unwrap();
    std::thread::sleep(Duration::from_millis(200));
    assert_eq!(server.post("stand", &json!({})).status, 503);
    drop(stream);
    let began = Instant::now();
    while server.post("stand", &json!({})).status != 200 {
        assert!(began.elapsed() < Duration::from_secs(5), "an aborted run goes on");
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Who takes a little again and again holds what waits no longer than who takes nothing.
#[test]
fn slow_readers_have_an_end() {
    let server = limited(Limits {
        write_time: Duration::from_secs(1),
        slowest: 100 << 20,
        ..Limits::default()
    });
    let get = head(&server, "").replace("POST /api/stand", "GET /map.js");
    let mut stream = server.connect();
    let mut sending = stream.try_clone().unwrap();
    // Whatever the system keeps for a reader is full of these.
    let sent =
        std::thread::spawn(move || (0..3000).all(|_| sending.write_all(get.as_bytes()).is_ok()));
    let (began, mut taken) = (Instant::now(), vec![0; 256 << 10]);
    while began.elapsed() < Duration::from_secs(4) {
        if stream.read(&mut taken).is_ok_and(|bytes| bytes == 0) {
            break;
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    let mut rest = Vec::new();
    let whole = stream.read_to_end(&mut rest).is_ok() && sent.join().unwrap();
    assert!(!whole || rest.is_empty(), "the server waits on: {} bytes", rest.len());
}

/// Answers that nobody takes fill no more than their part of the memory.
#[test]
fn answers_without_room_are_refused() {
    let server = limited(Limits { answer_bytes: 4 << 10, ..Limits::default() });
    let reply = server.post("scenario", &json!({}));
    assert_eq!(reply.status, 503, "{reply:?}");
    assert!(reply.lines()[0]["error"].as_str().unwrap().contains("no room"), "{reply:?}");
}

#[test]
fn a_computation_that_takes_too_long_is_stopped() {
    let server = limited(Limits { run_time: Duration::from_millis(100), ..Limits::default() });
    let long = json!({"soil": "toyoura-uncertain", "stages": [0, 10000], "slope_deg": [5, 10, 15]});
    let reply = server.post("heading", &long);
    let last = reply.lines().pop().unwrap();
    assert_eq!(last["schema"], "grouser.error.v1");
    assert!(last["error"].as_str().unwrap().contains("stopped before its end"), "{last}");
}

#[test]
fn a_server_ends_with_what_it_computes() {
    let server = Served::usual();
    let mut stream = server.connect();
    let body = json!({"soil": "toyoura-uncertain", "samples": 10000}).to_string();
    let head = head(&server, &format!("Content-Length: {}", body.len()));
    let request = head.replace("/api/stand", "/api/heading") + &body;
    stream.write_all(request.as_bytes()).unwrap();
    std::thread::sleep(Duration::from_millis(200));
    let began = Instant::now();
    drop(server);
    assert!(began.elapsed() < Duration::from_secs(4));
}

#[test]
fn what_is_no_http_is_no_trouble() {
    let server = limited(Limits { head_time: Duration::from_secs(1), ..Limits::default() });
    for bytes in [
        "\0\0\0\0",
        "GET\r\n\r\n",
        "POST /api/heading HTTP/1.1\r\n\r\n",
        "\u{16}\u{3}\u{1}",
        "GET / HTTP/1.1\r\nHost: a\r\nX: \r\n \r\n",
    ] {
        let mut stream = server.connect();
        stream.write_all(bytes.as_bytes()).unwrap();
        stream.shutdown(std::net::Shutdown::Write).unwrap();
        assert_ne!(Reply::read(stream).status, 200, "{bytes:?}");
    }
    let long = format!("GET /{} HTTP/1.1\r\n\r\n", "x".repeat(100_000));
    assert_ne!(server.send(&long).status, 200);
    assert_eq!(server.ask("GET", "/", "", "").status, 200);
}

/// Keys of thousands of steps, and answers larger than any page shows, are refused.
#[test]
fn questions_without_measure_are_refused() {
    let server = Served::usual();
    let deep = format!("soil.{}b", "a.".repeat(20_000));
    let many: Vec<f64> = (1..=200).map(f64::from).collect();
    let slips: Vec<f64> = (0..150).map(|it| 0.005 * f64::from(it)).collect();
    let keys = vec!["soil.friction_angle_deg"; 65];
    let questions = [
        ("stand", json!({"set": {deep: 1}}), "that deep"),
        ("wheel-test", json!({"load_n": many, "slip_ratio": slips}), "at most 20000"),
        ("wheel-test", json!({"gradients": keys}), "65 keys"),
    ];
    for (path, question, said) in questions {
        let reply = server.post(path, &question);
        assert_eq!(reply.status, 422, "{path}");
        let error = reply.lines().remove(0);
        assert!(error["error"].as_str().unwrap().contains(said), "{error}");
    }
    assert_eq!(server.ask("GET", "/api/presets", "", "").status, 200);
}
