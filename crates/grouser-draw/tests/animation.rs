//! What an animation promises: the same bytes for the same run, files that other programs read, and
//! pictures of whatever becomes of a rover.

mod gltf;

use std::path::Path;

use grouser::document::{Kind, LoadedScenario, Overrides, Source, read_scenario};
use grouser::simulation::{Outcome, Run, Trajectory};
use grouser_draw::style::{Ground, Role};
use grouser_draw::{Animation, Form, Shown};
use serde_json::Value;

use gltf::{chunks, number, numbers};

fn scenario(settings: &[&str]) -> LoadedScenario {
    let settings: Vec<String> = settings.iter().map(ToString::to_string).collect();
    let overrides = Overrides::parse_flags("--set", &settings).expect("good settings");
    let source = Source::find(Kind::Scenario, "traverse-10-deg").expect("a preset");
    read_scenario(&source, &overrides).expect("a good scenario")
}

fn run_of(scenario: &LoadedScenario) -> Trajectory {
    let run = Run::new(&scenario.value).expect("a good scenario");
    run.to_end().expect("a run with an outcome")
}

fn animation(settings: &[&str]) -> (Animation, Trajectory) {
    let scenario = scenario(settings);
    let run = run_of(&scenario);
    let shown = Shown { name: "rover", run: &run, scenario: &scenario.value };
    (Animation::of("A <rover> & its slope", &[shown]), run)
}

fn short() -> (Animation, Trajectory) {
    animation(&["scenario.duration_s=2"])
}

#[test]
fn the_same_run_has_the_same_bytes() {
    let [once, again] = [short().0, short().0];
    for form in [Form::Gif, Form::Html, Form::Glb, Form::Svg, Form::Png] {
        let [once, again] =
            [&once, &again].map(|it| it.to_bytes(form, &mut || ()).expect("no ffmpeg is needed"));
        assert!(once == again && once.len() > 1000, "{form:?}");
    }
}

/// A player shows each picture for its time, on top of those before: put together they are what was
/// drawn, in the colours of the table.
#[test]
fn a_gif_shows_every_picture_in_its_time() {
    let (animation, run) = short();
    let mut asked = 0;
    let gif = animation.to_gif(Ground::Light, &mut || asked += 1);
    assert_eq!((asked, animation.len()), (21, 21));
    let mut decoder = gif::DecodeOptions::new();
    decoder.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = decoder.read_info(&gif[..]).expect("a GIF");
    let [width, height] = [decoder.width(), decoder.height()].map(usize::from);
    let mut shown = vec![[0_u8; 4]; width * height];
    let (mut count, mut time) = (0, 0.0);
    while let Some(frame) = decoder.read_next_frame().expect("whole") {
        let across = usize::from(frame.width);
        for (index, pixel) in frame.buffer.as_chunks::<4>().0.iter().enumerate() {
            let x = usize::from(frame.left) + index % across;
            let y = usize::from(frame.top) + index / across;
            if pixel[3] > 0 {
                shown[y * width + x] = *pixel;
            }
        }
        count += 1;
        time += f64::from(frame.delay) / 100.0;
    }
    assert_eq!(count, animation.len());
    // The end stays for two seconds, a twenty times of a picture's.
    assert!((time - run.last().time - 2.0).abs() < 0.11, "{time}");
    let drawn = animation.picture(animation.len() - 1, Ground::Light).to_picture(5.0);
    assert_eq!([drawn.width as usize, drawn.height as usize], [width, height]);
    let far = |a: &[u8; 3], b: &[u8; 4]| {
        (0..3).map(|k| i32::from(a[k].abs_diff(b[k]))).max().unwrap_or(0)
    };
    let worst = drawn.pixels.iter().zip(&shown).map(|(a, b)| far(a, b));
    assert!(worst.clone().filter(|gap| *gap > 24).count() < width * height / 500);
    // An arrow has its own colour, not one nearby.
    let orange = Role::Force.on(Ground::Light).bytes();
    assert!(shown.iter().any(|pixel| pixel[..3] == orange));
}

#[test]
fn a_page_needs_nothing_from_elsewhere_and_has_controls_with_names() {
    let page = short().0.to_html();
    for outside in ["http:", "https:", "src=", "@import", "url("] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(page.contains("<title>A &lt;rover&gt; &amp; its slope</title>"));
    assert!(page.contains("aria-label=\"Time of the run\"") && page.contains(">Play</button>"));
    assert!(page.contains("prefers-reduced-motion") && page.contains("prefers-color-scheme"));
    let data = page.split("id=\"data\">").nth(1).and_then(|rest| rest.split("</script>").next());
    let data: Value = serde_json::from_str(data.expect("its data")).expect("JSON");
    assert_eq!(data["frames"].as_array().map(Vec::len), Some(21));
    assert_eq!(data["light"].as_array().map(Vec::len), Some(Role::ALL.len()));
    assert_eq!(data["clock"][20], "2.0 s");
}

