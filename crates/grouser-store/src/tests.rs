//! Tests of a campaign's folder, with made-up rows.

use std::fs;
use std::path::{Path, PathBuf};

use grouser::document::campaign::{Column, Role};
use grouser::document::table::{Cell, ColumnKind, Table, Values};
use sha2::{Digest as _, Sha256};

use crate::shard::{Checked, check, encode, file_name};
use crate::study::{Study, hex};
use crate::{Folder, Part, Results, ShardFault, StoreError, merge};

fn column(name: &str, kind: ColumnKind, role: Role) -> Column {
    Column { name: name.into(), kind, role }
}

/// A study of 25 runs in shards of 4.
pub(crate) fn study(text: &str) -> Study {
    Study {
        name: "tiny".into(),
        text: text.into(),
        hash: hex(&Sha256::digest(text.as_bytes())),
        seed: 1,
        runs: 25,
        shard_runs: 4,
        columns: vec![
            column("run", ColumnKind::Whole, Role::Index),
            column("soil.stress_peak.a0", ColumnKind::Float, Role::Input),
            column("status", ColumnKind::Text, Role::Status),
            column("sinkage_mm", ColumnKind::Float, Role::Result),
        ],
    }
}

pub(crate) fn table(study: &Study, shard: u64) -> Table {
    let runs = || study.runs_of(shard);
    let stuck = |run: &u64| run % 3 == 1;
    let float = |run: u64| (run as f64).sqrt();
    let columns = [
        Values::Whole(runs().map(Some).collect()),
        Values::Float(runs().map(|run| Some(float(run))).collect()),
        Values::Text(
            runs().map(|run| Some(if stuck(&run) { "stuck" } else { "ok" }.into())).collect(),
        ),
        Values::Float(runs().map(|run| (!stuck(&run)).then(|| 7.5 * float(run))).collect()),
    ];
    let names = study.columns.iter().map(|column| column.name.clone());
    Table { columns: names.zip(columns).collect() }
}

pub(crate) fn bytes(study: &Study, shard: u64) -> Vec<u8> {
    encode(study, shard, &table(study, shard)).unwrap()
}

pub(crate) fn numbers(folder: &Folder) -> Vec<u64> {
    folder.missing().iter().collect()
}

fn fill(folder: &mut Folder, study: &Study) {
    for shard in folder.missing().clone().iter() {
        folder.accept(shard, &bytes(study, shard)).unwrap();
    }
}

/// A finished folder and its digest.
pub(crate) fn finished(path: &Path, study: &Study, part: Option<Part>) -> String {
    let mut folder = Folder::open(path, study, part).unwrap();
    fill(&mut folder, study);
    folder.finish().unwrap().digest
}

#[test]
fn what_is_written_is_read() {
    let study = study("a = 1");
    let names: Vec<&str> = study.columns.iter().map(|column| column.name.as_str()).collect();
    for shard in 0..study.shards() {
        let file = bytes::Bytes::from(bytes(&study, shard));
        let checked = Checked::open(&study.identity(shard), file).unwrap();
        assert_eq!(checked.table(&names).unwrap(), table(&study, shard));
    }
}

#[test]
fn the_same_rows_are_the_same_bytes() {
    let study = study("a = 1");
    assert_eq!(bytes(&study, 3), bytes(&study, 3));
    assert_ne!(bytes(&study, 3), bytes(&study, 2));
}

/// To the last bit: a changed byte anywhere, and an end anywhere.
#[test]
fn every_damage_is_noticed() {
    let study = study("a = 1");
    let whole = bytes(&study, 6);
    check(&study, 6, &whole).unwrap();
    for place in 0..whole.len() {
        let mut damaged = whole.clone();
        damaged[place] ^= 1 << (place % 8);
        assert_eq!(check(&study, 6, &damaged), Err(ShardFault::Damaged), "byte {place}");
        assert_eq!(check(&study, 6, &whole[..place]), Err(ShardFault::Damaged), "end {place}");
    }
}

#[test]
fn a_shard_of_something_else_is_foreign() {
    let (study, other) = (study("a = 1"), study("a = 2"));
    assert_eq!(check(&study, 2, &bytes(&other, 2)), Err(ShardFault::Foreign("study")));
    assert_eq!(check(&study, 2, &bytes(&study, 3)), Err(ShardFault::Foreign("number")));
    let longer = Study { runs: 24, ..study.clone() };
    let rows = ShardFault::Rows { found: 1, expected: 0 };
    assert_eq!(check(&longer, 6, &bytes(&study, 6)), Err(rows));
}

