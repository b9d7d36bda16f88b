//! The inputs to damage: command lines with the files that they read.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, ensure};

use super::files_below;
use super::maps;
use super::verdict::{self, Limits};

/// The checks of an answer.
#[derive(Clone, Debug)]
pub(super) enum Oracle {
    /// Nothing but that the program behaves.
    Sane,
    /// Damage is refused, or the answer is this one.
    Unchanged { stdout: String },
}

/// A command line, and files in the folder where it runs.
#[derive(Clone, Debug)]
pub(super) struct Subject {
    pub(super) name: &'static str,
    pub(super) words: Vec<String>,
    pub(super) files: Vec<(String, Vec<u8>)>,
    pub(super) oracle: Oracle,
}

impl Subject {
    pub(super) fn line(&self) -> String {
        let quoted = self.words.iter().map(|word| format!("{word:?}"));
        std::iter::once("grouser".to_owned()).chain(quoted).collect::<Vec<_>>().join(" ")
    }

    /// The format that was asked for.
    pub(super) fn format(&self) -> Option<&str> {
        let at = self.words.iter().rposition(|word| word == "--format")?;
        self.words.get(at + 1).map(String::as_str)
    }

    /// Writes the files into a folder.
    pub(super) fn write(&self, folder: &Path) -> Result<()> {
        for (name, content) in &self.files {
            let path = folder.join(name);
            if let Some(parent) = path.parent() {
                fs::create_dir_all(parent)?;
            }
            fs::write(&path, content).with_context(|| name.clone())?;
        }
        Ok(())
    }
}