#[test]
fn a_scene_in_three_dimensions_is_valid_gltf() {
    let (animation, run) = short();
    let file = animation.to_glb();
    let (document, bytes) = chunks(&file);
    let accessors = document["accessors"].as_array().expect("accessors");
    for (index, accessor) in accessors.iter().enumerate() {
        let Some(least) = accessor.get("min") else { continue };
        let (values, size) = numbers(&document, bytes, index);
        for k in 0..size {
            let part = || values[k..].iter().step_by(size).copied();
            let ends =
                [part().fold(f32::INFINITY, f32::min), part().fold(-f32::INFINITY, f32::max)];
            let listed = [&least[k], &accessor["max"][k]];
            for (listed, end) in listed.iter().zip(ends) {
                // Read back, a number may be off by its last digit as a double; in singles it is
                // not.
                let far = listed.as_f64().expect("a number") - f64::from(end);
                assert!(far.abs() <= 1e-12 * f64::from(end).abs(), "{listed} {end}");
            }
        }
    }
    for mesh in document["meshes"].as_array().expect("meshes") {
        for primitive in mesh["primitives"].as_array().expect("primitives") {
            let corners = &accessors[number(&primitive["attributes"]["POSITION"])]["count"];
            let Some(indices) = primitive.get("indices") else { continue };
            let accessor = &accessors[number(indices)];
            let view = &document["bufferViews"][number(&accessor["bufferView"])];
            let start = number(&view["byteOffset"]);
            let indices = &bytes[start..start + 4 * number(&accessor["count"])];
            let most = indices.as_chunks::<4>().0.iter().map(|it| u32::from_le_bytes(*it)).max();
            assert!((most.expect("triangles") as usize) < number(corners));
        }
    }
    let motion = &document["animations"][0];
    let mut paths = Vec::new();
    for channel in motion["channels"].as_array().expect("channels") {
        let sampler = &motion["samplers"][number(&channel["sampler"])];
        let (times, _) = numbers(&document, bytes, number(&sampler["input"]));
        assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
        let (values, size) = numbers(&document, bytes, number(&sampler["output"]));
        assert_eq!(values.len(), size * times.len());
        let path = channel["target"]["path"].as_str().expect("a path");
        if path == "rotation" {
            for quaternion in values.as_chunks::<4>().0 {
                let length = quaternion.iter().map(|part| part * part).sum::<f32>();
                assert!((length - 1.0).abs() < 1e-5, "{quaternion:?}");
            }
        }
        paths.push((path.to_owned(), channel["target"]["node"].clone(), values));
    }
    // The rover, four wheels and their arrows move; tracks appear by their size.
    let count = |path: &str| paths.iter().filter(|(other, ..)| other == path).count();
    assert_eq!((count("translation"), count("rotation")), (9, 9));
    assert!(count("scale") > 7);
    // The rover ends where its run does.
    let nodes = document["nodes"].as_array().expect("nodes");
    let rover = nodes.iter().position(|node| node["name"] == "rover").expect("the rover");
    let moved = paths.iter().find(|(path, node, _)| path == "translation" && number(node) == rover);
    let places = &moved.expect("it moves").2;
    let end = run.last().state.position;
    let [x, y] = [places[places.len() - 3], places[places.len() - 2]].map(f64::from);
    assert!((x - end.x).abs() < 1e-6 && (y - end.y).abs() < 1e-6, "{x} {y}");
}

/// A wheel turns by the rim speed over its radius, times the time.
#[test]
fn wheels_turn_as_fast_as_in_the_run() {
    let (animation, run) = short();
    let speed = run.last().wheels[0].wheel_speed;
    let file = animation.to_glb();
    let (document, bytes) = chunks(&file);
    let nodes = document["nodes"].as_array().expect("nodes");
    let wheel = nodes.iter().position(|node| node["name"] == "front-left wheel").expect("a wheel");
    let motion = &document["animations"][0];
    let channels = motion["channels"].as_array().expect("channels");
    let channel = channels.iter().find(|it| number(&it["target"]["node"]) == wheel);
    let sampler = &motion["samplers"][number(&channel.expect("it turns")["sampler"])];
    let (values, _) = numbers(&document, bytes, number(&sampler["output"]));
    let [.., _, sin, _, cos] = values[..] else { panic!("no rotation") };
    let turned = 2.0 * f64::from(sin).atan2(f64::from(cos));
    assert!((turned - 2.0 * speed).abs() < 1e-4, "{turned} of {}", 2.0 * speed);
}

