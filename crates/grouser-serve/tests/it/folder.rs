//! What may be opened: documents of the folder, and nothing outside of it.

use std::fs;
use std::time::{Duration, Instant};

use grouser::document::{Kind, preset};
use grouser_serve::Settings;
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::served::Served;

/// A folder with a soil, beside a soil that nobody may open.
fn served() -> (TempDir, Served) {
    let outside = tempfile::tempdir().unwrap();
    let folder = outside.path().join("folder");
    fs::create_dir_all(folder.join("sub")).unwrap();
    let sand = preset(Kind::Soil, "toyoura").unwrap().text;
    fs::write(outside.path().join("secret.toml"), sand).unwrap();
    fs::write(folder.join("sub/sand.toml"), sand).unwrap();
    #[cfg(unix)]
    {
        use std::os::unix::fs::symlink;
        symlink(outside.path().join("secret.toml"), folder.join("link.toml")).unwrap();
        symlink(outside.path(), folder.join("out")).unwrap();
        symlink("sub/sand.toml", folder.join("inside.toml")).unwrap();
    }
    let server = Served::start(&Settings { folder: Some(folder), ..Settings::default() });
    (outside, server)
}

fn refusal(server: &Served, question: &str, body: &Value) -> Value {
    let reply = server.post(question, body);
    assert_eq!(reply.status, 422, "{reply:?}");
    reply.lines().remove(0)
}

#[test]
fn documents_of_the_folder_are_listed_and_opened() {
    let (_folder, server) = served();
    let listed = server.ask("GET", "/api/documents", "", "").lines().remove(0);
    assert_eq!(listed["rows"], json!([{"kind": "soil", "path": "sub/sand.toml"}]));
    assert_eq!(server.post("stand", &json!({"soil": "sub/sand.toml"})).status, 200);
    assert_eq!(server.post("stand", &json!({"soil": "sub/../sub/sand.toml"})).status, 200);
    #[cfg(unix)]
    assert_eq!(server.post("stand", &json!({"soil": "inside.toml"})).status, 200);
}

#[test]
fn no_name_leads_out_of_the_folder() {
    let (outside, server) = served();
    let whole = outside.path().join("secret.toml");
    let mut names = vec!["../secret.toml", "sub/../../secret.toml", "/etc/passwd", "/dev/stdin"];
    names.push(whole.to_str().unwrap());
    if cfg!(unix) {
        names.extend(["link.toml", "out/secret.toml", "out/folder/../secret.toml"]);
    }
    for name in names {
        let error = refusal(&server, "stand", &json!({ "soil": name }));
        assert_eq!(error["key"], "soil", "{name}: {error}");
        assert!(error["error"].as_str().unwrap().contains("leads out"), "{name}: {error}");
    }
    // Of what is outside nothing is said, not even whether it is there.
    let absent = refusal(&server, "stand", &json!({"soil": "../nothing.toml"}));
    let present = refusal(&server, "stand", &json!({"soil": "../secret.toml"}));
    assert_eq!(absent, present);
    // Nor behind a link, of a document, a map or a file beside a map.
    #[cfg(unix)]
    {
        use std::os::unix::fs::symlink;
        let folder = outside.path().join("folder");
        symlink(outside.path().join("nothing.toml"), folder.join("broken.toml")).unwrap();
        fs::create_dir(outside.path().join("closed")).unwrap();
        let same = |question: &str, of: &dyn Fn(&str) -> Value, names: [&str; 4]| {
            let [first, rest @ ..] = names.map(|name| {
                let mut error = refusal(&server, question, &of(name));
                let said = error["error"].as_str().unwrap().replace(name, "NAME");
                error["error"] = said.into();
                error
            });
            assert!(first["error"].as_str().unwrap().contains("leads out"), "{first}");
            assert!(rest.iter().all(|other| first == *other), "{first}, {rest:?}");
        };
        let names = ["out/secret.toml", "out/nothing.toml", "out/closed/x.toml", "broken.toml"];
        same("stand", &|name| json!({ "soil": name }), names);
        same("map", &|name| json!({ "dem": name }), names);
        for (name, target) in [("a", "secret.toml"), ("b", "nothing.toml"), ("c", "closed")] {
            fs::write(folder.join(format!("{name}.tif")), "no map").unwrap();
            let beside = folder.join(format!("{name}.tfw"));
            symlink(outside.path().join(target), beside).unwrap();
            let error = refusal(&server, "map", &json!({"dem": format!("{name}.tif")}));
            assert!(error["error"].as_str().unwrap().contains("leads out"), "{error}");
        }
    }
}

