//! No damage of a finished campaign's folder goes unnoticed: a reader refuses it, or answers as
//! before.

use std::fs;
use std::path::{Path, PathBuf};

use grouser::document::table::{Cell, Values};

use crate::manifest::Manifest;
use crate::study::Study;
use crate::tests::{bytes, finished, numbers, study};
use crate::{Finished, Folder, Part, Results, ShardFault, StoreError, merge};

/// What a reader can be asked, all of it.
type Answers = (Manifest, String, Vec<Values>, Finished, Vec<Vec<(String, Cell)>>);

fn answers(path: &Path) -> Result<Answers, StoreError> {
    let results = Results::open(path)?;
    results.require_all()?;
    results.require_study(&study("a = 1"))?;
    let names: Vec<String> =
        results.manifest().columns.iter().map(|column| column.name.clone()).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let (columns, finished) = results.columns(&names)?;
    let rows =
        (0..results.manifest().runs).map(|run| results.row(run)).collect::<Result<_, _>>()?;
    Ok((results.manifest().clone(), results.study().to_owned(), columns, finished, rows))
}

/// A finished campaign in a folder that goes away with the test.
fn whole() -> (tempfile::TempDir, PathBuf, Study) {
    let (study, place) = (study("a = 1"), tempfile::tempdir().unwrap());
    let path = place.path().join("out");
    finished(&path, &study, None);
    (place, path, study)
}

fn shard(path: &Path, number: u64) -> PathBuf {
    path.join("runs").join(crate::shard::file_name(number))
}

/// All files of a folder but the lock, which is empty and which no reader opens.
fn files(path: &Path) -> Vec<PathBuf> {
    let shards = (0..7).map(|number| shard(path, number));
    shards.chain(["manifest.json", "study.toml"].map(|name| path.join(name))).collect()
}

/// A thousand single bits, spread over all files by a seed; each file gets its share of a hundred
/// and more.
#[test]
fn a_thousand_flipped_bits_are_refused_or_change_nothing() {
    const FLIPS: u64 = 1000;
    let (_place, path, _) = whole();
    let before = answers(&path).unwrap();
    let files = files(&path);
    let (mut state, mut refused) = (4711_u64, 0);
    for flip in 0..FLIPS {
        // Knuth's MMIX generator; its upper bits are good.
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let file = &files[usize::try_from(flip).unwrap() % files.len()];
        let good = fs::read(file).unwrap();
        let bit = usize::try_from(state >> 33).unwrap() % (8 * good.len());
        let mut bad = good.clone();
        bad[bit / 8] ^= 1 << (bit % 8);
        fs::write(file, bad).unwrap();
        match answers(&path) {
            Ok(answer) => assert_eq!(answer, before, "bit {bit} of {}", file.display()),
            Err(error) => {
                assert!(error.to_string().contains(&file.display().to_string()), "{error}");
                assert_eq!(error.mendable_folder(), Some(path.as_path()), "{error}");
                refused += 1;
            }
        }
        fs::write(file, good).unwrap();
    }
    // Every byte of these files is hashed.
    assert_eq!(refused, FLIPS);
    fs::write(path.join(".lock"), "anything").unwrap();
    assert_eq!(answers(&path).unwrap(), before);
}

fn fault(path: &Path) -> ShardFault {
    match answers(path) {
        Err(StoreError::Damaged { fault, .. }) => fault,
        other => panic!("{other:?}"),
    }
}

#[test]
fn exchanged_renamed_and_cut_shards_are_refused() {
    let (place, path, study) = whole();
    let exchange = |one: u64, other: u64| {
        let files = [one, other].map(|number| fs::read(shard(&path, number)).unwrap());
        fs::write(shard(&path, one), &files[1]).unwrap();
        fs::write(shard(&path, other), &files[0]).unwrap();
    };
    exchange(2, 4);
    assert_eq!(fault(&path), ShardFault::Foreign("number"));
    exchange(2, 4);
    answers(&path).unwrap();

    let good = fs::read(shard(&path, 3)).unwrap();
    for length in [0, 1, good.len() / 2, good.len() - 1] {
        fs::write(shard(&path, 3), &good[..length]).unwrap();
        assert_eq!(fault(&path), ShardFault::Damaged, "{length} bytes");
    }
    fs::write(shard(&path, 3), [&good[..], b"more"].concat()).unwrap();
    assert_eq!(fault(&path), ShardFault::Damaged);
    let other = place.path().join("other");
    finished(&other, &crate::tests::study("a = 2"), None);
    fs::copy(shard(&other, 3), shard(&path, 3)).unwrap();
    assert_eq!(fault(&path), ShardFault::Foreign("study"));
    fs::write(shard(&path, 3), &good).unwrap();

    fs::rename(shard(&path, 1), shard(&path, 9)).unwrap();
    assert!(matches!(answers(&path), Err(StoreError::Unfinished { .. })));
    fs::rename(shard(&path, 9), shard(&path, 1)).unwrap();
    assert_eq!(Results::open(&path).unwrap().digest().unwrap().shards, study.shards());
}