/// Viewers light a face from the side from which its corners are counterclockwise.
#[test]
fn tracks_face_upwards_whichever_way_the_rover_goes() {
    for speed in [0.06, -0.06] {
        let speed = format!("scenario.drive.rim_speed_m_s={speed}");
        let file = animation(&["scenario.duration_s=2", &speed]).0.to_glb();
        let (document, bytes) = chunks(&file);
        let meshes = document["meshes"].as_array().expect("meshes");
        let tracks: Vec<&Value> = meshes.iter().filter(|mesh| mesh["name"] == "track").collect();
        assert!(!tracks.is_empty(), "{speed}");
        for track in tracks {
            let corners = number(&track["primitives"][0]["attributes"]["POSITION"]);
            let (places, _) = numbers(&document, bytes, corners);
            for [ax, ay, _, bx, by, _, cx, cy, ..] in places.as_chunks::<12>().0 {
                assert!((bx - ax) * (cy - ay) > (by - ay) * (cx - ax), "{speed}");
            }
        }
    }
}

/// The extremes: level and steep ground, a rover that is stuck, slides, tips over, turns on the
/// spot or drives out of sight.
#[test]
fn whatever_becomes_of_a_rover_can_be_drawn() {
    type Expected = fn(&Outcome) -> bool;
    let cases: [(&[&str], Expected); 7] = [
        (&["scenario.slope_deg=0"], |it| *it == Outcome::Completed),
        (&["scenario.slope_deg=30"], |_| true),
        (&["scenario.slope_deg=24", "scenario.start.yaw_deg=80", "scenario.duration_s=60"], |_| {
            true
        }),
        (&["scenario.slope_deg=35"], |it| matches!(it, Outcome::Sliding { .. })),
        (&["scenario.slope_deg=60"], |it| matches!(it, Outcome::TippedOver { .. })),
        (&["scenario.duration_s=0.001"], |it| *it == Outcome::Completed),
        (
            &[
                "scenario.duration_s=2000",
                "scenario.sample_interval_s=5",
                "scenario.simulation=quasi-steady",
            ],
            |_| true,
        ),
    ];
    for (settings, expected) in cases {
        let (animation, run) = animation(settings);
        assert!(expected(&run.outcome), "{settings:?}: {:?}", run.outcome);
        for index in [0, animation.len() / 2, animation.len() - 1] {
            let svg = animation.picture(index, Ground::Dark).to_svg();
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{settings:?}");
        }
        let last = animation.picture(animation.len() - 1, Ground::Light).to_svg();
        let name = run.outcome.name().replace('_', " ");
        assert_eq!(last.contains(&format!("{name} after")), run.outcome != Outcome::Completed);
        assert!(chunks(&animation.to_glb()).0["nodes"].is_array());
    }
}

/// Two rovers have a lane each, and a row of numbers each.
#[test]
fn several_runs_are_drawn_beside_each_other() {
    let scenarios = [scenario(&["scenario.duration_s=1"]), scenario(&["scenario.duration_s=2"])];
    let runs = scenarios.each_ref().map(run_of);
    let shown = |k: usize, name| Shown { name, run: &runs[k], scenario: &scenarios[k].value };
    let animation = Animation::of("Two", &[shown(0, "first"), shown(1, "second")]);
    assert_eq!(animation.len(), 21);
    let svg = animation.picture(20, Ground::Light).to_svg();
    assert!(svg.contains(">first</text>") && svg.contains(">second</text>"));
}

#[test]
fn the_ending_of_a_name_decides_the_form() {
    assert_eq!(Form::of_path(Path::new("a/run.GIF")), Ok(Form::Gif));
    assert_eq!(Form::of_path(Path::new("run.glb")), Ok(Form::Glb));
    for unknown in ["run", "run.avi", ".gif"] {
        let error = Form::of_path(Path::new(unknown)).expect_err("no form").to_string();
        assert!(Form::ALL.iter().all(|form| error.contains(&format!("`.{}`", form.ending()))));
    }
}

/// A run over ripples from a start of its own, 0.5 m for each 10 s.
fn over_ripples(yaw: f64, more: &str) -> (LoadedScenario, Trajectory) {
    let text = format!(
        "schema = \"scenario/1\"\nname = \"s\"\nsimulation = \"quasi-steady\"\n\
         [start]\nyaw_deg = {yaw:?}\n[terrain]\nsurface = \"ripple\"\namplitude_m = 0.03\n\
         wavelength_m = 1.0\nstart_m = [3e5, 200.0]\n"
    );
    let text = format!("{more}\n{text}");
    let overrides = Overrides::none();
    let scenario = read_scenario(&Source::text("s", text), &overrides).expect("a scenario");
    let run = run_of(&scenario);
    (scenario, run)
}