/// While links come and go, nothing outside is read.
#[cfg(unix)]
#[test]
fn links_that_come_and_go_lead_nowhere() {
    let (outside, server) = served();
    let folder = outside.path().join("folder");
    let sand = fs::read_to_string(folder.join("sub/sand.toml")).unwrap();
    let secret = sand.replace("Toyoura sand", "secret sand");
    fs::create_dir(outside.path().join("other")).unwrap();
    fs::write(outside.path().join("other/sand.toml"), secret).unwrap();
    let until = Instant::now() + Duration::from_secs(2);
    let swapping = std::thread::spawn({
        let (folder, other) = (folder.clone(), outside.path().join("other"));
        move || {
            while Instant::now() < until {
                fs::rename(folder.join("sub"), folder.join("kept")).unwrap();
                std::os::unix::fs::symlink(&other, folder.join("sub")).unwrap();
                fs::remove_file(folder.join("sub")).unwrap();
                fs::rename(folder.join("kept"), folder.join("sub")).unwrap();
            }
        }
    });
    while Instant::now() < until {
        let reply = server.post("stand", &json!({"soil": "sub/sand.toml"}));
        assert!(!reply.body.contains("secret sand"), "{reply:?}");
    }
    swapping.join().unwrap();
}

#[test]
fn neither_does_a_name_in_a_document_or_among_what_is_set() {
    let (outside, server) = served();
    let secret = outside.path().join("secret.toml");
    let secret = secret.to_str().unwrap();
    let error = refusal(&server, "heading", &json!({ "soil": secret }));
    assert_eq!(error["key"], "soil");
    for key in ["scenario.soil", "scenario.terrain.file", "rover.wheel_unit.wheel", "rover.motor"] {
        for name in [secret, "../secret.toml", "/etc/passwd"] {
            let error = refusal(&server, "heading", &json!({"set": {key: name}}));
            let said = error["error"].as_str().unwrap();
            assert!(said.contains("leads out"), "{key} = {name}: {error}");
        }
    }
    let scenario = "schema = \"scenario/1\"\nname = \"x\"\nsoil = \"../secret.toml\"\n";
    fs::write(outside.path().join("folder/scenario.toml"), scenario).unwrap();
    let error = refusal(&server, "heading", &json!({"scenario": "scenario.toml"}));
    assert!(error["error"].as_str().unwrap().contains("leads out"), "{error}");
    let samples = format!(
        "{}\n[uncertainty]\nsamples = \"../secret.toml\"\n",
        preset(Kind::Soil, "toyoura").unwrap().text
    );
    fs::write(outside.path().join("folder/sampled.toml"), samples).unwrap();
    let error = refusal(&server, "stand", &json!({"soil": "sampled.toml"}));
    assert!(error["error"].as_str().unwrap().contains("leads out"), "{error}");
}

#[test]
fn without_a_folder_there_are_presets_alone() {
    let server = Served::usual();
    assert_eq!(server.post("stand", &json!({"soil": "clay"})).status, 200);
    for name in ["Cargo.toml", "./Cargo.toml", "/etc/passwd", "..", ""] {
        let error = refusal(&server, "stand", &json!({ "soil": name }));
        assert_eq!(error["key"], "soil", "{name}");
    }
    let listed = server.ask("GET", "/api/documents", "", "").lines().remove(0);
    assert_eq!(listed["rows"], json!([]));
}

#[test]
fn paths_of_the_server_are_its_own() {
    let (_folder, server) = served();
    for path in [
        "/../Cargo.toml",
        "/sub/sand.toml",
        "/%2e%2e/secret.toml",
        "//main.js",
        "/api/",
        "/api/../main.js",
    ] {
        assert_eq!(server.ask("GET", path, "", "").status, 404, "{path}");
    }
}

/// What is read with a map lies in the folder as the map does.
#[cfg(unix)]
#[test]
fn no_file_beside_a_map_leads_out_of_the_folder() {
    let (outside, server) = served();
    let folder = outside.path().join("folder");
    std::fs::write(outside.path().join("secret.tfw"), "1\n0\n0\n-1\n0\n0\n").unwrap();
    std::fs::write(folder.join("map.tif"), "no map").unwrap();
    let map = json!({"set": {"scenario.terrain.file": "map.tif"}});
    let error = refusal(&server, "heading", &map);
    assert!(!error["error"].as_str().unwrap().contains("leads out"), "{error}");
    std::os::unix::fs::symlink(outside.path().join("secret.tfw"), folder.join("map.tfw")).unwrap();
    let error = refusal(&server, "heading", &map);
    assert!(error["error"].as_str().unwrap().contains("leads out"), "{error}");
}