/// Quick lines of every command, each with the names of its files among [`documents`].
const LINES: [(&str, &str, &[&str]); 43] = [
    (
        "wheel-test",
        "wheel-test --soil soil.toml --wheel wheel.toml --load-n 17 --slip-ratio -0.4:0.8:0.4 \
         --format json",
        &["soil.toml", "wheel.toml"],
    ),
    (
        "wheel-test, small wheel",
        "wheel-test --soil small.toml --wheel wheel.toml --load-n 17 --slip-ratio 0.2 --format csv",
        &["small.toml", "wheel.toml"],
    ),
    (
        "wheel-test, stand",
        "wheel-test --soil soil.toml --slip-ratio 0:0.6:0.3 --trials 3 --format csv --out stand",
        &["soil.toml"],
    ),
    (
        "attitude",
        "attitude --soil soil.toml --rover rover.toml --slope-deg 5,15 --format json",
        &["soil.toml", "rover.toml", "wheel.toml"],
    ),
    (
        "attitude, uncertain",
        "attitude --soil uncertain.toml --slope-deg 10 --uncertainty --samples 8 --format csv",
        &["uncertain.toml"],
    ),
    (
        "attitude, samples",
        "attitude --soil sampled.toml --slope-deg 10 --uncertainty --samples 8 --out bands",
        &["sampled.toml", "samples.csv"],
    ),
    (
        "attitude-map",
        "attitude-map --soil soil.toml --slope-deg 5,10 --course-deg 0,45 --out map",
        &["soil.toml"],
    ),
    (
        "traverse",
        "traverse scenario.toml --duration-s 1 --format json",
        &["scenario.toml", "soil.toml", "rover.toml", "wheel.toml"],
    ),
    (
        "traverse, steep",
        "traverse --slope-deg 59 --yaw-deg 90 --rover rover.toml --duration-s 1 --format csv",
        &["rover.toml", "wheel.toml"],
    ),
    (
        "traverse, drive",
        "traverse --drive eq18 --reference-slip-ratio 0.2 --duration-s 0.5 --simulation \
         quasi-steady --out run",
        &[],
    ),
    (
        "card",
        "card --soil uncertain.toml --samples 2 --model ishigami --measured yaws.csv --out \
         card.svg",
        &["uncertain.toml", "yaws.csv"],
    ),
    (
        "card, page",
        "card --soil uncertain.toml --samples 2 --out card.html --format json",
        &["uncertain.toml"],
    ),
    (
        "learn",
        "learn drive.csv --prior uncertain.toml --model ishigami --samples 2 --predict-slope-deg 5 \
         --out learnt --format json",
        &["drive.csv", "uncertain.toml"],
    ),
    (
        "learn, MCAP",
        "learn run.mcap --prior uncertain.toml --model ishigami --samples 2 --predict-slope-deg 5 \
         --format json",
        &["run.mcap", "uncertain.toml"],
    ),
    (
        "import-telemetry, MCAP",
        "import-telemetry run.mcap --mapping mapping.toml --rover rover.toml --out drive.parquet",
        &["run.mcap", "mapping.toml", "rover.toml", "wheel.toml"],
    ),
    (
        "import-telemetry, Parquet",
        "import-telemetry drive.parquet --rover hakuto",
        &["drive.parquet"],
    ),
    (
        "replay",
        "replay drive.csv --soil uncertain.toml --uncertainty --samples 2 --mcap drive.mcap --out \
         replayed --format json",
        &["drive.csv", "uncertain.toml"],
    ),
    (
        "forecast",
        "forecast --soil soil.toml --site moon --slope-deg 5 --model ishigami --samples 2 \
         --discrepancies 2 --scaling reece --ground as-measured,uncertain.toml --out moon",
        &["soil.toml", "uncertain.toml"],
    ),
    (
        "validate",
        "validate --data test.csv --wheel wheel.toml --soil soil.toml --out judged --format json",
        &["test.csv", "wheel.toml", "soil.toml"],
    ),
    (
        "validate, csv",
        "validate --data test.csv --wheel hakuto --soil toyoura --where slip_angle_deg=0 --format \
         csv",
        &["test.csv"],
    ),
    (
        "validate, folder",
        "validate --all --data-dir . --format table",
        &["set.toml", "climbs.toml", "climbs.csv", "test.csv", "soil.toml", "wheel.toml"],
    ),
    (
        "validate, slopes",
        "validate --data climbs.csv --rover rover.toml --soil soil.toml --out judged --format json",
        &["climbs.csv", "rover.toml", "soil.toml"],
    ),
    (
        "calibrate",
        "calibrate --data test.csv --wheel hakuto --soil soil.toml --fit soil.friction_angle_deg \
         --point-fit --format json",
        &["test.csv", "soil.toml"],
    ),
    (
        "calibrate, plates",
        "calibrate --plates plates.csv --soil soil.toml --plate-law bekker --fit \
         soil.pressure_sinkage.k_phi --point-fit",
        &["plates.csv", "soil.toml"],
    ),
    (
        "calibrate, plates and shear",
        "calibrate --plates plates.csv --shear shear.csv --soil soil.toml --plate-law bekker \
         --point-fit",
        &["plates.csv", "shear.csv", "soil.toml"],
    ),
    (
        "import",
        "import lab.csv --delimiter ; --decimal-comma --column load_n=W --column slip_ratio=slip:% \
         --column sinkage_mm=z:cm --out ours.csv",
        &["lab.csv"],
    ),
    (
        "check",
        "check soil.toml wheel.toml rover.toml scenario.toml campaign.toml set.toml uncertain.toml",
        &[
            "soil.toml",
            "wheel.toml",
            "rover.toml",
            "scenario.toml",
            "campaign.toml",
            "set.toml",
            "uncertain.toml",
        ],
    ),
    ("campaign run", "campaign run campaign.toml --out runs --format json", &["campaign.toml"]),
    ("campaign cost", "campaign cost campaign.toml", &["campaign.toml"]),
    (
        "campaign run, traverse",
        "campaign run drives.toml --out runs",
        &["drives.toml", "soil.toml"],
    ),
    (
        "traverse, GeoTIFF",
        "traverse --terrain map.tif --duration-s 0.2 --simulation quasi-steady --format json",
        &["map.tif"],
    ),
    (
        "traverse, npy",
        "traverse --terrain map.npy --set scenario.terrain.cell_size_m=2 --duration-s 0.2 \
         --simulation quasi-steady --format csv",
        &["map.npy"],
    ),
    (
        "traverse, xyz",
        "traverse --terrain map.xyz --duration-s 0.2 --simulation quasi-steady --format json",
        &["map.xyz"],
    ),
    (
        "traverse, classes",
        "traverse classes.toml --format json",
        &["classes.toml", "map.tif", "classes.tif"],
    ),
    (
        "traverse, GeoJSON",
        "traverse zones.toml --format json",
        &["zones.toml", "zones.geojson", "soil.toml"],
    ),
    ("check, zones", "check zones.toml", &["zones.toml", "zones.geojson", "soil.toml"]),
    ("mission, map", "mission mission.toml --nominal --format json", &["mission.toml", "map.xyz"]),
    ("import-urdf", "import-urdf robot.urdf --differential", &["robot.urdf"]),
    ("export-fmu", "export-fmu scenario.toml", &["scenario.toml"]),
    ("presets", "presets toyoura --kind soil", &[]),
    ("schema", "schema soil", &[]),
    ("completions", "completions bash", &[]),
    ("reproduce", "reproduce --samples 2 --out study", &[]),
];