#[test]
fn the_digest_is_that_of_the_files_in_order_whatever_the_order_they_came_in() {
    let (study, place) = (study("a = 1"), tempfile::tempdir().unwrap());
    let (there, back) = (place.path().join("there"), place.path().join("back"));
    let digest = finished(&there, &study, None);
    let mut folder = Folder::open(&back, &study, None).unwrap();
    for shard in (0..study.shards()).rev() {
        folder.accept(shard, &bytes(&study, shard)).unwrap();
        folder.accept(shard, &bytes(&study, shard)).unwrap();
    }
    assert_eq!(folder.finish().unwrap().digest, digest);
    let files = (0..study.shards()).map(|shard| there.join("runs").join(file_name(shard)));
    let all: Vec<u8> = files.flat_map(|file| fs::read(file).unwrap()).collect();
    assert_eq!(hex(&Sha256::digest(&all)), digest);
}

#[test]
fn a_folder_goes_on_where_it_was_left() {
    let (study, place) = (study("a = 1"), tempfile::tempdir().unwrap());
    let digest = finished(&place.path().join("whole"), &study, None);
    let path = place.path().join("again");
    let runs = path.join("runs");
    for shard in [5, 0, 6] {
        let mut folder = Folder::open(&path, &study, None).unwrap();
        folder.accept(shard, &bytes(&study, shard)).unwrap();
        let unfinished = folder.finish().unwrap_err();
        assert!(matches!(unfinished, StoreError::Missing { .. }), "{unfinished}");
    }
    let cut = fs::read(runs.join(file_name(5))).unwrap();
    fs::write(runs.join(file_name(5)), &cut[..cut.len() / 2]).unwrap();
    fs::write(runs.join(file_name(1)), "").unwrap();
    fs::write(runs.join(".part-000002.parquet.partial-77"), "half").unwrap();
    fs::write(path.join(".manifest.json.partial-77"), "{").unwrap();
    let mut folder = Folder::open(&path, &study, None).unwrap();
    assert_eq!(folder.faults(), [(1, ShardFault::Damaged), (5, ShardFault::Damaged)]);
    assert_eq!((numbers(&folder), folder.runs_done()), (vec![1, 2, 3, 4, 5], 5));
    fill(&mut folder, &study);
    assert_eq!(folder.finish().unwrap().digest, digest);
    let unfinished = |folder: &Path| {
        fs::read_dir(folder)
            .unwrap()
            .any(|it| it.unwrap().path().to_string_lossy().contains("partial"))
    };
    assert!(!unfinished(&runs) && !unfinished(&path));
    assert_eq!(folder.manifest().sessions.len(), 4);
}

/// A worker that shares the disk puts its shards in their places like this.
#[test]
fn a_shard_that_is_in_its_place_already_is_adopted() {
    let (study, place) = (study("a = 1"), tempfile::tempdir().unwrap());
    let digest = finished(&place.path().join("whole"), &study, None);
    let path = place.path().join("shared");
    let mut folder = Folder::open(&path, &study, None).unwrap();
    for shard in folder.missing().clone().iter() {
        let file = path.join("runs").join(file_name(shard));
        assert!(matches!(folder.adopt(shard), Err(StoreError::Disk { .. })));
        fs::write(&file, "half").unwrap();
        assert!(matches!(folder.adopt(shard), Err(StoreError::Shard { .. })));
        assert!(folder.missing().contains(shard));
        fs::write(&file, bytes(&study, shard)).unwrap();
        folder.adopt(shard).unwrap();
    }
    assert_eq!(folder.manifest().sessions[0].shards, study.shards());
    assert_eq!(folder.finish().unwrap().digest, digest);
}

#[test]
fn a_finished_folder_is_left_as_it_is() {
    let (study, place) = (study("a = 1"), tempfile::tempdir().unwrap());
    let digest = finished(place.path(), &study, None);
    let manifest = || fs::read(place.path().join("manifest.json")).unwrap();
    let before = manifest();
    let mut folder = Folder::open(place.path(), &study, None).unwrap();
    assert_eq!((numbers(&folder), folder.runs_done()), (vec![], 25));
    assert_eq!(folder.finish().unwrap().digest, digest);
    assert_eq!(manifest(), before);
}

