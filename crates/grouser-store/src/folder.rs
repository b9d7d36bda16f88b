//! The folder that a campaign writes: one program at a time, one file for each shard.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use grouser::document::table::Table;

use crate::error::{ShardFault, StoreError};
use crate::manifest::{self, Manifest, Session};
use crate::part::Part;
use crate::place::{RUNS, STUDY};
use crate::results::{self, Finished, MOST_STUDY_BYTES};
use crate::shards::ShardSet;
use crate::study::{Study, VERSION, difference};
use crate::{place, shard, time};

const LOCK: &str = ".lock";

/// A campaign's folder, open for writing and locked.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    study: Study,
    manifest: Manifest,
    missing: ShardSet,
    faults: Vec<(u64, ShardFault)>,
    /// Files beside the shards that were written anew.
    mended: Vec<&'static str>,
    /// Whether this program has a session in the manifest.
    in_session: bool,
    /// Held as long as the folder is open; a kill releases it, too. None on disks without locks.
    lock: Option<File>,
}

impl Folder {
    /// Opens a folder to go on with a campaign, or makes it. What killed programs left unfinished
    /// is removed, and every shard that is there is checked, to the last bit: damaged ones are
    /// missing. A manifest or study that was damaged is [written anew](Self::mended).
    ///
    /// On network disks the lock is as good as theirs: NFS before version 4 may have none.
    ///
    /// * `part`: which of the shards belong here; none for all
    ///
    /// # Errors
    /// [`StoreError`] if it is somebody else's folder, or the disk fails.
    pub fn open(path: &Path, study: &Study, part: Option<Part>) -> Result<Self, StoreError> {
        Self::open_watched(path, study, part, &mut |_, _| {})
    }

    /// The same, with progress: how many of the present shards are checked, and of how many.
    ///
    /// # Errors
    /// The same as [`open`](Self::open).
    pub fn open_watched(
        path: &Path,
        study: &Study,
        part: Option<Part>,
        checked: &mut dyn FnMut(u64, u64),
    ) -> Result<Self, StoreError> {
        if path.exists() && !path.is_dir() {
            return Err(StoreError::NotAFolder(path.to_owned()));
        }
        check_strangers(path)?;
        let runs = path.join(RUNS);
        fs::create_dir_all(path).map_err(StoreError::at("make the folder", path))?;
        let lock = lock(path)?;
        let (manifest, mended) = own_files(path, study, part)?;
        fs::create_dir_all(&runs).map_err(StoreError::at("make the folder", &runs))?;
        place::remove_unfinished(path)?;
        place::remove_unfinished(&runs)?;
        let missing = manifest.all();
        let (path, study) = (path.to_owned(), study.clone());
        let faults = Vec::new();
        let mut folder =
            Self { path, study, manifest, missing, faults, mended, in_session: false, lock };
        folder.check_shards(checked)?;
        Ok(folder)
    }

    /// Finds out which shards are there and whole.
    fn check_shards(&mut self, checked: &mut dyn FnMut(u64, u64)) -> Result<(), StoreError> {
        let runs = self.path.join(RUNS);
        let mut names = place::names(&runs)?;
        names.retain(|name| name.ends_with(".parquet"));
        for (done, name) in names.iter().enumerate() {
            checked(done as u64, names.len() as u64);
            let shard = shard::number_of(name).filter(|shard| self.missing.contains(*shard));
            let Some(shard) = shard else {
                return Err(StoreError::UnknownShard(runs.join(name)));
            };
            match self.check_shard(shard)? {
                Ok(()) => drop(self.missing.remove(shard)),
                Err(fault) => self.faults.push((shard, fault)),
            }
        }
        Ok(())
    }

    /// The fault of a shard's file, if it has one.
    fn check_shard(&self, shard: u64) -> Result<Result<(), ShardFault>, StoreError> {
        let file = self.path.join(RUNS).join(shard::file_name(shard));
        let identity = self.study.identity(shard);
        let read = place::read(&file, identity.most_bytes())?;
        Ok(read.and_then(|bytes| shard::Checked::open(&identity, bytes.into()).map(drop)))
    }

    /// The shards that are not there yet.
    #[must_use]
    pub fn missing(&self) -> &ShardSet {
        &self.missing
    }

    /// Runs of the shards that are there.
    #[must_use]
    pub fn runs_done(&self) -> u64 {
        self.manifest.runs_in(&self.missing.others())
    }

    /// Runs of all shards that belong here.
    #[must_use]
    pub fn runs(&self) -> u64 {
        self.manifest.runs_in(&self.manifest.all())
    }

