//! Doing shards: one, as a worker of an engine, or all that are missing.

use std::env;
use std::process::{Command, Stdio};
use std::thread;

use super::interrupt;
use super::job::Job;
use super::kept::Kept;
use super::pool;
use super::progress::Progress;
use super::worlds::{Worlds, sound};
use crate::command::failure::{CommandError, Status};
use crate::command::options::Options;
use sweep::{Ending, Record};

/// Variables in which engines tell a worker its index.
const INDEXES: [&str; 3] = ["SLURM_ARRAY_TASK_ID", "HQ_TASK_ID", "JOB_COMPLETION_INDEX"];
/// How often a shard is tried in a process of its own before its worlds are.
const TRIES: u32 = 3;

/// The index that an engine tells, if one does.
pub(super) fn index_of_engine() -> Option<u64> {
    let texts = INDEXES.iter().filter_map(|name| env::var(name).ok());
    texts.filter_map(|text| text.parse().ok()).next()
}

/// How many threads there are: as the engine says, else as the machine has.
pub(in crate::command) fn threads() -> usize {
    let of_slurm = env::var("SLURM_CPUS_PER_TASK");
    let of_slurm = of_slurm.ok().and_then(|count| count.parse().ok());
    let of_hq = env::var("HQ_CPUS").ok();
    let of_hq = of_hq.map(|list| list.split(',').count());
    of_slurm
        .or(of_hq)
        .or_else(|| thread::available_parallelism().ok().map(usize::from))
        .unwrap_or(1)
}

/// Does one shard, unless it is there.
pub(super) fn shard(
    options: &Options,
    job: &Job,
    shard: u64,
    threads: usize,
) -> Result<Status, CommandError> {
    if shard >= job.plan.shards {
        return Err(CommandError::Sweep(format!(
            "there is no shard {shard}: they are 0 to {}",
            job.plan.shards - 1
        )));
    }
    if job.has(shard) {
        return Ok(Status::Good);
    }
    let worlds = open(options, job)?;
    let mut kept = Kept::default();
    let records = sound(pool::in_order(
        threads,
        job.worlds_of(shard),
        || worlds.runner(),
        |record| kept.keep(record) && record.outcome != Ending::Mistake,
    ))?;
    kept.tell_if_full();
    if !job.is_all_of(shard, &records) {
        return Ok(Status::Incomplete);
    }
    job.write(shard, &records)?;
    job.tidy();
    Ok(Status::Good)
}

pub(super) fn open(options: &Options, job: &Job) -> Result<Worlds, CommandError> {
    let options = Options {
        seed: job.plan.seed,
        ..options.clone()
    };
    let (worlds, _) = Worlds::open(&options, job.file()?, Some(&job.plan.name))?;
    Ok(worlds.within(job.plan.time_limit))
}

/// The shards that are missing, and the progress of their worlds.
fn missing(job: &Job) -> (Vec<u64>, Progress) {
    let missing = job.missing();
    let count = missing.iter().map(|shard| job.count_of(*shard)).sum();
    let progress = Progress::new(&job.title(), count);
    (missing, progress)
}

/// Does all shards that are missing, in this process. An interrupt ends it between two worlds; shards
/// that are not done then are missing.
pub(super) fn all(job: &Job, worlds: &Worlds, threads: usize) -> Result<(), CommandError> {
    let (missing, mut progress) = missing(job);
    for shard in missing {
        let mut kept = Kept::default();
        let records = pool::in_order(
            threads,
            job.worlds_of(shard),
            || worlds.runner(),
            |record| {
                progress.record(record);
                let is_sound = record.outcome != Ending::Mistake;
                kept.keep(record) && is_sound && !interrupt::has_come()
            },
        );
        let records = sound(records)?;
        if !job.is_all_of(shard, &records) {
            kept.tell_if_full();
            break;
        }
        job.write(shard, &records)?;
    }
    progress.end();
    Ok(())
}

/// Does all shards that are missing, each in a process of its own, which a world may kill. Where it
/// does so repeatedly, each of its worlds gets a process, to find out which it is.
pub(super) fn apart(job: &Job, threads: usize) -> Result<(), CommandError> {
    let (missing, mut progress) = missing(job);
    for shard in missing {
        let mut tries = 0;
        while !job.has(shard) && tries < TRIES && !interrupt::has_come() {
            let index = format!("{shard}/{}", job.plan.shards);
            let output = child(job, threads, &["--shard", &index])?;
            if matches!(output.status.code(), Some(2 | 3)) {
                let text = String::from_utf8_lossy(&output.stderr);
                return Err(CommandError::Sweep(
                    text.trim_start_matches("error: ").trim_end().to_owned(),
                ));
            }
            tries += 1;
        }
        if interrupt::has_come() {
            break;
        }
        if !job.has(shard) {
            one_by_one(job, shard)?;
        }
        for record in job.read(shard).unwrap_or_default() {
            progress.record(&record);
        }
    }
    progress.end();
    Ok(())
}

/// Does the worlds of a shard, each in a process of its own.
fn one_by_one(job: &Job, shard: u64) -> Result<(), CommandError> {
    let mut records = Vec::new();
    for world in job.worlds_of(shard) {
        let output = child(job, 1, &["--world-of-shard", &world.to_string()])?;
        let text = String::from_utf8_lossy(&output.stdout);
        let record = serde_json::from_str(text.trim_end()).ok();
        if interrupt::has_come() {
            // It ended the child, too: that is not the world's doing.
            return Ok(());
        }
        records.push(record.unwrap_or_else(|| Record::new(world, Ending::Crashed)));
    }
    job.write(shard, &records)
}

fn child(
    job: &Job,
    threads: usize,
    arguments: &[&str],
) -> Result<std::process::Output, CommandError> {
    let program = env::current_exe().map_err(CommandError::Write)?;
    Command::new(program)
        .args(["sweep", "--into"])
        .arg(&job.folder)
        .args(["--threads", &threads.to_string()])
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .map_err(|error| CommandError::Sweep(format!("no process can be started: {error}")))
}

/// Runs one world and prints its record.
pub(super) fn one_world(options: &Options, job: &Job, world: u64) -> Result<Record, CommandError> {
    let worlds = open(options, job)?;
    let mut records = pool::in_order(1, [world], || worlds.runner(), |_| true);
    let record = records.pop();
    record.ok_or_else(|| CommandError::Sweep("the machine has no threads left".to_owned()))
}
