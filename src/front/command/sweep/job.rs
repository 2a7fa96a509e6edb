//! A folder in which a sweep is done by shards: what is to be done, and what has been.
//!
//! `sweep.json` says what is to be done, beside a copy of the file. A shard is the worlds whose numbers
//! leave the same rest, so that hard regions are spread. It is written as a whole, under another name
//! first: a shard that is there is complete, whatever was killed, and two processes that do the same
//! shard write the same bytes.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::file::SweepFile;
use crate::command::failure::CommandError;
use sweep::Record;
use sweep::draw::fnv1a;
use sweep::summary::Title;

/// What is to be done.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Plan {
    /// The version of the program.
    version: String,
    /// A checksum of the program's file.
    program: String,
    /// The name of the file with the sweep.
    pub(super) file: String,
    /// A checksum of its text.
    text: String,
    /// The name of the sweep.
    pub(super) name: String,
    pub(super) seed: u64,
    pub(super) worlds: u64,
    pub(super) shards: u64,
    pub(super) goal: Option<f64>,
    /// Real time (s) that each world may take.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) time_limit: Option<f64>,
}

/// A folder in which a sweep is done.
#[derive(Clone, Debug)]
pub(super) struct Job {
    pub(super) folder: PathBuf,
    pub(super) plan: Plan,
}

/// The last line of a shard.
#[derive(Serialize, Deserialize)]
struct End {
    count: u64,
    hash: String,
}

impl Job {
    /// A job for a sweep, in a folder that is made if necessary. If there is one already, it has to be the
    /// same.
    pub(super) fn prepare(
        folder: &Path,
        file: &SweepFile,
        title: &Title,
        worlds: u64,
        shards: Option<u64>,
        time_limit: Option<f64>,
    ) -> Result<Self, CommandError> {
        let plan = Plan {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            program: program()?,
            file: file.name.clone(),
            text: checksum(&file.text),
            name: title.name.clone(),
            seed: title.seed,
            worlds,
            shards: shards
                .unwrap_or_else(|| worlds.div_ceil(20))
                .clamp(1, worlds),
            goal: title.goal,
            time_limit,
        };
        // Workers run elsewhere.
        let folder = std::path::absolute(folder).map_err(|error| written(folder, error))?;
        fs::create_dir_all(folder.join("log")).map_err(|error| written(&folder, error))?;
        let json = folder.join("sweep.json");
        if json.exists() {
            let job = Self::open(&folder)?;
            let wanted = Plan {
                shards: shards.map_or(job.plan.shards, |_| plan.shards),
                file: job.plan.file.clone(),
                ..plan
            };
            if job.plan != wanted {
                return Err(CommandError::Sweep(format!(
                    "{} is of another sweep: take another folder, or remove that one",
                    folder.display()
                )));
            }
            return Ok(job);
        }
        write_whole(&folder.join("sweep.plan"), file.text.as_bytes())?;
        // All of this can be written as JSON.
        let text = serde_json::to_string_pretty(&plan).unwrap_or_default() + "\n";
        write_whole(&json, text.as_bytes())?;
        Ok(Self { folder, plan })
    }

    /// The job in a folder.
    pub(super) fn open(folder: &Path) -> Result<Self, CommandError> {
        let folder = std::path::absolute(folder).map_err(|error| written(folder, error))?;
        let path = folder.join("sweep.json");
        let text = fs::read_to_string(&path).map_err(|error| CommandError::Read {
            path: path.clone(),
            error,
        })?;
        let plan: Plan = serde_json::from_str(&text).map_err(|error| {
            CommandError::Sweep(format!("{} describes no sweep: {error}", path.display()))
        })?;
        Ok(Self { folder, plan })
    }

    /// The copy of the file; an error if this is another program or the copy has been changed.
    pub(super) fn file(&self) -> Result<SweepFile, CommandError> {
        if self.plan.program != program()? {
            return Err(CommandError::Sweep(format!(
                "{} was begun with another build of planwright (version {}); all shards of a sweep \
                 must be of the same",
                self.folder.display(),
                self.plan.version
            )));
        }
        let copy = self.folder.join("sweep.plan");
        let mut file = SweepFile::read(&copy)?;
        if checksum(&file.text) != self.plan.text {
            return Err(CommandError::Sweep(format!(
                "{} has been changed since the sweep began",
                copy.display()
            )));
        }
        file.name.clone_from(&self.plan.file);
        Ok(file)
    }

    /// What the sweep is called and wants.
    pub(super) fn title(&self) -> Title {
        Title {
            name: self.plan.name.clone(),
            seed: self.plan.seed,
            goal: self.plan.goal,
        }
    }

    /// The worlds of a shard.
    pub(super) fn worlds_of(&self, shard: u64) -> Vec<u64> {
        let all = shard..self.plan.worlds;
        all.step_by(usize::try_from(self.plan.shards).unwrap_or(usize::MAX))
            .collect()
    }

