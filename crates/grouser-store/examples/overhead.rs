//! What a campaign costs beside its runs: the attitude on 10° over sand that is known roughly, from
//! draw to synced file, beside the bare solver on soils that are already made.
//!
//! ```sh
//! cargo run --release -p grouser-store --example overhead -- 1000000
//! ```
//!
//! Both take turns, shard by shard on all cores, so that whatever else the machine does slows both.
//! The answers are compared: they have the same bits.

use std::time::{Duration, Instant};

use grouser::document::table::Values;
use grouser::document::{Kind, Overrides, Source, read_campaign, read_scenario};
use grouser::studies::heading::HeadingStudy;
use grouser_store::{Folder, Study, shard_bytes};
use rayon::prelude::*;

/// Two numbers of a soil whose SI is a factor away.
const STUDY: &str = r#"
schema = "campaign/1"
name = "The attitude on 10 degrees of sand that is known roughly"
study = "heading"
scenario = "traverse-10-deg"
parameter = [
    { key = "soil.friction_angle_deg", distribution = "normal", standard_deviation = 1.5 },
    { key = "soil.density_kg_m3", distribution = "normal", standard_deviation = 30.0 },
]
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let runs: u64 = std::env::args().nth(1).map_or(Ok(20_000), |text| text.parse())?;
    let study = format!("runs = {runs}{STUDY}");
    let campaign = read_campaign(&Source::text("study.toml", study), &Overrides::none())?;
    let scenario = Source::find(Kind::Scenario, "traverse-10-deg")?;
    let scenario = read_scenario(&scenario, &Overrides::none())?.value;
    let place = tempfile::tempdir()?;
    let mut folder = Folder::open(place.path(), &Study::of(&campaign), None)?;
    let (mut bare, mut whole) = (Duration::ZERO, Duration::ZERO);
    let mut memory_before = None;
    for shard in 0..campaign.shards() {
        let studies: Vec<_> = campaign
            .runs_of(shard)
            .map(|run| {
                let values = campaign.ensemble().inputs(run).values;
                let mut study = HeadingStudy::of(&scenario);
                study.soil.friction_angle = values[0].to_radians();
                study.soil.density = values[1];
                study
            })
            .collect();
        let start = Instant::now();
        let yaws: Vec<Option<f64>> = studies
            .par_iter()
            .map(|study| {
                Some(study.on_slope(scenario.ground.plane_slope()?).ok()?.ok()?.yaw.to_degrees())
            })
            .collect();
        bare += start.elapsed();

        let start = Instant::now();
        let bytes = shard_bytes(&campaign, shard, &|| true)?.ok_or("nobody interrupts")?;
        folder.accept(shard, &bytes)?;
        whole += start.elapsed();

        let identity = Study::of(&campaign).identity(shard);
        let checked = grouser_store::shard::Checked::open(&identity, bytes.into())
            .map_err(|fault| fault.to_string())?;
        let table = checked.table(&["yaw_deg"])?;
        let same = matches!(table.column("yaw_deg"), Some(Values::Float(told)) if *told == yaws);
        assert!(same, "shard {shard}: the campaign's yaws are not the solver's");
        memory_before = memory_before.or_else(peak_memory_mb);
    }
    let finished = folder.finish()?;
    let rate = |time: Duration| runs as f64 / time.as_secs_f64();
    println!("bare solver  {:9.0} runs/s", rate(bare));
    println!(
        "campaign     {:9.0} runs/s, {:.1} % of it",
        rate(whole),
        100.0 * rate(whole) / rate(bare)
    );
    if let (Some(first), Some(last)) = (memory_before, peak_memory_mb()) {
        println!("most memory  {first:9.0} MB after the first shard, {last:.0} MB after all");
    }
    println!("digest       {}", finished.digest);
    Ok(())
}

/// The most memory that this process ever had [MB], where the system tells.
fn peak_memory_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse::<f64>().ok().map(|kilobytes| kilobytes / 1000.0)
}
