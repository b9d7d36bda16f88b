//! Many clients at once, and those who mean harm: nothing leaks or hangs, and memory has a bound.

use std::fs;
use std::io::{BufRead as _, BufReader, Write as _};
use std::net::TcpStream;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use grouser::document::{Kind, preset};
use grouser_serve::Settings;
use serde_json::json;

use crate::served::{Reply, Served};

/// How long sliders are moved.
const LONG: Duration = Duration::from_secs(60);
/// Who moves sliders.
const CLIENTS: usize = 50;
/// Time between two places of a slider that is dragged, and after the last of them.
const STEP: Duration = Duration::from_millis(200);
const PAUSE: Duration = Duration::from_secs(4);
/// Places of a drag; at the last one the whole answer is waited for.
const PLACES: usize = 5;

/// Times from question to answer: of the soil as written, and of 200 samples.
#[derive(Default)]
struct Times {
    nominal: Mutex<Vec<Duration>>,
    band: Mutex<Vec<Duration>>,
    /// Questions that were too many, or waited too long.
    refused: AtomicUsize,
}

impl Times {
    /// A slider that moves to another place.
    ///
    /// * `leaves`: after which time it moves on, whether the answer is there or not
    fn slide(&self, server: &Served, place: usize, leaves: Option<Duration>) {
        let slope = 5.0 + (place % 37) as f64 * 0.25;
        let friction = 33.0 + (place % 11) as f64 * 0.3;
        let question = json!({
            "soil": "toyoura-uncertain", "slope_deg": slope, "stages": [0, 200], "shown": true,
            "set": {"soil.friction_angle_deg": friction},
        });
        let began = Instant::now();
        let mut stream = server.connect();
        stream.set_read_timeout(Some(leaves.unwrap_or(Duration::from_secs(90)))).unwrap();
        stream.write_all(post(server, "heading", &question.to_string()).as_bytes()).unwrap();
        for line in BufReader::new(stream).lines() {
            let Ok(line) = line else {
                assert!(leaves.is_some(), "an answer hangs");
                return;
            };
            if line.contains("grouser.error.v1") {
                assert!(["too many", "too long"].iter().any(|it| line.contains(it)), "{line}");
                self.refused.fetch_add(1, Ordering::Relaxed);
            }
            if line.contains("grouser.heading.v1") {
                let of = if line.contains("yaw_deg_p2_5") { &self.band } else { &self.nominal };
                of.lock().unwrap().push(began.elapsed());
            }
        }
    }

    fn report(&self, what: &str) -> [Duration; 2] {
        println!("{what}: {} refused", self.refused.load(Ordering::Relaxed));
        [("nominal", &self.nominal), ("band", &self.band)].map(|(name, times)| {
            let mut times = times.lock().unwrap();
            times.sort_unstable();
            let at = |share: usize| times[(times.len() - 1) * share / 100];
            println!(
                "{what}, {name}: {} answers, median {:?}, 95th percentile {:?}, longest {:?}",
                times.len(),
                at(50),
                at(95),
                at(100)
            );
            at(95)
        })
    }
}

fn post(server: &Served, question: &str, body: &str) -> String {
    server.request("POST", &format!("/api/{question}"), "", body)
}

/// The memory of this process [MiB]: now, or at the most until now.
fn memory(which: &str) -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(which));
    let kib = line.and_then(|line| line.trim_matches([':', '\t', ' ']).split(' ').next());
    kib.and_then(|kib| kib.parse::<u64>().ok()).unwrap_or(0) >> 10
}

/// How much this process has computed [hundredths of a second].
fn computed() -> u64 {
    let status = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    status.split(' ').skip(13).take(2).filter_map(|ticks| ticks.parse::<u64>().ok()).sum()
}

/// One of those who mean harm, again and again.
fn harm(server: &Served, round: usize, secret: &Path) {
    let (own, token) = (format!("127.0.0.1:{}", server.port), &server.token);
    let get = |path: &str, host: &str, token: &str| {
        let head = format!("GET {path} HTTP/1.1\r\nHost: {host}\r\n");
        server.send(&format!("{head}Authorization: Bearer {token}\r\nConnection: close\r\n\r\n"))
    };
    let refused = |reply: &Reply, statuses: &[u16]| {
        assert!(statuses.contains(&reply.status) || reply.status == 503, "{reply:?}");
        assert!(!reply.body.contains("a secret name"), "{reply:?}");
    };
    match round % 9 {
        0 => refused(&get("/", "evil.example", token), &[403]),
        1 => refused(&get("/api/documents", &own, &"0".repeat(32)), &[401]),
        2 => refused(&get("/../../etc/passwd", &own, token), &[404]),
        3 => {
            for name in ["../secret.toml", "link.toml", "out/secret.toml", secret.to_str().unwrap()]
            {
                refused(&server.post("stand", &json!({ "soil": name })), &[422]);
            }
        }
        4 => {
            let name = "<script>alert(1)</script>\u{202e}\u{1b}[31m/../..\u{0}.toml";
            refused(&server.post("stand", &json!({ "soil": name })), &[422]);
        }
        // A thousand million bytes.
        5 => {
            let mut stream = server.connect();
            let head = post(server, "stand", "").replace("Length: 0", "Length: 1000000000");
            let chunk = vec![b'x'; 1 << 16];
            let sent = stream.write_all(head.as_bytes()).is_ok();
            let taken = (0..16_000).take_while(|_| sent && stream.write_all(&chunk).is_ok());
            assert!(taken.count() < 8000, "the server takes everything");
        }
        // Who asks and goes, with more behind it.
        6 => {
            let long = json!({"soil": "toyoura-uncertain", "samples": 10000}).to_string();
            let long = post(server, "heading", &long).replace("close", "keep-alive");
            let _ = server.connect().write_all(long.repeat(3).as_bytes());
        }
        // Who never reads.
        7 => {
            let mut stream = server.connect();
            let get = format!(
                "GET /map.js HTTP/1.1\r\nHost: {own}\r\nAuthorization: Bearer {token}\r\n\r\n"
            );
            stream.set_write_timeout(Some(Duration::from_secs(2))).unwrap();
            let _ = stream.write_all(get.repeat(2000).as_bytes());
        }
        // Half a request.
        _ => {
            let mut stream = server.connect();
            let _ = stream.write_all(b"POST /api/heading HTTP/1.1\r\nHost: ");
            thread::sleep(Duration::from_secs(1));
        }
    }
}