/// All subjects, from files that the program itself makes.
pub(super) fn all(program: &Path) -> Result<Vec<Subject>> {
    let documents = documents(program)?;
    let mut subjects = Vec::new();
    for (name, line, files) in LINES {
        let files = files.iter().map(|wanted| {
            let found = documents.iter().find(|(name, _)| name == wanted);
            found.cloned().with_context(|| format!("{name} reads {wanted}"))
        });
        let files = files.collect::<Result<_>>()?;
        let words = line.split(' ').map(str::to_owned).collect();
        subjects.push(Subject { name, words, files, oracle: Oracle::Sane });
    }
    subjects.extend(of_campaigns(program, &documents)?);
    Ok(subjects)
}

/// Readers of a finished campaign, whose folder is damaged.
fn of_campaigns(program: &Path, documents: &[(String, Vec<u8>)]) -> Result<Vec<Subject>> {
    let folder = tempfile::tempdir()?;
    for (name, content) in documents {
        fs::write(folder.path().join(name), content)?;
    }
    printed(program, "campaign run campaign.toml --out runs", folder.path())?;
    let runs = folder.path().join("runs");
    let mut files = Vec::new();
    for path in files_below(&runs)? {
        let name = path.strip_prefix(folder.path())?.to_string_lossy().into_owned();
        files.push((name, fs::read(&path)?));
    }
    let readers = [
        ("campaign summarise", "campaign summarise runs --format json"),
        ("campaign digest", "campaign digest runs"),
        ("campaign rerun", "campaign rerun runs 7 --format json"),
    ];
    readers
        .into_iter()
        .map(|(name, line)| {
            let stdout = String::from_utf8(printed(program, line, folder.path())?)?;
            let words = line.split(' ').map(str::to_owned).collect();
            Ok(Subject { name, words, files: files.clone(), oracle: Oracle::Unchanged { stdout } })
        })
        .collect()
}

/// What a line of the program prints when it ends well.
fn printed(program: &Path, line: &str, folder: &Path) -> Result<Vec<u8>> {
    let words: Vec<String> = line.split(' ').map(str::to_owned).collect();
    let answer = verdict::run(program, &words, folder, Limits::GENEROUS)?;
    let ended_well = answer.status.is_some_and(|status| status.success());
    ensure!(ended_well, "`grouser {line}`: {}", String::from_utf8_lossy(&answer.stderr));
    Ok(answer.stdout)
}

