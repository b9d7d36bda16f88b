use grouser::studies::simulated_telemetry::SensorModels;
use crate::coverage::*;
use crate::drive::*;

pub(crate) fn probe(trial: &Trial<'_>, repeats: u32, models: SensorModels, own: bool) {
    let truths = learner(trial.hidden).samples(trial.seed, repeats).unwrap();
    let l = learner(trial.prior);
    let keys: Vec<String> = l.keys().map(str::to_owned).collect();
    println!("{keys:?}");
    let k = keys.len();
    let mut sums = vec![0.0; k]; let mut squares = vec![0.0; k]; let mut n = 0.0;
    let spread: Vec<f64> = { let s = l.samples(5, 200).unwrap(); (0..k).map(|p| { let m = s.iter().map(|x| x.values[p].ln()).sum::<f64>()/200.0; (s.iter().map(|x| (x.values[p].ln()-m).powi(2)).sum::<f64>()/200.0).sqrt() }).collect() };
    for (truth, index) in truths.iter().zip(0u64..) {
        let mut sample = truth.sample;
        if !own { sample.soil.discrepancy = None; }
        let mut drive = trial.drive(&sample, index);
        if LEGS.iter().any(|leg| drive.leg(*leg).is_none()) { continue; }
        let mut l = learner(trial.prior);
        let mut lessons = vec![];
        for r in drive.seen(models, index) { lessons.extend(l.update(r)); }
        let after = l.samples(7, 200).unwrap();
        let z: Vec<f64> = (0..k).map(|p| { let m = after.iter().map(|x| x.values[p].ln()).sum::<f64>()/200.0; let s = (after.iter().map(|x| (x.values[p].ln()-m).powi(2)).sum::<f64>()/200.0).sqrt(); (truth.values[p].ln()-m)/s }).collect();
        let nar: Vec<f64> = (0..k).map(|p| { let m = after.iter().map(|x| x.values[p].ln()).sum::<f64>()/200.0; (after.iter().map(|x| (x.values[p].ln()-m).powi(2)).sum::<f64>()/200.0).sqrt() / spread[p]}).collect();
        for p in 0..k { sums[p] += z[p]; squares[p] += z[p]*z[p]; }
        n += 1.0;
        let last = lessons.last().unwrap();
        let mean_score: f64 = lessons.iter().map(|l| l.scores[0]).sum::<f64>() / lessons.len() as f64;
        let rms: f64 = (lessons.iter().map(|l| l.scores[0].powi(2)).sum::<f64>() / lessons.len() as f64).sqrt();
        println!("z {z:.2?} narrowed {nar:.2?} slip {:.3} {:.3} score {mean_score:.2} rms {rms:.2}", last.slip_ratio, last.expected_slip);
    }
    println!("mean z {:.2?}", sums.iter().map(|s| s/n).collect::<Vec<_>>());
    println!("rms z {:.2?}", squares.iter().map(|s| (s/n).sqrt()).collect::<Vec<_>>());
}
