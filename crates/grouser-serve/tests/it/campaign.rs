//! Campaigns of the folder: computed with their progress, stopped, resumed, and nowhere else.

use std::fs;
use std::io::Read as _;
use std::time::{Duration, Instant};

use grouser_serve::Settings;
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::served::Served;

fn served() -> (TempDir, Served) {
    let outside = tempfile::tempdir().unwrap();
    let folder = outside.path().join("folder");
    fs::create_dir_all(&folder).unwrap();
    let server = Served::start(&Settings { folder: Some(folder), ..Settings::default() });
    (outside, server)
}

/// A campaign of wheel tests.
fn asked(out: &str, runs: u64, shard_runs: u64) -> Value {
    let set = json!({"campaign.runs": runs, "campaign.shard_runs": shard_runs});
    json!({"campaign": "campaign-wheel-test", "out": out, "set": set})
}

fn listed(server: &Served) -> Vec<Value> {
    let list = server.ask("GET", "/api/campaigns", "", "").lines().remove(0);
    list["rows"].as_array().unwrap().clone()
}

#[test]
fn a_campaign_is_computed_and_summarised() {
    let (_folder, server) = served();
    assert!(listed(&server).is_empty());
    let lines = server.post("campaign", &asked("sand", 400, 100)).lines();
    let [progress @ .., summary, shown] = &lines[..] else { panic!("{lines:?}") };
    assert!(progress.iter().all(|it| it["what"] == "runs" && it["all"] == 400), "{progress:?}");
    assert_eq!(summary["schema"], "grouser.campaign.summarise.v1", "{summary}");
    assert_eq!((&summary["shards"], &summary["inputs"]["runs"]), (&json!(4), &json!(400)));
    let quantities: Vec<&Value> =
        summary["rows"].as_array().unwrap().iter().map(|row| &row["quantity"]).collect();
    assert!(quantities.contains(&&json!("drawbar_pull_n")), "{quantities:?}");
    assert!(shown["sentences"][0].as_str().unwrap().starts_with("0 of 400 runs failed"), "{shown}");
    assert!(!shown["figures"].as_array().unwrap().is_empty());
    let row = json!({"out": "sand", "name": "Wheel test, sand, load and slip known roughly",
                     "runs": 400, "done": 400, "is_finished": true});
    assert_eq!(listed(&server), [row]);
    let again = server.post("campaign-summary", &json!({"out": "sand"})).lines();
    assert_eq!(&again[0], summary);
    // A study that is asked for again has nothing left to do; another one is refused.
    let same = server.post("campaign", &json!({"out": "sand"})).lines();
    assert_eq!(same[same.len() - 2], *summary);
    let other = server.post("campaign", &asked("sand", 500, 100));
    assert_eq!(other.status, 422, "{other:?}");
    assert!(other.lines()[0]["error"].as_str().unwrap().contains("another study"), "{other:?}");
}

/// Shards that are there stay, and the end has the digest of one that nobody stopped.
#[test]
fn a_campaign_that_was_stopped_goes_on() {
    let (_folder, server) = served();
    let long = asked("stopped", 40_000, 50);
    let mut stream = server.begin("campaign", &long);
    let since = Instant::now();
    let done = loop {
        let _ = stream.read(&mut [0; 4096]).unwrap();
        let done = listed(&server).first().map_or(0, |row| row["done"].as_u64().unwrap());
        if done > 0 {
            break done;
        }
        assert!(since.elapsed() < Duration::from_secs(60), "nothing is computed");
    };
    drop(stream);
    assert!(done < 40_000, "it was too quick to be stopped");
    // What was stopped may still write a last shard.
    let mut end = Vec::new();
    for _ in 0..300 {
        end = server.post("campaign", &json!({"out": "stopped"})).lines();
        if end.len() > 1 {
            break;
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    assert!(end[0]["done"].as_u64().unwrap() > done, "{}", end[0]);
    let whole = server.post("campaign", &asked("whole", 40_000, 50)).lines();
    assert_eq!(end[end.len() - 2]["digest"], whole[whole.len() - 2]["digest"]);
}

#[test]
fn campaigns_stay_in_the_folder() {
    let (outside, server) = served();
    let mut names = vec!["", "..", "../out", "a/b", ".hidden", "/out", "a\\b", "ü"];
    if cfg!(unix) {
        let folder = outside.path().join("folder");
        fs::create_dir_all(outside.path().join("elsewhere")).unwrap();
        fs::create_dir_all(folder.join("inside")).unwrap();
        #[cfg(unix)]
        for link in ["link", "inside/runs"] {
            let elsewhere = outside.path().join("elsewhere");
            std::os::unix::fs::symlink(elsewhere, folder.join(link)).unwrap();
        }
        names.extend(["link", "inside"]);
    }
    for name in names {
        for (question, body) in
            [("campaign", asked(name, 10, 10)), ("campaign-summary", json!({ "out": name }))]
        {
            let reply = server.post(question, &body);
            assert_eq!(reply.status, 422, "{name}");
            assert_eq!(reply.lines()[0]["key"], "out", "{name}: {reply:?}");
        }
    }
    assert!(fs::read_dir(outside.path()).unwrap().count() <= 2);
    let many = server.post("campaign", &asked("many", 1_000_000_000, 1_000_000));
    assert_eq!(many.lines()[0]["key"], "campaign", "{many:?}");
    let nowhere = Served::usual().post("campaign", &asked("sand", 10, 10));
    assert_eq!(nowhere.lines()[0]["key"], "out", "{nowhere:?}");
}