/// Prints what was measured: `--nocapture` shows it. Bounds are wide, for machines that do other
/// things besides; the numbers of the issue are 50 ms and 300 ms, alone on two cores.
#[test]
#[ignore = "two minutes"]
fn many_move_sliders_while_others_mean_harm() {
    let outside = tempfile::tempdir().unwrap();
    let folder = outside.path().join("folder");
    fs::create_dir(&folder).unwrap();
    let sand = preset(Kind::Soil, "toyoura").unwrap().text.replace("Toyoura sand", "a secret name");
    let secret = outside.path().join("secret.toml");
    fs::write(&secret, sand).unwrap();
    #[cfg(unix)]
    for (target, link) in [(secret.as_path(), "link.toml"), (outside.path(), "out")] {
        std::os::unix::fs::symlink(target, folder.join(link)).unwrap();
    }
    let server = Served::start(&Settings { folder: Some(folder), ..Settings::default() });

    let alone = Times::default();
    (0..100).for_each(|place| alone.slide(&server, place, None));
    alone.report("one client");
    let before = memory("VmRSS");

    let (together, is_over, harms) =
        (Times::default(), AtomicBool::new(false), AtomicUsize::new(0));
    let began = Instant::now();
    thread::scope(|scope| {
        let sliding = (0..CLIENTS).map(|client| {
            let (server, together) = (&server, &together);
            scope.spawn(move || {
                thread::sleep(PAUSE * u32::try_from(client).unwrap() / 50);
                for place in 7 * client.. {
                    let moved = Instant::now();
                    let is_last = place % PLACES == 0;
                    together.slide(server, place, (!is_last).then_some(STEP));
                    if began.elapsed() > LONG {
                        break;
                    }
                    thread::sleep(if is_last {
                        PAUSE
                    } else {
                        STEP.saturating_sub(moved.elapsed())
                    });
                }
            })
        });
        let sliding: Vec<_> = sliding.collect();
        for one in 0..9 {
            let (server, is_over, harms, secret) = (&server, &is_over, &harms, &secret);
            scope.spawn(move || {
                for round in one.. {
                    if is_over.load(Ordering::Relaxed) {
                        break;
                    }
                    harm(server, round, secret);
                    harms.fetch_add(1, Ordering::Relaxed);
                    thread::sleep(Duration::from_millis(500));
                }
            });
        }
        // What fails is said where it failed, and the others end.
        let slid: Vec<_> = sliding.into_iter().map(thread::ScopedJoinHandle::join).collect();
        is_over.store(true, Ordering::Relaxed);
        assert!(slid.iter().all(Result::is_ok));
    });
    let [nominal, _] = together.report("fifty clients");
    println!("{} attempts to do harm", harms.load(Ordering::Relaxed));
    assert!(nominal < Duration::from_secs(10), "{nominal:?}");

    let open: Vec<TcpStream> = (0..1000).map(|_| server.connect()).collect();
    thread::sleep(Duration::from_millis(500));
    let most = memory("VmHWM");
    println!("memory of clients and server: {before} MiB before, {most} MiB at the most");
    assert!(most < before + 1024, "{most} MiB");
    drop(open);
    let until = Instant::now() + Duration::from_secs(30);
    while server.ask("GET", "/", "", "").status != 200 {
        assert!(Instant::now() < until, "no place became free");
        thread::sleep(Duration::from_millis(50));
    }
    // Nothing goes on for those who have gone.
    let before = computed();
    thread::sleep(Duration::from_secs(2));
    let idle = computed() - before;
    assert!(idle < 20, "the server computes {idle} hundredths of a second for nobody");
    let after = Times::default();
    (0..20).for_each(|place| after.slide(&server, place, None));
    after.report("one client afterwards");
}