/// A shard that says of itself what it should, with other rows: written by a program of the same
/// version that computes otherwise.
#[test]
fn shards_of_other_rows_are_not_those_that_the_campaign_was_finished_with() {
    let (_place, path, study) = whole();
    let mut table = crate::tests::table(&study, 5);
    table.columns[3].1 = Values::Float(vec![Some(1.0); 4]);
    fs::write(shard(&path, 5), crate::shard::encode(&study, 5, &table).unwrap()).unwrap();
    assert!(matches!(answers(&path), Err(StoreError::OtherDigest { .. })));
}

#[test]
fn edited_manifests_and_studies_are_refused() {
    let (_place, path, _) = whole();
    let file = path.join("manifest.json");
    let good = fs::read_to_string(&file).unwrap();
    for (from, to) in [
        ("\"seed\": 1", "\"seed\": 2"),
        ("\"runs\": 25", "\"runs\": 24"),
        ("\"runs\": 25", "\"runs\": 1000000000000"),
        ("\"shard_runs\": 4", "\"shard_runs\": 5"),
        ("\"shards\": 7", "\"shards\": 6"),
        ("\"name\": \"tiny\"", "\"name\": \"huge\""),
        ("\"sinkage_mm\"", "\"sinkage_nm\""),
        ("\"digest\": \"", "\"digest\": \"0"),
        ("\n}", "}"),
        ("grouser.campaign.manifest.v2", "grouser.campaign.manifest.v3"),
    ] {
        assert!(good.contains(from), "{from}");
        fs::write(&file, good.replacen(from, to, 1)).unwrap();
        assert!(matches!(answers(&path), Err(StoreError::Manifest { .. })), "{to}");
        // With a hash that is right for it: what the study or the shards say is something else.
        let edited: Result<Manifest, _> = serde_json::from_str(&good.replacen(from, to, 1));
        let Ok(edited) = edited else { continue };
        fs::write(&file, edited.to_text()).unwrap();
        let is_same = edited.to_text() == good;
        assert_eq!(answers(&path).is_ok(), is_same, "{to}");
    }
    fs::write(&file, &good).unwrap();
    fs::write(path.join("study.toml"), "a = 2").unwrap();
    assert!(matches!(answers(&path), Err(StoreError::StudyChanged(_))));
}

/// What going on with a campaign does about it.
#[test]
fn going_on_mends_manifest_and_study() {
    let (_place, path, study) = whole();
    let before = answers(&path).unwrap();
    let file = path.join("manifest.json");
    let good = fs::read_to_string(&file).unwrap();
    for damaged in ["{", "", &good.replace("\"seed\": 1", "\"seed\": 3")] {
        fs::write(&file, damaged).unwrap();
        let mut folder = Folder::open(&path, &study, None).unwrap();
        assert_eq!((folder.mended(), numbers(&folder)), (&["manifest.json"][..], vec![]));
        folder.finish().unwrap();
        assert_eq!(answers(&path).unwrap().3, before.3);
    }
    fs::write(&file, &good).unwrap();
    fs::write(path.join("study.toml"), "a = 7").unwrap();
    let folder = Folder::open(&path, &study, None).unwrap();
    assert_eq!(folder.mended(), ["study.toml"]);
    assert_eq!(answers(&path).unwrap(), before);
    drop(folder);
    // Another study does not take the folder over, even where its manifest tells nothing.
    fs::write(&file, "{").unwrap();
    let other = crate::tests::study("a = 2");
    assert!(matches!(Folder::open(&path, &other, None), Err(StoreError::Manifest { .. })));
    assert!(shard(&path, 6).exists());
}