#[test]
fn a_folder_is_for_one_program_at_a_time() {
    let (study, place) = (study("a = 1"), tempfile::tempdir().unwrap());
    let first = Folder::open(place.path(), &study, None).unwrap();
    assert!(first.is_locked());
    let second = Folder::open(place.path(), &study, None);
    assert!(matches!(second, Err(StoreError::Locked(_))));
    drop(first);
    Folder::open(place.path(), &study, None).unwrap();
}

#[test]
fn another_studys_folder_is_refused() {
    let place = tempfile::tempdir().unwrap();
    finished(place.path(), &study("a = 1\nb = 3"), None);
    let error = Folder::open(place.path(), &study("a = 2\nb = 3"), None).unwrap_err();
    assert!(error.to_string().contains("a is 1 there, 2 here"), "{error}");
    let part = Some(Part { index: 1, of: 2 });
    let error = Folder::open(place.path(), &study("a = 1\nb = 3"), part).unwrap_err();
    assert!(error.to_string().contains("for the whole campaign, not for part 1/2"), "{error}");
}

#[test]
fn what_is_no_campaigns_is_not_touched() {
    let (study, place) = (study("a = 1"), tempfile::tempdir().unwrap());
    fs::write(place.path().join("study.toml"), "mine").unwrap();
    let error = Folder::open(place.path(), &study, None).unwrap_err();
    assert!(matches!(error, StoreError::NotACampaign { .. }), "{error}");
    assert_eq!(fs::read_dir(place.path()).unwrap().count(), 1);

    let path = place.path().join("out");
    finished(&path, &study, None);
    fs::write(path.join("runs/part-000007.parquet"), "").unwrap();
    let error = Folder::open(&path, &study, None).unwrap_err();
    assert!(matches!(error, StoreError::UnknownShard(_)), "{error}");
}

#[test]
fn shards_that_do_not_belong_are_not_accepted() {
    let (study, place) = (study("a = 1"), tempfile::tempdir().unwrap());
    let part = Part { index: 2, of: 3 };
    let mut folder = Folder::open(place.path(), &study, Some(part)).unwrap();
    assert_eq!(numbers(&folder), [1, 4]);
    for (shard, file) in [(1, bytes(&study, 4)), (0, bytes(&study, 0)), (4, Vec::new())] {
        let error = folder.accept(shard, &file).unwrap_err();
        assert!(matches!(error, StoreError::Shard { .. }), "{error}");
    }
    assert_eq!(numbers(&folder), [1, 4]);
}

#[test]
fn parts_together_are_the_whole() {
    let (study, place) = (study("a = 1"), tempfile::tempdir().unwrap());
    let at = |name: &str| place.path().join(name);
    let digest = finished(&at("whole"), &study, None);
    let mut parts: Vec<PathBuf> = Vec::new();
    for index in 1..=3 {
        parts.push(at(&index.to_string()));
        finished(&parts[parts.len() - 1], &study, Some(Part { index, of: 3 }));
    }
    let merged = |parts: &[PathBuf]| merge(&at("merged"), &study, parts, &mut |_, _| {});
    let error = merged(&parts[..2]).unwrap_err();
    assert_eq!(error.to_string(), "2 of 7 shards are missing: 2, 5");
    let error = merged(&[&parts[..], &parts[1..2]].concat()).unwrap_err();
    assert!(matches!(error, StoreError::Duplicate { shard: 1, .. }), "{error}");
    parts.reverse();
    assert_eq!(merged(&parts).unwrap().digest, digest);
    fs::remove_file(at("2/runs/part-000004.parquet")).unwrap();
    assert!(matches!(merged(&parts), Err(StoreError::Unfinished { .. })));
}

#[test]
fn rows_and_columns_are_found() {
    let (study, place) = (study("a = 1"), tempfile::tempdir().unwrap());
    finished(place.path(), &study, None);
    let results = Results::open(place.path()).unwrap();
    let (columns, finished) = results.columns(&["run", "status"]).unwrap();
    assert_eq!(columns[0], Values::Whole((0..25).map(Some).collect()));
    assert_eq!((columns[1].len(), &finished), (25, &results.digest().unwrap()));
    assert_eq!(Some(finished.digest), results.manifest().digest);
    let row = results.row(13).unwrap();
    assert_eq!(row[0], ("run".into(), Cell::Whole(Some(13))));
    assert_eq!(row[3], ("sinkage_mm".into(), Cell::Float(None)));
    assert!(matches!(results.row(25), Err(StoreError::NoRun { run: 25, runs: 25 })));
    assert!(matches!(results.columns(&["slip"]), Err(StoreError::NoColumn(_))));
}