    /// Shards whose files were there when the folder was opened, but not as they should be. They
    /// are among the [missing](Self::missing), and a new file replaces each.
    #[must_use]
    pub fn faults(&self) -> &[(u64, ShardFault)] {
        &self.faults
    }

    /// Names of files beside the shards that were damaged when the folder was opened, or of an
    /// earlier form, and were written anew. A manifest that was damaged has lost its sessions.
    #[must_use]
    pub fn mended(&self) -> &[&'static str] {
        &self.mended
    }

    /// Whether a second program would be kept out: not every disk has locks.
    #[must_use]
    pub fn is_locked(&self) -> bool {
        self.lock.is_some()
    }

    /// The manifest, as it was when the folder was opened or last written.
    #[must_use]
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// Takes in a shard, from any program. One that is there already stays as it is.
    ///
    /// # Errors
    /// [`StoreError::Shard`] if the bytes are not those of a shard that belongs here, or
    /// [`StoreError::Disk`]; the folder is as it was then.
    pub fn accept(&mut self, shard: u64, bytes: &[u8]) -> Result<(), StoreError> {
        let fault = match shard::check(&self.study, shard, bytes) {
            Ok(()) if self.manifest.has(shard) => None,
            Ok(()) => Some(ShardFault::Foreign("part")),
            Err(fault) => Some(fault),
        };
        if let Some(fault) = fault {
            return Err(StoreError::Shard { shard, fault });
        }
        if !self.missing.contains(shard) {
            return Ok(());
        }
        self.begin_session()?;
        place::put(&self.path.join(RUNS).join(shard::file_name(shard)), bytes)?;
        self.count(shard);
        Ok(())
    }

    /// Takes in a shard that a worker has put in its place by itself.
    ///
    /// # Errors
    /// [`StoreError::Shard`] if its file is not that of a shard that belongs here, or
    /// [`StoreError::Disk`] if there is no file; the shard is missing then as before.
    pub fn adopt(&mut self, shard: u64) -> Result<(), StoreError> {
        if !self.missing.contains(shard) {
            return Ok(());
        }
        self.check_shard(shard)?.map_err(|fault| StoreError::Shard { shard, fault })?;
        self.begin_session()?;
        self.count(shard);
        Ok(())
    }

    /// Records that a shard is there.
    fn count(&mut self, shard: u64) {
        self.missing.remove(shard);
        if let Some(session) = self.manifest.sessions.last_mut() {
            session.shards += 1;
        }
    }

    fn begin_session(&mut self) -> Result<(), StoreError> {
        if self.in_session {
            return Ok(());
        }
        let session = Session { started: time::now(), ended: None, shards: 0 };
        self.manifest.sessions.push(session);
        self.manifest.write(&self.path)?;
        self.in_session = true;
        Ok(())
    }

    /// Writes down when this program stopped, and what it did. A program that is killed cannot, and
    /// nothing but that is lost.
    ///
    /// # Errors
    /// [`StoreError::Disk`].
    pub fn pause(&mut self) -> Result<(), StoreError> {
        if let Some(session) = self.manifest.sessions.last_mut().filter(|_| self.in_session) {
            session.ended = Some(time::now());
            self.manifest.write(&self.path)?;
        }
        Ok(())
    }

    /// Computes the digest and writes it to the manifest.
    ///
    /// # Errors
    /// [`StoreError::Missing`] if shards are; [`StoreError::Damaged`] if one is not as it was taken
    /// in; [`StoreError::OtherDigest`] if the campaign was finished before, with other bytes.
    pub fn finish(&mut self) -> Result<Finished, StoreError> {
        self.finish_reading(&[], &mut |_, _| {})
    }

    /// The same, giving some columns of every shard away on the way: all files are read for the
    /// digest.
    ///
    /// # Errors
    /// The same as [`finish`](Self::finish), and [`StoreError::NoColumn`].
    pub fn finish_reading(
        &mut self,
        columns: &[&str],
        each: &mut dyn FnMut(u64, Table),
    ) -> Result<Finished, StoreError> {
        if !self.missing.is_empty() {
            let all = self.manifest.own_count();
            return Err(StoreError::Missing { shards: self.missing.clone(), all });
        }
        let all = self.manifest.all();
        let finished = results::read(&self.path, &self.manifest, &all, columns, each)?;
        match &self.manifest.digest {
            Some(recorded) if *recorded != finished.digest => {
                return Err(StoreError::OtherDigest {
                    folder: self.path.clone(),
                    recorded: recorded.clone(),
                    found: finished.digest,
                });
            }
            Some(_) if !self.in_session => return Ok(finished),
            _ => {}
        }
        self.manifest.digest = Some(finished.digest.clone());
        self.pause()?;
        if !self.in_session {
            self.manifest.write(&self.path)?;
        }
        Ok(finished)
    }
}

