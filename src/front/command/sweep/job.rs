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

use super::file::sweep_file;
use crate::command::failure::CommandError;
use crate::command::options::seconds;
use lisp::files::text_of;
use session::sweeping::SweepFile;
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

/// Why the records of a shard are not to be had.
#[derive(Debug, PartialEq)]
pub(super) enum Lack {
    /// Nobody has written them.
    Missing,
    /// Its file is not what was written, for this reason.
    Damaged(String),
}

/// The most shards that a sweep is divided into: each is a file that is looked for.
const MAX_SHARDS: u64 = 1_000_000;
/// How many worlds a shard has, unless somebody says otherwise.
const WORLDS_OF_SHARD: u64 = 20;

/// The last line of a shard.
#[derive(Serialize, Deserialize)]
struct End {
    count: u64,
    hash: String,
}

impl Plan {
    /// Reads what is to be done, or says what is wrong.
    fn read(text: &str) -> Result<Self, String> {
        let plan: Self = serde_json::from_str(text).map_err(|error| error.to_string())?;
        match plan.mistake() {
            Some(mistake) => Err(mistake),
            None => Ok(plan),
        }
    }

    /// What is wrong with it, if anything is.
    fn mistake(&self) -> Option<String> {
        let (worlds, shards) = (self.worlds, self.shards);
        if worlds == 0 {
            return Some("it has no worlds".to_owned());
        }
        if !(1..=worlds.min(MAX_SHARDS)).contains(&shards) {
            return Some(format!(
                "{worlds} worlds cannot be divided into {shards} shards: 1 to {} were expected",
                worlds.min(MAX_SHARDS)
            ));
        }
        if self.goal.is_some_and(|goal| !(0.0..=1.0).contains(&goal)) {
            return Some("its goal is no share of the worlds: 0 to 1 was expected".to_owned());
        }
        let limit = self.time_limit.map(|limit| seconds(&limit.to_string()));
        limit?.err().map(|error| format!("its time limit: {error}"))
    }
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
            shards: match shards {
                Some(shards) => shards.min(worlds),
                None => worlds.div_ceil(WORLDS_OF_SHARD).min(MAX_SHARDS),
            },
            goal: title.goal,
            time_limit,
        };
        if let Some(mistake) = plan.mistake() {
            return Err(CommandError::Sweep(mistake));
        }
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
        let text = text_of(&path).map_err(|error| CommandError::Read {
            path: path.clone(),
            error,
        })?;
        let plan = Plan::read(&text).map_err(|what| {
            CommandError::Sweep(format!("{} describes no sweep: {what}", path.display()))
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
        let mut file = sweep_file(&copy)?;
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
    pub(super) fn worlds_of(&self, shard: u64) -> impl Iterator<Item = u64> + Send + use<> {
        let all = shard..self.plan.worlds;
        all.step_by(usize::try_from(self.plan.shards).unwrap_or(usize::MAX))
    }

    /// How many worlds a shard has.
    pub(super) fn count_of(&self, shard: u64) -> u64 {
        let from_there = self.plan.worlds.saturating_sub(shard);
        from_there.div_ceil(self.plan.shards)
    }

    /// Whether records are those of all worlds of a shard.
    pub(super) fn is_all_of(&self, shard: u64, records: &[Record]) -> bool {
        records.len() as u64 == self.count_of(shard)
    }

    fn path_of(&self, shard: u64) -> PathBuf {
        self.folder.join(format!("shard-{shard}.jsonl"))
    }

    /// Writes a shard.
    pub(super) fn write(&self, shard: u64, records: &[Record]) -> Result<(), CommandError> {
        let text = sealed(lines(records), records.len() as u64);
        let written = write_whole(&self.path_of(shard), text.as_bytes());
        // Somebody else may have done it meanwhile, and tidied up.
        written.or_else(|error| self.read(shard).map(drop).map_err(|_| error))
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
                Some(shard) => self.has(shard),
                None => self.folder.join(whole).exists(),
            };
            if is_there && !is_ours {
                // Files that cannot be removed do no harm.
                let _ = fs::remove_file(&path);
            }
        }
    }

    /// The records of a shard.
    pub(super) fn read(&self, shard: u64) -> Result<Vec<Record>, Lack> {
        let text = fs::read_to_string(self.path_of(shard));
        let text = text.map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => Lack::Missing,
            io::ErrorKind::InvalidData => Lack::Damaged("it is not UTF-8".to_owned()),
            _ => Lack::Damaged(error.to_string()),
        })?;
        unsealed(&text, self.worlds_of(shard)).map_err(Lack::Damaged)
    }

    /// Whether the records of a shard are there.
    pub(super) fn has(&self, shard: u64) -> bool {
        self.read(shard).is_ok()
    }

    /// The shards that are missing, damaged ones among them.
    pub(super) fn missing(&self) -> Vec<u64> {
        let shards = 0..self.plan.shards;
        shards.filter(|shard| !self.has(*shard)).collect()
    }

    /// A line for each of the missing shards whose file is damaged: its name, and why.
    pub(super) fn damaged(&self, missing: &[u64]) -> Vec<String> {
        let mut lines = Vec::new();
        for shard in missing {
            if let Err(Lack::Damaged(why)) = self.read(*shard) {
                lines.push(format!("damaged: shard-{shard}.jsonl: {why}"));
            }
        }
        lines
    }

    /// All records that there are, in the order of the worlds.
    pub(super) fn records(&self) -> Vec<Record> {
        let shards = 0..self.plan.shards;
        let mut records: Vec<Record> = shards
            .filter_map(|shard| self.read(shard).ok())
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

/// The lines of a shard with the line at its end.
fn sealed(lines: String, count: u64) -> String {
    let hash = checksum(&lines);
    let end = serde_json::to_string(&End { count, hash }).unwrap_or_default();
    format!("{lines}{end}\n")
}

/// The records of these worlds in the text of a shard, or how it is damaged.
fn unsealed(text: &str, worlds: impl Iterator<Item = u64>) -> Result<Vec<Record>, String> {
    let cut_off = || "it is cut off: no count and checksum at its end".to_owned();
    let body = text.strip_suffix('\n').ok_or_else(cut_off)?;
    let at = body.rfind('\n').map_or(0, |at| at + 1);
    let (text, end) = body.split_at(at);
    let end: End = serde_json::from_str(end).map_err(|_| cut_off())?;
    if end.hash != checksum(text) {
        return Err("its checksum is not that of its records".to_owned());
    }
    let lines = text.lines().zip(1..);
    let records = lines.map(|(line, number)| {
        let read = serde_json::from_str(line);
        read.map_err(|error| format!("line {number}: {error}"))
    });
    let records: Vec<Record> = records.collect::<Result<_, _>>()?;
    let found = records.iter().map(|record| record.world);
    match end.count == records.len() as u64 && found.eq(worlds) {
        true => Ok(records),
        false => Err("it does not have the worlds of this shard".to_owned()),
    }
}

/// The texts of a sweep's files, for whoever tries how they are read.
#[cfg(any(test, fuzzing))]
pub(crate) mod texts {
    use super::{Plan, Record, sealed, unsealed};

    /// Whether a text says what a sweep is to do.
    pub(crate) fn is_plan(text: &str) -> bool {
        Plan::read(text).is_ok()
    }

    /// The records of a shard with these lines, which has the first worlds.
    pub(crate) fn shard(lines: &str) -> Result<Vec<Record>, String> {
        let lines = format!("{}\n", lines.trim_end_matches('\n'));
        let count = lines.lines().count() as u64;
        unsealed(&sealed(lines, count), 0..count)
    }
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