fn film(run: &(LoadedScenario, Trajectory)) -> Animation {
    Animation::of("Ripples", &[Shown { name: "rover", run: &run.1, scenario: &run.0.value }])
}

/// Ground with heights: every form is written, from every start, and the same run has the same
/// bytes.
#[test]
fn a_run_over_heights_is_drawn_in_every_form() {
    for yaw in [0.0, 90.0, -137.0] {
        let run = over_ripples(yaw, "duration_s = 3");
        let [once, again] = [film(&run), film(&run)];
        for form in [Form::Gif, Form::Html, Form::Glb, Form::Svg, Form::Png] {
            let [once, again] = [&once, &again]
                .map(|it| it.to_bytes(form, &mut || ()).expect("no ffmpeg is needed"));
            assert!(once == again && once.len() > 1000, "{form:?}");
        }
        let svg = once.picture(once.len() - 1, Ground::Dark).to_svg();
        for text in ["from above, north up", "from the south-east", "along the way", "downhill"] {
            assert!(svg.contains(text), "{text}");
        }
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "yaw {yaw}");
    }
}

/// The way behind the rover grows, and what stays does not: the first picture has none of it.
#[test]
fn the_way_is_drawn_behind_the_rover() {
    let animation = film(&over_ripples(0.0, "duration_s = 10"));
    let path = Role::Path.on(Ground::Light).code();
    let pieces = |index: usize| {
        let svg = animation.picture(index, Ground::Light).to_svg();
        svg.matches(&format!("stroke=\"{path}\"")).count()
    };
    let counts = [0, animation.len() / 2, animation.len() - 1].map(pieces);
    assert!(counts[0] < counts[1] && counts[1] < counts[2], "{counts:?}");
}

/// Runs on the same ground have a view each, and one from above for all of them.
#[test]
fn several_runs_over_heights_have_a_view_each() {
    let runs = [over_ripples(0.0, "duration_s = 5"), over_ripples(30.0, "duration_s = 10")];
    let names = ["first", "second"];
    let shown: Vec<Shown<'_>> = names
        .into_iter()
        .zip(&runs)
        .map(|(name, (scenario, run))| Shown { name, run, scenario: &scenario.value })
        .collect();
    let animation = Animation::of("Two", &shown);
    let svg = animation.picture(animation.len() - 1, Ground::Light).to_svg();
    assert_eq!(svg.matches("from above, north up").count(), 1);
    for name in names {
        // Above its view, and in the row of its numbers.
        assert_eq!(svg.matches(&format!(">{name}</text>")).count(), 2, "{name}");
    }
}

/// A scene over heights has the ground's heights, and the rover ends in its place, leaning as it
/// stands.
#[test]
fn a_scene_over_heights_has_them() {
    let run = over_ripples(0.0, "duration_s = 10");
    let file = film(&run).to_glb();
    let (document, bytes) = chunks(&file);
    let nodes = document["nodes"].as_array().expect("nodes");
    let named = |name: &str| nodes.iter().position(|node| node["name"] == name).expect("a node");
    let ground = number(&nodes[named("ground")]["mesh"]);
    let corners = &document["meshes"][ground]["primitives"][0]["attributes"]["POSITION"];
    let accessor = &document["accessors"][number(corners)];
    let [low, high] = ["min", "max"].map(|end| accessor[end][2].as_f64().expect("a number"));
    assert!((low + 0.03).abs() < 2e-3 && (high - 0.03).abs() < 2e-3, "{low} {high}");
    let motion = &document["animations"][0];
    let last = |node: usize, path: &str| {
        let channels = motion["channels"].as_array().expect("channels");
        let channel = channels
            .iter()
            .find(|it| number(&it["target"]["node"]) == node && it["target"]["path"] == path);
        let sampler = &motion["samplers"][number(&channel.expect("it moves")["sampler"])];
        let (values, size) = numbers(&document, bytes, number(&sampler["output"]));
        values[values.len() - size..].iter().map(|it| f64::from(*it)).collect::<Vec<_>>()
    };
    let end = run.1.last();
    let standing = end.standing().expect("it stands");
    let place = last(named("rover"), "translation");
    assert!((place[0] - end.state.position.x).abs() < 1e-6, "{place:?}");
    assert!((place[2] - standing.height).abs() < 1e-6, "{place:?}");
    // The height of the nose, of the rotation's first column.
    let [x, y, z, w] = last(named("rover"), "rotation")[..] else { panic!("a quaternion") };
    let nose = 2.0 * (x * z - w * y);
    assert!((nose - standing.pitch.sin()).abs() < 1e-6, "{nose} {}", standing.pitch);
    assert!(standing.pitch.abs() > 0.01);
}