/// Takes the folder for this program alone, until it closes the folder or ends in any way.
fn lock(path: &Path) -> Result<Option<File>, StoreError> {
    let place = path.join(LOCK);
    // Opening a named pipe would wait for a reader.
    if place.metadata().is_ok_and(|found| !found.is_file()) {
        let problem =
            io::Error::new(io::ErrorKind::InvalidInput, "it is no regular file: remove it");
        return Err(StoreError::at("write", &place)(problem));
    }
    let file = OpenOptions::new().create(true).truncate(false).write(true).open(&place);
    let file = file.map_err(StoreError::at("write", &place))?;
    match file.try_lock() {
        Ok(()) => Ok(Some(file)),
        Err(TryLockError::WouldBlock) => Err(StoreError::Locked(path.to_owned())),
        // A disk without locks: better no lock than no campaign.
        Err(TryLockError::Error(_)) => Ok(None),
    }
}

/// Checks that a folder without a manifest has nothing in it but what a campaign leaves that was
/// killed before it had written one.
fn check_strangers(path: &Path) -> Result<(), StoreError> {
    let names = place::names(path)?;
    if names.iter().any(|name| name == manifest::FILE) {
        return Ok(());
    }
    let is_ours = names.iter().any(|name| name == LOCK);
    let known = |name: &str| is_ours && [LOCK, STUDY].contains(&name) || place::is_unfinished(name);
    match names.into_iter().find(|name| !known(name)) {
        None => Ok(()),
        Some(found) => Err(StoreError::NotACampaign { folder: path.to_owned(), found }),
    }
}

/// Checks that a folder has this campaign, of this version and part.
fn check_identity(
    path: &Path,
    manifest: &Manifest,
    study: &Study,
    part: Option<Part>,
) -> Result<(), StoreError> {
    let folder = path.to_owned();
    if manifest.study_sha256 != study.hash {
        let theirs = fs::read_to_string(path.join(STUDY)).unwrap_or_default();
        return Err(StoreError::OtherStudy {
            folder,
            difference: difference(&theirs, &study.text),
        });
    }
    if manifest.version != VERSION {
        let (theirs, ours) = (manifest.version.clone(), VERSION.to_owned());
        return Err(StoreError::OtherVersion { folder, theirs, ours });
    }
    if manifest.part != part {
        let words = |part: Option<Part>| {
            part.map_or_else(|| "the whole campaign".to_owned(), |part| format!("part {part}"))
        };
        return Err(StoreError::OtherPart {
            folder,
            theirs: words(manifest.part),
            ours: words(part),
        });
    }
    Ok(())
}

/// The manifest and the study of a folder: as they are, or written anew, with the names of those.
fn own_files(
    path: &Path,
    study: &Study,
    part: Option<Part>,
) -> Result<(Manifest, Vec<&'static str>), StoreError> {
    let written = place::read(&path.join(STUDY), MOST_STUDY_BYTES);
    let has_study = written.is_ok_and(|it| it.is_ok_and(|bytes| bytes == study.text.as_bytes()));
    match Manifest::read(path) {
        Ok(None) => Ok((begin(path, study, part)?, Vec::new())),
        Ok(Some(manifest)) => {
            check_identity(path, &manifest, study, part)?;
            let mut mended = Vec::new();
            if !has_study {
                place::put(&path.join(STUDY), study.text.as_bytes())?;
                mended.push(STUDY);
            }
            if !manifest.is_of(study, part) {
                return Ok((begin(path, study, part)?, [mended, vec![manifest::FILE]].concat()));
            }
            Ok((manifest, mended))
        }
        Err(StoreError::OldManifest(file)) => {
            let old = Manifest::read_old(path)?.ok_or(StoreError::OldManifest(file))?;
            check_identity(path, &old, study, part)?;
            let renewed = old.renewed();
            if !has_study || !renewed.is_of(study, part) {
                return Ok((begin(path, study, part)?, vec![STUDY, manifest::FILE]));
            }
            renewed.write(path)?;
            Ok((renewed, vec![manifest::FILE]))
        }
        // Without a manifest, the study that is there says whether it is this one.
        Err(StoreError::Manifest { .. }) if has_study => {
            Ok((begin(path, study, part)?, vec![manifest::FILE]))
        }
        Err(error) => Err(error),
    }
}

/// The first files of a folder; the manifest last, for with it the folder is a campaign's.
fn begin(path: &Path, study: &Study, part: Option<Part>) -> Result<Manifest, StoreError> {
    place::put(&path.join(STUDY), study.text.as_bytes())?;
    let manifest = Manifest::new(study, part);
    manifest.write(path)?;
    Ok(manifest)
}