/// A manifest as it was written before manifests had a hash: readers refuse it, going on checks all
/// and renews it.
#[test]
fn manifests_without_a_hash_are_renewed() {
    let (_place, path, study) = whole();
    let file = path.join("manifest.json");
    let before = answers(&path).unwrap();
    let text = fs::read_to_string(&file).unwrap().replace("manifest.v2", "manifest.v1");
    let mut lines: Vec<&str> = text.lines().filter(|it| !it.contains("manifest_sha256")).collect();
    let end = lines.len() - 2;
    let last = lines[end].trim_end_matches(',').to_owned();
    lines[end] = &last;
    fs::write(&file, lines.join("\n")).unwrap();
    assert!(matches!(answers(&path), Err(StoreError::OldManifest(_))));
    let mut folder = Folder::open(&path, &study, None).unwrap();
    assert_eq!(folder.mended(), ["manifest.json"]);
    folder.finish().unwrap();
    assert_eq!(answers(&path).unwrap(), before);
}

#[test]
fn a_damaged_part_is_not_merged() {
    let (study, place) = (study("a = 1"), tempfile::tempdir().unwrap());
    let parts: Vec<PathBuf> = ["1", "2"].iter().map(|name| place.path().join(name)).collect();
    for (path, index) in parts.iter().zip(1..) {
        finished(path, &study, Some(Part { index, of: 2 }));
    }
    let file = shard(&parts[1], 3);
    let mut bad = fs::read(&file).unwrap();
    bad[40] ^= 1;
    fs::write(&file, bad).unwrap();
    let error = merge(&place.path().join("all"), &study, &parts, &mut |_, _| {}).unwrap_err();
    assert!(error.to_string().starts_with(&file.display().to_string()), "{error}");
}

/// None of these has an end, or none that is worth waiting for.
#[cfg(unix)]
#[test]
fn devices_pipes_and_huge_files_are_not_read() {
    let (_place, path, study) = whole();
    let file = shard(&path, 2);
    let good = fs::read(&file).unwrap();
    let put = |make: &dyn Fn()| {
        fs::remove_file(&file).unwrap();
        make();
    };
    put(&|| std::os::unix::fs::symlink("/dev/zero", &file).unwrap());
    assert_eq!(fault(&path), ShardFault::NotRegular);
    let pipe = || {
        let made = std::process::Command::new("mkfifo").arg(&file).status().unwrap();
        assert!(made.success());
    };
    put(&pipe);
    assert_eq!(fault(&path), ShardFault::NotRegular);
    // Sparse: it takes no room on the disk.
    put(&|| fs::File::create(&file).unwrap().set_len(1 << 40).unwrap());
    assert!(matches!(fault(&path), ShardFault::TooLarge { .. }));
    // Going on takes it for damaged, and puts the shard in its place.
    let mut folder = Folder::open(&path, &study, None).unwrap();
    assert_eq!(numbers(&folder), [2]);
    folder.accept(2, &bytes(&study, 2)).unwrap();
    folder.finish().unwrap();
    assert_eq!(fs::read(&file).unwrap(), good);
    fs::remove_file(path.join("manifest.json")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", path.join("manifest.json")).unwrap();
    assert!(matches!(answers(&path), Err(StoreError::Manifest { .. })));
}

/// 10¹² runs: what is missing is a range, and nothing walks along it.
#[test]
fn a_campaign_of_a_million_million_runs_is_opened_at_once() {
    let place = tempfile::tempdir().unwrap();
    let large = Study { runs: 1_000_000_000_000, shard_runs: 4, ..study("a = 1") };
    let part = Some(Part { index: 1, of: 1000 });
    for part in [part, None] {
        let path = place.path().join(part.map_or("all", |_| "part"));
        let mut folder = Folder::open(&path, &large, part).unwrap();
        let first: Vec<u64> = folder.missing().iter().take(3).collect();
        folder.accept(first[1], &bytes(&large, first[1])).unwrap();
        assert_eq!(folder.runs_done(), 4);
        assert_eq!(folder.runs(), if part.is_some() { 1_000_000_000 } else { large.runs });
        assert!(matches!(folder.finish(), Err(StoreError::Missing { .. })));
        let results = Results::open(&path).unwrap();
        assert_eq!(results.missing().len(), folder.runs() / 4 - 1);
        assert!(matches!(results.digest(), Err(StoreError::Unfinished { .. })));
        assert_eq!(results.columns(&["run"]).unwrap().1.shards, 1);
    }
}