    fn path_of(&self, shard: u64) -> PathBuf {
        self.folder.join(format!("shard-{shard}.jsonl"))
    }

    /// Writes a shard.
    pub(super) fn write(&self, shard: u64, records: &[Record]) -> Result<(), CommandError> {
        let text = lines(records);
        let end = End {
            count: records.len() as u64,
            hash: checksum(&text),
        };
        let end = serde_json::to_string(&end).unwrap_or_default();
        let written = write_whole(&self.path_of(shard), format!("{text}{end}\n").as_bytes());
        // Somebody else may have done it meanwhile, and tidied up.
        written.or_else(|error| self.read(shard).map(drop).ok_or(error))
    }

    /// Removes what those have left who were killed while they wrote a file that is there now.
    pub(super) fn tidy(&self) {
        for path in files(&self.folder) {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let Some((whole, process)) = name.rsplit_once(UNFINISHED) else {
                continue;
            };
            let is_ours = process.parse() == Ok(std::process::id());
            let shard = whole.strip_prefix("shard-");
            let shard = shard.and_then(|rest| rest.strip_suffix(".jsonl")?.parse().ok());
            let is_there = match shard {
                Some(shard) => self.read(shard).is_some(),
                None => self.folder.join(whole).exists(),
            };
            if is_there && !is_ours {
                // Files that cannot be removed do no harm.
                let _ = fs::remove_file(&path);
            }
        }
    }

    /// The records of a shard; `None` if it is not there, or not whole.
    pub(super) fn read(&self, shard: u64) -> Option<Vec<Record>> {
        let text = fs::read_to_string(self.path_of(shard)).ok()?;
        let body = text.strip_suffix('\n')?;
        let at = body.rfind('\n').map_or(0, |at| at + 1);
        let (text, end) = body.split_at(at);
        let end: End = serde_json::from_str(end).ok()?;
        if end.hash != checksum(text) {
            return None;
        }
        let records: Option<Vec<Record>> = text
            .lines()
            .map(|line| serde_json::from_str(line).ok())
            .collect();
        let worlds = self.worlds_of(shard);
        records.filter(|records| {
            end.count == records.len() as u64
                && records.iter().map(|record| record.world).eq(worlds)
        })
    }

    /// The shards that are missing.
    pub(super) fn missing(&self) -> Vec<u64> {
        let shards = 0..self.plan.shards;
        shards.filter(|shard| self.read(*shard).is_none()).collect()
    }

    /// All records that there are, in the order of the worlds.
    pub(super) fn records(&self) -> Vec<Record> {
        let shards = 0..self.plan.shards;
        let mut records: Vec<Record> = shards
            .filter_map(|shard| self.read(shard))
            .flatten()
            .collect();
        records.sort_by_key(|record| record.world);
        records
    }

    /// Writes all records into one file, `records.jsonl`.
    pub(super) fn merge(&self) -> Result<Vec<Record>, CommandError> {
        let records = self.records();
        self.tidy();
        write_whole(
            &self.folder.join("records.jsonl"),
            lines(&records).as_bytes(),
        )?;
        Ok(records)
    }
}

/// The files of a job in a folder that are there.
pub(super) fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    files.retain(|path| path.is_file());
    files.sort();
    files
}

/// Records as lines of JSON.
pub(super) fn lines(records: &[Record]) -> String {
    records.iter().map(|record| record.line() + "\n").collect()
}

fn checksum(text: &str) -> String {
    format!("{:016x}", fnv1a(text))
}

/// A checksum of this program's file.
fn program() -> Result<String, CommandError> {
    let bytes = std::env::current_exe()
        .and_then(fs::read)
        .map_err(|error| {
            CommandError::Sweep(format!("the program cannot read its own file: {error}"))
        })?;
    Ok(format!("{:08x}-{}", crc32fast::hash(&bytes), bytes.len()))
}

fn written(path: &Path, error: io::Error) -> CommandError {
    CommandError::Rewrite {
        path: path.to_owned(),
        error,
    }
}

/// What follows the name of a file that is being written, before the number of the process.
const UNFINISHED: &str = ".tmp.";

/// Writes a file under another name, and renames it when it is on the disk.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), CommandError> {
    let mut unfinished = path.as_os_str().to_owned();
    unfinished.push(format!("{UNFINISHED}{}", std::process::id()));
    let unfinished = PathBuf::from(unfinished);
    let write = || {
        let mut file = File::create(&unfinished)?;
        file.write_all(bytes)?;
        file.sync_all()?;
        fs::rename(&unfinished, path)
    };
    write().map_err(|error| {
        // What has been written of it is of no use; it may not even have been made.
        let _ = fs::remove_file(&unfinished);
        written(path, error)
    })
}