/// The files that the lines read: presets, a simulated stand's trials, and short ones of our own.
fn documents(program: &Path) -> Result<Vec<(String, Vec<u8>)>> {
    const PRINTED: [(&str, &str); 6] = [
        ("soil.toml", "presets toyoura --kind soil"),
        ("small.toml", "presets cmu-direct90-smooth --kind soil"),
        ("uncertain.toml", "presets toyoura-uncertain --kind soil"),
        ("wheel.toml", "presets hakuto --kind wheel"),
        ("rover.toml", "presets hakuto --kind rover"),
        (
            "test.csv",
            "wheel-test --load-n 20 --slip-ratio 0:0.6:0.2 --slip-angle-deg 0,15 --trials 3 \
             --format csv",
        ),
    ];
    const WRITTEN: [(&str, &str); 13] = [
        (
            "scenario.toml",
            "schema = \"scenario/1\"\nname = \"a run\"\nrover = \"rover.toml\"\nsoil = \"soil.toml\"\nslope_deg = 10.0\nduration_s = 1.0\n[drive]\nlaw = \"constant\"\nrim_speed_m_s = [0.06, 0.06, 0.05, 0.05]\n[start]\nyaw_deg = 5.0\n",
        ),
        (
            "campaign.toml",
            "schema = \"campaign/1\"\nname = \"a wheel on rough sand\"\nstudy = \"wheel-test\"\nruns = 24\nshard_runs = 8\nseed = 3\n[wheel_test]\nsoil = \"toyoura\"\nwheel = \"hakuto\"\nload_n = 17.0\nslip_ratio = 0.2\n[[parameter]]\nkey = \"soil.friction_angle_deg\"\ndistribution = \"normal\"\nstandard_deviation = 2.0\n",
        ),
        (
            "drives.toml",
            "schema = \"campaign/1\"\nname = \"drives\"\nstudy = \"traverse\"\nruns = 6\nshard_runs = 2\nsampling = \"latin-hypercube\"\n[scenario]\nsoil = \"soil.toml\"\nsimulation = \"quasi-steady\"\nslope_deg = 10.0\nduration_s = 2.0\n[[parameter]]\nkey = \"slope_deg\"\ndistribution = \"uniform\"\nlow = 5.0\nhigh = 12.0\n",
        ),
        (
            "set.toml",
            "schema = \"data-set/1\"\nname = \"our stand\"\nsource = \"simulated\"\nfile = \"test.csv\"\n[[case]]\nname = \"all\"\nwheel = \"wheel.toml\"\nsoils = [\"soil.toml\", \"toyoura\"]\n",
        ),
        ("climbs.csv", include_str!("corpus/climbs.csv")),
        (
            "climbs.toml",
            "schema = \"data-set/1\"\nname = \"our climbs\"\nsource = \"simulated\"\nfile = \"climbs.csv\"\n[[case]]\nname = \"all\"\nrover = \"rover.toml\"\nsoils = [\"soil.toml\", \"toyoura\"]\nfitted = [\"toyoura\"]\n",
        ),
        ("robot.urdf", include_str!("corpus/robot.urdf")),
        ("samples.csv", include_str!("corpus/samples.csv")),
        ("sampled.toml", include_str!("corpus/sampled.toml")),
        ("yaws.csv", "slope_deg,measured,yaw_deg\n5,first run,3.31\n10,second run,5.51\n"),
        ("plates.csv", include_str!("corpus/plates.csv")),
        ("shear.csv", include_str!("corpus/shear.csv")),
        ("lab.csv", include_str!("corpus/lab.csv")),
    ];
    let folder = tempfile::tempdir()?;
    let made = PRINTED
        .into_iter()
        .map(|(name, line)| Ok((name.to_owned(), printed(program, line, folder.path())?)));
    let written = WRITTEN.into_iter().map(|(name, text)| Ok((name.to_owned(), text.into())));
    let maps = maps::files()?.into_iter().map(Ok);
    let drives = drives(program, folder.path())?.into_iter().map(Ok);
    made.chain(written).chain(maps).chain(drives).collect()
}

/// The telemetry of a drive as CSV and Parquet, a run as MCAP, and a mapping for that.
fn drives(program: &Path, folder: &Path) -> Result<Vec<(String, Vec<u8>)>> {
    fs::write(folder.join("drive.csv"), drive())?;
    printed(program, "traverse --duration-s 1 --simulation quasi-steady --mcap run.mcap", folder)?;
    printed(program, "import-telemetry drive.csv --rover hakuto --out drive.parquet", folder)?;
    let mapping = printed(program, "import-telemetry --print-mapping grouser", folder)?;
    fs::write(folder.join("mapping.toml"), mapping)?;
    let names = ["drive.csv", "drive.parquet", "run.mcap", "mapping.toml"];
    let file = |name: &str| Ok((name.to_owned(), fs::read(folder.join(name))?));
    names.into_iter().map(file).collect()
}

/// Telemetry of some seconds along a slope.
fn drive() -> String {
    let row = |step: i32| {
        let time = 0.2 * f64::from(step);
        format!("{time:.1},5.98,0.31,3,0.0112,-0.0006,-0.02,0.55,0.55,0.21,0.22\n")
    };
    let header = "time_s,roll_deg,pitch_deg,yaw_deg,vo_dx_m,vo_dy_m,vo_dyaw_deg,wheel_speed_rad_s_front-left,\
                  wheel_speed_rad_s_rear-right,wheel_torque_nm_front-left,rear-right.torque_nm\n";
    header.to_owned() + &(0..40).map(row).collect::<String>()
}
